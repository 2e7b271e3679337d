//! Answers in doubles: which way to values is the cheapest that is good enough.
//!
//! A [`Question`] is an observable on a window. There are many ways to its values: the methods that
//! evaluate the exact solution ([`signal`](crate::signal)), and cheaper models of the same scene
//! ([`model`](crate::model)). A [`Tolerance`] says how far values may be off; [`consider`] weighs the
//! ways by their proven bounds and by a measured table of costs, and says why it picks one.

mod cost;
mod doubles;
mod method;
mod question;
mod reduced;
mod tolerance;
mod way;
mod weigh;

pub use cost::{Cost, Costs, InvalidCosts, PIECES, Size, TERMS, Work, coefficients};
pub use doubles::{Accuracy, Doubles, Remark, Tested, doubles};
pub use method::{InvalidMethod, Method};
pub use question::Question;
pub use reduced::NotReduced;
pub use tolerance::{InvalidTolerance, Tolerance};
pub use way::{Way, WayError};
pub use weigh::{Candidate, Promise, Verdict, Weighed, consider};
