//! The march against sums of echoes in 384 bits, against a march in two doubles, and its proven
//! bounds against the true errors, also where something is broken on purpose.

mod double_double;
mod reference;
mod series;
mod waves;

use proptest::prelude::*;
use reference::Reference;
use wavestep_kernels::march::{
    Bounds, Certificate, March, MarchError, MarchOptions, Parameter, Reflection, chebyshev,
};

const PLAIN: MarchOptions =
    MarchOptions { bounds: Bounds::None, threshold: 1.4e-20, limit: 1 << 16 };

fn reflection(rate: f64, zero: f64, ratio: f64) -> Reflection {
    Reflection::exact(rate, zero, ratio).expect("a reflection")
}

fn march(wave: &Reflection, options: MarchOptions) -> March {
    March::new(wave, options).expect("a march")
}

/// What comparing errors with bounds has found.
#[derive(Default)]
struct Found {
    comparisons: usize,
    undecided: usize,
    ratio: f64,
    error: f64,
    bound: f64,
}

impl Found {
    fn compare(&mut self, error: f64, bound: Option<f64>, place: impl Fn() -> String) {
        self.comparisons += 1;
        self.error = self.error.max(error);
        let Some(bound) = bound else {
            self.undecided += 1;
            return;
        };
        assert!(error <= bound, "error {error:e} above its bound {bound:e} at {}", place());
        self.ratio = self.ratio.max(error / bound);
        self.bound = self.bound.max(bound);
    }

    fn report(&self, title: &str) {
        let Found { comparisons, undecided, ratio, error, bound } = self;
        println!(
            "{title}: {comparisons} comparisons, {undecided} without a bound, largest error \
             {error:.1e}, largest bound {bound:.1e}, largest error/bound {ratio:.2e}"
        );
    }
}

/// Compares a march with the reference at some local times on every period.
fn follow(found: &mut Found, [rate, zero, ratio]: [f64; 3], periods: usize, points: &[f64]) {
    let references: Vec<Reference> =
        points.iter().map(|x| Reference::new(rate, zero, ratio, *x, periods)).collect();
    let mut march = march(&reflection(rate, zero, ratio), MarchOptions::default());
    for period in 0..periods {
        let bound = march.bound();
        for (x, reference) in points.iter().zip(&references) {
            let error = reference.error(period, march.value(*x));
            let place = || format!("B {rate}, A {zero}, ρ {ratio}, period {period}, x {x}");
            found.compare(error, bound, place);
        }
        march.advance().expect("room");
    }
}

#[test]
fn rigid_masses_stay_within_their_bounds() {
    let mut found = Found::default();
    for rate in [0.5, 2.0, 7.3] {
        follow(&mut found, [rate, rate, 1.0], 300, &[0.0, 1e-3, 0.41, 0.5, 0.93, 1.0]);
    }
    found.report("rigid masses to period 300");
    assert_eq!(found.undecided, 0);
    assert!(found.comparisons > 5000 && found.error < 4e-14 && found.bound < 3e-11);
    // A bound of zero distance would be suspicious, and so would one that is never approached.
    assert!(found.ratio > 1e-3);
}

#[test]
fn passive_reflections_stay_within_their_bounds() {
    let mut found = Found::default();
    for numbers in [
        [2.0, 2.0, -1.0],
        [2.0, 0.5, 1.0],
        [1.3, -1.1, 1.0],
        [1.3, -1.3, 0.9],
        [3.0, 3.7, 0.8],
        [0.7, 0.2, -0.6],
        [2.0, 1.0, 0.0],
        [40.0, 40.0, 1.0],
        [0.01, 0.01, 1.0],
        [0.01, 0.0, 1.0],
        [700.0, 700.0, 1.0],
    ] {
        assert!(reflection(numbers[0], numbers[1], numbers[2]).is_passive());
        follow(&mut found, numbers, 100, &[0.0, 0.29, 0.77, 1.0]);
    }
    found.report("passive reflections");
    assert_eq!(found.undecided, 0);
    assert!(found.bound < 1e-10);
}

#[test]
fn reflections_that_give_energy_have_bounds_as_long_as_they_are_proven() {
    let mut found = Found::default();
    for numbers in [[2.0, 2.5, 1.0], [1.0, 1.0, 1.1], [2.0, -2.0, 1.0], [3.0, -1.0, -1.2]] {
        follow(&mut found, numbers, 90, &[0.0, 0.6, 1.0]);
    }
    found.report("reflections that give energy");
    assert!(found.undecided < found.comparisons / 2);
}

