//! Maps as tables, documents and pages.

mod csv;
mod document;
mod page;
mod pointing;
mod text;

pub use csv::map_csv;
pub use document::document;
pub use page::{MapReport, page};
pub use text::text;
