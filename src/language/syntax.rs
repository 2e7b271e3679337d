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
///
/// ```
/// use wavestep::language::{Source, Span, parse_expression, syntax::{Node, Spanned}};
///
/// let tree = parse_expression(&Source::new("text", "(mu)")?)?;
/// assert_eq!(tree, Spanned::new(Node::Name("mu".to_owned()), Span::new(10, 12)));
/// assert_eq!(tree.span, Span::new(0, 4));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
///
/// ```
/// use wavestep::language::{Source, parse_recurrence, syntax::{Name, StatementKind}};
///
/// let source = Source::new("text", "recurrence \"Example\"\nwave μ_1")?;
/// let recurrence = parse_recurrence(&source)?;
/// let StatementKind::Waves(waves) = &recurrence.statements[0].value else { panic!("waves") };
/// let name: &Name = &waves[0];
/// assert_eq!((name.value.as_str(), source.slice(name.span)), ("mu_1", "μ_1"));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub type Name = Spanned<String>;

/// An expression and its place, which includes any parentheses around it.
///
/// ```
/// use wavestep::language::{Source, parse_expression, syntax::{Expression, Node}};
///
/// let source = Source::new("text", "2^(n + 1)")?;
/// let Node::Power { exponent, .. } = parse_expression(&source)?.value else { panic!("a power") };
/// let exponent: Expression = *exponent;
/// assert_eq!(source.slice(exponent.span), "(n + 1)");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub type Expression = Spanned<Node>;

/// A statement of a recurrence and its place.
///
/// ```
/// use wavestep::language::{Source, parse_recurrence, syntax::Statement};
///
/// let text = "recurrence \"Example\"\nperiod 2*mu, # one round trip\n  local s, time t";
/// let source = Source::new("text", text)?;
/// let recurrence = parse_recurrence(&source)?;
/// let statement: &Statement = &recurrence.statements[0];
/// assert_eq!(statement.to_string(), "period 2*mu, local s, time t");
/// assert!(source.slice(statement.span).contains("# one round trip"));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub type Statement = Spanned<StatementKind>;

/// What an [`Expression`] is made of.
///
/// # Invariants
/// - A [`Node::Number`] is what one literal can say: not negative, a terminating decimal.
/// - [`Node::Sum`] and [`Node::Product`] have at least two parts, the first with [`Sign::Plus`] or
///   [`Operator::Multiply`]; a minus in front of everything is a [`Node::Negate`] inside the first.
/// - Parentheses, arguments, unary minuses and exponents nest at most
///   [`MAX_NESTING`](crate::limits::MAX_NESTING) deep in total.
///
/// ```
/// use wavestep::language::{Source, parse_expression, syntax::Node};
///
/// let tree = parse_expression(&Source::new("text", "-(1/4)*exp(-t)")?)?;
/// let Node::Product(factors) = &tree.value else { panic!("a product") };
/// assert!(matches!(&factors[0].value.value, Node::Negate(_)));
/// assert!(matches!(&factors[1].value.value, Node::Exponential(_)));
/// assert_eq!(tree.to_string(), "-(1/4)*exp(-t)");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
///
/// ```
/// use wavestep::language::{Source, parse_expression, syntax::{Function, Node}};
///
/// let tree = parse_expression(&Source::new("text", "cos(2*t)")?)?;
/// assert!(matches!(tree.value, Node::Function { function: Function::Cosine, .. }));
/// let names = [Function::Cosine, Function::Sine, Function::SquareRoot].map(|f| f.to_string());
/// assert_eq!(names, ["cos", "sin", "sqrt"]);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
///
/// ```
/// use wavestep::language::{Source, parse_expression, syntax::{Node, Sign, Term}};
///
/// let tree = parse_expression(&Source::new("text", "a - 2*b")?)?;
/// let Node::Sum(terms) = tree.value else { panic!("a sum") };
/// let Term { sign, value } = &terms[1];
/// assert_eq!((*sign, value.to_string().as_str()), (Sign::Minus, "2*b"));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Term {
    /// Added or subtracted.
    pub sign: Sign,
    /// The term without the sign.
    pub value: Expression,
}

/// One factor of a [`Node::Product`].
///
/// ```
/// use wavestep::language::{Source, parse_expression, syntax::{Factor, Node, Operator}};
///
/// let tree = parse_expression(&Source::new("text", "a/(b + 1)")?)?;
/// let Node::Product(factors) = tree.value else { panic!("a product") };
/// let Factor { operator, value } = &factors[1];
/// assert_eq!((*operator, value.to_string().as_str()), (Operator::Divide, "b + 1"));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Factor {
    /// Multiplied or divided by.
    pub operator: Operator,
    /// The factor or divisor.
    pub value: Expression,
}

/// How a term joins a sum.
///
/// ```
/// use wavestep::language::{Source, parse_expression, syntax::{Node, Sign}};
///
/// let tree = parse_expression(&Source::new("text", "a - b + c")?)?;
/// let Node::Sum(terms) = tree.value else { panic!("a sum") };
/// assert!(terms.iter().map(|term| term.sign).eq([Sign::Plus, Sign::Minus, Sign::Plus]));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Added.
    Plus,
    /// Subtracted.
    Minus,
}

/// How a factor joins a product.
///
/// ```
/// use wavestep::language::{Source, parse_expression, syntax::{Node, Operator}};
///
/// let tree = parse_expression(&Source::new("text", "a*b/c")?)?;
/// let Node::Product(factors) = tree.value else { panic!("a product") };
/// let operators = factors.iter().map(|factor| factor.operator);
/// assert!(operators.eq([Operator::Multiply, Operator::Multiply, Operator::Divide]));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// Multiplied.
    Multiply,
    /// Divided by.
    Divide,
}

