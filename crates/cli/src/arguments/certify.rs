//! Arguments of `certify`.

use super::{Output, Scene};
use clap::{ArgGroup, Args};

#[derive(Args)]
#[command(group = ArgGroup::new("goal").args(["max", "min", "zero", "distance"]),
          group = ArgGroup::new("window").args(["max", "min", "zero", "distance", "points", "events"]), after_help = "Examples:\n  \
    wavestep certify rigid-mass --through 8 -o rigid-mass.json\n  \
    wavestep certify rigid-mass --general -o general.json\n  \
    wavestep certify rigid-mass --set mu=1/4 --quantity velocity --at 33/10 --digits 30 -o value.json\n  \
    wavestep certify rigid-mass --set mu=1 --zero strain_impact --from 2 --to 4 -o roots.json\n  \
    wavestep certify mass-on-fixed-bar --set mu=1/4 --max strain_fixed --to 6 -o largest.json\n  \
    wavestep certify rigid-mass --set mu=1 --quantity velocity --to 6 --points 100 --method compiled -o doubles.json\n  \
    wavestep certify mass-on-fixed-bar --set mu=1/10 --distance velocity --minus third --to 1 -o third.json\n  \
    wavestep certify saint-venant --set mu=1 --events --to 10 -o events.json\n  \
    python3 checkers/check.py rigid-mass.json general.json value.json roots.json largest.json doubles.json third.json events.json\n\n\
A certificate holds what is claimed with all that a reader needs to verify it, without this program.")]
pub struct Certify {
    #[command(flatten)]
    pub scene: Scene,
    /// Certify the pieces of all waves on the periods 0 … N [default: 3, or as far as --at needs]
    #[arg(long, value_name = "N", conflicts_with_all = ["at", "window"])]
    pub through: Option<usize>,
    /// Certify a formula for every n of all waves
    #[arg(long, conflicts_with_all = ["through", "at", "window", "digits"])]
    pub general: bool,
    /// Certify when contacts open and close, and that nothing else happens to them
    #[arg(long, conflicts_with_all = ["through", "general", "quantity", "goal", "minus", "at", "points", "method", "tol"])]
    pub events: bool,
    /// Certify the value of this wave or observable, at one time or in doubles at many
    #[arg(long, value_name = "NAME", conflicts_with = "goal")]
    pub quantity: Option<String>,
    /// At this scene time
    #[arg(long, value_name = "T", allow_hyphen_values = true, requires = "quantity")]
    pub at: Option<String>,
    /// Certify doubles at so many evenly spaced times of a window, with the bound on their errors
    #[arg(long, value_name = "N", requires = "quantity", conflicts_with_all = ["at", "digits"])]
    pub points: Option<usize>,
    /// Doubles within this tolerance, by the cheapest method [default: the nearest doubles]
    #[arg(long, value_name = "TOL", requires = "points")]
    pub tol: Option<String>,
    /// Doubles by this method, which must have a proven bound
    #[arg(long, value_name = "NAME", requires = "points", conflicts_with = "tol")]
    pub method: Option<String>,
    /// Certify the largest value of this wave or observable
    #[arg(long, value_name = "QUANTITY")]
    pub max: Option<String>,
    /// Certify the smallest value
    #[arg(long, value_name = "QUANTITY")]
    pub min: Option<String>,
    /// Certify all times at which it is zero, and that there are no others
    #[arg(long, value_name = "QUANTITY")]
    pub zero: Option<String>,
    /// Certify the largest difference from --minus
    #[arg(long, value_name = "QUANTITY", requires = "minus")]
    pub distance: Option<String>,
    /// Subtract the same quantity in another scene, or in this scene simplified, as in `find`: `rigid`, `third`,
    /// `rigid:BAR`, `spring:BAR`, `without:ELEMENT`, `endless:BAR.right`, several of these joined by `+`
    #[arg(long, value_name = "WHAT", requires = "goal")]
    pub minus: Option<String>,
    /// The first time of the window
    #[arg(
        long,
        value_name = "T",
        default_value = "0",
        allow_hyphen_values = true,
        requires = "window"
    )]
    pub from: String,
    /// The last time of the window [default: four periods, or twice the way along the line]
    #[arg(long, value_name = "T", allow_hyphen_values = true, requires = "window")]
    pub to: Option<String>,
    /// How many significant digits
    #[arg(long, value_name = "D", default_value_t = 15, conflicts_with = "through")]
    pub digits: usize,
    #[command(flatten)]
    pub output: Output,
}
