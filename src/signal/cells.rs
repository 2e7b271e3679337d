//! A window of time cut into cells on which a signal is a short Taylor polynomial.
//!
//! A stretch between breaks is halved until a polynomial of the degree asked for follows the signal on each
//! part. Where a march knows the pieces of a stretch, and polynomials are meant for doubles, cells are instead
//! as wide as such polynomials allow, one after the other: how wide changes slowly but along fronts, so a width
//! is tried that is somewhat larger than that of the cell before, and smaller ones until a polynomial fits.
//! That it does is proven, from its doubles, against the pieces of the march. Cells begin and end at doubles.
//! Their middles are doubles and their scales powers of two, so that `u = (t − middle)/scale` is exact for
//! doubles beside the middle.

use crate::ball::{Attempt, Ball, Magnitude, Precisions, at_or_after, at_or_before, rational};
use crate::limits::{MAX_PIECES, MAX_POLYNOMIALS, pause};
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::marched_pieces::MarchedPieces;
use crate::signal::signal::{At, Enclosure, Limit, Signal};
use crate::signal::taylor::{Near, Taylor};
use std::cell::OnceCell;
use std::cmp::Ordering;
use wavestep_kernels::Piece;
use wavestep_kernels::fixed::{Interpolant, Spans};
use wavestep_polynomial::Rational;

/// How often a stretch is halved at most: beyond that nothing converges.
const MAX_DEPTH: u32 = 40;

/// Bits beyond those of the error aimed at, to begin with.
const SPARE_BITS: u64 = 40;

/// The most bits of balls.
const MAX_BITS: u64 = 1 << 15;

/// The bits of a first look.
const LOOK_BITS: u64 = 64;

/// The bits of balls around fixed-point numbers.
const MARCHED_BITS: u64 = 128;

/// How much wider than its predecessor a cell is tried.
const WIDER: f64 = 1.5;

/// How much narrower, while no polynomial fits.
const NARROWER: f64 = 0.75;

/// How often at most: a cell then is `10^−9` of the first one tried, where nothing converges.
const MOST_TRIES: u32 = 80;

/// The part of a stretch that the first cell is tried on.
const FIRST_PART: f64 = 1.0 / 8.0;

/// How long polynomials may be, and how exact they shall be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    /// The degree.
    pub degree: usize,
    /// A bound on the error, absolute.
    pub error: Magnitude,
    /// What rounding may cost when the polynomial is evaluated in doubles by Horner's scheme; where nothing
    /// is said, coefficients are kept in pairs of doubles.
    pub rounding: Option<Magnitude>,
}

/// A window as polynomials in doubles, one for each cell.
pub(crate) struct Pieces {
    /// In order.
    pub all: Vec<Piece>,
    /// For each stretch the first of its pieces, and the number of all pieces.
    pub firsts: Vec<usize>,
    /// The largest double of the last one.
    pub end: f64,
}

/// A signal with its cells, made as they are asked for.
pub(crate) struct Window<'a> {
    pub signal: &'a dyn Signal,
    /// The smallest doubles of the stretches, once they are asked for.
    firsts: OnceCell<Vec<f64>>,
    /// A march that knows all pieces of the signal, where there is one.
    pub marched: Option<MarchedPieces>,
    /// The precision that has done so far.
    bits: std::cell::Cell<u64>,
    /// Whether the signal is known to be zero on all of the window.
    vanishes: std::cell::Cell<bool>,
}

impl<'a> Window<'a> {
    /// All of a signal's window.
    pub(crate) fn new(signal: &'a dyn Signal) -> Window<'a> {
        let (firsts, bits, vanishes) = Default::default();
        Window { signal, firsts, marched: None, bits, vanishes }
    }

    /// The smallest doubles of the stretches; refused where there are too many.
    fn firsts(&self) -> Outcome<&[f64]> {
        if let Some(firsts) = self.firsts.get() {
            return Ok(firsts);
        }
        if let Ok(form) = self.signal.closed_form() {
            let order = form.order(self.signal.window()[1])?;
            if form.is_on_grid() && order > MAX_PIECES {
                let (echoes, limit) = (order as u128, MAX_PIECES);
                return Err(EvaluateError::TooManyEchoes { echoes, limit });
            }
            if self.marched.is_none() {
                form.foresee(self.signal.window()[1])?;
            }
        }
        let firsts = first_doubles(self.signal)?;
        Ok(self.firsts.get_or_init(|| firsts))
    }

    /// Takes pieces from a march in fixed-point numbers, where the signal has one pole and one lag and
    /// all its constants are rational numbers.
    pub(crate) fn marching(mut self) -> Window<'a> {
        self.marched = MarchedPieces::of(self.signal);
        self
    }

