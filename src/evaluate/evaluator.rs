//! The value of a wave or an observable at a time, certified.

use crate::ball::{Ball, Value};
use crate::enclosure::enclose_expression;
use crate::evaluate::contribution::{Amount, Contribution, Parts, enclose, rational_value};
use crate::evaluate::error::EvaluateError;
use crate::expression::{EchoSum, Expression};
use crate::recurrence::{Observation, WaveIndex};
use crate::solution::{EchoRow, GeneralForm, Solution};
use num_traits::{Signed, ToPrimitive, Zero};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
pub use wavestep_kernels::fixed::Limit;
use wavestep_polynomial::{Rational, Symbol, Univariate};

/// The most significant digits that are certified.
pub const MAX_DIGITS: usize = 10_000;

/// The most periods before a time, where echoes have a closed form.
pub const MAX_ORDER: usize = 2_000;

/// The most periods before a time, where waves are sequences in closed form.
pub const MAX_ORDER_OF_SEQUENCE: usize = 50_000;

/// The most periods before a time, where echoes are derived one from another.
pub const MAX_ORDER_WITHOUT_FORM: usize = 400;

/// The echoes of a wave, in the cheapest exact form.
enum Echoes {
    Rows(Vec<Row>),
    Expressions(EchoSum),
}

/// The parts of an echo: rates with polynomials.
type Row = Vec<(Rational, Rc<Univariate>)>;

/// Evaluates waves and observables of a solution in which every symbol has a value.
pub struct Evaluator<'a> {
    solution: &'a Solution,
    period: Rational,
    /// The echoes of waves asked for, with the order they are known to.
    echoes: RefCell<BTreeMap<WaveIndex, (usize, Rc<Echoes>)>>,
}

