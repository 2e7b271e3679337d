//! Curves against one axis: error or cost against the order, the time, or the mesh.

use super::axis::Mapping;
use super::drawing::Drawing;
use super::layout::{GUTTER, LEFT, Legend, RIGHT, Sheet, counted, fitted};
use super::marks::{self, draw_marks, placement_in, room_above};
use super::number::rounded;
use super::palette::COLOURS;
use super::text::{csv_field, csv_number, json_number};
use super::{Axis, Caption, Chart, PlotError, Scale};
use serde_json::{Value, json};

/// A line through points `(x, y)`, in their order.
#[derive(Clone, PartialEq, Debug)]
pub struct Curve {
    /// The name, as the legend gives it.
    pub name: String,
    /// The points; one that is not finite interrupts the line.
    pub points: Vec<(f64, f64)>,
}

/// A shaded rectangle; a side that is `None` lies at the edge of the picture.
#[derive(Clone, PartialEq, Debug)]
pub struct Region {
    /// From where to where across.
    pub x: (Option<f64>, Option<f64>),
    /// From where to where up.
    pub y: (Option<f64>, Option<f64>),
    /// What it means.
    pub name: String,
}

/// Several curves over one axis, with marked places, levels and a shaded region if wanted.
///
/// On a logarithmic upward axis, values of exactly zero stand at the lower edge, with an arrow. Under a
/// ceiling, what lies above it stands at the upper edge, with an arrow, infinite values as well.
/// Curves of at most forty points have a marker at each, longer ones a few.
///
/// # Invariants
/// At least one point is finite. All that is finite has a place on its axis, or is zero on a
/// logarithmic upward axis. Marked places, levels and sides of the region have a place on their
/// axis.
#[derive(Clone, PartialEq, Debug)]
pub struct Curves {
    title: String,
    x: Axis,
    y: Axis,
    curves: Vec<Curve>,
    region: Option<Region>,
    marks: Vec<(f64, String)>,
    levels: Vec<(f64, String)>,
    ceiling: Option<f64>,
    caption: Caption,
}

