//! Certified values against values found in other ways: exact period forms with an enclosure of the
//! exponential that is made here, Laguerre polynomials in integers, and a march in long fixed-point
//! numbers.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use proptest::prelude::*;
use wavestep::ball::Decimal;
use wavestep::expression::{ExponentialSum, Expression};
use wavestep::language::{Source, parse_number, read_recurrence};
use wavestep::limits::{MAX_ORDER, MAX_ORDER_OF_SEQUENCE, MAX_PIECES};
use wavestep::recurrence::Recurrence;
use wavestep::signal::{ClosedSignal, EvaluateError, Limit, Value};
use wavestep::solution::{PeriodByPeriod, Solution};

const BITS: u64 = 1 << 16;

/// Forcing, exponential coefficients, derivatives and delays in one scene.
const MIXED: &str = r#"
recurrence "Forced, damped, observed in every way"
symbol mu > 0
period 2*mu, local s, time t
wave f, g
equation g[n] = -exp(-mu)*f[n-1]
equation f[n]' + g[n]' = -(f[n] - g[n]) + t*exp(-t/2)
continuous f[n] + g[n] starts at 1
observe forced = exp(-mu)*f[n] + t^2*exp(-2*t) - 3
observe slope = f[n]'
observe delayed = 2*f(t - mu/3) - g[n-1]
"#;

/// Two poles, which come together for `b = a`.
const POLES: &str = r#"
recurrence "Two poles"
symbol a > 0, b > 0
nonzero a - b
period 1, local s, time t
wave f, g
equation f[n]' + a*f[n] = g[n-1]
equation g[n]' + b*g[n] = f[n-1] + f[n]
continuous f[n] starts at 1
continuous g[n] starts at 0
"#;

fn ratio(text: &str) -> BigRational {
    parse_number(text).unwrap()
}

fn whole(value: usize) -> BigRational {
    BigRational::from_integer(value.into())
}

/// A shipped scene by its name, or a text, with values.
fn recurrence(scene: &str, values: &[(&str, &BigRational)]) -> Recurrence {
    let text = wavestep::scenes::find(scene).map_or(scene, |scene| scene.text);
    let source = Source::new("scene", text).unwrap();
    let values: BTreeMap<String, BigRational> =
        values.iter().map(|(name, value)| ((*name).to_owned(), (*value).clone())).collect();
    read_recurrence(&source, &values).unwrap_or_else(|error| panic!("{error}"))
}

fn value(
    solution: &Solution,
    quantity: &str,
    at: &BigRational,
    side: Limit,
    digits: usize,
) -> Value {
    told(solution, quantity, at, side, digits, BITS).unwrap()
}

fn told(
    solution: &Solution,
    quantity: &str,
    at: &BigRational,
    side: Limit,
    digits: usize,
    bits: u64,
) -> Result<Value, EvaluateError> {
    let observation = solution.recurrence().observation(quantity).expect(quantity);
    let signal = ClosedSignal::of_recurrence(solution, &observation, [at, at])?;
    wavestep::signal::digits(&signal, at, side, digits, bits)
}

fn decimal(value: &Value, digits: usize) -> Decimal {
    value.decimal(digits).0
}

// ---- Another way to the values ------------------------------------------------------------------

/// `low ≤ x ≤ high`.
#[derive(Clone, Debug)]
struct Interval {
    low: BigRational,
    high: BigRational,
}

impl Interval {
    /// The decimal that every number of the interval rounds to.
    fn rounded(&self, digits: usize) -> Decimal {
        let low = Decimal::from_rational(&self.low, digits).0;
        assert_eq!(low, Decimal::from_rational(&self.high, digits).0, "the interval is too wide");
        low
    }
}

