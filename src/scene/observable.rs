//! What is observed, and where.

use crate::expression::Fraction;
use crate::scene::dimension::Dimension;
use crate::scene::element::ElementIndex;

/// A named quantity to observe: a sum of measures.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Observable {
    pub name: String,
    /// Its terms, all of one dimension.
    pub terms: Vec<Seen>,
}

/// One term of an observable: a coefficient times what is measured at a place.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Seen {
    pub coefficient: Fraction,
    /// The dimension of the coefficient: none in texts, where it is a plain number.
    pub dimension: Dimension,
    pub measure: Measure,
    pub place: Place,
}

impl Seen {
    /// The dimension of the term.
    pub fn dimension(&self) -> Dimension {
        self.measure.dimension().times(self.dimension)
    }
}

/// What is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Measure {
    /// Of a section or a mass.
    Velocity,
    /// The compressive force in a section, a spring or a local contact; of a support that of the line on it,
    /// `d v + k u`, positive to the right.
    Force,
    /// Positive where it pulls.
    Strain,
    /// Positive where it pulls.
    Stress,
    /// Since the start.
    Displacement,
    /// Of a spring or a local contact, since the start; where a contact is open, minus the gap.
    Compression,
    /// Of a bar, a mass, a spring, a support, or of the whole line.
    Energy,
    /// Of a bar, a mass, or of the whole line.
    Momentum,
    /// The energy that has passed a section to the right since the start, `∫ X v dt`; of a spring, a local contact or a
    /// support the work done on it, of a load the work that it has done.
    Work,
}

impl Measure {
    pub(crate) const ALL: [Measure; 9] = [
        Measure::Velocity,
        Measure::Force,
        Measure::Strain,
        Measure::Stress,
        Measure::Displacement,
        Measure::Compression,
        Measure::Energy,
        Measure::Momentum,
        Measure::Work,
    ];

    const fn word_and_dimension(self) -> (&'static str, Dimension) {
        match self {
            Measure::Velocity => ("velocity", Dimension::VELOCITY),
            Measure::Force => ("force", Dimension::FORCE),
            Measure::Strain => ("strain", Dimension::NONE),
            Measure::Stress => ("stress", Dimension::PRESSURE),
            Measure::Displacement => ("displacement", Dimension::LENGTH),
            Measure::Compression => ("compression", Dimension::LENGTH),
            Measure::Energy => ("energy", Dimension::ENERGY),
            Measure::Momentum => ("momentum", Dimension::MOMENTUM),
            Measure::Work => ("work", Dimension::ENERGY),
        }
    }

    /// Its name in the language.
    pub const fn word(self) -> &'static str {
        self.word_and_dimension().0
    }

    pub const fn dimension(self) -> Dimension {
        self.word_and_dimension().1
    }

    /// Whether it is an energy, which is not linear in the motion.
    pub const fn is_energy(self) -> bool {
        matches!(self, Measure::Energy | Measure::Work)
    }
}

/// Where it is measured.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Place {
    /// The left end of a bar.
    Left(ElementIndex),
    /// The right end of a bar.
    Right(ElementIndex),
    /// A section of a bar.
    At(ElementIndex, Position),
    /// A lumped element, or a bar as a whole.
    Element(ElementIndex),
    Line,
}

impl Place {
    /// The element that it belongs to; `None` for the whole line.
    pub const fn element(&self) -> Option<ElementIndex> {
        match self {
            Place::Left(element)
            | Place::Right(element)
            | Place::At(element, _)
            | Place::Element(element) => Some(*element),
            Place::Line => None,
        }
    }
}

/// A section of a bar.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Position {
    /// At a share of its length, from the left: 0 … 1.
    Share(Fraction),
    /// At a distance from the left end; for an endless bar, from its end. In bars given by
    /// impedance, the time in which a wave gets there.
    Distance(Fraction),
}
