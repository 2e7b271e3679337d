//! Scenes of bars and lumped elements, from the text to numbers: against the recurrences of the same
//! scenes, against the laws of mechanics as identities, and against a numerical method that shares
//! nothing with what is tested.

mod march;
mod numbers;
mod proof;
mod shipped;
mod special;
mod twins;
mod units;
mod work;

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_rational::BigRational;
use wavestep::language::{Source, parse_number, read_scene};
use wavestep::network::Network;
use wavestep::problem::Problem;
use wavestep::scene::Scene;
use wavestep::scenes::{self, SCENES};

type Values<'a> = &'a [(&'a str, &'a str)];

fn rational(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(BigInt::from(numerator), BigInt::from(denominator))
}

/// The scene of a text, with values.
fn scene_of(text: &str, values: Values<'_>) -> Scene {
    let source = Source::new("test.wave", text).expect("a text");
    let value =
        |(name, value): &(&str, &str)| ((*name).to_owned(), parse_number(value).expect("a number"));
    let values: BTreeMap<_, _> = values.iter().map(value).collect();
    read_scene(&source, &values).unwrap_or_else(|errors| {
        let texts: Vec<String> = errors.iter().map(ToString::to_string).collect();
        panic!("{}\n{text}", texts.join("\n"))
    })
}

fn network_of(scene: &Scene) -> Network {
    Network::new(scene).unwrap_or_else(|error| panic!("{}: {error}", scene.title))
}

fn built_in(name: &str) -> &'static str {
    scenes::find(name).expect("a scene of the library").text
}

/// The built-in scenes that are described by their parts and are linear.
fn shipped() -> impl Iterator<Item = &'static scenes::Scene> {
    let is_linear = |name| {
        let problem = Problem::builtin(name).ok()?;
        let elements = &problem.network().ok()?.scene().elements;
        Some(!elements.iter().any(|own| matches!(own.kind, wavestep::scene::Kind::Hertz(_))))
    };
    SCENES.iter().filter(move |scene| is_linear(scene.name) == Some(true))
}

/// Values for the symbols of a built-in scene.
fn usual(name: &str) -> Values<'static> {
    match name {
        "striker-on-long-bar" | "bars-that-part" => &[("r", "7/3")],
        "cushioned-impact" | "cushion-with-release" => &[("mu", "3/2")],
        "mass-on-fixed-bar" | "struck-free-bar" | "saint-venant" => &[("mu", "2/3")],
        "mass-between-bars" | "mass-on-free-bar" => &[("m", "5/4")],
        _ => &[],
    }
}
