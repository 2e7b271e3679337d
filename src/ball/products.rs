//! Sums of products that are rounded once.
//!
//! All products are added in one row of limbs for each sign, in units far below the precision; what falls below
//! those is counted as an error, and so is the one rounding at the end.

use super::ball::Ball;
use super::binary::{Binary, LEAST_PRECISION};
use super::complex::ComplexBall;
use super::magnitude::{Magnitude, shifted};
use super::number::Number;
use wavestep_polynomial::limbs::{self, in_buffer};

impl Ball {
    /// `Σ w x y`: the radius is at most `Σ w (|x| r_y + |m_y| r_x) + ε`, `ε` the rounding error of the midpoint, at
    /// most `2^(2−p) Σ w |m_x m_y|`.
    ///
    /// # Cost
    /// A product and a sum of limbs for each term, without rounding.
    pub fn sum_of_products<'a>(
        terms: impl Iterator<Item = (u64, &'a Ball, &'a Ball)> + Clone,
        precision: u64,
    ) -> Ball {
        let midpoints = terms.clone().map(|(w, x, y)| (w, x.midpoint(), y.midpoint()));
        let (midpoint, error) = Binary::sum_of_products(midpoints, precision);
        let mut radius = error;
        for (weight, x, y) in terms {
            let mut own = Magnitude::ZERO;
            if !y.is_exact() {
                own = x.magnitude().multiply(y.radius());
            }
            if !x.is_exact() {
                own = own.add(&y.midpoint().magnitude().multiply(x.radius()));
            }
            let own = if weight == 1 { own } else { own.multiply(&Magnitude::from_u64(weight)) };
            radius = radius.add(&own);
        }
        Ball::new(midpoint, radius)
    }
}

impl Ball {
    /// The coefficients of a product of two polynomials, below a degree: `Σ_(i+j=k) x_i y_j`, each as
    /// [`Ball::sum_of_products`].
    pub fn product_of_polynomials(
        x: &[Ball],
        y: &[Ball],
        count: usize,
        precision: u64,
    ) -> Vec<Ball> {
        let sizes: Vec<Magnitude> = x.iter().map(Ball::magnitude).collect();
        let middles: Vec<Magnitude> = y.iter().map(|y| y.midpoint().magnitude()).collect();
        let coefficient = |k: usize| {
            let places = (k + 1).saturating_sub(y.len())..x.len().min(k + 1);
            let pairs = places.clone().map(|i| (1, x[i].midpoint(), y[k - i].midpoint()));
            let (midpoint, mut radius) = Binary::sum_of_products(pairs, precision);
            for i in places {
                radius = radius.add(&sizes[i].multiply(y[k - i].radius()));
                radius = radius.add(&middles[k - i].multiply(x[i].radius()));
            }
            Ball::new(midpoint, radius)
        };
        (0..count).map(coefficient).collect()
    }
}

impl ComplexBall {
    /// `Σ z w`, where the real and the imaginary parts of all products are rounded once.
    pub fn sum_of_products<'a>(
        terms: impl Iterator<Item = (&'a ComplexBall, &'a ComplexBall)> + Clone,
        precision: u64,
    ) -> ComplexBall {
        type Part = fn(&ComplexBall) -> &Ball;
        let sum = |left: Part, right: Part| {
            let products = terms.clone().map(|(z, w)| (1, left(z), right(w)));
            Ball::sum_of_products(products, precision)
        };
        let (re, im): (Part, Part) = (ComplexBall::real, ComplexBall::imaginary);
        if terms.clone().all(|(z, w)| z.is_real() && w.is_real()) {
            return sum(re, re).into();
        }
        ComplexBall::new(
            sum(re, re).subtract(&sum(im, im), precision),
            sum(re, im).add(&sum(im, re), precision),
        )
    }
}

impl Number {
    /// `Σ w x y`; zero is exact where each term is known to be.
    pub fn sum_of_products<'a>(
        terms: impl Iterator<Item = (u64, &'a Number, &'a Number)>,
        bits: u64,
    ) -> Number {
        let terms: Vec<_> = terms
            .filter(|(_, x, y)| !x.is_zero() && !y.is_zero())
            .map(|(weight, x, y)| (weight, x.as_ball(bits), y.as_ball(bits)))
            .collect();
        match terms.is_empty() {
            true => Number::zero(),
            false => Number::Enclosed(Ball::sum_of_products(
                terms.iter().map(|(weight, x, y)| (*weight, &**x, &**y)),
                bits,
            )),
        }
    }
}

impl Binary {
    /// `(z, ε)` with `|Σ w x y − z| ≤ ε`.
    fn sum_of_products<'a>(
        terms: impl Iterator<Item = (u64, &'a Binary, &'a Binary)> + Clone,
        precision: u64,
    ) -> (Binary, Magnitude) {
        let precision = precision.max(LEAST_PRECISION);
        let (mut largest, mut count) = (None, 0_u64);
        for (weight, x, y) in terms.clone() {
            let (Some(x), Some(y)) = (x.top(), y.top()) else { continue };
            let length = i64::from(u64::BITS - weight.leading_zeros());
            largest = largest.max(Some(shifted(shifted(x, y), length)));
            count += 1;
        }
        let Some(largest) = largest else { return (Binary::zero(), Magnitude::ZERO) };
        // Room for all carries, and a limb at either end: what is added begins within the upper one, and what is cut off
        // is less than the lowest, which is far enough below the precision for all of them.
        let carries = u64::from(u64::BITS - count.leading_zeros());
        let top = shifted(largest, carries as i64 + 64);
        let length = (precision + 2 * carries + 3).div_ceil(64) as usize + 2;
        let mut cut = 0_u64;
        in_buffer(2 * length, |buffer| {
            let (above, below) = buffer.split_at_mut(length);
            for (weight, x, y) in terms {
                if x.is_zero() || y.is_zero() {
                    continue;
                }
                let is_negative = x.is_negative() != y.is_negative();
                let sum = if is_negative { &mut *below } else { &mut *above };
                let is_cut = x.with_product(y, weight, |product, own| add(sum, top, product, own));
                cut += u64::from(is_cut);
            }
            let is_negative = limbs::subtract_shifted(above, below, 0, 0);
            let (sum, error) = Binary::finish(above, top, is_negative, Some(precision));
            let lost = Magnitude::from_u64(cut).scale(shifted(top, 64 - 64 * length as i64));
            (sum, error.add(&lost))
        })
    }
}

/// Adds a fraction of these digits before the exponent `own` to one before `top`: whether digits were cut off.
fn add(sum: &mut [u64], top: i64, digits: &[u64], own: i64) -> bool {
    let gap = top.abs_diff(own);
    let (places, bits) = ((gap / 64) as usize, (gap % 64) as u32);
    let end = sum.len().saturating_sub(places);
    // The lowest digits that still stand in the row.
    let least = usize::from(bits > 0);
    let kept = digits.len().min(end.saturating_sub(least));
    if kept > 0 {
        limbs::add_shifted(sum, &digits[digits.len() - kept..], end - kept, bits);
    }
    kept < digits.len()
}
