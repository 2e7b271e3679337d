//! The two bars of a scene that meet at a local contact.

use super::error::HertzError;
use super::impact::LongBars;
use super::law::PowerLaw;
use wavestep::ball::Ball;
use wavestep::enclosure::Numbers;
use wavestep::network::{ElementLaw, ScaledScene};
use wavestep::scene::{ElementIndex, End, Kind};

/// A local contact between two bars, and until when waves that return are not felt there.
#[derive(Clone, Debug)]
pub struct ContactOfScene {
    pub element: ElementIndex,
    /// The two bars, as if they were endless, in SI units or plain numbers.
    pub bars: LongBars,
    /// Until when the two bars are certainly as if they were endless: two travel times of a bar whose far
    /// end is free, or fixed and the bar at rest; else one, since what is beyond may send a wave at once.
    /// `None` where both bars are endless.
    pub first_return: Option<Ball>,
}

impl ContactOfScene {
    /// Reads the first local contact of a scene.
    /// Beside it there have to be two bars free of strain, which approach each other.
    pub fn new(scaled: &ScaledScene, precision: u64) -> Result<ContactOfScene, HertzError> {
        let (scene, model) = (scaled.scene(), scaled.model());
        let element = scaled.local_contact().ok_or(HertzError::NoElement)?;
        let line = &scene.line;
        let place = line.elements.iter().position(|other| *other == element);
        let place = place.expect("an element of the line");
        let beside = [place.checked_sub(1), Some(place + 1)];
        let bar = |place: Option<usize>| {
            let index = place.and_then(|place| line.elements.get(place))?;
            let is_bar = matches!(scene.elements[*index].kind, Kind::Bar(_));
            is_bar.then(|| &model.bars[index]).filter(|bar| bar.force.is_zero())
        };
        let [Some(left), Some(right)] = beside.map(bar) else {
            return Err(HertzError::NotBetweenBars);
        };
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
        let approach = &left.velocity - &right.velocity;
        let bars = LongBars::new(
            PowerLaw::new(exponent.clone())?,
            (in_unit(force, &unit_of_force?)?, in_unit(compression, &length?)?),
            [in_unit(&left.impedance, &impedance)?, in_unit(&right.impedance, &impedance)?],
            in_unit(&approach, &velocity?)?,
            precision,
        )?;
        // From a free end only what was sent comes back; anything else may send something at once.
        let ends = [(place.checked_sub(2), line.left), (Some(place + 2), line.right)];
        let mut first_return: Option<Ball> = None;
        for (bar, (beyond, end)) in [left, right].into_iter().zip(ends) {
            let Some(travel) = &bar.travel else { continue };
            let is_last = beyond.is_none_or(|place| place >= line.elements.len());
            let is_quiet = match end {
                End::Free => true,
                End::Fixed => bar.velocity.is_zero(),
                End::Endless => false,
            };
            let way = if is_last && is_quiet { travel + travel } else { travel.clone() };
            let felt = in_unit(&way, &time)?;
            if first_return.as_ref().is_none_or(|known| felt.is_below(known)) {
                first_return = Some(felt);
            }
        }
        Ok(ContactOfScene { element, bars, first_return })
    }
}
