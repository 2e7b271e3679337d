//! The bars of a scene with the waves that enter them, of which fields are made, and what velocities,
//! strains and lengths are in the scale of the scene.

use crate::expression::{Expression, Fraction};
use crate::network::equations::{FieldBars, Network};
use crate::network::error::NetworkError;
use crate::network::measures::unit;
use crate::network::model::bar_roots;
use crate::network::observed::{Entering, Extent, FieldBar};
use crate::recurrence::{Observation, ObservedWave, WaveIndex};
use crate::scene::{Kind, Measure};

impl Network {
    /// The bars with their waves. They are worked out once.
    pub(crate) fn field_bars(&self) -> Result<&FieldBars, NetworkError> {
        let made = self.fields.get_or_init(|| self.clone().into_field_bars().map(Box::new));
        made.as_deref().map_err(NetworkError::clone)
    }

    fn into_field_bars(mut self) -> Result<FieldBars, NetworkError> {
        let places = 0..self.scaled.layout.bars.len();
        let bars = places.map(|place| self.field_bar(place)).collect::<Result<_, _>>()?;
        Ok(FieldBars { network: self, bars })
    }

    fn field_bar(&mut self, place: usize) -> Result<FieldBar, NetworkError> {
        let element = self.scaled.layout.bars[place];
        let Kind::Bar(bar) = &self.scaled.scene.elements[element].kind else {
            unreachable!("a bar of the line")
        };
        let (impedance, _, stiffness) = bar_roots(&bar.body)?;
        let speed = stiffness.over(&impedance)?;
        let scale = &self.scaled.model.scale;
        let in_bar = |measure| unit(scale, measure, Some(&bar.body));
        let units = [
            in_bar(Measure::Velocity)?,
            in_bar(Measure::Strain)?,
            in_bar(Measure::Displacement)?,
            in_bar(Measure::Force)?,
        ];
        let reach = speed.times(&scale.time);
        let ends = self.scaled.layout.ends[place];
        let extent = match ends {
            [Some(_), None] => Extent::ToTheRight,
            [None, Some(_)] => Extent::ToTheLeft,
            _ => Extent::Finite,
        };
        let data = self.scaled.model.bars[&element].clone();
        let waves = self.waves_of(place).map(|wave| wave.map(|(wave, lead)| (wave, -lead)));
        let entering = waves.map(|wave| wave.map(|(wave, delay)| self.entering(wave, &delay)));
        Ok(FieldBar { element, extent, data, entering, units, reach })
    }

    fn entering(&mut self, wave: WaveIndex, delay: &Fraction) -> Entering {
        let integral = self.integral(wave);
        [wave, integral, self.integral(integral)].map(|wave| Observation {
            waves: vec![ObservedWave::new(wave, delay.clone(), &Fraction::one())],
            forcing: Expression::zero(),
        })
    }
}
