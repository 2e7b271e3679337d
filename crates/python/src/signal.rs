//! Signals, and windows of them that are made ready.

use crate::arrays::{are_many, doubles, fill};
use crate::failure::Failure;
use crate::given::{Number, count};
use crate::problem::{Problem, Shared, svg};
use crate::results;
use crate::value::Value;
use crate::work::released;
use numpy::{PyArrayMethods as _, PyUntypedArrayMethods as _};
use pyo3::IntoPyObjectExt as _;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PySequence, PyString};
use std::sync::Arc;
use wavestep::{Doubles, Error, Given, Goal, Method, Tolerance};

/// A wave or an observable as a function of time, from 0 on.
///
/// Called with a time it gives the nearest double; with an array, the nearest doubles to all values, in a new array of its
/// shape or in `out`.
///
/// >>> import wavestep as ws
/// >>> velocity = ws.scene("rigid-mass", mu=1).signal("velocity")
/// >>> velocity("3/2")
/// 0.22313016014842982
/// >>> velocity([0, 0.5, 1.5])
/// array([1.        , 0.60653066, 0.22313016])
#[pyclass(frozen, module = "wavestep")]
pub struct Signal {
    pub problem: Arc<Shared>,
    /// The name.
    #[pyo3(get)]
    pub name: String,
    /// The unit of its values, empty for plain numbers.
    #[pyo3(get)]
    pub unit: String,
}

impl Signal {
    /// Asks the signal without the interpreter's lock.
    fn ask<T: Send>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(wavestep::Signal<'_>) -> Result<T, Error> + Send,
    ) -> PyResult<T> {
        self.problem.ask(py, |problem| Ok(question(problem.signal(&self.name)?)?))
    }
}

/// The tolerance of values where none is given.
const USUAL: Tolerance = Tolerance::Relative(1e-12);

