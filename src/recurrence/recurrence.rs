//! Statements that have been checked and put in solving order.

use crate::expression::{Expression, Fraction};
use crate::recurrence::WaveIndex;
use crate::recurrence::ordering::{self, Step};
use crate::recurrence::statement::{
    Fault, InvalidRecurrence, Observable, Observation, Part, Statement,
};
use wavestep_polynomial::Symbol;

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
