//! Fields along the line at given times.

use super::lagrange::Places;
use super::{PictureError, Prefixed};
use wavestep::ball::Ball;
use wavestep::field::{FieldEvaluator, Profile, Quantity};
use wavestep::scene::End;
use wavestep_draw::{Caption, Figure, Panel, Series};
use wavestep_polynomial::Rational;

/// How many points a bar has where fields are not constant.
const POINTS: usize = 160;

/// A figure of fields along the line: a panel for each, with one line for each time, none of them after
/// the last one of the evaluator.
pub fn along_the_line(
    evaluator: &FieldEvaluator<'_>,
    quantities: &[Quantity],
    times: &[Rational],
    caption: Caption,
) -> Result<Figure, PictureError> {
    if times.is_empty() {
        return Err(wavestep::signal::EvaluateError::EmptyWindow.into());
    }
    let network = evaluator.network();
    let mut found: Vec<Vec<Profile>> = Vec::with_capacity(times.len());
    for time in times {
        found.push(evaluator.profiles(time, POINTS)?);
    }
    // Endless bars are looked at the farther the later it is.
    let count = found[0].len();
    let length = |bar: usize| found.iter().map(|profiles| profiles[bar].length).fold(0.0, f64::max);
    let places = Places::of(network, (0..count).map(length))?;
    let dimensional = network.scene().dimensional;
    let prefixed = |unit: &str, largest| Prefixed::in_scene(dimensional, unit, largest);
    let metre = prefixed("m", places.window.0.abs().max(places.window.1));
    let seconds: Vec<f64> =
        times.iter().map(|time| Ball::from_rational(time, 64).to_double().0).collect();
    let second = prefixed("s", seconds.iter().copied().fold(0.0, f64::max));
    let mirrored = |bar: usize| bar == 0 && network.scene().line.left == End::Endless;
    let mut panels = Vec::with_capacity(quantities.len());
    for quantity in quantities {
        let of = |fields: &[f64; 4]| fields[*quantity as usize];
        let all = found.iter().flatten().flat_map(|profile| profile.stretches.iter().flatten());
        let largest = all.map(|(_, fields)| of(fields).abs()).fold(0.0, f64::max);
        let unit = prefixed(&quantity.dimension().unit(), largest);
        let mut series = Vec::with_capacity(times.len());
        for (profiles, time) in found.iter().zip(&seconds) {
            let mut points: Vec<(f64, f64)> = Vec::new();
            let mut jumps = Vec::new();
            for (bar, profile) in profiles.iter().enumerate() {
                let place = |x: f64| if mirrored(bar) { -x } else { places.lefts[bar] + x };
                let on = |(x, fields): &(f64, [f64; 4])| {
                    (place(*x) * metre.factor, of(fields) * unit.factor)
                };
                let all = profile.stretches.iter().map(|stretch| stretch.iter().map(on).collect());
                let mut stretches: Vec<Vec<(f64, f64)>> = all.collect();
                if mirrored(bar) {
                    stretches.reverse();
                    stretches.iter_mut().for_each(|stretch| stretch.reverse());
                }
                for stretch in stretches {
                    let Some(&(x, start)) = stretch.first() else { continue };
                    if let Some(&(_, before)) = points.last()
                        && (start - before).abs() > 1e-9 * largest * unit.factor
                    {
                        jumps.push((x, before, start));
                        points.push((f64::NAN, f64::NAN));
                    }
                    points.extend(without_needless(&stretch));
                }
            }
            let shown = time * second.factor;
            let space = if second.unit.is_empty() { "" } else { " " };
            let name = format!("t = {}{space}{}", shortest(shown), second.unit);
            series.push(Series::new(&name, points).jumping(jumps));
        }
        panels.push(Panel::new(unit.axis(quantity.name()), series));
    }
    let (left, right) = (places.window.0 * metre.factor, places.window.1 * metre.factor);
    let title = &network.scene().title;
    Ok(Figure::new(title, metre.axis("place"), panels, caption)?.window(left, right)?)
}

/// The two ends of what is constant, else all points.
fn without_needless(stretch: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let flat = stretch.iter().all(|point| point.1 == stretch[0].1);
    match flat && stretch.len() > 2 {
        true => vec![stretch[0], stretch[stretch.len() - 1]],
        false => stretch.to_vec(),
    }
}

/// A number in at most six figures.
fn shortest(value: f64) -> String {
    let text = format!("{value:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
