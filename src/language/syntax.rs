//! The syntax tree: what a text says, before any name is looked up. Every node carries the bytes
//! it was read from, so that a later stage can point at them.
//!
//! Sums and products are lists, not chains of pairs: a sum of a hundred thousand terms is one node,
//! and nothing that walks the tree goes deeper than the parentheses of the text.

use num_rational::BigRational;

use super::source::Source;

pub use super::scene::tree::{
    Declaration, Declared, Line, ObservedPlace, ObservedTerm, Property, Scene, SceneStatement,
    SceneStatementKind, Section, Unit, UnitFactor,
};

/// A half-open range of bytes in a text.
///
/// ```
/// let text = "scene \"A\"\nline fre - free";
/// let error = wavestep::Problem::read("a.wave", text).err().unwrap();
/// assert_eq!(error.diagnostics()[0].span(), wavestep::Span { start: 15, end: 18 });
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The first byte.
    pub start: usize,
    /// The byte after the last; equal to `start` for a place between two characters.
    pub end: usize,
}

impl Span {
    /// The bytes from `start` up to, not including, `end`.
    #[must_use]
    pub const fn new(start: usize, end: usize) -> Self {
        Self { start, end }
    }

    /// From the start of this span to the end of a later one.
    #[must_use]
    pub(super) const fn to(self, later: Self) -> Self {
        Self::new(self.start, later.end)
    }
}

/// A value and the place it was read from.
///
/// Two are equal if their values are: the same thing written in two places is the same thing.
#[derive(Clone, Copy, Debug)]
pub struct Spanned<T> {
    /// What was read.
    pub value: T,
    /// Where.
    pub span: Span,
}

impl<T> Spanned<T> {
    /// Joins a value and its place.
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

/// An expression and its place, which includes any parentheses around it.
pub type Expression = Spanned<Node>;

/// A statement of a recurrence and its place.
pub type Statement = Spanned<StatementKind>;

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
    /// A name by itself: `mu`.
    Name(String),
    /// A wave function of some period, possibly differentiated: `f[n-1]'`.
    Wave(Box<Wave>),
    /// A name applied to an argument: `f(t - mu)`, a wave at a scene time. Whether the name is a
    /// wave is not known here.
    Call {
        /// What is applied.
        name: Name,
        /// What it is applied to.
        argument: Box<Expression>,
    },
    /// `exp(argument)`.
    Exponential(Box<Expression>),
    /// `cos(argument)`, `sin(argument)`, `sqrt(argument)`.
    Function {
        /// Which one.
        function: Function,
        /// What it is applied to.
        argument: Box<Expression>,
    },
    /// `sum(term, index < bound)`: over all indices from 0 up to, not including, the bound.
    Summation {
        /// The summand, which may mention the index.
        term: Box<Expression>,
        /// The name that counts.
        index: Name,
        /// The name it stays below.
        bound: Name,
    },
    /// `a + b - c`.
    Sum(Vec<Term>),
    /// `a*b/c`, worked from left to right.
    Product(Vec<Factor>),
    /// `-a`.
    Negate(Box<Expression>),
    /// `base^exponent`; the exponent is any expression here.
    Power {
        /// What is raised.
        base: Box<Expression>,
        /// To which power.
        exponent: Box<Expression>,
    },
}

/// A function of the language beside `exp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// `cos`
    Cosine,
    /// `sin`
    Sine,
    /// `sqrt`
    SquareRoot,
}

/// One term of a [`Node::Sum`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Term {
    /// Added or subtracted.
    pub sign: Sign,
    /// The term without the sign.
    pub value: Expression,
}

/// One factor of a [`Node::Product`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Factor {
    /// Multiplied or divided by.
    pub operator: Operator,
    /// The factor or divisor.
    pub value: Expression,
}

/// How a term joins a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Added.
    Plus,
    /// Subtracted.
    Minus,
}

