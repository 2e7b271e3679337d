//! Near equal poles: formulas with powers of `1/(a − b)` against methods that never divide by it.

use crate::study::harness::{Subject, errors, worst};
use crate::study::reference::{Reference, Sampling};
use wavestep::answer::Method;
use wavestep::problem::Problem;
use wavestep_draw::{Axis, Caption, Curve, Curves, PlotError};
use wavestep_polynomial::Rational;

/// Waves with poles at −1 and −(1 + d): the echoes of f hold `1/d^j` up to the order of the echo.
const TEXT: &str = "recurrence \"Two poles\"\n\
    symbol d > 0\n\
    period 2, local s, time t\n\
    wave h, f\n\
    equation h[n]' + h[n] = h[n-1]' - h[n-1]\n\
    equation f[n]' + (1 + d)*f[n] = h[n]\n\
    continuous h[n] - h[n-1] starts at 1\n\
    continuous f[n] starts at 0\n";

/// The last time: five periods.
const LAST: f64 = 10.0;

/// The error of values by the distance of two poles, which is `10^−j`.
pub fn near_confluence(decades: u32, mut caption: Caption) -> Result<Curves, PlotError> {
    let methods = [Method::Expanded, Method::Compiled];
    let mut curves = methods.map(|method| Curve { name: method.to_string(), points: Vec::new() });
    for decade in 0..=decades {
        let distance = Rational::new(1.into(), num_bigint::BigInt::from(10).pow(decade));
        match at_distance(distance, &methods) {
            Some(row) => {
                for (curve, error) in curves.iter_mut().zip(row) {
                    curve.points.push((10f64.powi(-(decade as i32)), error));
                }
            }
            None => caption.remarks.push(format!("The distance 10^-{decade} is left out.")),
        }
    }
    caption
        .remarks
        .push("A recurrence made for this: poles at −1 and −1 − d, five periods.".into());
    let axis = Axis::logarithmic("distance d of the poles");
    Curves::new("Error near equal poles", axis, Axis::logarithmic("error"), curves.into(), caption)?
        .level(1e-8, "8 digits lost")
}

fn at_distance(distance: Rational, methods: &[Method]) -> Option<Vec<f64>> {
    let values = [("d".to_owned(), distance)].into();
    let problem = Problem::of_text("two poles", TEXT, &values).ok()?;
    let question = Subject { problem: &problem, quantity: "f" }.between(0.0, LAST).ok()?;
    let times = Sampling { points: 50, seed: 1 }.times(0.0, LAST);
    let reference = Reference::new(&question, &times).ok()?;
    let error = |method: &Method| errors(&question, *method, &reference).ok().map(|e| worst(&e));
    methods.iter().map(error).collect()
}
