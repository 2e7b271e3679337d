//! Signals in closed form: pieces and echoes of a recurrence, on a grid or a lattice of delays.
//!
//! Between two arrivals such a signal is one exponential polynomial. [`ClosedForm`] encloses it, on a grid
//! by one piece of each wave that is seen (`periods`), on a lattice by all echoes that have arrived;
//! `stretch` tells where it is smooth, `values` what it is there, `shares` which echoes matter for a tolerance. Exact values come from `exact`, where
//! echoes of a recurrence are rational, and from `scene`, echo by echo. [`ClosedSignal`] is all of this on
//! a window of time.

mod contribution;
mod echoes;
mod exact;
mod form;
pub mod memory;
pub mod modular;
mod periods;
mod scene;
mod shares;
mod signal;
mod stretch;
mod values;

pub use form::ClosedForm;
pub use signal::ClosedSignal;
