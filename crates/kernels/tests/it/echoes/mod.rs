//! The summations of echoes against arbitrary precision: how many ulps each of them loses.

mod reference;

use crate::random::Random;
use crate::reference::{error, to_double};
use wavestep_kernels::Limit;
use wavestep_kernels::double_double::DoubleDouble;
use wavestep_kernels::echoes::{
    EchoError, EchoSum, Echoes, Expansion, ExponentialPolynomial, Family, Method, Term,
};

fn number(value: f64) -> Expansion {
    Expansion::try_from(value).expect("a number")
}

/// The sum, rounded to one double.
fn in_double(
    sum: &EchoSum,
    method: Method,
    time: DoubleDouble,
    limit: Limit,
) -> Result<f64, EchoError> {
    sum.pair(method, time, limit).map(DoubleDouble::high)
}

/// The rigid mass on a fixed bar: `φ_k(x) = e^{−x} L_k(2x)`, `D = 2μ`.
fn rigid_mass(period: Expansion, last: usize) -> EchoSum {
    let (one, two) = (Expansion::ONE, number(2.0));
    let terms = [Term { lag: 0, coefficient: one }];
    let wave = Echoes::new(Family::Laguerre, one, two, one, &terms, period).expect("a wave");
    EchoSum::new(wave, last).expect("a sum")
}

/// Echo `k` of the rigid mass alone, the others being empty, until long after it arrived.
fn one_echo(k: usize, period: Expansion) -> EchoSum {
    let (one, two) = (Expansion::ONE, number(2.0));
    let terms = [Term { lag: 0, coefficient: one }];
    let wave = Echoes::new(Family::Laguerre, one, two, one, &terms, period).expect("a wave");
    let empty = wave.with_first(vec![vec![]; k]).expect("empty");
    EchoSum::new(empty, k).expect("a sum")
}

/// The pulse: `φ_0 = 1 − e^{−x}`, `φ_k = e^{−x} (L_{k−1}(x) − L_k(x))`, `D = μ`.
fn pulse(period: Expansion, last: usize) -> EchoSum {
    let (one, minus) = (Expansion::ONE, number(-1.0));
    let terms = [Term { lag: 0, coefficient: minus }, Term { lag: 1, coefficient: one }];
    let step = ExponentialPolynomial { rate: Expansion::ZERO, coefficients: vec![one] };
    let decay = ExponentialPolynomial { rate: one, coefficients: vec![minus] };
    let wave = Echoes::new(Family::Laguerre, one, one, one, &terms, period).expect("a wave");
    let wave = wave.with_first(vec![vec![step, decay]]).expect("first echoes");
    EchoSum::new(wave, last).expect("a sum")
}

/// A time in period `n`: most often anywhere, every third time next to an arrival.
fn time_in_period(random: &mut Random, period: f64, n: usize, kind: usize) -> f64 {
    let arrival = n as f64 * period;
    match kind % 6 {
        0 => arrival.next_up(),
        1 => ((n + 1) as f64 * period).next_down(),
        2 => arrival + period * 1e-6 * random.unit(),
        _ => arrival + period * random.unit(),
    }
}

/// The largest value of the wave before `time`, from where echoes arrive and 64 times between: a lower
/// bound, so that errors in ulps of it are not flattered.
fn largest(sum: &EchoSum, period: f64, time: f64) -> f64 {
    let arrivals = (0..).map(|k| k as f64 * period).take_while(|&arrival| arrival < time);
    let times: Vec<f64> = arrivals.chain((1..=64).map(|i| time * f64::from(i) / 64.0)).collect();
    let mut values = vec![0.0; times.len()];
    sum.fill(&times, Limit::Right, &mut values).expect("in range");
    values.iter().fold(0.0, |most, value| value.abs().max(most))
}

/// An ulp of a positive double.
fn ulp(value: f64) -> f64 {
    value.next_up() - value
}

/// Errors seen of each method, in ulps, with a count.
#[derive(Default)]
struct Worst {
    comparisons: usize,
    ulps: [f64; 5],
}

