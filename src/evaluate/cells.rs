//! A window of time cut into cells on which an observable is a short Taylor polynomial.
//!
//! Cells are dyadic: `2^w` wide, from a multiple of `2^w` on, so that their middles and half widths are
//! exact doubles, and `u = (t − middle)/half` is exact for doubles beside it. A cell in which an echo
//! arrives is cut there, and both parts keep its middle. Where the polynomial is too long a cell is
//! halved.

use crate::ball::{Binary, Magnitude};
use crate::evaluate::evaluator::{EvaluateError, Side};
use crate::evaluate::signal::{Signal, Stretch};
use crate::evaluate::taylor::Taylor;
use crate::expression::Fraction;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// The most cells of one window.
const MAX_CELLS: usize = 400_000;

/// Where widths end: halving a cell further means that nothing converges.
const MIN_EXPONENT: i64 = -900;

/// Bits beyond those of the error aimed at, to begin with.
const SPARE_BITS: u64 = 40;

/// The most bits of balls.
const MAX_BITS: u64 = 1 << 15;

/// How long polynomials may be, and how exact they shall be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    /// The degree.
    pub degree: usize,
    /// A bound on the error, absolute.
    pub error: Magnitude,
}

/// A part of a window on which a signal is one polynomial in `u = (t − middle)/half`.
pub(crate) struct Cell {
    /// The smallest double that belongs to it.
    pub first: f64,
    /// The largest one.
    pub last: f64,
    /// The middle of the dyadic cell.
    pub middle: f64,
    /// Its half width, a power of two.
    pub half: f64,
    /// The stretch that it lies in.
    pub stretch: usize,
    /// The polynomial, of the degree asked for, with what its terms of higher degree can be.
    pub taylor: Taylor,
}

/// A signal on a window, with its cells made as they are asked for.
pub(crate) struct Window<'a> {
    pub signal: &'a Signal,
    pub stretches: Vec<Stretch>,
    /// The smallest doubles of the stretches, and one after the last of them all.
    firsts: Vec<f64>,
    from: Rational,
    to: Rational,
}

