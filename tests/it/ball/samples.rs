//! Random operands for the tests of this folder: balls, and a point of each, now and then an end;
//! and the values of another library.

use astro_float_num::{BigFloat, Consts};
use num_bigint::{BigInt, BigUint, Sign};
use num_rational::BigRational;
use num_traits::One;
use proptest::prelude::*;
use wavestep::ball::{Ball, Binary, Magnitude};

/// Integers of up to `bytes` bytes; short ones and powers of two are frequent.
pub fn integer(bytes: usize) -> BoxedStrategy<BigInt> {
    let any_length = prop::collection::vec(any::<u8>(), 0..=bytes);
    prop_oneof![
        4 => (any::<bool>(), any_length).prop_map(|(negative, bytes)| {
            BigInt::from_bytes_le(if negative { Sign::Minus } else { Sign::Plus }, &bytes)
        }),
        1 => (-3_i64..=3).prop_map(BigInt::from),
        1 => (0..8 * bytes, -1_i64..=1).prop_map(|(bits, more)| (BigInt::one() << bits) + more),
    ]
    .boxed()
}

/// Rationals whose terms have up to `bytes` bytes.
pub fn rational(bytes: usize) -> BoxedStrategy<BigRational> {
    let denominator = integer(bytes).prop_filter("not zero", |value| value != &BigInt::ZERO);
    (integer(bytes), denominator).prop_map(|(above, below)| BigRational::new(above, below)).boxed()
}

pub fn magnitude() -> BoxedStrategy<Magnitude> {
    prop_oneof![
        1 => Just(Magnitude::ZERO),
        6 => (any::<u32>(), -200_i64..100)
            .prop_map(|(value, scale)| Magnitude::from_u64(u64::from(value)).scale(scale)),
    ]
    .boxed()
}

/// A ball and one of its points; a third of the points are ends.
pub fn ball_and_point() -> BoxedStrategy<(Ball, BigRational)> {
    let share = prop_oneof![Just(-256), Just(256), -256_i64..=256, -256_i64..=256];
    (integer(24), -220_i64..60, magnitude(), share)
        .prop_map(|(mantissa, exponent, radius, share)| {
            let ball = Ball::new(Binary::new(mantissa, exponent), radius);
            let offset = BigRational::from(&radius) * BigRational::new(share.into(), 256.into());
            let point = BigRational::from(ball.midpoint()) + offset;
            (ball, point)
        })
        .boxed()
}

/// An enclosure of a function's value at `x` from another library's value of `bits` bits.
pub fn second_opinion(
    x: &Binary,
    bits: usize,
    function: impl Fn(&BigFloat, &mut Consts) -> BigFloat,
) -> Ball {
    let digits: Vec<u64> = x.mantissa().iter_u64_digits().collect();
    let sign =
        if x.is_negative() { astro_float_num::Sign::Neg } else { astro_float_num::Sign::Pos };
    let mut argument = BigFloat::from_words(&digits, sign, 0);
    // The library's numbers are 0.m·2^e with the first bit of m set.
    argument.set_exponent(x.top().unwrap_or(0) as i32);
    let value = function(&argument, &mut Consts::new().unwrap());
    let (words, _, sign, exponent, _) = value.as_raw_parts().unwrap();
    let digits = words.iter().flat_map(|word| [*word as u32, (*word >> 32) as u32]).collect();
    let unit = i64::from(exponent) - 64 * words.len() as i64;
    let sign = if sign == astro_float_num::Sign::Neg { Sign::Minus } else { Sign::Plus };
    let midpoint = Binary::new(BigInt::from_biguint(sign, BigUint::new(digits)), unit);
    let radius = midpoint.magnitude().scale(2 - bits as i64);
    Ball::new(midpoint, radius)
}

/// Whether all of `inner` lies in `outer`.
pub fn includes(outer: &Ball, inner: &Ball) -> bool {
    let distance = outer.midpoint().add(&inner.midpoint().clone().negate());
    let distance = if distance.is_negative() { distance.negate() } else { distance };
    distance.add(&inner.radius().to_binary()) <= outer.radius().to_binary()
}
