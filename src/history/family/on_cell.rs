//! Functions of time on one cell, for all values of a symbol between two.

use crate::ball::{Arithmetic as _, Ball, Magnitude};
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::network::dot;
use crate::signal::{Taylor, Varying, divide, middle_and_half};
use num_traits::{One as _, Zero as _};
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// How often a cell is halved to tell a sign.
const DEPTH: usize = 12;

/// In how many parts a slope is bounded.
const PARTS: i64 = 16;

/// In how many steps the end of what is positive is approached.
const STEPS: usize = 80;

/// A function of time on a cell, `P(x) + e(x)` for `0 ≤ x ≤ 1`, with `P(x) = Σ_k c_k x^k`.
///
/// # Invariants
/// `|e(x)| ≤ error` and `|e(x)| ≤ at_start + error x` for each value of the symbol. Coefficients have no radii.
#[derive(Clone, Debug)]
pub struct OnCell {
    pub coefficients: Vec<Varying>,
    pub error: Magnitude,
    pub at_start: Magnitude,
}

impl OnCell {
    /// With an error that may be anywhere.
    pub fn new(coefficients: Vec<Varying>, error: Magnitude) -> OnCell {
        OnCell { coefficients, error, at_start: error }
    }

    pub fn constant(value: &Varying) -> OnCell {
        let (value, error) = value.split();
        OnCell::new(vec![value], error)
    }

    pub fn zero() -> OnCell {
        OnCell::new(vec![Varying::zero()], Magnitude::ZERO)
    }

    /// With a further error, which may be anywhere.
    pub fn widened(mut self, by: &Magnitude) -> OnCell {
        self.error = self.error.add(by);
        self.at_start = self.at_start.add(by);
        self
    }

    /// The polynomial alone.
    pub fn polynomial(&self) -> OnCell {
        OnCell::new(self.coefficients.clone(), Magnitude::ZERO)
    }

    pub fn coefficient(&self, k: usize) -> Varying {
        self.coefficients.get(k).cloned().unwrap_or_else(Varying::zero)
    }

    /// The difference to another function.
    pub fn less(&self, other: &OnCell) -> OnCell {
        OnCell::sum(&[Varying::one(), Varying::one().negate()], [self, other].into_iter())
    }

