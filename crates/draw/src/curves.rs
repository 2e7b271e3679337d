//! Curves against one axis: error or cost against the order, the time, or the mesh.

use super::axis::Mapping;
use super::drawing::{coloured, polygon};
use super::layout::{GUTTER, LEFT, Legend, RIGHT, Sheet, counted, fitted};
use super::marks::{self, placement_in};
use super::number::rounded;
use super::text::{csv_field, csv_row, json_number, json_places, json_points};
use super::{Axis, Caption, Chart, PlotError, Scale};
use serde_json::{Value, json};

/// A line through points `(x, y)`, in their order.
#[derive(Clone, PartialEq, Debug)]
pub struct Curve {
    pub name: String,
    /// The points; one that is not finite interrupts the line.
    pub points: Vec<(f64, f64)>,
}

/// Several curves over one axis, with levels if wanted.
///
/// On a logarithmic upward axis, values of exactly zero, or below a floor, stand at the lower edge, with an arrow. Under a
/// ceiling, what lies above it stands at the upper edge, with an arrow, infinite values as well.
/// Curves of at most forty points have a marker at each, longer ones a few.
///
/// # Invariants
/// At least one point is finite. All that is finite has a place on its axis, or is zero on a
/// logarithmic upward axis. Levels have a place on their axis.
#[derive(Clone, PartialEq, Debug)]
pub struct Curves {
    title: String,
    x: Axis,
    y: Axis,
    curves: Vec<Curve>,
    levels: Vec<(f64, String)>,
    ceiling: Option<f64>,
    floor: Option<f64>,
    /// Whether the region above each curve has its colour, as far as no curve before it has taken it.
    are_borders: bool,
    caption: Caption,
}

impl Curves {
    pub fn new(
        title: &str,
        x: Axis,
        y: Axis,
        curves: Vec<Curve>,
        caption: Caption,
    ) -> Result<Curves, PlotError> {
        for &(across, up) in curves.iter().flat_map(|curve| &curve.points) {
            x.check(across)?;
            if up != 0.0 {
                y.check(up)?;
            }
        }
        if !curves.iter().flat_map(|curve| &curve.points).any(finite) {
            return Err(PlotError::Empty { title: title.to_owned() });
        }
        let (title, levels) = (title.to_owned(), Vec::new());
        Ok(Curves {
            title,
            x,
            y,
            curves,
            levels,
            ceiling: None,
            floor: None,
            are_borders: false,
            caption,
        })
    }

    /// The same with a labelled horizontal line at `y`.
    pub fn level(mut self, y: f64, name: &str) -> Result<Curves, PlotError> {
        self.y.check_finite(y)?;
        self.levels.push((y, name.to_owned()));
        Ok(self)
    }

    /// The same with an upward axis that ends at `y` where values lie above it, so that one curve that
    /// leaves the picture does not press the others together. Where none lies above, nothing changes.
    pub fn ceiling(mut self, y: f64) -> Result<Curves, PlotError> {
        self.y.check_finite(y)?;
        self.ceiling = Some(y);
        Ok(self)
    }

    /// The same with a logarithmic upward axis on which what lies below `y` stands where exact zeros do.
    pub fn floor(mut self, y: f64) -> Result<Curves, PlotError> {
        assert_eq!(self.y.scale, Scale::Logarithmic, "a floor needs a logarithmic axis");
        self.y.check(y)?;
        self.floor = Some(y);
        Ok(self)
    }

    /// The same as a map: the region above a curve, as far as no curve before it has taken it, has the colour of the
    /// curve.
    pub fn borders(mut self) -> Curves {
        self.are_borders = true;
        self
    }

    pub fn curves(&self) -> &[Curve] {
        &self.curves
    }

    fn points(&self) -> impl Iterator<Item = &(f64, f64)> {
        self.curves.iter().flat_map(|curve| &curve.points)
    }

    /// Whether a point stands at the upper edge, above the ceiling.
    fn is_above(&self, point: &(f64, f64)) -> bool {
        point.0.is_finite() && self.ceiling.is_some_and(|ceiling| point.1 > ceiling)
    }

    /// Whether a point stands at the lower edge of a logarithmic axis.
    fn is_below(&self, point: &(f64, f64)) -> bool {
        self.y.scale == Scale::Logarithmic
            && (point.1 == 0.0 || self.floor.is_some_and(|floor| point.1 < floor))
    }

    /// Whether a point has a place in the picture.
    fn is_drawn(&self, point: &(f64, f64)) -> bool {
        finite(point) || self.is_above(point)
    }

