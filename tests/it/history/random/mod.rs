//! Random scenes of five elements or fewer, whose contacts open, against a solver in plain doubles that shares nothing
//! with what is tested. `WAVESTEP_SCENES=500 cargo test random_scenes -- --nocapture` follows that many and says
//! how it goes; `WAVESTEP_FIRST=1200` beside it begins with the draw of that number.

mod curve;
mod node;
mod scene;
mod solver;

use crate::history::{rational, values};
use scene::{Element, End, Load, Quotient, Scene};
use solver::{Happening, Solver};
use std::time::Instant;
use wavestep::history::{EventKind, History, HistoryError};
use wavestep::language::{Source, read_scene};
use wavestep::network::Network;
use wavestep::signal::Limit;

/// How many scenes are followed where nobody says, and how many events of each.
const SCENES: (u64, usize) = (16, 8);

/// How many events of each where somebody does.
const MANY: usize = 25;

/// Round trips of the longest bar.
const PERIODS: i64 = 30;

/// How far instants and values may be off, in periods and in the unit of values.
const TOLERANCE: f64 = 1e-9;

/// How long cells are at most, in the time in which a node changes: two meshes.
const COARSE: f64 = 1.0;
const FINE: f64 = 0.6;

/// Numbers without an end (splitmix64).
struct Chance(u64);

impl Chance {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) % count as u64) as usize
    }

    fn is(&mut self, one_in: usize) -> bool {
        self.below(one_in) == 0
    }

    fn one_of(&mut self, all: &[(i64, i64)]) -> Quotient {
        let (over, under) = all[self.below(all.len())];
        Quotient(over, under)
    }

    /// A positive number.
    fn size(&mut self) -> Quotient {
        self.one_of(&[
            (1, 1),
            (2, 1),
            (1, 2),
            (3, 2),
            (3, 1),
            (2, 3),
            (5, 4),
            (7, 5),
            (1, 3),
            (4, 1),
        ])
    }

    /// The velocity of an element; those at the left come, those at the right stand still or come too.
    fn velocity(&mut self, is_left: bool) -> Quotient {
        match is_left {
            true => self.one_of(&[(1, 1), (1, 1), (2, 3), (0, 1), (5, 7)]),
            false => self.one_of(&[(0, 1), (0, 1), (-1, 2), (-1, 1), (1, 3)]),
        }
    }

    fn load(&mut self) -> Load {
        let until = self.is(2).then(|| self.one_of(&[(5, 2), (4, 1), (17, 3), (20, 1)]));
        let is_short = self.is(2);
        let none = Quotient(0, 1);
        let strength = self.one_of(&[(1, 4), (-1, 4), (1, 10), (1, 2), (-1, 3)]);
        Load {
            constant: strength,
            slope: if is_short { self.one_of(&[(1, 2), (-1, 2), (0, 1)]) } else { none },
            rate: if is_short { self.one_of(&[(1, 1), (1, 2), (2, 1)]) } else { none },
            from: self.one_of(&[(0, 1), (0, 1), (1, 2), (7, 3)]),
            until,
        }
    }

    fn element(&mut self, is_left: bool) -> Element {
        let none = Quotient(0, 1);
        let damping = |own: &mut Self| if own.is(3) { own.size() } else { none };
        match self.below(9) {
            0..4 => Element::Bar {
                impedance: self.size(),
                travel: Some(self.size()),
                velocity: self.velocity(is_left),
                strain: if self.is(6) { self.one_of(&[(1, 3), (-1, 2)]) } else { none },
            },
            4 | 5 => Element::Mass { mass: self.size(), velocity: self.velocity(is_left) },
            6 => Element::Spring { stiffness: self.size(), damping: damping(self) },
            7 => Element::Support { stiffness: self.size(), damping: damping(self) },
            _ => Element::Load(self.load()),
        }
    }

    /// A line that may make no sense.
    fn scene(&mut self) -> Scene {
        let count = 2 + self.below(4);
        let first = self.below(count + 1);
        let mut elements: Vec<Element> = (0..count).map(|at| self.element(at < first)).collect();
        let joints: Vec<bool> =
            (0..=count).map(|at| at == first || at > 0 && at < count && self.is(4)).collect();
        let mut end = |element: &mut Element, may_hold: bool| match element {
            Element::Bar { travel, .. } if self.is(6) => {
                *travel = None;
                End::Endless
            }
            _ if may_hold && self.is(2) => End::Fixed,
            _ => End::Free,
        };
        let (may_hold_left, may_hold_right) = (first == 0 || count > 3, true);
        let left = end(&mut elements[0], may_hold_left);
        let right = end(&mut elements[count - 1], may_hold_right);
        Scene { ends: [left, right], elements, joints }
    }
}

