//! Expressions lowered to linear combinations of waves.
//!
//! Everything a person may write between two signs becomes a [`Linear`]: an exact expression
//! without waves, and waves with coefficients. The [`Place`] decides what is allowed.

use std::collections::BTreeMap;

use num_traits::ToPrimitive;
use wavestep_polynomial::Symbol;

use super::constant::constant;
use super::diagnostic::Diagnostic;
use super::scope::{FUNCTIONS, Scope, symbol, with_likely};
use super::syntax::{
    Expression as Tree, Factor, Function, Index, Name, Node, Operator, Sign, Span, Spanned, Term,
    Wave,
};
use crate::expression::{Expression, Fraction, NotAUnit, NotInvertible, PI};
use crate::limits::{MAX_CONSTANT_BITS, MAX_EXPONENT, MAX_LAG, MAX_TERMS};
use crate::recurrence::WaveIndex;

/// The functions that the language has.
const KNOWN_FUNCTIONS: [&str; 4] = ["cos", "exp", "sin", "sqrt"];

/// The most different square roots in a divisor.
const MAX_ROOTS: usize = 6;

/// The highest degree that a product or power may be worked out to.
const MAX_DEGREE: u32 = 2 * MAX_EXPONENT;

type Outcome<T> = Result<T, Diagnostic>;

/// How a wave is referred to.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Reference {
    /// `w[n−lag]` with a number of primes, 0 or 1.
    Lagged { lag: usize, primes: u32 },
    /// `Σ_{i<n} w[i−lag]`.
    Summed { lag: usize },
    /// `w(t − delay)`.
    Delayed { delay: Fraction },
}

/// One wave with its coefficient, and where it stands.
#[derive(Clone, Debug)]
pub(super) struct WaveTerm {
    pub coefficient: Expression,
    pub wave: WaveIndex,
    pub reference: Reference,
    pub span: Span,
}

/// A linear combination of waves, and what is added to it.
#[derive(Clone, Debug, Default)]
pub(super) struct Linear {
    pub rest: Expression,
    pub waves: Vec<WaveTerm>,
}

impl From<Expression> for Linear {
    fn from(rest: Expression) -> Linear {
        Linear { rest, waves: Vec::new() }
    }
}

impl Linear {
    pub fn scaled(mut self, factor: &Expression) -> Linear {
        self.rest = &self.rest * factor;
        self.waves.iter_mut().for_each(|term| term.coefficient = &term.coefficient * factor);
        self.waves.retain(|term| !term.coefficient.is_zero());
        self
    }
}

/// The place that an expression stands in, which decides what it may hold.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Place {
    /// No waves and no time: a period, a start, a factor.
    Constant(&'static str),
    /// An equation or a continuity rule: waves by period, scene time.
    Equation,
    /// An observable: waves by period or at a delayed scene time, scene time.
    Observable,
    /// A formula that was printed: its own variable, and any symbol.
    Formula,
}

impl Scope {
    /// Lowers an expression.
    pub fn lower(&self, tree: &Tree, place: Place) -> Outcome<Linear> {
        Lowering::new(self, place).lower(tree)
    }

    /// Lowers an expression that may hold neither waves nor time; `what` names it in errors.
    pub fn lower_constant(&self, tree: &Tree, what: &'static str) -> Outcome<Expression> {
        let linear = self.lower(tree, Place::Constant(what))?;
        match linear.waves.first() {
            None => Ok(linear.rest),
            Some(term) => Err(self
                .error(format!("{what} cannot depend on a wave"), term.span, "this is a wave")
                .with_remedy("use numbers and declared symbols")),
        }
    }

    /// Lowers an expression that may hold neither waves nor time nor exponentials.
    pub fn lower_fraction(&self, tree: &Tree, what: &'static str) -> Outcome<Fraction> {
        self.lower_constant(tree, what)?.as_fraction().ok_or_else(|| {
            self.error(
                format!("{what} cannot contain an exponential"),
                tree.span,
                "contains an exponential",
            )
            .with_remedy("introduce a symbol for it")
        })
    }
}

