//! One pole and one lag: the march of the impulse response, with a proven bound.
//!
//! The impulse response is a polynomial on each period, whose length grows as the fronts sharpen. A
//! certificate looks at the polynomials alone and proves how far they are from the exact response
//! ([`wavestep_kernels::march`]); the bound of an observable is that, times the sum of the weights with
//! which the response is seen.

use super::MethodError;
use super::clock::Place;
use super::doubles::near;
use super::held_waves::HeldWaves;
use super::marched;
use crate::enclosure::Numbers;
use crate::evaluate::error::EvaluateError;
use crate::evaluate::taps::{Tap, Taps};
use crate::expression::{Fraction, Root};
use wavestep_kernels::march::chebyshev::{self, Samples};
use wavestep_kernels::march::{Bounds, March, MarchOptions, Parameter, Reflection};

/// The impulse response, and the weights with which it is seen.
pub(super) struct Response {
    reflection: Reflection,
    weights: Vec<f64>,
    /// The proven bound on the window, where one is asked for and proven.
    bound: Option<f64>,
    /// The waves that it was proven of, where there is room for them.
    held: Option<HeldWaves>,
}

impl Response {
    /// The response with its weights; up to a last period it is marched through at once and a bound is
    /// proven.
    ///
    /// # Errors
    /// [`MethodError::March`] where waves grow without bound.
    ///
    /// # Cost
    /// For each period some hundred operations a coefficient, of which there are about `√(2nD)`; two
    /// or three times as many with a bound.
    pub fn new(
        reflection: Reflection,
        weights: Vec<f64>,
        proven_to: Option<u64>,
    ) -> Result<Response, MethodError> {
        let mut response = Response { reflection, weights, bound: None, held: None };
        if let Some(last) = proven_to {
            (response.bound, response.held) = response.prove(last)?;
        }
        Ok(response)
    }

    /// Marches to the end with a certificate. The bound of the response is `b`, and a place is off by
    /// `2^−53` of a period at most, which the steepest slope `Σ 2k² |c_k|` of a period turns into an
    /// error of the value. The waves are held where there is room for all of them.
    fn prove(&self, last: u64) -> Result<(Option<f64>, Option<HeldWaves>), MethodError> {
        let mut march = self.march(Bounds::Proven)?;
        let mut slope = 0.0_f64;
        let mut sum = 0.0_f64;
        let mut bound = 0.0_f64;
        let mut held = Some(HeldWaves::default());
        loop {
            let sizes = chebyshev::sizes(march.coefficients());
            slope = slope.max(sizes.slope);
            sum = sum.max(sizes.absolute);
            held = held.and_then(|held| held.with_period(march.coefficients()));
            // Evaluation loses most where the polynomial is largest, which need not be at the end.
            match march.bound_by(&sizes) {
                Some(here) => bound = bound.max(here),
                None => return Ok((None, None)),
            }
            if march.period() as u64 >= last {
                break;
            }
            march.advance()?;
        }
        let total: f64 = self.weights.iter().map(|weight| weight.abs()).sum();
        // The weighted sum itself, with an eighth to spare for the rounding of this line, and for the
        // enclosure of what is added.
        let roundings = (self.weights.len() + 4) as f64 * f64::EPSILON * sum;
        Ok((Some((bound + slope * f64::EPSILON + roundings) * total * 1.125), held))
    }

    /// The march on its first period.
    fn march(&self, bounds: Bounds) -> Result<March, MethodError> {
        let options = MarchOptions { bounds, ..MarchOptions::default() };
        Ok(March::new(&self.reflection, options)?)
    }
}

impl marched::March for Response {
    fn law(&self) -> String {
        match self.bound {
            Some(bound) => format!("at most {bound:.1e} everywhere on the window, proven"),
            None => "no bound; about 1e-15 √n, measured".to_owned(),
        }
    }

    fn bound(&self) -> Option<f64> {
        self.bound
    }

    fn sums(&self, mut places: Vec<Place>, count: usize) -> Result<Vec<f64>, MethodError> {
        places.sort_by_key(|place| place.period);
        let points: Vec<f64> = places.iter().map(|place| place.local).collect();
        let mut responses = vec![0.0; points.len()];
        let groups = places.chunk_by(|a, b| a.period == b.period);
        let (mut points, mut found) = (&points[..], &mut responses[..]);
        let groups = groups.map(|group| {
            let (points, found) = (
                points.split_off(..group.len()).unwrap_or_default(),
                found.split_off_mut(..group.len()).unwrap_or_default(),
            );
            (group[0].period, points, found)
        });
        match &self.held {
            Some(held) => chebyshev::values_of(groups.map(|(period, points, values)| Samples {
                coefficients: held.period(period),
                points,
                values,
            })),
            None => {
                let mut march = self.march(Bounds::None)?;
                for (period, points, values) in groups {
                    while march.period() < period {
                        march.advance()?;
                    }
                    march.values(points, values);
                }
            }
        }
        let mut values = vec![0.0; count];
        for (place, response) in places.iter().zip(&responses) {
            values[place.value] += self.weights[place.seen] * response;
        }
        Ok(values)
    }
}

/// The reflection of taps, with periods as the unit of time.
pub(super) fn reflection(taps: &Taps, numbers: &Numbers) -> Result<Reflection, MethodError> {
    let parameter = |value: &Fraction| -> Result<Parameter, MethodError> {
        let (value, radius) = near(numbers, value).map_err(EvaluateError::from)?;
        Ok(Parameter::within(value, radius)?)
    };
    let rate = parameter(&(&taps.rate * &taps.period))?;
    let zero = parameter(&(&taps.zero * &taps.period))?;
    Ok(Reflection::new(rate, zero, parameter(&taps.ratio)?)?)
}

/// The weights of taps in the unit of an observable.
pub(super) fn weights(
    taps: &[Tap],
    unit: &Root,
    numbers: &Numbers,
) -> Result<Vec<f64>, MethodError> {
    let unit = numbers.enclose_root(unit, 128).map_err(EvaluateError::from)?;
    let weight = |tap: &Tap| {
        let weight = numbers.enclose(&tap.weight, 128).map_err(EvaluateError::from)?;
        Ok(weight.multiply(&unit, 128).to_double().0)
    };
    taps.iter().map(weight).collect()
}