    /// How many stretches there are.
    pub(crate) fn count(&self) -> Outcome<usize> {
        Ok(self.firsts()?.len())
    }

    /// The double nearest to the value at a time, or next to it where that is not decided: balls with
    /// bits enough for all but ties.
    pub(crate) fn enclosed(&self, at: &Rational, side: Limit) -> Outcome<f64> {
        let enclose = enclosure(self.signal, at, side)?;
        let attempt = |bits| {
            let ball = enclose(bits)?;
            if let Some(value) = ball.rounded() {
                return Ok(Attempt::Done(value));
            }
            // An exact zero, or a tie, or no more than what is left out: nothing is gained by more bits.
            let is_tie = *ball.radius() <= ball.midpoint().magnitude().scale(-200);
            let has_left_out = self.knows_all(&ball);
            // What all these bits do not tell from zero is zero.
            let value = match ball.contains_zero() && !has_left_out {
                true => 0.0,
                false => ball.midpoint().to_double(),
            };
            Ok(Attempt::of(value, is_tie || has_left_out))
        };
        Precisions::doubling(128, 1024).raise(attempt).map(Attempt::best)
    }

    /// Whether echoes are left out, and little else is unknown: at most as much again.
    pub(crate) fn knows_all(&self, ball: &Ball) -> bool {
        let left_out = self.signal.left_out();
        !left_out.is_zero() && *ball.radius() <= left_out.scale(1)
    }

    /// The doubles of each stretch, the first and the last, where there are some.
    fn doubles(&self) -> Outcome<impl Iterator<Item = (usize, (f64, f64))>> {
        let firsts = self.firsts()?;
        let end = at_or_before(self.signal.window()[1]);
        let lasts = firsts.iter().skip(1).map(|next| next.next_down()).chain([end]);
        let doubles = firsts.iter().copied().zip(lasts).enumerate();
        Ok(doubles.filter(|(_, (first, last))| first <= last))
    }

    /// About the largest absolute value, by samples: at both ends of some of the stretches, in the middle, and where stretches
    /// are few, at times ever nearer to the beginning. The largest one on the window is at least that, but for one part in
    /// 2^18.
    pub(crate) fn scale(&self) -> Outcome<Magnitude> {
        /// How many stretches are looked at.
        const SAMPLES: usize = 40;
        let doubles = self.doubles()?.map(|(_, doubles)| doubles);
        if let Some(found) =
            self.marched.as_ref().and_then(|marched| marched_scale(marched, doubles))
        {
            return Ok(found);
        }
        let count = self.count()?;
        let mut scale = Magnitude::ZERO;
        // Something may arrive at the end of the window alone.
        let last = count - 1;
        for stretch in (0..last).step_by(count.div_ceil(SAMPLES)).chain([last]) {
            let between = self.between(stretch, (SAMPLES / count).max(1))?;
            let ends = [At::End(Limit::Right), At::End(Limit::Left)];
            for at in ends.into_iter().chain(between.iter().map(At::Time)) {
                let attempt = |bits| {
                    let value = self.signal.enclose(stretch, 0, at, bits)?;
                    let fine = value.radius().scale(20) <= value.magnitude()
                        || value.magnitude() < Magnitude::power_of_two(-200)
                        || self.knows_all(&value);
                    Ok::<_, EvaluateError>(Attempt::of(value, fine))
                };
                let value = Precisions::doubling(LOOK_BITS, MAX_BITS).raise(attempt)?.best();
                // What may be zero by cancellation counts as zero.
                if !value.contains_zero() {
                    scale = scale.max(value.midpoint().magnitude());
                }
            }
        }
        Ok(scale)
    }

