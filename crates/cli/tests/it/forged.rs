//! Certificates with wrong claims: each is refused, and it is said what is wrong. Right ones are not.

use super::certificates::{
    APART, BOUNCE, CONTENTS, CROSSING, DISTANCES, DOUBLES, EVENTS, EXTREMES, READINGS, VALUES,
    WINDOWS, ZEROS, certify, checked, with_flint,
};
use super::folder;
use serde_json::json;

/// A section of a bar is read, behind a load.
const BETWEEN: &str = "scene \"Between\"\nload push { force = 1 }\nbar rod { impedance = 1, travel = 1 }\n\
    line free - push - rod - free\nobserve x = displacement(rod.at(4/5))\n";

/// What is read is a polynomial, of which exact numbers tell all.
const POLYNOMIAL: &str = "scene \"Polynomial\"\nload push { force = t*t }\nbar rod { impedance = 1, travel = 10 }\n\
    line free - push - rod - free\nobserve w = work(rod.left)\n";

/// Exactly without force after an event at an irrational time.
const SILENT: &str = "scene \"Silent\"\nbar c { impedance = 1, travel = 1, velocity = 2/3 }\nbar d { impedance = 1, travel = 10 }\n\
    spring s { stiffness = 3, damping = 1/7 }\nmass m { mass = 1, velocity = -1/3 }\n\
    line free - c | d | s - m - free\ncontacts open\n";

/// Exactly without force before a wave arrives, beside a bar of irrational impedance.
const TURNING: &str = "scene \"Turning\"\nmass ram { mass = 1, velocity = 1 }\n\
    bar a { impedance = pi, travel = 1, velocity = 1 }\nbar b { impedance = 1, travel = 5 }\n\
    line free - ram - a | b - free\ncontacts open\n";

/// A contact that opens, and closes when its gap, which begins flat, is zero again; a local contact without much force.
const FLAT: &str = "scene \"Flat\"\nbar a { impedance = 1, travel = 1 }\nload rise { force = t - 7/10, until = 1 }\n\
    load push { force = 3/10, from = 1, until = 2 }\nload pull { force = -1/4, from = 2 }\n\
    bar b { impedance = 1, travel = 10 }\nhertz k { stiffness = 1/1000000, exponent = 2 }\n\
    bar c { impedance = 1, velocity = -1 }\nline fixed | a - rise - push - pull - b - k - c - endless\n\
    observe wall = force(a.left)\ncontacts open\n";

/// A bar whose end moves as a load says, against another one.
const DRIVEN: &str = "scene \"Driven\"\nload p { velocity = t*exp(-t), until = 4 }\nbar rod { impedance = 3, travel = 1 }\n\
    bar far { impedance = 2 }\nline free - p | rod | far - endless\nobserve f = force(rod.right)\ncontacts open\n";

/// A velocity that rises from -1/2 to 3/2 in no time where a wave arrives, and rises before and after.
const JUMP: &str = "scene \"Jump\"\nload p { force = 2, until = 1 }\nload q { force = t - 5/2, from = 1 }\n\
    bar rod { impedance = 1, travel = 1 }\nline free - p - q - rod - free\nobserve x = displacement(rod.left)\n";