impl Worst {
    fn take(&mut self, sum: &EchoSum, time: f64, right: impl Fn(f64) -> f64, largest: f64) {
        self.comparisons += 1;
        let mut values = [0.0];
        sum.fill(&[time], Limit::Right, &mut values).expect("in range");
        let value = |method| {
            in_double(sum, method, DoubleDouble::from(time), Limit::Right).expect("in range")
        };
        let all = Method::ALL.map(value).into_iter().chain(values);
        for (worst, value) in self.ulps.iter_mut().zip(all) {
            // What is not a number is as wrong as can be.
            let error = right(value).abs() / ulp(largest);
            *worst = if error.is_nan() { f64::INFINITY } else { worst.max(error) };
        }
    }

    /// Prints the errors and holds the laws: 64 ulps for the stable summations, 2 in pairs.
    fn hold(&self, name: &str) {
        println!("{name}: {} times, 5 summations each; ulps at most:", self.comparisons);
        for (method, ulps) in Method::ALL.iter().zip(self.ulps) {
            println!("    {method:?}: {ulps:.3e}");
        }
        println!("    side by side: {:.3e}", self.ulps[4]);
        assert!(self.ulps[2] <= 64.0 && self.ulps[4] <= 64.0);
        assert!(self.ulps[3] <= 2.0);
    }
}

/// One first echo `c e^{-rx}` that no other follows, for as long as its period.
fn only_first(rate: f64, coefficient: f64, period: f64) -> EchoSum {
    let (one, slow) = (Expansion::ONE, number(2.0_f64.powi(-30)));
    let terms = [Term { lag: 0, coefficient: one }];
    let wave = Echoes::new(Family::Laguerre, slow, slow, one, &terms, number(period));
    let first = ExponentialPolynomial {
        rate: number(rate),
        coefficients: vec![number(coefficient), number(coefficient)],
    };
    EchoSum::new(wave.and_then(|wave| wave.with_first(vec![vec![first]])).expect("a wave"), 0)
        .expect("a sum")
}

/// `c (1 + x) e^{-rx}` where the exponential alone is below or above all normal doubles, but the value is not.
#[test]
fn first_echoes_keep_their_digits_where_exponentials_leave_the_range() {
    for (rate, coefficient) in [(1.0, 2.0_f64.powi(200)), (-1.0, 2.0_f64.powi(-200))] {
        let sum = only_first(rate, coefficient, 1e4);
        for time in [1.0_f64, 699.0, 700.0, 720.0, 745.0, 800.0] {
            let half = (-rate * time / 2.0).exp();
            let expected = half * coefficient * (1.0 + time) * half;
            for method in [Method::Scaled, Method::DoubleDouble] {
                let told = in_double(&sum, method, time.into(), Limit::Right).expect("in range");
                let off = (told / expected - 1.0).abs();
                assert!(off < 1e-12, "{method:?} at {time}: {told:e}, not {expected:e}");
            }
        }
    }
}

/// The largest argument is that of the fastest rate, of first echoes as of the others.
#[test]
fn times_too_late_for_the_rates_of_first_echoes_are_refused() {
    let late = 2.0_f64.powi(41);
    for (rate, refused) in [(0.25, false), (1.0, true), (-1.0, true)] {
        let sum = only_first(rate, 1.0, 4.0 * late);
        let told = in_double(&sum, Method::Scaled, late.into(), Limit::Right);
        assert_eq!(told == Err(EchoError::TimeTooLarge), refused, "{rate}: {told:?}");
    }
}

#[test]
fn the_reference_agrees_with_exact_polynomials() {
    let mut random = Random(1);
    for k in [0, 1, 2, 7, 40, 200, 500] {
        let x = 4.0 * k as f64 * random.unit();
        let difference = reference::disagreement(k, x);
        assert!(difference < 1e-60, "L_{k}(2·{x}): {difference:e}");
    }
    // What is said of an echo whose exponential underflows.
    let echo = to_double(&reference::echo(500, [900.0, 0.0], 2.0));
    assert!((echo + 0.02471102674978201).abs() < 1e-17, "{echo}");
}

