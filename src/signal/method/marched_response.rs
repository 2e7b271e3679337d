//! One pole and one lag: the march of the impulse response, with a proven bound.
//!
//! The impulse response is a polynomial on each period, whose length grows as the fronts sharpen. A
//! certificate looks at the polynomials alone and proves how far they are from the exact response
//! ([`wavestep_kernels::march`]); the bound of an observable is that, times the sum of the weights with
//! which the response is seen.

use super::MethodError;
use super::clock::Place;
use super::doubles::near;
use crate::enclosure::Numbers;
use crate::expression::{Fraction, Root};
use crate::signal::taps::{Tap, Taps};
use wavestep_kernels::march::chebyshev::{self, Samples};
use wavestep_kernels::march::{Bounds, March, MarchOptions, Parameter, Reflection};

/// The impulse response, and the weights with which it is seen.
pub(super) struct Response {
    reflection: Reflection,
    weights: Vec<f64>,
    /// The proven bound on the window, where one is asked for and proven.
    pub bound: Option<f64>,
    /// The waves that it was proven of, where there is room for them.
    held: Option<Held>,
}

/// Chebyshev coefficients of the response on all periods of a window, as the proof leaves them: where there
/// are few, values need no second march.
#[derive(Default)]
pub struct Held {
    coefficients: Vec<f64>,
    /// Where the coefficients of each period end.
    ends: Vec<usize>,
}

impl Held {
    /// The most coefficients that are held: eight megabytes.
    pub const MOST: usize = 1 << 20;

    /// With the next period; none where there is no room for it.
    pub fn with_period(mut self, coefficients: &[f64]) -> Option<Held> {
        self.coefficients.extend_from_slice(coefficients);
        self.ends.push(self.coefficients.len());
        (self.coefficients.len() <= Held::MOST).then_some(self)
    }

    /// The coefficients of a period that is held.
    pub fn period(&self, number: usize) -> &[f64] {
        let start = number.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.coefficients[start..self.ends[number]]
    }
}

impl Response {
    /// The response that taps weigh, in the unit of an observable and with periods as the unit of time.
    pub fn new(taps: &Taps, unit: &Root, numbers: &Numbers) -> Result<Response, MethodError> {
        let parameter = |value: &Fraction| -> Result<Parameter, MethodError> {
            let (value, radius) = near(numbers, value)?;
            Ok(Parameter::within(value, radius)?)
        };
        let rate = parameter(&(&taps.rate * &taps.period))?;
        let zero = parameter(&(&taps.zero * &taps.period))?;
        let reflection = Reflection::new(rate, zero, parameter(&taps.ratio)?)?;
        let unit = numbers.enclose_root(unit, 128)?;
        let weight = |tap: &Tap| -> Result<f64, MethodError> {
            Ok(numbers.enclose(&tap.weight, 128)?.multiply(&unit, 128).to_double().0)
        };
        let weights = taps.taps.iter().map(weight).collect::<Result<_, _>>()?;
        Ok(Response { reflection, weights, bound: None, held: None })
    }

    /// Marches to the end with a certificate. The bound of the response is `b`, and a place is off by
    /// `2^−53` of a period at most, which the steepest slope `Σ 2k² |c_k|` of a period turns into an
    /// error of the value. The waves are held where there is room for all of them.
    pub fn prove(&mut self, last: u64) -> Result<(), MethodError> {
        let mut march = self.march(Bounds::Proven)?;
        let mut slope = 0.0_f64;
        let mut sum = 0.0_f64;
        let mut bound = 0.0_f64;
        let mut held = Some(Held::default());
        loop {
            let sizes = chebyshev::sizes(march.coefficients());
            slope = slope.max(sizes.slope);
            sum = sum.max(sizes.absolute);
            held = held.and_then(|held| held.with_period(march.coefficients()));
            // Evaluation loses most where the polynomial is largest, which need not be at the end.
            match march.bound_by(&sizes) {
                Some(here) => bound = bound.max(here),
                None => return Ok(()),
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
        self.bound = Some((bound + slope * f64::EPSILON + roundings) * total * 1.125);
        self.held = held;
        Ok(())
    }

    /// The march on its first period.
    fn march(&self, bounds: Bounds) -> Result<March, MethodError> {
        let options = MarchOptions { bounds, ..MarchOptions::default() };
        Ok(March::new(&self.reflection, options)?)
    }

    /// The weighted sums at all places, for so many values.
    pub fn sums(&self, mut places: Vec<Place>, count: usize) -> Result<Vec<f64>, MethodError> {
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
