//! Statements of scenes: elements with their properties, the line that joins them, observables.

use super::super::name;
use super::super::scope::FUNCTIONS;
use super::super::syntax::{
    Declaration, Declared, Expression, Factor, Line, Name, ObservedPlace, ObservedTerm, Operator,
    Property, SceneStatementKind, Section, Sign, Span, Spanned, Unit, UnitFactor,
};
use super::complaint::{self, plain};
use super::expression::{expression, expression_to};
use super::input::Extent;
use super::statement::{listed, parameter};
use super::{Input, Outcome};
use crate::limits::MAX_UNIT_POWER;
use crate::scene::{End, Joint, Measure};
use nom::bytes::complete::take_while1;

/// Whether a statement opens a brace that it does not close.
pub(super) fn leaves_brace_open(input: Input<'_>) -> bool {
    let code = || input.text.lines().map(|line| line.split('#').next().unwrap_or(line));
    let count = |brace| code().map(|line| line.matches(brace).count()).sum::<usize>();
    count('{') > count('}')
}

/// What follows the first word of a statement of a scene.
pub(super) fn kind(input: &mut Input<'_>, word: &str) -> Outcome<SceneStatementKind> {
    if let Some(kind) = Declared::of(word) {
        return Ok(SceneStatementKind::Declaration(declaration(input, kind)?));
    }
    Ok(match word {
        "symbol" => SceneStatementKind::Symbols(listed(input, parameter)?),
        "nonzero" => SceneStatementKind::Nonzero(expression(input)?),
        "line" => SceneStatementKind::Line(line(input)?),
        "contacts" => {
            input.keyword("open")?;
            SceneStatementKind::ContactsOpen
        }
        _ => observe(input)?,
    })
}

/// What follows `bar`: `rod { length = 1 m }`
fn declaration(input: &mut Input<'_>, kind: Declared) -> Outcome<Declaration> {
    let name = input.name(&format!("the name of a {kind}"))?;
    let opener = input.demand("{")?;
    let mut properties = Vec::new();
    while input.symbol("}").is_none() {
        properties.push(property(input, opener)?);
        if input.symbol(",").is_none() && !input.next_is("}") {
            return Err(complaint::open_brace(*input, opener, "`,` or `}`"));
        }
    }
    Ok(Declaration { kind, name, properties })
}

/// `length = 3/2 m`
fn property(input: &mut Input<'_>, opener: Span) -> Outcome<Property> {
    if input.next_word().is_none() {
        return Err(complaint::open_brace(*input, opener, "a property or `}`"));
    }
    let name = input.name("a property")?;
    input.demand("=")?;
    let (value, unit) = with_unit(input)?;
    Ok(Property { name, value, unit })
}

/// What stands behind a word that was looked at, blanks left out.
fn after<'a>(input: &Input<'a>, word: Spanned<&str>) -> &'a str {
    input.context.source.text()[word.span.end..].trim_start()
}

/// An expression with the unit of the whole, if there is one.
pub(super) fn with_unit(input: &mut Input<'_>) -> Outcome<(Expression, Option<Unit>)> {
    let value = expression_to(input, Extent::Unit)?;
    let Some(next) = input.next_word() else { return Ok((value, None)) };
    if after(input, next).starts_with('=') {
        return Err(complaint::lacking(*input, complaint::COMMA));
    }
    let unit = unit(input)?;
    match input.additive() {
        None => Ok((value, Some(unit))),
        Some(sign) => Err(plain(*input, sign.span, complaint::SUM_OF_UNITS)
            .with_secondary(unit.span, "the unit ends the value")),
    }
}

/// `kg/m^3`
fn unit(input: &mut Input<'_>) -> Outcome<Unit> {
    let start = input.after_blanks().offset;
    let mut factors = vec![unit_factor(input, Operator::Multiply)?];
    while let Some(operator) = input.multiplicative()? {
        factors.push(unit_factor(input, operator.value)?);
    }
    Ok(Spanned::new(factors, Span::new(start, input.offset)))
}

/// `m`, `m^3`, `s^-1`, `m³`
fn unit_factor(input: &mut Input<'_>, operator: Operator) -> Outcome<UnitFactor> {
    let Some(written) = input.word() else {
        return Err(complaint::lacking(*input, complaint::UNIT));
    };
    if input.after_blanks().text.starts_with('(') {
        return Err(complaint::unit_first(*input, written.span));
    }
    let spelt = written.value.replace(['\u{B5}', 'μ'], "u");
    let name = Spanned::new(name::normalise(&spelt), written.span);
    let power = unit_power(input)?;
    Ok(UnitFactor { operator, name, power })
}

