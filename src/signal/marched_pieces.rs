//! Pieces of a signal from a march in fixed-point numbers.
//!
//! Where a signal is a sum of taps of one impulse response, and all its constants are rational numbers,
//! the march of [`wavestep_kernels::fixed`] gives Taylor polynomials of the response on equal pieces of
//! all periods, with one proven bound, in a fraction of the time that balls take.

use crate::ball::{Arithmetic as _, Ball, Binary, ComplexBall, Magnitude, at_or_after, rational};
use crate::enclosure::Numbers;
use crate::expression::{Field as _, Fraction, Transform};
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::signal::{Limit, Signal};
use crate::signal::taps::{Extra, Tap, Taps};
use crate::signal::taylor::Taylor;
use num_traits::{Signed as _, ToPrimitive as _};
use std::cell::OnceCell;
use wavestep_kernels::fixed::{self, DelayEquation, ExactTime, March, MarchOptions, Spans};
use wavestep_polynomial::{Rational, Symbol};

/// The bits below the point of the march.
const FRACTION_BITS: i64 = fixed::FRACTION_BITS as i64;

/// The most periods that are marched through: some hundred kilobytes each hundred.
const MAX_PERIODS: u32 = 4_000;

/// The most taps.
const MAX_TAPS: usize = 8;

/// A signal on a window, from a march. Times are the user's.
pub(crate) struct MarchedPieces {
    /// Made when pieces are first asked for.
    march: OnceCell<Option<March>>,
    periods: u32,
    equation: DelayEquation,
    period: Rational,
    /// The taps in the unit of the signal.
    taps: Vec<fixed::Tap>,
    /// Since when each is seen, if not always since its delay.
    since: Option<Vec<Rational>>,
    extras: Vec<Extra>,
    local: Symbol,
    /// What times are multiplied with to be in the scale of the waves, in which extras are.
    slowness: Rational,
    unit: Rational,
}

impl MarchedPieces {
    /// The pieces of a signal, where it has some.
    pub(crate) fn of(signal: &dyn Signal) -> Option<MarchedPieces> {
        let ([from, to], signal) = (signal.window(), signal.closed_form().ok()?);
        let slowness = signal.slowness.as_constant()?;
        let unit = signal.unit.exact()?.as_constant()?;
        if from.is_negative() {
            return None;
        }
        let Taps { rate, zero, ratio, period, taps, extras } = Taps::of(signal).ok()?;
        // In the user's time rates are larger by the slowness, and times shorter.
        let time = |value: &Fraction| Some(value.as_constant()? / &slowness);
        let period = time(&period)?;
        let (rate, zero) = (rate.as_constant()? * &slowness, zero.as_constant()? * &slowness);
        let equation = DelayEquation::new(&period, &rate, &zero, &ratio.as_constant()?).ok()?;
        let since: Vec<Rational> =
            taps.iter().map(|tap| time(&tap.since)).collect::<Option<_>>()?;
        let tap = |tap: &Tap| {
            let weight = tap.weight.as_constant()? * &unit;
            Some(fixed::Tap { weight, delay: time(&tap.delay)? })
        };
        let taps: Vec<fixed::Tap> = taps.iter().map(tap).collect::<Option<_>>()?;
        if taps.is_empty() || taps.len() > MAX_TAPS {
            return None;
        }
        let last = taps.iter().map(|tap| (to - &tap.delay) / &period).max()?;
        let periods = last.floor().to_integer().to_u32()?.checked_add(1)?;
        if periods > MAX_PERIODS {
            return None;
        }
        // What is added must be known by its numbers, too.
        let numbers = Numbers::new(&[]);
        let local = signal.recurrence.statement().local.clone();
        let is_known = |extra: &Extra| {
            let function = Transform::of(&extra.function, &local);
            let known = Transform::<ComplexBall>::embedded(&function, &numbers.field(64)).is_ok();
            known && extra.origin.as_constant().is_some()
        };
        if !extras.iter().all(is_known) {
            return None;
        }
        let at_once = taps.iter().zip(&since).all(|(tap, since)| tap.delay == *since);
        let (march, since) = (OnceCell::new(), (!at_once).then_some(since));
        Some(MarchedPieces {
            march,
            periods,
            equation,
            period,
            taps,
            since,
            extras,
            local,
            slowness,
            unit,
        })
    }

