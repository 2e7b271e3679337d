//! The echoes of a lattice in the order in which they arrive.

use crate::enclosure::{EnclosureError, Numbers};
use crate::evaluate::error::EvaluateError;
use crate::expression::{Expression, Fraction};
use crate::network::Network;
use crate::recurrence::WaveIndex;
use crate::solution::{Demand, EchoByEcho, SolveError};
use std::cmp::Ordering;
use wavestep_polynomial::Symbol;

/// An echo of a wave on a lattice of delays.
///
/// ```
/// use wavestep::evaluate::arrivals;
/// use wavestep::language::{Source, read_scene};
/// use wavestep::network::Network;
///
/// let source = Source::new("steps.wave", r#"
///     scene "Two bars whose travel times have no common measure"
///     symbol a > 0, b > 0
///     bar left  { impedance = 1, travel = a, velocity = 1 }
///     bar right { impedance = 1, travel = b }
///     line free - left | right - free
/// "#)?;
/// let network = Network::new(&read_scene(&source, &Default::default()).unwrap()).unwrap();
/// let g = network.waves().iter().position(|wave| wave.name == "g_left").unwrap();
/// let echoes = arrivals(&network, &[g], 1).unwrap();
/// // First −1/2 goes back; equal bars reflect nothing, so the next comes from the far end of the
/// // right bar, after two passages of it.
/// let shown: Vec<String> = echoes.iter().map(|echo| echo.delay.to_string()).collect();
/// assert_eq!(shown, ["0", "2*b"]);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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

/// Why echoes cannot be listed.
///
/// ```
/// use wavestep::evaluate::ArrivalError;
/// use wavestep::enclosure::EnclosureError;
///
/// let error = ArrivalError::from(EnclosureError::NotReal);
/// assert!(matches!(error, ArrivalError::Evaluate(_)));
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum ArrivalError {
    /// An echo cannot be given exactly.
    Solve(SolveError),
    /// The scene gives no recurrence, or its times cannot be told apart.
    Evaluate(EvaluateError),
}

impl From<SolveError> for ArrivalError {
    fn from(error: SolveError) -> ArrivalError {
        ArrivalError::Solve(error)
    }
}

impl From<EnclosureError> for ArrivalError {
    fn from(error: EnclosureError) -> ArrivalError {
        ArrivalError::Evaluate(error.into())
    }
}

impl From<EvaluateError> for ArrivalError {
    fn from(error: EvaluateError) -> ArrivalError {
        ArrivalError::Evaluate(error)
    }
}

/// The echoes of some waves that are not zero, of at most `through` periods of the lattice together:
/// where the periods are numbers those are left out that others may come before, and the rest is in
/// order of arrival; else they are in order of their counts.
///
/// # Errors
/// [`ArrivalError`].
///
/// # Cost
/// That of all echoes of so many periods: for `r` periods in the lattice about `through^r/r!` of them.
///
/// ```
/// use wavestep::language::{Source, read_scene};
/// use wavestep::network::Network;
///
/// let text = wavestep::scenes::find("incommensurate").unwrap().text;
/// let scene = read_scene(&Source::new("incommensurate", text)?, &Default::default()).unwrap();
/// let network = Network::new(&scene).unwrap();
/// let echoes = wavestep::evaluate::arrivals(&network, &[0], 4).unwrap();
/// assert!(echoes.iter().all(|arrival| arrival.counts.iter().sum::<usize>() <= 4));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn arrivals(
    network: &Network,
    waves: &[WaveIndex],
    through: usize,
) -> Result<Vec<Arrival>, ArrivalError> {
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
    let mut solver = EchoByEcho::new(recurrence).wanting(demand);
    for _ in 0..last.map_or(0, |last| last + 1) {
        solver.advance()?;
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
    in_order(found, &numbers, periods, through)
}

/// Sorts wave by wave, by time where that can be told.
fn in_order(
    mut found: Vec<Arrival>,
    numbers: &Numbers,
    periods: &[Fraction],
    through: usize,
) -> Result<Vec<Arrival>, ArrivalError> {
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