    pub fn total<'p>(parts: impl Iterator<Item = &'p OnCell>) -> OnCell {
        let parts: Vec<&OnCell> = parts.collect();
        OnCell::sum(&vec![Varying::one(); parts.len()], parts.into_iter())
    }

    /// A sum with these factors.
    pub fn sum<'p>(factors: &[Varying], parts: impl Iterator<Item = &'p OnCell>) -> OnCell {
        let (factors, parts): (Vec<Varying>, Vec<&OnCell>) =
            factors.iter().cloned().zip(parts).filter(|(factor, _)| !factor.is_zero()).unzip();
        let total = |of: fn(&OnCell) -> Magnitude| {
            let errors = factors.iter().zip(&parts);
            let errors = errors.map(|(factor, part)| factor.magnitude().multiply(&of(part)));
            errors.fold(Magnitude::ZERO, |sum, own| sum.add(&own))
        };
        let (mut error, mut at_start) = (total(|own| own.error), total(|own| own.at_start));
        let count = parts.iter().map(|part| part.coefficients.len()).max().unwrap_or(0);
        let coefficient = |k| {
            let column: Vec<Varying> = parts.iter().map(|part| part.coefficient(k)).collect();
            let (sum, off) = dot(&factors, &column, BITS).split();
            error = error.add(&off);
            if k == 0 {
                at_start = at_start.add(&off);
            }
            sum
        };
        let coefficients = (0..count).map(coefficient).collect();
        OnCell { coefficients, error, at_start }
    }

    /// The integral from the beginning of the cell on, with its length as the unit.
    pub fn antiderivative(&self) -> OnCell {
        let (mut coefficients, mut error) = (vec![Varying::zero()], self.error);
        for (k, own) in self.coefficients.iter().enumerate() {
            let (own, off) = own.over(k as u64 + 1, BITS).split();
            coefficients.push(own);
            error = error.add(&off);
        }
        OnCell { coefficients, error, at_start: Magnitude::ZERO }
    }

    /// The value at the end of the cell, as a constant.
    pub fn at_end(&self) -> OnCell {
        OnCell::constant(&self.value(&Varying::one())).widened(&self.error)
    }

    /// The polynomial at a place.
    pub fn value(&self, x: &Varying) -> Varying {
        let horner = |value: Varying, own: &Varying| value.multiply(x, BITS).add(own, BITS);
        self.coefficients.iter().rev().fold(Varying::zero(), horner)
    }

    /// The polynomial at a place, for the middle value of the symbol, in doubles.
    pub fn at_middle(&self, x: f64) -> f64 {
        let own = self.coefficients.iter().rev();
        own.fold(0.0, |sum, own| sum * x + own.middle())
    }

    /// The slope of the polynomial at a place.
    pub fn slope(&self, x: &Varying) -> Varying {
        self.derivative().value(x)
    }

    /// That of the polynomial. Its coefficients are rounded.
    fn derivative(&self) -> OnCell {
        let factor = |k: usize| Varying::constant(&Rational::from_integer(k.into()), BITS);
        let slopes = self.coefficients.iter().enumerate().skip(1);
        let slopes = slopes.map(|(k, own)| own.multiply(&factor(k), BITS)).collect();
        OnCell::new(slopes, Magnitude::ZERO)
    }

    pub fn square(&self) -> OnCell {
        let own = &self.coefficients;
        let size = own.iter().fold(Magnitude::ZERO, |sum, c| sum.add(&c.magnitude()));
        let mut error = size.scale(1).add(&self.error).multiply(&self.error);
        let coefficient = |k: usize| {
            let first = (k + 1).saturating_sub(own.len());
            let some = &own[first..=k.min(own.len() - 1)];
            let others: Vec<Varying> = some.iter().rev().cloned().collect();
            let (sum, off) = dot(some, &others, BITS).split();
            error = error.add(&off);
            sum
        };
        let coefficients = (0..(2 * own.len()).saturating_sub(1)).map(coefficient).collect();
        OnCell::new(coefficients, error)
    }

    /// `f(x, ν) = p₀(x) + p₁(x) ν + r` at both ends of the symbol, `p₀ ± p₁`, with a bound of `r`: where both are
    /// positive, the function is for every value.
    pub fn ends(&self) -> [Taylor; 2] {
        let of_power = |k| {
            let own = self.coefficients.iter().map(|own| own.coefficient(k)).collect();
            Taylor { coefficients: own, remainder: Magnitude::ZERO }
        };
        let (middle, slope) = (of_power(0), of_power(1));
        let rests = self.coefficients.iter().map(|own| own.tail(2));
        let rest = rests.fold(self.error, |sum, rest| sum.add(&rest));
        let ends = [middle.add(&slope, BITS), middle.subtract(&slope, BITS)];
        ends.map(|end| Taylor { remainder: rest, ..end })
    }

    /// Whether it is proven not to be negative anywhere on its cell, for any value of the symbol. It may be zero at the start.
    pub fn is_not_negative(&self) -> bool {
        self.about_start().iter().all(|own| is_not_negative(own, DEPTH))
    }

    /// Whether it is proven to be positive at the start, for all values of the symbol.
    pub fn is_positive_at_start(&self) -> bool {
        self.about_start().iter().all(|own| own[0].sign() == Some(Ordering::Greater))
    }

    /// How far below zero it is at the start, at most.
    pub fn below_zero_at_start(&self) -> Magnitude {
        let below = |own: &Vec<Ball>| match own[0].endpoints().0 {
            low if low.is_negative() => low.magnitude(),
            _ => Magnitude::ZERO,
        };
        self.about_start().iter().map(below).max().expect("both ends of the symbol")
    }

    /// Whether it is proven to be negative from the start on, at once.
    pub fn falls_below_zero_at_once(&self) -> bool {
        let falls = |own: &Vec<Ball>| {
            let mut left = own.iter().map(|own| own.clone().negate());
            let first = left.find(|own| !(own.is_exact() && own.contains_zero()));
            first.is_some_and(|own| own.sign() == Some(Ordering::Greater))
        };
        self.about_start().iter().all(falls)
    }

    /// Its coefficients at both ends of the symbol, with what is left out of each.
    fn about_start(&self) -> [Vec<Ball>; 2] {
        self.ends().map(|end| {
            let rests = self.coefficients.iter().map(|own| own.tail(2));
            let both = end.coefficients.iter().zip(rests);
            let mut own: Vec<Ball> = both.map(|(own, rest)| own.widened(&rest)).collect();
            own.resize(own.len().max(2), Ball::zero());
            own[0] = own[0].widened(&self.at_start);
            if self.at_start != self.error {
                own[1] = own[1].widened(&self.error);
            }
            own
        })
    }

    /// The largest size on `from ≤ x ≤ 1`.
    pub fn largest_from(&self, from: &Rational) -> Magnitude {
        let (middle, half) = middle_and_half(from, &Rational::one());
        let sizes = self.ends().map(|end| end.part(&middle, &half, BITS).range().magnitude());
        sizes[0].max(sizes[1])
    }

    /// The same function on the end of the cell from a place on, as on a cell of its own.
    pub fn after(&self, from: &Rational) -> OnCell {
        self.part([from, &Rational::one()])
    }

    /// The same function on one of so many equal parts of the cell.
    pub fn equal_part(&self, part: usize, count: usize) -> OnCell {
        if count == 1 {
            return self.clone();
        }
        let place = |part: usize| Rational::new(part.into(), count.into());
        self.part([&place(part), &place(part + 1)])
    }

    /// The same function between two places, as on a cell of its own. Takes a product for each pair of powers.
    fn part(&self, [from, to]: [&Rational; 2]) -> OnCell {
        let mut own = self.coefficients.clone();
        let [at, length] = [from.clone(), to - from].map(|own| Ball::from_rational(&own, BITS));
        divide(&mut own, |c, next| c.add(&next.clone().scaled(&at, BITS), BITS));
        let (mut power, mut error) = (Ball::from_integer(&1.into()), self.error);
        for coefficient in &mut own {
            let (scaled, off) =
                std::mem::replace(coefficient, Varying::zero()).scaled(&power, BITS).split();
            *coefficient = scaled;
            error = error.add(&off);
            power = power.multiply(&length, BITS);
        }
        OnCell::new(own, error)
    }

    /// A bound from above of the slope of its polynomial between two places.
    pub fn largest_slope(&self, [from, to]: [&Rational; 2]) -> Rational {
        let part = (to - from) / Rational::from_integer(PARTS.into());
        let (slopes, half) = (self.derivative().ends(), &part / Rational::from_integer(2.into()));
        let most = |number: i64| {
            let middle = from + &part * Rational::from_integer(number.into()) + &half;
            let most = |end: &Taylor| {
                Rational::from(&end.part(&middle, &half, BITS).range().endpoints().1)
            };
            slopes.iter().map(most).max().expect("two of them")
        };
        (0..PARTS).map(most).max().expect("some of them")
    }

    /// A place before which it is proven not to be negative, as near to the last as is found.
    pub fn positive_until(&self) -> Rational {
        let half = Rational::new(1.into(), 2.into());
        let (mut known, mut part) = (Rational::zero(), Rational::one());
        for _ in 0..STEPS {
            let next = &known + &part;
            let (middle, width) = middle_and_half(&known, &next);
            let is_above = |end: &Taylor| {
                let (low, _) = end.part(&middle, &width, BITS).range().endpoints();
                !low.is_negative()
            };
            if next <= Rational::one() && self.ends().iter().all(is_above) {
                known = next;
            } else {
                part *= &half;
            }
        }
        known
    }
}

