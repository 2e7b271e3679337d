//! The march in fixed point against sums of Laguerre polynomials with hundreds to thousands of
//! bits, its doubles against the rounded sums, and reductions and roundings against rationals.

mod spans;
pub mod support;

use crate::random::Random;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use support::{Echoes, integer, ratio};
use wavestep_kernels::Limit;
use wavestep_kernels::fixed::{
    DelayEquation, FRACTION_BITS, FixedError, March, MarchOptions, Position, Reduction, Tap,
    certified, round_to_double,
};

/// What comparisons have seen.
#[derive(Default)]
struct Seen {
    comparisons: usize,
    /// The largest share of a radius that an error took.
    share: f64,
}

/// Compares a march with the exact solution at `s + nD`, for random s, in all periods.
fn compare(equation: &Echoes, periods: u32, places: u32, samples: &mut Random, seen: &mut Seen) {
    let march = equation.march(periods, &MarchOptions::default());
    for place in 0..places {
        // The ends of the period, the ends of pieces, and places in between.
        let pieces = u64::from(march.pieces_per_period());
        let part = match place {
            0 => ratio(0, 1),
            1 => ratio(1, 1),
            2 => ratio((samples.bits() % pieces) as i64, pieces as i64),
            3 => ratio((samples.bits() % 999) as i64 + 1, 1000),
            _ => ratio((samples.bits() % (1 << 20)) as i64, 1 << 20),
        };
        let reduction = Reduction::new(&equation.period, &BigRational::zero()).unwrap();
        // At the end of a period the sum over the echoes so far is the limit from the left.
        let side = if part.is_one() { Limit::Left } else { Limit::Right };
        for (period, exact) in (0..periods).zip(equation.solution(&part, periods)) {
            let time = (&part + integer(period.into())) * &equation.period;
            let position = reduction.of_rational(&time, side).unwrap().unwrap();
            assert_eq!(position.period, period);
            let value = march.value(&position).unwrap();
            let error = equation.error(&value, &exact, equation.bits(periods));
            let share = error / value.radius as f64;
            assert!(share <= 1.0, "period {period}, place {part}: {share} of the radius");
            seen.comparisons += 1;
            seen.share = seen.share.max(share);
        }
    }
}

#[test]
fn rigid_masses_are_within_the_bound() {
    let (mut samples, mut seen) = (Random(1), Seen::default());
    for round in 0..60 {
        // mu from 1/100 to 10, evenly in its logarithm, as a hundredth.
        let hundredths = 1000f64.powf((samples.bits() % 1000) as f64 / 999.0).round() as i64;
        let most = if round % 10 == 0 { 300 } else { 30 + samples.bits() % 120 };
        let periods = most.min(60_000 / (20 + hundredths.unsigned_abs())) as u32;
        let equation = Echoes::new(ratio(hundredths, 50), ratio(1, 1), ratio(1, 1), ratio(1, 1));
        compare(&equation, periods, 8, &mut samples, &mut seen);
        assert!(equation.march(periods, &MarchOptions::default()).bound() < 1e-25);
    }
    // The far corner: mu = 10 to n = 300.
    let far = Echoes::new(ratio(20, 1), ratio(1, 1), ratio(1, 1), ratio(1, 1));
    compare(&far, 300, 3, &mut samples, &mut seen);
    println!("{} comparisons, errors at most {:.3} of the radius", seen.comparisons, seen.share);
    assert!(seen.comparisons >= 30_000 && seen.share > 1e-7);
}

