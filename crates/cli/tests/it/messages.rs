//! How mistakes in texts are told: the lines that they are about, with marks, remarks and remedies.

use super::{ROOT, folder, run, snapshot, words};
use num_rational::BigRational;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use wavestep::language::{
    Diagnostic, Source, parse_listing, parse_number, parse_recurrence, read_recurrence, read_scene,
};
use wavestep::lock::{Derivable, Lock, Request};
use wavestep::scenes;
use wavestep::solution::Solution;
use wavestep_cli::diagnostic::{Style, render};
use wavestep_studies::dispersion::{Pulse, Shape, peak_velocity, read_relation};

/// The texts of a folder of the grammar, in the order of their names.
fn corpus(folder: &str) -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(ROOT).join("grammar").join(folder);
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let read = |path: PathBuf| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        (name, fs::read(path).unwrap())
    };
    paths.into_iter().map(read).collect()
}

fn source(name: &str, bytes: impl AsRef<[u8]>) -> Result<Source, Diagnostic> {
    Source::new(&format!("{name}.wave"), bytes)
}

fn values(values: &[(&str, &str)]) -> BTreeMap<String, BigRational> {
    let value = |&(name, value): &(&str, &str)| (name.to_owned(), parse_number(value).unwrap());
    values.iter().map(value).collect()
}

