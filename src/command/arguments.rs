//! The arguments of the command, with their help.

use clap::{ArgGroup, Args, Parser, Subcommand as Subcommands, ValueEnum, ValueHint};
use wavestep::export::{LATEX_WIDTH, TEXT_WIDTH};

/// Exact solutions of wave propagation in bars with lumped ends.
#[derive(Parser)]
#[command(
    name = "wavestep",
    version,
    about,
    after_help = "Examples:\n  \
        wavestep derive rigid-mass\n  \
        wavestep derive rigid-mass --wave f --through 8 --format latex\n  \
        wavestep eval rigid-mass --set mu=1/4 --quantity f --at 33/10 --digits 30\n\n\
        Exit codes: 0 done, 1 could not compute or not as locked, 2 usage or bad scene,\n\
        3 accuracy not reached."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub subcommand: Subcommand,
}

/// What the command can do.
#[derive(Subcommands)]
pub enum Subcommand {
    /// Derive wave functions exactly: pieces, echoes, or the general form
    Derive(Derive),
    /// Evaluate a wave or an observable with certified digits
    Eval(Eval),
    /// Write values on a window as a program with a proven bound
    Export(Export),
    /// Measure accuracy and speed of all methods, as charts with their data and one page
    Chart(Chart),
    /// Draw observables against time, a diagram of place and time, or fields along the line
    Plot(Plot),
    /// Give velocity, strain, displacement and force along the bars at a time, with bounds
    Field(Field),
    /// Find all roots, or the largest or smallest value, in a window of time, with proof
    Find(Find),
    /// Velocities of crests, groups and pulses for a dispersion relation omega(k)
    Dispersion(Dispersion),
    /// Closed forms of a local contact between two bars: largest force, rise times, equivalent spring
    Hertz(Hertz),
    /// Draw a figure of the source
    Figure(Figure),
    /// List the equations of the source with what is found about each, or show one of them
    Book(Book),
    /// Tell when contacts open and close: a time line with forces, velocities and energies
    Events(Events),
    /// Check a scene: read it, order its equations, and derive it in two ways
    Check(Check),
    /// Lock derived forms and certified values in a file, for `check --locked`
    Lock(Lock),
    /// List the built-in scenes, or show the text of one
    Scenes(Scenes),
    /// Write the completions of a shell, or the manual page
    Generate(Generate),
}

/// A scene, with values in place of symbols.
#[derive(Args)]
pub struct Scene {
    /// A file, or the name of a built-in scene (see `wavestep scenes`), which comes first
    #[arg(value_hint = ValueHint::FilePath)]
    pub scene: String,
    /// Put an exact value in place of a symbol, before anything is derived; may be given several times
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true,
          value_hint = ValueHint::Other)]
    pub set: Vec<String>,
}

/// Options of `derive`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep derive rigid-mass                              f[0] … f[3] and g[0] … g[3]\n  \
    wavestep derive rigid-mass --wave f --from 4 --through 8 --format latex\n  \
    wavestep derive rigid-mass --wave f --piece 80 --format json\n  \
    wavestep derive rigid-mass --form echo --through 5\n  \
    wavestep derive rigid-mass --observable strain_impact\n  \
    wavestep derive pulse-shape --through 4 --source-form --format latex\n  \
    wavestep derive two-bars --general\n  \
    wavestep derive rigid-mass --set mu=1/4 --wave f")]
