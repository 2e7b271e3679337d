//! Exact forms: pieces, echoes, general forms, and how they follow from the scene.

use super::bounds::{
    MAX_NAMED_TERMS, first_long_echo, refuse_echoes, refuse_terms, terms_of_piece, terms_through,
};
use super::constants::named_rates_of;
use super::error::Missing;
use super::{Kind, Problem, ProblemError};
use crate::export::{self, Derivation, Formula, Notation, SourceForm};
use crate::expression::{Expression, Fraction};
use crate::language;
use crate::network::{Network, Observed, ObservedValue};
use crate::recurrence::{Observable, Recurrence, WaveIndex};
use crate::signal::{Arrival, LongEcho, arrivals};
use crate::solution::{ObserveError, ObservedStretch, Solution, Unknown};
use std::borrow::Cow;

/// How many periods an explanation tells after the first, where nothing is said.
const FIRST_PIECES: usize = 2;

/// How many more it tells at most, until all waves have begun.
const MOST_PIECES: usize = 8;

/// How many orders are derived after the first, where nothing is said.
const FEW: usize = 3;

/// Where waves do not return, all orders are derived if there are no more than these.
const MOST_WITHOUT_RETURN: usize = 16;

/// The most terms of all waves that an echo with names for rates has of these.
pub(super) const FEW_TERMS: usize = 5_000;

/// What is to be derived.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ToDerive<'a> {
    /// All waves that are stated, or that a scene has.
    Waves,
    /// The wave of this name, else the observable.
    Quantity(&'a str),
}

/// What that names.
enum Meant<'a> {
    Waves(Vec<WaveIndex>),
    Observable(&'a Observable),
}

impl Meant<'_> {
    /// These waves, or those that the observable is made of.
    fn waves(&self) -> Vec<WaveIndex> {
        match self {
            Meant::Waves(waves) => waves.clone(),
            Meant::Observable(observable) => {
                observable.observation.waves.iter().map(|seen| seen.wave).collect()
            }
        }
    }
}

/// Of which periods.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Orders {
    /// From the first to the last of these.
    Through(usize, usize),
    /// Of this one only.
    Only(usize),
}

impl Orders {
    fn ends(self) -> (usize, usize) {
        match self {
            Orders::Through(first, last) => (first, last),
            Orders::Only(n) => (n, n),
        }
    }
}

/// The form in which functions are derived.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Form {
    /// One function of local time for each period.
    Period,
    /// The echoes that arrive period by period, and add up.
    Echo,
    /// The pieces with the half-open intervals on which they hold.
    Piecewise,
}

/// Functions of one wave or observable.
#[derive(Clone, PartialEq, Debug)]
pub struct Functions {
    /// The wave or observable.
    pub name: String,
    /// The order of the first function.
    pub first: usize,
    /// When the first period begins.
    pub offset: Fraction,
    pub expressions: Vec<Expression>,
}

#[derive(Clone, PartialEq, Debug)]
pub enum Derived {
    /// Pieces or echoes.
    Functions(Vec<Functions>),
    /// An observable whose waves arrive apart, from arrival to arrival.
    Stretches(String, Vec<ObservedStretch>),
    /// Echoes in the order of their arrival, where there are no periods.
    Arrivals(Vec<Arrival>),
}

/// The form of a wave or an observable for every period.
#[derive(Clone, PartialEq, Debug)]
pub struct GeneralFormulas {
    pub name: String,
    /// When the first period begins.
    pub offset: Fraction,
    pub formulas: Vec<Formula>,
}

/// Whose symbols formulas are written in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Symbols {
    /// Those of the text.
    Own,
    /// Those of its source, as its `written` statements say.
    Source,
}

#[doc(hidden)]
impl Problem {
    /// Exact functions of waves, or of an observable.
    pub fn functions(
        &self,
        what: ToDerive<'_>,
        orders: Orders,
        form: Form,
    ) -> Result<Derived, ProblemError> {
        if let Some(network) = self.lattice() {
            return self.by_arrival(network, what, orders, form);
        }
        let solution = self.solution()?;
        self.derived(solution, what, orders, form).map_err(|error| self.explained(error))
    }

