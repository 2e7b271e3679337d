//! A derivation goes on: from the recurrence to its pieces step by step, and to the form for every n.

use crate::export::arrangement::arrange;
use crate::export::explain::{Derivation, RECURRENCE};
use crate::export::forms::{Place, Writer};
use crate::export::formula::{Formula, Head, Right};
use crate::export::general::{echo_index, free_name, general_form, ratio_tree, template_terms};
use crate::export::names::{Name, Names};
use crate::export::notation::{Notation, both};
use crate::export::tree::{Sign, Tree};
use crate::export::writer::{write_flat, write_named};
use crate::expression::{Expression, Fraction};
use crate::recurrence::{Recurrence, Start, Statement};
use crate::solution::{
    EchoStep, EchoTemplate, GeneralForm, Integration, Lesson, PieceSteps, PowerSum, SequenceStep,
    Solution, Solved,
};
use std::sync::Arc;
use wavestep_polynomial::{Rational, Symbol};

/// The most characters of what stands beside a constant on the left of its equation.
const BESIDE: usize = 50;

fn flat(value: &Fraction, n: Notation) -> String {
    write_flat(&arrange(&value.into(), None), n)
}

impl Derivation {
    /// The pieces of the first `shown` waves, and of those that were added to uncouple them.
    pub fn pieces(&mut self, recurrence: &Recurrence, lesson: &Lesson<'_>, shown: usize) {
        let Statement { waves, local, period, .. } = recurrence.statement();
        self.heading("The pieces, step by step");
        let told =
            |solved: &Solved<'_>| solved.step.wave < shown || solved.step.wave >= waves.len();
        let rate = |solved: &Solved<'_>| solved.step.start.is_some() && told(solved);
        if lesson.solved.iter().any(rate) {
            self.tell(|n| {
                let (s, lambda) = (n.symbol(local), n.name("lambda"));
                let factor = n.exponential(&format!("{lambda}{}{s}", n.times_symbol()));
                let left = format!("w' + {lambda}{}w", n.times_symbol());
                format!(
                    "An equation ${left} = r$ is multiplied by its integrating factor ${factor}$. Its left \
                     side is then the derivative of ${factor}{}w$. Both sides are integrated from 0, the \
                     beginning of the period, to ${s}$. The constant of integration is $w$ at ${s} = 0$; \
                     continuity gives it.",
                    n.times_symbol()
                )
            });
        }
        if !recurrence.coupled().is_empty() {
            self.sentence(
                "Where several equations are coupled by their derivatives, the recurrence is written in \
                 combinations of waves, eigenvectors of the coupling, that have an equation each.",
            );
        }
        for (n, steps) in &lesson.periods {
            let begins = period.scale(&Rational::from_integer((*n).into()));
            let ends = &begins + period;
            self.gap();
            self.tell(|form| {
                format!("Period {n} is from ${}$ to ${}$.", flat(&begins, form), flat(&ends, form))
            });
            let mut substituting = false;
            for (number, (solved, steps)) in lesson.solved.iter().zip(steps).enumerate() {
                if !told(solved) {
                    continue;
                }
                let told = Told { recurrence, solved, steps, n: *n, number: number + 1 };
                match (&solved.step.start, &steps.integration) {
                    (Some(start), Some(integration)) => {
                        told.integrated(self, start, integration);
                        substituting = false;
                    }
                    _ => {
                        if !substituting {
                            self.sentence("By substitution of what is known:");
                        }
                        substituting = true;
                        let mut equations = vec![told.equation(), told.piece()];
                        equations.drain(..usize::from(told.is_put_in()));
                        self.equations(equations);
                    }
                }
            }
        }
        if let Some(error) = &lesson.stopped {
            self.sentence(format!("Further steps are not shown: {error}."));
        }
    }
}

/// The steps of one piece, to be told.
struct Told<'a> {
    recurrence: &'a Recurrence,
    solved: &'a Solved<'a>,
    steps: &'a PieceSteps,
    n: usize,
    /// The number of the equation in the recurrence, from 1 on.
    number: usize,
}

