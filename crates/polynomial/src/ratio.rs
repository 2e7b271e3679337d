//! Reduced fractions that are multiplied by fractions of words, in place.

use crate::integer::from_limbs;
use num_bigint::Sign;
use num_rational::BigRational;

/// A rational number `±numerator/denominator` that is multiplied by small fractions: a step takes
/// gcds of words only, and no allocation once the limbs have room.
///
/// # Invariants
/// - numerator and denominator are coprime, their highest limbs not zero;
/// - zero has no limbs in the numerator, the denominator 1 and no sign.
#[derive(PartialEq, Eq, Debug)]
pub struct WordRatio {
    negative: bool,
    numerator: Vec<u64>,
    denominator: Vec<u64>,
}

impl Clone for WordRatio {
    fn clone(&self) -> WordRatio {
        WordRatio {
            numerator: self.numerator.clone(),
            denominator: self.denominator.clone(),
            ..*self
        }
    }

    /// Without an allocation where the limbs have room.
    fn clone_from(&mut self, other: &WordRatio) {
        self.negative = other.negative;
        self.numerator.clone_from(&other.numerator);
        self.denominator.clone_from(&other.denominator);
    }
}

impl From<&BigRational> for WordRatio {
    /// The number, which is reduced with a positive denominator, as all but `new_raw` make it.
    fn from(value: &BigRational) -> WordRatio {
        debug_assert!(value.denom().sign() == Sign::Plus && *value == value.reduced());
        WordRatio {
            negative: value.numer().sign() == Sign::Minus,
            numerator: value.numer().iter_u64_digits().collect(),
            denominator: value.denom().iter_u64_digits().collect(),
        }
    }
}

impl WordRatio {
    /// Multiplies by `a/b`. At most six passes over the limbs, and gcds of words.
    ///
    /// With `p/q` and `a/b` reduced, `g = gcd(p, b)` and `h = gcd(a, q)`, the product is
    /// `(p/g · a/h) / (q/h · b/g)`, and that is reduced: what `p/g` and `b/g`, or `a/h` and `q/h`,
    /// have in common was taken out, and the other pairs had nothing.
    pub fn multiply(&mut self, a: u32, b: u32) {
        assert!(b > 0, "a division by zero");
        if a == 0 || self.numerator.is_empty() {
            (self.negative, self.numerator, self.denominator) = (false, Vec::new(), vec![1]);
            return;
        }
        let common = gcd(a, b);
        let (a, b) = (a / common, b / common);
        let above = gcd(b, remainder(&self.numerator, b));
        let below = gcd(a, remainder(&self.denominator, a));
        divide(&mut self.numerator, above);
        divide(&mut self.denominator, below);
        multiply(&mut self.numerator, a / below);
        multiply(&mut self.denominator, b / above);
    }

    /// Whether this is less than 0. O(1).
    pub fn is_negative(&self) -> bool {
        self.negative
    }

    /// The limbs of the numerator's magnitude and of the denominator in base `2^64`, the lowest
    /// first. O(1).
    pub fn limbs(&self) -> (&[u64], &[u64]) {
        (&self.numerator, &self.denominator)
    }

    /// The number itself. O(limbs).
    pub fn to_rational(&self) -> BigRational {
        let sign = if self.negative { Sign::Minus } else { Sign::Plus };
        let numerator = from_limbs(sign, &self.numerator);
        BigRational::new_raw(numerator, from_limbs(Sign::Plus, &self.denominator))
    }
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The next 64 bits of a division by a word: the quotient, and the rest.
fn step(rest: u64, limb: u64, word: u64) -> (u64, u64) {
    let high = rest << 32 | limb >> 32;
    let low = (high % word) << 32 | (limb & u64::from(u32::MAX));
    (((high / word) << 32) | (low / word), low % word)
}

fn remainder(limbs: &[u64], word: u32) -> u32 {
    if word == 1 {
        return 0;
    }
    let rest = limbs.iter().rev().fold(0, |rest, limb| step(rest, *limb, word.into()).1);
    rest as u32
}

/// Divides by a word that leaves no rest.
fn divide(limbs: &mut Vec<u64>, word: u32) {
    if word == 1 {
        return;
    }
    let mut rest = 0;
    for limb in limbs.iter_mut().rev() {
        (*limb, rest) = step(rest, *limb, word.into());
    }
    debug_assert_eq!(rest, 0);
    if limbs.last() == Some(&0) {
        limbs.pop();
    }
}

fn multiply(limbs: &mut Vec<u64>, word: u32) {
    if word == 1 {
        return;
    }
    let mut carry = 0;
    for limb in limbs.iter_mut() {
        let product = u128::from(*limb) * u128::from(word) + u128::from(carry);
        (*limb, carry) = (product as u64, (product >> 64) as u64);
    }
    if carry > 0 {
        limbs.push(carry);
    }
}
