//! Decimals and balls against the rational numbers that they stand for.

use crate::bytes::Bytes;
use num_bigint::BigInt;
use num_integer::Integer as _;
use num_rational::BigRational;
use num_traits::{One as _, Signed as _, Zero as _};
use wavestep::ball::{
    Ball, Binary, Bound, ComplexBall, Decimal, Exactness, Magnitude, exp_of_rational,
};
use wavestep::language::parse_number;
use wavestep::signal::Value;

fn read(text: &str) -> BigRational {
    parse_number(text).unwrap_or_else(|error| panic!("{error}"))
}

/// `|value − decimal|` is at most half a unit of the last digit, and a tie is even.
fn assert_nearest(decimal: &Decimal, value: &BigRational) {
    let unit = BigRational::from_integer(10.into()).pow(decimal.place() as i32);
    let doubled = (decimal.to_rational() - value).abs() * BigInt::from(2);
    assert!(doubled <= unit, "{decimal} for {value}");
    let is_even = || (decimal.to_rational() / &unit).to_integer().is_even();
    assert!(doubled < unit || is_even(), "{decimal} for {value}");
}

pub fn decimals(data: &[u8]) {
    let mut bytes = Bytes(data);
    let value = &bytes.rational(40);
    let significant = 1 + bytes.below(60) as usize;
    let (decimal, exactness) = Decimal::from_rational(value, significant);
    for text in [decimal.to_string(), format!("{decimal:e}"), format!("{decimal:+e}")] {
        assert_eq!(read(&text), decimal.to_rational(), "{text}");
    }
    assert_eq!(exactness == Exactness::Exact, decimal.to_rational() == *value);
    assert!(decimal.significant() <= significant);
    if exactness == Exactness::Rounded {
        assert_eq!(decimal.significant(), significant);
        assert_nearest(&decimal, value);
    }
    let [low, high] = [Bound::Lower, Bound::Upper]
        .map(|bound| Decimal::bound(value, significant, bound).to_rational());
    assert!(low <= *value && *value <= high, "{low} {value} {high}");
    let exact = Value::Exact(value.clone());
    let told = exact.to_text(significant);
    let parts: Vec<&str> = told.split(" = ").collect();
    assert!(parts[1..].iter().all(|fraction| read(fraction) == *value), "{told}");
    // The nearest double is as near as its neighbours.
    let double = exact.to_f64();
    if double.is_finite() {
        let away = |double: f64| BigRational::from_float(double).map(|near| (near - value).abs());
        let nearest = away(double).expect("finite");
        for neighbour in [double.next_up(), double.next_down()] {
            assert!(away(neighbour).is_none_or(|away| nearest <= away), "{double:e} for {value}");
        }
    }
    let (ball, point) = ball_and_point(&mut bytes);
    let enclosure = ball.to_decimal(significant);
    let told = enclosure.to_string();
    let (midpoint, radius) = told.split_once(" ± ").unwrap_or((&told, "0"));
    assert!((read(midpoint) - &point).abs() <= read(radius), "{told} for {point}");
    if let Some(proven) = ball.proven_digits(significant) {
        assert_nearest(&proven, &point);
    }
    let (double, error) = ball.to_double();
    if let Some(double) = BigRational::from_float(double) {
        assert!((double - &point).abs() <= BigRational::from(&error), "{ball:?}");
    }
}

/// A ball and one of its points.
fn ball_and_point(bytes: &mut Bytes<'_>) -> (Ball, BigRational) {
    let midpoint = Binary::new(bytes.integer(24), bytes.about_zero(100) - 60);
    let radius = match bytes.below(4) {
        0 => Magnitude::ZERO,
        _ => Magnitude::from_u64(bytes.word() >> 32).scale(bytes.about_zero(150) - 60),
    };
    let ball = Ball::new(midpoint, radius);
    let share = BigRational::new(bytes.about_zero(256).into(), 256.into());
    let point = BigRational::from(ball.midpoint()) + BigRational::from(&radius) * share;
    (ball, point)
}

/// Whether two balls have a number in common.
fn meet(one: &Ball, other: &Ball) -> bool {
    let distance = BigRational::from(one.midpoint()) - BigRational::from(other.midpoint());
    distance.abs() <= BigRational::from(one.radius()) + BigRational::from(other.radius())
}

