//! The language of scenes: every text of its corpus, what is read, and random texts and trees.

use crate::snapshot;
use crate::support::corpus::corpus;
use std::collections::BTreeMap;
use wavestep_trials::print;

use num_bigint::BigInt;
use num_rational::BigRational;
use proptest::prelude::*;
use wavestep::expression::Fraction;
use wavestep::language::syntax::Scene as Tree;
use wavestep::language::{
    Diagnostic, Source, Span, Stated, parse_number, parse_scene, read, read_expression, read_scene,
};
use wavestep::scene::{Body, Drive, End, Joint, Kind, Measure, Place, Position, Scene};

// ---- The corpus -------------------------------------------------------------------------------

fn source(name: &str, bytes: impl AsRef<[u8]>) -> Source {
    Source::new(&format!("{name}.wave"), bytes).unwrap()
}

fn meaning(text: &str, values: &[(&str, &str)]) -> Result<Scene, Vec<Diagnostic>> {
    let value = |&(name, value): &(&str, &str)| (name.to_owned(), parse_number(value).unwrap());
    read_scene(&source("text", text), &values.iter().map(value).collect())
}

fn rendered(errors: &[Diagnostic]) -> String {
    let texts: Vec<String> = errors.iter().map(|error| error.to_string()).collect();
    texts.join("\n\n")
}

fn assert_prints_and_reads_back(tree: &Tree) {
    let printed = print::scene(tree);
    let again = parse_scene(&source("printed", &printed)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again.title, tree.title);
    assert_eq!(again.statements, tree.statements, "{printed}");
    assert_eq!(print::scene(&again), printed);
    assert!(printed.is_ascii() || !tree.title.value.is_ascii());
}

#[test]
fn accepted_scenes_are_read_and_printed() {
    let corpus = corpus("accepted-scenes");
    assert!(corpus.len() >= 6);
    for (name, bytes) in corpus {
        let source = source(&name, bytes);
        let tree = parse_scene(&source).unwrap_or_else(|error| panic!("{error}"));
        assert_prints_and_reads_back(&tree);
        match read(&source, &BTreeMap::new()) {
            Ok(stated) => assert!(matches!(stated, Stated::Scene(_))),
            Err(errors) => panic!("{}", rendered(&errors)),
        }
        let file = format!("grammar/accepted-scenes/{name}.wave");
        snapshot("scene-language", &format!("accepted-{name}"), &file, &print::scene(&tree));
    }
}

/// One file an error: neither a second message for the same mistake, nor none.
#[test]
fn rejected_scenes_have_remedies() {
    let corpus = corpus("rejected-scenes");
    assert!(corpus.len() >= 150);
    for (name, bytes) in corpus {
        let source = source(&name, bytes);
        if let Ok(tree) = parse_scene(&source) {
            assert_prints_and_reads_back(&tree);
        }
        let errors = read_scene(&source, &BTreeMap::new()).expect_err(&name);
        for error in &errors {
            assert!(error.remedy().is_some(), "{name} has no remedy");
        }
        let several = name.starts_with("several-");
        assert_eq!(errors.len() > 1, several, "{name}:\n{}", rendered(&errors));
    }
}

// ---- What is read -----------------------------------------------------------------------------

fn value(text: &str) -> Fraction {
    read_expression(&source("value", text)).unwrap().as_fraction().unwrap()
}

const BAR: &str = "\
scene \"Hopkinson bar\"
symbol a > 0
material steel { wave_speed = 5 km/s, density = 8 g/cm^3 }
bar  striker { material = steel, diameter = 20 mm, inner_diameter = 1 cm, length = 2*a mm, velocity = 10 m/s, strain = -1/1000 }
mass plate   { mass = 30 g }
spring pad   { damping = 0.3 kN*s/m }
load pull    { velocity = t*exp(-1000*t) km/s, from = 2 ms }
bar  output  { modulus = 70 GPa, density = 2700 kg/m^3, area = 2 cm² }
line fixed | striker - plate - pad - pull - output - endless
observe s = -2*stress(striker.at(1/2))/3 + stress(output.at(3 mm))
observe E = energy(line)
";

