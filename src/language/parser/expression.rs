//! Expressions: what stands between operators, and how the parts are joined.
//!
//! The parser keeps what is unfinished in a list of its own and never calls itself, so that the
//! depth of a text costs no stack.

use crate::limits::{MAX_INDEX, MAX_NESTING};
use std::mem;

use nom::Parser;
use nom::combinator::opt;

use super::super::name;
use super::super::syntax::{
    Expression, Factor, Function, Index, Name, Node, Operator, Sign, Span, Spanned, Term, Wave,
};
use super::lexical::{
    additive, demand_name, digits, literal, multiplicative, next_word, prime, skip_blank, symbol,
    token, word,
};
use super::{Extent, Input, Parsed, between, complaint};

/// Words that follow an expression in a statement, and so end it.
pub(super) const FOLLOWING: [&str; 3] = ["starts", "local", "time"];

/// An expression and nothing after it.
pub(super) fn alone(input: Input<'_>) -> Parsed<'_, Expression> {
    let (rest, expression) = expression(input)?;
    Ok((end(rest)?.0, expression))
}

/// Nothing but blanks.
pub(super) fn end(input: Input<'_>) -> Parsed<'_, ()> {
    let rest = skip_blank(input);
    if rest.text.is_empty() { Ok((rest, ())) } else { Err(complaint::expected_end(input)) }
}

/// An expression up to where it cannot go on.
pub(super) fn expression(input: Input<'_>) -> Parsed<'_, Expression> {
    let mut unfinished = Unfinished::default();
    let mut rest = input;
    loop {
        let (after, operand) = operand(rest)?;
        rest = after;
        let mut value = match operand {
            Operand::Sign(sign) => {
                unfinished.deepen(rest, sign.span)?;
                unfinished.level.prefixes.push(Prefix::Sign(sign));
                continue;
            }
            Operand::Open(opening) => {
                unfinished.deepen(rest, opening.parenthesis)?;
                unfinished.open(opening);
                continue;
            }
            Operand::Complete(value) => value,
        };
        // An operator asks for the next operand; without one, the innermost parentheses must close,
        // and what they enclose may itself be followed by an operator.
        loop {
            let (after, joined) = join(rest, &mut unfinished, value)?;
            rest = after;
            match joined {
                Joined::Operand => break,
                Joined::Complete(complete) => match unfinished.close() {
                    None => return Ok((rest, complete)),
                    Some(opening) => (rest, value) = close(rest, opening, complete)?,
                },
            }
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

/// What comes of a value and the operator after it.
enum Joined {
    /// The value is stored, and the operator asks for another.
    Operand,
    /// There is no operator: everything since the last parenthesis is one expression.
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
    fn deepen<'a>(&mut self, input: Input<'a>, opener: Span) -> Parsed<'a, ()> {
        if self.depth >= usize::from(MAX_NESTING) {
            return Err(complaint::too_deep(input, opener));
        }
        self.depth += 1;
        Ok((input, ()))
    }

    fn open(&mut self, opening: Opening) {
        self.outer.push((mem::take(&mut self.level), opening));
    }

    fn close(&mut self) -> Option<Opening> {
        let (level, opening) = self.outer.pop()?;
        self.level = level;
        self.depth -= 1;
        Some(opening)
    }
}

/// Stores a value under the operator that follows it.
fn join<'a>(rest: Input<'a>, unfinished: &mut Unfinished, value: Expression) -> Parsed<'a, Joined> {
    if let (rest, Some(caret)) = opt(symbol("^")).parse(rest)? {
        unfinished.deepen(rest, caret)?;
        unfinished.level.prefixes.push(Prefix::Base(value));
        return Ok((rest, Joined::Operand));
    }
    unfinished.depth -= unfinished.level.prefixes.len();
    let one_factor = rest.context.extent == Extent::Factor && unfinished.outer.is_empty();
    let level = &mut unfinished.level;
    let value = level.apply_prefixes(value);
    if one_factor {
        refuse_neighbour(&value, rest)?;
        return Ok((rest, Joined::Complete(value)));
    }
    if let (rest, Some(operator)) = opt(token(multiplicative)).parse(rest)? {
        level.push_factor(value, Some(operator.value));
        return Ok((rest, Joined::Operand));
    }
    refuse_neighbour(&value, rest)?;
    let value = level.product(value);
    if let (rest, Some(sign)) = opt(token(additive)).parse(rest)? {
        level.push_term(value, Some(sign.value));
        return Ok((rest, Joined::Operand));
    }
    Ok((rest, Joined::Complete(level.sum(value))))
}

/// What follows the expression in parentheses, and what comes of it.
fn close<'a>(rest: Input<'a>, opening: Opening, inner: Expression) -> Parsed<'a, Expression> {
    let Opening { start, parenthesis, role } = opening;
    let (rest, node) = match role {
        Role::Grouping => (rest, inner.value),
        Role::Exponential => (rest, Node::Exponential(Box::new(inner))),
        Role::Function(function) => {
            let argument = Box::new(inner);
            (rest, Node::Function { function, argument })
        }
        Role::Call(name) => {
            let argument = Box::new(inner);
            (rest, Node::Call { name, argument })
        }
        Role::Summation => range(rest, parenthesis, inner)?,
    };
    match opt(symbol(")")).parse(rest)? {
        (rest, Some(end)) => Ok((rest, Spanned::new(node, Span::new(start, end.end)))),
        (_, None) => Err(complaint::unclosed(rest, parenthesis, ")")),
    }
}

