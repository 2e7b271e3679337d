//! Arguments of `export`.

use super::{Output, Scene};
use clap::{Args, ValueEnum};

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep export rigid-mass --as c --set mu=1 --quantity f --to 40 -o f.c\n  \
    wavestep export hopkinson --as c --quantity gauge_output --to 2ms --tol 1e-6 -o gauge.c\n\n\
The file contains polynomials, the function `double wavestep_QUANTITY(double t)`, a function for\n\
many times, and the proven error bound.")]
pub struct Export {
    #[command(flatten)]
    pub scene: Scene,
    /// The programming language
    #[arg(long = "as", value_enum)]
    pub language: ExportLanguage,
    /// A wave or an observable
    #[arg(long, value_name = "NAME")]
    pub quantity: String,
    /// The first time of the window
    #[arg(long, value_name = "T", default_value = "0", allow_hyphen_values = true)]
    pub from: String,
    /// The last time of the window
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub to: String,
    /// The tolerance, as for eval [default: ulp:4]
    #[arg(long, value_name = "TOL")]
    pub tol: Option<String>,
    #[command(flatten)]
    pub output: Output,
}

/// What values on a window are written as.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ExportLanguage {
    /// A C function
    C,
}
