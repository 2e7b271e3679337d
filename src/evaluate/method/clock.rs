//! When on which period a delayed wave is seen: places in time, without a rounding before the last.

use super::MethodError;
use crate::ball::Ball;
use crate::enclosure::Numbers;
use crate::evaluate::evaluator::{EvaluateError, Side};
use crate::expression::Fraction;
use num_traits::{Signed as _, ToPrimitive as _};
use wavestep_kernels::fixed::Reduction;
use wavestep_polynomial::Rational;

/// The most periods that are marched through.
pub(super) const MAX_PERIODS: u64 = 10_000_000;

/// Time by periods.
pub(super) struct Clock {
    pub numbers: Numbers,
    /// Time in the scale of the waves for one unit of the user's.
    pub slowness: Fraction,
    /// The length of a period in the scale of the waves.
    pub period: Fraction,
}

impl Clock {
    /// The period and the place on it of a time that is seen with a delay; `None` before the start.
    pub fn place(
        &self,
        delay: &Fraction,
        at: &Rational,
        side: Side,
    ) -> Result<Option<(u64, f64)>, MethodError> {
        let limit = usize::try_from(MAX_PERIODS).unwrap_or(usize::MAX);
        let too_many = || MethodError::TooManyPeriods { periods: usize::MAX, limit };
        let since = &self.slowness.scale(at) - delay;
        let period = &self.period;
        if let (Some(since), Some(period)) = (since.as_constant(), period.as_constant()) {
            let periods = since / period;
            let mut whole = periods.floor();
            if side == Side::Left && whole == periods {
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
            self.numbers.compare(&since, &joint).map_err(EvaluateError::from)
        };
        let ball = |value: &Fraction| self.numbers.enclose(value, 192).map_err(EvaluateError::from);
        let inverse = ball(period)?.reciprocal(192).map_err(EvaluateError::Ball)?;
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
            if order.is_gt() || (order.is_eq() && side == Side::Right) {
                let offset = Ball::from_rational(&Rational::from_integer(whole.into()), 192);
                let local = periods.subtract(&offset, 192).to_double().0;
                return Ok(Some((whole, local.clamp(0.0, 1.0))));
            }
        }
        Ok(None)
    }

    /// The same for doubles, just after arrivals, where period and delay are rational numbers.
    pub fn reduction(&self, delay: &Fraction) -> Option<Reduction> {
        let slowness = self.slowness.as_constant()?;
        let period = self.period.as_constant()? / &slowness;
        Reduction::new(&period, &(delay.as_constant()? / &slowness)).ok()
    }

    /// The last period that is seen with one of these delays until a time.
    ///
    /// # Errors
    /// [`MethodError::TooManyPeriods`] beyond the limit.
    pub fn last_period<'a>(
        &self,
        delays: impl Iterator<Item = &'a Fraction>,
        to: &Rational,
    ) -> Result<u64, MethodError> {
        let mut last = 0;
        for delay in delays {
            if let Some((period, _)) = self.place(delay, to, Side::Right)? {
                last = last.max(period);
            }
        }
        if last > MAX_PERIODS {
            let periods = usize::try_from(last).unwrap_or(usize::MAX);
            return Err(MethodError::TooManyPeriods { periods, limit: MAX_PERIODS as usize });
        }
        Ok(last)
    }
}
