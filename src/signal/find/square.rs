//! Squares, such as the energy of a spring: no precision tells a double root from a value that is a little larger, but
//! `c q²` with `c > 0` is zero where `q` is, and nowhere below.

use crate::ball::{Ball, Value};
use crate::signal::error::Outcome;
use crate::signal::find::extrema::{Extremum, Place};
use crate::signal::find::roots::{Root, Roots};
use crate::signal::find::search::Search;
use wavestep_polynomial::Rational;

impl Search<'_> {
    /// All roots, where the function is a square.
    pub(super) fn roots_of_square(&self, digits: usize, limit_bits: u64) -> Outcome<Option<Roots>> {
        let Some((factor, squared)) = self.function.square_of() else { return Ok(None) };
        let search = Search::new(squared)?;
        let search = if self.open { search.half_open() } else { search };
        let found = search.roots(&Rational::default(), digits, limit_bits)?;
        let bits = self.bits.get();
        let of_square = |root: Root| match root {
            Root::Simple { time, .. } => Some(Root::Double { time }),
            Root::Jump { .. } => None,
            Root::Undecided { from, to, range, crosses } => {
                let range: Ball = range.square(bits).multiply(&factor, bits);
                Some(Root::Undecided { from, to, range, crosses })
            }
            root => Some(root),
        };
        Ok(Some(Roots { all: found.all.into_iter().filter_map(of_square).collect() }))
    }

    /// The infimum of a square that has a root, which is zero there.
    pub(super) fn smallest_of_square(
        &self,
        digits: usize,
        limit_bits: u64,
    ) -> Outcome<Option<Extremum>> {
        let Some(found) = self.roots_of_square(digits, limit_bits)? else { return Ok(None) };
        if found.all.len() == found.undecided() {
            return Ok(None);
        }
        let place = |root: Root| match root {
            Root::Simple { time, .. } | Root::Double { time } => Some(Place::Critical(time)),
            Root::End { time } => Some(Place::End(time)),
            Root::Arrival { time, before, after } => Some(Place::Arrival { time, before, after }),
            Root::Interval { from, to, closed } => Some(Place::Plateau { from, to, closed }),
            Root::Undecided { from, to, .. } => Some(Place::Undecided { from, to }),
            Root::Jump { .. } => None,
        };
        let places = found.all.into_iter().filter_map(place).collect();
        Ok(Some(Extremum { value: Value::Exact(Rational::default()), places }))
    }
}
