//! Waves whose velocity depends on their wavelength: dispersion relations `ω(k)` as formulas, the
//! velocities of crests and groups derived from them, and the velocity of a pulse's peak, in closed form
//! or by certified quadrature.

mod builtin;
mod cut_off;
mod error;
mod formula;
mod normal;
mod notation;
mod peak;
mod propagate;
mod pulse;
mod quadrature;
mod read;
mod relation;
mod series;

pub use builtin::Builtin;
pub use error::{DispersionError, NoGrid};
pub use formula::{Formula, FormulaError, Function};
pub use notation::{formula_latex, formula_text};
pub use peak::{
    Component, PeakVelocity, exact_peak_velocity, peak_velocity, peak_velocity_at,
    peak_velocity_by_quadrature, peak_velocity_of_sum,
};
pub use propagate::{Seen, propagate};
pub use pulse::{Pulse, Shape};
pub use read::{read_relation, read_spectrum};
pub use relation::{Quantity, Relation};
