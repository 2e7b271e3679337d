//! Numbers as Python has them, exactly.

use crate::failure::Failure;
use num_bigint::BigInt;
use pyo3::exceptions::{PyOverflowError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyString};
use wavestep::limits::MAX_DIGITS;
use wavestep::{Given, Rational};

/// Bits of a number with the most digits that are given out, and some more.
const MOST_BITS: usize = 4 * MAX_DIGITS;

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
    // A number of NumPy's, or an array without dimensions.
    if value.hasattr("ndim")? && value.getattr("ndim")?.extract::<usize>()? == 0 {
        let item = value.call_method0("item")?;
        if !item.get_type().is(value.get_type()) {
            return given(&item);
        }
    }
    if value.hasattr("__index__")? {
        let integer = value.call_method0("__index__")?;
        let bits: usize = integer.call_method0("bit_length")?.extract()?;
        if bits > MOST_BITS {
            return Err(too_long(value.py()));
        }
        let integer: BigInt = integer.extract()?;
        return Ok(Rational::from_integer(integer).into());
    }
    if value.hasattr("as_integer_ratio")? {
        return ratio(value);
    }
    let name = value.get_type().name()?;
    let message = format!("a value of type `{name}` is not a number");
    let remedy = "give an int, a float, a Fraction or text such as \"33/10\" or \"120 us\"";
    Err(Failure::input(message, remedy).raised(value.py()))
}

fn too_long(py: Python<'_>) -> PyErr {
    let message = format!("a number has more than {MAX_DIGITS} digits");
    Failure::input(message, "give a shorter one").raised(py)
}

/// A fraction, or a decimal number; those that are infinite, or no numbers, raise exceptions of Python's.
fn ratio(value: &Bound<'_, PyAny>) -> PyResult<Given> {
    let py = value.py();
    // The ratio of a decimal number such as 1E+999999999 has as many digits.
    if value.hasattr("adjusted")? {
        let places: i64 = value.call_method0("adjusted")?.extract()?;
        if places.unsigned_abs() > MAX_DIGITS as u64 {
            return Err(too_long(py));
        }
    }
    match value.call_method0("as_integer_ratio") {
        Ok(ratio) => {
            let (above, below): (BigInt, BigInt) = ratio.extract()?;
            if above.bits().max(below.bits()) > MOST_BITS as u64 {
                return Err(too_long(py));
            }
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
                let remedy = "give a smaller whole number, 0 at least";
                Failure::input(format!("{value} is out of range"), remedy).raised(value.py())
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