    fn derived(
        &self,
        solution: &Solution,
        what: ToDerive<'_>,
        orders: Orders,
        form: Form,
    ) -> Result<Derived, ProblemError> {
        let recurrence = solution.recurrence();
        let meant = self.meant(recurrence, what)?;
        self.refuse_explosion(recurrence, orders, form, &meant.waves())?;
        let observable = match meant {
            Meant::Waves(waves) => {
                let functions = |wave| functions(solution, wave, orders, form);
                let all = waves.into_iter().map(functions).collect::<Result<_, _>>()?;
                return Ok(Derived::Functions(all));
            }
            Meant::Observable(observable) => observable,
        };
        if form == Form::Echo {
            return Err(ProblemError::EchoesOfObservable(observable.name.clone()));
        }
        match solution.offset(&observable.observation) {
            Some(_) => Ok(Derived::Functions(vec![observed(solution, observable, orders)?])),
            None => between_arrivals(solution, observable, orders),
        }
    }

    /// The orders from one on that are derived where none are asked for: four, or those before the first whose
    /// formulas are long, with what says so. Where nothing returns, the last function holds at all times after it began, and
    /// there are no more.
    pub fn first_orders(&self, what: ToDerive<'_>, from: usize) -> (Orders, Option<ProblemError>) {
        let all = self.last_arrival().filter(|last| *last <= MOST_WITHOUT_RETURN);
        if let Some(last) = all {
            return (Orders::Through(from, last.max(from)), None);
        }
        let last = from.saturating_add(FEW);
        if let Some(network) = self.lattice() {
            let all = (0..network.waves().len()).collect::<Vec<_>>();
            let (through, _, long) = self.few_arrivals(network, &all, last, FEW_TERMS);
            return (Orders::Through(from, through.max(from)), long);
        }
        let named = self.recurrence().ok().filter(|of| of.names_rates_of(1));
        let Some(recurrence) = named else { return (Orders::Through(from, last), None) };
        let waves = self.meant(recurrence, what).map_or_else(|_| Vec::new(), |own| own.waves());
        match self.long_echoes(recurrence, &waves, last + 1, FEW_TERMS) {
            Err(long @ ProblemError::LongEchoes { n, .. }) => {
                (Orders::Through(from, n.saturating_sub(1).max(from)), Some(long))
            }
            _ => (Orders::Through(from, last), None),
        }
    }

    /// Pieces of waves in the symbols of the text's source.
    pub fn source_form(
        &self,
        what: ToDerive<'_>,
        orders: Orders,
    ) -> Result<Vec<Formula>, ProblemError> {
        self.refuse_lattice(Missing::Periods)?;
        let solution = self.solution()?;
        let meant = self.meant(solution.recurrence(), what)?;
        has_source_form(solution.recurrence(), &meant)?;
        self.refuse_explosion(solution.recurrence(), orders, Form::Period, &meant.waves())?;
        let found = source_form(&AsWaves::new(solution, meant)?, orders);
        found.map_err(|error| self.explained(error))
    }

    /// The forms of waves, or of an observable, for every period.
    pub fn general_formulas(
        &self,
        what: ToDerive<'_>,
        symbols: Symbols,
    ) -> Result<Vec<GeneralFormulas>, ProblemError> {
        self.refuse_lattice(Missing::GeneralForm)?;
        let solution = self.solution()?;
        let meant = self.meant(solution.recurrence(), what)?;
        if symbols == Symbols::Source {
            has_source_form(solution.recurrence(), &meant)?;
        }
        let all = AsWaves::new(solution, meant)?;
        let general = |wave: &WaveIndex| general(&all, *wave, symbols);
        let found: Result<Vec<_>, _> = all.waves.iter().map(general).collect();
        found.map_err(|error| self.explained(error))
    }

