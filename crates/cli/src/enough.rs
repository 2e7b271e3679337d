//! `advise --for`: which simpler answer is enough where, as a table of proven differences, and as a map.

use super::advise::{bounds, quantity};
use super::arguments::{Advise, Format};
use super::command_line::CommandLine;
use super::failure::Failure;
use super::input;
use super::json::SCHEMA_VERSION;
use super::picture;
use super::progress;
use super::share::{percent, whole};
use super::table::Table;
use num_rational::BigRational;
use num_traits::ToPrimitive as _;
use serde_json::{Value as Json, json};
use wavestep::ball::{Bound, in_decimals};
use wavestep::problem::{Column, EnoughMap, MapRequest, Problem, Run, SymbolRange, Unproven};
use wavestep_draw::{Axis, Caption, Chart, Curve, Curves};

/// Shares below this one are drawn at the lower edge.
const NOTHING: f64 = 1e-12;

/// The width of a PNG in pixels.
const WIDTH: u32 = 900;

/// Shares above this one are drawn at the upper edge.
const ALL: f64 = 1.0;

pub fn run(
    options: &Advise,
    problem: &Problem,
    over: &str,
    tolerance: BigRational,
) -> Result<String, Failure> {
    let range: SymbolRange = over.parse()?;
    let simpler: Result<Vec<_>, _> = options.models.iter().map(|own| own.parse()).collect();
    let window = |problem: &Problem| input::window(problem, &options.from, options.to.as_deref());
    let asked = MapRequest {
        range: &range,
        points: options.points.into(),
        quantity: quantity(options, problem),
        simpler: simpler.map_err(wavestep::problem::ProblemError::from)?,
        tolerance,
        window: &window,
        has_usual_end: options.to.is_none(),
    };
    let told = || -> Result<Told<'_>, Failure> {
        let progress = progress::spinner("trying");
        let symbol = &range.symbol;
        let map = problem.map_enough(&asked, &|value| {
            progress.set_message(format!("trying at {symbol} = {}", in_decimals(value)));
        })?;
        Ok(Told { options, problem, asked: &asked, map })
    };
    let Some(file) = &options.output else { return Ok(told()?.written()) };
    let mut text = String::new();
    let drawn = picture::draw(&file.to_string_lossy(), WIDTH, || {
        let told = told()?;
        text = told.written();
        told.chart()
    })?;
    Ok(match options.format {
        Format::Text => text + "\n" + &drawn,
        _ => text,
    })
}

struct Told<'a> {
    options: &'a Advise,
    problem: &'a Problem,
    asked: &'a MapRequest<'a>,
    map: EnoughMap,
}

