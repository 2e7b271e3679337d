//! Which simpler answer is enough where, over a symbol of the scene.
//!
//! At some values of the symbol the largest difference of each simpler answer is proven. Where the first that is enough
//! for a tolerance differs between two neighbours, what lies between them is halved until both are nearly the same.

use super::advise::first_line;
use super::between::{Claimed, Unproven};
use super::comparison::Comparison;
use super::{Problem, ProblemError, Simpler, number};
use crate::language::syntax::Declared;
use crate::language::{self, Beyond, Change, ChangeError, parse_number};
use crate::model::ModelError;
use crate::planner::Purpose;
use num_traits::{One as _, Signed as _, ToPrimitive as _};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::str::FromStr;
use wavestep_polynomial::Rational;

/// Neighbours at a border differ by at most one part in this many.
const FINE: i64 = 1000;

/// Significant digits of borders.
const BORDER_DIGITS: usize = 5;

/// So many values are looked at besides, where a proof leaves something open.
const MOST_MISSED: usize = 24;

/// Significant digits of the values of a symbol that are looked at first.
const MAP_DIGITS: usize = 3;

/// The most modes of one answer: with more, the cells of a proof are too many.
const MOST_MODES: usize = 1000;

/// The numbers of arrivals, and of modes, that are tried where nothing else is said.
const COUNTS: [usize; 5] = [1, 2, 4, 8, 16];

/// A symbol, from one positive value to another.
#[derive(Clone, PartialEq, Debug)]
pub struct SymbolRange {
    /// Its name.
    pub symbol: String,
    pub from: Rational,
    pub to: Rational,
}

impl FromStr for SymbolRange {
    type Err = ProblemError;

    fn from_str(text: &str) -> Result<SymbolRange, ProblemError> {
        let unread = || ProblemError::SymbolRange(text.to_owned());
        let (symbol, ends) = text.split_once('=').ok_or_else(unread)?;
        let (from, to) = ends.split_once("..").ok_or_else(unread)?;
        let (from, to) = (number("the range", from.trim())?, number("the range", to.trim())?);
        let symbol = symbol.trim().to_owned();
        let is_range = from.is_positive() && from < to && !symbol.is_empty();
        if is_range { Ok(SymbolRange { symbol, from, to }) } else { Err(unread()) }
    }
}

/// So many values from one to another, both positive, with so many digits, each about the same multiple of the one before.
pub fn geometrically_spaced(
    from: &Rational,
    to: &Rational,
    points: usize,
    digits: usize,
) -> Vec<Rational> {
    let [first, last] = [from, to].map(|end| end.to_f64().unwrap_or(f64::NAN));
    let between = |i: usize| {
        let share = i as f64 / (points - 1) as f64;
        short(first * (last / first).powf(share), digits)
    };
    let mut values = vec![from.clone()];
    for value in (1..points.max(2) - 1).filter_map(between) {
        if value > values[values.len() - 1] && value < *to {
            values.push(value);
        }
    }
    values.push(to.clone());
    values
}

/// A number with so many digits.
fn short(value: f64, digits: usize) -> Option<Rational> {
    parse_number(&format!("{value:.*e}", digits - 1)).ok()
}

/// A value between two others, with `digits` significant digits; none where they differ by less than one part in `fine`.
pub(super) fn middle(from: &Rational, to: &Rational, fine: i64, digits: usize) -> Option<Rational> {
    if (to - from) * Rational::from_integer(fine.into()) <= *from {
        return None;
    }
    let [low, high] = [from, to].map(|end| end.to_f64().unwrap_or(f64::NAN));
    short((low * high).sqrt(), digits).filter(|middle| from < middle && middle < to)
}

/// Values with few digits near both ends of what is undecided, within a run.
fn beside([low, high]: &[Rational; 2], run: &[Rational; 2]) -> impl Iterator<Item = Rational> {
    let apart = Rational::new(1.into(), (4 * FINE).into());
    let near = [low - low * &apart, high + high * apart].into_iter();
    let near = near.filter_map(|value| short(value.to_f64()?, BORDER_DIGITS));
    near.filter(|value| run[0] < *value && *value < run[1])
}

/// Values that were looked at one after the other, and are in one state.
#[derive(Clone, PartialEq, Debug)]
pub struct Run<S> {
    /// The first and the last of them.
    pub between: [Rational; 2],
    pub state: S,
}

