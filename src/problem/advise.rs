//! How much of a scene an answer needs: simpler answers from cheap to dear, and which of them is enough with proof.
//!
//! Samples tell quickly what is not enough, each with the time at which it is seen; what they let pass is proven by the
//! largest difference on the window.

use super::comparison::{Comparison, PURPOSE};
use super::{Other, Problem, ProblemError, Simpler, Size, Wanted};
use crate::ball::{Ball, Bound, Decimal};
use crate::language::syntax::Declared;
use crate::language::{self, Beyond, Change, ChangeError};
use crate::signal::{Limit, Signal};
use num_traits::Signed as _;
use std::time::{Duration, Instant};
use wavestep_polynomial::Rational;

/// The precision of samples, and where in a stretch they are taken, in 64ths of it.
const SAMPLE_BITS: u64 = 64;
const PLACES: [i64; 5] = [1, 16, 32, 48, 63];

/// The most digits of a sample's time: a reader can try it.
const DIGITS: usize = 17;

/// The most stretches that are sampled.
const MAX_SAMPLED: usize = 48;

/// The most modes and arrivals that are tried.
const MAX_MODES: usize = 64;
const MAX_ARRIVALS: usize = 64;

/// How many larger numbers are tried where samples pass and no proof is found.
const MORE: usize = 3;

/// The shares of its mass that a bar may have at an end, in so many parts of it, for samples; then those beside the best
/// one, at half the distance, so often, each by the proven largest difference.
const SHARES: std::ops::RangeInclusive<i64> = 2..=12;
const PARTS: i64 = 20;
const HALVINGS: u32 = 5;

/// A share is looked for where the best of these is off by less than so many times the tolerance.
const HOPELESS: i64 = 2;

/// What is asked.
pub struct Need<'a> {
    pub wanted: &'a Wanted,
    pub window: [&'a Rational; 2],
    /// How far off an answer may be, over the largest value.
    pub tolerance: Rational,
}

/// What a simpler answer is worth.
#[derive(Clone, PartialEq, Debug)]
pub enum Verdict {
    /// It is off by at most the second number, and somewhere by the first, over the largest value.
    Enough([Rational; 2]),
    /// It is off by more than is allowed, by so much at this time, over the largest value.
    Misses { by: Rational, at: Rational },
    /// Samples are near enough, and no proof was found that all is.
    Unproven(String),
    /// It does not suit the scene.
    Unsuited(String),
}

/// A simpler answer that was tried.
#[derive(Clone, Debug)]
pub struct Tried {
    pub simpler: Simpler,
    pub verdict: Verdict,
    /// What it consists of, in words.
    pub work: String,
    /// How long a value took, when samples were taken.
    pub each: Duration,
}

/// All that was tried, from cheap to dear.
#[derive(Clone, Debug)]
pub struct Advice {
    pub tried: Vec<Tried>,
    /// The largest value of the quantity.
    pub largest: Size,
    /// What the exact answer consists of, and how long a value of it took.
    pub work: String,
    pub each: Duration,
}

impl Advice {
    /// The cheapest that is enough.
    pub fn enough(&self) -> Option<&Tried> {
        self.tried.iter().find(|own| matches!(own.verdict, Verdict::Enough(_)))
    }

    /// The dearest of those cheaper than what is enough that are known not to be.
    pub fn next_cheaper(&self) -> Option<&Tried> {
        let before = self.tried.iter().take_while(|own| !matches!(own.verdict, Verdict::Enough(_)));
        before.filter(|own| matches!(own.verdict, Verdict::Misses { .. })).last()
    }

    /// The cheapest that is enough and is a scene.
    pub fn scene(&self) -> Option<(&Tried, &[Change])> {
        self.tried.iter().find_map(|own| match (&own.simpler, &own.verdict) {
            (Simpler::Scene(changes), Verdict::Enough(_)) => Some((own, &changes[..])),
            _ => None,
        })
    }
}

/// An answer at the times of samples.
struct Sampled {
    worst: Rational,
    at: Rational,
    each: Duration,
}

