//! `certify`: what is claimed, with all that it takes to verify it, for checkers that share nothing with this program.

mod drawing;
mod motion;
mod reading;
mod window;
mod writer;

use super::arguments::Certify;
use super::compared;
use super::failure::Failure;
use super::input;
use super::progress;
use num_bigint::BigInt;
use num_rational::BigRational;
use reading::Read;
use serde_json::{Map, Value as Json, json};
use wavestep::answer::Accuracy;
use wavestep::ball::Decimal;
use wavestep::expression::{Constant, Definition};
use wavestep::limits::VALUE_BITS;
use wavestep::planner::has_periods;
use wavestep::problem::{
    Derived, Digits, Form, Orders, Problem, Symbols, ToDerive, Undecided, Wanted, evenly_spaced,
};
use wavestep::recurrence::Observation;
use wavestep::signal::{Goal, Limit, Value};
use wavestep_polynomial::Symbol;
use window::Asked;
use writer::Writer;

/// The version of the layout, which docs/certificates.md describes.
const VERSION: u32 = 1;

/// Significant digits of a double.
const DOUBLE_DIGITS: usize = 17;

/// The most doubles in one certificate.
const MOST_DOUBLES: usize = 10_000;

/// The last period without --through.
const LAST: usize = 3;

pub fn run(options: &Certify) -> Result<String, Failure> {
    input::digits(options.digits)?;
    let (problem, minus) = compared::scenes(&options.scene, options.minus.as_deref())?;
    let document = match (&options.quantity, &options.at, goal(options)) {
        _ if options.events => {
            let window = input::window(&problem, &options.from, options.to.as_deref())?;
            motion::events(&problem, &window, options.digits)?
        }
        (Some(_), Some(at), _) if at.contains(',') => {
            let remedy = "give one, or evenly spaced times by --points N";
            return Err(Failure::usage("a certificate of a value is for one time", remedy));
        }
        (Some(name), Some(at), _) => {
            let at = problem.time("--at", at.as_str())?;
            value(&problem, name.trim(), &at, options.digits)?
        }
        (.., Some((goal, name))) => {
            let window = input::window(&problem, &options.from, options.to.as_deref())?;
            let other = minus.as_ref().map(|own| own.problem().ok_or_else(without_laws));
            let other = other.transpose()?;
            let of = Quantity { problem: &problem, minus: other, name: name.trim() };
            window::certificate(&of, goal, &window, options.digits)?
        }
        (Some(name), None, None) => doubles(&problem, name.trim(), options)?,
        _ if options.general => general(&problem)?,
        _ => pieces(&problem, options.through.unwrap_or(LAST))?,
    };
    Ok(written(document))
}

fn without_laws() -> Failure {
    let message = "modes and arrivals are not the solution of a scene, so there is no certificate";
    Failure::usage(message, "subtract a scene, or simplify this one")
}

/// A quantity, or how far it is from that of another scene.
struct Quantity<'a> {
    problem: &'a Problem,
    minus: Option<&'a Problem>,
    name: &'a str,
}

/// The certificate of the first pieces, as far as they are short.
pub fn of_pieces(problem: &Problem) -> Result<String, Failure> {
    let (Orders::Through(_, last) | Orders::Only(last), _) =
        problem.first_orders(ToDerive::Waves, 0);
    Ok(written(pieces(problem, last.min(LAST))?))
}

/// As text, the version first.
fn written(mut document: Map<String, Json>) -> String {
    document.shift_insert(0, "wavestep_certificate".into(), json!(VERSION));
    format!("{}\n", Json::Object(document))
}

/// What is asked about a window, and of which quantity.
fn goal(options: &Certify) -> Option<(Asked, &str)> {
    let goals = [
        (Asked::Extremum(Goal::Largest), &options.max),
        (Asked::Extremum(Goal::Smallest), &options.min),
        (Asked::Distance, &options.distance),
        (Asked::Roots, &options.zero),
    ];
    goals.into_iter().find_map(|(goal, name)| Some((goal, name.as_deref()?)))
}

/// What the scene states: its line, or its equations.
fn stated(problem: &Problem, writer: &mut Writer) -> Result<Map<String, Json>, Failure> {
    let recurrence = problem.recurrence()?;
    let statement = recurrence.statement();
    // A number of the scene may be any other: formulas hold it as a symbol. A rate depends on these numbers.
    let numbers = problem.network().map_or(&[][..], |network| &network.model().constants);
    let is_rate = |constant: &&Constant| {
        !matches!(constant.value, Definition::Root(_)) || !numbers.contains(constant)
    };
    if let Some(constant) = recurrence.constants().iter().find(is_rate) {
        let message = format!(
            "formulas of this scene hold the rate `{}`, a root that depends on other numbers",
            constant.symbol
        );
        return Err(Failure::usage(
            message,
            "certificates are written where all rates are rational, or roots of rational numbers",
        ));
    }
    let mut document = Map::new();
    let mut insert = |key: &str, value: Json| document.insert(key.into(), value);
    insert("constants", json!(problem.constants(None)?));
    insert("title", json!(problem.title()));
    insert("waves", json!(problem.waves()));
    insert("local", json!(statement.local.name()));
    insert("time", json!(statement.time.name()));
    insert("period", writer.function(&statement.period));
    if let Ok(network) = problem.network() {
        insert("line", drawing::line(network, writer));
        return Ok(document);
    }
    let equations = statement.equations.iter().map(|form| writer.form(recurrence, form));
    insert("equations", equations.collect());
    let continuity = statement.continuity.iter().map(|law| {
        let mut form = writer.form(recurrence, &law.form);
        form["start"] = writer.expression(&law.start);
        form
    });
    insert("continuity", continuity.collect());
    Ok(document)
}

