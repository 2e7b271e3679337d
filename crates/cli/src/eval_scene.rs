//! `eval` for scenes: in their units, with constants, on lattices, and energies.

use super::arguments::Eval;
use super::eval_recurrence::{rows, window};
use super::failure::Failure;
use super::progress;
use super::quantity;
use super::rows::{Row, time_on_period, times, written};
use num_rational::BigRational;
use wavestep::evaluate::{ClosedSignal, EvaluateError, Limit, digits};
use wavestep::expression::Fraction;
use wavestep::language;
use wavestep::network::{Network, Observed, ObservedValue};
use wavestep::signal::{self, Purpose};
use wavestep::solution::Solution;

/// Evaluates an observable or a wave of a scene.
pub fn run(network: &Network, options: &Eval) -> Result<String, Failure> {
    let observed = quantity::of_scene(network, &options.quantity)?;
    let side = options.side;
    if network.scene().contacts_open {
        return across_phases(network, side, options);
    }
    let times = match (options.piece, &options.local) {
        (Some(n), Some(local)) => vec![time_on_piece(network, &observed, n, local, side)?],
        _ => times(options, network.scene().dimensional)?,
    };
    let window = window(&times);
    if options.stats {
        let signal = ClosedSignal::of_scene(network, &observed, window)?.echo_by_echo();
        let rows = rows(&signal, times.clone(), options)?;
        if let Some((expanded, needed)) = signal.work() {
            eprintln!("echoes expanded: {expanded} of {needed} that can reach what is observed");
        }
        return Ok(told(network, &observed, &rows, options));
    }
    let signal = signal::of_scene(network, &observed, window, Purpose::Values)?;
    let rows = rows(&*signal, times.clone(), options)?;
    Ok(told(network, &observed, &rows, options))
}

/// Rows with the units of the scene.
fn told(network: &Network, observed: &Observed, rows: &[Row], options: &Eval) -> String {
    let unit = language::unit_of(observed.dimension);
    let (second, spaced) = match network.scene().dimensional {
        true if unit.is_empty() => (" s", String::new()),
        true => (" s", format!(" {unit}")),
        false => ("", String::new()),
    };
    written(rows, &network.scene().title, [second, &spaced, &unit], options)
}

/// Values of a scene whose contacts open and close.
fn across_phases(network: &Network, side: Limit, options: &Eval) -> Result<String, Failure> {
    let observed = quantity::of_phases(network, &options.quantity)?;
    let name = &observed.name;
    if options.piece.is_some() || options.stats {
        let message = "where contacts open there are no periods and no counted echoes";
        return Err(Failure::usage(message, "give --at T, or --from, --to and --points"));
    }
    let times = times(options, network.scene().dimensional)?;
    let signal = {
        let _progress = progress::spinner("following contacts");
        signal::of_scene(network, &observed, window(&times), Purpose::Values)?
    };
    let mut rows = Vec::with_capacity(times.len());
    for time in times {
        let value = digits(&*signal, &time, side, options.digits, options.max_bits);
        let value = value.map_err(|error| match error {
            EvaluateError::AccuracyNotReached { best, .. } => {
                let best = best.to_decimal(options.digits);
                let message = format!("accuracy not reached at t = {time}: {name} = {best}");
                Failure::Accuracy(message, "ask for fewer digits".to_owned())
            }
            other => other.into(),
        })?;
        rows.push(Row { time, value });
    }
    Ok(told(network, &observed, &rows, options))
}

/// The time on a period of the observable, in scenes on one grid and without units.
fn time_on_piece(
    network: &Network,
    observed: &Observed,
    n: usize,
    local: &str,
    side: Limit,
) -> Result<BigRational, Failure> {
    let refuse = || {
        let message = format!("{} has no periods of its own", observed.name);
        Failure::usage(message, "give --at T, or --from, --to and --points")
    };
    let ObservedValue::Linear(observation) = &observed.value else { return Err(refuse()) };
    let one_grid = network.lattice().periods().len() == 1 && !network.scene().dimensional;
    let solution = one_grid.then(|| network.recurrence()).transpose()?.map(Solution::new);
    let offset = solution.as_ref().and_then(|solution| solution.offset(observation));
    let number = |value: &Fraction| value.as_constant().ok_or_else(refuse);
    let period = number(&network.lattice().periods()[0])?;
    let offset = number(&offset.ok_or_else(refuse)?)?;
    Ok(offset + time_on_period(n, local, &period, side)?)
}
