//! What a recurrence or a scene states of itself, each in one line, as the language writes it.

use crate::enclosure::Numbers;
use crate::export::expression_text;
use crate::expression::Fraction;
use crate::network::Network;
use crate::recurrence::{Observation, ProductTerm, Quadratic, Statement};
use crate::scene::{Bar, Body, Kind, Observable, Place, Position, Scene, Seen};
use std::collections::BTreeMap;

/// The digits of a period that is told as a decimal number, and bits for so many.
const PERIOD_DIGITS: usize = 20;
const PERIOD_BITS: u64 = 192;

/// Title, period, symbols and observables of a recurrence.
pub(super) fn of_recurrence(statement: &Statement) -> BTreeMap<String, String> {
    let mut stated = BTreeMap::from([
        ("title".to_owned(), statement.title.trim().to_owned()),
        ("period".to_owned(), fraction(&statement.period)),
    ]);
    for (symbol, condition) in statement.assumptions.symbols() {
        let condition = condition.map_or_else(|| "any".to_owned(), ToString::to_string);
        stated.insert(format!("symbol {symbol}"), condition);
    }
    for observable in &statement.observables {
        let seen = observed(&observable.observation, statement);
        stated.insert(format!("observable {}", observable.name), seen);
    }
    for Quadratic { name, terms, .. } in &statement.quadratics {
        let term = |ProductTerm { coefficient, factors }: &ProductTerm| {
            let texts = factors.iter().map(|own| {
                let text = observed(own, statement);
                let is_single = own.waves.len() == 1 && own.forcing.is_zero();
                let stands_alone = factors.len() == 1 || is_single && !text.starts_with('-');
                if stands_alone { text } else { grouped(text) }
            });
            factor(fraction(coefficient)) + &texts.collect::<Vec<_>>().join("*")
        };
        let terms: Vec<String> = terms.iter().map(term).collect();
        stated.insert(format!("observable {name}"), sum(&terms));
    }
    stated
}

/// Title, line and observables of a scene on a lattice, and the periods of that: exactly where they are rational.
pub(super) fn of_lattice(network: &Network) -> BTreeMap<String, String> {
    let numbers = Numbers::new(&network.model().constants);
    let mut stated = of_scene(network.scene());
    for (number, period) in (1..).zip(network.lattice().periods()) {
        let told = match (period.as_constant(), numbers.enclose(period, PERIOD_BITS)) {
            (None, Ok(ball)) => ball.to_decimal(PERIOD_DIGITS).midpoint().to_string(),
            _ => fraction(period),
        };
        stated.insert(format!("period {number}"), told);
    }
    stated
}

/// `f(t) - 2*f'(t - mu) + forcing`, in the order of the statement.
fn observed(observation: &Observation, statement: &Statement) -> String {
    let time = &statement.time;
    let mut terms: Vec<String> = Vec::new();
    for seen in &observation.waves {
        let (wave, prime) = (&statement.waves[seen.wave], if seen.slope { "'" } else { "" });
        let since = match (seen.delay.is_zero(), fraction(&-&seen.delay)) {
            (true, _) => time.to_string(),
            (false, early) if !early.contains(' ') && !early.starts_with('-') => {
                format!("{time} + {early}")
            }
            _ => format!("{time} - {}", grouped(fraction(&seen.delay))),
        };
        let factor = factor(expression_text(&seen.coefficient));
        terms.push(format!("{factor}{wave}{prime}({since})"));
    }
    if !observation.forcing.is_zero() || terms.is_empty() {
        terms.push(expression_text(&observation.forcing));
    }
    sum(&terms)
}

/// Title, line and observables of a scene.
pub(super) fn of_scene(scene: &Scene) -> BTreeMap<String, String> {
    let mut stated = BTreeMap::from([
        ("title".to_owned(), scene.title.trim().to_owned()),
        ("line".to_owned(), line(scene)),
    ]);
    for Observable { name, terms } in &scene.observables {
        let terms: Vec<String> = terms.iter().map(|term| term_text(scene, term)).collect();
        stated.insert(format!("observable {name}"), sum(&terms));
    }
    stated
}

fn line(scene: &Scene) -> String {
    let mut text = scene.line.left.word().to_owned();
    let names = scene.line.elements.iter().map(|element| scene.elements[*element].name.as_str());
    let names = names.chain([scene.line.right.word()]);
    for ((place, joint), name) in scene.line.joints.iter().enumerate().zip(names) {
        let metre = if scene.dimensional { " m" } else { "" };
        let gap = scene.line.gaps.get(&place);
        let gap = gap.map_or_else(String::new, |gap| format!("{}{metre}|", fraction(gap)));
        text += &format!(" {}{gap} {name}", joint.sign());
    }
    text
}

fn term_text(scene: &Scene, Seen { coefficient, measure, place, .. }: &Seen) -> String {
    let name = |element: &usize| &scene.elements[*element].name;
    let unit = |bar: &usize| match &scene.elements[*bar].kind {
        _ if !scene.dimensional => "",
        Kind::Bar(Bar { body: Body::Impedance { .. }, .. }) => " s",
        _ => " m",
    };
    let place = match place {
        Place::Left(bar) => format!("{}.left", name(bar)),
        Place::Right(bar) => format!("{}.right", name(bar)),
        Place::At(bar, Position::Share(share)) => format!("{}.at({})", name(bar), fraction(share)),
        Place::At(bar, Position::Distance(distance)) => {
            format!("{}.at({}{})", name(bar), fraction(distance), unit(bar))
        }
        Place::Element(element) => name(element).clone(),
        Place::Line => "line".to_owned(),
    };
    format!("{}{}({place})", factor(fraction(coefficient)), measure.word())
}

fn fraction(value: &Fraction) -> String {
    expression_text(&value.into())
}

/// A sum in brackets.
fn grouped(text: String) -> String {
    if text.contains(' ') { format!("({text})") } else { text }
}

/// A coefficient before a quantity; 1 is left out.
fn factor(coefficient: String) -> String {
    match &*coefficient {
        "1" => String::new(),
        "-1" => "-".to_owned(),
        _ => grouped(coefficient) + "*",
    }
}

fn sum(terms: &[String]) -> String {
    terms.join(" + ").replace(" + -", " - ")
}
