//! Decimal numbers: the digits of a ball that are beyond doubt, and of an exact rational.
//!
//! Rounding is to nearest, ties to the even last digit. It is monotone, so a ball rounds one way
//! only if both of its ends do.

use std::cmp::Ordering;
use std::fmt;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::ball::Ball;
use super::binary::Binary;
use super::magnitude::Magnitude;

/// The least leading place printed positionally: `0.000012`.
const LEAST_POSITIONAL: i64 = -5;
/// Numbers whose binary or decimal exponent exceeds this are scaled by powers of ten that are
/// themselves rounded.
const EXACT_EXPONENT: u64 = 1 << 16;

/// A decimal number with a definite count of digits: `±d.ddd·10^e`.
///
/// It prints positionally when all its digits before the point are there and the number is not
/// below `10^(−5)`, in scientific notation otherwise; `{:e}` always prints the latter.
///
/// # Invariants
/// - At least one digit; the first is not 0 unless all are. Zero has no sign and the exponent 0.
/// - Numbers of different counts of digits differ: `1.0` is not `1.00`.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Decimal {
    negative: bool,
    digits: String,
    exponent: i64,
}

/// Whether a decimal is the number it stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Exactness {
    /// The decimal is the number.
    Exact,
    /// The decimal is the nearest to the number.
    Rounded,
}

/// The most digits of a number in decimals.
const DECIMALS: usize = 17;

/// A rational number in decimals where few of them are all, else as a fraction.
pub fn in_decimals(value: &BigRational) -> String {
    match Decimal::from_rational(value, DECIMALS) {
        (decimal, Exactness::Exact) => decimal.to_string(),
        _ => value.to_string(),
    }
}

/// On which side of a number a decimal may lie.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Bound {
    /// Not above it.
    Lower,
    /// Not below it.
    Upper,
}

impl Decimal {
    /// A decimal of so many digits at most that bounds a rational: the nearest one, or the one beside it.
    pub fn bound(value: &BigRational, significant: usize, bound: Bound) -> Self {
        let near = Self::from_rational(value, significant).0;
        let told = near.to_rational();
        let (is_bound, side) = match bound {
            Bound::Upper => (told >= *value, 1),
            Bound::Lower => (told <= *value, -1),
        };
        if is_bound {
            return near;
        }
        // The one beside it, which has more digits, or fewer, at a power of ten.
        let place = near.exponent + 1 - near.digits.len() as i64;
        let nearest: BigInt = near.digits.parse().expect("digits");
        let signed = if near.negative { -nearest } else { nearest };
        let beside = Self::from_scaled(&(signed + side), place);
        match beside.digits.len().cmp(&near.digits.len()) {
            Ordering::Equal => beside,
            _ => Self::from_rational(&beside.to_rational(), significant).0,
        }
    }

    /// The number `value·10^place` with the digits of `value`.
    pub(super) fn from_scaled(value: &BigInt, place: i64) -> Self {
        let digits = value.magnitude().to_str_radix(10);
        let exponent = if value.is_zero() { 0 } else { place + digits.len() as i64 - 1 };
        Self { negative: value.is_negative(), digits, exponent }
    }

    /// Zero with this count of digits.
    fn zero(significant: usize) -> Self {
        Self { negative: false, digits: "0".repeat(significant), exponent: 0 }
    }

    /// The decimal of `significant` digits nearest to a rational, ties to even. When fewer digits
    /// are the number exactly, the zeros that say nothing are left out.
    ///
    /// A division of integers as long as the fraction's terms and the digits.
    pub fn from_rational(value: &BigRational, significant: usize) -> (Self, Exactness) {
        assert!(significant > 0, "a decimal has at least one digit");
        if value.is_zero() {
            return (Self::zero(1), Exactness::Exact);
        }
        let floor = value.numer().bits() as i64 - 1 - value.denom().bits() as i64;
        let mut scaled = (BigInt::zero(), BigInt::one());
        let decimal = settle(floor, significant, |places| {
            let power = BigInt::from(10).pow(places.unsigned_abs() as u32);
            let (numerator, denominator) = if places >= 0 {
                (value.numer() * power, value.denom().clone())
            } else {
                (value.numer().clone(), value.denom() * power)
            };
            let rounded = half_even(&numerator, &denominator);
            scaled = (&rounded * &denominator, numerator);
            Some(rounded)
        })
        .expect("every rational has a nearest decimal");
        if scaled.0 == scaled.1 {
            (decimal.without_zeros(), Exactness::Exact)
        } else {
            (decimal, Exactness::Rounded)
        }
    }

    /// The count of digits.
    pub fn significant(&self) -> usize {
        self.digits.len()
    }

    /// Whether the number is zero.
    pub fn is_zero(&self) -> bool {
        self.digits.starts_with('0')
    }

    /// The power of ten of the first digit.
    pub(super) const fn exponent(&self) -> i64 {
        self.exponent
    }