/// What became of a scene.
enum Verdict {
    /// It is no scene, or it is refused by name.
    Senseless,
    /// All events and values agree, so many of them.
    Agrees {
        events: usize,
        values: usize,
    },
    /// Events agree until doubles do not tell them.
    Untold {
        events: usize,
    },
    Wrong(String),
}

/// Something that is observed, and where it is seen.
#[derive(Clone, Copy)]
struct Observed {
    is_force: bool,
    element: usize,
    side: usize,
}

fn observed(scene: &Scene, solver: &Solver) -> Vec<Observed> {
    let mut all = Vec::new();
    for (element, own) in scene.elements.iter().enumerate() {
        let measures: &[bool] = match own {
            Element::Bar { .. } => &[false, true],
            Element::Mass { .. } => &[false],
            Element::Spring { .. } => &[true],
            _ => &[],
        };
        let sides = (0..2).filter(|side| solver.ends(element)[*side]);
        let seen = sides.flat_map(|side| {
            measures.iter().map(move |is_force| Observed { is_force: *is_force, element, side })
        });
        all.extend(seen);
    }
    all
}

impl Observed {
    fn text(&self, scene: &Scene) -> String {
        let measure = if self.is_force { "force" } else { "velocity" };
        let end = match scene.elements[self.element] {
            Element::Bar { .. } => [".left", ".right"][self.side],
            _ => "",
        };
        format!("observe seen = {measure}(e{}{end})\n", self.element)
    }

    fn at(&self, solver: &Solver, time: f64) -> f64 {
        match self.is_force {
            true => solver.force(self.element, self.side, time),
            false => solver.velocity(self.element, self.side, time),
        }
    }
}

/// The scene, where it makes sense; an observable is needed for that.
fn read(text: &str) -> Option<Network> {
    let source = Source::new("random.wave", text).unwrap();
    let scene = read_scene(&source, &Default::default()).ok()?;
    Network::new(&scene).ok()
}

