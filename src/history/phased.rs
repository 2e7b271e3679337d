//! An observable across all phases of a scene's contacts, as a signal.

use crate::ball::{Attempt, Ball, Magnitude, Number, Precisions};
use crate::enclosure::EnclosureError;
use crate::expression::{Expression, Fraction, Root};
use crate::history::engine::Engine;
use crate::history::error::{HistoryError, Outcome};
use crate::history::follower::Follower;
use crate::history::moment::Moment;
use crate::history::part::{Part, Source};
use crate::history::series::{Series, Truncation};
use crate::limits::MAX_HISTORY_BITS;
use crate::network::{Network, Observed, Squared, Term};
use crate::scene::Dimension;
use crate::signal::{
    At, Effort, EvaluateError, Instant, Known, Limit, MAX_FLATNESS, Near, Point, Signal, Signed,
    Silence, Taylor,
};
use num_traits::Zero as _;
use std::borrow::Cow;
use std::cell::{Cell, OnceCell, RefCell};
use std::cmp::Ordering;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// The highest precision in bits that a search has.
const SEARCH_BITS: u64 = 640;

/// Stretches whose ends are known with so many bits can be searched.
const ENOUGH_BITS: i64 = 96;

/// Where fewer are left, stretches are counted again with more, up to these.
const COUNTED_BITS: u64 = 1500;

/// A value with fewer bits left tells nothing.
const LEAST_BITS: i64 = 16;

/// Bits that a value has lost about, compared with the precision it was worked out with.
const SPARE_BITS: u64 = 64;

/// A value below two to the minus this is suspected to be zero.
const NEGLIGIBLE_BITS: i64 = 64;

/// An observable between two breaks.
struct Piece {
    /// Its first instant and its last.
    ends: [Moment; 2],
    /// When it begins, and how long it lasts.
    course: [Number; 2],
    /// From its first instant on, in the user's units and the time of the scene.
    series: Series,
    /// The sizes of the parts it is the sum of.
    size: Magnitude,
}

impl Piece {
    /// Whether another series that begins at an instant is this one, known to be: constants that meet
    /// without a jump, or polynomials with rational coefficients.
    fn goes_on(
        &self,
        other: &Series,
        at: &Moment,
        is_continuous: bool,
        engine: &Engine,
    ) -> Result<bool, EnclosureError> {
        if is_continuous && self.series.is_constant() && other.is_constant() {
            return Ok(true);
        }
        let exact = self.series.is_exact() && other.is_exact();
        let length = engine.clock.since(&self.ends[0], at)?;
        let shifted = self.series.shift(&length, &engine.cut);
        Ok(exact && shifted.coefficients == other.coefficients)
    }
}

/// What is known at one precision.
struct Followed {
    engine: Rc<Engine>,
    parts: Vec<Part>,
    /// How many times their sum is integrated.
    integrated: usize,
    /// Made when stretches are first asked for.
    pieces: OnceCell<Vec<Piece>>,
    /// The unit of time, and one over it.
    unit: [Number; 2],
}

/// The parts of what is seen, at the precision of an engine.
type Parts<'a> = Box<dyn Fn(&Engine) -> Outcome<Vec<Part>> + 'a>;

/// What is seen of a scene.
struct Seen<'a> {
    parts: Parts<'a>,
    /// How many times their sum is integrated over time from the beginning of the window on.
    integrated: usize,
}

/// An observable of a scene whose contacts open, on a window of the user's time.
pub(crate) struct FollowedSignal<'a> {
    follower: Rc<Follower<'a>>,
    seen: Seen<'a>,
    window: [Rational; 2],
    silence: Option<Silence>,
    /// The highest precision of stretches.
    most_bits: u64,
    /// From so many bits on there are other stretches than those that were counted.
    other_stretches: Cell<u64>,
    known: RefCell<Rc<Followed>>,
    /// How many stretches there are, once that is asked.
    count: OnceCell<Outcome<usize>>,
}

