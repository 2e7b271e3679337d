//! `certify`: what is claimed, with all that it takes to verify it, for checkers that share nothing with this program.

mod drawing;
mod window;
mod writer;

use super::arguments::Certify;
use super::failure::Failure;
use super::input;
use super::progress;
use num_bigint::BigInt;
use num_rational::BigRational;
use serde_json::{Map, Value as Json, json};
use wavestep::ball::Decimal;
use wavestep::expression::{Constant, Definition};
use wavestep::limits::VALUE_BITS;
use wavestep::planner::has_periods;
use wavestep::problem::{Derived, Digits, Form, Orders, Problem, ToDerive, Wanted};
use wavestep::recurrence::{LinearForm, Observation, Recurrence, Statement};
use wavestep::signal::{Goal, Limit, Value};
use writer::Writer;

/// The version of the layout, which docs/certificates.md describes.
const VERSION: u32 = 1;

/// The last period without --through.
const LAST: usize = 3;

pub fn run(options: &Certify) -> Result<String, Failure> {
    input::digits(options.digits)?;
    let problem = input::problem(&options.scene)?;
    let document = match (&options.quantity, &options.at, goal(options)) {
        (Some(name), Some(at), _) => {
            let at = problem.time("--at", at.as_str())?;
            value(&problem, name.trim(), &at, options.digits)?
        }
        (.., Some((goal, name))) => {
            let to = options.to.as_deref().unwrap_or_default();
            let window = problem.window(("--from", &options.from), ("--to", to))?;
            window::certificate(&problem, name.trim(), goal, &window, options.digits)?
        }
        _ => {
            let (mut document, _) = pieces(&problem, options.through.unwrap_or(LAST))?;
            document.insert("kind".into(), json!("pieces"));
            document
        }
    };
    Ok(format!("{}\n", Json::Object(document)))
}

/// What is asked about a window: an extremum, or else roots; and of which quantity.
fn goal(options: &Certify) -> Option<(Option<Goal>, &str)> {
    let goals = [
        (Some(Goal::Largest), &options.max),
        (Some(Goal::Smallest), &options.min),
        (None, &options.zero),
    ];
    goals.into_iter().find_map(|(goal, name)| Some((goal, name.as_deref()?)))
}

/// What the scene states and the pieces of all waves through a period, and the square roots among the symbols.
fn pieces(problem: &Problem, last: usize) -> Result<(Map<String, Json>, Writer), Failure> {
    let recurrence = problem.recurrence()?;
    let statement = recurrence.statement();
    // A square root with a name may be any number: formulas hold it as a symbol.
    let is_rate = |constant: &&Constant| !matches!(constant.value, Definition::Root(_));
    if let Some(constant) = recurrence.constants().iter().find(is_rate) {
        let message = format!(
            "formulas of this scene hold the rate `{}`, which has no formula",
            constant.symbol
        );
        return Err(Failure::usage(
            message,
            "certificates are written where all rates have formulas",
        ));
    }
    let progress = progress::spinner("deriving");
    let derived = problem.functions(ToDerive::Waves, Orders::Through(0, last), Form::Period)?;
    drop(progress);
    let Derived::Functions(all) = derived else { unreachable!("waves with periods have pieces") };
    let mut writer = Writer::default();
    // Integrals of waves, which displacements are made of, follow from the others.
    let is_shown = |wave: usize| all.iter().any(|own| own.name == recurrence.wave_name(wave));
    let is_told = |form: &&LinearForm| form.operators().all(|(wave, _)| is_shown(wave));
    let functions: Map<String, Json> = all
        .iter()
        .map(|own| {
            (
                own.name.clone(),
                own.expressions.iter().map(|piece| writer.expression(piece)).collect(),
            )
        })
        .collect();
    let mut document = Map::new();
    document.insert("wavestep_certificate".into(), json!(VERSION));
    document.insert("through".into(), json!(last));
    document.insert("constants".into(), json!(problem.constants(None)?));
    document.insert("title".into(), json!(problem.title()));
    document.insert("waves".into(), json!(all.iter().map(|own| &own.name).collect::<Vec<_>>()));
    document.insert("local".into(), json!(statement.local.name()));
    document.insert("time".into(), json!(statement.time.name()));
    document.insert("period".into(), writer.function(&statement.period));
    match problem.network() {
        Ok(network) => {
            document.insert("line".into(), drawing::line(network, &mut writer));
        }
        Err(_) => document.extend(stated(recurrence, statement, &is_told, &mut writer)),
    }
    document.insert("pieces".into(), Json::Object(functions));
    document.insert("roots".into(), writer.told_roots());
    Ok((document, writer))
}

