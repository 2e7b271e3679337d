//! Arguments of the commands that draw and give fields.

use super::{Format, Output, Scene, limits, named};
use clap::{Args, ValueHint};
use wavestep::field::Quantity;
use wavestep::signal::Limit;

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep chart rigid-mass --set mu=1 -o charts\n  \
    wavestep chart hopkinson --quantity gauge_output --to 2ms -o charts\n  \
    wavestep chart --costs -o costs.txt\n\n\
To draw a solution, use `plot`. Charts are written as SVG, JSON and CSV; index.html shows all.\n\
With one symbol set, there are also maps over order and symbol. Times are measured on this machine.\n\
--costs draws nothing: it measures the building blocks of the methods and compares them with the\n\
built-in table; `eval --costs FILE` reads the file that -o writes.")]
#[command(group = clap::ArgGroup::new("charted").args(["scene", "costs"]).required(true))]
pub struct Chart {
    #[command(flatten)]
    pub scene: Option<Scene>,
    /// Measure the costs by which `eval --tol` chooses a method
    #[arg(long, conflicts_with_all = ["scene", "set", "quantity", "from", "to", "points", "seed"])]
    pub costs: bool,
    /// A wave or an observable [default: the first observable]
    #[arg(long, value_name = "NAME")]
    pub quantity: Option<String>,
    /// The first time of the window
    #[arg(long, value_name = "T", default_value = "0", allow_hyphen_values = true)]
    pub from: String,
    /// The last time of the window [default: 40 periods]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// Number of times at which errors are measured
    #[arg(long, value_name = "N", default_value_t = 1000)]
    pub points: usize,
    /// The seed of the random times
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Fewer orders and runs, for a quick trial
    #[arg(long)]
    pub quick: bool,
    /// The output folder, created if missing; with --costs a file
    #[arg(short, long, value_name = "DIR", required_unless_present = "costs", value_hint = ValueHint::AnyPath)]
    pub output: Option<String>,
}

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep plot rigid-mass --set mu=1 --to 8 -o strain.svg\n  \
    wavestep plot hopkinson --diagram velocity --to 400us -o hopkinson.svg\n  \
    wavestep plot hopkinson --at 50us,100us,150us --quantity velocity,force -o fields.png\n\n\
The file extension chooses the format: .svg, .pdf, .png, or the numbers as .json or .csv.")]
pub struct Plot {
    #[command(flatten)]
    pub scene: Scene,
    /// Waves and observables, separated by commas [default: all observables]; with --at, some of
    /// velocity, strain, displacement and force [default: the first three]
    #[arg(long, value_name = "NAME", value_delimiter = ',', conflicts_with = "diagram")]
    pub quantity: Vec<String>,
    /// The first time of the window
    #[arg(long, value_name = "T", default_value = "0", allow_hyphen_values = true)]
    pub from: String,
    /// The last time of the window [default: four periods, or twice the way along the line]
    #[arg(long, alias = "until", value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// A diagram with position across, time upwards, and this quantity by colour
    #[arg(long, value_parser = named([
        ("velocity", Quantity::Velocity, "Positive to the right"),
        ("strain", Quantity::Strain, "Positive in tension"),
        ("force", Quantity::Force, "Positive in compression"),
    ]))]
    pub diagram: Option<Quantity>,
    /// Fields along the line at these times, separated by commas
    #[arg(long, alias = "at-time", value_name = "T", value_delimiter = ',', allow_hyphen_values = true,
          conflicts_with_all = ["diagram", "from", "to"])]
    pub at: Vec<String>,
    /// The title [default: that of the scene]; empty for none
    #[arg(long, value_name = "TEXT")]
    pub title: Option<String>,
    /// The width of a PNG in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1800)]
    pub width: u32,
    /// The file to write, or - for SVG on standard output
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: String,
}

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep field mass-on-fixed-bar --set mu=1 --at 5/2 --mesh 100\n  \
    wavestep field hopkinson --at 120us --mesh 200 --bar striker --averages --format json\n\n\
Each value is a double with a proven error bound. If a field jumps at a node, the value is the limit\n\
from the right, at the right end of a bar the limit from inside; --side left gives the left limit.")]
pub struct Field {
    #[command(flatten)]
    pub scene: Scene,
    /// The scene time
    #[arg(long, alias = "time", value_name = "T", allow_hyphen_values = true)]
    pub at: String,
    /// Number of cells per bar
    #[arg(long, value_name = "N", default_value_t = 100)]
    pub mesh: usize,
    /// Averages over cells instead of values at nodes
    #[arg(long)]
    pub averages: bool,
    /// Which limit to take if a field jumps at a node
    #[arg(long, value_parser = limits("From smaller x", "From larger x"), default_value = "right")]
    pub side: Limit,
    /// This bar only; may be repeated
    #[arg(long, value_name = "NAME", value_hint = ValueHint::Other)]
    pub bar: Vec<String>,
    /// Endless bars up to this distance from their end [default: as far as waves have come]
    #[arg(long, alias = "to", value_name = "X", allow_hyphen_values = true)]
    pub reach: Option<String>,
    /// The output format
    #[arg(long, default_value = "csv", value_parser = named([
        ("csv", Format::Csv, "One row per node or cell, with a header line"),
        ("json", Format::Json, "Lists of numbers for each bar"),
    ]))]
    pub format: Format,
    #[command(flatten)]
    pub output: Output,
}

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep figure\n  \
    wavestep figure 6.18 -o pulses.svg\n  \
    wavestep figure 6.22 -o strains.png --width 1200")]
pub struct Figure {
    /// The number of the figure; without one, all of them are listed
    #[arg(requires = "output")]
    pub number: Option<String>,
    /// The width of a PNG in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1800)]
    pub width: u32,
    /// The file to write: .svg, .pdf, .png, .json or .csv
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath, requires = "number")]
    pub output: Option<String>,
}
