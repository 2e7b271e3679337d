//! Recurrences as a person states them, and the check that they can be solved step by step.

use crate::expression::{Assumptions, Expression, Fraction, NotInvertible};
use crate::recurrence::WaveIndex;
use crate::recurrence::form::LinearForm;
use crate::recurrence::ordering::{self, Step};
use std::fmt;
use wavestep_polynomial::Symbol;

/// A form that is continuous over all arrivals and starts at a value:
/// `form[n](0) = form[n−1](D)`, `form[0](0) = start`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Continuity {
    /// The continuous form.
    pub form: LinearForm,
    /// Its value at `t = 0+`, free of time.
    pub start: Expression,
}

/// A named quantity, linear in the waves.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Observable {
    /// Its name.
    pub name: String,
    /// Its definition.
    pub observation: Observation,
}

/// What is observed: delayed waves with coefficients, and a function of scene time.
///
/// ```text
/// Σ_i coefficient_i · w_i^{(order_i)}(t − delay_i) + forcing(t)
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Observation {
    /// The delayed waves: coefficient, wave, order of the derivative (0 or 1), delay.
    pub terms: Vec<(Expression, WaveIndex, u32, Fraction)>,
    /// The function of scene time that is added.
    pub forcing: Expression,
}

/// All that a person states of a recurrence.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Statement {
    /// What is modelled, in words.
    pub title: String,
    /// Symbols with their conditions, and the factors taken to be non-zero.
    pub assumptions: Assumptions,
    /// The length `D` of a period.
    pub period: Fraction,
    /// The time on one period, restarting at 0.
    pub local: Symbol,
    /// The scene time.
    pub time: Symbol,
    /// The names of the waves; all are zero for `n < 0`.
    pub waves: Vec<String>,
    /// Forms that are zero on every period.
    pub equations: Vec<LinearForm>,
    /// Forms that are continuous.
    pub continuity: Vec<Continuity>,
    /// Quantities to observe.
    pub observables: Vec<Observable>,
}

/// A part of a statement, by its place in the list of its kind.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Part {
    /// The period.
    Period,
    /// An equation.
    Equation(usize),
    /// A continuity rule.
    Continuity(usize),
    /// A wave.
    Wave(WaveIndex),
}

/// Why a statement is no recurrence that can be solved step by step.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Fault {
    /// The period is not certainly positive.
    PeriodNotPositive,
    /// There are more or fewer equations than waves.
    Count {
        /// How many equations.
        equations: usize,
        /// How many waves.
        waves: usize,
    },
    /// The equation holds no wave on the current period that is still to be determined.
    DeterminesNothing,
    /// The waves named depend on each other on the same period.
    Coupled(Vec<String>),
    /// A coefficient that has to be divided by.
    NotInvertible(NotInvertible),
    /// The rate of a differential equation has an exponential in it.
    RateNotPolynomial,
    /// A wave with a differential equation and no continuity rule to start it.
    NoStart(String),
    /// A continuity rule that starts no wave.
    StartsNothing,
    /// A continuity rule with a derivative or a sum in it.
    ContinuityOfSlope,
}

/// A statement that was refused: the part at fault, and why.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct InvalidRecurrence {
    /// The part at fault.
    pub part: Part,
    /// What is wrong with it.
    pub fault: Fault,
}

impl fmt::Display for InvalidRecurrence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.fault {
            Fault::PeriodNotPositive => f.write_str("the period is not certainly positive"),
            Fault::Count { equations, waves } => {
                let s = |count: &usize| if *count == 1 { "" } else { "s" };
                write!(f, "{equations} equation{} for {waves} wave{}", s(equations), s(waves))
            }
            Fault::DeterminesNothing => {
                f.write_str("this equation determines no wave on the current period")
            }
            Fault::Coupled(waves) => {
                write!(f, "{} depend on each other on the same period", waves.join(" and "))
            }
            Fault::NotInvertible(reason) => write!(f, "solving this needs a {reason}"),
            Fault::RateNotPolynomial => {
                f.write_str("the rate of this differential equation holds an exponential")
            }
            Fault::NoStart(wave) => write!(f, "nothing says how {wave} starts and goes on"),
            Fault::StartsNothing => f.write_str("this continuity rule starts no wave"),
            Fault::ContinuityOfSlope => {
                f.write_str("a continuity rule holds no derivatives and no sums")
            }
        }
    }
}

impl std::error::Error for InvalidRecurrence {}

/// A recurrence that can be solved step by step.
///
/// # Invariants
/// - the period is certainly positive;
/// - `steps` holds one step a wave, and each uses on the current period only waves of steps
///   before it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Recurrence {
    statement: Statement,
    steps: Vec<Step>,
}

impl Recurrence {
    /// Checks a statement and puts its equations in solving order.
    ///
    /// # Errors
    /// [`InvalidRecurrence`] with the part at fault.
    ///
    /// # Cost
    /// At most one row operation for each pair of equations.
    pub fn new(statement: Statement) -> Result<Recurrence, InvalidRecurrence> {
        if !statement.assumptions.is_positive(&statement.period) {
            let fault = Fault::PeriodNotPositive;
            return Err(InvalidRecurrence { part: Part::Period, fault });
        }
        let steps = ordering::order(&statement)?;
        Ok(Recurrence { statement, steps })
    }

    /// What was stated.
    pub fn statement(&self) -> &Statement {
        &self.statement
    }

    /// The steps, in solving order.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The place of the wave called `name`.
    pub fn wave(&self, name: &str) -> Option<WaveIndex> {
        self.statement.waves.iter().position(|wave| wave == name)
    }

    /// The observable called `name`.
    pub fn observable(&self, name: &str) -> Option<&Observable> {
        self.statement.observables.iter().find(|observable| observable.name == name)
    }

    /// The wave or the observable called `name`, as what is observed.
    pub fn observation(&self, name: &str) -> Option<Observation> {
        if let Some(wave) = self.wave(name) {
            let term = (Expression::one(), wave, 0, Fraction::zero());
            return Some(Observation { terms: vec![term], forcing: Expression::zero() });
        }
        self.observable(name).map(|observable| observable.observation.clone())
    }

    /// The symbols of the recurrence, times apart, in the order of their names.
    pub fn symbols(&self) -> impl Iterator<Item = &Symbol> + '_ {
        self.statement.assumptions.symbols().map(|(symbol, _)| symbol)
    }
}
