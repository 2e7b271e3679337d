//! What is asked for: an observable on a window of time.

use crate::answer::cost::Costs;
use crate::ball::Magnitude;
use crate::network::Network;
use crate::signal::{EvaluateError, Evaluator as _, Limit, Marched, Signal, Taps, scale};
use wavestep_polynomial::Rational;

/// An observable on a window, with what there is to compute it from.
pub struct Question<'a> {
    pub signal: Box<dyn Signal + 'a>,
    /// The scene, and the place of the observable in it; models need it.
    pub scene: Option<(&'a Network, usize)>,
    /// Whether contacts may open on the window, of which models know nothing.
    pub contacts_open: bool,
    /// By which ways are weighed.
    pub costs: &'a Costs,
}

impl Question<'_> {
    /// The same without echoes that come to no more than `most` together, where some can be left out.
    pub fn within(&self, most: f64) -> Result<Option<Question<'_>>, EvaluateError> {
        let signal = self.signal.within(&Magnitude::from_double(most))?;
        let Question { scene, contacts_open, costs, .. } = *self;
        Ok(signal.map(|signal| Question { signal, scene, contacts_open, costs }))
    }

    /// About the largest absolute value on the window, from the beginnings, middles and ends of some
    /// stretches between breaks; the largest one is not smaller, but for rounding.
    pub fn scale(&self) -> Result<f64, EvaluateError> {
        // After many periods a march tells it sooner, where there is one.
        const MANY: usize = 30;
        let many = self.order().is_ok_and(|order| order > MANY);
        let marched = many.then(|| self.marched_scale()).flatten();
        marched.map_or_else(|| scale(&*self.signal), Ok)
    }

    fn marched_scale(&self) -> Option<f64> {
        const SAMPLES: i64 = 40;
        // Tolerances are relative to this: it does not rest on a march that has no proof at all.
        Taps::of(self.signal.closed_form().ok()?).ok()?;
        let marched = Marched::new(&*self.signal).ok()?;
        let [from, to] = self.signal.window();
        let part = (to - from) / Rational::from_integer(SAMPLES.into());
        let at = |i: i64| from + &part * Rational::from_integer(i.into());
        let times: Vec<Rational> = (0..=SAMPLES).map(at).collect();
        let values = marched.exact_values(&times, Limit::Right).ok()?;
        Some(values.iter().map(|value| value.abs()).fold(0.0, f64::max))
    }

    /// How many periods begin on the window, whatever is left out of them; without periods as [`Question::order`].
    pub fn periods(&self) -> Result<usize, EvaluateError> {
        match self.signal.closed_form() {
            Ok(form) if form.is_on_grid() => form.periods(self.signal.window()[1]),
            _ => self.order(),
        }
    }

    /// How many reflections the window sees; without a closed form, how many stretches it has.
    pub fn order(&self) -> Result<usize, EvaluateError> {
        match self.signal.closed_form() {
            Ok(form) => form.order(self.signal.window()[1]),
            Err(EvaluateError::NoClosedForm | EvaluateError::NotLinear) => self.signal.count(),
            Err(error) => Err(error),
        }
    }
}
