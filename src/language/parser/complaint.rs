//! What the parser says about texts it refuses. Every function here ends the parse.

use super::super::diagnostic::{Diagnostic, closest};
use super::super::number::LiteralError;
use super::super::source::Source;
use super::super::syntax::{Expression, Name, Node, Span};
use super::expression::FOLLOWING;
use super::lexical::{digits, next_word, skip_blank, token};
use super::statement::SYMBOL_FORM;
use super::{Context, Extent, Input, Problem, between, here};
use crate::limits::{MAX_DECIMAL_EXPONENT, MAX_INDEX, MAX_NESTING, MAX_NUMBER_DIGITS};

use nom::Parser;

type Refusal = nom::Err<Problem>;

pub(super) fn refuse(diagnostic: Diagnostic) -> Refusal {
    nom::Err::Failure(Problem::Refused(diagnostic))
}

pub(super) fn at(
    input: Input<'_>,
    message: impl Into<String>,
    span: Span,
    label: impl Into<String>,
) -> Diagnostic {
    Diagnostic::new(input.context.source, message, span, label)
}

/// What stands next, as a reader would call it, and its place. The end is just behind the last token.
struct Found {
    description: String,
    span: Span,
    kind: FoundKind,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum FoundKind {
    End,
    /// A word that begins statements, at the start of a line.
    Keyword,
    Word,
    Number,
    Character(char),
}

fn found(input: Input<'_>) -> Found {
    let start = skip_blank(input);
    let Some(next) = start.text.chars().next() else {
        return Found {
            description: format!("the end of the {}", input.context.unit),
            span: here(input),
            kind: FoundKind::End,
        };
    };
    if let Some(word) = next_word(start) {
        let skipped = &input.text[..between(input, start).end - input.offset];
        let opens_line = skipped.contains('\n');
        let is_keyword = input.context.forms.iter().any(|(keyword, _)| *keyword == word.value);
        return Found {
            description: quoted(word.value),
            span: word.span,
            kind: if opens_line && is_keyword { FoundKind::Keyword } else { FoundKind::Word },
        };
    }
    if let Ok((_, number)) = token(digits).parse(start) {
        return Found {
            description: quoted(number.value),
            span: number.span,
            kind: FoundKind::Number,
        };
    }
    let offset = start.offset;
    let pair = PAIRS.iter().find(|pair| start.text.starts_with(**pair));
    let (description, length) = match pair {
        Some(pair) => (format!("`{pair}`"), pair.len()),
        None => (character(next), next.len_utf8()),
    };
    Found {
        description,
        span: Span::new(offset, offset + length),
        kind: FoundKind::Character(next),
    }
}

/// Signs of two characters, which messages name as a whole.
const PAIRS: [&str; 9] = ["<=", ">=", "!=", "==", ":=", "=>", "=<", "..", "//"];

/// A word in quotation marks, cut if it is long.
fn quoted(word: &str) -> String {
    const SHOWN: usize = 40;
    match word.char_indices().nth(SHOWN) {
        None => format!("`{word}`"),
        Some((cut, _)) => format!("`{}…`", &word[..cut]),
    }
}

fn character(character: char) -> String {
    if character.is_ascii() {
        format!("`{character}`")
    } else {
        let code = u32::from(character);
        if character.is_whitespace() || !is_visible(character) {
            format!("U+{code:04X}, which is invisible")
        } else {
            format!("`{character}` (U+{code:04X})")
        }
    }
}

fn is_visible(character: char) -> bool {
    !matches!(character, '\u{AD}' | '\u{200B}'..='\u{200F}' | '\u{2060}'..='\u{206F}' | '\u{FEFF}')
}

/// What to write instead of a character that has no meaning here.
fn replacement(character: char) -> Option<&'static str> {
    Some(match character {
        '²' => "write `^2`",
        '³' => "write `^3`",
        '⁰' | '¹' | '⁴'..='⁹' | 'ⁿ' => "write powers with `^`: `x^4`",
        '₀'..='₉' => "write indices of names with `_`: `x_1`",
        '–' | '—' | '‐' | '‑' => "this is a dash; write the minus sign `-`",
        '÷' => "write `/`",
        '∞' => "only finite numbers can be used",
        '√' => "write `sqrt(2)`",
        '“' | '”' | '„' | '«' | '»' => "write straight quotation marks: \"…\"",
        '{' | '}' => "group with parentheses: `(…)`",
        '!' => "there is no factorial; `!` only stands in `!=`",
        '%' => "there is no percent sign; write `0.05` for 5 %",
        ';' => "end a statement by ending the line; separate names by `,`",
        '"' => "only the title is quoted",
        '|' => "there is no absolute value",
        '\\' => "this is no LaTeX: write `mu`, `exp(…)`, `a/b`",
        ':' => "write `=`, not `:=`",
        _ => return None,
    })
}

