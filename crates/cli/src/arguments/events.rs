//! Arguments of `events`.

use super::Scene;
use clap::{Args, ValueEnum};

/// Options of `events`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep events saint-venant --set mu=1\n  \
    wavestep events bars-of-equal-length --format json\n  \
    wavestep events hopkinson-with-release --until 2ms --digits 9\n\n\
Contacts push and never pull: they open where they would, and close where bodies meet again.\n\
What cannot be decided is refused with exit code 3, never passed over.")]
pub struct Events {
    #[command(flatten)]
    pub scene: Scene,
    /// Follow the scene until this time [default: until nothing can meet again, at most for a hundred
    /// of the longest travel times]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub until: Option<String>,
    /// How many significant digits
    #[arg(long, value_name = "D", default_value_t = 12)]
    pub digits: usize,
    /// Written how
    #[arg(long, value_enum, default_value_t = EventsFormat::Text)]
    pub format: EventsFormat,
}

/// How events are written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum EventsFormat {
    /// A paragraph an event
    Text,
    /// Decimal strings with proven radii
    Json,
    /// A table
    Latex,
}
