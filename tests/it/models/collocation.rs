//! Collocation: its order, stiff equations, and closed forms of local contact.

use wavestep::model::collocation::{Collocation, Pressing};
use wavestep::model::line::LocalContact;
use wavestep::model::track::{POINTS, points};
use wavestep::network::System;

/// A system with these rates and inputs.
fn system(change: &[&[f64]]) -> System<f64> {
    let change: Vec<Vec<f64>> = change.iter().map(|row| row.to_vec()).collect();
    let output = vec![vec![0.0; change[0].len()]];
    System {
        group: vec![0],
        held: vec![false],
        heavy: Vec::new(),
        kept: Vec::new(),
        driven: Vec::new(),
        change,
        output,
        closed: Vec::new(),
    }
}

/// The largest error on a piece in which `cos ωt` turns by `ω`.
fn error(frequency: f64) -> f64 {
    let system = system(&[&[0.0, -frequency], &[frequency, 0.0]]);
    let turning = Collocation::of(&system, &[], 1.0).unwrap();
    let states = turning.solve(&[1.0, 0.0], &mut [], &[1.0, 1.0], 1e-15).unwrap();
    let errors = states[0].iter().zip(points()).map(|(y, t)| (y - (frequency * t).cos()).abs());
    errors.fold(0.0, f64::max)
}

#[test]
fn the_order_is_twenty_five() {
    for (long, short) in [(24.0, 18.0), (18.0, 14.0)] {
        let order = (error(long) / error(short)).ln() / f64::ln(long / short);
        assert!((22.0..27.0).contains(&order), "{order}");
    }
    for frequency in [0.1, 1.0, 6.0] {
        assert!(error(frequency) < 4e-15, "{frequency}: {:e}", error(frequency));
    }
}

/// `y' = −λ (y − cos t) − sin t` from 1 is `cos t`, however large `λ` is.
#[test]
fn stiff_equations_are_solved_on_long_pieces() {
    for rate in [1.0, 1e2, 1e4] {
        let system = system(&[&[-rate, 1.0]]);
        let stiff = Collocation::of(&system, &[], 1.0).unwrap();
        let mut input = [points().map(|t| rate * t.cos() - t.sin())];
        let states = stiff.solve(&[1.0], &mut input, &[1.0], 1e-15).unwrap();
        for (y, t) in states[0].iter().zip(points()) {
            assert!((y - t.cos()).abs() < 1e-15 * (8.0 + rate), "{rate}: {y} at {t}");
        }
    }
}

/// Bars of great length that meet with velocity 1: `α' = 1 − α^m` for `k (1/Z_1 + 1/Z_2) = 1`.
fn assert_followed(exponent: f64, from: f64, exact: impl Fn(f64) -> f64) {
    let system = system(&[&[0.0, 1.0, -1.0]]);
    let contact = LocalContact { force: 1.0, compression: 1.0, exponent };
    let pressing = [Pressing { contact, state: 0, input: 1 }];
    let node = Collocation::of(&system, &pressing, 0.75).unwrap();
    let mut input = [[1.0; POINTS], [0.0; POINTS]];
    let states = node.solve(&[from], &mut input, &[1.0], 1e-13).unwrap();
    for (j, t) in points().into_iter().enumerate() {
        let error = (states[0][j] - exact(0.75 * t)).abs();
        assert!(error < 5e-15, "{exponent}: {error:e}");
        assert!((input[1][j] - contact.force_at(states[0][j])).abs() < 5e-15);
    }
}

/// `1 − e^{−t}`, `tanh t`, and for `m = 3/2` the compression whose root `p` goes with the time
/// `∫ 2p dp/(1 − p³)`.
#[test]
fn local_contacts_between_long_bars_follow_their_closed_forms() {
    assert_followed(1.0, 0.0, |t| 1.0 - (-t).exp());
    assert_followed(2.0, 0.0, f64::tanh);
    let time = |p: f64| {
        let logarithm = ((p * p + p + 1.0) / ((1.0 - p) * (1.0 - p))).ln() / 3.0;
        let angle = ((2.0 * p + 1.0) / 3.0_f64.sqrt()).atan() - (1.0 / 3.0_f64.sqrt()).atan();
        logarithm - 2.0 / 3.0_f64.sqrt() * angle
    };
    assert_followed(1.5, 0.25, |t| {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if time(middle) < time(0.5) + t { low = middle } else { high = middle }
        }
        low * low
    });
}
