//! Ring operations: sums, products, powers, scaling.

use crate::binomial::multiply_by_binomial;
use crate::polynomial::{Monomial, Polynomial, Term};
use crate::symbol::Symbol;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};
use std::sync::Arc;

/// The union of two lists of symbols, and for each list the places of its symbols in the union
/// (`None` where the list is the union).
struct Alignment {
    symbols: Arc<[Symbol]>,
    left: Option<Vec<usize>>,
    right: Option<Vec<usize>>,
}

fn align(left: &Arc<[Symbol]>, right: &Arc<[Symbol]>) -> Alignment {
    if Arc::ptr_eq(left, right) || left == right {
        return Alignment { symbols: left.clone(), left: None, right: None };
    }
    let mut union: Vec<Symbol> = left.iter().chain(right.iter()).cloned().collect();
    union.sort();
    union.dedup();
    let places = |list: &Arc<[Symbol]>| {
        (list.len() < union.len()).then(|| {
            let place = |symbol| union.binary_search(symbol).expect("the union has every symbol");
            list.iter().map(place).collect()
        })
    };
    let (left_places, right_places) = (places(left), places(right));
    let symbols = match (&left_places, &right_places) {
        (None, _) => left.clone(),
        (_, None) => right.clone(),
        _ => union.into(),
    };
    Alignment { symbols, left: left_places, right: right_places }
}

/// `exponents` with each entry moved to its place in a longer list of symbols.
fn spread(exponents: &Monomial, places: &Option<Vec<usize>>, width: usize) -> Monomial {
    match places {
        None => exponents.clone(),
        Some(places) => {
            let mut wide = Monomial::from_elem(0, width);
            places.iter().zip(exponents).for_each(|(place, e)| wide[*place] = *e);
            wide
        }
    }
}

/// `left + sign · right` by merging two descending lists.
fn merge(left: &Polynomial, right: &Polynomial, subtract: bool) -> Polynomial {
    if right.is_zero() {
        return left.clone();
    }
    if left.is_zero() {
        return if subtract { -right } else { right.clone() };
    }
    let aligned = align(&left.symbols, &right.symbols);
    let width = aligned.symbols.len();
    let denominator = left.denominator.lcm(&right.denominator);
    let scale_left = &denominator / &left.denominator;
    let scale_right = &denominator / &right.denominator;
    let scaled = |value: &BigInt, scale: &BigInt| {
        if scale.is_one() { value.clone() } else { value * scale }
    };
    let mut terms = Vec::with_capacity(left.terms.len() + right.terms.len());
    let from_left = |term: &Term| Term {
        exponents: spread(&term.exponents, &aligned.left, width),
        numerator: scaled(&term.numerator, &scale_left),
    };
    let from_right = |term: &Term| {
        let value = scaled(&term.numerator, &scale_right);
        Term {
            exponents: spread(&term.exponents, &aligned.right, width),
            numerator: if subtract { -value } else { value },
        }
    };
    let mut lefts = left.terms.iter().map(from_left).peekable();
    let mut rights = right.terms.iter().map(from_right).peekable();
    loop {
        let next = match (lefts.peek(), rights.peek()) {
            (Some(l), Some(r)) => match l.exponents.cmp(&r.exponents) {
                Ordering::Greater => lefts.next(),
                Ordering::Less => rights.next(),
                Ordering::Equal => lefts.next().zip(rights.next()).map(|(mut sum, other)| {
                    sum.numerator += other.numerator;
                    sum
                }),
            },
            (Some(_), None) => lefts.next(),
            (None, _) => rights.next(),
        };
        match next {
            Some(term) => terms.push(term),
            None => break,
        }
    }
    Polynomial::from_parts(aligned.symbols, terms, denominator)
}

/// A sum of products in the making, over one list of symbols and one denominator.
#[derive(Default)]
pub(crate) struct Accumulator {
    sums: BTreeMap<Monomial, BigInt>,
}

impl Accumulator {
    /// Adds `scale · left · right`, both lists over the symbols of the accumulator.
    pub fn add_product<'a>(
        &mut self,
        left: impl Iterator<Item = (Monomial, &'a BigInt)>,
        right: &[(Monomial, BigInt)],
    ) {
        for (left_exponents, left_numerator) in left {
            for (right_exponents, right_numerator) in right {
                let mut product = left_numerator * right_numerator;
                let mut exponents = left_exponents.clone();
                for (sum, e) in exponents.iter_mut().zip(right_exponents) {
                    multiply_by_binomial(&mut product, *sum, *e);
                    *sum = sum.checked_add(*e).expect("exponents stay below 2^32");
                }
                self.add(exponents, product);
            }
        }
    }

    fn add(&mut self, exponents: Monomial, value: BigInt) {
        match self.sums.entry(exponents) {
            std::collections::btree_map::Entry::Vacant(place) => {
                place.insert(value);
            }
            std::collections::btree_map::Entry::Occupied(mut place) => *place.get_mut() += value,
        }
    }

