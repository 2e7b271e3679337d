//! Every question of one small scene of each kind, by the command; what happens is the table of
//! `docs/guarantees.md`.
//!
//! A mass strikes a bar in most of them, so that values can be told in a line: with the rate `a = Z/M`, the
//! travel time `τ` to the first change of the bar and the reflection `R` there,
//!
//! ```text
//! v = V e^{−at}                                   for t < 2τ
//! v = V (e^{−2aτ} + 2 R a s) e^{−as},  s = t − 2τ  until the next wave returns
//! ```
//!
//! With `UPDATE_DOCUMENTS=1` the table is written anew; read it before you keep it.

use super::{ROOT, folder, run, words};
use serde_json::Value;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::thread;

/// A mass on a bar in numbers.
struct Mass {
    velocity: f64,
    rate: f64,
    travel: f64,
    reflection: f64,
}

impl Mass {
    fn velocity(&self, time: f64) -> f64 {
        let Mass { velocity, rate, travel, reflection } = self;
        let since = time - 2.0 * travel;
        match since < 0.0 {
            true => velocity * (-rate * time).exp(),
            false => {
                let start = (-2.0 * rate * travel).exp();
                velocity * (start + 2.0 * reflection * rate * since) * (-rate * since).exp()
            }
        }
    }

    /// When the force between mass and bar is zero first, where the far end is fixed: `v' = 0`.
    fn leaves(&self) -> f64 {
        2.0 * self.travel + (2.0 + (-2.0 * self.rate * self.travel).exp()) / (2.0 * self.rate)
    }
}

struct Kind {
    name: &'static str,
    text: &'static str,
    file: &'static str,
    unit: &'static str,
    /// The end of windows, and a time within.
    times: [&'static str; 2],
    /// The motion in closed form.
    mass: Option<Mass>,
    /// The energy of the line, which is conserved, and its momentum until a wall is reached.
    held: Option<[f64; 2]>,
    /// What its derivation begins with.
    derived: &'static str,
    model: &'static str,
    /// Where the struck bar begins, in the unit of pictures.
    struck: f64,
    /// A scene that is charted in a moment, and until when.
    charted: [&'static str; 2],
}

const UNIT_MASS: Mass = Mass { velocity: 1.0, rate: 1.0, travel: 1.0, reflection: -1.0 };

/// The steel bar of the scenes with units, struck by 1 kg.
fn steel() -> Mass {
    let (modulus, density, radius, length): (f64, f64, f64, f64) = (210e9, 7850.0, 0.01, 0.4);
    let impedance = std::f64::consts::PI * radius * radius * (modulus * density).sqrt();
    let travel = length / (modulus / density).sqrt();
    Mass { velocity: 5.0, rate: impedance, travel, reflection: -1.0 }
}

macro_rules! text {
    ($file:literal) => {
        include_str!(concat!("../questions/", $file, ".wave"))
    };
}

fn kinds() -> Vec<Kind> {
    let (plain, metric, short) = (["5", "5/2"], ["400us", "200us"], ["150us", "100us"]);
    let exponential = "f[0](s) = exp(-s";
    let kind = |name, file, text, unit, times| Kind {
        name,
        text,
        file,
        unit,
        times,
        mass: None,
        held: None,
        derived: exponential,
        model: "steps",
        struck: 0.0,
        charted: ["F", "400us"],
    };
    vec![
        Kind {
            mass: Some(UNIT_MASS),
            // The momentum is that of the mass.
            held: Some([0.5, 1.0]),
            charted: ["constant-force", "5"],
            ..kind("stated recurrence", "stated", text!("stated-recurrence"), "", plain)
        },
        Kind {
            mass: Some(UNIT_MASS),
            held: Some([0.5, 1.0]),
            charted: ["stepped-striker", "9"],
            ..kind("commensurable", "commensurate", text!("commensurate"), "", plain)
        },
        Kind {
            mass: Some(steel()),
            held: Some([12.5, 5.0]),
            charted: ["hopkinson", "500us"],
            ..kind("with units", "units", text!("with-units"), "s", metric)
        },
        Kind {
            held: Some([1.0, 2.0]),
            derived: "# omega = 1.92266",
            charted: ["endless.wave", "3"],
            ..kind("named rates", "named", text!("named-rates"), "", plain)
        },
        Kind {
            mass: Some(Mass { reflection: 1.0 / 3.0, ..UNIT_MASS }),
            held: Some([0.5, 1.0]),
            derived: "phi_f_rod[0,0](s) = exp(-s)",
            model: "leapfrog",
            charted: ["F", "5"],
            ..kind("incommensurable", "lattice", text!("no-common-measure"), "", plain)
        },
        Kind {
            mass: Some(UNIT_MASS),
            held: Some([0.5, 1.0]),
            charted: ["bars-of-unequal-length", "9"],
            ..kind("contacts open", "open", text!("contacts-open"), "", plain)
        },
        Kind {
            mass: Some(steel()),
            held: Some([12.5, 5.0]),
            charted: ["hopkinson-with-release", "500us"],
            ..kind("open, with units", "open-units", text!("contacts-open-with-units"), "s", metric)
        },
        Kind {
            derived: "0 <= p < 1; nothing returns",
            charted: ["F", "20us"],
            ..kind("local contact, long bars", "long", text!("local-contact-long-bars"), "s", short)
        },
        Kind {
            derived: "0 <= p < 1, as long as t <= 2: then a wave may return through striker",
            struck: 0.3,
            charted: ["F", "20us"],
            ..kind(
                "local contact, finite bars",
                "finite",
                text!("local-contact-finite-bars"),
                "s",
                short,
            )
        },
    ]
}

/// How sure an answer is.
#[derive(Clone, Copy, PartialEq)]
enum Rank {
    Proven,
    Tested,
}

/// Values of quantities at the time of a kind, as far as they were asked for.
type Known = RefCell<BTreeMap<String, f64>>;

/// What an answer is held against.
struct Asked<'a> {
    kind: &'a Kind,
    folder: &'a Path,
    out: &'a str,
    known: &'a Known,
}

impl Asked<'_> {
    /// A number in the output after some words.
    fn after(&self, words: &str) -> f64 {
        let place = self.out.find(words).unwrap_or_else(|| panic!("{words} in {}", self.out));
        number(&self.out[place + words.len()..])
    }

