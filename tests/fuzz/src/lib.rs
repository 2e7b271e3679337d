//! Ten fuzz targets: functions of bytes with a property that holds whatever the bytes are.
//!
//! `cargo test -p wavestep-fuzz` puts a fixed number of altered seeds through each target, about a minute in all. Most
//! seeds are files of the repository; a few stand in `seeds/`. One target alone, for so many seconds, on stable Rust:
//!
//! ```text
//! cargo run -p wavestep-fuzz -- scenes 3600
//! ```
//!
//! Guided by coverage, with libFuzzer (`libfuzzer-sys` builds it; a C++ compiler is needed, nightly Rust is not). The
//! target is named in `WAVESTEP_FUZZ`, the first folder keeps what is found:
//!
//! ```text
//! cargo run -p wavestep-fuzz -- --write target/fuzz/seeds
//! mkdir -p target/fuzz/found/scenes
//! export RUSTFLAGS="--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
//!     -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
//!     -Cllvm-args=-sanitizer-coverage-trace-compares"
//! cargo build -p wavestep-fuzz --target x86_64-unknown-linux-gnu --target-dir target/fuzz
//! WAVESTEP_FUZZ=scenes target/fuzz/x86_64-unknown-linux-gnu/debug/wavestep-fuzz \
//!     -max_total_time=3600 -timeout=60 target/fuzz/found/scenes target/fuzz/seeds/scenes
//! ```
//!
//! A guided run writes an input that fails to `crash-…`; `cargo run -p wavestep-fuzz -- scenes crash-…` repeats it.

mod bytes;
mod certificates;
mod kernels;
mod mutate;
mod numbers;
#[path = "../../../crates/kernels/tests/it/random.rs"]
#[allow(dead_code, missing_docs, reason = "shared with the tests of the kernels")]
mod random;
mod tables;
mod texts;

use std::path::Path;
use std::time::{Duration, Instant};

pub use random::Random;

/// A property of bytes.
#[derive(Clone, Copy)]
pub struct Target {
    /// Its name.
    pub name: &'static str,
    /// Panics where the property does not hold.
    pub run: fn(&[u8]),
    /// Folders and files of the repository whose texts are altered; none where inputs are bytes without form.
    seeds: &'static [&'static str],
    /// How many inputs `cargo test` tries.
    pub cases: usize,
}

/// All targets.
pub const TARGETS: [Target; 10] = [
    Target {
        name: "scenes",
        run: texts::scenes,
        seeds: &["scenes", "grammar/accepted-scenes", "grammar/rejected-scenes"],
        cases: 40_000,
    },
    Target {
        name: "recurrences",
        run: texts::recurrences,
        seeds: &["grammar/accepted", "grammar/rejected", "grammar/rejected-names", "scenes"],
        cases: 40_000,
    },
    Target {
        name: "expressions",
        run: texts::expressions,
        seeds: &["tests/fuzz/seeds/expressions.txt"],
        cases: 80_000,
    },
    Target { name: "locks", run: texts::locks, seeds: &["tests/locks"], cases: 20_000 },
    Target {
        name: "values",
        run: texts::values,
        seeds: &["tests/fuzz/seeds/values.txt"],
        cases: 20_000,
    },
    Target { name: "certificates", run: certificates::certificates, seeds: &[], cases: 4000 },
    Target { name: "tables", run: tables::tables, seeds: &[], cases: 200_000 },
    Target { name: "decimals", run: numbers::decimals, seeds: &[], cases: 30_000 },
    Target { name: "balls", run: numbers::balls, seeds: &[], cases: 60_000 },
    Target { name: "kernels", run: kernels::kernels, seeds: &[], cases: 10_000 },
];

/// Inputs are no longer than that.
pub const MAX_BYTES: usize = 4096;

/// A path of the repository.
fn path(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)
}

impl Target {
    /// The target of a name.
    pub fn find(name: &str) -> Option<Target> {
        TARGETS.into_iter().find(|target| target.name == name)
    }

    /// What inputs are made of: short texts whole, lines of files `.txt` one by one.
    pub fn seeds(&self) -> Vec<Vec<u8>> {
        let mut files = Vec::new();
        for name in self.seeds {
            match path(name).read_dir() {
                Ok(entries) => files.extend(entries.map(|entry| entry.expect("an entry").path())),
                Err(_) => files.push(path(name)),
            }
        }
        files.sort();
        let mut seeds = Vec::new();
        for file in files {
            let bytes = std::fs::read(&file).expect("a file");
            match file.extension().is_some_and(|extension| extension == "txt") {
                true => seeds.extend(bytes.split(|byte| *byte == b'\n').map(<[u8]>::to_vec)),
                false => seeds.push(bytes),
            }
        }
        seeds.retain(|seed| seed.len() <= MAX_BYTES);
        if self.seeds.is_empty() {
            let mut random = Random(1);
            let any = |length: u64| (0..length).map(|_| random.bits() as u8).collect();
            seeds.extend((4..12).map(|i| 1 << i).map(any));
        }
        seeds
    }

    /// An input made from another one, with parts of a third.
    pub fn altered(&self, one: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
        mutate::altered(one, other, !self.seeds.is_empty(), random)
    }

    /// Tries so many inputs, or until a time is over; gives their number and the longest time that one took.
    pub fn try_many(&self, cases: usize, time: Duration, seed: u64) -> (usize, Duration) {
        let (seeds, start, mut random) = (self.seeds(), Instant::now(), Random(seed));
        let (mut count, mut longest) = (0, Duration::ZERO);
        while count < cases && start.elapsed() < time {
            let input = match seeds.get(count) {
                Some(seed) => seed.clone(),
                None => {
                    let [one, other] =
                        [(); 2].map(|()| &seeds[random.bits() as usize % seeds.len()]);
                    self.altered(one, other, &mut random)
                }
            };
            let began = Instant::now();
            self.try_one(&input);
            longest = longest.max(began.elapsed());
            count += 1;
        }
        (count, longest)
    }

    /// Tries one input, and shows it where the property does not hold.
    pub fn try_one(&self, input: &[u8]) {
        struct Shown<'a>(&'a str, &'a [u8]);
        impl Drop for Shown<'_> {
            fn drop(&mut self) {
                if std::thread::panicking() {
                    eprintln!("{} fails for b\"{}\"", self.0, self.1.escape_ascii());
                }
            }
        }
        let shown = Shown(self.name, input);
        (self.run)(input);
        drop(shown);
    }
}
