//! How long the march takes: to 200 periods with 1000 values, and to many periods.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use wavestep_kernels::march::{
    Bounds, LocalTime, March, MarchOptions, Reflection, sample, sample_with_bounds,
};

fn rigid_mass() -> Reflection {
    Reflection::exact(2.0, 2.0, 1.0).expect("a reflection")
}

fn values(criterion: &mut Criterion) {
    let times: Vec<LocalTime> = (0..1000)
        .map(|i| LocalTime::new(i / 5, (f64::from(i as u16) * 0.618).fract()).expect("a time"))
        .collect();
    let (wave, options) = (rigid_mass(), MarchOptions::default());
    let mut group = criterion.benchmark_group("march: 1000 values to period 200");
    group.bench_function("values", |b| b.iter(|| sample(&wave, options, black_box(&times))));
    group.bench_function("values and bounds", |b| {
        b.iter(|| sample_with_bounds(&wave, options, black_box(&times)))
    });
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
