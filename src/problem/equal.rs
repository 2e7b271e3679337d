//! The value of a symbol for which extrema in two windows are equal.
//!
//! The difference of the extrema, as a function of the symbol, is continuous as long as the two
//! windows keep the arrivals that lie in them. Where it has different signs at two values,
//! certainly, there is one in between for which it is zero; halving keeps such a pair. Whether
//! there is only one is not proven.

use super::{EqualError, Problem, ProblemError};
use crate::expression::Fraction;
use crate::language::{self, Source};
use crate::limits::MAX_DIGITS_OF_SYMBOL;
use crate::planner::Purpose;
use crate::signal::{Goal, Search};
use num_traits::Signed as _;
use std::cmp::Ordering;
use wavestep_polynomial::{Rational, Symbol};

/// What is asked for: a value of the symbol for which the extrema of a quantity are equal for
/// `T₁ ≤ t < T₂` and for `T₂ ≤ t < T₃`.
#[derive(Clone, Debug)]
pub struct EqualExtrema<'a> {
    /// The wave or observable.
    pub name: &'a str,
    pub goal: Goal,
    pub symbol: &'a str,
    /// The lowest value looked at, and the highest.
    pub range: [Rational; 2],
    /// The three times, which may hold the symbol.
    pub times: [&'a str; 3],
    /// What errors call these.
    pub times_name: &'a str,
    pub digits: usize,
}

/// Two values between which the extrema are equal for one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Crossing {
    pub low: Rational,
    pub high: Rational,
    /// With how many bits the extrema cannot be told apart in between, where these are farther apart than
    /// the digits asked for.
    pub undecided: Option<u64>,
}

#[doc(hidden)]
impl Problem {
    /// Finds a value of a symbol by halving its range.
    pub fn equal_extrema(&self, asked: &EqualExtrema<'_>) -> Result<Crossing, ProblemError> {
        if asked.digits > MAX_DIGITS_OF_SYMBOL {
            let (digits, limit) = (asked.digits, MAX_DIGITS_OF_SYMBOL);
            return Err(EqualError::TooManyDigits { digits, limit }.into());
        }
        let [mut low, mut high] = asked.range.clone();
        let sign = |value: &Rational| asked.sign(self, value);
        let (Some(first), Some(last)) = (sign(&low)?, sign(&high)?) else {
            return Err(EqualError::EqualAtEnd.into());
        };
        if first == last {
            return Err(EqualError::NoChange(first).into());
        }
        let half = Rational::new(1.into(), 2.into());
        while !is_narrow(&low, &high, asked.digits) {
            let middle = (&low + &high) * &half;
            match sign(&middle)? {
                Some(sign) if sign == first => low = middle,
                Some(_) => high = middle,
                // As good as equal there: points beside it decide, or nothing does.
                None => {
                    let quarter = (&high - &low) * &half * &half;
                    let (left, right) = (&middle - &quarter, &middle + &quarter);
                    match (sign(&left)?, sign(&right)?) {
                        (Some(a), Some(b)) if a == first && b == last => {
                            (low, high) = (left, right);
                        }
                        _ => {
                            return Ok(Crossing {
                                low,
                                high,
                                undecided: Some(Search::COMPARISON_BITS),
                            });
                        }
                    }
                }
            }
        }
        Ok(Crossing { low, high, undecided: None })
    }
}

/// Whether an interval is shorter than one unit of the last digit.
fn is_narrow(low: &Rational, high: &Rational, digits: usize) -> bool {
    let scale = Rational::from_integer(10.into()).pow(digits as i32);
    (high - low) * scale < low.abs().min(high.abs())
}

impl EqualExtrema<'_> {
    /// The sign of the extremum in the first window less that in the second.
    fn sign(&self, problem: &Problem, value: &Rational) -> Result<Option<Ordering>, ProblemError> {
        let problem = problem.substituted(self.symbol, value)?;
        let wanted = problem.wanted(self.name)?;
        problem.require_numbers()?;
        let mut times = Vec::new();
        for time in self.times {
            times.push(self.time(&problem, time, value)?);
        }
        let [one, two, three] = &times[..] else { unreachable!("three times") };
        if !(one < two && two < three) {
            let (times, symbol) = (self.times_name.to_owned(), self.symbol.to_owned());
            return Err(EqualError::NotAscending { times, symbol, value: value.clone() }.into());
        }
        let windows = [[one, two], [two, three]];
        let [first, second] =
            windows.map(|window| problem.signal_on(&wanted, window, Purpose::Search));
        let (first, second) = (first?, second?);
        let (first, second) =
            (Search::new(&*first)?.half_open(), Search::new(&*second)?.half_open());
        Ok(first.compare_extremum(&second, self.goal)?)
    }

    /// A time with a value in place of the symbol.
    fn time(
        &self,
        problem: &Problem,
        text: &str,
        value: &Rational,
    ) -> Result<Rational, ProblemError> {
        let expression = match Symbol::new(self.symbol) {
            Some(symbol)
                if text.contains(self.symbol) || language::normalise_name(text) != text =>
            {
                let read = language::read_expression(&Source::new(self.times_name, text)?)?;
                read.substitute(&symbol, &Fraction::constant(value)).ok()
            }
            _ => return problem.time(self.times_name, text),
        };
        let time = expression.and_then(|time| time.as_constant());
        time.filter(|time| !time.is_negative()).ok_or_else(|| {
            let (text, symbol) = (text.to_owned(), self.symbol.to_owned());
            EqualError::NoTime { text, symbol, value: value.clone() }.into()
        })
    }
}
