//! Diagrams of place and time (Lagrange diagrams): areas coloured by a quantity, and the lines along
//! which waves run.

use super::axis::Mapping;
use super::drawing::{Anchor, SMALL, coordinate, polyline};
use super::layout::{LEFT, Sheet, label_size};
use super::marks::{draw_levels, placement_in};
use super::number::rounded;
use super::palette::diverging;
use super::placement::part_inside;
use super::text::{csv_field, csv_number, json_points};
use super::{Axis, Caption, Chart, PlotError};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Classes of diagrams.
const RULES: &str = "\
.plot .front,.plot .kink{fill:none;stroke:#000}\
.plot .joint{fill:none;stroke:#555;stroke-width:.8;stroke-dasharray:2 2}\
.plot .bar{fill:#d9d9d9;stroke:#222;stroke-width:1}\
.plot .lump{fill:#222;stroke:none}\
.plot .wall{fill:none;stroke:#222;stroke-width:1.4}";

/// The right edge of the plotting area, beside the scale of colours.
const RIGHT: f64 = 770.0;

/// The widths of fronts and of lines along which slopes jump; and the share of the area that they cover at
/// most: where there are many they are thinner.
const WIDTHS: [f64; 2] = [1.5, 0.6];
const COVERED: f64 = 0.08;

/// In how many steps the colours change from zero to the darkest.
const STEPS: f64 = 64.0;

/// A range of places and one of times: `[(left, right), (first, last)]`.
pub type Window = [(f64, f64); 2];

/// An area with the value of the quantity in it.
///
/// # Invariants
/// - at least three corners, all finite.
#[derive(Clone, PartialEq, Debug)]
pub struct Cell {
    outline: Vec<(f64, f64)>,
    value: f64,
}

impl Cell {
    /// The part of a convex area that lies in a window; `None` where there is none.
    pub fn clipped(outline: &[(f64, f64)], value: f64, window: Window) -> Option<Cell> {
        let [(left, right), (first, last)] = window;
        // One side after the other: what lies beyond it is cut off.
        let mut outline = outline.to_vec();
        for (edge, above, upwards) in
            [(left, true, false), (right, false, false), (first, true, true), (last, false, true)]
        {
            let along = |point: (f64, f64)| if upwards { point.1 } else { point.0 };
            let inside = |point: (f64, f64)| match above {
                true => along(point) >= edge,
                false => along(point) <= edge,
            };
            let mut kept = Vec::with_capacity(outline.len() + 1);
            for (i, &point) in outline.iter().enumerate() {
                let before = outline[(i + outline.len() - 1) % outline.len()];
                if inside(point) != inside(before) {
                    let share = (edge - along(before)) / (along(point) - along(before));
                    let between = |a: f64, b: f64| a + share * (b - a);
                    kept.push(match upwards {
                        true => (between(before.0, point.0), edge),
                        false => (edge, between(before.1, point.1)),
                    });
                }
                if inside(point) {
                    kept.push(point);
                }
            }
            outline = kept;
        }
        outline.dedup();
        if outline.len() > 1 && outline.first() == outline.last() {
            outline.pop();
        }
        let is_area = outline.len() > 2 && outline.iter().all(|(x, y)| (x + y).is_finite());
        (is_area && value.is_finite()).then_some(Cell { outline, value })
    }

    pub fn outline(&self) -> &[(f64, f64)] {
        &self.outline
    }

    pub fn value(&self) -> f64 {
        self.value
    }
}

/// The line of a front: where the quantity jumps, or, drawn thin, where its slope does.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Line {
    pub from: (f64, f64),
    pub to: (f64, f64),
    pub jumps: bool,
}

impl Line {
    /// The part of it in a window; `None` where there is none.
    pub fn clipped(self, window: Window) -> Option<Line> {
        let (start, end) = part_inside([self.from, self.to], window)?;
        let at = |share: f64| {
            let between = |a: f64, b: f64| a + share * (b - a);
            (between(self.from.0, self.to.0), between(self.from.1, self.to.1))
        };
        (start < end).then(|| Line { from: at(start), to: at(end), jumps: self.jumps })
    }
}