/// An answer, or its difference from the exact one.
enum TellsOff<'a> {
    Answer(Box<dyn Signal + 'a>),
    Difference(Box<dyn Signal + 'a>),
}

impl TellsOff<'_> {
    fn signal(&self) -> &dyn Signal {
        match self {
            TellsOff::Answer(signal) | TellsOff::Difference(signal) => &**signal,
        }
    }

    /// By how much it is certainly off at the time of a sample.
    fn off(&self, (time, exact): &(Rational, Ball)) -> Result<Rational, ProblemError> {
        let value = (self.signal().point(time, Limit::Right)?.enclose)(SAMPLE_BITS)?;
        let off = match self {
            TellsOff::Answer(_) => exact.subtract(&value, SAMPLE_BITS),
            TellsOff::Difference(_) => value,
        };
        Ok(off.smallest_size())
    }
}

struct Adviser<'p> {
    comparison: Comparison<'p>,
    tolerance: &'p Rational,
    /// The times of samples, with the exact values.
    samples: Vec<(Rational, Ball)>,
    tried: Vec<Tried>,
    /// The texts of the scenes that were tried, and whether they are enough.
    texts: Vec<(String, bool)>,
    tell: &'p dyn Fn(&Simpler),
}

#[doc(hidden)]
impl Problem {
    /// Tries simpler answers from cheap to dear; `tell` hears of each.
    ///
    /// # Errors
    /// As [`Problem::signal_on`], and where the largest value is not found.
    pub fn advise(&self, need: &Need<'_>, tell: &dyn Fn(&Simpler)) -> Result<Advice, ProblemError> {
        let comparison = Comparison::new(self, need.wanted, need.window)?;
        let signal = &comparison.signal;
        let begun = Instant::now();
        let sample = |time: Rational| {
            let value = (signal.point(&time, Limit::Right)?.enclose)(SAMPLE_BITS)?;
            Ok((time, value))
        };
        let samples: Result<Vec<_>, ProblemError> =
            sample_times(&**signal)?.into_iter().map(sample).collect();
        let samples = samples?;
        let each = begun.elapsed() / samples.len() as u32;
        let work = self.work(signal.count()?);
        let mut adviser = Adviser {
            comparison,
            tolerance: &need.tolerance,
            samples,
            tried: Vec::new(),
            texts: Vec::new(),
            tell,
        };
        adviser.whole();
        adviser.shares();
        adviser.reduced()?;
        let arrivals = adviser.comparison.arrivals()?;
        if arrivals > 1 {
            adviser.counted(MAX_ARRIVALS.min(arrivals - 1), Simpler::Arrivals);
        }
        adviser.counted(MAX_MODES, Simpler::Modes);
        let Adviser { tried, comparison, .. } = adviser;
        Ok(Advice { tried, largest: comparison.largest, work, each })
    }

    /// The elements of a scene and, without a local contact, the number of arrivals.
    fn work(&self, stretches: usize) -> String {
        let bars = self.scaled().map_or(0, |scaled| scaled.model().bars.len());
        let lumps = self.scaled().map_or(0, |scaled| scaled.model().lumps.len());
        let of = |count: usize, what: &str| match count {
            1 => format!("1 {what}"),
            _ => format!("{count} {what}s"),
        };
        let elements = match bars {
            0 => return of(lumps, "element"),
            _ => format!("{}, {}", of(bars, "bar"), of(lumps, "lumped element")),
        };
        // Beside a local contact a motion is cut where its series ends.
        match self.local_contact() {
            Some(_) => elements,
            None => format!("{elements}, {}", of(stretches - 1, "arrival")),
        }
    }
}