#[test]
fn stable_sums_keep_64_ulps_and_pairs_2_on_the_rigid_mass() {
    let mut random = Random(2);
    let mut worst = Worst::default();
    for round in 0..250 {
        // Every fourth time in the last period, and the ends of the range now and then.
        let mass = match round % 10 {
            0 => 0.01,
            1 => 10.0,
            _ => 0.01 * 1000f64.powf(random.unit()),
        };
        let n = if round % 4 == 0 { 200 } else { (201.0 * random.unit()) as usize };
        let period = 2.0 * mass;
        let time = time_in_period(&mut random, period, n, round);
        let sum = rigid_mass(number(period), 201);
        let largest = largest(&sum, period, time);
        // Now and then from another library's numbers.
        if round % 8 == 0 {
            let wave = reference::rigid_mass([period, 0.0, 0.0], time);
            worst.take(&sum, time, |value| error(&wave, value), largest);
        } else {
            worst.take(&sum, time, reference::error_of_rigid_mass(period, time), largest);
        }
    }
    worst.hold("rigid mass");
    // The reference of what goes wrong does go wrong.
    assert!(worst.ulps[0] > 1e15 && worst.ulps[1] > 500.0);
}

#[test]
fn the_pulse_keeps_the_same_laws() {
    let mut random = Random(3);
    let mut worst = Worst::default();
    for round in 0..60 {
        let period = 0.01 * 1000f64.powf(random.unit());
        let n = if round % 4 == 0 { 200 } else { (201.0 * random.unit()) as usize };
        let time = time_in_period(&mut random, period, n, round);
        let sum = pulse(number(period), 201);
        let wave = reference::pulse([period, 0.0, 0.0], time);
        let largest = largest(&sum, period, time).max(0.5);
        worst.take(&sum, time, |value| error(&wave, value), largest);
    }
    worst.hold("pulse");
}

/// A period that no double is: what the summations lose does not depend on it.
#[test]
fn periods_need_not_be_doubles() {
    let mut random = Random(4);
    let mut worst = Worst::default();
    for round in 0..40 {
        // 2/3, and what its first and second doubles lack.
        let parts = [2.0 / 3.0, 2.0 / 3.0 * 2f64.powi(-54), 2.0 / 3.0 * 2f64.powi(-108)];
        let sum = rigid_mass(Expansion::new(parts).expect("a number"), 201);
        let n = 100 + (100.0 * random.unit()) as usize;
        let time = time_in_period(&mut random, parts[0], n, round);
        let wave = reference::rigid_mass(parts, time);
        let right = |value| error(&wave, value);
        worst.take(&sum, time, right, largest(&sum, parts[0], time));
    }
    worst.hold("rigid mass, period 2/3");
}

#[test]
fn single_echoes_are_right_where_the_exponential_underflows() {
    let mut random = Random(5);
    // So long that no later echo arrives.
    let period = 1e5;
    let (mut worst, mut underflows) = ([0f64; 2], 0);
    for round in 0..120 {
        let k = if round % 3 == 0 { 2000 } else { (2001.0 * random.unit()) as usize };
        let x = (2.2 * k as f64 + 10.0) * random.unit();
        // A low part that is nearly half an ulp: without it the echo is off by up to 25 ulps.
        let low = 0.49 * ulp(x);
        let exact = reference::echo(k, [x, low], 2.0);
        let sum = one_echo(k, number(period));
        // The arrival is a double; what the sum with x drops stands in the low part.
        let arrival = period * k as f64;
        let rounded = arrival + x;
        let time =
            DoubleDouble::from_sum(rounded, (x - (rounded - arrival)) + low).expect("a time");
        let mut compare = |method, place: usize| {
            let value = in_double(&sum, method, time, Limit::Right).expect("in range");
            let off = error(&exact, value) / f64::EPSILON;
            worst[place] = worst[place].max(off);
        };
        compare(Method::Scaled, 0);
        compare(Method::DoubleDouble, 1);
        underflows += usize::from((-x).exp() == 0.0);
    }
    println!(
        "120 echoes to 2000, {underflows} of which underflow: off by at most {worst:.3?} ulps"
    );
    assert!(underflows > 30);
    assert!(worst[0] <= 4.0 && worst[1] <= 1.0);
}

