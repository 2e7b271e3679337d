//! Proof, for all values of a symbol between two, that a simpler answer is enough, or that it is not.
//!
//! The scene and the simpler one are followed for all values at once, as polynomials in the symbol, and so is the difference.
//! Where that does not decide, the values are cut into two parts.

use super::enough_map::{MapRequest, middle};
use super::largest::{Exact, scaled};
use super::{Problem, ProblemError, Simpler};
use crate::expression::{Fraction, Root};
use crate::history::family::envelope::Envelope;
use crate::history::family::grid::Grid;
use crate::history::family::modes::SumOfModes;
use crate::history::family::on_cell::OnCell;
use crate::history::family::{Change, Followed, NotOverSymbol, Over};
use crate::language;
use crate::limits::MAX_PARTS_OVER_SYMBOL;
use crate::network::ScaledScene;
use crate::recurrence::ObservedWave;
use std::collections::BTreeSet;
use wavestep_polynomial::{Rational, Symbol};

/// A part is cut no further once its ends differ by less than one part in this many.
const FINEST: i64 = 1 << 18;

/// A claim is given up at this many undecided intervals, or once one of them has this many parts.
const MOST_UNDECIDED: usize = 8;

/// Significant digits of where it is cut.
const DIGITS: usize = 9;

/// Why something is not proven of all values between two.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Unproven {
    /// Nothing is proven.
    Refused(String),
    /// All is proven but these parts, of which there is one at least, and what lies beyond `untried_from`.
    Undecided { parts: Vec<[Rational; 2]>, untried_from: Option<Rational> },
}

impl Unproven {
    pub(super) fn because(why: impl ToString) -> Unproven {
        Unproven::Refused(why.to_string())
    }

    fn undecided(all: Vec<[Rational; 2]>, untried_from: Option<Rational>) -> Unproven {
        let mut parts: Vec<[Rational; 2]> = Vec::new();
        for [from, to] in all {
            match parts.last_mut().filter(|last| last[1] == from) {
                Some(last) => last[1] = to,
                None => parts.push([from, to]),
            }
        }
        Unproven::Undecided { parts, untried_from }
    }

    /// The parts that are not decided.
    pub fn parts(&self) -> &[[Rational; 2]] {
        match self {
            Unproven::Refused(_) => &[],
            Unproven::Undecided { parts, .. } => parts,
        }
    }
}

/// How often two scenes are followed again, each with the cuts of the other.
const ROUNDS: usize = 4;

/// What is compared with a scene.
enum Compared<'a> {
    Scene(&'a ScaledScene),
    FirstArrivals(Arrivals),
    /// So many modes.
    Modes(usize),
}

/// The first arrivals of a quantity; later ones are left out.
pub(super) struct Arrivals {
    count: usize,
    /// In the scale of the scene: each wave that is seen arrives once in a period, the first time after its delay.
    period: Fraction,
    /// The delay of each, and what it is multiplied with.
    waves: Vec<(Fraction, Fraction)>,
}

/// What is claimed of a simpler answer.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Claimed {
    Enough,
    NotEnough,
}

/// A claim that a simpler answer is enough, or that it is not.
struct Claim<'a> {
    other: Compared<'a>,
    claimed: Claimed,
}

/// What claims are about.
struct Proof<'a> {
    scene: &'a ScaledScene,
    symbol: Symbol,
    quantity: String,
    window: [Fraction; 2],
    tolerance: &'a Rational,
}

/// What claims about a part of the values share.
#[derive(Default)]
struct Known {
    /// The scene, each time on another grid.
    exact: Vec<Exact>,
    /// The most modes that were asked for.
    modes: Option<SumOfModes>,
}

impl Known {
    /// The first modes; those of more, where they are known.
    fn modes(&mut self, own: &Over<'_>, count: usize) -> Result<SumOfModes, NotOverSymbol> {
        if let Some(first) = self.modes.as_ref().and_then(|modes| modes.first(count)) {
            return Ok(first);
        }
        let modes = own.modes(count)?;
        self.modes = Some(modes.clone());
        Ok(modes)
    }
}

/// What is known of a claim about a part of the values.
enum Decided {
    Proven,
    /// Not yet: it is asked of two parts of it.
    Cut,
    Refused(NotOverSymbol),
    Not,
}

