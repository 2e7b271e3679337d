//! The period, and the place on it, at which a delayed wave is seen: rounded once, at the end.

use super::MethodError;
use crate::ball::{Ball, at_or_after, rational};
use crate::enclosure::Numbers;
use crate::expression::Fraction;
use crate::limits::MAX_MARCHED_PERIODS;
use crate::signal::closed::ClosedForm;
use crate::signal::signal::Limit;
use num_traits::{Signed as _, ToPrimitive as _};
use wavestep_kernels::fixed::{FixedError, Reduction};
use wavestep_polynomial::Rational;

/// Time by periods.
pub(super) struct Clock {
    pub numbers: Numbers,
    /// Time in the scale of the waves for one unit of the user's.
    pub slowness: Fraction,
    /// The length of a period in the scale of the waves.
    pub period: Fraction,
}

/// What is seen of a wave: `w(T − delay)`, from a time on.
pub(super) struct Delayed {
    pub delay: Fraction,
    /// The delay, or a later time.
    pub since: Fraction,
}

impl Delayed {
    /// A wave that is seen as soon as it arrives.
    pub fn at_once(delay: Fraction) -> Delayed {
        Delayed { since: delay.clone(), delay }
    }
}

/// A place at which a wave is asked for.
pub(super) struct Place {
    pub period: usize,
    /// In parts of the period.
    pub local: f64,
    /// Which of the waves that are seen.
    pub seen: usize,
    /// Which of the values it is for.
    pub value: usize,
}

/// Places of times that are doubles, just after arrivals.
pub enum DoublePlaces {
    /// The period is a double, and so many of them are the delay.
    Whole { period: f64, delay: u32 },
    /// Any rational numbers.
    Any(Reduction),
}

impl DoublePlaces {
    /// The period and the place on it, off by `2^−53` at most; `None` before the start.
    ///
    /// Where the period D is a double, the remainder `T − nD`, `0 ≤ T − nD < D`, is a double too: it is a
    /// multiple of the smaller of the last places of T and D, below D and not beyond T. The number n is the
    /// whole part of a rounded quotient, which is not below n and may be `n + 1`: then the remainder,
    /// rounded once, is negative.
    pub fn of(&self, time: f64) -> Result<Option<(usize, f64)>, FixedError> {
        let (period, delay) = match self {
            DoublePlaces::Whole { period, delay } => (*period, *delay as usize),
            DoublePlaces::Any(reduction) => {
                let place = reduction.of_double(time, Limit::Right)?;
                return Ok(place.map(|place| (place.period as usize, place.local())));
            }
        };
        if !time.is_finite() {
            return Err(FixedError::TimeNotFinite);
        }
        let quotient = time / period;
        if quotient >= f64::from(u32::MAX) {
            return Err(FixedError::TimeTooLate);
        }
        if time < 0.0 {
            return Ok(None);
        }
        let mut number = f64::from(quotient as u32);
        let mut rest = number.mul_add(-period, time);
        if rest < 0.0 {
            number -= 1.0;
            rest = number.mul_add(-period, time);
        }
        Ok((number as usize).checked_sub(delay).map(|number| (number, rest / period)))
    }
}

impl Clock {
    /// That of a signal on a grid.
    pub fn of(form: &ClosedForm) -> Clock {
        let numbers = Numbers::new(form.recurrence.constants());
        let period = form.recurrence.statement().period.clone();
        Clock { numbers, slowness: form.slowness.clone(), period }
    }

