//! Where a function that is positive at first stops being so.
//!
//! On a cell a force or a gap is a series in balls. Either it is proven positive until the end of the
//! cell, or an interval is found before which it is positive, in which it falls, and after which it is
//! negative for a while; all else is undecided.
//!
//! Proofs. About a point `m`, `f(m + ξ) = c₀ + ξ Q(ξ)` with `Q` enclosed by `c₁ ± Σ_{k≥2} |c_k| w^(k−1)`
//! for `|ξ| ≤ w`. If `Q < 0` everywhere and `δ = |c₀|/min |Q|`, then `f > 0` for `ξ < −δ` and `f < 0` for
//! `ξ > δ`: the one root lies within `δ` of `m`.

use crate::ball::{Ball, Magnitude, Number, rational};
use crate::history::positive::positive_until;
use crate::history::series::{CellNorm, Series, Truncation};
use num_traits::{Signed, Zero};
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// Bits that show most signs.
const SIGN_BITS: u64 = 96;

/// How a function begins on a cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Beginning {
    Positive,
    Negative,
    /// Zero on the whole cell.
    Zero,
    Undecided,
}

/// The sign on some time after the start of the cell, by the first coefficient that is not zero; `starts`
/// encloses the first of them.
pub fn beginning(f: &Series, starts: &[Number]) -> Beginning {
    if f.is_zero() {
        return Beginning::Zero;
    }
    match starts.iter().find(|c| !c.is_zero()).map(Number::sign) {
        Some(Some(Ordering::Greater)) => Beginning::Positive,
        Some(Some(Ordering::Less)) => Beginning::Negative,
        _ => Beginning::Undecided,
    }
}

/// The same where coefficients that may be zero are taken to be; all of them: the function is.
pub(crate) fn tied_beginning(starts: &[Number]) -> Beginning {
    let mut signs = starts.iter().filter_map(Number::sign);
    match signs.find(|sign| *sign != Ordering::Equal) {
        Some(Ordering::Less) => Beginning::Negative,
        Some(_) => Beginning::Positive,
        None => Beginning::Zero,
    }
}

/// What the polynomial of `f = x^j g` leaves out of `g`, for a function with `j` zeros at the start.
///
/// Its error is `e/x^j`, `e` that of `f` with as many zeros: at most `sup |e^(j)|/j!`, and `sup |e|/x^j` further
/// on. Its slope is at most `sup |e^(j+1)|/(j+1)!`, and `sup |e'|/x^j + j sup |e|/x^(j+1)`.
pub struct Errors {
    zeros: usize,
    near: [Magnitude; 2],
    of_whole: [Magnitude; 2],
}

impl Errors {
    /// With bounds of the derivatives of `e`, by their order.
    pub fn new(zeros: usize, bound: impl Fn(usize) -> Magnitude) -> Errors {
        let coefficient =
            |order: usize| (2..=order as u64).fold(bound(order), |size, i| size.divide(i));
        let near = [coefficient(zeros), coefficient(zeros + 1)];
        Errors { zeros, near, of_whole: [bound(0), bound(1)] }
    }

    /// Those of value and slope from a time on.
    pub fn from(&self, time: &Rational) -> [Magnitude; 2] {
        if self.zeros == 0 || !time.is_positive() {
            return self.near;
        }
        let inverse = Magnitude::from_rational(&time.recip());
        let power = inverse.power(self.zeros as u64);
        let [value, slope] = self.of_whole.map(|size| size.multiply(&power));
        let bent = value.multiply(&inverse).multiply(&Magnitude::from_u64(self.zeros as u64));
        [self.near[0].min(value), self.near[1].min(slope.add(&bent))]
    }
}

/// What follows on a cell after a positive beginning.
#[derive(Clone, PartialEq, Debug)]
pub enum Course {
    /// Positive until the end, the end itself perhaps excepted, and instants at which it touches zero.
    Positive,
    /// Positive until about this time since the start of the cell, and negative behind it.
    Falls(Number),
    /// Not decided: about this time since the start of the cell.
    Undecided(Ball),
}

