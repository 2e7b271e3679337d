//! Expressions: what stands between operators, and how the parts are joined.
//!
//! The parser keeps what is unfinished in a list of its own and never calls itself, so that the
//! depth of a text costs no stack.

use crate::limits::{MAX_INDEX, MAX_NESTING};
use std::mem;

use super::super::name;
use super::super::syntax::{
    Expression, Factor, Function, Index, Name, Node, Operator, Sign, Span, Spanned, Term, Wave,
};
use super::forms::FOLLOWING;
use super::input::Extent;
use super::{Input, Outcome, complaint};

/// Nothing but blanks.
pub(super) fn end(input: Input<'_>) -> Outcome<()> {
    if input.after_blanks().text.is_empty() { Ok(()) } else { Err(complaint::expected_end(input)) }
}

/// An expression that ends at another place than usual.
pub(super) fn expression_to(input: &mut Input<'_>, extent: Extent) -> Outcome<Expression> {
    let outside = mem::replace(&mut input.context.extent, extent);
    let value = expression(input)?;
    input.context.extent = outside;
    Ok(value)
}

/// An expression up to where it cannot go on.
pub(super) fn expression(input: &mut Input<'_>) -> Outcome<Expression> {
    let mut unfinished = Unfinished::default();
    loop {
        let mut value = match operand(input)? {
            Operand::Sign(sign) => {
                unfinished.deepen(*input, sign.span)?;
                unfinished.level.prefixes.push(Prefix::Sign(sign));
                continue;
            }
            Operand::Open(opening) => {
                unfinished.deepen(*input, opening.parenthesis)?;
                unfinished.outer.push((mem::take(&mut unfinished.level), opening));
                continue;
            }
            Operand::Complete(value) => value,
        };
        // An operator asks for the next operand; without one, the innermost parentheses must close,
        // and what they enclose may itself be followed by an operator.
        while let Some(complete) = join(input, &mut unfinished, value)? {
            let Some((level, opening)) = unfinished.outer.pop() else { return Ok(complete) };
            unfinished.level = level;
            unfinished.depth -= 1;
            value = close(input, opening, complete)?;
        }
    }
}

/// What stands where an operand is needed.
enum Operand {
    /// A sign, before the operand proper.
    Sign(Spanned<Sign>),
    /// A parenthesis; the operand is what it encloses.
    Open(Opening),
    /// A number, name or wave.
    Complete(Expression),
}

/// An open parenthesis.
struct Opening {
    /// Where the operand starts: at the parenthesis, or the name before it.
    start: usize,
    parenthesis: Span,
    role: Role,
}

/// What is made of the expression in parentheses.
enum Role {
    Grouping,
    Call(Name),
    Exponential,
    Function(Function),
    Summation,
}

/// Signs and bases whose operands are still to come.
enum Prefix {
    Sign(Spanned<Sign>),
    Base(Expression),
}

/// What has been read since a parenthesis was opened.
#[derive(Default)]
struct Level {
    terms: Vec<Term>,
    /// How the next term joins; none before the first.
    sign: Option<Sign>,
    factors: Vec<Factor>,
    /// How the next factor joins; none before the first.
    operator: Option<Operator>,
    prefixes: Vec<Prefix>,
}

impl Level {
    /// Signs and powers: the prefix read last binds first.
    fn apply_prefixes(&mut self, mut value: Expression) -> Expression {
        while let Some(prefix) = self.prefixes.pop() {
            value = match prefix {
                Prefix::Sign(sign) => {
                    let span = sign.span.to(value.span);
                    match sign.value {
                        Sign::Plus => Spanned::new(value.value, span),
                        Sign::Minus => Spanned::new(Node::Negate(Box::new(value)), span),
                    }
                }
                Prefix::Base(base) => {
                    let span = base.span.to(value.span);
                    let (base, exponent) = (Box::new(base), Box::new(value));
                    Spanned::new(Node::Power { base, exponent }, span)
                }
            };
        }
        value
    }

    fn push_factor(&mut self, value: Expression, next: Option<Operator>) {
        let operator = mem::replace(&mut self.operator, next).unwrap_or(Operator::Multiply);
        self.factors.push(Factor { operator, value });
    }