#[test]
fn other_equations_are_within_the_bound() {
    let (mut samples, mut seen) = (Random(2), Seen::default());
    for (rate, zero, reflection, periods) in [
        // A passive end that absorbs, with an exact and a rounded reflection.
        (ratio(1, 1), ratio(1, 1), ratio(1, 2), 150),
        (ratio(3, 2), ratio(1, 3), ratio(-2, 3), 150),
        // A change of sign at every return.
        (ratio(1, 1), ratio(1, 1), ratio(-1, 1), 200),
        (ratio(7, 5), ratio(7, 5), ratio(-1, 1), 100),
        // Negative zeros; the second one cancels the pole.
        (ratio(2, 1), ratio(-1, 2), ratio(1, 1), 150),
        (ratio(2, 1), ratio(-2, 1), ratio(1, 1), 100),
        (ratio(1, 1), ratio(-1, 1), ratio(3, 7), 100),
        // A zero at the origin: a spring, or a dashpot beside the mass.
        (ratio(1, 1), ratio(0, 1), ratio(1, 1), 150),
        (ratio(1, 1), ratio(0, 1), ratio(-9, 10), 150),
        // Not passive: the solution grows.
        (ratio(1, 1), ratio(3, 2), ratio(1, 1), 6),
        (ratio(1, 1), ratio(2, 1), ratio(-1, 1), 5),
        (ratio(1, 2), ratio(-1, 1), ratio(1, 1), 5),
        // No echo at all.
        (ratio(1, 1), ratio(1, 1), ratio(0, 1), 4),
    ] {
        for period in [ratio(1, 3), ratio(1, 1), ratio(27, 10)] {
            let equation = Echoes::new(period, rate.clone(), zero.clone(), reflection.clone());
            compare(&equation, periods, 6, &mut samples, &mut seen);
        }
    }
    println!("{} comparisons, errors at most {:.3} of the radius", seen.comparisons, seen.share);
    assert!(seen.comparisons >= 20_000);
}

/// Coarse cuts have large bounds, which hold as well and are not idle.
#[test]
fn coarse_marches_are_within_their_bounds() {
    let (mut samples, mut largest) = (Random(3), 0.0f64);
    let equation = Echoes::new(ratio(2, 1), ratio(1, 1), ratio(1, 1), ratio(1, 1));
    for (pieces, terms) in [(4, 20), (8, 16), (16, 12), (16, 14), (32, 10)] {
        let options = MarchOptions { pieces: Some(pieces), terms: Some(terms) };
        let periods = 8;
        let march = equation.march(periods, &options);
        assert!(march.bound() > 1e-25, "{pieces} {terms}");
        for _ in 0..40 {
            let part = ratio((samples.bits() % 4096) as i64, 4096);
            let fraction = (part.clone() * integer(1 << 60)).to_integer().to_u128().unwrap() << 60;
            for (period, exact) in (0..periods).zip(equation.solution(&part, periods)) {
                let value = march.value(&Position::exact(period, fraction).unwrap()).unwrap();
                let share =
                    equation.error(&value, &exact, equation.bits(periods)) / value.radius as f64;
                assert!(share <= 1.0, "{pieces} {terms} {period}");
                largest = largest.max(share);
            }
        }
    }
    println!("errors at most {largest:.3} of the radius");
    assert!(largest > 1e-3);
}

#[test]
fn what_cannot_be_marched_is_refused() {
    let [zero, one, two] = [0, 1, 2].map(integer);
    let refused =
        |period, rate, reflection| DelayEquation::new(period, rate, &one, reflection).unwrap_err();
    assert_eq!(refused(&zero, &one, &one), FixedError::PeriodNotPositive);
    assert_eq!(refused(&one, &zero, &one), FixedError::RateNotPositive);
    assert_eq!(refused(&one, &one, &two), FixedError::ReflectionTooLarge);
    let equation = DelayEquation::new(&one, &one, &one, &one).unwrap();
    let refused = |periods, pieces, terms| {
        March::new(&equation, periods, &MarchOptions { pieces, terms }).unwrap_err()
    };
    assert_eq!(refused(0, None, None), FixedError::NoPeriods);
    assert_eq!(refused(3, Some(3), None), FixedError::InvalidPieces(3));
    assert_eq!(refused(3, None, Some(65)), FixedError::InvalidTerms(65));
    assert_eq!(refused(u32::MAX, None, None), FixedError::TooLarge);
    assert_eq!(Position::exact(7, (1 << 120) + 1), Err(FixedError::PositionOutside));
}

/// Values that leave the range are refused; nothing wraps around.
#[test]
fn growing_solutions_are_refused() {
    for (zero, periods) in [(ratio(3, 1), 40), (ratio(-9, 1), 40), (ratio(100, 1), 300)] {
        let equation = Echoes::new(ratio(2, 1), ratio(1, 1), zero, ratio(1, 1));
        let refused = March::new(&equation.equation(), periods, &MarchOptions::default());
        assert!(matches!(refused, Err(FixedError::Overflow { .. } | FixedError::NotProven { .. })));
    }
}

