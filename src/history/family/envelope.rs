//! How large a function of time is at most and at least, for all values of a symbol.
//!
//! On a cell `f(x, ν) = p₀(x) + p₁(x) ν + r` with `|r| ≤ R`, where the parameter `ν` of the symbol lies between −1 and 1. A
//! linear function of `ν` lies between its ends, so sizes are told of both, `|p₀ ± p₁|` more or less `R`: in between they are
//! no larger than the same mean of two bounds, and no smaller than that of two sizes that are reached at one instant. So sizes
//! that change alike are compared as nearly as the curvature over the symbol allows.

use super::grid::Grid;
use super::on_cell::OnCell;
use super::opening::ends;
use crate::ball::Ball;
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::signal::{Taylor, middle_and_half};
use num_traits::{One as _, Signed as _, ToPrimitive as _, Zero as _};
use wavestep_polynomial::Rational;

/// A cell is sampled at the ends of this many equal parts.
const PARTS: i64 = 64;

/// How often it is sampled again near the largest value that was found.
const REFINED: usize = 2;

/// How often a cell is halved for a bound.
const DEPTH: usize = 14;

/// A function on a cell.
struct OneStep {
    /// Its part that the window has for some value of the symbol, and for every one where there is such.
    reach: [Rational; 2],
    within: Option<[Rational; 2]>,
    /// `p₀ + p₁` and `p₀ − p₁`, both with `R`, where `0 ≤ x ≤ 1`.
    ends: [Taylor; 2],
}

/// What a size is at both ends of the symbol.
pub type Ends = [Rational; 2];

/// A function on a window.
pub struct Envelope(Vec<OneStep>);

/// A window in steps since the start: between which numbers its first time and its last lie.
pub struct StepWindow {
    pub from: [Rational; 2],
    pub to: [Rational; 2],
}

impl StepWindow {
    /// How many there are at most.
    pub fn count(&self) -> usize {
        self.to[1].floor().to_usize().map_or(usize::MAX, |last| last.saturating_add(1))
    }
}

impl Envelope {
    /// A function on cells of a window, the first of them with this number.
    pub fn of((first, cells): (usize, &[OnCell]), grid: &Grid, window: &StepWindow) -> Envelope {
        let one = |(cell, own): (usize, &OnCell)| {
            let start = ends(&grid.start(cell));
            let length = ends(grid.length(cell));
            // The first place (0) and the last (1) at which a time may be on this cell.
            let place = |time: &Rational, which: usize| {
                let since = time - &start[1 - which];
                let is_longest = since.is_negative() != (which == 0);
                since / &length[usize::from(is_longest)]
            };
            let part = |[from, to]: [Rational; 2]| {
                let part = [from.max(Rational::zero()), to.min(Rational::one())];
                // The end of a cell is the beginning of the next.
                (part[0] <= part[1] && !part[0].is_one()).then_some(part)
            };
            let reach = part([place(&window.from[0], 0), place(&window.to[1], 1)])?;
            let within = part([place(&window.from[1], 1), place(&window.to[0], 0)]);
            Some(OneStep { reach, within, ends: own.ends() })
        };
        Envelope((first..).zip(cells).filter_map(one).collect())
    }

    /// Sizes at both ends of the symbol that are reached at one instant, as near to the largest as is found; none where
    /// no instant is found at which the function is told from zero.
    pub fn reached(&self) -> Option<Ends> {
        let steps = self.0.iter().filter_map(|step| Some((step, step.within.as_ref()?)));
        // Cells that may reach most come first; those that cannot reach what is found are not sampled.
        let mut steps: Vec<_> =
            steps.map(|(step, within)| (step.at_most(within), step, within)).collect();
        steps.sort_by(|one, other| other.0.cmp(&one.0));
        let mut found: Option<(&OneStep, &[Rational; 2], (Rational, Ends))> = None;
        for (most, step, within) in steps {
            let is_passed = |best: &(_, _, (Rational, Ends))| most <= *smaller_of(&best.2.1);
            if found.as_ref().is_some_and(is_passed) {
                break;
            }
            let Some(best) = step.best(within) else { continue };
            let is_larger =
                |old: &(_, _, (Rational, Ends))| smaller_of(&best.1) > smaller_of(&old.2.1);
            if found.as_ref().is_none_or(is_larger) {
                found = Some((step, within, best));
            }
        }
        let (step, [from, to], mut best) = found?;
        let mut part = (to - from) / Rational::from_integer(PARTS.into());
        for _ in 0..REFINED {
            let near = [(&best.0 - &part).max(from.clone()), (&best.0 + &part).min(to.clone())];
            let Some(nearer) = step.best(&near) else { break };
            if smaller_of(&nearer.1) > smaller_of(&best.1) {
                best = nearer;
            }
            part /= Rational::from_integer((PARTS / 2).into());
        }
        Some(best.1)
    }

    /// Whether all values on the window are proven to be no larger than these at both ends of the symbol, and between them than
    /// their mean.
    pub fn is_within(&self, most: &Ends) -> bool {
        self.0.iter().all(|step| step.is_within(most, &step.reach, DEPTH))
    }
}

fn smaller_of(sizes: &Ends) -> &Rational {
    (&sizes[0]).min(&sizes[1])
}

impl OneStep {
    /// A size that it passes between two places at no more than one end of the symbol.
    fn at_most(&self, [from, to]: &[Rational; 2]) -> Rational {
        let (middle, half) = middle_and_half(from, to);
        let sizes =
            self.ends.each_ref().map(|end| end.part(&middle, &half, BITS).range().magnitude());
        Rational::from(&sizes[0].min(sizes[1]))
    }

    /// Where of some places its sizes are largest, and these sizes.
    fn best(&self, [from, to]: &[Rational; 2]) -> Option<(Rational, Ends)> {
        let at = |part: i64| from + (to - from) * Rational::new(part.into(), PARTS.into());
        let sizes = (0..=PARTS).map(at).filter_map(|at| Some((at.clone(), self.at_least(&at)?)));
        sizes.max_by(|one, other| smaller_of(&one.1).cmp(smaller_of(&other.1)))
    }

    /// Sizes that it has at an instant at least; none where it may be zero. With both signs it is, between the ends.
    fn at_least(&self, at: &Rational) -> Option<Ends> {
        let at = Ball::from_rational(at, BITS);
        let values = self.ends.each_ref().map(|end| end.value(&at, BITS));
        let has_sign = values[0].sign() == values[1].sign() && !values[0].contains_zero();
        has_sign.then(|| values.map(|value| value.smallest_size()))
    }

    fn is_within(&self, most: &Ends, [from, to]: &[Rational; 2], depth: usize) -> bool {
        let (middle, half) = middle_and_half(from, to);
        let parts = self.ends.each_ref().map(|end| end.part(&middle, &half, BITS));
        let is_above = |(part, most): (&Taylor, &Rational)| {
            part.coefficient(0).widened(&part.remainder).smallest_size() > *most
        };
        let is_below =
            |(part, most): (&Taylor, &Rational)| Rational::from(&part.range().magnitude()) <= *most;
        if parts.iter().zip(most).all(is_below) {
            return true;
        }
        if depth == 0 || parts.iter().zip(most).any(is_above) {
            return false;
        }
        let halves = [[from.clone(), middle.clone()], [middle, to.clone()]];
        halves.iter().all(|half| self.is_within(most, half, depth - 1))
    }
}
