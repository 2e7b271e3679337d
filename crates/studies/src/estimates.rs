//! Estimates of the largest strain when a rigid mass strikes a bar whose far end is fixed, and the exact one.
//!
//! The exact strain is enclosed by a search of all extrema at the fixed end, until what the mass does as it leaves the bar
//! arrives there. Masses are in that of the bar, `1/μ`, and strains in `V/c`.

use crate::ratio;
use num_traits::One as _;
use wavestep::ball::Ball;
use wavestep::planner::Purpose;
use wavestep::problem::{Problem, ProblemError};
use wavestep::signal::{Goal, Root, Search};
use wavestep_polynomial::Rational;

const BITS: u64 = 96;

/// An estimate of the largest strain.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Estimate {
    /// `(1/μ)^{1/2}`: the bar is a spring without mass.
    Spring,
    /// `(3/(μ(3 + μ)))^{1/2}`, the amplitude of `derive --model third`: a third of the mass of the bar rests where it is
    /// struck.
    Third,
    /// `(1/μ + 1/3)^{1/2}`: the energy of the mass, and of a third of that of the bar that moves with it.
    Energy,
    /// `1 + (1/μ + 1/3)^{1/2}`, equation 6.86: the front of the first wave besides.
    Better,
}

impl Estimate {
    /// All of them.
    pub const ALL: [Estimate; 4] =
        [Estimate::Spring, Estimate::Third, Estimate::Energy, Estimate::Better];

    /// Its value for a mass.
    pub fn of(self, mass: &Rational) -> Ball {
        let third = ratio(1, 3);
        let square = match self {
            Estimate::Spring => mass.clone(),
            // ω² = 3/(μ(3 + μ))
            Estimate::Third => mass * mass / (mass + &third),
            Estimate::Energy | Estimate::Better => mass + third,
        };
        let root = Ball::square_root(&square, BITS).expect("a positive number");
        match self {
            Estimate::Better => root.add(&Ball::from_rational(&Rational::one(), BITS), BITS),
            _ => root,
        }
    }
}

/// The largest compressive strain at the fixed end before the mass leaves the bar, enclosed.
///
/// The strain there is felt one passage after the wave left the struck end, so that it is that of a
/// closed contact until one passage after the contact opens.
///
/// # Errors
/// Those of a search that is not decided.
pub fn largest_strain(mass: &Rational) -> Result<Ball, ProblemError> {
    let mu = mass.recip();
    let problem = Problem::builtin("mass-on-fixed-bar")
        .and_then(|problem| problem.with("mu", &mu))
        .expect("a built-in scene with one symbol");
    let signal = |name: &str, window: [&Rational; 2]| {
        problem.signal_on(&problem.wanted(name)?, window, Purpose::Search)
    };
    // The first root lies within some four times √μ, half the period of a mass on a spring; the
    // window grows until it holds one.
    let mut end = &mu * ratio(4, 1) + ratio(2, 1);
    let start = ratio(1, 1024);
    let opening = loop {
        let impact = signal("strain_impact", [&start, &end])?;
        let roots = Search::new(&*impact)?.roots(&Rational::default(), 20, 1 << 12)?;
        match roots.all.first() {
            Some(Root::Simple { time, .. }) => {
                let [_, last] = time.bounds();
                break last;
            }
            Some(_) => return Err(ProblemError::NoEnd),
            None => {}
        }
        end *= ratio(2, 1);
    };
    let fixed = signal("strain_fixed", [&mu, &(&opening + &mu)])?;
    let smallest = Search::new(&*fixed)?.enclose_extremum(Goal::Smallest, BITS)?;
    Ok(smallest.multiply_rational(&ratio(-1, 1), BITS))
}
