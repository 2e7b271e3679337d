//! Energies and momenta that nothing changes.
//!
//! What a part of the line holds changes by what flows through its ends and by what acts within it: by the
//! power `X v` and the loss in dampers, or by the force `X`. In a sum over the whole line with one
//! coefficient all that flows from one element to the next cancels. At an open contact `X = 0`, at a closed
//! one both sides move together; bars and springs give way, so that no motion is lost where these meet.

use crate::expression::Fraction;
use crate::network::measures::MeasuredValue;
use crate::network::node::ElementLaw;
use crate::network::observed::{ObservedValue, Squared, Window};
use crate::network::reading::Reading;
use crate::network::scaled::ScaledScene;
use crate::scene::{ElementIndex, End, Kind, Measure, Observable, Scene};

/// Whether the balance of an observable says that it keeps its value for ever.
pub(super) fn is_conserved(scene: &Scene, observable: &Observable) -> bool {
    let Some(measure) = observable.terms.first().map(|seen| seen.measure) else { return false };
    if observable.terms.iter().any(|seen| seen.measure != measure) {
        return false;
    }
    let coefficient = |element: &ElementIndex| {
        let mut sum = Fraction::zero();
        for seen in &observable.terms {
            if seen.place.element().is_none_or(|own| own == *element) {
                sum = &sum + &seen.coefficient;
            }
        }
        sum
    };
    let elements = &scene.line.elements;
    let coefficients: Vec<Fraction> = elements.iter().map(coefficient).collect();
    if coefficients.iter().any(|own| *own != coefficients[0]) {
        return false;
    }
    let kinds = || elements.iter().map(|element| &scene.elements[*element].kind);
    match measure {
        Measure::Energy => !kinds().any(acts) && !is_rigid(scene, kinds()),
        Measure::Momentum => {
            let is_fixed = [scene.line.left, scene.line.right].contains(&End::Fixed);
            !is_fixed && !kinds().any(|kind| matches!(kind, Kind::Load(_) | Kind::Support(_)))
        }
        _ => false,
    }
}

/// Whether an element adds energy to the line, or takes it away.
fn acts(kind: &Kind) -> bool {
    match kind {
        Kind::Load(_) => true,
        Kind::Spring(spring) | Kind::Support(spring) => !spring.damping.is_zero(),
        Kind::Bar(_) | Kind::Mass(_) | Kind::Hertz(_) => false,
    }
}

/// Whether two masses, or a mass and a wall, have nothing between them that gives way: where they meet,
/// energy is lost at once.
fn is_rigid<'a>(scene: &Scene, kinds: impl Iterator<Item = &'a Kind>) -> bool {
    let is_wall = |end| usize::from(end == End::Fixed);
    let mut met = is_wall(scene.line.left);
    for kind in kinds {
        match kind {
            Kind::Bar(_) | Kind::Spring(_) | Kind::Hertz(_) => met = 0,
            Kind::Mass(_) => met += 1,
            Kind::Support(_) | Kind::Load(_) => {}
        }
        if met > 1 {
            return true;
        }
    }
    met + is_wall(scene.line.right) > 1
}

/// A momentum or an energy that is conserved, as at the start, when springs are relaxed.
pub(super) fn at_start(
    scaled: &ScaledScene,
    value: &MeasuredValue,
    parts: &ObservedValue,
) -> Fraction {
    let mut sum = Fraction::zero();
    if let MeasuredValue::Linear(terms) = value {
        for term in terms {
            sum = &sum + &(&term.coefficient * &reading_at_start(scaled, &term.of));
        }
    }
    if let ObservedValue::Energy(parts) = parts {
        for part in parts {
            let square = match (&part.window, &part.squared) {
                (Window::Last(travel), _) => &part.before.pow(2) * travel,
                (Window::Now, Squared::Reading(own)) => reading_at_start(scaled, own).pow(2),
                (Window::Now | Window::Always, _) => Fraction::zero(),
            };
            sum = &sum + &(&part.coefficient * &square);
        }
    }
    sum
}

fn reading_at_start(scaled: &ScaledScene, reading: &Reading) -> Fraction {
    match reading {
        Reading::Momentum(bar) => {
            let bar = &scaled.model.bars[&scaled.layout.bars[*bar]];
            let held = bar.travel.as_ref().map(|travel| &bar.impedance * travel);
            held.map_or_else(Fraction::zero, |held| &held * &bar.velocity)
        }
        Reading::Velocity(face) => {
            let lump = face.lump();
            match &scaled.layout.nodes[lump.node].elements[lump.place].law {
                ElementLaw::Mass { velocity, .. } => velocity.clone(),
                _ => Fraction::zero(),
            }
        }
        _ => Fraction::zero(),
    }
}
