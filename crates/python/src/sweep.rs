//! Sweeps: the rows of ranges of values as columns, on several threads.

use crate::failure::{Failure, of_picture};
use crate::given::{Number, given};
use crate::work::{on_threads, released, stop};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use std::collections::BTreeMap;
use std::thread::available_parallelism;
use wavestep::problem::Values;
use wavestep::{Given, Goal, Rational, Value};
use wavestep_studies::sweep::{
    Axis, AxisError, MOST_ROWS, Row, Sweep as Rows, TEXTS, Time, ToSweep,
};

/// More threads than that take memory and time, and gain nothing.
const MOST_THREADS: usize = 256;

/// A time with what columns call it.
type Called<T> = (String, T);

/// A sweep as it is pickled: what its constructor takes.
type Arguments<'py> = (
    [&'py str; 2],
    Values,
    Vec<(&'py str, &'py [Rational])>,
    Vec<Called<Bound<'py, PyAny>>>,
    &'py [String],
    [Vec<&'py str>; 2],
    Called<Bound<'py, PyAny>>,
    Option<Called<Bound<'py, PyAny>>>,
    bool,
);

/// A scene, the values that its symbols take, and what is asked.
#[pyclass(frozen, module = "wavestep._native", name = "_Sweep")]
pub struct Sweep {
    /// What the scene is called, and its text.
    source: [String; 2],
    set: Values,
    axes: Vec<Axis>,
    asked: ToSweep,
    /// The columns with numbers.
    columns: Vec<String>,
}

impl Sweep {
    fn rows(&self) -> Rows<'_> {
        let [name, text] = &self.source;
        Rows { text, name, set: &self.set, axes: &self.axes, asked: &self.asked }
    }

    /// Finds mistakes, and the columns.
    fn checked(mut self) -> Result<Sweep, Failure> {
        let rows = self.rows();
        if let Some(twice) = rows.twice() {
            let message = format!("two values are given for `{twice}`");
            return Err(Failure::input(message, "give its values in `over` alone"));
        }
        if rows.count().is_none() {
            let message = format!("there are more than {MOST_ROWS} combinations of values");
            return Err(Failure::input(message, "give fewer values, or sweep in parts"));
        }
        self.columns = rows.columns().map_err(of_picture)?;
        Ok(self)
    }
}

fn axis(symbol: String, values: &Bound<'_, PyAny>) -> PyResult<Axis> {
    let py = values.py();
    let form =
        "give a list such as [1, \"3/2\", 2], or text such as \"1..4:7\" or \"1/10..10:25:log\"";
    let refuse =
        |error: AxisError| Failure::input(error.to_string(), error.remedy(form)).raised(py);
    if let Ok(text) = values.cast::<PyString>() {
        return format!("{symbol}={}", text.to_str()?).parse().map_err(refuse);
    }
    let several = values.try_iter().map_err(|_| {
        Failure::input(format!("the values of `{symbol}` are not a list"), form).raised(py)
    })?;
    let number = |value: PyResult<Bound<'_, PyAny>>| {
        let number = given(&value?)?.number(&symbol);
        number.map_err(|error| Failure::from(error).raised(py))
    };
    // One more than all are refused, whatever comes after them.
    let several = several.take(MOST_ROWS + 1);
    let numbers = several.map(number).collect::<PyResult<_>>()?;
    Axis::new(&symbol, numbers).map_err(refuse)
}

fn time(option: &'static str, (label, Number(given)): Called<Number>) -> Time {
    Time { given, label, option }
}

fn called<'py>(py: Python<'py>, time: &Time) -> PyResult<Called<Bound<'py, PyAny>>> {
    let given = match &time.given {
        Given::Text(text) => text.into_pyobject(py)?.into_any(),
        Given::Exact(number) => number.into_pyobject(py)?.into_any(),
        Given::NotFinite(number) => number.into_pyobject(py)?.into_any(),
    };
    Ok((time.label.clone(), given))
}

/// Rows of a range that are not all known yet.
struct Part {
    end: usize,
    missing: usize,
    columns: Vec<Vec<f64>>,
    texts: [Vec<Option<String>>; TEXTS.len()],
}

impl Part {
    fn new(begin: usize, end: usize, columns: usize) -> Part {
        let count = end - begin;
        let columns = vec![vec![f64::NAN; count]; columns];
        Part { end, missing: count, columns, texts: TEXTS.map(|_| vec![None; count]) }
    }

    fn put(&mut self, row: usize, names: &[String], found: &Row) {
        for (column, name) in self.columns.iter_mut().zip(names) {
            column[row] = found.get(name).and_then(|cell| cell.as_f64()).unwrap_or(f64::NAN);
        }
        for (column, name) in self.texts.iter_mut().zip(TEXTS) {
            column[row] = found.get(name).and_then(|text| Some(text.as_str()?.to_owned()));
        }
        self.missing -= 1;
    }

