//! Laws that expressions, transforms and fractions obey, on random ones.
//!
//! They hold two symbols `a`, `b` and the variable `x`, coefficients over the factors declared
//! below, and exponents linear in `x` whose rates are symbols as well as numbers.

use crate::support::polynomial;
use std::cell::Cell;
use std::collections::BTreeMap;

use num_traits::{One, Zero};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use wavestep::expression::{
    Assumptions, Condition, Exact, ExponentialSum, Expression, Fraction, NotAUnit, NotInvertible,
    Relation, Transform,
};
use wavestep_polynomial::{Integer, Polynomial, Rational, Symbol};

const CASES: u32 = 96;

/// Factors that are taken to be non-zero.
const FACTORS: [&str; 4] = ["a", "b", "a - b", "a + 1"];

/// Rates that are zero or a product of declared factors and a number.
const RATES: [&str; 7] = ["0", "-a", "-b", "2", "b - a", "-1/3*a", "3*a + 3"];

fn fraction(text: &str) -> Fraction {
    polynomial(text).into()
}

fn symbol(name: &str) -> Symbol {
    Symbol::new(name).expect("a name")
}

fn x() -> Symbol {
    symbol("x")
}

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn assumptions() -> Assumptions {
    let mut assumptions = Assumptions::default();
    for factor in FACTORS {
        let unit = Fraction::reciprocal(&polynomial(factor)).expect("an irreducible factor");
        assumptions.declare_factors(&unit);
    }
    assumptions
}

fn any_polynomial() -> BoxedStrategy<Polynomial> {
    let term = (-3..=3i64, 1..=3i64, 0..=2u32, 0..=1u32, 0..=2u32);
    prop::collection::vec(term, 0..=3)
        .prop_map(|terms| {
            let names = [symbol("a"), symbol("b"), x()];
            terms.into_iter().fold(Polynomial::zero(), |sum, (p, q, a, b, x)| {
                let powers = [(&names[0], a), (&names[1], b), (&names[2], x)];
                &sum + &Polynomial::monomial(&rational(p, q), &powers)
            })
        })
        .boxed()
}

/// A product of inverse factors, often of none.
fn any_unit() -> BoxedStrategy<Fraction> {
    let powers = prop::array::uniform4(prop_oneof![5 => Just(0u32), 1 => Just(1), 1 => Just(2)]);
    powers
        .prop_map(|powers| {
            FACTORS.iter().zip(powers).fold(Fraction::one(), |unit, (factor, power)| {
                &unit * &Fraction::reciprocal(&polynomial(factor)).expect("a unit").pow(power)
            })
        })
        .boxed()
}

fn any_fraction() -> BoxedStrategy<Fraction> {
    (any_polynomial(), any_unit()).prop_map(|(p, unit)| &Fraction::from(p) * &unit).boxed()
}

fn any_rate() -> BoxedStrategy<Fraction> {
    prop::sample::select(&RATES[..]).prop_map(fraction).boxed()
}

fn any_expression() -> BoxedStrategy<Expression> {
    let base = prop::sample::select(vec!["0", "0", "0", "a", "-2*b", "1/2", "a*b - 1"]);
    let exponent = (any_rate(), base.prop_map(fraction), any_unit(), any::<bool>());
    let exponent = exponent.prop_map(|(rate, base, unit, over)| {
        let base = if over { &base * &unit } else { base };
        &(&rate * &Fraction::symbol(&x())) + &base
    });
    prop::collection::vec((exponent, any_fraction()), 0..=3)
        .prop_map(|terms| {
            let mut sum = Expression::zero();
            terms.into_iter().for_each(|(exponent, p)| sum.add_term(exponent, p));
            sum
        })
        .boxed()
}

