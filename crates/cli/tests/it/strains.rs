//! For which masses estimates of the largest strain hold, with proof.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use wavestep::Rational;
use wavestep::ball::Ball;
use wavestep::problem::{ProblemError, geometrically_spaced, runs};
use wavestep::signal::EvaluateError;
use wavestep_studies::estimates::{Estimate, largest_strain};

const BITS: u64 = 96;

/// At how many masses it is looked whether an estimate holds.
const LOOKS: usize = 49;

/// The formula of an estimate in LaTeX, in `V/c`.
pub fn formula(estimate: Estimate) -> &'static str {
    match estimate {
        Estimate::Spring => r"(1/\mu)^{1/2}",
        Estimate::Third => r"(3/(\mu (3 + \mu)))^{1/2}",
        Estimate::Energy => r"(1/\mu + 1/3)^{1/2}",
        Estimate::Better => r"1 + (1/\mu + 1/3)^{1/2}",
    }
}

/// The largest strains of masses, each worked out once.
#[derive(Default)]
pub struct Strains(BTreeMap<Rational, Ball>);

impl Strains {
    /// Of one mass.
    pub fn of(&mut self, mass: &Rational) -> Result<Ball, ProblemError> {
        if let Some(known) = self.0.get(mass) {
            return Ok(known.clone());
        }
        let strain = largest_strain(mass)?;
        self.0.insert(mass.clone(), strain.clone());
        Ok(strain)
    }

    /// Whether an estimate is within a share of the largest strain.
    fn holds(
        &mut self,
        estimate: Estimate,
        mass: &Rational,
        share: &Rational,
    ) -> Result<bool, ProblemError> {
        let exact = self.of(mass)?;
        let off = estimate.of(mass).subtract(&exact, BITS);
        let allowed = exact.multiply_rational(share, BITS);
        let (low, high) = (off.subtract(&allowed, BITS), off.add(&allowed, BITS));
        match (low.sign(), high.sign()) {
            (Some(Ordering::Less), Some(Ordering::Greater)) => Ok(true),
            (Some(Ordering::Greater), _) | (_, Some(Ordering::Less)) => Ok(false),
            _ => Err(EvaluateError::AccuracyNotReached { best: Box::new(off), bits: BITS }.into()),
        }
    }

    /// For which masses from 1/4 to 100 an estimate is within a share of the largest strain: the first and the last mass of
    /// each range, at both of which that is proven. At a mass at most one part in a thousand beyond, within 1/4 to 100, it is
    /// proven not to be.
    pub fn ranges(
        &mut self,
        estimate: Estimate,
        share: &Rational,
    ) -> Result<Vec<[Rational; 2]>, ProblemError> {
        let masses = geometrically_spaced(
            &Rational::new(1.into(), 4.into()),
            &Rational::from_integer(100.into()),
            LOOKS,
            3,
        );
        let runs = runs(masses, |mass| self.holds(estimate, mass, share))?;
        Ok(runs.into_iter().filter_map(|run| run.state.then_some(run.between)).collect())
    }
}