/// Encloses `e^x`: Taylor's series of `e^|x|` in integers of unit `2^−bits`, each term rounded down
/// and up. Once a term is smaller than its index is large, the rest of the series is at most the
/// last term, by comparison with `Σ 2^−i`.
fn exponential(x: &BigRational, bits: u32) -> Interval {
    let unit = BigInt::one() << bits;
    let size = x.abs();
    let (mut low, mut high) = (unit.clone(), unit.clone());
    let (mut low_sum, mut high_sum) = (unit.clone(), unit.clone());
    let mut index = BigInt::zero();
    while !(high <= BigInt::one() && BigRational::from_integer(index.clone()) > &size * whole(2)) {
        index += 1;
        let divisor = size.denom() * &index;
        low = (low * size.numer()).div_floor(&divisor);
        high = (high * size.numer()).div_ceil(&divisor);
        low_sum += &low;
        high_sum += &high;
    }
    high_sum += high;
    let (low, high) = (BigRational::new(low_sum, unit.clone()), BigRational::new(high_sum, unit));
    match x.is_negative() {
        true => Interval { low: high.recip(), high: low.recip() },
        false => Interval { low, high },
    }
}

/// Encloses `Σ r_j e^{λ_j}`, with each product rounded outwards to a multiple of `2^−bits`.
fn enclose(sum: &ExponentialSum, bits: u32) -> Interval {
    let (mut low_sum, mut high_sum) = (BigInt::zero(), BigInt::zero());
    for (exponent, factor) in sum {
        let Interval { low, high } = match exponent.is_zero() {
            true => Interval { low: whole(1), high: whole(1) },
            false => exponential(exponent, bits),
        };
        let (low, high) = if factor.is_negative() { (high, low) } else { (low, high) };
        let above = |value: &BigRational| (value.numer() * factor.numer()) << bits;
        let below = |value: &BigRational| value.denom() * factor.denom();
        low_sum += above(&low).div_floor(&below(&low));
        high_sum += above(&high).div_ceil(&below(&high));
    }
    let unit = BigInt::one() << bits;
    Interval {
        low: BigRational::new(low_sum, unit.clone()),
        high: BigRational::new(high_sum, unit),
    }
}

/// The pieces of every wave, by the derivation period by period.
struct Pieces<'a> {
    recurrence: &'a Recurrence,
    period: BigRational,
    waves: Vec<Vec<Expression>>,
}

