//! A derivation goes on: from the recurrence to its pieces step by step, and to the form for every n.

use crate::export::arrangement::arrange;
use crate::export::explain::{Derivation, RECURRENCE};
use crate::export::forms::{Place, Told, Writer};
use crate::export::formula::{Formula, Head, Right};
use crate::export::general::{echo_index, free_name, general_form, laguerre_name, ratio_tree};
use crate::export::mathml;
use crate::export::names::{Name, Names};
use crate::export::notation::Notation;
use crate::export::tree::{Sign, Tree};
use crate::export::writer::{write_flat, write_named};
use crate::expression::{Expression, Fraction};
use crate::recurrence::{Recurrence, Start, Statement, WaveIndex};
use crate::solution::{
    EchoTemplate, Family, GeneralForm, Integration, PeriodByPeriod, PieceSteps, SequenceStep,
    Solution, SolveError, Solved, solved_for_waves,
};
use std::sync::Arc;
use wavestep_polynomial::{Rational, Symbol};

/// The most characters of what stands beside a constant on the left of its equation.
const BESIDE: usize = 50;

fn flat(value: &Fraction, n: Notation) -> String {
    write_flat(&arrange(&value.into(), None), n)
}

fn symbol(name: &str) -> Symbol {
    Symbol::new(name).expect("a name")
}

impl Derivation {
    /// The pieces of the first `shown` waves on the periods `first … last`, and of the waves that were added to
    /// uncouple them.
    pub fn pieces(&mut self, recurrence: &Recurrence, first: usize, last: usize, shown: usize) {
        self.heading("The pieces, step by step");
        let told = |wave| Told::of(recurrence, wave, shown);
        let all = solved_for_waves(recurrence);
        let integrated = |solved: &Solved<'_>| {
            solved.step.start.is_some() && told(solved.step.wave) == Told::Steps
        };
        if all.iter().any(integrated) {
            let [a, w, q] = [&["a", "b"], &["w", "y"], &["q", "h"]]
                .map(|names: &[_; 2]| free_name(recurrence, names));
            self.tell(|n| {
                let [a, w, q, s] = [&a, &w, &q, &recurrence.statement().local].map(|x| n.symbol(x));
                let times = n.times_symbol();
                let factor = n.exponential(&format!("{a}{times}{s}"));
                format!(
                    "An equation ${w}' + {a}{times}{w} = {q}$ is multiplied by its integrating factor \
                     ${factor}$: its left side becomes the derivative of ${factor}{times}{w}$. The integral \
                     runs from ${s} = 0$, the beginning of the period. The constant of integration is \
                     ${w}(0)$, which continuity gives."
                )
            });
        }
        if let Err(error) = self.each_period(recurrence, &all, first, last, told) {
            self.sentence(format!("Further steps are not shown: {error}."));
        }
    }

    fn each_period(
        &mut self,
        recurrence: &Recurrence,
        all: &[Solved<'_>],
        first: usize,
        last: usize,
        told: impl Fn(WaveIndex) -> Told,
    ) -> Result<(), SolveError> {
        let mut solver = PeriodByPeriod::new(recurrence);
        (0..first).try_for_each(|_| solver.advance())?;
        let (mut before, mut quiet): (Vec<PieceSteps>, _) = (Vec::new(), None);
        for n in first..=last {
            solver.advance()?;
            let every: Vec<PieceSteps> =
                all.iter().map(|solved| solver.steps(solved, n)).collect::<Result<_, _>>()?;
            let same = |i: usize| {
                told(all[i].step.wave) == Told::Nothing || every[i].piece == before[i].piece
            };
            if n > first && (0..all.len()).all(same) {
                quiet.get_or_insert(n);
                continue;
            }
            if let Some(quiet) = quiet.take() {
                self.quiet(recurrence, quiet, n - 1);
            }
            self.period(recurrence, n, n, "");
            let mut number = 0;
            for (solved, steps) in all.iter().zip(&every) {
                let told = told(solved.step.wave);
                let piece = Piece { recurrence, solved, steps, n };
                number += usize::from(told == Told::Steps);
                match (told, &solved.step.start, &steps.integration) {
                    (Told::Nothing, ..) => {}
                    (Told::Result, ..) => {
                        self.after(
                            "Solved together, the coupled equations give",
                            vec![piece.result()],
                        );
                    }
                    (Told::Steps, Some(start), Some(integration)) => {
                        piece.integrated(self, start, integration, number);
                    }
                    (Told::Steps, ..) => {
                        let equations = piece.equation().into_iter().chain([piece.result()]);
                        self.after("By substitution:", equations.collect());
                    }
                }
            }
            before = every;
        }
        if let Some(quiet) = quiet {
            self.quiet(recurrence, quiet, last);
        }
        Ok(())
    }

    /// Periods on which every wave is the same function of local time as before.
    fn quiet(&mut self, recurrence: &Recurrence, from: usize, to: usize) {
        let rest =
            format!(" All waves are the same functions of local time as on period {}.", from - 1);
        self.period(recurrence, from, to, &rest);
    }

    fn period(&mut self, recurrence: &Recurrence, from: usize, to: usize, rest: &str) {
        self.gap();
        let at = |n: usize| recurrence.statement().period.scale(&Rational::from_integer(n.into()));
        let [begins, ends] = [at(from), at(to + 1)];
        let which =
            if from == to { format!("Period {from}") } else { format!("Periods {from} to {to}") };
        self.tell(|n| {
            format!("{which}, from ${}$ to ${}$.{rest}", flat(&begins, n), flat(&ends, n))
        });
    }
}