#[test]
fn pieces_meet_and_jumps_have_the_right_size() {
    for reflection in [ratio(1, 1), ratio(-1, 1), ratio(1, 2)] {
        let equation = Echoes::new(ratio(1, 1), ratio(2, 1), ratio(1, 3), reflection);
        let march = equation.march(20, &MarchOptions::default());
        let pieces = march.pieces_per_period();
        let end = |period, piece| march.piece(period, piece).unwrap().iter().sum::<i128>();
        let start = |period, piece| {
            let signed = |(m, value): (usize, &i128)| if m % 2 == 0 { *value } else { -*value };
            let coefficients = march.piece(period, piece).unwrap();
            coefficients.iter().enumerate().map(signed).sum::<i128>()
        };
        let mut jump = (1i128 << FRACTION_BITS) as f64;
        for period in 0..20 {
            let before = if period == 0 { 0 } else { end(period - 1, pieces - 1) };
            assert!(((start(period, 0) - before) as f64 - jump).abs() < 1e6);
            for piece in 1..pieces {
                assert!((start(period, piece) - end(period, piece - 1)).abs() < 1000);
            }
            jump *= equation.reflection.to_f64().unwrap();
        }
        assert_eq!(march.piece(0, pieces), None);
        assert_eq!(march.piece(20, 0), None);
        assert_eq!(march.bound_of(20), None);
        let late = march.value(&Position::exact(20, 0).unwrap());
        assert_eq!(late, Err(FixedError::BeyondMarch { period: 20, periods: 20 }));
    }
}

/// A radius is at least the bound; one of a rounded position also covers what the next unit of the
/// position changes.
#[test]
fn radii_cover_the_rounding_of_positions() {
    let equation = Echoes::new(ratio(3, 1), ratio(1, 1), ratio(1, 1), ratio(1, 1));
    let march = equation.march(60, &MarchOptions::default());
    let reduction = Reduction::new(&equation.period, &BigRational::zero()).unwrap();
    let mut samples = Random(8);
    for period in 0..60 {
        let part = ratio((samples.bits() % 1000) as i64 * 3 + 1, 3000);
        let time = (part + integer(period)) * &equation.period;
        let rounded = reduction.of_rational(&time, Limit::Right).unwrap().unwrap();
        assert!(!rounded.exact);
        let value = march.value(&rounded).unwrap();
        let unit = (-f64::from(FRACTION_BITS)).exp2();
        assert!(value.radius as f64 * unit > march.bound_of(period as u32).unwrap());
        let exact = |offset| {
            let position = Position::exact(period as u32, rounded.fraction + offset).unwrap();
            march.value(&position).unwrap()
        };
        let (here, next) = (exact(0), exact(1));
        assert_eq!((here.midpoint, here.radius), (value.midpoint, next.radius));
        assert!(next.midpoint.abs_diff(here.midpoint) <= value.radius - here.radius);
    }
}

/// The double nearest to an exact number.
fn nearest(exact: &BigInt, bits: u64) -> f64 {
    // Rounded correctly whether the fraction is in lowest terms or not, and that would take long.
    BigRational::new_raw(exact.clone(), BigInt::one() << bits).to_f64().unwrap()
}

