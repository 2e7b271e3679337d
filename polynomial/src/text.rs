//! Printing in the documented order, and reading back.

use crate::polynomial::Polynomial;
use crate::symbol::Symbol;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::fmt;
use std::str::FromStr;

impl fmt::Display for Polynomial {
    /// Terms in the documented order, as `-3/2*mu^2*s + 1`; reads back as the same polynomial.
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
            let mut factors = Vec::new();
            let size = coefficient.abs();
            let powers = self.symbols().iter().zip(exponents).filter(|(_, e)| **e > 0);
            for (symbol, exponent) in powers {
                factors.push(match exponent {
                    1 => symbol.to_string(),
                    _ => format!("{symbol}^{exponent}"),
                });
            }
            if !size.is_one() || factors.is_empty() {
                factors.insert(0, size.to_string());
            }
            f.write_str(&factors.join("*"))?;
        }
        Ok(())
    }
}

impl fmt::Debug for Polynomial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// What [`Polynomial::from_str`] could not read, and where.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ReadError {
    /// Byte offset of the place.
    pub offset: usize,
    /// What would have been right there.
    pub expected: Expected,
}

/// What a reader of polynomials may miss.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Expected {
    /// A number or a name.
    Factor,
    /// `+`, `-`, `*` or the end.
    Operator,
    /// A non-negative integer exponent below 2^31.
    Exponent,
    /// A denominator other than zero.
    Denominator,
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let expected = match self.expected {
            Expected::Factor => "a number or a name",
            Expected::Operator => "`+`, `-`, `*` or the end",
            Expected::Exponent => "an exponent: an integer from 0 to 2147483647",
            Expected::Denominator => "a denominator other than zero",
        };
        write!(f, "at byte {}: expected {expected}", self.offset)
    }
}

impl std::error::Error for ReadError {}

impl FromStr for Polynomial {
    type Err = ReadError;

    /// Reads a sum of products of integers, fractions, names and powers of names, such as
    /// `-3/2*mu^2*s + 1`: all that printing writes, in any order. O(terms²) at worst.
    fn from_str(text: &str) -> Result<Polynomial, ReadError> {
        let mut reader = Reader { text, offset: 0 };
        let mut sum = Polynomial::zero();
        let mut first = true;
        loop {
            let negative = match reader.peek() {
                Some('-') => true,
                Some('+') if !first => false,
                None if !first => return Ok(sum),
                Some(_) if !first => return Err(reader.error(Expected::Operator)),
                _ => false,
            };
            if !first || negative {
                reader.take();
            }
            first = false;
            let term = reader.term()?;
            if negative { sum -= &term } else { sum += &term }
        }
    }
}

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

    fn take(&mut self) {
        if let Some(character) = self.peek() {
            self.offset += character.len_utf8();
        }
    }

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

    fn term(&mut self) -> Result<Polynomial, ReadError> {
        let mut coefficient = BigRational::one();
        let mut powers = Vec::new();
        loop {
            match self.peek() {
                Some(c) if c.is_ascii_digit() => coefficient *= self.number()?,
                Some(c) if c.is_alphabetic() => {
                    let name = self.take_while(|c| c.is_alphanumeric() || c == '_');
                    let symbol = Symbol::new(name).ok_or(self.error(Expected::Factor))?;
                    powers.push((symbol, self.exponent()?));
                }
                _ => return Err(self.error(Expected::Factor)),
            }
            if self.peek() != Some('*') {
                break;
            }
            self.take();
        }
        let powers: Vec<_> = powers.iter().map(|(symbol, e)| (symbol, *e)).collect();
        Ok(Polynomial::monomial(&coefficient, &powers))
    }

    fn number(&mut self) -> Result<BigRational, ReadError> {
        let digits = |text: &str| text.parse::<BigInt>().ok();
        let numerator = digits(self.take_while(|c| c.is_ascii_digit()));
        let numerator = numerator.ok_or(self.error(Expected::Factor))?;
        if self.peek() != Some('/') {
            return Ok(BigRational::from_integer(numerator));
        }
        self.take();
        let denominator = digits(self.take_while(|c| c.is_ascii_digit()));
        match denominator.filter(|d| !d.is_zero()) {
            Some(denominator) => Ok(BigRational::new(numerator, denominator)),
            None => Err(self.error(Expected::Denominator)),
        }
    }

    fn exponent(&mut self) -> Result<u32, ReadError> {
        if self.peek() != Some('^') {
            return Ok(1);
        }
        self.take();
        let exponent = self.take_while(|c| c.is_ascii_digit()).parse::<u32>().ok();
        exponent.filter(|e| *e < 1 << 31).ok_or(self.error(Expected::Exponent))
    }
}
