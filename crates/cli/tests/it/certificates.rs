//! Certificates of the shipped scenes are verified by two checkers that share nothing with the program, and altered ones are
//! not. Left out where there is no Python; the second checker, where `.ci/run` could not install python-flint.

use super::{ROOT, folder, run};
use serde_json::json;
use std::path::Path;
use std::process::Command;
use wavestep::scenes::SCENES;

/// Shipped scenes that have no periods, and so no certificates.
const WITHOUT: [&str; 3] = ["incommensurate", "local-contact", "hertz-striker"];

/// Scenes that have certificates of their pieces.
pub(super) fn certified() -> impl Iterator<Item = &'static str> {
    SCENES.iter().map(|scene| scene.name).filter(|name| !WITHOUT.contains(name))
}

/// Values of waves and of observables, with delays, forcing, roots and slopes among them.
const VALUES: [&str; 8] = [
    "rigid-mass --set mu=1/4 --quantity velocity --at 33/10 --digits 30",
    "rigid-mass --set mu=1/4 --quantity f --at 33/10",
    "two-bars --set r=1/2 --quantity force --at 5",
    "pulse-shape --set mu=1 --quantity force --at 3",
    "mass-on-fixed-bar --set mu=1 --quantity strain_fixed --at 4 --digits 50",
    "pushed-bar --quantity velocity --at 7/2",
    "pile --quantity toe_force --at 20/3 --digits 40",
    "pile --quantity f --at 2",
];

/// Zeros and extrema: simple, exact, on intervals, at arrivals, in limits, in the whole window.
const WINDOWS: [&str; 11] = [
    "rigid-mass --set mu=1 --zero strain_impact --from 2 --to 4",
    "rigid-mass --set mu=1/4 --zero velocity --to 6 --digits 30",
    "pulse-shape --set mu=1 --zero force --to 6",
    "pushed-bar --zero velocity --to 6",
    "mass-on-fixed-bar --set mu=1/4 --max strain_fixed --to 6",
    "mass-on-fixed-bar --set mu=1/4 --min strain_fixed --to 6 --digits 30",
    "struck-free-bar --set mu=3/2 --max impact_force --from 1/3 --to 5",
    "two-bars --set r=1/2 --min force --to 9",
    "pile --max toe_force --to 8",
    "pile --zero ram_velocity --to 8",
    "mass-on-fixed-bar --set mu=1/10 --zero velocity --minus third --to 1",
];

/// How far quantities are from those of simpler scenes: without waves, endless, with other numbers.
const DISTANCES: [&str; 4] = [
    "mass-on-fixed-bar --set mu=1/10 --distance velocity --minus third --to 1",
    "mass-on-fixed-bar --set mu=1 --distance strain_impact --minus endless:rod.right --to 4 --digits 6",
    "pile --distance ram_velocity --minus without:toe --to 4 --digits 6",
    "struck-free-bar --set mu=1 --max velocity --minus endless:rod.right --to 4 --digits 9",
];

/// Doubles: correctly rounded, within a tolerance, by a method with a bound of its own.
const DOUBLES: [&str; 3] = [
    "rigid-mass --set mu=1 --quantity velocity --to 6 --points 30",
    "mass-on-fixed-bar --set mu=1/4 --quantity strain_fixed --from 1/3 --to 6 --points 20 --tol 1e-6",
    "pile --quantity toe_force --to 6 --points 30 --method compiled",
];

/// Events: separation, touching without force, rebound; at jumps and at zero crossings.
const EVENTS: [&str; 4] = [
    "saint-venant --set mu=1 --events --to 5 --digits 9",
    "bars-of-unequal-length --events --to 6",
    "bars-that-part --set r=1/2 --events --to 3",
    "cushion-with-release --set mu=1 --events --to 4 --digits 9",
];

/// A number that is no root.
const PI: &str = "scene \"Pi\"\nmass ram { mass = 1, velocity = pi }\nbar rod { impedance = 1, travel = 1 }\n\
                  line free - ram - rod - fixed\nobserve v = velocity(ram)\n";

/// Values that are no sums of pieces: where contacts open, with units, of displacements, springs and supports.
const READINGS: [&str; 4] = [
    "saint-venant --set mu=1 --quantity velocity --at 5",
    "hopkinson --quantity gauge_incident --at 1ms --digits 9",
    "cushion-with-release --set mu=1 --quantity compression --at 3",
    "mass-that-bounces --quantity displacement --at 4",
];

/// Doubles and extrema of the same.
const EXTREMES: [&str; 3] = [
    "hopkinson --quantity force --to 400us --points 5",
    "saint-venant --set mu=1 --max velocity --to 3 --digits 9",
    "bars-that-part --set r=1/2 --min force --to 5/2",
];

/// The same at critical points and arrivals, in limits, between jumps, at both ends of the window.
const MORE_EXTREMES: [&str; 9] = [
    "hopkinson --max force",
    "hopkinson --min gauge_output --digits 25",
    "percussive-drill --min rock_force",
    "mass-that-bounces --max velocity --to 6",
    "mass-that-bounces --min strain_fixed --to 6",
    "cushion-with-release --set mu=1 --max force",
    "incommensurate --max contact_force",
    "incommensurate --quantity wall_force --points 7 --tol 1e-3",
    "pi.wave --max v --to 4",
];

/// Zeros at times that a checker's steps could end at, and a rest between times that are no binary fractions.
const NICE: &str = "scene \"Nice times\"\nload p { force = 1 - t, until = 3 }\n\
    bar rod { impedance = 1, travel = 3/2 }\nbar target { impedance = 1, travel = 4/3 }\n\
    line free - p - rod | target - free\nobserve f = force(rod.left)\nobserve m = velocity(target.at(1/3))\n\
    contacts open\n";