    fn left_out(&self) -> usize {
        // What has no place across only interrupts a line.
        self.points().filter(|point| point.0.is_finite() && !self.is_drawn(point)).count()
    }

    fn description(&self) -> String {
        let names: Vec<&str> = self.curves.iter().map(|curve| curve.name.as_str()).collect();
        let (x, y) = (self.x.label(), self.y.label());
        format!("{y} (up) against {x} (across): {}.", names.join("; "))
    }

    fn remarks(&self, unlabelled: usize) -> Vec<String> {
        let mut remarks = Vec::new();
        if self.left_out() > 0 {
            let points = counted(self.left_out(), "point", "points");
            remarks.push(format!("{points} not finite and left out."));
        }
        if unlabelled > 0 {
            let levels = counted(unlabelled, "level", "levels");
            remarks.push(format!("{levels} not labelled for want of room."));
        }
        remarks
    }
}

fn finite(point: &(f64, f64)) -> bool {
    point.0.is_finite() && point.1.is_finite()
}

/// The places of the data in pixels.
struct Places {
    x: Mapping,
    y: Mapping,
    /// Whether points stand below the upward axis, and where.
    below: Option<f64>,
    /// Whether points stand above the upward axis, and where.
    above: Option<f64>,
}

impl Places {
    fn new(chart: &Curves, sheet: &Sheet) -> Places {
        let points: Vec<&(f64, f64)> = chart.points().filter(|p| chart.is_drawn(p)).collect();
        let is_below = |point: &(f64, f64)| chart.is_below(point);
        let has_below = points.iter().any(|point| is_below(point));
        let across = points.iter().map(|point| point.0);
        let levels = chart.levels.iter().map(|level| level.0);
        let above = chart.ceiling.filter(|_| points.iter().any(|point| chart.is_above(point)));
        let is_within = |point: &&&(f64, f64)| !chart.is_above(point) && !is_below(point);
        let within = points.iter().filter(is_within).map(|point| point.1);
        let up = within.chain(levels).chain(above);
        let top = if above.is_some() { sheet.top + GUTTER } else { sheet.top };
        Places {
            x: fitted(chart.x.scale, across, (LEFT, RIGHT), false),
            y: fitted(chart.y.scale, up, (sheet.bottom(), top), has_below),
            below: has_below.then_some(sheet.bottom() - GUTTER / 2.0),
            above: above.map(|_| sheet.top + GUTTER / 2.0),
        }
    }

    fn of(&self, chart: &Curves, point: &(f64, f64)) -> (f64, f64) {
        let below = self.below.filter(|_| chart.is_below(point));
        let up = self.above.filter(|_| chart.is_above(point)).or(below);
        (self.x.position(point.0), up.unwrap_or_else(|| self.y.position(point.1)))
    }

    /// The parts of a curve between its gaps.
    fn parts(&self, chart: &Curves, curve: &Curve) -> Vec<Vec<(f64, f64)>> {
        let parts = curve.points.split(|point| !chart.is_drawn(point));
        let parts = parts.filter(|part| !part.is_empty());
        parts.map(|part| part.iter().map(|point| self.of(chart, point)).collect()).collect()
    }
}

/// The regions above the curves, the first curve last, so that it covers those of all others.
fn draw_regions(chart: &Curves, sheet: &mut Sheet, places: &Places) {
    let top = places.above.map_or(sheet.top, |_| sheet.top + GUTTER);
    for (i, curve) in chart.curves.iter().enumerate().rev() {
        for part in places.parts(chart, curve) {
            let [first, .., last] = part[..] else { continue };
            let mut outline: Vec<_> = part.iter().map(|(x, y)| (*x, y.max(top))).collect();
            outline.extend([(last.0, top), (first.0, top)]);
            sheet.drawing.path("paper", &polygon(&outline));
            sheet.drawing.path(&coloured("tint", i), &polygon(&outline));
        }
    }
}

/// The horizontal lines with their labels, where the curves leave room; how many found none.
fn draw_levels(chart: &Curves, sheet: &mut Sheet, places: &Places) -> usize {
    let mut placement = placement_in(sheet, &[], &places.x);
    for curve in &chart.curves {
        places.parts(chart, curve).iter().for_each(|part| placement.avoid(part));
    }
    marks::draw_levels(&chart.levels, sheet, &places.y, &mut placement)
}

/// Arrows away from a marker.
const DOWN: &str = "M0 6V14M-3.5 10.5L0 14L3.5 10.5";
const UP: &str = "M0 -6V-14M-3.5 -10.5L0 -14L3.5 -10.5";

