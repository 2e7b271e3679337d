//! Rows of limbs against integers of `num-bigint`.

use num_bigint::{BigInt, BigUint};
use num_traits::{One as _, Zero as _};
use proptest::prelude::*;
use wavestep_polynomial::limbs::*;

/// Limbs in which carries run far: zeros, ones, and all of them ones.
fn limb() -> impl Strategy<Value = u64> {
    prop_oneof![Just(0), Just(1), Just(u64::MAX), Just(1 << 63), any::<u64>()]
}

fn row(lengths: std::ops::RangeInclusive<usize>) -> impl Strategy<Value = Vec<u64>> {
    prop::collection::vec(limb(), lengths)
}

fn value(row: &[u64]) -> BigUint {
    row.iter().rev().fold(BigUint::zero(), |above, limb| (above << 64u32) + *limb)
}

/// The row with so many zeros above.
fn with_room(row: &[u64], limbs: usize) -> Vec<u64> {
    [row, &vec![0; limbs]].concat()
}

proptest! {
    #[test]
    fn rows_keep_their_limbs_and_sign(row in row(0..=7), negative: bool) {
        let mut limbs = Limbs::of(&row, negative);
        prop_assert_eq!(&limbs[..], &row[..]);
        prop_assert_eq!(limbs.is_negative(), negative);
        limbs.change_sign();
        prop_assert_eq!(&limbs, &Limbs::of(&row, !negative));
        prop_assert_eq!(natural(&row), value(&row));
    }

    #[test]
    fn rows_are_shifted(row in row(1..=6), bits in 0u32..64) {
        let mut shifted = with_room(&row, 1);
        shift_left(&mut shifted, bits);
        prop_assert_eq!(value(&shifted), value(&row) << bits);
    }

    #[test]
    fn shifted_rows_are_added_and_subtracted(
        one in row(1..=6), other in row(1..=6), place in 1usize..4, bits in 0u32..64
    ) {
        let moved = value(&other) << (64 * place) >> bits;
        let room = (other.len() + place + 1).saturating_sub(one.len()) + 1;
        let mut sum = with_room(&one, room);
        add_shifted(&mut sum, &other, place, bits);
        prop_assert_eq!(value(&sum), value(&one) + &moved);

        let mut rest = with_room(&one, room);
        let is_negative = subtract_shifted(&mut rest, &other, place, bits);
        let exact = BigInt::from(value(&one)) - BigInt::from(moved);
        prop_assert_eq!(is_negative, exact < BigInt::zero());
        prop_assert_eq!(&value(&rest), exact.magnitude());
    }

    #[test]
    fn rows_are_multiplied(one in row(1..=40), other in row(1..=40), factor in limb()) {
        let mut product = vec![0; one.len() + other.len()];
        multiply(&mut product, &one, &other);
        prop_assert_eq!(value(&product), value(&one) * value(&other));
        let mut scaled = with_room(&one, 1);
        scale(&mut scaled, factor);
        prop_assert_eq!(value(&scaled), value(&one) * factor);
    }

    #[test]
    fn rows_are_divided(row in row(1..=6), divisor in prop_oneof![1..=u64::from(u32::MAX), 1..=u64::MAX]) {
        let mut quotient = row.clone();
        let remainder = divide(&mut quotient, divisor);
        prop_assert!(remainder < divisor);
        prop_assert_eq!(value(&quotient) * divisor + remainder, value(&row));
    }

    #[test]
    fn rows_are_rounded_halves_upwards(row in row(1..=6), place in 0usize..6, bit in 0u64..64) {
        let excess = 64 * (place % row.len()) as u64 + bit;
        prop_assume!(excess > 0);
        let unit = BigUint::one() << excess;
        let exact = value(&row);
        let nearest = (&exact + (&unit >> 1u32)) / &unit * &unit;
        let mut rounded = row.clone();
        let (is_rounded, carries) = round(&mut rounded, excess);
        prop_assert_eq!(is_rounded, nearest != exact);
        let above = if carries { BigUint::one() << (64 * row.len()) } else { BigUint::zero() };
        prop_assert_eq!(value(&rounded) + above, nearest);
    }

    #[test]
    fn rows_of_one_length_compare_as_numbers(one in row(3..=3), other in row(3..=3)) {
        prop_assert_eq!(compare(&one, &other), value(&one).cmp(&value(&other)));
    }
}

#[test]
fn buffers_are_zeros_of_the_length_asked_for() {
    for length in [0, 1, 8, 9, 32, 33, 100] {
        in_buffer(length, |buffer| assert_eq!(buffer, &vec![0; length][..]));
    }
}

/// Four limbs stand in place; a longer row takes its bits and what the allocator adds.
#[test]
fn only_long_rows_take_memory_of_their_own() {
    assert_eq!((further_bytes(0), further_bytes(256)), (0, 0));
    assert_eq!((further_bytes(320), further_bytes(640)), (56, 96));
}