impl<'a> FollowedSignal<'a> {
    /// An observable that is linear in the motion.
    pub fn observable(
        follower: &Rc<Follower<'a>>,
        observed: &Observed,
        window: [&Rational; 2],
    ) -> Outcome<Self> {
        if window[1] < window[0] || *window[0] < Rational::zero() {
            return Err(EvaluateError::EmptyWindow.into());
        }
        let readings = (&*observed.readings, &observed.unit);
        let signal = FollowedSignal::linear(follower, readings, window)?;
        Ok(FollowedSignal { silence: Silence::of(follower.network, observed), ..signal })
    }

    /// A sum of readings, in a unit, of a scene that is followed already.
    pub fn linear(
        follower: &Rc<Follower<'a>>,
        (readings, unit): (&[Term], &Root),
        window: [&Rational; 2],
    ) -> Outcome<Self> {
        let (network, readings, unit) = (follower.network, readings.to_vec(), unit.clone());
        let parts = Box::new(move |engine: &Engine| engine.parts(network, &readings, &unit));
        FollowedSignal::seen(follower, Seen { parts, integrated: 0 }, window)
    }

    /// What an energy is the square of, in the scale of the scene; its stretches are known with the
    /// precision of values.
    pub(crate) fn squared(
        follower: &Rc<Follower<'a>>,
        squared: &Squared,
        window: [&Rational; 2],
    ) -> Outcome<Self> {
        let (network, squared) = (follower.network, squared.clone());
        let parts = Box::new(move |engine: &Engine| match &squared {
            Squared::Reading(reading) => {
                engine.reading(engine.elements(network), reading, &Number::one())
            }
            Squared::Entering { bar, direction } => Ok(vec![entering(*bar, *direction)]),
        });
        let signal = FollowedSignal::seen(follower, Seen { parts, integrated: 0 }, window)?;
        let most_bits = follower.most_bits(&follower.known.borrow());
        Ok(FollowedSignal { most_bits, ..signal })
    }

    /// What a wave that enters a bar, to the right (0) or to the left (1), adds to its state at the start,
    /// integrated so many times from the beginning of the window on; in the scale of the scene.
    pub(crate) fn entering(
        follower: &Rc<Follower<'a>>,
        (bar, direction): (usize, usize),
        integrated: usize,
        window: [&Rational; 2],
    ) -> Outcome<Self> {
        let parts = Box::new(move |_: &Engine| {
            let before = Source::Wave { bar, direction, delay: None };
            Ok(vec![entering(bar, direction), Part::of(before, Number::integer(-1))])
        });
        let signal = FollowedSignal::seen(follower, Seen { parts, integrated }, window)?;
        let most_bits = follower.most_bits(&follower.known.borrow());
        Ok(FollowedSignal { most_bits, ..signal })
    }

    fn seen(follower: &Rc<Follower<'a>>, seen: Seen<'a>, window: [&Rational; 2]) -> Outcome<Self> {
        let engine = Rc::clone(&follower.known.borrow());
        let most_bits = SEARCH_BITS.min(follower.most_bits(&engine));
        let known = RefCell::new(Rc::new(Followed::of(follower.network, engine, &seen)?));
        let (follower, window) = (Rc::clone(follower), window.map(Clone::clone));
        let other_stretches = Cell::new(u64::MAX);
        Ok(FollowedSignal {
            follower,
            seen,
            window,
            silence: None,
            most_bits,
            other_stretches,
            known,
            count: OnceCell::new(),
        })
    }

    /// Finds all breaks, so that stretches can be asked for.
    pub fn cut_at_breaks(self) -> Outcome<Self> {
        self.counted()?;
        Ok(self)
    }

    /// How many stretches there are, which is found out once.
    fn counted(&self) -> Outcome<usize> {
        self.count.get_or_init(|| self.counted_with_enough()).clone()
    }

