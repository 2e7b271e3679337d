//! A picture in the making: the few shapes of SVG that charts need.

use super::palette::{COLOURS, DASHES, MARKERS};
use super::text::escape;
use std::fmt::Write;

pub(super) const WIDTH: f64 = 900.0;

/// The size of the small print in pixels; nothing is smaller.
pub(super) const SMALL: f64 = 11.0;

pub(super) const MEDIUM: f64 = 12.0;

pub(super) const LARGE: f64 = 17.0;

/// Where a text stands about its place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Shapes in the order in which they are drawn, each after those behind it.
///
/// Equal calls give equal bytes; places are rounded to hundredths of a pixel.
#[derive(Default)]
pub(super) struct Drawing {
    body: String,
    /// Rules of this picture besides those of all.
    rules: String,
    /// Patterns of this picture besides those of all.
    patterns: String,
}

/// A coordinate rounded to hundredths, without needless zeros.
pub(super) fn coordinate(value: f64) -> String {
    let hundredths = (value * 100.0).round() / 100.0;
    // Adding zero turns a negative zero into zero.
    format!("{}", hundredths + 0.0)
}

/// A class and the class of the colour of a line.
pub(super) fn coloured(class: &str, line: usize) -> String {
    format!("{class} c{}", line % COLOURS.len())
}

/// The outline through points, closed: "M x y L x y … z".
pub(super) fn polygon(points: &[(f64, f64)]) -> String {
    polyline(points) + "z"
}

/// The outline through points: "M x y L x y …".
pub(super) fn polyline(points: &[(f64, f64)]) -> String {
    let mut path = String::new();
    for (i, &(x, y)) in points.iter().enumerate() {
        let letter = if i == 0 { 'M' } else { 'L' };
        let _ = write!(path, "{letter}{} {}", coordinate(x), coordinate(y));
    }
    path
}

impl Drawing {
    /// Adds rules for classes that this kind of picture alone has.
    pub fn style(&mut self, rules: &str) {
        self.rules.push_str(rules);
    }

    /// Adds a pattern that this picture alone has.
    pub fn pattern(&mut self, pattern: &str) {
        self.patterns.push_str(pattern);
    }

    pub fn line(&mut self, class: &str, from: (f64, f64), to: (f64, f64)) {
        self.path(class, &polyline(&[from, to]));
    }

    pub fn path(&mut self, class: &str, path: &str) {
        let _ = writeln!(self.body, "<path class=\"{class}\" d=\"{path}\"/>");
    }

    /// An outline filled with one colour, which is the same in light and dark.
    pub fn fill(&mut self, colour: &str, path: &str) {
        let _ = writeln!(self.body, "<path class=\"cell\" fill=\"{colour}\" d=\"{path}\"/>");
    }

    /// An outline filled with a pattern.
    pub fn fill_with(&mut self, pattern: &str, path: &str) {
        let _ = writeln!(self.body, "<path fill=\"url(#{pattern})\" d=\"{path}\"/>");
    }

    pub fn rectangle(&mut self, class: &str, corner: (f64, f64), other: (f64, f64)) {
        let (left, top) = (corner.0.min(other.0), corner.1.min(other.1));
        let (wide, high) = ((corner.0 - other.0).abs(), (corner.1 - other.1).abs());
        let [left, top, wide, high] = [left, top, wide, high].map(coordinate);
        let _ = writeln!(
            self.body,
            "<rect class=\"{class}\" x=\"{left}\" y=\"{top}\" width=\"{wide}\" height=\"{high}\"/>"
        );
    }

    /// A text on its base line.
    pub fn text(&mut self, class: &str, anchor: Anchor, (x, y): (f64, f64), text: &str) {
        let (x, y) = (coordinate(x), coordinate(y));
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let text = escape(text);
        let _ = writeln!(
            self.body,
            "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{text}</text>"
        );
    }

    pub fn text_upwards(&mut self, class: &str, (x, y): (f64, f64), text: &str) {
        let (x, y) = (coordinate(x), coordinate(y));
        let text = escape(text);
        let _ = writeln!(
            self.body,
            "<text class=\"{class}\" transform=\"translate({x} {y}) rotate(-90)\" \
             text-anchor=\"middle\">{text}</text>"
        );
    }

    /// The marker of a line; pointing at it shows `about`, if it says anything.
    pub fn marker(&mut self, line: usize, (x, y): (f64, f64), about: &str) {
        let class = coloured("marker", line);
        let outline = MARKERS[line % MARKERS.len()];
        let (x, y) = (coordinate(x), coordinate(y));
        let title = match about.is_empty() {
            true => String::new(),
            false => format!("<title>{}</title>", escape(about)),
        };
        let _ = writeln!(
            self.body,
            "<path class=\"{class}\" transform=\"translate({x} {y})\" d=\"{outline}\">{title}</path>"
        );
    }

    pub fn stroke(&mut self, class: &str, line: usize, points: &[(f64, f64)]) {
        if points.len() > 1 {
            let dash = line % DASHES.len();
            self.path(&format!("{} d{dash}", coloured(class, line)), &polyline(points));
        }
    }

    /// An outline about a point in the colour of a line: an arrow or a ring.
    pub fn sign(&mut self, class: &str, line: usize, at: (f64, f64), path: &str) {
        let mut sign = Drawing::default();
        sign.path(&coloured(class, line), path);
        self.moved(at, &sign);
    }

