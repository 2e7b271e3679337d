//! The line of a scene, drawn to scale.

use crate::picture::Prefixed;
use wavestep::enclosure::Numbers;
use wavestep::expression::Fraction;
use wavestep::network::{ModelBar, ScaledScene};
use wavestep::scene::{Body, Dimension, Element, End, Joint, Kind, Spring};
use wavestep_draw::escape;

/// The least width of the picture, and of it what bars with an end take.
const WIDTH: f64 = 900.0;
const BARS: f64 = 250.0;

/// The height of the axis of the line, and what is left free at both sides.
const AXIS: f64 = 74.0;
const MARGIN: f64 = 46.0;

/// Half the height of the stoutest bar, and of a mass.
const HALF: f64 = 24.0;
const LUMP: f64 = 26.0;

/// How long endless bars are drawn, how wide masses are, and gaps at contacts.
const ENDLESS: f64 = 130.0;
const MASS: f64 = 44.0;
const GAP: f64 = 7.0;
const APART: f64 = 3.0 * GAP;

/// Signs about the place on the axis where they begin; springs and dampers are 52 wide, a local contact 30.
const SPRING: &str = "M0 0h5l3-7l6 14l6-14l6 14l6-14l6 14l6-14l3 7h5";
const DAMPER: &str = "M0 0h22m0-6v12M14-8h20v16h-20M34 0h18";
const BESIDE: &str = "M0-10v20M52-10v20";
const NOSE: &str = "M0-16a14 16 0 0 1 0 32zM30-16a14 16 0 0 0 0 32z";
const WALL: &str = "M0-30v60M0-30l9 8M0-20l9 8M0-10l9 8M0 0l9 8M0 10l9 8M0 20l9 8";
const ARROW: &str = "M-14 0h28l-6-4m6 4l-6 4";

/// The picture of the line, with its scale.
pub fn drawn(scaled: &ScaledScene) -> String {
    let scene = scaled.scene();
    let figure = Figure { numbers: Numbers::new(&scaled.model().constants), scaled };
    let elements: Vec<&Element> =
        scene.line.elements.iter().map(|place| &scene.elements[*place]).collect();
    let (lengths, dimension) = figure.lengths(&elements);
    let sizes: Vec<f64> = scene.line.elements.iter().map(|place| figure.size(*place)).collect();
    let stoutest = sizes.iter().copied().fold(0.0, f64::max);
    let gap = |joint: usize| match scene.line.joints[joint] {
        Joint::Bonded => 0.0,
        Joint::Contact if scene.line.gaps.contains_key(&joint) => APART,
        Joint::Contact => GAP,
    };
    let gaps: f64 = (0..scene.line.joints.len()).map(gap).sum();
    let taken = elements.iter().map(|element| width(element)).sum::<f64>() + gaps;
    let wide = (2.0 * MARGIN + taken + BARS).max(WIDTH);
    let room = wide - 2.0 * MARGIN - taken;
    let total: f64 = lengths.iter().sum();
    let scale = if total > 0.0 { room / total } else { 0.0 };
    let mut x = MARGIN + if total > 0.0 { 0.0 } else { room / 2.0 };
    let (mut out, mut names) = (String::new(), Vec::new());
    if scene.line.left == End::Fixed {
        out += &sign("wire", WALL, x, AXIS, "scale(-1 1)");
    }
    for (i, element) in elements.iter().enumerate() {
        x += gap(i);
        let long = width(element) + lengths[i] * scale;
        let half = (HALF * sizes[i] / stoutest).max(2.0);
        let is_left = i == 0 && scene.line.left == End::Endless;
        let low = figure.element(element, [x, long, half], is_left, &mut out);
        names.push((x + long / 2.0, low, element.name.as_str()));
        x += long;
    }
    if scene.line.right == End::Fixed {
        out += &sign("wire", WALL, x + gap(elements.len()), AXIS, "");
    }
    let mut y = named(&names, wide, &mut out);
    let note = match dimension.filter(|_| total > 0.0) {
        None => "Not to scale: lengths are symbols, of two kinds, or endless.",
        Some(dimension) => {
            out += &figure.ruler(total / 5.0, scale, dimension, y);
            y += 16.0;
            match dimension == Dimension::TIME {
                true => {
                    "Lengths are proportional to travel times, heights to square roots of impedances."
                }
                false => {
                    "Lengths are to scale, heights proportional to square roots of impedances."
                }
            }
        }
    };
    let words: Vec<&str> = elements.iter().map(|element| element.name.as_str()).collect();
    let [left, right] = [scene.line.left, scene.line.right].map(|end| match end {
        End::Free => "free",
        End::Fixed => "fixed",
        End::Endless => "endless",
    });
    let label =
        format!("The line from left to right: {left} end, {}, {right} end.", words.join(", "));
    let apart = if scene.line.gaps.is_empty() { "" } else { ", a wide one is open at the start" };
    let least = if wide > WIDTH { format!(" style=\"min-width:{wide}px\"") } else { String::new() };
    format!(
        "<figure><div class=\"wide\" role=\"group\" aria-label=\"The line\" tabindex=\"0\">\
         <svg class=\"line-of-scene\"{least} viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">{out}</svg></div>\
         <figcaption>{note} Masses, springs and ends are symbols, not to scale; an arrow is a velocity at the start or a load; \
         a gap is a contact{apart}.</figcaption></figure>\n",
        px(wide),
        px(y + 10.0),
        escape(&label)
    )
}

