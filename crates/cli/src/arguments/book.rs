//! Arguments of `book`.

use clap::{Args, ValueEnum};

/// Options of `book`.
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
    #[arg(long, value_enum, default_value_t = BookFormat::Text)]
    pub format: BookFormat,
}

/// How equations of the source are written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum BookFormat {
    /// Plain text
    Text,
    /// LaTeX with amsmath
    Latex,
    /// With verdict, derived form and steps
    Json,
    /// The page docs/equations.md
    Markdown,
}
