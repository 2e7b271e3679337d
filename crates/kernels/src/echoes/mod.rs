//! Sums of echoes in doubles: the same wave summed in four ways, from the formula as printed to one
//! that is right to the last bit, so that what each digit costs can be seen.
//!
//! A wave in a bar with lumped ends is a sum of echoes, one a return: [`Echoes`] says which.
//! [`EchoSum`] evaluates it at times, by a [`Method`]. Summation to echo `n` costs `n²/2` steps of a
//! recurrence a point in all of them.
//!
//! What was measured on the rigid mass of a fixed bar, `φ_k(x) = e^{−x} L_k(2x)`, `D = 2μ`, for
//! `μ` from 1/100 to 10 and `n ≤ 200`, in ulps of the largest value (the tests print them anew, and
//! hold the limits):
//!
//! | method | loses at most, as measured | limit held by tests |
//! |---|---|---|
//! | [`Method::Expanded`] | everything, long before `n = 200` | |
//! | [`Method::Plain`] | 400,000 ulps (`μ = 1/100`, just behind front 200) | |
//! | [`Method::Scaled`] | 24 ulps, for every echo to 2000 | 64 |
//! | [`EchoSum::fill`] | 22 ulps | 64 |
//! | [`Method::DoubleDouble`] | 0.50 ulps, the rounding of the result | 2 |
//!
//! The worst times lie within an ulp of an arrival. With `D = 2/3`, which is no double, and `n` from
//! 100 to 200, 31 ulps were seen, and on the pulse, `φ_k(x) = e^{−x} (L_{k−1}(x) − L_k(x))`, 6.
//!
//! Proven are the pieces: the delays (`T − kD` to `2^−103`), the range in which nothing overflows, and
//! what the cut of the exponential series leaves. The laws of the sums are measured.

mod blocked;
mod delay;
mod description;
mod error;
mod expansion;
mod exponential;
mod naive;
mod stable;
mod sum;

pub use description::{Echoes, ExponentialPolynomial, Family, Term};
pub use error::EchoError;
pub use expansion::Expansion;
pub use sum::{EchoSum, Method};

/// The last echo that a sum may hold.
const LARGEST_ECHO: usize = 1 << 20;

/// The largest lag of a term, in either direction.
const LARGEST_LAG: usize = 1024;
