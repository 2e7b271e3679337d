//! Elimination on one period: from equations in any order to steps that solve one wave each.
//!
//! Only what happens on the current period matters here; earlier pieces are known whatever they
//! are. An algebraic equation may be added, with a factor and also differentiated, to another one,
//! until each equation has one unknown left.

use crate::expression::{Assumptions, Expression, Fraction};
use crate::recurrence::WaveIndex;
use crate::recurrence::coupled::{Stuck, Uncoupled, uncouple};
use crate::recurrence::form::LinearForm;
use crate::recurrence::naming::Naming;
use crate::recurrence::statement::{Clause, Continuity, Fault, InvalidRecurrence, Statement};
use std::collections::BTreeSet;
use wavestep_polynomial::Symbol;

/// The equation of one wave on the n-th period.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Step {
    pub wave: WaveIndex,
    /// A form that is zero, without sums. At lag 0 it holds `wave`, with coefficient 1 on its
    /// slope (differential) or, without a slope, on its value (algebraic), and waves of earlier
    /// steps.
    pub equation: LinearForm,
    /// The start on each period; `None` for an algebraic step.
    pub start: Option<Start>,
}

/// How a differential step starts on each period.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Start {
    /// The rate `a` in `w' + a w`.
    pub rate: Fraction,
    /// A continuous form; at lag 0 it holds the step's wave with coefficient 1 and waves of
    /// earlier steps.
    pub continuous: LinearForm,
    /// The value of that form at `t = 0+`.
    pub initial: Expression,
}

impl Step {
    /// The left side of the equation solved for the wave: `w' + a w`, or `w`.
    pub(crate) fn left(&self) -> LinearForm {
        let Some(start) = &self.start else { return LinearForm::wave(self.wave, 0) };
        let mut left = LinearForm::slope(self.wave, 0);
        left.add_scaled(&LinearForm::wave(self.wave, 0), &start.rate.clone().into(), 0);
        left
    }
}

impl Start {
    /// The exponent `a x` of the integrating factor.
    pub(crate) fn exponent(&self, x: &Symbol) -> Fraction {
        &self.rate * &Fraction::symbol(x)
    }
}

type Outcome<T> = Result<T, InvalidRecurrence>;

fn refuse<T>(clause: Clause, fault: Fault) -> Outcome<T> {
    Err(InvalidRecurrence { clause, fault })
}

fn invert(assumptions: &Assumptions, value: &Expression, clause: Clause) -> Outcome<Expression> {
    assumptions
        .invert(value)
        .map_err(|reason| InvalidRecurrence { clause, fault: Fault::NotInvertible(reason) })
}

/// One row of the elimination: a form, and the clause of the statement it stands for.
struct Row {
    form: LinearForm,
    clause: Clause,
}

/// A statement in solving order.
pub(crate) struct Ordered {
    pub steps: Vec<Step>,
    /// How many waves were added to those stated.
    pub hidden: usize,
    /// The constants of the statement, and those that were named.
    pub naming: Naming,
    pub coupled: Vec<Coupled>,
}

/// Waves whose differential equations are coupled, and the rates `a` at which they decay together:
/// they are sums of `e^{−at}` where nothing else arrives.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Coupled {
    pub waves: Vec<WaveIndex>,
    /// The rates, with their multiplicities.
    pub rates: Vec<Fraction>,
}

