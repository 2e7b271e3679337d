//! The test whether a number known with an error rounds to one double only.
//!
//! Every number within the error rounds to the same double when the two ends do, since rounding is
//! monotone. A number close to the midpoint of two doubles fails: more digits must decide it.

/// The double nearest to every number within `error` of `high + low`, if there is one only.
///
/// `high` must be `high + low` rounded. With `ε = 2⁻⁵³` the result is `x` with
/// `RN(high + RN(low − e')) = RN(high + RN(low + e')) = x`; here `e' = (error + 2 ε |low|) (1 + 4 ε)`
/// is wide enough for the two inner roundings: `RN(low − e') ≤ low − e' + ε (|low| + e') ≤ low − error`,
/// if nothing underflows, where sums are exact anyway. An `error` that is NaN or infinite leaves
/// everything undecided. A handful of operations.
///
/// ```
/// use wavestep_kernels::rounding::round_within;
/// assert_eq!(round_within(1.0, 1e-20, 1e-25), Some(1.0));
/// let half_ulp = 2.0_f64.powi(-53);
/// assert_eq!(round_within(1.0, half_ulp * 0.999_999, 1e-30), Some(1.0));
/// assert_eq!(round_within(1.0, half_ulp, 1e-30), None);
/// assert_eq!(round_within(1.0, 0.0, f64::INFINITY), None);
/// ```
pub fn round_within(high: f64, low: f64, error: f64) -> Option<f64> {
    let margin = (error + f64::EPSILON * low.abs()) * (1.0 + 2.0 * f64::EPSILON);
    let (down, up) = (high + (low - margin), high + (low + margin));
    (down == up && down.is_finite()).then_some(down)
}
