//! What the parser says about texts it refuses.

use super::super::diagnostic::{Diagnostic, closest, did_you_mean};
use super::super::number::LiteralError;
use super::super::source::Source;
use super::super::syntax::{Expression, Name, Node, Span};
use super::forms::{FOLLOWING, SYMBOL};
use super::input::{Context, Extent, Input};
use crate::limits::{MAX_DECIMAL_EXPONENT, MAX_INDEX, MAX_NESTING, MAX_NUMBER_DIGITS};
use crate::scene::{End, Measure};

/// The message, the remark at the place, and the remedy, where nothing in them depends on the text.
type Plain = [&'static str; 3];

/// `**`
pub(super) const DOUBLE_STAR: Plain =
    ["`**` is not an operator", "a power?", "write powers with `^`: `x^2`"];

/// `1.2.3`
pub(super) const TWO_POINTS: Plain =
    ["a number with two decimal points", "second point", "write one point: `0.25`"];

/// `1_000`
pub(super) const GROUPED_DIGITS: Plain =
    ["`_` inside a number", "not a digit", "write digits without separators: `1000`, `1e3`"];

/// `2 m + 3 mm`
pub(super) const SUM_OF_UNITS: Plain = [
    "a value has one unit, at its end",
    "not expected here",
    "work the value out in one unit: `2 + 3/1000 m`",
];

/// `line free - fixed`
pub(super) const EMPTY_LINE: Plain = [
    "the line has no element",
    "the right end",
    "name elements between the ends: `line free - rod - fixed`",
];

/// `one |1/2 two`
pub(super) const OPEN_GAP: Plain =
    ["this gap has no end", "a gap begins", "write `|` behind its width, too: `|0.2 mm|`"];

/// `force(a)*velocity(a)`
pub(super) const TWO_MEASURES: Plain = [
    "a product of measures cannot be observed",
    "times this",
    "observe each in its own statement, or add them",
];

/// `1/force(a)`
pub(super) const DIVIDED_BY_MEASURE: Plain = [
    "a measure cannot be a divisor",
    "divided by here",
    "observe a sum of measures, each with a factor: `2*force(rod.left)`",
];

/// `force(a)^2`
const POWER_OF_MEASURE: Plain =
    ["a power of a measure cannot be observed", "a power", DIVIDED_BY_MEASURE[2]];

/// `observe x = 3`
pub(super) const NOTHING_MEASURED: Plain = [
    "this measures nothing",
    "no measure in here",
    "each term needs a measure at a place, such as `velocity(ram)` or `2*force(rod.left)`",
];

/// `(force(a) - force(b))/2`
pub(super) const GROUPED_MEASURES: Plain = [
    "measures cannot be in parentheses",
    "encloses a measure",
    "multiply out: `force(a.left)/2 - force(b.left)/2`",
];

/// What is needed where something else stands, and the remedy.
type Lack = [&'static str; 2];

/// `sum(a[i])`
pub(super) const RANGE: Lack =
    ["`,` and the range of the sum", "a sum needs its range: `sum(f[i], i < n)`"];

/// `f[2*n]`, `f[]`
pub(super) const INDEX: Lack = ["a wave index", INDEX_REMEDY];

/// A property directly after another.
pub(super) const COMMA: Lack = ["`,` or a unit", COMMAS];

/// `N/2`
pub(super) const UNIT: Lack =
    ["the name of a unit", "numbers come before the unit: `3/2 m`, `7850 kg/m^3`"];

/// Something is needed, and the remedy is always the same, unless the text suggests a better one.
pub(super) fn lacking(input: Input<'_>, [what, remedy]: Lack) -> Diagnostic {
    expected_with(input, what, remedy.to_owned())
}

/// A mistake whose texts are always the same.
pub(super) fn plain(input: Input<'_>, span: Span, [message, label, remedy]: Plain) -> Diagnostic {
    at(input, message, span, label).with_remedy(remedy)
}

fn at(
    input: Input<'_>,
    message: impl Into<String>,
    span: Span,
    label: impl Into<String>,
) -> Diagnostic {
    Diagnostic::new(input.context.source, message, span, label)
}

/// A list of words in quotation marks.
fn choice<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    words.into_iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ")
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
    let mut start = input.after_blanks();
    let Context { unit, forms, .. } = input.context;
    let Some(next) = start.text.chars().next() else {
        let description = format!("the end of the {unit}");
        return Found { description, span: input.here(), kind: FoundKind::End };
    };
    if let Some(word) = start.next_word() {
        let opens_line = input.text[..start.offset - input.offset].contains('\n');
        let is_keyword = forms.iter().any(|(keyword, _)| *keyword == word.value);
        let kind = if opens_line && is_keyword { FoundKind::Keyword } else { FoundKind::Word };
        return Found { description: quoted(word.value), span: word.span, kind };
    }
    let offset = start.offset;
    if let Some(number) = start.digits() {
        let description = quoted(number.value);
        return Found { description, span: number.span, kind: FoundKind::Number };
    }
    let (description, length) = match PAIRS.iter().find(|pair| start.text.starts_with(**pair)) {
        Some(pair) => (format!("`{pair}`"), pair.len()),
        None => (character(next), next.len_utf8()),
    };
    let kind = FoundKind::Character(next);
    Found { description, span: Span::new(offset, offset + length), kind }
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
    let code = u32::from(character);
    match character {
        _ if character.is_ascii() => format!("`{character}`"),
        '\u{AD}' | '\u{200B}'..='\u{200F}' | '\u{2060}'..='\u{206F}' | '\u{FEFF}' => {
            format!("U+{code:04X}, which is invisible")
        }
        _ if character.is_whitespace() => format!("U+{code:04X}, which is invisible"),
        _ => format!("`{character}` (U+{code:04X})"),
    }
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
        '!' => "there is no factorial; `!` is only used in `!=`",
        '%' => "there is no percent sign; write `0.05` for 5 %",
        ';' => "end a statement by ending the line; separate names by `,`",
        '"' => "only the title is quoted",
        '|' => "there is no absolute value",
        '\\' => "this is not LaTeX: write `mu`, `exp(…)`, `a/b`",
        _ => return None,
    })
}

