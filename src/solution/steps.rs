//! A piece step by step, as a lecturer derives it on the board.
//!
//! `PeriodByPeriod` solves for what is differentiated and forms no derivative; here derivatives of the
//! pieces before are formed and put in, so that the right side is seen, and the result is compared.

use crate::expression::{Expression, Fraction};
use crate::recurrence::{LinearForm, Recurrence, Step, WaveIndex};
use crate::solution::error::{SolveError, Unsolvable};
use crate::solution::general::GeneralForm;
use crate::solution::period::PeriodByPeriod;
use crate::solution::solved::Solution;
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

/// A sequence in general n put into its equation for `n + later`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SequenceStep {
    pub later: usize,
    pub left: PowerSum,
    pub right: PowerSum,
}

/// A sum of powers `λ^n` with coefficients that hold `n`, none zero.
pub type PowerSum = Vec<(Expression, Expression)>;

impl SequenceStep {
    /// The step of a wave from its equation without slopes, where all waves in it are sequences.
    #[must_use]
    pub fn of(solution: &Solution, solved: &Solved<'_>, n: &Symbol) -> Option<SequenceStep> {
        if solved.step.start.is_some() || solved.right.has_slopes() {
            return None;
        }
        let reach = solved.right.operators().map(|(_, operator)| operator.reach()).max();
        let later = reach.unwrap_or(0).max(solved.right.forcing_terms().reach()).max(2) - 1;
        let (mut left, mut right) = (PowerSum::new(), PowerSum::new());
        let own = solved.step.wave;
        add_general(&mut left, solution, (own, later), n, &Expression::one())?;
        for (wave, operator) in solved.right.operators() {
            for (lag, factor) in operator.value.iter() {
                add_general(&mut right, solution, (wave, later - lag), n, factor)?;
            }
        }
        for function in solved.right.forcing_terms().values() {
            let constant = !function.contains(&solution.recurrence().statement().time);
            add_power(&mut right, &Expression::one(), constant.then_some(function)?);
        }
        for side in [&mut left, &mut right] {
            side.retain(|(_, coefficient)| !coefficient.is_zero());
            side.sort_by_key(|(ratio, _)| !ratio.is_one());
        }
        Some(SequenceStep { later, left, right })
    }

    /// Whether both sides are one sum, each power for itself.
    #[must_use]
    pub fn agrees(&self) -> bool {
        let (left, right) = (&self.left, &self.right);
        left.len() == right.len() && left.iter().all(|term| right.contains(term))
    }
}

fn add_power(sum: &mut PowerSum, ratio: &Expression, coefficient: &Expression) {
    match sum.iter_mut().find(|(known, _)| known == ratio) {
        Some((_, known)) => *known += coefficient,
        None => sum.push((ratio.clone(), coefficient.clone())),
    }
}

/// Adds a factor times the general form of a wave for `n + by`.
fn add_general(
    sum: &mut PowerSum,
    solution: &Solution,
    (wave, by): (WaveIndex, usize),
    n: &Symbol,
    factor: &Expression,
) -> Option<()> {
    let Ok(GeneralForm::Geometric(form)) = solution.general(wave) else { return None };
    let by = u32::try_from(by).ok()?;
    let later = &Expression::symbol(n) + &Expression::integer(by.into());
    for term in &form.terms {
        let power = &later.pow(term.power) * &term.ratio.pow(by);
        add_power(sum, &term.ratio, &(&(&term.coefficient * &power) * factor));
    }
    Some(())
}

/// Pieces derived step by step, period by period.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lesson<'a> {
    pub solved: Vec<Solved<'a>>,
    /// The periods with the steps of each solved equation.
    pub periods: Vec<(usize, Vec<PieceSteps>)>,
    /// Why it goes no further, where a piece has no exact form.
    pub stopped: Option<SolveError>,
}

impl<'a> Lesson<'a> {
    /// The periods `first … last`; those before are solved without telling how.
    #[must_use]
    pub fn of(recurrence: &'a Recurrence, first: usize, last: usize) -> Lesson<'a> {
        let solved = solved_for_waves(recurrence);
        let mut lesson = Lesson { solved, periods: Vec::new(), stopped: None };
        let mut solver = PeriodByPeriod::new(recurrence);
        for n in 0..=last {
            let told = solver.advance().and_then(|()| match n < first {
                true => Ok(Vec::new()),
                false => lesson.solved.iter().map(|solved| solver.steps(solved, n)).collect(),
            });
            match told {
                Ok(steps) if n >= first => lesson.periods.push((n, steps)),
                Ok(_) => {}
                Err(error) => {
                    lesson.stopped = Some(error);
                    break;
                }
            }
        }
        lesson
    }
}
