//! A scene in all ways, and by the solver in doubles.

use crate::chance::Chance;
use crate::compare::{At, BITS, Comparison, STIFF_BITS, about, is_near, reads_back};
use crate::events::{self, COARSE, Followed, TOLERANCE};
use crate::observe::Observed;
use crate::scene::{Element, Measure, Quotient, Scene};
use crate::solver::Solver;
use crate::{ENERGY, EVENTS, MOMENTUM, SOLVER, TEXT, Tally, Verdict};
use wavestep::problem::{Problem, Values};
use wavestep::signal::Limit;
use wavestep_polynomial::Rational;

/// How long scenes are followed whose contacts open: periods of the longest bar, or events.
#[derive(Clone, Copy)]
pub struct Length {
    pub periods: u32,
    pub events: usize,
}

pub const QUICK: Length = Length { periods: 6, events: 4 };

/// Two observables.
const NAMES: [&str; 2] = ["one", "other"];

/// How many changes of its fastest node a scene may see. With more it is stiff: no closed one is followed in doubles.
const MOST_CHANGES: f64 = 2e3;

/// How many travel times of its shortest bar a closed scene is looked at for, where it has others: echoes are expanded one
/// by one here.
const MOST_RETURNS: f64 = 24.0;

/// Compares a scene in all ways.
pub fn compare(scene: &Scene, chance: &mut Chance, length: Length) -> Verdict {
    let (mut tally, mut seen) = (Tally::default(), String::new());
    match compared(scene, chance, length, (&mut tally, &mut seen)) {
        Ok(None) => Verdict::Agrees(tally),
        Ok(Some(reason)) => Verdict::Senseless(reason),
        Err(wrong) => Verdict::Wrong(format!("{wrong}\n{seen}")),
    }
}

fn rational(Quotient(over, under): Quotient) -> Rational {
    Rational::new(over.into(), under.into())
}

/// Why the scene makes no sense, or else what differs.
fn compared(
    scene: &Scene,
    chance: &mut Chance,
    length: Length,
    (tally, observables): (&mut Tally, &mut String),
) -> Result<Option<String>, String> {
    let senseless = |reason: &str| Ok(Some(reason.to_owned()));
    let Some(mut solver) = Solver::new(scene, COARSE) else {
        return senseless("nothing resists something without mass");
    };
    let all = Observed::all(scene, &solver, chance);
    if all.is_empty() || scene.opens && scene.has_loose_spring() {
        return senseless("nothing is observed, or a spring is loose");
    }
    let seen = [(); 2].map(|()| all[chance.below(all.len())]);
    for (name, own) in NAMES.iter().zip(&seen) {
        *observables += &format!("observe {name} = {}\n", own.text(scene));
    }
    if scene.has_energy() {
        *observables += "observe stored = energy(line)\nobserve carried = momentum(line)\n";
        *observables += &spent(scene);
    }
    let text = scene.text() + observables;
    reads_back(&text, true)?;
    tally.compared[TEXT] += 1;
    let values: Values = (scene.symbols.iter().zip('a'..))
        .map(|((.., value), name)| (name.to_string(), rational(*value)))
        .collect();
    let problem = match Problem::of_text("random.wave", &text, &values) {
        Ok(problem) => problem,
        Err(error) => return senseless(error.to_string().lines().next().unwrap_or_default()),
    };
    let network = problem.network().map_err(|error| error.to_string())?;
    let until = match scene.opens {
        true => {
            let length = (length.periods, length.events);
            match events::compare((scene, network), &mut solver, length) {
                Followed::Not(reason) => return senseless(&reason),
                Followed::Wrong(wrong) => return Err(wrong),
                Followed::Until { events, time, untold } => {
                    tally.compared[EVENTS] += events;
                    tally.untold += usize::from(untold);
                    time
                }
            }
        }
        false => {
            let until = f64::from([1, 2, 2, 3, 3, 4, 6][chance.below(7)]) * scene.longest();
            until.min(MOST_RETURNS * scene.shortest())
        }
    };
    let is_stiff = solver.rate() * until >= MOST_CHANGES;
    let is_told = scene.opens || !is_stiff && solver.follow(until, usize::MAX).is_some();
    let times: Vec<f64> = (0..4).map(|_| until * (1 + chance.below(996)) as f64 / 997.0).collect();
    let bits = if is_stiff { STIFF_BITS } else { BITS };
    let mut comparison = Comparison { problem: &problem, bits, tally };
    let tolerance = [1e-3, 1e-9, 1e-13][chance.below(3)];
    let solver = is_told.then_some(&solver);
    for (name, own) in NAMES.iter().zip(&seen) {
        compare_values((scene, own, solver), &mut comparison, (name, &times), tolerance)?;
        if !scene.opens
            && let Ok(general) = problem.without_values()
        {
            let mut general = Comparison { problem: &general, bits, tally: comparison.tally };
            general.formulas(name, &problem)?;
        }
    }
    // What takes longest is not compared each time.
    if let (Some(solver), true) = (solver, scene.has_energy() && chance.is(3)) {
        compare_balance((scene, solver), &mut comparison, times[0])?;
    }
    Ok(None)
}

