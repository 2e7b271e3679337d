//! Two bars, or a bar and a wall, that run into each other at a local contact.

use crate::expression::Fraction;
use crate::network::scaled::ScaledScene;
use crate::scene::{ElementIndex, End, Kind};

/// What meets at a local contact. As long as nothing returns to it, `α' = V − X Σ 1/Z`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Impact {
    pub contact: ElementIndex,
    /// The impedances of the bars beside the contact; a wall yields nothing.
    pub impedances: Vec<Fraction>,
    /// V, the velocity at which they approach each other at the start.
    pub approach: Fraction,
    /// The finite bars beside the contact, and until when certainly nothing returns from beyond: two travel times of a
    /// bar whose far end is free, or fixed and the bar at rest; else one, since what is beyond may send a wave at once.
    pub returns: Vec<(ElementIndex, Fraction)>,
}

/// Why there is no closed form of a first contact.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NoClosedForm {
    #[error(
        "it is next to `{0}`. Only between bars, or a bar and a wall, is its equation α' = V − X/Z, which an integral \
         solves"
    )]
    Beside(String),
    #[error("`{0}` is strained at the start, so waves reach the contact from the beginning")]
    Strained(String),
    #[error("the bodies next to it may not approach each other at the start")]
    NotClosing,
}

impl Impact {
    /// At a local contact of the line.
    ///
    /// # Panics
    /// If the line has no such element.
    pub fn of(scaled: &ScaledScene, contact: ElementIndex) -> Result<Impact, NoClosedForm> {
        let (scene, model) = (scaled.scene(), scaled.model());
        let line = &scene.line;
        let name = |index: &ElementIndex| scene.elements[*index].name.clone();
        let place = line.elements.iter().position(|other| *other == contact);
        let place = place.expect("an element of the line");
        let mut impact = Impact {
            contact,
            impedances: Vec::new(),
            approach: Fraction::zero(),
            returns: Vec::new(),
        };
        let after = |steps: usize| line.elements.get(place + steps);
        let before = |steps: usize| place.checked_sub(steps).map(|place| &line.elements[place]);
        let left = (before(1), before(2), line.left);
        let right = (after(1), after(2), line.right);
        for (side, (beside, beyond, end)) in [left, right].into_iter().enumerate() {
            // A wall does not move.
            let Some(index) = beside else { continue };
            if !matches!(scene.elements[*index].kind, Kind::Bar(_)) {
                return Err(NoClosedForm::Beside(name(index)));
            }
            let bar = &model.bars[index];
            if !bar.force.is_zero() {
                return Err(NoClosedForm::Strained(name(index)));
            }
            impact.impedances.push(bar.impedance.clone());
            impact.approach = match side {
                0 => bar.velocity.clone(),
                _ => &impact.approach - &bar.velocity,
            };
            let is_quiet = match end {
                End::Free => true,
                End::Fixed => bar.velocity.is_zero(),
                End::Endless => false,
            };
            if let Some(travel) = &bar.travel {
                let is_echo = beyond.is_none() && is_quiet;
                let way = if is_echo { travel + travel } else { travel.clone() };
                impact.returns.push((*index, way));
            }
        }
        Ok(impact)
    }
}
