#![doc = include_str!("../README.md")]

mod alignment;
mod binomial;
mod calculus;
mod decimal;
mod division;
mod factor;
mod integer;
#[doc(hidden)]
pub mod limbs;
mod ordinary;
mod polynomial;
mod product;
mod query;
mod reduction;
mod root;
mod row;
mod substitution;
mod sum;
mod symbol;
mod term;
mod text;
mod univariate;

pub use binomial::{binomial, factorial};
pub use decimal::decimal;
pub use integer::fraction;
pub use num_bigint::BigInt as Integer;
pub use num_rational::BigRational as Rational;
pub use ordinary::Ordinary;
pub use polynomial::Polynomial;
#[doc(hidden)]
pub use product::power;
pub use row::{IntegerRef, IntegerRow};
pub use symbol::Symbol;
pub use univariate::Univariate;