    /// The sum over `denominator`, in normal form.
    pub fn finish(self, symbols: Arc<[Symbol]>, denominator: BigInt) -> Polynomial {
        let descending = self.sums.into_iter().rev();
        let terms =
            descending.map(|(exponents, numerator)| Term { exponents, numerator }).collect();
        Polynomial::from_parts(symbols, terms, denominator)
    }
}

/// The terms of `p` over a longer list of symbols.
pub(crate) fn spread_terms<'a>(
    p: &'a Polynomial,
    symbols: &'a Arc<[Symbol]>,
) -> impl Iterator<Item = (Monomial, &'a BigInt)> + 'a {
    let aligned = align(&p.symbols, symbols);
    let width = aligned.symbols.len();
    p.terms.iter().map(move |term| (spread(&term.exponents, &aligned.left, width), &term.numerator))
}

/// The union of the symbols of both.
pub(crate) fn common_symbols(left: &Arc<[Symbol]>, right: &Arc<[Symbol]>) -> Arc<[Symbol]> {
    align(left, right).symbols
}

fn product(left: &Polynomial, right: &Polynomial) -> Polynomial {
    if let Some(value) = right.as_constant() {
        return scale(left, &value);
    }
    if let Some(value) = left.as_constant() {
        return scale(right, &value);
    }
    let symbols = common_symbols(&left.symbols, &right.symbols);
    let owned: Vec<_> =
        spread_terms(right, &symbols).map(|(e, numerator)| (e, numerator.clone())).collect();
    let mut sums = Accumulator::default();
    sums.add_product(spread_terms(left, &symbols), &owned);
    sums.finish(symbols, &left.denominator * &right.denominator)
}

fn scale(p: &Polynomial, factor: &BigRational) -> Polynomial {
    if factor.is_zero() {
        return Polynomial::zero();
    }
    if factor.is_one() {
        return p.clone();
    }
    let mut terms = p.terms.clone();
    if !factor.numer().is_one() {
        terms.iter_mut().for_each(|term| term.numerator *= factor.numer());
    }
    Polynomial::from_parts(p.symbols.clone(), terms, &p.denominator * factor.denom())
}

impl Add for &Polynomial {
    type Output = Polynomial;
    /// O(terms of both).
    fn add(self, other: &Polynomial) -> Polynomial {
        merge(self, other, false)
    }
}

impl Sub for &Polynomial {
    type Output = Polynomial;
    /// O(terms of both).
    fn sub(self, other: &Polynomial) -> Polynomial {
        merge(self, other, true)
    }
}

impl AddAssign<&Polynomial> for Polynomial {
    fn add_assign(&mut self, other: &Polynomial) {
        *self = &*self + other;
    }
}

impl SubAssign<&Polynomial> for Polynomial {
    fn sub_assign(&mut self, other: &Polynomial) {
        *self = &*self - other;
    }
}

impl Mul for &Polynomial {
    type Output = Polynomial;
    /// O(terms of one × terms of the other × log).
    fn mul(self, other: &Polynomial) -> Polynomial {
        product(self, other)
    }
}

impl Mul<&BigRational> for &Polynomial {
    type Output = Polynomial;
    /// O(terms).
    fn mul(self, factor: &BigRational) -> Polynomial {
        scale(self, factor)
    }
}

impl Div<&BigRational> for &Polynomial {
    type Output = Polynomial;
    /// O(terms).
    ///
    /// # Panics
    /// Where the divisor is zero.
    fn div(self, divisor: &BigRational) -> Polynomial {
        scale(self, &divisor.recip())
    }
}

impl Neg for &Polynomial {
    type Output = Polynomial;
    /// O(terms).
    fn neg(self) -> Polynomial {
        let mut negated = self.clone();
        negated.terms.iter_mut().for_each(|term| {
            let value = std::mem::take(&mut term.numerator);
            term.numerator = -value;
        });
        negated
    }
}

impl Neg for Polynomial {
    type Output = Polynomial;
    fn neg(self) -> Polynomial {
        -&self
    }
}

impl Polynomial {
    /// `p^exponent`, by repeated squaring; `p^0 = 1`, also for 0.
    ///
    /// ```
    /// use wavestep_polynomial::Polynomial;
    /// let p: Polynomial = "x - 1".parse().unwrap();
    /// assert_eq!(p.pow(3).to_string(), "x^3 - 3*x^2 + 3*x - 1");
    /// ```
    pub fn pow(&self, exponent: u32) -> Polynomial {
        let mut power = Polynomial::one();
        for bit in (0..u32::BITS - exponent.leading_zeros()).rev() {
            power = &power * &power;
            if exponent >> bit & 1 == 1 {
                power = &power * self;
            }
        }
        power
    }
}
