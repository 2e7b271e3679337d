//! A wave, ready to be summed: delays, powers of the ratio and reciprocals are formed once.

use super::blocked::Fill;
use super::delay::{Delays, Time};
use super::description::Echoes;
use super::error::EchoError;
use super::{LARGEST_ECHO, double_double, expanded, exponential, laguerre, scaled};
use crate::double_double::{DoubleDouble, two_sum};
use crate::exponent::scale;
use crate::lanes::{Lanes, WIDTH, Work, widest};

/// The largest `|b|x` and `|c|x`.
const LARGEST_ARGUMENT: f64 = (1u64 << 40) as f64;

/// How echoes are summed; the module's table says what each loses.
///
/// ```
/// use wavestep_kernels::echoes::Method;
/// assert_eq!(Method::ALL.len(), 5);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Method {
    /// Powers expanded, Horner's scheme, rounded delays: the formula as printed.
    Expanded,
    /// The recurrence of three terms, rounded delays.
    Plain,
    /// The recurrence of differences, delays without error. Right while `e^{−bx}` is a normal double
    /// and the polynomials are finite.
    Difference,
    /// The same with powers of two carried apart: right for every echo.
    Scaled,
    /// The same in pairs of doubles, rounded at the end.
    DoubleDouble,
}

impl Method {
    /// All methods, the worst first.
    pub const ALL: [Method; 5] =
        [Method::Expanded, Method::Plain, Method::Difference, Method::Scaled, Method::DoubleDouble];
}

