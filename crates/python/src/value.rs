//! Values with proven digits.

use crate::failure::Failure;
use crate::given::count;
use num_bigint::BigInt;
use pyo3::prelude::*;
use wavestep::limits::MAX_DIGITS;
use wavestep::{Rational, Value as Proven};

/// A value, exact or with proven digits.
///
/// >>> import wavestep as ws
/// >>> value = ws.scene("rigid-mass", mu=1).signal("velocity").digits("3/2", 20)
/// >>> value
/// Value('0.22313016014842982893')
/// >>> float(value), value.exact
/// (0.22313016014842982, None)
/// >>> value.decimal()
/// Decimal('0.22313016014842982893')
#[pyclass(frozen, eq, module = "wavestep")]
#[derive(PartialEq)]
pub struct Value(pub Proven);

impl Value {
    /// So many digits as text.
    fn text(&self, py: Python<'_>, digits: usize) -> PyResult<String> {
        if digits > MAX_DIGITS {
            let message = format!("{digits} digits are asked for");
            let remedy = format!("give 1 to {MAX_DIGITS}");
            return Err(Failure::input(message, remedy).raised(py));
        }
        Ok(self.0.decimal(digits.max(1)).0.to_string())
    }
}

#[pymethods]
impl Value {
    /// The number as a fraction, where it is known to be rational.
    #[getter]
    fn exact(&self) -> Option<Rational> {
        self.0.exact().cloned()
    }

    /// Two fractions with the value between them.
    #[getter]
    fn bounds(&self) -> (Rational, Rational) {
        let [lower, upper] = self.0.bounds();
        (lower, upper)
    }

    /// The value as a `decimal.Decimal`: the digits that are proven, or so many of an exact one.
    #[pyo3(signature = (digits=30))]
    fn decimal<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = count)] digits: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let text = self.text(py, digits)?;
        py.import("decimal")?.getattr("Decimal")?.call1((text,))
    }

    /// The same as an `mpmath.mpf`.
    #[pyo3(signature = (digits=30))]
    fn mpf<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = count)] digits: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let text = self.text(py, digits)?;
        py.import("wavestep._convert")?.call_method1("mpf", (text,))
    }

    /// So that functions of mpmath take the value as a number.
    fn _mpmath_<'py>(
        &self,
        py: Python<'py>,
        bits: usize,
        rounding: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (numerator, denominator) = self.as_integer_ratio();
        let given = (numerator, denominator, bits, rounding);
        py.import("wavestep._convert")?.call_method1("rounded", given)
    }

    fn __float__(&self) -> f64 {
        self.0.to_f64()
    }

    /// Formatted as a double; without a format, with its digits.
    fn __format__(&self, py: Python<'_>, spec: &str) -> PyResult<String> {
        if spec.is_empty() {
            return Ok(self.0.to_string());
        }
        self.0.to_f64().into_pyobject(py)?.call_method1("__format__", (spec,))?.extract()
    }

    fn __copy__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: PyRef<'py, Self>, _memo: &Bound<'py, PyAny>) -> PyRef<'py, Self> {
        slf
    }

    fn __str__(&self) -> String {
        self.0.to_string()
    }

    fn __repr__(&self) -> String {
        format!("Value('{}')", self.0)
    }

    /// So that a value is taken where numbers are: an exact one as it is, any other as the middle of its bounds.
    fn as_integer_ratio(&self) -> (BigInt, BigInt) {
        let [lower, upper] = self.0.bounds();
        let middle = (lower + upper) / Rational::from_integer(2.into());
        (middle.numer().clone(), middle.denom().clone())
    }
}
