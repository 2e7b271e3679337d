//! Enclosures of the natural logarithm, of rational powers, and of the arctangent.
//!
//! A logarithm is the root of an exponential, found by Newton's method and proven by one more
//! exponential; a power is an exponential of a logarithm; an arctangent is a Taylor sum after its
//! argument has been halved.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use super::ball::Ball;
use super::binary::{Binary, LEAST_PRECISION};
use super::error::BallError;
use super::magnitude::Magnitude;

/// Good bits of a first guess in doubles, with a wide margin.
const GUESS_BITS: u64 = 40;

/// How often the argument of an arctangent is halved.
const HALVINGS: u32 = 5;

/// A double near `ln m` for a positive number: off by less than `2^−40 (1 + |ln m|)`.
fn guess(m: &Binary) -> Binary {
    let (top, bits) = (m.top().expect("not zero"), m.bits());
    // m = f·2^top with f from 1/2 to 1.
    let mantissa = m.mantissa();
    let kept = if bits > 60 { mantissa >> (bits - 60) } else { mantissa << (60 - bits) };
    let fraction = kept.to_f64().unwrap_or(1.0) / 60_f64.exp2();
    let value = fraction.ln() + top as f64 * std::f64::consts::LN_2;
    Binary::from_double(value).unwrap_or_else(Binary::zero)
}

/// `ln m` for a positive number.
///
/// With `y` any number, `ln m = y + ln(1 + δ)`, `δ = m e^{−y} − 1`, and `|ln(1 + δ) − δ| ≤ δ²` for
/// `|δ| ≤ 1/2`. Each round squares the distance.
fn logarithm(m: &Binary, precision: u64) -> Result<Ball, BallError> {
    let one = Ball::from_integer(&BigInt::one());
    let number = Ball::new(m.clone(), Magnitude::ZERO);
    let mut near = guess(m);
    let mut good = GUESS_BITS;
    loop {
        good = (2 * good - 8).min(precision);
        let working = good + 16;
        let minus = Ball::new(near.clone().negate(), Magnitude::ZERO);
        let delta = number.multiply(&minus.exp(working)?, working).subtract(&one, working);
        if delta.magnitude() > Magnitude::power_of_two(-1) {
            // The guess was useless, as that of a number beyond all doubles.
            return Err(BallError::ArgumentTooLarge);
        }
        let square = delta.magnitude().multiply(&delta.magnitude());
        let ball = Ball::new(near, Magnitude::ZERO).add(&delta, working).widened(&square);
        if good == precision {
            return Ok(ball);
        }
        near = ball.midpoint().clone();
    }
}

impl Ball {
    /// `ln x` over a ball of positive numbers. With the midpoint `m` and the radius `r`,
    /// `|ln x − ln m| ≤ r/(m − r)`.
    ///
    /// About two exponentials of the same precision.
    pub fn ln(&self, precision: u64) -> Result<Ball, BallError> {
        if self.contains_zero() || self.midpoint().is_negative() {
            return Err(BallError::NotPositive);
        }
        let precision = precision.max(LEAST_PRECISION);
        let ball = logarithm(self.midpoint(), precision)?;
        if self.is_exact() {
            return Ok(ball);
        }
        let (lower, _) = self.endpoints();
        let lower = Ball::new(lower, Magnitude::ZERO);
        let inverse = lower.reciprocal(LEAST_PRECISION).map_err(|_| BallError::NotPositive)?;
        Ok(ball.widened(&self.radius().multiply(&inverse.magnitude())))
    }

    /// `x^q = e^{q ln x}` over a ball of positive numbers.
    pub fn power(&self, exponent: &BigRational, precision: u64) -> Result<Ball, BallError> {
        if exponent.is_zero() {
            return Ok(Ball::from_integer(&BigInt::one()));
        }
        // The exponential turns the error of its argument into a relative one.
        let logarithm = self.ln(precision)?;
        let size = logarithm.magnitude().multiply(&Magnitude::from_rational(exponent));
        let more = size.top().unwrap_or(0).max(0) as u64 + 4;
        let logarithm = if self.is_exact() { self.ln(precision + more)? } else { logarithm };
        logarithm.multiply_rational(exponent, precision + more).exp(precision)
    }

    /// `arctan x` over a ball: it moves by no more than its argument.
    ///
    /// Five times `arctan x = 2 arctan(x/(1 + √(1 + x²)))`, then `x − x³/3 + …`; the sum stops where the
    /// next term, which bounds what is left out of an alternating sum with falling terms, is
    /// negligible.
    pub fn arctan(&self, precision: u64) -> Result<Ball, BallError> {
        let working = precision.max(LEAST_PRECISION) + 16;
        let one = Ball::from_integer(&BigInt::one());
        let mut x = Ball::new(self.midpoint().clone(), Magnitude::ZERO);
        for _ in 0..HALVINGS {
            let root = x.square(working).add(&one, working);
            let root = root.sqrt(working).ok_or(BallError::NotPositive)?;
            x = x.multiply(&root.add(&one, working).reciprocal(working)?, working);
        }
        // Now |x| < 1/20: the fifth half of π/2 is below 0.0491, and its tangent as well.
        let square = x.square(working).negate();
        let (mut power, mut sum, mut odd) = (x.clone(), x, 1_u32);
        loop {
            power = power.multiply(&square, working);
            odd += 2;
            let term = power
                .multiply_rational(&BigRational::new(BigInt::one(), BigInt::from(odd)), working);
            let size = term.magnitude();
            if size.is_zero() || size <= sum.magnitude().scale(-(working as i64)) {
                let sum = sum.widened(&size);
                let factor = BigRational::from_integer(BigInt::one() << HALVINGS);
                return Ok(sum.multiply_rational(&factor, working).widened(self.radius()));
            }
            sum = sum.add(&term, working);
        }
    }

    /// Whether all numbers of the ball are less than all of another one.
    pub fn is_below(&self, other: &Ball) -> bool {
        self.endpoints().1 < other.endpoints().0
    }
}
