//! The slow motions of a block, apart from its fast ones.
//!
//! A light mass on a spring has rates that differ by powers of ten: of `y' = A y + B u` some motions are gone when
//! others have hardly begun. With a rate `r` between both, `P` projects on the slow ones, along the fast ones: `A` maps
//! either onto itself. The Cayley transform `W = (1 + A/r)(1 − A/r)⁻¹` has eigenvalues near 1 where those of `A` are
//! slow, near −1 where they are fast, and `(1 + sign W)/2 = P`; no node gives energy, so that `1 − A/r` has an inverse.
//!
//! Nothing here is proven, and nothing needs to be: what follows from `P` is put back into the equation, and what is
//! left of it counts as an error (`motion.rs`).

use crate::ball::{Magnitude, Number};
use crate::network::{dot, inverse};

/// A small matrix, by rows.
pub type Rows = Vec<Vec<Number>>;

/// Rates are told apart where they differ by this power of two.
const APART: f64 = 6.0;

/// So many steps are made until the first digit of a sign is known.
const MORE_STEPS: u32 = 4;

/// The slow motions of a block.
pub struct Separation {
    /// The norm of `A P`.
    pub rate: Magnitude,
    /// How long the fast motions last, in the time `1/‖A‖`: until they are an `e`-th, by the mean of their decrements, the
    /// trace of `A (P − 1)` over that of `1 − P`.
    pub lasting: f64,
    /// `P`.
    pub slow: Rows,
    /// `(1 − P) A⁻¹`, where `A⁻¹` is that of the fast motions alone.
    pub fast_inverse: Rows,
}

impl Separation {
    /// Those of a block, the slowest first, which takes all motions to be fast.
    pub fn all_of(change: &Rows, norm: impl Fn(&Rows) -> Magnitude, bits: u64) -> Vec<Separation> {
        let tops = rates(change, bits);
        let spread = match (tops.first(), tops.last()) {
            (Some(first), Some(last)) => (first - last).max(0.0) as u64,
            _ => 0,
        };
        let bits = bits + spread;
        let none = filled(change.len(), |_, _| Number::zero());
        let all_fast = inverse(change.clone(), bits)
            .map(|inverse| Separation::new(change, none, inverse, (&norm, bits)));
        let gaps = tops.windows(2).rev().filter(|pair| pair[0] - pair[1] >= APART);
        let between = gaps.filter_map(|pair| {
            let lower = pair[1].max(pair[0] - 2.0 * APART);
            let rate = ((pair[0] + lower) / 2.0).round() as i64;
            Separation::at(change, rate, &norm, bits)
        });
        all_fast.into_iter().chain(between).collect()
    }

    /// With a rate `2^top` between slow and fast.
    fn at(
        change: &Rows,
        top: i64,
        norm: impl Fn(&Rows) -> Magnitude,
        bits: u64,
    ) -> Option<Separation> {
        let (size, half) = (change.len(), power_of_two(-1));
        let (rate, time) = (power_of_two(top), power_of_two(-top));
        let scaled = |i: usize, j: usize| change[i][j].multiply(&time, bits);
        let [above, below] = [
            filled(size, |i, j| one(i, j).add(&scaled(i, j), bits)),
            filled(size, |i, j| one(i, j).subtract(&scaled(i, j), bits)),
        ];
        let mut sign = bare(product(&above, &inverse(below, bits)?, bits), bits);
        // Each step of Newton's iteration doubles the digits that are known.
        for _ in 0..MORE_STEPS + bits.ilog2() {
            let other = inverse(sign.clone(), bits)?;
            let mean =
                |i: usize, j: usize| sign[i][j].add(&other[i][j], bits).multiply(&half, bits);
            sign = bare(filled(size, mean), bits);
        }
        let square = product(&sign, &sign, bits);
        let left = norm(&filled(size, |i, j| square[i][j].subtract(&one(i, j), bits)));
        if left > Magnitude::power_of_two(-(bits as i64) / 2) {
            return None;
        }
        let slow = filled(size, |i, j| one(i, j).add(&sign[i][j], bits).multiply(&half, bits));
        let fast = filled(size, |i, j| one(i, j).subtract(&slow[i][j], bits));
        // A on the fast motions, and −r on the slow ones.
        let own = product(change, &fast, bits);
        let regular =
            filled(size, |i, j| own[i][j].subtract(&slow[i][j].multiply(&rate, bits), bits));
        let fast_inverse = product(&fast, &inverse(regular, bits)?, bits);
        Some(Separation::new(change, slow, fast_inverse, (norm, bits)))
    }

