//! Ways to values, by name and settings.

use crate::signal::StablePrecision;
use std::fmt;
use std::str::FromStr;

/// A way to values with its settings, as it is written: `NAME` or `NAME:SETTING[,SETTING]`.
///
/// ```
/// use wavestep::Method;
///
/// assert_eq!("steps:1e-12".parse::<Method>()?, Method::Steps { tolerance: 1e-12 });
/// assert_eq!(Method::Marched { proven: true }.to_string(), "marched");
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Method {
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
    /// The method of steps by collocation, with this relative tolerance.
    Steps {
        /// Its relative tolerance.
        tolerance: f64,
    },
}

impl Method {
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
        ("steps:TOL", "model: method of steps by collocation, relative tolerance [default: 1e-10]"),
    ];

    /// Whether it leaves something out, or has no proof at all.
    #[doc(hidden)]
    pub fn is_model(&self) -> bool {
        matches!(
            self,
            Method::Rigid
                | Method::Third
                | Method::Modes { .. }
                | Method::Leapfrog { .. }
                | Method::Steps { .. }
        )
    }

    /// The name without settings.
    pub fn name(&self) -> &'static str {
        match self {
            Method::Certified => "certified",
            Method::Compiled => "compiled",
            Method::Marched { proven: true } => "marched",
            Method::Marched { proven: false } => "marched-unproven",
            Method::Stable(StablePrecision::Double) => "stable",
            Method::Stable(StablePrecision::DoubleDouble) => "double-double",
            Method::Plain => "plain",
            Method::Expanded => "expanded",
            Method::Rigid => "rigid",
            Method::Third => "third",
            Method::Modes { .. } => "modes",
            Method::Leapfrog { .. } => "leapfrog",
            Method::Steps { .. } => "steps",
        }
    }

    /// Whether it has values only as long as contacts stay closed: it computes from a closed form, or is a model.
    pub fn needs_closed_contacts(&self) -> bool {
        !matches!(self, Method::Certified | Method::Compiled)
    }

    /// The settings, as they are written; none where there are none.
    pub fn setting(&self) -> String {
        match self {
            Method::Modes { count } => count.to_string(),
            Method::Leapfrog { cells, courant } => format!("{cells},{courant}"),
            Method::Steps { tolerance } => format!("{tolerance:e}"),
            _ => String::new(),
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.setting() {
            setting if setting.is_empty() => f.write_str(self.name()),
            setting => write!(f, "{}:{setting}", self.name()),
        }
    }
}

/// Why a text is no method.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum InvalidMethod {
    /// No method has this name.
    #[error("there is no method `{0}`")]
    Name(String),
    /// The method does not take this setting.
    #[error("`{1}` is not a setting of {0}")]
    Setting(&'static str, String),
}

impl FromStr for Method {
    type Err = InvalidMethod;

    fn from_str(text: &str) -> Result<Method, InvalidMethod> {
        let (name, settings) = match text.split_once(':') {
            Some((name, settings)) => (name, Some(settings)),
            None => (text, None),
        };
        let method = match name {
            "certified" => Method::Certified,
            "compiled" => Method::Compiled,
            "marched" => Method::Marched { proven: true },
            "marched-unproven" => Method::Marched { proven: false },
            "stable" => Method::Stable(StablePrecision::Double),
            "double-double" => Method::Stable(StablePrecision::DoubleDouble),
            "plain" => Method::Plain,
            "expanded" => Method::Expanded,
            "rigid" => Method::Rigid,
            "third" => Method::Third,
            "modes" => Method::Modes { count: 1000 },
            "leapfrog" => Method::Leapfrog { cells: 400, courant: 1.0 },
            "steps" => Method::Steps { tolerance: 1e-10 },
            _ => return Err(InvalidMethod::Name(name.to_owned())),
        };
        let Some(settings) = settings else { return Ok(method) };
        let invalid = || InvalidMethod::Setting(method.name(), settings.to_owned());
        match method {
            Method::Modes { .. } => {
                settings.parse().map(|count| Method::Modes { count }).map_err(|_| invalid())
            }
            Method::Steps { .. } => {
                settings.parse().map(|tolerance| Method::Steps { tolerance }).map_err(|_| invalid())
            }
            Method::Leapfrog { .. } => {
                let (cells, courant) = settings.split_once(',').unwrap_or((settings, "1"));
                let cells = cells.parse().map_err(|_| invalid())?;
                let courant = courant.parse().map_err(|_| invalid())?;
                Ok(Method::Leapfrog { cells, courant })
            }
            _ => Err(invalid()),
        }
    }
}
