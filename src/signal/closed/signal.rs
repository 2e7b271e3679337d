//! Waves and observables in closed form on a window of time.

use super::exact::ExactEchoes;
use super::form::ClosedForm;
use super::scene::SceneEchoes;
use super::stretch::Stretch;
use crate::ball::{Ball, Magnitude, Value};
use crate::expression::{Expression, Fraction, Root};
use crate::limits::MAX_PIECES;
use crate::network::{Network, Observed, ObservedValue};
use crate::recurrence::Observation;
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::signal::{
    At, EchoCount, Effort, Instant, Known, Limit, Point, Signal, in_unit, last_begun, later,
    zeros_of,
};
use crate::signal::silence::Silence;
use crate::signal::taylor::{Near, Taylor};
use crate::solution::Solution;
use num_traits::{Signed as _, Zero as _};
use std::borrow::Cow;
use std::cell::OnceCell;
use std::cmp::Ordering;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// The precision in bits with which echoes that are zero are left out.
const FIRST_BITS: u64 = 192;

/// The most bits that an exact value is looked for with.
const SIGN_BITS: u64 = 1 << 12;

/// Digits of what is only compared with a rational number.
const FEW_DIGITS: usize = 6;

/// The precision of the scale of time.
const SCALE_BITS: u64 = 64;

/// A wave or an observable in closed form, on a window of the user's time; every symbol has a value.
///
/// It is held twice: as a [`ClosedForm`], which is enclosed in balls, and as what is asked for exact values
/// where a ball cannot decide because the answer is zero. Either is made when it is first asked for.
pub struct ClosedSignal<'a> {
    source: Source<'a>,
    window: [Rational; 2],
    silence: Option<Rc<Silence>>,
    form: OnceCell<ClosedForm>,
    stretches: OnceCell<Vec<Stretch>>,
}

/// Where exact values come from.
enum Source<'a> {
    Recurrence {
        echoes: Box<ExactEchoes<'a>>,
        value: Observation,
        /// The scene whose scale of time the recurrence has, if it is not the user's.
        scene: Option<&'a Network>,
    },
    Scene {
        network: &'a Network,
        value: Box<Observation>,
        unit: Root,
        /// Those of its recurrence, where all that is observed has a closed form without units.
        exact: OnceCell<Option<Box<ExactEchoes<'static>>>>,
        /// Those until the end of the window.
        echoes: Rc<Shared<'a>>,
    },
}

/// Echoes that several signals of a scene may be seen in.
#[derive(Default)]
struct Shared<'a> {
    /// What the signals see, where they are several.
    seen: Vec<Observation>,
    made: OnceCell<SceneEchoes<'a>>,
}

impl<'a> ClosedSignal<'a> {
    /// A wave or observable of a recurrence.
    pub fn of_recurrence(
        solution: &'a Solution,
        observation: &Observation,
        window: [&Rational; 2],
    ) -> Outcome<Self> {
        let echoes = Box::new(ExactEchoes::new(Cow::Borrowed(solution))?);
        let value = observation.clone();
        ClosedSignal::new(Source::Recurrence { echoes, value, scene: None }, window)
    }

    /// An observable of a scene whose contacts stay closed.
    pub fn of_scene(
        network: &'a Network,
        observed: &Observed,
        window: [&Rational; 2],
    ) -> Outcome<Self> {
        let ObservedValue::Linear(value) = &observed.value else {
            return Err(EvaluateError::NotLinear);
        };
        let (value, unit) = (Box::new(value.clone()), observed.unit.clone());
        let (exact, echoes) = (OnceCell::new(), Rc::default());
        let source = Source::Scene { network, value, unit, exact, echoes };
        let silence = Silence::of(network, observed).map(Rc::new);
        Ok(ClosedSignal { silence, ..ClosedSignal::new(source, window)? })
    }