/// Runs of equal states, each by its first and its last value: of the states at some values, and where neighbours differ
/// at values between them, until those that differ are nearly the same.
///
/// # Errors
/// Those of `find`.
pub fn runs<S: PartialEq, E>(
    values: impl IntoIterator<Item = Rational>,
    mut find: impl FnMut(&Rational) -> Result<S, E>,
) -> Result<Vec<Run<S>>, E> {
    let mut found: Vec<(Rational, S)> = Vec::new();
    for value in values {
        let state = find(&value)?;
        found.push((value, state));
    }
    let mut place = 0;
    while place + 1 < found.len() {
        let [(one, first), (other, then)] = [&found[place], &found[place + 1]];
        let middle = if first == then { None } else { middle(one, other, FINE, BORDER_DIGITS) };
        let Some(middle) = middle else {
            place += 1;
            continue;
        };
        let state = find(&middle)?;
        found.insert(place + 1, (middle, state));
    }
    let mut runs: Vec<Run<S>> = Vec::new();
    for (value, state) in found {
        match runs.last_mut().filter(|last| last.state == state) {
            Some(last) => last.between[1] = value,
            None => runs.push(Run { between: [value.clone(), value], state }),
        }
    }
    Ok(runs)
}

/// The first answer that is enough.
fn first_enough(off: &[Option<[Rational; 2]>], tolerance: &Rational) -> Option<usize> {
    off.iter().position(|own| own.as_ref().is_some_and(|[_, most]| most <= tolerance))
}

/// What is asked.
pub struct MapRequest<'a> {
    pub range: &'a SymbolRange,
    /// At how many values distances are proven.
    pub points: usize,
    /// What is observed.
    pub quantity: &'a str,
    /// From cheap to dear; the usual ones where there are none.
    pub simpler: Vec<Simpler>,
    /// How far off an answer may be, over the largest value.
    pub tolerance: Rational,
    /// The window of a scene.
    pub window: &'a dyn Fn(&Problem) -> Result<[Rational; 2], ProblemError>,
    /// Whether it ends at its usual length, because no end was given.
    pub has_usual_end: bool,
}

/// How far off simpler answers are at one value of the symbol, over the largest value.
#[derive(Clone, PartialEq, Debug)]
pub struct Column {
    pub value: Rational,
    /// For each simpler answer the bounds of its largest difference; none where it does not suit, or is not told.
    pub off: Vec<Option<[Rational; 2]>>,
}

/// Which simpler answer is enough where.
#[derive(Clone, PartialEq, Debug)]
pub struct EnoughMap {
    /// From cheap to dear.
    pub simpler: Vec<Simpler>,
    /// In the order of the values.
    pub columns: Vec<Column>,
    /// For the tolerance, in the order of the values.
    pub runs: Vec<Run<Option<usize>>>,
    /// Of each run the answers of which it is not proven, for all values from its first to its last, that they are enough, or
    /// not where another one is the first; without those that suit nowhere.
    pub open: Vec<Vec<(usize, Unproven)>>,
    /// Those that suit at none of the values, each with what is told of the first.
    pub unsuited: Vec<(usize, String)>,
}

impl EnoughMap {
    /// The answers that are the first that is enough for some tolerance below the whole, at one value at least, and those of
    /// which a run says something.
    pub fn useful(&self) -> Vec<usize> {
        let most = |own: &Option<[Rational; 2]>| own.as_ref().map(|[_, most]| most.clone());
        let is_first = |place: usize, off: &[Option<[Rational; 2]>]| {
            let cheaper = off[..place].iter().filter_map(most);
            let least = cheaper.chain([Rational::one()]).min();
            most(&off[place]) < least && off[place].is_some()
        };
        let is_useful = |place: &usize| {
            self.columns.iter().any(|column| is_first(*place, &column.off))
                || self.runs.iter().any(|run| run.state == Some(*place))
                || self.open.iter().flatten().any(|(own, _)| own == place)
        };
        (0..self.simpler.len()).filter(is_useful).collect()
    }
}