#[doc(hidden)]
impl Problem {
    /// Proves, for all values of the symbol from one to another, that simpler answers are enough, or that they are not;
    /// of each it is told why it is not proven. `tell` hears of the values from which on it is tried.
    pub fn prove_between(
        &self,
        asked: &MapRequest<'_>,
        [from, to]: [&Rational; 2],
        claims: &[(&Simpler, Claimed)],
        tell: &dyn Fn(&Rational),
    ) -> Vec<Result<(), Unproven>> {
        let changed = claims.iter().map(|(simpler, _)| match simpler {
            Simpler::Scene(changes) => self.changed(changes).map(Some).map_err(told),
            _ => Ok(None),
        });
        let changed: Vec<Result<Option<Problem>, Unproven>> = changed.collect();
        let compared = claims.iter().zip(&changed).map(|((simpler, claimed), changed)| {
            let other =
                self.compared(asked, simpler, changed.as_ref().map_err(Unproven::clone)?)?;
            Ok(Claim { other, claimed: *claimed })
        });
        let claims: Vec<Result<Claim<'_>, Unproven>> = compared.collect();
        match self.proof(asked, [from, to]) {
            Ok(proof) => proof.decide(&claims, [from, to], tell),
            Err(unproven) => {
                let why = |claim: Result<_, Unproven>| Err(claim.err().unwrap_or(unproven.clone()));
                claims.into_iter().map(why).collect()
            }
        }
    }

    /// A simpler answer, which may be a changed scene.
    fn compared<'a>(
        &self,
        asked: &MapRequest<'_>,
        simpler: &Simpler,
        changed: &'a Option<Problem>,
    ) -> Result<Compared<'a>, Unproven> {
        match (simpler, changed) {
            (Simpler::Arrivals(count), _) => {
                let arrivals = self.arrivals(asked.quantity, *count).map_err(told)?;
                let why = "echoes cannot be counted: it is an energy, contacts open, or the travel times have no common period";
                Ok(Compared::FirstArrivals(arrivals.ok_or_else(|| Unproven::because(why))?))
            }
            (Simpler::Modes(count), _) => Ok(Compared::Modes(*count)),
            (Simpler::Scene(_), changed) => {
                let changed = changed.as_ref().expect("a changed scene");
                Ok(Compared::Scene(changed.scaled().map_err(told)?))
            }
        }
    }

    /// What claims of all values from one to another are about.
    fn proof<'a>(
        &'a self,
        asked: &'a MapRequest<'_>,
        ends: [&Rational; 2],
    ) -> Result<Proof<'a>, Unproven> {
        let symbol = Symbol::new(&language::normalise_name(&asked.range.symbol));
        let window = self.window_of_symbols(asked, ends);
        Ok(Proof {
            scene: self.scaled().map_err(told)?,
            symbol: symbol.ok_or_else(|| Unproven::because("there is no such symbol"))?,
            quantity: language::normalise_name(asked.quantity),
            window: window.ok_or_else(|| {
                Unproven::because(
                    "the default window changes with the symbol in a way that has no formula",
                )
            })?,
            tolerance: &asked.tolerance,
        })
    }

    /// The window as a function of the symbol: the one that is asked for, or of the usual length where all times are in one
    /// proportion to each other.
    fn window_of_symbols(
        &self,
        asked: &MapRequest<'_>,
        values: [&Rational; 2],
    ) -> Option<[Fraction; 2]> {
        let at = values.map(|value| {
            let problem = self.substituted(&asked.range.symbol, value).ok()?;
            (asked.window)(&problem).ok()
        });
        let [Some(first), Some(last)] = at else { return None };
        if !asked.has_usual_end || self.has_one_usual_length() {
            return (first == last).then(|| first.map(|end| Fraction::constant(&end)));
        }
        let from = Fraction::constant(&first[0]);
        let to = &from + &self.usual_length_of_symbols()?;
        let symbol = Symbol::new(&language::normalise_name(&asked.range.symbol))?;
        let is_end = |value: &Rational, window: &[Rational; 2]| {
            let end = to.substitute(&symbol, &Fraction::constant(value)).ok();
            end.and_then(|end| end.as_constant()).as_ref() == Some(&window[1])
        };
        let is_it = is_end(values[0], &first) && is_end(values[1], &last);
        is_it.then(|| [from, to.clone()])
    }

    /// The first arrivals of what is linear in the waves; none where these have more than one period.
    pub(super) fn arrivals(
        &self,
        quantity: &str,
        count: usize,
    ) -> Result<Option<Arrivals>, ProblemError> {
        let (network, wanted) = (self.network()?, self.wanted(quantity)?);
        let seen = wanted.observation().filter(|_| !network.scene().contacts_open);
        let Some(seen) = seen else { return Ok(None) };
        let [period] = network.lattice().periods() else { return Ok(None) };
        let wave =
            |wave: &ObservedWave| Some((wave.delay.clone(), wave.coefficient.as_fraction()?));
        let waves = seen.waves.iter().map(wave).collect::<Option<Vec<_>>>();
        Ok(waves.map(|waves| Arrivals { count, period: period.clone(), waves }))
    }
}

