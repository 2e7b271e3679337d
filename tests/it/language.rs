//! The language: every text of the corpus, every limit, and random texts and trees.

use crate::snapshot;
use crate::support::corpus::corpus;
use std::collections::BTreeMap;
use wavestep_trials::print;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Pow;
use proptest::prelude::*;
use wavestep::language::syntax::{
    Expression, Factor, Function, Index, Node, Operator, Recurrence, Sign, Spanned, StatementKind,
    Term, Wave,
};
use wavestep::language::{
    self, Diagnostic, Source, Span, closest, normalise_name, parse_expression, parse_listing,
    parse_number, parse_recurrence, read_quantity, read_recurrence,
};
use wavestep::limits::{MAX_CONSTANT_BITS, MAX_NESTING, MAX_NUMBER_DIGITS, MAX_SOURCE_BYTES};
use wavestep::scene::Dimension;

// ---- The corpus -------------------------------------------------------------------------------

fn read(name: &str, bytes: &[u8]) -> Result<Recurrence, Diagnostic> {
    parse_recurrence(&Source::new(&format!("{name}.wave"), bytes)?)
}

fn assert_prints_and_reads_back(recurrence: &Recurrence) {
    let printed = print::recurrence(recurrence);
    let again = read("printed", printed.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again.title, recurrence.title);
    assert_eq!(again.statements, recurrence.statements, "{printed}");
    assert_eq!(print::recurrence(&again), printed);
    assert!(printed.is_ascii() || !recurrence.title.value.is_ascii());
}

#[test]
fn accepted_texts_are_read_and_printed() {
    let corpus = corpus("accepted");
    assert!(corpus.len() >= 11);
    // Texts that follow the grammar and mean nothing are read and printed all the same.
    for (name, bytes) in corpus.into_iter().chain(crate::support::corpus::corpus("accepted-syntax"))
    {
        let recurrence = read(&name, &bytes).unwrap_or_else(|error| panic!("{error}"));
        assert_prints_and_reads_back(&recurrence);
        let file = format!("grammar/accepted/{name}.wave");
        snapshot("language", &format!("accepted-{name}"), &file, &print::recurrence(&recurrence));
    }
}

#[test]
fn rejected_texts_have_remedies() {
    for (name, bytes) in corpus("rejected") {
        let error = read(&name, &bytes).expect_err(&name);
        assert!(error.remedy().is_some(), "{name} has no remedy");
    }
}

