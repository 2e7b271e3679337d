//! Loads as series.

use crate::support::fraction;
use wavestep::ball::{Magnitude, Number};
use wavestep::enclosure::Numbers;
use wavestep::expression::Expression;
use wavestep::history::load::Course;
use wavestep::history::series::{CellNorm, Truncation};
use wavestep_polynomial::{Rational, Symbol};

/// `2 − t + t²/3` at `t = 3/2` is exactly `5/4`, falls by nothing, and is bent by 1/3.
#[test]
fn polynomials_are_exact() {
    let time = Symbol::new("t").unwrap();
    let course = fraction("2 - t + 1/3*t*t");
    let course = Course::of(&Numbers::new(&[]), &course.into(), &time, 64).unwrap();
    let ratio = |a: i64, b: i64| Number::Exact(Rational::new(a.into(), b.into()));
    let cut = Truncation::new(64, 0);
    let series = course.series(&ratio(3, 2), &norm(&cut), &cut).unwrap();
    assert_eq!(series.coefficients, [ratio(5, 4), ratio(0, 1), ratio(1, 3)]);
}

/// `(2 + 3t) e^(−t/2) + cos 2t` at `t = 1/3`, continued by 1/5, against the value at 8/15.
#[test]
fn courses_are_continued() {
    let time = Symbol::new("t").unwrap();
    let decaying = Expression::exponential(fraction("-1/2*t")).times(&fraction("2 + 3*t"));
    let course = &decaying + &Expression::cosine(&fraction("2*t"));
    let course = Course::of(&Numbers::new(&[]), &course, &time, 200).unwrap();
    assert!(course.rate() >= Magnitude::from_u64(2));
    let ratio = |a: i64, b: i64| Number::Exact(Rational::new(a.into(), b.into()));
    let cut = Truncation::new(160, 2);
    let series = |t: &Number, cut: &Truncation| course.series(t, &norm(cut), cut).unwrap();
    let near = series(&ratio(1, 3), &cut).value(&ratio(1, 5), &cut);
    let there = series(&ratio(8, 15), &cut).coefficient(0);
    let difference = near.subtract(&there, 200);
    assert_eq!(difference.sign(), None);
    assert!(difference.magnitude() < Magnitude::power_of_two(-120));
    // Few terms: the bound of the rest encloses.
    let few = Truncation { order: 3, ..cut };
    let near = series(&ratio(1, 3), &few).value(&ratio(1, 5), &few);
    assert_eq!(near.subtract(&there, 200).sign(), None);
}

/// That of a cell of length 1/4.
fn norm(cut: &Truncation) -> CellNorm {
    CellNorm::new(Magnitude::power_of_two(-2), cut)
}
