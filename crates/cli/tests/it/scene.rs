//! The built command on scenes: derivations explained, lattices, units, energies, and what is refused.

use super::{anywhere, folder, run, snapshot, words};
use std::fs;
use std::path::Path;

use serde_json::Value;
use wavestep::scenes::SCENES;

/// The standard output of a command that does its work.
fn output(arguments: &[&str]) -> String {
    let (code, stdout, stderr) = run(anywhere(), arguments);
    assert_eq!(code, 0, "{arguments:?}: {stderr}");
    stdout
}

/// Compares the output of a command with what is recorded.
fn recorded(folder: &Path, name: &str, line: &str) {
    let (code, stdout, stderr) = run(folder, &words(line));
    assert_eq!(code, 0, "{line}: {stderr}");
    snapshot("scene-command", name, line, &stdout);
}

/// The exit code and the message of a command that refuses.
fn refusal(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let (code, stdout, stderr) = run(folder, arguments);
    assert!(code != 0 && stdout.is_empty(), "{arguments:?}");
    (code, stderr)
}

/// A mass, a cushion and a bar with a fixed end: complex poles, and a node in the line.
const CUSHION: &str = "scene \"Mass and cushion\"
mass hammer { mass = 1, velocity = 1 }
spring cushion { stiffness = 1 }
bar rod { impedance = 1, travel = 1 }
line free - hammer | cushion - rod - fixed
observe force = force(cushion)
observe energy = energy(line)
observe momentum = momentum(line)
";

// ---- Derivations, as a person reads them --------------------------------------------------------

#[test]
fn every_scene_on_one_grid_is_explained() {
    for scene in SCENES.iter().filter(|scene| !scene.text.contains("recurrence \"")) {
        if ["incommensurate", "local-contact", "hertz-striker"].contains(&scene.name) {
            continue;
        }
        let text = output(&["derive", scene.name, "--explain"]);
        for heading in
            ["Waves", "Laws at ends and joints", "The recurrence", "The pieces, step by step"]
        {
            assert!(text.contains(&format!("{heading}\n---")), "{}: {heading}", scene.name);
        }
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{}", scene.name);
    }
}

#[test]
fn derivations_look_as_recorded() {
    for scene in ["mass-on-fixed-bar", "cushioned-impact", "striker-on-long-bar", "hopkinson"] {
        recorded(anywhere(), &format!("explain-{scene}"), &format!("derive {scene} --explain"));
    }
    recorded(anywhere(), "explain-latex", "derive mass-on-fixed-bar --explain --format latex");
    for scene in ["two-bars", "pulse-shape", "pile"] {
        recorded(anywhere(), &format!("explain-{scene}"), &format!("derive {scene} --explain"));
    }
    let exercise = "derive two-bars --set r=2 --exercise --piece 1";
    recorded(anywhere(), "exercise", exercise);
    recorded(anywhere(), "exercise-latex", &format!("{exercise} --format latex"));
}

/// The book's equations appear in the derivations of the twins, as the book has them.
#[test]
fn the_equations_of_the_source_are_derived() {
    for (scene, equations) in [
        // 6.76, 6.77
        ("mass-on-fixed-bar", &["g[n] = -f[n-1]", "f[n]' + f[n] = f[n-1]' - f[n-1]"][..]),
        // 6.29, 6.30, 6.31
        (
            "striker-on-long-bar",
            &[
                "f_striker[n] - g_striker[n-1] = 0",
                "f_striker[n] + g_striker[n] + 1 = f_long[n]",
                "r*f_striker[n] - r*g_striker[n] = f_long[n]",
            ],
        ),
        // 6.42
        ("pushed-bar", &["f[n] = f[n-1] + 1"]),
        // 6.58, 6.60, 6.61
        (
            "cushioned-impact",
            &[
                "f_striker[n] - g_striker[n-1] = 0",
                "f_striker[n] - g_striker[n] = 1/2*cushion[n]",
                "f_striker[n] - g_striker[n] = f_long[n]",
            ],
        ),
    ] {
        let text = output(&["derive", scene, "--explain"]);
        for equation in equations {
            let stands = text.lines().any(|line| line.trim() == *equation);
            assert!(stands, "{scene}: {equation}\n{text}");
        }
    }
}