fn form_remedy(input: Input<'_>) -> Option<String> {
    input.context.form.map(|form| format!("write it like `{form}`"))
}

/// Something else is needed than what stands here.
pub(super) fn expected(input: Input<'_>, what: &str) -> Refusal {
    refuse(stray(input).unwrap_or_else(|| expected_diagnostic(input, what, form_remedy(input))))
}

/// A name is needed.
pub(super) fn expected_name(input: Input<'_>, what: &str) -> Refusal {
    let remedy = match (found(input).kind, form_remedy(input)) {
        (FoundKind::Number, Some(form)) => Some(format!("a name begins with a letter; {form}")),
        (_, remedy) => remedy,
    };
    refuse(expected_diagnostic(input, what, remedy))
}

/// Something follows what is already complete.
pub(super) fn expected_end(input: Input<'_>) -> Refusal {
    if let Some(diagnostic) = stray(input) {
        return refuse(diagnostic);
    }
    let next = skip_blank(input);
    let unit = input.context.unit;
    let one_equals =
        !input.context.is_scene() && input.context.form.is_none_or(|form| form.contains('='));
    if next.text.starts_with('=') && one_equals {
        let diagnostic = at(input, "one `=` too many", found(input).span, "not expected here");
        return refuse(match input.context.form {
            Some(_) => diagnostic.with_remedy("write `a = b = c` as two equations"),
            None => diagnostic.with_remedy(format!("write only the {unit} itself, without `=`")),
        });
    }
    let mut after = next.text.chars();
    let decimal_comma = before(input).is_some_and(|last| last.is_ascii_digit())
        && after.next() == Some(',')
        && after.next().is_some_and(|digit| digit.is_ascii_digit());
    let is_value = next.text.starts_with('=') && input.context.form == Some(SYMBOL_FORM);
    let remedy = if is_value {
        Some(
            "a symbol stands for every value that meets its condition, such as `mu > 0`".to_owned(),
        )
    } else if decimal_comma {
        Some("decimals are written with a point: `0.5`".to_owned())
    } else {
        form_remedy(input)
    };
    refuse(expected_diagnostic(input, &format!("the end of the {unit}"), remedy))
}

/// The character just before.
fn before(input: Input<'_>) -> Option<char> {
    input.context.source.text()[..input.offset].chars().next_back()
}

/// Signs that are wrong after any complete expression.
fn stray(input: Input<'_>) -> Option<Diagnostic> {
    let Found { span, kind: FoundKind::Character(next), .. } = found(input) else {
        return None;
    };
    match next {
        ')' | ']' => {
            let opening = if next == ')' { '(' } else { '[' };
            let message = format!("`{next}` without `{opening}`");
            let remedy = format!("delete it, or add the missing `{opening}` before it");
            Some(at(input, message, span, "closes nothing").with_remedy(remedy))
        }
        '[' if before(input) == Some(')') => Some(
            at(input, "only a wave has an index", span, "this index belongs to no name")
                .with_remedy("write the index after each wave: `f[n] + g[n]`"),
        ),
        '\'' | '′' | '’' | '″' => Some(misplaced_prime(input, span, "f")),
        _ => None,
    }
}