    /// Arrays by the names of columns, and lists of texts.
    fn table<'py>(self, py: Python<'py>, names: &[String]) -> PyResult<Bound<'py, PyDict>> {
        let table = PyDict::new(py);
        for (name, column) in names.iter().zip(self.columns) {
            table.set_item(name, PyArray1::from_vec(py, column))?;
        }
        for (name, texts) in TEXTS.into_iter().zip(self.texts) {
            table.set_item(name, texts)?;
        }
        Ok(table)
    }
}

#[pymethods]
impl Sweep {
    #[new]
    #[expect(clippy::too_many_arguments, reason = "what the command takes as options")]
    fn new(
        py: Python<'_>,
        source: [String; 2],
        set: Values,
        over: Vec<(String, Bound<'_, PyAny>)>,
        at: Vec<Called<Number>>,
        quantities: Vec<String>,
        extrema: [Vec<String>; 2],
        begin: Called<Number>,
        end: Option<Called<Number>>,
        contacts: bool,
    ) -> PyResult<Sweep> {
        let axes = over.into_iter().map(|(symbol, values)| axis(symbol, &values));
        let axes = axes.collect::<PyResult<Vec<_>>>()?;
        let extrema = [Goal::Largest, Goal::Smallest].into_iter().zip(extrema);
        let extrema =
            extrema.flat_map(|(goal, names)| names.into_iter().map(move |name| (goal, name)));
        let asked = ToSweep {
            quantities,
            at: at.into_iter().map(|at| time("at", at)).collect(),
            extrema: extrema.collect(),
            from: time("begin", begin),
            to: end.map(|end| time("end", end)),
            contacts,
        };
        let sweep = Sweep { source, set, axes, asked, columns: Vec::new() };
        released(py, || sweep.checked())
    }

    fn __getnewargs__<'py>(slf: &'py Bound<'py, Sweep>) -> PyResult<Arguments<'py>> {
        let (py, Sweep { source, set, axes, asked, .. }) = (slf.py(), slf.get());
        let extrema = |wanted| {
            let of_goal = asked.extrema.iter().filter(move |(goal, _)| *goal == wanted);
            of_goal.map(|(_, name)| name.as_str()).collect()
        };
        Ok((
            source.each_ref().map(String::as_str),
            set.clone(),
            axes.iter().map(|axis| (axis.symbol.as_str(), &axis.values[..])).collect(),
            asked.at.iter().map(|at| called(py, at)).collect::<PyResult<_>>()?,
            &asked.quantities,
            [Goal::Largest, Goal::Smallest].map(extrema),
            called(py, &asked.from)?,
            asked.to.as_ref().map(|to| called(py, to)).transpose()?,
            asked.contacts,
        ))
    }

    /// How many rows there are.
    fn __len__(&self) -> usize {
        self.rows().count().unwrap_or(0)
    }

    /// All that the rows depend on, as JSON.
    #[getter]
    fn request(&self) -> String {
        self.rows().request().to_string()
    }

    /// The columns with numbers.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.columns.clone()
    }

    /// Symbols with the doubles nearest to their values.
    #[getter]
    fn axes(&self) -> Vec<(String, Vec<f64>)> {
        let doubles = |axis: &Axis| {
            let values = axis.values.iter().cloned();
            (axis.symbol.clone(), values.map(|value| Value::Exact(value).to_f64()).collect())
        };
        self.axes.iter().map(doubles).collect()
    }

    /// Works out the rows of these ranges, which do not overlap, on so many threads or all cores. Of each range that is
    /// done, `each` is told its ends and the columns.
    fn run(
        &self,
        py: Python<'_>,
        ranges: Vec<(usize, usize)>,
        threads: Option<usize>,
        each: Py<PyAny>,
    ) -> PyResult<()> {
        let (rows, columns) = (self.rows(), &self.columns);
        let threads = threads.or_else(|| Some(available_parallelism().ok()?.into())).unwrap_or(1);
        let missing: usize = ranges.iter().map(|(begin, end)| end - begin).sum();
        let threads = threads.min(missing).min(MOST_THREADS);
        let tell = |begin: usize, part: Part| {
            let told = Python::attach(|py| {
                let end = part.end;
                each.call1(py, ((begin, end), part.table(py, columns)?))
            });
            told.map(|_| ()).unwrap_or_else(|error| stop(error));
        };
        released(py, || {
            let part = |&(begin, end): &_| (begin, Part::new(begin, end, columns.len()));
            let mut parts: BTreeMap<usize, Part> = ranges.iter().map(part).collect();
            let indices = ranges.iter().flat_map(|(begin, end)| *begin..*end);
            on_threads(
                indices,
                threads,
                |index| rows.row(index),
                |index, row| {
                    let mut entries = parts.range_mut(..=index);
                    let (&begin, part) = entries.next_back().expect("a range with this index");
                    part.put(index - begin, columns, &row);
                    if part.missing == 0 {
                        let part = parts.remove(&begin).expect("the part above");
                        tell(begin, part);
                    }
                },
            );
            Ok(())
        })
    }
}
