//! Simpler answers than the exact one, and how far they are from it, with proof.

use super::{Problem, ProblemError, Wanted};
use crate::export::expression_text;
use crate::language::{self, Change, ChangeError, Source};
use crate::model::Modes;
use crate::network::NetworkError;
use crate::planner::{self, Purpose};
use crate::signal::{EvaluateError, Extremum, Goal, Largest, Place, Search, Signal};
use std::fmt;
use std::str::FromStr;
use wavestep_polynomial::Rational;

/// A simpler answer: of a scene with something left out, or a part of the exact one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Simpler {
    /// These changes, one after the other.
    Scene(Vec<Change>),
    /// So many modes of vibration.
    Modes(usize),
    /// What so many arrivals tell, as if no more came.
    Arrivals(usize),
}

impl Simpler {
    /// How it is written.
    pub const FORMS: &'static str = "`rigid`, `third`, `rigid:BAR`, `spring:BAR`, `spring:BAR,SHARE`, \
        `endless:BAR.right`, `endless:BAR.left`, `without:ELEMENT`, `closed`, several of these joined by `+`; \
        `modes:N`, `echoes:N`";

    /// What it consists of, where it is no scene.
    pub(super) fn work(&self) -> String {
        match self {
            Simpler::Scene(_) => String::new(),
            Simpler::Modes(1) => "1 cosine".to_owned(),
            Simpler::Modes(count) => format!("{count} cosines"),
            Simpler::Arrivals(1) => "the first arrival".to_owned(),
            Simpler::Arrivals(count) => format!("the first {count} arrivals"),
        }
    }
}

impl fmt::Display for Simpler {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Simpler::Modes(count) => write!(f, "modes:{count}"),
            Simpler::Arrivals(count) => write!(f, "echoes:{count}"),
            Simpler::Scene(changes) => {
                let changes: Vec<String> = changes.iter().map(Change::to_string).collect();
                f.write_str(&changes.join("+"))
            }
        }
    }
}

impl FromStr for Simpler {
    type Err = ChangeError;

    fn from_str(text: &str) -> Result<Simpler, ChangeError> {
        let count = |count: &str| {
            let count = count.parse().ok().filter(|count| *count > 0);
            count.ok_or_else(|| ChangeError::Unknown(text.to_owned()))
        };
        Ok(match text.split_once(':') {
            Some(("modes", number)) => Simpler::Modes(count(number)?),
            Some(("echoes", number)) => Simpler::Arrivals(count(number)?),
            _ => Simpler::Scene(text.split('+').map(str::parse).collect::<Result<_, _>>()?),
        })
    }
}

/// What answers are compared with those of a problem.
pub enum Other {
    Problem(Box<Problem>),
    Modes(Box<Modes>),
    Arrivals(usize),
}

