//! The figures of the source: each is drawn, is well formed, and shows what it is said to show.

use std::fs;
use std::path::{Path, PathBuf};
use wavestep::ball::Ball;
use wavestep::figures::{FIGURES, LargestStrain, find};
use wavestep_polynomial::Rational;

fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// The points of one series of a figure, from its data.
fn series(number: &str, name: &str) -> Vec<(f64, f64)> {
    let data = find(number).unwrap().draw().unwrap().csv();
    let row = |line: &str| {
        let fields: Vec<&str> = line.rsplitn(3, ',').collect();
        let [y, x, before] = fields[..] else { return None };
        let here = before.trim_matches('"').ends_with(name);
        here.then(|| Some((x.parse().ok()?, y.parse().ok()?))).flatten()
    };
    data.lines().filter_map(row).collect()
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/figures")
}

/// `UPDATE_DOCUMENTS=1` draws them anew.
#[test]
fn figures_of_the_documents_are_fresh() {
    let page = fs::read_to_string(folder().join("../figures.md")).unwrap();
    for figure in &FIGURES {
        let svg = figure.draw().unwrap().svg();
        assert!(wavestep::plot::png(&svg, 300).is_ok(), "{}", figure.number);
        let file = folder().join(format!("{}.svg", figure.number));
        if std::env::var_os("UPDATE_DOCUMENTS").is_some() {
            fs::write(&file, &svg).unwrap();
        }
        let told = format!("figure {} is stale: run with UPDATE_DOCUMENTS=1", figure.number);
        assert!(fs::read_to_string(&file).ok().as_deref() == Some(svg.as_str()), "{told}");
        assert!(page.contains(&format!("figures/{}.svg", figure.number)), "{}", figure.number);
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
    let svg = wavestep::figures::saint_venant().unwrap().svg();
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
        let estimate = LargestStrain::estimate(&ratio(mass, 1), 60);
        let off = estimate.subtract(&largest, 60).multiply(&largest.reciprocal(60).unwrap(), 60);
        let limit = Ball::from_rational(&ratio(4, 100), 60);
        assert!(
            off.is_below(&limit) && limit.multiply_rational(&ratio(-1, 1), 60).is_below(&off),
            "{mass}: {off}"
        );
    }
}
