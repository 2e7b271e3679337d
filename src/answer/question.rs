//! What is asked for: an observable on a window of time.

use crate::evaluate::{ClosedForm, EvaluateError, Limit, Marched, Method as _, Recogniser, Taps};
use crate::network::Network;
use wavestep_polynomial::Rational;

/// An observable on a window, with what there is to compute it from.
pub struct Question<'a> {
    /// The observable.
    pub signal: &'a ClosedForm,
    /// The scene, and the place of the observable in it; models need it.
    pub scene: Option<(&'a Network, usize)>,
    /// Tells values that are rational numbers.
    pub recognise: &'a Recogniser<'a>,
    /// The first time of the window, in the user's unit.
    pub from: Rational,
    /// The last one.
    pub to: Rational,
}

impl Question<'_> {
    /// About the largest absolute value on the window, from the beginnings, middles and ends of some
    /// stretches between arrivals; the largest one is not smaller, but for rounding.
    ///
    /// # Errors
    /// [`EvaluateError`], where the window has too many arrivals.
    pub fn scale(&self) -> Result<f64, EvaluateError> {
        // After many periods a march tells it sooner, where there is one.
        const MANY: usize = 30;
        let many = self.order().is_ok_and(|order| order > MANY);
        let marched = many.then(|| self.marched_scale()).flatten();
        match marched {
            Some(scale) => Ok(scale),
            None => crate::evaluate::scale(self.signal, &self.from, &self.to),
        }
    }

    fn marched_scale(&self) -> Option<f64> {
        const SAMPLES: i64 = 40;
        // Tolerances are relative to this: it does not rest on a march that has no proof at all.
        Taps::of(self.signal).ok()?;
        let marched = Marched::new(self.signal, &self.from, &self.to, false).ok()?;
        let part = (&self.to - &self.from) / Rational::from_integer(SAMPLES.into());
        let at = |i: i64| &self.from + &part * Rational::from_integer(i.into());
        let times: Vec<Rational> = (0..=SAMPLES).map(at).collect();
        let values = marched.exact_values(&times, Limit::Right).ok()?;
        Some(values.iter().map(|value| value.abs()).fold(0.0, f64::max))
    }

    /// How many reflections the window sees.
    ///
    /// # Errors
    /// As [`ClosedForm::order`].
    pub fn order(&self) -> Result<usize, EvaluateError> {
        self.signal.order(&self.to)
    }
}
