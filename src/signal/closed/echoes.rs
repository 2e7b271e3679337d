//! The echoes of a network that arrive until a time, on a lattice of delays, and what they are in a field.

use crate::ball::{Ball, ComplexBall};
use crate::enclosure::{EnclosureError, Numbers};
use crate::expression::{Field, Fraction, Transform};
use crate::limits::MAX_ECHOES;
use crate::network::{Network, Unfolded};
use crate::recurrence::{Recurrence, WaveIndex};
use crate::signal::closed::memory::Memory;
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::signal::{Limit, has_begun};
use crate::solution::{Demand, EchoByEcho};
use num_traits::{One, Signed, ToPrimitive};
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// The echoes of all waves, by wave and number.
pub(crate) type Echoes<V = ComplexBall> = Vec<Vec<Transform<V>>>;

/// Enough to tell most times from a delay.
const NEAR_BITS: u64 = 64;

/// When echoes arrive.
pub(super) struct Arriving {
    /// The recurrence with lags on the lattice.
    pub unfolded: Unfolded,
    /// The echoes that can arrive by number, with their delays.
    pub arrivals: Vec<(usize, Fraction)>,
    /// Enclosures of these delays.
    near: Vec<Ball>,
    /// Until when they are known, in the scale of the scene.
    pub last: Fraction,
}

impl Arriving {
    /// Those that arrive until a time; every symbol has a value, and they are not too many.
    pub fn of(network: &Network, last: &Fraction) -> Outcome<Arriving> {
        let numbers = Numbers::new(&network.model().constants);
        let mut symbols = network.model().assumptions.symbols().map(|(symbol, _)| symbol);
        if let Some(symbol) = symbols.find(|symbol| numbers.value(symbol, 64).is_none()) {
            return Err(EvaluateError::MissingValue(symbol.clone()));
        }
        // A wave is seen at most as long before its own clock as that clock is late.
        let mut latest = Fraction::zero();
        for late in network.leads() {
            if numbers.compare(late, &latest)? == Ordering::Greater {
                latest = late.clone();
            }
        }
        let latest = last + &latest;
        // In a direction without lags nothing arrives but at once.
        let bound = |(period, lag): (&Fraction, usize)| match lag {
            0 => Ok(0),
            _ => whole_periods(&numbers, &latest, period, MAX_ECHOES),
        };
        let directions = network.lattice().periods().iter().zip(network.largest_lags());
        let bounds: Vec<usize> = match last_number(network)? {
            Some(0) => vec![0],
            Some(last) => {
                let period = &network.lattice().periods()[0];
                vec![last.min(whole_periods(&numbers, &latest, period, usize::MAX)?)]
            }
            None => directions.map(bound).collect::<Result<_, _>>()?,
        };
        let total =
            bounds.iter().fold(1_u128, |product, bound| product.saturating_mul(*bound as u128 + 1));
        if total > MAX_ECHOES as u128 {
            return Err(EvaluateError::TooManyEchoes { echoes: total, limit: MAX_ECHOES });
        }
        let unfolded = network.unfold(&bounds)?;
        if let Some(symbol) = unfolded.recurrence().symbols().next() {
            return Err(EvaluateError::MissingValue(symbol.clone()));
        }
        let end = numbers.enclose(&latest, NEAR_BITS)?;
        let (mut arrivals, mut near) = (Vec::new(), Vec::new());
        for number in unfolded.numbers() {
            let delay = unfolded.delay(number).expect("within the bounds");
            let about = numbers.enclose(&delay, NEAR_BITS)?;
            if about.subtract(&end, NEAR_BITS).sign() != Some(Ordering::Greater) {
                arrivals.push((number, delay));
                near.push(about);
            }
        }
        Ok(Arriving { arrivals, near, last: last.clone(), unfolded })
    }

    /// The echoes that have arrived by a time, each with its delay.
    pub fn begun(
        &self,
        numbers: &Numbers,
        time: &Fraction,
        side: Limit,
    ) -> Result<Vec<&(usize, Fraction)>, EnclosureError> {
        let near_time = numbers.enclose(time, NEAR_BITS)?;
        let mut begun = Vec::new();
        for (arrival, near) in self.arrivals.iter().zip(&self.near) {
            let begins = match near.subtract(&near_time, NEAR_BITS).sign() {
                Some(known) => known,
                None => numbers.compare(&arrival.1, time)?,
            };
            if has_begun(begins, side) {
                begun.push(arrival);
            }
        }
        Ok(begun)
    }

    /// Adds an echo to those that are wanted, with all that it follows from.
    pub fn want(&self, demand: &mut Demand, wave: WaveIndex, number: usize) {
        let exists = |k| self.unfolded.counts(k).is_some();
        demand.add_where(self.unfolded.recurrence(), wave, number, exists);
    }
}

/// The number of the last echo that there is, where waves have one period and do not return.
fn last_number(network: &Network) -> Outcome<Option<usize>> {
    if network.lattice().periods().len() > 1 {
        return Ok(None);
    }
    Ok(network.recurrence()?.last_arrival())
}

/// How many whole periods fit into a time, or one more; no more than a limit.
pub(crate) fn whole_periods(
    numbers: &Numbers,
    time: &Fraction,
    period: &Fraction,
    limit: usize,
) -> Outcome<usize> {
    let time = numbers.enclose(time, 64)?;
    let inverse = numbers.enclose(period, 64)?.reciprocal(64).map_err(EvaluateError::Ball)?;
    let upper = Rational::from(&time.multiply(&inverse, 64).endpoints().1);
    let periods = upper.floor().to_integer();
    if periods.is_negative() {
        return Ok(0);
    }
    periods.to_usize().filter(|periods| *periods <= limit).ok_or_else(|| {
        let echoes = periods.to_u128().unwrap_or(u128::MAX).saturating_add(u128::one());
        EvaluateError::TooManyEchoes { echoes, limit }
    })
}

/// Why echoes are not worked out.
pub(crate) enum Unsolved<E> {
    /// A coefficient cannot be had in its field.
    InField(E),
    /// They would take too much memory.
    TooLong(EvaluateError),
}

impl From<Unsolved<EnclosureError>> for EvaluateError {
    fn from(error: Unsolved<EnclosureError>) -> EvaluateError {
        match error {
            Unsolved::InField(error) => error.into(),
            Unsolved::TooLong(error) => error,
        }
    }
}

/// Echoes, and how many of them are not zero.
type Expanded<V> = (Echoes<V>, usize);

/// The echoes that are wanted, with coefficients in a field.
pub(crate) fn solve_in<F: Field>(
    recurrence: &Recurrence,
    field: F,
    demand: Demand,
    mut memory: Memory,
) -> Result<Expanded<F::Value>, Unsolved<F::Error>> {
    let count = demand.last().map_or(0, |last| last + 1);
    let mut solver = EchoByEcho::in_field(recurrence, field).map_err(Unsolved::InField)?;
    solver = solver.wanting(demand);
    for _ in 0..count {
        solver.expand().map_err(|failed| Unsolved::InField(failed.reason))?;
        memory.add(solver.last_coefficients(), count).map_err(Unsolved::TooLong)?;
    }
    Ok((solver.echoes, solver.expanded))
}