/// Follows a function that begins positive, until a time `length` after the start of the cell. What is above
/// `−tie` counts as positive. No error of the series is fresh: all of them are told apart from it.
///
/// # Cost
/// Doubles decide most cells; else a shift of the series, `N²/2` products, for each part of what they leave.
pub fn follow(
    f: &Series,
    (errors, tie): (&Errors, &Magnitude),
    length: &Number,
    cut: &Truncation,
) -> Course {
    if let (true, Some(length)) = (f.is_exact(), length.exact())
        && let Some(course) = follow_exactly(f, length)
    {
        return course;
    }
    let size = length.magnitude();
    let Some(until) = positive_until(f, &errors.near, &size) else { return Course::Positive };
    let end = Rational::from(&size);
    let mut parts = vec![(&end * rational(until), end.clone())];
    let two = Rational::from_integer(2.into());
    let tie = Ball::from_rational(&tie.into(), cut.bits);
    let narrowest = &end * Rational::from(&Magnitude::power_of_two(-(cut.bits as i64) / 2));
    let is_positive = |value: &Ball| sign(&value.add(&tie, cut.bits)) == Some(Ordering::Greater);
    let [value, slope] = [0, 1].map(|k| f.coefficient(k).ball(cut.bits).widened(&errors.near[k]));
    let begins = is_positive(&value);
    // Else no part that begins at zero is known to be positive, however short, nor does one that rises fall to zero.
    let may_begin = begins || sign(&slope) == Some(Ordering::Less);
    // Whether `f(0)` is positive and `(f(x) − f(0))/x` is until there: a tie begins near zero.
    let rises = |until: &Rational| {
        let reach = Magnitude::from_rational(until);
        let bend = f.size_from(2, &reach).multiply(&reach);
        begins && sign(&slope.clone().widened(&bend)) == Some(Ordering::Greater)
    };
    let few = Truncation { bits: SIGN_BITS, ..*cut };
    let rough = (cut.bits > 2 * SIGN_BITS).then(|| f.bare(&CellNorm::new(size, &few), &few));
    while let Some((lower, upper)) = parts.pop() {
        let half = (&upper - &lower) / &two;
        let middle = &lower + &half;
        let w = Magnitude::from_rational(&half);
        let here = errors.from(&lower);
        if let Some(rough) = &rough {
            let near = rough.shift(&Number::Exact(middle.clone()), &few);
            let left_out = rough.fresh.add(&here[0]).add(&near.size_from(1, &w).multiply(&w));
            if is_positive(&near.coefficient(0).ball(SIGN_BITS).widened(&left_out)) {
                continue;
            }
        }
        let near = f.shift(&Number::Exact(middle.clone()), cut);
        let value = near.coefficient(0).ball(cut.bits).widened(&here[0]);
        let bound = value.clone().widened(&near.size_from(1, &w).multiply(&w));
        if is_positive(&bound) || lower.is_zero() && rises(&upper) {
            continue;
        }
        if let Some(Lowest { place, value, least }) = lowest(f, &near, (&middle, &half), cut) {
            let [value, least] = [value, least].map(|own| own.widened(&here[0]));
            if is_positive(&least) {
                continue;
            }
            // No shorter part tells more.
            if sign(&value).is_none() {
                return Course::Undecided(Ball::from_rational(&place, cut.bits));
            }
        }
        let slope = near.coefficient(1).ball(cut.bits).widened(&here[1]);
        // Where neither value nor slope is told from zero, no shorter part tells more.
        if sign(&value).is_none() && sign(&slope).is_none() {
            return Course::Undecided(Ball::between(&lower, &upper, cut.bits));
        }
        // The series converges everywhere, so that a root is also found a little beyond the part.
        let reach = &half * &two;
        if let Some(root) = fall((f, errors), near, [&middle, &reach, &end], cut) {
            let far =
                root.ball(cut.bits).subtract(&Ball::from_rational(&upper, cut.bits), cut.bits);
            return match sign(&far) {
                // The function falls, but has not yet come to zero here.
                Some(Ordering::Greater) if upper < end => {
                    parts.pop();
                    parts.push((upper, end.clone()));
                    continue;
                }
                _ => Course::Falls(root),
            };
        }
        if lower.is_zero() && !may_begin {
            return Course::Undecided(Ball::from_rational(&lower, cut.bits));
        }
        if half < narrowest {
            return Course::Undecided(Ball::between(&lower, &upper, cut.bits));
        }
        parts.push((middle.clone(), upper));
        parts.push((lower, middle));
    }
    Course::Positive
}

fn sign(ball: &Ball) -> Option<Ordering> {
    Number::Enclosed(ball.clone()).sign()
}

/// About where a polynomial is smallest, what it is there, and what it is at least.
struct Lowest {
    place: Rational,
    value: Ball,
    least: Ball,
}

/// The lowest point of a part on which the polynomial bends upwards: `near` is its series at the middle. None where it is not
/// known to, or where its lowest point is not known to be inside.
///
/// With `p''` enclosed by `B > 0` the slope is zero at `m + x*` with `x* = −c₁/B`, and `c₀ ≥ p(m + x*) ≥ c₀ + c₁ x*`. From
/// there on by Newton's method, each step of which doubles the digits.
fn lowest(
    f: &Series,
    near: &Series,
    (middle, half): (&Rational, &Rational),
    cut: &Truncation,
) -> Option<Lowest> {
    let bits = cut.bits;
    let (mut near, mut place, mut reach) = (near.clone(), middle.clone(), half.clone());
    loop {
        let w = Magnitude::from_rational(&reach);
        let further = near.coefficients.iter().enumerate().skip(3).rev();
        let further = further.fold(Magnitude::ZERO, |sum, (k, c)| {
            let factor = Magnitude::from_u64((k * (k - 1)) as u64);
            sum.multiply(&w).add(&c.magnitude().multiply(&factor))
        });
        let twice = near.coefficient(2).multiply(&Number::integer(2), bits).ball(bits);
        let bend = twice.widened(&further.multiply(&w));
        let slope = near.coefficient(1).ball(bits);
        if sign(&bend) != Some(Ordering::Greater) {
            return None;
        }
        let step = slope.multiply(&bend.reciprocal(bits).ok()?, bits).negate();
        if step.magnitude() > w {
            return None;
        }
        let value = near.coefficient(0).ball(bits);
        let dip = slope.magnitude().multiply(&step.magnitude());
        // What the value itself leaves open is not told by more steps, nor by such as hardly narrow the place.
        if dip <= *value.radius() || step.radius().scale(2) > w {
            let least = value.clone().widened(&dip);
            return Some(Lowest { place, value, least });
        }
        place += Rational::from(step.midpoint());
        reach = Rational::from(step.radius()) * Rational::from_integer(2.into());
        near = f.shift(&Number::Exact(place.clone()), cut);
    }
}

