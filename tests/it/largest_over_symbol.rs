//! Bounds of a largest value for all values of a symbol hold the largest value at each.

use num_traits::Zero as _;
use wavestep::Rational;
use wavestep::planner::Purpose;
use wavestep::problem::{Problem, QuantityWindow, number};
use wavestep::signal::{Goal, Search};

const BITS: u64 = 96;

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// The strain at the fixed end of a struck bar, counted from a level above all of its values: its largest distance from there
/// is that of the most compressive strain.
#[test]
fn bounds_hold_the_largest_value_at_each_value_of_the_symbol() {
    let problem = Problem::builtin("mass-on-fixed-bar").unwrap();
    let (start, level) = (Rational::zero(), rational(4, 1));
    for (from, to, end) in
        [("3/10", "31/100", "3/2"), ("1", "101/100", "5/2"), ("2", "201/100", "7")]
    {
        let [from, to, end] = [from, to, end].map(|text| number("a value", text).unwrap());
        let window = QuantityWindow { quantity: "strain_fixed", from: &start, to: &end };
        let bounds = problem.largest_between(window, &level, "mu", [&from, &to]).unwrap().unwrap();
        for part in 0..=4 {
            let share = rational(part, 4);
            let between = |[first, last]: &[Rational; 2]| first + (last - first) * &share;
            let mu = between(&[from.clone(), to.clone()]);
            let single = problem.with("mu", &mu).unwrap();
            let wanted = single.wanted("strain_fixed").unwrap();
            let signal = single.signal_on(&wanted, [&start, &end], Purpose::Search).unwrap();
            let smallest = Search::new(&*signal).unwrap();
            let smallest = smallest.enclose_extremum(Goal::Smallest, BITS).unwrap();
            let [low, high] = [smallest.endpoints().1, smallest.endpoints().0]
                .map(|strain| &level - Rational::from(&strain));
            let (least, most) = (between(&bounds.at_least), between(&bounds.at_most));
            assert!(least <= high && low <= most, "mu = {mu}: {least} to {most}");
            assert!(&most - &least < rational(1, 100), "mu = {mu}: {least} to {most}");
        }
    }
}
