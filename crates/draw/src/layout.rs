//! The sheet that all charts share: title, axes, legend beside the plotting area, small print
//! below.

use super::axis::{Axis, Mapping, Tick};
use super::drawing::{Anchor, Drawing, LARGE, MEDIUM, SMALL, WIDTH, polygon};
use super::text::{width, wrap};
use super::{Caption, Scale};

pub(super) const LEFT: f64 = 88.0;

/// The right edge of the plotting area beside a legend.
pub(super) const RIGHT: f64 = 650.0;

pub(super) const HEIGHT: f64 = 420.0;

/// The room beside a logarithmic axis in which values of exactly zero stand.
pub(super) const GUTTER: f64 = 34.0;

/// The right edge of the plotting area where nothing stands beside it: half of a tick's label may.
const FAR_RIGHT: f64 = WIDTH - 24.0;

/// How far the legend is from the plotting area, and its texts from where it begins.
const BESIDE: f64 = 22.0;
const INDENT: f64 = 38.0;

const MARGIN: f64 = 14.0;

/// The line of a sample in a legend.
pub(super) const SAMPLE: [(f64, f64); 2] = [(0.0, 0.0), (30.0, 0.0)];

/// The entries beside the plotting area: a sample, drawn from 0 to 30 across about the height 0,
/// and what it means.
#[derive(Default)]
pub(super) struct Legend {
    entries: Vec<(Drawing, String)>,
}

impl Legend {
    pub fn entry(&mut self, text: impl Into<String>, draw: impl FnOnce(&mut Drawing)) {
        let mut sample = Drawing::default();
        draw(&mut sample);
        self.entries.push((sample, text.into()));
    }

    /// The entry of a line with markers.
    pub fn line(&mut self, text: &str, line: usize) {
        self.entry(text, |sample| {
            sample.stroke("line", line, &SAMPLE);
            sample.marker(line, (15.0, 0.0), "");
        });
    }

    /// The entries of another legend after these.
    pub fn append(&mut self, other: Legend) {
        self.entries.extend(other.entries);
    }

    /// The right edge of a plotting area that leaves room for these entries.
    pub fn right(&self) -> f64 {
        let widths = self.entries.iter().map(|(_, text)| width(text, MEDIUM));
        match widths.reduce(f64::max) {
            None => FAR_RIGHT,
            Some(widest) => (WIDTH - MARGIN - BESIDE - INDENT - widest).max(RIGHT),
        }
    }
}

/// A sheet while it is drawn on.
pub(super) struct Sheet {
    pub drawing: Drawing,
    /// The upper edge of the plotting area.
    pub top: f64,
    /// The right edge of the plotting area.
    pub right: f64,
    /// The prefix of identifiers.
    pub name: String,
    height: f64,
    /// The lowest place drawn on so far.
    lowest: f64,
}

