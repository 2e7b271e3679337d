//! Grids split into parts, so that their points are rounded once without fused multiply-adds.

use crate::double_double::UNIT;

/// Products of an index and a smaller step can be split without overflow.
pub(super) const MAX_STEP: f64 = 1e280;

/// A grid split for machines without fused multiply-adds.
///
/// `from = F + f` and `step = H + h` exactly, with `F` and `H` multiples of a power of two `q` such that
/// no `|F + i H|` of the grid is larger than `2⁵³ q`: then `F + i H` is computed without rounding. The
/// rest `f + i h` lies between `RN(f₋ + RN(i h₋))` and `RN(f₊ + RN(i h₊))` with
///
/// ```text
/// f∓ = RN(f ∓ 8 ε |f|),   h∓ = RN(h ∓ 8 ε |h|),   ε = 2⁻⁵³,
/// ```
///
/// because each of the terms is moved by `5 ε` of itself at least after its own roundings, and the sum
/// is rounded by `ε (|f| + |i h|) (1 + 20 ε)` at most. Rounding is monotone: where both ends, added to
/// `F + i H`, round to one double, it is the sum rounded once.
#[derive(Clone, Copy)]
pub(crate) struct Parts {
    /// `F` and `H`; NaN where the grid is not split.
    pub(super) coarse: [f64; 2],
    /// `f₋` and `h₋`.
    pub(super) below: [f64; 2],
    /// `f₊` and `h₊`.
    pub(super) above: [f64; 2],
}

impl Parts {
    /// Of a grid with so many doubles, those that pad the last block included.
    ///
    /// Grids that could underflow or overflow, and those with indices that are no doubles, are not
    /// split.
    pub(super) fn new(from: f64, step: f64, count: usize) -> Self {
        const SMALL: f64 = f64::MIN_POSITIVE * (1_u64 << 62) as f64;
        const LARGE: f64 = 1.0 / SMALL;
        let reach = from.abs() + count as f64 * step.abs();
        let moderate = |part: f64| part == 0.0 || part.abs() >= SMALL;
        // Of zeros, one with a sign would lose it.
        let splits = moderate(from) && moderate(step) && (from != 0.0 || from.is_sign_positive());
        if !splits || !(SMALL..=LARGE).contains(&reach) || count >= 1 << 52 {
            return Self { coarse: [f64::NAN; 2], below: [0.0; 2], above: [0.0; 2] };
        }
        // 1.5 · 2⁵² q, with |from|, |step| ≤ reach ≤ 2⁵¹ q: sums with it are rounded to multiples of q.
        let exponent = f64::from_bits(reach.to_bits() & (0x7ff << 52));
        let rounder = exponent * 6.0;
        let coarse = [from, step].map(|part| (part + rounder) - rounder);
        let fine = [from - coarse[0], step - coarse[1]];
        let moved = |sign: f64| fine.map(|part| part + sign * 8.0 * UNIT * part.abs());
        Self { coarse, below: moved(-1.0), above: moved(1.0) }
    }
}