    /// Correctly rounded values, and the places of those that the bound does not decide; `None` where
    /// more than taps is added up.
    pub(crate) fn certified(
        &self,
        times: &[impl ExactTime],
        side: Limit,
    ) -> Option<(Vec<f64>, Vec<usize>)> {
        if !self.is_plain() {
            return None;
        }
        let found = fixed::certified(&self.equation, &self.taps, times, side).ok()?;
        Some((found.values, found.undecided))
    }

    /// Whether there are taps alone, each seen since its delay.
    fn is_plain(&self) -> bool {
        self.extras.is_empty() && self.since.is_none()
    }

    /// The march; `None` where it fails.
    fn march(&self) -> Option<&March> {
        let make = || March::new(&self.equation, self.periods, &MarchOptions::default()).ok();
        self.march.get_or_init(make).as_ref()
    }

    /// Whether the proven bound is good enough for polynomials with such an error.
    pub(crate) fn serves(&self, error: Magnitude) -> bool {
        self.march().is_some_and(|march| self.bound(march).scale(3) <= error)
    }

    fn bound(&self, march: &March) -> Magnitude {
        let weights = self.taps.iter().map(|tap| Magnitude::from_rational(&tap.weight));
        let sum = weights.fold(Magnitude::ZERO, |sum, weight| sum.add(&weight));
        sum.multiply(&Magnitude::from_double(march.bound()))
    }

    /// A range of doubles cut where pieces of the march meet.
    pub(crate) fn spans(&self, (first, last): (f64, f64)) -> Vec<(f64, f64)> {
        let Some(march) = self.march() else { return vec![(first, last)] };
        let pieces = Rational::from_integer(march.pieces_per_period().into());
        let length = &self.period / pieces;
        let (from, to) = (rational(first), rational(last));
        let mut starts = vec![first];
        for tap in &self.taps {
            let mut number =
                ((&from - &tap.delay) / &length).floor() + Rational::from_integer(1.into());
            loop {
                let joint = &tap.delay + &length * &number;
                if joint > to {
                    break;
                }
                starts.push(at_or_after(&joint));
                number += Rational::from_integer(1.into());
            }
        }
        starts.retain(|start| (first..=last).contains(start));
        starts.sort_by(f64::total_cmp);
        starts.dedup();
        let ends = starts.iter().skip(1).map(|start| start.next_down()).chain([last]);
        starts.iter().copied().zip(ends).collect()
    }

    /// All pieces of the period that a range of doubles lies in, summed over the taps, to be followed by
    /// polynomials of a degree. None where more than taps is added up, where pieces of different taps
    /// do not coincide, where the range lies in several periods, and where numbers are out of range.
    pub(crate) fn of_period(&self, (first, last): (f64, f64), degree: usize) -> Option<Spans> {
        let march = self.march()?;
        let period = &self.period;
        let number = (rational(first) / period).floor();
        if !self.is_plain() || (rational(last) / period).floor() != number {
            return None;
        }
        let mut rows = vec![Vec::new(); march.pieces_per_period() as usize];
        let mut radius = 0.0;
        for tap in &self.taps {
            let periods = &tap.delay / period;
            if !periods.is_integer() {
                return None;
            }
            let seen = (&number - periods).to_integer();
            if seen.is_negative() {
                continue;
            }
            let seen = seen.to_u32()?;
            let size = Magnitude::from_rational(&tap.weight);
            let bound = Magnitude::from_double(march.bound_of(seen)?);
            radius += size.multiply(&bound).to_double();
            for (piece, row) in (0..).zip(&mut rows) {
                let coefficients = march.piece(seen, piece)?;
                row.resize(row.len().max(coefficients.len()), 0);
                for (sum, coefficient) in row.iter_mut().zip(coefficients) {
                    *sum = i128::checked_add(*sum, weighted(*coefficient, &tap.weight)?)?;
                }
            }
        }
        // Each product with a weight is rounded by a unit at most, and sums of doubles by much less than is
        // added.
        let roundings = rows.iter().map(Vec::len).max()? * self.taps.len();
        let radius =
            (radius * 2_f64.powi(FRACTION_BITS as i32) * 1.000_001) as u128 + roundings as u128 + 1;
        let pieces = Rational::from_integer(march.pieces_per_period().into());
        Spans::new(&(number * period), &(period / pieces), rows, radius, degree)
    }

