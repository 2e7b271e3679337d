//! Digits of a signal at a time: a rational value exactly, any other correctly rounded.
//!
//! What is known exactly comes first. Else enclosures of rising precision are rounded until that is
//! certain (Ziv). They never decide zero, nor a value half-way between two decimals: where these are
//! suspected, exact arithmetic is asked once more, at whatever cost.

use crate::ball::{Attempt, NEGLIGIBLE_BITS, Precisions, Value};
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::signal::{Known, Limit, Point, Signal};
use wavestep_polynomial::Rational;

/// A value that so many bits do not round is suspected to be half-way between two decimals.
const TIE_BITS: u64 = 1 << 12;

/// The precision with which one looks first whether a value may be zero.
const LOOK_BITS: u64 = 128;

/// The value of a signal at a time of its window, zero before time 0: exactly where it is known to be
/// rational, else correctly rounded to `digits` significant digits, with at most `limit_bits` bits of
/// working precision; enclosed where these do not prove the digits.
pub fn value(
    signal: &dyn Signal,
    at: &Rational,
    limit: Limit,
    digits: usize,
    limit_bits: u64,
) -> Outcome<Value> {
    signal.point(at, limit)?.value(digits, limit_bits)
}

/// The same, where the digits are needed.
pub fn digits(
    signal: &dyn Signal,
    at: &Rational,
    limit: Limit,
    digits: usize,
    limit_bits: u64,
) -> Outcome<Value> {
    match value(signal, at, limit, digits, limit_bits)? {
        Value::Enclosed(best) => {
            Err(EvaluateError::AccuracyNotReached { best: Box::new(best), bits: limit_bits })
        }
        value => Ok(value),
    }
}

/// The value where it is zero, or a rational number of which one look tells; nothing where exact
/// arithmetic cannot go so far.
pub(crate) fn rational_value(
    signal: &dyn Signal,
    at: &Rational,
    limit: Limit,
) -> Outcome<Option<Rational>> {
    match signal.point(at, limit).and_then(|point| point.rational()) {
        Err(
            EvaluateError::TooManyPeriods { .. }
            | EvaluateError::TooManyEchoes { .. }
            | EvaluateError::Network(_)
            | EvaluateError::NotReal,
        ) => Ok(None),
        value => value,
    }
}

impl Point<'_> {
    /// See [`value`].
    pub(crate) fn value(&self, digits: usize, limit_bits: u64) -> Outcome<Value> {
        let limit_bits = limit_bits.min(self.most_bits.max(16 * digits as u64));
        match &self.known {
            Known::Rational(value) => Ok(Value::Exact(value.clone())),
            Known::Irrational => Value::certify(digits, limit_bits, &self.enclose),
            Known::Unknown => self.suspicious(digits, limit_bits),
        }
    }

    /// The value where it is a rational number of which one look tells, or zero.
    pub(crate) fn rational(&self) -> Outcome<Option<Rational>> {
        Ok(match &self.known {
            Known::Rational(value) => Some(value.clone()),
            Known::Irrational => None,
            Known::Unknown => match self.told_from_zero(TIE_BITS)? {
                Some(_) => None,
                None => match (self.decide)() {
                    Known::Rational(value) => Some(value),
                    Known::Irrational | Known::Unknown => None,
                },
            },
        })
    }

    /// The digits of what may be zero, or half-way between two decimals.
    fn suspicious(&self, digits: usize, limit_bits: u64) -> Outcome<Value> {
        let mut limit_bits = limit_bits;
        let told = self.told_from_zero(limit_bits)?;
        if told.is_none() {
            match (self.decide)() {
                Known::Rational(value) => return Ok(Value::Exact(value)),
                Known::Irrational => {}
                Known::Unknown => {
                    if let Some(nothing) = self.nothing(digits, limit_bits)? {
                        return Ok(nothing);
                    }
                    // No precision tells that a value is zero.
                    limit_bits = limit_bits.min(TIE_BITS.max(8 * digits as u64));
                }
            }
        }
        let tie_bits = TIE_BITS.max(8 * digits as u64).min(limit_bits);
        match Value::certify_from(told.unwrap_or(0), digits, tie_bits, &self.enclose)? {
            Value::Certified { decimal, ball } if ball.is_exact() && decimal.is_zero() => {
                return Ok(Value::Exact(Rational::default()));
            }
            Value::Enclosed(best) => {
                if tie_bits == limit_bits
                    && let Some(value) = Value::near_zero(&best, digits, NEGLIGIBLE_BITS)
                {
                    return Ok(value);
                }
            }
            told => return Ok(told),
        }
        match (self.decide)() {
            Known::Rational(value) => Ok(Value::Exact(value)),
            _ => Value::certify(digits, limit_bits, &self.enclose),
        }
    }

    /// What is nothing beside other values, where a scene would be followed once more for its digits.
    fn nothing(&self, digits: usize, limit_bits: u64) -> Outcome<Option<Value>> {
        if self.most_bits == u64::MAX {
            return Ok(None);
        }
        let attempt = |bits| {
            let ball = (self.enclose)(bits)?;
            let nothing = Value::near_zero(&ball, digits, NEGLIGIBLE_BITS);
            let is_told = nothing.is_some() || !ball.contains_zero();
            Ok(Attempt::of(nothing, is_told))
        };
        Precisions::doubling(LOOK_BITS, limit_bits.max(LOOK_BITS)).raise(attempt).map(Attempt::best)
    }

    /// The bits that tell a value from zero, rising; none where it is so small that it may be zero.
    fn told_from_zero(&self, limit_bits: u64) -> Outcome<Option<u64>> {
        let attempt = |bits| {
            let ball = (self.enclose)(bits)?;
            Ok(match ball.contains_zero() {
                false => Attempt::Done(Some(bits)),
                true if *ball.radius() <= self.negligible => Attempt::Done(None),
                true => Attempt::NotYet(Some(bits)),
            })
        };
        Precisions::doubling(LOOK_BITS, limit_bits.max(LOOK_BITS)).raise(attempt).map(Attempt::best)
    }
}
