//! The line of a scene, drawn to scale, and a table of its elements.

use super::html::{escape, table};
use crate::picture::Prefixed;
use std::fmt::Write as _;
use wavestep::enclosure::Numbers;
use wavestep::export::expression_text;
use wavestep::expression::Fraction;
use wavestep::network::ScaledScene;
use wavestep::scene::{Bar, Body, Dimension, Drive, End, Joint, Kind, Scene, Spring};

/// The width of the picture, the height of the axis of the line, and what is left free at both sides.
const WIDTH: f64 = 900.0;
const AXIS: f64 = 74.0;
const MARGIN: f64 = 46.0;

/// Half the height of the stoutest bar, and that of a lump.
const HALF: f64 = 24.0;
const LUMP: f64 = 26.0;

/// How long endless bars are drawn, and the width of what has no length.
const ENDLESS: f64 = 130.0;
const GAP: f64 = 7.0;

/// A picture of the line with a table of its elements.
pub fn drawn(scaled: &ScaledScene) -> String {
    let scene = scaled.scene();
    let figures = Figures { numbers: Numbers::new(&scaled.model().constants), scene };
    figures.picture() + &figures.table()
}

/// Values of a scene as numbers.
struct Figures<'a> {
    numbers: Numbers,
    scene: &'a Scene,
}

