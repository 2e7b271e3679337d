//! Scenes as physics: bars, lumped elements, loads, ends, the line that joins them, and what is
//! observed; dimensions of quantities. No text.
//!
//! A [`Scene`] is what the language reads and what the network is built from.

mod check;
mod dimension;
mod element;
mod fault;
mod ideal;
mod observable;

use crate::expression::{Assumptions, Fraction};
use std::collections::BTreeMap;
use wavestep_polynomial::Symbol;

pub use dimension::Dimension;
pub use element::{
    Bar, Body, Drive, Element, ElementIndex, Hertz, Kind, LEAST_EXPONENT_INVERSE, Load, Mass,
    Spring,
};
pub use fault::{Fault, Mistake, Part, Property};
pub use ideal::Ideal;
pub use observable::{Measure, Observable, Place, Position, Seen};

/// A line of bars and lumped elements with what is known and observed of it.
///
/// Displacement and velocity are positive to the right, forces in bars and springs where they
/// compress, strain and stress where they pull. Loads act to the right where they are positive.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Scene {
    pub title: String,
    /// Symbols with their conditions, and factors taken to be non-zero. `pi` is no symbol of a
    /// scene: it is the number.
    pub assumptions: Assumptions,
    /// Whether quantities have units. Without, all of them are plain numbers.
    pub dimensional: bool,
    /// The elements, in the order in which they are declared.
    pub elements: Vec<Element>,
    pub line: Line,
    /// Whether contacts open where they would pull, and close where bodies meet again. Without, all of
    /// them stay closed.
    pub contacts_open: bool,
    pub observables: Vec<Observable>,
    /// The time in loads, in seconds where the scene has units.
    pub time: Symbol,
}

/// Elements from left to right, between two ends.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Line {
    pub left: End,
    /// The elements, each once.
    pub elements: Vec<ElementIndex>,
    /// How they are joined: `joints[0]` is between the left end and the first element, the last one
    /// between the last element and the right end; one more than there are elements.
    pub joints: Vec<Joint>,
    /// How far apart contacts begin that do not touch at the start, by their joints.
    pub gaps: BTreeMap<usize, Fraction>,
    pub right: End,
}

impl Scene {
    /// What is at the left and at the right of a joint of the line, by name: what a load acts on rather than the load.
    pub(crate) fn names_beside(&self, joint: usize) -> [String; 2] {
        let Line { elements, joints, .. } = &self.line;
        let bonded = |end: &Joint| *end == Joint::Bonded;
        let before = joints[..joint].iter().rev().take_while(|own| bonded(own)).count();
        let after = joints[joint + 1..].iter().take_while(|own| bonded(own)).count();
        let left = elements[joint.saturating_sub(before + 1)..joint].iter().rev();
        let right = elements[joint..(joint + after + 1).min(elements.len())].iter();
        let named = |own: &mut dyn Iterator<Item = &ElementIndex>| {
            let own: Vec<&Element> = own.map(|index| &self.elements[*index]).collect();
            let body = own.iter().find(|element| !matches!(element.kind, Kind::Load(_)));
            let named = body.or(own.first());
            named.map_or("wall".to_owned(), |element| element.name.clone())
        };
        [named(&mut { left }), named(&mut { right })]
    }
}

/// An end of a line.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// No force: `X = 0`.
    Free,
    /// No motion: `v = 0`.
    Fixed,
    /// The bar beside it goes on for ever: nothing returns.
    Endless,
}

impl End {
    pub(crate) const ALL: [End; 3] = [End::Free, End::Fixed, End::Endless];

    /// Its name in the language.
    pub(crate) const fn word(self) -> &'static str {
        match self {
            End::Free => "free",
            End::Fixed => "fixed",
            End::Endless => "endless",
        }
    }
}

/// How two neighbours in a line are joined.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Joint {
    /// For good.
    Bonded,
    /// By a contact, which pushes and never pulls. It stays closed, unless the scene says that contacts
    /// open.
    Contact,
}

impl Joint {
    /// Its sign in the language.
    pub(crate) const fn sign(self) -> char {
        match self {
            Joint::Bonded => '-',
            Joint::Contact => '|',
        }
    }
}