impl Told<'_> {
    /// `f[1]`.
    fn name(&self, n: Notation) -> String {
        n.indexed(&self.recurrence.wave_name(self.solved.step.wave), &self.n.to_string())
    }

    fn equation(&self) -> Formula {
        let writer = Writer::at(self.recurrence, Place::Period(self.n));
        writer.equation(&self.solved.step.left(), &self.solved.right)
    }

    /// Whether the right side holds no waves, so that nothing is put in.
    fn is_put_in(&self) -> bool {
        let known = |(_, operator): (_, &crate::recurrence::Operator)| {
            operator.lags().any(|lag| lag <= self.n)
        };
        !self.solved.right.operators().any(known)
    }

    fn new(&self, head: impl Fn(Notation) -> String, right: &Expression) -> Formula {
        Formula::new(Head::both(head), right, &self.recurrence.statement().local)
    }

    fn piece(&self) -> Formula {
        let local = &self.recurrence.statement().local;
        self.new(|n| format!("{}({})", self.name(n), n.symbol(local)), &self.steps.piece)
    }

    fn integrated(&self, to: &mut Derivation, start: &Start, steps: &Integration) {
        let local = &self.recurrence.statement().local;
        let wave = self.recurrence.wave_name(self.solved.step.wave);
        to.tell(|n| match n {
            Notation::Text => format!("The equation of {wave} for n = {} is", self.n),
            Notation::Latex => {
                format!("Equation \\eqref{{{RECURRENCE}-{}}} for $n = {}$ is", self.number, self.n)
            }
        });
        let put_in = self.is_put_in();
        if !put_in {
            to.equations(vec![self.equation()]);
            to.sentence("With the known pieces put in:");
        }
        let left =
            Writer::at(self.recurrence, Place::Period(self.n)).written(&self.solved.step.left());
        let known = Formula::new(left, &self.steps.right, local);
        to.equations(vec![known]);
        if self.steps.right.is_zero() && steps.constant.is_zero() {
            to.sentence("Nothing acts, and the wave is zero at the beginning:");
            return to.equations(vec![self.piece()]);
        }
        let exponent = start.exponent(local);
        let factor = |n: Notation| match exponent.is_zero() {
            true => String::new(),
            false => n.exponential(&write_flat(&arrange(&(&exponent).into(), Some(local)), n)),
        };
        let times = |n: Notation| if exponent.is_zero() { "" } else { n.times_symbol() };
        if !exponent.is_zero() {
            to.tell(|n| format!("Times ${}$:", factor(n)));
            let head = |n: Notation| {
                let product = format!("{}{}{}", factor(n), times(n), self.name(n));
                format!("{}'", n.enclosed(&product))
            };
            to.equations(vec![self.new(head, &steps.integrand)]);
        }
        to.tell(|n| format!("Integrated from 0 to ${}$:", n.symbol(local)));
        let constant = |n: Notation| format!("{}(0)", self.name(n));
        let stand_in = Symbol::new("wave_at_start").expect("a name");
        let names = Arc::new(Names::from([(stand_in.clone(), Name::plain(both(constant)))]));
        let with = |value: &Expression| {
            let mut terms = vec![(Sign::Plus, Tree::Symbol(stand_in.clone()))];
            terms.extend(arrange(value, Some(local)));
            terms
        };
        let head = Head::both(|n| {
            format!("{}{}{}({})", factor(n), times(n), self.name(n), n.symbol(local))
        });
        to.equations(vec![Formula::of(head, Right::Named(with(&steps.integral), names.clone()))]);
        to.tell(|n| self.continuity(start, n));
        let beside = both(|n| write_named(&with(&steps.beside), n, &names).text().to_owned());
        let mut equations = Vec::new();
        if !steps.beside.is_zero() && beside.0.len() < BESIDE {
            let head = |n: Notation| n.choose(&beside.0, &beside.1).to_owned();
            equations.push(self.new(head, &steps.before));
        }
        equations.push(self.new(constant, &steps.constant));
        to.equations(equations);
        to.sentence("So the piece is");
        to.equations(vec![self.piece()]);
    }

    /// What continuity says at the beginning of the period.
    fn continuity(&self, start: &Start, n: Notation) -> String {
        let form = |period: usize| {
            let writer = Writer::at(self.recurrence, Place::Period(period));
            writer.right(&start.continuous).written(n).text().to_owned()
        };
        let Statement { local, period, .. } = self.recurrence.statement();
        let (s, now) = (n.symbol(local), form(self.n));
        if self.n == 0 {
            return format!("The start gives ${now}$ at ${s} = 0$:");
        }
        format!(
            "By continuity ${now}$ at ${s} = 0$ is what ${}$ was at ${s} = {}$, the end of period {}:",
            form(self.n - 1),
            flat(period, n),
            self.n - 1
        )
    }
}

