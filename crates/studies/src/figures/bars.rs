//! Two bars, and a bar that is pushed: figures 6.10 to 6.13.

use super::scene::problem;
use super::{Drawn, Listed};
use crate::picture::along_the_line;
use crate::ratio;
use wavestep::field::{FieldEvaluator, Quantity};
use wavestep_draw::{Axis, Caption, Panel, Series};
use wavestep_polynomial::Rational;

/// 6.10.
pub(super) fn diagram_of_impact(listed: &Listed) -> Drawn {
    let problem = problem("bars-that-part", &[("r", ratio(1, 2))]);
    let remarks = [
        "x from the free end of the striker; its length is L, and c the velocity of waves in both bars.",
        "The striker is thrown back at 2L/c with V/3, and leaves a pulse of 2L; places are those at the \
         start, so that the gap is not seen.",
    ];
    let last = ratio(5, 1);
    let evaluator = problem.field_evaluator(&last)?.looking(&ratio(4, 1))?;
    let names = ["place x/L", "time ct/L", "v/V"];
    let diagram = listed.diagram(&evaluator, Quantity::Velocity, &last, names, &remarks)?;
    Ok(Box::new(diagram.level(2.0, "the bars part")?))
}

/// A panel for each time and each quantity, so that no line lies on another.
fn snapshots(
    listed: &Listed,
    evaluator: &FieldEvaluator<'_>,
    times: &[(Rational, &str)],
    quantities: &[(Quantity, &str)],
    remarks: &[&str],
) -> Drawn {
    let fields: Vec<Quantity> = quantities.iter().map(|(quantity, _)| *quantity).collect();
    let mut found = Vec::new();
    for (time, _) in times {
        let time = std::slice::from_ref(time);
        found.push(along_the_line(evaluator, &fields, time, Caption::default())?);
    }
    let mut panels = Vec::new();
    for (place, (_, quantity)) in quantities.iter().enumerate() {
        let own = || found.iter().map(|figure| &figure.panels()[place].series[0]);
        let values = || own().flat_map(|own| &own.points).map(|point| point.1);
        // NaN, which interrupts a line, is neither least nor greatest.
        let (low, high) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
        for (own, (_, name)) in own().zip(times) {
            let series = Series { name: (*name).to_owned(), ..own.clone() }.styled(0);
            let panel = Panel::new(Axis::linear(quantity), vec![series]);
            panels.push(Panel { range: Some((low, high)), named_at_ends: true, ..panel });
        }
    }
    let (left, right) = found[0].extent();
    let figure = listed.figure(Axis::linear("place x/L"), panels, remarks)?;
    Ok(Box::new(figure.window(left, right)?))
}

/// 6.11.
pub(super) fn progress(listed: &Listed) -> Drawn {
    let problem = problem("striker-on-long-bar", &[("r", ratio(1, 1))]);
    let times =
        [(ratio(1, 2), "ct/L = 1/2"), (ratio(3, 2), "ct/L = 3/2"), (ratio(5, 2), "ct/L = 5/2")];
    let remarks = [
        "x from the free end of the striker, which meets the long bar at x = L; c is the velocity of waves, \
         Z the impedance of the bars.",
        "The pulse is 2L long; from 2L/c on the striker is at rest, and the contact free of force.",
    ];
    let fields = [(Quantity::Velocity, "v/V"), (Quantity::Force, "X/(ZV)")];
    let evaluator = problem.field_evaluator(&times[times.len() - 1].0)?.looking(&ratio(3, 1))?;
    snapshots(listed, &evaluator, &times, &fields, &remarks)
}

/// 6.12.
pub(super) fn pushed_fields(listed: &Listed) -> Drawn {
    let problem = problem("pushed-bar", &[]);
    let times = [(ratio(1, 2), "ct/L = 1/2"), (ratio(7, 4), "ct/L = 7/4")];
    let remarks = [
        "The force X acts at x = 0 from t = 0 on; F is the compressive force in the bar. What the \
                    front has passed once more moves faster by cX/(EA).",
    ];
    let fields = [(Quantity::Velocity, "v EA/(cX)"), (Quantity::Force, "F/X")];
    let evaluator = problem.field_evaluator(&times[times.len() - 1].0)?;
    snapshots(listed, &evaluator, &times, &fields, &remarks)
}

/// 6.13.
pub(super) fn pushed_diagram(listed: &Listed) -> Drawn {
    let problem = problem("pushed-bar", &[]);
    let last = ratio(6, 1);
    let remarks = ["The force X acts at x = 0 from t = 0 on; the other end is free."];
    let evaluator = problem.field_evaluator(&last)?;
    let names = ["place x/L", "time ct/L", "v EA/(cX)"];
    Ok(Box::new(listed.diagram(&evaluator, Quantity::Velocity, &last, names, &remarks)?))
}
