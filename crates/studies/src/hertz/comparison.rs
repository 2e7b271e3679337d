//! How far the force in a contact strays from that of the spring with the same unit of time.

use super::error::HertzError;
use super::law::{PowerLaw, Share};
use num_traits::{One, Signed, Zero};
use std::rc::Rc;
use wavestep::ball::Ball;
use wavestep_polynomial::Rational;

/// How often cells are halved at most. What is not narrow enough then is told as wide as it is.
const MAX_LEVELS: usize = 120;

/// Bits beyond those of the digits.
const SPARE_BITS: u64 = 40;

/// A time, with what is known of both forces there.
struct Sample {
    time: Rational,
    contact: Share,
    /// `e^{−t̄}`, what the spring lacks of its largest force.
    spring: Ball,
}

impl Sample {
    fn new(law: &PowerLaw, time: Rational, precision: u64) -> Result<Sample, HertzError> {
        let contact = law.share(&time, precision)?;
        let spring = Ball::from_rational(&-&time, precision).exp(precision)?;
        Ok(Sample { time, contact, spring })
    }

    /// `φ − (1 − e^{−t̄})`.
    fn difference(&self, precision: u64) -> Ball {
        self.spring.subtract(&self.contact.deficit, precision)
    }
}

/// The largest absolute value, and the smallest.
fn sizes([low, high]: &[Rational; 2]) -> [Rational; 2] {
    let largest = low.abs().max(high.abs());
    let smallest = if low.is_negative() && high.is_positive() {
        Rational::zero()
    } else {
        low.abs().min(high.abs())
    };
    [largest, smallest]
}

fn hull(one: &Ball, other: &Ball, precision: u64) -> Ball {
    let ([a, b], [c, d]) = (one.bounds(), other.bounds());
    Ball::between(&a.min(c), &b.max(d), precision)
}

/// A bound on the difference between two times, the second of which may be never.
///
/// Both forces grow, so `e^{−q} − (1 − φ(p)) ≤ D ≤ e^{−p} − (1 − φ(q))`. Between finite times also
/// `D ∈ D(p) + [0, q − p] D'`, `D' = m β^{m−1} (1 − φ) − e^{−t̄}`, whose factors are monotone.
fn largest_between(
    law: &PowerLaw,
    p: &Sample,
    q: Option<&Sample>,
    precision: u64,
) -> Result<Rational, HertzError> {
    let zero = Ball::zero();
    let (late, lacking) = q.map_or((&zero, &zero), |q| (&q.spring, &q.contact.deficit));
    let lowest = late.subtract(&p.contact.deficit, precision);
    let highest = p.spring.subtract(lacking, precision);
    let crude = sizes(&hull(&lowest, &highest, precision).bounds())[0].clone();
    let Some(q) = q else { return Ok(crude) };
    let slope = law.exponent() - Rational::one();
    let power = |sample: &Sample| -> Result<Option<Ball>, HertzError> {
        let compression = &sample.contact.compression;
        match (slope.is_zero(), zero.is_below(compression), slope.is_positive()) {
            (true, ..) => Ok(Some(Ball::from_rational(&Rational::one(), 4))),
            (_, true, _) => Ok(Some(compression.power(&slope, precision)?)),
            (_, false, true) => Ok(Some(Ball::zero())),
            (_, false, false) => Ok(None),
        }
    };
    let (Some(first), Some(last)) = (power(p)?, power(q)?) else { return Ok(crude) };
    let rise = hull(&first, &last, precision)
        .multiply(&hull(&p.contact.deficit, &q.contact.deficit, precision), precision)
        .multiply_rational(law.exponent(), precision)
        .subtract(&hull(&p.spring, &q.spring, precision), precision);
    let way = Ball::between(&Rational::zero(), &(&q.time - &p.time), precision);
    let fine = p.difference(precision).add(&rise.multiply(&way, precision), precision);
    Ok(crude.min(sizes(&fine.bounds())[0].clone()))
}

/// The largest difference between the force in a contact and in the [equivalent
/// spring](super::LongBars::stiffness_of_spring) at the same time, as a share of the largest force, which both have:
/// `sup |φ(t̄) − (1 − e^{−t̄})|`, enclosed to about so many decimal places.
///
/// Branch and bound: times are halved where the difference may exceed the largest one seen.
/// Takes some ten evaluations of [`PowerLaw::share`] for each decimal place.
pub fn distance_from_spring(law: &PowerLaw, places: u32) -> Result<Ball, HertzError> {
    let precision = 4 * u64::from(places) + SPARE_BITS;
    if law.exponent().is_one() {
        return Ok(Ball::zero());
    }
    let narrow =
        Rational::new(1.into(), num_traits::Pow::pow(num_bigint::BigInt::from(10), places));
    let two = Rational::from_integer(2.into());
    let sample = |time: Rational| Sample::new(law, time, precision).map(Rc::new);
    let mut best = Rational::zero();
    let mut cells: Vec<(Rc<Sample>, Option<Rc<Sample>>)> = vec![(sample(Rational::zero())?, None)];
    for level in 0.. {
        let mut widest = best.clone();
        let mut open = Vec::new();
        for (p, q) in cells {
            let bound = largest_between(law, &p, q.as_deref(), precision)?;
            if bound > best {
                widest = widest.max(bound);
                open.push((p, q));
            }
        }
        if &widest - &best <= narrow || level == MAX_LEVELS {
            return Ok(Ball::between(&best, &widest, precision));
        }
        cells = Vec::with_capacity(2 * open.len());
        for (p, q) in open {
            let middle = sample(match &q {
                Some(q) => (&p.time + &q.time) / &two,
                None => (&p.time * &two).max(Rational::one()),
            })?;
            best = best.max(sizes(&middle.difference(precision).bounds())[1].clone());
            cells.push((p, Some(middle.clone())));
            cells.push((middle, q));
        }
    }
    unreachable!("the last level returns")
}