/// Momenta and energies of moving and strained bars, of masses, springs and supports, with dampers, contacts and units.
const CONTENTS: &str = "scene \"Contents\"\nbar a { impedance = 1, travel = 1, velocity = 1, strain = 1/5 }\n\
    bar b { impedance = 2, travel = 3/2, velocity = -1/3 }\nmass m { mass = 2, velocity = -1/3 }\n\
    spring k { stiffness = 3, damping = 1/4 }\nsupport u { stiffness = 1/2 }\nbar c { impedance = 3 }\n\
    line free - a | b - m - k - u - c - endless\ncontacts open\n\
    observe in_bars = energy(a) - 2*energy(c)\nobserve in_others = energy(m) + energy(k) + energy(u)\n\
    observe all = energy(line)\nobserve push = momentum(line)\nobserve other = momentum(a) - momentum(c)\n";

const MORE_CONTENTS: [&str; 10] = [
    "contents.wave --quantity in_bars --at 29/8",
    "contents.wave --min in_others --to 3",
    "contents.wave --max all --to 2",
    "contents.wave --quantity push --at 4",
    "contents.wave --zero other --to 3",
    "contents.wave --quantity all --points 4 --to 3",
    "blow.wave --max carried --to 6ms",
    "blow.wave --max given --to 6ms --digits 9",
    "mass-on-fixed-bar --set mu=1 --quantity energy --at 3",
    "mass-on-free-bar --set m=1 --max momentum --to 3",
];

/// A half-sine blow with units, which begins and ends smoothly, at no simple time in the unit of the line.
const BLOW: &str = "scene \"Blow\"\nload blow { force = 200*sin(200*pi*t) kN, until = 5 ms }\nmass ram { mass = 500 kg }\n\
    material steel { modulus = 210 GPa, density = 7850 kg/m^3 }\n\
    bar pile { material = steel, diameter = 200 mm, length = 10 m }\n\
    support soil { stiffness = 20 kN/mm, damping = 50 kN*s/m }\n\
    line free - blow - ram | pile - soil - free\ncontacts open\n\
    observe top = force(pile.left)\nobserve toe = velocity(pile.right)\n\
    observe carried = energy(pile)\nobserve given = momentum(line)\n";

const BLOWS: [&str; 5] = [
    "blow.wave --events --to 10ms",
    "blow.wave --max top --to 10ms",
    "blow.wave --quantity toe --at 3ms",
    "blow.wave --quantity top --points 4 --to 8ms",
    "blow.wave --zero toe --to 4ms",
];

/// Zeros of what is read: between arrivals, with a rest before, a force that begins again and ends where its contact opens.
const ZEROS: [&str; 3] = [
    "mass-that-bounces --zero strain_fixed --to 6",
    "saint-venant --set mu=1 --zero velocity --to 4 --digits 9",
    "cushion-with-release --set mu=1 --zero force",
];

/// The same with units, of displacements, at irrational arrivals, with many digits.
const MORE_ZEROS: [&str; 10] = [
    "hopkinson --zero force",
    "hopkinson --zero gauge_output",
    "hopkinson --zero compression",
    "percussive-drill --zero rock_force",
    "mass-that-bounces --zero velocity --to 6 --digits 40",
    "incommensurate --zero contact_force",
    "pi.wave --zero v --to 4",
    "pile --zero penetration --to 8",
    "nice.wave --zero f --to 5/2",
    "nice.wave --zero m --to 5",
];

/// The same later, between jumps, with more digits.
const MORE_READINGS: [&str; 8] = [
    "incommensurate --quantity contact_force --at 200us",
    "hopkinson --quantity force --at 1ms --digits 30",
    "hopkinson --quantity compression --at 200us",
    "hopkinson-with-release --quantity gauge --at 500us",
    "percussive-drill --quantity penetration --at 1ms",
    "saint-venant --set mu=1/4 --quantity strain_fixed --at 17/4",
    "bars-of-unequal-length --quantity right --at 11/2",
    "pi.wave --quantity v --at 1",
];

/// The same with units, a load, a release that ends, several contacts; longer windows.
const MORE_EVENTS: [&str; 10] = [
    "saint-venant --set mu=1/10 --events --to 12 --digits 30",
    "mass-on-free-bar --set m=2 --events --to 4",
    "bars-of-equal-length --events --to 6",
    "mass-that-bounces --events --to 6",
    "hopkinson-with-release --events",
    "hopkinson --events",
    "pile --events --to 8",
    "percussive-drill --events --to 1ms",
    "stepped-striker --events",
    "striker-on-long-bar --set r=2 --events",
];

/// Scenes with formulas for every n: sequences, Laguerre polynomials, sums over earlier periods.
const GENERAL: [&str; 12] = [
    "bars-of-equal-length",
    "bars-that-part",
    "constant-force",
    "mass-on-fixed-bar",
    "mass-on-free-bar",
    "pulse-shape",
    "pushed-bar",
    "rigid-mass",
    "saint-venant",
    "striker-on-long-bar",
    "struck-free-bar",
    "two-bars",
];

/// The mass ratios of Saint-Venant's problem.
const RATIOS: [&str; 6] = ["1/10", "1/4", "1", "3/2", "3", "10"];

/// A Python with python-flint, where `.ci/run` put it.
const FLINT: &str = "target/flint/bin/python";

/// Whether a program succeeds in a folder, and what it says; `None` where it is missing.
pub(super) fn run_program(
    folder: &Path,
    program: &str,
    arguments: &[String],
) -> Option<(bool, String)> {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(folder);
    match command.env("PYTHONDONTWRITEBYTECODE", "1").output() {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            eprintln!("{program} is missing: left out");
            None
        }
        output => {
            let output = output.unwrap();
            let told = [output.stdout, output.stderr].concat();
            Some((output.status.success(), String::from_utf8(told).unwrap()))
        }
    }
}

