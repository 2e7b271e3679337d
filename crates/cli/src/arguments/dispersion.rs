//! Arguments of `dispersion`.

use super::{Format, Output, named};
use clap::{Args, ValueHint};

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep dispersion lattice --wavenumber 1\n  \
    wavestep dispersion 'k*sqrt(1 + a*k^2)' --set a=1/12 --wavenumber 1/2 --digits 30\n  \
    wavestep dispersion cubic --pulse triangle\n  \
    wavestep dispersion cubic --length 10 --propagate 20\n  \
    wavestep dispersion lattice --pulse 'exp(-k^2)' --duration 8\n\n\
Named relations: string, lattice, cubic, stiff-string, beam, love. Parameters are positive numbers.\n\
A pulse includes wavenumbers up to 2 pi/length, or up to the root of omega(k) duration = 2 pi.")]
pub struct Dispersion {
    /// A formula in k, or the name of a relation
    pub relation: String,
    /// Replace a parameter by an exact value; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true,
          value_hint = ValueHint::Other)]
    pub set: Vec<String>,
    /// Values at these wavenumbers, separated by commas
    #[arg(long, alias = "at", value_name = "K", value_delimiter = ',', allow_hyphen_values = true)]
    pub wavenumber: Vec<String>,
    /// The pulse: square, triangle, gaussian, or its spectrum as a formula in k [default: square, if a
    /// length or a duration is given]
    #[arg(long, value_name = "PULSE", allow_hyphen_values = true)]
    pub pulse: Option<String>,
    /// The length of a pulse given in space
    #[arg(long, value_name = "B", allow_hyphen_values = true, conflicts_with = "duration")]
    pub length: Option<String>,
    /// The duration of a pulse given in time, at one place
    #[arg(long, value_name = "TAU", allow_hyphen_values = true)]
    pub duration: Option<String>,
    /// Propagate the pulse until this time, and print the speed of its peak
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub propagate: Option<String>,
    /// Number of grid points for --propagate
    #[arg(long, value_name = "N", requires = "propagate")]
    pub points: Option<usize>,
    /// Number of significant digits
    #[arg(long, value_name = "D", default_value_t = 15)]
    pub digits: usize,
    /// The largest working precision, in bits
    #[arg(long, value_name = "BITS", default_value_t = 1 << 12)]
    pub max_bits: u64,
    /// The output format
    #[arg(long, default_value = "text", value_parser = named([
        ("text", Format::Text, "Formulas that wavestep can read, and digits"),
        ("latex", Format::Latex, "An `align*` environment for amsmath"),
        ("json", Format::Json, "Formulas as text, decimal strings with proven radii"),
        ("csv", Format::Csv, "One row per wavenumber, or one for a pulse"),
    ]))]
    pub format: Format,
    #[command(flatten)]
    pub output: Output,
}