#[test]
fn values_are_exact_in_si_units() {
    let scene = meaning(BAR, &[]).unwrap_or_else(|errors| panic!("{}", rendered(&errors)));
    assert!(scene.dimensional);
    let Kind::Bar(striker) = &scene.elements[0].kind else { panic!("a bar") };
    let Body::Solid { area, modulus, density, length } = &striker.body else { panic!("solid") };
    assert_eq!(*area, value("pi/4*(1/2500 - 1/10000)"));
    assert_eq!((modulus, density), (&value("2e11"), &value("8000")));
    assert_eq!(length, &Some(value("a/500")));
    assert_eq!(striker.velocity, value("10"));
    let Kind::Mass(plate) = &scene.elements[1].kind else { panic!("a mass") };
    assert_eq!((&plate.mass, plate.velocity.is_zero()), (&value("0.03"), true));
    let Kind::Spring(pad) = &scene.elements[2].kind else { panic!("a spring") };
    assert_eq!((pad.stiffness.is_zero(), &pad.damping), (true, &value("300")));
    let Kind::Load(pull) = &scene.elements[3].kind else { panic!("a load") };
    assert_eq!((pull.drive, &pull.from, &pull.until), (Drive::Velocity, &value("1/500"), &None));
    assert_eq!(pull.course, read_expression(&source("value", "1000*t*exp(-1000*t)")).unwrap());
    let Kind::Bar(output) = &scene.elements[4].kind else { panic!("a bar") };
    assert!(output.is_endless() && striker.strain == value("-1e-3"));
    assert_eq!((scene.line.left, scene.line.right), (End::Fixed, End::Endless));
    assert_eq!(scene.line.elements, [0, 1, 2, 3, 4]);
    assert_eq!((scene.line.joints[0], scene.line.joints[1]), (Joint::Contact, Joint::Bonded));
    let [first, second] = &scene.observables[0].terms[..] else { panic!("two terms") };
    assert_eq!((&first.coefficient, first.measure), (&value("-2/3"), Measure::Stress));
    assert_eq!(first.place, Place::At(0, Position::Share(value("1/2"))));
    assert_eq!(second.place, Place::At(4, Position::Distance(value("3/1000"))));
    assert_eq!(scene.observables[1].terms[0].place, Place::Line);
    assert_eq!(scene.time.name(), "t");
}

#[test]
fn values_are_put_in_place_of_symbols() {
    let scene = meaning(BAR, &[("a", "150")]).unwrap();
    let Kind::Bar(striker) = &scene.elements[0].kind else { panic!("a bar") };
    assert_eq!(striker.extent(), Some(&value("0.3")));
    assert_eq!(scene.assumptions.symbols().count(), 0);
    for value in [("a", "0"), ("b", "1"), ("pi", "3")] {
        let errors = meaning(BAR, &[value]).unwrap_err();
        assert_eq!(errors.len(), 1, "{}", rendered(&errors));
    }
}

#[test]
fn examples_have_units_where_the_scene_has_them() {
    let remedy = |text: &str| meaning(text, &[]).unwrap_err()[0].remedy().unwrap().to_owned();
    let plain = "scene \"A\"\nspring a {}\nline free - a - free";
    assert!(remedy(plain).contains("`stiffness = 40` or `damping = 0.3`"));
    assert!(remedy(&plain.replace("spring", "bar")).contains("`material = steel, diameter = 20`"));
    let units = format!("{plain}\nmass ram {{ mass = 1 kg }}");
    assert!(remedy(&units).contains("`stiffness = 40 kN/mm` or `damping = 0.3 kN*s/m`"));
}

#[test]
fn spans_of_statements_leave_out_comments() {
    let text =
        "scene \"A\"\r\nbar a {\r\n  travel = 1 # s\r\n} # end\r\nline free - a - free # all\n";
    let tree = parse_scene(&source("text", text)).unwrap();
    let slices: Vec<&str> =
        tree.statements.iter().map(|statement| tree.source.slice(statement.span)).collect();
    assert_eq!(slices, ["bar a {\r\n  travel = 1 # s\r\n}", "line free - a - free"]);
}

// ---- Random texts and trees ---------------------------------------------------------------------

