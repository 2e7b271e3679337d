//! What ways cost: a measured table.
//!
//! The figures are seconds on one core. They rank ways against each other and are not promises. Those compiled in,
//! `costs.txt`, are of the machine of `docs/performance.md`; `wavestep chart --costs` measures them again and writes such a
//! file, as `cargo bench --bench costs` does. `docs/accuracy-and-speed.md` draws such measurements.

use crate::answer::method::Method;
use crate::signal::StablePrecision;
use std::fmt::Write as _;

/// What a file of costs begins with.
const HEADER: &str = "wavestep costs 1";

/// The unit of all costs.
const UNIT: &str = "s";

/// The kinds of work, each with its name in files and what it is, in words.
macro_rules! works {
    ($($work:ident $name:literal $meaning:literal)*) => {
        /// What a way is made of that takes time.
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub enum Work {
            $(#[doc = $meaning] $work,)*
        }

        impl Work {
            pub const ALL: [Work; [$($name),*].len()] = [$(Work::$work),*];

            /// Its name in files.
            pub fn name(self) -> &'static str {
                match self { $(Work::$work => $name,)* }
            }

            /// What it is, in words.
            pub fn meaning(self) -> &'static str {
                match self { $(Work::$work => $meaning,)* }
            }
        }
    };
}

works! {
    Echo "echo" "an echo in balls"
    Ball "ball" "a period of a value in balls"
    FixedPeriod "fixed-period" "a period of a march in integers"
    FixedPoint "fixed-point" "a value of it, at an exact time"
    Term "term" "a term of a piece without a march"
    Moved "moved" "a polynomial of a march in integers"
    Lookup "lookup" "the piece of an exact time, and its value"
    Step "step" "a step of a recurrence in doubles"
    PairStep "pair-step" "the same in pairs of doubles"
    Coefficient "coefficient" "a Chebyshev coefficient of a march"
    ProvenCoefficient "proven-coefficient" "the same with its bound"
    Wave "wave" "a wave on a period, in a march of all waves"
}

/// What each kind of work takes.
///
/// # Invariants
/// - all are finite and positive.
#[derive(Clone, PartialEq, Debug)]
pub struct Costs {
    /// Where they come from, in words.
    pub source: String,
    /// In the order of [`Work::ALL`].
    seconds: [f64; Work::ALL.len()],
}

/// What is wrong with a file of costs.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum InvalidCosts {
    #[error("1: it does not begin with `{HEADER}`")]
    Header,
    #[error("{0}: `{1}` is not an operation in this table")]
    Name(usize, String),
    #[error("{0}: `{1}` is given twice")]
    Again(usize, String),
    #[error("{0}: after `{1}` a positive number of `{UNIT}` is expected")]
    Number(usize, String),
    #[error("{0}: `{1}` is missing")]
    Missing(usize, &'static str),
}

impl Default for Costs {
    /// Those compiled in.
    fn default() -> Costs {
        let built_in = Costs::read(include_str!("costs.txt"), "the built-in table");
        built_in.expect("a test reads the file")
    }
}

impl Costs {
    /// Of measured seconds.
    ///
    /// # Panics
    /// Where one is not finite and positive.
    pub fn measured(source: &str, seconds: impl Fn(Work) -> f64) -> Costs {
        let seconds = Work::ALL.map(seconds);
        assert!(seconds.iter().all(|seconds| is_cost(*seconds)), "costs are positive");
        Costs { source: source.to_owned(), seconds }
    }

    /// Reads a file of costs: a header, and for each work a line with its name, a number, the unit, and what it is. Lines
    /// that begin with `#` are for people.
    pub fn read(text: &str, source: &str) -> Result<Costs, InvalidCosts> {
        let mut lines = text.lines().map(str::trim).zip(1..);
        if lines.next().is_none_or(|(line, _)| line != HEADER) {
            return Err(InvalidCosts::Header);
        }
        let mut seconds = [0.0; Work::ALL.len()];
        for (line, place) in lines.filter(|(line, _)| !line.is_empty() && !line.starts_with('#')) {
            let mut words = line.split_whitespace();
            let name = words.next().unwrap_or_default();
            let work = Work::ALL.iter().position(|work| work.name() == name);
            let own = work.ok_or_else(|| InvalidCosts::Name(place, name.to_owned()))?;
            if seconds[own] > 0.0 {
                return Err(InvalidCosts::Again(place, name.to_owned()));
            }
            let number = words.next().and_then(|number| number.parse().ok());
            match number.filter(|number| is_cost(*number) && words.next() == Some(UNIT)) {
                Some(number) => seconds[own] = number,
                None => return Err(InvalidCosts::Number(place, name.to_owned())),
            }
        }
        match seconds.iter().position(|seconds| *seconds == 0.0) {
            Some(i) => Err(InvalidCosts::Missing(text.lines().count(), Work::ALL[i].name())),
            None => Ok(Costs { source: source.to_owned(), seconds }),
        }
    }

