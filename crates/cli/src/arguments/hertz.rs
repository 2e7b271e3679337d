//! Arguments of `hertz`.

use super::{Format, Output, Scene, named};
use clap::Args;

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep hertz local-contact\n  \
    wavestep hertz hertz-striker --rise 1/2,9/10 --at 20us --digits 9\n\n\
The bars are assumed to be long. The output says until when this holds, before a wave returns from\n\
a far end.")]
pub struct Hertz {
    #[command(flatten)]
    pub scene: Scene,
    /// Rise times to these fractions of the largest force, separated by commas
    #[arg(
        long,
        value_name = "SHARE",
        value_delimiter = ',',
        default_value = "1/10,1/2,9/10",
        allow_hyphen_values = true
    )]
    pub rise: Vec<String>,
    /// The force at these times, separated by commas
    #[arg(long, value_name = "T", value_delimiter = ',', allow_hyphen_values = true)]
    pub at: Vec<String>,
    /// Number of significant digits
    #[arg(long, value_name = "D", default_value_t = 12)]
    pub digits: usize,
    /// The output format
    #[arg(long, default_value = "text", value_parser = named([
        ("text", Format::Text, "One line per value"),
        ("json", Format::Json, "Decimal strings"),
        ("csv", Format::Csv, "One row per value"),
    ]))]
    pub format: Format,
    #[command(flatten)]
    pub output: Output,
}
