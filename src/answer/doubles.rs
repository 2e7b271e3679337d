//! Values in doubles: by a method that is named, or by the cheapest that is proven to be good enough.

use crate::answer::method::Method;
use crate::answer::question::Question;
use crate::answer::tolerance::Tolerance;
use crate::answer::way::{Way, WayError};
use crate::answer::weigh::{Weighed, consider};
use crate::signal::{EchoCount, EvaluateError, Limit};
use std::cell::OnceCell;
use wavestep_polynomial::Rational;

/// The most times at which a method without a proven bound is compared with certified values.
const COMPARED: usize = 50;

/// How near values are to be.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Accuracy {
    /// Every digit asked for is proven.
    Digits,
    /// Doubles, by the cheapest method that is proven to be within a tolerance.
    Within(Tolerance),
    /// Doubles by this method, held against a tolerance where one is given.
    Method(Method, Option<Tolerance>),
}

/// Values in doubles.
///
/// ```
/// use wavestep::{Problem, Tolerance};
///
/// let mass = Problem::builtin("rigid-mass")?.with("mu", 1)?;
/// let found = mass.signal("strain_fixed")?.values(&[1, 3, 5], Tolerance::Relative(1e-9))?;
/// assert!(found.bound.is_some_and(|bound| bound < 3e-9));
/// assert!((found.values[1] + 2.0 + 2.0 * (-2_f64).exp()).abs() < 3e-9);
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Doubles {
    /// The method they were computed by.
    pub method: Method,
    /// How far they can be off, in words.
    pub law: String,
    /// A proven bound on the absolute error, beyond half a unit in the last place.
    pub bound: Option<f64>,
    /// One for each time.
    pub values: Vec<f64>,
    /// How many echoes there are, where some may be left out.
    #[doc(hidden)]
    pub echoes: Option<EchoCount>,
    /// What is to be known of them, in this order.
    #[doc(hidden)]
    pub remarks: Vec<Remark>,
}

/// What is to be known of values in doubles.
#[derive(Clone, PartialEq, Debug)]
pub enum Remark {
    /// The methods that were weighed, and the tolerance in the unit of the values.
    Weighed(Weighed, f64),
    /// The method was asked for by name.
    AsAskedFor,
    /// The law of a model says how far it can be off.
    Law,
    /// This method did not keep its promise, so that values were certified.
    PromiseNotKept(Method),
    /// The bound that was proven is larger than the tolerance.
    BoundTooLarge(f64),
    /// The method is off by so much at this time, more than the tolerance.
    Off(f64, Rational),
    /// The method is off by at most so much at so many of the times.
    OffAtMost(f64, usize),
    /// Values are tested, not certified.
    Tested(Tested),
    /// The exact solution with this spring is near.
    NearSpring(String),
}

/// With this local contact, or with contacts that open, values are tested, not certified.
#[derive(Clone, PartialEq, Debug)]
pub struct Tested {
    pub contact: Option<String>,
    /// To how much of the largest value.
    pub tolerance: f64,
    /// Where contacts open, by how much values change at most where all is changed by [`Tested::NUDGE`] whenever a contact
    /// opens or closes: each may magnify what was off before.
    pub differs: Option<f64>,
}

impl Tested {
    /// A change that is larger than rounding.
    pub const NUDGE: f64 = 1e-15;
}

/// The values of a question at times of its window; refused where no method is good enough, or the
/// one that is named has no values here.
pub fn doubles(
    question: &Question<'_>,
    times: &[Rational],
    limit: Limit,
    accuracy: Accuracy,
) -> Result<Doubles, WayError> {
    let cut = match accuracy {
        Accuracy::Within(tolerance) => cut(question, tolerance)?,
        _ => None,
    };
    let mut choice =
        Choice { whole: question, cut: cut.as_ref(), scale: OnceCell::new(), remarks: Vec::new() };
    let way = match accuracy {
        Accuracy::Method(method, tolerance) => choice.named(method, tolerance)?,
        Accuracy::Within(tolerance) => choice.cheapest(times.len(), tolerance)?,
        Accuracy::Digits => Way::new(Method::Certified, question, None)?,
    };
    let values = way.exact_values(times, limit)?;
    if let Some(i) = values.iter().position(|value| !value.is_finite()) {
        return Err(WayError::NoNumber(way.method(), times[i].clone()));
    }
    if let (Accuracy::Method(_, Some(tolerance)), None) = (accuracy, way.bound()) {
        choice.compare(tolerance, (times, limit, &values))?;
    }
    let remarks = choice.remarks;
    let echoes = cut.as_ref().and_then(|cut| cut.question.signal.echoes());
    Ok(Doubles {
        method: way.method(),
        law: way.law(),
        bound: way.bound(),
        values,
        echoes,
        remarks,
    })
}

/// The part of a tolerance that echoes may come to which are left out, and of the largest value what may be unknown of it.
const LEFT_OUT: f64 = 1.0 / 8.0;
const UNSURE: f64 = 1.0 / 16.0;

/// How often the largest value is looked for with more echoes.
const MOST_LOOKS: usize = 12;

/// A question without the echoes that cannot matter, and its largest value.
struct Cut<'a> {
    question: Question<'a>,
    scale: f64,
}

