//! Observables against time.

use super::{PictureError, Prefixed, Sampled};
use wavestep::scene::{Dimension, Measure};
use wavestep_draw::{Caption, Figure, Panel, Series};

/// A quantity with its values on a window of time.
#[derive(Clone, PartialEq, Debug)]
pub struct Course {
    pub name: String,
    /// Its dimension; none for plain numbers.
    pub dimension: Dimension,
    /// What is measured, where that is known and the same in all its terms.
    pub measure: Option<Measure>,
    /// Its values in SI units.
    pub values: Sampled,
}

/// A figure of quantities against time, those of one dimension in one panel; without units, those of one
/// kind.
pub fn against_time(
    title: &str,
    courses: &[Course],
    dimensional: bool,
    (from, to): (f64, f64),
    caption: Caption,
) -> Result<Figure, PictureError> {
    let seconds = Prefixed::in_scene(dimensional, "s", to.abs().max(from.abs()));
    // Units tell kinds apart; without them it is told what is measured.
    let kind_of = |course: &Course| match dimensional {
        true => (course.dimension, None),
        false => (Dimension::NONE, course.measure),
    };
    let mut kinds: Vec<(Dimension, Option<Measure>)> = Vec::new();
    for course in courses {
        if !kinds.contains(&kind_of(course)) {
            kinds.push(kind_of(course));
        }
    }
    let panel = |kind: &(Dimension, Option<Measure>)| {
        let shown: Vec<&Course> =
            courses.iter().filter(|course| kind_of(course) == *kind).collect();
        let (dimension, measure) = kind;
        let points = shown.iter().flat_map(|course| &course.values.points);
        let largest = points.map(|point| point.1.abs()).fold(0.0, f64::max);
        let unit = Prefixed::of(&dimension.unit(), largest);
        let name = match &shown[..] {
            [only] => only.name.as_str(),
            _ => match measure {
                Some(measure) => measure.word(),
                None => name_of(*dimension, dimensional),
            },
        };
        let series = shown.iter().map(|course| {
            let name = if shown.len() > 1 { course.name.as_str() } else { "" };
            let Sampled { points, jumps } = &course.values;
            let points = points.iter().map(|(t, y)| (t * seconds.factor, y * unit.factor));
            let jumps = jumps
                .iter()
                .map(|(t, a, b)| (t * seconds.factor, a * unit.factor, b * unit.factor));
            Series::new(name, points.collect()).jumping(jumps.collect())
        });
        Panel::new(unit.axis(name), series.collect())
    };
    let panels = kinds.iter().map(panel).collect();
    let figure = Figure::new(title, seconds.axis("time"), panels, caption)?;
    Ok(figure.window(from * seconds.factor, to * seconds.factor)?)
}

/// What quantities of one dimension are called together.
fn name_of(dimension: Dimension, dimensional: bool) -> &'static str {
    const NAMES: [(Dimension, &str); 7] = [
        (Dimension::VELOCITY, "velocity"),
        (Dimension::FORCE, "force"),
        (Dimension::PRESSURE, "stress"),
        (Dimension::LENGTH, "displacement"),
        (Dimension::ENERGY, "energy"),
        (Dimension::MOMENTUM, "momentum"),
        (Dimension::NONE, "strain"),
    ];
    let name = NAMES.iter().find(|(known, _)| *known == dimension);
    name.filter(|_| dimensional).map_or("value", |(_, name)| name)
}
