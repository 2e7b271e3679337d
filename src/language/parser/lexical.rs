//! Tokens: names, numbers, strings, signs, and what separates them.

use nom::Parser;
use nom::branch::alt;
use nom::bytes::complete::{tag, take_till, take_while, take_while1};
use nom::character::complete::{char, digit0, digit1, one_of, satisfy};
use nom::combinator::{opt, peek, recognize, value};
use nom::multi::fold_many0;
use nom::sequence::preceded;
use num_rational::BigRational;

use super::super::layout::is_space;
use super::super::name;
use super::super::number;
use super::super::syntax::{Name, Operator, Relation, Sign, Span, Spanned};
use super::{Input, Parsed, between, complaint, here};

/// Spaces, line ends and comments, or nothing.
pub(super) fn blank(input: Input<'_>) -> Parsed<'_, ()> {
    let comment = preceded(char('#'), take_till(|character| character == '\n'));
    let piece = alt((take_while1(is_space), comment));
    fold_many0(piece, || (), |(), _| ()).parse(input)
}

/// The input after its blanks.
pub(super) fn skip_blank(input: Input<'_>) -> Input<'_> {
    blank(input).map_or(input, |(rest, ())| rest)
}

/// A token after blanks, with its place.
pub(super) fn token<'a, T>(
    mut parser: impl Parser<Input<'a>, Output = T, Error = super::Problem>,
) -> impl FnMut(Input<'a>) -> Parsed<'a, Spanned<T>> {
    move |input| {
        let start = skip_blank(input);
        let (rest, value) = parser.parse(start)?;
        Ok((rest, Spanned::new(value, between(start, rest))))
    }
}

/// A fixed sign after blanks.
pub(super) fn symbol<'a>(sign: &'static str) -> impl FnMut(Input<'a>) -> Parsed<'a, Span> {
    move |input| {
        let (rest, found) = token(tag(sign)).parse(input)?;
        Ok((rest, found.span))
    }
}

/// A sign that the grammar demands here.
pub(super) fn demand<'a>(sign: &'static str, input: Input<'a>) -> Parsed<'a, Span> {
    match opt(symbol(sign)).parse(input)? {
        (rest, Some(span)) => Ok((rest, span)),
        (_, None) => Err(complaint::expected(input, &format!("`{sign}`"))),
    }
}

/// `+` or `-`.
pub(super) fn additive(input: Input<'_>) -> Parsed<'_, Sign> {
    alt((value(Sign::Plus, char('+')), value(Sign::Minus, one_of("-−")))).parse(input)
}

/// `*` or `/`; refuses `**`.
pub(super) fn multiplicative(input: Input<'_>) -> Parsed<'_, Operator> {
    let (rest, operator) =
        alt((value(Operator::Multiply, one_of("*·×⋅∗")), value(Operator::Divide, char('/'))))
            .parse(input)?;
    let second: Parsed<'_, _> = char('*').parse(rest);
    match (operator, second) {
        (Operator::Multiply, Ok((after, _))) => {
            Err(complaint::double_star(input, between(input, after)))
        }
        _ => Ok((rest, operator)),
    }
}

/// A comparison.
pub(super) fn relation(input: Input<'_>) -> Parsed<'_, Relation> {
    alt((
        value(Relation::GreaterOrEqual, alt((tag(">="), tag("≥")))),
        value(Relation::LessOrEqual, alt((tag("<="), tag("≤")))),
        value(Relation::NotEqual, alt((tag("!="), tag("≠")))),
        value(Relation::Greater, tag(">")),
        value(Relation::Less, tag("<")),
    ))
    .parse(input)
}

/// A prime, straight or as a word processor writes it; how many times it differentiates.
pub(super) fn prime(input: Input<'_>) -> Parsed<'_, u32> {
    alt((value(1, one_of("'′’")), value(2, char('″')))).parse(input)
}

/// A word as it is written: a letter, then letters, digits and `_`.
pub(super) fn word(input: Input<'_>) -> Parsed<'_, &str> {
    let (rest, word) =
        recognize((satisfy(name::is_letter), take_while(name::continues))).parse(input)?;
    Ok((rest, word.text))
}

/// The word that follows the blanks, left where it is.
pub(super) fn next_word(input: Input<'_>) -> Option<Spanned<&str>> {
    peek(token(word)).parse(input).ok().map(|(_, word)| word)
}

/// A given word, and no longer one that starts with it.
pub(super) fn keyword<'a>(wanted: &'static str, input: Input<'a>) -> Parsed<'a, Span> {
    match token(word).parse(input) {
        Ok((rest, found)) if found.value == wanted => Ok((rest, found.span)),
        _ => Err(complaint::expected(input, &format!("`{wanted}`"))),
    }
}

/// A name that the grammar demands here; `what` says whose.
pub(super) fn demand_name<'a>(what: &str, input: Input<'a>) -> Parsed<'a, Name> {
    let Ok((rest, Spanned { value, span })) = token(word).parse(input) else {
        return Err(complaint::expected_name(input, what));
    };
    if name::RESERVED.contains(&value) {
        return Err(complaint::reserved(input, value, span));
    }
    Ok((rest, Spanned::new(name::normalise(value), span)))
}

/// A number literal. The input starts with a digit, or with a point and a digit.
pub(super) fn literal(input: Input<'_>) -> Parsed<'_, BigRational> {
    let (rest, written) = recognize((
        alt((recognize((digit1, opt((char('.'), digit0)))), recognize((char('.'), digit1)))),
        opt((one_of("eE"), opt(one_of("+-−")), digit1)),
    ))
    .parse(input)?;
    let span = between(input, rest);
    if rest.text.starts_with('.') {
        return Err(complaint::two_points(input, span));
    }
    if rest.text.starts_with('_') {
        return Err(complaint::grouped_digits(input, here(rest)));
    }
    match number::literal(written.text) {
        Ok(value) => Ok((rest, value)),
        Err(error) => Err(complaint::literal(input, span, error)),
    }
}

/// Digits alone, as they are written.
pub(super) fn digits(input: Input<'_>) -> Parsed<'_, &str> {
    let (rest, digits) = digit1(input)?;
    Ok((rest, digits.text))
}

/// A string between straight quotes on one line, after blanks.
pub(super) fn string(input: Input<'_>) -> Parsed<'_, Spanned<String>> {
    let start = skip_blank(input);
    let (after, _) = char('"').parse(start)?;
    let (end, text) = take_till(|character| matches!(character, '"' | '\n'))(after)?;
    let Some((rest, _)) = char::<_, super::Problem>('"').parse(end).ok() else {
        return Err(complaint::unclosed_string(input, between(start, after), here(end)));
    };
    let text = text.text.to_string();
    Ok((rest, Spanned::new(text, between(start, rest))))
}