/// Doubles of the solution, the velocity and the strain at the fixed end, at random times that are
/// doubles, in all periods to 200.
#[test]
fn certified_doubles_are_the_rounded_exact_values() {
    let mut samples = Random(4);
    let (mut decided, mut undecided) = (0, 0);
    for (mu, periods, rounds) in
        [(ratio(1, 1), 200, 30), (ratio(3, 64), 250, 10), (ratio(5, 2), 60, 10)]
    {
        let period = &mu * integer(2);
        let (one, zero) = (ratio(1, 1), BigRational::zero());
        let echoes = Echoes::new(period.clone(), one.clone(), one.clone(), one.clone());
        let tap = |weight: i64, delay: &BigRational| Tap {
            weight: integer(weight),
            delay: delay.clone(),
        };
        let solution = [tap(1, &zero)];
        let velocity = [tap(1, &zero), tap(-1, &period)];
        let strain = [tap(-2, &mu)];
        for _ in 0..rounds {
            // A place that keeps every time in 53 bits, and is in the first half of the period.
            let part = ratio((samples.bits() >> 24) as i64, 1 << 40) / integer(2);
            let half = ratio(1, 2);
            let times: Vec<f64> = (0..periods)
                .flat_map(|n| [&part + integer(n.into()), &part + &half + integer(n.into())])
                .map(|periods| {
                    let time = periods * &period;
                    let double = time.to_f64().unwrap();
                    assert_eq!(BigRational::from_float(double), Some(time));
                    double
                })
                .collect();
            let early = echoes.solution(&part, periods);
            let late = echoes.solution(&(&part + &half), periods);
            let exact: Vec<BigInt> =
                early.into_iter().zip(late).flat_map(|(a, b)| [a, b]).collect();
            let at = |index: usize, back: usize| match index.checked_sub(back) {
                Some(index) => exact[index].clone(),
                None => BigInt::zero(),
            };
            for (taps, sum) in [
                (&solution[..], &(|index| at(index, 0)) as &dyn Fn(usize) -> BigInt),
                (&velocity, &|index| at(index, 0) - at(index, 2)),
                (&strain, &|index| at(index, 1) * -2),
            ] {
                let results = certified(&echoes.equation(), taps, &times, Limit::Right).unwrap();
                for (index, value) in results.values.iter().enumerate() {
                    let exact = nearest(&sum(index), echoes.bits(periods));
                    if results.undecided.contains(&index) {
                        undecided += 1;
                        assert!((value - exact).abs() <= 1e-15);
                    } else {
                        decided += 1;
                        assert_eq!(*value, exact, "{index} at {}", times[index]);
                    }
                }
            }
        }
    }
    println!("{decided} decided, {undecided} undecided");
    assert!(decided >= 50_000 && undecided * 1_000_000 <= decided);
}

/// Periods that are no doubles, times that are any doubles.
#[test]
fn certified_doubles_hold_for_any_times() {
    let mut samples = Random(5);
    for (period, rate) in [(ratio(2, 3), ratio(1, 1)), (ratio(7, 10), ratio(9, 7))] {
        let echoes = Echoes::new(period.clone(), rate.clone(), rate, ratio(1, 1));
        let taps = [
            Tap { weight: ratio(1, 3), delay: BigRational::zero() },
            Tap { weight: ratio(-22, 7), delay: &period / integer(4) },
        ];
        let times: Vec<f64> =
            (0..60).map(|_| (samples.bits() >> 11) as f64 / (1u64 << 53) as f64 * 30.0).collect();
        let results = certified(&echoes.equation(), &taps, &times, Limit::Right).unwrap();
        assert!(results.undecided.is_empty());
        for (time, value) in times.iter().zip(&results.values) {
            let time = BigRational::from_float(*time).unwrap();
            let sum = taps.iter().fold(BigRational::zero(), |sum, tap| {
                let periods = (&time - &tap.delay) / &period;
                if periods.is_negative() {
                    return sum;
                }
                let count = periods.floor().to_integer().to_u32().unwrap() + 1;
                let exact = echoes.solution(&periods.fract(), count).pop().unwrap();
                sum + BigRational::new(exact, BigInt::one() << echoes.bits(count)) * &tap.weight
            });
            assert_eq!(sum.to_f64().unwrap(), *value, "{time}");
        }
    }
}

/// Times in any order have the doubles that a march with shorter pieces gives, which is held as a
/// whole: 201 periods of the rigid mass, μ = 1, seen twice.
#[test]
fn sums_are_those_of_a_march_that_is_held() {
    let [one, two] = [ratio(1, 1), ratio(2, 1)];
    let equation = DelayEquation::new(&two, &one, &one, &one).unwrap();
    let tap = |weight: i64, delay: i64| Tap { weight: ratio(weight, 1), delay: ratio(delay, 2) };
    let times: Vec<f64> = (0..200).map(|i| f64::from(i * 77 % 200) * 2.01 - 3.0).collect();
    let taps = [tap(1, 0), tap(-3, 5)];
    let found = certified(&equation, &taps, &times, Limit::Right).unwrap();
    let march = March::new(&equation, 201, &MarchOptions::default()).unwrap();
    assert_eq!(march.pieces_per_period(), 32);
    let seen = [(1_i128, 0), (-3, 5)];
    for (time, value) in times.iter().zip(&found.values) {
        let (mut sum, mut radius) = (0, 0);
        for (weight, delay) in seen {
            let reduction = Reduction::new(&two, &ratio(delay, 2)).unwrap();
            let Some(position) = reduction.of_double(*time, Limit::Right).unwrap() else {
                continue;
            };
            let part = march.value(&position).unwrap();
            sum += weight * part.midpoint;
            radius += weight.unsigned_abs() * part.radius;
        }
        let expected = round_to_double(sum, radius, i64::from(FRACTION_BITS));
        assert_eq!(Some(*value), expected, "{time}");
    }
    assert!(found.undecided.is_empty());
}

