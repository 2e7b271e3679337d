//! Local deformation at the contact of two long bars: `X = k α^m`, solved in closed form.
//!
//! [`PowerLaw`] is the problem without units: how the force rises towards its limit, forwards and
//! backwards, in enclosures. [`LongBars`] puts units to it: stiffness, impedances and a velocity in,
//! largest force, rise times and the equivalent spring out. Waves that return from far ends are not
//! part of it; scenes with a `hertz` element are, by the method of steps.

mod comparison;
mod error;
mod impact;
mod law;
mod scene;

pub use comparison::distance_from_spring;
pub use error::HertzError;
pub use impact::LongBars;
pub use law::{PowerLaw, Share, equal_bars_constant};
pub use scene::ContactOfScene;
