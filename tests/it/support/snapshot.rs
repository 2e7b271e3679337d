//! Texts held against what is recorded in `snapshots`; the tests of all crates share this file.

/// Compares a text with what is recorded; `asked` is the command, the text or the call that it came from.
pub fn snapshot(folder: &str, name: &str, asked: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(format!("{}/snapshots/{folder}", crate::ROOT));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_description(asked);
    settings.bind(|| insta::assert_snapshot!(name.to_owned(), text));
}