/// The root near a point where the function falls: `near` is its series at `middle`. `None` where the
/// part is too long for the method of Newton to close in on it.
fn fall(
    (f, errors): (&Series, &Errors),
    near: Series,
    [middle, reach, end]: [&Rational; 3],
    cut: &Truncation,
) -> Option<Number> {
    let (mut near, mut middle, mut reach) = (near, middle.clone(), reach.clone());
    let bits = cut.bits;
    let (mut best, mut is_known): (Option<Ball>, bool) = (None, false);
    for _ in 0..2 * (64 - bits.leading_zeros()) + 4 {
        let w = Magnitude::from_rational(&reach);
        // As far as the reach goes beyond the ends of the cell.
        let beyond = (&middle + &reach - end).max(&reach - &middle).max(Rational::zero());
        let beyond = Magnitude::from_rational(&beyond);
        let errors = errors.from(&(&middle - &reach));
        let errors = errors.map(|error| f.bound_beyond(&error, &beyond, cut));
        let value = near.coefficient(0).ball(bits).widened(&errors[0]);
        let slope = near.coefficient(1).ball(bits).widened(&errors[1]);
        let slope = slope.widened(&near.size_from(2, &w).multiply(&w));
        if sign(&slope) != Some(Ordering::Less) {
            return None;
        }
        // −c₀/Q encloses the root, if it lies within the reach.
        let step = value.multiply(&slope.reciprocal(bits).ok()?, bits).negate();
        if step.magnitude() > w {
            break;
        }
        let root = step.add(&Ball::from_rational(&middle, bits), bits);
        if best.as_ref().is_some_and(|best| best.radius() <= &root.radius().scale(1)) {
            // Where the slope is well known, the value is what tells no more.
            is_known = slope.radius().scale(3) <= slope.magnitude();
            break;
        }
        let radius = Rational::from(root.radius());
        middle = Rational::from(root.midpoint());
        reach = radius * Rational::from_integer(2.into());
        best = Some(root);
        if middle.is_negative() || reach.is_zero() {
            break;
        }
        near = f.shift(&Number::Exact(middle.clone()), cut);
    }
    // As narrow as the coefficients allow; else the part was too long.
    let narrow = Magnitude::power_of_two(-(bits as i64) / 2);
    best.filter(|best| is_known || best.radius() <= &narrow).map(Number::Enclosed)
}

/// Polynomials of degree 2 with rational coefficients: roots are compared with the end exactly. `None`
/// where the degree is higher, or a root irrational.
fn follow_exactly(f: &Series, length: &Rational) -> Option<Course> {
    let skipped = f.coefficients.iter().take_while(|c| c.is_zero()).count();
    let c: Vec<Rational> =
        f.coefficients[skipped..].iter().filter_map(|c| c.exact().cloned()).collect();
    let falls = |root: Rational| match root < *length {
        true => Course::Falls(Number::Exact(root)),
        false => Course::Positive,
    };
    match &c[..] {
        [] | [_] => Some(Course::Positive),
        [c0, c1] if c1.is_negative() => Some(falls(-c0 / c1)),
        [_, _] => Some(Course::Positive),
        [c0, c1, c2] => {
            let four = Rational::from_integer(4.into());
            let discriminant = c1 * c1 - four * c0 * c2;
            let grows = !c1.is_negative() && !c2.is_negative();
            if discriminant.is_negative() || grows {
                return Some(Course::Positive);
            }
            let root = square_root(&discriminant)?;
            // With c0 > 0 the first positive root is 2 c0/(−c1 + √D): stable and the smaller one.
            let two = Rational::from_integer(2.into());
            let below = -c1 + root;
            if !below.is_positive() {
                return Some(Course::Positive);
            }
            let first = two * c0 / below;
            // Where it touches zero it rises again: it is nowhere negative.
            match discriminant.is_zero() {
                true => Some(Course::Positive),
                false => Some(falls(first)),
            }
        }
        _ => None,
    }
}

/// The root of a rational square.
fn square_root(value: &Rational) -> Option<Rational> {
    let root = Rational::new(value.numer().sqrt(), value.denom().sqrt());
    (&root * &root == *value).then_some(root)
}
