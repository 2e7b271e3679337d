//! Constants that have names, as numbers; and the field of enclosures.

use crate::ball::{Attempt, Ball, ComplexBall, Number, Precisions};
use crate::enclosure::error::EnclosureError;
use crate::enclosure::expression::{enclose_expression, real_part};
use crate::enclosure::zero::{Order, ZeroError, enclose_zero_of};
use crate::expression::{Constant, Definition, Expression, Field, Fraction, PI, Root};
use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use wavestep_polynomial::{Rational, Symbol};

/// The most bits that are spent on telling two numbers apart.
const COMPARISON_BITS: u64 = 1 << 14;

/// The precision of bounds.
const BOUND_BITS: u64 = 64;

/// Named constants with their definitions, and `pi`.
pub struct Numbers {
    constants: Vec<Constant>,
    known: RefCell<BTreeMap<(Symbol, u64), Ball>>,
}

impl Numbers {
    /// The numbers of these constants.
    pub fn new(constants: &[Constant]) -> Numbers {
        Numbers { constants: constants.to_vec(), known: RefCell::default() }
    }

    /// The constants, in the order of their definitions.
    pub fn constants(&self) -> &[Constant] {
        &self.constants
    }

    /// Adds a constant with a name of its own, defined by those before it.
    pub fn add(&mut self, constant: Constant) {
        self.constants.push(constant);
    }

    pub fn into_constants(self) -> Vec<Constant> {
        self.constants
    }

    /// The value of a symbol with about so many bits; `None` where it has none.
    pub fn value(&self, symbol: &Symbol, bits: u64) -> Option<Ball> {
        let key = (symbol.clone(), bits);
        if let Some(known) = self.known.borrow().get(&key) {
            return Some(known.clone());
        }
        let own = self.constants.iter().find(|constant| constant.symbol == *symbol);
        let ball = match own {
            Some(constant) => {
                // Zeros of very different sizes take more bits than are asked for.
                let attempt = |bits| match self.enclose_definition(&constant.value, bits) {
                    Ok(ball) => Ok::<_, EnclosureError>(Attempt::Done(ball)),
                    Err(error) => Ok(Attempt::NotYet(error)),
                };
                let precisions = Precisions::doubling(bits + 16, COMPARISON_BITS.max(bits + 16));
                precisions.raise(attempt).and_then(Attempt::done).ok()?
            }
            None if symbol.name() == PI => Ball::pi(bits),
            None => return None,
        };
        self.known.borrow_mut().insert(key, ball.clone());
        Some(ball)
    }

    /// An enclosure of a real value.
    pub fn enclose(&self, value: &Fraction, bits: u64) -> Result<Ball, EnclosureError> {
        real_part(self.enclose_complex(&value.clone().into(), bits)?)
    }

    /// A value as a number: exact where it is rational.
    pub fn number(&self, value: &Fraction, bits: u64) -> Result<Number, EnclosureError> {
        match value.as_constant() {
            Some(value) => Ok(Number::of_rational(value, bits)),
            None => Ok(Number::Enclosed(self.enclose(value, bits)?)),
        }
    }

    /// An enclosure of what a named constant is defined to be.
    pub fn enclose_definition(
        &self,
        value: &Definition,
        bits: u64,
    ) -> Result<Ball, EnclosureError> {
        match value {
            Definition::Root(root) => self.enclose_root(root, bits),
            Definition::Zero { polynomial, between } => {
                self.enclose_zero(polynomial, between, bits)
            }
            Definition::ComplexZero { polynomial, near, imaginary } => {
                let zero = self.enclose_complex_zero(polynomial, near, bits)?;
                Ok(if *imaginary { zero.imaginary().clone() } else { zero.real().clone() })
            }
        }
    }

    /// Positive rational bounds of a symbol, where its enclosure has some.
    pub fn bounds(&self, symbol: &Symbol) -> Option<(Rational, Rational)> {
        let [lower, upper] = self.value(symbol, BOUND_BITS)?.bounds();
        (lower > Rational::default()).then_some((lower, upper))
    }

