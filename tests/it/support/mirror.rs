//! Scenes seen from behind.

use wavestep::expression::Fraction;
use wavestep::scene::{Kind, Measure, Place, Position, Scene};

/// The scene seen from behind: the line reversed, velocities and loads the other way.
pub fn mirrored(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    std::mem::swap(&mut scene.line.left, &mut scene.line.right);
    scene.line.elements.reverse();
    scene.line.joints.reverse();
    for element in &mut scene.elements {
        match &mut element.kind {
            Kind::Bar(bar) => bar.velocity = -&bar.velocity,
            Kind::Mass(mass) => mass.velocity = -&mass.velocity,
            Kind::Load(load) => load.course = -&load.course,
            _ => {}
        }
    }
    let finite: Vec<bool> = (scene.elements.iter())
        .map(|element| matches!(&element.kind, Kind::Bar(bar) if !bar.is_endless()))
        .collect();
    let lengths: Vec<_> = (scene.elements.iter())
        .map(|element| match &element.kind {
            Kind::Bar(bar) => bar.extent().cloned(),
            _ => None,
        })
        .collect();
    let supports: Vec<bool> =
        scene.elements.iter().map(|element| matches!(element.kind, Kind::Support(_))).collect();
    for seen in scene.observables.iter_mut().flat_map(|observable| &mut observable.terms) {
        let turns = match seen.measure {
            Measure::Velocity | Measure::Displacement | Measure::Momentum => true,
            Measure::Force => seen.place.element().is_some_and(|element| supports[element]),
            _ => false,
        };
        if turns {
            seen.coefficient = -&seen.coefficient;
        }
        let one = Fraction::one();
        seen.place = match seen.place.clone() {
            Place::Left(bar) => Place::Right(bar),
            Place::Right(bar) => Place::Left(bar),
            Place::At(bar, Position::Share(share)) => {
                Place::At(bar, Position::Share(&one - &share))
            }
            Place::At(bar, Position::Distance(distance)) if finite[bar] => {
                let length = lengths[bar].as_ref().expect("a length");
                Place::At(bar, Position::Distance(length - &distance))
            }
            place => place,
        };
    }
    scene
}