/// The remedy is the one given, unless the text suggests a better one.
fn expected_diagnostic(input: Input<'_>, what: &str, remedy: Option<String>) -> Diagnostic {
    let Found { description, span, kind } = found(input);
    let better = match kind {
        FoundKind::Keyword => Some(
            "this line is indented deeper than the first statement, so it continues the line \
             before; remove the indentation to start a statement",
        ),
        FoundKind::Character(found) if is_sign_of_scenes(input, found) => None,
        FoundKind::Character(found) => replacement(found),
        FoundKind::End | FoundKind::Word | FoundKind::Number => None,
    };
    let diagnostic = match kind {
        FoundKind::Character(found) if is_foreign(input, found) => {
            let message = format!("unexpected character {description}");
            at(input, message, span, format!("expected {what}"))
                .with_remedy(better.unwrap_or(ALPHABET))
        }
        _ => {
            let message = format!("expected {what}, found {description}");
            at(input, message, span, format!("expected {what}"))
        }
    };
    match better.map(str::to_owned).or(remedy) {
        Some(remedy) if diagnostic.remedy().is_none() => diagnostic.with_remedy(remedy),
        _ => diagnostic,
    }
}

const ALPHABET: &str = "outside the title and comments, write ASCII and Greek letters, digits, `_` \
                        and the signs of arithmetic";

fn is_sign_of_scenes(input: Input<'_>, character: char) -> bool {
    input.context.is_scene() && matches!(character, '{' | '}' | '|')
}

/// Whether a character stands nowhere in the language but in titles and comments.
fn is_foreign(input: Input<'_>, character: char) -> bool {
    !is_sign_of_scenes(input, character) && !"()[]+-−*·×⋅∗/^=<>≤≥!≠,.:'′’″\"".contains(character)
}

/// An operand is missing.
pub(super) fn expected_expression(input: Input<'_>) -> Refusal {
    let start = skip_blank(input);
    let previous = before(input).filter(|_| input.offset > 0);
    if start.text.starts_with('=') && previous == Some('=') {
        let span = Span::new(input.offset - 1, start.offset + 1);
        return refuse(
            at(input, "`==` is no sign of the language", span, "an equation?")
                .with_remedy("write one `=`"),
        );
    }
    let remedy = match previous {
        Some(operator @ ('+' | '-' | '*' | '/' | '^')) => {
            Some(format!("write an operand after `{operator}`, or delete the `{operator}`"))
        }
        _ if start.text.starts_with('{') => replacement('{').map(str::to_owned),
        Some('(') => Some("write an expression between the parentheses".to_owned()),
        _ => form_remedy(input),
    };
    refuse(expected_diagnostic(input, "a number, a name or `(`", remedy))
}

/// A text without anything in it, where one expression was expected.
pub(super) fn nothing(source: &Source, unit: &str) -> Diagnostic {
    let remedy = if unit == "number" { NUMBERS } else { "write an expression such as `2*mu`" };
    Diagnostic::new(source, format!("no {unit} is given"), Span::new(0, 0), "nothing here")
        .with_remedy(remedy)
}

/// What numbers look like.
const NUMBERS: &str = "write a plain number such as `3`, `0.25`, `33/10` or `1e-3`";

/// A parenthesis or bracket is not closed before something else comes.
pub(super) fn unclosed(input: Input<'_>, opener: Span, closing: &str) -> Refusal {
    let opening = input.context.source.slice(opener);
    let next = found(input);
    let remedy = format!("add the missing `{closing}`");
    if matches!(next.kind, FoundKind::End | FoundKind::Keyword) {
        let stop = next.description;
        return refuse(
            at(input, format!("`{opening}` is never closed"), opener, "opened here")
                .with_secondary(here(input), format!("`{closing}` expected before {stop}"))
                .with_remedy(remedy),
        );
    }
    let what = format!("an operator or `{closing}`");
    let remedy = if next.kind == FoundKind::Word && input.context.extent == Extent::Unit {
        "a unit stands behind the whole value, and multiplication is always written".to_owned()
    } else {
        remedy
    };
    refuse(expected_diagnostic(input, &what, Some(remedy)).with_secondary(opener, "opened here"))
}