pub struct Derive {
    #[command(flatten)]
    pub scene: Scene,
    /// Derive this wave only
    #[arg(long, value_name = "NAME", value_hint = ValueHint::Other)]
    pub wave: Option<String>,
    /// Derive this observable instead of the waves
    #[arg(long, value_name = "NAME", conflicts_with_all = ["wave", "general"])]
    pub observable: Option<String>,
    /// Derive the periods 0 … N [default: 3, or three after --from]
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
    /// In which form
    #[arg(long, value_enum, default_value_t = Form::Period, conflicts_with = "general")]
    pub form: Form,
    /// Use the symbols, units and shorthand of the scene's source, as its `written` statements say:
    /// for pieces of waves, and with --general for waves that are sequences; in text and LaTeX
    #[arg(long, conflicts_with_all = ["observable", "form"])]
    pub source_form: bool,
    /// Say how the recurrence follows from the bars and elements of a scene: scales, waves, laws at
    /// ends and joints, the recurrence, and its first pieces
    #[arg(long, conflicts_with_all = ["wave", "observable", "general", "form", "source_form",
          "through", "from", "piece"])]
    pub explain: bool,
    /// Written how
    #[arg(long, value_enum, default_value_t = DeriveFormat::Text)]
    pub format: DeriveFormat,
    /// The most characters in a line, on the page in LaTeX [default: 100 for text, 84 for LaTeX]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(20..))]
    pub line_length: Option<u16>,
}

impl Derive {
    /// The first and the last order asked for.
    pub fn orders(&self) -> (usize, usize) {
        match (self.piece, self.through) {
            (Some(n), _) => (n, n),
            (None, Some(through)) => (self.from, through),
            (None, None) => (self.from, self.from.saturating_add(3)),
        }
    }

    /// The most characters in a line.
    pub fn width(&self) -> usize {
        let own = match self.format {
            DeriveFormat::Latex => LATEX_WIDTH,
            _ => TEXT_WIDTH,
        };
        self.line_length.map_or(own, usize::from)
    }
}

/// The form in which wave functions are given.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Form {
    /// One function of local time for each period
    Period,
    /// The echoes that arrive period by period, and add up
    Echo,
    /// The pieces with the half-open intervals on which they hold
    Piecewise,
}

/// How formulas are written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DeriveFormat {
    /// Plain text; pieces and echoes in the scene's own symbols can be read back
    Text,
    /// An `align*` environment for amsmath
    Latex,
    /// Terms with reduced rationals
    Json,
}

/// Options of `eval`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep eval rigid-mass --set mu=1/4 --quantity f --at 33/10 --digits 30\n  \
    wavestep eval rigid-mass --set mu=1 --quantity strain_fixed --from 0 --to 6 --points 13\n  \
    wavestep eval rigid-mass --set mu=1 --quantity velocity --at 2 --side left\n  \
    wavestep eval rigid-mass --set mu=1 --quantity f --piece 2 --local 1/2 --format json\n  \
    wavestep eval rigid-mass --set mu=1 --quantity f --from 0 --to 80 --points 9 --tol 1e-9 --explain\n  \
    wavestep eval mass-on-fixed-bar --set mu=1 --quantity velocity --at 3 --method modes:100 --tol 1e-3\n\n\
    Times and values are exact: 33/10, 12.34, 1e3. Rational values are printed exactly where\n\
    they have no more digits than asked for; all others are rounded correctly, ties to even.")]
