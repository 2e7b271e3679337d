//! Cycles a value of tables and of sums of echoes, which a clock that wanders does not change.
//!
//! Beside every measurement a chain of dependent operations of known length is timed: it tells how
//! many cycles a second the core ran at that moment. The median of several rounds is printed. An
//! argument picks the lines that contain it: `cargo bench --bench cycles -- unsorted`.

use std::f64::consts::TAU;
use std::hint::black_box;
use wavestep_kernels::double_double::DoubleDouble;
use wavestep_kernels::echoes::{EchoSum, Echoes, Expansion, Family, Method, Term};
use wavestep_kernels::{Level, Limit, Piece, Table};

/// Points of a table. With their times they fill more than a cache of the second level.
const POINTS: usize = 1_000_000;

/// Points of a table whose values stay in a cache.
const CACHED: usize = 16_384;

/// Points of a sum.
const ECHO_POINTS: usize = 4096;

/// Rounds of a measurement.
const ROUNDS: usize = 9;

/// Pieces of a table: about those of 200 periods of a rigid mass on a bar.
const PIECES: usize = 4200;

/// Cycles of one round of xorshift: three shifts and three exclusive ors, each waiting for the
/// last.
const CYCLES_A_STEP: f64 = 6.0;

/// Cycles a second, at this moment.
fn clock() -> f64 {
    const STEPS: u32 = 100_000;
    let mut state = black_box(88_172_645_463_325_252_u64);
    let start = seconds();
    for _ in 0..STEPS {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
    }
    black_box(state);
    f64::from(STEPS) * CYCLES_A_STEP / (seconds() - start)
}

/// The time that this thread has run, in seconds, where the system tells; else the time of the day.
/// What other processes take in between does not count then.
fn seconds() -> f64 {
    std::thread::yield_now();
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let run = told.and_then(|line| line.split(' ').next()?.parse::<f64>().ok());
    let wall = std::time::UNIX_EPOCH.elapsed().map_or(0.0, |time| time.as_secs_f64());
    run.map_or(wall, |nanoseconds| nanoseconds * 1e-9)
}

/// Prints the median of the cycles a value, and values a second.
fn measure<R>(name: &str, values: usize, mut work: impl FnMut() -> R) {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    if !wanted.iter().all(|part| name.contains(part.as_str())) {
        return;
    }
    if std::env::args().any(|argument| argument == "--test") {
        black_box(work());
        return println!("{name:<28} runs");
    }
    // Asking for the time takes some microseconds: as many calls as make that nothing.
    let mut timed = |count: usize| {
        let start = seconds();
        (0..count).for_each(|_| drop(black_box(work())));
        seconds() - start
    };
    let mut count = 1;
    while timed(count) < 0.01 {
        count *= 2;
    }
    let mut round = || {
        let before = clock();
        let seconds = timed(2 * count) / (2 * count * values) as f64;
        (seconds * 0.5 * (before + clock()), seconds.recip())
    };
    round();
    let mut rounds: Vec<(f64, f64)> = (0..ROUNDS).map(|_| round()).collect();
    rounds.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ((least, _), (cycles, rate)) = (rounds[0], rounds[ROUNDS / 2]);
    println!(
        "{name:<28} {cycles:8.2} cycles a value (least {least:.2}), {rate:9.2e} values a second"
    );
}

/// `sin 2πt` on `[0, pieces/64]` by Taylor polynomials about the centres, with some low parts.
fn sine(degree: usize, low: usize) -> Table {
    let piece = |i: usize| {
        let (width, scale) = (1.0 / 64.0, 128.0);
        let start = i as f64 * width;
        let centre = start + width / 2.0;
        let (sine, cosine) = (TAU * centre).sin_cos();
        let mut factor = 1.0;
        let mut coefficients = Vec::new();
        for k in 0..=degree {
            coefficients.push(factor * [sine, cosine, -sine, -cosine][k % 4]);
            factor *= TAU / scale / (k as f64 + 1.0) * 3.0_f64.min(k as f64 + 1.0);
        }
        let low = coefficients.iter().take(low).map(|c| c * 1e-17).collect();
        Piece { start, centre, scale, coefficients, low, error: 1e-30 }
    };
    let pieces: Vec<Piece> = (0..PIECES).map(piece).collect();
    Table::new(&pieces, pieces.len() as f64 / 64.0).expect("a table")
}

/// The rigid mass, `μ = 1`, and times that fill the period of echo `n`.
fn rigid_mass(n: usize) -> (EchoSum, Vec<f64>) {
    let two = Expansion::try_from(2.0).expect("a number");
    let terms = [Term { lag: 0, coefficient: Expansion::ONE }];
    let wave = Echoes::new(Family::Laguerre, Expansion::ONE, two, Expansion::ONE, &terms, two);
    let sum = EchoSum::new(wave.expect("a wave"), n).expect("a sum");
    let step = 2.0 / ECHO_POINTS as f64;
    (sum, (0..ECHO_POINTS).map(|i| 2.0 * n as f64 + (i as f64 + 0.5) * step).collect())
}

fn main() {
    let (plain, certified) = (sine(12, 0), sine(23, 24));
    let golden = 0.618_033_988_749_894_9;
    let scattered: Vec<f64> =
        (0..POINTS).map(|i| (i as f64 * golden).fract() * plain.end()).collect();
    let ascending: Vec<f64> = (0..POINTS).map(|i| i as f64 * plain.end() / POINTS as f64).collect();
    let mut out = vec![1.0; POINTS];
    measure("stores", POINTS, || black_box(&mut out).fill(black_box(1.0)));
    for level in Level::available() {
        let name = |what: &str| format!("{what}/{level:?}");
        let at = |table| Table::evaluator(table).with_level(level);
        let (plain, certified) = (at(&plain), at(&certified));
        measure(&name("ascending"), POINTS, || plain.values(&ascending, black_box(&mut out)));
        measure(&name("ascending in cache"), CACHED, || {
            plain.values(&ascending[..CACHED], black_box(&mut out[..CACHED]))
        });
        measure(&name("unsorted"), POINTS, || plain.values(&scattered, black_box(&mut out)));
        measure(&name("rounded ascending"), POINTS, || certified.rounded(&ascending, &mut out));
        measure(&name("rounded unsorted"), POINTS, || certified.rounded(&scattered, &mut out));
    }
    for n in [1, 10, 50, 200] {
        let (sum, times) = rigid_mass(n);
        measure(&format!("echoes, n = {n}"), times.len(), || {
            sum.fill(black_box(&times), Limit::Right, &mut out[..ECHO_POINTS]).expect("in range");
        });
        for method in Method::ALL {
            measure(&format!("echoes one by one, {method:?}, n = {n}"), 16, || {
                for time in &times[..16] {
                    let time = DoubleDouble::from(*time);
                    black_box(sum.pair(method, time, Limit::Right).expect("in range"));
                }
            });
        }
    }
}
