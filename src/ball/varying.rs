//! Numbers that vary with a parameter: polynomials in it, with a bound of what they leave out.
//!
//! With balls in their place nothing would be left of the difference of two numbers that vary alike.

use super::arithmetic::Arithmetic;
use super::ball::Ball;
use super::error::BallError;
use super::magnitude::Magnitude;
use super::number::Number;
use num_traits::One as _;
use wavestep_polynomial::Rational;

/// The highest power of the parameter that is kept.
const DEGREE: usize = 6;

/// A function of a parameter, `f(ν) = Σ_k c_k ν^k + e(ν)` with `|e(ν)| ≤ rest` for `−1 ≤ ν ≤ 1`.
///
/// # Invariants
/// - There are at most `DEGREE + 1` coefficients, the last of them not known to be zero.
/// - Operations enclose what they say for every `ν`.
#[derive(Clone, PartialEq, Debug)]
pub struct Varying {
    coefficients: Vec<Ball>,
    rest: Magnitude,
}

impl From<Ball> for Varying {
    fn from(ball: Ball) -> Varying {
        Varying::new(vec![ball], Magnitude::ZERO)
    }
}

impl Varying {
    fn new(mut coefficients: Vec<Ball>, rest: Magnitude) -> Varying {
        while coefficients.last().is_some_and(|last| last.is_exact() && last.contains_zero()) {
            coefficients.pop();
        }
        Varying { coefficients, rest }
    }

    pub fn constant(value: &Rational, bits: u64) -> Varying {
        Ball::from_rational(value, bits).into()
    }

    /// All values from one to another, in order.
    pub fn between([low, high]: [&Rational; 2], bits: u64) -> Varying {
        let two = Rational::from_integer(2.into());
        let [middle, half] = [(high + low) / &two, (high - low) / &two];
        let coefficients = [middle, half].map(|own| Ball::from_rational(&own, bits));
        Varying::new(coefficients.to_vec(), Magnitude::ZERO)
    }

    /// The coefficient of a power of the parameter.
    pub fn coefficient(&self, power: usize) -> Ball {
        self.coefficients.get(power).cloned().unwrap_or_else(Ball::zero)
    }

    /// A bound of what the coefficients below a power leave out.
    pub fn beyond(&self, power: usize) -> Magnitude {
        let further = self.coefficients.iter().skip(power);
        further.fold(self.rest, |sum, own| sum.add(&own.magnitude()))
    }

    /// All of its values.
    pub fn range(&self) -> Ball {
        self.coefficient(0).widened(&self.beyond(1))
    }

    /// The same as a number.
    pub fn number(&self) -> Number {
        if self.is_zero() { Number::zero() } else { Number::Enclosed(self.range()) }
    }

    /// A polynomial without radii near it, and how far it is from that at most.
    pub fn split(&self) -> (Varying, Magnitude) {
        let radii = self.coefficients.iter().map(Ball::radius);
        let off = radii.fold(self.rest, |sum, radius| sum.add(radius));
        let middle = |own: &Ball| Ball::new(own.midpoint().clone(), Magnitude::ZERO);
        let middles = self.coefficients.iter().map(middle).collect();
        (Varying::new(middles, Magnitude::ZERO), off)
    }

    /// The quotient by an integer that is not zero.
    pub fn over(&self, divisor: u64, bits: u64) -> Varying {
        let coefficients = self.coefficients.iter().map(|own| own.over(divisor, bits)).collect();
        Varying::new(coefficients, self.rest.divide(divisor))
    }

    /// The square root; none where it may not be positive.
    pub fn sqrt(&self, bits: u64) -> Option<Varying> {
        let at_middle = self.coefficient(0).sqrt(bits)?;
        let next =
            |factor: &Rational, k: i64| factor * Rational::new((3 - 2 * k).into(), (2 * k).into());
        self.composed(&at_middle, next, bits).ok()
    }

    /// `g(c₀) Σ_k a_k u^k` for `f = c₀ (1 + u)`, where `a₀ = 1`, each factor follows from the one before, and none is above 1.
    fn composed(
        &self,
        at_middle: &Ball,
        next: impl Fn(&Rational, i64) -> Rational,
        bits: u64,
    ) -> Result<Varying, BallError> {
        let inverse = self.coefficient(0).reciprocal(bits)?;
        let mut change = self.clone();
        if let Some(middle) = change.coefficients.first_mut() {
            *middle = Ball::zero();
        }
        let change = change.multiply(&inverse.into(), bits);
        let size = change.magnitude();
        let one = Ball::from_integer(&1.into());
        let left = one.subtract(&Ball::new(size.to_binary(), Magnitude::ZERO), bits);
        if left.sign() != Some(std::cmp::Ordering::Greater) {
            return Err(BallError::DivisorMayBeZero);
        }
        let (mut power, mut factor) = (<Varying as Arithmetic>::one(), Rational::one());
        let mut sum = power.clone();
        for k in 1..=DEGREE as i64 {
            factor = next(&factor, k);
            power = power.multiply(&change, bits);
            sum = sum.add(&power.multiply(&Varying::constant(&factor, bits), bits), bits);
        }
        let beyond = size.power(DEGREE as u64 + 1).multiply(&left.reciprocal(bits)?.magnitude());
        sum.rest = sum.rest.add(&beyond);
        Ok(sum.multiply(&at_middle.clone().into(), bits))
    }
}

impl Arithmetic for Varying {
    fn zero() -> Varying {
        Varying::new(Vec::new(), Magnitude::ZERO)
    }

    fn one() -> Varying {
        Ball::from_integer(&1.into()).into()
    }

    fn is_zero(&self) -> bool {
        self.coefficients.is_empty() && self.rest.is_zero()
    }

    fn magnitude(&self) -> Magnitude {
        self.beyond(0)
    }

    fn negate(&self) -> Varying {
        let coefficients = self.coefficients.iter().map(|own| own.clone().negate()).collect();
        Varying::new(coefficients, self.rest)
    }

    fn add(&self, other: &Varying, bits: u64) -> Varying {
        let count = self.coefficients.len().max(other.coefficients.len());
        let sum = |k| self.coefficient(k).add(&other.coefficient(k), bits);
        Varying::new((0..count).map(sum).collect(), self.rest.add(&other.rest))
    }

    fn multiply(&self, other: &Varying, bits: u64) -> Varying {
        if self.is_zero() || other.is_zero() {
            return Varying::zero();
        }
        let ([one, two], count) = ([self, other].map(|own| &own.coefficients), DEGREE + 1);
        let mut product = vec![Ball::zero(); count.min((one.len() + two.len()).saturating_sub(1))];
        let mut rest = self.rest.multiply(&other.magnitude());
        for (i, a) in one.iter().enumerate() {
            rest = rest.add(&a.magnitude().multiply(&other.rest));
            for (j, b) in two.iter().enumerate() {
                match product.get_mut(i + j) {
                    Some(own) => *own = own.add(&a.multiply(b, bits), bits),
                    None => rest = rest.add(&a.magnitude().multiply(&b.magnitude())),
                }
            }
        }
        Varying::new(product, rest)
    }

    fn reciprocal(&self, bits: u64) -> Result<Varying, BallError> {
        let at_middle = self.coefficient(0).reciprocal(bits)?;
        self.composed(&at_middle, |factor, _| -factor, bits)
    }
}
