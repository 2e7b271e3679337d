//! Texts: what is read is printed and read back the same, what is refused is told with its place and a remedy.

use num_rational::BigRational;
use num_traits::Signed as _;
use std::collections::BTreeMap;
use wavestep::Problem;
use wavestep::ball::in_decimals;
use wavestep::export::{self, Formula, LATEX_WIDTH, TEXT_WIDTH};
use wavestep::language::{
    Diagnostic, Source, Span, closest, normalise_name, parse_expression, parse_listing,
    parse_recurrence, parse_scene, read_expression, read_listing, read_quantity, read_recurrence,
    read_scene,
};
use wavestep::limits::{MAX_LOCK_BYTES, MAX_NUMBER_DIGITS};
use wavestep::lock::Lock;
use wavestep::problem::{Given, ProblemError, number};
use wavestep::scene::Dimension;
use wavestep::signal::Value;
use wavestep_polynomial::Symbol;
use wavestep_trials::print;

/// What errors call the texts.
const NAME: &str = "fuzz.wave";

/// A refusal has its place in the text, a message and a remedy.
fn assert_told(source: Option<&Source>, errors: &[Diagnostic]) {
    assert!(!errors.is_empty(), "refused without a reason");
    for error in errors {
        if let Some(source) = source {
            assert_eq!(error.source(), source, "{error}");
        }
        let is_inside = |Span { start, end }| error.source().text().get(start..end).is_some();
        assert!(is_inside(error.span()), "{error}");
        assert!(error.secondary().iter().all(|label| is_inside(label.span)), "{error}");
        assert!(!error.message().is_empty() && !error.to_string().contains('\0'));
        assert!(error.remedy().is_some_and(|remedy| !remedy.is_empty()), "no remedy: {error}");
    }
}

/// The text, where it is one.
fn source(data: &[u8]) -> Option<Source> {
    Source::new(NAME, data).map_err(|error| assert_told(None, &[error])).ok()
}

/// A text that was printed.
fn printed(text: &str) -> Source {
    Source::new(NAME, text).unwrap_or_else(|error| panic!("{error}"))
}

pub fn scenes(data: &[u8]) {
    let Some(source) = source(data) else { return };
    let parsed = parse_scene(&source);
    let read = read_scene(&source, &BTreeMap::new());
    match &parsed {
        Err(error) => assert_told(Some(&source), std::slice::from_ref(error)),
        Ok(tree) => {
            let again = printed(&print::scene(tree));
            let same = parse_scene(&again).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!((&same.title, &same.statements), (&tree.title, &tree.statements));
            assert_eq!(print::scene(&same), again.text());
            let meant = read_scene(&again, &BTreeMap::new());
            assert_eq!(meant.as_ref().ok(), read.as_ref().ok(), "{}", again.text());
        }
    }
    match read {
        Err(errors) => assert_told(Some(&source), &errors),
        Ok(_) => assert!(parsed.is_ok(), "it has a meaning and no grammar"),
    }
    if let Err(error) = Problem::read(NAME, source.text()) {
        match error.diagnostics() {
            [] => assert!(error.remedy().is_some(), "no remedy: {error}"),
            errors => assert_told(None, errors),
        }
    }
}

pub fn recurrences(data: &[u8]) {
    let Some(source) = source(data) else { return };
    let read = read_recurrence(&source, &BTreeMap::new());
    match parse_recurrence(&source) {
        Err(error) => {
            assert_told(Some(&source), &[error]);
            assert!(read.is_err());
        }
        Ok(tree) => {
            let again = printed(&print::recurrence(&tree));
            let same = parse_recurrence(&again).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!((&same.title, &same.statements), (&tree.title, &tree.statements));
            assert_eq!(print::recurrence(&same), again.text());
            let meant = read_recurrence(&again, &BTreeMap::new());
            assert_eq!(meant.as_ref().ok(), read.as_ref().ok(), "{}", again.text());
        }
    }
    if let Err(error) = read {
        assert_told(Some(&source), &[error]);
    }
    match parse_listing(&source) {
        Err(error) => assert_told(Some(&source), &[error]),
        Ok(listing) => {
            let again = printed(&print::listing(&listing));
            let same = parse_listing(&again).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(same.formulas, listing.formulas);
        }
    }
}

/// Whether an expression may have so many terms that it only takes long: high powers of sums.
fn is_long(text: &str) -> bool {
    let digits = |part: &str| part.chars().take_while(char::is_ascii_digit).count() > 2;
    let powers: Vec<&str> = text.split('^').skip(1).collect();
    text.len() > 400
        || powers.iter().any(|power| digits(power.trim_start_matches([' ', '(', '+', '-'])))
        || powers.len() > 6
}