/// A piece and how it is found.
struct Piece<'a> {
    recurrence: &'a Recurrence,
    solved: &'a Solved<'a>,
    steps: &'a PieceSteps,
    n: usize,
}

impl Piece<'_> {
    /// `f[1]`.
    fn name(&self, n: Notation) -> String {
        n.indexed(&self.recurrence.wave_name(self.solved.step.wave), &self.n.to_string())
    }

    fn writer(&self, n: usize) -> Writer<'_> {
        Writer::at(self.recurrence, Place::Period(n))
    }

    fn formula(&self, head: impl Fn(Notation) -> String, right: &Expression) -> Formula {
        Formula::new(Head::both(head), right, &self.recurrence.statement().local)
    }

    fn result(&self) -> Formula {
        let local = &self.recurrence.statement().local;
        self.formula(|n| format!("{}({})", self.name(n), n.symbol(local)), &self.steps.piece)
    }

    /// The solved equation on this period, where its right side holds waves.
    fn equation(&self) -> Option<Formula> {
        let Solved { step, right } = self.solved;
        let mut lags = right.operators().flat_map(|(_, operator)| operator.lags());
        let holds = lags.any(|lag| lag <= self.n);
        holds.then(|| self.writer(self.n).equation(&step.left(), right))
    }

    fn integrated(&self, to: &mut Derivation, start: &Start, steps: &Integration, number: usize) {
        let local = &self.recurrence.statement().local;
        let equation = self.equation();
        to.tell(|n| {
            let (of, period) = (n.name(&self.recurrence.wave_name(self.solved.step.wave)), self.n);
            let equation_of = match n {
                Notation::Text => format!("The equation of {of} for n = {period}"),
                Notation::Latex => {
                    format!("Equation \\eqref{{{RECURRENCE}-{number}}} for $n = {period}$")
                }
                Notation::MathMl => format!("The equation of ${of}$ for $n = {period}$"),
            };
            let put_in =
                if equation.is_some() { ", and with the known pieces put in:" } else { " is" };
            equation_of + put_in
        });
        let left = self.writer(self.n).written(&self.solved.step.left());
        let known = Formula::new(left, &self.steps.right, local);
        to.equations(equation.into_iter().chain([known]).collect());
        if self.steps.right.is_zero() && steps.constant.is_zero() {
            to.sentence("The wave is zero at the beginning, and stays so:");
            return to.equations(vec![self.result()]);
        }
        let exponent = start.exponent(local);
        let factor =
            |n: Notation| n.exponential(&write_flat(&arrange(&(&exponent).into(), Some(local)), n));
        let product = |n: Notation| match exponent.is_zero() {
            true => self.name(n),
            false => format!("{}{}{}", factor(n), n.times_symbol(), self.name(n)),
        };
        let mut equations = Vec::new();
        if !exponent.is_zero() {
            let head = |n: Notation| format!("{}'", n.enclosed(&product(n)));
            equations.push(self.formula(head, &steps.integrand));
        }
        let constant = |n: Notation| format!("{}(0)", self.name(n));
        let stand_in = symbol("wave_at_start");
        let names = Arc::new(Names::from([(stand_in.clone(), Name::plain(constant))]));
        let with = |value: &Expression| {
            let mut terms = vec![(Sign::Plus, Tree::Symbol(stand_in.clone()))];
            terms.extend(arrange(value, Some(local)));
            terms
        };
        let head = Head::both(|n| format!("{}({})", product(n), n.symbol(local)));
        equations.push(Formula::of(head, Right::Named(with(&steps.integral), names.clone())));
        to.tell(|n| match exponent.is_zero() {
            true => "Integrated:".to_owned(),
            false => format!("Multiplied by ${}$, and integrated:", factor(n)),
        });
        to.equations(equations);
        to.tell(|n| self.continuity(start, n));
        let beside = |n: Notation| write_named(&with(&steps.beside), n, &names).text().to_owned();
        let mut equations = Vec::new();
        if !steps.beside.is_zero() && beside(Notation::Text).len() < BESIDE {
            equations.push(self.formula(beside, &steps.before));
        }
        equations.push(self.formula(constant, &steps.constant));
        to.equations(equations);
        to.sentence("So the piece is");
        to.equations(vec![self.result()]);
    }

    /// What continuity says at the beginning of the period.
    fn continuity(&self, start: &Start, n: Notation) -> String {
        let form =
            |period| self.writer(period).right(&start.continuous).written(n).text().to_owned();
        let Statement { local, period, .. } = self.recurrence.statement();
        let (s, now) = (n.symbol(local), form(self.n));
        let Some(before) = self.n.checked_sub(1) else {
            return format!("At the start, ${s} = 0$, ${now}$ is given:");
        };
        let (end, form) = (flat(period, n), form(before));
        format!(
            "By continuity ${now}$ at ${s} = 0$ is ${form}$ at ${s} = {end}$, the end of period {before}:"
        )
    }
}

