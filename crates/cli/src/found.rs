//! Roots and extrema as text, as JSON, and as columns.

use super::arguments::{Find, Format};
use super::json::SCHEMA_VERSION;
use super::output::plural;
use super::rows::{ALL_DIGITS, with_units};
use super::table;
use num_rational::BigRational;
use serde_json::{Value as Json, json};
use wavestep::ball::{Ball, Bound, Decimal, Number};
use wavestep::problem::{Problem, Size, Wanted};
use wavestep::signal::{Extremum, Goal, Place, Root, Roots, Value};
use wavestep_studies::told::Teller;

/// Digits of bounds and of roots that stay undecided.
const BOUND_DIGITS: usize = 20;

pub struct Told<'a> {
    pub options: &'a Find,
    pub name: &'a str,
    /// The level, as it was written.
    pub level: &'a str,
    pub problem: &'a Problem,
    pub wanted: &'a Wanted,
    pub window: &'a [BigRational; 2],
}

impl Told<'_> {
    fn second(&self) -> &str {
        if self.problem.has_units() { " s" } else { "" }
    }

    fn teller(&self) -> Teller<'_> {
        Teller { problem: self.problem, digits: self.options.digits, longest_fraction: usize::MAX }
    }

    fn time(&self, time: &Value) -> String {
        self.teller().time(time)
    }

    fn window(&self) -> String {
        let [from, to] = self.window.each_ref().map(|time| Value::Exact(time.clone()));
        format!("{} <= t <= {}", self.time(&from), self.time(&to))
    }

    fn value(&self, value: &Value) -> String {
        let unit = self.wanted.unit();
        let space = if unit.is_empty() { "" } else { " " };
        format!("{}{space}{unit}", value.to_text(self.options.digits))
    }
}

pub fn roots(roots: &Roots, told: &Told<'_>) -> String {
    let rows: Vec<Json> = roots.all.iter().map(root_json).collect();
    match told.options.format {
        Format::Json => document(told, json!({ "level": told.level, "roots": rows })),
        Format::Csv => columns(&rows, None),
        _ => {
            roots.all.iter().map(|root| root_line(root, told)).collect::<String>()
                + &summary(roots, told)
        }
    }
}

pub fn extremum(extremum: &Extremum, goal: Goal, told: &Told<'_>) -> String {
    let rows: Vec<Json> = extremum.places.iter().map(place_json).collect();
    let which = if goal == Goal::Largest { "largest" } else { "smallest" };
    match told.options.format {
        Format::Json => {
            let value = number(&extremum.value);
            document(told, json!({ "goal": which, "value": value, "places": rows }))
        }
        Format::Csv => columns(&rows, Some((&number(&extremum.value), told))),
        _ => extremum_text(extremum, which, told),
    }
}

/// At how many places a distance is told in text.
const MOST_PLACES: usize = 4;

/// Of each quantity how far it is from another answer, how large it is, and where they are farthest apart.
pub fn distances(
    rows: &[(Wanted, Size, Size)],
    problem: &Problem,
    window: &[BigRational; 2],
    options: &Find,
) -> (String, usize) {
    let minus = options.minus.as_deref().unwrap_or_default();
    let bounded = |[low, high]: &[BigRational; 2]| match low == high {
        true => Value::Exact(low.clone()),
        false => Value::of(&Number::Enclosed(enclosed(low, high)), options.digits),
    };
    let share = |distance: &Size, size: &Size| distance.over(size).as_ref().map(bounded);
    let little = BigRational::new(1.into(), 1_000_000_000_000_000_u64.into());
    let is_nothing = |distance: &Size, size: &Size| {
        distance.places.is_empty() && distance.over(size).is_some_and(|share| share[1] < little)
    };
    let is_open = |(_, distance, size): &&(Wanted, Size, Size)| {
        !is_nothing(distance, size) && matches!(bounded(&distance.bounds), Value::Enclosed(_))
    };
    let undecided = rows.iter().filter(is_open).count();
    if options.format == Format::Text {
        let row = |(wanted, distance, size): &(Wanted, Size, Size)| {
            let told = Told { options, name: minus, level: "", problem, wanted, window };
            if is_nothing(distance, size) {
                return format!(
                    "{}: largest difference from {minus} < 1e-15 of the largest value\n",
                    wanted.name
                );
            }
            let share = share(distance, size).map_or(String::new(), |share| {
                format!(", {} of the largest value", share.to_text(options.digits))
            });
            let (name, value) = (&wanted.name, told.value(&bounded(&distance.bounds)));
            let lines = distance.places.iter().map(|place| told.teller().place(place) + "\n");
            let mut places: String = lines.take(MOST_PLACES).collect();
            if let more @ 1.. = distance.places.len().saturating_sub(MOST_PLACES) {
                places += &format!("and at {more} more (`--format json` has all)\n");
            }
            format!("{name}: largest difference from {minus} = {value}{share}\n{places}")
        };
        return (rows.iter().map(row).collect(), undecided);
    }
    let rows = rows.iter().map(|(wanted, distance, size)| {
        let mut body = json!({
            "quantity": wanted.name,
            "distance": number(&bounded(&distance.bounds)),
            "largest": number(&bounded(&size.bounds)),
            "relative": share(distance, size).as_ref().map(number),
            "places": distance.places.iter().map(place_json).collect::<Vec<_>>(),
        });
        if problem.has_units() {
            body["unit"] = json!(wanted.unit());
        }
        body
    });
    let rows: Vec<Json> = rows.collect();
    if options.format == Format::Csv {
        let line = |row: &Json| {
            let [distance, largest, relative] = ["distance", "largest", "relative"]
                .map(|key| table::number(&row[key]).unwrap_or_default());
            let name = row["quantity"].as_str().unwrap_or_default();
            let radius = row["distance"]["radius"].as_str().unwrap_or("0");
            format!("{name},{distance},{radius},{largest},{relative}\n")
        };
        let lines = rows.iter().map(line).collect::<String>();
        return ("quantity,distance,radius,largest,relative\n".to_owned() + &lines, undecided);
    }
    let [from, to] = window.each_ref().map(BigRational::to_string);
    let document = json!({
        "schema_version": SCHEMA_VERSION, "title": problem.title(), "minus": minus,
        "set": options.scene.set, "from": from, "to": to, "distances": rows,
    });
    (format!("{document}\n"), undecided)
}

