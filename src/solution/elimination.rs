//! Elimination over all periods at once, for solutions in general n.
//!
//! A wave that is a finite combination of other waves at any lag (`g[n] = −f[n−1]`) is put into
//! all equations. The *base* waves that are left often have an equation of their own each.

use crate::recurrence::{LinearForm, Recurrence, Step, WaveIndex, right_of};
use std::collections::BTreeMap;

/// The steps of base waves, and every other wave as a form in base waves and forcing.
pub(crate) struct Reduced {
    pub base: Vec<Step>,
    pub derived: BTreeMap<WaveIndex, LinearForm>,
}

/// Reduces a recurrence; `None` where a second derivative would arise.
pub(crate) fn reduce(recurrence: &Recurrence) -> Option<Reduced> {
    let time = &recurrence.statement().time;
    let mut base = recurrence.steps().to_vec();
    let mut derived = BTreeMap::<WaveIndex, LinearForm>::new();
    while let Some(place) = base.iter().position(is_explicit) {
        let step = base.remove(place);
        let solved = right_of(&step, &step.equation);
        for other in &mut base {
            if !other.equation.replace(step.wave, &solved, time) {
                return None;
            }
            if let Some(start) = &mut other.start {
                start.continuous.replace(step.wave, &solved, time);
            }
        }
        for form in derived.values_mut() {
            if !form.replace(step.wave, &solved, time) {
                return None;
            }
        }
        derived.insert(step.wave, solved);
    }
    Some(Reduced { base, derived })
}

/// Whether the step gives its wave by other waves alone.
fn is_explicit(step: &Step) -> bool {
    step.start.is_none() && step.equation.operator(step.wave).reach() == 1
}

impl Reduced {
    /// The wave as `form`: itself for a base wave.
    pub fn form_of(&self, wave: WaveIndex) -> LinearForm {
        self.derived.get(&wave).cloned().unwrap_or_else(|| LinearForm::wave(wave, 0))
    }

    /// The step of a base wave, where it involves no other wave.
    pub fn lone_step(&self, wave: WaveIndex) -> Option<&Step> {
        let step = self.base.iter().find(|step| step.wave == wave)?;
        let alone = |form: &LinearForm| form.operators().all(|(other, _)| other == wave);
        let starts_alone = step.start.as_ref().is_none_or(|start| alone(&start.continuous));
        (alone(&step.equation) && starts_alone).then_some(step)
    }
}
