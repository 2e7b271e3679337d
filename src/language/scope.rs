//! Names and what they mean: symbols with their values, waves, and times.

use std::collections::BTreeMap;

use wavestep_polynomial::{Rational, Symbol};

use super::diagnostic::Diagnostic;
use super::source::Source;
use super::syntax::{Name, Span};
use crate::expression::Assumptions;
use crate::recurrence::WaveIndex;

/// Functions that people write and that the language does not have.
pub(super) const FUNCTIONS: [&str; 7] = ["tan", "sinh", "cosh", "tanh", "ln", "log", "abs"];

/// What names mean, and what is known of symbols.
pub(super) struct Scope {
    pub source: Source,
    pub waves: BTreeMap<String, WaveIndex>,
    pub symbols: BTreeMap<String, Option<Rational>>,
    pub local: Option<Symbol>,
    pub time: Option<Symbol>,
    pub assumptions: Assumptions,
}

impl Scope {
    /// No names yet.
    pub fn new(source: &Source) -> Scope {
        Scope {
            source: source.clone(),
            waves: BTreeMap::new(),
            symbols: BTreeMap::new(),
            local: None,
            time: None,
            assumptions: Assumptions::default(),
        }
    }

    pub fn error(
        &self,
        message: impl Into<String>,
        span: Span,
        label: impl Into<String>,
    ) -> Diagnostic {
        Diagnostic::new(&self.source, message, span, label)
    }

    /// A name that was declared before, at `first`.
    pub fn declared_twice(&self, name: &Name, first: Span) -> Diagnostic {
        self.error(format!("`{}` is declared twice", name.value), name.span, "again here")
            .with_secondary(first, "first declared here")
            .with_remedy("choose another name, or remove one of the two")
    }

    /// Every name that an expression could have meant.
    pub fn known_names(&self) -> impl Iterator<Item = &str> + Clone {
        let times = self.local.iter().chain(&self.time).map(Symbol::name);
        self.waves.keys().chain(self.symbols.keys()).map(String::as_str).chain(times)
    }
}

/// Says which of the names was probably meant.
pub(super) fn with_likely<'a>(
    error: Diagnostic,
    name: &str,
    known: impl Iterator<Item = &'a str> + Clone,
) -> Diagnostic {
    match known.clone().find(|known| known.eq_ignore_ascii_case(name)) {
        Some(known) => {
            error.with_remedy(format!("did you mean `{known}`? Capital and small letters differ"))
        }
        None => error.with_closest(name, known),
    }
}

/// The symbol of a name of the language.
pub(super) fn symbol(name: &str) -> Symbol {
    Symbol::new(name).expect("names of the language are names of symbols")
}
