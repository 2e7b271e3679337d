//! Positions: the period of a time and the place in it, exactly or rounded downwards.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

use super::error::FixedError;
use crate::Limit;

/// Fraction bits of a place in a period.
pub(super) const POSITION_BITS: u32 = 120;
/// The place at the end of a period.
const END: u128 = 1 << POSITION_BITS;

/// A place in a period: `n + x` periods after the start.
///
/// # Invariants
/// - An exact position has `x = fraction·2^−120`, from 0 to 1; at 0 and 1 the limit from inside the
///   period is meant.
/// - One that is not has `fraction·2^−120 < x < (fraction + 1)·2^−120`, with `fraction < 2^120`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Position {
    /// The period n.
    pub period: u32,
    /// The place x in units of `2^−120`, rounded downwards.
    pub fraction: u128,
    /// Whether the place is not rounded.
    pub exact: bool,
}

impl Position {
    /// The position `fraction·2^−120` in a period.
    pub fn exact(period: u32, fraction: u128) -> Result<Self, FixedError> {
        if fraction > END {
            return Err(FixedError::PositionOutside);
        }
        Ok(Self { period, fraction, exact: true })
    }

    /// The place on the period as a double from 0 to 1, off by `2^−53` of itself and `2^−120` at most.
    pub fn local(&self) -> f64 {
        self.fraction as f64 / END as f64
    }

    /// The position at or before a joint, as the side says; none before the start.
    fn on_side(self, side: Limit) -> Option<Self> {
        if side == Limit::Right || self.fraction > 0 || !self.exact {
            return Some(self);
        }
        let period = self.period.checked_sub(1)?;
        Some(Self { period, fraction: END, exact: true })
    }
}

/// The reduction of times to positions: `(T − d)/D = n + x`, with a period D and a delay d.
///
/// # Invariants
/// - `D > 0`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Reduction {
    period: BigRational,
    delay: BigRational,
    words: Option<Words>,
}

/// `(T − d)/D = (T·scale − delay)/divisor` in words.
///
/// # Invariants
/// - `scale > 0`, `divisor > 0`, `|delay| < 2^126`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Words {
    scale: u64,
    delay: i128,
    divisor: u64,
}

impl Reduction {
    /// The reduction for a period and a delay.
    pub fn new(period: &BigRational, delay: &BigRational) -> Result<Self, FixedError> {
        if !period.is_positive() {
            return Err(FixedError::PeriodNotPositive);
        }
        let words = Words::new(period, delay);
        Ok(Self { period: period.clone(), delay: delay.clone(), words })
    }

    /// The position of a time that is a double, which is taken as the exact number it is; none
    /// before the start.
    ///
    /// Three divisions of words, if period and delay are fractions of words; divisions of long
    /// integers otherwise.
    pub fn of_double(&self, time: f64, side: Limit) -> Result<Option<Position>, FixedError> {
        if !time.is_finite() {
            return Err(FixedError::TimeNotFinite);
        }
        if let Some(words) = &self.words
            && let Some(found) = words.reduce(time)
        {
            return Ok(found?.and_then(|position| position.on_side(side)));
        }
        let time = BigRational::from_float(time).ok_or(FixedError::TimeNotFinite)?;
        self.of_rational(&time, side)
    }

    /// The position of a time that is a rational; none before the start.
    ///
    /// Divisions of long integers.
    pub fn of_rational(
        &self,
        time: &BigRational,
        side: Limit,
    ) -> Result<Option<Position>, FixedError> {
        let periods = (time - &self.delay) / &self.period;
        let (period, rest) = periods.numer().div_mod_floor(periods.denom());
        if period.is_negative() {
            return Ok(None);
        }
        let period = to_period(&period).ok_or(FixedError::TimeTooLate)?;
        let (fraction, rest) = (rest << POSITION_BITS).div_mod_floor(periods.denom());
        let fraction = fraction.to_u128().ok_or(FixedError::PositionOutside)?;
        let position = Position { period, fraction, exact: rest.is_zero() };
        Ok(position.on_side(side))
    }
}

/// A time that is taken as the exact number it is: a double or a rational number.
pub trait ExactTime {
    /// Whether it is a number.
    fn is_finite(&self) -> bool;

    /// Its position; none before the start.
    fn position(&self, reduction: &Reduction, side: Limit) -> Result<Option<Position>, FixedError>;
}

impl ExactTime for f64 {
    fn is_finite(&self) -> bool {
        f64::is_finite(*self)
    }

