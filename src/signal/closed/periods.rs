//! Period by period in balls: the pieces of all waves as exponential polynomials whose coefficients
//! are enclosures.
//!
//! It is the way of [`PeriodByPeriod`](crate::solution::PeriodByPeriod) with numbers in place of
//! expressions. A piece after n periods has O(n) coefficients and follows from those before it by as
//! many operations, so that all periods up to n cost O(n²), where echoes cost O(n³).
//!
//! The solution is unstable in this form, as every formula that is expanded in powers of time: radii
//! grow from period to period. They tell by how much, and more bits are the cure.

use crate::ball::ComplexBall;
use crate::enclosure::Numbers;
use crate::expression::{Field as _, Fraction, Transform};
use crate::limits::{counted, pause};
use crate::recurrence::{Recurrence, WaveIndex};
use crate::signal::closed::memory::Memory;
use crate::signal::error::Outcome;
use crate::signal::transforms::{divided_powers, dot, exponential, later};
use crate::solution::{FieldForm, FieldStep};
use std::collections::BTreeMap;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// About how many bits are lost from one period to the next.
const LOST_BITS: u64 = 2;

/// How many periods tell what all of them take.
const FORESEEN: usize = 128;

/// The pieces of all waves, by wave and period.
///
/// # Invariants
/// - every ball contains the exact coefficient.
pub(crate) struct Periods {
    numbers: Rc<Numbers>,
    bits: u64,
    period: ComplexBall,
    steps: Vec<FieldStep<ComplexBall>>,
    pieces: Vec<Vec<Rc<Transform<ComplexBall>>>>,
    /// `ends[wave][n]`, the limits at the ends of periods, where a continuous form names the wave.
    ends: Vec<Vec<ComplexBall>>,
    /// The waves that a continuous form names.
    continued: Vec<bool>,
    /// `D^j/j!`.
    powers: Vec<ComplexBall>,
    /// `e^{λD}`.
    exponentials: BTreeMap<Fraction, ComplexBall>,
}

impl Periods {
    /// No period solved yet; coefficients will have so many bits.
    pub(crate) fn new(
        recurrence: &Recurrence,
        numbers: Rc<Numbers>,
        bits: u64,
    ) -> Outcome<Periods> {
        let field = numbers.field(bits);
        let steps = FieldStep::all(recurrence, &field)?;
        let period = field.embed(&recurrence.statement().period.clone().into())?;
        let count = recurrence.wave_count();
        let mut continued = vec![false; count];
        for step in &steps {
            if let Some((_, continuous, _)) = &step.start {
                continued[step.wave] = true;
                continuous.terms.iter().for_each(|term| continued[term.wave] = true);
            }
        }
        Ok(Periods {
            numbers,
            bits,
            period,
            steps,
            pieces: vec![Vec::new(); count],
            ends: vec![Vec::new(); count],
            continued,
            powers: Vec::new(),
            exponentials: BTreeMap::new(),
        })
    }

    /// The piece of a wave on a period that is solved.
    pub(crate) fn piece(&self, wave: WaveIndex, n: usize) -> &Rc<Transform<ComplexBall>> {
        &self.pieces[wave][n]
    }

    /// Solves all periods up to the n-th.
    pub(crate) fn advance_to(&mut self, n: usize) -> Outcome<()> {
        let known = self.pieces.first().map_or(n + 1, Vec::len);
        for _ in counted(known..n + 1, "of the periods") {
            self.advance()?;
        }
        Ok(())
    }

    /// About how many bytes all periods up to the n-th will take, with the bits that they lose, foreseen from the
    /// first ones; refused where that is more than is allowed.
    pub(crate) fn foresee(&mut self, n: usize) -> Outcome<f64> {
        let mut memory = Memory::of_balls(self.bits + LOST_BITS * n as u64);
        for _ in 0..FORESEEN.min(n) {
            self.advance()?;
            let last = self.pieces.iter().filter_map(|pieces| pieces.last());
            let coefficients = last.flat_map(|piece| piece.poles()).map(|(_, row)| row.len());
            memory.add(coefficients.sum(), n)?;
        }
        Ok(memory.foreseen())
    }

    /// Solves the next period, of all waves or of none. Cost: a few passes over the pieces that the equations name.
    fn advance(&mut self) -> Outcome<()> {
        pause();
        let solved = self.pieces.iter().map(Vec::len).min().unwrap_or(0);
        self.solve_next().inspect_err(|_| {
            self.pieces.iter_mut().for_each(|pieces| pieces.truncate(solved));
            self.ends.iter_mut().for_each(|ends| ends.truncate(solved));
        })
    }

    fn solve_next(&mut self) -> Outcome<()> {
        for i in 0..self.steps.len() {
            let step = &self.steps[i];
            let (wave, n) = (step.wave, self.pieces[step.wave].len());
            let piece = match &step.start {
                None => self.read_off(&step.equation, n)?,
                Some((pole, continuous, initial)) => {
                    self.integrate(&step.equation, pole, continuous, initial, wave, n)?
                }
            };
            if self.continued[wave] {
                let end = self.end(&piece)?;
                self.ends[wave].push(end);
            }
            self.pieces[wave].push(Rc::new(piece));
        }
        Ok(())
    }

