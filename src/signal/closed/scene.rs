//! Observables of scenes at times: the echoes that have arrived, enclosed.
//!
//! Times are in the scene's own scale and may be irrational there. What has arrived is decided
//! exactly; the echoes are then worked out with coefficients in balls, and those alone that reach the
//! place that is observed.

use crate::ball::{Ball, BallError, Binary, Magnitude};
use crate::enclosure::{Numbers, real_part};
use crate::expression::{Expression, Field, Fraction, Root};
use crate::network::Network;
use crate::recurrence::{Observation, WaveIndex};
use crate::signal::closed::echoes::{Arriving, Echoes, Unsolved, solve_in};
use crate::signal::closed::memory::Memory;
use crate::signal::closed::modular;
use crate::signal::closed::modular::{Modular, Residue};
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::signal::{EchoCount, Known, Limit, Point, has_begun};
use crate::signal::transforms::value_at;
use crate::solution::{Demand, EchoByEcho};
use num_traits::Zero;
use std::cell::{Cell, RefCell};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// The precision at which echoes are first worked out.
const FIRST_BITS: u64 = 128;

/// In so many echoes one bit is lost, about.
const ECHOES_A_BIT: u64 = 4;

/// At how many precisions echoes are held at once.
const MAX_PRECISIONS: usize = 2;

/// A value that is zero but for as many bits is suspected to be zero.
const SUSPICION_BITS: u64 = 64;

/// With fewer bits than these a divisor that may be zero is no error yet.
const PATIENT_BITS: u64 = 1 << 12;

/// A radius as a power of two that tells nothing.
const WIDE: i64 = 1 << 20;

/// The most echoes that are worked out exactly to see whether a value is zero, and where formulas hold a
/// named constant. With more constants that limit is divided by their number.
const MAX_EXACT_ECHOES: usize = 1_000;
const MAX_EXACT_ECHOES_NAMED: usize = 100;

/// The most terms of all these, and where formulas hold a named constant.
const MAX_EXACT_TERMS: usize = 1_000_000;
const MAX_EXACT_TERMS_NAMED: usize = 10_000;

/// Evaluates observables of a scene, up to a last time.
pub struct SceneEchoes<'a> {
    network: &'a Network,
    arriving: Arriving,
    numbers: Numbers,
    /// What was asked for before.
    wanted: RefCell<Vec<Observation>>,
    demand: RefCell<Demand>,
    known: RefCell<Solved>,
    expanded: Cell<usize>,
}

/// Echoes that have been worked out, as far as they are wanted.
#[derive(Default)]
struct Solved {
    /// As enclosures, by bits.
    enclosed: BTreeMap<u64, Rc<Echoes>>,
    /// As residues; `None` within where there are none.
    residues: Option<Option<Rc<Echoes<Residue>>>>,
    /// As expressions; `None` within where one cannot be given exactly.
    exact: Option<Option<Rc<Echoes<Expression>>>>,
}

/// An echo that has arrived: its wave and number, the coefficient it is seen with, and for how long.
struct Arrived {
    wave: WaveIndex,
    number: usize,
    coefficient: Expression,
    since: Fraction,
}

impl<'a> SceneEchoes<'a> {
    /// An evaluator for times up to `last`, in the scale of the scene.
    pub fn new(network: &'a Network, last: &Fraction) -> Outcome<SceneEchoes<'a>> {
        let arriving = Arriving::of(network, last)?;
        Ok(SceneEchoes {
            network,
            numbers: Numbers::new(arriving.unfolded.recurrence().constants()),
            wanted: RefCell::default(),
            known: RefCell::default(),
            demand: RefCell::new(Demand::none(arriving.unfolded.recurrence())),
            expanded: Cell::new(0),
            arriving,
        })
    }

    /// How many echoes can reach what was asked for.
    fn needed(&self) -> usize {
        self.demand.borrow().count()
    }

    /// How many echoes there are of what was asked for; all of them are needed.
    pub fn work(&self) -> Option<EchoCount> {
        if self.expanded.get() == 0 {
            self.solved(FIRST_BITS).ok()?;
        }
        let (expanded, needed) = (self.expanded.get(), self.needed());
        Some(EchoCount { expanded, arriving: needed, needed })
    }

    /// An observable in a unit at a time in the scale of the scene, zero before the start.
    /// The `n` echoes that reach the place in a bar take O(n³) operations, once for all times.
    pub fn point(
        &self,
        observation: &Observation,
        unit: &Root,
        at: &Fraction,
        side: Limit,
    ) -> Outcome<Point<'_>> {
        if self.numbers.compare(at, &self.arriving.last)? == Ordering::Greater {
            return Err(EvaluateError::AfterLast);
        }
        let unit = unit.clone();
        let arrived = self.arrived(observation, at, side)?;
        let forced = self.forcing(observation, at, side)?;
        if arrived.is_empty() && forced.is_zero() {
            return Ok(Point::exact(Rational::zero()));
        }
        self.want_until_last(observation)?;
        if let Some(value) = self.rational_value(&arrived, &forced, &unit) {
            return Ok(Point::exact(value));
        }
        let sum = Rc::new((arrived, forced));
        let known = Rc::clone(&sum);
        let enclose = move |bits| self.enclose(&sum.0, &sum.1, bits);
        let size = self.numbers.enclose_root(&unit, SUSPICION_BITS)?.magnitude();
        let own = unit.clone();
        let decide =
            move || Known::of(self.exact_later(&known.0, &known.1, &Fraction::zero()), &own);
        let in_unit = move |bits| {
            let value = patient(enclose(bits), bits)?;
            Ok(value.multiply(&self.numbers.enclose_root(&unit, bits)?, bits))
        };
        Ok(Point {
            known: Known::Unknown,
            enclose: Box::new(in_unit),
            decide: Box::new(decide),
            negligible: size.scale(-(SUSPICION_BITS as i64)),
            most_bits: u64::MAX,
        })
    }