    /// The power of ten of the last digit.
    pub fn place(&self) -> i64 {
        self.exponent + 1 - self.digits.len() as i64
    }

    /// The exact value. The cost grows with the exponent.
    pub fn to_rational(&self) -> BigRational {
        let digits = BigInt::parse_bytes(self.digits.as_bytes(), 10).expect("digits are a number");
        let digits = BigRational::from_integer(if self.negative { -digits } else { digits });
        let ten = BigRational::from_integer(10.into());
        digits * ten.pow(i32::try_from(self.place()).expect("a power of ten that fits the memory"))
    }

    fn is_positional(&self) -> bool {
        (LEAST_POSITIONAL..self.digits.len() as i64).contains(&self.exponent)
    }

    /// Without the trailing zeros, but for those before the point of a number printed positionally.
    pub(super) fn without_zeros(mut self) -> Self {
        let least = if self.is_positional() { (self.exponent + 1).max(1) as usize } else { 1 };
        let kept = self.digits.trim_end_matches('0').len().max(least);
        self.digits.truncate(kept);
        self
    }
}

impl fmt::Display for Decimal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.is_positional() {
            return fmt::LowerExp::fmt(self, formatter);
        }
        let mut text = String::new();
        if self.exponent < 0 {
            text.push_str("0.");
            text.extend(std::iter::repeat_n('0', self.exponent.unsigned_abs() as usize - 1));
            text.push_str(&self.digits);
        } else {
            let (whole, fraction) = self.digits.split_at(self.exponent as usize + 1);
            text.push_str(whole);
            if !fraction.is_empty() {
                text.push('.');
                text.push_str(fraction);
            }
        }
        formatter.pad_integral(!self.negative, "", &text)
    }
}

impl fmt::LowerExp for Decimal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (first, rest) = self.digits.split_at(1);
        let point = if rest.is_empty() { "" } else { "." };
        let text = format!("{first}{point}{rest}e{}", self.exponent);
        formatter.pad_integral(!self.negative, "", &text)
    }
}

impl Ball {
    /// The decimal of `significant` digits that every point of the ball rounds to, or `None` if there
    /// are several. The tie between two decimals goes to the even last digit.
    ///
    /// A ball around zero that is not the point zero itself has no such decimal. `None` may also be
    /// returned for a point within about `2^(−64)` units of the last digit of a tie when its exponent
    /// is beyond `±2^16`.
    ///
    /// Products and divisions of integers as long as the digits and the exponent of the ball, up to
    /// `2^16`; independent of the exponent beyond.
    pub fn proven_digits(&self, significant: usize) -> Option<Decimal> {
        assert!(significant > 0, "a decimal has at least one digit");
        if self.contains_zero() {
            return self.is_exact().then(|| Decimal::zero(significant));
        }
        let (lower, upper) = self.endpoints();
        let decimal = nearest(&lower, significant)?;
        if self.is_exact() || nearest(&upper, significant)? == decimal {
            Some(decimal)
        } else {
            None
        }
    }
}

/// The decimal nearest to a number that is not zero, if the scaling leaves no doubt.
fn nearest(value: &Binary, significant: usize) -> Option<Decimal> {
    settle(value.top()? - 1, significant, |places| {
        let (low, high) = scale_by_ten(value, places, half_even);
        (low == high).then_some(high)
    })
}

/// Finds the place at which a number has `significant` digits and rounds it there.
///
/// `floor` is a `t` with `2^t ≤ |x|`, near `log_2 |x|`, and `scaled(k)` rounds `x·10^k` to an
/// integer, each time by the same monotone rule.
fn settle(
    floor: i64,
    significant: usize,
    mut scaled: impl FnMut(i64) -> Option<BigInt>,
) -> Option<Decimal> {
    let limit = BigInt::from(10).pow(significant as u32);
    // The search goes upwards only: from above, a number just below a power of ten would round up
    // to it with one digit too few.
    let mut exponent = decimal_exponent(floor);
    loop {
        let places = significant as i64 - 1 - exponent;
        let rounded = scaled(places)?;
        if rounded.magnitude() < limit.magnitude() {
            return Some(Decimal::from_scaled(&rounded, -places));
        }
        // Either the number has a digit more, or it was carried to 10^significant; then it becomes
        // 10^(significant−1) at the next place.
        exponent += 1;
    }
}

/// `⌊t·log_10 2⌋` or one less: the power of ten `10^e ≤ 2^t`.
pub(super) fn decimal_exponent(power: i64) -> i64 {
    const UNIT: i128 = 10_000_000_000_000_000_000;
    // log_10 2 to 19 places, rounded towards the lower result.
    let logarithm = 3_010_299_956_639_811_952 + i128::from(power < 0);
    (i128::from(power) * logarithm).div_euclid(UNIT) as i64
}

