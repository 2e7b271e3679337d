//! Observables as pieces, where their waves arrive together.

use crate::expression::{Expression, Fraction};
use crate::recurrence::{
    LinearForm, Observable, Observation, Recurrence, Statement, WaveIndex, right_of,
};
use crate::solution::error::SolveError;
use crate::solution::solved::Solution;
use num_traits::ToPrimitive;
use std::collections::BTreeMap;
use wavestep_polynomial::Rational;

/// An observable on periods of its own, which begin at an offset from those of the waves:
///
/// ```text
/// q(offset + nD + s) = pieces[n − first](s),      0 ≤ s < D
/// ```
///
/// It is zero before the offset.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ObservedPieces {
    pub offset: Fraction,
    /// The pieces, in the local variable.
    pub pieces: Vec<Expression>,
}

/// An observable between two of its arrivals: `q(from + s) = value(s)`, `0 ≤ s < to − from`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ObservedStretch {
    pub from: Fraction,
    pub to: Fraction,
    pub value: Expression,
}

/// Why an observable has no pieces.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum ObserveError {
    /// Its waves do not arrive together, so that no period suits all of them.
    #[error("its waves arrive at different times, so it has no common periods")]
    MixedOffsets,
    /// A piece cannot be given exactly.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// How many periods a delay is, where that is a whole number.
fn whole_periods(delay: &Fraction, period: &Fraction) -> Option<i64> {
    if delay.is_zero() {
        return Some(0);
    }
    let ratio = Expression::from(delay.clone()).proportion(&period.clone().into())?;
    ratio.to_integer().to_i64().filter(|_| ratio.is_integer())
}

/// A common offset, less than a period where that is decided, and the lag of each delay in
/// periods from it. A lag is negative for a wave that is seen before its own clock says.
fn common_offset(delays: &[&Fraction], period: &Fraction) -> Option<(Fraction, Vec<i64>)> {
    let Some(first) = delays.first() else { return Some((Fraction::zero(), Vec::new())) };
    let lags = delays.iter().map(|delay| whole_periods(&(*delay - first), period));
    let lags: Vec<i64> = lags.collect::<Option<_>>()?;
    let earliest = lags.iter().copied().min().unwrap_or(0);
    let mut offset = *first + &period.scale(&Rational::from_integer(earliest.into()));
    let ratio = Expression::from(offset.clone()).proportion(&period.clone().into());
    let before = ratio.and_then(|ratio| ratio.floor().to_integer().to_i64()).unwrap_or(0);
    offset = &offset - &period.scale(&Rational::from_integer(before.into()));
    Some((offset, lags.iter().map(|lag| lag - earliest + before).collect()))
}

impl Solution {
    /// When the first period of an observable begins: the common offset of its waves from the
    /// periods of the recurrence; `None` where they do not arrive together.
    pub fn offset(&self, observation: &Observation) -> Option<Fraction> {
        Some(self.offset_and_lags(observation)?.0)
    }

    fn offset_and_lags(&self, observation: &Observation) -> Option<(Fraction, Vec<i64>)> {
        let delays: Vec<&Fraction> = observation.waves.iter().map(|term| &term.delay).collect();
        let common = common_offset(&delays, &self.recurrence().statement().period);
        common.filter(|(offset, _)| observation.forcing.is_zero() || offset.is_zero())
    }

    /// The solution with an observable as one more wave, the last that is stated, and when its first period begins.
    /// `None` where the waves of the observable do not arrive together.
    pub fn with_observable(&self, observable: &Observable) -> Option<(Solution, Fraction)> {
        let Observable { name, observation } = observable;
        let (offset, lags) = self.offset_and_lags(observation)?;
        let mut statement = self.recurrence().statement().clone();
        let own = statement.waves.len();
        let mut equation = -&LinearForm::wave(own, 0);
        equation.add_scaled(
            &LinearForm::forcing(observation.forcing.clone()),
            &Expression::one(),
            0,
        );
        for (seen, lag) in observation.waves.iter().zip(lags) {
            let wave = match usize::try_from(lag) {
                Ok(lag) if seen.slope => LinearForm::slope(seen.wave, lag),
                Ok(lag) => LinearForm::wave(seen.wave, lag),
                Err(_) if seen.slope => return None,
                // What it is made of has set out before.
                Err(_) => self.made_of(seen.wave)?.earlier(lag.unsigned_abs() as usize)?,
            };
            equation.add_scaled(&wave, &seen.coefficient, 0);
        }
        statement.waves.push(name.clone());
        statement.equations.push(equation);
        let unit = statement.notation.observables.get(name).cloned();
        statement.notation.units.extend(unit.map(|unit| (own, unit)));
        Some((Solution::new(Recurrence::new(statement).ok()?), offset))
    }

    /// The other waves that make up one without a differential equation.
    fn made_of(&self, wave: WaveIndex) -> Option<LinearForm> {
        let mut steps = self.recurrence().steps().iter();
        let step = steps.find(|step| step.wave == wave && step.start.is_none())?;
        Some(right_of(step, &step.equation))
    }

