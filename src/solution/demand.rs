//! The echoes that are needed: those that reach an observed wave in time, and no others.

use crate::recurrence::{LinearForm, Recurrence, WaveIndex};

/// A set of echoes, by wave and number: with an echo, all those that its equation names.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Demand {
    /// `wanted[wave][k]`
    wanted: Vec<Vec<bool>>,
}

impl Demand {
    /// Nothing yet.
    pub fn none(recurrence: &Recurrence) -> Demand {
        Demand { wanted: vec![Vec::new(); recurrence.wave_count()] }
    }

    /// Adds the echo `k` of a wave, and all echoes that it needs.
    pub fn add(&mut self, recurrence: &Recurrence, wave: WaveIndex, k: usize) {
        self.add_where(recurrence, wave, k, |_| true);
    }

    /// Adds the echo `k` of a wave, and of the echoes that it needs those that exist.
    pub(crate) fn add_where(
        &mut self,
        recurrence: &Recurrence,
        wave: WaveIndex,
        k: usize,
        exists: impl Fn(usize) -> bool,
    ) {
        let mut open = vec![(wave, k)];
        while let Some((wave, k)) = open.pop() {
            let row = &mut self.wanted[wave];
            if row.len() <= k {
                row.resize(k + 1, false);
            }
            if std::mem::replace(&mut row[k], true) {
                continue;
            }
            let step = recurrence.steps().iter().find(|step| step.wave == wave);
            let step = step.expect("every wave has a step");
            let continuous = step.start.as_ref().map(|start| &start.continuous);
            for form in std::iter::once(&step.equation).chain(continuous) {
                open.extend(named(form, k).filter(|(_, k)| exists(*k)));
            }
        }
    }

    /// Whether an echo is needed.
    pub fn wants(&self, wave: WaveIndex, k: usize) -> bool {
        self.wanted[wave].get(k).copied().unwrap_or(false)
    }

    /// The largest number of an echo that is needed.
    pub fn last(&self) -> Option<usize> {
        self.wanted.iter().map(Vec::len).max().and_then(|length| length.checked_sub(1))
    }

    /// How many echoes are needed of the wave of which most are.
    pub(crate) fn most_of_a_wave(&self) -> usize {
        let of = |row: &Vec<bool>| row.iter().filter(|wanted| **wanted).count();
        self.wanted.iter().map(of).max().unwrap_or(0)
    }

    /// How many echoes are needed.
    pub fn count(&self) -> usize {
        self.wanted.iter().flatten().filter(|wanted| **wanted).count()
    }
}

/// The echoes that a form names for the coefficient of `q^k`.
fn named(form: &LinearForm, k: usize) -> impl Iterator<Item = (WaveIndex, usize)> + '_ {
    form.operators().flat_map(move |(wave, operator)| {
        operator.lags().take_while(move |lag| *lag <= k).map(move |lag| (wave, k - lag))
    })
}