    /// What is seen of the waves at a time.
    fn arrived(
        &self,
        observation: &Observation,
        at: &Fraction,
        side: Limit,
    ) -> Outcome<Vec<Arrived>> {
        let mut arrived = Vec::new();
        for seen in &observation.waves {
            let time = at - &seen.delay;
            for (number, delay) in self.arriving.begun(&self.numbers, &time, side)? {
                let (wave, coefficient) = (seen.wave, seen.coefficient.clone());
                arrived.push(Arrived { wave, number: *number, coefficient, since: &time - delay });
            }
        }
        Ok(arrived)
    }

    /// What is added to the waves at a time.
    fn forcing(
        &self,
        observation: &Observation,
        at: &Fraction,
        side: Limit,
    ) -> Outcome<Expression> {
        let begun = has_begun(self.numbers.compare(&Fraction::zero(), at)?, side);
        match begun && !observation.forcing.is_zero() {
            true => Ok(observation.forcing.substitute(&self.network.scene().time, at)?),
            false => Ok(Expression::zero()),
        }
    }

    /// Notes that all echoes are needed that are seen until the last time, once for all times before;
    /// what was worked out without them is dropped.
    pub(crate) fn want_until_last(&self, observation: &Observation) -> Outcome<()> {
        if self.wanted.borrow().contains(observation) {
            return Ok(());
        }
        self.wanted.borrow_mut().push(observation.clone());
        for Arrived { wave, number, .. } in
            self.arrived(observation, &self.arriving.last, Limit::Right)?
        {
            let mut demand = self.demand.borrow_mut();
            if !demand.wants(wave, number) {
                self.arriving.want(&mut demand, wave, number);
                *self.known.borrow_mut() = Solved::default();
            }
        }
        Ok(())
    }

    fn enclose(&self, arrived: &[Arrived], forced: &Expression, bits: u64) -> Outcome<Ball> {
        let echoes = self.solved(bits)?;
        let field = self.numbers.field(bits);
        let mut sum = field.embed(forced)?;
        for Arrived { wave, number, coefficient, since } in arrived {
            let echo = &echoes[*wave][*number];
            if echo.is_zero() {
                continue;
            }
            let x = field.embed(&since.clone().into())?;
            let coefficient = field.embed(coefficient)?;
            let value = value_at(echo, &x, &self.numbers, bits)?;
            sum = sum.add(&value.multiply(&coefficient, bits), bits);
        }
        Ok(real_part(sum)?)
    }

    /// All echoes that are wanted, with so many bits at least.
    fn solved(&self, bits: u64) -> Outcome<Rc<Echoes>> {
        if let Some((_, known)) = self.known.borrow().enclosed.range(bits..).next() {
            return Ok(known.clone());
        }
        let lost = self.needed() as u64 / ECHOES_A_BIT;
        let memory = Memory::of_balls(bits.max(FIRST_BITS + lost));
        let echoes = Rc::new(self.solve_in(self.numbers.field(bits), memory)?);
        let enclosed = &mut self.known.borrow_mut().enclosed;
        while enclosed.len() >= MAX_PRECISIONS {
            enclosed.pop_first();
        }
        enclosed.insert(bits, echoes.clone());
        Ok(echoes)
    }

    /// All echoes that are wanted, with coefficients in a field.
    fn solve_in<F: Field>(
        &self,
        field: F,
        memory: Memory,
    ) -> Result<Echoes<F::Value>, Unsolved<F::Error>> {
        let demand = self.demand.borrow().clone();
        let (echoes, expanded) =
            solve_in(self.arriving.unfolded.recurrence(), field, demand, memory)?;
        self.expanded.set(expanded);
        Ok(echoes)
    }

    fn residues(&self) -> Option<Rc<Echoes<Residue>>> {
        if let Some(known) = &self.known.borrow().residues {
            return known.clone();
        }
        let residues =
            self.solve_in(Modular, Memory::of(size_of::<Residue>() as u64)).ok().map(Rc::new);
        self.known.borrow_mut().residues = Some(residues.clone());
        residues
    }