/// What a script of `checkers/` says of files in a folder.
pub(super) fn run_script(
    folder: &Path,
    python: &str,
    script: &str,
    arguments: &[String],
) -> Option<(bool, String)> {
    let script = format!("{ROOT}/checkers/{script}");
    run_program(folder, python, &[&[script], arguments].concat())
}

fn with_flint(folder: &Path, script: &str, arguments: &[String]) -> Option<(bool, String)> {
    run_script(folder, &format!("{ROOT}/{FLINT}"), script, arguments)
}

/// What the first checker says.
fn checked(folder: &Path, arguments: &[String]) -> Option<(bool, String)> {
    run_script(folder, "python3", "check.py", arguments)
}

/// Both checkers prove all files.
fn assert_proven(folder: &Path, files: &[String]) {
    let both = [checked(folder, files), with_flint(folder, "check_arb.py", files)];
    for (proven, told) in both.into_iter().flatten() {
        assert!(proven && told.matches(": proven (").count() == files.len(), "{told}");
    }
}

/// Writes a certificate.
pub(super) fn certify(folder: &Path, line: &str, file: &str) {
    let words: Vec<&str> = line.split(' ').chain(["-o", file]).collect();
    let (code, _, errors) = run(folder, &[&["certify"], &words[..]].concat());
    assert_eq!((code, errors.contains("error")), (0, false), "{line}: {errors}");
}

/// Certificates of all scenes, of Saint-Venant's problem with numbers, and of what is asked of some, by the names of their
/// files.
fn certificates(folder: &Path) -> Vec<String> {
    let pieces = certified().map(|scene| format!("{scene} --through 4"));
    let ratios = RATIOS.map(|ratio| format!("saint-venant --set mu={ratio} --through 6"));
    let general = GENERAL.map(|scene| format!("{scene} --general"));
    let asked = VALUES
        .into_iter()
        .chain(WINDOWS)
        .chain(DISTANCES)
        .chain(DOUBLES)
        .chain(EVENTS)
        .chain(READINGS)
        .chain(EXTREMES)
        .chain(ZEROS);
    let asked = asked.map(str::to_owned);
    let lines = pieces.chain(ratios).chain(general).chain(asked).enumerate();
    let written = lines.map(|(i, line)| {
        let file = format!("{i}.json");
        certify(folder, &line, &file);
        file
    });
    written.collect()
}

#[test]
fn certificates_of_shipped_scenes_are_verified() {
    let folder = folder("certificates");
    assert_proven(&folder, &certificates(&folder));
}

/// Lines that no shipped scene has: velocities without a bar, dampers, loads that end, walls, motion at the start.
#[test]
fn laws_of_all_elements_are_those_of_the_drawing() {
    let folder = folder("certificates-of-lines");
    let bars =
        "bar a { impedance = 1, travel = 1, velocity = 1 }\nbar b { impedance = 2, travel = 2 }\n";
    let lines = [
        "mass m { mass = 1, velocity = 1 }\nspring s { damping = 1/3 }\nmass h { mass = 1/2, velocity = 1 }\n\
         line free - m - s - h - a - b - fixed\n",
        "spring s { stiffness = 1, damping = 1 }\nspring d { damping = 2 }\n\
         support u { stiffness = 3, damping = 1 }\nload p { force = 1 + t, from = 2, until = 4 }\n\
         line fixed - a - s - d - b - u - p - free\n",
        "mass m { mass = 2, velocity = 1 }\nload p { velocity = 1 + t, until = 3 }\n\
         line free - p - b - m - a - free\n",
        "mass m { mass = 2 }\nspring s { stiffness = 2 }\n\
         bar c { impedance = 3, travel = 1/2, strain = 1/2 }\nline fixed - c - b - m - s - a - fixed\n",
        "spring s { damping = 1 }\nmass m { mass = 1/2, velocity = 1 }\nline fixed - b - a - s - m - free\n",
        "mass m { mass = 2 }\nload p { force = sin(pi*t) + cos(pi*t/2), from = 1, until = 3 }\n\
         line free - p - m - a - b - fixed\n",
        "load p { force = sin(pi*t/3) + t*cos(pi*t/4) }\nmass m { mass = 1 }\nline free - p - m - a - b - free\n",
        "symbol l > 0\nload p { force = sin(pi*t/l) }\nbar s { impedance = 1, travel = l }\n\
         line free - p - s - fixed\n",
    ];
    let written = lines.iter().enumerate().map(|(i, line)| {
        let (scene, file) = (format!("{i}.wave"), format!("{i}.json"));
        let bars = if line.contains("bar s") { "" } else { bars };
        std::fs::write(folder.join(&scene), format!("scene \"Line {i}\"\n{bars}{line}")).unwrap();
        certify(&folder, &format!("{scene} --through 3"), &file);
        file
    });
    let files: Vec<String> = written.collect();
    assert_proven(&folder, &files);
}

/// One exponent may be written in two ways.
#[test]
fn exponents_with_denominators_are_verified() {
    let folder = folder("certificates-with-denominators");
    let text = "scene \"Plain\"\nsymbol l > 0\nsymbol c > 0\n\
                bar a { impedance = 1, travel = l/c, velocity = 1 }\nspring k { stiffness = 1 }\n\
                bar b { impedance = 1 }\nline free - a | k - b - endless\n";
    std::fs::write(folder.join("plain.wave"), text).unwrap();
    certify(&folder, "plain.wave --through 2", "plain.json");
    assert_proven(&folder, &["plain.json".to_owned()]);
}

#[test]
fn motions_of_shipped_scenes_are_verified() {
    let folder = folder("certificates-of-events");
    std::fs::write(folder.join("pi.wave"), PI).unwrap();
    std::fs::write(folder.join("nice.wave"), NICE).unwrap();
    std::fs::write(folder.join("blow.wave"), BLOW).unwrap();
    let lines = MORE_EVENTS.iter().chain(&MORE_READINGS).chain(&MORE_EXTREMES).chain(&MORE_ZEROS);
    std::fs::write(folder.join("contents.wave"), CONTENTS).unwrap();
    let lines = lines.chain(&BLOWS).chain(&MORE_CONTENTS);
    let files = lines.enumerate().map(|(i, line)| {
        certify(&folder, line, &format!("{i}.json"));
        format!("{i}.json")
    });
    assert_proven(&folder, &files.collect::<Vec<_>>());
}

