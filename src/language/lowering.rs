//! From syntax tree to recurrence: names are looked up, values given for symbols are put in, and
//! every refusal of the layers below is brought back to its place in the text.

use std::collections::BTreeMap;

use wavestep_polynomial::{Rational, Symbol};

use super::diagnostic::Diagnostic;
use super::linear::{Linear, Place, Reference};
use super::parameters;
use super::products::Products;
use super::scope::{Scope, symbol};
use super::source::Source;
use super::syntax::{self, Name, Span, Spanned, StatementKind};
use super::written;
use crate::expression::{Assumptions, Expression, Fraction, NotInvertible, PI};
use crate::recurrence::{
    Clause, Continuity, Fault, InvalidRecurrence, LinearForm, Observable, Observation,
    ObservedWave, ProductTerm, Quadratic, Recurrence, SourceNotation, Statement,
};

type Outcome<T> = Result<T, Diagnostic>;

/// Names with a meaning of their own in recurrences, and what they mean.
const TAKEN: [(&str, &str); 2] = [(PI, "is the number π"), ("n", "always counts periods")];

/// Lowers a recurrence, with `values` in place of symbols from the start: two poles that become
/// equal give the confluent answer.
pub(super) fn recurrence(
    tree: &syntax::Recurrence,
    values: &BTreeMap<String, Rational>,
) -> Outcome<Recurrence> {
    let mut lowering = Lowering::new(tree, values);
    lowering.symbols()?;
    lowering.waves()?;
    lowering.factors()?;
    let (period, local, time) = lowering.period()?;
    let mut statement = Statement {
        title: tree.title.value.clone(),
        assumptions: Assumptions::default(),
        constants: Vec::new(),
        period,
        local,
        time,
        waves: lowering.wave_names.iter().map(|name| name.value.clone()).collect(),
        equations: lowering.equations()?,
        continuity: lowering.continuity()?,
        observables: Vec::new(),
        quadratics: Vec::new(),
        notation: SourceNotation::default(),
    };
    lowering.observables(&mut statement)?;
    statement.notation = written::notation(tree, &lowering.scope, &statement.observed())?;
    statement.assumptions = lowering.scope.assumptions.clone();
    Recurrence::new(statement).map_err(|invalid| lowering.refusal(&invalid))
}

struct Lowering<'a> {
    tree: &'a syntax::Recurrence,
    values: &'a BTreeMap<String, Rational>,
    scope: Scope,
    wave_names: Vec<Name>,
    /// Where each name was declared.
    declared: BTreeMap<String, Span>,
}

impl<'a> Lowering<'a> {
    fn error(
        &self,
        message: impl Into<String>,
        span: Span,
        label: impl Into<String>,
    ) -> Diagnostic {
        self.scope.error(message, span, label)
    }

    fn new(tree: &'a syntax::Recurrence, values: &'a BTreeMap<String, Rational>) -> Self {
        let scope = Scope::new(&tree.source);
        Lowering { tree, values, scope, wave_names: Vec::new(), declared: BTreeMap::new() }
    }