fn form_remedy(input: Input<'_>) -> Option<String> {
    input.context.form.map(|form| format!("write it like `{form}`"))
}

/// Something else is needed than what stands here.
pub(super) fn expected(input: Input<'_>, what: &str) -> Diagnostic {
    stray(input).unwrap_or_else(|| expected_with(input, what, form_remedy(input)))
}

/// A name is needed.
pub(super) fn expected_name(input: Input<'_>, what: &str) -> Diagnostic {
    let mut remedy = form_remedy(input);
    if let (FoundKind::Number, Some(form)) = (found(input).kind, &remedy) {
        remedy = Some(format!("a name begins with a letter; {form}"));
    }
    expected_with(input, what, remedy)
}

/// Something follows what is already complete.
pub(super) fn expected_end(input: Input<'_>) -> Diagnostic {
    if let Some(diagnostic) = stray(input) {
        return diagnostic;
    }
    let Context { unit, form, .. } = input.context;
    let is_equals = input.next_is("=");
    let one_equals = !input.context.is_scene() && form.is_none_or(|form| form.contains('='));
    if is_equals && one_equals {
        let remedy = match form {
            Some(_) => "write `a = b = c` as two equations".to_owned(),
            None => format!("write only the {unit} itself, without `=`"),
        };
        return at(input, "one `=` too many", found(input).span, "not expected here")
            .with_remedy(remedy);
    }
    let mut after = input.after_blanks().text.chars();
    let decimal_comma = before(input).is_some_and(|last| last.is_ascii_digit())
        && after.next() == Some(',')
        && after.next().is_some_and(|digit| digit.is_ascii_digit());
    let remedy = if is_equals && form == Some(SYMBOL) {
        Some("a symbol stands for every value that meets its condition, such as `mu > 0`".into())
    } else if decimal_comma {
        Some("decimals are written with a point: `0.5`".into())
    } else {
        form_remedy(input)
    };
    expected_with(input, &format!("the end of the {unit}"), remedy)
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
            at(input, "only a wave has an index", span, "this index has no name before it")
                .with_remedy("write the index after each wave: `f[n] + g[n]`"),
        ),
        '\'' | '′' | '’' | '″' => Some(misplaced_prime(input, span, "f")),
        _ => None,
    }
}

