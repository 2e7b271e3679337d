//! What a signal is on a stretch: values, derivatives and Taylor polynomials in balls.

use super::form::{ClosedForm, Solved};
use super::stretch::{Part, Stretch};
use crate::ball::{Ball, ComplexBall, Magnitude};
use crate::enclosure::real_part;
use crate::expression::{Field as _, Fraction, Transform};
use crate::limits::MAX_PIECES;
use crate::recurrence::ObservedWave;
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::taylor::{Expansion, Near, Taylor};
use crate::signal::transforms::value_at;
use wavestep_polynomial::Rational;

impl ClosedForm {
    /// Calls `view` with the function of a part, a piece or on a lattice an echo, in the time since its
    /// origin.
    fn with_function<T>(
        &self,
        Part { seen, number, .. }: &Part,
        bits: u64,
        view: impl FnOnce(&Transform<ComplexBall>) -> Outcome<T>,
    ) -> Outcome<T> {
        let solved = self.solved(bits)?;
        let wave = self.observation.waves[*seen].wave;
        match &mut *solved.borrow_mut() {
            Solved::Periods(periods) => {
                if *number > MAX_PIECES {
                    let (echoes, limit) = (*number as u128, MAX_PIECES);
                    return Err(EvaluateError::TooManyEchoes { echoes, limit });
                }
                periods.advance_to(*number)?;
                view(periods.piece(wave, *number))
            }
            Solved::Echoes(echoes) => view(&echoes[wave][*number]),
        }
    }

    /// Calls `add` with the functions that make up the signal on a stretch: each with its coefficient,
    /// in the time since an origin, differentiated so many times.
    fn for_each_function(
        &self,
        stretch: &Stretch,
        derivative: usize,
        bits: u64,
        mut add: impl FnMut(&Transform<ComplexBall>, &Fraction, &ComplexBall) -> Outcome<()>,
    ) -> Outcome<()> {
        let field = self.numbers.field(bits);
        let unit = ComplexBall::from(self.numbers.enclose_root(&self.unit, bits)?);
        let in_unit = |seen: &ObservedWave| -> Outcome<ComplexBall> {
            Ok(field.embed(&seen.coefficient)?.multiply(&unit, bits))
        };
        let waves = &self.observation.waves;
        let coefficients: Vec<_> = waves.iter().map(in_unit).collect::<Result<_, _>>()?;
        for part in stretch.parts() {
            let (coefficient, slope) = (&coefficients[part.seen], waves[part.seen].slope);
            self.with_function(part, bits, |function| {
                if function.is_zero() {
                    return Ok(());
                }
                match derivative + usize::from(slope) {
                    0 => add(function, &part.origin, coefficient),
                    times => {
                        let mut slope = function.differentiated(&field)?;
                        for _ in 1..times {
                            slope = slope.differentiated(&field)?;
                        }
                        add(&slope, &part.origin, coefficient)
                    }
                }
            })?;
        }
        let forcing = &self.observation.forcing;
        if stretch.begun && !forcing.is_zero() {
            let exact = Transform::of(forcing, &self.recurrence.statement().time);
            let mut function = Transform::<ComplexBall>::embedded(&exact, &field)?;
            for _ in 0..derivative {
                function = function.differentiated(&field)?;
            }
            add(&function, &Fraction::zero(), &unit)?;
        }
        Ok(())
    }

    /// An enclosure of the signal, or of a derivative with respect to the user's time, at a time of a
    /// stretch or at one of its ends.
    pub(super) fn enclose(
        &self,
        stretch: &Stretch,
        derivative: usize,
        at: &Fraction,
        bits: u64,
    ) -> Outcome<Ball> {
        let field = self.numbers.field(bits);
        let mut sum = ComplexBall::zero();
        self.for_each_function(stretch, derivative, bits, |function, origin, coefficient| {
            let x = field.embed(&(at - origin).into())?;
            let value = value_at(function, &x, &self.numbers, bits)?;
            sum = sum.add(&value.multiply(coefficient, bits), bits);
            Ok(())
        })?;
        let value = self.times_slowness(real_part(sum)?, derivative, bits)?;
        Ok(value.widened(&self.left_out(derivative)))
    }

    fn times_slowness(&self, mut value: Ball, times: usize, bits: u64) -> Outcome<Ball> {
        for _ in 0..times {
            value = value.multiply(&self.numbers.enclose(&self.slowness, bits)?, bits);
        }
        Ok(value)
    }

