//! The source's form: its symbols, its units, its constants stated apart, its shorthand.

use crate::export::arrangement::{Arrangement, arrange};
use crate::export::formula::{Formula, Head, Right};
use crate::export::general::{echo_index, general_form_from, on_period_from};
use crate::export::names::{Name, Names};
use crate::export::notation::Notation::{self, Latex, Text};
use crate::export::notation::both;
use crate::export::tree::{Sign, Term, Tree};
use crate::export::writer::{write_flat, write_named};
use crate::expression::{Expression, Fraction};
use crate::recurrence::{Recurrence, SourceProduct, WaveIndex};
use crate::solution::{GeneralForm, KeptEnds};
use num_traits::{One, Signed};
use std::sync::Arc;
use wavestep_polynomial::{Integer, Rational, Symbol};

/// How the source of a recurrence writes its waves.
pub struct SourceForm<'a> {
    recurrence: &'a Recurrence,
    names: Arc<Names>,
    /// When the first period begins.
    offset: Fraction,
}

impl<'a> SourceForm<'a> {
    /// The notation that the recurrence states; with `ends`, their symbols are written as values of
    /// waves at the end of a period.
    pub fn new(recurrence: &'a Recurrence, ends: Option<&KeptEnds>) -> SourceForm<'a> {
        let statement = recurrence.statement();
        let mut names: Names = statement
            .notation
            .symbols
            .iter()
            .map(|(symbol, value)| (symbol.clone(), name_of(value)))
            .collect();
        let period = arrange(&statement.period.clone().into(), None);
        let end = |n| write_named(&period, n, &names).text().to_owned();
        let end = Notation::ALL.map(end);
        for (symbol, wave, n) in ends.into_iter().flat_map(KeptEnds::symbols) {
            let index = n.to_string();
            let name = Name::plain(|notation| {
                let wave = notation.indexed(name_of_wave(recurrence, wave), &index);
                format!("{wave}({})", end[notation as usize])
            });
            names.insert(symbol.clone(), name);
        }
        SourceForm { recurrence, names: Arc::new(names), offset: Fraction::zero() }
    }

    /// Of what has its first period from a time on.
    #[must_use]
    pub fn beginning(self, offset: &Fraction) -> SourceForm<'a> {
        SourceForm { offset: offset.clone(), ..self }
    }

    /// The formulas of a piece: the wave function, and its constant where it is stated apart.
    pub fn piece(&self, wave: WaveIndex, n: usize, piece: &Expression) -> Vec<Formula> {
        let statement = self.recurrence.statement();
        let symbol = statement.notation.constants.get(&wave).map(|name| {
            Symbol::new(&format!("{name}_{n}")).expect("a name with an index is a name")
        });
        let arrangement = Arrangement {
            variable: Some(statement.local.clone()),
            factored: true,
            constant: symbol.clone(),
        };
        let unit = statement.notation.units.get(&wave);
        let (terms, apart) = match (piece.as_fraction(), unit) {
            // A quotient takes the unit in.
            (Some(value), Some(unit)) if value.as_polynomial().is_none() => {
                (arrange(&(&value * &unit.to_fraction()).into(), None), None)
            }
            (_, Some(unit)) => {
                let (terms, apart) = arrangement.terms(&piece.scale(unit.coefficient()));
                (in_unit(unit, terms), apart)
            }
            _ => arrangement.terms(piece),
        };
        let formula = self.formula(head(self.recurrence, wave, &n.to_string()), terms);
        let mut formulas = match self.offset.is_zero() {
            true => vec![formula],
            false => vec![formula.on_named_period(n, &self.offset, statement, &self.names)],
        };
        if let (Some(apart), Some(symbol)) = (apart, symbol) {
            formulas.push(self.formula(both(|n| n.symbol(&symbol)), apart));
        }
        formulas
    }

    /// A wave in general n, in the source's symbols: single values and the one for every n, or the sum over
    /// echoes and the echoes, which are in no unit.
    pub fn general(&self, wave: WaveIndex, form: &GeneralForm) -> Vec<Formula> {
        let GeneralForm::Geometric(sequence) = form else {
            let mut formulas = general_form_from(self.recurrence, wave, form, &self.offset);
            formulas[0] = self.sum_of_echoes(wave);
            return formulas;
        };
        let unit = self.recurrence.statement().notation.units.get(&wave);
        let sequence = unit.map_or_else(|| sequence.clone(), |u| sequence.scaled(u.coefficient()));
        let last = sequence.first.len();
        let form = GeneralForm::Geometric(sequence);
        let formulas = general_form_from(self.recurrence, wave, &form, &self.offset);
        let written = |(i, formula): (usize, Formula)| {
            let Right::Terms(terms) = formula.right else { return formula };
            let terms = unit.map_or_else(|| terms.clone(), |unit| in_unit(unit, terms.clone()));
            let index = if i == last { "n".to_owned() } else { i.to_string() };
            let written = self.formula(head(self.recurrence, wave, &index), terms);
            Formula { remark: formula.remark, ..written }
        };
        formulas.into_iter().enumerate().map(written).collect()
    }

