//! The first fall of a function through zero.

use super::squares::truncation;
use num_traits::Zero as _;
use wavestep::ball::{Ball, Magnitude, Number};
use wavestep::history::crossing::{self, Beginning, Course, Errors, beginning};
use wavestep::history::series::{Series, Truncation};
use wavestep_polynomial::Rational;

/// With the zeros at the start taken away.
fn follow(f: &Series, length: &Number, cut: &Truncation) -> Course {
    let kept = f.coefficients.iter().skip_while(|c| c.is_zero()).cloned().collect();
    let none = (&Errors::new(0, |_| Magnitude::ZERO), &Magnitude::ZERO);
    crossing::follow(&Series::new(kept, f.rest), none, length, cut)
}

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// The polynomial with these roots and a sign, as balls or exact.
fn product(sign: i64, roots: &[Rational], enclosed: bool) -> Series {
    let mut c = vec![rational(sign, 1)];
    for root in roots {
        let mut next = vec![Rational::zero(); c.len() + 1];
        for (k, c) in c.iter().enumerate() {
            next[k] -= c * root;
            next[k + 1] += c;
        }
        c = next;
    }
    let number = |c: Rational| match enclosed {
        true => Number::Exact(c).enclosed(600),
        false => Number::Exact(c),
    };
    Series::new(c.into_iter().map(number).collect(), Magnitude::ZERO)
}

fn fallen(course: &Course, root: &Rational) -> bool {
    let Course::Falls(found) = course else { panic!("{course:?}") };
    let ball = found.ball(200);
    ball.contains(root) && ball.radius() < &Magnitude::power_of_two(-60)
}

#[test]
fn the_first_fall_is_found_however_near_the_next_root_is() {
    let end = Number::integer(1);
    // With many bits, few of them look first.
    for (enclosed, bits) in [(true, 160), (false, 160), (true, 512)] {
        let cut = truncation(bits, 0);
        let near = &rational(1, 3) + Rational::new(1.into(), 1_000_000_000.into());
        let f = product(-1, &[rational(1, 3), near, rational(2, 3)], enclosed);
        assert_eq!(beginning(&f, &f.coefficients), Beginning::Positive);
        assert!(fallen(&follow(&f, &end, &cut), &rational(1, 3)));
        let f = product(-1, &[rational(1, 3)], enclosed);
        assert!(fallen(&follow(&f, &end, &cut), &rational(1, 3)));
        let f = product(-1, &[rational(-1, 3), rational(0, 1), rational(7, 8)], enclosed);
        assert!(fallen(&follow(&f, &end, &cut), &rational(7, 8)));
        let f = product(1, &[rational(-1, 3), rational(5, 4)], enclosed);
        assert_eq!(beginning(&f, &f.coefficients), Beginning::Negative);
    }
}

/// What is negative by no more than a tie counts as positive, what is more so falls.
#[test]
fn a_tie_passes_over_what_is_as_near_to_zero() {
    let (cut, end) = (truncation(512, 0), Number::integer(1));
    let third = rational(1, 3);
    let tiny = |power: i64| Magnitude::power_of_two(power);
    let none = Errors::new(0, |_| Magnitude::ZERO);
    for (dip, passes) in [(-300, true), (-200, false)] {
        let mut f = product(1, &[third.clone(), third.clone()], true);
        let down = Number::Exact(Rational::from(&tiny(dip)));
        f.coefficients[0] = f.coefficients[0].subtract(&down, 600);
        let found = crossing::follow(&f, (&none, &tiny(-256)), &end, &cut);
        assert_eq!(found == Course::Positive, passes, "{found:?}");
        let root = &third - Rational::from(&tiny(dip / 2));
        match crossing::follow(&f, (&none, &Magnitude::ZERO), &end, &cut) {
            Course::Falls(at) => assert!(at.ball(600).contains(&root), "{at:?}"),
            other => panic!("{other:?}"),
        }
    }
    // One that begins a little below zero and rises is passed over at once, one that falls is not.
    let line = |slope: i64| {
        let c = [Rational::from(&tiny(-300)) * rational(-1, 1), rational(slope, 1)];
        Series::new(c.map(|c| Number::Exact(c).enclosed(600)).to_vec(), Magnitude::ZERO)
    };
    let course = |slope| crossing::follow(&line(slope), (&none, &tiny(-256)), &end, &cut);
    assert_eq!(course(1), Course::Positive);
    assert!(!matches!(course(-1), Course::Positive));
}

