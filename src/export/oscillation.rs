//! Sums of conjugate exponentials as cosines and sines.

use crate::export::terms::fraction_terms;
use crate::export::tree::{Circular, Sign};
use crate::expression::{Expression, Fraction};
use num_traits::{One, Zero};
use std::borrow::Cow;
use wavestep_polynomial::{Integer, Polynomial, Rational, Symbol};

/// `e^{growth}`, times the cosine or the sine of the angle, if any.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Oscillation {
    /// The exponent; real where there is an angle.
    pub growth: Fraction,
    /// The function and its angle, which is written without a sign in front.
    pub angle: Option<(Circular, Fraction)>,
}

impl Oscillation {
    /// `e^{growth}`.
    pub fn growing(growth: Fraction) -> Oscillation {
        Oscillation { growth, angle: None }
    }

    pub fn is_one(&self) -> bool {
        self.growth.is_zero() && self.angle.is_none()
    }

    /// The order of writing: 1 first, then descending value of the exponent where all symbols are 1,
    /// `e^{−2μ}` before `e^{−4μ}`; without an angle before those with one.
    pub fn key(&self) -> impl Ord + use<> {
        let angle = self.angle.as_ref().map(|(wave, angle)| (key(angle), *wave));
        (!self.is_one(), key(&self.growth), angle)
    }
}

/// Descending value where all symbols are 1; fractions of one value in a fixed order.
fn key(value: &Fraction) -> (Rational, Fraction) {
    let ones = |p: &Polynomial| {
        // Roots as decimals of six digits: for the order on the page that is enough.
        let at_roots = p.roots().fold(p.clone(), |at, root| {
            at.substitute(root, &Polynomial::constant(&approximation(root)))
        });
        at_roots.evaluate(|_| Some(Rational::one())).unwrap_or_default()
    };
    let denominator = ones(&value.denominator());
    let at_ones = match denominator.is_zero() {
        true => Rational::zero(),
        false => ones(value.numerator()) / denominator,
    };
    (-at_ones, value.clone())
}

/// `√n` rounded down to six decimals; 1 for the imaginary unit.
fn approximation(root: &Symbol) -> Rational {
    let million = Integer::from(1_000_000);
    let square = Integer::from(root.square().map_or(1, i64::abs)) * &million * &million;
    Rational::new(square.sqrt(), million)
}

/// The terms of an expression. Where it is real, conjugate terms are taken together:
///
/// ```text
/// (a + ib) e^{σ+iω} + (a − ib) e^{σ−iω} = e^σ (2a cos ω − 2b sin ω)
/// ```
///
/// An expression that is not real is left as it is.
pub fn oscillations(expression: &Expression) -> Vec<(Oscillation, Cow<'_, Fraction>)> {
    let i = Symbol::square_root(-1).expect("the imaginary unit");
    let is_complex = |exponent: &Fraction| exponent.roots().any(|root| *root == i);
    let mut parts = Vec::new();
    let paired = expression.terms().any(|(exponent, _)| is_complex(exponent))
        && expression.conjugate(&i) == *expression;
    for (exponent, p) in expression.terms() {
        if !paired || !is_complex(exponent) {
            parts.push((Oscillation::growing(exponent.clone()), Cow::Borrowed(p)));
            continue;
        }
        let half = Rational::new(1.into(), 2.into());
        let minus_i = -&Fraction::symbol(&i);
        let real = |value: &Fraction| (value + &value.conjugate(&i)).scale(&half);
        let imaginary = |value: &Fraction| &(value - &value.conjugate(&i)).scale(&half) * &minus_i;
        // A conjugate exponent may be written with another turn; the two are told as one.
        let conjugate = Expression::exponential(exponent.conjugate(&i));
        let (partner, _) = conjugate.terms().next().expect("one term");
        let angle = imaginary(exponent);
        if writing(&imaginary(partner)) < writing(&angle) {
            continue;
        }
        let count = Rational::from_integer(if partner == exponent { 1 } else { 2 }.into());
        let values = [
            (Circular::Cosine, real(p).scale(&count)),
            (Circular::Sine, -&imaginary(p).scale(&count)),
        ];
        for (wave, value) in values.into_iter().filter(|(_, value)| !value.is_zero()) {
            let growth = real(exponent);
            let angle = Some((wave, angle.clone()));
            parts.push((Oscillation { growth, angle }, Cow::Owned(value)));
        }
    }
    parts
}

/// Of two conjugates the lesser one is written: the one whose angle begins without a sign, then with fewer signs.
fn writing(angle: &Fraction) -> (bool, usize, &Fraction) {
    let terms = fraction_terms(angle);
    let is_minus = |sign: Sign| sign == Sign::Minus;
    let begins = terms.first().is_some_and(|term| is_minus(term.0));
    (begins, terms.iter().filter(|term| is_minus(term.0)).count(), angle)
}
