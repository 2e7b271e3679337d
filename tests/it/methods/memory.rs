//! Memory: what does not fit is known early.

use wavestep::limits;
use wavestep::signal::EvaluateError;
use wavestep::signal::closed::memory::Memory;

/// Echoes of one pole have as many coefficients as there were echoes before.
#[test]
fn what_does_not_fit_is_known_early() {
    let steps = |last: usize| {
        let mut memory = Memory::of(1000);
        (0..last).find_map(|step| memory.add(step + 1, last).err().map(|error| (step, error)))
    };
    let allowed = limits::memory();
    let fits = (2.0 * allowed as f64 / 1000.0).sqrt() as usize;
    assert_eq!(steps(fits * 9 / 10), None);
    let Some((step, EvaluateError::TooMuchMemory { megabytes, percent })) = steps(10 * fits) else {
        panic!("ten times as many take a hundred times as much")
    };
    assert!(step < 64 && (9..=11).contains(&percent), "{step} {percent}");
    // A power read off the first echoes is a little low: 32·33/(16·17) is 2^1.96.
    assert!((75..=100).contains(&(megabytes * 1_000_000 / allowed)), "{megabytes}");
}
