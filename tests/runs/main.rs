//! Scenes that are read and run: methods, figures, references, dead positions, bad input.

mod agreement;
mod auto;
mod bad_input;
mod contact;
mod creep;
mod dead_positions;
mod examples;
mod expressions;
mod figures;
mod lagrange;
mod levels;
mod library;
mod long_chains;
mod methods;
mod order;
mod order_table;
mod ports;
mod random_scenes;
mod read_scene;
mod reduce;
mod reference_rocker;
mod scoreboard;
mod short_steps;
mod starts_of_laws;
mod stiff_and_brief;
mod tolerance;