/// Two factors stand side by side.
pub(super) fn missing_operator(left: &Expression, input: Input<'_>) -> Refusal {
    const SHOWN: usize = 20;
    let next = found(input);
    let Context { source, unit, form, .. } = input.context;
    if next.kind == FoundKind::Keyword {
        return expected(input, "an operator or the end of the statement");
    }
    let (before, after) = (source.slice(left.span), source.slice(next.span));
    let wanted = closest(after, FOLLOWING).filter(|&word| form.is_some_and(|f| f.contains(word)));
    if let Some(word) = wanted {
        let message = format!("expected `{word}`, found {}", next.description);
        let label = format!("expected `{word}`");
        let remedy = format!("did you mean `{word}`?");
        return refuse(at(input, message, next.span, label).with_remedy(remedy));
    }
    let numbers = matches!(left.value, Node::Number(_)) && next.kind == FoundKind::Number;
    let applied = source.text()[next.span.end..].starts_with('(');
    let unit_first = input.context.extent == Extent::Unit
        && matches!(left.value, Node::Name(_))
        && next.kind == FoundKind::Number;
    let remedy = if unit_first {
        format!(
            "a unit stands behind the value, as in `{after} {before}`; a product is written `{before}*{after}`"
        )
    } else if numbers {
        format!("join the digits, or write an operator between `{before}` and `{after}`")
    } else if unit == "number" {
        format!("{NUMBERS}, without a unit")
    } else if before.len() > SHOWN || after.len() > SHOWN {
        "write `*` between them".to_owned()
    } else if after == "(" {
        format!("write `{before}*(…)`")
    } else if applied {
        format!("write `{before}*{after}(…)`")
    } else {
        format!("write `{before}*{after}`")
    };
    refuse(
        at(
            input,
            format!("an operator is missing before {}", next.description),
            next.span,
            "multiplication is always written",
        )
        .with_secondary(left.span, "the factor before")
        .with_remedy(remedy),
    )
}

/// `**`
pub(super) fn double_star(input: Input<'_>, span: Span) -> Refusal {
    refuse(
        at(input, "`**` is no operator", span, "a power?")
            .with_remedy("write powers with `^`: `x^2`"),
    )
}

/// `f'` or `f'[n]`
pub(super) fn early_prime(input: Input<'_>, span: Span, name: &str) -> Refusal {
    refuse(misplaced_prime(input, span, name))
}

fn misplaced_prime(input: Input<'_>, span: Span, name: &str) -> Diagnostic {
    at(input, "a prime stands only after the index of a wave", span, "not after an index")
        .with_remedy(format!("write the derivative of a wave as `{name}[n]'`"))
}

/// `exp` or another function where a name is needed.
pub(super) fn reserved(input: Input<'_>, name: &str, span: Span) -> Refusal {
    refuse(
        at(
            input,
            format!("`{name}` is a function of the language, so nothing else can have this name"),
            span,
            "reserved",
        )
        .with_remedy("choose another name"),
    )
}

/// `exp` or another function without argument.
pub(super) fn function_alone(input: Input<'_>, name: &str, span: Span) -> Refusal {
    let form = match name {
        "cos" => "cos(2*t)",
        "exp" => "exp(-2*t)",
        "sin" => "sin(2*t)",
        "sqrt" => "sqrt(3)",
        _ => "sum(f[i], i < n)",
    };
    refuse(
        at(
            input,
            format!("`{name}` needs an argument in parentheses"),
            span,
            "`(` expected after this",
        )
        .with_remedy(format!("write it like `{form}`")),
    )
}

/// `sum(a[i])`
pub(super) fn sum_without_range(input: Input<'_>, opener: Span) -> Refusal {
    const RANGE: &str = "a sum says over what it runs: `sum(f[i], i < n)`";
    refuse(
        expected_diagnostic(input, "`,` and the range of the sum", Some(RANGE.to_owned()))
            .with_secondary(opener, "the sum opens here"),
    )
}

/// `sum(a[i], i = 0..n)`
pub(super) fn sum_range(input: Input<'_>, index: &Name) -> Refusal {
    let index = &index.value;
    let remedy =
        format!("the range of a sum is written `{index} < n`; it starts at 0 and ends at n-1");
    refuse(expected_diagnostic(input, "`<`", Some(remedy)))
}

const INDEX_REMEDY: &str = "an index is written `n`, `n-1`, `n+1`, or as a whole number";

/// `f[2*n]`, `f[]`
pub(super) fn index_form(input: Input<'_>) -> Refusal {
    refuse(expected_diagnostic(input, "a wave index", Some(INDEX_REMEDY.to_owned())))
}

