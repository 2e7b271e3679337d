//! Certified doubles: weighted sums of delayed solutions at given times, correctly rounded.

use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

use super::equation::DelayEquation;
use super::error::FixedError;
use super::multiplier::Multiplier;
use super::position::{ExactTime, Position, Reduction};
use super::scheme::Scheme;
use super::value::{FRACTION_BITS, FixedValue, round_to_double};
use super::walk::Walk;
use crate::Limit;
use crate::exponent::scale;

/// The most taps of a sum.
const MOST_TAPS: usize = 8;

/// A delayed solution with a weight: `w·Y(T − d)`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Tap {
    /// The weight w, a pure number.
    pub weight: BigRational,
    /// The delay d, a time.
    pub delay: BigRational,
}

/// Doubles, and which of them are not certain.
#[derive(Clone, PartialEq, Debug)]
pub struct CertifiedDoubles {
    /// One value a time: the double nearest to the exact sum, unless the place is listed in
    /// `undecided`; there it is near.
    pub values: Vec<f64>,
    /// The places of the values that the bound does not decide, ascending.
    pub undecided: Vec<usize>,
}

/// The sum `Σ wᵢ Y(T − dᵢ)` at given times, as correctly rounded doubles; times that are doubles are the
/// exact numbers that they are. Before the start, Y is zero exactly.
///
/// The weights are scaled by a power of two so that the largest is from 1/2 to below 1 in
/// size; then a weighted value is off by `|w|·radius`, and by one unit more for the weight and the
/// product.
///
/// A march up to the last time, of which two periods are held, and for each tap and time a reduction
/// and some forty products.
pub fn certified<T: ExactTime>(
    equation: &DelayEquation,
    taps: &[Tap],
    times: &[T],
    side: Limit,
) -> Result<CertifiedDoubles, FixedError> {
    if taps.len() > MOST_TAPS {
        return Err(FixedError::TooManyTaps(taps.len()));
    }
    let (taps, shift) = prepare(equation, taps)?;
    let mut seen = Vec::with_capacity(times.len() * taps.len());
    for (place, time) in times.iter().enumerate() {
        for (weight, reduction) in &taps {
            if let Some(position) = time.position(reduction, side)? {
                seen.push(Seen { place, weight: *weight, position });
            }
        }
        if !time.is_finite() {
            return Err(FixedError::TimeNotFinite);
        }
    }
    seen.sort_by_key(|seen| seen.position.period);
    let sums = match seen.last() {
        None => vec![FixedValue::default(); times.len()],
        Some(last) => {
            let periods = last.position.period + 1;
            let scheme = Scheme::for_doubles(equation, periods)?;
            weighted_sums(scheme, &seen, times.len())?
        }
    };
    let fraction_bits = i64::from(FRACTION_BITS) - shift;
    let mut undecided = Vec::new();
    let double = |(place, FixedValue { midpoint, radius }): (usize, FixedValue)| {
        round_to_double(midpoint, radius, fraction_bits).unwrap_or_else(|| {
            undecided.push(place);
            scale(midpoint as f64, -fraction_bits)
        })
    };
    let values = sums.into_iter().enumerate().map(double).collect();
    Ok(CertifiedDoubles { values, undecided })
}

/// Where the solution is asked for, with the weight there.
struct Seen {
    /// Which of the sums it is for.
    place: usize,
    weight: Multiplier,
    position: Position,
}

/// So many sums of the solution, at positions by ascending periods.
fn weighted_sums(
    scheme: Scheme,
    seen: &[Seen],
    count: usize,
) -> Result<Vec<FixedValue>, FixedError> {
    let mut sums = vec![FixedValue::default(); count];
    let Some(last) = seen.last() else { return Ok(sums) };
    let mut rest = seen;
    Walk::new(scheme).through(last.position.period, |number, period| {
        let here = rest.partition_point(|seen| seen.position.period == number);
        let (now, later) = rest.split_at(here);
        rest = later;
        for seen in now {
            let value = period.value(&seen.position);
            let sum = &mut sums[seen.place];
            sum.midpoint += seen.weight.times(value.midpoint);
            // A radius is below 2^112; its own rounding, and that of the product.
            sum.radius += seen.weight.times(value.radius as i128).unsigned_abs() + 2;
        }
    })?;
    Ok(sums)
}

/// The weights that are not zero, scaled by `2^−s` with one s for all, how times are reduced for them, and s.
fn prepare(
    equation: &DelayEquation,
    taps: &[Tap],
) -> Result<(Vec<(Multiplier, Reduction)>, i64), FixedError> {
    let largest = taps.iter().map(|tap| tap.weight.abs()).max().unwrap_or_default();
    if largest.is_zero() {
        return Ok((Vec::new(), 0));
    }
    let scale = binary_exponent(&largest);
    let scaled = |weight: &BigRational| {
        let power = num_bigint::BigInt::from(1) << scale.unsigned_abs();
        if scale < 0 { weight * power } else { weight / power }
    };
    let weighty = taps.iter().filter(|tap| !tap.weight.is_zero());
    let prepared = weighty.map(|tap| {
        let weight = Multiplier::near(&scaled(&tap.weight)).expect("scaled weights are below 1");
        Ok((weight, Reduction::new(&equation.period, &tap.delay)?))
    });
    Ok((prepared.collect::<Result<_, _>>()?, scale))
}

/// The least s with `value < 2^s`, for a positive value.
fn binary_exponent(value: &BigRational) -> i64 {
    let (numerator, denominator) = (value.numer(), value.denom());
    let bits = |value: &num_bigint::BigInt| value.bits().to_i64().unwrap_or(i64::MAX);
    let least = bits(numerator) - bits(denominator) - 1;
    let fits = |scale: i64| {
        let shift = scale.unsigned_abs();
        if scale < 0 {
            numerator << shift < *denominator
        } else {
            *numerator < denominator << shift
        }
    };
    (least..).find(|&scale| fits(scale)).unwrap_or(least)
}