/// A program of operations on balls, each of which keeps a point.
pub fn balls(data: &[u8]) {
    let mut bytes = Bytes(data);
    let mut stack = vec![ball_and_point(&mut bytes), ball_and_point(&mut bytes)];
    for _ in 0..12 {
        if bytes.is_empty() {
            break;
        }
        let (precision, operation) = (2 + bytes.below(198), bytes.below(16));
        if operation == 0 || stack.len() < 2 {
            stack.push(ball_and_point(&mut bytes));
            continue;
        }
        let (a, x) = stack.pop().expect("two balls");
        let (b, y) = stack.last().expect("another ball").clone();
        let result = match operation {
            1 => Some((a.add(&b, precision), &x + &y)),
            2 => Some((a.subtract(&b, precision), &x - &y)),
            3 => Some((a.multiply(&b, precision), &x * &y)),
            4 => Some((a.square(precision), &x * &x)),
            5 => Some((a.clone().round(precision), x.clone())),
            6 => {
                let factor = bytes.rational(12);
                Some((a.multiply_rational(&factor, precision), &x * &factor))
            }
            7 => {
                let inverse = a.reciprocal(precision);
                assert!(inverse.is_ok() || a.contains_zero());
                inverse.ok().map(|inverse| (inverse, x.recip()))
            }
            8 => Some((
                Ball::between(&(&x).min(&y).clone(), &(&x).max(&y).clone(), precision),
                x.clone(),
            )),
            9 => {
                let (lower, upper) = a.endpoints();
                assert!(BigRational::from(&lower) <= x && x <= BigRational::from(&upper));
                assert!(BigRational::from(&a.magnitude()) >= x.abs());
                assert!(a.smallest_size() <= x.abs());
                assert!(a.sign().is_none_or(|sign| x.cmp(&BigRational::zero()) == sign));
                Some((a.negate(), -&x))
            }
            10 => {
                let (c, d) = (ComplexBall::new(a.clone(), b.clone()), ComplexBall::new(b, a));
                let product = c.multiply(&d, precision);
                assert!(product.real().contains(&BigRational::zero()));
                Some((product.imaginary().clone(), &x * &x + &y * &y))
            }
            _ => {
                functions(&a, &x, precision, operation);
                None
            }
        };
        if let Some((ball, point)) = result {
            assert!(ball.contains(&point), "{operation} at {precision} bits: {ball:?} {point}");
            // Longer points only take longer.
            if point.numer().bits() + point.denom().bits() < 2000 {
                stack.push((ball, point));
            }
        }
    }
}

/// Functions whose values are irrational: by their equations, and against balls around the point alone.
fn functions(a: &Ball, x: &BigRational, precision: u64, operation: u64) {
    let one = BigRational::one();
    // Larger ones only take longer: an exponential of 2^12 has as many bits before the point.
    if a.magnitude() > Magnitude::power_of_two(12) || precision > 120 && operation < 13 {
        return;
    }
    let alone = Ball::from_rational(x, 160);
    match operation {
        11 => {
            let (Ok(up), Ok(down)) = (a.exp(precision), a.clone().negate().exp(precision)) else {
                panic!("the exponential of {a:?}")
            };
            assert!(up.multiply(&down, precision).contains(&one), "{a:?}");
            assert!(meet(&up, &exp_of_rational(x, precision + 40).expect("small")), "{a:?}");
        }
        12 => {
            let (cos, sin) = a.cos_sin(precision).expect("small");
            assert!(cos.square(precision).add(&sin.square(precision), precision).contains(&one));
            let (near, other) = alone.cos_sin(precision + 40).expect("small");
            assert!(meet(&cos, &near) && meet(&sin, &other), "{a:?}");
        }
        13 => {
            let root = a.sqrt(precision);
            if let Some(root) = root.filter(|_| !x.is_negative()) {
                assert!(root.square(precision + 8).contains(x), "{a:?}");
            }
        }
        14 if a.sign() == Some(std::cmp::Ordering::Greater) => {
            let logarithm = a.ln(precision).expect("positive");
            assert!(meet(&logarithm, &alone.ln(precision + 40).expect("positive")), "{a:?}");
            let half = BigRational::new(1.into(), 2.into());
            let (Ok(power), Ok(root)) = (logarithm.exp(precision), a.power(&half, precision))
            else {
                // The logarithm of a ball that nearly touches zero.
                return assert!(logarithm.magnitude() > Magnitude::power_of_two(20), "{a:?}");
            };
            assert!(power.contains(x) && root.square(precision + 8).contains(x), "{a:?}");
        }
        15 => {
            let angle = a.arctan(precision).expect("an angle");
            assert!(meet(&angle, &alone.arctan(precision + 40).expect("an angle")), "{a:?}");
        }
        _ => {}
    }
}
