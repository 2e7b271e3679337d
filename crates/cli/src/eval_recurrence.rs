//! `eval` of recurrences.

use super::arguments::Eval;
use super::failure::Failure;
use super::progress;
use super::quantity;
use super::rows::{Row, time_on_period, times, written};
use num_rational::BigRational;
use wavestep::evaluate::{ClosedSignal, EvaluateError, Signal, digits};
use wavestep::recurrence::Recurrence;
use wavestep::solution::Solution;

/// Evaluates a wave or an observable of a recurrence.
pub fn of_recurrence(recurrence: Recurrence, options: &Eval) -> Result<String, Failure> {
    let observation = quantity::of_recurrence(&recurrence, &options.quantity)?;
    let solution = Solution::new(recurrence);
    if let Some(symbol) = solution.recurrence().symbols().next() {
        return Err(EvaluateError::MissingValue(symbol.clone()).into());
    }
    let times = match (options.piece, &options.local) {
        (Some(n), Some(local)) => {
            let Some(offset) = solution.offset(&observation) else {
                let message = format!("{} has no periods of its own", options.quantity);
                return Err(Failure::usage(message, "its waves arrive apart: give --at T"));
            };
            let offset = offset.as_constant().expect("every symbol has a value");
            let period = solution.recurrence().statement().period.as_constant();
            let period = period.expect("every symbol has a value");
            vec![offset + time_on_period(n, local, &period, options.side)?]
        }
        _ => times(options, false)?,
    };
    let signal = ClosedSignal::of_recurrence(&solution, &observation, window(&times))?;
    let rows = rows(&signal, times, options)?;
    Ok(written(&rows, &solution.recurrence().statement().title, ["", "", ""], options))
}

/// The first and the last of some times.
pub fn window(times: &[BigRational]) -> [&BigRational; 2] {
    let ends = times.iter().min().zip(times.iter().max());
    let (first, last) = ends.expect("times without any are refused");
    [first, last]
}

/// The digits of a signal at times.
pub fn rows(
    signal: &dyn Signal,
    times: Vec<BigRational>,
    options: &Eval,
) -> Result<Vec<Row>, EvaluateError> {
    let progress = progress::counted(times.len());
    let mut rows = Vec::with_capacity(times.len());
    for time in times {
        let value = digits(signal, &time, options.side, options.digits, options.max_bits)?;
        rows.push(Row { time, value });
        progress.inc(1);
    }
    Ok(rows)
}
