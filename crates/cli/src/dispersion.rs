//! `dispersion`: how fast crests, groups and the peaks of pulses travel, for a relation `ω(k)`.

use super::arguments::{Dispersion, Format};
use super::failure::{ACCURACY, COMPUTATION, Failure, USAGE};
use super::input;
use super::json::SCHEMA_VERSION;
use super::progress;
use super::table::Table;
use num_rational::BigRational;
use num_traits::Signed as _;
use serde_json::{Value as Json, json};
use wavestep::ball::{Ball, Value};
use wavestep::language::{self, Source};
use wavestep::problem::number;
use wavestep_polynomial::Symbol;
use wavestep_studies::dispersion::{
    Builtin, DispersionError, Formula, PeakVelocity, Pulse, Quantity, Relation, Seen, Shape,
    exact_peak_velocity, formula_latex, formula_text, peak_velocity, propagate, read_relation,
    read_spectrum,
};

/// The three formulas with their names in text, JSON and LaTeX.
const QUANTITIES: [(Quantity, &str, &str, &str); 3] = [
    (Quantity::Frequency, "omega", "omega", r"\omega"),
    (Quantity::PhaseVelocity, "c_p", "phase_velocity", r"c_{\mathrm{p}}"),
    (Quantity::GroupVelocity, "c_g", "group_velocity", r"c_{\mathrm{g}}"),
];

/// How many digits of what is seen are told: it is tested, not proven.
const SEEN_DIGITS: usize = 6;

impl From<DispersionError> for Failure {
    fn from(error: DispersionError) -> Failure {
        let (message, remedy) = (error.to_string(), error.remedy());
        let code = match error {
            DispersionError::NoWaveNumber
            | DispersionError::MissingValue(_)
            | DispersionError::UnknownParameter(_)
            | DispersionError::ParameterNotPositive(..)
            | DispersionError::NotPositive(..)
            | DispersionError::Grid(_) => USAGE,
            DispersionError::AccuracyNotReached { .. } => ACCURACY,
            _ => COMPUTATION,
        };
        Failure::new(code, message, remedy)
    }
}

/// How a wavenumber that is refused is told.
const PLACE_BITS: u64 = 64;
const PLACE_DIGITS: usize = 8;

/// The three quantities at one wavenumber.
struct At {
    k: BigRational,
    values: Vec<Value>,
}

struct Answer {
    title: String,
    relation: Relation,
    at: Vec<At>,
    /// Its name, the velocity of its peak, and that in closed form.
    pulse: Option<(String, Option<PeakVelocity>, Option<Formula>)>,
    seen: Option<(String, Seen)>,
}

pub fn run(options: &Dispersion) -> Result<String, Failure> {
    input::digits(options.digits)?;
    let (title, relation) = relation(options)?;
    let _progress = progress::spinner("enclosing velocities");
    let mut at = Vec::new();
    for text in &options.wavenumber {
        let k = number("--wavenumber", text)?;
        if k.is_negative() {
            let message = format!("the wavenumber {k} is negative");
            return Err(Failure::usage(message, "give wavenumbers from 0 on"));
        }
        at.push(values(&relation, k, options)?);
    }
    let pulse = pulse(options)?;
    if options.propagate.is_some() && !matches!(pulse, Told::Pulse(..)) {
        let message = "--propagate needs a pulse";
        return Err(Failure::usage(message, "give --length or --duration"));
    }
    let mut answer = Answer { title, relation, at, pulse: None, seen: None };
    match pulse {
        Told::Nothing => {}
        // A shape without a length: its length stays a symbol.
        Told::Shape(shape) => {
            let is_length = |symbol: &Symbol| symbol.name() == "b";
            if answer.relation.parameters().iter().any(is_length) {
                let message = "`b` is both the length of the pulse and a parameter of the relation";
                return Err(Failure::usage(message, "give the parameter another name"));
            }
            let name = format!("{} pulse of length b", shape.name());
            let Some(exact) = exact_peak_velocity(&answer.relation, shape) else {
                let message = format!("the peak velocity of a {name} has no closed form here");
                return Err(Failure::usage(message, "give the length a value: --length 10"));
            };
            answer.pulse = Some((name, None, Some(exact)));
        }
        Told::Pulse(name, pulse) => {
            let peak = peak_velocity(&answer.relation, &pulse, options.digits, options.max_bits)?;
            if let Some(time) = &options.propagate {
                let exact = number("--propagate", time)?;
                let double = num_traits::ToPrimitive::to_f64(&exact).unwrap_or(f64::INFINITY);
                let seen = propagate(&answer.relation, &pulse, double, options.points)?;
                answer.seen = Some((exact.to_string(), seen));
            }
            let exact = peak.exact.clone();
            answer.pulse = Some((name, Some(peak), exact));
        }
    }
    Ok(match options.format {
        Format::Latex => latex(&answer),
        Format::Json => {
            let document = json(&answer, options.digits);
            serde_json::to_string_pretty(&document).expect("JSON") + "\n"
        }
        Format::Csv => {
            let mut document = json(&answer, options.digits);
            // Without wavenumbers there is one row, about the pulse.
            if answer.at.is_empty() {
                document["at"] = Json::Array(document.get("pulse").cloned().into_iter().collect());
            }
            Table::of(&document).csv()
        }
        _ => text(&answer),
    })
}

