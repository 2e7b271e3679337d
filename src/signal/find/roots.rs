//! All roots of `f − v` in a window.
//!
//! Stretch by stretch, the cells of [`cover`](super::cover) leave runs on which `f − v` is strictly
//! monotone. Such a run holds exactly one root where the signs at its ends differ, and none where
//! they are the same. At an end of the stretch itself the limit counts; where it is exactly zero,
//! the root is the arrival, and the run has no other. On what stays open nothing is proven, with
//! three exceptions:
//!
//! - a stretch on which `f' = 0` coefficient by coefficient: `f` is constant, and one exact value
//!   tells whether it is `v`; where waves cancel each other, several exact values tell;
//! - an open cell at an arrival where `f − v` and `f'` both vanish exactly and `f''` has a sign on
//!   all of the cell: `f − v` has that sign beside the arrival;
//! - an open cell in which `f − v` only touches zero, at a simple fraction.
//!
//! Between stretches the two limits tell of jumps. The roots of a [`square`](super::square) are those of what is squared.

use crate::ball::{Ball, Value};
use crate::limits::{MAX_ROOTS, counted};
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::find::cover::{Cell, Finding, middle_and_half};
use crate::signal::find::refine::{Isolated, differ, power_of_half};
use crate::signal::find::search::{Search, Target};
use crate::signal::signal::{At, Limit};
use crate::signal::taylor::Near;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// A root of `f − v`, or where there may be one. Times are the user's.
///
/// ```
/// use wavestep::{Problem, Root};
///
/// let mass = Problem::builtin("rigid-mass")?.with("mu", 1)?;
/// let found = mass.signal("strain_impact")?.roots(2..=4, 9)?.all;
/// assert!(matches!(&found[0], Root::Simple { time, rises: true } if time.to_string() == "3.06766764"));
/// assert!(matches!(&found[1], Root::Jump { time, .. } if time.to_string() == "4"));
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Root {
    /// A change of sign with a derivative that is not zero.
    Simple {
        /// When.
        time: Value,
        /// Whether from below to above.
        rises: bool,
    },
    /// A root without a change of sign: of a square, or of even order at a simple fraction.
    Double {
        /// When.
        time: Value,
    },
    /// `f = v` exactly at an end of the window.
    End {
        /// When.
        time: Value,
    },
    /// `f = v` exactly in a limit where an echo arrives.
    Arrival {
        /// When.
        time: Value,
        /// Whether the limit from earlier times is v.
        before: bool,
        /// Whether the limit from later times, the value, is v.
        after: bool,
    },
    /// A jump over v where an echo arrives; there is no root.
    Jump {
        /// When.
        time: Value,
        /// The limits before and after, as they can be told.
        limits: [Value; 2],
    },
    /// `f = v` on all of an interval.
    Interval {
        /// Its first time, at which the value is v.
        from: Value,
        /// Its last time.
        to: Value,
        /// Whether the value is v at the last time as well.
        closed: bool,
    },
    /// An interval that may hold roots.
    Undecided {
        /// Its first time, rounded down.
        from: Rational,
        /// Its last time, rounded up.
        to: Rational,
        /// All values of `f − v` there.
        #[doc(hidden)]
        range: Ball,
        /// Whether the signs at its ends differ, so that there is at least one root.
        crosses: bool,
    },
}

impl Root {
    /// Whether `f − v` changes from below zero to above it, where it is known to change its sign at an instant.
    pub fn rises(&self) -> Option<bool> {
        match self {
            Root::Simple { rises, .. } => Some(*rises),
            Root::Jump { limits: [before, after], .. } => {
                Some(before.bounds()[0] < after.bounds()[0])
            }
            _ => None,
        }
    }
}

/// All roots of a window, in order.
///
/// # Invariants
/// - `f − v` has no other roots in the window; no root is in two of these.
///
/// ```
/// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
/// let found = mass.signal("strain_impact")?.roots(2..=4, 9)?;
/// assert_eq!((found.all.len(), found.undecided()), (2, 0));
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Roots {
    /// What was found.
    pub all: Vec<Root>,
}

impl Roots {
    /// How many intervals stay undecided.
    pub fn undecided(&self) -> usize {
        self.all.iter().filter(|root| matches!(root, Root::Undecided { .. })).count()
    }
}