    /// The same with so many bits that enough are left at the ends of all stretches, if that can be: a light mass between
    /// long bars loses some at each return of a wave, and each event some more. How many are lost hardly depends on how many
    /// there are. Where none is left however many there are, an instant was taken for another one.
    fn counted_with_enough(&self) -> Outcome<usize> {
        let is_local = self.follower.network.local_contact().is_some();
        let mut before = i64::MIN;
        loop {
            let known = Rc::clone(&self.known.borrow());
            let pieces = known.pieces(self.follower.network, &self.window)?;
            let (bits, left) = (known.engine.cut.bits, known.bits_left(pieces));
            let more = (bits + ENOUGH_BITS.saturating_sub(left).max(0) as u64).min(2 * bits);
            let is_in_vain = left <= std::mem::replace(&mut before, left);
            if is_local || left >= ENOUGH_BITS || more > COUNTED_BITS || is_in_vain {
                return Ok(pieces.len());
            }
            let engine = self.follower.engine(more);
            if engine.cut.bits <= bits {
                return match &*self.follower.refusal.borrow() {
                    Some(refusal) if left < LEAST_BITS => Err(refusal.clone()),
                    _ => Ok(pieces.len()),
                };
            }
            let finer = Followed::of(self.follower.network, engine, &self.seen)?;
            *self.known.borrow_mut() = Rc::new(finer);
        }
    }

    /// What is known at a precision; where more is known, that. Stretches that were counted stay: how many cells a local
    /// contact begins with, and how long a fast motion takes to die out, depends on the precision.
    fn followed(&self, bits: u64) -> Result<Rc<Followed>, EvaluateError> {
        let known = Rc::clone(&self.known.borrow());
        let counted = known.pieces.get().map(Vec::len);
        let is_fixed =
            self.follower.network.local_contact().is_some() || bits >= self.other_stretches.get();
        if counted.is_some() && is_fixed {
            return Ok(known);
        }
        let engine = self.follower.engine(bits);
        if Rc::ptr_eq(&engine, &known.engine) {
            return Ok(known);
        }
        let found = engine.cut.bits;
        let wanting = |_| EvaluateError::NotFollowed { bits: found };
        let network = self.follower.network;
        let finer = Followed::of(network, engine, &self.seen).map_err(wanting)?;
        if let Some(counted) = counted
            && finer.pieces(network, &self.window).map_err(wanting)?.len() != counted
        {
            self.other_stretches.set(bits);
            return Ok(known);
        }
        let finer = Rc::new(finer);
        *self.known.borrow_mut() = Rc::clone(&finer);
        Ok(finer)
    }

    /// The same for values at times, for which other stretches will do.
    fn followed_for_values(&self, bits: u64) -> Result<Rc<Followed>, EvaluateError> {
        let known = self.followed(bits)?;
        let engine = self.follower.engine(bits);
        let found = engine.cut.bits;
        match found > known.engine.cut.bits {
            true => Followed::of(self.follower.network, engine, &self.seen)
                .map(Rc::new)
                .map_err(|_| EvaluateError::NotFollowed { bits: found }),
            false => Ok(known),
        }
    }

    /// Stretches at this precision, capped at `most_bits`.
    fn cut(&self, bits: u64) -> Result<Rc<Followed>, EvaluateError> {
        self.followed(bits.min(self.most_bits))
    }

    /// The value at a time, where it is read off stretches.
    fn integral(&self, at: &Rational, limit: Limit) -> Result<Point<'_>, EvaluateError> {
        let Some(stretch) = self.stretch_at(at, limit)? else {
            return Ok(Point::exact(Rational::zero()));
        };
        if let Some(value) = self.exact(stretch, At::Time(at))? {
            return Ok(Point::exact(value));
        }
        let at = at.clone();
        Ok(undecided_point(move |bits| self.enclose(stretch, 0, At::Time(&at), bits)))
    }

    /// The time from the first instant of a piece.
    fn since(
        &self,
        followed: &Followed,
        stretch: usize,
        at: At<'_>,
    ) -> Result<Number, EvaluateError> {
        let Piece { ends: [from, _], course: [start, length], .. } = followed.piece(stretch);
        let clock = &followed.engine.clock;
        Ok(match at {
            At::End(Limit::Right) => Number::zero(),
            At::End(Limit::Left) => length.clone(),
            At::Time(time) => {
                let since = followed.scaled(time).subtract(start, clock.bits);
                match since.sign() {
                    Some(_) => since,
                    // It may be the first instant itself.
                    None => clock.since(from, &Moment::at(self.scaled_time(time)))?,
                }
            }
            At::Scaled(time) => clock.since(from, &Moment::at(time.clone()))?,
        })
    }
}

