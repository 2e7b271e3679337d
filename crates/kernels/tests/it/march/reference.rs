//! The wave in 384-bit arithmetic, from the sum of echoes: no march, no Chebyshev series.

use astro_float::{BigFloat, Consts, RoundingMode, Sign};

const BITS: usize = 384;
const NEAR: RoundingMode = RoundingMode::None;

/// The true wave at one local time on every period.
pub struct Reference(Vec<BigFloat>);

fn big(x: f64) -> BigFloat {
    BigFloat::from_f64(x, BITS)
}

fn add(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.add(b, BITS, NEAR)
}

fn mul(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.mul(b, BITS, NEAR)
}

impl Reference {
    /// `y_n(x) = Σ_k ρ^k e^{−B X} L_k((A + B) X)`, `X = n − k + x`, for `n < periods`. O(periods²).
    pub fn new(rate: f64, zero: f64, ratio: f64, x: f64, periods: usize) -> Reference {
        let mut constants = Consts::new().expect("a table of constants");
        let one = big(1.0);
        let inverse: Vec<BigFloat> =
            (0..=periods).map(|k| one.div(&big(k.max(1) as f64), BITS, NEAR)).collect();
        let slope = add(&big(rate), &big(zero));
        let mut waves = vec![big(0.0); periods];
        for shift in 0..periods {
            let time = add(&big(shift as f64), &big(x));
            let exponent = mul(&big(-rate), &time);
            let argument = mul(&slope, &time);
            // L_{k+1} = L_k + d_{k+1}, d_{k+1} = (k d_k − X L_k)/(k + 1), all times ρ^k e^{−BX}.
            let mut value = exponent.exp(BITS, NEAR, &mut constants);
            let mut difference = big(0.0);
            let mut power = big(1.0);
            for k in 0..periods - shift {
                waves[shift + k] = add(&waves[shift + k], &mul(&power, &value));
                let scaled = mul(&big(k as f64), &difference);
                difference = mul(&scaled.sub(&mul(&argument, &value), BITS, NEAR), &inverse[k + 1]);
                value = add(&value, &difference);
                power = mul(&power, &big(ratio));
            }
        }
        Reference(waves)
    }

    /// `|found − y_n(x)|`, to a few digits.
    pub fn error(&self, period: usize, found: f64) -> f64 {
        to_double(&self.0[period].sub(&big(found), BITS, NEAR)).abs()
    }
}

/// The leading 53 bits.
fn to_double(x: &BigFloat) -> f64 {
    let Some((words, _, sign, exponent, _)) = x.as_raw_parts() else { return f64::NAN };
    let top = words.last().copied().unwrap_or(0) as f64 * 2f64.powi(-64);
    let size = top * 2f64.powi(exponent.max(-1000));
    if sign == Sign::Neg { -size } else { size }
}
