//! Where a function on a cell is proven positive by doubles alone: most forces and gaps are far from zero nearly
//! everywhere, and no long numbers are needed to see it.
//!
//! With `x = h t` the polynomial is `Σ a_k t^k`, `0 ≤ t ≤ 1`. It lies between the least and the largest of its
//! *Bernstein coefficients* `b_j = Σ_{k≤j} C(j,k)/C(n,k) a_k`, and the mean of neighbours, taken again and again, gives
//! those of its two halves (Farouki, Comput. Aided Geom. Des. 29 (2012) 379).

use crate::ball::{Ball, Magnitude, Number};
use crate::history::series::Series;
use std::cmp::Ordering;

/// Terms that are smaller than the largest by this power of two are no more than an error.
const NOTHING: i64 = 200;

/// The precision in which a value at the start is compared with zero.
const START_BITS: u64 = 64;

/// So often a cell is halved at most.
const MOST_HALVES: u32 = 12;

/// A polynomial on a part of a cell: its Bernstein coefficients.
type Part = Vec<f64>;

/// Until which share of its cell doubles prove a function positive, of whose polynomial value and slope are off by so
/// much at most; `None` for the whole of it.
///
/// Where the function is positive at the start, known from its coefficient, and rises, it need not be large.
///
/// # Cost
/// `N²` sums of doubles for the cell, and as many for each part that is halved.
pub fn positive_until(
    f: &Series,
    [error, slope]: &[Magnitude; 2],
    length: &Magnitude,
) -> Option<f64> {
    let start = f.coefficient(0).ball(START_BITS).widened(error);
    let begins = start.sign() == Some(Ordering::Greater);
    let (whole, [error, slope]) = in_doubles(f, [*error, slope.multiply(length)], length);
    let mut parts = vec![(0.0, 1.0, whole)];
    while let Some((from, size, part)) = parts.pop() {
        let is_first = from == 0.0 && begins;
        let rises = || {
            let steps = part.windows(2).map(|pair| pair[1] - pair[0]);
            let degree = (part.len() - 1) as f64;
            steps.fold(f64::INFINITY, f64::min) * degree > slope * size + 2.0 * degree * error
        };
        if part.iter().all(|b| *b > error) || is_first && rises() {
            continue;
        }
        if size <= 0.5_f64.powi(MOST_HALVES as i32) || part[0] <= error && !is_first {
            return Some(from);
        }
        let half = size / 2.0;
        let (left, right) = halves(part);
        parts.push((from + half, half, right));
        parts.push((from, half, left));
    }
    None
}

/// The Bernstein coefficients on a cell over a power of two, and bounds of the error of each of them, on each part of
/// the cell, and of that of the slope.
fn in_doubles(f: &Series, [error, slope]: [Magnitude; 2], length: &Magnitude) -> (Part, [f64; 2]) {
    // The length is p·2^e, its powers p_k·2^(e_k) with 1 ≤ p_k < 2.
    let exponent = length.top().map_or(0, |top| top - 1);
    let step = length.scale(-exponent).to_double();
    let (mut power, mut raised) = (1.0_f64, 0_i64);
    let mut terms: Vec<(f64, i64)> = Vec::with_capacity(f.coefficients.len());
    let mut left_out = error;
    let mut size = Magnitude::power_of_two(0);
    for c in &f.coefficients {
        let (value, top) = mantissa(c);
        if let Number::Enclosed(ball) = c {
            left_out = left_out.add(&ball.radius().multiply(&size));
        }
        terms.push((value * power, top + raised));
        size = size.multiply(length);
        power *= step;
        raised += exponent;
        if power >= 2.0 {
            (power, raised) = (power / 2.0, raised + 1);
        }
    }
    let top = terms.iter().map(|term| term.1).chain(left_out.top()).max().unwrap_or(0);
    let scaled = |(value, own): &(f64, i64)| match *own - top >= -NOTHING {
        true => value * Magnitude::power_of_two(*own - top).to_double(),
        false => 0.0,
    };
    let mut part: Part = terms.iter().map(scaled).collect();
    if part.is_empty() {
        part.push(0.0);
    }
    let degree = part.len() - 1;
    // Each coefficient and each power was rounded, each sum has positive weights that add up to one at most, and so has
    // each mean: none is off by more than a few units in the last place of the sum of all sizes, for each step.
    let sizes: f64 = part.iter().map(|a| a.abs()).sum();
    let steps = (degree + 8) as f64 * f64::from(MOST_HALVES + 4);
    let nothing = Magnitude::power_of_two(8 - NOTHING).to_double() * (degree + 1) as f64;
    let error = left_out.scale(-top).to_double() + sizes * steps * f64::EPSILON + nothing;
    let mut binomial = 1.0;
    for (k, a) in part.iter_mut().enumerate() {
        *a /= binomial;
        binomial *= (degree - k) as f64 / (k + 1) as f64;
    }
    for first in 1..=degree {
        for j in (first..=degree).rev() {
            part[j] += part[j - 1];
        }
    }
    (part, [error * (1.0 + 1e-9), slope.scale(-top).to_double() + nothing])
}

/// A number as a double below one and a power of two.
fn mantissa(number: &Number) -> (f64, i64) {
    let ball = number.ball(64);
    let Some(top) = ball.midpoint().top() else { return (0.0, i64::MIN / 4) };
    let scale = Magnitude::power_of_two(-top).to_binary();
    (Ball::new(ball.midpoint().multiply(&scale), Magnitude::ZERO).to_double().0, top)
}

/// Both halves of a part.
fn halves(mut part: Part) -> (Part, Part) {
    let last = part.len() - 1;
    let mut left = Vec::with_capacity(part.len());
    for done in 0..=last {
        left.push(part[0]);
        for j in 0..last - done {
            part[j] = f64::midpoint(part[j], part[j + 1]);
        }
    }
    (left, part)
}
