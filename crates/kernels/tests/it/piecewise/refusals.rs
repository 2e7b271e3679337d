//! What the constructor of tables refuses, and what it just accepts.

use super::support::value;
use wavestep_kernels::{MAX_DEGREE, Piece, Table, TableError};

fn piece(start: f64) -> Piece {
    let coefficients = vec![1.0, 0.5];
    Piece { start, centre: start + 0.5, scale: 2.0, coefficients, low: vec![], error: 0.0 }
}

fn refused(change: impl Fn(&mut Piece)) -> TableError {
    let mut pieces = [piece(0.0), piece(1.0), piece(2.0)];
    assert!(Table::new(&pieces, 3.0).is_ok());
    change(&mut pieces[1]);
    Table::new(&pieces, 3.0).unwrap_err()
}

#[test]
fn pieces_are_checked() {
    assert_eq!(Table::new(&[], 1.0).unwrap_err(), TableError::Empty);
    for start in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        assert_eq!(refused(|p| p.start = start), TableError::Start(1));
    }
    assert_eq!(refused(|p| p.start = 2.0), TableError::Start(2));
    for scale in [0.0, -2.0, 3.0, 2.0_f64.next_up(), f64::NAN, f64::INFINITY] {
        assert_eq!(refused(|p| p.scale = scale), TableError::Scale(1));
    }
    for centre in [f64::NAN, f64::INFINITY, f64::MAX] {
        assert_eq!(refused(|p| p.centre = centre), TableError::Centre(1));
    }
    assert_eq!(
        refused(|p| (p.centre, p.scale) = (3e-308, 2.0_f64.powi(-40))),
        TableError::Centre(1)
    );
    assert_eq!(refused(|p| p.scale = 4.0), TableError::Argument(1));
    assert_eq!(refused(|p| p.centre = 1.5_f64.next_up()), TableError::Argument(1));
    assert_eq!(refused(|p| p.start = 0.9), TableError::Argument(1));
    assert_eq!(refused(|p| p.coefficients = vec![0.0; MAX_DEGREE + 2]), TableError::Degree(1));
    assert_eq!(refused(|p| p.low = vec![0.0; 3]), TableError::Low(1));
    for bad in [f64::NAN, f64::INFINITY, 2.0_f64.powi(991)] {
        assert_eq!(refused(|p| p.coefficients[1] = bad), TableError::Coefficient(1));
        assert_eq!(refused(|p| p.low = vec![bad]), TableError::Coefficient(1));
    }
    for error in [-1e-300, f64::NAN, f64::INFINITY] {
        assert_eq!(refused(|p| p.error = error), TableError::Error(1));
    }
}

#[test]
fn the_end_is_checked() {
    for end in [f64::NAN, f64::INFINITY, 0.0_f64.next_down()] {
        assert_eq!(Table::new(&[piece(0.0)], end).unwrap_err(), TableError::End);
    }
    assert_eq!(Table::new(&[piece(0.0)], 1.0_f64.next_up()).unwrap_err(), TableError::Argument(0));
    let point = Table::new(&[piece(0.0)], 0.0).unwrap();
    assert_eq!(value(point.evaluator(), 0.0), 0.5);
    assert!(value(point.evaluator(), f64::MIN_POSITIVE).is_nan());
}

/// The argument is checked exactly: here `u` at the end is above 1 by less than a rounding.
#[test]
fn arguments_are_checked_beyond_rounding() {
    let piece = Piece { centre: -2.0_f64.powi(-60), scale: 1.0, ..piece(0.0) };
    assert_eq!(Table::new(std::slice::from_ref(&piece), 1.0).unwrap_err(), TableError::Argument(0));
    assert!(Table::new(&[piece], 1.0_f64.next_down()).is_ok());
}

#[test]
fn messages_tell_what_is_wrong() {
    let errors = [
        TableError::Start(3),
        TableError::Scale(3),
        TableError::Centre(3),
        TableError::Argument(3),
        TableError::Degree(3),
        TableError::Low(3),
        TableError::Coefficient(3),
        TableError::Error(3),
    ];
    assert!(errors.iter().all(|error| error.to_string().contains("piece 3")));
    assert!(TableError::End.to_string().contains("end"));
    assert!(TableError::Size.to_string().contains("too large"));
}

#[test]
fn missing_coefficients_are_zeros() {
    let empty = Piece { coefficients: vec![], ..piece(0.0) };
    let table = Table::new(&[empty, piece(1.0)], 2.0).unwrap();
    assert_eq!([0.5, 1.5].map(|t| value(table.evaluator(), t)), [0.0, 1.0]);
}
