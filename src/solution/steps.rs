//! A piece step by step, as a lecturer derives it on the board.
//!
//! `PeriodByPeriod` solves for what is differentiated and forms no derivative; here derivatives of the
//! pieces before are formed and put in, so that the right side is seen, and the result is compared.

use crate::expression::{Expression, Fraction};
use crate::recurrence::{LinearForm, Recurrence, Step, WaveIndex};
use crate::solution::error::{SolveError, Unsolvable};
use crate::solution::period::PeriodByPeriod;
use crate::solution::template::{EchoTemplate, Family};
use wavestep_polynomial::Symbol;

/// An equation solved for its wave: `w' + a w = right`, or `w = right` where nothing is differentiated.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Solved<'a> {
    pub step: &'a Step,
    /// What is known on the right; waves that are given by others are put in.
    pub right: LinearForm,
}

/// The equations of a recurrence, each solved for its wave, in solving order.
#[must_use]
pub fn solved_for_waves(recurrence: &Recurrence) -> Vec<Solved<'_>> {
    let mut all = Vec::new();
    let mut explicit: Vec<(WaveIndex, LinearForm)> = Vec::new();
    for step in recurrence.steps() {
        let mut equation = step.equation.clone();
        for (wave, solved) in explicit.iter().rev() {
            let mut put_in = equation.clone();
            if put_in.replace(*wave, solved, &recurrence.statement().time) {
                equation = put_in;
            }
        }
        let mut right = -&equation;
        right.add_scaled(&step.left(), &Expression::one(), 0);
        if step.start.is_none() && !right.operators().any(|(wave, _)| wave == step.wave) {
            explicit.push((step.wave, right.clone()));
        }
        all.push(Solved { step, right });
    }
    all
}

/// How a wave follows on one period from what is known.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PieceSteps {
    /// The right side of the solved equation with the known pieces put in.
    pub right: Expression,
    /// The integration; none where the piece is the right side.
    pub integration: Option<Integration>,
    pub piece: Expression,
}

/// How `w' + a w = right` is integrated over a period, `x` the local time:
///
/// ```text
/// (e^{ax} w)' = e^{ax} right,     e^{ax} w = w(0) + ∫_0^x e^{au} right(u) du
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Integration {
    /// `e^{ax} right`.
    pub integrand: Expression,
    /// Its integral from 0 to x.
    pub integral: Expression,
    /// What stands beside `w` in the continuous form at the beginning of the period.
    pub beside: Expression,
    /// The value of that form before: at the end of the last period, or its start.
    pub before: Expression,
    /// `w(0) = before − beside`.
    pub constant: Expression,
}

impl PeriodByPeriod<'_> {
    /// The steps by which a wave follows on a period that has been solved.
    pub fn steps(&mut self, solved: &Solved<'_>, n: usize) -> Result<PieceSteps, SolveError> {
        let (recurrence, wave) = (self.recurrence, solved.step.wave);
        self.integrated(solved, n).map_err(|reason| SolveError::new(recurrence, wave, n, reason))
    }

    fn integrated(&mut self, solved: &Solved<'_>, n: usize) -> Result<PieceSteps, Unsolvable> {
        let statement = self.recurrence.statement();
        let right = self.value_of(&solved.right, n)?;
        let Some(start) = &solved.step.start else {
            return Ok(PieceSteps { piece: right.clone(), right, integration: None });
        };
        let before = match n {
            0 => start.initial.clone(),
            _ => self.end_of_form(&start.continuous, n - 1)?,
        };
        let beside = self.start_of_form(&start.continuous, solved.step.wave, n)?;
        let constant = &before - &beside;
        let (x, exponent) = (&statement.local, start.exponent(&statement.local));
        let integrand = right.clone().times_exponential(&exponent);
        let integral = integrand.antiderivative(x, &statement.assumptions)?;
        let piece = (&constant + &integral).times_exponential(&-&exponent);
        let integration = Integration { integrand, integral, beside, before, constant };
        Ok(PieceSteps { right, integration: Some(integration), piece })
    }
}

/// The equation by which each echo follows from the one before,
///
/// ```text
/// φ_{k+1}' + b φ_{k+1} = ρ (φ_k' − a φ_k),     φ_{k+1}(0) = ρ φ_k(0)      Laguerre, a = c − b
/// φ_{k+1}' + b φ_{k+1} = ρ φ_k,                φ_{k+1}(0) = 0             Power
/// ```
///
/// It holds from the first echo of the general form on. On the coefficients of `T_k`, after division by
/// `ρ^{k+1} e^{−bx}`, it is Pascal's rule.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct EchoStep {
    pub rate: Fraction,
    pub ratio: Fraction,
    /// `c` of the Laguerre polynomials `L_k(c x)`; none for powers.
    pub scale: Option<Fraction>,
}

impl EchoStep {
    /// The step of a general form, where anything returns.
    #[must_use]
    pub fn of(template: &EchoTemplate) -> Option<EchoStep> {
        let scale = match &template.family {
            Family::Laguerre(scale) => Some(scale.clone()),
            Family::Power => None,
        };
        let (rate, ratio) = (template.rate.clone(), template.ratio.clone());
        (!template.terms.is_empty()).then_some(EchoStep { rate, ratio, scale })
    }

    /// The coefficients of `φ_k'` and of `φ_k` on the right side.
    #[must_use]
    pub fn right(&self) -> (Fraction, Fraction) {
        match &self.scale {
            Some(scale) => (self.ratio.clone(), &self.ratio * &(&self.rate - scale)),
            None => (Fraction::zero(), self.ratio.clone()),
        }
    }

    /// Whether an echo follows from the one before.
    #[must_use]
    pub fn leads(&self, before: &Expression, to: &Expression, x: &Symbol) -> bool {
        let (slope, value) = self.right();
        let left = &to.derivative(x) + &to.times(&self.rate);
        let right = &before.derivative(x).times(&slope) + &before.times(&value);
        left == right && to.at_zero(x) == before.at_zero(x).times(&slope)
    }
}