#[doc(hidden)]
impl Problem {
    /// Which simpler answer is enough where; `tell` hears of each value of the symbol.
    ///
    /// # Errors
    /// [`ProblemError::NoSymbol`] where the scene has no such symbol, else as [`Problem::advise`].
    pub fn map_enough(
        &self,
        asked: &MapRequest<'_>,
        tell: &dyn Fn(&Rational),
    ) -> Result<EnoughMap, ProblemError> {
        let MapRequest { range, points, tolerance, .. } = asked;
        if !self.symbols().contains(&&*range.symbol) {
            let symbols = self.symbols().into_iter().map(str::to_owned).collect();
            return Err(ProblemError::NoSymbol { name: range.symbol.clone(), symbols });
        }
        let simpler = match asked.simpler.is_empty() {
            true => self.usual_simpler(),
            false => self.known_simpler(&asked.simpler)?,
        };
        let values = geometrically_spaced(&range.from, &range.to, *points, MAP_DIGITS);
        let mut known = BTreeMap::new();
        let is_zero = Cell::new(true);
        let mut off_at = |value: &Rational| {
            if !known.contains_key(value) {
                tell(value);
                let off = match self.substituted(&range.symbol, value) {
                    Err(error) if error.is_at_rest() => None,
                    own => own?.shares(asked, &simpler)?,
                };
                is_zero.set(is_zero.get() && off.is_none());
                let off = off.unwrap_or_else(|| vec![None; simpler.len()]);
                known.insert(value.clone(), off);
            }
            Ok::<_, ProblemError>(known[value].clone())
        };
        let (mut looked, mut known_open) = (values.clone(), BTreeMap::new());
        let (runs, open) = loop {
            let runs = runs(looked.iter().cloned(), |value| {
                Ok::<_, ProblemError>(first_enough(&off_at(value)?, tolerance))
            })?;
            let (mut open, mut missed) = (Vec::new(), Vec::new());
            for Run { between, state } in &runs {
                let key = (between.clone(), *state);
                if !known_open.contains_key(&key) {
                    let ends = [off_at(&between[0])?, off_at(&between[1])?];
                    known_open.insert(key.clone(), self.open((asked, tell), &simpler, &key, &ends));
                }
                let own = &known_open[&key];
                // Where it is not decided there may be a border that no value has shown.
                let undecided = own.iter().flat_map(|(_, unproven)| unproven.parts());
                for value in undecided.flat_map(|undecided| beside(undecided, between)) {
                    if first_enough(&off_at(&value)?, tolerance) != *state {
                        missed.push(value);
                        break;
                    }
                }
                open.push(own.clone());
            }
            if missed.is_empty() || looked.len() > values.len() + MOST_MISSED {
                break (runs, open);
            }
            looked.extend(missed);
            looked.sort();
        };
        if is_zero.get() {
            return Err(ProblemError::AllZero(asked.quantity.to_owned()));
        }
        let columns = values.into_iter().map(|value| Ok(Column { off: off_at(&value)?, value }));
        let columns = columns.collect::<Result<Vec<Column>, ProblemError>>()?;
        let suits = |place: usize| columns.iter().any(|column| column.off[place].is_some());
        let unsuited = (0..simpler.len()).filter(|place| !suits(*place));
        let unsuited = unsuited.filter_map(|place| {
            let told = |column: &Column| {
                let own = self.substituted(&range.symbol, &column.value).ok()?;
                own.share_of(asked, &simpler[place]).err()
            };
            Some((place, first_line(&columns.iter().find_map(told)?)))
        });
        let unsuited = unsuited.collect();
        Ok(EnoughMap { simpler, columns, runs, open, unsuited })
    }

