//! Values: rational ones exactly, others with proven digits.

use crate::ball::{Ball, Certified, Decimal, Exactness, Magnitude};
use wavestep_polynomial::Rational;

/// The longest fraction that is written beside its decimals.
const MAX_FRACTION: usize = 60;

/// `−log₂` of a size that is nothing beside any value of a scene.
const NEGLIGIBLE_BITS: i64 = 1024;

/// A value at one time.
///
/// ```
/// use std::collections::BTreeMap;
/// use wavestep::evaluate::{Evaluator, Limit, Value};
/// use wavestep::language::{Source, parse_number, read_recurrence};
/// use wavestep::solution::Solution;
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = BTreeMap::from([("mu".to_owned(), parse_number("1/4")?)]);
/// let solution = Solution::new(read_recurrence(&Source::new("rigid-mass", text)?, &values)?);
/// let strain = solution.recurrence().observation("strain_fixed").unwrap();
/// let evaluator = Evaluator::new(&solution).unwrap();
/// let value = |at| {
///     evaluator.value(&strain, &parse_number(at).unwrap(), Limit::Right, 6, 200).unwrap()
/// };
/// // The fixed end is at rest until the front is there, at t = mu; it then feels it twice.
/// assert_eq!(value("1/8"), Value::Exact(parse_number("0")?));
/// assert_eq!(value("1/4"), Value::Exact(parse_number("-2")?));
/// let Value::Certified(later) = value("1/2") else { panic!("-2 exp(-1/4) is irrational") };
/// assert_eq!(later.decimal.to_string(), "-1.55760");
/// assert_eq!(value("1/4").to_text(6), "-2");
/// assert_eq!(value("1/2").decimal(6).0.to_string(), "-1.55760");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Value {
    /// A rational number, exactly.
    Exact(Rational),
    /// A number that is not rational, with proven digits.
    Certified(Certified),
}

impl Value {
    /// The value rounded to `digits` significant digits, and whether they are all of it. A
    /// certified value has the digits that it was asked for.
    pub fn decimal(&self, digits: usize) -> (Decimal, Exactness) {
        match self {
            Value::Exact(value) => Decimal::from_rational(value, digits),
            Value::Certified(certified) => (certified.decimal.clone(), Exactness::Rounded),
        }
    }

    /// Zero as far as can be told, where an enclosure says so: it is told as `0 ± r`.
    pub(crate) fn near_zero(ball: &Ball, digits: usize, bits: u64) -> Option<Value> {
        if !ball.contains_zero() || *ball.radius() > Magnitude::power_of_two(-NEGLIGIBLE_BITS) {
            return None;
        }
        let decimal = Decimal::from_rational(&Rational::default(), digits).0;
        Some(Value::Certified(Certified { decimal, ball: ball.clone(), bits, attempts: 1 }))
    }

    /// The value as plain text: its digits; a rational number that is no integer of so many digits
    /// as a fraction as well, where that is short.
    pub fn to_text(&self, digits: usize) -> String {
        match (self, self.decimal(digits)) {
            (Value::Exact(value), (_, Exactness::Exact)) if value.is_integer() => value.to_string(),
            (Value::Exact(value), (decimal, _)) => match value.to_string() {
                fraction if fraction.len() <= MAX_FRACTION => format!("{decimal} = {fraction}"),
                _ => decimal.to_string(),
            },
            (Value::Certified(certified), (decimal, _)) if decimal.is_zero() => {
                format!("0 ± {:e}", certified.ball.to_decimal(1).radius())
            }
            (_, (decimal, _)) => decimal.to_string(),
        }
    }
}

/// The distance of doubles at a value: `2^(e−52)` for `2^e ≤ |value| < 2^(e+1)`.
pub(crate) fn unit_in_the_last_place(value: f64) -> f64 {
    let value = value.abs().max(f64::MIN_POSITIVE);
    let power = f64::from_bits(value.to_bits() & !((1 << 52) - 1));
    power * f64::EPSILON
}
