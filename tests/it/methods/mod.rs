//! Methods in doubles against enclosures: every value that a method gives, and every bound that it
//! claims, is compared exactly with balls or rational numbers.
//!
//! Each test prints how many comparisons it made, the worst of them, and how often the enclosure was
//! too wide to decide: `cargo test --test methods -- --nocapture`.

mod c_export;
mod certified;
mod chooser;
mod clock;
mod compiled;
mod contacts;
mod held;
mod inclusion;
mod left_out;
mod marched;
mod marched_waves;
mod memory;
mod modular;
mod precision;
mod response;
mod simplest;
mod stable;
mod subject;
mod tally;
mod taylor;
mod times;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{FromPrimitive as _, ToPrimitive as _};
use proptest::prelude::RngExt as _;
use proptest::test_runner::{RngAlgorithm, TestRng};

/// Bits of the enclosures that values are compared with.
const BITS: u64 = 256;

/// Bits of enclosures that decide next to the smallest doubles.
const LATE_BITS: u64 = 4096;

/// Symbols or times with their values, as they are written in a scene.
type Values<'a> = &'a [(&'a str, &'a str)];

fn ratio(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(BigInt::from(numerator), BigInt::from(denominator))
}

/// A finite double as a fraction.
fn exact(value: f64) -> BigRational {
    BigRational::from_f64(value).expect("a finite number")
}

/// The nearest double.
fn near(value: &BigRational) -> f64 {
    value.to_f64().expect("a number")
}

/// The distance of doubles at a value: `2^(e−52)` for `2^e ≤ |value| < 2^(e+1)`.
fn unit_in_the_last_place(value: f64) -> f64 {
    let value = value.abs().max(f64::MIN_POSITIVE);
    value.next_up() - value
}

/// Numbers without pattern, the same in every run.
fn random(seed: u8) -> TestRng {
    TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32])
}

/// A mass ratio from 1/100 to 10, as it is written.
fn mass_ratio(random: &mut TestRng) -> String {
    match random.random_range(0..4) {
        0 => format!("{}/100", random.random_range(1..100)),
        1 => format!("{}/7", random.random_range(1..70)),
        2 => format!("{}/{}", random.random_range(1000..9999), random.random_range(1000..100_000)),
        _ => random.random_range(1..=10).to_string(),
    }
}
