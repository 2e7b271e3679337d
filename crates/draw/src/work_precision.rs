//! Accuracy against speed: one line a method, one marker a setting.

use super::axis::Mapping;
use super::drawing::{Drawing, coloured, polyline};
use super::layout::{GUTTER, LEFT, Legend, RIGHT, Sheet, counted, fitted, label_size};
use super::number::rounded;
use super::placement::Placement;
use super::text::{csv_row, json_number};
use super::{Axis, Caption, Chart, PlotError, Scale, frontier};
use serde_json::{Value, json};

/// What one setting of a method costs and reaches.
#[derive(Clone, PartialEq, Debug)]
pub struct Point {
    /// The setting in few letters: `N = 10`.
    pub setting: String,
    /// The error measured, `max |computed − reference| / max |reference|`.
    pub error: f64,
    /// A proven bound of the same error, if there is one.
    pub bound: Option<f64>,
    /// Seconds for one point, once all is prepared.
    pub seconds: f64,
    /// Seconds for one point where the preparation is spread over the points, if that is to be shown.
    pub prepared: Option<f64>,
}

/// A method with what was measured at its settings, in their order.
#[derive(Clone, PartialEq, Debug)]
pub struct Method {
    pub name: String,
    /// The points, joined in this order.
    pub points: Vec<Point>,
}

/// A work–precision diagram: the error across, seconds a point up, both logarithmic.
///
/// Each method is a line with markers at its settings. A thin segment that ends in a small bar
/// leads from the error measured to its proven bound. A faint dotted line leads upwards to a ring at the
/// time with preparation. The grey steps are the [`frontier`] of times without it. Errors of exactly
/// zero stand at the left edge, with an arrow.
///
/// # Invariants
/// At least one point has a finite error and time. Errors and bounds are not negative, times are
/// above zero, where they are numbers; points that are not finite are left out and counted.
#[derive(Clone, PartialEq, Debug)]
pub struct WorkPrecision {
    title: String,
    methods: Vec<Method>,
    radius: Option<f64>,
    caption: Caption,
}

impl WorkPrecision {
    /// A diagram of these methods.
    /// Refused are negative errors and bounds, and times that are not above zero.
    pub fn new(title: &str, methods: Vec<Method>, caption: Caption) -> Result<Self, PlotError> {
        for (method, point) in pairs(&methods) {
            let what = |part: &str| format!("the {part} of {} ({})", method.name, point.setting);
            if point.error < 0.0 {
                return Err(PlotError::Negative { what: what("error"), value: point.error });
            }
            if let Some(value) = point.bound.filter(|bound| *bound < 0.0) {
                return Err(PlotError::Negative { what: what("bound"), value });
            }
            if let Some(value) =
                [Some(point.seconds), point.prepared].into_iter().flatten().find(|s| *s <= 0.0)
            {
                return Err(PlotError::NotPositive { what: what("time"), value });
            }
        }
        if !pairs(&methods).any(|(_, point)| finite(point)) {
            return Err(PlotError::Empty { title: title.to_owned() });
        }
        Ok(WorkPrecision { title: title.to_owned(), methods, radius: None, caption })
    }

    /// The same with the error of the reference itself, as a share of the largest value: left of it
    /// no error is resolved, and the picture says so.
    pub fn reference_radius(mut self, radius: f64) -> Result<Self, PlotError> {
        if !(radius > 0.0 && radius.is_finite()) {
            let what = "the radius of the reference".to_owned();
            return Err(PlotError::NotPositive { what, value: radius });
        }
        self.radius = Some(radius);
        Ok(self)
    }

    pub fn methods(&self) -> &[Method] {
        &self.methods
    }

    /// The points on the frontier with their methods, by increasing error.
    fn frontier(&self) -> Vec<(&Method, &Point)> {
        let all: Vec<_> = pairs(&self.methods).collect();
        let measured: Vec<_> = all.iter().map(|(_, p)| (p.error, p.seconds)).collect();
        frontier(&measured).into_iter().map(|i| all[i]).collect()
    }

    fn left_out(&self) -> usize {
        pairs(&self.methods).filter(|(_, point)| !finite(point)).count()
    }

