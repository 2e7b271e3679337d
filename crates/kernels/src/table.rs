//! Piecewise polynomials in doubles, laid out for evaluation.
//!
//! A table is built from pieces by a constructor that checks them, and knows a proven bound on the
//! error of every value computed from it, whatever instructions compute it.

use crate::bounds::Magnitudes;
use crate::double_double::two_sum;
use crate::heads::Heads;
use crate::lookup::Lookup;
use crate::rows::AlignedRows;

/// The highest degree of a piece.
pub const MAX_DEGREE: usize = 63;

/// The largest sum of magnitudes of coefficients: products can be split without overflow below it.
const MAX_TOTAL: f64 = f64::from_bits((990 + 1023) << 52);

/// Row numbers times row lengths fit into 31 bits, as gathering instructions need.
const MAX_ENTRIES: usize = i32::MAX as usize;

/// A polynomial on one piece of the real line, and how far it is from the function it stands for.
///
/// ```text
/// p(u) = Σ_k (coefficients[k] + low[k]) u^k,   u = (t − centre) · scale
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The least double that belongs to the piece.
    pub start: f64,
    /// The argument where `u = 0`.
    pub centre: f64,
    /// A power of two, such that `|u| ≤ 1` on the whole piece.
    pub scale: f64,
    /// The coefficients, the constant first.
    pub coefficients: Vec<f64>,
    /// Low parts of the first coefficients; there may be fewer than coefficients, or none.
    pub low: Vec<f64>,
    /// A proven bound on `|p(u(t)) − f(t)|` for every double `t` of the piece, `p` taken exactly.
    pub error: f64,
}

/// Why pieces do not make a table. Pieces are numbered from 0.
#[expect(missing_docs, reason = "the messages say it")]
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
pub enum TableError {
    #[error("a table needs at least one piece")]
    Empty,
    #[error("piece {0} must start at a finite double after the start before it")]
    Start(usize),
    #[error("the end must be finite and not before the last start")]
    End,
    #[error("the scale of piece {0} must be a positive power of two")]
    Scale(usize),
    #[error("the centre of piece {0} times its scale is not a double; move the centre")]
    Centre(usize),
    #[error("piece {0} reaches beyond |u| = 1; take a smaller scale or a shorter piece")]
    Argument(usize),
    #[error("piece {0} has a degree above {most}; cut it into shorter pieces", most = MAX_DEGREE)]
    Degree(usize),
    #[error("piece {0} has more low parts than coefficients")]
    Low(usize),
    #[error("piece {0} needs finite coefficients with magnitudes of 2^990 in sum at most")]
    Coefficient(usize),
    #[error("the error bound of piece {0} must be finite and not negative")]
    Error(usize),
    #[error("the table is too large; cut it into tables of fewer pieces")]
    Size,
}

/// A piecewise polynomial, ready for evaluation.
///
/// It is continuous from the right: a double that is the start of a piece belongs to that piece.
///
/// # Invariants
/// - At least one piece; starts ascend strictly and are finite; the end is not before the last start.
/// - Scales are powers of two, `centre · scale` is exact, and `|u| ≤ 1` for every double of a piece.
/// - Coefficients, low parts and bounds are finite; all rows have one length, padded with zeros.
/// - [`bound`](Self::bound) holds for every double from the first start to the end, at every level.
#[derive(Clone, Debug)]
pub struct Table {
    pub(crate) lookup: Lookup,
    /// Rows: scale, `−centre · scale`, `c_0 … c_n`.
    pub(crate) rows: AlignedRows,
    /// Rows: scale, `−centre · scale`, bound of pairs, anchor, then of the coefficients below
    /// [`Self::split`] heads and anchor in one sum, then the other coefficients, then the low
    /// parts.
    pub(crate) pairs: AlignedRows,
    pub(crate) degree: usize,
    /// Coefficients below this one are evaluated in pairs of doubles where results are certified.
    pub(crate) split: usize,
    end: f64,
    bound: f64,
    certified_bound: f64,
}

/// What stands in a row before the coefficients.
pub(crate) const ROW_SCALE: usize = 0;
pub(crate) const ROW_OFFSET: usize = 1;
pub(crate) const ROW_HEAD: usize = 2;

/// What stands in a row of pairs after scale and offset.
pub(crate) const PAIRS_BOUND: usize = 2;
pub(crate) const PAIRS_ANCHOR: usize = 3;
pub(crate) const PAIRS_HEAD: usize = 4;