/// The superscript digits, in order.
const SUPERSCRIPTS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/// The power of a unit; without one it is 1.
fn unit_power(input: &mut Input<'_>) -> Outcome<i8> {
    let before = *input;
    let is_raised = |c: char| c == '⁻' || SUPERSCRIPTS.contains(c);
    let power: String = if let Some(raised) = input.take_if(take_while1(is_raised)) {
        let plain = |c| SUPERSCRIPTS.chars().zip('0'..='9').find(|pair| pair.0 == c);
        raised.chars().map(|c| plain(c).map_or('-', |pair| pair.1)).collect()
    } else if input.symbol("^").is_some() {
        let sign = if input.one_of(&[("-", ()), ("−", ())]).is_some() { "-" } else { "" };
        let digits = input.digits().filter(|_| !input.text.starts_with('.'));
        format!("{sign}{}", digits.map_or("", |digits| digits.value))
    } else {
        return Ok(1);
    };
    match power.parse::<i8>() {
        Ok(power) if power.unsigned_abs() <= MAX_UNIT_POWER => Ok(power),
        _ => Err(complaint::unit_power(before, *input)),
    }
}

/// What follows `line`: `free - ram | rod |1/5 mm| fixed`
fn line(input: &mut Input<'_>) -> Outcome<Line> {
    let before = *input;
    let first = input.word().and_then(|word| Some((end_of_line(word.value)?, word.span)));
    let Some((end, span)) = first else {
        return Err(complaint::expected_left_end(before));
    };
    let left = Spanned::new(end, span);
    let (mut elements, mut joints, mut gaps) = (Vec::<Name>::new(), Vec::new(), Vec::new());
    loop {
        let signs = [("-", Joint::Bonded), ("−", Joint::Bonded), ("|", Joint::Contact)];
        let Some(joint) = input.one_of(&signs) else {
            return Err(match (input.after_blanks().text.is_empty(), elements.last()) {
                (true, Some(last)) => complaint::expected_right_end(*input, last),
                _ => complaint::expected(*input, "`-` or `|`"),
            });
        };
        joints.push(match next_gap(input, joint)? {
            None => joint,
            Some((width, unit)) => {
                gaps.push((joints.len(), width, unit));
                Spanned::new(joint.value, Span::new(joint.span.start, input.offset))
            }
        });
        let name = input.name("the name of an element")?;
        let Some(end) = end_of_line(&name.value) else {
            elements.push(name);
            continue;
        };
        if elements.is_empty() {
            return Err(plain(*input, name.span, complaint::EMPTY_LINE)
                .with_secondary(left.span, "the left end"));
        }
        return Ok(Line { left, elements, joints, gaps, right: Spanned::new(end, name.span) });
    }
}

/// What follows the first bar of `|0.2 mm|`, where a number or a parenthesis does.
fn next_gap(
    input: &mut Input<'_>,
    joint: Spanned<Joint>,
) -> Outcome<Option<(Expression, Option<Unit>)>> {
    let is_value = |c: char| c.is_ascii_digit() || "(+-−".contains(c);
    if joint.value != Joint::Contact || !input.after_blanks().text.starts_with(is_value) {
        return Ok(None);
    }
    let text = input.after_blanks().text;
    let is_open = text.find('|').is_none_or(|end| text[..end].contains(" - "));
    let before = *input;
    let width = if is_open { None } else { Some(with_unit(input)?) };
    match width.filter(|_| input.symbol("|").is_some()) {
        None => Err(plain(before, joint.span, complaint::OPEN_GAP)),
        width => Ok(width),
    }
}

fn end_of_line(word: &str) -> Option<End> {
    End::ALL.into_iter().find(|end| end.word() == word)
}

/// What follows `observe`: `v = velocity(rod.left) - velocity(ram)`
fn observe(input: &mut Input<'_>) -> Outcome<SceneStatementKind> {
    let name = input.name("the name of an observable")?;
    input.demand("=")?;
    let first = input.additive().map_or(Sign::Plus, |sign| sign.value);
    let mut terms = vec![term(input, first)?];
    while let Some(sign) = input.additive() {
        terms.push(term(input, sign.value)?);
    }
    Ok(SceneStatementKind::Observe { name, terms })
}

