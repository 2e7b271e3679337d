//! The energy of a series: its square and what is not kept of it.

use num_traits::Signed as _;
use proptest::prelude::*;
use wavestep::ball::{Ball, Magnitude, Number};
use wavestep::history::series::{CellNorm, Series, Truncation};
use wavestep_polynomial::Rational;

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// `∫_0^x f²` by its definition, each time anew: all products of coefficients that are kept. With
/// `f = P + R`, `|R| ≤ ε`, the other part is at most `x (2 ε |P| + ε²)`.
pub fn direct_energy(f: &Series, x: &Number, cut: &Truncation) -> Number {
    let bits = cut.bits;
    let length = f.coefficients.len();
    let mut sum = Number::zero();
    for k in (0..(2 * length).saturating_sub(1)).rev() {
        let mut product = Number::zero();
        for i in k.saturating_sub(length - 1)..=k.min(length - 1) {
            let term = f.coefficients[i].multiply(&f.coefficients[k - i], bits);
            product = product.add(&term, bits);
        }
        sum = sum.add(&product.over(k as u64 + 1, bits), bits).multiply(x, bits);
    }
    let size = x.magnitude();
    let error = f.rest;
    let whole = f.size_from(0, &size).scale(1).add(&error);
    sum.widened(&error.multiply(&whole).multiply(&size), bits)
}

/// `Σ a e^{λx}` for pairs `(a, λ)`, `|λ| ≤ γ`, cut off after N terms, on a cell as long as the longest.
pub fn exponentials(terms: &[(Rational, Rational)], cut: &Truncation) -> Series {
    let norm = CellNorm::new(cut.longest, cut);
    let mut coefficients = Vec::new();
    let mut rest = Magnitude::ZERO;
    let mut powers: Vec<Rational> = terms.iter().map(|(a, _)| a.clone()).collect();
    // After so many more terms each adds less than half the one before.
    let last = cut.order + 40;
    for k in 0..=last {
        let sum: Rational = powers.iter().sum();
        match k < cut.order {
            true => coefficients.push(Number::Enclosed(Ball::from_rational(&sum, cut.bits))),
            false => {
                let sizes = powers.iter().map(|power| Magnitude::from_rational(&power.abs()));
                let norms = sizes.map(|size| norm.of_term(k, &size));
                let added = norms.fold(Magnitude::ZERO, |sum, own| sum.add(&own));
                rest = rest.add(&added.scale(i64::from(k == last)));
            }
        }
        for (power, (_, rate)) in powers.iter_mut().zip(terms) {
            *power *= rate / Rational::from_integer((k as i64 + 1).into());
        }
    }
    Series::new(coefficients, rest)
}

/// For rates up to `2^rate` and cells four times as long as the inverse of that.
pub fn truncation(bits: u64, rate: i64) -> Truncation {
    Truncation { longest: Magnitude::power_of_two(2 - rate), ..Truncation::new(bits, rate) }
}

/// The square of the same sum, and `∫_0^x` of it.
fn squared(terms: &[(Rational, Rational)], x: &Rational) -> [Ball; 2] {
    let mut sums = [Ball::zero(), Ball::zero()];
    for (a, rate) in terms {
        for (b, other) in terms {
            let (product, rate) = (a * b, rate + other);
            let power = Ball::from_rational(&(&rate * x), 600).exp(600).unwrap();
            let term = power.multiply_rational(&product, 600);
            sums[0] = sums[0].add(&term, 600);
            let integral = if rate == Rational::default() {
                Ball::from_rational(&(product * x), 600)
            } else {
                let start = Ball::from_rational(&product, 600);
                term.subtract(&start, 600).multiply_rational(&rate.recip(), 600)
            };
            sums[1] = sums[1].add(&integral, 600);
        }
    }
    sums
}

/// Amplitudes in thirds, rates in eighths of the largest, up to that.
fn terms(rate: i64, own: &[(i64, i64)]) -> Vec<(Rational, Rational)> {
    let scale = Rational::from(&Magnitude::power_of_two(rate - 3));
    own.iter().map(|&(a, part)| (rational(a, 3), &scale * rational(part, 1))).collect()
}

