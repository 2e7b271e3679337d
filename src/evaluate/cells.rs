//! A window of time cut into cells on which an observable is a short Taylor polynomial.
//!
//! A stretch between arrivals is halved until a polynomial of the degree asked for follows the
//! observable on each part. Where a march knows the pieces of a stretch, and polynomials are meant for
//! doubles, cells are instead as wide as such polynomials can be, one after the other: see `fitted_cells`.
//! Cells begin and end at doubles. Their middles are doubles and their scales
//! powers of two, so that `u = (t − middle)/scale` is exact for doubles beside the middle.

use crate::ball::{Attempt, Ball, Binary, Magnitude, Precisions};
use crate::evaluate::closed::{ClosedForm, Stretch};
use crate::evaluate::error::EvaluateError;
use crate::evaluate::fitted_cells;
use crate::evaluate::marched_pieces::MarchedPieces;
use crate::evaluate::signal::Limit;
use crate::evaluate::taylor::Taylor;
use crate::expression::Fraction;
use crate::limits::{MAX_PIECES, MAX_POLYNOMIALS};
use num_traits::Signed as _;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// How often a stretch is halved at most: beyond that nothing converges.
const MAX_DEPTH: u32 = 40;

/// Bits beyond those of the error aimed at, to begin with.
const SPARE_BITS: u64 = 40;

/// The most bits of balls.
const MAX_BITS: u64 = 1 << 15;

/// The bits of balls around fixed-point numbers.
const MARCHED_BITS: u64 = 128;

/// How long polynomials may be, and how exact they shall be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    /// The degree.
    pub degree: usize,
    /// A bound on the error, absolute.
    pub error: Magnitude,
    /// What rounding may cost when the polynomial is evaluated in doubles by Horner's scheme; no matter
    /// what where nothing is said.
    pub rounding: Option<Magnitude>,
}

/// A part of a window on which a signal is one polynomial in `u = (t − middle)/scale`.
pub(crate) struct Cell {
    /// The smallest double that belongs to it.
    pub first: f64,
    /// The largest one.
    pub last: f64,
    /// A double near its middle.
    pub middle: f64,
    /// A power of two, such that `|u| ≤ 1` on the cell.
    pub scale: f64,
    /// The stretch that it lies in.
    pub stretch: usize,
    /// The polynomial, of the degree asked for, with what its terms of higher degree can be on the
    /// cell.
    pub taylor: Taylor,
}

/// A signal on a window, with its cells made as they are asked for.
pub(crate) struct Window<'a> {
    pub signal: &'a ClosedForm,
    /// Those of the window; before them the one that ends where an arrival begins the window, for the
    /// limit from the left there.
    pub stretches: Vec<Stretch>,
    /// The smallest doubles of the stretches.
    firsts: Vec<f64>,
    from: Rational,
    to: Rational,
    /// A march that knows all pieces of the signal, where there is one.
    marched: Option<MarchedPieces>,
}

