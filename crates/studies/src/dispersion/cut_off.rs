//! The cut-off of a pulse given in time: the least root of `ω(k) τ = 2π`, certified.
//!
//! From zero on, cells are excluded where an enclosure of `ω − 2π/τ` is negative, or where it is
//! monotone without a change of sign. The first cell with a change of sign and a positive derivative
//! holds the root, which the interval method of Newton narrows. Next to zero cells shrink in proportion
//! to their distance from it, so that roots far below `2π/τ` are found as well.

use std::cmp::Ordering::{self, Greater, Less};

use num_traits::{One, Zero};
use wavestep_polynomial::Rational;

use super::error::{DispersionError, place};
use super::relation::{Quantity, Relation, value};
use super::series::Fault;
use wavestep::ball::Ball;

const SEARCH_BITS: u64 = 64;
/// The search goes to `2^DOUBLINGS` times the larger of 1 and `2π/τ`, or through so many cells.
const DOUBLINGS: u32 = 64;
const MAX_CELLS: usize = 40_000;
/// A cell is as narrow as `2^{−NARROW}` of its wavenumbers at least.
const NARROW: usize = 40;
/// How often the first cell is halved, which begins at zero.
const MAX_DEPTH: u32 = 1200;
/// The most steps of Newton's method; each halves the interval at least, and soon doubles the digits.
const MAX_STEPS: usize = 400;

enum Cell {
    /// No root.
    Excluded,
    /// One root, where ω grows.
    Root,
    /// ω is negative in all of it.
    Negative,
    /// Not decided.
    Open,
}

struct Search<'a> {
    relation: &'a Relation,
    /// `2π/τ`.
    level: Ball,
}

impl Search<'_> {
    /// The sign of `ω − 2π/τ` at a point; `None` where it is not decided.
    fn sign_at(&self, k: &Rational) -> Option<Ordering> {
        let k = Ball::from_rational(k, SEARCH_BITS);
        let omega = value(self.relation.frequency(), &k, SEARCH_BITS).ok()?;
        omega.subtract(&self.level, SEARCH_BITS).sign()
    }

    fn cell(&self, low: &Rational, high: &Rational) -> Result<Cell, Fault> {
        let bits = SEARCH_BITS;
        let k = Ball::between(low, high, bits);
        let omega = match self.relation.frequency().enclose(&k, bits) {
            Ok(omega) => omega,
            // At the first wavenumber of all, a root may have no enclosure.
            Err(fault) if low.is_zero() || matches!(fault, Fault::MissingValue(_)) => {
                return Err(fault);
            }
            Err(_) => return Ok(Cell::Open),
        };
        if omega.sign() == Some(Less) {
            return Ok(Cell::Negative);
        }
        if omega.subtract(&self.level, bits).sign() == Some(Less) {
            return Ok(Cell::Excluded);
        }
        let Ok([_, slope]) = self.relation.frequency().with_slope(&k, bits) else {
            return Ok(Cell::Open);
        };
        Ok(match (slope.sign(), self.sign_at(low), self.sign_at(high)) {
            (Some(Greater), Some(Less), Some(Greater)) => Cell::Root,
            (Some(_), Some(Less), Some(Less)) => Cell::Excluded,
            _ => Cell::Open,
        })
    }
}

/// The least positive root of `ω(k) τ = 2π`, with a radius of about `2^{−bits}` of it.
/// Refused where there is none before ω is negative or before the search ends, and where 64 bits do not
/// tell.
pub(super) fn cut_off_of_duration(
    relation: &Relation,
    duration: &Rational,
    bits: u64,
) -> Result<Ball, DispersionError> {
    let level = |bits: u64| {
        let twice = Rational::from_integer(2.into()) / duration;
        Ball::pi(bits).multiply_rational(&twice, bits)
    };
    let search = Search { relation, level: level(SEARCH_BITS) };
    let none = |through: &Rational| {
        let through = place(&Ball::from_rational(through, SEARCH_BITS));
        Err(DispersionError::NoCutOff { through })
    };
    // 2π/τ < 7/τ, and of few bits.
    let start = (Rational::from_integer(7.into()) / duration).ceil().max(Rational::one());
    let two = Rational::from_integer(2.into());
    let (mut low, mut high) = (Rational::zero(), start);
    let mut looked_at = 0;
    let narrowest = Rational::new(1.into(), num_bigint::BigInt::from(1) << NARROW);
    for _ in 0..=DOUBLINGS {
        let mut cells = vec![(low.clone(), high.clone(), 0)];
        while let Some((from, to, depth)) = cells.pop() {
            looked_at += 1;
            if looked_at > MAX_CELLS {
                return none(&from);
            }
            let near = Ball::between(&from, &to, SEARCH_BITS);
            let is_narrow = depth >= MAX_DEPTH || &to - &from <= &to * &narrowest;
            let cell = match search.cell(&from, &to) {
                Err(fault) if is_narrow || matches!(fault, Fault::MissingValue(_)) => {
                    return Err(DispersionError::at(fault, &near));
                }
                found => found.unwrap_or(Cell::Open),
            };
            match cell {
                Cell::Excluded => {}
                Cell::Negative => return none(&from),
                Cell::Root => return narrowed(relation, &level, (from, to), bits),
                Cell::Open if is_narrow => {
                    return Err(DispersionError::UndecidedCutOff(place(&near)));
                }
                Cell::Open => {
                    let middle = (&from + &to) / &two;
                    cells.push((middle.clone(), to, depth + 1));
                    cells.push((from, middle, depth + 1));
                }
            }
        }
        (low, high) = (high.clone(), high * &two);
    }
    none(&low)
}

/// Newton's method on an interval with one root and a positive derivative: the root lies in
/// `m − g(m)/g'([a, b])`.
fn narrowed(
    relation: &Relation,
    level: &dyn Fn(u64) -> Ball,
    (mut low, mut high): (Rational, Rational),
    bits: u64,
) -> Result<Ball, DispersionError> {
    let working = bits + 16;
    let two = Rational::from_integer(2.into());
    let level = level(working);
    for _ in 0..MAX_STEPS {
        let width = &high - &low;
        if &width * (Rational::from_integer(num_bigint::BigInt::one() << bits)) <= high {
            break;
        }
        let whole = Ball::between(&low, &high, working);
        let middle =
            Rational::from(Ball::from_rational(&((&low + &high) / &two), working).midpoint());
        let at = Ball::from_rational(&middle, working);
        let g = value(relation.frequency(), &at, working)?.subtract(&level, working);
        let (mut from, mut to) = (low.clone(), high.clone());
        match g.sign() {
            Some(Greater) => to = middle.clone(),
            Some(Less) => from = middle.clone(),
            _ => {}
        }
        if let Ok(slope) = value(relation.formula(Quantity::GroupVelocity), &whole, working)
            && let Ok(inverse) = slope.reciprocal(working)
        {
            let [left, right] = at.subtract(&g.multiply(&inverse, working), working).bounds();
            (from, to) = (from.max(left), to.min(right));
        }
        if from == low && to == high || from > to {
            break;
        }
        (low, high) = (from, to);
    }
    Ok(Ball::between(&low, &high, working))
}
