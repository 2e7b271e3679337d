//! Polynomials on equal spans that abut, and short polynomials in doubles across several of them, with a
//! proven distance.
//!
//! A short polynomial is guessed by interpolation; nothing of that is proven. Its distance from the
//! long ones is proven afterwards, from its doubles alone: on each part of a span both are expanded
//! about the middle of the part, in integers, and the sizes of the differences are added up.

use super::interpolation::Interpolation;
use super::multiplier::{Fraction, MULTIPLIER_BITS, Multiplier};
use super::part::shifted;
use super::product::upper_product;
use super::value::FRACTION_BITS;
use num_bigint::BigInt;
use num_integer::Integer as _;
use num_rational::BigRational;
use num_traits::{Signed as _, ToPrimitive as _};

/// Times are integers below `2^TIME_BITS`; their unit is chosen so that they nearly reach it.
const TIME_BITS: i32 = 125;

/// The fewest bits of half a span or half a cell in units of time: places are right to
/// `2^−POSITION_ERROR_BITS`, see [`Spans`].
const LEAST_BITS: u32 = 96;

/// Places within a span are off by less than two to the minus this.
const POSITION_ERROR_BITS: u32 = 88;

/// The most spans.
const MOST_SPANS: usize = 1 << 20;

/// Sums of sizes of coefficients are below this: then no product leaves its range.
const MOST_UNITS: u128 = 1 << 120;

/// A function on a stretch of time: on the span k, `centre_k ± half`, a polynomial
/// `Σ_m c_m v^m`, `v = (t − centre_k)/half`, in units of `2^−112`.
///
/// # Invariants
/// - Spans abut, and all have one length. Their centres and halves are integers in units of time, a
///   power of two; a centre is off by less than two units, the half by less than one, and it is `2^96`
///   at least. A place v of a time is a quotient of numbers of units: for that it is off by less than
///   `2^−94`, for the quotient itself by less than `2^−100`, and for the units by which parts of spans
///   are widened by less than `2^−89`: all in all by less than `2^−88`.
/// - The sizes of the coefficients of a span add up to less than `2^120` units.
#[derive(Clone, Debug)]
pub struct Spans {
    spans: Vec<Span>,
    /// Units of time are `2^−unit_bits`.
    unit_bits: i32,
    half: i128,
    /// `⌊2^(n + 126)/half⌋` for a half of n bits, from `2^126` to `2^127`.
    inverse: u128,
    /// What a span can be off from the function, in units.
    radius: u128,
    interpolation: Interpolation,
}

#[derive(Clone, Debug)]
struct Span {
    centre: i128,
    coefficients: Vec<i128>,
    /// `Σ m |c_m|`, in units.
    slope: u128,
}

/// A polynomial in doubles on a cell: `Σ_k coefficients[k] u^k`, `u = (t − middle)/scale`.
#[derive(Clone, Debug, PartialEq)]
pub struct Interpolant {
    /// The least double of the cell.
    pub first: f64,
    /// The greatest double of the cell.
    pub last: f64,
    /// Where `u = 0`.
    pub middle: f64,
    /// A power of two, larger than the distance of the middle from the ends.
    pub scale: f64,
    /// The coefficients, the constant first.
    pub coefficients: Vec<f64>,
}

/// A cell in units of time.
struct Cell {
    middle: i128,
    half: i128,
    /// The scale is `2^scale_bits` units.
    scale_bits: i32,
}

