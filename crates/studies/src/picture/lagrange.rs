//! Diagrams of place and time, from the strips of waves.

use super::{PictureError, Prefixed};
use wavestep::field::{BarWaves, FieldEvaluator, Front, Quantity, Strip};
use wavestep::network::Network;
use wavestep::scene::{End, Kind};
use wavestep_draw::{Caption, Cell, Diagram, Line, Part, Shape, Window};
use wavestep_polynomial::Rational;

/// How many strips a wave that is not constant has on a window, before those are joined that hardly differ.
const STRIPS: usize = 480;

/// How far the values of strips that are joined differ at most, as a part of the range of all waves of a bar.
const FLAT: f64 = 1.0 / 96.0;

/// The diagram of a scene's velocity, strain or force on a window of time, up to the last time of its
/// evaluator.
///
/// Where two constant waves cross, a cell is exact and as large as it can be; where a wave bends, it
/// is cut into strips along both families of characteristics, in each of which it changes by no more than a
/// hundredth of the range of the waves. No cell reaches over a front.
pub fn lagrange(
    evaluator: &FieldEvaluator<'_>,
    quantity: Quantity,
    [from, to]: [&Rational; 2],
    caption: Caption,
) -> Result<Diagram, PictureError> {
    if quantity == Quantity::Displacement {
        return Err(PictureError::NoDiagram(quantity));
    }
    let network = evaluator.network();
    let bars = evaluator.waves([from, to], STRIPS)?;
    let places = Places::of(network, bars.iter().map(|bar| bar.length))?;
    let end = |bar: &BarWaves| bar.right.last().map_or(0.0, |strip| strip.to);
    let begin = |bar: &BarWaves| {
        bar.right.first().map_or(0.0, |strip| strip.from) + bar.length * bar.slowness
    };
    let times = (begin(&bars[0]), end(&bars[0]));
    let window: Window = [places.window, times];
    let scene = network.scene();
    let unit = |unit: &str, largest| Prefixed::in_scene(scene.dimensional, unit, largest);
    let (metre, second) = (unit("m", window[0].0.abs().max(window[0].1)), unit("s", times.1));
    let mut cells = Vec::new();
    let mut lines = Vec::new();
    for (bar, left) in bars.iter().zip(&places.lefts) {
        cells.extend(cells_of(&joined(bar), *left, quantity, times));
        lines.extend(lines_of(bar, *left, window));
    }
    let largest = cells.iter().map(|cell: &Cell| cell.value().abs()).fold(0.0, f64::max);
    let own = unit(&quantity.dimension().unit(), largest);
    let on = |(x, t): (f64, f64)| (x * metre.factor, t * second.factor);
    let (low, high) = (on((window[0].0, times.0)), on((window[0].1, times.1)));
    let shown: Window = [(low.0, high.0), (low.1, high.1)];
    let scaled = |cell: Cell| {
        let outline: Vec<(f64, f64)> = cell.outline().iter().map(|corner| on(*corner)).collect();
        Cell::clipped(&outline, cell.value() * own.factor, shown)
    };
    let lines = lines.into_iter().map(|line| Line { from: on(line.from), to: on(line.to), ..line });
    let parts = places.parts.into_iter().map(|part| {
        let (from, to) = (part.from * metre.factor, part.to * metre.factor);
        Part { from, to, ..part }
    });
    let axes = [metre.axis("place"), second.axis("time"), own.axis(quantity.name())];
    let cells = cells.into_iter().filter_map(scaled).collect();
    let diagram = Diagram::new(&scene.title, axes, shown, cells, caption)?;
    Ok(diagram.lines(lines.collect()).parts(parts.collect()))
}

pub(crate) struct Places {
    pub lefts: Vec<f64>,
    /// From the left end of the line to the right end.
    pub window: (f64, f64),
    /// The elements, and ends that do not move.
    pub parts: Vec<Part>,
}

