//! A piece step by step, as a lecturer derives it on the board.
//!
//! `PeriodByPeriod` solves for what is differentiated and forms no derivative; here derivatives of the
//! pieces before are formed and put in, so that the right side is seen, and the result is compared.

use crate::expression::Expression;
use crate::recurrence::{LinearForm, Recurrence, Step, WaveIndex, put_in, right_of};
use crate::solution::error::{SolveError, Unsolvable};
use crate::solution::general::GeneralForm;
use crate::solution::period::PeriodByPeriod;
use crate::solution::solved::Solution;
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
    let equations = put_in(recurrence.steps(), &recurrence.statement().time);
    let solved = equations
        .into_iter()
        .map(|(step, equation)| Solved { step, right: right_of(step, &equation) });
    solved.collect()
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

/// A sequence in general n put into its equation for `n + later`. Both sides hold `n` and a symbol for each `λ^n`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SequenceStep {
    pub later: usize,
    pub left: Expression,
    pub right: Expression,
    /// The symbols that stand for powers, each with its `λ`.
    pub powers: Vec<(Symbol, Expression)>,
}

impl SequenceStep {
    /// The step of a wave from its equation without slopes, where all waves in it are sequences.
    #[must_use]
    pub fn of(solution: &Solution, solved: &Solved<'_>, n: &Symbol) -> Option<SequenceStep> {
        let Solved { step, right: form } = solved;
        if step.start.is_some() || form.has_slopes() {
            return None;
        }
        let reaches = form.operators().map(|(_, operator)| operator.reach());
        let reach = reaches.chain([form.forcing_terms().reach(), 2]).max()?;
        let (later, mut powers) = (reach - 1, Vec::new());
        let left = later_by(solution, step.wave, later, n, &mut powers)?;
        let mut right = Expression::zero();
        for (wave, operator) in form.operators() {
            for (lag, factor) in operator.value.iter() {
                let value = later_by(solution, wave, later - lag, n, &mut powers)?;
                right.add_scaled(&value, factor);
            }
        }
        for load in form.forcing_terms().values() {
            right += (!load.contains(&solution.recurrence().statement().time)).then_some(load)?;
        }
        Some(SequenceStep { later, left, right, powers })
    }
}

/// The general form of a wave for `n + by`, where it is a sequence.
fn later_by(
    solution: &Solution,
    wave: WaveIndex,
    by: usize,
    n: &Symbol,
    powers: &mut Vec<(Symbol, Expression)>,
) -> Option<Expression> {
    let Ok(GeneralForm::Geometric(form)) = solution.general(wave) else { return None };
    let by = u32::try_from(by).ok()?;
    let later = &Expression::symbol(n) + &Expression::integer(by.into());
    let mut sum = Expression::zero();
    for term in &form.terms {
        let factor = &(&term.coefficient * &later.pow(term.power)) * &term.ratio.pow(by);
        let known = powers.iter().find(|(_, ratio)| *ratio == term.ratio);
        let power = match known.map(|(symbol, _)| symbol.clone()) {
            _ if term.ratio.is_one() => Expression::one(),
            Some(symbol) => Expression::symbol(&symbol),
            None => {
                let symbol = Symbol::new(&format!("power_{}", powers.len())).expect("a name");
                powers.push((symbol.clone(), term.ratio.clone()));
                Expression::symbol(&symbol)
            }
        };
        sum.add_scaled(&power, &factor);
    }
    Some(sum)
}
