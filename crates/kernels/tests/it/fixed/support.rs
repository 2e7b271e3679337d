//! The exact solution of a delay equation, in integers: parameters are short rationals, and thousands of
//! bits cost no more than their length.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use wavestep_kernels::fixed::{DelayEquation, FRACTION_BITS, FixedValue, March, MarchOptions};

/// A fraction.
pub fn ratio(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(numerator.into(), denominator.into())
}

/// An integer as a fraction.
pub fn integer(value: i64) -> BigRational {
    BigRational::from(BigInt::from(value))
}

/// A delay equation, solved by its echoes: `Y(T) = Σ_k ρ^k e^(−b x_k) L_k((a + b) x_k)` over
/// `x_k = T − kD ≥ 0`.
pub struct Echoes {
    pub period: BigRational,
    pub rate: BigRational,
    pub zero: BigRational,
    pub reflection: BigRational,
}

impl Echoes {
    /// The equation with these parameters.
    pub fn new(
        period: BigRational,
        rate: BigRational,
        zero: BigRational,
        reflection: BigRational,
    ) -> Self {
        Self { period, rate, zero, reflection }
    }

    /// The equation as the library takes it.
    pub fn equation(&self) -> DelayEquation {
        DelayEquation::new(&self.period, &self.rate, &self.zero, &self.reflection).unwrap()
    }

    /// The march of the equation.
    pub fn march(&self, periods: u32, options: &MarchOptions) -> March {
        March::new(&self.equation(), periods, options).unwrap()
    }

    /// Fraction bits of [`solution`](Self::solution). The recurrence of the Laguerre polynomials
    /// enlarges an error by about `e^|X|` at most, and begins with `e^(−bx)`; 256 bits are left.
    pub fn bits(&self, periods: u32) -> u64 {
        let slope = &self.rate + (&self.rate + &self.zero).abs();
        let longest = slope * &self.period * integer(i64::from(periods) + 1);
        256 + (1.5 * longest.to_f64().unwrap()) as u64
    }

    /// `Y((n + part) D)` for n below a count of periods, in units of `2^−bits`; the sum is over
    /// the echoes to the n-th, with `(k + 1)(L_{k+1} − L_k) = k (L_k − L_{k−1}) − X L_k`.
    pub fn solution(&self, part: &BigRational, periods: u32) -> Vec<BigInt> {
        let bits = self.bits(periods);
        let faded = |time: &BigRational| exponential(&(time * &self.rate), bits);
        let (mut fading, step) = (faded(&(part * &self.period)), faded(&self.period));
        let mut sums = vec![BigInt::zero(); periods as usize];
        for late in 0..periods {
            // The echoes k that are x = (part + late) D old, in period n = k + late.
            let place = (&self.rate + &self.zero) * &self.period * (part + integer(late.into()));
            // ρ^k times the k-th echo, and k times what it has more than ρ times the one before.
            let (mut echo, mut rise) = (fading.clone(), BigInt::zero());
            for k in 0..periods - late {
                sums[(k + late) as usize] += &echo;
                rise -= times(&echo, &place);
                if !self.reflection.is_one() {
                    (rise, echo) = (times(&rise, &self.reflection), times(&echo, &self.reflection));
                }
                echo += &rise / (k + 1);
            }
            fading = (fading * &step) >> bits;
        }
        sums
    }

    /// The error of a value, in units of `2^−112`.
    pub fn error(&self, value: &FixedValue, exact: &BigInt, bits: u64) -> f64 {
        let unit = bits - u64::from(FRACTION_BITS);
        let difference = ((BigInt::from(value.midpoint) << unit) - exact).abs();
        // All but 64 bits of the fraction are cut off.
        ((difference << 64_u32) >> unit).to_f64().unwrap() / 2f64.powi(64)
    }
}

/// `⌊value·by⌋`.
fn times(value: &BigInt, by: &BigRational) -> BigInt {
    (value * by.numer()).div_floor(by.denom())
}

/// `e^(−x)` for a rational `x ≥ 0`, in units of `2^−bits`: Taylor's series after halvings.
fn exponential(x: &BigRational, bits: u64) -> BigInt {
    let halvings = x.ceil().to_integer().bits() + 16;
    let guarded = bits + 2 * halvings + 32;
    let argument = ((x.numer() << guarded).div_floor(x.denom())) >> halvings;
    let (mut sum, mut term) = (BigInt::one() << guarded, BigInt::one() << guarded);
    for m in 1u32.. {
        term = ((term * &argument) >> guarded) / m;
        if term.is_zero() {
            break;
        }
        if m % 2 == 1 { sum -= &term } else { sum += &term }
    }
    for _ in 0..halvings {
        sum = (&sum * &sum) >> guarded;
    }
    sum >> (guarded - bits)
}