/// A value of which enclosures alone are known.
fn undecided_point<'a>(enclose: impl Fn(u64) -> Result<Ball, EvaluateError> + 'a) -> Point<'a> {
    Point {
        known: Known::Unknown,
        negligible: Magnitude::power_of_two(-NEGLIGIBLE_BITS),
        most_bits: MAX_HISTORY_BITS,
        ..Point::irrational(enclose)
    }
}

/// A wave as it enters a bar.
fn entering(bar: usize, direction: usize) -> Part {
    Part::of(Source::Wave { bar, direction, delay: Some(Fraction::zero()) }, Number::one())
}

impl Followed {
    fn of(network: &Network, engine: Rc<Engine>, seen: &Seen<'_>) -> Outcome<Followed> {
        let parts = (seen.parts)(&engine)?;
        let time = engine.unit(network, Dimension::TIME)?;
        let inverse = time.reciprocal(engine.cut.bits)?;
        let (integrated, pieces) = (seen.integrated, OnceCell::new());
        Ok(Followed { engine, parts, integrated, pieces, unit: [time, inverse] })
    }

    fn pieces(&self, network: &Network, window: &[Rational; 2]) -> Outcome<&[Piece]> {
        if let Some(pieces) = self.pieces.get() {
            return Ok(pieces);
        }
        let engine = &self.engine;
        let parts = &self.parts;
        let ends = window.each_ref().map(|time| Moment::at(network.scaled_time(time)));
        let mut starts = vec![ends[0].clone()];
        starts.extend(engine.breaks(parts, &ends)?);
        let mut pieces: Vec<Piece> = Vec::new();
        let is_continuous = parts.iter().all(|part| engine.is_continuous(part));
        for (number, start) in starts.iter().enumerate() {
            let end = starts.get(number + 1).unwrap_or(&ends[1]);
            let (series, size) = sum(engine, parts, start)?;
            match pieces.last_mut() {
                Some(last) if last.goes_on(&series, start, is_continuous, engine)? => {
                    last.course[1] = engine.clock.since(&last.ends[0], end)?;
                    last.ends[1] = end.clone();
                }
                _ => {
                    let course = [engine.clock.time(start)?, engine.clock.since(start, end)?];
                    pieces.push(Piece { ends: [start.clone(), end.clone()], course, series, size });
                }
            }
        }
        (0..self.integrated).for_each(|_| integrate(&mut pieces, engine));
        Ok(self.pieces.get_or_init(|| pieces))
    }

    /// With how many bits the values at the ends of pieces are known, compared with the largest.
    fn bits_left(&self, pieces: &[Piece]) -> i64 {
        let cut = &self.engine.cut;
        let (mut size, mut error) = (Magnitude::ZERO, Magnitude::ZERO);
        for Piece { course: [_, length], series, size: first, .. } in pieces {
            let last = series.value(length, cut).ball(cut.bits);
            size = size.max(*first).max(last.magnitude());
            error = error.max(*last.radius());
        }
        let Some(error) = error.top() else { return i64::MAX };
        size.top().map_or(0, |size| size - error)
    }

    /// A length of the user's time in the scale of the scene.
    fn scaled(&self, time: &Rational) -> Number {
        let bits = self.engine.cut.bits;
        Number::of_rational(time.clone(), bits).multiply(&self.unit[1], bits)
    }

    fn piece(&self, stretch: usize) -> &Piece {
        &self.pieces.get().expect("stretches were counted before they are asked for")[stretch]
    }

    /// How far times up to `h` from one go beyond the ends of a piece at most.
    fn beyond(&self, stretch: usize, at: &Number, h: &Number) -> Magnitude {
        let ([_, length], bits) = (&self.piece(stretch).course, self.engine.cut.bits);
        let after = at.add(h, bits).subtract(length, bits);
        let positive = |time: Number| match time.sign() {
            Some(Ordering::Less | Ordering::Equal) => Magnitude::ZERO,
            _ => time.magnitude(),
        };
        positive(after).max(positive(h.subtract(at, bits)))
    }

    /// The derivative of an order with respect to the user's time, from the first instant of a piece on.
    fn derivative(&self, stretch: usize, order: usize) -> Cow<'_, Series> {
        let (cut, inverse) = (&self.engine.cut, &self.unit[1]);
        (0..order).fold(Cow::Borrowed(&self.piece(stretch).series), |series, _| {
            let slope = series.derivative(cut);
            Cow::Owned(slope.combine(inverse, &Series::zero(), &Number::zero(), cut.bits))
        })
    }
}