/// The pieces of all waves through a period.
fn pieces(problem: &Problem, last: usize) -> Result<Map<String, Json>, Failure> {
    let mut writer = Writer::default();
    let mut document = derived(problem, last, &mut writer)?;
    document.insert("kind".into(), json!("pieces"));
    document.insert("roots".into(), writer.told_roots());
    Ok(document)
}

/// What a scene states, and the pieces of all waves through a period.
fn derived(
    problem: &Problem,
    last: usize,
    writer: &mut Writer,
) -> Result<Map<String, Json>, Failure> {
    let mut document = stated(problem, writer)?;
    let progress = progress::spinner("deriving");
    let derived = problem.functions(ToDerive::Waves, Orders::Through(0, last), Form::Period)?;
    drop(progress);
    let Derived::Functions(all) = derived else { unreachable!("waves with periods have pieces") };
    let written = all.into_iter().map(|own| {
        let pieces = own.expressions.iter().map(|piece| writer.expression(piece));
        (own.name, pieces.collect())
    });
    let written: Map<String, Json> = written.collect();
    document.insert("through".into(), json!(last));
    document.insert("pieces".into(), Json::Object(written));
    Ok(document)
}

/// The forms of all waves for every period.
fn general(problem: &Problem) -> Result<Map<String, Json>, Failure> {
    // Where there is none, it is told why.
    problem.general_formulas(ToDerive::Waves, Symbols::Own)?;
    let mut writer = Writer::default();
    let mut document = stated(problem, &mut writer)?;
    let (solution, mut forms) = (problem.solution()?, Map::new());
    for (wave, name) in problem.waves().into_iter().enumerate() {
        let form = solution.general(wave).expect("it has a formula");
        forms.insert(name.into(), writer.general(form));
    }
    document.insert("kind".into(), json!("general"));
    document.insert("general".into(), Json::Object(forms));
    document.insert("roots".into(), writer.told_roots());
    Ok(document)
}

/// A value, with the pieces that it is made of.
fn value(
    problem: &Problem,
    name: &str,
    at: &BigRational,
    digits: usize,
) -> Result<Map<String, Json>, Failure> {
    let asked = Digits {
        count: digits,
        max_bits: VALUE_BITS,
        limit: Limit::Right,
        count_echoes: false,
        undecided: Undecided::Refused,
    };
    let wanted = problem.wanted(name)?;
    let found = problem.proven(&wanted, std::slice::from_ref(at), asked, &|| ())?;
    let (decimal, last_place) = rounded(&found.values[0], digits);
    let (mut document, _) = match (Quantity { problem, minus: None, name }).seen(at) {
        Ok(seen) => seen,
        // What is no sum of pieces may be read off a motion.
        Err(refusal) => {
            let of = Quantity { problem, minus: None, name: &wanted.name };
            let read = Read::of(&of, [at, at], digits)?.ok_or(refusal)?;
            return Ok(read.value(&found.values[0]));
        }
    };
    document.insert("kind".into(), json!("value"));
    document.insert("at".into(), json!(at.to_string()));
    document.insert("value".into(), json!(decimal.to_string()));
    document.insert("last_place".into(), json!(last_place));
    Ok(document)
}