impl Arrivals {
    /// Of the first `count` steps those at whose start something arrives, ascending; none where it may be others for some
    /// value of the symbol, since a wave is not seen at all.
    fn steps(
        &self,
        (over, step): (&Over<'_>, &Root),
        count: usize,
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
                steps.extend(usize::try_from(at).ok().filter(|at| *at > 0));
                at += period;
            }
        }
        Ok(Some(steps.into_iter().collect()))
    }

    /// How far the scene is from the function of its first arrivals; none where these may be others for some value of the
    /// symbol.
    fn left_out(
        &self,
        own: &Over<'_>,
        exact: &mut Exact,
    ) -> Result<Option<Envelope>, NotOverSymbol> {
        let grid = &exact.followed.grid;
        let steps = self.steps((own, &grid.step), exact.observed.len())?;
        let Some(steps) = steps else { return Ok(None) };
        // From a cell on both differ.
        let (first, off) = match steps[self.count.saturating_sub(1).min(steps.len())..] {
            [last, next, ..] => {
                let other = exact.followed.observed_after(last)?;
                (next, differences(&exact.observed[next..], &other[next..]))
            }
            _ => (0, Vec::new()),
        };
        Ok(Some(Envelope::of((first, &off), &exact.followed.grid, &exact.window)))
    }
}

