//! Arrays of NumPy as slices, without a copy where they are contiguous doubles.

use crate::failure::Failure;
use crate::given::is_quantity;
use crate::work::released;
use numpy::{PyArrayDyn, PyArrayMethods as _, PyUntypedArrayMethods as _};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

/// Whether there are many times, not one.
pub fn are_many(times: &Bound<'_, PyAny>) -> PyResult<bool> {
    if times.is_instance_of::<PyList>() || times.is_instance_of::<PyTuple>() {
        return Ok(true);
    }
    let inner = if is_quantity(times)? { &times.getattr("magnitude")? } else { times };
    Ok(inner.hasattr("ndim")? && inner.getattr("ndim")?.extract::<usize>()? > 0)
}

/// Times as an array of doubles; refused where their kind has numbers that no double holds.
pub fn doubles<'py>(times: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let py = times.py();
    // Where NumPy is missing this is told as usual.
    let numpy = py.import("numpy")?;
    if let Ok(array) = times.cast::<PyArrayDyn<f64>>()
        && array.is_c_contiguous()
    {
        return Ok(array.clone());
    }
    let times = match is_quantity(times)? {
        true => &times.call_method0("to_base_units")?.getattr("magnitude")?,
        false => times,
    };
    let array = numpy.call_method1("asarray", (times,))?;
    let kind = array.getattr("dtype")?;
    let (letter, size): (String, usize) =
        (kind.getattr("kind")?.extract()?, kind.getattr("itemsize")?.extract()?);
    if !matches!(letter.as_str(), "f" | "i" | "u") || size > 8 {
        let message = format!("an array of kind `{kind}` does not hold doubles");
        let remedy =
            "give an array of float64; for fractions and text use `values`, or one time each";
        return Err(Failure::Input(message, remedy.to_owned()).raised(py));
    }
    let array = numpy.call_method1("ascontiguousarray", (array, "float64"))?;
    Ok(array.cast_into()?)
}

/// Fills an array with the values at the times of another, without the interpreter's lock.
pub fn fill<'py>(
    times: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
    work: impl FnOnce(&[f64], &mut [f64]) -> Result<(), Failure> + Send,
) -> PyResult<Bound<'py, PyAny>> {
    let py = times.py();
    let times = doubles(times)?;
    let out = match out {
        Some(out) => out.clone(),
        None => py.import("numpy")?.call_method1("empty", (times.getattr("shape")?,))?,
    };
    let refuse = |_| {
        let remedy = "give numpy.empty(t.shape), or leave it out";
        let message = "`out` is no contiguous array of float64 that can be written and is not `t`";
        Failure::Input(message.to_owned(), remedy.to_owned()).raised(py)
    };
    let array = out.cast::<PyArrayDyn<f64>>().map_err(|_| refuse(()))?;
    let times = times.try_readonly()?;
    let mut values = array.try_readwrite().map_err(|_| refuse(()))?;
    if values.shape() != times.shape() {
        return Err(refuse(()));
    }
    let (times, values) = (times.as_slice()?, values.as_slice_mut().map_err(|_| refuse(()))?);
    released(py, || work(times, values))?;
    Ok(out)
}
