//! Dense polynomials in one unnamed variable, in the divided-power basis.

use crate::binomial::factorial;
use crate::polynomial::Polynomial;
use crate::symbol::Symbol;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::ops::{Add, Mul, Neg, Sub};

/// A dense polynomial in one variable,
///
/// ```text
/// p(x) = (1/d) Σ_j c_j x^j/j!         c_j, d integers, d > 0
/// ```
///
/// # Invariants
/// - the last `c_j` is not zero (the zero polynomial has none, and `d = 1`);
/// - `d > 0` and `gcd(d, all c_j) = 1`.
///
/// Equal polynomials have one representation.
///
/// ```
/// use wavestep_polynomial::Univariate;
/// // 1 − 4x + 2x²: the Laguerre polynomial L_2 at 2x, whose divided-power coefficients are integers.
/// let p = Univariate::new([1, -4, 4].map(Into::into).into(), 1.into());
/// assert_eq!(p.derivative().coefficients(), &[(-4).into(), 4.into()]);
/// ```
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Univariate {
    coefficients: Vec<BigInt>,
    denominator: BigInt,
}

impl Univariate {
    /// `(1/denominator) Σ_j coefficients_j x^j/j!`. One gcd a coefficient, while they are not 1.
    ///
    /// # Panics
    /// Where the denominator is zero.
    pub fn new(coefficients: Vec<BigInt>, denominator: BigInt) -> Univariate {
        assert!(!denominator.is_zero(), "a polynomial over the denominator zero");
        let mut p = Univariate { coefficients, denominator };
        while p.coefficients.last().is_some_and(Zero::is_zero) {
            p.coefficients.pop();
        }
        let mut common = p.denominator.clone();
        for value in &p.coefficients {
            if common.is_one() {
                break;
            }
            common = common.gcd(value);
        }
        if p.denominator.is_negative() {
            common = -common.abs();
        }
        if !common.is_one() {
            p.denominator /= &common;
            p.coefficients.iter_mut().for_each(|value| *value /= &common);
        }
        if p.coefficients.is_empty() {
            p.denominator = BigInt::one();
        }
        p
    }

    /// The polynomial 0.
    pub fn zero() -> Univariate {
        Univariate { coefficients: Vec::new(), denominator: BigInt::one() }
    }

    /// A constant.
    pub fn constant(value: &BigRational) -> Univariate {
        Univariate::new(vec![value.numer().clone()], value.denom().clone())
    }

    /// `p` read as a polynomial in `x`, or `None` where another symbol occurs. O(terms).
    pub fn from_polynomial(p: &Polynomial, x: &Symbol) -> Option<Univariate> {
        let mut coefficients = vec![BigInt::zero(); p.degree(x) as usize + 1];
        if p.symbols().iter().any(|symbol| symbol != x) {
            return None;
        }
        let (denominator, terms) = p.divided_terms();
        for (exponents, numerator) in terms {
            let power = exponents.first().copied().unwrap_or(0);
            coefficients[power as usize] = numerator.clone();
        }
        Some(Univariate::new(coefficients, denominator.clone()))
    }

    /// The same polynomial in the symbol `x`. O(degree).
    pub fn to_polynomial(&self, x: &Symbol) -> Polynomial {
        Polynomial::from_divided(x, &self.coefficients, &self.denominator)
    }

    /// Whether this is 0.
    pub fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// The degree, or `None` for 0. O(1).
    pub fn degree(&self) -> Option<usize> {
        self.coefficients.len().checked_sub(1)
    }

    /// The integers `c_0, c_1, …` of the divided-power form; the last is not zero.
    pub fn coefficients(&self) -> &[BigInt] {
        &self.coefficients
    }

    /// The shared denominator `d > 0`.
    pub fn denominator(&self) -> &BigInt {
        &self.denominator
    }

    /// The reduced coefficient of `x^j` (ordinary powers). One gcd.
    pub fn coefficient(&self, j: usize) -> BigRational {
        let index = u32::try_from(j).expect("an exponent fits 32 bits");
        let value = self.coefficients.get(j).cloned().unwrap_or_default();
        BigRational::new(value, &self.denominator * factorial(index))
    }

