//! Exact polynomials over the rationals, for code that differentiates, integrates and shifts them.
//!
//! [`Polynomial`] is sparse, in any number of named symbols; [`Univariate`] is dense, in one
//! variable. Both keep integer coefficients of *divided powers* `x^j/j!` over one shared
//! denominator. In that basis the derivative and the antiderivative move coefficients without
//! changing them, and a Taylor shift by a symbol makes no fractions; products pay with a binomial
//! coefficient.
//! Reduced rationals appear at the edge: in coefficients asked for, in printing, in evaluation.
//!
//! Every value has one representation, so `==` is equality of polynomials.
//!
//! ```
//! use wavestep_polynomial::{Polynomial, Symbol};
//! let x = Symbol::new("x").unwrap();
//! let p: Polynomial = "x^2*y - 1/3".parse().unwrap();
//! assert_eq!(p.antiderivative(&x).to_string(), "1/3*x^3*y - 1/3*x");
//! assert_eq!(p.antiderivative(&x).derivative(&x), p);
//! ```

mod alignment;
mod binomial;
mod calculus;
mod division;
mod integer;
mod polynomial;
mod product;
mod query;
mod substitution;
mod sum;
mod symbol;
mod text;
mod univariate;

pub use binomial::{binomial, factorial};
pub use num_bigint::BigInt as Integer;
pub use num_rational::BigRational as Rational;
pub use polynomial::Polynomial;
pub use symbol::Symbol;
pub use text::{Expected, ReadError};
pub use univariate::Univariate;
