//! A cell: a part of a window on which a signal is one short polynomial.

use crate::ball::Magnitude;
use crate::evaluate::taylor::Taylor;

/// How long polynomials may be, and how exact they shall be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    /// The degree.
    pub degree: usize,
    /// A bound on the error, absolute.
    pub error: Magnitude,
    /// What rounding may cost when the polynomial is evaluated in doubles by Horner's scheme; no matter
    /// what where nothing is said.
    pub rounding: Option<Magnitude>,
}

/// A part of a window on which a signal is one polynomial in `u = (t − middle)/scale`.
pub(crate) struct Cell {
    /// The smallest double that belongs to it.
    pub first: f64,
    /// The largest one.
    pub last: f64,
    /// A double near its middle.
    pub middle: f64,
    /// A power of two, such that `|u| ≤ 1` on the cell.
    pub scale: f64,
    /// The stretch that it lies in.
    pub stretch: usize,
    /// The polynomial, of the degree asked for, with what its terms of higher degree can be on the
    /// cell.
    pub taylor: Taylor,
}
