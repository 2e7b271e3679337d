//! Square roots in exact values: division, square roots of fractions, and the calculus with poles
//! that are roots of quadratics.

use crate::support::polynomial;
use proptest::prelude::*;
use std::collections::BTreeMap;
use wavestep::enclosure::{Numbers, enclose_expression};
use wavestep::expression::{
    Assumptions, Condition, Exact, Expression, Fraction, Relation, Transform,
};
use wavestep::language::{Source, read_recurrence};
use wavestep::recurrence::Recurrence;
use wavestep_polynomial::{Rational, Symbol};

fn fraction(text: &str) -> Fraction {
    polynomial(text).into()
}

fn expression(text: &str) -> Expression {
    polynomial(text).into()
}

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn s() -> Symbol {
    Symbol::new("s").expect("a name")
}

/// `e^{λs}`.
fn wave(rate: &Fraction) -> Expression {
    Expression::exponential(rate * &Fraction::symbol(&s()))
}

/// The roots of `p² + b p + c`.
fn poles(b: &Rational, c: &Rational) -> [Fraction; 2] {
    let four = Rational::from_integer(4.into());
    let root = Fraction::constant(&(b * b - four * c)).square_root().expect("small factors");
    let half = rational(1, 2);
    let middle = Fraction::constant(&-b);
    [(&middle + &root).scale(&half), (&middle - &root).scale(&half)]
}

/// `y'' + b y' + c y`.
fn operator(y: &Expression, b: &Rational, c: &Rational) -> Expression {
    let slope = y.derivative(&s());
    &(&slope.derivative(&s()) + &slope.scale(b)) + &y.scale(c)
}

/// The quadratics that are tried: complex pairs, real pairs in `Q(√d)`, rational pairs, double
/// poles, and purely imaginary ones.
fn quadratics() -> Vec<(Rational, Rational)> {
    let of = |b, c| (rational(b, 1), rational(c, 1));
    let mut all = vec![of(1, 1), of(4, 1), of(3, 2), of(2, 1), of(0, 1), of(0, -2), of(2, 7)];
    all.push((rational(1, 3), rational(5, 7)));
    all
}

/// An algebraic number `a + b√−1 + c√2 + d√3 + e√−1√3`.
fn numbers() -> BoxedStrategy<Fraction> {
    let roots = ["1", "sqrt(-1)", "sqrt(2)", "sqrt(3)", "sqrt(-1)*sqrt(3)"].map(fraction);
    prop::collection::vec((-4_i64..5, 1_i64..4), roots.len())
        .prop_map(move |values| {
            let part = |(root, (above, below)): (&Fraction, &(i64, i64))| {
                root.scale(&rational(*above, *below))
            };
            let parts = roots.iter().zip(&values).map(part);
            parts.fold(Fraction::zero(), |sum, part| &sum + &part)
        })
        .boxed()
}

proptest! {
    #[test]
    fn numbers_form_a_field(a in numbers(), b in numbers()) {
        prop_assume!(!a.is_zero());
        let inverse = Fraction::reciprocal(a.numerator()).unwrap();
        prop_assert!((&a * &inverse).is_one());
        prop_assert_eq!(&(&(&a * &b) * &inverse), &b);
        prop_assert_eq!(Assumptions::default().invert(&a.into()), Ok(inverse.into()));
    }

    #[test]
    fn rationals_have_square_roots(a in -400_i64..400, b in 1_i64..60, c in 1_i64..90) {
        let value = Fraction::constant(&rational(a, b));
        let root = value.square_root().unwrap();
        prop_assert_eq!(root.pow(2), value.clone());
        // √(c² x) = c √x.
        let scaled = value.scale(&rational(c * c, 1)).square_root();
        prop_assert_eq!(scaled, Some(root.scale(&rational(c, 1))));
    }

    #[test]
    fn products_with_symbols_are_inverted(a in numbers(), k in 0_u32..3, l in 0_u32..3) {
        prop_assume!(!a.is_zero());
        let mut known = Assumptions::default();
        let positive = Condition { relation: Relation::Greater, bound: rational(0, 1) };
        known.declare_symbol(Symbol::new("r").unwrap(), Some(positive));
        let product = &(&fraction("r").pow(k) * &fraction("r - 1").pow(l)) * &a;
        known.declare_factors(&Fraction::reciprocal(&polynomial("r - 1")).unwrap());
        let value = Expression::from(product).times_exponential(&fraction("sqrt(2)*r"));
        prop_assert!((&known.invert(&value).unwrap() * &value).is_one());
    }
}

