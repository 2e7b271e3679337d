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
use crate::signal::Varying;
use num_traits::{One as _, ToPrimitive as _};
use std::collections::BTreeSet;
use wavestep_polynomial::{Rational, Symbol};

/// The ends of a part differ by more than one in so many.
const FINEST: i64 = 1 << 18;

/// A bound of the largest value is tried that is above one that is reached by these powers of two of it.
const ABOVE: [i64; 4] = [14, 11, 8, 1];

/// Why something is not proven of all values between two.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Unproven {
    pub why: String,
    /// Nearly the same values between which it is not decided, where it is not for another reason.
    pub undecided: Option<Box<[Rational; 2]>>,
}

/// What is compared with a scene.
enum Other<'a> {
    Scene(&'a ScaledScene),
    Arrivals(Arrivals),
}

/// The first arrivals at a place, and that no more come.
struct Arrivals {
    count: usize,
    /// In the scale of the scene: each wave that is seen arrives once in a period, the first time after its delay.
    period: Fraction,
    delays: Vec<Fraction>,
}

/// A claim that a simpler answer is enough, or that it is not.
struct Claim<'a> {
    scene: &'a ScaledScene,
    other: Other<'a>,
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
        let because = |why: &str| Unproven { why: why.to_owned(), undecided: None };
        let told = |error| because(&super::advise::first_line(&error));
        let changed;
        let other = match simpler {
            Simpler::Scene(changes) => {
                changed = self.changed(changes).map_err(told)?;
                Other::Scene(changed.scaled().map_err(told)?)
            }
            Simpler::Modes(_) => return Err(because("modes are not followed over a symbol")),
            Simpler::Arrivals(count) => {
                let arrivals = self.arrivals(asked.quantity, *count).map_err(told)?;
                Other::Arrivals(
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
    fn arrivals(&self, quantity: &str, count: usize) -> Result<Option<Arrivals>, ProblemError> {
        let (network, wanted) = (self.network()?, self.wanted(quantity)?);
        let Some(seen) = wanted.observation() else { return Ok(None) };
        if network.lattice().periods().len() != 1 {
            return Ok(None);
        }
        let period = network.recurrence()?.statement().period.clone();
        let delays = seen.waves.iter().map(|wave| wave.delay.clone()).collect();
        Ok(Some(Arrivals { count, period, delays }))
    }
}

impl Arrivals {
    /// On which steps of a window something arrives, in order; none where its first time may lie on both sides of such a step.
    fn steps(
        &self,
        over: &Over<'_>,
        step: &Root,
        window: &StepsOf,
    ) -> Result<Option<Vec<usize>>, NotOverSymbol> {
        let period = over.whole_steps(&self.period, step)?;
        let last = window.count() as i64;
        let mut steps = BTreeSet::new();
        for delay in &self.delays {
            let mut at = over.whole_steps(delay, step)?;
            while at <= last {
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
            let proven = self.is_proven([&from, &to]);
            match &proven {
                Ok(true) => continue,
                Err(error) if !error.is_of_width() => {
                    return Err(Unproven { why: error.to_string(), undecided: None });
                }
                Ok(false) | Err(_) => {}
            }
            match (middle(&from, &to).filter(|_| looked < MAX_PARTS_OVER_SYMBOL), proven) {
                (Some(middle), _) => left.extend([[middle.clone(), to], [from, middle]]),
                (None, Err(error @ NotOverSymbol::TooManySteps)) => {
                    return Err(Unproven { why: error.to_string(), undecided: None });
                }
                (None, _) => {
                    let why = "undecided".to_owned();
                    return Err(Unproven { why, undecided: Some(Box::new([from, to])) });
                }
            }
        }
        Ok(())
    }

    /// Whether it is proven of all values between two at once.
    fn is_proven(&self, between: [&Rational; 2]) -> Result<bool, NotOverSymbol> {
        let over = |scene| Over::new(scene, &self.quantity, (&self.symbol, between));
        let mut all = vec![over(self.scene)?];
        if let Other::Scene(other) = &self.other {
            all.push(over(other)?);
        }
        let step = Over::step(&all)?;
        let [from, to] = self.window.each_ref().map(|time| all[0].in_steps(time, &step));
        let window = StepsOf { from: from?, to: to? };
        let mut followed = all[0].follow(&step, window.count())?;
        let exact = followed.observed();
        let (same, other) = match &self.other {
            Other::Scene(_) => (0, all[1].follow(&step, window.count())?.observed()),
            Other::Arrivals(own) => {
                let Some(steps) = own.steps(&all[0], &step, &window)? else { return Ok(false) };
                match steps[(own.count - 1).min(steps.len())..] {
                    [last, next, ..] => (next, followed.observed_after(last)?),
                    _ => (exact.len(), Vec::new()),
                }
            }
        };
        let differences = exact.iter().zip(&other).skip(same).map(|(one, other)| one.less(other));
        let mut off = vec![OnStep::constant(&Varying::zero()); same];
        off.extend(differences);
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
