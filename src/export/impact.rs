//! The first contact of two long bars with a local contact, as formulas by one parameter.

use crate::export::arrangement::arrange;
use crate::export::formula::{Formula, Head, Right};
use crate::export::names::{Name, Names};
use crate::export::notation::{Notation, both};
use crate::export::tree::{Sign, Term, Tree};
use crate::export::writer::write_flat;
use crate::expression::{Fraction, free_name};
use crate::network::{ElementLaw, Impact, ScaledScene};
use crate::solution::Rise;
use num_traits::One as _;
use std::sync::Arc;
use wavestep_polynomial::{Rational, Symbol};

/// The symbols of the formulas, which nothing else in the scene has.
struct Symbols {
    force: Symbol,
    largest_force: Symbol,
    compression: Symbol,
    largest_compression: Symbol,
    unit: Symbol,
    parameter: Symbol,
    time: Symbol,
}

impl Symbols {
    fn of(scaled: &ScaledScene) -> Symbols {
        let free = |name: &str| {
            let name = free_name(name, |name| {
                scaled.model().assumptions.declares(name) || scaled.scene().time.name() == name
            });
            Symbol::new(&name).expect("a name with letters in front")
        };
        Symbols {
            force: free("X"),
            largest_force: free("X_max"),
            compression: free("alpha"),
            largest_compression: free("alpha_max"),
            unit: free("T"),
            parameter: free("p"),
            time: scaled.scene().time.clone(),
        }
    }
}

fn ratio(top: i64, bottom: i64) -> Rational {
    Rational::new(top.into(), bottom.into())
}

fn of(value: &Fraction) -> Term {
    Tree::sum(arrange(&value.into(), None))
}

fn symbol(symbol: &Symbol) -> Tree {
    Tree::Symbol(symbol.clone())
}

fn power(base: Tree, exponent: &Rational) -> Tree {
    match exponent.is_one() {
        true => base,
        false => Tree::Power(Box::new(base), Box::new(Tree::Number(exponent.clone()))),
    }
}

/// A symbol over a value.
fn over(top: &Symbol, bottom: &Fraction) -> Term {
    if let Some(number) = bottom.as_constant() {
        return of(&Fraction::symbol(top).scale(&number.recip()));
    }
    let (sign, bottom) = of(bottom);
    (sign, Tree::Quotient(Box::new(symbol(top)), Box::new(bottom)))
}

/// A term times a factor.
fn times((sign, coefficient): Term, factor: Tree) -> Term {
    let mut factors = coefficient.into_factors();
    factors.extend(factor.into_factors());
    (sign, Tree::product(factors))
}

/// `X = F (α/α₁)^m`, and what follows from it and `α' = V − X/Z` with the largest force VZ: force, compression and time
/// by a parameter from 0 to 1. They hold until something may return, through one of these bars at these times.
pub fn first_contact(
    scaled: &ScaledScene,
    impact: &Impact,
    largest_force: &Fraction,
    until: &[(&str, &Fraction)],
) -> Vec<Formula> {
    let ElementLaw::LocalContact { force, compression, exponent } =
        &scaled.model().lumps[&impact.contact]
    else {
        unreachable!("the lump of a local contact");
    };
    let own = Symbols::of(scaled);
    let by =
        |of: &Symbol, by: &Symbol| Head::both(|n| format!("{}({})", n.symbol(of), n.symbol(by)));
    let constant = |of: &Symbol| Head::both(|n| n.symbol(of));
    let formula = |head: Head, term: Term| Formula::of(head, Right::Terms(vec![term]));
    let at =
        |exponent: &num_bigint::BigInt| power(symbol(&own.parameter), &exponent.clone().into());
    let (sign, share) = over(&own.compression, compression);
    let law = times(of(force), power(share, exponent));
    let (_, share) = over(&own.largest_force, force);
    let largest = times(of(compression), power(share, &exponent.recip()));
    let remark = Some(both(|n| holds(&own, until, n)));
    assert!(sign == Sign::Plus, "a compression is positive");
    vec![
        formula(by(&own.force, &own.compression), law),
        Formula::of(constant(&own.largest_force), Right::Terms(vec![of(largest_force)])),
        formula(constant(&own.largest_compression), largest),
        formula(constant(&own.unit), over(&own.largest_compression, &impact.approach)),
        formula(
            by(&own.force, &own.parameter),
            times((Sign::Plus, symbol(&own.largest_force)), at(exponent.numer())),
        ),
        formula(
            by(&own.compression, &own.parameter),
            times((Sign::Plus, symbol(&own.largest_compression)), at(exponent.denom())),
        ),
        Formula { head: by(&own.time, &own.parameter), right: rise(&own, exponent), remark },
    ]
}

/// From when to when the formulas hold.
fn holds(own: &Symbols, until: &[(&str, &Fraction)], n: Notation) -> String {
    let (p, t, at_most) = (n.symbol(&own.parameter), n.symbol(&own.time), n.choose("<=", "\\le"));
    let range = format!("0 {at_most} {p} < 1");
    let times = until.iter().map(|(_, time)| write_flat(&[of(time)], n)).collect::<Vec<_>>();
    let names = until.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(" or ");
    match (n, &times[..]) {
        (Notation::Text | Notation::MathMl, []) => {
            format!("{range}; nothing returns to the contact")
        }
        (Notation::Latex, []) => range,
        (Notation::Text | Notation::MathMl, _) => format!(
            "{range}, as long as {t} <= {}: then a wave may return through {names}",
            times.join(&format!(" and {t} <= "))
        ),
        (Notation::Latex, _) => {
            format!("{range},\\ {t} \\le {}", times.join(&format!(",\\ {t} \\le ")))
        }
    }
}