#[test]
fn square_roots_of_large_numbers() {
    let root = |value: &str| {
        let value = Fraction::constant(&value.parse().unwrap());
        value.square_root().inspect(|root| assert_eq!(root.pow(2), value))
    };
    assert!(root("1000003").is_some());
    assert!(root("-999999999989/4").is_some());
    // (10⁹ + 7)² · 6 has a large factor, but a square one.
    assert!(root("6000000084000000294").is_some());
    assert!(root("1000000007").is_some());
    // 1000003 · 1000033, and a prime above 10¹²: their factors are not looked for.
    assert_eq!(root("1000036000099"), None);
    assert_eq!(root("1000000000039"), None);
}

#[test]
fn square_roots_of_fractions() {
    let inverse = Fraction::reciprocal(&polynomial("r + 1")).unwrap();
    let square = &fraction("-3*r^2 + 6*r - 3") * &inverse.pow(4);
    let root = square.square_root().unwrap();
    assert_eq!(root.pow(2), square);
    assert_eq!(root, &fraction("sqrt(-1)*sqrt(3)*r - sqrt(-1)*sqrt(3)") * &inverse.pow(2));
    assert_eq!((&fraction("4") * &inverse).square_root(), None);
    assert_eq!(fraction("sqrt(2)").square_root(), None);
    assert_eq!(Fraction::zero().square_root(), Some(Fraction::zero()));
}

#[test]
fn what_may_vanish_is_not_inverted() {
    let known = Assumptions::default();
    for text in ["x + sqrt(2)", "sqrt(3)*x", "x*sqrt(-1) + 1"] {
        let error = known.invert(&expression(text)).unwrap_err();
        assert!(error.to_string().ends_with("not known to be non-zero"), "{error}");
    }
    assert!(!known.is_positive(&fraction("-sqrt(2)")) && !known.is_positive(&fraction("sqrt(-1)")));
    // Twice the same factor that cannot vanish: its norm is a fourth power.
    let mut known = Assumptions::default();
    let positive = Condition { relation: Relation::Greater, bound: rational(0, 1) };
    known.declare_symbol(Symbol::new("r").unwrap(), Some(positive));
    let value = expression("sqrt(2) + sqrt(3) + r*sqrt(2) + r*sqrt(3)");
    assert!((&known.invert(&value).unwrap() * &value).is_one());
}

/// π is a number between two others.
#[test]
fn pi_is_known_by_its_bounds() {
    let known = Assumptions::default();
    for text in ["pi", "pi^2 + 4", "1000*pi - 3141", "pi - 22/7", "pi*sqrt(2) - 4"] {
        let value = expression(text);
        assert!((&known.invert(&value).unwrap() * &value).is_one(), "{text}");
    }
    assert!(
        known.is_positive(&fraction("22/7 - pi")) && !known.is_positive(&fraction("pi - 22/7"))
    );
    // Within 10⁻²⁰ of π.
    assert!(known.invert(&expression("pi - 3.14159265358979323846")).is_err());
}

#[test]
fn a_rationalised_denominator_cancels() {
    // (x² − 2)/(x + √2) = x − √2.
    let quotient = polynomial("x^2 - 2").divide(&polynomial("x + sqrt(2)"));
    assert_eq!(quotient, Some(polynomial("x - sqrt(2)")));
    let inverse = Fraction::reciprocal(&polynomial("x + sqrt(2)")).unwrap();
    assert!((&inverse * &fraction("x + sqrt(2)")).is_one());
    // √3/(3 + √3) = (√3 − 1)/2.
    let inverse = Fraction::reciprocal(&polynomial("3 + sqrt(3)")).unwrap();
    assert_eq!(&fraction("sqrt(3)") * &inverse, fraction("1/2*sqrt(3) - 1/2"));
    // Substitution brings a root into a denominator.
    let inverse = Fraction::reciprocal(&polynomial("x + 1")).unwrap();
    let at = inverse.substitute(&Symbol::new("x").unwrap(), &fraction("sqrt(2)"));
    assert_eq!(at, Ok(fraction("sqrt(2) - 1")));
}

