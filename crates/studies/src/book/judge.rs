//! An equation of the source held against what is derived.

use crate::book::entry::{Equation, Relation};
use crate::book::meaning::Meaning;
use crate::book::refusal::Refusal;
use crate::book::sequence::{Sequence, inverse, period_number};
use crate::book::stage::{AHEAD, Stage};
use crate::book::verdict::{Finding, Ground, Witness};
use wavestep::ball::Ball;
use wavestep::enclosure::enclose_expression;
use wavestep::export::form_text;
use wavestep::expression::{Expression, Fraction};
use wavestep::recurrence::{LinearForm, Operator, WaveIndex};
use wavestep::solution::GeneralForm;
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// The last period on which relations are compared piece by piece, besides a proof for every n.
const LAST: usize = 5;

const WITNESS_BITS: u64 = 192;

/// How many sets of values are tried for a witness.
const ATTEMPTS: usize = 8;

impl Stage {
    pub fn judge(&self, equation: &Equation) -> Result<Finding, Refusal> {
        let [left, right] = self.sides(equation)?;
        if equation.relation == Relation::Starts {
            return self.start(&left, &right);
        }
        let difference = left.minus(&right);
        let fixed = [&left, &right].map(Meaning::as_expression);
        if let [Ok(left), Ok(right)] = fixed {
            return self.fixed(equation, left, right);
        }
        if let Some(rest) = difference.rest.as_constant() {
            let mut form = difference.waves;
            form.add_scaled(&LinearForm::forcing(rest), &Expression::one(), AHEAD);
            return self.relation(&form, [&left, &right]);
        }
        self.sequence(&difference, [&left, &right])
    }

    /// Left minus right of a relation, in the waves of the scene; `None` where it is none, or holds sums
    /// or waves that the scene writes otherwise.
    pub(super) fn difference(&self, equation: &Equation) -> Option<String> {
        let [left, right] = self.sides(equation).ok()?;
        let difference = match equation.relation {
            Relation::Equals => left.minus(&right),
            Relation::Starts => left,
        };
        let mut form = LinearForm::forcing(difference.rest.as_constant()?);
        for (wave, operator) in difference.waves.operators() {
            if !operator.sum.is_empty() {
                return None;
            }
            type Of = fn(WaveIndex, usize) -> LinearForm;
            let rows: [(_, Of); 2] =
                [(&operator.value, LinearForm::wave), (&operator.slope, LinearForm::slope)];
            for (row, of) in rows {
                for (lag, factor) in row.iter() {
                    let lag = lag.checked_sub(AHEAD).filter(|lag| *lag <= 1)?;
                    form.add_scaled(&of(wave, lag), factor, 0);
                }
            }
        }
        let is_relation = form.operators().next().is_some();
        is_relation.then(|| form_text(self.solution().recurrence(), &form))
    }

    /// Two expressions, under the condition of the equation.
    fn fixed(
        &self,
        equation: &Equation,
        mut left: Expression,
        mut right: Expression,
    ) -> Result<Finding, Refusal> {
        if let Some((name, value)) = &equation.condition {
            let symbol = Symbol::new(name).ok_or_else(|| Refusal::UnknownName(name.to_owned()))?;
            let value = self.expression(value)?.as_fraction().ok_or(Refusal::NotInvertible)?;
            for side in [&mut left, &mut right] {
                let put_in = side.substitute(&symbol, &value);
                *side = put_in.map_err(|_| Refusal::NotInvertible)?;
            }
        }
        match left == right {
            true => Ok(Finding::Holds(Ground::SameExpression)),
            false => Ok(Finding::Fails(Box::new(self.witness(None, &left, &right)?))),
        }
    }

    /// A relation between waves: its first periods one by one, then every n at once.
    fn relation(&self, form: &LinearForm, sides: [&Meaning; 2]) -> Result<Finding, Refusal> {
        // A wave from many periods ago is zero on the first ones.
        let reach = form.operators().map(|(_, operator)| operator.reach());
        let last = LAST + reach.max().unwrap_or(0).saturating_sub(AHEAD + 1);
        for n in 0..=last {
            if !self.on_period(form, n)?.is_zero() {
                return self.differs(n, sides);
            }
        }
        Ok(Finding::Holds(match self.solution().is_always_zero(form) {
            true => Ground::EveryPeriod,
            false => Ground::PeriodsThrough(last),
        }))
    }

    fn differs(&self, n: usize, sides: [&Meaning; 2]) -> Result<Finding, Refusal> {
        let number = u32::try_from(n).expect("a small number");
        let value = |side: &Meaning| -> Result<Expression, Refusal> {
            let rest = side.rest.value(number).ok_or(Refusal::NotInvertible)?;
            Ok(&self.on_period(&side.waves, n)? + &rest)
        };
        let [left, right] = [value(sides[0])?, value(sides[1])?];
        Ok(Finding::Fails(Box::new(self.witness(Some(n), &left, &right)?)))
    }

