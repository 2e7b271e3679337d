//! Polynomials, a module a capability.

mod calculus;
mod division;
mod factors;
mod limbs;
mod ordinary;
mod ring;
mod roots;
mod support;
mod text;
mod univariate;
