//! General forms, and the equations for which none was found, as formulas.

use crate::export::arrangement::arrange;
use crate::export::formula::{Formula, Head, Right, since};
use crate::export::notation::Notation::{self, Text};
use crate::export::notation::both;
use crate::export::tree::{Sign, Term, Tree};
use crate::export::writer::write_flat;
use crate::expression::{Assumptions, Expression, Fraction};
use crate::recurrence::{Recurrence, Statement, WaveIndex};
use crate::solution::{
    EchoTemplate, Family, GeneralForm, Geometric, GeometricTerm, Proof, Unknown,
};
use num_traits::{One, Zero};
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// The first of these names that has no meaning in the recurrence.
pub(super) fn free_name(recurrence: &Recurrence, names: &[&str]) -> Symbol {
    let numbered = (1..).map(|i| format!("{}{i}", names[0]));
    let mut candidates = names.iter().map(ToString::to_string).chain(numbered);
    let free =
        candidates.find(|name| !recurrence.takes(name)).expect("there is always another number");
    Symbol::new(&free).expect("a name")
}

/// The number of an echo.
pub(super) fn echo_index(recurrence: &Recurrence) -> Symbol {
    free_name(recurrence, &["k", "j", "m", "i", "l"])
}

/// The name of the Laguerre polynomials.
pub(super) fn laguerre_name(recurrence: &Recurrence) -> Symbol {
    free_name(recurrence, &["L", "Lambda"])
}

/// The formulas that give a wave in general n, each proved as its remark says.
pub fn general_form(recurrence: &Recurrence, wave: WaveIndex, form: &GeneralForm) -> Vec<Formula> {
    general_form_from(recurrence, wave, form, &Fraction::zero())
}

/// The same of what has its first period from a time `offset` on.
pub fn general_form_from(
    recurrence: &Recurrence,
    wave: WaveIndex,
    form: &GeneralForm,
    offset: &Fraction,
) -> Vec<Formula> {
    let mut formulas = match form {
        GeneralForm::Geometric(form) => geometric(recurrence, wave, form),
        GeneralForm::Echoes(template) => echoes(recurrence, wave, template, offset),
    };
    if let Some(last) = formulas.last_mut() {
        let (index, first) = match form {
            GeneralForm::Geometric(form) => ("n".to_owned(), form.first.len()),
            GeneralForm::Echoes(template) => {
                (echo_index(recurrence).to_string(), template.first.len())
            }
        };
        let proof = match form.proof() {
            Proof::Substitution => "substitution into the recurrence".to_owned(),
            Proof::CoefficientIdentity => format!("the step from {index} to {index} + 1"),
        };
        let has_laguerre = matches!(form, GeneralForm::Echoes(own) if own.family != Family::Power);
        let [of_text, of_latex] = match has_laguerre.then(|| laguerre_name(recurrence)) {
            None => Default::default(),
            Some(name) => [
                format!("; {name} are the Laguerre polynomials"),
                format!("{}_{{{index}}}\\text{{: Laguerre}}", Notation::Latex.symbol(&name)),
            ],
        };
        let mut text = format!("for {index} >= {first}, proved by {proof}{of_text}");
        let first = (first > 0).then(|| format!("{index} \\ge {first}"));
        let of_latex = Some(of_latex).filter(|own| !own.is_empty());
        let mut latex: String =
            [first, of_latex].into_iter().flatten().collect::<Vec<_>>().join(",\\ ");
        if !offset.is_zero() && matches!(form, GeneralForm::Geometric(_)) {
            let (of_text, of_latex) = both(|n| on_period_from(recurrence, offset, n));
            text = format!("{of_text}, {text}");
            latex = if latex.is_empty() { of_latex } else { format!("{of_latex},\\ {latex}") };
        }
        last.remark = Some((text, latex));
    }
    formulas
}

/// `o + n*D <= t < o + (n+1)*D`.
pub(super) fn on_period_from(
    recurrence: &Recurrence,
    offset: &Fraction,
    notation: Notation,
) -> String {
    let Statement { period, time, .. } = recurrence.statement();
    let n = Symbol::new("n").expect("a name");
    let begins = offset + &(period * &Fraction::symbol(&n));
    let ends = &begins + period;
    let [begins, ends] =
        [begins, ends].map(|bound| write_flat(&arrange(&Expression::from(bound), None), notation));
    format!("{begins} {} {} < {ends}", notation.choose("<=", "\\le"), notation.symbol(time))
}

