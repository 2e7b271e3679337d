//! Waves in 384 bits, from the sum of their echoes: no march, no Chebyshev series, and no code or author
//! shared with the numbers under test.

use astro_float_num::{BigFloat, Consts, RoundingMode, Sign};
use std::cell::RefCell;
use std::iter::successors;
use std::sync::LazyLock;
use wavestep_kernels::echoes::Family;

const BITS: usize = 384;
const NEAR: RoundingMode = RoundingMode::ToEven;

pub fn big(value: f64) -> BigFloat {
    BigFloat::from_f64(value, BITS)
}

pub fn add(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.add(b, BITS, NEAR)
}

pub fn subtract(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.sub(b, BITS, NEAR)
}

pub fn multiply(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.mul(b, BITS, NEAR)
}

pub fn divide(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.div(b, BITS, NEAR)
}

pub fn exponential(x: &BigFloat) -> BigFloat {
    thread_local! {
        static CONSTANTS: RefCell<Consts> = RefCell::new(Consts::new().expect("constants"));
    }
    CONSTANTS.with_borrow_mut(|constants| x.exp(BITS, NEAR, constants))
}

/// The leading 53 bits.
pub fn to_double(x: &BigFloat) -> f64 {
    let Some((words, _, sign, exponent, _)) = x.as_raw_parts() else { return f64::NAN };
    let top = words.last().copied().unwrap_or(0) as f64 * 2f64.powi(-64);
    let size = top * 2f64.powi(exponent.max(-1000));
    if sign == Sign::Neg { -size } else { size }
}

/// `|value − exact|`, to a few digits.
pub fn error(exact: &BigFloat, value: f64) -> f64 {
    if value.is_finite() { to_double(&subtract(&big(value), exact)).abs() } else { f64::INFINITY }
}

/// `1/j` for `0 < j ≤ 2001`.
fn inverse(j: usize) -> &'static BigFloat {
    static INVERSES: LazyLock<Vec<BigFloat>> =
        LazyLock::new(|| (0..2002).map(|j| divide(&big(1.0), &big(f64::from(j)))).collect());
    &INVERSES[j]
}

/// `q_{j+1}` from `q_j` and `e_j = j (q_j − q_{j−1})`; only Laguerre polynomials need these.
pub fn next(family: Family, argument: &BigFloat, j: usize, (q, e): &mut (BigFloat, BigFloat)) {
    match family {
        Family::Laguerre => {
            *e = subtract(e, &multiply(argument, q));
            *q = add(q, &multiply(e, inverse(j + 1)));
        }
        Family::Powers => *q = multiply(&multiply(q, argument), inverse(j + 1)),
    }
}

/// `y_n = Σ_{k≤n} ρ^k e^{−B X} q_k(C X)`, `X = n − k + x`, for `n < periods`. O(periods²).
pub fn responses(
    family: Family,
    [rate, scale]: [&BigFloat; 2],
    ratio: f64,
    x: &BigFloat,
    periods: usize,
) -> Vec<BigFloat> {
    let mut responses = vec![big(0.0); periods];
    let power = |power: &BigFloat| Some(multiply(power, &big(ratio)));
    let powers: Vec<BigFloat> = successors(Some(big(1.0)), power).take(periods).collect();
    for shift in 0..periods {
        let time = add(&big(shift as f64), x);
        let argument = multiply(scale, &time);
        // All times e^{−BX}.
        let mut state = (exponential(&multiply(rate, &time).neg()), big(0.0));
        for k in 0..periods - shift {
            let response = &mut responses[shift + k];
            *response = match ratio == 1.0 {
                true => add(response, &state.0),
                false => add(response, &multiply(&powers[k], &state.0)),
            };
            next(family, &argument, k, &mut state);
        }
    }
    responses
}
