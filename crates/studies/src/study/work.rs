//! Work against precision: all ways with their settings on one question.

use crate::study::harness::{Measured, Settings, Subject, measure};
use crate::study::reference::Reference;
use wavestep::answer::{Method, Question, Way};
use wavestep::problem::ProblemError;
use wavestep::signal::StablePrecision;
use wavestep_draw::{Caption, PlotError, Point, Row, Table, WorkPrecision};

/// One step of the ladder: a way, and the tolerance it is given in parts of the largest value.
pub type Step = (Method, Option<f64>);

/// The ways that are measured, and their settings in order.
pub fn steps() -> impl Iterator<Item = Step> {
    let modes = [10, 100, 1_000, 10_000].map(|count| Method::Modes { count });
    let leapfrog = |courant| [50, 200, 800].map(|cells| Method::Leapfrog { cells, courant });
    let steps = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11].map(|tolerance| Method::Steps { tolerance });
    let exact = [
        Method::Expanded,
        Method::Plain,
        Method::Stable(StablePrecision::Double),
        Method::Stable(StablePrecision::DoubleDouble),
        Method::Marched { proven: true },
    ];
    let models = [Method::Rigid, Method::Third].into_iter().chain(modes);
    let models = models.chain(leapfrog(0.9)).chain(leapfrog(1.0)).chain(steps);
    let compiled = [1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-14].map(Some);
    let compiled = compiled.into_iter().chain([None]).map(|step| (Method::Compiled, step));
    let others = models.chain(exact).map(|method| (method, None));
    others.chain(compiled).chain([(Method::Certified, None)])
}

#[derive(Clone, Debug)]
pub struct Outcome {
    pub step: Step,
    pub result: Result<Measured, ProblemError>,
}

impl Outcome {
    /// The line of the chart that it belongs to.
    fn line(&self) -> String {
        match self.step.0 {
            Method::Leapfrog { courant, .. } => format!("leapfrog, CFL {courant}"),
            method => method.name().to_owned(),
        }
    }

    /// The setting, in few letters; no two steps of different lines have the same.
    fn setting(&self) -> String {
        match self.step {
            (Method::Modes { count }, _) => format!("N = {count}"),
            (Method::Leapfrog { cells, courant }, _) if courant < 1.0 => {
                format!("{cells} cells, CFL {courant}")
            }
            (Method::Leapfrog { cells, .. }, _) => format!("{cells} cells"),
            (Method::Steps { tolerance }, _) => format!("rtol {tolerance:e}"),
            (_, Some(tolerance)) => format!("tol {tolerance:e}"),
            _ => String::new(),
        }
    }
}

fn is_heavy(method: Method) -> bool {
    match method {
        Method::Modes { count } => count > 1_000,
        Method::Leapfrog { cells, .. } => cells > 100,
        Method::Steps { tolerance } => tolerance < 1e-6,
        _ => false,
    }
}

/// Measures all steps, or those that do not take long; `tick` is called before each.
pub fn ladder(
    (subject, question): (Subject<'_>, &Question<'_>),
    reference: &Reference,
    (settings, quick): (Settings, bool),
    tick: impl Fn(&Method),
) -> Vec<Outcome> {
    let outcome = |step: Step| {
        let (method, tolerance) = step;
        tick(&method);
        let absolute = tolerance.map(|tolerance| tolerance * reference.scale());
        // What is followed shows what needs a closed form without being followed anew.
        let is_served = matches!(method, Method::Compiled | Method::Certified);
        let possible = match is_served || question.signal.closed_form().is_ok() {
            true => Ok(()),
            false => Way::new(method, question, absolute).map(drop),
        };
        let asked = (subject, question.signal.window());
        let result = possible
            .map_err(ProblemError::from)
            .and_then(|()| measure(asked, (method, absolute), reference, settings));
        Outcome { step, result }
    };
    steps().filter(|(method, _)| !(quick && is_heavy(*method))).map(outcome).collect()
}

/// The diagram and the table of outcomes. Ways that refused are named in the caption, with the reason.
///
/// The diagram shows seconds a point, and above them the same with the preparation spread over the points
/// of the reference.
pub fn work_precision(
    title: &str,
    outcomes: &[Outcome],
    reference: &Reference,
    mut caption: Caption,
) -> Result<(WorkPrecision, Table), PlotError> {
    let mut methods: Vec<wavestep_draw::Method> = Vec::new();
    let mut rows = Vec::new();
    let mut measured = outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok());
    let certified = measured.find(|measured| measured.method == Method::Certified);
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
            None => methods.push(wavestep_draw::Method { name: line.clone(), points: vec![point] }),
        }
        let prepared = format!("prepared in {}", duration(preparation));
        let setting = match (setting.is_empty(), preparation > seconds) {
            (_, false) => setting,
            (true, true) => prepared,
            (false, true) => format!("{setting}, {prepared}"),
        };
        let speed_up = certified.map(|certified| certified.seconds / seconds);
        rows.push(Row { method: line, setting, error, bound, seconds, speed_up });
    }
    let chart = WorkPrecision::new(title, methods, caption)?;
    let chart = match reference.radius() {
        // Exact values have no radius to show.
        0.0 => chart,
        radius => chart.reference_radius(radius)?,
    };
    Ok((chart, Table { compared_with: "certified".to_owned(), rows }))
}

fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1e-3 => format!("{:.0} µs", s * 1e6),
        s if s < 1.0 => format!("{:.0} ms", s * 1e3),
        s => format!("{s:.1} s"),
    }
}