    fn remarks(&self, unlabelled: usize) -> Vec<String> {
        let mut remarks = Vec::new();
        let infinite = |point: &Point| point.bound.is_some_and(|bound| !bound.is_finite());
        let unbounded = pairs(&self.methods).filter(|(_, p)| finite(p) && infinite(p)).count();
        for (count, one, many, why) in [
            (self.left_out(), "point", "points", "not finite and left out."),
            (unbounded, "bound", "bounds", "not finite and not drawn."),
            (unlabelled, "setting", "settings", "not labelled for want of room; the data name it."),
        ] {
            if count > 0 {
                let why = if count > 1 { why.replace("name it", "name them") } else { why.into() };
                remarks.push(format!("{} {why}", counted(count, one, many)));
            }
        }
        remarks
    }

    fn description(&self) -> String {
        let frontier: Vec<String> =
            self.frontier().iter().map(|(method, point)| named(method, point)).collect();
        format!(
            "Work-precision diagram of {} methods: error across, seconds a point up, both \
             logarithmic. On the frontier, from the most accurate to the fastest: {}.",
            self.methods.len(),
            frontier.join("; ")
        )
    }
}

fn pairs(methods: &[Method]) -> impl Iterator<Item = (&Method, &Point)> {
    methods.iter().flat_map(|method| method.points.iter().map(move |point| (method, point)))
}

fn finite(point: &Point) -> bool {
    point.error.is_finite() && point.seconds.is_finite()
}

/// The bound that can be drawn.
fn bound(point: &Point) -> Option<f64> {
    point.bound.filter(|bound| bound.is_finite())
}

/// The time with preparation that can be drawn, where it differs from the time of a point to the eye.
fn prepared(point: &Point) -> Option<f64> {
    point.prepared.filter(|prepared| prepared.is_finite() && *prepared > 1.1 * point.seconds)
}

/// The method, with its setting in brackets if it has one.
fn named(method: &Method, point: &Point) -> String {
    match point.setting.is_empty() {
        true => method.name.clone(),
        false => format!("{} ({})", method.name, point.setting),
    }
}

/// What pointing at a marker shows.
fn about(method: &Method, point: &Point) -> String {
    let bound = point.bound.map(|bound| format!(", proven below {}", rounded(bound)));
    let (name, bound) = (named(method, point), bound.unwrap_or_default());
    let prepared = point.prepared.filter(|prepared| *prepared > point.seconds);
    let prepared = prepared.map(|prepared| format!(", {} with preparation", rounded(prepared)));
    format!(
        "{name}: error {}{bound}, {} s a point{}",
        rounded(point.error),
        rounded(point.seconds),
        prepared.unwrap_or_default()
    )
}

/// The places of the data in pixels.
struct Places {
    x: Mapping,
    y: Mapping,
    /// Whether something is exactly zero.
    zero: bool,
}

impl Places {
    fn new(chart: &WorkPrecision, sheet: &Sheet) -> Places {
        let points: Vec<&Point> =
            pairs(&chart.methods).map(|(_, point)| point).filter(|point| finite(point)).collect();
        let errors = || points.iter().flat_map(|p| [Some(p.error), bound(p)]).flatten();
        let zero = errors().any(|error| error == 0.0);
        let least = errors().filter(|error| *error > 0.0).fold(f64::INFINITY, f64::min);
        // A reference far finer than every error would leave the picture mostly empty.
        let near = chart.radius.filter(|radius| *radius >= least / 1e3);
        let x = fitted(Scale::Logarithmic, errors().chain(near), (LEFT, RIGHT), zero);
        let seconds = points.iter().flat_map(|p| [Some(p.seconds), prepared(p)]).flatten();
        let y = fitted(Scale::Logarithmic, seconds, (sheet.bottom(), sheet.top), false);
        Places { x, y, zero }
    }

    fn across(&self, error: f64) -> f64 {
        if error == 0.0 { LEFT + GUTTER / 2.0 } else { self.x.position(error) }
    }

    fn of(&self, point: &Point) -> (f64, f64) {
        (self.across(point.error), self.y.position(point.seconds))
    }

    /// The corners of the steps of the frontier, from the upper edge to the right edge.
    fn steps(&self, frontier: &[(&Method, &Point)], top: f64) -> Vec<(f64, f64)> {
        let mut corners = Vec::new();
        let mut height = top;
        for (_, point) in frontier {
            let (x, y) = self.of(point);
            corners.extend([(x, height), (x, y)]);
            height = y;
        }
        corners.push((RIGHT, height));
        corners
    }
}

