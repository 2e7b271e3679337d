//! Arguments of `report`.

use super::Scene;
use clap::{Args, ValueHint};

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep report hopkinson -o report.html\n  \
    wavestep report rigid-mass --set mu=1/4 -o -\n\n\
The page is one self-contained file: the line to scale, the recurrence and its first pieces, events,\n\
interactive plots of observables and fields, largest and smallest values.\n\
The same scene gives the same bytes. The window is that of `plot`.")]
pub struct Report {
    #[command(flatten)]
    pub scene: Scene,
    /// The HTML file to write; - for standard output
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: String,
}
