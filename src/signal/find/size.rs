//! The largest absolute value on a window, between two bounds that are at most a part of `2^−8` apart where cells allow it.
//!
//! Branch and bound: with `F(m + hu) = Σ_k c_k u^k` up to a remainder `R` on a cell, `|F| ≤ Σ_k |c_k| + R` there, and
//! `|F(m)| ≥ |c_0| − R` is taken. A cell is done once its bound is hardly above the largest value that is known to be
//! taken, is negligible, or nothing of it is told from zero; else it is halved. So a function that is zero is done at once,
//! where a search for its extrema would halve cells for ever.

use super::cover::{is_sharp, middle_and_half};
use super::search::{Search, Target};
use crate::ball::{Ball, Magnitude};
use crate::limits::{MAX_EXPANSIONS, MAX_POLYNOMIALS, counted};
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::signal::{At, Limit};
use crate::signal::taylor::{Near, Taylor};
use num_traits::Signed as _;
use wavestep_polynomial::Rational;

const TERMS: usize = 16;

/// How much larger than the largest value that is known the bound may be: by a part of `2^−8`.
const SLACK: i64 = 8;

/// How often a stretch is halved: what is not decided then is kept with its bound.
const DEPTH: usize = 56;

/// How often a polynomial is used for shorter cells.
const HALVINGS: usize = 5;

/// The work on all stretches.
struct Bounding<'a, 's> {
    search: &'a Search<'s>,
    /// Between which numbers the largest absolute value lies.
    known: [Rational; 2],
    negligible: Rational,
    expansions: usize,
}

/// A polynomial on a cell, which serves its parts too.
struct Known {
    taylor: Taylor,
    middle: Rational,
    half: Rational,
    halvings: usize,
}

impl Search<'_> {
    /// Between which numbers the largest absolute value lies; bounds below `negligible` are not refined.
    pub fn largest(&self, negligible: &Rational) -> Outcome<[Rational; 2]> {
        let (known, negligible) = (Default::default(), negligible.clone());
        let mut bounding = Bounding { search: self, known, negligible, expansions: 0 };
        let mut moving = Vec::new();
        for stretch in counted(0..self.count, "of the stretches") {
            let function = self.function;
            // Where that is not told, it is bounded as any other.
            if function.is_instant(stretch) || self.is_constant(stretch).unwrap_or(false) {
                bounding.note_only_value(stretch)?;
            } else {
                bounding.note_limits(stretch)?;
                moving.push(stretch);
            }
        }
        for i in counted(0..moving.len(), "of the stretches") {
            bounding.cover(moving[i])?;
        }
        Ok(bounding.known)
    }
}

impl Bounding<'_, '_> {
    fn bits(&self) -> u64 {
        self.search.bits.get()
    }

    /// A value that is taken, or nearly.
    fn note(&mut self, value: &Ball) {
        let [low, high] = value.bounds();
        let size = if low.is_positive() { low } else { -high };
        if size > self.known[0] {
            self.known[0] = size;
        }
    }

    fn limit(&self, stretch: usize, end: Limit) -> Outcome<Ball> {
        let zero = Rational::default();
        let target = Target { order: 0, level: &zero, limit_bits: self.bits() };
        self.search.enclose(stretch, target, At::End(end), self.bits())
    }

    /// The only value of a stretch that is an instant, or constant.
    fn note_only_value(&mut self, stretch: usize) -> Outcome<()> {
        let value = self.limit(stretch, Limit::Right)?;
        let most = Rational::from(&value.magnitude());
        if most > self.known[1] {
            self.known[1] = most;
        }
        self.note(&value);
        Ok(())
    }

    fn note_limits(&mut self, stretch: usize) -> Outcome<()> {
        for end in [Limit::Right, Limit::Left] {
            let value = self.limit(stretch, end)?;
            self.note(&value);
        }
        Ok(())
    }

    fn cover(&mut self, stretch: usize) -> Outcome<()> {
        let [from, to] = self.search.bounds(stretch)?;
        self.descend(stretch, (from, to), 0, None)
    }

    fn descend(
        &mut self,
        stretch: usize,
        (from, to): (Rational, Rational),
        depth: usize,
        known: Option<&Known>,
    ) -> Outcome<()> {
        let (search, bits) = (self.search, self.bits());
        search.work.set(search.work.get() + 1);
        let (middle, half) = middle_and_half(&from, &to);
        let own = match known.filter(|known| known.halvings < HALVINGS) {
            Some(known) => {
                let (a, b) = ((&middle - &known.middle) / &known.half, &half / &known.half);
                let taylor = known.taylor.part(&a, &b, bits);
                Known { taylor, middle, half, halvings: known.halvings + 1 }
            }
            None => {
                self.expansions += 1;
                let near = Near { order: 0, place: (&middle, &half), terms: TERMS, bits };
                let taylor = search.function.taylor(stretch, near)?;
                Known { taylor, middle, half, halvings: 0 }
            }
        };
        if search.work.get() > MAX_POLYNOMIALS || self.expansions > MAX_EXPANSIONS {
            let limit =
                if self.expansions > MAX_EXPANSIONS { MAX_EXPANSIONS } else { MAX_POLYNOMIALS };
            return Err(EvaluateError::TooManyCells { limit });
        }
        if self.is_done(&own, depth) {
            return Ok(());
        }
        // A part of a polynomial is no better than what is left out of the whole.
        let known = is_sharp(&own.taylor).then_some(&own);
        self.descend(stretch, (from, own.middle.clone()), depth + 1, known)?;
        self.descend(stretch, (own.middle.clone(), to), depth + 1, known)
    }

    /// Whether halves of a cell would tell no more, and then notes its bound: it is near enough, or nothing is told from zero.
    fn is_done(&mut self, own: &Known, depth: usize) -> bool {
        self.note(&own.taylor.coefficients[0].widened(&own.taylor.remainder));
        let most = Rational::from(&own.taylor.range().magnitude());
        let [low, high] = &mut self.known;
        let slack = &*low * Rational::from(&Magnitude::power_of_two(-SLACK));
        let is_noise =
            is_sharp(&own.taylor) && own.taylor.coefficients.iter().all(Ball::contains_zero);
        let is_done =
            most <= &*low + slack || most <= self.negligible || is_noise || depth >= DEPTH;
        if is_done && most > *high {
            *high = most;
        }
        is_done
    }
}