/// An arrow from a marker to the left.
const LEFTWARDS: &str = "M-6 0H-14M-10.5 -3.5L-14 0L-10.5 3.5";

/// The line of a method's points that are finite, in pixels.
fn trace(places: &Places, method: &Method) -> Vec<(f64, f64)> {
    method.points.iter().filter(|point| finite(point)).map(|point| places.of(point)).collect()
}

/// Half the width of a ring, and its outline.
const RING: f64 = 3.5;
const RING_OUTLINE: &str = "M-3.5 0a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0 -7 0z";

/// How preparations look: fainter than what is measured without them.
const PREPARED_STYLE: &str = "\
.plot .prepared{fill:none;stroke:currentColor;stroke-width:1;stroke-dasharray:1.5 2.5;opacity:.55}\
.plot .ring{fill:none;stroke:currentColor;stroke-width:1.2;opacity:.7}";

/// The way from the time of a point to its time with preparation.
fn draw_prepared(drawing: &mut Drawing, line: usize, point: &Point, places: &Places) {
    let Some(prepared) = prepared(point) else { return };
    let (x, y) = places.of(point);
    let top = places.y.position(prepared);
    if y - top > RING {
        drawing.line(&coloured("prepared", line), (x, y), (x, top + RING));
    }
    drawing.sign("ring", line, (x, top), RING_OUTLINE);
}

fn draw_region(sheet: &mut Sheet, places: &Places, radius: Option<f64>, legend: &mut Legend) {
    let Some(radius) = radius else { return };
    let text = format!("finer than the reference, whose radius is {}", rounded(radius));
    if places.x.contains(radius) {
        let (top, bottom) = (sheet.top, sheet.bottom());
        sheet.drawing.rectangle("region", (LEFT, top), (places.x.position(radius), bottom));
        legend.entry(text, |sample| sample.rectangle("region", (0.0, -6.0), (30.0, 6.0)));
    } else {
        let text = format!("the reference's radius, {}, lies left of the picture", rounded(radius));
        legend.entry(text, |sample| {
            sample.path("rule", "M28 0H4M9 -4L4 0L9 4");
        });
    }
}

/// The labels of the settings beside their markers; how many found no room.
fn draw_labels(chart: &WorkPrecision, sheet: &mut Sheet, places: &Places) -> usize {
    let area = [(LEFT + 2.0, sheet.top + 2.0), (RIGHT - 2.0, sheet.bottom() - 2.0)];
    let mut placement = Placement::within(area);
    placement.avoid(&places.steps(&chart.frontier(), sheet.top));
    if places.zero {
        let parting = LEFT + GUTTER;
        placement.avoid(&[(parting, sheet.top), (parting, sheet.bottom())]);
    }
    // Ends of lines first: with them a reader can count the settings between.
    let (mut ends, mut between) = (Vec::new(), Vec::new());
    for method in &chart.methods {
        let trace = trace(places, method);
        placement.avoid(&trace);
        for (x, y) in &trace {
            placement.take([(x - 5.5, y - 5.5), (x + 5.5, y + 5.5)]);
        }
        let drawn: Vec<&Point> = method.points.iter().filter(|point| finite(point)).collect();
        for (i, point) in drawn.iter().enumerate() {
            let (x, y) = places.of(point);
            if let Some(bound) = bound(point) {
                placement.avoid(&[(x, y), (places.across(bound), y)]);
            }
            if let Some(prepared) = prepared(point) {
                let top = places.y.position(prepared);
                placement.avoid(&[(x, y), (x, top)]);
                placement.take([(x - RING, top - RING), (x + RING, top + RING)]);
            }
            let end = i == 0 || i + 1 == drawn.len();
            if end { &mut ends } else { &mut between }.push(*point);
        }
    }
    let mut unlabelled = 0;
    let labelled = ends.into_iter().chain(between).filter(|point| !point.setting.is_empty());
    for point in labelled {
        let corner = placement.clear_beside(places.of(point), label_size(&point.setting));
        unlabelled += sheet.label(corner, &point.setting);
    }
    unlabelled
}

impl Chart for WorkPrecision {
    fn title(&self) -> &str {
        &self.title
    }

