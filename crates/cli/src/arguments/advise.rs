//! Arguments of `advise`.

use super::{Format, Scene, named};
use clap::{Args, ValueHint};
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep advise mass-on-fixed-bar --set mu=1/10 --quantity velocity --tol 1e-1 --to 1\n  \
    wavestep advise pile --quantity head --tol 1e-2 -o reduced.wave\n  \
    wavestep advise mass-on-fixed-bar --quantity velocity --for mu=1/10..10 --to 2 -o map.svg\n\n\
    Models are tried from cheap to expensive: rigid bars, bars as springs with a share of their mass,\n\
    the scene without unneeded elements, the first echoes, modes of vibration; then the exact solution.\n\
    That a model meets the tolerance is proven in the whole window. A model that misses it is listed\n\
    with a time at which it does.\n\
    With --for, the largest difference of each model is proven at several values of the symbol, and\n\
    boundaries between models are found by bisection. -o draws the map: .svg, .pdf, .png, .json, .csv.")]
pub struct Advise {
    #[command(flatten)]
    pub scene: Scene,
    /// The observable [default: the first]
    #[arg(long, value_name = "NAME")]
    pub quantity: Option<String>,
    /// The tolerance, relative to the largest value
    #[arg(long, value_name = "TOL", default_value = "1e-2", allow_hyphen_values = true)]
    pub tol: String,
    /// The first time of the window
    #[arg(long, value_name = "T", default_value = "0", allow_hyphen_values = true)]
    pub from: String,
    /// The last time of the window [default: four periods, or twice the way along the line]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// Also show the computing time per value
    #[arg(long)]
    pub stats: bool,
    /// Map which model is enough over a range of this symbol: mu=1/10..10
    #[arg(long = "for", value_name = "NAME=A..B", conflicts_with = "stats")]
    pub over: Option<String>,
    /// With --for: these models, from cheap to expensive [default: whole scenes, single changes, echoes, modes]
    #[arg(long, value_name = "WHAT", num_args = 1.., requires = "over")]
    pub models: Vec<String>,
    /// With --for: the number of values at which differences are proven
    #[arg(long, value_name = "N", default_value_t = 13, requires = "over",
          value_parser = clap::value_parser!(u16).range(2..=200))]
    pub points: u16,
    /// Write the smallest scene that is enough to this file; with --for, the map
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<PathBuf>,
    /// The format of the output
    #[arg(long, value_parser = named([
        ("text", Format::Text, "A table with its conclusion"),
        ("json", Format::Json, "All models that were tried; with --for, at all values, and the ranges"),
        ("csv", Format::Csv, "One row per model that was tried; with --for, per value and model"),
    ]), default_value = "text")]
    pub format: Format,
}