impl<'a> Evaluator<'a> {
    /// An evaluator of `solution`.
    ///
    /// # Errors
    /// [`EvaluateError::MissingValue`] where a symbol is left.
    ///
    /// ```
    /// use wavestep::{evaluate::Evaluator, language, solution::Solution};
    ///
    /// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
    /// let source = language::Source::new("rigid-mass", text)?;
    /// let solution = Solution::new(language::read_recurrence(&source, &Default::default())?);
    /// let error = Evaluator::new(&solution).err().unwrap();
    /// assert_eq!(error.to_string(), "the symbol mu has no value");
    /// # Ok::<(), language::Diagnostic>(())
    /// ```
    pub fn new(solution: &'a Solution) -> Result<Evaluator<'a>, EvaluateError> {
        let recurrence = solution.recurrence();
        if let Some(symbol) = recurrence.symbols().next() {
            return Err(EvaluateError::MissingValue(symbol.clone()));
        }
        let period = recurrence.statement().period.as_constant();
        let period = period.expect("a period without symbols is a number");
        Ok(Evaluator { solution, period, echoes: RefCell::new(BTreeMap::new()) })
    }

    /// The length of a period.
    pub fn period(&self) -> &Rational {
        &self.period
    }

    /// The value of `observation` at scene time `at`, zero before time 0: exactly where it is
    /// rational, else correctly rounded to `digits` significant digits, with at most `limit_bits`
    /// bits of working precision.
    ///
    /// # Errors
    /// [`EvaluateError`], with the reached radius where the precision allowed does not do.
    ///
    /// # Panics
    /// Where `digits` is zero.
    ///
    /// # Cost
    /// O(n²) operations of the working precision for a time after n periods.
    pub fn value(
        &self,
        observation: &Observation,
        at: &Rational,
        side: Limit,
        digits: usize,
        limit_bits: u64,
    ) -> Result<Value, EvaluateError> {
        let parts = self.parts(observation, at, side)?;
        if !parts.algebraic.is_zero() {
            return algebraic_value(&parts.into_expression(), digits, limit_bits);
        }
        if let Some(value) = rational_value(&parts.rational) {
            return Ok(Value::Exact(value));
        }
        let enclosure = |bits| enclose(&parts.rational, bits).map_err(EvaluateError::Ball);
        certified(digits, limit_bits, enclosure)
    }

    /// The value where it is a rational number, decided exactly.
    ///
    /// # Errors
    /// As [`Evaluator::value`].
    pub fn rational(
        &self,
        observation: &Observation,
        at: &Rational,
        side: Limit,
    ) -> Result<Option<Rational>, EvaluateError> {
        let parts = self.parts(observation, at, side)?;
        match parts.algebraic.is_zero() {
            true => Ok(rational_value(&parts.rational)),
            false => Ok(parts.into_expression().as_constant()),
        }
    }

    fn parts(
        &self,
        observation: &Observation,
        at: &Rational,
        side: Limit,
    ) -> Result<Parts, EvaluateError> {
        let mut parts = Parts::default();
        for seen in &observation.waves {
            let delay = seen.delay.as_constant().expect("a delay without symbols is a number");
            let time = at - delay;
            let wave = || -> Result<Parts, EvaluateError> {
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
                Err(symbol) if symbol.square().is_none() => {
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
    ) -> Result<(), EvaluateError> {
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
                Echoes::Rows(rows) => add_row(&rows[k], slope, x, &mut parts.rational),
                Echoes::Expressions(sum) => {
                    let echo = &sum.echoes()[k];
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
    ) -> Result<Option<usize>, EvaluateError> {
        let periods = time / &self.period;
        let last = match side {
            Limit::Right => periods.floor().to_integer(),
            Limit::Left => periods.ceil().to_integer() - 1,
        };
        if last.is_negative() {
            return Ok(None);
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

    fn echoes(&self, wave: WaveIndex, last: usize) -> Result<Rc<Echoes>, EvaluateError> {
        if let Some((known, echoes)) = self.echoes.borrow().get(&wave)
            && *known >= last
        {
            return Ok(echoes.clone());
        }
        // With some in reserve: times are often asked for in ascending order.
        let through = (last + last / 2).max(16);
        let echoes = Rc::new(match self.solution.table(wave, through)? {
            Some(table) => Echoes::Rows(table.into_rows().into_iter().map(shared).collect()),
            None => Echoes::Expressions(self.solution.echoes(wave, through)?),
        });
        self.echoes.borrow_mut().insert(wave, (through, echoes.clone()));
        Ok(echoes)
    }
}

fn shared(row: EchoRow) -> Row {
    row.into_parts().into_iter().map(|(rate, polynomial)| (rate, Rc::new(polynomial))).collect()
}

/// Adds the echo, or its derivative `Σ e^{λx} (P' + λP)`, at `x`.
fn add_row(row: &Row, slope: bool, x: Rational, contributions: &mut Vec<Contribution>) {
    for (rate, polynomial) in row {
        let mut add = |polynomial, factor| {
            contributions.push(Contribution {
                factor,
                amount: Amount::Polynomial(polynomial, x.clone()),
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

/// The digits of a number that is not rational.
pub(crate) fn certified(
    digits: usize,
    limit_bits: u64,
    enclosure: impl FnMut(u64) -> Result<Ball, EvaluateError>,
) -> Result<Value, EvaluateError> {
    match Value::certify(digits, limit_bits, enclosure)? {
        Value::Enclosed(best) => {
            Err(EvaluateError::AccuracyNotReached { best: Box::new(best), bits: limit_bits })
        }
        value => Ok(value),
    }
}

/// The value of an expression without symbols but square roots.
///
/// By the theorem of Lindemann and Weierstrass, in algebraic exponents and coefficients, it is a
/// rational number exactly when it is one as an expression; and it is real exactly when it is its
/// own conjugate, since the conjugates of different exponents are different.
fn algebraic_value(
    sum: &Expression,
    digits: usize,
    limit_bits: u64,
) -> Result<Value, EvaluateError> {
    if let Some(value) = sum.as_constant() {
        return Ok(Value::Exact(value));
    }
    let i = Symbol::square_root(-1).expect("the imaginary unit");
    if sum.conjugate(&i) != *sum {
        return Err(EvaluateError::NotReal);
    }
    certified(digits, limit_bits, |bits| {
        let value = enclose_expression(sum, &|_, _| None, bits)?;
        debug_assert!(value.imaginary().contains(&Rational::default()));
        Ok(value.real().clone())
    })
}
