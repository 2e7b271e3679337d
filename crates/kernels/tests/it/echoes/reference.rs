//! Waves in arbitrary precision, and numbers that look random.

use astro_float::{BigFloat, Consts, RoundingMode};

/// Bits of the reference. The recurrences lose about as many bits as the index has.
const BITS: usize = 320;
const ROUND: RoundingMode = RoundingMode::ToEven;

fn big(value: f64) -> BigFloat {
    BigFloat::from_f64(value, BITS)
}

fn add(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.add(b, BITS, ROUND)
}

fn subtract(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.sub(b, BITS, ROUND)
}

fn multiply(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.mul(b, BITS, ROUND)
}

fn divide(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.div(b, BITS, ROUND)
}

/// The double next to a number, by its decimal digits.
pub fn rounded(value: &BigFloat) -> f64 {
    let text = format!("{value}");
    text.parse().unwrap_or_else(|_| panic!("not a number: {text}"))
}

pub struct Reference {
    constants: Consts,
}

impl Reference {
    pub fn new() -> Reference {
        Reference { constants: Consts::new().expect("constants") }
    }

    pub fn exponential(&mut self, x: &BigFloat) -> BigFloat {
        x.exp(BITS, ROUND, &mut self.constants)
    }

    /// `value − exact`, rounded.
    pub fn error(&self, exact: &BigFloat, value: f64) -> f64 {
        if !value.is_finite() {
            return f64::INFINITY;
        }
        rounded(&subtract(&big(value), exact))
    }

    /// `q_0(X) … q_k(X)`: Laguerre polynomials by three terms, or divided powers.
    pub fn polynomials(argument: &BigFloat, k: usize, powers: bool) -> Vec<BigFloat> {
        let mut all = vec![big(1.0)];
        for j in 0..k {
            let (now, next) = (&all[j], big((j + 1) as f64));
            let product = match powers {
                true => multiply(argument, now),
                false => {
                    let factor = subtract(&big((2 * j + 1) as f64), argument);
                    let main = multiply(&factor, now);
                    match j {
                        0 => main,
                        _ => subtract(&main, &multiply(&big(j as f64), &all[j - 1])),
                    }
                }
            };
            all.push(divide(&product, &next));
        }
        all
    }

    /// `L_k(X)` from its exact coefficients `C(k,j) (−1)^j / j!`, with 4000 bits to cancel in.
    fn by_coefficients(argument: &BigFloat, k: usize) -> BigFloat {
        let bits = 4000;
        let whole = |value: usize| BigFloat::from_f64(value as f64, bits);
        let mut term = whole(1);
        let mut sum = whole(1);
        for j in 0..k {
            term = term.mul(&whole(k - j), bits, ROUND).mul(argument, bits, ROUND);
            term = term.div(&whole((j + 1) * (j + 1)), bits, ROUND).neg();
            sum = sum.add(&term, bits, ROUND);
        }
        sum
    }

    /// `|e^{−x}(a − b)|` for `L_k(2x)` computed in two ways.
    pub fn disagreement(&mut self, k: usize, x: f64) -> f64 {
        let argument = big(2.0 * x);
        let one = Reference::polynomials(&argument, k, false).pop().expect("not empty");
        let other = Reference::by_coefficients(&argument, k);
        let decay = self.exponential(&big(-x));
        rounded(&multiply(&subtract(&one, &other), &decay)).abs()
    }

    /// `e^{−x} L_k(cx)`, rounded.
    pub fn echo(&mut self, k: usize, x: f64, scale: f64) -> f64 {
        rounded(&self.exact_echo(k, [x, 0.0], scale))
    }

    /// `e^{−x} L_k(cx)` where `x` is the sum of two doubles.
    pub fn exact_echo(&mut self, k: usize, [high, low]: [f64; 2], scale: f64) -> BigFloat {
        let x = add(&big(high), &big(low));
        let argument = multiply(&x, &big(scale));
        let decay = self.exponential(&x.neg());
        multiply(&decay, &Reference::polynomials(&argument, k, false)[k])
    }

    /// `Σ_k φ_k(T − kD)` over the echoes that have arrived, at most `limit` of them; `echo` is given
    /// `k`, `x` and `e^{−x}`, which comes from two exponentials and products.
    pub fn sum(
        &mut self,
        period: [f64; 3],
        time: f64,
        limit: usize,
        echo: impl Fn(usize, &BigFloat, &BigFloat) -> BigFloat,
    ) -> BigFloat {
        let period = add(&big(period[0]), &add(&big(period[1]), &big(period[2])));
        let mut since = big(time);
        let mut decay = self.exponential(&since.neg());
        let growth = self.exponential(&period);
        let mut sum = big(0.0);
        for k in 0..limit {
            if since.is_negative() && !since.is_zero() {
                break;
            }
            sum = add(&sum, &echo(k, &since, &decay));
            since = subtract(&since, &period);
            decay = multiply(&decay, &growth);
        }
        sum
    }

    /// The rigid mass: `φ_k(x) = e^{−x} L_k(2x)`.
    pub fn rigid_mass(&mut self, period: [f64; 3], time: f64, limit: usize) -> BigFloat {
        self.sum(period, time, limit, |k, x, decay| {
            let argument = multiply(x, &big(2.0));
            multiply(decay, &Reference::polynomials(&argument, k, false)[k])
        })
    }

    /// The pulse: `φ_0 = 1 − e^{−x}`, `φ_k = e^{−x} (L_{k−1}(x) − L_k(x))`.
    pub fn pulse(&mut self, period: [f64; 3], time: f64, limit: usize) -> BigFloat {
        self.sum(period, time, limit, |k, x, decay| {
            let all = Reference::polynomials(x, k, false);
            match k {
                0 => subtract(&big(1.0), decay),
                _ => multiply(decay, &subtract(&all[k - 1], &all[k])),
            }
        })
    }

    /// `φ_k = ρ^k e^{−x} (q_{k+1}(x)/2 − 3 q_{k−2}(x))`.
    pub fn lagged(&mut self, period: [f64; 3], time: f64, ratio: f64, powers: bool) -> BigFloat {
        self.sum(period, time, usize::MAX, |k, x, decay| {
            let all = Reference::polynomials(x, k + 1, powers);
            let mut value = multiply(&big(0.5), &all[k + 1]);
            if k >= 2 {
                value = subtract(&value, &multiply(&big(3.0), &all[k - 2]));
            }
            (0..k).fold(multiply(&value, decay), |value, _| multiply(&value, &big(ratio)))
        })
    }
}

/// A linear congruential sequence: the same numbers in every run.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// A number from 0 to 1, with 53 bits.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        (mixed >> 11) as f64 * 2f64.powi(-53)
    }
}