/// Pieces of which wrong texts are usually made.
const PIECES: [&str; 48] = [
    "scene ",
    "\"A\"",
    "symbol ",
    "nonzero ",
    "material ",
    "bar ",
    "mass ",
    "spring ",
    "support ",
    "load ",
    "line ",
    "observe ",
    "free",
    "fixed",
    "endless",
    "velocity",
    "force",
    "strain",
    "at",
    "left",
    "travel",
    "impedance",
    "a",
    "μ",
    "pi",
    "t",
    "m",
    "kN",
    "µs",
    "{",
    "}",
    "(",
    ")",
    "=",
    ",",
    ".",
    "-",
    "−",
    "|",
    "*",
    "/",
    "^",
    "²",
    "1",
    "0.5",
    " ",
    "\n",
    "\n  ",
];

fn assert_total(text: &str) -> Result<(), TestCaseError> {
    let Ok(source) = Source::new("text", text) else { return Ok(()) };
    let _ = read(&source, &BTreeMap::new());
    let errors = read_scene(&source, &BTreeMap::new()).err().unwrap_or_default();
    for error in errors {
        let Span { start, end } = error.span();
        prop_assert!(start <= end && source.text().get(start..end).is_some(), "{error}");
        for label in error.secondary() {
            prop_assert!(source.text().get(label.span.start..label.span.end).is_some());
        }
        prop_assert!(!error.message().contains("cannot be read"), "{error}");
    }
    if let Ok(tree) = parse_scene(&source) {
        assert_prints_and_reads_back(&tree);
    }
    Ok(())
}

/// A statement as text, of random parts that fit the grammar.
fn statement() -> BoxedStrategy<String> {
    let name = || prop::sample::select(&["a", "b", "rod", "ram", "mu_1", "Z"]);
    let number = (0_u32..50, 1_u32..9).prop_map(|(over, under)| match under {
        1 => BigRational::from_integer(BigInt::from(over)).to_string(),
        _ => format!("{over}/{under}"),
    });
    let expression = (number, name(), 0_usize..4).prop_map(|(number, name, form)| match form {
        0 => number,
        1 => format!("-{number}*{name}"),
        2 => format!("({number} + {name})^2/{name}"),
        _ => format!("{number} - {name}"),
    });
    let unit = prop::sample::select(&["", " m", " kN*s/m", " kg/m^3", " s^-1", " µm·GPa²"]);
    let value = (expression, unit).prop_map(|(value, unit)| format!("{value}{unit}"));
    let word = prop::sample::select(&["length", "mass", "from", "stiffness"]);
    let property = (word, value.clone()).prop_map(|(word, value)| format!("{word} = {value}"));
    let kinds = prop::sample::select(&["material", "bar", "mass", "spring", "support", "load"]);
    let declaration = (kinds, name(), prop::collection::vec(property, 0..4))
        .prop_map(|(kind, name, all)| format!("{kind} {name} {{ {} }}", all.join(",\n  ")));
    let end = || prop::sample::select(&["free", "fixed", "endless"]);
    let joint = prop::sample::select(&["-", "|", "−"]);
    let line = (end(), prop::collection::vec((joint, name()), 1..5), end()).prop_map(
        |(left, elements, right)| {
            let elements: Vec<String> =
                elements.iter().map(|(joint, name)| format!("{joint} {name}")).collect();
            format!("line {left} {} - {right}", elements.join(" "))
        },
    );
    let section = value.prop_map(|value| format!(".at({value})"));
    let section = prop_oneof![Just(String::new()), Just(".left".to_owned()), section];
    let factor = prop::sample::select(&["", "2*", "-a/3*", "(1 + a)^2*2*", "1/(a*b)*", "- -1*"]);
    let divisor = prop::sample::select(&["", "/2", "*3/(a*b)", "/-a"]);
    let measure = prop::sample::select(&["velocity", "force", "energy", "compression"]);
    let term = (factor, measure, name(), section, divisor).prop_map(
        |(factor, measure, name, section, divisor)| {
            format!("{factor}{measure}({name}{section}){divisor}")
        },
    );
    let observe =
        (name(), prop::collection::vec((any::<bool>(), term), 1..4)).prop_map(|(name, terms)| {
            let terms: Vec<String> = terms
                .iter()
                .map(|(plus, term)| format!("{} {term}", if *plus { '+' } else { '-' }))
                .collect();
            format!("observe {name} = {}", terms.join(" "))
        });
    prop_oneof![declaration, line, observe].boxed()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_statements_print_and_read_back(all in prop::collection::vec(statement(), 1..6)) {
        let text = format!("scene \"A\"\n{}\n", all.join("\n"));
        let tree = match parse_scene(&source("text", &text)) {
            Ok(tree) => tree,
            Err(error) => return Err(TestCaseError::fail(error.to_string())),
        };
        assert_prints_and_reads_back(&tree);
        assert_total(&text)?;
    }

    #[test]
    fn random_pieces_never_panic(pieces in prop::collection::vec(prop::sample::select(&PIECES), 0..40)) {
        let text = pieces.concat();
        assert_total(&text)?;
        assert_total(&format!("scene \"A\"\n{text}"))?;
        assert_total(&format!("scene \"A\"\nbar a {{ travel = {text}"))?;
        assert_total(&format!("scene \"A\"\nobserve a = {text}"))?;
        assert_total(&format!("scene \"A\"\nline {text}"))?;
    }

    #[test]
    fn damaged_scenes_never_panic(
        (_, bytes) in prop::sample::select(corpus("accepted-scenes")),
        place in any::<prop::sample::Index>(),
        removed in 0_usize..4,
        piece in prop::sample::select(&PIECES),
    ) {
        let characters: Vec<char> = String::from_utf8(bytes).unwrap().chars().collect();
        let start = place.index(characters.len());
        let end = (start + removed).min(characters.len());
        let text: String = characters[..start]
            .iter()
            .copied()
            .chain(piece.chars())
            .chain(characters[end..].iter().copied())
            .collect();
        assert_total(&text)?;
    }
}

