//! Arithmetic modulo the prime `2^61 − 1`: a residue that is not zero proves a number is not zero.

use crate::expression::{Expression, Field, Fraction, NotAUnit};
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::ToPrimitive;
use wavestep_polynomial::IntegerRef;

/// The modulus, a Mersenne prime.
pub const PRIME: u64 = (1 << 61) - 1;

/// A residue class modulo [`PRIME`].
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Residue(u64);

impl Residue {
    /// The residue of an integer.
    pub fn of_integer(value: &BigInt) -> Residue {
        let rest = value.mod_floor(&BigInt::from(PRIME));
        Residue(rest.to_u64().expect("a residue fits a word"))
    }

    /// The residue of an entry of a row.
    pub fn of_entry(value: IntegerRef<'_>) -> Residue {
        Residue(value.modulo(PRIME))
    }

    /// The residue of a rational number, `None` where the prime divides its denominator.
    pub fn of_rational(value: &BigRational) -> Option<Residue> {
        let denominator = Residue::of_integer(value.denom());
        Some(Residue::of_integer(value.numer()).times(denominator.inverse()?))
    }

    pub fn is_zero(self) -> bool {
        self.0 == 0
    }

    pub fn plus(self, other: Residue) -> Residue {
        Residue((self.0 + other.0) % PRIME)
    }

    pub fn times(self, other: Residue) -> Residue {
        let product = u128::from(self.0) * u128::from(other.0);
        Residue((product % u128::from(PRIME)) as u64)
    }

    /// The inverse by Fermat's theorem; `None` for zero.
    pub fn inverse(self) -> Option<Residue> {
        if self.is_zero() {
            return None;
        }
        let (mut power, mut base, mut exponent) = (Residue(1), self, PRIME - 2);
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = power.times(base);
            }
            base = base.times(base);
            exponent >>= 1;
        }
        Some(power)
    }
}

/// The residue of `Σ_j c_j x^j/j!`.
pub fn evaluate(
    coefficients: impl DoubleEndedIterator<Item = Residue> + ExactSizeIterator,
    x: Residue,
) -> Residue {
    // Inverses of 1, 2, …, by (p mod i)^{−1} = −(p div i) i^{−1}.
    let mut inverses = vec![Residue(1); coefficients.len() + 1];
    for i in 2..inverses.len() {
        let word = i as u64;
        let rest = inverses[(PRIME % word) as usize];
        inverses[i] = Residue(PRIME - PRIME / word).times(rest);
    }
    coefficients
        .enumerate()
        .rev()
        .fold(Residue(0), |value, (j, c)| value.times(x).times(inverses[j + 1]).plus(c))
}

/// The field of residues, for coefficients that are rational numbers.
#[derive(Clone, Copy)]
pub struct Modular;

/// A value that has no residue: it is no rational number, or the prime divides its denominator.
#[derive(Debug)]
pub struct NoResidue;

impl From<NotAUnit> for NoResidue {
    fn from(_: NotAUnit) -> NoResidue {
        NoResidue
    }
}

impl Field for Modular {
    type Value = Residue;
    type Error = NoResidue;

    fn zero(&self) -> Residue {
        Residue(0)
    }

    fn is_zero(&self, value: &Residue) -> bool {
        value.is_zero()
    }

    fn embed(&self, value: &Expression) -> Result<Residue, NoResidue> {
        value.as_constant().and_then(|value| Residue::of_rational(&value)).ok_or(NoResidue)
    }

    fn inverse(&self, value: &Fraction) -> Result<Residue, NoResidue> {
        self.embed(&value.clone().into())?.inverse().ok_or(NoResidue)
    }

    fn add(&self, sum: &mut Residue, other: &Residue) {
        *sum = sum.plus(*other);
    }

    fn product(&self, left: &Residue, right: &Residue) -> Residue {
        left.times(*right)
    }
}
