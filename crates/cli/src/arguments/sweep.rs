//! Arguments of `sweep`.

use super::Scene;
use clap::{ArgGroup, Args, ValueHint};
use wavestep::signal::Goal;

#[derive(Args)]
#[command(group = ArgGroup::new("asked").required(true).multiple(true).args(["at", "max", "min", "contacts"]),
    after_help = "Examples:\n  \
    wavestep sweep mass-on-fixed-bar --over mu=1/10..10:25:log --max strain_fixed --to 8\n  \
    wavestep sweep saint-venant --over mu=1/2,1,2,4 --contacts -o contacts.csv\n  \
    wavestep sweep mass-between-bars --over m=1..4:7 --at 1,2 -o all.parquet\n\n\
    One row per combination of values: the last --over changes fastest. Numbers are the doubles\n\
    nearest to the exact values, empty where there is no answer: the column `error` says why. Rows\n\
    are computed on all cores, and come out the same on any number of them. With -o, finished rows\n\
    are kept in FILE.rows until all are done: the same command resumes an interrupted sweep.")]
pub struct Sweep {
    #[command(flatten)]
    pub scene: Scene,
    /// The values of a symbol: a list A,B,…, N values in equal steps A..B:N, or in equal ratios A..B:N:log; may be
    /// repeated
    #[arg(long, value_name = "NAME=VALUES", required = true, allow_hyphen_values = true)]
    pub over: Vec<String>,
    /// Values at these times, separated by commas
    #[arg(long, value_name = "T", value_delimiter = ',', allow_hyphen_values = true)]
    pub at: Vec<String>,
    /// With --at: of these waves or observables, separated by commas [default: all observables]
    #[arg(long, value_name = "NAME", value_delimiter = ',', requires = "at")]
    pub quantity: Vec<String>,
    /// The largest values of these quantities in the window, and when they are first taken
    #[arg(long, value_name = "QUANTITY", value_delimiter = ',')]
    pub max: Vec<String>,
    /// The smallest values
    #[arg(long, value_name = "QUANTITY", value_delimiter = ',')]
    pub min: Vec<String>,
    /// How often each contact closes, how long it is closed at first, its impulse in that time, its coefficient of restitution
    #[arg(long)]
    pub contacts: bool,
    /// The first time of the window
    #[arg(long, value_name = "T", default_value = "0", allow_hyphen_values = true)]
    pub from: String,
    /// The last time of the window [default: four periods, or twice the way along the line; of
    /// contacts, until nothing can meet again, at most a hundred of the longest travel times]
    #[arg(long, alias = "until", value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// The number of threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// The output file, .csv or .parquet [default: CSV on standard output, also for -]
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<String>,
}

impl Sweep {
    /// The quantities whose extrema are asked for.
    pub fn extrema(&self) -> Vec<(Goal, String)> {
        let of = |goal: Goal, names: &[String]| {
            names.iter().map(|name| (goal, name.trim().to_owned())).collect::<Vec<_>>()
        };
        [of(Goal::Largest, &self.max), of(Goal::Smallest, &self.min)].concat()
    }
}
