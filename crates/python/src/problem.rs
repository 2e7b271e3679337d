//! Problems: what is read, and what can be asked of it.

use crate::failure::{Failure, of_picture};
use crate::formula::Formula;
use crate::given::{Number, count, values};
use crate::results;
use crate::signal::Signal;
use crate::work::{pause, released};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::sync::{Arc, Mutex, TryLockError};
use std::thread;
use std::time::Duration;
use wavestep::limits::MAX_ORDER;
use wavestep::problem::Values;
use wavestep::{Error, Given, Problem as Read, Quantity};
use wavestep_draw::{Caption, Chart as _};
use wavestep_studies::picture::{self, against_time, courses, lagrange};
use wavestep_studies::validity::pulling;

/// How long a thread waits before it looks again whether it may ask.
const WAIT: Duration = Duration::from_micros(200);

/// A problem that several threads may ask, one at a time.
pub struct Shared(Mutex<Read>);

impl Shared {
    /// Asks on a thread that has released the interpreter's lock. Work that was stopped leaves a problem as it was.
    pub fn with<T>(
        &self,
        question: impl FnOnce(&Read) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        loop {
            match self.0.try_lock() {
                Ok(problem) => return question(&problem),
                Err(TryLockError::Poisoned(problem)) => return question(&problem.into_inner()),
                // Another thread asks; Ctrl-C stops this one all the same.
                Err(TryLockError::WouldBlock) => {
                    thread::sleep(WAIT);
                    pause();
                }
            }
        }
    }

    /// The unit of times, empty for plain numbers.
    pub fn time_unit(&self, py: Python<'_>) -> PyResult<String> {
        self.ask(py, |problem| Ok(problem.time_unit().to_owned()))
    }

    /// Asks without the interpreter's lock.
    pub fn ask<T: Send>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&Read) -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        released(py, || self.with(question))
    }
}

/// A scene, or equations, that was read, with values in place of symbols.
///
/// >>> import wavestep as ws
/// >>> p = ws.scene("rigid-mass", mu="1/4")
/// >>> p.title, p.waves
/// ('Rigid mass on a fixed bar', ['f', 'g'])
#[pyclass(frozen, module = "wavestep")]
pub struct Problem(pub Arc<Shared>);

/// A problem with more values.
fn with_values(mut problem: Read, values: Vec<(String, Given)>) -> Result<Read, Error> {
    for (name, value) in values {
        problem = problem.with(&name, value)?;
    }
    Ok(problem)
}

/// Observables on a window as a picture.
pub fn svg(
    problem: &Read,
    names: &[String],
    begin: Option<Given>,
    end: Option<Given>,
) -> Result<String, Failure> {
    let [from, to] = window(problem, begin, end)?;
    let found = courses(problem, names, [&from, &to]).map_err(of_picture)?;
    let ends = [from, to].map(|time| wavestep::Value::Exact(time).to_f64());
    let (title, units) = (problem.title(), problem.has_units());
    let figure = against_time(title, &found, units, ends.into(), Caption::default());
    Ok(figure.map_err(of_picture)?.svg())
}

fn window(
    problem: &Read,
    begin: Option<Given>,
    end: Option<Given>,
) -> Result<[wavestep::Rational; 2], Failure> {
    let time =
        |name, given: Option<Given>| given.map(|given| problem.time(name, given)).transpose();
    let (from, to) = (time("begin", begin)?.unwrap_or_default(), time("end", end)?);
    picture::window(problem, from, to).map_err(of_picture)
}

impl Problem {
    fn of(py: Python<'_>, read: impl FnOnce() -> Result<Read, Error> + Send) -> PyResult<Problem> {
        let problem = released(py, || Ok(read()?))?;
        Ok(Problem(Arc::new(Shared(Mutex::new(problem)))))
    }

    fn names(&self, py: Python<'_>, names: fn(&Read) -> Vec<&str>) -> PyResult<Vec<String>> {
        let owned = |problem: &Read| names(problem).into_iter().map(str::to_owned).collect();
        self.0.ask(py, |problem| Ok(owned(problem)))
    }

    /// A picture as an object that notebooks show.
    fn picture<'py>(
        &self,
        py: Python<'py>,
        draw: impl FnOnce(&Read) -> Result<String, Failure> + Send,
    ) -> PyResult<Bound<'py, PyAny>> {
        let svg = self.0.ask(py, draw)?;
        py.import("wavestep._results")?.getattr("Picture")?.call1((svg,))
    }
}

#[pymethods]
impl Problem {
    /// The built-in scene of this name.
    #[staticmethod]
    fn _builtin(py: Python<'_>, name: &str, given: &Bound<'_, PyDict>) -> PyResult<Problem> {
        let given = values(Some(given))?;
        Problem::of(py, || with_values(Read::builtin(name)?, given))
    }

