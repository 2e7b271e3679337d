//! Certified numbers.

mod binary;
mod complex;
mod decimal;
mod divided;
mod double;
mod enclosure;
mod exponential;
mod logarithm;
mod magnitude;
mod number;
mod operations;
mod precision;
mod products;
mod root;
mod samples;
mod trigonometry;
mod value;