pub fn expressions(data: &[u8]) {
    let Some(source) = source(data).filter(|source| !is_long(source.text())) else { return };
    let read = read_expression(&source);
    match parse_expression(&source) {
        Err(error) => {
            assert_told(Some(&source), &[error]);
            assert!(read.is_err());
        }
        Ok(tree) => {
            let again = printed(&tree.to_string());
            let same = parse_expression(&again).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(same, tree, "{}", again.text());
            assert_eq!(same.to_string(), again.text());
            let meant = read_expression(&again);
            assert_eq!(meant.as_ref().ok(), read.as_ref().ok(), "{}", again.text());
        }
    }
    let exact = match read {
        Ok(exact) => exact,
        Err(error) => return assert_told(Some(&source), &[error]),
    };
    let formula = Formula::piece("f", 0, &exact, &Symbol::new("s").expect("a name"));
    for text in [formula.to_line(), formula.to_text(TEXT_WIDTH), formula.to_text(20)] {
        let mut numbers = text.split(|own: char| !own.is_ascii_digit());
        if numbers.any(|own| own.len() > MAX_NUMBER_DIGITS) {
            continue;
        }
        let listing = read_listing(&printed(&text)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(listing[0].expression, exact, "{text}");
    }
    let latex = export::latex(std::slice::from_ref(&formula), LATEX_WIDTH);
    for (open, close) in [("{", "}"), ("\\bigl", "\\bigr"), ("\\begin", "\\end")] {
        assert_eq!(latex.matches(open).count(), latex.matches(close).count(), "{latex}");
    }
    let mathml = formula.to_mathml(LATEX_WIDTH);
    let [opened, closed] = ["<m", "</m"].map(|tag| mathml.matches(tag).count());
    assert_eq!(opened, closed + mathml.matches("/>").count(), "{mathml}");
}

pub fn locks(data: &[u8]) {
    let source = match Source::with_limit("fuzz.lock", data, MAX_LOCK_BYTES) {
        Ok(source) => source,
        Err(error) => return assert_told(None, &[error]),
    };
    // A lock says how much it holds; most alterations change that, so that it is put right first.
    let lock = match Lock::read(&source) {
        Ok(lock) => lock,
        Err(error) => {
            let told = error.message().split_once("this file holds ");
            let held = told.and_then(|(_, rest)| rest.split_once(", and says "));
            let Some((found, said)) = held else { return assert_told(None, &[error]) };
            let text = source.text().replacen(said, found, 1);
            match Lock::read(&printed(&text)) {
                Ok(lock) => lock,
                Err(error) => return assert_told(None, &[error]),
            }
        }
    };
    let text = lock.to_text();
    let again = Lock::read(&printed(&text)).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(again, lock, "{text}");
    assert_eq!(again.to_text(), text);
    assert!(again.differences(&lock).is_empty());
}

/// Refusals of values are diagnostics, or say in one sentence what is wrong.
fn assert_refused(error: ProblemError) {
    let error = wavestep::Error::from(error);
    assert!(error.is_bad_input() && !error.to_string().is_empty(), "{error}");
    match error.diagnostics() {
        [] => assert!(error.remedy().is_some(), "no remedy: {error}"),
        errors => assert_told(None, errors),
    }
}

/// Longer numbers, and those with such an exponent, are not read.
fn is_short(value: &BigRational) -> bool {
    value.to_string().len() <= MAX_NUMBER_DIGITS
}

/// A number as it is written reads back the same.
fn assert_reads_back(value: &BigRational, text: &str) {
    if is_short(value) {
        let again = number("--at", text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(&again, value, "{text}");
    }
}

/// What a command line may hold: numbers, times with units, names with values.
pub fn values(data: &[u8]) {
    thread_local! {
        static WITH_UNITS: Problem = Problem::builtin("hopkinson").expect("a scene");
    }
    let Ok(text) = str::from_utf8(data) else { return };
    if text.len() > 200 {
        return;
    }
    match number("--at", text) {
        Err(error) => assert_refused(error),
        Ok(value) => {
            assert_reads_back(&value, &value.to_string());
            assert_reads_back(&value, &in_decimals(&value));
            // The standard library reads decimals, too, and rounds them correctly.
            let double = Value::Exact(value.clone()).to_f64();
            if let Ok(same) = text.trim().parse::<f64>() {
                assert_eq!(double.abs(), same.abs(), "{text}");
            }
            let given = Given::from(double).number("--at");
            let again = given.map(|exact| Value::Exact(exact).to_f64().to_bits());
            assert_eq!(again.ok(), double.is_finite().then_some((double + 0.0).to_bits()));
        }
    }
    WITH_UNITS.with(|problem| match problem.time("--at", text) {
        Err(error) => assert_refused(error),
        Ok(time) => {
            assert!(!time.is_negative());
            let told = problem.told_time(&time);
            if is_short(&time) {
                assert_eq!(problem.time("--at", told.as_str()).expect("a time"), time, "{told}");
            }
        }
    });
    if let Ok(source) = Source::new("--at", text) {
        for dimension in [Dimension::LENGTH, Dimension::FORCE, Dimension::STIFFNESS] {
            match read_quantity(&source, dimension) {
                Err(error) => assert_told(Some(&source), &[error]),
                Ok(value) if is_short(&value) => {
                    let told = printed(&format!("{value} {}", dimension.unit()));
                    let again = read_quantity(&told, dimension);
                    assert_eq!(again.ok(), Some(value), "{}", told.text());
                }
                Ok(_) => {}
            }
        }
    }
    let name = normalise_name(text);
    assert_eq!(normalise_name(&name), name);
    let _ = closest(text, ["velocity", "force", "strain"]);
}
