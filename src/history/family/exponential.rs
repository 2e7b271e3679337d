//! Sums of `Re p(t) e^(μt)` over a symbol, step by step: loads and modes.

use super::Outcome;
use super::grid::Grid;
use super::motion::TERMS;
use super::on_cell::OnCell;
use super::symbol::OverSymbol;
use crate::ball::{Arithmetic as _, BallError, Magnitude};
use crate::expression::{Expression, Fraction, Transform};
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::signal::{Varying, complex_product, divide, of_exponential};
use wavestep_polynomial::{Rational, Symbol};

/// Exponentials are worked out at the first of so many steps, and multiplied with those of the steps between.
const BLOCK: usize = 16;

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

/// A sum of exponentials, with its real and its imaginary part.
fn value(sum: &Expression, symbol: &OverSymbol<'_>) -> Outcome<Complex> {
    let mut total = [Varying::zero(), Varying::zero()];
    for (exponent, coefficient) in sum.terms() {
        let [x, y] = symbol.complex(exponent)?;
        let size = Varying::exp([&x, &y], BITS)?;
        let own = complex_product(&symbol.complex(coefficient)?, &size, BITS);
        total = std::array::from_fn(|part| total[part].add(&own[part], BITS));
    }
    Ok(total)
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
        let (mut terms, mut conjugates) = (Vec::new(), Vec::new());
        for (rate, coefficients) in Transform::of(course, time).poles() {
            if conjugates.contains(rate) {
                continue;
            }
            if coefficients.len() > TERMS {
                return Ok(None);
            }
            let conjugate = rate.substitute(&i, &-&Fraction::symbol(&i))?;
            let stands_for = if conjugate == *rate { 1 } else { 2 };
            conjugates.push(conjugate);
            let mut factor = Varying::constant(&Rational::from_integer(stands_for.into()), BITS);
            let mut polynomial = Vec::with_capacity(coefficients.len());
            for (c, count) in coefficients.iter().zip(1..) {
                polynomial.push(scaled(&value(c, symbol)?, &factor));
                factor = factor.multiply(length, BITS).over(count, BITS);
            }
            terms.push(Exponential { rate: scaled(&symbol.complex(rate)?, length), polynomial });
        }
        Ok(Some(terms))
    }

    /// The sum of the real parts on one cell.
    pub fn total_on(all: &[Exponential], grid: &Grid, cell: usize) -> Outcome<OnCell> {
        let part = |own: &Exponential| {
            let series = Series::of(&scaled(&own.rate, grid.length(cell)))?;
            Ok(own.on_cell(grid, cell, &own.factor(&grid.start(cell))?, &series))
        };
        let parts = all.iter().map(part).collect::<Outcome<Vec<_>>>()?;
        Ok(OnCell::total(parts.iter()))
    }

    /// The sum of the real parts on the first cells.
    ///
    /// # Errors
    /// [`NotOverSymbol::Ball`](super::NotOverSymbol::Ball) where one is too large.
    pub fn total(all: &[Exponential], grid: &Grid, count: usize) -> Outcome<Vec<OnCell>> {
        let parts = all.iter().map(|own| own.on_cells(grid, count)).collect::<Outcome<Vec<_>>>()?;
        let sum = |cell: usize| OnCell::total(parts.iter().map(|own| &own[cell]));
        Ok((0..count).map(sum).collect())
    }

    /// A bound of `|μ|` per step.
    pub fn rate(&self) -> Magnitude {
        size(&self.rate)
    }

    /// Its real part on the first cells. On one that begins at `n` and has a length `h` it is `p(n + hx) e^(μn) e^(μhx)`, with
    /// `p(n + hx) e^(μn) = Σ_j p_j x^j` and `e^(μhx) = Σ_i (μhx)^i/i!`. Of the product, the powers of `x` from some `N` on are
    /// left out, `Σ_j |p_j| |μh|^(N−j)/(N−j)! e^|μh|` at most.
    fn on_cells(&self, grid: &Grid, count: usize) -> Outcome<Vec<OnCell>> {
        let series = |cell| Series::of(&scaled(&self.rate, grid.length(cell)));
        let series = (0..grid.cells()).map(series).collect::<Outcome<Vec<_>>>()?;
        let block = BLOCK * grid.cells();
        let within = (0..block.min(count)).map(|cell| self.factor(&grid.start(cell)));
        let within = within.collect::<Outcome<Vec<_>>>()?;
        let mut cells = Vec::with_capacity(count);
        for first in (0..count).step_by(block) {
            let factor = self.factor(&grid.start(first))?;
            for (cell, within) in (first..count).zip(&within) {
                let factor = complex_product(&factor, within, BITS);
                cells.push(self.on_cell(grid, cell, &factor, &series[cell % grid.cells()]));
            }
        }
        Ok(cells)
    }

    /// `e^(μn)` at a time.
    fn factor(&self, start: &Varying) -> Outcome<Complex> {
        let [x, y] = scaled(&self.rate, start);
        Ok(Varying::exp([&x, &y], BITS)?)
    }

    fn on_cell(&self, grid: &Grid, cell: usize, factor: &Complex, series: &Series) -> OnCell {
        let start = grid.start(cell);
        let mut shifted = self.polynomial.clone();
        divide(&mut shifted, |c, next| {
            let next = scaled(next, &start);
            [0, 1].map(|part| c[part].add(&next[part], BITS))
        });
        let count = TERMS.min(shifted.len() + series.terms.len() - 1);
        let mut sum = vec![Varying::zero(); count];
        let mut error = Magnitude::ZERO;
        let mut power = Varying::one();
        for (j, own) in shifted.iter().enumerate() {
            let own = scaled(&complex_product(own, factor, BITS), &power);
            power = power.multiply(grid.length(cell), BITS);
            for (sum, [x, y]) in sum[j..].iter_mut().zip(&series.terms) {
                let real = own[0].multiply(x, BITS).subtract(&own[1].multiply(y, BITS), BITS);
                *sum = sum.add(&real, BITS);
            }
            error = error.add(&size(&own).multiply(series.left_out_of(TERMS - j)));
        }
        let (coefficients, off): (Vec<Varying>, Vec<Magnitude>) =
            sum.iter().map(Varying::split).unzip();
        OnCell::new(coefficients, off.iter().fold(error, |sum, own| sum.add(own)))
    }
}

/// `e^(μhx) = Σ_i (μhx)^i/i!`, as far as the working precision takes it, and what is left out from each term on.
struct Series {
    terms: Vec<Complex>,
    left_out: Vec<Magnitude>,
}

impl Series {
    fn of(rate: &Complex) -> Outcome<Series> {
        let (most, small) = (size(rate), Magnitude::power_of_two(-(BITS as i64)));
        let mut left_out = vec![of_exponential(&most).ok_or(BallError::ArgumentTooLarge)?];
        let mut terms = vec![[Varying::one(), Varying::zero()]];
        for i in 1..=TERMS as u64 {
            let rest = left_out[left_out.len() - 1].multiply(&most).divide(i);
            left_out.push(rest);
            if i == TERMS as u64 || rest <= small {
                break;
            }
            let next = complex_product(&terms[terms.len() - 1], rate, BITS);
            terms.push(next.map(|part| part.over(i, BITS)));
        }
        Ok(Series { terms, left_out })
    }

    /// What is left out where the first terms are taken, or all that there are.
    fn left_out_of(&self, terms: usize) -> &Magnitude {
        &self.left_out[terms.min(self.terms.len())]
    }
}