/// An expression in the course of being lowered: where it stands, and the index of a sum around it.
pub(super) struct Lowering<'a> {
    pub scope: &'a Scope,
    place: Place,
    summed: Option<&'a str>,
}

impl<'a> Lowering<'a> {
    pub fn new(scope: &'a Scope, place: Place) -> Self {
        Lowering { scope, place, summed: None }
    }

    pub fn error(
        &self,
        message: impl Into<String>,
        span: Span,
        label: impl Into<String>,
    ) -> Diagnostic {
        self.scope.error(message, span, label)
    }

    pub fn lower(&self, tree: &Tree) -> Outcome<Linear> {
        match &tree.value {
            Node::Number(value) => Ok(Expression::constant(value).into()),
            Node::Name(name) => self.name(name, tree.span).map(Linear::from),
            Node::Wave(wave) => self.wave(wave, tree.span),
            Node::Call { name, argument } => self.call(name, argument, tree.span),
            Node::Exponential(argument) => self.exponential(argument).map(Linear::from),
            Node::Function { function, argument } => {
                self.function(*function, argument).map(Linear::from)
            }
            Node::Summation { term, index, bound } => self.summation(term, index, bound, tree.span),
            Node::Sum(terms) => self.sum(terms, tree.span),
            Node::Product(factors) => self.product(factors),
            Node::Negate(operand) => Ok(self.lower(operand)?.scaled(&Expression::integer(-1))),
            Node::Power { base, exponent } => self.power(base, exponent).map(Linear::from),
        }
    }

    fn sum(&self, terms: &[Term], span: Span) -> Outcome<Linear> {
        let (mut rests, mut waves) = (Vec::with_capacity(terms.len()), Vec::new());
        for term in terms {
            let mut value = self.lower(&term.value)?;
            if term.sign == Sign::Minus {
                value = value.scaled(&Expression::integer(-1));
            }
            rests.push(value.rest);
            waves.append(&mut value.waves);
        }
        Ok(Linear { rest: self.sum_of(rests, span)?, waves })
    }

    pub fn sum_of(&self, mut rests: Vec<Expression>, span: Span) -> Outcome<Expression> {
        // Added up in pairs: one after the other would copy a long sum once for each term.
        while rests.len() > 1 {
            let pairs = rests.chunks(2).map(|pair| match pair {
                [left, right] if sum_is_moderate(left, right) => Ok(left + right),
                [_, _] => Err(self.too_large(span)),
                _ => Ok(pair[0].clone()),
            });
            rests = pairs.collect::<Outcome<_>>()?;
        }
        Ok(rests.pop().unwrap_or_default())
    }

    /// An expression without waves.
    pub fn plain(&self, tree: &Tree, instead: &str) -> Outcome<Expression> {
        let linear = self.lower(tree)?;
        match linear.waves.first() {
            None => Ok(linear.rest),
            Some(term) => Err(self
                .error(format!("{instead} cannot contain a wave"), term.span, "this is a wave")
                .with_remedy(
                    "waves may be added, and multiplied or divided by terms without waves",
                )),
        }
    }

    fn name(&self, name: &str, span: Span) -> Outcome<Expression> {
        let scope = self.scope;
        if let Some(value) = scope.symbols.get(name) {
            return Ok(match value {
                Some(value) => Expression::constant(value),
                None => Expression::symbol(&symbol(name)),
            });
        }
        let is = |own: &Option<Symbol>| own.as_ref().is_some_and(|own| own.name() == name);
        match self.place {
            Place::Formula => return Ok(Expression::symbol(&symbol(name))),
            Place::Constant(what) if is(&scope.time) || is(&scope.local) => {
                let message = format!("{what} cannot depend on time");
                return Err(self
                    .error(message, span, "this is a time")
                    .with_remedy("use numbers and declared symbols"));
            }
            _ if is(&scope.time) => return Ok(Expression::symbol(&symbol(name))),
            _ if is(&scope.local) => {
                return Err(self
                    .error("local time cannot be used here", span, "restarts in every period")
                    .with_remedy(format!(
                        "write functions of scene time `{}`: they go on over all periods",
                        self.time_name()
                    )));
            }
            _ => {}
        }
        if scope.waves.contains_key(name) {
            return Err(self
                .error(format!("`{name}` is a wave and needs a period"), span, "which period?")
                .with_remedy(format!(
                    "write `{name}[n]`, or `{name}[n-1]` for the period before"
                )));
        }
        if name == "n" {
            return Err(self
                .error("the period number cannot be used as a value", span, "`n` counts periods")
                .with_remedy("use it between brackets only, as in `f[n-1]`"));
        }
        if Some(name) == self.summed {
            return Err(self
                .error("the index of a sum cannot be used as a value", span, "counts periods")
                .with_remedy("use it between brackets only, as in `sum(f[i], i < n)`"));
        }
        let error = self.error(format!("unknown name `{name}`"), span, "not declared");
        Err(with_likely(error, name, scope.known_names())
            .or_remedy(format!("declare it with `symbol {name}`")))
    }

