//! The library, a module a capability.

mod answers;
mod ball;
mod derivations;
mod differences;
mod enclosure;
mod energies;
mod entering_waves;
mod errors;
mod evaluate;
mod examples;
mod explained;
mod export;
mod expression;
mod facade;
mod field;
mod find;
mod formulas;
mod gaps;
mod general;
mod hertz_element;
mod history;
mod language;
mod largest_over_symbol;
mod layering;
mod local_contacts;
mod lock;
mod measures;
mod methods;
mod models;
mod opening_over_symbol;
mod over_symbol;
mod phases_fields;
mod products;
mod rise;
mod root_formulas;
mod roots;
mod scene_language;
mod scenes;
mod signal;
mod silence;
mod simpler;
mod source;
mod source_form;
mod support;
mod trials;
mod turns;
mod zeros;

use support::snapshot::snapshot;

/// The repository.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
