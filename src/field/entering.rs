//! The two waves of every bar as they enter it at its ends, of which fields are made.
//!
//! A wave to the right enters a bar at its left end and passes every section unchanged; one to the left
//! enters at the right end. All fields follow from them. For contacts that stay closed they are sums of
//! echoes; `history` has those of contacts that open.

use super::FieldError;
use crate::ball::Ball;
use crate::evaluate::{Limit, Waves};
use crate::expression::Fraction;
use crate::network::{FieldBar, Network, Way};
use std::ops::RangeInclusive;
use wavestep_polynomial::Rational;

/// A wave of a bar.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Entering {
    /// The bar, by its place in the line.
    pub bar: usize,
    /// Which of its waves.
    pub heading: Heading,
}

/// The direction of a wave.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Heading {
    Right,
    Left,
}

/// A derivative or integral of a wave `f`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Order {
    /// `f'`
    Slope,
    /// `f`
    Value,
    /// `F = ∫ f dt` since the start.
    Integral,
    /// `∫ F dt` since the start.
    DoubleIntegral,
}

/// An instant at the end of a bar, in the scale of the scene, and the limit there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instant<'a> {
    pub at: &'a Fraction,
    pub side: Limit,
    /// Whether an instant beside a break means the break, as in pictures, which look from both sides at
    /// breaks of which only an enclosure is known. The function on that side of the break is then
    /// continued to the instant.
    pub is_drawn: bool,
}

/// The waves that enter the bars of a scene, in its scale, up to a last time: what is added to the state
/// at the start, zero before it,
///
/// ```text
/// v = V + f + g        X = X_0 + Z (f − g)
/// ```
///
/// # Invariants
/// - Enclosures hold for every precision; with more bits they are narrower, up to a limit.
/// - Between two of its breaks a wave has no jump, and its slope has none.
pub(crate) trait EnteringWaves {
    /// An enclosure of a wave, its slope or its integral.
    fn enclose(
        &self,
        wave: Entering,
        order: Order,
        instant: Instant<'_>,
        bits: u64,
    ) -> Result<Ball, FieldError>;

    /// Where a wave may jump or bend in a window, ascending; of an instant that is only enclosed, a
    /// number beside it.
    fn breaks(
        &self,
        wave: Entering,
        window: RangeInclusive<&Fraction>,
    ) -> Result<Vec<Fraction>, FieldError>;
}

/// The waves of a scene whose contacts stay closed.
pub(super) struct ClosedContacts {
    waves: Waves,
    /// Of each bar the waves to the right and to the left.
    ways: Vec<[Option<Way>; 2]>,
}

impl ClosedContacts {
    /// The waves of these bars for times up to `last` of the user's.
    pub fn new(
        network: &Network,
        bars: &[FieldBar],
        last: &Rational,
    ) -> Result<ClosedContacts, FieldError> {
        let ways: Vec<[Option<Way>; 2]> =
            bars.iter().map(|bar| [bar.right.clone(), bar.left.clone()]).collect();
        let waves: Vec<_> = ways.iter().flatten().flatten().flat_map(|way| way.waves).collect();
        Ok(ClosedContacts { waves: Waves::new(network, &waves, last)?, ways })
    }

    fn way(&self, wave: Entering) -> Option<&Way> {
        self.ways[wave.bar][wave.heading as usize].as_ref()
    }
}

impl EnteringWaves for ClosedContacts {
    fn enclose(
        &self,
        wave: Entering,
        order: Order,
        instant: Instant<'_>,
        bits: u64,
    ) -> Result<Ball, FieldError> {
        let Some(way) = self.way(wave) else { return Ok(Ball::zero()) };
        let (level, derivative) = match order {
            Order::Slope => (0, 1),
            Order::Value => (0, 0),
            Order::Integral => (1, 0),
            Order::DoubleIntegral => (2, 0),
        };
        let at = instant.at + &way.lead;
        Ok(self.waves.enclose(way.waves[level], derivative, &at, instant.side, bits)?)
    }

    fn breaks(
        &self,
        wave: Entering,
        window: RangeInclusive<&Fraction>,
    ) -> Result<Vec<Fraction>, FieldError> {
        let Some(way) = self.way(wave) else { return Ok(Vec::new()) };
        let (from, to) = (*window.start() + &way.lead, *window.end() + &way.lead);
        let breaks = self.waves.breaks(&from, &to)?;
        Ok(breaks.into_iter().map(|at| &at - &way.lead).collect())
    }
}
