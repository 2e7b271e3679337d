//! Observables as functions of time: where they are smooth, and enclosures there.
//!
//! Between two arrivals an observable is one exponential polynomial. On a grid it is made of one piece
//! of each wave that is seen; on a lattice of all echoes that have arrived. Either way it can be
//! enclosed at a time, and expanded about a time with a proven remainder: what tables of polynomials,
//! roots and largest values are made from. [`stretch`] tells where it is smooth, [`values`] what it is
//! there.

use crate::enclosure::Numbers;
use crate::signal::closed::echoes::{Arriving, Echoes, solve_in, whole_periods};
use crate::signal::closed::memory::Memory;
use crate::signal::closed::periods::Periods;
use crate::signal::closed::shares::{Kept, Shares};

use crate::ball::Magnitude;
use crate::expression::{Expression, Fraction, Root};
use crate::limits::{MAX_ECHOES, MAX_PIECES};
use crate::network::Network;
use crate::recurrence::{Observation, ObservedWave, Recurrence, WaveIndex};
use crate::signal::error::{EvaluateError, Outcome};
use crate::solution::Demand;
use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// The most stretches between arrivals of one window.
pub(super) const MAX_STRETCHES: usize = 200_000;

/// The most periods that are counted.
const MAX_ORDER: usize = 1_000_000_000;

/// The number of an echo on a grid that tells whether echoes become smaller.
const TELLING: usize = 32;

/// The precision of the first pieces, which tell what all will take.
const FORESEEING_BITS: u64 = 192;

/// So many pieces always fit.
const FEW_PIECES: usize = 400;

/// A bound as a power of two that tells nothing.
const WIDE: i64 = 1 << 20;

/// At how many precisions the waves are held at once.
const MAX_PRECISIONS: usize = 3;

/// An observable with numbers in place of all symbols, as a function of the user's time.
#[derive(Clone)]
pub struct ClosedForm {
    pub recurrence: Recurrence,
    pub observation: Observation,
    /// What 1 in the scale of the waves is.
    pub(crate) unit: Root,
    /// Time in the scale of the waves for one unit of the user's.
    pub(crate) slowness: Fraction,
    pub(crate) numbers: Rc<Numbers>,
    /// The echoes, where arrivals lie on no grid.
    pub(super) lattice: Option<Rc<Arriving>>,
    /// By wave, the arrivals on a grid that are worked out, where others are left out.
    arrivals: Option<Rc<[BTreeSet<usize>]>>,
    /// What each echo can bring to what is seen, once it was asked for.
    shares: Rc<OnceCell<Option<Shares>>>,
    /// The echoes that are worked out, where others may be left out.
    pub(super) kept: Option<Rc<Kept>>,
    /// All that is seen of the waves, here and in other views of them.
    seen: Rc<Observation>,
    /// The waves, by bits.
    solved: Rc<RefCell<ByBits>>,
}

/// The waves, by bits.
type ByBits = BTreeMap<u64, Rc<RefCell<Solved>>>;

/// The waves, in balls.
pub(super) enum Solved {
    Periods(Box<Periods>),
    Echoes(Rc<Echoes>),
}

impl ClosedForm {
    /// A wave or observable of a recurrence without symbols.
    pub fn of_recurrence(
        recurrence: &Recurrence,
        observation: &Observation,
    ) -> Outcome<ClosedForm> {
        ClosedForm::on_grid(recurrence, observation, Root::from(Fraction::one()), Fraction::one())
    }

    /// A function of time of a recurrence without waves, in the scale of a scene.
    pub(super) fn of_course(
        network: &Network,
        recurrence: &Recurrence,
        course: &Observation,
    ) -> Outcome<ClosedForm> {
        let (unit, slowness) = (Root::from(Fraction::one()), network.model().slowness.clone());
        ClosedForm::on_grid(recurrence, course, unit, slowness)
    }