/// By contact, what two solvers say until an instant.
fn difference(one: &[Happening], other: &[Happening], until: f64, close: f64) -> Option<f64> {
    let contacts = one.iter().chain(other).map(|own| own.contact).max().map_or(0, |last| last + 1);
    let mut first: Option<f64> = None;
    for contact in 0..contacts {
        let own = |all: &[Happening]| -> Vec<Happening> {
            all.iter().filter(|own| own.contact == contact).copied().collect()
        };
        let (one, other) = (own(one), own(other));
        for at in 0..one.len().max(other.len()) {
            let differs = match (one.get(at), other.get(at)) {
                (Some(a), Some(b)) if a.kind == b.kind && (a.time - b.time).abs() < close => {
                    continue;
                }
                (Some(a), Some(b)) => a.time.min(b.time),
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

fn told(history: &History) -> Vec<Happening> {
    let told = super::by_force(history).into_iter();
    told.filter(|(kind, _)| *kind != EventKind::Release)
        .map(|(kind, event)| Happening { kind, contact: event.contact, time: event.time.to_f64() })
        .collect()
}

/// Follows a scene until its thirtieth period or so many events, with both.
fn compare(scene: &Scene, chance: &mut Chance, most: usize) -> Verdict {
    let solvers = (Solver::new(scene, COARSE), Solver::new(scene, FINE));
    let (Some(mut solver), Some(mut second)) = solvers else { return Verdict::Senseless };
    let all = observed(scene, &solver);
    if all.is_empty() || scene.has_loose_spring() {
        return Verdict::Senseless;
    }
    let seen = all[chance.below(all.len())];
    let Some(network) = read(&(scene.text() + &seen.text(scene))) else {
        return Verdict::Senseless;
    };
    let period = 2.0 * scene.longest();
    let Some(until) = solver.follow(period * PERIODS as f64, most) else {
        return Verdict::Senseless;
    };
    let Some(near) = second.follow(until, usize::MAX) else { return Verdict::Senseless };
    let end = rational((until * 1e9) as i64, 1_000_000_000);
    let history = match History::of(&network, Some(&end), 12) {
        Ok(history) => told(&history),
        Err(HistoryError::Refused(_)) => return Verdict::Senseless,
        Err(error) => return Verdict::Wrong(error.to_string()),
    };
    // Where two meshes differ, doubles do not tell.
    let close = TOLERANCE * period;
    let end = near.min(until) - 1e-6;
    let unsure = difference(&solver.happenings, &second.happenings, end, close / 10.0);
    let sure = unsure.unwrap_or(end);
    let doubt = solver.doubt.min(second.doubt).min(sure);
    let differs = difference(&solver.happenings, &history, sure, close);
    if let Some(time) = differs.filter(|time| *time < doubt) {
        let own = &solver.happenings;
        return Verdict::Wrong(format!("events at {time}\n{own:?}\n{history:?}"));
    }
    let sure = differs.unwrap_or(sure);
    let events = history.iter().filter(|event| event.time < sure).count();
    let last = history.iter().map(|event| event.time).fold(period, f64::max);
    match compare_values((&network, scene), seen, (&solver, sure.min(last + 2.0 * period))) {
        Err(wrong) => Verdict::Wrong(wrong),
        Ok(_) if sure < end => Verdict::Untold { events },
        Ok(values) => Verdict::Agrees { events, values },
    }
}

/// Values at four times until an instant.
fn compare_values(
    (network, scene): (&Network, &Scene),
    seen: Observed,
    (solver, until): (&Solver, f64),
) -> Result<usize, String> {
    let times = (1..=4).map(|k| (until * 1e6) as i64 * k / 4 - 1234);
    let times: Vec<i64> = times.filter(|time| *time > 0).collect();
    if times.is_empty() {
        return Ok(0);
    }
    let exact: Vec<_> = times.iter().map(|time| rational(*time, 1_000_000)).collect();
    for (told, time) in values(network, "seen", &exact, Limit::Right, 12).iter().zip(&times) {
        let (told, own) = (told.to_f64(), seen.at(solver, *time as f64 / 1e6));
        if (told - own).abs() > TOLERANCE {
            return Err(format!("{} at {time}e-6: {told} {own}", seen.text(scene)));
        }
    }
    Ok(times.len())
}

#[test]
fn random_scenes_agree_with_plain_doubles() {
    let number = |name| std::env::var(name).ok().map(|count| count.parse::<u64>().unwrap());
    let (count, most) = number("WAVESTEP_SCENES").map_or(SCENES, |count| (count, MANY));
    let (mut agree, mut untold, mut seen) = (0, 0, (0, 0));
    let mut wrong = Vec::new();
    for number in number("WAVESTEP_FIRST").unwrap_or(1).. {
        let mut chance = Chance(number << 32);
        let scene = chance.scene();
        let begun = Instant::now();
        match compare(&scene, &mut chance, most) {
            Verdict::Senseless => continue,
            Verdict::Agrees { events, values } => {
                agree += 1;
                seen = (seen.0 + events, seen.1 + values);
            }
            Verdict::Untold { events } => {
                untold += 1;
                seen.0 += events;
                println!("{number}: not told to the end\n{}", scene.text());
            }
            Verdict::Wrong(why) => {
                wrong.push(format!("{number}: {why}\n{}", scene.text()));
                println!("{}", wrong[wrong.len() - 1]);
            }
        }
        println!(
            "{number}: {:.1} s; {agree} agree, {untold} not told",
            begun.elapsed().as_secs_f64()
        );
        if agree + untold + wrong.len() as u64 >= count {
            break;
        }
    }
    println!(
        "{agree} agree, {untold} are not told to the end; {} events, {} values",
        seen.0, seen.1
    );
    assert!(wrong.is_empty(), "{} scenes\n{}", wrong.len(), wrong.join("\n"));
    assert!(untold * 20 <= count, "{untold} of {count} are not told to the end");
    assert!(seen.0 as u64 > 2 * count, "{} events", seen.0);
}
