//! Proof, for all values of a symbol between two, that a simpler answer is enough, or that it is not.
//!
//! The scene and the simpler one are followed for all values at once, as polynomials in the symbol, and so is the difference.
//! Where that does not decide, the values are cut into two parts.

use super::enough_map::{MapRequest, short};
use super::{Problem, ProblemError, Simpler};
use crate::ball::Arithmetic as _;
use crate::expression::{Fraction, Root};
use crate::history::family::envelope::{Ends, Envelope, StepsOf};
use crate::history::family::on_step::OnStep;
use crate::history::family::{NotOverSymbol, Over};
use crate::language;
use crate::limits::MAX_PARTS_OVER_SYMBOL;
use crate::network::ScaledScene;
use crate::recurrence::ObservedWave;
use crate::signal::Varying;
use num_traits::{One as _, ToPrimitive as _};
use std::collections::BTreeSet;
use wavestep_polynomial::{Rational, Symbol};

/// A part is cut no further once its ends differ by less than one in so many.
const FINEST: i64 = 1 << 18;

/// Bounds that are tried for the largest value: what is reached, times `1 + 2^-k`.
const ABOVE: [i64; 4] = [14, 11, 8, 1];

/// Why something is not proven of all values between two.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Unproven {
    pub why: String,
    /// Where it was tried, the first part of the range that was not decided: of all values below it is proven, and none
    /// beyond was tried.
    pub undecided: Option<Box<[Rational; 2]>>,
}

impl Unproven {
    /// For all of a range.
    pub(super) fn because(why: &str) -> Unproven {
        Unproven { why: why.to_owned(), undecided: None }
    }
}

/// What is compared with a scene.
enum Compared<'a> {
    Scene(&'a ScaledScene),
    FirstArrivals(Arrivals),
}

/// The first arrivals of a quantity; later ones are left out.
pub(super) struct Arrivals {
    count: usize,
    /// In the scale of the scene: each wave that is seen arrives once in a period, the first time after its delay.
    period: Fraction,
    /// The delay of each, and what it is multiplied with.
    waves: Vec<(Fraction, Fraction)>,
}

/// A claim that a simpler answer is enough, or that it is not.
struct Claim<'a> {
    scene: &'a ScaledScene,
    other: Compared<'a>,
    symbol: Symbol,
    quantity: String,
    window: [Rational; 2],
    tolerance: &'a Rational,
    is_enough: bool,
}

#[doc(hidden)]
impl Problem {
    /// Proves, for all values of the symbol from one to another, that a simpler answer is enough, or that it is not.
    ///
    /// # Errors
    /// [`Unproven`].
    pub fn prove_between(
        &self,
        asked: &MapRequest<'_>,
        [from, to]: [&Rational; 2],
        (simpler, is_enough): (&Simpler, bool),
    ) -> Result<(), Unproven> {
        let because = Unproven::because;
        let told = |error| because(&super::advise::first_line(&error));
        let changed;
        let other = match simpler {
            Simpler::Scene(changes) => {
                changed = self.changed(changes).map_err(told)?;
                Compared::Scene(changed.scaled().map_err(told)?)
            }
            Simpler::Modes(_) => return Err(because("modes are not followed over a symbol")),
            Simpler::Arrivals(count) => {
                let arrivals = self.arrivals(asked.quantity, *count).map_err(told)?;
                Compared::FirstArrivals(
                    arrivals
                        .ok_or_else(|| because("its arrivals are not counted over a symbol"))?,
                )
            }
        };
        let window = |problem: &Problem| (asked.window)(problem).ok();
        let at = |value| window(&self.substituted(&asked.range.symbol, value).ok()?);
        // A window that is known with the symbol in place is one for all values.
        let window = window(self)
            .filter(|own| [at(from), at(to)].iter().all(|at| at.as_ref() == Some(own)))
            .ok_or_else(|| because("the window is another one for each value"))?;
        let claim = Claim {
            scene: self.scaled().map_err(told)?,
            other,
            symbol: Symbol::new(&language::normalise_name(&asked.range.symbol))
                .ok_or_else(|| because("there is no such symbol"))?,
            quantity: language::normalise_name(asked.quantity),
            window,
            tolerance: &asked.tolerance,
            is_enough,
        };
        claim.prove(from, to)
    }

    /// The first arrivals of what is linear in the waves; none where these have more than one period.
    pub(super) fn arrivals(
        &self,
        quantity: &str,
        count: usize,
    ) -> Result<Option<Arrivals>, ProblemError> {
        let (network, wanted) = (self.network()?, self.wanted(quantity)?);
        let Some(seen) = wanted.observation() else { return Ok(None) };
        if network.lattice().periods().len() != 1 {
            return Ok(None);
        }
        let period = network.recurrence()?.statement().period.clone();
        let wave =
            |wave: &ObservedWave| Some((wave.delay.clone(), wave.coefficient.as_fraction()?));
        let waves = seen.waves.iter().map(wave).collect::<Option<Vec<_>>>();
        Ok(waves.map(|waves| Arrivals { count, period, waves }))
    }
}

