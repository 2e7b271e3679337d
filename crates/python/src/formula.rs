//! Formulas.

use crate::work::released;
use pyo3::prelude::*;
use wavestep::Formula as Exact;

/// An exact function: `name = expression`. Two are equal where their right sides are the same function.
///
/// >>> import wavestep as ws
/// >>> f = ws.scene("rigid-mass").derive("f", 1)[0]
/// >>> f
/// f[1](s) = exp(-s)*(-2*s + 1 + exp(-2*mu))
/// >>> f.sympy()
/// (-2*s + 1 + exp(-2*mu))*exp(-s)
#[pyclass(frozen, eq, module = "wavestep")]
#[derive(PartialEq)]
pub struct Formula(pub Exact);

#[pymethods]
impl Formula {
    fn __copy__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: PyRef<'py, Self>, _memo: &Bound<'py, PyAny>) -> PyRef<'py, Self> {
        slf
    }

    /// The period on which it holds; `None` for echoes and for forms of every period.
    #[getter]
    fn order(&self) -> Option<usize> {
        self.0.order()
    }

    /// LaTeX, an `align*` environment.
    fn latex(&self) -> String {
        self.0.latex()
    }

    /// The right side as an expression of SymPy; its symbols have their plain names.
    fn sympy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("wavestep._convert")?.call_method1("sympy_of", (self.0.text(),))
    }

    /// Whether the right side is the same function as this text.
    ///
    /// >>> import wavestep as ws
    /// >>> ws.scene("rigid-mass").derive("f", 0)[0].equals("1/exp(s)")
    /// True
    fn equals(&self, py: Python<'_>, expression: &str) -> PyResult<bool> {
        released(py, || Ok(self.0.equals(expression)?))
    }

    fn __str__(&self) -> String {
        self.0.text()
    }

    fn __repr__(&self) -> String {
        self.0.text()
    }

    fn _repr_latex_(&self) -> String {
        format!("$${}$$", self.0.latex().replace("{align*}", "{aligned}"))
    }
}