impl Sheet {
    /// A sheet with its title, and `above` pixels left free between it and the plotting area.
    pub fn open(name: &str, title: &str, above: f64) -> Sheet {
        let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '-' };
        let mut drawing = Drawing::default();
        let mut y = 10.0;
        // Titles are bold, and so up to 15 % wider.
        for line in wrap(title, (WIDTH - 2.0 * MARGIN) / 1.15, LARGE) {
            y += 1.3 * LARGE;
            drawing.text("title", Anchor::Start, (MARGIN, y - 3.0), &line);
        }
        let top = y + 14.0 + above;
        let name = name.chars().map(plain).collect();
        Sheet { drawing, top, right: RIGHT, name, height: HEIGHT, lowest: top + HEIGHT }
    }

    /// The same with a plotting area of another height.
    pub fn resized(mut self, height: f64) -> Sheet {
        self.lowest += height - self.height;
        self.height = height;
        self
    }

    /// The same with another right edge of the plotting area.
    pub fn reaching(self, right: f64) -> Sheet {
        Sheet { right, ..self }
    }

    /// Goes on below all that is drawn, after a gap, with another plotting area of the same height.
    pub fn next_area(&mut self, gap: f64) {
        self.top = self.lowest + gap;
        self.lowest = self.top + self.height;
    }

    /// The upper edge of a strip below all that is drawn, and takes it.
    pub fn strip_below(&mut self, height: f64) -> f64 {
        let top = self.lowest;
        self.lowest += height;
        top
    }

    /// The lower edge of the plotting area.
    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// A line from the lower to the upper edge.
    pub fn upright(&mut self, class: &str, x: f64) {
        self.drawing.line(class, (x, self.top), (x, self.bottom()));
    }

    /// Lines behind the data at the labelled ticks.
    pub fn grid(&mut self, x: &Mapping, y: &Mapping) {
        for tick in ticks_across(x, self.right - LEFT).iter().filter(|tick| tick.label.is_some()) {
            self.upright("grid", tick.position);
        }
        for tick in y.ticks(SPACING.1).iter().filter(|tick| tick.label.is_some()) {
            self.drawing.line("grid", (LEFT, tick.position), (self.right, tick.position));
        }
    }

    /// Frame, ticks, labels and names of the axes. Ticks point outwards.
    pub fn axes(&mut self, x: (&Axis, &Mapping), y: (&Axis, &Mapping)) {
        self.frame(x.1, y.1, true);
        let bottom = self.bottom();
        let centre = f64::midpoint(LEFT, self.right);
        let mut base = bottom + 24.0;
        for line in wrap(&x.0.label(), self.right - LEFT, MEDIUM) {
            base += 1.35 * MEDIUM;
            self.drawing.text("", Anchor::Middle, (centre, base), &line);
        }
        self.reach(base + 4.0);
        self.name_upwards(y.0);
    }

    /// The same without labels and name across, above an area that has them.
    pub fn axes_above_others(&mut self, x: &Mapping, y: (&Axis, &Mapping)) {
        self.frame(x, y.1, false);
        self.name_upwards(y.0);
    }

    fn frame(&mut self, x: &Mapping, y: &Mapping, labelled: bool) {
        let bottom = self.bottom();
        self.drawing.rectangle("frame", (LEFT, self.top), (self.right, bottom));
        for tick in ticks_across(x, self.right - LEFT) {
            let end = bottom + tick.length();
            self.drawing.line("tick", (tick.position, bottom), (tick.position, end));
            if let Some(label) = tick.label.filter(|_| labelled) {
                self.drawing.text("", Anchor::Middle, (tick.position, bottom + 20.0), &label);
            }
        }
        for tick in y.ticks(SPACING.1) {
            let end = LEFT - tick.length();
            self.drawing.line("tick", (LEFT, tick.position), (end, tick.position));
            if let Some(label) = tick.label {
                self.drawing.text("", Anchor::End, (LEFT - 9.0, tick.position + 4.0), &label);
            }
        }
    }

    fn name_upwards(&mut self, axis: &Axis) {
        // A long name of the upward axis takes two columns at most before it runs past the frame.
        let lines = wrap(&axis.label(), self.height, MEDIUM);
        for (i, line) in lines.iter().enumerate() {
            let across = 19.0 + 1.3 * MEDIUM * i as f64;
            let up = f64::midpoint(self.top, self.bottom());
            self.drawing.text_upwards("", (across, up), line);
        }
    }

    /// The tick of what lies left of or below a logarithmic axis, such as exact zeros, and the line that parts it off.
    pub fn beyond(&mut self, across: bool, label: &str) {
        let bottom = self.bottom();
        let (from, to, end, anchor) = match across {
            true => {
                let x = LEFT + GUTTER / 2.0;
                self.upright("rule-across", LEFT + GUTTER);
                ((x, bottom), (x, bottom + 6.0), (x, bottom + 20.0), Anchor::Middle)
            }
            false => {
                let y = bottom - GUTTER / 2.0;
                let parting = bottom - GUTTER;
                self.drawing.line("rule-across", (LEFT, parting), (self.right, parting));
                ((LEFT, y), (LEFT - 6.0, y), (LEFT - 9.0, y + 4.0), Anchor::End)
            }
        };
        self.drawing.line("tick", from, to);
        self.drawing.text("", anchor, end, label);
    }

    /// A label by its left upper corner; how many found no place, 0 or 1.
    pub fn label(&mut self, corner: Option<(f64, f64)>, text: &str) -> usize {
        let Some((left, top)) = corner else { return 1 };
        let base = (left + 1.0, top + 0.85 * SMALL + 1.0);
        self.drawing.text("label", Anchor::Start, base, text);
        0
    }

    /// A bar of colours beside the area, from `left`, with its name above. `colour` gives the colour at a
    /// share of the scale; a pattern lies on what is below a height.
    pub fn colour_bar(
        &mut self,
        (name, left, scale): (&str, f64, &Mapping),
        ticks: &[Tick],
        pattern: Option<(&str, f64)>,
        colour: impl Fn(f64) -> String,
    ) {
        const PARTS: u32 = 128;
        let right = left + 20.0;
        let area = |low, high| polygon(&[(left, low), (right, low), (right, high), (left, high)]);
        let share = |part: f64| part / f64::from(PARTS);
        let height = |part: u32| scale.from + share(part.into()) * (scale.to - scale.from);
        self.drawing.text("", Anchor::Start, (left, self.top + 8.0), name);
        for part in 0..PARTS {
            let colour = colour(share(f64::from(part) + 0.5));
            self.drawing.fill(&colour, &area(height(part), height(part + 1)));
        }
        if let Some((pattern, below)) = pattern {
            self.drawing.fill_with(pattern, &area(below, scale.from));
        }
        self.drawing.rectangle("frame", (left, scale.to), (right, scale.from));
        for tick in ticks {
            let end = right + tick.length();
            self.drawing.line("tick", (right, tick.position), (end, tick.position));
            if let Some(label) = &tick.label {
                let place = (right + 10.0, tick.position + 4.0);
                self.drawing.text("", Anchor::Start, place, label);
            }
        }
    }

    /// The legend, from the height `from` downwards.
    pub fn legend(&mut self, legend: &Legend, from: f64) {
        let (left, mut y) = (self.right + BESIDE, from + 8.0);
        for (sample, text) in &legend.entries {
            self.drawing.moved((left, y), sample);
            let lines = wrap(text, WIDTH - MARGIN - left - INDENT + 0.5, MEDIUM);
            for line in &lines {
                self.drawing.text("", Anchor::Start, (left + INDENT, y + 4.0), line);
                y += 1.3 * MEDIUM;
            }
            y += 6.0;
        }
        self.reach(y - 8.0);
    }

    /// Sees to it that the small print begins below `y`.
    fn reach(&mut self, y: f64) {
        self.lowest = self.lowest.max(y);
    }

    /// The picture, with the small print under it: the caption, then `remarks`.
    pub fn close(
        mut self,
        title: &str,
        description: &str,
        caption: &Caption,
        remarks: &[String],
    ) -> String {
        let mut y = self.lowest + 14.0;
        let mut sentences = caption.sentences();
        // The command stands last, on a line of its own.
        let command = (!caption.command.is_empty()).then(|| sentences.pop()).flatten();
        sentences.extend(remarks.iter().cloned());
        let paragraph = sentences.join(" ");
        // Without small print there is nothing to part off.
        if !paragraph.is_empty() || command.is_some() {
            self.drawing.line("grid", (MARGIN, y), (WIDTH - MARGIN, y));
            y += 4.0;
        }
        for paragraph in [Some(paragraph), command].into_iter().flatten() {
            for line in wrap(&paragraph, WIDTH - 2.0 * MARGIN, SMALL) {
                y += 1.4 * SMALL;
                self.drawing.text("small", Anchor::Start, (MARGIN, y), &line);
            }
        }
        self.drawing.finish(&self.name, y + 12.0, title, description)
    }
}

