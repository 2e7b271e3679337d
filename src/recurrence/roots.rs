//! Roots of polynomials: rational ones, those of quadratics, and real ones that are named.
//!
//! Floating-point numbers only suggest what to try; a root is taken when the division leaves no rest.
//! Where no exact root is found and all coefficients are numbers, a real root, or the square root in
//! a quadratic, becomes a constant with a name and a definition.

use crate::expression::Fraction;
use crate::recurrence::guess::{approximate_roots, convergents};
use crate::recurrence::naming::Naming;
use num_traits::{One, Zero};
use wavestep_polynomial::{Rational, Symbol};

/// All roots of a monic polynomial, given by its coefficients, highest power first; `None` where
/// they are not found.
pub(crate) fn of(polynomial: &[Fraction], naming: &mut Naming) -> Option<Vec<Fraction>> {
    let mut rest = polynomial.to_vec();
    let mut roots = Vec::new();
    loop {
        match rest.len() {
            0 | 1 => return Some(roots),
            2 => {
                roots.push(-&rest[1]);
                return Some(roots);
            }
            3 => {
                roots.extend(of_quadratic(&rest[1], &rest[2], naming)?);
                return Some(roots);
            }
            _ => match rational_factor(&rest) {
                Some((factor, quotient)) => {
                    roots.extend(of(&factor, naming)?);
                    rest = quotient;
                }
                None => match naming.real_zero(&rest) {
                    Some(root) => {
                        rest = deflated(&rest, &root);
                        roots.push(root);
                    }
                    None => {
                        let (sigma, omega) = naming.complex_zero(&rest)?;
                        let i = Symbol::square_root(-1).expect("the imaginary unit");
                        let swing = &omega * &Fraction::symbol(&i);
                        for root in [&sigma + &swing, &sigma - &swing] {
                            rest = deflated(&rest, &root);
                            roots.push(root);
                        }
                    }
                },
            },
        }
    }
}

/// The roots of `λ² + b λ + c`: `−b/2 ± √(b²/4 − c)`.
fn of_quadratic(b: &Fraction, c: &Fraction, naming: &mut Naming) -> Option<[Fraction; 2]> {
    let half = b.scale(&Rational::new((-1).into(), 2.into()));
    let square = &half.pow(2) - c;
    let root = square.square_root().or_else(|| naming.square_root(&square))?;
    Some([&half + &root, &half - &root])
}

/// The quotient by `λ − root`, without the rest, which is zero because it is a root.
fn deflated(polynomial: &[Fraction], root: &Fraction) -> Vec<Fraction> {
    let mut quotient: Vec<Fraction> = Vec::with_capacity(polynomial.len() - 1);
    for coefficient in &polynomial[..polynomial.len() - 1] {
        let carried = quotient.last().map_or_else(Fraction::zero, |last| last * root);
        quotient.push(coefficient + &carried);
    }
    quotient
}

/// A linear or quadratic factor with rational coefficients, and the quotient by it.
fn rational_factor(polynomial: &[Fraction]) -> Option<(Vec<Fraction>, Vec<Fraction>)> {
    if polynomial.last()?.is_zero() {
        let factor = vec![Fraction::one(), Fraction::zero()];
        return Some((factor, polynomial[..polynomial.len() - 1].to_vec()));
    }
    let exact: Vec<Rational> =
        polynomial.iter().map(Fraction::as_constant).collect::<Option<_>>()?;
    let guesses = approximate_roots(&exact)?;
    let attempt = |factor: Vec<Rational>| {
        let quotient = divide(&exact, &factor)?;
        let lift = |row: Vec<Rational>| row.iter().map(Fraction::constant).collect::<Vec<_>>();
        Some((lift(factor), lift(quotient)))
    };
    let linear = guesses.iter().filter(|root| root.1.abs() < 1e-6 * (1.0 + root.0.abs()));
    for root in linear {
        for value in convergents(root.0) {
            if let Some(found) = attempt(vec![Rational::one(), -value]) {
                return Some(found);
            }
        }
    }
    for (i, x) in guesses.iter().enumerate() {
        for y in &guesses[i + 1..] {
            let (sum, product) = (x.0 + y.0, x.0 * y.0 - x.1 * y.1);
            for b in convergents(-sum) {
                for c in convergents(product) {
                    if let Some(found) = attempt(vec![Rational::one(), b.clone(), c]) {
                        return Some(found);
                    }
                }
            }
        }
    }
    None
}

/// The quotient, where the division leaves no rest.
fn divide(polynomial: &[Rational], factor: &[Rational]) -> Option<Vec<Rational>> {
    let mut rest = polynomial.to_vec();
    let count = rest.len() + 1 - factor.len();
    for i in 0..count {
        let leading = rest[i].clone();
        for (j, coefficient) in factor.iter().enumerate() {
            rest[i + j] -= &leading * coefficient;
        }
        rest[i] = leading;
    }
    let remainder = rest.split_off(count);
    remainder.iter().all(Zero::is_zero).then_some(rest)
}