/// A wave made of the echoes `0 … last`, ready to be summed at times before echo `last + 1` arrives.
///
/// # Invariants
/// - the tables reach as far as the echoes ask for.
///
/// ```
/// use wavestep_kernels::echoes::{EchoSum, Echoes, Expansion, Family, Method, Term, Time};
///
/// let [one, two] = [Expansion::ONE, Expansion::try_from(2.0)?];
/// let terms = [Term { lag: 0, coefficient: one }];
/// let wave = Echoes::new(Family::Laguerre, one, two, one, &terms, two)?;
/// let sum = EchoSum::new(wave, 200)?;
///
/// // Echo 1 arrives at 2: there the wave has a limit from the left and one from the right.
/// let right = sum.value(Method::Scaled, Time::from(2.0), true)?;
/// let left = sum.value(Method::Scaled, Time::from(2.0), false)?;
/// assert_eq!(left, (-2f64).exp());
/// assert_eq!(right, left + 1.0);
///
/// // Many times at once are summed in lanes.
/// let times = [0.5, 2.0, 399.0];
/// let mut values = [0.0; 3];
/// sum.fill(&times, true, &mut values)?;
/// assert!((values[1] - right).abs() < 1e-15);
/// assert!(sum.fill(&[402.5], true, &mut values[..1]).is_err());
/// # Ok::<(), wavestep_kernels::echoes::EchoError>(())
/// ```
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
    ///
    /// # Errors
    /// When `last` is beyond [`LARGEST_ECHO`].
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
            let (mantissa, exponent) = exponential::exponential(-product);
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
    pub fn last(&self) -> usize {
        self.delays.last() - 1
    }

    /// The wave that is summed.
    pub fn echoes(&self) -> &Echoes {
        &self.echoes
    }

    /// `f(T)` by one method, the echoes of late arrival last. Before the first arrival it is 0. An
    /// echo that arrives at this very time counts if `include_arriving`: that is the limit from the
    /// right, else that from the left. [`Method::Expanded`] and [`Method::Plain`] decide that, as all
    /// else, from the rounded delay.
    ///
    /// # Errors
    /// When the time is not finite, too late for the rates, or echo `last + 1` has arrived.
    pub fn value(
        &self,
        method: Method,
        time: Time,
        include_arriving: bool,
    ) -> Result<f64, EchoError> {
        self.pair(method, time, include_arriving).map(DoubleDouble::high)
    }

    /// The same, not rounded by [`Method::DoubleDouble`]: for sums of waves that cancel.
    ///
    /// ```
    /// use wavestep_kernels::echoes::{EchoSum, Echoes, Expansion, Family, Method, Term, Time};
    ///
    /// let [one, two] = [Expansion::ONE, Expansion::try_from(2.0)?];
    /// let terms = [Term { lag: 0, coefficient: one }];
    /// let sum = EchoSum::new(Echoes::new(Family::Laguerre, one, two, one, &terms, two)?, 3)?;
    /// let pair = sum.pair(Method::DoubleDouble, Time::from(1.0), true)?;
    /// // e^{−1}, and what the double of it lacks.
    /// assert_eq!(pair.high(), 0.36787944117144233);
    /// assert!((pair.low() + 1.2428753672788363e-17).abs() < 1e-31);
    /// # Ok::<(), wavestep_kernels::echoes::EchoError>(())
    /// ```
    ///
    /// # Errors
    /// As [`EchoSum::value`].
    pub fn pair(
        &self,
        method: Method,
        time: Time,
        include_arriving: bool,
    ) -> Result<DoubleDouble, EchoError> {
        self.admit(time, include_arriving)?;
        let rounded = matches!(method, Method::Expanded | Method::Plain);
        let mut sum = DoubleDouble::ZERO;
        for k in 0..=self.last() {
            let since = match rounded {
                true => DoubleDouble::from(time.high() - k as f64 * self.echoes.period.high()),
                false => self.delays.since(k, time),
            };
            if !super::delay::counts(since.high, include_arriving) {
                break;
            }
            let echo = self.echo_since(method, k, since, time);
            sum = match method {
                Method::DoubleDouble => sum + echo,
                _ => DoubleDouble::from(sum.high + echo.high),
            };
        }
        Ok(sum)
    }

    /// `φ_k(x)` alone, by one method.
    ///
    /// ```
    /// use wavestep_kernels::echoes::{EchoSum, Echoes, Expansion, Family, Method, Term, Time};
    ///
    /// let [one, two] = [Expansion::ONE, Expansion::try_from(2.0)?];
    /// let terms = [Term { lag: 0, coefficient: one }];
    /// let wave = Echoes::new(Family::Laguerre, one, two, one, &terms, two)?;
    /// let sum = EchoSum::new(wave, 500)?;
    /// // e^{−900} is no double; the echo is not small at all.
    /// assert_eq!(sum.echo(Method::Difference, 500, Time::from(900.0))?, 0.0);
    /// let echo = sum.echo(Method::Scaled, 500, Time::from(900.0))?;
    /// assert!((echo + 0.02471102674978201).abs() < 1e-15);
    /// # Ok::<(), wavestep_kernels::echoes::EchoError>(())
    /// ```
    ///
    /// # Errors
    /// When `x` is not finite or too large for the rates, or `k` is beyond the last echo.
    pub fn echo(&self, method: Method, k: usize, since: Time) -> Result<f64, EchoError> {
        self.check_size(since.high())?;
        if k > self.last() {
            return Err(EchoError::BeyondLast { last: self.last() });
        }
        let echo = match method {
            Method::Expanded | Method::Plain => {
                let [high, low, _] = self.delays.of(k);
                let time = Time::new(two_sum(since.high(), high).0, low)?;
                self.echo_since(method, k, since.pair(), time)
            }
            _ => self.echo_since(method, k, since.pair(), since),
        };
        Ok(echo.high)
    }

    /// Echo `k`, whose time since arrival and absolute time are given.
    fn echo_since(
        &self,
        method: Method,
        k: usize,
        since: DoubleDouble,
        time: Time,
    ) -> DoubleDouble {
        let (echoes, ratio) = (&self.echoes, self.ratios[k]);
        if let Some(parts) = echoes.first.get(k) {
            return match method {
                Method::DoubleDouble => double_double::first(parts, since),
                _ => DoubleDouble::from(double_double::first_rounded(parts, since)),
            };
        }
        DoubleDouble::from(match method {
            Method::Expanded => expanded::expanded(echoes, k, time.high()),
            Method::Plain => laguerre::plain(echoes, k, time.high()),
            Method::Difference => laguerre::difference(echoes, ratio, &self.reciprocals, k, since),
            Method::Scaled => scaled::scaled(echoes, ratio, &self.reciprocals, k, since),
            Method::DoubleDouble => {
                return double_double::echo(echoes, ratio, &self.reciprocal_pairs, k, since);
            }
        })
    }

    /// `f(T)` at many times, into `values`, as [`Method::Scaled`] sums it; the last bits may differ,
    /// because points are summed side by side in the widest registers of the machine.
    ///
    /// Times may come in any order; neighbours of the same period are fastest, because one
    /// exponential then serves all their echoes.
    ///
    /// # Errors
    /// When the lengths differ, or as for [`EchoSum::value`]; then no value is written.
    pub fn fill(
        &self,
        times: &[f64],
        include_arriving: bool,
        values: &mut [f64],
    ) -> Result<(), EchoError> {
        if times.len() != values.len() {
            return Err(EchoError::LengthsDiffer { times: times.len(), values: values.len() });
        }
        let Some(latest) = widest(Latest(times)) else { return Err(EchoError::NotFinite) };
        if times.is_empty() {
            return Ok(());
        }
        self.admit(Time::from(latest), include_arriving)?;
        widest(Fill { sum: self, times, include_arriving, values });
        Ok(())
    }

    /// Echo `k` by the scaled summation, where lanes do not reach.
    pub(super) fn scaled_echo(&self, k: usize, since: DoubleDouble) -> f64 {
        scaled::scaled(&self.echoes, self.ratios[k], &self.reciprocals, k, since)
    }

    fn check_size(&self, time: f64) -> Result<(), EchoError> {
        if !time.is_finite() {
            return Err(EchoError::NotFinite);
        }
        match time * self.echoes.fastest() <= LARGEST_ARGUMENT {
            true => Ok(()),
            false => Err(EchoError::TimeTooLarge),
        }
    }

    fn admit(&self, time: Time, include_arriving: bool) -> Result<(), EchoError> {
        self.check_size(time.high())?;
        match self.delays.has_arrived(self.delays.last(), time, include_arriving) {
            true => Err(EchoError::BeyondLast { last: self.last() }),
            false => Ok(()),
        }
    }
}

/// The latest of some times, none if one of them is not finite. Lanes run side by side, so that no
/// comparison waits for the one before.
struct Latest<'a>(&'a [f64]);

impl Work for Latest<'_> {
    type Output = Option<f64>;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Option<f64> {
        let (mut latest, mut zeros) = (L::splat(f64::MIN), L::splat(0.0));
        let (vectors, rest) = self.0.as_chunks();
        let mut padded = [f64::MIN; WIDTH];
        padded[..rest.len()].copy_from_slice(rest);
        for vector in vectors.iter().chain([&padded]) {
            let vector = L::from_array(*vector);
            latest = latest.greater(vector);
            // What is not finite times 0 is no number, and stays so in a sum.
            zeros = zeros + vector * L::splat(0.0);
        }
        (zeros.sum() == 0.0).then(|| latest.to_array().into_iter().fold(f64::MIN, f64::max))
    }
}
