//! Waves whose velocity depends on their wavelength: dispersion relations `ω(k)` as formulas, the
//! velocities of crests and groups derived from them, and the velocity of a pulse's peak, in closed form
//! or by certified quadrature.
//!
//! ```
//! use wavestep_studies::dispersion::{Builtin, Pulse, Shape, Travel, peak_velocity, propagate};
//! use wavestep_studies::dispersion::formula_text;
//! use wavestep_polynomial::Rational;
//!
//! let cubic = Builtin::Cubic.relation();
//! assert_eq!(formula_text(cubic.frequency()), "k - k^3/12");
//! assert_eq!(formula_text(cubic.group_velocity()), "1 - k^2/4");
//! let pulse = Pulse::in_space(Shape::Square, &Rational::from_integer(10.into()))?;
//! let peak = peak_velocity(&cubic, &pulse, 6, 1000)?;
//! assert_eq!(peak.value.to_string(), "0.987101");
//! // Seen on its way, the peak is about as fast.
//! let seen = propagate(&cubic, &pulse, Travel::until(5.0))?;
//! assert!((seen.velocity - 0.9871).abs() < 2e-4);
//! # Ok::<(), wavestep_studies::dispersion::DispersionError>(())
//! ```

mod beats;
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

pub use beats::{TwoWaves, two_waves};
pub use error::{DispersionError, NoGrid};
pub use formula::{Formula, FormulaError, Function};
pub use notation::{formula_latex, formula_text};
pub use peak::{
    Component, PeakVelocity, exact_peak_velocity, peak_velocity, peak_velocity_at,
    peak_velocity_by_quadrature, peak_velocity_of_sum,
};
pub use propagate::{Seen, Travel, propagate};
pub use pulse::{Pulse, Shape};
pub use read::{read_relation, read_spectrum};
pub use relation::{Builtin, Quantity, Relation, Sample};
