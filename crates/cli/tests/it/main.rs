//! The built command.

mod answer;
mod book;
mod chart;
mod command;
mod dispersion;
mod documents;
mod events;
mod find;
mod local_contact;
mod lock;
mod messages;
mod open_contacts;
mod picture;
mod scene;
mod typeset;
mod validity;

/// The repository.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