/// `n/d` rounded to the nearest integer, ties to even; `d > 0`.
pub fn half_even(numerator: &BigInt, denominator: &BigInt) -> BigInt {
    let doubled: BigInt = denominator << 1_u32;
    let (quotient, remainder) = ((numerator << 1_u32) + denominator).div_mod_floor(&doubled);
    if remainder.is_zero() && quotient.is_odd() { quotient - 1 } else { quotient }
}

/// `⌈n/d⌉`, `d > 0`.
fn ceiling(numerator: &BigInt, denominator: &BigInt) -> BigInt {
    Integer::div_ceil(numerator, denominator)
}

/// `(l, h)` with `l ≤ round(value·10^places) ≤ h`; they are equal unless the exponents are beyond
/// `±2^16`, and then nearly always.
pub(super) fn scale_by_ten(
    value: &Binary,
    places: i64,
    round: fn(&BigInt, &BigInt) -> BigInt,
) -> (BigInt, BigInt) {
    if value.exponent().unsigned_abs() <= EXACT_EXPONENT && places.unsigned_abs() <= EXACT_EXPONENT
    {
        let rounded = round_scaled(value, places, round);
        return (rounded.clone(), rounded);
    }
    scale_far(value, places, round)
}

/// `(l, h)` with `l ≤ round(value·10^places) ≤ h`, from an enclosure of the power of ten.
pub fn scale_far(
    value: &Binary,
    places: i64,
    round: fn(&BigInt, &BigInt) -> BigInt,
) -> (BigInt, BigInt) {
    // The result is near 10^digits: as many bits as it has, and 64 for the fraction.
    let size = value
        .top()
        .unwrap_or(0)
        .saturating_add(power_of_ten(places, 64).magnitude().top().unwrap_or(0));
    let precision = value.bits().max(size.max(0) as u64) + 64;
    let product = power_of_ten(places, precision)
        .multiply(&Ball::new(value.clone(), Magnitude::ZERO), precision);
    let (lower, upper) = product.endpoints();
    (round_near_zero(lower, round), round_near_zero(upper, round))
}

/// `round(value)`, at a cost that does not depend on a negative exponent.
fn round_near_zero(value: Binary, round: fn(&BigInt, &BigInt) -> BigInt) -> BigInt {
    match value.top() {
        // Both rules round all numbers between 0 and ±1/2 alike.
        Some(top) if top < -1 => {
            let sign = if value.is_negative() { -BigInt::one() } else { BigInt::one() };
            round_scaled(&Binary::new(sign, -2), 0, round)
        }
        _ => round_scaled(&value, 0, round),
    }
}

/// `round(value·10^places)`.
pub fn round_scaled(value: &Binary, places: i64, round: fn(&BigInt, &BigInt) -> BigInt) -> BigInt {
    let mut numerator = value.mantissa();
    let mut denominator =
        BigInt::from(10).pow(if places < 0 { places.unsigned_abs() as u32 } else { 0 });
    if places > 0 {
        numerator *= BigInt::from(10).pow(places.unsigned_abs() as u32);
    }
    if value.exponent() >= 0 {
        numerator <<= value.exponent().unsigned_abs();
    } else {
        denominator <<= value.exponent().unsigned_abs();
    }
    round(&numerator, &denominator)
}

/// A ball around `10^exponent` with `radius ≤ 2^(−p)·10^exponent` for precision `p`.
fn power_of_ten(exponent: i64, precision: u64) -> Ball {
    // The relative error of a power grows like its exponent.
    let working = precision + 2 * u64::from(64 - exponent.unsigned_abs().leading_zeros()) + 8;
    let base = if exponent < 0 {
        BigRational::new_raw(BigInt::one(), BigInt::from(10))
    } else {
        BigRational::from_integer(BigInt::from(10))
    };
    let base = Ball::from_rational(&base, working);
    let mut power = Ball::from_integer(&BigInt::one());
    for bit in (0..64 - exponent.unsigned_abs().leading_zeros()).rev() {
        power = power.square(working);
        if exponent.unsigned_abs() >> bit & 1 == 1 {
            power = power.multiply(&base, working);
        }
    }
    power
}

/// An upper bound of a power of ten.
pub(super) fn power_of_ten_bound(exponent: i64) -> Magnitude {
    power_of_ten(exponent, 64).magnitude()
}

/// The bound with two significant digits, rounded up.
pub fn rounded_up(bound: &Magnitude) -> Decimal {
    let value = bound.to_binary();
    value
        .top()
        .and_then(|top| settle(top - 1, 2, |places| Some(scale_by_ten(&value, places, ceiling).1)))
        .unwrap_or_else(|| Decimal::zero(1))
}

/// Scientific with two significant digits, rounded up: `3.1e-31`; zero is `0`.
impl fmt::Display for Magnitude {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_zero() {
            formatter.pad("0")
        } else {
            fmt::LowerExp::fmt(&rounded_up(self), formatter)
        }
    }
}
