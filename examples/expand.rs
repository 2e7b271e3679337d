//! All pieces of the rigid mass expanded, timed: what `benches/peers` compares with other systems.
//!
//! `cargo run --release --example expand -- 80`

use std::time::Instant;
use wavestep::Problem;
use wavestep_polynomial::{Integer, Rational, factorial};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let last: usize = std::env::args().nth(1).ok_or("give an order, such as 80")?.parse()?;
    let start = Instant::now();
    let problem = Problem::builtin("rigid-mass")?;
    let table = problem.solution()?.table(0, last)?.ok_or("rational constants")?;
    let mut bits = 0;
    for n in 0..=last {
        table.for_each_term(n, |term| bits += term.numerator.bits());
    }
    let seconds = start.elapsed().as_secs_f64();
    std::hint::black_box(bits);

    // The last piece at s = 1, mu = 1/3, E = exp(-2 mu) = 1/2, without its factor exp(-s).
    let (mut terms, mut value) = (0, Rational::default());
    let period = Rational::new(2.into(), 3.into());
    let power = |base: &Rational, exponent: u32| base.pow(exponent as i32);
    table.for_each_term(last, |term| {
        let (i, l) = (term.local_power, term.period_power);
        let below: Integer = factorial(i) * factorial(l) * term.denominator;
        let half = Rational::new(1.into(), 2.into());
        let amount = Rational::new(term.numerator.to_integer(), below);
        value += amount * power(&period, l) * power(&half, term.age);
        terms += 1;
    });
    println!("terms={terms} value={value} seconds={seconds:.6}");
    Ok(())
}