impl<'a> Pieces<'a> {
    fn new(recurrence: &'a Recurrence, through: usize) -> Pieces<'a> {
        let mut solver = PeriodByPeriod::new(recurrence);
        for _ in 0..=through {
            solver.advance().unwrap();
        }
        let period = recurrence.statement().period.as_constant().unwrap();
        let waves = solver.pieces().to_vec();
        Pieces { recurrence, period, waves }
    }

    /// A wave at a time, or its derivative, as an exact sum.
    fn at(&self, wave: &str, slope: bool, time: &BigRational, side: Limit) -> ExponentialSum {
        let wave = self.recurrence.wave(wave).unwrap();
        let periods = time / &self.period;
        let n = match side {
            Limit::Right => periods.floor().to_integer(),
            Limit::Left => periods.ceil().to_integer() - 1,
        };
        let Some(n) = n.to_usize() else { return ExponentialSum::new() };
        let local = time - &self.period * whole(n);
        let symbol = &self.recurrence.statement().local;
        let mut piece = self.waves[wave][n].clone();
        if slope {
            piece = piece.derivative(symbol);
        }
        piece.evaluate(&|x| (x == symbol).then(|| local.clone())).unwrap()
    }
}

/// `Σ_i factor_i · e^{shift_i} · sum_i`.
fn combined(parts: &[(&str, &str, ExponentialSum)]) -> ExponentialSum {
    let mut total = ExponentialSum::new();
    for (factor, shift, sum) in parts {
        for (exponent, value) in sum {
            *total.entry(exponent + ratio(shift)).or_default() += value * ratio(factor);
        }
    }
    total.retain(|_, value| !value.is_zero());
    total
}

fn is_rational(sum: &ExponentialSum) -> bool {
    sum.keys().all(Zero::is_zero)
}

/// The value is what the exact sum rounds to, and exact if and only if the sum is rational.
fn assert_is(found: &Value, expected: &ExponentialSum, digits: usize) {
    match found {
        Value::Exact(value) => {
            assert!(is_rational(expected), "{expected:?} is no rational number");
            let total: BigRational = expected.values().sum();
            assert_eq!(*value, total);
        }
        Value::Certified { decimal, ball } => {
            assert!(!is_rational(expected), "{expected:?} is a rational number");
            let bits = 400 + 4 * u32::try_from(digits).unwrap();
            let interval = enclose(expected, bits);
            assert_eq!(*decimal, interval.rounded(digits));
            assert!(ball.contains(&interval.low));
            assert!(ball.contains(&interval.high));
        }
        Value::Enclosed(_) => panic!("{found} has no digits"),
    }
}

#[test]
fn the_enclosure_made_here_is_right() {
    // e, 1/e and e^20 to 50 digits.
    for (x, digits) in [
        ("1", "2.7182818284590452353602874713526624977572470936999596"),
        ("-1", "0.36787944117144232159552377016146086744581113103176783"),
        ("20", "485165195.40979027796910683054154055868463898894484725"),
    ] {
        let Interval { low, high } = exponential(&ratio(x), 300);
        let (known, margin) = (ratio(digits), ratio("1e-40"));
        assert!(low < high && &high - &low < ratio("1e-60"));
        assert!(&known - &margin < low && high < known + margin, "{x}");
    }
}

// ---- Exact values -------------------------------------------------------------------------------

#[test]
fn rational_values_are_exact() {
    let mu = ratio("3/7");
    let rigid = Solution::new(recurrence("rigid-mass", &[("mu", &mu)]));
    let zero = BigRational::zero();
    for (quantity, expected) in
        [("f", 1), ("g", 0), ("velocity", 1), ("strain_impact", -1), ("strain_fixed", 0)]
    {
        let found = value(&rigid, quantity, &zero, Limit::Right, 15);
        assert_eq!(found, Value::Exact(BigRational::from_integer(expected.into())), "{quantity}");
        let before = value(&rigid, quantity, &zero, Limit::Left, 15);
        assert_eq!(before, Value::Exact(BigRational::zero()), "{quantity}");
    }
    let pulse = Solution::new(recurrence("pulse-shape", &[("mu", &mu)]));
    assert_eq!(value(&pulse, "force", &zero, Limit::Right, 15), Value::Exact(BigRational::zero()));
    assert!(matches!(value(&pulse, "force", &mu, Limit::Right, 15), Value::Certified { .. }));
}

/// The velocity of a pushed end grows by twice its first value with each return, also at irrational times.
#[test]
fn a_scene_of_an_irrational_period_has_values() {
    let text = "scene \"Pushed\"\nload push { force = 1 }\nbar rod { impedance = 1, travel = sqrt(2) }\n\
        line free - push - rod - free\nobserve v = velocity(rod.left)";
    let problem = wavestep::Problem::read("pushed.wave", text).unwrap();
    let velocity = problem.signal("v").unwrap();
    for (at, value) in [("7/3", 1.0), ("3", 3.0), ("6", 5.0)] {
        assert_eq!(velocity.at(at, 30).unwrap().to_f64(), value, "{at}");
    }
}

#[test]
fn echoes_that_vanish_leave_a_rational_value() {
    // On period 1, f = e^{−t} + e^{−x} L_1(2x), x = t − 2, and L_1(1) = 0.
    let text = "recurrence \"Zero of an echo\"\nperiod 2, local s, time t\nwave f, g\n\
                equation g[n] = -f[n-1]\nequation f[n]' + g[n]' = -(f[n] - g[n])\n\
                continuous f[n] + g[n] starts at 1\nobserve rest = f[n] - exp(-t) + 1/3\n\
                observe both = f[n] - exp(-t)\n";
    let solution = Solution::new(recurrence(text, &[]));
    let at = ratio("5/2");
    assert_eq!(value(&solution, "rest", &at, Limit::Right, 15), Value::Exact(ratio("1/3")));
    assert_eq!(value(&solution, "both", &at, Limit::Right, 15), Value::Exact(BigRational::zero()));
    // A little beside the zero, the value is small and certified all the same.
    let beside = ratio("5/2 + 1e-60");
    let Value::Certified { decimal, .. } = value(&solution, "both", &beside, Limit::Right, 15)
    else {
        panic!("no rational number");
    };
    // e^{−1/2} L_1'(1)·2e−60, L_1' = −1.
    assert_eq!(decimal.to_string(), "-1.21306131942527e-60");
}

#[test]
fn every_value_of_two_bars_is_rational() {
    for r in ["1/3", "1", "7/2", "1000000007/3"] {
        let r = ratio(r);
        let solution = Solution::new(recurrence("two-bars", &[("r", &r)]));
        let mut f = BigRational::zero();
        for n in 0..20 {
            let g = ((&r - whole(1)) * &f - whole(1)) / (&r + whole(1));
            let velocity = whole(1) + &f + &g;
            let at = whole(2 * n) + ratio("1/7") * whole(n % 14);
            for (quantity, expected) in
                [("f", &f), ("g", &g), ("F", &velocity), ("interface_velocity", &velocity)]
            {
                let found = value(&solution, quantity, &at, Limit::Right, 15);
                assert_eq!(found, Value::Exact(expected.clone()), "{quantity}({at}), r = {r}");
            }
            let end = value(&solution, "g", &whole(2 * n + 2), Limit::Left, 15);
            assert_eq!(end, Value::Exact(g.clone()));
            f = g;
        }
    }
}

// ---- Period form against echo form --------------------------------------------------------------

/// A scene with its symbols, and the waves to look at.
const RANDOM: [(&str, &[&str], &[&str]); 4] = [
    ("rigid-mass", &["mu"], &["f", "g"]),
    ("pulse-shape", &["mu"], &["a"]),
    (MIXED, &["mu"], &["f", "g"]),
    (POLES, &["a", "b"], &["f", "g"]),
];

const PERIODS: usize = 7;

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        cases: 24,
        ..ProptestConfig::default()
    })]

    #[test]
    fn values_are_those_of_the_period_form(
        scene in 0..RANDOM.len(),
        numerators in prop::collection::vec(1_i64..60, 2),
        denominators in prop::collection::vec(prop::sample::select(&[1_i64, 2, 3, 10, 16, 97]), 2),
        confluent in any::<bool>(),
        (n, place) in (0..=PERIODS, 0_i64..1000),
        digits in prop::sample::select(&[15_usize, 30, 50]),
    ) {
        let (text, symbols, waves) = RANDOM[scene];
        let mut parameters: Vec<BigRational> = numerators
            .iter()
            .zip(&denominators)
            .map(|(above, below)| BigRational::new((*above).into(), (below * 8).into()))
            .collect();
        if confluent {
            parameters[1] = parameters[0].clone();
        }
        let values: Vec<_> = symbols.iter().copied().zip(&parameters).collect();
        let recurrence_of = || recurrence(text, &values);
        let (own, solution) = (recurrence_of(), Solution::new(recurrence_of()));
        let pieces = Pieces::new(&own, PERIODS);
        let local = &pieces.period * BigRational::new(place.into(), 1000.into());
        let at = &pieces.period * whole(n) + local;
        for wave in waves {
            let expected = pieces.at(wave, false, &at, Limit::Right);
            let found = value(&solution, wave, &at, Limit::Right, digits);
            assert_is(&found, &expected, digits);
            // Twice the digits begin with these.
            let longer = decimal(&value(&solution, wave, &at, Limit::Right, 2 * digits), 2 * digits);
            let shortened = Decimal::from_rational(&longer.to_rational(), digits).0;
            prop_assert_eq!(shortened, decimal(&found, digits));
        }
    }
}

