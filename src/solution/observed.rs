//! Observables as pieces: what is seen of waves that arrive together.

use crate::expression::{Expression, Fraction};
use crate::recurrence::Observation;
use crate::solution::error::SolveError;
use crate::solution::solved::Solution;
use num_traits::{Signed, ToPrimitive};
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
    /// When the first period begins.
    pub offset: Fraction,
    /// The pieces asked for, in the local variable.
    pub pieces: Vec<Expression>,
}

/// An observable of waves that do not arrive together, so that no period suits all of them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct MixedOffsets;

/// A delay as an offset and whole periods.
fn split(delay: &Fraction, period: &Fraction) -> (Fraction, usize) {
    let (delay_value, period_value) = (Expression::from(delay.clone()), period.clone().into());
    let periods = match delay_value.proportion(&period_value) {
        Some(ratio) if !ratio.is_negative() => ratio.floor().to_usize().unwrap_or(0),
        _ => 0,
    };
    let whole = period.scale(&Rational::from_integer(periods.into()));
    (delay - &whole, periods)
}

impl Solution {
    /// The pieces `first … last` of an observable; an error inside the first result where its
    /// waves do not arrive together.
    ///
    /// # Errors
    /// [`SolveError`] where a piece cannot be given exactly.
    ///
    /// # Cost
    /// That of the pieces of the waves, and a pass over them for each term.
    pub fn observed(
        &self,
        observation: &Observation,
        first: usize,
        last: usize,
    ) -> Result<Result<ObservedPieces, MixedOffsets>, SolveError> {
        let statement = self.recurrence().statement();
        let terms: Vec<_> = observation
            .terms
            .iter()
            .map(|(coefficient, wave, order, delay)| {
                let (offset, lag) = split(delay, &statement.period);
                (coefficient, *wave, *order, offset, lag)
            })
            .collect();
        let offset = terms.first().map_or_else(Fraction::zero, |term| term.3.clone());
        let forced = !observation.forcing.is_zero();
        if terms.iter().any(|term| term.3 != offset) || (forced && !offset.is_zero()) {
            return Ok(Err(MixedOffsets));
        }
        let mut pieces = vec![Expression::zero(); last + 1 - first];
        for (coefficient, wave, order, _, lag) in terms {
            if lag > last {
                continue;
            }
            let start = first.saturating_sub(lag);
            let waves = self.pieces(wave, start, last - lag)?;
            for (n, mut piece) in (start + lag..).zip(waves) {
                for _ in 0..order {
                    piece = piece.derivative(&statement.local);
                }
                pieces[n - first].add_scaled(&piece, coefficient);
            }
        }
        for (n, piece) in (first..).zip(&mut pieces).filter(|_| forced) {
            let arrival = statement.period.scale(&Rational::from_integer(n.into()));
            let time = &Fraction::symbol(&statement.local) + &arrival;
            let forcing = observation.forcing.substitute(&statement.time, &time);
            *piece += &forcing.expect("forcing has no time in denominators");
        }
        Ok(Ok(ObservedPieces { offset, pieces }))
    }
}
