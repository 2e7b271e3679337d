//! Functions of time in doubles.

use crate::support::fraction;
use wavestep::enclosure::Numbers;
use wavestep::expression::Expression;
use wavestep::model::course::Course;
use wavestep_polynomial::Symbol;

/// `(2 + 3t) e^{−t/2} + cos(2t)` against the same in doubles.
#[test]
fn courses_are_what_they_are_in_doubles() {
    let t = Symbol::new("t").unwrap();
    let decaying = Expression::exponential(fraction("-1/2*t")).times(&fraction("2 + 3*t"));
    let course = &decaying + &Expression::cosine(&fraction("2*t"));
    let course = Course::of(&Numbers::new(&[]), &course, &t).unwrap();
    for time in [0.0, 0.7, 3.0, 11.0] {
        let direct = (2.0 + 3.0 * time) * f64::exp(-time / 2.0) + f64::cos(2.0 * time);
        assert!((course.value(time) - direct).abs() < 1e-14, "{time}");
    }
    let five = Course::of(&Numbers::new(&[]), &Expression::integer(5), &t).unwrap();
    assert_eq!([0.0, 7.0].map(|time| five.value(time)), [5.0, 5.0]);
    let moving = Course::of(&Numbers::new(&[]), &fraction("t").into(), &t).unwrap();
    assert_eq!(moving.value(7.0), 7.0);
}