/// The least distance between labels across and up.
const SPACING: (f64, f64) = (58.0, 26.0);

/// The ticks of an axis across, as close as their labels allow.
fn ticks_across(mapping: &Mapping, wide: f64) -> Vec<Tick> {
    let mut spacing = SPACING.0;
    loop {
        let ticks = mapping.ticks(spacing);
        let widths = ticks.iter().flat_map(|tick| &tick.label).map(|label| width(label, MEDIUM));
        let widest = widths.fold(0.0, f64::max);
        // Half of the area is room enough for any label.
        if widest + 8.0 <= spacing || spacing > wide / 2.0 {
            return ticks;
        }
        spacing *= 1.5;
    }
}

/// The room of a label in the small size.
pub(super) fn label_size(text: &str) -> (f64, f64) {
    (width(text, SMALL) + 2.0, SMALL + 2.0)
}

/// An axis in pixels that shows all `values`, from `from` to `to`; `zero` tells whether some of
/// them are zero on a logarithmic axis, which then stand in a gutter at its lower end.
pub(super) fn fitted(
    scale: Scale,
    values: impl IntoIterator<Item = f64>,
    (from, to): (f64, f64),
    zero: bool,
) -> Mapping {
    let gutter = if zero { GUTTER.copysign(to - from) } else { 0.0 };
    Mapping::around(scale, values).onto(from + gutter, to)
}

/// "1 point is", "3 points are".
pub(super) fn counted(count: usize, one: &str, many: &str) -> String {
    match count {
        1 => format!("1 {one} is"),
        _ => format!("{count} {many} are"),
    }
}
