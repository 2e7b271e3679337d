//! Numbers that vary with a parameter: polynomials in it, with a bound of what they leave out.
//!
//! With balls in their place nothing would be left of the difference of two numbers that vary alike.

use super::taylor::{Taylor, of_exponential};
use crate::ball::{Arithmetic, Ball, BallError, ComplexBall, Magnitude, Number, Trigonometric};
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// The highest power of the parameter that is kept.
const DEGREE: usize = 6;

/// A number for each value of a parameter `ν` from −1 to 1: `|f(ν) − Σ_k c_k ν^k| ≤ remainder`.
pub type Varying = Taylor;

impl From<Ball> for Varying {
    fn from(ball: Ball) -> Varying {
        Taylor::polynomial(vec![ball])
    }
}

impl Varying {
    pub fn constant(value: &Rational, bits: u64) -> Varying {
        Ball::from_rational(value, bits).into()
    }

    /// All values from one to another, in order. Products have as many terms.
    pub fn between([low, high]: [&Rational; 2], bits: u64) -> Varying {
        let two = Rational::from_integer(2.into());
        let ends = [(low + high) / &two, (high - low) / two];
        let mut coefficients = ends.map(|own| Ball::from_rational(&own, bits)).to_vec();
        coefficients.resize(DEGREE + 1, Ball::zero());
        Taylor::polynomial(coefficients)
    }

    /// A ball that holds all of its values.
    pub fn number(&self) -> Number {
        if self.is_zero() { Number::zero() } else { Number::Enclosed(self.range()) }
    }

    /// About its value in the middle of the symbol.
    pub fn middle(&self) -> f64 {
        self.coefficient(0).midpoint().to_double()
    }

    /// A polynomial without radii near it, and how far it is from that at most.
    pub fn split(&self) -> (Varying, Magnitude) {
        let off = self.coefficients.iter().fold(self.remainder, |sum, own| sum.add(own.radius()));
        let middle = |own: &Ball| Ball::new(own.midpoint().clone(), Magnitude::ZERO);
        (Taylor::polynomial(self.coefficients.iter().map(middle).collect()), off)
    }

    /// The quotient by an integer that is not zero.
    pub fn over(&self, divisor: u64, bits: u64) -> Varying {
        Taylor {
            coefficients: self.coefficients.iter().map(|own| own.over(divisor, bits)).collect(),
            remainder: self.remainder.divide(divisor),
        }
    }

    /// The square root; none where it may not be positive.
    pub fn sqrt(&self, bits: u64) -> Option<Varying> {
        let at_middle = self.coefficient(0).sqrt(bits)?;
        self.composed(&at_middle, |k| Rational::new((3 - 2 * k).into(), (2 * k).into()), bits).ok()
    }

    /// `self − c₀`
    fn about_middle(&self) -> Varying {
        let mut change = self.clone();
        if let Some(constant) = change.coefficients.first_mut() {
            *constant = Ball::zero();
        }
        change
    }

    /// `e^x cos y` and `e^x sin y`. With `z = x + iy = z₀ + d` it is `e^z = e^(z₀) Σ_k d^k/k!`. Of the sum the terms `k > n`
    /// are left out, `|d|^(n+1)/(n+1)! e^|d|` at most.
    ///
    /// # Errors
    /// [`BallError::ArgumentTooLarge`] where `|Re d| + |Im d|` may exceed 8, or where `e^(z₀)` is too large.
    pub fn exp([x, y]: [&Varying; 2], bits: u64) -> Result<[Varying; 2], BallError> {
        let at_middle = ComplexBall::new(x.coefficient(0), y.coefficient(0)).exp(bits)?;
        let change = [x, y].map(Varying::about_middle);
        let size = change[0].magnitude().add(&change[1].magnitude());
        let most = of_exponential(&size).filter(|_| size <= Magnitude::from_u64(8));
        let most = most.ok_or(BallError::ArgumentTooLarge)?;
        let mut term = [Varying::one(), Varying::zero()];
        let mut sum = term.clone();
        let mut beyond = size.multiply(&most);
        for k in 1..=DEGREE as u64 {
            term = complex_product(&term, &change, bits).map(|part| part.over(k, bits));
            sum = [0, 1].map(|part| Arithmetic::add(&sum[part], &term[part], bits));
            beyond = beyond.multiply(&size).divide(k + 1);
        }
        for part in &mut sum {
            part.remainder = part.remainder.add(&beyond);
        }
        let at_middle = [at_middle.real(), at_middle.imaginary()].map(|part| part.clone().into());
        Ok(complex_product(&at_middle, &sum, bits))
    }