/// `, i < n`
fn range(input: Input<'_>, parenthesis: Span, term: Expression) -> Parsed<'_, Node> {
    let (rest, Some(_)) = opt(symbol(",")).parse(input)? else {
        return Err(complaint::sum_without_range(input, parenthesis));
    };
    let (rest, index) = demand_name("the index of the sum", rest)?;
    let (after, Some(_)) = opt(symbol("<")).parse(rest)? else {
        return Err(complaint::sum_range(rest, &index));
    };
    if after.text.starts_with('=') {
        return Err(complaint::sum_range(rest, &index));
    }
    let (rest, bound) = demand_name("the name that the index stays below", after)?;
    let term = Box::new(term);
    Ok((rest, Node::Summation { term, index, bound }))
}

/// Refuses `2 mu`, `(a)(b)` and the like: what follows a factor is no other factor.
fn refuse_neighbour<'a>(left: &Expression, rest: Input<'a>) -> Parsed<'a, ()> {
    let start = skip_blank(rest);
    let starts_factor = match start.text.chars().next() {
        Some('(') => true,
        Some('.') => start.text[1..].starts_with(|next: char| next.is_ascii_digit()),
        Some(next) if name::is_letter(next) => !next_word(start).is_some_and(|word| {
            let applied = || rest.context.source.text()[word.span.end..].starts_with('(');
            FOLLOWING.contains(&word.value) || rest.context.extent == Extent::Unit && !applied()
        }),
        Some(next) => next.is_ascii_digit(),
        None => false,
    };
    if starts_factor { Err(complaint::missing_operator(left, rest)) } else { Ok((rest, ())) }
}

