//! Local contact: figures 6.15 and 6.16.

use super::{Drawn, Listed};
use crate::hertz::{PowerLaw, equal_bars_constant};
use crate::picture::PictureError;
use crate::ratio;
use wavestep::ball::Ball;
use wavestep_draw::{Axis, Panel, Series};

const BITS: u64 = 64;

fn double(ball: &Ball) -> f64 {
    ball.midpoint().to_double()
}

/// 6.15.
pub(super) fn rise(listed: &Listed) -> Drawn {
    let curve = |law: PowerLaw| -> Result<Vec<(f64, f64)>, PictureError> {
        let point = |i: i64| {
            let time = ratio(i, 40);
            Ok((i as f64 / 40.0, double(&law.share(&time, BITS)?.force)))
        };
        (0..=200).map(point).collect()
    };
    let hertz = Series::new("Hertz, m = 3/2", curve(PowerLaw::hertz())?);
    let spring = Series::new("linear spring", curve(PowerLaw::new(ratio(1, 1))?)?);
    let panel = Panel::new(Axis::linear("X/X_max"), vec![hertz, spring]);
    let panel = Panel { levels: vec![(1.0, "limit".to_owned())], ..panel };
    let time = Axis::linear("dimensionless time t h^(2/3) V^(1/3)");
    let remarks = [
        "Two long bars; 6.51 and 6.55, values certified. h = k (1/Z1 + 1/Z2), the force is k times the \
         compression to the power 3/2; the spring is the equivalent one of 6.56, h1 = h^(2/3) V^(1/3).",
    ];
    Ok(Box::new(listed.figure(time, vec![panel], &remarks)?.window(0.0, 5.0)?))
}

/// 6.16.
pub(super) fn rise_times(listed: &Listed) -> Drawn {
    let constant = double(&equal_bars_constant(&ratio(3, 10), BITS)?);
    let law = PowerLaw::hertz();
    let mut series = Vec::new();
    for (name, share) in [("90 %", ratio(9, 10)), ("50 %", ratio(1, 2)), ("10 %", ratio(1, 10))] {
        let time = double(&law.time(&share, BITS)?) / constant;
        // V R/(c r) from 10⁻⁴ to 1.
        let abscissae = (0..=120).map(|i| 10_f64.powf(-4.0 + f64::from(i) / 30.0));
        let points = abscissae.map(|x| (x, time / x.cbrt())).collect();
        series.push(Series::new(&format!("{name} of the largest force"), points));
    }
    let panel = Panel::new(Axis::logarithmic("rise time c t/r"), series);
    let remarks = [
        "Two equal bars of radius r with noses of radius R, Poisson's ratio 0.3; shares of the largest \
         force chosen here.",
        "By 6.54 c t/r falls as the cube root of V R/(c r).",
    ];
    let product = Axis::logarithmic("velocity × nose radius V R/(c r)");
    Ok(Box::new(listed.figure(product, vec![panel], &remarks)?))
}
