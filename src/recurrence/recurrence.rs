//! Statements that have been checked and put in solving order.

use crate::expression::{Constant, Expression, Fraction};
use crate::recurrence::WaveIndex;
use crate::recurrence::form::{Lags, LinearForm};
use crate::recurrence::ordering::{self, Coupled, Ordered, Step};
use crate::recurrence::statement::{
    Clause, Continuity, Fault, InvalidRecurrence, Observable, Observation, ObservedWave, Quadratic,
    Statement,
};
use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};
use wavestep_polynomial::{Polynomial, Symbol};

/// The most arrivals of one wave that are listed.
const MOST_ARRIVALS: usize = 1000;

/// A recurrence that can be solved step by step.
///
/// # Invariants
/// - the period is certainly positive;
/// - `steps` holds one step a wave, and each uses on the current period only waves of steps
///   before it. Where equations are coupled by derivatives, waves are added that uncouple them;
///   these are numbered after those stated.
#[derive(Clone, Debug)]
pub struct Recurrence {
    statement: Statement,
    steps: Vec<Step>,
    hidden: usize,
    coupled: Vec<Coupled>,
    growth: Growth,
    /// When something arrives. Filled at first use; shared by clones.
    arrivals: Arc<OnceLock<Option<Vec<BTreeSet<usize>>>>>,
}

/// All else follows from the statement.
impl PartialEq for Recurrence {
    fn eq(&self, other: &Recurrence) -> bool {
        self.statement == other.statement
    }
}

impl Eq for Recurrence {}

/// The degree of pieces and echoes of order `n` is at most about `fixed + (n + 1) per_period`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Growth {
    fixed: u64,
    per_period: u64,
}

impl Recurrence {
    /// Checks a statement and puts its equations in solving order.
    pub fn new(mut statement: Statement) -> Result<Recurrence, InvalidRecurrence> {
        if !statement.assumptions.is_positive(&statement.period) {
            let fault = Fault::PeriodNotPositive;
            return Err(InvalidRecurrence { clause: Clause::Period, fault });
        }
        check_forms(&statement)?;
        // Elimination multiplies at most one coefficient from each equation.
        let degrees = statement.equations.iter().map(coefficient_degree);
        if degrees.sum::<u64>() > u64::from(Polynomial::MAX_EXPONENT) {
            let fault = Fault::DegreeTooHigh;
            return Err(InvalidRecurrence { clause: Clause::Equation(0), fault });
        }
        let Ordered { steps, hidden, naming, coupled } = ordering::order(&statement)?;
        (statement.constants, statement.assumptions) =
            (naming.numbers.into_constants(), naming.assumptions);
        let growth = Growth::of(&statement, &steps);
        let arrivals = Arc::default();
        Ok(Recurrence { statement, steps, hidden, coupled, growth, arrivals })
    }

    pub fn statement(&self) -> &Statement {
        &self.statement
    }

    /// The steps, in solving order.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The systems of waves whose differential equations are coupled.
    pub fn coupled(&self) -> &[Coupled] {
        &self.coupled
    }

    /// Whether more than two waves decay together at rates that have names: formulas then take the
    /// rates for independent, which hides what cancels between them.
    pub fn has_named_rates(&self) -> bool {
        self.names_rates_of(3)
    }

    /// Whether so many waves or more decay together at rates that have names.
    pub(crate) fn names_rates_of(&self, waves: usize) -> bool {
        let holds = |rate: &Fraction| self.constants().iter().any(|c| rate.contains(&c.symbol));
        let mut systems = self.coupled.iter();
        systems.any(|system| system.rates.len() >= waves && system.rates.iter().any(holds))
    }

    /// For each wave, the periods at which something arrives: on all others the piece continues the one before it. `None` where
    /// waves return, or where arrivals are too many to list.
    pub(crate) fn arrivals(&self) -> Option<&[BTreeSet<usize>]> {
        self.arrivals.get_or_init(|| self.find_arrivals()).as_deref()
    }

