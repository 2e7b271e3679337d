//! The march: the recurrence of a repeatedly reflected wave, solved period by period on Chebyshev
//! coefficients in doubles.
//!
//! A bar returns every wave after one period, changed by the reflection at its ends. On each period
//! the answer is a smooth function, held as the Chebyshev coefficients of a polynomial whose degree
//! grows as the answer does. A [`Certificate`] looks at the polynomials alone, whoever made them,
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
//! | `sample` | values at ascending times |

mod bound;
pub mod chebyshev;
mod compensated;
mod reflection;
mod relaxation;
mod sample;
mod scalar;

pub use bound::Certificate;
pub use reflection::{Parameter, Reflection, ReflectionError};
pub use sample::{LocalTime, SampleError, sample, sample_with_bounds};
pub use scalar::{Bounds, March, MarchError, MarchOptions};