    /// The text of a file, which reads back as these costs to two digits.
    pub fn text(&self) -> String {
        let mut text =
            format!("{HEADER}\n# Seconds on one core, measured by `wavestep chart --costs`.\n");
        for work in Work::ALL {
            let seconds = self.of(work);
            let _ = writeln!(text, "{:<19}{seconds:<8.1e}{UNIT}  {}", work.name(), work.meaning());
        }
        text
    }

    /// The seconds that it takes.
    pub fn of(&self, work: Work) -> f64 {
        self.seconds[work as usize]
    }
}

fn is_cost(seconds: f64) -> bool {
    seconds.is_finite() && seconds > 0.0
}

/// How large a problem is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Size {
    /// How many reflections the window sees.
    pub order: usize,
    /// How many values are asked for.
    pub points: usize,
    /// Whether waves have one pole and one lag, with rational constants, so that a march in
    /// fixed-point numbers gives the pieces.
    pub marches: bool,
    /// Whether the scene has been followed: its pieces are known, and no echoes are added up.
    pub followed: bool,
}

/// What a way costs, in seconds.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Cost {
    /// Before the first value.
    pub setup: f64,
    /// For each value, at an exact time.
    pub point: f64,
}

/// The polynomials on a stretch between arrivals, and the terms that they are expanded to: counts, which are the same on
/// every machine.
pub const PIECES: f64 = 16.0;
pub const TERMS: f64 = 40.0;

impl Cost {
    /// The cost of a method; `None` for models, which are never picked.
    pub fn of(method: Method, size: Size, costs: &Costs) -> Option<Cost> {
        let take = |work| costs.of(work);
        let n = size.order as f64 + 1.0;
        let added = if size.followed { 1.0 } else { n };
        let moved = if size.marches { take(Work::Moved) } else { TERMS * added * take(Work::Term) };
        let pieces = PIECES * n * moved;
        let echoes = n * n / 2.0;
        let coefficients = coefficients(n);
        let lookup = take(Work::Lookup);
        let (setup, point) = match method {
            Method::Certified if size.marches => {
                (n * take(Work::FixedPeriod), take(Work::FixedPoint))
            }
            Method::Certified if size.followed => (0.0, TERMS * take(Work::Ball) + lookup),
            Method::Certified => (echoes * take(Work::Echo), n * take(Work::Ball) + lookup),
            Method::Compiled => (pieces, lookup),
            Method::Stable(StablePrecision::DoubleDouble) => {
                (0.0, echoes * take(Work::PairStep) + lookup)
            }
            Method::Stable(StablePrecision::Double) | Method::Plain | Method::Expanded => {
                (0.0, echoes * take(Work::Step) + lookup)
            }
            Method::Marched { proven } => {
                let one = take(Work::Coefficient);
                let each = if proven { take(Work::ProvenCoefficient) } else { one };
                (coefficients * each, lookup + one * coefficients / n)
            }
            _ => return None,
        };
        Some(Cost { setup, point })
    }

    /// The cost of a march of so many waves without a bound.
    pub fn of_waves(size: Size, waves: usize, costs: &Costs) -> Cost {
        let one = (size.order as f64 + 1.0) * costs.of(Work::Wave);
        Cost { setup: one * waves as f64, point: costs.of(Work::Lookup) }
    }

    /// The cost of so many values, in seconds: `setup + points · point`.
    pub fn seconds(&self, points: usize) -> f64 {
        self.setup + self.point * points as f64
    }
}

/// About how many Chebyshev coefficients a march of so many periods has.
pub fn coefficients(periods: f64) -> f64 {
    periods * (4.0 * periods).sqrt().max(30.0)
}