/// All times at once, in an order that mixes periods, beyond the range of `e^{−x}`, for both
/// families, both signs of the scale, lags on both sides and both limits.
#[test]
fn lanes_agree_with_pairs() {
    let mut random = Random(6);
    let [one, half, minus] = [1.0, 0.5, -1.0].map(number);
    let terms = [
        Term { lag: -1, coefficient: half },
        Term { lag: 0, coefficient: one },
        Term { lag: 3, coefficient: minus },
    ];
    let waves = [
        (Family::Laguerre, 1.0, 2.0, 1.0, 12.5),
        (Family::Laguerre, 1.0, 1.5, -0.75, 0.3),
        (Family::Laguerre, 2.0, -0.25, 0.5, 1.0),
        (Family::Powers, 1.0, 1.0, 1.0, 12.5),
        (Family::Powers, 2.0, -1.0, 0.9, 0.25),
    ];
    let mut comparisons = 0;
    for (family, rate, scale, ratio, period) in waves {
        let [rate, scale, ratio] = [rate, scale, ratio].map(number);
        let wave = Echoes::new(family, rate, scale, ratio, &terms, number(period)).expect("fine");
        let sum = EchoSum::new(wave, 101).expect("a sum");
        let mut times: Vec<f64> = (0..300).map(|_| 101.0 * period * random.unit()).collect();
        times.extend((0..101).map(|k| f64::from(k) * period));
        times.push(-1.0);
        let ordered = {
            let mut ordered = times.clone();
            ordered.sort_by(f64::total_cmp);
            ordered
        };
        for times in [times, ordered] {
            for limit in [Limit::Left, Limit::Right] {
                let mut values = vec![f64::NAN; times.len()];
                sum.fill(&times, limit, &mut values).expect("in range");
                let right = |&time: &f64| {
                    let method = Method::DoubleDouble;
                    in_double(&sum, method, DoubleDouble::from(time), limit).expect("in range")
                };
                let right: Vec<f64> = times.iter().map(right).collect();
                let largest = right.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
                for (i, value) in values.iter().enumerate() {
                    let off = (value - right[i]).abs() / ulp(largest);
                    assert!(off <= 64.0, "{family:?} at {}: {value}, not {}", times[i], right[i]);
                    comparisons += 1;
                }
            }
        }
    }
    println!("{comparisons} values side by side");
}

/// One echo alone, the others being empty, at times since its arrival that no double is: lanes too
/// correct it by its slope.
#[test]
fn lanes_keep_the_low_part_of_the_time() {
    let sum = one_echo(400, Expansion::new([600.0, 3.3e-14, 0.0]).expect("a number"));
    let mut random = Random(8);
    let times: Vec<f64> = (0..400).map(|_| 240_300.0 + 290.0 * random.unit()).collect();
    let mut values = vec![0.0; times.len()];
    sum.fill(&times, Limit::Right, &mut values).expect("in range");
    let mut worst = 0f64;
    for (&time, value) in times.iter().zip(values) {
        let right = sum
            .pair(Method::DoubleDouble, DoubleDouble::from(time), Limit::Right)
            .map(DoubleDouble::high)
            .expect("in range");
        worst = worst.max((value - right).abs() / f64::EPSILON);
    }
    println!("400 times of echo 400 alone: off by at most {worst:.3} ulps of 1");
    assert!(worst < 2.0);
}

/// Powers, a ratio and lags, against arbitrary precision.
#[test]
fn powers_and_lags_are_right() {
    let mut random = Random(7);
    for family in [Family::Powers, Family::Laguerre] {
        let terms = [
            Term { lag: -1, coefficient: number(0.5) },
            Term { lag: 2, coefficient: number(-3.0) },
        ];
        let (one, ratio) = (Expansion::ONE, number(-0.75));
        let wave = Echoes::new(family, one, one, ratio, &terms, one).expect("a wave");
        let sum = EchoSum::new(wave, 61).expect("a sum");
        let mut worst = [0f64; 2];
        for _ in 0..40 {
            let time = 61.0 * random.unit();
            let right = reference::lagged(family, time, -0.75);
            for (place, method) in [Method::Scaled, Method::DoubleDouble].into_iter().enumerate() {
                let value = in_double(&sum, method, DoubleDouble::from(time), Limit::Right)
                    .expect("in range");
                let off = error(&right, value) / f64::EPSILON;
                worst[place] = worst[place].max(off);
            }
        }
        println!("{family:?} with lags: 40 times, off by at most {worst:.3?} ulps of 1");
        assert!(worst[0] <= 64.0 && worst[1] <= 2.0);
    }
}

