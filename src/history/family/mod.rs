//! The motions of a scene for all values of a symbol between two.
//!
//! Time is measured in a *step*, of which every travel time is a whole multiple whatever the symbol is. So what arrives
//! on a step left another node so many steps before, as in the method of steps for one value, but every coefficient
//! of a polynomial in time is a polynomial in the symbol, too. What both leave out is bounded by the energy of each node,
//! as in `passivity`: its matrices hold for all values at once.
//!
//! This file prepares a scene, and `exponential` its loads. `motion` follows it step by step, in functions on a step
//! (`on_step`) with coefficients over the symbol (`symbol`); `modes` encloses its modes of vibration, and `envelope` bounds
//! sizes.

pub mod envelope;
mod exponential;
pub mod modes;
mod motion;
pub mod on_step;
mod symbol;

use crate::ball::{Arithmetic as _, BallError, Magnitude};
use crate::enclosure::EnclosureError;
use crate::expression::{Fraction, NotAUnit, Root};
use crate::history::passivity::Passivity;
use crate::limits::{MAX_STEPS_OVER_SYMBOL, MAX_SYMBOL_BITS as BITS};
use crate::model::NotRepresented;
use crate::network::{
    ElementLaw, Elements, Energy, Field, Measured, MeasuredValue, ModelLoad, Node, Reading,
    ScaledScene, Section, System, Term, common_measure,
};
use crate::scene::ElementIndex;
use crate::signal::Varying;
use exponential::Exponential;
use modes::SumOfModes;
use motion::{Bar, Loading, Motion, NodeState, SteppedNode, Summand, TERMS};
use num_traits::{One as _, ToPrimitive as _, Zero as _};
use on_step::OnStep;
use symbol::OverSymbol;
use wavestep_polynomial::{Rational, Symbol};