    /// The value of a quantity at the time of the kind, in the digits asked for where nothing is said.
    fn value(&self, quantity: &str) -> f64 {
        if let Some(value) = self.known.borrow().get(quantity) {
            return *value;
        }
        let line = format!(
            "eval {}.wave --quantity {quantity} --at {}",
            self.kind.file, self.kind.times[1]
        );
        let (code, out, err) = run(self.folder, &words(&line));
        assert_eq!(code, 0, "{line}: {err}");
        let value = number(out.split_once("= ").expect("a value").1);
        self.known.borrow_mut().insert(quantity.to_owned(), value);
        value
    }

    fn time(&self) -> f64 {
        match self.kind.times[1] {
            "5/2" => 2.5,
            time => number(time) * 1e-6,
        }
    }

    /// Close to a reference, in parts of the largest values that occur.
    fn is_close(&self, found: f64, reference: f64, tolerance: f64) {
        let scale = self.kind.mass.as_ref().map_or(1.0, |mass| mass.velocity).max(reference.abs());
        let kind = self.kind.name;
        assert!((found - reference).abs() <= tolerance * scale, "{kind}: {found} and {reference}");
    }
}

/// The number that a text begins with.
fn number(text: &str) -> f64 {
    let end = text.find(|c: char| !matches!(c, '0'..='9' | '.' | '-' | 'e' | '+'));
    let text = &text[..end.unwrap_or(text.len())];
    text.parse().unwrap_or_else(|_| panic!("{text} is no number"))
}

