//! What a wave holds between two instants: `∫ w dt` and `∫ w² dt`, to which the momentum and the energy
//! of a bar are proportional.
//!
//! Both antiderivatives of a cell are worked out once, when first asked for. A part of the cell is then a
//! difference of two of their values, and the whole cell one value that is kept.

use crate::ball::{Magnitude, Number};
use crate::history::series::{CellNorm, Series, Truncation};
use std::cell::OnceCell;

/// `∫_0^x f²` of a series `f(x) = Σ c_k x^k`.
///
/// `f² = Σ p_k x^k` with `p_k = Σ_{i+j=k} c_i c_j`. The first `M` of these are kept and the others bounded.
///
/// # Invariants
/// - `coefficients` hold `p_k/(k+1)` for `k < M`;
/// - `sizes` hold bounds of `|c_k|` for `k < N`;
/// - `rest` bounds what the polynomial of the series leaves out.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Energy {
    coefficients: Vec<Number>,
    sizes: Vec<Magnitude>,
    rest: Magnitude,
    bits: u64,
}

impl Series {
    /// `∫_0^x f²`. A polynomial with rational coefficients gives all of its square, other series the `N`
    /// coefficients that they have themselves.
    /// These are `n²/4` products for `n` coefficients, `n²` for rational ones.
    pub(crate) fn energy(&self, cut: &Truncation) -> Energy {
        let bits = cut.bits;
        let mut own = self.coefficients.clone();
        let mut length = (2 * own.len()).saturating_sub(1);
        if !self.is_exact() {
            // p_k with k < N needs no c_j with j ≥ N.
            length = length.min(cut.order);
            own.iter_mut().for_each(|c| *c = c.enclosed(bits));
        }
        let product = |k: usize| {
            // c_i c_j and c_j c_i are one product.
            let first = (k + 1).saturating_sub(own.len());
            let mut sum = (first..k.div_ceil(2))
                .fold(Number::zero(), |sum, i| sum.add(&own[i].multiply(&own[k - i], bits), bits));
            sum = sum.add(&sum, bits);
            if k.is_multiple_of(2) {
                sum = sum.add(&own[k / 2].multiply(&own[k / 2], bits), bits);
            }
            sum.over(k as u64 + 1, bits)
        };
        let coefficients = (0..length).map(product).collect();
        let sizes = own.iter().map(Number::magnitude).collect();
        Energy { coefficients, sizes, rest: self.rest, bits }
    }
}

impl Energy {
    /// `∫_0^x f²`, an enclosure, for `0 ≤ x`, `γ x ≤ 8`.
    pub fn value(&self, x: &Number) -> Number {
        let bits = self.bits;
        let mut sum = Number::zero();
        for c in self.coefficients.iter().rev() {
            sum = sum.add(c, bits).multiply(x, bits);
        }
        let size = x.magnitude();
        sum.widened(&self.omitted(&size).multiply(&size), bits)
    }

    /// A bound of `|f² − Σ_{k<M} p_k x^k|` at all points up to `x`.
    ///
    /// With `a_k = |c_k| x^k` and `t_m = Σ_{j≥m} a_j`, the terms of the square that are not kept are those
    /// with `i + j ≥ M`, together at most
    /// `Σ_{i<N} a_i t_{M−i} + Σ_{i≥N} a_i t_0 = Σ_{i<N} a_i t_{M−i} + t_N t_0`, where `t_m = t_0` for `m ≤ 0`.
    /// And `t_N ≤ ε`, the remainder of the series, so that `t_m ≤ Σ_{m≤j<N} a_j + ε` for all `m`. All of it
    /// grows with `x`.
    ///
    /// It is no wider than it need be: where `|c_k| x^k ≤ C z^k/k!` for all `k`, the sum is at most
    /// `C² Σ_{k≥M} (2z)^k/k!`, since `Σ_{i+j=k} 1/(i! j!) = 2^k/k!`. And `γ` is at least twice the rate of
    /// every node and load, so that `2z ≤ γ h`, for which `N` is chosen.
    fn omitted(&self, x: &Magnitude) -> Magnitude {
        let mut power = Magnitude::power_of_two(0);
        let terms: Vec<Magnitude> = self
            .sizes
            .iter()
            .map(|size| {
                let term = size.multiply(&power);
                power = power.multiply(x);
                term
            })
            .collect();
        let remainder = self.rest;
        // t_n, t_(n−1), …, t_0.
        let mut tails = vec![remainder];
        for term in terms.iter().rev() {
            tails.push(tails[tails.len() - 1].add(term));
        }
        let whole = tails[terms.len()];
        let tail = |m: usize| &tails[terms.len() - m.min(terms.len())];
        let products = terms
            .iter()
            .enumerate()
            .map(|(i, term)| term.multiply(tail(self.coefficients.len().saturating_sub(i))));
        products.fold(remainder.multiply(&whole), |sum, product| sum.add(&product))
    }
}

