//! Taylor series in balls: a value with its derivatives, `f(k₀ + hu) = Σ c_n uⁿ`, by the recurrences
//! that functions satisfy as solutions of differential equations.
//!
//! Where `k₀` is a point, the coefficients are those at the point; where it is an interval, each `c_n`
//! contains `f⁽ⁿ⁾(ξ) hⁿ/n!` for all its points `ξ`, which bounds remainders.

use num_traits::{One, Signed, ToPrimitive as _};
use wavestep_polynomial::{Integer, Rational, Symbol};

use super::formula::{Formula, Function, Node, pi, wave_number};
use crate::ratio;
use wavestep::ball::{Ball, BallError, Binary, Magnitude};

/// Arguments of `sinc` below this are summed as a power series.
const SINC_NEAR: i64 = 8;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    MissingValue(Symbol),
    /// A divisor may be zero.
    Divisor,
    /// What is under a root is negative.
    NotReal,
    /// What is under a root may be zero, so it may have no derivative.
    RootOfZero,
    Ball(BallError),
}

impl From<BallError> for Fault {
    fn from(error: BallError) -> Fault {
        match error {
            BallError::DivisorMayBeZero => Fault::Divisor,
            other => Fault::Ball(other),
        }
    }
}

/// The coefficients `c_0 … c_{N−1}`.
///
/// # Invariants
/// - At least one; operands of one operation have as many as each other.
#[derive(Clone, Debug)]
pub(super) struct Series(Vec<Ball>);

fn rational(value: i64) -> Rational {
    ratio(value, 1)
}

impl Series {
    fn constant(value: Ball, count: usize) -> Series {
        let mut coefficients = vec![Ball::zero(); count];
        coefficients[0] = value;
        Series(coefficients)
    }

    /// `k₀ + hu` with `count` coefficients.
    pub(super) fn wave_number(at: &Ball, half_width: &Ball, count: usize) -> Series {
        let mut series = Series::constant(at.clone(), count);
        if count > 1 {
            series.0[1] = half_width.clone();
        }
        series
    }

    pub(super) fn coefficients(&self) -> &[Ball] {
        &self.0
    }

    fn len(&self) -> usize {
        self.0.len()
    }

    fn add(&self, other: &Series, bits: u64) -> Series {
        Series(self.0.iter().zip(&other.0).map(|(a, b)| a.add(b, bits)).collect())
    }

    fn scale(&self, factor: &Rational, bits: u64) -> Series {
        Series(self.0.iter().map(|a| a.multiply_rational(factor, bits)).collect())
    }

    /// `(fg)_n = Σ_j f_j g_{n−j}`.
    pub(super) fn multiply(&self, other: &Series, bits: u64) -> Series {
        Series(Ball::product_of_polynomials(&self.0, &other.0, self.len(), bits))
    }

    /// `y = f^r` from `f y' = r f' y`: `n f_0 y_n = Σ_{j=1}^n (rj − (n − j)) f_j y_{n−j}`.
    fn power_by_recurrence(&self, r: &Rational, first: Ball, bits: u64) -> Result<Series, Fault> {
        let mut y = vec![first];
        if self.len() > 1 {
            let inverse = self.0[0].reciprocal(bits)?;
            for n in 1..self.len() {
                let mut sum = Ball::zero();
                for j in 1..=n {
                    let factor = r * rational(j as i64) - rational((n - j) as i64);
                    let product = self.0[j].multiply(&y[n - j], bits);
                    sum = sum.add(&product.multiply_rational(&factor, bits), bits);
                }
                let part = Rational::new(1.into(), (n as i64).into());
                y.push(sum.multiply(&inverse, bits).multiply_rational(&part, bits));
            }
        }
        Ok(Series(y))
    }

    fn power(&self, exponent: &Rational, nonnegative: bool, bits: u64) -> Result<Series, Fault> {
        if exponent.is_integer() {
            let count = exponent.to_integer().abs().to_u64().expect("an exponent within limits");
            let power = self.whole_power(count, bits);
            if !exponent.is_negative() {
                return Ok(power);
            }
            let first = power.0[0].reciprocal(bits)?;
            return power.power_by_recurrence(&-Rational::one(), first, bits);
        }
        let base = &self.0[0];
        if base.contains_zero() {
            if !nonnegative || self.len() > 1 || exponent.is_negative() {
                return Err(Fault::RootOfZero);
            }
            return Ok(Series(vec![root(base, exponent, bits)?]));
        }
        if base.midpoint().is_negative() {
            return Err(Fault::NotReal);
        }
        let first = if exponent.denom() == &Integer::from(2) {
            let root = base.sqrt(bits).ok_or(Fault::RootOfZero)?;
            let count = exponent.numer().abs().to_u64().expect("an exponent within limits");
            Series(vec![root]).whole_power(count, bits).0.remove(0)
        } else {
            root(base, &exponent.abs(), bits)?
        };
        let first = if exponent.is_negative() { first.reciprocal(bits)? } else { first };
        self.power_by_recurrence(exponent, first, bits)
    }

