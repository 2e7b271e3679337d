//! `check`: a scene is read, ordered, and derived in two ways that must agree; or it is compared
//! with what is locked.

use super::arguments::Check;
use super::failure::Failure;
use super::input;
use super::lock;
use super::output::plural;
use super::progress;
use std::fmt::Write as _;
use wavestep::expression::Condition;
use wavestep::problem::{Checked, Derivations, General, Periods, Problem, Solved};
use wavestep_polynomial::Symbol;

pub fn run(options: &Check) -> Result<String, Failure> {
    if let Some(file) = &options.locked {
        return lock::check(&options.scene.scene, file);
    }
    let problem = input::problem(&options.scene)?;
    let checked = {
        let _progress = progress::spinner("deriving in two ways");
        problem.check()?
    };
    if problem.holds(1).is_some_and(|holds| holds.never()) {
        eprintln!("note: a contact is in tension from the start: is the sign of a velocity wrong?");
    }
    let mut report = format!("{}: {}\n", problem.title(), verdict(&checked, &problem));
    if !options.verbose {
        return Ok(report);
    }
    match checked {
        Checked::NoRecurrence(why) => {
            let _ = writeln!(report, "  {why}: no recurrence; events and values are proven");
        }
        Checked::Lattice { echoes } => {
            let _ = writeln!(report, "  waves: {}", problem.waves().join(", "));
            add_observables(&mut report, &problem.observables());
            let _ = writeln!(
                report,
                "  incommensurable travel times: no periods; echoes in order of arrival\n  \
                 derived echo by echo: {echoes} echoes"
            );
        }
        Checked::NeedsValues { symbols, reason } => {
            add_symbols(&mut report, &symbols);
            let _ = writeln!(report, "  waves: {}", problem.waves().join(", "));
            add_observables(&mut report, &problem.observables());
            let _ = writeln!(report, "  not derived: {reason}");
            let _ = writeln!(report, "  pieces, values and events need {}", listed(&symbols));
        }
        Checked::Periods(periods) => add_periods(&mut report, &periods, &problem.observables()),
    }
    Ok(report)
}

/// What the scene has, in a line.
fn verdict(checked: &Checked, problem: &Problem) -> String {
    let observed = plural(problem.observables().len(), "observable");
    match checked {
        Checked::NoRecurrence(_) => {
            let set = |name: &&str| format!("--set {name}=…");
            let needed = match &problem.symbols()[..] {
                [] => String::new(),
                symbols => {
                    format!(" (with {})", symbols.iter().map(set).collect::<Vec<_>>().join(" "))
                }
            };
            format!("consistent; proven events and values of {observed}{needed}")
        }
        Checked::Lattice { .. } => {
            format!("consistent; echoes in order of arrival, values of {observed}")
        }
        Checked::NeedsValues { symbols, .. } => {
            let symbols = listed(symbols);
            format!("consistent; formulas, events and values of {observed} need {symbols}")
        }
        Checked::Periods(found) => {
            let known = |(_, general): &(String, General)| !matches!(general, General::Unknown);
            let has_general = !found.general.is_empty() && found.general.iter().all(known);
            let general = if has_general { ", a general form" } else { "" };
            let needed = match &found.symbols[..] {
                [] => String::new(),
                symbols => format!(" (with {})", listed(symbols)),
            };
            format!("consistent; formulas for each period{general}, values of {observed}{needed}")
        }
    }
}

/// Symbols that are given values as the command takes them.
fn listed(symbols: &[(Symbol, Option<Condition>)]) -> String {
    let set: Vec<String> = symbols.iter().map(|(symbol, _)| format!("--set {symbol}=…")).collect();
    set.join(" ")
}

fn add_symbols(report: &mut String, symbols: &[(Symbol, Option<Condition>)]) {
    for (symbol, condition) in symbols {
        let condition = condition.as_ref().map_or_else(String::new, |known| format!(" {known}"));
        let _ = writeln!(report, "  symbol {symbol}{condition}");
    }
}

fn add_observables<T: std::borrow::Borrow<str>>(report: &mut String, observables: &[T]) {
    if !observables.is_empty() {
        let _ = writeln!(report, "  observables: {}", <[T]>::join(observables, ", "));
    }
}

fn add_periods(report: &mut String, found: &Periods, observables: &[&str]) {
    add_symbols(report, &found.symbols);
    if !found.factors.is_empty() {
        let _ = writeln!(report, "  assumed nonzero: {}", found.factors.join(", "));
    }
    for (wave, solved) in &found.steps {
        let kind = match solved {
            Solved::Differential => "first-order differential",
            Solved::Algebraic => "algebraic",
        };
        let _ = writeln!(report, "  wave {wave}: {kind}");
    }
    for (waves, rates) in &found.coupled {
        let (waves, rates) = (waves.join(", "), rates.join(", "));
        let _ = writeln!(report, "  coupled: {waves}, with the rates {rates}");
    }
    add_observables(report, observables);
    let _ = match found.derived {
        (Derivations::InTwoWays, last) => {
            writeln!(report, "  derived in two ways, equal in periods 0 to {last}")
        }
        (Derivations::ByEchoes, last) => {
            writeln!(report, "  derived echo by echo to echo {last}, with named rates")
        }
    };
    for (wave, general) in &found.general {
        let general = match general {
            General::Powers => "a sum of powers",
            General::Echoes => "echoes in closed form",
            General::Unknown => "no closed form found",
        };
        let _ = writeln!(report, "  general form of {wave}: {general}");
    }
}