/// An antiderivative of a wave or of its square.
#[derive(Debug)]
enum Antiderivative {
    Wave(Series),
    Square(Energy),
}

/// What is kept of an antiderivative: itself, and its value at the end of the cell.
#[derive(Debug)]
struct Kept {
    antiderivative: Antiderivative,
    whole: Number,
}

/// A wave on one cell: its series, with its integrals once they have been asked for.
///
/// # Invariants
/// The series and the length never change, and all series of a history are cut off in one way: what is
/// kept stays true.
#[derive(Debug)]
pub(crate) struct Wave {
    series: Series,
    length: Number,
    /// By [`Integrand`].
    kept: [OnceCell<Kept>; 3],
}

/// Which integral of a wave is meant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Integrand {
    /// `∫ w dt`.
    Wave,
    /// `∫ w² dt`.
    Square,
    /// The same with few digits: for bounds.
    RoughSquare,
}

/// The precision of what is worked out roughly.
const ROUGH_BITS: u64 = 64;

impl Antiderivative {
    fn value(&self, x: &Number, cut: &Truncation) -> Number {
        match self {
            Antiderivative::Wave(series) => series.value(x, cut),
            Antiderivative::Square(energy) => energy.value(x),
        }
    }
}

impl Wave {
    /// A wave on a cell of this length.
    pub fn new(series: Series, length: Number) -> Wave {
        Wave { series, length, kept: Default::default() }
    }

    /// The series.
    pub fn series(&self) -> &Series {
        &self.series
    }

    /// The antiderivative; of a rough square that of the polynomial with so few terms as tell it roughly, of
    /// an exact one all of it.
    fn kept(&self, integrand: Integrand, cut: &Truncation) -> &Kept {
        let integrand = match integrand {
            Integrand::RoughSquare if self.series.is_exact() => Integrand::Square,
            own => own,
        };
        self.kept[integrand as usize].get_or_init(|| {
            let antiderivative = match integrand {
                Integrand::Wave => Antiderivative::Wave(self.series.integral(Number::zero(), cut)),
                Integrand::Square => Antiderivative::Square(self.series.energy(cut)),
                Integrand::RoughSquare => {
                    let rough = Truncation { bits: ROUGH_BITS, ..*cut };
                    let norm = CellNorm::new(self.length.magnitude(), &rough);
                    Antiderivative::Square(self.series.bare(&norm, &rough).energy(&rough))
                }
            };
            let whole = antiderivative.value(&self.length, cut);
            Kept { antiderivative, whole }
        })
    }

    /// An integral from the start of the cell to a time after it.
    pub fn until(&self, integrand: Integrand, time: &Number, cut: &Truncation) -> Number {
        self.kept(integrand, cut).antiderivative.value(time, cut)
    }

    /// An integral over the whole cell.
    pub fn whole(&self, integrand: Integrand, cut: &Truncation) -> &Number {
        &self.kept(integrand, cut).whole
    }
}

#[cfg(test)]
pub(in crate::history) mod tests {
    use super::*;
    use crate::ball::Ball;
    use num_traits::Signed as _;
    use proptest::prelude::*;
    use wavestep_polynomial::Rational;

    fn rational(numerator: i64, denominator: i64) -> Rational {
        Rational::new(numerator.into(), denominator.into())
    }

    /// `∫_0^x f²` by its definition, each time anew: all products of coefficients that are kept. With
    /// `f = P + R`, `|R| ≤ ε`, the other part is at most `x (2 ε |P| + ε²)`.
    pub(in crate::history) fn direct_energy(f: &Series, x: &Number, cut: &Truncation) -> Number {
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
    pub(in crate::history) fn exponentials(
        terms: &[(Rational, Rational)],
        cut: &Truncation,
    ) -> Series {
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
    pub(in crate::history) fn truncation(bits: u64, rate: i64) -> Truncation {
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
            // Up to two bits: the order of roundings differs.
            let allowed = direct.ball(128).radius().scale(2);
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
}