    /// What is not proven of all values between two, where this answer is the first that is known to be enough at both; how far
    /// all are off there.
    fn open(
        &self,
        (asked, tell): (&MapRequest<'_>, &dyn Fn(&Rational)),
        simpler: &[Simpler],
        ([from, to], first): &([Rational; 2], Option<usize>),
        ends: &[Vec<Option<[Rational; 2]>>; 2],
    ) -> Vec<(usize, Unproven)> {
        let is_unsure = |off: &[Rational; 2]| off[0] <= asked.tolerance && asked.tolerance < off[1];
        // What is zero at an end may be none in between.
        let is_zero = ends.iter().any(|off| off.iter().all(Option::is_none));
        // An answer may suit between where its distance is known at neither end.
        let may_suit = |place: usize| match &simpler[place] {
            Simpler::Scene(changes) => {
                let is_observed = |other: Problem| {
                    other.wanted(asked.quantity).is_ok_and(|wanted| wanted.place.is_some())
                        && [from, to].into_iter().any(|value| other.moves_at(asked, value))
                };
                self.changed(changes).is_ok_and(is_observed)
            }
            Simpler::Arrivals(count) => {
                self.arrivals(asked.quantity, *count).is_ok_and(|own| own.is_some())
            }
            Simpler::Modes(_) => is_zero,
        };
        let suits = |place: usize| ends.iter().any(|off| off[place].is_some()) || may_suit(place);
        let before = (0..first.unwrap_or(simpler.len())).filter(|place| suits(*place));
        let (unsure, claimed): (Vec<usize>, Vec<usize>) = before
            .chain(*first)
            .partition(|place| ends.iter().any(|off| off[*place].as_ref().is_some_and(is_unsure)));
        let why =
            "at one end of the range the bounds of its error lie on both sides of the tolerance";
        let unsure = unsure.into_iter().map(|place| (place, Unproven::because(why)));
        let claim = |place: &usize| match *first == Some(*place) {
            true => (&simpler[*place], Claimed::Enough),
            false => (&simpler[*place], Claimed::NotEnough),
        };
        let claims: Vec<(&Simpler, Claimed)> = claimed.iter().map(claim).collect();
        let proven = match from == to {
            true => Vec::new(),
            false => self.prove_between(asked, [from, to], &claims, tell),
        };
        let open = claimed.into_iter().zip(proven);
        let open = open.filter_map(|(place, proven)| Some((place, proven.err()?)));
        let mut open: Vec<(usize, Unproven)> = unsure.chain(open).collect();
        open.sort_by_key(|(place, _)| *place);
        open
    }

    /// Whether there is a motion at a value of the symbol: there is none where masses collide.
    fn moves_at(&self, asked: &MapRequest<'_>, value: &Rational) -> bool {
        let signal = || {
            let own = self.substituted(&asked.range.symbol, value)?;
            let (wanted, window) = (own.wanted(asked.quantity)?, (asked.window)(&own)?);
            own.signal_on(&wanted, window.each_ref(), Purpose::Search).map(drop)
        };
        signal().is_ok()
    }

    /// How far simpler answers are off, over the largest value; none where that is zero.
    fn shares(
        &self,
        asked: &MapRequest<'_>,
        simpler: &[Simpler],
    ) -> Result<Option<Vec<Option<[Rational; 2]>>>, ProblemError> {
        let (window, wanted) = ((asked.window)(self)?, self.wanted(asked.quantity)?);
        let comparison = match Comparison::new(self, &wanted, window.each_ref()) {
            Err(ProblemError::AllZero(_)) => return Ok(None),
            comparison => comparison?,
        };
        let share = |simpler: &Simpler| {
            let other = self.simpler(simpler).ok()?;
            comparison.share(&other, &asked.tolerance).ok()
        };
        Ok(Some(simpler.iter().map(share).collect()))
    }

    /// How far one simpler answer is off, over the largest value.
    fn share_of(
        &self,
        asked: &MapRequest<'_>,
        simpler: &Simpler,
    ) -> Result<[Rational; 2], ProblemError> {
        let (window, wanted) = ((asked.window)(self)?, self.wanted(asked.quantity)?);
        let comparison = Comparison::new(self, &wanted, window.each_ref())?;
        comparison.share(&self.simpler(simpler)?, &asked.tolerance)
    }

    /// These answers, if what they name is in the scene and no more modes are asked for than a map can tell.
    fn known_simpler(&self, simpler: &[Simpler]) -> Result<Vec<Simpler>, ProblemError> {
        for own in simpler {
            if let Simpler::Modes(count) = *own
                && count > MOST_MODES
            {
                let (count, limit) = (count as f64, MOST_MODES as f64);
                let (model, what) = ("modes of vibration", "modes");
                return Err(ModelError::TooMuch { model, what, count, limit }.into());
            }
            let Simpler::Scene(changes) = own else { continue };
            if let Err(error @ (ChangeError::NoElement { .. } | ChangeError::NotABar(_))) =
                language::changed(&self.source, changes)
            {
                return Err(error.into());
            }
        }
        Ok(simpler.to_vec())
    }

    /// What is tried where nothing else is said: whole scenes, one change alone, arrivals, modes.
    fn usual_simpler(&self) -> Vec<Simpler> {
        let mut changes = vec![Change::Rigid(None), Change::Spring(None, None)];
        if self.network().is_ok_and(|network| network.scene().contacts_open) {
            changes.push(Change::Closed);
        }
        let names = language::elements(&self.source).unwrap_or_default();
        let bars = names.iter().filter(|(_, kind)| *kind == Declared::Bar).count();
        for (name, kind) in names {
            if kind != Declared::Bar {
                changes.push(Change::Without(name));
                continue;
            }
            changes.push(Change::Endless(name.clone(), Beyond::Right));
            changes.push(Change::Endless(name.clone(), Beyond::Left));
            if bars > 1 {
                changes.push(Change::Rigid(Some(name.clone())));
                changes.push(Change::Spring(Some(name), None));
            }
        }
        let scenes = changes.into_iter().map(|change| Simpler::Scene(vec![change]));
        let arrivals = COUNTS.into_iter().map(Simpler::Arrivals);
        scenes.chain(arrivals).chain(COUNTS.into_iter().map(Simpler::Modes)).collect()
    }
}
