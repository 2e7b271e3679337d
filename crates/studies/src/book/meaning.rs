//! What a formula of the source says about a scene: its tree, with the source's names resolved.

use crate::book::entry::{Equation, Section, Setting};
use crate::book::refusal::Refusal;
use crate::book::sequence::{Sequence, inverse, period_number};
use crate::book::stage::{Quantity, Stage};
use num_traits::ToPrimitive as _;
use wavestep::expression::Expression;
use wavestep::language::syntax::{Expression as Tree, Factor, Index, Node, Operator, Sign, Wave};
use wavestep::recurrence::LinearForm;
use wavestep_polynomial::{Rational, Symbol};

/// Waves on the n-th period, linearly, and what holds no waves.
#[derive(Clone, Debug, Default)]
pub(super) struct Meaning {
    /// Waves of the scene, [`AHEAD`](crate::book::stage::AHEAD) periods late.
    pub(super) waves: LinearForm,
    pub(super) rest: Sequence,
}

impl From<Expression> for Meaning {
    fn from(value: Expression) -> Meaning {
        Meaning { waves: LinearForm::zero(), rest: Sequence::constant(value) }
    }
}

impl Meaning {
    pub(super) fn plus(&self, other: &Meaning) -> Meaning {
        let mut waves = self.waves.clone();
        waves.add_scaled(&other.waves, &Expression::one(), 0);
        Meaning { waves, rest: self.rest.plus(&other.rest) }
    }

    pub(super) fn minus(&self, other: &Meaning) -> Meaning {
        let minus_one = Expression::integer(-1);
        Meaning { waves: other.waves.scaled(&minus_one), rest: other.rest.negated() }.plus(self)
    }

    /// The product; one of the two holds no waves.
    fn times(&self, other: &Meaning) -> Result<Meaning, Refusal> {
        let (form, factor) = match (self.waves.is_zero(), other.waves.is_zero()) {
            (true, true) => {
                return Ok(Meaning { rest: self.rest.times(&other.rest), ..Meaning::default() });
            }
            (false, true) => (self, other),
            (true, false) => (other, self),
            (false, false) => return Err(Refusal::NotLinear),
        };
        let value = factor.rest.as_constant().ok_or(Refusal::NotLinear)?;
        let waves = form.waves.scaled(&value);
        Ok(Meaning { waves, rest: form.rest.times(&factor.rest) })
    }

    /// The value without waves and without n.
    pub(super) fn as_expression(&self) -> Result<Expression, Refusal> {
        match self.waves.is_zero() {
            true => self.rest.as_constant().ok_or(Refusal::DependsOnPeriod),
            false => Err(Refusal::DependsOnPeriod),
        }
    }
}

/// Which names a formula may hold.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Names {
    Source,
    /// Those of the scene: its waves and observables, by themselves.
    Scene,
}

/// A formula in the course of being understood.
struct Interpreter<'a> {
    stage: &'a Stage,
    names: Names,
    summed: Option<&'a str>,
}

type Outcome = Result<Meaning, Refusal>;

