//! Arguments of `report`.

use super::Scene;
use clap::{Args, ValueHint};

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep report hopkinson -o report.html\n  \
    wavestep report rigid-mass --set mu=1/4 --to 12 -o -\n\n\
The page is one self-contained file: the line to scale, the recurrence and its first pieces, events,\n\
interactive plots of observables and fields, largest and smallest values.\n\
The same scene gives the same bytes.")]
pub struct Report {
    #[command(flatten)]
    pub scene: Scene,
    /// The last time of plots, events and extrema [default: that of `plot`; for events, until
    /// nothing can meet again]
    #[arg(long, alias = "until", value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// The HTML file to write; - for standard output
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: String,
}
