//! Which simpler answer is enough where, over a symbol of the scene.
//!
//! At some values of the symbol the largest difference of each simpler answer is proven. Where the first that is enough
//! for a tolerance differs between two neighbours, what lies between them is halved until both are nearly the same.

use super::{Other, Problem, ProblemError, Simpler, Size, number};
use crate::language::syntax::Declared;
use crate::language::{self, Beyond, Change};
use crate::planner::Purpose;
use crate::signal::Signal;
use num_traits::{Signed as _, ToPrimitive as _};
use std::str::FromStr;
use wavestep_polynomial::Rational;

/// Neighbours of a border differ by one in so many.
const FINE: i64 = 1000;

/// The digits and bits of a size that is to be told from a tolerance.
const TOLD: (usize, u64) = (9, 1 << 12);

/// The part of the largest value that is not told from nothing.
const NOTHING: i64 = 1_000_000_000_000;

/// The numbers of arrivals, and of modes, that are tried where nothing else is said.
const COUNTS: [usize; 5] = [1, 2, 4, 8, 16];

/// A symbol, from one positive value to another.
#[derive(Clone, PartialEq, Debug)]
pub struct Span {
    /// Its name.
    pub symbol: String,
    pub from: Rational,
    pub to: Rational,
}

impl FromStr for Span {
    type Err = ProblemError;

    fn from_str(text: &str) -> Result<Span, ProblemError> {
        let unread = || ProblemError::Span(text.to_owned());
        let (symbol, ends) = text.split_once('=').ok_or_else(unread)?;
        let (from, to) = ends.split_once("..").ok_or_else(unread)?;
        let (from, to) = (number("--for", from.trim())?, number("--for", to.trim())?);
        let symbol = symbol.trim().to_owned();
        let is_span = from.is_positive() && from < to && !symbol.is_empty();
        if is_span { Ok(Span { symbol, from, to }) } else { Err(unread()) }
    }
}

impl Span {
    /// So many values from one end to the other with three digits, each about the same multiple of the one before.
    pub fn values(&self, points: usize) -> Vec<Rational> {
        let [from, to] = [&self.from, &self.to].map(|end| end.to_f64().unwrap_or(f64::NAN));
        let between = |i: usize| {
            let share = i as f64 / (points - 1) as f64;
            short(from * (to / from).powf(share), 3)
        };
        let mut values = vec![self.from.clone()];
        for value in (1..points.max(2) - 1).filter_map(between) {
            if value > values[values.len() - 1] && value < self.to {
                values.push(value);
            }
        }
        values.push(self.to.clone());
        values
    }
}

/// A number with so many digits.
fn short(value: f64, digits: usize) -> Option<Rational> {
    number("--for", &format!("{value:.*e}", digits - 1)).ok()
}

/// A value between two others, with few digits; none where they are nearly the same.
fn between(one: &Rational, other: &Rational) -> Option<Rational> {
    if (other - one) * Rational::from_integer(FINE.into()) <= *one {
        return None;
    }
    let [low, high] = [one, other].map(|end| end.to_f64().unwrap_or(f64::NAN));
    short((low * high).sqrt(), 5).filter(|middle| one < middle && middle < other)
}

/// Where what is found at a value changes: all that was found at some values, and between neighbours that differ at more
/// of them, until those that differ are nearly the same; told as the first and the last value of each run.
///
/// # Errors
/// Those of `find`.
pub fn runs<S: PartialEq, E>(
    values: impl IntoIterator<Item = Rational>,
    mut find: impl FnMut(&Rational) -> Result<S, E>,
) -> Result<Vec<([Rational; 2], S)>, E> {
    let mut found: Vec<(Rational, S)> = Vec::new();
    for value in values {
        let state = find(&value)?;
        found.push((value, state));
    }
    let mut place = 0;
    while place + 1 < found.len() {
        let [(one, first), (other, then)] = [&found[place], &found[place + 1]];
        let middle = if first == then { None } else { between(one, other) };
        let Some(middle) = middle else {
            place += 1;
            continue;
        };
        let state = find(&middle)?;
        found.insert(place + 1, (middle, state));
    }
    let mut runs: Vec<([Rational; 2], S)> = Vec::new();
    for (value, state) in found {
        match runs.last_mut().filter(|(_, last)| *last == state) {
            Some((run, _)) => run[1] = value,
            None => runs.push(([value.clone(), value], state)),
        }
    }
    Ok(runs)
}

/// What is asked.
pub struct ToMap<'a> {
    pub span: &'a Span,
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
}

/// How far off simpler answers are at one value of the symbol, over the largest value; none that does not suit.
#[derive(Clone, PartialEq, Debug)]
pub struct Column {
    pub value: Rational,
    /// For each simpler answer the bounds of its largest difference.
    pub off: Vec<Option<[Rational; 2]>>,
}