    fn new(
        change: &Rows,
        slow: Rows,
        fast_inverse: Rows,
        (norm, bits): (impl Fn(&Rows) -> Magnitude, u64),
    ) -> Separation {
        let own = product(change, &slow, bits);
        let zero = Number::zero;
        let sum = |entry: &dyn Fn(usize) -> Number| {
            (0..slow.len()).fold(zero(), |sum, i| sum.add(&entry(i), bits))
        };
        let decrement = sum(&|i| own[i][i].subtract(&change[i][i], bits));
        let count = sum(&|i| one(i, i).subtract(&slow[i][i], bits));
        let lasting = decrement.reciprocal(bits).map_or(f64::INFINITY, |time| {
            norm(change).multiply(&count.multiply(&time, bits).magnitude()).to_double()
        });
        let (slow, fast_inverse) = (bare(slow, bits), bare(fast_inverse, bits));
        Separation { rate: norm(&own), lasting, slow, fast_inverse }
    }
}

/// The logarithms of the rates of a matrix, the fastest first, to a few units where they are far apart: the slopes of
/// Newton's polygon of `det(λ − A)`, whose coefficients are found by Faddeev's and Leverrier's recursion. A rate of zero
/// is far below the others.
fn rates(change: &Rows, bits: u64) -> Vec<f64> {
    let size = change.len();
    let mut tops = vec![(0, 0)];
    let mut power = filled(size, |_, _| Number::zero());
    let mut coefficient = Number::one();
    for k in 1..=size {
        power = filled(size, |i, j| match i == j {
            true => power[i][j].add(&coefficient, bits),
            false => power[i][j].clone(),
        });
        power = product(change, &power, bits);
        let trace = (0..size).fold(Number::zero(), |sum, i| sum.add(&power[i][i], bits));
        coefficient = trace.negate().over(k as u64, bits);
        tops.extend(coefficient.magnitude().top().map(|top| (k, top)));
    }
    let mut slopes = Vec::with_capacity(size);
    let mut own = 0;
    while own + 1 < tops.len() {
        let slope = |other: &usize| {
            let [(from, low), (to, high)] = [tops[own], tops[*other]];
            (high - low) as f64 / (to - from) as f64
        };
        let steepest = (own + 1..tops.len())
            .max_by(|one, other| slope(one).total_cmp(&slope(other)).then(one.cmp(other)));
        let Some(next) = steepest else { break };
        slopes.extend(std::iter::repeat_n(slope(&next), tops[next].0 - tops[own].0));
        own = next;
    }
    let slowest = slopes.last().copied().unwrap_or(0.0);
    slopes.resize(size, slowest - 2.0 * APART);
    slopes
}

fn one(i: usize, j: usize) -> Number {
    if i == j { Number::one() } else { Number::zero() }
}

fn power_of_two(top: i64) -> Number {
    Number::Exact((&Magnitude::power_of_two(top)).into())
}

fn filled(size: usize, entry: impl Fn(usize, usize) -> Number) -> Rows {
    (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
}

fn product(one: &Rows, other: &Rows, bits: u64) -> Rows {
    let column = |j: usize| other.iter().map(|row| row[j].clone()).collect::<Vec<_>>();
    let columns: Rows = (0..other.len()).map(column).collect();
    filled(one.len(), |i, j| dot(&one[i], &columns[j], bits))
}

/// Without radii.
fn bare(rows: Rows, bits: u64) -> Rows {
    let bare = |value: Number| value.split(bits).0;
    rows.into_iter().map(|row| row.into_iter().map(bare).collect()).collect()
}
