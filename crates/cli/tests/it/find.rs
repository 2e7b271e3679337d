//! `wavestep find`: how answers look, that equal extrema meet where they should, and what is refused.

use super::{anywhere, run, snapshot, words};
use num_rational::BigRational;
use wavestep::language::{Source, parse_number, read_recurrence};
use wavestep::scenes;
use wavestep::signal::{ClosedSignal, Limit, digits};
use wavestep::solution::Solution;

const BITS: u64 = 1 << 12;

fn number(text: &str) -> BigRational {
    parse_number(text).unwrap()
}

#[test]
fn answers_look_as_recorded() {
    for (name, line) in [
        ("roots", "rigid-mass --set mu=1 --zero strain_impact --from 2 --to 4"),
        ("silence", "rigid-mass --set mu=1 --zero strain_fixed --from 0 --to 6 --digits 9"),
        ("level", "hopkinson --level force=10kN --from 0 --to 350us"),
        ("csv", "rigid-mass --set mu=1 --level velocity=1/2 --from 0 --to 6 --format csv"),
        ("csv-largest", "hopkinson --max force --to 500us --digits 8 --format csv"),
        ("side", "rigid-mass --set mu=1 --max strain_impact --from 2 --to 4 --digits 8"),
        ("critical", "cushioned-impact --set mu=1 --max force --from 0 --to 8"),
        ("plateau", "pushed-bar --max velocity --from 0 --to 9"),
        (
            "equal",
            "rigid-mass --min strain_fixed --equal mu=1/10..1 --between 3*mu,5*mu,7*mu --digits 6",
        ),
    ] {
        let (code, text, errors) = run(anywhere(), &words(&format!("find {line}")));
        // This window reaches beyond the end of what is true of its contact.
        let note = match name {
            "critical" => {
                "note: from t = 3.37156268062 on, the contact between striker and cushion is in tension; \
                 add `contacts open` and it opens instead\n"
            }
            _ => "",
        };
        assert_eq!((code, errors.as_str()), (0, note), "{line}");
        snapshot("find", name, &format!("find {line}"), &text);
    }
    let line = "find rigid-mass --set mu=1 --zero strain_impact --from 2 --to 4 --format json";
    let told: serde_json::Value = serde_json::from_str(&run(anywhere(), &words(line)).1).unwrap();
    assert_eq!(told["roots"][0]["time"]["decimal"], "3.06766764161831");
    assert_eq!(told["roots"][1]["time"]["exact"], "4");
}

/// Which scene is at fault is told, and values go to the scenes that have a symbol for them.
#[test]
fn differences_of_two_scenes_are_told() {
    // One bar is fixed, the other free, which a mass feels when the first front is back, at 2 of its time.
    let line = "find mass-on-fixed-bar --minus mass-on-free-bar --max velocity --to 3 --set mu=1/4 --set m=1/4";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert_eq!((code, errors.as_str()), (0, ""), "{text}{errors}");
    assert!(text.starts_with("largest velocity - velocity of mass-on-free-bar = "), "{text}");
    // Equations of the same motion.
    let line = "find mass-on-fixed-bar --minus rigid-mass --max velocity --to 3 --set mu=1/4";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert_eq!((code, errors.as_str()), (0, ""), "{text}{errors}");
    assert!(text.starts_with("largest velocity - velocity of rigid-mass = 0 in"), "{text}");
    for (line, reason, remedy) in [
        ("--minus hopkinson --max velocity", "neither a wave nor an observable of", "energy"),
        ("--minus nowhere --max velocity", "the scene `nowhere` cannot be read", "name a file"),
        ("--minus saint-venant --max velocity --set nu=1", "nu", "mu"),
    ] {
        let line = format!("find mass-on-fixed-bar {line} --to 1 --set mu=1/4");
        let (code, text, errors) = run(anywhere(), &words(&line));
        assert!(code == 2 && text.is_empty(), "{line}: {code} {text} {errors}");
        assert!(errors.contains(reason) && errors.contains(remedy), "{line}: {errors}");
    }
}