/// How wide an element is drawn that has no length.
fn width(element: &Element) -> f64 {
    match &element.kind {
        Kind::Bar(bar) if bar.is_endless() => ENDLESS,
        Kind::Bar(_) | Kind::Load(_) => 0.0,
        Kind::Mass(_) => MASS,
        Kind::Spring(_) | Kind::Support(_) => 52.0,
        Kind::Hertz(_) => 30.0,
    }
}

/// A scene and its constants as numbers.
struct Figure<'a> {
    numbers: Numbers,
    scaled: &'a ScaledScene,
}

impl Figure<'_> {
    /// None where a symbol has no value.
    fn number(&self, value: &Fraction) -> Option<f64> {
        self.numbers.enclose(value, 64).ok().map(|ball| ball.to_double().0)
    }

    /// Lengths of bars that have one, zero for all else, with their dimension; all are one, and have none, where they
    /// cannot be compared.
    fn lengths(&self, elements: &[&Element]) -> (Vec<f64>, Option<Dimension>) {
        let bar = |element: &&Element| match &element.kind {
            Kind::Bar(bar) => bar
                .extent()
                .map(|extent| (matches!(bar.body, Body::Solid { .. }), self.number(extent))),
            _ => None,
        };
        let bars: Vec<Option<(bool, Option<f64>)>> = elements.iter().map(bar).collect();
        let mut kinds: Vec<bool> = bars.iter().flatten().map(|(solid, _)| *solid).collect();
        kinds.dedup();
        let length =
            |bar: &Option<(bool, Option<f64>)>| bar.map_or(Some(0.0), |(_, length)| length);
        match (&kinds[..], bars.iter().map(length).collect()) {
            ([true], Some(lengths)) => (lengths, Some(Dimension::LENGTH)),
            ([false], Some(lengths)) => (lengths, Some(Dimension::TIME)),
            _ => (bars.iter().map(|bar| f64::from(bar.is_some())).collect(), None),
        }
    }

    /// Half the height of an element: of a bar the root of its impedance.
    fn size(&self, place: usize) -> f64 {
        let bar: Option<&ModelBar> = self.scaled.model().bars.get(&place);
        bar.map_or(0.0, |bar| self.number(&bar.impedance).unwrap_or(1.0).sqrt())
    }

    /// Draws an element from `x` on; how far it reaches below the axis.
    fn element(
        &self,
        element: &Element,
        [x, long, half]: [f64; 3],
        is_left: bool,
        out: &mut String,
    ) -> f64 {
        let middle = x + long / 2.0;
        let (low, velocity) = match &element.kind {
            Kind::Bar(bar) if bar.is_endless() => {
                let path = format!("M{ENDLESS} {0}H0V{1}H{ENDLESS}", px(-half), px(half));
                let (x, turned) = if is_left { (x + long, "scale(-1 1)") } else { (x, "") };
                *out += &sign("bar", &path, x, AXIS, turned);
                *out += &sign("dots", &format!("M{} 0h17", ENDLESS + 8.0), x, AXIS, turned);
                (half, Some(&bar.velocity))
            }
            Kind::Bar(bar) => {
                *out += &rectangle("bar", x, long, half);
                (half, Some(&bar.velocity))
            }
            Kind::Mass(mass) => {
                *out += &rectangle("lump", x, long, LUMP);
                (LUMP, Some(&mass.velocity))
            }
            Kind::Spring(own) => {
                *out += &spring(own, x, "");
                (18.0, None)
            }
            Kind::Support(own) => {
                *out += &sign("wire", &format!("M0 0h{long}"), x, AXIS, "");
                *out += &spring(own, middle, "rotate(90)");
                *out += &sign("wire", WALL, middle, AXIS + 52.0, "rotate(90)");
                (64.0, None)
            }
            Kind::Hertz(_) => {
                *out += &sign("bar", NOSE, x, AXIS, "");
                (16.0, None)
            }
            Kind::Load(_) => {
                *out += &sign("arrow", ARROW, x - 14.0, AXIS - HALF - 12.0, "");
                (HALF, None)
            }
        };
        let velocity = velocity.and_then(|value| self.number(value)).unwrap_or(0.0);
        if velocity != 0.0 {
            let turned = if velocity < 0.0 { "scale(-1 1)" } else { "" };
            *out += &sign("arrow", ARROW, middle, AXIS - low - 10.0, turned);
        }
        low
    }

    /// A length of 1, 2 or 5 times a power of ten below the picture.
    fn ruler(&self, about: f64, scale: f64, dimension: Dimension, y: f64) -> String {
        let power = 10_f64.powf(about.log10().floor());
        let figure = [5.0, 2.0].into_iter().find(|figure| figure * power <= about).unwrap_or(1.0);
        let length = figure * power;
        let unit = Prefixed::in_scene(self.scaled.scene().dimensional, &dimension.unit(), length);
        let rounded = (length * unit.factor * 1e6).round() / 1e6;
        let label = format!("{rounded} {}", unit.unit);
        let end = px(length * scale);
        sign("wire", &format!("M0-4v8m0-4H{end}m0-4v8"), MARGIN, y, "")
            + &text("start", MARGIN + length * scale + 8.0, y + 4.0, label.trim_end())
    }
}