/// `2*force(pile.right)/3`
fn term(input: &mut Input<'_>, sign: Sign) -> Outcome<Spanned<ObservedTerm>> {
    let start = input.after_blanks().offset;
    let mut operator = Operator::Multiply;
    let mut factors = Vec::new();
    let mut reading: Option<(Spanned<Measure>, Spanned<ObservedPlace>)> = None;
    loop {
        match (next_measure(*input)?, &reading) {
            (Some(measure), Some((first, _))) => {
                return Err(plain(*input, measure.span, complaint::TWO_MEASURES)
                    .with_secondary(first.span, "a measure"));
            }
            (Some(measure), None) if operator == Operator::Divide => {
                return Err(plain(*input, measure.span, complaint::DIVIDED_BY_MEASURE));
            }
            (Some(measure), None) => reading = Some((measure, measured(input, measure)?)),
            (None, _) => {
                refuse_group(*input)?;
                let value = expression_to(input, Extent::Factor)?;
                factors.push(Factor { operator, value });
            }
        }
        match input.multiplicative()? {
            Some(next) => operator = next.value,
            None => break,
        }
    }
    let span = Span::new(start, input.offset);
    let Some((measure, place)) = reading else {
        return Err(plain(*input, span, complaint::NOTHING_MEASURED));
    };
    Ok(Spanned::new(ObservedTerm { sign, factors, measure, place }, span))
}

/// What is measured next: the word before a parenthesis. Names that measure nothing are refused
/// unless they may be functions.
fn next_measure(input: Input<'_>) -> Outcome<Option<Spanned<Measure>>> {
    let Some(word) = input.next_word() else { return Ok(None) };
    let Spanned { value, span } = word;
    let measure = Measure::ALL.into_iter().find(|measure| measure.word() == value);
    match (measure, after(&input, word).chars().next()) {
        (Some(measure), Some('(')) => Ok(Some(Spanned::new(measure, span))),
        (Some(_), _) => Err(complaint::measure_alone(input, value, span)),
        (None, Some('.')) => Err(complaint::place_alone(input, value, span)),
        (None, Some('(')) if !FUNCTIONS.contains(&value) && !name::RESERVED.contains(&value) => {
            Err(complaint::unknown_measure(input, value, span))
        }
        (None, _) => Ok(None),
    }
}

/// Refuses a sum of measures in parentheses.
fn refuse_group(input: Input<'_>) -> Outcome<()> {
    let start = input.after_blanks();
    let mut depth = 0_usize;
    for (at, character) in start.text.char_indices() {
        match character {
            '(' => {
                depth += 1;
                let before = start.text[..at].trim_end();
                if Measure::ALL.iter().any(|measure| before.ends_with(measure.word())) {
                    let opener = Span::new(start.offset, start.offset + 1);
                    return Err(plain(input, opener, complaint::GROUPED_MEASURES));
                }
            }
            _ if depth == 0 => return Ok(()),
            ')' if depth == 1 => return Ok(()),
            ')' => depth -= 1,
            _ => {}
        }
    }
    Ok(())
}

/// `force(pile.right)`, of which the measure is known already.
fn measured(input: &mut Input<'_>, measure: Spanned<Measure>) -> Outcome<Spanned<ObservedPlace>> {
    input.keyword(measure.value.word())?;
    let opener = input.demand("(")?;
    let place = place(input)?;
    if input.symbol(")").is_none() {
        return Err(complaint::unclosed_place(*input, opener));
    }
    match input.next_is("^") {
        true => Err(complaint::power_of_measure(*input, measure.span)),
        false => Ok(place),
    }
}

/// `pile.right`, `pile.at(1/2)`, `ram`
fn place(input: &mut Input<'_>) -> Outcome<Spanned<ObservedPlace>> {
    let element = input.name("the name of an element, or `line`")?;
    let start = element.span.start;
    let section = match input.symbol(".") {
        Some(_) => Some(section(input, &element.value)?),
        None => None,
    };
    Ok(Spanned::new(ObservedPlace { element, section }, Span::new(start, input.offset)))
}

/// `left`, `right`, `at(1/2)`
fn section(input: &mut Input<'_>, element: &str) -> Outcome<Section> {
    let before = *input;
    match input.word().map(|found| found.value) {
        Some("left") => Ok(Section::Left),
        Some("right") => Ok(Section::Right),
        Some("at") => {
            let opener = input.demand("(")?;
            let (position, unit) = with_unit(input)?;
            match input.symbol(")") {
                Some(_) => Ok(Section::At { position, unit }),
                None => Err(complaint::unclosed_place(*input, opener)),
            }
        }
        _ => Err(complaint::expected_section(before, element)),
    }
}