/// `e^{−2μ} = 4μ` where the largest strains at the fixed end in two periods are equal.
#[test]
fn equal_extrema_meet_where_the_formula_says() {
    let line = "find rigid-mass --min strain_fixed --equal mu=1/10..1 --between 3*mu,5*mu,7*mu \
                --digits 12 --format json";
    let (code, text, _) = run(anywhere(), &words(line));
    assert_eq!(code, 0);
    let told: serde_json::Value = serde_json::from_str(&text).unwrap();
    let [low, high] = ["low", "high"].map(|key| number(told[key].as_str().unwrap()));
    // e^{−2μ} is f(2μ) before the first return.
    let above = |mu: &BigRational| {
        let source = Source::new("rigid-mass", scenes::find("rigid-mass").unwrap().text).unwrap();
        let values = [("mu".to_owned(), mu.clone())].into();
        let rigid = Solution::new(read_recurrence(&source, &values).unwrap());
        let f = rigid.recurrence().observation("f").unwrap();
        let at = mu * number("2");
        let f = ClosedSignal::of_recurrence(&rigid, &f, [&at, &at]).unwrap();
        let e = digits(&f, &at, Limit::Left, 30, BITS).unwrap();
        e.decimal(30).0.to_rational() > mu * number("4")
    };
    assert!(above(&low) && !above(&high));
    assert!(&high - &low < &low * number("1e-12"));
}

#[test]
fn undecided_roots_end_with_code_3_and_a_report() {
    let file = anywhere().join("double.wave");
    let text = "recurrence \"Double\"\nperiod 2, local s, time t\nwave f\nequation f[n] = f[n-1]\n\
                observe q = f[n] + (t^2 - 1/2)^2\n";
    std::fs::write(file, text).unwrap();
    let (code, text, errors) = run(anywhere(), &words("find double.wave --zero q --from 0 --to 1"));
    assert_eq!(code, 3);
    assert!(text.contains("undecided; the difference is") && text.contains("0 roots, 1 undecided"));
    assert!(errors.contains("error: 1 interval stays undecided"));
}

/// The force between two long bars rises to a limit, from which it is soon no longer told apart: its digits are known all
/// the same, and the interval somewhere in which it is largest is one.
#[test]
fn a_force_that_approaches_its_limit_has_a_largest_value() {
    for to in ["1ms", "1s", "1e6s"] {
        let command = format!("find local-contact --max force --to {to} --digits 12");
        let (code, text, errors) = run(anywhere(), &words(&command));
        assert_eq!((code, errors.as_str()), (0, ""));
        let lines: Vec<&str> = text.lines().collect();
        // Half the impedance times 5 m/s.
        assert!(lines[0].starts_with("largest force = 31888.5195399 N in "), "{text}");
        assert!(lines[1].starts_with("somewhere in 0.0009"), "{text}");
        assert!(lines[2].ends_with("s (end of the window)") && lines.len() == 4, "{text}");
    }
}

/// A drill whose bit rests on the rock; what is seen of it stands in lines below.
const DRILL: &str = "scene \"A drill\"\n\
    material steel { modulus = 206 GPa, density = 7850 kg/m^3 }\n\
    bar piston { material = steel, diameter = 4 cm, length = 30 cm, velocity = 10 m/s }\n\
    bar rod { material = steel, diameter = 4 cm, length = 3 m }\n\
    mass bit { mass = 1.2 kg }\n\
    spring rock { stiffness = 200 kN/mm, damping = 5 kN*s/m }\n\
    line free - piston | rod - bit | rock - fixed\n\
    contacts open\n\
    observe push = force(rock)\n\
    observe depth = compression(rock)\n\
    observe energy = energy(line)\n";

/// Ram, cushion and helmet decay together at rates that have names.
const PILE: &str = "scene \"A pile\"\n\
    mass ram { mass = 2, velocity = 1 }\n\
    spring cushion { stiffness = 3, damping = 1/5 }\n\
    mass helmet { mass = 1 }\n\
    bar pile { impedance = 1, travel = 2 }\n\
    support toe { damping = 1/2, stiffness = 2 }\n\
    line free - ram | cushion - helmet - pile - toe - free\n\
    observe speed = velocity(pile.right)\n\
    observe depth = displacement(pile.right)\n";

/// Exactly zero until the first wave arrives, and behind it like a power of the time since then: of the first order for
/// velocities of what has a mass before it, of the second for displacements.
#[test]
fn what_rises_from_zero_behind_an_arrival_is_decided() {
    for (name, text, quantity, to) in [
        ("rests", DRILL, "push", "1ms"),
        ("rests", DRILL, "depth", "1ms"),
        ("driven", PILE, "speed", "4"),
        ("driven", PILE, "depth", "4"),
    ] {
        std::fs::write(anywhere().join(format!("{name}.wave")), text).unwrap();
        let line = format!("find {name}.wave --zero {quantity} --to {to}");
        let (code, text, errors) = run(anywhere(), &words(&line));
        assert_eq!(code, 0, "{line}: {text}{errors}");
        assert!(!errors.contains("assuming"), "{line}: {errors}");
        assert!(text.starts_with(&format!("{quantity} = 0 for 0")), "{text}");
        assert!(text.contains("(identically)") && text.contains(", 0 undecided;"), "{text}");
    }
}