impl Places {
    /// Bars of these lengths one after the other. The left end of the line is at 0; where it is
    /// endless, the end of its bar is.
    pub fn of(
        network: &Network,
        lengths: impl Iterator<Item = f64>,
    ) -> Result<Places, PictureError> {
        let lengths: Vec<f64> = lengths.collect();
        let scene = network.scene();
        let first = *lengths.first().ok_or(PictureError::NoBars)?;
        let mut x = if scene.line.left == End::Endless { -first } else { 0.0 };
        let start = x;
        let impedance = |element| {
            let bar: Option<&wavestep::network::ModelBar> = network.model().bars.get(&element);
            bar.and_then(|bar| bar.impedance.as_constant())
                .map_or(1.0, |value| num_traits::ToPrimitive::to_f64(&value).unwrap_or(1.0))
        };
        let stoutest =
            scene.line.elements.iter().map(|element| match scene.elements[*element].kind {
                Kind::Bar(_) => impedance(*element),
                _ => 0.0,
            });
        let stoutest = stoutest.fold(0.0, f64::max);
        let (mut lefts, mut parts) = (Vec::new(), Vec::new());
        let wall = |x| Part { name: String::new(), from: x, to: x, shape: Shape::Wall };
        if scene.line.left == End::Fixed {
            parts.push(wall(x));
        }
        for element in &scene.line.elements {
            let name = scene.elements[*element].name.clone();
            let from = x;
            let shape = match scene.elements[*element].kind {
                Kind::Bar(_) => {
                    x += lengths[lefts.len()];
                    lefts.push(from);
                    Shape::Bar(impedance(*element) / stoutest)
                }
                _ => Shape::Lump,
            };
            parts.push(Part { name, from, to: x, shape });
        }
        if scene.line.right == End::Fixed {
            parts.push(wall(x));
        }
        Ok(Places { lefts, window: (start, x), parts })
    }
}

/// The waves of a bar with neighbouring strips joined that hardly differ, none over a front.
fn joined(bar: &BarWaves) -> BarWaves {
    let values = || bar.right.iter().chain(&bar.left).map(|strip| strip.value);
    let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
    let join = |strips: &[Strip], fronts: &[Front]| {
        let mut found: Vec<Strip> = Vec::new();
        // The least value and the greatest in the last strip.
        let mut ends = (0.0, 0.0);
        for strip in strips {
            let both = (strip.value.min(ends.0), strip.value.max(ends.1));
            let is_front = fronts.iter().any(|front| front.at == strip.from);
            match found.last_mut() {
                Some(last) if !is_front && both.1 - both.0 <= FLAT * range => {
                    (last.to, ends) = (strip.to, both);
                    last.value = f64::midpoint(ends.0, ends.1);
                }
                _ => {
                    found.push(*strip);
                    ends = (strip.value, strip.value);
                }
            }
        }
        found
    };
    let right = join(&bar.right, &bar.right_fronts);
    let left = join(&bar.left, &bar.left_fronts);
    BarWaves { right, left, ..bar.clone() }
}

/// The places and times at which a strip to the right and one to the left cross.
fn cells_of(
    bar: &BarWaves,
    left: f64,
    quantity: Quantity,
    times: (f64, f64),
) -> impl Iterator<Item = Cell> {
    let travel = bar.length * bar.slowness;
    let within = [(left, left + bar.length), times];
    let corner = move |entered: f64, other: f64| {
        let x = left + (other - entered + travel) / (2.0 * bar.slowness);
        (x, (entered + other + travel) / 2.0)
    };
    let value = move |f: f64, g: f64| match quantity {
        Quantity::Velocity => bar.velocity + f + g,
        Quantity::Force => bar.force + bar.impedance * (f - g),
        _ => -(bar.force + bar.impedance * (f - g)) / bar.stiffness,
    };
    bar.right.iter().flat_map(move |f: &Strip| {
        bar.left.iter().filter_map(move |g: &Strip| {
            let outline = [
                corner(f.from, g.from),
                corner(f.from, g.to),
                corner(f.to, g.to),
                corner(f.to, g.from),
            ];
            Cell::clipped(&outline, value(f.value, g.value), within)
        })
    })
}

fn lines_of(bar: &BarWaves, left: f64, window: Window) -> Vec<Line> {
    let (right, travel) = (left + bar.length, bar.length * bar.slowness);
    let line = |front: &Front, from: f64, to: f64| Line {
        from: (from, front.at),
        to: (to, front.at + travel),
        jumps: front.jumps,
    };
    let to_the_right = bar.right_fronts.iter().map(|front| line(front, left, right));
    let to_the_left = bar.left_fronts.iter().map(|front| line(front, right, left));
    to_the_right.chain(to_the_left).filter_map(|line| line.clipped(window)).collect()
}