    fn find_arrivals(&self) -> Option<Vec<BTreeSet<usize>>> {
        let equations = put_in(&self.steps, &self.statement.time);
        let mut known: Vec<Option<BTreeSet<usize>>> = vec![None; self.steps.len()];
        // Next is a wave all of whose sources are known; one that returns never has them.
        for _ in 0..self.steps.len() {
            let next = equations.iter().find_map(|(step, equation)| {
                let own = known[step.wave].is_none().then(|| arrivals_of(step, equation, &known));
                Some((step.wave, own??))
            });
            let (wave, own) = next.filter(|(_, own)| own.len() <= MOST_ARRIVALS)?;
            known[wave] = Some(own);
        }
        known.into_iter().collect()
    }

    /// The last period at which anything arrives; `None` where [`Recurrence::arrivals`] is.
    pub(crate) fn last_arrival(&self) -> Option<usize> {
        Some(self.arrivals()?.iter().flatten().copied().max().unwrap_or(0))
    }

    /// The number of waves, those that were added to uncouple equations included.
    pub fn wave_count(&self) -> usize {
        self.statement.waves.len() + self.hidden
    }

    pub fn wave_name(&self, wave: WaveIndex) -> String {
        assert!(wave < self.wave_count(), "a wave of this recurrence");
        let added = |wave| format!("mode_{}", wave - self.statement.waves.len());
        self.statement.waves.get(wave).cloned().unwrap_or_else(|| added(wave))
    }

    /// Whether a wave, a symbol or a time has this name.
    pub(crate) fn takes(&self, name: &str) -> bool {
        let Statement { local, time, waves, assumptions, .. } = &self.statement;
        let symbols = assumptions.symbols().map(|(symbol, _)| symbol);
        symbols.chain([local, time]).any(|symbol| symbol.name() == name)
            || waves.iter().any(|wave| wave == name)
    }

    pub fn wave(&self, name: &str) -> Option<WaveIndex> {
        self.statement.waves.iter().position(|wave| wave == name)
    }

    pub fn observable(&self, name: &str) -> Option<&Observable> {
        self.statement.observables.iter().find(|observable| observable.name == name)
    }

    /// The observable called `name`, where it is a sum of products.
    pub fn quadratic(&self, name: &str) -> Option<&Quadratic> {
        self.statement.quadratics.iter().find(|own| own.name == name)
    }

    /// An estimate from above of the degree of pieces and echoes of an order.
    pub(crate) fn degree_estimate(&self, order: usize) -> u64 {
        let Growth { fixed, per_period } = self.growth;
        (order as u64 + 1).saturating_mul(per_period).saturating_add(fixed)
    }

    /// The wave or the observable called `name`, as an observation.
    pub fn observation(&self, name: &str) -> Option<Observation> {
        if let Some(wave) = self.wave(name) {
            let seen = ObservedWave::new(wave, Fraction::zero(), &Fraction::one());
            return Some(Observation { waves: vec![seen], forcing: Expression::zero() });
        }
        self.observable(name).map(|observable| observable.observation.clone())
    }

    /// The symbols of the recurrence, times and constants with a definition apart, in the order of
    /// their names.
    pub fn symbols(&self) -> impl Iterator<Item = &Symbol> + '_ {
        let defined = |symbol: &Symbol| self.constants().iter().any(|c| c.symbol == *symbol);
        let symbols = self.statement.assumptions.symbols().map(|(symbol, _)| symbol);
        symbols.filter(move |symbol| !defined(symbol))
    }

    /// The constants with a definition, those included that were named for rates that are no
    /// rational numbers.
    pub fn constants(&self) -> &[Constant] {
        &self.statement.constants
    }
}

