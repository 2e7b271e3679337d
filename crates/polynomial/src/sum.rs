//! Sums, differences, negatives.

use crate::alignment::{Places, common_symbols};
use crate::integer::lcm;
use crate::polynomial::Polynomial;
use crate::symbol::Symbol;
use crate::term::Term;
use num_bigint::BigInt;
use num_traits::One;
use std::borrow::Cow;
use std::cmp::Ordering;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Neg, Sub, SubAssign};
use std::sync::Arc;

/// Whether the right side is added or subtracted.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sign {
    Plus,
    Minus,
}

/// `left + right`, or `left − right`, by merging two descending lists. `lefts` are the terms of the
/// left side, moved or copied as the caller likes; the numerators of the right side are added to
/// them in place, and copied only where the left side has no such term.
fn merge(
    (left_symbols, denominator, lefts): (&Arc<[Symbol]>, &BigInt, impl Iterator<Item = Term>),
    right: &Polynomial,
    sign: Sign,
) -> Polynomial {
    let symbols = common_symbols(left_symbols, &right.symbols);
    let (from_left, from_right) =
        (Places::new(left_symbols, &symbols), Places::new(&right.symbols, &symbols));
    let common = lcm(denominator, &right.denominator);
    let scale_left = &common / denominator;
    let scale_right = &common / &right.denominator;
    let (rescale_left, rescale_right) = (!scale_left.is_one(), !scale_right.is_one());

    let mut terms = Vec::with_capacity(lefts.size_hint().0.max(right.terms.len()));
    let mut lefts = lefts.map(|mut term| {
        from_left.widen(&mut term.exponents);
        if rescale_left {
            term.numerator *= &scale_left;
        }
        term
    });
    let mut rights = right.terms.iter().map(|term| {
        let numerator = &term.numerator;
        let scaled = if rescale_right {
            Cow::Owned(numerator * &scale_right)
        } else {
            Cow::Borrowed(numerator)
        };
        (from_right.spread(&term.exponents), scaled)
    });
    let new_term = |(exponents, value): (_, Cow<'_, BigInt>)| {
        let value = value.into_owned();
        Term { exponents, numerator: if sign == Sign::Minus { -value } else { value } }
    };
    let (mut next_left, mut next_right) = (lefts.next(), rights.next());
    loop {
        match (next_left, next_right) {
            (Some(mut l), Some(r)) => match l.exponents.cmp(&r.0) {
                Ordering::Greater => {
                    terms.push(l);
                    (next_left, next_right) = (lefts.next(), Some(r));
                }
                Ordering::Less => {
                    terms.push(new_term(r));
                    (next_left, next_right) = (Some(l), rights.next());
                }
                Ordering::Equal => {
                    match sign {
                        Sign::Plus => l.numerator += &*r.1,
                        Sign::Minus => l.numerator -= &*r.1,
                    }
                    terms.push(l);
                    (next_left, next_right) = (lefts.next(), rights.next());
                }
            },
            (l, r) => {
                terms.extend(l.into_iter().chain(lefts));
                terms.extend(r.into_iter().chain(rights).map(new_term));
                break;
            }
        }
    }
    Polynomial::from_parts(symbols, terms, common)
}

/// [`merge`] into `left` itself.
fn merge_owned(left: Polynomial, right: &Polynomial, sign: Sign) -> Polynomial {
    if right.is_zero() {
        return left;
    }
    merge((&left.symbols, &left.denominator, left.terms.into_iter()), right, sign)
}

macro_rules! operators {
    ($operator:ident $name:ident, $in_place:ident $name_in_place:ident, $sign:expr) => {
        impl $operator for &Polynomial {
            type Output = Polynomial;
            /// O(terms of both).
            fn $name(self, other: &Polynomial) -> Polynomial {
                merge((&self.symbols, &self.denominator, self.terms.iter().cloned()), other, $sign)
            }
        }

        impl $in_place<&Polynomial> for Polynomial {
            /// O(terms of both); the numerators of `self` are not copied.
            fn $name_in_place(&mut self, other: &Polynomial) {
                *self = merge_owned(std::mem::take(self), other, $sign);
            }
        }
    };
}
operators!(Add add, AddAssign add_assign, Sign::Plus);
operators!(Sub sub, SubAssign sub_assign, Sign::Minus);

impl Sum for Polynomial {
    /// Neighbours are added first, so that `n` polynomials of one term each take
    /// O(n log n), where one addition after the other would take O(n²).
    fn sum<I: Iterator<Item = Polynomial>>(polynomials: I) -> Polynomial {
        let mut sums: Vec<Polynomial> = polynomials.collect();
        while sums.len() > 1 {
            let mut rest = sums.into_iter();
            let pair = || {
                let left = rest.next()?;
                Some(match rest.next() {
                    Some(right) => merge_owned(left, &right, Sign::Plus),
                    None => left,
                })
            };
            sums = std::iter::from_fn(pair).collect();
        }
        sums.pop().unwrap_or_default()
    }
}

impl Neg for Polynomial {
    type Output = Polynomial;
    /// O(terms), in place.
    fn neg(mut self) -> Polynomial {
        for term in &mut self.terms {
            term.numerator = -std::mem::take(&mut term.numerator);
        }
        self
    }
}

impl Neg for &Polynomial {
    type Output = Polynomial;
    /// O(terms).
    fn neg(self) -> Polynomial {
        -self.clone()
    }
}
