//! The scene of a section, derived from its parts, with the names of the source for what is in it.

use crate::book::entry::Setting;
use crate::book::refusal::Refusal;
use num_traits::ToPrimitive as _;
use std::cell::RefCell;
use std::collections::BTreeMap;
use wavestep::expression::{Expression, Fraction};
use wavestep::language::syntax::Expression as Tree;
use wavestep::language::{Diagnostic, Source, read_recurrence, read_scene};
use wavestep::network::Network;
use wavestep::recurrence::{
    LinearForm, Observation, Recurrence, SourceNotation, Statement, WaveIndex,
};
use wavestep::scenes;
use wavestep::solution::{PeriodByPeriod, Solution};
use wavestep_polynomial::{Rational, Symbol};

/// By how many periods forms in waves are delayed, so that `w[n+1]` has a lag that is no less than 0.
pub(super) const AHEAD: usize = 2;

/// Scenes that only sections of the book need.
const OWN_SCENES: [(&str, &str); 2] = [
    ("equal-bars", include_str!("sections/equal-bars.wave")),
    ("local-contact", include_str!("sections/local-contact.wave")),
];

/// What the source calls a wave or an observable, in the waves of the scene.
#[derive(Clone, Debug)]
pub(super) struct Quantity {
    /// The form in the waves of the scene, late by [`AHEAD`] periods, in the source's unit.
    pub(super) form: LinearForm,
    /// How fast the scene's time runs in the source's variable of this quantity: a prime is this times
    /// the derivative by the scene's time.
    pub(super) rate: Expression,
}

/// The scene of a section of the book: the recurrence that the network of its parts gives, and what
/// the source calls the waves in it. Nothing in it is taken from the source's derivation.
pub struct Stage {
    solution: Solution,
    quantities: BTreeMap<String, Quantity>,
    definitions: BTreeMap<String, Tree>,
    values: BTreeMap<String, Rational>,
    pieces: RefCell<BTreeMap<WaveIndex, Vec<Expression>>>,
}

fn text_of(scene: &str) -> Option<&'static str> {
    let own = OWN_SCENES.iter().find(|(name, _)| *name == scene).map(|(_, text)| *text);
    own.or_else(|| scenes::find(scene).map(|found| found.text))
}

/// The recurrence that the parts of a scene give, with the observables named, and values in place of
/// symbols from the start.
pub(super) fn derived(
    name: &str,
    observables: &[&str],
    values: &BTreeMap<String, Rational>,
) -> Result<Recurrence, Refusal> {
    let text = text_of(name).ok_or_else(|| Refusal::UnknownName(name.to_owned()))?;
    let source = Source::new(name, text)?;
    let scene = read_scene(&source, values);
    let first = |errors: Vec<Diagnostic>| errors.into_iter().next().expect("at least one");
    let mut scene = scene.map_err(first)?;
    // Energies would add waves of their own.
    scene.observables.retain(|seen| observables.contains(&seen.name.as_str()));
    let network = Network::new(&scene)?;
    network.recurrence().map_err(|_| Refusal::NoPeriods(name.to_owned()))
}

/// The notation of a stated recurrence for the waves, not the observables, of one that is derived.
fn notation(
    like: &str,
    waves: &[(String, String)],
    own: &Recurrence,
) -> Result<SourceNotation, Refusal> {
    let text = text_of(like).ok_or_else(|| Refusal::UnknownName(like.to_owned()))?;
    let stated = read_recurrence(&Source::new(like, text)?, &BTreeMap::new())?;
    let unknown = |name: &String| Refusal::UnknownName(name.clone());
    let mut map = BTreeMap::new();
    for (here, there) in waves {
        let here_index = own.wave(here).ok_or_else(|| unknown(here))?;
        map.insert(stated.wave(there).ok_or_else(|| unknown(there))?, here_index);
    }
    let (from, to) = (stated.statement(), own.statement());
    let symbol = |symbol: &Symbol| match *symbol == from.local {
        true => to.local.clone(),
        false => symbol.clone(),
    };
    let notation = &from.notation;
    let moved = |wave: &WaveIndex| map.get(wave).copied();
    Ok(SourceNotation {
        observables: BTreeMap::new(),
        units: (notation.units.iter())
            .filter_map(|(wave, unit)| Some((moved(wave)?, unit.clone())))
            .collect(),
        waves: (notation.waves.iter())
            .filter_map(|(wave, name)| Some((moved(wave)?, name.clone())))
            .collect(),
        symbols: notation.symbols.iter().map(|(own, as_)| (symbol(own), as_.clone())).collect(),
        constants: (notation.constants.iter())
            .filter_map(|(wave, name)| Some((moved(wave)?, name.clone())))
            .collect(),
        ends: notation.ends.iter().filter_map(moved).collect(),
    })
}

impl Stage {
    /// The scene of a setting, derived; its quantities are not yet understood.
    pub(super) fn derived(setting: &Setting) -> Result<Stage, Refusal> {
        let observed: Vec<&str> = setting.observed.iter().map(String::as_str).collect();
        let mut recurrence = derived(&setting.scene, &observed, &BTreeMap::new())?;
        if let Some((like, waves)) = &setting.like {
            let notation = notation(like, waves, &recurrence)?;
            let statement = Statement { notation, ..recurrence.statement().clone() };
            recurrence = Recurrence::new(statement)?;
        }
        Ok(Stage {
            solution: Solution::new(recurrence),
            quantities: BTreeMap::new(),
            definitions: setting.definitions.iter().cloned().collect(),
            values: setting.values.iter().cloned().collect(),
            pieces: RefCell::default(),
        })
    }

