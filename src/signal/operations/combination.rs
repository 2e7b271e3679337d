//! Sums of products of signals.
//!
//! Derivatives of products are those of Leibniz, `(fg)^(n) = Σ_k C(n,k) f^(k) g^(n−k)`. Values are
//! handled as Taylor polynomials with one term.

use super::{Mark, Outcome, Rule, Scale, flatness_of, value_at};
use crate::ball::{Arithmetic as _, Ball};
use crate::expression::{Expression, Fraction};
use crate::signal::{
    EchoCount, Effort, Enclosure, Known, Limit, MAX_FLATNESS, Near, Signal, Taylor,
};
use num_traits::{One as _, Zero as _};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;
use wavestep_polynomial::{Rational, binomial};

/// A coefficient times signals, by their places among the operands.
pub(crate) struct Product {
    pub coefficient: Fraction,
    pub factors: Vec<usize>,
}

/// `Σ c_i Π_j f_ij`.
///
/// # Invariants
/// - all operands have the window of the combination; a product has a factor.
pub(crate) struct Combination<'a> {
    pub scale: Rc<Scale<'a>>,
    pub operands: Vec<Rc<dyn Signal + 'a>>,
    pub products: Vec<Product>,
}

impl Combination<'_> {
    /// The derivative of an order of one product, of those of its factors.
    fn derivative(
        &self,
        product: &Product,
        order: usize,
        bits: u64,
        factor: impl Fn(usize, usize) -> Outcome<Taylor>,
    ) -> Outcome<Taylor> {
        let derivatives = |operand: usize| -> Outcome<Vec<Taylor>> {
            (0..=order).map(|order| factor(operand, order)).collect()
        };
        let mut known = derivatives(product.factors[0])?;
        for operand in &product.factors[1..] {
            let others = derivatives(*operand)?;
            let leibniz = |n: usize| {
                let mut sum = Taylor::polynomial(Vec::new());
                for k in 0..=n {
                    let ways = Ball::from_integer(&binomial(n as u32, k as u32));
                    let part = known[k].multiply(&others[n - k], bits).scaled(&ways, bits);
                    sum = sum.add(&part, bits);
                }
                sum
            };
            known = (0..=order).map(leibniz).collect();
        }
        let coefficient = self.scale.numbers.enclose(&product.coefficient, bits)?;
        let last = known.pop().expect("one for each order");
        Ok(last.scaled(&coefficient, bits))
    }
}

/// Derivatives of operands, by operand and order, each of which is formed once.
fn remembered(
    form: impl Fn(usize, usize) -> Outcome<Taylor>,
) -> impl Fn(usize, usize) -> Outcome<Taylor> {
    let known = RefCell::new(BTreeMap::<_, Taylor>::new());
    move |operand, order| {
        if let Some(own) = known.borrow().get(&(operand, order)) {
            return Ok(own.clone());
        }
        let own = form(operand, order)?;
        known.borrow_mut().insert((operand, order), own.clone());
        Ok(own)
    }
}

