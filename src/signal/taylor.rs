//! Taylor polynomials in balls, with a proven bound on what is left out.
//!
//! An exponential polynomial is expanded about a point, in `u` with `x = x₀ + hu`:
//!
//! ```text
//! P(x₀ + hu) = Σ_m d_m (hu)^m/m!,   d_m = Σ_j c_{j+m} x₀^j/j!
//! ```
//!
//! times `e^{λx₀} e^{λhu}`. What is left out beyond M terms is bounded for all `|u| ≤ 1`:
//!
//! - of the polynomial, with `N = j + m` and any `0 < θ ≤ 1`,
//!   `Σ_{m≥M} |h|^m/m! Σ_j |c_{j+m}| |x₀|^j/j! = Σ_N |c_N|/N! Σ_{m≥M} C(N,m) |h|^m |x₀|^{N−m}
//!   ≤ θ^M Σ_{N≥M} |c_N|/N! (|x₀| + |h|/θ)^N`;
//! - of the exponential, with `η = |λh| ≤ (M+1)/2`, `Σ_{m≥M} η^m/m! ≤ 2 η^M/M!`; where η is larger no term is kept,
//!   and all of it is at most `e^η`;
//! - of the product, what either leaves out times a bound of the other, and the terms of too high a
//!   degree.

use crate::ball::{Ball, ComplexBall, Magnitude};
use crate::enclosure::{EnclosureError, Numbers, real_part};
use crate::expression::{Field as _, Fraction, Transform};
use crate::signal::error::Outcome;
use crate::signal::transforms::{divided_powers, dot, exponential};
use std::collections::BTreeMap;
use wavestep_polynomial::Rational;

/// The powers of two that are tried for `1/θ`.
const TAIL_SHIFTS: [i64; 5] = [1, 2, 3, 4, 6];

/// A remainder as a power of two that tells nothing.
const WIDE: i64 = 1 << 20;

/// Divides a polynomial by `x − a` again and again, where `step(c, d) = c + a d`: what is left are its
/// coefficients at `a`.
pub(crate) fn divide<V>(coefficients: &mut [V], step: impl Fn(&V, &V) -> V) {
    divide_often(coefficients, coefficients.len(), step);
}

/// The same so many times, where `p = Σ_{j<m} c_j (x − a)^j + (x − a)^m Q`: after `c_j`, the coefficients of `Q` in `x`
/// are left.
pub(crate) fn divide_often<V>(coefficients: &mut [V], times: usize, step: impl Fn(&V, &V) -> V) {
    for first in 0..times.min(coefficients.len()) {
        for k in (first..coefficients.len().saturating_sub(1)).rev() {
            coefficients[k] = step(&coefficients[k], &coefficients[k + 1]);
        }
    }
}

/// Which polynomial is asked for, of a function or one of its derivatives.
#[derive(Clone, Copy)]
pub struct Near<'a> {
    /// How often the function is differentiated.
    pub order: usize,
    /// The middle `m` and half the length `h` of a cell: the polynomial is that at `m + hu` for `−1 ≤ u ≤ 1`.
    pub place: (&'a Rational, &'a Rational),
    /// The number of its coefficients.
    pub terms: usize,
    /// The precision of these in bits.
    pub bits: u64,
}

/// `|f − Σ_m c_m u^m| ≤ remainder` for `|u| ≤ 1`.
///
/// # Invariants
/// - holds for one choice of points in the balls `c_m`.
#[derive(Clone, Debug, PartialEq)]
pub struct Taylor<V = Ball> {
    /// `c_0, c_1, …`
    pub coefficients: Vec<V>,
    /// What is left out.
    pub remainder: Magnitude,
}

impl<V> Taylor<V> {
    /// A polynomial, of which nothing is left out.
    pub(crate) fn polynomial(coefficients: Vec<V>) -> Self {
        Taylor { coefficients, remainder: Magnitude::ZERO }
    }
}

impl Taylor<ComplexBall> {
    /// The function 0.
    pub(crate) fn zero(terms: usize) -> Self {
        Taylor::polynomial(vec![ComplexBall::zero(); terms])
    }

    /// `f(x₀ + hu)`, with so many terms. O(terms · degree) operations.
    pub fn of(
        function: &Transform<ComplexBall>,
        x: &ComplexBall,
        h: &ComplexBall,
        terms: usize,
        numbers: &Numbers,
        bits: u64,
    ) -> Outcome<Self> {
        let weight = Ball::zero();
        let mut expansion = Expansion::new((h, &weight), terms, numbers, bits);
        expansion.add(function, x, &ComplexBall::one());
        expansion.sum()
    }

