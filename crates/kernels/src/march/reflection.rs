//! The numbers of a reflected wave: the rate of decay and the zero of the reflection, in units of
//! the period, and the ratio by which it multiplies. A number that was rounded carries its radius.

use super::error::MarchError;

/// A real number known to lie within `radius` of `value`. Pure numbers, without unit.
///
/// # Invariants
/// `value` and `radius` are finite and `radius ≥ 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    pub(crate) value: f64,
    pub(crate) radius: f64,
}

impl Parameter {
    /// The number `value` itself.
    pub fn exact(value: f64) -> Result<Parameter, MarchError> {
        Parameter::within(value, 0.0)
    }

    /// Some number `x` with `|x − value| ≤ radius`.
    pub fn within(value: f64, radius: f64) -> Result<Parameter, MarchError> {
        if !value.is_finite() || !radius.is_finite() {
            return Err(MarchError::ParameterNotFinite);
        }
        if radius < 0.0 {
            return Err(MarchError::NegativeRadius { radius });
        }
        Ok(Parameter { value, radius })
    }

    /// An upper bound of the number's absolute value, `|value| + radius` rounded up.
    pub fn magnitude(self) -> f64 {
        if self.radius == 0.0 {
            self.value.abs()
        } else {
            (self.value.abs() + self.radius).next_up()
        }
    }

    /// A lower bound of the number, `value − radius` rounded down.
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
    /// `B = bD`, the decay during a period.
    pub(crate) rate: Parameter,
    /// `A = aD`, the zero of the reflection.
    pub(crate) zero: Parameter,
    /// `ρ`, the ratio of a returning jump to the jump that left.
    pub(crate) ratio: Parameter,
}

impl Reflection {
    /// The reflection with `B = rate`, `A = zero`, `ρ = ratio`.
    pub fn new(
        rate: Parameter,
        zero: Parameter,
        ratio: Parameter,
    ) -> Result<Reflection, MarchError> {
        if rate.lower() <= 0.0 {
            return Err(MarchError::RateNotPositive { rate: rate.lower() });
        }
        Ok(Reflection { rate, zero, ratio })
    }

    /// The reflection with the given numbers, all of them exact.
    pub fn exact(rate: f64, zero: f64, ratio: f64) -> Result<Reflection, MarchError> {
        let exact = Parameter::exact;
        Reflection::new(exact(rate)?, exact(zero)?, exact(ratio)?)
    }

    /// Whether no reflection within the radii gives energy to the wave: `|ρ| ≤ 1` and `|ρA| ≤ B`,
    /// the bounds of `|ρ (iω − A)/(iω + B)|` as `ω → ∞` and at `ω = 0`. It errs towards `false`.
    ///
    pub fn is_passive(&self) -> bool {
        let ratio = self.ratio.magnitude();
        let product = ratio * self.zero.magnitude();
        // The product with 1 is exact; any other is taken one double higher.
        let product = if ratio == 1.0 { product } else { product.next_up() };
        ratio <= 1.0 && product <= self.rate.lower()
    }
}

#[cfg(test)]
mod tests {
    use super::Parameter;

    #[test]
    fn ones_alone_that_are_known_exactly_are_units() {
        let is_unit = |value, radius| Parameter::within(value, radius).unwrap().is_exact_unit();
        assert!(is_unit(1.0, 0.0) && is_unit(-1.0, 0.0));
        assert!(!is_unit(1.0, 1e-20) && !is_unit(0.5, 0.0));
    }
}