/// Values of the symbol at which the same answer is the first that is proven to be enough.
#[derive(Clone, PartialEq, Debug)]
pub struct Part {
    /// The first and the last value at which that was proven.
    pub between: [Rational; 2],
    /// Its place among the simpler answers; none where only the exact one is enough.
    pub first: Option<usize>,
}

/// Which simpler answer is enough where.
#[derive(Clone, PartialEq, Debug)]
pub struct EnoughMap {
    /// From cheap to dear.
    pub simpler: Vec<Simpler>,
    /// In the order of the values.
    pub columns: Vec<Column>,
    /// For the tolerance, in the order of the values.
    pub parts: Vec<Part>,
}

/// A scene at one value of the symbol, with what its answers are compared with.
struct At<'p> {
    problem: &'p Problem,
    quantity: &'p str,
    window: [Rational; 2],
    largest: Size,
}

impl<'p> At<'p> {
    fn new(problem: &'p Problem, asked: &ToMap<'p>) -> Result<At<'p>, ProblemError> {
        let window = (asked.window)(problem)?;
        let wanted = problem.wanted(asked.quantity)?;
        let signal = problem.signal_on(&wanted, window.each_ref(), Purpose::Search)?;
        let largest = Size::of(&*signal, TOLD, &Rational::default())?;
        drop(signal);
        Ok(At { problem, quantity: asked.quantity, window, largest })
    }

    /// The largest difference of an answer, over the largest value; to more digits where it is to be told from a
    /// tolerance. None where it does not suit.
    fn off(
        &self,
        simpler: &Simpler,
        tolerance: Option<&Rational>,
    ) -> Result<Option<[Rational; 2]>, ProblemError> {
        let Ok(other) = self.problem.simpler(simpler) else { return Ok(None) };
        let Ok(difference) = self.difference(&other) else { return Ok(None) };
        let negligible = &self.largest.bounds[0] / Rational::from_integer(NOTHING.into());
        let near = Size::near(&*difference, &negligible)?.over(&self.largest);
        match (near, tolerance) {
            (Some([least, most]), Some(tolerance)) if least <= *tolerance && *tolerance < most => {
                Ok(Size::of(&*difference, TOLD, &negligible)?.over(&self.largest))
            }
            (near, _) => Ok(near),
        }
    }

    fn difference<'a>(&'a self, other: &'a Other) -> Result<Box<dyn Signal + 'a>, ProblemError> {
        let wanted = self.problem.wanted(self.quantity)?;
        self.problem.difference_on(other, &wanted, self.window.each_ref(), Purpose::Search)
    }

    /// The first answer that is proven to be enough.
    fn first_enough(
        &self,
        simpler: &[Simpler],
        tolerance: &Rational,
    ) -> Result<Option<usize>, ProblemError> {
        for (place, own) in simpler.iter().enumerate() {
            let off = self.off(own, Some(tolerance))?;
            if off.is_some_and(|[_, most]| most <= *tolerance) {
                return Ok(Some(place));
            }
        }
        Ok(None)
    }
}

#[doc(hidden)]
impl Problem {
    /// The same with one more value.
    fn at(&self, symbol: &str, value: &Rational) -> Result<Problem, ProblemError> {
        let mut values = self.values.clone();
        values.insert(symbol.to_owned(), value.clone());
        Problem::of(self.source.clone(), values)
    }

    /// Which simpler answer is enough where; `tell` hears of each value of the symbol.
    ///
    /// # Errors
    /// [`ProblemError::NoSymbol`] where the scene has no such symbol, else as [`Problem::advise`].
    pub fn map_enough(
        &self,
        asked: &ToMap<'_>,
        tell: &dyn Fn(&Rational),
    ) -> Result<EnoughMap, ProblemError> {
        let ToMap { span, points, tolerance, .. } = asked;
        if !self.symbols().contains(&&*span.symbol) {
            let symbols = self.symbols().into_iter().map(str::to_owned).collect();
            return Err(ProblemError::NoSymbol { name: span.symbol.clone(), symbols });
        }
        let simpler = match asked.simpler.is_empty() {
            true => self.usual_simpler(),
            false => asked.simpler.clone(),
        };
        let at = |value: &Rational| {
            tell(value);
            self.at(&span.symbol, value)
        };
        let values = span.values(*points);
        let mut columns = Vec::new();
        let runs = runs(values.iter().cloned(), |value| {
            let problem = at(value)?;
            let at = At::new(&problem, asked)?;
            if values.contains(value) {
                let off: Result<Vec<_>, _> = simpler.iter().map(|own| at.off(own, None)).collect();
                columns.push(Column { value: value.clone(), off: off? });
            }
            at.first_enough(&simpler, tolerance)
        })?;
        let parts = runs.into_iter().map(|(between, first)| Part { between, first }).collect();
        Ok(EnoughMap { simpler, columns, parts })
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
