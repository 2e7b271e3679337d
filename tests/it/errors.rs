//! Errors: each of one kind, with their causes beneath.

use std::error::Error as _;
use wavestep::Error;
use wavestep::answer::WayError;
use wavestep::expression::NotInvertible;
use wavestep::network::NetworkError;
use wavestep::problem::ProblemError;
use wavestep::signal::EvaluateError;
use wavestep::solution::{SolveError, Unsolvable};

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