/// Leaves out what cannot matter for a tolerance. What a relative one is relative to is found without more echoes: the
/// largest value `m` is at most the sum of all shares; where echoes of `δ·M/8` are left out for an `M ≥ m`, none is worked
/// out that `δ·m` does not need. `None` where no echo can be left out, or the largest value is not told so.
fn cut<'a>(
    question: &'a Question<'_>,
    tolerance: Tolerance,
) -> Result<Option<Cut<'a>>, EvaluateError> {
    let most = |scale: f64| tolerance.absolute(scale) * LEFT_OUT;
    let mut allowed = match tolerance {
        Tolerance::Absolute(tolerance) => tolerance * LEFT_OUT,
        // All that can be left out.
        _ => match question.within(f64::MAX)? {
            Some(nothing) => most(nothing.signal.left_out().to_double()),
            None => return Ok(None),
        },
    };
    for _ in 0..MOST_LOOKS {
        let Some(found) = question.within(allowed)? else { return Ok(None) };
        let (scale, rest) = (found.scale()?, found.signal.left_out().to_double());
        let is_told = matches!(tolerance, Tolerance::Absolute(_)) || rest <= scale * UNSURE;
        if !is_told {
            allowed = most(scale + rest).min(allowed / 4.0);
            continue;
        }
        // The largest value is not smaller.
        let scale = (scale - rest).max(0.0);
        // What is worked out is enough, where no more than that is left out; else more is, or all of it.
        return match tolerance {
            Tolerance::Absolute(_) => Ok(Some(Cut { question: found, scale })),
            _ if rest <= most(scale) => Ok(Some(Cut { question: found, scale })),
            _ => Ok(question.within(most(scale))?.map(|question| Cut { question, scale })),
        };
    }
    Ok(None)
}

/// What values of a window have to reach for a tolerance to be relative to them: sizes below `2^−1000` are
/// told as `2^−1000`, and doubles have fewer than 53 bits below `2^−1022`.
const LEAST_SCALE: f64 = f64::from_bits((1023 - 900) << 52);

/// The choice of a method, and what is to be known of it.
struct Choice<'p, 'a> {
    whole: &'p Question<'a>,
    /// Without what cannot matter for the tolerance.
    cut: Option<&'p Cut<'p>>,
    /// The size of the largest value, once it was asked for.
    scale: OnceCell<f64>,
    remarks: Vec<Remark>,
}

impl<'p> Choice<'p, '_> {
    fn scale(&self) -> Result<f64, WayError> {
        if let Some(scale) = self.scale.get() {
            return Ok(*scale);
        }
        let scale = match self.cut {
            Some(cut) => cut.scale,
            None => self.whole.scale()?,
        };
        Ok(*self.scale.get_or_init(|| scale))
    }

    /// A tolerance in the unit of the values.
    fn absolute(&self, tolerance: Tolerance) -> Result<f64, WayError> {
        Ok(match tolerance {
            Tolerance::Absolute(tolerance) => tolerance,
            relative => match self.scale()? {
                // Where all is zero any tolerance is met.
                0.0 => f64::MIN_POSITIVE.max(relative.absolute(1.0)),
                scale if scale < LEAST_SCALE => return Err(WayError::TooSmall(scale)),
                scale => relative.absolute(scale),
            },
        })
    }

    fn named(&mut self, method: Method, tolerance: Option<Tolerance>) -> Result<Way<'p>, WayError> {
        let absolute = tolerance.map(|tolerance| self.absolute(tolerance)).transpose()?;
        let way = Way::new(method, self.whole, absolute)?;
        self.remarks.push(Remark::AsAskedFor);
        if let (Some(bound), Some(absolute)) = (way.bound(), absolute)
            && bound > absolute
        {
            self.remarks.push(Remark::BoundTooLarge(bound));
        }
        Ok(way)
    }

    /// The cheapest method that is proven to be good enough.
    fn cheapest(&mut self, points: usize, tolerance: Tolerance) -> Result<Way<'p>, WayError> {
        let absolute = self.absolute(tolerance)?;
        let question = self.cut.map_or(self.whole, |cut| &cut.question);
        let weighed = consider(question, points, absolute, self.scale()?)?;
        if !weighed.met {
            return Err(WayError::NotMet { weighed: Box::new(weighed), tolerance, absolute });
        }
        let method = weighed.candidates[0].method;
        self.remarks.push(Remark::Weighed(weighed, absolute));
        let way = Way::new(method, question, Some(absolute))?;
        // A promise is kept but where functions are unusually steep.
        match way.bound() {
            Some(bound) if bound <= absolute => Ok(way),
            _ => {
                self.remarks.push(Remark::PromiseNotKept(method));
                Way::new(Method::Certified, self.whole, None)
            }
        }
    }

    /// Compares a method without a proven bound with certified values.
    fn compare(
        &mut self,
        tolerance: Tolerance,
        (times, limit, values): (&[Rational], Limit, &[f64]),
    ) -> Result<(), WayError> {
        let certified = Way::new(Method::Certified, self.whole, None)?;
        let stride = times.len().div_ceil(COMPARED).max(1);
        let (mut worst, mut error) = (0, 0.0);
        let mut scale = 0.0_f64;
        for i in (0..times.len()).step_by(stride) {
            let exact = certified.value(&times[i], limit)?;
            scale = scale.max(exact.abs());
            // What is no number is off by more than any.
            let off = if values[i].is_finite() { (values[i] - exact).abs() } else { f64::INFINITY };
            if off > error {
                (worst, error) = (i, off);
            }
        }
        let absolute = match tolerance {
            Tolerance::Absolute(tolerance) => tolerance,
            relative => relative.absolute(self.scale().unwrap_or(scale).max(scale)),
        };
        self.remarks.push(match error > absolute {
            true => Remark::Off(error, times[worst].clone()),
            false => Remark::OffAtMost(error, times.len().div_ceil(stride)),
        });
        Ok(())
    }
}