    /// The wave of this name; `functions` are what else could have been meant.
    fn wave_named(&self, name: &Name, functions: &[&str]) -> Outcome<WaveIndex> {
        let scope = self.scope;
        if let Some(wave) = scope.waves.get(&name.value) {
            return Ok(*wave);
        }
        if scope.symbols.contains_key(&name.value) {
            return Err(self
                .error(format!("`{}` is a symbol, not a wave", name.value), name.span, "a symbol")
                .with_remedy(format!(
                    "write `{0}` alone, or `{0}*(…)` for a product",
                    name.value
                )));
        }
        if FUNCTIONS.contains(&name.value.as_str()) {
            let message = format!("unknown function `{}`", name.value);
            return Err(self.error(message, name.span, "a function").with_remedy(
                "the functions are `exp`, `cos`, `sin` and `sqrt`: forcing is a sum of terms \
                 `t^k*exp(a*t)*cos(b*t)`",
            ));
        }
        let names = scope.waves.keys().map(String::as_str).chain(functions.iter().copied());
        let error = self.error(format!("unknown wave `{}`", name.value), name.span, "not declared");
        Err(with_likely(error, &name.value, names)
            .or_remedy(format!("declare it with `wave {}`", name.value)))
    }

    fn one_wave(&self, wave: WaveIndex, reference: Reference, span: Span) -> Linear {
        let term = WaveTerm { coefficient: Expression::one(), wave, reference, span };
        Linear { rest: Expression::zero(), waves: vec![term] }
    }

    fn wave(&self, wave: &Wave, span: Span) -> Outcome<Linear> {
        let index = self.wave_named(&wave.name, &[])?;
        if wave.primes > 1 {
            return Err(self
                .error("second and higher derivatives are not supported", span, "differentiated")
                .with_remedy(
                    "split the wave by hand into waves with one pole each, and observe their sum",
                ));
        }
        let (lag, summed) = self.lag(&wave.index, &wave.name.value)?;
        let reference = match (summed, wave.primes) {
            (false, primes) => Reference::Lagged { lag, primes },
            (true, 0) => Reference::Summed { lag },
            (true, _) => {
                return Err(self
                    .error("a sum over derivatives is not supported", span, "differentiated")
                    .with_remedy(
                        "give the derivative a wave of its own, by an equation, and sum that",
                    ));
            }
        };
        Ok(self.one_wave(index, reference, span))
    }

    /// How many periods back an index points, and whether it is the index of a sum.
    fn lag(&self, index: &Spanned<Index>, wave: &str) -> Outcome<(usize, bool)> {
        let Spanned { value: Index { base, offset }, span } = index;
        let expected = self.summed.unwrap_or("n");
        let Some(base) = base else {
            return Err(self
                .error("the period must be relative", *span, "a fixed period")
                .with_remedy(format!("write `{wave}[n]`, `{wave}[n-1]`, …")));
        };
        if base.value != expected {
            let message = format!("`{}` does not count periods here", base.value);
            return Err(self
                .error(message, base.span, "not the index of a period")
                .with_remedy(format!("write `{wave}[{expected}]` or `{wave}[{expected}-1]`")));
        }
        if *offset > 0 {
            return Err(self
                .error("this wave is in the future", *span, "a period that is not known yet")
                .with_remedy(format!(
                    "shift the equation so that `{wave}[{expected}]` is its latest"
                )));
        }
        if *offset < -MAX_LAG {
            return Err(self
                .error("this wave is too far back", *span, "too many periods before")
                .with_remedy(format!("look back at most {MAX_LAG} periods")));
        }
        let lag = usize::try_from(-offset).expect("the offset is not positive");
        Ok((lag, self.summed.is_some()))
    }