/// The relative width in bits of an interval that stays undecided.
const UNDECIDED_BITS: u64 = 80;

/// The relative width in bits of an interval that may be about a root of even order.
const TOUCH_BITS: u64 = 40;

/// Bits with which a slope is told from zero before exact values are asked for.
const STILL_BITS: u64 = 256;

/// How often a stretch is halved for that.
const STILL_HALVINGS: u64 = 16;

/// A search on its way.
struct Finder<'s, 'a> {
    search: &'s Search<'a>,
    target: Target<'s>,
    digits: usize,
    all: Vec<Root>,
}

/// What is known of a stretch at its ends.
struct Ends {
    first: Option<Ordering>,
    last: Option<Ordering>,
    /// Whether the observable is v on all of it.
    vanishes: bool,
}

/// A number that is known.
fn known(value: &Rational) -> Value {
    Value::Exact(value.clone())
}

impl Search<'_> {
    /// All roots of `f − level` in the window, times with so many digits.
    pub fn roots(&self, level: &Rational, digits: usize, limit_bits: u64) -> Outcome<Roots> {
        if *level == Rational::default()
            && let Some(roots) = self.roots_of_square(digits, limit_bits)?
        {
            return Ok(roots);
        }
        let target = Target { order: 0, level, limit_bits: self.most_bits(limit_bits) };
        self.work.set(0);
        let mut finder = Finder { search: self, target, digits, all: Vec::new() };
        finder.all_stretches()?;
        Ok(Roots { all: finder.all })
    }

    /// When a stretch begins.
    pub(crate) fn beginning(
        &self,
        stretch: usize,
        digits: usize,
        limit_bits: u64,
    ) -> Outcome<Value> {
        if stretch == 0 {
            return Ok(known(self.function.window()[0]));
        }
        match self.function.exact_time(stretch, Limit::Right) {
            Some(time) => Ok(known(&time)),
            None => {
                let time = |bits| self.function.time(stretch, Limit::Right, bits);
                Ok(Value::certify(digits, limit_bits, time)?.exact_if_known())
            }
        }
    }

    /// Whether the observable is constant on a stretch: coefficient by coefficient, its derivative
    /// having none but exact zeros; or since waves cancel each other, as exact values prove.
    pub(crate) fn is_constant(&self, stretch: usize) -> Outcome<bool> {
        if self.function.is_zero(stretch) {
            return Ok(true);
        }
        let bounds = self.bounds(stretch)?;
        let (middle, half) = middle_and_half(&bounds[0], &bounds[1]);
        // A short cell takes few terms, and more bits cost less than the exact value.
        let half = half * power_of_half(STILL_HALVINGS);
        let bits = self.bits.get();
        let more = STILL_BITS.max(2 * bits).min(self.function.ready_bits());
        for bits in std::iter::once(bits).chain(Some(more).filter(|more| *more > bits)) {
            let near = Near { order: 1, place: (&middle, &half), terms: 4, bits };
            let slope = self.function.taylor(stretch, near)?;
            if slope.tail(0).is_zero() {
                return Ok(true);
            }
            if !slope.coefficients.iter().all(Ball::contains_zero) {
                return Ok(false);
            }
        }
        match self.function.exact(stretch, At::End(Limit::Right))? {
            Some(value) => self.function.equals(stretch, &value),
            None => Ok(false),
        }
    }

    /// The signs of a target at both ends of the i-th of the cells of a stretch; at the ends of the stretch
    /// itself, which the cell may reach beyond, those of the limits, which may be known.
    pub(crate) fn signs(
        &self,
        stretch: usize,
        target: Target<'_>,
        cells: &[Cell],
        i: usize,
        known: Option<[Option<Ordering>; 2]>,
    ) -> Outcome<[Option<Ordering>; 2]> {
        let sign = |is_end: bool, time, end, known: Option<Option<Ordering>>| match (is_end, known)
        {
            (true, Some(known)) => Ok(known),
            (true, None) => self.sign(stretch, target, At::End(end)),
            (false, _) => self.sign(stretch, target, At::Time(time)),
        };
        let (first, last) = (known.map(|known| known[0]), known.map(|known| known[1]));
        Ok([
            sign(i == 0, &cells[i].from, Limit::Right, first)?,
            sign(i + 1 == cells.len(), &cells[i].to, Limit::Left, last)?,
        ])
    }
}

