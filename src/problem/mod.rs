//! What a text states, read once: equations between periods, or bars with what joins them.
//!
//! A [`Problem`] is the one way in. It keeps its text and the values put in place of symbols, and what is
//! derived from them once it has been asked for. It alone knows which kind of text it holds; callers ask
//! for a title, a quantity, a time, values, and are told where there is no answer.

mod advise;
mod between;
mod bounds;
mod check;
mod comparison;
mod constants;
mod derive;
mod enough_map;
mod equal;
mod error;
mod evaluate;
mod given;
mod impact;
mod largest;
mod lock;
mod simpler;
mod times;
mod validity;
mod wanted;

use crate::answer::Costs;
use crate::expression::PI;
use crate::language::{self, Source, Stated};
use crate::network::{Network, NetworkError, ScaledScene};
use crate::planner;
use crate::recurrence::{Recurrence, Statement};
use crate::scene::Scene;
use crate::solution::Solution;
use std::cell::OnceCell;
use std::collections::BTreeMap;
use wavestep_polynomial::{Rational, Symbol};

pub use advise::{Advice, Need, Tried, Verdict};
pub use between::{Claimed, Unproven};
pub use check::{Checked, Derivations, General, Periods, Solved};
pub use constants::constants_of;
pub use derive::{Derived, Form, Functions, GeneralFormulas, Orders, Symbols, ToDerive};
pub use enough_map::{Column, EnoughMap, MapRequest, Run, SymbolRange, geometrically_spaced, runs};
pub use equal::{Crossing, EqualExtrema};
pub use error::{EqualError, LockRefusal, Missing, ProblemError};
pub use evaluate::{Digits, Proven, Undecided};
pub use given::{Given, number};
pub use largest::{LargestBetween, QuantityWindow};
pub use lock::ToLock;
pub use simpler::{Against, Other, Simpler, Size};
pub use times::{evenly_spaced, two_figures};
pub use validity::{Holds, Pressed, Pulls};
pub use wanted::Wanted;

/// Values in place of symbols, by name.
pub type Values = BTreeMap<String, Rational>;

/// A text that was read, equations or a scene, with values in place of symbols.
///
/// ```
/// let problem = wavestep::Problem::builtin("rigid-mass")?;
/// assert_eq!(problem.title(), "Rigid mass on a fixed bar");
/// assert_eq!((problem.waves(), problem.symbols()), (vec!["f", "g"], vec!["mu"]));
/// assert_eq!(problem.observables()[0], "velocity");
/// let value = problem.with("mu", "1/4")?.signal("f")?.at("33/10", 12)?;
/// assert_eq!(value.to_string(), "0.305385264409");
/// # Ok::<(), wavestep::Error>(())
/// ```
pub struct Problem {
    source: Source,
    values: Values,
    kind: Kind,
    costs: Costs,
}

/// What can be asked of a text depends on what it states.
enum Kind {
    /// Equations between the waves of successive periods.
    Equations(Box<Solution>),
    /// Bars and elements. There is a solution in periods where laws are linear, as long as contacts stay closed.
    Line { network: Box<Network>, solution: OnceCell<Result<Box<Solution>, NetworkError>> },
}

impl Problem {
    /// The title.
    pub fn title(&self) -> &str {
        self.stated().map_or_else(|statement| &statement.title, |scene| &scene.title)
    }

    /// The scene, or the equations.
    fn stated(&self) -> Result<&Scene, &Statement> {
        match &self.kind {
            Kind::Equations(solution) => Err(solution.recurrence().statement()),
            Kind::Line { network, .. } => Ok(network.scene()),
        }
    }

    /// The symbols that have no value yet, in the order of their names.
    pub fn symbols(&self) -> Vec<&str> {
        match &self.kind {
            Kind::Equations(solution) => {
                solution.recurrence().symbols().map(Symbol::name).collect()
            }
            Kind::Line { network, .. } => names_of_symbols(network.scene()),
        }
    }
}

