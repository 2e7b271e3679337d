//! What every chart can do.

use super::Caption;
use serde_json::Value;

/// A chart: data that can be drawn, and written for other programs.
///
/// Equal charts give equal bytes.
///
/// ```
/// use wavestep_draw::{Axis, Caption, Chart, Curve, Curves};
///
/// let points = vec![(1.0, 1e-15), (10.0, 1e-9), (100.0, 0.5)];
/// let curve = Curve { name: "expanded form".into(), points };
/// let (order, error) = (Axis::linear("order n"), Axis::logarithmic("error"));
/// let chart = Curves::new("Error & order", order, error, vec![curve], Caption::default())?;
/// assert!(chart.svg().contains("Error &amp; order"));
/// assert_eq!(chart.json()["kind"], "curves");
/// assert_eq!(chart.csv().lines().nth(2), Some("expanded form,1e1,1e-9"));
/// assert!(chart.svg_named("second").contains("id=\"second-title\""));
/// # Ok::<(), wavestep_draw::PlotError>(())
/// ```
pub trait Chart {
    /// The title.
    fn title(&self) -> &str;

    /// What is said under the picture.
    fn caption(&self) -> &Caption;

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
