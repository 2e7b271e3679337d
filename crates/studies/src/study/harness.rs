//! One way on one problem: its error and its time.

use crate::study::reference::Reference;
use std::time::{Duration, Instant};
use wavestep::answer::{Kind, Problem, Way, WayError};

/// How long is measured.
///
/// ```
/// use wavestep_studies::study::Settings;
///
/// // The least of some runs counts, so that one run is not enough.
/// assert!(Settings::default().runs > 1 && !Settings::default().time.is_zero());
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Settings {
    /// How often at least; the least time counts.
    pub runs: usize,
    /// For how long at least.
    pub time: Duration,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings { runs: 3, time: Duration::from_millis(30) }
    }
}

/// What was measured of a way. [`measure`] makes one.
///
/// ```
/// use wavestep::answer::Kind;
/// use wavestep_studies::study::Measured;
///
/// let measured = |error| Measured {
///     kind: Kind::Certified,
///     error,
///     bound: Some(f64::EPSILON / 2.0),
///     preparation: 0.0,
///     seconds: 1e-6,
/// };
/// // A bound that is proven is kept; an error above it would refute the proof.
/// let is_kept = |measured: Measured| measured.bound.is_none_or(|bound| measured.error <= bound);
/// assert!(is_kept(measured(1e-16)) && !is_kept(measured(2e-16)));
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Measured {
    /// Which way.
    pub kind: Kind,
    /// The largest error, in parts of the largest value.
    pub error: f64,
    /// The proven bound, in parts of the largest value, half a unit in the last place included.
    pub bound: Option<f64>,
    /// Seconds before the first value.
    pub preparation: f64,
    /// Seconds a value after that.
    pub seconds: f64,
}

/// The largest of some errors; infinite where one is no number.
///
/// ```
/// use wavestep_studies::study::worst;
///
/// assert_eq!(worst(&[1e-3, 2e-3, 0.0]), 2e-3);
/// assert_eq!(worst(&[1e-3, f64::NAN]), f64::INFINITY);
/// ```
pub fn worst(errors: &[f64]) -> f64 {
    let larger = |worst: f64, error: &f64| match error.is_nan() {
        true => f64::INFINITY,
        false => worst.max(*error),
    };
    errors.iter().fold(0.0, larger)
}

/// The errors of a way at the times of a reference.
///
/// # Errors
/// [`WayError`], where the problem is none for this way.
///
/// ```
/// use wavestep::answer::{Kind, Problem};
/// use wavestep::evaluate::Signal;
/// use wavestep::language::{Source, parse_number, read_recurrence};
/// use wavestep_studies::study::{Reference, Sampling, errors, worst};
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = [("mu".to_owned(), parse_number("1")?)].into();
/// let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &values)?;
/// let signal = Signal::of_recurrence(&recurrence, &recurrence.observation("f").unwrap()).unwrap();
/// let (from, to) = (parse_number("0")?, parse_number("100")?);
/// let problem = Problem { signal: &signal, scene: None, recognise: &|_, _| Ok(None), from, to };
/// let times = Sampling { points: 60, seed: 1 }.times(0.0, 100.0);
/// let reference = Reference::new(&problem, &times).unwrap();
/// // By n = 50 the formula as printed has lost all digits; the stable sum has not.
/// let of = |kind: &str| worst(&errors(&problem, kind.parse().unwrap(), &reference).unwrap());
/// assert!(of("expanded") > 1e-3 && of("stable") < 1e-14);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn errors(
    problem: &Problem<'_>,
    kind: Kind,
    reference: &Reference,
) -> Result<Vec<f64>, WayError> {
    let way = Way::new(kind, problem, None)?;
    Ok(reference.errors(&way.values(reference.times())?))
}

/// The time of a preparation and the first values, when nothing is known of the signal.
fn from_scratch(
    problem: &Problem<'_>,
    (kind, tolerance): (Kind, Option<f64>),
    reference: &Reference,
) -> Result<Duration, WayError> {
    let signal = problem.signal.clone();
    let (from, to) = (problem.from.clone(), problem.to.clone());
    let problem = Problem { signal: &signal, from, to, ..*problem };
    let begin = Instant::now();
    let way = Way::new(kind, &problem, tolerance)?;
    std::hint::black_box(way.values(std::hint::black_box(reference.times()))?);
    Ok(begin.elapsed())
}

/// Prepares a way, compares it with a reference, and takes its time there.
///
/// Each preparation begins with a signal of which nothing is computed; the least of some counts.
///
/// # Errors
/// [`WayError`], where the problem is none for this way.
///
/// ```
/// use std::time::Duration;
/// use wavestep::answer::{Kind, Problem};
/// use wavestep_studies::study::{Reference, Sampling, Settings, measure};
/// # use wavestep::evaluate::Signal;
/// # use wavestep::language::{Source, parse_number, read_recurrence};
/// # let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// # let values = [("mu".to_owned(), parse_number("1")?)].into();
/// # let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &values)?;
/// # let signal = Signal::of_recurrence(&recurrence, &recurrence.observation("f").unwrap()).unwrap();
/// # let (from, to) = (parse_number("0")?, parse_number("8")?);
/// # let problem = Problem { signal: &signal, scene: None, recognise: &|_, _| Ok(None), from, to };
/// let times = Sampling { points: 40, seed: 1 }.times(0.0, 8.0);
/// let reference = Reference::new(&problem, &times).unwrap();
/// let settings = Settings { runs: 1, time: Duration::ZERO };
/// let measured = measure(&problem, (Kind::Compiled, Some(1e-9)), &reference, settings).unwrap();
/// assert!(measured.error <= measured.bound.unwrap() && measured.bound.unwrap() <= 1e-9);
/// assert!(measured.seconds > 0.0);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn measure(
    problem: &Problem<'_>,
    (kind, tolerance): (Kind, Option<f64>),
    reference: &Reference,
    settings: Settings,
) -> Result<Measured, WayError> {
    let mut first = Duration::MAX;
    let begin = Instant::now();
    for _ in 0..settings.runs.max(1) {
        first = first.min(from_scratch(problem, (kind, tolerance), reference)?);
        if begin.elapsed() > 10 * settings.time {
            break;
        }
    }
    let way = Way::new(kind, problem, tolerance)?;
    let values = way.values(reference.times())?;
    let mut least = Duration::MAX;
    let begin = Instant::now();
    let mut runs = 0;
    while runs < settings.runs || begin.elapsed() < settings.time {
        let begin = Instant::now();
        std::hint::black_box(way.values(std::hint::black_box(reference.times()))?);
        least = least.min(begin.elapsed());
        runs += 1;
        // What takes long is not repeated for the sake of a third digit.
        if least > 10 * settings.time {
            break;
        }
    }
    let scale = if reference.scale() == 0.0 { 1.0 } else { reference.scale() };
    let half_ulp = f64::EPSILON / 2.0;
    Ok(Measured {
        kind,
        error: worst(&reference.errors(&values)),
        bound: way.bound().map(|bound| bound / scale + half_ulp),
        preparation: first.saturating_sub(least).as_secs_f64(),
        seconds: least.as_secs_f64() / reference.times().len().max(1) as f64,
    })
}
