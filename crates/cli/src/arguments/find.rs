//! Arguments of `find`.

use super::{Format, Output, Scene, value_formats};
use clap::{ArgGroup, Args};
use wavestep::limits::SEARCH_BITS;
use wavestep::signal::Goal;

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
    stays undecided. A level is in the unit of the quantity, or has a unit of its own.")]
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