#[test]
fn late_pieces_of_the_rigid_mass() {
    let mu = ratio("1/4");
    let own = recurrence("rigid-mass", &[("mu", &mu)]);
    let solution = Solution::new(recurrence("rigid-mass", &[("mu", &mu)]));
    // Period 30 derived by way of all before it; period 80 expanded from its echoes.
    let mut pieces = Pieces::new(&own, 30);
    let f = own.wave("f").unwrap();
    let eightieth = solution.pieces(f, 80, 80).unwrap().remove(0);
    pieces.waves[f].resize(81, eightieth);
    for (n, local) in [(30, "0.4999"), (80, "0"), (80, "1/7")] {
        let at = &pieces.period * whole(n) + ratio(local);
        let expected = pieces.at("f", false, &at, Limit::Right);
        assert_is(&value(&solution, "f", &at, Limit::Right, 50), &expected, 50);
    }
}

// ---- Far out ------------------------------------------------------------------------------------

/// `Σ_{k ≤ last} e^{−x_k} L_k(2 x_k)`, `x_k = t − kD`, with `Y = 2 x_k d` whole and the integers
/// `P_k = k! d^k L_k(Y/d)`: `P_{j+1} = ((2j+1) d − Y) P_j − j² d² P_{j−1}`.
fn laguerre_sum(time: &BigRational, period: &BigRational, last: usize, bits: u32) -> Interval {
    let mut total = Interval { low: BigRational::zero(), high: BigRational::zero() };
    let unit = BigInt::one() << bits;
    let round = |value: BigRational, up: bool| {
        let scaled = value * BigRational::from_integer(unit.clone());
        let whole = if up { scaled.ceil() } else { scaled.floor() };
        whole / BigRational::from_integer(unit.clone())
    };
    for k in 0..=last {
        let x = time - period * whole(k);
        let double = &x * whole(2);
        let (y, d) = (double.numer(), double.denom());
        let (mut before, mut polynomial) = (BigInt::zero(), BigInt::one());
        let mut scale = BigInt::one();
        for j in 0..k {
            let next = (d * (2 * j + 1) - y) * &polynomial - &before * (j * j) * d * d;
            before = std::mem::replace(&mut polynomial, next);
            scale *= d * (j + 1);
        }
        let laguerre = BigRational::new(polynomial, scale);
        let Interval { low, high } = exponential(&-x, bits);
        let (one, other) = (low * &laguerre, high * &laguerre);
        let (low, high) = if one <= other { (one, other) } else { (other, one) };
        total.low += round(low, false);
        total.high += round(high, true);
    }
    total
}

