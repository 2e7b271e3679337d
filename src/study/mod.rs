//! Studies: how far off ways are, and how long they take, measured on one problem.
//!
//! A [`Reference`] holds values known to more than a hundred bits at times drawn by a seed. Errors are
//! differences from it, relative to the largest value; times are the least of several runs.

mod confluence;
mod curves;
mod harness;
mod map;
mod reference;
mod work;

pub use confluence::near_confluence;
pub use curves::{
    DOUBLES, USELESS, at_arrivals, cost_over_order, near_jump, near_zeros, over_courant,
    over_order, over_time,
};
pub use harness::{Measured, Settings, errors, measure, worst};
pub use map::{errors_by_order, order_map};
pub use reference::{Reference, Sampling};
pub use work::{LADDER, Outcome, Step, ladder, work_precision};
