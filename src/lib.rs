//! Exact solutions of wave propagation in bars with lumped ends.
pub mod ball;
pub mod language;