#[test]
fn a_reflection_that_gives_much_energy_ends_without_a_bound_and_then_with_an_error() {
    let mut march = march(&reflection(2.0, 2.0, 1e3), MarchOptions::default());
    let mut without = 0;
    let error = (0..200).find_map(|_| {
        let failed = march.advance().err();
        without += usize::from(march.bound().is_none());
        failed
    });
    assert!(matches!(error, Some(MarchError::NotFinite { .. })), "{error:?}");
    assert!(without > 50);
    assert_eq!(march.advance().err(), error, "a failed march stays failed");
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 24, failure_persistence: None, ..ProptestConfig::default()
    })]
    #[test]
    fn random_reflections_stay_within_their_bounds(
        rate in 0.05f64..12.0, share in -1.0f64..1.0, ratio in -1.0f64..1.0, x in 0.0f64..1.0,
    ) {
        let mut found = Found::default();
        follow(&mut found, [rate, share * rate, ratio], 60, &[x]);
        prop_assert_eq!(found.undecided, 0);
        follow(&mut found, [rate, rate, 1.0], 60, &[x]);
    }
}

#[test]
fn parameters_within_their_radii_stay_within_the_bound() {
    let radius = 1e-9;
    let (rate, zero, ratio) = (2.0, 1.5, 0.95);
    let within = |value| Parameter::within(value, radius).expect("a number");
    let wave = Reflection::new(within(rate), within(zero), within(ratio)).expect("a reflection");
    let mut found = Found::default();
    let shift = radius * 0.999;
    for (b, a, r) in [(1.0, 1.0, 1.0), (-1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, -1.0, 1.0)] {
        let reference =
            Reference::new(rate + b * shift, zero + a * shift, ratio + r * shift, 0.3, 60);
        let mut march = march(&wave, MarchOptions::default());
        for period in 0..60 {
            let error = reference.error(period, march.value(0.3));
            found.compare(error, march.bound(), || format!("{b} {a} {r}, period {period}"));
            march.advance().expect("room");
        }
    }
    found.report("parameters within radii");
    assert!(found.error > 1e-10 && found.ratio > 1e-3 && found.undecided == 0);
}

/// Records a march with changes to its polynomials, and compares them with the true wave.
fn record_changed(
    found: &mut Found,
    periods: usize,
    change: impl Fn(usize, &mut Vec<f64>, &mut Vec<f64>),
) -> Option<f64> {
    let (rate, zero, ratio) = (2.0, 2.0, 1.0);
    let wave = reflection(rate, zero, ratio);
    let points = [0.0, 0.37, 0.81, 1.0];
    let references = points.map(|x| Reference::new(rate, zero, ratio, x, periods));
    let mut march = march(&wave, PLAIN);
    let mut certificate = Certificate::new(&wave);
    for period in 0..periods {
        let (mut u, mut p) = (march.increment().to_vec(), march.coefficients().to_vec());
        change(period, &mut u, &mut p);
        certificate.record(&u, &p);
        let bound =
            certificate.bound().map(|bound| bound + chebyshev::sizes(&p).evaluation_error());
        for (x, reference) in points.iter().zip(&references) {
            let error = reference.error(period, chebyshev::value(&p, *x));
            found.compare(error, bound, || format!("period {period}, x {x}"));
        }
        march.advance().expect("room");
    }
    certificate.bound()
}

#[test]
fn perturbed_coefficients_are_seen_and_covered() {
    let untouched = record_changed(&mut Found::default(), 30, |_, _, _| ()).expect("a bound");
    assert!(untouched < 1e-12);
    let mut found = Found::default();
    for place in [0, 1, 2, 7, 20] {
        for size in [1e-9, 1e-12, -1e-5] {
            // In the wave, once; in the increment, once; in both, so that their difference is
            // right.
            for (in_wave, in_increment) in [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
                let bound = record_changed(&mut found, 12, |period, u, p| {
                    if period == 8 {
                        p[place] += in_wave * size;
                        u[place] += in_increment * size;
                    }
                });
                let bound = bound.expect("a bound");
                assert!(bound > size.abs() * 0.1, "{place} {size} {in_wave}: {bound:e}");
            }
        }
    }
    found.report("perturbed coefficients");
    assert!(found.ratio > 0.01, "the bound is not far from a real error");
}

#[test]
fn an_error_that_stays_in_the_wave_is_covered() {
    // A jump of the wave that the increments do not show, kept by every later period.
    let mut found = Found::default();
    let bound = record_changed(&mut found, 40, |period, _, p| {
        p[0] += if period >= 5 { 1e-9 } else { 0.0 };
    });
    assert!(bound.expect("a bound") > 1e-9);
    // An error that grows with the period and is in the increments, too.
    record_changed(&mut found, 40, |period, u, p| {
        p[2] += 1e-10 * period as f64;
        u[2] += 1e-10;
    });
    found.report("errors that stay");
}