/// Compares what is told of errors with what is recorded.
fn explained(folder: &str, name: String, asked: &str, errors: &[Diagnostic]) {
    let texts: Vec<String> = errors.iter().map(|error| render(error, Style::Plain)).collect();
    snapshot(folder, &name, asked, &texts.join("\n\n"));
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

const SYMBOLS: &str = "\
recurrence \"Symbols with conditions\"
symbol a > 0, b < 1/2, c >= 1, d <= 2, e != 3, g
nonzero a - b
period 1, local s, time t
wave f
equation f[n] = f[n-1]/(a - b)
";

#[test]
fn rejected_texts_are_explained() {
    let corpus = corpus("rejected");
    assert!(corpus.len() >= 25);
    for (name, bytes) in corpus {
        let error =
            source(&name, bytes).and_then(|source| parse_recurrence(&source)).expect_err(&name);
        explained(
            "language",
            format!("rejected-{name}"),
            &format!("grammar/rejected/{name}.wave"),
            &[error],
        );
    }
}

/// These follow the grammar; what is wrong with them is found when names are given a meaning.
#[test]
fn texts_without_meaning_are_explained() {
    let corpus = corpus("rejected-names");
    assert!(corpus.len() >= 80);
    for (name, bytes) in corpus {
        let source = source(&name, bytes).unwrap();
        let error = read_recurrence(&source, &BTreeMap::new()).expect_err(&name);
        explained(
            "language",
            format!("rejected-names-{name}"),
            &format!("grammar/rejected-names/{name}.wave"),
            &[error],
        );
    }
}

#[test]
fn wrong_values_are_explained() {
    for (name, set) in [
        ("unknown", &[("h", "1")][..]),
        ("misspelt", &[("A", "1")]),
        ("time", &[("t", "1")]),
        ("wave", &[("f", "1")]),
        ("greater", &[("a", "0")]),
        ("less", &[("b", "1/2")]),
        ("at-least", &[("c", "0.999")]),
        ("at-most", &[("d", "2.001")]),
        ("unequal", &[("e", "6/2")]),
        ("equal", &[("a", "1/4"), ("b", "1/4")]),
    ] {
        let source = source("symbols", SYMBOLS).unwrap();
        let error = read_recurrence(&source, &values(set)).expect_err(name);
        explained("language", format!("value-{name}"), &format!("{set:?}"), &[error]);
    }
}

#[test]
fn wrong_listings_are_explained() {
    for (name, text) in [
        ("empty", "# nothing\n"),
        ("index-symbolic", "f[n](s) = 1\n"),
        ("argument-missing", "f[3] = 1\n"),
        ("value-missing", "f[3](s) =\n"),
        ("statement", "wave f, g\n"),
    ] {
        let error = parse_listing(&Source::new("text", text).unwrap()).expect_err(name);
        explained("language", format!("listing-{name}"), text, &[error]);
    }
}

#[test]
fn wrong_numbers_are_explained() {
    for (name, text) in [
        ("empty", ""),
        ("blank", "  "),
        ("nan", "nan"),
        ("infinity", "-inf"),
        ("infinity-sign", "∞"),
        ("name", "2*mu"),
        ("two", "1 2"),
        ("comma", "0,5"),
        ("percent", "5%"),
        ("unit", "3mm"),
        ("hexadecimal", "0x10"),
        ("assignment", "mu=3"),
        ("exponential", "exp(1)"),
        ("divided-by-zero", "1/(2-2)"),
        ("zero-to-negative-power", "0^-1"),
        ("root", "2^0.5"),
        ("tower", "9^9^9^9"),
    ] {
        let error = parse_number(text).expect_err(name);
        explained("language", format!("number-{name}"), text, &[error]);
    }
}

#[test]
fn colour_changes_nothing_but_colour() {
    let source = source("a", "recurrence \"A\"\nwave f g").unwrap();
    let error = parse_recurrence(&source).unwrap_err();
    let coloured = render(&error, Style::Coloured);
    assert!(coloured.contains("\u{1b}["));
    let mut plain = String::new();
    let mut rest = coloured.as_str();
    while let Some((before, after)) = rest.split_once("\u{1b}[") {
        plain.push_str(before);
        rest = after.split_once('m').unwrap().1;
    }
    plain.push_str(rest);
    assert_eq!(plain, render(&error, Style::Plain));
}

#[test]
fn rejected_scenes_are_explained() {
    for (name, bytes) in corpus("rejected-scenes") {
        let source = source(&name, bytes).unwrap();
        let errors = read_scene(&source, &BTreeMap::new()).expect_err(&name);
        explained(
            "scene-language",
            format!("rejected-{name}"),
            &format!("grammar/rejected-scenes/{name}.wave"),
            &errors,
        );
    }
}

#[test]
fn wrong_values_of_scenes_are_explained() {
    for (name, set) in [("outside", ("a", "0")), ("unknown", ("b", "1")), ("pi", ("pi", "3"))] {
        let source = source("text", BAR).unwrap();
        let errors = read_scene(&source, &values(&[set])).expect_err(name);
        explained("scene-language", format!("value-{name}"), &format!("{set:?}"), &errors);
    }
}

#[test]
fn damaged_files_are_explained() {
    let text = scenes::find("constant-force").unwrap().text;
    let recurrence = read_recurrence(&source("scene", text).unwrap(), &BTreeMap::new()).unwrap();
    let times = vec![BigRational::from_integer(1.into())];
    let request = Request { times, ..Request::default() };
    let solution = Solution::new(recurrence);
    let good =
        Lock::of_pieces(Derivable::Equations(&solution), Some(1), &request).unwrap().to_text();
    let cases = [
        ("heading", good.replace("# wavestep lock 1", "# my notes")),
        ("version", good.replace("lock 1", "lock 3")),
        ("empty", String::new()),
        ("count", good.replace("through 1", "through many")),
        ("value", good.replace("value f(1)", "value f")),
        ("value-time", good.replace("value f(1)", "value f(soon)")),
        ("digits", good.replace("digits 20", "digits 0")),
        ("twice", good.replace("f[1](s) = 2", "f[0](s) = 2")),
        ("value-number", good.replace("value f(1) = 1", "value f(1) = one")),
        ("setting", good.replace("digits 20", "set mu")),
        ("piece", good.replace("f[1](s) = 2", "f[1](s) = 2 +")),
        ("line", good.replace("f[1](s) = 2", "f[1] is two")),
        ("cut", good[..good.find("\nvalue ").expect("a value")].to_owned()),
        ("binary", good.replace("= 2", "= \0")),
    ];
    for (name, text) in cases {
        assert_ne!(text, good, "{name}");
        let source = Source::new("damaged.lock", &text);
        let error = source.and_then(|source| Lock::read(&source)).expect_err(name);
        explained("lock", format!("damaged-{name}"), "a lock of constant-force, damaged", &[error]);
    }
}

#[test]
fn refused_formulas_of_wavenumbers_are_explained() {
    let read = |text| read_relation(&Source::new("relation", text)?, &BTreeMap::new());
    let mut told = String::new();
    for (text, length) in [
        ("k - k^3/12", 1),      // negative beyond √12
        ("k*(k - 1)", 2),       // negative from the start
        ("sqrt(1 - k)", 2),     // not real beyond 1
        ("sqrt((k - 1)^2)", 2), // a corner at 1
        ("k + 1/(k - 1)^2", 2), // a pole at 1
        ("c*k^2", 2),           // no value for c
    ] {
        let length = BigRational::from_integer(length.into());
        let pulse = Pulse::in_space(Shape::Gaussian, &length).unwrap();
        let error = peak_velocity(&read(text).unwrap(), &pulse, 12, 1000).unwrap_err();
        told += &format!("{text}: {error}\n    {}\n", error.remedy());
    }
    for text in ["2*k + sinh(k)", "k/0", "f[n]", "3", "k/(k - k)", "k^x", "k^(1/2", "0^(-1)*k"] {
        told += &format!("\n{}\n", render(&read(text).unwrap_err(), Style::Plain));
    }
    snapshot("dispersion", "errors", "formulas that are refused", &told);
}

/// A misspelt file is looked for in its folder, and among the built-in scenes.
#[test]
fn missing_files_are_told_with_what_is_there() {
    let folder = folder("missing-files");
    std::fs::write(folder.join("shpb.wave"), "").unwrap();
    for (line, remedy) in [
        ("check shbp.wave", "did you mean `shpb.wave`?"),
        ("check ./shbp.wave", "did you mean `./shpb.wave`?"),
        ("check hopkinson.wave", "did you mean the built-in scene `hopkinson`?"),
        ("check zzz.wave", "`wavestep scenes` lists them"),
        ("check zzz", "or a built-in scene: two-bars"),
    ] {
        let (code, out, told) = run(&folder, &words(line));
        assert_eq!((code, out.as_str()), (2, ""), "{line}");
        assert!(told.contains(remedy), "{line}: {told}");
    }
}