/// Replaces a function by its integral from the first instant on.
fn integrate(pieces: &mut [Piece], engine: &Engine) {
    let mut sum = Number::zero();
    for Piece { course: [_, length], series, size, .. } in pieces {
        *size = (*size).max(sum.magnitude());
        *series = series.integral(sum, &engine.cut);
        sum = series.value(length, &engine.cut);
    }
}

/// The sum of parts from an instant on, and of their sizes.
fn sum(engine: &Engine, parts: &[Part], now: &Moment) -> Outcome<(Series, Magnitude)> {
    let (mut sum, mut size) = (Series::zero(), Magnitude::ZERO);
    for part in parts {
        let series = engine.series_of(part, now)?;
        size = size.add(&series.coefficient(0).magnitude());
        sum = sum.add(&series, engine.cut.bits);
    }
    Ok((sum, size))
}

impl Engine {
    /// When any of some parts may change its series, after a first instant and until a last one, in
    /// order.
    fn breaks(&self, parts: &[Part], [from, to]: &[Moment; 2]) -> Outcome<Vec<Moment>> {
        let mut breaks: Vec<Moment> = Vec::new();
        for list in parts.iter().flat_map(|part| self.breaks_of(part)) {
            let mut own = Vec::new();
            for moment in list {
                let after = self.clock.compare(&moment, from)? == Ordering::Greater;
                if after && self.clock.compare(&moment, to)? != Ordering::Greater {
                    own.push(moment);
                }
            }
            breaks = self.merged(breaks, own)?;
        }
        Ok(breaks)
    }

    /// Two lists of instants in order as one, each instant once.
    fn merged(&self, one: Vec<Moment>, other: Vec<Moment>) -> Outcome<Vec<Moment>> {
        let mut merged = Vec::with_capacity(one.len() + other.len());
        let mut one = one.into_iter().peekable();
        for moment in other {
            let mut order = Ordering::Less;
            while let (Ordering::Less, Some(next)) = (order, one.peek()) {
                order = self.clock.compare(next, &moment)?;
                if order != Ordering::Greater {
                    merged.extend(one.next());
                }
            }
            if order != Ordering::Equal {
                merged.push(moment);
            }
        }
        merged.extend(one);
        Ok(merged)
    }
}

