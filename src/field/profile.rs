//! Fields along a bar as a person would draw them: exact at the fronts, from both sides.

use super::evaluator::{MeshPoint, delays};
use super::wave::{Entering, Heading};
use super::{FieldError, FieldEvaluator};
use crate::expression::Fraction;
use crate::network::Extent;
use crate::signal::EvaluateError;
use wavestep_polynomial::Rational;

/// The fields along a bar at a time, in stretches between fronts.
///
/// # Invariants
/// - stretches ascend, each from one front to the next, or to an end of the bar.
#[derive(Clone, PartialEq, Debug)]
pub struct Profile {
    /// The name of the bar.
    pub name: String,
    /// Its length; of an endless bar, the length that is drawn.
    pub length: f64,
    /// Places as distances from the left end, or from the end of an endless bar, ascending; with the
    /// fields there, by the places of [`Quantity::ALL`](super::Quantity::ALL).
    pub stretches: Vec<Vec<(f64, [f64; 4])>>,
}

impl FieldEvaluator<'_> {
    /// The fields along all bars, at about `points` places of each. Of an endless bar as much is drawn as
    /// the others are long together, or as waves have reached by the last time.
    pub fn profiles(&self, time: &Rational, points: usize) -> Result<Vec<Profile>, FieldError> {
        if *time < Rational::default() {
            return Err(FieldError::Negative(time.clone()));
        }
        if *time > self.last {
            return Err(EvaluateError::AfterLast.into());
        }
        (0..self.bars.len()).map(|bar| self.profile(bar, time, points)).collect()
    }

    fn profile(
        &self,
        bar_place: usize,
        time: &Rational,
        points: usize,
    ) -> Result<Profile, FieldError> {
        let bar = &self.bars[bar_place];
        let at = self.network().scaled_time(time);
        let (span, length) = self.drawn_span(bar, &self.last)?;
        let mut profile =
            Profile { name: self.name(bar).to_owned(), length, stretches: Vec::new() };
        if span.is_zero() {
            return Ok(profile);
        }
        // The delay of a place, from the end where x is zero.
        let mut places = vec![Fraction::zero(), span.clone()];
        for heading in [Heading::Right, Heading::Left] {
            let grows = heading == Heading::Right || bar.extent == Extent::ToTheLeft;
            let wave = Entering { bar: bar_place, heading };
            for entered in self.waves.fronts(wave, [&(&at - &span), &at])? {
                let delay = &at - &entered;
                places.push(if grows { delay } else { &span - &delay });
            }
        }
        let mut places = self.waves.numbers.sorted(places, |place| place)?;
        places.dedup();
        let whole = self.double_of(&span)?;
        for pair in places.windows(2) {
            let part = &pair[1] - &pair[0];
            let share = self.double_of(&part)? / whole;
            let count = ((share * points as f64).ceil() as usize).max(2);
            let place = |i: usize| &pair[0] + &part.scale(&Rational::new(i.into(), count.into()));
            let nodes: Vec<MeshPoint> = (0..=count)
                .map(|i| {
                    let delays = delays(bar, &span, place(i));
                    MeshPoint { delays, from_larger: i < count, is_drawn: true }
                })
                .collect();
            let (found, bits) = self.fine(|bits| self.at_points(bar_place, &at, &nodes, bits))?;
            let values = self.in_units(bar, &found, bits)?;
            let mut stretch = Vec::with_capacity(nodes.len());
            for i in 0..=count {
                let x = self.double_of(&place(i))? / whole * length;
                stretch.push((x, values.each_ref().map(|values| values[i].value)));
            }
            profile.stretches.push(stretch);
        }
        Ok(profile)
    }
}