/// The points of a curve that take a marker: all of a short one, about eight of a long one, which
/// begin later from line to line so that markers of close curves do not hide one another.
fn marked(line: usize, count: usize) -> impl Iterator<Item = usize> {
    let every = if count <= 40 { 1 } else { count.div_ceil(8) };
    let first = if every == 1 { 0 } else { (line * every / 5 + every / 4) % every };
    (first..count).step_by(every)
}

impl Chart for Curves {
    fn title(&self) -> &str {
        &self.title
    }

    fn svg_named(&self, name: &str) -> String {
        let mut sheet = Sheet::open(name, &self.title, 0.0);
        let places = Places::new(self, &sheet);
        let mut legend = Legend::default();
        if self.are_borders {
            sheet.drawing.style(".plot .tint{fill:currentColor;fill-opacity:.22;stroke:none}");
            draw_regions(self, &mut sheet, &places);
        }
        sheet.grid(&places.x, &places.y);
        let unlabelled = draw_levels(self, &mut sheet, &places);
        for (i, curve) in self.curves.iter().enumerate() {
            places.parts(self, curve).iter().for_each(|part| sheet.drawing.stroke("line", i, part));
        }
        for (i, curve) in self.curves.iter().enumerate() {
            let points: Vec<&(f64, f64)> =
                curve.points.iter().filter(|point| self.is_drawn(point)).collect();
            for point in marked(i, points.len()).map(|at| points[at]) {
                let (x, y) = places.of(self, point);
                if self.is_above(point) {
                    sheet.drawing.sign("arrow", i, (x, y), UP);
                } else if self.is_below(point) {
                    sheet.drawing.sign("arrow", i, (x, y), DOWN);
                }
                let about = format!("{}: {} at {}", curve.name, rounded(point.1), rounded(point.0));
                sheet.drawing.marker(i, (x, y), &about);
            }
            legend.line(&curve.name, i);
        }
        sheet.axes((&self.x, &places.x), (&self.y, &places.y));
        if places.below.is_some() {
            let [label, text] = match self.floor {
                None => ["0", "exactly zero"].map(str::to_owned),
                Some(floor) => {
                    [format!("< {}", rounded(floor)), format!("below {}", rounded(floor))]
                }
            };
            sheet.beyond(false, &label);
            legend.entry(text, |sample| {
                sample.sign("arrow", 3, (15.0, -6.0), DOWN);
                sample.marker(3, (15.0, -6.0), "");
            });
        }
        if let Some(ceiling) = self.ceiling.filter(|_| places.above.is_some()) {
            let parting = sheet.top + GUTTER;
            sheet.drawing.line("rule-across", (LEFT, parting), (RIGHT, parting));
            let count = self.points().filter(|point| self.is_above(point)).count();
            let points = if count == 1 { "point" } else { "points" };
            let text = format!("off the scale: above {} ({count} {points})", rounded(ceiling));
            legend.entry(text, |sample| {
                sample.sign("arrow", 3, (15.0, 6.0), UP);
                sample.marker(3, (15.0, 6.0), "");
            });
        }
        sheet.legend(&legend, sheet.top);
        sheet.close(&self.title, &self.description(), &self.caption, &self.remarks(unlabelled))
    }

    fn json(&self) -> Value {
        let curve =
            |curve: &Curve| json!({"name": curve.name, "points": json_points(&curve.points)});
        let mut value = json!({
            "kind": "curves",
            "title": self.title,
            "caption": self.caption.json(),
            "x": self.x.json(),
            "y": self.y.json(),
            "curves": self.curves.iter().map(curve).collect::<Vec<_>>(),
            "levels": json_places("y", &self.levels),
            "left_out": self.left_out(),
        });
        if let Some(ceiling) = self.ceiling {
            value["ceiling"] = json_number(Some(ceiling));
        }
        if let Some(floor) = self.floor {
            value["floor"] = json_number(Some(floor));
        }
        if self.are_borders {
            value["borders"] = json!(true);
        }
        value
    }

    fn csv(&self) -> String {
        let (x, y) = (csv_field(&self.x.label()), csv_field(&self.y.label()));
        let mut csv = format!("curve,{x},{y}\n");
        for curve in &self.curves {
            for &(across, up) in &curve.points {
                csv += &csv_row(&[&curve.name], [Some(across), Some(up)]);
            }
        }
        csv
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_curves_have_few_markers() {
        assert_eq!(marked(3, 40).count(), 40);
        for line in 0..9 {
            let count = marked(line, 1000).count();
            assert!((7..=8).contains(&count), "{count}");
        }
        assert_ne!(marked(0, 1000).next(), marked(1, 1000).next());
    }
}