impl Curves {
    /// A chart of these curves.
    ///
    /// # Errors
    /// A finite value that has no place on its axis, or nothing finite to draw.
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
        Ok(Curves {
            title: title.to_owned(),
            x,
            y,
            curves,
            region: None,
            marks: Vec::new(),
            levels: Vec::new(),
            ceiling: None,
            caption,
        })
    }

    /// The same with a shaded region.
    ///
    /// # Errors
    /// A side without a place on its axis, or sides in the wrong order.
    pub fn region(mut self, region: Region) -> Result<Curves, PlotError> {
        for (axis, (from, to)) in [(&self.x, region.x), (&self.y, region.y)] {
            [from, to].into_iter().flatten().try_for_each(|side| checked(axis, side))?;
            if let (Some(from), Some(to)) = (from, to)
                && from >= to
            {
                return Err(PlotError::NotAscending { axis: axis.name.clone() });
            }
        }
        self.region = Some(region);
        Ok(self)
    }

    /// The same with a vertical line at `x`, labelled above the plotting area: an arrival, say.
    ///
    /// # Errors
    /// A value without a place on the axis.
    pub fn mark(mut self, x: f64, name: &str) -> Result<Curves, PlotError> {
        checked(&self.x, x)?;
        self.marks.push((x, name.to_owned()));
        Ok(self)
    }

    /// The same with a labelled horizontal line at `y`.
    ///
    /// # Errors
    /// A value without a place on the axis.
    pub fn level(mut self, y: f64, name: &str) -> Result<Curves, PlotError> {
        checked(&self.y, y)?;
        self.levels.push((y, name.to_owned()));
        Ok(self)
    }

    /// The same with an upward axis that ends at `y` where values lie above it, so that one curve that
    /// leaves the picture does not press the others together. Where none lies above, nothing changes.
    ///
    /// # Errors
    /// A value without a place on the axis.
    pub fn ceiling(mut self, y: f64) -> Result<Curves, PlotError> {
        checked(&self.y, y)?;
        self.ceiling = Some(y);
        Ok(self)
    }

    /// The curves.
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

    /// Whether a point has a place in the picture.
    fn is_drawn(&self, point: &(f64, f64)) -> bool {
        finite(point) || self.is_above(point)
    }

    fn left_out(&self) -> usize {
        self.points().filter(|point| !self.is_drawn(point)).count()
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

/// Refuses a value that is not finite as well as one without a place on the axis.
fn checked(axis: &Axis, value: f64) -> Result<(), PlotError> {
    match value.is_finite() {
        true => axis.check(value),
        false => Err(PlotError::TooLarge { what: format!("a value of \"{}\"", axis.name), value }),
    }
}

/// The places of the data in pixels.
struct Places {
    x: Mapping,
    y: Mapping,
    /// Whether zeros stand below the upward axis, and where.
    zero: Option<f64>,
    /// Whether points stand above the upward axis, and where.
    above: Option<f64>,
}

impl Places {
    fn new(chart: &Curves, sheet: &Sheet) -> Places {
        let points: Vec<&(f64, f64)> = chart.points().filter(|p| chart.is_drawn(p)).collect();
        let logarithmic = chart.y.scale == Scale::Logarithmic;
        let zero = logarithmic && points.iter().any(|point| point.1 == 0.0);
        let marks = chart.marks.iter().map(|mark| mark.0);
        let across = points.iter().map(|point| point.0).chain(marks);
        let levels = chart.levels.iter().map(|level| level.0);
        let above = chart.ceiling.filter(|_| points.iter().any(|point| chart.is_above(point)));
        let within = points.iter().filter(|point| !chart.is_above(point)).map(|point| point.1);
        let up = within.chain(levels).chain(above);
        let top = if above.is_some() { sheet.top + GUTTER } else { sheet.top };
        Places {
            x: fitted(chart.x.scale, across, (LEFT, RIGHT), false),
            y: fitted(chart.y.scale, up, (sheet.bottom(), top), zero),
            zero: zero.then_some(sheet.bottom() - GUTTER / 2.0),
            above: above.map(|_| sheet.top + GUTTER / 2.0),
        }
    }

    fn is_zero(&self, point: &(f64, f64)) -> bool {
        self.zero.is_some() && point.1 == 0.0
    }

    fn of(&self, chart: &Curves, point: &(f64, f64)) -> (f64, f64) {
        let zero = self.zero.filter(|_| point.1 == 0.0);
        let up = self.above.filter(|_| chart.is_above(point)).or(zero);
        (self.x.position(point.0), up.unwrap_or_else(|| self.y.position(point.1)))
    }

    /// The parts of a curve between its gaps.
    fn parts(&self, chart: &Curves, curve: &Curve) -> Vec<Vec<(f64, f64)>> {
        let parts = curve.points.split(|point| !chart.is_drawn(point));
        let parts = parts.filter(|part| !part.is_empty());
        parts.map(|part| part.iter().map(|point| self.of(chart, point)).collect()).collect()
    }
}

/// The horizontal lines with their labels, where the curves leave room; how many found none.
fn draw_levels(chart: &Curves, sheet: &mut Sheet, places: &Places) -> usize {
    let mut placement = placement_in(sheet, &chart.marks, &places.x);
    for curve in &chart.curves {
        places.parts(chart, curve).iter().for_each(|part| placement.avoid(part));
    }
    marks::draw_levels(&chart.levels, sheet, &places.y, &mut placement)
}

fn draw_region(region: &Region, sheet: &mut Sheet, places: &Places) {
    let (top, bottom) = (sheet.top, sheet.bottom());
    let side = |value: Option<f64>, mapping: &Mapping, edge: f64, low: f64, high: f64| {
        value.map_or(edge, |value| mapping.position(value).clamp(low, high))
    };
    let left = side(region.x.0, &places.x, LEFT, LEFT, RIGHT);
    let right = side(region.x.1, &places.x, RIGHT, LEFT, RIGHT);
    let low = side(region.y.0, &places.y, bottom, top, bottom);
    let high = side(region.y.1, &places.y, top, top, bottom);
    sheet.drawing.rectangle("region", (left, high), (right, low));
}

/// An arrow away from a marker, `down` or up.
fn arrow(drawing: &mut Drawing, line: usize, at: (f64, f64), down: bool) {
    let mut arrow = Drawing::default();
    let path = match down {
        true => "M0 6V14M-3.5 10.5L0 14L3.5 10.5",
        false => "M0 -6V-14M-3.5 -10.5L0 -14L3.5 -10.5",
    };
    arrow.path(&format!("arrow c{}", line % COLOURS.len()), path);
    drawing.moved(at, &arrow);
}

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

    fn caption(&self) -> &Caption {
        &self.caption
    }

    fn svg_named(&self, name: &str) -> String {
        // How many rows of labels stand above depends on places across alone.
        let across = Places::new(self, &Sheet::open(name, &self.title, 0.0)).x;
        let above = room_above(&self.marks, &across);
        let mut sheet = Sheet::open(name, &self.title, above);
        let places = Places::new(self, &sheet);
        let mut legend = Legend::default();
        if let Some(region) = &self.region {
            draw_region(region, &mut sheet, &places);
        }
        sheet.grid(&places.x, &places.y);
        draw_marks(&self.marks, &mut sheet, &places.x);
        let unlabelled = draw_levels(self, &mut sheet, &places);
        for (i, curve) in self.curves.iter().enumerate() {
            places.parts(self, curve).iter().for_each(|part| sheet.drawing.stroke(i, part));
        }
        for (i, curve) in self.curves.iter().enumerate() {
            let points: Vec<&(f64, f64)> =
                curve.points.iter().filter(|point| self.is_drawn(point)).collect();
            for point in marked(i, points.len()).map(|at| points[at]) {
                let (x, y) = places.of(self, point);
                let above = self.is_above(point);
                if above || places.is_zero(point) {
                    arrow(&mut sheet.drawing, i, (x, y), !above);
                }
                let about = format!("{}: {} at {}", curve.name, rounded(point.1), rounded(point.0));
                sheet.drawing.marker(i, (x, y), &about);
            }
            legend.entry(curve.name.clone(), |sample| {
                sample.stroke(i, &[(0.0, 0.0), (30.0, 0.0)]);
                sample.marker(i, (15.0, 0.0), "");
            });
        }
        sheet.axes((&self.x, &places.x), (&self.y, &places.y));
        if let Some(region) = &self.region {
            legend.entry(region.name.clone(), |sample| {
                sample.rectangle("region", (0.0, -6.0), (30.0, 6.0));
            });
        }
        if places.zero.is_some() {
            sheet.zero(false);
            legend.entry("exactly zero", |sample| {
                arrow(sample, 3, (15.0, -6.0), true);
                sample.marker(3, (15.0, -6.0), "");
            });
        }
        if let Some(ceiling) = self.ceiling.filter(|_| places.above.is_some()) {
            let (parting, count) = (sheet.top + GUTTER, self.points().filter(|p| self.is_above(p)));
            sheet.drawing.line("rule-across", (LEFT, parting), (RIGHT, parting));
            let count = count.count();
            let points = if count == 1 { "point" } else { "points" };
            let text = format!("off the scale: above {} ({count} {points})", rounded(ceiling));
            legend.entry(text, |sample| {
                arrow(sample, 3, (15.0, 6.0), false);
                sample.marker(3, (15.0, 6.0), "");
            });
        }
        let top = sheet.top;
        sheet.legend(&legend, top);
        sheet.close(&self.title, &self.description(), &self.caption, &self.remarks(unlabelled))
    }

    fn json(&self) -> Value {
        let number = |value: f64| json_number(Some(value));
        let point = |&(x, y): &(f64, f64)| json!([number(x), number(y)]);
        let curve = |curve: &Curve| {
            let points: Vec<Value> = curve.points.iter().map(point).collect();
            json!({"name": curve.name, "points": points})
        };
        let named = |key: &str, lines: &[(f64, String)]| -> Vec<Value> {
            lines.iter().map(|(at, name)| json!({key: number(*at), "name": name})).collect()
        };
        let region = self.region.as_ref().map(|region| {
            json!({
                "x": [region.x.0, region.x.1],
                "y": [region.y.0, region.y.1],
                "name": region.name,
            })
        });
        let mut value = json!({
            "kind": "curves",
            "title": self.title,
            "caption": self.caption.json(),
            "x": self.x.json(),
            "y": self.y.json(),
            "curves": self.curves.iter().map(curve).collect::<Vec<_>>(),
            "region": region,
            "marks": named("x", &self.marks),
            "levels": named("y", &self.levels),
            "left_out": self.left_out(),
        });
        if let Some(ceiling) = self.ceiling {
            value["ceiling"] = number(ceiling);
        }
        value
    }

    fn csv(&self) -> String {
        let (x, y) = (csv_field(&self.x.label()), csv_field(&self.y.label()));
        let mut csv = format!("curve,{x},{y}\n");
        for curve in &self.curves {
            for &(across, up) in &curve.points {
                let numbers = [Some(across), Some(up)].map(csv_number);
                csv.push_str(&format!("{},{}\n", csv_field(&curve.name), numbers.join(",")));
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
