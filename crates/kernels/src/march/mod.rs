//! The march: the recurrence of a repeatedly reflected wave, solved period by period on Chebyshev
//! coefficients in doubles.
//!
//! A bar returns every wave after one period, changed by the reflection at its ends. On each period
//! the answer is a smooth function, held as the Chebyshev coefficients of a polynomial whose degree
//! grows as the answer does. A [`Certificate`] looks at the polynomials alone, however they were made,
//! and proves how far they are from the true wave.

mod bound;
pub mod chebyshev;
mod compensated;
mod error;
mod number;
mod reflection;
mod relaxation;
mod scalar;
mod system;
mod waves;

pub use bound::Certificate;
pub use error::MarchError;
pub use number::{Complex, Scalar};
pub use reflection::{Parameter, Reflection};
pub use scalar::{Bounds, March, MarchOptions};
pub use system::{State, Term, WaveStep, WaveSystem};
pub use waves::WaveMarch;
