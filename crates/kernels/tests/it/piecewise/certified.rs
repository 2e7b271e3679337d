//! Certified values: the doubles nearest to the exact ones, wherever they are not undecided.

use crate::piecewise::support::*;
use wavestep_kernels::{Level, Piece, Table};

/// Asserts that all decided results are rounded correctly; returns how many are not decided.
fn check(table: &Table, pieces: &[Piece], times: &[f64], level: Level) -> usize {
    let mut out = vec![0.0; times.len()];
    let evaluator = table.evaluator().with_level(level);
    let undecided = evaluator.rounded(times, &mut out);
    assert!(undecided.is_sorted_by(|a, b| a < b));
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by(|&i, &j| times[i].total_cmp(&times[j]));
    let ascending: Vec<f64> = order.iter().map(|&i| times[i]).collect();
    let mut again = vec![0.0; times.len()];
    let mut also_undecided = evaluator.rounded(&ascending, &mut again);
    also_undecided.iter_mut().for_each(|i| *i = order[*i]);
    also_undecided.sort_unstable();
    assert_eq!(also_undecided, undecided);
    assert_eq!(bits(&again), order.iter().map(|&i| out[i].to_bits()).collect::<Vec<_>>());
    for (i, (&t, &value)) in times.iter().zip(&out).enumerate() {
        let decided = undecided.binary_search(&i).is_err();
        if decided {
            let exact = exact(piece_at(pieces, t), t);
            assert!(exact.rounds_to(value), "{level:?} at {t:e}: {value:e}");
        }
        if i % 16 == 0 {
            assert_eq!(rounded(evaluator, t), decided.then_some(value), "{level:?} at {t:e}");
        }
    }
    undecided.len()
}

#[test]
fn decided_values_are_rounded_correctly() {
    let mut random = Random(11);
    let (mut count, mut undecided) = (0, 0);
    let shapes = [
        Shape { low: 6, ..TYPICAL },
        Shape { low: 5, degree: 9, start: -0.9, ..TYPICAL },
        Shape { low: 10, degree: 17, start: 50.0, spread: 100.0, ..TYPICAL },
        Shape { low: 1, degree: 4, decay: 0.01, start: -2e5, width: 20.0, ..TYPICAL },
    ];
    for shape in shapes {
        let (mut pieces, end) = pieces(shape, &mut random);
        let table = table(&mut pieces, end);
        let times = times(&pieces, end, 9_000, &mut random);
        for level in Level::available() {
            undecided += check(&table, &pieces, &times, level);
            count += times.len();
        }
    }
    println!("{undecided} of {count} undecided");
    assert!(count >= 36_000 * Level::available().count() && undecided == 0);
}

#[test]
fn decided_values_of_all_shapes_are_rounded_correctly() {
    let mut random = Random(12);
    for shape in SHAPES {
        let (mut pieces, end) = pieces(shape, &mut random);
        let table = table(&mut pieces, end);
        let times = times(&pieces, end, 1000, &mut random);
        for level in Level::available() {
            let undecided = check(&table, &pieces, &times, level);
            println!("{level:?}: {undecided} of {} undecided", times.len());
            // Where underflow takes digits away, nothing can be decided.
            assert!(undecided == 0 || shape.size < 1e-290);
        }
    }
}

/// Far below the last bit of a double, so that hardly any value is in doubt.
#[test]
fn the_bound_of_pairs_is_small() {
    let mut random = Random(13);
    let (mut pieces, end) = pieces(Shape { low: 6, ..TYPICAL }, &mut random);
    let table = table(&mut pieces, end);
    assert!(table.certified_bound() < 2.0_f64.powi(-94), "{:e}", table.certified_bound());
}

/// Low parts of all coefficients: most of them are far below the bound, and cost neither digits nor
/// pairs.
#[test]
fn low_parts_of_all_coefficients_change_nothing() {
    let mut random = Random(14);
    let shape = Shape { degree: 23, low: 24, decay: 0.05, start: 7.0, ..TYPICAL };
    let (mut pieces, end) = pieces(shape, &mut random);
    let table = table(&mut pieces, end);
    assert!(table.certified_bound() < 2.0_f64.powi(-94), "{:e}", table.certified_bound());
    let times = times(&pieces, end, 3000, &mut random);
    for level in Level::available() {
        assert_eq!(check(&table, &pieces, &times, level), 0);
    }
}

