//! What every chart can do.

use serde_json::Value;

/// A chart: data that can be drawn, and written for other programs.
///
/// Equal charts give equal bytes.
pub trait Chart {
    fn title(&self) -> &str;

    /// The picture as SVG, 900 pixels wide, in a document of its own.
    fn svg(&self) -> String {
        self.svg_named("chart")
    }

    /// The picture as SVG, whose identifiers begin with `name`: within one document, each picture
    /// takes another name. Characters other than letters, digits and hyphens become hyphens.
    fn svg_named(&self, name: &str) -> String;

    /// The data with the caption as JSON. Values that JSON cannot hold are the texts `"inf"`,
    /// `"-inf"` and `"not a number"`; what is missing is `null`.
    fn json(&self) -> Value;

    /// The data as comma-separated values (RFC 4180, lines end in `\n`), with a line of names
    /// first. Doubles read back as the same doubles.
    fn csv(&self) -> String;
}
