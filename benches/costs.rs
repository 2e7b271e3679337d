//! The table of costs of `src/answer/cost.rs`, measured.
//!
//! Prints each constant as it stands there, from the method whose cost it makes up, at one size: the
//! rigid mass with `μ = 1` and 200 periods, and a recurrence of two poles for what is marched wave by
//! wave. Run `cargo bench --bench costs` on a quiet machine and round to one or two digits; the clock counts.

use std::hint::black_box;
use std::time::Instant;
use wavestep::language::parse_number;
use wavestep::signal::{Certified, Compiled, Evaluator, Limit, Marched, Summation, Summed, Taps};
use wavestep_benches::{rigid_mass, with_signal};
use wavestep_polynomial::Rational;

/// The order at which costs are measured, and the count of echoes that its values sum.
const ORDER: u32 = 200;
const ECHOES: f64 = (ORDER + 1) as f64 * (ORDER + 1) as f64 / 2.0;

/// Coefficients of a march to that order, as the model counts them.
const COEFFICIENTS: f64 = (ORDER + 1) as f64 * 30.0;

/// Pieces between two arrivals, and terms of their polynomials, as the model counts them.
const PIECES: f64 = 16.0;
const TERMS: f64 = 40.0;

const TWO_POLES: &str = r#"
recurrence "Two poles"
period 2, local s, time t
wave h, f
equation h[n]' + h[n] = h[n-1]' - h[n-1]
equation f[n]' + 2*f[n] = h[n]
continuous h[n] - h[n-1] starts at 1
continuous f[n] starts at 0
"#;

/// Seconds of a call, the least of some.
fn seconds<T>(mut work: impl FnMut() -> T) -> f64 {
    let begin = Instant::now();
    let mut least = f64::INFINITY;
    for calls in 1.. {
        let start = Instant::now();
        black_box(work());
        least = least.min(start.elapsed().as_secs_f64());
        if calls >= 3 && begin.elapsed().as_secs_f64() > 0.3 {
            break;
        }
    }
    least
}

fn print(name: &str, what: &str, seconds: f64) {
    println!("const {name}: f64 = {seconds:.1e}; // {what}");
}

fn main() {
    let to = (2 * ORDER).to_string();
    let late = parse_number(&to).unwrap() - &parse_number("1/3").unwrap();
    let value = |method: &dyn Evaluator| seconds(|| method.value(&late, Limit::Right).unwrap());
    with_signal(rigid_mass(), Some("1"), &to, |signal| {
        assert!(
            signal.closed_form().is_ok_and(|form| Taps::of(form).is_ok()),
            "the march in integers is measured"
        );
        let certified = |times: &[Rational]| {
            let method = Certified::new(signal).unwrap();
            method.exact_values(times, Limit::Right).unwrap()
        };
        let many: Vec<Rational> =
            (1..1000).map(|i| &late * &Rational::new(i.into(), 1000.into())).collect();
        let one = seconds(|| certified(std::slice::from_ref(&late)));
        let point = (seconds(|| certified(&many)) - one) / many.len() as f64;
        print("FIXED_PERIOD", "a period of a march in integers", one / f64::from(ORDER + 1));
        print("FIXED_POINT", "a value of it, at an exact time", point);
        let pieces = seconds(|| Compiled::new(signal, None).unwrap());
        print("MOVED", "a polynomial of a march", pieces / (PIECES * f64::from(ORDER + 1)));
        let compiled = Compiled::new(signal, None).unwrap();
        let lookup = value(&compiled);
        print("LOOKUP", "the piece of an exact time, and its value", lookup);
        for (name, what, precision) in [
            ("STEP", "a step of a recurrence in doubles", Summation::Scaled),
            ("PAIR_STEP", "the same in pairs", Summation::DoubleDouble),
        ] {
            let stable = Summed::new(signal, precision).unwrap();
            print(name, what, value(&stable) / ECHOES);
        }
        let plain = seconds(|| Marched::new(signal).unwrap());
        let proven = seconds(|| Marched::proven(signal).unwrap());
        let march = Marched::new(signal).unwrap();
        print("COEFFICIENT", "a coefficient of a march", value(&march) / COEFFICIENTS);
        print("PROVEN_COEFFICIENT", "the same with its bound", (proven - plain) / COEFFICIENTS);
    });
    with_signal(TWO_POLES, None, "20", |signal| {
        let end = parse_number("20").unwrap();
        let n = 11.0;
        let certified = seconds(|| {
            let method = Certified::new(signal).unwrap();
            method.value(&(&end - &parse_number("1/3").unwrap()), Limit::Right).unwrap()
        });
        print("BALL", "an operation in balls", certified / (3.0 * n * n / 2.0));
        let made = seconds(|| Compiled::new(signal, None).unwrap());
        print("TERM", "a term of a piece without a march", made / (PIECES * n * TERMS * n));
    });
    with_signal(TWO_POLES, None, &to, |signal| {
        let march = Marched::new(signal).unwrap();
        print("WAVE", "a wave on a period", value(&march) / (2.0 * f64::from(ORDER + 1)));
    });
}
