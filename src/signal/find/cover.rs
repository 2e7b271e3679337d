//! A stretch cut into cells, on each of which something is proven.
//!
//! On a cell `|t − m| ≤ h` a function `F` and its derivative have Taylor polynomials
//! `F(m + hu) = Σ_k c_k u^k`, `F'(m + hu) = Σ_k d_k u^k` with proven remainders for `|u| ≤ 1`. So
//! `|F − c_0| ≤ Σ_{k≥1} |c_k| + R` on all of it:
//!
//! - where `|c_0|` is larger than that, `F` has the sign of `c_0` and no root ([`Finding::Clear`]);
//! - where `|d_0|` is larger than the same sum of `F'`, `F` is strictly monotone and has at most
//!   one root ([`Finding::Monotone`]);
//! - else the cell is halved, until it is `2^{-DEPTH}` of the stretch or less ([`Finding::Open`]).
//!
//! At an end of the stretch where exactly `F = F' = … = F^(k−1) = 0`, `F` has the sign of `F^(k)` on a cell
//! on which that has one: `F(t) = (t − t_0)^k/k! F^(k)(ξ)`; and is monotone there, as its slope is of
//! the same kind.
//!
//! A simple root is at last in a cell of the second kind, since there `F' ≠ 0`; a root of higher
//! order never is. Cells are closed and share their ends, so that nothing lies between them. For
//! extrema cells whose largest value is below one that is known to be taken are dropped
//! ([`Finding::Low`]).

use crate::ball::{Attempt, Ball, Magnitude, Precisions};
use crate::limits::{MAX_EXPANSIONS, MAX_POLYNOMIALS, pause};
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::find::goal::Record;
use crate::signal::find::search::{Search, Target};
use crate::signal::signal::{At, Limit};
use crate::signal::taylor::{Near, Taylor};
use std::cell::OnceCell;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// How often a stretch is halved.
const DEPTH: usize = 56;

/// How often a stretch is halved before its ends are looked at more closely.
const FLAT_DEPTH: usize = 3;

/// How often a cell is halved before its polynomials are worked out again.
const HALVINGS: usize = 6;

/// The length of polynomials.
const TERMS: usize = 20;

/// The same for a long cell on which a function is small.
const LONG_TERMS: [usize; 2] = [64, 192];

/// A remainder has to be smaller than what is left of a polynomial by so many bits.
const REMAINDER_BITS: i64 = 8;

/// The relative precision of polynomials in bits on the first cells; two more each time one is
/// halved, since a double root is as flat as that.
const RELATIVE_BITS: i64 = 64;

/// What is smaller than the waves it is the sum of by so many bits may be zero.
const CANCELLED_BITS: i64 = 100;

/// Where nothing is told from zero, no shorter cell tells more of what is smaller than its terms by so many bits.
const NOISE_BITS: i64 = 56;

/// What is proven of a cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Finding {
    /// The function is above zero, or below it.
    Clear(Ordering),
    /// It rises, or falls.
    Monotone(Ordering),
    /// Nothing is proven.
    Open,
    /// The observable is smaller than it is elsewhere.
    Low,
}

/// A closed cell in the user's time.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Cell {
    pub from: Rational,
    pub to: Rational,
    pub finding: Finding,
}

/// Polynomials about the middle of a cell.
struct Expansion {
    middle: Rational,
    half: Rational,
    /// How often the stretch was halved where they were worked out.
    depth: usize,
    /// The function and its derivative, each perhaps times a positive function, and for extrema the observable.
    polynomials: Vec<Taylor>,
    bits: u64,
}

/// The work on one stretch.
struct Cover<'a, 's, 'b> {
    search: &'a Search<'s>,
    stretch: usize,
    target: Target<'b>,
    record: Option<&'b mut Record>,
    bounds: [Rational; 2],
    /// How many derivatives vanish at both ends, once that was asked for.
    flatness: [OnceCell<usize>; 2],
    /// The largest coefficient seen.
    scale: Magnitude,
    /// What is not told from zero, and as small as this, stays so.
    noise: Magnitude,
    /// How many times polynomials were worked out.
    expansions: usize,
    cells: Vec<Cell>,
}

