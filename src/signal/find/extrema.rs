//! The largest or smallest value on a window, and where it is taken.
//!
//! Branch and bound on every stretch: a cell whose largest value lies below one that is taken
//! elsewhere is dropped. On the cells left, `f'` without a root leaves the ends of the stretch
//! alone; `f'' > 0` likewise; on a run with `f'' < 0` the derivative falls strictly, and where it
//! changes sign there is exactly one critical point, refined as a root of `f'`. Where nothing of
//! this is proven, the cell itself is listed. The limits at both ends of every stretch are
//! candidates too, since observables jump.
//!
//! Candidates are compared by enclosures that are narrowed; those that cannot be told apart stay,
//! all of them. The supremum then lies between the largest lower bound and the largest upper bound.

use crate::ball::{Attempt, Ball, Binary, Precisions, Value};
use crate::limits::{MAX_ROOTS, counted};
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::find::cover::{Cell, Finding, middle_and_half};
use crate::signal::find::goal::{Goal, Record};
use crate::signal::find::refine::{Isolated, power_of_half};
use crate::signal::find::search::{Search, Target};
use crate::signal::signal::{At, Limit};
use std::cell::RefCell;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// The precisions at which candidates are compared.
fn comparisons() -> Precisions {
    Precisions::doubling(64, 512)
}

/// Where more places than so many are left, of which so many bits told none from the others, more bits are not tried: where a
/// motion returns again and again, they are equal.
const MANY_PLACES: usize = 8;
const MANY_BITS: u64 = 256;

/// Bits of balls beyond those of a value.
const SPARE_BITS: u64 = 64;

/// `−log₂` of an extremum that counts as zero. Where contacts part, a search has 640 bits, too few for the 1024 of single values.
const NOTHING_BITS: i64 = 512;

/// How near an end of a cell a change of sign is looked for: at parts of it of which each is the square of the one
/// before.
const NEAREST: usize = 9;

/// Bits of the least size of interest, which is rounded down.
const LEAST_BITS: u64 = 64;

/// Where an extremum is taken, or approached. Times are the user's.
///
/// ```
/// use wavestep::{Goal, Place, Problem};
///
/// let mass = Problem::builtin("rigid-mass")?.with("mu", 1)?;
/// let least = mass.signal("strain_fixed")?.extremum(Goal::Smallest, 0..=5, 9)?;
/// assert!(matches!(&least.places[..], [Place::Arrival { time, after: true, .. }] if time.to_f64() == 3.0));
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Place {
    /// At a simple root of the derivative.
    Critical(Value),
    /// At an end of the window.
    End(Value),
    /// Where an echo arrives.
    Arrival {
        /// When.
        time: Value,
        /// In the limit from earlier times.
        before: bool,
        /// In the limit from later times: the value itself.
        after: bool,
    },
    /// On all of an interval, at its first time as well.
    Plateau {
        /// Its first time.
        from: Value,
        /// Its end.
        to: Value,
        /// Whether the value is taken at the end as well.
        closed: bool,
    },
    /// Perhaps in an interval, in which nowhere is told apart from the largest value.
    Undecided {
        /// Its first time, rounded down.
        from: Rational,
        /// Its last time, rounded up.
        to: Rational,
    },
}

impl Place {
    /// The first time that it may be.
    pub(crate) fn from(&self) -> Rational {
        match self {
            Place::Critical(time)
            | Place::End(time)
            | Place::Arrival { time, .. }
            | Place::Plateau { from: time, .. } => {
                let [from, _] = time.bounds();
                from
            }
            Place::Undecided { from, .. } => from.clone(),
        }
    }

    /// Makes this place hold the next one too, which has the same value: a plateau and what it touches are one place.
    fn go_on(&mut self, next: &Place) -> bool {
        match (&mut *self, next) {
            (Place::Arrival { time, .. }, Place::Plateau { from, .. }) if time == from => {
                *self = next.clone();
            }
            (
                Place::Plateau { to, closed, .. },
                Place::Plateau { from, to: end, closed: end_is_taken },
            ) if to == from => (*to, *closed) = (end.clone(), *end_is_taken),
            (Place::Plateau { to, closed, .. }, Place::Arrival { time, .. }) if to == time => {
                *closed = true;
            }
            _ => return false,
        }
        true
    }

