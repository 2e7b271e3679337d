//! The tree of a text that states a scene. It re-uses names, symbols and expressions of
//! [`syntax`](crate::language::syntax), and the words of [`crate::scene`].

use crate::language::source::Source;
use crate::language::syntax::{Expression, Factor, Name, Operator, Sign, Spanned, Symbol};
use crate::scene::{End, Joint, Measure};

/// A text of statements: what bars and lumped elements there are, how they are joined, and what is
/// observed.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The text all spans refer to.
    pub source: Source,
    /// What the text calls itself.
    pub title: Spanned<String>,
    /// Everything after the title, in the order of the text.
    pub statements: Vec<SceneStatement>,
}

/// A statement of a scene, with the place from its first word to its last.
pub type SceneStatement = Spanned<SceneStatementKind>;

/// What a [`SceneStatement`] says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SceneStatementKind {
    /// `symbol mu > 0, q`: parameters.
    Symbols(Vec<Symbol>),
    /// `nonzero a - b`: an assumption.
    Nonzero(Expression),
    /// `bar rod { impedance = 1 }`: a material or an element.
    Declaration(Declaration),
    /// `line free - rod - fixed`: how the elements are joined.
    Line(Line),
    /// `contacts open`: contacts open where they would pull, and close where they meet again.
    ContactsOpen,
    /// `observe v = velocity(ram)`: a quantity of interest.
    Observe {
        /// What it is called.
        name: Name,
        /// Its terms, at least one.
        terms: Vec<Spanned<ObservedTerm>>,
    },
}

/// A material or an element with its properties.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Declaration {
    /// What is declared.
    pub kind: Declared,
    /// Its name.
    pub name: Name,
    /// Its properties, in the order of the text.
    pub properties: Vec<Property>,
}

/// What a [`Declaration`] declares. `Display` gives its word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Declared {
    /// `material`
    Material,
    /// `bar`
    Bar,
    /// `mass`
    Mass,
    /// `spring`
    Spring,
    /// `hertz`
    Hertz,
    /// `support`
    Support,
    /// `load`
    Load,
}

/// A property: `length = 3/2 m`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// Its name.
    pub name: Name,
    /// Its value in the unit; for `material` a name.
    pub value: Expression,
    /// The unit of the whole value.
    pub unit: Option<Unit>,
}

/// A unit: a product of powers of named units, at least one. It begins with a multiplication.
pub type Unit = Spanned<Vec<UnitFactor>>;

/// A factor of a unit: `/m^3`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitFactor {
    /// Multiplied or divided by.
    pub operator: Operator,
    /// The unit with its prefix, `µ` as `u`.
    pub name: Name,
    /// The power it is raised to before it is multiplied or divided by.
    pub power: i8,
}

/// Elements from left to right between two ends, at least one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// What is at the left.
    pub left: Spanned<End>,
    /// The names of the elements.
    pub elements: Vec<Name>,
    /// How they are joined, with the ends too: one more than there are elements.
    pub joints: Vec<Spanned<Joint>>,
    /// What is at the right.
    pub right: Spanned<End>,
}

/// A term of what is observed: `- 2*force(pile.right)`, `+ force(pile.left)/2`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObservedTerm {
    /// Added or subtracted.
    pub sign: Sign,
    /// What is multiplied and divided by, from left to right.
    pub factors: Vec<Factor>,
    /// What is measured.
    pub measure: Spanned<Measure>,
    /// Where.
    pub place: Spanned<ObservedPlace>,
}

/// Where something is measured: `pile.at(1/2)`, `ram`, `line`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObservedPlace {
    /// The name of an element, or `line`.
    pub element: Name,
    /// A section of it.
    pub section: Option<Section>,
}

/// A section of a bar.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Section {
    /// `left`
    Left,
    /// `right`
    Right,
    /// `at(1/2)`, `at(20 mm)`
    At {
        /// How far from the left end.
        position: Expression,
        /// The unit of a distance.
        unit: Option<Unit>,
    },
}
