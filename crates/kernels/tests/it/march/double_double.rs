//! A march of the rigid mass in two doubles a number, with its own rule for the number of
//! coefficients: the judge of many periods, where sums of echoes are too long.

use wavestep_kernels::double_double::DoubleDouble;

/// A pair of doubles from one.
fn pair(value: f64) -> DoubleDouble {
    DoubleDouble::from(value)
}

fn quotient(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
    let first = pair(a.high() / b.high());
    let rest = a - first * b;
    first + pair(rest.high() / b.high())
}

fn alternating(c: &[DoubleDouble]) -> DoubleDouble {
    c.iter().enumerate().rev().fold(pair(0.0), |s, (k, c)| if k % 2 == 0 { s + *c } else { s - *c })
}

/// `Σ c_k T_k(2x − 1)` by Clenshaw's recurrence.
pub fn chebyshev_value(coefficients: &[f64], x: f64) -> DoubleDouble {
    let t = pair(2.0 * x) - pair(1.0);
    let (mut near, mut far) = (pair(0.0), pair(0.0));
    for c in coefficients[1..].iter().rev() {
        let next = pair(*c) + (t + t) * near - far;
        (near, far) = (next, near);
    }
    pair(coefficients[0]) + t * near - far
}

/// The Chebyshev coefficients of `y_n`, `ρ = 1`, `A = B = rate`, on the last of `periods` periods.
pub fn rigid_mass(rate: f64, periods: usize) -> Vec<DoubleDouble> {
    let beta = pair(rate / 4.0);
    let count = |n: usize| {
        let z = (2.0 * n as f64 * rate).sqrt();
        (z + 6.0 * z.cbrt() + 60.0) as usize
    };
    let most = count(periods) + 80;
    // u_k = s_k − θ_k u_{k−1}, as long as the longest period.
    let (mut pivot, mut ratio) = (vec![pair(0.0); most], vec![pair(0.0); most]);
    let mut above = pair(0.0);
    for k in (1..most).rev() {
        pivot[k] = quotient(pair(1.0), pair(k as f64) + beta * above);
        above = beta * pivot[k];
        ratio[k] = above;
    }
    let mut decay = vec![pair(1.0); count(0)];
    for k in 1..decay.len() {
        let before = if k == 1 { pair(1.0) + pair(1.0) } else { decay[k - 1] };
        decay[k] = pair(0.0) - ratio[k] * before;
    }
    let scale = quotient(pair(1.0), alternating(&decay));
    decay.iter_mut().for_each(|c| *c = *c * scale);
    let (mut wave, mut increment) = (decay.clone(), decay.clone());
    for period in 1..periods {
        let before = increment.iter().rev().fold(pair(0.0), |sum, c| sum + *c);
        let length = count(period).max(wave.len());
        wave.resize(length, pair(0.0));
        let at = |k: usize| match k {
            0 => wave[0] + wave[0],
            k if k < length => wave[k],
            _ => pair(0.0),
        };
        // C/4 = 2β.
        let mut u = vec![pair(0.0); length + 1];
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