impl Figures<'_> {
    /// None where a symbol has no value.
    fn number(&self, value: &Fraction) -> Option<f64> {
        self.numbers.enclose(value, 64).ok().map(|ball| ball.to_double().0)
    }

    /// With its unit and a prefix, in six figures; as an expression where a symbol has no value.
    fn text(&self, value: &Fraction, dimension: Dimension) -> String {
        let Some(number) = self.number(value) else {
            return expression_text(&value.clone().into());
        };
        // Prefixes are for units that begin with a power of one.
        let unit = match dimension {
            Dimension::AREA => Prefixed { unit: "mm²".to_owned(), factor: 1e6 },
            Dimension::DENSITY => Prefixed { unit: "kg/m³".to_owned(), factor: 1.0 },
            Dimension::STIFFNESS => Prefixed::of("N/m", number.abs()),
            _ => Prefixed::of(&dimension.unit(), number.abs()),
        };
        if !self.scene.dimensional {
            return rounded(number);
        }
        format!("{} {}", rounded(number * unit.factor), unit.unit).trim_end().to_owned()
    }

    fn table(&self) -> String {
        let row = |place: &usize| {
            let element = &self.scene.elements[*place];
            let (word, all) = properties(&element.kind);
            let given = all.iter().filter(|(_, value, _)| !value.is_zero());
            let mut texts: Vec<String> = given
                .map(|(name, value, of)| format!("{name} {}", self.text(value, *of)))
                .collect();
            match &element.kind {
                Kind::Hertz(own) => texts.push(format!("exponent {}", own.exponent)),
                Kind::Load(own) => {
                    texts.push(expression_text(&own.course));
                    texts.push(format!("from {}", self.text(&own.from, Dimension::TIME)));
                    let until = own.until.as_ref().map(|end| self.text(end, Dimension::TIME));
                    texts.extend(until.map(|end| format!("until {end}")));
                }
                _ => {}
            }
            vec![element.name.clone(), word.to_owned(), texts.join(", ")]
        };
        let rows: Vec<Vec<String>> = self.scene.line.elements.iter().map(row).collect();
        table("Elements from left to right", &["element", "kind", "given"], &rows)
    }

    /// Lengths of bars in one measure with its unit, where all of them are numbers; none for endless bars.
    fn lengths(&self) -> Option<(Vec<Option<f64>>, Dimension)> {
        let bars = || self.scene.line.elements.iter().filter_map(|place| self.bar(*place));
        let is_solid = |bar: &Bar| matches!(bar.body, Body::Solid { .. });
        let finite = || bars().filter(|bar| !bar.is_endless());
        let solid = finite().next().is_none_or(is_solid);
        if finite().any(|bar| is_solid(bar) != solid) {
            return None;
        }
        let length = |place: &usize| match self.bar(*place).and_then(Bar::extent) {
            Some(extent) => self.number(extent).map(Some),
            None => Some(None),
        };
        let lengths = self.scene.line.elements.iter().map(length).collect::<Option<_>>()?;
        Some((lengths, if solid { Dimension::LENGTH } else { Dimension::TIME }))
    }

    fn bar(&self, place: usize) -> Option<&Bar> {
        match &self.scene.elements[place].kind {
            Kind::Bar(bar) => Some(bar),
            _ => None,
        }
    }

    /// Half the height of each bar: as the root of its area, or of its impedance.
    fn halves(&self) -> Option<Vec<f64>> {
        let size = |place: &usize| match self.bar(*place).map(|bar| &bar.body) {
            None => Some(0.0),
            Some(Body::Solid { area, .. }) => self.number(area).map(f64::sqrt),
            Some(Body::Impedance { impedance, .. }) => self.number(impedance).map(f64::sqrt),
        };
        let sizes: Vec<f64> = self.scene.line.elements.iter().map(size).collect::<Option<_>>()?;
        let stoutest = sizes.iter().copied().fold(0.0, f64::max);
        Some(sizes.iter().map(|size| (HALF * size / stoutest).max(2.0)).collect())
    }

    fn picture(&self) -> String {
        let line = &self.scene.line;
        let count = line.elements.len();
        let measured = self.lengths();
        let bars = |place: &usize| self.bar(*place).map(|bar| (!bar.is_endless()).then_some(1.0));
        let equal = || line.elements.iter().map(|place| bars(place).flatten()).collect();
        let lengths: Vec<Option<f64>> = measured.clone().map_or_else(equal, |found| found.0);
        let halves = self.halves();
        let half = |i: usize| halves.as_ref().map_or(HALF / 2.0, |halves| halves[i]);
        let fixed = |i: usize| match &self.scene.elements[line.elements[i]].kind {
            Kind::Bar(bar) if bar.is_endless() => ENDLESS,
            Kind::Bar(_) | Kind::Load(_) => 0.0,
            Kind::Support(_) => 44.0,
            Kind::Mass(_) => 44.0,
            Kind::Spring(_) => 58.0,
            Kind::Hertz(_) => 30.0,
        };
        let gap = |joint: usize| if line.joints[joint] == Joint::Contact { GAP } else { 0.0 };
        let taken = (0..count).map(fixed).sum::<f64>() + (0..=count).map(gap).sum::<f64>();
        let total: f64 = lengths.iter().flatten().sum();
        let scale = (WIDTH - 2.0 * MARGIN - taken) / if total > 0.0 { total } else { 1.0 };
        let mut out = String::new();
        let mut x = MARGIN + if total > 0.0 { 0.0 } else { (WIDTH - 2.0 * MARGIN - taken) / 2.0 };
        let mut names: Vec<(f64, f64, &str)> = Vec::new();
        if line.left == End::Fixed {
            out += &wall(x, -1.0);
        }
        for (i, place) in line.elements.iter().enumerate() {
            x += gap(i);
            let element = &self.scene.elements[*place];
            let wide = lengths[i].map_or(fixed(i), |length| length * scale);
            let middle = x + wide / 2.0;
            let (mut low, mut speed) = (half(i), None);
            match &element.kind {
                Kind::Bar(bar) => {
                    let to_the_left = i == 0 && line.left == End::Endless;
                    let ends = [to_the_left, !to_the_left].map(|end| end && bar.is_endless());
                    out += &rod(x, wide, half(i), ends);
                    speed = Some(&bar.velocity);
                }
                Kind::Mass(mass) => {
                    out += &rectangle("lump", x, AXIS - LUMP, wide, 2.0 * LUMP);
                    (low, speed) = (LUMP, Some(&mass.velocity));
                }
                Kind::Spring(own) => {
                    out += &spring([x, AXIS], wide, own, 0.0);
                    low = 14.0;
                }
                Kind::Support(own) => {
                    let _ =
                        write!(out, "<path class=\"wire\" d=\"M{} {AXIS}h{}\"/>", px(x), px(wide));
                    out += &spring([middle, AXIS], 40.0, own, 90.0);
                    let ground = wall(0.0, 1.0);
                    let _ = write!(
                        out,
                        "<g transform=\"translate({} {}) rotate(90) translate(0 {})\">{ground}</g>",
                        px(middle),
                        px(AXIS + 40.0),
                        px(-AXIS)
                    );
                    low = 56.0;
                }
                Kind::Hertz(_) => {
                    let _ = write!(
                        out,
                        "<path class=\"bar\" d=\"M{0} {1}a14 16 0 0 1 0 32zM{2} {1}a14 16 0 0 0 0 32z\"/>",
                        px(x),
                        px(AXIS - 16.0),
                        px(x + wide)
                    );
                    low = 16.0;
                }
                Kind::Load(_) => {
                    out += &arrow(x - 30.0, AXIS - HALF - 12.0, 30.0);
                    low = HALF;
                }
            }
            let moving = speed.and_then(|value| self.number(value)).unwrap_or(0.0);
            if moving != 0.0 {
                out += &arrow(
                    middle - 14.0 * moving.signum(),
                    AXIS - low - 10.0,
                    28.0 * moving.signum(),
                );
            }
            names.push((middle, low, &element.name));
            x += wide;
        }
        x += gap(count);
        if line.right == End::Fixed {
            out += &wall(x, 1.0);
        }
        let mut rows: Vec<f64> = Vec::new();
        let lowest = names.iter().map(|(_, low, _)| *low).fold(HALF, f64::max);
        for (middle, low, name) in names {
            let wide = 7.6 * name.chars().count() as f64;
            let left = (middle - wide / 2.0).clamp(4.0, WIDTH - wide - 4.0);
            let row = rows.iter().position(|end| *end + 8.0 <= left).unwrap_or(rows.len());
            rows.resize(rows.len().max(row + 1), 0.0);
            rows[row] = left + wide;
            let y = AXIS + lowest + 22.0 + 16.0 * row as f64;
            let _ = write!(
                out,
                "<path class=\"lead\" d=\"M{0} {1}V{2}\"/><text x=\"{3}\" y=\"{4}\" text-anchor=\"middle\">{5}</text>",
                px(middle),
                px(AXIS + low + 3.0),
                px(y - 11.0),
                px(left + wide / 2.0),
                px(y),
                escape(name)
            );
        }
        let height = AXIS + lowest + 24.0 + 16.0 * rows.len() as f64;
        let note = match &measured {
            Some((_, dimension)) if total > 0.0 => {
                out += &self.ruler(total / 5.0, scale, *dimension, height);
                match dimension {
                    d if *d == Dimension::TIME => {
                        "Lengths to the scale of travel times, heights as the root of the impedance."
                    }
                    _ => {
                        "Lengths to scale; heights as the root of the area, to a scale of their own."
                    }
                }
            }
            _ => "Not to scale: lengths are symbols, of two kinds, or endless.",
        };
        let words: Vec<&str> =
            line.elements.iter().map(|place| self.scene.elements[*place].name.as_str()).collect();
        let [left, right] = [line.left, line.right].map(|end| match end {
            End::Free => "free",
            End::Fixed => "fixed",
            End::Endless => "endless",
        });
        let label = format!(
            "The line from left to right: {left} end, {}, {right} end. Arrows show velocities at the start; gaps are contacts.",
            words.join(", ")
        );
        format!(
            "<figure><svg class=\"line-of-scene\" viewBox=\"0 0 {WIDTH} {}\" role=\"img\" aria-label=\"{}\">{out}</svg>\
             <figcaption>{note} Masses, springs and ends are signs; an arrow is a velocity at the start or a \
             load; a gap is a contact.</figcaption></figure>\n",
            px(height + 26.0),
            escape(&label)
        )
    }

    /// A length of 1, 2 or 5 times a power of ten beside the picture.
    fn ruler(&self, about: f64, scale: f64, dimension: Dimension, y: f64) -> String {
        let power = 10_f64.powf(about.log10().floor());
        let length = [5.0, 2.0, 1.0].map(|figure| figure * power);
        let length = length.into_iter().find(|length| *length <= about).unwrap_or(power);
        let unit = Prefixed::in_scene(self.scene.dimensional, &dimension.unit(), length);
        let label = format!("{} {}", rounded(length * unit.factor), unit.unit);
        format!(
            "<path class=\"ruler\" d=\"M{0} {1}v8m0-4H{2}m0-4v8\"/><text x=\"{3}\" y=\"{4}\">{5}</text>",
            px(MARGIN),
            px(y),
            px(MARGIN + length * scale),
            px(MARGIN + length * scale + 8.0),
            px(y + 8.0),
            escape(label.trim_end())
        )
    }
}

