//! A function of time, cell by cell.

use crate::ball::Number;
use crate::enclosure::EnclosureError;
use crate::expression::Fraction;
use crate::history::energy::{Integrand, Wave};
use crate::history::error::HistoryError;
use crate::history::moment::{Clock, Moment};
use crate::history::series::{Series, Truncation};
use crate::signal::Limit;
use std::cmp::Ordering;

/// A function of time from its first cell to its end.
///
/// # Invariants
/// There is a cell before the start. Cells follow each other without gaps; the last one reaches to `end`.
pub(crate) struct Track {
    pub cells: Vec<(Moment, Wave)>,
    pub end: Moment,
}

impl Track {
    /// What is constant for a time before the start.
    ///
    /// # Errors
    /// As [`Clock::number`].
    pub fn new(value: Number, time: &Fraction, clock: &Clock) -> Result<Track, EnclosureError> {
        let start = Moment::at(-time);
        let end = Moment::at(Fraction::zero());
        let wave = Wave::new(Series::constant(value), clock.number(time)?);
        Ok(Track { cells: vec![(start, wave)], end })
    }

    /// What it was before the start.
    pub fn before(&self) -> &Series {
        self.cells[0].1.series()
    }

    /// Goes on with a cell until an instant, which is `length` after its start.
    pub fn push(&mut self, series: Series, end: Moment, length: Number) {
        let start = std::mem::replace(&mut self.end, end);
        self.cells.push((start, Wave::new(series, length)));
    }

    /// Where the n-th cell ends.
    pub fn end_of(&self, number: usize) -> &Moment {
        self.cells.get(number + 1).map_or(&self.end, |(start, _)| start)
    }

    /// The cell that an instant is in; where cells meet, the limit tells which.
    ///
    /// # Errors
    /// [`HistoryError::AfterLast`] after the end; as [`Clock::compare`].
    pub fn cell(
        &self,
        clock: &Clock,
        moment: &Moment,
        limit: Limit,
    ) -> Result<usize, HistoryError> {
        let (mut low, mut high) = (0, self.cells.len());
        // The first cell that ends behind the instant.
        while low < high {
            let middle = low.midpoint(high);
            let is_behind = match clock.compare(self.end_of(middle), moment)? {
                Ordering::Less => false,
                Ordering::Equal => limit == Limit::Left,
                Ordering::Greater => true,
            };
            if is_behind { high = middle } else { low = middle + 1 }
        }
        if low == self.cells.len() {
            return Err(HistoryError::AfterLast);
        }
        Ok(low)
    }

    /// The value at an instant.
    ///
    /// # Errors
    /// As [`Track::cell`].
    pub fn value(
        &self,
        clock: &Clock,
        moment: &Moment,
        limit: Limit,
        cut: &Truncation,
    ) -> Result<Number, HistoryError> {
        let (start, wave) = &self.cells[self.cell(clock, moment, limit)?];
        Ok(wave.series().value(&clock.since(start, moment)?, cut))
    }

    /// `∫ f dt` or `∫ f² dt` from one instant to another, both within the track: the whole of all cells that
    /// end before the last one, up to the end in that one, and less what the first one holds before the
    /// start.
    ///
    /// # Errors
    /// As [`Track::cell`].
    pub fn integral(
        &self,
        integrand: Integrand,
        clock: &Clock,
        [from, to]: [&Moment; 2],
        cut: &Truncation,
    ) -> Result<Number, HistoryError> {
        let mut sum = Number::zero();
        if clock.compare(from, to)? != Ordering::Less {
            return Ok(sum);
        }
        let first = self.cell(clock, from, Limit::Right)?;
        let last = self.cell(clock, to, Limit::Left)?;
        let until = |number: usize, moment: &Moment| -> Result<Number, HistoryError> {
            let (start, wave) = &self.cells[number];
            Ok(wave.until(integrand, &clock.since(start, moment)?, cut))
        };
        for (_, wave) in &self.cells[first..last] {
            sum = sum.add(wave.whole(integrand, cut), cut.bits);
        }
        sum = sum.add(&until(last, to)?, cut.bits);
        Ok(sum.subtract(&until(first, from)?, cut.bits))
    }
}

/// The arriving wave of a node's side.
pub(crate) enum Arriving {
    /// Nothing arrives: there is no bar.
    Nothing,
    /// Always the same: from the far end of an endless bar.
    Constant(Number),
    /// What left the other end of a bar a travel time before.
    Delayed {
        bar: usize,
        /// 0 to the right, 1 to the left.
        direction: usize,
        travel: Fraction,
        /// The cell that arrives now.
        cell: usize,
    },
}

impl Arriving {
    /// The series of what arrives, on a cell that begins at an instant.
    ///
    /// # Errors
    /// As [`Clock::since`].
    pub fn series(
        &self,
        waves: &[[Track; 2]],
        now: &Moment,
        clock: &Clock,
        cut: &Truncation,
    ) -> Result<Series, EnclosureError> {
        match self {
            Arriving::Nothing => Ok(Series::zero()),
            Arriving::Constant(value) => Ok(Series::constant(value.clone())),
            Arriving::Delayed { bar, direction, travel, cell } => {
                let (start, wave) = &waves[*bar][*direction].cells[*cell];
                Ok(wave.series().shift(&clock.since(&start.after(travel), now)?, cut))
            }
        }
    }

