//! Charts, figures and diagrams.

mod marks;
mod plot;
#[path = "../../../../tests/it/support/snapshot.rs"]
mod snapshot;

/// The repository.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
