//! Operations on signals: sums of products and integrals of those of one scene, differences of those of two.
//!
//! The stretches of the result are cut where an operand breaks. Breaks of two operands that are the same
//! exact instant are one, whatever their enclosures tell; others are put in order by enclosures that are
//! narrowed until they part. A [`Rule`] says what the result is on a stretch; [`Operation`] makes a signal
//! of it.

mod balanced;
mod combination;
mod constant;
mod difference;
mod integral;
mod observed;
mod vibration;

pub(crate) use balanced::Balanced;
pub(crate) use combination::{Combination, Product};
pub(crate) use constant::Constant;
pub(crate) use difference::Difference;
pub(crate) use integral::Integral;
pub use observed::of_recurrence;
pub(crate) use vibration::Vibrating;

use crate::ball::{Attempt, Ball, Magnitude, Precisions};
use crate::enclosure::Numbers;
use crate::expression::{Assumptions, Constant as Named, Expression, Fraction, Root};
use crate::network::Network;
use crate::recurrence::Recurrence;
use crate::signal::error::Outcome;
use crate::signal::signal::in_unit;
use crate::signal::{
    At, ClosedForm, EchoCount, Effort, Enclosure, EvaluateError, Instant, Known, Limit,
    MAX_FLATNESS, Near, Point, Signal, Taylor, last_begun, zeros_of,
};
use num_traits::{Signed as _, Zero as _};
use std::cell::{OnceCell, RefCell};
use std::cmp::Ordering;
use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;
use wavestep_polynomial::{Rational, Symbol};

/// The precisions with which two instants are told apart.
const ORDER_BITS: [u64; 2] = [64, 1 << 12];

/// A value that is zero but for as many bits is suspected to be zero.
const SUSPICION_BITS: u64 = 64;

/// The precision at which it is seen that a derivative does not vanish.
const FLAT_BITS: u64 = 128;

/// The lowest precision of values and integrals, and the step between two.
const FIRST_BITS: u64 = 192;
const STEP_BITS: u64 = 64;

/// Precision is rounded up to multiples of [`STEP_BITS`], so that cached results are used again.
fn working(bits: u64) -> u64 {
    bits.max(FIRST_BITS).next_multiple_of(STEP_BITS)
}

/// The scales of a scene or a recurrence, and its constants.
pub(crate) struct Scale<'a> {
    /// As that of an [`Instant`].
    scene: usize,
    slowness: Fraction,
    /// The unit of time.
    unit: Root,
    clock: &'a Symbol,
    assumptions: &'a Assumptions,
    constants: &'a [Named],
    pub(crate) numbers: Numbers,
    /// Lengths of time in the user's, by bits: breaks are asked for again and again.
    times: RefCell<HashMap<u64, HashMap<Fraction, Ball>>>,
}