    /// The signal, or a derivative with respect to the user's time: what it is on the stretch, and beyond that what it
    /// would be without further arrivals.
    pub(super) fn taylor(&self, stretch: &Stretch, near: Near<'_>) -> Outcome<Taylor> {
        self.weighted_taylor(stretch, near, &Ball::zero())
    }

    /// The same times `e^(−wu)`, where `w` makes the slowest decay of it about constant.
    pub(super) fn taylor_of_sign(&self, stretch: &Stretch, near: Near<'_>) -> Outcome<Taylor> {
        if self.kept.is_some() {
            // What is left out need not decay.
            return self.taylor(stretch, near);
        }
        let Near { order, place: (_, half), bits, .. } = near;
        let field = self.numbers.field(bits);
        let mut slowest: Option<Ball> = None;
        self.for_each_function(stretch, order, bits, |function, _, _| {
            for (pole, _) in function.poles() {
                let rate = field.embed(&pole.clone().into())?;
                let rate = Ball::new(rate.real().midpoint().clone(), Magnitude::ZERO);
                let is_slower = |known: &Ball| *known.midpoint() < *rate.midpoint();
                if slowest.as_ref().is_none_or(is_slower) {
                    slowest = Some(rate);
                }
            }
            Ok(())
        })?;
        let h = self.numbers.enclose(&self.slowness.scale(half), bits)?;
        // Any weight will do.
        let weight = slowest.map_or_else(Ball::zero, |rate| rate.multiply(&h, bits));
        let weight = Ball::new(weight.midpoint().clone(), Magnitude::ZERO);
        self.weighted_taylor(stretch, near, &weight)
    }

    fn weighted_taylor(
        &self,
        stretch: &Stretch,
        Near { order, place: (centre, half), terms, bits }: Near<'_>,
        weight: &Ball,
    ) -> Outcome<Taylor> {
        let field = self.numbers.field(bits);
        let h = field.embed(&self.slowness.scale(half).into())?;
        let at = self.slowness.scale(centre);
        let mut expansion = Expansion::new((&h, weight), terms, &self.numbers, bits);
        self.for_each_function(stretch, order, bits, |function, origin, coefficient| {
            expansion.add(function, &field.embed(&(&at - origin).into())?, coefficient);
            Ok(())
        })?;
        let mut sum = expansion.sum()?.real()?;
        if order > 0 {
            let one = Ball::from_integer(&1.into());
            sum = sum.scaled(&self.times_slowness(one, order, bits)?, bits);
        }
        sum.remainder = sum.remainder.add(&self.left_out(order));
        Ok(sum)
    }

    /// Stretches joined where all that arrives is identically zero, so that nothing changes.
    pub(super) fn audible(&self, stretches: Vec<Stretch>, bits: u64) -> Outcome<Vec<Stretch>> {
        let mut joined: Vec<Stretch> = Vec::new();
        for mut stretch in stretches {
            let Some(last) = joined.last_mut() else {
                joined.push(stretch);
                continue;
            };
            // On a lattice parts are added to those that are there.
            let mut goes_on = !self.is_on_grid() && last.begun == stretch.begun;
            for part in stretch.parts().iter().skip(last.parts().len()) {
                goes_on = goes_on && self.with_function(part, bits, |echo| Ok(echo.is_zero()))?;
            }
            match goes_on {
                true => {
                    stretch.from = last.from.clone();
                    *last = stretch;
                }
                false => joined.push(stretch),
            }
        }
        Ok(joined)
    }

    /// About the sum of the absolute values of all that a derivative consists of at a time, in the
    /// scale of the waves, and the sum of the radii of their enclosures.
    pub(super) fn size(
        &self,
        stretch: &Stretch,
        derivative: usize,
        at: &Rational,
        bits: u64,
    ) -> Outcome<(Magnitude, Magnitude)> {
        let (field, at) = (self.numbers.field(bits), self.slowness.scale(at));
        let (mut size, mut error) = (Magnitude::ZERO, Magnitude::ZERO);
        self.for_each_function(stretch, derivative, bits, |function, origin, coefficient| {
            let x = field.embed(&(&at - origin).into())?;
            let value = value_at(function, &x, &self.numbers, bits)?.multiply(coefficient, bits);
            for part in [value.real(), value.imaginary()] {
                size = size.add(&part.midpoint().magnitude());
                error = error.add(part.radius());
            }
            Ok(())
        })?;
        Ok((size, error.add(&self.left_out(derivative))))
    }
}
