//! The waves of a scene one by one, each by its own clock.
//!
//! An observable sees waves at one place. Fields along a bar see the same few waves at very many
//! delays, so here they are solved once and asked at any time.

use crate::ball::{Ball, ComplexBall};
use crate::enclosure::{Numbers, real_part};
use crate::evaluate::closed::ClosedForm;
use crate::evaluate::closed::scene::whole_periods;
use crate::evaluate::error::EvaluateError;
use crate::evaluate::signal::Limit;
use crate::evaluate::transforms::value_at;
use crate::expression::{Expression, Field as _, Fraction, Root};
use crate::limits::MAX_PIECES;
use crate::network::Network;
use crate::recurrence::{Observation, ObservedWave, WaveIndex};
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// Some waves of a scene without symbols, up to a last time.
///
/// # Invariants
/// - where there are several periods, `echoes` ascends by delay.
pub(crate) struct Waves {
    /// Sees all of the waves at once.
    signal: ClosedForm,
    places: Vec<WaveIndex>,
    period: Fraction,
    /// On a lattice: delays and numbers of echoes.
    echoes: Option<(Vec<Fraction>, Vec<usize>)>,
}

impl Waves {
    /// These waves for times up to `last` of the user's.
    pub(crate) fn new(
        network: &Network,
        waves: &[WaveIndex],
        last: &Rational,
    ) -> Result<Waves, EvaluateError> {
        let seen = |wave: &WaveIndex| ObservedWave {
            coefficient: Expression::one(),
            wave: *wave,
            slope: false,
            delay: Fraction::zero(),
        };
        let observation =
            Observation { waves: waves.iter().map(seen).collect(), forcing: Expression::zero() };
        let unit = Root::from(Fraction::one());
        let signal = ClosedForm::of_scene(network, &observation, unit, last)?;
        let period = signal.recurrence().statement().period.clone();
        let echoes = match signal.scattered() {
            None => None,
            Some(arrivals) => Some(in_order(signal.numbers(), arrivals)?),
        };
        Ok(Waves { signal, places: waves.to_vec(), period, echoes })
    }

    /// The numbers of the constants.
    fn numbers(&self) -> &Numbers {
        self.signal.numbers()
    }

    /// A derivative of a wave at a time of its own clock; zero before it begins.
    ///
    /// # Panics
    /// Where the wave is none of those asked for at first.
    pub(crate) fn enclose(
        &self,
        wave: WaveIndex,
        derivative: usize,
        at: &Fraction,
        side: Limit,
        bits: u64,
    ) -> Result<Ball, EvaluateError> {
        let seen = self.places.iter().position(|known| *known == wave).expect("a wave asked for");
        let field = self.numbers().field(bits);
        let mut sum = ComplexBall::zero();
        let mut add = |number: usize, since: &Fraction| -> Result<(), EvaluateError> {
            let function = self.signal.piece(seen, number, bits)?;
            if function.is_zero() {
                return Ok(());
            }
            let x = field.embed(&since.clone().into())?;
            let value = match derivative {
                0 => value_at(&function, &x, self.numbers(), bits)?,
                times => {
                    let mut slope = function.differentiated(&field)?;
                    for _ in 1..times {
                        slope = slope.differentiated(&field)?;
                    }
                    value_at(&slope, &x, self.numbers(), bits)?
                }
            };
            sum = sum.add(&value, bits);
            Ok(())
        };
        match &self.echoes {
            None => {
                if let Some(number) = self.period_at(at, side)? {
                    add(number, &(at - &self.start(number)))?;
                }
            }
            Some((delays, numbers)) => {
                for i in 0..self.arrived(delays, at, side)? {
                    add(numbers[i], &(at - &delays[i]))?;
                }
            }
        }
        Ok(real_part(sum)?)
    }

    /// The times from `from` to `to`, both included, by the clock of the waves, at which something
    /// arrives.
    pub(crate) fn breaks(
        &self,
        from: &Fraction,
        to: &Fraction,
    ) -> Result<Vec<Fraction>, EvaluateError> {
        match &self.echoes {
            None => {
                let Some(last) = self.period_at(to, Limit::Right)? else { return Ok(Vec::new()) };
                let before = self.period_at(from, Limit::Left)?;
                Ok((before.map_or(0, |n| n + 1)..=last).map(|n| self.start(n)).collect())
            }
            Some((delays, _)) => {
                let first = self.arrived(delays, from, Limit::Left)?;
                let last = self.arrived(delays, to, Limit::Right)?;
                let mut breaks = delays[first.min(last)..last].to_vec();
                breaks.dedup();
                Ok(breaks)
            }
        }
    }

    fn start(&self, number: usize) -> Fraction {
        self.period.scale(&Rational::from_integer(number.into()))
    }

    /// The period that a time lies in; before the start, none.
    fn period_at(&self, at: &Fraction, side: Limit) -> Result<Option<usize>, EvaluateError> {
        let most = whole_periods(self.numbers(), at, &self.period, MAX_PIECES)?;
        for number in (0..=most).rev() {
            let order = self.numbers().compare(&self.start(number), at)?;
            if order == Ordering::Less || (order == Ordering::Equal && side == Limit::Right) {
                return Ok(Some(number));
            }
        }
        Ok(None)
    }

    /// How many echoes have arrived.
    fn arrived(
        &self,
        delays: &[Fraction],
        at: &Fraction,
        side: Limit,
    ) -> Result<usize, EvaluateError> {
        let (mut low, mut high) = (0, delays.len());
        while low < high {
            let middle = low.midpoint(high);
            let order = self.numbers().compare(&delays[middle], at)?;
            match order == Ordering::Less || (order == Ordering::Equal && side == Limit::Right) {
                true => low = middle + 1,
                false => high = middle,
            }
        }
        Ok(low)
    }
}

/// Delays ascending, each with the number of its echo.
fn in_order(
    numbers: &Numbers,
    arrivals: &[(usize, Fraction)],
) -> Result<(Vec<Fraction>, Vec<usize>), EvaluateError> {
    let mut sorted = arrivals.to_vec();
    let mut failed = None;
    sorted.sort_by(|left, right| {
        numbers.compare(&left.1, &right.1).unwrap_or_else(|error| {
            failed = Some(error);
            Ordering::Equal
        })
    });
    match failed {
        Some(error) => Err(error.into()),
        None => Ok(sorted.into_iter().map(|(number, delay)| (delay, number)).unzip()),
    }
}
