//! A march of the rigid mass in two doubles a number, with its own rule for the number of
//! coefficients: the judge of many periods, where sums of echoes are too long.

use std::ops::{Add, Mul, Sub};

/// An unevaluated sum of two doubles, some 31 digits.
#[derive(Clone, Copy, Debug)]
pub struct Double(pub f64, pub f64);

fn fast(a: f64, b: f64) -> Double {
    let sum = a + b;
    Double(sum, b - (sum - a))
}

impl Add for Double {
    type Output = Double;
    fn add(self, other: Double) -> Double {
        let sum = self.0 + other.0;
        let second = sum - self.0;
        let lost = (self.0 - (sum - second)) + (other.0 - second);
        fast(sum, lost + (self.1 + other.1))
    }
}

impl Sub for Double {
    type Output = Double;
    fn sub(self, other: Double) -> Double {
        self + Double(-other.0, -other.1)
    }
}

impl Mul for Double {
    type Output = Double;
    fn mul(self, other: Double) -> Double {
        let product = self.0 * other.0;
        let split = |x: f64| {
            let far = 134_217_729.0 * x;
            let high = far - (far - x);
            (high, x - high)
        };
        let ((a, b), (c, d)) = (split(self.0), split(other.0));
        let lost = ((a * c - product) + a * d + b * c) + b * d;
        fast(product, lost + (self.0 * other.1 + self.1 * other.0))
    }
}

const ZERO: Double = Double(0.0, 0.0);
const ONE: Double = Double(1.0, 0.0);

fn quotient(a: Double, b: Double) -> Double {
    let first = Double(a.0 / b.0, 0.0);
    let rest = a - first * b;
    first + Double(rest.0 / b.0, 0.0)
}

fn alternating(c: &[Double]) -> Double {
    c.iter().enumerate().rev().fold(ZERO, |s, (k, c)| if k % 2 == 0 { s + *c } else { s - *c })
}

/// `Σ c_k T_k(2x − 1)` by Clenshaw's recurrence.
pub fn chebyshev_value(coefficients: &[f64], x: f64) -> Double {
    let t = Double(2.0 * x, 0.0) - ONE;
    let (mut near, mut far) = (ZERO, ZERO);
    for c in coefficients[1..].iter().rev() {
        let next = Double(*c, 0.0) + (t + t) * near - far;
        (near, far) = (next, near);
    }
    Double(coefficients[0], 0.0) + t * near - far
}

/// The Chebyshev coefficients of `y_n`, `ρ = 1`, `A = B = rate`, on the last of `periods` periods.
pub fn rigid_mass(rate: f64, periods: usize) -> Vec<Double> {
    let beta = Double(rate / 4.0, 0.0);
    let count = |n: usize| {
        let z = (2.0 * n as f64 * rate).sqrt();
        (z + 6.0 * z.cbrt() + 60.0) as usize
    };
    let most = count(periods) + 80;
    // u_k = s_k − θ_k u_{k−1}, as long as the longest period.
    let (mut pivot, mut ratio) = (vec![ZERO; most], vec![ZERO; most]);
    let mut above = ZERO;
    for k in (1..most).rev() {
        pivot[k] = quotient(ONE, Double(k as f64, 0.0) + beta * above);
        above = beta * pivot[k];
        ratio[k] = above;
    }
    let mut decay = vec![ONE; count(0)];
    for k in 1..decay.len() {
        let before = if k == 1 { ONE + ONE } else { decay[k - 1] };
        decay[k] = ZERO - ratio[k] * before;
    }
    let scale = quotient(ONE, alternating(&decay));
    decay.iter_mut().for_each(|c| *c = *c * scale);
    let (mut wave, mut increment) = (decay.clone(), decay.clone());
    for period in 1..periods {
        let before = increment.iter().rev().fold(ZERO, |sum, c| sum + *c);
        let length = count(period).max(wave.len());
        wave.resize(length, ZERO);
        let at = |k: usize| match k {
            0 => wave[0] + wave[0],
            k if k < length => wave[k],
            _ => ZERO,
        };
        // C/4 = 2β.
        let mut u = vec![ZERO; length + 1];
        for k in (1..length).rev() {
            let side = (beta + beta) * (at(k + 1) - at(k - 1));
            u[k] = (side + beta * u[k + 1]) * pivot[k];
        }
        u.truncate(length);
        for k in 2..length {
            u[k] = u[k] - ratio[k] * u[k - 1];
        }
        let start = before - alternating(&u);
        u.iter_mut().zip(&decay).for_each(|(u, d)| *u = *u + start * *d);
        wave.iter_mut().zip(&u).for_each(|(w, u)| *w = *w + *u);
        increment = u;
    }
    wave
}