pub struct Eval {
    #[command(flatten)]
    pub scene: Scene,
    /// A wave or an observable
    #[arg(long, value_name = "NAME")]
    pub quantity: String,
    /// At this scene time; may be given several times
    #[arg(long, value_name = "T", allow_hyphen_values = true,
          conflicts_with_all = ["from", "to", "points", "piece", "local"])]
    pub at: Vec<String>,
    /// First of evenly spaced times
    #[arg(long, value_name = "T", allow_hyphen_values = true, requires_all = ["to", "points"])]
    pub from: Option<String>,
    /// Last of evenly spaced times
    #[arg(long, value_name = "T", allow_hyphen_values = true, requires_all = ["from", "points"])]
    pub to: Option<String>,
    /// How many evenly spaced times
    #[arg(long, value_name = "N", requires_all = ["from", "to"])]
    pub points: Option<usize>,
    /// On this period of the quantity, at the local time given by --local
    #[arg(long, value_name = "N", requires = "local", conflicts_with_all = ["from", "to", "points"])]
    pub piece: Option<usize>,
    /// Local time on the period given by --piece
    #[arg(long, value_name = "S", allow_hyphen_values = true, requires = "piece")]
    pub local: Option<String>,
    /// How many significant digits
    #[arg(long, value_name = "D", default_value_t = 15)]
    pub digits: usize,
    /// Which limit is meant where an echo arrives
    #[arg(long, value_enum, default_value_t = SideOption::Right)]
    pub side: SideOption,
    /// Say on standard error how many echoes were worked out
    #[arg(long)]
    pub stats: bool,
    /// The most bits of working precision
    #[arg(long, value_name = "BITS", default_value_t = 1 << 18)]
    pub max_bits: u64,
    /// In doubles, by the cheapest method that is proven to be off by at most so much: 1e-9 of the
    /// largest value, abs:1e-9 in the unit of the quantity, ulp:4 units in the last place of the
    /// largest value
    #[arg(long, value_name = "TOL", conflicts_with_all = ["digits", "stats", "max_bits", "piece"])]
    pub tol: Option<String>,
    /// In doubles, by this method or model: certified, compiled, marched, stable, double-double,
    /// plain, expanded; rigid, third, modes[:N], leapfrog[:CELLS[,CFL]], steps[:TOL]
    #[arg(long, value_name = "NAME", conflicts_with_all = ["digits", "stats", "max_bits", "piece"])]
    pub method: Option<String>,
    /// Say on standard error which method was picked, and why
    #[arg(long)]
    pub explain: bool,
    /// Written how
    #[arg(long, value_enum, default_value_t = EvalFormat::Text)]
    pub format: EvalFormat,
}

/// Options of `find`.
#[derive(Args)]
#[command(group = ArgGroup::new("goal").required(true).args(["max", "min", "zero", "level"]),
    after_help = "Examples:\n  \
    wavestep find rigid-mass --set mu=1 --zero strain_impact --from 2 --to 4\n  \
    wavestep find rigid-mass --set mu=1 --level velocity=1/2 --from 0 --to 6\n  \
    wavestep find hopkinson --max force --from 0 --to 350us --digits 9\n  \
    wavestep find rigid-mass --min strain_fixed --equal mu=1/10..1 --between 3*mu,5*mu,7*mu\n\n\
    Both ends of the window belong to it. Every root in it is told, with what is proven of it; exit\n\
    code 3 when some of it stays undecided. Levels are in the unit of the quantity, or have one.")]
pub struct Find {
    #[command(flatten)]
    pub scene: Scene,
    /// The largest value of this wave or observable
    #[arg(long, value_name = "QUANTITY")]
    pub max: Option<String>,
    /// The smallest value
    #[arg(long, value_name = "QUANTITY")]
    pub min: Option<String>,
    /// All times at which it is zero
    #[arg(long, value_name = "QUANTITY")]
    pub zero: Option<String>,
    /// All times at which it has this value
    #[arg(long, value_name = "QUANTITY=VALUE", allow_hyphen_values = true)]
    pub level: Option<String>,
    /// The first time of the window
    #[arg(long, value_name = "T", allow_hyphen_values = true, required_unless_present = "equal")]
    pub from: Option<String>,
    /// The last time of the window
    #[arg(long, value_name = "T", allow_hyphen_values = true, required_unless_present = "equal")]
    pub to: Option<String>,
    /// A value of this symbol between two bounds for which the largest or smallest values in two
    /// windows are equal
    #[arg(long, value_name = "SYMBOL=LOW..HIGH", requires = "between",
          conflicts_with_all = ["from", "to", "zero", "level"])]
    pub equal: Option<String>,
    /// The windows from T1 to T2 and from T2 to T3, without their last instants; times may hold the
    /// symbol of --equal
    #[arg(long, value_name = "T1,T2,T3", requires = "equal")]
    pub between: Option<String>,
    /// How many significant digits
    #[arg(long, value_name = "D", default_value_t = 15)]
    pub digits: usize,
    /// The most bits of working precision
    #[arg(long, value_name = "BITS", default_value_t = 1 << 12)]
    pub max_bits: u64,
    /// Written how
    #[arg(long, value_enum, default_value_t = EvalFormat::Text)]
    pub format: EvalFormat,
}

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

