//! Certified: the double nearest to the exact value, ties to even.
//!
//! A value is enclosed in a ball, with precision doubled until both ends round to one double: Ziv's
//! loop. It ends, because zero and ties are rational numbers, and these are recognised exactly where a
//! first ball does not decide; any other value is irrational. Many values on a window come from polynomials whose low coefficients are pairs of doubles,
//! with a proven error of about `2^−95` of the largest value; those few that this does not decide are
//! enclosed one by one.
//!
//! Of a signal from which echoes are left out for a tolerance it gives the middle of a ball that is about as wide as these.

use super::doubles::{inside, table};
use super::{Evaluator, MethodError};
use crate::ball::{Attempt, Ball, Precisions, rational};
use crate::signal::cells::{Fit, Window, enclosure};
use crate::signal::digits::rational_value;
use crate::signal::error::EvaluateError;
use crate::signal::signal::{Limit, Signal};
use num_traits::ToPrimitive as _;
use std::cell::OnceCell;
use wavestep_kernels::Table;
use wavestep_kernels::fixed::ExactTime;
use wavestep_polynomial::Rational;

/// The degree of polynomials in pairs of doubles.
const DEGREE: usize = 23;

/// The error of polynomials that is aimed at, relative to the largest value.
const ERROR_BITS: i64 = 100;

/// The precision of balls tried first, and the highest.
const FIRST_BITS: u64 = 128;
const MAX_BITS: u64 = 1 << 13;

/// From how many values on polynomials pay: about what they cost over what a ball costs.
const MANY: usize = 2_000;

/// Correctly rounded values of an observable on a window.
pub struct Certified<'a> {
    window: Window<'a>,
    table: OnceCell<Table>,
}

impl<'a> Certified<'a> {
    /// Values of a signal on its window.
    pub fn new(signal: &'a dyn Signal) -> Result<Certified<'a>, MethodError> {
        let window = Window::new(signal).marching();
        if window.marched.is_none() {
            // Too many arrivals are refused at once.
            window.count()?;
        }
        Ok(Certified { window, table: OnceCell::new() })
    }

    /// Values that a march gives, and the places of those that it does not decide.
    fn by_march(&self, at: &[impl ExactTime], side: Limit) -> Option<(Vec<f64>, Vec<usize>)> {
        self.window.marched.as_ref()?.certified(at, side)
    }

    /// The polynomials in pairs of doubles, made when they are first asked for.
    pub fn table(&self) -> Result<&Table, MethodError> {
        if let Some(table) = self.table.get() {
            return Ok(table);
        }
        let error = self.window.scale_of_errors()?.scale(-ERROR_BITS);
        let table = table(&self.window.pieces(Fit { degree: DEGREE, error, rounding: None })?)?;
        Ok(self.table.get_or_init(|| table))
    }

    /// A value that no table decides.
    fn alone(&self, at: &Rational, side: Limit) -> Result<f64, MethodError> {
        match self.rounded(at, side, &*enclosure(self.window.signal, at, side)?) {
            // Digits at one time can be had where a search for stretches stops.
            Err(EvaluateError::AccuracyNotReached { .. } | EvaluateError::NotFollowed { .. }) => {
                let point = self.window.signal.point(at, side)?;
                Ok(self.rounded(at, side, &*point.enclose)?)
            }
            value => Ok(value?),
        }
    }

    /// The double that enclosures of rising precision round to, or that is nearest to the middle of one that is as narrow
    /// as what is left out allows.
    fn rounded(
        &self,
        at: &Rational,
        side: Limit,
        enclose: &dyn Fn(u64) -> Result<Ball, EvaluateError>,
    ) -> Result<f64, EvaluateError> {
        let attempt = |bits| {
            let ball = enclose(bits)?;
            if let Some(value) = ball.rounded() {
                return Ok(Attempt::Done(value));
            }
            if self.window.knows_all(&ball) {
                return Ok(Attempt::Done(ball.midpoint().to_double()));
            }
            // Rational numbers alone can be zero or half-way between two doubles.
            if bits == FIRST_BITS
                && let Some(value) = rational_value(self.window.signal, at, side)?
            {
                return Ok(Attempt::Done(value.to_f64().unwrap_or(f64::NAN)));
            }
            if rounds_to_zero(&ball) {
                return Ok(Attempt::Done(0.0));
            }
            Ok(Attempt::NotYet(EvaluateError::AccuracyNotReached { best: Box::new(ball), bits }))
        };
        Precisions::doubling(FIRST_BITS, MAX_BITS).raise(attempt).and_then(Attempt::done)
    }
}

/// Whether all points of a ball round to zero, from one side or the other.
fn rounds_to_zero(ball: &Ball) -> bool {
    let (lower, upper) = ball.endpoints();
    lower.to_double() == 0.0 && upper.to_double() == 0.0
}

impl Evaluator for Certified<'_> {
    fn law(&self) -> String {
        match self.bound() {
            Some(bound) if bound > 0.0 => {
                format!(
                    "at most {bound:.1e} everywhere on the window, proven: what echoes that are left out come to"
                )
            }
            _ => "correctly rounded, proven".to_owned(),
        }
    }

    fn bound(&self) -> Option<f64> {
        // A ball is as wide as what is left out, and at most as much again.
        Some(self.window.signal.left_out().scale(1).to_double())
    }

    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError> {
        Ok(self.exact_values(std::slice::from_ref(at), side)?[0])
    }

    /// By the march in integers, where there is one, and by a ball where that does not decide.
    fn exact_values(&self, at: &[Rational], side: Limit) -> Result<Vec<f64>, MethodError> {
        let [from, to] = self.window.signal.window();
        let is_inside = at.iter().all(|at| at >= from && at <= to);
        let marched = is_inside.then(|| self.by_march(at, side)).flatten();
        let Some((mut values, undecided)) = marched else {
            return at.iter().map(|at| self.alone(at, side)).collect();
        };
        for i in undecided {
            values[i] = self.alone(&at[i], side)?;
        }
        Ok(values)
    }

    fn values(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError> {
        assert_eq!(at.len(), values.len(), "a place for each value");
        let undecided: Vec<usize> = match at.len() {
            0..MANY => {
                let is_inside = inside(at, self.window.signal.window()).is_ok();
                match is_inside.then(|| self.by_march(at, Limit::Right)).flatten() {
                    Some((found, undecided)) => {
                        values.copy_from_slice(&found);
                        undecided
                    }
                    None => (0..at.len()).collect(),
                }
            }
            _ if !self.window.signal.left_out().is_zero() => (0..at.len()).collect(),
            _ => self.table()?.evaluator().rounded(at, values),
        };
        for i in undecided {
            if !at[i].is_finite() {
                return Err(MethodError::Outside);
            }
            values[i] = self.alone(&rational(at[i]), Limit::Right)?;
        }
        if values.iter().any(|value| value.is_nan()) { Err(MethodError::Outside) } else { Ok(()) }
    }
}
