//! Printing in the documented order, and reading back.

use crate::integer::{fraction, product};
use crate::polynomial::Polynomial;
use crate::symbol::Symbol;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

impl fmt::Display for Polynomial {
    /// Terms in the documented order, as `-3/2*mu^2*s + 1`; reads back as the same polynomial.
    /// One gcd a term.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_zero() {
            return f.write_str("0");
        }
        for (i, (exponents, coefficient)) in self.terms().enumerate() {
            match (i, coefficient.is_negative()) {
                (0, false) => {}
                (0, true) => f.write_str("-")?,
                (_, false) => f.write_str(" + ")?,
                (_, true) => f.write_str(" - ")?,
            }
            let size = coefficient.abs();
            let mut separator = "";
            if !size.is_one() || exponents.iter().all(|e| *e == 0) {
                write!(f, "{size}")?;
                separator = "*";
            }
            for (symbol, exponent) in self.symbols().iter().zip(exponents) {
                match exponent {
                    0 => continue,
                    1 => write!(f, "{separator}{symbol}")?,
                    _ => write!(f, "{separator}{symbol}^{exponent}")?,
                }
                separator = "*";
            }
        }
        Ok(())
    }
}

impl fmt::Debug for Polynomial {
    /// As [`Display`](fmt::Display).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// What [`Polynomial::from_str`] could not read, and where.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("at byte {offset}: expected {expected}")]
pub struct ReadError {
    /// Byte offset of the place in the text.
    pub offset: usize,
    /// What would have been right there.
    pub expected: Expected,
}

/// What a reader of polynomials may miss.
#[expect(missing_docs, reason = "the messages say it")]
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Expected {
    #[error("a number or a name")]
    Factor,
    #[error("`+`, `-`, `*` or the end")]
    Operator,
    #[error("an exponent, at most {} in a term", Polynomial::MAX_EXPONENT)]
    Exponent,
    #[error("a denominator other than zero")]
    Denominator,
    #[error("-1 or a prime in parentheses")]
    Radicand,
}

impl FromStr for Polynomial {
    type Err = ReadError;

    /// Reads a sum of products of integers, fractions, names, square roots such as `sqrt(2)` and
    /// powers of these, such as `-3/2*mu^2*s + 1`: all that printing writes, in any order, with white space anywhere
    /// between the parts.
    ///
    /// O(n log n) for `n` terms with short numbers, and at worst the square of the length. The
    /// numerators held are longer than the text where exponents are high (5 kB for the highest)
    /// or fractions have many different denominators: limit the length of a text of unknown
    /// origin.
    fn from_str(text: &str) -> Result<Polynomial, ReadError> {
        let mut reader = Reader { text, offset: 0 };
        let mut terms = Vec::new();
        let mut negative = reader.take_if('-');
        loop {
            let term = reader.term()?;
            terms.push(if negative { -term } else { term });
            negative = match reader.peek() {
                None => return Ok(terms.into_iter().sum()),
                Some('+') => false,
                Some('-') => true,
                Some(_) => return Err(reader.error(Expected::Operator)),
            };
            reader.offset += 1;
        }
    }
}

/// The text and how far it is read.
struct Reader<'a> {
    text: &'a str,
    offset: usize,
}

impl<'a> Reader<'a> {
    /// The next character that is no white space, left in place.
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.offset..];
        self.offset += rest.len() - rest.trim_start().len();
        self.text[self.offset..].chars().next()
    }

    /// Whether `character`, one byte long, comes next; if so, it is taken.
    fn take_if(&mut self, character: char) -> bool {
        let found = self.peek() == Some(character);
        self.offset += usize::from(found);
        found
    }

    /// The characters accepted from here on, without leading white space.
    fn take_while(&mut self, accept: impl Fn(char) -> bool) -> &'a str {
        self.peek();
        let rest = &self.text[self.offset..];
        let length = rest.find(|c| !accept(c)).unwrap_or(rest.len());
        self.offset += length;
        &rest[..length]
    }

    fn error(&self, expected: Expected) -> ReadError {
        ReadError { offset: self.offset, expected }
    }

    /// A product of numbers and powers.
    fn term(&mut self) -> Result<Polynomial, ReadError> {
        let (mut numerators, mut denominators) = (Vec::new(), Vec::new());
        let mut powers = BTreeMap::new();
        loop {
            match self.peek() {
                Some(c) if c.is_ascii_digit() => {
                    numerators.extend(self.integer());
                    if self.take_if('/') {
                        denominators.push(self.denominator()?);
                    }
                }
                Some(c) if c.is_alphabetic() => {
                    let name = self.take_while(|c| c.is_alphanumeric() || c == '_');
                    let symbol = match name {
                        "sqrt" if self.take_if('(') => self.square_root()?,
                        _ => Symbol::new(name).expect("a letter starts a name"),
                    };
                    let exponent = powers.entry(symbol).or_insert(0);
                    *exponent += self.exponent(Polynomial::MAX_EXPONENT - *exponent)?;
                }
                _ => return Err(self.error(Expected::Factor)),
            }
            if !self.take_if('*') {
                break;
            }
        }
        let coefficient = fraction(product(numerators), product(denominators));
        let powers: Vec<_> = powers.iter().map(|(symbol, e)| (symbol, *e)).collect();
        Ok(Polynomial::monomial(&coefficient, &powers))
    }

    /// The root whose radicand comes next, after `sqrt(`.
    fn square_root(&mut self) -> Result<Symbol, ReadError> {
        self.peek();
        let error = self.error(Expected::Radicand);
        let negative = self.take_if('-');
        let size = self.take_while(|c| c.is_ascii_digit()).parse::<i64>().ok();
        let radicand = size.map(|size| if negative { -size } else { size });
        let closed = self.take_if(')');
        radicand.and_then(Symbol::square_root).filter(|_| closed).ok_or(error)
    }

    fn integer(&mut self) -> Option<BigInt> {
        self.take_while(|c| c.is_ascii_digit()).parse().ok()
    }

    /// The positive integer after `/`.
    fn denominator(&mut self) -> Result<BigInt, ReadError> {
        self.peek();
        let error = self.error(Expected::Denominator);
        self.integer().filter(|value| !value.is_zero()).ok_or(error)
    }

    /// The exponent of a name just read, 1 where none is written.
    fn exponent(&mut self, largest: u32) -> Result<u32, ReadError> {
        let mut error = self.error(Expected::Exponent);
        let exponent = if self.take_if('^') {
            self.peek();
            error = self.error(Expected::Exponent);
            self.take_while(|c| c.is_ascii_digit()).parse().ok()
        } else {
            Some(1)
        };
        exponent.filter(|e| *e <= largest).ok_or(error)
    }
}
