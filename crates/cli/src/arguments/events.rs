//! Arguments of `events`.

use super::{Format, Output, Scene, named};
use clap::Args;

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep events saint-venant --set mu=1\n  \
    wavestep events bars-of-equal-length --format json\n  \
    wavestep events hopkinson-with-release --to 2ms --digits 9\n\n\
Contacts push and never pull: they open where they would, and close where bodies meet again.\n\
What no precision decides is taken for a tie, and told as an assumption; what may still be decided is\n\
refused with exit code 3. Nothing is passed over.")]
pub struct Events {
    #[command(flatten)]
    pub scene: Scene,
    /// Follow the scene until this time [default: until nothing can meet again, at most for a hundred
    /// of the longest travel times, or ten beside a local contact]
    #[arg(long, alias = "until", value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// How many significant digits
    #[arg(long, value_name = "D", default_value_t = 12)]
    pub digits: usize,
    /// Say on standard error how events were found, at which cost, and how sure they are
    #[arg(long)]
    pub explain: bool,
    /// Written how
    #[arg(long, default_value = "text", value_parser = named([
        ("text", Format::Text, "A paragraph an event"),
        ("json", Format::Json, "Decimal strings with proven radii"),
        ("latex", Format::Latex, "A table"),
    ]))]
    pub format: Format,
    #[command(flatten)]
    pub output: Output,
}
