//! Guesses in doubles for roots that are then proven: all roots of a polynomial, and rational numbers near
//! a double.

use num_traits::{FromPrimitive, One, ToPrimitive, Zero};
use wavestep_polynomial::{Integer, Rational};

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

/// The first convergents of the continued fraction of a number.
pub(crate) fn convergents(value: f64) -> Vec<Rational> {
    let mut found = Vec::new();
    let (mut x, mut before, mut last) =
        (value, (Integer::zero(), Integer::one()), (Integer::one(), Integer::zero()));
    for _ in 0..12 {
        let Some(whole) = Integer::from_f64(x.floor()) else { break };
        let next = (&whole * &last.0 + &before.0, &whole * &last.1 + &before.1);
        found.push(Rational::new(next.0.clone(), next.1.clone()));
        (before, last) = (last, next);
        let rest = x - x.floor();
        if rest < 1e-7 {
            break;
        }
        x = 1.0 / rest;
    }
    found.dedup();
    // An integer from below, as in 2.999…
    if let Some(nearest) = Integer::from_f64(value.round()) {
        found.push(Rational::from_integer(nearest));
    }
    found
}
