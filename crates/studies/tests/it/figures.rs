//! The figures of the source: each is drawn, is well formed, and shows what it is said to show.

use super::ROOT;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use wavestep::ball::Ball;
use wavestep_draw::Chart as _;
use wavestep_polynomial::Rational;
use wavestep_studies::estimates::Estimate;
use wavestep_studies::figures::pulse::until_zero;
use wavestep_studies::figures::{FIGURES, LargestStrain, find};

pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// What a figure holds.
struct Drawn {
    svg: String,
    csv: String,
    json: Value,
}

/// A figure, drawn once for all tests.
fn drawn(number: &str) -> &'static Drawn {
    static DRAWN: [OnceLock<Drawn>; FIGURES.len()] = [const { OnceLock::new() }; FIGURES.len()];
    let place = FIGURES.iter().position(|figure| figure.number == number).unwrap();
    DRAWN[place].get_or_init(|| {
        let chart = find(number).unwrap().draw().unwrap();
        Drawn { svg: chart.svg(), csv: chart.csv(), json: chart.json() }
    })
}

/// The points of one series of a figure, from its data.
fn series(number: &str, name: &str) -> Vec<(f64, f64)> {
    let data = &drawn(number).csv;
    let row = |line: &str| {
        let fields: Vec<&str> = line.rsplitn(3, ',').collect();
        let [y, x, before] = fields[..] else { return None };
        let here = before.trim_matches('"').ends_with(name);
        here.then(|| Some((x.parse().ok()?, y.parse().ok()?))).flatten()
    };
    data.lines().filter_map(row).collect()
}

fn folder() -> PathBuf {
    Path::new(ROOT).join("docs/figures")
}

/// `UPDATE_DOCUMENTS=1` draws them anew.
#[test]
fn figures_of_the_documents_are_fresh() {
    let page = fs::read_to_string(folder().join("../figures.md")).unwrap();
    for figure in &FIGURES {
        let svg = &drawn(figure.number).svg;
        assert!(wavestep_draw::png(svg, 300).is_ok(), "{}", figure.number);
        let file = folder().join(format!("{}.svg", figure.number));
        if std::env::var_os("UPDATE_DOCUMENTS").is_some() {
            fs::write(&file, svg).unwrap();
        }
        let told = format!("figure {} is stale: run with UPDATE_DOCUMENTS=1", figure.number);
        assert!(fs::read_to_string(&file).ok().as_deref() == Some(svg.as_str()), "{told}");
        assert!(page.contains(&format!("figures/{}.svg", figure.number)), "{}", figure.number);
    }
}

/// The value of a diagram at a place and a time that lie inside of a cell.
fn value_at(data: &Value, (x, t): (f64, f64)) -> f64 {
    let inside = |cell: &&Value| {
        let corner = |pair: &Value| (pair[0].as_f64().unwrap(), pair[1].as_f64().unwrap());
        let outline: Vec<(f64, f64)> =
            cell["outline"].as_array().unwrap().iter().map(corner).collect();
        let next = outline.iter().cycle().skip(1);
        let turns = outline
            .iter()
            .zip(next)
            .map(|(a, b)| (b.0 - a.0) * (t - a.1) - (b.1 - a.1) * (x - a.0));
        let turns: Vec<f64> = turns.collect();
        turns.iter().all(|turn| *turn > 0.0) || turns.iter().all(|turn| *turn < 0.0)
    };
    let found = data["cells"].as_array().unwrap().iter().find(inside);
    found.unwrap_or_else(|| panic!("no cell at {x}, {t}"))["value"].as_f64().unwrap()
}

fn json(number: &str) -> &'static Value {
    &drawn(number).json
}

fn near(value: f64, expected: f64, off: f64) {
    assert!((value - expected).abs() <= off, "{value} is not {expected}");
}

