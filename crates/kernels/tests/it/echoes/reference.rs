//! Waves that are sums of echoes in arbitrary precision. Time is in units of `1/b`.

use crate::fixed::support::Echoes;
use crate::reference::{
    add, big, divide, exponential, multiply, next, responses, subtract, to_double,
};
use astro_float_num::{BigFloat, RoundingMode};
use num_rational::BigRational;
use num_traits::ToPrimitive as _;
use wavestep_kernels::echoes::Family;

/// The responses `y_0 … y_{n+more}` of a period `D`, with `C = cD`, at the place of a time in its period
/// `n`, and `n`.
fn at(
    (family, scale): (Family, f64),
    period: [f64; 3],
    ratio: f64,
    time: f64,
    more: usize,
) -> (Vec<BigFloat>, usize, BigFloat) {
    let period = add(&big(period[0]), &add(&big(period[1]), &big(period[2])));
    let (mut since, mut n) = (subtract(&big(time), &period), 0);
    while !since.is_negative() || since.is_zero() {
        since = subtract(&since, &period);
        n += 1;
    }
    let x = divide(&add(&since, &period), &period);
    let numbers = [&period, &multiply(&big(scale), &period)];
    (responses(family, numbers, ratio, &x, n + 1 + more), n, multiply(&x, &period))
}

/// The rigid mass: `φ_k(x) = e^{−x} L_k(2x)`.
pub fn rigid_mass(period: [f64; 3], time: f64) -> BigFloat {
    let (mut all, n, _) = at((Family::Laguerre, 2.0), period, 1.0, time, 0);
    all.swap_remove(n)
}

/// `|value − exact|` of the rigid mass at a time, from integers: as exact, in an eighth of the time.
pub fn error_of_rigid_mass(period: f64, time: f64) -> impl Fn(f64) -> f64 {
    let [period, time] =
        [period, time].map(|double| BigRational::from_float(double).expect("a number"));
    let periods = time / &period;
    let n = periods.floor().to_integer().to_u32().expect("a period");
    let one = || BigRational::from_integer(1.into());
    let echoes = Echoes::new(period, one(), one(), one());
    let bits = echoes.bits(n + 1);
    let exact = echoes.solution(&periods.fract(), n + 1).swap_remove(n as usize);
    move |value| {
        let Some(value) = BigRational::from_float(value) else { return f64::INFINITY };
        let off = (value.numer() << bits) / value.denom() - &exact;
        // All but 192 bits of the fraction are cut off.
        (off >> (bits - 192)).to_f64().map_or(f64::INFINITY, f64::abs) * 2f64.powi(-192)
    }
}

/// The pulse: `φ_0 = 1 − e^{−x}`, `φ_k = e^{−x} (L_{k−1}(x) − L_k(x))`: together `1 + y_{n−1} − y_n`.
pub fn pulse(period: [f64; 3], time: f64) -> BigFloat {
    let (all, n, _) = at((Family::Laguerre, 1.0), period, 1.0, time, 0);
    let before = n.checked_sub(1).map_or(big(0.0), |before| all[before].clone());
    add(&big(1.0), &subtract(&before, &all[n]))
}

/// `φ_k = ρ^k e^{−x} (q_{k+1}(x)/2 − 3 q_{k−2}(x))` for a period of 1: the first part is `y_{n+1}/2ρ`
/// without its echo 0, the second `−3ρ² y_{n−2}`.
pub fn lagged(family: Family, time: f64, ratio: f64) -> BigFloat {
    let (all, n, _) = at((family, 1.0), [1.0, 0.0, 0.0], ratio, time, 1);
    let later = subtract(&all[n + 1], &exponential(&big(-time - 1.0)));
    let first = divide(&later, &big(2.0 * ratio));
    let before = n.checked_sub(2).map_or(big(0.0), |before| all[before].clone());
    subtract(&first, &multiply(&big(3.0 * ratio * ratio), &before))
}

/// `e^{−x} L_k(cx)` where `x` is the sum of two doubles.
pub fn echo(k: usize, [high, low]: [f64; 2], scale: f64) -> BigFloat {
    let x = add(&big(high), &big(low));
    let argument = multiply(&x, &big(scale));
    let mut state = (exponential(&x.neg()), big(0.0));
    (0..k).for_each(|j| next(Family::Laguerre, &argument, j, &mut state));
    state.0
}

/// `|e^{−x}(a − b)|` for `L_k(2x)` computed in two ways: by its recurrence, and from its exact coefficients
/// `C(k,j) (−1)^j / j!` with 4000 bits to cancel in.
pub fn disagreement(k: usize, x: f64) -> f64 {
    let (bits, round) = (4000, RoundingMode::ToEven);
    let whole = |value: usize| BigFloat::from_f64(value as f64, bits);
    let argument = BigFloat::from_f64(2.0 * x, bits);
    let (mut term, mut sum) = (whole(1), whole(1));
    for j in 0..k {
        term = term.mul(&whole(k - j), bits, round).mul(&argument, bits, round);
        term = term.div(&whole((j + 1) * (j + 1)), bits, round).neg();
        sum = sum.add(&term, bits, round);
    }
    let exact = multiply(&sum, &exponential(&big(-x)));
    to_double(&subtract(&echo(k, [x, 0.0], 2.0), &exact)).abs()
}
