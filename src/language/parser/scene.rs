//! Statements of scenes: elements with their properties, the line that joins them, observables.

use nom::Parser;
use nom::branch::alt;
use nom::bytes::complete::take_while;
use nom::character::complete::{char, one_of};
use nom::combinator::{opt, value};

use super::super::name;
use super::super::scope::FUNCTIONS;
use super::super::syntax::{
    Declaration, Declared, Factor, Line, Name, ObservedPlace, ObservedTerm, Operator, Property,
    SceneStatement, SceneStatementKind, Section, Sign, Span, Spanned, Unit, UnitFactor,
};
use super::expression::{end, expression};
use super::lexical::{
    additive, demand, demand_name, digits, multiplicative, next_word, skip_blank, symbol, token,
    word,
};
use super::statement::{SYMBOL_FORM, listed, opening, parameter};
use super::{Extent, Input, Parsed, between, complaint};
use crate::limits::MAX_UNIT_POWER;
use crate::scene::{End, Joint, Measure};

/// The words that begin statements, and how each statement is written.
pub(super) const FORMS: [(&str, &str); 13] = [
    ("scene", "scene \"Title\""),
    ("symbol", SYMBOL_FORM),
    ("nonzero", "nonzero a - b"),
    ("material", "material steel { modulus = 210 GPa, density = 7850 kg/m^3 }"),
    ("bar", "bar rod { material = steel, diameter = 20 mm, length = 3/2 m }"),
    ("mass", "mass ram { mass = 2 kg, velocity = 1 m/s }"),
    ("spring", "spring cushion { stiffness = 40 kN/mm }"),
    ("hertz", "hertz tip { radius = 6 mm, modulus = 210 GPa, poisson = 3/10 }"),
    ("support", "support toe { damping = 0.3 kN*s/m }"),
    ("load", "load push { force = exp(-t), until = 4 }"),
    ("line", "line free - ram | rod - fixed"),
    ("contacts", "contacts open"),
    ("observe", "observe v = velocity(rod.left) - velocity(ram)"),
];

/// The ends of a line.
const ENDS: [End; 3] = [End::Free, End::Fixed, End::Endless];

/// What can be measured.
const MEASURES: [Measure; 8] = [
    Measure::Velocity,
    Measure::Force,
    Measure::Strain,
    Measure::Stress,
    Measure::Displacement,
    Measure::Compression,
    Measure::Energy,
    Measure::Momentum,
];

/// Whether a statement opens a brace that it does not close.
pub(super) fn leaves_brace_open(input: Input<'_>) -> bool {
    let code = || input.text.lines().map(|line| line.split('#').next().unwrap_or(line));
    let count = |brace| code().map(|line| line.matches(brace).count()).sum::<usize>();
    count('{') > count('}')
}

/// Any statement after the title.
pub(super) fn statement<'a>(
    input: Input<'a>,
    title: &Spanned<String>,
) -> Parsed<'a, SceneStatement> {
    let (rest, opening) = opening(input)?;
    let (last, kind) = match opening.value {
        "symbol" => {
            let (rest, symbols) = listed(rest, parameter)?;
            (rest, SceneStatementKind::Symbols(symbols))
        }
        "nonzero" => {
            let (rest, value) = expression(rest)?;
            (rest, SceneStatementKind::Nonzero(value))
        }
        "material" => declaration(rest, Declared::Material)?,
        "bar" => declaration(rest, Declared::Bar)?,
        "mass" => declaration(rest, Declared::Mass)?,
        "spring" => declaration(rest, Declared::Spring)?,
        "hertz" => declaration(rest, Declared::Hertz)?,
        "support" => declaration(rest, Declared::Support)?,
        "load" => declaration(rest, Declared::Load)?,
        "line" => line(rest)?,
        "contacts" => contacts(rest)?,
        "observe" => observe(rest)?,
        _ => return Err(complaint::second_title(rest, opening.span, title.span)),
    };
    let span = between(input, last);
    let (rest, ()) = end(last)?;
    Ok((rest, Spanned::new(kind, span)))
}

