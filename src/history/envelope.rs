//! How large a function of time is at most and at least, for all values of a symbol.
//!
//! On a step `f(x, ν) = p₀(x) + p₁(x) ν + r` with `|r| ≤ R`, where the parameter `ν` of the symbol lies between −1 and 1. A
//! linear function of `ν` lies between its ends, so sizes are told of both, `|p₀ ± p₁|` more or less `R`: in between they are no larger
//! than the same mean of two bounds, and no smaller than that of two sizes that are reached. So sizes that change alike are
//! compared as nearly as the curvature over the symbol allows.

use crate::ball::{Ball, Magnitude, Varying};
use crate::history::family::OnStep;
use crate::limits::MAX_SYMBOL_BITS as BITS;
use num_traits::{One as _, ToPrimitive as _, Zero as _};
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// In so many parts a step is cut for values that are taken, and how often these are halved about the largest.
const PARTS: i64 = 8;
const HALVINGS: usize = 12;

/// How often a step is halved for a bound.
const DEPTH: usize = 14;

/// A function on a step.
struct OneStep {
    /// Its part that the window has for some value of the symbol, and for every one where there is such.
    reach: [Rational; 2],
    within: Option<[Rational; 2]>,
    /// `p₀ + p₁` and `p₀ − p₁`, and `R`.
    ends: [Vec<Ball>; 2],
    rest: Magnitude,
}

/// What a size is at both ends of the symbol.
pub type Ends = [Rational; 2];

/// A function on a window.
pub struct Envelope(Vec<OneStep>);

/// A window in steps since the start: between which numbers its first time and its last lie.
pub struct StepsOf {
    pub from: [Rational; 2],
    pub to: [Rational; 2],
}

impl StepsOf {
    /// How many there are at most.
    pub fn count(&self) -> usize {
        self.to[1].floor().to_usize().map_or(usize::MAX, |last| last.saturating_add(1))
    }
}

impl Envelope {
    /// A function on the steps of a window.
    pub fn of(steps: &[OnStep], window: &StepsOf) -> Envelope {
        let one = |(number, own): (usize, &OnStep)| {
            let start = Rational::from_integer(number.into());
            let part = |[from, to]: [&Rational; 2]| {
                let part =
                    [(from - &start).max(Rational::zero()), (to - &start).min(Rational::one())];
                // The end of a step is the beginning of the next.
                (part[0] <= part[1] && !part[0].is_one()).then_some(part)
            };
            let reach = part([&window.from[0], &window.to[1]])?;
            let within = part([&window.from[1], &window.to[0]]);
            let end = |sign: i64| {
                let sum = |own: &Varying| {
                    let slope = own.coefficient(1);
                    let slope = if sign < 0 { slope.negate() } else { slope };
                    own.coefficient(0).add(&slope, BITS)
                };
                own.coefficients.iter().map(sum).collect()
            };
            let rests = own.coefficients.iter().map(|own| own.beyond(2));
            let rest = rests.fold(own.error, |sum, rest| sum.add(&rest));
            Some(OneStep { reach, within, ends: [end(1), end(-1)], rest })
        };
        Envelope(steps.iter().enumerate().filter_map(one).collect())
    }

    /// Sizes at both ends of the symbol that are reached at one instant, as near to the largest as is found.
    pub fn reached(&self) -> Ends {
        let least = |ends: &Ends| ends[0].clone().min(ends[1].clone());
        let mut best = (Ends::default(), None);
        for (place, step) in self.0.iter().enumerate() {
            let Some([from, to]) = &step.within else { continue };
            for part in 0..=PARTS {
                let at = from + (to - from) * Rational::new(part.into(), PARTS.into());
                let size = step.at_least(&at);
                if least(&size) > least(&best.0) {
                    best = (size, Some((place, at)));
                }
            }
        }
        let (mut most, Some((place, mut at))) = best else { return Ends::default() };
        let step = &self.0[place];
        let [from, to] = step.within.as_ref().expect("a value was taken there");
        let mut by = (to - from) / Rational::from_integer(PARTS.into());
        for _ in 0..HALVINGS {
            by /= Rational::from_integer(2.into());
            for beside in [&at - &by, &at + &by] {
                if *from <= beside && beside <= *to {
                    let size = step.at_least(&beside);
                    if least(&size) > least(&most) {
                        (most, at) = (size, beside);
                    }
                }
            }
        }
        most
    }

    /// Whether all values on the window are proven to be no larger than these at both ends of the symbol, and between them than
    /// their mean.
    pub fn is_within(&self, most: &Ends) -> bool {
        self.0.iter().all(|step| step.is_within(most, &step.reach, DEPTH))
    }
}

impl OneStep {
    /// Lower bounds of the size at a time.
    fn at_least(&self, at: &Rational) -> Ends {
        let at = Ball::from_rational(at, BITS);
        let value = |end: &Vec<Ball>| {
            let terms = end.iter().rev();
            terms.fold(Ball::zero(), |sum, own| sum.multiply(&at, BITS).add(own, BITS))
        };
        let values = self.ends.each_ref().map(value);
        if values[0].sign() != values[1].sign() {
            return Ends::default();
        }
        let rest = Rational::from(&self.rest);
        values.map(|value| (least(&value) - &rest).max(Rational::zero()))
    }

    fn is_within(&self, most: &Ends, [from, to]: &[Rational; 2], depth: usize) -> bool {
        let two = Rational::from_integer(2.into());
        let (middle, half) = ((from + to) / &two, (to - from) / &two);
        let bounds = self.ends.each_ref().map(|end| about(end, &middle, &half));
        let rest = Rational::from(&self.rest);
        let mut both = bounds.iter().zip(most);
        if both.clone().all(|([_, bound], most)| bound + &rest <= *most) {
            return true;
        }
        if depth == 0 || both.any(|([least, _], most)| least - &rest > *most) {
            return false;
        }
        let halves = [[from.clone(), middle.clone()], [middle, to.clone()]];
        halves.iter().all(|half| self.is_within(most, half, depth - 1))
    }
}

/// A polynomial within a distance of a place: a size that it has in the middle at least, and one that it has nowhere more
/// than, `max |c₀ ± c₁| + Σ_{k≥2} |c_k|` with coefficients about the middle.
fn about(polynomial: &[Ball], middle: &Rational, half: &Rational) -> [Rational; 2] {
    let [at, half] = [middle, half].map(|own| Ball::from_rational(own, BITS));
    let mut own = polynomial.to_vec();
    for first in 0..own.len() {
        for k in (first..own.len() - 1).rev() {
            own[k] = own[k].add(&own[k + 1].multiply(&at, BITS), BITS);
        }
    }
    let mut power = Ball::from_integer(&1.into());
    for coefficient in &mut own {
        *coefficient = coefficient.multiply(&power, BITS);
        power = power.multiply(&half, BITS);
    }
    let coefficient = |k: usize| own.get(k).cloned().unwrap_or_else(Ball::zero);
    let (value, slope) = (coefficient(0), coefficient(1));
    let ends = [value.add(&slope, BITS), value.subtract(&slope, BITS)];
    let linear = ends.iter().map(Ball::magnitude).max().unwrap_or(Magnitude::ZERO);
    let most = own.iter().skip(2).fold(linear, |sum, own| sum.add(&own.magnitude()));
    [least(&value), Rational::from(&most)]
}

/// The smallest size in a ball.
fn least(ball: &Ball) -> Rational {
    let (low, high) = ball.endpoints();
    match ball.sign() {
        Some(Ordering::Greater) => Rational::from(&low),
        Some(Ordering::Less) => -Rational::from(&high),
        _ => Rational::zero(),
    }
}
