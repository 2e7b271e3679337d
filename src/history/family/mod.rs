//! The motions of a scene for all values of a symbol between two.
//!
//! Time is measured in a *step*, of which every travel time is a whole multiple whatever the symbol is. So what arrives
//! on a step left another node so many steps before, as in the method of steps for one value, but every coefficient
//! of a polynomial in time is a polynomial in the symbol, too. What both leave out is bounded by the energy of each node,
//! as in `passivity`: its matrices hold for all values at once.
//!
//! This file prepares a scene, and `exponential` its loads. `motion` follows it cell by cell (`grid`), in functions on a cell
//! (`on_cell`) with coefficients over the symbol (`symbol`). `node` tells what a node does on a cell, and `opening` when its
//! contacts change, which `plan` collects; `compared` is the state in which motions are compared there. `modes` encloses modes
//! of vibration, and `envelope` bounds sizes.

mod compared;
pub mod envelope;
mod exponential;
pub mod grid;
pub mod modes;
mod motion;
mod node;
pub mod on_cell;
mod opening;
mod plan;
mod symbol;

use crate::ball::{Arithmetic as _, BallError, Magnitude};
use crate::enclosure::EnclosureError;
use crate::expression::{Fraction, NotAUnit, Root};
use crate::limits::{MAX_STEPS_OVER_SYMBOL, MAX_SYMBOL_BITS as BITS};
use crate::model::NotRepresented;
use crate::network::{
    Contacts, ElementLaw, Elements, Energy, Field, Layout, Measured, MeasuredValue, ModelLoad,
    Node, Reading, ScaledScene, Section, Term, common_measure,
};
use crate::scene::ElementIndex;
use crate::signal::Varying;
use exponential::Exponential;
use grid::Grid;
use motion::{Bar, Loading, Motion, Summand, TERMS};
use node::{NodeState, SteppedNode};
use num_traits::{One as _, ToPrimitive as _, Zero as _};
use on_cell::OnCell;
pub use plan::Change;
use plan::{Plan, ways};
use symbol::OverSymbol;
use wavestep_polynomial::{Rational, Symbol};

/// How often a scene is followed again with another cut.
const MOST_CUTS: usize = 32;