    fn whole_power(&self, mut count: u64, bits: u64) -> Series {
        let mut power = Series::constant(one(), self.len());
        let mut square = self.clone();
        while count > 0 {
            if count & 1 == 1 {
                power = power.multiply(&square, bits);
            }
            count >>= 1;
            if count > 0 {
                square = square.multiply(&square, bits);
            }
        }
        power
    }

    /// `n y_n = Σ_{j=1}^n j z_j w_{n−j}`, of `y' = z' w`.
    fn integrated(&self, n: usize, w: &[Ball], bits: u64) -> Ball {
        let mut sum = Ball::zero();
        for j in 1..=n {
            let product = self.0[j].multiply(&w[n - j], bits);
            sum = sum.add(&product.multiply_rational(&rational(j as i64), bits), bits);
        }
        sum.multiply_rational(&Rational::new(1.into(), (n as i64).into()), bits)
    }

    /// `y' = z' y`.
    fn exp(&self, bits: u64) -> Result<Series, Fault> {
        let first = &self.0[0];
        let mut y = vec![if is_zero(first) { one() } else { first.exp(bits)? }];
        for n in 1..self.len() {
            y.push(self.integrated(n, &y, bits));
        }
        Ok(Series(y))
    }

    /// `c' = −z' s`, `s' = z' c`.
    fn cos_sin(&self, bits: u64) -> Result<(Series, Series), Fault> {
        let (cos, sin) = self.0[0].cos_sin(bits)?;
        let (mut cos, mut sin) = (vec![cos], vec![sin]);
        for n in 1..self.len() {
            let next = self.integrated(n, &cos, bits);
            cos.push(self.integrated(n, &sin, bits).negate());
            sin.push(next);
        }
        Ok((Series(cos), Series(sin)))
    }

    /// `y' = z' (1 − y²)`, from `tanh z = 1 − 2/(e^{2z} + 1)`.
    fn tanh(&self, bits: u64) -> Result<Series, Fault> {
        let first = &self.0[0];
        let value = if is_zero(first) {
            Ball::zero()
        } else {
            let power = first.multiply_rational(&rational(2), bits).exp(bits)?;
            let inverse = power.add(&one(), bits).reciprocal(bits)?;
            one().subtract(&inverse.multiply_rational(&rational(2), bits), bits)
        };
        let (mut y, mut w) = (vec![value], Vec::new());
        for n in 1..self.len() {
            // w = 1 − y², one coefficient behind.
            let square = dot(&y, &y, bits).negate();
            w.push(if n == 1 { one().add(&square, bits) } else { square });
            y.push(self.integrated(n, &w, bits));
        }
        Ok(Series(y))
    }

    /// `sin(z)/z`. Near zero as `Σ_m (−w)^m/(2m+1)!`, `w = z²`.
    ///
    /// With `W = Σ_n |w_n|`, no coefficient of `w^m` exceeds `W^m`. The terms from `m = M` on add up to
    /// at most `2 W^M/(2M+1)!` in each coefficient where `W ≤ (2M+2)(2M+3)/2`, since each is then at
    /// most half the one before.
    fn sinc(&self, bits: u64) -> Result<Series, Fault> {
        let near = self.0[0].magnitude() < Magnitude::from_u64(SINC_NEAR as u64);
        if !near {
            let (_, sin) = self.cos_sin(bits)?;
            let inverse = self.power(&-Rational::one(), false, bits)?;
            return Ok(sin.multiply(&inverse, bits));
        }
        let w = self.multiply(self, bits);
        let total = w.0.iter().fold(Magnitude::ZERO, |sum, c| sum.add(&c.magnitude()));
        let (mut count, mut tail) = (1_u64, total);
        let mut factorial = Integer::from(6);
        let term = |tail: &Magnitude, factorial: &Integer| {
            tail.multiply(&Magnitude::from_rational(&Rational::new(2.into(), factorial.clone())))
        };
        let small = Magnitude::power_of_two(-(bits as i64) - 8);
        while term(&tail, &factorial) > small
            || total > Magnitude::from_u64((count + 1) * (2 * count + 3))
        {
            count += 1;
            tail = tail.multiply(&total);
            factorial *= Integer::from(2 * count * (2 * count + 1));
        }
        let mut sum = Series::constant(Ball::zero(), self.len());
        // Horner: 1 − w/(2·3) (1 − w/(4·5) (1 − …)).
        for m in (0..count).rev() {
            if m + 1 < count {
                let divisor = ((2 * m + 2) * (2 * m + 3)) as i64;
                let part = Rational::new((-1).into(), divisor.into());
                sum = sum.multiply(&w, bits).scale(&part, bits);
            }
            sum.0[0] = sum.0[0].add(&one(), bits);
        }
        let left_out = term(&tail, &factorial);
        Ok(Series(sum.0.iter().map(|c| c.widened(&left_out)).collect()))
    }
}

