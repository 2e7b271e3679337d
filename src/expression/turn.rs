//! The number π, and turns: `e^{iπr}` for rational `r`.

use crate::expression::fraction::Fraction;
use num_traits::{Signed as _, Zero as _};
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// The name of the number π.
pub const PI: &str = "pi";

/// Whether a symbol stands for one number: a square root, or π.
pub(crate) fn is_number(symbol: &Symbol) -> bool {
    symbol.square().is_some() || symbol.name() == PI
}

/// Whether π stands above.
pub(super) fn has_pi(value: &Fraction) -> bool {
    value.numerator().symbols().iter().any(|symbol| symbol.name() == PI)
}

/// An exponent without the turns that have a value in square roots, and that value; `None` where there are none.
///
/// Of `iπr` as many twelfths of `iπ` are taken off as leave the least denominator, then the least size; so exponents are
/// the same where they differ by such turns.
pub(super) fn without_turns(exponent: &Fraction) -> Option<(Fraction, Fraction)> {
    if !has_pi(exponent) {
        return None;
    }
    let [pi, i] = [Symbol::new(PI), Symbol::square_root(-1)].map(|own| own.expect("a symbol"));
    let (above, below) = (exponent.numerator(), exponent.denominator());
    if below.symbols().iter().any(is_number) {
        return None;
    }
    // `iπ` times a term of the denominator tells what multiple of `iπ` is in the quotient.
    let (powers, coefficient) = below.terms().next().expect("a denominator is not zero");
    let named = below.symbols().iter().zip(powers.iter().copied());
    let mut whole: Vec<(&Symbol, u32)> = named.filter(|(_, power)| *power > 0).collect();
    whole.extend([(&pi, 1), (&i, 1)]);
    let is_whole = |powers: &[u32]| {
        let own = above.symbols().iter().zip(powers.iter().copied());
        let own = own.filter(|(_, power)| *power > 0);
        own.clone().count() == whole.len() && own.into_iter().all(|own| whole.contains(&own))
    };
    let turns = above.terms().find(|(powers, _)| is_whole(powers))?.1 / coefficient;
    let (twelfths, left) = split(&turns);
    let taken = &turns - left;
    if taken.is_zero() {
        return None;
    }
    let turn = Polynomial::monomial(&taken, &[(&pi, 1), (&i, 1)]);
    Some((exponent - &turn.into(), power_of_twelfth(twelfths)))
}

/// `r` as twelfths, from 0 to 23, and a rest, but for whole turns.
fn split(r: &Rational) -> (i64, Rational) {
    let two = Rational::from_integer(2.into());
    let rest = |twelfths: i64| {
        let rest = r - Rational::new(twelfths.into(), 12.into());
        let turns = (&rest / &two).round() * &two;
        (twelfths, rest - turns)
    };
    let order =
        |(_, rest): &(i64, Rational)| (rest.denom().clone(), rest.abs(), rest.is_negative());
    (0..24).map(rest).min_by_key(order).expect("there are some")
}

/// `e^{iπm/12}`, in square roots of −1, 2 and 3.
fn power_of_twelfth(m: i64) -> Fraction {
    let root = |n: i64| Fraction::symbol(&Symbol::square_root(n).expect("−1 or a prime"));
    let part = |value: Fraction, below: i64| value.scale(&Rational::new(1.into(), below.into()));
    let sixth = &root(2) * &root(3);
    // The cosines of the twelfths up to a fourth of a turn.
    let cosine = |m: i64| match m {
        0 => Fraction::one(),
        1 => part(&sixth + &root(2), 4),
        2 => part(root(3), 2),
        3 => part(root(2), 2),
        4 => part(Fraction::one(), 2),
        5 => part(&sixth - &root(2), 4),
        _ => Fraction::zero(),
    };
    let (quarters, m) = (m / 6, m % 6);
    let own = &cosine(m) + &(&root(-1) * &cosine(6 - m));
    (0..quarters).fold(own, |turned, _| &turned * &root(-1))
}
