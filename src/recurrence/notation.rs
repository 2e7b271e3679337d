//! How the source of a recurrence writes what wavestep derives: its names, units and shorthand.

use crate::expression::Fraction;
use crate::recurrence::WaveIndex;
use num_traits::{One, Zero};
use std::collections::{BTreeMap, BTreeSet};
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// The notation of a source, beside the one that a statement uses. It changes how formulas look,
/// never what is derived.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct SourceNotation {
    /// The unit of a wave: the source's wave is the unit times ours.
    pub units: BTreeMap<WaveIndex, SourceProduct>,
    /// The units of observables.
    pub observables: BTreeMap<String, SourceProduct>,
    /// Waves that the source calls otherwise.
    pub waves: BTreeMap<WaveIndex, String>,
    /// Symbols and times that the source writes as an expression in symbols of its own.
    pub symbols: BTreeMap<Symbol, SourceProduct>,
    /// The name of a wave's constants of integration, which are stated apart where they are long.
    pub constants: BTreeMap<WaveIndex, String>,
    /// Waves whose values at the ends of periods are kept as shorthand.
    pub ends: BTreeSet<WaveIndex>,
}

impl SourceNotation {
    /// Whether the source has no notation of its own.
    pub fn is_empty(&self) -> bool {
        *self == SourceNotation::default()
    }
}

/// A product of powers of the source's symbols, in the order in which it writes them:
/// `coefficient · Π symbol^power`.
///
/// # Invariants
/// - the coefficient is not zero;
/// - the symbols are pairwise different, no power is zero.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SourceProduct {
    coefficient: Rational,
    powers: Vec<(Symbol, i32)>,
}

impl SourceProduct {
    pub fn one() -> SourceProduct {
        SourceProduct { coefficient: Rational::one(), powers: Vec::new() }
    }

    /// The number in front, not zero.
    pub fn coefficient(&self) -> &Rational {
        &self.coefficient
    }

    /// The symbols with their powers, in the order of the source.
    pub fn powers(&self) -> &[(Symbol, i32)] {
        &self.powers
    }

    /// The same product without its number.
    pub fn without_number(&self) -> SourceProduct {
        SourceProduct { coefficient: Rational::one(), powers: self.powers.clone() }
    }

    pub fn scale(&mut self, number: &Rational) {
        assert!(!number.is_zero(), "a product of a source is not zero");
        self.coefficient *= number;
    }

    /// Multiplies by a power of a symbol, at the end where it is new.
    pub fn multiply(&mut self, symbol: Symbol, power: i32) {
        match self.powers.iter_mut().find(|(own, _)| *own == symbol) {
            Some((_, own)) => *own += power,
            None => self.powers.push((symbol, power)),
        }
        self.powers.retain(|(_, power)| *power != 0);
    }

    pub fn to_fraction(&self) -> Fraction {
        self.powers.iter().fold(Fraction::constant(&self.coefficient), |product, (x, power)| {
            let base = match *power < 0 {
                true => Fraction::reciprocal(&Polynomial::symbol(x)).expect("a symbol is a unit"),
                false => Fraction::symbol(x),
            };
            &product * &base.pow(power.unsigned_abs())
        })
    }
}
