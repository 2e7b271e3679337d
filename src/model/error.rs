//! Why a model gives no values.

use crate::enclosure::EnclosureError;
use crate::expression::NotAUnit;
use wavestep_polynomial::Symbol;

/// Why a model gives no values.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// A symbol without a value.
    #[error("the symbol {0} has no value; models in doubles need one for each")]
    MissingValue(Symbol),
    /// A value of the scene that cannot be told as a number.
    #[error("a value of the scene is no number: {0}")]
    Value(#[source] EnclosureError),
    /// What the model cannot represent.
    #[error("the model \"{model}\" does not represent this: {reason}")]
    Refused {
        /// The model.
        model: &'static str,
        /// What it cannot represent.
        reason: NotRepresented,
    },
    /// A setting that the model does not work with.
    #[error("the model \"{model}\" does not work with this setting: {reason}")]
    Setting {
        /// The model.
        model: &'static str,
        /// What is wrong, and which values do.
        reason: BadSetting,
    },
    /// More work than is done.
    #[error(
        "the model \"{model}\" would need {count:.1e} {what}, more than {limit:.0e}; ask for earlier \
         times or a coarser model"
    )]
    TooMuch {
        /// The model.
        model: &'static str,
        /// What is counted.
        what: &'static str,
        /// How many there would be.
        count: f64,
        /// The most that are done.
        limit: f64,
    },
    /// A time that is no finite number.
    #[error("the time {0} is no finite number")]
    Time(f64),
    /// An observable that the scene does not have.
    #[error("there is no observable {asked}; the scene has {count}, counted from 0")]
    NoObservable {
        /// Which was asked for, counted from 0.
        asked: usize,
        /// How many there are.
        count: usize,
    },
    /// The solver of differential equations gave up.
    #[error(
        "in the model \"{model}\" the solver of differential equations gave up: {reason}; try another \
         tolerance"
    )]
    Solver {
        /// The model.
        model: &'static str,
        /// Where it failed.
        reason: SolverFailure,
    },
}

