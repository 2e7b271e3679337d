//! Cells as wide as polynomials in doubles allow, one after the other along a stretch.
//!
//! How wide a cell can be changes slowly but along fronts: a width is tried that is somewhat larger than
//! that of the cell before, and smaller ones until a polynomial fits. That it does is proven, from its
//! doubles, against the pieces of a march.

use crate::ball::{Ball, Binary, Magnitude};
use crate::evaluate::cell::{Cell, Fit};
use crate::evaluate::marched_pieces::MarchedPieces;
use crate::evaluate::taylor::Taylor;
use wavestep_kernels::fixed::{Interpolant, Spans};

/// How much wider than its predecessor a cell is tried.
const WIDER: f64 = 1.5;

/// How much narrower, while no polynomial fits.
const NARROWER: f64 = 0.75;

/// How often at most: a cell then is `10^−9` of the first one tried, where nothing converges.
const MOST_TRIES: u32 = 80;

/// The part of a stretch that the first cell is tried on.
const FIRST_PART: f64 = 1.0 / 8.0;

/// The cells of a range of doubles, of the stretch 0; `width` is that of the last cell of the range
/// before, and becomes that of this one. None where there is no march or none that serves, where
/// nothing is said about rounding, and where no polynomials are found.
pub(crate) fn fitted(
    marched: Option<&MarchedPieces>,
    (first, last): (f64, f64),
    fit: Fit,
    width: &mut Option<f64>,
) -> Option<Vec<Cell>> {
    let rounding = fit.rounding?.to_double();
    let marched = marched.filter(|marched| marched.serves(fit.error))?;
    let spans = marched.of_period((first, last), fit.degree)?;
    let limits = [fit.error.to_double(), rounding];
    let mut cells = Vec::new();
    let mut start = first;
    let mut tried = width.map_or((last - first) * FIRST_PART, |width| width * WIDER);
    loop {
        let found = (0..MOST_TRIES).find_map(|_| {
            let rest = last - start;
            let end = if tried >= rest {
                last
            } else {
                // What is left shall not be a sliver.
                (start + tried.min(rest / 2.0)).next_down().max(start)
            };
            let cell = fitting(&spans, (start, end), limits);
            tried = (end - start) * NARROWER;
            cell
        })?;
        let end = found.last;
        *width = Some(end - start);
        cells.push(found);
        if end >= last {
            return Some(cells);
        }
        tried = (end - start) * WIDER;
        start = end.next_up();
    }
}

/// The cell on a range of doubles, where a polynomial is near enough and loses little when evaluated.
///
/// Its coefficients are doubles, so the distance holds what rounding them costs, some `ε Σ|c_k| r^k`. The
/// rounding of Horner's scheme is `ε (T_0 + 2 Σ_{1≤k<n} T_k + T_n)`, `T_k = Σ_{j≥k} |c_j| r^j`.
fn fitting(spans: &Spans, (first, last): (f64, f64), [error, rounding]: [f64; 2]) -> Option<Cell> {
    let interpolant = spans.interpolated(first, last)?;
    let Interpolant { middle, scale, ref coefficients, .. } = interpolant;
    let reach = (last - middle).max(middle - first) / scale;
    let unit = f64::EPSILON / 2.0;
    let (mut tail, mut tails) = (0.0, 0.0);
    for (k, coefficient) in coefficients.iter().enumerate().rev() {
        tail += coefficient.abs() * reach.powi(k as i32);
        tails += 2.0 * tail;
    }
    if unit * (tails - tail) > rounding {
        return None;
    }
    let distance = spans.distance(&interpolant)?;
    if distance > error + unit * tail {
        return None;
    }
    let exact =
        |coefficient: &f64| Some(Ball::new(Binary::from_double(*coefficient)?, Magnitude::ZERO));
    let coefficients = coefficients.iter().map(exact).collect::<Option<_>>()?;
    let taylor = Taylor { coefficients, remainder: Magnitude::from_double(distance) };
    Some(Cell { first, last, middle, scale, stretch: 0, taylor })
}