    /// An enclosure of a factor times a root.
    pub fn enclose_root(&self, value: &Root, bits: u64) -> Result<Ball, EnclosureError> {
        let factor = self.enclose(value.factor(), bits)?;
        if value.radicand().is_one() {
            return Ok(factor);
        }
        let root = self.enclose(value.radicand(), bits)?.sqrt(bits);
        let root = root.ok_or(EnclosureError::NotReal)?;
        Ok(factor.multiply(&root, bits))
    }

    /// The zero of a polynomial, coefficients from the highest power down, that halving finds
    /// between two numbers at which it has different signs.
    fn enclose_zero(
        &self,
        polynomial: &[Fraction],
        between: &[Rational; 2],
        bits: u64,
    ) -> Result<Ball, EnclosureError> {
        let function = |order, x: &Ball, bits| {
            let (mut value, mut slope) = (Ball::zero(), Ball::zero());
            for coefficient in polynomial {
                slope = slope.multiply(x, bits).add(&value, bits);
                value = value.multiply(x, bits).add(&self.enclose(coefficient, bits)?, bits);
            }
            Ok(if order == Order::Value { value } else { slope })
        };
        enclose_zero_of(&function, between, bits).map_err(|error| match error {
            ZeroError::Enclosure(error) => error,
            ZeroError::SameSign | ZeroError::NotSimple => {
                let best = Box::new(Ball::between(&between[0], &between[1], bits));
                EnclosureError::Undecided { best, bits }
            }
        })
    }

    /// The complex zero that the method of Newton finds. Within `n |p(z)/p'(z)|` of any point `z`
    /// there is a zero of a polynomial of degree `n`.
    fn enclose_complex_zero(
        &self,
        polynomial: &[Fraction],
        (re, im): &(Rational, Rational),
        bits: u64,
    ) -> Result<ComplexBall, EnclosureError> {
        let bits = bits + 32;
        let coefficients: Vec<ComplexBall> = polynomial
            .iter()
            .map(|c| self.enclose_complex(&c.clone().into(), bits))
            .collect::<Result<_, _>>()?;
        let ball = |value: &Rational| Ball::from_rational(value, bits);
        let mut z = ComplexBall::new(ball(re), ball(im)).centre();
        // |p/p'| as a step, and how far the zero may be.
        let step = |z: &ComplexBall| -> Result<ComplexBall, EnclosureError> {
            let (mut value, mut slope) = (ComplexBall::zero(), ComplexBall::zero());
            for coefficient in &coefficients {
                slope = slope.multiply(z, bits).add(&value, bits);
                value = value.multiply(z, bits).add(coefficient, bits);
            }
            let inverse = slope.reciprocal(bits)?;
            Ok(value.multiply(&inverse, bits))
        };
        for _ in 0..2 * (64 - bits.leading_zeros()) + 8 {
            let minus = Rational::from_integer((-1).into());
            z = z.add(&step(&z)?.multiply_rational(&minus, bits), bits).centre();
        }
        let degree = Rational::from_integer((polynomial.len() - 1).into());
        let distance = step(&z)?.multiply_rational(&degree, bits);
        Ok(z.widened(&distance))
    }

    pub fn enclose_complex(
        &self,
        value: &Expression,
        bits: u64,
    ) -> Result<ComplexBall, EnclosureError> {
        enclose_expression(value, &|symbol, bits| self.value(symbol, bits), bits)
    }