    /// With a remainder that tells nothing.
    fn unknown(self) -> Self {
        Taylor { remainder: Magnitude::power_of_two(WIDE), ..self }
    }

    /// Adds `factor · other`.
    pub(crate) fn add_scaled(&mut self, other: &Self, factor: &ComplexBall, bits: u64) {
        for (sum, coefficient) in self.coefficients.iter_mut().zip(&other.coefficients) {
            *sum = sum.add(&coefficient.multiply(factor, bits), bits);
        }
        self.remainder = self.remainder.add(&other.remainder.multiply(&factor.magnitude()));
    }

    /// Times `e^(ru)`.
    fn times_exponential(self, rate: &ComplexBall, bits: u64) -> Self {
        let terms = self.coefficients.len();
        let eta = rate.magnitude();
        if eta.scale(1) > Magnitude::from_u64(terms as u64 + 1) {
            // Too few terms for this width.
            return match of_exponential(&eta) {
                None => self.unknown(),
                Some(most) => {
                    let sizes = self.coefficients.iter().map(ComplexBall::magnitude);
                    let whole = sizes.fold(self.remainder, |sum, size| sum.add(&size));
                    let remainder = whole.multiply(&most);
                    Taylor { remainder, ..Taylor::zero(terms) }
                }
            };
        }
        let series = divided_powers(rate, terms, bits);
        let rest = (1..=terms as u64)
            .fold(Magnitude::power_of_two(1), |rest, m| rest.multiply(&eta).divide(m));
        let mut coefficients = Vec::with_capacity(terms);
        for k in 0..terms {
            let pairs = self.coefficients[..=k].iter().zip(series[..=k].iter().rev());
            coefficients.push(ComplexBall::sum_of_products(pairs, bits));
        }
        // above[i]: the sum of |e_j| from j = terms − i on, the rest included.
        let mut above = vec![rest];
        for term in series.iter().rev() {
            above.push(above[above.len() - 1].add(&term.magnitude()));
        }
        let products = self.coefficients.iter().zip(&above).map(|(c, a)| c.magnitude().multiply(a));
        let products = products.fold(Magnitude::ZERO, |sum, product| sum.add(&product));
        let whole = &above[terms];
        let remainder = products.add(&self.remainder.multiply(whole));
        Taylor { coefficients, remainder }
    }

    /// The real part of a real function.
    pub fn real(self) -> Result<Taylor, EnclosureError> {
        let real: Result<_, _> = self.coefficients.into_iter().map(real_part).collect();
        Ok(Taylor { coefficients: real?, remainder: self.remainder })
    }
}

/// `e^(−wu) Σ f(x₀ + hu)` with a weight `w`: of functions about places of their own, added up pole by pole, so that
/// each exponential is multiplied out once.
pub struct Expansion<'a> {
    h: &'a ComplexBall,
    weight: &'a Ball,
    terms: usize,
    numbers: &'a Numbers,
    bits: u64,
    /// `h^m/m!`.
    scales: Vec<ComplexBall>,
    /// What each exponential is multiplied with.
    polynomials: BTreeMap<Fraction, Taylor<ComplexBall>>,
}

impl<'a> Expansion<'a> {
    /// Of nothing yet, with so many terms.
    pub fn new(
        (h, weight): (&'a ComplexBall, &'a Ball),
        terms: usize,
        numbers: &'a Numbers,
        bits: u64,
    ) -> Self {
        let scales = divided_powers(h, terms, bits);
        let polynomials = BTreeMap::new();
        Expansion { h, weight, terms, numbers, bits, scales, polynomials }
    }

    /// Adds `factor · f(x + hu)`.
    pub fn add(
        &mut self,
        function: &Transform<ComplexBall>,
        x: &ComplexBall,
        factor: &ComplexBall,
    ) {
        let (terms, bits) = (self.terms, self.bits);
        for (pole, coefficients) in function.poles() {
            let part = polynomial(coefficients, x, &self.scales, self.h, bits);
            let own = self.polynomials.entry(pole.clone()).or_insert_with(|| Taylor::zero(terms));
            match exponential(pole, x, self.numbers, bits) {
                Ok(size) => own.add_scaled(&part, &size.multiply(factor, bits), bits),
                // Beyond what balls hold.
                Err(_) => own.remainder = Magnitude::power_of_two(WIDE),
            }
        }
    }

