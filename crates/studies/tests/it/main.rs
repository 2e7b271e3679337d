//! What stands on wavestep: equations, figures, charts, dispersion, local contact.

mod book;
mod charts;
mod dispersion;
mod estimates;
mod figures;
mod hertz;
mod picture;
mod saint_venant;
#[path = "../../../../tests/it/support/snapshot.rs"]
mod snapshot;
mod study;

use snapshot::snapshot;

/// The repository.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