impl<'a> Scale<'a> {
    pub fn of(network: &'a Network) -> Rc<Scale<'a>> {
        let model = network.model();
        Rc::new(Scale {
            scene: std::ptr::from_ref(network).addr(),
            slowness: model.slowness.clone(),
            unit: model.scale.time.clone(),
            clock: &network.scene().time,
            assumptions: &model.assumptions,
            constants: &model.constants,
            numbers: Numbers::new(&model.constants),
            times: RefCell::default(),
        })
    }

    /// The user's time is that of the waves.
    pub fn of_recurrence(recurrence: &'a Recurrence) -> Rc<Scale<'a>> {
        Rc::new(Scale {
            scene: std::ptr::from_ref(recurrence).addr(),
            slowness: Fraction::one(),
            unit: Root::from(Fraction::one()),
            clock: &recurrence.statement().time,
            assumptions: &recurrence.statement().assumptions,
            constants: recurrence.constants(),
            numbers: Numbers::new(recurrence.constants()),
            times: RefCell::default(),
        })
    }

    fn scaled_time(&self, time: &Rational) -> Fraction {
        self.slowness.scale(time)
    }

    /// The instant that is so long after the start of the scene.
    fn instant(&self, delay: Fraction) -> Instant {
        Instant { scene: self.scene, event: None, delay }
    }

    /// A time of the user's.
    fn mark<'m>(&self, time: &Rational) -> Mark<'m> {
        let (exact, own) = (Some(time.clone()), time.clone());
        let enclose = Box::new(move |bits| Ok(Ball::from_rational(&own, bits)));
        Mark { exact, instant: Some(self.instant(self.scaled_time(time))), enclose }
    }

    /// A time of the scene.
    fn mark_scaled<'m>(&'m self, time: &'m Fraction) -> Mark<'m> {
        let (exact, instant) = (self.exact_time(time), self.instant(time.clone()));
        let enclose = Box::new(|bits| self.time(time, bits));
        Mark { exact, instant: Some(instant), enclose }
    }

    /// A length of time of the scene in the user's, where that is a rational number.
    fn exact_time(&self, length: &Fraction) -> Option<Rational> {
        Some(length.as_constant()? / self.slowness.as_constant()?)
    }

    /// The same, enclosed.
    pub fn time(&self, length: &Fraction, bits: u64) -> Outcome<Ball> {
        if let Some(known) = self.times.borrow().get(&bits).and_then(|times| times.get(length)) {
            return Ok(known.clone());
        }
        let slowness = self.numbers.enclose(&self.slowness, bits)?;
        let inverse = slowness.reciprocal(bits).map_err(EvaluateError::Ball)?;
        let time = self.numbers.enclose(length, bits)?.multiply(&inverse, bits);
        self.times.borrow_mut().entry(bits).or_default().insert(length.clone(), time.clone());
        Ok(time)
    }
}

/// A time of the user's, as far as it is known.
pub(crate) struct Mark<'m> {
    exact: Option<Rational>,
    instant: Option<Instant>,
    enclose: Box<dyn Fn(u64) -> Outcome<Ball> + 'm>,
}

impl<'m> Mark<'m> {
    /// Where a stretch begins.
    fn of(signal: &'m dyn Signal, stretch: usize) -> Mark<'m> {
        let (exact, instant) = (signal.exact_time(stretch, Limit::Right), signal.instant(stretch));
        let enclose = Box::new(move |bits| signal.time(stretch, Limit::Right, bits));
        Mark { exact, instant, enclose }
    }

    fn again(&self) -> Mark<'_> {
        let enclose = Box::new(|bits| self.ball(bits));
        Mark { exact: self.exact.clone(), instant: self.instant.clone(), enclose }
    }

    /// A length of time of the scene later, or earlier where that is negative.
    fn after(self, length: Fraction, scale: &'m Scale<'_>) -> Mark<'m> {
        let exact = self.exact.clone().zip(scale.exact_time(&length));
        let delayed = |own: Instant| Instant { delay: &own.delay + &length, ..own };
        let instant = self.instant.clone().map(delayed);
        let enclose = move |bits| Ok(self.ball(bits)?.add(&scale.time(&length, bits)?, bits));
        let exact = exact.map(|(time, length)| time + length);
        Mark { exact, instant, enclose: Box::new(enclose) }
    }

    fn ball(&self, bits: u64) -> Outcome<Ball> {
        match &self.exact {
            Some(time) => Ok(Ball::from_rational(time, bits)),
            None => (self.enclose)(bits),
        }
    }

    /// The time of the scene, where it rests on no event.
    fn delay(&self) -> Option<&Fraction> {
        self.instant.as_ref().filter(|own| own.event.is_none()).map(|own| &own.delay)
    }