/// A question: how it is asked, how sure its answer is, and what that is held against.
struct Question {
    name: &'static str,
    asked: fn(&Kind) -> String,
    rank: Rank,
    holds: fn(&Asked<'_>),
}

fn eval(kind: &Kind, quantity: &str, how: &str) -> String {
    format!("eval F --quantity {quantity} --at {} {how}", kind.times[1])
}

fn search(kind: &Kind, what: &str) -> String {
    format!("find F {what} --from 0{} --to {}", kind.unit, kind.times[0])
}

/// The velocity that was asked for is that of the digits, to within so much.
fn same_velocity(asked: &Asked<'_>, tolerance: f64) {
    asked.is_close(asked.after("= "), asked.value("velocity"), tolerance);
}

/// Whether events are locked, not pieces.
fn is_followed(kind: &Kind) -> bool {
    kind.text.contains("contacts open") || kind.name.contains("local")
}

fn energy_of(kind: &Kind) -> &'static str {
    if kind.text.contains("energy(line)") { "energy" } else { "held" }
}

/// What keeps its value for ever: the energy of the line, in equations the velocity of the fixed end.
fn conserved(kind: &Kind) -> &'static str {
    if kind.text.contains("observe wall") { "wall" } else { energy_of(kind) }
}

#[rustfmt::skip]
const QUESTIONS: [Question; 25] = [
    Question { name: "`derive`", rank: Rank::Proven,
        asked: |_| "derive F --through 0".to_owned(),
        holds: |asked| assert!(asked.out.contains(asked.kind.derived), "{}", asked.out) },
    Question { name: "`eval`, digits", rank: Rank::Proven,
        asked: |kind| eval(kind, "velocity", if kind.name.contains("local") { "" } else { "--digits 15" }),
        holds: |asked| {
            let found = asked.after("= ");
            match &asked.kind.mass {
                Some(mass) => asked.is_close(found, mass.velocity(asked.time()), 1e-12),
                // An independent solver.
                None => {
                    let line = eval(asked.kind, "velocity", "--method steps:1e-12");
                    let line = line.replace('F', &format!("{}.wave", asked.kind.file));
                    let (_, out, _) = run(asked.folder, &words(&line));
                    asked.is_close(found, number(out.split_once("= ").expect("a value").1), 1e-8);
                }
            }
        } },
    Question { name: "`eval` of an energy", rank: Rank::Proven,
        asked: |kind| eval(kind, energy_of(kind), "--digits 15"),
        holds: |asked| {
            let Some([energy, _]) = asked.kind.held else { return };
            let energy = match (energy_of(asked.kind), &asked.kind.mass) {
                // That of a mass of 1.
                ("held", Some(mass)) => 0.5 * mass.velocity(asked.time()).powi(2),
                _ => energy,
            };
            asked.is_close(asked.after("= "), energy, 1e-13);
        } },
    Question { name: "`eval --tol`", rank: Rank::Proven,
        asked: |kind| eval(kind, "velocity", "--tol abs:1e-9"),
        holds: |asked| same_velocity(asked, 1e-9) },
    Question { name: "`eval --tol` of an energy", rank: Rank::Proven,
        asked: |kind| eval(kind, energy_of(kind), "--tol 1e-9"),
        holds: |asked| asked.is_close(asked.after("= "), asked.value(energy_of(asked.kind)), 1e-9) },
    Question { name: "`--method certified`", rank: Rank::Proven,
        asked: |kind| eval(kind, "velocity", "--method certified"),
        holds: |asked| same_velocity(asked, 1e-15) },
    Question { name: "`--method compiled`", rank: Rank::Proven,
        asked: |kind| eval(kind, "velocity", "--method compiled"),
        holds: |asked| same_velocity(asked, 1e-14) },
    Question { name: "`--method marched`", rank: Rank::Tested,
        asked: |kind| eval(kind, "velocity", "--method marched-unproven"),
        holds: |asked| same_velocity(asked, 1e-12) },
    Question { name: "`--method expanded`", rank: Rank::Tested,
        asked: |kind| eval(kind, "velocity", "--method expanded"),
        holds: |asked| same_velocity(asked, 1e-12) },
    Question { name: "`--method`, a model", rank: Rank::Tested,
        asked: |kind| eval(kind, "velocity", &format!("--method {}", kind.model)),
        holds: |asked| same_velocity(asked, if asked.kind.model == "steps" { 1e-8 } else { 1e-3 }) },
    Question { name: "`export`", rank: Rank::Proven,
        asked: |kind| format!("export F --as c --quantity velocity --from 0{} --to {}", kind.unit, kind.times[0]),
        holds: |asked| assert!(asked.out.contains("double wavestep_velocity(double"), "{}", asked.out) },
    Question { name: "`find --zero`", rank: Rank::Proven,
        asked: |kind| search(kind, "--zero velocity"),
        holds: |asked| {
            let Some(mass) = &asked.kind.mass else { return };
            let root = asked.after("at t = ");
            if mass.reflection == -1.0 {
                asked.is_close(mass.velocity(root), 0.0, 1e-12);
            }
        } },
    Question { name: "`find --max`", rank: Rank::Proven,
        asked: |kind| search(kind, "--max velocity"),
        holds: |asked| {
            let largest = asked.after("largest velocity = ");
            assert!(asked.value("velocity") <= largest, "{}", asked.out);
            if let Some(mass) = &asked.kind.mass {
                asked.is_close(largest, mass.velocity, 1e-13);
            }
        } },
    Question { name: "`find --max` of an energy", rank: Rank::Proven,
        asked: |kind| search(kind, "--max held"),
        holds: |asked| {
            let (largest, now) = (asked.after("largest held = "), asked.value("held"));
            let energy = asked.kind.held.map_or(f64::INFINITY, |held| held[0]);
            assert!(now <= largest && largest <= energy * (1.0 + 1e-13), "{now}, {largest}");
            // All is in the bar when the mass stands still; that of the mass is all at the start.
            if asked.kind.mass.as_ref().is_some_and(|mass| mass.reflection == -1.0) {
                asked.is_close(largest, energy, 1e-13);
            }
        } },
    Question { name: "`find` of what is conserved", rank: Rank::Proven,
        asked: |kind| search(kind, &format!("--max {}", conserved(kind))),
        holds: |asked| {
            let Some([energy, _]) = asked.kind.held else { return };
            assert!(asked.out.contains("(constant)"), "{}", asked.out);
            match conserved(asked.kind) {
                "wall" => assert_eq!(asked.after("largest wall = "), 0.0),
                _ => asked.is_close(asked.after("largest energy = "), energy, 1e-13),
            }
        } },
    Question { name: "`find` of a momentum", rank: Rank::Proven,
        asked: |kind| search(kind, "--max momentum"),
        holds: |asked| {
            let largest = asked.after("largest momentum = ");
            match asked.kind.held {
                Some([_, momentum]) => asked.is_close(largest, momentum, 1e-13),
                None => assert!(asked.value("momentum") <= largest * (1.0 + 1e-13), "{}", asked.out),
            }
        } },
    Question { name: "`plot` against time", rank: Rank::Tested,
        asked: |kind| format!("plot F --quantity velocity --to {} -o plot.csv", kind.times[0]),
        holds: |asked| near_the_time(asked, "plot.csv", |row| {
            let time = number(row[2]) / if asked.kind.unit.is_empty() { 1.0 } else { 1e6 };
            ((time - asked.time()).abs(), number(row[3]))
        }, 0.05) },
    Question { name: "`plot --diagram`", rank: Rank::Tested,
        asked: |kind| format!("plot F --diagram velocity --to {} -o diagram.csv", kind.times[0]),
        holds: |asked| {
            let table = fs::read_to_string(asked.folder.join("diagram.csv")).unwrap();
            let at = asked.time() * if asked.kind.unit.is_empty() { 1.0 } else { 1e6 };
            // The cell at the struck end of the bar that holds the time.
            let struck = |line: &&str| {
                let corners: Vec<f64> = line.split([',', ' ']).skip(1).map(number).collect();
                let struck = asked.kind.struck;
                let times = corners.chunks(2).filter(|corner| (corner[0] - struck).abs() < 1e-12);
                let times: Vec<f64> = times.map(|corner| corner[1]).collect();
                times.iter().any(|time| *time <= at) && times.iter().any(|time| *time > at)
            };
            let cell = table.lines().skip(1).find(struck).expect("a cell");
            asked.is_close(number(cell), asked.value("velocity"), 0.05);
        } },
    Question { name: "`plot --at`", rank: Rank::Tested,
        asked: |kind| format!("plot F --at {} -o fields.csv", kind.times[1]),
        holds: |asked| near_the_time(asked, "fields.csv", |row| {
            let off = if row[0].starts_with("velocity") { 0.0 } else { 1e9 };
            (off + (number(row[2]) - asked.kind.struck).abs(), number(row[3]))
        }, 1e-9) },
    Question { name: "`field`", rank: Rank::Proven,
        asked: |kind| format!("field F --at {} --mesh 2", kind.times[1]),
        holds: |asked| {
            let line = asked.out.lines().find(|line| line.starts_with("rod,0.0,")).expect("a row");
            let value = number(line.split(',').nth(2).expect("a velocity"));
            asked.is_close(value, asked.value("velocity"), 1e-13);
        } },
    Question { name: "`events`", rank: Rank::Proven,
        asked: |kind| format!("events F --to {}", kind.times[0]),
        holds: |asked| {
            if !asked.kind.text.contains("contacts open") {
                let is_local = asked.kind.name.contains("local");
                return assert!(is_local || asked.out.contains("Nothing can open"), "{}", asked.out);
            }
            let line = asked.out.lines().find(|line| line.ends_with("hammer and rod separate")).expect("it opens");
            asked.is_close(number(&line["t = ".len()..]), asked.kind.mass.as_ref().expect("known").leaves(), 1e-11);
        } },
    Question { name: "`lock`, pieces or events", rank: Rank::Proven,
        asked: |kind| match is_followed(kind) {
            true => format!("lock F --to {} -o of.lock", kind.times[0]),
            false => "lock F --through 1 -o of.lock".to_owned(),
        },
        holds: is_as_locked },
    Question { name: "`lock`, values", rank: Rank::Proven,
        asked: |kind| match is_followed(kind) {
            true => format!("lock F --to {} --at {} -o of.lock", kind.times[1], kind.times[1]),
            false => format!("lock F --at {} -o of.lock", kind.times[1]),
        },
        holds: |asked| {
            is_as_locked(asked);
            let lock = fs::read_to_string(asked.folder.join("of.lock")).unwrap();
            let line = lock.lines().find(|line| line.starts_with("value velocity(")).expect("a value");
            asked.is_close(number(line.split_once("= ").expect("a value").1), asked.value("velocity"), 1e-14);
        } },
    Question { name: "`check`", rank: Rank::Proven,
        asked: |_| "check F".to_owned(),
        holds: |asked| assert!(asked.out.contains(": consistent; "), "{}", asked.out) },
    Question { name: "`chart`", rank: Rank::Tested,
        asked: |kind| {
            let [scene, to] = kind.charted;
            format!("chart {scene} --to {to} --points 5 --quick -o charts-{}", kind.file)
        },
        holds: bounds_are_kept },
];

