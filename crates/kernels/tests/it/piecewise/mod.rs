//! Piecewise polynomials: values, certified values, refusals, and the arithmetic of pairs.

mod certified;
mod double_double;
mod refusals;
mod support;
mod values;