/// Writes names below the elements, in rows so that none touches another; where the last row ends.
fn named(names: &[(f64, f64, &str)], wide: f64, out: &mut String) -> f64 {
    let top = AXIS + names.iter().map(|(_, low, _)| *low).fold(HALF, f64::max) + 22.0;
    let mut rows: Vec<f64> = Vec::new();
    for (middle, low, name) in names {
        let long = 7.8 * name.chars().count() as f64;
        let left = (middle - long / 2.0).min(wide - long - 4.0).max(4.0);
        let row = rows.iter().position(|end| *end + 8.0 <= left).unwrap_or(rows.len());
        rows.resize(rows.len().max(row + 1), 0.0);
        rows[row] = left + long;
        let y = top + 16.0 * row as f64;
        let lead = format!("M0 0V{}", px(y - 14.0 - AXIS - low));
        *out += &sign("lead", &lead, *middle, AXIS + low + 3.0, "");
        *out += &text("middle", left + long / 2.0, y, name);
    }
    top + 16.0 * rows.len() as f64
}

/// A spring and a damper beside one another, as there are.
fn spring(own: &Spring, x: f64, turned: &str) -> String {
    let both = !own.stiffness.is_zero() && !own.damping.is_zero();
    let mut out = String::new();
    for (value, path, shift) in [(&own.stiffness, SPRING, -10), (&own.damping, DAMPER, 10)] {
        if !value.is_zero() {
            let shift = if both { shift } else { 0 };
            out += &sign("wire", path, x, AXIS, &format!("{turned} translate(0 {shift})"));
        }
    }
    if both {
        out += &sign("wire", BESIDE, x, AXIS, turned);
    }
    out
}

fn sign(class: &str, path: &str, x: f64, y: f64, turned: &str) -> String {
    let (x, y) = (px(x), px(y));
    format!("<path class=\"{class}\" transform=\"translate({x} {y}) {turned}\" d=\"{path}\"/>")
}

fn rectangle(class: &str, x: f64, long: f64, half: f64) -> String {
    let [x, y, long, high] = [x, AXIS - half, long, 2.0 * half].map(px);
    format!("<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{long}\" height=\"{high}\"/>")
}

fn text(anchor: &str, x: f64, y: f64, text: &str) -> String {
    let (x, y, text) = (px(x), px(y), escape(text));
    format!("<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{text}</text>")
}

/// A number to a hundredth.
fn px(value: f64) -> String {
    format!("{}", (value * 100.0).round() / 100.0 + 0.0)
}