fn enclosed(from: &BigRational, to: &BigRational) -> Ball {
    let sum = from + to;
    Ball::between(from, to, 64 + sum.numer().bits() + sum.denom().bits())
}

fn root_line(root: &Root, told: &Told<'_>) -> String {
    let (name, level) = (told.name, told.level);
    let at = |time: &Value| format!("{name} = {level} at t = {}", told.time(time));
    let line = match root {
        Root::Simple { time, rises } => {
            format!("{} (simple, {})", at(time), if *rises { "rising" } else { "falling" })
        }
        Root::Double { time } => format!("{} (double)", at(time)),
        Root::End { time } => format!("{} (exactly, at an end of the window)", at(time)),
        Root::Arrival { time, before, after } => {
            let limits = match (before, after) {
                (true, true) => "both limits",
                (true, false) => "left limit only",
                _ => "right limit only",
            };
            format!("{} (exactly, at an arrival, {limits})", at(time))
        }
        Root::Jump { time, limits: [before, after] } => {
            let (before, after) = (told.value(before), told.value(after));
            let time = told.time(time);
            format!("{name} jumps over {level} at t = {time} (from {before} to {after}; no root)")
        }
        Root::Interval { from, to, closed } => {
            let relation = if *closed { "<=" } else { "<" };
            let (from, to) = (told.time(from), told.time(to));
            format!("{name} = {level} for {from} <= t {relation} {to} (identically)")
        }
        Root::Undecided { from, to, range, crosses } => {
            let time = enclosed(from, to).to_decimal(BOUND_DIGITS);
            let sure = if *crosses { "at least one root" } else { "undecided" };
            let range = range.to_decimal(3);
            let second = told.second();
            format!("{name} = {level} at t = {time}{second}? ({sure}; the difference is {range})")
        }
    };
    line + "\n"
}

fn summary(roots: &Roots, told: &Told<'_>) -> String {
    let count = |wanted: fn(&Root) -> bool| roots.all.iter().filter(|root| wanted(root)).count();
    let jumps = count(|root| matches!(root, Root::Jump { .. }));
    let intervals = count(|root| matches!(root, Root::Interval { .. }));
    let undecided = roots.undecided();
    let single = roots.all.len() - jumps - intervals - undecided;
    let mut parts = vec![plural(single, "root")];
    if intervals > 0 {
        parts.push(format!("{} of roots", plural(intervals, "interval")));
    }
    if jumps > 0 {
        parts.push(plural(jumps, "jump"));
    }
    let known = parts.join(", ");
    format!("{known}, {undecided} undecided; no others in {}\n", told.window())
}

fn extremum_text(extremum: &Extremum, which: &str, told: &Told<'_>) -> String {
    let (name, value, window) = (told.name, told.value(&extremum.value), told.window());
    let mut text = format!("{which} {name} = {value} in {window}\n");
    text.extend(extremum.places.iter().map(|place| told.teller().place(place) + "\n"));
    if extremum.places.len() > 1 {
        text += match &extremum.value {
            Value::Exact(_) => "tied: the value is the same at all of them\n",
            _ => "tied: these places cannot be told apart\n",
        };
    }
    text
}

