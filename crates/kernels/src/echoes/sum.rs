//! A wave, ready to be summed: delays, powers of the ratio and reciprocals are formed once.

use super::LARGEST_ECHO;
use super::delay::{Delays, counts};
use super::description::Echoes;
use super::error::EchoError;
use super::exponential::exponential;
use super::{naive, stable};
use crate::Limit;
use crate::double_double::DoubleDouble;
use crate::exponent::scale;

/// The largest `|b|x` and `|c|x`.
const LARGEST_ARGUMENT: f64 = (1u64 << 40) as f64;

/// How echoes are summed; the module's table says what each loses.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Method {
    /// Powers expanded, Horner's scheme, rounded delays: the formula as printed.
    Expanded,
    /// The recurrence of three terms, rounded delays.
    Plain,
    /// The recurrence of differences, delays without error and powers of two carried apart: right for
    /// every echo.
    Scaled,
    /// The same in pairs of doubles, rounded at the end.
    DoubleDouble,
}

impl Method {
    /// All methods, the worst first.
    pub const ALL: [Method; 4] =
        [Method::Expanded, Method::Plain, Method::Scaled, Method::DoubleDouble];
}

/// A wave made of the echoes `0 … last`, ready to be summed at times before echo `last + 1` arrives.
///
/// # Invariants
/// - the tables reach as far as the echoes ask for.
#[derive(Clone, PartialEq, Debug)]
pub struct EchoSum {
    pub(super) echoes: Echoes,
    /// `kD` to `k = last + 1`.
    pub(super) delays: Delays,
    /// `ρ^k`.
    ratios: Vec<(DoubleDouble, i64)>,
    /// `1/(j+1)`.
    pub(super) reciprocals: Vec<f64>,
    reciprocal_pairs: Vec<DoubleDouble>,
    /// `ρ^k`, rounded.
    pub(super) ratio_powers: Vec<f64>,
    /// `e^{−bmD}`, rounded.
    pub(super) decays: Vec<f64>,
    /// `cmD`, as pairs.
    pub(super) arguments: Vec<DoubleDouble>,
}

impl EchoSum {
    /// Tables for the echoes `0 … last`; cost and storage grow like `last`.
    pub fn new(echoes: Echoes, last: usize) -> Result<EchoSum, EchoError> {
        if last > LARGEST_ECHO {
            return Err(EchoError::TooManyEchoes { last });
        }
        let delays = Delays::new(echoes.period, last + 1);
        let ratios = echoes.ratios(last);
        let steps = echoes.largest_index(last).unwrap_or(0);
        let divisors = || (1..=steps).map(|divisor| divisor as f64);
        let delay = |m: usize| {
            let [high, low, _] = delays.of(m);
            DoubleDouble { high, low }
        };
        let argument = |m: usize| delay(m) * echoes.scale.pair();
        let decay = |m: usize| {
            let product = delay(m) * echoes.rate.pair();
            if product.high.abs() > LARGEST_ARGUMENT {
                return 0.0;
            }
            let (mantissa, exponent) = exponential(-product);
            scale(mantissa.high, exponent)
        };
        Ok(EchoSum {
            arguments: (0..=last).map(argument).collect(),
            decays: (0..=last).map(decay).collect(),
            reciprocals: divisors().map(f64::recip).collect(),
            reciprocal_pairs: divisors().map(|divisor| DoubleDouble::ONE.over(divisor)).collect(),
            ratio_powers: ratios.iter().map(|power| scale(power.0.high, power.1)).collect(),
            ratios,
            delays,
            echoes,
        })
    }

    /// The last echo that the sum holds.
    pub(super) fn last(&self) -> usize {
        self.delays.last() - 1
    }

    /// `f(T)` by one method, the echoes of late arrival last, not rounded by [`Method::DoubleDouble`]: for sums of waves
    /// that cancel. Before the first arrival it is 0. An echo that arrives at this very time counts in the limit from the
    /// right. [`Method::Expanded`] and [`Method::Plain`] decide that, as all else, from the rounded delay.
    pub fn pair(
        &self,
        method: Method,
        time: DoubleDouble,
        limit: Limit,
    ) -> Result<DoubleDouble, EchoError> {
        self.admit(time, limit)?;
        let rounded = matches!(method, Method::Expanded | Method::Plain);
        let mut sum = DoubleDouble::ZERO;
        for k in 0..=self.last() {
            let since = match rounded {
                true => DoubleDouble::from(time.high - k as f64 * self.echoes.period.high()),
                false => self.delays.since(k, time),
            };
            if !counts(since.high, limit) {
                break;
            }
            let echo = self.echo(method, k, since);
            sum = match method {
                Method::DoubleDouble => sum + echo,
                _ => DoubleDouble::from(sum.high + echo.high),
            };
        }
        Ok(sum)
    }

    /// Echo `k`, so long after it arrived.
    fn echo(&self, method: Method, k: usize, since: DoubleDouble) -> DoubleDouble {
        let echoes = &self.echoes;
        if let Some(parts) = echoes.first.get(k) {
            return match method {
                Method::DoubleDouble => stable::first(parts, since),
                _ => DoubleDouble::from(stable::first_rounded(parts, since)),
            };
        }
        match method {
            Method::Expanded => DoubleDouble::from(naive::expanded(echoes, k, since.high)),
            Method::Plain => DoubleDouble::from(naive::plain(echoes, k, since.high)),
            Method::Scaled => DoubleDouble::from(self.scaled_echo(k, since)),
            Method::DoubleDouble => {
                stable::echo(echoes, self.ratios[k], &self.reciprocal_pairs, k, since)
            }
        }
    }

    /// Echo `k` by the scaled summation.
    pub(super) fn scaled_echo(&self, k: usize, since: DoubleDouble) -> f64 {
        stable::echo(&self.echoes, self.ratios[k], &self.reciprocals, k, since)
    }

    /// Refuses times that are not finite, too late for the rates, or after the arrival of echo
    /// `last + 1`.
    pub(super) fn admit(&self, time: DoubleDouble, limit: Limit) -> Result<(), EchoError> {
        if !time.high.is_finite() {
            return Err(EchoError::NotFinite);
        }
        if time.high * self.echoes.fastest() > LARGEST_ARGUMENT {
            return Err(EchoError::TimeTooLarge);
        }
        match self.delays.has_arrived(self.delays.last(), time, limit) {
            true => Err(EchoError::BeyondLast { last: self.last() }),
            false => Ok(()),
        }
    }
}