/// The relation that is named or written, with values put in.
fn relation(options: &Dispersion) -> Result<(String, Relation), Failure> {
    let values = input::values(&options.set)?;
    let written = options.relation.trim();
    if let Some(one) = Builtin::find(written) {
        return Ok((one.title().to_owned(), one.relation().with_values(&values)?));
    }
    let names = Builtin::ALL.map(Builtin::name);
    if written.len() > 1 && written.chars().all(|c| c.is_ascii_alphabetic() || c == '-') {
        let remedy = language::did_you_mean(written, names)
            .unwrap_or_else(|| format!("write a formula in k, or one of {}", names.join(", ")));
        return Err(Failure::usage(format!("there is no relation `{written}`"), remedy));
    }
    let relation = read_relation(&Source::new("relation", &options.relation)?, &values)?;
    Ok((String::new(), relation))
}

fn values(relation: &Relation, k: BigRational, options: &Dispersion) -> Result<At, Failure> {
    let mut values = Vec::new();
    for (quantity, ..) in QUANTITIES {
        values.push(match relation.exact(quantity, &k) {
            Some(value) => Value::Exact(value),
            None => relation.digits(quantity, &k, options.digits, options.max_bits)?,
        });
    }
    let is_negative = match &values[0] {
        Value::Exact(omega) => omega.is_negative(),
        other => other.decimal(options.digits).0.to_rational().is_negative(),
    };
    match is_negative {
        true => {
            let place = Ball::from_rational(&k, PLACE_BITS).to_decimal(PLACE_DIGITS);
            Err(DispersionError::NegativeFrequency(Box::new(place)).into())
        }
        false => Ok(At { k, values }),
    }
}

enum Told {
    Nothing,
    Shape(Shape),
    Pulse(String, Pulse),
}

fn pulse(options: &Dispersion) -> Result<Told, Failure> {
    let written = options.pulse.as_deref().unwrap_or("square").trim();
    let shape = Shape::find(written);
    let plain = shape.unwrap_or(Shape::Square);
    let (extent, pulse) = match (&options.length, &options.duration) {
        (Some(length), _) => {
            let length = number("--length", length)?;
            (format!("of length {length}"), Pulse::in_space(plain, &length)?)
        }
        (None, Some(duration)) => {
            let duration = number("--duration", duration)?;
            (format!("of duration {duration}"), Pulse::in_time(plain, &duration)?)
        }
        (None, None) => {
            return match (&options.pulse, shape) {
                (None, _) => Ok(Told::Nothing),
                (Some(_), Some(shape)) => Ok(Told::Shape(shape)),
                (Some(_), None) => {
                    let message = "a custom spectrum needs a cut-off";
                    Err(Failure::usage(message, "give --length or --duration"))
                }
            };
        }
    };
    Ok(match shape {
        Some(shape) => Told::Pulse(format!("{} pulse {extent}", shape.name()), pulse),
        None => {
            let spectrum = read_spectrum(&Source::new("--pulse", written)?)?;
            let name = format!("pulse {extent} with U = {}", formula_text(&spectrum));
            Told::Pulse(name, pulse.with_spectrum(spectrum)?)
        }
    })
}

fn seen_number(value: f64) -> String {
    format!("{value:.SEEN_DIGITS$}")
}

