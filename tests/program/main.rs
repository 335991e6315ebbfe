//! The program and what it reads, prints and writes; the scenarios and the documents.

mod accuracy;
mod bad_numbers;
mod browser;
mod checks;
mod command_line;
mod diagnostics;
mod documents;
mod first_times;
mod imports;
mod kept;
mod labels;
mod map;
mod meaning;
mod options;
mod outside;
mod page;
mod prices;
mod public;
mod reduce;
mod scenarios;
mod schema;
mod steady;
mod study_figures;
mod study_verdicts;
mod verdicts;
mod words;