/// Contacts between all that can stand beside them: walls, supports, springs with and without dampers, loads that end,
/// oscillate and decay, several contacts, what settles at one instant, a spring in front of a mass.
#[test]
fn events_beside_all_elements_are_verified() {
    let folder = folder("certificates-of-contacts");
    let lines = [
        "bar a { impedance = 1, travel = 1, velocity = 1 }\nspring s { stiffness = 2, damping = 1/3 }\n\
         bar b { impedance = 2, travel = 3/2 }\nbar c { impedance = 1, travel = 2/5 }\n\
         line free - a | s - b | c - free\n",
        "load p { force = t*t - 1/2 }\nmass m { mass = 1 }\nbar r { impedance = 1 }\nline fixed | p - m - r - endless\n",
        "load p { force = 1 - t*t*t }\nmass m { mass = 1 }\nmass h { mass = 2 }\nbar r { impedance = 1, travel = 1 }\n\
         line free - p - m | h - r - free\n",
        "mass m { mass = 1/2, velocity = 1 }\nspring s { stiffness = 3 }\nbar b { impedance = 1, travel = 1 }\n\
         support u { stiffness = 2, damping = 1/2 }\nline free - m - s | b - u - free\n",
        "load p { force = 2*exp(-t)*sin(3*t), until = 3 }\nmass m { mass = 1, velocity = 1/2 }\n\
         bar b { impedance = 1, travel = 2 }\nline free - p - m | b - fixed\n",
        "mass m { mass = 2, velocity = 1 }\nbar b { impedance = 1, travel = 1 }\nmass h { mass = 1 }\n\
         bar c { impedance = 1, travel = 1 }\nline free - m | b - h | c - free\n",
        "load p { force = (1 + t)*exp(-2*t) }\nbar a { impedance = 3, travel = 1 }\nbar b { impedance = sqrt(2), travel = 1/2 }\n\
         mass m { mass = 1 }\nline free - p - a | b - m - free\n",
        "bar a { impedance = 1, velocity = -10 }\nsupport s { damping = 1 }\nbar b { impedance = 1, velocity = -1 }\n\
         line endless - a | s | b - endless\n",
        "bar a { impedance = 1, travel = 1, velocity = 1 }\nbar b { impedance = 1, travel = sqrt(2) }\n\
         bar c { impedance = 2, travel = 2*sqrt(2) }\nline free - a | b - c - free\n",
        "mass m { mass = 1, velocity = pi }\nspring s { stiffness = 4 }\nmass h { mass = 2 }\n\
         load p { force = -sqrt(2) }\nline free - p - m | s - h - free\n",
        "load p { force = sin(pi*t)/pi, until = 2 }\nmass m { mass = 1 }\nbar b { impedance = 1, travel = 1 }\n\
         line free - p - m | b - fixed\n",
        "load p { force = 1 - cos(2*pi*t), until = 1 }\nmass m { mass = 1/2 }\nbar b { impedance = sqrt(3), travel = 1 }\n\
         support u { stiffness = 1, damping = 1 }\nline free - p - m | b - u - free\n",
    ];
    let written = lines.iter().enumerate().map(|(i, line)| {
        let (scene, file) = (format!("{i}.wave"), format!("{i}.json"));
        let text = format!("scene \"Contacts {i}\"\n{line}contacts open\n");
        std::fs::write(folder.join(&scene), text).unwrap();
        certify(&folder, &format!("{scene} --events --to 7"), &file);
        file
    });
    let files: Vec<String> = written.collect();
    assert_proven(&folder, &files);
}

/// Every observable of scenes without units: its values at several times, its zeros and extrema are verified, or there is
/// no certificate and it is said why.
#[test]
fn all_observables_are_verified_or_refused() {
    let folder = folder("certificates-of-values");
    let mut files = Vec::new();
    let questions = ["--quantity Q --at 1/3", "--quantity Q --at 3", "--quantity Q --at 29/4"];
    let windows = ["--zero Q --to 29/4", "--max Q --from 1/3 --to 5", "--min Q --to 5"];
    for scene in certified() {
        let problem = wavestep::Problem::builtin(scene).unwrap();
        if problem.has_units() {
            continue;
        }
        let symbols: Vec<String> =
            problem.symbols().iter().map(|name| format!("--set {name}=3/2")).collect();
        for quantity in problem.observables() {
            for asked in questions.iter().chain(&windows) {
                let file = format!("{}.json", files.len());
                let (symbols, asked) = (symbols.join(" "), asked.replace('Q', quantity));
                let line = format!("certify {scene} {symbols} {asked} -o {file}");
                let words: Vec<&str> = line.split_whitespace().collect();
                let (code, _, errors) = run(&folder, &words);
                match code {
                    0 => files.push(file),
                    _ => assert!(errors.contains("no certificates of values"), "{line}: {errors}"),
                }
            }
        }
    }
    assert!(files.len() > 140, "{}", files.len());
    assert_proven(&folder, &files);
}

/// By both checkers, which have to agree, where there are two.
#[test]
fn altered_certificates_are_not() {
    let folder = folder("altered-certificates");
    let files = certificates(&folder);
    let arguments = [&["1000".to_owned()], &files[..]].concat();
    let told = with_flint(&folder, "alterations.py", &arguments)
        .or_else(|| run_script(&folder, "python3", "alterations.py", &arguments));
    let Some((passed, told)) = told else { return };
    assert!(passed && told.contains("1000 alterations") && told.contains(" 0 missed"), "{told}");
}

