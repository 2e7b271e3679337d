//! What several benchmarks share.

use wavestep::language::parse_number;
use wavestep::problem::Problem;
use wavestep::signal::Signal;

/// Calls `work` with the wave f of a recurrence on a window from 0, with a value for its symbol `mu` where
/// one is given.
pub fn with_signal(text: &str, mu: Option<&str>, to: &str, work: impl FnOnce(&dyn Signal)) {
    let number = |text| parse_number(text).expect("a number");
    let values = mu.into_iter().map(|mu| ("mu".to_owned(), number(mu))).collect();
    let problem = Problem::of_text("bench", text, &values).expect("a recurrence");
    let question = problem.question("f", [number("0"), number(to)]).expect("the wave f");
    work(&*question.signal);
}

/// The scene of the rigid mass.
pub fn rigid_mass() -> &'static str {
    wavestep::scenes::find("rigid-mass").expect("a built-in scene").text
}

/// Whether each benchmark runs once to see that it does.
pub fn is_test() -> bool {
    std::env::args().any(|own| own == "--test")
}
