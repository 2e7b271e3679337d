//! Recurrences as a person states them, and what may be wrong with them.

use crate::expression::{Assumptions, Constant, Expression, Fraction, NotInvertible};
use crate::recurrence::WaveIndex;
use crate::recurrence::form::LinearForm;
use crate::recurrence::notation::SourceNotation;
use wavestep_polynomial::Symbol;

/// A form that is continuous over all arrivals and starts at a value:
/// `form[n](0) = form[n−1](D)`, `form[0](0) = start`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Continuity {
    pub form: LinearForm,
    /// Its value at `t = 0+`, free of time.
    pub start: Expression,
}

/// A named quantity, linear in the waves.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Observable {
    pub name: String,
    pub observation: Observation,
}

/// An observed quantity: delayed waves with coefficients, and a function of scene time.
///
/// ```text
/// Σ_i coefficient_i · w_i(t − delay_i) + forcing(t),     with w_i' in place of w_i where asked for
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Observation {
    pub waves: Vec<ObservedWave>,
    pub forcing: Expression,
}

/// A named sum of products of quantities that are linear in the waves.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Quadratic {
    pub name: String,
    /// Its place among all that is observed.
    pub place: usize,
    pub terms: Vec<ProductTerm>,
}

/// A coefficient, free of time, times two factors; or one factor alone, with the coefficient 1.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ProductTerm {
    pub coefficient: Fraction,
    pub factors: Vec<Observation>,
}

/// One wave in an [`Observation`]: `coefficient · w(t − delay)`, or `coefficient · w'(t − delay)`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ObservedWave {
    /// The coefficient, free of time.
    pub coefficient: Expression,
    pub wave: WaveIndex,
    /// Whether its derivative is seen, not its value.
    pub slope: bool,
    /// By how much it is delayed.
    pub delay: Fraction,
}

impl ObservedWave {
    /// The value of a wave.
    pub(crate) fn new(wave: WaveIndex, delay: Fraction, coefficient: &Fraction) -> ObservedWave {
        ObservedWave { coefficient: coefficient.clone().into(), wave, slope: false, delay }
    }
}

/// All that a person states of a recurrence.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Statement {
    pub title: String,
    /// Symbols with their conditions, and the factors taken to be non-zero.
    pub assumptions: Assumptions,
    /// Symbols that are constants with a definition; they are among the symbols assumed as well.
    pub constants: Vec<Constant>,
    /// The length `D` of a period.
    pub period: Fraction,
    /// The time on one period, restarting at 0.
    pub local: Symbol,
    pub time: Symbol,
    /// The names of the waves; all are zero for `n < 0`.
    pub waves: Vec<String>,
    /// Forms that are zero on every period.
    pub equations: Vec<LinearForm>,
    /// Forms that are continuous.
    pub continuity: Vec<Continuity>,
    pub observables: Vec<Observable>,
    /// What is observed beside these and is no longer linear.
    pub quadratics: Vec<Quadratic>,
    /// How the source writes it.
    pub notation: SourceNotation,
}

impl Statement {
    /// The names of all that is observed, in the order of the text.
    pub fn observed(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.observables.iter().map(|own| own.name.as_str()).collect();
        self.quadratics.iter().for_each(|own| names.insert(own.place, &own.name));
        names
    }
}

/// A clause of a statement, by its place in the list of its kind.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Clause {
    Period,
    Equation(usize),
    Continuity(usize),
    Wave(WaveIndex),
}

/// Why a statement is no recurrence that can be solved step by step.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Fault {
    /// The period is not certainly positive.
    #[error("the period may be zero or negative")]
    PeriodNotPositive,
    /// There are more or fewer equations than waves.
    #[error("{}", counted(*equations, *waves))]
    Count { equations: usize, waves: usize },
    /// The equation holds no wave on the current period that is still to be determined.
    #[error("this equation determines no wave in the current period")]
    DeterminesNothing,
    /// The waves named depend on each other on the same period.
    #[error("{} depend on each other in the same period", .0.join(" and "))]
    Coupled(Vec<String>),
    /// The waves named are coupled by their derivatives, and their rates, the roots of a
    /// polynomial, have no short exact form.
    #[error("the rates at which {} decay together have no short exact form", waves.join(" and "))]
    Rates {
        waves: Vec<String>,
        /// The characteristic polynomial, highest power first.
        polynomial: Vec<Fraction>,
    },
    /// A coefficient that has to be divided by.
    #[error("solving this needs a {0}")]
    NotInvertible(#[source] NotInvertible),
    /// The rate of a differential equation has an exponential in it.
    #[error("the rate of this differential equation holds an exponential")]
    RateHoldsExponential,
    /// A wave with a differential equation and no continuity rule to start it.
    #[error("{0} has no initial value and no continuity rule")]
    NoStart(String),
    /// A continuity rule that starts no wave.
    #[error("no wave needs this continuity rule")]
    StartsNothing,
    /// A continuity rule with a derivative or a sum in it.
    #[error("a continuity rule cannot contain derivatives or sums")]
    ContinuityOfSlope,
    /// A wave that is not declared, a coefficient or a start that depends on time, or forcing that
    /// is no exponential polynomial of scene time.
    #[error(
        "a wave is not declared, a coefficient depends on time, or the forcing is no exponential \
         polynomial of scene time"
    )]
    IllFormed,
    /// Coefficients whose product would have too high a degree.
    #[error("the coefficients of the equations have too high a degree together")]
    DegreeTooHigh,
}

fn counted(equations: usize, waves: usize) -> String {
    let s = |count| if count == 1 { "" } else { "s" };
    format!("{equations} equation{} for {waves} wave{}", s(equations), s(waves))
}

/// A statement that was refused: the clause at fault, and why.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{fault}")]
pub struct InvalidRecurrence {
    pub clause: Clause,
    pub fault: Fault,
}