#[test]
fn a_fixed_number_of_coefficients_is_seen() {
    let wave = reflection(2.0, 2.0, 1.0);
    let mut march = march(&wave, PLAIN);
    let mut cut = Certificate::new(&wave);
    let (mut largest, mut bound) = (0.0f64, None);
    for _ in 0..1000 {
        let keep = |c: &[f64]| c[..c.len().min(48)].to_vec();
        let p = keep(march.coefficients());
        cut.record(&keep(march.increment()), &p);
        bound = cut.bound();
        for i in 0..=20 {
            let x = f64::from(i) / 20.0;
            largest = largest.max((chebyshev::value(&p, x) - march.value(x)).abs());
        }
        assert!(bound.is_none_or(|bound| bound >= largest - 1e-12));
        march.advance().expect("room");
    }
    println!("48 coefficients to period 1000: error {largest:.2}, bound {bound:?}");
    assert!(largest > 0.1);
}

#[test]
fn a_coarse_threshold_is_covered() {
    let mut found = Found::default();
    for threshold in [1e-3, 1e-6, 1e-12] {
        let reference = Reference::new(2.0, 2.0, 1.0, 0.2, 150);
        let options = MarchOptions { threshold, ..Default::default() };
        let mut march = march(&reflection(2.0, 2.0, 1.0), options);
        for period in 0..150 {
            let error = reference.error(period, march.value(0.2));
            found.compare(error, march.bound(), || format!("{threshold} {period}"));
            march.advance().expect("room");
        }
    }
    found.report("coarse thresholds");
    assert!(found.error > 1e-5 && found.undecided == 0);
}

#[test]
fn a_wrong_parameter_is_seen() {
    let truth = reflection(2.0, 2.0, 1.0);
    let reference = Reference::new(2.0, 2.0, 1.0, 0.6, 60);
    for wrong in [[2.0, 2.0, 0.9999], [2.0001, 2.0, 1.0], [2.0, 1.9999, 1.0]] {
        let mut found = Found::default();
        let mut march = march(&reflection(wrong[0], wrong[1], wrong[2]), PLAIN);
        let mut certificate = Certificate::new(&truth);
        for period in 0..60 {
            certificate.record(march.increment(), march.coefficients());
            let error = reference.error(period, march.value(0.6));
            found.compare(error, certificate.bound(), || format!("{wrong:?} {period}"));
            march.advance().expect("room");
        }
        found.report("a wrong parameter");
        assert!(found.error > 1e-6);
    }
}

#[test]
fn ten_thousand_periods_agree_with_two_doubles() {
    for (rate, periods) in [(2.0, 10_001), (0.5, 3001)] {
        let exact = double_double::rigid_mass(rate, periods);
        let mut march = march(&reflection(rate, rate, 1.0), MarchOptions::default());
        (1..periods).for_each(|_| march.advance().expect("room"));
        let found = march.coefficients();
        let at = |k: usize| found.get(k).copied().unwrap_or(0.0);
        // The sum of all differences of coefficients bounds the difference of the waves.
        let difference: f64 =
            exact.iter().enumerate().map(|(k, c)| ((c.high() - at(k)) + c.low()).abs()).sum();
        let bound = march.bound().expect("a bound");
        println!("period {}: difference {difference:.1e}, bound {bound:.1e}", periods - 1);
        assert!(exact.len() >= found.len());
        assert!(difference <= bound && difference < 1e-11 && bound < 1e-9);
    }
}

#[test]
fn values_stay_within_the_error_of_evaluation() {
    let mut ratio = 0.0f64;
    for length in [1usize, 2, 3, 30, 400] {
        // Signs that make all terms add up at either end, or nowhere.
        for sign in [|_| 1.0, |k: usize| 1.0 - 2.0 * (k % 2) as f64, |k| (k as f64 * 2.3).cos()] {
            let c: Vec<f64> = (0..length).map(|k| sign(k) * (1.0 + (k as f64).sin())).collect();
            let bound = chebyshev::sizes(&c).evaluation_error();
            for i in 0..=400 {
                let x = (f64::from(i) / 400.0).powi(2);
                for x in [x, 1.0 - x, x * 1e-3] {
                    let exact = double_double::chebyshev_value(&c, x);
                    let error = ((exact.high() - chebyshev::value(&c, x)) + exact.low()).abs();
                    assert!(error <= bound, "{length} {x}: {error:e} above {bound:e}");
                    ratio = ratio.max(if length > 2 { error / bound } else { 0.0 });
                }
            }
        }
    }
    println!("evaluation: largest error/bound {ratio:.2e}");
    assert!(ratio > 1e-3);
}

