//! The echoes of a lattice in the order in which they arrive.

use crate::enclosure::Numbers;
use crate::expression::{Expression, Fraction};
use crate::network::Network;
use crate::recurrence::WaveIndex;
use crate::signal::error::{EvaluateError, Outcome};
use crate::solution::{Demand, EchoByEcho};
use std::cmp::Ordering;
use wavestep_polynomial::Symbol;

/// An echo of a wave on a lattice of delays.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Arrival {
    /// The wave.
    pub wave: WaveIndex,
    /// How often each period of the lattice has passed.
    pub counts: Vec<usize>,
    /// When it arrives, by the clock of the wave.
    pub delay: Fraction,
    /// The echo, as a function of the local time since then.
    pub echo: Expression,
}

/// An echo with more terms than are asked for: how many periods of the lattice it has passed, and its terms at least.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LongEcho {
    pub passed: usize,
    pub terms: usize,
}

/// The echoes of some waves that are not zero, of at most `through` periods of the lattice together:
/// where the periods are numbers those are left out that others may come before, and the rest is in
/// order of arrival; else they are in order of their counts. Where rates have names, the first echo with more than `most`
/// terms ends the work.
pub fn arrivals(
    network: &Network,
    waves: &[WaveIndex],
    through: usize,
    most: usize,
) -> Outcome<Result<Vec<Arrival>, LongEcho>> {
    let numbers = Numbers::new(&network.model().constants);
    let periods = network.lattice().periods();
    let bounds = vec![through; periods.len()];
    let unfolded = network.unfold(&bounds).map_err(|e| EvaluateError::Network(Box::new(e)))?;
    let recurrence = unfolded.recurrence();
    let counts = |k: usize| unfolded.counts(k).filter(|n| n.iter().sum::<usize>() <= through);
    let mut demand = Demand::none(recurrence);
    for wave in waves {
        for k in unfolded.numbers().filter(|k| counts(*k).is_some()) {
            demand.add_where(recurrence, *wave, k, |k| counts(k).is_some());
        }
    }
    let last = demand.last();
    let mut solver = EchoByEcho::new(recurrence).wanting(demand).returning(through);
    let most = if recurrence.names_rates_of(1) { most } else { usize::MAX };
    for k in 0..last.map_or(0, |last| last + 1) {
        let mut terms = 0;
        let is_short = solver.advance_while(|echo| {
            terms += echo.term_count();
            terms <= most
        })?;
        if !is_short {
            let passed = counts(k).map_or(through, |counts| counts.iter().sum());
            return Ok(Err(LongEcho { passed, terms }));
        }
    }
    let local: &Symbol = &recurrence.statement().local;
    let mut found = Vec::new();
    for wave in waves {
        for k in unfolded.numbers() {
            let (Some(counts), Some(delay)) = (counts(k), unfolded.delay(k)) else { continue };
            let echo = solver.transforms(*wave)[k].function(local);
            if !echo.is_zero() {
                found.push(Arrival { wave: *wave, counts, delay, echo });
            }
        }
    }
    in_order(found, &numbers, periods, through).map(Ok)
}

/// Sorts wave by wave, by time where that can be told.
fn in_order(
    mut found: Vec<Arrival>,
    numbers: &Numbers,
    periods: &[Fraction],
    through: usize,
) -> Outcome<Vec<Arrival>> {
    let told = periods.iter().all(|period| numbers.enclose(period, 64).is_ok());
    if !told {
        let total = |arrival: &Arrival| arrival.counts.iter().sum::<usize>();
        found.sort_by_cached_key(|arrival| (arrival.wave, total(arrival), arrival.counts.clone()));
        return Ok(found);
    }
    // Beyond the bounds nothing comes before one more of the shortest period than is counted.
    let mut shortest = &periods[0];
    for period in periods {
        if numbers.compare(period, shortest)? == Ordering::Less {
            shortest = period;
        }
    }
    let limit = shortest.scale(&wavestep_polynomial::Rational::from_integer((through + 1).into()));
    let mut kept: Vec<Arrival> = Vec::new();
    // The delays of the wave at hand, the last in what is kept.
    let mut delays: Vec<Fraction> = Vec::new();
    for arrival in found {
        if numbers.compare(&arrival.delay, &limit)? != Ordering::Less {
            continue;
        }
        if kept.last().is_some_and(|last| last.wave != arrival.wave) {
            delays.clear();
        }
        let (Ok(place) | Err(place)) = numbers.search(&delays, &arrival.delay)?;
        delays.insert(place, arrival.delay.clone());
        kept.insert(kept.len() + 1 + place - delays.len(), arrival);
    }
    Ok(kept)
}