impl Proof<'_> {
    /// Proves claims of all values between two, each in parts where it must be.
    fn decide(
        &self,
        claims: &[Result<Claim<'_>, Unproven>],
        [from, to]: [&Rational; 2],
        tell: &dyn Fn(&Rational),
    ) -> Vec<Result<(), Unproven>> {
        // The parts that are not decided, unless it is known not to be proven.
        let mut open: Vec<Result<Vec<[Rational; 2]>, Unproven>> = claims
            .iter()
            .map(|claim| claim.as_ref().map(|_| Vec::new()).map_err(Unproven::clone))
            .collect();
        let (last, mut looked) = (to, vec![0; claims.len()]);
        // A stack: the leftmost part is on top. The last claim comes first, since what it finds serves those before.
        let mut left =
            vec![([from.clone(), to.clone()], (0..claims.len()).rev().collect::<Vec<usize>>())];
        while let Some(([from, to], asked)) = left.pop() {
            tell(&from);
            let middle = middle(&from, &to, FINEST, DIGITS);
            let (mut known, mut again) = (Known::default(), Vec::new());
            for place in asked {
                let (Ok(claim), Ok(undecided)) = (&claims[place], &mut open[place]) else {
                    continue;
                };
                looked[place] += 1;
                let may_go_on = looked[place] < MAX_PARTS_OVER_SYMBOL;
                let may_cut = may_go_on && middle.is_some();
                match self.decide_part(claim, [&from, &to], may_cut, &mut known) {
                    Decided::Proven => {}
                    Decided::Cut => again.push(place),
                    Decided::Refused(why) => open[place] = Err(Unproven::because(why)),
                    Decided::Not => {
                        undecided.push([from.clone(), to.clone()]);
                        if to < *last && !(may_go_on && are_few(undecided)) {
                            let undecided = std::mem::take(undecided);
                            open[place] = Err(Unproven::undecided(undecided, Some(to.clone())));
                        }
                    }
                }
            }
            if let Some(middle) = middle.filter(|_| !again.is_empty()) {
                left.push(([middle.clone(), to], again.clone()));
                left.push(([from, middle], again));
            }
        }
        let outcome = |open: Result<Vec<[Rational; 2]>, Unproven>| {
            let undecided = open?;
            match undecided.is_empty() {
                true => Ok(()),
                false => Err(Unproven::undecided(undecided, None)),
            }
        };
        open.into_iter().map(outcome).collect()
    }

    /// A claim about all values between two, which may be cut into parts.
    fn decide_part(
        &self,
        claim: &Claim<'_>,
        part: [&Rational; 2],
        may_cut: bool,
        known: &mut Known,
    ) -> Decided {
        match self.is_proven(claim, part, known) {
            Ok(true) => Decided::Proven,
            Err(error) if !error.may_pass_if_narrower() => Decided::Refused(error),
            _ if may_cut => Decided::Cut,
            Err(error @ NotOverSymbol::TooManySteps) => Decided::Refused(error),
            _ => Decided::Not,
        }
    }

    /// Whether a claim is proven of all values between two at once.
    fn is_proven(
        &self,
        claim: &Claim<'_>,
        between: [&Rational; 2],
        known: &mut Known,
    ) -> Result<bool, NotOverSymbol> {
        let over = |scene| Over::new(scene, &self.quantity, (&self.symbol, between));
        let own = over(self.scene)?;
        let (place, off) = match &claim.other {
            Compared::Scene(other) => {
                let (place, followed) = self.both([&own, &over(other)?], known)?;
                let exact = &known.exact[place];
                let off = differences(&exact.observed, &followed.observed());
                (place, Envelope::of((0, &off), &exact.followed.grid, &exact.window))
            }
            Compared::FirstArrivals(arrivals) => {
                let place = self.alone(&own, known)?;
                match arrivals.left_out(&own, &mut known.exact[place])? {
                    Some(off) => (place, off),
                    None => return Ok(false),
                }
            }
            Compared::Modes(count) => {
                let modes = known.modes(&own, *count)?;
                let place = self.alone(&own, known)?;
                (place, off_by_modes(&modes, &own, &known.exact[place], claim.claimed)?)
            }
        };
        let exact = &known.exact[place];
        let Some(reached) = exact.reached() else { return Ok(false) };
        match claim.claimed {
            Claimed::Enough => Ok(off.is_within(&scaled(reached, self.tolerance))),
            Claimed::NotEnough => {
                let (Some(off), Some(most)) = (off.reached(), exact.most()) else {
                    return Ok(false);
                };
                Ok(off.iter().zip(&scaled(most, self.tolerance)).all(|(off, most)| off > most))
            }
        }
    }

    /// The place among those that are known of the scene alone.
    fn alone(&self, own: &Over<'_>, known: &mut Known) -> Result<usize, NotOverSymbol> {
        self.place(own, (Over::grid(&[own])?, &[]), known)
    }

    /// The scene and another one, followed on one grid, which has the cuts of both.
    fn both(
        &self,
        [own, other]: [&Over<'_>; 2],
        known: &mut Known,
    ) -> Result<(usize, Followed), NotOverSymbol> {
        let mut grid = Over::grid(&[own, other])?;
        let mut closings = [Vec::new(), Vec::new()];
        for _ in 0..ROUNDS {
            let place = self.place(own, (grid, &closings[0]), known)?;
            let exact = &known.exact[place];
            let count = exact.window.count();
            let followed = other.follow(&exact.followed.grid, &closings[1], count)?;
            if followed.grid == exact.followed.grid {
                return Ok((place, followed));
            }
            closings = [exact.followed.closings.clone(), followed.closings];
            grid = followed.grid;
        }
        Err(NotOverSymbol::Undecided)
    }

    /// The place among those that are known of the scene followed on a grid.
    fn place(
        &self,
        own: &Over<'_>,
        (grid, closings): (Grid, &[Change]),
        known: &mut Known,
    ) -> Result<usize, NotOverSymbol> {
        if let Some(place) = known.exact.iter().position(|exact| exact.asked == grid) {
            return Ok(place);
        }
        known.exact.push(Exact::of(own, &self.window, (grid, closings))?);
        Ok(known.exact.len() - 1)
    }
}

/// How far the scene is from a sum of modes: on all cells, or where they are not enough on the one that tells.
fn off_by_modes(
    modes: &SumOfModes,
    own: &Over<'_>,
    exact: &Exact,
    claimed: Claimed,
) -> Result<Envelope, NotOverSymbol> {
    let length = own.length(&exact.followed.grid.step)?;
    let (grid, parts) = modes.split(&exact.followed.grid, &length)?;
    let part = |cell: usize| exact.observed[cell / parts].equal_part(cell % parts, parts);
    let (first, off) = match claimed {
        Claimed::Enough => {
            let count = exact.observed.len() * parts;
            let sum = modes.on_cells(&grid, count, &length)?;
            let off = sum.iter().enumerate().map(|(cell, sum)| part(cell).less(sum));
            (0, off.collect())
        }
        Claimed::NotEnough => {
            let observed = (&exact.observed[..], parts);
            match modes.farthest(observed, (&grid, &length), &exact.window) {
                Some(cell) => (cell, vec![part(cell).less(&modes.on_cell(&grid, cell, &length)?)]),
                None => (0, Vec::new()),
            }
        }
    };
    Ok(Envelope::of((first, &off), &grid, &exact.window))
}

fn differences(own: &[OnCell], other: &[OnCell]) -> Vec<OnCell> {
    own.iter().zip(other).map(|(one, other)| one.less(other)).collect()
}

/// Whether undecided parts are few intervals of few parts.
fn are_few(parts: &[[Rational; 2]]) -> bool {
    let mut intervals = parts.chunk_by(|one, other| one[1] == other[0]);
    intervals.clone().count() < MOST_UNDECIDED
        && intervals.all(|interval| interval.len() < MOST_UNDECIDED)
}

pub(super) fn told(error: ProblemError) -> Unproven {
    Unproven::because(super::advise::first_line(&error))
}
