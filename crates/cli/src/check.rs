//! `check`: a scene is read, ordered, and derived in two ways that must agree; or it is compared
//! with what is locked.

use super::arguments::Check;
use super::failure::Failure;
use super::input::{self, Readable, Subject};
use super::lock;
use super::progress;
use super::rates::{failure_of_rates, rates};
use wavestep::evaluate::arrivals;
use wavestep::export;
use wavestep::network::{Network, ScaledScene};
use wavestep::solution::{EchoByEcho, GeneralForm, PeriodByPeriod, Solution, SolveError};
use wavestep_polynomial::Symbol;

/// The periods for which both derivations are compared.
const PERIODS: usize = 6;

/// The same where formulas hold several named constants.
const PERIODS_WITH_CONSTANTS: usize = 2;

/// How many periods of a lattice are followed in a check.
const FIRST_ECHOES: usize = 3;

/// What can be said of a scene that has no recurrence: it was read, and its parts fit.
fn with_local_contact(scaled: &ScaledScene) -> String {
    let scene = scaled.scene();
    let contact = scaled.local_contact().map(|contact| scene.elements[contact].name.as_str());
    format!(
        "{}: consistent\n  `{}` is a local contact: no recurrence, values by the method of steps\n",
        scene.title,
        contact.unwrap_or_default()
    )
}

/// Checks a scene and says what was found.
pub fn run(options: &Check) -> Result<String, Failure> {
    if let Some(file) = &options.locked {
        return lock::check(&options.scene.scene, file);
    }
    let subject = match input::readable(&options.scene)? {
        Readable::Subject(subject) => subject,
        Readable::WithoutRecurrence(scaled) => return Ok(with_local_contact(&scaled)),
    };
    let (recurrence, network) = match subject {
        Subject::Recurrence(recurrence) => (*recurrence, None),
        Subject::Scene(network) if network.lattice().periods().len() > 1 => {
            return on_lattice(&network);
        }
        Subject::Scene(network) => (network.recurrence()?, Some(network)),
    };
    let shown = network.as_ref().map(|network| network.waves().len());
    let shown = shown.unwrap_or(recurrence.statement().waves.len());
    let statement = recurrence.statement();
    let mut by_period = PeriodByPeriod::new(&recurrence);
    let mut by_echo = EchoByEcho::new(&recurrence);
    let told = |error: SolveError| {
        let network = network.as_ref();
        let of_rates = network.and_then(|network| failure_of_rates(network, &recurrence));
        of_rates.unwrap_or_else(|| error.into())
    };
    let twice = !recurrence.has_named_rates();
    // Each further constant in the formulas multiplies their length.
    let periods = if recurrence.constants().len() > 1 { PERIODS_WITH_CONSTANTS } else { PERIODS };
    let progress = progress::spinner("deriving in two ways");
    for n in 0..=periods {
        by_echo.advance().map_err(told)?;
        if !twice {
            continue;
        }
        by_period.advance().map_err(told)?;
        for (wave, name) in statement.waves.iter().enumerate() {
            let piece = by_echo.sum(wave).piece(n).ok();
            let other = &by_period.waves()[wave].pieces()[n];
            let difference = piece.map(|piece| statement.assumptions.reduced(&(&piece - other)));
            if difference.is_none_or(|difference| !difference.is_zero()) {
                let message = format!("the two derivations of {name}[{n}] disagree");
                let remedy = "please report this scene: it is a fault of wavestep".to_owned();
                return Err(Failure::Computation(message, remedy));
            }
        }
    }
    drop(progress);
    let mut report = format!("{}: consistent\n", statement.title);
    let symbols = statement.assumptions.symbols();
    let is_constant = |symbol: &Symbol| recurrence.constants().iter().any(|c| c.symbol == *symbol);
    for (symbol, condition) in symbols.filter(|(symbol, _)| !is_constant(symbol)) {
        let condition = condition.map_or_else(String::new, |condition| format!(" {condition}"));
        report.push_str(&format!("  symbol {symbol}{condition}\n"));
    }
    let factors = export::assumed_factors(&statement.assumptions);
    if !factors.is_empty() {
        report.push_str(&format!("  taken to be non-zero: {}\n", factors.join(", ")));
    }
    for step in recurrence.steps().iter().filter(|step| step.wave < shown) {
        let kind = if step.start.is_some() { "first-order differential" } else { "algebraic" };
        report.push_str(&format!("  wave {}: {kind}\n", recurrence.wave_name(step.wave)));
    }
    for coupled in recurrence.coupled() {
        let names: Vec<String> = coupled.waves.iter().map(|w| recurrence.wave_name(*w)).collect();
        let rates = rates(&recurrence, coupled).join(", ");
        report.push_str(&format!("  coupled: {}, with the rates {rates}\n", names.join(", ")));
    }
    let observables: Vec<&str> =
        statement.observables.iter().map(|observable| observable.name.as_str()).collect();
    if !observables.is_empty() {
        report.push_str(&format!("  observables: {}\n", observables.join(", ")));
    }
    report.push_str(&match twice {
        true => format!("  derived in two ways, equal on periods 0 to {periods}\n"),
        false => format!("  derived echo by echo, with names for rates, to echo {periods}\n"),
    });
    let names = statement.waves[..shown].to_vec();
    let solution = Solution::new(recurrence);
    for (wave, name) in names.iter().enumerate() {
        let found = match solution.general(wave) {
            Ok(GeneralForm::Geometric(_)) => "a sum of powers",
            Ok(GeneralForm::Echoes(_)) => "echoes in closed form",
            Err(_) => "no closed form found",
        };
        report.push_str(&format!("  general n of {name}: {found}\n"));
    }
    Ok(report)
}

/// Checks a scene whose travel times have no common measure: its laws are solved, and the first echoes
/// derived.
fn on_lattice(network: &Network) -> Result<String, Failure> {
    let waves: Vec<usize> = (0..network.waves().len()).collect();
    let found = arrivals(network, &waves, FIRST_ECHOES)?;
    let names: Vec<&str> = network.waves().iter().map(|wave| wave.name.as_str()).collect();
    let observables: Vec<&str> =
        network.observables().iter().map(|observed| observed.name.as_str()).collect();
    let mut report = format!("{}: consistent\n", network.scene().title);
    report.push_str(&format!("  waves: {}\n", names.join(", ")));
    if !observables.is_empty() {
        report.push_str(&format!("  observables: {}\n", observables.join(", ")));
    }
    report.push_str(
        "  the travel times have no common measure: no periods, echoes in order of arrival\n",
    );
    report.push_str(&format!("  derived echo by echo: {} echoes\n", found.len()));
    Ok(report)
}