    /// Which of two times is earlier.
    fn compare(&self, other: &Mark<'_>) -> Outcome<Ordering> {
        if self.instant.is_some() && self.instant == other.instant {
            return Ok(Ordering::Equal);
        }
        if let (Some(own), Some(other)) = (&self.exact, &other.exact) {
            return Ok(own.cmp(other));
        }
        let [first, most] = ORDER_BITS;
        // Where instants were taken for one on the way, so many bits have not told them apart, and an answer says so.
        let assumed = |mark: &Mark<'_>| {
            let event = mark.instant.as_ref().and_then(|own| own.event);
            event.map(|(bits, _)| bits).filter(|bits| *bits > 0)
        };
        let tried = assumed(self).max(assumed(other));
        let most = tried.map_or(most, |tried| tried.clamp(first, most));
        let attempt = |bits| {
            let difference = self.ball(bits)?.subtract(&other.ball(bits)?, bits);
            Ok::<_, EvaluateError>(match difference.sign() {
                Some(order) => Attempt::Done(order),
                None => Attempt::NotYet(EvaluateError::InstantsUndecided { bits }),
            })
        };
        let order = Precisions::doubling(first, most).raise(attempt).and_then(Attempt::done);
        match order {
            Err(EvaluateError::InstantsUndecided { .. }) if tried.is_some() => Ok(Ordering::Equal),
            order => order,
        }
    }
}

/// The stretch that holds a time; at a break `side` decides.
fn locate(signal: &dyn Signal, at: &Mark<'_>, side: Limit) -> Outcome<usize> {
    last_begun(signal.count()?, side, |stretch| Mark::of(signal, stretch).compare(at))
}