/// What holds of a curve at a place between two of its points that lie on a line.
fn at(points: &[(f64, f64)], x: f64) -> f64 {
    let pair = points.windows(2).find(|pair| pair[0].0 <= x && x <= pair[1].0).expect("a place");
    let [(left, below), (right, above)] = [pair[0], pair[1]];
    if left == right { above } else { below + (above - below) * (x - left) / (right - left) }
}

/// The striker of half the impedance slows to a third, and is thrown back with a third; it leaves a pulse
/// of twice its length.
#[test]
fn bars_part_after_two_travel_times() {
    let data = json("6.10");
    let third = 1.0 / 3.0;
    for (place, expected) in [
        ((0.2, 0.5), 1.0),
        ((0.9, 0.5), third),
        ((0.5, 1.9), -third),
        ((0.5, 4.5), -third),
        ((1.1, 1.9), third),
        ((1.1, 2.5), 0.0),
        ((3.0, 3.0), third),
        ((3.9, 2.5), 0.0),
    ] {
        near(value_at(data, place), expected, 1e-14);
    }
}

/// Equal bars: the pulse has half the velocity, and is 2L long once it has left the striker at rest.
#[test]
fn the_pulse_of_an_equal_bar_is_twice_its_length() {
    let data = json("6.11");
    let panels = data["panels"].as_array().unwrap();
    assert_eq!(panels.len(), 6);
    for panel in [&panels[2], &panels[5]] {
        let series = &panel["series"][0];
        assert_eq!(series["name"], "ct/L = 5/2");
        let jumps: Vec<Vec<f64>> = serde_json::from_value(series["jumps"].clone()).unwrap();
        let [rear, front] = &jumps[..] else { panic!("{jumps:?}") };
        near(rear[0], 1.5, 1e-14);
        near(front[0] - rear[0], 2.0, 1e-14);
        assert_eq!((rear[1], rear[2], front[1], front[2]), (0.0, 0.5, 0.5, 0.0));
    }
    // While the striker unloads, its front half still moves.
    let velocity: Vec<Vec<f64>> =
        serde_json::from_value(panels[1]["series"][0]["jumps"].clone()).unwrap();
    near(velocity[0][0], 0.5, 1e-14);
}

/// Behind the first front the pushed bar moves with 1, behind the reflected one with 2; its struck end in
/// period n with 2n + 1.
#[test]
fn a_pushed_bar_gains_two_units_in_each_period() {
    let data = json("6.12");
    let jump = |panel: usize| -> Vec<f64> {
        let jumps = &data["panels"][panel]["series"][0]["jumps"];
        let jumps: Vec<Vec<f64>> = serde_json::from_value(jumps.clone()).unwrap();
        assert_eq!(jumps.len(), 1);
        jumps[0].clone()
    };
    assert_eq!((jump(0), jump(1)), (vec![0.5, 1.0, 0.0], vec![0.25, 1.0, 2.0]));
    // The force is that of the push until the free end sends it back as nothing.
    assert_eq!((jump(2), jump(3)), (vec![0.5, 1.0, 0.0], vec![0.25, 1.0, 0.0]));
    let data = json("6.13");
    for period in [0.0, 1.0, 2.0] {
        near(value_at(data, (0.01, 2.0 * period + 1.0)), 2.0 * period + 1.0, 1e-14);
        near(value_at(data, (0.99, 2.0 * period + 0.5)), 2.0 * period, 1e-14);
    }
}

/// Hertz's force begins with a horizontal tangent as t^(3/2), the spring's is 1 − e^(−t); they cross where
/// both are about 0.7.
#[test]
fn hertz_rises_later_and_ends_sooner() {
    let (hertz, spring) = (series("6.15", "Hertz, m = 3/2"), series("6.15", "linear spring"));
    near(hertz[1].1 / hertz[1].0.powf(1.5), 1.0, 0.01);
    for (t, share) in &spring {
        near(*share, 1.0 - (-t).exp(), 1e-14);
    }
    let later = hertz.iter().zip(&spring).skip(1).position(|(a, b)| a.1 > b.1).unwrap();
    near(spring[later + 1].1, 0.7, 0.05);
    assert!(hertz.iter().zip(&spring).skip(later + 1).all(|(a, b)| a.1 > b.1));
}

