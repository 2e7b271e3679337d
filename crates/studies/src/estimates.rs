//! Estimates of the largest strain when a rigid mass strikes a bar whose far end is fixed, and the exact one.
//!
//! The exact strain is enclosed by a search of all extrema at the fixed end, until what the mass does as it leaves the bar
//! arrives there. Masses are in that of the bar, `1/μ`, and strains in `V/c`.

use crate::ratio;
use num_traits::One as _;
use wavestep::ball::Ball;
use wavestep::planner::Purpose;
use wavestep::problem::{
    LargestBetween, Problem, ProblemError, QuantityWindow, geometrically_spaced,
};
use wavestep::signal::{Goal, Root, Search, Signal};
use wavestep_polynomial::Rational;

const BITS: u64 = 96;

/// A range of masses is cut no further once its ends differ by less than one part in this many.
const FINEST: i64 = 1 << 20;

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
        let root = Ball::square_root(&self.square(mass), BITS).expect("a positive number");
        match self {
            Estimate::Better => root.add(&Ball::from_rational(&Rational::one(), BITS), BITS),
            _ => root,
        }
    }

    /// The square of its root.
    fn square(self, mass: &Rational) -> Rational {
        let third = ratio(1, 3);
        match self {
            Estimate::Spring => mass.clone(),
            // ω² = 3/(μ(3 + μ))
            Estimate::Third => mass * mass / (mass + &third),
            Estimate::Energy | Estimate::Better => mass + third,
        }
    }

    /// Its slope over `μ`.
    fn slope(self, mu: &Rational) -> Ball {
        let square = match self {
            Estimate::Third => {
                let root = mu * (ratio(3, 1) + mu);
                -ratio(3, 1) * (ratio(3, 1) + ratio(2, 1) * mu) / (&root * &root)
            }
            _ => -(mu * mu).recip(),
        };
        // (u^{1/2})' = u'/(2 u^{1/2})
        let root = Ball::square_root(&self.square(&mu.recip()), BITS).expect("a positive number");
        let inverse = root.reciprocal(BITS).expect("a positive number");
        inverse.multiply_rational(&(square / ratio(2, 1)), BITS)
    }

    /// Whether it is within a share of the largest strain for every `μ` between two, at both ends of which the strain has
    /// these bounds. `false` says nothing: for fewer values it may be proven.
    ///
    /// Each estimate is convex over `μ`: it lies below its chord and above each tangent, while the bounds of the strain are
    /// linear. So only ends are compared.
    fn is_within(
        self,
        share: &Rational,
        [from, to]: [&Rational; 2],
        strain: &LargestBetween,
    ) -> bool {
        let (middle, half) = ((from + to) / ratio(2, 1), (to - from) / ratio(2, 1));
        let (touching, slope) = (self.of(&middle.recip()), self.slope(&middle));
        let (above, below) = (Rational::one() + share, Rational::one() - share);
        [(from, -half.clone()), (to, half)].iter().enumerate().all(|(end, (mu, way))| {
            let chord = Rational::from(&self.of(&mu.recip()).endpoints().1);
            let tangent = touching.add(&slope.multiply_rational(way, BITS), BITS);
            chord <= &above * &strain.at_least[end]
                && Rational::from(&tangent.endpoints().0) >= &below * &strain.at_most[end]
        })
    }

    /// The heaviest masses of a range, `[from, to]`, for which it is not proven to be within a share of the largest strain; `None`
    /// where it is proven for all.
    ///
    /// # Errors
    /// As [`largest_strain`].
    pub fn unproven_between(
        self,
        share: &Rational,
        [light, heavy]: [&Rational; 2],
    ) -> Result<Option<[Rational; 2]>, ProblemError> {
        // A stack of parts of `μ`: the heaviest masses are on top.
        let mut left = vec![[heavy.recip(), light.recip()]];
        while let Some([from, to]) = left.pop() {
            let strain = largest_strain_between([&from, &to])?;
            if strain.is_some_and(|strain| self.is_within(share, [&from, &to], &strain)) {
                continue;
            }
            if &to - &from < &from * ratio(1, FINEST) {
                return Ok(Some([to.recip(), from.recip()]));
            }
            let middle = geometrically_spaced(&from, &to, 3, 9).swap_remove(1);
            left.extend([[middle.clone(), to], [from, middle]]);
        }
        Ok(None)
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
    let problem = struck_bar().with("mu", &mu).expect("a built-in scene with one symbol");
    let opening = opening(&mu)?;
    let fixed = signal(&problem, "strain_fixed", [&mu, &(&opening + &mu)])?;
    let smallest = Search::new(&*fixed)?.enclose_extremum(Goal::Smallest, BITS)?;
    Ok(smallest.multiply_rational(&ratio(-1, 1), BITS))
}

