//! Doubles at memory speed, with error bounds that are written down.
//!
//! The kernels know nothing of waves: they evaluate polynomials, sum series and march recurrences in
//! the machine's own numbers, and say by how much the results can be off. What they are given is
//! derived and proven elsewhere.
//!
//! | module | concept |
//! |---|---|
//! | [`Table`], [`Evaluator`] | polynomials piece by piece, at memory speed, also correctly rounded |
//! | [`echoes`] | sums of Laguerre polynomials, stable and as printed |
//! | [`march`] | a delay equation on Chebyshev coefficients, with a proven bound; systems of them, without |
//! | [`fixed`] | the same in integers, with some thirty proven digits |

mod bounds;
pub mod double_double;
pub mod echoes;
mod evaluator;
mod exponent;
pub mod fixed;
mod heads;
mod lanes;
mod level;
mod limit;
mod lookup;
pub mod march;
mod rows;
mod table;
mod vector;

pub use evaluator::Evaluator;
pub use level::Level;
pub use limit::Limit;
pub use table::{MAX_DEGREE, Piece, Table, TableError};