    /// What is seen on a stretch, exactly, at a time that may hold a symbol: of the waves that have arrived
    /// when the stretch begins.
    pub(crate) fn exact_since(
        &self,
        observation: &Observation,
        from: &Fraction,
        at: &Fraction,
    ) -> Option<Expression> {
        self.want_until_last(observation).ok()?;
        let arrived = self.arrived(observation, from, Limit::Right).ok()?;
        let begun = self.numbers.compare(from, &Fraction::zero()).ok()? != Ordering::Less;
        let forced = match begun {
            true => observation.forcing.substitute(&self.network.scene().time, at).ok()?,
            false => Expression::zero(),
        };
        match arrived.is_empty() {
            true => Some(forced),
            false => self.exact_later(&arrived, &forced, &(at - from)),
        }
    }

    /// The sum as one exact expression, so much later than now; `None` where an echo cannot be given exactly.
    fn exact_later(
        &self,
        arrived: &[Arrived],
        forced: &Expression,
        later: &Fraction,
    ) -> Option<Expression> {
        let recurrence = self.arriving.unfolded.recurrence();
        let statement = recurrence.statement();
        let known = self.known.borrow().exact.clone();
        let echoes = match known {
            Some(known) => known,
            None => {
                let most = match recurrence.constants().len() {
                    0 => MAX_EXACT_ECHOES,
                    constants => MAX_EXACT_ECHOES_NAMED / constants,
                };
                let other_than_zero = || self.work().is_some_and(|work| work.expanded <= most);
                let feasible = !recurrence.has_named_rates() && other_than_zero();
                let echoes = feasible.then(|| self.exact_echoes()).flatten().map(Rc::new);
                self.known.borrow_mut().exact = Some(echoes.clone());
                echoes
            }
        }?;
        let mut sum = forced.clone();
        for Arrived { wave, number, coefficient, since } in arrived {
            let echo = echoes[*wave][*number].function(&statement.local);
            let since = since + later;
            sum.add_scaled(&echo.substitute(&statement.local, &since).ok()?, coefficient);
        }
        Some(sum)
    }

    /// All echoes that are wanted, exactly; `None` where they are too long.
    fn exact_echoes(&self) -> Option<Echoes<Expression>> {
        let recurrence = self.arriving.unfolded.recurrence();
        let most =
            if recurrence.constants().is_empty() { MAX_EXACT_TERMS } else { MAX_EXACT_TERMS_NAMED };
        let demand = self.demand.borrow().clone();
        let count = demand.last().map_or(0, |last| last + 1);
        let (mut solver, mut terms) = (EchoByEcho::new(recurrence).wanting(demand), 0);
        for _ in 0..count {
            let is_short = solver.advance_while(|echo| {
                terms += echo.term_count();
                terms <= most
            });
            if !is_short.ok()? {
                return None;
            }
        }
        Some(solver.echoes)
    }

    /// The value where it is a rational number, for scenes in rational numbers. That it is not is
    /// settled by residues, without long numbers: by the theorem of Lindemann and Weierstrass a sum
    /// is rational exactly when its terms with each exponent other than 0 add up to 0.
    fn rational_value(
        &self,
        arrived: &[Arrived],
        forced: &Expression,
        unit: &Root,
    ) -> Option<Rational> {
        let unit = unit.exact()?.as_constant()?;
        let echoes = self.residues()?;
        let mut groups = BTreeMap::<Rational, Residue>::new();
        let mut add = |exponent: Rational, value: Residue| {
            let sum = groups.entry(exponent).or_default();
            *sum = sum.plus(value);
        };
        for (exponent, coefficient) in forced.terms() {
            add(exponent.as_constant()?, Residue::of_rational(&coefficient.as_constant()?)?);
        }
        for Arrived { wave, number, coefficient, since } in arrived {
            let x = since.as_constant()?;
            let coefficient = Residue::of_rational(&coefficient.as_constant()?)?;
            for (pole, row) in echoes[*wave][*number].poles() {
                let value = modular::evaluate(row.iter().copied(), Residue::of_rational(&x)?);
                add(pole.as_constant()? * &x, value.times(coefficient));
            }
        }
        groups.remove(&Rational::zero());
        if groups.values().any(|residue| !residue.is_zero()) {
            return None;
        }
        Some(self.exact_later(arrived, forced, &Fraction::zero())?.as_constant()? * unit)
    }
}

/// Treats a division by what may be zero as unbounded, so that callers retry with more bits.
fn patient(found: Outcome<Ball>, bits: u64) -> Outcome<Ball> {
    match found {
        Err(EvaluateError::Ball(BallError::DivisorMayBeZero)) if bits < PATIENT_BITS => {
            Ok(Ball::new(Binary::zero(), Magnitude::power_of_two(WIDE)))
        }
        found => found,
    }
}
