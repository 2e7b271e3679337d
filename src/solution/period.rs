//! Period by period: the integrating factor, and the constant by continuity.
//!
//! On each period the steps of the recurrence are taken in order. An algebraic step is read off. A
//! differential step `w' + a w + Σ (d_i v_i' + a_i v_i) + q = 0`, with earlier pieces `v_i` at
//! coefficients `d_i, a_i` and forcing `q`, is solved for the quantity that is differentiated,
//! `z = w + Σ d_i v_i`, so that no derivative is ever formed:
//!
//! ```text
//! z' + a z = Σ (a d_i − a_i) v_i − q,        w = z − Σ d_i v_i
//! ```
//!
//! The integrating factor is `e^{as}`; the constant is such that the continuous form goes on where
//! it stopped.

use crate::expression::{Expression, Fraction};
use crate::limits::pause;
use crate::recurrence::{LinearForm, Recurrence, Start, Statement, Step, WaveIndex, right_of};
use crate::solution::error::{SolveError, Unsolvable, check_degree};
use std::collections::BTreeSet;
use wavestep_polynomial::{Rational, Symbol};

/// The solution of a recurrence, period by period.
pub struct PeriodByPeriod<'a> {
    pub(super) recurrence: &'a Recurrence,
    /// `waves[wave][n]`, the pieces in the local variable, `w(nD + s)` for `0 ≤ s < D`.
    waves: Vec<Vec<Expression>>,
    /// `ends[wave][n]`, the limits at the end of each period, where they were needed.
    ends: Vec<Vec<Option<Expression>>>,
    /// Symbols in place of the limits at the ends.
    pub(crate) kept: Option<KeptEnds>,
}

/// Symbols that stand for values of waves at the ends of periods, so that a piece is given by
/// those of the pieces before it, as in textbooks: `a_2 = e^{−t}(−t²/2 + t(1 − a_0(μ)) + a_1(μ))`.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct KeptEnds {
    waves: BTreeSet<WaveIndex>,
    symbols: Vec<(Symbol, WaveIndex, usize)>,
}

impl KeptEnds {
    /// The symbols so far: each with its wave and its period.
    pub fn symbols(&self) -> impl Iterator<Item = (&Symbol, WaveIndex, usize)> {
        self.symbols.iter().map(|(symbol, wave, n)| (symbol, *wave, *n))
    }

    /// A new symbol for the end of the n-th period of a wave, in the order of the periods.
    fn symbol(&mut self, recurrence: &Recurrence, wave: WaveIndex, n: usize) -> Symbol {
        let mut name = format!("{}_end_{n:05}", recurrence.statement().waves[wave]);
        while recurrence.takes(&name) {
            name.push('_');
        }
        let symbol = Symbol::new(&name).expect("a name of a wave with letters after it");
        self.symbols.push((symbol.clone(), wave, n));
        symbol
    }
}

impl<'a> PeriodByPeriod<'a> {
    /// No period solved yet.
    pub fn new(recurrence: &'a Recurrence) -> PeriodByPeriod<'a> {
        let count = recurrence.wave_count();
        let (waves, ends) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        PeriodByPeriod { recurrence, waves, ends, kept: None }
    }

    /// No period solved yet; symbols will stand for the ends of these waves.
    pub(crate) fn keeping_ends(
        recurrence: &'a Recurrence,
        waves: &BTreeSet<WaveIndex>,
    ) -> PeriodByPeriod<'a> {
        let kept = KeptEnds { waves: waves.clone(), symbols: Vec::new() };
        PeriodByPeriod { kept: Some(kept), ..PeriodByPeriod::new(recurrence) }
    }

    /// The pieces of the waves on the periods solved so far, `pieces[wave][n]`.
    pub fn pieces(&self) -> &[Vec<Expression>] {
        &self.waves
    }

    /// Solves the next period. Cost: a few passes over the pieces that the equations name, and
    /// one substitution `s = D` for each piece that a continuous form names.
    pub fn advance(&mut self) -> Result<(), SolveError> {
        pause();
        for step in self.recurrence.steps() {
            let n = self.ends[step.wave].len();
            check_degree(self.recurrence, step.wave, n)?;
            let explain = |reason| SolveError::new(self.recurrence, step.wave, n, reason);
            let piece = match &step.start {
                None => self.read_off(step, n),
                Some(start) => self.integrate(step, start, n),
            };
            self.waves[step.wave].push(piece.map_err(explain)?);
            let kept = self.kept.as_mut().filter(|kept| kept.waves.contains(&step.wave));
            let end = kept.map(|kept| kept.symbol(self.recurrence, step.wave, n));
            self.ends[step.wave].push(end.map(|symbol| Expression::symbol(&symbol)));
        }
        Ok(())
    }

    /// `w = −Σ (d_i v_i' + a_i v_i) − q`.
    fn read_off(&self, step: &Step, n: usize) -> Result<Expression, Unsolvable> {
        self.value_of(&right_of(step, &step.equation), n)
    }

