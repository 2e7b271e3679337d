//! A mass that strikes a bar with a fixed end: the bar as a spring that carries a third of its mass.
//!
//! Where the bar deforms uniformly, its velocity grows linearly from the fixed end, and its kinetic
//! energy is that of a third of its mass at the struck end: `½ ∫_0^1 m ξ² v² dξ = ½ (m/3) v²`.
//! With `M` the striking mass, `m = Zτ` and `k = Z/τ` the displacement of the struck end obeys
//! Rayleigh's equation
//!
//! ```text
//! (M + m/3) u'' + k u = 0,   u(0) = 0,   u'(0) = v_0
//! ```
//!
//! with `v_0 = M V/(M + m/3)`, since momentum is kept. Error law (measured, not proven): for `μ = m/M` of
//! 1/16, 1/4 and 1 the largest strain is 22, 40 and 62 % below the exact one at the fixed end. Equation
//! 6.86, with `v_0 = V` and the front added, is 0.8, 3.6 and 4.5 % below.

use crate::model::Model;
use crate::model::error::{ModelError, NotRepresented, NotSeen};
use crate::model::line::Line;
use crate::network::{ElementLaw, Field, Lumped, Reading, ScaledScene, Side};

const NAME: &str = "a third of the mass";

/// A mass on a spring that has a third of the mass of the bar.
///
/// Cost: a sine for each time.
///
/// # Invariants
/// The line is one finite bar at rest with one fixed end, and masses at the other.
#[derive(Clone, Debug)]
pub struct ThirdOfMass {
    line: Line,
    /// The velocity at the start, by momentum: `M V/(M + m/3)`, since the third is at rest before.
    start: f64,
    /// `ω = √(k/(M + m/3))`
    frequency: f64,
    /// Whether the fixed end is the left one.
    mirrored: bool,
}

fn refuse<T>(reason: NotRepresented) -> Result<T, ModelError> {
    Err(ModelError::Refused { model: NAME, reason })
}

impl ThirdOfMass {
    /// The model of a mass that strikes a bar with a fixed end.
    pub fn new(scene: &impl AsRef<ScaledScene>) -> Result<ThirdOfMass, ModelError> {
        let line = Line::linear(NAME, scene.as_ref())?;
        let ([bar], [left, right]) = (&line.bars[..], &line.nodes[..]) else {
            return refuse(match (&line.bars[..], line.endless()) {
                ([_], Some(bar)) => NotRepresented::EndlessSpring(bar.name.clone()),
                (bars, _) => NotRepresented::NotOneBar(bars.len()),
            });
        };
        let travel = bar.travel.expect("a bar between two nodes is finite");
        let (struck, fixed, mirrored) = match (left.left, right.right) {
            (Side::Free, Side::Fixed) => (left, right, false),
            (Side::Fixed, Side::Free) => (right, left, true),
            _ => return refuse(NotRepresented::OtherEnds),
        };
        if let Some(own) = fixed.elements.first() {
            return refuse(NotRepresented::FixedEndNotBare(line.name(own.element)));
        }
        let is_mass = |own: &&Lumped<f64>| matches!(own.law, ElementLaw::Mass { .. });
        if let Some(own) = struck.elements.iter().find(|own| !is_mass(own)) {
            return refuse(NotRepresented::NotAMass(line.name(own.element)));
        }
        if bar.velocity != 0.0 || bar.force != 0.0 {
            return refuse(NotRepresented::NotAtRest(bar.name.clone()));
        }
        let (mass, momentum) = struck.mass_of(0);
        if mass <= 0.0 {
            return refuse(NotRepresented::NoStriker);
        }
        let whole = mass + bar.mass() / 3.0;
        let frequency = (bar.impedance / travel / whole).sqrt();
        Ok(ThirdOfMass { start: momentum / whole, frequency, mirrored, line })
    }
}

impl Model for ThirdOfMass {
    fn assumptions(&self) -> &'static str {
        "The bar is strained uniformly at every time, with a third of its mass at the struck end; waves \
         are left out."
    }

    fn values(&self, observable: usize, times: &[f64]) -> Result<Vec<f64>, ModelError> {
        let observable = self.line.observable(NAME, observable)?;
        let bar = &self.line.bars[0];
        let travel = bar.travel.expect("finite");
        let stiffness = bar.impedance / travel;
        let share = |at: f64| if self.mirrored { at / travel } else { 1.0 - at / travel };
        let pressed = if self.mirrored { -stiffness } else { stiffness };
        // Factors of the displacement and the velocity of the struck end.
        let factors = self.line.factors(NAME, observable, |of| match of {
            Reading::InBar(Field::Velocity, section) => Ok([0.0, share(*section.distance())]),
            Reading::InBar(Field::Displacement, section) => Ok([share(*section.distance()), 0.0]),
            Reading::InBar(Field::Force, _) => Ok([pressed, 0.0]),
            // Masses alone stand at the struck end.
            Reading::Velocity(_) => Ok([0.0, 1.0]),
            Reading::Displacement(_) => Ok([1.0, 0.0]),
            Reading::Momentum(_) => Err(NotSeen::MomentumOfThird),
            Reading::Compression(_) | Reading::Force(_) => Err(NotSeen::Other),
        })?;
        let value = |time: f64| {
            let (sine, cosine) = (self.frequency * time).sin_cos();
            let [x, v] = [self.start * sine / self.frequency, self.start * cosine];
            if time < 0.0 { 0.0 } else { factors[0] * x + factors[1] * v }
        };
        Ok(self.line.scaled(times)?.into_iter().map(value).collect())
    }
}
