//! Quantities: exact values with their dimensions.

use crate::expression::Fraction;
use crate::scene::Dimension;

/// An exact value in metres, kilograms and seconds. It may hold the scene's symbols, and `pi`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Quantity {
    /// The value in SI units.
    pub value: Fraction,
    /// Its dimension; [`Dimension::NONE`] in scenes without units.
    pub dimension: Dimension,
}
