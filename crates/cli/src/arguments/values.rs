//! Arguments of `eval`, `find` and `export`.

use super::{Format, Output, Scene, limits, value_formats};
use clap::{ArgGroup, Args, ValueEnum, ValueHint};
use wavestep::limits::{SEARCH_BITS, VALUE_BITS};
use wavestep::signal::{Goal, Limit};

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

#[derive(Args)]
#[command(group = ArgGroup::new("goal").required(true).args(["max", "min", "zero", "level", "distance"]),
    after_help = "Examples:\n  \
    wavestep find rigid-mass --set mu=1 --zero strain_impact --from 2 --to 4\n  \
    wavestep find rigid-mass --set mu=1 --level velocity=1/2 --from 0 --to 6\n  \
    wavestep find hopkinson --max force --from 0 --to 350us --digits 9\n  \
    wavestep find mass-on-fixed-bar --set mu=1/10 --distance velocity --minus third --to 2\n  \
    wavestep find rigid-mass --min strain_fixed --equal mu=1/10..1 --between 3*mu,5*mu,7*mu\n\n\
    The window includes both ends. Every root is listed, with what is proven about it. An extremum may\n\
    be known to all digits even if its time is not. Exit code 3 if a root, or a digit of an extremum,\n\
    stays undecided. In a scene with units a level has one, as in force=10kN.")]
pub struct Find {
    #[command(flatten)]
    pub scene: Scene,
    /// The largest value of this wave or observable
    #[arg(long, value_name = "QUANTITY")]
    pub max: Option<String>,
    /// The smallest value
    #[arg(long, value_name = "QUANTITY")]
    pub min: Option<String>,
    /// All times at which it is zero
    #[arg(long, value_name = "QUANTITY")]
    pub zero: Option<String>,
    /// All times at which it has this value
    #[arg(long, value_name = "QUANTITY=VALUE", allow_hyphen_values = true)]
    pub level: Option<String>,
    /// The largest difference from --minus, also relative to the largest value; without a name, for all observables
    #[arg(long, value_name = "QUANTITY", requires = "minus", num_args = 0..=1, default_missing_value = "")]
    pub distance: Option<String>,
    /// Subtract the same quantity in another scene, or in this scene simplified: `rigid` (finite bars are rigid),
    /// `third` (bars are springs with a third of their mass), `rigid:BAR`, `spring:BAR`, `without:ELEMENT`,
    /// `endless:BAR.right`, `closed` (contacts stay closed), several of these joined by `+`; `modes:N`, `echoes:N`
    #[arg(long, value_name = "WHAT", conflicts_with = "equal")]
    pub minus: Option<String>,
    /// The first time of the window
    #[arg(long, value_name = "T", default_value = "0", allow_hyphen_values = true)]
    pub from: String,
    /// The last time of the window [default: four periods, or twice the way along the line]
    #[arg(long, alias = "until", value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// A value of this symbol, between two bounds, that makes the extrema in two windows equal
    #[arg(long, value_name = "SYMBOL=LOW..HIGH", requires = "between",
          conflicts_with_all = ["from", "to", "zero", "level"])]
    pub equal: Option<String>,
    /// The two windows for --equal, T1 <= t < T2 and T2 <= t < T3; times may contain its symbol
    #[arg(long, value_name = "T1,T2,T3", requires = "equal")]
    pub between: Option<String>,
    /// Number of significant digits
    #[arg(long, value_name = "D", default_value_t = 15)]
    pub digits: usize,
    /// The largest working precision, in bits
    #[arg(long, value_name = "BITS", default_value_t = SEARCH_BITS)]
    pub max_bits: u64,
    /// The output format
    #[arg(long, value_parser = value_formats(), default_value = "text")]
    pub format: Format,
    #[command(flatten)]
    pub output: Output,
}

impl Find {
    /// The extremum asked for, and of which quantity.
    pub fn extremum(&self) -> Option<(Goal, &str)> {
        let largest = self.max.as_ref().map(|name| (Goal::Largest, name.trim()));
        largest.or_else(|| Some((Goal::Smallest, self.min.as_ref()?.trim())))
    }
}

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep export rigid-mass --as c --set mu=1 --quantity f --to 40 -o f.c\n  \
    wavestep export hopkinson --as c --quantity gauge_output --to 2ms --tol 1e-6 -o gauge.c\n\n\
The file contains polynomials, the function `double wavestep_QUANTITY(double t)`, a function for\n\
many times, and the proven error bound.")]
pub struct Export {
    #[command(flatten)]
    pub scene: Scene,
    /// The programming language
    #[arg(long = "as", value_enum)]
    pub language: ExportLanguage,
    /// A wave or an observable
    #[arg(long, value_name = "NAME")]
    pub quantity: String,
    /// The first time of the window
    #[arg(long, value_name = "T", default_value = "0", allow_hyphen_values = true)]
    pub from: String,
    /// The last time of the window
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub to: String,
    /// The tolerance, as for eval [default: ulp:4]
    #[arg(long, value_name = "TOL")]
    pub tol: Option<String>,
    #[command(flatten)]
    pub output: Output,
}

/// What values on a window are written as.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ExportLanguage {
    /// A C function
    C,
}