    /// An observable of a scene in a unit, for times up to `last`; on a grid this may be any.
    pub fn of_scene(
        network: &Network,
        observation: &Observation,
        unit: Root,
        last: &Rational,
    ) -> Outcome<ClosedForm> {
        let slowness = network.model().slowness.clone();
        if network.lattice().periods().len() == 1 {
            let recurrence = network.recurrence()?;
            return ClosedForm::on_grid(&recurrence, observation, unit, slowness);
        }
        let arriving = Arriving::of(network, &slowness.scale(last))?;
        let recurrence = arriving.unfolded.recurrence();
        let signal = ClosedForm::on_grid(recurrence, observation, unit, slowness)?;
        Ok(ClosedForm { lattice: Some(Rc::new(arriving)), ..signal })
    }

    fn on_grid(
        recurrence: &Recurrence,
        observation: &Observation,
        unit: Root,
        slowness: Fraction,
    ) -> Outcome<ClosedForm> {
        if let Some(symbol) = recurrence.symbols().next() {
            return Err(EvaluateError::MissingValue(symbol.clone()));
        }
        Ok(ClosedForm {
            numbers: Rc::new(Numbers::new(recurrence.constants())),
            recurrence: recurrence.clone(),
            observation: observation.clone(),
            unit,
            slowness,
            lattice: None,
            arrivals: None,
            shares: Rc::default(),
            kept: None,
            seen: Rc::new(observation.clone()),
            solved: Rc::default(),
        })
    }

    /// A part of what is seen, in the scale of the waves; these are solved once for all of its parts.
    pub(super) fn part(&self, observation: &Observation) -> ClosedForm {
        let unit = Root::from(Fraction::one());
        let shares = Rc::default();
        ClosedForm { observation: observation.clone(), unit, shares, ..self.clone() }
    }

    /// The same from fewer echoes: those that are left out come to no more than `most` together, at any time until the end of
    /// the window, and enclosures of values hold as much more. `None` on a grid where later echoes do not become smaller,
    /// or all are needed.
    pub(super) fn within(&self, most: &Magnitude, to: &Rational) -> Outcome<Option<ClosedForm>> {
        let shares = match self.shares.get() {
            Some(shares) => shares,
            None => {
                let shares = self.bounded_shares(to)?;
                self.shares.get_or_init(|| shares)
            }
        };
        let Some(shares) = shares else { return Ok(None) };
        let (kept, arrivals) = match &self.lattice {
            Some(lattice) => (shares.keep(lattice, most), None),
            None => {
                let kept = shares.keep_first(&self.recurrence, most);
                let last = kept.demand.last().unwrap_or(0);
                if last >= self.order(to)? {
                    return Ok(None);
                }
                let arrivals = vec![(0..=last).collect(); self.recurrence.wave_count()];
                (kept, Some(arrivals.into()))
            }
        };
        let (kept, seen) = (Some(Rc::new(kept)), Rc::new(self.observation.clone()));
        let solved = Rc::default();
        Ok(Some(ClosedForm { kept, seen, solved, arrivals, ..self.clone() }))
    }

    fn bounded_shares(&self, to: &Rational) -> Outcome<Option<Shares>> {
        match &self.lattice {
            Some(lattice) => {
                Shares::of(lattice, &self.observation, &self.unit, &self.numbers).map(Some)
            }
            None if self.falls(to)? => self.shares_on_grid(to, MAX_ECHOES).map(Some),
            None => Ok(None),
        }
    }

    /// Whether waves on a grid are known to die out, and a window until this time is long enough for it.
    pub fn falls(&self, to: &Rational) -> Outcome<bool> {
        let is_long = self.is_on_grid() && (TELLING..=MAX_ECHOES).contains(&self.order(to)?);
        Ok(is_long && self.shares_on_grid(to, TELLING)?.fall(TELLING))
    }

    fn shares_on_grid(&self, to: &Rational, most: usize) -> Outcome<Shares> {
        let until = self.slowness.scale(to);
        let last_piece = |seen| Ok(self.last_piece(seen, &until, MAX_ECHOES)?.min(most));
        let waves = self.observation.waves.iter();
        let last = waves.map(last_piece).collect::<Outcome<Vec<_>>>()?;
        let wanted = (&self.recurrence, &last[..]);
        Shares::on_grid(wanted, &self.observation, &self.unit, (&self.numbers, &until))
    }