/// No error that was measured is larger than the bound that was proven.
fn bounds_are_kept(asked: &Asked<'_>) {
    let file = asked.folder.join(format!("charts-{}/work-precision.json", asked.kind.file));
    let work: Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    let methods = work["methods"].as_array().unwrap();
    let mut proven = 0;
    for point in methods.iter().flat_map(|method| method["points"].as_array().unwrap()) {
        if let Some(bound) = point["bound"].as_f64() {
            assert!(point["error"].as_f64().unwrap() <= bound, "{}: {point}", asked.kind.name);
            proven += 1;
        }
    }
    assert!(proven > 0, "{}: nothing is proven", asked.kind.name);
}

/// What is locked is the same when it is derived again.
fn is_as_locked(asked: &Asked<'_>) {
    let line = format!("check {}.wave --locked of.lock", asked.kind.file);
    let (code, out, err) = run(asked.folder, &words(&line));
    assert!(code == 0 && out.contains("as locked"), "{}: {out}{err}", asked.kind.name);
}

/// The value in the row of a table that is nearest is the velocity; of several the last, that of the bar at the right.
fn near_the_time(
    asked: &Asked<'_>,
    file: &str,
    told: impl Fn(&[&str]) -> (f64, f64),
    tolerance: f64,
) {
    let table = fs::read_to_string(asked.folder.join(file)).unwrap();
    let rows = table.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let rows = rows.filter(|row| row.iter().all(|cell| !cell.is_empty()));
    let mut told: Vec<(f64, f64)> = rows.map(|row| told(&row)).collect();
    told.reverse();
    let nearest = told.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).expect("a row");
    asked.is_close(nearest.1, asked.value("velocity"), tolerance);
}

