//! A ball written in decimals: a midpoint and a radius that still enclose the true value.

use std::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

use super::ball::Ball;
use super::decimal::{
    Decimal, decimal_exponent, half_even, power_of_ten_bound, rounded_up, scale_by_ten,
};
use super::magnitude::Magnitude;

/// Decimal places of the midpoint kept below the leading digit of the radius.
const EXTRA_PLACES: i64 = 2;
/// Midpoints whose exponents are within this are compared with their decimals exactly.
const EXACT_EXPONENT: u64 = 1 << 16;

/// A decimal midpoint and radius: every point of the ball they stand for lies within
/// `midpoint ± radius`.
///
/// The radius includes what the printing of the midpoint rounded away, and is itself rounded up.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct DecimalEnclosure {
    midpoint: Decimal,
    radius: Decimal,
}

impl DecimalEnclosure {
    pub const fn midpoint(&self) -> &Decimal {
        &self.midpoint
    }

    /// The radius, two significant digits; zero when the midpoint is the number. Print it with
    /// `{:e}`.
    pub const fn radius(&self) -> &Decimal {
        &self.radius
    }
}

/// `0.6667 ± 1.0e-4`, or the midpoint alone when it is exact.
impl fmt::Display for DecimalEnclosure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.radius.is_zero() {
            write!(formatter, "{}", self.midpoint)
        } else {
            write!(formatter, "{} ± {:e}", self.midpoint, self.radius)
        }
    }
}

impl Ball {
    /// The ball in decimals: the midpoint down to two places below the leading digit of the radius,
    /// thus with every digit that the ball proves, but with `most` digits at most.
    ///
    /// For each `x` of the ball: `|x − midpoint| ≤ radius`. A midpoint below a quarter of the radius is
    /// written as 0, since its digits say nothing.
    pub fn to_decimal(&self, most: usize) -> DecimalEnclosure {
        assert!(most > 0, "a decimal has at least one digit");
        let center = Ball::new(self.midpoint().clone(), Magnitude::ZERO).magnitude();
        if !self.is_exact() && center.scale(2) <= *self.radius() {
            let midpoint = Decimal::from_scaled(&BigInt::zero(), 0);
            return DecimalEnclosure { midpoint, radius: rounded_up(&self.magnitude()) };
        }
        let place = if self.is_exact() {
            None
        } else {
            Some(rounded_up(self.radius()).exponent() - EXTRA_PLACES)
        };
        let (midpoint, rounding) = self.printed_midpoint(place, most);
        DecimalEnclosure { midpoint, radius: rounded_up(&self.radius().add(&rounding)) }
    }

    /// The midpoint rounded to the place, or to `most` digits, whichever are fewer, and a bound of
    /// its distance from the midpoint.
    fn printed_midpoint(&self, place: Option<i64>, most: usize) -> (Decimal, Magnitude) {
        let value = self.midpoint();
        let Some(top) = value.top() else {
            return (Decimal::from_scaled(&BigInt::zero(), 0), Magnitude::ZERO);
        };
        let most_places = i64::try_from(most).unwrap_or(i64::MAX / 2);
        let coarsest = decimal_exponent(top - 1) + 1 - most_places;
        // An exact midpoint `m 2^e` has no digits beyond the place `e`.
        let last = place.unwrap_or(value.exponent().min(0));
        let mut place = last.max(coarsest);
        let (midpoint, low, high) = loop {
            let (low, high) = scale_by_ten(value, -place, half_even);
            let midpoint = Decimal::from_scaled(&low, place);
            if midpoint.significant() <= most {
                break (midpoint, low, high);
            }
            place += 1;
        };
        let units = Magnitude::from_integer(&(high - low + 1), 0);
        let comparable = value.exponent().unsigned_abs() <= EXACT_EXPONENT;
        if self.is_exact() && comparable && midpoint.to_rational() == BigRational::from(value) {
            return (midpoint.without_zeros(), Magnitude::ZERO);
        }
        (midpoint, units.multiply(&power_of_ten_bound(place)))
    }
}