/// How flat an operand is where a stretch of an operation begins or ends: one of its own, or else within one, where its exact
/// function tells it at a time that is known in its scale.
fn flatness_of(
    signal: &dyn Signal,
    stretch: usize,
    (at, end): (&Mark<'_>, Limit),
    order: usize,
    (scale, delay): (&Scale<'_>, Option<&Fraction>),
) -> Outcome<usize> {
    if signal.is_zero(stretch) {
        return Ok(MAX_FLATNESS);
    }
    let own = match end {
        Limit::Right => Mark::of(signal, stretch),
        Limit::Left if stretch + 1 < signal.count()? => Mark::of(signal, stretch + 1),
        Limit::Left => scale.mark(signal.window()[1]),
    };
    if own.compare(at).is_ok_and(Ordering::is_eq) {
        return signal.flatness(stretch, end, order);
    }
    let all = Fraction::symbol(scale.clock);
    match (signal.exact_at(stretch, &all, Effort::Much), delay) {
        (Some(function), Some(at)) => zeros_of(function, scale.clock, at, order),
        _ => Ok(0),
    }
}

/// An enclosure of a derivative of an operand at a time that may be known by enclosures alone: there the
/// values of a short time around it, in which the function of the stretch goes on.
fn value_at(
    signal: &dyn Signal,
    stretch: usize,
    order: usize,
    at: &Mark<'_>,
    bits: u64,
) -> Outcome<Ball> {
    if let Some(time) = &at.exact {
        return signal.enclose(stretch, order, At::Time(time), bits);
    }
    let time = at.ball(bits)?;
    let half = Rational::from(time.radius());
    if half.is_zero() {
        let time = time.midpoint().into();
        return signal.enclose(stretch, order, At::Time(&time), bits);
    }
    let place = (&time.midpoint().into(), &half);
    let taylor = signal.taylor(stretch, Near { order, place, terms: 2, bits })?;
    Ok(taylor.coefficients[0].widened(&taylor.tail(1)))
}

/// What an operation is between the breaks of its operands. A list of places says for each operand, or
/// for each end of an integral, on which stretch it is.
pub(crate) trait Rule {
    /// The places on the first stretch, and the ends of those that follow, one range for each operand; none where there are
    /// no breaks.
    fn ranges(&self) -> Outcome<Vec<Range<usize>>> {
        Ok(Vec::new())
    }

    /// Whether breaks that are not told apart by thousands of bits count as one.
    fn takes_ties(&self) -> bool {
        false
    }

    /// When an operand comes to a place.
    fn mark(&self, operand: usize, place: usize) -> Mark<'_>;

    /// Whether an operand is at a place for the last instant of the window alone.
    fn is_instant(&self, _operand: usize, _place: usize) -> bool {
        false
    }

    /// As [`Signal::is_continuous`].
    fn is_continuous(&self) -> bool {
        false
    }

    /// As [`Signal::trend`].
    fn trend(&self) -> Option<Ordering> {
        None
    }

    fn is_zero(&self, places: &[usize]) -> bool;

    /// As [`Signal::square_of`], in the scale of the scene.
    fn square_of(&self) -> Option<(&Fraction, &dyn Signal)> {
        None
    }

    /// Terms of which a derivative with respect to the user's time is the sum.
    fn terms(&self, places: &[usize], order: usize, at: &Mark<'_>, bits: u64)
    -> Outcome<Vec<Ball>>;

    /// As [`Signal::size`], in the scale of the scene.
    fn size(
        &self,
        places: &[usize],
        order: usize,
        (_, at): (&Rational, &Mark<'_>),
        bits: u64,
    ) -> Outcome<(Magnitude, Magnitude)> {
        let (mut size, mut error) = (Magnitude::ZERO, Magnitude::ZERO);
        for term in self.terms(places, order, at, bits)? {
            (size, error) = (size.add(&term.midpoint().magnitude()), error.add(term.radius()));
        }
        Ok((size, error))
    }

    /// As [`Signal::taylor`].
    fn taylor(&self, places: &[usize], near: Near<'_>) -> Outcome<Taylor>;

    /// As [`Signal::exact_at`].
    fn exact_at(&self, places: &[usize], at: &Fraction, effort: Effort) -> Option<Expression>;

    /// The value in the user's unit at one exact time in the scale of the scene, or from that time on, where the operands
    /// know theirs.
    fn exact_value(&self, _: &[usize], _: &Fraction) -> Outcome<Option<Rational>> {
        Ok(None)
    }

    /// As [`Signal::flatness`], at the mark of the end.
    fn flatness(&self, _: &[usize], _: (&Mark<'_>, Limit), _: usize) -> Outcome<usize> {
        Ok(0)
    }

    /// One limit at a time, what exact arithmetic tells of it at once, and the most bits that are of use.
    fn point(&self, at: &Rational, side: Limit) -> Outcome<(Known, Enclosure<'_>, u64)>;

    /// What it is made of.
    fn operands(&self) -> Vec<&dyn Signal> {
        Vec::new()
    }

    fn echoes(&self) -> Option<EchoCount> {
        None
    }
}

/// The polynomial of a derivative of what changes at a rate: of the rate, or of its integral since the middle beside
/// the value there.
fn taylor_by_rate(
    near: Near<'_>,
    rate: impl FnOnce(Near<'_>) -> Outcome<Taylor>,
    value: impl FnOnce() -> Outcome<Ball>,
) -> Outcome<Taylor> {
    let Near { order, place: (_, half), terms, bits } = near;
    if let Some(order) = order.checked_sub(1) {
        return rate(Near { order, ..near });
    }
    let rate = rate(Near { terms: terms.saturating_sub(1).max(1), ..near })?;
    let mut sum = rate.antiderivative(bits).scaled(&Ball::from_rational(half, bits), bits);
    sum.coefficients[0] = sum.coefficients[0].add(&value()?, bits);
    Ok(sum)
}

/// A stretch of an operation: which operand comes to a new place where it begins, and all places.
struct Step {
    begins: usize,
    places: Vec<usize>,
    /// Whether the operation is known to be zero, once that is asked.
    is_zero: OnceCell<bool>,
}

impl Step {
    fn new(begins: usize, places: &[usize]) -> Step {
        Step { begins, places: places.to_vec(), is_zero: OnceCell::new() }
    }
}

/// The signal of a rule, in a unit, on a window of the user's time.
pub(crate) struct Operation<'a, R> {
    scale: Rc<Scale<'a>>,
    rule: R,
    unit: Root,
    window: [Rational; 2],
    steps: OnceCell<Vec<Step>>,
}

impl<'a, R: Rule> Operation<'a, R> {
    pub fn new(scale: &Rc<Scale<'a>>, rule: R, unit: Root, window: [&Rational; 2]) -> Self {
        let (scale, window) = (Rc::clone(scale), window.map(Clone::clone));
        Operation { scale, rule, unit, window, steps: OnceCell::new() }
    }

    /// The stretches: all operands go on to their next places in the order of their breaks.
    fn steps(&self) -> Outcome<&[Step]> {
        if let Some(steps) = self.steps.get() {
            return Ok(steps);
        }
        let ranges = self.rule.ranges()?;
        let marks: Vec<Vec<Mark<'_>>> = (0..)
            .zip(&ranges)
            .map(|(operand, range)| {
                (range.start + 1..range.end).map(|place| self.rule.mark(operand, place)).collect()
            })
            .collect();
        let mut places: Vec<usize> = ranges.iter().map(|range| range.start).collect();
        let mut steps = vec![Step::new(0, &places)];
        loop {
            // Those operands that come to a new place first, all at one time.
            let mut first: Vec<(usize, &Mark<'_>)> = Vec::new();
            for (operand, range) in ranges.iter().enumerate() {
                let Some(mark) = marks[operand].get(places[operand] - range.start) else {
                    continue;
                };
                let order = first.first().map(|known| match mark.compare(known.1) {
                    Err(EvaluateError::InstantsUndecided { .. }) if self.rule.takes_ties() => {
                        Ok(Ordering::Equal)
                    }
                    order => order,
                });
                match order.transpose()? {
                    Some(Ordering::Greater) => {}
                    Some(Ordering::Equal) => first.push((operand, mark)),
                    Some(Ordering::Less) | None => first = vec![(operand, mark)],
                }
            }
            let Some(begins) = first.first().map(|(operand, _)| *operand) else { break };
            first.iter().for_each(|(operand, _)| places[*operand] += 1);
            steps.push(Step::new(begins, &places));
        }
        drop(marks);
        Ok(self.steps.get_or_init(|| steps))
    }

    fn step(&self, stretch: usize) -> &Step {
        &self.known()[stretch]
    }

    fn known(&self) -> &[Step] {
        self.steps.get().expect("stretches were counted before they are asked for")
    }

    /// When a stretch begins.
    fn beginning(&self, stretch: usize) -> Mark<'_> {
        match stretch {
            0 => self.scale.mark(&self.window[0]),
            _ => {
                let Step { begins, places, .. } = self.step(stretch);
                self.rule.mark(*begins, places[*begins])
            }
        }
    }

    fn mark<'s>(&'s self, stretch: usize, at: At<'s>) -> Mark<'s> {
        match at {
            At::Time(time) => self.scale.mark(time),
            At::Scaled(time) => self.scale.mark_scaled(time),
            At::End(Limit::Right) => self.beginning(stretch),
            At::End(Limit::Left) if stretch + 1 < self.known().len() => self.beginning(stretch + 1),
            At::End(Limit::Left) => self.scale.mark(&self.window[1]),
        }
    }

    fn in_unit(&self, value: Ball, bits: u64) -> Outcome<Ball> {
        match self.unit == Root::from(Fraction::one()) {
            true => Ok(value),
            false => Ok(value.multiply(&self.scale.numbers.enclose_root(&self.unit, bits)?, bits)),
        }
    }

    /// What is told of an exact value in the scale of the scene.
    fn told(&self, value: Option<Expression>) -> Known {
        Known::of(value, &self.unit)
    }

    /// Whether terms that are not known to be zero add up to zero on a stretch: in numbers, and then exactly.
    fn cancels(&self, stretch: usize) -> Outcome<bool> {
        if self.is_instant(stretch) {
            return Ok(false);
        }
        let end = |end| self.time(stretch, end, SUSPICION_BITS);
        let [from, to] = [end(Limit::Right)?, end(Limit::Left)?];
        let sum = Rational::from(from.add(&to, SUSPICION_BITS).midpoint());
        let middle = sum / Rational::from_integer(2.into());
        let (places, middle) = (&self.step(stretch).places, self.scale.mark(&middle));
        for bits in [SUSPICION_BITS, 4 * SUSPICION_BITS] {
            let terms = self.rule.terms(places, 0, &middle, bits)?;
            let sum = terms.iter().fold(Ball::zero(), |sum, term| sum.add(term, bits));
            if !sum.contains_zero() {
                return Ok(false);
            }
        }
        Ok(self.form(stretch).is_some_and(|form| form.is_zero()))
    }

    /// What exact arithmetic tells of a limit at a time.
    fn decided(&self, at: &Rational, side: Limit) -> Outcome<Known> {
        let Some(stretch) = self.stretch_at(at, side)? else { return Ok(Known::Unknown) };
        let at = self.scale.scaled_time(at);
        Ok(self.told(self.rule.exact_at(&self.step(stretch).places, &at, Effort::Much)))
    }
}

impl<R: Rule> Signal for Operation<'_, R> {
    fn window(&self) -> [&Rational; 2] {
        self.window.each_ref()
    }

    fn point(&self, at: &Rational, side: Limit) -> Outcome<Point<'_>> {
        if at.is_negative() {
            return Ok(Point::exact(Rational::zero()));
        }
        let (known, enclose, most_bits) = self.rule.point(at, side)?;
        if let Known::Rational(value) = known
            && let Known::Rational(value) = self.told(Some(Expression::constant(&value)))
        {
            return Ok(Point::exact(value));
        }
        let unit = self.scale.numbers.enclose_root(&self.unit, SUSPICION_BITS)?.magnitude();
        let at = at.clone();
        Ok(Point {
            known: Known::Unknown,
            enclose: Box::new(move |bits| {
                let bits = working(bits);
                self.in_unit(enclose(bits)?, bits)
            }),
            decide: Box::new(move || self.decided(&at, side).unwrap_or(Known::Unknown)),
            negligible: unit.scale(-(SUSPICION_BITS as i64)),
            most_bits,
        })
    }

    fn closed_form(&self) -> Outcome<&ClosedForm> {
        Err(EvaluateError::NotLinear)
    }

    fn most_bits(&self) -> u64 {
        self.rule.operands().iter().map(|own| own.most_bits()).min().unwrap_or(u64::MAX)
    }

    fn ready_bits(&self) -> u64 {
        self.rule.operands().iter().map(|own| own.ready_bits()).min().unwrap_or(u64::MAX)
    }

    fn echoes(&self) -> Option<EchoCount> {
        self.rule.echoes()
    }

    fn count(&self) -> Outcome<usize> {
        Ok(self.steps()?.len())
    }

    fn scaled_time(&self, time: &Rational) -> Fraction {
        self.scale.scaled_time(time)
    }

    fn begins(&self, stretch: usize, at: &Fraction) -> Outcome<Ordering> {
        self.beginning(stretch).compare(&self.scale.mark_scaled(at))
    }

    fn is_instant(&self, stretch: usize) -> bool {
        let Step { begins, places, .. } = self.step(stretch);
        places.get(*begins).is_some_and(|place| self.rule.is_instant(*begins, *place))
    }

    fn trend(&self) -> Option<Ordering> {
        self.rule.trend()
    }

    fn is_continuous(&self) -> bool {
        self.rule.is_continuous()
    }

    fn is_zero(&self, stretch: usize) -> bool {
        let Step { places, is_zero, .. } = self.step(stretch);
        let cancels = || self.cancels(stretch).unwrap_or(false);
        *is_zero.get_or_init(|| self.rule.is_zero(places) || cancels())
    }

    fn square_of(&self) -> Option<(Ball, &dyn Signal)> {
        let (factor, squared) = self.rule.square_of()?;
        let factor = self.scale.numbers.enclose(factor, FIRST_BITS).ok()?;
        let factor = self.in_unit(factor, FIRST_BITS).ok()?;
        (factor.sign() == Some(Ordering::Greater)).then_some((factor, squared))
    }

    fn exact_time(&self, stretch: usize, end: Limit) -> Option<Rational> {
        self.mark(stretch, At::End(end)).exact
    }

    fn instant(&self, stretch: usize) -> Option<Instant> {
        self.beginning(stretch).instant
    }

    fn exact_at(&self, stretch: usize, at: &Fraction, effort: Effort) -> Option<Expression> {
        in_unit(self.rule.exact_at(&self.step(stretch).places, at, effort)?, &self.unit)
    }

    /// Both operands of a difference know the time by the symbol of its scene.
    fn form(&self, stretch: usize) -> Option<Expression> {
        self.exact_at(stretch, &Fraction::symbol(self.scale.clock), Effort::Much)
    }

    fn time(&self, stretch: usize, end: Limit, bits: u64) -> Outcome<Ball> {
        self.mark(stretch, At::End(end)).ball(bits)
    }

    fn enclose(&self, stretch: usize, order: usize, at: At<'_>, bits: u64) -> Outcome<Ball> {
        let (mark, places) = (self.mark(stretch, at), &self.step(stretch).places);
        let terms = self.rule.terms(places, order, &mark, bits)?;
        let sum = terms.iter().fold(Ball::zero(), |sum, term| sum.add(term, bits));
        self.in_unit(sum, bits)
    }

    fn taylor(&self, stretch: usize, near: Near<'_>) -> Outcome<Taylor> {
        let (taylor, bits) = (self.rule.taylor(&self.step(stretch).places, near)?, near.bits);
        match self.unit == Root::from(Fraction::one()) {
            true => Ok(taylor),
            false => Ok(taylor.scaled(&self.scale.numbers.enclose_root(&self.unit, bits)?, bits)),
        }
    }

    fn size(
        &self,
        stretch: usize,
        order: usize,
        at: &Rational,
        bits: u64,
    ) -> Outcome<(Magnitude, Magnitude)> {
        let (places, at) = (&self.step(stretch).places, (at, &self.scale.mark(at)));
        let (size, error) = self.rule.size(places, order, at, bits)?;
        let unit = self.in_unit(Ball::from_integer(&1.into()), bits)?;
        let error = error.multiply(&unit.magnitude()).add(&size.multiply(unit.radius()));
        Ok((size.multiply(&unit.magnitude()), error))
    }

    fn exact(&self, stretch: usize, at: At<'_>) -> Outcome<Option<Rational>> {
        // Of single values operands tell those from the right.
        let is_before = matches!(at, At::End(Limit::Left));
        let at = match at {
            At::Time(time) => self.scale.scaled_time(time),
            At::Scaled(time) => time.clone(),
            At::End(Limit::Left) if stretch + 1 == self.known().len() => {
                self.scale.scaled_time(&self.window[1])
            }
            At::End(end) => match self.instant(stretch + usize::from(end == Limit::Left)) {
                Some(Instant { event: None, delay, .. }) => delay,
                _ => return Ok(None),
            },
        };
        let places = &self.step(stretch).places;
        match self.told(self.rule.exact_at(places, &at, Effort::Much)) {
            Known::Rational(value) => Ok(Some(value)),
            Known::Irrational => Ok(None),
            Known::Unknown if is_before => Ok(None),
            Known::Unknown => self.rule.exact_value(places, &at),
        }
    }

    fn flatness(&self, stretch: usize, end: Limit, order: usize) -> Outcome<usize> {
        // Enclosures are cheaper than the exact values that tell how many derivatives vanish.
        if !self.enclose(stretch, order, At::End(end), FLAT_BITS)?.contains_zero() {
            return Ok(0);
        }
        let is_zero =
            order == 0 && self.exact(stretch, At::End(end))?.is_some_and(|value| value.is_zero());
        let at = self.mark(stretch, At::End(end));
        let known = self.rule.flatness(&self.step(stretch).places, (&at, end), order)?;
        Ok(known.max(usize::from(is_zero)))
    }
}