/// `f[n-1-1]`, `f[n`
pub(super) fn index_end(input: Input<'_>, opener: Span) -> Refusal {
    if found(input).kind == FoundKind::End {
        return unclosed(input, opener, "]");
    }
    refuse(
        expected_diagnostic(input, "`]`", Some(INDEX_REMEDY.to_owned()))
            .with_secondary(opener, "the index opens here"),
    )
}

/// `f[n-99999999]`
pub(super) fn index_too_large(input: Input<'_>, span: Span) -> Refusal {
    refuse(
        at(input, format!("the index is larger than {MAX_INDEX}"), span, "too large")
            .with_remedy("use a smaller index"),
    )
}

/// `f[n](t)`
pub(super) fn index_and_argument(input: Input<'_>, name: &str) -> Refusal {
    let start = skip_blank(input);
    let offset = start.offset;
    refuse(
        at(
            input,
            "a wave has an index or an argument, not both",
            Span::new(offset, offset + 1),
            "an argument after an index",
        )
        .with_remedy(format!(
            "write `{name}[n]` for a period, `{name}(t)` for a time; for a product write `*`"
        )),
    )
}

/// `1.2.3`
pub(super) fn two_points(input: Input<'_>, span: Span) -> Refusal {
    let second = Span::new(span.end, span.end + 1);
    refuse(
        at(input, "a number with two decimal points", second, "second point")
            .with_remedy("write one point: `0.25`"),
    )
}

/// `1_000`
pub(super) fn grouped_digits(input: Input<'_>, place: Span) -> Refusal {
    let span = Span::new(place.start, place.start + 1);
    refuse(
        at(input, "`_` inside a number", span, "not a digit")
            .with_remedy("write digits without separators: `1000`, `1e3`"),
    )
}

/// A literal beyond the limits.
pub(super) fn literal(input: Input<'_>, span: Span, error: LiteralError) -> Refusal {
    refuse(match error {
        LiteralError::TooManyDigits => at(
            input,
            format!("a number with more than {MAX_NUMBER_DIGITS} digits"),
            span,
            "too long",
        )
        .with_remedy("write fewer digits, or a fraction"),
        LiteralError::ExponentTooLarge => at(
            input,
            format!("the decimal exponent is beyond ±{MAX_DECIMAL_EXPONENT}"),
            span,
            "out of range",
        )
        .with_remedy("choose units in which the numbers are of moderate size"),
    })
}

/// Too many levels.
pub(super) fn too_deep(input: Input<'_>, span: Span) -> Refusal {
    refuse(
        at(input, format!("nested deeper than {MAX_NESTING} levels"), span, "one level too many")
            .with_remedy("remove needless parentheses and signs, or name a part with a symbol"),
    )
}

/// A quotation mark without partner.
pub(super) fn unclosed_string(input: Input<'_>, opener: Span, end: Span) -> Refusal {
    refuse(
        at(input, "the quotation mark is never closed", opener, "opened here")
            .with_secondary(end, "`\"` expected before the end of the line")
            .with_remedy("a title stands on one line, and contains no quotation mark"),
    )
}

/// `recurrence` without a string.
pub(super) fn expected_title(input: Input<'_>) -> Refusal {
    expected(input, "a title in quotation marks")
}

/// The first statement is another than `recurrence`.
pub(super) fn title_missing(input: Input<'_>, span: Span) -> Refusal {
    refuse(
        at(input, "the text does not begin with its title", span, "the first statement")
            .with_remedy(format!("put a first line before it: `{}`", input.context.forms[0].1)),
    )
}

/// A second `recurrence` or `scene`.
pub(super) fn second_title(input: Input<'_>, span: Span, first: Span) -> Refusal {
    let whole = input.context.forms[0].0;
    refuse(
        at(input, "a second title", span, format!("another {whole} begins here"))
            .with_secondary(first, "the first title")
            .with_remedy(format!("a text holds one {whole}; put the other into a file of its own")),
    )
}

/// A statement that begins with no word at all.
pub(super) fn no_keyword(input: Input<'_>) -> Refusal {
    let Found { description, span, kind } = found(input);
    let remedy = match kind {
        FoundKind::Character(found) if !is_foreign(input, found) => {
            "to continue the line before, indent this one deeper than the first statement"
                .to_owned()
        }
        _ => keywords(input),
    };
    let message = format!("a statement cannot begin with {description}");
    refuse(at(input, message, span, "expected a statement").with_remedy(remedy))
}

