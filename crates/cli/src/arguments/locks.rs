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
    /// Compare with what `wavestep lock` wrote to this file, with the values that stand there
    #[arg(long, value_name = "FILE", conflicts_with = "set", value_hint = ValueHint::FilePath)]
    pub locked: Option<String>,
    /// Say too what was found: symbols and conditions, equations, derivations, general forms
    #[arg(long, conflicts_with = "locked")]
    pub verbose: bool,
}

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep lock my.wave --through 4 -o my.lock\n  \
    wavestep lock rigid-mass --through 2 --set mu=1/4 --at 33/10,5\n  \
    wavestep lock saint-venant --set mu=1 --at 2 -o my.lock\n  \
    wavestep check my.wave --locked my.lock\n\n\
    The file holds what the scene states of its period, symbols and observables, the pieces of all\n\
    waves on the periods 0 … N, and at each time the values of all waves and observables, just\n\
    after arrivals. Of a scene whose contacts open it holds events instead of pieces, and values of\n\
    observables. A file that exists is replaced.")]
pub struct Lock {
    #[command(flatten)]
    pub scene: Scene,
    /// Lock the pieces on the periods 0 … N
    #[arg(long, value_name = "N")]
    pub through: Option<usize>,
    /// Lock the events until this scene time, where contacts open [default: as in `events`]
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
    /// How many significant digits values have
    #[arg(long, value_name = "D", default_value_t = 20)]
    pub digits: usize,
    #[command(flatten)]
    pub output: Output,
}