/// Something is needed that does not stand here. The remedy is the one given, unless the text suggests a
/// better one.
fn expected_with(input: Input<'_>, what: &str, remedy: impl Into<Option<String>>) -> Diagnostic {
    let Found { description, span, kind } = found(input);
    let better = match kind {
        FoundKind::Keyword => Some(
            "this line is indented deeper than the first statement, so it continues the line \
             before; remove the indentation to start a statement",
        ),
        FoundKind::Character(':') => input.next_is(":=").then_some("write `=`, not `:=`"),
        FoundKind::Character(found) if !is_sign_of_scenes(input, found) => {
            replacement(found).or_else(|| is_foreign(input, found).then_some(ALPHABET))
        }
        _ => None,
    };
    let message = match kind {
        FoundKind::Character(found) if is_foreign(input, found) => {
            format!("unexpected character {description}")
        }
        _ => format!("expected {what}, found {description}"),
    };
    let diagnostic = at(input, message, span, format!("expected {what}"));
    match better.map(str::to_owned).or(remedy.into()) {
        Some(remedy) => diagnostic.with_remedy(remedy),
        None => diagnostic,
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
pub(super) fn expected_expression(input: Input<'_>) -> Diagnostic {
    let start = input.after_blanks();
    let previous = before(input).filter(|_| input.offset > 0);
    if start.text.starts_with('=') && previous == Some('=') {
        let span = Span::new(input.offset - 1, start.offset + 1);
        return at(input, "`==` is not an operator", span, "an equation?")
            .with_remedy("write one `=`");
    }
    let remedy = match previous {
        Some(operator @ ('+' | '-' | '*' | '/' | '^')) => {
            Some(format!("write an operand after `{operator}`, or delete the `{operator}`"))
        }
        _ if start.text.starts_with('{') => replacement('{').map(str::to_owned),
        Some('(') => Some("write an expression between the parentheses".to_owned()),
        _ => form_remedy(input),
    };
    expected_with(input, "a number, a name or `(`", remedy)
}

/// A text without anything in it, where one expression was expected.
pub(super) fn nothing(source: &Source, unit: &str) -> Diagnostic {
    Diagnostic::new(source, format!("no {unit} is given"), Span::new(0, 0), "nothing here")
        .with_remedy(example(unit))
}

/// What a text that is one thing looks like.
pub(super) fn example(unit: &str) -> &'static str {
    match unit {
        "number" => NUMBERS,
        "quantity" => "write a number and its unit, such as `120 us` or `3/2 kN`",
        _ => "write an expression such as `2*mu`",
    }
}

/// What numbers look like.
const NUMBERS: &str = "write a plain number such as `3`, `0.25`, `33/10` or `1e-3`";

/// A parenthesis or bracket is not closed before something else comes.
pub(super) fn unclosed(input: Input<'_>, opener: Span, closing: &str) -> Diagnostic {
    let opening = input.context.source.slice(opener);
    let next = found(input);
    let missing = format!("add the missing `{closing}`");
    if matches!(next.kind, FoundKind::End | FoundKind::Keyword) {
        let stop = next.description;
        return at(input, format!("`{opening}` is never closed"), opener, "opened here")
            .with_secondary(input.here(), format!("`{closing}` expected before {stop}"))
            .with_remedy(missing);
    }
    let remedy = match next.kind == FoundKind::Word && input.context.extent == Extent::Unit {
        true => "a unit follows the whole value, and products need `*`".into(),
        false => missing,
    };
    expected_with(input, &format!("an operator or `{closing}`"), remedy)
        .with_secondary(opener, "opened here")
}

/// Two factors stand side by side.
pub(super) fn missing_operator(left: &Expression, input: Input<'_>) -> Diagnostic {
    const SHOWN: usize = 20;
    let next = found(input);
    let Context { source, unit, form, extent, .. } = input.context;
    if next.kind == FoundKind::Keyword {
        return expected(input, "an operator or the end of the statement");
    }
    let (before, after) = (source.slice(left.span), source.slice(next.span));
    let wanted = closest(after, FOLLOWING).filter(|&word| form.is_some_and(|f| f.contains(word)));
    if let Some(word) = wanted {
        let message = format!("expected `{word}`, found {}", next.description);
        return at(input, message, next.span, format!("expected `{word}`"))
            .with_remedy(format!("did you mean `{word}`?"));
    }
    let is_number = next.kind == FoundKind::Number;
    let applied = source.text()[next.span.end..].starts_with('(');
    let remedy = match &left.value {
        Node::Name(_) if is_number && extent == Extent::Unit => format!(
            "a unit follows the value, as in `{after} {before}`; a product is written \
             `{before}*{after}`"
        ),
        Node::Number(_) if is_number => {
            format!("join the digits, or write an operator between `{before}` and `{after}`")
        }
        _ if unit == "number" => format!("{NUMBERS}, without a unit"),
        _ if before.len() > SHOWN || after.len() > SHOWN => "write `*` between them".to_owned(),
        _ if after == "(" => format!("write `{before}*(…)`"),
        _ if applied => format!("write `{before}*{after}(…)`"),
        _ => format!("write `{before}*{after}`"),
    };
    let message = format!("an operator is missing before {}", next.description);
    at(input, message, next.span, "products need `*`")
        .with_secondary(left.span, "the factor before")
        .with_remedy(remedy)
}

/// `f'` or `f'[n]`
pub(super) fn misplaced_prime(input: Input<'_>, span: Span, name: &str) -> Diagnostic {
    at(input, "a prime may only follow the index of a wave", span, "not after an index")
        .with_remedy(format!("write the derivative of a wave as `{name}[n]'`"))
}

/// `exp` or another function where a name is needed.
pub(super) fn reserved(input: Input<'_>, name: &str, span: Span) -> Diagnostic {
    let message = format!("`{name}` is a function, so nothing else can have this name");
    at(input, message, span, "reserved").with_remedy("choose another name")
}

/// `exp` or another function without argument.
pub(super) fn function_alone(input: Input<'_>, name: &str, span: Span) -> Diagnostic {
    let form = match name {
        "cos" => "cos(2*t)",
        "exp" => "exp(-2*t)",
        "sin" => "sin(2*t)",
        "sqrt" => "sqrt(3)",
        _ => "sum(f[i], i < n)",
    };
    let message = format!("`{name}` needs an argument in parentheses");
    at(input, message, span, "`(` expected after this")
        .with_remedy(format!("write it like `{form}`"))
}

/// `sum(a[i], i = 0..n)`
pub(super) fn sum_range(input: Input<'_>, index: &Name) -> Diagnostic {
    let index = &index.value;
    let remedy =
        format!("the range of a sum is written `{index} < n`; it starts at 0 and ends at n-1");
    expected_with(input, "`<`", remedy)
}

const INDEX_REMEDY: &str = "an index is written `n`, `n-1`, `n+1`, or as a whole number";

/// `f[n-1-1]`, `f[n`
pub(super) fn index_end(input: Input<'_>, opener: Span) -> Diagnostic {
    match found(input).kind {
        FoundKind::End => unclosed(input, opener, "]"),
        _ => lacking(input, ["`]`", INDEX_REMEDY]).with_secondary(opener, "the index opens here"),
    }
}

/// `f[n-99999999]`
pub(super) fn index_too_large(input: Input<'_>, span: Span) -> Diagnostic {
    at(input, format!("the index is larger than {MAX_INDEX}"), span, "too large")
        .with_remedy("use a smaller index")
}

/// `f[n](t)`
pub(super) fn index_and_argument(input: Input<'_>, name: &str) -> Diagnostic {
    let message = "a wave has an index or an argument, not both";
    at(input, message, found(input).span, "an argument after an index").with_remedy(format!(
        "write `{name}[n]` for a period, `{name}(t)` for a time; for a product write `*`"
    ))
}

/// A literal beyond the limits.
pub(super) fn literal(input: Input<'_>, span: Span, error: LiteralError) -> Diagnostic {
    let (message, label, remedy) = match error {
        LiteralError::TooManyDigits => (
            format!("a number with more than {MAX_NUMBER_DIGITS} digits"),
            "too long",
            "write fewer digits, or a fraction",
        ),
        LiteralError::ExponentTooLarge => (
            format!("the decimal exponent is beyond ±{MAX_DECIMAL_EXPONENT}"),
            "out of range",
            "choose units that give numbers of moderate size",
        ),
    };
    at(input, message, span, label).with_remedy(remedy)
}

/// Too many levels.
pub(super) fn too_deep(input: Input<'_>, span: Span) -> Diagnostic {
    at(input, format!("nested deeper than {MAX_NESTING} levels"), span, "one level too many")
        .with_remedy("remove unneeded parentheses and signs, or use a symbol for a part")
}

/// A quotation mark without partner.
pub(super) fn unclosed_string(input: Input<'_>, opener: Span, end: Span) -> Diagnostic {
    at(input, "the quotation mark is never closed", opener, "opened here")
        .with_secondary(end, "`\"` expected before the end of the line")
        .with_remedy("a title is on one line and contains no quotation mark")
}

/// The first statement is another than `recurrence`.
pub(super) fn title_missing(input: Input<'_>, span: Span) -> Diagnostic {
    at(input, "the text does not begin with its title", span, "the first statement")
        .with_remedy(format!("put a first line before it: `{}`", input.context.forms[0].1))
}

/// A second `recurrence` or `scene`.
pub(super) fn second_title(input: Input<'_>, span: Span, first: Span) -> Diagnostic {
    let whole = input.context.forms[0].0;
    at(input, "a second title", span, format!("another {whole} begins here"))
        .with_secondary(first, "the first title")
        .with_remedy(format!("a text has one {whole}; put the other in a separate file"))
}

/// A statement that begins with no word at all.
pub(super) fn no_keyword(input: Input<'_>) -> Diagnostic {
    let Found { description, span, kind } = found(input);
    let remedy = match kind {
        FoundKind::Character(found) if !is_foreign(input, found) => {
            "to continue the line before, indent this one deeper than the first statement"
                .to_owned()
        }
        _ => keywords(input),
    };
    let message = format!("a statement cannot begin with {description}");
    at(input, message, span, "expected a statement").with_remedy(remedy)
}

/// Other words for what is declared in a scene.
const OTHER_WORDS: [(&str, &str); 7] = [
    ("rod", "bar"),
    ("beam", "bar"),
    ("pile", "bar"),
    ("ram", "mass"),
    ("dashpot", "spring"),
    ("damper", "spring"),
    ("output", "observe"),
];

/// A statement that begins with an unknown word.
pub(super) fn unknown_keyword(input: Input<'_>, word: &str, span: Span) -> Diagnostic {
    let message = format!("no statement begins with {}", quoted(word));
    let after = input.text[span.end - input.offset..].trim_start();
    let is_equation = after.starts_with(['[', '\'', '(', '=', '+', '-', '*', '/']);
    let word_meant = word.to_ascii_lowercase();
    let words = input.context.forms.iter().map(|(keyword, _)| *keyword);
    let other = OTHER_WORDS.iter().find(|(other, _)| *other == word_meant);
    let remedy = match (did_you_mean(&word_meant, words), other) {
        (_, Some((_, keyword))) if input.context.is_scene() => {
            format!("did you mean `{keyword}`?")
        }
        (Some(likely), _) => likely,
        (None, _) if is_equation && !input.context.is_scene() => {
            format!("an equation begins with `equation`: write `equation {word}…`")
        }
        _ => keywords(input),
    };
    at(input, message, span, "unknown statement").with_remedy(remedy)
}

fn keywords(input: Input<'_>) -> String {
    let words = input.context.forms.iter().map(|(keyword, _)| *keyword);
    format!("statements begin with one of {}", choice(words))
}

/// A text of blanks and comments.
pub(super) fn no_statement(source: &Source, form: &str) -> Diagnostic {
    Diagnostic::new(source, "the text has no statement", Span::new(0, 0), "no statement here")
        .with_remedy(format!("begin with a line like `{form}`"))
}

/// What follows a property is neither another nor the end of them.
pub(super) fn open_brace(input: Input<'_>, opener: Span, what: &str) -> Diagnostic {
    let next = found(input);
    if matches!(next.kind, FoundKind::End | FoundKind::Keyword) {
        return at(input, "`{` is never closed", opener, "opened here")
            .with_secondary(input.here(), format!("`}}` expected before {}", next.description))
            .with_remedy("add the missing `}`; lines between braces are indented");
    }
    let remedy = match next.kind {
        FoundKind::Word => Some(COMMAS.to_owned()),
        _ => form_remedy(input),
    };
    expected_with(input, what, remedy).with_secondary(opener, "the properties open here")
}

const COMMAS: &str = "separate properties by commas, even at line ends";

/// `2 kN*sin(t)`
pub(super) fn unit_first(input: Input<'_>, span: Span) -> Diagnostic {
    at(input, "a unit follows the whole value", span, "stands after a unit")
        .with_remedy("write the unit last, and times in seconds: `2*sin(500*pi*t) kN`")
}

/// A power of a unit that is no small whole number.
pub(super) fn unit_power(from: Input<'_>, to: Input<'_>) -> Diagnostic {
    let start = from.after_blanks().offset;
    let span = Span::new(start, to.offset.max(start));
    let message = "the power of a unit must be a small whole number";
    at(from, message, span, "not a whole number from -9 to 9")
        .with_remedy("write it like `m^3`, `s^-1` or `m³`")
}

const END_TO_END: &str = "a line goes from end to end: `line free - rod - fixed`";

/// A line that does not begin with what is at its left end.
pub(super) fn expected_left_end(input: Input<'_>) -> Diagnostic {
    let word = input.next_word().map_or("", |word| word.value);
    end_of_line_expected(input, "left", word)
}

/// A line that ends with this name, not with what is at its right end.
pub(super) fn expected_right_end(input: Input<'_>, last: &Name) -> Diagnostic {
    end_of_line_expected(input, "right", &last.value)
        .with_secondary(last.span, "the line ends with this")
}

fn end_of_line_expected(input: Input<'_>, side: &str, word: &str) -> Diagnostic {
    let remedy = did_you_mean(word, End::ALL.map(End::word));
    let what = format!("the {side} end: `free`, `fixed` or `endless`");
    expected_with(input, &what, remedy.unwrap_or_else(|| END_TO_END.to_owned()))
}

/// `force(a)^2`
pub(super) fn power_of_measure(input: Input<'_>, measure: Span) -> Diagnostic {
    plain(input, found(input).span, POWER_OF_MEASURE).with_secondary(measure, "of this measure")
}

/// `observe v = velocity`
pub(super) fn measure_alone(input: Input<'_>, word: &str, span: Span) -> Diagnostic {
    at(input, format!("`{word}` needs a place in parentheses"), span, "of what, and where?")
        .with_remedy(format!("write it like `{word}(rod.left)` or `{word}(ram)`"))
}

/// `observe v = rod.left`
pub(super) fn place_alone(input: Input<'_>, word: &str, span: Span) -> Diagnostic {
    at(input, "a place alone is not a quantity", span, "what is measured here?")
        .with_remedy(format!("name the measure: `velocity({word}.left)`"))
}

/// `speed(ram)`
pub(super) fn unknown_measure(input: Input<'_>, word: &str, span: Span) -> Diagnostic {
    let words = Measure::ALL.map(Measure::word);
    at(input, format!("{} cannot be measured", quoted(word)), span, "not a measure")
        .with_closest(word, words)
        .or_remedy(format!("the measures are {}", choice(words)))
}

/// The parenthesis of a place is not closed.
pub(super) fn unclosed_place(input: Input<'_>, opener: Span) -> Diagnostic {
    if found(input).kind == FoundKind::End {
        return unclosed(input, opener, ")");
    }
    let form =
        "a place is an element or a section of a bar: `ram`, `rod.left`, `rod.at(1/2)`, `line`";
    lacking(input, ["`)`", form]).with_secondary(opener, "opened here")
}

/// `rod.middle`
pub(super) fn expected_section(input: Input<'_>, element: &str) -> Diagnostic {
    let sections = ["left", "right", "at"];
    let likely = input.next_word().and_then(|word| did_you_mean(word.value, sections));
    let remedy = likely.unwrap_or_else(|| {
        format!("write `{element}.left`, `{element}.right` or `{element}.at(1/2)`")
    });
    expected_with(input, "`left`, `right` or `at(…)`", remedy)
}
