//! What can be said of a problem after it was read: it is ordered, and derived in two ways that must agree.

use super::bounds::MAX_NAMED_TERMS;
use super::constants::rates;
use super::derive::FEW_TERMS;
use super::{Kind, Problem, ProblemError};
use crate::expression::{Condition, PI, Transform};
use crate::history::HistoryError;
use crate::limits::counted;
use crate::network::{Network, NetworkError};
use crate::recurrence::Statement;
use crate::solution::{EchoByEcho, GeneralForm, PeriodByPeriod, Solution};
use wavestep_polynomial::{Rational, Symbol};

/// The periods for which both derivations are compared.
const PERIODS: usize = 6;

/// The same where formulas hold several named constants.
const PERIODS_WITH_CONSTANTS: usize = 2;

/// How many periods of a lattice are followed in a check.
const FIRST_ECHOES: usize = 3;

#[derive(Clone, Debug)]
pub enum Checked {
    /// A recurrence, stated or derived.
    Periods(Box<Periods>),
    /// A scene whose travel times have no common measure.
    Lattice {
        /// How many of the first echoes were derived.
        echoes: usize,
    },
    /// A scene whose motion is followed without one, and why.
    NoRecurrence(String),
    /// A scene that is derived only once its symbols have values.
    NeedsValues {
        /// Its symbols, with what is known of them.
        symbols: Vec<(Symbol, Option<Condition>)>,
        /// What cannot be derived without.
        reason: Box<ProblemError>,
    },
}

/// What was found of a recurrence.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Periods {
    /// Its symbols, with what is known of them.
    pub symbols: Vec<(Symbol, Option<Condition>)>,
    /// What is taken to be non-zero.
    pub factors: Vec<String>,
    /// The waves in the order in which they are solved for, and how.
    pub steps: Vec<(String, Solved)>,
    /// The waves that decay together, and their rates.
    pub coupled: Vec<(Vec<String>, Vec<String>)>,
    /// How it was derived, until which period.
    pub derived: (Derivations, usize),
    /// The form for every period of each wave.
    pub general: Vec<(String, General)>,
}

/// How an equation gives a wave.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Solved {
    /// By a linear differential equation of the first order.
    Differential,
    /// At once.
    Algebraic,
}

/// How waves were derived.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Derivations {
    /// Period by period and echo by echo, with the same result.
    InTwoWays,
    /// Echo by echo alone, with names for rates.
    ByEchoes,
}

/// Whether there is a form for every period.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum General {
    /// A sum of powers.
    Powers,
    /// Echoes in closed form.
    Echoes,
    Unknown,
}

#[doc(hidden)]
impl Problem {
    /// Checks the problem: its laws are solved and the first periods derived in two ways.
    pub fn check(&self) -> Result<Checked, ProblemError> {
        self.can_begin()?;
        let why = match self.network().map(Network::all_linear) {
            Ok(Err(NetworkError::NotLinear(contact))) => {
                Some(format!("`{contact}` is a local contact"))
            }
            Ok(Err(NetworkError::Apart([left, right]))) => {
                Some(format!("{left} and {right} do not touch at the start"))
            }
            _ => None,
        };
        if let Some(why) = why {
            return Ok(Checked::NoRecurrence(why));
        }
        match &self.kind {
            Kind::Line { network, .. } if self.on_lattice() => on_lattice(self, network),
            _ => match self.check_periods() {
                Ok(periods) => Ok(Checked::Periods(Box::new(periods))),
                Err(reason) => self.needs_values(reason),
            },
        }
    }

    /// That a scene whose contacts open is not refused at once by what follows it: rigid masses may meet at the start.
    fn can_begin(&self) -> Result<(), ProblemError> {
        let opens = self.network().is_ok_and(|network| network.scene().contacts_open);
        match opens.then(|| self.history(Some(&Rational::default()), 1)) {
            Some(Err(refused @ ProblemError::History(HistoryError::Refused(_)))) => Err(refused),
            _ => Ok(()),
        }
    }

    /// A check that ends where rates are those of symbols; other reasons are handed on.
    fn needs_values(&self, reason: ProblemError) -> Result<Checked, ProblemError> {
        let is_rates = matches!(
            reason,
            ProblemError::Rates { .. } | ProblemError::Network(NetworkError::Rates { .. })
        );
        match self.network() {
            Ok(network) if is_rates && !self.symbols().is_empty() => {
                let symbols = network.scene().assumptions.symbols();
                let symbols = symbols.filter(|(symbol, _)| symbol.name() != PI);
                let symbols = symbols.map(|(symbol, known)| (symbol.clone(), known.cloned()));
                Ok(Checked::NeedsValues { symbols: symbols.collect(), reason: Box::new(reason) })
            }
            _ => Err(reason),
        }
    }

