//! Functions given piece by piece on half-open periods.

use crate::expression::fraction::{Fraction, NotAUnit};
use crate::expression::sum::Expression;
use wavestep_polynomial::Symbol;

/// A function of all time, zero before 0, given on the half-open periods `[nD, (n+1)D)`, each
/// piece in a local variable that starts again at 0:
///
/// ```text
/// w(nD + s) = pieces[n](s),      0 ≤ s < D
/// ```
///
/// The value at `nD` is that of the piece that starts there, the right-hand limit; the left-hand
/// limit is the piece before at `s = D`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Piecewise {
    period: Fraction,
    local: Symbol,
    pieces: Vec<Expression>,
}

impl Piecewise {
    pub(crate) fn new(period: Fraction, local: Symbol) -> Piecewise {
        Piecewise { period, local, pieces: Vec::new() }
    }

    pub(crate) fn push(&mut self, piece: Expression) {
        self.pieces.push(piece);
    }

    /// The pieces known so far, from period 0 on.
    pub fn pieces(&self) -> &[Expression] {
        &self.pieces
    }

    /// The limit from the left at the end of piece `n`, `lim_{s→D} pieces[n](s)`.
    pub fn end(&self, n: usize) -> Result<Expression, NotAUnit> {
        self.pieces[n].substitute(&self.local, &self.period)
    }

    /// The value at the start of piece `n`.
    pub fn start(&self, n: usize) -> Expression {
        self.pieces[n].at_zero(&self.local)
    }
}