/// The bodies part and meet at instants that both scenes share, and that no precision tells apart.
#[test]
fn distances_are_told_where_two_scenes_change_at_one_instant() {
    std::fs::write(anywhere().join("parts.wave"), DRILL).unwrap();
    let line = "find parts.wave --distance energy --minus without:bit --to 2ms --digits 9";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert_eq!((code, errors.as_str()), (0, ""), "{text}");
    assert!(text.starts_with("energy: largest difference from without:bit = "), "{text}");
    assert!(text.contains("of the largest value\nat t = ") && !text.contains('±'), "{text}");
}

#[test]
fn mistakes_are_told_with_a_remedy() {
    for (line, code, message, remedy) in [
        ("rigid-mass --set mu=1 --zero f --from 4 --to 2", 2, "window", "--from before --to"),
        ("rigid-mass --set mu=1 --zero f --from 2 --to 2", 2, "window", "--from before --to"),
        (
            "rigid-mass --set mu=1 --zero strain_fix --from 0 --to 2",
            2,
            "strain_fix",
            "strain_fixed",
        ),
        ("rigid-mass --zero f --from 0 --to 2", 2, "mu has no value", "--set mu=1"),
        ("rigid-mass --set mu=1 --level f --from 0 --to 2", 2, "not of the form", "QUANTITY=VALUE"),
        (
            "rigid-mass --set mu=1 --level f= --from 0 --to 2",
            2,
            "not of the form",
            "QUANTITY=VALUE",
        ),
        ("rigid-mass --set mu=1 --zero f --from 0 --to 1e9", 1, "echoes arrive", "earlier time"),
        ("rigid-mass --set mu=1 --zero f --from -1 --to 1", 2, "before the start", "from 0 on"),
        ("rigid-mass --set mu=1 --zero f --from 0 --to 1 --digits 0", 2, "0 significant", "1 to"),
        ("rigid-mass --set mu=1 --zero f --max g --from 0 --to 1", 2, "cannot be used", "--help"),
        ("rigid-mass --set mu=1 --from 0 --to 1", 2, "required", "--help"),
        ("hopkinson --level force=1mm --from 0 --to 1us", 2, "force", "N"),
        ("rigid-mass --max f --equal mu --between 1,2,3", 2, "not a symbol", "LOW..HIGH"),
        ("rigid-mass --max f --equal mu=2..1 --between 1,2,3", 2, "empty", "lower bound"),
        ("rigid-mass --max f --equal mu=1..2 --between 1,2", 2, "three times", "T1,T2,T3"),
        (
            "rigid-mass --max f --equal mu=1..2 --between 3,2,4",
            2,
            "not in ascending order",
            "T1 < T2",
        ),
        ("rigid-mass --max f --equal mu=1..2 --between 1,2,x*mu", 2, "not a number", "but mu"),
        ("rigid-mass --max f --equal mu=1..2 --between 1/9,1/8,1/7", 2, "both ends", "a range in"),
        (
            "rigid-mass --max f --equal mu=1..2 --between 1,2,3 --digits 99",
            2,
            "too many",
            "1 to 60",
        ),
    ] {
        let (found, text, errors) = run(anywhere(), &words(&format!("find {line}")));
        assert_eq!((found, text.as_str()), (code, ""), "{line}: {errors}");
        assert!(errors.contains(message) && errors.contains(remedy), "{line}: {errors}");
    }
}

/// Without --to, the window is four periods, or longer where the line is: it is told.
#[test]
fn the_usual_window_is_told() {
    for (line, window) in [
        ("rigid-mass --set mu=1 --zero f", "0 <= t <= 8"),
        ("rigid-mass --set mu=1 --zero f --from 1", "1 <= t <= 9"),
        ("hopkinson --max force", "0 s <= t <= 0.0011 s"),
        ("local-contact --max force", "0 s <= t <= 0.00016 s"),
    ] {
        let (code, text, errors) = run(anywhere(), &words(&format!("find {line}")));
        assert!(code == 0 && text.contains(window), "{line}: {text} {errors}");
    }
    // What is largest at its end may grow beyond.
    for (line, is_noted) in [
        ("pushed-bar --max momentum", true),
        ("pushed-bar --max momentum --to 8", false),
        ("pile --max toe_force", false),
    ] {
        let (code, _, errors) = run(anywhere(), &words(&format!("find {line}")));
        let note = "note: the default window ends where the value is largest; a larger one may follow: give --to\n";
        assert_eq!((code, errors.as_str()), (0, if is_noted { note } else { "" }), "{line}");
    }
}
