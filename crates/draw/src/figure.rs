//! Figures of series: quantities against time or along a line, in panels over one axis.

use super::axis::Mapping;
use super::drawing::{Anchor, Drawing, SMALL};
use super::ends::{draw_ends, room_beside};
use super::layout::{LEFT, Legend, Sheet, counted, fitted, label_size};
use super::marks::{draw_levels, draw_marks, placement_in, room_above};
use super::palette::COLOURS;
use super::text::{csv_field, csv_number, json_number};
use super::{Axis, Caption, Chart, PlotError};
use serde_json::{Value, json};

/// Classes of figures.
const RULES: &str = "\
.plot .jump{fill:none;stroke:currentColor;stroke-width:.9;stroke-dasharray:1.5 2.5}\
.plot .zero{fill:none;stroke:#8a8a8a;stroke-width:.8}\
.plot .thin{fill:none;stroke:currentColor;stroke-width:.9;stroke-linejoin:round}";

/// How a series is drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Look {
    /// A line through the points.
    Line,
    /// A marker at each point.
    Points,
    /// Both.
    Both,
    /// A thin line through the points, for what others are compared with.
    Thin,
}

/// Points `(x, y)` in their order, with the places where the quantity jumps.
#[derive(Clone, PartialEq, Debug)]
pub struct Series {
    /// The name, as the legend gives it; without one it has no entry there.
    pub name: String,
    /// The points; one that is not finite interrupts the line.
    pub points: Vec<(f64, f64)>,
    /// Jumps: where, from which value, and to which.
    pub jumps: Vec<(f64, f64, f64)>,
    /// How it is drawn.
    pub look: Look,
    /// Which of the styles (colour, dashes and marker) it has; that of its place where none is given.
    pub style: Option<usize>,
}

impl Series {
    /// A line through these points.
    pub fn new(name: &str, points: Vec<(f64, f64)>) -> Series {
        let name = name.to_owned();
        Series { name, points, jumps: Vec::new(), look: Look::Line, style: None }
    }

    /// The same with these jumps.
    #[must_use]
    pub fn jumping(self, jumps: Vec<(f64, f64, f64)>) -> Series {
        Series { jumps, ..self }
    }

    /// The same, drawn in this way.
    #[must_use]
    pub fn look(self, look: Look) -> Series {
        Series { look, ..self }
    }

    /// The same in a style of its own.
    #[must_use]
    pub fn styled(self, style: usize) -> Series {
        Series { style: Some(style), ..self }
    }
}

/// Series over one upward axis.
#[derive(Clone, PartialEq, Debug)]
pub struct Panel {
    y: Axis,
    series: Vec<Series>,
    levels: Vec<(f64, String)>,
    notes: Vec<((f64, f64), String)>,
    /// From where to where the axis reaches at least.
    range: Option<(f64, f64)>,
    /// Whether names stand where lines end, and not in a legend.
    named_at_ends: bool,
}

impl Panel {
    /// These series.
    pub fn new(y: Axis, series: Vec<Series>) -> Panel {
        let (levels, notes) = (Vec::new(), Vec::new());
        Panel { y, series, levels, notes, range: None, named_at_ends: false }
    }

    /// The same with an axis that reaches from one value to another at least, so that panels can be
    /// compared.
    #[must_use]
    pub fn reaching(self, low: f64, high: f64) -> Panel {
        Panel { range: Some((low, high)), ..self }
    }

    /// The same with the names of its series where they end, and not in a legend.
    #[must_use]
    pub fn named_at_ends(self) -> Panel {
        Panel { named_at_ends: true, ..self }
    }

    /// The same with a labelled horizontal line.
    #[must_use]
    pub fn level(mut self, y: f64, name: &str) -> Panel {
        self.levels.push((y, name.to_owned()));
        self
    }

    /// The same with a text beside a point.
    #[must_use]
    pub fn note(mut self, at: (f64, f64), text: &str) -> Panel {
        self.notes.push((at, text.to_owned()));
        self
    }

    /// What is measured upwards.
    pub fn axis(&self) -> &Axis {
        &self.y
    }

    /// The series.
    pub fn series(&self) -> &[Series] {
        &self.series
    }

    /// What a series is called in data: a nameless one as the axis.
    fn name_of<'a>(&'a self, series: &'a Series) -> &'a str {
        if series.name.is_empty() { &self.y.name } else { &series.name }
    }

