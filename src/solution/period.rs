//! Period by period: the integrating factor, and the constant by continuity.
//!
//! On each period the steps of the recurrence are taken in order. An algebraic step is read off;
//! a differential one is `w' + a w = q` with `q` known, solved by `e^{as}`, its constant such that
//! the continuous form goes on where it stopped.

use crate::expression::{Expression, Fraction, Piecewise};
use crate::recurrence::{LinearForm, Recurrence, Start, WaveIndex};
use crate::solution::solved::{SolveError, Unsolvable};
use wavestep_polynomial::Rational;

/// The solution of a recurrence, period by period.
pub struct PeriodByPeriod<'a> {
    recurrence: &'a Recurrence,
    waves: Vec<Piecewise>,
    /// `ends[wave][n]`, the limits at the end of each period, where they were asked for.
    ends: Vec<Vec<Option<Expression>>>,
}

impl<'a> PeriodByPeriod<'a> {
    /// No period solved yet.
    pub fn new(recurrence: &'a Recurrence) -> PeriodByPeriod<'a> {
        let statement = recurrence.statement();
        let empty = Piecewise::new(statement.period.clone(), statement.local.clone());
        let count = statement.waves.len();
        let (waves, ends) = (vec![empty; count], vec![Vec::new(); count]);
        PeriodByPeriod { recurrence, waves, ends }
    }

    /// The waves on the periods solved so far.
    pub fn waves(&self) -> &[Piecewise] {
        &self.waves
    }

    /// Solves the next period. Cost: a few passes over the pieces that the equations name, and
    /// one substitution `s = D` for each piece that a continuous form names.
    ///
    /// # Errors
    /// [`SolveError`] where a rate would have to be divided by that is not known to be non-zero.
    pub fn advance(&mut self) -> Result<(), SolveError> {
        for step in self.recurrence.steps() {
            let n = self.ends[step.wave].len();
            let explain = |reason| SolveError::new(self.recurrence, step.wave, n, reason);
            let known = self.known(&step.equation, step.wave, n).map_err(explain)?;
            let right = -&known;
            let piece = match &step.start {
                None => right,
                Some(start) => self.solve(start, step.wave, n, right).map_err(explain)?,
            };
            self.waves[step.wave].push(piece);
            self.ends[step.wave].push(None);
        }
        Ok(())
    }

    fn solve(
        &mut self,
        start: &Start,
        wave: WaveIndex,
        n: usize,
        right: Expression,
    ) -> Result<Expression, Unsolvable> {
        let statement = self.recurrence.statement();
        let mut initial = match n {
            0 => start.initial.clone(),
            _ => self.end_of_form(&start.continuous, n - 1)?,
        };
        initial -= &self.start_of_form(&start.continuous, wave, n)?;
        let assumptions = &statement.assumptions;
        Ok(right.solve_first_order(&statement.local, &start.rate, &initial, assumptions)?)
    }

    /// The form on the n-th period without `wave` at lag 0.
    fn known(
        &self,
        form: &LinearForm,
        wave: WaveIndex,
        n: usize,
    ) -> Result<Expression, Unsolvable> {
        let statement = self.recurrence.statement();
        let mut sum = Expression::zero();
        for (other, operator) in form.operators() {
            let pieces = self.waves[other].pieces();
            let first = usize::from(other == wave);
            for lag in first..operator.reach().min(n + 1) {
                if let Some(value) = operator.value().get(lag).filter(|value| !value.is_zero()) {
                    sum += &times(&pieces[n - lag], value);
                }
                if let Some(slope) = operator.slope().get(lag).filter(|slope| !slope.is_zero()) {
                    sum += &times(&pieces[n - lag].derivative(&statement.local), slope);
                }
            }
        }
        let forcing = form.forcing_terms().iter().take(n + 1);
        for function in forcing.filter(|function| !function.is_zero()) {
            let time = &Fraction::symbol(&statement.local) + &self.arrival(n);
            sum += &function.substitute(&statement.time, &time)?;
        }
        Ok(sum)
    }

    /// The form at the start of the n-th period, without `wave` at lag 0.
    fn start_of_form(
        &self,
        form: &LinearForm,
        wave: WaveIndex,
        n: usize,
    ) -> Result<Expression, Unsolvable> {
        let mut sum = self.forcing_at_arrival(form, n, n)?;
        for (other, operator) in form.operators() {
            let first = usize::from(other == wave);
            let values = operator.value().iter().enumerate().take(n + 1).skip(first);
            for (lag, value) in values.filter(|(_, value)| !value.is_zero()) {
                sum += &(&self.waves[other].start(n - lag) * value);
            }
        }
        Ok(sum)
    }

    /// The form at the end of the n-th period.
    fn end_of_form(&mut self, form: &LinearForm, n: usize) -> Result<Expression, Unsolvable> {
        let mut sum = self.forcing_at_arrival(form, n, n + 1)?;
        for (wave, operator) in form.operators() {
            for (lag, value) in operator.value().iter().enumerate().take(n + 1) {
                if value.is_zero() {
                    continue;
                }
                let place = &mut self.ends[wave][n - lag];
                if place.is_none() {
                    *place = Some(self.waves[wave].end(n - lag)?);
                }
                let end = place.as_ref().expect("just computed");
                sum += &times(end, value);
            }
        }
        Ok(sum)
    }

    /// What forcing acts on period `n`, at the time `arrival · D`.
    fn forcing_at_arrival(
        &self,
        form: &LinearForm,
        n: usize,
        arrival: usize,
    ) -> Result<Expression, Unsolvable> {
        let time = &self.recurrence.statement().time;
        let mut sum = Expression::zero();
        for function in form.forcing_terms().iter().take(n + 1) {
            sum += &function.substitute(time, &self.arrival(arrival))?;
        }
        Ok(sum)
    }

    fn arrival(&self, n: usize) -> Fraction {
        self.recurrence.statement().period.scale(&Rational::from_integer(n.into()))
    }
}

/// `piece · value`, without arithmetic where the value is 1.
fn times(piece: &Expression, value: &Expression) -> Expression {
    match value.as_fraction() {
        Some(value) => piece.times(&value),
        None => piece * value,
    }
}