/// A support that bars press from both sides. One parts from it when its wave returns; the support then still pushes the other one.
const PRESSED: &str = "scene \"Pressed\"\nbar a { impedance = 1, travel = 1, strain = -1, velocity = -1/2 }\n\
    support s { stiffness = 1 }\nbar b { impedance = 1, travel = 1, strain = -101/100, velocity = 1/2 }\n\
    line free - a | s | b - free\ncontacts open\n";

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
    // Early, so that checkers are quick: waves have arrived from both sides.
    let [held, moved, passed] = ["in_bars", "push", "passed"]
        .map(|own| ask(&format!("contents.wave --quantity {own} --at 9/5")));
    let [apart, more, without] = APART.map(ask);
    std::fs::write(folder.join("between.wave"), BETWEEN).unwrap();
    let between = ask("between.wave --quantity x --at 32/25");
    let text = "scene \"Gap\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\n\
        bar b { impedance = 2, travel = 3/2 }\nline free - a |1/4| b - free\ncontacts open\n";
    std::fs::write(folder.join("gap.wave"), text).unwrap();
    let gap = ask("gap.wave --events --to 3");
    std::fs::write(folder.join("polynomial.wave"), POLYNOMIAL).unwrap();
    let polynomial = ask("polynomial.wave --quantity w --at 2");
    std::fs::write(folder.join("bounce.wave"), BOUNCE).unwrap();
    std::fs::write(folder.join("flat.wave"), FLAT).unwrap();
    let flat = ask("flat.wave --quantity wall --at 43/10 --digits 6");
    let pressed = ask("bounce.wave --quantity force --at 1/4 --digits 6");
    std::fs::write(folder.join("jump.wave"), JUMP).unwrap();
    let jump = ask("jump.wave --zero x --to 5/2");
    std::fs::write(folder.join("crossing.wave"), CROSSING).unwrap();
    let arriving = ask("crossing.wave --zero d --to 5/2");
    std::fs::write(folder.join("driven.wave"), DRIVEN).unwrap();
    let driven = ask("driven.wave --quantity f --at 7/2 --digits 6");
    let mass = || json!({ "is": "mass", "name": "m", "mass": one(), "velocity": json!([]) });
    let add = |own: &serde_json::Value, place: usize, more: serde_json::Value| {
        let mut own = own.clone();
        own["line"].as_array_mut().unwrap().insert(place, more);
        own
    };
    let twice = {
        let mut more = driven["line"][1].clone();
        more["name"] = "q".into();
        add(&driven, 1, more)
    };
    let (heavy, beside) = (add(&driven, 1, mass()), add(&driven, 3, mass()));
    std::fs::write(folder.join("pressed.wave"), PRESSED).unwrap();
    let pushes = ask("pressed.wave --events --to 11/10");
    let cases: [(&serde_json::Value, Change, &str); 180] = [
        (
            &pushes,
            |own| {
                own["events"][3] = json!([1, "opening", "1", "1"]);
                (own["bits"], own["terms"]) = (12.into(), 12.into());
            },
            "whether a support pushes is not decided",
        ),
        (
            &pushes,
            |own| {
                own["events"][3] = json!([1, "opening", "1", "1"]);
                own["line"][5]["force"] = of("1", "d");
                own["numbers"]["d"] = json!(["99/100", "101/100"]);
            },
            "whether a support pushes is not decided",
        ),
        (&driven, |own| own["line"][1]["is"] = "force".into(), "has not changed yet"),
        (&driven, |own| own["line"][1]["until"] = number("3/4"), "3 events instead of 2"),
        (&driven, |own| own["line"][1]["from"] = number("1/7"), "no event is claimed"),
        (&twice, |_| {}, "a place has two velocities"),
        (&heavy, |_| {}, "a mass or a wall has another velocity"),
        (&beside, |_| {}, "a mass or a wall touches what has another velocity"),
        (
            &jump,
            |own| {
                let line = own["line"].as_array_mut().unwrap();
                line.pop();
                line.push(json!({ "is": "mass", "name": "m", "mass": one(), "velocity": one() }));
                line.push(json!({ "is": "fixed" }));
            },
            "rigid bodies meet at the start",
        ),
        (
            &jump,
            |own| {
                own["observed"][0][1] = "velocity".into();
                (own["zeros"], own["rests"]) = (json!([["19/10", "21/10"]]), json!([]));
            },
            "cut by an arrival",
        ),
        (
            &arriving,
            |own| own["line"][2]["course"][0][1][0][0][0][0] = "1".into(),
            "cut by an arrival",
        ),
        (&arriving, |own| own["zeros"] = json!([["21/10", "11/5"]]), "just before a time"),
        (
            &flat,
            |own| {
                own["step"] = "4398046511104".into();
                (own["terms"], own["bits"]) = (8.into(), 169.into());
                own["events"] =
                    json!([[0, "opening", "1.69", "1.71"], [0, "closing", "4.19", "4.21"]]);
                (own["value"], own["last_place"]) = ("0.25".into(), (-2).into());
            },
            "no event is claimed",
        ),
        (&pressed, |own| own["line"][2]["exponent"] = "5/2".into(), "the value is between"),
        (&pressed, |own| own["line"][2]["exponent"] = "1".into(), "the value is between"),
        (&pressed, |own| own["line"][2]["exponent"] = "1/2".into(), "an exponent is less than 1"),
        (&pressed, |own| own["line"][2]["exponent"] = "201/101".into(), "an exponent is less"),
        (&pressed, |own| own["line"][2]["force"] = number("2"), "the value is between"),
        (&pressed, |own| own["line"][2]["compression"] = number("2"), "the value is between"),
        (&pressed, |own| own["line"][2]["compression"] = json!([]), "a number is not positive"),
        (&pressed, |own| own["observed"][0][1] = "energy".into(), "cannot be read"),
        (&pressed, |own| own["observed"][0][1] = "loss".into(), "cannot be read"),
        (&pressed, |own| own["observed"][0][1] = "compression".into(), "the value is between"),
        (
            &polynomial,
            |own| (own["terms"], own["value"]) = (4.into(), "11.73333333333333".into()),
            "the value is between",
        ),
        (&passed, |own| own["observed"][0][3] = number("1/7"), "do not add up to the travel time"),
        (&passed, |own| own["observed"][0] = json!([one(), "work", "a"]), "cannot be read"),
        (&passed, |own| own["observed"][0][0] = number("2"), "the value is between"),
        (&passed, |own| own["observed"][0][1] = "force".into(), "the value is between"),
        (&gap, |own| own["line"][2]["width"] = number("1/7"), "no event is claimed"),
        (&gap, |own| own["line"][2]["width"] = number("-1/4"), "a gap may be no gap"),
        (&gap, |own| own["line"][2]["width"] = json!([]), "a gap may be no gap"),
        (&gap, |own| own["line"][2] = json!({ "is": "contact" }), "is between"),
        (
            &between,
            |own| {
                own["numbers"]["n"] = json!(["7/10", "81/100"]);
                own["observed"][0][3] = of("1", "n");
                own["observed"][0][4] = json!([[[["11/10", {}], ["-1", { "n": 1 }]], []]]);
                own["step"] = "2".into();
            },
            "do not add up to the travel time",
        ),
        (&apart, |own| own["minus"]["line"][1]["mass"] = number("9/4"), "may be an extremum"),
        (&apart, |own| own["minus"]["line"][1]["velocity"] = number("9/10"), "not taken where it"),
        (&apart, |own| own["minus"]["observed"] = json!([]), "may be an extremum"),
        (&apart, |own| drop(own.as_object_mut().unwrap().remove("minus")), "may be an extremum"),
        (&apart, |own| own["goal"] = "largest".into(), "not taken where it is said"),
        (&apart, |own| own["goal"] = "smallest".into(), "a value is beyond"),
        (&apart, |own| own["value"] = "-1".into(), "a value is beyond"),
        (&apart, |own| own["minus"]["numbers"] = json!({}), "a second scene lacks something"),
        (&apart, |own| own["minus"]["minus"] = own["minus"].clone(), "a second scene lacks"),
        (&apart, |own| own["kind"] = "events".into(), "a claim lacks something"),
        (&more, |own| own["minus"]["line"][1]["mass"] = of("2", "m_other"), "m_other has no value"),
        (&without, |own| own["events"] = json!([]), "no event is claimed"),
        (&without, |own| own["minus"]["events"] = own["events"].clone(), "without a contact"),
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
            |own| {
                own["roots"]["sqrt(-1)"] = "-1".into();
                own["line"][1]["course"] = json!([of_complex("1", "1"), of_complex("1", "2")]);
            },
            "not real",
        ),
        (&turns, |own| own["numbers"]["pi"] = json!(["3", "3"]), "pi is the number"),
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
        (&sampled, |own| own["until"] = own["from"].clone(), "the window runs backwards"),
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
    let files: Vec<String> = (0..cases.len()).map(|i| format!("{i}.json")).collect();
    for ((certificate, change, _), file) in cases.iter().zip(&files) {
        let mut altered = (*certificate).clone();
        change(&mut altered);
        std::fs::write(folder.join(file), altered.to_string()).unwrap();
    }
    let Some((_, told)) = checked(&folder, &files) else { return };
    assert_eq!(told.lines().count(), cases.len(), "{told}");
    for (told, (_, _, wrong)) in told.lines().zip(&cases) {
        assert!(told.contains("NOT proven") && told.contains(wrong), "{wrong}: {told}");
    }
    if let Some((_, told)) = with_flint(&folder, "check_arb.py", &files) {
        assert_eq!(told.matches(": NOT proven").count(), cases.len(), "{told}");
    }
}