    /// The value of a form in known pieces on the n-th period.
    pub(super) fn value_of(&self, form: &LinearForm, n: usize) -> Result<Expression, Unsolvable> {
        let mut value = self.forcing(form, n)?;
        for (wave, operator) in form.operators() {
            for lag in operator.lags().filter(|lag| *lag <= n) {
                let piece = &self.waves[wave][n - lag];
                value.add_scaled(piece, &operator.value_at(lag));
                let slope = operator.slope_at(lag);
                if !slope.is_zero() {
                    value.add_scaled(&piece.derivative(&self.recurrence.statement().local), &slope);
                }
            }
        }
        Ok(value)
    }

    fn integrate(
        &mut self,
        step: &Step,
        start: &Start,
        n: usize,
    ) -> Result<Expression, Unsolvable> {
        let statement = self.recurrence.statement();
        let mut initial = match n {
            0 => start.initial.clone(),
            _ => self.end_of_form(&start.continuous, n - 1)?,
        };
        initial -= &self.start_of_form(&start.continuous, step.wave, n)?;
        let mut right = -&self.forcing(&step.equation, n)?;
        let earlier = self.earlier(&step.equation, step.wave, n);
        for Earlier { piece, value, slope } in &earlier {
            right.add_scaled(piece, &(&slope.times(&start.rate) - value));
            initial.add_scaled(&piece.at_zero(&statement.local), slope);
        }
        let (local, assumptions) = (&statement.local, &statement.assumptions);
        let mut piece = right.solve_first_order(local, &start.rate, &initial, assumptions)?;
        for Earlier { piece: other, slope, .. } in &earlier {
            piece.add_scaled(other, &-slope);
        }
        Ok(piece)
    }

    /// The pieces that the form names on the n-th period, but for `wave` at lag 0.
    fn earlier(&self, form: &LinearForm, wave: WaveIndex, n: usize) -> Vec<Earlier<'_>> {
        let mut earlier = Vec::new();
        for (other, operator) in form.operators() {
            let is_known = |lag: &usize| *lag <= n && (*lag > 0 || other != wave);
            for lag in operator.lags().filter(is_known) {
                let (value, slope) = (operator.value_at(lag), operator.slope_at(lag));
                earlier.push(Earlier { piece: &self.waves[other][n - lag], value, slope });
            }
        }
        earlier
    }

    /// The contribution of forcing to the form on the n-th period.
    fn forcing(&self, form: &LinearForm, n: usize) -> Result<Expression, Unsolvable> {
        let statement = self.recurrence.statement();
        let time = &Fraction::symbol(&statement.local) + &self.arrival(n);
        self.forcing_at(form, n, &time)
    }

    /// The form at the start of the n-th period, without `wave` at lag 0.
    pub(super) fn start_of_form(
        &self,
        form: &LinearForm,
        wave: WaveIndex,
        n: usize,
    ) -> Result<Expression, Unsolvable> {
        let mut sum = self.forcing_at(form, n, &self.arrival(n))?;
        for (other, operator) in form.operators() {
            let first = usize::from(other == wave);
            for (lag, value) in operator.value.up_to(n).filter(|(lag, _)| *lag >= first) {
                let start = self.waves[other][n - lag].at_zero(&self.recurrence.statement().local);
                sum.add_scaled(&start, value);
            }
        }
        Ok(sum)
    }

    /// The form at the end of the n-th period.
    pub(super) fn end_of_form(
        &mut self,
        form: &LinearForm,
        n: usize,
    ) -> Result<Expression, Unsolvable> {
        let mut sum = self.forcing_at(form, n, &self.arrival(n + 1))?;
        for (wave, operator) in form.operators() {
            for (lag, value) in operator.value.up_to(n) {
                let place = &mut self.ends[wave][n - lag];
                if place.is_none() {
                    let Statement { local, period, .. } = self.recurrence.statement();
                    *place = Some(self.waves[wave][n - lag].substitute(local, period)?);
                }
                let end = place.as_ref().expect("just computed");
                sum.add_scaled(end, value);
            }
        }
        Ok(sum)
    }

    /// The contribution of forcing to the form on the n-th period, at `time`.
    fn forcing_at(
        &self,
        form: &LinearForm,
        n: usize,
        time: &Fraction,
    ) -> Result<Expression, Unsolvable> {
        let mut sum = Expression::zero();
        for (lag, function) in form.forcing_terms().up_to(n) {
            let since = time - &self.arrival(lag);
            sum += &function.substitute(&self.recurrence.statement().time, &since)?;
        }
        Ok(sum)
    }

    fn arrival(&self, n: usize) -> Fraction {
        self.recurrence.statement().period.scale(&Rational::from_integer(n.into()))
    }
}

/// A known piece, with the coefficients of its value and of its slope.
struct Earlier<'a> {
    piece: &'a Expression,
    value: Expression,
    slope: Expression,
}
