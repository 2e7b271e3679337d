//! Exact values as numbers: enclosures of expressions, and of constants that have names.
//!
//! A named constant is no rational number; formulas hold its symbol, and here its definition is worked
//! out to any number of bits.

mod error;
mod expression;
mod numbers;
pub mod zero;

pub use error::EnclosureError;
pub use expression::enclose_expression;
pub(crate) use expression::real_part;
pub use numbers::Numbers;
pub(crate) use numbers::sorted;
pub use zero::enclose_zero;
