//! Arguments of `eval`.

use super::{Format, Output, Scene, limits, value_formats};
use clap::{Args, ValueHint};
use wavestep::limits::VALUE_BITS;
use wavestep::signal::Limit;

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep eval rigid-mass --set mu=1/4 --quantity f --at 33/10 --digits 30\n  \
    wavestep eval hopkinson --at 100us,200us\n  \
    wavestep eval rigid-mass --set mu=1 --quantity strain_fixed --from 0 --to 6 --points 13\n  \
    wavestep eval rigid-mass --set mu=1 --quantity velocity --at 2 --side left\n  \
    wavestep eval rigid-mass --set mu=1 --quantity f --piece 2 --local 1/2 --format json\n  \
    wavestep eval rigid-mass --set mu=1 --quantity f --from 0 --to 80 --points 9 --tol 1e-9 --explain\n  \
    wavestep eval mass-on-fixed-bar --set mu=1 --quantity velocity --at 3 --method modes:100 --tol 1e-3\n\n\
    Times and values are exact: 33/10, 12.34, 1e3. Rational values are printed exactly if they\n\
    fit into the requested digits; all others are rounded correctly, ties to even.")]
pub struct Eval {
    #[command(flatten)]
    pub scene: Scene,
    /// Waves and observables, separated by commas [default: all observables]
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub quantity: Vec<String>,
    /// Scene times, separated by commas
    #[arg(long, value_name = "T", value_delimiter = ',', allow_hyphen_values = true,
          conflicts_with_all = ["from", "to", "points", "step", "piece", "local"])]
    pub at: Vec<String>,
    /// First of evenly spaced times
    #[arg(long, value_name = "T", allow_hyphen_values = true, requires_all = ["to", "spacing"])]
    pub from: Option<String>,
    /// Last of evenly spaced times
    #[arg(long, value_name = "T", allow_hyphen_values = true, requires_all = ["from", "spacing"])]
    pub to: Option<String>,
    /// Number of evenly spaced times
    #[arg(long, value_name = "N", requires_all = ["from", "to"], group = "spacing")]
    pub points: Option<usize>,
    /// The time from each of evenly spaced times to the next
    #[arg(long, value_name = "DT", requires_all = ["from", "to"], group = "spacing",
          allow_hyphen_values = true)]
    pub step: Option<String>,
    /// In this period of the quantity, at the local time given by --local
    #[arg(long, value_name = "N", requires = "local", conflicts_with_all = ["from", "to", "points", "step"])]
    pub piece: Option<usize>,
    /// Local time in the period given by --piece
    #[arg(long, value_name = "S", allow_hyphen_values = true, requires = "piece")]
    pub local: Option<String>,
    /// Number of significant digits
    #[arg(long, value_name = "D", default_value_t = 15)]
    pub digits: usize,
    /// Which limit to take at the arrival of an echo
    #[arg(long, value_parser = limits("From earlier times", "From later times"), default_value = "right")]
    pub side: Limit,
    /// Report on standard error how many of the arriving echoes were computed, and with --tol how many are needed
    #[arg(long)]
    pub stats: bool,
    /// The largest working precision, in bits
    #[arg(long, value_name = "BITS", default_value_t = VALUE_BITS)]
    pub max_bits: u64,
    /// Doubles by the cheapest method with a proven error of at most TOL: 1e-9 of the largest value,
    /// abs:1e-9 in the unit of the quantity, ulp:4 units in the last place of the largest value
    #[arg(long, value_name = "TOL", conflicts_with_all = ["digits", "max_bits", "piece"])]
    pub tol: Option<String>,
    /// Choose the method for --tol by the costs in this file, written by `wavestep chart --costs -o FILE`
    #[arg(long, value_name = "FILE", requires = "tol", value_hint = ValueHint::FilePath)]
    pub costs: Option<String>,
    /// Doubles by this method or model: certified, compiled, marched, marched-unproven, stable,
    /// double-double, plain, expanded; rigid, third, modes[:N], leapfrog[:CELLS[,CFL]], steps[:TOL]
    #[arg(long, value_name = "NAME", conflicts_with_all = ["digits", "stats", "max_bits", "piece"])]
    pub method: Option<String>,
    /// Report on standard error how values are computed, at what cost, and what is proven
    #[arg(long)]
    pub explain: bool,
    /// The output format
    #[arg(long, value_parser = value_formats(), default_value = "text")]
    pub format: Format,
    #[command(flatten)]
    pub output: Output,
}