/// What a question without meaning is refused with, and the note in the table.
const WITHOUT_MEANING: [[&str; 2]; 4] = [
    ["states equations; it has no bars"; 2],
    ["is a model for scenes of bars, and this is a recurrence"; 2],
    ["echoes do not arrive on a common grid"; 2],
    [
        "so this scene has no recurrence",
        "a local contact has no recurrence to march and no sum to expand",
    ],
];

/// A cell of the table.
enum Cell {
    Answered(Rank),
    /// Why it has no meaning.
    Meaningless(String),
}

/// Asks a question, and holds what is answered against something else.
fn ask(kind: &Kind, question: &Question, folder: &Path, known: &Known) -> Cell {
    let line = (question.asked)(kind);
    for (name, what) in [("energy", "energy"), ("held", "energy"), ("momentum", "momentum")] {
        let is_observed = kind.text.contains(&format!("observe {name} "));
        if line.contains(&format!(" {name} ")) && !is_observed {
            return Cell::Meaningless(format!("no {what} is observed in it"));
        }
    }
    let line = line.replacen('F', &format!("{}.wave", kind.file), 1);
    let (code, out, err) = run(folder, &words(&line));
    if code == 0 {
        (question.holds)(&Asked { kind, folder, out: &out, known });
        let is_tested = err.contains("tested, not certified");
        return Cell::Answered(if is_tested { Rank::Tested } else { question.rank });
    }
    let told = err.lines().find_map(|line| line.strip_prefix("error: ")).unwrap_or(&err);
    let note = WITHOUT_MEANING.into_iter().find(|[sentence, _]| told.contains(sentence));
    let Some([_, note]) = note else {
        panic!("refused: {}, {}: {line}: {err}", kind.name, question.name)
    };
    Cell::Meaningless(note.to_owned())
}

