//! Integrals over the cells of a wave, against the direct sum.

use super::squares::{direct_energy, exponentials, truncation};
use proptest::prelude::*;
use wavestep::ball::{Magnitude, Number};
use wavestep::enclosure::Numbers;
use wavestep::expression::Fraction;
use wavestep::history::energy::Integrand;
use wavestep::history::moment::{Clock, Moment};
use wavestep::history::series::{Series, Truncation};
use wavestep::history::track::Track;
use wavestep::network::Assumed;
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
    for number in 0..track.cells.count() {
        let (start, wave) = track.cells.get(number);
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
            Integrand::Square { .. } => direct_energy(&shifted, &length, cut),
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

fn cells() -> BoxedStrategy<Vec<(Shape, i64)>> {
    let term = (-6_i64..7, -2_i64..3);
    let shape = prop_oneof![
        (-6_i64..7, -2_i64..3).prop_map(|(a, b)| Shape::Line(a, b)),
        prop::collection::vec(term, 1..3).prop_map(Shape::Exponentials),
    ];
    prop::collection::vec((shape, 1_i64..9), 1..7).boxed()
}

proptest! {
    /// Windows begin and end within cells and where they meet; asked again, the same is told.
    #[test]
    fn integrals_are_those_of_the_direct_sum(
        cells in cells(),
        windows in prop::collection::vec((-8_i64..50, -8_i64..50), 1..8),
    ) {
        let clock = Clock::new(Numbers::new(&[]), 128, &Assumed::default());
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
            let square = |bits| Integrand::Square { bits };
            let told = track.integral(square(96), &clock, [&from, &to], &cut).unwrap();
            let few = told.subtract(&direct(&track, square(96), window, &cut), 256).ball(256);
            prop_assert!(few.contains_zero() && few.magnitude() < Magnitude::power_of_two(-75));
            for integrand in [Integrand::Wave, Integrand::ROUGH_SQUARE] {
                let told = || track.integral(integrand, &clock, [&from, &to], &cut).unwrap();
                let (kept, direct) = (told(), direct(&track, integrand, window, &cut));
                prop_assert_eq!(&kept, &told());
                if is_exact {
                    prop_assert_eq!(&kept, &direct);
                    prop_assert!(kept.exact().is_some());
                }
                let off = kept.subtract(&direct, 256).ball(256);
                prop_assert!(off.contains_zero(), "{off}");
                let bits = if integrand == Integrand::ROUGH_SQUARE { 45 } else { 102 };
                prop_assert!(off.magnitude() < Magnitude::power_of_two(-bits), "{off}");
            }
        }
    }
}
