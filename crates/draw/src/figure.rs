//! Figures of series: quantities against time or along a line, in panels over one axis.

use super::axis::Mapping;
use super::drawing::{Drawing, coloured};
use super::ends::{draw_ends, room_beside};
use super::layout::{LEFT, Legend, SAMPLE, Sheet, counted, fitted};
use super::marks::{draw_levels, draw_marks, placement_in, room_above};
use super::text::{csv_field, csv_row, json_places, json_points};
use super::{Axis, Caption, Chart, PlotError};
use serde_json::{Value, json};

/// Classes of figures.
const RULES: &str = "\
.plot .jump{fill:none;stroke:currentColor;stroke-width:.9;stroke-dasharray:1.5 2.5}\
.plot .zero{fill:none;stroke:#8a8a8a;stroke-width:.8}\
.plot .thin{fill:none;stroke:currentColor;stroke-width:.9;stroke-linejoin:round}";

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Look {
    Line,
    Points,
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
    pub look: Look,
    /// Which of the styles (colour, dashes and marker) it has; that of its place where none is given.
    pub style: Option<usize>,
}

impl Series {
    pub fn new(name: &str, points: Vec<(f64, f64)>) -> Series {
        let name = name.to_owned();
        Series { name, points, jumps: Vec::new(), look: Look::Line, style: None }
    }

    #[must_use]
    pub fn jumping(self, jumps: Vec<(f64, f64, f64)>) -> Series {
        Series { jumps, ..self }
    }

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
    pub y: Axis,
    pub series: Vec<Series>,
    /// Labelled horizontal lines.
    pub levels: Vec<(f64, String)>,
    /// From where to where the axis reaches at least, so that panels can be compared.
    pub range: Option<(f64, f64)>,
    /// Whether names stand where lines end, and not in a legend.
    pub named_at_ends: bool,
}

impl Panel {
    /// A panel with a legend, and without levels.
    pub fn new(y: Axis, series: Vec<Series>) -> Panel {
        Panel { y, series, levels: Vec::new(), range: None, named_at_ends: false }
    }

    /// What a series is called in data: a nameless one as the axis.
    fn name_of<'a>(&'a self, series: &'a Series) -> &'a str {
        if series.name.is_empty() { &self.y.name } else { &series.name }
    }

    fn points(&self) -> impl Iterator<Item = &(f64, f64)> {
        self.series.iter().flat_map(|series| &series.points).filter(finite)
    }

    fn heights(&self) -> impl Iterator<Item = f64> + '_ {
        let points = self.points().map(|point| point.1);
        let range = self.range.into_iter().flat_map(|(low, high)| [low, high]);
        points.chain(self.levels.iter().map(|level| level.0)).chain(range)
    }

    /// What stands beside the plotting area.
    fn legend(&self) -> Legend {
        let mut legend = Legend::default();
        for (i, series) in self.series.iter().enumerate() {
            if !series.name.is_empty() && !self.named_at_ends {
                let style = series.style.unwrap_or(i);
                legend.entry(series.name.clone(), |sample| {
                    draw(sample, series.look, style, &SAMPLE, &[(15.0, 0.0)]);
                });
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
    pub fn new(
        title: &str,
        x: Axis,
        panels: Vec<Panel>,
        caption: Caption,
    ) -> Result<Figure, PlotError> {
        for panel in &panels {
            for point in panel.points() {
                x.check(point.0)?;
                panel.y.check(point.1)?;
            }
            let range = panel.range.iter().flat_map(|(low, high)| [low, high]);
            for height in panel.levels.iter().map(|(level, _)| level).chain(range) {
                panel.y.check_finite(*height)?;
            }
            for (at, from, to) in panel.series.iter().flat_map(|series| &series.jumps) {
                x.check_finite(*at)?;
                panel.y.check_finite(*from)?;
                panel.y.check_finite(*to)?;
            }
        }
        if panels.iter().all(|panel| panel.points().next().is_none()) {
            return Err(PlotError::Empty { title: title.to_owned() });
        }
        let (title, marks) = (title.to_owned(), Vec::new());
        Ok(Figure { title, x, panels, marks, window: None, caption })
    }

    /// The same from edge to edge between two places across; what lies outside is not to be given.
    pub fn window(mut self, from: f64, to: f64) -> Result<Figure, PlotError> {
        self.x.check_finite(from)?;
        self.x.check_finite(to)?;
        if from >= to {
            return Err(PlotError::NotAscending { axis: self.x.name.clone() });
        }
        self.window = Some((from, to));
        Ok(self)
    }

    /// The same with a vertical line through all panels, labelled above them.
    pub fn mark(mut self, x: f64, name: &str) -> Result<Figure, PlotError> {
        self.x.check_finite(x)?;
        self.marks.push((x, name.to_owned()));
        Ok(self)
    }

    /// The same with another title; it may be empty.
    #[must_use]
    pub fn titled(self, title: &str) -> Figure {
        Figure { title: title.to_owned(), ..self }
    }

    /// From where to where it reaches across: its window, or its points.
    pub fn extent(&self) -> (f64, f64) {
        let all = self.points().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (x, _)| {
            (low.min(*x), high.max(*x))
        });
        self.window.unwrap_or(all)
    }

    fn points(&self) -> impl Iterator<Item = &(f64, f64)> {
        self.panels.iter().flat_map(Panel::points)
    }

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
                let places = self.points().map(|point| point.0);
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
            let colon = if names.is_empty() { "" } else { ": " };
            format!("{}{colon}{}", panel.y.label(), names.join("; "))
        };
        let panels: Vec<String> = self.panels.iter().map(panel).collect();
        format!("Against {} (across): {}.", self.x.label(), panels.join(". "))
    }
}

