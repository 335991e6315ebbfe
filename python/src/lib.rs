//! The extension module `dam._dam`: what Python's package `dam` stands on. Its classes are
//! not meant for users; `python/dam` wraps them in documented ones with types.
//!
//! It is a thin layer over `ask`, `studies` and `report`: `scene` takes a question, a file of
//! `studies` answers it and keeps the result (`answer::Found`, or `Told` with `Findings`;
//! `Table` for the columns). The package depends on `dam` with the features of the plain build,
//! so that a release build compiles `dam` once for both.

mod answer;
mod arrow;
mod fault;
mod own;
mod prepared;
mod program;
mod scene;
mod studies;
mod tree;
mod work;

use pyo3::prelude::*;

#[pymodule]
mod _dam {
    #[pymodule_export]
    use super::answer::{Answer, Column};
    #[pymodule_export]
    use super::own::{Own, load, position, position_jets};
    #[pymodule_export]
    use super::prepared::{Points, Prepared};
    #[pymodule_export]
    use super::program::program;
    #[pymodule_export]
    use super::scene::{Scene, law_of, schema, stroke_of};

    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("VERSION", env!("CARGO_PKG_VERSION"))
    }
}