    /// Makes what is undecided hold a place that it touches, whichever comes first: neither is told apart from the other.
    fn blur(&mut self, next: &Place) -> bool {
        let undecided = |place: &Place| matches!(place, Place::Undecided { .. });
        let (Some([from, to]), Some([first, last])) = (self.extent(), next.extent()) else {
            return false;
        };
        let touch = first <= to && (undecided(self) || undecided(next));
        if touch {
            *self = Place::Undecided { from, to: to.max(last) };
        }
        touch
    }

    /// What an undecided interval would have to hold to hold this place; a limit from one side alone is told apart, and so is an
    /// end of the window, to which a value may only rise.
    fn extent(&self) -> Option<[Rational; 2]> {
        match self {
            Place::Undecided { from, to } => Some([from.clone(), to.clone()]),
            Place::Arrival { time, before: true, after: true } => Some(time.bounds()),
            _ => None,
        }
    }

    /// Whether the value is taken there: a limit from earlier times alone is not.
    pub fn is_attained(&self) -> bool {
        !matches!(self, Place::Arrival { after: false, .. })
    }
}

/// The largest or smallest value with all places that cannot be told apart.
///
/// ```
/// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
/// let greatest = mass.signal("velocity")?.extremum(wavestep::Goal::Largest, 0..=5, 9)?;
/// assert_eq!((greatest.value.to_string(), greatest.places.len()), ("1".into(), 1));
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Extremum {
    /// The value.
    pub value: Value,
    /// In order of time. With several of them one at least has the value; which one, balls do not
    /// tell.
    pub places: Vec<Place>,
}

/// A place that may have the largest value.
#[derive(Clone, Debug)]
enum Candidate {
    Limit {
        stretch: usize,
        side: Limit,
    },
    Critical(Isolated),
    /// A stretch on which the observable is constant, and the limit that tells its value.
    Plateau {
        stretch: usize,
        side: Limit,
    },
    Open {
        stretch: usize,
        from: Rational,
        to: Rational,
    },
}

/// The candidates of a window that are left.
struct Contenders<'a, 's> {
    search: &'a Search<'s>,
    goal: Goal,
    limit_bits: u64,
    /// Smaller ones are of no interest.
    least: Option<Binary>,
    left: RefCell<Vec<Candidate>>,
}

impl<'s> Search<'s> {
    /// The supremum or infimum on the window, with so many digits, and where it is taken.
    pub fn extremum(&self, goal: Goal, digits: usize, limit_bits: u64) -> Outcome<Extremum> {
        let found = self.extremum_beyond(goal, None, digits, limit_bits)?;
        Ok(found.expect("without a least size some place is the extremum"))
    }

    /// The same where it is at least of this size: no less than `least`, or no more than `−least`. What is below that is
    /// not looked at; `None` where all is.
    pub fn extremum_beyond(
        &self,
        goal: Goal,
        least: Option<&Rational>,
        digits: usize,
        limit_bits: u64,
    ) -> Outcome<Option<Extremum>> {
        if let (Goal::Smallest, None) = (goal, least)
            && let Some(extremum) = self.smallest_of_square(digits, limit_bits)?
        {
            return Ok(Some(extremum));
        }
        let contenders = self.contenders(goal, least, limit_bits)?;
        for bits in self.ready_comparisons() {
            let before = contenders.left.borrow().len();
            contenders.compare(bits)?;
            let left = contenders.left.borrow().len();
            if bits >= MANY_BITS && left > MANY_PLACES && left == before {
                break;
            }
        }
        if contenders.left.borrow().is_empty() {
            return Ok(None);
        }
        let exact = contenders.exact()?;
        let is_one = exact.is_some();
        let value = match exact {
            Some(value) => Value::Exact(value),
            None => {
                let limit = contenders.limit_bits;
                match Value::certify(digits, limit, |bits| contenders.enclose(bits))? {
                    Value::Enclosed(ball) => Value::near_zero(&ball, digits, NOTHING_BITS)
                        .unwrap_or(Value::Enclosed(ball)),
                    told => told.exact_if_known(),
                }
            }
        };
        Ok(Some(Extremum { value, places: contenders.places(digits, is_one)? }))
    }

    /// The most bits that two extrema are told apart with.
    pub const COMPARISON_BITS: u64 = 1 << 10;