/// `∫_0^1 f² dx` of a Chebyshev series, by Fejér's first rule with more points than its degree
/// needs.
fn square_norm(c: &[f64]) -> f64 {
    let points = 2 * c.len() + 2;
    let angle = |j: usize| (j as f64 + 0.5) * std::f64::consts::PI / points as f64;
    let weight = |theta: f64| {
        let term = |i: usize| (2.0 * i as f64 * theta).cos() / (4.0 * (i * i) as f64 - 1.0);
        (1.0 - 2.0 * (1..=points / 2 - 1).map(term).sum::<f64>()) / points as f64
    };
    let square = |x: f64| chebyshev::value(c, x).powi(2);
    (0..points).map(|j| weight(angle(j)) * square((1.0 + angle(j).cos()) / 2.0)).sum()
}

#[test]
fn a_conservative_step_keeps_the_energy_and_a_passive_one_does_not_gain() {
    for [rate, zero, ratio] in
        [[2.0f64, 2.0, 1.0], [0.7, 0.7, -1.0], [2.0, 1.0, 0.9], [2.0, -3.0, 0.6], [2.0, 0.3, 1.0]]
    {
        let (c, s) = (ratio * (zero + rate), ratio * ratio * zero + rate);
        let kappa = 1.0 / (s + (s * s - c * c).max(0.0).sqrt());
        let mut march = march(&reflection(rate, zero, ratio), PLAIN);
        let energy = |march: &March| {
            let end: f64 = march.increment().iter().sum();
            square_norm(march.coefficients()) + kappa * end * end
        };
        let mut before = kappa;
        for period in 0..60 {
            let here = energy(&march);
            assert!(here <= before + 1e-13, "{rate} {zero} {ratio} {period}");
            if ratio.abs() == 1.0 && zero == rate {
                assert!((here - 1.0 / (2.0 * rate)).abs() < 1e-13, "{period}: {here}");
            }
            before = here;
            march.advance().expect("room");
        }
    }
}

#[test]
fn bounds_are_those_that_are_asked_for() {
    let wave = reflection(2.0, 2.0, 1.0);
    assert_eq!(march(&wave, PLAIN).bound(), None);
    let proven = march(&wave, MarchOptions::default());
    assert_eq!(proven.bound_by(&chebyshev::sizes(proven.coefficients())), proven.bound());
    let options = MarchOptions { limit: 20, ..Default::default() };
    let mut short = march(&wave, options);
    let stopped = (0..20).find_map(|_| short.advance().err());
    assert!(matches!(stopped, Some(MarchError::TooManyCoefficients { limit: 20, .. })));
}

#[test]
fn numbers_that_are_no_reflection_are_refused() {
    assert_eq!(Parameter::exact(f64::NAN), Err(MarchError::ParameterNotFinite));
    let negative = Err(MarchError::NegativeRadius { radius: -1.0 });
    assert_eq!(Parameter::within(1.0, -1.0), negative);
    let refused = Reflection::exact(0.0, 1.0, 1.0).unwrap_err();
    assert_eq!(refused, MarchError::RateNotPositive { rate: 0.0 });
    let third = Parameter::within(1.0 / 3.0, 1e-17).expect("a number");
    assert!(third.magnitude() > 1.0 / 3.0 && third.lower() < 1.0 / 3.0);
    assert!(!reflection(2.0, 2.0, 1.5).is_passive());
}

#[test]
fn options_out_of_range_are_refused() {
    let wave = reflection(2.0, 2.0, 1.0);
    for (threshold, limit) in [(0.0, 100), (f64::NAN, 100), (1e-20, 0), (1e-20, 1 << 20)] {
        let options = MarchOptions { threshold, limit, ..PLAIN };
        assert_eq!(March::new(&wave, options).err(), Some(MarchError::Options));
    }
    let fast = March::new(&reflection(1e300, 2.0, 1.0), PLAIN).err();
    assert!(matches!(fast, Some(MarchError::TooManyCoefficients { period: 0, .. })));
}

#[test]
fn nothing_is_proven_of_nothing_or_of_what_is_not_a_number() {
    let mut certificate = Certificate::new(&reflection(2.0, 2.0, 1.0));
    assert_eq!(certificate.bound(), None);
    certificate.record(&[1.0, f64::NAN], &[1.0]);
    assert_eq!(certificate.bound(), None);
    let mut zero = Certificate::new(&reflection(2.0, 2.0, 1.0));
    zero.record(&[], &[]);
    // The wave begins at 1, and an energy bound knows that nothing is above √3 or so.
    assert!(zero.bound().unwrap() >= 1.0);
}