    /// What is added to the waves, from a scene time on.
    fn forcing_from(&self, observation: &Observation, start: &Fraction) -> Expression {
        let Statement { local, time, .. } = self.recurrence().statement();
        let forcing = observation.forcing.substitute(time, &(&Fraction::symbol(local) + start));
        forcing.expect("forcing has no time in denominators")
    }

    /// An observable whose waves arrive apart, between its arrivals on the periods `first … last` of
    /// the waves.
    pub fn observed_between_arrivals(
        &self,
        observation: &Observation,
        first: usize,
        last: usize,
    ) -> Result<Vec<ObservedStretch>, ObserveError> {
        let statement = self.recurrence().statement();
        let period = &statement.period;
        let share = |delay: &Fraction| -> Result<Rational, ObserveError> {
            match delay.is_zero() {
                true => Ok(Rational::default()),
                false => Expression::from(delay.clone())
                    .proportion(&period.clone().into())
                    .ok_or(ObserveError::MixedOffsets),
            }
        };
        let shares = observation.waves.iter().map(|seen| share(&seen.delay));
        let shares: Vec<Rational> = shares.collect::<Result<_, _>>()?;
        let mut offsets: Vec<Rational> = shares.iter().map(|share| share - share.floor()).collect();
        if !observation.forcing.is_zero() {
            offsets.push(Rational::default());
        }
        offsets.sort();
        offsets.dedup();
        // The piece of a wave that is seen on a stretch.
        let order = |n: usize, offset: &Rational, share: &Rational| {
            let since = (Rational::from_integer(n.into()) + offset - share).floor();
            since.to_integer().to_i64().and_then(|order| usize::try_from(order).ok())
        };
        let mut orders = BTreeMap::<WaveIndex, [usize; 2]>::new();
        for (seen, share) in observation.waves.iter().zip(&shares) {
            let ends = [(first, offsets.first()), (last, offsets.last())];
            let [from, to] = ends.map(|(n, offset)| order(n, offset?, share));
            let Some(to) = to else { continue };
            let [least, most] = orders.entry(seen.wave).or_insert([to, to]);
            (*least, *most) = ((*least).min(from.unwrap_or(0)), (*most).max(to));
        }
        let mut known = BTreeMap::new();
        for (wave, [from, to]) in orders {
            known.insert(wave, (from, self.pieces(wave, from, to)?));
        }
        let mut stretches = Vec::new();
        for n in first..=last {
            for (j, offset) in offsets.iter().enumerate() {
                let n_and_offset = Rational::from_integer(n.into()) + offset;
                let next = match offsets.get(j + 1) {
                    Some(next) => Rational::from_integer(n.into()) + next,
                    None => Rational::from_integer((n + 1).into()) + &offsets[0],
                };
                let from = period.scale(&n_and_offset);
                let mut value = Expression::zero();
                for (seen, share) in observation.waves.iter().zip(&shares) {
                    let Some(order) = order(n, offset, share) else { continue };
                    let since = &n_and_offset - share;
                    let later = period.scale(&(&since - since.floor()));
                    let (from, pieces) = &known[&seen.wave];
                    let piece = &pieces[order - from];
                    let slope = seen.slope.then(|| piece.derivative(&statement.local));
                    let moved = slope.as_ref().unwrap_or(piece).shift(&statement.local, &later);
                    let moved = moved.map_err(|_| ObserveError::MixedOffsets)?;
                    value.add_scaled(&moved, &seen.coefficient);
                }
                value += &self.forcing_from(observation, &from);
                stretches.push(ObservedStretch { from, to: period.scale(&next), value });
            }
        }
        Ok(stretches)
    }

    /// The pieces `first … last` of an observable.
    pub fn observed(
        &self,
        observation: &Observation,
        first: usize,
        last: usize,
    ) -> Result<ObservedPieces, ObserveError> {
        let statement = self.recurrence().statement();
        let Some((offset, lags)) = self.offset_and_lags(observation) else {
            return Err(ObserveError::MixedOffsets);
        };
        let forced = !observation.forcing.is_zero();
        let mut pieces = vec![Expression::zero(); (last + 1).saturating_sub(first)];
        for (seen, lag) in observation.waves.iter().zip(lags) {
            let of_wave = |n: usize| usize::try_from(n as i64 - lag).ok();
            let Some(through) = of_wave(last) else { continue };
            if let Some(early) = of_wave(0).and_then(|n| n.checked_sub(1)) {
                // Before its first period the wave is zero.
                let before = self.pieces(seen.wave, 0, early)?;
                if before.iter().any(|piece| !piece.is_zero()) {
                    return Err(ObserveError::MixedOffsets);
                }
            }
            let start = of_wave(first).unwrap_or(0);
            let waves = self.pieces(seen.wave, start, through)?;
            let begins = (start as i64 + lag) as usize;
            for (n, mut piece) in (begins..).zip(waves) {
                if seen.slope {
                    piece = piece.derivative(&statement.local);
                }
                pieces[n - first].add_scaled(&piece, &seen.coefficient);
            }
        }
        for (n, piece) in (first..).zip(&mut pieces).filter(|_| forced) {
            let arrival = statement.period.scale(&Rational::from_integer(n.into()));
            *piece += &self.forcing_from(observation, &arrival);
        }
        Ok(ObservedPieces { offset, pieces })
    }
}
