//! Dispersive waves: figures 6.23 to 6.29.

use super::{Drawn, Listed};
use crate::dispersion::{Builtin, Quantity, Relation, Shape, peak_velocity_at};
use crate::picture::PictureError;
use std::f64::consts::TAU;
use wavestep_draw::{Axis, Figure, Look, Panel, PlotError, Series};

const POINTS: u32 = 240;

/// Two waves that lie near each other, on the built-in relation of masses on springs.
const TWO_WAVES: [f64; 2] = [1.0, 1.15];

/// Which crest of a group is followed, counted from its middle.
const CREST: f64 = 2.0;

/// A curve of a function from 0 to `last`.
fn curve(name: &str, last: f64, function: impl Fn(f64) -> f64) -> Series {
    dense_curve(POINTS, name, last, function)
}

fn dense_curve(count: u32, name: &str, last: f64, function: impl Fn(f64) -> f64) -> Series {
    let points = (0..=count).map(|i| f64::from(i) / f64::from(count) * last);
    Series::new(name, points.map(|x| (x, function(x))).collect())
}

fn of(relation: &Relation, quantity: Quantity, k: f64) -> Result<f64, PictureError> {
    Ok(relation.sample(quantity, k)?.value)
}

fn one_panel(
    listed: &Listed,
    [x, y]: [&str; 2],
    series: Vec<Series>,
    remarks: &[&str],
) -> Result<Figure, PlotError> {
    let panel = Panel::new(Axis::linear(y), series);
    listed.figure(Axis::linear(x), vec![panel], remarks)
}

/// 6.23.
pub(super) fn against_time(listed: &Listed) -> Drawn {
    let wave = curve("", 2.0, |t| (TAU * t).cos());
    let remarks = ["At x = 0: a period is 2π/ω."];
    Ok(Box::new(one_panel(listed, ["time ωt/2π", "u/U"], vec![wave], &remarks)?))
}

/// 6.24.
pub(super) fn against_place(listed: &Listed) -> Drawn {
    let now = curve("t = 0", 2.0, |x| (TAU * x).cos());
    let later = curve("an eighth of a period later", 2.0, |x| (TAU * (0.125 - x)).cos());
    let remarks = ["A wavelength is λ = 2π/k; crests run with c_p = ω/k."];
    Ok(Box::new(one_panel(listed, ["place x/λ", "u/U"], vec![now, later], &remarks)?))
}

/// The two waves and their envelope at a time, against place.
fn pair(time: f64) -> Result<[Series; 3], PictureError> {
    let relation = Builtin::Lattice.relation();
    let omega = |k: f64| of(&relation, Quantity::Frequency, k);
    let [first, second] = TWO_WAVES;
    let (w1, w2) = (omega(first)?, omega(second)?);
    let last = 2.0 * TAU / (second - first);
    let sum = move |x: f64| (w1 * time - first * x).cos() + (w2 * time - second * x).cos();
    let half = move |x: f64| ((w2 - w1) * time - (second - first) * x) / 2.0;
    Ok([
        dense_curve(1200, "both waves", last, sum),
        curve("envelope", last, move |x| 2.0 * half(x).cos().abs()).styled(1),
        curve("", last, move |x| -2.0 * half(x).cos().abs()).styled(1),
    ])
}

/// 6.25.
pub(super) fn beats(listed: &Listed) -> Drawn {
    let remarks = ["Two waves of equal amplitude U, k = 1 and 1.15, at t = 0 (6.91a)."];
    let series = pair(0.0)?.to_vec();
    Ok(Box::new(one_panel(listed, ["place x", "u/U"], series, &remarks)?))
}

/// 6.26.
pub(super) fn diagram(listed: &Listed) -> Drawn {
    let relation = Builtin::Lattice.relation();
    let (k, last) = (2.0, std::f64::consts::PI);
    let omega = of(&relation, Quantity::Frequency, k)?;
    let group = of(&relation, Quantity::GroupVelocity, k)?;
    let mut points = Vec::new();
    for i in 0..=POINTS {
        let k = f64::from(i) / f64::from(POINTS) * last;
        points.push((k, of(&relation, Quantity::Frequency, k)?));
    }
    let tangent = |x: f64| omega + group * (x - k);
    let series = vec![
        Series::new("ω(k) = 2 sin(k/2)", points),
        Series::new("chord, slope c_p = ω/k", vec![(0.0, 0.0), (last, omega / k * last)]),
        Series::new("tangent, slope c_g = dω/dk", vec![(0.8, tangent(0.8)), (last, tangent(last))]),
    ];
    let remarks = ["Masses on springs at unit distances; chord and tangent at k = 2."];
    let figure = one_panel(listed, ["wavenumber k", "frequency ω"], series, &remarks)?;
    Ok(Box::new(figure.mark(k, "k = 2")?))
}

