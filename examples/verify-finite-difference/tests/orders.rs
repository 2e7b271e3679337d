//! The orders of convergence are those that theory gives for leapfrog.

use verify_finite_difference::{Errors, LeftEnd, errors, figure, order};
use wavestep_draw::Chart;

fn of_case(end: LeftEnd, cells: usize) -> Errors {
    errors(end, cells).unwrap_or_else(|error| panic!("{error}"))
}

/// The orders between two meshes, one 8 times as fine: of the mean, the root of the mean square, and
/// the largest error.
fn orders(end: LeftEnd) -> [f64; 3] {
    let (coarse, fine) = (of_case(end, 80), of_case(end, 640));
    let between = |of: fn(&Errors) -> f64| order((80, of(&coarse)), (640, of(&fine)));
    [between(|e| e.mean), between(|e| e.square), between(|e| e.largest)]
}

/// Leapfrog is of order 2 where nothing bends sharply, in every norm.
#[test]
fn smooth_fields_show_the_order_of_the_scheme() {
    for order in orders(LeftEnd::Smooth) {
        assert!((order - 2.0).abs() < 0.05, "{order}");
    }
}

/// A scheme of order 2 smears a front over a width of `h^{2/3}`: kinks cost `h^{2/3}` at their place,
/// `h^{4/3}` in the mean, `h` in the root of the mean square.
#[test]
fn kinks_lower_the_order() {
    let [mean, square, largest] = orders(LeftEnd::Push);
    assert!((mean - 4.0 / 3.0).abs() < 0.2, "{mean}");
    assert!((square - 1.0).abs() < 0.2, "{square}");
    assert!((largest - 2.0 / 3.0).abs() < 0.2, "{largest}");
}

/// Jumps cost one power more of that width: `h^{1/3}` in the root of the mean square, and at their place
/// the error does not fall. Behind them the code rings; with `ξ` the distance in widths the ringing falls
/// like `ξ^{−3/4}`, whose integral up to `ξ = h^{−2/3}` is `h^{−1/6}`: `h^{1/2}` in the mean.
#[test]
fn jumps_lower_it_more() {
    let [mean, square, largest] = orders(LeftEnd::Mass);
    assert!((mean - 0.5).abs() < 0.1, "{mean}");
    assert!((square - 1.0 / 3.0).abs() < 0.1, "{square}");
    assert!(largest.abs() < 0.15, "{largest}");
}

/// Against strains of about 1: a wrong sign or factor in the code would not pass.
#[test]
fn the_errors_are_small() {
    assert!(of_case(LeftEnd::Push, 640).largest < 2e-3);
    assert!(of_case(LeftEnd::Mass, 640).mean < 0.03);
}

#[test]
fn the_figure_is_drawn() {
    let svg = figure(&[40, 80]).unwrap().svg();
    assert!(svg.starts_with("<svg") && svg.contains("error of the strain, with jumps"));
}