    /// How the recurrence follows from the bars and elements of a scene, how the pieces of these periods follow
    /// from it, step by step, and why general forms hold. Where no periods are asked for, three from `from` on.
    /// By echoes, how these follow by transforms instead of pieces. An exercise has the question in front.
    pub fn explanation(
        &self,
        orders: Option<Orders>,
        from: usize,
        form: Form,
        exercise: bool,
    ) -> Result<Derivation, ProblemError> {
        if self.on_lattice() {
            return Err(ProblemError::NoPeriodsToExplain);
        }
        let solution = self.solution()?;
        let recurrence = solution.recurrence();
        let waves: Vec<WaveIndex> = (0..self.waves().len()).collect();
        let (first, last) = match orders {
            Some(orders) => orders.ends(),
            None => (from, self.last_explained(from)?),
        };
        self.refuse_explosion(recurrence, Orders::Through(first, last), Form::Period, &waves)?;
        let decimal = |value: &_| super::constants::decimal(recurrence.constants(), value);
        let mut derivation = match &self.kind {
            Kind::Equations(_) => Derivation::of_recurrence(recurrence, &decimal),
            Kind::Line { .. } => Derivation::of(self.network()?, recurrence, &decimal),
        };
        if form != Form::Echo {
            derivation.pieces(recurrence, first, last, waves.len());
        } else if !derivation.by_transforms(solution, waves.len()) {
            return Err(ProblemError::NoEchoesToExplain);
        }
        derivation.general_forms(solution, waves.len());
        derivation.drop_unused_constants();
        if !exercise {
            return Ok(derivation);
        }
        let task = match &self.kind {
            Kind::Equations(_) => "Solve the equations for one wave after another.",
            Kind::Line { .. } => "Derive the recurrence between the waves of successive periods.",
        };
        let asked = |n: Notation| {
            let name = |wave: &usize| format!("${}$", n.name(&recurrence.wave_name(*wave)));
            let names = waves.iter().map(name).collect::<Vec<_>>().join(", ");
            let value = |(of, value): (&String, &_)| format!(" Let ${} = {value}$.", n.name(of));
            let values: String = self.values.iter().map(value).collect();
            format!(
                "{task} Find {names} on the periods {first} to {last}, and for every $n$ where there \
                 is such a form.{values}"
            )
        };
        Ok(derivation.as_exercise(self.source.text(), asked))
    }

    /// The last period that is told where nothing is said: all waves have begun by then, if they do so soon.
    fn last_explained(&self, from: usize) -> Result<usize, ProblemError> {
        let (orders, long) = self.first_orders(ToDerive::Waves, from);
        let last = orders.ends().1.min(from + FIRST_PIECES);
        if long.is_some() || from > 0 {
            return Ok(last);
        }
        let solution = self.solution()?;
        let mut begun = last;
        for wave in 0..self.waves().len() {
            let echoes = solution.echoes(wave, MOST_PIECES)?.echoes;
            begun = begun.max(echoes.iter().position(|echo| !echo.is_zero()).unwrap_or(0));
        }
        Ok(begun)
    }

    /// The formulas of what was derived, of one wave or observable after the other.
    pub fn formulas(
        &self,
        derived: &Derived,
        form: Form,
    ) -> Result<Vec<(String, Vec<Formula>)>, ProblemError> {
        if let (Derived::Arrivals(found), Ok(network)) = (derived, self.network()) {
            let (local, time) = (network.local(), &network.scene().time);
            let formula = |arrival: &Arrival| {
                let Arrival { wave, counts, delay, echo } = arrival;
                let name = &network.waves()[*wave].name;
                Formula::of_arrival(name, counts, delay, echo, &local, time)
            };
            return Ok(vec![(String::new(), found.iter().map(formula).collect())]);
        }
        let statement = self.recurrence()?.statement();
        let local = &statement.local;
        Ok(match derived {
            Derived::Functions(all) => {
                let formulas = |functions: &Functions| {
                    (functions.name.clone(), formulas(statement, functions, form))
                };
                all.iter().map(formulas).collect()
            }
            Derived::Stretches(name, stretches) => {
                let formula = |(n, stretch): (usize, &ObservedStretch)| {
                    let formula = Formula::piece(name, n, &stretch.value, local);
                    formula.between(&stretch.from, &stretch.to, statement)
                };
                vec![(name.clone(), stretches.iter().enumerate().map(formula).collect())]
            }
            Derived::Arrivals(_) => Vec::new(),
        })
    }

