//! Saint-Venant's problem against the ratio of masses: when the mass leaves the bar.

use super::error::FigureError;
use super::largest_strain::LargestStrain;
use super::scene::ratio;
use crate::plot::{Axis, Caption, Chart, Figure, Panel, Series};

/// How many periods are enough for the ratios that are shown.
const PERIODS: usize = 8;

/// The largest ratio of masses.
const LARGEST_RATIO: i64 = 40;

/// Release and largest strain against the ratio of the striking mass to that of the bar.
///
/// # Errors
/// [`FigureError::Plot`], where nothing can be drawn.
///
/// ```
/// let figure = wavestep::figures::saint_venant().unwrap();
/// assert!(figure.svg().contains("release"));
/// ```
pub fn saint_venant() -> Result<Box<dyn Chart>, FigureError> {
    let strains = LargestStrain::new(PERIODS).expect("few periods");
    let (mut release, mut largest) = (Vec::new(), Vec::new());
    for i in 1..=4 * LARGEST_RATIO {
        let mass = ratio(i, 4);
        let (x, mu) = (i as f64 / 4.0, mass.recip());
        if let Some(time) = strains.release(&mu) {
            release.push((x, time));
        }
        let pushed = (0..=PERIODS).filter(|n| strains.is_pushed(*n, &mu));
        let strain = pushed.map(|n| strains.strain(n, &mu, 60).midpoint().to_double());
        largest.push((x, strain.fold(0.0, f64::max)));
    }
    let estimate = (1..=LARGEST_RATIO).map(|i| {
        let estimate = LargestStrain::estimate(&ratio(i, 1), 60);
        (i as f64, estimate.midpoint().to_double())
    });
    let panels = vec![
        Panel::new(Axis::linear("release").unit("L/c"), vec![Series::new("", release)]),
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
    let figure = Figure::new("Saint-Venant's problem", mass, panels, caption)?;
    Ok(Box::new(figure.window(0.0, LARGEST_RATIO as f64)?))
}
