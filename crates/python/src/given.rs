//! Numbers as Python has them, exactly.

use crate::failure::Failure;
use num_bigint::BigInt;
use pyo3::exceptions::{PyOverflowError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyString};
use wavestep::{Given, Rational};

/// A number or a time: `int`, `float` as its exact value, `Fraction`, `Decimal`, text, a quantity of pint.
#[derive(Clone)]
pub struct Number(pub Given);

impl From<Number> for Given {
    fn from(number: Number) -> Given {
        number.0
    }
}

impl<'py> FromPyObject<'_, 'py> for Number {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Number> {
        Ok(Number(given(&value)?))
    }
}

/// The number that a value of Python's is.
pub fn given(value: &Bound<'_, PyAny>) -> PyResult<Given> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(text.to_str()?.into());
    }
    if let Ok(double) = value.cast::<PyFloat>() {
        return Ok(double.value().into());
    }
    if is_quantity(value)? {
        return quantity(value);
    }
    if value.hasattr("__index__")? {
        let integer: BigInt = value.call_method0("__index__")?.extract()?;
        return Ok(Rational::from_integer(integer).into());
    }
    if value.hasattr("as_integer_ratio")? {
        return ratio(value);
    }
    let name = value.get_type().name()?;
    let message = format!("a value of type `{name}` is not a number");
    let remedy = "give an int, a float, a Fraction or text such as \"33/10\" or \"120 us\"";
    Err(Failure::Input(message, remedy.to_owned()).raised(value.py()))
}

/// A fraction, or a decimal number; those that are infinite, or no numbers, raise exceptions of Python's.
fn ratio(value: &Bound<'_, PyAny>) -> PyResult<Given> {
    let py = value.py();
    match value.call_method0("as_integer_ratio") {
        Ok(ratio) => {
            let (above, below): (BigInt, BigInt) = ratio.extract()?;
            Ok(Rational::new(above, below).into())
        }
        Err(error) if error.is_instance_of::<PyOverflowError>(py) => Ok(f64::INFINITY.into()),
        Err(error) if error.is_instance_of::<PyValueError>(py) => Ok(f64::NAN.into()),
        Err(error) => Err(error),
    }
}

/// Whether it is a quantity of pint, which need not be installed.
pub fn is_quantity(value: &Bound<'_, PyAny>) -> PyResult<bool> {
    Ok(value.hasattr("to_base_units")? && value.hasattr("magnitude")?)
}

/// A quantity as text, so that the library checks its unit and keeps it exact.
fn quantity(value: &Bound<'_, PyAny>) -> PyResult<Given> {
    let magnitude = match given(&value.getattr("magnitude")?)? {
        Given::Exact(number) => number.to_string(),
        Given::Text(text) => text,
        strange => return Ok(strange),
    };
    let unit = value.getattr("units")?.call_method1("__format__", ("~C",))?;
    let unit = unit.extract::<String>()?.replace("**", "^").replace('µ', "u");
    Ok(format!("{magnitude} {unit}").into())
}

/// A number of digits, cells or periods.
pub fn count(value: &Bound<'_, PyAny>) -> PyResult<usize> {
    value.extract().map_err(|error: PyErr| {
        match error.is_instance_of::<PyOverflowError>(value.py()) {
            true => {
                let remedy = "give a whole number from 0 on, and not as large".to_owned();
                Failure::Input(format!("{value} is no number of things"), remedy).raised(value.py())
            }
            false => error,
        }
    })
}

/// Values for symbols, by name.
pub fn values(named: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<(String, Given)>> {
    let pairs = named.into_iter().flat_map(|named| named.iter());
    pairs.map(|(name, value)| Ok((name.extract()?, given(&value)?))).collect()
}
