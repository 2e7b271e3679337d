//! The fields in the bars of a scene, as waves: what a wave is called, how far its clock is ahead, and
//! what velocities, strains and lengths are in its scale.

use crate::expression::{Fraction, Root};
use crate::network::equations::{Network, Role};
use crate::network::error::NetworkError;
use crate::network::measures::unit;
use crate::network::model::{ModelBar, bar_roots};
use crate::recurrence::WaveIndex;
use crate::scene::{ElementIndex, Kind, Measure};

/// One of the two waves of a bar.
#[derive(Clone, Debug)]
pub(crate) struct Way {
    /// The wave, its integral over time, and the integral of that.
    pub waves: [WaveIndex; 3],
    /// How far its clock is ahead.
    pub lead: Fraction,
}

/// Where a bar ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Extent {
    /// At both ends.
    Finite,
    /// At the left end only.
    ToTheRight,
    /// At the right end only.
    ToTheLeft,
}

/// A bar with its waves, in the scales of the scene.
#[derive(Clone, Debug)]
pub(crate) struct FieldBar {
    pub element: ElementIndex,
    pub extent: Extent,
    pub data: ModelBar,
    /// The wave to the right, which is seen at the left end first.
    pub right: Option<Way>,
    /// The wave to the left.
    pub left: Option<Way>,
    /// The units of velocity, strain, displacement and force, in those of the user.
    pub units: [Root; 4],
    /// The way of a wave in a time of 1.
    pub reach: Root,
}

impl Network {
    /// The bars from left to right. Integrals of their waves are followed from now on.
    pub(crate) fn field_bars(&mut self) -> Result<Vec<FieldBar>, NetworkError> {
        let mut bars = Vec::new();
        for (place, element) in self.scaled.layout.bars.clone().into_iter().enumerate() {
            let Kind::Bar(bar) = &self.scaled.scene.elements[element].kind else {
                unreachable!("a bar of the line")
            };
            let (impedance, _, stiffness) = bar_roots(&bar.body)?;
            let speed = stiffness.over(&impedance)?;
            let scale = self.scaled.model.scale.clone();
            let in_bar = |measure| unit(&scale, measure, Some(&bar.body));
            let units = [
                in_bar(Measure::Velocity)?,
                in_bar(Measure::Strain)?,
                in_bar(Measure::Displacement)?,
                in_bar(Measure::Force)?,
            ];
            let [left, right] = self.scaled.layout.ends[place];
            let extent = match (left, right) {
                (Some(_), None) => Extent::ToTheRight,
                (None, Some(_)) => Extent::ToTheLeft,
                _ => Extent::Finite,
            };
            bars.push(FieldBar {
                element,
                extent,
                data: self.scaled.model.bars[&element].clone(),
                right: self.way(Role::Right(element), left),
                left: self.way(Role::Left(element), right),
                units,
                reach: speed.times(&scale.time),
            });
        }
        Ok(bars)
    }

    fn way(&mut self, role: Role, node: Option<usize>) -> Option<Way> {
        let (wave, lead) = (self.wave(role)?, self.clocks.leads[node?].clone());
        let integral = self.integral(wave);
        Some(Way { waves: [wave, integral, self.integral(integral)], lead })
    }
}