    /// Several observations of a scene in its own scale, on windows with one end: waves are solved and
    /// echoes worked out once for all of them.
    pub(crate) fn several(
        network: &'a Network,
        observed: &[(&Observation, [&Rational; 2])],
        until: &Rational,
    ) -> Outcome<Vec<Self>> {
        let seen: Vec<Observation> = observed.iter().map(|(of, _)| (*of).clone()).collect();
        let waves = seen.iter().flat_map(|of| of.waves.iter().cloned()).collect();
        let all = Observation { waves, forcing: Expression::zero() };
        let unit = Root::from(Fraction::one());
        let form = ClosedForm::of_scene(network, &all, unit.clone(), until)?;
        let echoes = Rc::new(Shared { seen, made: OnceCell::new() });
        let signal = |(of, window): &(&Observation, [&Rational; 2])| {
            let (value, unit) = (Box::new((*of).clone()), unit.clone());
            let (exact, echoes) = (OnceCell::from(None), Rc::clone(&echoes));
            let source = Source::Scene { network, value, unit, exact, echoes };
            let form = OnceCell::from(form.part(of));
            Ok(ClosedSignal { form, ..ClosedSignal::new(source, *window)? })
        };
        observed.iter().map(signal).collect()
    }

    /// A function of time in the scale of a scene, from the start on.
    pub(crate) fn of_course(
        network: &'a Network,
        course: &Expression,
        window: [&Rational; 2],
    ) -> Outcome<Self> {
        let recurrence = network.without_waves()?;
        let value = Observation { waves: Vec::new(), forcing: course.clone() };
        let form = ClosedForm::of_course(network, &recurrence, &value)?;
        let solution = Solution::new(recurrence);
        let echoes = Box::new(ExactEchoes::new(Cow::Owned(solution))?);
        let source = Source::Recurrence { echoes, value, scene: Some(network) };
        let signal = ClosedSignal::new(source, window)?;
        Ok(ClosedSignal { form: OnceCell::from(form), ..signal })
    }

    fn new(source: Source<'a>, [from, to]: [&Rational; 2]) -> Outcome<Self> {
        if to < from {
            return Err(EvaluateError::EmptyWindow);
        }
        let window = [from.clone(), to.clone()];
        let (form, stretches) = (OnceCell::new(), OnceCell::new());
        Ok(ClosedSignal { source, window, silence: None, form, stretches })
    }

    /// The same, with exact values from single echoes alone, of which [`Signal::echoes`] tells.
    #[must_use]
    pub fn echo_by_echo(mut self) -> Self {
        if let Source::Scene { exact, .. } = &mut self.source {
            *exact = OnceCell::from(None);
        }
        self
    }

    /// The closed form in balls.
    pub fn form(&self) -> Outcome<&ClosedForm> {
        if let Some(form) = self.form.get() {
            return Ok(form);
        }
        let form = match &self.source {
            Source::Recurrence { echoes, value, .. } => {
                ClosedForm::of_recurrence(echoes.recurrence(), value)?
            }
            Source::Scene { network, value, unit, .. } => {
                ClosedForm::of_scene(network, value, unit.clone(), &self.window[1])?
            }
        };
        Ok(self.form.get_or_init(|| form))
    }