/// A statement that begins with an unknown word.
pub(super) fn unknown_keyword(input: Input<'_>, word: &str, span: Span) -> Refusal {
    let diagnostic =
        at(input, format!("no statement begins with {}", quoted(word)), span, "unknown statement");
    let after = input.text[span.end - input.offset..].trim_start();
    let lower = word.to_ascii_lowercase();
    let remedy = if let Some(keyword) =
        closest(&lower, input.context.forms.iter().map(|(keyword, _)| *keyword))
    {
        format!("did you mean `{keyword}`?")
    } else if !input.context.is_scene()
        && after.starts_with(['[', '\'', '(', '=', '+', '-', '*', '/'])
    {
        format!("an equation begins with `equation`: write `equation {word}…`")
    } else {
        keywords(input)
    };
    refuse(diagnostic.with_remedy(remedy))
}

fn keywords(input: Input<'_>) -> String {
    let words: Vec<String> =
        input.context.forms.iter().map(|(keyword, _)| format!("`{keyword}`")).collect();
    format!("statements begin with one of {}", words.join(", "))
}

/// A text of blanks and comments.
pub(super) fn no_statement(source: &Source, form: &str) -> Diagnostic {
    Diagnostic::new(source, "the text holds no statement", Span::new(0, 0), "no statement here")
        .with_remedy(format!("begin with a line like `{form}`"))
}

/// A failure that no parser explained.
pub(super) fn incomprehensible(source: &Source, span: Span) -> Diagnostic {
    Diagnostic::new(source, "the text cannot be read from here on", span, "not understood")
}

/// What follows a property is neither another nor the end of them.
pub(super) fn open_brace(input: Input<'_>, opener: Span, what: &str) -> Refusal {
    let next = found(input);
    if matches!(next.kind, FoundKind::End | FoundKind::Keyword) {
        return refuse(
            at(input, "`{` is never closed", opener, "opened here")
                .with_secondary(here(input), format!("`}}` expected before {}", next.description))
                .with_remedy("add the missing `}`; lines between braces are indented"),
        );
    }
    let remedy = match next.kind {
        FoundKind::Word => Some(COMMAS.to_owned()),
        _ => form_remedy(input),
    };
    let diagnostic = expected_diagnostic(input, what, remedy);
    refuse(diagnostic.with_secondary(opener, "the properties open here"))
}

const COMMAS: &str = "separate properties by commas, also at the ends of lines";

/// A property directly after another.
pub(super) fn missing_comma(input: Input<'_>) -> Refusal {
    refuse(expected_diagnostic(input, "`,` or a unit", Some(COMMAS.to_owned())))
}

/// `2 m + 3 mm`
pub(super) fn sum_of_units(input: Input<'_>, sign: Span, unit: Span) -> Refusal {
    refuse(
        at(input, "a value has one unit, at its end", sign, "not expected here")
            .with_secondary(unit, "the unit ends the value")
            .with_remedy("work the value out in one unit: `2 + 3/1000 m`"),
    )
}

/// `N/2`
pub(super) fn expected_unit(input: Input<'_>) -> Refusal {
    const FORM: &str = "numbers stand before the unit: `3/2 m`, `7850 kg/m^3`";
    refuse(expected_diagnostic(input, "the name of a unit", Some(FORM.to_owned())))
}

/// A power of a unit that is no small whole number.
pub(super) fn unit_power(from: Input<'_>, to: Input<'_>) -> Refusal {
    let start = skip_blank(from);
    let end = to.offset.max(start.offset);
    refuse(
        at(
            from,
            "the power of a unit is a small whole number",
            Span::new(start.offset, end),
            "not a whole number from -9 to 9",
        )
        .with_remedy("write it like `m^3`, `s^-1` or `m³`"),
    )
}

/// A line that does not say what is at an end.
pub(super) fn expected_end_of_line(input: Input<'_>, side: &str) -> Refusal {
    let remedy = match next_word(input) {
        Some(word) => closest(word.value, ["free", "fixed", "endless"])
            .map(|end| format!("did you mean `{end}`?")),
        None => None,
    };
    let form = "a line goes from end to end: `line free - rod - fixed`";
    let what = format!("what is at the {side} end: `free`, `fixed` or `endless`");
    refuse(expected_diagnostic(input, &what, Some(remedy.unwrap_or_else(|| form.to_owned()))))
}

