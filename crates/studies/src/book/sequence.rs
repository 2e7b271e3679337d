//! Sequences in general n: sums of `c(n) λ^n` with rational functions of n as coefficients.

use crate::book::refusal::Refusal;
use wavestep::expression::{Expression, Fraction};
use wavestep_polynomial::{Rational, Symbol};

/// `Σ_i c_i(n) λ_i^n`.
///
/// # Invariants
/// - the ratios `λ_i` are different, the coefficients not zero. Powers of different ratios are linearly
///   independent over the rational functions of n, so equal sequences have the same terms.
#[derive(Clone, Debug, Default)]
pub struct Sequence {
    terms: Vec<(Expression, Expression)>,
}

/// `1/value`, for a product of symbols and irreducible factors, and exponentials.
pub(super) fn inverse(value: &Expression) -> Result<Expression, Refusal> {
    value.inverse_of_term().and_then(Result::ok).ok_or(Refusal::NotInvertible)
}

/// The number of the period, as a value.
pub(super) fn period_number() -> Symbol {
    Symbol::new("n").expect("a name")
}

impl Sequence {
    pub(super) fn constant(value: Expression) -> Sequence {
        Sequence::term(Expression::one(), value)
    }

    /// `coefficient · ratio^n`.
    pub fn term(ratio: Expression, coefficient: Expression) -> Sequence {
        let mut sequence = Sequence::default();
        sequence.add(ratio, &coefficient);
        sequence
    }

    fn add(&mut self, ratio: Expression, coefficient: &Expression) {
        match self.terms.iter_mut().find(|(own, _)| *own == ratio) {
            Some((_, own)) => *own += coefficient,
            None => self.terms.push((ratio, coefficient.clone())),
        }
        self.terms.retain(|(_, coefficient)| !coefficient.is_zero());
    }

    pub fn plus(&self, other: &Sequence) -> Sequence {
        let mut sum = self.clone();
        other.terms.iter().for_each(|(ratio, value)| sum.add(ratio.clone(), value));
        sum
    }

    pub fn times(&self, other: &Sequence) -> Sequence {
        let mut product = Sequence::default();
        for (left, a) in &self.terms {
            for (right, b) in &other.terms {
                product.add(left * right, &(a * b));
            }
        }
        product
    }

    pub fn negated(&self) -> Sequence {
        self.times(&Sequence::constant(Expression::integer(-1)))
    }

    /// The sequence one period late; `None` where a ratio has no inverse.
    pub(super) fn delayed(&self) -> Option<Sequence> {
        let n = period_number();
        let before = &Fraction::symbol(&n) - &Fraction::one();
        let mut late = Sequence::default();
        for (ratio, coefficient) in &self.terms {
            let coefficient = coefficient.substitute(&n, &before).ok()?;
            late.add(ratio.clone(), &(&coefficient * &inverse(ratio).ok()?));
        }
        Some(late)
    }

    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The value, where no power of n occurs and n neither.
    pub(super) fn as_constant(&self) -> Option<Expression> {
        match &self.terms[..] {
            [] => Some(Expression::zero()),
            [(ratio, value)] if ratio.is_one() && !value.contains(&period_number()) => {
                Some(value.clone())
            }
            _ => None,
        }
    }

    /// The coefficient, where n stands in no exponent.
    pub(super) fn as_rational(&self) -> Option<Expression> {
        match &self.terms[..] {
            [] => Some(Expression::zero()),
            [(ratio, value)] if ratio.is_one() => Some(value.clone()),
            _ => None,
        }
    }

    /// The value at n; `None` where a denominator vanishes there.
    pub fn value(&self, n: u32) -> Option<Expression> {
        let fraction = Fraction::constant(&Rational::from_integer(n.into()));
        self.terms.iter().try_fold(Expression::zero(), |sum, (ratio, coefficient)| {
            let coefficient = coefficient.substitute(&period_number(), &fraction).ok()?;
            Some(&sum + &(&coefficient * &ratio.pow(n)))
        })
    }
}