    fn call(&self, name: &Name, argument: &Tree, span: Span) -> Outcome<Linear> {
        let wave = self.wave_named(name, &KNOWN_FUNCTIONS)?;
        let time = match (&self.scope.time, self.place) {
            (Some(time), Place::Observable) => time,
            _ => {
                return Err(self
                    .error("a wave at a scene time can only be observed", span, "not here")
                    .with_remedy(format!("write `{0}[n]` or `{0}[n-1]`", name.value)));
            }
        };
        let shape = || {
            self.error("this is not a delayed scene time", argument.span, "must be a delayed time")
                .with_remedy(format!("write `{0}({time})` or `{0}({time} - delay)`", name.value))
        };
        if let Node::Name(own) = &argument.value
            && self.scope.local.as_ref().is_some_and(|local| local.name() == own)
        {
            return Err(shape());
        }
        let argument_value = self.plain(argument, "a time")?.as_fraction().ok_or_else(shape)?;
        let delay = &Fraction::symbol(time) - &argument_value;
        if delay.contains(time) {
            return Err(shape());
        }
        if delay.roots().next().is_some() || delay.contains(&symbol(PI)) {
            return Err(self
                .error("a delay cannot contain a square root or π", argument.span, "is irrational")
                .with_remedy("measure time in units in which it is rational"));
        }
        if !delay.is_zero() && !self.scope.assumptions.is_positive(&delay) {
            return Err(self
                .error("this time may be in the future", argument.span, "may not be a delay")
                .with_remedy("subtract something that is certainly positive from the time"));
        }
        Ok(self.one_wave(wave, Reference::Delayed { delay }, span))
    }

    fn exponential(&self, argument: &Tree) -> Outcome<Expression> {
        let words = ["an exponent", "the exponent", "exponents"];
        let example = format!("exponentials such as `exp(-2*{})`", self.time_name());
        Ok(Expression::exponential(self.linear_in_time(argument, words, &example)?))
    }

    /// The argument of an exponential or an angle: a fraction, linear in time.
    fn linear_in_time(
        &self,
        argument: &Tree,
        [what, whole, plural]: [&str; 3],
        example: &str,
    ) -> Outcome<Fraction> {
        let Some(value) = self.plain(argument, what)?.as_fraction() else {
            let message = format!("an exponential in {what}");
            return Err(self.error(message, argument.span, "contains an exponential").with_remedy(
                format!("{plural} are quotients of polynomials in the symbols and the time"),
            ));
        };
        let time = self.scope.time.as_ref().filter(|time| value.contains(time));
        if time.is_some_and(|time| value.derivative(time).contains(time)) {
            return Err(self
                .error(format!("{whole} is not linear in time"), argument.span, "not linear")
                .with_remedy(format!("write {example}")));
        }
        Ok(value)
    }

    fn time_name(&self) -> &str {
        self.scope.time.as_ref().map_or("t", Symbol::name)
    }

    /// `cos`, `sin`, `sqrt`.
    fn function(&self, function: Function, argument: &Tree) -> Outcome<Expression> {
        let what = format!("the argument of `{function}`");
        if function == Function::SquareRoot {
            return self.square_root(&self.plain(argument, &what)?, argument.span);
        }
        let example = format!("functions such as `{function}(2*{})`", self.time_name());
        let angle = self.linear_in_time(argument, [&what, &what, "angles"], &example)?;
        Ok(match function {
            Function::Cosine => Expression::cosine(&angle),
            _ => Expression::sine(&angle),
        })
    }