/// A number with all that is proven of it.
pub fn number(number: &Value) -> Json {
    let with_ball = |ball: &Ball| {
        let enclosure = ball.to_decimal(ALL_DIGITS);
        let radius = format!("{:e}", enclosure.radius());
        json!({ "midpoint": enclosure.midpoint().to_string(), "radius": radius })
    };
    match number {
        Value::Exact(value) => json!({ "exact": value.to_string() }),
        Value::Certified { decimal, ball } => {
            let mut body = with_ball(ball);
            body["decimal"] = json!(decimal.to_string());
            body
        }
        Value::Enclosed(ball) => with_ball(ball),
    }
}

fn root_json(root: &Root) -> Json {
    match root {
        Root::Simple { time, rises } => {
            json!({ "kind": "simple", "time": number(time), "rises": rises })
        }
        Root::Double { time } => json!({ "kind": "double", "time": number(time) }),
        Root::End { time } => json!({ "kind": "end", "time": number(time) }),
        Root::Arrival { time, before, after } => {
            json!({ "kind": "arrival", "time": number(time), "before": before, "after": after })
        }
        Root::Jump { time, limits: [before, after] } => {
            let limits = [number(before), number(after)];
            json!({ "kind": "jump", "time": number(time), "limits": limits })
        }
        Root::Interval { from, to, closed } => {
            json!({ "kind": "interval", "from": number(from), "to": number(to), "closed": closed })
        }
        Root::Undecided { from, to, range, crosses } => json!({
            "kind": "undecided",
            "time": number(&Value::Enclosed(enclosed(from, to))),
            "difference": number(&Value::Enclosed(range.clone())),
            "crosses": crosses,
        }),
    }
}

fn place_json(place: &Place) -> Json {
    let mut body = match place {
        Place::Critical(time) => json!({ "kind": "critical", "time": number(time) }),
        Place::End(time) => json!({ "kind": "end", "time": number(time) }),
        Place::Arrival { time, before, after } => {
            json!({ "kind": "arrival", "time": number(time), "before": before, "after": after })
        }
        Place::Plateau { from, to, closed } => {
            json!({ "kind": "plateau", "from": number(from), "to": number(to), "closed": closed })
        }
        Place::Undecided { from, to } => {
            let bound = |time, side| {
                number(&Value::Exact(Decimal::bound(time, BOUND_DIGITS, side).to_rational()))
            };
            let [from, to] = [bound(from, Bound::Lower), bound(to, Bound::Upper)];
            json!({ "kind": "undecided", "from": from, "to": to })
        }
    };
    body["attained"] = json!(place.is_attained());
    body
}

/// What all documents begin with.
fn document(told: &Told<'_>, body: Json) -> String {
    let [from, to] = told.window.each_ref().map(BigRational::to_string);
    let mut document = json!({
        "schema_version": SCHEMA_VERSION,
        "title": told.problem.title(),
        "quantity": told.name,
        "set": told.options.scene.set,
        "digits": told.options.digits,
        "from": from,
        "to": to,
    });
    let Json::Object(body) = body else { unreachable!("bodies are objects") };
    document.as_object_mut().expect("an object").extend(body);
    format!("{}\n", with_units(document, told.problem, told.wanted))
}

/// A heading, then a line of columns each: the time, or the first and last one of an interval, as a fraction
/// where it is exact; else the decimal, or where its digits are not decided a midpoint and a radius. Of an extremum the same for
/// its value follows, with its unit.
fn columns(rows: &[Json], value: Option<(&Json, &Told<'_>)>) -> String {
    let text = |value: &Json| value.as_str().unwrap_or_default().to_owned();
    let written = |time: &Json| table::number(time).unwrap_or_default().to_owned();
    // A decimal is rounded; the radius is that of the enclosure from which it is.
    let radius_of = |number: &Json| match number["decimal"].is_null() {
        true => text(&number["radius"]),
        false => String::new(),
    };
    let (mut heading, mut last) = (String::new(), String::new());
    if let Some((value, told)) = value {
        heading += ",value,value_radius";
        last = format!(",{},{}", written(value), radius_of(value));
        if told.problem.has_units() {
            heading += ",unit";
            last += &format!(",{}", told.wanted.unit());
        }
    }
    let line = |body: &Json| {
        let time = if body["time"].is_null() { &body["from"] } else { &body["time"] };
        let (kind, first, until) = (text(&body["kind"]), written(time), written(&body["to"]));
        let (radius, exact) = (radius_of(time), !time["exact"].is_null());
        format!("{kind},{first},{until},{radius},{exact}{last}\n")
    };
    format!("kind,time,until,radius,exact{heading}\n") + &rows.iter().map(line).collect::<String>()
}
