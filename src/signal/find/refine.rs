//! One root of a monotone function, to any precision.
//!
//! For a root `t*` in an interval `I` with a point `m`, by the mean value theorem `0 = F(m) +
//! F'(ξ)(t* − m)` with `ξ` in `I`, so that `t*` lies in `m − F(m)/F'(I)`: the interval method of
//! Newton. Where that does not halve the interval, the sign of `F(m)` does. Precision is doubled
//! where `F(m)` is too coarse for either.

use crate::ball::{Ball, Precisions, Value};
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::find::cover::{Cell, middle_and_half};
use crate::signal::find::search::{Search, Target};
use crate::signal::signal::At;
use std::cmp::Ordering;
use wavestep_polynomial::{Integer, Rational};

/// Bits of balls beyond those of the root.
const SPARE_BITS: u64 = 64;

/// The precision of a root at which it is asked whether it is a simple rational number.
const SUSPICION_BITS: u64 = 80;

/// The longest denominator of such a number in bits.
const MAX_DENOMINATOR_BITS: u64 = 24;

/// An interval with at most one root of a function that is monotone on it.
///
/// # Invariants
/// - the function rises strictly, or falls, as `rises` says; it has exactly one root, unless it is
///   narrowed to learn where one may be.
#[derive(Clone, Debug)]
pub(crate) struct Isolated {
    pub stretch: usize,
    pub from: Rational,
    pub to: Rational,
    pub rises: bool,
}

impl Isolated {
    /// The root on a monotone cell, or where one may be.
    pub(crate) fn on(cell: &Cell, stretch: usize, rises: bool) -> Isolated {
        Isolated { stretch, from: cell.from.clone(), to: cell.to.clone(), rises }
    }

    /// The one root on a monotone cell whose ends have these signs; there is none where they are the same,
    /// or one of them is zero.
    pub(crate) fn between(cell: &Cell, stretch: usize, signs: [Ordering; 2]) -> Option<Isolated> {
        let rises = signs[1] == Ordering::Greater;
        differ(signs).then(|| Isolated::on(cell, stretch, rises))
    }

    /// Keeps the side of a time that holds the root, by the sign of the function there.
    fn cut(&mut self, at: Rational, sign: Ordering) {
        match (sign == Ordering::Greater) == self.rises {
            true if at < self.to => self.to = at,
            false if at > self.from => self.from = at,
            _ => {}
        }
    }
}

/// Whether one of two signs is positive, and one negative.
pub(crate) fn differ([first, last]: [Ordering; 2]) -> bool {
    first as i8 * last as i8 == -1
}

impl Search<'_> {
    /// Narrows the interval to a relative width of `2^{-bits}`, or as far as the bits allowed do.
    /// An interval whose ends come out in the wrong order holds no root.
    pub(crate) fn narrow(&self, root: &mut Isolated, target: Target<'_>, bits: u64) -> Outcome<()> {
        let stretch = root.stretch;
        let mut working = bits.saturating_add(SPARE_BITS).max(self.bits.get());
        let most = target.limit_bits.saturating_mul(2).max(working);
        let precisions = Precisions::doubling(working, most);
        loop {
            let width = &root.to - &root.from;
            let goal = &root.to * power_of_half(bits);
            if width <= goal {
                return Ok(());
            }
            let (middle, _) = middle_and_half(&root.from, &root.to);
            let near = Rational::from(Ball::from_rational(&middle, working).midpoint());
            let middle = if root.from < near && near < root.to { near } else { middle };
            let value = self.enclose(stretch, target, At::Time(&middle), working)?;
            let slope = Target { order: target.order + 1, ..target };
            let slope = self.range(stretch, slope, (&root.from, &root.to), working)?;
            if let Ok(inverse) = slope.reciprocal(working) {
                let step = value.multiply(&inverse, working);
                let place = Ball::from_rational(&middle, working).subtract(&step, working);
                let [lower, upper] = place.bounds();
                if lower > root.from {
                    root.from = lower;
                }
                if upper < root.to {
                    root.to = upper;
                }
            }
            let narrowed = &root.to - &root.from;
            if &narrowed + &narrowed <= width {
                continue;
            }
            match value.sign() {
                Some(Ordering::Equal) => (root.from, root.to) = (middle.clone(), middle),
                Some(sign) => root.cut(middle, sign),
                // The root may be too near the middle to decide the sign there; a quarter of the interval away it may be decided.
                None => {
                    let quarter = &narrowed / Rational::from_integer(4.into());
                    for beside in [&middle - &quarter, &middle + &quarter] {
                        let value = self.enclose(stretch, target, At::Time(&beside), working)?;
                        if let Some(sign) = value.sign().filter(|sign| sign.is_ne()) {
                            root.cut(beside, sign);
                        }
                    }
                    if &root.to - &root.from < narrowed {
                        continue;
                    }
                    match precisions.after(working) {
                        Some(more) => working = more,
                        None => return Ok(()),
                    }
                }
            }
        }
    }

    /// The root with proven digits; exactly, where it is a rational number with a short
    /// denominator.
    pub(crate) fn root(
        &self,
        root: &Isolated,
        target: Target<'_>,
        digits: usize,
    ) -> Outcome<Value> {
        let mut root = root.clone();
        if let Some(simple) = self.narrowed_to_fraction(&mut root, target)? {
            return Ok(Value::Exact(simple));
        }
        let time = Value::certify(digits, target.limit_bits, |bits| {
            self.narrow(&mut root, target, bits)?;
            Ok::<_, EvaluateError>(Ball::between(
                &root.from,
                &root.to,
                bits.saturating_add(SPARE_BITS),
            ))
        })?;
        Ok(time.exact_if_known())
    }

    /// The root, where it is a rational number with a short denominator at which the function or the derivative is exactly
    /// zero.
    pub(crate) fn narrowed_to_fraction(
        &self,
        root: &mut Isolated,
        target: Target<'_>,
    ) -> Outcome<Option<Rational>> {
        self.narrow(root, target, SUSPICION_BITS)?;
        match root.from <= root.to {
            true => self.fraction_within(root, target),
            false => Ok(None),
        }
    }

    /// The same on an interval that is short.
    pub(crate) fn fraction_within(
        &self,
        root: &Isolated,
        target: Target<'_>,
    ) -> Outcome<Option<Rational>> {
        let simple = simplest(&root.from, &root.to);
        if simple.denom().bits() > MAX_DENOMINATOR_BITS {
            return Ok(None);
        }
        let is_root = match target.order {
            0 => {
                self.function.exact(root.stretch, At::Time(&simple))?.as_ref() == Some(target.level)
            }
            order => self.zeros_at(root.stretch, &simple, order) > 0,
        };
        Ok(is_root.then_some(simple))
    }
}

/// `2^{-bits}`.
pub(crate) fn power_of_half(bits: u64) -> Rational {
    Rational::new(1.into(), Integer::from(1) << bits)
}

/// The rational number with the smallest denominator between two positive ones, ends included, by
/// continued fractions.
pub fn simplest(from: &Rational, to: &Rational) -> Rational {
    let whole = from.ceil();
    if whole <= *to {
        return whole;
    }
    let floor = from.floor();
    let (from, to) = (from - &floor, to - &floor);
    floor + simplest(&to.recip(), &from.recip()).recip()
}
