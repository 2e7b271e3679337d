//! The native part of the Python package `wavestep`.
use pyo3::prelude::*;

/// The native part of the package.
#[pymodule]
mod _native {
    use super::*;
    #[pymodule_init]
    fn init(_m: &Bound<'_, PyModule>) -> PyResult<()> { let _ = wavestep::Problem::builtin("pile"); let _ = wavestep_studies::picture::usual_end; Ok(()) }
}