/// What stands below the axis of places.
#[derive(Clone, PartialEq, Debug)]
pub struct Part {
    pub name: String,
    pub from: f64,
    pub to: f64,
    pub shape: Shape,
}

/// How an element is drawn below the axis of places.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Shape {
    /// A bar, whose thickness stands for its impedance: a share of that of the stoutest, 0 … 1.
    Bar(f64),
    /// A mass, a spring, a support or a load.
    Lump,
    /// An end that does not move.
    Wall,
}

/// A diagram of place and time.
///
/// Zero is white, values above it are red and values below it blue, the darker the farther from zero, in
/// every diagram. Where both signs occur what is below zero is hatched, so that a diagram can be printed in
/// grey.
///
/// # Invariants
/// There is a cell; the window and the scale of colours are not empty; the scale holds zero.
#[derive(Clone, PartialEq, Debug)]
pub struct Diagram {
    title: String,
    /// Of places, of times, of the quantity.
    axes: [Axis; 3],
    window: Window,
    cells: Vec<Cell>,
    lines: Vec<Line>,
    joints: Vec<f64>,
    parts: Vec<Part>,
    levels: Vec<(f64, String)>,
    colours: (f64, f64),
    caption: Caption,
}

impl Diagram {
    /// These cells in a window, with the axes of places, of times and of the quantity. The scale of
    /// colours spans the values and zero.
    /// Refused are an empty window and values too large for a linear axis.
    pub fn new(
        title: &str,
        axes: [Axis; 3],
        window: Window,
        cells: Vec<Cell>,
        caption: Caption,
    ) -> Result<Diagram, PlotError> {
        for (axis, (low, high)) in axes.iter().zip(window) {
            axis.check(low)?;
            axis.check(high)?;
            if !(low < high && (high - low).is_finite()) {
                return Err(PlotError::NotAscending { axis: axis.name.clone() });
            }
        }
        if cells.is_empty() {
            return Err(PlotError::Empty { title: title.to_owned() });
        }
        let values = || cells.iter().map(|cell| cell.value);
        let colours = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
        axes[2].check(colours.0)?;
        axes[2].check(colours.1)?;
        let colours = if colours.0 < colours.1 { colours } else { (0.0, 1.0) };
        let (title, lines, parts) = (title.to_owned(), Vec::new(), Vec::new());
        let (joints, levels) = (Vec::new(), Vec::new());
        Ok(Diagram { title, axes, window, cells, lines, joints, parts, levels, colours, caption })
    }

    #[must_use]
    pub fn lines(self, lines: Vec<Line>) -> Diagram {
        Diagram { lines, ..self }
    }

    /// The same with these parts below the axis of places. Where two bars meet, a line goes up.
    #[must_use]
    pub fn parts(self, parts: Vec<Part>) -> Diagram {
        let [(left, right), _] = self.window;
        let ends = parts.iter().filter(|part| matches!(part.shape, Shape::Bar(_)));
        let mut joints: Vec<f64> =
            ends.map(|part| part.to).filter(|x| left < *x && *x < right).collect();
        joints.dedup();
        Diagram { parts, joints, ..self }
    }

    /// The same with a labelled line at a time.
    pub fn level(mut self, time: f64, name: &str) -> Result<Diagram, PlotError> {
        let (first, last) = self.window[1];
        if !(first..=last).contains(&time) {
            return Err(PlotError::NotAscending { axis: self.axes[1].name.clone() });
        }
        self.levels.push((time, name.to_owned()));
        Ok(self)
    }

    /// The same with other names of places, of times and of the quantity, without units beside them.
    #[must_use]
    pub fn measured(self, names: [&str; 3]) -> Diagram {
        Diagram { axes: names.map(Axis::linear), ..self }
    }

    /// The same with another title; it may be empty.
    #[must_use]
    pub fn titled(self, title: &str) -> Diagram {
        Diagram { title: title.to_owned(), ..self }
    }

    /// How far a value is from zero: from −1 to 1, where the farther end of the scale is, in steps.
    fn share(&self, value: f64) -> f64 {
        let share = value / self.colours.1.max(-self.colours.0);
        (share * STEPS).round() / STEPS
    }