/// A low part that decides between two doubles although its coefficient is 0, and is the last one.
#[test]
fn low_parts_count_wherever_they_matter() {
    let half = 2.0_f64.powi(-53);
    for low in [vec![0.0, half * 1.01], vec![0.0, 0.0, 0.0, half * 1.01], vec![half * 1.01]] {
        let mut coefficients = vec![0.0; low.len()];
        coefficients[0] = 1.0;
        let piece = Piece { start: -1.0, centre: 0.0, scale: 1.0, coefficients, low, error: 0.0 };
        let pieces = [piece];
        let table = Table::new(&pieces, 1.0).expect("a table");
        for level in Level::available() {
            let evaluator = table.evaluator().with_level(level);
            assert_eq!(rounded(evaluator, 1.0), Some(1.0_f64.next_up()));
            assert_eq!(check(&table, &pieces, &[1.0, -1.0, 0.25, 0.9999], level), 0);
        }
    }
}

/// Constants next to the midpoint of two doubles: decided exactly where the bound allows it.
#[test]
fn near_midpoints_the_error_decides() {
    let half = 2.0_f64.powi(-53);
    for level in Level::available() {
        for (low, error, decided) in [
            (half - 1e-28, 0.0, true),
            (half, 0.0, false),
            (half - 1e-28, 2e-28, false),
            (half + 1e-28, 2e-28, false),
            (half + 1e-28, 0.5e-28, true),
            (0.0, half / 4.0, true),
            (0.0, half * 2.0, false),
            (0.0, f64::MAX, false),
        ] {
            let piece = Piece {
                start: 0.0,
                centre: 0.5,
                scale: 1.0,
                coefficients: vec![1.0],
                low: vec![low],
                error,
            };
            let table = Table::new(std::slice::from_ref(&piece), 1.0).unwrap();
            let mut out = [0.0; 100];
            let evaluator = table.evaluator().with_level(level);
            let times = std::array::from_fn::<f64, 100, _>(|i| i as f64 * 0.01);
            let undecided = evaluator.rounded(&times, &mut out);
            assert_eq!(
                undecided.len(),
                if decided { 0 } else { 100 },
                "{level:?} {low:e} {error:e}"
            );
            if decided {
                assert!(exact(&piece, 0.0).rounds_to(out[0]));
            }
        }
    }
}

#[test]
fn sorted_times_agree_and_outside_is_decided() {
    let mut random = Random(14);
    // In every third piece the error is so large that every value is in doubt.
    let (mut pieces, end) = pieces(Shape { low: 6, ..TYPICAL }, &mut random);
    for piece in pieces.iter_mut().step_by(3) {
        piece.error = 1.0;
    }
    let table = table(&mut pieces, end);
    let (from, step, count) = (-0.25, (end + 0.5) / 1234.0, 1234);
    let times: Vec<f64> = (0..count).map(|i| (i as f64).mul_add(step, from)).collect();
    for level in Level::available() {
        let evaluator = table.evaluator().with_level(level);
        let mut out = vec![0.0; count];
        let undecided = evaluator.rounded(&times, &mut out);
        let in_doubt = |&i: &usize| {
            let inside = (0.0..=end).contains(&times[i]);
            inside && piece_at(&pieces, times[i]).error > 0.0
        };
        assert_eq!(undecided, (0..count).filter(in_doubt).collect::<Vec<_>>());
        let mut alone = [0.0];
        for (time, value) in times.iter().zip(&out) {
            evaluator.rounded(&[*time], &mut alone);
            assert_eq!(alone[0].to_bits(), value.to_bits(), "{level:?} at {time:e}");
        }
    }
}

/// Where everything is 0, without error, 0 is the nearest double.
#[test]
fn an_exact_zero_is_decided() {
    let zero = |start: f64, error: f64| Piece {
        start,
        centre: start + 0.5,
        scale: 1.0,
        coefficients: vec![0.0; 3],
        low: vec![0.0],
        error,
    };
    let table = Table::new(&[zero(0.0, 0.0), zero(1.0, 1e-300)], 2.0).unwrap();
    for level in Level::available() {
        let evaluator = table.evaluator().with_level(level);
        assert_eq!((rounded(evaluator, 0.3), rounded(evaluator, 1.3)), (Some(0.0), None));
    }
}
