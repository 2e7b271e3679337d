//! What stands on wavestep: equations, figures, charts, dispersion, local contact.

mod book;
mod charts;
mod dispersion;
mod figures;
mod hertz;
mod picture;
mod study;

/// The repository.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// Compares a text with what is recorded; `asked` is the text or the call that it came from.
fn snapshot(folder: &str, name: &str, asked: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(format!("{ROOT}/snapshots/{folder}"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_description(asked);
    settings.bind(|| insta::assert_snapshot!(name.to_owned(), text));
}