#[test]
fn poles_solve_their_quadratics() {
    for (b, c) in quadratics() {
        for pole in poles(&b, &c) {
            let value = &(&pole.pow(2) + &pole.scale(&b)) + &Fraction::constant(&c);
            assert!(value.is_zero(), "p² + {b} p + {c} at {pole}");
            assert!(operator(&wave(&pole), &b, &c).is_zero());
        }
    }
    assert_eq!(
        poles(&rational(4, 1), &rational(1, 1)),
        ["-2 + sqrt(3)", "-2 - sqrt(3)"].map(fraction)
    );
    let sixth = ["-1/2 + 1/2*sqrt(-1)*sqrt(3)", "-1/2 - 1/2*sqrt(-1)*sqrt(3)"].map(fraction);
    assert_eq!(poles(&rational(1, 1), &rational(1, 1)), sixth);
}

// ---- Rates of coupled equations ---------------------------------------------------------------

/// A recurrence `x_i' = x_{i+1}`, `x_m' = −Σ c_k x_{m+1−k}` whose rates are the zeros of the monic
/// polynomial `λ^m + p_1 λ^{m−1} + …`: with `x' = −A x` they are the eigenvalues of `A`, so that
/// `c_k = (−1)^k p_k`. The last wave is `x_m + x_1`, which couples all of them where a `c_k` is zero too.
fn companion(p: &[Rational]) -> Recurrence {
    let m = p.len();
    let waves: Vec<String> = (1..=m).map(|i| format!("x{i}")).collect();
    let x = |i: usize| match i == m {
        true => format!("(x{m}[n] - x1[n])"),
        false => format!("x{i}[n]"),
    };
    let names = waves.join(", ");
    let mut text = format!("recurrence \"Rates\"\nperiod 1, local s, time t\nwave {names}\n");
    for i in 1..m {
        text += &format!("equation x{i}[n]' = {}\n", x(i + 1));
    }
    let term = |(k, c): (usize, &Rational)| {
        let c = if k % 2 == 0 { -c } else { c.clone() };
        format!(" - ({c})*{}", x(m - k))
    };
    let terms: String = p.iter().enumerate().map(term).collect();
    text += &format!("equation x{m}[n]' = {}{terms}\n", x(2));
    for wave in &waves {
        text += &format!("continuous {wave}[n] starts at 1\n");
    }
    let source = Source::new("rates", text).unwrap();
    read_recurrence(&source, &BTreeMap::new()).unwrap_or_else(|error| panic!("{error}"))
}

/// The value of a monic polynomial, which must be zero at a rate.
fn value(p: &[Rational], rate: &Fraction) -> Fraction {
    p.iter().fold(Fraction::one(), |sum, c| &(&sum * rate) + &Fraction::constant(c))
}

#[test]
fn rates_are_roots() {
    for coefficients in [
        &[(3, 1), (2, 1)][..],
        &[(1, 1), (1, 1)],
        &[(4, 1), (1, 1)],
        &[(0, 1), (0, 1), (-8, 1)],
        &[(7, 6), (1, 6), (0, 1), (0, 1)],
        &[(2, 1), (3, 1), (2, 1), (1, 1)],
    ] {
        let p: Vec<Rational> = coefficients.iter().map(|(a, b)| rational(*a, *b)).collect();
        let recurrence = companion(&p);
        let rates = &recurrence.coupled()[0].rates;
        assert_eq!(rates.len(), p.len());
        assert!(rates.iter().all(|rate| value(&p, rate).is_zero()), "{coefficients:?}");
        // All of them, with their multiplicities: the product of the factors is p.
        let product = rates.iter().fold(vec![Fraction::one()], |product, root| {
            let mut next = product.clone();
            next.push(Fraction::zero());
            for (i, c) in product.iter().enumerate() {
                next[i + 1] = &next[i + 1] - &(c * root);
            }
            next
        });
        assert_eq!(product[1..], p.iter().map(Fraction::constant).collect::<Vec<_>>());
    }
}