impl Spans {
    /// Spans `start + k length`, each with its polynomial, which is off from the function by `radius`
    /// units at most, to be interpolated by polynomials of a degree. None if numbers leave their range:
    /// times at or beyond `2^100`, spans shorter than about `2^−24` of the latest time, large
    /// coefficients, degrees beyond 31.
    ///
    /// O(coefficients), and O(degree³) for the interpolation.
    pub fn new(
        start: &BigRational,
        length: &BigRational,
        polynomials: Vec<Vec<i128>>,
        radius: u128,
        degree: usize,
    ) -> Option<Self> {
        let count = polynomials.len();
        if count == 0 || count > MOST_SPANS || !length.is_positive() {
            return None;
        }
        let end = start + length * BigRational::from(BigInt::from(count));
        let latest = start.abs().max(end.abs()).ceil().to_integer();
        let unit_bits = TIME_BITS - 1 - i32::try_from(latest.bits()).ok()?;
        if !(24..=TIME_BITS).contains(&unit_bits) {
            return None;
        }
        let in_units = |value: &BigRational, more: u32| -> BigInt {
            (value.numer() << (unit_bits as u32 + more)).div_floor(value.denom())
        };
        // With 20 bits more, products with the number of a span are off by less than a unit.
        let (from, step) = (in_units(start, 21), in_units(length, 21));
        let half = (in_units(length, 0) / 2_u32).to_i128()?;
        if half < 1 << LEAST_BITS {
            return None;
        }
        let inverse = (BigInt::from(1) << (bit_length(half) + 126)) / half;
        let mut spans = Vec::with_capacity(count);
        for (k, mut coefficients) in polynomials.into_iter().enumerate() {
            while coefficients.last() == Some(&0) {
                coefficients.pop();
            }
            let (sum, slope) = sizes(&coefficients);
            if sum >= MOST_UNITS {
                return None;
            }
            let centre: BigInt = &from + &step * k + (&step >> 1_u32);
            spans.push(Span { centre: (centre >> 21_u32).to_i128()?, coefficients, slope });
        }
        let interpolation = Interpolation::new(degree)?;
        let inverse = inverse.to_u128()?;
        Some(Self { spans, unit_bits, half, inverse, radius, interpolation })
    }

    /// `value/half`, clamped to what multipliers can be, off by less than `2^−100` for `|value| ≤ half`.
    ///
    /// With n bits of the half, the product is `value 2^(126−n) ⌊2^(n+126)/half⌋/2^128`, which is
    /// `2^124 value/half` but for the rounding of the inverse, a part of `2^−126`, and its own.
    fn place(&self, value: i128) -> Multiplier {
        let value = value.clamp(-self.half, self.half);
        let product = upper_product(value << (126 - bit_length(self.half)), self.inverse);
        let size = product.unsigned_abs();
        let size = if size >> 124 == 0 { size << 4 } else { u128::MAX };
        Multiplier { size: Fraction(size), negative: value < 0 }
    }

    /// A double in units of time, rounded downwards; none where it is no time.
    fn units(&self, time: f64) -> Option<i128> {
        let scaled = time * f64::from(self.unit_bits).exp2();
        (scaled.abs() < f64::from(TIME_BITS).exp2()).then_some(scaled.floor() as i128)
    }

    /// A cell from its first to its last double, in units and with its middle as a double.
    fn cell(&self, first: f64, last: f64) -> Option<(Cell, f64)> {
        let (from, to) = (self.units(first)?, self.units(last)? + 1);
        let unit = f64::from(-self.unit_bits).exp2();
        // Without the units below it, a double is a number of units.
        let middle = self.units(first + (last - first) / 2.0)?;
        let half = (to - middle).max(middle - from);
        // The scale is larger than the half and what is added to it for parts of cells.
        let scale_bits = i128::BITS as i32 - (half + 256).leading_zeros() as i32;
        let is_cell = first <= last && half >= 1 << LEAST_BITS && scale_bits < TIME_BITS;
        is_cell.then_some((Cell { middle, half, scale_bits }, middle as f64 * unit))
    }

    /// A span that a time in units lies in, or the one next to it.
    fn span_of(&self, time: i128) -> usize {
        let later = self.spans.partition_point(|span| span.centre + self.half < time);
        later.min(self.spans.len() - 1)
    }