/// What a person calls an element, and what is given of it.
fn properties(kind: &Kind) -> (&'static str, Vec<(&'static str, &Fraction, Dimension)>) {
    let is_damper = |own: &Spring| own.stiffness.is_zero() && !own.damping.is_zero();
    match kind {
        Kind::Bar(bar) => {
            let mut all = match &bar.body {
                Body::Impedance { impedance, travel } => {
                    let mut all = vec![("impedance", impedance, Dimension::IMPEDANCE)];
                    all.extend(travel.iter().map(|t| ("travel time", t, Dimension::TIME)));
                    all
                }
                Body::Solid { area, modulus, density, length } => {
                    let mut all = Vec::new();
                    all.extend(length.iter().map(|l| ("length", l, Dimension::LENGTH)));
                    all.push(("area", area, Dimension::AREA));
                    all.push(("modulus", modulus, Dimension::PRESSURE));
                    all.push(("density", density, Dimension::DENSITY));
                    all
                }
            };
            all.push(("velocity at the start", &bar.velocity, Dimension::VELOCITY));
            all.push(("strain at the start", &bar.strain, Dimension::NONE));
            (if bar.is_endless() { "endless bar" } else { "bar" }, all)
        }
        Kind::Mass(mass) => {
            let velocity = ("velocity at the start", &mass.velocity, Dimension::VELOCITY);
            ("mass", vec![("mass", &mass.mass, Dimension::MASS), velocity])
        }
        Kind::Spring(own) | Kind::Support(own) => {
            let word = match kind {
                Kind::Support(_) => "support",
                _ if is_damper(own) => "damper",
                _ => "spring",
            };
            let stiffness = ("stiffness", &own.stiffness, Dimension::STIFFNESS);
            (word, vec![stiffness, ("damping", &own.damping, Dimension::IMPEDANCE)])
        }
        Kind::Hertz(own) => {
            let force = ("force", &own.force, Dimension::FORCE);
            let compression = ("at the compression", &own.compression, Dimension::LENGTH);
            ("local contact", vec![force, compression])
        }
        Kind::Load(own) => match own.drive {
            Drive::Force => ("force from outside", vec![]),
            Drive::Velocity => ("imposed velocity", vec![]),
        },
    }
}

