//! The rise of a local contact in closed form, put back into its equation.

use wavestep::expression::Fraction;
use wavestep::solution::Rise;
use wavestep_polynomial::{Rational, Symbol};

fn ratio(top: i64, bottom: i64) -> Rational {
    Rational::new(top.into(), bottom.into())
}

fn number(value: &Rational) -> Fraction {
    Fraction::constant(value)
}

/// Of a part of a full turn, as roots: the cosines of 0, 30°, 45°, 60° and 90°, and those that follow by symmetry.
fn cosine(turn: &Rational) -> Fraction {
    let turn = turn - turn.floor();
    let turn = turn.clone().min(ratio(1, 1) - turn);
    if turn > ratio(1, 4) {
        return -&cosine(&(ratio(1, 2) - turn));
    }
    let squares = [(0, 1, 4), (1, 12, 3), (1, 8, 2), (1, 6, 1), (1, 4, 0)];
    let own = squares.into_iter().find(|(top, bottom, _)| turn == ratio(*top, *bottom));
    number(&ratio(own.unwrap().2, 4)).square_root().unwrap()
}

fn sine(turn: &Rational) -> Fraction {
    cosine(&(turn - ratio(1, 4)))
}

/// `dt̄/dp = Q p^(Q−1)/(1 − p^P)`: the derivatives of all terms on their common denominator, exactly. And `t̄(0) = 0`, since
/// every logarithm is that of one there.
#[test]
fn the_closed_form_solves_the_equation() {
    let p = Fraction::symbol(&Symbol::new("p").unwrap());
    let one = Fraction::one();
    let mut seen = 0;
    for (poles, root) in (1..13_u32).flat_map(|poles| (1..13_u32).map(move |root| (poles, root))) {
        let exponent = ratio(poles.into(), root.into());
        let is_reduced = *exponent.denom() == root.into();
        if !is_reduced || 24 % poles != 0 {
            continue;
        }
        let rise = Rise::new(&exponent).unwrap();
        assert_eq!(rise.exponents, [poles, root]);
        let factor = rise.factor();
        // Numerators over denominators.
        let mut terms = vec![(number(&factor), &one - &p)];
        if rise.has_second_real_pole() {
            terms.push((number(&factor), &one + &p));
        }
        for [a, b] in &rise.pairs {
            let square = &(&p.pow(2) - &(&cosine(a) * &p).scale(&ratio(2, 1))) + &one;
            let slope = (&p - &cosine(a)).scale(&ratio(-2, 1));
            let arctangent = (&sine(b) * &sine(a)).scale(&ratio(2, 1));
            let both = &(&cosine(b) * &slope) + &arctangent;
            terms.push((both.scale(&factor), square));
        }
        let denominator = terms.iter().fold(one.clone(), |product, (_, own)| &product * own);
        assert_eq!(denominator, &one - &p.pow(poles), "{exponent}");
        let mut sum = Fraction::zero();
        for (place, (numerator, _)) in terms.iter().enumerate() {
            let others = terms.iter().enumerate().filter(|(other, _)| *other != place);
            sum = &sum + &others.fold(numerator.clone(), |product, (_, own)| &product * &own.1);
        }
        for (coefficient, power) in &rise.powers {
            let slope = p.pow(power - 1).scale(&(coefficient * ratio((*power).into(), 1)));
            sum = &sum - &(&slope * &denominator);
        }
        let root = ratio(root.into(), 1);
        assert_eq!(sum, p.pow(rise.exponents[1] - 1).scale(&root), "{exponent}");
        seen += 1;
    }
    assert!(seen > 30, "{seen}");
}

/// Where formulas would be long there is the integral only.
#[test]
fn exponents_with_many_poles_have_no_formula() {
    assert!(Rise::new(&ratio(24, 23)).is_some());
    assert!(Rise::new(&ratio(25, 23)).is_none());
    assert!(Rise::new(&ratio(15037, 10000)).is_none());
    assert!(Rise::new(&ratio(1, 25)).is_none());
}