/// `f_n(0)` by a march: Taylor coefficients about the start of each period, in integers of unit
/// `2^−bits`, from `f_n' + f_n = f_{n−1}' − f_{n−1}` and the continuity of `f_n − f_{n−1}`.
fn march(period: &BigRational, n: usize, degree: usize, bits: u32) -> BigRational {
    let unit = BigInt::one() << bits;
    let at_end = |coefficients: &[BigInt]| {
        coefficients.iter().rev().fold(BigInt::zero(), |value, coefficient| {
            value * period.numer() / period.denom() + coefficient
        })
    };
    let mut older = vec![BigInt::zero(); degree + 1];
    let mut wave = vec![unit.clone()];
    for j in 0..degree {
        wave.push(-&wave[j] / (j + 1));
    }
    for _ in 0..n {
        let start = &wave[0] + at_end(&wave) - at_end(&older);
        let mut next = vec![start];
        for j in 0..degree {
            let slope = &wave[j + 1] * (j + 1);
            next.push((slope - &wave[j] - &next[j]) / (j + 1));
        }
        older = std::mem::replace(&mut wave, next);
    }
    BigRational::new(wave[0].clone(), unit)
}

/// `e^{−x} L_k(2x)` as a person would program it first: Horner's rule in powers of `x`.
fn naive_echo(k: usize, x: f64) -> f64 {
    let mut coefficients = vec![1.0];
    for j in 1..=k {
        let ratio = -2.0 * (k + 1 - j) as f64 / (j * j) as f64;
        coefficients.push(coefficients[j - 1] * ratio);
    }
    (-x).exp() * coefficients.iter().rev().fold(0.0, |value, c| value * x + c)
}

