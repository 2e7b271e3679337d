//! A function of time on one cell: its Taylor series at the start of the cell.
//!
//! Between two arrivals every signal is a sum of polynomials times exponentials, so its series
//! converges everywhere. The first coefficients are kept as numbers; the others are bounded together by
//! the series of an exponential, a bound that integration, shifts and linear differential equations
//! keep.

use crate::ball::{Magnitude, Number};

/// How series are cut off.
///
/// # Invariants
/// `rate` is a positive power of two, at least four times the norm of every node and as large as every
/// rate of a load; cells are so short that `rate · h ≤ 4`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Truncation {
    /// The precision of balls.
    pub bits: u64,
    /// How many coefficients are kept: those of `x⁰ … x^(order−1)`.
    pub order: usize,
    /// `log₂ γ`, the rate of the bound.
    pub rate: i64,
}

/// What `rate · h` is at most, as a power of two.
pub(crate) const LONGEST_CELL: i64 = 2;

impl Truncation {
    /// Such that `4^N/N!` is below `2^(−bits−96)`: the 96 bits are room for bounds that grow from cell
    /// to cell.
    pub fn new(bits: u64, rate: i64) -> Truncation {
        let (mut order, mut size) = (1_usize, 0.0);
        while size > -((bits + 96) as f64) {
            size += 2.0 - (order as f64).log2();
            order += 1;
        }
        Truncation { bits, order, rate }
    }

    /// What a coefficient of `x^N` needs as the factor of the bound: `|c| N!/γ^N`, rounded upwards.
    pub fn factor(&self, coefficient: &Magnitude) -> Magnitude {
        let mut factor = coefficient.scale(-self.rate * self.order as i64);
        for j in 2..=self.order as u64 {
            factor = factor.multiply(&Magnitude::from_u64(j));
        }
        factor
    }

    /// `Σ_{k≥N} |c_k| y^k` for all `y ≤ x`, where `|c_k| ≤ rest · γ^k/k!`, rounded upwards.
    pub fn remainder(&self, rest: &Magnitude, x: &Magnitude) -> Magnitude {
        match rest.is_zero() {
            true => Magnitude::ZERO,
            false => rest.multiply(&self.tail(self.order, x)),
        }
    }

    /// `Σ_{i≥n} z^i/i! ≤ z^n/n! · e^z`, with `z = γ x ≤ 4·2` and `e^z ≤ 2^(2z)`.
    fn tail(&self, n: usize, x: &Magnitude) -> Magnitude {
        self.tails(x).nth(n).expect("one for each number")
    }

    /// These bounds for `n = 0, 1, …`.
    fn tails(&self, x: &Magnitude) -> impl Iterator<Item = Magnitude> {
        let z = x.scale(self.rate);
        let next =
            move |(power, j): &(Magnitude, u64)| Some((power.multiply(&z).divide(*j), j + 1));
        std::iter::successors(Some((growth(&z), 1)), next).map(|(power, _)| power)
    }
}

/// A bound of `e^z`: `e ≤ 2^(3/2)`, so that `e^z ≤ 2^⌈3z/2⌉`.
fn growth(z: &Magnitude) -> Magnitude {
    let halves = z.multiply(&Magnitude::from_u64(3)).scale(-1);
    let Some(top) = halves.top() else { return Magnitude::power_of_two(0) };
    // Arguments are a few units; the bound below holds for all.
    let exponent = if top <= 0 { 1 } else { 1_i64 << top.min(40) };
    Magnitude::power_of_two(exponent)
}

/// A function `f(x) = Σ c_k x^k` on `0 ≤ x ≤ h`, the length of its cell.
///
/// # Invariants
/// - `coefficients` hold `c_0 … c_(N−1)`, those left out at the end being zero;
/// - `|c_k| ≤ rest · γ^k/k!` for all `k ≥ N`.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Series {
    pub coefficients: Vec<Number>,
    pub rest: Magnitude,
}

impl Series {
    /// A constant.
    pub fn constant(value: Number) -> Series {
        Series::new(vec![value], Magnitude::ZERO)
    }

    /// The series of these coefficients, and of others so bounded.
    pub fn new(mut coefficients: Vec<Number>, rest: Magnitude) -> Series {
        while coefficients.last().is_some_and(Number::is_zero) {
            coefficients.pop();
        }
        Series { coefficients, rest }
    }

    pub fn zero() -> Series {
        Series { coefficients: Vec::new(), rest: Magnitude::ZERO }
    }

    /// Whether it is known to be zero.
    pub fn is_zero(&self) -> bool {
        self.coefficients.is_empty() && self.rest.is_zero()
    }

