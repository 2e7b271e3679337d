//! The syntax tree: what a text says, before any name is looked up. Every node carries the bytes
//! it was read from, so that a later stage can point at them.
//!
//! Sums and products are lists, not chains of pairs: a sum of a hundred thousand terms is one node,
//! and nothing that walks the tree goes deeper than the parentheses of the text.

use num_rational::BigRational;

pub use super::source::Span;

use super::source::Source;
use crate::expression::Relation;
use crate::scene::{End, Joint, Measure};

/// A value and the place it was read from.
///
/// Two are equal if their values are: the same thing written in two places is the same thing.
#[derive(Clone, Copy, Debug)]
pub struct Spanned<T> {
    pub value: T,
    pub span: Span,
}

impl<T> Spanned<T> {
    #[must_use]
    pub const fn new(value: T, span: Span) -> Self {
        Self { value, span }
    }
}

impl<T: PartialEq> PartialEq for Spanned<T> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<T: Eq> Eq for Spanned<T> {}

/// A name, Greek letters already spelt out: `μ_1` is `mu_1`.
///
/// # Invariants
/// An ASCII letter followed by ASCII letters, digits and `_`; none of `cos`, `exp`, `sin`, `sqrt` and `sum`.
pub type Name = Spanned<String>;

// ---- Expressions ------------------------------------------------------------------------------

/// An expression and its place, which includes any parentheses around it.
pub type Expression = Spanned<Node>;

/// What an [`Expression`] is made of.
///
/// # Invariants
/// - A [`Node::Number`] is what one literal can say: not negative, a terminating decimal.
/// - [`Node::Sum`] and [`Node::Product`] have at least two parts, the first with [`Sign::Plus`] or
///   [`Operator::Multiply`]; a minus in front of everything is a [`Node::Negate`] inside the first.
/// - Parentheses, arguments, unary minuses and exponents nest at most
///   [`MAX_NESTING`](crate::limits::MAX_NESTING) deep in total.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Node {
    /// A literal: `3`, `0.25`, `1e-3`.
    Number(BigRational),
    Name(String),
    /// A wave function of some period, possibly differentiated: `f[n-1]'`.
    Wave(Box<Wave>),
    /// A name applied to an argument: `f(t - mu)`, a wave at a scene time. Whether the name is a
    /// wave is not known here.
    Call {
        name: Name,
        argument: Box<Expression>,
    },
    /// `exp(argument)`.
    Exponential(Box<Expression>),
    /// `cos(argument)`, `sin(argument)`, `sqrt(argument)`.
    Function {
        function: Function,
        argument: Box<Expression>,
    },
    /// `sum(term, index < bound)`: over all indices from 0 up to, not including, the bound.
    Summation {
        /// The summand, which may mention the index.
        term: Box<Expression>,
        index: Name,
        bound: Name,
    },
    /// `a + b - c`.
    Sum(Vec<Term>),
    /// `a*b/c`, worked from left to right.
    Product(Vec<Factor>),
    Negate(Box<Expression>),
    /// `base^exponent`; the exponent is any expression here.
    Power {
        base: Box<Expression>,
        exponent: Box<Expression>,
    },
}

/// A function of the language beside `exp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    Cosine,
    Sine,
    SquareRoot,
}

/// One term of a [`Node::Sum`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Term {
    pub sign: Sign,
    pub value: Expression,
}

/// One factor of a [`Node::Product`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Factor {
    pub operator: Operator,
    pub value: Expression,
}

/// How a term joins a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    Plus,
    Minus,
}

/// How a factor joins a product.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    Multiply,
    Divide,
}

/// A reference to a wave function: `f[n-1]''`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wave {
    pub name: Name,
    pub index: Spanned<Index>,
    /// How often it is differentiated with respect to local time.
    pub primes: u32,
}

/// What stands between the brackets of a wave: `n-1` has the base `n` and the offset −1, `3` has no
/// base and the offset 3.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Index {
    pub base: Option<Name>,
    /// At most a million in magnitude.
    pub offset: i64,
}

// ---- Texts of statements ----------------------------------------------------------------------

/// A title, then statements in any order.
#[derive(Clone, Debug)]
pub struct Text<Statement> {
    /// The text all spans refer to.
    pub source: Source,
    pub title: Spanned<String>,
    pub statements: Vec<Spanned<Statement>>,
}

/// Equations between the wave functions of successive periods.
pub type Recurrence = Text<StatementKind>;

/// Bars and lumped elements, how they are joined, and what is observed.
pub type Scene = Text<SceneStatementKind>;