#[test]
fn six_hundred_periods_out() {
    let (mu, at, n) = (ratio("1/100"), ratio("12.34"), 617);
    let period = ratio("1/50");
    assert_eq!(&period * whole(n), at);
    let solution = Solution::new(recurrence("rigid-mass", &[("mu", &mu)]));
    let Value::Certified { decimal, ball } = value(&solution, "f", &at, Limit::Right, 30) else {
        panic!("no rational number");
    };
    let exact = laguerre_sum(&at, &period, n, 400);
    assert_eq!(decimal, exact.rounded(30));
    assert!(ball.contains(&exact.low) && ball.contains(&exact.high));
    // The march loses less than two bits a step.
    let marched = march(&period, n, 100, 2000);
    assert_eq!(decimal, Decimal::from_rational(&marched, 30).0);
    // The form expanded in powers loses all digits of a double, and tens of places more.
    let echo = |k: usize| naive_echo(k, 12.34 - k as f64 / 50.0);
    let naive: f64 = (0..=n).map(echo).sum();
    let error = (naive - exact.low.to_f64().unwrap()).abs();
    assert!(error > 1e20, "the error is {error:e}");
}

// ---- Sides --------------------------------------------------------------------------------------

/// The difference of right and left limit, good to some 38 digits.
fn jump(solution: &Solution, quantity: &str, at: &BigRational) -> BigRational {
    let [right, left] = [Limit::Right, Limit::Left]
        .map(|side| decimal(&value(solution, quantity, at, side, 40), 40).to_rational());
    right - left
}

#[test]
fn limits_at_arrivals_differ_by_the_jump() {
    let mu = ratio("2/5");
    let own = recurrence("rigid-mass", &[("mu", &mu)]);
    let pieces = Pieces::new(&own, 12);
    let solution = Solution::new(recurrence("rigid-mass", &[("mu", &mu)]));
    for k in 0..=12 {
        let at = &mu * whole(2 * k);
        for wave in ["f", "g"] {
            for side in [Limit::Left, Limit::Right] {
                let expected = pieces.at(wave, false, &at, side);
                assert_is(&value(&solution, wave, &at, side, 30), &expected, 30);
            }
        }
        // The front comes back with its sign changed each time it is reflected at the fixed end,
        // and f − f_{n−1} goes on: f gains 1, g loses 1 after the first passage.
        let later = i64::from(k > 0);
        for (quantity, expected) in
            [("f", 1), ("g", -later), ("velocity", 1 - later), ("strain_impact", -1 - later)]
        {
            let expected = BigRational::from_integer(expected.into());
            let difference = jump(&solution, quantity, &at) - expected;
            assert!(difference.abs() < ratio("1e-38"), "{quantity} at {at}: {difference}");
        }
        // The fixed end feels the front one passage later, twice.
        let difference = jump(&solution, "strain_fixed", &(at + &mu)) + whole(2);
        assert!(difference.abs() < ratio("1e-38"));
    }
    // Between arrivals both limits are one value.
    for at in ["1/10", "0.7", "3.99", "5.2000000001"] {
        let [left, right] =
            [Limit::Left, Limit::Right].map(|side| value(&solution, "f", &ratio(at), side, 30));
        assert_eq!(left, right, "{at}");
    }
}

