//! Enclosures, which all else is compared with, against each other at several precisions, against
//! rational arithmetic, and against a library of floating-point numbers of any length.

use crate::methods::subject::with;
use crate::methods::tally::ends;
use crate::methods::{Values, exact, mass_ratio, random, ratio, times};
use astro_float_num::{BigFloat, Consts, RoundingMode, Sign as FloatSign};
use num_bigint::{BigInt, BigUint, Sign};
use num_rational::BigRational;
use num_traits::{One as _, Signed as _, Zero as _};
use wavestep::language::parse_number;
use wavestep::signal::{Limit, Value};

/// Scenes with observables and ends of windows.
const SCENES: [(&str, Values<'static>, &str, &str); 10] = [
    ("rigid-mass", &[("mu", "3/7")], "velocity", "20"),
    ("pulse-shape", &[("mu", "2")], "force", "14"),
    ("cushioned-impact", &[("mu", "2")], "compression", "9"),
    ("mass-on-fixed-bar", &[("mu", "1/3")], "strain_impact", "6"),
    ("stepped-striker", &[], "pulse", "12"),
    ("pile", &[], "penetration", "6"),
    ("mass-between-bars", &[("m", "2")], "force_wall", "7"),
    ("hopkinson", &[], "gauge_output", "1/2000"),
    ("percussive-drill", &[], "rock_force", "1/2500"),
    ("incommensurate", &[], "wall_force", "1/2000"),
];

/// Two precisions enclose the same number, the higher one more narrowly.
#[test]
fn precision_and_twice_the_precision_agree() {
    let (mut compared, mut inside) = (0, 0);
    let mut widest = BigRational::zero();
    for (scene, values, quantity, last) in SCENES {
        with(scene, values, quantity, ("0", last), |subject| {
            let mut at = times::special(subject);
            at.extend(times::anywhere(subject, &mut random(51), 60));
            for time in at.into_iter().map(exact) {
                for bits in [64, 128, 256] {
                    let coarse = ends(&subject.enclose(&time, Limit::Right, bits));
                    let fine = ends(&subject.enclose(&time, Limit::Right, 2 * bits));
                    let overlap = coarse.0 <= fine.1 && fine.0 <= coarse.1;
                    assert!(overlap, "{bits} bits at {time} in {}", subject.name);
                    let (wide, narrow) = (&coarse.1 - &coarse.0, &fine.1 - &fine.0);
                    assert!(narrow <= wide, "{bits} bits at {time} in {}", subject.name);
                    compared += 1;
                    inside += usize::from(coarse.0 <= fine.0 && fine.1 <= coarse.1);
                    if bits == 256 {
                        widest = widest.clone().max(narrow);
                    }
                }
            }
        });
    }
    let digits = -crate::methods::near(&widest).log10();
    println!(
        "precisions: {compared} comparisons, {inside} inside, 512 bits give {digits:.0} places"
    );
    assert!(compared > 2_000 && inside * 10 > compared * 9 && digits > 60.0);
}

/// The least and the largest of the numbers that `e^x` may be, `x ≥ 0`: the sum of Taylor's series up
/// to a term that is small, and, since each term from the index `2x` on is at most half of the one
/// before, that sum and its last term.
fn exponential(x: &BigRational) -> (BigRational, BigRational) {
    assert!(!x.is_negative());
    let small = BigRational::new(BigInt::one(), BigInt::one() << 230);
    let (mut sum, mut term, mut index) = (BigRational::one(), BigRational::one(), 0);
    while term > small || BigRational::from_integer(index.into()) < x * exact(2.0) {
        index += 1;
        term = term * x / BigRational::from_integer(index.into());
        sum += &term;
    }
    let most = &sum + &term;
    (sum, most)
}

/// `L_k(y)` by its recurrence, exactly.
fn laguerre(k: usize, y: &BigRational) -> BigRational {
    let (mut before, mut now) = (BigRational::zero(), BigRational::one());
    for j in 0..k {
        let whole = |value: usize| BigRational::from_integer(value.into());
        let next = ((whole(2 * j + 1) - y) * &now - whole(j) * &before) / whole(j + 1);
        (before, now) = (now, next);
    }
    now
}

/// `Σ_k e^{−x} L_k(2x)`, `x = T − 2μk ≥ 0`, enclosed in rational numbers.
fn echo_sum(mu: &BigRational, time: &BigRational) -> (BigRational, BigRational) {
    let period = mu * exact(2.0);
    let (mut low, mut high) = (BigRational::zero(), BigRational::zero());
    let mut x = time.clone();
    let mut k = 0;
    while !x.is_negative() {
        let (least, most) = exponential(&x);
        let polynomial = laguerre(k, &(&x * exact(2.0)));
        let (a, b) = (&polynomial / least, &polynomial / most);
        low += a.clone().min(b.clone());
        high += a.max(b);
        x -= &period;
        k += 1;
    }
    (low, high)
}

#[test]
fn enclosures_agree_with_rational_arithmetic() {
    let mut compared = 0;
    for (mu, last) in [("1/4", 20), ("1", 40), ("7/3", 60)] {
        let to = ratio(last, 4).to_string();
        with("rigid-mass", &[("mu", mu)], "f", ("0", &to), |subject| {
            let mu = parse_number(mu).unwrap();
            for quarter in (0..last).map(|i| ratio(i, 4)) {
                let (low, high) = echo_sum(&mu, &quarter);
                assert!(&high - &low < exact(2f64.powi(-180)));
                for bits in [128, 200] {
                    let (least, most) = ends(&subject.enclose(&quarter, Limit::Right, bits));
                    assert!(least <= high && low <= most, "{quarter} with {bits} bits, mu = {mu}");
                    compared += 1;
                }
            }
        });
    }
    println!("rational arithmetic: {compared} comparisons");
    assert_eq!(compared, 240);
}

/// Values that are rational numbers lie in their enclosures.
#[test]
fn rational_values_lie_in_their_enclosures() {
    let mut compared = 0;
    for (scene, values, quantity, last) in [
        ("two-bars", &[("r", "7/3")][..], "force", "30"),
        ("constant-force", &[], "velocity", "30"),
        ("striker-on-long-bar", &[("r", "2/9")], "force", "30"),
        ("stepped-striker", &[], "pulse", "20"),
        ("pushed-bar", &[], "momentum", "20"),
        ("mass-on-fixed-bar", &[("mu", "4")], "strain_fixed", "6"),
    ] {
        with(scene, values, quantity, ("0", last), |subject| {
            for time in times::anywhere(subject, &mut random(52), 60).into_iter().map(exact) {
                if let Value::Exact(number) = subject.by_form(&time, Limit::Right, 30) {
                    let ball = subject.enclose(&time, Limit::Right, 128);
                    assert!(ball.contains(&number), "{time} in {}", subject.name);
                    let told = subject.rational(&time, Limit::Right);
                    assert_eq!(told, Some(number), "{time} in {}", subject.name);
                    compared += 1;
                }
            }
        });
    }
    println!("rational values: {compared} comparisons");
    assert!(compared > 300, "{compared}");
}

const FLOAT_BITS: usize = 448;
const NEAREST: RoundingMode = RoundingMode::ToEven;

fn float(value: &BigRational, constants: &mut Consts) -> BigFloat {
    let mut whole = |value: &BigInt| {
        BigFloat::parse(
            &value.to_string(),
            astro_float_num::Radix::Dec,
            FLOAT_BITS,
            NEAREST,
            constants,
        )
    };
    let (above, below) = (whole(value.numer()), whole(value.denom()));
    above.div(&below, FLOAT_BITS, NEAREST)
}

fn rational(value: &BigFloat) -> BigRational {
    if value.is_zero() {
        return BigRational::zero();
    }
    let (words, _, sign, exponent, _) = value.as_raw_parts().expect("a number");
    let digits = words.iter().flat_map(|word| [*word as u32, (*word >> 32) as u32]).collect();
    let sign = if sign == FloatSign::Neg { Sign::Minus } else { Sign::Plus };
    let mantissa = BigRational::from_integer(BigInt::from_biguint(sign, BigUint::new(digits)));
    // The library's numbers are 0.m · 2^e.
    let shift = i64::from(exponent) - 64 * words.len() as i64;
    let power = BigRational::from_integer(BigInt::one() << shift.unsigned_abs());
    if shift < 0 { mantissa / power } else { mantissa * power }
}

/// The echo sum of the rigid mass in another library's numbers. The recurrence of the polynomials
/// loses at most some hundred of its 448 bits for k ≤ 40 and 2x ≤ 200.
#[test]
fn enclosures_agree_with_another_library() {
    let mut constants = Consts::new().expect("memory");
    let mut random = random(53);
    let tolerance = exact(2f64.powi(-200));
    let mut compared = 0;
    for _ in 0..6 {
        let mu = mass_ratio(&mut random);
        let value = parse_number(&mu).unwrap();
        let last = (&value * exact(40.0)).min(exact(100.0));
        with("rigid-mass", &[("mu", &mu)], "f", ("0", &last.to_string()), |subject| {
            for time in times::anywhere(subject, &mut random, 12).into_iter().map(exact) {
                let mut sum = BigFloat::from_word(0, FLOAT_BITS);
                let mut x = time.clone();
                let mut k = 0_u64;
                while !x.is_negative() {
                    let argument = float(&x, &mut constants);
                    let twice = argument.add(&argument, FLOAT_BITS, NEAREST);
                    let (mut before, mut now) =
                        (BigFloat::from_word(0, FLOAT_BITS), BigFloat::from_word(1, FLOAT_BITS));
                    for j in 0..k {
                        let whole = |value: u64| BigFloat::from_word(value, FLOAT_BITS);
                        let next = whole(2 * j + 1)
                            .sub(&twice, FLOAT_BITS, NEAREST)
                            .mul(&now, FLOAT_BITS, NEAREST)
                            .sub(&whole(j).mul(&before, FLOAT_BITS, NEAREST), FLOAT_BITS, NEAREST)
                            .div(&whole(j + 1), FLOAT_BITS, NEAREST);
                        (before, now) = (now, next);
                    }
                    let decay = argument.neg().exp(FLOAT_BITS, NEAREST, &mut constants);
                    sum = sum.add(&decay.mul(&now, FLOAT_BITS, NEAREST), FLOAT_BITS, NEAREST);
                    x -= &value * exact(2.0);
                    k += 1;
                }
                let other = rational(&sum);
                let (low, high) = ends(&subject.enclose(&time, Limit::Right, 320));
                assert!(&high - &low < tolerance, "{time} for mu = {mu}");
                let inside = low <= &other + &tolerance && &other - &tolerance <= high;
                assert!(inside, "{time} for mu = {mu}");
                compared += 1;
            }
        });
    }
    println!("another library: {compared} comparisons within 2^-200");
    assert_eq!(compared, 72);
}
