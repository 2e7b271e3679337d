//! Arguments of `derive`.

use super::{Format, Output, Scene, named};
use clap::{Args, ValueHint};
use wavestep::export::{LATEX_WIDTH, TEXT_WIDTH};
use wavestep::problem::{Form, Orders};

#[derive(Args, Clone)]
#[command(after_help = "Examples:\n  \
    wavestep derive rigid-mass                              f[0] … f[3] and g[0] … g[3]\n  \
    wavestep derive rigid-mass --quantity f --from 4 --through 8 --format latex\n  \
    wavestep derive rigid-mass --quantity f --piece 80 --format json\n  \
    wavestep derive rigid-mass --form echo --through 5\n  \
    wavestep derive rigid-mass --quantity strain_impact\n  \
    wavestep derive pulse-shape --through 4 --source-form --format latex\n  \
    wavestep derive two-bars --general\n  \
    wavestep derive rigid-mass --set mu=1/4 --quantity f")]
pub struct Derive {
    #[command(flatten)]
    pub scene: Scene,
    /// This wave or observable [default: all waves]; commands for values take several, separated by commas
    #[arg(long, value_name = "NAME", aliases = ["wave", "observable"], value_hint = ValueHint::Other)]
    pub quantity: Option<String>,
    /// Derive the periods 0 … N [default: 3, or three after --from; fewer where rates
    /// have names and formulas get long]
    #[arg(long, value_name = "N", conflicts_with_all = ["piece", "general"])]
    pub through: Option<usize>,
    /// Begin with period N, before --through
    #[arg(long, value_name = "N", default_value_t = 0, conflicts_with_all = ["piece", "general"])]
    pub from: usize,
    /// Derive period N only
    #[arg(long, value_name = "N", conflicts_with = "general")]
    pub piece: Option<usize>,
    /// Derive the form for every n
    #[arg(long)]
    pub general: bool,
    /// The form of the result
    #[arg(long, default_value = "period", conflicts_with = "general", value_parser = named([
        ("period", Form::Period, "One function of local time for each period"),
        ("echo", Form::Echo, "The echoes that arrive period by period, and add up"),
        ("piecewise", Form::Piecewise, "The pieces with the half-open intervals on which they hold"),
    ]))]
    pub form: Form,
    /// Use the symbols, units and shorthand of the scene's source, as its `written` statements say:
    /// for pieces, and with --general for every n; in text and LaTeX
    #[arg(long, conflicts_with = "form")]
    pub source_form: bool,
    /// Say how everything follows: the recurrence from the bars and elements of a scene, the pieces from it
    /// step by step [default: periods 0 … 2], and why general forms hold; with --form echo by Laplace transforms
    #[arg(long, conflicts_with_all = ["quantity", "general", "source_form"])]
    pub explain: bool,
    /// Print an exercise: the scene with what is asked, and apart from it the answer as --explain tells it
    #[arg(long, conflicts_with_all = ["quantity", "general", "source_form"])]
    pub exercise: bool,
    /// Derive a simpler model too, below the exact formulas: `rigid` (no bar yields), `third` (bars are springs with a
    /// third of their mass), or another change of the scene, as `find --minus` takes it
    #[arg(long, value_name = "MODEL", conflicts_with_all = ["explain", "exercise", "source_form"])]
    pub model: Option<String>,
    /// The output format
    #[arg(long, default_value = "text", value_parser = named([
        ("text", Format::Text, "Plain text; pieces and echoes in the scene's own symbols can be read back"),
        ("latex", Format::Latex, "An `align*` environment for amsmath"),
        ("json", Format::Json, "Terms with reduced rationals"),
        ("csv", Format::Csv, "One row per term, with the same fields; with --general one per formula"),
    ]))]
    pub format: Format,
    #[command(flatten)]
    pub output: Output,
    /// The maximum line length, on the page in LaTeX [default: 100 for text, 84 for LaTeX]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(20..))]
    pub line_length: Option<u16>,
}

impl Derive {
    /// The orders asked for, where any are.
    pub fn orders(&self) -> Option<Orders> {
        match (self.piece, self.through) {
            (Some(n), _) => Some(Orders::Only(n)),
            (None, Some(through)) => Some(Orders::Through(self.from, through)),
            (None, None) => None,
        }
    }

    /// The most characters in a line.
    pub fn width(&self) -> usize {
        let own = match self.format {
            Format::Latex => LATEX_WIDTH,
            _ => TEXT_WIDTH,
        };
        self.line_length.map_or(own, usize::from)
    }
}
