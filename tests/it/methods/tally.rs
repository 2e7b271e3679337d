//! Comparisons of doubles with enclosures, decided exactly and counted.

use crate::methods::{exact, near};
use num_rational::BigRational;
use num_traits::{Signed as _, Zero as _};
use wavestep::ball::Ball;

/// The most digits in which enclosures are compared: more than any ball proves.
const DIGITS: usize = 2000;

/// The least and the largest number of a ball, in rational numbers.
pub fn ends(ball: &Ball) -> (BigRational, BigRational) {
    let enclosure = ball.to_decimal(DIGITS);
    let (middle, radius) = (enclosure.midpoint().to_rational(), enclosure.radius().to_rational());
    (&middle - &radius, middle + radius)
}

/// Whether no double is nearer to a number, and of two that are as near it is the even one.
pub fn is_nearest(value: f64, number: &BigRational) -> bool {
    let distance = (exact(value) - number).abs();
    [value.next_up(), value.next_down()].into_iter().all(|neighbour| {
        let other = (exact(neighbour) - number).abs();
        distance < other || (distance == other && value.to_bits() & 1 == 0)
    })
}

/// What an enclosure says of a value.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Verdict {
    /// All numbers of the enclosure are as they shall be; the largest error as a part of the bound.
    Good(f64),
    /// Some are, and some are not.
    Undecided,
    /// None is.
    Wrong,
}

/// Whether the numbers between the ends of an enclosure are within a bound of the value.
fn distance(value: f64, (low, high): &(BigRational, BigRational), bound: &BigRational) -> Verdict {
    let value = exact(value);
    let (below, above) = (&value - low, high - &value);
    if -&below > *bound || -&above > *bound {
        return Verdict::Wrong;
    }
    let farthest = below.max(above);
    match farthest <= *bound {
        true if farthest.is_zero() => Verdict::Good(0.0),
        true => Verdict::Good(near(&(farthest / bound))),
        false => Verdict::Undecided,
    }
}

/// Whether the value is the double nearest to the numbers of a ball.
fn rounding(value: f64, ball: &Ball) -> Verdict {
    match ball.rounded() {
        // Zero has one sign in mathematics.
        Some(nearest) if nearest == value => Verdict::Good(0.0),
        Some(_) => Verdict::Wrong,
        None => {
            let (low, high) = ends(ball);
            let possible = is_nearest(value, &low) || is_nearest(value, &high);
            match possible || ball.contains(&exact(value)) {
                true => Verdict::Undecided,
                false => Verdict::Wrong,
            }
        }
    }
}

/// Comparisons of one kind.
pub struct Tally {
    what: &'static str,
    pub comparisons: usize,
    undecided: usize,
    worst: f64,
    place: String,
}

impl Tally {
    pub fn new(what: &'static str) -> Tally {
        Tally { what, comparisons: 0, undecided: 0, worst: 0.0, place: String::new() }
    }

    /// Counts a verdict; fails where it is bad.
    fn count(&mut self, verdict: Verdict, value: f64, place: impl Fn() -> String) {
        self.comparisons += 1;
        match verdict {
            Verdict::Wrong => panic!("{}: {value:e} is wrong at {}", self.what, place()),
            Verdict::Undecided => self.undecided += 1,
            Verdict::Good(part) if part > self.worst => {
                self.worst = part;
                self.place = place();
            }
            Verdict::Good(_) => {}
        }
    }

    /// Fails where no number between the ends of an enclosure is within the bound of the value; where
    /// some are and some are not, nothing is decided.
    pub fn within(
        &mut self,
        value: f64,
        ends: (BigRational, BigRational),
        bound: &BigRational,
        place: impl Fn() -> String,
    ) {
        assert!(value.is_finite(), "{}: {value} at {}", self.what, place());
        self.count(distance(value, &ends, bound), value, place);
    }

    /// Fails unless the value is the double nearest to all numbers of a ball: the first one of those
    /// with so many bits that decides.
    pub fn rounded(
        &mut self,
        value: f64,
        bits: &[u64],
        ball: impl Fn(u64) -> Ball,
        place: impl Fn() -> String,
    ) {
        assert!(value.is_finite(), "{}: {value} at {}", self.what, place());
        let verdicts = bits.iter().map(|bits| rounding(value, &ball(*bits)));
        let verdict = verdicts.into_iter().find(|verdict| *verdict != Verdict::Undecided);
        self.count(verdict.unwrap_or(Verdict::Undecided), value, place);
    }

    /// Fails unless the value is the double nearest to the number, ties to even.
    pub fn nearest(&mut self, value: f64, number: &BigRational, place: impl Fn() -> String) {
        self.comparisons += 1;
        let told = || format!("{}: {value:e} for {number} at {}", self.what, place());
        assert!(is_nearest(value, number), "{}", told());
    }

    /// Counts what another one saw.
    pub fn add(&mut self, other: &Tally) {
        self.comparisons += other.comparisons;
        self.undecided += other.undecided;
        if other.worst > self.worst {
            self.worst = other.worst;
            self.place.clone_from(&other.place);
        }
    }

    /// Prints what was seen; fails where less was compared than meant to be, or too little decided.
    pub fn report(&self, least: usize) {
        let Tally { what, comparisons, undecided, worst, place } = self;
        println!(
            "{what}: {comparisons} comparisons, {undecided} undecided, worst {worst:.3} {place}"
        );
        assert!(*comparisons >= least, "{what}: {comparisons} comparisons are too few");
        assert!(undecided * 1000 <= *comparisons, "{what}: {undecided} undecided");
    }
}

/// Values beside the truth are told, and wide enclosures decide nothing.
#[test]
fn comparisons_can_fail() {
    let third = BigRational::new(1.into(), 3.into());
    let ball = Ball::from_rational(&third, 200);
    let wide = Ball::from_rational(&third, 40);
    let value = 1.0 / 3.0_f64;
    let half_unit = exact(2f64.powi(-55));
    assert!(matches!(distance(value, &ends(&ball), &half_unit), Verdict::Good(part) if part > 0.1));
    for beside in [value.next_up(), value.next_down().next_down()] {
        assert_eq!(distance(beside, &ends(&ball), &half_unit), Verdict::Wrong);
        assert_eq!(rounding(beside, &ball), Verdict::Wrong);
    }
    assert_eq!(distance(value, &ends(&wide), &half_unit), Verdict::Undecided);
    assert_eq!(rounding(value, &ball), Verdict::Good(0.0));
    assert_eq!(rounding(value, &wide), Verdict::Undecided);
    assert_eq!(rounding(0.34, &wide), Verdict::Wrong);
    assert!(is_nearest(value, &third) && !is_nearest(value.next_up(), &third));
    // Half-way between two doubles: the even one.
    let tie = (exact(1.0) + exact(1f64.next_up())) / BigRational::from_integer(2.into());
    assert!(is_nearest(1.0, &tie) && !is_nearest(1f64.next_up(), &tie));
}
