//! Saint-Venant's problem against the ratio of masses: when the mass leaves the bar.

use crate::figures::ratio;
use wavestep_draw::{Axis, Caption, Figure, Panel, Series};
use wavestep_polynomial::Rational;
use wavestep_studies::estimates::Estimate;
use wavestep_studies::figures::LargestStrain;
use wavestep_studies::picture::Sampled;

/// How many periods are enough for the ratios that are shown.
const PERIODS: usize = 10;

/// The largest ratio of masses.
const LARGEST_RATIO: i64 = 40;

/// The release against the ratio of masses, from both sides where it jumps.
fn release(strains: &LargestStrain) -> Sampled {
    let mut jumps = Vec::new();
    for period in 1..PERIODS {
        let Some(outlasting) = strains.outlasting(period, 60) else { continue };
        let at = outlasting.midpoint().to_double();
        // A little above the ratio at which the force is zero at the end of the period.
        let above = Rational::from(outlasting.midpoint()) * ratio(1_000_000_001, 1_000_000_000);
        if let Some(after) = strains.release(&above.recip()).filter(|_| at < LARGEST_RATIO as f64) {
            jumps.push((at, 2.0 * (period as f64 + 1.0), after));
        }
    }
    let mut points = Vec::new();
    let mut waiting = jumps.iter().copied().peekable();
    for i in 1..=4 * LARGEST_RATIO {
        let x = i as f64 / 4.0;
        while let Some((at, before, after)) = waiting.next_if(|jump| jump.0 < x) {
            points.extend([(at, before), (f64::NAN, f64::NAN), (at, after)]);
        }
        if let Some(time) = strains.release(&ratio(i, 4).recip()) {
            points.push((x, time));
        }
    }
    Sampled { points, jumps }
}

/// Release and largest strain against the ratio of the striking mass to that of the bar.
pub fn saint_venant() -> Figure {
    let strains = LargestStrain::new(PERIODS).expect("few periods");
    let mut largest = Vec::new();
    for i in 1..=4 * LARGEST_RATIO {
        let (x, mu) = (i as f64 / 4.0, ratio(i, 4).recip());
        let pushed = (0..=PERIODS).filter(|n| strains.is_pushed(*n, &mu));
        let strain = pushed.map(|n| strains.strain(n, &mu, 60).midpoint().to_double());
        largest.push((x, strain.fold(0.0, f64::max)));
    }
    let Sampled { points: release, jumps } = release(&strains);
    let estimate = (1..=4 * LARGEST_RATIO).map(|i| {
        let estimate = Estimate::Better.of(&ratio(i, 4));
        (i as f64 / 4.0, estimate.midpoint().to_double())
    });
    let panels = vec![
        Panel::new(
            Axis::linear("release").unit("L/c"),
            vec![Series::new("", release).jumping(jumps)],
        ),
        Panel::new(
            Axis::linear("largest strain").unit("V/c"),
            vec![Series::new("exact", largest), Series::new("estimate 6.86", estimate.collect())],
        ),
    ];
    let caption = Caption {
        remarks: vec![
            "The release jumps where it falls on the end of a period: the front that arrives then presses \
             the bodies together once more. The strain has corners where it moves to the next period."
                .to_owned(),
        ],
        ..Caption::default()
    };
    let mass = Axis::linear("striking mass over mass of the bar, M/(ρAL)");
    let figure = Figure::new("Saint-Venant's problem", mass, panels, caption).expect("curves");
    figure.window(0.0, LARGEST_RATIO as f64).expect("a window")
}
