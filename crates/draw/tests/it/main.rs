//! Charts, figures and diagrams.

mod marks;
mod plot;
