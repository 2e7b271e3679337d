//! `derive` for scenes: explained, on lattices, with the constants that were named.

use super::arguments::{Derive, DeriveFormat, Form};
use super::derive_recurrence::{formulas_as, of_recurrence};
use super::failure::Failure;
use super::json;
use super::progress;
use super::rates::failure_of_rates;
use serde_json::{Value as Json, json};
use std::collections::BTreeSet;
use wavestep::enclosure::Numbers;
use wavestep::evaluate::{Arrival, arrivals};
use wavestep::export::{Derivation, Formula, Head};
use wavestep::expression::{Constant, Definition, Root};
use wavestep::language;
use wavestep::network::{Network, ObservedValue};
use wavestep::recurrence::WaveIndex;
use wavestep::solution::Solution;

/// The last echo of a lattice that is derived where nothing else is asked for.
const THROUGH: usize = 3;

/// The most echoes of a lattice.
const MAX_ECHOES: u128 = 5_000;

/// The periods that a derivation ends with.
const FIRST_PIECES: usize = 2;

/// Significant digits of constants in remarks.
const DIGITS: usize = 6;

/// Derives what is asked for from a scene.
pub fn run(network: &Network, options: &Derive) -> Result<String, Failure> {
    if let Some(name) = &options.observable {
        refuse_energy(network, name)?;
    }
    if options.explain {
        if network.lattice().periods().len() > 1 {
            return Err(Failure::Computation(
                "the travel times have no common measure, or too fine a one: there are no periods \
                 to explain this scene by"
                    .to_owned(),
                "derive its echoes: leave out --explain".to_owned(),
            ));
        }
        return explain(network, options);
    }
    if network.lattice().periods().len() > 1 {
        return on_lattice(network, options);
    }
    let recurrence = network.recurrence()?;
    let of_rates = failure_of_rates(network, &recurrence);
    let derived = of_recurrence(recurrence, network.waves().len(), options);
    let derived = derived.map_err(|failure| match (&failure, of_rates) {
        (Failure::Computation(..), Some(of_rates)) => of_rates,
        _ => failure,
    })?;
    let unit = |mark: &str| match unit_of_observable(network, options) {
        Some(unit) => format!("{mark} {unit}\n"),
        None => String::new(),
    };
    Ok(match options.format {
        DeriveFormat::Json => derived,
        DeriveFormat::Text => {
            format!("{}{}{derived}", constants(network, "#", Some(&derived))?, unit("#"))
        }
        DeriveFormat::Latex => {
            format!("{}{}{derived}", constants(network, "%", None)?, unit("%"))
        }
    })
}

/// In which unit the observable is that is derived, in scenes with units.
fn unit_of_observable(network: &Network, options: &Derive) -> Option<String> {
    let name = language::normalise_name(options.observable.as_deref()?);
    let observed = network.observables().iter().find(|observed| observed.name == name)?;
    if !network.scene().dimensional {
        return None;
    }
    let number = decimal(&network.model().constants, &observed.unit.clone().into())?;
    let unit = language::unit_of(observed.dimension);
    Some(format!("{name} in {number} {unit}").trim_end().to_owned())
}

fn refuse_energy(network: &Network, name: &str) -> Result<(), Failure> {
    let name = language::normalise_name(name);
    let energy = network.observables().iter().find(|observed| {
        observed.name == name && matches!(observed.value, ObservedValue::Energy(_))
    });
    match energy {
        None => Ok(()),
        Some(_) => Err(Failure::Computation(
            format!("{name} is an energy, an integral of squares, and has no pieces of its own"),
            format!("evaluate it: wavestep eval SCENE --quantity {name} --at T"),
        )),
    }
}

/// A definition as a decimal number, where all in it is known.
fn decimal(constants: &[Constant], value: &Definition) -> Option<String> {
    let numbers = Numbers::new(constants);
    let ball = numbers.enclose_definition(value, 64).ok()?;
    Some(ball.to_decimal(DIGITS).midpoint().to_string())
}

/// Lines that say in which units formulas are, and what the constants in them are; all constants
/// where no text is given to look for them.
fn constants(network: &Network, mark: &str, text: Option<&str>) -> Result<String, Failure> {
    let (model, scene) = (network.model(), network.scene());
    let unfolded = network.unfold(&vec![0; network.lattice().periods().len()])?;
    let constants = unfolded.recurrence().constants();
    let mut lines = String::new();
    if scene.dimensional {
        let unit = |value: &Root, unit: &str| {
            decimal(constants, &value.clone().into())
                .map_or(unit.to_owned(), |number| format!("{number} {unit}"))
        };
        let (time, velocity) = (unit(&model.scale.time, "s"), unit(&model.scale.velocity, "m/s"));
        let force = unit(&model.scale.force(), "N");
        lines.push_str(&format!(
            "{mark} times in {time}, velocities in {velocity}, forces in {force}\n"
        ));
    }
    let part_of_name = |c: char| c.is_alphanumeric() || c == '_';
    let words = text.map(|text| text.split(|c| !part_of_name(c)).collect::<BTreeSet<&str>>());
    let occurs = |constant: &&Constant| {
        words.as_ref().is_none_or(|words| words.contains(constant.symbol.name()))
    };
    for constant in constants.iter().filter(occurs) {
        if let Some(number) = decimal(constants, &constant.value) {
            lines.push_str(&format!("{mark} {} = {number}\n", constant.symbol));
        }
    }
    Ok(lines)
}

