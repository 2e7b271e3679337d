//! The command `events`, and what other commands say of contacts that open.

use super::{anywhere, folder, run, snapshot, words};

fn output(arguments: &[&str]) -> String {
    let (code, out, told) = run(anywhere(), arguments);
    assert_eq!(code, 0, "{arguments:?}: {told}");
    out
}

fn refusal(arguments: &[&str]) -> (i32, String) {
    let (code, out, told) = run(anywhere(), arguments);
    assert!(out.is_empty());
    (code, told)
}

#[test]
fn the_time_line_reads_well() {
    for (name, line) in [
        ("events-text", "events bars-of-equal-length"),
        ("events-latex", "events bars-of-equal-length --format latex"),
    ] {
        snapshot("history", name, line, &output(&words(line)));
    }
}

#[test]
fn json_holds_exact_and_certified_numbers() {
    let text = output(&["events", "saint-venant", "--set", "mu=1", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let events = json["events"].as_array().unwrap();
    let kinds: Vec<&str> = events.iter().map(|event| event["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["impact", "opening", "closing", "opening"]);
    assert_eq!(events[0]["time"]["exact"], "0");
    assert_eq!(events[1]["time"]["decimal"], "3.06766764162");
    assert!(events[1]["time"]["radius"].is_string());
    assert_eq!(events[1]["bodies"].as_array().unwrap().len(), 2);
    assert_eq!(json["ending"]["kind"], "parted");
    assert_eq!(json["contacts"][0]["durations"].as_array().unwrap().len(), 2);
}

/// What was before an event that is told is forgotten where memory is scarce; what is told is the same.
#[test]
fn events_take_little_memory() {
    // What leaves into an endless bar keeps its energy there.
    let text = "scene \"A tube\"\nbar a { impedance = 1, travel = 3/10, velocity = 1 }\n\
        bar b { impedance = 1, travel = sqrt(2) }\nspring left { stiffness = 5 }\n\
        mass light { mass = 1/100 }\nbar c { impedance = 1 }\n\
        line free - a | b - left - light - c - endless\ncontacts open\n";
    std::fs::write(anywhere().join("tube.wave"), text).unwrap();
    for (scene, until, memory) in [("mass-that-bounces", "100", "1MB"), ("tube.wave", "20", "6MB")]
    {
        let line = ["events", scene, "--to", until];
        let scarce = output(&[&line[..], &["--memory", memory]].concat());
        assert_eq!(scarce, output(&line), "{scene}");
    }
}

/// Where no end is asked for, what is known before memory is short is told; with an end that is not reached it is refused.
#[test]
fn events_are_told_as_far_as_memory_goes() {
    let text = "scene \"A thin pulse shaper\"\nbar striker { impedance = 1, travel = 1, velocity = 1 }\n\
        bar shaper { impedance = 1/5, travel = sqrt(2)/40 }\nbar input { impedance = 1, travel = sqrt(7) }\n\
        line free - striker | shaper | input - free\ncontacts open\n";
    std::fs::write(anywhere().join("shaper.wave"), text).unwrap();
    let line = ["events", "shaper.wave", "--digits", "6", "--memory", "2MB"];
    let told = output(&line);
    assert!(told.contains("Followed until t = 5.29150; later events are not known."), "{told}");
    let all = output(&["events", "shaper.wave", "--digits", "6"]);
    let events = |text: &str| {
        let (events, _) = text.split_once("Between").unwrap();
        events
            .lines()
            .filter(|line| line.starts_with("t = "))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert!(events(&all).starts_with(&events(&told)) && events(&told).len() > 1, "{told}");
    let (code, refused) = refusal(&[&line[..], &["--to", "20"]].concat());
    assert!(code == 1 && refused.contains("more than 2 MB of memory"), "{refused}");
}

/// In the closed form the right bar pulls the left one after t = 2; across phases the left one is at rest.
#[test]
fn eval_goes_on_across_phases() {
    let arguments = |scene| ["eval", scene, "--quantity", "left", "--at", "5/2"];
    assert_eq!(output(&arguments("bars-of-equal-length")), "left(5/2) = 0\n");
    let closed = output(&["scenes", "bars-of-equal-length"]).replace("contacts open\n", "");
    let file = anywhere().join("closed.wave");
    std::fs::write(&file, closed).unwrap();
    let closed = output(&arguments(file.to_str().unwrap()));
    assert_eq!(closed, "left(5/2) = 0.5 = 1/2\n");
}

/// Doubles follow contacts that open, within a tolerance, by the two methods that need no closed form, and in C.
#[test]
fn doubles_go_on_across_phases() {
    let asked = "eval saint-venant --set mu=1 --quantity strain_impact --from 1 --to 5 --points 2 ";
    let proven = "strain_impact(1) = -0.36787944117144233\nstrain_impact(5) = 0\n";
    for how in ["--method certified", "--tol ulp:0.5"] {
        assert_eq!(output(&words(&(asked.to_owned() + how))), proven, "{how}");
    }
    for how in ["--method compiled", "--tol 1e-9"] {
        let told = output(&words(&(asked.to_owned() + how)));
        assert!(told.starts_with("strain_impact(1) = -0.36787944117"), "{told}");
    }
    let c = output(&words("export saint-venant --as c --set mu=1 --quantity velocity --to 5"));
    assert!(c.contains("double wavestep_velocity(double"), "{c}");
}

#[test]
fn what_does_not_follow_contacts_says_so() {
    let asked = "eval saint-venant --set mu=1 --quantity velocity --at 31/10 --method ";
    for method in ["stable", "marched", "expanded", "modes"] {
        let (code, told) = refusal(&words(&(asked.to_owned() + method)));
        assert_eq!(code, 1);
        assert!(
            told.contains("separate at t = 3.06766764162, and this method needs closed contacts"),
            "{told}"
        );
        assert!(told.contains("use the method compiled or certified"), "{told}");
    }
    for scene in ["pushed-bar", "rigid-mass"] {
        let told = output(&["events", scene]);
        assert!(told.ends_with("Nothing can open: there is no contact.\n"), "{told}");
    }
    let (code, told) = refusal(&["events", "saint-venant"]);
    assert!(code == 2 && told.contains("`mu` has no value"), "{told}");
}

/// Until the first opening, at t = 3.0677, the motion is that with closed contacts, and so every method and
/// model has it.
#[test]
fn methods_for_closed_contacts_serve_until_one_opens() {
    let value = |method: &str| {
        let asked = "eval saint-venant --set mu=1 --quantity velocity --at 3 --method ";
        let told = output(&words(&(asked.to_owned() + method)));
        told.trim_end().split_once("= ").unwrap().1.parse::<f64>().unwrap()
    };
    let certified = value("certified");
    for method in ["stable", "marched", "expanded", "steps:1e-12"] {
        assert!((value(method) - certified).abs() < 1e-11, "{method}");
    }
    assert!((value("leapfrog") - certified).abs() < 1e-4);
}

/// The form with closed contacts says until when it holds.
#[test]
fn derive_says_until_when_its_form_holds() {
    let line = "derive saint-venant --set mu=1 --through 1";
    let (code, _, told) = run(anywhere(), &words(line));
    assert_eq!(code, 0);
    assert_eq!(told, "note: valid until t = 3.06766764162, when hammer and rod separate\n");
}

/// Where the scene keeps contacts closed, the time line says that it opens them.
#[test]
fn closed_contacts_are_said_to_open_here() {
    let told = "Contacts open here when they would go into tension; the scene keeps them closed.";
    for (scene, closed) in [("hopkinson", true), ("hopkinson-with-release", false)] {
        assert_eq!(output(&["events", scene]).contains(told), closed, "{scene}");
    }
}

/// In scenes with units velocities are decimals, rounded where they do not end.
#[test]
fn no_fraction_is_told_with_a_unit() {
    let text = "scene \"Drill\"\nbar piston { impedance = 30 kN*s/m, travel = 60 us, velocity = 10 m/s }\n\
        bar rod { impedance = 17 kN*s/m, travel = 300 us }\nline free - piston | rod - free\ncontacts open\n";
    let folder = folder("events-units");
    std::fs::write(folder.join("drill.wave"), text).unwrap();
    let (code, out, told) = run(&folder, &words("events drill.wave --digits 6"));
    assert_eq!(code, 0, "{told}");
    assert!(out.contains("velocity 10 m/s -> 6.38298 m/s of piston"), "{out}");
    for line in out.lines().filter(|line| line.contains("velocity")) {
        assert_eq!(line.matches('/').count(), line.matches("m/s").count(), "{line}");
    }
}
