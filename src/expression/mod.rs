//! Exact values: exponential polynomials with one normal form, and functions made of them.
//!
//! [`Expression`] is a sum `Σ_j p_j e^{λ_j}` whose coefficients and exponents are [`Fraction`]s:
//! polynomials in named symbols, localised at factors known to be non-zero. A wave function on one
//! period is an `Expression` in the local time; its coefficients, such as `1 + e^{−2μ}`, are
//! expressions too. Poles of second order bring square roots into both. [`Assumptions`] says what may be
//! divided by. [`Transform`] is the same kind of function in the Laplace domain. [`EchoSum`] is a function
//! of all time.
//!
//! Nothing here knows of bars or of text.

mod assumptions;
mod calculus;
mod constant;
mod echo_sum;
mod fraction;
mod root;
mod sum;
mod transform;
mod turn;

pub use assumptions::{Assumptions, Condition, NotInvertible, Relation, free_name};
pub use constant::{Constant, Definition, Root};
pub use echo_sum::EchoSum;
pub use fraction::{Fraction, NotAUnit};
pub use sum::{ExponentialSum, Expression};
pub(crate) use transform::InexactDivision;
pub use transform::{Exact, Field, Transform};
pub use turn::PI;
pub(crate) use turn::is_number;