fn text(answer: &Answer) -> String {
    let mut lines = Vec::new();
    if !answer.title.is_empty() {
        lines.extend([answer.title.clone(), String::new()]);
    }
    for (quantity, name, ..) in QUANTITIES {
        lines.push(format!("{name:<5} = {}", formula_text(answer.relation.formula(quantity))));
    }
    for At { k, values } in &answer.at {
        lines.extend([String::new(), format!("at k = {k}")]);
        for ((_, name, ..), value) in QUANTITIES.iter().zip(values) {
            lines.push(format!("{name:<5} = {value}"));
        }
    }
    if let Some((name, peak, exact)) = &answer.pulse {
        lines.extend([String::new(), name.clone()]);
        if let Some(peak) = peak {
            lines.push(format!("k_co  = {}", peak.cut_off));
        }
        if let Some(exact) = exact {
            lines.push(format!("c_pp  = {}", formula_text(exact)));
        }
        if let Some(PeakVelocity { value: value @ Value::Certified { .. }, .. }) = peak {
            let sign = if exact.is_some() { "      =" } else { "c_pp  =" };
            lines.push(format!("{sign} {value}"));
        }
    }
    if let Some((time, seen)) = &answer.seen {
        lines.extend([
            String::new(),
            format!("observed at t = {time}, not proven"),
            format!("x/t   = {}", seen_number(seen.velocity)),
            format!("height {} of the initial one", seen_number(seen.height / seen.first_height)),
        ]);
    }
    lines.join("\n") + "\n"
}

fn latex(answer: &Answer) -> String {
    let mut rows = Vec::new();
    for (quantity, _, _, name) in QUANTITIES {
        rows.push(format!("{name} &= {}", formula_latex(answer.relation.formula(quantity))));
    }
    let value = |value: &Value| match value {
        Value::Exact(value) => formula_latex(&Formula::number(value)),
        other => other.to_string(),
    };
    for At { k, values } in &answer.at {
        let k = formula_latex(&Formula::number(k));
        for ((_, _, _, name), one) in QUANTITIES.iter().zip(values) {
            rows.push(format!("{name}\\left({k}\\right) &= {}", value(one)));
        }
    }
    if let Some((_, peak, exact)) = &answer.pulse {
        if let Some(peak) = peak {
            rows.push(format!("k_{{\\mathrm{{co}}}} &= {}", value(&peak.cut_off)));
        }
        let exact = exact.as_ref().map(formula_latex);
        let digits = peak.as_ref().and_then(|peak| match &peak.value {
            Value::Exact(_) => None,
            certified => Some(value(certified)),
        });
        let right = match (exact, digits) {
            (Some(exact), Some(digits)) => format!("{exact} \\approx {digits}"),
            (exact, digits) => exact.or(digits).unwrap_or_default(),
        };
        rows.push(format!(r"c_{{\mathrm{{pp}}}} &= {right}"));
    }
    format!("\\begin{{align*}}\n{}\n\\end{{align*}}\n", rows.join(" \\\\\n"))
}

fn value_json(value: &Value, digits: usize) -> Json {
    match value {
        Value::Exact(exact) => json!({"exact": exact.to_string()}),
        Value::Certified { ball, .. } | Value::Enclosed(ball) => {
            let ball = ball.to_decimal(digits + 10);
            let (midpoint, radius) = (ball.midpoint().to_string(), format!("{:e}", ball.radius()));
            let enclosure = json!({"value": midpoint, "radius": radius});
            json!({"value": value.to_string(), "enclosure": enclosure})
        }
    }
}

fn json(answer: &Answer, digits: usize) -> Json {
    let mut document = json!({"schema_version": SCHEMA_VERSION});
    for (quantity, _, name, _) in QUANTITIES {
        document["relation"][name] = json!(formula_text(answer.relation.formula(quantity)));
    }
    let at = |At { k, values }: &At| {
        let mut row = json!({"k": k.to_string()});
        for ((_, _, name, _), value) in QUANTITIES.iter().zip(values) {
            row[*name] = value_json(value, digits);
        }
        row
    };
    document["at"] = answer.at.iter().map(at).collect();
    if let Some((name, peak, exact)) = &answer.pulse {
        let mut pulse = json!({"pulse": name});
        if let Some(exact) = exact {
            pulse["exact"] = json!(formula_text(exact));
        }
        if let Some(peak) = peak {
            pulse["cut_off"] = value_json(&peak.cut_off, digits);
            pulse["peak_velocity"] = value_json(&peak.value, digits);
        }
        if let Some((time, seen)) = &answer.seen {
            pulse["seen"] = json!({
                "time": time,
                "velocity": seen_number(seen.velocity),
                "height": seen_number(seen.height / seen.first_height),
                "points": seen.points,
                "rank": "tested",
            });
        }
        document["pulse"] = pulse;
    }
    document
}