impl Derivation {
    /// The forms for every n of the first `shown` waves, and why they hold.
    pub fn general_forms(&mut self, solution: &Solution, shown: usize) {
        let (recurrence, index) = (solution.recurrence(), symbol("n"));
        // The step from one echo to the next is explained once for all waves for which it is the same.
        let mut explained: Vec<&EchoTemplate> = Vec::new();
        let mut all = solved_for_waves(recurrence);
        all.retain(|solved| solved.step.wave < shown);
        all.sort_by_key(|solved| solved.step.wave);
        let known = all.iter().filter_map(|of| Some((of, solution.general(of.step.wave).ok()?)));
        for (i, (solved, form)) in known.enumerate() {
            match i {
                0 => self.heading("The form for every n"),
                _ => self.gap(),
            }
            let wave = &recurrence.statement().waves[solved.step.wave];
            self.tell(|n| format!("For ${}$ it is", n.name(wave)));
            self.equations(general_form(recurrence, solved.step.wave, form));
            match form {
                GeneralForm::Geometric(form) => {
                    let step = SequenceStep::of(solution, solved, &index);
                    if let Some(step) = step.filter(|step| step.left == step.right) {
                        self.sequence(recurrence, solved, &step, &index, form.first.len());
                    }
                }
                GeneralForm::Echoes(template) if !template.terms.is_empty() => {
                    let alike = |known: &&EchoTemplate| {
                        (known.step(), &known.rate, &known.family)
                            == (template.step(), &template.rate, &template.family)
                    };
                    self.echoes(recurrence, wave, template, explained.iter().any(alike));
                    explained.push(template);
                }
                GeneralForm::Echoes(_) => {}
            }
        }
    }

