//! Points a second of piecewise polynomials, at every level of the machine.
//!
//! All outputs are written again and again to one buffer: fresh pages cost several times as much as
//! the evaluation. "constant" is a table of one constant, which leaves nothing but writing: the bound.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::f64::consts::TAU;
use std::hint::black_box;
use wavestep_kernels::{Level, Piece, Table};

const POINTS: usize = 10_000_000;

/// `sin 2πt` on `[0, pieces/64]` by Taylor polynomials about the centres, with some low parts.
fn sine(pieces: usize, degree: usize, low: usize) -> Table {
    let piece = |i: usize| {
        let (width, scale) = (1.0 / 64.0, 128.0);
        let start = i as f64 * width;
        let centre = start + width / 2.0;
        let (sine, cosine) = (TAU * centre).sin_cos();
        let mut factor = 1.0;
        let mut coefficients = Vec::new();
        for k in 0..=degree {
            coefficients.push(factor * [sine, cosine, -sine, -cosine][k % 4]);
            factor *= TAU / scale / (k as f64 + 1.0);
        }
        let low = coefficients.iter().take(low).map(|c| c * 1e-17).collect();
        Piece { start, centre, scale, coefficients, low, error: 1e-30 }
    };
    let pieces: Vec<Piece> = (0..pieces).map(piece).collect();
    Table::new(&pieces, pieces.len() as f64 / 64.0).expect("a table")
}

/// Doubles of the window of a table, in no order.
fn scattered(table: &Table) -> Vec<f64> {
    let golden = 0.618_033_988_749_894_9;
    (0..POINTS).map(|i| (i as f64 * golden).fract() * table.end()).collect()
}

fn piecewise(criterion: &mut Criterion) {
    let plain = sine(3200, 13, 0);
    let certified = sine(3200, 23, 12);
    let constant = Piece {
        start: 0.0,
        centre: 25.0,
        scale: 1.0 / 32.0,
        coefficients: vec![1.0],
        low: vec![],
        error: 0.0,
    };
    let constant = Table::new(&[constant], 50.0).expect("a table");
    let step = plain.end() / (POINTS - 1) as f64 * (1.0 - 1e-9);
    let ascending: Vec<f64> = (0..POINTS).map(|i| i as f64 * step).collect();
    let scattered = scattered(&plain);
    let mut out = vec![1.0; POINTS];
    let mut group = criterion.benchmark_group("piecewise");
    group.sample_size(10).throughput(Throughput::Elements(POINTS as u64));
    for level in Level::available() {
        let name = |what: &str| format!("{what}/{level:?}");
        let at = |table| Table::evaluator(table).with_level(level);
        let (constant, plain, certified) = (at(&constant), at(&plain), at(&certified));
        group.bench_function(name("constant"), |b| {
            b.iter(|| constant.grid(0.0, step, black_box(&mut out)))
        });
        group.bench_function(name("grid"), |b| {
            b.iter(|| plain.grid(0.0, step, black_box(&mut out)))
        });
        group.bench_function(name("sorted"), |b| {
            b.iter(|| plain.sorted(&ascending, black_box(&mut out)))
        });
        group.bench_function(name("unsorted"), |b| {
            b.iter(|| plain.unsorted(&scattered, black_box(&mut out)))
        });
        group.bench_function(name("rounded grid"), |b| {
            b.iter(|| certified.rounded_grid(0.0, step, black_box(&mut out)))
        });
        group.bench_function(name("rounded sorted"), |b| {
            b.iter(|| certified.rounded_sorted(&ascending, black_box(&mut out)))
        });
        group.bench_function(name("rounded unsorted"), |b| {
            b.iter(|| certified.rounded_unsorted(&scattered, black_box(&mut out)))
        });
    }
    group.finish();
}

criterion_group!(benches, piecewise);
criterion_main!(benches);
