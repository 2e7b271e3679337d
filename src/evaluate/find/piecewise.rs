//! What a search needs to know of a function of time.

use crate::ball::{Ball, Magnitude};
use crate::evaluate::error::EvaluateError;
use crate::evaluate::evaluator::Limit;
use crate::evaluate::taylor::Taylor;
use wavestep_polynomial::Rational;

/// Where in a stretch.
#[derive(Clone, Copy)]
pub enum At<'a> {
    /// A time of the user's.
    Time(&'a Rational),
    /// The limit at an end of the stretch: on the right side of its first time, the left of its last.
    End(Limit),
}

/// A real function of the user's time on a window, cut into stretches, on each of which it is analytic.
///
/// # Invariants
/// - Stretches follow each other without gaps and fill the window; only the last may be an instant,
///   the end of the window where the function jumps.
/// - The function of a stretch goes on analytically a little beyond its ends, and enclosures hold there.
/// - Enclosures hold for every precision in bits; with more bits they are narrower, until a limit.
pub trait Piecewise {
    /// How many stretches there are.
    fn count(&self) -> usize;

    /// Whether a stretch is the last instant of the window alone.
    fn is_instant(&self, stretch: usize) -> bool;

    /// Whether the function is known to be zero on a stretch.
    fn is_zero(&self, stretch: usize) -> bool;

    /// The time of an end, where it is known to be rational.
    fn exact_time(&self, stretch: usize, end: Limit) -> Option<Rational>;

    /// An enclosure of the time of an end.
    fn time(&self, stretch: usize, end: Limit, bits: u64) -> Result<Ball, EvaluateError>;

    /// An enclosure of the derivative of an order.
    fn enclose(
        &self,
        stretch: usize,
        order: usize,
        at: At<'_>,
        bits: u64,
    ) -> Result<Ball, EvaluateError>;

    /// The derivative of an order at `m + hu` as a polynomial in `−1 ≤ u ≤ 1` with so many terms, and
    /// a bound of what is left out.
    fn taylor(
        &self,
        stretch: usize,
        order: usize,
        place: (&Rational, &Rational),
        terms: usize,
        bits: u64,
    ) -> Result<Taylor, EvaluateError>;

    /// The size of the largest of those functions whose sum is the derivative of an order, at a time,
    /// and of what is unknown of it.
    fn size(
        &self,
        stretch: usize,
        order: usize,
        at: &Rational,
        bits: u64,
    ) -> Result<(Magnitude, Magnitude), EvaluateError>;

    /// The value, where it is known to be rational.
    fn exact(&self, stretch: usize, at: At<'_>) -> Result<Option<Rational>, EvaluateError>;

    /// Whether the derivative in the limit at an end is known to be exactly zero.
    fn slope_vanishes(&self, stretch: usize, end: Limit) -> Result<bool, EvaluateError>;

    /// Whether the function is known to have one value on all of a stretch, which lies within these
    /// bounds.
    fn equals(
        &self,
        stretch: usize,
        value: &Rational,
        bounds: &[Rational; 2],
        bits: u64,
    ) -> Result<bool, EvaluateError>;
}
