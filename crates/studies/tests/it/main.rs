//! What stands on wavestep: equations, figures, charts, dispersion, local contact.

mod book;
mod dispersion;
mod figures;
mod hertz;
mod picture;
mod study;

/// The repository.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