impl<'a> Interpreter<'a> {
    fn new(stage: &'a Stage, names: Names) -> Interpreter<'a> {
        Interpreter { stage, names, summed: None }
    }

    fn meaning(&self, tree: &Tree) -> Outcome {
        match &tree.value {
            Node::Number(value) => Ok(Expression::constant(value).into()),
            Node::Name(name) => self.name(name),
            Node::Wave(wave) => self.wave(wave),
            Node::Call { name, argument } => self.value_of_piece(&name.value, argument),
            Node::Exponential(argument) => {
                let exponent = self.meaning(argument)?.as_expression()?;
                let exponent = exponent.as_fraction().ok_or(Refusal::NotInvertible)?;
                Ok(Expression::exponential(exponent).into())
            }
            Node::Function { function, .. } => Err(Refusal::Function(function.to_string())),
            Node::Summation { term, index, .. } => {
                Interpreter { summed: Some(&index.value), ..*self }.meaning(term)
            }
            Node::Sum(terms) => terms.iter().try_fold(Meaning::default(), |sum, term| {
                let value = self.meaning(&term.value)?;
                Ok(match term.sign {
                    Sign::Plus => sum.plus(&value),
                    Sign::Minus => sum.minus(&value),
                })
            }),
            Node::Product(factors) => self.product(factors),
            Node::Negate(operand) => Ok(Meaning::default().minus(&self.meaning(operand)?)),
            Node::Power { base, exponent } => self.power(base, exponent),
        }
    }

    fn product(&self, factors: &[Factor]) -> Outcome {
        factors.iter().try_fold(Meaning::from(Expression::one()), |product, factor| {
            product.times(&match factor.operator {
                Operator::Multiply => self.meaning(&factor.value)?,
                Operator::Divide => self.inverse(&factor.value)?.into(),
            })
        })
    }

    /// `1/tree`, factor by factor, so that powers of factors need not be recognised.
    fn inverse(&self, tree: &Tree) -> Result<Expression, Refusal> {
        match &tree.value {
            Node::Product(factors) => {
                factors.iter().try_fold(Expression::one(), |product, factor| {
                    let part = match factor.operator {
                        Operator::Multiply => self.inverse(&factor.value)?,
                        Operator::Divide => self.value(&factor.value)?,
                    };
                    Ok(&product * &part)
                })
            }
            Node::Negate(operand) => Ok(-&self.inverse(operand)?),
            Node::Power { base, exponent } => {
                let count = self.value(exponent)?.as_constant();
                let count =
                    count.filter(Rational::is_integer).and_then(|c| c.to_integer().to_u32());
                Ok(self.inverse(base)?.pow(count.ok_or(Refusal::NotInvertible)?))
            }
            _ => inverse(&self.value(tree)?),
        }
    }

    /// The value of a formula without waves, and without n in exponents.
    fn value(&self, tree: &Tree) -> Result<Expression, Refusal> {
        let meaning = self.meaning(tree)?;
        match meaning.waves.is_zero() {
            true => meaning.rest.as_rational().ok_or(Refusal::NotInvertible),
            false => Err(Refusal::NotLinear),
        }
    }

    fn name(&self, name: &str) -> Outcome {
        if self.names == Names::Scene {
            if let Some(waves) = self.stage.form_of_scene(name)? {
                return Ok(Meaning { waves, rest: Sequence::default() });
            }
        } else if let Some(tree) = self.stage.definition(name) {
            return self.meaning(tree);
        }
        let symbol = Symbol::new(name).ok_or_else(|| Refusal::UnknownName(name.to_owned()))?;
        Ok(Expression::symbol(&symbol).into())
    }

    /// `w[n-1]'`, `w[3]`, or `w[i]` in a sum.
    fn wave(&self, wave: &Wave) -> Outcome {
        let name = &wave.name.value;
        let quantity = self.stage.quantity(name)?;
        let Index { base, offset } = &wave.index.value;
        let mut form = quantity.form.clone();
        for _ in 0..wave.primes {
            form = self.stage.slope(&form)?.scaled(&quantity.rate);
        }
        let Some(base) = base else {
            let n = usize::try_from(*offset).map_err(|_| Refusal::DependsOnPeriod)?;
            return Ok(self.stage.on_period(&form, n)?.into());
        };
        let lag = usize::try_from(-offset).map_err(|_| Refusal::DependsOnPeriod)?;
        let mut waves = LinearForm::zero();
        if self.summed == Some(base.value.as_str()) {
            // Σ_{i<n} of values alone.
            for (own, operator) in form.operators() {
                for (j, factor) in operator.value.iter() {
                    waves.add_scaled(&LinearForm::sum(own, j + lag), factor, 0);
                }
            }
        } else {
            waves.add_scaled(&form, &Expression::one(), lag);
        }
        Ok(Meaning { waves, rest: Sequence::default() })
    }

    /// `f_1(0)`: the piece of a wave on a period, at a time of that period.
    fn value_of_piece(&self, name: &str, argument: &Tree) -> Outcome {
        let unknown = || Refusal::UnknownName(name.to_owned());
        let (wave, n) = name.rsplit_once('_').ok_or_else(unknown)?;
        let n: usize = n.parse().map_err(|_| unknown())?;
        let quantity = self.stage.quantity(wave)?;
        let argument = &self.meaning(argument)?.as_expression()? * &quantity.rate;
        let argument = argument.as_fraction().ok_or(Refusal::NotInvertible)?;
        let piece = self.stage.on_period(&quantity.form, n)?;
        let value = piece.substitute(self.stage.local(), &argument);
        Ok(value.map_err(|_| Refusal::NotInvertible)?.into())
    }

    /// A whole power, or a power whose exponent is `n + k`.
    fn power(&self, base: &Tree, exponent: &Tree) -> Outcome {
        let base = self.meaning(base)?.as_expression()?;
        let exponent = self.meaning(exponent)?;
        let exponent = exponent.rest.as_rational().ok_or(Refusal::DependsOnPeriod)?;
        let n = Expression::symbol(&period_number());
        let (rest, ratio) = match exponent.as_constant() {
            Some(number) => (number, Expression::one()),
            None => {
                let rest = (&exponent - &n).as_constant().ok_or(Refusal::DependsOnPeriod)?;
                (rest, base.clone())
            }
        };
        let count = rest.to_integer().to_i32().filter(|_| rest.is_integer());
        let count = count.ok_or(Refusal::NotInvertible)?;
        let factor = match count < 0 {
            true => inverse(&base)?.pow(count.unsigned_abs()),
            false => base.pow(count.unsigned_abs()),
        };
        Ok(Meaning { waves: LinearForm::zero(), rest: Sequence::term(ratio, factor) })
    }
}

impl Section {
    /// The scene of the section, derived from its parts; `None` where it has none. Panics where the section
    /// names what is not there; a test opens all of them.
    pub fn stage(&self) -> Option<Stage> {
        self.scene()?;
        let stage = Stage::new(&self.setting);
        Some(stage.unwrap_or_else(|error| panic!("section {}: {error}", self.number)))
    }
}

impl Stage {
    fn new(setting: &Setting) -> Result<Stage, Refusal> {
        let mut stage = Stage::derived(setting)?;
        for (name, tree, rate) in &setting.quantities {
            let form = Interpreter::new(&stage, Names::Scene).meaning(tree)?.waves;
            let rate = rate.as_ref().map(|rate| stage.expression(rate)).transpose()?;
            let rate = rate.unwrap_or_else(Expression::one);
            stage.call(name, Quantity { form, rate });
        }
        Ok(stage)
    }

    /// An expression of the source in the symbols of the scene, without waves on a general period.
    pub fn expression(&self, tree: &Tree) -> Result<Expression, Refusal> {
        Interpreter::new(self, Names::Source).meaning(tree)?.as_expression()
    }

    pub(super) fn sides(&self, equation: &Equation) -> Result<[Meaning; 2], Refusal> {
        let interpreter = Interpreter::new(self, Names::Source);
        Ok([interpreter.meaning(&equation.left)?, interpreter.meaning(&equation.right)?])
    }
}
