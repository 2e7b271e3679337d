//! A line as the sum of its first modes of vibration.
//!
//! A conservative line of bars, masses and springs swings in modes `u_n(x) cos ω_n t`. The frequencies
//! are found one by one by the Prüfer angle, which counts them, so that none is missed; then the
//! motion at the start is projected onto each mode with exact integrals over the uniform bars.
//!
//! Error law (measured, not proven): with `N` modes the mean error over time falls at least like `1/N`,
//! and with 1600 modes is below 1/800 of the largest value; beside a jump the largest error does not
//! fall, as is known of Fourier series.

use crate::enclosure::EnclosureError;
use crate::limits::{MAX_MODE_TERMS, MAX_MODES};
use crate::model::Model;
use crate::model::error::{BadSetting, ModelError, NotSeen};
use crate::model::line::Line;
use crate::model::modal_line::{ModalLine, Mode, Vibration};
use crate::model::shape::{Shape, frequencies};
use crate::network::ScaledScene;

const NAME: &str = "modes of vibration";

/// Doubles have the bits that they have.
const BITS: u64 = f64::MANTISSA_DIGITS as u64;

/// The first modes of vibration of a line.
///
/// Cost: for each mode some ten evaluations of a chain of rotations, then a sine and a cosine for each
/// time.
///
/// # Invariants
/// Frequencies ascend; a free line has the frequency 0 first, its motion as a whole.
#[derive(Clone, Debug)]
pub struct Modes {
    line: Line,
    modes: Vec<Mode<f64>>,
    /// The unit of frequency by that of the user.
    unit: f64,
}

impl Line {
    fn modal(&self) -> ModalLine<'_, f64> {
        ModalLine { bars: &self.bars, nodes: &self.nodes, bits: BITS }
    }
}

impl Modes {
    pub fn new(scene: &ScaledScene, count: usize) -> Result<Modes, ModelError> {
        if count == 0 {
            let reason = BadSetting::NoModes;
            return Err(ModelError::Setting { model: NAME, reason });
        }
        ModelError::limited(NAME, "modes", count as f64, MAX_MODES as f64)?;
        let line = Line::linear(NAME, scene)?;
        let modal = line.modal();
        let refused = |reason| ModelError::Refused { model: NAME, reason };
        let parts = modal.parts(|element| line.name(element)).map_err(refused)?;
        let (held, drifts) = (modal.held(), modal.drifts());
        let mode = |frequency| {
            let shape = Shape::of(&parts, held[0], frequency, BITS);
            shape.and_then(|shape| modal.mode(shape)).map_err(EnclosureError::from)
        };
        let modes = frequencies(&parts, held, drifts, count).into_iter().map(mode);
        let modes = modes.collect::<Result<_, _>>()?;
        let unit = line.scaled(&[1.0])?[0];
        Ok(Modes { line, modes, unit })
    }

    /// The frequencies `ω_n` in ascending order, in radians a second, or as plain numbers.
    pub fn frequencies(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        let frequency = |mode: &Mode<f64>| mode.shape.frequency().copied().unwrap_or(0.0);
        self.modes.iter().map(move |mode| frequency(mode) * self.unit)
    }

    /// An observable as a sum of modes, in the time and the unit of the user.
    pub fn vibration(&self, observable: usize) -> Result<Vibration, ModelError> {
        let observable = self.line.observable(NAME, observable)?;
        let sum = self.line.modal().sum(observable.terms(), &self.modes);
        let Some(Vibration { drift: [constant, slope], modes }) =
            sum.map_err(EnclosureError::from)?
        else {
            return self.line.refuse(NAME, observable, NotSeen::Other);
        };
        let modes = modes.into_iter().map(|[frequency, a, b]| [frequency * self.unit, a, b]);
        Ok(Vibration { drift: [constant, slope * self.unit], modes: modes.collect() })
    }
}

impl Model for Modes {
    fn assumptions(&self) -> &'static str {
        "All modes of vibration above the last one are left out, and with them what is steep in a wave."
    }

    fn values(&self, observable: usize, times: &[f64]) -> Result<Vec<f64>, ModelError> {
        let count = self.modes.len() as f64 * times.len() as f64;
        ModelError::limited(NAME, "terms", count, MAX_MODE_TERMS)?;
        let Vibration { drift: [constant, slope], modes } = self.vibration(observable)?;
        let value = |time: &f64| {
            let swing = |[frequency, a, b]: &[f64; 3]| {
                let (sine, cosine) = (frequency * time).sin_cos();
                a * cosine + b * sine
            };
            let swings: f64 = modes.iter().map(swing).sum();
            if *time < 0.0 { 0.0 } else { constant + slope * time + swings }
        };
        Ok(times.iter().map(value).collect())
    }
}
