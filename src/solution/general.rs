//! Waves for every n at once.

use crate::expression::{Assumptions, Expression};
use crate::recurrence::{LinearForm, Recurrence, Step, WaveIndex};
use crate::solution::demand::Demand;
use crate::solution::echo::EchoByEcho;
use crate::solution::elimination::{Reduced, reduce};
use crate::solution::geometric::{Generating, Geometric, constant_forcing, product};
use crate::solution::template::{EchoTemplate, OnePole, multiplier};
use wavestep_polynomial::{Polynomial, Symbol};

/// A wave in general n.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum GeneralForm {
    /// Its values are constant on each period, and this sequence.
    Geometric(Geometric),
    /// Its echoes are of this form.
    Echoes(Box<EchoTemplate>),
}

/// The most echoes that are listed before the general form begins.
const MAX_FIRST: usize = 32;

/// How a general form was proved.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Proof {
    /// It satisfies the recurrence with each `λ^n` a symbol of its own, and the first values.
    Substitution,
    /// Beyond the first echoes each follows from the one before by the same operator
    /// `ρ(p−a)/(p+b)`, on both sides; on the coefficients of Laguerre polynomials that is Pascal's
    /// rule. One derived echo was compared.
    CoefficientIdentity,
}

/// No closed form in n was found, because of this equation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Unknown {
    /// The equation, a form that is zero, after elimination of explicit waves.
    pub equation: LinearForm,
}

impl GeneralForm {
    pub fn proof(&self) -> Proof {
        match self {
            GeneralForm::Geometric(_) => Proof::Substitution,
            GeneralForm::Echoes(_) => Proof::CoefficientIdentity,
        }
    }

    /// The general form of a wave.
    pub(crate) fn of(recurrence: &Recurrence, wave: WaveIndex) -> Result<GeneralForm, Unknown> {
        let step = recurrence.steps().iter().find(|step| step.wave == wave);
        let own = || step.map(|step| step.equation.clone()).unwrap_or_default();
        // Elimination over all periods may multiply a coefficient from every step.
        let small = recurrence.degree_estimate(2) <= u64::from(Polynomial::MAX_EXPONENT);
        let Some(reduced) = small.then(|| reduce(recurrence)).flatten() else {
            return Err(Unknown { equation: own() });
        };
        let form = reduced.form_of(wave);
        let bases: Vec<WaveIndex> = form.operators().map(|(base, _)| base).collect();
        let found = match &bases[..] {
            [] => constant_sequence(&form, recurrence),
            [base] => match reduced.lone_step(*base) {
                Some(step) if step.start.is_none() => sequence(step, &form, recurrence),
                Some(step) => echoes(step, &form, recurrence, wave),
                None => None,
            },
            _ => None,
        };
        found.ok_or_else(|| Unknown { equation: equation_of(&reduced, &bases).unwrap_or_else(own) })
    }
}

fn equation_of(reduced: &Reduced, bases: &[WaveIndex]) -> Option<LinearForm> {
    let base = bases.first()?;
    let step = reduced.base.iter().find(|step| step.wave == *base)?;
    Some(step.equation.clone())
}

fn context(recurrence: &Recurrence) -> (&Assumptions, &Symbol) {
    let statement = recurrence.statement();
    (&statement.assumptions, &statement.time)
}

/// A wave given by forcing alone.
fn constant_sequence(form: &LinearForm, recurrence: &Recurrence) -> Option<GeneralForm> {
    let (assumptions, time) = context(recurrence);
    let none = Generating { numerator: Vec::new(), denominator: vec![Expression::one()] };
    let constants = constant_forcing(form.forcing_terms(), time)?;
    none.combined(&[], &constants).closed_form(assumptions).map(GeneralForm::Geometric)
}

/// `A(q) w + F(q)/(1−q) = 0`, and the wave is a combination of delayed copies of `w`.
fn sequence(step: &Step, form: &LinearForm, recurrence: &Recurrence) -> Option<GeneralForm> {
    let (assumptions, time) = context(recurrence);
    let operator = step.equation.operator(step.wave);
    if step.equation.has_slopes() {
        return None;
    }
    let forcing = constant_forcing(step.equation.forcing_terms(), time)?;
    let one_minus_q = [Expression::one(), Expression::integer(-1)];
    let base = Generating {
        numerator: forcing.iter().map(|value| -value).collect(),
        denominator: product(&operator.value.dense(), &one_minus_q),
    };
    let constants = constant_forcing(form.forcing_terms(), time)?;
    let combined = base.combined(&multiplier(form, step.wave)?, &constants);
    combined.closed_form(assumptions).map(GeneralForm::Geometric)
}

/// One pole and one lag, and the wave is a combination of delayed copies.
fn echoes(
    step: &Step,
    form: &LinearForm,
    recurrence: &Recurrence,
    wave: WaveIndex,
) -> Option<GeneralForm> {
    let (assumptions, time) = context(recurrence);
    let pole = OnePole::of(step, assumptions, time)?;
    let (template, from) = pole.template(&multiplier(form, step.wave)?)?;
    let count = from.max(form.forcing_terms().reach());
    if count > MAX_FIRST {
        return None;
    }
    // Echoes of this wave alone are compared.
    let mut demand = Demand::none(recurrence);
    (0..count + 2).for_each(|k| demand.add(recurrence, wave, k));
    let mut solver = EchoByEcho::new(recurrence).wanting(demand);
    for _ in 0..count + 2 {
        solver.advance().ok()?;
    }
    let mut first = solver.sum(wave).echoes;
    let later = first.split_off(count);
    let template = EchoTemplate { first, ..template };
    // Beyond the largest lag each echo follows from the one before by (p−a)/(p+b), so that one
    // agreement carries over to all; a second one costs little.
    let local = &recurrence.statement().local;
    let agrees = |(k, echo): (usize, &Expression)| template.echo(k, local) == *echo;
    if !(count..).zip(&later).all(agrees) {
        return None;
    }
    Some(GeneralForm::Echoes(Box::new(template)))
}