    /// Whether values of both signs are told apart.
    fn has_both_signs(&self) -> bool {
        self.colours.0 < 0.0 && self.colours.1 > 0.0
    }

    fn description(&self) -> String {
        let [x, y, quantity] = self.axes.each_ref().map(Axis::label);
        let (low, high) = self.colours;
        format!(
            "{quantity} by colour over {x} (across) and {y} (up), from {} to {}; {} fronts.",
            rounded(low),
            rounded(high),
            self.lines.len()
        )
    }

    fn colour_bar(&self, sheet: &mut Sheet, hatch: &str) {
        let (low, high) = self.colours;
        let (top, bottom) = (sheet.top + 26.0, sheet.bottom() - 60.0);
        let scale = Mapping::spanning(self.axes[2].scale, low, high).onto(bottom, top);
        let pattern = self.has_both_signs().then(|| (hatch, scale.position(0.0)));
        let colour = |share: f64| diverging(self.share(low + share * (high - low)));
        let name = self.axes[2].label();
        sheet.colour_bar((&name, RIGHT + 26.0, &scale), &scale.ticks(26.0), pattern, colour);
    }

    /// The line of bars to the scale of the axis of places, with names below.
    fn sketch(&self, sheet: &mut Sheet, x: &Mapping) {
        if self.parts.is_empty() {
            return;
        }
        let top = sheet.strip_below(34.0);
        let centre = top + 20.0;
        // Lumps stand in front of the bars that they join.
        let is_bar = |part: &&Part| matches!(part.shape, Shape::Bar(_));
        let bars = self.parts.iter().filter(is_bar);
        for part in bars.chain(self.parts.iter().filter(|part| !is_bar(part))) {
            let (from, to) = (x.position(part.from), x.position(part.to));
            match part.shape {
                Shape::Bar(thickness) => {
                    let half = 3.0 + 7.0 * thickness.clamp(0.0, 1.0);
                    sheet.drawing.rectangle("bar", (from, centre - half), (to, centre + half));
                }
                Shape::Lump => {
                    let (left, right) = (from - 3.5, to + 3.5);
                    sheet.drawing.rectangle("lump", (left, centre - 12.0), (right, centre + 12.0));
                }
                Shape::Wall => {
                    let across = from.clamp(LEFT, RIGHT);
                    let way = if across > f64::midpoint(LEFT, RIGHT) { 7.0 } else { -7.0 };
                    let mut path = polyline(&[(across, centre - 13.0), (across, centre + 13.0)]);
                    for i in 0..4 {
                        let y = centre - 12.0 + 7.0 * f64::from(i);
                        path += &polyline(&[(across, y), (across + way, y + 5.0)]);
                    }
                    sheet.drawing.path("wall", &path);
                }
            }
        }
        // Names in rows: each in the first in which it touches no other.
        let mut rows: Vec<f64> = Vec::new();
        let mut named: Vec<(&Part, f64)> = self
            .parts
            .iter()
            .filter(|part| !part.name.is_empty())
            .map(|part| (part, x.position(f64::midpoint(part.from, part.to))))
            .collect();
        named.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut base = sheet.strip_below(4.0);
        let mut texts = Vec::new();
        for (part, middle) in named {
            let wide = label_size(&part.name).0;
            let left = (middle - wide / 2.0).max(4.0);
            let row = rows.iter().position(|end| *end + 6.0 <= left).unwrap_or(rows.len());
            if row == rows.len() {
                rows.push(0.0);
            }
            rows[row] = left + wide;
            texts.push((left, row, &part.name));
        }
        base += 1.2 * SMALL;
        for (left, row, name) in texts {
            let place = (left, base + 1.3 * SMALL * row as f64);
            sheet.drawing.text("small", Anchor::Start, place, name);
        }
        sheet.strip_below(1.3 * SMALL * rows.len() as f64 + 2.0);
    }
}

/// How wide the two kinds of lines are drawn, so that together they cover no more than a share of the
/// area.
fn widths(lines: &[Line], on: impl Fn((f64, f64)) -> (f64, f64), area: f64) -> [f64; 2] {
    let covered = |line: &Line| {
        let (from, to) = (on(line.from), on(line.to));
        (to.0 - from.0).hypot(to.1 - from.1) * WIDTHS[usize::from(!line.jumps)]
    };
    let covered: f64 = lines.iter().map(covered).sum();
    let thinner = (COVERED * area / covered.max(1.0)).min(1.0);
    WIDTHS.map(|width| width * thinner)
}

