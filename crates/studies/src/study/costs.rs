//! The costs by which ways are weighed, measured on this machine.
//!
//! Each is taken from the method whose cost it makes up, at one size: the rigid mass with `μ = 1` and 200 periods, and a
//! recurrence of two poles for what is marched wave by wave. Run it on a quiet machine; the clock counts.

use crate::study::harness::{Settings, least};
use std::hint::black_box;
use std::time::{Duration, Instant};
use wavestep::answer::{Costs, PIECES, TERMS, Work, coefficients};
use wavestep::problem::{Problem, ProblemError, Values};
use wavestep::scenes;
use wavestep::signal::{
    Certified, Compiled, Evaluator, Limit, Marched, MethodError, Summation, Summed,
};
use wavestep_polynomial::Rational;

/// The order at which costs are measured, and the count of echoes that a value sums.
const ORDER: i64 = 200;
const PERIODS: f64 = (ORDER + 1) as f64;
const ECHOES: f64 = PERIODS * PERIODS / 2.0;

/// The orders at which values and pieces without a march are measured: pieces take far longer.
const BALL_ORDER: i64 = 60;
const TERM_ORDER: i64 = 10;

/// Less than any work takes: a difference of two times may come out as nothing.
const NOTHING: f64 = 1e-12;

const TWO_POLES: &str = r#"
recurrence "Two poles"
period 2, local s, time t
wave h, f
equation h[n]' + h[n] = h[n-1]' - h[n-1]
equation f[n]' + 2*f[n] = h[n]
continuous h[n] - h[n-1] starts at 1
continuous f[n] starts at 0
"#;

/// Why a cost cannot be measured.
type Failed = wavestep::answer::WayError;

/// Measures all costs; each kind of work is repeated for so long, three times at least.
///
/// # Errors
/// [`ProblemError`] where a method has no values: none is known.
pub fn measured_costs(each: Duration) -> Result<Costs, ProblemError> {
    let settings = Settings { runs: 3, time: each };
    let mut found = [(Work::Echo, 0.0); Work::ALL.len()];
    let mut places = found.iter_mut();
    let mut put = |work, seconds: f64| {
        *places.next().expect("a place for each work") = (work, seconds.max(NOTHING));
    };
    one_pole(settings, &mut put)?;
    two_poles(settings, &mut put)?;
    let of = |work| found.iter().find(|(known, _)| *known == work).expect("all are measured").1;
    Ok(Costs::measured("as measured now", of))
}

/// Seconds of a call, the least of some.
fn seconds<T>(
    settings: Settings,
    mut work: impl FnMut() -> Result<T, MethodError>,
) -> Result<f64, Failed> {
    let run = || {
        let start = Instant::now();
        black_box(work()?);
        Ok::<_, MethodError>(start.elapsed())
    };
    Ok(least(settings, Duration::MAX, run)?.as_secs_f64())
}

/// A time shortly before the end of so many periods of 2.
fn late(order: i64) -> Rational {
    Rational::new((6 * order - 1).into(), 3.into())
}

fn one_pole(settings: Settings, put: &mut impl FnMut(Work, f64)) -> Result<(), ProblemError> {
    let text = scenes::find("rigid-mass").expect("a built-in scene").text;
    let values = Values::from([("mu".to_owned(), Rational::from_integer(1.into()))]);
    let problem = Problem::of_text("costs", text, &values)?;
    let question =
        problem.question("f", [0, 2 * ORDER].map(|t| Rational::from_integer(t.into())))?;
    let (signal, late) = (&*question.signal, late(ORDER));
    let value = |method: &dyn Evaluator| seconds(settings, || method.value(&late, Limit::Right));
    let certified = |times: &[Rational]| {
        seconds(settings, || Certified::new(signal)?.exact_values(times, Limit::Right))
    };
    let many: Vec<Rational> =
        (1..1000).map(|i| &late * &Rational::new(i.into(), 1000.into())).collect();
    let one = certified(std::slice::from_ref(&late))?;
    put(Work::FixedPeriod, one / PERIODS);
    put(Work::FixedPoint, (certified(&many)? - one) / many.len() as f64);
    let pieces = seconds(settings, || Compiled::new(signal, None))?;
    put(Work::Moved, pieces / (PIECES * PERIODS));
    let compiled = Compiled::new(signal, None).map_err(Failed::from)?;
    put(Work::Lookup, value(&compiled)?);
    for (work, precision) in
        [(Work::Step, Summation::Scaled), (Work::PairStep, Summation::DoubleDouble)]
    {
        put(work, value(&Summed::new(signal, precision).map_err(Failed::from)?)? / ECHOES);
    }
    let plain = seconds(settings, || Marched::new(signal))?;
    let proven = seconds(settings, || Marched::proven(signal))?;
    let marched = value(&Marched::new(signal).map_err(Failed::from)?)?;
    put(Work::Coefficient, marched / coefficients(PERIODS));
    put(Work::ProvenCoefficient, (proven - plain) / coefficients(PERIODS));
    Ok(())
}

fn two_poles(settings: Settings, put: &mut impl FnMut(Work, f64)) -> Result<(), ProblemError> {
    let problem = Problem::of_text("costs", TWO_POLES, &Values::new())?;
    let until = |order: i64| {
        problem.question("f", [0, 2 * order].map(|t| Rational::from_integer(t.into())))
    };
    let certified = |times: &[Rational]| {
        seconds(settings, || {
            // Anew, so that nothing is known.
            let question = until(BALL_ORDER).expect("a window that was asked for");
            Certified::new(&*question.signal)?.exact_values(times, Limit::Right)
        })
    };
    let latest = late(BALL_ORDER);
    let many: Vec<Rational> =
        (1..200).map(|i| &latest * &Rational::new(i.into(), 200.into())).collect();
    let one = certified(std::slice::from_ref(&latest))?;
    let n = (BALL_ORDER + 1) as f64;
    put(Work::Echo, one / (n * n / 2.0));
    put(Work::Ball, (certified(&many)? - one) / (many.len() as f64 * n));
    let question = until(TERM_ORDER)?;
    let made = seconds(settings, || Compiled::new(&*question.signal, None))?;
    let n = (TERM_ORDER + 1) as f64;
    put(Work::Term, made / (PIECES * n * TERMS * n));
    let question = until(ORDER)?;
    let march = Marched::new(&*question.signal).map_err(Failed::from)?;
    let value = seconds(settings, || march.value(&late(ORDER), Limit::Right))?;
    put(Work::Wave, value / (2.0 * PERIODS));
    Ok(())
}
