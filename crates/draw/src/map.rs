//! Maps of the error over two parameters: colour for magnitude, steps where digits are lost.

use super::axis::{Mapping, Tick, extremes, on};
use super::contour::step_lines;
use super::drawing::{Drawing, coordinate, polyline};
use super::layout::{LEFT, Legend, RIGHT, SAMPLE, Sheet, counted};
use super::number::{power_of_ten, rounded};
use super::palette::{DASHES, shade};
use super::text::{csv_field, csv_row, json_number, json_places};
use super::{Axis, Caption, Chart, PlotError, Scale};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The exponents of ten that a colour scale may span: all doubles lie within.
const EXPONENTS: std::ops::RangeInclusive<i32> = -400..=400;

/// A map of the error over two axes: one coloured cell for each pair of places.
///
/// The colour follows the decimal logarithm of the error. A cell that is `None` was refused and is
/// hatched; one that is infinite or not a number is crossed. Exact zeros take the colour of the
/// lower end. Between cells on different sides of a level runs a step line; an infinite error
/// lies above every level. Where two levels share a side, the later one is seen.
///
/// # Invariants
/// Places ascend strictly, are finite, and are above zero on logarithmic axes; there is one cell
/// for each pair, and at least one; no error is negative; the colour scale spans at least one power
/// of ten.
#[derive(Clone, PartialEq, Debug)]
pub struct Map {
    title: String,
    x: (Axis, Vec<f64>),
    y: (Axis, Vec<f64>),
    /// Row by row, from the lowest place of `y`.
    cells: Vec<Option<f64>>,
    levels: Vec<(f64, String)>,
    /// The exponents at the ends of the colour scale.
    decades: (i32, i32),
    caption: Caption,
}

impl Map {
    /// A map with the places of its columns (`x`) and rows (`y`), and the errors row by row, the
    /// row of the lowest `y` first. The colour scale spans the whole powers of ten about the
    /// errors.
    /// Refused are places that do not ascend or have no place on their axis, and negative errors.
    pub fn new(
        title: &str,
        x: (Axis, Vec<f64>),
        y: (Axis, Vec<f64>),
        cells: Vec<Option<f64>>,
        caption: Caption,
    ) -> Result<Map, PlotError> {
        for (axis, places) in [&x, &y] {
            let ascending = places.windows(2).all(|pair| pair[0] < pair[1]);
            if !ascending || !places.iter().all(|place| place.is_finite()) {
                return Err(PlotError::NotAscending { axis: axis.name.clone() });
            }
            places.iter().try_for_each(|place| axis.check(*place))?;
        }
        let expected = x.1.len() * y.1.len();
        if cells.len() != expected {
            return Err(PlotError::CellCount { expected, found: cells.len() });
        }
        if cells.is_empty() {
            return Err(PlotError::Empty { title: title.to_owned() });
        }
        if let Some(value) = cells.iter().flatten().copied().find(|error| *error < 0.0) {
            return Err(PlotError::Negative { what: "an error of the map".to_owned(), value });
        }
        let range = extremes(Scale::Logarithmic, cells.iter().flatten().copied());
        let (low, high) = range.unwrap_or((-16.0, 0.0));
        let low = low.floor() as i32;
        let decades = (low, (high.ceil() as i32).max(low + 1));
        Ok(Map { title: title.to_owned(), x, y, cells, levels: Vec::new(), decades, caption })
    }

    /// The same with a step line where the error crosses a level: cells below it on one side, cells
    /// at or above it on the other.
    pub fn level(mut self, value: f64, name: &str) -> Result<Map, PlotError> {
        if value.is_nan() || value <= 0.0 {
            return Err(PlotError::NotPositive { what: format!("the level \"{name}\""), value });
        }
        self.levels.push((value, name.to_owned()));
        Ok(self)
    }

    /// The same with a colour scale from `10^low` to `10^high`, so that several maps can be
    /// compared; errors beyond take the colours of the ends.
    pub fn decades(mut self, low: i32, high: i32) -> Result<Map, PlotError> {
        if low >= high || !EXPONENTS.contains(&low) || !EXPONENTS.contains(&high) {
            return Err(PlotError::EmptyColourScale { low, high });
        }
        self.decades = (low, high);
        Ok(self)
    }

    /// The error of a cell; `None` where it was refused.
    pub fn cell(&self, column: usize, row: usize) -> Option<f64> {
        assert!(column < self.x.1.len(), "no column {column}");
        self.cells[row * self.x.1.len() + column]
    }

    /// The place of an error on the colour scale, 0 at its lower end.
    fn share(&self, error: f64) -> f64 {
        let (low, high) = self.decades;
        (error.log10() - f64::from(low)) / f64::from(high - low)
    }

