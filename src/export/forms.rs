//! Linear forms in the waves of a recurrence, and its equations solved for one wave after another.

use crate::export::arrangement::arrange;
use crate::export::formula::{Formula, Head, Right};
use crate::export::names::{Name, Names};
use crate::export::notation::Notation;
use crate::export::tree::Term;
use crate::expression::{Expression, Fraction};
use crate::recurrence::{LinearForm, Recurrence, Statement, WaveIndex};
use crate::solution::{Solved, solved_for_waves};
use std::sync::Arc;
use wavestep_polynomial::{Rational, Symbol};

/// On which period a form is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Place {
    /// The n-th, or one by so much later.
    General(usize),
    /// This one.
    Period(usize),
}

/// How much is told of the way to a wave.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Told {
    Steps,
    /// Only what is found: its equation is solved together with others, in complex numbers.
    Result,
    Nothing,
}

impl Told {
    /// For the first `shown` waves, and those that were added to uncouple them.
    pub fn of(recurrence: &Recurrence, wave: WaveIndex, shown: usize) -> Told {
        let (added, coupled) = (wave >= recurrence.statement().waves.len(), recurrence.coupled());
        let unit = Symbol::square_root(-1).expect("the imaginary unit");
        let complex = coupled.iter().any(|of| of.rates.iter().any(|rate| rate.contains(&unit)));
        match added || coupled.iter().any(|of| of.waves.contains(&wave)) {
            _ if wave >= shown && !added => Told::Nothing,
            true if complex && added => Told::Nothing,
            true if complex => Told::Result,
            _ => Told::Steps,
        }
    }
}

/// Writes forms in waves with their index on a period.
pub(crate) struct Writer<'a> {
    pub recurrence: &'a Recurrence,
    names: Arc<Names>,
    /// The last lag of which anything is there.
    last: usize,
}

/// The equations of a recurrence, solved for one wave after another, waves that are given by others
/// put in; then what is continuous from period to period, with the value at which it starts.
#[must_use]
pub fn solved_equations(recurrence: &Recurrence) -> (Vec<Formula>, Vec<Formula>) {
    Writer::new(recurrence).solved(|_| true)
}

/// A linear form in the waves of a recurrence on the n-th period, as text; sums over earlier periods are
/// left out.
#[must_use]
pub fn form_text(recurrence: &Recurrence, form: &LinearForm) -> String {
    let writer = Writer::new(recurrence);
    writer.right(form).written(Notation::Text).text().to_owned()
}

impl<'a> Writer<'a> {
    /// Writes on the n-th period.
    pub fn new(recurrence: &'a Recurrence) -> Writer<'a> {
        Writer::at(recurrence, Place::General(0))
    }

    pub fn at(recurrence: &'a Recurrence, place: Place) -> Writer<'a> {
        let index = |lag: usize| match place {
            Place::Period(n) => n.saturating_sub(lag).to_string(),
            Place::General(later) if later > lag => format!("n+{}", later - lag),
            Place::General(later) if later == lag => "n".to_owned(),
            Place::General(later) => format!("n-{}", lag - later),
        };
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
                    let prime = if slope { "'" } else { "" };
                    let written =
                        Name::plain(|n| format!("{}{prime}", n.indexed(&name, &index(lag))));
                    names.insert(stand_in(wave, lag, slope), written);
                }
            }
        }
        for lag in 1..=most {
            let written = Name::plain(|n| format!("[n{}{lag}]", n.choose(">=", " \\ge ")));
            names.insert(from_period(lag), written);
        }
        let last = if let Place::Period(n) = place { n } else { usize::MAX };
        Writer { recurrence, names: Arc::new(names), last }
    }

    /// A form as terms, slopes first and newest first.
    fn terms(&self, form: &LinearForm) -> Vec<Term> {
        let mut terms = Vec::new();
        for slope in [true, false] {
            let reach = form.operators().map(|(_, operator)| operator.reach());
            for lag in 0..reach.max().unwrap_or(0) {
                for (wave, operator) in form.operators() {
                    let row = if slope { &operator.slope } else { &operator.value };
                    let Some(factor) = row.get(lag).filter(|_| lag <= self.last) else { continue };
                    let symbol = Expression::symbol(&stand_in(wave, lag, slope));
                    terms.extend(arrange(&(&symbol * factor), None));
                }
            }
        }
        let Statement { time, period, .. } = self.recurrence.statement();
        let mut together = Expression::zero();
        for (lag, function) in form.forcing_terms().up_to(self.last) {
            let late = period.scale(&Rational::from_integer(lag.into()));
            let function = function.substitute(time, &(&Fraction::symbol(time) - &late));
            let function = function.expect("no denominator of a load holds the time");
            match lag {
                _ if self.last < usize::MAX => together += &function,
                0 => terms.extend(arrange(&function, Some(time))),
                _ => {
                    let late = &function * &Expression::symbol(&from_period(lag));
                    terms.extend(arrange(&late, Some(time)));
                }
            }
        }
        terms.extend(arrange(&together, Some(time)));
        terms
    }

    /// The recurrence solved for one wave after another, and what is continuous with its start.
    pub fn solved(&self, told: impl Fn(WaveIndex) -> bool) -> (Vec<Formula>, Vec<Formula>) {
        let mut equations = Vec::new();
        let mut starts = Vec::new();
        let all = solved_for_waves(self.recurrence).into_iter();
        for Solved { step, right } in all.filter(|solved| told(solved.step.wave)) {
            equations.push(self.equation(&step.left(), &right));
            if let Some(start) = &step.start {
                starts.push(self.start(&start.continuous, &start.initial));
            }
        }
        (equations, starts)
    }

    pub fn start(&self, form: &LinearForm, value: &Expression) -> Formula {
        Formula::of(self.written(form), Right::Terms(arrange(value, None)))
    }

    pub fn right(&self, form: &LinearForm) -> Right {
        Right::Named(self.terms(form), self.names.clone())
    }

    pub fn equation(&self, left: &LinearForm, right: &LinearForm) -> Formula {
        Formula::of(self.written(left), self.right(right))
    }

    /// A form as the left side of an equation.
    pub fn written(&self, form: &LinearForm) -> Head {
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
