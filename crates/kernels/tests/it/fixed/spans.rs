//! Polynomials across spans: their distance from the march is what is proven, and not much less.

use super::support::ratio;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed as _, ToPrimitive as _};
use wavestep_kernels::Limit;
use wavestep_kernels::fixed::{
    DelayEquation, FRACTION_BITS, Interpolant, March, MarchOptions, Reduction, Spans,
};

/// The spans of some periods of a rigid mass with a period of 6/5.
fn spans(march: &March, periods: std::ops::Range<u32>, degree: usize) -> Spans {
    let pieces = march.pieces_per_period();
    let all = periods.clone().flat_map(|period| (0..pieces).map(move |q| (period, q)));
    let polynomials = all.map(|(period, q)| march.piece(period, q).unwrap().to_vec()).collect();
    let start = ratio(6 * i64::from(periods.start), 5);
    let length = ratio(6, 5 * i64::from(pieces));
    let radius = march.bound_of(periods.end - 1).unwrap() * f64::from(FRACTION_BITS).exp2();
    Spans::new(&start, &length, polynomials, radius.ceil() as u128, degree).unwrap()
}

fn exact(value: f64) -> BigRational {
    BigRational::from_float(value).unwrap()
}

/// Beside the values of the march, polynomials across spans and within them are as far off as is
/// said, and not much less at the worst.
#[test]
fn distances_hold_and_are_not_slack() {
    let equation = DelayEquation::new(&ratio(6, 5), &ratio(1, 1), &ratio(1, 1), &ratio(1, 1));
    let march = March::new(&equation.unwrap(), 30, &MarchOptions::default()).unwrap();
    let reduction = Reduction::new(&ratio(6, 5), &ratio(0, 1)).unwrap();
    let unit = BigRational::from(BigInt::from(1) << FRACTION_BITS);
    let mut slack = Vec::new();
    for (period, degree) in [(0, 6), (3, 8), (29, 12)] {
        let spans = spans(&march, period..period + 1, degree);
        let start = f64::from(period) * 1.2 + 1e-9;
        for (from, width) in [(0.0, 0.01), (0.01, 0.17), (0.3, 0.6), (0.07, 0.003), (0.9, 0.29)] {
            let (first, last) = (start + from, start + from + width);
            let cell = spans.interpolated(first, last).unwrap();
            let distance = spans.distance(&cell).unwrap();
            let mut worst = 0.0_f64;
            for i in 0..=300 {
                let t = (first + (last - first) * f64::from(i) / 300.0).min(last);
                let u = (exact(t) - exact(cell.middle)) / exact(cell.scale);
                let horner = |sum: BigRational, c: &f64| sum * &u + exact(*c);
                let value = cell.coefficients.iter().rev().fold(ratio(0, 1), horner);
                let position = reduction.of_double(t, Limit::Right).unwrap().unwrap();
                let known = march.value(&position).unwrap();
                let known = BigRational::from(BigInt::from(known.midpoint)) / &unit;
                let error = (value - known).abs().to_f64().unwrap();
                assert!(error <= distance, "{period} {from} {width}: {error:e} {distance:e}");
                worst = worst.max(error);
            }
            slack.push(distance / worst);
        }
    }
    println!("{slack:.1?}");
    assert_eq!(slack.len(), 15);
    assert!(slack.iter().filter(|&&slack| slack < 4.0).count() >= 12, "{slack:?}");
}

/// Whatever coefficient is wrong, by however little, the distance tells.
#[test]
fn wrong_coefficients_are_far() {
    let one = ratio(1, 1);
    let equation = DelayEquation::new(&ratio(6, 5), &one, &one, &one).unwrap();
    let march = March::new(&equation, 4, &MarchOptions::default()).unwrap();
    let spans = spans(&march, 2..3, 10);
    for (first, last) in [(2.45, 2.6), (2.7, 2.71)] {
        let cell = spans.interpolated(first, last).unwrap();
        for k in 0..11 {
            for wrong in [1e-3, -1e-9] {
                let mut cell = cell.clone();
                cell.coefficients[k] += wrong;
                let reach = ((last - first) / 2.0 / cell.scale).powi(k as i32);
                let distance = spans.distance(&cell).unwrap();
                assert!(distance >= 0.99 * reach * wrong.abs(), "{k} {wrong}: {distance:e}");
            }
        }
        for worthless in [f64::NAN, f64::INFINITY, 1e10] {
            let mut cell = cell.clone();
            cell.coefficients[3] = worthless;
            assert_eq!(spans.distance(&cell), None);
        }
        let moved = Interpolant { middle: cell.middle.next_up(), ..cell };
        assert_eq!(spans.distance(&moved), None);
    }
}

#[test]
fn numbers_out_of_range_are_refused() {
    let (zero, one) = (ratio(0, 1), ratio(1, 1));
    let new = |start: &BigRational, length: &BigRational, rows: Vec<Vec<i128>>, degree| {
        Spans::new(start, length, rows, 0, degree).is_some()
    };
    assert!(new(&zero, &one, vec![vec![1]], 12));
    assert!(!new(&zero, &one, vec![], 12));
    assert!(!new(&zero, &zero, vec![vec![1]], 12));
    assert!(!new(&zero, &one, vec![vec![1]], 32));
    assert!(!new(&zero, &one, vec![vec![1 << 120]], 12));
    assert!(!new(&one, &ratio(1, 1 << 40), vec![vec![1]], 12));
    let spans = Spans::new(&zero, &one, vec![vec![1 << 112]; 2], 0, 3).unwrap();
    assert!(spans.interpolated(0.25, 0.25_f64.next_up()).is_none());
    assert!(spans.interpolated(0.75, 0.25).is_none() && spans.interpolated(0.0, 1e9).is_none());
}