/// The error of pairs of doubles that is not worth avoiding, relative to the largest magnitude:
/// `2⁻⁹⁶`.
const PAIR_ERROR: f64 = 1.0 / (1_u128 << 96) as f64;

fn is_power_of_two(scale: f64) -> bool {
    let fraction = scale.to_bits() & ((1 << 52) - 1);
    let subnormal_power = scale > 0.0 && !scale.is_normal() && fraction.is_power_of_two();
    subnormal_power || (scale.is_normal() && scale > 0.0 && fraction == 0)
}

/// Checks everything of one piece but its start; `last` is its greatest double.
fn check(number: usize, piece: &Piece, last: f64) -> Result<(), TableError> {
    if !is_power_of_two(piece.scale) {
        return Err(TableError::Scale(number));
    }
    let offset = piece.centre * piece.scale;
    if !offset.is_finite() || offset / piece.scale != piece.centre {
        return Err(TableError::Centre(number));
    }
    let within = |t: f64| {
        // The exact u is the sum of both, but for underflow of the small product, far below 1.
        let (u, rest) = two_sum(t * piece.scale, -offset);
        u.abs() < 1.0 || (u.abs() == 1.0 && u * rest <= 0.0)
    };
    if !within(piece.start) || !within(last) {
        return Err(TableError::Argument(number));
    }
    if piece.coefficients.len() > MAX_DEGREE + 1 {
        return Err(TableError::Degree(number));
    }
    if piece.low.len() > piece.coefficients.len() {
        return Err(TableError::Low(number));
    }
    let total: f64 = piece.coefficients.iter().chain(&piece.low).map(|c| c.abs()).sum();
    if total.is_nan() || total > MAX_TOTAL {
        return Err(TableError::Coefficient(number));
    }
    if !(piece.error.is_finite() && piece.error >= 0.0) {
        return Err(TableError::Error(number));
    }
    Ok(())
}

/// A bound on `|u|` on a piece, at most 1: `u` is largest at an end.
fn reach(piece: &Piece, last: f64) -> f64 {
    let size = |t: f64| {
        let (u, rest) = two_sum(t * piece.scale, -(piece.centre * piece.scale));
        (u.abs() + rest.abs()).next_up()
    };
    size(piece.start).max(size(last)).min(1.0)
}

/// Whether `t − centre` is a double for every double `t` from `start` to `last`.
///
/// By Sterbenz' lemma it is where `centre/2 ≤ t ≤ 2 centre` (mirrored for negative ones), and trivially
/// where the centre is 0. Elsewhere it is rounded, by `2⁻⁵³ |u|` at most.
fn has_exact_argument(centre: f64, start: f64, last: f64) -> bool {
    let (centre, low, high) =
        if centre < 0.0 { (-centre, -last, -start) } else { (centre, start, last) };
    centre == 0.0 || (low >= centre - centre / 2.0 && high / 2.0 <= centre)
}

