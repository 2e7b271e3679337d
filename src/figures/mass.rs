//! A rigid mass on a bar with a fixed end: figures 6.20 to 6.22.

use super::Listed;
use super::error::FigureError;
use super::largest_strain::LargestStrain;
use super::scene::{caption, course, network, ratio, recurrence};
use crate::ball::Ball;
use crate::field::{FieldEvaluator, Quantity};
use crate::picture::lagrange;
use crate::plot::{Axis, Chart, Figure, Look, Panel, Series};

/// The mass of the bar over the striking mass in 6.20 and 6.21.
const MU: (i64, i64) = (1, 2);

/// How many periods 6.22 shows, and up to which ratio of masses.
const PERIODS: usize = 6;
const LARGEST_RATIO: i64 = 40;

/// 6.20.
pub(super) fn diagram(listed: &Listed) -> Result<Box<dyn Chart>, FigureError> {
    let network = network("mass-on-fixed-bar", &[("mu", ratio(MU.0, MU.1))]);
    let window = [&ratio(0, 1), &ratio(3, 1)];
    let remarks =
        ["The mass of the bar is half the striking mass. Times in M/Z, strains in V/c. The mass \
                    is kept on the bar."];
    let evaluator = FieldEvaluator::new(&network, window[1])?;
    let caption = caption(listed.number, &remarks);
    let diagram = lagrange(&evaluator, Quantity::Strain, window, caption)?;
    Ok(Box::new(diagram.titled(listed.title)))
}

/// 6.21.
pub(super) fn courses(listed: &Listed) -> Result<Box<dyn Chart>, FigureError> {
    let mu = ratio(MU.0, MU.1);
    let scene = recurrence("rigid-mass", &[("mu", mu.clone())]);
    let last = &mu * ratio(6, 1);
    // Times in L/c, not in L/(μc).
    let scale = f64::from(i32::try_from(MU.1).unwrap_or(1)) / MU.0 as f64;
    let series = |name: &str, label: &str, sign: f64| -> Result<Series, FigureError> {
        let values = course(&scene, name, &last)?;
        let points = values.points.iter().map(|(t, y)| (t * scale, sign * y)).collect();
        let jumps = values.jumps.iter().map(|(t, a, b)| (t * scale, sign * a, sign * b)).collect();
        Ok(Series::new(label, points).jumping(jumps))
    };
    let velocity = series("velocity", "velocity of the mass v0/V", 1.0)?;
    let struck = series("strain_impact", "strain at the struck end, −ε0 c/V", -1.0)?;
    let fixed = series("strain_fixed", "strain at the fixed end, −εL c/V", -1.0)?;
    let panels = vec![
        Panel::new(Axis::linear("velocity v0/V"), vec![Series { name: String::new(), ..velocity }])
            .level(0.0, ""),
        Panel::new(Axis::linear("strain −ε c/V"), vec![struck, fixed]).level(0.0, ""),
    ];
    let remarks =
        ["The mass of the bar is half the striking mass. Where the strain at the struck end \
                    becomes tensile the mass would leave the bar."];
    let caption = caption(listed.number, &remarks);
    let figure = Figure::new(listed.title, Axis::linear("time ct/L"), panels, caption)?;
    Ok(Box::new(figure.window(0.0, 6.0)?))
}

/// 6.22.
pub(super) fn largest_strains(listed: &Listed) -> Result<Box<dyn Chart>, FigureError> {
    let strains = LargestStrain::new(PERIODS).expect("few periods");
    let double = |ball: &Ball| ball.midpoint().to_double();
    let ratios = || (1..=4 * LARGEST_RATIO).map(|i| ratio(i, 4));
    let mut series = Vec::new();
    for period in 0..PERIODS {
        let pushed = ratios().filter(|ratio| strains.is_pushed(period, &ratio.recip()));
        let points = pushed.map(|ratio| {
            (ratio_as_double(&ratio), double(&strains.strain(period, &ratio.recip(), 60)))
        });
        series.push(Series::new(&format!("n = {period}"), points.collect()));
    }
    let estimate = (1..=LARGEST_RATIO / 2)
        .map(|i| ratio(2 * i, 1))
        .map(|ratio| (ratio_as_double(&ratio), double(&LargestStrain::estimate(&ratio, 60))));
    series.push(Series::new("estimate 6.86", estimate.collect()).look(Look::Points));
    let panel = Panel::new(Axis::linear("largest strain −εL c/V"), series);
    let remarks =
        ["2 f_n(0): the front of the n-th period, doubled at the fixed end, as long as the \
                    contact pushes. Marked: where the next period has the largest strain."];
    let mass = Axis::linear("1/μ, striking mass over mass of the bar");
    let mut figure =
        Figure::new(listed.title, mass, vec![panel], caption(listed.number, &remarks))?;
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

fn ratio_as_double(value: &wavestep_polynomial::Rational) -> f64 {
    num_traits::ToPrimitive::to_f64(value).unwrap_or(f64::NAN)
}