/// A sign, an open parenthesis, or something complete.
fn operand(input: Input<'_>) -> Parsed<'_, Operand> {
    if let (rest, Some(sign)) = opt(token(additive)).parse(input)? {
        return Ok((rest, Operand::Sign(sign)));
    }
    let start = skip_blank(input);
    match start.text.chars().next() {
        Some('(') => {
            let (rest, parenthesis) = symbol("(")(start)?;
            Ok((rest, open(start, parenthesis, Role::Grouping)))
        }
        Some(next) if next.is_ascii_digit() || next == '.' => number(start, input),
        Some(next) if name::is_letter(next) => named(start),
        _ => Err(complaint::expected_expression(input)),
    }
}

fn open(start: Input<'_>, parenthesis: Span, role: Role) -> Operand {
    Operand::Open(Opening { start: start.offset, parenthesis, role })
}

fn number<'a>(start: Input<'a>, before: Input<'a>) -> Parsed<'a, Operand> {
    match literal(start) {
        Ok((rest, value)) => {
            let value = Spanned::new(Node::Number(value), between(start, rest));
            Ok((rest, Operand::Complete(value)))
        }
        // A point without digits.
        Err(nom::Err::Error(_)) => Err(complaint::expected_expression(before)),
        Err(error) => Err(error),
    }
}

/// `name`, `name[index]'`, or the beginning of `name(argument)`, of a function, `sum(…)`.
fn named(start: Input<'_>) -> Parsed<'_, Operand> {
    let (rest, written) = token(word).parse(start)?;
    let spelt = Spanned::new(name::normalise(written.value), written.span);
    if let (after, Some(parenthesis)) = opt(symbol("(")).parse(rest)? {
        let role = match written.value {
            "cos" => Role::Function(Function::Cosine),
            "exp" => Role::Exponential,
            "sin" => Role::Function(Function::Sine),
            "sqrt" => Role::Function(Function::SquareRoot),
            "sum" => Role::Summation,
            _ => Role::Call(spelt),
        };
        return Ok((after, open(start, parenthesis, role)));
    }
    if name::RESERVED.contains(&written.value) {
        return Err(complaint::function_alone(rest, written.value, written.span));
    }
    let (rest, node) = match opt(symbol("[")).parse(rest)? {
        (after, Some(opener)) => wave(after, spelt, opener)?,
        (_, None) => {
            refuse_prime(rest, &spelt)?;
            (rest, Node::Name(spelt.value))
        }
    };
    let value = Spanned::new(node, between(start, rest));
    Ok((rest, Operand::Complete(value)))
}

/// Refuses `f'` and `f'[n]`.
fn refuse_prime<'a>(rest: Input<'a>, name: &Spanned<String>) -> Parsed<'a, ()> {
    match opt(token(prime)).parse(rest)? {
        (_, Some(prime)) => Err(complaint::early_prime(rest, prime.span, &name.value)),
        (_, None) => Ok((rest, ())),
    }
}

/// What follows `name[`.
fn wave(input: Input<'_>, name: Spanned<String>, opener: Span) -> Parsed<'_, Node> {
    let (rest, index) = index(input)?;
    let (mut rest, _) = match opt(symbol("]")).parse(rest)? {
        (rest, Some(span)) => (rest, span),
        (_, None) => return Err(complaint::index_end(rest, opener)),
    };
    let mut primes = 0_u32;
    while let (after, Some(prime)) = opt(token(prime)).parse(rest)? {
        primes = primes.saturating_add(prime.value);
        rest = after;
    }
    if skip_blank(rest).text.starts_with('(') {
        return Err(complaint::index_and_argument(rest, &name.value));
    }
    let wave = Wave { name, index, primes };
    Ok((rest, Node::Wave(Box::new(wave))))
}

/// `name`, `name + 3`, `name - 3`, `3`, `-3`.
fn index(input: Input<'_>) -> Parsed<'_, Spanned<Index>> {
    let start = skip_blank(input);
    let (rest, base) = match next_word(start) {
        Some(_) => {
            let (rest, base) = demand_name("an index", start)?;
            (rest, Some(base))
        }
        None => (input, None),
    };
    let (after, sign) = opt(token(additive)).parse(rest)?;
    let (rest, offset) = match (&base, sign) {
        (Some(_), None) => (rest, 0),
        (_, sign) => {
            let (rest, Some(value)) = opt(token(digits)).parse(after)? else {
                return Err(complaint::index_form(after));
            };
            let Some(value) = index_value(value.value) else {
                return Err(complaint::index_too_large(rest, value.span));
            };
            let negative = sign.is_some_and(|sign| sign.value == Sign::Minus);
            let value = i64::from(value);
            (rest, if negative { -value } else { value })
        }
    };
    let span = between(start, rest);
    Ok((rest, Spanned::new(Index { base, offset }, span)))
}

/// A whole number within the limit of an index.
fn index_value(digits: &str) -> Option<u32> {
    let digits = digits.trim_start_matches('0');
    match digits.len() {
        0 => Some(0),
        1..=7 => digits.parse().ok().filter(|&value| value <= MAX_INDEX),
        _ => None,
    }
}

/// The whole number that the grammar demands between the brackets of a formula's left side.
pub(super) fn demand_index(input: Input<'_>) -> Parsed<'_, Spanned<u32>> {
    let (rest, Some(written)) = opt(token(digits)).parse(input)? else {
        return Err(complaint::expected(input, "the number of a period"));
    };
    match index_value(written.value) {
        Some(value) => Ok((rest, Spanned::new(value, written.span))),
        None => Err(complaint::index_too_large(rest, written.span)),
    }
}