/// What is exactly zero or known is so to both checkers, whatever is beside it.
#[test]
fn exact_numbers_stay_exact() {
    let folder = folder("exact-certificates");
    for (name, text) in [("polynomial", POLYNOMIAL), ("silent", SILENT), ("turning", TURNING)] {
        std::fs::write(folder.join(format!("{name}.wave")), text).unwrap();
    }
    let ask = |line: &str, change: fn(&mut serde_json::Value)| {
        let file = format!("{}.json", line.split('.').next().unwrap());
        certify(&folder, line, &file);
        let mut certificate =
            serde_json::from_slice(&std::fs::read(folder.join(&file)).unwrap()).unwrap();
        change(&mut certificate);
        std::fs::write(folder.join(&file), certificate.to_string()).unwrap();
        file
    };
    let files = [
        ask("polynomial.wave --quantity w --at 2", |own| own["terms"] = 4.into()),
        ask("silent.wave --events --to 9/2", |_| {}),
        // A second mass that touches the first one, as fast, has no force.
        ask("turning.wave --events --to 3/4", |own| {
            let mass = json!({ "is": "mass", "name": "cap", "mass": one(), "velocity": one() });
            let line = own["line"].as_array_mut().unwrap();
            line.insert(1, mass);
            line.insert(2, json!({ "is": "contact" }));
            own["events"][0][0] = 1.into();
        }),
    ];
    let both = [checked(&folder, &files), with_flint(&folder, "check_arb.py", &files)];
    for (proven, told) in both.into_iter().flatten() {
        assert!(proven, "{told}");
    }
}