    /// Whether the signal is zero on every stretch, also where waves cancel each other, as exact values prove.
    fn is_zero(&self) -> Outcome<bool> {
        let (signal, zero) = (self.signal, Rational::default());
        for stretch in 0..self.count()? {
            if signal.is_zero(stretch) {
                continue;
            }
            if signal.exact(stretch, At::End(Limit::Right))?.as_ref() != Some(&zero) {
                return Ok(false);
            }
            if !signal.is_instant(stretch) && !signal.equals(stretch, &zero)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// What errors are compared with: the largest value, or where no value but zero was found, what the
    /// signal comes to a little later.
    pub(crate) fn scale_of_errors(&self) -> Outcome<Magnitude> {
        const TERMS: usize = 12;
        /// How much later, as powers of two: the first at which terms fall off.
        const LATER: [i64; 5] = [-20, -30, -40, -60, -100];
        let scale = self.scale()?;
        if !scale.is_zero() {
            return Ok(scale);
        }
        self.vanishes.set(self.is_zero()?);
        let (last, to) = (self.count()? - 1, self.signal.window()[1]);
        let mut size = Magnitude::ZERO;
        for later in LATER {
            let later = Rational::from(&Magnitude::power_of_two(later));
            let near = Near { order: 0, place: (to, &later), terms: TERMS, bits: LOOK_BITS };
            let taylor = self.signal.taylor(last, near)?;
            size = taylor.tail(0);
            if taylor.remainder <= size.scale(-1) {
                break;
            }
        }
        Ok(size)
    }

    /// So many times within a stretch: about its middle, and each next one half as far from its beginning.
    fn between(&self, stretch: usize, count: usize) -> Outcome<Vec<Rational>> {
        let time = |end| match self.signal.exact_time(stretch, end) {
            Some(time) => Ok::<_, EvaluateError>(time),
            None => Ok(Rational::from(self.signal.time(stretch, end, LOOK_BITS)?.midpoint())),
        };
        let (from, mut to) = (time(Limit::Right)?, time(Limit::Left)?);
        let halved = (0..count).map(|_| {
            to = (&from + &to) / Rational::from_integer(2.into());
            to.clone()
        });
        Ok(halved.collect())
    }

    /// The polynomials of all cells, fitting as they shall.
    pub(crate) fn pieces(&self, fit: Fit) -> Outcome<Pieces> {
        let mut pieces = Pieces { all: Vec::new(), firsts: Vec::new(), end: f64::NAN };
        // Stretches are much alike: each is first cut as often as its predecessor at least was.
        let mut depth = 0;
        let mut width = None;
        let serves = |marched: &&MarchedPieces| marched.serves(fit.error) && !self.vanishes.get();
        let marched = self.marched.as_ref().filter(serves);
        for (stretch, doubles) in self.doubles()? {
            let all = &mut pieces.all;
            pieces.firsts.resize(stretch + 1, all.len());
            pieces.end = doubles.1;
            if let Some(fitted) = fitted(marched, doubles, fit, &mut width) {
                all.extend(fitted);
                admit(all.len())?;
                continue;
            }
            let mut least = MAX_DEPTH;
            let spans = marched.map_or_else(|| vec![doubles], |marched| marched.spans(doubles));
            let mut open: Vec<_> = spans.into_iter().rev().map(|span| (span, 0)).collect();
            while let Some(((first, last), halvings)) = open.pop() {
                pause();
                let piece = match halvings < depth && first < last {
                    true => None,
                    false => self.fitting(stretch, (first, last), fit)?,
                };
                if let Some(piece) = piece {
                    least = least.min(halvings);
                    all.push(piece);
                } else if halvings >= MAX_DEPTH || first >= last {
                    return Err(EvaluateError::TooSteep);
                } else {
                    let middle = first + (last - first) / 2.0;
                    let middle = middle.clamp(first, last.next_down());
                    open.push(((middle.next_up(), last), halvings + 1));
                    open.push(((first, middle), halvings + 1));
                }
                admit(all.len() + open.len())?;
            }
            depth = least.saturating_sub(1);
        }
        pieces.firsts.resize(self.count()? + 1, pieces.all.len());
        Ok(pieces)
    }

    /// The polynomial from `first` to `last`, where one fits; the rounding of its coefficients counts as part
    /// of its error.
    fn fitting(
        &self,
        stretch: usize,
        (first, last): (f64, f64),
        fit: Fit,
    ) -> Outcome<Option<Piece>> {
        let middle = first + (last - first) / 2.0;
        // The difference of two doubles may be rounded: the next one is large enough. Times between
        // the cell's doubles and the next ones belong to it as well.
        let beside = first.abs().max(last.abs()) * f64::EPSILON;
        let half = (last - middle).max(middle - first).next_up() + beside;
        let half = half.max(f64::MIN_POSITIVE);
        let mut taylor = self.expand(stretch, (middle, half), fit)?;
        let loses = |most| first < last && taylor.rounding() > most;
        if taylor.remainder > fit.error || fit.rounding.is_some_and(loses) {
            return Ok(None);
        }
        let scale = power_of_two_above(half);
        taylor.stretch(&(rational(scale) / rational(half)), self.bits.get().max(MARCHED_BITS));
        let (mut coefficients, mut low, mut error) = (Vec::new(), Vec::new(), taylor.remainder);
        for coefficient in &taylor.coefficients {
            let (double, distance) = if fit.rounding.is_some() {
                coefficient.to_double()
            } else {
                let (high, rest) = coefficient.split();
                let (rest, distance) = rest.to_double();
                low.push(rest);
                (high, distance)
            };
            coefficients.push(double);
            error = error.add(&distance);
        }
        let (scale, error) = (scale.recip(), error.to_double());
        Ok(Some(Piece { start: first, centre: middle, scale, coefficients, low, error }))
    }

    /// The polynomial in `(t − middle)/half`, its terms beyond the degree in the remainder; where it can
    /// fit, with coefficients that are far finer than the error.
    fn expand(&self, stretch: usize, (middle, half): (f64, f64), fit: Fit) -> Outcome<Taylor> {
        if self.vanishes.get() {
            return Ok(Taylor::polynomial(vec![Ball::zero(); fit.degree + 1]));
        }
        let (middle, half) = (rational(middle), rational(half));
        let place = (&middle, &half);
        let mut taylor = match &self.marched {
            Some(marched) if marched.serves(fit.error) => marched.taylor(place, MARCHED_BITS)?,
            _ => {
                let attempt = |bits| {
                    self.bits.set(bits);
                    // Twice as many terms tell what those beyond the degree are.
                    let terms = 2 * fit.degree + 6;
                    let taylor =
                        self.signal.taylor(stretch, Near { order: 0, place, terms, bits })?;
                    let radii = taylor.coefficients.iter().map(Ball::radius);
                    let radius = radii.fold(Magnitude::ZERO, |sum, radius| sum.add(radius));
                    let fine =
                        radius.scale(12) <= fit.error || taylor.tail(fit.degree + 1) > fit.error;
                    Ok::<_, EvaluateError>(Attempt::of(taylor, fine))
                };
                let first = self.bits.get().max(first_bits(fit.error));
                Precisions::doubling(first, MAX_BITS.max(first)).raise(attempt)?.best()
            }
        };
        taylor.remainder = taylor.tail(fit.degree + 1);
        taylor.coefficients.truncate(fit.degree + 1);
        Ok(taylor)
    }
}

/// A window that holds a double: itself, or begun at the double before it; beyond all doubles, itself.
pub fn reaching_a_double([from, to]: [Rational; 2]) -> [Rational; 2] {
    let first = at_or_after(&from);
    match first.is_finite() && rational(first) > to {
        true => [rational(first.next_down()), to],
        false => [from, to],
    }
}

/// About the largest absolute value of a signal on its window, from the beginnings, middles and ends of
/// some stretches; the largest one is not smaller by more than one part in 2^18.
pub fn scale(signal: &dyn Signal) -> Outcome<f64> {
    Ok(Window::new(signal).scale()?.to_double())
}

/// The largest value of a march at the first, middle and last doubles of all stretches.
fn marched_scale(
    marched: &MarchedPieces,
    stretches: impl Iterator<Item = (f64, f64)>,
) -> Option<Magnitude> {
    let times = stretches.flat_map(|(first, last)| [first, first + (last - first) / 2.0, last]);
    let (values, _) = marched.certified(&times.collect::<Vec<f64>>(), Limit::Right)?;
    Some(values.into_iter().map(Magnitude::from_double).max().unwrap_or(Magnitude::ZERO))
}

/// Enclosures of one limit at a time, from its stretch where that is known.
pub(crate) fn enclosure<'a>(
    signal: &'a dyn Signal,
    at: &'a Rational,
    side: Limit,
) -> Outcome<Enclosure<'a>> {
    Ok(match signal.stretch_at(at, side)? {
        Some(stretch) => Box::new(move |bits| signal.enclose(stretch, 0, At::Time(at), bits)),
        None => signal.point(at, side)?.enclose,
    })
}

