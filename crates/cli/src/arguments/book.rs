//! Arguments of `book`.

use super::{Format, Output, named};
use clap::Args;

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep book\n  \
    wavestep book 6.75\n  \
    wavestep book 6.80 --format latex\n\n\
    The source is Harrison and Nettleton, Advanced Engineering Dynamics, sections 6.6 to 6.11. Every\n\
    equation is held against what is derived from the scene it is about.")]
pub struct Book {
    /// Show the equation of this number: as read, as derived, and the proof
    pub number: Option<String>,
    /// Written how
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
