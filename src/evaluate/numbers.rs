//! Constants that have names, as numbers; and the field of enclosures.

use crate::ball::{Ball, ComplexBall};
use crate::evaluate::enclosure::enclose_expression;
use crate::evaluate::evaluator::EvaluateError;
use crate::expression::{Constant, Expression, Field, Fraction, NotAUnit, Root};
use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use wavestep_polynomial::{Rational, Symbol};

/// The most bits that are spent on telling two numbers apart.
const COMPARISON_BITS: u64 = 1 << 14;

/// Named constants with their definitions, and `pi`.
///
/// ```
/// use wavestep::evaluate::Numbers;
/// use wavestep::expression::{Constant, Fraction, Root};
/// use wavestep_polynomial::{Rational, Symbol};
///
/// let two = Fraction::constant(&Rational::from_integer(2.into()));
/// let r = Symbol::new("r").unwrap();
/// let constants = [Constant { symbol: r.clone(), value: Root::of(two) }];
/// let numbers = Numbers::new(&constants);
/// let ball = numbers.enclose(&Fraction::symbol(&r), 60).unwrap();
/// assert!(ball.to_string().starts_with("1.41421356237309504"));
/// // r < pi/2
/// let half = Rational::new(1.into(), 2.into());
/// let quarter_turn = Fraction::symbol(&Symbol::new("pi").unwrap()).scale(&half);
/// let order = numbers.compare(&Fraction::symbol(&r), &quarter_turn);
/// assert_eq!(order, Ok(std::cmp::Ordering::Less));
/// ```
pub struct Numbers<'a> {
    constants: &'a [Constant],
    known: RefCell<BTreeMap<(Symbol, u64), Ball>>,
}

impl<'a> Numbers<'a> {
    /// The numbers of these constants.
    pub fn new(constants: &'a [Constant]) -> Numbers<'a> {
        Numbers { constants, known: RefCell::default() }
    }

    /// The value of a symbol with about so many bits; `None` where it has none.
    pub fn value(&self, symbol: &Symbol, bits: u64) -> Option<Ball> {
        let key = (symbol.clone(), bits);
        if let Some(known) = self.known.borrow().get(&key) {
            return Some(known.clone());
        }
        let own = self.constants.iter().find(|constant| constant.symbol == *symbol);
        let ball = match own {
            Some(constant) => self.enclose_root(&constant.value, bits + 16).ok()?,
            None if symbol.name() == "pi" => Ball::pi(bits),
            None => return None,
        };
        self.known.borrow_mut().insert(key, ball.clone());
        Some(ball)
    }

    /// An enclosure of a real value.
    ///
    /// # Errors
    /// [`EvaluateError`] where a symbol has no value.
    pub fn enclose(&self, value: &Fraction, bits: u64) -> Result<Ball, EvaluateError> {
        Ok(self.enclose_complex(&value.clone().into(), bits)?.real().clone())
    }

    /// An enclosure of a factor times a root.
    ///
    /// # Errors
    /// As [`Numbers::enclose`]; also where the radicand is not certainly positive.
    pub fn enclose_root(&self, value: &Root, bits: u64) -> Result<Ball, EvaluateError> {
        let factor = self.enclose(value.factor(), bits)?;
        if value.radicand().is_one() {
            return Ok(factor);
        }
        let root = self.enclose(value.radicand(), bits)?.sqrt(bits);
        let root = root.ok_or(EvaluateError::NotReal)?;
        Ok(factor.multiply(&root, bits))
    }

    fn enclose_complex(&self, value: &Expression, bits: u64) -> Result<ComplexBall, EvaluateError> {
        enclose_expression(value, &|symbol, bits| self.value(symbol, bits), bits)
    }

    /// Which of two numbers is larger; equal where they are so as expressions.
    ///
    /// # Errors
    /// [`EvaluateError::AccuracyNotReached`] where they cannot be told apart.
    pub fn compare(&self, left: &Fraction, right: &Fraction) -> Result<Ordering, EvaluateError> {
        let difference = left - right;
        if let Some(number) = difference.as_constant() {
            return Ok(number.cmp(&Rational::default()));
        }
        let mut bits = 64;
        loop {
            let ball = self.enclose(&difference, bits)?;
            if !ball.contains_zero() {
                let negative = ball.midpoint().is_negative();
                return Ok(if negative { Ordering::Less } else { Ordering::Greater });
            }
            if bits >= COMPARISON_BITS {
                return Err(EvaluateError::AccuracyNotReached { best: Box::new(ball), bits });
            }
            bits *= 4;
        }
    }

    /// The field of enclosures with so many bits.
    pub(crate) fn field(&self, bits: u64) -> Enclosing<'_> {
        Enclosing { numbers: self, bits }
    }
}

/// Coefficients as enclosures.
#[derive(Clone, Copy)]
pub(crate) struct Enclosing<'a> {
    numbers: &'a Numbers<'a>,
    bits: u64,
}

impl From<NotAUnit> for EvaluateError {
    fn from(reason: NotAUnit) -> EvaluateError {
        EvaluateError::Division(reason)
    }
}

impl Field for Enclosing<'_> {
    type Value = ComplexBall;
    type Error = EvaluateError;

    fn zero(&self) -> ComplexBall {
        ComplexBall::zero()
    }

    fn is_zero(&self, value: &ComplexBall) -> bool {
        let zero = |part: &Ball| part.is_exact() && part.midpoint().is_zero();
        zero(value.real()) && zero(value.imaginary())
    }

    fn embed(&self, value: &Expression) -> Result<ComplexBall, EvaluateError> {
        self.numbers.enclose_complex(value, self.bits)
    }

    fn inverse(&self, value: &Fraction) -> Result<ComplexBall, EvaluateError> {
        let ball = self.embed(&value.clone().into())?;
        ball.reciprocal(self.bits).map_err(EvaluateError::Ball)
    }

    fn add(&self, sum: &mut ComplexBall, other: &ComplexBall) {
        *sum = sum.add(other, self.bits);
    }

    fn product(&self, left: &ComplexBall, right: &ComplexBall) -> ComplexBall {
        left.multiply(right, self.bits)
    }
}
