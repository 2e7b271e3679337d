//! Values of tables: within their bounds, and the same double whatever the way.

use crate::piecewise::support::*;
use wavestep_kernels::{Level, Piece, ascend};

#[test]
fn values_are_within_the_bound_at_every_level() {
    let mut random = Random(1);
    for shape in SHAPES {
        let (mut pieces, end) = pieces(shape, &mut random);
        let table = table(&mut pieces, end);
        let times = times(&pieces, end, 3000, &mut random);
        let exact: Vec<Dyadic> = times.iter().map(|&t| exact(piece_at(&pieces, t), t)).collect();
        let bound = Dyadic::new(table.bound());
        let mut out = vec![0.0; times.len()];
        for level in Level::available() {
            table.evaluator().with_level(level).unsorted(&times, &mut out);
            let mut largest = 0.0_f64;
            for ((&value, exact), t) in out.iter().zip(&exact).zip(&times) {
                let error = Dyadic::new(value).subtract(exact).abs();
                assert!(error.at_most(&bound), "{shape:?} {level:?} at {t:e}: {value:e}");
                largest = largest.max(error.approximate() / table.bound());
            }
            println!("{level:?}: {largest:.2} of the bound {:e}", table.bound());
        }
    }
}

#[test]
fn the_bound_is_not_slack() {
    let mut random = Random(2);
    for seed in 0..5 {
        let (mut pieces, end) = pieces(TYPICAL, &mut random);
        let table = table(&mut pieces, end);
        let sum = |piece: &Piece| -> f64 { piece.coefficients.iter().map(|c| c.abs()).sum() };
        let largest = pieces.iter().map(sum).fold(0.0, f64::max);
        assert!(table.bound() <= 2.0 * f64::EPSILON * largest, "{seed}: {:e}", table.bound());
        for level in Level::available() {
            let times = times(&pieces, end, 20_000, &mut random);
            let mut out = vec![0.0; times.len()];
            table.evaluator().with_level(level).unsorted(&times, &mut out);
            let error = |(&t, &value): (&f64, &f64)| {
                Dyadic::new(value).subtract(&exact(piece_at(&pieces, t), t)).abs().approximate()
            };
            let worst = times.iter().zip(&out).map(error).fold(0.0, f64::max);
            println!("{level:?}: {:.2} of the bound", worst / table.bound());
            assert!(worst * 4.0 >= table.bound());
        }
    }
}

/// Every way to the values of the same points.
#[test]
fn all_ways_give_the_same_doubles() {
    let mut random = Random(3);
    for shape in SHAPES {
        let (mut pieces, end) = pieces(shape, &mut random);
        let table = table(&mut pieces, end);
        let mut scattered = times(&pieces, end, 500, &mut random);
        let outside = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, end.next_up(), -f64::MAX];
        for (i, t) in outside.into_iter().enumerate() {
            scattered.insert(37 * (i + 1) % scattered.len(), t);
        }
        scattered.push(table.start().next_down());
        let mut ascending = scattered.clone();
        ascending.sort_by(f64::total_cmp);
        let mut fused = Vec::new();
        for level in Level::available() {
            let evaluator = table.evaluator().with_level(level);
            for times in [&scattered, &ascending] {
                let expected: Vec<f64> = times.iter().map(|&t| value(evaluator, t)).collect();
                for (t, value) in times.iter().zip(&expected) {
                    let inside = table.start() <= *t && *t <= end;
                    assert_eq!(value.is_nan(), !inside, "{t:e}");
                }
                let mut out = vec![0.0; times.len()];
                evaluator.sorted(times, &mut out);
                assert_eq!(bits(&out), bits(&expected), "{shape:?} {level:?}");
                out.fill(0.0);
                evaluator.unsorted(times, &mut out);
                assert_eq!(bits(&out), bits(&expected), "{shape:?} {level:?}");
                if level > Level::Baseline {
                    fused.push(bits(&expected));
                }
            }
        }
        assert!(fused.iter().skip(2).zip(&fused).all(|(a, b)| a == b), "AVX2 and AVX-512 differ");
    }
}

#[test]
fn sizes_and_alignments_do_not_matter() {
    let mut random = Random(5);
    let (mut pieces, end) = pieces(TYPICAL, &mut random);
    let table = table(&mut pieces, end);
    let times: Vec<f64> = (0..80).map(|i| f64::from(i) * end / 150.0).collect();
    for level in Level::available() {
        let evaluator = table.evaluator().with_level(level);
        let expected: Vec<f64> = times.iter().map(|&t| value(evaluator, t)).collect();
        for size in 0..=70 {
            for shift in 0..9 {
                let mut out = [7.0; 80];
                evaluator.sorted(&times[..size], &mut out[shift..shift + size]);
                assert_eq!(bits(&out[shift..shift + size]), bits(&expected[..size]));
                assert!(out[..shift].iter().chain(&out[shift + size..]).all(|&x| x == 7.0));
                evaluator.sorted(&times[shift..shift + size], &mut out[..size]);
                assert_eq!(bits(&out[..size]), bits(&expected[shift..shift + size]));
            }
        }
    }
}

/// Outputs long enough to be streamed, at all alignments.
#[test]
fn streamed_outputs_are_the_same() {
    let mut random = Random(6);
    let (mut pieces, end) = pieces(TYPICAL, &mut random);
    let table = table(&mut pieces, end);
    let count = 300_001;
    let times: Vec<f64> = (0..count).map(|i| i as f64 * end / count as f64).collect();
    let mut out = vec![0.0; count + 8];
    for level in Level::available() {
        let evaluator = table.evaluator().with_level(level);
        let expected: Vec<u64> = times.iter().map(|&t| value(evaluator, t).to_bits()).collect();
        for shift in 0..8 {
            out.fill(7.0);
            evaluator.sorted(&times, &mut out[shift..shift + count]);
            assert!(bits(&out[shift..shift + count]) == expected, "{level:?} {shift}");
            assert!(out[..shift].iter().chain(&out[shift + count..]).all(|&x| x == 7.0));
        }
    }
}

#[test]
#[should_panic(expected = "one place for every time")]
fn times_and_places_must_be_equally_many() {
    let (mut pieces, end) = pieces(TYPICAL, &mut Random(7));
    table(&mut pieces, end).evaluator().sorted(&[0.0, 0.1], &mut [0.0]);
}

/// Parts are streamed where all of them are; the values do not change.
#[test]
fn parts_have_the_values_of_the_whole() {
    let (mut pieces, end) = pieces(TYPICAL, &mut Random(8));
    let table = table(&mut pieces, end);
    let times: Vec<f64> = (0..5000).map(|i| f64::from(i) * end / 5000.0).collect();
    let mut whole = vec![0.0; 5000];
    table.evaluator().sorted(&times, &mut whole);
    let mut parts = vec![0.0; 5000];
    for (times, parts) in times.chunks(999).zip(parts.chunks_mut(999)) {
        table.evaluator().in_parts_of(1 << 20).sorted(times, parts);
    }
    assert_eq!(bits(&parts), bits(&whole));
}

#[test]
fn times_that_ascend_are_told_from_others() {
    for count in [0, 1, 2, 7, 64, 101] {
        let times: Vec<f64> = (0..count).map(|i| f64::from(i / 2)).collect();
        assert!(ascend(&times), "{count}");
        for place in 0..times.len() {
            let mut other = times.clone();
            other[place] = f64::NAN;
            assert!(!ascend(&other), "not a number at {place} of {count}");
            other[place] = -1.0;
            assert_eq!(ascend(&other), place == 0, "less at {place} of {count}");
        }
    }
}
