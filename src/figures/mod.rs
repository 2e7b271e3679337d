//! What the source's figures show, computed from the derived forms.

mod largest_strain;

pub use largest_strain::LargestStrain;