impl Search<'_> {
    /// The cells of a stretch, in order, neighbours with the same finding joined.
    pub(crate) fn cover(
        &self,
        stretch: usize,
        target: Target<'_>,
        record: Option<&mut Record>,
    ) -> Outcome<Vec<Cell>> {
        pause();
        let [from, to] = self.bounds(stretch)?;
        if let Some(finding) = self.known_sign(stretch, target, record.as_deref()) {
            return Ok(vec![Cell { from, to, finding }]);
        }
        // Most stretches stay below the record, as one short polynomial shows.
        if let Some(record) = record.as_deref() {
            let observable = Target { order: 0, ..target };
            let range = self.range(stretch, observable, (&from, &to), self.bits.get())?;
            if record.beats(&record.goal.raised(range)) {
                return Ok(vec![Cell { from, to, finding: Finding::Low }]);
            }
        }
        let (middle, _) = middle_and_half(&from, &to);
        // Far from the start the first bits may tell nothing.
        let attempt = |bits| {
            self.bits.set(bits);
            let (size, error) = self.function.size(stretch, target.order, &middle, bits)?;
            Ok::<_, EvaluateError>(Attempt::of(size, error.scale(RELATIVE_BITS) <= size))
        };
        let size = self.precisions(target).raise(attempt)?.best();
        let (scale, noise) = (size.scale(-CANCELLED_BITS), size.scale(-NOISE_BITS));
        let cells = Vec::new();
        let (bounds, flatness) = ([from.clone(), to.clone()], Default::default());
        let search = self;
        let mut cover = Cover {
            search,
            stretch,
            target,
            record,
            bounds,
            flatness,
            scale,
            noise,
            expansions: 0,
            cells,
        };
        cover.descend(from, to, 0, None)?;
        Ok(cover.cells)
    }

    /// What the sign that the function is known to have on a stretch tells of the target: that it is not zero, or below
    /// a value that is taken.
    fn known_sign(
        &self,
        stretch: usize,
        target: Target<'_>,
        record: Option<&Record>,
    ) -> Option<Finding> {
        let sign = self.function.signed(stretch)?.sign;
        let is_zero = target.order == 0 && *target.level == Rational::default();
        let beaten = |record: &Record| record.beats_sign(sign).then_some(Finding::Low);
        if is_zero { Some(Finding::Clear(sign)) } else { record.and_then(beaten) }
    }

    /// From the precision that has done so far on.
    fn precisions(&self, target: Target<'_>) -> Precisions {
        let bits = self.bits.get();
        Precisions::doubling(bits, target.limit_bits.max(bits))
    }

    /// A polynomial of a derivative, less the level where it is the observable itself.
    pub(crate) fn expand(
        &self,
        stretch: usize,
        target: Target<'_>,
        place: (&Rational, &Rational),
        terms: usize,
        bits: u64,
    ) -> Outcome<Taylor> {
        let near = Near { order: target.order, place, terms, bits };
        let mut taylor = self.function.taylor(stretch, near)?;
        if target.order == 0 && *target.level != Rational::default() {
            let level = Ball::from_rational(target.level, bits);
            taylor.coefficients[0] = taylor.coefficients[0].subtract(&level, bits);
        }
        Ok(taylor)
    }

    /// An enclosure of a derivative on all of a cell.
    pub(crate) fn range(
        &self,
        stretch: usize,
        target: Target<'_>,
        (from, to): (&Rational, &Rational),
        bits: u64,
    ) -> Outcome<Ball> {
        let (middle, half) = middle_and_half(from, to);
        Ok(self.expand(stretch, target, (&middle, &half), 8, bits)?.range())
    }

    /// The same where a cell may be long and the values on it small: with as many terms as it takes.
    pub(crate) fn range_of_small(
        &self,
        stretch: usize,
        target: Target<'_>,
        (from, to): (&Rational, &Rational),
        bits: u64,
    ) -> Outcome<Ball> {
        let (middle, half) = middle_and_half(from, to);
        let of = |terms| self.expand(stretch, target, (&middle, &half), terms, bits);
        let mut taylor = of(TERMS)?;
        for terms in LONG_TERMS {
            if is_sharp(&taylor) {
                break;
            }
            taylor = of(terms)?;
        }
        Ok(taylor.range())
    }
}

