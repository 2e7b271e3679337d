//! Arguments of `events`.

use super::{Format, Output, Scene, named};
use clap::Args;

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep events saint-venant --set mu=1\n  \
    wavestep events bars-of-equal-length --format json\n  \
    wavestep events hopkinson-with-release --to 2ms --digits 9\n\n\
Contacts carry compression only: they open when they would go into tension, and close when bodies\n\
meet again. No event is missed. A case that no precision can decide is treated as a tie and reported\n\
as an assumption; one that higher precision might decide ends with exit code 3.")]
pub struct Events {
    #[command(flatten)]
    pub scene: Scene,
    /// Follow the scene until this time [default: until nothing can meet again, but at most a hundred
    /// times the longest travel time, or ten times with a local contact; fewer where there are very
    /// many echoes]
    #[arg(long, alias = "until", value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// Number of significant digits
    #[arg(long, value_name = "D", default_value_t = 12)]
    pub digits: usize,
    /// Report on standard error how events were found, at what cost, and what is proven
    #[arg(long)]
    pub explain: bool,
    /// The output format
    #[arg(long, default_value = "text", value_parser = named([
        ("text", Format::Text, "One paragraph per event"),
        ("json", Format::Json, "Decimal strings with proven radii"),
        ("csv", Format::Csv, "One row per event, with the same fields"),
        ("latex", Format::Latex, "A table"),
    ]))]
    pub format: Format,
    #[command(flatten)]
    pub output: Output,
}
