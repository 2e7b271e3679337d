//! Pictures of scenes: observables against time, diagrams of place and time, fields along the line.
//!
//! Here exact solutions become the numbers that [`plot`](wavestep_draw) draws: sampled where they bend,
//! cut where they jump, in units with prefixes.

mod against_time;
mod along;
mod courses;
mod error;
mod lagrange;
mod prefix;
mod sampled;

pub use against_time::{Course, against_time};
pub use along::along_the_line;
pub use courses::{course, courses, usual_end, window};
pub use error::PictureError;
pub(crate) use lagrange::Places;
pub use lagrange::lagrange;
pub use prefix::Prefixed;
pub use sampled::{Sampled, sampled};
