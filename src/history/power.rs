//! The force of a local contact, a power of its compression.

use crate::ball::{BallError, Magnitude, Number};
use num_traits::ToPrimitive as _;
use wavestep_polynomial::Rational;

/// The precision of bounds.
const BITS: u64 = 64;

/// `K` is at most this many times `F/α₁`, and at least this share of that. Each time a contact is pressed again the norm
/// of errors grows by up to the root of the ratio of the two, five bits.
const LARGEST_SPRING: i64 = 8;
const LEAST_SHARE: f64 = 1.0 / 1024.0;

/// A law `X = F (α/α₁)^m`.
#[derive(Clone, Debug)]
pub struct PowerLaw {
    pub force: Number,
    pub compression: Number,
    pub exponent: Rational,
}

impl PowerLaw {
    /// The same law by its force at another compression.
    ///
    /// # Errors
    /// [`BallError`] for numbers that may be zero.
    pub fn at(&self, compression: &Rational, bits: u64) -> Result<PowerLaw, BallError> {
        let compression = Number::Exact(compression.clone());
        Ok(PowerLaw { force: self.value(&compression, bits)?, compression, ..self.clone() })
    }

    /// The force at a positive compression.
    pub fn value(&self, compression: &Number, bits: u64) -> Result<Number, BallError> {
        let ratio = compression.multiply(&self.compression.reciprocal(bits)?, bits);
        let power = ratio.ball(bits).power(&self.exponent, bits)?;
        Ok(self.force.multiply(&Number::Enclosed(power), bits))
    }

    /// A bound of the force up to a compression.
    pub fn bound(&self, compression: &Magnitude) -> Result<Magnitude, BallError> {
        match compression.is_zero() {
            true => Ok(Magnitude::ZERO),
            false => Ok(self.value(&Number::Exact(Rational::from(compression)), BITS)?.magnitude()),
        }
    }

    /// A bound of `|X'|` between two positive compressions: it is a power, and largest at one end.
    pub fn stiffest(&self, [lower, upper]: [&Magnitude; 2]) -> Result<Magnitude, BallError> {
        let slope = |end: &Magnitude| self.slope(&Rational::from(end));
        Ok(slope(lower)?.magnitude().max(slope(upper)?.magnitude()))
    }

    /// `X'` at a positive compression.
    pub fn slope(&self, compression: &Rational) -> Result<Number, BallError> {
        let inverse = Number::Exact(compression.recip());
        let secant =
            self.value(&Number::Exact(compression.clone()), BITS)?.multiply(&inverse, BITS);
        Ok(secant.multiply(&Number::Exact(self.exponent.clone()), BITS))
    }

    /// The largest `K`.
    pub fn largest_spring(&self) -> Result<Number, BallError> {
        let secant = self.force.multiply(&self.compression.reciprocal(BITS)?, BITS);
        Ok(secant.multiply(&Number::integer(LARGEST_SPRING), BITS))
    }

    /// About which share of the largest `K` the slope at a compression is.
    pub fn share(&self, compression: &Number) -> f64 {
        let double = |number: &Number| number.ball(BITS).to_double().0;
        let exponent = self.exponent.to_f64().unwrap_or(1.0);
        let ratio = (double(compression) / double(&self.compression)).max(0.0);
        let share = exponent / LARGEST_SPRING as f64 * ratio.powf(exponent - 1.0);
        if share.is_nan() { 1.0 } else { share.clamp(LEAST_SHARE, 1.0) }
    }

    /// The compression at which the force is a `2^(−bits)` of `F`, or a little less; but none that is not told from zero
    /// with so many bits.
    pub fn light(&self, bits: u64) -> Magnitude {
        let least = Rational::new(4.into(), 3.into());
        let octaves = Rational::from_integer(bits.into()) / least.max(self.exponent.clone());
        let octaves = octaves.ceil().to_integer().to_i64().unwrap_or(i64::MAX >> 2);
        self.compression.magnitude().scale(-octaves)
    }
}

/// The coefficients of a power, one after another.
///
/// From `α X' = m α' X`: `k α_0 X_k = Σ_{i=1..k} (m i − (k − i)) α_i X_(k−i)`, that is `(m + 1) Σ i α_i X_(k−i) −
/// k Σ α_i X_(k−i)`.
pub struct PowerSeries {
    inverse: Number,
    /// `m + 1`
    exponent: Number,
    compressions: Vec<Number>,
    pub values: Vec<Number>,
    first: Number,
}

impl PowerSeries {
    pub fn new(law: &PowerLaw, start: &Number, bits: u64) -> Result<PowerSeries, BallError> {
        let exponent = Number::Exact(&law.exponent + Rational::from_integer(1.into()));
        Ok(PowerSeries {
            inverse: start.reciprocal(bits)?,
            exponent,
            compressions: Vec::new(),
            values: Vec::new(),
            first: law.value(start, bits)?,
        })
    }

    /// The next coefficient, for that of the compression.
    pub fn next(&mut self, compression: &Number, bits: u64) -> Number {
        let k = self.values.len();
        self.compressions.push(compression.clone());
        let value = match k {
            0 => self.first.clone(),
            _ => {
                let pairs = self.compressions[1..].iter().zip(self.values.iter().rev());
                let plain = pairs.clone().map(|(own, value)| (1, own, value));
                let raised = (1..).zip(pairs).map(|(i, (own, value))| (i, own, value));
                let falling =
                    Number::sum_of_products(plain, bits).multiply(&Number::integer(k as i64), bits);
                let rising = Number::sum_of_products(raised, bits).multiply(&self.exponent, bits);
                rising.subtract(&falling, bits).multiply(&self.inverse, bits).over(k as u64, bits)
            }
        };
        self.values.push(value.clone());
        value
    }
}