    fn count(&self, which: impl Fn(Option<f64>) -> bool) -> usize {
        self.cells.iter().filter(|cell| which(**cell)).count()
    }

    fn description(&self) -> String {
        let errors = || self.cells.iter().flatten().filter(|error| error.is_finite());
        let range = match errors().next() {
            None => "no error is finite".to_owned(),
            Some(_) => {
                let least = errors().copied().fold(f64::INFINITY, f64::min);
                let greatest = errors().copied().fold(0.0, f64::max);
                format!("errors from {} to {}", rounded(least), rounded(greatest))
            }
        };
        let level = |(value, name): &(f64, String)| {
            let reached = self.count(|cell| cell.is_some_and(|error| error >= *value));
            let (level, cells) = (rounded(*value), self.cells.len());
            format!("; \"{name}\" ({level} or more) in {reached} of {cells} cells")
        };
        let levels: String = self.levels.iter().map(level).collect();
        let (x, y) = (self.x.0.label(), self.y.0.label());
        format!("Map of the error over {x} (across) and {y} (up): {range}{levels}.")
    }

    fn remarks(&self) -> Vec<String> {
        match self.count(|cell| cell == Some(0.0)) {
            0 => Vec::new(),
            zeros => {
                let zeros = counted(zeros, "error", "errors");
                let bottom = power_of_ten(self.decades.0);
                vec![format!("{zeros} exactly zero, in the colour of {bottom}.")]
            }
        }
    }
}

/// The edges of cells about their places, all on the scale of the axis: half way between places,
/// and the outer ones as far out as in.
fn edges(axis: &Axis, places: &[f64]) -> Vec<f64> {
    let at: Vec<f64> = places.iter().map(|place| on(axis.scale, *place)).collect();
    let middle: Vec<f64> = at.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])).collect();
    let (first, last) = (at[0], at[at.len() - 1]);
    // A single place takes a width of its own.
    let alone = if axis.scale == Scale::Linear { 0.5 * first.abs().max(1.0) } else { 0.5 };
    let below = middle.first().map_or(alone, |middle| middle - first);
    let above = middle.last().map_or(alone, |middle| last - middle);
    let mut edges = vec![first - below];
    edges.extend(middle);
    edges.push(last + above);
    edges
}

/// A sample of the line of a level: dark on a light casing, so that it shows on every colour.
fn level_line(drawing: &mut Drawing, level: usize, points: &[(f64, f64)]) {
    let path = polyline(points);
    drawing.path("casing", &path);
    drawing.path(&format!("level d{}", level % DASHES.len()), &path);
}

/// The colour bar, labelled in powers of ten, and where it ends.
fn colour_bar(map: &Map, sheet: &mut Sheet) -> f64 {
    const HEIGHT: f64 = 190.0;
    let (low, high) = map.decades;
    let (top, bottom) = (sheet.top + 20.0, sheet.top + 20.0 + HEIGHT);
    let scale = Mapping::spanning(Scale::Linear, low.into(), high.into()).onto(bottom, top);
    let every = (1..).find(|every| HEIGHT * f64::from(*every) >= 20.0 * f64::from(high - low));
    let every = every.unwrap_or(1);
    let any = |outside: fn(f64) -> bool| {
        let mut finite = map.cells.iter().flatten().filter(|error| error.is_finite());
        finite.any(|error| outside(map.share(*error)))
    };
    let tick = |exponent: i32| {
        let major = (high - exponent) % every == 0;
        let beyond = match exponent {
            _ if exponent == low && any(|share| share < 0.0) => "≤ ",
            _ if exponent == high && any(|share| share > 1.0) => "≥ ",
            _ => "",
        };
        let label = major.then(|| format!("{beyond}{}", power_of_ten(exponent)));
        Tick { position: scale.pixel(exponent.into()), major, label }
    };
    let ticks = (low..=high).map(tick).filter(|tick| tick.major || every < 8);
    sheet.colour_bar(("error", RIGHT + 22.0, &scale), &ticks.collect::<Vec<_>>(), None, shade);
    bottom
}

impl Chart for Map {
    fn title(&self) -> &str {
        &self.title
    }

