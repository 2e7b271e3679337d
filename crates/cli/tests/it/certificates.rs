//! Certificates of the shipped scenes are verified by two checkers that share nothing with the program, and altered ones are
//! not. Left out where there is no Python; the second checker, where `.ci/run` could not install python-flint.

use super::{ROOT, folder, run};
use std::path::Path;
use std::process::Command;
use wavestep::scenes::SCENES;

/// Shipped scenes that have no periods, and so no certificates of pieces.
const WITHOUT: [&str; 3] = ["incommensurate", "local-contact", "hertz-striker"];

/// Scenes that have certificates of their pieces.
pub(super) fn certified() -> impl Iterator<Item = &'static str> {
    SCENES.iter().map(|scene| scene.name).filter(|name| !WITHOUT.contains(name))
}

/// Values of waves and of observables, with delays, forcing, roots and slopes among them.
pub(super) const VALUES: [&str; 8] = [
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
pub(super) const WINDOWS: [&str; 11] = [
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

/// How far quantities are from those of simpler scenes: without waves, endless, with other numbers; a line and its equations.
pub(super) const DISTANCES: [&str; 5] = [
    "mass-on-fixed-bar --set mu=1/10 --distance velocity --minus third --to 1",
    "mass-on-fixed-bar --set mu=1 --distance strain_impact --minus endless:rod.right --to 4 --digits 6",
    "pile --distance ram_velocity --minus without:toe --to 4 --digits 6",
    "struck-free-bar --set mu=1 --max velocity --minus endless:rod.right --to 4 --digits 9",
    "mass-on-fixed-bar --set mu=1 --max velocity --minus rigid-mass --to 3",
];

/// The same where a checker follows two motions: with units, waves in one of them only, contacts that open in both or in one.
pub(super) const APART: [&str; 3] = [
    "pile --distance toe_force --minus rigid:pile --to 4 --digits 9",
    "hopkinson --max force --minus spring:striker --to 400us",
    "saint-venant --set mu=1 --distance velocity --minus mass-on-fixed-bar --to 4 --digits 9",
];

/// The same of energies and displacements, with named rates, with other travel times, and zeros.
const MORE_APART: [&str; 8] = [
    "pile --min ram_velocity --minus third --to 4",
    "pile --distance energy --minus without:toe --to 3",
    "hopkinson --distance energy --minus spring:striker --to 100us --digits 9",
    "percussive-drill --distance penetration --minus rigid:piston --to 300us --digits 9",
    "incommensurate --distance contact_force --minus rigid:striker --to 100us",
    "blow.wave --distance top --minus slow.wave --to 7ms --digits 9",
    "blow.wave --zero toe --minus slow.wave --to 5ms --digits 9",
    "nice.wave --distance f --minus late.wave --to 3",
];

/// Doubles: correctly rounded, within a tolerance, by a method with a bound of its own.
pub(super) const DOUBLES: [&str; 3] = [
    "rigid-mass --set mu=1 --quantity velocity --to 6 --points 30",
    "mass-on-fixed-bar --set mu=1/4 --quantity strain_fixed --from 1/3 --to 6 --points 20 --tol 1e-6",
    "pile --quantity toe_force --to 6 --points 30 --method compiled",
];

/// Events: separation, touching without force, rebound; at jumps and at zero crossings.
pub(super) const EVENTS: [&str; 4] = [
    "saint-venant --set mu=1 --events --to 5 --digits 9",
    "bars-of-unequal-length --events --to 6",
    "bars-that-part --set r=1/2 --events --to 3",
    "cushion-with-release --set mu=1 --events --to 4 --digits 9",
];

/// A number that is no root.
const PI: &str = "scene \"Pi\"\nmass ram { mass = 1, velocity = pi }\nbar rod { impedance = 1, travel = 1 }\n\
                  line free - ram - rod - fixed\nobserve v = velocity(ram)\n";

/// Values that are no sums of pieces: where contacts open, with units, of displacements, springs and supports.
pub(super) const READINGS: [&str; 4] = [
    "saint-venant --set mu=1 --quantity velocity --at 5",
    "hopkinson --quantity gauge_incident --at 1ms --digits 9",
    "cushion-with-release --set mu=1 --quantity compression --at 3",
    "mass-that-bounces --quantity displacement --at 4",
];

/// Doubles and extrema of the same.
pub(super) const EXTREMES: [&str; 3] = [
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
pub(super) const CONTENTS: &str = "scene \"Contents\"\nbar a { impedance = 1, travel = 1, velocity = 1, strain = 1/5 }\n\
    bar b { impedance = 2, travel = 3/2, velocity = -1/3 }\nmass m { mass = 2, velocity = -1/3 }\n\
    spring k { stiffness = 3, damping = 1/4 }\nsupport u { stiffness = 1/2, damping = 1/5 }\nbar c { impedance = 3 }\n\
    line free - a | b - m - k - u - c - endless\ncontacts open\n\
    observe in_bars = energy(a) - 2*energy(c)\nobserve in_others = energy(m) + energy(k) + energy(u)\n\
    observe all = energy(line)\nobserve push = momentum(line)\nobserve other = momentum(a) - momentum(c)\n\
    observe passed = work(a.at(1/3)) - work(b.right) + 2*work(c.left)\nobserve done = work(k) + work(u) - energy(m)\n";

const MORE_CONTENTS: [&str; 12] = [
    "contents.wave --quantity in_bars --at 29/8",
    "contents.wave --min in_others --to 3",
    "contents.wave --max all --to 2",
    "contents.wave --quantity push --at 4",
    "contents.wave --zero other --to 3",
    "contents.wave --quantity all --points 4 --to 3",
    "contents.wave --quantity passed --at 7/2",
    "contents.wave --min done --to 5/2",
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

/// A bar hits another one after a gap, which is pressed against a spring after a second one; in units.
const GAPS: &str = "scene \"Gaps\"\nmaterial steel { modulus = 200 GPa, density = 8000 kg/m^3 }\n\
    bar a { material = steel, diameter = 20 mm, length = 200 mm, velocity = 7 m/s }\n\
    bar b { material = steel, diameter = 15 mm, length = 300 mm }\nmass m { mass = 1 kg }\n\
    spring k { stiffness = 40 kN/mm, damping = 1 kN*s/m }\n\
    line free - a |0.1 mm| b - m |1/100*sqrt(2) mm| k - fixed\ncontacts open\n\
    observe f = force(b.left)\nobserve w = work(k) + work(b.at(1/2))\n";

const ACROSS_GAPS: [&str; 3] = [
    "gaps.wave --events --to 200us",
    "gaps.wave --max f --to 200us",
    "gaps.wave --quantity w --at 200us",
];

const BLOWS: [&str; 5] = [
    "blow.wave --events --to 10ms",
    "blow.wave --max top --to 10ms",
    "blow.wave --quantity toe --at 3ms",
    "blow.wave --quantity top --points 4 --to 8ms",
    "blow.wave --zero toe --to 4ms",
];

/// Loads that begin and end smoothly or not, with zeros at simple times; an endless bar is at rest when they have ended.
const PULSES: [&str; 5] = [
    "sin(pi*t), until = 1",
    "sin(2*pi*t), until = 1",
    "1 - cos(2*pi*t), until = 1",
    "sin(pi*t), from = 1, until = 3",
    "sin(pi*t), until = 3/2",
];

/// Zeros of what is read: between arrivals, with a rest before, a force that begins again and ends where its contact opens.
pub(super) const ZEROS: [&str; 3] = [
    "mass-that-bounces --zero strain_fixed --to 6",
    "saint-venant --set mu=1 --zero velocity --to 4 --digits 9",
    "cushion-with-release --set mu=1 --zero force",
];

/// The same with units, of displacements, at irrational arrivals, with many digits.
const MORE_ZEROS: [&str; 11] = [
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
    "crossing.wave --zero d --to 5/2",
];

/// The same later, between jumps, with more digits.
const MORE_READINGS: [&str; 9] = [
    "incommensurate --quantity contact_force --at 200us",
    "hopkinson --quantity force --at 1ms --digits 30",
    "hopkinson --quantity compression --at 200us",
    "hopkinson-with-release --quantity gauge --at 500us",
    "percussive-drill --quantity penetration --at 1ms",
    "saint-venant --set mu=1/4 --quantity strain_fixed --at 17/4",
    "bars-of-unequal-length --quantity right --at 11/2",
    "pi.wave --quantity v --at 1",
    "long.wave --quantity f --at 90 --digits 5",
];

/// A heavy mass on a short bar: balls grow with each of many passages.
const LONG: &str = "scene \"Long\"\nmass a { mass = 3, velocity = 1 }\nbar r { impedance = 1, travel = 1/4 }\n\
    line free - a - r - fixed\nobserve f = force(r.right)\n";

/// The same with units, a load, a release that ends, several contacts; longer windows.
const MORE_EVENTS: [&str; 11] = [
    "saint-venant --set mu=1/10 --events --to 12 --digits 30",
    // Numbers of more than a thousand bits.
    "saint-venant --set mu=1 --events --to 5 --digits 260",
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

pub(super) fn with_flint(
    folder: &Path,
    script: &str,
    arguments: &[String],
) -> Option<(bool, String)> {
    run_script(folder, &format!("{ROOT}/{FLINT}"), script, arguments)
}

/// What the first checker says.
pub(super) fn checked(folder: &Path, arguments: &[String]) -> Option<(bool, String)> {
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
        .chain(ZEROS)
        .chain(APART);
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
    std::fs::write(folder.join("gaps.wave"), GAPS).unwrap();
    std::fs::write(folder.join("long.wave"), LONG).unwrap();
    std::fs::write(folder.join("crossing.wave"), CROSSING).unwrap();
    // A longer pile of another wave speed, and a load that ends later.
    let slow = BLOW.replace("10 m", "11 m").replace("density = 7850", "density = 8000");
    std::fs::write(folder.join("slow.wave"), slow).unwrap();
    std::fs::write(folder.join("late.wave"), NICE.replace("1 - t, until = 3", "1 - t/2")).unwrap();
    let lines = MORE_EVENTS.iter().chain(&MORE_READINGS).chain(&MORE_EXTREMES).chain(&MORE_ZEROS);
    std::fs::write(folder.join("contents.wave"), CONTENTS).unwrap();
    let mut pulses = Vec::new();
    for (i, pulse) in PULSES.iter().enumerate() {
        let text = format!(
            "scene \"Pulse {i}\"\nbar rod {{ impedance = 1 }}\nload blow {{ force = {pulse} }}\n\
             line free - blow - rod - endless\nobserve v = velocity(blow)\n"
        );
        std::fs::write(folder.join(format!("pulse{i}.wave")), text).unwrap();
        pulses.extend(["--zero", "--min"].map(|goal| format!("pulse{i}.wave {goal} v --to 6")));
    }
    let pulses: Vec<&str> = pulses.iter().map(String::as_str).collect();
    let lines = lines
        .chain(&BLOWS)
        .chain(&ACROSS_GAPS)
        .chain(&MORE_CONTENTS)
        .chain(&MORE_APART)
        .chain(&pulses);
    let files = lines.enumerate().map(|(i, line)| {
        certify(&folder, line, &format!("{i}.json"));
        format!("{i}.json")
    });
    assert_proven(&folder, &files.collect::<Vec<_>>());
}

/// Contacts between all that can stand beside them: walls, supports, springs with and without dampers, loads that end,
/// oscillate and decay, with high powers, several contacts, what settles at one instant, a spring in front of a mass, a contact
/// that pushes again when the window ends; and places that move as a load says, alone between two contacts, too.
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
        "bar a { impedance = 1, travel = 1, velocity = 1 }\nmass m { mass = 1 }\nsupport u { stiffness = 1 }\n\
         support w { stiffness = 1/4 }\nline free - a - m | u - w - free\n",
        "bar a { impedance = 1, travel = 1, velocity = 1 }\nsupport u { stiffness = 3 }\n\
         bar b { impedance = 1, travel = 1 }\nline free - a | u | b - free\n",
        "load p { force = 1 - (t/3)^60 }\nmass m { mass = 1 }\nmass h { mass = 2 }\nbar r { impedance = 1, travel = 1 }\n\
         line free - p - m | h - r - free\n",
        "bar a { impedance = 1, travel = 1, velocity = 2/3 }\nbar b { impedance = 1, travel = 7 }\n\
         spring s { stiffness = 3 }\nmass m { mass = 1, velocity = -1/3 }\nline free - a | b | s - m - free\n",
        "load p { velocity = sin(2*t), from = 1/2, until = 5 }\nspring s { stiffness = 2, damping = 1/3 }\n\
         mass m { mass = 1/3 }\nbar a { impedance = 1, travel = 1 }\nbar b { impedance = 2, travel = 3/2 }\n\
         line free - p | s - m - a |1/5| b - free\n",
        "bar a { impedance = 1, travel = 1, velocity = 1 }\nload p { velocity = (1 + t)*exp(-t)/4, from = 1/3, until = 4 }\n\
         bar b { impedance = sqrt(2), travel = 3/4 }\nsupport u { stiffness = 1 }\nline free - a | p | b - u - free\n",
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
            // Those of whole elements take checkers longer.
            let is_whole = ["energy", "momentum"].contains(&quantity);
            let [of_questions, of_windows] = if is_whole { [1..2, 1..2] } else { [0..3, 0..3] };
            for asked in questions[of_questions].iter().chain(&windows[of_windows]) {
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

/// A mass on a local contact that opens, with the exponent of a cone.
pub(super) const BOUNCE: &str = "scene \"Bounce\"\nmass m { mass = 1/2, velocity = 1 }\nhertz k { stiffness = 3, exponent = 2 }\n\
    bar rod { impedance = 2 }\nline free - m - k - rod - endless\nobserve v = velocity(m)\nobserve force = force(k)\n\
    observe gauge = velocity(rod.at(1))\nobserve compression = compression(k)\n";

/// What is zero and falls just where a wave arrives and a load ends; without `q` it turns round there.
pub(super) const CROSSING: &str = "scene \"Crossing\"\nload p { force = 1, until = 2 }\nload q { force = -1, from = 2, until = 3 }\n\
    bar rod { impedance = 1, travel = 1 }\nline free - p - q - rod - free\n\
    observe d = displacement(rod.left) - displacement(rod.right)\n";

/// A spring that does not pull stands for a local contact with the exponent one; beside it a contact that opens as well.
const UNILATERAL: &str = "scene \"Unilateral\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\nbar c { impedance = 1, travel = 1 }\n\
    hertz k { stiffness = 3, exponent = 1 }\nbar b { impedance = 2 }\nline free - a | c - k - b - endless\n\
    observe v = velocity(c.left)\ncontacts open\n";

/// Values while a local contact is pressed, opens and is open, where its beginning arrives as an echo, and extrema.
#[test]
fn motions_beside_local_contacts_are_verified() {
    let folder = folder("certificates-of-local-contacts");
    std::fs::write(folder.join("bounce.wave"), BOUNCE).unwrap();
    std::fs::write(folder.join("unilateral.wave"), UNILATERAL).unwrap();
    let lines = [
        "local-contact --quantity force --at 50us --digits 20",
        "hertz-striker --quantity gauge --at 90us --digits 6",
        "bounce.wave --quantity gauge --at 3 --digits 6",
        "bounce.wave --zero v --to 1 --digits 6",
        "bounce.wave --zero compression --to 2 --digits 6",
        "bounce.wave --max force --to 1 --digits 6",
        "unilateral.wave --quantity v --at 5/2 --digits 6",
    ];
    let files = lines.iter().enumerate().map(|(i, line)| {
        certify(&folder, line, &format!("{i}.json"));
        format!("{i}.json")
    });
    assert_proven(&folder, &files.collect::<Vec<_>>());
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

/// The balls of the first checker hold what they stand for.
#[test]
fn numbers_of_the_checker_are_enclosed() {
    let folder = folder("enclosed-numbers");
    let Some((passed, told)) =
        run_script(&folder, "python3", "inclusions.py", &["2000".to_owned()])
    else {
        return;
    };
    assert!(passed && told.contains(" results, all enclosed"), "{told}");
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
    let steep = BOUNCE.replace("exponent = 2", "exponent = 1/2");
    std::fs::write(folder.join("steep.wave"), steep).unwrap();
    let contents = format!("{BOUNCE}observe energy = energy(k)\n");
    std::fs::write(folder.join("contents.wave"), contents).unwrap();
    std::fs::write(folder.join("touching.wave"), CROSSING.replace("force = -1", "force = 1"))
        .unwrap();
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
        ("certify local-contact --events", "events of local contacts"),
        ("certify steep.wave --quantity force --at 1", "exponent below 1"),
        ("certify contents.wave --quantity energy --at 1", "energy of local contacts"),
        ("certify contents.wave --zero force --to 2 --digits 6", "what begins flat"),
        ("certify touching.wave --zero d --to 5/2", "the sign where a wave arrives"),
        ("certify constant-force --events", "states equations"),
        ("certify incommensurate", "incommensurable"),
        ("certify hertz-striker", "local contact"),
        ("certify mass-on-free-bar --set m=3/2 --zero force --to 29/4", "beside an open contact"),
        ("certify rigid-mass --quantity f --at 1", "mu"),
        ("certify pile --general", "no closed form in n"),
        (
            "certify saint-venant --set mu=1 --distance velocity --minus saint-venant --to 5 --digits 6",
            "change at one time that is not rational",
        ),
        (
            "certify stepped-striker --zero momentum --minus rigid:nose --to 5",
            "equal for a while, and not zero",
        ),
        ("certify rigid-mass --at 1", "--quantity"),
        ("certify rigid-mass --set mu=1 --quantity f --at 1,2", "for one time"),
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
    ] {
        let words: Vec<&str> = line.split(' ').collect();
        let (code, out, errors) = run(&folder, &words);
        assert!(code != 0 && out.is_empty() && errors.contains(message), "{line}: {errors}");
    }
}