    fn statements(&self) -> impl Iterator<Item = (&'a StatementKind, Span)> + use<'a> {
        self.tree.statements.iter().map(|statement| (&statement.value, statement.span))
    }

    fn declare(&mut self, name: &Name) -> Outcome<()> {
        if let Some((taken, why)) = TAKEN.iter().find(|(taken, _)| *taken == name.value) {
            return Err(self
                .error(format!("`{taken}` {why}"), name.span, "cannot be declared")
                .with_remedy("choose another name"));
        }
        match self.declared.insert(name.value.clone(), name.span) {
            None => Ok(()),
            Some(first) => Err(self.scope.declared_twice(name, first)),
        }
    }

    fn symbols(&mut self) -> Outcome<()> {
        for (statement, _) in self.statements() {
            let StatementKind::Symbols(symbols) = statement else { continue };
            for symbol in symbols {
                self.declare(&symbol.name)?;
                parameters::declare(&mut self.scope, symbol, self.values)?;
            }
        }
        parameters::all_known(&self.scope, self.values, "recurrence", self.tree.title.span)?;
        self.scope.symbols.insert(PI.to_owned(), None);
        Ok(())
    }

    fn waves(&mut self) -> Outcome<()> {
        for (statement, _) in self.statements() {
            let StatementKind::Waves(names) = statement else { continue };
            for name in names {
                self.declare(name)?;
                self.scope.waves.insert(name.value.clone(), self.wave_names.len());
                self.wave_names.push(name.clone());
            }
        }
        if self.wave_names.is_empty() {
            let title = self.tree.title.span;
            return Err(self
                .error("no wave is declared", title, "this recurrence has no unknown")
                .with_remedy("name the unknown waves, as in `wave f, g`"));
        }
        Ok(())
    }

    /// Factors that are stated to be non-zero.
    fn factors(&mut self) -> Outcome<()> {
        for (statement, _) in self.statements() {
            let StatementKind::Nonzero(tree) = statement else { continue };
            if let Some(unit) = parameters::nonzero(&self.scope, tree, self.values)? {
                self.scope.assumptions.declare_factors(&unit);
            }
        }
        Ok(())
    }

    fn period(&mut self) -> Outcome<(Fraction, Symbol, Symbol)> {
        let mut found: Option<(Span, Fraction, [&Name; 2])> = None;
        for (statement, span) in self.statements() {
            let StatementKind::Period { length, local, time } = statement else { continue };
            if let Some((first, ..)) = found {
                return Err(self
                    .error("the period is stated twice", span, "again here")
                    .with_secondary(first, "first stated here")
                    .with_remedy("remove one of the two"));
            }
            let period = self.scope.lower_fraction(length, "a period")?;
            let has_root = period.roots().next().is_some();
            if has_root || period.contains(&symbol(PI)) {
                let what = if has_root { "a square root" } else { "π" };
                let message = format!("a period cannot contain {what}");
                return Err(self
                    .error(message, length.span, format!("contains {what}"))
                    .with_remedy("measure time in units in which it is rational"));
            }
            self.declare(local)?;
            self.declare(time)?;
            found = Some((span, period, [local, time]));
        }
        let Some((_, period, names)) = found else {
            return Err(self
                .error("no period is stated", self.tree.title.span, "of this recurrence")
                .with_remedy("state it, as in `period 2*mu, local s, time t`"));
        };
        let [local, time] = names.map(|name| symbol(&name.value));
        self.scope.local = Some(local.clone());
        self.scope.time = Some(time.clone());
        Ok((period, local, time))
    }

    /// Where a clause stands in the text.
    fn span(&self, clause: Clause) -> Span {
        let nth = |i: usize, kind: fn(&StatementKind) -> bool| {
            let mut statements = self.statements().filter(|(statement, _)| kind(statement));
            statements.nth(i).map(|(_, span)| span)
        };
        let found = match clause {
            Clause::Period => self.statements().find_map(|(statement, _)| match statement {
                StatementKind::Period { length, .. } => Some(length.span),
                _ => None,
            }),
            Clause::Equation(i) => nth(i, |kind| matches!(kind, StatementKind::Equation { .. })),
            Clause::Continuity(i) => {
                nth(i, |kind| matches!(kind, StatementKind::Continuous { .. }))
            }
            Clause::Wave(i) => self.wave_names.get(i).map(|name| name.span),
        };
        found.unwrap_or(self.tree.title.span)
    }

    fn form(&self, linear: &Linear) -> LinearForm {
        let mut form = LinearForm::forcing(linear.rest.clone());
        for term in &linear.waves {
            let wave = match term.reference {
                Reference::Lagged { lag, primes: 0 } => LinearForm::wave(term.wave, lag),
                Reference::Lagged { lag, .. } => LinearForm::slope(term.wave, lag),
                Reference::Summed { lag } => LinearForm::sum(term.wave, lag),
                Reference::Delayed { .. } => unreachable!("only observables hold delayed waves"),
            };
            form.add_scaled(&wave, &term.coefficient, 0);
        }
        form
    }

    fn equations(&self) -> Outcome<Vec<LinearForm>> {
        let mut equations = Vec::new();
        for (statement, span) in self.statements() {
            let StatementKind::Equation { left, right } = statement else { continue };
            let mut form = self.form(&self.scope.lower(left, Place::Equation)?);
            let right = self.form(&self.scope.lower(right, Place::Equation)?);
            form.add_scaled(&right, &Expression::integer(-1), 0);
            if form.is_free_of_waves() && !form.is_zero() {
                return Err(self
                    .error("this equation contains no wave", span, "says nothing about the waves")
                    .with_remedy(
                        "relate waves in it, or remove it; conditions on symbols belong in \
                         `symbol` and `nonzero`",
                    ));
            }
            if form.is_zero() {
                return Err(self
                    .error("this equation says nothing", span, "both sides are the same")
                    .with_remedy("state a relation that determines a wave"));
            }
            equations.push(form);
        }
        Ok(equations)
    }

    fn continuity(&self) -> Outcome<Vec<Continuity>> {
        let mut rules = Vec::new();
        for (statement, _) in self.statements() {
            let StatementKind::Continuous { quantity, start } = statement else { continue };
            let form = self.form(&self.scope.lower(quantity, Place::Equation)?);
            if form.is_free_of_waves() {
                let wave = &self.wave_names[0].value;
                return Err(self
                    .error(
                        "this continuity rule contains no wave",
                        quantity.span,
                        "no wave in here",
                    )
                    .with_remedy(format!(
                        "name a wave, as in `continuous {wave}[n] starts at 0`"
                    )));
            }
            let start = self.scope.lower_constant(start, "a start")?;
            rules.push(Continuity { form, start });
        }
        Ok(rules)
    }

    fn observables(&mut self, statement: &mut Statement) -> Outcome<()> {
        for (kind, _) in self.statements() {
            let StatementKind::Observe { name, value } = kind else { continue };
            self.declare(name)?;
            let Products { linear, pairs } = self.scope.lower_products(value)?;
            let name = name.value.clone();
            let observation = self.observation(linear, &statement.period)?;
            if pairs.is_empty() {
                statement.observables.push(Observable { name, observation });
                continue;
            }
            let mut terms = Vec::new();
            for (coefficient, [mut first, second]) in pairs {
                // What is no fraction is put into a factor.
                let coefficient = coefficient.as_fraction().unwrap_or_else(|| {
                    first = std::mem::take(&mut first).scaled(&coefficient);
                    Fraction::one()
                });
                let factors = [first, second].map(|own| self.observation(own, &statement.period));
                let factors = factors.into_iter().collect::<Outcome<_>>()?;
                terms.push(ProductTerm { coefficient, factors });
            }
            if observation != Observation::default() {
                let (coefficient, factors) = (Fraction::one(), vec![observation]);
                terms.push(ProductTerm { coefficient, factors });
            }
            let place = statement.observables.len() + statement.quadratics.len();
            statement.quadratics.push(Quadratic { name, place, terms });
        }
        Ok(())
    }

    fn observation(&self, linear: Linear, period: &Fraction) -> Outcome<Observation> {
        let mut observation = Observation { forcing: linear.rest, waves: Vec::new() };
        for term in linear.waves {
            let (slope, delay) = match term.reference {
                Reference::Lagged { lag, primes } => {
                    (primes > 0, period.scale(&Rational::from_integer(lag.into())))
                }
                Reference::Delayed { delay } => (false, delay),
                Reference::Summed { .. } => {
                    return Err(self
                        .error("a sum over periods cannot be observed", term.span, "a sum")
                        .with_remedy("give the sum a wave of its own, by an equation"));
                }
            };
            let (coefficient, wave) = (term.coefficient, term.wave);
            observation.waves.push(ObservedWave { coefficient, wave, slope, delay });
        }
        Ok(observation)
    }

    /// What the recurrence refused, at its place in the text.
    fn refusal(&self, invalid: &InvalidRecurrence) -> Diagnostic {
        let span = self.span(invalid.clause);
        let (label, remedy) = match &invalid.fault {
            Fault::PeriodNotPositive => (
                "may be zero or negative",
                "make it a sum of positive terms, with symbols declared `> 0`".to_owned(),
            ),
            Fault::Count { equations, waves } if equations < waves => {
                ("too few equations for these waves", "state one equation for each wave".to_owned())
            }
            Fault::Count { .. } => {
                ("one too many", "state one equation for each wave, and no more".to_owned())
            }
            Fault::DeterminesNothing => (
                "nothing left to determine once the others are solved",
                "each equation must contain a wave `[n]` that no other equation determines"
                    .to_owned(),
            ),
            Fault::Coupled(_) => {
                ("cannot be solved one by one", "solve the equations for one wave each".to_owned())
            }
            Fault::Rates { .. } => (
                "coupled by derivatives",
                "give values such that the characteristic polynomial has rational factors of \
                 degree two at most, or symbols such that its discriminant is a square"
                    .to_owned(),
            ),
            Fault::NotInvertible(reason) => (
                "the factor of the newest wave may be zero",
                match reason {
                    NotInvertible::Undeclared(factor) if Fraction::reciprocal(factor).is_ok() => {
                        format!("state that it is not zero, with `nonzero {factor}`")
                    }
                    NotInvertible::Undeclared(_) => "multiply the equation such that this factor \
                         is a product of factors that are linear in a symbol each"
                        .to_owned(),
                    NotInvertible::SumOfExponentials => "introduce a symbol for it".to_owned(),
                    NotInvertible::Zero => "check the signs, and the values given".to_owned(),
                },
            ),
            Fault::RateHoldsExponential => {
                ("a rate with an exponential", "introduce a symbol for it".to_owned())
            }
            Fault::NoStart(wave) => (
                "has a differential equation but no initial value",
                format!("add a rule such as `continuous {wave}[n] starts at 0`"),
            ),
            Fault::StartsNothing => (
                "no wave needs it",
                "remove it: only waves with a differential equation need an initial value"
                    .to_owned(),
            ),
            Fault::IllFormed => (
                "not of the form of a recurrence",
                "use declared waves, constant coefficients, and forcing in scene time".to_owned(),
            ),
            Fault::DegreeTooHigh => {
                ("with this one and the others", "use lower powers in the coefficients".to_owned())
            }
            Fault::ContinuityOfSlope => {
                ("holds a derivative or a sum", "state what is continuous by the waves".to_owned())
            }
        };
        self.error(invalid.to_string(), span, label).with_remedy(remedy)
    }
}

/// One formula of a listing: the wave, the period, or how often each period of a lattice has passed, the
/// variable, and the exact expression.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ExactFormula {
    pub wave: String,
    pub counts: Vec<usize>,
    pub variable: Symbol,
    pub expression: Expression,
}

/// Lowers a listing; every name but those of functions is a symbol.
pub(super) fn listing(tree: &syntax::Listing) -> Outcome<Vec<ExactFormula>> {
    let scope = Scope::new(&tree.source);
    let lower = |formula: &Spanned<syntax::Formula>| {
        let syntax::Formula { wave, counts, argument, value } = &formula.value;
        Ok(ExactFormula {
            wave: wave.value.clone(),
            counts: counts.iter().map(|count| count.value as usize).collect(),
            variable: symbol(&argument.value),
            expression: scope.lower(value, Place::Formula)?.rest,
        })
    };
    tree.formulas.iter().map(lower).collect()
}

/// Lowers an expression in which every name is a symbol.
pub(super) fn expression(tree: &syntax::Expression, source: &Source) -> Outcome<Expression> {
    let scope = Scope::new(source);
    Ok(scope.lower(tree, Place::Formula)?.rest)
}
