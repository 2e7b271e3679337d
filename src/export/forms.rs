//! Linear forms in the waves of a recurrence, and its equations solved for one wave after another.

use crate::export::arrangement::arrange;
use crate::export::formula::{Formula, Head, Right};
use crate::export::names::{Name, Names};
use crate::export::notation::Notation;
use crate::export::tree::Term;
use crate::expression::{Expression, Fraction};
use crate::recurrence::{LinearForm, Recurrence, Statement};
use std::sync::Arc;
use wavestep_polynomial::{Rational, Symbol};

/// Writes forms in waves with their index on the n-th period.
pub(crate) struct Writer<'a> {
    pub recurrence: &'a Recurrence,
    names: Arc<Names>,
}

/// The equations of a recurrence, solved for one wave after another, waves that are given by others
/// put in; then what is continuous from period to period, with the value at which it starts.
#[must_use]
pub fn solved_equations(recurrence: &Recurrence) -> (Vec<Formula>, Vec<Formula>) {
    Writer::new(recurrence).solved(recurrence.statement().waves.len())
}

/// A linear form in the waves of a recurrence on the n-th period, as text; sums over earlier periods are
/// left out.
#[must_use]
pub fn form_text(recurrence: &Recurrence, form: &LinearForm) -> String {
    let writer = Writer::new(recurrence);
    writer.right(form).written(Notation::Text).text().to_owned()
}

impl<'a> Writer<'a> {
    pub fn new(recurrence: &'a Recurrence) -> Writer<'a> {
        let mut names = Names::new();
        let forms = recurrence.steps().iter().flat_map(|step| {
            let continuous = step.start.as_ref().map(|start| &start.continuous);
            std::iter::once(&step.equation).chain(continuous)
        });
        let statement = recurrence.statement();
        let stated = statement.equations.iter();
        let lags = forms.chain(stated).flat_map(|form| form.operators());
        let most = lags.map(|(_, operator)| operator.reach());
        let forced = |form: &LinearForm| form.forcing_terms().reach();
        let loads = statement.equations.iter().map(forced).max().unwrap_or(0);
        let most = most.max().unwrap_or(0).max(loads) + 1;
        for wave in 0..recurrence.wave_count() {
            for lag in 0..=most {
                for slope in [false, true] {
                    let name = recurrence.wave_name(wave);
                    let index = if lag == 0 { "n".to_owned() } else { format!("n-{lag}") };
                    let prime = if slope { "'" } else { "" };
                    let written = Name::plain(|n| format!("{}{prime}", n.indexed(&name, &index)));
                    names.insert(stand_in(wave, lag, slope), written);
                }
            }
        }
        for lag in 1..=most {
            let written = Name::plain(|n| format!("[n{}{lag}]", n.choose(">=", " \\ge ")));
            names.insert(from_period(lag), written);
        }
        Writer { recurrence, names: Arc::new(names) }
    }

    /// A form as terms, slopes first and newest first.
    fn terms(&self, form: &LinearForm) -> Vec<Term> {
        let mut terms = Vec::new();
        for slope in [true, false] {
            let reach = form.operators().map(|(_, operator)| operator.reach());
            for lag in 0..reach.max().unwrap_or(0) {
                for (wave, operator) in form.operators() {
                    let row = if slope { &operator.slope } else { &operator.value };
                    let Some(factor) = row.get(lag) else { continue };
                    let symbol = Expression::symbol(&stand_in(wave, lag, slope));
                    terms.extend(arrange(&(&symbol * factor), None));
                }
            }
        }
        for (lag, function) in form.forcing_terms().iter() {
            let Statement { time, period, .. } = self.recurrence.statement();
            let late = period.scale(&Rational::from_integer(lag.into()));
            let function = function.substitute(time, &(&Fraction::symbol(time) - &late));
            let function = function.expect("no denominator of a load holds the time");
            let function = match lag {
                0 => function,
                _ => &function * &Expression::symbol(&from_period(lag)),
            };
            terms.extend(arrange(&function, Some(time)));
        }
        terms
    }

    /// The recurrence solved for one wave after another, and what is continuous with its start, of
    /// the first `shown` waves and those that were added to uncouple them.
    pub fn solved(&self, shown: usize) -> (Vec<Formula>, Vec<Formula>) {
        let mut equations = Vec::new();
        let mut starts = Vec::new();
        let mut explicit: Vec<(usize, LinearForm)> = Vec::new();
        let time = &self.recurrence.statement().time;
        for step in self.recurrence.steps() {
            let added = step.wave >= self.recurrence.statement().waves.len();
            if step.wave >= shown && !added {
                continue;
            }
            // Waves that are given by others are put in.
            let mut equation = step.equation.clone();
            for (wave, solved) in explicit.iter().rev() {
                let mut put_in = equation.clone();
                if put_in.replace(*wave, solved, time) {
                    equation = put_in;
                }
            }
            let (mut left, mut right) = (LinearForm::zero(), -&equation);
            let own = match &step.start {
                None => vec![(LinearForm::wave(step.wave, 0), Expression::one())],
                Some(start) => vec![
                    (LinearForm::slope(step.wave, 0), Expression::one()),
                    (LinearForm::wave(step.wave, 0), start.rate.clone().into()),
                ],
            };
            for (form, factor) in own {
                left.add_scaled(&form, &factor, 0);
                right.add_scaled(&form, &factor, 0);
            }
            if step.start.is_none() && !right.operators().any(|(wave, _)| wave == step.wave) {
                explicit.push((step.wave, right.clone()));
            }
            equations.push(self.equation(&left, &right));
            if let Some(start) = &step.start {
                let head = self.written(&start.continuous);
                let right = Right::Terms(arrange(&start.initial, None));
                starts.push(Formula::of(head, right));
            }
        }
        (equations, starts)
    }

    fn right(&self, form: &LinearForm) -> Right {
        Right::Named(self.terms(form), self.names.clone())
    }

    pub fn equation(&self, left: &LinearForm, right: &LinearForm) -> Formula {
        Formula::of(self.written(left), self.right(right))
    }

    /// A form as the left side of an equation.
    fn written(&self, form: &LinearForm) -> Head {
        let whole = self.right(form);
        Head::both(|n| whole.written(n).text().to_owned())
    }
}

/// A symbol in place of a wave at a lag, or of its slope.
fn stand_in(wave: usize, lag: usize, slope: bool) -> Symbol {
    let name = format!("wave_{wave}_{lag}_{}", u8::from(slope));
    Symbol::new(&name).expect("a name with letters in front")
}

/// A symbol for a step: 1 from a period on, and 0 before.
fn from_period(lag: usize) -> Symbol {
    Symbol::new(&format!("from_{lag}")).expect("a name with letters in front")
}