impl Table {
    /// A table of pieces in ascending order; the last one reaches to `end`, inclusive.
    ///
    /// O(pieces · degree).
    pub fn new(pieces: &[Piece], end: f64) -> Result<Self, TableError> {
        let last_piece = pieces.last().ok_or(TableError::Empty)?;
        let ascends = |i: usize| i == 0 || pieces[i - 1].start < pieces[i].start;
        let start_error = (0..pieces.len()).find(|&i| !pieces[i].start.is_finite() || !ascends(i));
        if let Some(number) = start_error {
            return Err(TableError::Start(number));
        }
        if !(end.is_finite() && end >= last_piece.start) {
            return Err(TableError::End);
        }
        let last = |i: usize| pieces.get(i + 1).map_or(end, |next| next.start.next_down());
        for (i, piece) in pieces.iter().enumerate() {
            check(i, piece, last(i))?;
        }
        let length = pieces.iter().map(|piece| piece.coefficients.len()).max().unwrap_or(0).max(1);
        let lookup = Lookup::new(pieces.iter().map(|piece| piece.start), end);
        let entries = pieces.len() * (PAIRS_HEAD + 2 * length).next_multiple_of(8);
        if lookup.entries().max(entries) > MAX_ENTRIES {
            return Err(TableError::Size);
        }
        let mut padded = Vec::with_capacity(pieces.len() * length);
        for piece in pieces {
            padded.extend_from_slice(&piece.coefficients);
            padded.resize(padded.len() + length - piece.coefficients.len(), 0.0);
        }
        let magnitudes = |i: usize| {
            let piece = &pieces[i];
            let exact = has_exact_argument(piece.centre, piece.start, last(i));
            let reach = reach(piece, last(i));
            Magnitudes::new(&padded[i * length..][..length], &piece.low, reach, exact)
        };
        let total = (0..pieces.len()).map(|i| magnitudes(i).total()).fold(0.0, f64::max);
        let needed = |i: usize| magnitudes(i).split(total * PAIR_ERROR);
        let split = (0..pieces.len()).map(needed).max().unwrap_or(0);
        let mut table = Self {
            lookup,
            rows: AlignedRows::new(pieces.len(), ROW_HEAD + length),
            pairs: AlignedRows::new(pieces.len(), PAIRS_HEAD + length + split),
            degree: length - 1,
            split,
            end,
            bound: 0.0,
            certified_bound: 0.0,
        };
        for (i, piece) in pieces.iter().enumerate() {
            let magnitudes = magnitudes(i);
            let coefficients = &padded[i * length..][..length];
            let heads =
                Heads::new(magnitudes.largest_head(split), &coefficients[..split], &piece.low);
            let pairs = magnitudes.of_pairs(&heads.low, piece.error);
            table.bound = table.bound.max(magnitudes.of_doubles(piece.error));
            table.certified_bound = table.certified_bound.max(pairs);
            let argument = [piece.scale, -(piece.centre * piece.scale)];
            table.rows.push(argument.iter().chain(coefficients).copied());
            let parts = [
                &argument,
                &[pairs, heads.anchor][..],
                &heads.anchored,
                &coefficients[split..],
                &heads.low,
            ];
            table.pairs.push(parts.into_iter().flatten().copied());
        }
        Ok(table)
    }

    /// The number of pieces, at least 1.
    pub fn pieces(&self) -> usize {
        self.rows.values().len() / self.rows.stride()
    }

    /// The highest degree of a piece.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The least double with a value.
    pub fn start(&self) -> f64 {
        self.lookup.starts()[0]
    }

    /// The greatest double with a value.
    pub fn end(&self) -> f64 {
        self.end
    }

    /// A proven bound on `|computed − f(t)|` for every double `t` from start to end, at every level.
    ///
    /// It is the largest of the pieces' own errors plus the rounding of Horner's scheme:
    ///
    /// ```text
    /// error + Σ |low_k| + 2⁻⁵³ (Σ_{k<n} T_k + Σ_{1≤k≤n} T_k + Σ k |c_k|),   T_k = Σ_{j≥k} |c_j|
    /// ```
    ///
    /// with `|c_k| r^k` for `|c_k|` where `|u| ≤ r < 1` on the piece, and a little more for underflow; the
    /// last sum is left out if `t − centre` is exact on the whole piece. O(1).
    pub fn bound(&self) -> f64 {
        self.bound
    }

    /// A proven bound on the error of the pair of doubles that certified results are rounded from.
    ///
    /// Some `2⁻⁹⁵` of the largest magnitude, plus the pieces' own errors. A value whose distance to the
    /// midpoint of two doubles is larger is decided. O(1).
    pub fn certified_bound(&self) -> f64 {
        self.certified_bound
    }

    /// Evaluation with the widest instructions of this machine.
    pub fn evaluator(&self) -> crate::Evaluator<'_> {
        crate::Evaluator::new(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By Sterbenz from half of the centre to twice as much, on either side of zero.
    #[test]
    fn arguments_are_exact_near_their_centre() {
        for (centre, start, last, is_exact) in [
            (1.0, 0.5, 2.0, true),
            (1.0, 0.5_f64.next_down(), 1.0, false),
            (1.0, 0.6, 2_f64.next_up(), false),
            (100.0, 1.1, 150.0, false),
            (100.0, 50.0, 150.0, true),
            (-1.0, -2.0, -0.5, true),
            (-1.0, -1.0, -0.4, false),
            (0.0, -1.0, 1.0, true),
        ] {
            assert_eq!(
                has_exact_argument(centre, start, last),
                is_exact,
                "{start} {centre} {last}"
            );
        }
    }
}