/// `line free - fixed`
pub(super) fn empty_line(input: Input<'_>, left: Span, right: Span) -> Refusal {
    refuse(
        at(input, "the line holds no element", right, "the right end")
            .with_secondary(left, "the left end")
            .with_remedy("name elements between the ends: `line free - rod - fixed`"),
    )
}

/// `force(a)*velocity(a)`
pub(super) fn two_measures(input: Input<'_>, span: Span, first: Span) -> Refusal {
    refuse(
        at(input, "a product of measures cannot be observed", span, "times this")
            .with_secondary(first, "a measure")
            .with_remedy("observe both, each by a statement of its own, or add them"),
    )
}

/// `force(a)^2`
pub(super) fn power_of_measure(input: Input<'_>, measure: Span) -> Refusal {
    refuse(
        at(input, "a power of a measure cannot be observed", found(input).span, "a power")
            .with_secondary(measure, "of this measure")
            .with_remedy("observe a sum of measures, each with a factor: `2*force(rod.left)`"),
    )
}

/// `1/force(a)`
pub(super) fn divided_by_measure(input: Input<'_>, span: Span) -> Refusal {
    refuse(
        at(input, "a measure cannot be divided by", span, "divided by here")
            .with_remedy("observe a sum of measures, each with a factor: `2*force(rod.left)`"),
    )
}

/// `observe x = 3`
pub(super) fn nothing_measured(input: Input<'_>, span: Span) -> Refusal {
    refuse(at(input, "this measures nothing", span, "no measure in here").with_remedy(
        "each term holds a measure at a place, such as `velocity(ram)` or \
             `2*force(rod.left)`",
    ))
}

/// `observe v = velocity`
pub(super) fn measure_alone(input: Input<'_>, word: &str, span: Span) -> Refusal {
    refuse(
        at(input, format!("`{word}` needs a place in parentheses"), span, "of what, and where?")
            .with_remedy(format!("write it like `{word}(rod.left)` or `{word}(ram)`")),
    )
}

/// `observe v = rod.left`
pub(super) fn place_alone(input: Input<'_>, word: &str, span: Span) -> Refusal {
    refuse(
        at(input, "a place alone is no quantity", span, "what is measured here?")
            .with_remedy(format!("name what is measured: `velocity({word}.left)`")),
    )
}

/// `speed(ram)`
pub(super) fn unknown_measure(
    input: Input<'_>,
    word: &str,
    span: Span,
    words: &[&'static str],
) -> Refusal {
    let known: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    refuse(
        at(input, format!("{} cannot be measured", quoted(word)), span, "no measure")
            .with_closest(word, words.iter().copied())
            .or_remedy(format!("what can be measured: {}", known.join(", "))),
    )
}

/// `(force(a) - force(b))/2`
pub(super) fn grouped_measures(input: Input<'_>, span: Span) -> Refusal {
    refuse(
        at(input, "measures cannot stand in parentheses", span, "opens around a measure")
            .with_remedy("multiply out: `force(a.left)/2 - force(b.left)/2`"),
    )
}

/// The parenthesis of a place is not closed.
pub(super) fn unclosed_place(input: Input<'_>, opener: Span) -> Refusal {
    if found(input).kind == FoundKind::End {
        return unclosed(input, opener, ")");
    }
    const FORM: &str = "a place is an element or a section of a bar: `ram`, `rod.left`, \
                        `rod.at(1/2)`, `line`";
    refuse(
        expected_diagnostic(input, "`)`", Some(FORM.to_owned()))
            .with_secondary(opener, "opened here"),
    )
}

/// `rod.middle`
pub(super) fn expected_section(input: Input<'_>, element: &str) -> Refusal {
    let remedy = next_word(input).and_then(|word| closest(word.value, ["left", "right", "at"]));
    let remedy = match remedy {
        Some(word) => format!("did you mean `{word}`?"),
        None => format!("write `{element}.left`, `{element}.right` or `{element}.at(1/2)`"),
    };
    refuse(expected_diagnostic(input, "`left`, `right` or `at(…)`", Some(remedy)))
}
