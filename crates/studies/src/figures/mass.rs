//! A rigid mass on a bar with a fixed end: figures 6.20 to 6.22.

use super::largest_strain::LargestStrain;
use super::scene::{course, problem};
use super::{Drawn, Listed};
use crate::estimates::Estimate;
use crate::picture::PictureError;
use crate::{nearest, ratio};
use wavestep::ball::Ball;
use wavestep::field::Quantity;
use wavestep_draw::{Axis, Look, Panel, Series};

/// The mass of the bar over the striking mass in 6.20 and 6.21.
const MU: (i64, i64) = (1, 2);

/// The last time in 6.20 and 6.21, in L/c.
const LAST: i64 = 6;

/// How many periods 6.22 shows, and up to which ratio of masses.
const PERIODS: usize = 6;
const LARGEST_RATIO: i64 = 40;

/// When the mass leaves the bar, in L/c.
fn release() -> f64 {
    let strains = LargestStrain::new(PERIODS).expect("few periods");
    strains.release(&ratio(MU.0, MU.1)).expect("within the periods")
}

/// 6.20.
pub(super) fn diagram(listed: &Listed) -> Drawn {
    let problem = problem("saint-venant", &[("mu", ratio(MU.0, MU.1))]);
    let last = ratio(LAST, 1);
    let remarks = [
        "The mass of the bar is half the striking mass; x from the struck end. Compression is positive; \
                    hatched: tension. The mass leaves where the strain at x = 0 has come to zero.",
    ];
    let evaluator = problem.field_evaluator(&last)?;
    // With V = 1 and Z = 1 the compressive force is −ε c/V.
    let names = ["place x/L", "time ct/L", "−ε c/V"];
    let diagram = listed.diagram(&evaluator, Quantity::Force, &last, names, &remarks)?;
    Ok(Box::new(diagram.level(release(), "the mass leaves")?))
}

/// 6.21.
pub(super) fn courses(listed: &Listed) -> Drawn {
    let problem = problem("saint-venant", &[("mu", ratio(MU.0, MU.1))]);
    let last = ratio(LAST, 1);
    let series = |name: &str, label: &str, sign: f64| {
        let values = course(&problem, name, &last)?;
        // Adding zero turns a negative zero into zero.
        let signed = |y: f64| sign * y + 0.0;
        let points = values.points.iter().map(|(t, y)| (*t, signed(*y))).collect();
        let jumps = values.jumps.iter().map(|(t, a, b)| (*t, signed(*a), signed(*b))).collect();
        Ok::<Series, PictureError>(Series::new(label, points).jumping(jumps))
    };
    let velocity = series("velocity", "mass", 1.0)?;
    let struck = series("strain_impact", "struck end, ε0", -1.0)?;
    let fixed = series("strain_fixed", "fixed end, εL", -1.0)?;
    let panels = vec![
        Panel::new(Axis::linear("velocity v0/V"), vec![velocity]),
        Panel::new(Axis::linear("strain −ε c/V"), vec![struck, fixed]),
    ];
    let remarks = [
        "The mass of the bar is half the striking mass. Where the strain at the struck end has come to zero the \
                    mass leaves; from then on it moves evenly, and the bar is free there.",
    ];
    let figure = listed.figure(Axis::linear("time ct/L"), panels, &remarks)?;
    let leaves = release();
    let figure = figure.mark(leaves, &format!("the mass leaves, {leaves:.3}"))?;
    Ok(Box::new(figure.window(0.0, LAST as f64)?))
}

/// A style without dashes.
const SOLID_BLACK: usize = 24;

/// 6.22.
pub(super) fn largest_strains(listed: &Listed) -> Drawn {
    let strains = LargestStrain::new(PERIODS).expect("few periods");
    let double = |ball: &Ball| ball.midpoint().to_double();
    let ratios = || (1..=4 * LARGEST_RATIO).map(|i| ratio(i, 4));
    let mut series = Vec::new();
    for period in 0..PERIODS {
        let pushed = ratios().filter(|ratio| strains.is_pushed(period, &ratio.recip()));
        let points = pushed
            .map(|ratio| (nearest(&ratio), double(&strains.strain(period, &ratio.recip(), 60))));
        series.push(Series::new(&format!("n = {period}"), points.collect()));
    }
    // It bends most at the beginning.
    let dense = (0..=20).map(|i| ratio(i, 40)).chain(ratios());
    let estimate = dense.map(|ratio| (nearest(&ratio), double(&Estimate::Better.of(&ratio))));
    let estimate = Series::new("estimate 6.86", estimate.collect()).look(Look::Thin);
    series.push(estimate.styled(SOLID_BLACK));
    let panel = Panel::new(Axis::linear("largest strain −εL c/V"), series);
    let panel = Panel { named_at_ends: true, ..panel };
    let remarks =
        ["2 f_n(0): the front of the n-th period, doubled at the fixed end, as long as the \
                    contact pushes. Marked: where the next period has the largest strain."];
    let mass = Axis::linear("1/μ, striking mass over mass of the bar");
    let mut figure = listed.figure(mass, vec![panel], &remarks)?;
    for period in 1..PERIODS - 1 {
        if let Some(ratio) = strains.overtaking(period, 60) {
            let at = double(&ratio);
            if at < LARGEST_RATIO as f64 {
                figure = figure.mark(at, &format!("{at:.2}"))?;
            }
        }
    }
    Ok(Box::new(figure.window(0.0, LARGEST_RATIO as f64)?))
}
