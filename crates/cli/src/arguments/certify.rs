//! Arguments of `certify`.

use super::{Output, Scene};
use clap::Args;

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep certify rigid-mass --through 8 -o rigid-mass.json\n  \
    wavestep certify rigid-mass --set mu=1/4 --quantity velocity --at 33/10 --digits 30 -o value.json\n  \
    python3 checkers/check.py rigid-mass.json value.json\n\n\
A certificate holds what is claimed with all that a reader needs to verify it, without this program.")]
pub struct Certify {
    #[command(flatten)]
    pub scene: Scene,
    /// Certify the pieces of all waves on the periods 0 … N [default: 3, or as far as --at needs]
    #[arg(long, value_name = "N", conflicts_with = "at")]
    pub through: Option<usize>,
    /// Certify the value of this wave or observable
    #[arg(long, value_name = "NAME", requires = "at")]
    pub quantity: Option<String>,
    /// At this scene time
    #[arg(long, value_name = "T", allow_hyphen_values = true, requires = "quantity")]
    pub at: Option<String>,
    /// How many significant digits
    #[arg(long, value_name = "D", default_value_t = 15, requires = "at")]
    pub digits: usize,
    #[command(flatten)]
    pub output: Output,
}