#[test]
fn forms_look_as_recorded() {
    let folder = folder("scene-forms");
    fs::write(folder.join("cushion.wave"), CUSHION).unwrap();
    let cubic = CUSHION.replace("- rod", "- cap - rod");
    let cubic = cubic.replace("bar rod", "mass cap { mass = 1 }\nbar rod");
    fs::write(folder.join("cubic.wave"), cubic).unwrap();
    for (name, line) in [
        ("derive-complex-poles", "derive cushion.wave --quantity cushion"),
        ("derive-between-arrivals", "derive cushion.wave --quantity momentum"),
        ("derive-lattice", "derive incommensurate --quantity g_striker"),
        ("derive-lattice-latex", "derive incommensurate --quantity g_striker --format latex"),
        ("derive-named-rate", "derive pile --quantity cushion --through 1"),
        ("derive-named-cubic", "derive cubic.wave --quantity cushion --through 0"),
        ("check-scene", "check cushion.wave --verbose"),
        ("check-lattice", "check incommensurate --verbose"),
        ("scenes", "scenes"),
    ] {
        recorded(&folder, name, line);
    }
}

#[test]
fn json_is_json() {
    for arguments in [
        &["derive", "incommensurate", "--format", "json"][..],
        &["derive", "mass-on-fixed-bar", "--quantity", "momentum", "--format", "json"],
        &["eval", "hopkinson", "--quantity", "force", "--at", "400us", "--format", "json"],
    ] {
        let text = output(arguments);
        let document: Value = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{e}: {text}"));
        assert!(document["schema_version"].is_number(), "{arguments:?}");
    }
    // A strain has no unit, and its times have.
    for (quantity, unit) in [("force", "N"), ("gauge_output", "")] {
        for more in [&["--at", "400us"][..], &["--at", "400us", "--tol", "1e-9"]] {
            let arguments =
                [&["eval", "hopkinson", "--quantity", quantity, "--format", "json"], more];
            let document: Value = serde_json::from_str(&output(&arguments.concat())).unwrap();
            let told = (document["unit"].as_str(), document["time_unit"].as_str());
            assert_eq!(told, (Some(unit), Some("s")), "{quantity} {more:?}");
        }
    }
}

// ---- Numbers ------------------------------------------------------------------------------------

#[test]
fn values_and_times_have_units() {
    let at = |time: &str| output(&["eval", "hopkinson", "--quantity", "force", "--at", time]);
    let (micro, seconds) = (at("400us"), at("4e-4 s"));
    assert_eq!(micro, seconds);
    assert_eq!(at("0"), at("0 s"));
    assert!(micro.starts_with("force(0.0004 s) = ") && micro.ends_with(" N\n"), "{micro}");
}

#[test]
fn rational_values_of_scenes_are_told_exactly() {
    let folder = folder("scene-rational");
    fs::write(folder.join("cushion.wave"), CUSHION).unwrap();
    let file = folder.join("cushion.wave");
    let file = file.to_str().unwrap();
    // At the start, and before anything arrives.
    assert_eq!(output(&["eval", file, "--quantity", "force", "--at", "0"]), "force(0) = 0\n");
    let bars =
        ["eval", "striker-on-long-bar", "--set", "r=1/3", "--quantity", "force", "--at", "9"];
    assert_eq!(output(&bars), "force(9) = 0.015625 = 1/64\n");
    // Left of an arrival, and on a period of the observable.
    let left = ["eval", "pushed-bar", "--quantity", "velocity", "--at", "2", "--side", "left"];
    assert_eq!(output(&left), "velocity(2-) = 1\n");
    let before = ["eval", "stepped-striker", "--quantity", "pulse", "--at", "0", "--side", "left"];
    assert_eq!(output(&before), "pulse(0-) = 0\n");
    assert_ne!(output(&before[..6]), "pulse(0) = 0\n");
    let piece = ["eval", "pushed-bar", "--quantity", "velocity", "--piece", "1", "--local", "1/2"];
    assert_eq!(output(&piece), "velocity(5/2) = 3\n");
}

#[test]
fn statistics_go_to_standard_error() {
    let arguments = ["eval", "pushed-bar", "--quantity", "velocity", "--at", "9", "--stats"];
    let (code, stdout, stderr) = run(anywhere(), &arguments);
    assert_eq!((code, stdout.as_str()), (0, "velocity(9) = 9\n"));
    assert!(stderr.starts_with("echoes computed for velocity: "), "{stderr}");
}