#[test]
fn sums_before_the_start_are_zero_and_sides_are_told_apart() {
    let [one, two] = [1, 2].map(integer);
    let equation = DelayEquation::new(&two, &one, &one, &one).unwrap();
    let taps = [Tap { weight: ratio(-1, 1), delay: one.clone() }];
    let times = [-1.0, 0.0, 0.5, 1.0, 3.0];
    let left = certified(&equation, &taps, &times, Limit::Left).unwrap();
    let right = certified(&equation, &taps, &times, Limit::Right).unwrap();
    assert_eq!(left.values[..4], [0.0; 4]);
    assert_eq!(right.values[..4], [0.0, 0.0, 0.0, -1.0]);
    // At T = 3 the wave returns: e^(-2), and 1 more after it.
    assert_eq!(left.values[4], -0.1353352832366127);
    assert_eq!(right.values[4], "-1.1353352832366126918939995".parse().unwrap());
    assert!(left.undecided.is_empty() && right.undecided.is_empty());

    // Two equal taps cancel: zero with a radius is undecided; no tap is zero exactly.
    let cancelling = [taps[0].clone(), Tap { weight: one.clone(), delay: one.clone() }];
    let cancelled = certified(&equation, &cancelling, &[0.0, 2.0], Limit::Right).unwrap();
    assert_eq!((cancelled.values[0], &cancelled.undecided[..]), (0.0, &[1][..]));
    let nothing = certified(&equation, &[], &[2.0], Limit::Right).unwrap();
    assert_eq!((nothing.values, nothing.undecided), (vec![0.0], vec![]));

    // Weights of any size keep the digits.
    let huge =
        [Tap { weight: BigRational::from(BigInt::one() << 900u32), delay: BigRational::zero() }];
    let tiny = [Tap { weight: huge[0].weight.recip(), delay: BigRational::zero() }];
    let value = 0.6065306597126334;
    let scaled = |taps: &[Tap]| certified(&equation, taps, &[0.5], Limit::Right).unwrap().values[0];
    assert_eq!(scaled(&huge), value * 900f64.exp2());
    assert_eq!(scaled(&tiny), value * (-900f64).exp2());

    let refused =
        |taps: &[Tap], times: &[f64]| certified(&equation, taps, times, Limit::Right).unwrap_err();
    assert_eq!(refused(&vec![taps[0].clone(); 9], &[1.0]), FixedError::TooManyTaps(9));
    assert_eq!(refused(&taps, &[f64::NAN]), FixedError::TimeNotFinite);
    assert_eq!(refused(&[], &[f64::INFINITY]), FixedError::TimeNotFinite);
    assert_eq!(refused(&taps, &[1e300]), FixedError::TimeTooLate);
    assert_eq!(refused(&taps, &[1e9]), FixedError::TooLarge);
}

