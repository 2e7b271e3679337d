//! Values of tables: within their bounds, and the same double whatever the way.

use crate::piecewise::support::*;
use wavestep_kernels::{Level, Piece};

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
            table.evaluator().with_level(level).values(&times, &mut out);
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
            table.evaluator().with_level(level).values(&times, &mut out);
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
        let mixed = [&ascending[..], &scattered, &ascending].concat();
        let mut fused = Vec::new();
        for level in Level::available() {
            let evaluator = table.evaluator().with_level(level);
            for times in [&scattered, &ascending, &mixed] {
                let expected: Vec<f64> = times.iter().map(|&t| value(evaluator, t)).collect();
                for (t, value) in times.iter().zip(&expected) {
                    let inside = table.start() <= *t && *t <= end;
                    assert_eq!(value.is_nan(), !inside, "{t:e}");
                }
                let mut out = vec![0.0; times.len()];
                assert!(!evaluator.values(times, &mut out));
                assert_eq!(bits(&out), bits(&expected), "{shape:?} {level:?}");
                if level > Level::Baseline {
                    fused.push(bits(&expected));
                }
            }
        }
        assert!(fused.iter().skip(3).zip(&fused).all(|(a, b)| a == b), "AVX2 and AVX-512 differ");
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
                evaluator.values(&times[..size], &mut out[shift..shift + size]);
                assert_eq!(bits(&out[shift..shift + size]), bits(&expected[..size]));
                assert!(out[..shift].iter().chain(&out[shift + size..]).all(|&x| x == 7.0));
                evaluator.values(&times[shift..shift + size], &mut out[..size]);
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
            evaluator.values(&times, &mut out[shift..shift + count]);
            assert!(bits(&out[shift..shift + count]) == expected, "{level:?} {shift}");
            assert!(out[..shift].iter().chain(&out[shift + count..]).all(|&x| x == 7.0));
        }
    }
}

#[test]
#[should_panic(expected = "one place for every time")]
fn times_and_places_must_be_equally_many() {
    let (mut pieces, end) = pieces(TYPICAL, &mut Random(7));
    table(&mut pieces, end).evaluator().values(&[0.0, 0.1], &mut [0.0]);
}

/// Wherever it stands among times in order and in none, and however many there are.
#[test]
fn one_time_outside_is_noticed() {
    let (mut pieces, end) = pieces(TYPICAL, &mut Random(8));
    let table = table(&mut pieces, end);
    let start = table.start();
    for count in [0, 1, 7, 64, 150] {
        let ascending: Vec<f64> =
            (0..count).map(|i| start + (end - start) * f64::from(i) / 149.0).collect();
        let scattered = (0..ascending.len()).map(|i| ascending[i * 61 % ascending.len()]).collect();
        for times in [ascending.clone(), scattered] {
            for level in Level::available() {
                let evaluator = table.evaluator().with_level(level);
                let mut out = vec![0.0; times.len()];
                assert!(evaluator.values(&times, &mut out), "{count} {level:?}");
                for place in 0..times.len() {
                    for outside in [f64::NAN, start.next_down(), end.next_up()] {
                        let mut times = times.clone();
                        times[place] = outside;
                        let is_inside = evaluator.values(&times, &mut out);
                        assert!(!is_inside, "{outside:e} at {place} of {count}, {level:?}");
                    }
                }
            }
        }
    }
}