// ---- What is refused ----------------------------------------------------------------------------

#[test]
fn what_scenes_cannot_be_asked_is_refused() {
    let folder = folder("scene-refused");
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    write("cushion.wave", CUSHION);
    let symbolic = CUSHION.replace("mass = 1,", "mass = m,");
    write("symbolic.wave", &symbolic.replace("\nmass", "\nsymbol m > 0\nmass"));
    write(
        "cubic.wave",
        &CUSHION
            .replace("- rod", "- cap - rod")
            .replace("bar rod", "mass cap { mass = 1 }\nbar rod"),
    );
    write(
        "two.wave",
        "scene \"Two mistakes\"\nbar a { impedance = 1, travel = x, velocity = 1 }\n\
                       mass m { mas = 1 }\nline free - a - m - free\n",
    );
    let mut report = String::new();
    for line in [
        "derive cushion.wave --quantity energy",
        "derive symbolic.wave",
        "derive incommensurate --general",
        "derive incommensurate --piece 2",
        "derive incommensurate --through 500",
        "derive pushed-bar --explain --format json",
        "derive two.wave",
        "eval hopkinson --quantity force --at 3mm",
        "eval pushed-bar --quantity velocity --at 1e9",
        "eval incommensurate --quantity energy --at 1000s",
        "eval pushed-bar --quantity velocty --at 1",
        "eval hopkinson --quantity force --at 1",
    ] {
        let arguments: Vec<&str> = line.split(' ').collect();
        let (code, message) = refusal(&folder, &arguments);
        report.push_str(&format!("$ wavestep {line}\n{message}[exit {code}]\n\n"));
    }
    snapshot("scene-command", "refusals", "the commands in it", &report);
    // What the exact form cannot hold is a number all the same.
    let energy = run(&folder, &["eval", "cubic.wave", "--quantity", "energy", "--at", "7"]);
    assert_eq!(energy.1, "energy(7) = 0.500000000000000\n");
}

const PILE: &str = r#"scene "My pile"
material steel { modulus = 210 GPa, density = 7850 kg/m^3 }
mass ram { mass = 8000 kg, velocity = sqrt(2*9.81*1.2) m/s }
spring cushion { stiffness = 2 GN/m }
mass helmet { mass = 1200 kg }
bar p1 { material = steel, diameter = 610 mm, inner_diameter = 580 mm, length = 10 m }
support s1 { damping = 50 kN*s/m }
bar p2 { material = steel, diameter = 610 mm, inner_diameter = 580 mm, length = 10 m }
support s2 { damping = 50 kN*s/m }
bar p3 { material = steel, diameter = 610 mm, inner_diameter = 580 mm, length = 10 m }
support toe { damping = 200 kN*s/m, stiffness = 100 MN/m }
line free - ram | cushion - helmet - p1 - s1 - p2 - s2 - p3 - toe - free
observe v_head = velocity(p1.left)
"#;

