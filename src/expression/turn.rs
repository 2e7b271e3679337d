//! The number π, and turns: `e^{iπr}` for rational `r`.

use crate::expression::fraction::Fraction;
use num_traits::{ToPrimitive as _, Zero as _};
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// The name of the number π.
pub const PI: &str = "pi";

/// Whether a symbol stands for one number: a square root, or π.
pub(crate) fn is_number(symbol: &Symbol) -> bool {
    symbol.square().is_some() || symbol.name() == PI
}

/// An exponent without the turns that have a value in square roots, and that value; `None` where there are none.
///
/// Of `iπr` the nearest half turn is taken off, `e^{iπ(r − k)} (−1)^k`, and the rest where it is twelfths of `iπ`.
pub(super) fn without_turns(exponent: &Fraction) -> Option<(Fraction, Fraction)> {
    let symbols = exponent.numerator().symbols();
    if !symbols.iter().any(|symbol| symbol.name() == PI) {
        return None;
    }
    let polynomial = exponent.as_polynomial()?;
    let is_turn = |powers: &[u32]| {
        symbols.iter().zip(powers).all(|(symbol, power)| {
            let wanted = symbol.name() == PI || symbol.square() == Some(-1);
            *power == u32::from(wanted)
        })
    };
    let [pi, i] = [Symbol::new(PI), Symbol::square_root(-1)].map(|own| own.expect("a symbol"));
    if !symbols.contains(&i) {
        return None;
    }
    let turns = polynomial.terms().find(|(powers, _)| is_turn(powers))?.1;
    let half_turns = (&turns + Rational::new(1.into(), 2.into())).floor();
    let rest = &turns - &half_turns;
    let value = value_of(&rest);
    if value.is_none() && half_turns.is_zero() {
        return None;
    }
    let is_odd = half_turns.to_integer().bit(0);
    let sign = Rational::from_integer(if is_odd { -1 } else { 1 }.into());
    let taken = if value.is_some() { turns } else { half_turns };
    let turn = Polynomial::monomial(&taken, &[(&pi, 1), (&i, 1)]);
    let value = value.unwrap_or_else(Fraction::one).scale(&sign);
    Some((exponent - &turn.into(), value))
}

/// `e^{iπr}` for `|r| ≤ 1/2`, in square roots of −1, 2 and 3.
fn value_of(r: &Rational) -> Option<Fraction> {
    let root = |n: i64| Fraction::symbol(&Symbol::square_root(n).expect("−1 or a prime"));
    let half = Rational::new(1.into(), 2.into());
    let twelfths = r * Rational::from_integer(12.into());
    if !twelfths.is_integer() {
        return None;
    }
    let quarter = Rational::new(1.into(), 4.into());
    let sixth = &root(2) * &root(3);
    let [more, less] = [&sixth + &root(2), &sixth - &root(2)].map(|own| own.scale(&quarter));
    let (cosine, sine) = match twelfths.to_i64()?.abs() {
        0 => (Fraction::one(), Fraction::zero()),
        1 => (more, less),
        5 => (less, more),
        2 => (root(3).scale(&half), Fraction::one().scale(&half)),
        3 => (root(2).scale(&half), root(2).scale(&half)),
        4 => (Fraction::one().scale(&half), root(3).scale(&half)),
        6 => (Fraction::zero(), Fraction::one()),
        _ => return None,
    };
    let sine = if *r < Rational::zero() { -&sine } else { sine };
    Some(&cosine + &(&root(-1) * &sine))
}