/// Checks that forms hold declared waves, coefficients free of time, and as forcing exponential
/// polynomials of scene time.
fn check_forms(statement: &Statement) -> Result<(), InvalidRecurrence> {
    let Statement { local, time, waves, equations, continuity, .. } = statement;
    let timeless = |value: &Expression| !value.contains(time) && !value.contains(local);
    let well_formed = |form: &LinearForm| {
        let operators = form.operators().all(|(wave, operator)| {
            let mut values = operator.rows().into_iter().flat_map(Lags::values);
            wave < waves.len() && values.all(timeless)
        });
        let forcing = form.forcing_terms().values().all(|function| {
            !function.contains(local)
                && function.terms().all(|(exponent, p)| {
                    !exponent.derivative(time).contains(time)
                        && !Fraction::from(p.denominator()).contains(time)
                })
        });
        operators && forcing
    };
    let refuse = |clause| Err(InvalidRecurrence { clause, fault: Fault::IllFormed });
    if let Some(i) = equations.iter().position(|form| !well_formed(form)) {
        return refuse(Clause::Equation(i));
    }
    let bad = |rule: &Continuity| !well_formed(&rule.form) || !timeless(&rule.start);
    match continuity.iter().position(bad) {
        Some(i) => refuse(Clause::Continuity(i)),
        None => Ok(()),
    }
}

impl Growth {
    /// On each period every step may bring the degree of a coefficient, an integration, and a substitution of the period.
    fn of(statement: &Statement, steps: &[Step]) -> Growth {
        let Statement { period, continuity, .. } = statement;
        let period = degree_of_fraction(period).max(1);
        let (mut per_period, mut forcing) = (0, 0);
        for step in steps {
            let start = step.start.as_ref();
            let forms =
                || [Some(&step.equation), start.map(|s| &s.continuous)].into_iter().flatten();
            per_period += forms().map(coefficient_degree).max().unwrap_or(0);
            per_period += start.map_or(0, |_| period);
            forcing +=
                forms().flat_map(|f| f.forcing_terms().values()).map(degree).max().unwrap_or(0);
        }
        let start = continuity.iter().map(|rule| degree(&rule.start)).max().unwrap_or(0);
        Growth { fixed: start + forcing * period, per_period }
    }
}

/// The largest degree of a coefficient of a wave in a form.
pub(crate) fn coefficient_degree(form: &LinearForm) -> u64 {
    let rows = form.operators().flat_map(|(_, operator)| operator.rows());
    rows.flat_map(Lags::values).map(degree).max().unwrap_or(0)
}

/// The largest degree of a coefficient of an expression, its denominator counted as well.
fn degree(value: &Expression) -> u64 {
    value.terms().map(|(_, p)| degree_of_fraction(p)).max().unwrap_or(0)
}

fn degree_of_fraction(value: &Fraction) -> u64 {
    let factors = value.factors().map(|(p, power)| u64::from(p.total_degree() * power));
    u64::from(value.numerator().total_degree()) + factors.sum::<u64>()
}

/// The equations of steps, with the waves put in that others give: what these reflect may cancel.
pub(crate) fn put_in<'s>(steps: &'s [Step], time: &Symbol) -> Vec<(&'s Step, LinearForm)> {
    let mut given: Vec<(WaveIndex, LinearForm)> = Vec::new();
    let equations = steps.iter().map(|step| {
        let mut equation = step.equation.clone();
        for (wave, solved) in given.iter().rev() {
            let mut without = equation.clone();
            if without.replace(*wave, solved, time) {
                equation = without;
            }
        }
        let right = right_of(step, &equation);
        if step.start.is_none() && right.operators().all(|(wave, _)| wave != step.wave) {
            given.push((step.wave, right));
        }
        (step, equation)
    });
    equations.collect()
}

/// The periods at which something arrives with the wave of a step; `None` where it depends on a wave whose arrivals are
/// not known.
fn arrivals_of(
    step: &Step,
    equation: &LinearForm,
    known: &[Option<BTreeSet<usize>>],
) -> Option<BTreeSet<usize>> {
    let mut own = BTreeSet::from([0]);
    let continuous = step.start.iter().map(|start| &start.continuous);
    for form in continuous.chain([equation]) {
        own.extend(form.forcing_terms().iter().map(|(lag, _)| lag));
        for (of, operator) in form.operators() {
            for lag in operator.lags().filter(|lag| of != step.wave || *lag > 0) {
                own.extend(known[of].as_ref()?.iter().map(|earlier| earlier + lag));
            }
        }
    }
    Some(own)
}

/// The right side of an equation that is solved for the wave of a step.
pub(crate) fn right_of(step: &Step, equation: &LinearForm) -> LinearForm {
    let mut right = step.left();
    right.add_scaled(equation, &-&Expression::one(), 0);
    right
}
