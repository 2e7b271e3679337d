//! `eval` for scenes: in their units, with constants, on lattices, and energies.

use super::arguments::Eval;
use super::failure::Failure;
use super::progress;
use super::quantity;
use super::rows::{Row, time_on_period, times, written};
use num_rational::BigRational;
use wavestep::evaluate::{Evaluator, Limit, SceneEvaluator, Value};
use wavestep::expression::Fraction;
use wavestep::history::History;
use wavestep::language;
use wavestep::network::{Network, Observed, ObservedValue};
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
    if let Some(solution) = closed_form(network, &observed)?.filter(|_| !options.stats) {
        return told_by_closed_form(&solution, &observed, times, side, options);
    }
    let scaled: Vec<Fraction> = times.iter().map(|time| network.scaled_time(time)).collect();
    let last = times.iter().zip(&scaled).max().map(|(_, scaled)| scaled.clone());
    let last = last.expect("times without any are refused");
    let evaluator = SceneEvaluator::new(network, &last)?;
    let progress = progress::counted(times.len());
    let mut rows = Vec::with_capacity(times.len());
    for (time, scaled) in times.into_iter().zip(scaled) {
        let value = evaluator.value(&observed, &scaled, side, options.digits, options.max_bits)?;
        rows.push(Row { time, value });
        progress.inc(1);
    }
    drop(progress);
    if options.stats {
        let (expanded, needed) = (evaluator.expanded(), evaluator.needed());
        eprintln!("echoes expanded: {expanded} of {needed} that can reach what is observed");
    }
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
    let values = {
        let _progress = progress::spinner("following contacts");
        History::values(network, name, &times, side, options.digits)?
    };
    let mut rows = Vec::with_capacity(times.len());
    for (time, value) in times.into_iter().zip(values) {
        if let Value::Enclosed(best) = &value {
            let best = best.to_decimal(options.digits);
            let message = format!("accuracy not reached at t = {time}: {name} = {best}");
            return Err(Failure::Accuracy(message, "ask for fewer digits".to_owned()));
        }
        rows.push(Row { time, value });
    }
    Ok(told(network, &observed, &rows, options))
}

/// The solution of a scene in which echoes of all that is observed have a closed form, without units
/// and named constants: then any of them is had without those before.
fn closed_form(network: &Network, observed: &Observed) -> Result<Option<Solution>, Failure> {
    let ObservedValue::Linear(observation) = &observed.value else { return Ok(None) };
    if network.scene().dimensional || network.lattice().periods().len() > 1 {
        return Ok(None);
    }
    let recurrence = network.recurrence()?;
    let is_number = recurrence.symbols().next().is_none() && recurrence.constants().is_empty();
    let solution = Solution::new(recurrence);
    let known = observation.waves.iter().all(|seen| solution.general(seen.wave).is_ok());
    Ok((is_number && known).then_some(solution))
}

fn told_by_closed_form(
    solution: &Solution,
    observed: &Observed,
    times: Vec<BigRational>,
    side: Limit,
    options: &Eval,
) -> Result<String, Failure> {
    let ObservedValue::Linear(observation) = &observed.value else {
        unreachable!("energies have no closed form")
    };
    let evaluator = Evaluator::new(solution)?;
    let progress = progress::counted(times.len());
    let mut rows = Vec::with_capacity(times.len());
    for time in times {
        let value = evaluator.value(observation, &time, side, options.digits, options.max_bits)?;
        rows.push(Row { time, value });
        progress.inc(1);
    }
    drop(progress);
    Ok(written(&rows, &solution.recurrence().statement().title, ["", "", ""], options))
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
