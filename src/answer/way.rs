//! Ways to values, by name and settings.

use crate::answer::question::Question;
use crate::answer::tolerance::Tolerance;
use crate::answer::weigh::Weighed;
use crate::ball::in_decimals;
use crate::evaluate::{
    Certified, Compiled, EvaluateError, Expanded, Limit, Marched, Method, MethodError, Plain,
    Stable, StablePrecision,
};
use crate::model::{
    Leapfrog, Model, ModelError, Modes, RigidBody, StartingVelocity, Steps, ThirdOfMass,
};
use crate::network::ScaledScene;
use num_traits::ToPrimitive as _;
use std::fmt;
use std::str::FromStr;
use wavestep_polynomial::Rational;

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

/// Why a way has no values.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum WayError {
    /// A method refuses.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// A model refuses.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A model has no scene to be made of.
    #[error("{0} models a scene of bars, and this is a recurrence")]
    NeedsScene(&'static str),
    /// A method computes from the recurrence of a scene that has none.
    #[error("{0} computes from the exact solution, and none is known with a local contact")]
    NeedsRecurrence(&'static str),
    /// Models have values after arrivals only.
    #[error("{0} is a model, and has no limits from one side")]
    LeftLimit(&'static str),
    /// A method gives no number at a time.
    #[error("{} gives no number at {}", .0, in_decimals(.1))]
    NoNumber(Kind, Rational),
    /// No method is proven to be good enough.
    #[error("no double is proven to be within {tolerance}")]
    NotMet {
        /// The methods that were weighed.
        weighed: Box<Weighed>,
        /// What was asked for.
        tolerance: Tolerance,
        /// The same in the unit of the values.
        absolute: f64,
    },
}

impl From<EvaluateError> for WayError {
    fn from(error: EvaluateError) -> WayError {
        WayError::Method(error.into())
    }
}

/// A way that is ready to give values.
enum Ways<'a> {
    /// A method on the exact solution.
    Method(Box<dyn Method + 'a>),
    /// A model, and the place of the observable in the scene.
    Model(Box<dyn Model>, usize),
}

/// A way to the values of a question.
pub struct Way<'a> {
    kind: Kind,
    inner: Ways<'a>,
}

impl<'a> Way<'a> {
    /// Makes a way ready. Methods that can be less exact at less cost take account of a tolerance, in
    /// the unit of the values.
    ///
    /// # Errors
    /// [`WayError`], where the question is none for this way.
    pub fn new(
        kind: Kind,
        question: &Question<'a>,
        tolerance: Option<f64>,
    ) -> Result<Way<'a>, WayError> {
        let Question { signal, from, to, .. } = question;
        let inner = match kind {
            Kind::Certified => {
                Ways::Method(Box::new(Certified::new(signal, from, to, question.recognise)?))
            }
            Kind::Compiled => Ways::Method(Box::new(Compiled::new(signal, from, to, tolerance)?)),
            Kind::Marched { proven } => {
                Ways::Method(Box::new(Marched::new(signal, from, to, proven)?))
            }
            Kind::Stable(precision) => {
                Ways::Method(Box::new(Stable::new(signal, from, to, precision)?))
            }
            Kind::Plain => Ways::Method(Box::new(Plain::new(signal, from, to)?)),
            Kind::Expanded => Ways::Method(Box::new(Expanded::new(signal, from, to)?)),
            Kind::Rigid
            | Kind::Third
            | Kind::Modes { .. }
            | Kind::Leapfrog { .. }
            | Kind::Steps { .. } => {
                let scene = question.scene.ok_or(WayError::NeedsScene(kind.name()));
                let (network, place) = scene?;
                return Way::of_model(kind, network, place);
            }
        };
        Ok(Way { kind, inner })
    }

    /// A model made ready for the observable at this place of a scene, which needs no recurrence.
    ///
    /// # Errors
    /// [`WayError::NeedsRecurrence`] for methods on the exact solution; [`WayError::Model`] where the
    /// model refuses the scene.
    pub fn of_model(
        kind: Kind,
        scene: &impl AsRef<ScaledScene>,
        place: usize,
    ) -> Result<Way<'a>, WayError> {
        let model: Box<dyn Model> = match kind {
            Kind::Rigid => Box::new(RigidBody::new(scene)?),
            Kind::Third => Box::new(ThirdOfMass::new(scene, StartingVelocity::ByMomentum)?),
            Kind::Modes { count } => Box::new(Modes::new(scene, count)?),
            Kind::Leapfrog { cells, courant } => Box::new(Leapfrog::new(scene, cells, courant)?),
            Kind::Steps { tolerance } => Box::new(Steps::new(scene, tolerance)?),
            _ => return Err(WayError::NeedsRecurrence(kind.name())),
        };
        Ok(Way { kind, inner: Ways::Model(model, place) })
    }

    /// Its name and settings.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// How far values can be off, in words.
    pub fn law(&self) -> String {
        match &self.inner {
            Ways::Method(method) => method.law(),
            Ways::Model(model, _) => format!("a model: {}", model.assumptions()),
        }
    }

    /// A proven bound on the absolute error of every value, beyond half a unit in its last place.
    pub fn bound(&self) -> Option<f64> {
        match &self.inner {
            Ways::Method(method) => method.bound(),
            Ways::Model(..) => None,
        }
    }

    /// The value at a time.
    ///
    /// # Errors
    /// [`WayError`], for times outside the window and left limits of models.
    pub fn value(&self, at: &Rational, side: Limit) -> Result<f64, WayError> {
        match &self.inner {
            Ways::Method(method) => Ok(method.value(at, side)?),
            Ways::Model(..) if side == Limit::Left => Err(WayError::LeftLimit(self.kind.name())),
            Ways::Model(model, place) => {
                let at = at.to_f64().unwrap_or(f64::NAN);
                Ok(model.values(*place, &[at])?[0])
            }
        }
    }

    /// The values at many times, just after arrivals.
    ///
    /// # Errors
    /// As [`Way::value`].
    pub fn values(&self, at: &[f64]) -> Result<Vec<f64>, WayError> {
        match &self.inner {
            Ways::Method(method) => {
                let mut values = vec![0.0; at.len()];
                method.values(at, &mut values)?;
                Ok(values)
            }
            Ways::Model(model, place) => Ok(model.values(*place, at)?),
        }
    }

    /// The values at many exact times.
    ///
    /// # Errors
    /// As [`Way::value`].
    pub fn exact_values(&self, at: &[Rational], side: Limit) -> Result<Vec<f64>, WayError> {
        match &self.inner {
            Ways::Model(model, place) if side == Limit::Right => {
                let at: Vec<f64> = at.iter().map(|at| at.to_f64().unwrap_or(f64::NAN)).collect();
                Ok(model.values(*place, &at)?)
            }
            Ways::Method(method) => Ok(method.exact_values(at, side)?),
            Ways::Model(..) => Err(WayError::LeftLimit(self.kind.name())),
        }
    }
}
