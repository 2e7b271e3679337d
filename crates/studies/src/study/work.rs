//! Work against precision: all ways with their settings on one problem.

use crate::study::harness::{Measured, Settings, measure};
use crate::study::reference::Reference;
use wavestep::answer::{Kind, Problem};
use wavestep::evaluate::StablePrecision;
use wavestep_draw::{Caption, Method, PlotError, Point, Row, Table, WorkPrecision};

/// One step of the ladder: a way, and the tolerance it is given in parts of the largest value.
///
/// ```
/// use wavestep::answer::Kind;
/// use wavestep_studies::study::{LADDER, Step};
///
/// let coarse: Step = (Kind::Compiled, Some(1e-2));
/// assert!(LADDER.contains(&coarse));
/// ```
pub type Step = (Kind, Option<f64>);

/// The ways that are measured, and their settings in order.
///
/// ```
/// use wavestep::answer::Kind;
/// use wavestep_studies::study::LADDER;
///
/// // Tolerances of one way descend, so that its line goes from coarse to fine.
/// let compiled = LADDER.iter().filter(|(kind, _)| *kind == Kind::Compiled);
/// let tolerances: Vec<f64> = compiled.filter_map(|(_, tolerance)| *tolerance).collect();
/// assert!(tolerances.is_sorted_by(|a, b| a > b) && tolerances.len() > 5);
/// ```
pub const LADDER: [Step; 33] = [
    (Kind::Rigid, None),
    (Kind::Third, None),
    (Kind::Modes { count: 10 }, None),
    (Kind::Modes { count: 100 }, None),
    (Kind::Modes { count: 1_000 }, None),
    (Kind::Modes { count: 10_000 }, None),
    (Kind::Leapfrog { cells: 50, courant: 0.9 }, None),
    (Kind::Leapfrog { cells: 200, courant: 0.9 }, None),
    (Kind::Leapfrog { cells: 800, courant: 0.9 }, None),
    (Kind::Leapfrog { cells: 50, courant: 1.0 }, None),
    (Kind::Leapfrog { cells: 200, courant: 1.0 }, None),
    (Kind::Leapfrog { cells: 800, courant: 1.0 }, None),
    (Kind::Steps { tolerance: 1e-3 }, None),
    (Kind::Steps { tolerance: 1e-5 }, None),
    (Kind::Steps { tolerance: 1e-7 }, None),
    (Kind::Steps { tolerance: 1e-9 }, None),
    (Kind::Steps { tolerance: 1e-11 }, None),
    (Kind::Expanded, None),
    (Kind::Plain, None),
    (Kind::Stable(StablePrecision::Double), None),
    (Kind::Stable(StablePrecision::DoubleDouble), None),
    (Kind::Marched { proven: true }, None),
    (Kind::Compiled, Some(1e-2)),
    (Kind::Compiled, Some(1e-3)),
    (Kind::Compiled, Some(1e-4)),
    (Kind::Compiled, Some(1e-6)),
    (Kind::Compiled, Some(1e-8)),
    (Kind::Compiled, Some(1e-10)),
    (Kind::Compiled, Some(1e-12)),
    (Kind::Compiled, Some(1e-13)),
    (Kind::Compiled, Some(1e-14)),
    (Kind::Compiled, None),
    (Kind::Certified, None),
];

/// What came of one step.
///
/// ```
/// use wavestep::answer::{Kind, WayError};
/// use wavestep_studies::study::Outcome;
///
/// let refused = WayError::NeedsScene("rigid").to_string();
/// let outcome = Outcome { step: (Kind::Rigid, None), result: Err(refused) };
/// assert!(outcome.result.unwrap_err().contains("a scene of bars"));
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Outcome {
    /// The step.
    pub step: Step,
    /// What was measured, or why the way refused.
    pub result: Result<Measured, String>,
}

impl Outcome {
    /// The line of the chart that it belongs to.
    fn line(&self) -> String {
        match self.step.0 {
            Kind::Leapfrog { courant, .. } => format!("leapfrog, CFL {courant}"),
            kind => kind.name().to_owned(),
        }
    }

    /// The setting, in few letters; no two steps of different lines have the same.
    fn setting(&self) -> String {
        match self.step {
            (Kind::Modes { count }, _) => format!("N = {count}"),
            (Kind::Leapfrog { cells, courant }, _) if courant < 1.0 => {
                format!("{cells} cells, CFL {courant}")
            }
            (Kind::Leapfrog { cells, .. }, _) => format!("{cells} cells"),
            (Kind::Steps { tolerance }, _) => format!("rtol {tolerance:e}"),
            (_, Some(tolerance)) => format!("tol {tolerance:e}"),
            _ => String::new(),
        }
    }
}

/// Whether a step takes long.
fn is_heavy(kind: Kind) -> bool {
    match kind {
        Kind::Modes { count } => count > 1_000,
        Kind::Leapfrog { cells, .. } => cells > 100,
        Kind::Steps { tolerance } => tolerance < 1e-6,
        _ => false,
    }
}

