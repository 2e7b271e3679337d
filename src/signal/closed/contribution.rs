//! A value as a sum of contributions, each a rational amount times an exponential; and what holds
//! square roots, as an expression.

use crate::ball::{Ball, BallError, evaluate_divided, exp_of_rational};
use crate::expression::{Expression, Fraction, is_number};
use crate::signal::closed::modular;
use crate::signal::closed::modular::Residue;
use crate::signal::error::{EvaluateError, Outcome};
use num_traits::Zero;
use std::collections::BTreeMap;
use std::rc::Rc;
use wavestep_polynomial::{Rational, Symbol, Univariate};

/// `factor · polynomial(x) · e^{exponent}`.
pub(crate) struct Contribution {
    pub factor: Rational,
    pub polynomial: Rc<Univariate>,
    pub x: Rational,
    pub exponent: Rational,
}

impl Contribution {
    /// `factor · polynomial(x)`.
    fn amount(&self) -> Rational {
        &self.factor * self.polynomial.evaluate(&self.x)
    }

    /// The residue of the amount.
    fn residue(&self) -> Option<Residue> {
        let polynomial = &self.polynomial;
        let rows = polynomial.coefficients().iter().map(Residue::of_entry);
        let value = modular::evaluate(rows, Residue::of_rational(&self.x)?);
        let value = value.times(Residue::of_integer(polynomial.denominator()).inverse()?);
        Some(Residue::of_rational(&self.factor)?.times(value))
    }
}

/// The parts of a value: those in rational numbers, and the sum of those that hold square roots.
#[derive(Default)]
pub(crate) struct Parts {
    pub rational: Vec<Contribution>,
    pub algebraic: Expression,
}

impl Parts {
    /// Adds an expression, with a number in place of a symbol.
    pub fn add(
        &mut self,
        expression: &Expression,
        at: Option<(&Symbol, &Rational)>,
    ) -> Outcome<()> {
        let value = |x: &Symbol| at.filter(|(own, _)| *own == x).map(|(_, value)| value.clone());
        match expression.evaluate(&value) {
            Ok(sum) => self.rational.extend(sum.into_iter().map(|(exponent, value)| {
                let polynomial = Rc::new(Univariate::constant(&Rational::from_integer(1.into())));
                Contribution { factor: value, polynomial, x: Rational::zero(), exponent }
            })),
            Err(symbol) if !is_number(&symbol) => {
                return Err(EvaluateError::MissingValue(symbol));
            }
            Err(_) => {
                let at = match at {
                    Some((x, value)) => expression
                        .substitute(x, &Fraction::constant(value))
                        .expect("no denominator holds a time"),
                    None => expression.clone(),
                };
                if let Some(symbol) = at.symbols().into_iter().find(|x| !is_number(x)) {
                    return Err(EvaluateError::MissingValue(symbol));
                }
                self.algebraic += &at;
            }
        }
        Ok(())
    }

    /// Adds `factor · e^{exponent}` times all of `other`.
    pub fn add_scaled(&mut self, mut other: Parts, factor: &Rational, exponent: &Rational) {
        for contribution in &mut other.rational {
            contribution.factor *= factor;
            contribution.exponent += exponent;
        }
        self.rational.append(&mut other.rational);
        if !other.algebraic.is_zero() {
            let scaled = other.algebraic.scale(factor);
            self.algebraic += &scaled.times_exponential(&Fraction::constant(exponent));
        }
    }

    /// The whole sum as one expression.
    pub fn into_expression(self) -> Expression {
        let mut sum = self.algebraic;
        for contribution in &self.rational {
            let amount = Fraction::constant(&contribution.amount());
            sum.add_term(Fraction::constant(&contribution.exponent), amount);
        }
        sum
    }
}

/// The sum, where it is a rational number; `None` where it is not.
///
/// Contributions of one exponent belong together. By the theorem of Lindemann and Weierstrass the
/// sum is rational exactly when every group with an exponent other than 0 adds up to 0; a residue
/// that is not 0 settles that it does not, without long numbers.
pub(crate) fn rational_value(contributions: &[Contribution]) -> Option<Rational> {
    let mut groups = BTreeMap::<&Rational, Vec<&Contribution>>::new();
    for contribution in contributions {
        groups.entry(&contribution.exponent).or_default().push(contribution);
    }
    let constant = groups.remove(&Rational::zero()).unwrap_or_default();
    let residue_is_not_zero = |group: &Vec<&Contribution>| {
        let mut residues = group.iter().map(|contribution| contribution.residue());
        let sum = residues.try_fold(Residue::default(), |sum, part| Some(sum.plus(part?)));
        sum.is_some_and(|sum| !sum.is_zero())
    };
    if groups.values().any(residue_is_not_zero) {
        return None;
    }
    let exact = |group: &Vec<&Contribution>| -> Rational {
        group.iter().map(|contribution| contribution.amount()).sum()
    };
    groups.values().all(|group| exact(group).is_zero()).then(|| exact(&constant))
}

/// A ball around the sum.
pub(crate) fn enclose(contributions: &[Contribution], bits: u64) -> Result<Ball, BallError> {
    let mut sum = Ball::zero();
    for contribution in contributions {
        let exponential = exp_of_rational(&contribution.exponent, bits)?;
        let Contribution { factor, polynomial, x, .. } = contribution;
        let value = evaluate_divided(polynomial.coefficients(), x, bits);
        let share = Rational::new(1.into(), polynomial.denominator().clone());
        let product = value.multiply_rational(&share, bits).multiply(&exponential, bits);
        sum = sum.add(&product.multiply_rational(factor, bits), bits);
    }
    Ok(sum)
}