impl Finder<'_, '_> {
    /// The roots of all stretches, and where they meet.
    fn all_stretches(&mut self) -> Outcome<()> {
        let (search, target) = (self.search, self.target);
        let equal = Some(Ordering::Equal);
        let mut before: Option<Ends> = None;
        for stretch in counted(0..search.count, "of the stretches") {
            let first = search.sign(stretch, target, At::End(Limit::Right))?;
            if search.function.is_instant(stretch) {
                let now = Ends { first, last: None, vanishes: false };
                return self.join(stretch, before, &now);
            }
            let last = search.sign(stretch, target, At::End(Limit::Left))?;
            let constant = search.is_constant(stretch)?;
            let vanishes = constant && (first == equal || last == equal);
            let now = Ends { first, last, vanishes };
            self.join(stretch, before, &now)?;
            if constant && first.is_none() {
                let [from, to] = search.bounds(stretch)?;
                self.leave(stretch, (from, to), false)?;
            } else if !constant {
                self.roots_within(stretch, &now)?;
            }
            self.check()?;
            before = Some(now);
        }
        let end = before.expect("a window has a stretch that is no instant");
        if end.vanishes {
            self.end_interval(known(search.function.window()[1]), equal);
        } else if end.last == equal {
            self.all.push(Root::End { time: known(search.function.window()[1]) });
        }
        Ok(())
    }

    /// Refuses to list too many.
    fn check(&self) -> Outcome<()> {
        match self.all.len() > MAX_ROOTS {
            true => Err(EvaluateError::TooManyRoots { limit: MAX_ROOTS }),
            false => Ok(()),
        }
    }

    /// What happens where a stretch begins.
    fn join(&mut self, stretch: usize, before: Option<Ends>, now: &Ends) -> Outcome<()> {
        let (search, digits, bits) = (self.search, self.digits, self.target.limit_bits);
        let time = || search.beginning(stretch, digits, bits);
        let equal = Ordering::Equal;
        let starts = now.vanishes && before.as_ref().is_none_or(|before| !before.vanishes);
        if starts {
            let interval = Root::Interval { from: time()?, to: time()?, closed: true };
            self.all.push(interval);
            return Ok(());
        }
        let Some(before) = before else {
            match now.first {
                Some(sign) if sign == equal => self.all.push(Root::End { time: time()? }),
                Some(_) => {}
                // A limit that cannot be told from v, and cells tell of what lies behind it alone.
                None => {
                    let [from, to] = search.bounds(stretch)?;
                    let beside = (&to - &from) * power_of_half(UNDECIDED_BITS);
                    self.leave(stretch, (from.clone(), from + beside), false)?;
                }
            }
            return Ok(());
        };
        if before.vanishes {
            if now.vanishes {
                return Ok(());
            }
            let time = time()?;
            self.end_interval(time, now.first);
            if now.first.is_some() {
                return Ok(());
            }
        }
        match (before.last, now.first) {
            (Some(before), Some(after)) if before == equal || after == equal => {
                let (before, after) = (before == equal, after == equal);
                let root = Root::Arrival { time: time()?, before, after };
                self.all.push(root);
            }
            (Some(before), Some(after)) if before != after => {
                let limits = [
                    self.limit_value(stretch - 1, Limit::Left)?,
                    self.limit_value(stretch, Limit::Right)?,
                ];
                let root = Root::Jump { time: time()?, limits };
                self.all.push(root);
            }
            (Some(_), Some(_)) => {}
            _ => {
                // A limit that cannot be told from v.
                let [from, _] = search.bounds(stretch)?;
                let [_, to] = search.bounds(stretch - 1)?;
                let (from, to) = if to < from { (to, from) } else { (from, to) };
                self.leave(stretch, (from, to), false)?;
            }
        }
        Ok(())
    }

    /// A limit with digits.
    fn limit_value(&self, stretch: usize, side: Limit) -> Outcome<Value> {
        let function = self.search.function;
        if let Some(value) = function.exact(stretch, At::End(side))? {
            return Ok(known(&value));
        }
        let limit = |bits| function.enclose(stretch, 0, At::End(side), bits);
        Ok(Value::certify(self.digits, self.target.limit_bits, limit)?.exact_if_known())
    }