/// All questions of one kind of scene, in a folder of its own.
fn column(kind: &Kind) -> Vec<Cell> {
    let folder = folder(&format!("questions-{}", kind.file));
    fs::write(folder.join(format!("{}.wave", kind.file)), kind.text).unwrap();
    let endless = text!("named-rates").replace(", travel = 1", "").replace("fixed", "endless");
    fs::write(folder.join("endless.wave"), endless).unwrap();
    let known = Known::default();
    QUESTIONS.iter().map(|question| ask(kind, question, &folder, &known)).collect()
}

const BEGIN: &str = "<!-- questions: made by crates/cli/tests/it/questions.rs -->\n";
const END: &str = "<!-- end of questions -->\n";

fn guarantees() -> PathBuf {
    Path::new(ROOT).join("docs/guarantees.md")
}

/// The table, with its notes.
fn table() -> String {
    let kinds = kinds();
    let columns: Vec<Vec<Cell>> = thread::scope(|scope| {
        let asked: Vec<_> = kinds.iter().map(|kind| scope.spawn(|| column(kind))).collect();
        asked.into_iter().map(|asked| asked.join().expect("answers that hold")).collect()
    });
    let names: Vec<&str> = kinds.iter().map(|kind| kind.name).collect();
    let mut text =
        format!("| question | {} |\n|---|{}\n", names.join(" | "), ":-:|".repeat(kinds.len()));
    let (mut notes, mut counted): (Vec<&str>, BTreeMap<&str, usize>) = Default::default();
    for (row, question) in QUESTIONS.iter().enumerate() {
        let _ = write!(text, "| {} |", question.name);
        for column in &columns {
            let mark = match &column[row] {
                Cell::Answered(Rank::Proven) => "●",
                Cell::Answered(Rank::Tested) => "◐",
                Cell::Meaningless(_) => "–",
            };
            *counted.entry(mark).or_default() += 1;
            let _ = write!(text, " {mark}");
            if let Cell::Meaningless(reason) = &column[row] {
                if !notes.contains(&&**reason) {
                    notes.push(reason);
                }
                let number = 1 + notes.iter().position(|note| note == reason).expect("noted");
                let _ = write!(text, " <sup>{number}</sup>");
            }
            text.push_str(" |");
        }
        text.push('\n');
    }
    text.push('\n');
    for (number, note) in (1..).zip(&notes) {
        let _ = writeln!(text, "{number}. {note}");
    }
    let count = |mark: &str| counted.get(mark).copied().unwrap_or(0);
    let _ = writeln!(
        text,
        "\nOf {} pairs, {} are answered with proof, {} without, and {} have no meaning.",
        QUESTIONS.len() * kinds.len(),
        count("●"),
        count("◐"),
        count("–"),
    );
    text
}