/// The steps of a statement, in solving order.
pub(crate) fn order(statement: &Statement) -> Outcome<Ordered> {
    let count = Fault::Count { equations: statement.equations.len(), waves: statement.waves.len() };
    match statement.equations.len().cmp(&statement.waves.len()) {
        std::cmp::Ordering::Less => {
            return refuse(Clause::Wave(statement.waves.len().saturating_sub(1)), count);
        }
        std::cmp::Ordering::Greater => {
            return refuse(Clause::Equation(statement.waves.len()), count);
        }
        std::cmp::Ordering::Equal => {}
    }
    let equations = statement.equations.iter().enumerate();
    let mut rows = equations
        .map(|(i, form)| Row { form: form.without_sums(), clause: Clause::Equation(i) })
        .collect();
    let rules = statement.continuity.iter().enumerate();
    let mut rules: Vec<(Row, Expression)> = rules
        .map(|(i, rule)| {
            let row = Row { form: rule.form.clone(), clause: Clause::Continuity(i) };
            let bare = rule.form.operators().all(|(_, o)| o.slope.is_empty() && o.sum.is_empty());
            if bare {
                Ok((row, rule.start.clone()))
            } else {
                refuse(row.clause, Fault::ContinuityOfSlope)
            }
        })
        .collect::<Outcome<_>>()?;
    let mut naming = Naming::new(statement);
    let mut coupled = Vec::new();
    let (steps, hidden) = order_equations(statement, &mut rows, &mut naming, &mut coupled)?;
    let steps = assign_starts(statement, steps, &mut rules)?;
    Ok(Ordered { steps, hidden, naming, coupled })
}

/// Takes a row that has one unknown on the current period, while there is one; else eliminates an
/// unknown with an algebraic row; else uncouples rows with derivatives.
fn order_equations(
    statement: &Statement,
    rows: &mut Vec<Row>,
    naming: &mut Naming,
    coupled: &mut Vec<Coupled>,
) -> Outcome<(Vec<Step>, usize)> {
    let mut unknown: BTreeSet<WaveIndex> = (0..statement.waves.len()).collect();
    let mut eliminated = BTreeSet::new();
    let mut steps = Vec::new();
    let mut hidden = 0;
    while !rows.is_empty() {
        let unknowns = |row: &Row| -> Vec<_> {
            row.form.waves_now().filter(|wave| unknown.contains(wave)).collect()
        };
        let open: Vec<Vec<WaveIndex>> = rows.iter().map(unknowns).collect();
        if let Some(i) = open.iter().position(Vec::is_empty) {
            return refuse(rows[i].clause, Fault::DeterminesNothing);
        }
        if let Some(i) = open.iter().position(|waves| waves.len() == 1) {
            let wave = open[i][0];
            let row = rows.remove(i);
            let operator = row.form.operator(wave);
            let slope = operator.slope_now();
            let leading = if slope.is_zero() { operator.value_now() } else { slope };
            let inverse = invert(&statement.assumptions, &leading, row.clause)?;
            steps.push((
                Step { wave, equation: row.form.scaled(&inverse), start: None },
                row.clause,
            ));
            unknown.remove(&wave);
            continue;
        }
        let usable = |row: &Row| !row.form.has_slopes() && !eliminated.contains(&part_key(row));
        let pivot =
            open.iter().enumerate().filter(|(i, _)| usable(&rows[*i])).find_map(|(i, waves)| {
                let invertible = |wave: &&WaveIndex| {
                    statement.assumptions.invert(&rows[i].form.operator(**wave).value_now()).is_ok()
                };
                waves.iter().find(invertible).map(|wave| (i, *wave))
            });
        let Some((pivot, wave)) = pivot else {
            let next_hidden = statement.waves.len() + hidden;
            let found = uncouple_some(statement, rows, &open, next_hidden, naming)?;
            hidden += found.hidden;
            coupled.push(found.coupled);
            for (wave, equation) in found.steps {
                unknown.remove(&wave);
                steps.push((Step { wave, equation, start: None }, found.clause));
            }
            continue;
        };
        eliminated.insert(part_key(&rows[pivot]));
        let leading = rows[pivot].form.operator(wave).value_now();
        let inverse = invert(&statement.assumptions, &leading, rows[pivot].clause)?;
        let solved = rows[pivot].form.scaled(&-&inverse);
        let derived = solved.derivative(&statement.time);
        for (i, row) in rows.iter_mut().enumerate() {
            if i != pivot {
                let operator = row.form.operator(wave);
                row.form.add_scaled(&solved, &operator.value_now(), 0);
                row.form.add_scaled(&derived, &operator.slope_now(), 0);
            }
        }
    }
    let steps = steps.into_iter().map(|(step, clause)| with_rate(step, clause));
    Ok((steps.collect::<Outcome<_>>()?, hidden))
}