/// The equations of a scene that states its recurrence.
fn stated(
    recurrence: &Recurrence,
    statement: &Statement,
    is_told: &dyn Fn(&&LinearForm) -> bool,
    writer: &mut Writer,
) -> Map<String, Json> {
    let equations = statement.equations.iter().filter(is_told);
    let equations: Vec<Json> = equations.map(|form| writer.form(recurrence, form)).collect();
    let continuity = statement.continuity.iter().filter(|law| is_told(&&law.form));
    let continuity = continuity.map(|law| {
        let mut form = writer.form(recurrence, &law.form);
        form["start"] = writer.expression(&law.start);
        form
    });
    let continuity: Vec<Json> = continuity.collect();
    [("equations".into(), json!(equations)), ("continuity".into(), json!(continuity))]
        .into_iter()
        .collect()
}

/// A value, with the pieces that it is made of.
fn value(
    problem: &Problem,
    name: &str,
    at: &BigRational,
    digits: usize,
) -> Result<Map<String, Json>, Failure> {
    let wanted = problem.wanted(name)?;
    let observation = observation(problem, &wanted)?;
    let asked =
        Digits { count: digits, max_bits: VALUE_BITS, limit: Limit::Right, count_echoes: false };
    let found = problem.proven(&wanted, std::slice::from_ref(at), asked, &|| ())?;
    let (decimal, last_place) = rounded(&found.values[0], digits);
    let (mut document, _) = observed(problem, name, &observation, at)?;
    document.insert("kind".into(), json!("value"));
    document.insert("at".into(), json!(at.to_string()));
    document.insert("value".into(), json!(decimal.to_string()));
    document.insert("last_place".into(), json!(last_place));
    Ok(document)
}

/// The rounded value, and the power of ten of its last digit: zeros at the end are left out of decimals that are exact.
fn rounded(value: &Value, digits: usize) -> (Decimal, i64) {
    let (decimal, _) = value.decimal(digits);
    let last_place = decimal.place() - (digits - decimal.significant()) as i64;
    (decimal, last_place)
}

fn refused(reason: &str) -> Failure {
    let message = format!("there are no certificates of values {reason}");
    Failure::usage(message, "certify its pieces, with --through")
}

/// A quantity as a sum of waves.
fn observation(problem: &Problem, wanted: &Wanted) -> Result<Observation, Failure> {
    let opens = problem.network().is_ok_and(|network| !has_periods(network));
    match wanted.observation() {
        _ if problem.has_units() => Err(refused("in scenes with units")),
        _ if opens => Err(refused("where contacts open")),
        None => Err(refused(&format!("of {}, which is not linear in the waves", wanted.name))),
        Some(observation) => Ok(observation.clone()),
    }
}

/// The same with all pieces that it is made of until a time, and the times at which new pieces may begin.
fn observed(
    problem: &Problem,
    name: &str,
    observation: &Observation,
    to: &BigRational,
) -> Result<(Map<String, Json>, Vec<BigRational>), Failure> {
    let period = problem.shortest_period().expect("what has values has a period of known length");
    // The clocks of waves differ: what is seen may be of a later period than its time.
    let delays: Vec<BigRational> =
        observation.waves.iter().filter_map(|seen| seen.delay.as_constant()).collect();
    let periods = |delay: &BigRational| ((to - delay) / &period).floor().to_integer();
    let last = delays.iter().map(periods).max().unwrap_or_default().max(BigInt::ZERO);
    let last = usize::try_from(last)
        .map_err(|_| Failure::usage("the time is too late", "ask for an earlier time"))?;
    let (mut document, mut writer) = pieces(problem, last)?;
    if !writer.roots.is_empty() {
        return Err(refused("whose formulas hold square roots"));
    }
    let recurrence = problem.recurrence()?;
    let is_told = |wave: usize| document["pieces"].get(recurrence.wave_name(wave)).is_some();
    if !observation.waves.iter().all(|seen| is_told(seen.wave)) {
        return Err(refused(&format!("of {name}, which is made of integrals of waves")));
    }
    let waves = observation.waves.iter().map(|seen| {
        let wave = recurrence.wave_name(seen.wave);
        let kind = if seen.slope { "slope" } else { "value" };
        let delay = seen.delay.as_constant().map(|delay| delay.to_string());
        json!([wave, kind, delay, writer.expression(&seen.coefficient)])
    });
    let waves: Vec<Json> = waves.collect();
    let forcing = writer.expression(&observation.forcing);
    document.insert("quantity".into(), json!(name));
    document.insert("observed".into(), json!({ "waves": waves, "forcing": forcing }));
    let count = |n: usize| BigRational::from_integer(n.into());
    let begins = delays.iter().flat_map(|delay| (0..=last).map(move |n| (delay, count(n))));
    Ok((document, begins.map(|(delay, n)| delay + n * &period).collect()))
}