    /// `w = Σ (d v' + c v) + q`, the forms holding minus what stands beside `w`.
    fn read_off(
        &self,
        equation: &FieldForm<ComplexBall>,
        n: usize,
    ) -> Outcome<Transform<ComplexBall>> {
        let field = self.numbers.field(self.bits);
        let mut piece = self.forcing(equation, n)?;
        for term in &equation.terms {
            let Some(earlier) = n.checked_sub(term.lag) else { continue };
            let other = &self.pieces[term.wave][earlier];
            if let Some(value) = &term.value {
                piece.add_product(&field, other, value);
            }
            if let Some(slope) = &term.slope {
                piece.add_product(&field, &other.differentiated(&field)?, slope);
            }
        }
        Ok(piece)
    }

    /// `w' + a w = Σ (d v' + c v) + q` by `z = w − Σ d v`, `z' + a z = Σ (c − a d) v + q`, so that no
    /// derivative is formed; `pole` is `−a`.
    fn integrate(
        &self,
        equation: &FieldForm<ComplexBall>,
        pole: &Fraction,
        continuous: &FieldForm<ComplexBall>,
        initial: &ComplexBall,
        wave: WaveIndex,
        n: usize,
    ) -> Outcome<Transform<ComplexBall>> {
        let field = self.numbers.field(self.bits);
        let rate = field.embed(&pole.clone().into())?;
        let minus_one = ComplexBall::one().negate();
        let mut right = self.forcing(equation, n)?;
        let mut start = self.start(continuous, initial, wave, n)?;
        let mut slopes = Transform::zero();
        for term in &equation.terms {
            let Some(earlier) = n.checked_sub(term.lag) else { continue };
            let other = &self.pieces[term.wave][earlier];
            if let Some(value) = &term.value {
                right.add_product(&field, other, value);
            }
            if let Some(slope) = &term.slope {
                right.add_product(&field, other, &field.product(slope, &rate));
                slopes.add_product(&field, other, slope);
            }
        }
        field.add_product(&mut start, &slopes.initial(&field), &minus_one);
        let mut piece = right.over_pole(&field, pole)?;
        piece.add(&field, &Transform::simple(&field, pole.clone(), start));
        piece.add(&field, &slopes);
        Ok(piece)
    }

    /// `w[n]` at the start of the period: the continuous form goes on where it stopped.
    fn start(
        &self,
        continuous: &FieldForm<ComplexBall>,
        initial: &ComplexBall,
        wave: WaveIndex,
        n: usize,
    ) -> Outcome<ComplexBall> {
        let field = self.numbers.field(self.bits);
        let minus_one = ComplexBall::one().negate();
        let mut start = match n.checked_sub(1) {
            None => initial.clone(),
            Some(before) => self.ends[wave][before].clone(),
        };
        for term in &continuous.terms {
            let Some(value) = &term.value else { continue };
            if let Some(now) = n.checked_sub(term.lag) {
                let piece = &self.pieces[term.wave][now];
                field.add_product(&mut start, &piece.initial(&field), value);
            }
            if let Some(before) = n.checked_sub(term.lag + 1) {
                let end = field.product(&self.ends[term.wave][before], value);
                field.add_product(&mut start, &end, &minus_one);
            }
        }
        // Forcing is continuous but for what begins now.
        if let Some(forcing) = continuous.forcing.get(&n) {
            field.add(&mut start, &forcing.initial(&field));
        }
        Ok(start)
    }

    /// What forcing adds on the n-th period: that of lag j has acted for `n − j` periods.
    fn forcing(&self, form: &FieldForm<ComplexBall>, n: usize) -> Outcome<Transform<ComplexBall>> {
        let field = self.numbers.field(self.bits);
        let mut sum = Transform::zero();
        for (lag, function) in form.forcing.range(..=n) {
            let periods = Rational::from_integer((n - lag).into());
            let since = self.period.multiply_rational(&periods, self.bits);
            sum.add(&field, &later(function, &since, &self.numbers, self.bits)?);
        }
        Ok(sum)
    }

    /// The value at the end of the period.
    fn end(&mut self, piece: &Transform<ComplexBall>) -> Outcome<ComplexBall> {
        let mut end = ComplexBall::zero();
        for (pole, coefficients) in piece.poles() {
            if self.powers.len() < coefficients.len() {
                // Twice as many, so that the powers cost no more than the pieces.
                self.powers = divided_powers(&self.period, 2 * coefficients.len(), self.bits);
            }
            let factor = match self.exponentials.get(pole) {
                Some(known) => known.clone(),
                None => {
                    let factor = exponential(pole, &self.period, &self.numbers, self.bits)?;
                    self.exponentials.insert(pole.clone(), factor.clone());
                    factor
                }
            };
            let value = dot(coefficients, &self.powers, self.bits);
            end = end.add(&value.multiply(&factor, self.bits), self.bits);
        }
        Ok(end)
    }
}
