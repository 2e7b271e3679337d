//! Cheaper models against the exact solution: how their errors fall, and what they refuse.

mod cheap;
mod collocation;
mod course;
mod leapfrog;
mod modes;
mod refusals;
mod shape;
mod steps;
mod track;

use num_rational::BigRational;
use num_traits::ToPrimitive;
use std::collections::BTreeMap;
use wavestep::language::{Source, parse_number, read_scene};
use wavestep::model::Model;
use wavestep::network::{Network, ObservedValue};
use wavestep::signal::{ClosedSignal, Limit, digits};

type Settings<'a> = &'a [(&'a str, &'a str)];

fn network(text: &str, settings: Settings<'_>) -> Network {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let source = Source::new("test.wave", lines.join("\n")).expect("a text");
    let value = |(name, value): &(&str, &str)| ((*name).to_owned(), parse_number(value).unwrap());
    let values: BTreeMap<_, _> = settings.iter().map(value).collect();
    let scene = read_scene(&source, &values).unwrap_or_else(|errors| {
        let texts: Vec<String> = errors.iter().map(ToString::to_string).collect();
        panic!("{}\n{text}", texts.join("\n"))
    });
    Network::new(&scene).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn built_in(name: &str, settings: Settings<'_>) -> Network {
    network(wavestep::scenes::find(name).expect("a scene").text, settings)
}

/// `count` times within `(0, last)` that lie on no grid of small numbers.
fn times(last: &str, count: i64) -> Vec<BigRational> {
    let last = parse_number(last).expect("a number");
    let share = |k: i64| BigRational::new(((2 * k + 1) * 9973).into(), (2 * count * 10007).into());
    (0..count).map(|k| &last * share(k)).collect()
}

/// The exact values of an observable.
fn exact(network: &Network, observable: usize, times: &[BigRational]) -> Vec<f64> {
    let window = [&BigRational::default(), times.iter().max().expect("a time")];
    let signal = ClosedSignal::of_scene(network, &network.observables()[observable], window);
    let signal = signal.expect("a window").echo_by_echo();
    let value = |time: &BigRational| {
        let value = digits(&signal, time, Limit::Right, 17, 1 << 10);
        let value = value.unwrap_or_else(|error| panic!("{error}"));
        value.decimal(17).0.to_string().parse().expect("a number")
    };
    times.iter().map(value).collect()
}

/// The observables that all models keep account of: neither energies, nor momenta with an endless bar.
fn linear(network: &Network) -> Vec<usize> {
    let endless = network.model().bars.values().any(|bar| bar.travel.is_none());
    let kept = |i: &usize| {
        let observed = &network.observables()[*i];
        matches!(observed.value, ObservedValue::Linear(_))
            && !(endless && observed.name == "momentum")
    };
    (0..network.observables().len()).filter(kept).collect()
}

fn doubles(times: &[BigRational]) -> Vec<f64> {
    times.iter().map(|time| time.to_f64().expect("a double")).collect()
}

/// The differences of a model from exact values.
fn differences(
    model: &dyn Model,
    observable: usize,
    times: &[BigRational],
    exact: &[f64],
) -> Vec<f64> {
    let values =
        model.values(observable, &doubles(times)).unwrap_or_else(|error| panic!("{error}"));
    values.iter().zip(exact).map(|(a, b)| (a - b).abs()).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| f64::max(most, value.abs()))
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}
