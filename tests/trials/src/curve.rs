//! Functions on an interval as sums of Chebyshev polynomials, in doubles.

use std::f64::consts::PI;
use std::sync::OnceLock;

/// How many polynomials, and how many points.
pub const POINTS: usize = 24;

/// The coefficients of a function on the interval from −1 to 1.
#[derive(Clone, Debug)]
pub struct Curve(pub [f64; POINTS]);

/// The points, all within the interval, rising.
pub fn points() -> &'static [f64; POINTS] {
    static POINTS_ONCE: OnceLock<[f64; POINTS]> = OnceLock::new();
    POINTS_ONCE.get_or_init(|| std::array::from_fn(|i| -angle(i).cos()))
}

fn angle(point: usize) -> f64 {
    (2 * point + 1) as f64 * PI / (2 * POINTS) as f64
}

impl Curve {
    /// Through values at the points.
    pub fn through(values: &[f64; POINTS]) -> Curve {
        static COSINES: OnceLock<Vec<[f64; POINTS]>> = OnceLock::new();
        let row = |k: usize| std::array::from_fn(|i| (k as f64 * (PI - angle(i))).cos());
        let cosines = COSINES.get_or_init(|| (0..POINTS).map(row).collect());
        Curve(std::array::from_fn(|k| {
            let sum: f64 = cosines[k].iter().zip(values).map(|(a, b)| a * b).sum();
            sum * if k == 0 { 1.0 } else { 2.0 } / POINTS as f64
        }))
    }

    /// Clenshaw's rule.
    pub fn at(&self, x: f64) -> f64 {
        let (mut last, mut before) = (0.0, 0.0);
        for c in self.0[1..].iter().rev() {
            (last, before) = (2.0 * x * last - before + c, last);
        }
        self.0[0] + x * last - before
    }

    /// Whether the last coefficients are as small as roundings of the others.
    pub fn is_resolved(&self) -> bool {
        let largest = |part: &[f64]| part.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
        largest(&self.0[POINTS - 3..]) < 1e-12 * largest(&self.0).max(1.0)
    }
}

/// The integrals from −1 to each point, and to 1 at last, as sums of values at the points.
pub fn integrals() -> &'static [[f64; POINTS]; POINTS + 1] {
    static ROWS: OnceLock<Box<[[f64; POINTS]; POINTS + 1]>> = OnceLock::new();
    ROWS.get_or_init(|| {
        let mut rows = Box::new([[0.0; POINTS]; POINTS + 1]);
        for own in 0..POINTS {
            let mut values = [0.0; POINTS];
            values[own] = 1.0;
            let curve = Curve::through(&values);
            for (row, x) in points().iter().chain([&1.0]).enumerate() {
                rows[row][own] = integral(&curve, *x) - integral(&curve, -1.0);
            }
        }
        rows
    })
}

/// An antiderivative.
pub fn integral(curve: &Curve, x: f64) -> f64 {
    let chebyshev = |k: usize| (k as f64 * x.acos()).cos();
    let term = |(k, c): (usize, &f64)| {
        let whole = match k {
            0 => x,
            1 => x * x / 2.0,
            _ => (chebyshev(k + 1) / (k + 1) as f64 - chebyshev(k - 1) / (k - 1) as f64) / 2.0,
        };
        c * whole
    };
    curve.0.iter().enumerate().map(term).sum()
}
