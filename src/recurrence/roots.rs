//! Roots of polynomials: rational ones, those of quadratics, and real ones that are named.
//!
//! Where a factor with rational coefficients is neither linear nor quadratic and all coefficients are numbers,
//! a real root, or the square root in a quadratic, becomes a constant with a name and a definition.

use crate::expression::Fraction;
use crate::recurrence::naming::Naming;
use wavestep_polynomial::{Polynomial, Rational, Symbol};

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
                Some([factor, quotient]) => {
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

/// An irreducible factor of least degree with rational coefficients, and the quotient by it; none of what
/// is irreducible itself.
fn rational_factor(polynomial: &[Fraction]) -> Option<[Vec<Fraction>; 2]> {
    let x = Symbol::new("x").expect("a name");
    let powers = (0..polynomial.len() as u32).rev();
    let term = |(c, power): (&Fraction, u32)| {
        Some(Polynomial::monomial(&c.as_constant()?, &[(&x, power)]))
    };
    let terms = polynomial.iter().zip(powers).map(term);
    let whole: Polynomial = terms.collect::<Option<Vec<_>>>()?.into_iter().sum();
    let factors = whole.factors()?.into_iter().map(|(factor, _)| factor);
    let smaller = factors.filter(|factor| factor.degree(&x) < whole.degree(&x));
    let factor = smaller.min_by_key(|factor| factor.degree(&x))?;
    let quotient = whole.divide(&factor)?;
    Some([factor, quotient].map(|p| monic(&p, &x)))
}

/// The coefficients of a polynomial over the leading one, highest power first.
fn monic(p: &Polynomial, x: &Symbol) -> Vec<Fraction> {
    let (degree, leading) = (p.degree(x) as usize, p.leading_coefficient());
    let mut row = vec![Fraction::zero(); degree + 1];
    for (exponents, c) in p.terms() {
        let power = exponents.first().copied().unwrap_or(0) as usize;
        row[degree - power] = Fraction::constant(&(c / &leading));
    }
    row
}