    /// The sum of all that was added.
    pub fn sum(self) -> Outcome<Taylor<ComplexBall>> {
        let (field, bits) = (self.numbers.field(self.bits), self.bits);
        let weight = ComplexBall::from(self.weight.clone().negate());
        let mut sum = Taylor::zero(self.terms);
        for (pole, part) in self.polynomials {
            let rate = field.embed(&pole.into())?.multiply(self.h, bits).add(&weight, bits);
            let part = match rate.magnitude().is_zero() {
                true => part,
                false => part.times_exponential(&rate, bits),
            };
            sum.add_scaled(&part, &ComplexBall::one(), bits);
        }
        Ok(sum)
    }
}

/// A power of two above `e^η`; none where its exponent is too long.
pub(crate) fn of_exponential(eta: &Magnitude) -> Option<Magnitude> {
    // 1/ln 2 = 1.44269…
    let exponent = (Rational::from(eta) * Rational::new(1443.into(), 1000.into())).ceil();
    let exponent = i32::try_from(exponent.to_integer()).ok()?;
    Some(Magnitude::power_of_two(exponent.into()))
}

/// `P(x₀ + hu)` with `P = Σ_j c_j x^j/j!`; `scales` are `h^m/m!`.
fn polynomial(
    coefficients: &[ComplexBall],
    x: &ComplexBall,
    scales: &[ComplexBall],
    h: &ComplexBall,
    bits: u64,
) -> Taylor<ComplexBall> {
    let powers = divided_powers(x, coefficients.len(), bits);
    let term = |(m, scale): (usize, &ComplexBall)| match coefficients.get(m..) {
        Some(rest) => dot(rest, &powers, bits).multiply(scale, bits),
        None => ComplexBall::zero(),
    };
    let remainder = tail(coefficients, &x.magnitude(), &h.magnitude(), scales.len());
    Taylor { coefficients: scales.iter().enumerate().map(term).collect(), remainder }
}

/// `min_θ θ^M Σ_{N≥M} |c_N|/N! (|x| + |h|/θ)^N`.
fn tail(coefficients: &[ComplexBall], x: &Magnitude, h: &Magnitude, terms: usize) -> Magnitude {
    if coefficients.len() <= terms {
        return Magnitude::ZERO;
    }
    let bound = |shift: i64| {
        let base = x.add(&h.scale(shift));
        let mut power = Magnitude::power_of_two(-shift * terms as i64);
        let mut sum = Magnitude::ZERO;
        for (order, coefficient) in coefficients.iter().enumerate() {
            if order >= terms {
                sum = sum.add(&coefficient.magnitude().multiply(&power));
            }
            power = power.multiply(&base).divide(order as u64 + 1);
        }
        sum
    };
    // Where h is tiny, h/θ as large as x is about the best.
    let level = x.top().zip(h.top()).map(|(x, h)| x - h).filter(|shift| *shift > 0);
    TAIL_SHIFTS.into_iter().chain(level).map(bound).min().expect("some are tried")
}

impl Taylor {
    /// The product, with as many terms as the longer factor has: what either leaves out times all of the
    /// other, and the products of terms of too high a degree, are the remainder.
    pub(crate) fn multiply(&self, other: &Taylor, bits: u64) -> Taylor {
        let terms = self.coefficients.len().max(other.coefficients.len());
        let (own, others) = (&self.coefficients[..], &other.coefficients[..]);
        let coefficients = Ball::product_of_polynomials(own, others, terms, bits);
        // What the coefficients from each on come to.
        let mut tails = vec![Magnitude::ZERO; terms + 1];
        for (j, c) in others.iter().enumerate().rev() {
            tails[j] = tails[j + 1].add(&c.magnitude());
        }
        let mut remainder = self.tail(0).multiply(&other.remainder);
        remainder = remainder.add(&self.remainder.multiply(&tails[0].add(&other.remainder)));
        for (i, c) in own.iter().enumerate() {
            remainder = remainder.add(&c.magnitude().multiply(&tails[terms - i]));
        }
        Taylor { coefficients, remainder }
    }

    /// `∫_0^u p`, with one more term. The remainder is the same, since `|u| ≤ 1`.
    pub(crate) fn antiderivative(mut self, bits: u64) -> Taylor {
        for (k, c) in self.coefficients.iter_mut().enumerate() {
            *c = c.over(k as u64 + 1, bits);
        }
        self.coefficients.insert(0, Ball::zero());
        self
    }

