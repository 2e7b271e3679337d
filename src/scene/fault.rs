//! What makes a scene impossible, and which parts of it are involved.

use std::fmt;

use crate::scene::ElementIndex;

/// A mistake in a scene with the parts involved, the one to change first.
///
/// ```
/// use wavestep::language::{Source, read_scene};
/// use wavestep::scene::{Body, Fault, Kind, Mistake, Part, Property};
///
/// let text = "scene \"A\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nline free - rod - fixed";
/// let mut scene = read_scene(&Source::new("rod.wave", text)?, &Default::default()).unwrap();
/// assert_eq!(scene.faults(), []);
/// let Kind::Bar(bar) = &mut scene.elements[0].kind else { panic!("a bar") };
/// let Body::Impedance { travel, .. } = &mut bar.body else { panic!("by impedance") };
/// *travel = Some(wavestep::expression::Fraction::zero());
/// let Fault { mistake, parts } = &scene.faults()[0];
/// assert_eq!((mistake, &parts[..]), (&Mistake::NotPositive, &[Part::Property(0, Property::Travel)][..]));
/// assert_eq!(scene.faults()[0].to_string(), "the travel time is not certainly positive");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fault {
    /// What is wrong.
    pub mistake: Mistake,
    /// The parts involved; at least one.
    pub parts: Vec<Part>,
}

/// A part of a scene.
///
/// ```
/// use wavestep::scene::{Part, Property};
///
/// assert_ne!(Part::Element(0), Part::Property(0, Property::Length));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Part {
    /// An element as declared.
    Element(ElementIndex),
    /// A property of an element.
    Property(ElementIndex, Property),
    /// A position in the line, counted from the left.
    Position(usize),
    /// A joint of the line.
    Joint(usize),
    /// The left end of the line.
    Left,
    /// The right end of the line.
    Right,
    /// The line as a whole.
    Line,
    /// A term of an observable.
    Term {
        /// Which observable.
        observable: usize,
        /// Which of its terms.
        term: usize,
    },
}

/// A property of an element. `Display` names it.
///
/// ```
/// use wavestep::scene::Property;
///
/// assert_eq!(Property::Travel.to_string(), "the travel time");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Property {
    /// The impedance of a bar.
    Impedance,
    /// The travel time of a bar.
    Travel,
    /// The area of a bar's section.
    Area,
    /// Young's modulus.
    Modulus,
    /// The density of a bar.
    Density,
    /// The length of a bar.
    Length,
    /// The strain of a bar at the start.
    Strain,
    /// The mass of a mass.
    Mass,
    /// The stiffness of a spring or a support.
    Stiffness,
    /// The damping of a spring or a support.
    Damping,
    /// When a load begins.
    From,
    /// When a load ends.
    Until,
    /// The force of a local contact at its compression.
    Force,
    /// The compression of a local contact at which its force is given.
    Compression,
    /// The exponent of a local contact.
    Exponent,
}

/// What is wrong with a scene.
///
/// ```
/// use wavestep::scene::Mistake;
///
/// assert_eq!(Mistake::NothingMoves.to_string(), "nothing moves in this scene");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Mistake {
    /// An index that points nowhere, or a wrong number of joints.
    IllFormed,
    /// An element stands twice in the line: here, and there before.
    Repeated,
    /// An element stands nowhere in the line.
    Unused,
    /// A property that must be positive may be zero or negative.
    NotPositive,
    /// A property that must not be negative may be.
    Negative,
    /// A spring or support with neither stiffness nor damping.
    NoStiffness,
    /// A load may end before it begins.
    EndsBeforeBegin,
    /// The exponent of a local contact is below 1/10.
    ExponentTooSmall,
    /// The exponent of a local contact is larger than
    /// [`MAX_EXPONENT`](crate::scene::MAX_EXPONENT).
    ExponentTooLarge,
    /// No initial velocity, no strain, and no load.
    NothingMoves,
    /// `endless` beside a lumped element.
    EndlessWithoutBar,
    /// `endless` beside a bar with a length.
    EndlessWithLength,
    /// A bar without length that does not go on for ever.
    NoLength,
    /// One bar endless on both sides.
    EndlessBothSides,
    /// A contact with a free or endless end.
    ContactAtEnd,
    /// A lumped element or a load at a place that is fixed.
    Held,
    /// A spring with nothing between it and a free end.
    Idle,
    /// A second imposed velocity at one place.
    TwoVelocities,
    /// A measure that this place does not have.
    NotMeasurable,
    /// Stress of a bar that has no area.
    NoArea,
    /// Strain of a bar that is given by impedance, in a scene with units.
    NoWaveSpeed,
    /// The end at which a bar goes on for ever.
    NoSuchEnd,
    /// A share of the length of an endless bar.
    ShareOfEndless,
    /// A section that may lie outside the bar.
    OutsideBar,
    /// Terms of different dimensions.
    MixedDimensions,
    /// Energy or momentum of an endless bar that moves or is strained as a whole.
    Infinite,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.mistake, self.parts.first()) {
            (Mistake::NotPositive, Some(Part::Property(_, property))) => {
                write!(f, "{property} is not certainly positive")
            }
            (Mistake::Negative, Some(Part::Property(_, property))) => {
                write!(f, "{property} may be negative")
            }
            (mistake, _) => mistake.fmt(f),
        }
    }
}

impl std::error::Error for Fault {}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Property::Impedance => "the impedance",
            Property::Travel => "the travel time",
            Property::Area => "the area of the section",
            Property::Modulus => "the modulus",
            Property::Density => "the density",
            Property::Length => "the length",
            Property::Strain => "the strain",
            Property::Mass => "the mass",
            Property::Stiffness => "the stiffness",
            Property::Damping => "the damping",
            Property::From => "the beginning of the load",
            Property::Until => "the end of the load",
            Property::Force => "the force",
            Property::Compression => "the compression",
            Property::Exponent => "the exponent",
        })
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Mistake::IllFormed => "the scene is not well formed",
            Mistake::Repeated => "an element stands in the line twice",
            Mistake::Unused => "an element does not stand in the line",
            Mistake::NotPositive => "a property is not certainly positive",
            Mistake::Negative => "a property may be negative",
            Mistake::NoStiffness => "it has neither stiffness nor damping",
            Mistake::EndsBeforeBegin => "the load does not certainly end after it begins",
            Mistake::ExponentTooSmall => "the exponent of a local contact is at least 1/10",
            Mistake::ExponentTooLarge => "the exponent of a local contact is at most 100",
            Mistake::NothingMoves => "nothing moves in this scene",
            Mistake::EndlessWithoutBar => "only a bar can go on for ever",
            Mistake::EndlessWithLength => "a bar with a length does not go on for ever",
            Mistake::NoLength => "this bar has no length",
            Mistake::EndlessBothSides => "a bar that is endless on both sides has no end",
            Mistake::ContactAtEnd => "there is nothing to be in contact with",
            Mistake::Held => "what is fixed cannot move",
            Mistake::Idle => "this spring has nothing to press against",
            Mistake::TwoVelocities => "two velocities are imposed at one place",
            Mistake::NotMeasurable => "this cannot be measured there",
            Mistake::NoArea => "this bar has no stress",
            Mistake::NoWaveSpeed => "this bar has no strain",
            Mistake::NoSuchEnd => "the bar goes on for ever on this side",
            Mistake::ShareOfEndless => "an endless bar has no length to take a share of",
            Mistake::OutsideBar => "this section may lie outside the bar",
            Mistake::MixedDimensions => "terms of different dimensions cannot be added",
            Mistake::Infinite => "what an endless bar holds from the start is infinite",
        })
    }
}