/// The function c x of a symbol x.
fn of(coefficient: &str, symbol: &str) -> serde_json::Value {
    json!([[[[coefficient, { symbol: 1 }]], []]])
}

/// A mass that is at rest after a whole period of a sine, and only then.
const PUSH: &str = "scene \"Push and pull\"\nmass m { mass = 1 }\nload p { force = sin(pi*t), until = 2 }\n\
    bar rod { impedance = 1, travel = 1 }\nline free - p - m - rod - free\nobserve v = velocity(m)\n";

/// Gives a symbol another name.
fn renamed(certificate: &mut serde_json::Value, name: &str, other: &str) {
    let text = certificate.to_string().replace(&format!("\"{name}\""), &format!("\"{other}\""));
    *certificate = serde_json::from_str(&text).unwrap();
}

/// A mass and a load with one square root.
const ROOTED: &str = "scene \"Root\"\nload push { force = sqrt(2)*t*exp(-t) }\nmass ram { mass = sqrt(2) }\n\
    bar rod { impedance = 1, travel = 1 }\nline free - push - ram - rod | fixed\ncontacts open\nobserve v = velocity(ram)\n";

/// The course c/2^power.
fn over(c: &str, power: i64) -> serde_json::Value {
    json!([[[], [[[[c, {}]], [[[["2", {}]], power]]]]]])
}

/// A term a·exp(i b t).
fn of_complex(a: &str, b: &str) -> serde_json::Value {
    json!([[[[[b, { "sqrt(-1)": 1, "t": 1 }]], []]], [[[[a, {}]], []]]])
}

fn number(value: &str) -> serde_json::Value {
    json!([[[[value, {}]], []]])
}

fn one() -> serde_json::Value {
    number("1")
}

