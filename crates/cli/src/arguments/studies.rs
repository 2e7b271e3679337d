//! Arguments of `book`, `report`, `hertz`, `dispersion` and `events`.

use super::{Format, Output, Scene, named};
use clap::{Args, ValueHint};

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep book\n  \
    wavestep book 6.75\n  \
    wavestep book 6.80 --format latex\n\n\
    The source is Harrison and Nettleton, Advanced Engineering Dynamics, sections 6.6 to 6.11. Every\n\
    equation is compared with the one derived from its scene.")]
pub struct Book {
    /// Show the equation with this number: as printed, as derived, and the proof
    pub number: Option<String>,
    /// The output format
    #[arg(long, default_value = "text", value_parser = named([
        ("text", Format::Text, "Plain text"),
        ("latex", Format::Latex, "LaTeX with amsmath"),
        ("json", Format::Json, "With verdict, derived form and steps"),
        ("markdown", Format::Markdown, "The page docs/equations.md"),
    ]))]
    pub format: Format,
    #[command(flatten)]
    pub output: Output,
}

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep report hopkinson -o report.html\n  \
    wavestep report rigid-mass --set mu=1/4 --to 12 -o -\n\n\
The page is one self-contained file: the line to scale, the recurrence and its first pieces, events,\n\
interactive plots of observables and fields, largest and smallest values.\n\
The same scene gives the same bytes.")]
pub struct Report {
    #[command(flatten)]
    pub scene: Scene,
    /// The last time of plots, events and extrema [default: that of `plot`; for events, until
    /// nothing can meet again]
    #[arg(long, alias = "until", value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// The HTML file to write; - for standard output
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: String,
}

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