/// Which limit is meant.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SideOption {
    /// From earlier times
    Left,
    /// From later times
    Right,
}

/// How values are written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum EvalFormat {
    /// A line a time
    Text,
    /// Decimal strings with proven radii
    Json,
    /// Columns with a heading
    Csv,
}

/// Options of `dispersion`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep dispersion lattice --at 1\n  \
    wavestep dispersion 'k*sqrt(1 + a*k^2)' --set a=1/12 --at 1/2 --digits 30\n  \
    wavestep dispersion cubic --pulse triangle\n  \
    wavestep dispersion cubic --length 10 --propagate 20\n  \
    wavestep dispersion lattice --pulse 'exp(-k^2)' --duration 8\n\n\
Relations that have names: string, lattice, cubic, stiff-string, beam, love. Parameters stand for\n\
positive numbers. A pulse counts wavenumbers to 2 pi/length, or to the root of omega(k) duration = 2 pi.")]
pub struct Dispersion {
    /// A formula in k, or the name of a relation
    pub relation: String,
    /// Put an exact value in place of a parameter; may be given several times
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true,
          value_hint = ValueHint::Other)]
    pub set: Vec<String>,
    /// Values at this wavenumber; may be given several times
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    pub at: Vec<String>,
    /// The pulse: square, triangle, gaussian, or its spectrum as a formula in k [default: square, where
    /// a length or a duration is given]
    #[arg(long, value_name = "PULSE", allow_hyphen_values = true)]
    pub pulse: Option<String>,
    /// The length of a pulse given in space
    #[arg(long, value_name = "B", allow_hyphen_values = true, conflicts_with = "duration")]
    pub length: Option<String>,
    /// The duration of a pulse given in time, at one place
    #[arg(long, value_name = "TAU", allow_hyphen_values = true)]
    pub duration: Option<String>,
    /// Send the pulse on its way until this time, and say how fast its peak was
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub propagate: Option<String>,
    /// How many points the grid of --propagate has
    #[arg(long, value_name = "N", requires = "propagate")]
    pub points: Option<usize>,
    /// How many significant digits
    #[arg(long, value_name = "D", default_value_t = 15)]
    pub digits: usize,
    /// The most bits of working precision
    #[arg(long, value_name = "BITS", default_value_t = 1 << 12)]
    pub max_bits: u64,
    /// Written how
    #[arg(long, value_enum, default_value_t = DispersionFormat::Text)]
    pub format: DispersionFormat,
}

/// How velocities are written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DispersionFormat {
    /// Formulas that read back, and digits
    Text,
    /// An `align*` environment for amsmath
    Latex,
    /// Formulas as text, decimal strings with proven radii
    Json,
}

/// Options of `export`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep export rigid-mass --as c --set mu=1 --quantity f --to 40 -o f.c\n  \
    wavestep export hopkinson --as c --quantity gauge_output --to 2ms --tol 1e-6 -o gauge.c\n\n\
The file holds polynomials, the function `double wavestep_QUANTITY(double t)`, one for many times, and\n\
the proven bound.")]
pub struct Export {
    #[command(flatten)]
    pub scene: Scene,
    /// In which language
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
    /// How far off values may be, as for eval [default: ulp:4]
    #[arg(long, value_name = "TOL")]
    pub tol: Option<String>,
    /// The file to write; standard output without it
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<String>,
}

/// What values on a window are written as.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ExportLanguage {
    /// A C function
    C,
}

/// Options of `chart`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep chart rigid-mass --set mu=1 -o charts\n  \
    wavestep chart hopkinson --quantity gauge_output --to 2ms -o charts\n\n\