/// Each part of the checkers finds what it is there for.
#[test]
fn wrong_claims_are_told_by_what_is_wrong() {
    let folder = folder("wrong-certificates");
    let ask = |line: &str| {
        certify(&folder, line, "asked.json");
        let text = std::fs::read_to_string(folder.join("asked.json")).unwrap();
        serde_json::from_str::<serde_json::Value>(&text).unwrap()
    };
    let pieces = ask("rigid-mass --through 2");
    let line = ask("hopkinson --through 2");
    let value = ask(VALUES[0]);
    let general = ask("saint-venant --general");
    let sequences = ask("two-bars --general");
    let stated = ask("rigid-mass --general");
    let velocity = ask(WINDOWS[1]);
    let (roots, largest) = (ask(WINDOWS[0]), ask(WINDOWS[4]));
    let (rings, distance, doubles) = (ask(VALUES[6]), ask(DISTANCES[0]), ask(DOUBLES[0]));
    type Change = fn(&mut serde_json::Value);
    let (bounced, strained) = (ask(READINGS[0]), ask(READINGS[1]));
    let (events, unequal) = (ask(EVENTS[0]), ask(EVENTS[1]));
    let (sampled, fastest, lowest) = (ask(EXTREMES[0]), ask(EXTREMES[1]), ask(EXTREMES[2]));
    let (crossing, released) = (ask(ZEROS[0]), ask(ZEROS[2]));
    std::fs::write(folder.join("push.wave"), PUSH).unwrap();
    let (turns, pushed) = (ask("push.wave"), ask("push.wave --quantity v --at 3/2"));
    std::fs::write(folder.join("contents.wave"), CONTENTS).unwrap();
    std::fs::write(folder.join("root.wave"), ROOTED).unwrap();
    let rooted = ask("root.wave --quantity v --at 3/2");
    let [held, moved] = [MORE_CONTENTS[0], MORE_CONTENTS[3]].map(ask);
    let cases: [(&serde_json::Value, Change, &str); 135] = [
        (&held, |own| own["line"][1]["velocity"] = number("2"), "the value is between"),
        (&held, |own| own["line"][1]["force"] = number("1"), "the value is between"),
        (&held, |own| own["line"][7]["force"] = number("1"), "an endless bar is infinite"),
        (&held, |own| own["observed"][0][2] = "nobody".into(), "there is no nobody"),
        (&held, |own| own["observed"][0][1] = "momentum".into(), "the value is between"),
        (&moved, |own| own["observed"][0] = json!([one(), "momentum", "k"]), "cannot be read"),
        (&moved, |own| own["observed"][0] = json!([one(), "energy", "a"]), "the value is between"),
        (&rooted, |own| own["value"] = "0.413237192503764".into(), "the value is between"),
        (&rooted, |own| own["line"][1]["course"] = over("1", 0), "no positive integer"),
        (
            &rooted,
            |own| own["line"][1]["course"] = json!([of_complex("1", "1"), of_complex("-1", "1")]),
            "not real",
        ),
        (&turns, |own| own["numbers"]["pi"] = json!(["3", "3"]), "pi is the number"),
        (&sampled, |own| own["until"] = json!(["0", "0"]), "the window runs backwards"),
        (&turns, |own| own["local"] = "pi".into(), "pi is the number"),
        (&turns, |own| own["roots"]["pi"] = "5".into(), "pi is the number"),
        (&turns, |own| renamed(own, "pi", "tau"), "continuity 0 at the start of period 1"),
        (&turns, |own| own["period"] = of("1", "pi"), "a period is not positive"),
        (&pushed, |own| own["numbers"]["pi"] = json!(["3", "4"]), "stands for two numbers"),
        (&pushed, |own| renamed(own, "pi", "tau"), "a symbol has no value"),
        (
            &crossing,
            |own| drop(own["zeros"].as_array_mut().unwrap().pop()),
            "it is zero just before",
        ),
        (&crossing, |own| own["zeros"][1] = own["zeros"][0].clone(), "overlap"),
        (&crossing, |own| own["zeros"][0] = json!(["3/2", "8/5"]), "there may be no zero"),
        (&crossing, |own| own["rests"][0][1][1] = "0.9999999".into(), "at another time"),
        (&crossing, |own| own["rests"][0][0] = json!(["1/2", "7"]), "at another time"),
        (&crossing, |own| own["zeros"] = json!({}), "a list is missing"),
        (&crossing, |own| own["zeros"][0] = json!(["1/10", "1/5"]), "zero all of the time"),
        (&crossing, |own| own["rests"] = json!([]), "there are 1 rests"),
        (&crossing, |own| own["rests"][0][1] = json!(["2", "2"]), "at another time"),
        (&crossing, |own| own["until"] = json!(["60", "60"]), "outside the window"),
        (&crossing, |own| own["until"] = own["from"].clone(), "the window is empty"),
        (&released, |own| own["rests"][1][0][1] = own["rests"][1][0][0].clone(), "may be a zero"),
        (&released, |own| drop(own["rests"].as_array_mut().unwrap().remove(0)), "may be a zero"),
        (&sampled, |own| own["values"][3][1] = "0".into(), "value 3 is between"),
        (&sampled, |own| own["until"] = own["from"].clone(), "is between"),
        (&sampled, |own| own["points"] = 4.into(), "a value is missing"),
        (&sampled, |own| own["until"] = json!(["9", "9"]), "outside the window"),
        (&fastest, |own| own["value"] = "0.99999998".into(), "a value is beyond"),
        (&fastest, |own| own["value"] = "1.00000001".into(), "not taken where it is said"),
        (&fastest, |own| own["attained"] = "1/2".into(), "not taken where it is said"),
        (&fastest, |own| own["attained"] = "4".into(), "outside the window"),
        (&lowest, |own| own["goal"] = "largest".into(), "a value is beyond"),
        (&lowest, |own| own["value"] = "0.1".into(), "a value is beyond"),
        (
            &lowest,
            |own| {
                own["until"] = own["from"].clone();
                own["attained"] = own["from"][0].clone();
            },
            "the window is empty",
        ),
        (&fastest, |own| own["attained"] = own["until"][0].clone(), "outside the window"),
        (&sampled, |own| own["from"] = json!(["0", "1000"]), "outside the window"),
        (&strained, |own| own["observed"][0][3] = json!(null), "a wave is left out"),
        (&strained, |own| own["observed"][0][3] = of("-5", "q"), "q has no value"),
        (&strained, |own| own["observed"][0][3] = json!([[[["-5", {}]], []]]), "may be negative"),
        (&strained, |own| own["observed"][0][4] = json!([]), "do not add up to the travel time"),
        (&events, |own| drop(own["events"].as_array_mut().unwrap().pop()), "no event is claimed"),
        (
            &events,
            |own| drop(own["events"].as_array_mut().unwrap().remove(0)),
            "no event is claimed",
        ),
        (&events, |own| own["events"][1][3] = "3".into(), "runs backwards"),
        (
            &events,
            |own| own["events"][1] = json!([0, "opening", "3.06", "3.067"]),
            "not changed yet",
        ),
        (
            &events,
            |own| own["events"][1] = json!([0, "opening", "3.068", "3.07"]),
            "changed before",
        ),
        (&events, |own| own["events"][1][1] = "closing".into(), "something else"),
        (&events, |own| own["events"].as_array_mut().unwrap().swap(1, 2), "in one interval"),
        (&events, |own| own["to"] = "3.1".into(), "2 events instead of 4"),
        (&events, |own| own["line"][1]["velocity"] = of("1", "q"), "q has no value"),
        (&events, |own| own["line"][2]["is"] = "free".into(), "two ends"),
        (&events, |own| own["line"][3]["travel"] = json!([]), "without length"),
        (&events, |own| own["step"] = "1/100000".into(), "too long"),
        (&unequal, |own| own["events"][1][0] = 1.into(), "without a contact"),
        (&unequal, |own| own["events"][1][1] = "opening".into(), "something else"),
        (&unequal, |own| own["events"][2] = json!([0, "opening", "4", "4"]), "between 5.0 and 5.0"),
        (&bounced, |own| own["value"] = "-0.698875581996164".into(), "the value is between"),
        (&bounced, |own| own["last_place"] = (-14).into(), "more digits than it says"),
        (&bounced, |own| own["at"] = json!(["9", "9"]), "outside the window"),
        (&bounced, |own| own["observed"][0][2] = "anvil".into(), "there is no anvil"),
        (&bounced, |own| own["observed"][0][1] = "force".into(), "cannot be read"),
        (&strained, |own| own["unit"] = json!(["1", "1"]), "the value is between"),
        (&strained, |own| own["line"][1]["name"] = "incident".into(), "a name stands twice"),
        (&pieces, |own| own["pieces"]["f"][2][0][1][0][0][0][0] = "7".into(), "period 2"),
        (&pieces, |own| own["continuity"][0]["start"] = json!([]), "continuity 0"),
        (&pieces, |own| own["continuity"] = json!([]), "leaves values open"),
        (&pieces, |own| own["equations"][0] = own["equations"][1].clone(), "derivatives open"),
        (&pieces, |own| own["pieces"]["g"][1] = json!([]), "equation"),
        (&line, |own| own["line"][1]["impedance"] = own["period"].clone(), "equation"),
        (&line, |own| own["line"][1]["velocity"] = json!([]), "equation"),
        (&line, |own| own["line"][2]["travel"] = own["period"].clone(), "no multiple"),
        (&line, |own| own["line"][0]["is"] = "fixed".into(), "no multiple"),
        (&line, |own| own["line"][1]["right"] = json!(null), "lacks a wave"),
        (&general, |own| own["general"]["f"]["rate"] = own["period"].clone(), "different echoes"),
        (
            &general,
            |own| own["general"]["g"]["terms"][0][1] = own["period"].clone(),
            "an equation for echo 1",
        ),
        (&general, |own| own["line"][1]["mass"] = own["period"].clone(), "echo"),
        (&sequences, |own| own["general"]["f"]["terms"][1][1] = 1.into(), "equation"),
        (&value, |own| own["value"] = "0.3".into(), "another one"),
        (&rings, |own| own["value"] = "0.3".into(), "another one"),
        (
            &rings,
            |own| {
                let i = json!([[[[["1", { "sqrt(-1)": 1 }]], []]]]);
                own["observed"]["forcing"] = json!([[[], i[0]]]);
            },
            "not real",
        ),
        // A power of a root is no root: √3³ is not 1.73.
        (
            &value,
            |own| {
                own["roots"] = json!({ "q": "3" });
                own["observed"]["waves"] = json!([]);
                own["observed"]["forcing"] = json!([[[], [[[["1", { "q": 3 }]], []]]]]);
                (own["value"], own["last_place"]) = ("1.73".into(), (-2).into());
            },
            "another one",
        ),
        // A root whose name is that of a number: e^√3 is not e^3.
        (
            &value,
            |own| {
                own["roots"] = json!({ "3": "3" });
                own["observed"]["waves"] = json!([]);
                let root = json!([[[[["1", { "3": 1 }]], []]], [[[["1", {}]], []]]]);
                let number = json!([[[[["3", {}]], []]], [[[["-1", {}]], []]]]);
                own["observed"]["forcing"] = json!([root, number]);
                (own["value"], own["last_place"]) = ("0".into(), (-1).into());
            },
            "another one",
        ),
        (&pieces, |own| own["minus"] = json!({ "observed": {} }), "for nothing"),
        (&distance, |own| own["minus"]["minus"] = own["minus"].clone(), "a third scene"),
        (&distance, |own| own["minus"]["local"] = "x".into(), "names"),
        (&doubles, |own| own["values"][9][0] = "1/3".into(), "the value at"),
        (&doubles, |own| own["values"][9][1] = "0".into(), "the value at"),
        (&doubles, |own| own["to"] = "5".into(), "the value at"),
        (&distance, |own| own["value"] = "-0.03".into(), "beyond"),
        (&distance, |own| own["goal"] = "smallest".into(), "beyond the extremum"),
        (&distance, |own| drop(own.as_object_mut().unwrap().remove("minus")), "beyond"),
        (&distance, |own| own["minus"]["time"] = "x".into(), "names"),
        (&distance, |own| own["minus"]["pieces"]["rod"][0] = json!([]), "equation"),
        (&value, |own| own["at"] = "34/10".into(), "another one"),
        (&value, |own| own["last_place"] = (-3).into(), "more digits than it says"),
        (&roots, |own| own["zeros"] = json!([]), "1 zeros instead of 0"),
        (&roots, |own| own["zeros"][0] = json!(["3", "306/100"]), "is not told"),
        (&roots, |own| drop(own["cells"].as_array_mut().unwrap().remove(1)), "gaps"),
        (&roots, |own| own["cells"] = json!([["2", "4", 0]]), "no sign is seen"),
        (&roots, |own| own["cells"][0][2] = 2.into(), "do not vanish"),
        (&roots, |own| own["to"] = "5".into(), "end early"),
        (&velocity, |own| own["cells"] = json!([["0", "6", 0]]), "a wave arrives"),
        (&largest, |own| own["value"] = "-0.1".into(), "beyond the extremum"),
        (&largest, |own| own["attained"][1] = "0".into(), "not taken"),
        (&pieces, |own| own["roots"] = json!({ "r": "4" }), "nor a prime"),
        (&pieces, |own| own["roots"] = json!({ "r": "3", "q": "3" }), "two roots of one"),
        (
            &pieces,
            |own| {
                own["roots"] = json!({ "r": "3" });
                let zero = json!([[], [[[], [[[["1", { "r": 2 }], ["-3", {}]], 1]]]]]);
                own["pieces"]["f"][1].as_array_mut().unwrap().push(zero);
            },
            "a divisor is zero",
        ),
        (&pieces, |own| own["roots"] = json!({ "s": "-1" }), "is no root"),
        (&pieces, |own| own["roots"] = json!({ "t": "3" }), "is no root"),
        (&pieces, |own| own["roots"] = json!({ "g": "3" }), "is no root"),
        (&line, |own| own["line"][1]["impedance"] = of("1", "s"), "depends on time"),
        (&line, |own| own["line"][1]["force"] = of("1", "t"), "depends on time"),
        (&pieces, |own| own["equations"][0]["waves"][0][3] = json!([[[], of("1", "s")]]), "time"),
        (&pieces, |own| own["pieces"]["f"][1][0][1] = of("1", "t"), "depends on another time"),
        (&value, |own| own["observed"]["waves"][0][3] = json!([[[], of("1", "t")]]), "on time"),
        (&value, |own| own["period"] = json!([[[["-1", {}]], []]]), "not positive"),
        (&pieces, |own| own["period"] = of("-2", "mu"), "not positive"),
        (&pieces, |own| own["period"] = json!([]), "not positive"),
        (&line, |own| own["line"][2]["travel"] = json!([[[["-2", {}]], []]]), "without length"),
        (
            &stated,
            |own| {
                let sum = json!(["f", "sum", 0, [[[], [[[["1", {}]], []]]]]]);
                own["continuity"][0]["waves"].as_array_mut().unwrap().push(sum);
            },
            "a sum or a slope",
        ),
        (
            &general,
            |own| {
                let all = own["general"].as_object_mut().unwrap();
                all.values_mut().for_each(|form| form["laguerre"] = json!([]));
            },
            "of nothing",
        ),
        (
            &roots,
            |own| {
                own["to"] = own["from"].clone();
                (own["cells"], own["zeros"]) = (json!([]), json!([]));
            },
            "the window is empty",
        ),
        (&pieces, |own| own["kind"] = "pieces\n".into(), "unknown kind \"pieces\\n\""),
        (&pieces, |own| own["equations"][0]["waves"][0][2] = 1_000_000_000.into(), "too large"),
        (&pieces, |own| own["period"][0][0][0][1]["mu"] = 1_000_000_000.into(), "too large"),
        (&value, |own| own["last_place"] = (-1_000_000_000).into(), "too large"),
        (&sequences, |own| own["general"]["f"]["terms"][0][1] = 1_000_000_000.into(), "too large"),
        (&general, |own| own["general"]["f"]["terms"][0][0] = 1_000_000_000.into(), "too late"),
    ];
    for (certificate, change, wrong) in cases {
        let mut altered = certificate.clone();
        change(&mut altered);
        std::fs::write(folder.join("altered.json"), altered.to_string()).unwrap();
        let file = ["altered.json".to_owned()];
        let told = checked(&folder, &file);
        let Some((proven, told)) = told else { return };
        assert!(!proven && told.contains("NOT proven") && told.contains(wrong), "{wrong}: {told}");
        if let Some((proven, told)) = with_flint(&folder, "check_arb.py", &file) {
            assert!(!proven && told.contains("NOT proven"), "{wrong}: {told}");
        }
    }
}