/// Why motions are not followed over a symbol.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum NotOverSymbol {
    #[error("local contacts are not supported over a symbol")]
    LocalContact,
    #[error("the energy that has passed somewhere is not supported over a symbol")]
    Work,
    #[error(
        "a contact that opens or is open at the start, one beside a load without mass between, and one that closes between two masses are not supported over a symbol"
    )]
    BesideContact,
    #[error("it is not decided when contacts open and close")]
    Undecided,
    #[error("`{0}` is not supported over a symbol: it has powers of time above {most}", most = TERMS - 1)]
    Load(String),
    #[error("the travel times have no common divisor for all values of the symbol")]
    NoCommonMeasure,
    #[error(
        "the window takes more than {MAX_STEPS_OVER_SYMBOL} steps of time: choose an earlier end"
    )]
    TooManySteps,
    #[error("it has no modes of vibration: {0}")]
    Modes(#[from] NotRepresented),
    #[error("the frequencies of its modes are not enclosed")]
    Frequency,
    #[error("a joint without mass moves, and nothing resists it")]
    Unresisted,
    #[error("`{0}` is not an observable of the scene")]
    Unknown(String),
    #[error(transparent)]
    Value(#[from] EnclosureError),
    #[error(transparent)]
    Ball(#[from] BallError),
    #[error(transparent)]
    Division(#[from] NotAUnit),
}

impl NotOverSymbol {
    /// Whether fewer values of the symbol at once may be followed.
    pub fn may_pass_if_narrower(&self) -> bool {
        use EnclosureError::NotReal;
        use NotOverSymbol::{Ball, Frequency, TooManySteps, Undecided, Unresisted, Value};
        matches!(
            self,
            TooManySteps
                | Undecided
                | Unresisted
                | Frequency
                | Ball(_)
                | Value(EnclosureError::Ball(_) | NotReal)
        )
    }
}

type Outcome<T> = Result<T, NotOverSymbol>;

/// A scene with a symbol, the values that it takes, and what is observed.
pub struct Over<'a> {
    scaled: &'a ScaledScene,
    /// With contacts that may open as links.
    layout: Layout,
    measured: &'a Measured,
    symbol: OverSymbol<'a>,
}

impl<'a> Over<'a> {
    /// # Errors
    /// [`NotOverSymbol`] for what is not followed.
    pub fn new(
        scaled: &'a ScaledScene,
        name: &str,
        (symbol, between): (&'a Symbol, [&'a Rational; 2]),
    ) -> Outcome<Over<'a>> {
        let model = scaled.model();
        if scaled.local_contact().is_some() {
            return Err(NotOverSymbol::LocalContact);
        }
        let measured = scaled.measures.iter().find(|own| own.name == name);
        let measured = measured.ok_or_else(|| NotOverSymbol::Unknown(name.to_owned()))?;
        let symbol = OverSymbol { symbol, between, constants: &model.constants };
        let layout = Layout::of(scaled.scene(), model, Contacts::of(scaled.scene()));
        Ok(Over { scaled, layout, measured, symbol })
    }

    /// The steps for these scenes: the largest common measure of all travel times, of the times at which loads begin and end,
    /// and of the delays of what is observed, halved until no rate of a node or a load exceeds two. Where contacts
    /// open, steps are cut instead, and once more, since a cut may be left out.
    ///
    /// # Errors
    /// [`NotOverSymbol::NoCommonMeasure`]; [`NotOverSymbol::BesideContact`] for one that begins apart; else as
    /// [`Over::follow`].
    pub fn grid(all: &[&Over<'_>]) -> Outcome<Grid> {
        if all.iter().any(|own| !own.scaled.model().gaps.is_empty()) {
            return Err(NotOverSymbol::BesideContact);
        }
        let times = all.iter().flat_map(|own| {
            let model = own.scaled.model();
            let travels = model.bars.values().filter_map(|bar| bar.travel.as_ref());
            let loads = model.loads.values();
            let moments = loads.flat_map(|load| std::iter::once(&load.from).chain(&load.until));
            let terms = match &own.measured.value {
                MeasuredValue::Linear(terms) => &terms[..],
                MeasuredValue::Energy { .. } => &[],
            };
            let delays = terms.iter().flat_map(|term| term.of.delays());
            let times = travels.chain(moments).chain(delays);
            times.map(|time| Root::from(time).times(&model.scale.time))
        });
        let times: Vec<Root> = times.filter(|time| !time.factor().is_zero()).collect();
        let unit = || all[0].scaled.model().scale.time.clone();
        let first = times.first().cloned().unwrap_or_else(unit);
        let mut measure = Rational::one();
        for time in &times {
            measure = common_measure(&measure, &constant(&time.over(&first)?)?);
        }
        let step = |measure: &Rational| first.times(&Fraction::constant(measure).into());
        let unit = step(&measure);
        let mut fastest = Magnitude::ZERO;
        for own in all {
            for node in own.nodes(&Grid::new(unit.clone(), 1)?, &[], 0)? {
                let rates = node.loads.iter().map(|load| load.rate);
                let rates = rates.chain(node.ways.iter().map(|way| way.passivity.rate()));
                fastest = rates.fold(fastest, Magnitude::max);
            }
        }
        let parts = parts_of(&fastest)?;
        match all.iter().any(|own| own.has_contacts()) {
            true => Grid::new(unit, 2 * parts),
            false => Grid::new(step(&(measure / Rational::from_integer(parts.into()))), 1),
        }
    }

    fn has_contacts(&self) -> bool {
        self.scaled.scene().contacts_open
    }

    /// A time of the user's in steps: between which numbers it lies.
    pub fn in_steps(&self, time: &Fraction, step: &Root) -> Outcome<[Rational; 2]> {
        let steps = self.symbol.root(&Root::from(time).over(step)?)?;
        let [low, high] = steps.range().bounds();
        Ok([low.max(Rational::zero()), high])
    }

    /// The first steps, and what is observed on them in the user's unit. Where contacts open and close, the grid is cut; it may
    /// have cuts already where it is known that contacts close.
    pub fn follow(&self, grid: &Grid, closings: &[Change], steps: usize) -> Outcome<Followed> {
        let mut plan = Plan { grid: grid.clone(), changes: closings.to_vec() };
        for _ in 0..MOST_CUTS {
            let Plan { grid, changes } = &plan;
            let count = steps.saturating_mul(grid.cells());
            if count > MAX_STEPS_OVER_SYMBOL {
                return Err(NotOverSymbol::TooManySteps);
            }
            let (bars, nodes) = (self.bars(grid)?, self.nodes(grid, changes, count)?);
            match Motion::of(grid, bars, nodes, count) {
                Ok(motion) => {
                    let (factors, summands) = self.observed(grid)?.into_iter().unzip();
                    let closings = plan.closings();
                    return Ok(Followed { grid: plan.grid, closings, motion, factors, summands });
                }
                Err((cell, stop)) => plan = plan.after(cell, stop)?,
            }
        }
        Err(NotOverSymbol::Undecided)
    }

    /// The step in the scale of the scene.
    fn scaled_step(&self, step: &Root) -> Outcome<Root> {
        Ok(step.over(&self.scaled.model().scale.time)?)
    }

    /// How long a step is in the scale of the scene.
    pub fn length(&self, step: &Root) -> Outcome<Varying> {
        Ok(self.symbol.root(&self.scaled_step(step)?)?)
    }

    /// How many steps a time in the scale of the scene takes.
    ///
    /// # Errors
    /// [`NotOverSymbol::NoCommonMeasure`] where it is not.
    pub fn whole_steps(&self, time: &Fraction, step: &Root) -> Outcome<i64> {
        let count = constant(&Root::from(time).over(&self.scaled_step(step)?)?)?;
        let whole = count.is_integer().then(|| count.to_i64()).flatten();
        whole.ok_or(NotOverSymbol::NoCommonMeasure)
    }

    /// Whether it may be zero for some value of the symbol.
    pub fn may_be_zero(&self, value: &Fraction) -> Outcome<bool> {
        Ok(self.symbol.fraction(value)?.range().contains_zero())
    }

    /// The same in cells.
    fn lag(&self, time: &Fraction, grid: &Grid) -> Outcome<usize> {
        let steps = usize::try_from(self.whole_steps(time, &grid.step)?);
        let cells = steps.ok().and_then(|steps| steps.checked_mul(grid.cells()));
        cells.ok_or(NotOverSymbol::NoCommonMeasure)
    }

    /// The bars, and the waves in them before the start, `(V ± X_0/Z)/2`.
    fn bars(&self, grid: &Grid) -> Outcome<Vec<Bar>> {
        let bar = |(place, element)| {
            let bar = &self.scaled.model().bars[element];
            let [velocity, force] =
                [&bar.velocity, &bar.force].map(|own| self.symbol.fraction(own));
            let (velocity, pressed) =
                (velocity?, force?.multiply(&self.inverse(&bar.impedance)?, BITS));
            let before = [velocity.add(&pressed, BITS), velocity.subtract(&pressed, BITS)];
            let before = before.map(|own| OnCell::constant(&own.over(2, BITS)));
            let lag = bar.travel.as_ref().map(|travel| self.lag(travel, grid)).transpose()?;
            Ok(Bar { before, lag, ends: self.layout.ends[place] })
        };
        self.layout.bars.iter().enumerate().map(bar).collect()
    }

    fn inverse(&self, value: &Fraction) -> Outcome<Varying> {
        Ok(self.symbol.fraction(value)?.reciprocal(BITS)?)
    }

    /// The nodes at the start, and their loads on `count` cells. With the step `h` as the unit of time a mass counts as `M/h`
    /// and a stiffness as `kh`, and displacements are in units of `h`.
    fn nodes(&self, grid: &Grid, changes: &[Change], count: usize) -> Outcome<Vec<SteppedNode>> {
        let length = self.length(&grid.step)?;
        let inverse = length.reciprocal(BITS)?;
        let place = |exact: &Node<Fraction>| {
            let mut node = exact.map(|value| self.symbol.fraction(value))?;
            for own in &mut node.elements {
                match &mut own.law {
                    ElementLaw::Mass { mass, .. } => *mass = mass.multiply(&inverse, BITS),
                    ElementLaw::Spring { stiffness, .. }
                    | ElementLaw::Support { stiffness, .. } => {
                        *stiffness = stiffness.multiply(&length, BITS);
                    }
                    _ => {}
                }
            }
            let ways = ways(&node, grid, changes)?;
            let start = NodeState::at_start(&node, &ways[0])?;
            let loads = node.elements.iter().filter(|own| own.law.is_driven());
            let loads = loads.map(|own| self.loading(own.element, grid, count));
            let loads = loads.collect::<Outcome<_>>()?;
            Ok(SteppedNode { node, ways, start, loads })
        };
        self.layout.nodes.iter().map(place).collect()
    }

    /// A load on `count` cells, with a step as the unit of time.
    fn loading(&self, element: ElementIndex, grid: &Grid, count: usize) -> Outcome<Loading> {
        let (scene, model) = (self.scaled.scene(), self.scaled.model());
        let ModelLoad { course, from, until } = &model.loads[&element];
        let length = self.length(&grid.step)?;
        let terms = Exponential::all(course, &scene.time, &length, &self.symbol)?;
        let terms =
            terms.ok_or_else(|| NotOverSymbol::Load(scene.elements[element].name.clone()))?;
        let rate = terms.iter().map(Exponential::rate).max().unwrap_or(Magnitude::ZERO);
        let course = Exponential::total(&terms, grid, count)?;
        let until = until.as_ref().map(|until| self.lag(until, grid)).transpose()?;
        Ok(Loading { acts: self.lag(from, grid)?..until.unwrap_or(usize::MAX), rate, course })
    }

    /// What is observed, with factors in the user's unit.
    fn observed(&self, grid: &Grid) -> Outcome<Vec<(Varying, Summand)>> {
        let unit = self.symbol.root(&self.measured.unit)?;
        let mut parts = Vec::new();
        match &self.measured.value {
            MeasuredValue::Linear(terms) => {
                for term in terms {
                    parts.extend(self.linear(term, grid)?);
                }
            }
            MeasuredValue::Energy { held: shares, passed } => {
                if !passed.is_empty() {
                    return Err(NotOverSymbol::Work);
                }
                let (model, layout) = (self.scaled.model(), &self.layout);
                for (share, element) in shares {
                    let share = self.symbol.fraction(share)?;
                    let energy = Elements { model, layout }.energy(*element);
                    for own in energy.map_err(|_| NotOverSymbol::LocalContact)? {
                        let (factor, of) = match own {
                            Energy::Square(term) => {
                                let one = Term { coefficient: Fraction::one(), of: term.of };
                                let (factors, of) = self.linear(&one, grid)?.into_iter().unzip();
                                let factor = self.symbol.fraction(&term.coefficient)?;
                                (factor, Summand::Square(factors, of))
                            }
                            Energy::InBar(bar) => self.stored(bar, OnCell::square, grid)?,
                            Energy::Work(..) => return Err(NotOverSymbol::LocalContact),
                        };
                        parts.push((factor.multiply(&share, BITS), of));
                    }
                }
            }
        }
        Ok(parts.into_iter().map(|(factor, of)| (factor.multiply(&unit, BITS), of)).collect())
    }

    /// What a bar holds, `Z ∫ (w₊ + w₋) dt` or the same of squares.
    fn stored(
        &self,
        bar: usize,
        of: fn(&OnCell) -> OnCell,
        grid: &Grid,
    ) -> Outcome<(Varying, Summand)> {
        let own = &self.scaled.model().bars[&self.layout.bars[bar]];
        let impedance = self.symbol.fraction(&own.impedance)?;
        let step = self.length(&grid.step)?;
        Ok((impedance.multiply(&step, BITS), Summand::InBar { bar, of }))
    }

    /// What is linear in the motion, with its delays in cells.
    fn linear(&self, term: &Term, grid: &Grid) -> Outcome<Vec<(Varying, Summand)>> {
        let (model, layout) = (self.scaled.model(), &self.layout);
        let mut factor = self.symbol.fraction(&term.coefficient)?;
        let in_steps = || self.length(&grid.step);
        let of = match &term.of {
            Reading::Force(lump) => {
                let terms = Elements { model, layout }.force(*lump);
                let mut parts = Vec::new();
                for own in terms.ok_or(NotOverSymbol::LocalContact)? {
                    let coefficient = &term.coefficient * &own.coefficient;
                    parts.extend(self.linear(&Term { coefficient, of: own.of }, grid)?);
                }
                return Ok(parts);
            }
            Reading::Velocity(face) => Summand::Now(Reading::Velocity(*face)),
            Reading::Displacement(face) => {
                factor = factor.multiply(&in_steps()?, BITS);
                Summand::SinceStart(Reading::Velocity(*face))
            }
            Reading::Compression(lump) => {
                factor = factor.multiply(&in_steps()?, BITS);
                Summand::Now(Reading::Compression(*lump))
            }
            Reading::Momentum(bar) => {
                let (stored, of) = self.stored(*bar, OnCell::clone, grid)?;
                factor = factor.multiply(&stored, BITS);
                of
            }
            Reading::InBar(field, Section { bar, delays: [right, left] }) => {
                let lag = |delay: &Option<Fraction>| {
                    delay.as_ref().map(|delay| self.lag(delay, grid)).transpose()
                };
                let section = Section { bar: *bar, delays: [lag(right)?, lag(left)?] };
                match field {
                    Field::Displacement => {
                        factor = factor.multiply(&in_steps()?, BITS);
                        Summand::SinceStart(Reading::InBar(Field::Velocity, section))
                    }
                    Field::Force => {
                        let impedance = &model.bars[&layout.bars[*bar]].impedance;
                        factor = factor.multiply(&self.symbol.fraction(impedance)?, BITS);
                        Summand::Now(Reading::InBar(*field, section))
                    }
                    _ => Summand::Now(Reading::InBar(*field, section)),
                }
            }
        };
        Ok(vec![(factor, of)])
    }
}

/// A scene on some steps.
pub struct Followed {
    pub grid: Grid,
    /// Where contacts close.
    pub closings: Vec<Change>,
    motion: Motion,
    factors: Vec<Varying>,
    summands: Vec<Summand>,
}

impl Followed {
    /// What is observed on each cell.
    pub fn observed(&self) -> Vec<OnCell> {
        self.motion.sum(&self.factors, &self.summands)
    }

    /// The same where the function of one of the cells is continued to the end.
    ///
    /// # Panics
    /// Where it is none of the cells.
    pub fn observed_after(&mut self, last: usize) -> Outcome<Vec<OnCell>> {
        self.motion.sum_after(last, &self.factors, &self.summands)
    }
}

/// The power of two of equal parts on each of which a rate is below two.
fn parts_of(rate: &Magnitude) -> Outcome<usize> {
    let halvings = rate.top().map_or(0, |top| (top - 1).max(0));
    match halvings > i64::from(MAX_STEPS_OVER_SYMBOL.ilog2()) {
        true => Err(NotOverSymbol::TooManySteps),
        false => Ok(1 << halvings),
    }
}

/// A value that is one number, whatever the symbol is.
fn constant(value: &Root) -> Outcome<Rational> {
    let value = value.exact().and_then(|value| value.as_constant());
    value.ok_or(NotOverSymbol::NoCommonMeasure)
}