/// Why motions are not followed over a symbol.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum NotOverSymbol {
    #[error("contacts that open and local contacts are not supported over a symbol")]
    Contacts,
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
        use NotOverSymbol::{Ball, Frequency, TooManySteps, Unresisted, Value};
        matches!(
            self,
            TooManySteps
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
        let (scene, model) = (scaled.scene(), scaled.model());
        if scene.contacts_open || scaled.local_contact().is_some() {
            return Err(NotOverSymbol::Contacts);
        }
        let measured = scaled.measures.iter().find(|own| own.name == name);
        let measured = measured.ok_or_else(|| NotOverSymbol::Unknown(name.to_owned()))?;
        let symbol = OverSymbol { symbol, between, constants: &model.constants };
        Ok(Over { scaled, measured, symbol })
    }

    /// The step for these scenes: the largest common measure of all travel times, of the times at which loads begin and end,
    /// and of the delays of what is observed, halved until no rate of a node, a load or a mode exceeds two.
    ///
    /// # Errors
    /// [`NotOverSymbol::NoCommonMeasure`]; else as [`Over::follow`].
    pub fn step(all: &[&Over<'_>], modes: Option<&SumOfModes>) -> Outcome<Root> {
        let times = all.iter().flat_map(|own| {
            let model = own.scaled.model();
            let travels = model.bars.values().filter_map(|bar| bar.travel.as_ref());
            let loads = model.loads.values();
            let moments = loads.flat_map(|load| std::iter::once(&load.from).chain(&load.until));
            let terms = match &own.measured.value {
                MeasuredValue::Linear(terms) => &terms[..],
                MeasuredValue::Energy(_) => &[],
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
        let mut fastest = match modes {
            Some(modes) => all[0].length(&unit)?.magnitude().multiply(&modes.rate()),
            None => Magnitude::ZERO,
        };
        for own in all {
            for node in own.nodes(&unit, 0)? {
                let loads = node.loads.iter().map(|load| load.rate);
                fastest = loads.fold(fastest.max(node.passivity.rate()), Magnitude::max);
            }
        }
        let halvings = fastest.top().map_or(0, |top| (top - 1).max(0));
        if halvings > i64::from(MAX_STEPS_OVER_SYMBOL.ilog2()) {
            return Err(NotOverSymbol::TooManySteps);
        }
        Ok(step(&(measure / Rational::from_integer((1_i64 << halvings).into()))))
    }

    /// A time of the user's in steps: between which numbers it lies.
    ///
    /// # Errors
    /// As [`OverSymbol::root`].
    pub fn in_steps(&self, time: &Fraction, step: &Root) -> Outcome<[Rational; 2]> {
        let steps = self.symbol.root(&Root::from(time).over(step)?)?;
        let (low, high) = steps.range().endpoints();
        Ok([Rational::from(&low).max(Rational::zero()), Rational::from(&high)])
    }

    /// The first steps, and what is observed on them in the user's unit.
    ///
    /// # Errors
    /// [`NotOverSymbol`].
    pub fn follow(&self, step: &Root, count: usize) -> Outcome<Followed> {
        if count > MAX_STEPS_OVER_SYMBOL {
            return Err(NotOverSymbol::TooManySteps);
        }
        let (factors, summands) = self.observed(step)?.into_iter().unzip();
        let motion = Motion::of(self.bars(step)?, self.nodes(step, count)?, count);
        Ok(Followed { motion, factors, summands })
    }

    /// The step in the scale of the scene.
    fn scaled_step(&self, step: &Root) -> Outcome<Root> {
        Ok(step.over(&self.scaled.model().scale.time)?)
    }

    /// How long a step is in the scale of the scene.
    ///
    /// # Errors
    /// As [`OverSymbol::root`].
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
    ///
    /// # Errors
    /// As [`OverSymbol::root`].
    pub fn may_be_zero(&self, value: &Fraction) -> Outcome<bool> {
        Ok(self.symbol.fraction(value)?.range().contains_zero())
    }

    fn lag(&self, time: &Fraction, step: &Root) -> Outcome<usize> {
        self.whole_steps(time, step)?.try_into().map_err(|_| NotOverSymbol::NoCommonMeasure)
    }

    /// The bars, and the waves in them before the start, `(V ± X_0/Z)/2`.
    fn bars(&self, step: &Root) -> Outcome<Vec<Bar>> {
        let bar = |(place, element)| {
            let bar = &self.scaled.model().bars[element];
            let [velocity, force] =
                [&bar.velocity, &bar.force].map(|own| self.symbol.fraction(own));
            let (velocity, pressed) =
                (velocity?, force?.multiply(&self.inverse(&bar.impedance)?, BITS));
            let before = [velocity.add(&pressed, BITS), velocity.subtract(&pressed, BITS)];
            let before = before.map(|own| OnStep::constant(&own.over(2, BITS)));
            let lag = bar.travel.as_ref().map(|travel| self.lag(travel, step)).transpose()?;
            Ok(Bar { before, lag, ends: self.scaled.layout.ends[place] })
        };
        self.scaled.layout.bars.iter().enumerate().map(bar).collect()
    }

    fn inverse(&self, value: &Fraction) -> Outcome<Varying> {
        Ok(self.symbol.fraction(value)?.reciprocal(BITS)?)
    }

    /// The nodes at the start, and their loads on `count` steps. With the step `h` as the unit of time a mass counts as `M/h`
    /// and a stiffness as `kh`, and displacements are in units of `h`.
    fn nodes(&self, step: &Root, count: usize) -> Outcome<Vec<SteppedNode>> {
        let length = self.length(step)?;
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
            let system =
                System::of(&node, |_| true, BITS).map_err(|_| NotOverSymbol::Unresisted)?;
            let numbers = node.map(|value| Ok::<_, NotOverSymbol>(value.number()))?;
            let passivity = Passivity::of(&numbers, &system.map(Varying::number))?;
            let start = NodeState::at_start(&node, &system, &passivity)?;
            let loads = node.elements.iter().filter(|own| own.law.is_driven());
            let loads = loads.map(|own| self.loading(own.element, step, count));
            let loads = loads.collect::<Outcome<_>>()?;
            Ok(SteppedNode { node, system, passivity, start, loads })
        };
        self.scaled.layout.nodes.iter().map(place).collect()
    }

    /// A load on `count` steps, with a step as the unit of time.
    fn loading(&self, element: ElementIndex, step: &Root, count: usize) -> Outcome<Loading> {
        let (scene, model) = (self.scaled.scene(), self.scaled.model());
        let ModelLoad { course, from, until } = &model.loads[&element];
        let length = self.length(step)?;
        let terms = Exponential::all(course, &scene.time, &length, &self.symbol)?;
        let terms =
            terms.ok_or_else(|| NotOverSymbol::Load(scene.elements[element].name.clone()))?;
        let rate = terms.iter().map(Exponential::rate).max().unwrap_or(Magnitude::ZERO);
        let course = Exponential::total(&terms, count)?;
        let until = until.as_ref().map(|until| self.lag(until, step)).transpose()?;
        Ok(Loading { acts: self.lag(from, step)?..until.unwrap_or(usize::MAX), rate, course })
    }

    /// What is observed, with factors in the user's unit.
    fn observed(&self, step: &Root) -> Outcome<Vec<(Varying, Summand)>> {
        let unit = self.symbol.root(&self.measured.unit)?;
        let mut parts = Vec::new();
        match &self.measured.value {
            MeasuredValue::Linear(terms) => {
                for term in terms {
                    parts.extend(self.linear(term, step)?);
                }
            }
            MeasuredValue::Energy(shares) => {
                let (model, layout) = (self.scaled.model(), &self.scaled.layout);
                for (share, element) in shares {
                    let share = self.symbol.fraction(share)?;
                    let energy = Elements { model, layout }.energy(*element);
                    for own in energy.map_err(|_| NotOverSymbol::Contacts)? {
                        let (factor, of) = match own {
                            Energy::Square(term) => {
                                let one = Term { coefficient: Fraction::one(), of: term.of };
                                let (factors, of) = self.linear(&one, step)?.into_iter().unzip();
                                let factor = self.symbol.fraction(&term.coefficient)?;
                                (factor, Summand::Square(factors, of))
                            }
                            Energy::InBar(bar) => self.stored(bar, OnStep::square, step)?,
                            Energy::Work(..) => return Err(NotOverSymbol::Contacts),
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
        of: fn(&OnStep) -> OnStep,
        step: &Root,
    ) -> Outcome<(Varying, Summand)> {
        let own = &self.scaled.model().bars[&self.scaled.layout.bars[bar]];
        let impedance = self.symbol.fraction(&own.impedance)?;
        let step = self.length(step)?;
        Ok((impedance.multiply(&step, BITS), Summand::InBar { bar, of }))
    }

    /// What is linear in the motion, with its delays in steps.
    fn linear(&self, term: &Term, step: &Root) -> Outcome<Vec<(Varying, Summand)>> {
        let (model, layout) = (self.scaled.model(), &self.scaled.layout);
        let mut factor = self.symbol.fraction(&term.coefficient)?;
        let in_steps = || self.length(step);
        let of = match &term.of {
            Reading::Force(lump) => {
                let terms = Elements { model, layout }.force(*lump);
                let mut parts = Vec::new();
                for own in terms.ok_or(NotOverSymbol::Contacts)? {
                    let coefficient = &term.coefficient * &own.coefficient;
                    parts.extend(self.linear(&Term { coefficient, of: own.of }, step)?);
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
                let (stored, of) = self.stored(*bar, OnStep::clone, step)?;
                factor = factor.multiply(&stored, BITS);
                of
            }
            Reading::InBar(field, Section { bar, delays: [right, left] }) => {
                let lag = |delay: &Option<Fraction>| {
                    delay.as_ref().map(|delay| self.lag(delay, step)).transpose()
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
    motion: Motion,
    factors: Vec<Varying>,
    summands: Vec<Summand>,
}

impl Followed {
    /// What is observed on each step.
    pub fn observed(&self) -> Vec<OnStep> {
        self.motion.sum(&self.factors, &self.summands)
    }

    /// The same where the function of one of the steps is continued to the end.
    ///
    /// # Errors
    /// [`NotOverSymbol::TooManySteps`].
    ///
    /// # Panics
    /// Where it is none of the steps.
    pub fn observed_after(&mut self, last: usize) -> Outcome<Vec<OnStep>> {
        self.motion.sum_after(last, &self.factors, &self.summands)
    }
}

/// A value that is one number, whatever the symbol is.
fn constant(value: &Root) -> Outcome<Rational> {
    let value = value.exact().and_then(|value| value.as_constant());
    value.ok_or(NotOverSymbol::NoCommonMeasure)
}