    /// The polynomial in `(t − middle)/half`, on a cell that lies in one span.
    pub(crate) fn taylor(
        &self,
        (middle, half): (&Rational, &Rational),
        bits: u64,
    ) -> Outcome<Taylor> {
        let march = self.march().ok_or(EvaluateError::AfterLast)?;
        let pieces = march.pieces_per_period();
        let doubled = Rational::from_integer((2 * pieces).into());
        let mut sum = Taylor::polynomial(Vec::new());
        for (i, tap) in self.taps.iter().enumerate() {
            let since = middle - &tap.delay;
            let unseen = self.since.as_ref().is_some_and(|since| *middle < since[i]);
            if since.is_negative() || unseen {
                continue;
            }
            let periods = &since / &self.period;
            let period = periods.floor();
            let x = &periods - &period;
            let piece = (&x * Rational::from_integer(pieces.into())).floor().to_integer();
            let piece = piece.to_u32().expect("a piece of a period");
            let period = period.to_integer().to_u32().expect("a period of the march");
            let Some(coefficients) = march.piece(period, piece) else {
                return Err(EvaluateError::AfterLast);
            };
            // u of the piece is 2Sx − (2q + 1).
            let a = &x * &doubled - Rational::from_integer((2 * i64::from(piece) + 1).into());
            let b = half * &doubled / &self.period;
            let ball = |value: &i128| {
                Ball::new(Binary::new((*value).into(), -FRACTION_BITS), Magnitude::ZERO)
            };
            let part = match march.part(period, piece, &a, &b) {
                Some((coefficients, radius)) => Taylor {
                    coefficients: coefficients.iter().map(ball).collect(),
                    remainder: Magnitude::from_integer(&radius.into(), -FRACTION_BITS),
                },
                // As large as the piece, or larger by a rounding.
                None => {
                    let coefficients = coefficients.iter().map(ball).collect();
                    let bound = march.bound_of(period).unwrap_or(f64::INFINITY);
                    let remainder = Magnitude::from_double(bound);
                    Taylor { coefficients, remainder }.part(&a, &b, bits)
                }
            };
            let weight = Ball::from_rational(&tap.weight, bits);
            sum = sum.add(&part.scaled(&weight, bits), bits);
        }
        let numbers = Numbers::new(&[]);
        let field = numbers.field(bits);
        let (middle, half) = (middle * &self.slowness, half * &self.slowness);
        for Extra { function, origin } in &self.extras {
            let since = &middle - origin.as_constant().unwrap_or_default();
            if since.is_negative() {
                continue;
            }
            let function =
                Transform::<ComplexBall>::embedded(&Transform::of(function, &self.local), &field)?;
            let x = field.embed(&Fraction::constant(&since).into())?;
            let h = field.embed(&Fraction::constant(&half).into())?;
            let terms = sum.coefficients.len().max(32);
            let part = Taylor::of(&function, &x, &h, terms, &numbers, bits)?.real()?;
            sum = sum.add(&part.scaled(&Ball::from_rational(&self.unit, bits), bits), bits);
        }
        if sum.coefficients.is_empty() {
            sum.coefficients.push(Ball::zero());
        }
        Ok(sum)
    }
}

/// `value · weight`, rounded downwards; none where it leaves the range.
fn weighted(value: i128, weight: &Rational) -> Option<i128> {
    if weight.is_integer() && weight.numer().abs() == 1.into() {
        return Some(if weight.is_negative() { -value } else { value });
    }
    (weight * Rational::from_integer(value.into())).floor().to_integer().to_i128()
}