fn finite(point: &&(f64, f64)) -> bool {
    point.0.is_finite() && point.1.is_finite()
}

/// Draws what a panel shows, and adds its legend; how many texts found no place.
fn draw_panel(figure: &Figure, index: usize, sheet: &mut Sheet, x: &Mapping) -> usize {
    let panel = &figure.panels[index];
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
            sheet.drawing.line(&coloured("jump", style), on(&(*at, *from)), on(&(*at, *to)));
        }
        for part in &parts {
            draw(&mut sheet.drawing, series.look, style, part, part);
            if series.look != Look::Points {
                placement.avoid(part);
            }
        }
        let end = parts.last().and_then(|part| part.last());
        if let Some(end) = end.filter(|_| panel.named_at_ends && !series.name.is_empty()) {
            ends.push((*end, series.name.as_str()));
        }
    }
    let mut unlabelled = draw_levels(&panel.levels, sheet, &y, &mut placement);
    unlabelled += draw_ends(&ends, sheet, &mut placement);
    match index + 1 == figure.panels.len() {
        true => sheet.axes((&figure.x, x), (&panel.y, &y)),
        false => sheet.axes_above_others(x, (&panel.y, &y)),
    }
    let names = |panel: &Panel| -> Vec<String> {
        panel.series.iter().map(|series| series.name.clone()).collect()
    };
    // What the panel above says need not be said again.
    if index == 0 || names(&figure.panels[index - 1]) != names(panel) {
        sheet.legend(&panel.legend(), sheet.top);
    }
    unlabelled
}

/// A line through points, with these markers.
fn draw(drawing: &mut Drawing, look: Look, style: usize, line: &[(f64, f64)], at: &[(f64, f64)]) {
    match look {
        Look::Points => {}
        Look::Thin => drawing.stroke("thin", style, line),
        Look::Line | Look::Both => drawing.stroke("line", style, line),
    }
    if matches!(look, Look::Points | Look::Both) {
        at.iter().for_each(|point| drawing.marker(style, *point, ""));
    }
}

impl Chart for Figure {
    fn title(&self) -> &str {
        &self.title
    }

    fn svg_named(&self, name: &str) -> String {
        let x = self.mapping();
        let above = room_above(&self.marks, &x);
        let sheet = Sheet::open(name, &self.title, above);
        let mut sheet = sheet.resized(self.height()).reaching(self.right());
        sheet.drawing.style(RULES);
        let mut unlabelled = 0;
        for i in 0..self.panels.len() {
            match i {
                0 => draw_marks(&self.marks, &mut sheet, &x),
                _ => {
                    sheet.next_area(16.0);
                    for (at, _) in &self.marks {
                        sheet.upright("rule-across", x.position(*at));
                    }
                }
            }
            unlabelled += draw_panel(self, i, &mut sheet, &x);
        }
        let texts = counted(unlabelled, "text", "texts");
        let remark = (unlabelled > 0).then(|| format!("{texts} left out for want of room."));
        let remarks: Vec<String> = remark.into_iter().collect();
        sheet.close(&self.title, &self.description(), &self.caption, &remarks)
    }

    fn json(&self) -> Value {
        let series = |panel: &Panel, series: &Series| {
            let points = json_points(&series.points);
            let jumps: Vec<Value> = series.jumps.iter().map(|(x, a, b)| json!([x, a, b])).collect();
            json!({"name": panel.name_of(series), "points": points, "jumps": jumps})
        };
        let panel = |panel: &Panel| {
            json!({
                "y": panel.y.json(),
                "series": panel.series.iter().map(|own| series(panel, own)).collect::<Vec<_>>(),
                "levels": json_places("y", &panel.levels),
            })
        };
        json!({
            "kind": "figure",
            "title": self.title,
            "caption": self.caption.json(),
            "x": self.x.json(),
            "marks": json_places("x", &self.marks),
            "panels": self.panels.iter().map(panel).collect::<Vec<_>>(),
        })
    }

    fn csv(&self) -> String {
        let mut csv = format!("panel,series,{},value\n", csv_field(&self.x.label()));
        for panel in &self.panels {
            for series in &panel.series {
                for point in series.points.iter().filter(finite) {
                    let names = [&panel.y.label(), panel.name_of(series)];
                    csv += &csv_row(&names, [Some(point.0), Some(point.1)]);
                }
            }
        }
        csv
    }
}
