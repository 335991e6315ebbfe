//! Maps as tables, documents and pages.

mod csv;
mod document;
mod looks;
mod page;
pub mod picture;
mod pointing;
mod text;
mod values;

pub use csv::map_csv;
pub use document::document;
pub use page::{MapReport, page};
pub use text::text;