    fn check_periods(&self) -> Result<Periods, ProblemError> {
        let solution = self.solution()?;
        let recurrence = solution.recurrence();
        let shown = self.waves();
        let symbols = recurrence.statement().assumptions.symbols();
        let is_constant =
            |symbol: &Symbol| recurrence.constants().iter().any(|c| c.symbol == *symbol);
        let symbols = symbols.filter(|(symbol, _)| !is_constant(symbol));
        let steps = recurrence.steps().iter().filter(|step| step.wave < shown.len());
        let solved = |is_started: bool| match is_started {
            true => Solved::Differential,
            false => Solved::Algebraic,
        };
        let name = |wave: usize| recurrence.wave_name(wave);
        let coupled = recurrence.coupled().iter();
        Ok(Periods {
            derived: self.derived_in_two_ways(solution)?,
            symbols: symbols.map(|(symbol, known)| (symbol.clone(), known.cloned())).collect(),
            factors: crate::export::assumed_factors(&recurrence.statement().assumptions),
            steps: steps.map(|step| (name(step.wave), solved(step.start.is_some()))).collect(),
            coupled: coupled
                .map(|own| (own.waves.iter().copied().map(name).collect(), rates(recurrence, own)))
                .collect(),
            general: shown
                .iter()
                .enumerate()
                .map(|(wave, name)| ((*name).to_owned(), general(solution, wave)))
                .collect(),
        })
    }

    fn derived_in_two_ways(
        &self,
        solution: &Solution,
    ) -> Result<(Derivations, usize), ProblemError> {
        let recurrence = solution.recurrence();
        let statement = recurrence.statement();
        let mut by_period = PeriodByPeriod::new(recurrence);
        let mut by_echo = EchoByEcho::new(recurrence);
        // Each further constant in the formulas multiplies their length.
        let periods =
            if recurrence.constants().len() > 1 { PERIODS_WITH_CONSTANTS } else { PERIODS };
        let ways = match recurrence.has_named_rates() {
            true => Derivations::ByEchoes,
            false => Derivations::InTwoWays,
        };
        for n in counted(0..periods + 1, "of the periods") {
            by_echo.advance().map_err(|error| self.explained(error.into()))?;
            if ways == Derivations::InTwoWays {
                by_period.advance().map_err(|error| self.explained(error.into()))?;
                agree(statement, n, &by_echo, &by_period)?;
            }
            let waves = 0..statement.waves.len();
            let last = waves.filter_map(|wave| by_echo.transforms(wave).last());
            if last.map(Transform::term_count).sum::<usize>() > MAX_NAMED_TERMS {
                return Ok((ways, n));
            }
        }
        Ok((ways, periods))
    }
}

/// Whether both derivations give the same piece of each wave.
fn agree(
    statement: &Statement,
    n: usize,
    by_echo: &EchoByEcho<'_>,
    by_period: &PeriodByPeriod<'_>,
) -> Result<(), ProblemError> {
    for (wave, name) in statement.waves.iter().enumerate() {
        let piece = by_echo.sum(wave).piece(n).ok();
        let other = &by_period.pieces()[wave][n];
        let difference = piece.map(|piece| statement.assumptions.reduced(&(&piece - other)));
        if difference.is_none_or(|difference| !difference.is_zero()) {
            return Err(ProblemError::Disagreement(name.clone(), n));
        }
    }
    Ok(())
}

fn general(solution: &Solution, wave: usize) -> General {
    match solution.general(wave) {
        Ok(GeneralForm::Geometric(_)) => General::Powers,
        Ok(GeneralForm::Echoes(_)) => General::Echoes,
        Err(_) => General::Unknown,
    }
}

/// Solves the laws, and derives the first echoes.
fn on_lattice(problem: &Problem, network: &Network) -> Result<Checked, ProblemError> {
    let waves: Vec<usize> = (0..network.waves().len()).collect();
    let (_, found, _) = problem.few_arrivals(network, &waves, FIRST_ECHOES, FEW_TERMS);
    let echoes = match found {
        // What is asked for later may be no formula.
        Err(ProblemError::LongEchoes { .. }) => 0,
        found => found?.len(),
    };
    Ok(Checked::Lattice { echoes })
}