/// What a model cannot represent. Elements are given by their names.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NotRepresented {
    /// A local contact, where laws have to be linear.
    #[error(
        "it takes linear laws, and the force in the local contact {0} is a power of its compression; \
         the method of steps takes it"
    )]
    LocalContact(String),
    /// A part without mass beside this element.
    #[error("beside {0} something moves that has no mass")]
    Massless(String),
    /// A part without mass beside this element that no bar and no damper resists.
    #[error("beside {0} something moves that has no mass, and nothing resists it")]
    Unresisted(String),
    /// A line without a bar of finite length.
    #[error("no bar has a finite length, and nothing else says how long a cell is")]
    NoFiniteBar,
    /// An element that the scene does not have.
    #[error("there is no element {0}")]
    NoElement(usize),
    /// An element that is no local contact.
    #[error("{0} is no local contact")]
    NotALocalContact(String),
    /// A local contact with something else beside it.
    #[error("{0} does not stand between two bars alone")]
    NotBetweenBars(String),
    /// A local contact at a free end.
    #[error("{0} has a free end beside it")]
    FreeEnd(String),
    /// A local contact between parts that do not approach.
    #[error("what {0} joins does not approach at the start")]
    NoApproach(String),
    /// A rigid body that holds an endless bar.
    #[error("bar {0} is endless, so its mass has no bound")]
    EndlessBody(String),
    /// A rigid bar under strain.
    #[error("bar {0} is strained at the start, and a rigid one is not")]
    StrainedBody(String),
    /// A rigid body without mass.
    #[error("the line has no mass")]
    NoMass,
    /// A spring that parts a line into several bodies.
    #[error("it takes one body, and spring {0} parts this line into more")]
    SeveralBodies(String),
    /// A rigid body that is held.
    #[error("an end is fixed without a spring, so that a rigid line cannot move")]
    HeldBody,
    /// A spring in another place than between the body and a fixed end.
    #[error("spring {0} does not lie between the body and a fixed end")]
    SpringElsewhere(String),
    /// A load that imposes a velocity.
    #[error("load {0} imposes a velocity")]
    ImposedVelocity(String),
    /// A force that varies in time.
    #[error("the force of load {0} varies in time")]
    VaryingForce(String),
    /// An endless bar in the place of a spring.
    #[error("bar {0} is endless, and no spring")]
    EndlessSpring(String),
    /// A line that has another number of bars than one.
    #[error("it takes one bar; this line has {0}")]
    NotOneBar(usize),
    /// A line with other ends than a free and a fixed one.
    #[error("it takes a line with one free and one fixed end")]
    OtherEnds,
    /// An element at the fixed end.
    #[error("{0} stands at the fixed end, which it takes bare")]
    FixedEndNotBare(String),
    /// An element other than a mass at the struck end.
    #[error("{0} is no mass; it takes masses at the struck end")]
    NotAMass(String),
    /// A bar in motion or under strain.
    #[error("bar {0} is not at rest at the start")]
    NotAtRest(String),
    /// A bar that no mass strikes.
    #[error("no mass strikes the bar")]
    NoStriker,
    /// An endless bar, where vibrations are asked for.
    #[error("bar {0} is endless, and waves that leave are no vibration")]
    EndlessVibration(String),
    /// A line without bars.
    #[error("it takes a line with at least one bar")]
    NoBar,
    /// An element with damping.
    #[error("{0} damps the motion")]
    Damping(String),
    /// A load.
    #[error("load {0} acts from outside")]
    Load(String),
    /// Travel times, or times of loads, that are no multiples of one time.
    #[error("the times of {0} and of what is before it in the line have no common measure")]
    NoCommonMeasure(String),
    /// An observable with a term that the model does not know.
    #[error("{observable} observes {term}")]
    Observable {
        /// The observable.
        observable: String,
        /// The term.
        term: NotSeen,
    },
}

/// A term of an observable that a model does not know.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NotSeen {
    /// An energy.
    #[error("an energy, of which it keeps no account")]
    Energy,
    /// The momentum of an endless bar.
    #[error("the momentum of an endless bar")]
    EndlessMomentum,
    /// The momentum of a bar whose mass is counted by a third.
    #[error("the momentum of a bar, which a third of its mass does not tell")]
    MomentumOfThird,
    /// The force in a bar that does not yield.
    #[error("the force within a rigid bar")]
    ForceInRigidBar,
    /// Anything else.
    #[error("what the model does not have")]
    Other,
}

/// A setting that a model does not work with.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BadSetting {
    /// No cells.
    #[error("it takes at least one cell")]
    NoCells,
    /// A step in which a wave crosses more than a cell.
    #[error(
        "a Courant number of {0} is unstable: a wave would cross more than a cell in a step; take at \
         most 1"
    )]
    Unstable(f64),
    /// A step of no length.
    #[error("the Courant number {0} is not positive; take 1 or less")]
    NoStep(f64),
    /// No modes.
    #[error("it takes at least one mode")]
    NoModes,
    /// A tolerance that the solver does not work with.
    #[error("the tolerance {0:e} is not between 1e-13 and 1e-2")]
    Tolerance(f64),
}

/// Where the solver of differential equations gave up.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SolverFailure {
    /// Pieces of this period stay rough however short they are.
    #[error("no piece of period {0} is smooth")]
    NotSmooth(i64),
}

impl From<EnclosureError> for ModelError {
    fn from(error: EnclosureError) -> ModelError {
        match error {
            EnclosureError::MissingValue(symbol) => ModelError::MissingValue(symbol),
            other => ModelError::Value(other),
        }
    }
}

impl From<NotAUnit> for ModelError {
    fn from(reason: NotAUnit) -> ModelError {
        ModelError::Value(reason.into())
    }
}