    /// The sign of this extremum less that of another search; `None` where it is not decided, since they
    /// are equal or too near.
    pub fn compare_extremum(&self, other: &Search<'_>, goal: Goal) -> Outcome<Option<Ordering>> {
        let attempt = |bits| {
            let (own, others) =
                (self.enclose_extremum(goal, bits)?, other.enclose_extremum(goal, bits)?);
            let sign = own.subtract(&others, 2 * bits).sign().filter(|sign| sign.is_ne());
            Ok(Attempt::of(sign, sign.is_some()))
        };
        Precisions::doubling(64, Search::COMPARISON_BITS).raise(attempt).map(Attempt::best)
    }

    /// An enclosure of the extremum with a relative precision of about so many bits.
    pub fn enclose_extremum(&self, goal: Goal, bits: u64) -> Outcome<Ball> {
        let contenders = self.contenders(goal, None, 8 * bits)?;
        for early in comparisons().iter().filter(|early| *early < bits) {
            contenders.compare(early)?;
        }
        contenders.enclose(bits)
    }

    fn contenders(
        &self,
        goal: Goal,
        least: Option<&Rational>,
        limit_bits: u64,
    ) -> Outcome<Contenders<'_, 's>> {
        let limit_bits = self.most_bits(limit_bits);
        let least = least.map(|least| Ball::from_rational(least, LEAST_BITS).endpoints().0);
        self.work.set(0);
        let zero = Rational::default();
        let mut record = Record { goal, best: least.clone() };
        let (mut left, mut moving) = (Vec::new(), Vec::new());
        let left_over = RefCell::default();
        let contenders = Contenders { search: self, goal, limit_bits, least, left: left_over };
        // A value that never rises is largest at the start, one that never falls at the end; smallest the other way round.
        let trend = self.function.trend();
        let mut stretches: Vec<usize> = (0..self.count).collect();
        if trend == Some(goal.lesser().reverse()) {
            stretches.reverse();
        }
        for stretch in stretches {
            let instant = self.function.is_instant(stretch);
            if !instant && self.is_constant(stretch)? {
                left.push(Candidate::Plateau { stretch, side: Limit::Right });
                continue;
            }
            // Without jumps it is the limit from earlier times.
            if stretch == 0 || !self.function.is_continuous() {
                left.push(Candidate::Limit { stretch, side: Limit::Right });
            }
            if !instant {
                left.push(Candidate::Limit { stretch, side: Limit::Left });
                if trend.is_some() && self.changes(stretch)? {
                    break;
                }
                moving.push(stretch);
            }
        }
        let values = contenders.values(&mut left, comparisons().first())?;
        values.iter().for_each(|value| record.note(value));
        let mut values = values.iter();
        left.retain(|candidate| {
            let is_beaten = record.beats(values.next().expect("one value each"));
            !is_beaten && !contenders.is_beaten_by_sign(candidate, &record)
        });
        let target = Target { order: 1, level: &zero, limit_bits };
        for i in counted(0..moving.len(), "of the stretches") {
            let stretch = moving[i];
            self.critical_points(stretch, target, &mut record, &mut left)?;
            if left.len() > MAX_ROOTS + 2 * self.count {
                return Err(EvaluateError::TooManyRoots { limit: MAX_ROOTS });
            }
        }
        contenders.left.replace(left);
        Ok(contenders)
    }

    /// The precisions at which values are compared: whether they differ by less than is known already is not worth following a scene
    /// once more.
    fn ready_comparisons(&self) -> impl Iterator<Item = u64> {
        let ready = self.function.ready_bits().saturating_sub(SPARE_BITS);
        let ready = ready.max(comparisons().first());
        comparisons().iter().take_while(move |bits| *bits <= ready)
    }