    /// The roots within a stretch, its ends excluded.
    fn roots_within(&mut self, stretch: usize, ends: &Ends) -> Outcome<()> {
        let (search, target) = (self.search, self.target);
        let cells = search.cover(stretch, target, None)?;
        let count = cells.len();
        for (i, cell) in cells.iter().enumerate() {
            if matches!(cell.finding, Finding::Clear(_) | Finding::Low) {
                continue;
            }
            let signs = search.signs(stretch, target, &cells, i, Some([ends.first, ends.last]))?;
            match (cell.finding, signs) {
                (Finding::Monotone(_), [Some(first), Some(last)]) => {
                    if let Some(root) = Isolated::between(cell, stretch, [first, last]) {
                        let time = search.root(&root, target, self.digits)?;
                        self.all.push(Root::Simple { time, rises: root.rises });
                    }
                }
                (Finding::Monotone(slope), _) => {
                    // A value that cannot be told from v, and the root near it if there is one.
                    let mut root = Isolated::on(cell, stretch, slope == Ordering::Greater);
                    search.narrow(&mut root, target, UNDECIDED_BITS)?;
                    if root.from <= root.to {
                        self.leave(stretch, (root.from, root.to), false)?;
                    }
                }
                (_, [first, last]) => {
                    let equal = Some(Ordering::Equal);
                    let is_end = (i == 0 && first == equal) || (i + 1 == count && last == equal);
                    let touched = match is_end {
                        true => None,
                        false => self.touch(stretch, cell)?,
                    };
                    if let Some(time) = touched {
                        self.all.push(Root::Double { time: Value::Exact(time) });
                    } else {
                        let crosses = first.zip(last).is_some_and(|(a, b)| differ([a, b]));
                        self.leave(stretch, (cell.from.clone(), cell.to.clone()), crosses)?;
                    }
                }
            }
            self.check()?;
        }
        Ok(())
    }

    /// The only root in a cell, if it is a simple fraction `t₀` of even order k: exactly there `f − v`, `f'`, … `f^(k−1)`
    /// are zero, and `f^(k)` keeps its sign on the cell, so that `f(t) − v = (t − t₀)^k/k! f^(k)(ξ)`. At an end of the
    /// stretch limits count.
    fn touch(&self, stretch: usize, cell: &Cell) -> Outcome<Option<Rational>> {
        let (search, target) = (self.search, self.target);
        if &cell.to - &cell.from > &cell.to * power_of_half(TOUCH_BITS) {
            return Ok(None);
        }
        let near = Isolated::on(cell, stretch, true);
        let Some(time) = search.fraction_within(&near, target)? else { return Ok(None) };
        let is_end =
            |end| search.function.exact_time(stretch, end).is_some_and(|known| known == time);
        if is_end(Limit::Right) || is_end(Limit::Left) {
            return Ok(None);
        }
        let order = 1 + search.zeros_at(stretch, &time, 1);
        let target = Target { order, ..target };
        let range = search.range(stretch, target, (&cell.from, &cell.to), search.bits.get())?;
        let has_sign = range.sign().is_some_and(Ordering::is_ne);
        Ok((order.is_multiple_of(2) && has_sign).then_some(time))
    }

    /// Notes an interval on which nothing is proven, as one with that before it where they meet.
    fn leave(
        &mut self,
        stretch: usize,
        (mut from, mut to): (Rational, Rational),
        mut crosses: bool,
    ) -> Outcome<()> {
        let bits = self.search.bits.get();
        let mut range = self.search.range(stretch, self.target, (&from, &to), bits)?;
        if let Some(Root::Undecided { from: first, to: last, range: known, .. }) = self.all.last()
            && *last >= from
        {
            let ([a, b], [c, d]) = (known.bounds(), range.bounds());
            range = Ball::between(&a.min(c), &b.max(d), bits);
            (from, to, crosses) = (from.min(first.clone()), to.max(last.clone()), false);
            self.all.pop();
        }
        self.all.push(Root::Undecided { from, to, range, crosses });
        Ok(())
    }

    /// Ends the interval of roots that is last; its end belongs to it where the signal has the value there.
    fn end_interval(&mut self, end: Value, there: Option<Ordering>) {
        if let Some(Root::Interval { to, closed, .. }) = self.all.last_mut() {
            (*to, *closed) = (end, there == Some(Ordering::Equal));
        }
    }
}