/// The same for all `μ` between two at once: bounds at both ends, between which they are linear. `None` where the bounds are
/// too wide to tell.
///
/// The mass stays as long as the strain where it is struck is below zero. It is proven to be so for all `μ` until a time, and
/// above zero once before another one; the strain at the fixed end is taken until one passage after either.
fn largest_strain_between(
    [from, to]: [&Rational; 2],
) -> Result<Option<LargestBetween>, ProblemError> {
    let problem = struck_bar();
    let openings = [opening(from)?, opening(to)?];
    let stays = openings.iter().min().expect("two of them") * ratio(15, 16);
    let leaves = openings.iter().max().expect("two of them") * ratio(5, 4);
    // Above all sizes; a strain that is counted from there is largest where it is most compressive.
    let level = Rational::from(&Estimate::Better.of(&from.recip()).endpoints().1) * ratio(2, 1);
    let largest = |quantity, level: &Rational, until: &Rational| {
        let window = QuantityWindow { quantity, from: &Rational::default(), to: until };
        let told = problem.largest_between(window, level, "mu", [from, to]);
        told.map_err(|_| ProblemError::NoEnd)
    };
    let Some(impact) = largest("strain_impact", &-level.clone(), &stays)? else { return Ok(None) };
    let Some(after) = largest("strain_impact", &-level.clone(), &leaves)? else { return Ok(None) };
    if impact.at_most.iter().any(|most| *most > level)
        || after.at_least.iter().any(|least| *least < level)
    {
        return Ok(None);
    }
    let Some(first) = largest("strain_fixed", &level, &(stays + from))? else { return Ok(None) };
    let Some(last) = largest("strain_fixed", &level, &(leaves + to))? else { return Ok(None) };
    let strains = |sizes: [Rational; 2]| sizes.map(|size| size - &level);
    Ok(Some(LargestBetween { at_least: strains(first.at_least), at_most: strains(last.at_most) }))
}

/// A bar whose far end is fixed, struck by a mass.
fn struck_bar() -> Problem {
    Problem::builtin("mass-on-fixed-bar").expect("a built-in scene")
}

fn signal<'a>(
    problem: &'a Problem,
    name: &str,
    window: [&Rational; 2],
) -> Result<Box<dyn Signal + 'a>, ProblemError> {
    problem.signal_on(&problem.wanted(name)?, window, Purpose::Search)
}

/// A time by which the mass has just left the bar.
fn opening(mu: &Rational) -> Result<Rational, ProblemError> {
    let problem = struck_bar().with("mu", mu).expect("a built-in scene with one symbol");
    // The first root lies within some four times √μ, half the period of a mass on a spring; the
    // window grows until it holds one.
    let mut end = mu * ratio(4, 1) + ratio(2, 1);
    let start = ratio(1, 1024);
    loop {
        let impact = signal(&problem, "strain_impact", [&start, &end])?;
        let roots = Search::new(&*impact)?.roots(&Rational::default(), 20, 1 << 12)?;
        match roots.all.first() {
            Some(Root::Simple { time, .. }) => return Ok(time.bounds()[1].clone()),
            Some(_) => return Err(ProblemError::NoEnd),
            None => {}
        }
        end *= ratio(2, 1);
    }
}