    /// Ends a product with its last factor; a single factor is no product.
    fn product(&mut self, last: Expression) -> Expression {
        if self.factors.is_empty() {
            return last;
        }
        let span = self.factors[0].value.span.to(last.span);
        self.push_factor(last, None);
        Spanned::new(Node::Product(mem::take(&mut self.factors)), span)
    }

    fn push_term(&mut self, value: Expression, next: Option<Sign>) {
        let sign = mem::replace(&mut self.sign, next).unwrap_or(Sign::Plus);
        self.terms.push(Term { sign, value });
    }

    /// Ends a sum with its last term; a single term is no sum.
    fn sum(&mut self, last: Expression) -> Expression {
        if self.terms.is_empty() {
            return last;
        }
        let span = self.terms[0].value.span.to(last.span);
        self.push_term(last, None);
        Spanned::new(Node::Sum(mem::take(&mut self.terms)), span)
    }
}

/// The innermost level, and those around it with the parentheses that separate them.
#[derive(Default)]
struct Unfinished {
    level: Level,
    outer: Vec<(Level, Opening)>,
    depth: usize,
}

impl Unfinished {
    /// Goes one level deeper, if there is one. `opener` is what opens it.
    fn deepen(&mut self, input: Input<'_>, opener: Span) -> Outcome<()> {
        if self.depth >= usize::from(MAX_NESTING) {
            return Err(complaint::too_deep(input, opener));
        }
        self.depth += 1;
        Ok(())
    }
}

/// Stores a value under the operator that follows it. Where none follows, everything since the last
/// parenthesis is one expression.
fn join(
    input: &mut Input<'_>,
    unfinished: &mut Unfinished,
    value: Expression,
) -> Outcome<Option<Expression>> {
    if let Some(caret) = input.symbol("^") {
        unfinished.deepen(*input, caret)?;
        unfinished.level.prefixes.push(Prefix::Base(value));
        return Ok(None);
    }
    unfinished.depth -= unfinished.level.prefixes.len();
    let one_factor = input.context.extent == Extent::Factor && unfinished.outer.is_empty();
    let level = &mut unfinished.level;
    let value = level.apply_prefixes(value);
    if one_factor {
        refuse_neighbour(&value, *input)?;
        return Ok(Some(value));
    }
    if let Some(operator) = input.multiplicative()? {
        level.push_factor(value, Some(operator.value));
        return Ok(None);
    }
    refuse_neighbour(&value, *input)?;
    let value = level.product(value);
    if let Some(sign) = input.additive() {
        level.push_term(value, Some(sign.value));
        return Ok(None);
    }
    Ok(Some(level.sum(value)))
}

/// What follows the expression in parentheses, and what comes of it.
fn close(input: &mut Input<'_>, opening: Opening, inner: Expression) -> Outcome<Expression> {
    let Opening { start, parenthesis, role } = opening;
    let node = match role {
        Role::Grouping => inner.value,
        Role::Exponential => Node::Exponential(Box::new(inner)),
        Role::Function(function) => Node::Function { function, argument: Box::new(inner) },
        Role::Call(name) => Node::Call { name, argument: Box::new(inner) },
        Role::Summation => range(input, parenthesis, inner)?,
    };
    match input.symbol(")") {
        Some(end) => Ok(Spanned::new(node, Span::new(start, end.end))),
        None => Err(complaint::unclosed(*input, parenthesis, ")")),
    }
}

/// `, i < n`
fn range(input: &mut Input<'_>, parenthesis: Span, term: Expression) -> Outcome<Node> {
    if input.symbol(",").is_none() {
        return Err(complaint::lacking(*input, complaint::RANGE)
            .with_secondary(parenthesis, "the sum opens here"));
    }
    let index = input.name("the index of the sum")?;
    let before = *input;
    if input.symbol("<").is_none() || input.text.starts_with('=') {
        return Err(complaint::sum_range(before, &index));
    }
    let bound = input.name("the name that the index stays below")?;
    Ok(Node::Summation { term: Box::new(term), index, bound })
}

/// Refuses `2 mu`, `(a)(b)` and the like: what follows a factor is no other factor.
fn refuse_neighbour(left: &Expression, input: Input<'_>) -> Outcome<()> {
    let start = input.after_blanks();
    let starts_factor = match start.text.chars().next() {
        Some('(') => true,
        Some('.') => start.text[1..].starts_with(|next: char| next.is_ascii_digit()),
        Some(next) if name::is_letter(next) => !start.next_word().is_some_and(|word| {
            let applied = || input.context.source.text()[word.span.end..].starts_with('(');
            FOLLOWING.contains(&word.value) || input.context.extent == Extent::Unit && !applied()
        }),
        Some(next) => next.is_ascii_digit(),
        None => false,
    };
    if starts_factor { Err(complaint::missing_operator(left, input)) } else { Ok(()) }
}