impl<'a> Window<'a> {
    /// The window from one time of the user's to another.
    pub(crate) fn new(
        signal: &'a ClosedForm,
        from: &Rational,
        to: &Rational,
    ) -> Result<Window<'a>, EvaluateError> {
        let order = signal.order(to)?;
        if signal.is_on_grid() && order > MAX_PIECES {
            let (echoes, limit) = (order as u128, MAX_PIECES);
            return Err(EvaluateError::TooManyEchoes { echoes, limit });
        }
        let mut stretches = signal.stretches(from, to)?;
        if let Some(before) = ending_at(signal, from)? {
            stretches.insert(0, before);
        }
        let mut firsts = Vec::with_capacity(stretches.len());
        for (i, stretch) in stretches.iter().enumerate() {
            firsts.push(match i {
                0 => at_or_after(from),
                _ => first_double(signal, stretch.from())?,
            });
        }
        let (from, to) = (from.clone(), to.clone());
        Ok(Window { signal, stretches, firsts, from, to, marched: None })
    }

    /// Takes pieces from a march in fixed-point numbers, where the signal has one pole and one lag and
    /// all its constants are rational numbers.
    pub(crate) fn marching(mut self) -> Window<'a> {
        self.marched = MarchedPieces::of(self.signal, &self.from, &self.to);
        self
    }

    /// The double nearest to the value at a time of a stretch, or next to it where that is not decided:
    /// balls with bits enough for all but ties.
    pub(crate) fn enclosed(&self, at: &Rational, stretch: usize) -> Result<f64, EvaluateError> {
        let at = self.signal.slowness().scale(at);
        let attempt = |bits| {
            let ball = self.signal.enclose(&self.stretches[stretch], 0, &at, bits)?;
            if let Some(value) = ball.rounded() {
                return Ok(Attempt::Done(value));
            }
            // An exact zero, or a tie: nothing is gained by more bits.
            let is_tie = *ball.radius() <= ball.midpoint().magnitude().scale(-200);
            Ok(Attempt::of(ball.midpoint().to_double(), is_tie))
        };
        Precisions::doubling(128, 1024).raise(attempt).map(Attempt::best)
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
    pub(crate) fn stretch_at(&self, at: &Rational, side: Limit) -> Result<usize, EvaluateError> {
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
        if let Some(found) = self.marched.as_ref().and_then(|marched| self.marched_scale(marched)) {
            return Ok(found);
        }
        // What ends where the window begins is seen from the left only.
        let from = self.signal.slowness().scale(&self.from);
        let numbers = self.signal.numbers();
        let ended = numbers.compare(self.stretches[0].to(), &from)? != Ordering::Greater;
        let outside = usize::from(ended && self.stretches.len() > 1);
        for stretch in self.stretches.iter().skip(outside).step_by(stride) {
            let middle = (stretch.from() + stretch.to()).scale(&Rational::new(1.into(), 2.into()));
            for at in [stretch.from(), &middle, stretch.to()] {
                let value = self.refined(Magnitude::ZERO, |bits| {
                    let value = self.signal.enclose(stretch, 0, at, bits)?;
                    let fine = value.radius().scale(20) <= value.magnitude()
                        || value.magnitude() < Magnitude::power_of_two(-200);
                    Ok(Attempt::of(value, fine))
                })?;
                scale = scale.max(value.midpoint().magnitude());
            }
        }
        Ok(scale)
    }

    /// The same from a march: at the first, middle and last doubles of all stretches.
    fn marched_scale(&self, marched: &MarchedPieces) -> Option<Magnitude> {
        let stretches = (0..self.stretches.len()).filter_map(|stretch| self.doubles(stretch));
        let times: Vec<f64> = stretches
            .flat_map(|(first, last)| [first, first + (last - first) / 2.0, last])
            .collect();
        let (values, _) = marched.certified(&times, Limit::Right)?;
        Some(values.into_iter().map(Magnitude::from_double).max().unwrap_or(Magnitude::ZERO))
    }

    /// Raises precision from that of an error on.
    fn refined<T>(
        &self,
        error: Magnitude,
        attempt: impl Fn(u64) -> Result<Attempt<T>, EvaluateError>,
    ) -> Result<T, EvaluateError> {
        let wanted = error.top().map_or(0, |top| u64::try_from(-top).unwrap_or(0));
        let first = (wanted + SPARE_BITS).next_multiple_of(64);
        Precisions::doubling(first, MAX_BITS.max(first)).raise(attempt).map(Attempt::best)
    }

    /// The bits with which coefficients are finer than an error, at the end of the window, where they
    /// are least so.
    pub(crate) fn bits(&self, error: Magnitude) -> Result<u64, EvaluateError> {
        let stretch = self.stretches.last().expect("a window has a stretch");
        self.refined(error, |bits| {
            let value = self.signal.enclose(stretch, 0, stretch.to(), bits)?;
            Ok(Attempt::of(bits, value.radius().scale(12) <= error))
        })
    }

    /// All cells, in order, polynomials fitting as they shall.
    ///
    /// # Errors
    /// [`EvaluateError::TooManyCells`], and what stands in the way of enclosures.
    pub(crate) fn cells(&self, fit: Fit) -> Result<Vec<Cell>, EvaluateError> {
        let bits = match &self.marched {
            Some(marched) if marched.serves(fit.error) => MARCHED_BITS,
            _ => self.bits(fit.error)?,
        };
        let mut cells = Vec::new();
        // Stretches are much alike: each is first cut as often as its predecessor at least was.
        let mut depth = 0;
        let mut width = None;
        for stretch in 0..self.stretches.len() {
            let Some(doubles) = self.doubles(stretch) else { continue };
            if let Some(fitted) =
                fitted_cells::fitted(self.marched.as_ref(), doubles, fit, &mut width)
            {
                cells.extend(fitted.into_iter().map(|cell| Cell { stretch, ..cell }));
                if cells.len() > MAX_POLYNOMIALS {
                    return Err(EvaluateError::TooManyCells { limit: MAX_POLYNOMIALS });
                }
                continue;
            }
            let mut least = MAX_DEPTH;
            let spans = match &self.marched {
                Some(marched) if marched.serves(fit.error) => marched.spans(doubles),
                _ => vec![doubles],
            };
            let mut open: Vec<_> = spans.into_iter().rev().map(|span| (span, 0)).collect();
            while let Some(((first, last), halvings)) = open.pop() {
                let cell = match halvings < depth && first < last {
                    true => None,
                    false => self.fitting(stretch, (first, last), (fit, bits))?,
                };
                if let Some(cell) = cell {
                    least = least.min(halvings);
                    cells.push(cell);
                } else if halvings >= MAX_DEPTH || first >= last {
                    return Err(EvaluateError::TooSteep);
                } else {
                    let middle = first + (last - first) / 2.0;
                    let middle = middle.clamp(first, last.next_down());
                    open.push(((middle.next_up(), last), halvings + 1));
                    open.push(((first, middle), halvings + 1));
                }
                if cells.len() + open.len() > MAX_POLYNOMIALS {
                    return Err(EvaluateError::TooManyCells { limit: MAX_POLYNOMIALS });
                }
            }
            depth = least.saturating_sub(1);
        }
        Ok(cells)
    }

    /// The cell from `first` to `last`, where a polynomial fits.
    fn fitting(
        &self,
        stretch: usize,
        (first, last): (f64, f64),
        (fit, bits): (Fit, u64),
    ) -> Result<Option<Cell>, EvaluateError> {
        let middle = first + (last - first) / 2.0;
        // The difference of two doubles may be rounded: the next one is large enough. Times between
        // the cell's doubles and the next ones belong to it as well.
        let beside = first.abs().max(last.abs()) * f64::EPSILON;
        let half = (last - middle).max(middle - first).next_up() + beside;
        let half = half.max(f64::MIN_POSITIVE);
        let mut taylor = self.expand(stretch, (middle, half), (fit, bits))?;
        let loses = |most| first < last && taylor.rounding() > most;
        if taylor.remainder > fit.error || fit.rounding.is_some_and(loses) {
            return Ok(None);
        }
        let scale = power_of_two_above(half);
        taylor.stretch(&(rational(scale) / rational(half)), bits);
        Ok(Some(Cell { first, last, middle, scale, stretch, taylor }))
    }

    /// The polynomial in `(t − middle)/half`, its terms beyond the degree in the remainder.
    pub(crate) fn expand(
        &self,
        stretch: usize,
        (middle, half): (f64, f64),
        (fit, bits): (Fit, u64),
    ) -> Result<Taylor, EvaluateError> {
        let (middle, half) = (rational(middle), rational(half));
        let place = (&middle, &half);
        let mut taylor = match &self.marched {
            Some(marched) if marched.serves(fit.error) => marched.taylor(place, bits)?,
            _ => {
                // Twice as many terms tell what those beyond the degree are.
                let terms = 2 * fit.degree + 6;
                self.signal.taylor(&self.stretches[stretch], 0, place, terms, bits)?
            }
        };
        taylor.remainder = taylor.tail(fit.degree + 1);
        taylor.coefficients.truncate(fit.degree + 1);
        Ok(taylor)
    }
}