fn geometric(recurrence: &Recurrence, wave: WaveIndex, form: &Geometric) -> Vec<Formula> {
    let wave = &recurrence.statement().waves[wave];
    let n = Symbol::new("n").expect("a name");
    let formula = |index: &str, terms: Vec<Term>| {
        Formula::of(Head::both(|n| n.indexed(wave, index)), Right::Terms(terms))
    };
    let first = form.first.iter().enumerate();
    let mut formulas: Vec<Formula> =
        first.map(|(i, value)| formula(&i.to_string(), arrange(value, None))).collect();
    let mut terms = Vec::new();
    let polynomial = form.terms.iter().filter(|term| term.ratio.is_one());
    let polynomial = polynomial.fold(Expression::zero(), |sum, term| {
        let power = Polynomial::symbol(&n).pow(term.power);
        &sum + &(&term.coefficient * &power.into())
    });
    terms.extend(arrange(&polynomial, Some(&n)));
    for term in form.terms.iter().filter(|term| !term.ratio.is_one()) {
        terms.push(geometric_term(term, &n));
    }
    formulas.push(formula("n", terms));
    formulas
}

/// `c n^j λ^n`; where `c/λ` is a number and `c` is not, `(c/λ) n^j λ^{n+1}`.
fn geometric_term(term: &GeometricTerm, n: &Symbol) -> Term {
    let proportion = term.coefficient.proportion(&term.ratio);
    let (coefficient, more) = match (term.coefficient.as_constant(), proportion) {
        (None, Some(number)) => (Expression::constant(&number), 1),
        _ => (term.coefficient.clone(), 0),
    };
    let exponent = &Polynomial::symbol(n) + &Polynomial::integer(more);
    let exponent = Tree::sum(arrange(&exponent.into(), Some(n))).1;
    let base = ratio_tree(&term.ratio);
    let power = Tree::Power(Box::new(base), Box::new(exponent));
    let (sign, coefficient) = Tree::sum(arrange(&coefficient, None));
    let mut factors = coefficient.into_factors();
    if term.power > 0 {
        factors.push(Tree::power(Tree::Symbol(n.clone()), term.power));
    }
    factors.push(power);
    (sign, Tree::product(factors))
}

/// A ratio as the base of a power, without a sign in front where a sum can take it:
/// `(r - 1)/(r + 1)` rather than `-(1 - r)/(1 + r)`.
pub(super) fn ratio_tree(ratio: &Expression) -> Tree {
    let terms = arrange(ratio, None);
    match &terms[..] {
        [(Sign::Minus, Tree::Quotient(top, bottom))] => match &**top {
            Tree::Sum(top) => {
                let minus = |(sign, tree): &Term| (sign.times(Sign::Minus), tree.clone());
                let reversed = top.iter().rev().map(minus).collect();
                let bottom = match &**bottom {
                    Tree::Sum(bottom) => Tree::Sum(bottom.iter().rev().cloned().collect()),
                    other => other.clone(),
                };
                Tree::Quotient(Box::new(Tree::Sum(reversed)), Box::new(bottom))
            }
            _ => negative(Tree::Quotient(top.clone(), bottom.clone())),
        },
        [(Sign::Minus, other)] => negative(other.clone()),
        _ => Tree::sum(terms).1,
    }
}

/// `−x` as a base: a sum of one term, which is written with brackets.
fn negative(tree: Tree) -> Tree {
    Tree::Sum(vec![(Sign::Minus, tree)])
}

fn echoes(
    recurrence: &Recurrence,
    wave: WaveIndex,
    template: &EchoTemplate,
    offset: &Fraction,
) -> Vec<Formula> {
    let statement = recurrence.statement();
    let wave = &statement.waves[wave];
    let (x, k) = (&statement.local, echo_index(recurrence));
    let mut formulas = vec![sum_of_echoes(recurrence, wave, offset)];
    for (i, echo) in template.first.iter().enumerate() {
        formulas.push(Formula::echo(wave, &[i], echo, x));
    }
    let head = Head::both(|n| n.echo(wave, k.name(), &n.symbol(x)));
    let terms = template_terms(template, x, &k, &laguerre_name(recurrence));
    formulas.push(Formula::of(head, Right::Terms(terms)));
    formulas
}

/// `f(t) = sum(phi_f[k](t - D*k), 0 <= D*k <= t)`, with `o + D*k` where the first period begins at `o`.
pub(super) fn sum_of_echoes(recurrence: &Recurrence, wave: &str, offset: &Fraction) -> Formula {
    let statement = recurrence.statement();
    let (t, k) = (&statement.time, echo_index(recurrence));
    let delay = &statement.period * &Fraction::symbol(&k);
    let [delay, later, offset] =
        [delay.clone(), offset + &delay, offset.clone()].map(Expression::from);
    let head = Head::both(|n| format!("{}({})", n.name(wave), n.symbol(t)));
    let right = Right::both(|n| {
        let [delay, later, offset] =
            [&delay, &later, &offset].map(|value| write_flat(&arrange(value, None), n));
        let [argument, latest] = [later, offset].map(|start| since(&n.symbol(t), &start));
        let echo = n.echo(wave, k.name(), &argument);
        n.sum_between(&delay, &latest, &echo)
    });
    Formula::of(head, right)
}

