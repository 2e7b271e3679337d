//! Numbers with a definition: where they are, and complex zeros.

use wavestep::ball::{Ball, ComplexBall, Magnitude};
use wavestep::enclosure::Numbers;
use wavestep::expression::{Definition, Fraction};
use wavestep_polynomial::{Rational, Symbol};

#[test]
fn values_are_found_among_ascending_ones() {
    let number = |value: i64| Fraction::constant(&Rational::from_integer(value.into()));
    let pi = Fraction::symbol(&Symbol::new("pi").unwrap());
    let numbers = Numbers::new(&[]);
    let ascending = [number(1), number(3), pi.clone(), number(4)];
    let place = |value: &Fraction| numbers.search(&ascending, value).unwrap();
    assert_eq!((place(&pi), place(&number(4))), (Ok(2), Ok(3)));
    assert_eq!((place(&number(0)), place(&number(2)), place(&number(5))), (Err(0), Err(1), Err(4)));
}

/// Equal values stay in their order; one comparison that fails is the end, however many items there are.
#[test]
fn values_are_sorted_or_refused() {
    let number = |value: i64| Fraction::constant(&Rational::from_integer(value.into()));
    let symbol = |name: &str| Fraction::symbol(&Symbol::new(name).unwrap());
    let numbers = Numbers::new(&[]);
    for count in [0, 1, 2, 3, 64, 301] {
        // Each value five times or so, with its place.
        let items: Vec<(Fraction, i64)> = (0..count).map(|i| (number(i * 7919 % 61), i)).collect();
        let mut expected = items.clone();
        expected.sort_by_key(|(value, _)| value.as_constant());
        let sorted = numbers.sorted(items.clone(), |(value, _)| value).unwrap();
        assert_eq!(sorted, expected, "{count}");
        let mut more = items;
        more.insert(more.len() / 3, (symbol("unknown"), 0));
        assert_eq!(numbers.sorted(more, |(value, _)| value).is_ok(), count == 0);
    }
    let near = vec![number(4), symbol("pi"), number(3)];
    let sorted = numbers.sorted(near, |value| value).unwrap();
    assert_eq!(sorted, [number(3), symbol("pi"), number(4)]);
}

/// `x⁴ + x + 1` has no real zeros; the enclosed one is a zero, and fifty digits of it are known.
#[test]
fn complex_zeros_are_zeros() {
    let number = |value: i64| Fraction::constant(&Rational::from_integer(value.into()));
    let polynomial: Vec<Fraction> = [1, 0, 0, 1, 1].map(number).into();
    let near = (Rational::new(7.into(), 10.into()), Rational::new(9.into(), 10.into()));
    let part = |imaginary| Definition::ComplexZero {
        polynomial: polynomial.clone(),
        near: near.clone(),
        imaginary,
    };
    let numbers = Numbers::new(&[]);
    let [re, im] =
        [false, true].map(|imaginary| numbers.enclose_definition(&part(imaginary), 200).unwrap());
    let z = ComplexBall::new(re.clone(), im.clone());
    let one = ComplexBall::from(Ball::from_rational(&Rational::from_integer(1.into()), 200));
    let square = z.multiply(&z, 200);
    let value = square.multiply(&square, 200).add(&z, 200).add(&one, 200);
    assert!(value.real().contains_zero() && value.imaginary().contains_zero());
    let small = Magnitude::power_of_two(-166);
    assert!(re.radius() <= &small && im.radius() <= &small, "{re} {im}");
}
