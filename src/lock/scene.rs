//! What a scene states of itself, each in one line: title, line, observables, as the language writes them.

use crate::export::expression_text;
use crate::expression::Fraction;
use crate::scene::{Observable, Place, Position, Scene, Seen};
use std::collections::BTreeMap;

/// Title, line and observables of a scene.
pub(super) fn stated(scene: &Scene) -> BTreeMap<String, String> {
    let mut stated = BTreeMap::from([
        ("title".to_owned(), scene.title.trim().to_owned()),
        ("line".to_owned(), line(scene)),
    ]);
    for Observable { name, terms } in &scene.observables {
        let terms: Vec<String> = terms.iter().map(|term| term_text(scene, term)).collect();
        stated.insert(format!("observable {name}"), terms.join(" + ").replace(" + -", " - "));
    }
    stated
}

fn line(scene: &Scene) -> String {
    let mut text = scene.line.left.word().to_owned();
    let names = scene.line.elements.iter().map(|element| scene.elements[*element].name.as_str());
    for (joint, name) in scene.line.joints.iter().zip(names.chain([scene.line.right.word()])) {
        text += &format!(" {} {name}", joint.sign());
    }
    text
}

fn term_text(scene: &Scene, Seen { coefficient, measure, place }: &Seen) -> String {
    let fraction = |value: &Fraction| expression_text(&value.clone().into());
    let name = |element: &usize| &scene.elements[*element].name;
    let metre = if scene.dimensional { " m" } else { "" };
    let place = match place {
        Place::Left(bar) => format!("{}.left", name(bar)),
        Place::Right(bar) => format!("{}.right", name(bar)),
        Place::At(bar, Position::Share(share)) => format!("{}.at({})", name(bar), fraction(share)),
        Place::At(bar, Position::Distance(distance)) => {
            format!("{}.at({}{metre})", name(bar), fraction(distance))
        }
        Place::Element(element) => name(element).clone(),
        Place::Line => "line".to_owned(),
    };
    let factor = match fraction(coefficient) {
        factor if factor == "1" => String::new(),
        factor if factor == "-1" => "-".to_owned(),
        factor if factor.contains(' ') => format!("({factor})*"),
        factor => format!("{factor}*"),
    };
    format!("{factor}{}({place})", measure.word())
}
