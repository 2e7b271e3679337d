//! Arguments of `check` and `lock`.

use super::{Output, Scene};
use clap::{Args, ValueHint};

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep check my.wave\n  \
    wavestep check rigid-mass\n  \
    wavestep check my.wave --locked my.lock")]
pub struct Check {
    #[command(flatten)]
    pub scene: Scene,
    /// Compare with this file written by `wavestep lock`, using the values given in it
    #[arg(long, value_name = "FILE", conflicts_with = "set", value_hint = ValueHint::FilePath)]
    pub locked: Option<String>,
    /// Also print symbols and conditions, equations, derivations and general forms
    #[arg(long, conflicts_with = "locked")]
    pub verbose: bool,
}

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep lock my.wave --through 4 -o my.lock\n  \
    wavestep lock rigid-mass --through 2 --set mu=1/4 --at 33/10,5\n  \
    wavestep lock saint-venant --set mu=1 --at 2 -o my.lock\n  \
    wavestep check my.wave --locked my.lock\n\n\
    The file contains the period, symbols and observables of the scene, the pieces of all waves in the\n\
    periods 0 … N, and the values of all waves and observables at each time, just after arrivals. If\n\
    contacts open, it contains events instead of pieces, and values of observables only. An existing\n\
    file is replaced.")]
pub struct Lock {
    #[command(flatten)]
    pub scene: Scene,
    /// Lock the pieces in the periods 0 … N
    #[arg(long, value_name = "N")]
    pub through: Option<usize>,
    /// Lock the events until this scene time, if contacts open [default: as in `events`]
    #[arg(
        long,
        alias = "until",
        value_name = "T",
        allow_hyphen_values = true,
        conflicts_with = "through"
    )]
    pub to: Option<String>,
    /// Lock values at these scene times, separated by commas
    #[arg(long, value_name = "T", value_delimiter = ',', allow_hyphen_values = true)]
    pub at: Vec<String>,
    /// Number of significant digits
    #[arg(long, value_name = "D", default_value_t = 20)]
    pub digits: usize,
    #[command(flatten)]
    pub output: Output,
}
