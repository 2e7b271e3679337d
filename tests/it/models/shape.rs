//! Shapes of vibration: frequencies, and orthogonality by mass.

use std::f64::consts::PI;
use wavestep::model::shape::{Part, Shape, frequencies};

fn all(parts: &[Part], held: [bool; 2], count: usize) -> Vec<f64> {
    frequencies(parts, held, false, count).into_iter().flatten().collect()
}

/// A bar cut in three has the modes of the whole, also those that stand still at the cuts.
#[test]
fn cuts_change_no_frequency() {
    let bar = |travel| Part::Bar { impedance: 2.0, travel };
    for held in [[true, true], [true, false], [false, true]] {
        let whole = all(&[bar(3.0)], held, 60);
        let cut = all(&[bar(1.0), Part::Mass { mass: 0.0 }, bar(1.0), bar(1.0)], held, 60);
        for (n, (a, b)) in whole.iter().zip(&cut).enumerate() {
            let quarters = if held == [true, true] { n as f64 + 1.0 } else { n as f64 + 0.5 };
            let known = quarters * PI / 3.0;
            assert!((a - known).abs() < 1e-14 * known && (b - known).abs() < 1e-13 * known);
        }
    }
}

/// Equal systems behind a weak spring have pairs of frequencies that nearly agree: both are found,
/// and between neighbours the sign of the end value changes once.
#[test]
fn near_frequencies_are_told_apart() {
    let bar = || Part::Bar { impedance: 1.0, travel: 1.0 };
    let parts = [bar(), Part::Spring { stiffness: 1e-6 }, bar()];
    let found = all(&parts, [true, true], 40);
    assert!(found.windows(2).all(|pair| pair[0] < pair[1]));
    for pair in found.chunks(2) {
        assert!(pair[1] - pair[0] < 1e-5, "{pair:?}");
    }
    let end = |frequency: f64| {
        Shape::of(&parts, true, Some(frequency), 53).unwrap().left_of(parts.len())[0]
    };
    for pair in found.windows(3) {
        let before = end(pair[0].midpoint(pair[1]));
        let behind = end(pair[1].midpoint(pair[2]));
        assert!(before * behind < 0.0, "{pair:?}");
    }
}

/// Shapes of different modes are orthogonal by mass: the sum for `u_i + u_j` is that of both.
#[test]
fn shapes_are_orthogonal() {
    let parts = [
        Part::Mass { mass: 0.7 },
        Part::Bar { impedance: 1.0, travel: 1.0 },
        Part::Spring { stiffness: 3.0 },
        Part::Mass { mass: 0.2 },
        Part::Support { stiffness: 0.5 },
        Part::Bar { impedance: 2.5, travel: 0.6 },
    ];
    let found = all(&parts, [false, false], 12);
    let shapes: Vec<Shape> =
        found.iter().map(|w| Shape::of(&parts, false, Some(*w), 53).unwrap()).collect();
    // Simpson's rule on the bars.
    let product = |a: &Shape, b: &Shape| {
        let mut sum = 0.0;
        for (i, part) in parts.iter().enumerate() {
            match part {
                Part::Mass { mass } => sum += mass * a.left_of(i)[0] * b.left_of(i)[0],
                Part::Bar { impedance, travel } => {
                    let steps = 2000;
                    for k in 0..=steps {
                        let weight = match k {
                            0 => 1.0,
                            k if k == steps => 1.0,
                            k => 2.0 + 2.0 * f64::from(k % 2),
                        };
                        let at = travel * f64::from(k) / f64::from(steps);
                        let [a, b] = [a, b].map(|own| own.section(i, &at, 53).unwrap()[0]);
                        let value = a * b;
                        sum += impedance * weight * value * travel / f64::from(steps) / 3.0;
                    }
                }
                _ => {}
            }
        }
        sum
    };
    for (i, a) in shapes.iter().enumerate() {
        assert!((product(a, a) - a.mass()).abs() < 1e-8 * a.mass());
        for b in &shapes[..i] {
            let scale = (a.mass() * b.mass()).sqrt();
            assert!(product(a, b).abs() < 1e-8 * scale, "{i}");
        }
    }
}
