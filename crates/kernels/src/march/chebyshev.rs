//! Chebyshev series on a period: `p(x) = Σ c_k T_k(2x − 1)`, `x` in `[0, 1]`.
//!
//! Values are summed from the end nearer to `x` in Reinsch's form of Clenshaw's recurrence, which
//! needs no small difference of large numbers there and has an error bound that is uniform in `x`.

use crate::lanes::{Lanes, WIDTH, padded};
use crate::vector::{Work, widest};

/// The value of the series at `x` in `[0, 1]`, within [`Sizes::evaluation_error`]. O(N). An empty series
/// is zero.
pub fn value(coefficients: &[f64], x: f64) -> f64 {
    let mut found = [0.0];
    values(coefficients, &[x], &mut found);
    found[0]
}

/// The values of the series at all `points` of `[0, 1]`, in any order, into `values`: as [`value`],
/// bit for bit, and several times faster. O(N · points).
pub fn values(coefficients: &[f64], points: &[f64], values: &mut [f64]) {
    values_of([Samples { coefficients, points, values }]);
}

/// A series, points of `[0, 1]`, and where the values there go.
#[derive(Debug)]
pub struct Samples<'a> {
    /// The coefficients of the series.
    pub coefficients: &'a [f64],
    /// Where it is evaluated.
    pub points: &'a [f64],
    /// The values there.
    pub values: &'a mut [f64],
}

/// The values of many series: the same as one after the other, and faster, because each step of a
/// recurrence waits for the one before, and here two go side by side. O(N · points).
pub fn values_of<'a>(series: impl IntoIterator<Item = Samples<'a>>) {
    let groups = series.into_iter().flat_map(|samples| {
        let Samples { coefficients, points, values } = samples;
        assert_eq!(points.len(), values.len(), "one value for each point");
        let groups = points.chunks(WIDTH).zip(values.chunks_mut(WIDTH));
        groups.map(move |(points, values)| Samples { coefficients, points, values })
    });
    widest(Pairs(groups));
}

/// Samples at eight points or fewer, of which two go side by side.
struct Pairs<I>(I);

impl<'a, I: Iterator<Item = Samples<'a>>> Work for Pairs<I> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        while let Some(one) = self.0.next() {
            let mut here = Reinsch::<L>::new(&one);
            let Some(other) = self.0.next() else {
                here.down(1);
                store(here.end(), one.values);
                return;
            };
            let mut there = Reinsch::<L>::new(&other);
            let (a, b) = (one.coefficients, other.coefficients);
            // What one of them has more is stepped through alone.
            let common = a.len().min(b.len()).saturating_sub(1) / 2 * 2 + 1;
            here.down(common);
            there.down(common);
            for odd in (1..common).step_by(2).rev() {
                here.even(a[odd + 1]);
                there.even(b[odd + 1]);
                here.odd(a[odd]);
                there.odd(b[odd]);
            }
            store(here.end(), one.values);
            store(there.end(), other.values);
        }
    }
}

/// Writes the first lanes.
#[inline(always)]
fn store<L: Lanes>(lanes: L, values: &mut [f64]) {
    values.copy_from_slice(&lanes.to_array()[..values.len()]);
}

/// Sums of the sizes of coefficients. For fewer than 2²⁰ of them each is off by less than `2⁻³⁴` of
/// itself: no term takes part in more than 2¹⁸ + 8 roundings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sizes {
    /// `Σ |c_k|`: no value of the series is larger.
    pub absolute: f64,
    /// `Σ (k + 1) |c_k|`.
    pub weighted: f64,
    /// `Σ 2k² |c_k|`: no derivative by `x` is larger, because `|T_k'| ≤ k²`.
    pub slope: f64,
}

impl Sizes {
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
    /// exact recurrence. An error in `d_k` moves those below by what the same coefficient would; the pair
    /// of `ζ` and `−ζ` moves `b_j` by `√2 ζ` and `d_j` by `2ζ tan(θ/2) ≤ 2ε A_k` at most: the computed sizes
    /// are larger by the factor `1 + 9Nε` at most. That, and the rounding of this sum itself, are far within
    /// `9/8.25`. Below the normal doubles a
    /// product is off by at most `2⁻¹⁰⁷⁵`: `1e−290` covers all of them. ∎
    pub fn evaluation_error(&self) -> f64 {
        9.0 * (f64::EPSILON / 2.0) * self.weighted + 1e-290
    }
}

/// The sums of sizes of a series. O(N).
pub fn sizes(coefficients: &[f64]) -> Sizes {
    widest(Measure(coefficients))
}

/// The sizes of a series.
struct Measure<'a>(&'a [f64]);

impl Work for Measure<'_> {
    type Output = Sizes;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Sizes {
        let zero = L::splat(0.0);
        let (mut absolute, mut weighted, mut slope) = (zero, zero, zero);
        let mut place = L::from_array([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        let (groups, rest) = self.0.as_chunks();
        for group in groups.iter().chain([&padded(rest)]) {
            let size = L::from_array(*group).abs();
            let weight = place * size;
            absolute = absolute + size;
            weighted = weighted + weight;
            slope = slope + place * weight;
            place = place + L::splat(WIDTH as f64);
        }
        let absolute = absolute.sum();
        Sizes { absolute, weighted: weighted.sum() + absolute, slope: 2.0 * slope.sum() }
    }
}

/// The recurrence at eight points, each from the end nearer to it. The mirrored series, whose odd
/// coefficients change sign, serves the left half. `h` is exact on both sides.
struct Reinsch<'a, L> {
    coefficients: &'a [f64],
    h: L,
    /// 1 on the right, −1 on the left.
    sign: L,
    b: L,
    d: L,
}

impl<'a, L: Lanes> Reinsch<'a, L> {
    #[inline(always)]
    fn new(samples: &Samples<'a>) -> Self {
        let x = padded(samples.points);
        Reinsch {
            coefficients: samples.coefficients,
            h: L::from_array(x.map(|x| if x < 0.5 { -4.0 * x } else { 4.0 * (x - 1.0) })),
            sign: L::from_array(x.map(|x| if x < 0.5 { -1.0 } else { 1.0 })),
            b: L::splat(0.0),
            d: L::splat(0.0),
        }
    }

    /// The places from the last one down to `first`, which is odd.
    #[inline(always)]
    fn down(&mut self, first: usize) {
        let pairs = self.coefficients.get(first..).unwrap_or_default().chunks_exact(2);
        if let [last] = pairs.remainder() {
            self.odd(*last);
        }
        for pair in pairs.rev() {
            self.even(pair[1]);
            self.odd(pair[0]);
        }
    }

    #[inline(always)]
    fn even(&mut self, coefficient: f64) {
        self.step(L::splat(coefficient));
    }

    #[inline(always)]
    fn odd(&mut self, coefficient: f64) {
        self.step(self.sign * L::splat(coefficient));
    }

    #[inline(always)]
    fn step(&mut self, coefficient: L) {
        self.d = (coefficient + self.d) + self.h * self.b;
        self.b = self.b + self.d;
    }

    /// The value, from the constant coefficient.
    #[inline(always)]
    fn end(self) -> L {
        let Some(constant) = self.coefficients.first() else { return L::splat(0.0) };
        (L::splat(*constant) + L::splat(0.5) * self.h * self.b) + self.d
    }
}
