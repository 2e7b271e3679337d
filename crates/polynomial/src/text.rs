//! Printing in the documented order.

use crate::polynomial::Polynomial;
use num_traits::{One, Signed};
use std::fmt;

impl fmt::Display for Polynomial {
    /// Terms in the documented order, as `-3/2*mu^2*s + 1`.
    /// One gcd a term.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_zero() {
            return f.write_str("0");
        }
        for (i, (exponents, coefficient)) in self.terms().enumerate() {
            match (i, coefficient.is_negative()) {
                (0, false) => {}
                (0, true) => f.write_str("-")?,
                (_, false) => f.write_str(" + ")?,
                (_, true) => f.write_str(" - ")?,
            }
            let size = coefficient.abs();
            let mut separator = "";
            if !size.is_one() || exponents.iter().all(|e| *e == 0) {
                write!(f, "{size}")?;
                separator = "*";
            }
            for (symbol, exponent) in self.symbols().iter().zip(exponents) {
                match exponent {
                    0 => continue,
                    1 => write!(f, "{separator}{symbol}")?,
                    _ => write!(f, "{separator}{symbol}^{exponent}")?,
                }
                separator = "*";
            }
        }
        Ok(())
    }
}

impl fmt::Debug for Polynomial {
    /// As [`Display`](fmt::Display).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
