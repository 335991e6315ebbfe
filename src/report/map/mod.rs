//! Maps as findings, documents, rows and pictures.

mod document;
mod findings;
mod meanings;
mod panel;
pub mod picture;
mod pointing;
mod rows;
mod style;
mod values;

pub use document::document;
pub use findings::findings;
pub use rows::map_rows;
