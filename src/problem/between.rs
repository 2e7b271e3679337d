//! Proof, for all values of a symbol between two, that a simpler answer is enough, and that others are not.
//!
//! The scene and simpler ones are followed for all values at once, as polynomials in the symbol, and so is the difference.
//! Where that does not decide, the values are cut into two parts.

use super::enough_map::{MapRequest, short};
use super::{Problem, ProblemError, Simpler};
use crate::history::envelope::{Ends, Envelope, StepsOf};
use crate::history::family::{NotOverSymbol, OnStep, Over};
use crate::language::{self, Change, Stated};
use crate::limits::MAX_PARTS_OVER_SYMBOL;
use crate::network::ScaledScene;
use crate::planner::Purpose;
use crate::signal::Limit;
use num_traits::{One as _, ToPrimitive as _, Zero as _};
use wavestep_polynomial::{Rational, Symbol};

/// The ends of a part differ by more than one in so many.
const FINEST: i64 = 1 << 18;

/// A bound of the largest value is tried that is above one that is reached by these powers of two of it.
const ABOVE: [i32; 4] = [-20, -14, -8, -1];

/// In a window so many times as long an arrival is looked for.
const LONGER: [i64; 3] = [1, 2, 4];

/// Why something is not proven of all values between two.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Unproven {
    pub why: String,
    /// Nearly the same values between which it is not decided, where it is not for another reason.
    pub undecided: Option<[Rational; 2]>,
}

/// What is to be proven of a simpler answer: that it is enough, or that it is not.
pub struct Claim<'s> {
    pub simpler: &'s Simpler,
    pub is_enough: bool,
}

/// A claim as far as it is proven.
struct Open<'c> {
    place: usize,
    answer: &'c Followed,
    is_enough: bool,
}

/// A simpler answer for all values of the symbol.
enum Followed {
    Scene(Box<ScaledScene>),
    /// When the last arrival that counts comes, at values of the symbol.
    Until(Vec<(Rational, Rational)>),
}

struct Prover<'a> {
    exact: &'a ScaledScene,
    symbol: Symbol,
    quantity: String,
    window: [Rational; 2],
    tolerance: &'a Rational,
    /// Of each claim, once it is not.
    unproven: Vec<Option<Unproven>>,
    /// How many parts were looked at, and how many of them were not cut.
    parts: usize,
    kept: usize,
}

#[doc(hidden)]
impl Problem {
    /// Which of some claims are not proven for all values of the symbol from one to another, and in how many parts the others
    /// are.
    pub fn prove_between(
        &self,
        asked: &MapRequest<'_>,
        [from, to]: [&Rational; 2],
        claims: &[Claim<'_>],
    ) -> (Vec<Option<Unproven>>, usize) {
        let prepared = || {
            let symbol =
                Symbol::new(&language::normalise_name(&asked.range.symbol)).ok_or("no symbol")?;
            // A window that is known with the symbol in place is one for all values.
            let window = |problem: &Problem| (asked.window)(problem).ok();
            let at = |value| window(&self.substituted(&asked.range.symbol, value).ok()?);
            let all = window(self)
                .filter(|own| [at(from), at(to)].iter().all(|at| at.as_ref() == Some(own)));
            let window = all.ok_or("the window is another one for each value")?;
            let exact = self.scaled().map_err(|error| error.to_string())?;
            Ok::<_, String>((symbol, window, exact))
        };
        let (symbol, window, exact) = match prepared() {
            Ok(prepared) => prepared,
            Err(why) => return (vec![Some(Unproven::because(why)); claims.len()], 0),
        };
        let answers = claims.iter().map(|claim| self.followed(asked, claim.simpler, [from, to]));
        let answers: Vec<_> = answers.collect();
        let refused = answers.iter().map(|answer| answer.as_ref().err());
        let unproven = refused.map(|why| why.cloned().map(Unproven::because)).collect();
        let mut prover = Prover {
            exact,
            symbol,
            quantity: language::normalise_name(asked.quantity),
            window,
            tolerance: &asked.tolerance,
            unproven,
            parts: 0,
            kept: 0,
        };
        let open =
            claims.iter().zip(&answers).enumerate().filter_map(|(place, (claim, answer))| {
                Some(Open { place, answer: answer.as_ref().ok()?, is_enough: claim.is_enough })
            });
        let open: Vec<Open<'_>> = open.collect();
        prover.prove([from, to], &open.iter().collect::<Vec<_>>());
        (prover.unproven, prover.kept)
    }

    /// A simpler answer for all values of the symbol.
    fn followed(
        &self,
        asked: &MapRequest<'_>,
        simpler: &Simpler,
        ends: [&Rational; 2],
    ) -> Result<Followed, String> {
        let scene = |changes: &[Change]| {
            let source = language::changed(&self.source, changes)?;
            match language::read(&source, &self.values)? {
                Stated::Scene(scene) => Ok(Followed::Scene(Box::new(ScaledScene::of(&scene)?))),
                Stated::Recurrence(_) => Err(ProblemError::Equations(self.title().to_owned())),
            }
        };
        let told = |error: ProblemError| super::advise::first_line(&error);
        match simpler {
            Simpler::Scene(changes) => scene(changes).map_err(told),
            Simpler::Modes(_) => Err("modes are not followed over a symbol".to_owned()),
            Simpler::Arrivals(count) => {
                let arrival = |value: &Rational| {
                    let time = self.arrival(asked, value, *count).map_err(told)?;
                    Ok::<_, String>(time.map(|time| (value.clone(), time)))
                };
                let known = ends.map(arrival).into_iter().collect::<Result<Vec<_>, _>>()?;
                let known: Vec<_> = known.into_iter().flatten().collect();
                let none = || Err("so many arrivals are not found".to_owned());
                if known.is_empty() { none() } else { Ok(Followed::Until(known)) }
            }
        }
    }

    /// When an arrival comes at a value of the symbol, in a window from the start on or a longer one; none where no such
    /// arrival is found.
    fn arrival(
        &self,
        asked: &MapRequest<'_>,
        value: &Rational,
        number: usize,
    ) -> Result<Option<Rational>, ProblemError> {
        let problem = self.substituted(&asked.range.symbol, value)?;
        let ([from, to], wanted) = ((asked.window)(&problem)?, problem.wanted(asked.quantity)?);
        for longer in LONGER.into_iter().filter(|_| from.is_zero()) {
            let to = &to * Rational::from_integer(longer.into());
            let signal = problem.signal_on(&wanted, [&from, &to], Purpose::Stretches)?;
            if number < signal.count()? && !signal.is_instant(number) {
                return Ok(signal.exact_time(number, Limit::Right));
            }
        }
        Ok(None)
    }
}

impl Unproven {
    fn because(why: impl Into<String>) -> Unproven {
        Unproven { why: why.into(), undecided: None }
    }
}

impl Prover<'_> {
    /// Proves what is claimed of all values between two, in parts where it must be.
    fn prove(&mut self, [from, to]: [&Rational; 2], claims: &[&Open<'_>]) {
        let is_open = |own: &&&Open<'_>| self.unproven[own.place].is_none();
        let claims: Vec<&Open<'_>> = claims.iter().filter(is_open).copied().collect();
        if claims.is_empty() {
            return;
        }
        self.parts += 1;
        let (undecided, refused) = match self.decided([from, to], &claims) {
            Ok(decided) => {
                let both = claims.into_iter().zip(decided);
                (both.filter(|(_, is_proven)| !is_proven).map(|(claim, _)| claim).collect(), None)
            }
            Err(error) => (claims, (!error.is_of_width()).then_some(error)),
        };
        let middle =
            middle(from, to).filter(|_| refused.is_none() && self.parts < MAX_PARTS_OVER_SYMBOL);
        match middle.filter(|_| !undecided.is_empty()) {
            Some(middle) => {
                self.prove([from, &middle], &undecided);
                self.prove([&middle, to], &undecided);
            }
            None => {
                self.kept += 1;
                for claim in undecided {
                    self.unproven[claim.place] = Some(match &refused {
                        Some(error) => Unproven::because(error.to_string()),
                        None => Unproven {
                            undecided: Some([from, to].map(Rational::clone)),
                            ..Unproven::because("undecided")
                        },
                    });
                }
            }
        }
    }

    fn over<'s>(
        &'s self,
        scene: &'s ScaledScene,
        between: [&'s Rational; 2],
    ) -> Result<Over<'s>, NotOverSymbol> {
        Over::new(scene, &self.quantity, (&self.symbol, between))
    }