/// The same, as it is asked.
pub enum Against<'p> {
    Problem(&'p Problem),
    Modes(&'p Modes),
    Arrivals(usize),
}

impl<'p> From<&'p Problem> for Against<'p> {
    fn from(problem: &'p Problem) -> Against<'p> {
        Against::Problem(problem)
    }
}

impl<'p> From<&'p Other> for Against<'p> {
    fn from(other: &'p Other) -> Against<'p> {
        match other {
            Other::Problem(problem) => Against::Problem(problem),
            Other::Modes(modes) => Against::Modes(modes),
            Other::Arrivals(count) => Against::Arrivals(*count),
        }
    }
}

/// The largest absolute value of a signal on its window, with proof.
#[derive(Clone, PartialEq, Debug)]
pub struct Size {
    /// It lies between these.
    pub bounds: [Rational; 2],
    /// Where it is taken.
    pub places: Vec<Place>,
}

impl Size {
    /// The size of a signal, between near bounds; what is below `negligible` counts as that.
    pub(super) fn near(signal: &dyn Signal, negligible: &Rational) -> Result<Size, ProblemError> {
        let Largest { bounds, .. } = Search::new(signal)?.largest(negligible)?;
        Ok(Size { bounds, places: Vec::new() })
    }

    /// The size of a signal to so many digits, where its extremes are found; else between nearer bounds, or below what is
    /// negligible.
    pub fn of(
        signal: &dyn Signal,
        (digits, bits): (usize, u64),
        negligible: &Rational,
    ) -> Result<Size, ProblemError> {
        let search = Search::new(signal)?;
        let near = search.largest(negligible)?;
        if near.bounds[1] <= *negligible {
            return Ok(Size { bounds: near.bounds, places: Vec::new() });
        }
        let least = &near.bounds[0];
        let found = |goal| search.extremum_beyond(goal, Some(least), digits, bits);
        let (most, least) = match (found(Goal::Largest), found(Goal::Smallest)) {
            (Ok(most), Ok(least)) => (most, least),
            (
                Err(EvaluateError::AccuracyNotReached { .. } | EvaluateError::TooManyCells { .. }),
                _,
            )
            | (
                _,
                Err(EvaluateError::AccuracyNotReached { .. } | EvaluateError::TooManyCells { .. }),
            ) => return Ok(Size { bounds: near.bounds, places: Vec::new() }),
            (Err(error), _) | (_, Err(error)) => return Err(error.into()),
        };
        // Both are proven: what either knows of it holds.
        let [first, last] = near.bounds;
        let of = |extremum: Extremum, sign: i64| {
            let [low, high] =
                extremum.value.bounds().map(|bound| bound * Rational::from_integer(sign.into()));
            (low.clone().min(high.clone()), high.max(low), extremum.places)
        };
        let mut sizes =
            most.map(|most| of(most, 1)).into_iter().chain(least.map(|least| of(least, -1)));
        Ok(match (sizes.next(), sizes.next()) {
            (None, _) => Size { bounds: [first, last], places: Vec::new() },
            (Some((low, high, places)), None) => {
                Size { bounds: [low.max(first), high.min(last)], places }
            }
            (Some((low, high, places)), Some((other_low, other_high, others))) => {
                let places = if high >= other_high { places } else { others };
                let bounds = [low.max(other_low).max(first), high.max(other_high).min(last)];
                Size { bounds, places }
            }
        })
    }

    /// Between which numbers this size over another lies; none where the other may be zero.
    pub fn over(&self, other: &Size) -> Option<[Rational; 2]> {
        let [low, high] = &other.bounds;
        (*low > Rational::default()).then(|| [&self.bounds[0] / high, &self.bounds[1] / low])
    }
}

#[doc(hidden)]
impl Problem {
    /// The same scene with something left out.
    pub fn changed(&self, changes: &[Change]) -> Result<Problem, ProblemError> {
        let source = language::changed(&self.source, changes)?;
        Problem::of(source, self.values.clone())
    }

    /// The same for formulas: where symbols are left and one bar is a spring that swings with one mass, its rate has the name
    /// `omega`, which is told beside the scene.
    ///
    /// # Errors
    /// As [`Problem::changed`].
    pub fn model(&self, changes: &[Change]) -> Result<(Problem, Option<String>), ProblemError> {
        let model = self.changed(changes)?;
        let scene = self.scaled()?.scene();
        if model.symbols().is_empty() || *changes != [Change::Spring(None, None)] {
            return Ok((model, None));
        }
        let Some(square) = scene.square_of_rate() else { return Ok((model, None)) };
        let square = square.map_err(NetworkError::from)?;
        let text = format!("{}\nsymbol omega > 0\n", model.source.text());
        let text = text.replace("as = spring", "as = spring, rate = omega");
        let source = Source::new(model.source.name(), text)?;
        let told = format!("omega^2 = {}", expression_text(&square.into()));
        Ok((Problem::of(source, self.values.clone())?, Some(told)))
    }

    /// Whether waves come back: of a scene, whether a bar lies between two places.
    pub fn waves_return(&self) -> bool {
        let mut bars = self.scaled().map(|scaled| scaled.model().bars.values());
        bars.as_mut().map_or(true, |bars| bars.any(|bar| bar.travel.is_some()))
    }

    /// What it was read from.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// A simpler answer, made ready.
    pub fn simpler(&self, simpler: &Simpler) -> Result<Other, ProblemError> {
        Ok(match simpler {
            Simpler::Scene(changes) => Other::Problem(Box::new(self.changed(changes)?)),
            Simpler::Modes(count) => Other::Modes(Box::new(Modes::new(self.scaled()?, *count)?)),
            Simpler::Arrivals(count) => Other::Arrivals(*count),
        })
    }

    /// A quantity less what another answer says of it, on a window: how far the two are apart.
    ///
    /// # Errors
    /// [`ProblemError::UnknownThere`]; [`ProblemError::Apart`] for quantities or times in other units; equations
    /// without bars; arrivals of what has no closed form.
    pub fn difference_on<'p>(
        &'p self,
        other: impl Into<Against<'p>>,
        wanted: &Wanted,
        window: [&Rational; 2],
        purpose: Purpose,
    ) -> Result<Box<dyn Signal + 'p>, ProblemError> {
        let own = self.network()?;
        let signal = || self.signal_on(wanted, window, purpose);
        let (network, others, arrivals) = match other.into() {
            Against::Problem(other) => {
                let others = self.same(other, wanted)?;
                (other.network()?, other.signal_on(&others, window, purpose)?, None)
            }
            Against::Modes(modes) => {
                let place = wanted.place.ok_or_else(|| self.unknown(&wanted.name))?;
                let own_modes = modes.vibration(place)?;
                let sum = (own_modes.drift, &own_modes.modes[..]);
                let signal = planner::vibration(own, sum, window);
                (own, signal.ok_or_else(|| self.unknown(&wanted.name))?, None)
            }
            Against::Arrivals(count) => {
                let signal = signal()?;
                signal.closed_form()?;
                (own, signal, Some(count))
            }
        };
        Ok(planner::difference([own, network], [signal()?, others], arrivals, window))
    }

    /// The quantity of the same name in another scene.
    fn same(&self, other: &Problem, wanted: &Wanted) -> Result<Wanted, ProblemError> {
        let title = || other.title().to_owned();
        // A wave of the other scene may have the name of what is observed here.
        let others = other.wanted(&wanted.name).ok();
        let is_observed = |problem: &Problem| problem.observables().contains(&&*wanted.name);
        let others = others.filter(|_| is_observed(self) == is_observed(other));
        let Some(others) = others else {
            let waves = if is_observed(self) { Vec::new() } else { other.waves() };
            let names = waves.into_iter().chain(other.observables()).map(str::to_owned);
            let (name, names) = (wanted.name.clone(), names.collect());
            return Err(ProblemError::UnknownThere { name, title: title(), names });
        };
        if others.dimension != wanted.dimension || self.has_units() != other.has_units() {
            return Err(ProblemError::Apart { name: wanted.name.clone(), title: title() });
        }
        Ok(others)
    }
}
