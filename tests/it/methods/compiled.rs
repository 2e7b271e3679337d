//! Compiled polynomials: their bound is at most four units in the last place of the largest value,
//! holds, and follows a tolerance.

use crate::methods::response::Response;
use crate::methods::subject::{Subject, with};
use crate::methods::tally::Tally;
use crate::methods::{exact, random, times, unit_in_the_last_place};
use wavestep::language::parse_number;
use wavestep::signal::{Compiled, Evaluator as _, Limit};

/// Values of polynomials, at the ends of all pieces and without pattern, against the march in
/// fixed-point numbers.
fn compare(subject: &Subject<'_>, compiled: &Compiled<'_>, response: &Response, tally: &mut Tally) {
    let bound = exact(compiled.bound().expect("a bound"));
    let mut at = times::anywhere(subject, &mut random(31), 200);
    let starts = compiled.pieces().iter().map(|piece| piece.start);
    let (first, last) = times::ends(subject);
    at.extend(
        starts.flat_map(|start| [start, start.next_down().max(first), start.next_up().min(last)]),
    );
    at.extend([compiled.table().end()]);
    let mut unsorted = vec![f64::NAN; at.len()];
    compiled.values(&at, &mut unsorted).unwrap();
    let mut order: Vec<usize> = (0..at.len()).collect();
    order.sort_by(|i, j| at[*i].total_cmp(&at[*j]));
    let ascending: Vec<f64> = order.iter().map(|i| at[*i]).collect();
    let mut sorted = vec![f64::NAN; at.len()];
    compiled.values(&ascending, &mut sorted).unwrap();
    let place = |time: f64| move || format!("{time:?} in {}", subject.name);
    for (i, value) in order.iter().zip(&sorted) {
        assert_eq!(unsorted[*i].to_bits(), value.to_bits(), "{}", place(at[*i])());
        tally.within(*value, response.at(at[*i]), &bound, place(at[*i]));
    }
}

#[test]
fn four_units_in_the_last_place() {
    let mut tally = Tally::new("compiled, of its bound");
    for mu in ["1/100", "1/4", "1", "10"] {
        let value = parse_number(mu).unwrap();
        let response = Response::new(&value, 202);
        for (from, to) in [(0.0, 6.0), (60.0, 62.0), (196.0, 200.0)] {
            let end = |periods: f64| (&value * exact(2.0 * periods)).to_string();
            with("rigid-mass", &[("mu", mu)], "f", (&end(from), &end(to)), |subject| {
                let compiled = subject.compiled(None).unwrap();
                let units = compiled.bound().unwrap() / unit_in_the_last_place(subject.scale());
                assert!(units <= 4.0, "{units} units for mu = {mu} from period {from}");
                compare(subject, &compiled, &response, &mut tally);
            });
        }
    }
    tally.report(3_000);
}

/// A tolerance is kept, a looser one gives fewer pieces, and a piece less exact is not kept secret.
#[test]
fn a_looser_tolerance_gives_fewer_pieces() {
    let mut tally = Tally::new("compiled to a tolerance, of its bound");
    let value = exact(1.0);
    let response = Response::new(&value, 42);
    with("rigid-mass", &[("mu", "1")], "f", ("72", "80"), |subject| {
        let mut pieces = usize::MAX;
        let mut counts = Vec::new();
        for tolerance in [1e-14, 1e-12, 1e-9, 1e-6, 1e-3] {
            let compiled = subject.compiled(Some(tolerance)).unwrap();
            let bound = compiled.bound().unwrap();
            assert!(bound <= tolerance, "{bound:e} for {tolerance:e}");
            assert!(compiled.pieces().len() <= pieces, "{tolerance:e}");
            pieces = compiled.pieces().len();
            counts.push(pieces);
            compare(subject, &compiled, &response, &mut tally);
        }
        assert!(counts[0] > 2 * counts[4], "{counts:?}");
    });
    tally.report(1_000);
}

/// At exact times, also those that are no doubles: arrivals from both sides are seen on their own
/// pieces.
#[test]
fn arrivals_have_two_values() {
    for (mu, periods) in [("1/3", 30), ("7/10", 12)] {
        let value = parse_number(mu).unwrap();
        let response = Response::new(&value, periods + 2);
        let to = (&value * exact(2.0 * f64::from(periods))).to_string();
        with("rigid-mass", &[("mu", mu)], "f", ("0", &to), |subject| {
            let compiled = subject.compiled(None).unwrap();
            let mut tally = Tally::new("compiled at arrivals, of its bound and half a unit");
            for arrival in times::arrivals(subject) {
                for side in [Limit::Left, Limit::Right] {
                    let value = compiled.value(&arrival, side).unwrap();
                    let half = unit_in_the_last_place(value) / 2.0;
                    let bound = exact(compiled.bound().unwrap()) + exact(half);
                    let enclosed = response.at_exactly(&arrival, side);
                    tally.within(value, enclosed, &bound, || format!("{arrival} {side:?}"));
                }
            }
            tally.report(2 * (periods as usize - 1));
        });
    }
}

/// Between the two doubles next to 1/3 there is none, and values all the same; also where the window
/// is one arrival that is no double.
#[test]
fn a_window_between_two_doubles_has_values() {
    let mut tally = Tally::new("compiled between two doubles, of its bound and half a unit");
    let windows = [("0.33333333333333332", "0.33333333333333334"), ("1/3", "1/3"), ("2/3", "2/3")];
    for (from, to) in windows {
        with("rigid-mass", &[("mu", "1/3")], "f", (from, to), |subject| {
            let compiled = subject.compiled(None).unwrap();
            let response = Response::new(&crate::methods::ratio(1, 3), 3);
            let at = if from == "2/3" {
                crate::methods::ratio(2, 3)
            } else {
                crate::methods::ratio(1, 3)
            };
            for side in [Limit::Left, Limit::Right] {
                let value = compiled.value(&at, side).unwrap();
                let half = unit_in_the_last_place(value) / 2.0;
                let bound = exact(compiled.bound().unwrap()) + exact(half);
                let place = || format!("{at} on the {side:?}");
                tally.within(value, response.at_exactly(&at, side), &bound, place);
            }
        });
    }
    tally.report(6);
}
