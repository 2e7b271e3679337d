//! Values in doubles: the figures of docs/performance.md.
//!
//! The rigid mass on a fixed bar, all periods to n = 200, one core. Elements are values. Where memory is
//! the limit, `stores` is what it can do: the same times read, and a constant written.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::cell::LazyCell;
use std::hint::black_box;
use wavestep::signal::{Certified, Compiled, Evaluator, Marched, Signal, Summation, Summed};
use wavestep_benches::{is_test, rigid_mass, with_signal};
use wavestep_kernels::march::{Bounds, March, MarchOptions, Reflection};
use wavestep_kernels::{Level, Piece, Table};
use wavestep_studies::study::Sampling;

const ORDER: u32 = 200;
const POINTS: usize = 10_000_000;
const UNSORTED: usize = 1_000_000;
const MASSES: [&str; 2] = ["1", "1/4"];

/// The last piece of the tables, which take long to prepare: a low one where each benchmark only runs once.
fn order() -> u32 {
    if is_test() { 20 } else { ORDER }
}

/// Calls `work` with the wave f, up to this order.
fn with_wave(mass: &str, order: u32, work: impl FnOnce(&dyn Signal)) {
    with_signal(rigid_mass(), Some(mass), &format!("{}*2*{mass}", order + 1), work);
}

/// Times in an order that no cache knows.
fn shuffled(end: f64) -> Vec<f64> {
    let times = Sampling { points: UNSORTED, seed: 1 }.times(0.0, end * 0.999_999);
    (0..UNSORTED).map(|i| times[(i * 611_953) % UNSORTED]).collect()
}

/// A table of one constant: what memory costs.
fn constant(end: f64) -> Table {
    let (coefficients, low) = (vec![1.0], Vec::new());
    let scale = 0.5_f64.powi(24);
    let piece = Piece { start: 0.0, centre: 0.0, scale, coefficients, low, error: 0.0 };
    Table::new(&[piece], end).unwrap()
}

/// What a group asks for, made when its first measurement runs: a filter need not wait for the others.
struct Prepared<'a> {
    compiled: Compiled<'a>,
    certified: Certified<'a>,
    ascending: Vec<f64>,
    times: Vec<f64>,
}

impl Prepared<'_> {
    fn new(signal: &dyn Signal) -> Prepared<'_> {
        let compiled = Compiled::new(signal, None).unwrap();
        let certified = Certified::new(signal).unwrap();
        let end = compiled.table().end();
        let ascending = (0..POINTS).map(|i| i as f64 * end / POINTS as f64).collect();
        Prepared { compiled, certified, ascending, times: shuffled(end) }
    }
}

fn polynomials(criterion: &mut Criterion) {
    for mass in MASSES {
        let order = order();
        with_wave(mass, order, |signal| {
            let prepared = LazyCell::new(|| Prepared::new(signal));
            let mut values = vec![0.0; POINTS];
            let mut group = criterion.benchmark_group(format!("rigid-mass mu={mass} n≤{order}"));
            group.sample_size(10);
            for level in Level::available() {
                let name = |what: &str| BenchmarkId::new(what, format!("{level:?}"));
                group.throughput(Throughput::Elements(POINTS as u64));
                group.bench_function(name("stores"), |b| {
                    let stores = constant(prepared.ascending[POINTS - 1]);
                    let stores = stores.evaluator().with_level(level);
                    b.iter(|| stores.values(&prepared.ascending, black_box(&mut values)));
                });
                group.bench_function(name("compiled ascending"), |b| {
                    let plain = prepared.compiled.table().evaluator().with_level(level);
                    b.iter(|| plain.values(&prepared.ascending, black_box(&mut values)));
                });
                group.bench_function(name("certified ascending"), |b| {
                    let pairs = prepared.certified.table().unwrap().evaluator().with_level(level);
                    b.iter(|| pairs.rounded(&prepared.ascending, black_box(&mut values)));
                });
                group.throughput(Throughput::Elements(UNSORTED as u64));
                let some = &mut values[..UNSORTED];
                group.bench_function(name("compiled unsorted"), |b| {
                    let plain = prepared.compiled.table().evaluator().with_level(level);
                    b.iter(|| plain.values(&prepared.times, black_box(&mut *some)));
                });
                group.bench_function(name("certified unsorted"), |b| {
                    let pairs = prepared.certified.table().unwrap();
                    let pairs = pairs.evaluator().with_level(level);
                    b.iter(|| pairs.rounded(&prepared.times, black_box(&mut *some)));
                });
            }
            group.finish();
        });
    }
}

/// A thousand values from scratch: nothing is prepared.
fn from_scratch(criterion: &mut Criterion) {
    with_wave("1", ORDER, |signal| {
        let times = Sampling { points: 1000, seed: 1 }.times(0.0, 402.0);
        let mut values = vec![0.0; 1000];
        let mut group = criterion.benchmark_group("1000 values to n = 200, from scratch");
        group.bench_function("certified", |b| {
            b.iter(|| {
                let method = Certified::new(signal).unwrap();
                method.values(&times, black_box(&mut values)).unwrap();
            });
        });
        let marches: [(&str, &dyn Fn() -> Marched); 2] = [
            ("marched", &|| Marched::proven(signal).unwrap()),
            ("marched, no bound", &|| Marched::new(signal).unwrap()),
        ];
        for (name, march) in marches {
            group.bench_function(name, |b| {
                b.iter(|| {
                    let method = march();
                    method.values(&times, black_box(&mut values)).unwrap();
                });
            });
        }
        group.sample_size(10);
        group.bench_function("compiled", |b| {
            b.iter(|| {
                let method = Compiled::new(signal, None).unwrap();
                method.values(&times, black_box(&mut values)).unwrap();
            });
        });
        group.finish();
    });
}

/// Sums of echoes, on one period.
fn sums(criterion: &mut Criterion) {
    with_wave("1", ORDER, |signal| {
        let mut group = criterion.benchmark_group("sums of echoes");
        for order in [10_u32, 50, 200] {
            let start = f64::from(2 * order);
            let times = Sampling { points: 4096, seed: 1 }.times(start, start + 2.0);
            let mut values = vec![0.0; times.len()];
            group.throughput(Throughput::Elements(times.len() as u64));
            let stable = Summed::new(signal, Summation::Scaled).unwrap();
            group.bench_function(BenchmarkId::new("stable", order), |b| {
                b.iter(|| stable.values(&times, black_box(&mut values)).unwrap());
            });
        }
        group.finish();
    });
}

/// Marches of the impulse response alone, through many periods.
fn periods(criterion: &mut Criterion) {
    let mass = Reflection::exact(2.0, 2.0, 1.0).unwrap();
    let mut group = criterion.benchmark_group("march through periods");
    group.sample_size(10);
    for (bounds, name) in [(Bounds::None, "plain"), (Bounds::Proven, "proven")] {
        for periods in [10_000, 100_000] {
            let options = MarchOptions { bounds, ..Default::default() };
            group.bench_function(BenchmarkId::new(name, periods), |b| {
                b.iter(|| {
                    let mut march = March::new(&mass, options).unwrap();
                    (0..periods).for_each(|_| march.advance().unwrap());
                    march.value(0.5)
                })
            });
        }
    }
    group.finish();
}

criterion_group!(benches, polynomials, from_scratch, sums, periods);
criterion_main!(benches);