/// What is left out of a function moves its root, and may hide it.
#[test]
fn errors_widen_a_root() {
    let cut = truncation(160, 0);
    let (end, third) = (Number::integer(1), rational(1, 3));
    let f = product(-1, std::slice::from_ref(&third), true);
    let small = Magnitude::power_of_two(-90);
    let found = crossing::follow(&f, (&Errors::new(0, |_| small), &Magnitude::ZERO), &end, &cut);
    let Course::Falls(root) = found else { panic!("{found:?}") };
    let root = root.ball(160);
    assert!(root.contains(&third) && *root.radius() >= small);
    let large = Magnitude::power_of_two(-1);
    let value = |order: usize| if order == 0 { large } else { small };
    let found = crossing::follow(&f, (&Errors::new(0, value), &Magnitude::ZERO), &end, &cut);
    assert!(matches!(found, Course::Undecided(_)), "{found:?}");
    // Of x f: near the start by its slope, further on by its value.
    let errors = Errors::new(1, |order| Magnitude::power_of_two(10 * order as i64 - 90));
    assert_eq!(errors.from(&rational(0, 1))[0], Magnitude::power_of_two(-80));
    assert_eq!(errors.from(&rational(1, 4))[0], Magnitude::power_of_two(-88));
}

#[test]
fn what_touches_zero_is_undecided_and_what_stays_above_is_positive() {
    let cut = truncation(96, 0);
    let end = Number::integer(1);
    let third = rational(1, 3);
    let f = product(1, &[third.clone(), third.clone()], true);
    let Course::Undecided(at) = follow(&f, &end, &cut) else { panic!() };
    let distance = at.subtract(&Ball::from_rational(&third, 200), 200).magnitude();
    assert!(distance < Magnitude::power_of_two(-40));
    // (x − 1/3)² + 10^−12, and with a minus.
    // With rational coefficients it is decided.
    let exact = product(1, &[third.clone(), third.clone()], false);
    assert_eq!(follow(&exact, &end, &cut), Course::Positive);
    let mut above = f.clone();
    let tiny = Number::Exact(Rational::new(1.into(), 1_000_000_000_000_i64.into()));
    above.coefficients[0] = above.coefficients[0].add(&tiny, 96);
    assert_eq!(follow(&above, &end, &cut), Course::Positive);
    let mut below = f.clone();
    below.coefficients[0] = below.coefficients[0].subtract(&tiny, 96);
    let root = &third - Rational::new(1.into(), 1_000_000.into());
    let Course::Falls(found) = follow(&below, &end, &cut) else { panic!() };
    assert!(found.ball(96).contains(&root));
}

/// A root at the end of the cell is left to the next cell where it is exact, and undecided or beyond
/// the end otherwise; it is never passed over.
#[test]
fn a_root_at_the_end_is_not_passed_over() {
    let cut = truncation(96, 0);
    let end = Number::integer(1);
    let f = product(-1, &[rational(1, 1)], false);
    assert_eq!(follow(&f, &end, &cut), Course::Positive);
    let g = product(-1, &[rational(1, 1), rational(-1, 2), rational(-1, 3)], false);
    match follow(&g, &end, &cut) {
        Course::Falls(root) => assert!(root.ball(96).contains(&rational(1, 1))),
        Course::Undecided(at) => assert!(at.contains(&rational(1, 1))),
        Course::Positive => panic!("passed over"),
    }
    assert_eq!(beginning(&Series::zero(), &[]), Beginning::Zero);
}
