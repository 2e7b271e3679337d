//! Compiled: a window as pieces of polynomials, with one proven bound for all of it.
//!
//! The pieces are Taylor polynomials of the exact form in balls, or polynomials of least degree across the
//! pieces of a march in fixed-point numbers. A bound adds up what they leave out,
//! the rounding of their coefficients to doubles, and that of evaluating them, which
//! [`Table`] proves. Whatever the order of the waves, a value costs some ten multiply-adds.

use super::doubles::table;
use super::{Evaluator, MethodError};
use crate::ball::{Ball, Magnitude, unit_in_the_last_place};
use crate::signal::cells::{Fit, Pieces, Window};
use crate::signal::signal::{Limit, Signal};
use wavestep_kernels::{Piece, Table};
use wavestep_polynomial::Rational;

/// The degree of polynomials in doubles: shorter ones need more pieces, longer ones more operations. With
/// this one a row of a table fills two lines of a cache.
const DEGREE: usize = 11;

/// The error of polynomials that is aimed at, relative to the largest value: an eighth of a unit in
/// the last place.
const ERROR_BITS: i64 = 56;

/// An observable on a window as polynomials in doubles.
pub struct Compiled<'a> {
    window: Window<'a>,
    table: Table,
    pieces: Pieces,
}

impl<'a> Compiled<'a> {
    /// Cuts the window into pieces and expands the observable on each. The error of the pieces will be
    /// at most a quarter of `tolerance`, or an eighth of a unit in the last place of the largest value
    /// where none is given or that is larger.
    pub fn new(
        signal: &'a dyn Signal,
        tolerance: Option<f64>,
    ) -> Result<Compiled<'a>, MethodError> {
        let window = Window::new(signal).marching();
        let scale = window.scale_of_errors()?;
        let fine = scale.scale(-ERROR_BITS);
        let coarse = tolerance.map(|tolerance| Magnitude::from_double(tolerance / 4.0));
        let error = coarse.map_or(fine, |coarse| coarse.max(fine));
        // Half of a tolerance, but the units that are always kept.
        let ulp = Magnitude::from_double(unit_in_the_last_place(scale.to_double()));
        let kept = ulp.multiply(&Magnitude::from_u64(5)).scale(-1);
        let allowed = tolerance.map(|tolerance| Magnitude::from_double(tolerance / 2.0));
        let rounding = Some(allowed.map_or(kept, |allowed| allowed.max(kept)));
        let pieces = window.pieces(Fit { degree: DEGREE, error, rounding })?;
        Ok(Compiled { window, table: table(&pieces)?, pieces })
    }

    /// The polynomials, for values at memory speed.
    pub fn table(&self) -> &Table {
        &self.table
    }

    pub(crate) fn into_table(self) -> Table {
        self.table
    }

    /// The pieces of the table.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces.all
    }
}

impl Evaluator for Compiled<'_> {
    fn law(&self) -> String {
        format!(
            "at most {:.1e} everywhere on the window, proven: {} polynomials of degree {}",
            self.table.bound(),
            self.table.pieces(),
            self.table.degree()
        )
    }

    fn bound(&self) -> Option<f64> {
        Some(self.table.bound() * (1.0 + f64::EPSILON.sqrt()))
    }

    /// On the piece that the exact time lies in, `p(u) + p'(u) δ` at the nearest double, δ what is left
    /// of the time: its rounding is that of the result. What is neglected, `δ² p''/2` and roundings of
    /// the second term, is below `2^−80` of the coefficients. Beside the ends of pieces the value is
    /// enclosed in a ball.
    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError> {
        let Some(stretch) = self.window.signal.stretch_at(at, side)? else {
            return Ok(self.window.enclosed(at, side)?);
        };
        let Pieces { all, firsts, .. } = &self.pieces;
        let pieces = &all[firsts[stretch]..firsts[stretch + 1]];
        let (near, rest) = Ball::from_rational(at, 128).split();
        let place = pieces.partition_point(|piece| piece.start <= near);
        let ends = [pieces.get(place), all.get(firsts[stretch + 1])];
        let ends_here = ends.into_iter().flatten().any(|next| near >= next.start.next_down());
        let rest = rest.midpoint().to_double();
        let Some(piece) = place.checked_sub(1).map(|place| &pieces[place]).filter(|piece| {
            !ends_here && near < self.table.end() && (near > piece.start || rest >= 0.0)
        }) else {
            return Ok(self.window.enclosed(at, side)?);
        };
        let u = (near - piece.centre) * piece.scale;
        let (mut value, mut slope) = (0.0_f64, 0.0_f64);
        for coefficient in piece.coefficients.iter().rev() {
            slope = slope.mul_add(u, value);
            value = value.mul_add(u, *coefficient);
        }
        Ok(slope.mul_add(rest * piece.scale, value))
    }

    fn values(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError> {
        values_of(&self.table, at, values)
    }
}

/// The values of a table at many times.
pub(crate) fn values_of(table: &Table, at: &[f64], values: &mut [f64]) -> Result<(), MethodError> {
    match table.evaluator().values(at, values) {
        true => Ok(()),
        false => Err(MethodError::Outside),
    }
}