    /// What is left out of a value, and of a derivative, of which nothing is known then.
    pub(super) fn left_out(&self, derivative: usize) -> Magnitude {
        match &self.kept {
            Some(kept) if derivative == 0 || kept.rest.is_zero() => kept.rest,
            Some(_) => Magnitude::power_of_two(WIDE),
            None => Magnitude::ZERO,
        }
    }

    /// The length of a period in the user's time, near it; `None` on a lattice.
    pub fn period(&self) -> Option<f64> {
        let period = self.numbers.enclose(&self.recurrence.statement().period, 128).ok()?;
        let slowness = self.numbers.enclose(&self.slowness, 128).ok()?;
        let inverse = slowness.reciprocal(128).ok()?;
        self.is_on_grid().then(|| period.multiply(&inverse, 128).to_double().0)
    }

    /// Whether unit and time are those of the waves, but for rational factors.
    pub(crate) fn is_rational(&self) -> bool {
        let unit = self.unit.exact().and_then(|unit| unit.as_constant());
        unit.is_some() && self.slowness.as_constant().is_some()
    }

    /// Whether arrivals lie on one grid, so that pieces follow from earlier ones.
    pub fn is_on_grid(&self) -> bool {
        self.lattice.is_none()
    }

    /// On a grid, the number of the piece that is seen at a time, or the next one.
    ///
    /// # Errors
    /// [`EvaluateError::TooManyEchoes`] beyond a limit, where waves return.
    pub(super) fn last_piece(
        &self,
        seen: &ObservedWave,
        at: &Fraction,
        limit: usize,
    ) -> Outcome<usize> {
        let last = self.arrivals(seen.wave).map(last_of);
        let limit = if last.is_some() { usize::MAX } else { limit };
        up_to(last, || self.whole_periods(&(at - &seen.delay), limit))
    }

    /// As [`Recurrence::arrivals`], of one wave.
    pub(super) fn arrivals(&self, wave: WaveIndex) -> Option<&BTreeSet<usize>> {
        Some(&self.all_arrivals()?[wave])
    }

    fn all_arrivals(&self) -> Option<&[BTreeSet<usize>]> {
        self.arrivals.as_deref().or_else(|| self.recurrence.arrivals())
    }

    fn whole_periods(&self, time: &Fraction, limit: usize) -> Outcome<usize> {
        whole_periods(&self.numbers, time, &self.recurrence.statement().period, limit)
    }

    /// How many periods of the waves that are seen have begun at a time, or one more.
    pub fn periods(&self, at: &Rational) -> Outcome<usize> {
        let at = self.slowness.scale(at);
        // A wave may be seen before its own clock.
        let mut periods = self.whole_periods(&at, MAX_ORDER)?;
        for seen in &self.observation.waves {
            periods = periods.max(self.whole_periods(&(&at - &seen.delay), MAX_ORDER)?);
        }
        Ok(periods)
    }

    /// The number of the last piece that has begun at a time, or the next one; on a lattice, the largest number of echoes of
    /// one wave, of those that are worked out.
    pub fn order(&self, at: &Rational) -> Outcome<usize> {
        let Some(lattice) = &self.lattice else {
            let last = self.all_arrivals().and_then(|all| all.iter().map(last_of).max());
            return up_to(last, || self.periods(at));
        };
        Ok(match &self.kept {
            Some(kept) => kept.demand.most_of_a_wave(),
            None => lattice.arrivals.len(),
        })
    }

    /// What is solved with so many bits, or, where that has made room for others, with the least that are kept.
    fn known(&self, bits: u64) -> Option<Rc<RefCell<Solved>>> {
        let known = self.solved.borrow();
        let (least, with_least) = known.first_key_value()?;
        let made_room = known.len() == MAX_PRECISIONS && bits < *least;
        known.get(&bits).or(made_room.then_some(with_least)).cloned()
    }