/// How a factor joins a product.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// Multiplied.
    Multiply,
    /// Divided by.
    Divide,
}

/// A reference to a wave function: `f[n-1]''`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wave {
    /// The name of the wave.
    pub name: Name,
    /// Of which period.
    pub index: Spanned<Index>,
    /// How often it is differentiated with respect to local time.
    pub primes: u32,
}

/// What stands between the brackets of a wave: `n-1` has the base `n` and the offset −1, `3` has no
/// base and the offset 3.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Index {
    /// The name counted from, if there is one.
    pub base: Option<Name>,
    /// What is added to it; at most a million in magnitude.
    pub offset: i64,
}

/// A text of statements: the equations between the wave functions of successive periods.
#[derive(Clone, Debug)]
pub struct Recurrence {
    /// The text all spans refer to.
    pub source: Source,
    /// What the text calls itself.
    pub title: Spanned<String>,
    /// Everything after the title, in the order of the text.
    pub statements: Vec<Statement>,
}

/// What a [`Statement`] says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StatementKind {
    /// `symbol mu > 0, q`: parameters.
    Symbols(Vec<Symbol>),
    /// `nonzero a - b`: an assumption.
    Nonzero(Expression),
    /// `period 2*mu, local s, time t`.
    Period {
        /// How long a period lasts.
        length: Expression,
        /// The name of the time since the period began.
        local: Name,
        /// The name of the time since the scene began.
        time: Name,
    },
    /// `wave f, g`: the unknowns.
    Waves(Vec<Name>),
    /// `equation left = right`.
    Equation {
        /// The left side.
        left: Expression,
        /// The right side.
        right: Expression,
    },
    /// `continuous quantity starts at start`: what does not jump between periods.
    Continuous {
        /// What is continuous.
        quantity: Expression,
        /// Its value at time zero.
        start: Expression,
    },
    /// `written f in V/c, s as mu*z/L`: how the source writes it.
    Written(Vec<Rewriting>),
    /// `observe name = value`: something to report.
    Observe {
        /// What it is called.
        name: Name,
        /// What it is.
        value: Expression,
    },
}

/// One item of how the source writes a recurrence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rewriting {
    /// `f in V/c`: a wave is measured in a unit.
    Unit {
        /// The wave.
        wave: Name,
        /// The unit.
        unit: Expression,
    },
    /// `s as mu*z/L`, `a as alpha_tilde`: a name is written otherwise.
    Name {
        /// The name here.
        name: Name,
        /// What the source writes.
        written: Expression,
    },
    /// `constants of f as B`: constants of integration are stated apart.
    Constants {
        /// The wave.
        wave: Name,
        /// What they are called.
        name: Name,
    },
    /// `ends of a`: values of a wave at the ends of periods are kept.
    Ends(Name),
}

/// A parameter and what is assumed of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// What it is called.
    pub name: Name,
    /// Nothing is assumed if absent.
    pub condition: Option<Condition>,
}

/// `> 0`, `!= 1/2`: an assumption about a symbol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Condition {
    /// How symbol and bound compare.
    pub relation: Spanned<Relation>,
    /// The right side; whether it is a constant is not known here.
    pub bound: Expression,
}

/// A comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// `>`
    Greater,
    /// `>=`
    GreaterOrEqual,
    /// `<`
    Less,
    /// `<=`
    LessOrEqual,
    /// `!=`
    NotEqual,
}

/// A text of formulas, one for each wave function and period.
#[derive(Clone, Debug)]
pub struct Listing {
    /// The text all spans refer to.
    pub source: Source,
    /// The formulas in the order of the text.
    pub formulas: Vec<Spanned<Formula>>,
}

/// `f[3](s) = value`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// The name of the wave.
    pub wave: Name,
    /// Of which period; at most a million.
    pub index: Spanned<u32>,
    /// The name of the argument.
    pub argument: Name,
    /// The wave function as an expression in the argument.
    pub value: Expression,
}