#[test]
fn every_question_of_every_kind_of_scene() {
    let page = fs::read_to_string(guarantees()).unwrap();
    let (before, rest) = page.split_once(BEGIN).expect("the page holds the table");
    let (_, after) = rest.split_once(END).expect("the table ends");
    let real = format!("{before}{BEGIN}\n{}\n{END}{after}", table());
    if real != page && std::env::var_os("UPDATE_DOCUMENTS").is_some() {
        fs::write(guarantees(), &real).unwrap();
    }
    assert_eq!(real, fs::read_to_string(guarantees()).unwrap());
}

/// `--explain` names the way, its cost and its bound for every kind of scene.
#[test]
fn answers_say_how_they_were_found() {
    let folder = folder("explained");
    for kind in kinds() {
        fs::write(folder.join("of.wave"), kind.text).unwrap();
        for how in ["", "--tol 1e-9"] {
            if kind.name.contains("local") && !how.is_empty() {
                continue;
            }
            let line =
                eval(&kind, "velocity", &format!("--explain {how}")).replacen('F', "of.wave", 1);
            let (code, _, err) = run(&folder, &words(&line));
            assert_eq!(code, 0, "{line}: {err}");
            let parts: &[&str] = match (kind.name.contains("local"), how) {
                (true, _) => &[":"],
                (_, "") => &["value with 15 proven digits", " s\n", "bound: "],
                _ => &["seconds", "≤ ", "the cheapest that is proven to be accurate enough"],
            };
            assert!(parts.iter().all(|part| err.contains(part)), "{}: {err}", kind.name);
        }
    }
    let (code, _, err) =
        run(&folder, &words("events saint-venant --set mu=1 --digits 5 --explain"));
    assert!(code == 0 && err.contains("cells with") && err.contains("bound: "), "{err}");
}

/// Fewer digits never take a precision that more do not need.
#[test]
fn few_digits_cost_no_more_than_many() {
    let folder = folder("few-digits");
    for kind in kinds().iter().filter(|kind| kind.name.contains("open")) {
        fs::write(folder.join("of.wave"), kind.text).unwrap();
        let bits = |digits: &str| {
            let line =
                format!("events of.wave --to {} --format json --digits {digits}", kind.times[0]);
            let (code, out, err) = run(&folder, &words(&line));
            assert_eq!(code, 0, "{err}");
            serde_json::from_str::<Value>(&out).unwrap()["bits"].as_u64().unwrap()
        };
        assert!(bits("6") <= bits("15"), "{}", kind.name);
    }
}