    /// The step from k to k + 1 for echoes.
    fn echoes(
        &mut self,
        recurrence: &Recurrence,
        wave: &str,
        template: &EchoTemplate,
        alike: bool,
    ) {
        let (k, y) = (echo_index(recurrence), free_name(recurrence, &["y", "z"]));
        let name = laguerre_name(recurrence);
        let (k, next, first) = (k.name(), format!("{k}+1"), template.first.len());
        let (x, (by_slope, by_value)) = (&recurrence.statement().local, template.step());
        let echo = |index: &str, end: &'static str| {
            let index = index.to_owned();
            move |n: Notation| {
                let echo = n.echo(wave, &index, "").trim_end_matches("()").to_owned();
                match (n, end) {
                    // A prime would be a second superscript.
                    (Notation::Latex, "'") => format!("{{{echo}}}'"),
                    _ => echo + end,
                }
            }
        };
        let head = |right: Right| Head::both(|n| right.written(n).text().to_owned());
        let one = Fraction::one();
        let left = combination([(&one, echo(&next, "'")), (&template.rate, echo(&next, ""))]);
        let right = combination([(&by_slope, echo(k, "'")), (&by_value, echo(k, ""))]);
        let start = combination([(&one, echo(&next, "(0)"))]);
        let alone = recurrence.wave_count() == 1;
        let others = if alone { "The" } else { "With the other waves eliminated, the" };
        self.tell(|n| {
            format!(
                "{others} recurrence gives each echo by the one before, from ${} = {first}$ on:",
                n.name(k)
            )
        });
        self.equations(vec![
            Formula::of(head(left), right),
            Formula::of(head(start), combination([(&by_slope, echo(k, "(0)"))])),
        ]);
        if alike {
            return self.sentence("The form satisfies this as before.");
        }
        self.tell(|n| {
            let (local, y) = (n.symbol(x), n.symbol(&y));
            let Family::Laguerre(scale) = &template.family else {
                let power = |k: &str, factorial| format!("{}/{factorial}", n.power(&local, k));
                let (later, now) = (power(&next, format!("({next})!")), power(k, format!("{k}!")));
                return format!(
                    "The form satisfies this, since ${later}$ has the derivative ${now}$ and is 0 at ${local} = 0$."
                );
            };
            let laguerre = |index: &str, prime: &str| n.laguerre(&name, prime, index, &y);
            let binomial = match n {
                Notation::Text => format!("binomial({k}, p)*"),
                Notation::Latex => format!("\\binom{{{k}}}{{p}} "),
                Notation::MathMl => mathml::binomial(k, "p"),
            };
            let argument = flat(&(scale * &Fraction::symbol(x)), n);
            let all = if template.terms.len() > 1 { ", and the same for other indices" } else { "" };
            format!(
                "With the form put in and ${y} = {argument}$ this is ${} = {} - {}${all}. It is Pascal's rule for \
                 the coefficients ${binomial}(-1)^p/p!$ of ${y}^p$ in ${}$; at ${local} = 0$ all polynomials are 1.",
                laguerre(&next, "'"),
                laguerre(k, "'"),
                laguerre(k, ""),
                laguerre(k, ""),
            )
        });
    }

    /// The step from n to n + 1 for a sequence.
    fn sequence(
        &mut self,
        recurrence: &Recurrence,
        solved: &Solved<'_>,
        step: &SequenceStep,
        n: &Symbol,
        first: usize,
    ) {
        let writer = Writer::at(recurrence, Place::General(step.later));
        let power = |(stand_in, ratio): &(Symbol, Expression)| {
            let tree = Tree::Power(Box::new(ratio_tree(ratio)), Box::new(Tree::Symbol(n.clone())));
            (stand_in.clone(), Name::plain(|n| write_flat(&[(Sign::Plus, tree.clone())], n)))
        };
        let names: Arc<Names> = Arc::new(step.powers.iter().map(power).collect());
        let side = |form, value| {
            let variable = step.powers.first().map_or(n, |(stand_in, _)| stand_in);
            Formula::of(
                writer.written(form),
                Right::Named(arrange(value, Some(variable)), names.clone()),
            )
        };
        self.tell(|_| format!("Put into the equation for $n + {}$ it gives", step.later));
        self.equations(vec![
            side(&solved.step.left(), &step.left),
            side(&solved.right, &step.right),
        ]);
        self.tell(|n| {
            let all = n.choose("n >= ", "n \\ge ");
            format!("The sides agree, and so do the first values: the form holds for all ${all}{first}$.")
        });
    }
}

/// A sum of factors times what has these names.
fn combination<const N: usize>(parts: [(&Fraction, impl Fn(Notation) -> String); N]) -> Right {
    let (mut terms, mut names) = (Vec::new(), Names::new());
    for (i, (factor, name)) in parts.into_iter().enumerate() {
        let stand_in = symbol(&format!("part_{i}"));
        terms.extend(arrange(&(factor * &Fraction::symbol(&stand_in)).into(), None));
        names.insert(stand_in, Name::plain(name));
    }
    Right::Named(terms, Arc::new(names))
}