/// Three rates of one node, roots of no quadratic, have names in the pieces and numbers above them; orders whose
/// formulas are long are left out where none are asked for, and refused after the first of them.
#[test]
fn pieces_with_named_rates_are_told_while_they_are_short() {
    let folder = folder("named-rates");
    fs::write(folder.join("dashpots.wave"), PILE).unwrap();
    let springs = PILE.replace("50 kN*s/m }", "50 kN*s/m, stiffness = 20 MN/m }");
    fs::write(folder.join("springs.wave"), springs).unwrap();
    for (file, last) in [("dashpots.wave", 1), ("springs.wave", 0)] {
        let (code, out, told) = run(&folder, &["derive", file]);
        assert_eq!(code, 0, "{told}");
        for number in
            ["m_ram = 3.63465", "kappa_cushion = 3.39666", "rho = 0.253412", "omega = 2.47778"]
        {
            assert!(out.contains(&format!("# {number}\n")), "{out}");
        }
        assert!(out.contains(&format!("g_p1[{last}](s) = ")), "{out}");
        assert!(!out.contains(&format!("g_p1[{}](s) = ", last + 1)), "{file}");
        let long = format!("with names for these the echoes of order {} have ", last + 1);
        assert!(told.contains(&long) && told.contains("--through N derives more"), "{told}");
    }
    let (code, _, told) = run(&folder, &["derive", "springs.wave", "--through", "2"]);
    let remedy = "derive through that order, or evaluate it";
    assert!(code == 1 && told.contains("echoes of order 1 have at least "), "{told}");
    assert!(told.contains(remedy), "{told}");
    let (_, out, _) =
        run(&folder, &["derive", "dashpots.wave", "--wave", "f_p1", "--through", "0"]);
    let below = "(5*(400 - 360*m_ram*rho + 36*m_ram^2*omega^2 + 81*m_ram^2*rho^2)";
    let piece = format!(
        "f_p1[0](s) = 144*kappa_cushion*m_ram*sqrt(109)*sqrt(3)*sqrt(5)/{below})*exp(-rho*s)
    - 144*kappa_cushion*m_ram*sqrt(109)*sqrt(3)*sqrt(5)/{below})*exp(-s*(20 - 3*m_ram*rho)/(6*m_ram))*cos(omega*s)
    - 24*kappa_cushion*sqrt(109)*sqrt(3)*sqrt(5)*(20 - 9*m_ram*rho)/{below}*omega)\
        *exp(-s*(20 - 3*m_ram*rho)/(6*m_ram))*sin(omega*s)"
    );
    assert!(out.contains(&piece), "{out}");
    // The piece in numbers is the velocity of the head until a wave returns.
    let (m, kappa, rho, omega, s) = (3.63465_f64, 3.39666, 0.253412, 2.47778, 0.75_f64);
    let below =
        5.0 * (400.0 - 360.0 * m * rho + 36.0 * (m * omega).powi(2) + 81.0 * (m * rho).powi(2));
    let decay = (-s * (20.0 - 3.0 * m * rho) / (6.0 * m)).exp();
    let slow = 144.0 * m * ((-rho * s).exp() - decay * (omega * s).cos());
    let fast = 24.0 * (20.0 - 9.0 * m * rho) / omega * decay * (omega * s).sin();
    let velocity = kappa * 1635_f64.sqrt() / below * (slow - fast);
    let time = format!("{}s", s * 0.00193342);
    let (_, out, _) =
        run(&folder, &["eval", "dashpots.wave", "--quantity", "v_head", "--at", &time]);
    let value = out.split_once("= ").unwrap().1.trim_end_matches(" m/s\n").parse::<f64>().unwrap();
    assert!((velocity - value).abs() < 1e-4 * value, "{velocity} {out}");
}

/// At a free end the force is that of the loads there: before they begin and after they end it is exactly zero,
/// though echoes without a common measure go on, and whether or not contacts open.
#[test]
fn the_force_at_a_free_end_is_that_of_its_load() {
    let folder = folder("ended-load");
    let text = "scene \"Pulse\"\nbar a { impedance = 1, travel = 1 }\n\
                bar b { impedance = 2, travel = sqrt(2) }\n\
                load push { force = exp(-t)*t, from = 1/2, until = 2 }\n\
                line free - push - a | b - free\nobserve end = force(a.left)\n";
    fs::write(folder.join("closed.wave"), text).unwrap();
    fs::write(folder.join("open.wave"), text.to_owned() + "contacts open\n").unwrap();
    for scene in ["closed.wave", "open.wave"] {
        for (time, value) in [
            ("0", "0"),
            ("1/4", "0"),
            ("1/2", "0.30326533"),
            ("1", "0.36787944"),
            ("2", "0"),
            ("5", "0"),
        ] {
            let line = format!("eval {scene} --quantity end --digits 8 --at {time}");
            assert_eq!(
                run(&folder, &words(&line)).1,
                format!("end({time}) = {value}\n"),
                "{scene}"
            );
        }
        let line = format!("eval {scene} --quantity end --digits 8 --at 2 --side left");
        assert_eq!(run(&folder, &words(&line)).1, "end(2-) = 0.27067057\n");
        let (_, out, _) = run(&folder, &words(&format!("find {scene} --zero end --from 0 --to 3")));
        let zeros =
            "end = 0 for 0 <= t < 1/2 (identically)\nend = 0 for 2 <= t <= 3 (identically)\n";
        assert!(out.starts_with(zeros), "{out}");
    }
}
