//! The extension module `dam._dam`: what Python's package `dam` stands on. Its classes are
//! not meant for users; `python/dam` wraps them in documented ones with types.

mod answer;
mod arrow;
mod fault;
mod own;
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
    use super::program::program;
    #[pymodule_export]
    use super::scene::{Scene, law_of, schema, stroke_of};

    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("VERSION", env!("CARGO_PKG_VERSION"))
    }
}