#[test]
fn long_scenes_take_little_time() {
    let line = "mass ram { mass = 1 kg, velocity = x m/s, width = 3 Pas }\n";
    let text = format!("scene \"Long\"\n{}", line.repeat(10_000));
    let errors = meaning(&text, &[]).unwrap_err();
    assert_eq!(errors.len(), 50);
    let names: Vec<String> = (0..10_000).map(|number| format!("rod_{number}")).collect();
    let bars: Vec<String> =
        names.iter().map(|name| format!("bar {name} {{ impedance = 1, travel = 1 }}\n")).collect();
    let text = format!(
        "scene \"Long\"\n{}load push {{ force = 1 }}\nline free - {} - push - free\n",
        bars.concat(),
        names.join(" - ")
    );
    assert_eq!(meaning(&text, &[]).unwrap().elements.len(), 10_001);
    let errors = meaning(&text.replace("- rod_", "- bar_"), &[]).unwrap_err();
    assert!(errors.len() >= 50);
    let unit = format!("scene \"Long\"\nmass ram {{ mass = 1 kg{} }}", "*km^9/mm^9".repeat(50_000));
    assert_eq!(meaning(&unit, &[]).unwrap_err().last().unwrap().label(), "too large");
}

/// A support without stiffness and damping resists nothing; so a range of dampers may begin at zero.
#[test]
fn a_support_may_resist_nothing() {
    let read = |damping: &str, support: &str, more: &str| {
        let text = format!(
            "scene \"Toe\"\nsymbol d >= 0\nmass ram {{ mass = 2 + d, velocity = 1 }}\n\
             bar pile {{ impedance = 1, travel = 1 }}\n{damping}line free - ram | pile {support}- free\n\
             observe x = displacement(pile.right)\nobserve force = force(pile.left)\n{more}"
        );
        let problem =
            wavestep::Problem::read("toe.wave", &text).unwrap_or_else(|error| panic!("{error}"));
        problem.with("d", 0).unwrap_or_else(|error| panic!("{error}"))
    };
    for more in ["", "contacts open\n"] {
        let with = read("support toe { damping = d }\n", "- toe ", more);
        let without = read("", "", more);
        for name in ["x", "force"] {
            for time in ["1/2", "7/2", "23/4"] {
                let [with, without] = [&with, &without]
                    .map(|own| own.signal(name).unwrap().at(time, 20).unwrap().to_string());
                assert_eq!(with, without, "{name}({time}) {more}");
            }
        }
    }
    let text = "scene \"Gap\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\nspring s { damping = 0 }\n\
                bar b { impedance = 1, travel = 1 }\nline free - a - s - b - free\n";
    let error = wavestep::Problem::read("gap.wave", text).err().expect("no link");
    assert!(error.to_string().contains("neither stiffness nor damping"), "{error}");
}