    fn refuse_explosion(
        &self,
        recurrence: &Recurrence,
        orders: Orders,
        form: Form,
        waves: &[WaveIndex],
    ) -> Result<(), ProblemError> {
        let ((_, last), parts) = (orders.ends(), waves.len());
        if recurrence.has_named_rates() {
            return self.long_echoes(recurrence, waves, last, MAX_NAMED_TERMS);
        }
        let one = match form {
            Form::Echo => last as u128 + 1,
            Form::Period | Form::Piecewise => terms_of_piece(recurrence, last),
        };
        refuse_terms(match orders {
            Orders::Only(_) => one.saturating_mul(parts.max(1) as u128),
            Orders::Through(..) => terms_through(one, last, parts),
        })
    }

    /// Refuses echoes with names for rates after one with more than so many terms.
    fn long_echoes(
        &self,
        recurrence: &Recurrence,
        waves: &[WaveIndex],
        last: usize,
        most: usize,
    ) -> Result<(), ProblemError> {
        let Some((place, together, rates)) = self.named_rates() else { return Ok(()) };
        match first_long_echo(recurrence, waves, last, most)? {
            Some((n, terms)) => {
                Err(ProblemError::LongEchoes { place, waves: together, rates, n, terms })
            }
            None => Ok(()),
        }
    }

    /// The network, where waves return at times without a common measure.
    fn lattice(&self) -> Option<&Network> {
        self.network().ok().filter(|_| self.on_lattice())
    }

    /// The echoes of a lattice through this order, or through the last one before echoes are too many or get long: through which
    /// one, and what tells that they get long.
    pub(super) fn few_arrivals(
        &self,
        network: &Network,
        waves: &[WaveIndex],
        mut through: usize,
        most: usize,
    ) -> (usize, Result<Vec<Arrival>, ProblemError>, Option<ProblemError>) {
        let mut stopped = None;
        loop {
            let most = if through == 0 { most.max(MAX_NAMED_TERMS) } else { most };
            match self.short_arrivals(network, waves, through, most) {
                Err(long @ ProblemError::LongEchoes { n, .. }) if through > 0 => {
                    through = n.min(through).saturating_sub(1);
                    stopped = Some(long);
                }
                Err(ProblemError::TooManyEchoes { .. }) if through > 0 => through -= 1,
                found => return (through, found, stopped),
            }
        }
    }

    /// The echoes of a lattice, refused where they are too many, or where rates have names and one has more than so many terms.
    fn short_arrivals(
        &self,
        network: &Network,
        waves: &[WaveIndex],
        through: usize,
        most: usize,
    ) -> Result<Vec<Arrival>, ProblemError> {
        refuse_echoes(network, waves.len(), through)?;
        let LongEcho { passed: n, terms } = match arrivals(network, waves, through, most)? {
            Ok(found) => return Ok(found),
            Err(long) => long,
        };
        let unfolded = network.unfold(&vec![1; network.lattice().periods().len()])?;
        let (place, waves, rates) =
            named_rates_of(network, unfolded.recurrence()).unwrap_or_default();
        Err(ProblemError::LongEchoes { place, waves, rates, n, terms })
    }

    fn refuse_lattice(&self, what: Missing) -> Result<(), ProblemError> {
        if self.on_lattice() { Err(ProblemError::NoCommonMeasure(what)) } else { Ok(()) }
    }

    fn refuse_quadratic(&self, name: &str) -> Result<(), ProblemError> {
        let name = language::normalise_name(name);
        let is_energy = |observed: &Observed| {
            observed.name == name && matches!(observed.value, ObservedValue::Energy(_))
        };
        match &self.kind {
            Kind::Equations(solution) if solution.recurrence().quadratic(&name).is_some() => {
                Err(ProblemError::ProductsHaveNoPieces(name))
            }
            Kind::Line { network, .. } if network.observables().iter().any(is_energy) => {
                Err(ProblemError::EnergyHasNoPieces(name))
            }
            _ => Ok(()),
        }
    }

