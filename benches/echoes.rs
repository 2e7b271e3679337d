//! How many points a second the summations of echoes reach on the rigid mass of a fixed bar.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use wavestep_kernels::Limit;
use wavestep_kernels::double_double::DoubleDouble;
use wavestep_kernels::echoes::{EchoSum, Echoes, Expansion, Family, Method, Term};

/// `μ = 1`, echoes to `n`, and times that fill the period of echo `n`.
fn rigid_mass(n: usize, points: usize) -> (EchoSum, Vec<f64>) {
    let two = Expansion::try_from(2.0).expect("a number");
    let terms = [Term { lag: 0, coefficient: Expansion::ONE }];
    let wave = Echoes::new(Family::Laguerre, Expansion::ONE, two, Expansion::ONE, &terms, two);
    let sum = EchoSum::new(wave.expect("a wave"), n).expect("a sum");
    let step = 2.0 / points as f64;
    (sum, (0..points).map(|i| 2.0 * n as f64 + (i as f64 + 0.5) * step).collect())
}

fn side_by_side(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("echoes side by side");
    for n in [1, 10, 50, 200] {
        let (sum, times) = rigid_mass(n, 4096);
        let mut values = vec![0.0; times.len()];
        group.throughput(Throughput::Elements(times.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(n), |bencher| {
            bencher
                .iter(|| sum.fill(black_box(&times), Limit::Right, &mut values).expect("in range"));
        });
    }
    group.finish();
}

fn one_by_one(criterion: &mut Criterion) {
    for method in Method::ALL {
        let mut group = criterion.benchmark_group(format!("echoes one by one, {method:?}"));
        for n in [10, 200] {
            let (sum, times) = rigid_mass(n, 16);
            group.throughput(Throughput::Elements(times.len() as u64));
            group.bench_function(BenchmarkId::from_parameter(n), |bencher| {
                bencher.iter(|| {
                    let value = |&time| {
                        sum.value(method, DoubleDouble::from(time), Limit::Right).expect("in range")
                    };
                    black_box(&times).iter().map(value).sum::<f64>()
                });
            });
        }
        group.finish();
    }
}

criterion_group!(benches, side_by_side, one_by_one);
criterion_main!(benches);