    /// Whether the values at the two ends of a stretch differ for certain.
    fn changes(&self, stretch: usize) -> Outcome<bool> {
        for bits in self.ready_comparisons() {
            let end = |side| self.function.enclose(stretch, 0, At::End(side), bits + SPARE_BITS);
            let change = end(Limit::Left)?.subtract(&end(Limit::Right)?, bits);
            if change.sign().is_some_and(Ordering::is_ne) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn critical_points(
        &self,
        stretch: usize,
        target: Target<'_>,
        record: &mut Record,
        left: &mut Vec<Candidate>,
    ) -> Outcome<()> {
        let concave = record.goal.lesser();
        let cells = self.cover(stretch, target, Some(record))?;
        for (i, cell) in cells.iter().enumerate() {
            let whole = || [cell.from.clone(), cell.to.clone()];
            let open = match cell.finding {
                Finding::Clear(_) | Finding::Low => None,
                Finding::Open => Some(whole()),
                Finding::Monotone(sign) if sign != concave => None,
                Finding::Monotone(_) => match self.signs(stretch, target, &cells, i, None)? {
                    // Exactly flat at an end: the limit there is the extremum of the run.
                    [Some(first), Some(last)] => {
                        let root = Isolated::between(cell, stretch, [first, last]);
                        left.extend(root.map(Candidate::Critical));
                        None
                    }
                    [None, None] => Some(whole()),
                    // The slope falls from above zero to below, or the other way round.
                    [Some(first), None] if first == concave.reverse() => {
                        Some(self.beside_an_end(stretch, target, cell, (Limit::Left, first))?)
                    }
                    [None, Some(last)] if last == concave => {
                        Some(self.beside_an_end(stretch, target, cell, (Limit::Right, last))?)
                    }
                    [Some(_), None] | [None, Some(_)] => None,
                },
            };
            if let Some([from, to]) = open {
                left.push(Candidate::Open { stretch, from, to });
            }
        }
        Ok(())
    }

    /// What is left of a cell on which the slope is monotone and has a sign that is known but at one end: near that end alone
    /// it may change.
    fn beside_an_end(
        &self,
        stretch: usize,
        target: Target<'_>,
        cell: &Cell,
        (side, sign): (Limit, Ordering),
    ) -> Outcome<[Rational; 2]> {
        let (mut open, width) = ([cell.from.clone(), cell.to.clone()], &cell.to - &cell.from);
        for bits in std::iter::successors(Some(1), |bits| Some(2 * bits)).take(NEAREST) {
            let apart = &width * power_of_half(bits);
            let (place, at) = match side {
                Limit::Right => (1, &cell.from + apart),
                Limit::Left => (0, &cell.to - apart),
            };
            if self.sign(stretch, target, At::Time(&at))? != Some(sign) {
                break;
            }
            open[place] = at;
        }
        Ok(open)
    }
}

impl Contenders<'_, '_> {
    /// The value at a candidate, raised as the goal asks.
    fn value(&self, candidate: &mut Candidate, bits: u64) -> Outcome<Ball> {
        let search = self.search;
        let working = (bits + SPARE_BITS).max(search.bits.get());
        let zero = Rational::default();
        let target = Target { order: 0, level: &zero, limit_bits: self.limit_bits };
        let value = match candidate {
            Candidate::Limit { stretch, side } | Candidate::Plateau { stretch, side } => {
                search.enclose(*stretch, target, At::End(*side), working)?
            }
            Candidate::Critical(root) => {
                let slope = Target { order: 1, ..target };
                // The value is as flat as the square of what is unknown of the time.
                search.narrow(root, slope, bits / 2 + 8)?;
                let (middle, half) = middle_and_half(&root.from, &root.to);
                search.expand(root.stretch, target, (&middle, &half), 8, working)?.range()
            }
            Candidate::Open { stretch, from, to } => {
                search.range_of_small(*stretch, target, (from, to), working)?
            }
        };
        Ok(self.goal.raised(value))
    }

    /// Whether a limit is beaten by the sign that is known of it.
    fn is_beaten_by_sign(&self, candidate: &Candidate, record: &Record) -> bool {
        let Candidate::Limit { stretch, side } = candidate else { return false };
        let signed = self.search.function.signed(*stretch).filter(|own| own.holds_at(*side));
        signed.is_some_and(|own| record.beats_sign(own.sign))
    }

    /// The values at all candidates that are left.
    fn values(&self, left: &mut [Candidate], bits: u64) -> Outcome<Vec<Ball>> {
        left.iter_mut().map(|candidate| self.value(candidate, bits)).collect()
    }

    /// Drops those that are certainly smaller than another.
    fn compare(&self, bits: u64) -> Outcome<()> {
        let mut left = self.left.borrow_mut();
        if left.len() > 1 || self.least.is_some() {
            let values = self.values(&mut left, bits)?;
            let mut record = Record { goal: self.goal, best: self.least.clone() };
            values.iter().for_each(|value| record.note(value));
            let mut values = values.iter();
            left.retain(|_| !record.beats(values.next().expect("one value each")));
        }
        Ok(())
    }

    /// An enclosure of the extremum.
    fn enclose(&self, bits: u64) -> Outcome<Ball> {
        let values = self.values(&mut self.left.borrow_mut(), bits)?;
        if let [only] = &values[..] {
            return Ok(self.goal.raised(only.clone()));
        }
        let larger = |[a, b]: [Rational; 2], [c, d]: [Rational; 2]| [a.max(c), b.max(d)];
        let bounds = values.iter().map(Ball::bounds).reduce(larger);
        let [lower, upper] = bounds.expect("a window has ends");
        Ok(self.goal.raised(Ball::between(&lower, &upper, bits + SPARE_BITS)))
    }

    /// The extremum where it is the same rational number at all places that are left.
    fn exact(&self) -> Outcome<Option<Rational>> {
        let mut common: Option<Rational> = None;
        let (search, zero) = (self.search, Rational::default());
        let slope = Target { order: 1, level: &zero, limit_bits: self.limit_bits };
        for candidate in &mut *self.left.borrow_mut() {
            let exact = match candidate {
                Candidate::Limit { stretch, side } | Candidate::Plateau { stretch, side } => {
                    search.function.exact(*stretch, At::End(*side))?
                }
                Candidate::Critical(root) => match search.narrowed_to_fraction(root, slope)? {
                    Some(time) => search.function.exact(root.stretch, At::Time(&time))?,
                    None => None,
                },
                Candidate::Open { .. } => None,
            };
            let Some(value) = exact else { return Ok(None) };
            if common.get_or_insert_with(|| value.clone()) != &value {
                return Ok(None);
            }
        }
        Ok(common)
    }

    /// Where the extremum is; `is_one` where all that are left are known to have the same value.
    fn places(&self, digits: usize, is_one: bool) -> Outcome<Vec<Place>> {
        let search = self.search;
        let zero = Rational::default();
        let target = Target { order: 1, level: &zero, limit_bits: self.limit_bits };
        let exact = |time: &Rational| Value::Exact(time.clone());
        let (last, continuous) = (search.count - 1, search.function.is_continuous());
        // Whether what is taken on a stretch is taken at its end, too.
        let is_closed = |stretch| if stretch == last { !search.open } else { continuous };
        let end = |stretch: usize| match stretch == last {
            true => Ok(exact(search.function.window()[1])),
            false => search.beginning(stretch + 1, digits, self.limit_bits),
        };
        let mut found: Vec<(usize, u8, Place)> = Vec::new();
        for candidate in &*self.left.borrow() {
            found.push(match candidate {
                Candidate::Limit { stretch, side: Limit::Right } => {
                    let time = search.beginning(*stretch, digits, self.limit_bits)?;
                    let place = match stretch {
                        0 => Place::End(time),
                        _ => Place::Arrival { time, before: false, after: true },
                    };
                    (*stretch, 0, place)
                }
                Candidate::Limit { stretch, side: Limit::Left } => {
                    let time = end(*stretch)?;
                    let place = match is_closed(*stretch) {
                        true if *stretch == last => Place::End(time),
                        after => Place::Arrival { time, before: true, after },
                    };
                    (*stretch, 2, place)
                }
                Candidate::Critical(root) => {
                    (root.stretch, 1, Place::Critical(search.root(root, target, digits)?))
                }
                Candidate::Plateau { stretch, .. } => {
                    let from = search.beginning(*stretch, digits, self.limit_bits)?;
                    let (to, closed) = (end(*stretch)?, is_closed(*stretch));
                    (*stretch, 1, Place::Plateau { from, to, closed })
                }
                Candidate::Open { stretch, from, to } => {
                    (*stretch, 1, Place::Undecided { from: from.clone(), to: to.clone() })
                }
            });
        }
        found.sort_by_key(|(stretch, rank, _)| (*stretch, *rank));
        let mut places: Vec<Place> = Vec::new();
        for (_, _, place) in found {
            let joined = match (places.last_mut(), &place) {
                // Both limits at one arrival are one place.
                (
                    Some(Place::Arrival { time: known, before: true, after }),
                    Place::Arrival { time, before: false, after: true },
                ) if known == time => {
                    *after = true;
                    true
                }
                (Some(last), place) => (is_one || continuous) && last.go_on(place),
                (None, _) => false,
            };
            if !joined {
                places.push(place);
            }
        }
        places.dedup_by(|next, known| known.blur(next));
        Ok(places)
    }
}
