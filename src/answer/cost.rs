//! What ways cost: a measured table.
//!
//! The figures are seconds on one core of the machine of `docs/performance.md`, as printed by
//! `cargo bench --bench costs` and rounded: they rank ways against each other and are not promises.
//! `docs/accuracy-and-speed.md` draws such measurements.

use crate::answer::method::Method;
use crate::signal::StablePrecision;

/// How large a problem is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Size {
    /// How many reflections the window sees.
    pub order: usize,
    /// How many values are asked for.
    pub points: usize,
    /// Whether waves have one pole and one lag, with rational constants, so that a march in
    /// fixed-point numbers gives the pieces.
    pub marches: bool,
}

/// What a way costs, in seconds.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Cost {
    /// Before the first value.
    pub setup: f64,
    /// For each value, at an exact time.
    pub point: f64,
}

/// An operation in balls.
const BALL: f64 = 1.7e-7;
/// A period of a march in integers, and a value of it at an exact time.
const FIXED_PERIOD: f64 = 6e-6;
const FIXED_POINT: f64 = 2e-6;
/// The polynomials on a stretch between arrivals, and the terms that they are expanded to.
const PIECES: f64 = 16.0;
const TERMS: f64 = 40.0;
/// A term of such a polynomial, and one from a march in integers, moved to another middle.
const TERM: f64 = 7e-7;
const MOVED: f64 = 8e-5;
/// Finding the piece of an exact time, and evaluating it.
const LOOKUP: f64 = 4e-6;
/// A step of a recurrence in doubles, in pairs of doubles.
const STEP: f64 = 1.2e-8;
const PAIR_STEP: f64 = 4e-8;
/// A Chebyshev coefficient of a march, without and with a bound.
const COEFFICIENT: f64 = 9e-9;
const PROVEN_COEFFICIENT: f64 = 2e-8;
/// A wave on a period, in a march of all waves.
const WAVE: f64 = 1.2e-6;

impl Cost {
    /// The cost of a method; `None` for models, which are never picked.
    pub fn of(method: Method, size: Size) -> Option<Cost> {
        let n = size.order as f64 + 1.0;
        let pieces = PIECES * n * if size.marches { MOVED } else { TERMS * n * TERM };
        let echoes = n * n / 2.0;
        let coefficients = n * (4.0 * n).sqrt().max(30.0);
        let (setup, point) = match method {
            Method::Certified if size.marches => (n * FIXED_PERIOD, FIXED_POINT),
            Method::Certified => (3.0 * echoes * BALL, n * BALL + LOOKUP),
            Method::Compiled => (pieces, LOOKUP),
            Method::Stable(StablePrecision::Double) => (0.0, echoes * STEP + LOOKUP),
            Method::Stable(StablePrecision::DoubleDouble) => (0.0, echoes * PAIR_STEP + LOOKUP),
            Method::Plain | Method::Expanded => (0.0, echoes * STEP + LOOKUP),
            Method::Marched { proven } => {
                let each = if proven { PROVEN_COEFFICIENT } else { COEFFICIENT };
                (coefficients * each, LOOKUP + COEFFICIENT * coefficients / n)
            }
            _ => return None,
        };
        Some(Cost { setup, point })
    }

    /// The cost of a march of so many waves without a bound.
    pub fn of_waves(size: Size, waves: usize) -> Cost {
        let one = (size.order as f64 + 1.0) * WAVE;
        Cost { setup: one * waves as f64, point: LOOKUP }
    }

    /// The cost of so many values, in seconds: `setup + points · point`.
    pub fn seconds(&self, points: usize) -> f64 {
        self.setup + self.point * points as f64
    }
}
