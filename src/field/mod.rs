//! Exact fields: velocity, strain, displacement and force along the bars of a scene at a time.
//!
//! In a bar, a wave to the right and one to the left pass every section unchanged, so the fields at a
//! time are what the two waves were a little earlier, at the ends. Programs that march through time on
//! a mesh can be checked against them: at nodes, and by averages over cells.
//!
//! Values come with proven bounds. At a front, where a field jumps, the side is stated.

mod characteristics;
mod error;
mod evaluator;
mod fields;
mod mesh;
mod profile;
pub mod wave;

pub use characteristics::{BarWaves, Front, Strip};
pub use error::FieldError;
pub use evaluator::FieldEvaluator;
pub use fields::{BarFields, Bounded, Fields, Quantity};
pub use mesh::{Mesh, Sampling};
pub use profile::Profile;

/// The precision tried first, and the highest.
const FIRST_BITS: u64 = 192;
const MAX_BITS: u64 = 1 << 14;