/// The spring's force rises as (1 − e^(−t))/2 until the wave returns; the free end carries none, and the
/// long bar none once the bars have parted.
#[test]
fn the_contact_spring_lets_the_force_rise() {
    let data = json("6.17");
    for (x, t) in [(1.2, 1.0), (1.05, 1.5), (2.5, 3.4)] {
        near(value_at(data, (x, t)), (1.0 - f64::exp(x - 1.0 - t)) / 2.0, 0.006);
    }
    for t in [1.3, 1.9, 2.7, 3.4, 5.1] {
        near(value_at(data, (0.003, t)), 0.0, 0.02);
    }
    near(value_at(data, (1.02, 5.5)), 0.0, 1e-14);
    // Cells are fine: neighbours at the joint differ by hundredths.
    for step in 1..100 {
        let t = 0.02 * f64::from(step) + 0.0011;
        let pair = [0.999, 1.001].map(|x| value_at(data, (x, t)));
        near(pair[0], pair[1], 0.012);
    }
}

/// With half the mass in the bar: e^(−t/2) until 2, doubled at the fixed end, nothing at the struck end
/// after the release at 4.7086.
#[test]
fn a_mass_leaves_the_bar() {
    let data = json("6.20");
    near(value_at(data, (0.999, 1.003)), 2.0, 0.03);
    near(value_at(data, (0.3, 1.0)), (-0.35_f64).exp(), 0.01);
    near(value_at(data, (0.002, 5.5)), 0.0, 0.02);
    let (mass, struck) = (series("6.21", "mass"), series("6.21", "struck end, ε0"));
    for (t, v) in mass.iter().filter(|point| point.0 < 2.0) {
        near(*v, (-t / 2.0).exp(), 1e-14);
    }
    let leaves = 4.708_567_243_67;
    for (t, v) in mass.iter().filter(|point| point.0 > leaves + 1e-9) {
        near(*v, -0.925_246_996_732, 1e-11);
        near(at(&struck, *t), 0.0, 1e-14);
    }
    assert!(struck.iter().filter(|point| point.0 < leaves - 0.1).all(|point| point.1 > 0.0));
    let fixed = &json("6.21")["panels"][1]["series"][1]["jumps"];
    let jumps: Vec<Vec<f64>> = serde_json::from_value(fixed.clone()).unwrap();
    assert_eq!((jumps[0][0], jumps[0][1], jumps[0][2]), (1.0, 0.0, 2.0));
    near(jumps[1][2], 2.0 * (1.0 + (-1.0_f64).exp()), 1e-14);
    let marks = &json("6.21")["marks"];
    near(marks[0]["x"].as_f64().unwrap(), leaves, 1e-9);
}

/// Twice the front of each period: 2, and 2 (1 + e^(−2μ)); the estimate stands 11.8 % below the largest
/// strain at a ratio of 1/4, 7.6 % below it at 2.
#[test]
fn strains_of_periods_are_twice_their_fronts() {
    assert!(series("6.22", "n = 0").iter().all(|point| point.1 == 2.0));
    for (ratio, strain) in series("6.22", "n = 1") {
        near(strain, 2.0 * (1.0 + (-2.0 / ratio).exp()), 1e-14);
    }
    let estimate = series("6.22", "estimate 6.86");
    near(estimate[0].1, 1.0 + (1.0_f64 / 3.0).sqrt(), 1e-14);
    let largest = |ratio: f64| -> f64 {
        let here = |n: u32| {
            let points = series("6.22", &format!("n = {n}"));
            points.iter().find(|point| point.0 == ratio).map(|point| point.1)
        };
        (0..6).filter_map(here).fold(0.0, f64::max)
    };
    let off = |ratio: f64| at(&estimate, ratio) / largest(ratio) - 1.0;
    near(off(0.25), -0.1184, 5e-5);
    near(off(2.0), -0.0761, 5e-5);
}

