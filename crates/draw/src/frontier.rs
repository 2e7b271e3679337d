//! The frontier of accuracy against speed: which points no other point beats in both.

/// The indices of the points `(error, seconds)` that no other point beats, by increasing error.
///
/// Point `a` beats `b` if `a.0 ≤ b.0` and `a.1 ≤ b.1`, one of them strictly; of equal points the
/// first is kept. Points with a value that is not finite are passed over. The result describes the
/// step function
///
/// `T(e) = min { seconds : error ≤ e }`,
///
/// the least time for at most the error `e`: errors ascend and times descend, both strictly. Cost:
/// O(m log m) for `m` points.
pub fn frontier(points: &[(f64, f64)]) -> Vec<usize> {
    let finite = |&i: &usize| points[i].0.is_finite() && points[i].1.is_finite();
    let mut order: Vec<usize> = (0..points.len()).filter(finite).collect();
    // A stable sort by the values, where -0.0 equals 0.0.
    order.sort_by(|&i, &j| points[i].partial_cmp(&points[j]).expect("finite values"));
    let mut least = f64::INFINITY;
    // By increasing error, a point stays if it is faster than all before it.
    order.retain(|&i| {
        let faster = points[i].1 < least;
        least = least.min(points[i].1);
        faster
    });
    order
}