    /// The polynomial that agrees with the function at the nodes of Chebyshev on a cell, about: how far
    /// it is off, [`distance`](Self::distance) tells. None if the cell is narrower than `2^96` units.
    ///
    /// O(degree · terms + degree²).
    pub fn interpolated(&self, first: f64, last: f64) -> Option<Interpolant> {
        let (cell, middle) = self.cell(first, last)?;
        let value = |node: Multiplier| {
            let time = cell.middle + node.times(cell.half);
            let span = &self.spans[self.span_of(time)];
            let place = self.place(time - span.centre);
            span.coefficients.iter().rev().fold(0, |sum, c| place.times(sum) + c)
        };
        let coefficients = self.interpolation.coefficients(value, cell.half, cell.scale_bits);
        let scale = f64::from(cell.scale_bits - self.unit_bits).exp2();
        Some(Interpolant { first, last, middle, scale, coefficients })
    }

    /// A proven bound of `|p(t) − f(t)|` on a cell, at all its times within the spans; none if the cell
    /// is narrower than `2^96` units or its coefficients are large.
    ///
    /// Let the cell and a span have the part `m ± h` in common, widened by a unit on each side, and
    /// `t = m + hw`. The place in the cell is `u = α + βw` with `α = (m − middle)/scale` and
    /// `β = h/scale`, without error. The place in the span is `a + bw`, off by less than `2^−88`, and
    /// there the polynomial of the span changes by less than `2^−87 Σ m|c_m|`. Both polynomials are
    /// expanded in w, off by less than a unit for each pair of their coefficients, and the difference is
    /// written in Chebyshev polynomials, off by as much again: `|p − s| ≤ Σ_m |d_m|` for
    /// `p − s = Σ_m d_m T_m(w)`. (Powers of w would do as well, but the error of an interpolation
    /// resembles a Chebyshev polynomial, whose powers add up to `(1 + √2)^m`.) For a whole span `w = v` is off itself: `|w| ≤ 1 + 2^−88`, and
    /// the polynomial of the cell is the one that changes. The coefficients of the cell are rounded to
    /// units, half a unit each.
    ///
    /// O(degree² + terms²) for each span that the cell touches; for those that lie in it, O(degree²).
    pub fn distance(&self, interpolant: &Interpolant) -> Option<f64> {
        let (cell, middle) = self.cell(interpolant.first, interpolant.last)?;
        let scale = f64::from(cell.scale_bits - self.unit_bits).exp2();
        if middle != interpolant.middle || scale != interpolant.scale {
            return None;
        }
        let unit = f64::from(FRACTION_BITS).exp2();
        let mut coefficients = Vec::with_capacity(interpolant.coefficients.len());
        for coefficient in &interpolant.coefficients {
            let scaled = (coefficient * unit).round();
            // Beyond the range this is clamped, and refused below; NaN is refused here.
            coefficients.push((!scaled.is_nan()).then_some(scaled as i128)?);
        }
        let (sum, slope) = sizes(&coefficients);
        if sum >= MOST_UNITS {
            return None;
        }
        let (from, to) = (cell.middle - cell.half, cell.middle + cell.half);
        let mut largest = 0_u128;
        for span in &self.spans[self.span_of(from).saturating_sub(1)..] {
            let (start, end) = (span.centre - self.half, span.centre + self.half);
            // A unit on each side holds what rounding may have moved.
            if start - 64 > to {
                break;
            }
            if end + 64 < from {
                continue;
            }
            let is_whole = start >= from && end <= to;
            let (middle, half) = if is_whole {
                (span.centre, self.half)
            } else {
                let (low, high) = (start.max(from) - 64, end.min(to) + 64);
                let middle = low + (high - low) / 2;
                (middle, (high - middle).max(middle - low))
            };
            let alpha = scaled_down(middle - cell.middle, cell.scale_bits)?;
            let beta = scaled_down(half, cell.scale_bits)?;
            let short = shifted(coefficients.clone(), alpha, beta)?;
            let long = if is_whole {
                span.coefficients.clone()
            } else {
                let a = self.place(middle - span.centre);
                shifted(span.coefficients.clone(), a, self.place(half))?
            };
            let length = short.len().max(long.len());
            let mut difference = long;
            difference.resize(length, 0);
            difference.iter_mut().zip(&short).for_each(|(long, short)| *long -= short);
            let difference = size_by_chebyshev(&difference);
            let products = short.len().pow(2) + 2 * length.pow(2);
            let moved = (span.slope + slope) >> (POSITION_ERROR_BITS - 1);
            let roundings = (products + short.len() + 2) as u128;
            largest = largest.max(difference + moved + roundings);
        }
        let bound = (largest + self.radius) as f64 / unit;
        // The conversion, and `T_m(w) ≤ cosh(63 √(2^−86)) < 1 + 2^−70`.
        Some(bound * (1.0 + 1.0 / (1_u64 << 40) as f64))
    }
}

