//! A way to the values of a question, made ready.

use crate::answer::method::Method;
use crate::answer::question::Question;
use crate::answer::reduced::{NotReduced, reduced};
use crate::answer::tolerance::Tolerance;
use crate::answer::weigh::Weighed;
use crate::ball::in_decimals;
use crate::model::{Leapfrog, Model, ModelError, Modes, Steps};
use crate::network::ScaledScene;
use crate::scene::Ideal;
use crate::signal::{
    Certified, Compiled, EvaluateError, Evaluator, Limit, Marched, MethodError, Summation, Summed,
    Table, values_of,
};
use num_traits::ToPrimitive as _;
use wavestep_polynomial::Rational;

/// Why a way has no values.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum WayError {
    #[error(transparent)]
    Method(#[from] MethodError),
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A model of bars without waves.
    #[error("the model \"{0}\" does not support this scene: {1}")]
    Reduced(&'static str, Box<NotReduced>),
    /// A model has no scene to be made of.
    #[error("{0} is a model for scenes of bars, and this is a recurrence")]
    NeedsScene(&'static str),
    /// A model knows no contacts that open, as those of this scene do.
    #[error("{0} is a model for closed contacts, and contacts open in this scene")]
    NeedsClosedContacts(&'static str),
    /// A method computes from the recurrence of a scene that has none.
    #[error("{0} is based on the exact solution, and none is known with a local contact")]
    NeedsRecurrence(&'static str),
    /// Models have values after arrivals only.
    #[error("{0} is a model without one-sided limits")]
    LeftLimit(&'static str),
    #[error("{} gives no number at {}", .0, in_decimals(.1))]
    NoNumber(Method, Rational),
    /// A tolerance is relative to values so small that doubles near them are too coarse, or are zero.
    #[error("the largest value in the window, at most {0:e}, is too small for doubles")]
    TooSmall(f64),
    /// No method is proven to be good enough.
    #[error("no double is proven to be within {tolerance}")]
    NotMet {
        /// The methods that were weighed.
        weighed: Box<Weighed>,
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

/// What is left out where bars are rigid, or springs.
const RIGID: &str = "Bars are rigid; all waves in them are neglected.";
const THIRD: &str = "Bars are strained uniformly at every time, with a third of their mass at the end that moves, or \
    half of it at both; waves are left out.";

/// A way that is ready to give values.
enum Ways<'a> {
    /// A method on the exact solution.
    Method(Box<dyn Evaluator + 'a>),
    /// A model, and the place of the observable in the scene.
    Model(Box<dyn Model>, usize),
    /// A scene without waves, and what it leaves out.
    Reduced(Table, &'static str),
}

/// A way to the values of a question.
pub struct Way<'a> {
    method: Method,
    inner: Ways<'a>,
}

impl<'a> Way<'a> {
    /// Makes a way ready. Methods that can be less exact at less cost take account of a tolerance, in
    /// the unit of the values.
    pub fn new(
        method: Method,
        question: &'a Question<'_>,
        tolerance: Option<f64>,
    ) -> Result<Way<'a>, WayError> {
        let signal = &*question.signal;
        let evaluator: Box<dyn Evaluator + 'a> = match method {
            Method::Certified => Box::new(Certified::new(signal)?),
            Method::Compiled => Box::new(Compiled::new(signal, tolerance)?),
            Method::Marched { proven: true } => Box::new(Marched::proven(signal)?),
            Method::Marched { proven: false } => Box::new(Marched::new(signal)?),
            Method::Stable(precision) => Box::new(Summed::new(signal, precision.into())?),
            Method::Plain => Box::new(Summed::new(signal, Summation::Plain)?),
            Method::Expanded => Box::new(Summed::new(signal, Summation::Expanded)?),
            Method::Rigid
            | Method::Third
            | Method::Modes { .. }
            | Method::Leapfrog { .. }
            | Method::Steps { .. } => {
                let (network, place) = question.scene.ok_or(WayError::NeedsScene(method.name()))?;
                if question.contacts_open {
                    return Err(WayError::NeedsClosedContacts(method.name()));
                }
                return Way::of_model(method, (network, place), signal.window());
            }
        };
        Ok(Way { method, inner: Ways::Method(evaluator) })
    }

    /// A model made ready on a window for the observable at this place of a scene, which needs no recurrence. Methods on
    /// the exact solution are refused.
    pub fn of_model(
        method: Method,
        (scene, place): (&ScaledScene, usize),
        window: [&Rational; 2],
    ) -> Result<Way<'a>, WayError> {
        let without_waves = |name, ideal: Ideal, left_out| {
            let table = reduced(name, (scene, place), &ideal, window)?;
            Ok(Way { method, inner: Ways::Reduced(table, left_out) })
        };
        let model: Box<dyn Model> = match method {
            Method::Rigid => return without_waves("rigid body", Ideal::Rigid, RIGID),
            Method::Third => {
                let spring = Ideal::Spring { share: None, rate: None };
                return without_waves("a third of the mass", spring, THIRD);
            }
            Method::Modes { count } => Box::new(Modes::new(scene, count)?),
            Method::Leapfrog { cells, courant } => Box::new(Leapfrog::new(scene, cells, courant)?),
            Method::Steps { tolerance } => Box::new(Steps::new(scene, tolerance)?),
            _ => return Err(WayError::NeedsRecurrence(method.name())),
        };
        Ok(Way { method, inner: Ways::Model(model, place) })
    }

    pub fn method(&self) -> Method {
        self.method
    }

    /// How far values can be off, in words.
    pub fn law(&self) -> String {
        match &self.inner {
            Ways::Method(evaluator) => evaluator.law(),
            Ways::Model(model, _) => format!("a model: {}", model.assumptions()),
            Ways::Reduced(_, left_out) => format!("a model: {left_out}"),
        }
    }

    /// A proven bound on the absolute error of every value, beyond half a unit in its last place.
    pub fn bound(&self) -> Option<f64> {
        match &self.inner {
            Ways::Method(evaluator) => evaluator.bound(),
            Ways::Model(..) | Ways::Reduced(..) => None,
        }
    }

    /// The value at a time of the window; models have no left limits.
    pub fn value(&self, at: &Rational, side: Limit) -> Result<f64, WayError> {
        match &self.inner {
            Ways::Method(evaluator) => Ok(evaluator.value(at, side)?),
            _ => Ok(self.exact_values(std::slice::from_ref(at), side)?[0]),
        }
    }

    /// The values at many times, just after arrivals.
    pub fn values(&self, at: &[f64]) -> Result<Vec<f64>, WayError> {
        let mut values = vec![0.0; at.len()];
        match &self.inner {
            Ways::Method(evaluator) => evaluator.values(at, &mut values)?,
            Ways::Model(model, place) => return Ok(model.values(*place, at)?),
            Ways::Reduced(table, _) => values_of(table, at, &mut values)?,
        }
        Ok(values)
    }

    pub fn exact_values(&self, at: &[Rational], side: Limit) -> Result<Vec<f64>, WayError> {
        match &self.inner {
            Ways::Method(evaluator) => Ok(evaluator.exact_values(at, side)?),
            _ if side == Limit::Left => Err(WayError::LeftLimit(self.method.name())),
            _ => {
                let at: Vec<f64> = at.iter().map(|at| at.to_f64().unwrap_or(f64::NAN)).collect();
                self.values(&at)
            }
        }
    }
}