    /// A text that errors call by this name.
    #[staticmethod]
    fn _read(
        py: Python<'_>,
        name: &str,
        text: &str,
        given: &Bound<'_, PyDict>,
    ) -> PyResult<Problem> {
        let given = values(Some(given))?;
        Problem::of(py, || Read::read_with(name, text, given))
    }

    /// The same with values in place of symbols.
    ///
    /// >>> import wavestep as ws
    /// >>> ws.scene("rigid-mass").with_values(mu="1/4").symbols
    /// []
    #[pyo3(signature = (**given))]
    fn with_values(&self, py: Python<'_>, given: Option<&Bound<'_, PyDict>>) -> PyResult<Problem> {
        let given = values(given)?;
        let problem = self.0.ask(py, |problem| {
            let mut given = given.into_iter();
            match given.next() {
                Some((name, value)) => {
                    Ok(Some(with_values(problem.with(&name, value)?, given.collect())?))
                }
                None => Ok(None),
            }
        })?;
        Ok(match problem {
            Some(problem) => Problem(Arc::new(Shared(Mutex::new(problem)))),
            None => Problem(Arc::clone(&self.0)),
        })
    }

    /// What errors call the text, the text, and the values in place of symbols.
    fn _source(&self, py: Python<'_>) -> PyResult<([String; 2], Values)> {
        self.0.ask(py, |problem| {
            let source = problem.source();
            let text = [source.name(), source.text()].map(str::to_owned);
            Ok((text, problem.values().clone()))
        })
    }

    /// The title.
    #[getter]
    fn title(&self, py: Python<'_>) -> PyResult<String> {
        self.0.ask(py, |problem| Ok(problem.title().to_owned()))
    }

    /// The symbols that have no value yet.
    #[getter]
    fn symbols(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.names(py, Read::symbols)
    }

    /// What is observed.
    #[getter]
    fn observables(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.names(py, Read::observables)
    }

    /// The waves.
    #[getter]
    fn waves(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.names(py, Read::waves)
    }

    /// The unit of times, empty for plain numbers.
    #[getter]
    fn time_unit(&self, py: Python<'_>) -> PyResult<String> {
        self.0.time_unit(py)
    }

    /// In which units formulas are, and what the named constants in them are, a line each.
    fn scales(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.0.ask(py, |problem| Ok(problem.scales()?))
    }

    /// Exact functions of a wave or an observable on the periods of these orders, in local time since the period began;
    /// orders that follow each other are derived together. Velocities and forces are in the units that `scales` tells.
    ///
    /// Refused are orders above 2000, functions that would be too long, and waves of scenes whose contacts open. Lengths
    /// grow fast: `f[80]` of `rigid-mass`, with `mu` as a symbol, has 88,641 terms.
    ///
    /// >>> import wavestep as ws
    /// >>> for f in ws.scene("rigid-mass").derive("f", range(2)):
    /// ...     print(f)
    /// f[0](s) = exp(-s)
    /// f[1](s) = exp(-s)*(-2*s + 1 + exp(-2*mu))
    fn derive(
        &self,
        py: Python<'_>,
        name: &str,
        orders: &Bound<'_, PyAny>,
    ) -> PyResult<Vec<Formula>> {
        let orders: Vec<usize> = match orders.hasattr("__iter__")? {
            true => {
                let orders = orders.try_iter()?.take(MAX_ORDER + 2);
                orders.map(|n| count(&n?)).collect::<PyResult<_>>()?
            }
            false => vec![count(orders)?],
        };
        if orders.len() > MAX_ORDER + 1 {
            let message = format!("more than {} orders are asked for", MAX_ORDER + 1);
            return Err(Failure::input(message, "give fewer at a time").raised(py));
        }
        let formulas = self.0.ask(py, |problem| {
            let mut formulas = Vec::new();
            for run in orders.chunk_by(|one, next| one.checked_add(1) == Some(*next)) {
                formulas.extend(problem.derive(name, run[0]..=run[run.len() - 1])?);
            }
            Ok(formulas)
        })?;
        Ok(formulas.into_iter().map(Formula).collect())
    }

    /// A wave on every period, proved by substitution.
    ///
    /// >>> import wavestep as ws
    /// >>> str(ws.scene("two-bars").general("F")[0]).startswith("F[n] = r/(1 + r)*((r - 1)/(r + 1))^n")
    /// True
    fn general(&self, py: Python<'_>, wave: &str) -> PyResult<Vec<Formula>> {
        let formulas = self.0.ask(py, |problem| Ok(problem.general(wave)?))?;
        Ok(formulas.into_iter().map(Formula).collect())
    }

