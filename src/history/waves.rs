//! The waves that enter the bars of a scene across all phases of its contacts, for fields along the
//! bars.
//!
//! The method of steps knows each wave as series from cell to cell, on both sides of every opening and
//! closing. Here the state at the start is taken off, integrals are added, and precision is doubled where
//! an enclosure does not do.

use crate::ball::{Attempt, Ball, Magnitude, Number, Precisions};
use crate::evaluate::{EvaluateError, Limit};
use crate::expression::Fraction;
use crate::field::{Entering, EnteringWaves, FieldError, FieldEvaluator, Heading, Instant, Order};
use crate::history::energy::Wave;
use crate::history::engine::Engine;
use crate::history::error::HistoryError;
use crate::history::history::undecided;
use crate::history::moment::{Clock, Moment};
use crate::history::series::{Series, Truncation};
use crate::history::track::Track;
use crate::limits::MAX_HISTORY_BITS;
use crate::network::Network;
use std::cell::RefCell;
use std::cmp::Ordering;
use std::ops::RangeInclusive;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// The precision tried first.
const FIRST_BITS: u64 = 256;

/// Instants of pictures that are so near to a break mean the break.
const NEAR_BITS: i64 = 64;

/// How narrow enclosures of breaks are where a number stands for them: far narrower than what is near.
const STAND_IN_BITS: i64 = 100;

/// A jump that is known to be smaller than this is none.
const NO_JUMP_BITS: i64 = 100;

/// Fields along the bars of a scene whose contacts open and close, for times up to `last` of the
/// user's. Contacts may open whether or not the scene says `contacts open`.
///
/// # Errors
/// As [`History::of`](super::History::of); [`HistoryError::Field`] for a time before the start.
///
/// # Cost
/// The scene is followed once, with 256 bits, and again with twice the precision where a value needs it;
/// a value is then read off one series of each wave.
pub fn field_evaluator(network: &Network, last: &Rational) -> Result<FieldEvaluator, HistoryError> {
    let waves = PhaseWaves::new(network, last, MAX_HISTORY_BITS)?;
    FieldEvaluator::with(network, last, |_, _| Ok(Box::new(waves)))
        .map_err(|error| HistoryError::Field(Box::new(error)))
}

/// The waves of a scene whose contacts open and close.
///
/// # Invariants
/// - `known` is not empty, and ascends by the bits asked for.
struct PhaseWaves {
    network: Network,
    last: Rational,
    /// The most bits.
    most: u64,
    /// By the bits asked for; where more bits failed, the best there are.
    known: RefCell<Vec<(u64, Rc<Phases>)>>,
}

impl PhaseWaves {
    fn new(network: &Network, last: &Rational, most: u64) -> Result<PhaseWaves, HistoryError> {
        let attempt = |bits| match Phases::new(network, last, bits) {
            Ok(phases) => Ok(Attempt::Done(Ok((bits, Rc::new(phases))))),
            Err(error) => undecided(error),
        };
        let first = Precisions::doubling(FIRST_BITS, most).raise(attempt)?.best()?;
        let known = RefCell::new(vec![first]);
        Ok(PhaseWaves { network: network.clone(), last: last.clone(), most, known })
    }

    /// The waves with at least so many bits, or the best there are.
    fn with(&self, bits: u64) -> Rc<Phases> {
        let bits = bits.next_power_of_two().min(self.most);
        let mut known = self.known.borrow_mut();
        if let Some((_, phases)) = known.iter().find(|(known, _)| *known >= bits) {
            return Rc::clone(phases);
        }
        let (_, best) = known.last().expect("at least one");
        let finer = Phases::new(&self.network, &self.last, bits);
        let finer = finer.map_or_else(|_| Rc::clone(best), Rc::new);
        known.push((bits, Rc::clone(&finer)));
        finer
    }
}

impl EnteringWaves for PhaseWaves {
    fn enclose(
        &self,
        wave: Entering,
        order: Order,
        instant: Instant<'_>,
        bits: u64,
    ) -> Result<Ball, FieldError> {
        let attempt = |bits| match self.with(bits).enclose(wave, order, instant) {
            Ok(ball) => Ok(Attempt::Done(Ok(ball))),
            Err(error) => undecided(error),
        };
        let found = Precisions::doubling(bits, self.most).raise(attempt);
        found.and_then(Attempt::best).map_err(refused)
    }

