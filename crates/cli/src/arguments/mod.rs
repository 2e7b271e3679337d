//! The arguments of the command, with their help.

mod advise;
mod certify;
mod derive;
mod locks;
mod pictures;
mod studies;
mod sweep;
mod tools;
mod values;

pub use advise::Advise;
pub use certify::Certify;
pub use derive::Derive;
pub use locks::{Check, Lock};
pub use pictures::{Chart, Field, Figure, Plot};
pub use studies::{Book, Dispersion, Events, Hertz, Report};
pub use sweep::Sweep;
pub use tools::{Generate, Generated, Scenes};
pub use values::{Eval, Export, Find};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand as Subcommands, ValueHint};
use std::time::Duration;
use wavestep::signal::Limit;

/// How results are written. Each command takes some of these.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Format {
    Text,
    Latex,
    Json,
    Csv,
    Markdown,
}

/// One of several values: their names, and what they mean.
fn named<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [(&'static str, T, &'static str); N],
) -> impl TypedValueParser<Value = T> {
    let names = all.map(|(name, _, help)| PossibleValue::new(name).help(help));
    let value = move |name: String| all.iter().find(|one| one.0 == name).expect("one of them").1;
    PossibleValuesParser::new(names).map(value)
}

/// `left` and `right`, with what these limits mean.
fn limits(left: &'static str, right: &'static str) -> impl TypedValueParser<Value = Limit> {
    named([("left", Limit::Left, left), ("right", Limit::Right, right)])
}

/// Where a report goes.
#[derive(Args, Clone)]
pub struct Output {
    /// The output file [default: standard output, also for -]
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<String>,
}

fn value_formats() -> impl TypedValueParser<Value = Format> {
    named([
        ("text", Format::Text, "One line per time"),
        ("json", Format::Json, "Decimal strings with proven radii"),
        ("csv", Format::Csv, "Columns with a header line"),
    ])
}

/// Exact solutions of wave propagation in bars with lumped ends.
#[derive(Parser)]
#[command(
    name = "wavestep",
    version,
    about,
    after_help = "Examples:\n  \
        wavestep derive rigid-mass\n  \
        wavestep derive rigid-mass --quantity f --through 8 --format latex\n  \
        wavestep eval rigid-mass --set mu=1/4 --quantity f --at 33/10 --digits 30\n\n\
        Exit codes: 0 success, 1 computation failed or lock differs, 2 usage error or bad scene,\n\
        3 accuracy not reached."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub subcommand: Subcommand,
    /// Memory limit for waves, such as 500MB or 2GB [default: a quarter of the machine's memory]
    #[arg(long, global = true, value_name = "SIZE", value_parser = bytes, allow_hyphen_values = true, value_hint = ValueHint::Other)]
    pub memory: Option<u64>,
    /// Time limit, such as 15s or 10min [default: none]
    #[arg(long, global = true, value_name = "TIME", value_parser = duration, allow_hyphen_values = true, value_hint = ValueHint::Other)]
    pub time_limit: Option<Duration>,
    /// Vector instructions at most [default: the widest of this machine]; results are the same but for the last digit
    /// of doubles with a bound
    #[arg(long, global = true, hide = true, value_name = "SET", value_parser = ["baseline", "avx2", "avx512"])]
    pub instructions: Option<String>,
}

/// A duration with its unit.
fn duration(text: &str) -> Result<Duration, String> {
    match with_unit(text, &[("ms", 1e-3), ("min", 60.0), ("s", 1.0), ("h", 3600.0)]) {
        // More than a human life is no limit.
        Some(seconds) if seconds >= 0.1 => Ok(Duration::from_secs_f64(seconds.min(1e10))),
        _ => Err("give at least 0.1 s, with a unit, such as 15s or 10min".to_owned()),
    }
}

/// A number of bytes with its unit.
fn bytes(text: &str) -> Result<u64, String> {
    match with_unit(text, &[("TB", 1e12), ("GB", 1e9), ("MB", 1e6), ("kB", 1e3)]) {
        Some(bytes) if bytes >= 1e6 => Ok(bytes as u64),
        _ => Err("give at least 1 MB, with a unit, such as 500MB or 2GB".to_owned()),
    }
}

/// A number times the size of the unit behind it, where it is one of these.
fn with_unit(text: &str, units: &[(&str, f64)]) -> Option<f64> {
    units.iter().find_map(|(unit, size)| {
        let number: f64 = text.strip_suffix(unit)?.trim_end().parse().ok()?;
        Some(number * size)
    })
}

/// What the command can do.
#[derive(Subcommands)]
pub enum Subcommand {
    /// Derive wave functions exactly: pieces, echoes, or the general form
    Derive(Derive),
    /// Evaluate a wave or an observable with certified digits
    Eval(Eval),
    /// Write a function of time as C code with a proven error bound
    Export(Export),
    /// Measure the accuracy and speed of all methods, as charts with data and one page
    Chart(Chart),
    /// Draw observables against time, a space-time diagram, or fields along the line
    Plot(Plot),
    /// Write a page about a scene: its line, formulas, events, signals and extrema
    Report(Report),
    /// Give velocity, strain, displacement and force along the bars at a time, with bounds
    Field(Field),
    /// Find all roots, or the largest or smallest value, in a time window, with proof
    Find(Find),
    /// Find the simplest model that meets a tolerance, with a proven difference from the exact solution
    Advise(Advise),
    /// Tabulate values, extrema or contact times over ranges of symbols, on all cores
    Sweep(Sweep),
    /// Phase, group and pulse velocities for a dispersion relation omega(k)
    Dispersion(Dispersion),
    /// Closed forms of a local contact between two bars: largest force, rise times, equivalent spring
    Hertz(Hertz),
    /// Draw a figure of the textbook
    Figure(Figure),
    /// List the equations of the textbook with a verdict on each, or show one of them
    Book(Book),
    /// List when contacts open and close, with forces, velocities and energies
    Events(Events),
    /// Check a scene: read it, order its equations, and derive it in two ways
    Check(Check),
    /// Write a certificate of formulas, values or roots, for independent checkers
    Certify(Certify),
    /// Lock formulas and proven values in a file, for `check --locked`
    Lock(Lock),
    /// List the built-in scenes, or show the text of one
    Scenes(Scenes),
    /// Write shell completions, the manual page, or the table of options
    Generate(Generate),
}

/// A scene, with values in place of symbols.
#[derive(Args, Clone)]
pub struct Scene {
    /// A file, the name of a built-in scene (see `wavestep scenes`), which comes first, or - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub scene: String,
    /// Replace a symbol by an exact value before deriving; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true,
          value_hint = ValueHint::Other)]
    pub set: Vec<String>,
}