Each chart is written as SVG, JSON and CSV; index.html shows all of them with a table. With one symbol\n\
set, there are maps over the order and that symbol as well. Times are those of this machine.")]
pub struct Chart {
    #[command(flatten)]
    pub scene: Scene,
    /// A wave or an observable [default: the first observable]
    #[arg(long, value_name = "NAME")]
    pub quantity: Option<String>,
    /// The first time of the window
    #[arg(long, value_name = "T", default_value = "0", allow_hyphen_values = true)]
    pub from: String,
    /// The last time of the window [default: 40 periods]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// At how many times errors are measured
    #[arg(long, value_name = "N", default_value_t = 1000)]
    pub points: usize,
    /// The seed of the times
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Fewer orders and runs: to see whether it works
    #[arg(long)]
    pub quick: bool,
    /// The folder to write to; it is made where there is none
    #[arg(short, long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub output: String,
}

/// Options of `plot`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep plot rigid-mass --set mu=1 --to 8 -o strain.svg\n  \
    wavestep plot hopkinson --diagram velocity --to 400us -o hopkinson.svg\n  \
    wavestep plot hopkinson --at-time 50us,100us,150us --quantity velocity,force -o fields.png\n\n\
The ending of the file says what is written: .svg, .png, or the numbers as .json or .csv.")]
pub struct Plot {
    #[command(flatten)]
    pub scene: Scene,
    /// These waves and observables, separated by commas [default: all observables]; with --at-time,
    /// these of velocity, strain, displacement and force [default: the first three]
    #[arg(long, value_name = "NAME", value_delimiter = ',', conflicts_with = "diagram")]
    pub quantity: Vec<String>,
    /// The first time of the window
    #[arg(long, value_name = "T", default_value = "0", allow_hyphen_values = true)]
    pub from: String,
    /// The last time of the window [default: four periods]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// Place across and time upwards, with this quantity by colour
    #[arg(long, value_enum)]
    pub diagram: Option<DiagramOption>,
    /// Fields along the line at these times, separated by commas
    #[arg(long, value_name = "T", value_delimiter = ',', allow_hyphen_values = true,
          conflicts_with_all = ["diagram", "from", "to"])]
    pub at_time: Vec<String>,
    /// The title [default: that of the scene]; nothing for none
    #[arg(long, value_name = "TEXT")]
    pub title: Option<String>,
    /// The width of a PNG in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1800)]
    pub width: u32,
    /// The file to write
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: String,
}

/// The quantity of a diagram of place and time.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DiagramOption {
    /// Positive to the right
    Velocity,
    /// Positive where it pulls
    Strain,
    /// Positive where it compresses
    Force,
}

/// Options of `field`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep field mass-on-fixed-bar --set mu=1 --time 5/2 --mesh 100\n  \
    wavestep field hopkinson --time 120us --mesh 200 --bar striker --averages --format json\n\n\
Each value is a double with a proven bound on its error. Where a field jumps at a node, the limit from\n\
the right is given, at the right end of a bar that from within; --side left gives the other.")]
pub struct Field {
    #[command(flatten)]
    pub scene: Scene,
    /// At this scene time
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub time: String,
    /// How many cells each bar has
    #[arg(long, value_name = "N", default_value_t = 100)]
    pub mesh: usize,
    /// The averages over the cells instead of the values at the nodes
    #[arg(long)]
    pub averages: bool,
    /// From which side limits are taken where a field jumps at a node
    #[arg(long, value_enum, default_value_t = SideOption::Right)]
    pub side: SideOption,
    /// This bar only; may be given several times
    #[arg(long, value_name = "NAME", value_hint = ValueHint::Other)]
    pub bar: Vec<String>,
    /// Endless bars up to this distance from their end [default: as far as waves have come]
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// Written how
    #[arg(long, value_enum, default_value_t = FieldFormat::Csv)]
    pub format: FieldFormat,
    /// The file to write; standard output without it
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<String>,
}

/// How fields are written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FieldFormat {
    /// A row a node or cell, with a heading
    Csv,
    /// Lists of numbers for each bar
    Json,
}

/// Options of `scenes`.
#[derive(Args)]
#[command(after_help = "Examples:\n  wavestep scenes\n  wavestep scenes rigid-mass > mine.wave")]
pub struct Scenes {
    /// Show the text of this scene, with its units and sources
    pub name: Option<String>,
}

/// Options of `hertz`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep hertz local-contact\n  \
    wavestep hertz hertz-striker --rise 1/2,9/10 --at 20us --digits 9\n\n\
