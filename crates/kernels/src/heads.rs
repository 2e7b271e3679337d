//! Heads of coefficients on a grid, for pairs of doubles whose sums are cheap.
//!
//! A double added to a much larger one, the anchor, is rounded to a multiple of the anchor's last
//! bit. Sums of such multiples are exact, so that two operations tell how much of a product is kept
//! and how much is left to the low part. Why all of it is exact is shown in `bounds`.

/// The first coefficients of a piece, `c_k + low_k = C_k + low'_k`.
///
/// # Invariants
/// `M` is the power of two given, `anchor = 3 M`, and all `C_k` are multiples of `g = 2⁻⁵¹ M`.
pub(crate) struct Heads {
    /// `σ`.
    pub(crate) anchor: f64,
    /// `σ + C_k`.
    pub(crate) anchored: Vec<f64>,
    /// `low'_k`, at most `g/2 + |low_k|`, rounded once.
    pub(crate) low: Vec<f64>,
}

impl Heads {
    /// Of coefficients that are less than `M` in magnitude, and of their low parts, which may be
    /// fewer.
    ///
    /// `C_k` is `c_k` rounded to the grid. The difference is exact: it is 0, or `c_k` itself, or a
    /// multiple of the last bit of `c_k` that is less than `c_k`.
    pub(crate) fn new(largest: f64, coefficients: &[f64], low: &[f64]) -> Self {
        let anchor = 3.0 * largest;
        let anchored: Vec<f64> = coefficients.iter().map(|c| anchor + c).collect();
        let rest = |k: usize| coefficients[k] - (anchored[k] - anchor);
        let low =
            (0..coefficients.len()).map(|k| rest(k) + low.get(k).copied().unwrap_or(0.0)).collect();
        Self { anchor, anchored, low }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heads_are_multiples_of_the_grid_and_lose_nothing() {
        let grid = 2.0_f64.powi(-51);
        let coefficients = [1.0 / 3.0, -0.999, grid / 3.0, -0.0, grid * 7.0];
        let heads = Heads::new(1.0, &coefficients, &[0.0, grid / 1024.0]);
        assert_eq!(heads.anchor, 3.0);
        for (k, coefficient) in coefficients.iter().enumerate() {
            let head = heads.anchored[k] - heads.anchor;
            assert_eq!((head / grid).fract(), 0.0);
            let given = if k == 1 { grid / 1024.0 } else { 0.0 };
            assert_eq!(coefficient - head, heads.low[k] - given);
            assert!(heads.low[k].abs() <= grid / 2.0 + given);
        }
    }
}