    /// What `other` draws, moved.
    pub fn moved(&mut self, (x, y): (f64, f64), other: &Drawing) {
        let (x, y) = (coordinate(x), coordinate(y));
        let _ = write!(self.body, "<g transform=\"translate({x} {y})\">\n{}</g>\n", other.body);
    }

    /// The whole picture. The `name` is unique in its document: letters, digits and hyphens.
    pub fn finish(self, name: &str, height: f64, title: &str, description: &str) -> String {
        let height = coordinate(height.ceil());
        let (title, description) = (escape(title), escape(description));
        let mut style = STYLE.to_owned() + &self.rules;
        for (i, colour) in COLOURS.iter().enumerate() {
            let _ = write!(style, ".plot .c{i}{{color:{colour}}}");
        }
        for (i, dash) in DASHES.iter().enumerate() {
            let _ = write!(style, ".plot .d{i}{{stroke-dasharray:{dash}}}");
        }
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" \
             width=\"{WIDTH}\" height=\"{height}\" \
             viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" \
             aria-labelledby=\"{name}-title {name}-description\">\n\
             <title id=\"{name}-title\">{title}</title>\n\
             <desc id=\"{name}-description\">{description}</desc>\n\
             <style>{style}{DARK}</style>\n\
             <defs>\
             <pattern id=\"{name}-refused\" width=\"7\" height=\"7\" \
             patternUnits=\"userSpaceOnUse\">\
             <path class=\"hatch\" d=\"M-1 1L1 -1M0 7L7 0M6 8L8 6\"/></pattern>\
             <pattern id=\"{name}-infinite\" width=\"6\" height=\"6\" \
             patternUnits=\"userSpaceOnUse\">\
             <path class=\"cross\" d=\"M0 0L6 6M6 0L0 6\"/></pattern>{}</defs>\n\
             <rect class=\"paper\" width=\"{WIDTH}\" height=\"{height}\"/>\n{}</svg>\n",
            self.patterns, self.body
        )
    }
}

/// How the classes look. Several pictures in one page repeat the same rules.
const STYLE: &str = "\
.plot{font-family:system-ui,'Segoe UI',Helvetica,Arial,'DejaVu Sans',sans-serif}\
.plot text{font-size:12px;fill:#222}\
.plot .title{font-size:17px;font-weight:600}\
.plot .small{font-size:11px;fill:#4a4a4a}\
.plot .label{font-size:11px;stroke:#fff;stroke-width:3px;paint-order:stroke;stroke-linejoin:round}\
.plot .paper{fill:#fff}\
.plot .frame{fill:none;stroke:#444}\
.plot .tick{fill:none;stroke:#444}\
.plot .grid{fill:none;stroke:#e4e4e4}\
.plot .line{fill:none;stroke:currentColor;stroke-width:1.8;stroke-linejoin:round}\
.plot .bound{fill:none;stroke:currentColor;stroke-width:1.1}\
.plot .marker{fill:currentColor;stroke:#fff;stroke-width:1}\
.plot .arrow{fill:none;stroke:currentColor;stroke-width:1.6}\
.plot .frontier{fill:none;stroke:#a6a6a6;stroke-width:5;stroke-linejoin:round;opacity:.6}\
.plot .region{fill:#8c8c8c;fill-opacity:.2;stroke:none}\
.plot .rule{fill:none;stroke:#555;stroke-width:1.1}\
.plot .rule-across{fill:none;stroke:#555;stroke-width:1.1;stroke-dasharray:6 3}\
.plot .cell{stroke:none;shape-rendering:crispEdges}\
.plot .hatch{fill:none;stroke:#9a9a9a;stroke-width:1.3}\
.plot .cross{fill:none;stroke:#444;stroke-width:1}\
.plot .refused{fill:#ececec}\
.plot .casing{fill:none;stroke:#fff;stroke-width:4.6;stroke-linecap:round;stroke-linejoin:round}\
.plot .level{fill:none;stroke:#000;stroke-width:2;stroke-linejoin:round}";

/// What differs on dark paper; print stays light.
const DARK: &str = "\
@media screen and (prefers-color-scheme:dark){\
.plot text{fill:#e8e8e8}.plot .small{fill:#b9bcc2}.plot .paper{fill:#17191d}\
.plot .label{stroke:#17191d}.plot .marker{stroke:#17191d}\
.plot .frame,.plot .tick{stroke:#9aa0a8}.plot .grid{stroke:#2c3036}\
.plot .frontier{stroke:#6d737b}.plot .region{fill:#a0a6ae}\
.plot .rule,.plot .rule-across{stroke:#a9afb8}\
.plot .refused{fill:#2a2d33}.plot .hatch{stroke:#757b84}.plot .cross{stroke:#c6cad0}\
.plot .c3{color:#fff}}";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_rounded() {
        for (value, text) in
            [(1.005_4, "1.01"), (-0.001, "0"), (12.0, "12"), (0.1 + 0.2, "0.3"), (-2.5, "-2.5")]
        {
            assert_eq!(coordinate(value), text);
        }
        assert_eq!(polyline(&[(0.0, 1.0), (2.345, 3.0)]), "M0 1L2.35 3");
    }

    #[test]
    fn black_turns_white_on_dark_paper() {
        assert_eq!(COLOURS[3], "#000000");
        assert!(DARK.contains(".c3{color:#fff}"));
    }
}