impl<'a> Window<'a> {
    /// The window from one time of the user's to another.
    pub(crate) fn new(
        signal: &'a Signal,
        from: &Rational,
        to: &Rational,
    ) -> Result<Window<'a>, EvaluateError> {
        let stretches = signal.stretches(from, to)?;
        let mut firsts = Vec::with_capacity(stretches.len());
        for (i, stretch) in stretches.iter().enumerate() {
            firsts.push(match i {
                0 => at_or_after(from),
                _ => first_double(signal, stretch.from())?,
            });
        }
        Ok(Window { signal, stretches, firsts, from: from.clone(), to: to.clone() })
    }

    /// The doubles of a stretch, the first and the last; `None` where there are none.
    fn doubles(&self, stretch: usize) -> Option<(f64, f64)> {
        let first = self.firsts[stretch];
        let last = match self.firsts.get(stretch + 1) {
            Some(next) => next.next_down(),
            None => -at_or_after(&-&self.to),
        };
        (first <= last).then_some((first, last))
    }

    /// The stretch of a time.
    pub(crate) fn stretch_at(&self, at: &Rational, side: Side) -> Result<usize, EvaluateError> {
        if *at < self.from || *at > self.to {
            return Err(EvaluateError::AfterLast);
        }
        self.signal.stretch_at(&self.stretches, at, side)
    }

    /// About the largest absolute value at the beginning, in the middle and at the end of some of the
    /// stretches; the largest one on the window is not smaller by more than one part in 2^18.
    pub(crate) fn scale(&self) -> Result<Magnitude, EvaluateError> {
        const SAMPLES: usize = 40;
        let stride = self.stretches.len().div_ceil(SAMPLES);
        let mut scale = Magnitude::ZERO;
        for stretch in self.stretches.iter().step_by(stride) {
            let middle = (stretch.from() + stretch.to()).scale(&Rational::new(1.into(), 2.into()));
            for at in [stretch.from(), &middle, stretch.to()] {
                let value = self.refined(Magnitude::ZERO, |bits| {
                    let value = self.signal.enclose(stretch, 0, at, bits)?;
                    let fine = value.radius().scale(20) <= value.magnitude()
                        || value.magnitude() < Magnitude::power_of_two(-200);
                    Ok((value, fine))
                })?;
                scale = scale.max(value.midpoint().magnitude());
            }
        }
        Ok(scale)
    }

    /// What `compute` gives with the fewest bits with which it is fine; bits double.
    fn refined<T>(
        &self,
        error: Magnitude,
        compute: impl Fn(u64) -> Result<(T, bool), EvaluateError>,
    ) -> Result<T, EvaluateError> {
        let wanted = error.top().map_or(0, |top| u64::try_from(-top).unwrap_or(0));
        let mut bits = (wanted + SPARE_BITS).next_multiple_of(64);
        loop {
            let (value, fine) = compute(bits)?;
            if fine || bits >= MAX_BITS {
                return Ok(value);
            }
            bits *= 2;
        }
    }

    /// The bits with which coefficients are finer than an error, at the end of the window, where they
    /// are least so.
    pub(crate) fn bits(&self, error: Magnitude) -> Result<u64, EvaluateError> {
        let stretch = self.stretches.last().expect("a window has a stretch");
        self.refined(error, |bits| {
            let value = self.signal.enclose(stretch, 0, stretch.to(), bits)?;
            Ok((bits, value.radius().scale(12) <= error))
        })
    }

    /// All cells, in order, polynomials fitting as they shall.
    ///
    /// # Errors
    /// [`EvaluateError::TooManyCells`], and what stands in the way of enclosures.
    pub(crate) fn cells(&self, fit: Fit) -> Result<Vec<Cell>, EvaluateError> {
        let bits = self.bits(fit.error)?;
        let mut cells = Vec::new();
        let mut widest: Option<i64> = None;
        for stretch in 0..self.stretches.len() {
            let Some((first, last)) = self.doubles(stretch) else { continue };
            // A cell that holds the stretch, or so wide as the widest of the stretch before, twice.
            let length = (last - first).max(f64::MIN_POSITIVE);
            let covering = exponent_of(length) + 1;
            let mut width = widest.map_or(covering, |widest| covering.min(widest + 1));
            // The middle of a cell beside such a time has to be a double.
            let coarse = exponent_of(last.abs().max(first.abs()).max(f64::MIN_POSITIVE)) - 50;
            width = width.max(coarse);
            widest = None;
            let mut at = first;
            while at <= last {
                let (cell, cell_width) =
                    self.fitting(stretch, (at, last), (width, coarse), at == first, (fit, bits))?;
                widest = Some(widest.map_or(cell_width, |widest| widest.max(cell_width)));
                at = cell.last.next_up();
                // The next cell may be as wide as its place on the grid allows.
                width = (cell_width + 1).min(covering);
                cells.push(cell);
                if cells.len() > MAX_CELLS {
                    return Err(EvaluateError::TooManyCells { limit: MAX_CELLS });
                }
            }
        }
        Ok(cells)
    }

    /// The widest cell from `first` on that is at most `2^width` wide and fits.
    fn fitting(
        &self,
        stretch: usize,
        (first, last): (f64, f64),
        (width, coarse): (i64, i64),
        opens: bool,
        (fit, bits): (Fit, u64),
    ) -> Result<(Cell, i64), EvaluateError> {
        let mut width = width;
        loop {
            let scale = power(width);
            let index = (first / scale).floor();
            let (start, end) = (index * scale, (index + 1.0) * scale);
            // But for the first of a stretch, cells begin where the one before ends.
            if start < first && !opens && width > coarse {
                width -= 1;
                continue;
            }
            let half = scale / 2.0;
            let middle = start + half;
            let taylor = self.expand(stretch, (middle, half), (fit, bits))?;
            if taylor.remainder <= fit.error || width <= coarse {
                if taylor.remainder > fit.error {
                    return Err(EvaluateError::TooSteep);
                }
                let last = last.min(end.next_down());
                return Ok((Cell { first, last, middle, half, stretch, taylor }, width));
            }
            width -= 1;
            if width < MIN_EXPONENT {
                return Err(EvaluateError::TooSteep);
            }
        }
    }

    /// The polynomial about a middle, its terms beyond the degree in the remainder.
    pub(crate) fn expand(
        &self,
        stretch: usize,
        (middle, half): (f64, f64),
        (fit, bits): (Fit, u64),
    ) -> Result<Taylor, EvaluateError> {
        let (middle, half) = (rational(middle), rational(half));
        // Twice as many terms tell what those beyond the degree are.
        let terms = 2 * fit.degree + 6;
        let place = (&middle, &half);
        let mut taylor = self.signal.taylor(&self.stretches[stretch], 0, place, terms, bits)?;
        taylor.remainder = taylor.tail(fit.degree + 1);
        taylor.coefficients.truncate(fit.degree + 1);
        Ok(taylor)
    }
}

/// A finite double as a fraction.
pub(crate) fn rational(value: f64) -> Rational {
    Rational::from(&Binary::from_double(value).expect("a finite number"))
}

/// `2^exponent`.
fn power(exponent: i64) -> f64 {
    2f64.powi(i32::try_from(exponent).expect("an exponent of doubles"))
}

/// The largest `w` with `2^w ≤ value`.
fn exponent_of(value: f64) -> i64 {
    let exponent = Binary::from_double(value).and_then(|value| value.top());
    exponent.map_or(MIN_EXPONENT, |top| top - 1)
}

/// The smallest double that is at least as large.
pub(crate) fn at_or_after(value: &Rational) -> f64 {
    let ball = crate::ball::Ball::from_rational(value, 80);
    let double = ball.midpoint().to_double();
    match rational(double) < *value {
        true => double.next_up(),
        false if rational(double.next_down()) >= *value => double.next_down(),
        false => double,
    }
}

/// The smallest double that is not before a time in the scale of the waves.
fn first_double(signal: &Signal, time: &Fraction) -> Result<f64, EvaluateError> {
    let numbers = signal.numbers();
    if let (Some(time), Some(slowness)) = (time.as_constant(), signal.slowness().as_constant()) {
        return Ok(at_or_after(&(time / slowness)));
    }
    let slowness = numbers.enclose(signal.slowness(), 128)?;
    let inverse = slowness.reciprocal(128).map_err(EvaluateError::Ball)?;
    let near = numbers.enclose(time, 128)?.multiply(&inverse, 128).midpoint().to_double();
    let is_before = |double: f64| -> Result<bool, EvaluateError> {
        let at = signal.slowness().scale(&rational(double));
        Ok(numbers.compare(&at, time)? == Ordering::Less)
    };
    let mut double = near;
    while is_before(double)? {
        double = double.next_up();
    }
    while !is_before(double.next_down())? {
        double = double.next_down();
    }
    Ok(double)
}