    /// All values upwards that are finite.
    fn heights(&self) -> impl Iterator<Item = f64> + '_ {
        let points = self.series.iter().flat_map(|series| &series.points);
        let points = points.filter(finite).map(|point| point.1);
        let range = self.range.into_iter().flat_map(|(low, high)| [low, high]);
        points.chain(self.levels.iter().map(|level| level.0)).chain(range)
    }

    /// What stands beside the plotting area.
    fn legend(&self) -> Legend {
        let mut legend = Legend::default();
        for (i, series) in self.series.iter().enumerate() {
            if !series.name.is_empty() && !self.named_at_ends {
                let style = series.style.unwrap_or(i);
                legend.entry(series.name.clone(), |sample| sample_of(sample, series.look, style));
            }
        }
        legend
    }
}

/// Panels under one another over one axis, with marked places if wanted.
///
/// Lines differ in colour and in dashes, so that they can be told apart in print without colour; jumps
/// are thin and dotted.
///
/// # Invariants
/// There is a panel, and a finite point; all that is finite has a place on its axis.
#[derive(Clone, PartialEq, Debug)]
pub struct Figure {
    title: String,
    x: Axis,
    panels: Vec<Panel>,
    marks: Vec<(f64, String)>,
    window: Option<(f64, f64)>,
    caption: Caption,
}

impl Figure {
    /// A figure of these panels; the title may be empty.
    ///
    /// # Errors
    /// A value that has no place on its axis, or nothing finite to draw.
    pub fn new(
        title: &str,
        x: Axis,
        panels: Vec<Panel>,
        caption: Caption,
    ) -> Result<Figure, PlotError> {
        let mut anything = false;
        for panel in &panels {
            let points = panel.series.iter().flat_map(|series| &series.points);
            for point in points.filter(finite) {
                x.check(point.0)?;
                panel.y.check(point.1)?;
                anything = true;
            }
            for (level, _) in &panel.levels {
                placed(&panel.y, *level)?;
            }
            for end in panel.range.iter().flat_map(|(low, high)| [low, high]) {
                placed(&panel.y, *end)?;
            }
            for ((across, up), _) in &panel.notes {
                placed(&x, *across)?;
                placed(&panel.y, *up)?;
            }
            for (at, from, to) in panel.series.iter().flat_map(|series| &series.jumps) {
                placed(&x, *at)?;
                placed(&panel.y, *from)?;
                placed(&panel.y, *to)?;
            }
        }
        if !anything {
            return Err(PlotError::Empty { title: title.to_owned() });
        }
        let (title, marks) = (title.to_owned(), Vec::new());
        Ok(Figure { title, x, panels, marks, window: None, caption })
    }

    /// The same from edge to edge between two places across; what lies outside is not to be given.
    ///
    /// # Errors
    /// Places that do not ascend, or without a place on the axis.
    pub fn window(mut self, from: f64, to: f64) -> Result<Figure, PlotError> {
        placed(&self.x, from)?;
        placed(&self.x, to)?;
        if from >= to {
            return Err(PlotError::NotAscending { axis: self.x.name.clone() });
        }
        self.window = Some((from, to));
        Ok(self)
    }

    /// The same with a vertical line through all panels, labelled above them.
    ///
    /// # Errors
    /// A place that the axis does not have.
    pub fn mark(mut self, x: f64, name: &str) -> Result<Figure, PlotError> {
        placed(&self.x, x)?;
        self.marks.push((x, name.to_owned()));
        Ok(self)
    }

    /// The same with another name and unit of what is measured across; the scale stays.
    #[must_use]
    pub fn across(self, axis: Axis) -> Figure {
        Figure { x: Axis { scale: self.x.scale, ..axis }, ..self }
    }

    /// The same with another title; it may be empty.
    #[must_use]
    pub fn titled(self, title: &str) -> Figure {
        Figure { title: title.to_owned(), ..self }
    }

