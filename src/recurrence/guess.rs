//! Guesses in doubles for the roots of a polynomial, which are then proven.

use num_traits::ToPrimitive;
use wavestep_polynomial::Rational;

/// Roots to about ten digits, by the simultaneous iteration of Weierstrass.
pub(crate) fn approximate_roots(polynomial: &[Rational]) -> Option<Vec<(f64, f64)>> {
    let coefficients: Vec<f64> = polynomial.iter().map(Rational::to_f64).collect::<Option<_>>()?;
    let degree = coefficients.len() - 1;
    let times = |a: (f64, f64), b: (f64, f64)| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
    let over = |a: (f64, f64), b: (f64, f64)| {
        let norm = b.0 * b.0 + b.1 * b.1;
        let (re, im) = times(a, (b.0, -b.1));
        (re / norm, im / norm)
    };
    let radius = 1.0 + coefficients.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    let start = |k: usize| {
        let angle = 0.4 + std::f64::consts::TAU * k as f64 / degree as f64;
        let radius = radius.powf(0.5);
        (radius * angle.cos(), radius * angle.sin())
    };
    let mut roots: Vec<(f64, f64)> = (0..degree).map(start).collect();
    for _ in 0..500 {
        for i in 0..degree {
            let x = roots[i];
            let value = coefficients.iter().fold((0.0, 0.0), |sum, c| {
                let (re, im) = times(sum, x);
                (re + c, im)
            });
            let others = roots.iter().enumerate().filter(|(j, _)| *j != i);
            let spread =
                others.fold((1.0, 0.0), |product, (_, y)| times(product, (x.0 - y.0, x.1 - y.1)));
            let step = over(value, spread);
            if step.0.is_finite() && step.1.is_finite() {
                roots[i] = (x.0 - step.0, x.1 - step.1);
            }
        }
    }
    Some(roots)
}
