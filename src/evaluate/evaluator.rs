//! The value of a wave or an observable at a time, certified.

use crate::ball::{Ball, BallError, CertifyError, certify};
use crate::enclosure::{EnclosureError, enclose_expression};
use crate::evaluate::contribution::{Amount, Contribution, Parts, enclose, rational_value};
use crate::evaluate::value::Value;
use crate::expression::{EchoSum, Expression, NotAUnit};
use crate::network::NetworkError;
use crate::recurrence::{Observation, WaveIndex};
use crate::solution::{EchoRow, GeneralForm, Solution, SolveError};
use num_traits::{Signed, ToPrimitive, Zero};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;
use std::rc::Rc;
pub use wavestep_kernels::fixed::Limit;
use wavestep_polynomial::{Integer, Rational, Symbol, Univariate};

/// The most significant digits that are certified.
///
/// ```
/// use std::collections::BTreeMap;
/// use wavestep::evaluate::{Evaluator, MAX_DIGITS, Limit, Value};
/// use wavestep::language::{Source, parse_number, read_recurrence};
/// use wavestep::solution::Solution;
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = BTreeMap::from([("mu".to_owned(), parse_number("1/4")?)]);
/// let solution = Solution::new(read_recurrence(&Source::new("rigid-mass", text)?, &values)?);
/// let f = solution.recurrence().observation("f").unwrap();
/// let (evaluator, third) = (Evaluator::new(&solution).unwrap(), parse_number("1/3")?);
/// let value = evaluator.value(&f, &third, Limit::Right, MAX_DIGITS, 1 << 16).unwrap();
/// let Value::Certified(certified) = value else { panic!("exp(-1/3) is irrational") };
/// assert!(certified.decimal.to_string().starts_with("0.716531310573789250425"));
/// assert_eq!(certified.decimal.to_string().len(), "0.".len() + MAX_DIGITS);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub const MAX_DIGITS: usize = 10_000;

/// The most periods before a time, where echoes have a closed form.
///
/// ```
/// use std::collections::BTreeMap;
/// use wavestep::evaluate::{EvaluateError, Evaluator, MAX_ORDER, Limit};
/// use wavestep::language::{Source, parse_number, read_recurrence};
/// use wavestep::solution::Solution;
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = BTreeMap::from([("mu".to_owned(), parse_number("1/2")?)]); // a period lasts 1
/// let solution = Solution::new(read_recurrence(&Source::new("rigid-mass", text)?, &values)?);
/// let f = solution.recurrence().observation("f").unwrap();
/// let late = parse_number(&format!("{MAX_ORDER} + 1"))?;
/// let refused = Evaluator::new(&solution).unwrap().value(&f, &late, Limit::Right, 6, 200);
/// let periods = late.to_integer();
/// assert_eq!(refused, Err(EvaluateError::TooManyPeriods { periods, limit: MAX_ORDER }));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub const MAX_ORDER: usize = 2_000;

/// The most periods before a time, where waves are sequences in closed form.
///
/// ```
/// use std::collections::BTreeMap;
/// use wavestep::evaluate::{Evaluator, MAX_ORDER_OF_SEQUENCE, Limit, Value};
/// use wavestep::language::{Source, parse_number, read_recurrence};
/// use wavestep::solution::Solution;
///
/// // Constant force, 6.42: f[n] = n + 1; a period lasts 2.
/// let text = wavestep::scenes::find("constant-force").unwrap().text;
/// let source = Source::new("constant-force", text)?;
/// let solution = Solution::new(read_recurrence(&source, &BTreeMap::new())?);
/// let f = solution.recurrence().observation("f").unwrap();
/// let value = |at| Evaluator::new(&solution).unwrap().value(&f, &at, Limit::Right, 6, 200);
/// let last = parse_number(&format!("2*{MAX_ORDER_OF_SEQUENCE}"))?;
/// let n_plus_1 = parse_number(&format!("{MAX_ORDER_OF_SEQUENCE} + 1"))?;
/// assert_eq!(value(last.clone()), Ok(Value::Exact(n_plus_1)));
/// assert!(value(last + parse_number("2")?).is_err());
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub const MAX_ORDER_OF_SEQUENCE: usize = 50_000;