/// A reference to a wave function: `f[n-1]''`.
///
/// ```
/// use wavestep::language::{Source, parse_expression, syntax::Node};
///
/// let tree = parse_expression(&Source::new("text", "f[n-1]''")?)?;
/// let Node::Wave(wave) = &tree.value else { panic!("a wave") };
/// assert_eq!((wave.name.value.as_str(), wave.primes), ("f", 2));
/// assert_eq!(wave.index.to_string(), "n-1");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
///
/// ```
/// use wavestep::language::{Source, parse_expression, syntax::Node};
///
/// let tree = parse_expression(&Source::new("text", "f[n-1]")?)?;
/// let Node::Wave(wave) = tree.value else { panic!("a wave") };
/// let index = wave.index.value;
/// assert_eq!((index.base.unwrap().value.as_str(), index.offset), ("n", -1));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Index {
    /// The name counted from, if there is one.
    pub base: Option<Name>,
    /// What is added to it; at most a million in magnitude.
    pub offset: i64,
}

/// A text of statements: the equations between the wave functions of successive periods.
///
/// ```
/// use wavestep::language::{Source, parse_recurrence, syntax::Recurrence};
///
/// let source = Source::new("text", "recurrence \"Example\"\nwave f\nequation f[n] = f[n-1] + 1")?;
/// let recurrence = parse_recurrence(&source)?;
/// let Recurrence { source, title, statements } = recurrence;
/// assert_eq!((source.name(), title.value.as_str()), ("text", "Example"));
/// assert_eq!(statements[1].to_string(), "equation f[n] = f[n-1] + 1");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
///
/// ```
/// use wavestep::language::{Source, parse_recurrence, syntax::StatementKind};
///
/// let source = Source::new("text", "recurrence \"Example\"\ncontinuous f[n] starts at 1")?;
/// let recurrence = parse_recurrence(&source)?;
/// let StatementKind::Continuous { quantity, start } = &recurrence.statements[0].value else {
///     panic!("a continuity rule");
/// };
/// assert_eq!((quantity.to_string(), start.to_string()), ("f[n]".to_owned(), "1".to_owned()));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
///
/// ```
/// use wavestep::language::syntax::{Rewriting, StatementKind};
/// use wavestep::language::{Source, parse_recurrence};
///
/// let text = "recurrence \"Scaled\"\nwritten f in V/c, ends of f\n";
/// let recurrence = parse_recurrence(&Source::new("scaled.wave", text)?)?;
/// let StatementKind::Written(items) = &recurrence.statements[0].value else { unreachable!() };
/// assert_eq!(items[0].to_string(), "f in V/c");
/// assert!(matches!(&items[1], Rewriting::Ends(wave) if wave.value == "f"));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
///
/// ```
/// use wavestep::language::{Source, parse_recurrence, syntax::StatementKind};
///
/// let source = Source::new("text", "recurrence \"Example\"\nsymbol mu > 0, q")?;
/// let recurrence = parse_recurrence(&source)?;
/// let StatementKind::Symbols(symbols) = &recurrence.statements[0].value else { panic!() };
/// assert_eq!((symbols[0].to_string().as_str(), symbols[1].name.value.as_str()), ("mu > 0", "q"));
/// assert!(symbols[0].condition.is_some() && symbols[1].condition.is_none());
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// What it is called.
    pub name: Name,
    /// Nothing is assumed if absent.
    pub condition: Option<Condition>,
}

/// `> 0`, `!= 1/2`: an assumption about a symbol.
///
/// ```
/// use wavestep::language::syntax::{Condition, Relation, StatementKind};
/// use wavestep::language::{Source, parse_recurrence};
///
/// let source = Source::new("text", "recurrence \"Example\"\nsymbol r != 1/2")?;
/// let recurrence = parse_recurrence(&source)?;
/// let StatementKind::Symbols(symbols) = &recurrence.statements[0].value else { panic!() };
/// let Some(Condition { relation, bound }) = &symbols[0].condition else { panic!("a condition") };
/// assert_eq!((relation.value, bound.to_string().as_str()), (Relation::NotEqual, "1/2"));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Condition {
    /// How symbol and bound compare.
    pub relation: Spanned<Relation>,
    /// The right side; whether it is a constant is not known here.
    pub bound: Expression,
}

/// A comparison.
///
/// ```
/// use wavestep::language::syntax::Relation;
///
/// assert_eq!(Relation::GreaterOrEqual.to_string(), ">=");
/// assert_eq!(Relation::NotEqual.to_string(), "!=");
/// ```
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
///
/// ```
/// use wavestep::language::{Source, parse_listing};
///
/// let source = Source::new("listing", "f[0](s) = 1\nf[1](s) =\n    1 - s # continued\n")?;
/// let listing = parse_listing(&source)?;
/// assert_eq!((listing.formulas.len(), listing.source), (2, source));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug)]
pub struct Listing {
    /// The text all spans refer to.
    pub source: Source,
    /// The formulas in the order of the text.
    pub formulas: Vec<Spanned<Formula>>,
}

/// `f[3](s) = value`.
///
/// ```
/// use wavestep::language::{Source, parse_listing, syntax::Formula};
///
/// let listing = parse_listing(&Source::new("listing", "f[3](s) = -4/3*s^3")?)?;
/// let Formula { wave, index, argument, value } = &listing.formulas[0].value;
/// assert_eq!((wave.value.as_str(), index.value, argument.value.as_str()), ("f", 3, "s"));
/// assert_eq!(value.to_string(), "-4/3*s^3");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