// ---- Observables --------------------------------------------------------------------------------

#[test]
fn the_fixed_end_is_at_rest_until_the_front_is_there() {
    let mu = ratio("7/3");
    let solution = Solution::new(recurrence("rigid-mass", &[("mu", &mu)]));
    for (at, side, expected) in [
        ("0", Limit::Right, "0"),
        ("1", Limit::Right, "0"),
        ("7/3 - 1e-900", Limit::Right, "0"),
        ("7/3", Limit::Left, "0"),
        ("7/3", Limit::Right, "-2"),
    ] {
        let found = value(&solution, "strain_fixed", &ratio(at), side, 15);
        assert_eq!(found, Value::Exact(ratio(expected)), "{at} {side:?}");
    }
    let own = recurrence("rigid-mass", &[("mu", &mu)]);
    let pieces = Pieces::new(&own, 3);
    for at in ["7/3 + 1e-9", "3", "7", "10", "15"] {
        let wave = pieces.at("f", false, &(ratio(at) - &mu), Limit::Right);
        let found = value(&solution, "strain_fixed", &ratio(at), Limit::Right, 30);
        assert_is(&found, &combined(&[("-2", "0", wave)]), 30);
    }
}

#[test]
fn forcing_slopes_and_exponential_coefficients() {
    let mu = ratio("3/4");
    let own = recurrence(MIXED, &[("mu", &mu)]);
    let pieces = Pieces::new(&own, 6);
    let solution = Solution::new(recurrence(MIXED, &[("mu", &mu)]));
    let one = || ExponentialSum::from([(BigRational::zero(), whole(1))]);
    for at in ["0", "1/8", "3/2", "7/4", "3", "31/10", "8.25", "10"] {
        let time = ratio(at);
        for side in [Limit::Left, Limit::Right] {
            if at == "0" && side == Limit::Left {
                continue;
            }
            let wave = |name: &str, slope: bool, delay: &str| {
                pieces.at(name, slope, &(&time - ratio(delay)), side)
            };
            for (quantity, expected) in [
                (
                    "forced",
                    combined(&[
                        ("1", "-3/4", wave("f", false, "0")),
                        (&format!("({at})^2"), &format!("-2*({at})"), one()),
                        ("-3", "0", one()),
                    ]),
                ),
                ("slope", wave("f", true, "0")),
                (
                    "delayed",
                    combined(&[
                        ("2", "0", wave("f", false, "1/4")),
                        ("-1", "0", wave("g", false, "3/2")),
                    ]),
                ),
            ] {
                assert_is(&value(&solution, quantity, &time, side, 30), &expected, 30);
            }
        }
    }
}

/// Echoes by a closed form, and echoes derived one from another.
#[test]
fn slopes_by_rows() {
    let (mu, other) = (ratio("3/4"), ratio("5/3"));
    let with_slope = |scene: &str, wave: &str| {
        let text = wavestep::scenes::find(scene).map_or(scene, |scene| scene.text);
        format!("{text}\nobserve slope = {wave}[n]' - 2*{wave}[n-1]\n")
    };
    let rigid = with_slope("rigid-mass", "f");
    let poles = with_slope(POLES, "g");
    for (text, wave, values) in [
        (&rigid, "f", vec![("mu", &mu)]),
        (&poles, "g", vec![("a", &mu), ("b", &other)]),
        (&poles, "g", vec![("a", &mu), ("b", &mu)]),
    ] {
        let own = recurrence(text, &values);
        let pieces = Pieces::new(&own, 6);
        let solution = Solution::new(recurrence(text, &values));
        for at in ["1/7", "3/2", "5", "6.9"] {
            for side in [Limit::Left, Limit::Right] {
                let slope = pieces.at(wave, true, &ratio(at), side);
                let before = pieces.at(wave, false, &(ratio(at) - &pieces.period), side);
                let expected = combined(&[("1", "0", slope), ("-2", "0", before)]);
                assert_is(&value(&solution, "slope", &ratio(at), side, 30), &expected, 30);
            }
        }
    }
}