    /// Whether it is a polynomial with rational coefficients.
    pub fn is_exact(&self) -> bool {
        self.rest.is_zero() && self.coefficients.iter().all(|c| c.exact().is_some())
    }

    /// Whether it is known to be constant.
    pub fn is_constant(&self) -> bool {
        self.coefficients.len() <= 1 && self.rest.is_zero()
    }

    /// `c_k`, for `k < N`.
    pub fn coefficient(&self, k: usize) -> Number {
        self.coefficients.get(k).cloned().unwrap_or_else(Number::zero)
    }

    /// `a f + b g`.
    pub fn combine(&self, a: &Number, other: &Series, b: &Number, bits: u64) -> Series {
        let length = self.coefficients.len().max(other.coefficients.len());
        let term = |k| {
            let own = self.coefficient(k).multiply(a, bits);
            own.add(&other.coefficient(k).multiply(b, bits), bits)
        };
        let rest = self.rest.multiply(&a.magnitude()).add(&other.rest.multiply(&b.magnitude()));
        Series::new((0..length).map(term).collect(), rest)
    }

    pub fn add(&self, other: &Series, bits: u64) -> Series {
        self.combine(&Number::one(), other, &Number::one(), bits)
    }

    pub fn subtract(&self, other: &Series, bits: u64) -> Series {
        self.combine(&Number::one(), other, &Number::integer(-1), bits)
    }

    /// The series at `a ≥ 0`: `f(a + x)`.
    ///
    /// `c'_j = Σ_k C(k,j) a^(k−j) c_k`; what the terms with `k ≥ N` add is at most
    /// `rest · γ^j/j! · Σ_{i ≥ N−j} (γa)^i/i!`, for `j ≥ N` with the whole `e^(γa)` as the sum.
    pub fn shift(&self, a: &Number, cut: &Truncation) -> Series {
        if a.is_zero() {
            return self.clone();
        }
        let bits = cut.bits;
        let mut shifted = self.coefficients.clone();
        let exact = a.exact().is_some() && self.is_exact() && shifted.len() <= 4;
        let step = if exact { a.clone() } else { a.enclosed(bits) };
        if !exact {
            shifted.iter_mut().for_each(|c| *c = c.enclosed(bits));
        }
        for first in 0..shifted.len() {
            for k in (first..shifted.len().saturating_sub(1)).rev() {
                shifted[k] = shifted[k].add(&shifted[k + 1].multiply(&step, bits), bits);
            }
        }
        if self.rest.is_zero() {
            return Series::new(shifted, Magnitude::ZERO);
        }
        let a = a.magnitude();
        shifted.resize(cut.order, Number::zero());
        // γ^j/j! · tail(N − j), the first from j to j + 1, the second backwards.
        let mut own = Magnitude::power_of_two(0);
        let tails: Vec<Magnitude> = cut.tails(&a).skip(1).take(cut.order).collect();
        for (j, (c, tail)) in shifted.iter_mut().zip(tails.iter().rev()).enumerate() {
            let sum = own.multiply(tail);
            *c = c.widened(&sum.multiply(&self.rest), bits);
            own = own.scale(cut.rate).divide(j as u64 + 1);
        }
        Series::new(shifted, self.rest.multiply(&growth(&a.scale(cut.rate))))
    }

    /// The first coefficients of a polynomial in `ξ`, and a bound of its distance from `f(a + ξ)` for all
    /// `|ξ| ≤ h`.
    ///
    /// After `m` divisions by `x − a` the polynomial that is kept is `Σ_{j<m} c'_j ξ^j + ξ^m Q(x)`, with
    /// `|Q(x)| ≤ Σ |q_k| (|a| + h)^k`.
    pub fn about(
        &self,
        a: &Number,
        h: &Magnitude,
        terms: usize,
        cut: &Truncation,
    ) -> (Vec<Number>, Magnitude) {
        let mut shifted = self.coefficients.clone();
        let length = shifted.len();
        for first in 0..terms.min(length) {
            for k in (first..length - 1).rev() {
                shifted[k] = shifted[k].add(&shifted[k + 1].multiply(a, cut.bits), cut.bits);
            }
        }
        let reach = a.magnitude().add(h);
        let mut rest = Magnitude::ZERO;
        for q in shifted.iter().skip(terms).rev() {
            rest = rest.multiply(&reach).add(&q.magnitude());
        }
        let rest = (0..terms).fold(rest, |rest, _| rest.multiply(h));
        shifted.resize(terms, Number::zero());
        (shifted, rest.add(&self.remainder(&reach, cut)))
    }