    /// `f[n] = V/c*sum(phi_f[k](mu*z/L + 2*mu*(n - k)), 0 <= k <= n)`: an echo has run n - k periods longer than
    /// the local time.
    fn sum_of_echoes(&self, wave: WaveIndex) -> Formula {
        let statement = self.recurrence.statement();
        let k = echo_index(self.recurrence);
        let n = Tree::Symbol(Symbol::new("n").expect("a name"));
        let periods = Tree::Sum(vec![(Sign::Plus, n), (Sign::Minus, Tree::Symbol(k.clone()))]);
        let (sign, period) = Tree::sum(arrange(&statement.period.clone().into(), None));
        let mut since = period.into_factors();
        since.push(periods);
        let argument =
            [(Sign::Plus, Tree::Symbol(statement.local.clone())), (sign, Tree::product(since))];
        let echoes = Name::plain(|notation| {
            let argument = write_named(&argument, notation, &self.names);
            let echo = notation.echo(&statement.waves[wave], k.name(), argument.text());
            notation.sum_between(k.name(), "n", &echo)
        });
        let sum = Symbol::new("echoes").expect("a name");
        let names = Names::from_iter([(sum.clone(), echoes)]);
        let sum = Tree::Symbol(sum);
        let unit = statement.notation.units.get(&wave);
        let term = match unit.map(|unit| (unit.coefficient().is_negative(), product_tree(unit))) {
            Some((negative, unit)) => {
                (if negative { Sign::Minus } else { Sign::Plus }, Tree::product(vec![unit, sum]))
            }
            None => (Sign::Plus, sum),
        };
        let (text, latex) = head(self.recurrence, wave, "n");
        let right = Right::Named(vec![term], names.into());
        let remark = (!self.offset.is_zero())
            .then(|| both(|n| on_period_from(self.recurrence, &self.offset, n)));
        Formula { remark, ..Formula::of(Head::new(text, latex), right) }
    }

    fn formula(&self, (text, latex): (String, String), terms: Vec<Term>) -> Formula {
        Formula::of(Head::new(text, latex), Right::Named(terms, self.names.clone()))
    }
}

/// `unit · terms` with the unit's symbols in front, after a number alone.
fn in_unit(unit: &SourceProduct, mut terms: Vec<Term>) -> Vec<Term> {
    let unit = unit.without_number();
    if unit.powers().is_empty() {
        return terms;
    }
    let unit = product_tree(&unit);
    match &terms[..] {
        [] => terms,
        [(_, Tree::Sum(_))] | [_, _, ..] => {
            vec![(Sign::Plus, Tree::product(vec![unit, Tree::Sum(terms)]))]
        }
        [_] => {
            let (sign, tree) = terms.remove(0);
            let mut rest = tree.into_factors();
            let mut factors = Vec::new();
            match rest.first_mut() {
                Some(Tree::Number(_)) => factors.push(rest.remove(0)),
                Some(Tree::Monomial(monomial)) => {
                    let number = std::mem::replace(&mut monomial.coefficient, Rational::one());
                    factors.extend(Tree::Number(number).into_factors());
                }
                _ => {}
            }
            factors.push(unit);
            factors.extend(rest);
            vec![(sign, Tree::product(factors))]
        }
    }
}

/// `f[2]` with the source's name of the wave, as text and in LaTeX.
fn head(recurrence: &Recurrence, wave: WaveIndex, index: &str) -> (String, String) {
    both(|n| n.indexed(name_of_wave(recurrence, wave), index))
}

/// The source's name of a wave.
fn name_of_wave(recurrence: &Recurrence, wave: WaveIndex) -> &str {
    let statement = recurrence.statement();
    statement.notation.waves.get(&wave).unwrap_or(&statement.waves[wave])
}

/// A product in place of a symbol. In LaTeX a quotient stays on the line: `μz/L`.
fn name_of(product: &SourceProduct) -> Name {
    let tree = product_tree(product);
    let minus = if product.coefficient().is_negative() { "-" } else { "" };
    let flat =
        |tree: &Tree, notation: Notation| write_flat(&[(Sign::Plus, tree.clone())], notation);
    let latex = match &tree {
        Tree::Quotient(top, bottom) => {
            let single = matches!(**bottom, Tree::Symbol(_) | Tree::Number(_));
            let (top, bottom) = (flat(top, Latex), flat(bottom, Latex));
            if single { format!("{top}/{bottom}") } else { format!("{top}/({bottom})") }
        }
        tree => flat(tree, Latex),
    };
    let simple = matches!(tree, Tree::Symbol(_)) && minus.is_empty();
    let text = flat(&tree, Text);
    Name {
        text: format!("{minus}{text}"),
        latex: format!("{minus}{latex}"),
        mathml: format!("{minus}{}", flat(&tree, Notation::MathMl)),
        compound: !simple,
        leads: !minus.is_empty() || text.starts_with(|first: char| first.is_ascii_digit()),
    }
}

/// A product in its own order and without its sign, as one quotient.
fn product_tree(product: &SourceProduct) -> Tree {
    let side = |number: &Integer, sign: i32| {
        let number = (!number.is_one()).then(|| Tree::Number(Rational::from(number.clone())));
        let powers = product.powers().iter().filter(|(_, power)| power.signum() == sign);
        let powers =
            powers.map(|(x, power)| Tree::power(Tree::Symbol(x.clone()), power.unsigned_abs()));
        number.into_iter().chain(powers).collect::<Vec<Tree>>()
    };
    let coefficient = product.coefficient().abs();
    let top = Tree::product(side(coefficient.numer(), 1));
    match side(coefficient.denom(), -1) {
        bottom if bottom.is_empty() => top,
        bottom => Tree::Quotient(Box::new(top), Box::new(Tree::product(bottom))),
    }
}
