//! Values and sizes of Chebyshev series.

use wavestep_kernels::march::chebyshev::{Samples, Sizes, sizes, value, values, values_of};

#[test]
fn single_polynomials_are_cosines() {
    for k in 0..60 {
        let mut c = vec![0.0; k + 1];
        c[k] = 1.0;
        for i in 0..=100 {
            let x = f64::from(i) / 100.0;
            let exact = (k as f64 * (2.0 * x - 1.0).acos()).cos();
            // acos is off by an ulp, which the cosine multiplies by k sin(kθ)/ sin θ at most.
            let error = (value(&c, x) - exact).abs();
            assert!(error < 1e-15 + 1e-15 * (k * k) as f64, "{k} {x}: {error:e}");
        }
        assert_eq!(value(&c, 1.0), 1.0);
        assert_eq!(value(&c, 0.0), if k % 2 == 0 { 1.0 } else { -1.0 });
    }
}

/// Series of all pairs of lengths, side by side and alone.
#[test]
fn series_side_by_side_do_not_mix() {
    let series = |length: usize, factor: f64| -> Vec<f64> {
        (0..length).map(|k| (k as f64 * factor).sin()).collect()
    };
    let (here, there) = ([0.1, 0.8, 0.4], [0.3, 0.9]);
    for (one, other) in (0..12).flat_map(|one| (0..12).map(move |other| (one, other))) {
        let (one, other) = (series(one, 1.3), series(other, 0.7));
        let (mut alone, mut paired) = (([0.0; 3], [0.0; 2]), ([1.0; 3], [1.0; 2]));
        values(&one, &here, &mut alone.0);
        values(&other, &there, &mut alone.1);
        values_of([
            Samples { coefficients: &one, points: &here, values: &mut paired.0 },
            Samples { coefficients: &other, points: &there, values: &mut paired.1 },
        ]);
        assert_eq!(paired, alone);
    }
}

#[test]
fn groups_give_the_same_bits() {
    let c: Vec<f64> = (0..33).map(|k| (k as f64).sin() / (1.0 + k as f64)).collect();
    for length in 0..50 {
        let points: Vec<f64> = (0..length).map(|i| (i as f64 * 0.37).fract()).collect();
        let mut found = vec![0.0; length];
        values(&c, &points, &mut found);
        assert!(points.iter().zip(&found).all(|(x, v)| value(&c, *x) == *v));
    }
    assert_eq!(value(&[], 0.5), 0.0);
}

/// The slope of `T_2(2x − 1)` is 8 at `x = 1`.
#[test]
fn sizes_are_sums_with_weights() {
    assert_eq!(sizes(&[0.0, 0.0, -1.0]), Sizes { absolute: 1.0, weighted: 3.0, slope: 8.0 });
    let found = sizes(&[1.0, -2.0, 3.0, -4.0, 5.0]);
    assert_eq!(found, Sizes { absolute: 15.0, weighted: 55.0, slope: 260.0 });
}
