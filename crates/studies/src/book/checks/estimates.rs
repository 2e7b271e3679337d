//! Bars and masses: what the source states in words, and its estimates.

use super::Checked;
use crate::book::refusal::Refusal;
use crate::book::stage::derived;
use crate::book::verdict::Verdict;
use crate::estimates::{Estimate, largest_strain};
use crate::ratio;
use num_traits::{One as _, Signed as _};
use std::collections::BTreeMap;
use std::sync::LazyLock;
use wavestep::ball::{Ball, Decimal};
use wavestep::solution::Solution;
use wavestep_polynomial::Rational;

const BITS: u64 = 96;

/// The masses of the striking body, in quarters of that of the bar, at which estimates are measured.
const QUARTERS: [i64; 12] = [1, 2, 4, 8, 12, 16, 20, 24, 32, 40, 60, 80];

/// Two equal bars: the force is 1/2 during the first period, and would be a pull in the second.
pub(super) fn equal_bars() -> Result<Checked, Refusal> {
    let recurrence = derived("equal-bars", &["force"], &BTreeMap::new())?;
    let solution = Solution::new(recurrence);
    let recurrence = solution.recurrence();
    let force = recurrence.observation("force");
    let force = force.ok_or_else(|| Refusal::UnknownName("force".to_owned()))?;
    let observed = solution.observed(&force, 0, 1)?;
    let values: Vec<Option<Rational>> =
        observed.pieces.iter().map(|piece| piece.as_constant()).collect();
    let period = recurrence.statement().period.as_constant();
    let (Some(period), [Some(first), Some(second)]) = (period, &values[..]) else {
        return Err(Refusal::DependsOnPeriod);
    };
    // The striking bar has impedance, travel time and velocity 1, so its momentum is 1.
    let impulse = first * &period;
    let holds = impulse.is_one() && first.is_positive() && second.is_negative();
    let steps = vec![
        format!(
            "In the scene of two equal bars the contact presses with {first} of Z V for the first \
             period, 2 L/c, and would have to pull with {} of Z V in the second: the bars part at \
             2 L/c.",
            second.abs()
        ),
        format!(
            "The impulse until then is {impulse} of the momentum of the striking bar: it is at rest \
             in the mean, the other bar moves at V in the mean, and they part at V."
        ),
    ];
    match holds {
        true => Ok(Checked::proved(steps)),
        false => Err(Refusal::Differs("the force of equal bars".to_owned(), "the text".to_owned())),
    }
}

/// The largest strains for these masses, which all estimates are held against.
static LARGEST: LazyLock<Result<Vec<Ball>, Refusal>> = LazyLock::new(|| {
    let strain = |own: &i64| {
        largest_strain(&ratio(*own, 4)).map_err(|error| Refusal::Problem(error.to_string()))
    };
    QUARTERS.iter().map(strain).collect()
});

/// An estimate of the largest strain, by the mass, held against the exact one.
pub(super) fn estimate(of: Estimate) -> Result<Checked, Refusal> {
    let mut worst = (Rational::default(), Rational::default());
    let mut steps = vec![
        "Held against the largest compressive strain at the fixed end while the mass touches the bar, \
         enclosed by a search of all extrema."
            .to_owned(),
    ];
    let largest = LARGEST.as_ref().map_err(Clone::clone)?;
    for (quarters, exact) in QUARTERS.into_iter().zip(largest) {
        let mass = ratio(quarters, 4);
        let estimate = of.of(&mass);
        let share = exact.reciprocal(BITS)?.multiply(&estimate, BITS);
        let off = share.subtract(&Ball::from_rational(&Rational::one(), BITS), BITS);
        let percent = off.multiply_rational(&ratio(100, 1), BITS).to_decimal(20);
        let middle = percent.midpoint().to_rational();
        let size = middle.abs() + percent.radius().to_rational();
        steps.push(format!(
            "1/mu = {mass}: exact {}, estimate {}, off by {} %",
            exact.to_decimal(6).midpoint(),
            estimate.to_decimal(6).midpoint(),
            Decimal::from_rational(&middle, 3).0,
        ));
        if size > worst.0 {
            worst = (size, mass);
        }
    }
    // Rounded upwards to a tenth of a per cent.
    let bound = (&worst.0 * ratio(10, 1)).ceil() / ratio(10, 1);
    let bound = Decimal::from_rational(&bound, 6).0;
    let [first, .., last] = QUARTERS.map(|quarters| ratio(quarters, 4));
    let told = format!(
        "off by up to {bound} % of the largest strain at {} masses, 1/mu from {first} to {last}; worst at \
         1/mu = {}",
        QUARTERS.len(),
        worst.1
    );
    Ok(Checked { verdict: Verdict::Checked(told), derived: Vec::new(), steps })
}