/// Refuses more polynomials than are made.
fn admit(count: usize) -> Outcome<()> {
    match count > MAX_POLYNOMIALS {
        true => Err(EvaluateError::TooManyCells { limit: MAX_POLYNOMIALS }),
        false => Ok(()),
    }
}

/// The bits of balls with which an error is aimed at.
fn first_bits(error: Magnitude) -> u64 {
    let wanted = error.top().map_or(0, |top| u64::try_from(-top).unwrap_or(0));
    (wanted + SPARE_BITS).next_multiple_of(64)
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

/// The smallest doubles that are not before the beginnings of the stretches, that of the window
/// included.
pub fn first_doubles(signal: &dyn Signal) -> Outcome<Vec<f64>> {
    let mut firsts = vec![at_or_after(signal.window()[0])];
    for stretch in 1..signal.count()? {
        firsts.push(first_double(signal, stretch)?);
    }
    Ok(firsts)
}

/// The smallest double that is not before the beginning of a stretch.
fn first_double(signal: &dyn Signal, stretch: usize) -> Outcome<f64> {
    if let Some(time) = signal.exact_time(stretch, Limit::Right) {
        return Ok(at_or_after(&time));
    }
    let follows = |double: f64| -> Outcome<bool> {
        let time = signal.scaled_time(&rational(double));
        Ok(signal.begins(stretch, &time)? != Ordering::Greater)
    };
    let mut double = signal.time(stretch, Limit::Right, 128)?.midpoint().to_double();
    while !follows(double)? {
        double = double.next_up();
    }
    while follows(double.next_down())? {
        double = double.next_down();
    }
    Ok(double)
}

/// The polynomials of a range of doubles; `width` is that of the last cell of the range before, and becomes
/// that of this one. None where there is no march, where nothing is said about rounding, and where no
/// polynomials are found.
fn fitted(
    marched: Option<&MarchedPieces>,
    (first, last): (f64, f64),
    fit: Fit,
    width: &mut Option<f64>,
) -> Option<Vec<Piece>> {
    let rounding = fit.rounding?.to_double();
    let spans = marched?.of_period((first, last), fit.degree)?;
    let limits = [fit.error.to_double(), rounding];
    let mut pieces = Vec::new();
    let mut start = first;
    let mut tried = width.map_or((last - first) * FIRST_PART, |width| width * WIDER);
    loop {
        pause();
        let (end, found) = (0..MOST_TRIES).find_map(|_| {
            let rest = last - start;
            let end = if tried >= rest {
                last
            } else {
                // What is left shall not be a sliver.
                (start + tried.min(rest / 2.0)).next_down().max(start)
            };
            tried = (end - start) * NARROWER;
            Some((end, interpolating(&spans, (start, end), limits)?))
        })?;
        *width = Some(end - start);
        pieces.push(found);
        if end >= last {
            return Some(pieces);
        }
        tried = (end - start) * WIDER;
        start = end.next_up();
    }
}

/// The polynomial on a range of doubles, where one is near enough and loses little when evaluated.
///
/// Its coefficients are doubles, so the distance holds what rounding them costs, some `ε Σ|c_k| r^k`. The
/// rounding of Horner's scheme is `ε (T_0 + 2 Σ_{1≤k<n} T_k + T_n)`, `T_k = Σ_{j≥k} |c_j| r^j`.
fn interpolating(
    spans: &Spans,
    (first, last): (f64, f64),
    [error, rounding]: [f64; 2],
) -> Option<Piece> {
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
    let (scale, coefficients) = (scale.recip(), interpolant.coefficients);
    let finite = coefficients.iter().all(|coefficient| coefficient.is_finite());
    let piece = Piece {
        start: first,
        centre: middle,
        scale,
        coefficients,
        low: Vec::new(),
        error: distance,
    };
    finite.then_some(piece)
}
