//! What formulas of scenes are in: units, constants with names, and rates in decimals.

use super::{Kind, Problem, ProblemError};
use crate::ball::Ball;
use crate::enclosure::{Numbers, enclose_expression};
use crate::export::definition_text;
use crate::expression::{Constant, Definition, Fraction, Root};
use crate::language;
use crate::network::Network;
use crate::recurrence::{Coupled, Recurrence};
use std::collections::BTreeSet;
use wavestep_polynomial::Symbol;

/// Significant digits of constants and rates in remarks, and bits enough for them.
const DIGITS: usize = 6;
const BITS: u64 = 64;

#[doc(hidden)]
impl Problem {
    /// In which units the formulas of a scene are, and what the constants in them are, a line each; all
    /// constants where no text is given to look for them.
    pub fn constants(&self, text: Option<&str>) -> Result<Vec<String>, ProblemError> {
        self.network().map_or_else(|_| Ok(Vec::new()), |network| constants_of(network, text))
    }

    /// In which unit the formulas of an observable are, in scenes with units.
    pub fn unit_of_formulas(&self, observable: &str) -> Option<String> {
        let name = language::normalise_name(observable);
        let network = self.network().ok().filter(|network| network.scene().dimensional)?;
        let observed = network.observables().iter().find(|observed| observed.name == name)?;
        let number = decimal(&network.model().constants, &observed.unit.clone().into())?;
        let unit = observed.dimension.unit();
        Some(format!("{name} in {number} {unit}").trim_end().to_owned())
    }

    /// What is told where the exact form needs rates that formulas cannot hold, instead of what was found
    /// wrong.
    pub(super) fn explained(&self, error: ProblemError) -> ProblemError {
        let is_of_rates =
            matches!(error, ProblemError::Solve(_) | ProblemError::NoGeneralForm { .. });
        match self.named_rates().filter(|_| is_of_rates) {
            Some((place, waves, rates)) => ProblemError::Rates { place, waves, rates },
            None => error,
        }
    }

    /// Where rates have names, waves that decay together, and their rates.
    pub(super) fn named_rates(&self) -> Option<(String, Vec<String>, Vec<String>)> {
        let (Kind::Line { network, .. }, Ok(recurrence)) = (&self.kind, self.recurrence()) else {
            return None;
        };
        named_rates_of(network, recurrence)
    }
}

/// Where rates have names in a recurrence of a scene, waves that decay together, and their rates.
pub(super) fn named_rates_of(
    network: &Network,
    recurrence: &Recurrence,
) -> Option<(String, Vec<String>, Vec<String>)> {
    let named = |rate: &Fraction| recurrence.constants().iter().any(|c| rate.contains(&c.symbol));
    let mut systems = recurrence.coupled().iter();
    let system = systems.find(|system| system.rates.iter().any(named))?;
    let waves: Vec<String> = system.waves.iter().map(|w| recurrence.wave_name(*w)).collect();
    Some((network.place_of_waves(&waves), waves, rates(recurrence, system)))
}

/// The same of a network, in whatever scales it is.
#[doc(hidden)]
pub fn constants_of(network: &Network, text: Option<&str>) -> Result<Vec<String>, ProblemError> {
    let (model, scene) = (network.model(), network.scene());
    let unfolded = match network.all_linear() {
        Err(_) => None,
        Ok(()) => Some(network.unfold(&vec![0; network.lattice().periods().len()])?),
    };
    let constants = unfolded.as_ref().map_or(&*model.constants, |own| own.recurrence().constants());
    let mut lines = Vec::new();
    if scene.dimensional {
        let unit = |value: &Root, unit: &str| {
            decimal(constants, &value.clone().into())
                .map_or(unit.to_owned(), |number| format!("{number} {unit}"))
        };
        let (time, velocity) = (unit(&model.scale.time, "s"), unit(&model.scale.velocity, "m/s"));
        let force = unit(&model.scale.force(), "N");
        lines.push(format!("times in {time}, velocities in {velocity}, forces in {force}"));
    }
    let part_of_name = |c: char| c.is_alphanumeric() || c == '_';
    let words = text.map(|text| text.split(|c| !part_of_name(c)).collect::<BTreeSet<&str>>());
    let occurs = |constant: &&Constant| {
        words.as_ref().is_none_or(|words| words.contains(constant.symbol.name()))
    };
    for constant in constants.iter().filter(occurs) {
        let number = decimal(constants, &constant.value);
        let value = number.unwrap_or_else(|| definition_text(&constant.value));
        lines.push(format!("{} = {value}", constant.symbol));
    }
    Ok(lines)
}

/// A definition as a decimal number, where all in it is known.
pub(super) fn decimal(constants: &[Constant], value: &Definition) -> Option<String> {
    let numbers = Numbers::new(constants);
    let ball = numbers.enclose_definition(value, BITS).ok()?;
    Some(ball.to_decimal(DIGITS).midpoint().to_string())
}

/// The rates of a system: exactly, or as decimals where they are named or complex.
pub(super) fn rates(recurrence: &Recurrence, coupled: &Coupled) -> Vec<String> {
    let numbers = Numbers::new(recurrence.constants());
    let decimal = |rate: &Fraction| {
        let values = |symbol: &Symbol, bits: u64| numbers.value(symbol, bits);
        let ball = enclose_expression(&rate.clone().into(), &values, BITS).ok()?;
        let part = |ball: &Ball| ball.to_decimal(DIGITS).midpoint().to_string();
        let imaginary = part(ball.imaginary());
        Some(match imaginary.trim_start_matches('-') {
            zero if zero.trim_matches(['0', '.']).is_empty() => part(ball.real()),
            size if imaginary.starts_with('-') => format!("{} - {size}i", part(ball.real())),
            size => format!("{} + {size}i", part(ball.real())),
        })
    };
    let told = |rate: &Fraction| match rate.as_constant() {
        Some(number) => number.to_string(),
        None => decimal(rate).unwrap_or_else(|| rate.to_string()),
    };
    coupled.rates.iter().map(told).collect()
}
