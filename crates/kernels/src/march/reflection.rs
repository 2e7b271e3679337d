//! The numbers of a reflected wave: the rate of decay and the zero of the reflection, in units of
//! the period, and the ratio by which it multiplies. A number that was rounded carries its radius.

/// A real number known to lie within `radius` of `value`. Pure numbers, without unit.
///
/// # Invariants
/// `value` and `radius` are finite and `radius ≥ 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    value: f64,
    radius: f64,
}

impl Parameter {
    /// The number `value` itself. O(1).
    pub fn exact(value: f64) -> Result<Parameter, ReflectionError> {
        Parameter::within(value, 0.0)
    }

    /// Some number `x` with `|x − value| ≤ radius`. O(1).
    pub fn within(value: f64, radius: f64) -> Result<Parameter, ReflectionError> {
        if !value.is_finite() || !radius.is_finite() {
            return Err(ReflectionError::NotFinite);
        }
        if radius < 0.0 {
            return Err(ReflectionError::NegativeRadius { radius });
        }
        Ok(Parameter { value, radius })
    }

    /// The middle of the interval. O(1).
    pub fn value(self) -> f64 {
        self.value
    }

    /// How far the number may be from the middle. O(1).
    pub fn radius(self) -> f64 {
        self.radius
    }

    /// An upper bound of the number's absolute value, `|value| + radius` rounded up. O(1).
    pub fn magnitude(self) -> f64 {
        if self.radius == 0.0 {
            self.value.abs()
        } else {
            (self.value.abs() + self.radius).next_up()
        }
    }

    /// A lower bound of the number, `value − radius` rounded down. O(1).
    pub fn lower(self) -> f64 {
        if self.radius == 0.0 { self.value } else { (self.value - self.radius).next_down() }
    }

    /// Whether the number is 1 or −1 and known exactly, so that a product with it has no rounding.
    pub(crate) fn is_exact_unit(self) -> bool {
        self.radius == 0.0 && self.value.abs() == 1.0
    }
}

/// A wave that returns after each period `D`, reflected by `ρ (p − a)/(p + b)`.
///
/// With `T` the time in periods, `q` the shift by one period, `B = bD` and `A = aD`,
/// `(d/dT + B) Y = ρ q (d/dT − A) Y + δ(T)`: the wave's answer to a unit impulse. On the n-th
/// period, with the local time `x` in `[0, 1]`,
///
/// `y_n' + B y_n = ρ (y_{n−1}' − A y_{n−1})`, `y_{−1} = 0`,
///
/// and the jump of `Y` at `T = n` is `ρⁿ`. A rigid mass on a bar with a fixed end has `a = b`,
/// `ρ = 1`.
///
/// # Invariants
/// Every number within the radius of the rate is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflection {
    rate: Parameter,
    zero: Parameter,
    ratio: Parameter,
}

impl Reflection {
    /// The reflection with `B = rate`, `A = zero`, `ρ = ratio`. O(1).
    pub fn new(
        rate: Parameter,
        zero: Parameter,
        ratio: Parameter,
    ) -> Result<Reflection, ReflectionError> {
        if rate.lower() <= 0.0 {
            return Err(ReflectionError::RateNotPositive { rate: rate.lower() });
        }
        Ok(Reflection { rate, zero, ratio })
    }

    /// The reflection with the given numbers, all of them exact. O(1).
    pub fn exact(rate: f64, zero: f64, ratio: f64) -> Result<Reflection, ReflectionError> {
        let exact = Parameter::exact;
        Reflection::new(exact(rate)?, exact(zero)?, exact(ratio)?)
    }

    /// `B = bD`, the decay during a period. O(1).
    pub fn rate(&self) -> Parameter {
        self.rate
    }

    /// `A = aD`, the zero of the reflection. O(1).
    pub fn zero(&self) -> Parameter {
        self.zero
    }

    /// `ρ`, the ratio of a returning jump to the jump that left. O(1).
    pub fn ratio(&self) -> Parameter {
        self.ratio
    }

    /// Whether no reflection within the radii gives energy to the wave: `|ρ| ≤ 1` and `|ρA| ≤ B`,
    /// the bounds of `|ρ (iω − A)/(iω + B)|` as `ω → ∞` and at `ω = 0`. It errs towards `false`.
    /// O(1).
    pub fn is_passive(&self) -> bool {
        let ratio = self.ratio.magnitude();
        let product = ratio * self.zero.magnitude();
        // The product with 1 is exact; any other is taken one double higher.
        let product = if ratio == 1.0 { product } else { product.next_up() };
        ratio <= 1.0 && product <= self.rate.lower()
    }
}

/// Why numbers do not describe a reflection.
#[expect(missing_docs, reason = "the messages say it")]
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReflectionError {
    #[error("a value or its radius is not finite: give a finite number")]
    NotFinite,
    #[error("the radius {radius} is below zero: give its absolute value")]
    NegativeRadius { radius: f64 },
    #[error("the rate of decay may be as small as {rate}: it has to be positive")]
    RateNotPositive { rate: f64 },
}