    /// Sequences: powers of n and powers with n in the exponent.
    fn sequence(&self, difference: &Meaning, sides: [&Meaning; 2]) -> Result<Finding, Refusal> {
        // A denominator such as n leaves period 0 out.
        for n in 0..=LAST {
            let number = u32::try_from(n).expect("a small number");
            let Some(rest) = difference.rest.value(number) else { continue };
            if !(&self.on_period(&difference.waves, n)? + &rest).is_zero() {
                return self.differs(n, sides);
            }
        }
        // With sums over earlier periods it is R[n] − R[n−1] that is compared; R[0] has been.
        let sums = |(_, o): (_, &Operator)| !o.sum.is_empty();
        let mut rest = Some(difference.rest.clone());
        if difference.waves.operators().any(sums) {
            let late = difference.rest.delayed();
            rest = late.map(|late| difference.rest.plus(&late.negated()));
        }
        let general = self.general(&difference.waves.without_sums())?;
        let proven = general.zip(rest).is_some_and(|(waves, rest)| waves.plus(&rest).is_zero());
        Ok(Finding::Holds(match proven {
            true => Ground::EveryPower,
            false => Ground::PeriodsThrough(LAST),
        }))
    }

    /// A form in waves that are sequences, in general n; `None` where one of them is not.
    fn general(&self, form: &LinearForm) -> Result<Option<Sequence>, Refusal> {
        let n = Polynomial::symbol(&period_number());
        let mut sum = Sequence::default();
        for (wave, operator) in form.operators() {
            let Ok(GeneralForm::Geometric(sequence)) = self.solution().general(wave) else {
                return Ok(None);
            };
            if !operator.slope.is_empty() || !operator.sum.is_empty() {
                return Ok(None);
            }
            for (lag, factor) in operator.value.iter() {
                // The wave on period n + AHEAD − lag is the sum where that is at least as many as
                // come first; the periods before have been compared one by one.
                if sequence.first.len() + lag > AHEAD + LAST {
                    return Ok(None);
                }
                let by = AHEAD as i64 - lag as i64;
                let shifted = &n + &Polynomial::integer(by);
                for term in &sequence.terms {
                    let count = u32::try_from(by.unsigned_abs()).expect("a small number");
                    let step = if by < 0 { inverse(&term.ratio)? } else { term.ratio.clone() };
                    let power = Expression::from(shifted.pow(term.power));
                    let coefficient = &(&(&term.coefficient * factor) * &step.pow(count)) * &power;
                    sum = sum.plus(&Sequence::term(term.ratio.clone(), coefficient));
                }
            }
        }
        let time = &self.solution().recurrence().statement().time;
        for (lag, function) in form.forcing_terms().iter() {
            if function.contains(time) || lag > AHEAD + LAST {
                return Ok(None);
            }
            sum = sum.plus(&Sequence::constant(function.clone()));
        }
        Ok(Some(sum))
    }

    fn start(&self, form: &Meaning, start: &Meaning) -> Result<Finding, Refusal> {
        let start = start.as_expression()?;
        let lead = |form: &LinearForm| {
            let (_, operator) = form.operators().next()?;
            operator.value.values().next().cloned()
        };
        let own = lead(&form.waves).ok_or(Refusal::DependsOnPeriod)?;
        for step in self.solution().recurrence().steps() {
            let Some(known) = &step.start else { continue };
            let Some(other) = lead(&known.continuous) else { continue };
            let mut late = LinearForm::zero();
            late.add_scaled(&known.continuous, &own, AHEAD);
            late.add_scaled(&form.waves.scaled(&other), &Expression::integer(-1), 0);
            if self.solution().is_always_zero(&late) {
                let (left, right) = (&start * &other, &known.initial * &own);
                return match left == right {
                    true => Ok(Finding::Holds(Ground::Continuity)),
                    false => Ok(Finding::Fails(Box::new(self.witness(None, &right, &left)?))),
                };
            }
        }
        let (first, zero) = (self.on_period(&form.waves, 0)?, Fraction::zero());
        let first = first.substitute(self.local(), &zero).map_err(|_| Refusal::NotInvertible)?;
        Ok(Finding::Fails(Box::new(self.witness(None, &first, &start)?)))
    }

    /// Both sides at the values of the section; at values next to them where the sides cannot be told
    /// apart there.
    fn witness(
        &self,
        period: Option<usize>,
        left: &Expression,
        right: &Expression,
    ) -> Result<Witness, Refusal> {
        let mut symbols = left.symbols();
        symbols.extend(right.symbols());
        symbols.retain(|symbol| symbol.square().is_none());
        symbols.sort_by(|a, b| a.name().cmp(b.name()));
        symbols.dedup();
        let mut attempt = 0;
        loop {
            let witness = self.witness_at(period, left, right, &symbols, attempt)?;
            attempt += 1;
            if witness.is_certain() || attempt == ATTEMPTS {
                return Ok(witness);
            }
        }
    }

    fn witness_at(
        &self,
        period: Option<usize>,
        left: &Expression,
        right: &Expression,
        symbols: &[Symbol],
        attempt: usize,
    ) -> Result<Witness, Refusal> {
        let mut at: Vec<(String, Rational)> = Vec::new();
        for (place, symbol) in symbols.iter().enumerate() {
            let value = self.values().get(symbol.name());
            let value = value.ok_or_else(|| Refusal::NoValue(symbol.to_string()))?;
            let aside = Rational::new((attempt * (place + 1)).into(), 8.into());
            at.push((symbol.name().to_owned(), value + aside));
        }
        let balls = |symbol: &Symbol, bits| {
            let value = at.iter().find(|(name, _)| name == symbol.name());
            value.map(|(_, value)| Ball::from_rational(value, bits))
        };
        let enclose = |side: &Expression| {
            let ball = enclose_expression(side, &balls, WITNESS_BITS);
            ball.map(|ball| ball.real().clone()).map_err(Refusal::from)
        };
        let [left, right] = [enclose(left)?, enclose(right)?];
        Ok(Witness { period, at, left, right })
    }
}
