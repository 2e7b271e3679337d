//! The formulas stay what they are. A change shows as a difference of formulas; where it is meant,
//! `cargo insta review` accepts it.

use snapshot_regression::formulas;

#[test]
fn the_first_four_pieces() {
    let formulas = formulas(3).unwrap_or_else(|error| panic!("{error}"));
    insta::assert_snapshot!(formulas);
}