impl Cover<'_, '_, '_> {
    fn descend(
        &mut self,
        from: Rational,
        to: Rational,
        depth: usize,
        known: Option<&Expansion>,
    ) -> Outcome<()> {
        pause();
        let search = self.search;
        search.work.set(search.work.get() + 1);
        if search.work.get() > MAX_POLYNOMIALS {
            return Err(EvaluateError::TooManyCells { limit: MAX_POLYNOMIALS });
        }
        let (middle, half) = middle_and_half(&from, &to);
        if let Some(known) = known {
            let part = known.on(&middle, &half);
            if let Some(finding) = self.decided(&part.polynomials) {
                self.push(from, to, finding);
                return Ok(());
            }
            if depth < known.depth + HALVINGS && part.polynomials.iter().all(is_sharp) {
                self.descend(from, middle.clone(), depth + 1, Some(&part))?;
                return self.descend(middle, to, depth + 1, Some(&part));
            }
        }
        self.expansions += 1;
        if self.expansions > MAX_EXPANSIONS {
            return Err(EvaluateError::TooManyCells { limit: MAX_EXPANSIONS });
        }
        let expansion = self.expanded(&middle, &half, depth)?;
        if let Some(finding) = self.decided(&expansion.polynomials) {
            self.push(from, to, finding);
            return Ok(());
        }
        if depth >= FLAT_DEPTH
            && let Some(finding) = self.beside_a_flat_end(&from, &to)?
        {
            self.push(from, to, finding);
            return Ok(());
        }
        let sharp = expansion.polynomials.iter().all(is_sharp);
        let own = &expansion.polynomials[0];
        let hopeless = expansion.polynomials[..2].iter().all(is_blurred)
            || own.coefficients.iter().all(Ball::contains_zero)
                && (sharp || own.range().magnitude() <= self.noise);
        if hopeless || depth >= DEPTH {
            self.push(from, to, Finding::Open);
            return Ok(());
        }
        let known = sharp.then_some(&expansion);
        self.descend(from, middle.clone(), depth + 1, known)?;
        self.descend(middle, to, depth + 1, known)
    }

    /// What is known of a cell that begins or ends with the stretch, where several derivatives vanish.
    fn beside_a_flat_end(&self, from: &Rational, to: &Rational) -> Outcome<Option<Finding>> {
        let (search, target) = (self.search, self.target);
        for (side, end) in [Limit::Right, Limit::Left].into_iter().enumerate() {
            if *[from, to][side] != self.bounds[side] {
                continue;
            }
            // Enclosures are cheaper than the exact values that tell how many derivatives vanish.
            let may_vanish = |order| {
                let (target, bits) = (Target { order, ..target }, search.bits.get());
                let value = search.enclose(self.stretch, target, At::End(end), bits)?;
                Ok::<_, EvaluateError>(value.contains_zero())
            };
            let flatness = || match may_vanish(target.order)? && may_vanish(target.order + 1)? {
                true => search.flatness(self.stretch, end, target),
                false => Ok(0),
            };
            let count = *self.flatness[side].get_or_init(|| flatness().unwrap_or(0));
            // A simple zero is found without this.
            if count < 2 {
                continue;
            }
            let derivative = Target { order: target.order + count, ..target };
            let range = search.range(self.stretch, derivative, (from, to), search.bits.get())?;
            let sign = range.sign().filter(|sign| sign.is_ne());
            // The slope near the last time has the sign of `(t − t_0)^(k−1) F^(k)`, `t < t_0`.
            let turned = side == 1 && count.is_multiple_of(2);
            if let Some(sign) = sign {
                let slope = if turned { sign.reverse() } else { sign };
                return Ok(Some(Finding::Monotone(slope)));
            }
        }
        Ok(None)
    }

    /// Polynomials with as many bits as the depth calls for.
    fn expanded(&mut self, middle: &Rational, half: &Rational, depth: usize) -> Outcome<Expansion> {
        let search = self.search;
        let attempt = |bits| {
            search.bits.set(bits);
            let place = (middle, half);
            let of = |order: usize, terms: usize| {
                let target = Target { order, ..self.target };
                match order == 0 && *target.level != Rational::default() {
                    true => search.expand(self.stretch, target, place, terms, bits),
                    false => {
                        let near = Near { order, place, terms, bits };
                        search.function.taylor_of_sign(self.stretch, near)
                    }
                }
            };
            let with = |terms: usize| {
                let order = self.target.order;
                let mut polynomials = vec![of(order, terms)?, of(order + 1, terms)?];
                if let Some(record) = &self.record {
                    let observable = Target { order: 0, ..self.target };
                    let observable = search.expand(self.stretch, observable, place, terms, bits)?;
                    let one = record.goal.raised(Ball::from_integer(&1.into()));
                    polynomials.push(observable.scaled(&one, bits));
                }
                Ok::<_, EvaluateError>(polynomials)
            };
            let mut polynomials = with(TERMS)?;
            // More terms at once cost less than many short cells.
            if !polynomials.iter().all(is_sharp) {
                let longer = with(LONG_TERMS[0])?;
                if longer.iter().all(is_sharp) {
                    polynomials = longer;
                }
            }
            let own = &polynomials[0];
            for coefficient in &own.coefficients {
                self.scale = self.scale.max(coefficient.midpoint().magnitude());
            }
            let wanted = self.scale.scale(-(RELATIVE_BITS + 2 * depth as i64));
            let coarse = own.coefficients.iter().any(|c| *c.radius() > wanted);
            let (middle, half) = (middle.clone(), half.clone());
            Ok(Attempt::of(Expansion { middle, half, depth, polynomials, bits }, !coarse))
        };
        search.precisions(self.target).raise(attempt).map(Attempt::best)
    }

    fn decided(&mut self, polynomials: &[Taylor]) -> Option<Finding> {
        if let (Some(record), Some(observable)) = (&mut self.record, polynomials.get(2)) {
            if record.beats(&observable.range()) {
                return Some(Finding::Low);
            }
            record.note(&observable.coefficients[0].widened(&observable.remainder));
        }
        match polynomials[0].range().sign() {
            Some(Ordering::Equal) | None => {}
            Some(sign) => return Some(Finding::Clear(sign)),
        }
        match polynomials[1].range().sign() {
            Some(Ordering::Equal) | None => None,
            Some(sign) => Some(Finding::Monotone(sign)),
        }
    }

    fn push(&mut self, from: Rational, to: Rational, finding: Finding) {
        match self.cells.last_mut() {
            Some(last) if last.finding == finding => last.to = to,
            _ => self.cells.push(Cell { from, to, finding }),
        }
    }
}