fn one() -> Ball {
    Ball::from_integer(&1.into())
}

fn is_zero(ball: &Ball) -> bool {
    ball.is_exact() && ball.midpoint().is_zero()
}

fn dot(left: &[Ball], right: &[Ball], bits: u64) -> Ball {
    let products = left.iter().zip(right.iter().rev()).map(|(a, b)| a.multiply(b, bits));
    products.fold(Ball::zero(), |sum, product| sum.add(&product, bits))
}

/// `x^r` for all numbers of a ball that are not negative, `r > 0`; from 0 on where it contains zero.
fn root(x: &Ball, r: &Rational, bits: u64) -> Result<Ball, Fault> {
    let power = |end: Binary| match end.is_negative() || end.is_zero() {
        true => Ok(Ball::zero()),
        false => Ball::new(end, Magnitude::ZERO).power(r, bits),
    };
    let (low, high) = x.endpoints();
    let (low, high) = (power(low)?.endpoints().0, power(high)?.endpoints().1);
    Ok(Ball::between(&Rational::from(&low), &Rational::from(&high), bits))
}

impl Formula {
    /// An enclosure for all `k` of a ball.
    pub(super) fn enclose(&self, k: &Ball, bits: u64) -> Result<Ball, Fault> {
        Ok(self.series(&Series::wave_number(k, &Ball::zero(), 1), bits)?.0.remove(0))
    }

    /// The value and the derivative for all `k` of a ball.
    pub(super) fn with_slope(&self, k: &Ball, bits: u64) -> Result<[Ball; 2], Fault> {
        let both = self.series(&Series::wave_number(k, &one(), 2), bits)?;
        Ok([both.0[0].clone(), both.0[1].clone()])
    }

    /// Its series for that of `k`.
    pub(super) fn series(&self, k: &Series, bits: u64) -> Result<Series, Fault> {
        let count = k.len();
        Ok(match self.node() {
            Node::Number(value) => Series::constant(Ball::from_rational(value, bits), count),
            Node::Symbol(symbol) if *symbol == wave_number() => k.clone(),
            Node::Symbol(symbol) if *symbol == pi() => Series::constant(Ball::pi(bits), count),
            Node::Symbol(symbol) => return Err(Fault::MissingValue(symbol.clone())),
            Node::Power(base, exponent) => {
                let nonnegative = base.is_structurally_nonnegative();
                base.series(k, bits)?.power(exponent, nonnegative, bits)?
            }
            Node::Product(factors) => {
                // Only the first factor is a number.
                let (mut product, rest) = match factors[0].as_number() {
                    Some(value) => (factors[1].series(k, bits)?.scale(value, bits), &factors[2..]),
                    None => (factors[0].series(k, bits)?, &factors[1..]),
                };
                for factor in rest {
                    product = product.multiply(&factor.series(k, bits)?, bits);
                }
                product
            }
            Node::Sum(terms) => {
                let mut sum = terms[0].series(k, bits)?;
                for term in &terms[1..] {
                    sum = sum.add(&term.series(k, bits)?, bits);
                }
                sum
            }
            Node::Function(function, argument) => {
                let z = argument.series(k, bits)?;
                match function {
                    Function::Sine => z.cos_sin(bits)?.1,
                    Function::Cosine => z.cos_sin(bits)?.0,
                    Function::Exponential => z.exp(bits)?,
                    Function::HyperbolicTangent => z.tanh(bits)?,
                    Function::Sinc => z.sinc(bits)?,
                }
            }
        })
    }
}