/// About the largest absolute value of a signal on a window, from the beginnings, middles and ends of
/// some stretches between arrivals; the largest one is not smaller by more than one part in 2^18.
///
/// # Errors
/// [`EvaluateError`], where the window has too many arrivals.
pub(crate) fn scale(
    signal: &ClosedForm,
    from: &Rational,
    to: &Rational,
) -> Result<f64, EvaluateError> {
    Ok(Window::new(signal, from, to)?.scale()?.to_double())
}

/// The stretch that an arrival ends at a time; `None` where nothing arrives then.
fn ending_at(signal: &ClosedForm, time: &Rational) -> Result<Option<Stretch>, EvaluateError> {
    // However little earlier: the stretches from there on end with that of the arrival alone.
    let little = (time.abs() + Rational::from_integer(1.into()))
        / Rational::from_integer((1_u64 << 60).into());
    let mut stretches = signal.stretches(&(time - little), time)?;
    let last = stretches.pop().expect("a window has a stretch");
    let scaled = signal.slowness().scale(time);
    match signal.numbers().compare(last.from(), &scaled)? {
        Ordering::Equal => Ok(stretches.pop()),
        _ => Ok(None),
    }
}

/// A finite double as a fraction.
pub(crate) fn rational(value: f64) -> Rational {
    Rational::from(&Binary::from_double(value).expect("a finite number"))
}

/// The least power of two that is at least as large as a positive double.
fn power_of_two_above(value: f64) -> f64 {
    let bits = value.to_bits();
    let fraction = bits & ((1 << 52) - 1);
    let below = f64::from_bits(bits - fraction);
    match (value.is_normal(), fraction) {
        (true, 0) => value,
        (true, _) => 2.0 * below,
        // Among the smallest numbers any power of two will do.
        (false, _) => f64::MIN_POSITIVE,
    }
}

/// The smallest double that is at least as large.
pub(crate) fn at_or_after(value: &Rational) -> f64 {
    let ball = Ball::from_rational(value, 80);
    let double = ball.midpoint().to_double();
    match rational(double) < *value {
        true => double.next_up(),
        false if rational(double.next_down()) >= *value => double.next_down(),
        false => double,
    }
}

/// The smallest double that is not before a time in the scale of the waves.
pub(crate) fn first_double(signal: &ClosedForm, time: &Fraction) -> Result<f64, EvaluateError> {
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