    fn square_root(&self, value: &Expression, span: Span) -> Outcome<Expression> {
        let Some(number) = value.as_constant() else {
            return Err(self
                .error(
                    "a root of a term that is not a rational number",
                    span,
                    "not a rational number",
                )
                .with_remedy(
                    "write roots of numbers, such as `sqrt(3)`, and introduce a symbol for others",
                ));
        };
        let root = Fraction::constant(&number).square_root().ok_or_else(|| {
            self.error("the factors of this number were not found", span, "too large")
                .with_remedy("write a product of roots of smaller numbers, or introduce a symbol")
        })?;
        Ok(root.into())
    }

    fn summation(&self, term: &Tree, index: &Name, bound: &Name, span: Span) -> Outcome<Linear> {
        if self.summed.is_some() {
            return Err(self
                .error("a sum within a sum is not supported", span, "inside another sum")
                .with_remedy("give the inner sum a wave of its own, by an equation"));
        }
        if bound.value != "n" {
            return Err(self
                .error("a sum runs over all earlier periods", bound.span, "must be `n`")
                .with_remedy(format!("write `sum(f[{0}], {0} < n)`", index.value)));
        }
        let taken = self.scope.known_names().any(|name| name == index.value) || index.value == "n";
        if taken {
            return Err(self
                .error(format!("`{}` already has a meaning", index.value), index.span, "in use")
                .with_remedy("choose another name for the index of the sum"));
        }
        let inner = Lowering { scope: self.scope, place: self.place, summed: Some(&index.value) };
        let linear = inner.lower(term)?;
        if !linear.rest.is_zero() || linear.waves.is_empty() {
            return Err(self
                .error("only waves can be summed", span, "contains a term without a wave")
                .with_remedy(format!("sum waves, as in `sum(f[{0}], {0} < n)`", index.value)));
        }
        Ok(linear)
    }

    fn product(&self, factors: &[Factor]) -> Outcome<Linear> {
        let mut product = Linear::from(Expression::one());
        // Where time entered.
        let mut timed = None;
        for factor in factors {
            let tree = &factor.value;
            if factor.operator == Operator::Divide {
                let inverse = self.inverse(tree)?;
                timed = timed.or_else(|| self.depends_on_time(&inverse).then_some(tree.span));
                product = self.scaled(product, &inverse, tree.span)?;
                self.check_coefficients(&product, timed)?;
                continue;
            }
            let value = self.lower(tree)?;
            timed = timed.or_else(|| self.depends_on_time(&value.rest).then_some(tree.span));
            product = match (product.waves.is_empty(), value.waves.is_empty()) {
                (_, true) => self.scaled(product, &value.rest, tree.span)?,
                (true, false) => self.scaled(value, &product.rest, tree.span)?,
                (false, false) => {
                    let first = product.waves[0].span;
                    return Err(self
                        .error(
                            "a product of waves is not linear",
                            value.waves[0].span,
                            "times this",
                        )
                        .with_secondary(first, "a wave")
                        .with_remedy("the equations between waves must be linear"));
                }
            };
            self.check_coefficients(&product, timed)?;
        }
        Ok(product)
    }

    pub fn depends_on_time(&self, value: &Expression) -> bool {
        self.scope.time.as_ref().is_some_and(|time| value.contains(time))
    }

    /// Coefficients of waves do not depend on time, which entered at `timed`.
    fn check_coefficients(&self, linear: &Linear, timed: Option<Span>) -> Outcome<()> {
        let Some(timed) = timed else { return Ok(()) };
        match linear.waves.iter().find(|term| self.depends_on_time(&term.coefficient)) {
            None => Ok(()),
            Some(term) => Err(self
                .error("the factor of a wave depends on time", timed, "depends on time")
                .with_secondary(term.span, "multiplies this wave")
                .with_remedy("coefficients are numbers and symbols; time enters by forcing only")),
        }
    }

    pub fn scaled(&self, linear: Linear, factor: &Expression, span: Span) -> Outcome<Linear> {
        let coefficients = linear.waves.iter().map(|term| &term.coefficient);
        if std::iter::once(&linear.rest).chain(coefficients).all(|c| product_is_moderate(c, factor))
        {
            return Ok(linear.scaled(factor));
        }
        Err(self.too_large(span))
    }