    pub(super) fn call(&mut self, name: &str, quantity: Quantity) {
        self.quantities.insert(name.to_owned(), quantity);
    }

    /// The recurrence that was derived from the scene, with its solution.
    pub fn solution(&self) -> &Solution {
        &self.solution
    }

    pub(super) fn local(&self) -> &Symbol {
        &self.solution.recurrence().statement().local
    }

    pub(super) fn definition(&self, name: &str) -> Option<&Tree> {
        self.definitions.get(name)
    }

    pub(super) fn values(&self) -> &BTreeMap<String, Rational> {
        &self.values
    }

    pub(super) fn quantity(&self, name: &str) -> Result<&Quantity, Refusal> {
        self.quantities.get(name).ok_or_else(|| Refusal::UnknownName(name.to_owned()))
    }

    /// The wave of the scene that is the quantity, and its unit, where it is one wave.
    pub(super) fn wave_of(&self, quantity: &Quantity) -> Option<(WaveIndex, Expression)> {
        let mut operators = quantity.form.operators();
        let (wave, operator) = operators.next()?;
        let alone = operators.next().is_none() && operator.slope.is_empty();
        let unit = operator.value.get(AHEAD)?;
        let here = operator.value.iter().count() == 1;
        (alone && here).then(|| (wave, unit.clone()))
    }

    /// The form of a wave or observable of the scene, late by [`AHEAD`] periods: an observable on
    /// periods of its own.
    pub(super) fn form_of_scene(&self, name: &str) -> Result<Option<LinearForm>, Refusal> {
        let recurrence = self.solution.recurrence();
        if let Some(wave) = recurrence.wave(name) {
            return Ok(Some(LinearForm::wave(wave, AHEAD)));
        }
        let Some(Observation { waves, forcing }) = recurrence.observation(name) else {
            return Ok(None);
        };
        let mut form = LinearForm::zero();
        form.add_scaled(&LinearForm::forcing(forcing), &Expression::one(), AHEAD);
        let period = Expression::from(recurrence.statement().period.clone());
        let offset = waves.iter().find(|seen| !seen.coefficient.is_zero());
        let offset = offset.map_or_else(Fraction::zero, |seen| seen.delay.clone());
        for seen in &waves {
            let apart = Expression::from(&seen.delay - &offset);
            let lag =
                if apart.is_zero() { Some(Rational::default()) } else { apart.proportion(&period) };
            let lag = lag.filter(Rational::is_integer).and_then(|lag| lag.to_integer().to_i64());
            let delay = lag.and_then(|lag| usize::try_from(lag + AHEAD as i64).ok());
            let delay = delay.ok_or_else(|| Refusal::NoPeriods(name.to_owned()))?;
            let of = if seen.slope { LinearForm::slope } else { LinearForm::wave };
            form.add_scaled(&of(seen.wave, 0), &seen.coefficient, delay);
        }
        Ok(Some(form))
    }

    pub(super) fn slope(&self, form: &LinearForm) -> Result<LinearForm, Refusal> {
        let plain = |(_, operator): (WaveIndex, &wavestep::recurrence::Operator)| {
            operator.slope.is_empty() && operator.sum.is_empty()
        };
        match form.operators().all(plain) {
            true => Ok(form.derivative(&self.solution.recurrence().statement().time)),
            false => Err(Refusal::NotLinear),
        }
    }

    /// A piece of a wave, derived period by period.
    fn piece(&self, wave: WaveIndex, n: usize) -> Result<Expression, Refusal> {
        let mut pieces = self.pieces.borrow_mut();
        if pieces.get(&wave).is_none_or(|known| known.len() <= n) {
            let mut solver = PeriodByPeriod::new(self.solution.recurrence());
            for _ in 0..=n {
                solver.advance()?;
            }
            for (wave, known) in solver.pieces().iter().enumerate() {
                pieces.insert(wave, known.clone());
            }
        }
        Ok(pieces[&wave][n].clone())
    }

    /// A form that is late by [`AHEAD`] periods, on the n-th period.
    pub(super) fn on_period(&self, form: &LinearForm, n: usize) -> Result<Expression, Refusal> {
        let statement = self.solution.recurrence().statement();
        let n = n + AHEAD;
        let mut value = Expression::zero();
        for (wave, operator) in form.operators() {
            for (lag, factor) in operator.value.up_to(n) {
                value += &(factor * &self.piece(wave, n - lag)?);
            }
            for (lag, factor) in operator.slope.up_to(n) {
                let slope = self.piece(wave, n - lag)?.derivative(&statement.local);
                value += &(factor * &slope);
            }
            for (lag, factor) in operator.sum.up_to(n) {
                for earlier in 0..n - lag {
                    value += &(factor * &self.piece(wave, earlier)?);
                }
            }
        }
        for (lag, function) in form.forcing_terms().up_to(n) {
            // The function of t − lag D at t = n D + s.
            let since = statement.period.scale(&Rational::from_integer((n - lag).into()));
            let time = &Fraction::symbol(&statement.local) + &since;
            let value_now = function.substitute(&statement.time, &time);
            value += &value_now.map_err(|_| Refusal::NotInvertible)?;
        }
        Ok(value)
    }
}