    /// A limit at a time, from the pieces of its period; before the start all is zero.
    fn enclosed(&self, at: &Rational, side: Limit) -> Outcome<Point<'_>> {
        if at.is_negative() || at.is_zero() && side == Limit::Left {
            return Ok(Point::exact(Rational::default()));
        }
        let form = self.form()?;
        let stretches = form.stretches(&Rational::default(), at)?;
        let at = form.slowness.scale(at);
        let begins = |stretch: usize| form.numbers.compare(&stretches[stretch].from, &at);
        let stretch = stretches[last_begun(stretches.len(), side, begins)?].clone();
        let enclose = move |bits| form.enclose(&stretch, 0, &at, bits);
        let negligible = Magnitude::power_of_two(-(SCALE_BITS as i64));
        Ok(Point { known: Known::Unknown, negligible, ..Point::irrational(enclose) })
    }

    fn has_no_forcing(&self) -> bool {
        self.known_form().observation.forcing.is_zero()
    }

    /// Whether echoes are left out, so that stretches tell nothing exact.
    fn is_cut(&self) -> bool {
        self.form.get().is_some_and(|form| form.kept.is_some())
    }

    fn known_form(&self) -> &ClosedForm {
        self.form.get().expect("stretches were counted before they are asked for")
    }

    fn stretch(&self, stretch: usize) -> &Stretch {
        &self.stretches.get().expect("stretches were counted before they are asked for")[stretch]
    }

    /// A time in the scale of the waves.
    fn scaled<'s>(&'s self, stretch: usize, at: At<'s>) -> Cow<'s, Fraction> {
        match at {
            At::Time(time) => Cow::Owned(self.scaled_time(time)),
            At::Scaled(time) => Cow::Borrowed(time),
            At::End(Limit::Right) => Cow::Borrowed(&self.stretch(stretch).from),
            At::End(Limit::Left) => Cow::Borrowed(&self.stretch(stretch).to),
        }
    }

    /// The value at a time in the scale of the waves, where it is rational.
    fn exact_value(&self, at: &Fraction, side: Limit) -> Outcome<Option<Rational>> {
        let digits = |point: Point<'_>| point.value(FEW_DIGITS, SIGN_BITS);
        let value = match &self.source {
            Source::Recurrence { echoes, value, .. } => match at.as_constant() {
                Some(at) => echoes.point(value, &at, side).and_then(digits),
                None => return Ok(None),
            },
            Source::Scene { network, value, unit, exact, echoes } => {
                match (exact_form(network, value, unit, exact)?, at.as_constant()) {
                    (Some(echoes), Some(at)) => echoes.point(value, &at, side).and_then(digits),
                    _ => {
                        let known = self.scene_echoes(network, echoes).ok();
                        let told =
                            known.map(|known| known.point(value, unit, at, side).and_then(digits));
                        match told {
                            Some(told @ Ok(Value::Exact(_))) => told,
                            // With the echoes until then alone, exact arithmetic may be within reach.
                            _ => SceneEchoes::new(network, at)
                                .and_then(|echoes| digits(echoes.point(value, unit, at, side)?)),
                        }
                    }
                }
            }
        };
        match value {
            Ok(Value::Exact(value)) => Ok(Some(value)),
            Ok(Value::Certified { .. } | Value::Enclosed(_))
            | Err(
                EvaluateError::TooManyPeriods { .. }
                | EvaluateError::TooManyEchoes { .. }
                | EvaluateError::MissingValue(_)
                | EvaluateError::Solve(_)
                | EvaluateError::Network(_),
            ) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// The echoes of a scene until the end of the window.
    fn scene_echoes<'s>(
        &self,
        network: &'a Network,
        Shared { seen, made }: &'s Shared<'a>,
    ) -> Outcome<&'s SceneEchoes<'a>> {
        if let Some(known) = made.get() {
            return Ok(known);
        }
        let echoes = SceneEchoes::new(network, &network.scaled_time(&self.window[1]))?;
        for observation in seen {
            echoes.want_until_last(observation)?;
        }
        Ok(made.get_or_init(|| echoes))
    }

    /// Whether the derivative in the limit at an end is known to be exactly zero, of an observable of a recurrence that sees
    /// no derivatives and no function of time itself.
    fn slope_is_zero(&self, stretch: usize, end: Limit) -> bool {
        let Source::Recurrence { echoes, value, .. } = &self.source else { return false };
        let at = self.scaled(stretch, At::End(end));
        let Some((slope, at)) = slope_of(value).zip(at.as_constant()) else { return false };
        let zero = Known::Rational(Rational::default());
        echoes.point(&slope, &at, end).is_ok_and(|point| point.known == zero)
    }
}

/// The echoes of a scene in which those of all that is observed have a closed form, without units and
/// named constants: then any of them is had without those before.
fn exact_form<'s>(
    network: &Network,
    value: &Observation,
    unit: &Root,
    known: &'s OnceCell<Option<Box<ExactEchoes<'static>>>>,
) -> Outcome<Option<&'s ExactEchoes<'static>>> {
    if known.get().is_none() {
        let _ = known.set(made_exact(network, value, unit)?);
    }
    Ok(known.get().and_then(Option::as_deref))
}

fn made_exact(
    network: &Network,
    value: &Observation,
    unit: &Root,
) -> Outcome<Option<Box<ExactEchoes<'static>>>> {
    let has_scale = network.scene().dimensional
        || *unit != Root::from(Fraction::one())
        || network.model().slowness != Fraction::one();
    if has_scale || network.lattice().periods().len() > 1 {
        return Ok(None);
    }
    let recurrence = network.recurrence()?;
    let period = recurrence.statement().period.as_constant();
    if recurrence.symbols().next().is_some()
        || !recurrence.constants().is_empty()
        || period.is_none()
    {
        return Ok(None);
    }
    let solution = Solution::new(recurrence);
    match value.waves.iter().all(|seen| solution.general(seen.wave).is_ok()) {
        true => Ok(Some(Box::new(ExactEchoes::new(Cow::Owned(solution))?))),
        false => Ok(None),
    }
}

