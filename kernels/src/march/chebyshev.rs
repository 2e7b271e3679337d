//! Chebyshev series on a period: `p(x) = Σ c_k T_k(2x − 1)`, `x` in `[0, 1]`.
//!
//! Values are summed from the end nearer to `x` in Reinsch's form of Clenshaw's recurrence, which
//! needs no small difference of large numbers there and has an error bound that is uniform in `x`.

/// How many points are evaluated side by side: the recurrence of one point waits for itself.
const LANES: usize = 8;

/// The value of the series at `x` in `[0, 1]`, within [`evaluation_error`]. O(N). An empty series
/// is zero.
///
/// ```
/// use wavestep_kernels::march::chebyshev;
///
/// // T_2(t) = 2t² − 1 at t = 2x − 1 = 1/2.
/// assert_eq!(chebyshev::value(&[0.0, 0.0, 1.0], 0.75), -0.5);
/// ```
pub fn value(coefficients: &[f64], x: f64) -> f64 {
    let [found] = reinsch(coefficients, [x]);
    found
}

/// The values of the series at all `points` of `[0, 1]`, in any order, into `values`: as [`value`],
/// bit for bit, and several times faster. O(N · points).
///
/// # Panics
/// Where `points` and `values` differ in length.
///
/// ```
/// use wavestep_kernels::march::chebyshev;
///
/// let mut values = [0.0; 3];
/// chebyshev::values(&[1.0, 1.0], &[0.0, 0.5, 1.0], &mut values);
/// assert_eq!(values, [0.0, 1.0, 2.0]);
/// ```
pub fn values(coefficients: &[f64], points: &[f64], values: &mut [f64]) {
    assert_eq!(points.len(), values.len(), "one value for each point");
    for (points, values) in points.chunks(LANES).zip(values.chunks_mut(LANES)) {
        // A short group is filled up with its first point.
        let mut group = [points[0]; LANES];
        group[..points.len()].copy_from_slice(points);
        match points.len() {
            1 => values[0] = value(coefficients, points[0]),
            2..=4 => {
                let [a, b, c, d, ..] = group;
                values.copy_from_slice(&reinsch(coefficients, [a, b, c, d])[..values.len()]);
            }
            _ => values.copy_from_slice(&reinsch(coefficients, group)[..values.len()]),
        }
    }
}

/// A bound of `|value(c, x) − p(x)|` for all `x` in `[0, 1]`: `9 ε Σ (k + 1) |c_k|`, `ε = 2⁻⁵³`,
/// for fewer than 2²⁰ coefficients. O(N).
///
/// *Proof.* By symmetry let `t = 2x − 1 = cos θ ≥ 0`, `0 ≤ θ ≤ π/2`. The recurrence is
/// `d_k = (c_k + d_{k+1}) + h b_{k+1}`, `b_k = d_k + b_{k+1}`, `h = 2(t − 1) = 4(x − 1)`, an exact
/// double, and `p = (c_0 + (h/2) b_1) + d_1`. With `A_k = Σ_{j≥k} |c_j|`,
///
/// - `b_k = Σ_{j≥k} c_j U_{j−k}(t)`, so `|b_k| ≤ A_k/sin θ` and
///   `|h b_k| ≤ 4 sin²(θ/2)/sin θ A_k ≤ 2 A_k`;
/// - `d_k = b_k − b_{k+1} = Σ_{j≥k} c_j cos((j−k+½)θ)/cos(θ/2)`, so `|d_k| ≤ √2 A_k`, and so
///   `|c_k + d_{k+1}| = |d_k − h b_{k+1}| ≤ (2 + √2) A_k`.
///
/// An error in `d_k` acts as the same error in `c_k`: it reaches `p` times `T_k`, at most 1. The
/// three roundings there are at most `ε ((2 + √2) + 2 + √2) A_k`. An error `ζ` in `b_k` alone acts
/// as `ζ` in `c_k` and `−ζ` in `c_{k−1}`: it reaches `p` times `|T_k − T_{k−1}| ≤ 2 sin(θ/2)`, and
/// with `ζ ≤ ε A_k/sin θ` that is at most `ε √2 A_k`. All together `(4 + 3√2) ε A_k < 8.25 ε A_k`;
/// the last line is no worse, and `Σ_k A_k = Σ_k (k + 1) |c_k|`. The sizes above are those of the
/// exact recurrence on coefficients moved by the roundings: larger by the factor `1 + 9Nε` at most.
/// That, and the rounding of this sum itself, are far within `9/8.25`. Below the normal doubles a
/// product is off by at most `2⁻¹⁰⁷⁵`: `1e−290` covers all of them. ∎
///
/// ```
/// use wavestep_kernels::march::chebyshev;
///
/// let c = [0.3, -0.2, 0.1];
/// // p(0.7) = 0.3 − 0.2 · 0.4 + 0.1 · (2 · 0.16 − 1).
/// let error = (chebyshev::value(&c, 0.7) - 0.152).abs();
/// assert!(error <= chebyshev::evaluation_error(&c) && chebyshev::evaluation_error(&c) < 2e-15);
/// ```
pub fn evaluation_error(coefficients: &[f64]) -> f64 {
    9.0 * (f64::EPSILON / 2.0) * sizes(coefficients).weighted + 1e-290
}

