//! Observables as weighted sums of echoes in doubles, whose closed form has one pole.

use super::MethodError;
use super::clock::Clock;
use super::doubles::{three, three_of};
use crate::ball::rational;
use crate::enclosure::Numbers;
use crate::expression::{Expression, Fraction, Transform};
use crate::limits::MAX_SUMMED_ECHOES;
use crate::signal::signal::{Limit, Signal};
use crate::signal::taps::{NoTaps, closed_form};
use crate::solution::{EchoTemplate, Family, Solution};
use std::cmp::Ordering;
use wavestep_kernels::double_double::{DoubleDouble, two_sum};
use wavestep_kernels::echoes::{self, EchoSum, Echoes, Expansion, ExponentialPolynomial, Term};
use wavestep_polynomial::{Rational, Symbol};

/// One wave that is seen.
struct Seen {
    weight: DoubleDouble,
    delay: [f64; 2],
    exact_delay: Fraction,
    sum: EchoSum,
}

/// When echoes arrive, exactly and in doubles.
///
/// Delays in doubles are off by some `2^−100` of themselves, so that they cannot tell on which side of
/// an arrival a time lies that falls on it: a whole front would be lost. Times so near are ordered
/// exactly, and moved to their side.
struct Arrivals {
    clock: Clock,
    period: [f64; 3],
    /// Whether the period is a double: then doubles tell on which side of an arrival another one lies.
    is_double: bool,
}

impl Arrivals {
    fn new(clock: Clock) -> Result<Arrivals, MethodError> {
        let period = three(&clock.numbers, &clock.period)?;
        let is_double = clock.period.as_constant() == Some(rational(period[0]));
        Ok(Arrivals { clock, period, is_double })
    }

    /// How near to an arrival times are ordered exactly, and how far from it they are kept, as parts
    /// of the time: more than what delays in doubles are off, and nothing to the value.
    const NEAR: f64 = 1.0 / (1_u64 << 60) as f64 / (1_u64 << 26) as f64;
    const KEPT: f64 = Self::NEAR / 256.0;

    /// From how far on the distance from the next arrival, in doubles, tells that a time is not near: its
    /// roundings are below `2^−50` of the time, and a window holds too few echoes for the number of the
    /// arrival to be rounded.
    const FAR: f64 = 1.0 / (1_u64 << 40) as f64;

    /// Whether doubles alone tell that a time since a delay is far from all arrivals. Only
    /// operations that run side by side.
    #[inline]
    fn is_far(&self, since: f64, size: f64) -> bool {
        /// A number below `2^51` added to `1.5·2^52` is rounded to an integer.
        const ROUNDER: f64 = 6_755_399_441_055_744.0;
        let period = self.period[0];
        let number = (since / period + ROUNDER) - ROUNDER;
        (since - number * period).abs() > Self::FAR * (size + period)
    }

    /// The number of the arrival that a time since a delay is so near to, and the distance from it;
    /// the time is the sum of two doubles, off by some parts of `size`.
    fn near(&self, (high, low): (f64, f64), size: f64) -> Option<(f64, f64)> {
        if self.is_far(high, size) {
            return None;
        }
        let [period, rest, _] = self.period;
        let number = (high / period).round();
        let product = number * period;
        let error = number.mul_add(period, -product) + number * rest;
        let distance = (high - product) + (low - error);
        (number >= 0.0 && distance.abs() <= Self::NEAR * (size + period))
            .then_some((number, distance))
    }

    /// A time since a delay, moved to its side of an arrival that it falls on.
    fn sided(
        &self,
        since: (f64, f64),
        size: f64,
        delay: &Fraction,
        (at, side): (&dyn Fn() -> Rational, Limit),
    ) -> Result<(f64, f64), MethodError> {
        let Some((number, distance)) = self.near(since, size) else { return Ok(since) };
        let count = Rational::from_integer((number as u64).into());
        let Clock { numbers, slowness, period } = &self.clock;
        let arrival = delay + &period.scale(&count);
        let after = match numbers.compare(&slowness.scale(&at()), &arrival)? {
            Ordering::Greater => true,
            Ordering::Less => false,
            Ordering::Equal => side == Limit::Right,
        };
        let kept = Self::KEPT * (size + self.period[0]);
        let wanted = if after { distance.max(kept) } else { distance.min(-kept) };
        Ok((since.0, since.1 + (wanted - distance)))
    }
}

