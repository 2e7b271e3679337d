//! Certificates of all roots of a quantity in a window, or of its largest or smallest value there.

use super::reading::Read;
use super::{Quantity, rounded};
use crate::failure::{ACCURACY, Failure};
use crate::progress;
use num_rational::BigRational;
use num_traits::Signed as _;
use serde_json::{Map, Value as Json, json};
use wavestep::ball::Ball;
use wavestep::limits::SEARCH_BITS;
use wavestep::planner::Purpose;
use wavestep::signal::{Extremum, Goal, Limit, Near, Place, Root, Search, Signal, Value};

/// The terms of Taylor polynomials.
const TERMS: usize = 20;

/// The bits of their coefficients, beyond those of the digits asked for.
const SPARE_BITS: u64 = 256;

/// How often a part of the window is halved at most.
const DEPTH: usize = 256;

/// By what share, as a power of two, a bound has to be met more than enough, so that a checker proves it too.
const MARGIN_BITS: i64 = 20;

type Window = [BigRational; 2];

/// What is asked about a window.
#[derive(Clone, Copy)]
pub enum Asked {
    Roots,
    Extremum(Goal),
    /// The largest absolute value.
    Distance,
}

impl Asked {
    /// Of an extremum what it is of: the largest or the smallest value, or without a goal the largest size.
    fn goal(self) -> Option<Option<Goal>> {
        match self {
            Asked::Roots => None,
            Asked::Extremum(goal) => Some(Some(goal)),
            Asked::Distance => Some(None),
        }
    }
}

pub fn certificate(
    of: &Quantity<'_>,
    asked: Asked,
    window: &Window,
    digits: usize,
) -> Result<Map<String, Json>, Failure> {
    let wanted = of.problem.wanted(of.name)?;
    let ends = window.each_ref();
    let signal = match of.minus {
        None => of.problem.signal_on(&wanted, ends, Purpose::Search)?,
        Some(other) => of.problem.difference_on(other, &wanted, ends, Purpose::Search)?,
    };
    let seen = of.seen(&window[1]);
    let _progress = progress::spinner("searching");
    let search = Search::new(&*signal)?.half_open();
    let mut cover = Cover::of(&*signal, digits);
    let (mut document, begins) = match seen {
        Ok(seen) => seen,
        // What is no sum of pieces may be read off a motion.
        Err(refusal) => {
            let own = Quantity { name: &wanted.name, ..*of };
            let read = Read::of(&own, ends, digits)?.ok_or(refusal)?;
            if let Some(goal) = asked.goal() {
                let (claims, found) = extremum(&search, goal, &mut cover, None, digits)?;
                let times: Vec<BigRational> = cover.cells.into_iter().map(|cell| cell.to).collect();
                return read.extreme(claims, &times, &found.places[0]);
            }
            let found = search.roots(&BigRational::default(), digits, SEARCH_BITS)?;
            if of.minus.is_some() {
                let alone = of.problem.signal_on(&wanted, ends, Purpose::Search)?;
                let alone = Search::new(&*alone)?.half_open();
                let alone = alone.roots(&BigRational::default(), digits, SEARCH_BITS)?;
                refuse_equal(&found.all, &alone.all)?;
            }
            if !read.is_beside_local {
                cover.run_nearly()?;
            }
            let times = cover.cells.into_iter().map(|cell| cell.to).collect();
            return read.zeros(&*signal, &found.all, times);
        }
    };
    let cuts = cuts(&*signal, begins)?;
    let claims = match asked.goal() {
        None => roots(&search, &mut cover, &cuts, digits)?,
        Some(goal) => {
            let (mut claims, found) = extremum(&search, goal, &mut cover, Some(&cuts), digits)?;
            claims["kind"] = json!("extremum");
            claims["attained"] = cover.attained(&found, digits)?;
            claims
        }
    };
    let Json::Object(claims) = claims else { unreachable!("claims have names") };
    document.extend(claims);
    document.insert("from".into(), json!(window[0].to_string()));
    document.insert("to".into(), json!(window[1].to_string()));
    let told = |cell: &Cell| json!([cell.from.to_string(), cell.to.to_string(), cell.order]);
    document.insert("cells".into(), cover.cells.iter().map(told).collect());
    Ok(document)
}