proptest! {
    /// A polynomial with rational coefficients has a rational energy, that by its definition.
    #[test]
    fn exact_waves_have_exact_energies(
        own in prop::collection::vec(-9_i64..10, 0..9), x in 0_i64..20,
    ) {
        let cut = Truncation { order: 3, ..truncation(64, 0) };
        let numbers = own.iter().map(|c| Number::Exact(rational(*c, 7))).collect();
        let f = Series::new(numbers, Magnitude::ZERO);
        let x = rational(x, 5);
        let mut sum = Rational::default();
        for (i, a) in own.iter().enumerate() {
            for (j, b) in own.iter().enumerate() {
                let power = (0..=i + j).fold(rational(1, 1), |power, _| power * &x);
                sum += power * rational(a * b, 49 * (i + j + 1) as i64);
            }
        }
        prop_assert_eq!(f.energy(&cut).value(&Number::Exact(x)), Number::Exact(sum));
    }

    /// What is not kept of a square is enclosed, with few terms as well, where that is most of it.
    #[test]
    fn what_is_omitted_is_bounded(
        rate in -2_i64..4, order in 1_usize..7, place in 1_i64..25,
        own in prop::collection::vec((-6_i64..7, -8_i64..9), 1..4),
    ) {
        let cut = Truncation { order, ..truncation(200, rate) };
        let terms = terms(rate, &own);
        let energy = exponentials(&terms, &cut).energy(&cut);
        // Up to the end of the cell.
        let x = rational(place, 6) / Rational::from(&Magnitude::power_of_two(rate));
        let at = Number::Exact(x.clone());
        let [square, integral] = squared(&terms, &x);
        let mut kept = Number::zero();
        for (k, c) in energy.coefficients.iter().enumerate().rev() {
            let p = c.multiply(&Number::integer(k as i64 + 1), 200);
            kept = kept.multiply(&at, 200).add(&p, 200);
        }
        let omitted = kept.widened(&energy.omitted(&at.magnitude()), 200).ball(200);
        prop_assert!(omitted.subtract(&square, 600).contains_zero(), "{omitted} {square}");
        let value = energy.value(&at).ball(200);
        prop_assert!(value.subtract(&integral, 600).contains_zero(), "{value} {integral}");
    }

    /// With all terms the energy is as narrow as the direct sum, up to rounding, and the same number.
    #[test]
    fn energies_are_those_of_the_direct_sum(
        rate in -2_i64..4, place in 1_i64..25,
        own in prop::collection::vec((-6_i64..7, -2_i64..3), 1..4),
    ) {
        let cut = truncation(128, rate);
        let terms = terms(rate, &own);
        let f = exponentials(&terms, &cut);
        let x = rational(place, 6) / Rational::from(&Magnitude::power_of_two(rate));
        let [_, exact] = squared(&terms, &x);
        let at = Number::Exact(x);
        let (kept, direct) = (f.energy(&cut).value(&at).ball(128), direct_energy(&f, &at, &cut));
        for one in [&kept, &direct.ball(128)] {
            prop_assert!(one.subtract(&exact, 600).contains_zero(), "{one} {exact}");
        }
        // Up to two bits, since the order of roundings differs; and the result is rounded once itself.
        let allowed = direct.ball(128).radius().scale(2).add(&exact.magnitude().scale(-127));
        prop_assert!(*kept.radius() <= allowed, "{kept} {direct:?}");
    }
}

#[test]
fn nothing_has_no_energy() {
    let cut = truncation(64, 0);
    let x = Number::Enclosed(Ball::symmetric(&rational(1, 2)));
    assert_eq!(Series::zero().energy(&cut).value(&x), Number::zero());
    let alone = Series::new(Vec::new(), Magnitude::from_u64(1)).energy(&cut);
    assert!(alone.value(&Number::one()).ball(64).contains_zero());
    assert!(!alone.value(&Number::one()).is_zero());
}