/// Sums of the sizes of coefficients. For fewer than 2²⁰ of them each is off by less than `2⁻³⁴` of
/// itself: no term takes part in more than 2¹⁸ + 8 roundings.
///
/// ```
/// use wavestep_kernels::march::chebyshev::{Sizes, sizes};
///
/// // The slope of T_2(2x − 1) is 8 at x = 1.
/// let expected = Sizes { absolute: 1.0, weighted: 3.0, slope: 8.0 };
/// assert_eq!(sizes(&[0.0, 0.0, -1.0]), expected);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sizes {
    /// `Σ |c_k|`: no value of the series is larger.
    pub absolute: f64,
    /// `Σ (k + 1) |c_k|`.
    pub weighted: f64,
    /// `Σ 2k² |c_k|`: no derivative by `x` is larger, because `|T_k'| ≤ k²`.
    pub slope: f64,
}

/// The sums of sizes of a series. O(N).
///
/// A sum waits for itself at each term; four lanes are summed side by side.
///
/// ```
/// use wavestep_kernels::march::chebyshev::sizes;
///
/// let found = sizes(&[1.0, -2.0, 3.0, -4.0, 5.0]);
/// assert_eq!((found.absolute, found.weighted, found.slope), (15.0, 55.0, 260.0));
/// ```
pub fn sizes(coefficients: &[f64]) -> Sizes {
    let mut sums = [[0.0; 4]; 3];
    let mut place = [0.0, 1.0, 2.0, 3.0];
    let mut add = |group: &[f64; 4]| {
        for lane in 0..4 {
            let (k, size) = (place[lane], group[lane].abs());
            sums[0][lane] += size;
            sums[1][lane] += (k + 1.0) * size;
            sums[2][lane] += 2.0 * k * k * size;
            place[lane] = k + 4.0;
        }
    };
    let (groups, rest) = coefficients.as_chunks::<4>();
    groups.iter().for_each(&mut add);
    let mut last = [0.0; 4];
    last[..rest.len()].copy_from_slice(rest);
    add(&last);
    let [absolute, weighted, slope] = sums.map(|lanes| lanes.iter().sum());
    Sizes { absolute, weighted, slope }
}

/// The recurrence at several points, each from the end nearer to it. The mirrored series, whose odd
/// coefficients change sign, serves the left half. `h` is exact on both sides.
fn reinsch<const N: usize>(coefficients: &[f64], x: [f64; N]) -> [f64; N] {
    let Some((constant, rest)) = coefficients.split_first() else { return [0.0; N] };
    let h = x.map(|x| if x < 0.5 { -4.0 * x } else { 4.0 * (x - 1.0) });
    let sign = x.map(|x| if x < 0.5 { -1.0 } else { 1.0 });
    let (mut b, mut d) = ([0.0; N], [0.0; N]);
    let odd = |b: &mut [f64; N], d: &mut [f64; N], c: f64| {
        for lane in 0..N {
            d[lane] = (sign[lane] * c + d[lane]) + h[lane] * b[lane];
            b[lane] += d[lane];
        }
    };
    // Odd and even places in turn: `rest` begins at place 1.
    let pairs = rest.chunks_exact(2);
    if let [last] = pairs.remainder() {
        odd(&mut b, &mut d, *last);
    }
    for pair in pairs.rev() {
        for lane in 0..N {
            d[lane] = (pair[1] + d[lane]) + h[lane] * b[lane];
            b[lane] += d[lane];
        }
        odd(&mut b, &mut d, pair[0]);
    }
    std::array::from_fn(|lane| (constant + 0.5 * h[lane] * b[lane]) + d[lane])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_polynomials_are_cosines() {
        for k in 0..60 {
            let mut c = vec![0.0; k + 1];
            c[k] = 1.0;
            for i in 0..=100 {
                let x = f64::from(i) / 100.0;
                let exact = (k as f64 * (2.0 * x - 1.0).acos()).cos();
                // acos is off by an ulp, which the cosine multiplies by k sin(kθ)/ sin θ at most.
                let error = (value(&c, x) - exact).abs();
                assert!(error < 1e-15 + 1e-15 * (k * k) as f64, "{k} {x}: {error:e}");
            }
            assert_eq!(value(&c, 1.0), 1.0);
            assert_eq!(value(&c, 0.0), if k % 2 == 0 { 1.0 } else { -1.0 });
        }
    }

    #[test]
    fn groups_give_the_same_bits() {
        let c: Vec<f64> = (0..33).map(|k| (k as f64).sin() / (1.0 + k as f64)).collect();
        for length in 0..50 {
            let points: Vec<f64> = (0..length).map(|i| (i as f64 * 0.37).fract()).collect();
            let mut found = vec![0.0; length];
            values(&c, &points, &mut found);
            assert!(points.iter().zip(&found).all(|(x, v)| value(&c, *x) == *v));
        }
        assert_eq!(value(&[], 0.5), 0.0);
    }
}
