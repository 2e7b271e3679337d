//! Arguments of `advise`.

use super::{Format, Scene, named};
use clap::{Args, ValueHint};
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep advise mass-on-fixed-bar --set mu=1/10 --quantity velocity --tol 1e-1 --to 1\n  \
    wavestep advise pile --quantity head --tol 1e-2 -o reduced.wave\n  \
    wavestep advise mass-on-fixed-bar --quantity velocity --for mu=1/10..10 --to 2 -o map.svg\n\n\
    Tried from cheap to dear: bars that do not yield, bars as springs with a third or another share of\n\
    their mass, the scene less every element it does not need, the first arrivals, modes of vibration;\n\
    then the exact answer. What is enough is proven on the whole window. What misses has a time at which\n\
    that is seen.\n\
    With --for, the largest difference of each simpler answer is proven at some values of the symbol.\n\
    Borders between what is enough are found by halving. -o draws the map (.svg, .pdf, .png, .json or .csv).")]
pub struct Advise {
    #[command(flatten)]
    pub scene: Scene,
    /// The observable that is asked for [default: the first]
    #[arg(long, value_name = "NAME")]
    pub quantity: Option<String>,
    /// How far off it may be, over its largest value
    #[arg(long, value_name = "TOL", default_value = "1e-2")]
    pub tol: String,
    /// The first time of the window
    #[arg(long, value_name = "T", default_value = "0", allow_hyphen_values = true)]
    pub from: String,
    /// The last time of the window [default: four periods, or twice the way along the line]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// Also show the time per value
    #[arg(long)]
    pub stats: bool,
    /// Which answer is enough where, over this symbol from one value to another: mu=1/10..10
    #[arg(long = "for", value_name = "NAME=A..B", conflicts_with_all = ["stats", "format"])]
    pub over: Option<String>,
    /// With --for: these simpler answers, from cheap to dear [default: whole scenes, one change alone, arrivals,
    /// modes]
    #[arg(long, value_name = "WHAT", num_args = 1.., requires = "over")]
    pub models: Vec<String>,
    /// With --for: at how many values differences are proven
    #[arg(long, value_name = "N", default_value_t = 13, requires = "over",
          value_parser = clap::value_parser!(u16).range(2..=200))]
    pub points: u16,
    /// Write the smallest scene that is enough into this file; with --for, the map
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<PathBuf>,
    /// The format of the output
    #[arg(long, value_parser = named([
        ("text", Format::Text, "A table, and what follows from it"),
        ("json", Format::Json, "All that was tried"),
    ]), default_value = "text")]
    pub format: Format,
}