/// Doubles at evenly spaced times, each with a bound of its error: that of the method, and half a unit in the last place.
fn doubles(problem: &Problem, name: &str, options: &Certify) -> Result<Map<String, Json>, Failure> {
    let count = options.points.unwrap_or(0);
    if count == 0 || count > MOST_DOUBLES {
        let message = match options.points {
            None => format!("it is not said when {name} is asked for"),
            Some(count) => format!("{count} doubles do not go into one certificate"),
        };
        let remedy = format!("give --at T, or --points N with 1 to {MOST_DOUBLES} points");
        return Err(Failure::usage(message, remedy));
    }
    let accuracy = match (&options.method, &options.tol) {
        (Some(method), _) => Accuracy::Method(super::doubles::method(method)?, None),
        (None, Some(tolerance)) => Accuracy::Within(super::doubles::tolerance(tolerance)?),
        (None, None) => Accuracy::Digits,
    };
    let [from, to] = input::window(problem, &options.from, options.to.as_deref())?;
    let times = evenly_spaced(&from, &to, count);
    let found = problem.doubles(name, &times, Limit::Right, accuracy)?;
    let of = Quantity { problem, minus: None, name };
    let seen = of.seen(&to);
    let bound = found.bound.and_then(BigRational::from_float).ok_or_else(|| {
        let message = format!("the errors of {} have no proven bound", found.method);
        Failure::usage(message, "leave --method out, or give `certified` or `compiled`")
    })?;
    // Beside large values a checker cannot tell that one is exactly zero.
    let largest = found.values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let least = BigRational::from_float(largest * 2.0_f64.powi(-64)).expect("values are finite");
    let rows = found.values.iter().map(|&value| {
        let exact = BigRational::from_float(value).expect("values are finite");
        let unit = BigRational::from_float(value.abs().next_up() - value.abs());
        let off = &bound + unit.expect("it is finite") / BigRational::from_integer(2.into());
        json!([exact.to_string(), off.max(least.clone()).to_string()])
    });
    let mut document = match seen {
        Ok((document, _)) => document,
        Err(refusal) => {
            let read = Read::of(&of, [&from, &to], DOUBLE_DIGITS)?.ok_or(refusal)?;
            return Ok(read.values(rows.collect()));
        }
    };
    document.insert("kind".into(), json!("doubles"));
    document.insert("from".into(), json!(from.to_string()));
    document.insert("to".into(), json!(to.to_string()));
    document.insert("points".into(), json!(count));
    document.insert("values".into(), rows.collect());
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
    Failure::usage(message, "see them with `wavestep eval`, or certify pieces, with --through")
}

fn refuse_symbols(problem: &Problem) -> Result<(), Failure> {
    let Some(symbol) = problem.symbols().into_iter().next() else { return Ok(()) };
    let remedy = format!("give a number for it, as in --set {symbol}=1/4");
    Err(Failure::usage(format!("the symbol {symbol} has no value"), remedy))
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

impl Quantity<'_> {
    /// All pieces that it is made of until a time, and the times at which new ones may begin.
    fn seen(&self, to: &BigRational) -> Result<(Map<String, Json>, Vec<BigRational>), Failure> {
        let mut writer = Writer::default();
        let (mut document, mut begins) = observed(self.problem, self.name, to, &mut writer)?;
        if let Some(other) = self.minus {
            let (others, more) = observed(other, self.name, to, &mut writer)?;
            document.insert("minus".into(), Json::Object(others));
            begins.extend(more);
        }
        let is_time =
            |own: &&Symbol| [&document["time"], &document["local"]].contains(&&json!(own.name()));
        if let Some(number) = writer.others.iter().find(|own| !is_time(own)) {
            return Err(refused(&format!("whose formulas hold the number {number}")));
        }
        let line = document.get("line").and_then(Json::as_array);
        if line.into_iter().flatten().any(has_root_in_law) {
            return Err(refused("whose laws hold a square root"));
        }
        document.insert("quantity".into(), json!(self.name));
        document.insert("roots".into(), writer.told_roots());
        Ok((document, begins))
    }
}

/// Whether a law of an element holds a square root, for which checkers cannot put numbers.
fn has_root_in_law(element: &Json) -> bool {
    fn has_root(value: &Json) -> bool {
        let is_root = |name: &String| name.starts_with("sqrt(");
        match value {
            Json::Array(parts) => parts.iter().any(has_root),
            Json::Object(powers) => powers.keys().any(is_root),
            _ => false,
        }
    }
    let laws = ["impedance", "mass", "stiffness", "damping"];
    laws.iter().any(|law| element.get(law).is_some_and(has_root))
}

/// What a quantity of a scene is made of until a time, and the times at which new pieces may begin.
fn observed(
    problem: &Problem,
    name: &str,
    to: &BigRational,
    writer: &mut Writer,
) -> Result<(Map<String, Json>, Vec<BigRational>), Failure> {
    let wanted = problem.wanted(name)?;
    let observation = observation(problem, &wanted)?;
    refuse_symbols(problem)?;
    let unknown = || refused("where the period is no rational number");
    let period = problem.shortest_period().ok_or_else(unknown)?;
    // The clocks of waves differ: what is seen may be of a later period than its time.
    let delays: Vec<BigRational> =
        observation.waves.iter().filter_map(|seen| seen.delay.as_constant()).collect();
    let periods = |delay: &BigRational| ((to - delay) / &period).floor().to_integer();
    let last = delays.iter().map(periods).max().unwrap_or_default().max(BigInt::ZERO);
    let last = usize::try_from(last)
        .map_err(|_| Failure::usage("the time is too late", "ask for an earlier time"))?;
    let mut document = derived(problem, last, writer)?;
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
    document.insert("observed".into(), json!({ "waves": waves, "forcing": forcing }));
    let count = |n: usize| BigRational::from_integer(n.into());
    let begins = delays.iter().flat_map(|delay| (0..=last).map(move |n| (delay, count(n))));
    Ok((document, begins.map(|(delay, n)| delay + n * &period).collect()))
}
