//! The way to the waves by Laplace transforms: a geometric series in the delay, whose terms are the echoes.

use crate::export::arrangement::arrange;
use crate::export::explain::Derivation;
use crate::export::formula::{Formula, Head, Right};
use crate::export::general::{echo_index, free_name, ratio_tree, sum_of_echoes};
use crate::export::mathml::element;
use crate::export::notation::Notation;
use crate::export::tree::Sign;
use crate::export::writer::write_flat;
use crate::expression::{Expression, Fraction};
use crate::recurrence::{Recurrence, WaveIndex};
use crate::solution::{EchoTemplate, GeneralForm, Solution};
use wavestep_polynomial::Symbol;

/// How many echoes are inverted.
const INVERTED: usize = 3;

impl Derivation {
    /// The echoes of the first `shown` waves, as far as each follows from the one before by one rate; whether there
    /// are such.
    pub fn by_transforms(&mut self, solution: &Solution, shown: usize) -> bool {
        let recurrence = solution.recurrence();
        let of = |wave| match solution.general(wave) {
            Ok(GeneralForm::Echoes(template)) if !template.terms.is_empty() => {
                Some((wave, &**template))
            }
            _ => None,
        };
        let all: Vec<(WaveIndex, &EchoTemplate)> = (0..shown).filter_map(of).collect();
        if all.is_empty() {
            return false;
        }
        let [p, q] = [["p", "z"], ["q", "d"]].map(|names| free_name(recurrence, &names));
        self.heading("The echoes, by transforms");
        let exponent = -&(&recurrence.statement().period * &Fraction::symbol(&p));
        let exponent = Expression::from(exponent);
        self.tell(|n| {
            let (p, q) = (n.symbol(&p), n.symbol(&q));
            let factor = n.exponential(&write_flat(&arrange(&exponent, None), n));
            format!(
                "The Laplace transform of a slope is ${p}$ times that of the function, less its value at the start. \
                 A delay by one period is the factor ${q} = {factor}$."
            )
        });
        for (wave, template) in all {
            self.gap();
            Transforms { recurrence, wave, template, p: &p, q: &q }.tell(self);
        }
        true
    }
}

/// The transforms of a wave and of its echoes.
struct Transforms<'a> {
    recurrence: &'a Recurrence,
    wave: WaveIndex,
    template: &'a EchoTemplate,
    p: &'a Symbol,
    q: &'a Symbol,
}

impl Transforms<'_> {
    fn name(&self) -> &str {
        &self.recurrence.statement().waves[self.wave]
    }

    /// The transform of the wave, or of one of its echoes.
    fn transform(&self, n: Notation, index: Option<&str>) -> String {
        let (wave, p) = (n.name(self.name()), n.symbol(self.p));
        match (n, index) {
            (Notation::Text, None) => format!("Phi_{wave}({p})"),
            (Notation::Text, Some(index)) => format!("Phi_{wave}[{index}]({p})"),
            (Notation::Latex, None) => format!("\\Phi^{{{wave}}}({p})"),
            (Notation::Latex, Some(index)) => format!("\\Phi^{{{wave}}}_{{{index}}}({p})"),
            (Notation::MathMl, None) => format!("{}({p})", element("msup", &["Φ", &wave])),
            (Notation::MathMl, Some(index)) => {
                format!("{}({p})", element("msubsup", &["Φ", index, &wave]))
            }
        }
    }

    fn tell(&self, to: &mut Derivation) {
        let (x, k) = (&self.recurrence.statement().local, echo_index(self.recurrence));
        let first = self.template.first.len();
        let (begin, next) = (first.to_string(), format!("{}+1", k.name()));
        let ratio = self.template.transform_ratio(self.p);
        to.tell(|n| {
            let (wave, x, k) = (n.name(self.name()), n.symbol(x), n.symbol(&k));
            format!(
                "In the transform of the recurrence for ${wave}$ the values at ${x} = 0$ cancel. From ${k} = {first}$ \
                 on, each echo has the transform of the one before times a rational function:"
            )
        });
        let step = |n: Notation| {
            format!(
                "{}{}{}",
                quotient(&ratio, n),
                n.times_symbol(),
                self.transform(n, Some(k.name()))
            )
        };
        let mut equations =
            vec![Formula::of(Head::both(|n| self.transform(n, Some(&next))), Right::both(step))];
        if let Some(start) = self.template.transform(first, x, self.p) {
            let head = Head::both(|n| self.transform(n, Some(&begin)));
            equations.push(Formula::new(head, &start.into(), self.p));
        }
        to.equations(equations);
        to.sentence("So the transform of the wave is a geometric series in the delay:");
        let head = Head::both(|n| self.transform(n, None));
        to.equations(vec![Formula::of(head, Right::both(|n| self.series(n, &ratio)))]);
        to.sentence("Its terms, inverted, are the echoes:");
        let inverted = |at: usize| Formula::echo(self.name(), &[at], &self.template.echo(at, x), x);
        to.equations((0..first + INVERTED).map(inverted).collect());
        to.sentence("The wave is the sum of those that have arrived:");
        to.equations(vec![sum_of_echoes(self.recurrence, self.name(), &Fraction::zero())]);
    }

    /// `Φ_0 + … + q^m Φ_m/(1 − q r)`: the echoes before the series, and its sum.
    fn series(&self, n: Notation, ratio: &Fraction) -> String {
        let times = n.times_symbol();
        let q = n.symbol(self.q);
        let term = |index: usize| {
            let echo = self.transform(n, Some(&index.to_string()));
            match index {
                0 => echo,
                1 => format!("{q}{times}{echo}"),
                _ => format!("{}{times}{echo}", n.power(&q, &index.to_string())),
            }
        };
        let first = self.template.first.iter().enumerate();
        let first = first.filter(|(_, echo)| !echo.is_zero());
        let before: String = first.map(|(index, _)| term(index) + " + ").collect();
        let (top, below) =
            (term(self.template.first.len()), format!("1 - {q}{times}{}", quotient(ratio, n)));
        let sum = match n {
            Notation::Text => format!("{top}/({below})"),
            Notation::Latex => format!("\\frac{{{top}}}{{{below}}}"),
            Notation::MathMl => element("mfrac", &[&top, &below]),
        };
        before + &sum
    }
}

/// A rational function as one quotient.
fn quotient(value: &Fraction, n: Notation) -> String {
    let written = write_flat(&[(Sign::Plus, ratio_tree(&value.into()))], n);
    if n == Notation::Text { n.enclosed(&written) } else { written }
}