/// `Σ |c_m|` and `Σ m |c_m|`.
fn sizes(coefficients: &[i128]) -> (u128, u128) {
    let mut sums = (0_u128, 0_u128);
    for (m, coefficient) in (0..).zip(coefficients) {
        let size = coefficient.unsigned_abs();
        sums.0 = sums.0.saturating_add(size);
        sums.1 = sums.1.saturating_add(size.saturating_mul(m));
    }
    sums
}

/// `Σ_m |d_m|` for `Σ_k c_k w^k = Σ_m d_m T_m(w)`, off by less than a unit for each pair of coefficients.
///
/// By Horner's rule with `w T_0 = T_1` and `w T_m = (T_{m+1} + T_{m−1})/2`: halves are rounded
/// downwards, and an error of a coefficient is not enlarged by what follows, because `|w| ≤ 1`.
fn size_by_chebyshev(coefficients: &[i128]) -> u128 {
    let mut series = vec![0_i128; coefficients.len() + 1];
    for (used, &coefficient) in coefficients.iter().rev().enumerate() {
        let mut below = 0;
        for m in 0..=used {
            let half = if m == 0 { series[0] } else { series[m] >> 1 };
            // What T_m gives upwards waits until T_{m+1} has given downwards.
            let next = below;
            below = half;
            if m > 0 {
                series[m - 1] += half;
            }
            series[m] = next;
        }
        series[0] += coefficient;
    }
    series.iter().map(|d| d.unsigned_abs()).sum()
}

/// How many bits a positive number has.
fn bit_length(value: i128) -> u32 {
    i128::BITS - value.leading_zeros()
}

/// `value/2^bits`, exactly, for a size below 1; else none.
fn scaled_down(value: i128, bits: i32) -> Option<Multiplier> {
    let shift = MULTIPLIER_BITS.checked_sub(u32::try_from(bits).ok()?)?;
    let size = value.unsigned_abs();
    (size.leading_zeros() >= shift && shift < 128)
        .then(|| Multiplier { size: Fraction(size << shift), negative: value < 0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `T_5 = 16 w⁵ − 20 w³ + 5 w`, and others with it.
    #[test]
    fn sizes_are_those_of_chebyshev_polynomials() {
        let unit = 1_i128 << 80;
        let size = |row: &[i128]| {
            let row: Vec<i128> = row.iter().map(|c| c * unit).collect();
            size_by_chebyshev(&row) as f64 / unit as f64
        };
        assert_eq!(size(&[0, 5, 0, -20, 0, 16]), 1.0);
        assert_eq!(size(&[3]), 3.0);
        // w² = T_0/2 + T_2/2, and w³ = 3/4 T_1 + T_3/4.
        assert_eq!([size(&[0, -7]), size(&[0, 0, 1]), size(&[-1, 0, 1])], [7.0, 1.0, 1.0]);
        assert_eq!(size(&[0, 1, 0, -1]), 0.5);
        assert!(size_by_chebyshev(&[1; 37]) <= 37 * 37);
    }
}