/// A time of the solver in that of the scene's user, and the nearest time of the solver.
fn user_time(scene: &Scene, time: f64) -> (Rational, f64) {
    use num_traits::ToPrimitive as _;
    let about = about(time);
    let own = about.to_f64().expect("a number");
    let seconds = scene.units.map_or(1, |units| units.per_second);
    (about / Rational::from_integer(seconds.into()), own)
}

fn compare_values(
    (scene, seen, solver): (&Scene, &Observed, Option<&Solver>),
    comparison: &mut Comparison<'_>,
    (name, times): (&str, &[f64]),
    tolerance: f64,
) -> Result<(), String> {
    let (mut at, own): (Vec<At>, Vec<f64>) = (times.iter())
        .map(|time| user_time(scene, *time))
        .map(|(time, own)| ((time, Limit::Right), own))
        .unzip();
    // Something arrives there, in most scenes.
    if !scene.opens {
        let arrival = scene.elements.iter().find_map(|element| match element {
            Element::Bar { travel: Some(travel), .. } if travel.root == 1 => Some(travel.quotient),
            _ => None,
        });
        let seconds = scene.units.map_or(1, |units| units.per_second);
        let arrival = arrival.map(|own| rational(own) / Rational::from_integer(seconds.into()));
        let sides = [Limit::Left, Limit::Right];
        at.extend(arrival.iter().flat_map(|time| sides.map(|side| (time.clone(), side))));
    }
    let digits = comparison.digits(name, &at)?;
    let last = times.iter().copied().fold(0.0, f64::max);
    let largest_wave = seen.size(scene, last) * seen.unit(scene);
    if name == NAMES[0] {
        comparison.doubles(name, (&at, &digits), (tolerance, largest_wave))?;
    }
    let Some(solver) = solver else { return Ok(()) };
    for (time, told) in own.iter().zip(&digits) {
        let Some(told) = told else { continue };
        // Next to an arrival doubles may be on the other side of it.
        let [before, double, after] =
            [-1e-9, 0.0, 1e-9].map(|step| seen.at(solver, scene, time + step));
        let close = TOLERANCE * seen.size(scene, *time) * (1.0 + double.abs());
        if (before - double).abs().max((after - double).abs()) > 1e3 * close {
            continue;
        }
        let near = is_near(told, seen.unit(scene), double, close);
        near.map_err(|wrong| format!("{} at {time}: {wrong}", seen.text(scene)))?;
        comparison.tally.compared[SOLVER] += 1;
    }
    Ok(())
}

/// The work of all elements on what is outside: what dampers have taken less what loads have given; nothing where a velocity is
/// imposed, which has no work of its own.
fn spent(scene: &Scene) -> String {
    let mut terms = String::new();
    for (element, own) in scene.elements.iter().enumerate() {
        match own {
            Element::Spring { .. } | Element::Support { .. } => {
                terms += &format!(" + work(e{element}) - energy(e{element})");
            }
            Element::Load(load) if load.is_imposed => return String::new(),
            Element::Load(_) => terms += &format!(" - work(e{element})"),
            Element::Bar { .. } | Element::Mass { .. } => {}
        }
    }
    match terms.strip_prefix(" + ").unwrap_or(&terms) {
        "" => String::new(),
        terms => format!("observe spent = {}\n", terms.trim_start()),
    }
}

/// Energy and momentum change by what the solver says comes from outside.
fn compare_balance(
    (scene, solver): (&Scene, &Solver),
    comparison: &mut Comparison<'_>,
    time: f64,
) -> Result<(), String> {
    let (user, time) = user_time(scene, time);
    let [impulse, work] = solver.given(time);
    for (name, measure, given, place) in [
        ("stored", Measure::Energy, work, ENERGY),
        ("carried", Measure::Momentum, impulse, MOMENTUM),
        ("spent", Measure::Energy, -work, ENERGY),
    ] {
        if comparison.problem.wanted(name).is_err() {
            continue;
        }
        let at = [(Rational::default(), Limit::Right), (user.clone(), Limit::Right)];
        let digits = comparison.digits(name, &at)?;
        let [Some(start), Some(told)] = &digits[..] else { continue };
        let unit = scene.unit(measure);
        let start = start.to_f64() / unit;
        let close = TOLERANCE * scene.largest() * (1.0 + start.abs() + given.abs()) * (1.0 + time);
        let near = is_near(told, unit, start + given, close);
        near.map_err(|wrong| format!("{name} at {time}: {wrong}"))?;
        comparison.tally.compared[place] += 1;
    }
    Ok(())
}