    fn breaks(
        &self,
        wave: Entering,
        window: RangeInclusive<&Fraction>,
    ) -> Result<Vec<Fraction>, FieldError> {
        let attempt = |bits| {
            let phases = self.with(bits);
            let is_told = phases.tells_instants();
            Ok::<_, FieldError>(Attempt::of(phases, is_told))
        };
        let phases = Precisions::doubling(FIRST_BITS, self.most).raise(attempt)?.best();
        phases.breaks(wave, window).map_err(refused)
    }
}

/// What is known of a scene that was followed to its last time does not fail in another way.
fn refused(error: HistoryError) -> FieldError {
    match error {
        HistoryError::Undecided { at, bits, .. } => FieldError::Undecided { at, bits },
        HistoryError::Value(error) => error.into(),
        _ => EvaluateError::AfterLast.into(),
    }
}

/// A wave on one cell: itself without the state at the start, its integral over time, and the integral
/// of that.
struct Piece {
    start: Moment,
    levels: [Series; 3],
}

/// A wave from the start on.
///
/// # Invariants
/// - pieces follow one another without gaps, the first from the start on, the last one until `end`.
struct Course {
    pieces: Vec<Piece>,
    end: Moment,
}

/// All waves at one precision.
struct Phases {
    clock: Clock,
    cut: Truncation,
    /// Of each bar the waves to the right and to the left; none for what comes from afar.
    courses: Vec<[Option<Course>; 2]>,
}

impl Phases {
    fn new(network: &Network, last: &Rational, bits: u64) -> Result<Phases, HistoryError> {
        let mut engine = Engine::new(network, bits)?;
        engine.follow_until(&Moment::at(network.scaled_time(last)))?;
        let Engine { clock, cut, waves, layout, .. } = engine;
        let mut courses = Vec::with_capacity(waves.len());
        for ([right, left], ends) in waves.into_iter().zip(&layout.ends) {
            let course = |track: Track, end: Option<usize>| {
                end.map(|_| Course::of(track, &clock, &cut)).transpose()
            };
            courses.push([course(right, ends[0])?, course(left, ends[1])?]);
        }
        Ok(Phases { clock, cut, courses })
    }

    fn course(&self, wave: Entering) -> Option<&Course> {
        let [right, left] = &self.courses[wave.bar];
        let course = if wave.heading == Heading::Right { right } else { left };
        course.as_ref()
    }

    fn enclose(
        &self,
        wave: Entering,
        order: Order,
        instant: Instant<'_>,
    ) -> Result<Ball, HistoryError> {
        let Some(course) = self.course(wave) else { return Ok(Ball::zero()) };
        // Before the start nothing is added.
        let begun = self.clock.numbers.compare(instant.at, &Fraction::zero())?;
        let at_start = match order {
            Order::Slope | Order::Value => instant.side == Limit::Left,
            Order::Integral | Order::DoubleIntegral => true,
        };
        if begun == Ordering::Less || (begun == Ordering::Equal && at_start) {
            return Ok(Ball::zero());
        }
        let moment = Moment::at(instant.at.clone());
        let piece = course.piece(&moment, instant, &self.clock)?;
        let time = self.clock.since(&piece.start, &moment)?;
        let value = |series: &Series| series.value(&time, &self.cut).ball(self.cut.bits);
        Ok(match order {
            Order::Slope => value(&piece.levels[0].derivative(&self.cut)),
            Order::Value => value(&piece.levels[0]),
            Order::Integral => value(&piece.levels[1]),
            Order::DoubleIntegral => value(&piece.levels[2]),
        })
    }

    fn starts(&self) -> impl Iterator<Item = &Moment> {
        let courses = self.courses.iter().flatten().flatten();
        courses.flat_map(|course| course.pieces.iter().map(|piece| &piece.start))
    }

