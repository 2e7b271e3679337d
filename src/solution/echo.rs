//! Echo by echo: the recurrence in the Laplace domain, expanded in the shift by one period.
//!
//! With `W(p) = Σ_k q^k Φ_k(p)`, `q = e^{−pD}`, a piece `w[n−j]` becomes `q^j W`, and a slope
//! `w'[n−j]` becomes `q^j (pW − J)`, where `J = Σ_k q^k Φ_k(x=0)` collects the jumps at arrivals.
//! The coefficient of `q^k` is one equation for `Φ_k`, a proper rational function of `p`; its jump
//! follows from the continuous form, in which all jumps but the one at the start cancel.
//!
//! The coefficients are exact, or enclosures in any other [`Field`]. Of all echoes only those are
//! worked out that a [`Demand`] names.

use crate::expression::{EchoSum, Exact, Field, Transform};
use crate::limits::pause;
use crate::recurrence::{Recurrence, WaveIndex};
use crate::solution::demand::Demand;
use crate::solution::error::{SolveError, check_degree};
use crate::solution::step::{FieldForm, FieldStep};

/// The solution of a recurrence, echo by echo.
pub struct EchoByEcho<'a, F: Field = Exact<'a>> {
    recurrence: &'a Recurrence,
    field: F,
    steps: Vec<FieldStep<F::Value>>,
    /// The echoes that are wanted; `None` for all.
    demand: Option<Demand>,
    /// `echoes[wave][k]`: the transform of the k-th echo, zero where it is not wanted.
    pub(crate) echoes: Vec<Vec<Transform<F::Value>>>,
    /// How many echoes other than zero have been worked out.
    pub(crate) expanded: usize,
    /// How many returns each wanted echo is the result of at most, where that is less than its number.
    returns: usize,
}

/// An echo that could not be worked out, and why.
#[derive(Debug)]
pub(crate) struct Failed<E> {
    pub wave: WaveIndex,
    /// The number of the echo.
    pub order: usize,
    pub reason: E,
}

impl<'a> EchoByEcho<'a> {
    /// No echo solved yet.
    pub fn new(recurrence: &'a Recurrence) -> EchoByEcho<'a> {
        let field = Exact::new(&recurrence.statement().assumptions);
        EchoByEcho::in_field(recurrence, field).expect("exact values are embedded as they are")
    }

    /// The wave as a sum of the echoes solved so far.
    pub fn sum(&self, wave: WaveIndex) -> EchoSum {
        let statement = self.recurrence.statement();
        let echoes = self.echoes[wave].iter().map(|echo| echo.function(&statement.local)).collect();
        EchoSum { period: statement.period.clone(), local: statement.local.clone(), echoes }
    }

    /// Solves for the next echo. Cost: a few passes over the coefficients of the echoes that the
    /// equations name.
    pub fn advance(&mut self) -> Result<(), SolveError> {
        self.advance_while(|_| true).map(|_| ())
    }

    /// The same, wave by wave while this is true of each echo: whether it was of all. If not, no more can be solved.
    pub(crate) fn advance_while(
        &mut self,
        go_on: impl FnMut(&Transform) -> bool,
    ) -> Result<bool, SolveError> {
        let next = self.echoes.first().map_or(0, Vec::len);
        for step in self.recurrence.steps() {
            check_degree(self.recurrence, step.wave, next.min(self.returns))?;
        }
        self.expand_while(go_on).map_err(|Failed { wave, order, reason }| {
            SolveError::new(self.recurrence, wave, order, reason.into())
        })
    }
}

impl<'a, F: Field> EchoByEcho<'a, F> {
    /// No echo solved yet; coefficients will be in `field`.
    pub(crate) fn in_field(recurrence: &'a Recurrence, field: F) -> Result<Self, F::Error> {
        let steps = FieldStep::all(recurrence, &field)?;
        let echoes = (0..recurrence.wave_count()).map(|_| Vec::new()).collect();
        let (demand, expanded, returns) = (None, 0, usize::MAX);
        Ok(EchoByEcho { recurrence, field, steps, demand, echoes, expanded, returns })
    }