/// Adds an outline in tenths of pixels, each corner relative to the one before: there are many cells, and
/// these are the shortest texts.
fn append(path: &mut String, corners: impl Iterator<Item = (f64, f64)>) {
    let tenths = |value: f64| (10.0 * value).round();
    let mut before: Option<(f64, f64)> = None;
    for (x, y) in corners {
        let corner = (tenths(x), tenths(y));
        let (letter, from) = before.map_or(('M', (0.0, 0.0)), |before| ('l', before));
        if before != Some(corner) {
            let across = coordinate((corner.0 - from.0) / 10.0);
            let up = coordinate((corner.1 - from.1) / 10.0);
            path.push(letter);
            path.push_str(&across);
            // A minus sign parts numbers as a blank does.
            if !up.starts_with('-') {
                path.push(' ');
            }
            path.push_str(&up);
        }
        before = Some(corner);
    }
    path.push('z');
}

/// Pairs of a light and a dark line, seen on any colour.
fn hatching(name: &str) -> String {
    let line = |colour: &str, shift: i32| {
        format!(
            "<path fill=\"none\" stroke=\"{colour}\" stroke-opacity=\".35\" stroke-width=\".8\" \
             d=\"M{} 8L{} -1M{} 8L{} -1\"/>",
            shift - 1,
            shift + 8,
            shift - 8,
            shift + 1
        )
    };
    format!(
        "<pattern id=\"{name}\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\">{}{}</pattern>",
        line("#000", 0),
        line("#fff", 1)
    )
}

impl Chart for Diagram {
    fn title(&self) -> &str {
        &self.title
    }

    fn svg_named(&self, name: &str) -> String {
        let mut sheet = Sheet::open(name, &self.title, 0.0).reaching(RIGHT);
        sheet.drawing.style(RULES);
        let hatch = format!("{}-below", sheet.name);
        if self.has_both_signs() {
            sheet.drawing.pattern(&hatching(&hatch));
        }
        let [across, up] = self.window;
        let x = Mapping::spanning(self.axes[0].scale, across.0, across.1).onto(LEFT, RIGHT);
        let y = Mapping::spanning(self.axes[1].scale, up.0, up.1).onto(sheet.bottom(), sheet.top);
        let on = |(place, time): (f64, f64)| (x.position(place), y.position(time));
        let mut outlines: BTreeMap<i64, String> = BTreeMap::new();
        for cell in &self.cells {
            let step = (self.share(cell.value) * STEPS) as i64;
            let outline = outlines.entry(step).or_default();
            append(outline, cell.outline.iter().map(|corner| on(*corner)));
        }
        for (step, outline) in &outlines {
            sheet.drawing.fill(&diverging(*step as f64 / STEPS), outline);
        }
        if self.has_both_signs() {
            // What is zero but for the steps of colours is not hatched.
            let below: String = outlines.range(..-1).map(|(_, outline)| outline.as_str()).collect();
            sheet.drawing.fill_with(&hatch, &below);
        }
        for joint in &self.joints {
            sheet.upright("joint", x.position(*joint));
        }
        let area = (RIGHT - LEFT) * (sheet.bottom() - sheet.top);
        let [front, kink] = widths(&self.lines, on, area);
        sheet.drawing.style(&format!(
            ".plot .front{{stroke-width:{}}}.plot .kink{{stroke-width:{}}}",
            coordinate(front),
            coordinate(kink)
        ));
        for line in &self.lines {
            let class = if line.jumps { "front" } else { "kink" };
            sheet.drawing.line(class, on(line.from), on(line.to));
        }
        let mut placement = placement_in(&sheet, &[], &x);
        for line in &self.lines {
            placement.avoid(&[on(line.from), on(line.to)]);
        }
        let unlabelled = draw_levels(&self.levels, &mut sheet, &y, &mut placement);
        sheet.axes((&self.axes[0], &x), (&self.axes[1], &y));
        self.colour_bar(&mut sheet, &hatch);
        self.sketch(&mut sheet, &x);
        let remark =
            (unlabelled > 0).then(|| format!("{unlabelled} labels left out for want of room."));
        let remarks: Vec<String> = remark.into_iter().collect();
        sheet.close(&self.title, &self.description(), &self.caption, &remarks)
    }