/// Times within the stretches of a signal, near their ends and between, with few digits.
fn sample_times(signal: &dyn Signal) -> Result<Vec<Rational>, ProblemError> {
    let [from, to] = signal.window();
    let count = signal.count()?;
    let stride = count.div_ceil(MAX_SAMPLED);
    let mut times = Vec::new();
    for stretch in (0..count).step_by(stride).filter(|stretch| !signal.is_instant(*stretch)) {
        let end = |end| -> Result<Rational, ProblemError> {
            let time = match signal.exact_time(stretch, end) {
                Some(time) => time,
                None => signal.time(stretch, end, SAMPLE_BITS)?.midpoint().into(),
            };
            Ok(time.clamp(from.clone(), to.clone()))
        };
        let (first, last) = (end(Limit::Right)?, end(Limit::Left)?);
        let part = (&last - &first) / Rational::from_integer(64.into());
        let near = &part / Rational::from_integer(4.into());
        let at = |place: i64| &first + &part * Rational::from_integer(place.into());
        times.extend(PLACES.map(|place| with_few_digits(at(place), &near)));
    }
    Ok(times)
}

/// The decimal with the fewest digits that is as near as this; the number itself where all need many.
fn with_few_digits(number: Rational, near: &Rational) -> Rational {
    let decimal = |digits| Decimal::from_rational(&number, digits).0.to_rational();
    let short = (1..=DIGITS).map(decimal).find(|own| (own - &number).abs() <= *near);
    short.unwrap_or(number)
}