impl Signal for FollowedSignal<'_> {
    fn window(&self) -> [&Rational; 2] {
        self.window.each_ref()
    }

    fn point(&self, at: &Rational, limit: Limit) -> Result<Point<'_>, EvaluateError> {
        if self.seen.integrated > 0 {
            return self.integral(at, limit);
        }
        let now = self.scaled_time(at);
        if self.silence.as_ref().is_some_and(|silence| silence.holds([(&now, limit); 2])) {
            return Ok(Point::exact(Rational::zero()));
        }
        let moment = Moment::at(now);
        let value = move |bits: u64| -> Result<Number, EvaluateError> {
            let mut first = self.known.borrow().engine.cut.bits;
            // Beside a local contact it is cheaper to see that what is known is not enough.
            let is_local = self.follower.network.local_contact().is_some();
            if bits > first << u32::from(is_local) {
                first = (bits + SPARE_BITS).max((2 * first).min(MAX_HISTORY_BITS));
            }
            let attempt = |bits| {
                let followed = self.followed_for_values(bits)?;
                match followed.engine.sum_of(&followed.parts, (&moment, limit)) {
                    Ok(value) => Ok(Attempt::Done(value)),
                    Err(error @ HistoryError::Undecided { .. }) => {
                        Ok(Attempt::NotYet(error.of_value(bits)))
                    }
                    Err(error) => Err(error.of_value(bits)),
                }
            };
            Precisions::growing_by_half(first, MAX_HISTORY_BITS).raise(attempt)?.done()
        };
        match value(0)? {
            Number::Exact(exact) => return Ok(Point::exact(exact)),
            Number::Enclosed(ball) if ball.is_exact() => {
                return Ok(Point::exact(ball.midpoint().into()));
            }
            Number::Enclosed(_) => {}
        }
        Ok(undecided_point(move |bits| Ok(value(bits)?.ball(bits))))
    }

    fn most_bits(&self) -> u64 {
        self.most_bits.max(self.ready_bits())
    }

    fn ready_bits(&self) -> u64 {
        self.known.borrow().engine.cut.bits
    }

    fn instant(&self, stretch: usize) -> Option<Instant> {
        // All signals of one follower have to tell of the same engine.
        let known = self.followed(0).ok()?;
        let Moment { event, delay } = &known.piece(stretch).ends[0];
        let clock = &known.engine.clock;
        let bits = if clock.has_ties() { clock.bits } else { 0 };
        let event = event.map(|event| (bits, event));
        let scene = std::ptr::from_ref(self.follower.network).addr();
        Some(Instant { scene, event, delay: delay.clone() })
    }

    /// Polynomials with rational coefficients, on stretches that begin at an exact time.
    fn exact_at(&self, stretch: usize, at: &Fraction, _: Effort) -> Option<Expression> {
        let known = self.known.borrow();
        let Piece { ends: [from, _], series, .. } = known.piece(stretch);
        if from.event.is_some() || !series.rest.is_zero() {
            return None;
        }
        let (x, mut sum) = (at - &from.delay, Fraction::zero());
        for coefficient in series.coefficients.iter().rev() {
            sum = &(&sum * &x) + &Fraction::constant(coefficient.exact()?);
        }
        Some(sum.into())
    }

    fn count(&self) -> Result<usize, EvaluateError> {
        let bits = self.cut(0)?.engine.cut.bits;
        self.counted().map_err(|error| error.of_value(bits))
    }

    fn scaled_time(&self, time: &Rational) -> Fraction {
        self.follower.network.scaled_time(time)
    }

    fn begins(&self, stretch: usize, at: &Fraction) -> Result<Ordering, EvaluateError> {
        let at = Moment::at(at.clone());
        let attempt = |bits| {
            let followed = self.cut(bits)?;
            let order = followed.engine.clock.compare(&followed.piece(stretch).ends[0], &at);
            Ok(order.map_or_else(|error| Attempt::NotYet(error.of_value(bits)), Attempt::Done))
        };
        let known = self.known.borrow().engine.cut.bits;
        let precisions = Precisions::growing_by_half(known, self.most_bits);
        precisions.raise(attempt).and_then(Attempt::done)
    }

    fn is_instant(&self, stretch: usize) -> bool {
        let known = self.known.borrow();
        let [from, to] = &known.piece(stretch).ends;
        from == to
    }

    fn is_zero(&self, stretch: usize) -> bool {
        let known = self.known.borrow();
        let Piece { ends: [from, to], series, .. } = known.piece(stretch);
        let since_start = from.event.is_none() && to.event.is_none();
        let ends = [(&from.delay, Limit::Right), (&to.delay, Limit::Left)];
        let is_silent = |silence: &Silence| since_start && silence.holds(ends);
        series.is_zero() || self.silence.as_ref().is_some_and(is_silent)
    }

    fn signed(&self, stretch: usize) -> Option<Signed> {
        self.known.borrow().piece(stretch).series.signed
    }

    fn exact_time(&self, stretch: usize, end: Limit) -> Option<Rational> {
        let known = self.known.borrow();
        let pieces = known.pieces.get().map_or(&[][..], Vec::as_slice);
        match end {
            Limit::Right if stretch == 0 => return Some(self.window[0].clone()),
            Limit::Left if stretch + 1 == pieces.len() => return Some(self.window[1].clone()),
            _ => {}
        }
        let Moment { event, delay } = &pieces[stretch].ends[usize::from(end == Limit::Left)];
        let since_start = event.is_none().then(|| delay.as_constant())??;
        Some(since_start * known.unit[0].exact()?)
    }

    fn time(&self, stretch: usize, end: Limit, bits: u64) -> Result<Ball, EvaluateError> {
        let place = usize::from(end == Limit::Left);
        if let Moment { event: None, delay } = &self.known.borrow().piece(stretch).ends[place] {
            return self.follower.scale.time(delay, bits);
        }
        let followed = self.cut(bits)?;
        let time = followed.engine.clock.time(&followed.piece(stretch).ends[place])?;
        Ok(time.multiply(&followed.unit[0], followed.engine.cut.bits).ball(bits))
    }

    fn enclose(
        &self,
        stretch: usize,
        order: usize,
        at: At<'_>,
        bits: u64,
    ) -> Result<Ball, EvaluateError> {
        let followed = self.cut(bits)?;
        let at = self.since(&followed, stretch, at)?;
        let beyond = followed.beyond(stretch, &at, &Number::zero());
        let cut = &followed.engine.cut;
        Ok(followed.derivative(stretch, order).extended(&beyond, cut).value(&at, cut).ball(bits))
    }

    fn taylor(
        &self,
        stretch: usize,
        Near { order, place: (middle, half), terms, bits }: Near<'_>,
    ) -> Result<Taylor, EvaluateError> {
        let followed = self.cut(bits)?;
        // A finer history may be known than is asked for.
        let cut = &Truncation { bits: followed.engine.cut.bits.min(bits), ..followed.engine.cut };
        let at = self.since(&followed, stretch, At::Time(middle))?;
        let h = followed.scaled(half);
        let beyond = followed.beyond(stretch, &at, &h);
        let series = followed.derivative(stretch, order).extended(&beyond, cut);
        // Rational numbers beside balls cost more than they tell.
        let place = |time: Number| match series.is_exact() {
            true => time,
            false => time.enclosed(cut.bits),
        };
        let (at, h) = (place(at), place(h));
        let (near, remainder) = series.about(&at, &h.magnitude(), terms, cut);
        let mut power = Number::one();
        let mut coefficients = Vec::with_capacity(terms);
        for c in near {
            coefficients.push(c.multiply(&power, cut.bits).ball(bits));
            power = power.multiply(&h, cut.bits);
        }
        Ok(Taylor { coefficients, remainder })
    }

    fn size(
        &self,
        stretch: usize,
        order: usize,
        at: &Rational,
        bits: u64,
    ) -> Result<(Magnitude, Magnitude), EvaluateError> {
        let value = self.enclose(stretch, order, At::Time(at), bits)?;
        let size = self.cut(bits)?.piece(stretch).size;
        Ok((size.max(value.magnitude()), *value.radius()))
    }

    fn exact(&self, stretch: usize, at: At<'_>) -> Result<Option<Rational>, EvaluateError> {
        let followed = self.cut(0)?;
        if self.is_zero(stretch) {
            return Ok(Some(Rational::zero()));
        }
        let end = &followed.piece(stretch).ends[1];
        let zero = |part| followed.engine.vanishes_before(part, end);
        if matches!(at, At::End(Limit::Left)) && followed.parts.iter().all(zero) {
            return Ok(Some(Rational::zero()));
        }
        let at = self.since(&followed, stretch, at)?;
        let value = followed.piece(stretch).series.value(&at, &followed.engine.cut);
        Ok(value.exact().cloned())
    }

    fn flatness(&self, stretch: usize, end: Limit, order: usize) -> Result<usize, EvaluateError> {
        let followed = self.cut(0)?;
        let at = self.since(&followed, stretch, At::End(end))?;
        let (engine, last) = (&followed.engine, &followed.piece(stretch).ends[1]);
        let slope = |part| {
            let slope = engine.slope_of(part);
            slope.is_some_and(|slope| engine.vanishes_before(&slope, last))
        };
        let is_zero = |order: &usize| {
            let by_law = end == Limit::Left
                && match order {
                    0 => followed.parts.iter().all(|part| engine.vanishes_before(part, last)),
                    1 => followed.parts.iter().all(slope),
                    _ => false,
                };
            by_law || followed.derivative(stretch, *order).value(&at, &engine.cut).is_zero()
        };
        Ok((order..order + MAX_FLATNESS).take_while(is_zero).count())
    }

    /// Known where the series itself is constant; a sum of exponentials that happens to be is not.
    fn equals(&self, stretch: usize, value: &Rational) -> Result<bool, EvaluateError> {
        let followed = self.cut(0)?;
        let series = &followed.piece(stretch).series;
        Ok(series.is_exact()
            && series.is_constant()
            && series.coefficient(0).exact() == Some(value))
    }
}