fn rectangle(class: &str, x: f64, y: f64, wide: f64, high: f64) -> String {
    let [x, y, wide, high] = [x, y, wide, high].map(px);
    format!("<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{wide}\" height=\"{high}\"/>")
}

/// A bar; an end that is endless is open, with dots.
fn rod(x: f64, wide: f64, half: f64, [left, right]: [bool; 2]) -> String {
    if !left && !right {
        return rectangle("bar", x, AXIS - half, wide, 2.0 * half);
    }
    let (from, to) = if left { (x + wide, x) } else { (x, x + wide) };
    let dots = if left { -1.0 } else { 1.0 };
    let mut out = format!(
        "<path class=\"bar\" d=\"M{1} {2}H{0}V{3}H{1}\"/>",
        px(from),
        px(to),
        px(AXIS - half),
        px(AXIS + half)
    );
    for i in 1..4 {
        let at = px(to + dots * 8.0 * f64::from(i));
        let _ = write!(out, "<circle class=\"dot\" cx=\"{at}\" cy=\"{}\" r=\"2\"/>", px(AXIS));
    }
    out
}

/// A spring and a damper beside one another, as there are.
fn spring([x, y]: [f64; 2], wide: f64, own: &Spring, turned: f64) -> String {
    let both = !own.stiffness.is_zero() && !own.damping.is_zero();
    let shift = if both { 9.0 } else { 0.0 };
    let mut path = String::new();
    if !own.stiffness.is_zero() {
        let step = (wide - 12.0) / 8.0;
        let _ = write!(path, "M0 {}h6l{} -7", px(-shift), px(step / 2.0));
        for i in 0..7 {
            let _ = write!(path, "l{} {}", px(step), if i % 2 == 0 { 14 } else { -14 });
        }
        let _ = write!(path, "l{} -7h6", px(step / 2.0));
    }
    if !own.damping.is_zero() {
        let (middle, rest) = (px(wide * 0.45), px(wide * 0.4));
        let _ = write!(
            path,
            "M0 {0}H{middle}m0 -5v10M{1} {2}h{3}v14h-{3}M{4} {0}h{rest}",
            px(shift),
            px(wide * 0.3),
            px(shift - 7.0),
            px(wide * 0.3),
            px(wide * 0.6)
        );
    }
    if both {
        let _ = write!(path, "M0 {0}v{1}M{2} {0}v{1}", px(-shift), px(2.0 * shift), px(wide));
    }
    format!(
        "<path class=\"wire\" transform=\"translate({} {}) rotate({turned})\" d=\"{path}\"/>",
        px(x),
        px(y)
    )
}

/// A place that does not move, hatched on the side away from the line.
fn wall(x: f64, way: f64) -> String {
    let mut path = format!("M{} {}v60", px(x), px(AXIS - 30.0));
    for i in 0..7 {
        let _ =
            write!(path, "M{} {}l{} 8", px(x), px(AXIS - 30.0 + 8.5 * f64::from(i)), px(9.0 * way));
    }
    format!("<path class=\"wire\" d=\"{path}\"/>")
}

fn arrow(x: f64, y: f64, long: f64) -> String {
    let head = px(-6.0 * long.signum());
    format!(
        "<path class=\"arrow\" d=\"M{} {}h{}m{head} -4l{} 4l{head} 4\"/>",
        px(x),
        px(y),
        px(long),
        px(6.0 * long.signum())
    )
}

/// A place in the picture, to a hundredth.
fn px(value: f64) -> String {
    let value = (value * 100.0).round() / 100.0;
    format!("{}", if value == 0.0 { 0.0 } else { value })
}

/// A number in at most six figures.
pub fn rounded(value: f64) -> String {
    if value != 0.0 && !(1e-4..1e9).contains(&value.abs()) {
        return format!("{value:.5e}");
    }
    let whole = value.abs().log10().floor().max(-5.0) as i32;
    let decimals = usize::try_from(5 - whole).unwrap_or(0);
    let text = format!("{value:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}