    /// Whether all instants are known so well that numbers stand for them.
    fn tells_instants(&self) -> bool {
        let narrow = Magnitude::power_of_two(-STAND_IN_BITS);
        let time = |moment: &Moment| self.clock.time(moment);
        self.starts().all(|start| {
            start.event.is_none()
                || time(start).is_ok_and(|time| *time.ball(self.cut.bits).radius() <= narrow)
        })
    }

    fn breaks(
        &self,
        wave: Entering,
        window: RangeInclusive<&Fraction>,
    ) -> Result<Vec<Fraction>, HistoryError> {
        let Some(course) = self.course(wave) else { return Ok(Vec::new()) };
        let mut breaks = Vec::new();
        for (number, piece) in course.pieces.iter().enumerate() {
            let at = self.clock.stand_in(&piece.start);
            let compare = |other| self.clock.numbers.compare(&at, other);
            let outside = compare(window.start())? == Ordering::Less
                || compare(window.end())? == Ordering::Greater;
            if !outside && self.is_break(course, number)? {
                breaks.push(at);
            }
        }
        Ok(breaks)
    }

    /// Whether a wave, its slope or its curvature jumps where a piece begins. Cells also end where a
    /// series would become too long, and where something arrived that was no more than that.
    fn is_break(&self, course: &Course, number: usize) -> Result<bool, HistoryError> {
        let piece = &course.pieces[number];
        let mut after = piece.levels[0].clone();
        let (mut before, time) = match number.checked_sub(1) {
            Some(before) => {
                let before = &course.pieces[before];
                (before.levels[0].clone(), self.clock.since(&before.start, &piece.start)?)
            }
            None => (Series::zero(), Number::zero()),
        };
        let none = Magnitude::power_of_two(-NO_JUMP_BITS);
        for _ in 0..3 {
            let jump =
                after.coefficient(0).subtract(&before.value(&time, &self.cut), self.cut.bits);
            if jump.magnitude() > none {
                return Ok(true);
            }
            (before, after) = (before.derivative(&self.cut), after.derivative(&self.cut));
        }
        Ok(false)
    }
}

impl Course {
    /// A wave without what it was before the start.
    fn of(track: Track, clock: &Clock, cut: &Truncation) -> Result<Course, HistoryError> {
        let mut cells = track.cells.into_iter();
        let (_, before) = cells.next().expect("a wave before the start");
        let cells: Vec<(Moment, Wave)> = cells.collect();
        let mut sums = [Number::zero(), Number::zero()];
        let mut pieces = Vec::with_capacity(cells.len());
        for (number, (start, wave)) in cells.iter().enumerate() {
            let value = wave.series().subtract(before.series(), cut.bits);
            let integral = value.integral(sums[0].clone(), cut);
            let second = integral.integral(sums[1].clone(), cut);
            let end = cells.get(number + 1).map_or(&track.end, |(start, _)| start);
            let length = clock.since(start, end)?;
            sums = [&integral, &second].map(|series| series.value(&length, cut));
            pieces.push(Piece { start: start.clone(), levels: [value, integral, second] });
        }
        Ok(Course { pieces, end: track.end })
    }

    /// The piece that an instant from the start on lies in.
    fn piece(
        &self,
        moment: &Moment,
        instant: Instant<'_>,
        clock: &Clock,
    ) -> Result<&Piece, HistoryError> {
        let near = Magnitude::power_of_two(-NEAR_BITS);
        let is_before_end = |end: &Moment| -> Result<bool, HistoryError> {
            let order = match instant.is_drawn && clock.since(moment, end)?.magnitude() <= near {
                true => Ordering::Equal,
                false => clock.compare(end, moment)?,
            };
            Ok(order == Ordering::Greater
                || (order == Ordering::Equal && instant.side == Limit::Left))
        };
        let (mut low, mut high) = (0, self.pieces.len());
        // The first piece that ends behind the instant.
        while low < high {
            let middle = low.midpoint(high);
            let end = self.pieces.get(middle + 1).map_or(&self.end, |piece| &piece.start);
            if is_before_end(end)? { high = middle } else { low = middle + 1 }
        }
        self.pieces.get(low).ok_or(HistoryError::AfterLast)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Source, parse_number, read_scene};

