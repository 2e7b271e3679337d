//! Arguments of `advise`.

use super::{Format, Scene, named};
use clap::{Args, ValueHint};
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep advise mass-on-fixed-bar --set mu=1/10 --quantity velocity --tol 1e-1 --to 1\n  \
    wavestep advise pile --quantity head --tol 1e-2 -o reduced.wave\n\n\
    Tried from cheap to dear: bars that do not yield, bars as springs with a third or another share of\n\
    their mass, the scene less every element it does not need, the first arrivals, modes of vibration;\n\
    then the exact answer. What is enough is proven on the whole window; what is not has a time at which\n\
    it is seen.")]
pub struct Advise {
    #[command(flatten)]
    pub scene: Scene,
    /// The observable that is asked for [default: the first]
    #[arg(long, value_name = "NAME")]
    pub quantity: Option<String>,
    /// How far off it may be, over its largest value
    #[arg(long, value_name = "SHARE", default_value = "1e-2")]
    pub tol: String,
    /// The first time of the window
    #[arg(long, value_name = "T", default_value = "0", allow_hyphen_values = true)]
    pub from: String,
    /// The last time of the window [default: four periods, or twice the way along the line]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// Tell how long a value of each took, too
    #[arg(long)]
    pub stats: bool,
    /// Write the smallest scene that is enough into this file
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<PathBuf>,
    /// Written how
    #[arg(long, value_parser = named([
        ("text", Format::Text, "A table, and what follows from it"),
        ("json", Format::Json, "All that was tried"),
    ]), default_value = "text")]
    pub format: Format,
}