    /// `g(c₀) Σ_k a_k u^k` for a number `c₀ (1 + u)`, where `a₀ = 1` and `a_k/a_(k−1)` is given and at most 1 in size: what is
    /// left out is `Σ_{k>n} |u|^k = |u|^(n+1)/(1 − |u|)` at most.
    fn composed(
        &self,
        at_middle: &Ball,
        ratio: impl Fn(i64) -> Rational,
        bits: u64,
    ) -> Result<Varying, BallError> {
        let inverse = self.coefficient(0).reciprocal(bits)?;
        let change = self.about_middle().scaled(&inverse, bits);
        let size = change.magnitude();
        let one = Ball::from_integer(&1.into());
        let left = one.subtract(&Ball::new(size.to_binary(), Magnitude::ZERO), bits);
        if left.sign() != Some(Ordering::Greater) {
            return Err(BallError::DivisorMayBeZero);
        }
        let mut term = Varying::one();
        let mut sum = term.clone();
        for k in 1..=DEGREE {
            term = term
                .multiply(&change, bits)
                .scaled(&Ball::from_rational(&ratio(k as i64), bits), bits);
            sum = Arithmetic::add(&sum, &term, bits);
        }
        let beyond = size.power(DEGREE as u64 + 1).multiply(&left.reciprocal(bits)?.magnitude());
        sum.remainder = sum.remainder.add(&beyond);
        Ok(sum.scaled(at_middle, bits))
    }
}

impl Trigonometric for Varying {
    fn cos_sin(&self, bits: u64) -> Result<[Varying; 2], BallError> {
        Varying::exp([&Varying::zero(), self], bits)
    }
}

/// The product of two complex numbers.
pub fn complex_product([a, b]: &[Varying; 2], [c, d]: &[Varying; 2], bits: u64) -> [Varying; 2] {
    let product = Arithmetic::multiply;
    [
        product(a, c, bits).subtract(&product(b, d, bits), bits),
        Arithmetic::add(&product(a, d, bits), &product(b, c, bits), bits),
    ]
}

impl Arithmetic for Varying {
    fn zero() -> Varying {
        Taylor::polynomial(Vec::new())
    }

    fn one() -> Varying {
        Ball::from_integer(&1.into()).into()
    }

    fn is_zero(&self) -> bool {
        self.magnitude().is_zero()
    }

    fn magnitude(&self) -> Magnitude {
        self.tail(0)
    }

    fn negate(&self) -> Varying {
        let coefficients = self.coefficients.iter().map(|own| own.clone().negate()).collect();
        Taylor { coefficients, remainder: self.remainder }
    }

    fn add(&self, other: &Varying, bits: u64) -> Varying {
        let count = self.coefficients.len().max(other.coefficients.len());
        let sum = |k| self.coefficient(k).add(&other.coefficient(k), bits);
        Taylor {
            coefficients: (0..count).map(sum).collect(),
            remainder: self.remainder.add(&other.remainder),
        }
    }

    fn multiply(&self, other: &Varying, bits: u64) -> Varying {
        self.multiply(other, bits)
    }

    fn reciprocal(&self, bits: u64) -> Result<Varying, BallError> {
        let at_middle = self.coefficient(0).reciprocal(bits)?;
        self.composed(&at_middle, |_| Rational::from_integer((-1).into()), bits)
    }
}