/// A tolerance as text, or as a number of any kind.
fn tolerance(within: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Tolerance>> {
    let Some(within) = within else { return Ok(None) };
    let text = match within.cast::<PyString>() {
        Ok(text) => text.to_string(),
        Err(_) => within.extract::<f64>()?.to_string(),
    };
    let found = text.parse::<Tolerance>();
    found.map(Some).map_err(|error| Failure::from(error).raised(within.py()))
}

/// Times in a list, exactly; those of an array, or of lists in a list, are doubles.
fn exact(times: &Bound<'_, PyAny>) -> PyResult<Option<Vec<Number>>> {
    if times.hasattr("dtype")? || times.is_instance_of::<PyString>() {
        return Ok(None);
    }
    let Ok(several) = times.cast::<PySequence>() else { return Ok(None) };
    let several = several.try_iter()?.collect::<PyResult<Vec<_>>>()?;
    for item in &several {
        if are_many(item)? {
            return Ok(None);
        }
    }
    several.iter().map(|item| item.extract()).collect::<PyResult<_>>().map(Some)
}

#[pymethods]
impl Signal {
    #[pyo3(signature = (t, out=None))]
    fn __call__<'py>(
        &self,
        t: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = t.py();
        if !are_many(t)? && out.is_none() {
            let time: Number = t.extract()?;
            let found = self.ask(py, |signal| signal.values_by(&[time], Method::Certified))?;
            return found.values[0].into_bound_py_any(py);
        }
        let unit = self.problem.time_unit(py)?;
        let work = |times: &[f64], values: &mut [f64]| {
            self.problem.with(|problem| Ok(problem.signal(&self.name)?.rounded(times, values)?))
        };
        fill((t, &unit), out, work)
    }

    /// The value with so many proven digits; the limit from later times where it jumps.
    ///
    /// >>> import wavestep as ws
    /// >>> f = ws.scene("rigid-mass", mu="1/4").signal("f")
    /// >>> print(f.digits("33/10", 30))
    /// 0.305385264408791064086396952466
    #[pyo3(signature = (t, digits=15))]
    fn digits(
        &self,
        py: Python<'_>,
        t: Number,
        #[pyo3(from_py_with = count)] digits: usize,
    ) -> PyResult<Value> {
        self.ask(py, |signal| signal.at(t, digits)).map(Value)
    }

    /// The limit from earlier times.
    #[pyo3(signature = (t, digits=15))]
    fn before(
        &self,
        py: Python<'_>,
        t: Number,
        #[pyo3(from_py_with = count)] digits: usize,
    ) -> PyResult<Value> {
        self.ask(py, |signal| signal.before(t, digits)).map(Value)
    }

    /// Values by the cheapest method that is proven to keep a tolerance, or by a method of one's choice.
    ///
    /// Times in a list are exact, whatever they are. Those in an array, or in lists of lists, are doubles, and the values have
    /// its shape. Whole numbers in arrays are rounded to doubles as well, beyond 2⁵³.
    ///
    /// `within` is a part of the largest value among them, such as `1e-9` (`1e-12` where nothing is given); `"abs:1e-9"` is in
    /// the unit of the values, `"ulp:4"` in units in the last place of the largest one. `method` is `"certified"`,
    /// `"compiled"`, `"marched"`, `"marched-unproven"`, `"stable"`, `"double-double"`, `"plain"` or `"expanded"`.
    ///
    /// >>> import wavestep as ws
    /// >>> velocity = ws.scene("rigid-mass", mu=1).signal("velocity")
    /// >>> found = velocity.values(["1/2", "3/2"], within="1e-9")
    /// >>> bool(found.errors.max() < 2e-9)
    /// True
    #[pyo3(signature = (t, *, within=None, method=None))]
    fn values<'py>(
        &self,
        t: &Bound<'py, PyAny>,
        within: Option<&Bound<'py, PyAny>>,
        method: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = t.py();
        let within = tolerance(within)?;
        if let Some(times) = exact(t)? {
            return results::doubles(py, self.chosen(py, &times, within, method)?, &[times.len()]);
        }
        let times = doubles(t, &self.problem.time_unit(py)?)?.try_readonly()?;
        let found = self.chosen(py, times.as_slice()?, within, method)?;
        results::doubles(py, found, times.shape())
    }

    /// A window made ready once: a function of times in doubles, with one proven bound for all of it.
    ///
    /// The bound is about a quarter of `within`, which is written as for `values`. Where nothing is given, or `within` asks for
    /// more than doubles hold, it is a few units in the last place of the largest value. Making it ready takes a
    /// third of a millisecond for each break of `rigid-mass`, a value then half a nanosecond.
    ///
    /// >>> import numpy as np, wavestep as ws
    /// >>> curve = ws.scene("rigid-mass", mu=1).signal("velocity").compiled(0, 10)
    /// >>> t = np.linspace(0, 10, 1001)
    /// >>> bool(abs(curve(t)[50] - np.exp(-0.5)) <= curve.bound + 1e-16)
    /// True
    #[pyo3(signature = (begin, end, *, within=None))]
    fn compiled(
        &self,
        py: Python<'_>,
        begin: Number,
        end: Number,
        within: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Curve> {
        let within = tolerance(within)?;
        let curve = self.ask(py, |signal| signal.compiled(begin..=end, within))?;
        let unit = self.problem.time_unit(py)?;
        Ok(Curve { curve, name: self.name.clone(), unit, problem: Arc::clone(&self.problem) })
    }

    /// All times of a window at which the signal takes a value, zero where no `level` is given, or jumps over it; there
    /// are no others. A root of kind `"undecided"` is an interval that may hold some, where no precision tells.
    ///
    /// >>> import wavestep as ws
    /// >>> strain = ws.scene("rigid-mass", mu=1).signal("strain_impact")
    /// >>> [(root.kind, str(root.time)) for root in strain.roots(2, 4, digits=12)]
    /// [('simple', '3.06766764162'), ('jump', '4')]
    #[pyo3(signature = (begin, end, *, level=None, digits=15))]
    fn roots<'py>(
        &self,
        py: Python<'py>,
        begin: Number,
        end: Number,
        level: Option<Number>,
        #[pyo3(from_py_with = count)] digits: usize,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let found = self.ask(py, |signal| match level {
            Some(level) => signal.crossings(level, begin..=end, digits),
            None => signal.roots(begin..=end, digits),
        })?;
        found.all.iter().map(|root| results::root(py, root)).collect()
    }

    /// The largest value of a window, with all places where it is taken.
    ///
    /// >>> import wavestep as ws
    /// >>> most = ws.scene("rigid-mass", mu=1).signal("strain_impact").maximum(0, 4)
    /// >>> str(most.value), [str(place.time) for place in most.places]
    /// ('0.252354927584491', ['4'])
    #[pyo3(signature = (begin, end, *, digits=15))]
    fn maximum<'py>(
        &self,
        py: Python<'py>,
        begin: Number,
        end: Number,
        #[pyo3(from_py_with = count)] digits: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.extremum(py, Goal::Largest, (begin, end), digits)
    }

    /// The smallest value of a window, with all places where it is taken.
    #[pyo3(signature = (begin, end, *, digits=15))]
    fn minimum<'py>(
        &self,
        py: Python<'py>,
        begin: Number,
        end: Number,
        #[pyo3(from_py_with = count)] digits: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.extremum(py, Goal::Smallest, (begin, end), digits)
    }

    /// The times of a window at which the signal may jump or bend.
    ///
    /// >>> import wavestep as ws
    /// >>> ws.scene("rigid-mass", mu=1).signal("strain_fixed").breaks(0, 6)
    /// [Value('1'), Value('3'), Value('5')]
    #[pyo3(signature = (begin, end, *, digits=15))]
    fn breaks(
        &self,
        py: Python<'_>,
        begin: Number,
        end: Number,
        #[pyo3(from_py_with = count)] digits: usize,
    ) -> PyResult<Vec<Value>> {
        let found = self.ask(py, |signal| signal.breaks(begin..=end, digits))?;
        Ok(found.into_iter().map(Value).collect())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Problem, String))> {
        let signal = slf.py().import("wavestep._convert")?.getattr("signal_of")?;
        let own = slf.get();
        Ok((signal, (Problem(Arc::clone(&own.problem)), own.name.clone())))
    }

    fn __copy__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: PyRef<'py, Self>, _memo: &Bound<'py, PyAny>) -> PyRef<'py, Self> {
        slf
    }

    fn __repr__(&self) -> String {
        format!("<signal {}>", self.name)
    }

    fn _repr_svg_(&self, py: Python<'_>) -> PyResult<String> {
        self.problem.ask(py, |problem| svg(problem, std::slice::from_ref(&self.name), None, None))
    }
}