impl Derivation {
    /// The forms for every n of the first `shown` waves, and why they hold.
    pub fn general_forms(&mut self, solution: &Solution, lesson: &Lesson<'_>, shown: usize) {
        let recurrence = solution.recurrence();
        let index = symbol("n");
        // What makes echoes follow from one another is told once for all waves for which it is the same.
        let mut told: Vec<EchoStep> = Vec::new();
        let mut begun = false;
        for wave in 0..shown {
            let solved = lesson.solved.iter().find(|solved| solved.step.wave == wave);
            let (Some(solved), Ok(form)) = (solved, solution.general(wave)) else { continue };
            let sequence = SequenceStep::of(solution, solved, &index).filter(SequenceStep::agrees);
            let echoes = match form {
                GeneralForm::Echoes(template) => {
                    EchoStep::of(template).map(|step| (template, step))
                }
                GeneralForm::Geometric(_) => None,
            };
            if sequence.is_none() && echoes.is_none() {
                continue;
            }
            if !std::mem::replace(&mut begun, true) {
                self.heading("The form for every n");
            } else {
                self.gap();
            }
            self.tell(|n| format!("For ${}$ it is", n.name(&recurrence.statement().waves[wave])));
            self.equations(general_form(recurrence, wave, form));
            if let Some(step) = sequence {
                self.sequence(recurrence, solved, &step, &index);
            }
            match echoes {
                Some((_, step)) if told.contains(&step) => {
                    self.tell(|n| {
                        let k = n.symbol(&echo_index(recurrence));
                        format!("It is made of the same functions $u$, and holds from ${k}$ to ${k} + 1$ as before.")
                    });
                }
                Some((template, step)) => {
                    self.echoes(recurrence, template, &step);
                    told.push(step);
                }
                None => {}
            }
        }
    }

