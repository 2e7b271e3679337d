//! The echoes of a lattice, numbered.
//!
//! A recurrence counts lags in one number. On a lattice of several periods the counts are put
//! together to one, as digits are; each digit has room for the largest lag, so that a sum never
//! carries into the next.

use crate::expression::Fraction;
use crate::network::delay::Lattice;
use crate::network::equations::Network;
use crate::network::error::NetworkError;
use crate::recurrence::Recurrence;

/// A recurrence in which the lag `k` stands for counts on a lattice, up to a bound for each.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Unfolded {
    recurrence: Recurrence,
    lattice: Lattice,
    /// The largest count in each direction.
    bounds: Vec<usize>,
    strides: Vec<usize>,
}

impl Network {
    /// The recurrence of the scene with counts on its lattice up to `bounds`, one for each period
    /// of [`Network::lattice`].
    pub fn unfold(&self, bounds: &[usize]) -> Result<Unfolded, NetworkError> {
        self.all_linear()?;
        assert_eq!(bounds.len(), self.lattice().periods().len(), "one bound a period");
        let largest = self.largest_lags();
        let mut strides = Vec::new();
        let mut stride = 1;
        for (bound, lag) in bounds.iter().zip(&largest) {
            strides.push(stride);
            stride *= bound + lag + 1;
        }
        let recurrence = Recurrence::new(self.statement(&strides));
        let recurrence = recurrence.map_err(|invalid| self.refused(invalid))?;
        let (lattice, bounds) = (self.lattice().clone(), bounds.to_vec());
        Ok(Unfolded { recurrence, lattice, bounds, strides })
    }
}

impl Unfolded {
    pub fn recurrence(&self) -> &Recurrence {
        &self.recurrence
    }

    /// The number of an echo; `None` beyond the bounds.
    pub fn number(&self, counts: &[usize]) -> Option<usize> {
        let within = counts.iter().zip(&self.bounds).all(|(count, bound)| count <= bound);
        within.then(|| counts.iter().zip(&self.strides).map(|(n, stride)| n * stride).sum())
    }

    /// The counts of the echo `k`; `None` beyond the bounds.
    pub fn counts(&self, k: usize) -> Option<Vec<usize>> {
        let mut rest = k;
        let mut counts = vec![0; self.strides.len()];
        for (count, stride) in counts.iter_mut().zip(&self.strides).rev() {
            (*count, rest) = (rest / stride, rest % stride);
        }
        self.number(&counts).map(|_| counts)
    }

    /// When the echo `k` arrives; `None` beyond the bounds.
    pub fn delay(&self, k: usize) -> Option<Fraction> {
        let counts = self.counts(k)?;
        let counts: Vec<i64> = counts.into_iter().map(|count| count as i64).collect();
        Some(self.lattice.delay(&counts))
    }

    /// The numbers of all echoes within the bounds, ascending.
    pub fn numbers(&self) -> impl Iterator<Item = usize> + '_ {
        let last = self.number(&self.bounds).expect("the bounds are within themselves");
        (0..=last).filter(|k| self.counts(*k).is_some())
    }
}
