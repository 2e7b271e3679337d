//! The library, a module a capability.

mod answers;
mod derivations;
mod energies;
mod evaluate;
mod examples;
mod expression;
mod facade;
mod field;
mod find;
mod formulas;
mod general;
mod hertz_element;
mod history;
mod language;
mod layering;
mod lock;
mod methods;
mod models;
mod phases_fields;
mod root_formulas;
mod roots;
mod scene_language;
mod scenes;
mod signal;
mod source;
mod source_form;
mod support;

/// Compares a text with what is recorded; `asked` is the text or the call that it came from.
fn snapshot(folder: &str, name: &str, asked: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(format!("{}/snapshots/{folder}", env!("CARGO_MANIFEST_DIR")));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_description(asked);
    settings.bind(|| insta::assert_snapshot!(name.to_owned(), text));
}