    /// The same function where `u` is known but for an error of this size.
    pub(crate) fn blurred(mut self, by: &Magnitude) -> Taylor {
        let slopes = self.coefficients.iter().enumerate();
        let slope = slopes.fold(Magnitude::ZERO, |sum, (k, c)| {
            sum.add(&c.magnitude().multiply(&Magnitude::from_u64(k as u64)))
        });
        self.remainder = self.remainder.add(&slope.multiply(by));
        self
    }

    /// Times a number.
    pub(crate) fn scaled(mut self, factor: &Ball, bits: u64) -> Taylor {
        for coefficient in &mut self.coefficients {
            *coefficient = coefficient.multiply(factor, bits);
        }
        self.remainder = self.remainder.multiply(&factor.magnitude());
        self
    }

    /// An enclosure of the function at all `u` of a ball within `|u| ≤ 1`.
    pub fn value(&self, u: &Ball, bits: u64) -> Ball {
        let horner = |value: Ball, c: &Ball| value.multiply(u, bits).add(c, bits);
        let value = self.coefficients.iter().rev().fold(Ball::zero(), horner);
        value.widened(&self.remainder)
    }

    /// `c_0 ± Σ_{k≥1} |c_k| ± R`: all values.
    pub(crate) fn range(&self) -> Ball {
        self.coefficient(0).widened(&self.tail(1))
    }

    /// `c_k`, zero where there is none.
    pub fn coefficient(&self, k: usize) -> Ball {
        self.coefficients.get(k).cloned().unwrap_or_else(Ball::zero)
    }

    /// A bound on what the terms from the `m`-th on, and what is left out, add up to.
    pub(crate) fn tail(&self, m: usize) -> Magnitude {
        let terms = self.coefficients.iter().skip(m).map(Ball::magnitude);
        terms.fold(self.remainder, |sum, term| sum.add(&term))
    }

    /// About what Horner's scheme loses in doubles: `2^−53 Σ_k T_k` for products and sums, with
    /// `T_k = Σ_{j≥k} |c_j|`.
    pub(crate) fn rounding(&self) -> Magnitude {
        let mut tail = Magnitude::ZERO;
        let mut sum = Magnitude::ZERO;
        for coefficient in self.coefficients.iter().rev() {
            tail = tail.add(&coefficient.magnitude());
            sum = sum.add(&tail.scale(1));
        }
        // The constant is not multiplied any more.
        let twice = sum.to_double() - tail.to_double();
        Magnitude::from_double(twice).scale(-53)
    }

    /// In units `by` times as long: `c_m ← c_m by^m`. The remainder holds where it did, for
    /// `|u| ≤ 1/by`.
    pub(crate) fn stretch(&mut self, by: &Rational, bits: u64) {
        let mut power = Ball::from_integer(&1.into());
        for coefficient in &mut self.coefficients {
            *coefficient = coefficient.multiply(&power, bits);
            power = power.multiply_rational(by, bits);
        }
    }

    /// `p(a + bu)` for numbers `|a| + |b| ≤ 1`, exactly those points: the function on a part of where
    /// it is known. O(terms²) operations.
    pub(crate) fn part(&self, a: &Rational, b: &Rational, bits: u64) -> Taylor {
        self.first_terms_of_part(a, b, self.coefficients.len(), bits)
    }

    /// The same with so many terms at most, the others in the remainder: `|b|^m Σ |q_k|` for a quotient `Q`.
    pub(crate) fn first_terms_of_part(
        &self,
        a: &Rational,
        b: &Rational,
        terms: usize,
        bits: u64,
    ) -> Taylor {
        let mut coefficients = self.coefficients.clone();
        let [a, scale] = [a, b].map(|number| Ball::from_rational(number, bits));
        divide_often(&mut coefficients, terms, |c, next| c.add(&next.multiply(&a, bits), bits));
        let quotient = coefficients.split_off(terms.min(coefficients.len()));
        let mut power = Ball::from_integer(&1.into());
        for coefficient in &mut coefficients {
            *coefficient = coefficient.multiply(&power, bits);
            power = power.multiply(&scale, bits);
        }
        let size = quotient.iter().fold(Magnitude::ZERO, |sum, q| sum.add(&q.magnitude()));
        let remainder = self.remainder.add(&size.multiply(&power.magnitude()));
        Taylor { coefficients, remainder }
    }
}