/// A wave has a crest after each period and each wavelength; an eighth of a period later it stands an
/// eighth of a wavelength further on.
#[test]
fn a_wave_repeats_itself() {
    let wave = series("6.23", "u/U");
    for (t, expected) in [(0.0, 1.0), (0.5, -1.0), (1.0, 1.0), (1.5, -1.0), (2.0, 1.0)] {
        near(at(&wave, t), expected, 1e-14);
    }
    let later = series("6.24", "an eighth of a period later");
    for (x, u) in series("6.24", "t = 0").into_iter().filter(|point| point.0 < 1.8) {
        near(at(&later, x + 0.125), u, 1e-3);
    }
}

/// Two waves are nowhere outside of their envelope, which is 2 at the beginning and nothing at π/Δk.
#[test]
fn two_waves_stay_inside_their_envelope() {
    let (sum, envelope) = (series("6.25", "both waves"), series("6.25", "envelope"));
    let half = |x: f64| 0.075 * x;
    assert_eq!((sum[0].1, envelope[0].1), (2.0, 2.0));
    for (x, u) in &envelope {
        near(*u, 2.0 * half(*x).cos().abs(), 1e-13);
    }
    for (x, u) in &sum {
        assert!(u.abs() <= 2.0 * half(*x).cos().abs() + 1e-12);
    }
    near(at(&envelope, std::f64::consts::PI / 0.15), 0.0, 0.05);
}

/// ω = 2 sin(k/2) at k = 2: the chord has the slope sin 1, the tangent cos 1.
#[test]
fn chord_and_tangent_have_the_slopes_of_the_velocities() {
    let slope = |name: &str| {
        let points = series("6.26", name);
        let (from, to) = (points[0], points[points.len() - 1]);
        (to.1 - from.1) / (to.0 - from.0)
    };
    near(slope("chord, slope c_p = ω/k"), 1.0_f64.sin(), 1e-14);
    near(slope("tangent, slope c_g = dω/dk"), 1.0_f64.cos(), 1e-14);
    for (k, omega) in series("6.26", "ω(k) = 2 sin(k/2)") {
        near(omega, 2.0 * (k / 2.0).sin(), 1e-14);
    }
}

/// The marked crest lies on the wave and on its envelope, above zero; it runs with c_p, the group with
/// c_g = 2, and so passes from before its middle to behind it.
#[test]
fn crests_run_back_through_the_group() {
    let data = json("6.27");
    let mut before = None;
    for (panel, periods) in data["panels"].as_array().unwrap().iter().zip([0.0, 1.25, 2.5, 3.75]) {
        let points = |i: usize| -> Vec<(f64, f64)> {
            serde_json::from_value(panel["series"][i]["points"].clone()).unwrap()
        };
        let (wave, envelope) = (points(0), points(1));
        let [crest] = points(3)[..] else { panic!("one crest") };
        let [middle] = points(4)[..] else { panic!("one middle") };
        let carrier = (0.94_f64.powi(2) + 1.06_f64.powi(2)) / 2.0;
        let time = periods * std::f64::consts::TAU / carrier;
        near(crest.0, 2.0 * std::f64::consts::TAU + carrier * time, 1e-9);
        near(middle.0, 2.0 * time, 1e-9);
        assert!(crest.1 > 1.0, "{crest:?}");
        near(at(&wave, crest.0), crest.1, 0.01);
        near(at(&envelope, crest.0), crest.1, 0.01);
        // No higher point of the wave within half a wavelength, but for the slope of the envelope.
        let higher =
            wave.iter().filter(|point| (point.0 - crest.0).abs() < 3.0).map(|point| point.1);
        assert!(higher.fold(0.0, f64::max) < crest.1 + 0.01);
        let ahead = crest.0 - middle.0;
        assert!(before.is_none_or(|before| ahead < before));
        assert_eq!(ahead > 0.0, periods < 2.0, "{ahead}");
        before = Some(ahead);
    }
}

