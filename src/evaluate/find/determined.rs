//! A number as far as it is known: with proven digits, or an enclosure.

use crate::ball::Ball;
use crate::evaluate::error::EvaluateError;
use crate::evaluate::evaluator::certified;
use crate::evaluate::value::Value;

/// The precision of doubles, and a few bits more.
const DOUBLE_BITS: u64 = 64;

/// A time or a value that was found.
///
/// ```
/// use wavestep::ball::Ball;
/// use wavestep::evaluate::{Determined, Value};
/// use wavestep::language::parse_number;
///
/// let half = parse_number("1/2")?;
/// assert_eq!(Determined::Digits(Value::Exact(half)).to_text(9), "0.5 = 1/2");
/// let third = Ball::from_rational(&parse_number("1/3")?, 20);
/// assert_eq!(Determined::Enclosed(third).to_text(9), "0.333333492 ± 4.8e-7");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Determined {
    /// Rational and exact, or rounded correctly to the digits asked for.
    Digits(Value),
    /// Enclosed, but not so that one decimal is left: it may be half-way between two.
    Enclosed(Ball),
}

impl Determined {
    /// The digits that `enclosure` proves with no more bits than allowed, or the best enclosure.
    pub(crate) fn of(
        digits: usize,
        limit_bits: u64,
        enclosure: impl FnMut(u64) -> Result<Ball, EvaluateError>,
    ) -> Result<Determined, EvaluateError> {
        match certified(digits, limit_bits, enclosure) {
            Ok(Value::Certified(found)) if found.ball.is_exact() => {
                Ok(Determined::Digits(Value::Exact(found.ball.midpoint().into())))
            }
            Ok(value) => Ok(Determined::Digits(value)),
            Err(EvaluateError::AccuracyNotReached { best, .. }) => Ok(Determined::Enclosed(*best)),
            Err(error) => Err(error),
        }
    }

    /// A double near it, for pictures.
    ///
    /// ```
    /// use wavestep::evaluate::{Determined, Value};
    /// use wavestep::language::parse_number;
    ///
    /// let third = Determined::Digits(Value::Exact(parse_number("1/3")?));
    /// assert_eq!(third.to_double(), 1.0 / 3.0);
    /// # Ok::<(), wavestep::language::Diagnostic>(())
    /// ```
    pub fn to_double(&self) -> f64 {
        match self {
            Determined::Digits(Value::Exact(value)) => {
                Ball::from_rational(value, DOUBLE_BITS).to_double().0
            }
            Determined::Digits(Value::Certified(found)) => found.ball.to_double().0,
            Determined::Enclosed(ball) => ball.to_double().0,
        }
    }

    /// The number as plain text: its digits, a fraction beside them where that is short, or a
    /// midpoint with a radius.
    pub fn to_text(&self, digits: usize) -> String {
        match self {
            Determined::Digits(value) => value.to_text(digits),
            Determined::Enclosed(ball) => ball.to_decimal(digits).to_string(),
        }
    }
}