/// These follow the grammar; what is wrong with them is found when names are given a meaning.
#[test]
fn texts_without_meaning_have_remedies() {
    for (name, bytes) in corpus("rejected-names") {
        let recurrence = read(&name, &bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_prints_and_reads_back(&recurrence);
        let error = meaning(&name, &bytes, &[]).expect_err(&name);
        assert!(error.remedy().is_some(), "{name} has no remedy");
    }
}

#[test]
fn accepted_texts_have_a_meaning() {
    for (name, bytes) in corpus("accepted") {
        if let Err(error) = meaning(&name, &bytes, &[]) {
            panic!("{name}: {error}");
        }
    }
}

/// The recurrence that a text states, with values for symbols.
fn meaning(
    name: &str,
    bytes: &[u8],
    values: &[(&str, &str)],
) -> Result<wavestep::recurrence::Recurrence, Diagnostic> {
    let value = |&(name, value): &(&str, &str)| (name.to_owned(), parse_number(value).unwrap());
    let values = values.iter().map(value).collect();
    read_recurrence(&Source::new(&format!("{name}.wave"), bytes)?, &values)
}

const SYMBOLS: &str = "\
recurrence \"Symbols with conditions\"
symbol a > 0, b < 1/2, c >= 1, d <= 2, e != 3, g
nonzero a - b
period 1, local s, time t
wave f
equation f[n] = f[n-1]/(a - b)
";

#[test]
fn values_are_put_in_place_of_symbols() {
    for values in [
        &[][..],
        &[("a", "1/3"), ("b", "0")],
        &[("c", "1"), ("d", "2"), ("e", "-3"), ("g", "1e300")],
        // The statement says nothing about numbers that differ.
        &[("a", "1"), ("b", "-1"), ("c", "1"), ("d", "1"), ("e", "1"), ("g", "1")],
    ] {
        let recurrence = meaning("symbols", SYMBOLS.as_bytes(), values).unwrap();
        assert_eq!(recurrence.symbols().count(), 6 - values.len());
    }
    // Where nothing is divided by it, a difference that is stated to be non-zero may vanish.
    let text = SYMBOLS.replace("/(a - b)", "");
    meaning("symbols", text.as_bytes(), &[("a", "1/4"), ("b", "1/4")]).unwrap();
}

#[test]
fn long_sums_are_worked_out_quickly() {
    let terms = |count: u32| (0..count).map(|i| format!("a^{}*b^{}", i % 150, i / 150));
    let text = format!(
        "recurrence \"Long\"\nsymbol a, b\nperiod 1, local s, time t\nwave f\nequation f[n] = {}\n",
        terms(5000).collect::<Vec<_>>().join(" + ")
    );
    meaning("long", text.as_bytes(), &[]).unwrap();
    let waves = vec!["f[n-1]"; 5000].join(" - ");
    let text = format!(
        "recurrence \"Long\"\nperiod 1, local s, time t\nwave f\nequation f[n] = {waves}\n"
    );
    meaning("long", text.as_bytes(), &[]).unwrap();
}

// ---- What is read -----------------------------------------------------------------------------

fn source(text: &str) -> Source {
    Source::new("text", text).unwrap()
}

fn expression(text: &str) -> Expression {
    parse_expression(&source(text)).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn precedence() {
    for (text, meaning) in [
        ("-x^2", "-(x^2)"),
        ("2^3^2", "2^(3^2)"),
        ("x^-2^2", "x^(-(2^2))"),
        ("a - b - c", "a - b - c"),
        ("-a*b", "(-a)*b"),
        ("+a", "a"),
        ("((a))", "a"),
        ("2·x − 1", "2*x - 1"),
    ] {
        assert_eq!(expression(text), expression(meaning), "{text}");
    }
    for (one, other) in [("(a + b) + c", "a + b + c"), ("a/(b*c)", "a/b*c"), ("(-x)^2", "-x^2")] {
        assert_ne!(expression(one), expression(other), "{one}");
    }
}

#[test]
fn spans_cover_what_was_read() {
    let text = "1 + μ*(f[n-1]' - exp( 2 )) ";
    let source = source(text);
    let Node::Sum(terms) = expression(text).value else { panic!("a sum") };
    assert_eq!(source.slice(terms[1].value.span), "μ*(f[n-1]' - exp( 2 ))");
    let Node::Product(factors) = &terms[1].value.value else { panic!("a product") };
    assert_eq!(source.slice(factors[1].value.span), "(f[n-1]' - exp( 2 ))");
    let Node::Sum(inner) = &factors[1].value.value else { panic!("a sum") };
    assert_eq!(source.slice(inner[0].value.span), "f[n-1]'");
    assert_eq!(source.slice(inner[1].value.span), "exp( 2 )");
    let Node::Wave(wave) = &inner[0].value.value else { panic!("a wave") };
    assert_eq!(source.slice(wave.index.span), "n-1");
}

#[test]
fn spans_of_statements_leave_out_comments() {
    let text =
        "\u{FEFF}recurrence \"A\"\r\nequation f[n] = # first\r\n  1 # last\r\n\r\nwave f\r\n";
    let recurrence = parse_recurrence(&source(text)).unwrap();
    let slices: Vec<&str> = recurrence
        .statements
        .iter()
        .map(|statement| recurrence.source.slice(statement.span))
        .collect();
    assert_eq!(slices, ["equation f[n] = # first\r\n  1", "wave f"]);
}

#[test]
fn names_in_greek_and_english_are_one() {
    let recurrence = read("greek", "recurrence \"A\"\nsymbol μ, mu, µ".as_bytes()).unwrap();
    let StatementKind::Symbols(symbols) = &recurrence.statements[0].value else {
        panic!("symbols")
    };
    assert!(symbols.iter().all(|symbol| symbol.name.value == "mu"));
}

#[test]
fn listings_are_read_and_printed() {
    let text = "\
f[3](s) = exp(-s)*(-4/3*s^3 + 2*s
    - 1)   # three periods
g[0](s) = 0
phi_f[2, 1](s) = s
";
    let listing = parse_listing(&source(text)).unwrap_or_else(|error| panic!("{error}"));
    let printed = print::listing(&listing);
    assert_eq!(
        printed,
        "f[3](s) = exp(-s)*(-4/3*s^3 + 2*s - 1)\ng[0](s) = 0\nphi_f[2, 1](s) = s\n"
    );
    assert_eq!(parse_listing(&source(&printed)).unwrap().formulas, listing.formulas);
}

#[test]
fn numbers_are_exact() {
    for (text, numerator, denominator) in [
        ("33/10", 33, 10),
        ("12.34", 617, 50),
        ("1e3", 1000, 1),
        ("-0.25", -1, 4),
        ("2*3/4", 3, 2),
        (" (1 - 1/3)^-2 ", 9, 4),
        ("−2^2", -4, 1),
        ("0^0", 1, 1),
        ("(-1)^1000000001", -1, 1),
    ] {
        let value = BigRational::new(BigInt::from(numerator), BigInt::from(denominator));
        let found = parse_number(text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(found, value, "{text}");
    }
}

#[test]
fn wrong_numbers_and_quantities_have_remedies() {
    for text in ["*2", "1/2 m", "(1", "1..2", "1 m m", "1 m^x"] {
        let number = parse_number(text).unwrap_err();
        assert!(number.remedy().is_some(), "{number}");
        let quantity = read_quantity(&source(text), Dimension::TIME).unwrap_err();
        assert!(quantity.remedy().is_some(), "{quantity}");
    }
    let expression = parse_expression(&source("a b")).unwrap_err();
    assert!(expression.remedy().is_some(), "{expression}");
}

#[test]
fn literals_are_exact() {
    for (text, numerator, denominator) in [
        ("3", 3, 1),
        ("0.25", 1, 4),
        (".5", 1, 2),
        ("7.", 7, 1),
        ("2.5e-3", 1, 400),
        ("2.5E−3", 1, 400),
        ("0.1", 1, 10),
        ("1.50e+1", 15, 1),
        ("0.000", 0, 1),
        (".0", 0, 1),
        (".000e-7", 0, 1),
        ("0.", 0, 1),
        ("125e-4", 1, 80),
    ] {
        let value = BigRational::new(BigInt::from(numerator), BigInt::from(denominator));
        assert_eq!(expression(text).value, Node::Number(value), "{text}");
    }
    for accepted in ["1e1000", "1e-1000", "1.0e-1000", "1e+0001000"] {
        expression(accepted);
    }
    for refused in ["1e1001", "1e-1001", "1.5e-1000", "1e99999999999999999999999"] {
        assert_refused(refused, "exponent");
    }
}

#[test]
fn quantities_are_exact_in_si_units() {
    let read = |text: &str, dimension| read_quantity(&source(text), dimension);
    for (text, dimension, value) in [
        ("120 us", Dimension::TIME, "120e-6"),
        ("1/3 s", Dimension::TIME, "1/3"),
        ("0", Dimension::TIME, "0"),
        ("1 kg", Dimension::MASS, "1"),
        ("1 mm", Dimension::LENGTH, "1e-3"),
        ("1 min", Dimension::TIME, "60"),
        ("1 GPa", Dimension::PRESSURE, "1e9"),
        ("1 in", Dimension::LENGTH, "0.0254"),
        ("1 lbf", Dimension::FORCE, "44482216152605/10000000000000"),
    ] {
        assert_eq!(read(text, dimension).unwrap(), parse_number(value).unwrap(), "{text}");
    }
    for name in ["cs", "kmin", "kk", "M", "pa", "dN"] {
        let error = read(&format!("1 {name}"), Dimension::TIME).unwrap_err();
        assert_eq!(error.message(), format!("unknown unit `{name}`"));
    }
    assert!(read("3 mm", Dimension::TIME).unwrap_err().message().contains("a length"));
    assert_eq!(
        read("1/3", Dimension::TIME).unwrap_err().message(),
        "a time needs a unit in this scene"
    );
    assert_eq!(Dimension::STIFFNESS.unit(), "N/m");
    assert_eq!(Dimension::NONE.unit(), "");
    assert_eq!(Dimension::PRESSURE.units(), "Pa = N/m^2");
    assert_eq!(Dimension::new(4, 1, 0).described(), "a quantity in kg*m^4");
}

#[test]
fn greek_letters_are_spelt_out() {
    for (written, name) in [
        ("μ", "mu"),
        ("\u{B5}", "mu"),
        ("α", "alpha"),
        ("ω_0", "omega_0"),
        ("Ω", "Omega"),
        ("ς", "sigma"),
        ("Σ", "Sigma"),
        ("Ρ2", "Rho2"),
        ("Δt", "Deltat"),
    ] {
        assert_eq!(normalise_name(written), name);
        assert_eq!(expression(written).value, Node::Name(name.to_owned()));
    }
    for other in "é ж ά ª ² ₁ _ \u{3A2}".split(' ') {
        assert!(parse_expression(&source(other)).is_err(), "{other}");
    }
}

/// A statement goes on in lines that are indented deeper than the first statement.
#[test]
fn deeper_lines_continue() {
    for (text, expected) in [
        (
            "recurrence \"A\"\nwave a,\n  b,\n\n# c\n\td # e\nwave f\n",
            ["wave a,\n  b,\n\n# c\n\td", "wave f"],
        ),
        (
            "# title\r\n    recurrence \"A\"\r\n    wave b,\r\n      c\r\n  wave d",
            ["wave b,\r\n      c", "wave d"],
        ),
    ] {
        let recurrence = parse_recurrence(&source(text)).unwrap();
        let slice = |statement: &Spanned<_>| recurrence.source.slice(statement.span).to_owned();
        let slices: Vec<String> = recurrence.statements.iter().map(slice).collect();
        assert_eq!(slices, expected);
    }
    let error = parse_recurrence(&source("\n  \t\n   # a\n#b")).unwrap_err();
    assert_eq!(error.message(), "the text has no statement");
}

/// The first word of a text says what it states.
#[test]
fn texts_are_told_apart() {
    for (text, remedy) in [
        ("", "`recurrence \"Title\"`"),
        ("recurrence \"A\"", "`wave f, g`"),
        ("  # scene\n  scene \"A\"", "`line free - rod - fixed`"),
        ("Scene \"A\"", "did you mean `scene`?"),
        ("scen", "did you mean `scene`?"),
        ("bar rod {}", "`scene \"Title\"`"),
        ("wave f", "`recurrence \"Title\"`"),
        ("reccurence \"A\"", "did you mean `recurrence`?"),
        ("f[n] = 1", "`equation f…`"),
        ("§ \"A\"", "`recurrence`, "),
    ] {
        let errors = language::read(&source(text), &BTreeMap::new()).unwrap_err();
        let told = errors[0].remedy().unwrap();
        assert!(told.contains(remedy), "{text}: {told}");
    }
}

// ---- Diagnostics ------------------------------------------------------------------------------

#[test]
fn errors_say_their_place_and_a_remedy() {
    let source = Source::new("a.wave", "wave f\nμ g = 1").unwrap();
    let error = Diagnostic::new(&source, "no", Span::new(10, 11), "here");
    assert_eq!(error.to_string(), "a.wave:2:3: no: here");
    assert_eq!(error.with_remedy("yes").to_string(), "a.wave:2:3: no: here\nhelp: yes");
}

#[test]
fn only_slips_are_close() {
    assert_eq!(closest("waves", ["wave"]), Some("wave"));
    assert_eq!(closest("wvae", ["wave"]), Some("wave"));
    assert_eq!(closest("equasion", ["observe", "equation"]), Some("equation"));
    assert_eq!(closest("Mu", ["r", "mu"]), None);
    assert_eq!(closest("alhpa", ["beta", "alpha"]), Some("alpha"));
    assert_eq!(closest("x", ["y", "z"]), None);
    assert_eq!(closest(&"x".repeat(1000), ["y"]), None);
    // Three edits, since no piece is edited twice: a swap, and an insertion into what was swapped.
    assert_eq!(closest("wxyzca", ["wxyzabc"]), None);
}

#[test]
fn any_span_is_moved_onto_characters() {
    for text in ["σ = ρcV\n", "", "a", "\u{4F60}\u{597D} f"] {
        let source = Source::new("t", text).unwrap();
        for (start, end) in [(0, 0), (1, 2), (3, 1), (5, 999), (usize::MAX, usize::MAX)] {
            let error = Diagnostic::new(&source, "m", Span::new(start, end), "l")
                .with_secondary(Span::new(end, start), "s");
            let marked = error.secondary().iter().map(|label| label.span).chain([error.span()]);
            for Span { start, end } in marked {
                assert!(text.get(start..end).is_some());
            }
            assert!(error.to_string().ends_with("m: l"));
        }
    }
}

// ---- Limits -----------------------------------------------------------------------------------

/// Refused with this message, quickly: what is slow here would take minutes if it were quadratic.
fn assert_refused(text: &str, message: &str) {
    let error = Source::new("text", text).and_then(|source| parse_expression(&source)).unwrap_err();
    assert!(error.message().contains(message), "{}", error.message());
    assert!(error.remedy().is_some());
    assert!(error.to_string().len() < 2000);
}

#[test]
fn deep_nesting_is_refused() {
    let many = 100_000;
    for text in [
        "(".repeat(many),
        format!("{}1{}", "(".repeat(many), ")".repeat(many)),
        format!("{}1", "-".repeat(many)),
        format!("{}1", "+".repeat(many)),
        format!("{}1", "2^".repeat(many)),
        format!("{}1", "2^-".repeat(many)),
        "exp(".repeat(many),
        "f(".repeat(many),
        "sum(".repeat(many),
        "-(".repeat(many),
        "1+(2*(".repeat(many),
        "a-(b)^(".repeat(many),
    ] {
        assert_refused(&text, "nested deeper");
    }
}

#[test]
fn the_limit_of_nesting_is_sharp_and_leaves_stack() {
    let depth = usize::from(MAX_NESTING);
    // A thread of 1 MiB: half of what threads usually have, an eighth of what programs have.
    let deepest = move || {
        for (open, close) in
            [("(", ")"), ("-", ""), ("2^", ""), ("exp(", ")"), ("1+2*(", ")"), ("1+2*f(", ")")]
        {
            let text = format!("{}1{}", open.repeat(depth), close.repeat(depth));
            let tree = expression(&text);
            assert_eq!(expression(&tree.to_string()), tree);
            if !open.contains(['e', 'f', '^']) {
                assert!(parse_number(&text).is_ok());
            }
            let deeper = format!("{open}{text}{close}");
            assert_refused(&deeper, "nested deeper");
        }
    };
    let thread = std::thread::Builder::new().stack_size(1 << 20).spawn(deepest);
    thread.unwrap().join().unwrap();
}

#[test]
fn long_sums_and_products_are_flat() {
    let sum = expression(&vec!["1"; 100_000].join("+"));
    assert!(matches!(&sum.value, Node::Sum(terms) if terms.len() == 100_000));
    let product = expression(&vec!["f[n]"; 100_000].join("*"));
    assert!(matches!(&product.value, Node::Product(factors) if factors.len() == 100_000));
    let primes = expression(&format!("f[n]{}", "'".repeat(100_000)));
    assert!(matches!(&primes.value, Node::Wave(wave) if wave.primes == 100_000));
    assert_eq!(parse_number(&vec!["1"; 100_000].join("+")).unwrap(), BigInt::from(100_000).into());
}

#[test]
fn long_texts_take_linear_time() {
    let line = "equation f[n] = g[n-1] + 0.125*(mu - 1) # comment\n";
    let text = format!("recurrence \"Long\"\n{}", line.repeat(MAX_SOURCE_BYTES / line.len() - 1));
    let recurrence = read("long", text.as_bytes()).unwrap();
    assert!(recurrence.statements.len() > 20_000);
    for text in ["#\n", "\n", " ", "a,", "a\n", "1e-1000+", "f[n]'+"] {
        let text = format!(
            "recurrence \"Long\"\nwave {}",
            text.repeat(MAX_SOURCE_BYTES / text.len() - 20)
        );
        if let Err(error) = read("long", text.as_bytes()) {
            assert!(error.to_string().len() < 2000);
        }
    }
}

#[test]
fn large_texts_are_refused() {
    assert!(Source::new("text", " ".repeat(MAX_SOURCE_BYTES)).is_ok());
    assert_refused(&" ".repeat(MAX_SOURCE_BYTES + 1), "bytes long");
    assert!(Source::with_limit("text", "12345", 4).is_err());
}

#[test]
fn long_numbers_are_refused() {
    assert_eq!(expression(&"9".repeat(MAX_NUMBER_DIGITS)).to_string().len(), MAX_NUMBER_DIGITS);
    assert_refused(&"9".repeat(MAX_NUMBER_DIGITS + 1), "digits");
    assert_refused(&"9".repeat(1_000_000), "digits");
    assert_refused("1e1001", "exponent");
    assert_refused("1e-1001", "exponent");
    assert_refused(&format!("1e{}", "9".repeat(1_000_000)), "exponent");
}

#[test]
fn long_constants_are_refused() {
    let bits = usize::try_from(MAX_CONSTANT_BITS).unwrap();
    let harmonic: Vec<String> = (1..bits).map(|k| format!("1/{k}")).collect();
    for text in ["2^1000000", "(9^999)^(9^9)", &vec!["1e1000"; 1000].join("*"), &harmonic.join("+")]
    {
        let error = parse_number(text).unwrap_err();
        assert!(error.message().contains("too many digits"), "{error}");
    }
    assert_eq!(parse_number("2^10000").unwrap(), BigInt::from(2).pow(10_000_u32).into());
}

// ---- Random texts and trees ---------------------------------------------------------------------

/// Pieces of which wrong texts are usually made.
const PIECES: [&str; 62] = [
    "recurrence ",
    "\"A\"",
    "symbol ",
    "nonzero ",
    "period ",
    "local ",
    "time ",
    "wave ",
    "equation ",
    "continuous ",
    "starts ",
    "at ",
    "observe ",
    "exp",
    "sum",
    "f",
    "n",
    "μ",
    "Ω_1",
    "[",
    "]",
    "(",
    ")",
    "'",
    "″",
    "+",
    "-",
    "−",
    "*",
    "**",
    "·",
    "/",
    "^",
    "=",
    "==",
    "<",
    "≤",
    "!=",
    "!",
    ",",
    ";",
    ".",
    "1",
    "0.5",
    ".0",
    "00",
    "1e3",
    "1e",
    "1e9999",
    "_",
    " ",
    "\n",
    "\n  ",
    "\t",
    "\r\n",
    "\r",
    "#",
    "# ü\n",
    "²",
    "\u{200B}",
    "\0",
    "\"",
];

fn assert_total(bytes: &[u8]) -> Result<(), TestCaseError> {
    let source = match Source::new("text", bytes) {
        Ok(source) => source,
        Err(error) => {
            prop_assert!(!error.to_string().is_empty());
            return Ok(());
        }
    };
    let errors = [
        parse_recurrence(&source).err(),
        parse_listing(&source).err(),
        parse_expression(&source).err(),
        parse_number(source.text()).err(),
    ];
    for error in errors.into_iter().flatten() {
        let Span { start, end } = error.span();
        prop_assert!(start <= end && source.text().get(start..end).is_some(), "{error}");
        for label in error.secondary() {
            prop_assert!(source.text().get(label.span.start..label.span.end).is_some());
        }
        prop_assert!(!error.message().contains("cannot be read"), "{error}");
    }
    Ok(())
}

fn name() -> BoxedStrategy<Spanned<String>> {
    "[a-zA-Z][a-z0-9_]{0,3}"
        .prop_filter("reserved", |name| {
            !["cos", "exp", "sin", "sqrt", "sum"].contains(&name.as_str())
        })
        .prop_filter("ends an expression", |name| {
            !["starts", "local", "time"].contains(&name.as_str())
        })
        .prop_map(anywhere)
        .boxed()
}

fn anywhere<T>(value: T) -> Spanned<T> {
    Spanned::new(value, Span::new(0, 0))
}

fn number() -> BoxedStrategy<Node> {
    (0_u64.., 0_u32..40, 0_u32..40)
        .prop_map(|(digits, down, up)| {
            let ten = BigInt::from(10);
            let numerator = BigInt::from(digits) * ten.clone().pow(up);
            Node::Number(BigRational::new(numerator, ten.pow(down)))
        })
        .boxed()
}

fn wave() -> BoxedStrategy<Node> {
    (name(), prop::option::of(name()), -9_i64..9, 0_u32..3)
        .prop_map(|(name, base, offset, primes)| {
            let index = anywhere(Index { base, offset });
            Node::Wave(Box::new(Wave { name, index, primes }))
        })
        .boxed()
}

fn tree() -> BoxedStrategy<Expression> {
    let leaf = prop_oneof![number(), name().prop_map(|name| Node::Name(name.value)), wave(),];
    leaf.prop_map(anywhere)
        .prop_recursive(6, 60, 4, |inner| {
            let boxed = || inner.clone().prop_map(Box::new);
            prop_oneof![
                (name(), boxed()).prop_map(|(name, argument)| Node::Call { name, argument }),
                boxed().prop_map(Node::Exponential),
                (0_usize..3, boxed()).prop_map(|(i, argument)| {
                    let function = [Function::Cosine, Function::Sine, Function::SquareRoot][i];
                    Node::Function { function, argument }
                }),
                (boxed(), name(), name()).prop_map(|(term, index, bound)| Node::Summation {
                    term,
                    index,
                    bound
                }),
                boxed().prop_map(Node::Negate),
                (boxed(), boxed()).prop_map(|(base, exponent)| Node::Power { base, exponent }),
                prop::collection::vec((any::<bool>(), inner.clone()), 2..5).prop_map(|parts| {
                    Node::Sum(
                        parts
                            .into_iter()
                            .enumerate()
                            .map(|(position, (plus, value))| Term {
                                sign: if plus || position == 0 { Sign::Plus } else { Sign::Minus },
                                value,
                            })
                            .collect(),
                    )
                }),
                prop::collection::vec((any::<bool>(), inner.clone()), 2..5).prop_map(|parts| {
                    Node::Product(
                        parts
                            .into_iter()
                            .enumerate()
                            .map(|(position, (times, value))| Factor {
                                operator: if times || position == 0 {
                                    Operator::Multiply
                                } else {
                                    Operator::Divide
                                },
                                value,
                            })
                            .collect(),
                    )
                }),
            ]
            .prop_map(anywhere)
        })
        .boxed()
}

/// Digits on at least one side of the point, zeros alone among them.
fn digits_around_a_point() -> BoxedStrategy<(String, String)> {
    let some = || prop_oneof!["[0-9]{1,30}", "0{1,3}"];
    let any = || prop_oneof!["[0-9]{0,30}", "0{0,3}"];
    prop_oneof![(some(), any()), (any(), some())].boxed()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        assert_total(&bytes)?;
    }

    #[test]
    fn random_characters_never_panic(text in "\\PC{0,100}") {
        assert_total(text.as_bytes())?;
    }

    #[test]
    fn random_pieces_never_panic(pieces in prop::collection::vec(prop::sample::select(&PIECES), 0..40)) {
        assert_total(pieces.concat().as_bytes())?;
        assert_total(format!("recurrence \"A\"\n{}", pieces.concat()).as_bytes())?;
        assert_total(format!("recurrence \"A\"\nequation {}", pieces.concat()).as_bytes())?;
    }

    #[test]
    fn damaged_texts_never_panic(
        (_, mut bytes) in prop::sample::select(corpus("accepted")),
        place in any::<prop::sample::Index>(),
        removed in 0_usize..4,
        piece in prop::sample::select(&PIECES),
    ) {
        let start = place.index(bytes.len());
        let end = (start + removed).min(bytes.len());
        bytes.splice(start..end, piece.bytes());
        assert_total(&bytes)?;
    }

    /// Literals are read in lowest terms, and what is written reads back.
    #[test]
    fn random_literals_are_exact(
        (whole, fraction) in digits_around_a_point(), exponent in -900_i64..900,
    ) {
        let tree = expression(&format!("{whole}.{fraction}e{exponent}"));
        let Node::Number(value) = &tree.value else { panic!("a number") };
        let reduced = BigRational::new(value.numer().clone(), value.denom().clone());
        prop_assert_eq!(value.numer(), reduced.numer());
        prop_assert_eq!(value.denom(), reduced.denom());
        let digits = BigInt::parse_bytes(format!("{whole}{fraction}").as_bytes(), 10).unwrap();
        let scale = exponent as i32 - fraction.len() as i32;
        let ten = BigRational::from_integer(BigInt::from(10));
        prop_assert_eq!(value, &(BigRational::from_integer(digits) * ten.pow(scale)));
        prop_assert_eq!(expression(&tree.to_string()), tree);
    }

    #[test]
    fn random_trees_print_and_read_back(tree in tree()) {
        let printed = tree.to_string();
        let again = match parse_expression(&source(&printed)) {
            Ok(again) => again,
            Err(error) => return Err(TestCaseError::fail(error.to_string())),
        };
        prop_assert_eq!(&again, &tree, "{}", printed);
        prop_assert_eq!(again.to_string(), printed);
    }
}
