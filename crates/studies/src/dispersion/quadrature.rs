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
use crate::ratio;
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

/// An integrand over `0 ≤ k ≤ K`.
struct Integrand<'a> {
    formula: &'a Formula,
    /// `K`.
    upper: &'a Ball,
    /// The precision of balls.
    bits: u64,
}

/// `∫_0^K f dk`, with a radius of about `2^{−bits}` of the largest value of `|f|` seen, times `K`.
/// A cell takes two Taylor series of about `bits/4` terms; after 20,000 cells it gives up.
pub(super) fn integrate(
    formula: &Formula,
    upper: &Ball,
    bits: u64,
) -> Result<Ball, DispersionError> {
    let integrand = Integrand { formula, upper, bits: bits + SPARE_BITS };
    let order = ((bits / 8) * 2).max(8) as usize;
    let mut largest = Magnitude::power_of_two(-(bits as i64) - 1024);
    for i in 0..8 {
        let k = upper.multiply_rational(&ratio(2 * i + 1, 16), integrand.bits);
        if let Ok(value) = formula.enclose(&k, integrand.bits) {
            largest = largest.max(value.magnitude());
        }
    }
    let tolerance = largest.scale(-(bits as i64) - 5);
    let mut stack: Vec<Cell> =
        (0..1 << START).rev().map(|i: i64| Cell { place: i.into(), level: START }).collect();
    let (mut sum, mut seen) = (Ball::zero(), 0);
    let not_reached = DispersionError::AccuracyNotReached { best: None, bits };
    while let Some(cell) = stack.pop() {
        seen += 1;
        if seen > MAX_CELLS {
            return Err(not_reached);
        }
        let result = integrand.on_cell(&cell, order);
        // Radius times width adds up to at most the tolerance over all cells, and 2^−10 of it a cell.
        if let Ok(mean) = &result
            && mean.radius().scale(-i64::from(cell.level)) <= allowed(&tolerance, cell.level)
        {
            let width = Rational::new(1.into(), BigInt::from(1) << cell.level);
            sum = sum.add(&mean.multiply_rational(&width, integrand.bits), integrand.bits);
            continue;
        }
        let narrow = cell.place.bits() > NARROW_BITS || u64::from(cell.level) > bits + 64;
        match result {
            Err(fault)
                if narrow
                    || matches!(
                        fault,
                        Fault::MissingValue(_) | Fault::NotReal | Fault::Ball(_)
                    ) =>
            {
                return Err(DispersionError::at(fault, &integrand.middle(&cell)));
            }
            Ok(_) if narrow => return Err(integrand.nearby_fault(&cell).unwrap_or(not_reached)),
            _ => {}
        }
        let (place, level) = (&cell.place * 2, cell.level + 1);
        stack.push(Cell { place: &place + 1, level });
        stack.push(Cell { place, level });
    }
    Ok(sum.multiply(upper, integrand.bits))
}

/// The share of a cell: that of its width, and a little for being a cell.
fn allowed(tolerance: &Magnitude, level: u32) -> Magnitude {
    tolerance.scale(-i64::from(level)).add(&tolerance.scale(-CELL_SHARE))
}

impl Integrand<'_> {
    /// What keeps a narrow cell from being integrated, if something fails on it or on its neighbours.
    fn nearby_fault(&self, cell: &Cell) -> Option<DispersionError> {
        let (low, high) = cell.ends();
        let reach = (&high - &low) * ratio(NEIGHBOURS, 1);
        let around = Ball::between(&(low - &reach), &(high + reach), self.bits);
        let around = self.upper.multiply(&around, self.bits);
        let fault = self.formula.with_slope(&around, self.bits).err()?;
        Some(DispersionError::at(fault, &around))
    }

    fn middle(&self, cell: &Cell) -> Ball {
        let (low, high) = cell.ends();
        self.upper.multiply_rational(&((low + high) / ratio(2, 1)), self.bits)
    }

    /// An enclosure of the mean of the formula on the cell.
    fn on_cell(&self, cell: &Cell, order: usize) -> Result<Ball, Fault> {
        let (low, high) = cell.ends();
        let (formula, bits) = (self.formula, self.bits);
        let whole = self.upper.multiply(&Ball::between(&low, &high, bits), bits);
        let half = self.upper.multiply_rational(&((&high - &low) / ratio(2, 1)), bits);
        let remainder = formula.series(&Series::wave_number(&whole, &half, order + 1), bits);
        let remainder = match remainder {
            Ok(series) => series.coefficients()[order].clone(),
            // No derivatives: the values alone.
            Err(fault @ (Fault::RootOfZero | Fault::Divisor)) => {
                return formula.enclose(&whole, bits).map_err(|_| fault);
            }
            Err(fault) => return Err(fault),
        };
        let at = self.middle(cell);
        let series = formula.series(&Series::wave_number(&at, &half, order), bits)?;
        let mut sum = Ball::zero();
        for (n, coefficient) in series.coefficients().iter().enumerate().step_by(2) {
            let part = ratio(1, n as i64 + 1);
            sum = sum.add(&coefficient.multiply_rational(&part, bits), bits);
        }
        let part = ratio(1, order as i64 + 1);
        Ok(sum.add(&remainder.multiply_rational(&part, bits), bits))
    }
}