/// Where the curve of dispersion is concave downwards the group is slower than the phase, where it is
/// concave upwards faster; the peak of a pulse lies between long waves and the phase velocity. The shapes of pulses differ
/// by no more than 5.52 % and 6.04 %.
#[test]
fn peaks_differ_less_from_long_waves_than_phases() {
    for (number, last, sign, largest) in [("6.28", 2.0, -1.0, 0.0552), ("6.29", 4.0, 1.0, 0.0604)] {
        let (phase, group) = (series(number, "c_p = ω/k"), series(number, "c_g = dω/dk"));
        for ((_, phase), (_, group)) in phase.iter().zip(&group) {
            assert!(sign * (phase - 1.0) > 0.0 && sign * (group - phase) > 0.0);
        }
        let square = series(number, "c_pp, square pulse");
        let triangle = series(number, "c_pp, triangular pulse");
        assert_eq!((square.len(), square[39].0), (40, last));
        let mut most: f64 = 0.0;
        for ((k, square), (_, triangle)) in square.iter().zip(&triangle) {
            let phase = at(&phase, *k);
            for peak in [square, triangle] {
                assert!(sign * (peak - 1.0) > 0.0 && sign * (phase - peak) > 0.0, "{number}, {k}");
            }
            most = most.max((square - triangle).abs() / square);
        }
        near(most, largest, 5e-5);
    }
}

/// The rise time falls as the cube root of velocity times radius.
#[test]
fn rise_times_fall_as_a_cube_root() {
    let points = series("6.16", "50 % of the largest force");
    let ((x, y), (later, lower)) = (points[0], points[points.len() - 1]);
    assert!(((lower / y).ln() / (later / x).ln() + 1.0 / 3.0).abs() < 1e-12);
}

/// Curves begin at no force and end at no force; the longer the bar, the larger the force.
#[test]
fn pulses_end_at_zero_and_grow_with_the_bar() {
    let mut before = 1.0;
    for name in ["μ = 8", "μ = 4", "μ = 2", "μ = 1"] {
        let points = series("6.18", name);
        assert_eq!(points[0].1, 0.0);
        assert!(points[points.len() - 1].1.abs() < 2e-2, "{name}");
        let largest = points.iter().map(|point| point.1).fold(0.0, f64::max);
        assert!(largest < before, "{name}");
        before = largest;
    }
}

/// The ratios of masses at which the largest strain moves to the next period, to 12 digits.
#[test]
fn the_largest_strain_moves_to_later_periods() {
    let strains = LargestStrain::new(8).unwrap();
    let digits = ["5.68611974353", "13.8157926515", "25.1713121082", "39.7649282814"];
    for (period, digits) in (1..).zip(digits) {
        let at = strains.overtaking(period, 80).unwrap();
        let told = at.to_decimal(20);
        assert!(told.midpoint().to_string().starts_with(digits), "{period}: {told}");
        assert!(told.radius().to_rational() < ratio(1, 1_000_000_000_000), "{told}");
        // A little below the ratio this period has the larger strain, a little above it the next one;
        // no other period before the contact opens has a larger one.
        let near = told.midpoint().to_rational();
        for (factor, largest) in [(ratio(999, 1000), period), (ratio(1001, 1000), period + 1)] {
            let mu = (&near * factor).recip();
            let strain = |n| strains.strain(n, &mu, 80);
            assert!(strains.is_pushed(largest, &mu), "{period}");
            for n in (0..=8).filter(|n| *n != largest && strains.is_pushed(*n, &mu)) {
                assert!(strain(n).is_below(&strain(largest)), "{period} {n}");
            }
        }
    }
    // In the first period it never stays: 2 against 2 (1 + e^(−2μ)).
    assert!(strains.overtaking(0, 80).is_none());
    assert!(LargestStrain::new(1000).is_none());
}

