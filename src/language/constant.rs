//! The value of an expression without names: a bound in `symbol r > 1/2`, a number on the command
//! line. Exact, with limits that keep a short text from asking for an astronomically long number.

use crate::expression::PI;
use crate::limits::MAX_CONSTANT_BITS;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Signed, ToPrimitive, Zero};

use super::diagnostic::Diagnostic;
use super::source::Source;
use super::syntax::{Expression, Node, Operator, Sign, Span};

/// The value of an expression of numbers, `+ - * /`, and whole powers; `0^0` is 1.
///
/// Takes time linear in the size of the expression: sums and products are kept as unreduced
/// fractions of at most [`MAX_CONSTANT_BITS`] bits, and reduced once at the end.
pub fn constant(expression: &Expression, source: &Source) -> Result<BigRational, Diagnostic> {
    let Fraction(numerator, denominator) = evaluate(expression, source)?;
    Ok(BigRational::new(numerator, denominator))
}

/// Numerator and denominator, not reduced; the denominator is not zero, and may be negative.
struct Fraction(BigInt, BigInt);

impl Fraction {
    fn plus(self, other: Self) -> Self {
        if self.1 == other.1 {
            return Self(self.0 + other.0, self.1);
        }
        Self(self.0 * &other.1 + other.0 * &self.1, self.1 * other.1)
    }

    fn times(self, other: Self) -> Self {
        Self(self.0 * other.0, self.1 * other.1)
    }

    fn negated(self) -> Self {
        Self(-self.0, self.1)
    }

    fn inverse(self) -> Option<Self> {
        (!self.0.is_zero()).then_some(Self(self.1, self.0))
    }

    fn bits(&self) -> u64 {
        self.0.bits() + self.1.bits()
    }

    fn within_limit(self, span: Span, source: &Source) -> Result<Self, Diagnostic> {
        if self.bits() <= MAX_CONSTANT_BITS { Ok(self) } else { Err(too_long(span, source)) }
    }
}

fn evaluate(expression: &Expression, source: &Source) -> Result<Fraction, Diagnostic> {
    let Expression { value, span } = expression;
    match value {
        Node::Number(value) => Ok(Fraction(value.numer().clone(), value.denom().clone())),
        Node::Negate(operand) => Ok(evaluate(operand, source)?.negated()),
        Node::Sum(terms) => {
            let zero = Fraction(BigInt::zero(), BigInt::one());
            terms.iter().try_fold(zero, |sum, term| {
                let value = evaluate(&term.value, source)?;
                let value = match term.sign {
                    Sign::Plus => value,
                    Sign::Minus => value.negated(),
                };
                sum.plus(value).within_limit(*span, source)
            })
        }
        Node::Product(factors) => {
            let one = Fraction(BigInt::one(), BigInt::one());
            factors.iter().try_fold(one, |product, factor| {
                let value = evaluate(&factor.value, source)?;
                let value = match factor.operator {
                    Operator::Multiply => value,
                    Operator::Divide => {
                        value.inverse().ok_or_else(|| zero_divisor(factor.value.span, source))?
                    }
                };
                product.times(value).within_limit(*span, source)
            })
        }
        Node::Power { base, exponent } => power(base, exponent, *span, source),
        Node::Name(_)
        | Node::Wave(_)
        | Node::Call { .. }
        | Node::Exponential(_)
        | Node::Function { .. }
        | Node::Summation { .. } => Err(not_constant(expression, source)),
    }
}

fn power(
    base: &Expression,
    exponent: &Expression,
    span: Span,
    source: &Source,
) -> Result<Fraction, Diagnostic> {
    let value = evaluate(base, source)?;
    let wanted = constant(exponent, source)?;
    if !wanted.is_integer() {
        return Err(Diagnostic::new(
            source,
            "the exponent is not a whole number, so the power may be irrational",
            exponent.span,
            format!("this is {wanted}"),
        )
        .with_remedy("write the value as a decimal or a fraction"));
    }
    // Bases of one bit, 0 and ±1, stay as short as they are.
    let trivial = value.0.bits() <= 1 && value.1.bits() <= 1;
    let count = match wanted.numer().abs().to_u32() {
        Some(count) if trivial || value.bits() * u64::from(count) <= MAX_CONSTANT_BITS => count,
        _ => return Err(too_long(span, source)),
    };
    let raised = Fraction(value.0.pow(count), value.1.pow(count));
    if wanted.is_negative() {
        raised.inverse().ok_or_else(|| zero_divisor(base.span, source))
    } else {
        Ok(raised)
    }
}

fn too_long(span: Span, source: &Source) -> Diagnostic {
    Diagnostic::new(
        source,
        "the value of this constant has too many digits",
        span,
        format!("needs more than {MAX_CONSTANT_BITS} bits as a fraction"),
    )
    .with_remedy("write a shorter number")
}

fn zero_divisor(span: Span, source: &Source) -> Diagnostic {
    Diagnostic::new(source, "division by zero", span, "this is zero")
        .with_remedy("divide by a number that is not zero")
}

fn not_constant(expression: &Expression, source: &Source) -> Diagnostic {
    let (message, label) = match &expression.value {
        Node::Name(name) if name == PI => {
            let message = "`pi` is irrational, so it is not an exact constant";
            return Diagnostic::new(
                source,
                message,
                expression.span,
                "a rational number is needed here",
            )
            .with_remedy(
                "write a decimal number near it, or write `pi` in a scene, where it is exact",
            );
        }
        Node::Name(name) if is_like_infinity(name) => {
            (format!("`{name}` is not a finite number"), "a finite number is needed here")
        }
        Node::Exponential(_) => (
            "`exp` of a number is irrational, so it is not an exact constant".to_owned(),
            "a rational number is needed here",
        ),
        Node::Function { function, .. } => (
            format!("`{function}` of a number may be irrational, so it is not an exact constant"),
            "a rational number is needed here",
        ),
        _ => ("this is not a constant".to_owned(), "a number is needed here"),
    };
    Diagnostic::new(source, message, expression.span, label)
        .with_remedy("write a number such as `3`, `0.25`, `33/10` or `1e-3`")
}

fn is_like_infinity(name: &str) -> bool {
    ["nan", "inf", "infinity"].iter().any(|word| name.eq_ignore_ascii_case(word))
}