    /// The step from k to k + 1 for echoes.
    fn echoes(&mut self, recurrence: &Recurrence, template: &EchoTemplate, step: &EchoStep) {
        let x = &recurrence.statement().local;
        let (k, name) = (echo_index(recurrence), free_name(recurrence, &["u", "v", "h"]));
        let next = format!("{k}+1");
        let u = |n: Notation, index: &str| n.indexed(name.name(), index);
        // The two sides in symbols for u and its derivative.
        let names = |index: &str| {
            let named = |prime: &str| Name::plain(both(|n| u(n, index) + prime));
            Names::from([(symbol("slope"), named("'")), (symbol("value"), named(""))])
        };
        let side = |slope: &Fraction, value: &Fraction, index: &str| {
            let part = |factor: &Fraction, name| {
                &Expression::from(factor.clone()) * &Expression::symbol(&symbol(name))
            };
            let mut terms = arrange(&part(slope, "slope"), None);
            terms.extend(arrange(&part(value, "value"), None));
            let names = names(index);
            both(|n| write_named(&terms, n, &names).text().to_owned())
        };
        let (slope, value) = step.right();
        let left = side(&Fraction::one(), &step.rate, &next);
        let right = side(&slope, &value, k.name());
        let written = |(text, latex): &(String, String)| Head::new(text.clone(), latex.clone());
        let starts = |factor: &Fraction| {
            let at = |index: &str| both(|n| format!("{}(0)", u(n, index)));
            let names = Names::from([(symbol("value"), Name::plain(at(k.name())))]);
            let product = &Expression::from(factor.clone()) * &Expression::symbol(&symbol("value"));
            Formula::of(written(&at(&next)), Right::Named(arrange(&product, None), Arc::new(names)))
        };
        self.tell(|n| {
            format!(
                "On a period the wave is the sum of the echoes that have arrived. With all other waves \
                 eliminated, the recurrence holds for this sum if each echo of this form follows from the \
                 one before as $u$ of ${next}$ follows from $u$ of ${}$:",
                n.symbol(&k)
            )
        });
        self.equations(vec![
            Formula::of(written(&left), Right::Written(right.0.clone(), right.1.clone())),
            starts(&slope),
        ]);
        self.sentence(
            "This is linear, and the form is a combination with fixed coefficients of the functions",
        );
        let alone = EchoTemplate { terms: vec![(0, Fraction::one())], ..template.clone() };
        let head = Head::both(|n| format!("{}({})", u(n, k.name()), n.symbol(x)));
        self.equations(vec![Formula::of(head, Right::Terms(template_terms(&alone, x, &k)))]);
        // In front of both sides: c rho rho^k exp(-b x), or rho rho^k exp(-b x).
        let factor = step.scale.clone().unwrap_or_else(Fraction::one);
        let front = Expression::from(&factor * &step.ratio);
        let front = front.times_exponential(&-&(&step.rate * &Fraction::symbol(x)));
        let (sign, tree) = Tree::sum(arrange(&front, Some(x)));
        let mut factors = tree.into_factors();
        if !step.ratio.is_one() {
            factors.push(power_of(&step.ratio.clone().into(), &k));
        }
        let front = [(sign, Tree::product(factors))];
        let with_front = |n: Notation, of: String| match &*write_flat(&front, n) {
            "1" => of,
            "-1" => format!("-{of}"),
            front => format!("{front}{}{of}", n.times_symbol()),
        };
        let argument = |n| flat(&(&factor * &Fraction::symbol(x)), n);
        let laguerre = |n: Notation, prime: &str, index: &str, at: &str| match n {
            Notation::Text => format!("L{prime}[{index}]({at})"),
            Notation::Latex => format!("L_{{{index}}}{prime}({at})"),
        };
        let sides = |n: Notation| match step.scale {
            Some(_) => {
                let at = argument(n);
                let (slope, value) =
                    (laguerre(n, "'", k.name(), &at), laguerre(n, "", k.name(), &at));
                [laguerre(n, "'", &next, &at), format!("({slope} - {value})")]
            }
            None => {
                let power = n.power(&n.symbol(x), k.name());
                let whole = n.quotient((&power, false), (&format!("{k}!"), false));
                [whole.clone(), whole]
            }
        };
        self.sentence("With these the left and the right side are");
        let formula = |head, i: usize| {
            Formula::of(written(head), Right::both(|n| with_front(n, sides(n)[i].clone())))
        };
        self.equations(vec![formula(&left, 0), formula(&right, 1)]);
        let from = template.first.len();
        self.tell(|n| {
            let (k, last) = (k.name(), format!("With ${k} = {from}$ derived, the form holds for every ${k}$ after it."));
            if step.scale.is_none() {
                return format!("Both agree, and at ${} = 0$ both are zero. {last}", n.symbol(x));
            }
            let rule = laguerre(n, "'", &next, "y");
            let (slope, value) = (laguerre(n, "'", k, "y"), laguerre(n, "", k, "y"));
            let binomial = |top: &str, bottom: &str| match n {
                Notation::Text => format!("binomial({top}, {bottom})"),
                Notation::Latex => format!("\\binom{{{top}}}{{{bottom}}}"),
            };
            let pascal = format!(
                "{} = {} + {}",
                binomial(&next, "i+1"),
                binomial(k, "i+1"),
                binomial(k, "i")
            );
            let coefficient = format!("{}{}(-1)^i/i!", binomial(k, "i"), n.choose("*", "\\,"));
            format!(
                "Both agree, since ${rule} = {slope} - {value}$, $L'$ the derivative of $L$: ${value}$ has the coefficient ${coefficient}$ \
                 at $y^i$, and ${pascal}$ is Pascal's rule. At ${} = 0$ they agree as well, since ${}$ is 1 \
                 for every ${k}$. {last}",
                n.symbol(x),
                laguerre(n, "", k, "0"),
            )
        });
    }

    /// The step from n to n + 1 for a sequence.
    fn sequence(
        &mut self,
        recurrence: &Recurrence,
        solved: &Solved<'_>,
        step: &SequenceStep,
        index: &Symbol,
    ) {
        let writer = Writer::at(recurrence, Place::General(step.later));
        let side = |head, sum: &PowerSum| {
            let term = |(ratio, coefficient): &(Expression, Expression)| {
                let terms = arrange(coefficient, Some(index));
                if ratio.is_one() {
                    return terms;
                }
                let (sign, tree) = Tree::sum(terms);
                let mut factors = tree.into_factors();
                factors.push(power_of(ratio, index));
                vec![(sign, Tree::product(factors))]
            };
            Formula::of(head, Right::Terms(sum.iter().flat_map(term).collect()))
        };
        self.tell(|_| format!("Put into the equation for $n + {}$, its sides are", step.later));
        self.equations(vec![
            side(writer.written(&solved.step.left()), &step.left),
            side(writer.written(&solved.right), &step.right),
        ]);
        self.sentence("They agree: with the first values the form holds for every $n$.");
    }
}

fn symbol(name: &str) -> Symbol {
    Symbol::new(name).expect("a name")
}

fn power_of(ratio: &Expression, index: &Symbol) -> Tree {
    Tree::Power(Box::new(ratio_tree(ratio)), Box::new(Tree::Symbol(index.clone())))
}
