//! Which way is the cheapest whose proven bound meets a tolerance.

use crate::answer::cost::{Cost, Size};
use crate::answer::method::Method;
use crate::answer::question::Question;
use crate::ball::unit_in_the_last_place;
use crate::limits::MAX_PIECES;
use crate::signal::{EvaluateError, NoTaps, StablePrecision, Taps};

/// The methods that are weighed; models leave something out and are picked by name only.
const METHODS: [Method; 7] = [
    Method::Certified,
    Method::Compiled,
    Method::Marched { proven: true },
    Method::Stable(StablePrecision::Double),
    Method::Stable(StablePrecision::DoubleDouble),
    Method::Plain,
    Method::Expanded,
];

/// The bound of compiled polynomials that can be relied on, in units in the last place of the largest
/// value.
const COMPILED_ULPS: f64 = 4.0;

/// What a march with a proven bound loses a period, in units in the last place of the largest value.
const MARCHED_ULPS: f64 = 40.0;

/// What a march with several poles or lags was off by at most, relative to the largest value.
const MARCHED_WAVES: f64 = 1e-13;

/// How far off a way can be, as known before it is tried.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Promise {
    /// A bound that will be proven.
    Proven(f64),
    Measured(f64),
    Nothing,
}

/// A way that was weighed.
#[derive(Clone, PartialEq, Debug)]
pub struct Candidate {
    pub method: Method,
    /// How far off it can be; `None` where it has no values.
    pub promise: Option<Promise>,
    /// What it costs, in seconds, by the table.
    pub seconds: f64,
    pub verdict: Verdict,
}

/// Why a way was picked or not.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum Verdict {
    #[error("the cheapest that is proven to be accurate enough")]
    Picked,
    #[error("proven to be accurate enough")]
    GoodEnough,
    #[error("its bound is expected to exceed the tolerance")]
    BoundTooLarge,
    #[error("its error is measured, not proven")]
    Measured,
    #[error("no bound here: its error is measured, not proven")]
    MeasuredHere,
    #[error("no bound on its error")]
    NoPromise,
    #[error("has no values: {0}")]
    NotEvaluated(EvaluateError),
    #[error("has no values: {0}")]
    NoTaps(NoTaps),
    #[error("has no values: more than {MAX_PIECES} periods")]
    TooManyPeriods,
}

/// The ways that were weighed, the one that was picked first.
#[derive(Clone, PartialEq, Debug)]
pub struct Weighed {
    pub candidates: Vec<Candidate>,
    /// Whether the first is good enough.
    pub met: bool,
    /// Where the costs come from.
    pub costs: String,
}

/// Weighs all methods: picks the cheapest by the table of costs whose proven bound meets a tolerance
/// in the unit of the values; the largest of these is about `scale`.
pub fn consider(
    question: &Question<'_>,
    points: usize,
    tolerance: f64,
    scale: f64,
) -> Result<Weighed, EvaluateError> {
    let (order, periods) = (question.order()?, question.periods()?);
    let form = question.signal.closed_form();
    let taps = form.as_ref().map(|form| Taps::of(form));
    let marches = matches!((&form, &taps), (Ok(form), Ok(Ok(taps))) if taps.is_rational() && form.is_rational());
    let followed = matches!(form, Err(EvaluateError::NoClosedForm));
    let size = Size { order, points, marches, followed };
    // Echoes that are left out are so where pieces are made; a march or a sum goes through all periods.
    let size_of = |method: Method| match method {
        Method::Certified | Method::Compiled | Method::Expanded => size,
        _ => Size { order: periods, ..size },
    };
    let ulp = unit_in_the_last_place(scale);
    let left_out = question.signal.left_out().scale(1).to_double();
    let candidate = |method: Method| {
        let cost = match (method, &form, &taps) {
            (Method::Marched { .. }, Ok(form), Ok(Err(_))) => {
                Some(Cost::of_waves(size_of(method), form.recurrence.wave_count(), question.costs))
            }
            _ => Cost::of(method, size_of(method), question.costs),
        };
        let seconds = cost.map_or(f64::INFINITY, |cost| cost.seconds(points));
        let told = |promise, verdict| Candidate { method, promise, seconds, verdict };
        match (method, &taps) {
            (Method::Certified | Method::Compiled, _) | (_, Ok(Ok(_))) => {}
            (_, Err(reason)) => return told(None, Verdict::NotEvaluated((*reason).clone())),
            (Method::Expanded, _) => {}
            (Method::Marched { .. }, Ok(Err(reason))) if *reason != NoTaps::NoGrid => {
                let promise = Some(Promise::Measured(MARCHED_WAVES * scale));
                return told(promise, Verdict::MeasuredHere);
            }
            (_, Ok(Err(reason))) => return told(None, Verdict::NoTaps(reason.clone())),
        }
        // Of a scene that is followed these are cells, as many as it takes.
        if form.is_ok()
            && order > MAX_PIECES
            && matches!(method, Method::Certified | Method::Compiled | Method::Expanded)
        {
            return told(None, Verdict::TooManyPeriods);
        }
        let promise = match method {
            // Twice what is left out.
            Method::Certified => Promise::Proven((ulp / 2.0).max(left_out)),
            Method::Compiled => Promise::Proven((COMPILED_ULPS * ulp).max(tolerance / 2.0)),
            Method::Marched { .. } => Promise::Proven(MARCHED_ULPS * (periods as f64 + 1.0) * ulp),
            Method::Stable(StablePrecision::Double) => Promise::Measured(64.0 * ulp),
            Method::Stable(StablePrecision::DoubleDouble) => Promise::Measured(2.0 * ulp),
            _ => Promise::Nothing,
        };
        let verdict = match promise {
            Promise::Proven(bound) if bound <= tolerance => Verdict::GoodEnough,
            Promise::Proven(_) => Verdict::BoundTooLarge,
            Promise::Measured(_) => Verdict::Measured,
            Promise::Nothing => Verdict::NoPromise,
        };
        told(Some(promise), verdict)
    };
    let mut candidates: Vec<Candidate> = METHODS.into_iter().map(candidate).collect();
    let meets = |candidate: &Candidate| matches!(candidate.promise, Some(Promise::Proven(bound)) if bound <= tolerance);
    candidates.sort_by(|a, b| meets(b).cmp(&meets(a)).then(a.seconds.total_cmp(&b.seconds)));
    let met = candidates.first().is_some_and(meets);
    if let (true, Some(first)) = (met, candidates.first_mut()) {
        first.verdict = Verdict::Picked;
    }
    Ok(Weighed { candidates, met, costs: question.costs.source.clone() })
}
