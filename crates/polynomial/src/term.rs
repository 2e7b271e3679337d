//! Terms of a polynomial, and the limit of their exponents.

use num_bigint::BigInt;
use smallvec::SmallVec;

/// The largest exponent of a symbol.
pub(crate) const MAX_EXPONENT: u32 = 4095;

/// Exponents of one term, one for each symbol of the polynomial that holds it.
pub(crate) type Monomial = SmallVec<[u32; 4]>;

/// One term: `numerator · Π_i x_i^{a_i} / a_i!`, before the polynomial's denominator.
#[derive(PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub(crate) struct Term {
    pub exponents: Monomial,
    pub numerator: BigInt,
}

impl Clone for Term {
    /// By `from_slice`: `SmallVec::clone` goes item by item and takes twice the time.
    fn clone(&self) -> Term {
        let exponents = Monomial::from_slice(&self.exponents);
        Term { exponents, numerator: self.numerator.clone() }
    }
}

/// The exponent of a product of powers.
pub(crate) fn add_exponents(a: u32, b: u32) -> u32 {
    let sum = a.checked_add(b).filter(|sum| *sum <= MAX_EXPONENT);
    sum.unwrap_or_else(|| panic!("an exponent exceeds {}", MAX_EXPONENT))
}
