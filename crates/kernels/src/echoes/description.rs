//! What a wave made of echoes is: which functions, how fast they decay, when they arrive.

use super::LARGEST_LAG;
use super::error::EchoError;
use super::expansion::Expansion;
use crate::double_double::DoubleDouble;

/// The polynomials `q_j` that echoes are made of; those of negative index are 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Family {
    /// The Laguerre polynomials `L_j(X) = Σ_i C(j,i) (−X)^i / i!`: a reflection `((p−a)/(p+b))^k`
    /// with `a + b ≠ 0`.
    Laguerre,
    /// The divided powers `X^j / j!`: a reflection `(1/(p+b))^k`.
    Powers,
}

/// One term `coefficient · q_{k−lag}(cx)` of every echo `k`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Term {
    /// By how much the index of the polynomial is below that of the echo.
    pub lag: isize,
    /// The factor.
    pub coefficient: Expansion,
}

/// `e^{−rate·x} Σ_j coefficients[j] x^j`: a part of an echo that does not follow the rule.
#[derive(Clone, PartialEq, Debug)]
pub struct ExponentialPolynomial {
    /// How fast it decays.
    pub rate: Expansion,
    /// The coefficients, the constant first.
    pub coefficients: Vec<Expansion>,
}

/// A wave that is a sum of echoes of one real pole,
/// `f(T) = Σ_{k: kD ≤ T} φ_k(T − kD)` with `φ_k(x) = ρ^k e^{−bx} Σ_i c_i q_{k−i}(cx)`.
///
/// `q` is the [`Family`], `b` the rate, `c` the scale, `ρ` the ratio, `D` the period, and the lags
/// `i` may be negative. Echoes that do not follow the rule stand first, in closed form. Time, and
/// with it `1/b`, `1/c` and `D`, is in any one unit.
///
/// # Invariants
/// - the period is positive;
/// - numbers that are not 0 lie between `2^−200` and `2^201`, so that products of them are exact
///   sums of doubles;
/// - terms stand in order of falling lag, one a lag, and no lag is beyond 1024.
#[derive(Clone, PartialEq, Debug)]
pub struct Echoes {
    pub(super) family: Family,
    pub(super) rate: Expansion,
    pub(super) scale: Expansion,
    pub(super) ratio: Expansion,
    pub(super) terms: Vec<Term>,
    pub(super) first: Vec<Vec<ExponentialPolynomial>>,
    pub(super) period: Expansion,
}

impl Echoes {
    /// Echoes that all follow the rule: `rate` is `b`, `scale` is `c`, `ratio` is `ρ`.
    pub fn new(
        family: Family,
        rate: Expansion,
        scale: Expansion,
        ratio: Expansion,
        terms: &[Term],
        period: Expansion,
    ) -> Result<Echoes, EchoError> {
        if !period.is_positive() {
            return Err(EchoError::PeriodNotPositive);
        }
        let coefficients = terms.iter().map(|term| term.coefficient);
        if ![rate, scale, ratio, period].into_iter().chain(coefficients).all(Expansion::is_moderate)
        {
            return Err(EchoError::BeyondRange);
        }
        let mut own: Vec<Term> = Vec::with_capacity(terms.len());
        for &term in terms {
            if term.lag.unsigned_abs() > LARGEST_LAG {
                return Err(EchoError::LagTooLarge { lag: term.lag });
            }
            match own.iter_mut().find(|known| known.lag == term.lag) {
                Some(known) => known.coefficient = known.coefficient.plus(term.coefficient),
                None => own.push(term),
            }
        }
        own.sort_by_key(|term| std::cmp::Reverse(term.lag));
        Ok(Echoes { family, rate, scale, ratio, terms: own, first: Vec::new(), period })
    }

    /// The same wave, whose echoes `0, 1, …` are the sums given instead of what the rule says.
    pub fn with_first(
        mut self,
        first: Vec<Vec<ExponentialPolynomial>>,
    ) -> Result<Echoes, EchoError> {
        let is_moderate = |part: &ExponentialPolynomial| {
            part.rate.is_moderate() && part.coefficients.iter().all(|number| number.is_moderate())
        };
        if !first.iter().flatten().all(is_moderate) {
            return Err(EchoError::BeyondRange);
        }
        self.first = first;
        Ok(self)
    }

    /// The larger of `|b|` and `|c|`, and of the rates of the first echoes.
    pub(super) fn fastest(&self) -> f64 {
        let rates = self.first.iter().flatten().map(|part| part.rate);
        let all = rates.chain([self.rate, self.scale]);
        all.fold(0.0, |most, rate| rate.high().abs().max(most))
    }

    /// The largest index that echo `k` asks for, if it asks for any.
    pub(super) fn largest_index(&self, k: usize) -> Option<usize> {
        k.checked_add_signed(-self.terms.last()?.lag)
    }

    /// `ρ^k` as a pair times a power of two, `k = 0 … last`; relative error at most `k·2^−102`.
    pub(super) fn ratios(&self, last: usize) -> Vec<(DoubleDouble, i64)> {
        let mut power = (DoubleDouble::ONE, 0i64);
        let mut powers = Vec::with_capacity(last + 1);
        for _ in 0..=last {
            powers.push(power);
            let next = power.0 * self.ratio.pair();
            let exponent = crate::exponent::split(next.high).1;
            power = (next.scaled(-exponent), power.1 + exponent);
        }
        powers
    }
}