/// Steps for rows that were coupled by their derivatives.
struct Found {
    steps: Vec<(WaveIndex, LinearForm)>,
    hidden: usize,
    clause: Clause,
    coupled: Coupled,
}

/// Takes the fewest rows with derivatives that have as many unknowns as they are, and uncouples them.
fn uncouple_some(
    statement: &Statement,
    rows: &mut Vec<Row>,
    open: &[Vec<WaveIndex>],
    hidden: WaveIndex,
    naming: &mut Naming,
) -> Outcome<Found> {
    let coupled = |waves: &BTreeSet<WaveIndex>| {
        Fault::Coupled(waves.iter().map(|wave| statement.waves[*wave].clone()).collect())
    };
    let candidates: Vec<usize> = (0..rows.len()).filter(|i| rows[*i].form.has_slopes()).collect();
    let Some((chosen, waves)) = closed_set(&candidates, open) else {
        return refuse(rows[0].clause, coupled(&open[0].iter().copied().collect()));
    };
    let clause = rows[chosen[0]].clause;
    let forms = chosen.iter().map(|i| rows[*i].form.clone()).collect();
    let unknowns = waves.iter().copied().collect();
    let uncoupled = uncouple(forms, unknowns, hidden, naming);
    let Uncoupled { steps, hidden, rates } = uncoupled.map_err(|stuck| {
        let names = || waves.iter().map(|wave| statement.waves[*wave].clone()).collect();
        let fault = match stuck {
            Stuck::Degenerate => coupled(&waves),
            Stuck::Roots(polynomial) => Fault::Rates { waves: names(), polynomial },
        };
        InvalidRecurrence { clause, fault }
    })?;
    for i in chosen.into_iter().rev() {
        rows.remove(i);
    }
    let coupled = Coupled { waves: waves.into_iter().collect(), rates };
    Ok(Found { steps, hidden, clause, coupled })
}

/// The smallest set of rows with as many unknowns as rows, ascending, and these unknowns. Starting
/// from each row, rows are added that bring no new unknown, else the one that brings the fewest.
fn closed_set(
    candidates: &[usize],
    open: &[Vec<WaveIndex>],
) -> Option<(Vec<usize>, BTreeSet<WaveIndex>)> {
    let grown = |start: usize| {
        let mut rows = BTreeSet::from([start]);
        let mut waves: BTreeSet<WaveIndex> = open[start].iter().copied().collect();
        while rows.len() < waves.len() {
            let new = |row: &usize| open[*row].iter().filter(|wave| !waves.contains(wave)).count();
            let next =
                candidates.iter().filter(|row| !rows.contains(row)).min_by_key(|row| new(row));
            let next = *next?;
            rows.insert(next);
            waves.extend(&open[next]);
        }
        (rows.len() == waves.len()).then_some((rows, waves))
    };
    let found = candidates.iter().filter_map(|row| grown(*row));
    let (rows, waves) = found.min_by_key(|(rows, _)| rows.len())?;
    Some((rows.into_iter().collect(), waves))
}

fn part_key(row: &Row) -> usize {
    match row.clause {
        Clause::Equation(i) => i,
        _ => unreachable!("rows of the elimination are equations"),
    }
}

/// Gives a differential step its rate; its start is still to be found.
fn with_rate(mut step: Step, clause: Clause) -> Outcome<Step> {
    if !step.equation.operator(step.wave).slope_now().is_zero() {
        let rate = step.equation.rate_now(step.wave);
        let rate = rate.ok_or(InvalidRecurrence { clause, fault: Fault::RateHoldsExponential })?;
        let (continuous, initial) = (LinearForm::zero(), Expression::zero());
        step.start = Some(Start { rate, continuous, initial });
    }
    Ok(step)
}