    pub fn times(&self, left: &Expression, right: &Expression, span: Span) -> Outcome<Expression> {
        if product_is_moderate(left, right) { Ok(left * right) } else { Err(self.too_large(span)) }
    }

    fn raised(&self, base: &Expression, count: u32, span: Span) -> Outcome<Expression> {
        if power_is_moderate(base, count) { Ok(base.pow(count)) } else { Err(self.too_large(span)) }
    }

    fn too_large(&self, span: Span) -> Diagnostic {
        self.error("this expression becomes too large", span, "grows too large").with_remedy(
            format!(
                "keep it below {MAX_TERMS} terms, degree {MAX_DEGREE}, and {MAX_CONSTANT_BITS} \
                 bits a number"
            ),
        )
    }

    /// `1/tree`, factor by factor.
    pub fn inverse(&self, tree: &Tree) -> Outcome<Expression> {
        match &tree.value {
            Node::Product(factors) => {
                let mut inverse = Expression::one();
                for factor in factors {
                    let part = match factor.operator {
                        Operator::Multiply => self.inverse(&factor.value)?,
                        Operator::Divide => self.plain(&factor.value, "a divisor")?,
                    };
                    inverse = self.times(&inverse, &part, factor.value.span)?;
                }
                Ok(inverse)
            }
            Node::Negate(operand) => Ok(-&self.inverse(operand)?),
            Node::Power { base, exponent } => {
                let count = self.exponent(exponent)?;
                let base_value = match count >= 0 {
                    true => self.inverse(base)?,
                    false => self.plain(base, "a divisor")?,
                };
                self.raised(&base_value, count.unsigned_abs(), tree.span)
            }
            _ => {
                let value = self.plain(tree, "a divisor")?;
                self.invert(&value, tree.span)
            }
        }
    }

    fn invert(&self, value: &Expression, span: Span) -> Outcome<Expression> {
        if let Some(time) = &self.scope.time
            && value.terms().len() == 1
            && value.terms().any(|(_, coefficient)| coefficient.contains(time))
        {
            return Err(self.error("division by time", span, "depends on time").with_remedy(
                format!("forcing may contain powers such as `{time}^2` and exponentials of time"),
            ));
        }
        if !norm_is_moderate(value) {
            return Err(self
                .error("this divisor contains too many square roots", span, "divided by here")
                .with_remedy("introduce a symbol for it, or divide by fewer roots at a time"));
        }
        let zero = || {
            self.error("division by zero", span, "this is zero")
                .with_remedy("check the signs of what is divided by, and the values given")
        };
        let without_factors = || {
            self.error("this cannot be a divisor", span, "its factors were not found")
                .with_remedy("divide by its factors one by one")
        };
        if self.place == Place::Formula
            && let Some(inverse) = value.inverse_of_term()
        {
            return inverse
                .map_err(|NotAUnit(of)| if of.is_zero() { zero() } else { without_factors() });
        }
        self.scope.assumptions.invert(value).map_err(|reason| match reason {
            NotInvertible::Zero => zero(),
            NotInvertible::Undeclared(factor) => match Fraction::reciprocal(&factor) {
                Ok(_) => self
                    .error(format!("`{factor}` may be zero"), span, "divided by here")
                    .with_remedy(format!("state that it is not zero, with `nonzero {factor}`")),
                Err(_) => without_factors(),
            },
            NotInvertible::SumOfExponentials => self
                .error("division by a sum of exponentials", span, "a sum of exponentials")
                .with_remedy("introduce a symbol for the quotient"),
        })
    }

    fn exponent(&self, tree: &Tree) -> Outcome<i32> {
        let refuse = |label: &str| {
            self.error("the exponent is not a whole number of moderate size", tree.span, label)
                .with_remedy(format!("use whole numbers from -{MAX_EXPONENT} to {MAX_EXPONENT}"))
        };
        let value = constant(tree, &self.scope.source).map_err(|_| refuse("not a number"))?;
        if !value.is_integer() {
            return Err(refuse("not whole"));
        }
        let small = value.numer().to_i32().filter(|e| e.unsigned_abs() <= MAX_EXPONENT);
        small.ok_or_else(|| refuse("too large"))
    }

