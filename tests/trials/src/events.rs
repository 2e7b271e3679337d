//! The events of contacts, as followed and by the solver in doubles.

use crate::scene::Scene;
use crate::solver::{Happening, Solver};
use wavestep::history::{Event, EventKind, History, HistoryError};
use wavestep::network::Network;
use wavestep_polynomial::Rational;

/// How far instants and values may be off, in periods and in the unit of values.
pub const TOLERANCE: f64 = 1e-9;

/// How long cells are at most, in the time in which a node changes: two meshes.
pub const COARSE: f64 = 1.0;
const FINE: f64 = 0.6;

/// Events by the force alone, as solvers in doubles see them: a contact that touches without force before it separates has
/// opened when the force went.
pub fn by_force(events: &[Event]) -> Vec<(EventKind, &Event)> {
    let mut told = Vec::new();
    for (i, event) in events.iter().enumerate() {
        let same = |other: &&Event| other.contact == event.contact;
        let next = events[i + 1..].iter().find(same).map(|other| other.kind);
        let before = events[..i].iter().rfind(same).map(|other| other.kind);
        match event.kind {
            EventKind::Release if next == Some(EventKind::Opening) => {
                told.push((EventKind::Opening, event));
            }
            EventKind::Opening if before == Some(EventKind::Release) => {}
            kind => told.push((kind, event)),
        }
    }
    told
}

/// By contact, what two solvers say until an instant.
fn difference(one: &[Happening], other: &[Happening], until: f64, close: f64) -> Option<f64> {
    let contacts = one.iter().chain(other).map(|own| own.contact).max().map_or(0, |last| last + 1);
    let mut first: Option<f64> = None;
    for contact in 0..contacts {
        let own = |all: &[Happening]| -> Vec<Happening> {
            all.iter().filter(|own| own.contact == contact).copied().collect()
        };
        let (one, other) = (settled(&own(one)), settled(&own(other)));
        for at in 0..one.len().max(other.len()) {
            let differs = match (one.get(at), other.get(at)) {
                (Some(a), Some(b)) if is_alike([a, b], close) => continue,
                (Some(a), Some(b)) => a.time.min(b.time),
                (Some(a), None) | (None, Some(a)) if a.kind == EventKind::Release => break,
                (Some(a), None) | (None, Some(a)) => a.time,
                (None, None) => unreachable!("one is long enough"),
            };
            if differs < until {
                first = Some(first.map_or(differs, |first: f64| first.min(differs)));
            }
            break;
        }
    }
    first
}

/// Whether two tell of the same. A contact that touches without force has opened, by the force alone.
fn is_alike([one, other]: [&Happening; 2], close: f64) -> bool {
    let plain = |kind| if kind == EventKind::Release { EventKind::Opening } else { kind };
    plain(one.kind) == plain(other.kind) && (one.time - other.time).abs() < close
}

/// What one contact does; where it opens and closes again at one instant it has done nothing.
fn settled(all: &[Happening]) -> Vec<Happening> {
    let mut settled: Vec<Happening> = Vec::new();
    for own in all {
        let is_undone = |other: &mut Happening| {
            let closes = matches!(own.kind, EventKind::Closing | EventKind::Impact);
            other.kind == EventKind::Opening && closes && other.time == own.time
        };
        if settled.pop_if(is_undone).is_none() {
            settled.push(*own);
        }
    }
    settled
}

/// What the history tells. A release is told where nothing follows it: by the force alone it may be an opening.
/// What happens at the end is not told, nor of what follows from it.
fn told(scene: &Scene, history: &History, end: f64) -> Vec<Happening> {
    let second = scene.units.map_or(1.0, |units| units.per_second as f64);
    let before = history.events.partition_point(|own| own.time.to_f64() * second < end);
    let events = by_force(&history.events[..before]);
    let is_last =
        |at: usize| events[at + 1..].iter().all(|(_, own)| own.contact != events[at].1.contact);
    let told = events.iter().enumerate();
    let told = told.filter(|(at, (kind, _))| *kind != EventKind::Release || is_last(*at));
    told.map(|(_, (kind, event))| Happening {
        kind: *kind,
        contact: event.contact,
        time: event.time.to_f64() * second,
    })
    .collect()
}

/// How far the events of a scene agree.
pub enum Followed {
    /// The scene is refused, or there is no motion.
    Not(String),
    /// So many events agree, until a time; and whether doubles tell no more before the end.
    Until {
        events: usize,
        time: f64,
        untold: bool,
    },
    Wrong(String),
}

/// Follows a scene with both for some periods or events; the solver has not begun.
pub fn compare(
    (scene, network): (&Scene, &Network),
    solver: &mut Solver,
    (periods, most): (u32, usize),
) -> Followed {
    let no_motion = || Followed::Not("contacts change for ever".to_owned());
    let Some(mut second) = Solver::new(scene, FINE) else { return no_motion() };
    let period = 2.0 * scene.longest();
    let Some(until) = solver.follow(period * f64::from(periods), most) else { return no_motion() };
    let Some(near) = second.follow(until, usize::MAX) else { return no_motion() };
    let seconds = scene.units.map_or(1, |units| units.per_second);
    let end = Rational::new(((until * 1e9) as i64).into(), (1_000_000_000 * seconds).into());
    let last = near.min(until) - 1e-6;
    let history = match History::of(network, Some(&end), 12) {
        Ok(history) => told(scene, &history, last),
        Err(error @ HistoryError::Refused(_)) => return Followed::Not(error.to_string()),
        Err(error) => return Followed::Wrong(error.to_string()),
    };
    // Where two meshes differ, doubles do not tell.
    let close = TOLERANCE * period;
    let unsure = difference(&solver.happenings, &second.happenings, last, close / 10.0);
    let sure = unsure.unwrap_or(last);
    let doubt = solver.doubt.min(second.doubt).min(sure);
    let differs = difference(&solver.happenings, &history, sure, close);
    if let Some(time) = differs.filter(|time| *time < doubt) {
        let own = &solver.happenings;
        return Followed::Wrong(format!("events at {time}\n{own:?}\n{history:?}"));
    }
    let sure = differs.unwrap_or(sure);
    let events = history.iter().filter(|event| event.time < sure).count();
    let latest = history.iter().map(|event| event.time).fold(period, f64::max);
    Followed::Until { events, time: sure.min(latest + 2.0 * period), untold: sure < last }
}
