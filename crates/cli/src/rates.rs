//! The rates at which waves decay together, for people.

use super::failure::Failure;
use wavestep::ball::Ball;
use wavestep::enclosure::{Numbers, enclose_expression};
use wavestep::expression::Fraction;
use wavestep::network::Network;
use wavestep::recurrence::{Coupled, Recurrence};
use wavestep_polynomial::Symbol;

/// The precision of rates, and their digits.
const RATE_BITS: u64 = 64;
const RATE_DIGITS: usize = 6;

/// What is told where the exact form needs rates that formulas cannot hold.
pub fn failure_of_rates(network: &Network, recurrence: &Recurrence) -> Option<Failure> {
    let named = |rate: &Fraction| recurrence.constants().iter().any(|c| rate.contains(&c.symbol));
    let system = recurrence.coupled().iter().find(|system| system.rates.iter().any(named))?;
    let names: Vec<String> = system.waves.iter().map(|w| recurrence.wave_name(*w)).collect();
    let (place, found) = (network.place_of_waves(&names), rates(recurrence, system));
    Some(Failure::Computation(
        format!(
            "{place}, {} decay together at the rates {}, which these formulas would have to hold",
            names.join(" and "),
            found.join(", ")
        ),
        "evaluate it, which works with any certified rates; or give values for which the rates are \
         rational, or roots of one quadratic in rational numbers"
            .to_owned(),
    ))
}

/// The rates of a system: exactly, or as decimals where they are named or complex.
pub fn rates(recurrence: &Recurrence, coupled: &Coupled) -> Vec<String> {
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
