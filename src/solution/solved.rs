//! A recurrence with its solution: pieces, echoes and general forms, each the cheapest way.

use crate::expression::{EchoSum, Expression, NotAUnit, Transform};
use crate::limits::counted;
use crate::recurrence::{Recurrence, WaveIndex};
use crate::solution::demand::Demand;
use crate::solution::echo::EchoByEcho;
use crate::solution::error::{SolveError, check_degree};
use crate::solution::general::{GeneralForm, Unknown};
use crate::solution::period::{KeptEnds, PeriodByPeriod};
use crate::solution::table::{EchoRow, EchoTable};
use crate::solution::template::EchoTemplate;
use num_integer::Integer as _;
use std::cell::OnceCell;
use std::collections::BTreeSet;
use wavestep_polynomial::{Integer, Rational, Univariate};

/// A recurrence with its solutions.
///
/// Pieces and echoes are derived echo by echo; where the echoes have a closed form in k, that is
/// used, and nothing depends on which scene it is.
#[derive(Clone)]
pub struct Solution {
    recurrence: Recurrence,
    general: Vec<OnceCell<Result<GeneralForm, Unknown>>>,
}

impl Solution {
    /// Derives nothing yet: general forms, pieces and echoes are derived on demand.
    pub fn new(recurrence: Recurrence) -> Solution {
        let general = vec![OnceCell::new(); recurrence.wave_count()];
        Solution { recurrence, general }
    }

    pub fn recurrence(&self) -> &Recurrence {
        &self.recurrence
    }

    /// The wave in general n.
    pub fn general(&self, wave: WaveIndex) -> Result<&GeneralForm, &Unknown> {
        self.general[wave].get_or_init(|| GeneralForm::of(&self.recurrence, wave)).as_ref()
    }

    /// The template of the echoes, where there is one.
    fn template(&self, wave: WaveIndex) -> Option<&EchoTemplate> {
        match self.general(wave) {
            Ok(GeneralForm::Echoes(template)) => Some(template),
            _ => None,
        }
    }

    /// The echoes `φ_0 … φ_through` of a wave.
    pub fn echoes(&self, wave: WaveIndex, through: usize) -> Result<EchoSum, SolveError> {
        check_degree(&self.recurrence, wave, through)?;
        let statement = self.recurrence.statement();
        if let Some(template) = self.template(wave) {
            let echoes = template.echoes(through, &statement.local);
            let (period, local) = (statement.period.clone(), statement.local.clone());
            return Ok(EchoSum { period, local, echoes });
        }
        Ok(self.expanded(wave, through)?.sum(wave))
    }

    /// The echoes of a wave, and of those that it needs.
    fn expanded(&self, wave: WaveIndex, through: usize) -> Result<EchoByEcho<'_>, SolveError> {
        let mut demand = Demand::none(&self.recurrence);
        (0..=through).for_each(|k| demand.add(&self.recurrence, wave, k));
        let mut solver = EchoByEcho::new(&self.recurrence).wanting(demand);
        for _ in counted(0..through + 1, "of the echoes") {
            solver.advance()?;
        }
        Ok(solver)
    }

    /// The pieces `first … last` of a wave, each in the local variable.
    pub fn pieces(
        &self,
        wave: WaveIndex,
        first: usize,
        last: usize,
    ) -> Result<Vec<Expression>, SolveError> {
        check_degree(&self.recurrence, wave, last)?;
        if let Ok(GeneralForm::Geometric(sequence)) = self.general(wave) {
            return Ok((first..=last).map(|n| sequence.value(n)).collect());
        }
        let sum = self.echoes(wave, last)?;
        let piece = |n: usize| {
            let explain = |e: NotAUnit| SolveError::new(&self.recurrence, wave, n, e.into());
            sum.piece(n).map_err(explain)
        };
        counted(first..last + 1, "of the periods").map(piece).collect()
    }

    /// The pieces `0 … last` of all waves by the values of `kept` waves at the ends of earlier
    /// periods, for which symbols stand.
    pub fn pieces_by_ends(
        &self,
        last: usize,
        kept: &BTreeSet<WaveIndex>,
    ) -> Result<(Vec<Vec<Expression>>, KeptEnds), SolveError> {
        let mut solver = PeriodByPeriod::keeping_ends(&self.recurrence, kept);
        for _ in counted(0..last + 1, "of the periods") {
            solver.advance()?;
        }
        Ok((solver.pieces().to_vec(), solver.kept.unwrap_or_default()))
    }

    /// The echoes `φ_0 … φ_through` of a wave as a table of integers; `None` where a constant is no
    /// rational number.
    pub fn table(&self, wave: WaveIndex, through: usize) -> Result<Option<EchoTable>, SolveError> {
        let Some(template) = self.template(wave) else {
            let solver = self.expanded(wave, through)?;
            let rows: Option<_> = solver.transforms(wave).iter().map(row_of).collect();
            return Ok(rows.map(|rows| EchoTable { rows }));
        };
        let local = &self.recurrence.statement().local;
        let first = template.first.iter().take(through + 1);
        let mut rows: Option<Vec<EchoRow>> =
            first.map(|echo| row_of(&Transform::of(echo, local))).collect();
        if template.first.len() <= through {
            rows = rows.zip(template.numeric_rows(through)).map(|(mut rows, (rate, later))| {
                rows.extend(later.into_iter().map(|row| EchoRow::new([(-&rate, row)])));
                rows
            });
        }
        Ok(rows.map(|rows| EchoTable { rows }))
    }
}

/// The echo with this transform as a row, where its constants are rational numbers.
fn row_of(transform: &Transform) -> Option<EchoRow> {
    let parts = transform.poles().map(|(pole, coefficients)| {
        let values = coefficients.iter().map(|c| c.as_constant());
        let values = values.collect::<Option<Vec<Rational>>>()?;
        let common = values.iter().fold(Integer::from(1), |d, value| d.lcm(value.denom()));
        let integers = values.iter().map(|value| value.numer() * (&common / value.denom()));
        Some((pole.as_constant()?, Univariate::new(integers, common.clone())))
    });
    parts.collect::<Option<Vec<_>>>().map(EchoRow::new)
}
