//! Studies: how far off ways are, and how long they take, measured on one problem.
//!
//! A [`Reference`] holds values known to more than a hundred bits at times drawn by a seed. Errors are
//! differences from it, relative to the largest value; times are the least of several runs. [`measured_costs`] takes
//! those by which ways are weighed.

mod charts;
mod confluence;
mod cost;
mod costs;
mod curves;
mod harness;
mod loss;
mod map;
mod reference;
mod work;
mod zeros;

pub use charts::{Charted, Charts, Effort, ToChart, charts, usual_end};
pub use confluence::near_confluence;
pub use cost::{cost_over_order, derivation_cost};
pub use costs::measured_costs;
pub use curves::{
    DOUBLES, HALF, USELESS, at_arrivals, near_jump, over_courant, over_order, over_time,
};
pub use harness::{Measured, Settings, Subject, errors, measure, worst};
pub use loss::{Loss, first_losses, losses};
pub use map::{OrderRow, errors_by_order, order_law, order_map};
pub use reference::{Reference, Sampling};
pub use work::{Outcome, Step, ladder, steps, work_precision};
pub use zeros::{near_zeros, simple_roots};