    /// What is named, or all waves that are shown: those after them only serve what is observed.
    fn meant<'a>(
        &self,
        recurrence: &'a Recurrence,
        what: ToDerive<'_>,
    ) -> Result<Meant<'a>, ProblemError> {
        let ToDerive::Quantity(name) = what else {
            return Ok(Meant::Waves((0..self.waves().len()).collect()));
        };
        self.refuse_quadratic(name)?;
        let known = language::normalise_name(name);
        let wave = recurrence.wave(&known).map(|wave| Meant::Waves(vec![wave]));
        let found = wave.or_else(|| recurrence.observable(&known).map(Meant::Observable));
        found.ok_or_else(|| self.unknown(name))
    }

    /// The echoes of a scene whose travel times have no common measure, in order of arrival.
    fn by_arrival(
        &self,
        network: &Network,
        what: ToDerive<'_>,
        orders: Orders,
        form: Form,
    ) -> Result<Derived, ProblemError> {
        let waves: Vec<WaveIndex> = match what {
            ToDerive::Waves => (0..network.waves().len()).collect(),
            ToDerive::Quantity(name) => {
                self.refuse_quadratic(name)?;
                let known = language::normalise_name(name);
                match network.waves().iter().position(|wave| wave.name == known) {
                    Some(wave) => vec![wave],
                    None if self.observables().contains(&&*known) => {
                        return Err(ProblemError::NoCommonMeasure(Missing::Periods));
                    }
                    None => return Err(self.unknown(name)),
                }
            }
        };
        let Orders::Through(_, through) = orders else {
            return Err(ProblemError::NoCommonMeasure(Missing::Periods));
        };
        if form == Form::Piecewise {
            return Err(ProblemError::NoCommonMeasure(Missing::Pieces));
        }
        let found = self.short_arrivals(network, &waves, through, MAX_NAMED_TERMS)?;
        match found.is_empty() {
            true => Err(ProblemError::NothingArrives(through)),
            false => Ok(Derived::Arrivals(found)),
        }
    }
}

fn functions(
    solution: &Solution,
    wave: WaveIndex,
    orders: Orders,
    form: Form,
) -> Result<Functions, ProblemError> {
    let (first, last) = orders.ends();
    let expressions = match form {
        Form::Echo => solution.echoes(wave, last)?.echoes[first..].to_vec(),
        Form::Period | Form::Piecewise => solution.pieces(wave, first, last)?,
    };
    let name = solution.recurrence().statement().waves[wave].clone();
    Ok(Functions { name, first, offset: Fraction::zero(), expressions })
}

fn observed(
    solution: &Solution,
    observable: &Observable,
    orders: Orders,
) -> Result<Functions, ProblemError> {
    let (first, last) = orders.ends();
    let name = observable.name.clone();
    match solution.observed(&observable.observation, first, last) {
        Ok(found) => Ok(Functions { name, first, offset: found.offset, expressions: found.pieces }),
        Err(ObserveError::Solve(error)) => Err(error.into()),
        Err(ObserveError::MixedOffsets) => Err(ProblemError::NoCommonPeriods(name)),
    }
}

/// An observable whose waves arrive apart, from arrival to arrival.
fn between_arrivals(
    solution: &Solution,
    observable: &Observable,
    orders: Orders,
) -> Result<Derived, ProblemError> {
    let (first, last) = orders.ends();
    let name = observable.name.clone();
    match solution.observed_between_arrivals(&observable.observation, first, last) {
        Ok(stretches) => Ok(Derived::Stretches(name, stretches)),
        Err(ObserveError::Solve(error)) => Err(error.into()),
        Err(ObserveError::MixedOffsets) => Err(ProblemError::UnknownOrder(name)),
    }
}

