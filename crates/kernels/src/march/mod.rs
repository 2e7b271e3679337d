//! The march: the recurrence of a repeatedly reflected wave, solved period by period on Chebyshev
//! coefficients in doubles.
//!
//! A bar returns every wave after one period, changed by the reflection at its ends. On each period
//! the answer is a smooth function, held as the Chebyshev coefficients of a polynomial whose degree
//! grows as the answer does. A [`Certificate`] looks at the polynomials alone, however they were made,
//! and proves how far they are from the true wave.
//!
//! | file | concept |
//! |---|---|
//! | `reflection` | the numbers of the problem, and what they may be |
//! | `chebyshev` | values, ends and norms of a polynomial, with the rounding errors |
//! | `compensated` | sums carried in two doubles |
//! | `relaxation` | `u' + B u = r` on coefficients in O(N) |
//! | `scalar` | one wave, period by period |
//! | `bound` | the proof that the computed wave is near the true one |
//! | `number` | real and complex numbers that waves are made of |
//! | `system` | several waves with several poles and lags, driven by each other: what they obey |
//! | `first_order` | `z' = λ z + r` on coefficients, for any real or complex `λ` of modest size |
//! | `waves` | such a system, period by period; measured, without a proven bound |

mod bound;
pub mod chebyshev;
mod compensated;
mod first_order;
mod number;
mod reflection;
mod relaxation;
mod scalar;
mod system;
mod waves;

pub use bound::Certificate;
pub use number::{Complex, Scalar};
pub use reflection::{Parameter, Reflection, ReflectionError};
pub use scalar::{Bounds, March, MarchError, MarchOptions};
pub use system::{State, SystemError, Term, WaveStep, WaveSystem};
pub use waves::{WaveMarch, WaveMarchError};
