//! How long derivation takes: the figures of docs/performance.md.

use criterion::{Criterion, criterion_group, criterion_main};
use std::collections::BTreeMap;
use std::hint::black_box;
use wavestep::export::{Formula, LATEX_WIDTH, latex};
use wavestep::language::{Source, read_recurrence};
use wavestep::recurrence::Recurrence;
use wavestep::solution::{EchoByEcho, EchoTable, PeriodByPeriod, Solution};

fn scene(text: &str) -> Recurrence {
    let source = Source::new("bench", text).expect("a text");
    read_recurrence(&source, &BTreeMap::new()).expect("a recurrence")
}

fn rigid_mass() -> Recurrence {
    scene(wavestep_benches::rigid_mass())
}

fn another() -> Recurrence {
    scene(
        "recurrence \"another\"\nsymbol D > 0\nperiod D, local s, time t\nwave f\n\
         equation f[n]' + 2*f[n] = f[n-1]' - 3*f[n-1]\ncontinuous f[n] - f[n-1] starts at 1\n",
    )
}

fn table(solution: &Solution, through: usize) -> EchoTable {
    solution.table(0, through).expect("solvable").expect("numbers")
}

/// Streams all terms of f_0 … f_through; the sum of bits keeps the work from being left out.
fn expand(solution: &Solution, through: usize) -> u64 {
    let table = table(solution, through);
    let mut bits = 0;
    for n in 0..=through {
        table.for_each_term(n, |term| bits += term.numerator.bits());
    }
    bits
}

/// f_80 derived and written as LaTeX.
fn formula(recurrence: &Recurrence) -> usize {
    let solution = Solution::new(recurrence.clone());
    let piece = &solution.pieces(0, 80, 80).expect("solvable")[0];
    latex(&[Formula::piece("f", 80, piece, &recurrence.statement().local)], LATEX_WIDTH).len()
}

fn expanded(c: &mut Criterion) {
    let mut group = c.benchmark_group("expanded");
    group.sample_size(10);
    for (name, recurrence) in [("rigid mass", rigid_mass()), ("another", another())] {
        let solution = Solution::new(recurrence);
        for through in [80, 160] {
            group.bench_function(format!("{name} to {through}"), |b| {
                b.iter(|| black_box(expand(&solution, through)));
            });
        }
    }
    let recurrence = rigid_mass();
    group.bench_function("rigid mass, f_80 as LaTeX", |b| {
        b.iter(|| black_box(formula(&recurrence)));
    });
    group.finish();
}

fn echoes(c: &mut Criterion) {
    let mut group = c.benchmark_group("echoes");
    group.sample_size(10);
    let solution = Solution::new(rigid_mass());
    group.bench_function("rows to 1000", |b| b.iter(|| black_box(table(&solution, 1000))));
    let recurrence = rigid_mass();
    group.bench_function("general ring to 80", |b| {
        b.iter(|| {
            let mut solver = EchoByEcho::new(&recurrence);
            (0..=80).for_each(|_| solver.advance().expect("solvable"));
            black_box(solver.transforms(0).len())
        });
    });
    group.finish();
}

fn periods(c: &mut Criterion) {
    let mut group = c.benchmark_group("periods");
    group.sample_size(10);
    let recurrence = rigid_mass();
    for through in [40, 80] {
        group.bench_function(format!("general ring to {through}"), |b| {
            b.iter(|| {
                let mut solver = PeriodByPeriod::new(&recurrence);
                (0..=through).for_each(|_| solver.advance().expect("solvable"));
                black_box(solver.pieces().len())
            });
        });
    }
    let solution = Solution::new(rigid_mass());
    group.bench_function("piece 80 by echoes", |b| {
        b.iter(|| black_box(solution.pieces(0, 80, 80).expect("solvable")));
    });
    group.finish();
}

criterion_group!(benches, expanded, echoes, periods);
criterion_main!(benches);
