//! Sums of `Re p(t) e^(μt)` over a symbol, step by step: loads and modes.

use super::Outcome;
use super::motion::TERMS;
use super::on_step::OnStep;
use super::symbol::OverSymbol;
use crate::ball::{Arithmetic as _, BallError, Magnitude};
use crate::expression::{Expression, Fraction};
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::signal::{Varying, complex_product, of_exponential};
use wavestep_polynomial::{Rational, Symbol};

/// A number with its real and its imaginary part.
type Complex = [Varying; 2];

/// `p(n) e^(μn)` of the time `n` since the start, in steps.
pub struct Exponential {
    pub rate: Complex,
    /// The coefficients of `p`, of which there are no more than [`TERMS`].
    pub polynomial: Vec<Complex>,
}

fn scaled(own: &Complex, factor: &Varying) -> Complex {
    own.each_ref().map(|part| part.multiply(factor, BITS))
}

fn size(own: &Complex) -> Magnitude {
    own[0].magnitude().add(&own[1].magnitude())
}

impl Exponential {
    /// The terms of a course, which is the sum of their real parts; `length` is how long a step takes. Of two that are
    /// conjugate one stands for both. None where a power of time is too high.
    ///
    /// # Errors
    /// As [`OverSymbol::root`]; [`NotOverSymbol::Ball`](super::NotOverSymbol::Ball) where an exponential is too large.
    pub fn all(
        course: &Expression,
        time: &Symbol,
        length: &Varying,
        symbol: &OverSymbol<'_>,
    ) -> Outcome<Option<Vec<Exponential>>> {
        let i = Symbol::square_root(-1).expect("the imaginary unit");
        let at_zero = |value: &Fraction| value.substitute(time, &Fraction::zero());
        let (mut terms, mut conjugates) = (Vec::new(), Vec::new());
        for (exponent, coefficient) in course.terms() {
            if conjugates.contains(exponent) {
                continue;
            }
            let conjugate = exponent.substitute(&i, &-&Fraction::symbol(&i))?;
            let [x, y] = symbol.complex(&at_zero(exponent)?)?;
            let mut factor = Varying::exp([&x, &y], BITS)?;
            if conjugate != *exponent {
                factor = factor.map(|part| part.add(&part, BITS));
                conjugates.push(conjugate);
            }
            let (mut polynomial, mut left) = (Vec::new(), coefficient.clone());
            while !left.is_zero() {
                if polynomial.len() == TERMS {
                    return Ok(None);
                }
                let at_start = symbol.complex(&at_zero(&left)?)?;
                polynomial.push(complex_product(&at_start, &factor, BITS));
                let count = polynomial.len() as u64;
                factor = scaled(&factor, length).map(|part| part.over(count, BITS));
                left = left.derivative(time);
            }
            let rate = scaled(&symbol.complex(&exponent.derivative(time))?, length);
            terms.push(Exponential { rate, polynomial });
        }
        Ok(Some(terms))
    }

    /// The sum of the real parts on the first steps.
    ///
    /// # Errors
    /// [`NotOverSymbol::Ball`](super::NotOverSymbol::Ball) where one is too large.
    pub fn total(all: &[Exponential], count: usize) -> Outcome<Vec<OnStep>> {
        let parts = all.iter().map(|own| own.on_steps(count)).collect::<Outcome<Vec<_>>>()?;
        let sum = |step: usize| OnStep::total(parts.iter().map(|own| &own[step]));
        Ok((0..count).map(sum).collect())
    }

    /// A bound of `|μ|` per step.
    pub fn rate(&self) -> Magnitude {
        size(&self.rate)
    }

    /// Its real part on the first steps, with `p(n + x) e^(μn) = Σ_j p_j x^j` and `e^(μx) = Σ_i (μx)^i/i!`. Of the
    /// product the powers of `x` from `N` = [`TERMS`] on are left out, `Σ_j |p_j| |μ|^(N−j)/(N−j)! e^|μ|` at most.
    fn on_steps(&self, count: usize) -> Outcome<Vec<OnStep>> {
        let rate = self.rate();
        let most = of_exponential(&rate).ok_or(BallError::ArgumentTooLarge)?;
        let mut left_out = vec![most];
        for i in 1..=TERMS as u64 {
            left_out.push(left_out[left_out.len() - 1].multiply(&rate).divide(i));
        }
        let mut series = vec![[Varying::one(), Varying::zero()]];
        let terms = if rate.is_zero() { 1 } else { TERMS };
        for i in 1..terms as u64 {
            let next = complex_product(&series[series.len() - 1], &self.rate, BITS);
            series.push(next.map(|part| part.over(i, BITS)));
        }
        (0..count).map(|step| self.on_step(step, &series, &left_out)).collect()
    }

    fn on_step(&self, step: usize, series: &[Complex], left_out: &[Magnitude]) -> Outcome<OnStep> {
        let number = Varying::constant(&Rational::from_integer(step.into()), BITS);
        let mut shifted = self.polynomial.clone();
        for first in 0..shifted.len() {
            for k in (first..shifted.len() - 1).rev() {
                let next = scaled(&shifted[k + 1], &number);
                shifted[k] = [0, 1].map(|part| shifted[k][part].add(&next[part], BITS));
            }
        }
        let [x, y] = scaled(&self.rate, &number);
        let factor = Varying::exp([&x, &y], BITS)?;
        let count = TERMS.min(shifted.len() + series.len() - 1);
        let mut sum = vec![Varying::zero(); count];
        let mut error = Magnitude::ZERO;
        for (j, own) in shifted.iter().enumerate() {
            let own = complex_product(own, &factor, BITS);
            for (sum, [x, y]) in sum[j..].iter_mut().zip(series) {
                let real = own[0].multiply(x, BITS).subtract(&own[1].multiply(y, BITS), BITS);
                *sum = sum.add(&real, BITS);
            }
            error = error.add(&size(&own).multiply(&left_out[TERMS - j]));
        }
        let (coefficients, off): (Vec<Varying>, Vec<Magnitude>) =
            sum.iter().map(Varying::split).unzip();
        let error = off.iter().fold(error, |sum, own| sum.add(own));
        Ok(OnStep { coefficients, error })
    }
}