    /// The derivative: the coefficients go down by one place. O(degree).
    pub fn derivative(&self) -> Univariate {
        let lowered = self.coefficients.iter().skip(1).cloned().collect();
        Univariate::new(lowered, self.denominator.clone())
    }

    /// The antiderivative `∫_0^x p`: the coefficients go up by one place. O(degree).
    pub fn antiderivative(&self) -> Univariate {
        let raised = std::iter::once(BigInt::zero()).chain(self.coefficients.iter().cloned());
        Univariate::new(raised.collect(), self.denominator.clone())
    }

    /// The Taylor shift `p(x + h)`: `c_i' = Σ_{j ≥ i} c_j h^{j−i}/(j−i)!`. O(degree²).
    pub fn shift(&self, h: &BigRational) -> Univariate {
        let degree = self.coefficients.len();
        // Powers h^m/m! over the one denominator den(h)^n n!.
        let mut powers = vec![BigInt::one()];
        let mut scale = BigInt::one();
        for m in 1..degree {
            let step = h.denom() * BigInt::from(m);
            powers.iter_mut().for_each(|power| *power *= &step);
            let last = &powers[m - 1] / &step;
            powers.push(last * h.numer());
            scale *= step;
        }
        let shifted = (0..degree).map(|i| {
            let products = self.coefficients[i..].iter().zip(&powers).map(|(c, power)| c * power);
            products.sum()
        });
        Univariate::new(shifted.collect(), &self.denominator * scale)
    }

    /// The value at a rational point, by Horner's rule `c_j + x/(j+1) (…)`. O(degree) products.
    pub fn evaluate(&self, x: &BigRational) -> BigRational {
        // numerator / (den(x)^k k!), brought to one denominator step by step.
        let mut numerator = BigInt::zero();
        let mut scale = BigInt::one();
        for (j, coefficient) in self.coefficients.iter().enumerate().rev() {
            let step = x.denom() * BigInt::from(j + 1);
            numerator *= x.numer();
            scale *= step;
            numerator += coefficient * &scale;
        }
        BigRational::new(numerator, scale * &self.denominator)
    }
}

/// `left + right` with the second scaled by `sign`.
fn combine(left: &Univariate, right: &Univariate, negate: bool) -> Univariate {
    let denominator = left.denominator.lcm(&right.denominator);
    let scale_left = &denominator / &left.denominator;
    let scale_right = &denominator / &right.denominator;
    let length = left.coefficients.len().max(right.coefficients.len());
    let at = |p: &Univariate, j: usize, scale: &BigInt| {
        p.coefficients.get(j).map_or_else(BigInt::zero, |value| value * scale)
    };
    let sums = (0..length).map(|j| {
        let (l, r) = (at(left, j, &scale_left), at(right, j, &scale_right));
        if negate { l - r } else { l + r }
    });
    Univariate::new(sums.collect(), denominator)
}

impl Add for &Univariate {
    type Output = Univariate;
    /// O(degree).
    fn add(self, other: &Univariate) -> Univariate {
        combine(self, other, false)
    }
}

impl Sub for &Univariate {
    type Output = Univariate;
    /// O(degree).
    fn sub(self, other: &Univariate) -> Univariate {
        combine(self, other, true)
    }
}

impl Neg for &Univariate {
    type Output = Univariate;
    fn neg(self) -> Univariate {
        combine(&Univariate::zero(), self, true)
    }
}

impl Mul for &Univariate {
    type Output = Univariate;
    /// O(degree of one × degree of the other): `x^[a] x^[b] = C(a+b, a) x^[a+b]`.
    fn mul(self, other: &Univariate) -> Univariate {
        let length = (self.coefficients.len() + other.coefficients.len()).saturating_sub(1);
        let mut products = vec![BigInt::zero(); length];
        for (a, left) in self.coefficients.iter().enumerate() {
            for (b, right) in other.coefficients.iter().enumerate() {
                let mut product = left * right;
                crate::binomial::multiply_by_binomial(&mut product, a as u32, b as u32);
                products[a + b] += product;
            }
        }
        Univariate::new(products, &self.denominator * &other.denominator)
    }
}
