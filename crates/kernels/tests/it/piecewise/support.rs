//! Exact arithmetic with dyadic numbers, and tables made at random, for all tests of the kernels.

pub use crate::random::Random;
use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use wavestep_kernels::{Evaluator, Piece, Table, TableError};

/// `mantissa · 2^exponent`: what doubles, their sums and products are, exactly.
#[derive(Clone, Debug)]
pub struct Dyadic {
    mantissa: BigInt,
    exponent: i64,
}

impl Dyadic {
    /// A finite double.
    pub fn new(value: f64) -> Self {
        assert!(value.is_finite());
        let (bits, biased) = (value.to_bits(), (value.to_bits() >> 52 & 0x7ff) as i64);
        let fraction = (bits & ((1 << 52) - 1)) as i64;
        let magnitude = if biased == 0 { fraction } else { fraction | 1 << 52 };
        let mantissa = BigInt::from(if value < 0.0 { -magnitude } else { magnitude });
        Self { mantissa, exponent: biased.max(1) - 1075 }
    }

    pub fn add(&self, other: &Self) -> Self {
        let exponent = self.exponent.min(other.exponent);
        let shifted = |a: &Self| &a.mantissa << (a.exponent - exponent) as u64;
        Self { mantissa: shifted(self) + shifted(other), exponent }
    }

    pub fn subtract(&self, other: &Self) -> Self {
        self.add(&Self { mantissa: -&other.mantissa, exponent: other.exponent })
    }

    pub fn multiply(&self, other: &Self) -> Self {
        Self {
            mantissa: &self.mantissa * &other.mantissa,
            exponent: self.exponent + other.exponent,
        }
    }

    pub fn abs(&self) -> Self {
        Self { mantissa: self.mantissa.abs(), exponent: self.exponent }
    }

    pub fn is_zero(&self) -> bool {
        self.mantissa.is_zero()
    }

    /// Whether `self ≤ other`.
    pub fn at_most(&self, other: &Self) -> bool {
        !self.subtract(other).mantissa.is_positive()
    }

    /// About the value, for ratios that are printed or compared roughly.
    pub fn approximate(&self) -> f64 {
        let bits = self.mantissa.bits() as i64;
        let shift = (bits - 60).max(0);
        let top: i64 = (&self.mantissa >> shift as u64).try_into().expect("60 bits");
        let exponent = (self.exponent + shift).clamp(-4000, 4000) as i32;
        top as f64 * 2.0_f64.powi(exponent / 2) * 2.0_f64.powi(exponent - exponent / 2)
    }

    /// Whether a finite double is this number rounded to nearest, ties to even.
    pub fn rounds_to(&self, value: f64) -> bool {
        let twice = Self { mantissa: self.mantissa.clone(), exponent: self.exponent + 1 };
        let midpoint = |neighbour: f64| Self::new(value).add(&Self::new(neighbour));
        let (low, high) = (midpoint(value.next_down()), midpoint(value.next_up()));
        let on_edge = twice.subtract(&low).is_zero() || twice.subtract(&high).is_zero();
        let even = value.to_bits() & 1 == 0;
        low.at_most(&twice) && twice.at_most(&high) && (even || !on_edge)
    }
}

/// The polynomial of a piece at a double, exactly, low parts included.
pub fn exact(piece: &Piece, time: f64) -> Dyadic {
    let distance = Dyadic::new(time).subtract(&Dyadic::new(piece.centre));
    let u = distance.multiply(&Dyadic::new(piece.scale));
    let mut value = Dyadic::new(0.0);
    for (k, &coefficient) in piece.coefficients.iter().enumerate().rev() {
        let low = Dyadic::new(piece.low.get(k).copied().unwrap_or(0.0));
        value = value.multiply(&u).add(&Dyadic::new(coefficient)).add(&low);
    }
    value
}

/// The piece that a double belongs to, found without the table.
pub fn piece_at(pieces: &[Piece], time: f64) -> &Piece {
    &pieces[pieces.partition_point(|piece| piece.start <= time) - 1]
}

/// What a table made at random looks like.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    pub pieces: usize,
    pub degree: usize,
    pub low: usize,
    /// Coefficients shrink like its powers.
    pub decay: f64,
    pub start: f64,
    pub width: f64,
    /// Widths vary by up to this factor.
    pub spread: f64,
    /// The size of the coefficients.
    pub size: f64,
}

