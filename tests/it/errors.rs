//! Errors: each of one kind, with their causes beneath.

use std::error::Error as _;
use wavestep::Error;
use wavestep::answer::WayError;
use wavestep::expression::NotInvertible;
use wavestep::network::NetworkError;
use wavestep::problem::ProblemError;
use wavestep::signal::EvaluateError;
use wavestep::solution::{SolveError, Unsolvable};
use wavestep_polynomial::Integer;

fn unsolved(reason: Unsolvable) -> ProblemError {
    SolveError { wave: "f".to_owned(), order: 3, reason }.into()
}

#[test]
fn each_error_is_of_one_kind() {
    let undecided = EvaluateError::NotFollowed { bits: 64 };
    let errors: [ProblemError; 5] = [
        EvaluateError::EmptyWindow.into(),
        undecided.into(),
        unsolved(Unsolvable::DegreeTooHigh),
        NetworkError::Incommensurate.into(),
        unsolved(NotInvertible::Zero.into()),
    ];
    for (place, error) in errors.into_iter().map(Error::from).enumerate() {
        let kinds = [
            error.is_bad_input(),
            error.is_accuracy_not_reached(),
            error.is_too_much_work(),
            error.is_not_supported(),
            error.is_undefined(),
        ];
        assert_eq!(kinds, std::array::from_fn(|kind| kind == place), "{error}");
    }
}

/// What only hands on an error is left out of the causes; what adds to its message is not.
#[test]
fn causes_stand_beneath() {
    let solve = SolveError { wave: "f".to_owned(), order: 3, reason: Unsolvable::DegreeTooHigh };
    let way = WayError::from(EvaluateError::Solve(solve));
    let error = Error::from(ProblemError::from(way));
    assert!(matches!(error.cause(), ProblemError::Solve(_)));
    assert_eq!(error.to_string(), "f[3] cannot be given exactly: its degree may exceed 4095");
    assert_eq!(error.source().unwrap().to_string(), "its degree may exceed 4095");
    assert_eq!(error.remedy().as_deref(), Some("choose a smaller order"));
}

/// Waves that are those of closed contacts are no choice where contacts open; a joint without mass between two springs is told
/// what to write.
#[test]
fn remedies_can_be_followed() {
    let drill = "scene \"Drill\"\nbar piston { impedance = 1, travel = 1, velocity = 1 }\n\
        bar bit { impedance = 2, travel = 1 }\nspring tip { stiffness = 3 }\nspring rock { stiffness = 6 }\n\
        line free - piston | bit | tip - rock - fixed\ncontacts open\nobserve v = velocity(bit.left)\n";
    let problem = wavestep::Problem::read("drill", drill).unwrap();
    let unknown = problem.signal("w").err().expect("no such name");
    assert_eq!(unknown.remedy().as_deref(), Some("choose one of v"));
    let massless = problem.signal("v").and_then(|v| v.at("60", 6)).expect_err("nothing resists");
    assert!(massless.to_string().contains("a joint without mass moves"), "{massless}");
    assert!(massless.remedy().is_some_and(|remedy| remedy.contains("two springs in a row as one")));
    let alone = drill.replace("spring tip { stiffness = 3 }\n", "").replace("tip - ", "");
    let problem = wavestep::Problem::read("drill", alone.replace("= 6", "= 2")).unwrap();
    assert!(problem.signal("v").and_then(|v| v.at("60", 6)).is_ok());
}

/// Periods are counted as far as a number of them can be read.
#[test]
fn far_more_periods_than_are_computed_are_not_counted() {
    let told = |bits: u32| {
        let periods = (Integer::from(1) << bits) - 1;
        EvaluateError::TooManyPeriods { periods, limit: 9 }.to_string()
    };
    let counted = "there are 18446744073709551615 periods before this time; at most 9 are computed";
    assert_eq!(told(64), counted);
    assert_eq!(
        told(65),
        "there are far more periods before this time than the 9 that are computed"
    );
}