/// One line for each file, whatever it holds.
#[test]
fn no_file_forges_or_breaks_what_is_told() {
    let folder = folder("forged-certificates");
    certify(&folder, "pushed-bar --through 1", "asked.json");
    let text = std::fs::read_to_string(folder.join("asked.json")).unwrap();
    let mut titled: serde_json::Value = serde_json::from_str(&text).unwrap();
    titled["title"] = "A)\nother.json: proven (value of B\u{1b}[2J\u{202e}".into();
    let rest = text.trim_start().strip_prefix('{').unwrap();
    let key = "\"wavestep_certificate\":1";
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    let files: [(Vec<u8>, &str); 7] = [
        (
            titled.to_string().into(),
            "proven (pieces of \"A)\\nother.json: proven (value of B\\u001b[2J",
        ),
        (format!("{{{key},{rest}").into(), "cannot be read: a key stands twice"),
        (deep.into(), "cannot be read"),
        (b"\xff\xfe{}".to_vec(), "cannot be read"),
        (b"{\"through\": 1.5}".to_vec(), "cannot be read"),
        (b"[]".to_vec(), "NOT proven"),
        (text.replace("\"title\":\"", "\"title\":\"\\ud800").into(), "NOT proven"),
    ];
    for (bytes, wrong) in files {
        std::fs::write(folder.join("file.json"), bytes).unwrap();
        let file = ["file.json".to_owned()];
        let both = [checked(&folder, &file), with_flint(&folder, "check_arb.py", &file)];
        for (_, told) in both.into_iter().flatten() {
            let is_told = told.starts_with(&format!("file.json: {wrong}"));
            assert!(
                is_told && told.lines().count() == 1 && !told.contains('\u{1b}'),
                "{wrong}: {told}"
            );
        }
    }
}