/// Whether `Σ_k c_k x^k` is proven not to be negative for `0 ≤ x ≤ 1`.
fn is_not_negative(own: &[Ball], depth: usize) -> bool {
    let is_below = |own: &Ball| own.endpoints().0.is_negative();
    // Σ_{k≥m} c_k x^(k−m) ≥ c_m − Σ_{k>m} |c_k|, and lower powers are not negative.
    for (m, first) in own.iter().enumerate() {
        let others = own[m + 1..].iter().fold(Magnitude::ZERO, |sum, c| sum.add(&c.magnitude()));
        if !is_below(&first.widened(&others)) {
            return true;
        }
        if is_below(first) {
            break;
        }
    }
    if depth == 0 {
        return false;
    }
    let half = Rational::new(1.into(), 2.into());
    let left: Vec<Ball> = {
        let mut power = Rational::one();
        let mut scaled = |own: &Ball| {
            let scaled = own.multiply_rational(&power, BITS);
            power = &power * &half;
            scaled
        };
        own.iter().map(&mut scaled).collect()
    };
    let right = Taylor { coefficients: own.to_vec(), remainder: Magnitude::ZERO };
    let right = right.part(&half, &half, BITS).coefficients;
    is_not_negative(&left, depth - 1) && is_not_negative(&right, depth - 1)
}
