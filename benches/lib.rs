//! What several benchmarks share.

use wavestep::evaluate::ClosedForm;
use wavestep::language::{Source, parse_number, read_recurrence};

/// Calls `work` with the wave f of a recurrence, with a value for its symbol `mu` where one is given.
pub fn with_signal(text: &str, mu: Option<&str>, work: impl FnOnce(&ClosedForm)) {
    let number = |text| parse_number(text).expect("a number");
    let values = mu.into_iter().map(|mu| ("mu".to_owned(), number(mu))).collect();
    let source = Source::new("bench", text).expect("a text");
    let recurrence = read_recurrence(&source, &values).expect("a recurrence");
    let observation = recurrence.observation("f").expect("the wave f");
    work(&ClosedForm::of_recurrence(&recurrence, &observation).expect("a signal"));
}

/// The scene of the rigid mass.
pub fn rigid_mass() -> &'static str {
    wavestep::scenes::find("rigid-mass").expect("a built-in scene").text
}