fn names_of_symbols(scene: &Scene) -> Vec<&str> {
    let names = scene.assumptions.symbols().map(|(symbol, _)| symbol.name());
    names.filter(|name| *name != PI).collect()
}

#[doc(hidden)]
impl Problem {
    /// Reads a text that errors call by this name.
    pub fn of_text(
        name: &str,
        text: impl AsRef<[u8]>,
        values: &Values,
    ) -> Result<Problem, ProblemError> {
        Problem::of(Source::new(name, text)?, values.clone())
    }

    /// Weighs ways to doubles by these costs from now on.
    pub fn weigh_by(&mut self, costs: Costs) {
        self.costs = costs;
    }

    /// A value for a symbol, both as scenes know them.
    pub(crate) fn value_of(name: &str, value: Given) -> Result<(String, Rational), ProblemError> {
        let value = value.number(name)?;
        Ok((language::normalise_name(name), value))
    }

    /// The same text with one more value in place of a symbol, before anything is derived.
    pub fn substituted(
        &self,
        name: &str,
        value: impl Into<Given>,
    ) -> Result<Problem, ProblemError> {
        let mut values = self.values.clone();
        values.extend([Problem::value_of(name, value.into())?]);
        Problem::of(self.source.clone(), values)
    }

    /// The same text with its symbols, and no values.
    pub fn without_values(&self) -> Result<Problem, ProblemError> {
        Problem::of(self.source.clone(), Values::new())
    }

    fn of(source: Source, values: Values) -> Result<Problem, ProblemError> {
        let kind = match language::read(&source, &values)? {
            Stated::Recurrence(recurrence) => Kind::Equations(Box::new(Solution::new(*recurrence))),
            Stated::Scene(scene) => {
                let network = Box::new(Network::new(&scene)?);
                Kind::Line { network, solution: OnceCell::new() }
            }
        };
        Ok(Problem { source, values, kind, costs: Costs::default() })
    }

    /// The values put in place of symbols.
    pub fn values(&self) -> &Values {
        &self.values
    }

    /// The scene in its own scales.
    pub fn scaled(&self) -> Result<&ScaledScene, ProblemError> {
        match &self.kind {
            Kind::Equations(_) => Err(ProblemError::Equations(self.title().to_owned())),
            Kind::Line { network, .. } => Ok(network),
        }
    }

    /// The scene as a network of waves.
    pub fn network(&self) -> Result<&Network, ProblemError> {
        match &self.kind {
            Kind::Line { network, .. } => Ok(network),
            Kind::Equations(_) => Err(ProblemError::Equations(self.title().to_owned())),
        }
    }

    /// The recurrence, stated or derived, with its solution.
    pub fn solution(&self) -> Result<&Solution, ProblemError> {
        match &self.kind {
            Kind::Equations(solution) => Ok(solution),
            Kind::Line { network, .. } if network.local_contact().is_some() => {
                Err(ProblemError::local_contact(network))
            }
            Kind::Line { network, solution } => {
                let derived = || Ok(Box::new(Solution::new(network.recurrence()?)));
                let solution = solution.get_or_init(derived).as_ref();
                solution.map(Box::as_ref).map_err(|error| error.clone().into())
            }
        }
    }

    /// The recurrence, stated or derived.
    pub fn recurrence(&self) -> Result<&Recurrence, ProblemError> {
        Ok(self.solution()?.recurrence())
    }

    /// The name of the first local contact.
    pub fn local_contact(&self) -> Option<String> {
        let scaled = self.scaled().ok()?;
        scaled.local_contact().map(|contact| scaled.scene().elements[contact].name.clone())
    }

    /// Whether there are periods and echoes, not events.
    fn has_periods(&self) -> bool {
        !matches!(&self.kind, Kind::Line { network, .. } if !planner::has_periods(network))
    }

    /// Whether waves return at times without a common measure.
    fn on_lattice(&self) -> bool {
        matches!(&self.kind, Kind::Line { network, .. } if network.lattice().periods().len() > 1)
    }
}
