//! The march in fixed point for the rigid mass, μ = 1, to 200 periods: its parts, and a thousand
//! correctly rounded doubles from nothing.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;
use wavestep_kernels::Limit;
use wavestep_kernels::fixed::{
    DelayEquation, FRACTION_BITS, March, MarchOptions, Position, Reduction, Tap, certified,
    round_to_double,
};

const PERIODS: u32 = 200;
const POINTS: usize = 1000;

fn integer(value: i64) -> BigRational {
    BigRational::from(BigInt::from(value))
}

fn rigid_mass() -> DelayEquation {
    let [one, two] = [1, 2].map(integer);
    DelayEquation::new(&two, &one, &one, &one).expect("the parameters are positive")
}

/// Times over all periods, at places that repeat late.
fn times() -> Vec<f64> {
    let span = f64::from(2 * PERIODS);
    (0..POINTS).map(|i| span * (i as f64 + (i as f64 * 0.618).fract()) / POINTS as f64).collect()
}

fn march(criterion: &mut Criterion) {
    let equation = rigid_mass();
    let mut group = criterion.benchmark_group("march to 200 periods");
    for pieces in [16, 32] {
        let options = MarchOptions { pieces: Some(pieces), terms: None };
        group.bench_function(format!("{pieces} pieces"), |bencher| {
            bencher.iter(|| March::new(black_box(&equation), PERIODS, &options));
        });
    }
    group.finish();
}

fn values(criterion: &mut Criterion) {
    let march = March::new(&rigid_mass(), PERIODS, &MarchOptions::default()).expect("it is proven");
    let reduction = Reduction::new(&integer(2), &BigRational::zero()).expect("2 is positive");
    let times = times();
    let mut group = criterion.benchmark_group("a thousand points");
    let reduce = |time: &f64| reduction.of_double(*time, Limit::Right).ok().flatten();
    group.bench_function("reduction", |bencher| {
        bencher.iter(|| black_box(&times).iter().filter_map(reduce).count());
    });
    let positions: Vec<Position> = times.iter().filter_map(reduce).collect();
    group.bench_function("value and rounding", |bencher| {
        bencher.iter(|| {
            let rounded = |position| {
                let found = march.value(position).ok()?;
                round_to_double(found.midpoint, found.radius, FRACTION_BITS.into())
            };
            black_box(&positions).iter().filter_map(rounded).sum::<f64>()
        });
    });
    group.finish();
}

fn from_nothing(criterion: &mut Criterion) {
    let equation = rigid_mass();
    let times = times();
    let tap = |weight: i64, delay: i64| Tap { weight: integer(weight), delay: integer(delay) };
    let mut group = criterion.benchmark_group("a thousand certified doubles from nothing");
    for (name, taps) in [
        ("solution", vec![tap(1, 0)]),
        ("velocity", vec![tap(1, 0), tap(-1, 2)]),
        ("strain_fixed", vec![tap(-2, 1)]),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| certified(&equation, black_box(&taps), &times, Limit::Right));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = march, values, from_nothing
}
criterion_main!(benches);