    /// The period and the place on it of a time that is seen with a delay; `None` before the start.
    fn place(
        &self,
        delay: &Fraction,
        at: &Rational,
        side: Limit,
    ) -> Result<Option<(u64, f64)>, MethodError> {
        let limit = usize::try_from(MAX_MARCHED_PERIODS).unwrap_or(usize::MAX);
        let too_many = || MethodError::TooManyPeriods { periods: usize::MAX, limit };
        let since = &self.slowness.scale(at) - delay;
        let period = &self.period;
        if let (Some(since), Some(period)) = (since.as_constant(), period.as_constant()) {
            let periods = since / period;
            let mut whole = periods.floor();
            if side == Limit::Left && whole == periods {
                whole -= Rational::from_integer(1.into());
            }
            if whole.is_negative() {
                return Ok(None);
            }
            let local = Ball::from_rational(&(periods - &whole), 64).to_double().0;
            let whole = whole.to_integer().to_u64().ok_or_else(too_many)?;
            return Ok(Some((whole, local)));
        }
        // Irrational: never on a joint, unless as an expression.
        let compare = |n: u64| {
            let joint = period.scale(&Rational::from_integer(n.into()));
            self.numbers.compare(&since, &joint)
        };
        let ball = |value: &Fraction| self.numbers.enclose(value, 192);
        let inverse = ball(period)?.reciprocal(192)?;
        let periods = ball(&since)?.multiply(&inverse, 192);
        let near = Rational::from(periods.midpoint()).floor().to_integer();
        if near < (-1).into() {
            return Ok(None);
        }
        // The joint at or before: one of three.
        let near =
            near.max(0.into()).to_u64().filter(|near| *near < u64::MAX).ok_or_else(too_many)?;
        for whole in [near + 1, near, near.saturating_sub(1)] {
            let order = compare(whole)?;
            if order.is_gt() || (order.is_eq() && side == Limit::Right) {
                let offset = Ball::from_rational(&Rational::from_integer(whole.into()), 192);
                let local = periods.subtract(&offset, 192).to_double().0;
                return Ok(Some((whole, local.clamp(0.0, 1.0))));
            }
        }
        Ok(None)
    }

    /// The places at times of all that is seen.
    pub fn places(
        &self,
        seen: &[Delayed],
        at: &[Rational],
        side: Limit,
    ) -> Result<Vec<Place>, MethodError> {
        let mut places = Vec::with_capacity(seen.len() * at.len());
        for (value, at) in at.iter().enumerate() {
            for (number, Delayed { delay, since }) in seen.iter().enumerate() {
                if since != delay && self.place(since, at, side)?.is_none() {
                    continue;
                }
                if let Some((period, local)) = self.place(delay, at, side)? {
                    let period = usize::try_from(period).unwrap_or(usize::MAX);
                    places.push(Place { period, local, seen: number, value });
                }
            }
        }
        Ok(places)
    }

    /// The same for doubles, just after arrivals, where period and delays are rational numbers and
    /// waves are seen as soon as they arrive: places are found in integers.
    pub fn places_of_doubles(&self, seen: &[Delayed], at: &[f64]) -> Option<Vec<Place>> {
        let delays = seen.iter().map(|seen| {
            (seen.since == seen.delay).then(|| self.double_places(&seen.delay)).flatten()
        });
        let delays: Vec<DoublePlaces> = delays.collect::<Option<_>>()?;
        let mut places = Vec::with_capacity(seen.len() * at.len());
        for (value, time) in at.iter().enumerate() {
            for (seen, delay) in delays.iter().enumerate() {
                if let Some((period, local)) = delay.of(*time).ok()? {
                    places.push(Place { period, local, seen, value });
                }
            }
        }
        Some(places)
    }

    /// How doubles find their places with a delay, where period and delay are rational numbers.
    fn double_places(&self, delay: &Fraction) -> Option<DoublePlaces> {
        let slowness = self.slowness.as_constant()?;
        let period = self.period.as_constant()? / &slowness;
        let delay = delay.as_constant()? / &slowness;
        let periods = &delay / &period;
        let double = at_or_after(&period);
        let normal = (1e-100..1e100).contains(&double) && rational(double) == period;
        if normal && periods.is_integer() {
            let delay = u32::try_from(periods.to_integer()).ok()?;
            return Some(DoublePlaces::Whole { period: double, delay });
        }
        Reduction::new(&period, &delay).ok().map(DoublePlaces::Any)
    }

    /// The last period of which something is seen until a time.
    pub fn last_period(&self, seen: &[Delayed], to: &Rational) -> Result<u64, MethodError> {
        let mut last = 0;
        for Delayed { delay, .. } in seen {
            if let Some((period, _)) = self.place(delay, to, Limit::Right)? {
                last = last.max(period);
            }
        }
        if last > MAX_MARCHED_PERIODS {
            let periods = usize::try_from(last).unwrap_or(usize::MAX);
            return Err(MethodError::TooManyPeriods {
                periods,
                limit: MAX_MARCHED_PERIODS as usize,
            });
        }
        Ok(last)
    }
}
