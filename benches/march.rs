//! How long the march takes: to 200 periods with 1000 values, and to many periods.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use wavestep_kernels::march::{Bounds, March, MarchOptions, Reflection};

fn rigid_mass() -> Reflection {
    Reflection::exact(2.0, 2.0, 1.0).expect("a reflection")
}

fn values(criterion: &mut Criterion) {
    let wave = rigid_mass();
    let points: Vec<f64> = (0..1000).map(|i| (f64::from(i) * 0.618).fract()).collect();
    let mut values = vec![0.0; points.len()];
    let mut group = criterion.benchmark_group("march: 1000 values to period 200");
    for (bounds, name) in [(Bounds::None, "values"), (Bounds::Proven, "values and bounds")] {
        let options = MarchOptions { bounds, ..Default::default() };
        group.bench_function(name, |b| {
            b.iter(|| {
                let mut march = March::new(&wave, options).expect("a march");
                let mut bound = 0.0_f64;
                for (points, values) in points.chunks(5).zip(values.chunks_mut(5)) {
                    march.values(black_box(points), values);
                    bound = bound.max(march.bound().unwrap_or(0.0));
                    march.advance().expect("room");
                }
                bound
            });
        });
    }
    group.finish();
}

fn periods(criterion: &mut Criterion) {
    let wave = rigid_mass();
    let mut group = criterion.benchmark_group("march: periods");
    group.sample_size(10);
    for (bounds, name) in [(Bounds::None, "plain"), (Bounds::Proven, "proven")] {
        for periods in [10_000, 100_000] {
            let options = MarchOptions { bounds, ..Default::default() };
            group.bench_function(format!("{name} {periods}"), |b| {
                b.iter(|| {
                    let mut march = March::new(&wave, options).expect("a march");
                    (0..periods).for_each(|_| march.advance().expect("room"));
                    march.value(0.5)
                })
            });
        }
    }
    group.finish();
}

criterion_group!(benches, values, periods);
criterion_main!(benches);