impl Scene {
    /// The first line that is stated.
    pub fn line(&self) -> Option<(&Line, Span)> {
        self.statements.iter().find_map(|statement| match &statement.value {
            SceneStatementKind::Line(line) => Some((line, statement.span)),
            _ => None,
        })
    }

    /// The elements and materials, with the spans of their statements.
    pub fn declarations(&self) -> impl Iterator<Item = (&Declaration, Span)> {
        self.statements.iter().filter_map(|statement| match &statement.value {
            SceneStatementKind::Declaration(own) => Some((own, statement.span)),
            _ => None,
        })
    }
}

/// A parameter and what is assumed of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    pub name: Name,
    pub condition: Option<Condition>,
}

/// `> 0`, `!= 1/2`: an assumption about a symbol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Condition {
    pub relation: Spanned<Relation>,
    /// Whether it is a constant is not known here.
    pub bound: Expression,
}

/// A statement of a recurrence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StatementKind {
    /// `symbol mu > 0, q`: parameters.
    Symbols(Vec<Symbol>),
    /// `nonzero a - b`: an assumption.
    Nonzero(Expression),
    /// `period 2*mu, local s, time t`: its length, the time since it began, the time since the start.
    Period { length: Expression, local: Name, time: Name },
    /// `wave f, g`: the unknowns.
    Waves(Vec<Name>),
    /// `equation left = right`.
    Equation { left: Expression, right: Expression },
    /// `continuous quantity starts at start`: what does not jump between periods.
    Continuous { quantity: Expression, start: Expression },
    /// `written f in V/c, s as mu*z/L`: how the source writes it.
    Written(Vec<Rewriting>),
    /// `observe name = value`: something to report.
    Observe { name: Name, value: Expression },
}

/// One item of how the source writes a recurrence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rewriting {
    /// `f in V/c`: a wave or an observable is measured in a unit.
    Unit { quantity: Name, unit: Expression },
    /// `s as mu*z/L`, `a as alpha_tilde`: a name is written otherwise.
    Name { name: Name, written: Expression },
    /// `constants of f as B`: constants of integration are stated apart.
    Constants { wave: Name, name: Name },
    /// `ends of a`: values of a wave at the ends of periods are kept.
    Ends(Name),
}

/// A text of formulas, one for each wave function and period.
#[derive(Clone, Debug)]
pub struct Listing {
    /// The text all spans refer to.
    pub source: Source,
    pub formulas: Vec<Spanned<Formula>>,
}

/// `f[3](s) = value`, `phi_f[2,1](s) = value`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    pub wave: Name,
    /// The period, or how often each period of a lattice has passed; at most a million.
    pub counts: Vec<Spanned<u32>>,
    pub argument: Name,
    pub value: Expression,
}

// ---- Scenes -----------------------------------------------------------------------------------

/// A statement of a scene, with the place from its first word to its last.
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
    /// `observe v = velocity(ram)`: a quantity of interest, with at least one term.
    Observe { name: Name, terms: Vec<Spanned<ObservedTerm>> },
}

/// A material or an element with its properties, in the order of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Declaration {
    pub kind: Declared,
    pub name: Name,
    pub properties: Vec<Property>,
}

/// What a [`Declaration`] declares. `Display` gives its word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Declared {
    Material,
    Bar,
    Mass,
    Spring,
    Hertz,
    Support,
    Load,
}

/// A property: `length = 3/2 m`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
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
    pub operator: Operator,
    /// The unit with its prefix, `µ` as `u`.
    pub name: Name,
    /// The power it is raised to before it is multiplied or divided by.
    pub power: i8,
}

/// Elements from left to right between two ends, at least one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    pub left: Spanned<End>,
    pub elements: Vec<Name>,
    /// How they are joined, with the ends too: one more than there are elements.
    pub joints: Vec<Spanned<Joint>>,
    /// How far apart contacts begin: the joint, and the width with its unit.
    pub gaps: Vec<(usize, Expression, Option<Unit>)>,
    pub right: Spanned<End>,
}

/// A term of what is observed: `- 2*force(pile.right)`, `+ force(pile.left)/2`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObservedTerm {
    pub sign: Sign,
    /// What is multiplied and divided by, from left to right.
    pub factors: Vec<Factor>,
    pub measure: Spanned<Measure>,
    pub place: Spanned<ObservedPlace>,
}

/// Where something is measured: `pile.at(1/2)`, `ram`, `line`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObservedPlace {
    /// The name of an element, or `line`.
    pub element: Name,
    pub section: Option<Section>,
}

/// A section of a bar.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Section {
    Left,
    Right,
    /// `at(1/2)`, `at(20 mm)`: how far from the left end.
    At {
        position: Expression,
        unit: Option<Unit>,
    },
}
