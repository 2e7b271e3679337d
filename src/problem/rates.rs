//! The rates at which waves decay together, in decimals.

use super::{Kind, Problem, ProblemError};
use crate::ball::Ball;
use crate::enclosure::{Numbers, enclose_expression};
use crate::expression::Fraction;
use crate::recurrence::{Coupled, Recurrence};
use wavestep_polynomial::Symbol;

/// The precision of rates, and their digits.
const RATE_BITS: u64 = 64;
const RATE_DIGITS: usize = 6;

impl Problem {
    /// What is told where the exact form needs rates that formulas cannot hold, instead of what was found
    /// wrong.
    pub(super) fn explained(&self, error: ProblemError) -> ProblemError {
        let (Kind::Line { network, .. }, Ok(recurrence)) = (&self.kind, self.recurrence()) else {
            return error;
        };
        let named =
            |rate: &Fraction| recurrence.constants().iter().any(|c| rate.contains(&c.symbol));
        let mut systems = recurrence.coupled().iter();
        let Some(system) = systems.find(|system| system.rates.iter().any(named)) else {
            return error;
        };
        let waves: Vec<String> = system.waves.iter().map(|w| recurrence.wave_name(*w)).collect();
        let (place, rates) = (network.place_of_waves(&waves), rates(recurrence, system));
        ProblemError::Rates { place, waves, rates }
    }
}

/// The rates of a system: exactly, or as decimals where they are named or complex.
pub(super) fn rates(recurrence: &Recurrence, coupled: &Coupled) -> Vec<String> {
    let numbers = Numbers::new(recurrence.constants());
    let decimal = |rate: &Fraction| {
        let values = |symbol: &Symbol, bits: u64| numbers.value(symbol, bits);
        let ball = enclose_expression(&rate.clone().into(), &values, RATE_BITS).ok()?;
        let part = |ball: &Ball| ball.to_decimal(RATE_DIGITS).midpoint().to_string();
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
