//! Marches: bounds that hold for many taps, for waves that die out, and beside large functions that
//! are added; no bound where nothing is proven.

use crate::methods::response::Response;
use crate::methods::subject::{Subject, with};
use crate::methods::tally::{Tally, ends};
use crate::methods::{Values, exact, random, times, unit_in_the_last_place};
use num_rational::BigRational;
use wavestep::problem::Problem;
use wavestep::signal::{Evaluator as _, Limit, Marched, MethodError, Taps};

/// A rigid mass whose bar ends in a dashpot: all but a part of each wave is lost; and what is seen
/// beside large functions of time.
const DAMPED: &str = r#"
recurrence "Rigid mass on a damped bar"
symbol mu > 0, r > 0
period 2*mu, local s, time t
wave f, g
equation g[n] = -r*f[n-1]
equation f[n]' + g[n]' = -(f[n] - g[n])
continuous f[n] + g[n] starts at 1
observe velocity = f[n] + g[n]
observe many     = f[n] - 3*f(t - mu/3) + 5*f[n-2] - 7*f(t - 3*mu) + f[n-1]/9
observe beside   = f[n] + 1000*exp(-t) - 999
observe scaled   = f[n]/1048576 - t^2/2
"#;

/// Compares with enclosures; gives the bound in units in the last place of the largest value.
fn compare(subject: &Subject<'_>, tally: &mut Tally) -> f64 {
    let name = &subject.name;
    let marched = subject.marched(true).unwrap_or_else(|error| panic!("{name}: {error}"));
    let bound = marched.bound().unwrap_or_else(|| panic!("{name}: no bound"));
    assert!(marched.law().contains("proven"), "{}", marched.law());
    let mut at = times::special(subject);
    at.extend(times::anywhere(subject, &mut random(41), 100));
    let mut values = vec![f64::NAN; at.len()];
    marched.values(&at, &mut values).unwrap();
    let allowed = |value: f64| exact(bound) + exact(unit_in_the_last_place(value)) / exact(2.0);
    for (time, value) in at.iter().zip(values) {
        let enclosed = ends(&subject.exact(&exact(*time), Limit::Right));
        tally.within(value, enclosed, &allowed(value), || format!("{time:?} in {name}"));
    }
    let arrivals = times::arrivals(subject);
    for side in [Limit::Left, Limit::Right] {
        let values = marched.exact_values(&arrivals, side).unwrap();
        for (time, value) in arrivals.iter().zip(values) {
            let enclosed = ends(&subject.exact(time, side));
            let place = || format!("{time} on the {side:?} in {name}");
            tally.within(value, enclosed, &allowed(value), place);
        }
    }
    bound / unit_in_the_last_place(subject.scale())
}

#[test]
fn many_taps_are_within_the_bound() {
    let mut tally = Tally::new("marched with many taps, of its bound");
    for (mu, last) in [("1/3", "5"), ("2", "30"), ("1/50", "1/2")] {
        for r in ["1", "9/10", "1/3", "1/1000"] {
            for quantity in ["f", "velocity", "many"] {
                let values: Values<'_> = &[("mu", mu), ("r", r)];
                let units = with(DAMPED, values, quantity, ("0", last), |subject| {
                    let taps = Taps::of(subject.form()).unwrap().taps.len();
                    assert_eq!(
                        taps,
                        match quantity {
                            "f" => 1,
                            "velocity" => 2,
                            _ => 5,
                        }
                    );
                    compare(subject, &mut tally)
                });
                assert!(units < 1e4, "{units} units");
            }
        }
    }
    tally.report(4_000);
}

#[test]
fn what_is_added_is_rounded_too() {
    let mut tally = Tally::new("marched beside large functions, of its bound");
    for quantity in ["beside", "scaled"] {
        for mu in ["1", "1/7"] {
            let values: Values<'_> = &[("mu", mu), ("r", "1")];
            with(DAMPED, values, quantity, ("0", "6"), |subject| compare(subject, &mut tally));
        }
    }
    tally.report(500);
}

/// After a thousand periods, against the march in fixed-point numbers.
#[test]
fn bounds_hold_after_many_periods() {
    let mut tally = Tally::new("marched through 1000 periods, of its bound");
    for (mu, last) in [("1", "2000"), ("1/100", "20")] {
        let value = wavestep::language::parse_number(mu).unwrap();
        let response = Response::new(&value, 1001);
        with("rigid-mass", &[("mu", mu)], "f", ("0", last), |subject| {
            let marched = subject.marched(true).unwrap();
            let bound = marched.bound().unwrap();
            let at = times::anywhere(subject, &mut random(42), 1500);
            let mut values = vec![f64::NAN; at.len()];
            marched.values(&at, &mut values).unwrap();
            for (time, value) in at.iter().zip(values) {
                let half = exact(unit_in_the_last_place(value)) / exact(2.0);
                let place = || format!("{time:?} for mu = {mu}");
                tally.within(value, response.at(*time), &(exact(bound) + half), place);
            }
        });
    }
    tally.report(3_000);
}

/// Without a proof there is no bound, and the law says so; the values are the same.
#[test]
fn what_is_not_proven_is_not_claimed() {
    with("rigid-mass", &[("mu", "2/3")], "velocity", ("0", "20"), |subject| {
        let [proven, unproven] = [true, false].map(|proven| subject.marched(proven).unwrap());
        assert_eq!(unproven.bound(), None);
        assert!(unproven.law().contains("no bound"), "{}", unproven.law());
        let at = times::anywhere(subject, &mut random(43), 200);
        let [mut with, mut without] = [vec![0.0; at.len()], vec![1.0; at.len()]];
        proven.values(&at, &mut with).unwrap();
        unproven.values(&at, &mut without).unwrap();
        assert_eq!(with, without);
    });
    // A reflection that makes waves larger is not passive.
    let values: Values<'_> = &[("mu", "1"), ("r", "3/2")];
    with(DAMPED, values, "f", ("0", "8"), |subject| match subject.marched(true) {
        Ok(marched) => {
            if let Some(bound) = marched.bound() {
                let mut tally = Tally::new("marched, growing, of its bound");
                assert!(compare(subject, &mut tally) > 0.0 && bound > 0.0);
            } else {
                assert!(marched.law().contains("no bound"), "{}", marched.law());
            }
        }
        Err(error) => {
            assert!(matches!(error, MethodError::March(_)), "{error}")
        }
    });
}

/// The marched windows are limited, and refused by name beyond.
#[test]
fn too_many_periods_are_refused() {
    let problem = Problem::builtin("rigid-mass").unwrap().with("mu", "1").unwrap();
    let far = BigRational::from_integer(100_000_000_i64.into());
    let question = problem.question("f", [exact(0.0), far]).unwrap();
    let refused = Marched::new(&*question.signal).err().expect("a refusal");
    assert!(matches!(refused, MethodError::TooManyPeriods { limit: 10_000_000, .. }), "{refused}");
}
