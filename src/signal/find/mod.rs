//! Certified roots and extrema of an observable on a window of time.
//!
//! Between arrivals an observable is one exponential polynomial, hence analytic; where echoes
//! arrive it may jump. Every root in the window lies in one of the enclosures that are returned,
//! and every statement about one of them is proven with balls or decided exactly; what is not
//! decided is returned as that. The proofs stand where the work is done: `cover` cuts a stretch
//! into cells, `refine` narrows one root, `roots` and `extrema` put the answers together, `goal`
//! keeps the best value so far, `search` asks for exact values where an enclosure cannot tell zero
//! from what is small, and `square` looks at what is squared instead. What kind of function it is
//! they need not know: any [`Signal`](crate::signal::Signal) will do.
//!
//! Ends of stretches may be irrational. A cell there reaches a little beyond the end, where the
//! same exponential polynomial goes on; a root on a monotone run counts where the limit at the end
//! itself and the value at the other end of the run have different signs, and then it lies within
//! the stretch.

mod cover;
mod extrema;
mod goal;
pub mod refine;
mod roots;
mod search;
mod size;
mod square;

pub(crate) use cover::middle_and_half;
pub use extrema::{Extremum, Place};
pub use goal::Goal;
pub use roots::{Root, Roots};
pub use search::Search;