fn formulas(
    statement: &crate::recurrence::Statement,
    functions: &Functions,
    form: Form,
) -> Vec<Formula> {
    let formula = |(i, expression): (usize, &Expression)| {
        let (wave, n, local) = (&functions.name, functions.first + i, &statement.local);
        let formula = match form {
            Form::Echo => Formula::echo(wave, &[n], expression, local),
            Form::Period | Form::Piecewise => Formula::piece(wave, n, expression, local),
        };
        // Periods that begin with those of the waves are said only where they are asked for.
        if form == Form::Piecewise || !functions.offset.is_zero() {
            formula.on_period(n, &functions.offset, statement)
        } else {
            formula
        }
    };
    functions.expressions.iter().enumerate().map(formula).collect()
}

/// Refuses waves where the text says nothing of its source, and observables without a unit of the source.
fn has_source_form(recurrence: &Recurrence, meant: &Meant<'_>) -> Result<(), ProblemError> {
    let notation = &recurrence.statement().notation;
    let known = match meant {
        Meant::Waves(_) => !notation.is_empty(),
        Meant::Observable(observable) => notation.observables.contains_key(&observable.name),
    };
    if known { Ok(()) } else { Err(ProblemError::NoSourceForm) }
}

/// What is meant as waves, of which solution, and when their periods begin.
struct AsWaves<'a> {
    solution: Cow<'a, Solution>,
    waves: Vec<WaveIndex>,
    offset: Fraction,
}

impl<'a> AsWaves<'a> {
    fn new(solution: &'a Solution, meant: Meant<'_>) -> Result<AsWaves<'a>, ProblemError> {
        let observable = match meant {
            Meant::Waves(waves) => {
                let (solution, offset) = (Cow::Borrowed(solution), Fraction::zero());
                return Ok(AsWaves { solution, waves, offset });
            }
            Meant::Observable(observable) => observable,
        };
        let found = solution.with_observable(observable);
        let (extended, offset) =
            found.ok_or_else(|| ProblemError::NoCommonPeriods(observable.name.clone()))?;
        let waves = vec![solution.recurrence().statement().waves.len()];
        Ok(AsWaves { solution: Cow::Owned(extended), waves, offset })
    }
}

fn source_form(all: &AsWaves<'_>, orders: Orders) -> Result<Vec<Formula>, ProblemError> {
    let AsWaves { solution, waves, offset } = all;
    let (first, last) = orders.ends();
    let ends = &solution.recurrence().statement().notation.ends;
    let by_ends = (!ends.is_empty()).then(|| solution.pieces_by_ends(last, ends)).transpose()?;
    let kept = by_ends.as_ref().map(|(_, kept)| kept);
    let form = SourceForm::new(solution.recurrence(), kept).beginning(offset);
    let mut formulas = Vec::new();
    for wave in waves {
        let pieces = match &by_ends {
            Some((pieces, _)) => pieces[*wave][first..].to_vec(),
            None => solution.pieces(*wave, first, last)?,
        };
        let piece = |(n, piece)| form.piece(*wave, n, piece);
        formulas.extend((first..).zip(&pieces).flat_map(piece));
    }
    Ok(formulas)
}

fn general(
    all: &AsWaves<'_>,
    wave: WaveIndex,
    symbols: Symbols,
) -> Result<GeneralFormulas, ProblemError> {
    let AsWaves { solution, offset, .. } = all;
    let recurrence = solution.recurrence();
    let name = &recurrence.statement().waves[wave];
    let form = solution.general(wave).map_err(|unknown: &Unknown| {
        let (derivative, delay) = export::operator_names(recurrence);
        ProblemError::NoGeneralForm {
            wave: name.clone(),
            operator: export::operator_of(recurrence, unknown),
            names: [derivative, delay],
            symbol: recurrence.symbols().next().cloned(),
        }
    })?;
    let formulas = match symbols {
        Symbols::Own => export::general_form_from(recurrence, wave, form, offset),
        Symbols::Source => {
            let source = SourceForm::new(recurrence, None).beginning(offset);
            source.general(wave, form)
        }
    };
    Ok(GeneralFormulas { name: name.clone(), offset: offset.clone(), formulas })
}