    /// Which claims are proven of all values between two at once.
    fn decided(
        &self,
        between: [&Rational; 2],
        claims: &[&Open<'_>],
    ) -> Result<Vec<bool>, NotOverSymbol> {
        let scenes = claims.iter().map(|claim| match claim.answer {
            Followed::Scene(scene) => &**scene,
            Followed::Until(_) => self.exact,
        });
        let all = std::iter::once(self.exact).chain(scenes).map(|scene| self.over(scene, between));
        let all = all.collect::<Result<Vec<_>, _>>()?;
        let step = Over::step(&all)?;
        let [from, to] = self.window.each_ref().map(|time| all[0].in_steps(time, &step));
        let window = StepsOf { from: from?, to: to? };
        let exact = all[0].follow(&step, window.count(), None)?;
        let size = Envelope::of(&exact, &window);
        let reached = size.reached();
        if reached.iter().any(Rational::is_zero) {
            return Ok(vec![false; claims.len()]);
        }
        let above = ABOVE.map(|power| {
            let more = Rational::new(1.into(), (1_i64 << -power).into());
            scaled(&reached, &(Rational::one() + more))
        });
        let most = above.into_iter().find(|most| size.is_within(most));
        let decide = |(claim, own): (&&Open<'_>, &Over<'_>)| {
            let last = match claim.answer {
                Followed::Scene(_) => None,
                Followed::Until(known) => {
                    let steps = |(value, time): &(Rational, Rational)| {
                        self.over(self.exact, [value; 2])?.steps_until(time, &step)
                    };
                    let steps = known.iter().map(steps).collect::<Result<Vec<_>, _>>()?;
                    let is_one = steps.windows(2).all(|pair| pair[0] == pair[1]);
                    Some(is_one.then_some(steps[0]).ok_or(NotOverSymbol::NoCommonMeasure)?)
                }
            };
            let other = own.follow(&step, window.count(), last)?;
            let off = |(one, other): (&OnStep, &OnStep)| one.less(other);
            let off: Vec<OnStep> = exact.iter().zip(&other).map(off).collect();
            let off = Envelope::of(&off, &window);
            Ok(match claim.is_enough {
                true => off.is_within(&scaled(&reached, self.tolerance)),
                false => most.as_ref().is_some_and(|most| {
                    let most = scaled(most, self.tolerance);
                    off.reached().iter().zip(&most).all(|(off, most)| off > most)
                }),
            })
        };
        claims.iter().zip(&all[1..]).map(decide).collect()
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