/// Runs a law on random values, and prints how often it said nothing where that can be.
fn hold<S: Strategy>(values: &S, law: impl Fn(S::Value) -> Result<bool, TestCaseError>) {
    let undecided = Cell::new(0);
    let config = Config { cases: CASES, failure_persistence: None, ..Config::default() };
    let outcome = TestRunner::new(config).run(values, |value| {
        undecided.set(undecided.get() + u32::from(!law(value)?));
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    if undecided.get() > 0 {
        eprintln!("{} of {CASES} cases decided nothing", undecided.get());
    }
    assert!(undecided.get() < CASES / 4 * 3, "too few cases decide anything");
}

fn is_normal(value: &Expression) -> bool {
    value.terms().all(|(exponent, p)| {
        let cancelled =
            |f: &Fraction| f.factors().all(|(d, k)| k > 0 && f.numerator().divide(d).is_none());
        !p.is_zero() && cancelled(p) && cancelled(exponent)
    })
}

// ---- The ring ----------------------------------------------------------------------------------

#[test]
fn expressions_are_a_ring() {
    hold(&(any_expression(), any_expression(), any_expression()), |(p, q, r)| {
        prop_assert_eq!(&(&p + &q) + &r, &p + &(&q + &r));
        prop_assert_eq!(&p + &q, &q + &p);
        prop_assert_eq!(&p * &q, &q * &p);
        prop_assert_eq!(&(&p * &q) * &r, &p * &(&q * &r));
        prop_assert_eq!(&p * &(&q + &r), &(&p * &q) + &(&p * &r));
        prop_assert!((&p - &p).is_zero());
        prop_assert_eq!(&p - &q, &p + &-&q);
        prop_assert_eq!(&p * &Expression::one(), p.clone());
        prop_assert_eq!(p.pow(3), &(&p * &p) * &p);
        prop_assert_eq!(p.scale(&rational(2, 1)), &p + &p);
        for value in [&p, &(&p * &q), &(&p + &q)] {
            prop_assert!(is_normal(value), "{:?}", value);
        }
        let twice = p.scale(&rational(-7, 3));
        prop_assert_eq!(twice.proportion(&p), (!p.is_zero()).then(|| rational(-7, 3)));
        Ok(true)
    });
}

#[test]
fn products_in_place_are_products() {
    hold(&(any_expression(), any_expression(), any_fraction()), |(p, q, f)| {
        prop_assert_eq!(p.times(&f), &p * &Expression::from(f.clone()));
        let exponent = fraction("a*x - 1");
        let moved = p.clone().times_exponential(&exponent);
        prop_assert_eq!(moved, &p * &Expression::exponential(exponent));
        let mut sum = p.clone();
        sum += &q;
        sum -= &p;
        prop_assert_eq!(sum, q);
        Ok(true)
    });
}

// ---- Calculus ----------------------------------------------------------------------------------

#[test]
fn derivatives_obey_leibniz() {
    hold(&(any_expression(), any_expression()), |(p, q)| {
        for name in ["x", "a"] {
            let d = |value: &Expression| value.derivative(&symbol(name));
            prop_assert_eq!(d(&(&p * &q)), &(&d(&p) * &q) + &(&p * &d(&q)));
            prop_assert_eq!(d(&(&p + &q)), &d(&p) + &d(&q));
        }
        let (a, x) = (symbol("a"), x());
        prop_assert_eq!(p.derivative(&a).derivative(&x), p.derivative(&x).derivative(&a));
        Ok(true)
    });
}

#[test]
fn antiderivatives_derive_back_and_start_at_zero() {
    let assumptions = assumptions();
    hold(&(any_expression(), any_expression()), |(p, q)| {
        let of = |value: &Expression| value.antiderivative(&x(), &assumptions).expect("units");
        prop_assert_eq!(of(&p).derivative(&x()), p.clone());
        prop_assert!(of(&p).at_zero(&x()).is_zero());
        prop_assert_eq!(&of(&p) + &of(&q), of(&(&p + &q)));
        Ok(true)
    });
}

#[test]
fn an_unknown_rate_is_refused() {
    let growth = Expression::exponential(fraction("a*x + 2*b*x"));
    let refused = growth.antiderivative(&x(), &assumptions());
    assert_eq!(refused, Err(NotInvertible::Undeclared(polynomial("a + 2*b"))));
}

/// `y' + r y = q` and `y(0)`, with forcing at the pole itself among the cases.
#[test]
fn first_order_equations_are_solved() {
    let assumptions = assumptions();
    let resonant = Cell::new(0);
    let start = any_fraction().prop_map(|f| Expression::from(f).at_zero(&x()));
    hold(
        &(any_expression(), prop::sample::select(vec!["a", "b", "0", "-2"]), start),
        |(q, r, start)| {
            let rate = fraction(r);
            let pole = -&rate;
            let at_pole = |e: &Fraction| e.derivative(&x()) == pole;
            let Ok(y) = q.clone().solve_first_order(&x(), &rate, &start, &assumptions) else {
                return Ok(false);
            };
            resonant.set(resonant.get() + usize::from(q.terms().any(|(e, _)| at_pole(e))));
            prop_assert_eq!(&y.derivative(&x()) + &y.times(&rate), q);
            prop_assert_eq!(y.at_zero(&x()), start);
            Ok(true)
        },
    );
    eprintln!("{} cases resonant", resonant.get());
    assert!(resonant.get() > 0);
}

// ---- Substitution ------------------------------------------------------------------------------

#[test]
fn shifts_compose() {
    let steps =
        (any_rate(), prop::sample::select(vec!["a", "1/2", "-b", "2*a*b"]).prop_map(fraction));
    hold(&(any_expression(), steps), |(p, (h, k))| {
        let shift = |value: &Expression, by: &Fraction| value.shift(&x(), by).expect("no x below");
        prop_assert_eq!(shift(&shift(&p, &h), &k), shift(&p, &(&h + &k)));
        prop_assert_eq!(shift(&shift(&p, &h), &-&h), p.clone());
        prop_assert_eq!(shift(&p.derivative(&x()), &h), shift(&p, &h).derivative(&x()));
        prop_assert_eq!(shift(&p, &Fraction::zero()), p);
        Ok(true)
    });
}

#[test]
fn substitution_is_a_homomorphism() {
    let values = vec!["2", "-1/2", "b + 1", "a + 3", "-b", "a*b", "0", "-1", "b"];
    let value = (prop::sample::select(values).prop_map(fraction), any_unit());
    let value = value.prop_map(|(value, unit)| &value * &unit);
    let name = prop::sample::select(vec!["a", "x"]);
    hold(&(any_expression(), any_expression(), name, value), |(p, q, name, value)| {
        let put = |e: &Expression| e.substitute(&symbol(name), &value);
        let (Ok(p_put), Ok(q_put)) = (put(&p), put(&q)) else { return Ok(false) };
        prop_assert!(is_normal(&p_put), "{:?}", p_put);
        let (Ok(sum), Ok(product)) = (put(&(&p + &q)), put(&(&p * &q))) else {
            return Err(TestCaseError::fail("sums and products have no more factors below"));
        };
        prop_assert_eq!(sum, &p_put + &q_put);
        prop_assert_eq!(product, &p_put * &q_put);
        Ok(true)
    });
}

#[test]
fn a_denominator_that_vanishes_is_refused() {
    let quotient = Expression::from(Fraction::reciprocal(&polynomial("a - b")).expect("a unit"));
    let refused = quotient.substitute(&symbol("a"), &fraction("b"));
    assert_eq!(refused, Err(NotAUnit(Polynomial::zero())));
    let exponential = Expression::exponential(quotient.as_fraction().expect("no exponential"));
    assert!(exponential.substitute(&symbol("a"), &fraction("b")).is_err());
}

// ---- Numbers -----------------------------------------------------------------------------------

fn added(left: &ExponentialSum, right: &ExponentialSum) -> ExponentialSum {
    let mut sum = left.clone();
    right.iter().for_each(|(e, c)| *sum.entry(e.clone()).or_default() += c);
    sum.retain(|_, c| !c.is_zero());
    sum
}

fn multiplied(left: &ExponentialSum, right: &ExponentialSum) -> ExponentialSum {
    let mut product = ExponentialSum::new();
    for (e, c) in left {
        for (f, d) in right {
            *product.entry(e + f).or_default() += c * d;
        }
    }
    product.retain(|_, c| !c.is_zero());
    product
}

#[test]
fn evaluation_is_a_homomorphism() {
    // Values at which no declared factor vanishes.
    let values = ((5..=9i64, 1..=2i64), (1..=4i64, 2..=3i64), (-4..=4i64, 1..=3i64));
    hold(&(any_expression(), any_expression(), values), |(p, q, values)| {
        let ((a, i), (b, j), (c, k)) = values;
        let values = BTreeMap::from([
            (symbol("a"), rational(a, i)),
            (symbol("b"), rational(b, j)),
            (x(), rational(c, k)),
        ]);
        let at = |e: &Expression| e.evaluate(&|x| values.get(x).cloned()).expect("all have values");
        prop_assert_eq!(at(&(&p + &q)), added(&at(&p), &at(&q)));
        prop_assert_eq!(at(&(&p * &q)), multiplied(&at(&p), &at(&q)));
        let mut put = p.clone();
        for (symbol, value) in &values {
            put = put.substitute(symbol, &Fraction::constant(value)).expect("nothing vanishes");
        }
        prop_assert_eq!(at(&put), at(&p));
        prop_assert!(at(&Expression::one()).values().all(Rational::is_one));
        Ok(true)
    });
}

// ---- Transforms --------------------------------------------------------------------------------

#[test]
fn transforms_are_a_picture_of_functions() {
    let nothing = Assumptions::default();
    let exact = Exact::new(&nothing);
    hold(&(any_expression(), any_expression(), any_fraction()), |(p, q, f)| {
        let of = |e: &Expression| Transform::of(e, &x());
        prop_assert_eq!(of(&p).function(&x()), p.clone());
        prop_assert_eq!(of(&p).differentiated(&exact).ok(), Some(of(&p.derivative(&x()))));
        prop_assert_eq!(of(&p).initial(&exact), p.at_zero(&x()));
        prop_assert_eq!(of(&p).is_zero(), p.is_zero());
        let factor = Expression::from(f).at_zero(&x());
        let mut sum = of(&p);
        sum.add_product(&exact, &of(&q), &factor);
        prop_assert_eq!(sum.function(&x()), &p + &(&q * &factor));
        Ok(true)
    });
}

/// `G = F/(p − π)` belongs to `g' − π g = f`, `g(0) = 0`.
#[test]
fn division_by_a_pole_multiplies_back() {
    let assumptions = assumptions();
    let exact = Exact::new(&assumptions);
    hold(&(any_expression(), any_rate()), |(f, pole)| {
        let transform = Transform::of(&f, &x());
        let Ok(quotient) = transform.over_pole(&exact, &pole) else { return Ok(false) };
        prop_assert!(quotient.initial(&exact).is_zero());
        let mut product = quotient.differentiated(&exact).expect("exact values");
        product.add_product(&exact, &quotient, &-&Expression::from(pole.clone()));
        prop_assert_eq!(&product, &transform);
        // In time, the integrating factor gives the same.
        let zero = Expression::zero();
        let solved = f.solve_first_order(&x(), &-&pole, &zero, &assumptions);
        prop_assert_eq!(solved, Ok(quotient.function(&x())));
        Ok(true)
    });
}

// ---- Fractions ---------------------------------------------------------------------------------

#[test]
fn fractions_have_one_form() {
    hold(&(any_polynomial(), any_unit(), any_fraction(), any_fraction()), |(p, unit, f, g)| {
        let below = unit.denominator();
        prop_assert_eq!(&Fraction::from(&p * &below) * &unit, Fraction::from(p.clone()));
        prop_assert_eq!(&(&f + &g) - &g, f.clone());
        prop_assert_eq!(&(&f * &unit) * &below.clone().into(), f.clone());
        prop_assert_eq!(&f * &g, &g * &f);
        prop_assert_eq!(f.pow(2), &f * &f);
        prop_assert_eq!(f.with_numerator(f.numerator().clone()), f.clone());
        for value in [&f * &g, &f + &g, f.derivative(&symbol("a"))] {
            let cancelled = value.factors().all(|(d, _)| value.numerator().divide(d).is_none());
            prop_assert!(cancelled, "{}", value);
            prop_assert!(!value.is_zero() || value == Fraction::zero());
        }
        Ok(true)
    });
}

/// Constant multiples and signs of a factor are the same factor.
#[test]
fn factors_are_primitive() {
    let unit = |text: &str| Fraction::reciprocal(&polynomial(text)).expect("a unit");
    let minus = |value: &Fraction| -value;
    assert_eq!(unit("b - a"), minus(&unit("a - b")));
    assert_eq!(unit("3*a - 3*b").scale(&rational(3, 1)), unit("a - b"));
    assert_eq!(
        unit("2*a^2*b + 2*a*b"),
        (&unit("a").scale(&rational(1, 2)) * &(&unit("b") * &unit("a + 1")))
    );
}

#[test]
fn what_is_no_unit_is_refused() {
    for text in ["0", "a^80 - b^80"] {
        let p = polynomial(text);
        assert_eq!(Fraction::reciprocal(&p), Err(NotAUnit(p.clone())), "{text}");
    }
    let linear = ["5", "a", "a^2*b", "a - b", "a*b - 1", "2*a*x + 3", "a^2*b - a^2", "a^2 - b"];
    let others = ["a^2 - b^2", "a^3 + 1", "a*b + a + b + 1", "a^2 - 2*a*b + b^2", "x^2 - 4"];
    for text in linear.into_iter().chain(others) {
        let p = polynomial(text);
        let inverse = Fraction::reciprocal(&p).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(&inverse * &p.into(), Fraction::one(), "{text}");
    }
}

#[test]
fn only_what_is_known_is_inverted() {
    let assumptions = assumptions();
    let invert = |text: &str| assumptions.invert(&fraction(text).into());
    hold(&(any_unit(), any_rate(), 1..=9i64), |(unit, rate, number)| {
        let value = Expression::from(unit.scale(&rational(-number, 2))).times_exponential(&rate);
        let inverse = assumptions.invert(&value);
        prop_assert_eq!(inverse.map(|inverse| &inverse * &value), Ok(Expression::one()));
        let back = Expression::from(Fraction::from(unit.denominator()));
        let inverse = assumptions.invert(&back);
        prop_assert_eq!(inverse.map(|inverse| &inverse * &back), Ok(Expression::one()));
        Ok(true)
    });
    assert_eq!(invert("0"), Err(NotInvertible::Zero));
    assert_eq!(invert("2*a*x - 2*a"), Err(NotInvertible::Undeclared(polynomial("x - 1"))));
    let two = &Expression::exponential(fraction("a")) + &Expression::one();
    assert_eq!(assumptions.invert(&two), Err(NotInvertible::SumOfExponentials));
}

#[test]
fn conditions_tell_what_is_positive_and_what_is_not_zero() {
    let condition = |relation, bound| Some(Condition { relation, bound: rational(bound, 1) });
    let mut known = Assumptions::default();
    known.declare_symbol(symbol("a"), condition(Relation::Greater, 1));
    known.declare_symbol(symbol("b"), condition(Relation::AtLeast, 0));
    known.declare_symbol(symbol("c"), condition(Relation::Less, 0));
    known.declare_symbol(symbol("d"), condition(Relation::Unequal, 2));
    for positive in ["a", "a - 1", "a + b", "a*a - 1", "-c", "a - c", "1 - c", "b + 1", "a*c*c"] {
        assert!(known.is_positive(&fraction(positive)), "{positive}");
    }
    for undecided in ["b", "a - 2", "d", "c", "b*c", "a - b", "0", "d*d"] {
        assert!(!known.is_positive(&fraction(undecided)), "{undecided}");
    }
    for unit in ["a - 1", "a", "c", "1 - c", "d - 2", "a + b", "2*a - 2"] {
        let value = Expression::from(fraction(unit));
        let inverse = known.invert(&value).unwrap_or_else(|reason| panic!("{unit}: {reason}"));
        assert!((&value * &inverse).is_one(), "{unit}");
    }
    for refused in ["d", "b", "a - 2", "a - b"] {
        assert!(known.invert(&fraction(refused).into()).is_err(), "{refused}");
    }
}

/// `k` between 3 and 4, and `w` with a square that is known.
#[test]
fn bounds_and_squares_tell_what_is_inverted() {
    let mut known = Assumptions::default();
    known.declare_bounds(symbol("k"), rational(3, 1), rational(4, 1));
    assert!(
        known.is_positive(&fraction("k*k - 2*k")) && !known.is_positive(&fraction("k*k - 4*k"))
    );
    let positive = Some(Condition { relation: Relation::Greater, bound: rational(0, 1) });
    let mut known = Assumptions::default();
    known.declare_symbol(symbol("k"), positive.clone());
    known.declare_symbol(symbol("w"), positive);
    let value = Expression::from(fraction("w^3 + w*k^2 - w*k + k"));
    assert!(known.invert(&value).is_err());
    known.declare_square(symbol("w"), fraction("k - k^2"));
    let product = &value * &known.invert(&value).unwrap();
    assert!(known.reduced(&product).is_one());
    assert_eq!(known.reduced(&fraction("w^3").into()), fraction("k*w - k^2*w").into());
}

/// The inverse of what holds symbols with known squares, of neither sign: by the conjugate of one symbol, or of both in turn.
#[test]
fn known_squares_invert_what_has_no_sign() {
    let positive = Some(Condition { relation: Relation::Greater, bound: rational(0, 1) });
    let mut known = Assumptions::default();
    for name in ["k", "w", "z"] {
        known.declare_symbol(symbol(name), positive.clone());
    }
    known.declare_square(symbol("w"), fraction("k^2 + 1"));
    known.declare_square(symbol("z"), fraction("k^2 + 3"));
    assert_eq!(known.invert(&fraction("w - k").into()), Ok(fraction("w + k").into()));
    for text in ["w - z", "w*z - 1", "w + z - 1", "3*w - z", "z - 2*w + w*z"] {
        let value = Expression::from(fraction(text));
        let Ok(inverse) = known.invert(&value) else { panic!("{text}") };
        assert!(known.reduced(&(&value * &inverse)).is_one(), "{text}");
    }
}

/// What is said to be positive is positive where the conditions hold, and its inverse is one.
#[test]
fn signs_of_polynomials_agree_with_exact_values() {
    let mut known = Assumptions::default();
    let above = |lower| Some(Condition { relation: Relation::Greater, bound: lower });
    known.declare_symbol(symbol("a"), above(rational(0, 1)));
    known.declare_symbol(symbol("b"), above(rational(1, 2)));
    known.declare_bounds(symbol("x"), rational(314, 100), rational(315, 100));
    let told = Cell::new(0);
    let offsets = ((1..=40i64, 1..=9i64), (1..=40i64, 1..=9i64), 0..=10i64);
    hold(&(any_polynomial(), any_polynomial(), offsets), |(p, q, ((a, i), (b, j), c))| {
        let values = BTreeMap::from([
            (symbol("a"), rational(a, i)),
            (symbol("b"), rational(1, 2) + rational(b, j)),
            (x(), rational(3140 + c, 1000)),
        ]);
        let at = |p: &Polynomial| {
            p.evaluate(|x: &Symbol| values.get(x).cloned()).expect("all have values")
        };
        for p in [&p, &q, &(&p * &q), &(&(&p * &p) + &q)] {
            let positive = known.is_positive(&p.clone().into());
            told.set(told.get() + usize::from(positive));
            prop_assert!(!positive || at(p) > Rational::zero(), "{}", p);
            let value = Expression::from(Fraction::from(p.clone()));
            let Ok(inverse) = known.invert(&value) else { continue };
            prop_assert!(!at(p).is_zero(), "{}", p);
            prop_assert!((&value * &inverse).is_one(), "{}", p);
        }
        Ok(true)
    });
    assert!(told.get() > 20, "{} were told to be positive", told.get());
}

#[test]
fn polynomials_of_one_sign_are_inverted() {
    let mut known = Assumptions::default();
    let above = |bound| Some(Condition { relation: Relation::Greater, bound });
    known.declare_symbol(symbol("a"), above(rational(0, 1)));
    known.declare_symbol(symbol("b"), above(rational(1, 2)));
    known.declare_symbol(symbol("d"), None);
    let inverts = |text: &str| known.invert(&fraction(text).into());
    for text in ["4*a^3 + 17*a^2 + 20*a + 4", "a^2 + 2*a + 1", "2*a*b - a", "a^3 + a*b + 1"] {
        let product =
            &inverts(text).unwrap_or_else(|e| panic!("{text}: {e}")) * &fraction(text).into();
        assert!(product.is_one(), "{text}");
    }
    // The factor that may vanish is named.
    assert_eq!(inverts("a*d - a^2 + d - a"), Err(NotInvertible::Undeclared(polynomial("a - d"))));
    let root = Fraction::symbol(&Symbol::square_root(2).expect("a prime"));
    assert!(known.is_positive(&root.scale(&rational(1, 10))));
    assert!(known.is_positive(&(&root - &Fraction::constant(&rational(7, 5)))));
    assert!(!known.is_positive(&(&root - &Fraction::constant(&rational(3, 2)))));
}

/// A root is known within 2⁻⁶⁴, π within 2⁻⁶¹: what is nearer is not told, what is farther is, on both sides.
#[test]
fn roots_and_pi_are_told_from_numbers_that_are_near() {
    let known = Assumptions::default();
    let scale = Integer::from(1) << 64_u32;
    for square in [2_u32, 3, 7] {
        let root = Fraction::symbol(&Symbol::square_root(square.into()).expect("a prime"));
        let below = (Integer::from(square) << 128_u32).sqrt();
        for (off, is_below, is_above) in
            [(-1, true, false), (0, false, false), (1, false, false), (2, false, true)]
        {
            let near = Fraction::constant(&Rational::new(&below + off, scale.clone()));
            assert_eq!(known.is_positive(&(&root - &near)), is_below, "{square} {off}");
            assert_eq!(known.is_positive(&(&near - &root)), is_above, "{square} {off}");
        }
    }
    let pi = Fraction::symbol(&symbol("pi"));
    // 3.14159265358979323846…
    for (digits, is_below, is_above) in
        [("3.141592653589793238", true, false), ("3.141592653589793239", false, true)]
    {
        let digits: Integer = digits.replace('.', "").parse().expect("digits");
        let near = Fraction::constant(&Rational::new(digits, Integer::from(10).pow(18)));
        assert_eq!(known.is_positive(&(&pi - &near)), is_below);
        assert_eq!(known.is_positive(&(&near - &pi)), is_above);
    }
}

/// A quadratic is split where its discriminant is a square, and only there.
#[test]
fn quadratics_are_split_where_they_can_be() {
    let inverse = |text: &str| Fraction::reciprocal(&polynomial(text)).expect("a divisor");
    for (product, [one, other]) in [
        ("a^2 - 4*b^2", ["a - 2*b", "a + 2*b"]),
        ("6*a^2 + a*b - b^2", ["2*a + b", "3*a - b"]),
        ("a^2 - b^2*c^2 + 2*a + 1", ["a + 1 - b*c", "a + 1 + b*c"]),
    ] {
        assert_eq!(inverse(product), &inverse(one) * &inverse(other), "{product}");
    }
    for irreducible in ["a^2 + 4*b^2", "a^2 - 2*b^2", "a^2 + b", "a^2 + a + 1"] {
        assert_eq!(inverse(irreducible).factors().count(), 1, "{irreducible}");
    }
}