    /// `f(x)` for `0 ≤ x`, `γ x ≤ 8`.
    pub fn value(&self, x: &Number, cut: &Truncation) -> Number {
        let mut sum = Number::zero();
        for c in self.coefficients.iter().rev() {
            sum = sum.multiply(x, cut.bits).add(c, cut.bits);
        }
        sum.widened(&self.remainder(&x.magnitude(), cut), cut.bits)
    }

    /// What the terms from `x^N` on add to the value at most, at all points up to `x`.
    pub fn remainder(&self, x: &Magnitude, cut: &Truncation) -> Magnitude {
        cut.remainder(&self.rest, x)
    }

    /// A bound of `|Σ_{k≥n} c_k ξ^(k−n)|` for `|ξ| ≤ w`.
    pub fn size_from(&self, n: usize, w: &Magnitude, cut: &Truncation) -> Magnitude {
        let mut sum = Magnitude::ZERO;
        for c in self.coefficients.iter().skip(n).rev() {
            sum = sum.multiply(w).add(&c.magnitude());
        }
        // Σ_{k≥N} γ^k w^(k−n)/k! ≤ γ^n Σ_{k≥N} (γw)^(k−n)/(k−n)!.
        match self.rest.is_zero() {
            true => sum,
            false => {
                let tail = cut.tail(cut.order.saturating_sub(n), w).scale(cut.rate * n as i64);
                sum.add(&self.rest.multiply(&tail))
            }
        }
    }

    /// `start + ∫_0^x f`: `c_(k−1)/k`, and `rest/γ` for the bound, by
    /// `(γ^k/k!)/(k+1) = γ^(k+1)/(k+1)!/γ`.
    pub fn integral(&self, start: Number, cut: &Truncation) -> Series {
        let mut coefficients = vec![start];
        for (k, c) in self.coefficients.iter().enumerate() {
            coefficients.push(c.over(k as u64 + 1, cut.bits));
        }
        let mut rest = self.rest.scale(-cut.rate);
        if let Some(last) = coefficients.get(cut.order) {
            rest = rest.max(cut.factor(&last.magnitude()));
            coefficients.truncate(cut.order);
        }
        Series::new(coefficients, rest)
    }