#[test]
fn a_cubic_has_a_named_root_and_a_pair() {
    // λ³ − 2: the real root r, and −r/2 ± i√3 r/2, since the discriminant is a square of r.
    let p = [rational(0, 1), rational(0, 1), rational(-2, 1)];
    let recurrence = companion(&p);
    let constants = recurrence.constants();
    let names: Vec<&str> = constants.iter().map(|constant| constant.symbol.name()).collect();
    let rates = &recurrence.coupled()[0].rates;
    assert_eq!((rates.len(), &names[..]), (3, &["rho"][..]));
    // Each of them is a zero, in numbers.
    let numbers = Numbers::new(constants);
    for root in rates {
        let zero = Expression::from(value(&p, root));
        let at = |symbol: &Symbol, bits| numbers.value(symbol, bits);
        let found = enclose_expression(&zero, &at, 200).unwrap();
        for part in [found.real(), found.imaginary()] {
            assert!(part.contains(&rational(0, 1)));
            // To about fifty digits and no more.
            let far = rational(10, 1).pow(-50);
            assert!(!part.contains(&far) && !part.contains(&-far));
        }
    }
}

/// Transforms divided by `(p − λ₁)(p − λ₂)`, and two equations of first order one after the other,
/// give the same function; it solves the equation; and with rational data no conjugation changes
/// it.
#[test]
fn two_ways_to_solve_equations_of_second_order() {
    let known = Assumptions::default();
    let forcing = &(&expression("s^2 + 1/2") + &wave(&fraction("-1"))) + &wave(&fraction("-1/2"));
    for (b, c) in quadratics() {
        let [first, second] = poles(&b, &c);
        let transform = Transform::of(&forcing, &s());
        let divided = transform.over_pole(&Exact::new(&known), &first).unwrap();
        let divided = divided.over_pole(&Exact::new(&known), &second).unwrap();
        let y = divided.function(&s());

        let zero = Expression::zero();
        let inner = forcing.clone().solve_first_order(&s(), &-&first, &zero, &known).unwrap();
        let stepped = inner.solve_first_order(&s(), &-&second, &zero, &known).unwrap();
        assert_eq!(y, stepped, "b = {b}, c = {c}");
        assert_eq!(operator(&y, &b, &c), forcing);
        assert!(y.at_zero(&s()).is_zero() && y.derivative(&s()).at_zero(&s()).is_zero());
        for root in y.roots() {
            assert_eq!(y.conjugate(&root), y, "{root}");
            assert_ne!(first.conjugate(&root), first);
        }
        assert_eq!(y.roots(), first.roots().cloned().collect::<Vec<_>>());
        assert_eq!(Transform::of(&y, &s()), divided);
    }
}

#[test]
fn antiderivatives_with_complex_rates() {
    let known = Assumptions::default();
    let rates = ["1/2*sqrt(-1)*sqrt(3)", "sqrt(2)", "sqrt(2) - sqrt(-1)", "0"].map(fraction);
    let sum = |text: &str| {
        rates.iter().fold(Expression::zero(), |sum, rate| &sum + &wave(rate).times(&fraction(text)))
    };
    for text in ["1", "s^3 - s*sqrt(3)", "mu*s^2 + sqrt(-1)"] {
        let integrand = sum(text);
        let integral = integrand.antiderivative(&s(), &known).unwrap();
        assert_eq!(integral.derivative(&s()), integrand);
        assert!(integral.at_zero(&s()).is_zero());
    }
}

#[test]
fn a_root_has_no_rational_value() {
    let i = Symbol::square_root(-1).unwrap();
    let any = |_: &Symbol| Some(rational(1, 1));
    assert_eq!(fraction("x + sqrt(-1)").evaluate(&any), Err(i.clone()));
    assert_eq!(wave(&fraction("sqrt(-1)")).evaluate(&any), Err(i));
}
