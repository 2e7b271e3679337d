//! Enclosures of exact expressions and of zeros.

mod expression;
mod numbers;
mod zero;