    /// Which of two numbers is larger; equal where they are so as expressions.
    pub fn compare(&self, left: &Fraction, right: &Fraction) -> Result<Ordering, EnclosureError> {
        if let (Some(left), Some(right)) = (left.as_constant(), right.as_constant()) {
            return Ok(left.cmp(&right));
        }
        let difference = left - right;
        if let Some(number) = difference.as_constant() {
            return Ok(number.cmp(&Rational::default()));
        }
        let attempt = |bits| {
            let ball = self.enclose(&difference, bits)?;
            Ok(match ball.sign() {
                Some(order) => Attempt::Done(order),
                None => Attempt::NotYet(EnclosureError::Undecided { best: Box::new(ball), bits }),
            })
        };
        Precisions::doubling(64, COMPARISON_BITS).raise(attempt).and_then(Attempt::done)
    }

    /// The items in the ascending order of their values.
    pub fn sorted<T>(
        &self,
        items: Vec<T>,
        value: impl Fn(&T) -> &Fraction,
    ) -> Result<Vec<T>, EnclosureError> {
        sorted(items, &|left, right| self.compare(value(left), value(right)))
    }

    /// Where a value stands among ascending ones, or where it would.
    pub fn search(
        &self,
        ascending: &[Fraction],
        value: &Fraction,
    ) -> Result<Result<usize, usize>, EnclosureError> {
        let (mut low, mut high) = (0, ascending.len());
        while low < high {
            let middle = low.midpoint(high);
            match self.compare(&ascending[middle], value)? {
                Ordering::Less => low = middle + 1,
                Ordering::Equal => return Ok(Ok(middle)),
                Ordering::Greater => high = middle,
            }
        }
        Ok(Err(low))
    }

    /// The field of enclosures with so many bits.
    pub fn field(&self, bits: u64) -> Enclosing<'_> {
        Enclosing { numbers: self, bits }
    }
}

/// The items in ascending order, equal ones as they were, by a comparison that may fail; the first failure ends it. With an
/// answer made up in its place `sort_by` may panic. Items that are in order already take one comparison each.
pub(crate) fn sorted<T, E>(
    mut items: Vec<T>,
    compare: &impl Fn(&T, &T) -> Result<Ordering, E>,
) -> Result<Vec<T>, E> {
    if items.len() < 2 {
        return Ok(items);
    }
    let later = items.split_off(items.len() / 2);
    let (mut earlier, later) = (sorted(items, compare)?, sorted(later, compare)?);
    if compare(&earlier[earlier.len() - 1], &later[0])?.is_le() {
        earlier.extend(later);
        return Ok(earlier);
    }
    let (mut earlier, mut later) = (earlier.into_iter().peekable(), later.into_iter().peekable());
    let mut all = Vec::new();
    while let (Some(left), Some(right)) = (earlier.peek(), later.peek()) {
        let is_after = compare(left, right)?.is_gt();
        all.extend(if is_after { later.next() } else { earlier.next() });
    }
    all.extend(earlier.chain(later));
    Ok(all)
}

/// Coefficients as enclosures.
#[derive(Clone, Copy)]
pub struct Enclosing<'a> {
    numbers: &'a Numbers,
    bits: u64,
}

impl Field for Enclosing<'_> {
    type Value = ComplexBall;
    type Error = EnclosureError;

    fn zero(&self) -> ComplexBall {
        ComplexBall::zero()
    }

    fn is_zero(&self, value: &ComplexBall) -> bool {
        let zero = |part: &Ball| part.is_exact() && part.midpoint().is_zero();
        zero(value.real()) && zero(value.imaginary())
    }

    fn embed(&self, value: &Expression) -> Result<ComplexBall, EnclosureError> {
        self.numbers.enclose_complex(value, self.bits)
    }

    fn inverse(&self, value: &Fraction) -> Result<ComplexBall, EnclosureError> {
        let ball = self.embed(&value.clone().into())?;
        ball.reciprocal(self.bits).map_err(EnclosureError::Ball)
    }

    fn add(&self, sum: &mut ComplexBall, other: &ComplexBall) {
        *sum = sum.add(other, self.bits);
    }

    fn product(&self, left: &ComplexBall, right: &ComplexBall) -> ComplexBall {
        left.multiply(right, self.bits)
    }
}
