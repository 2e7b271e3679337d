//! `advise`: the smallest answer that is enough for a tolerance, with its proven distance.

use super::arguments::{Advise, Format};
use super::enough;
use super::failure::Failure;
use super::input;
use super::json::SCHEMA_VERSION;
use super::output;
use super::progress;
use super::share::{at_most, percent_above, whole};
use super::table::Table;
use num_rational::BigRational;
use serde_json::{Value as Json, json};
use std::ffi::OsStr;
use std::path::Path;
use std::time::Duration;
use wavestep::ball::{Bound, Decimal, in_decimals};
use wavestep::language::Change;
use wavestep::problem::{Advice, Need, Problem, Tried, Verdict, Wanted, number};

/// Digits of the ends of a window that are only shown.
const DIGITS: usize = 3;

pub fn run(options: &Advise) -> Result<String, Failure> {
    let problem = input::problem(&options.scene)?;
    let tolerance = tolerance(&options.tol)?;
    if let Some(over) = &options.over {
        return enough::run(options, &problem, over, tolerance);
    }
    if let Some(symbol) = problem.symbols().first() {
        let message = format!("the symbol `{symbol}` has no value");
        let remedy = format!("set it: --set {symbol}=1; or map a range: --for {symbol}=1/2..2");
        return Err(Failure::usage(message, remedy));
    }
    if options.output.as_deref().is_some_and(is_picture) {
        let message = "only a map over a symbol is drawn; without --for, -o writes a scene";
        return Err(Failure::usage(
            message,
            "map a range: --for mu=1/2..2; or write -o reduced.wave",
        ));
    }
    let wanted = problem.wanted(quantity(options, &problem))?;
    let window = input::window(&problem, &options.from, options.to.as_deref())?;
    let need = Need { wanted: &wanted, window: window.each_ref(), tolerance };
    let advice = {
        let progress = progress::spinner("trying");
        problem.advise(&need, &|simpler| progress.set_message(format!("trying {simpler}")))?
    };
    let told = Told { options, problem: &problem, need: &need, advice: &advice };
    if let Some(path) = &options.output {
        output::write_whole(path, told.scene()?.as_bytes())?;
    }
    Ok(match options.format {
        Format::Json => format!("{}\n", told.json()),
        Format::Csv => Table::of(&told.json()).csv(),
        _ => told.text(),
    })
}

/// A share of the largest value.
fn tolerance(text: &str) -> Result<BigRational, Failure> {
    let remedy = "write a share of the largest value: --tol 1e-2";
    if text.trim_start().starts_with("abs:") {
        return Err(Failure::usage("this tolerance cannot be absolute", remedy));
    }
    let tolerance = number("--tol", text)?;
    match tolerance > BigRational::default() {
        true => Ok(tolerance),
        false => Err(Failure::usage("the tolerance is not positive", remedy)),
    }
}

fn is_picture(path: &Path) -> bool {
    ["svg", "pdf", "png"].map(OsStr::new).contains(&path.extension().unwrap_or_default())
}

/// Bounds in decimals that hold.
pub fn bounds([low, high]: &[BigRational; 2]) -> [String; 2] {
    [(low, Bound::Lower), (high, Bound::Upper)]
        .map(|(value, bound)| Decimal::bound(value, 9, bound).to_string())
}

/// What is asked for: the first observable where nothing is said.
pub fn quantity<'a>(options: &'a Advise, problem: &'a Problem) -> &'a str {
    let usual = || problem.usual_quantity().unwrap_or_default();
    options.quantity.as_deref().map_or_else(usual, str::trim)
}

struct Told<'a> {
    options: &'a Advise,
    problem: &'a Problem,
    need: &'a Need<'a>,
    advice: &'a Advice,
}