impl Rule for Combination<'_> {
    fn ranges(&self) -> Outcome<Vec<Range<usize>>> {
        self.operands.iter().map(|operand| Ok(0..operand.count()?)).collect()
    }

    fn mark(&self, operand: usize, place: usize) -> Mark<'_> {
        Mark::of(&*self.operands[operand], place)
    }

    fn is_instant(&self, operand: usize, place: usize) -> bool {
        self.operands.get(operand).is_some_and(|operand| operand.is_instant(place))
    }

    fn is_continuous(&self) -> bool {
        self.operands.iter().all(|operand| operand.is_continuous())
    }

    fn is_zero(&self, places: &[usize]) -> bool {
        let is_zero = |operand: &usize| self.operands[*operand].is_zero(places[*operand]);
        self.products.iter().all(|product| product.factors.iter().any(is_zero))
    }

    fn square_of(&self) -> Option<(&Fraction, &dyn Signal)> {
        let [Product { coefficient, factors }] = &self.products[..] else { return None };
        let [one, other] = factors[..] else { return None };
        (one == other).then(|| (coefficient, &*self.operands[one]))
    }

    fn terms(
        &self,
        places: &[usize],
        order: usize,
        at: &Mark<'_>,
        bits: u64,
    ) -> Outcome<Vec<Ball>> {
        let factor = remembered(|operand: usize, order: usize| {
            let value = value_at(&*self.operands[operand], places[operand], order, at, bits)?;
            Ok(Taylor::polynomial(vec![value]))
        });
        let term = |product| {
            let mut derivative = self.derivative(product, order, bits, &factor)?;
            Ok(derivative.coefficients.remove(0))
        };
        self.products.iter().map(term).collect()
    }

    fn taylor(&self, places: &[usize], near: Near<'_>) -> Outcome<Taylor> {
        let factor = remembered(|operand: usize, order: usize| {
            self.operands[operand].taylor(places[operand], Near { order, ..near })
        });
        let Near { order, terms, bits, .. } = near;
        let mut sum = Taylor::polynomial(vec![Ball::zero(); terms]);
        for product in &self.products {
            sum = sum.add(&self.derivative(product, order, bits, &factor)?, bits);
        }
        Ok(sum)
    }

    fn exact_at(&self, places: &[usize], at: &Fraction, effort: Effort) -> Option<Expression> {
        let mut known = vec![None; self.operands.len()];
        let mut sum = Expression::zero();
        for Product { coefficient, factors } in &self.products {
            let mut value = Expression::from(coefficient.clone());
            for &operand in factors {
                if known[operand].is_none() {
                    let own = self.operands[operand].exact_at(places[operand], at, effort)?;
                    known[operand] = Some(own);
                }
                value = &value * known[operand].as_ref()?;
            }
            sum += &value;
        }
        Some(sum)
    }

    /// A sum is as flat as the least flat of its products. A product vanishes as often as its factors together; one
    /// without a zero is a constant and more, as far as every factor is.
    fn flatness(&self, places: &[usize], at: (&Mark<'_>, Limit), order: usize) -> Outcome<usize> {
        let time = (&*self.scale, at.0.delay());
        let of = |operand: &usize, order| {
            flatness_of(&*self.operands[*operand], places[*operand], at, order, time)
        };
        let mut least = MAX_FLATNESS + order;
        for Product { factors, .. } in &self.products {
            let mut zeros = 0;
            for factor in factors {
                zeros += of(factor, 0)?;
            }
            if zeros == 0 && order > 0 {
                zeros = 1 + MAX_FLATNESS;
                for factor in factors {
                    zeros = zeros.min(1 + of(factor, 1)?);
                }
            }
            least = least.min(zeros);
        }
        Ok(least.saturating_sub(order))
    }

    fn point(&self, at: &Rational, side: Limit) -> Outcome<(Known, Enclosure<'_>, u64)> {
        let points = self.operands.iter().map(|operand| operand.point(at, side));
        let points: Vec<_> = points.collect::<Outcome<_>>()?;
        let most_bits = points.iter().map(|point| point.most_bits).min().unwrap_or(u64::MAX);
        let exact = |operand: &usize| match &points[*operand].known {
            Known::Rational(value) => Some(value),
            Known::Irrational | Known::Unknown => None,
        };
        let mut sum = Some(Rational::zero());
        for Product { coefficient, factors } in &self.products {
            let mut factors = factors.iter().map(exact);
            let value = match factors.clone().flatten().any(|value| value.is_zero()) {
                true => Some(Rational::zero()),
                false => factors
                    .try_fold(Rational::one(), |product, factor| Some(product * factor?))
                    .zip(coefficient.as_constant())
                    .map(|(value, coefficient)| value * coefficient),
            };
            sum = sum.zip(value).map(|(sum, value)| sum + value);
        }
        let enclose = move |bits| {
            let values: Vec<Ball> =
                points.iter().map(|point| (point.enclose)(bits)).collect::<Outcome<_>>()?;
            let mut sum = Ball::zero();
            for Product { coefficient, factors } in &self.products {
                let coefficient = self.scale.numbers.enclose(coefficient, bits)?;
                let times = |value: Ball, factor: &usize| value.multiply(&values[*factor], bits);
                sum = sum.add(&factors.iter().fold(coefficient, times), bits);
            }
            Ok(sum)
        };
        // Sums of closed forms are looked at more closely only where they may be zero.
        let is_closed = self.operands.iter().any(|operand| operand.closed_form().is_ok());
        let known = match sum {
            Some(sum) if sum.is_zero() || !is_closed => Known::Rational(sum),
            _ => Known::Unknown,
        };
        Ok((known, Box::new(enclose), most_bits))
    }

    fn operands(&self) -> Vec<&dyn Signal> {
        self.operands.iter().map(|operand| &**operand as &dyn Signal).collect()
    }

    fn echoes(&self) -> Option<EchoCount> {
        self.operands.first()?.echoes()
    }
}
