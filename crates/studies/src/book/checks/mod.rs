//! Checks of what no scene of bars derives: words, estimates, local contact, dispersion.
//!
//! An entry asks for one by its name, with `check NAME`; [`CHECKS`] lists them.

mod contact;
mod dispersion;
mod estimates;

use crate::book::refusal::Refusal;
use crate::book::verdict::{Ground, Verdict};
use crate::estimates::Estimate;
use wavestep::export::Formula;
use wavestep::expression::Expression;
use wavestep::language::{Source, read_expression};

/// What a check found: its verdict, what is derived, and what was done, in sentences.
pub struct Checked {
    pub verdict: Verdict,
    pub derived: Vec<Formula>,
    pub steps: Vec<String>,
}

impl Checked {
    /// Both sides are the same expression.
    fn proved(steps: Vec<String>) -> Checked {
        let verdict = Verdict::Proved(vec![Ground::SameExpression]);
        Checked { verdict, derived: Vec::new(), steps }
    }
}

pub type Check = fn() -> Result<Checked, Refusal>;

/// All checks that entries may ask for, by their names.
pub const CHECKS: [(&str, Check); 13] = [
    ("equal-bars", estimates::equal_bars),
    // The estimate without number that comes before 6.86, and 6.86.
    ("energy-estimate", || estimates::estimate(Estimate::Energy)),
    ("better-estimate", || estimates::estimate(Estimate::Better)),
    ("hertz-stiffness", contact::stiffness),
    ("hertz-integral", contact::integral),
    ("hertz-time", contact::time),
    ("hertz-constant", contact::constant),
    ("two-waves", dispersion::two_waves),
    ("narrow-band", dispersion::narrow_band),
    ("beat", dispersion::beat),
    ("slope-of-pulse", dispersion::slope_of_pulse),
    ("peak-of-sum", dispersion::peak_of_sum),
    ("peak-of-spectrum", dispersion::peak_of_spectrum),
];

pub fn run(name: &str) -> Result<Checked, Refusal> {
    let check = CHECKS.iter().find(|(own, _)| *own == name);
    check.ok_or_else(|| Refusal::UnknownName(name.to_owned()))?.1()
}

fn read(text: &str) -> Result<Expression, Refusal> {
    Ok(read_expression(&Source::new("identity", text)?)?)
}

/// An identity of two expressions: the step that states it, where they have one normal form.
pub fn identity(left: &str, right: &str) -> Result<String, Refusal> {
    match read(left)? == read(right)? {
        true => Ok(format!("{left} = {right}: the same expression in normal form")),
        false => Err(Refusal::Differs(left.to_owned(), right.to_owned())),
    }
}