/// What both scenes have in common for a while, and is not zero, is zero for no checker once it is taken away.
fn refuse_equal(differences: &[Root], alone: &[Root]) -> Result<(), Failure> {
    let rest = |root: &Root| match root {
        Root::Interval { from, to, .. } => Some([from.bounds(), to.bounds()]),
        _ => None,
    };
    let rests: Vec<_> = alone.iter().filter_map(rest).collect();
    let is_silent = |[from, to]: &[Window; 2]| {
        rests.iter().any(|[begin, end]| begin[0] <= from[1] && to[0] <= end[1])
    };
    if differences.iter().filter_map(rest).all(|own| is_silent(&own)) {
        return Ok(());
    }
    let message = "there are no certificates of zeros where both quantities are equal for a while, and not zero";
    Err(Failure::usage(message, "certify how far they are apart, with --distance"))
}

fn roots(
    search: &Search<'_>,
    cover: &mut Cover<'_>,
    cuts: &[BigRational],
    digits: usize,
) -> Result<Json, Failure> {
    let found = search.roots(&BigRational::default(), digits, SEARCH_BITS)?;
    cover.run(cuts)?;
    let places: Vec<Option<Window>> =
        found.all.iter().map(|root| place(root, digits)).collect::<Result<_, Failure>>()?;
    let told = |[from, to]: Window| json!([from.to_string(), to.to_string()]);
    let zeros: Json = places.into_iter().flatten().map(told).collect();
    Ok(json!({ "kind": "roots", "zeros": zeros }))
}

/// What is claimed of the largest or smallest value, and where it is; without a goal of the largest size.
fn extremum(
    search: &Search<'_>,
    goal: Option<Goal>,
    cover: &mut Cover<'_>,
    cuts: Option<&[BigRational]>,
    digits: usize,
) -> Result<(Json, Extremum), Failure> {
    let beyond = |goal, least: Option<&BigRational>| {
        let Some(found) = search.extremum_beyond(goal, least, digits, SEARCH_BITS)? else {
            return Ok(None);
        };
        match found.value {
            Value::Enclosed(_) => Err(undecided("a digit of the extremum")),
            _ => Ok(Some((rounded(&found.value, digits), found))),
        }
    };
    let found = match goal {
        Some(goal) => beyond(goal, None)?,
        None => {
            let [least, _] = search.largest(&power_of_ten(-(digits as i64)))?;
            let both = [Goal::Largest, Goal::Smallest].map(|goal| beyond(goal, Some(&least)));
            let [most, least] = both;
            most?.into_iter().chain(least?).max_by_key(|((own, _), _)| own.to_rational().abs())
        }
    };
    let ((decimal, last_place), found) = found.ok_or_else(|| undecided("the extremum"))?;
    let half = power_of_ten(last_place) / BigRational::from_integer(2.into());
    let (value, told) = (decimal.to_rational(), decimal.to_string());
    let (goal, told, levels) = match goal {
        Some(Goal::Largest) => ("largest", &*told, vec![value + half]),
        Some(Goal::Smallest) => ("smallest", &*told, vec![value - half]),
        None => {
            let bound = value.abs() + half;
            ("distance", told.trim_start_matches('-'), vec![-&bound, bound])
        }
    };
    cover.levels = levels;
    match cuts {
        Some(cuts) => cover.run(cuts)?,
        None => cover.run_nearly()?,
    }
    Ok((json!({ "goal": goal, "value": told, "last_place": last_place }), found))
}