/// The most periods before a time, where echoes are derived one from another.
///
/// ```
/// use std::collections::BTreeMap;
/// use wavestep::evaluate::{EvaluateError, Evaluator, MAX_ORDER_WITHOUT_FORM, Limit};
/// use wavestep::language::{Source, parse_number, read_recurrence};
/// use wavestep::solution::Solution;
///
/// let source = Source::new("two lags", r#"
///     recurrence "No closed form is known"
///     period 1, local s, time t
///     wave f
///     equation f[n]' + f[n] = f[n-2]
///     continuous f[n] starts at 1
/// "#)?;
/// let solution = Solution::new(read_recurrence(&source, &BTreeMap::new())?);
/// let f = solution.recurrence().observation("f").unwrap();
/// let late = parse_number(&format!("{MAX_ORDER_WITHOUT_FORM} + 1"))?;
/// let refused = Evaluator::new(&solution).unwrap().value(&f, &late, Limit::Right, 6, 200);
/// let (periods, limit) = (late.to_integer(), MAX_ORDER_WITHOUT_FORM);
/// assert_eq!(refused, Err(EvaluateError::TooManyPeriods { periods, limit }));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub const MAX_ORDER_WITHOUT_FORM: usize = 400;

/// Why there is no value.
///
/// ```
/// use std::collections::BTreeMap;
/// use wavestep::evaluate::{EvaluateError, Evaluator, Limit};
/// use wavestep::language::{Source, parse_number, read_recurrence};
/// use wavestep::solution::Solution;
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = BTreeMap::from([("mu".to_owned(), parse_number("1/4")?)]);
/// let solution = Solution::new(read_recurrence(&Source::new("rigid-mass", text)?, &values)?);
/// let f = solution.recurrence().observation("f").unwrap();
/// // Thirty digits do not fit 60 bits; the best enclosure is told.
/// let (evaluator, at) = (Evaluator::new(&solution).unwrap(), parse_number("33/10")?);
/// let error = evaluator.value(&f, &at, Limit::Right, 30, 60).unwrap_err();
/// let EvaluateError::AccuracyNotReached { best, bits: 60 } = error else { panic!("{error}") };
/// assert!(best.to_string().starts_with("0.30538526440879"));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum EvaluateError {
    /// A symbol without a value.
    MissingValue(Symbol),
    /// The time has more periods before it than are worked out.
    TooManyPeriods {
        /// How many periods lie before the time.
        periods: Integer,
        /// How many are allowed.
        limit: usize,
    },
    /// An echo cannot be given exactly.
    Solve(SolveError),
    /// The precision allowed does not do.
    AccuracyNotReached {
        /// The best enclosure.
        best: Box<Ball>,
        /// The precision tried last, in bits.
        bits: u64,
    },
    /// An enclosure could not be computed.
    Ball(BallError),
    /// More echoes arrive until a time than are worked out.
    TooManyEchoes {
        /// About how many.
        echoes: u128,
        /// How many are allowed.
        limit: usize,
    },
    /// A time after the last one that an evaluator was made for.
    AfterLast,
    /// A value that cannot be divided by.
    Division(NotAUnit),
    /// The scene gives no recurrence.
    Network(Box<NetworkError>),
    /// A window that would be cut into more cells than are made.
    TooManyCells {
        /// How many are allowed.
        limit: usize,
    },
    /// More roots, or places of extrema, in a window than are listed.
    TooManyRoots {
        /// How many are allowed.
        limit: usize,
    },
    /// A window that does not end after it begins, at or after time 0.
    EmptyWindow,
    /// A function that no polynomial of the degree allowed follows, however short the cell.
    TooSteep,
    /// An energy, where only what is linear in the waves can be expanded.
    NotLinear(String),
    /// The phases of contacts are not followed with the precision that is needed: why.
    NotFollowed(String),
    /// The value is a complex number that is not real: waves with one pole of a complex pair each.
    NotReal,
}