    /// `f'`: `(k + 1) c_(k+1)`, and `γ · rest` for the bound, by `(k + 1) γ^(k+1)/(k+1)! = γ · γ^k/k!`. Of
    /// `N c_N`, the last one that is kept, that bound is all that is known.
    pub fn derivative(&self, cut: &Truncation) -> Series {
        let rest = self.rest.scale(cut.rate);
        let kept = self.coefficients.iter().enumerate().skip(1);
        let mut coefficients: Vec<Number> =
            kept.map(|(k, c)| c.multiply(&Number::integer(k as i64), cut.bits)).collect();
        if !rest.is_zero() {
            let last = cut.order - 1;
            coefficients.resize(last, Number::zero());
            let mut bound = rest.scale(cut.rate * last as i64);
            (2..=last as u64).for_each(|i| bound = bound.divide(i));
            coefficients.push(Number::zero().widened(&bound, cut.bits));
        }
        Series::new(coefficients, rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use wavestep_polynomial::Rational;

    fn rational(numerator: i64, denominator: i64) -> Rational {
        Rational::new(numerator.into(), denominator.into())
    }

    /// `e^{−x}` and its bound, with N terms.
    fn decay(cut: &Truncation) -> Series {
        let mut coefficients = vec![Number::Enclosed(Ball::from_rational(&rational(1, 1), 9))];
        for k in 1..cut.order as u64 {
            let next = coefficients[k as usize - 1].negate().over(k, cut.bits);
            coefficients.push(next);
        }
        let next = coefficients[cut.order - 1].over(cut.order as u64, cut.bits);
        Series::new(coefficients, cut.factor(&next.magnitude()))
    }

    fn exponential(x: &Rational) -> Ball {
        Ball::from_rational(&-x, 900).exp(900).unwrap()
    }

    fn encloses(wide: &Number, narrow: &Ball, bits: i64) -> bool {
        let difference = wide.ball(900).subtract(narrow, 900);
        let close = difference.magnitude() <= Magnitude::power_of_two(-bits);
        difference.contains_zero() && close
    }

    #[test]
    fn an_exponential_is_shifted_integrated_and_squared() {
        for rate in [2, 0, 3] {
            let cut = Truncation::new(128, rate);
            let f = decay(&cut);
            let h = Number::Exact(rational(4, 1 << rate));
            let (a, b) = (Number::Exact(rational(1, 3)), Number::Exact(rational(1, 7)));
            let sum = rational(10, 21);
            assert!(encloses(&f.value(&h, &cut), &exponential(h.exact().unwrap()), 100));
            let shifted = f.shift(&a, &cut);
            assert!(encloses(&shifted.value(&b, &cut), &exponential(&sum), 100));
            let h = Magnitude::power_of_two(-3 - rate);
            let (near, rest) = f.about(&a, &h, 9, &cut);
            let last = near[8].magnitude();
            assert!(rest <= last.multiply(&(0..8).fold(h, |power, _| power.multiply(&h))));
            for (near, shifted) in near.iter().zip(&shifted.coefficients) {
                assert_eq!(near.subtract(shifted, 256).sign(), None);
            }
            let end = Number::Exact(rational(1, 8 << rate));
            let close = Series::new(near, Magnitude::ZERO).value(&end, &cut).widened(&rest, 128);
            let far = rational(1, 3) + rational(1, 8 << rate);
            assert!(encloses(&close, &exponential(&far), 30));
            let again = shifted.shift(&b, &cut).shift(&a, &cut);
            let third = exponential(&(sum + rational(1, 3)));
            assert!(encloses(&again.value(&Number::zero(), &cut), &third, 90));
            // f' = −f, at any place and with the bound of its rest.
            let none = f.derivative(&cut).add(&f, cut.bits).value(&a, &cut).ball(900);
            assert!(none.contains_zero() && none.magnitude() < Magnitude::power_of_two(-100));
            // 1 − e^{−x} and (1 − e^{−2x})/2.
            let integral = f.integral(Number::zero(), &cut).value(&a, &cut);
            let one = Ball::from_rational(&rational(1, 1), 9);
            let expected = one.subtract(&exponential(&rational(1, 3)), 900);
            assert!(encloses(&integral, &expected, 100));
            let expected = one.subtract(&exponential(&rational(2, 3)), 900);
            let expected = expected.multiply_rational(&rational(1, 2), 900);
            assert!(encloses(&f.energy(&cut).value(&a), &expected, 100));
        }
    }

    /// The slope of e^{−x} is −e^{−x}, of two terms as well as of many; that of an integral is what was
    /// integrated.
    #[test]
    fn slopes_are_enclosed() {
        let x = rational(1, 2);
        let at = Number::Exact(x.clone());
        for rate in [2, 0, 1] {
            let cut = Truncation::new(128, rate);
            let slope = decay(&cut).derivative(&cut);
            assert!(encloses(&slope.value(&at, &cut).negate(), &exponential(&x), 100));
            let again = decay(&cut).integral(Number::one(), &cut).derivative(&cut);
            assert!(encloses(&again.value(&at, &cut), &exponential(&x), 100));
        }
        let few = Truncation { bits: 128, order: 2, rate: 1 };
        let slope = decay(&few).derivative(&few).value(&at, &few).ball(128);
        assert!(slope.add(&exponential(&x), 900).contains_zero());
        assert!(!slope.subtract(&exponential(&x), 900).contains_zero());
        let line = Series::new(vec![Number::one(), Number::integer(5)], Magnitude::ZERO);
        assert_eq!(line.derivative(&few), Series::constant(Number::integer(5)));
    }

    /// With two terms only, the bound of the rest is what encloses.
    #[test]
    fn few_terms_enclose_by_their_bound() {
        let cut = Truncation { bits: 128, order: 2, rate: 1 };
        let f = decay(&cut);
        let x = Number::Exact(rational(1, 2));
        let value = f.value(&x, &cut).ball(128);
        assert!(value.subtract(&exponential(&rational(1, 2)), 900).contains_zero());
        let shifted = f.shift(&x, &cut).value(&x, &cut).ball(128);
        assert!(shifted.subtract(&exponential(&rational(1, 1)), 900).contains_zero());
        let slope = f.derivative(&cut).value(&x, &cut).ball(128);
        assert!(slope.add(&exponential(&rational(1, 2)), 900).contains_zero());
        let size = f.size_from(1, &Magnitude::power_of_two(-1), &cut);
        // (1 − e^{−1/2})/(1/2) = 0.787
        assert!(size >= Magnitude::from_rational(&rational(787, 1000)));
    }

    #[test]
    fn polynomials_with_rational_coefficients_stay_exact() {
        let cut = Truncation::new(64, 0);
        let number = |n| Number::Exact(rational(n, 3));
        let f = Series::new(vec![number(1), number(2), number(5), Number::zero()], Magnitude::ZERO);
        assert!(f.is_exact() && f.coefficients.len() == 3);
        let value = f.shift(&number(1), &cut).value(&number(2), &cut);
        assert_eq!(value, Number::Exact(rational(8, 3)));
        assert!(f.subtract(&f, 64).is_zero());
    }
}