impl Arrivals {
    /// Of the first `count` steps those at whose start something arrives, ascending; none where it may be others for some
    /// value of the symbol: a wave is not seen at all, or the window begins before one of them or after it.
    fn steps(
        &self,
        (over, step): (&Over<'_>, &Root),
        count: usize,
        window: &StepsOf,
    ) -> Result<Option<Vec<usize>>, NotOverSymbol> {
        let period = over.whole_steps(&self.period, step)?;
        let count = i64::try_from(count).map_err(|_| NotOverSymbol::TooManySteps)?;
        let mut steps = BTreeSet::new();
        for (delay, factor) in &self.waves {
            if over.may_be_zero(factor)? {
                return Ok(None);
            }
            let mut at = over.whole_steps(delay, step)?;
            while at < count {
                steps.insert(at);
                at += period;
            }
        }
        let [first, latest] = &window.from;
        let is_after = |at: &i64, time: &Rational| Rational::from_integer((*at).into()) > *time;
        steps.retain(|at| is_after(at, first));
        let is_told = steps.iter().all(|at| is_after(at, latest));
        Ok(is_told.then(|| steps.into_iter().map(|at| at as usize).collect()))
    }
}

impl Claim<'_> {
    /// Proves it of all values between two, in parts where it must be.
    fn prove(&self, from: &Rational, to: &Rational) -> Result<(), Unproven> {
        let mut left = vec![[from.clone(), to.clone()]];
        let mut looked = 0;
        while let Some([from, to]) = left.pop() {
            looked += 1;
            let failure = match self.is_proven([&from, &to]) {
                Ok(true) => continue,
                Ok(false) => None,
                Err(error) if error.may_pass_if_narrower() => Some(error),
                Err(error) => return Err(Unproven::because(&error.to_string())),
            };
            let cut = middle(&from, &to).filter(|_| looked < MAX_PARTS_OVER_SYMBOL);
            match (cut, failure) {
                (Some(middle), _) => left.extend([[middle.clone(), to], [from, middle]]),
                (None, Some(error @ NotOverSymbol::TooManySteps)) => {
                    return Err(Unproven::because(&error.to_string()));
                }
                (None, _) => {
                    let undecided = Some(Box::new([from, to]));
                    return Err(Unproven { why: "undecided".to_owned(), undecided });
                }
            }
        }
        Ok(())
    }

    /// Whether it is proven of all values between two at once.
    fn is_proven(&self, between: [&Rational; 2]) -> Result<bool, NotOverSymbol> {
        let over = |scene| Over::new(scene, &self.quantity, (&self.symbol, between));
        let mut all = vec![over(self.scene)?];
        if let Compared::Scene(other) = &self.other {
            all.push(over(other)?);
        }
        let step = Over::step(&all)?;
        let [from, to] = self.window.each_ref().map(|time| all[0].in_steps(time, &step));
        let window = StepsOf { from: from?, to: to? };
        let mut followed = all[0].follow(&step, window.count())?;
        let exact = followed.observed();
        // From a step on both differ, as these functions do.
        let (first, other) = match &self.other {
            Compared::Scene(_) => (0, all[1].follow(&step, window.count())?.observed()),
            Compared::FirstArrivals(own) => {
                let steps = own.steps((&all[0], &step), exact.len(), &window)?;
                let Some(steps) = steps else { return Ok(false) };
                match steps[own.count.saturating_sub(1).min(steps.len())..] {
                    [last, next, ..] => (next, followed.observed_after(last)?),
                    _ => (exact.len(), Vec::new()),
                }
            }
        };
        let mut off = vec![OnStep::constant(&Varying::zero()); first];
        off.extend(exact.iter().zip(&other).skip(first).map(|(one, other)| one.less(other)));
        let off = Envelope::of(&off, &window);
        let size = Envelope::of(&exact, &window);
        let Some(reached) = size.reached() else { return Ok(false) };
        if self.is_enough {
            return Ok(off.is_within(&scaled(&reached, self.tolerance)));
        }
        let Some(off) = off.reached() else { return Ok(false) };
        let above =
            ABOVE.map(|power| Rational::one() + Rational::new(1.into(), (1_i64 << power).into()));
        let mut bounds = above.iter().map(|factor| scaled(&reached, factor));
        let most = bounds.find(|most| size.is_within(most));
        Ok(most.is_some_and(|most| {
            off.iter().zip(&scaled(&most, self.tolerance)).all(|(off, most)| off > most)
        }))
    }
}

fn scaled(sizes: &Ends, by: &Rational) -> Ends {
    sizes.each_ref().map(|size| size * by)
}

/// A value between two others, with few digits; none where they are nearly the same.
fn middle(from: &Rational, to: &Rational) -> Option<Rational> {
    if (to - from) * Rational::from_integer(FINEST.into()) <= *from {
        return None;
    }
    let [low, high] = [from, to].map(|end| end.to_f64().unwrap_or(f64::NAN));
    short((low * high).sqrt(), 9).filter(|middle| from < middle && middle < to)
}