    pub(super) fn solved(&self, bits: u64) -> Outcome<Rc<RefCell<Solved>>> {
        if let Some(known) = self.known(bits) {
            return Ok(known);
        }
        let solved = match &self.lattice {
            None => Solved::Periods(Box::new(Periods::new(
                &self.recurrence,
                self.numbers.clone(),
                bits,
            )?)),
            Some(lattice) => {
                let demand = match &self.kept {
                    Some(kept) => kept.demand.clone(),
                    None => self.demand(&lattice.arrivals),
                };
                let (echoes, expanded) = self.solve_echoes(demand, bits)?;
                self.kept.iter().for_each(|kept| kept.expanded.set(expanded));
                Solved::Echoes(Rc::new(echoes))
            }
        };
        let solved = Rc::new(RefCell::new(solved));
        let mut known = self.solved.borrow_mut();
        // With more bits wanted, those with few have done their work.
        while known.len() >= MAX_PRECISIONS {
            known.pop_first();
        }
        known.insert(bits, solved.clone());
        Ok(solved)
    }

    /// About how many bytes all waves of a scene take until a time; nothing to speak of where they are few. Foreseen
    /// for waves on one grid alone.
    pub fn foreseen(network: &Network, to: &Rational) -> Outcome<f64> {
        if network.lattice().periods().len() != 1 {
            return Ok(0.0);
        }
        ClosedForm::of_nothing(network, to)?.foresee(to)
    }

    /// The waves of a scene, of which nothing is seen.
    pub fn of_nothing(network: &Network, to: &Rational) -> Outcome<ClosedForm> {
        let nothing = Observation { waves: Vec::new(), forcing: Expression::zero() };
        ClosedForm::of_scene(network, &nothing, Root::from(Fraction::one()), to)
    }

    /// Refuses a time until which all pieces are more than can be held, before they are worked out; else about how
    /// many bytes they take.
    pub fn foresee(&self, to: &Rational) -> Outcome<f64> {
        let order = self.order(to)?;
        if self.lattice.is_some() || order < FEW_PIECES {
            return Ok(0.0);
        }
        if order > MAX_PIECES + 1 {
            let (echoes, limit) = (order as u128, MAX_PIECES);
            return Err(EvaluateError::TooManyEchoes { echoes, limit });
        }
        Periods::new(&self.recurrence, self.numbers.clone(), FORESEEING_BITS)?.foresee(order)
    }

    /// The echoes that are there until a time, by wave and number, with their numbers and delays.
    pub(crate) fn echoes(
        &self,
        to: &Rational,
        limit: usize,
        bits: u64,
    ) -> Outcome<(Echoes, Vec<(usize, Fraction)>)> {
        let order = self.order(to)?;
        if order > limit {
            return Err(EvaluateError::TooManyEchoes { echoes: order as u128, limit });
        }
        let arrivals = match &self.lattice {
            Some(lattice) => lattice.arrivals.clone(),
            None => {
                let period = &self.recurrence.statement().period;
                let delay = |k: usize| period.scale(&Rational::from_integer(k.into()));
                (0..=order).map(|k| (k, delay(k))).collect()
            }
        };
        let (echoes, _) = self.solve_echoes(self.demand(&arrivals), bits)?;
        Ok((echoes, arrivals))
    }

    fn solve_echoes(&self, demand: Demand, bits: u64) -> Outcome<(Echoes, usize)> {
        let field = self.numbers.field(bits);
        Ok(solve_in(&self.recurrence, field, demand, Memory::of_balls(bits))?)
    }

    /// The echoes that are needed for those of the waves that are seen.
    fn demand(&self, arrivals: &[(usize, Fraction)]) -> Demand {
        let mut demand = Demand::none(&self.recurrence);
        let exists = |k| self.lattice.as_ref().is_none_or(|l| l.unfolded.counts(k).is_some());
        for seen in &self.seen.waves {
            for (number, _) in arrivals {
                demand.add_where(&self.recurrence, seen.wave, *number, exists);
            }
        }
        demand
    }
}

fn last_of(arrivals: &BTreeSet<usize>) -> usize {
    arrivals.last().copied().unwrap_or(0)
}

/// How many periods there are, up to the last one that counts.
fn up_to(last: Option<usize>, periods: impl FnOnce() -> Outcome<usize>) -> Outcome<usize> {
    match last {
        Some(0) => Ok(0),
        Some(last) => Ok(last.min(periods()?)),
        None => periods(),
    }
}