impl Signal for ClosedSignal<'_> {
    fn window(&self) -> [&Rational; 2] {
        self.window.each_ref()
    }

    fn point(&self, at: &Rational, side: Limit) -> Outcome<Point<'_>> {
        let now = self.scaled_time(at);
        if self.silence.as_ref().is_some_and(|silence| silence.holds([(&now, side); 2])) {
            return Ok(Point::exact(Rational::default()));
        }
        if self.is_cut() {
            return self.enclosed(at, side);
        }
        match &self.source {
            Source::Recurrence { scene: Some(_), .. } => self.enclosed(at, side),
            Source::Recurrence { echoes, value, .. } => match echoes.point(value, at, side) {
                // Pieces in balls may go further.
                Err(EvaluateError::TooManyPeriods { periods, limit }) => {
                    match periods <= MAX_PIECES.into() {
                        true => self.enclosed(at, side),
                        false => {
                            let limit = limit.max(MAX_PIECES);
                            Err(EvaluateError::TooManyPeriods { periods, limit })
                        }
                    }
                }
                told => told,
            },
            Source::Scene { network, value, unit, exact, echoes } => {
                match exact_form(network, value, unit, exact)? {
                    Some(echoes) => echoes.point(value, at, side),
                    None => {
                        let echoes = self.scene_echoes(network, echoes)?;
                        echoes.point(value, unit, &now, side)
                    }
                }
            }
        }
    }

    fn closed_form(&self) -> Outcome<&ClosedForm> {
        self.form()
    }

    fn echoes(&self) -> Option<EchoCount> {
        if let Some(kept) = self.form.get().and_then(|form| form.kept.as_ref()) {
            let (expanded, needed) = (kept.expanded.get(), kept.demand.count());
            return Some(EchoCount { expanded, arriving: kept.arriving, needed });
        }
        let Source::Scene { network, echoes, .. } = &self.source else { return None };
        match echoes.seen.is_empty() {
            true => echoes.made.get()?.work(),
            // What several signals share is not made until it is asked for.
            false => self.scene_echoes(network, echoes).ok()?.work(),
        }
    }

    fn within<'s>(&'s self, most: &Magnitude) -> Outcome<Option<Box<dyn Signal + 's>>> {
        let Source::Scene { network, value, unit, echoes, .. } = &self.source else {
            return Ok(None);
        };
        let Some(form) = self.form()?.within(most, &self.window[1])? else { return Ok(None) };
        let (value, unit, echoes) = (value.clone(), unit.clone(), Rc::clone(echoes));
        let exact = OnceCell::from(None);
        let source = Source::Scene { network, value, unit, exact, echoes };
        let [from, to] = self.window();
        let silence = self.silence.clone();
        let form = OnceCell::from(form);
        Ok(Some(Box::new(ClosedSignal { silence, form, ..ClosedSignal::new(source, [from, to])? })))
    }

    fn left_out(&self) -> Magnitude {
        self.form.get().map_or(Magnitude::ZERO, |form| form.left_out(0))
    }

    fn instant(&self, stretch: usize) -> Option<Instant> {
        let scene = match &self.source {
            Source::Scene { network, .. } | Source::Recurrence { scene: Some(network), .. } => {
                std::ptr::from_ref(*network).addr()
            }
            Source::Recurrence { echoes, .. } => std::ptr::from_ref(echoes.recurrence()).addr(),
        };
        Some(Instant { scene, event: None, delay: self.stretch(stretch).from.clone() })
    }

    fn exact_at(&self, stretch: usize, at: &Fraction, effort: Effort) -> Option<Expression> {
        if effort == Effort::Little || self.is_cut() {
            return None;
        }
        let since = &self.stretch(stretch).from;
        match &self.source {
            Source::Recurrence { echoes, value, .. } => {
                echoes.exact_since(value, &since.as_constant()?, at)
            }
            Source::Scene { network, value, unit, echoes, .. } => {
                let echoes = self.scene_echoes(network, echoes).ok()?;
                in_unit(echoes.exact_since(value, since, at)?, unit)
            }
        }
    }

    fn count(&self) -> Outcome<usize> {
        if let Some(stretches) = self.stretches.get() {
            return Ok(stretches.len());
        }
        let (form, [from, to]) = (self.form()?, &self.window);
        let stretches = form.audible(form.stretches(from, to)?, FIRST_BITS)?;
        Ok(self.stretches.get_or_init(|| stretches).len())
    }

    fn scaled_time(&self, time: &Rational) -> Fraction {
        match &self.source {
            Source::Scene { network, .. } | Source::Recurrence { scene: Some(network), .. } => {
                network.scaled_time(time)
            }
            Source::Recurrence { scene: None, .. } => Fraction::constant(time),
        }
    }

    fn begins(&self, stretch: usize, at: &Fraction) -> Outcome<Ordering> {
        Ok(self.known_form().numbers.compare(&self.stretch(stretch).from, at)?)
    }

    fn is_instant(&self, stretch: usize) -> bool {
        self.stretch(stretch).from == self.stretch(stretch).to
    }

    fn is_zero(&self, stretch: usize) -> bool {
        let stretch = self.stretch(stretch);
        let ends = [(&stretch.from, Limit::Right), (&stretch.to, Limit::Left)];
        if self.silence.as_ref().is_some_and(|silence| silence.holds(ends)) {
            return true;
        }
        stretch.is_silent() || (stretch.has_no_waves() && self.has_no_forcing() && !self.is_cut())
    }

    fn exact_time(&self, stretch: usize, end: Limit) -> Option<Rational> {
        let at = self.scaled(stretch, At::End(end));
        let slowness = &self.known_form().slowness;
        let own = self.window.iter().rev().find(|time| slowness.scale(time) == *at);
        own.cloned().or_else(|| Some(at.as_constant()? / slowness.as_constant()?))
    }

    fn time(&self, stretch: usize, end: Limit, bits: u64) -> Outcome<Ball> {
        let numbers = &self.known_form().numbers;
        let slowness = numbers.enclose(&self.known_form().slowness, bits)?;
        let inverse = slowness.reciprocal(bits).map_err(EvaluateError::Ball)?;
        let at = self.scaled(stretch, At::End(end));
        Ok(numbers.enclose(&at, bits)?.multiply(&inverse, bits))
    }

    fn enclose(&self, stretch: usize, order: usize, at: At<'_>, bits: u64) -> Outcome<Ball> {
        let at = self.scaled(stretch, at);
        self.known_form().enclose(self.stretch(stretch), order, &at, bits)
    }

    fn taylor(&self, stretch: usize, near: Near<'_>) -> Outcome<Taylor> {
        self.known_form().taylor(self.stretch(stretch), near)
    }

    fn taylor_of_sign(&self, stretch: usize, near: Near<'_>) -> Outcome<Taylor> {
        self.known_form().taylor_of_sign(self.stretch(stretch), near)
    }

    fn size(
        &self,
        stretch: usize,
        order: usize,
        at: &Rational,
        bits: u64,
    ) -> Outcome<(Magnitude, Magnitude)> {
        let (size, error) = self.known_form().size(self.stretch(stretch), order, at, bits)?;
        let slowness =
            self.known_form().numbers.enclose(&self.known_form().slowness, SCALE_BITS)?;
        let slowness = slowness.magnitude();
        let scaled =
            |value| (0..order).fold(value, |value: Magnitude, _| value.multiply(&slowness));
        Ok((scaled(size), scaled(error)))
    }

    fn exact(&self, stretch: usize, at: At<'_>) -> Outcome<Option<Rational>> {
        if self.is_zero(stretch) {
            return Ok(Some(Rational::default()));
        }
        let side = match at {
            At::Time(_) | At::Scaled(_) => Limit::Right,
            At::End(side) => side,
        };
        self.exact_value(&self.scaled(stretch, at), side)
    }

    /// By the exact function of the stretch, where that is known; else by the value, and the slope of a recurrence.
    fn flatness(&self, stretch: usize, end: Limit, order: usize) -> Outcome<usize> {
        let flat = || usize::from(self.slope_is_zero(stretch, end));
        let least = match order {
            0 if self.exact(stretch, At::End(end))? == Some(Rational::default()) => 1 + flat(),
            1 => flat(),
            _ => 0,
        };
        let later = later();
        let at = &*self.scaled(stretch, At::End(end)) + &Fraction::symbol(&later);
        let Some(own) = self.exact_at(stretch, &at, Effort::Much) else { return Ok(least) };
        Ok(zeros_of(own, &later, &Fraction::zero(), order)?.max(least))
    }
}

/// The observable's derivative between arrivals.
fn slope_of(value: &Observation) -> Option<Observation> {
    if !value.forcing.is_zero() || value.waves.iter().any(|seen| seen.slope) {
        return None;
    }
    let mut slope = value.clone();
    slope.waves.iter_mut().for_each(|seen| seen.slope = true);
    Some(slope)
}
