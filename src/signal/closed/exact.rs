//! Exact forms of waves and observables of a recurrence at rational times.

use crate::enclosure::enclose_expression;
use crate::expression::{EchoSum, Expression, Fraction, is_number};
use crate::limits::{MAX_ORDER, MAX_ORDER_OF_SEQUENCE, MAX_ORDER_WITHOUT_FORM};
use crate::recurrence::{Observation, ObservedWave, Recurrence, Statement, WaveIndex};
use crate::signal::closed::contribution::{Contribution, Parts, enclose, rational_value};
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::signal::{Limit, Point};
use crate::solution::{EchoRow, EchoTable, GeneralForm, Solution};
use num_traits::{Signed, ToPrimitive, Zero};
use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use wavestep_polynomial::{Rational, Symbol};

/// The last period on which the function of a wave is worked out where it may decide a sign.
const LAST_EXACT_PIECE: usize = 64;

/// The echoes of a wave, in the cheapest exact form.
enum Echoes {
    Rows(EchoTable),
    Expressions(EchoSum),
}

/// The echoes of a solution in which every symbol has a value, exactly.
pub(super) struct ExactEchoes<'a> {
    solution: Cow<'a, Solution>,
    period: Rational,
    /// The echoes of waves asked for, with the order they are known to.
    echoes: RefCell<BTreeMap<WaveIndex, (usize, Rc<Echoes>)>>,
}

impl<'a> ExactEchoes<'a> {
    pub fn new(solution: Cow<'a, Solution>) -> Outcome<ExactEchoes<'a>> {
        let recurrence = solution.recurrence();
        if let Some(symbol) = recurrence.symbols().next() {
            return Err(EvaluateError::MissingValue(symbol.clone()));
        }
        let period = recurrence.statement().period.as_constant();
        let period = period.expect("a period without symbols is a number");
        Ok(ExactEchoes { solution, period, echoes: RefCell::default() })
    }

    /// The recurrence that is solved.
    pub fn recurrence(&self) -> &Recurrence {
        self.solution.recurrence()
    }

    /// The value of `observation` at scene time `at`, zero before time 0. Whether it is rational is
    /// decided. A time after n periods takes O(n²) operations of the working precision.
    pub fn point(
        &self,
        observation: &Observation,
        at: &Rational,
        side: Limit,
    ) -> Outcome<Point<'static>> {
        let parts = self.parts(observation, at, side)?;
        if !parts.algebraic.is_zero() {
            return algebraic(parts.into_expression());
        }
        Ok(match rational_value(&parts.rational) {
            Some(value) => Point::exact(value),
            None => Point::irrational(move |bits| {
                enclose(&parts.rational, bits).map_err(EvaluateError::Ball)
            }),
        })
    }

    /// The value at a time, where nothing arrives after another time; none where it is long.
    pub fn exact_since(
        &self,
        observation: &Observation,
        since: &Rational,
        at: &Fraction,
    ) -> Option<Expression> {
        let Statement { local, time, period, .. } = self.recurrence().statement();
        if since.is_negative() {
            return Some(Expression::zero());
        }
        let mut sum = observation.forcing.substitute(time, at).ok()?;
        for ObservedWave { coefficient, wave, slope, delay } in &observation.waves {
            let since = since - delay.as_constant()?;
            let Some(n) = self.last_arrival(*wave, &since, Limit::Right).ok()? else { continue };
            if n > LAST_EXACT_PIECE {
                return None;
            }
            let mut piece = self.solution.pieces(*wave, n, n).ok()?.pop()?;
            if *slope {
                piece = piece.derivative(local);
            }
            let passed = delay + &period.scale(&Rational::from_integer(n.into()));
            sum += &(&piece.substitute(local, &(at - &passed)).ok()? * coefficient);
        }
        Some(sum)
    }

    fn parts(&self, observation: &Observation, at: &Rational, side: Limit) -> Outcome<Parts> {
        let mut parts = Parts::default();
        for seen in &observation.waves {
            let delay = seen.delay.as_constant().expect("a delay without symbols is a number");
            let time = at - delay;
            let wave = || -> Outcome<Parts> {
                let mut wave = Parts::default();
                self.add_wave(seen.wave, seen.slope, &time, side, &mut wave)?;
                Ok(wave)
            };
            match seen.coefficient.evaluate(&|_| None) {
                Ok(coefficient) => {
                    for (extra, factor) in &coefficient {
                        parts.add_scaled(wave()?, factor, extra);
                    }
                }
                Err(symbol) if !is_number(&symbol) => {
                    return Err(EvaluateError::MissingValue(symbol));
                }
                Err(_) => parts.algebraic += &(&wave()?.into_expression() * &seen.coefficient),
            }
        }
        let before_start = at.is_negative() || (at.is_zero() && side == Limit::Left);
        if !observation.forcing.is_zero() && !before_start {
            let time = &self.solution.recurrence().statement().time;
            parts.add(&observation.forcing, Some((time, at)))?;
        }
        Ok(parts)
    }