    fn svg_named(&self, name: &str) -> String {
        let mut sheet = Sheet::open(name, &self.title, 0.0);
        let places = Places::new(self, &sheet);
        let mut legend = Legend::default();
        for (i, method) in self.methods.iter().enumerate() {
            legend.line(&method.name, i);
        }
        let mut notes = Legend::default();
        draw_region(&mut sheet, &places, self.radius, &mut notes);
        sheet.grid(&places.x, &places.y);
        let steps = places.steps(&self.frontier(), sheet.top);
        sheet.drawing.path("frontier", &polyline(&steps));
        for (i, method) in self.methods.iter().enumerate() {
            sheet.drawing.stroke("line", i, &trace(&places, method));
        }
        for (i, method) in self.methods.iter().enumerate() {
            let finite = method.points.iter().filter(|point| finite(point));
            finite.for_each(|point| draw_prepared(&mut sheet.drawing, i, point, &places));
        }
        for (i, method) in self.methods.iter().enumerate() {
            let class = coloured("bound", i);
            for point in method.points.iter().filter(|point| finite(point)) {
                let (x, y) = places.of(point);
                if let Some(bound) = bound(point).filter(|bound| *bound != point.error) {
                    let end = places.across(bound);
                    sheet.drawing.line(&class, (x, y), (end, y));
                    sheet.drawing.line(&class, (end, y - 4.5), (end, y + 4.5));
                }
                if point.error == 0.0 {
                    sheet.drawing.sign("arrow", i, (x, y), LEFTWARDS);
                }
                sheet.drawing.marker(i, (x, y), &about(method, point));
            }
        }
        let unlabelled = draw_labels(self, &mut sheet, &places);
        if pairs(&self.methods).any(|(_, point)| finite(point) && prepared(point).is_some()) {
            sheet.drawing.style(PREPARED_STYLE);
            legend.entry("up to the time with preparation, spread over the points", |sample| {
                sample.line("prepared c3", (15.0, 8.0), (15.0, -4.0));
                sample.sign("ring", 3, (15.0, -8.0), RING_OUTLINE);
                sample.marker(3, (15.0, 8.0), "");
            });
        }
        let across = Axis::logarithmic("greatest error, relative to the largest value");
        sheet.axes((&across, &places.x), (&Axis::logarithmic("seconds a point"), &places.y));
        if pairs(&self.methods).any(|(_, point)| finite(point) && bound(point).is_some()) {
            legend.entry("from the error measured to its proven bound", |sample| {
                sample.path("rule", "M3 0H27M27 -4.5V4.5");
                sample.marker(3, (3.0, 0.0), "");
            });
        }
        legend.entry("frontier: the least time for at most this error", |sample| {
            sample.path("frontier", "M0 -6H12V5H30");
        });
        if places.zero {
            sheet.beyond(true, "0");
            legend.entry("exactly zero", |sample| {
                sample.sign("arrow", 3, (18.0, 0.0), LEFTWARDS);
                sample.marker(3, (18.0, 0.0), "");
            });
        }
        legend.append(notes);
        sheet.legend(&legend, sheet.top);
        sheet.close(&self.title, &self.description(), &self.caption, &self.remarks(unlabelled))
    }

    fn json(&self) -> Value {
        let point = |point: &Point| {
            json!({
                "setting": point.setting,
                "error": json_number(Some(point.error)),
                "bound": json_number(point.bound),
                "seconds": json_number(Some(point.seconds)),
                "seconds_with_preparation": json_number(point.prepared),
            })
        };
        let method = |method: &Method| {
            let points: Vec<Value> = method.points.iter().map(point).collect();
            json!({"name": method.name, "points": points})
        };
        let frontier: Vec<Value> = self
            .frontier()
            .iter()
            .map(|(method, point)| json!({"method": method.name, "setting": point.setting}))
            .collect();
        json!({
            "kind": "work-precision",
            "title": self.title,
            "caption": self.caption.json(),
            "reference_radius": self.radius,
            "methods": self.methods.iter().map(method).collect::<Vec<_>>(),
            "frontier": frontier,
            "left_out": self.left_out(),
        })
    }

    fn csv(&self) -> String {
        let mut csv = String::from("method,setting,error,bound,seconds,seconds with preparation\n");
        for (method, point) in pairs(&self.methods) {
            let Point { setting, error, bound, seconds, prepared } = point;
            let numbers = [Some(*error), *bound, Some(*seconds), *prepared];
            csv += &csv_row(&[&method.name, setting], numbers);
        }
        csv
    }
}