/// `ρ^k e^{−bx} Σ_i c_i T_{k−i}(x)`.
fn template_terms(template: &EchoTemplate, x: &Symbol, k: &Symbol, name: &Symbol) -> Vec<Term> {
    let mut sum = Vec::new();
    for (lag, coefficient) in &template.terms {
        let index = &Polynomial::symbol(k) - &Polynomial::integer(*lag);
        let index = Tree::sum(arrange(&index.into(), Some(k))).1;
        let function = match &template.family {
            Family::Laguerre(c) => {
                laguerre(name, index, &Expression::from(c * &Fraction::symbol(x)), x)
            }
            Family::Power => {
                let power = Tree::Power(Box::new(Tree::Symbol(x.clone())), Box::new(index.clone()));
                Tree::Quotient(Box::new(power), Box::new(Tree::Factorial(Box::new(index))))
            }
        };
        let (sign, factor) = Tree::sum(arrange(&coefficient.into(), None));
        let mut factors = factor.into_factors();
        factors.push(function);
        sum.push((sign, Tree::product(factors)));
    }
    let mut front = Vec::new();
    if !template.ratio.is_one() {
        let base = ratio_tree(&template.ratio.clone().into());
        front.push(Tree::Power(Box::new(base), Box::new(Tree::Symbol(k.clone()))));
    }
    if !template.rate.is_zero() {
        let exponent = -&(&template.rate * &Fraction::symbol(x));
        let (sign, exponent) = Tree::sum(arrange(&exponent.into(), Some(x)));
        front.push(Tree::Exponential(sign, Box::new(exponent)));
    }
    let (sign, body) = Tree::sum(sum);
    match body {
        Tree::Product(mut factors) => {
            // A number leads.
            if let Some(Tree::Number(_)) = factors.first() {
                front.insert(0, factors.remove(0));
            }
            front.extend(factors);
        }
        Tree::Number(value) if value.is_zero() => return Vec::new(),
        Tree::Number(value) if value.is_one() => {}
        Tree::Sum(terms) => front.push(Tree::Bracket(terms)),
        other => front.push(other),
    }
    vec![(sign, Tree::product(front))]
}

fn laguerre(name: &Symbol, index: Tree, argument: &Expression, x: &Symbol) -> Tree {
    let argument = match &arrange(argument, Some(x))[..] {
        [(Sign::Plus, tree)] => tree.clone(),
        [] => Tree::Number(Rational::zero()),
        terms => Tree::Sum(terms.to_vec()),
    };
    Tree::Laguerre(name.clone(), Box::new(index), Box::new(argument))
}

/// Names for the derivative and for the delay by one period, in [`operator_of`].
pub fn operator_names(recurrence: &Recurrence) -> (Symbol, Symbol) {
    let p = free_name(recurrence, &["p", "s", "P", "S"]);
    (p, free_name(recurrence, &["q", "z", "Q", "Z"]))
}

/// The equation for which no closed form was found, in the names of [`operator_names`]:
/// `(p + 1 + (1 - p)*q)*f = 0`.
pub fn operator_of(recurrence: &Recurrence, unknown: &Unknown) -> String {
    let (p, q) = operator_names(recurrence);
    let (slope, delay) = (Expression::symbol(&p), Expression::symbol(&q));
    let mut parts = Vec::new();
    for (wave, operator) in unknown.equation.operators() {
        let mut sum = Expression::zero();
        let mut power = Expression::one();
        for lag in 0..operator.reach() {
            let both = &operator.value_at(lag) + &(&operator.slope_at(lag) * &slope);
            sum += &(&both * &power);
            power = &power * &delay;
        }
        let text = write_flat(&arrange(&sum, Some(&q)), Text);
        parts.push(format!("({text})*{}", recurrence.wave_name(wave)));
    }
    let forced = !unknown.equation.forcing_terms().is_empty();
    parts.extend(forced.then(|| "forcing".to_owned()));
    format!("{} = 0", parts.join(" + "))
}

/// The factors of more than one term that are taken to be non-zero, as text.
pub fn assumed_factors(assumptions: &Assumptions) -> Vec<String> {
    let factor = |p: &Polynomial| write_flat(&arrange(&p.clone().into(), None), Text);
    assumptions.factors().filter(|p| p.term_count() > 1).map(factor).collect()
}