/// The jump at an arrival is 1, on whatever side of it the doubles lie.
#[test]
fn limits_at_arrivals_differ_by_the_jump() {
    let sum = rigid_mass(number(0.1), 200);
    for k in 1..=200 {
        // 0.1 is a double that is not 1/10; its multiples are seldom doubles, but sums of two.
        let high = f64::from(k) * 0.1;
        let time = DoubleDouble::from_sum(high, f64::from(k).mul_add(0.1, -high)).expect("a time");
        for method in [Method::Scaled, Method::DoubleDouble] {
            let [left, right] = [Limit::Left, Limit::Right]
                .map(|limit| in_double(&sum, method, time, limit).unwrap());
            assert!((right - left - 1.0).abs() < 1e-15, "{method:?}, echo {k}: {left} {right}");
        }
    }
}

/// The formula as printed and the recurrence of three terms are right as long as nothing cancels, for
/// both families, a ratio and lags.
#[test]
fn naive_sums_are_right_at_first() {
    for family in [Family::Laguerre, Family::Powers] {
        let terms = [(-1, 0.5), (0, 1.0), (2, -3.0)];
        let terms = terms.map(|(lag, value)| Term { lag, coefficient: number(value) });
        let (one, ratio) = (Expansion::ONE, number(-0.75));
        let wave = Echoes::new(family, one, number(0.7), ratio, &terms, one).expect("a wave");
        let sum = EchoSum::new(wave, 6).expect("a sum");
        for i in 0..60 {
            let time = DoubleDouble::from(0.05 + 0.1 * f64::from(i));
            let value = |method| in_double(&sum, method, time, Limit::Right).expect("in range");
            let right = value(Method::DoubleDouble);
            for method in [Method::Expanded, Method::Plain] {
                assert!((value(method) - right).abs() < 1e-13, "{family:?}, {method:?}: {time:?}");
            }
        }
    }
}

/// What the double of `e^{−1}` lacks.
#[test]
fn pairs_are_not_rounded() {
    let sum = rigid_mass(number(2.0), 3);
    let pair =
        sum.pair(Method::DoubleDouble, DoubleDouble::from(1.0), Limit::Right).expect("in range");
    assert_eq!(pair.high(), 0.36787944117144233);
    assert!((pair.low() + 1.2428753672788363e-17).abs() < 1e-31);
}

#[test]
fn what_cannot_be_summed_is_refused() {
    let sum = rigid_mass(number(1.0), 5);
    let value = |time| in_double(&sum, Method::Scaled, DoubleDouble::from(time), Limit::Right);
    assert_eq!(value(f64::NAN), Err(EchoError::NotFinite));
    assert_eq!(value(6.0), Err(EchoError::BeyondLast { last: 5 }));
    assert_eq!(value(1e300), Err(EchoError::TimeTooLarge));
    assert_eq!(value(-1.0), Ok(0.0));
    assert!(in_double(&sum, Method::Scaled, DoubleDouble::from(6.0), Limit::Left).is_ok());
    assert_eq!(sum.fill(&[f64::NAN], Limit::Right, &mut [0.0]), Err(EchoError::NotFinite));
    assert_eq!(
        sum.fill(&[1.0], Limit::Right, &mut []),
        Err(EchoError::LengthsDiffer { times: 1, values: 0 })
    );
    assert_eq!(Expansion::try_from(f64::INFINITY), Err(EchoError::NotFinite));
    assert_eq!(Expansion::new([1.0, 1.0, 1.0]).unwrap().parts(), [3.0, 0.0, 0.0]);
    let one = Expansion::ONE;
    let wave = |rate, period, lag| {
        let terms = [Term { lag, coefficient: one }];
        Echoes::new(Family::Laguerre, rate, one, one, &terms, period)
    };
    assert_eq!(wave(one, number(0.0), 0), Err(EchoError::PeriodNotPositive));
    assert_eq!(wave(number(1e100), one, 0), Err(EchoError::BeyondRange));
    assert_eq!(wave(one, one, -2000), Err(EchoError::LagTooLarge { lag: -2000 }));
    let many = EchoSum::new(wave(one, one, 0).expect("fine"), usize::MAX);
    assert_eq!(many.unwrap_err(), EchoError::TooManyEchoes { last: usize::MAX });
}