    fn json(&self) -> Value {
        let cell =
            |cell: &Cell| json!({"value": cell.value, "outline": json_points(&cell.outline)});
        let line =
            |line: &Line| json!({"ends": json_points(&[line.from, line.to]), "jumps": line.jumps});
        let part = |part: &Part| json!({"name": part.name, "from": part.from, "to": part.to});
        json!({
            "kind": "diagram",
            "title": self.title,
            "caption": self.caption.json(),
            "x": self.axes[0].json(),
            "y": self.axes[1].json(),
            "quantity": self.axes[2].json(),
            "cells": self.cells.iter().map(cell).collect::<Vec<_>>(),
            "lines": self.lines.iter().map(line).collect::<Vec<_>>(),
            "parts": self.parts.iter().map(part).collect::<Vec<_>>(),
        })
    }

    /// One line a cell: its value, then the corners as `x y` pairs, separated by blanks.
    fn csv(&self) -> String {
        let mut csv = format!("{},corners\n", csv_field(&self.axes[2].label()));
        for cell in &self.cells {
            let pair =
                |(x, y): &(f64, f64)| format!("{} {}", csv_number(Some(*x)), csv_number(Some(*y)));
            let corners: Vec<String> = cell.outline.iter().map(pair).collect();
            csv += &format!("{},{}\n", csv_number(Some(cell.value)), corners.join(" "));
        }
        csv
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn diagram(values: &[f64]) -> Diagram {
        let window = [(0.0, 1.0), (0.0, values.len() as f64)];
        let cell = |(i, value): (usize, &f64)| {
            let (low, high) = (i as f64, i as f64 + 1.0);
            let corners = [(0.0, low), (1.0, low), (1.0, high), (0.0, high)];
            Cell::clipped(&corners, *value, window).expect("a cell in the window")
        };
        let cells = values.iter().enumerate().map(cell).collect();
        let axes = ["place", "time", "velocity"].map(Axis::linear);
        Diagram::new("", axes, window, cells, Caption::default()).expect("finite values")
    }

    #[test]
    fn a_colour_means_one_sign_in_every_diagram() {
        // The scale is white at zero, and the farther end is the darkest, whatever else there is.
        for (values, value, share) in [
            (&[2.0, -1.0][..], 2.0, 1.0),
            (&[2.0, -1.0], -1.0, -0.5),
            (&[2.0, 1.0], 1.0, 0.5),
            (&[-2.0, -1.0], -2.0, -1.0),
            (&[-2.0, 0.0], 0.0, 0.0),
        ] {
            assert_eq!(diagram(values).share(value), share, "{values:?}");
        }
    }

    #[test]
    fn what_is_below_zero_is_hatched_where_both_signs_occur() {
        let hatched = |values: &[f64]| diagram(values).svg().matches("url(#").count();
        // The cells and the scale.
        assert_eq!(hatched(&[2.0, -1.0]), 2);
        assert_eq!((hatched(&[2.0, 1.0]), hatched(&[-2.0, -1.0])), (0, 0));
    }

    #[test]
    fn outlines_are_relative() {
        let mut path = String::new();
        append(&mut path, [(1.0, 2.04), (3.5, 1.0), (3.52, 1.0), (0.0, 4.0)].into_iter());
        assert_eq!(path, "M1 2l2.5-1l-3.5 3z");
    }

    #[test]
    fn many_lines_are_thin_and_few_are_wide() {
        let line = Line { from: (0.0, 0.0), to: (100.0, 0.0), jumps: true };
        let area = 1e4;
        assert_eq!(widths(&[line], |point| point, area), WIDTHS);
        let many = vec![line; 100];
        let [front, kink] = widths(&many, |point| point, area);
        assert!((front * 100.0 * 100.0 - COVERED * area).abs() < 1e-9 && kink < front);
    }
}
