//! Arrays of NumPy as slices, without a copy where they are contiguous doubles.

use crate::failure::Failure;
use crate::given::is_quantity;
use crate::work::released;
use numpy::{PyArrayDyn, PyArrayMethods as _, PyUntypedArrayMethods as _};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use std::ops::Range;

/// Whether there are many times, not one.
pub fn are_many(times: &Bound<'_, PyAny>) -> PyResult<bool> {
    if times.is_instance_of::<PyList>() || times.is_instance_of::<PyTuple>() {
        return Ok(true);
    }
    let inner = if is_quantity(times)? { &times.getattr("magnitude")? } else { times };
    Ok(inner.hasattr("ndim")? && inner.getattr("ndim")?.extract::<usize>()? > 0)
}

/// Times as an array of doubles, quantities in a unit or, where that is empty, as plain numbers; refused where their kind
/// has numbers that no double holds.
pub fn doubles<'py>(
    times: &Bound<'py, PyAny>,
    unit: &str,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let py = times.py();
    if times.hasattr("mask")? && times.hasattr("filled")? {
        let remedy =
            "give `t.compressed()`, or `t.filled(…)` with times in place of what is masked";
        let message = "some times of a masked array are missing";
        return Err(Failure::input(message, remedy).raised(py));
    }
    // Where NumPy is missing this is told as usual.
    let numpy = py.import("numpy")?;
    if let Ok(array) = times.cast::<PyArrayDyn<f64>>()
        && array.is_c_contiguous()
    {
        return Ok(array.clone());
    }
    let times = match is_quantity(times)? {
        true => &py.import("wavestep._convert")?.call_method1("magnitudes", (times, unit))?,
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
        return Err(Failure::input(message, remedy).raised(py));
    }
    let array = numpy.call_method1("ascontiguousarray", (array, "float64"))?;
    Ok(array.cast_into()?)
}

/// Where the numbers of an array are in memory; it is contiguous.
fn place(array: &Bound<'_, PyArrayDyn<f64>>) -> Range<usize> {
    let start = array.data() as usize;
    start..start + array.len() * size_of::<f64>()
}

/// Fills an array with the values at the times of another, without the interpreter's lock. Quantities are taken in a unit.
pub fn fill<'py>(
    (times, unit): (&Bound<'py, PyAny>, &str),
    out: Option<&Bound<'py, PyAny>>,
    work: impl FnOnce(&[f64], &mut [f64]) -> Result<(), Failure> + Send,
) -> PyResult<Bound<'py, PyAny>> {
    let py = times.py();
    let times = doubles(times, unit)?;
    let out = match out {
        Some(out) => out.clone(),
        None => py.import("numpy")?.call_method1("empty", (times.getattr("shape")?,))?,
    };
    let refuse = |_| {
        let remedy = "give numpy.empty(t.shape), or leave it out";
        let message = "`out` is no contiguous array of float64 that can be written and shares nothing with `t`";
        Failure::input(message, remedy).raised(py)
    };
    let array = out.cast::<PyArrayDyn<f64>>().map_err(|_| refuse(()))?;
    let [read, written] = [&times, array].map(place);
    if !array.is_c_contiguous() || read.start < written.end && written.start < read.end {
        return Err(refuse(()));
    }
    let times = times.try_readonly()?;
    let mut values = array.try_readwrite().map_err(|_| refuse(()))?;
    if values.shape() != times.shape() {
        return Err(refuse(()));
    }
    let (times, values) = (times.as_slice()?, values.as_slice_mut().map_err(|_| refuse(()))?);
    released(py, || work(times, values))?;
    Ok(out)
}