/// What follows `bar`: `rod { length = 1 m }`
fn declaration(input: Input<'_>, kind: Declared) -> Parsed<'_, SceneStatementKind> {
    let (rest, name) = demand_name(&format!("the name of a {kind}"), input)?;
    let (mut rest, opener) = demand("{", rest)?;
    let mut properties = Vec::new();
    loop {
        if let (after, Some(_)) = opt(symbol("}")).parse(rest)? {
            let declaration = Declaration { kind, name, properties };
            return Ok((after, SceneStatementKind::Declaration(declaration)));
        }
        let (after, property) = property(rest, opener)?;
        properties.push(property);
        rest = match opt(symbol(",")).parse(after)? {
            (after, Some(_)) => after,
            (_, None) if skip_blank(after).text.starts_with('}') => after,
            (_, None) => return Err(complaint::open_brace(after, opener, "`,` or `}`")),
        };
    }
}

/// `length = 3/2 m`
fn property(input: Input<'_>, opener: Span) -> Parsed<'_, Property> {
    if next_word(input).is_none() {
        return Err(complaint::open_brace(input, opener, "a property or `}`"));
    }
    let (rest, name) = demand_name("a property", input)?;
    let (rest, _) = demand("=", rest)?;
    let (rest, value) = with_unit(rest)?;
    let (value, unit) = value;
    Ok((rest, Property { name, value, unit }))
}

/// An expression with the unit of the whole, if there is one.
pub(super) fn with_unit(
    mut input: Input<'_>,
) -> Parsed<'_, (super::super::syntax::Expression, Option<Unit>)> {
    let outside = input.context.extent;
    input.context.extent = Extent::Unit;
    let (mut rest, value) = expression(input)?;
    rest.context.extent = outside;
    let Some(next) = next_word(rest) else { return Ok((rest, (value, None))) };
    let after = rest.context.source.text()[next.span.end..].trim_start();
    if after.starts_with('=') {
        return Err(complaint::missing_comma(rest));
    }
    let (rest, unit) = unit(rest)?;
    if let (_, Some(sign)) = opt(token(additive)).parse(rest)? {
        return Err(complaint::sum_of_units(rest, sign.span, unit.span));
    }
    Ok((rest, (value, Some(unit))))
}

/// `kg/m^3`
fn unit(input: Input<'_>) -> Parsed<'_, Unit> {
    let (mut rest, first) = unit_factor(input, Operator::Multiply)?;
    let mut factors = vec![first];
    while let (after, Some(operator)) = opt(token(multiplicative)).parse(rest)? {
        let (after, factor) = unit_factor(after, operator.value)?;
        factors.push(factor);
        rest = after;
    }
    let span = between(skip_blank(input), rest);
    Ok((rest, Spanned::new(factors, span)))
}

/// `m`, `m^3`, `s^-1`, `m³`
fn unit_factor(input: Input<'_>, operator: Operator) -> Parsed<'_, UnitFactor> {
    let Ok((rest, written)) = token(word).parse(input) else {
        return Err(complaint::expected_unit(input));
    };
    let spelt: String = written
        .value
        .chars()
        .map(|letter| if matches!(letter, '\u{B5}' | 'μ') { 'u' } else { letter })
        .collect();
    let name = Spanned::new(name::normalise(&spelt), written.span);
    let (rest, power) = unit_power(rest)?;
    Ok((rest, UnitFactor { operator, name, power }))
}

/// The superscript digits, in order.
const SUPERSCRIPTS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/// The power of a unit; without one it is 1.
fn unit_power(input: Input<'_>) -> Parsed<'_, i8> {
    let (after, raised) = take_while(|c| c == '⁻' || SUPERSCRIPTS.contains(c)).parse(input)?;
    let (rest, power) = if raised.text.is_empty() {
        let (rest, Some(_)) = opt(symbol("^")).parse(input)? else { return Ok((input, 1)) };
        let (rest, minus) = opt(token(one_of("-−"))).parse(rest)?;
        let (rest, Some(digits)) = opt(token(digits)).parse(rest)? else {
            return Err(complaint::unit_power(input, rest));
        };
        if rest.text.starts_with('.') {
            return Err(complaint::unit_power(input, rest));
        }
        let sign = if minus.is_some() { "-" } else { "" };
        (rest, format!("{sign}{}", digits.value))
    } else {
        let plain = |c| SUPERSCRIPTS.chars().zip("0123456789".chars()).find(|pair| pair.0 == c);
        let digits = raised.text.chars().map(|c| plain(c).map_or('-', |pair| pair.1));
        (after, digits.collect())
    };
    match power.parse::<i8>() {
        Ok(power) if power.unsigned_abs() <= MAX_UNIT_POWER => Ok((rest, power)),
        _ => Err(complaint::unit_power(input, rest)),
    }
}

/// What follows `line`: `free - ram | rod - fixed`
fn line(input: Input<'_>) -> Parsed<'_, SceneStatementKind> {
    let (mut rest, left) = match next_word(input).and_then(|word| end_of_line(word.value)) {
        Some(end) => {
            let (rest, word) = token(word).parse(input)?;
            (rest, Spanned::new(end, word.span))
        }
        None => return Err(complaint::expected_end_of_line(input, "left")),
    };
    let (mut elements, mut joints) = (Vec::<Name>::new(), Vec::new());
    loop {
        let (after, joint) = opt(token(joint)).parse(rest)?;
        let Some(joint) = joint else {
            return Err(match skip_blank(rest).text.is_empty() {
                true => complaint::expected_end_of_line(rest, "right"),
                false => complaint::expected(rest, "`-` or `|`"),
            });
        };
        joints.push(joint);
        let (after, name) = demand_name("the name of an element", after)?;
        rest = after;
        if let Some(end) = end_of_line(&name.value) {
            if elements.is_empty() {
                return Err(complaint::empty_line(rest, left.span, name.span));
            }
            let right = Spanned::new(end, name.span);
            let line = Line { left, elements, joints, right };
            return Ok((rest, SceneStatementKind::Line(line)));
        }
        elements.push(name);
    }
}

/// What follows `contacts`: `open`
fn contacts(input: Input<'_>) -> Parsed<'_, SceneStatementKind> {
    match next_word(input) {
        Some(next) if next.value == "open" => {
            let (rest, _) = token(word).parse(input)?;
            Ok((rest, SceneStatementKind::ContactsOpen))
        }
        _ => Err(complaint::expected(input, "`open`")),
    }
}

fn end_of_line(word: &str) -> Option<End> {
    ENDS.into_iter().find(|end| end.word() == word)
}

/// `-` or `|`
fn joint(input: Input<'_>) -> Parsed<'_, Joint> {
    alt((value(Joint::Bonded, one_of("-−")), value(Joint::Contact, char('|')))).parse(input)
}

/// What follows `observe`: `v = velocity(rod.left) - velocity(ram)`
fn observe(input: Input<'_>) -> Parsed<'_, SceneStatementKind> {
    let (rest, name) = demand_name("the name of an observable", input)?;
    let (rest, _) = demand("=", rest)?;
    let (mut rest, mut sign) = opt(token(additive)).parse(rest)?;
    let mut terms = Vec::new();
    loop {
        let (after, term) = term(rest, sign.map_or(Sign::Plus, |sign| sign.value))?;
        terms.push(term);
        (rest, sign) = opt(token(additive)).parse(after)?;
        if sign.is_none() {
            return Ok((rest, SceneStatementKind::Observe { name, terms }));
        }
    }
}

/// `2*force(pile.right)/3`
fn term(input: Input<'_>, sign: Sign) -> Parsed<'_, Spanned<ObservedTerm>> {
    let (mut rest, mut operator) = (input, Operator::Multiply);
    let (mut factors, mut reading) = (Vec::new(), None::<Reading>);
    loop {
        rest = match next_measure(rest)? {
            Some(measure) => {
                if let Some(first) = &reading {
                    return Err(complaint::two_measures(rest, measure.span, first.measure.span));
                }
                if operator == Operator::Divide {
                    return Err(complaint::divided_by_measure(rest, measure.span));
                }
                let (after, found) = measured(rest, measure)?;
                reading = Some(found);
                after
            }
            None => {
                refuse_group(rest)?;
                rest.context.extent = Extent::Factor;
                let (mut after, value) = expression(rest)?;
                after.context.extent = Extent::Whole;
                factors.push(Factor { operator, value });
                after
            }
        };
        match opt(token(multiplicative)).parse(rest)? {
            (after, Some(next)) => (rest, operator) = (after, next.value),
            (_, None) => break,
        }
    }
    let span = between(skip_blank(input), rest);
    let Some(Reading { measure, place }) = reading else {
        return Err(complaint::nothing_measured(rest, span));
    };
    Ok((rest, Spanned::new(ObservedTerm { sign, factors, measure, place }, span)))
}

/// A measure at a place.
struct Reading {
    measure: Spanned<Measure>,
    place: Spanned<ObservedPlace>,
}

/// What is measured next: the word before a parenthesis. Names that measure nothing are refused
/// unless they may be functions.
fn next_measure(input: Input<'_>) -> Result<Option<Spanned<Measure>>, nom::Err<super::Problem>> {
    let Some(word) = next_word(input) else { return Ok(None) };
    let after = input.context.source.text()[word.span.end..].trim_start();
    let measure = MEASURES.into_iter().find(|measure| measure.word() == word.value);
    match measure {
        Some(measure) if after.starts_with('(') => Ok(Some(Spanned::new(measure, word.span))),
        Some(_) => Err(complaint::measure_alone(input, word.value, word.span)),
        None if after.starts_with('.') => Err(complaint::place_alone(input, word.value, word.span)),
        None if after.starts_with('(')
            && !FUNCTIONS.contains(&word.value)
            && !name::RESERVED.contains(&word.value) =>
        {
            Err(complaint::unknown_measure(input, word.value, word.span, &measure_words()))
        }
        None => Ok(None),
    }
}

fn measure_words() -> [&'static str; 8] {
    MEASURES.map(Measure::word)
}

/// Refuses a sum of measures in parentheses.
fn refuse_group(input: Input<'_>) -> Result<(), nom::Err<super::Problem>> {
    let start = skip_blank(input);
    if !start.text.starts_with('(') {
        return Ok(());
    }
    let mut depth = 0_usize;
    for (at, character) in start.text.char_indices() {
        match character {
            '(' => {
                depth += 1;
                let before = start.text[..at].trim_end();
                if measure_words().iter().any(|word| before.ends_with(word)) {
                    let offset = start.offset;
                    return Err(complaint::grouped_measures(input, Span::new(offset, offset + 1)));
                }
            }
            ')' if depth == 1 => return Ok(()),
            ')' => depth -= 1,
            _ => {}
        }
    }
    Ok(())
}

/// `force(pile.right)`
fn measured(input: Input<'_>, measure: Spanned<Measure>) -> Parsed<'_, Reading> {
    let (rest, _) = token(word).parse(input)?;
    let (rest, opener) = demand("(", rest)?;
    let (rest, place) = place(rest)?;
    match opt(symbol(")")).parse(rest)? {
        (rest, Some(_)) if skip_blank(rest).text.starts_with('^') => {
            Err(complaint::power_of_measure(rest, measure.span))
        }
        (rest, Some(_)) => Ok((rest, Reading { measure, place })),
        (_, None) => Err(complaint::unclosed_place(rest, opener)),
    }
}

/// `pile.right`, `pile.at(1/2)`, `ram`
fn place(input: Input<'_>) -> Parsed<'_, Spanned<ObservedPlace>> {
    let start = skip_blank(input);
    let (rest, element) = demand_name("the name of an element, or `line`", input)?;
    let (rest, section) = match opt(symbol(".")).parse(rest)? {
        (_, None) => (rest, None),
        (after, Some(_)) => {
            let (rest, section) = section(after, &element.value)?;
            (rest, Some(section))
        }
    };
    let span = between(start, rest);
    Ok((rest, Spanned::new(ObservedPlace { element, section }, span)))
}

/// `left`, `right`, `at(1/2)`
fn section<'a>(input: Input<'a>, element: &str) -> Parsed<'a, Section> {
    let Ok((rest, found)) = token(word).parse(input) else {
        return Err(complaint::expected_section(input, element));
    };
    match found.value {
        "left" => Ok((rest, Section::Left)),
        "right" => Ok((rest, Section::Right)),
        "at" => {
            let (rest, opener) = demand("(", rest)?;
            let (rest, (position, unit)) = with_unit(rest)?;
            match opt(symbol(")")).parse(rest)? {
                (rest, Some(_)) => Ok((rest, Section::At { position, unit })),
                (_, None) => Err(complaint::unclosed_place(rest, opener)),
            }
        }
        _ => Err(complaint::expected_section(input, element)),
    }
}
