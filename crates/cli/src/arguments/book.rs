//! Arguments of `book`.

use super::{Format, Output, named};
use clap::Args;

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep book\n  \
    wavestep book 6.75\n  \
    wavestep book 6.80 --format latex\n\n\
    The source is Harrison and Nettleton, Advanced Engineering Dynamics, sections 6.6 to 6.11. Every\n\
    equation is compared with the one derived from its scene.")]
pub struct Book {
    /// Show the equation with this number: as printed, as derived, and the proof
    pub number: Option<String>,
    /// The output format
    #[arg(long, default_value = "text", value_parser = named([
        ("text", Format::Text, "Plain text"),
        ("latex", Format::Latex, "LaTeX with amsmath"),
        ("json", Format::Json, "With verdict, derived form and steps"),
        ("markdown", Format::Markdown, "The page docs/equations.md"),
    ]))]
    pub format: Format,
    #[command(flatten)]
    pub output: Output,
}
