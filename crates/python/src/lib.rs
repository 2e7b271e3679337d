//! The native part of the Python package `wavestep`: the library's API, with Python's numbers and arrays.
//!
//! Its docstrings are those of the package, so their examples are in Python; `_native.pyi` has the types.

mod arrays;
mod failure;
mod formula;
mod given;
mod problem;
mod results;
mod signal;
mod sweep;
mod value;
mod work;

use pyo3::prelude::*;

/// The native part of the package.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::formula::Formula;
    #[pymodule_export]
    use super::problem::Problem;
    #[pymodule_export]
    use super::signal::{Curve, Signal};
    #[pymodule_export]
    use super::sweep::Sweep;
    #[pymodule_export]
    use super::value::Value;
    #[pymodule_export]
    use super::work::{fail, set_memory};
    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        wavestep::limits::stop_by(super::work::pause);
        let names = wavestep::scenes::SCENES.iter().map(|scene| scene.name);
        module.add("SCENES", pyo3::types::PyTuple::new(module.py(), names)?)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