/// The words' way and the rationals' way agree, and both enclose the place.
#[test]
fn reductions_are_exact() {
    let mut samples = Random(6);
    let mut joints = 0;
    for round in 0..30_000 {
        let small = |samples: &mut Random, bits: u32| (samples.bits() >> (64 - bits)) as i64 + 1;
        let length = 1 + (samples.bits() % 31) as u32;
        let period = ratio(small(&mut samples, length), small(&mut samples, length));
        let delay = ratio(small(&mut samples, length) - 1, small(&mut samples, length.min(12)));
        let reduction = Reduction::new(&period, &delay).unwrap();
        let time = match round % 4 {
            0 => f64::from_bits(samples.bits() >> 2),
            1 => -(samples.bits() as f64),
            2 => (delay.clone() + &period * integer(small(&mut samples, 8))).to_f64().unwrap(),
            _ => {
                samples.bits() as f64 / (small(&mut samples, 40) as f64)
                    * period.to_f64().unwrap()
                    * 1e-6
            }
        };
        let rational = BigRational::from_float(time).unwrap();
        for side in [Limit::Left, Limit::Right] {
            let found = reduction.of_double(time, side);
            assert_eq!(found, reduction.of_rational(&rational, side), "{time} {period} {delay}");
            let exact = (&rational - &delay) / &period;
            match found {
                Err(error) => {
                    assert_eq!(error, FixedError::TimeTooLate);
                    assert!(exact > integer((1 << 32) - 2));
                }
                Ok(None) => assert!(
                    exact <= integer(if side == Limit::Left { 0 } else { -1 })
                        || exact.is_negative()
                ),
                Ok(Some(position)) => {
                    let fraction = BigRational::new(position.fraction.into(), BigInt::one() << 120);
                    let excess = exact - integer(position.period.into()) - fraction;
                    let unit = BigRational::new(BigInt::one(), BigInt::one() << 120);
                    assert_eq!(excess.is_zero(), position.exact);
                    assert!(!excess.is_negative() && excess < unit);
                    let end = position.fraction == 1 << 120;
                    assert!(!end || side == Limit::Left);
                    assert!(side == Limit::Right || position.fraction > 0 || !position.exact);
                    joints += usize::from(end);
                }
            }
        }
    }
    println!("{joints} times on joints");
    assert!(joints > 500);
}

#[test]
fn roundings_agree_with_exact_rationals() {
    let mut samples = Random(7);
    let (mut decided, mut ties) = (0, 0);
    for _ in 0..60_000 {
        let length = samples.bits() % 128;
        let word = (u128::from(samples.bits()) << 64 | u128::from(samples.bits())) >> length;
        let mut value = word as i128;
        let fraction_bits = match samples.bits() % 4 {
            0 => 112,
            1 => 1074 + (samples.bits() % 130) as i64,
            2 => -1024 + (samples.bits() % 140) as i64,
            _ => (samples.bits() % 2400) as i64 - 1200,
        };
        // Ties of normal doubles, and their neighbours.
        let shift = 1 + (samples.bits() % 60) as u32;
        if samples.bits().is_multiple_of(3) {
            let significand = i128::from((samples.bits() | 1 << 63) >> 11);
            value = (significand << shift | 1 << (shift - 1)) + (samples.bits() % 3) as i128 - 1;
        }
        let radius = match samples.bits() % 3 {
            0 => 0,
            1 => u128::from(samples.bits() % 4),
            _ => u128::from(samples.bits()) >> (samples.bits() % 64),
        };
        let exact = |offset: i128| {
            let value = BigInt::from(value) + offset;
            let power = BigInt::one() << fraction_bits.unsigned_abs();
            match fraction_bits < 0 {
                true => BigRational::from(value * power),
                false => BigRational::new(value, power),
            }
        };
        let (low, high) = (exact(-(radius as i128)), exact(radius as i128));
        let ends = [&low, &high].map(|end| end.to_f64().unwrap());
        // A tie at an end has two neighbours at the same distance.
        let tie = [&low, &high].iter().zip(ends).any(|(end, double)| {
            let distance =
                |double: f64| BigRational::from_float(double).map(|double| (double - *end).abs());
            let here = distance(double);
            here.as_ref().is_some_and(|distance| !distance.is_zero())
                && (distance(double.next_up()) == here || distance(double.next_down()) == here)
        });
        let zero = low.is_zero() && high.is_zero();
        let sign = zero || low.is_positive() || high.is_negative();
        let one = ends[0].to_bits() == ends[1].to_bits() && ends[0].is_finite();
        let expected = (one && sign && !tie || zero).then_some(ends[0]);
        let expected = expected.map(|double| if value < 0 { -double.abs() } else { double });
        let found = round_to_double(value, radius, fraction_bits);
        assert_eq!(
            found.map(f64::to_bits),
            expected.map(f64::to_bits),
            "{value} ± {radius}, {fraction_bits}: {found:?} {expected:?}"
        );
        decided += usize::from(found.is_some());
        ties += usize::from(tie);
    }
    println!("{decided} decided, {ties} ties");
    assert!(decided > 10_000 && ties > 1000);
    for fraction_bits in [i64::MIN, i64::MAX] {
        let found = round_to_double(3, 1, fraction_bits);
        assert_eq!(found, if fraction_bits > 0 { Some(0.0) } else { None });
    }
    assert_eq!(round_to_double(-(3 << 110), 1, FRACTION_BITS.into()), Some(-0.75));
}
