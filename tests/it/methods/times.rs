//! Times at which methods can go wrong: without pattern, at arrivals and beside them, and at the ends
//! of the window.

use crate::methods::subject::Subject;
use crate::methods::{exact, near};
use num_rational::BigRational;
use proptest::prelude::RngExt as _;
use proptest::test_runner::TestRng;
use wavestep::signal::{Limit, Signal as _};

/// The smallest double of the window, and the largest.
pub fn ends(subject: &Subject<'_>) -> (f64, f64) {
    let (mut first, mut last) = (near(&subject.from), near(&subject.to));
    while exact(first) < subject.from {
        first = first.next_up();
    }
    while exact(last) > subject.to {
        last = last.next_down();
    }
    (first, last)
}

/// So many doubles of the window without pattern.
pub fn anywhere(subject: &Subject<'_>, random: &mut TestRng, count: usize) -> Vec<f64> {
    let (first, last) = ends(subject);
    (0..count).map(|_| random.random_range(first..=last)).collect()
}

/// For each arrival within the window the smallest double that is not before it, found by halving
/// with the order that is decided exactly.
pub fn first_doubles(subject: &Subject<'_>) -> Vec<f64> {
    let (first, last) = ends(subject);
    let stretch = |time: f64| subject.earlier.stretch_at(&exact(time), Limit::Right);
    let arrived = |time: f64, arrival: usize| stretch(time).expect("an order") >= Some(arrival);
    let mut found = Vec::new();
    for arrival in 1..subject.earlier.count().unwrap() {
        if !arrived(last, arrival) {
            continue;
        }
        // Doubles from 0 on are in the order of their bits.
        let (mut low, mut high) = (first.max(0.0).to_bits(), last.to_bits());
        while low < high {
            let middle = low.midpoint(high);
            match arrived(f64::from_bits(middle), arrival) {
                true => high = middle,
                false => low = middle + 1,
            }
        }
        found.push(f64::from_bits(low));
    }
    found
}

/// Arrivals with the three doubles on either side, and the ends of the window with those beside.
pub fn special(subject: &Subject<'_>) -> Vec<f64> {
    let (first, last) = ends(subject);
    let mut times = vec![first, first.next_up(), last.next_down(), last];
    for arrival in first_doubles(subject) {
        let (mut before, mut after) = (arrival, arrival);
        times.push(arrival);
        for _ in 0..3 {
            (before, after) = (before.next_down(), after.next_up());
            times.extend([before, after]);
        }
    }
    times.retain(|time| (first..=last).contains(time));
    times
}

/// The arrivals within the window that are rational numbers, that at its first time included.
pub fn arrivals(subject: &Subject<'_>) -> Vec<BigRational> {
    let stretches = 1..subject.earlier.count().unwrap();
    let arrivals =
        stretches.filter_map(|stretch| subject.earlier.exact_time(stretch, Limit::Right));
    arrivals.filter(|time| *time >= subject.from).collect()
}
