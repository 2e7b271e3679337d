//! `eval` of recurrences.

use super::arguments::Eval;
use super::failure::Failure;
use super::progress;
use super::quantity;
use super::rows::{Row, time_on_period, times, written};
use wavestep::evaluate::Evaluator;
use wavestep::recurrence::Recurrence;
use wavestep::solution::Solution;

/// Evaluates a wave or an observable of a recurrence.
pub fn of_recurrence(recurrence: Recurrence, options: &Eval) -> Result<String, Failure> {
    let observation = quantity::of_recurrence(&recurrence, &options.quantity)?;
    let solution = Solution::new(recurrence);
    let evaluator = Evaluator::new(&solution)?;
    let times = match (options.piece, &options.local) {
        (Some(n), Some(local)) => {
            let Some(offset) = solution.offset(&observation) else {
                let message = format!("{} has no periods of its own", options.quantity);
                return Err(Failure::usage(message, "its waves arrive apart: give --at T"));
            };
            let offset = offset.as_constant().expect("every symbol has a value");
            vec![offset + time_on_period(n, local, evaluator.period(), options.side)?]
        }
        _ => times(options, false)?,
    };
    let progress = progress::counted(times.len());
    let mut rows = Vec::with_capacity(times.len());
    for time in times {
        let value =
            evaluator.value(&observation, &time, options.side, options.digits, options.max_bits)?;
        rows.push(Row { time, value });
        progress.inc(1);
    }
    drop(progress);
    Ok(written(&rows, &solution.recurrence().statement().title, ["", "", ""], options))
}