/// Measures all steps, or those that do not take long; `tick` is called before each.
///
/// ```
/// use std::cell::Cell;
/// use std::time::Duration;
/// use wavestep::answer::Problem;
/// use wavestep_studies::study::{Reference, Sampling, Settings, ladder};
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
/// let ticks = Cell::new(0);
/// let outcomes = ladder(&problem, &reference, (settings, true), |_| ticks.set(ticks.get() + 1));
/// assert_eq!(ticks.get(), outcomes.len());
/// // Models refuse a recurrence; every bound of the others is kept.
/// assert!(outcomes[0].result.is_err());
/// let mut measured = outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok());
/// assert!(measured.all(|way| way.bound.is_none_or(|bound| way.error <= bound)));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn ladder(
    problem: &Problem<'_>,
    reference: &Reference,
    (settings, quick): (Settings, bool),
    tick: impl Fn(&Kind),
) -> Vec<Outcome> {
    let outcome = |step: Step| {
        let (kind, tolerance) = step;
        tick(&kind);
        let absolute = tolerance.map(|tolerance| tolerance * reference.scale());
        let result = measure(problem, (kind, absolute), reference, settings);
        Outcome { step, result: result.map_err(|error| error.to_string()) }
    };
    LADDER.into_iter().filter(|(kind, _)| !(quick && is_heavy(*kind))).map(outcome).collect()
}

/// The diagram and the table of outcomes. Ways that refused are named in the caption, with the reason.
///
/// The diagram shows seconds a point, and above them the same with the preparation spread over the points
/// of the reference.
///
/// # Errors
/// [`PlotError`], where nothing was measured.
///
/// ```
/// use wavestep::answer::{Kind, Problem};
/// use wavestep_draw::Caption;
/// use wavestep_studies::study::{Measured, Outcome, Reference, Sampling, work_precision};
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
/// let measured = |kind, seconds| Outcome {
///     step: (kind, None),
///     result: Ok(Measured { kind, error: 1e-16, bound: None, preparation: 0.0, seconds }),
/// };
/// let outcomes = [measured(Kind::Compiled, 1e-9), measured(Kind::Certified, 1e-6)];
/// let (chart, table) =
///     work_precision("Values", &outcomes, &reference, Caption::default()).unwrap();
/// assert_eq!(chart.methods()[0].name, "compiled");
/// // Nothing was prepared.
/// assert_eq!(chart.methods()[0].points[0].prepared, Some(1e-9));
/// // A thousand times as fast as certified values.
/// assert!((table.rows[0].speed_up.unwrap() - 1000.0).abs() < 1e-9);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn work_precision(
    title: &str,
    outcomes: &[Outcome],
    reference: &Reference,
    mut caption: Caption,
) -> Result<(WorkPrecision, Table), PlotError> {
    let mut methods: Vec<Method> = Vec::new();
    let mut rows = Vec::new();
    let slowest = outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok());
    let slowest = slowest
        .filter(|measured| matches!(measured.kind, Kind::Certified))
        .map(|measured| measured.seconds)
        .next();
    caption.remarks.push(format!(
        "Markers: seconds a point once all is prepared. Rings: with the preparation, spread over {} points.",
        reference.times().len()
    ));
    for outcome in outcomes {
        let (line, setting) = (outcome.line(), outcome.setting());
        let measured = match &outcome.result {
            Ok(measured) => measured,
            Err(reason) => {
                let remark = format!("{line} is left out: {reason}.");
                if !caption.remarks.contains(&remark) {
                    caption.remarks.push(remark);
                }
                continue;
            }
        };
        let Measured { error, bound, seconds, preparation, .. } = *measured;
        let prepared = Some(seconds + preparation / reference.times().len().max(1) as f64);
        let point = Point { setting: setting.clone(), error, bound, seconds, prepared };
        match methods.iter_mut().find(|method| method.name == line) {
            Some(method) => method.points.push(point),
            None => methods.push(Method { name: line.clone(), points: vec![point] }),
        }
        let prepared = format!("prepared in {}", duration(preparation));
        let setting = match (setting.is_empty(), preparation > seconds) {
            (_, false) => setting,
            (true, true) => prepared,
            (false, true) => format!("{setting}, {prepared}"),
        };
        let speed_up = slowest.map(|slowest| slowest / seconds);
        rows.push(Row { method: line, setting, error, bound, seconds, speed_up });
    }
    let chart =
        WorkPrecision::new(title, methods, caption)?.reference_radius(reference.radius())?;
    Ok((chart, Table { compared_with: "certified".to_owned(), rows }))
}

/// A time for people.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1e-3 => format!("{:.0} µs", s * 1e6),
        s if s < 1.0 => format!("{:.0} ms", s * 1e3),
        s => format!("{s:.1} s"),
    }
}
