//! Recurrences as a person states them, and what may be wrong with them.

use crate::expression::{Assumptions, Expression, Fraction, NotInvertible};
use crate::recurrence::WaveIndex;
use crate::recurrence::form::LinearForm;
use crate::recurrence::notation::SourceNotation;
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
    /// How the source writes it.
    pub notation: SourceNotation,
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
    /// A wave that is not declared, a coefficient or a start that depends on time, or forcing that
    /// is no exponential polynomial of scene time.
    IllFormed,
    /// Coefficients whose product would have too high a degree.
    DegreeTooHigh,
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
            Fault::IllFormed => f.write_str(
                "a wave is not declared, a coefficient depends on time, or the forcing is no \
                 exponential polynomial of scene time",
            ),
            Fault::DegreeTooHigh => {
                f.write_str("the coefficients of the equations have too high a degree together")
            }
            Fault::ContinuityOfSlope => {
                f.write_str("a continuity rule holds no derivatives and no sums")
            }
        }
    }
}

impl std::error::Error for InvalidRecurrence {}