/// An observable by its echoes.
pub(super) struct EchoSums {
    seen: Vec<Seen>,
    arrivals: Arrivals,
    /// What is added from the start, as sums of polynomials times exponentials.
    added: Vec<ExponentialPolynomial>,
    unit: DoubleDouble,
    slowness: [f64; 2],
    from: f64,
    to: f64,
}

impl EchoSums {
    /// The echoes of a signal up to the end of its window.
    pub(super) fn new(signal: &dyn Signal) -> Result<EchoSums, MethodError> {
        let ([from, to], signal) = (signal.window(), signal.closed_form()?);
        if !signal.is_on_grid() {
            return Err(NoTaps::NoGrid.into());
        }
        let order = signal.periods(to)?;
        if order > MAX_SUMMED_ECHOES {
            return Err(MethodError::TooManyPeriods { periods: order, limit: MAX_SUMMED_ECHOES });
        }
        let clock = Clock::of(signal);
        let numbers = &clock.numbers;
        let solution = Solution::new(signal.recurrence.clone());
        let recurrence = solution.recurrence();
        let statement = recurrence.statement();
        let mut seen = Vec::new();
        for wave in &signal.observation.waves {
            let template = closed_form(&solution, wave)?;
            let echoes = in_doubles(template, &statement.period, &statement.local, numbers)?;
            let weight = wave.coefficient.as_fraction().ok_or(NoTaps::Forcing)?;
            let [high, low, _] = three(numbers, &wave.delay)?;
            seen.push(Seen {
                weight: pair(three(numbers, &weight)?)?,
                delay: [high, low],
                exact_delay: wave.delay.clone(),
                sum: EchoSum::new(echoes, order.max(1))?,
            });
        }
        let forcing = &signal.observation.forcing;
        let added = exponential_polynomials(forcing, &statement.time, numbers)?;
        let unit = numbers.enclose_root(&signal.unit, 128)?;
        let [high, low, _] = three(numbers, &signal.slowness)?;
        let end = |value: &Rational| crate::ball::Ball::from_rational(value, 128).to_double().0;
        let (unit, slowness) = (pair(three_of(unit))?, [high, low]);
        let arrivals = Arrivals::new(clock)?;
        let (from, to) = (end(from), end(to));
        Ok(EchoSums { seen, arrivals, added, unit, slowness, from, to })
    }

    /// The value at a time as the sum of two doubles; exactly it is `at`.
    pub(super) fn value(
        &self,
        method: echoes::Method,
        (high, low): (f64, f64),
        at: &dyn Fn() -> Rational,
        side: Limit,
    ) -> Result<f64, MethodError> {
        if !(high >= self.from && high <= self.to) {
            return Err(MethodError::Outside);
        }
        // (high + low)(slowness): the rounding of the product by a fused multiplication.
        let [rate, rest] = self.slowness;
        let time = high * rate;
        let low = high.mul_add(rate, -time) + (high * rest + low * rate);
        // Waves can cancel: their sum is rounded once.
        let mut sum = DoubleDouble::default();
        for Seen { weight, delay, exact_delay, sum: echoes } in &self.seen {
            let (since, error) = two_sum(time, -delay[0]);
            let since = (since, error + (low - delay[1]));
            let (since, rest) = self.arrivals.sided(since, time.abs(), exact_delay, (at, side))?;
            let since = pair([since, rest, 0.0])?;
            if since.high() < 0.0 || (since.high() == 0.0 && since.low() < 0.0) {
                continue;
            }
            sum = sum + *weight * echoes.pair(method, since, side)?;
        }
        if time > 0.0 || (time == 0.0 && side == Limit::Right) {
            for part in &self.added {
                let horner = |value: f64, c: &Expansion| value * time + c.parts()[0];
                let polynomial = part.coefficients.iter().rev().fold(0.0, horner);
                sum = sum + DoubleDouble::from(polynomial * (-part.rate.parts()[0] * time).exp());
            }
        }
        Ok((sum * self.unit).high())
    }

