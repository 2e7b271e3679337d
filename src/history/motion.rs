//! What a node does on a cell: the answer of its system to what arrives, as series with a proven rest.

use crate::ball::{Magnitude, Number};
use crate::history::error::{HistoryError, NotFollowed};
use crate::history::series::{Series, Truncation};
use crate::network::{Node, System, dot};

/// What a node does on a cell.
pub(crate) struct Motion {
    /// The state.
    pub state: Vec<Series>,
    /// The velocity of each run.
    pub velocities: Vec<Series>,
    /// The force of each closed contact, as they stand in [`System::closed`].
    pub forces: Vec<Series>,
}

impl System<Number> {
    /// A bound of `‖A‖` and of what loads and waves of size 1 change, `‖B‖`, in the maximum norm.
    pub fn norms(&self) -> (Magnitude, Magnitude) {
        let states = self.states();
        let sum = |row: &[Number]| {
            row.iter().fold(Magnitude::ZERO, |sum, entry| sum.add(&entry.magnitude()))
        };
        let largest = |part: fn(&[Number], usize) -> &[Number]| {
            let rows = self.change.iter().map(|row| sum(part(row, states)));
            rows.max().unwrap_or(Magnitude::ZERO)
        };
        (largest(|row, n| &row[..n]), largest(|row, n| &row[n..]))
    }

    /// Solves the equations on a cell: `(k+1) y_(k+1) = A y_k + B u_k`.
    ///
    /// The rest: `|u_k| ≤ m γ^k/k!` and `|y_k| ≤ M γ^k/k!` give
    /// `|y_(k+1)| ≤ (‖A‖ M + ‖B‖ m)/γ · γ^(k+1)/(k+1)!`; with `γ ≥ 4‖A‖` the bound goes on from one
    /// coefficient to the next where `M ≥ ‖B‖ m · 4/(3γ)` and `M ≥ |y_N| N!/γ^N`.
    ///
    /// # Cost
    /// N times the products of small matrices with vectors.
    pub fn solve(&self, state: Vec<Number>, input: &[Series], cut: &Truncation) -> Motion {
        let polynomial = input.iter().all(|series| series.rest.is_zero());
        let degree = input.iter().map(|series| series.coefficients.len()).max().unwrap_or(0);
        let exact = state.iter().all(|value| value.exact().is_some())
            && input.iter().all(Series::is_exact)
            && degree <= 4;
        if exact || state.is_empty() {
            let few = if state.is_empty() { cut.order } else { degree + 4 };
            let (columns, next) = self.columns(state.clone(), input, few.min(cut.order), cut.bits);
            if state.is_empty() || next.iter().all(Number::is_zero) && polynomial {
                return self.motion(columns, Magnitude::ZERO, input, cut);
            }
        }
        let state = state.iter().map(|value| value.enclosed(cut.bits)).collect();
        let (columns, next) = self.columns(state, input, cut.order, cut.bits);
        let rest = input.iter().map(|series| series.rest).max().unwrap_or(Magnitude::ZERO);
        let (_, norm) = self.norms();
        let forced = norm.multiply(&rest).scale(2 - cut.rate).divide(3);
        let next = next.iter().map(Number::magnitude).max().unwrap_or(Magnitude::ZERO);
        self.motion(columns, forced.max(cut.factor(&next)), input, cut)
    }

    /// The first coefficients of the state, and the next one.
    fn columns(
        &self,
        state: Vec<Number>,
        input: &[Series],
        order: usize,
        bits: u64,
    ) -> (Vec<Vec<Number>>, Vec<Number>) {
        let mut columns: Vec<Vec<Number>> = Vec::with_capacity(order);
        let mut next = state;
        for k in 0..order {
            let mut both = next.clone();
            both.extend(input.iter().map(|series| series.coefficient(k)));
            let changed = self.change.iter();
            let after: Vec<Number> =
                changed.map(|row| dot(row, &both, bits).over(k as u64 + 1, bits)).collect();
            columns.push(std::mem::replace(&mut next, after));
        }
        (columns, next)
    }

    fn motion(
        &self,
        columns: Vec<Vec<Number>>,
        rest: Magnitude,
        input: &[Series],
        cut: &Truncation,
    ) -> Motion {
        let bits = cut.bits;
        let state = |i: usize| {
            // On what nothing acts, nothing changes: it has no rest.
            let (own, forced) = self.change[i].split_at(self.states());
            let mut forced = forced.iter().zip(input);
            let still = own.iter().all(Number::is_zero)
                && forced.all(|(c, input)| c.is_zero() || input.is_zero());
            let rest = match still {
                true => Magnitude::ZERO,
                false => rest,
            };
            Series::new(columns.iter().map(|column| column[i].clone()).collect(), rest)
        };
        let states: Vec<Series> = (0..self.states()).map(state).collect();
        let mut outputs = self.output.iter().map(|row| {
            let parts = states.iter().chain(input).zip(row).filter(|(_, c)| !c.is_zero());
            parts.fold(Series::zero(), |sum, (part, c)| sum.combine(&Number::one(), part, c, bits))
        });
        let velocities = outputs.by_ref().take(self.group.len()).collect();
        let forces = outputs.collect();
        Motion { state: states, velocities, forces }
    }

    /// The state that continues with these velocities of runs and displacements of elements.
    ///
    /// # Errors
    /// [`HistoryError::Refused`] where rigid masses of different velocities meet.
    pub fn state(
        &self,
        node: &Node<Number>,
        velocity: impl Fn(usize) -> Option<Number>,
        displaced: &[Number],
        place: &str,
        bits: u64,
    ) -> Result<Vec<Number>, HistoryError> {
        let mut state = Vec::with_capacity(self.states());
        for group in &self.heavy {
            let own = (0..node.runs()).filter(|run| self.group[*run] == *group);
            let mut own = own.filter(|run| !node.mass_of(*run, bits).is_zero());
            let first = own.next().and_then(&velocity).expect("a mass has a velocity");
            for run in own {
                if velocity(run).is_none_or(|other| other != first) {
                    return Err(NotFollowed::RigidImpact { place: place.to_owned() }.into());
                }
            }
            state.push(first);
        }
        let kept = displaced.iter().zip(&self.kept).filter(|(_, kept)| kept.is_some());
        state.extend(kept.map(|(value, _)| value.clone()));
        Ok(state)
    }
}