/// 6.27.
pub(super) fn crests(listed: &Listed) -> Drawn {
    let relation = Builtin::Beam.relation();
    let [k, step] = [1.0, 0.12];
    let omega = |k: f64| of(&relation, Quantity::Frequency, k);
    let (w1, w2) = (omega(k - step / 2.0)?, omega(k + step / 2.0)?);
    let (carrier, group_velocity) = ((w1 + w2) / 2.0, (w2 - w1) / step);
    let last = TAU / step * 1.2;
    let mut panels = Vec::new();
    for periods in [0.0, 1.25, 2.5, 3.75] {
        let time = periods * TAU / carrier;
        let half = move |x: f64| ((w2 - w1) * time - step * x) / 2.0;
        let wave = move |x: f64| 2.0 * half(x).cos() * (carrier * time - k * x).cos();
        // The second crest of the first group, ahead of its middle, where both waves are in step; it is
        // followed for as long as the envelope keeps its sign there.
        let crest = carrier / k * time + CREST * TAU / k;
        let middle = group_velocity * time;
        let envelope = |sign: f64| move |x: f64| sign * 2.0 * half(x).cos().abs();
        let series = vec![
            dense_curve(900, "both waves", last, wave).styled(0),
            curve("envelope", last, envelope(1.0)).styled(1),
            curve("", last, envelope(-1.0)).styled(1),
            Series::new("one crest", vec![(crest, wave(crest))]).look(Look::Points).styled(3),
            Series::new("middle of its group", vec![(middle, 2.0)]).look(Look::Points).styled(2),
        ];
        panels.push(Panel::new(Axis::linear(&format!("u/U, {periods} periods")), series));
    }
    let remarks = [
        "Euler's beam, ω = k², k = 0.94 and 1.06; a period is that of the mean frequency. The group \
                    runs twice as fast as its crests: the crest that is marked is ahead of the middle at \
                    first, and behind it in the end.",
    ];
    let place = Axis::linear("place x, where 2π is a mean wavelength");
    Ok(Box::new(listed.figure(place, panels, &remarks)?.window(0.0, last)?))
}

/// `c_p`, `c_g`, and `c_pp` of a square and a triangular pulse.
fn velocities(listed: &Listed, relation: &Relation, last: f64, remarks: &[&str]) -> Drawn {
    let wave_numbers =
        |count: u32| (1..=count).map(move |i| f64::from(i) / f64::from(count) * last);
    let (mut phase, mut group) = (Vec::new(), Vec::new());
    for k in wave_numbers(120) {
        phase.push((k, of(relation, Quantity::PhaseVelocity, k)?));
        group.push((k, of(relation, Quantity::GroupVelocity, k)?));
    }
    let mut series = vec![Series::new("c_p = ω/k", phase), Series::new("c_g = dω/dk", group)];
    for (name, shape) in
        [("c_pp, square pulse", Shape::Square), ("c_pp, triangular pulse", Shape::Triangle)]
    {
        let mut peak = Vec::new();
        for k in wave_numbers(40) {
            peak.push((k, peak_velocity_at(relation, shape, k)?.value));
        }
        series.push(Series::new(name, peak));
    }
    let axes = ["wavenumber k; for c_pp its k_co = 2π/b", "velocity"];
    Ok(Box::new(one_panel(listed, axes, series, remarks)?))
}

/// 6.28.
pub(super) fn concave_downwards(listed: &Listed) -> Drawn {
    let remarks = ["ω = k − k³/12; pulses given in space, of length b (6.100)."];
    velocities(listed, &Builtin::Cubic.relation(), 2.0, &remarks)
}

/// 6.29.
pub(super) fn concave_upwards(listed: &Listed) -> Drawn {
    let remarks = ["ω = k √(1 + k²/12); pulses given in space, of length b (6.100)."];
    velocities(listed, &Builtin::StiffString.relation(), 4.0, &remarks)
}