    /// Only echoes that are wanted will be worked out.
    pub(crate) fn wanting(mut self, demand: Demand) -> Self {
        self.demand = Some(demand);
        self
    }

    /// Those that are wanted have returned no more often than this: a lattice has many numbers for as few returns.
    pub(crate) fn returning(mut self, most: usize) -> Self {
        self.returns = most;
        self
    }

    /// The transforms of the echoes of a wave, as far as they are solved.
    pub fn transforms(&self, wave: WaveIndex) -> &[Transform<F::Value>] {
        &self.echoes[wave]
    }

    /// How many coefficients the last echoes of all waves have.
    pub(crate) fn last_coefficients(&self) -> usize {
        let last = self.echoes.iter().filter_map(|echoes| echoes.last());
        last.flat_map(Transform::poles).map(|(_, row)| row.len()).sum()
    }

    /// Solves for the next echo of each wave.
    pub(crate) fn expand(&mut self) -> Result<(), Failed<F::Error>> {
        self.expand_while(|_| true).map(|_| ())
    }

    fn expand_while(
        &mut self,
        mut go_on: impl FnMut(&Transform<F::Value>) -> bool,
    ) -> Result<bool, Failed<F::Error>> {
        pause();
        for i in 0..self.steps.len() {
            let (wave, order) = (self.steps[i].wave, self.echoes[self.steps[i].wave].len());
            let wanted = self.demand.as_ref().is_none_or(|demand| demand.wants(wave, order));
            let echo = match wanted {
                true => self.solve(&self.steps[i], order),
                false => Ok(Transform::zero()),
            };
            let echo = echo.map_err(|reason| Failed { wave, order, reason })?;
            self.expanded += usize::from(!echo.is_zero());
            let goes_on = go_on(&echo);
            self.echoes[wave].push(echo);
            if !goes_on {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The solution of the equation; of a differential one, `(right + jump) / (p + a)`.
    fn solve(&self, step: &FieldStep<F::Value>, k: usize) -> Result<Transform<F::Value>, F::Error> {
        let field = &self.field;
        let mut right = Transform::zero();
        for (echo, value, slope) in self.terms(&step.equation, k) {
            if let Some(value) = value {
                right.add_product(field, echo, value);
            }
            if let Some(slope) = slope {
                right.add_product(field, &echo.differentiated(field)?, slope);
            }
        }
        if let Some(forcing) = step.equation.forcing.get(&k) {
            right.add(field, forcing);
        }
        let Some((pole, continuous, initial)) = &step.start else { return Ok(right) };
        // The continuous form has no jump but its value at the start.
        let mut jump = if k == 0 { initial.clone() } else { field.zero() };
        for (echo, value, _) in self.terms(continuous, k) {
            if let Some(value) = value {
                field.add_product(&mut jump, &echo.initial(field), value);
            }
        }
        if let Some(forcing) = continuous.forcing.get(&k) {
            field.add(&mut jump, &forcing.initial(field));
        }
        let mut echo = right.over_pole(field, pole)?;
        echo.add(field, &Transform::simple(field, pole.clone(), jump));
        Ok(echo)
    }

    /// The echoes that a form names for the coefficient of `q^k`, with their coefficients.
    #[expect(clippy::type_complexity, reason = "a private row of references")]
    fn terms<'s>(
        &'s self,
        form: &'s FieldForm<F::Value>,
        k: usize,
    ) -> impl Iterator<Item = (&'s Transform<F::Value>, Option<&'s F::Value>, Option<&'s F::Value>)> + 's
    {
        form.terms.iter().filter_map(move |term| {
            let echo = self.echoes[term.wave].get(k.checked_sub(term.lag)?)?;
            (!echo.is_zero()).then_some((echo, term.value.as_ref(), term.slope.as_ref()))
        })
    }
}
