//! Proof, for all values of a symbol between two, that a simpler answer is enough, or that it is not.
//!
//! The scene and the simpler one are followed for all values at once, as polynomials in the symbol, and so is the difference.
//! Where that does not decide, the values are cut into two parts.

use super::enough_map::{MapRequest, short};
use super::{Problem, Simpler};
use crate::history::envelope::{Ends, Envelope, StepsOf};
use crate::history::family::{NotOverSymbol, Over};
use crate::history::on_step::OnStep;
use crate::language;
use crate::limits::MAX_PARTS_OVER_SYMBOL;
use crate::network::ScaledScene;
use num_traits::{One as _, ToPrimitive as _};
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

/// A claim that a simpler scene is enough, or that it is not.
struct Claim<'a> {
    scenes: [&'a ScaledScene; 2],
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
        let changes = match simpler {
            Simpler::Scene(changes) => changes,
            Simpler::Modes(_) => return Err(because("modes are not followed over a symbol")),
            // One of them may vanish at a value between, and then others are the first.
            Simpler::Arrivals(_) => return Err(because("arrivals are counted at single values")),
        };
        let window = |problem: &Problem| (asked.window)(problem).ok();
        let at = |value| window(&self.substituted(&asked.range.symbol, value).ok()?);
        // A window that is known with the symbol in place is one for all values.
        let window = window(self)
            .filter(|own| [at(from), at(to)].iter().all(|at| at.as_ref() == Some(own)))
            .ok_or_else(|| because("the window is another one for each value"))?;
        let other = self.changed(changes).map_err(told)?;
        let claim = Claim {
            scenes: [self.scaled().map_err(told)?, other.scaled().map_err(told)?],
            symbol: Symbol::new(&language::normalise_name(&asked.range.symbol))
                .ok_or_else(|| because("there is no such symbol"))?,
            quantity: language::normalise_name(asked.quantity),
            window,
            tolerance: &asked.tolerance,
            is_enough,
        };
        claim.prove(from, to)
    }
}

impl Claim<'_> {
    /// Proves it of all values between two, in parts where it must be.
    fn prove(&self, from: &Rational, to: &Rational) -> Result<(), Unproven> {
        let mut left = vec![[from.clone(), to.clone()]];
        let mut looked = 0;
        while let Some([from, to]) = left.pop() {
            looked += 1;
            match self.is_proven([&from, &to]) {
                Ok(true) => continue,
                Err(error) if !error.is_of_width() => {
                    return Err(Unproven { why: error.to_string(), undecided: None });
                }
                Ok(false) | Err(_) => {}
            }
            match middle(&from, &to).filter(|_| looked < MAX_PARTS_OVER_SYMBOL) {
                Some(middle) => left.extend([[middle.clone(), to], [from, middle]]),
                None => {
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
        let [exact, other] = self.scenes.map(over);
        let all = [exact?, other?];
        let step = Over::step(&all)?;
        let [from, to] = self.window.each_ref().map(|time| all[0].in_steps(time, &step));
        let window = StepsOf { from: from?, to: to? };
        let [exact, other] = all.each_ref().map(|own| own.follow(&step, window.count()));
        let (exact, other) = (exact?, other?);
        let off = exact.iter().zip(&other).map(|(one, other)| one.less(other));
        let off = Envelope::of(&off.collect::<Vec<OnStep>>(), &window);
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