    fn number(text: &str) -> Rational {
        parse_number(text).unwrap()
    }

    fn saint_venant() -> Network {
        let text = crate::scenes::find("saint-venant").unwrap().text;
        let values = [("mu".to_owned(), number("1"))].into();
        let source = Source::new("saint-venant", text).unwrap();
        Network::new(&read_scene(&source, &values).unwrap()).unwrap()
    }

    const ROD: Entering = Entering { bar: 0, heading: Heading::Right };

    /// The mass leaves at 3 + e^(−2)/2. The number that stands for it means it in pictures, with a slope
    /// on either side; exactly, it is some other instant, which more bits tell from it or which is refused.
    #[test]
    fn a_number_stands_for_an_enclosed_instant() {
        let window = ["301/100", "31/10"].map(|time| Fraction::constant(&number(time)));
        let waves = PhaseWaves::new(&saint_venant(), &number("4"), 2 * FIRST_BITS).unwrap();
        let breaks = waves.breaks(ROD, &window[0]..=&window[1]).unwrap();
        let [release] = &breaks[..] else { panic!("{breaks:?}") };
        let (told, _) = waves.with(1).clock.numbers.enclose(release, 64).unwrap().to_double();
        assert!((told - 3.0 - (-2.0_f64).exp() / 2.0).abs() < 1e-15);
        let ask = |waves: &PhaseWaves, order, side, is_drawn| {
            let instant = Instant { at: release, side, is_drawn };
            waves.enclose(ROD, order, instant, 64).map(|ball| ball.to_double().0)
        };
        let drawn = |order, side| ask(&waves, order, side, true).unwrap();
        for order in [Order::Value, Order::Integral, Order::DoubleIntegral] {
            let (left, right) = (drawn(order, Limit::Left), drawn(order, Limit::Right));
            assert!((left - right).abs() < 1e-15 && left.abs() > 0.1, "{order:?} {left} {right}");
        }
        let slopes = [Limit::Left, Limit::Right].map(|side| drawn(Order::Slope, side));
        assert!((slopes[0] - slopes[1]).abs() > 0.1, "{slopes:?}");
        assert_eq!(waves.known.borrow().len(), 1);
        let exact = [Limit::Left, Limit::Right].map(|side| ask(&waves, Order::Slope, side, false));
        assert_eq!(exact[0], exact[1]);
        assert!(exact[0].is_ok() && waves.known.borrow().len() == 2);
        let few = PhaseWaves::new(&saint_venant(), &number("4"), FIRST_BITS).unwrap();
        let refused = ask(&few, Order::Value, Limit::Right, false).unwrap_err();
        assert!(matches!(refused, FieldError::Undecided { bits: FIRST_BITS, .. }), "{refused}");
        assert!(refused.to_string().contains("about t = 3.0676676416183063459"), "{refused}");
    }

    /// Integrals are those of what they are integrals of: by the rule of Simpson, within its error.
    #[test]
    fn integrals_follow_the_wave() {
        let waves = PhaseWaves::new(&saint_venant(), &number("4"), MAX_HISTORY_BITS).unwrap();
        let value = |order, thousandths: i64| {
            let at = Fraction::constant(&Rational::new(thousandths.into(), 1000.into()));
            let instant = Instant { at: &at, side: Limit::Right, is_drawn: false };
            waves.enclose(ROD, order, instant, 64).unwrap().to_double().0
        };
        for from in [0_i64, 950, 1300, 2100, 3040, 3800] {
            let orders = [Order::Slope, Order::Value, Order::Integral, Order::DoubleIntegral];
            for pair in orders.windows(2) {
                let [start, middle, end] = [from, from + 25, from + 50].map(|t| value(pair[0], t));
                let rule = 0.05 / 6.0 * (start + 4.0 * middle + end);
                let gain = value(pair[1], from + 50) - value(pair[1], from);
                let error = if from == 3040 { 1e-2 } else { 1e-7 };
                assert!((rule - gain).abs() < error, "{pair:?} from {from}: {rule} {gain}");
            }
        }
        assert_eq!(value(Order::Value, -10), 0.0);
        assert_eq!(value(Order::DoubleIntegral, 0), 0.0);
    }
}