/// A sign, an open parenthesis, or something complete.
fn operand(input: &mut Input<'_>) -> Outcome<Operand> {
    if let Some(sign) = input.additive() {
        return Ok(Operand::Sign(sign));
    }
    if let Some(parenthesis) = input.symbol("(") {
        let (start, role) = (parenthesis.start, Role::Grouping);
        return Ok(Operand::Open(Opening { start, parenthesis, role }));
    }
    if let Some(written) = input.word() {
        return named(input, written);
    }
    match input.literal()? {
        Some(value) => Ok(Operand::Complete(Spanned::new(Node::Number(value.value), value.span))),
        None => Err(complaint::expected_expression(*input)),
    }
}

/// `name`, `name[index]'`, or the beginning of `name(argument)`, of a function, `sum(…)`.
fn named(input: &mut Input<'_>, written: Spanned<&str>) -> Outcome<Operand> {
    let start = written.span.start;
    let spelt = Spanned::new(name::normalise(written.value), written.span);
    if let Some(parenthesis) = input.symbol("(") {
        let role = match written.value {
            "cos" => Role::Function(Function::Cosine),
            "exp" => Role::Exponential,
            "sin" => Role::Function(Function::Sine),
            "sqrt" => Role::Function(Function::SquareRoot),
            "sum" => Role::Summation,
            _ => Role::Call(spelt),
        };
        return Ok(Operand::Open(Opening { start, parenthesis, role }));
    }
    if name::RESERVED.contains(&written.value) {
        return Err(complaint::function_alone(*input, written.value, written.span));
    }
    let node = if let Some(opener) = input.symbol("[") {
        wave(input, spelt, opener)?
    } else if let Some(prime) = input.prime() {
        return Err(complaint::misplaced_prime(*input, prime.span, &spelt.value));
    } else {
        Node::Name(spelt.value)
    };
    Ok(Operand::Complete(Spanned::new(node, Span::new(start, input.offset))))
}

/// What follows `name[`.
fn wave(input: &mut Input<'_>, name: Name, opener: Span) -> Outcome<Node> {
    let index = index(input)?;
    if input.symbol("]").is_none() {
        return Err(complaint::index_end(*input, opener));
    }
    let mut primes = 0_u32;
    while let Some(prime) = input.prime() {
        primes = primes.saturating_add(prime.value);
    }
    match input.next_is("(") {
        true => Err(complaint::index_and_argument(*input, &name.value)),
        false => Ok(Node::Wave(Box::new(Wave { name, index, primes }))),
    }
}

/// `name`, `name + 3`, `name - 3`, `3`, `-3`.
fn index(input: &mut Input<'_>) -> Outcome<Spanned<Index>> {
    let start = input.after_blanks().offset;
    let base = input.next_word().map(|_| input.name("an index")).transpose()?;
    let sign = input.additive();
    let offset = match (&base, sign) {
        (Some(_), None) => 0,
        (_, sign) => {
            let Some(digits) = input.digits() else {
                return Err(complaint::lacking(*input, complaint::INDEX));
            };
            let value = i64::from(index_value(digits, *input)?);
            if sign.is_some_and(|sign| sign.value == Sign::Minus) { -value } else { value }
        }
    };
    Ok(Spanned::new(Index { base, offset }, Span::new(start, input.offset)))
}

/// A whole number within the limit of an index.
fn index_value(digits: Spanned<&str>, input: Input<'_>) -> Outcome<u32> {
    let value = digits.value.parse().ok().filter(|value| *value <= MAX_INDEX);
    value.ok_or_else(|| complaint::index_too_large(input, digits.span))
}

/// The whole number that the grammar demands between the brackets of a formula's left side.
pub(super) fn demand_index(input: &mut Input<'_>) -> Outcome<Spanned<u32>> {
    match input.digits() {
        Some(digits) => Ok(Spanned::new(index_value(digits, *input)?, digits.span)),
        None => Err(complaint::expected(*input, "the number of a period")),
    }
}