fn explain(network: &Network, options: &Derive) -> Result<String, Failure> {
    if options.format == DeriveFormat::Json {
        let remedy = "ask for --format text or latex, or leave out --explain";
        return Err(Failure::usage("a derivation is for reading, not for programs", remedy));
    }
    let recurrence = network.recurrence()?;
    let mut derivation =
        Derivation::of(network, &recurrence, &|value| decimal(recurrence.constants(), value));
    let solution = Solution::new(recurrence);
    let local = solution.recurrence().statement().local.clone();
    let mut formulas = Vec::new();
    for (wave, named) in network.waves().iter().enumerate() {
        // What has no exact form is left out; a derivation of this wave says why.
        let pieces = solution.pieces(wave, 0, FIRST_PIECES).unwrap_or_default();
        for (n, piece) in pieces.iter().enumerate() {
            let head = Head::Piece { wave: named.name.clone(), n, local: local.clone() };
            formulas.push(Formula::new(head, piece, &local));
        }
    }
    if !formulas.is_empty() {
        derivation.add("The first pieces", formulas);
    }
    Ok(match options.format {
        DeriveFormat::Latex => derivation.to_latex(options.width()),
        _ => derivation.to_text(options.width()),
    })
}

/// The echoes of a scene whose travel times have no common measure, in order of arrival.
fn on_lattice(network: &Network, options: &Derive) -> Result<String, Failure> {
    let refuse = |what: &str| {
        let message = format!("the travel times have no common measure, so there {what}");
        let remedy = "ask for the echoes of waves, with --wave NAME and --through N, or evaluate";
        Err(Failure::usage(message, remedy))
    };
    if options.general {
        return refuse("is no form for every period");
    }
    if options.observable.is_some() || options.piece.is_some() || options.source_form {
        return refuse("are no periods");
    }
    if options.form == Form::Piecewise {
        return refuse("are no periods on which pieces hold");
    }
    let through = options.through.unwrap_or(THROUGH);
    let waves: Vec<WaveIndex> = match &options.wave {
        None => (0..network.waves().len()).collect(),
        Some(name) => {
            let name = language::normalise_name(name);
            let found = network.waves().iter().position(|wave| wave.name == name);
            let names: Vec<&str> = network.waves().iter().map(|wave| wave.name.as_str()).collect();
            vec![found.ok_or_else(|| {
                let remedy = format!("the waves of this scene are {}", names.join(", "));
                Failure::usage(format!("`{name}` is no wave of this scene"), remedy)
            })?]
        }
    };
    let periods = network.lattice().periods().len();
    let echoes = (0..periods)
        .fold(1_u128, |product, _| product.saturating_mul(through as u128 + 1))
        .saturating_mul(waves.len() as u128);
    if echoes > MAX_ECHOES {
        let message = format!(
            "this would be about {echoes} echoes; at most {MAX_ECHOES} are derived at once"
        );
        return Err(Failure::usage(message, "ask for a smaller --through, or one wave"));
    }
    let _progress = progress::spinner("deriving");
    let found = arrivals(network, &waves, through)?;
    let local = network.local();
    if options.format == DeriveFormat::Json {
        return Ok(json_document(network, &found));
    }
    let time = &network.scene().time;
    let formula = |arrival: &Arrival| {
        let Arrival { wave, counts, delay, echo } = arrival;
        Formula::of_arrival(&network.waves()[*wave].name, counts, delay, echo, &local, time)
    };
    let formulas: Vec<Formula> = found.iter().map(formula).collect();
    if formulas.is_empty() {
        let message = format!("nothing arrives within {through} periods of the lattice");
        return Err(Failure::Computation(message, "ask for a larger --through".to_owned()));
    }
    let mark = if options.format == DeriveFormat::Latex { "%" } else { "#" };
    let told: String = formulas.iter().map(|formula| formula.to_text(options.width())).collect();
    Ok(format!("{}{}", constants(network, mark, Some(&told))?, formulas_as(&formulas, options)))
}

fn json_document(network: &Network, found: &[Arrival]) -> String {
    let echo = |arrival: &Arrival| {
        json!({
            "wave": network.waves()[arrival.wave].name,
            "counts": arrival.counts,
            "delay": json::fraction_json(&arrival.delay),
            "terms": json::expression_json(&arrival.echo),
        })
    };
    let periods: Vec<Json> = network.lattice().periods().iter().map(json::fraction_json).collect();
    let document = json!({
        "schema_version": json::SCHEMA_VERSION,
        "title": network.scene().title,
        "form": "arrivals",
        "periods": periods,
        "local": network.local().name(),
        "echoes": found.iter().map(echo).collect::<Vec<_>>(),
    });
    format!("{document}\n")
}
