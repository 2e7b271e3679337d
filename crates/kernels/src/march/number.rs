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

macro_rules! operator {
    ($operator:ident, $name:ident, |$a:ident, $b:ident| $value:expr) => {
        impl $operator for Complex {
            type Output = Complex;

            #[inline]
            fn $name(self, other: Complex) -> Complex {
                let ($a, $b) = (self, other);
                $value
            }
        }
    };
}
operator!(Add, add, |a, b| Complex { re: a.re + b.re, im: a.im + b.im });
operator!(Sub, sub, |a, b| Complex { re: a.re - b.re, im: a.im - b.im });
operator!(Mul, mul, |a, b| Complex {
    re: a.re * b.re - a.im * b.im,
    im: a.re * b.im + a.im * b.re
});
operator!(Div, div, |a, b| {
    let square = b.re * b.re + b.im * b.im;
    let product = a * Complex { re: b.re, im: -b.im };
    Complex { re: product.re / square, im: product.im / square }
});

impl Neg for Complex {
    type Output = Complex;
    #[inline]
    fn neg(self) -> Complex {
        Complex { re: -self.re, im: -self.im }
    }
}