    /// From where to where it reaches across: its window, or its points.
    pub fn extent(&self) -> (f64, f64) {
        let points = self.panels.iter().flat_map(|panel| &panel.series);
        let points = points.flat_map(|series| &series.points).filter(finite);
        let all = points.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (x, _)| {
            (low.min(*x), high.max(*x))
        });
        self.window.unwrap_or(all)
    }

    /// The panels, from above.
    pub fn panels(&self) -> &[Panel] {
        &self.panels
    }

    /// The right edge of the panels: as far as legends and names leave room.
    fn right(&self) -> f64 {
        let edge = |panel: &Panel| match panel.named_at_ends {
            true => room_beside(panel.series.iter().map(|series| series.name.as_str())),
            false => panel.legend().right(),
        };
        self.panels.iter().map(edge).fold(f64::INFINITY, f64::min)
    }

    fn mapping(&self) -> Mapping {
        let right = self.right();
        match self.window {
            Some((from, to)) => {
                let scale = self.x.scale;
                let on = |value| super::axis::on(scale, value);
                Mapping::spanning(scale, on(from), on(to)).onto(LEFT, right)
            }
            None => {
                let points = self.panels.iter().flat_map(|panel| &panel.series);
                let points = points.flat_map(|series| &series.points);
                let places = points.filter(finite).map(|point| point.0);
                let marks = self.marks.iter().map(|mark| mark.0);
                fitted(self.x.scale, places.chain(marks), (LEFT, right), false)
            }
        }
    }

    fn height(&self) -> f64 {
        match self.panels.len() {
            1 => 420.0,
            2 => 230.0,
            3 => 180.0,
            4 => 150.0,
            _ => 116.0,
        }
    }

    fn description(&self) -> String {
        let panel = |panel: &Panel| {
            let names = panel.series.iter().map(|series| series.name.as_str());
            let names: Vec<&str> = names.filter(|name| !name.is_empty()).collect();
            let names =
                if names.is_empty() { String::new() } else { format!(": {}", names.join("; ")) };
            format!("{}{names}", panel.y.label())
        };
        let panels: Vec<String> = self.panels.iter().map(panel).collect();
        format!("Against {} (across): {}.", self.x.label(), panels.join(". "))
    }
}

fn finite(point: &&(f64, f64)) -> bool {
    point.0.is_finite() && point.1.is_finite()
}

fn placed(axis: &Axis, value: f64) -> Result<(), PlotError> {
    match value.is_finite() {
        true => axis.check(value),
        false => Err(PlotError::TooLarge { what: format!("a value of \"{}\"", axis.name), value }),
    }
}

/// Draws what a panel shows, and adds its legend; how many texts found no place.
fn draw_panel(figure: &Figure, panel: &Panel, sheet: &mut Sheet, x: &Mapping) -> usize {
    let y = fitted(panel.y.scale, panel.heights(), (sheet.bottom(), sheet.top), false);
    let on = |point: &(f64, f64)| (x.position(point.0), y.position(point.1));
    sheet.grid(x, &y);
    if panel.y.scale == super::Scale::Linear && y.contains(0.0) {
        sheet.drawing.line("zero", (LEFT, y.position(0.0)), (sheet.right, y.position(0.0)));
    }
    let mut placement = placement_in(sheet, &figure.marks, x);
    let mut ends = Vec::new();
    for (i, series) in panel.series.iter().enumerate() {
        let style = series.style.unwrap_or(i);
        let parts = series.points.split(|point| !finite(&point)).filter(|part| !part.is_empty());
        let parts: Vec<Vec<(f64, f64)>> = parts.map(|part| part.iter().map(on).collect()).collect();
        for (at, from, to) in &series.jumps {
            let class = format!("jump c{}", style % COLOURS.len());
            sheet.drawing.line(&class, on(&(*at, *from)), on(&(*at, *to)));
        }
        for part in &parts {
            match series.look {
                Look::Points => {}
                Look::Thin => sheet.drawing.thin_stroke(style, part),
                Look::Line | Look::Both => sheet.drawing.stroke(style, part),
            }
            if series.look != Look::Points {
                placement.avoid(part);
            }
            if matches!(series.look, Look::Points | Look::Both) {
                for point in part {
                    sheet.drawing.marker(style, *point, "");
                }
            }
        }
        let end = parts.last().and_then(|part| part.last());
        if let Some(end) = end.filter(|_| panel.named_at_ends && !series.name.is_empty()) {
            ends.push((*end, series.name.as_str()));
        }
    }
    let mut unlabelled = draw_levels(&panel.levels, sheet, &y, &mut placement);
    unlabelled += draw_ends(&ends, sheet, &mut placement);
    for (at, text) in &panel.notes {
        let (wide, high) = label_size(text);
        let at = on(at);
        match placement.beside(at, wide, high) {
            Some((left, top)) => {
                let base = (left + 1.0, top + 0.85 * SMALL + 1.0);
                sheet.drawing.text("label", Anchor::Start, base, text);
            }
            None => unlabelled += 1,
        }
    }
    let is_last = std::ptr::eq(panel, &figure.panels[figure.panels.len() - 1]);
    match is_last {
        true => sheet.axes((&figure.x, x), (&panel.y, &y)),
        false => sheet.axes_above_others(x, (&panel.y, &y)),
    }
    let names = |panel: &Panel| -> Vec<String> {
        panel.series.iter().map(|series| series.name.clone()).collect()
    };
    let place = figure.panels.iter().position(|other| std::ptr::eq(other, panel));
    let above = place.and_then(|place| place.checked_sub(1)).map(|above| &figure.panels[above]);
    // What the panel above says need not be said again.
    if above.is_none_or(|above| names(above) != names(panel)) {
        let top = sheet.top;
        sheet.legend(&panel.legend(), top);
    }
    unlabelled
}