    fn power(&self, base: &Tree, exponent: &Tree) -> Outcome<Expression> {
        let count = self.exponent(exponent)?;
        let value = match count.is_negative() {
            true => self.inverse(base)?,
            false => self.plain(base, "the base of a power")?,
        };
        self.raised(&value, count.unsigned_abs(), base.span)
    }
}

/// The highest total degree among the coefficients.
fn degree(value: &Expression) -> u32 {
    value.terms().map(|(_, p)| p.numerator().total_degree()).max().unwrap_or(0)
}

/// The most bits of a number in a numerator.
fn bits(value: &Expression) -> u64 {
    let numbers = value.terms().flat_map(|(_, p)| p.numerator().terms());
    numbers.map(|(_, number)| number.numer().bits() + number.denom().bits()).max().unwrap_or(0)
}

fn product_is_moderate(left: &Expression, right: &Expression) -> bool {
    left.term_count().saturating_mul(right.term_count()) <= MAX_TERMS
        && degree(left).saturating_add(degree(right)) <= MAX_DEGREE
        && bits(left).saturating_add(bits(right)) <= MAX_CONSTANT_BITS
}

/// A power of m terms has at most `C(count+m−1, m−1)` terms; counted factor by factor.
fn power_is_moderate(base: &Expression, count: u32) -> bool {
    let mut terms = 1usize;
    for extra in 1..base.term_count().min(64) {
        terms = terms.saturating_mul(count as usize + extra) / extra;
    }
    // Powers of ±1 stay as short as they are.
    let bits = match bits(base) {
        0..=2 => 0,
        bits => bits.saturating_mul(u64::from(count)),
    };
    terms <= MAX_TERMS
        && degree(base).saturating_mul(count) <= MAX_DEGREE
        && bits <= MAX_CONSTANT_BITS
}

/// Division by what holds k roots multiplies 2^k conjugates; of a number, they are as many terms.
fn norm_is_moderate(value: &Expression) -> bool {
    let count = value.terms().map(|(_, p)| p.roots().count()).max().unwrap_or(0);
    if count == 0 {
        return true;
    }
    let conjugates = 1_u32.checked_shl(count as u32).unwrap_or(u32::MAX);
    let is_number = value.terms().all(|(_, p)| p.numerator().is_algebraic_number());
    count <= MAX_ROOTS
        && bits(value).saturating_mul(u64::from(conjugates)) <= MAX_CONSTANT_BITS
        && (is_number || power_is_moderate(value, conjugates))
}

/// A sum brings fractions to a common denominator.
fn sum_is_moderate(left: &Expression, right: &Expression) -> bool {
    // How many terms the numerator of `own` has when it is brought to the other denominator too.
    let expanded = |own: &Fraction, other: &Fraction| {
        let powers: BTreeMap<_, _> = own.factors().collect();
        other.factors().fold(own.numerator().term_count(), |count, (factor, power)| {
            let missing = power.saturating_sub(powers.get(factor).copied().unwrap_or(0));
            (0..missing).fold(count, |count, _| count.saturating_mul(factor.term_count()))
        })
    };
    let mut count = left.term_count().saturating_add(right.term_count());
    let (mut those, mut left_bits) = (right.terms().peekable(), 0);
    for (exponent, own) in left.terms() {
        while those.next_if(|(other, _)| *other < exponent).is_some() {}
        if let Some((_, other)) = those.next_if(|(other, _)| *other == exponent)
            && !own.factors().eq(other.factors())
        {
            let both = expanded(own, other).saturating_add(expanded(other, own));
            count = count.saturating_add(both);
            left_bits = bits(left);
        }
    }
    // A long sum of one denominator is no longer than its text.
    count <= MAX_TERMS.max(left.term_count() + right.term_count())
        && left_bits.saturating_add(bits(right)) <= 2 * MAX_CONSTANT_BITS
}
