//! Bars and masses: what the source states in words, and its estimates.

use super::Checked;
use crate::book::refusal::Refusal;
use crate::book::stage::derived;
use crate::book::verdict::Verdict;
use num_traits::{One as _, Signed as _};
use std::collections::BTreeMap;
use std::sync::LazyLock;
use wavestep::ball::{Ball, Decimal};
use wavestep::evaluate::{ClosedSignal, Goal, Root, Search};
use wavestep::language::parse_number;
use wavestep::solution::Solution;
use wavestep_polynomial::Rational;

const BITS: u64 = 96;

/// The masses of the striking body, in that of the bar, at which estimates are measured.
const MASSES: [(i64, i64); 12] = [
    (1, 4),
    (1, 2),
    (1, 1),
    (2, 1),
    (3, 1),
    (4, 1),
    (5, 1),
    (6, 1),
    (8, 1),
    (10, 1),
    (15, 1),
    (20, 1),
];

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

/// The estimate without number that comes before 6.86.
pub(super) fn energy_estimate() -> Result<Checked, Refusal> {
    estimate(&root)
}

/// 6.86.
pub(super) fn better_estimate() -> Result<Checked, Refusal> {
    let one = Ball::from_rational(&Rational::one(), BITS);
    estimate(&move |mass| Ok(root(mass)?.add(&one, BITS)))
}

/// `(1/μ + 1/3)^{1/2}`, for a mass `1/μ`.
fn root(mass: &Rational) -> Result<Ball, Refusal> {
    let square = mass + Rational::new(1.into(), 3.into());
    Ball::square_root(&square, BITS).ok_or(Refusal::NotInvertible)
}

/// The largest compressive strain at the fixed end before the mass leaves the bar, in V/c, enclosed.
///
/// The strain there is felt one passage after the wave left the struck end, so that it is that of a
/// closed contact until one passage after the contact opens.
fn largest_strain(mass: &Rational) -> Result<Ball, Refusal> {
    let mu = mass.recip();
    let values = BTreeMap::from([("mu".to_owned(), mu.clone())]);
    let observables = ["strain_impact", "strain_fixed"];
    let solution = Solution::new(derived("mass-on-fixed-bar", &observables, &values)?);
    let observe = |name: &str| {
        let seen = solution.recurrence().observation(name);
        seen.ok_or_else(|| Refusal::UnknownName(name.to_owned()))
    };
    let (impact, fixed) = (observe("strain_impact")?, observe("strain_fixed")?);
    // The first root lies within some four times √μ, half the period of a mass on a spring; the
    // window grows until it holds one.
    let mut end = &mu * Rational::from_integer(4.into()) + Rational::from_integer(2.into());
    let start = Rational::new(1.into(), 1024.into());
    let opening = loop {
        let signal = ClosedSignal::of_recurrence(&solution, &impact, [&start, &end])?;
        let search = Search::new(&signal)?;
        let roots = search.roots(&Rational::default(), 20, 1 << 12)?;
        let simple = roots.all.iter().find_map(|root| match root {
            Root::Simple { time, .. } => Some(time.to_text(15)),
            _ => None,
        });
        if let Some(time) = simple {
            break parse_number(&time)?;
        }
        end *= Rational::from_integer(2.into());
    };
    let last = &opening + &mu;
    let signal = ClosedSignal::of_recurrence(&solution, &fixed, [&mu, &last])?;
    let search = Search::new(&signal)?;
    let smallest = search.enclose_extremum(Goal::Smallest, BITS)?;
    Ok(smallest.multiply_rational(&Rational::from_integer((-1).into()), BITS))
}

/// The largest strains for [`MASSES`], which all estimates are held against.
static LARGEST: LazyLock<Result<Vec<Ball>, Refusal>> = LazyLock::new(|| {
    MASSES.iter().map(|(a, b)| largest_strain(&Rational::new((*a).into(), (*b).into()))).collect()
});

/// An estimate of the largest strain, by the mass, held against the exact one.
fn estimate(of: &dyn Fn(&Rational) -> Result<Ball, Refusal>) -> Result<Checked, Refusal> {
    let mut worst = (Rational::default(), Rational::default());
    let mut steps = vec![
        "Held against the largest compressive strain at the fixed end while the mass touches the bar, \
         enclosed by a search of all extrema."
            .to_owned(),
    ];
    let hundred = Rational::from_integer(100.into());
    let largest = LARGEST.as_ref().map_err(Clone::clone)?;
    for ((above, below), exact) in MASSES.into_iter().zip(largest) {
        let mass = Rational::new(above.into(), below.into());
        let estimate = of(&mass)?;
        let ratio = exact.reciprocal(BITS)?;
        let ratio = ratio.multiply(&estimate, BITS);
        let off = ratio.subtract(&Ball::from_rational(&Rational::one(), BITS), BITS);
        let percent = off.multiply_rational(&hundred, BITS).to_decimal(20);
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
    let ten = Rational::from_integer(10.into());
    let bound = (&worst.0 * &ten).ceil() / ten;
    let bound = Decimal::from_rational(&bound, 6).0;
    let [(first, below), .., (last, _)] = MASSES;
    let told = format!(
        "off by up to {bound} % of the largest strain at {} masses, 1/mu from {first}/{below} to {last}; worst \
         at 1/mu = {}",
        MASSES.len(),
        worst.1
    );
    Ok(Checked { verdict: Verdict::Checked(told), derived: Vec::new(), steps })
}