pub fn undecided(what: &str) -> Failure {
    let message = format!("{what} stays undecided, so there is no certificate");
    Failure::new(ACCURACY, message, "ask for another window, or for other digits")
}

fn power_of_ten(place: i64) -> BigRational {
    BigRational::from_integer(10.into()).pow(i32::try_from(place).expect("digits are limited"))
}

/// Times between which the quantity is one function, as it is written in the certificate and as it is searched.
fn cuts(signal: &dyn Signal, begins: Vec<BigRational>) -> Result<Vec<BigRational>, Failure> {
    let [from, to] = signal.window();
    let mut cuts = begins;
    for stretch in 0..signal.count()? {
        let begin = signal.exact_time(stretch, Limit::Right);
        cuts.push(begin.ok_or_else(|| undecided("a time at which a wave arrives"))?);
    }
    cuts.push(to.clone());
    cuts.retain(|time| from <= time && time <= to);
    cuts.sort();
    cuts.dedup();
    Ok(cuts)
}

/// Where a root is; a jump is none.
pub fn place(root: &Root, digits: usize) -> Result<Option<Window>, Failure> {
    let exact = |time: &Value| time.exact().cloned().ok_or_else(|| undecided("the time of a root"));
    Ok(match root {
        Root::Simple { time: Value::Enclosed(_), .. } => {
            return Err(undecided("a digit of the time of a root"));
        }
        Root::Simple { time, .. } => Some(around(time, digits)),
        Root::End { time } | Root::Arrival { time, .. } => Some([exact(time)?, exact(time)?]),
        Root::Interval { from, to, .. } => Some([exact(from)?, exact(to)?]),
        Root::Jump { .. } => None,
        Root::Double { .. } | Root::Undecided { .. } => {
            return Err(undecided("whether there is a root"));
        }
    })
}

/// Times a unit of the last place before and after another one.
pub fn around(time: &Value, digits: usize) -> Window {
    let (decimal, place) = rounded(time, digits);
    let (time, unit) = (decimal.to_rational(), power_of_ten(place));
    [&time - &unit, time + unit]
}

/// A part of the window on which a derivative has one sign: of order 0 the quantity less each level; of order k > 1 where
/// those of the orders 1 … k - 1 vanish at one end; without one the quantity is the level itself.
struct Cell {
    from: BigRational,
    to: BigRational,
    order: Option<usize>,
}

/// Cells that cover the window, so that a checker need not look for them.
struct Cover<'a> {
    signal: &'a dyn Signal,
    levels: Vec<BigRational>,
    bits: u64,
    cells: Vec<Cell>,
    /// Where a rest ended last, as near as it takes.
    woken: Option<BigRational>,
}

