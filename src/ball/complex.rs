//! Complex numbers known to lie within a rectangle.

use std::fmt;

use num_rational::BigRational;

use super::ball::Ball;
use super::error::BallError;
use super::magnitude::Magnitude;

/// All complex numbers whose real and imaginary parts lie in two balls.
///
/// # Invariants
/// - A complex ball made by an operation contains the exact result for every choice of points in
///   its operands.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ComplexBall {
    re: Ball,
    im: Ball,
}

impl ComplexBall {
    /// `re + i·im`.
    pub fn new(re: Ball, im: Ball) -> Self {
        Self { re, im }
    }

    /// The point 0.
    pub fn zero() -> Self {
        Ball::zero().into()
    }

    /// The point 1.
    pub fn one() -> Self {
        Ball::from_integer(&1.into()).into()
    }

    /// `−z`, exactly.
    pub fn negate(self) -> Self {
        Self::new(self.re.negate(), self.im.negate())
    }

    /// An upper bound of `|z|` over the rectangle.
    pub fn magnitude(&self) -> Magnitude {
        match self.is_real() {
            true => self.re.magnitude(),
            false => self.re.magnitude().add(&self.im.magnitude()),
        }
    }

    /// The middle of the rectangle.
    pub fn centre(&self) -> Self {
        let middle = |part: &Ball| Ball::new(part.midpoint().clone(), Magnitude::ZERO);
        Self::new(middle(&self.re), middle(&self.im))
    }

    /// All points that are no farther from this rectangle than the other one is from zero.
    pub fn widened(&self, by: &Self) -> Self {
        let distance = by.re.magnitude().add(&by.im.magnitude());
        let widen = |part: &Ball| Ball::new(part.midpoint().clone(), part.radius().add(&distance));
        Self::new(widen(&self.re), widen(&self.im))
    }

    /// Whether the imaginary part is exactly zero.
    pub(super) fn is_real(&self) -> bool {
        self.im.is_exact() && self.im.midpoint().is_zero()
    }

    /// The real part.
    pub const fn real(&self) -> &Ball {
        &self.re
    }

    /// The imaginary part.
    pub const fn imaginary(&self) -> &Ball {
        &self.im
    }

    /// `z + w`.
    pub fn add(&self, other: &Self, precision: u64) -> Self {
        if self.is_real() && other.is_real() {
            return self.re.add(&other.re, precision).into();
        }
        Self::new(self.re.add(&other.re, precision), self.im.add(&other.im, precision))
    }

    /// `z·w`.
    pub fn multiply(&self, other: &Self, precision: u64) -> Self {
        if self.is_real() && other.is_real() {
            return self.re.multiply(&other.re, precision).into();
        }
        let product = |a: &Ball, b: &Ball| a.multiply(b, precision);
        let re = product(&self.re, &other.re).subtract(&product(&self.im, &other.im), precision);
        let im = product(&self.re, &other.im).add(&product(&self.im, &other.re), precision);
        Self::new(re, im)
    }

    /// `z·q`.
    pub fn multiply_rational(&self, factor: &BigRational, precision: u64) -> Self {
        let product = |part: &Ball| part.multiply_rational(factor, precision);
        Self::new(product(&self.re), product(&self.im))
    }

    /// `z/n`, where `n` is not zero.
    pub fn over(&self, divisor: u64, precision: u64) -> Self {
        Self::new(self.re.over(divisor, precision), self.im.over(divisor, precision))
    }

    /// `1/z = (re − i·im)/(re² + im²)`.
    pub fn reciprocal(&self, precision: u64) -> Result<Self, BallError> {
        let norm = self.re.square(precision).add(&self.im.square(precision), precision);
        let inverse = norm.reciprocal(precision)?;
        let re = self.re.multiply(&inverse, precision);
        Ok(Self::new(re, self.im.multiply(&inverse, precision).negate()))
    }

    /// `e^z = e^re (cos im + i sin im)`.
    pub fn exp(&self, precision: u64) -> Result<Self, BallError> {
        let size = self.re.exp(precision)?;
        if self.im.is_exact() && self.im.contains_zero() {
            return Ok(size.into());
        }
        let (cos, sin) = self.im.cos_sin(precision)?;
        Ok(Self::new(size.multiply(&cos, precision), size.multiply(&sin, precision)))
    }
}

impl From<Ball> for ComplexBall {
    fn from(re: Ball) -> Self {
        Self::new(re, Ball::zero())
    }
}

impl fmt::Display for ComplexBall {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "({}) + ({})i", self.re, self.im)
    }
}