impl Told<'_> {
    fn window(&self) -> String {
        match self.options.to.as_deref() {
            Some(to) => format!("{} <= t <= {to}", self.options.from),
            None => "in the default window of each".to_owned(),
        }
    }

    fn written(&self) -> String {
        match self.options.format {
            Format::Json => format!("{}\n", self.json()),
            Format::Csv => Table::of(&self.json()).csv(),
            _ => self.text(),
        }
    }

    fn json(&self) -> Json {
        let number = |value: &BigRational| json!({ "exact": value.to_string() });
        let tried = |off: &[Option<[BigRational; 2]>]| -> Vec<Json> {
            let both = self.map.simpler.iter().zip(off);
            let known = both.filter_map(|(simpler, off)| Some((simpler, off.as_ref()?)));
            known
                .map(|(simpler, off)| json!({ "what": simpler.to_string(), "off": bounds(off) }))
                .collect()
        };
        let value = |own: &Column| json!({ "value": number(&own.value), "tried": tried(&own.off) });
        let open = |(place, unproven): &(usize, Unproven)| {
            let (why, untried_from) = match unproven {
                Unproven::Refused(why) => (why.as_str(), None),
                Unproven::Undecided { untried_from, .. } => ("undecided", untried_from.as_ref()),
            };
            let parts = unproven.parts().iter().map(|ends| ends.each_ref().map(number));
            json!({
                "what": self.name(*place),
                "why": why,
                "undecided": parts.collect::<Vec<_>>(),
                "untried_from": untried_from.map(number),
            })
        };
        let unsuited =
            |(place, why): &(usize, String)| json!({ "what": self.name(*place), "why": why });
        let range = |(run, all): (&Run<Option<usize>>, &Vec<(usize, Unproven)>)| {
            json!({
                "from": number(&run.between[0]),
                "to": number(&run.between[1]),
                "enough": run.state.map(|place| self.name(place)),
                "proven": all.is_empty(),
                "open": all.iter().map(open).collect::<Vec<_>>(),
            })
        };
        let Advise { scene, from, to, .. } = self.options;
        json!({
            "schema_version": SCHEMA_VERSION,
            "title": self.problem.title(),
            "quantity": self.asked.quantity,
            "set": scene.set,
            "symbol": self.asked.range.symbol,
            "from": from,
            "to": to,
            "tolerance": self.asked.tolerance.to_string(),
            "values": self.map.columns.iter().map(value).collect::<Vec<_>>(),
            "unsuited": self.map.unsuited.iter().map(unsuited).collect::<Vec<_>>(),
            "ranges": self.map.runs.iter().zip(&self.map.open).map(range).collect::<Vec<_>>(),
        })
    }

    fn text(&self) -> String {
        let useful = self.map.useful();
        let symbol = &self.asked.range.symbol;
        let mut rows = vec![vec![symbol.clone()]];
        rows[0].extend(useful.iter().map(|place| self.map.simpler[*place].to_string()));
        for Column { value, off } in &self.map.columns {
            let told = |place: &usize| match &off[*place] {
                Some([_, most]) => percent(most, Bound::Upper).unwrap_or("< 1e-13 %".to_owned()),
                None => "-".to_owned(),
            };
            rows.push([in_decimals(value)].into_iter().chain(useful.iter().map(told)).collect());
        }
        let widths: Vec<usize> = (0..rows[0].len())
            .map(|i| rows.iter().map(|row| row[i].chars().count()).max().unwrap_or_default())
            .collect();
        let mut text = format!(
            "{}, largest error relative to its largest value, {}, proven at these values:\n\n",
            self.asked.quantity,
            self.window()
        );
        for row in rows {
            let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}"));
            text += cells.collect::<Vec<_>>().join("  ").trim_end();
            text.push('\n');
        }
        // Of the usual models many do not suit; of those that were named a reader expects to hear.
        for (place, why) in self.map.unsuited.iter().filter(|_| !self.options.models.is_empty()) {
            text += &format!("\n{}: not applicable: {why}\n", self.name(*place));
        }
        text += &format!("\nThe simplest model within {}:\n\n", whole(&self.asked.tolerance));
        for (Run { between: [from, to], state: first }, open) in
            self.map.runs.iter().zip(&self.map.open)
        {
            let what = first.map_or_else(|| "exact".to_owned(), |place| self.name(place));
            let how = match (open.is_empty(), from == to) {
                (true, true) => "proven",
                (true, false) => "proven for the whole range",
                (false, true) => "enough; whether it is the simplest is open",
                (false, false) => "proven at both ends; in between:",
            };
            let range = match from == to {
                true => format!("{symbol} = {}", in_decimals(from)),
                false => format!("{} <= {symbol} <= {}", in_decimals(from), in_decimals(to)),
            };
            text += &format!("{range}  {what}, {how}\n");
            // Neighbours that are open for the same reason share a line.
            for alike in open.chunk_by(|(_, one), (_, other)| one == other) {
                let names = alike.iter().map(|(place, _)| self.name(*place));
                let names = names.collect::<Vec<String>>().join(", ");
                text += &format!("  {names}: {}\n", reason(&alike[0].1));
            }
        }
        text
    }

    fn name(&self, place: usize) -> String {
        self.map.simpler[place].to_string()
    }

    /// Marks on the line of the tolerance, where another answer is the first that is enough.
    fn borders(&self, tolerance: f64) -> Option<Curve> {
        let border = |pair: &[Run<Option<usize>>]| {
            let ends = [&pair[0].between[1], &pair[1].between[0]];
            let [low, high] = ends.map(|end| end.to_f64().unwrap_or(f64::NAN));
            [((low * high).sqrt(), tolerance), (f64::NAN, f64::NAN)]
        };
        let points: Vec<_> = self.map.runs.windows(2).flat_map(border).collect();
        let name = format!("boundaries at {}", whole(&self.asked.tolerance));
        (!points.is_empty()).then_some(Curve { name, points })
    }

    fn chart(&self) -> Result<Box<dyn Chart>, Failure> {
        let symbol = &self.asked.range.symbol;
        let curve = |place: usize| {
            let point = |Column { value, off }: &Column| {
                let off = off[place].as_ref().and_then(|[_, most]| most.to_f64());
                (value.to_f64().unwrap_or(f64::NAN), off.unwrap_or(f64::NAN))
            };
            Curve {
                name: self.map.simpler[place].to_string(),
                points: self.map.columns.iter().map(point).collect(),
            }
        };
        let Advise { scene, to, from, over, points, models, tol, .. } = self.options;
        let command = CommandLine::new("advise", scene)
            .option("--quantity", self.asked.quantity)
            .option("--tol", tol)
            .option("--from", from)
            .given("--to", to.as_ref())
            .given("--for", over.as_ref());
        let command = match models.split_first() {
            Some((first, rest)) => rest
                .iter()
                .fold(command.option("--models", first), |command, model| command.word(model)),
            None => command,
        };
        let caption = Caption {
            norm:
                "the largest difference in the window over the largest value, proven at the marks"
                    .to_owned(),
            remarks: vec![
                "A model is enough above its line: proven at the marks, interpolated between. Each region has the colour of \
                 the simplest model that is enough there."
                    .to_owned(),
            ],
            command: command.option("--points", &points.to_string()).into_text(),
            ..Caption::default()
        };
        let tolerance = self.asked.tolerance.to_f64().unwrap_or(f64::NAN);
        let chart = Curves::new(
            &format!("What is enough for {}", self.asked.quantity),
            Axis::logarithmic(symbol),
            Axis::logarithmic("tolerance, relative to the largest value"),
            self.map.useful().into_iter().map(curve).chain(self.borders(tolerance)).collect(),
            caption,
        )?;
        let chart =
            chart.level(tolerance, &whole(&self.asked.tolerance))?.ceiling(ALL)?.floor(NOTHING)?;
        Ok(Box::new(chart.borders()))
    }
}

/// Why something is open.
fn reason(unproven: &Unproven) -> String {
    let (parts, untried_from) = match unproven {
        Unproven::Refused(why) => return format!("not proven: {why}"),
        Unproven::Undecided { parts, untried_from } => (parts, untried_from),
    };
    let part = |ends: &[BigRational; 2]| {
        let [from, to] = ends.each_ref().map(in_decimals);
        format!("from {from} to {to}")
    };
    let parts = parts.iter().map(part).collect::<Vec<String>>().join(", ");
    match untried_from {
        Some(value) => {
            format!("undecided {parts}; not tried above {}; proven elsewhere", in_decimals(value))
        }
        None => format!("undecided {parts}; proven elsewhere"),
    }
}
