//! Formulas as text: lines and oscillations.

mod lines;
mod oscillation;