impl Signal {
    /// Values by a method, or by the cheapest that is proven to be within a tolerance.
    fn chosen<T: Clone + Into<Given> + Sync>(
        &self,
        py: Python<'_>,
        times: &[T],
        within: Option<Tolerance>,
        method: Option<&str>,
    ) -> PyResult<Doubles> {
        if method.is_some() && within.is_some() {
            let message = "both a method and a tolerance are given";
            return Err(Failure::input(message, "give one of them").raised(py));
        }
        self.ask(py, |signal| match method {
            Some(method) => signal.values_by(times, method.parse::<Method>()?),
            None => signal.values(times, within.unwrap_or(USUAL)),
        })
    }

    fn extremum<'py>(
        &self,
        py: Python<'py>,
        goal: Goal,
        (begin, end): (Number, Number),
        digits: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let found = self.ask(py, |signal| signal.extremum(goal, begin..=end, digits))?;
        results::extremum(py, &found)
    }
}

/// A window of a signal made ready: called with times in doubles it gives values within its bound, in a new array or in
/// `out`. A time that is no float is rounded to the nearest one.
///
/// >>> import wavestep as ws
/// >>> curve = ws.scene("rigid-mass", mu=1).signal("velocity").compiled(0, 2)
/// >>> curve.window, curve.bound < 1e-14
/// ((0.0, 2.0), True)
#[pyclass(frozen, module = "wavestep")]
pub struct Curve {
    curve: wavestep::Curve,
    /// The name of the signal.
    #[pyo3(get)]
    name: String,
    /// That of times; empty for plain numbers.
    unit: String,
    /// Knows what texts and quantities mean.
    problem: Arc<Shared>,
}

impl Curve {
    /// The double nearest to a time.
    fn time(&self, t: &Bound<'_, PyAny>) -> PyResult<f64> {
        if let Ok(double) = t.cast::<PyFloat>() {
            return Ok(double.value());
        }
        let time: Number = t.extract()?;
        let time = self.problem.ask(t.py(), |problem| Ok(problem.time("time", time)?))?;
        Ok(wavestep::Value::Exact(time).to_f64())
    }
}

#[pymethods]
impl Curve {
    #[pyo3(signature = (t, out=None))]
    fn __call__<'py>(
        &self,
        t: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = t.py();
        if !are_many(t)? && out.is_none() {
            let (time, mut value) = ([self.time(t)?], [0.0]);
            released(py, || Ok(self.curve.values(&time, &mut value)?))?;
            return value[0].into_bound_py_any(py);
        }
        fill((t, &self.unit), out, |times, values| Ok(self.curve.values(times, values)?))
    }

    fn __copy__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: PyRef<'py, Self>, _memo: &Bound<'py, PyAny>) -> PyRef<'py, Self> {
        slf
    }

    /// A proven bound on the absolute error of every value, beyond half a unit in its last place.
    #[getter]
    fn bound(&self) -> f64 {
        self.curve.bound()
    }

    /// The same in words.
    #[getter]
    fn law(&self) -> &str {
        self.curve.law()
    }

    /// The first time and the last.
    #[getter]
    fn window(&self) -> (f64, f64) {
        let [from, to] = self.curve.window();
        (from, to)
    }

    fn __repr__(&self) -> String {
        let [from, to] = self.curve.window();
        format!("<{} on [{from:?}, {to:?}], {}>", self.name, self.curve.law())
    }
}