/// The wave itself, or, for one that was added, the first that has a derivative and no rule.
fn without_start(statement: &Statement, wave: WaveIndex) -> WaveIndex {
    if wave < statement.waves.len() {
        return wave;
    }
    let differentiated = |wave: &WaveIndex| {
        statement.equations.iter().any(|form| !form.operator(*wave).slope_now().is_zero())
    };
    let ruled = |wave: &WaveIndex| {
        statement.continuity.iter().any(|rule| !rule.form.operator(*wave).value_now().is_zero())
    };
    let mut waves = 0..statement.waves.len();
    let first = waves.clone().find(differentiated).unwrap_or(0);
    waves.find(|wave| differentiated(wave) && !ruled(wave)).unwrap_or(first)
}

/// Solves the continuity rules, on the current period, for the waves with differential steps.
fn assign_starts(
    statement: &Statement,
    mut steps: Vec<Step>,
    rules: &mut Vec<(Row, Expression)>,
) -> Outcome<Vec<Step>> {
    // Algebraic waves leave the rules by their own equations, which hold on every period.
    for step in
        steps.iter().rev().filter(|step| step.start.is_none() && !step.equation.has_slopes())
    {
        for (row, _) in rules.iter_mut() {
            let coefficient = row.form.operator(step.wave).value_now();
            row.form.add_scaled(&step.equation, &-&coefficient, 0);
        }
    }
    let mut found = Vec::new();
    for (place, step) in steps.iter().enumerate() {
        if step.start.is_none() {
            continue;
        }
        let holds =
            |(row, _): &(Row, Expression)| !row.form.operator(step.wave).value_now().is_zero();
        // Rather a rule that can be divided by the wave's coefficient.
        let usable = |rule: &(Row, Expression)| {
            let leading = rule.0.form.operator(step.wave).value_now();
            holds(rule) && statement.assumptions.invert(&leading).is_ok()
        };
        let chosen = rules.iter().position(usable).or_else(|| rules.iter().position(holds));
        let Some(i) = chosen else {
            let wave = without_start(statement, step.wave);
            return refuse(Clause::Wave(wave), Fault::NoStart(statement.waves[wave].clone()));
        };
        let (row, initial) = rules.remove(i);
        let leading = row.form.operator(step.wave).value_now();
        let inverse = invert(&statement.assumptions, &leading, row.clause)?;
        let (form, initial) = (row.form.scaled(&inverse), &initial * &inverse);
        let others = rules.iter_mut().map(|(row, start)| (&mut row.form, start));
        let before = found.iter_mut().map(|(_, form, start, _)| (form, start));
        for (other, start) in others.chain(before) {
            let factor = -&other.operator(step.wave).value_now();
            other.add_scaled(&form, &factor, 0);
            *start += &(&initial * &factor);
        }
        found.push((place, form, initial, row.clause));
    }
    // A rule that follows from the others is allowed, unless it is stated twice.
    let stated_once = |clause: Clause| match clause {
        Clause::Continuity(i) => {
            let same = |rule: &&Continuity| rule.form == statement.continuity[i].form;
            statement.continuity.iter().filter(same).count() == 1
        }
        _ => false,
    };
    rules
        .retain(|(row, start)| !(row.form.is_zero() && start.is_zero() && stated_once(row.clause)));
    if let Some((row, _)) = rules.first() {
        return refuse(row.clause, Fault::StartsNothing);
    }
    for (place, form, initial, clause) in found {
        let known: Vec<WaveIndex> = steps[..=place].iter().map(|step| step.wave).collect();
        if let Some(wave) = form.waves_now().find(|wave| !known.contains(wave)) {
            let stated = [steps[place].wave, wave].into_iter();
            let names = stated.filter_map(|wave| statement.waves.get(wave).cloned());
            return refuse(clause, Fault::Coupled(names.collect()));
        }
        if let Some(start) = &mut steps[place].start {
            start.continuous = form;
            start.initial = initial;
        }
    }
    Ok(steps)
}