    /// Until when that series holds.
    pub fn end(&self, waves: &[[Track; 2]]) -> Option<Moment> {
        match self {
            Arriving::Delayed { bar, direction, travel, cell } => {
                Some(waves[*bar][*direction].end_of(*cell).after(travel))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Magnitude;
    use crate::enclosure::Numbers;
    use crate::history::energy::tests::{direct_energy, exponentials, truncation};
    use proptest::prelude::*;
    use wavestep_polynomial::Rational;

    fn rational(numerator: i64, denominator: i64) -> Rational {
        Rational::new(numerator.into(), denominator.into())
    }

    fn moment(eighths: i64) -> Moment {
        Moment::at(Fraction::constant(&rational(eighths, 8)))
    }

    /// The integral over a window, cell by cell: each series shifted to where the window begins in it, and
    /// summed directly from there.
    fn direct(track: &Track, integrand: Integrand, window: [i64; 2], cut: &Truncation) -> Number {
        let eighths = |moment: &Moment| moment.delay.as_constant().unwrap() * rational(8, 1);
        let [from, to] = window.map(|time| rational(time, 1));
        let mut sum = Number::zero();
        for (number, (start, wave)) in track.cells.iter().enumerate() {
            let start = eighths(start);
            let begin = start.clone().max(from.clone());
            let end = eighths(track.end_of(number)).min(to.clone());
            if begin >= end {
                continue;
            }
            let time = |eighths: Rational| Number::Exact(eighths * rational(1, 8));
            let shifted = wave.series().shift(&time(&begin - start), cut);
            let length = time(end - begin);
            let part = match integrand {
                Integrand::Square | Integrand::RoughSquare => direct_energy(&shifted, &length, cut),
                Integrand::Wave => shifted.integral(Number::zero(), cut).value(&length, cut),
            };
            sum = sum.add(&part, cut.bits);
        }
        sum
    }

    /// A cell is a constant, a rational line, or a sum of exponentials, and so many eighths long.
    #[derive(Clone, Debug)]
    enum Shape {
        Line(i64, i64),
        Exponentials(Vec<(i64, i64)>),
    }

    fn cells() -> impl Strategy<Value = Vec<(Shape, i64)>> {
        let term = (-6_i64..7, -2_i64..3);
        let shape = prop_oneof![
            (-6_i64..7, -2_i64..3).prop_map(|(a, b)| Shape::Line(a, b)),
            prop::collection::vec(term, 1..3).prop_map(Shape::Exponentials),
        ];
        prop::collection::vec((shape, 1_i64..9), 1..7)
    }

    proptest! {
        /// Windows begin and end within cells and where they meet; asked again, the same is told.
        #[test]
        fn integrals_are_those_of_the_direct_sum(
            cells in cells(),
            windows in prop::collection::vec((-8_i64..50, -8_i64..50), 1..8),
        ) {
            let clock = Clock::new(Numbers::new(&[]), 128, &crate::network::Assumed::default());
            let cut = truncation(128, 2);
            let mut track = Track::new(Number::integer(2), &Fraction::one(), &clock).unwrap();
            let mut last = 0;
            for (shape, length) in &cells {
                let series = match shape {
                    Shape::Line(a, b) => {
                        let line = [*a, *b].map(|c| Number::Exact(rational(c, 3)));
                        Series::new(line.to_vec(), Magnitude::ZERO)
                    }
                    Shape::Exponentials(own) => {
                        let terms = own.iter().map(|&(a, rate)| (rational(a, 3), rational(rate, 2)));
                        exponentials(&terms.collect::<Vec<_>>(), &cut)
                    }
                };
                last += length;
                track.push(series, moment(last), Number::Exact(rational(*length, 8)));
            }
            let is_exact = cells.iter().all(|(shape, _)| matches!(shape, Shape::Line(..)));
            for (one, other) in windows {
                let window = [one.min(other).min(last), one.max(other).min(last)];
                let [from, to] = window.map(moment);
                for integrand in [Integrand::Wave, Integrand::Square, Integrand::RoughSquare] {
                    let told = || track.integral(integrand, &clock, [&from, &to], &cut).unwrap();
                    let (kept, direct) = (told(), direct(&track, integrand, window, &cut));
                    prop_assert_eq!(&kept, &told());
                    if is_exact {
                        prop_assert_eq!(&kept, &direct);
                        prop_assert!(kept.exact().is_some());
                    }
                    let off = kept.subtract(&direct, 256).ball(256);
                    prop_assert!(off.contains_zero(), "{off}");
                    let bits = if integrand == Integrand::RoughSquare { 45 } else { 102 };
                    prop_assert!(off.magnitude() < Magnitude::power_of_two(-bits), "{off}");
                }
            }
        }
    }
}
