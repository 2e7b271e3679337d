//! Ways to values, by name and settings.

use crate::evaluate::StablePrecision;
use std::fmt;
use std::str::FromStr;

/// A way to values with its settings, as it is written: `NAME` or `NAME:SETTING[,SETTING]`.
///
/// ```
/// use wavestep::Method;
///
/// assert_eq!("steps:1e-12".parse::<Method>()?, Method::Steps { tolerance: 1e-12 });
/// assert!("modes:10".parse::<Method>()?.is_model());
/// assert_eq!(Method::Marched { proven: true }.to_string(), "marched");
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Kind {
    /// Correctly rounded.
    Certified,
    /// Polynomials with a proven bound.
    Compiled,
    /// A march on Chebyshev coefficients; proven where asked for, with one pole and one lag.
    Marched {
        /// Whether a bound is proven, where it can be.
        proven: bool,
    },
    /// The stable sum of echoes.
    Stable(StablePrecision),
    /// The recurrence of three terms.
    Plain,
    /// The formula as printed.
    Expanded,
    /// One rigid body.
    Rigid,
    /// A spring with a third of the mass of the bar.
    Third,
    /// Modes of vibration.
    Modes {
        /// How many.
        count: usize,
    },
    /// Finite differences.
    Leapfrog {
        /// Cells in the shortest travel time.
        cells: usize,
        /// Courant's number.
        courant: f64,
    },
    /// The method of steps with an adaptive solver.
    Steps {
        /// Its relative tolerance.
        tolerance: f64,
    },
}

impl Kind {
    /// The names, each with its settings and what they are when nothing is said.
    pub const NAMES: [(&'static str, &'static str); 13] = [
        ("certified", "correctly rounded"),
        ("compiled", "polynomials with a proven bound"),
        (
            "marched",
            "Chebyshev coefficients period by period, with a proven bound for one pole and one lag",
        ),
        ("marched-unproven", "the same without"),
        ("stable", "echoes summed by differences"),
        ("double-double", "the same in pairs of doubles"),
        ("plain", "the recurrence of three terms"),
        ("expanded", "the formula as printed"),
        ("rigid", "model: one rigid body"),
        ("third", "model: a spring with a third of the bar's mass"),
        ("modes:N", "model: N modes of vibration [default: 1000]"),
        ("leapfrog:CELLS,CFL", "model: finite differences [default: 400,1]"),
        ("steps:TOL", "model: method of steps with an adaptive solver [default: 1e-10]"),
    ];

    /// Whether it is a model that leaves something out.
    pub fn is_model(&self) -> bool {
        matches!(
            self,
            Kind::Rigid
                | Kind::Third
                | Kind::Modes { .. }
                | Kind::Leapfrog { .. }
                | Kind::Steps { .. }
        )
    }

    /// The name without settings.
    pub fn name(&self) -> &'static str {
        match self {
            Kind::Certified => "certified",
            Kind::Compiled => "compiled",
            Kind::Marched { proven: true } => "marched",
            Kind::Marched { proven: false } => "marched-unproven",
            Kind::Stable(StablePrecision::Double) => "stable",
            Kind::Stable(StablePrecision::DoubleDouble) => "double-double",
            Kind::Plain => "plain",
            Kind::Expanded => "expanded",
            Kind::Rigid => "rigid",
            Kind::Third => "third",
            Kind::Modes { .. } => "modes",
            Kind::Leapfrog { .. } => "leapfrog",
            Kind::Steps { .. } => "steps",
        }
    }

    /// The settings, as they are written; none where there are none.
    pub fn setting(&self) -> String {
        match self {
            Kind::Modes { count } => count.to_string(),
            Kind::Leapfrog { cells, courant } => format!("{cells},{courant}"),
            Kind::Steps { tolerance } => format!("{tolerance:e}"),
            _ => String::new(),
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.setting() {
            setting if setting.is_empty() => f.write_str(self.name()),
            setting => write!(f, "{}:{setting}", self.name()),
        }
    }
}

/// What names no way.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum InvalidWay {
    /// No way has this name.
    #[error("there is no method `{0}`")]
    Name(String),
    /// A way has not this setting.
    #[error("`{1}` is no setting of {0}")]
    Setting(&'static str, String),
}

impl FromStr for Kind {
    type Err = InvalidWay;

    fn from_str(text: &str) -> Result<Kind, InvalidWay> {
        let (name, settings) = match text.split_once(':') {
            Some((name, settings)) => (name, Some(settings)),
            None => (text, None),
        };
        let kind = match name {
            "certified" => Kind::Certified,
            "compiled" => Kind::Compiled,
            "marched" => Kind::Marched { proven: true },
            "marched-unproven" => Kind::Marched { proven: false },
            "stable" => Kind::Stable(StablePrecision::Double),
            "double-double" => Kind::Stable(StablePrecision::DoubleDouble),
            "plain" => Kind::Plain,
            "expanded" => Kind::Expanded,
            "rigid" => Kind::Rigid,
            "third" => Kind::Third,
            "modes" => Kind::Modes { count: 1000 },
            "leapfrog" => Kind::Leapfrog { cells: 400, courant: 1.0 },
            "steps" => Kind::Steps { tolerance: 1e-10 },
            _ => return Err(InvalidWay::Name(name.to_owned())),
        };
        let Some(settings) = settings else { return Ok(kind) };
        let invalid = || InvalidWay::Setting(kind.name(), settings.to_owned());
        match kind {
            Kind::Modes { .. } => {
                settings.parse().map(|count| Kind::Modes { count }).map_err(|_| invalid())
            }
            Kind::Steps { .. } => {
                settings.parse().map(|tolerance| Kind::Steps { tolerance }).map_err(|_| invalid())
            }
            Kind::Leapfrog { .. } => {
                let (cells, courant) = settings.split_once(',').unwrap_or((settings, "1"));
                let cells = cells.parse().map_err(|_| invalid())?;
                let courant = courant.parse().map_err(|_| invalid())?;
                Ok(Kind::Leapfrog { cells, courant })
            }
            _ => Err(invalid()),
        }
    }
}