    fn position(&self, reduction: &Reduction, side: Limit) -> Result<Option<Position>, FixedError> {
        reduction.of_double(*self, side)
    }
}

impl ExactTime for BigRational {
    fn is_finite(&self) -> bool {
        true
    }

    fn position(&self, reduction: &Reduction, side: Limit) -> Result<Option<Position>, FixedError> {
        reduction.of_rational(self, side)
    }
}

/// An integer as a count of periods; the last one is left out, so that a count of periods up to it
/// fits too.
fn to_period<T: ToPrimitive>(period: &T) -> Option<u32> {
    period.to_u32().filter(|&period| period < u32::MAX)
}

impl Words {
    /// The fractions over one denominator, if they fit.
    fn new(period: &BigRational, delay: &BigRational) -> Option<Self> {
        let delays = delay / period;
        let divisor = period.numer().lcm(delays.denom());
        let scale: BigInt = &divisor / period.numer() * period.denom();
        let delay: BigInt = &divisor / delays.denom() * delays.numer();
        let delay = delay.to_i128().filter(|delay| delay.unsigned_abs() < 1 << 126)?;
        Some(Self { scale: scale.to_u64()?, delay, divisor: divisor.to_u64()? })
    }

    /// The position of a finite time on the right side of a joint; `Some(Ok(None))` before the
    /// start, `None` if the numbers do not fit.
    ///
    /// With `T·scale = w·2^−k` and `w = h·2^k + l`, `0 ≤ l < 2^k`, the numerator is
    /// `h − delay + l·2^−k`. Its floor division by the divisor c leaves `r + l·2^−k` with `r < c`,
    /// and the place is `⌊(r·2^120 + ⌊l·2^(120−k)⌋)/c⌋`: the inner floor does not change the outer
    /// one.
    #[inline]
    fn reduce(&self, time: f64) -> Option<Result<Option<Position>, FixedError>> {
        let (significand, exponent) = parts(time)?;
        let product = u128::from(significand) * u128::from(self.scale);
        let (whole, low, k) = if exponent >= 0 {
            if exponent as u32 + 2 > product.leading_zeros() {
                return None;
            }
            (product << exponent, 0, 0)
        } else {
            let k = exponent.unsigned_abs();
            let whole = product.checked_shr(k).unwrap_or(0);
            (whole, product - whole.checked_shl(k).unwrap_or(0), k)
        };
        let numerator = whole as i128 - self.delay;
        if numerator < 0 {
            return Some(Ok(None));
        }
        let (period, rest) = divide(numerator as u128, self.divisor);
        let Some(period) = to_period(&period) else {
            return Some(Err(FixedError::TimeTooLate));
        };
        let (low, dropped) = match k.checked_sub(POSITION_BITS) {
            None => (low << (POSITION_BITS - k), false),
            Some(excess) => {
                let kept = low.checked_shr(excess).unwrap_or(0);
                (kept, kept.checked_shl(excess).unwrap_or(0) != low)
            }
        };
        // r·2^120 + low in words of 64 bits: the two upper ones, below c·2^56, then the lowest.
        let upper = (u128::from(rest) << (POSITION_BITS - 64)) + (low >> 64);
        let (high, rest) = divide(upper, self.divisor);
        let lower = (u128::from(rest) << 64) | (low & u128::from(u64::MAX));
        let (low, rest) = divide(lower, self.divisor);
        let exact = rest == 0 && !dropped;
        Some(Ok(Some(Position { period, fraction: (high << 64) + low, exact })))
    }
}

/// Quotient and remainder; words of 64 bits where they suffice, which is much faster.
#[inline]
fn divide(numerator: u128, divisor: u64) -> (u128, u64) {
    if let Ok(short) = u64::try_from(numerator) {
        return (u128::from(short / divisor), short % divisor);
    }
    let divisor = u128::from(divisor);
    (numerator / divisor, (numerator % divisor) as u64)
}

/// The significand and the exponent of a finite double, `significand·2^exponent`; none for negative
/// ones.
#[inline]
fn parts(time: f64) -> Option<(u64, i32)> {
    let bits = time.to_bits();
    let (exponent, digits) = ((bits >> 52) as i32, bits & ((1 << 52) - 1));
    match exponent {
        0 => Some((digits, -1074)),
        1..=0x7fe => Some((digits | 1 << 52, exponent - 1075)),
        _ => None,
    }
}