/// Cosines that are no roots, under their names.
#[derive(Default)]
struct Angles(Names);

impl Angles {
    /// The cosine of a part of a full turn; whether it is written with roots.
    fn cosine(&mut self, turn: &Rational) -> (Fraction, bool) {
        let turn = turn - turn.floor();
        let turn = turn.clone().min(ratio(1, 1) - turn);
        let (sign, turn) = match turn > ratio(1, 4) {
            true => (-1, ratio(1, 2) - turn),
            false => (1, turn),
        };
        let squares = [(0, 1, 4), (1, 12, 3), (1, 8, 2), (1, 6, 1), (1, 4, 0)];
        let known = squares.into_iter().find(|(top, bottom, _)| turn == ratio(*top, *bottom));
        let root =
            known.and_then(|(.., quarters)| Fraction::constant(&ratio(quarters, 4)).square_root());
        let is_root = root.is_some();
        let value = root.unwrap_or_else(|| {
            let name = format!("cos_{}_{}", turn.numer(), turn.denom());
            let stand_in = Symbol::new(&name).expect("a name");
            let pi = Fraction::symbol(&Symbol::new("pi").expect("a name"));
            let angle = of(&pi.scale(&(turn * ratio(2, 1))));
            let angle = std::slice::from_ref(&angle);
            let written = Name::plain(|n| n.function("cos", &write_flat(angle, n)));
            self.0.insert(stand_in.clone(), written);
            Fraction::symbol(&stand_in)
        });
        (value.scale(&ratio(sign, 1)), is_root)
    }

    fn sine(&mut self, turn: &Rational) -> Fraction {
        self.cosine(&(turn - ratio(1, 4))).0
    }
}

/// `T t̄(p)`, in closed form, or as the integral where that is long.
fn rise(own: &Symbols, exponent: &Rational) -> Right {
    let Some(rise) = Rise::new(exponent) else {
        let [poles, root] = [exponent.numer(), exponent.denom()];
        let less = root - 1;
        let written = |n: Notation| {
            let [p, unit] = [&own.parameter, &own.unit].map(|symbol| n.symbol(symbol));
            match n {
                Notation::Text | Notation::MathMl => {
                    format!("{root}*{unit}*integral(u^{less}/(1 - u^{poles}), u = 0 .. {p})")
                }
                Notation::Latex => format!(
                    "{root} {unit} \\int_{{0}}^{{{p}}} \\frac{{u^{{{less}}}}}{{1 - u^{{{poles}}}}} \\,\\mathrm{{d}}u"
                ),
            }
        };
        return Right::both(written);
    };
    let mut angles = Angles::default();
    let terms = rise_terms(own, &rise, &mut angles);
    let (sign, sum) = Tree::sum(terms);
    let whole = times((sign, symbol(&own.unit)), sum);
    Right::Named(vec![whole], Arc::new(angles.0))
}

/// The terms of `t̄(p)`.
fn rise_terms(own: &Symbols, rise: &Rise, angles: &mut Angles) -> Vec<Term> {
    let p = Fraction::symbol(&own.parameter);
    let one = || (Sign::Plus, Tree::Number(Rational::one()));
    let factor = rise.factor();
    let function =
        |name, argument: Vec<Term>| Tree::Function(name, Box::new(Tree::sum(argument).1));
    let mut terms =
        vec![times(of(&Fraction::constant(&-&factor)), function("ln", vec![one(), of(&-&p)]))];
    let mut add = |coefficient: &Fraction, function: Tree| {
        if !coefficient.is_zero() {
            terms.push(times(of(&coefficient.scale(&factor)), function));
        }
    };
    if rise.has_second_real_pole() {
        add(&Fraction::one(), function("ln", vec![one(), of(&p)]));
    }
    for [a, b] in &rise.pairs {
        let ((cosine, is_root), sine) = (angles.cosine(a), angles.sine(a));
        let mut square = vec![(Sign::Plus, power(symbol(&own.parameter), &ratio(2, 1)))];
        if !cosine.is_zero() {
            square.push(of(&(&cosine * &p).scale(&ratio(-2, 1))));
        }
        square.push(one());
        add(&-&angles.cosine(b).0, function("ln", square));
        // Roots are halves but at right angles.
        let whole = ratio(if is_root && !cosine.is_zero() { 2 } else { 1 }, 1);
        let top = of(&(&sine * &p).scale(&whole)).1;
        let below = -&(&cosine * &p).scale(&whole);
        let mut bottom = vec![of(&Fraction::constant(&whole))];
        if !below.is_zero() {
            bottom.push(of(&below));
        }
        let argument = match bottom.len() {
            1 => top,
            _ => Tree::Quotient(Box::new(top), Box::new(Tree::sum(bottom).1)),
        };
        let arctangent = Tree::Function("arctan", Box::new(argument));
        add(&angles.sine(b).scale(&ratio(2, 1)), arctangent);
    }
    for (coefficient, exponent) in &rise.powers {
        let power = Tree::power(symbol(&own.parameter), *exponent);
        terms.push(times(of(&Fraction::constant(&-coefficient)), power));
    }
    terms
}