/// Smooth pieces of degree 13 on a window that begins at 0.
pub const TYPICAL: Shape = Shape {
    pieces: 60,
    degree: 13,
    low: 0,
    decay: 0.15,
    start: 0.0,
    width: 0.03,
    spread: 1.0,
    size: 1.0,
};

/// Tables of many kinds: one piece, uneven ones, about 0, far from it, constants, high degrees,
/// coefficients that do not shrink, very small and very large ones.
pub const SHAPES: [Shape; 9] = [
    TYPICAL,
    Shape { pieces: 1, degree: 7, low: 3, ..TYPICAL },
    Shape { pieces: 200, degree: 5, spread: 1e9, ..TYPICAL },
    Shape { pieces: 50, degree: 9, low: 10, start: -1.1, width: 0.05, decay: 0.5, ..TYPICAL },
    Shape { pieces: 7, degree: 0, start: 1e9, width: 10.0, ..TYPICAL },
    Shape { pieces: 11, degree: 63, low: 20, decay: 1.0, start: 3.0, ..TYPICAL },
    Shape { pieces: 20, degree: 6, low: 2, size: 1e-305, start: -10.0, ..TYPICAL },
    Shape { pieces: 20, degree: 6, low: 2, size: 1e295, start: -1e-3, ..TYPICAL },
    Shape { pieces: 33, degree: 12, low: 5, width: 1e-12, start: 77.0, ..TYPICAL },
];

/// Pieces of a shape, and the end of the last one.
pub fn pieces(shape: Shape, random: &mut Random) -> (Vec<Piece>, f64) {
    let mut start = shape.start;
    let mut pieces = Vec::new();
    for _ in 0..shape.pieces {
        let width = shape.width * shape.spread.powf(-random.unit());
        let next = (start + width).max(start.next_up());
        let centre = (start + (next - start) * (0.5 + 0.01 * random.signed())).clamp(start, next);
        let half = (centre - start).max(next - centre);
        let scale = 2.0_f64.powi(-(half.log2().ceil() as i32));
        let coefficient = |k: usize| random.signed() * shape.size * shape.decay.powi(k as i32);
        let coefficients: Vec<f64> = (0..=shape.degree).map(coefficient).collect();
        let low = coefficients.iter().take(shape.low);
        let low = low.map(|c| c * 2.0_f64.powi(-53) * random.signed()).collect();
        pieces.push(Piece { start, centre, scale, coefficients, low, error: 0.0 });
        start = next;
    }
    (pieces, start)
}

/// A table of pieces whose scales are halved until the constructor accepts them.
pub fn table(pieces: &mut [Piece], end: f64) -> Table {
    loop {
        match Table::new(pieces, end) {
            Ok(table) => return table,
            Err(TableError::Argument(piece)) => pieces[piece].scale /= 2.0,
            Err(other) => panic!("{other}"),
        }
    }
}

/// Doubles of the window: every start, the end and their neighbours, and as many at random.
pub fn times(pieces: &[Piece], end: f64, count: usize, random: &mut Random) -> Vec<f64> {
    let start = pieces[0].start;
    let mut times = vec![start, start.next_up(), end, end.next_down()];
    for piece in &pieces[1..] {
        times.extend([piece.start, piece.start.next_up(), piece.start.next_down()]);
    }
    for _ in 0..count {
        // Half of them anywhere, half in a piece chosen first, so that short pieces are met.
        let i = random.bits() as usize % pieces.len();
        let (low, high) = match random.bits() & 1 {
            0 => (start, end),
            _ => (pieces[i].start, pieces.get(i + 1).map_or(end, |next| next.start)),
        };
        times.push((low + (high - low) * random.unit()).clamp(low, high));
    }
    times.retain(|&t| start <= t && t <= end);
    times
}

/// The value at one time alone.
pub fn value(evaluator: Evaluator<'_>, time: f64) -> f64 {
    let mut out = [0.0];
    evaluator.values(&[time], &mut out);
    out[0]
}

/// The correctly rounded value at one time alone, where it is decided.
pub fn rounded(evaluator: Evaluator<'_>, time: f64) -> Option<f64> {
    let mut out = [0.0];
    evaluator.rounded(&[time], &mut out).is_empty().then_some(out[0])
}

/// Bits, so that doubles compare as they are, NaN and the sign of 0 included.
pub fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}
