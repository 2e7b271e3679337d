//! Simpler answers than the exact one, and how far they are from it, with proof.

use super::{Kind, Problem, ProblemError, Wanted};
use crate::export::expression_text;
use crate::language::{self, Change, ChangeError, Source, closest};
use crate::model::Modes;
use crate::network::NetworkError;
use crate::planner::{self, Origin, Purpose};
use crate::signal::{EvaluateError, Goal, Place, Scale, Search, Signal};
use std::fmt;
use std::rc::Rc;
use std::str::FromStr;
use wavestep_polynomial::Rational;

/// A simpler answer: of a scene with something left out, or a part of the exact one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Simpler {
    /// These changes, one after the other.
    Scene(Vec<Change>),
    /// So many modes of vibration.
    Modes(usize),
    /// What the first so many arrivals tell, as if no more came.
    Arrivals(usize),
}

impl Simpler {
    /// How it is written.
    pub const FORMS: &'static str = "`rigid`, `third`, `rigid:BAR`, `spring:BAR`, `spring:BAR,SHARE`, \
        `endless:BAR.right`, `endless:BAR.left`, `without:ELEMENT`, `closed`, several of these joined by `+`; \
        `modes:N`, `echoes:N`";

    /// What a text may have meant whose first word is mistyped, or that names no end of a bar.
    pub(crate) fn corrected(text: &str) -> Option<String> {
        const WORDS: [&str; 8] =
            ["rigid", "third", "spring", "endless", "without", "closed", "modes", "echoes"];
        let end = text.find(':').unwrap_or(text.len());
        let (word, rest) = text.split_at(end);
        let known = closest(word, WORDS)?;
        let side = if known == "endless" && !rest.contains('.') { ".right" } else { "" };
        let corrected = format!("{known}{rest}{side}");
        (corrected != text && corrected.parse::<Simpler>().is_ok()).then_some(corrected)
    }

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
        let count = |count: &str| match count.parse() {
            Ok(0) => Err(ChangeError::Nothing(text.to_owned())),
            Ok(count) => Ok(count),
            Err(_) => Err(ChangeError::Unknown(text.to_owned())),
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

/// A scene, and what it says of a quantity.
type Counterpart<'p> = (Rc<Scale<'p>>, Box<dyn Signal + 'p>);

/// The largest absolute value of a signal on its window, with proof.
#[derive(Clone, PartialEq, Debug)]
pub struct Size {
    /// It lies between these.
    pub bounds: [Rational; 2],
    /// Places that may have it, in order of time; none where only bounds are known.
    pub places: Vec<Place>,
}

impl Size {
    /// The size of a signal, between near bounds; what is below `negligible` is not refined.
    pub(super) fn near(signal: &dyn Signal, negligible: &Rational) -> Result<Size, ProblemError> {
        Ok(Size { bounds: Search::new(signal)?.largest(negligible)?, places: Vec::new() })
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
        if near[1] <= *negligible {
            return Ok(Size { bounds: near, places: Vec::new() });
        }
        let found = |goal| search.extremum_beyond(goal, Some(&near[0]), digits, bits);
        let (most, least) = match (found(Goal::Largest), found(Goal::Smallest)) {
            (Ok(most), Ok(least)) => (most, least),
            (Err(error), _) | (_, Err(error)) if !error.is_unsettled() => return Err(error.into()),
            _ => return Ok(Size { bounds: near, places: Vec::new() }),
        };
        let least = least.map(|least| {
            let [low, high] = least.value.bounds();
            ([-high, -low], least.places)
        });
        let most = most.map(|most| (most.value.bounds(), most.places));
        // All are proven: what either knows of it holds.
        let (bounds, places) = match (most, least) {
            (None, None) => (near.clone(), Vec::new()),
            (Some(only), None) | (None, Some(only)) => only,
            (Some((own, mut places)), Some((others, more))) => {
                if own[1] < others[0] {
                    places = more;
                } else if others[1] >= own[0] {
                    places.extend(more);
                    places.sort_by_key(|place| place.from());
                    places.dedup();
                }
                let [[low, high], [other_low, other_high]] = [own, others];
                ([low.max(other_low), high.max(other_high)], places)
            }
        };
        let ([first, last], [low, high]) = (near, bounds);
        Ok(Size { bounds: [low.max(first), high.min(last)], places })
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
        // Equations have no elements.
        self.scaled()?;
        let source = language::changed(&self.source, changes)?;
        Problem::of(source, self.values.clone()).map_err(|error| match error {
            // The text that was changed is nobody's.
            ProblemError::Text(found) if !found.is_empty() => {
                let change = changes.iter().map(ToString::to_string).collect::<Vec<_>>().join("+");
                ChangeError::Refused { change, why: found[0].message().to_owned() }.into()
            }
            error => error,
        })
    }

    /// The same for formulas: where symbols are left and one bar is a spring that swings with one mass, its rate has the name
    /// `omega`, which is told beside the scene.
    pub fn model(&self, changes: &[Change]) -> Result<(Problem, Option<String>), ProblemError> {
        let model = self.changed(changes)?;
        let scene = self.scaled()?.scene();
        if model.symbols().is_empty() || *changes != [Change::Spring(None, None)] {
            return Ok((model, None));
        }
        // A name that is taken means something else.
        if ["omega", "ω"].iter().any(|name| self.source.text().contains(name)) {
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

    /// The last period at which anything arrives; `None` where waves return or have several periods, or arrivals are many.
    pub fn last_arrival(&self) -> Option<usize> {
        self.network().ok()?.recurrence().ok()?.last_arrival()
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
    pub fn difference_on<'p>(
        &'p self,
        other: impl Into<Against<'p>>,
        wanted: &Wanted,
        window: [&Rational; 2],
        purpose: Purpose,
    ) -> Result<Box<dyn Signal + 'p>, ProblemError> {
        match other.into() {
            Against::Arrivals(count) => {
                let own = self.closed_until(wanted, window[1])?;
                Ok(self.after_arrivals(own, count, window)?)
            }
            other => {
                let own = Rc::from(self.signal_on(wanted, window, purpose)?);
                self.difference_from(own, other, wanted, window, purpose)
            }
        }
    }

    /// A quantity that is known less what another answer says of it, which is not told by arrivals.
    pub(super) fn difference_from<'p>(
        &'p self,
        own: Rc<dyn Signal + 'p>,
        other: Against<'p>,
        wanted: &Wanted,
        window: [&Rational; 2],
        purpose: Purpose,
    ) -> Result<Box<dyn Signal + 'p>, ProblemError> {
        let (scale, others) = self.counterpart(other, wanted, window, purpose)?;
        Ok(planner::difference([self.scale(), scale], [own, Rc::from(others)], None, window))
    }

    /// A quantity as its arrivals tell it, from the start on.
    ///
    /// # Errors
    /// [`ProblemError::NoArrivals`] where they are not told.
    pub(super) fn closed_until<'p>(
        &'p self,
        wanted: &Wanted,
        to: &Rational,
    ) -> Result<Rc<dyn Signal + 'p>, ProblemError> {
        let (purpose, untold) =
            (Purpose::Stretches, || ProblemError::NoArrivals(wanted.name.clone()));
        if planner::origin(self.network()?, to, purpose) == Origin::Followed {
            return Err(untold());
        }
        let signal = self.signal_on(wanted, [&Rational::default(), to], purpose)?;
        match signal.closed_form() {
            Err(EvaluateError::NoClosedForm | EvaluateError::NotLinear) => Err(untold()),
            Err(error) => Err(error.into()),
            Ok(_) => Ok(Rc::from(signal)),
        }
    }

    /// Such a quantity less what its first arrivals tell of it.
    pub(super) fn after_arrivals<'p>(
        &'p self,
        own: Rc<dyn Signal + 'p>,
        count: usize,
        window: [&Rational; 2],
    ) -> Result<Box<dyn Signal + 'p>, ProblemError> {
        let scales = [self.scale(), self.scale()];
        Ok(planner::difference(scales, [own.clone(), own], Some(count), window))
    }

    fn scale(&self) -> Rc<Scale<'_>> {
        match &self.kind {
            Kind::Line { network, .. } => Scale::of(network),
            Kind::Equations(solution) => Scale::of_recurrence(solution.recurrence()),
        }
    }

    /// What another answer says of a quantity on a window, and its scene; arrivals are no answer of their own.
    ///
    /// # Errors
    /// [`ProblemError::UnknownThere`]; [`ProblemError::LeftOut`]; [`ProblemError::Apart`] for quantities or times in
    /// other units; arrivals.
    pub(super) fn counterpart<'p>(
        &'p self,
        other: Against<'p>,
        wanted: &Wanted,
        window: [&Rational; 2],
        purpose: Purpose,
    ) -> Result<Counterpart<'p>, ProblemError> {
        Ok(match other {
            Against::Problem(other) => {
                let others = self.same(other, wanted)?;
                (other.scale(), other.signal_on(&others, window, purpose)?)
            }
            Against::Modes(modes) => {
                let place = wanted.place.ok_or_else(|| self.unknown(&wanted.name))?;
                let (own, vibration) = (self.network()?, modes.vibration(place)?);
                let sum = (vibration.drift, &vibration.modes[..]);
                let signal = planner::vibration(own, sum, window);
                (self.scale(), signal.ok_or_else(|| self.unknown(&wanted.name))?)
            }
            Against::Arrivals(_) => return Err(ProblemError::NoArrivals(wanted.name.clone())),
        })
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
            let names = waves.into_iter().chain(other.observables());
            let is_here = |name: &&str| self.wanted(name).is_ok();
            let names = names.filter(is_here).map(str::to_owned);
            let (name, names) = (wanted.name.clone(), names.collect());
            let is_changed = other.title() == self.title();
            return Err(match is_changed && is_observed(self) {
                true => ProblemError::LeftOut { name, names },
                false => ProblemError::UnknownThere { name, title: title(), names },
            });
        };
        if others.dimension != wanted.dimension || self.has_units() != other.has_units() {
            return Err(ProblemError::Apart { name: wanted.name.clone(), title: title() });
        }
        Ok(others)
    }
}