impl fmt::Display for EvaluateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EvaluateError::MissingValue(symbol) => write!(f, "the symbol {symbol} has no value"),
            EvaluateError::TooManyPeriods { periods, limit } if periods.bits() > 64 => {
                write!(
                    f,
                    "far more than the {limit} periods that are worked out lie before this time"
                )
            }
            EvaluateError::TooManyPeriods { periods, limit } => write!(
                f,
                "{periods} periods lie before this time, and at most {limit} are worked out"
            ),
            EvaluateError::Solve(error) => error.fmt(f),
            EvaluateError::AccuracyNotReached { best, bits } => write!(
                f,
                "accuracy not reached with {bits} bits; the best enclosure has radius {}",
                best.radius()
            ),
            EvaluateError::Ball(error) => error.fmt(f),
            EvaluateError::TooManyEchoes { echoes: u128::MAX, limit } => {
                write!(
                    f,
                    "far more echoes arrive until this time than the {limit} that are worked out"
                )
            }
            EvaluateError::TooManyEchoes { echoes, limit } => write!(
                f,
                "about {echoes} echoes arrive until this time, and at most {limit} are worked out"
            ),
            EvaluateError::AfterLast => {
                f.write_str("the time is after the last one that was prepared for")
            }
            EvaluateError::Division(reason) => reason.fmt(f),
            EvaluateError::Network(error) => error.fmt(f),
            EvaluateError::TooManyCells { limit } => {
                write!(f, "the window needs more than {limit} polynomials: ask for a shorter one")
            }
            EvaluateError::TooManyRoots { limit } => {
                write!(f, "more than {limit} roots lie in this window")
            }
            EvaluateError::EmptyWindow => {
                f.write_str("the window is empty: it has to end after it begins, from 0 on")
            }
            EvaluateError::TooSteep => f.write_str(
                "the function is too steep for polynomials between neighbouring doubles",
            ),
            EvaluateError::NotLinear(name) => {
                write!(f, "{name} is an energy, quadratic in the waves: it has no pieces to expand")
            }
            EvaluateError::NotFollowed(reason) => f.write_str(reason),
            EvaluateError::NotReal => f.write_str("the value is not real"),
        }
    }
}

impl std::error::Error for EvaluateError {}

impl From<EnclosureError> for EvaluateError {
    fn from(error: EnclosureError) -> EvaluateError {
        match error {
            EnclosureError::MissingValue(symbol) => EvaluateError::MissingValue(symbol),
            EnclosureError::Ball(error) => EvaluateError::Ball(error),
            EnclosureError::NotReal => EvaluateError::NotReal,
            EnclosureError::Division(reason) => EvaluateError::Division(reason),
            EnclosureError::Undecided { best, bits } => {
                EvaluateError::AccuracyNotReached { best, bits }
            }
        }
    }
}

impl From<NotAUnit> for EvaluateError {
    fn from(reason: NotAUnit) -> EvaluateError {
        EvaluateError::Division(reason)
    }
}

impl From<NetworkError> for EvaluateError {
    fn from(error: NetworkError) -> EvaluateError {
        match error {
            NetworkError::Division(reason) => EvaluateError::Division(reason),
            other => EvaluateError::Network(Box::new(other)),
        }
    }
}

impl From<SolveError> for EvaluateError {
    fn from(error: SolveError) -> EvaluateError {
        EvaluateError::Solve(error)
    }
}

/// The echoes of a wave, in the cheapest exact form.
enum Echoes {
    Rows(Vec<Row>),
    Expressions(EchoSum),
}

/// The parts of an echo: rates with polynomials.
type Row = Vec<(Rational, Rc<Univariate>)>;

/// Evaluates waves and observables of a solution in which every symbol has a value.
///
/// ```
/// use std::collections::BTreeMap;
/// use wavestep::evaluate::{Evaluator, Limit, Value};
/// use wavestep::language::{Source, parse_number, read_recurrence};
/// use wavestep::solution::Solution;
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = BTreeMap::from([("mu".to_owned(), parse_number("1/4")?)]);
/// let solution = Solution::new(read_recurrence(&Source::new("rigid-mass", text)?, &values)?);
/// let f = solution.recurrence().observation("f").unwrap();
/// let evaluator = Evaluator::new(&solution).unwrap();
/// assert_eq!(evaluator.period(), &parse_number("1/2")?);
/// let value = evaluator.value(&f, &parse_number("33/10")?, Limit::Right, 30, 1000).unwrap();
/// let Value::Certified(certified) = value else { panic!("f is irrational there") };
/// assert_eq!(certified.decimal.to_string(), "0.305385264408791064086396952466");
/// // f starts at 1, a rational number.
/// let rational = |at| evaluator.rational(&f, &parse_number(at).unwrap(), Limit::Right).unwrap();
/// assert_eq!((rational("0"), rational("33/10")), (Some(parse_number("1")?), None));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
    match certify(digits, limit_bits, enclosure) {
        Ok(certified) => Ok(Value::Certified(certified)),
        Err(CertifyError::AccuracyNotReached { best, bits }) => {
            Err(EvaluateError::AccuracyNotReached { best: Box::new(best), bits })
        }
        Err(CertifyError::Enclosure(error)) => Err(error),
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
