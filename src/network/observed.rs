//! What an observable is in the waves of a network, and the waves of a bar, of which its fields are made.

use crate::expression::{Expression, Fraction, Root};
use crate::network::model::ModelBar;
use crate::network::reading::{Reading, Term};
use crate::recurrence::Observation;
use crate::scene::{Dimension, ElementIndex};

/// An observable of a scene: what it is in the waves, and its unit.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Observed {
    pub name: String,
    /// In the scene's own scales.
    pub value: ObservedValue,
    /// The readings that it is the sum of, where it is linear in the motion of a scene.
    pub(crate) readings: Vec<Term>,
    /// What changes it, where that is known of a momentum or an energy.
    pub(crate) balance: Option<Balance>,
    /// When the loads act without which boundary conditions make it zero, each from a time and until another, in
    /// the scale of the scene; `None` where it is made of more than such loads.
    pub(crate) acts: Option<Vec<(Fraction, Option<Fraction>)>>,
    /// The unit of its values, in metres, kilograms and seconds.
    pub unit: Root,
    /// The dimension of the unit; none for scenes without units.
    pub dimension: Dimension,
}

impl Observed {
    fn energies(&self) -> (&[EnergyTerm], &[FlowTerm]) {
        match &self.value {
            ObservedValue::Linear(_) => (&[], &[]),
            ObservedValue::Energy(sum) => (&sum.held, &sum.passed),
        }
    }

    /// The waves that enter bars whose squares are part of it: the bar, and whether to the right (0) or to the left (1).
    pub(crate) fn entering(&self) -> impl Iterator<Item = [usize; 2]> {
        self.energies().0.iter().filter_map(|term| match term.squared {
            Squared::Reading(_) => None,
            Squared::Entering { bar, direction } => Some([bar, direction]),
        })
    }

    /// All that is read for it.
    pub(crate) fn all_readings(&self) -> impl Iterator<Item = &Reading> {
        let (energies, passed) = self.energies();
        let squared = energies.iter().filter_map(|term| match &term.squared {
            Squared::Reading(reading) => Some(reading),
            Squared::Entering { .. } => None,
        });
        let times = energies.iter().filter_map(|term| term.times.as_ref());
        let flow = self.balance.iter().flat_map(|balance| &balance.flow).chain(passed);
        let factors = flow.flat_map(|term| &term.factors).map(|(reading, _)| reading);
        let linear = self.readings.iter().map(|term| &term.of);
        linear.chain(squared).chain(times).chain(factors)
    }
}

/// An observable in the scales of its scene.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum ObservedValue {
    /// Linear in the waves.
    Linear(Observation),
    /// A sum of energies.
    Energy(EnergySum),
}

/// What there is at the start, what elements hold, and the integral since the start of what has flowed.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct EnergySum {
    pub(crate) start: Fraction,
    pub(crate) held: Vec<EnergyTerm>,
    pub(crate) passed: Vec<FlowTerm>,
}

impl EnergySum {
    /// Whether it takes in all that has been since the start.
    pub(crate) fn is_since_start(&self) -> bool {
        !self.passed.is_empty() || self.held.iter().any(|own| own.window == Window::Always)
    }
}

/// What an energy is the square of.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Squared {
    /// A reading of an element.
    Reading(Reading),
    /// The wave that enters a bar, to the right (0) or to the left (1).
    Entering { bar: usize, direction: usize },
}

/// One part of an energy: `c q²`, of a local contact `c q p`, or `c ∫ q² dt` over the time that a wave needs to leave a
/// bar.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct EnergyTerm {
    /// The coefficient `c`.
    pub coefficient: Fraction,
    /// The quantity `q`.
    pub(crate) squared: Squared,
    /// The quantity `p`, where it is not squared.
    pub(crate) times: Option<Reading>,
    /// The same in waves, zero before the start but for `before`.
    pub of: Observation,
    /// What `q` was before the start.
    pub before: Fraction,
    /// Over which time it is integrated.
    pub window: Window,
}

/// An energy or a momentum by what it is at the start, and what flows in.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Balance {
    pub at_start: Fraction,
    /// What its derivative with respect to the time of the scene is the sum of; nothing for what is
    /// conserved.
    pub flow: Vec<FlowTerm>,
}

/// A coefficient times the product of readings, each of them also in waves.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct FlowTerm {
    pub coefficient: Fraction,
    pub(crate) factors: Vec<(Reading, Observation)>,
    /// From when until when it is not zero, where that is known.
    pub acts: Option<Vec<(Fraction, Option<Fraction>)>>,
    /// A function of time that it is multiplied with.
    pub course: Option<Expression>,
}

/// The time over which the square of a wave is integrated.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Window {
    /// None: its value at the time itself.
    Now,
    /// The last travel time.
    Last(Fraction),
    /// All since the start.
    Always,
}

/// A wave as it enters a bar, its integral over time since the start, and the integral of that.
pub(crate) type Entering = [Observation; 3];

/// Where a bar ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Extent {
    /// At both ends.
    Finite,
    /// At the left end only.
    ToTheRight,
    /// At the right end only.
    ToTheLeft,
}

/// A bar with its waves, in the scales of the scene.
#[derive(Clone, Debug)]
pub(crate) struct FieldBar {
    pub element: ElementIndex,
    pub extent: Extent,
    pub data: ModelBar,
    /// The wave to the right, which enters at the left end, and the one to the left; none for what comes
    /// from the far side of an endless bar.
    pub entering: [Option<Entering>; 2],
    /// The units of velocity, strain, displacement and force, in those of the user.
    pub units: [Root; 4],
    /// The way of a wave in a time of 1.
    pub reach: Root,
}