    fn svg_named(&self, name: &str) -> String {
        let mut sheet = Sheet::open(name, &self.title, 0.0);
        let along = |(axis, places): &(Axis, Vec<f64>), from, to| {
            let edges = edges(axis, places);
            let mapping =
                Mapping::spanning(axis.scale, edges[0], edges[edges.len() - 1]).onto(from, to);
            let pixels: Vec<f64> = edges.iter().map(|edge| mapping.pixel(*edge)).collect();
            (mapping, pixels)
        };
        let (x, columns) = along(&self.x, LEFT, RIGHT);
        let (y, rows) = along(&self.y, sheet.bottom(), sheet.top);
        let mut shades: BTreeMap<String, String> = BTreeMap::new();
        let (mut refused, mut infinite) = (String::new(), String::new());
        for row in 0..self.y.1.len() {
            for column in 0..self.x.1.len() {
                let outline = match self.cell(column, row) {
                    None => &mut refused,
                    Some(error) if !error.is_finite() => &mut infinite,
                    Some(error) => shades.entry(shade(self.share(error))).or_default(),
                };
                let [left, right, bottom, top] =
                    [columns[column], columns[column + 1], rows[row], rows[row + 1]]
                        .map(coordinate);
                let _ = write!(outline, "M{left} {bottom}H{right}V{top}H{left}z");
            }
        }
        for (colour, outline) in &shades {
            sheet.drawing.fill(colour, outline);
        }
        let patterns = [("refused", &refused), ("infinite", &infinite)];
        for (kind, outline) in patterns.iter().filter(|(_, outline)| !outline.is_empty()) {
            sheet.drawing.path("refused", outline);
            sheet.drawing.fill(&format!("url(#{}-{kind})", sheet.name), outline);
        }
        for (i, (level, _)) in self.levels.iter().enumerate() {
            let below = |column, row| {
                let error = self.cell(column, row)?;
                (!error.is_nan()).then_some(error < *level)
            };
            for line in step_lines(self.x.1.len(), self.y.1.len(), below) {
                let pixels: Vec<(f64, f64)> =
                    line.iter().map(|corner| (columns[corner.0], rows[corner.1])).collect();
                level_line(&mut sheet.drawing, i, &pixels);
            }
        }
        sheet.axes((&self.x.0, &x), (&self.y.0, &y));
        let below = colour_bar(self, &mut sheet) + 26.0;
        let mut legend = Legend::default();
        for (i, (level, name)) in self.levels.iter().enumerate() {
            let text = format!("{name}: {} or more", rounded(*level));
            legend.entry(text, |sample| level_line(sample, i, &SAMPLE));
        }
        let unknown = self.count(|cell| cell.is_some_and(|error| !error.is_finite()));
        let texts = [
            ("refused", self.count(|cell| cell.is_none()), "no value: refused, or not measured"),
            ("infinite", unknown, "not finite: overflow, or not a number"),
        ];
        for (kind, count, text) in texts.into_iter().filter(|(_, count, _)| *count > 0) {
            let cells = if count == 1 { "cell" } else { "cells" };
            let name = sheet.name.clone();
            legend.entry(format!("{text} ({count} {cells})"), |sample| {
                sample.rectangle("refused", (0.0, -7.0), (30.0, 7.0));
                sample.fill(&format!("url(#{name}-{kind})"), "M0 -7H30V7H0z");
                sample.rectangle("frame", (0.0, -7.0), (30.0, 7.0));
            });
        }
        sheet.legend(&legend, below);
        sheet.close(&self.title, &self.description(), &self.caption, &self.remarks())
    }

    fn json(&self) -> Value {
        let axis = |(axis, places): &(Axis, Vec<f64>)| {
            let mut value = axis.json();
            value["places"] = json!(places);
            value
        };
        let row = |row: &[Option<f64>]| row.iter().map(|cell| json_number(*cell)).collect();
        let rows: Vec<Vec<Value>> = self.cells.chunks(self.x.1.len()).map(row).collect();
        json!({
            "kind": "map",
            "title": self.title,
            "caption": self.caption.json(),
            "x": axis(&self.x),
            "y": axis(&self.y),
            "rows": rows,
            "levels": json_places("value", &self.levels),
            "decades": [self.decades.0, self.decades.1],
        })
    }

    fn csv(&self) -> String {
        let (x, y) = (csv_field(&self.x.0.label()), csv_field(&self.y.0.label()));
        let mut csv = format!("{x},{y},error\n");
        for (row, &up) in self.y.1.iter().enumerate() {
            for (column, &across) in self.x.1.iter().enumerate() {
                csv += &csv_row(&[], [Some(across), Some(up), self.cell(column, row)]);
            }
        }
        csv
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_lie_half_way_on_the_scale() {
        assert_eq!(edges(&Axis::linear("n"), &[1.0, 2.0, 4.0]), [0.5, 1.5, 3.0, 5.0]);
        assert_eq!(edges(&Axis::linear("n"), &[0.0]), [-0.5, 0.5]);
        assert_eq!(edges(&Axis::logarithmic("n"), &[1.0, 100.0]), [-1.0, 1.0, 3.0]);
        assert_eq!(edges(&Axis::logarithmic("n"), &[1e300]), [299.5, 300.5]);
    }
}