impl Told<'_> {
    /// How long a value took, where that is asked for.
    fn each(&self, time: Duration) -> String {
        match self.options.stats {
            true => format!(", {:.3} ms per value", time.as_secs_f64() * 1e3),
            false => String::new(),
        }
    }

    fn unit(&self) -> &str {
        if self.problem.has_units() { " s" } else { "" }
    }

    fn window(&self) -> String {
        let [from, to] = self.need.window.map(|time| match self.problem.has_units() {
            true if time.denom().bits() > 64 => {
                format!("{}{}", Decimal::from_rational(time, DIGITS).0, self.unit())
            }
            _ => self.problem.told_time(time),
        });
        format!("{from} <= t <= {to}")
    }

    fn verdict(&self, verdict: &Verdict) -> String {
        match verdict {
            Verdict::Enough([_, most]) => at_most(most, &self.need.tolerance),
            Verdict::Misses { by, at } => {
                let by = percent_above(by, &self.need.tolerance);
                format!("at least {by} at t = {}{}", in_decimals(at), self.unit())
            }
            Verdict::Unproven(why) => format!("not proven: {why}"),
            Verdict::Unsuited(why) => format!("not applicable: {why}"),
        }
    }

    fn text(&self) -> String {
        let Advice { tried, work, each: time, .. } = self.advice;
        let Wanted { name, .. } = self.need.wanted;
        let enough = self.advice.enough();
        let row = |own: &Tried| {
            let mark = if enough.is_some_and(|one| std::ptr::eq(one, own)) { "*" } else { " " };
            let work = match own.work.is_empty() {
                true => String::new(),
                false => format!("; {}{}", own.work, self.each(own.each)),
            };
            [format!("{mark} {}", own.simpler), self.verdict(&own.verdict) + &work]
        };
        let mut rows: Vec<[String; 2]> = tried.iter().map(row).collect();
        let mark = if enough.is_none() { "*" } else { " " };
        rows.push([format!("{mark} exact"), format!("0; {work}{}", self.each(*time))]);
        let width = rows.iter().map(|[what, _]| what.chars().count()).max().unwrap_or_default();
        let tolerance = whole(&self.need.tolerance);
        let mut text =
            format!("{name} to within {tolerance} of its largest value, {}\n\n", self.window());
        for [what, verdict] in &rows {
            text += &format!("{what:<width$}  {verdict}\n");
        }
        text.push('\n');
        text += &match enough {
            Some(own) => {
                format!("Enough: `{}`, proven error {}.\n", own.simpler, self.verdict(&own.verdict))
            }
            None => "No simpler model is proven to be enough.\n".to_owned(),
        };
        if let Some(next) = self.advice.next_cheaper() {
            let off = self.verdict(&next.verdict);
            text += &format!("Not enough: `{}`, off by {off}.\n", next.simpler);
        }
        text
    }

    fn json(&self) -> Json {
        let Advice { tried, work, each, largest } = self.advice;
        let [from, to] = self.need.window.map(ToString::to_string);
        let row = |own: &Tried| {
            let mut body = json!({
                "what": own.simpler.to_string(),
                "work": own.work,
                "seconds_a_value": own.each.as_secs_f64(),
            });
            let verdict: Json = match &own.verdict {
                Verdict::Enough(share) => json!({ "enough": bounds(share) }),
                Verdict::Misses { by, at } => {
                    json!({ "misses": Decimal::bound(by, 9, Bound::Lower).to_string(), "at": at.to_string() })
                }
                Verdict::Unproven(why) => json!({ "unproven": why }),
                Verdict::Unsuited(why) => json!({ "unsuited": why }),
            };
            body["verdict"] = verdict;
            body
        };
        json!({
            "schema_version": SCHEMA_VERSION,
            "title": self.problem.title(),
            "quantity": self.need.wanted.name,
            "set": self.options.scene.set,
            "from": from,
            "to": to,
            "tolerance": self.need.tolerance.to_string(),
            "largest": bounds(&largest.bounds),
            "tried": tried.iter().map(row).collect::<Vec<_>>(),
            "exact": { "work": work, "seconds_a_value": each.as_secs_f64() },
            "enough": self.advice.enough().map(|own| own.simpler.to_string()),
        })
    }

    /// The smallest scene that is enough, with a comment that says for what it holds.
    fn scene(&self) -> Result<String, Failure> {
        let (changes, proven): (&[Change], String) = match self.advice.scene() {
            Some((own, changes)) => {
                let verdict = self.verdict(&own.verdict);
                (changes, format!("# `{}`: proven error {verdict} of it.\n", own.simpler))
            }
            None => match self.advice.enough() {
                Some(own) => (
                    &[],
                    format!(
                        "# `{}` is enough but is not a scene; this is the full scene.\n",
                        own.simpler
                    ),
                ),
                None => (
                    &[],
                    "# No smaller scene is proven to be enough; this is the full scene.\n"
                        .to_owned(),
                ),
            },
        };
        let text = match changes {
            [] => self.problem.source().text().to_owned(),
            _ => self.problem.changed(changes)?.source().text().to_owned(),
        };
        let values =
            self.problem.values().iter().map(|(name, value)| format!(" --set {name}={value}"));
        let values: String = values.collect();
        let values = if values.is_empty() { values } else { format!(", with{values}") };
        let comment = format!(
            "# \"{}\" simplified, for {} to within {} of its largest value,\n# {}{values}.\n{proven}",
            self.problem.title(),
            self.need.wanted.name,
            whole(&self.need.tolerance),
            self.window(),
        );
        // Lines end as those of the scene do.
        let end = if text.contains("\r\n") { "\r\n" } else { "\n" };
        Ok(comment.replace('\n', end) + &text)
    }
}
