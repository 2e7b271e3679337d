//! Studies: how far off ways are, and how long they take, measured on one problem.
//!
//! A [`Reference`] holds values known to more than a hundred bits at times drawn by a seed. Errors are
//! differences from it, relative to the largest value; times are the least of several runs.

mod harness;
mod reference;
mod work;

pub use harness::{Measured, Settings, errors, measure, worst};
pub use reference::{Reference, Sampling};
pub use work::{LADDER, Outcome, ladder, work_precision};