impl<'a> Cover<'a> {
    fn of(signal: &'a dyn Signal, digits: usize) -> Cover<'a> {
        let bits = SPARE_BITS + 4 * digits as u64;
        let levels = vec![BigRational::default()];
        Cover { signal, levels, bits, cells: Vec::new(), woken: None }
    }

    fn run(&mut self, cuts: &[BigRational]) -> Result<(), Failure> {
        for part in cuts.windows(2) {
            let stretch = self.signal.stretch_at(&part[0], Limit::Right)?;
            self.descend(stretch.expect("it begins there"), part[0].clone(), part[1].clone(), 0)?;
        }
        Ok(())
    }

    /// The same for a checker that finds the times at which waves arrive itself: those are as near as it takes.
    fn run_nearly(&mut self) -> Result<(), Failure> {
        let [first, last] = self.signal.window();
        for stretch in 0..self.signal.count()? {
            let near = |end| match self.signal.exact_time(stretch, end) {
                Some(time) => Ok(time),
                None => self.signal.time(stretch, end, self.bits).map(|own| own.midpoint().into()),
            };
            let [from, to] = [near(Limit::Right)?, near(Limit::Left)?];
            let (from, to) = (from.max(first.clone()), to.min(last.clone()));
            if from < to {
                let is_rest = self.cells.last().is_some_and(|own| own.order.is_none());
                self.woken = is_rest.then(|| from.clone());
                self.descend(stretch, from, to, 0)?;
            }
        }
        Ok(())
    }

    fn descend(
        &mut self,
        stretch: usize,
        from: BigRational,
        to: BigRational,
        depth: usize,
    ) -> Result<(), Failure> {
        if depth > DEPTH {
            return Err(undecided("the sign near a time"));
        }
        if let Some(order) = self.order(stretch, &from, &to)? {
            self.cells.push(Cell { from, to, order });
            return Ok(());
        }
        let middle = (&from + &to) / BigRational::from_integer(2.into());
        self.descend(stretch, from, middle.clone(), depth + 1)?;
        self.descend(stretch, middle, to, depth + 1)
    }

    /// What is proven of a part of a stretch, where something is.
    fn order(
        &self,
        stretch: usize,
        from: &BigRational,
        to: &BigRational,
    ) -> Result<Option<Option<usize>>, Failure> {
        if let [level] = &self.levels[..]
            && self.signal.equals(stretch, level)?
        {
            return Ok(Some(None));
        }
        let mut orders = vec![0, 1];
        for (end, time) in [(Limit::Right, from), (Limit::Left, to)] {
            if self.signal.exact_time(stretch, end).or(self.woken.clone()).as_ref() == Some(time) {
                orders.push(1 + self.signal.flatness(stretch, end, 1)?);
            }
        }
        for order in orders {
            if self.has_one_sign(stretch, order, from, to)? {
                return Ok(Some(Some(order)));
            }
        }
        Ok(None)
    }

    fn has_one_sign(
        &self,
        stretch: usize,
        order: usize,
        from: &BigRational,
        to: &BigRational,
    ) -> Result<bool, Failure> {
        let two = BigRational::from_integer(2.into());
        let (middle, half) = ((from + to) / &two, (to - from) / two);
        let near = Near { order, place: (&middle, &half), terms: TERMS, bits: self.bits };
        let taylor = self.signal.taylor(stretch, near)?;
        let rest = (1..TERMS)
            .fold(taylor.remainder, |rest, k| rest.add(&taylor.coefficient(k).magnitude()));
        let rest = rest.add(&rest.scale(-MARGIN_BITS));
        let level = |level| Ball::from_rational(level, self.bits);
        let zero = BigRational::default();
        let levels = if order == 0 { &self.levels[..] } else { std::slice::from_ref(&zero) };
        Ok(levels.iter().all(|own| {
            let middle = taylor.coefficient(0).subtract(&level(own), self.bits);
            middle.widened(&rest).sign().is_some_and(|sign| sign.is_ne())
        }))
    }

    /// The number of a cell and a time there, at which the extremum is taken or approached.
    fn attained(&self, found: &Extremum, digits: usize) -> Result<Json, Failure> {
        let (time, before) = taken(&found.places[0])?;
        let decimal = || rounded(time, digits).0.to_rational();
        let time = time.exact().cloned().unwrap_or_else(decimal);
        let begins = |cell: &Cell| !before && cell.from == time;
        let holds = |cell: &Cell| cell.from < time && time <= cell.to;
        let cell = self.cells.iter().position(begins).or(self.cells.iter().position(holds));
        let cell = cell.ok_or_else(|| undecided("the time of the extremum"))?;
        Ok(json!([cell, time.to_string()]))
    }
}

/// When an extremum is taken, and whether it is only just before.
pub fn taken(place: &Place) -> Result<(&Value, bool), Failure> {
    match place {
        Place::Critical(time) | Place::End(time) | Place::Plateau { from: time, .. } => {
            Ok((time, false))
        }
        Place::Arrival { time, after, .. } => Ok((time, !after)),
        Place::Undecided { .. } => Err(undecided("the time of the extremum")),
    }
}
