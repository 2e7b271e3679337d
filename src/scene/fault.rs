//! What makes a scene impossible, and which parts of it are involved.

use crate::expression::Fraction;
use crate::scene::ElementIndex;

/// A mistake in a scene with the parts involved, the one to change first.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{}", self.sentence())]
pub struct Fault {
    pub mistake: Mistake,
    /// The parts involved; at least one.
    pub parts: Vec<Part>,
    /// The value whose sign is wrong.
    pub value: Option<Fraction>,
}

impl Fault {
    fn sentence(&self) -> String {
        match (self.mistake, self.parts.first()) {
            (Mistake::NotPositive, Some(Part::Property(_, property))) => {
                format!("{} must be positive", property.words().0)
            }
            (Mistake::Negative, Some(Part::Property(_, property))) => {
                format!("{} may be negative", property.words().0)
            }
            (mistake, _) => mistake.to_string(),
        }
    }
}

/// A part of a scene.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Part {
    Element(ElementIndex),
    Property(ElementIndex, Property),
    /// A position in the line, counted from the left.
    Position(usize),
    Joint(usize),
    Left,
    Right,
    /// The line as a whole.
    Line,
    Term {
        observable: usize,
        term: usize,
    },
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Property {
    Impedance,
    Travel,
    Area,
    Modulus,
    Density,
    Length,
    /// The strain of a bar at the start.
    Strain,
    /// What a bar is taken to be.
    As,
    /// The share of its mass at an end.
    Share,
    Rate,
    Mass,
    Stiffness,
    Damping,
    From,
    Until,
    /// The force of a local contact at its compression.
    Force,
    /// The compression of a local contact at which its force is given.
    Compression,
    Exponent,
}

/// What is wrong with a scene.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Mistake {
    /// An index that points nowhere, or a wrong number of joints.
    #[error("the scene is not well formed")]
    IllFormed,
    /// An element stands twice in the line: here, and there before.
    #[error("an element is in the line twice")]
    Repeated,
    #[error("an element is not in the line")]
    Unused,
    #[error("a property may be zero or negative")]
    NotPositive,
    #[error("a property may be negative")]
    Negative,
    #[error("it has neither stiffness nor damping")]
    NoStiffness,
    #[error("the load may end before it begins")]
    EndsBeforeBegin,
    #[error("the exponent of a local contact must be at least 1/10")]
    ExponentTooSmall,
    /// The exponent of a local contact is larger than
    /// [`MAX_CONTACT_EXPONENT`](crate::limits::MAX_CONTACT_EXPONENT).
    #[error("the exponent of a local contact must be at most 100")]
    ExponentTooLarge,
    #[error("nothing moves in this scene")]
    NothingMoves,
    /// `endless` beside a lumped element.
    #[error("only a bar can be endless")]
    EndlessWithoutBar,
    /// `endless` beside a bar with a length.
    #[error("a bar with a length is not endless")]
    EndlessWithLength,
    /// A bar without length that does not go on for ever.
    #[error("this bar has no length")]
    NoLength,
    #[error("a bar that is endless on both sides has no end")]
    EndlessBothSides,
    #[error("this contact has nothing on its other side")]
    ContactAtEnd,
    /// A lumped element or a load at a place that is fixed.
    #[error("this place is fixed and cannot move")]
    Held,
    /// The width of a gap that may be zero or negative.
    #[error("a gap must be wider than zero")]
    NoGap,
    /// A gap in a scene whose contacts stay closed.
    #[error("contacts that stay closed have no gaps")]
    GapStaysClosed,
    /// A mass behind a contact at a fixed end, that moves at the start.
    #[error("a rigid mass at a wall has to begin at rest")]
    MovesAtWall,
    /// A spring with nothing between it and a free end.
    #[error("this spring has nothing to press against")]
    Idle,
    /// A second imposed velocity at one place.
    #[error("two velocities are imposed at one place")]
    TwoVelocities,
    #[error("this cannot be measured there")]
    NotMeasurable,
    /// Stress of a bar that has no area.
    #[error("this bar has no stress")]
    NoArea,
    /// Strain of a bar that is given by impedance, in a scene with units.
    #[error("this bar has no strain")]
    NoWaveSpeed,
    /// The end at which a bar goes on for ever.
    #[error("the bar is endless on this side")]
    NoSuchEnd,
    #[error("an endless bar has no length, so a fraction of it has no meaning")]
    ShareOfEndless,
    #[error("this section may be outside the bar")]
    OutsideBar,
    #[error("terms of different dimensions cannot be added")]
    MixedDimensions,
    #[error("an endless bar cannot be rigid or a spring")]
    IdealEndless,
    #[error("a bar without waves has no strain at the start")]
    IdealStrained,
    #[error("this bar cannot move")]
    IdealHeld,
    /// An ideal bar that would part from a fixed end.
    #[error("a bar without waves cannot separate from a fixed end")]
    IdealAtWall,
    /// The force in a rigid bar.
    #[error("the force in a rigid bar is unknown")]
    NoForceInRigid,
    /// Work at a section of a bar without waves.
    #[error("what passes a section of a bar without waves is unknown")]
    NoWorkInIdeal,
    /// Energy or momentum of an endless bar that moves or is strained as a whole.
    #[error("this endless bar has infinite energy or momentum from the start")]
    Infinite,
}

impl Property {
    /// What it is called in a sentence, and the words that give it in a text.
    pub(crate) fn words(self) -> (&'static str, &'static [&'static str]) {
        match self {
            Property::Impedance => ("the impedance", &["impedance"]),
            Property::Travel => ("the travel time", &["travel"]),
            Property::Area => ("the area of the section", &["area", "diameter"]),
            Property::Modulus => ("the modulus", &["modulus", "wave_speed"]),
            Property::Density => ("the density", &["density"]),
            Property::Length => ("the length", &["length"]),
            Property::Strain => ("the strain", &["strain"]),
            Property::As => ("what the bar is", &["as"]),
            Property::Share => ("the share of the mass", &["share"]),
            Property::Rate => ("the rate", &["rate"]),
            Property::Mass => ("the mass", &["mass"]),
            Property::Stiffness => ("the stiffness", &["stiffness"]),
            Property::Damping => ("the damping", &["damping"]),
            Property::From => ("the beginning of the load", &["from"]),
            Property::Until => ("the end of the load", &["until"]),
            Property::Force => ("the force", &["force"]),
            Property::Compression => ("the compression", &["compression"]),
            Property::Exponent => ("the exponent", &["exponent"]),
        }
    }
}
