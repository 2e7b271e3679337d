//! Steps of a recurrence with their coefficients in a field: what both ways of solving read.

use crate::expression::{Field, Fraction, Transform};
use crate::recurrence::{Lags, LinearForm, Recurrence, Step, WaveIndex};
use std::collections::BTreeMap;

/// A step with its coefficients in a field.
pub(crate) struct FieldStep<V> {
    pub wave: WaveIndex,
    pub equation: FieldForm<V>,
    /// The pole `−a`, the continuous form and its start.
    pub start: Option<(Fraction, FieldForm<V>, V)>,
}

/// Minus a form, without its own wave at lag 0.
pub(crate) struct FieldForm<V> {
    pub terms: Vec<FieldTerm<V>>,
    /// Forcing by lag.
    pub forcing: BTreeMap<usize, Transform<V>>,
}

/// `value · w[n−lag] + slope · w'[n−lag]`, with a zero left out.
pub(crate) struct FieldTerm<V> {
    pub wave: WaveIndex,
    pub lag: usize,
    pub value: Option<V>,
    pub slope: Option<V>,
}

impl<V: Clone> FieldStep<V> {
    /// The steps of a recurrence, in solving order.
    pub(crate) fn all<F: Field<Value = V>>(
        recurrence: &Recurrence,
        field: &F,
    ) -> Result<Vec<FieldStep<V>>, F::Error> {
        recurrence.steps().iter().map(|step| FieldStep::of(step, recurrence, field)).collect()
    }

    pub(crate) fn of<F: Field<Value = V>>(
        step: &Step,
        recurrence: &Recurrence,
        field: &F,
    ) -> Result<FieldStep<V>, F::Error> {
        let form = |form: &LinearForm| FieldForm::of(form, step.wave, recurrence, field);
        let start = match &step.start {
            None => None,
            Some(start) => {
                let initial = field.embed(&start.initial)?;
                Some((-&start.rate, form(&start.continuous)?, initial))
            }
        };
        Ok(FieldStep { wave: step.wave, equation: form(&step.equation)?, start })
    }
}

impl<V: Clone> FieldForm<V> {
    fn of<F: Field<Value = V>>(
        form: &LinearForm,
        own: WaveIndex,
        recurrence: &Recurrence,
        field: &F,
    ) -> Result<FieldForm<V>, F::Error> {
        let statement = recurrence.statement();
        let coefficient =
            |row: &Lags, lag: usize| row.get(lag).map(|value| field.embed(&-value)).transpose();
        let mut terms = Vec::new();
        for (wave, operator) in form.operators() {
            for lag in operator.lags().filter(|lag| *lag > 0 || wave != own) {
                let value = coefficient(&operator.value, lag)?;
                let slope = coefficient(&operator.slope, lag)?;
                terms.push(FieldTerm { wave, lag, value, slope });
            }
        }
        let mut forcing = BTreeMap::new();
        for (lag, function) in form.forcing_terms().iter() {
            let local = Fraction::symbol(&statement.local);
            let function = (-function).substitute(&statement.time, &local)?;
            let exact = Transform::of(&function, &statement.local);
            forcing.insert(lag, Transform::<V>::embedded(&exact, field)?);
        }
        Ok(FieldForm { terms, forcing })
    }
}