    /// What answers until a time take for granted: that a contact pulls, which stays closed, or what no precision decides.
    ///
    /// >>> import wavestep as ws
    /// >>> ws.scene("hopkinson").notes(until="1 ms")[0][:60]
    /// 'from t = 0.000580024630019 s on, the contact between striker'
    fn notes(&self, py: Python<'_>, until: Number) -> PyResult<Vec<String>> {
        self.0.ask(py, |problem| {
            let pulling = pulling(problem, &problem.time("until", until)?);
            let assumed = problem.assumptions().into_iter();
            Ok(pulling
                .into_iter()
                .chain(assumed.map(|told| format!("assuming that {told}")))
                .collect())
        })
    }

    /// A wave or an observable as a function of time.
    fn signal(&self, py: Python<'_>, name: &str) -> PyResult<Signal> {
        let found = |problem: &Read| {
            let signal = problem.signal(name)?;
            Ok((signal.name().to_owned(), signal.unit()))
        };
        let (name, unit) = self.0.ask(py, found)?;
        Ok(Signal { problem: Arc::clone(&self.0), name, unit })
    }

    /// What contacts do, until a time or until nothing can meet again; where no time is given at most for a hundred of the
    /// longest travel times, or ten beside a local contact. `digits` are proven of each time, force and velocity.
    ///
    /// >>> import wavestep as ws
    /// >>> for event in ws.scene("saint-venant", mu=1).events(until=4).events:
    /// ...     print(event.kind, event.time)
    /// impact 0
    /// opening 3.06766764161831
    #[pyo3(signature = (until=None, *, digits=15))]
    fn events<'py>(
        &self,
        py: Python<'py>,
        until: Option<Number>,
        #[pyo3(from_py_with = count)] digits: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let found = self.0.ask(py, |problem| match until {
            Some(until) => Ok(problem.events_until(until, digits)?),
            None => Ok(problem.events(digits)?),
        })?;
        results::history(py, &found)
    }

    /// Velocity, strain, displacement and force along the bars at a time: at the ends of `cells` equal cells of each bar,
    /// `cells + 1` values, or as averages over the cells, `cells` values.
    ///
    /// They are in SI units where the scene has units; tension and strains in tension are positive. Each value has its own
    /// proven bound. Symbols need values.
    ///
    /// >>> import wavestep as ws
    /// >>> bar = ws.scene("hopkinson").field("100 us", cells=10).bars[0]
    /// >>> bar.name, bar.force.shape
    /// ('striker', (11,))
    #[pyo3(signature = (t, *, cells=100, averages=false))]
    fn field<'py>(
        &self,
        py: Python<'py>,
        t: Number,
        #[pyo3(from_py_with = count)] cells: usize,
        averages: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let found = self.0.ask(py, |problem| match averages {
            true => Ok(problem.field_averages(t, cells)?),
            false => Ok(problem.field(t, cells)?),
        })?;
        results::fields(py, &found)
    }

    /// Waves or observables against time, all observables where none is named, on a window or some periods.
    ///
    /// >>> import wavestep as ws
    /// >>> ws.scene("hopkinson").plot("force", end="500 us").svg.startswith("<svg")
    /// True
    #[pyo3(signature = (*names, begin=None, end=None))]
    fn plot<'py>(
        &self,
        names: &Bound<'py, PyTuple>,
        begin: Option<Number>,
        end: Option<Number>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let chosen: Vec<String> = names.extract()?;
        let [begin, end] = [begin, end].map(|time| time.map(Given::from));
        self.picture(names.py(), |problem| svg(problem, &chosen, begin, end))
    }

    /// Velocity, strain or force over place and time.
    ///
    /// >>> import wavestep as ws
    /// >>> ws.scene("hopkinson").diagram("strain", end="300 us").svg.startswith("<svg")
    /// True
    #[pyo3(signature = (quantity="velocity", *, begin=None, end=None))]
    fn diagram<'py>(
        &self,
        py: Python<'py>,
        quantity: &str,
        begin: Option<Number>,
        end: Option<Number>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let [begin, end] = [begin, end].map(|time| time.map(Given::from));
        self.picture(py, |problem| {
            let found = Quantity::ALL.into_iter().find(|known| known.name() == quantity);
            let quantity = found.ok_or_else(|| {
                let message = format!("there is no diagram of `{quantity}`");
                Failure::input(message, "give velocity, strain or force")
            })?;
            let [from, to] = window(problem, begin, end)?;
            let evaluator = problem.field_evaluator(&to)?;
            let diagram = lagrange(&evaluator, quantity, [&from, &to], Caption::default());
            Ok(diagram.map_err(of_picture)?.svg())
        })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let read = slf.py().import("wavestep._convert")?.getattr("problem_of")?;
        Ok((read, slf.call_method0("_source")?))
    }

    fn __copy__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: PyRef<'py, Self>, _memo: &Bound<'py, PyAny>) -> PyRef<'py, Self> {
        slf
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<problem {:?}>", self.title(py)?))
    }

    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("wavestep._convert")?.call_method1("html_of", (slf,))
    }
}