fn sample_of(sample: &mut Drawing, look: Look, style: usize) {
    match look {
        Look::Points => {}
        Look::Thin => sample.thin_stroke(style, &[(0.0, 0.0), (30.0, 0.0)]),
        Look::Line | Look::Both => sample.stroke(style, &[(0.0, 0.0), (30.0, 0.0)]),
    }
    if matches!(look, Look::Points | Look::Both) {
        sample.marker(style, (15.0, 0.0), "");
    }
}

impl Chart for Figure {
    fn title(&self) -> &str {
        &self.title
    }

    fn caption(&self) -> &Caption {
        &self.caption
    }

    fn svg_named(&self, name: &str) -> String {
        let x = self.mapping();
        let above = room_above(&self.marks, &x);
        let sheet = Sheet::open(name, &self.title, above);
        let mut sheet = sheet.resized(self.height()).reaching(self.right());
        sheet.drawing.style(RULES);
        let mut unlabelled = 0;
        for (i, panel) in self.panels.iter().enumerate() {
            match i {
                0 => draw_marks(&self.marks, &mut sheet, &x),
                _ => {
                    sheet.next_area(16.0);
                    for (at, _) in &self.marks {
                        let x = x.position(*at);
                        let (top, bottom) = (sheet.top, sheet.bottom());
                        sheet.drawing.line("rule-across", (x, top), (x, bottom));
                    }
                }
            }
            unlabelled += draw_panel(self, panel, &mut sheet, &x);
        }
        let remarks = match unlabelled {
            0 => Vec::new(),
            count => {
                vec![format!("{} left out for want of room.", counted(count, "text", "texts"))]
            }
        };
        sheet.close(&self.title, &self.description(), &self.caption, &remarks)
    }

    fn json(&self) -> Value {
        let number = |value: f64| json_number(Some(value));
        let point = |&(x, y): &(f64, f64)| json!([number(x), number(y)]);
        let series = |panel: &Panel, series: &Series| {
            let points: Vec<Value> = series.points.iter().map(point).collect();
            let jumps: Vec<Value> = series.jumps.iter().map(|(x, a, b)| json!([x, a, b])).collect();
            json!({"name": panel.name_of(series), "points": points, "jumps": jumps})
        };
        let named = |key: &str, lines: &[(f64, String)]| -> Vec<Value> {
            lines.iter().map(|(at, name)| json!({key: number(*at), "name": name})).collect()
        };
        let panel = |panel: &Panel| {
            json!({
                "y": panel.y.json(),
                "series": panel.series.iter().map(|own| series(panel, own)).collect::<Vec<_>>(),
                "levels": named("y", &panel.levels),
            })
        };
        json!({
            "kind": "figure",
            "title": self.title,
            "caption": self.caption.json(),
            "x": self.x.json(),
            "marks": named("x", &self.marks),
            "panels": self.panels.iter().map(panel).collect::<Vec<_>>(),
        })
    }

    fn csv(&self) -> String {
        let mut csv = format!("panel,series,{},value\n", csv_field(&self.x.label()));
        for panel in &self.panels {
            for series in &panel.series {
                for point in series.points.iter().filter(finite) {
                    let numbers = [Some(point.0), Some(point.1)].map(csv_number).join(",");
                    let names =
                        [csv_field(&panel.y.label()), csv_field(panel.name_of(series))].join(",");
                    csv.push_str(&format!("{names},{numbers}\n"));
                }
            }
        }
        csv
    }
}