The bars are taken to be long: all is valid until a wave from a far end may be felt, which is told.")]
pub struct Hertz {
    #[command(flatten)]
    pub scene: Scene,
    /// Rise times to these shares of the largest force, separated by commas
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
    /// How many significant digits
    #[arg(long, value_name = "D", default_value_t = 12)]
    pub digits: usize,
    /// Written how
    #[arg(long, value_enum, default_value_t = HertzFormat::Text)]
    pub format: HertzFormat,
}

/// How closed forms of a contact are written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum HertzFormat {
    /// A line a value
    Text,
    /// Decimal strings
    Json,
}

/// Options of `figure`.
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
    /// The file to write: .svg, .png, .json or .csv
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath, requires = "number")]
    pub output: Option<String>,
}

/// Options of `book`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep book\n  \
    wavestep book 6.75\n  \
    wavestep book 6.80 --format latex\n\n\
    The source is Harrison and Nettleton, Advanced Engineering Dynamics, sections 6.6 to 6.11. Every\n\
    equation is held against what is derived from the scene it is about.")]
pub struct Book {
    /// Show the equation of this number: as read, as derived, and the proof
    pub number: Option<String>,
    /// Written how
    #[arg(long, value_enum, default_value_t = BookFormat::Text)]
    pub format: BookFormat,
}

/// How equations of the source are written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum BookFormat {
    /// Plain text
    Text,
    /// LaTeX with amsmath
    Latex,
    /// With verdict, derived form and steps
    Json,
    /// The page docs/equations.md
    Markdown,
}

/// Options of `check`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep check my.wave\n  \
    wavestep check rigid-mass\n  \
    wavestep check my.wave --locked my.lock")]
pub struct Check {
    #[command(flatten)]
    pub scene: Scene,
    /// Compare with what `wavestep lock` wrote to this file, with the values that stand there
    #[arg(long, value_name = "FILE", conflicts_with = "set", value_hint = ValueHint::FilePath)]
    pub locked: Option<String>,
}

/// Options of `lock`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep lock my.wave --through 4 -o my.lock\n  \
    wavestep lock rigid-mass --through 2 --set mu=1/4 --at 33/10 --at 5\n  \
    wavestep lock saint-venant --set mu=1 --at 2 -o my.lock\n  \
    wavestep check my.wave --locked my.lock\n\n\
    The file holds what the scene states of its period, symbols and observables, the pieces of all\n\
    waves on the periods 0 … N, and at each time the values of all waves and observables, just\n\
    after arrivals. Of a scene whose contacts open it holds events instead of pieces, and values of\n\
    observables. A file that exists is replaced.")]
pub struct Lock {
    #[command(flatten)]
    pub scene: Scene,
    /// Lock the pieces on the periods 0 … N
    #[arg(long, value_name = "N")]
    pub through: Option<usize>,
    /// Lock the events until this scene time, where contacts open [default: as in `events`]
    #[arg(long, value_name = "T", allow_hyphen_values = true, conflicts_with = "through")]
    pub until: Option<String>,
    /// Lock values at this scene time; may be given several times
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub at: Vec<String>,
    /// How many significant digits values have
    #[arg(long, value_name = "D", default_value_t = 20)]
    pub digits: usize,
    /// The file to write; standard output without it
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<String>,
}

/// Options of `generate`.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep generate bash > ~/.local/share/bash-completion/completions/wavestep\n  \
    wavestep generate zsh > ~/.zfunc/_wavestep\n  \
    wavestep generate manual > wavestep.1 && man ./wavestep.1")]
pub struct Generate {
    /// What to write
    #[arg(value_enum)]
    pub what: Generated,
}

/// What `generate` writes.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Generated {
    /// Completions for bash
    Bash,
    /// Completions for elvish
    Elvish,
    /// Completions for fish
    Fish,
    /// Completions for PowerShell
    Powershell,
    /// Completions for zsh
    Zsh,
    /// The manual page, for man
    Manual,
}