#[test]
fn growth_and_decay_keep_their_digits() {
    for rate in ["5", "-5", "40"] {
        let text = format!(
            "recurrence \"Growth\"\nperiod 1, local s, time t\nwave f\n\
             equation f[n]' - ({rate})*f[n] = f[n-1]\ncontinuous f[n] starts at 1\n"
        );
        let own = recurrence(&text, &[]);
        let pieces = Pieces::new(&own, 9);
        let solution = Solution::new(recurrence(&text, &[]));
        for at in ["0.5", "4", "29/3"] {
            let expected = pieces.at("f", false, &ratio(at), Limit::Right);
            assert_is(&value(&solution, "f", &ratio(at), Limit::Right, 30), &expected, 30);
        }
    }
}

// ---- Limits -------------------------------------------------------------------------------------

#[test]
fn accuracy_that_is_not_reached_is_told_with_an_enclosure() {
    let mu = ratio("1/4");
    let own = recurrence("rigid-mass", &[("mu", &mu)]);
    let pieces = Pieces::new(&own, 6);
    let solution = Solution::new(recurrence("rigid-mass", &[("mu", &mu)]));
    let at = ratio("33/10");
    let exact = enclose(&pieces.at("f", false, &at, Limit::Right), 600);
    for limit in [0, 2, 8, 16, 30, 60] {
        let error = told(&solution, "f", &at, Limit::Right, 30, limit).unwrap_err();
        let EvaluateError::AccuracyNotReached { best, bits } = &error else { panic!("{error}") };
        assert_eq!(*bits, limit);
        assert!(best.contains(&exact.low) && best.contains(&exact.high));
        assert!(error.to_string().contains("radius"));
    }
    let found = told(&solution, "f", &at, Limit::Right, 30, 200).unwrap();
    assert_eq!(decimal(&found, 30), exact.rounded(30));
}

#[test]
fn late_times_are_refused() {
    let refused = |solution: &Solution, at: BigRational, limit: usize| {
        let statement = solution.recurrence().statement();
        let period = statement.period.as_constant().unwrap();
        let periods = (&at / period).floor().to_integer();
        let error = told(solution, &statement.waves[0], &at, Limit::Right, 15, BITS).unwrap_err();
        assert_eq!(error, EvaluateError::TooManyPeriods { periods, limit });
        assert!(error.to_string().len() < 200);
    };
    let mu = ratio("1/3");
    let rigid = Solution::new(recurrence("rigid-mass", &[("mu", &mu)]));
    for at in [ratio("2/3") * whole(MAX_ORDER + 1), ratio("1e9"), ratio("1e1000")] {
        refused(&rigid, at, MAX_ORDER);
    }
    let bars = Solution::new(recurrence("two-bars", &[("r", &mu)]));
    let first_refused = whole(2 * (MAX_ORDER_OF_SEQUENCE + 1));
    refused(&bars, first_refused.clone(), MAX_ORDER_OF_SEQUENCE);
    // The limit from the left belongs to the period before, which is the last one.
    assert!(matches!(value(&bars, "f", &first_refused, Limit::Left, 15), Value::Exact(_)));
    let formless = recurrence(
        "recurrence \"No form\"\nperiod 1, local s, time t\nwave f\nequation f[n]' + f[n] = f[n-2]\n\
         continuous f[n] starts at 1\n",
        &[],
    );
    refused(&Solution::new(formless), whole(MAX_PIECES + 1), MAX_PIECES);
}

#[test]
fn a_symbol_without_a_value_is_named() {
    let solution = Solution::new(recurrence("rigid-mass", &[]));
    let error = told(&solution, "f", &ratio("1"), Limit::Right, 15, BITS).unwrap_err();
    assert_eq!(error.to_string(), "the symbol mu has no value");
}
