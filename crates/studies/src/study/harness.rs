//! One way on one question: its error and its time.

use crate::study::reference::Reference;
use std::time::{Duration, Instant};
use wavestep::answer::{Method, Question, Way, WayError};
use wavestep::problem::{Problem, ProblemError};
use wavestep_polynomial::Rational;

/// What is studied: a quantity of a problem, on any window.
#[derive(Clone, Copy)]
pub struct Subject<'p> {
    pub problem: &'p Problem,
    pub quantity: &'p str,
}

impl<'p> Subject<'p> {
    /// The question on the window between two times.
    pub fn between(self, from: f64, to: f64) -> Result<Question<'p>, ProblemError> {
        let window = [from, to].map(|time| Rational::from_float(time).unwrap_or_default());
        self.problem.question(self.quantity, window)
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Settings {
    /// How often at least; the least time counts.
    pub runs: usize,
    pub time: Duration,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings { runs: 3, time: Duration::from_millis(30) }
    }
}

/// What was measured of a way. [`measure`] makes one.
#[derive(Clone, PartialEq, Debug)]
pub struct Measured {
    pub method: Method,
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
pub fn worst(errors: &[f64]) -> f64 {
    let larger = |worst: f64, error: &f64| match error.is_nan() {
        true => f64::INFINITY,
        false => worst.max(*error),
    };
    errors.iter().fold(0.0, larger)
}

/// The errors of a way at the times of a reference.
pub fn errors(
    question: &Question<'_>,
    method: Method,
    reference: &Reference,
) -> Result<Vec<f64>, WayError> {
    let way = Way::new(method, question, None)?;
    Ok(reference.errors(&way.values(reference.times())?))
}

/// The time of a preparation and the first values, when nothing is known of the signal.
fn from_scratch(
    question: &Question<'_>,
    (method, tolerance): (Method, Option<f64>),
    reference: &Reference,
) -> Result<Duration, WayError> {
    // Whether there is a closed form is part of the question.
    let _ = question.signal.closed_form();
    let begin = Instant::now();
    let way = Way::new(method, question, tolerance)?;
    std::hint::black_box(way.values(std::hint::black_box(reference.times()))?);
    Ok(begin.elapsed())
}

/// The least time of several runs; what takes longer than `enough` is not repeated.
pub(super) fn least<E>(
    settings: Settings,
    enough: Duration,
    mut run: impl FnMut() -> Result<Duration, E>,
) -> Result<Duration, E> {
    let (begin, mut runs, mut least) = (Instant::now(), 0, Duration::MAX);
    while (runs < settings.runs || begin.elapsed() < settings.time) && !(runs > 0 && least > enough)
    {
        least = least.min(run()?);
        runs += 1;
    }
    Ok(least)
}

/// Prepares a way, compares it with a reference, and takes its time there.
///
/// Each preparation begins with a signal of which nothing is computed; the least of some counts.
pub fn measure(
    (subject, window): (Subject<'_>, [&Rational; 2]),
    (method, tolerance): (Method, Option<f64>),
    reference: &Reference,
    settings: Settings,
) -> Result<Measured, ProblemError> {
    let anew = || subject.problem.question(subject.quantity, window.map(Clone::clone));
    let (begin, mut question) = (Instant::now(), anew()?);
    let mut first = from_scratch(&question, (method, tolerance), reference)?;
    for _ in 1..settings.runs {
        if begin.elapsed() > 10 * settings.time {
            break;
        }
        question = anew()?;
        first = first.min(from_scratch(&question, (method, tolerance), reference)?);
    }
    let way = Way::new(method, &question, tolerance)?;
    let values = way.values(reference.times())?;
    // What takes long is not repeated for the sake of a third digit.
    let least = least(settings, 10 * settings.time, || {
        let begin = Instant::now();
        std::hint::black_box(way.values(std::hint::black_box(reference.times()))?);
        Ok::<_, WayError>(begin.elapsed())
    })?;
    let half_ulp = f64::EPSILON / 2.0;
    Ok(Measured {
        method,
        error: worst(&reference.errors(&values)),
        bound: way.bound().map(|bound| bound / reference.unit() + half_ulp),
        preparation: first.saturating_sub(least).as_secs_f64(),
        seconds: least.as_secs_f64() / reference.times().len().max(1) as f64,
    })
}