impl Adviser<'_> {
    fn problem(&self) -> &Problem {
        self.comparison.problem
    }

    /// What tells how far an answer is off.
    fn told_by<'o>(&'o self, other: &'o Other) -> Result<TellsOff<'o>, ProblemError> {
        let Comparison { problem, wanted, window, .. } = self.comparison;
        Ok(match other {
            // What they leave out is told by the difference alone.
            Other::Arrivals(_) => TellsOff::Difference(self.comparison.difference(other)?),
            other => {
                TellsOff::Answer(problem.counterpart(other.into(), wanted, window, PURPOSE)?.1)
            }
        })
    }

    /// How far off samples are at most, and how many stretches the answer has.
    fn sample(&self, other: &Other) -> Result<(Sampled, usize), ProblemError> {
        let told = self.told_by(other)?;
        let begun = Instant::now();
        let mut worst = (Rational::default(), self.samples[0].0.clone());
        for sample in &self.samples {
            let off = told.off(sample)?;
            if off > worst.0 {
                worst = (off, sample.0.clone());
            }
        }
        let each = begun.elapsed() / self.samples.len() as u32;
        let (worst, at) = worst;
        Ok((Sampled { worst, at, each }, told.signal().count()?))
    }

    /// The verdict of samples: nothing where they are near enough.
    fn verdict(&self, sampled: &Sampled) -> Option<Verdict> {
        let by = self.share_of(&sampled.worst);
        (by > *self.tolerance).then(|| Verdict::Misses { by, at: sampled.at.clone() })
    }

    /// A difference over the largest value, at least.
    fn share_of(&self, difference: &Rational) -> Rational {
        difference / &self.comparison.largest.bounds[1]
    }

    fn proven(&self, other: &Other) -> Verdict {
        match self.comparison.share(other, self.tolerance) {
            Err(error) => Verdict::Unproven(first_line(&error)),
            Ok(share) if share[1] <= *self.tolerance => Verdict::Enough(share),
            Ok([_, most]) => {
                let percent = most * Rational::from_integer(100.into());
                let percent = Decimal::bound(&percent, 3, Bound::Upper);
                Verdict::Unproven(format!(
                    "the difference may reach {percent} % of the largest value"
                ))
            }
        }
    }

    /// Whether a scene that was tried is enough; nothing of others.
    fn known(&self, problem: &Problem) -> Option<bool> {
        let text = problem.source().text();
        self.texts.iter().find(|(known, _)| known == text).map(|(_, is_enough)| *is_enough)
    }

    /// Tries one answer; whether it is enough.
    fn attempt(&mut self, simpler: Simpler) -> bool {
        (self.tell)(&simpler);
        let mut each = Duration::ZERO;
        let (mut work, mut known) = (String::new(), None);
        let other = self.problem().simpler(&simpler);
        if let Ok(Other::Problem(problem)) = &other {
            if let Some(is_enough) = self.known(problem) {
                return is_enough;
            }
            known = Some(self.texts.len());
            self.texts.push((problem.source().text().to_owned(), false));
        }
        let tried = other.and_then(|other| {
            let (sampled, count) = self.sample(&other)?;
            each = sampled.each;
            work = match &other {
                Other::Problem(problem) => problem.work(count),
                Other::Modes(_) | Other::Arrivals(_) => simpler.work(),
            };
            Ok(self.verdict(&sampled).unwrap_or_else(|| self.proven(&other)))
        });
        let verdict = tried.unwrap_or_else(|error| Verdict::Unsuited(first_line(&error)));
        let is_enough = matches!(verdict, Verdict::Enough(_));
        if let Some(place) = known {
            self.texts[place].1 = is_enough;
        }
        self.tried.push(Tried { simpler, verdict, work, each });
        is_enough
    }

    /// Whether samples of an answer are near enough.
    fn passes(&self, simpler: &Simpler) -> Result<bool, ProblemError> {
        (self.tell)(simpler);
        let other = self.problem().simpler(simpler)?;
        let told = self.told_by(&other)?;
        // Errors grow with time more often than not.
        for sample in self.samples.iter().rev() {
            if self.share_of(&told.off(sample)?) > *self.tolerance {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// All bars rigid, and all of them springs.
    fn whole(&mut self) {
        self.attempt(Simpler::Scene(vec![Change::Rigid(None)]));
        self.attempt(Simpler::Scene(vec![Change::Spring(None, None)]));
    }

    /// All bars springs, with the share of their masses whose largest difference is the smallest.
    fn shares(&mut self) {
        let third = Simpler::Scene(vec![Change::Spring(None, None)]);
        let usual = self.tried.iter().find(|own| own.simpler == third).map(|own| &own.verdict);
        let Some(Verdict::Misses { by: usual, .. }) = usual.cloned() else { return };
        let bars: Vec<String> = self
            .names()
            .into_iter()
            .filter_map(|(name, kind)| (kind == Declared::Bar).then_some(name))
            .collect();
        let with = |share: &Rational| {
            let share = share.to_string();
            let spring = |bar: &String| Change::Spring(Some(bar.clone()), Some(share.clone()));
            Simpler::Scene(bars.iter().map(spring).collect())
        };
        let sampled = |share: Rational| {
            let other = self.problem().simpler(&with(&share)).ok()?;
            Some((self.sample(&other).ok()?.0.worst, share))
        };
        let proven = |share: Rational| {
            let other = self.problem().simpler(&with(&share)).ok()?;
            let [_, most] = self.comparison.share(&other, self.tolerance).ok()?;
            Some((most, share))
        };
        let shares = SHARES.map(|share| Rational::new(share.into(), PARTS.into()));
        let Some((worst, share)) = shares.filter_map(sampled).min() else { return };
        // A share between two of these is hardly better.
        if self.share_of(&worst) > self.tolerance * Rational::from_integer(HOPELESS.into()) {
            return;
        }
        let Some(mut best) = proven(share) else { return };
        for halving in 1..=HALVINGS {
            let step = Rational::new(1.into(), (PARTS << halving).into());
            let beside = [&best.1 - &step, &best.1 + &step];
            best = beside.into_iter().filter_map(proven).chain([best]).min().expect("one at least");
        }
        if best.0 < usual {
            self.attempt(with(&best.1));
        }
    }

    fn names(&self) -> Vec<(String, Declared)> {
        language::elements(self.problem().source()).unwrap_or_default()
    }

    /// Leaves out one element after the other, as far as samples stay near enough.
    fn reduced(&mut self) -> Result<(), ProblemError> {
        let mut changes: Vec<Change> = Vec::new();
        let mut missed = None;
        let names = self.names();
        if self.problem().network()?.scene().contacts_open {
            self.extend(&mut changes, vec![Change::Closed], &mut missed);
        }
        for (name, kind) in names {
            let is_gone = |changes: &[Change]| {
                let source = language::changed(self.problem().source(), changes);
                source
                    .ok()
                    .and_then(|source| language::elements(&source).ok())
                    .is_some_and(|left| left.iter().all(|(own, _)| *own != name))
            };
            if is_gone(&changes) {
                continue;
            }
            let mut ways = vec![Change::Without(name.clone())];
            if kind == Declared::Bar {
                ways.push(Change::Endless(name.clone(), Beyond::Right));
                ways.push(Change::Endless(name.clone(), Beyond::Left));
                ways.push(Change::Rigid(Some(name.clone())));
                ways.push(Change::Spring(Some(name.clone()), None));
            }
            self.extend(&mut changes, ways, &mut missed);
        }
        // What was tried under another name is told already.
        let is_new = |own: &Tried| match self.problem().simpler(&own.simpler) {
            Ok(Other::Problem(problem)) => self.known(&problem).is_none(),
            _ => true,
        };
        self.tried.extend(missed.filter(is_new));
        // What samples let pass and no proof does is taken back, the last change first.
        while !changes.is_empty() && !self.attempt(Simpler::Scene(changes.clone())) {
            changes.pop();
        }
        Ok(())
    }

    /// Takes the first of some changes that samples let pass; of those that do not, the nearest is kept.
    fn extend(&self, changes: &mut Vec<Change>, ways: Vec<Change>, missed: &mut Option<Tried>) {
        for way in ways {
            let mut all = changes.clone();
            all.push(way);
            let simpler = Simpler::Scene(all.clone());
            (self.tell)(&simpler);
            let Ok(other) = self.problem().simpler(&simpler) else { continue };
            let Ok((sampled, count)) = self.sample(&other) else { continue };
            let Some(verdict) = self.verdict(&sampled) else {
                *changes = all;
                return;
            };
            let is_nearer = match (&verdict, &missed) {
                (
                    Verdict::Misses { by, .. },
                    Some(Tried { verdict: Verdict::Misses { by: known, .. }, .. }),
                ) => by < known,
                _ => true,
            };
            if is_nearer {
                let work = match &other {
                    Other::Problem(problem) => problem.work(count),
                    _ => String::new(),
                };
                *missed = Some(Tried { simpler, verdict, work, each: sampled.each });
            }
        }
    }

    /// The smallest number of modes or arrivals that is enough, by doubling and halving on samples.
    fn counted(&mut self, most: usize, of: fn(usize) -> Simpler) {
        let mut high = 1;
        loop {
            match self.passes(&of(high)) {
                Ok(true) => break,
                // What does not suit the scene does not in any number.
                Err(error) if high == 1 => {
                    let (verdict, work) = (Verdict::Unsuited(first_line(&error)), String::new());
                    self.tried.push(Tried {
                        simpler: of(most),
                        verdict,
                        work,
                        each: Duration::ZERO,
                    });
                    return;
                }
                _ if high >= most => {
                    self.attempt(of(most));
                    return;
                }
                _ => high = (2 * high).min(most),
            }
        }
        let mut low = high / 2;
        while high - low > 1 {
            let middle = low.midpoint(high);
            if self.passes(&of(middle)).unwrap_or(false) { high = middle } else { low = middle }
        }
        if low > 0 {
            self.attempt(of(low));
        }
        // Where samples pass and no proof is found, a few more may do.
        let mut tries = 0;
        while !self.attempt(of(high)) && high < most && tries < MORE {
            (high, tries) = ((high + high.div_ceil(4)).min(most), tries + 1);
        }
    }
}

pub(super) fn first_line(error: &ProblemError) -> String {
    match error {
        ProblemError::Text(diagnostics) if !diagnostics.is_empty() => {
            diagnostics[0].message().to_owned()
        }
        ProblemError::Change(ChangeError::Refused { why, .. }) => why.clone(),
        error => error.to_string().lines().next().unwrap_or_default().to_owned(),
    }
}
