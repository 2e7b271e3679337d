//! The bars of a scene that meet at a local contact.

use super::error::HertzError;
use super::impact::LongBars;
use super::law::PowerLaw;
use wavestep::ball::Ball;
use wavestep::enclosure::Numbers;
use wavestep::network::{ElementLaw, Impact, ScaledScene};
use wavestep::scene::ElementIndex;

/// A local contact between two bars, and until when waves that return are not felt there.
#[derive(Clone, Debug)]
pub struct ContactOfScene {
    pub element: ElementIndex,
    /// The bars, as if they were endless, in SI units or plain numbers.
    pub bars: LongBars,
    /// Until when the bars are certainly as if they were endless, by [`Impact::returns`]; `None` where they are.
    pub first_return: Option<Ball>,
}

impl ContactOfScene {
    /// Reads the first local contact of a scene.
    /// Beside it there have to be two bars free of strain, or one and a wall, which approach each other.
    pub fn new(scaled: &ScaledScene, precision: u64) -> Result<ContactOfScene, HertzError> {
        let model = scaled.model();
        let element = scaled.local_contact().ok_or(HertzError::NoElement)?;
        let impact = Impact::of(scaled, element).map_err(|_| HertzError::NotBetweenBars)?;
        let ElementLaw::LocalContact { force, compression, exponent } = &model.lumps[&element]
        else {
            unreachable!("the lump of a local contact");
        };
        let bits = precision + 32;
        let numbers = Numbers::new(&model.constants);
        let scale = &model.scale;
        let units = [
            &scale.impedance,
            &scale.velocity,
            &scale.force(),
            &scale.velocity.times(&scale.time),
            &scale.time,
        ];
        let units = units.map(|unit| numbers.enclose_root(unit, bits));
        let [impedance, velocity, unit_of_force, length, time] = units;
        let in_unit = |value: &wavestep::expression::Fraction, unit: &Ball| {
            Ok::<Ball, HertzError>(numbers.enclose(value, bits)?.multiply(unit, bits))
        };
        let (impedance, time) = (impedance?, time?);
        let impedances: Result<Vec<Ball>, _> =
            impact.impedances.iter().map(|own| in_unit(own, &impedance)).collect();
        let bars = LongBars::new(
            PowerLaw::new(exponent.clone())?,
            (in_unit(force, &unit_of_force?)?, in_unit(compression, &length?)?),
            &impedances?,
            in_unit(&impact.approach, &velocity?)?,
            precision,
        )?;
        let mut first_return: Option<Ball> = None;
        for (_, way) in &impact.returns {
            let felt = in_unit(way, &time)?;
            if first_return.as_ref().is_none_or(|known| felt.is_below(known)) {
                first_return = Some(felt);
            }
        }
        Ok(ContactOfScene { element, bars, first_return })
    }
}
