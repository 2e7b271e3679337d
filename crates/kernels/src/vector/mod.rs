//! Evaluation with vectors of doubles.
//!
//! One generic program serves all levels: it is written in the operations of [`Simd`], of which there
//! is one implementation a level, or in [`Lanes`](crate::lanes::Lanes), eight doubles whatever the level.
//! Instructions, and all unsafe code of the crate, are in `instructions`.

mod blocks;
mod eight;
mod horner;
mod instructions;
#[cfg(any(test, not(target_arch = "x86_64")))]
mod scalar;
mod simd;
mod work;

pub(crate) use blocks::{Found, Many};
#[cfg(any(test, target_arch = "aarch64"))]
use eight::Eight;
pub(crate) use horner::{Certified, Evaluate, Plain};
pub(crate) use instructions::dispatch;
#[cfg(any(test, target_arch = "aarch64"))]
use scalar::Scalar;
pub(crate) use simd::{Simd, Task};
#[cfg(test)]
pub(crate) use work::{OneByOne, each_way};
pub(crate) use work::{Work, widest};
