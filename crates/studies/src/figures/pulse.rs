//! Impact through a spring: figures 6.17 and 6.18.

use super::scene::{course, problem};
use super::{Drawn, Listed};
use crate::ratio;
use wavestep::field::Quantity;
use wavestep_draw::{Axis, Panel, Series};

/// 6.17.
pub(super) fn diagram(listed: &Listed) -> Drawn {
    // With μ = 2 the unit of t k (1/Z1 + 1/Z2) is L/c.
    let problem = problem("cushion-with-release", &[("mu", ratio(2, 1))]);
    let last = ratio(6, 1);
    let remarks = [
        "Two bars of impedance Z; the striker has the length L, x is from its free end. μ = 4Lk/(EA) = 2, so \
         that t k (1/Z1 + 1/Z2) = ct/L. X_max = ZV/2.",
        "The spring lies at x = L; once it is unloaded the bars part. Hatched: tension.",
    ];
    let evaluator = problem.field_evaluator(&last)?.looking(&ratio(3, 1))?;
    let names = ["place x/L", "time ct/L", "X/(ZV)"];
    let diagram = listed.diagram(&evaluator, Quantity::Force, &last, names, &remarks)?;
    let force = course(&problem, "force", &last)?;
    let opens = until_zero(&force.points).last().map_or(0.0, |point| point.0);
    Ok(Box::new(diagram.level(opens, "the bars part")?))
}

/// The part of a curve before it falls through zero, which ends there.
pub fn until_zero(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let falls = |pair: &[(f64, f64)]| pair[0].1 > 0.0 && pair[1].1 <= 0.0;
    let Some(at) = points.windows(2).position(falls) else { return points.to_vec() };
    let [(t, x), (later, beyond)] = [points[at], points[at + 1]];
    let mut kept = points[..=at].to_vec();
    kept.push((t + (later - t) * x / (x - beyond), 0.0));
    kept
}

/// 6.18.
pub(super) fn shapes(listed: &Listed) -> Drawn {
    let mut series = Vec::new();
    for (name, mu) in [
        ("μ = 8", ratio(8, 1)),
        ("μ = 4", ratio(4, 1)),
        ("μ = 2", ratio(2, 1)),
        ("μ = 1", ratio(1, 1)),
        ("μ = 1/2", ratio(1, 2)),
    ] {
        let last = &mu * ratio(2, 1) + ratio(8, 1);
        let force = course(&problem("pulse-shape", &[("mu", mu)]), "force", &last)?;
        series.push(Series::new(name, until_zero(&force.points)));
    }
    let panel = Panel::new(Axis::linear("force X/X_max"), series);
    let remarks = [
        "μ is the time at which the first wave returns from the free end of the impacting bar; values of \
         μ chosen here.",
        "X_max = EA V/(2c). Each curve ends where the force is zero again and the contact opens.",
    ];
    let time = Axis::linear("time t k (1/Z1 + 1/Z2)");
    Ok(Box::new(listed.figure(time, vec![panel], &remarks)?))
}