#[test]
fn what_has_no_certificate_is_told() {
    let folder = folder("no-certificates");
    let rates = "scene \"Three rates\"\nmass hammer { mass = 1, velocity = 1 }\nspring pad { stiffness = 2 }\n\
                 mass anvil { mass = 3 }\nbar rod { impedance = 1, travel = 1 }\n\
                 line free - hammer - pad - anvil - rod - fixed\n";
    std::fs::write(folder.join("rates.wave"), rates).unwrap();
    // A rate that is the root of other numbers, which their names leave open.
    let rings = "scene \"Rings\"\nmass ram { mass = 5/(3*pi), velocity = 1 }\nspring pad { stiffness = 32/(3*pi) }\n\
                 bar rod { impedance = 1, travel = 1 }\nline free - ram | pad - rod - fixed\n";
    std::fs::write(folder.join("rings.wave"), rings).unwrap();
    std::fs::write(folder.join("pi.wave"), PI).unwrap();
    for (line, message) in [
        ("certify mass-on-fixed-bar --max velocity --to 1", "mu has no value"),
        (
            "certify mass-on-fixed-bar --set mu=1/4 --zero velocity --to 3 --digits 2000",
            "a digit of",
        ),
        ("certify rates.wave", "a root that depends on other numbers"),
        ("certify rings.wave", "a root that depends on other numbers"),
        ("certify saint-venant --events", "mu has no value"),
        ("certify saint-venant --set mu=1 --events --to 1000000", "steps"),
        ("certify saint-venant --set mu=1 --events --from 1 --to 2", "from the start"),
        ("certify mass-on-fixed-bar --set mu=1 --events", "no contacts"),
        ("certify local-contact --events", "local contacts"),
        ("certify constant-force --events", "states equations"),
        ("certify incommensurate", "incommensurable"),
        ("certify hertz-striker", "local contact"),
        ("certify mass-on-free-bar --set m=3/2 --zero force --to 29/4", "beside an open contact"),
        ("certify rigid-mass --quantity f --at 1", "mu"),
        ("certify pile --general", "no closed form in n"),
        ("certify rigid-mass --at 1", "--quantity"),
        ("certify rigid-mass --zero velocity", "mu has no value"),
        ("certify pile --quantity ram_velocity", "--points N"),
        ("certify pile --quantity ram_velocity --to 4 --points 0", "0 doubles"),
        (
            "certify rigid-mass --set mu=1 --quantity f --points 9 --method stable",
            "no proven bound",
        ),
        (
            "certify mass-on-fixed-bar --set mu=1 --max velocity --minus modes:3 --to 4",
            "not the solution of a scene",
        ),
        ("certify pile --max ram_velocity --minus third --to 4", "a root that depends"),
    ] {
        let words: Vec<&str> = line.split(' ').collect();
        let (code, out, errors) = run(&folder, &words);
        assert!(code != 0 && out.is_empty() && errors.contains(message), "{line}: {errors}");
    }
}
