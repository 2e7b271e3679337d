//! The numbers that waves are made of: real ones, and complex ones where poles turn.

use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number that waves are made of: real or complex.
pub trait Scalar:
    Copy
    + fmt::Debug
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;

    /// The same number as a complex one.
    fn complex(self) -> Complex;

    /// The absolute value.
    fn size(self) -> f64;
}

impl Scalar for f64 {
    const ZERO: f64 = 0.0;
    const ONE: f64 = 1.0;

    fn complex(self) -> Complex {
        Complex { re: self, im: 0.0 }
    }

    fn size(self) -> f64 {
        self.abs()
    }
}

/// A complex number in doubles, with the textbook's formulas.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Complex {
    /// The real part.
    pub re: f64,
    /// The imaginary part.
    pub im: f64,
}

impl Scalar for Complex {
    const ZERO: Complex = Complex { re: 0.0, im: 0.0 };
    const ONE: Complex = Complex { re: 1.0, im: 0.0 };

    fn complex(self) -> Complex {
        self
    }

    fn size(self) -> f64 {
        self.re.hypot(self.im)
    }
}

impl From<f64> for Complex {
    #[inline]
    fn from(real: f64) -> Complex {
        real.complex()
    }
}

impl Add for Complex {
    type Output = Complex;
    #[inline]
    fn add(self, other: Complex) -> Complex {
        Complex { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Sub for Complex {
    type Output = Complex;
    #[inline]
    fn sub(self, other: Complex) -> Complex {
        Complex { re: self.re - other.re, im: self.im - other.im }
    }
}

impl Mul for Complex {
    type Output = Complex;
    #[inline]
    fn mul(self, other: Complex) -> Complex {
        Complex {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

impl Div for Complex {
    type Output = Complex;
    #[inline]
    fn div(self, other: Complex) -> Complex {
        let square = other.re * other.re + other.im * other.im;
        let product = self * Complex { re: other.re, im: -other.im };
        Complex { re: product.re / square, im: product.im / square }
    }
}

impl Neg for Complex {
    type Output = Complex;
    #[inline]
    fn neg(self) -> Complex {
        Complex { re: -self.re, im: -self.im }
    }
}
