//! The wave of a reflection in arbitrary precision.

use crate::reference::{add, big, error, responses};
use astro_float_num::BigFloat;
use wavestep_kernels::echoes::Family;

/// The true wave at one local time on every period.
pub struct Reference(Vec<BigFloat>);

impl Reference {
    /// `y_n(x) = Σ_k ρ^k e^{−B X} L_k((A + B) X)`, `X = n − k + x`, for `n < periods`.
    pub fn new(rate: f64, zero: f64, ratio: f64, x: f64, periods: usize) -> Reference {
        let numbers = [&big(rate), &add(&big(rate), &big(zero))];
        Reference(responses(Family::Laguerre, numbers, ratio, &big(x), periods))
    }

    /// `|found − y_n(x)|`, to a few digits.
    pub fn error(&self, period: usize, found: f64) -> f64 {
        error(&self.0[period], found)
    }
}
