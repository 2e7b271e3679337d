//! Certified integrals of formulas over `0 ≤ k ≤ K`: Taylor polynomials on cells, with their
//! remainders, halved until the sum of the radii is small enough.
//!
//! On a cell, `k = K(x + hu)`, `|u| ≤ 1`. With `N` even and `c_n` the coefficients at its middle,
//!
//! ```text
//! ∫ f du = Σ_{n<N, n even} 2c_n/(n+1) + R,   R ∈ 2a/(N+1),
//! ```
//!
//! where the ball `a` holds `f^(N)(ξ)(Kh)^N/N!` for every `ξ` of the cell: Taylor's formula with
//! Lagrange's remainder, and `u^N ≥ 0`, so its integral is a mean of such values times `2/(N+1)`.
//! Where `f` has no derivatives, as at the zero of a root, a cell counts with its width times an
//! enclosure of the values on it.

use num_bigint::BigInt;
use wavestep_polynomial::Rational;

use super::error::DispersionError;
use super::formula::Formula;
use super::series::{Fault, Series};
use wavestep::ball::{Ball, Magnitude};

/// Cells at the start: `2^START`.
const START: u32 = 2;
const MAX_CELLS: usize = 20_000;
/// A cell narrower than `2^{−NARROW_BITS}` of its distance from zero is too narrow: something there is
/// not smooth. Smooth formulas take some ten bits.
const NARROW_BITS: u64 = 14;
/// Bits beyond those of the answer.
const SPARE_BITS: u64 = 24;

/// Each cell may add `2^{−CELL_SHARE}` of the tolerance, so that cells far narrower than their share of
/// the range are not refined in vain; 20,000 of them make less than 2⁵ times the tolerance.
const CELL_SHARE: i64 = 10;
/// How many cells on either side are looked at for the cause of a failure.
const NEIGHBOURS: i64 = 16;

/// The cell `[i/2^l, (i+1)/2^l]` of `[0, 1]`.
#[derive(Clone)]
struct Cell {
    place: BigInt,
    level: u32,
}

impl Cell {
    fn ends(&self) -> (Rational, Rational) {
        let whole = BigInt::from(1) << self.level;
        (Rational::new(self.place.clone(), whole.clone()), Rational::new(&self.place + 1, whole))
    }
}

/// `∫_0^K f dk`, with a radius of about `2^{−bits}` of the largest value of `|f|` seen, times `K`.
/// A cell takes two Taylor series of about `bits/4` terms; after 20,000 cells it gives up.
pub(super) fn integrate(
    formula: &Formula,
    upper: &Ball,
    bits: u64,
) -> Result<Ball, DispersionError> {
    let working = bits + SPARE_BITS;
    let order = ((bits / 8) * 2).max(8) as usize;
    let mut largest = Magnitude::power_of_two(-(bits as i64) - 1024);
    for i in 0..8 {
        let x = Rational::new((2 * i + 1).into(), 16.into());
        let k = upper.multiply_rational(&x, working);
        if let Ok(series) = formula.series(&Series::wave_number(&k, &Ball::zero(), 1), working) {
            let size = series.coefficients()[0].magnitude();
            largest = if size > largest { size } else { largest };
        }
    }
    let tolerance = largest.scale(-(bits as i64) - 5);
    let mut stack: Vec<Cell> =
        (0..1 << START).rev().map(|i: i64| Cell { place: i.into(), level: START }).collect();
    let (mut sum, mut seen) = (Ball::zero(), 0);
    while let Some(cell) = stack.pop() {
        seen += 1;
        if seen > MAX_CELLS {
            return Err(DispersionError::AccuracyNotReached { best: None, bits });
        }
        let result = on_cell(formula, upper, &cell, order, working);
        // Radius times width adds up to at most the tolerance over all cells, and 2^−10 of it a cell.
        if let Ok(mean) = &result
            && mean.radius().scale(-i64::from(cell.level)) <= allowed(&tolerance, cell.level)
        {
            let width = Rational::new(1.into(), BigInt::from(1) << cell.level);
            sum = sum.add(&mean.multiply_rational(&width, working), working);
            continue;
        }
        let narrow = cell.place.bits() > NARROW_BITS || u64::from(cell.level) > bits + 64;
        match result {
            Err(fault @ (Fault::MissingValue(_) | Fault::NotReal | Fault::Ball(_))) => {
                return Err(DispersionError::at(fault, &middle(upper, &cell, working)));
            }
            Err(fault) if narrow => {
                return Err(DispersionError::at(fault, &middle(upper, &cell, working)));
            }
            Ok(_) if narrow => return Err(nearby_fault(formula, upper, &cell, working, bits)),
            _ => {}
        }
        let (place, level) = (&cell.place * 2, cell.level + 1);
        stack.push(Cell { place: &place + 1, level });
        stack.push(Cell { place, level });
    }
    Ok(sum.multiply(upper, working))
}

/// The share of a cell: that of its width, and a little for being a cell.
fn allowed(tolerance: &Magnitude, level: u32) -> Magnitude {
    tolerance.scale(-i64::from(level)).add(&tolerance.scale(-CELL_SHARE))
}

/// What keeps a narrow cell from being integrated: what fails on it with its neighbours, or nothing
/// but the precision.
fn nearby_fault(
    formula: &Formula,
    upper: &Ball,
    cell: &Cell,
    working: u64,
    bits: u64,
) -> DispersionError {
    let (low, high) = cell.ends();
    let reach = (&high - &low) * Rational::from_integer(NEIGHBOURS.into());
    let around = upper.multiply(&Ball::between(&(low - &reach), &(high + reach), working), working);
    let series = Series::wave_number(&around, &Ball::from_integer(&1.into()), 2);
    match formula.series(&series, working) {
        Err(fault) => DispersionError::at(fault, &around),
        Ok(_) => DispersionError::AccuracyNotReached { best: None, bits },
    }
}

fn middle(upper: &Ball, cell: &Cell, bits: u64) -> Ball {
    let (low, high) = cell.ends();
    upper.multiply_rational(&((low + high) / Rational::from_integer(2.into())), bits)
}

/// An enclosure of the mean of the formula on the cell.
fn on_cell(
    formula: &Formula,
    upper: &Ball,
    cell: &Cell,
    order: usize,
    bits: u64,
) -> Result<Ball, Fault> {
    let (low, high) = cell.ends();
    let whole = upper.multiply(&Ball::between(&low, &high, bits), bits);
    let half = (&high - &low) / Rational::from_integer(2.into());
    let half = upper.multiply_rational(&half, bits);
    let remainder = formula.series(&Series::wave_number(&whole, &half, order + 1), bits);
    let remainder = match remainder {
        Ok(series) => series.coefficients()[order].clone(),
        // No derivatives: the values alone.
        Err(fault @ (Fault::RootOfZero | Fault::Divisor)) => {
            let one = Series::wave_number(&whole, &Ball::zero(), 1);
            let values = formula.series(&one, bits).map_err(|_| fault)?;
            return Ok(values.coefficients()[0].clone());
        }
        Err(fault) => return Err(fault),
    };
    let at = middle(upper, cell, bits);
    let series = formula.series(&Series::wave_number(&at, &half, order), bits)?;
    let mut sum = Ball::zero();
    for (n, coefficient) in series.coefficients().iter().enumerate().step_by(2) {
        let part = Rational::new(1.into(), (n as i64 + 1).into());
        sum = sum.add(&coefficient.multiply_rational(&part, bits), bits);
    }
    let part = Rational::new(1.into(), (order as i64 + 1).into());
    Ok(sum.add(&remainder.multiply_rational(&part, bits), bits))
}
