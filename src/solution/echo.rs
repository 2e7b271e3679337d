//! Echo by echo: the recurrence in the Laplace domain, expanded in the shift by one period.
//!
//! With `W(p) = Σ_k q^k Φ_k(p)`, `q = e^{−pD}`, a piece `w[n−j]` becomes `q^j W`, and a slope
//! `w'[n−j]` becomes `q^j (pW − J)`, where `J = Σ_k q^k Φ_k(x=0)` collects the jumps at arrivals.
//! The coefficient of `q^k` is one equation for `Φ_k`, a proper rational function of `p`; its jump
//! follows from the continuous form, in which all jumps but the one at the start cancel.

use crate::expression::{EchoSum, Expression, Fraction, Transform};
use crate::recurrence::{LinearForm, Recurrence, Start, WaveIndex};
use crate::solution::error::{SolveError, Unsolvable, check_degree};

/// The solution of a recurrence, echo by echo.
///
/// ```
/// use wavestep::language::{Source, read_expression, read_recurrence};
/// use wavestep::solution::EchoByEcho;
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &Default::default())?;
/// let mut solver = EchoByEcho::new(&recurrence);
/// (0..2).for_each(|_| solver.advance().unwrap());
/// // Each time the mass reflects f by (p − 1)/(p + 1): the echo of e^{−s} is e^{−s} (1 − 2s).
/// let read = |text| read_expression(&Source::new("text", text).unwrap());
/// assert_eq!(solver.sum(0).echoes(), [read("exp(-s)")?, read("exp(-s)*(1 - 2*s)")?]);
/// // Its transform 1/(p + 1) − 2/(p + 1)² has one pole.
/// let (_, coefficients) = solver.transforms(0)[1].poles().next().unwrap();
/// assert_eq!(coefficients, [read("1")?, read("-2")?]);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub struct EchoByEcho<'a> {
    recurrence: &'a Recurrence,
    /// `echoes[wave][k]`: the transform of the k-th echo, and of its slope where it was asked for.
    echoes: Vec<Vec<Transform>>,
}

impl<'a> EchoByEcho<'a> {
    /// No echo solved yet.
    pub fn new(recurrence: &'a Recurrence) -> EchoByEcho<'a> {
        EchoByEcho { recurrence, echoes: vec![Vec::new(); recurrence.wave_count()] }
    }

    /// The transforms of the echoes of a wave, as far as they are solved.
    pub fn transforms(&self, wave: WaveIndex) -> &[Transform] {
        &self.echoes[wave]
    }

    /// The wave as a sum of the echoes solved so far.
    pub fn sum(&self, wave: WaveIndex) -> EchoSum {
        let statement = self.recurrence.statement();
        let echoes = self.echoes[wave].iter().map(|echo| echo.function(&statement.local));
        EchoSum::new(statement.period.clone(), statement.local.clone(), echoes.collect())
    }

    /// Solves for the next echo. Cost: a few passes over the coefficients of the echoes that the
    /// equations name.
    ///
    /// # Errors
    /// [`SolveError`] where a difference of poles would have to be divided by that is not known
    /// to be non-zero.
    pub fn advance(&mut self) -> Result<(), SolveError> {
        for step in self.recurrence.steps() {
            let k = self.echoes[step.wave].len();
            check_degree(self.recurrence, step.wave, k)?;
            let explain = |reason| SolveError::new(self.recurrence, step.wave, k, reason);
            let right = self.right_side(&step.equation, step.wave, k).map_err(explain)?;
            let echo = match &step.start {
                None => right,
                Some(start) => self.solve(start, step.wave, k, right).map_err(explain)?,
            };
            self.echoes[step.wave].push(echo);
        }
        Ok(())
    }

    /// `(right + jump) / (p + a)`.
    fn solve(
        &self,
        start: &Start,
        wave: WaveIndex,
        k: usize,
        right: Transform,
    ) -> Result<Transform, Unsolvable> {
        let pole = -&start.rate;
        let jump = self.jump(start, wave, k)?;
        let mut echo = right.divide_by_pole(&pole, &self.recurrence.statement().assumptions)?;
        echo.add_scaled(&Transform::simple(pole, jump), &Expression::one());
        Ok(echo)
    }

    /// Minus the coefficient of `q^k` in the form, without `wave` at lag 0.
    fn right_side(
        &self,
        form: &LinearForm,
        wave: WaveIndex,
        k: usize,
    ) -> Result<Transform, Unsolvable> {
        let mut right = Transform::zero();
        for (other, operator) in form.operators() {
            let first = usize::from(other == wave);
            for lag in first..operator.reach().min(k + 1) {
                // A wave of a later step has coefficient zero at lag 0.
                let Some(echo) = self.echoes[other].get(k - lag) else { continue };
                if let Some(value) = operator.value().get(lag).filter(|value| !value.is_zero()) {
                    right.add_scaled(echo, &-value);
                }
                if let Some(slope) = operator.slope().get(lag).filter(|slope| !slope.is_zero()) {
                    right.add_scaled(&echo.derivative(), &-slope);
                }
            }
        }
        if let Some(function) = form.forcing_terms().get(k).filter(|f| !f.is_zero()) {
            let statement = self.recurrence.statement();
            let local = Fraction::symbol(&statement.local);
            let function = function.substitute(&statement.time, &local)?;
            let transform = Transform::of(&function, &statement.local);
            right.add_scaled(&transform, &-&Expression::one());
        }
        Ok(right)
    }

    /// The jump of `wave` at the k-th arrival, from the continuous form, whose own jump is its
    /// value at the start and nothing later.
    fn jump(&self, start: &Start, wave: WaveIndex, k: usize) -> Result<Expression, Unsolvable> {
        let mut jump = if k == 0 { start.initial.clone() } else { Expression::zero() };
        for (other, operator) in start.continuous.operators() {
            let first = usize::from(other == wave);
            let values = operator.value().iter().enumerate().take(k + 1).skip(first);
            for (lag, value) in values.filter(|(_, value)| !value.is_zero()) {
                jump -= &(&self.echoes[other][k - lag].initial_value() * value);
            }
        }
        if let Some(function) = start.continuous.forcing_terms().get(k) {
            jump -= &function.at_zero(&self.recurrence.statement().time);
        }
        Ok(jump)
    }
}