impl Expansion {
    /// The same functions on a part of the cell, with no more terms than it takes.
    fn on(&self, middle: &Rational, half: &Rational) -> Expansion {
        let (a, b) = ((middle - &self.middle) / &self.half, half / &self.half);
        let part = |polynomial: &Taylor| {
            let few = polynomial.first_terms_of_part(&a, &b, TERMS, self.bits);
            if is_sharp(&few) { few } else { polynomial.part(&a, &b, self.bits) }
        };
        let polynomials = self.polynomials.iter().map(part).collect();
        let (middle, half) = (middle.clone(), half.clone());
        Expansion { middle, half, polynomials, ..*self }
    }
}

/// Whether what is left out matters little.
pub(crate) fn is_sharp(polynomial: &Taylor) -> bool {
    polynomial.remainder.scale(REMAINDER_BITS) <= polynomial.tail(1)
}

/// Whether what is unknown of the middle, where zero is possible, is more than all by which a cell differs from it: no
/// part of the cell tells more.
fn is_blurred(polynomial: &Taylor) -> bool {
    let middle = polynomial.coefficient(0);
    middle.contains_zero() && polynomial.tail(1) <= *middle.radius()
}

pub(crate) fn middle_and_half(from: &Rational, to: &Rational) -> (Rational, Rational) {
    let two = Rational::from_integer(2.into());
    ((from + to) / &two, (to - from) / two)
}