/// The ratios of masses at which the contact lasts to the end of a period, to 12 digits, and the curve
/// that passes through them.
#[test]
fn the_release_moves_to_later_periods() {
    let strains = LargestStrain::new(7).unwrap();
    let digits = [
        "1.72833218876",
        "4.15116350711",
        "7.37137207709",
        "11.4051030110",
        "16.2529282849",
        "21.9141813733",
    ];
    let page = fs::read_to_string(folder().join("../saint-venant.md")).unwrap();
    for (period, digits) in (1..).zip(digits) {
        let at = strains.outlasting(period, 80).unwrap();
        let told = at.to_decimal(20);
        assert!(told.midpoint().to_string().starts_with(digits), "{period}: {told}");
        assert!(told.radius().to_rational() < ratio(1, 1_000_000_000_000), "{told}");
        assert!(page.contains(digits), "{digits}");
        let mu = (told.midpoint().to_rational() * ratio(100_001, 100_000)).recip();
        let end = 2.0 * (period as f64 + 1.0);
        let before = (told.midpoint().to_rational() * ratio(99_999, 100_000)).recip();
        assert!((strains.release(&before).unwrap() - end).abs() < 1e-3, "{period}");
        let release = strains.release(&mu).unwrap();
        // The front that arrives at the end of the period presses the bodies together once more.
        assert!(release > end && release < end + 1.0, "{period}: {release}");
    }
    let figure = crate::saint_venant::saint_venant();
    // The curve jumps there, from the end of the period, and reaches to the edge.
    let release = &figure.json()["panels"][0]["series"][0];
    let jumps: Vec<[f64; 3]> = serde_json::from_value(release["jumps"].clone()).unwrap();
    for (period, (digits, [x, before, after])) in (1..).zip(digits.iter().zip(&jumps)) {
        near(*x, digits.parse().unwrap(), 1e-9);
        assert!(*before == 2.0 * (f64::from(period) + 1.0) && *after < before + 1.0, "{digits}");
    }
    assert_eq!(
        (jumps.len(), &release["points"].as_array().unwrap().last().unwrap()[0]),
        (8, &40.0.into())
    );
    let svg = figure.svg();
    let file = folder().join("saint-venant.svg");
    if std::env::var_os("UPDATE_DOCUMENTS").is_some() {
        fs::write(&file, &svg).unwrap();
    }
    assert!(
        fs::read_to_string(&file).ok().as_deref() == Some(svg.as_str()),
        "saint-venant.svg is stale"
    );
}

/// 6.86 is near the envelope.
#[test]
fn the_estimate_is_near_the_envelope() {
    let strains = LargestStrain::new(6).unwrap();
    for mass in [5, 10, 20, 30] {
        let mu = ratio(1, mass);
        let largest = (0..=6)
            .filter(|n| strains.is_pushed(*n, &mu))
            .map(|n| strains.strain(n, &mu, 60))
            .reduce(|a, b| if a.is_below(&b) { b } else { a })
            .unwrap();
        let estimate = Estimate::Better.of(&ratio(mass, 1));
        let off = estimate.subtract(&largest, 60).multiply(&largest.reciprocal(60).unwrap(), 60);
        let limit = Ball::from_rational(&ratio(4, 100), 60);
        assert!(
            off.is_below(&limit) && limit.multiply_rational(&ratio(-1, 1), 60).is_below(&off),
            "{mass}: {off}"
        );
    }
}

#[test]
fn curves_end_where_they_fall_through_zero() {
    let points = [(0.0, 0.0), (1.0, 2.0), (2.0, -2.0), (3.0, 1.0)];
    assert_eq!(until_zero(&points), [(0.0, 0.0), (1.0, 2.0), (1.5, 0.0)]);
    assert_eq!(until_zero(&points[..2]), points[..2]);
}
