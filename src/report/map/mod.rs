//! Maps as tables, documents and pages.

mod csv;
mod document;
mod looks;
mod page;
mod panel;
pub mod picture;
mod pointing;
mod report;
mod text;
mod values;

pub use csv::map_csv;
pub use document::document;
pub use page::page;
pub use report::MapReport;
pub use text::text;