    /// Many values by the blocked sum of differences, where waves have no delay and run on the user's
    /// time; else `None`.
    pub(super) fn fill(&self, at: &[f64], values: &mut [f64]) -> Option<Result<(), MethodError>> {
        // A delay that does not subtract without error would cost digits behind fronts.
        let plain = self.seen.iter().all(|seen| seen.delay == [0.0, 0.0]);
        let plain = plain && self.slowness == [1.0, 0.0] && self.added.is_empty();
        plain.then(|| self.fill_plain(at, values))
    }

    fn fill_plain(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError> {
        let inside = |&time: &f64| (time >= self.from) & (time <= self.to);
        if !at.iter().fold(true, |all, time| all & inside(time)) {
            return Err(MethodError::Outside);
        }
        let Some((first, others)) = self.seen.split_first() else {
            values.fill(0.0);
            return Ok(());
        };
        first.sum.fill(at, Limit::Right, values)?;
        let weight = (first.weight * self.unit).high();
        if weight != 1.0 {
            values.iter_mut().for_each(|value| *value *= weight);
        }
        let mut part = if others.is_empty() { Vec::new() } else { vec![0.0; at.len()] };
        for seen in others {
            seen.sum.fill(at, Limit::Right, &mut part)?;
            let weight = (seen.weight * self.unit).high();
            values.iter_mut().zip(&part).for_each(|(value, part)| *value += weight * part);
        }
        if self.arrivals.is_double {
            return Ok(());
        }
        for (times, values) in at.chunks(64).zip(values.chunks_mut(64)) {
            if times.iter().fold(true, |all, time| all & self.arrivals.is_far(*time, time.abs())) {
                continue;
            }
            for (time, value) in times.iter().zip(values) {
                if self.arrivals.near((*time, 0.0), time.abs()).is_some() {
                    let exact = || rational(*time);
                    let method = echoes::Method::Scaled;
                    *value = self.value(method, (*time, 0.0), &exact, Limit::Right)?;
                }
            }
        }
        Ok(())
    }
}

/// The two leading ones of three doubles.
fn pair([high, low, _]: [f64; 3]) -> Result<DoubleDouble, MethodError> {
    DoubleDouble::from_sum(high, low).ok_or(MethodError::Echoes(echoes::EchoError::NotFinite))
}

fn expansion(numbers: &Numbers, value: &Fraction) -> Result<Expansion, MethodError> {
    let parts = three(numbers, value)?;
    Ok(Expansion::new(parts)?)
}

/// Echoes in closed form with their constants in doubles.
fn in_doubles(
    template: &EchoTemplate,
    period: &Fraction,
    local: &Symbol,
    numbers: &Numbers,
) -> Result<Echoes, MethodError> {
    let number = |value: &Fraction| expansion(numbers, value);
    let (family, scale) = match &template.family {
        Family::Laguerre(scale) => (echoes::Family::Laguerre, number(scale)?),
        Family::Power => (echoes::Family::Powers, Expansion::ONE),
    };
    let mut terms = Vec::new();
    for (lag, coefficient) in &template.terms {
        terms.push(Term { lag: *lag, coefficient: number(coefficient)? });
    }
    let (rate, ratio) = (number(&template.rate)?, number(&template.ratio)?);
    let echoes = Echoes::new(family, rate, scale, ratio, &terms, number(period)?)?;
    let first = template.first.iter();
    let first = first.map(|echo| exponential_polynomials(echo, local, numbers));
    Ok(echoes.with_first(first.collect::<Result<_, _>>()?)?)
}

/// An expression in `x` by the rates of its exponentials.
fn exponential_polynomials(
    function: &Expression,
    x: &Symbol,
    numbers: &Numbers,
) -> Result<Vec<ExponentialPolynomial>, MethodError> {
    let mut parts = Vec::new();
    for (pole, coefficients) in Transform::of(function, x).poles() {
        let mut row = Vec::new();
        let mut factorial = Rational::from_integer(1.into());
        for (j, coefficient) in coefficients.iter().enumerate() {
            if j > 0 {
                factorial *= Rational::from_integer(j.into());
            }
            let value = coefficient.as_fraction().ok_or(NoTaps::Forcing)?;
            row.push(expansion(numbers, &value.scale(&factorial.recip()))?);
        }
        parts.push(ExponentialPolynomial { rate: expansion(numbers, &-pole)?, coefficients: row });
    }
    Ok(parts)
}