    /// Adds `w(time)`, or the derivative of the pieces: the echoes that have arrived.
    fn add_wave(
        &self,
        wave: WaveIndex,
        slope: bool,
        time: &Rational,
        side: Limit,
        parts: &mut Parts,
    ) -> Outcome<()> {
        let Some(last) = self.last_arrival(wave, time, side)? else { return Ok(()) };
        if let Ok(GeneralForm::Geometric(sequence)) = self.solution.general(wave) {
            // Constant on each period: no echo needs to be added up, and slopes are zero.
            if !slope {
                parts.add(&sequence.value(last), None)?;
            }
            return Ok(());
        }
        let echoes = self.echoes(wave, last)?;
        let local = &self.solution.recurrence().statement().local;
        for k in 0..=last {
            let x = time - &self.period * Rational::from_integer(k.into());
            match &*echoes {
                Echoes::Rows(table) => add_row(&table.rows[k], slope, x, &mut parts.rational),
                Echoes::Expressions(sum) => {
                    let echo = &sum.echoes[k];
                    match slope {
                        true => parts.add(&echo.derivative(local), Some((local, &x)))?,
                        false => parts.add(echo, Some((local, &x)))?,
                    }
                }
            }
        }
        Ok(())
    }

    /// The number of the last echo that has arrived; `None` before the first.
    fn last_arrival(
        &self,
        wave: WaveIndex,
        time: &Rational,
        side: Limit,
    ) -> Outcome<Option<usize>> {
        let periods = time / &self.period;
        let last = match side {
            Limit::Right => periods.floor().to_integer(),
            Limit::Left => periods.ceil().to_integer() - 1,
        };
        if last.is_negative() {
            return Ok(None);
        }
        if let Some(all) = self.recurrence().arrivals().and_then(|all| all[wave].last())
            && last > (*all).into()
        {
            return Ok(Some(*all));
        }
        let limit = match self.solution.general(wave) {
            Ok(GeneralForm::Geometric(_)) => MAX_ORDER_OF_SEQUENCE,
            Ok(GeneralForm::Echoes(_)) => MAX_ORDER,
            Err(_) => MAX_ORDER_WITHOUT_FORM,
        };
        match last.to_usize().filter(|last| *last <= limit) {
            Some(last) => Ok(Some(last)),
            None => Err(EvaluateError::TooManyPeriods { periods: last, limit }),
        }
    }

    fn echoes(&self, wave: WaveIndex, last: usize) -> Outcome<Rc<Echoes>> {
        if let Some((known, echoes)) = self.echoes.borrow().get(&wave)
            && *known >= last
        {
            return Ok(echoes.clone());
        }
        // With some in reserve: times are often asked for in ascending order.
        let through = (last + last / 2).max(16);
        let echoes = Rc::new(match self.solution.table(wave, through)? {
            Some(table) => Echoes::Rows(table),
            None => Echoes::Expressions(self.solution.echoes(wave, through)?),
        });
        self.echoes.borrow_mut().insert(wave, (through, echoes.clone()));
        Ok(echoes)
    }
}

/// Adds the echo, or its derivative `Σ e^{λx} (P' + λP)`, at `x`.
fn add_row(row: &EchoRow, slope: bool, x: Rational, contributions: &mut Vec<Contribution>) {
    for (rate, polynomial) in &row.parts {
        let mut add = |polynomial, factor| {
            contributions.push(Contribution {
                factor,
                polynomial,
                x: x.clone(),
                exponent: rate * &x,
            });
        };
        let one = || Rational::from_integer(1.into());
        if slope {
            add(Rc::new(polynomial.derivative()), one());
            add(polynomial.clone(), rate.clone());
        } else {
            add(polynomial.clone(), one());
        }
    }
}

/// A sum that holds square roots, at one time.
///
/// By the theorem of Lindemann and Weierstrass, in algebraic exponents and coefficients, it is a
/// rational number exactly when it is one as an expression; and it is real exactly when it is its
/// own conjugate, since the conjugates of different exponents are different.
fn algebraic(sum: Expression) -> Outcome<Point<'static>> {
    if let Some(value) = sum.as_constant() {
        return Ok(Point::exact(value));
    }
    let i = Symbol::square_root(-1).expect("the imaginary unit");
    if sum.conjugate(&i) != sum {
        return Err(EvaluateError::NotReal);
    }
    Ok(Point::irrational(move |bits| {
        let value = enclose_expression(&sum, &|_, _| None, bits)?;
        assert!(value.imaginary().contains(&Rational::default()));
        Ok(value.real().clone())
    }))
}
