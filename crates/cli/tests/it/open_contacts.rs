//! Fields and pictures of contacts that open, by the command.

use super::{ROOT, anywhere, run};
use serde_json::Value as Json;
use std::fs;
use std::path::Path;

/// The standard output of a command that does its work.
fn output(arguments: &[&str]) -> String {
    let (code, out, err) = run(anywhere(), arguments);
    assert_eq!(code, 0, "{arguments:?}: {err}");
    out
}

/// A spring that was left alone has come back to rest long ago, but for far less than any double tells.
#[test]
fn what_has_died_out_is_told_as_that() {
    let text = "scene \"Left alone\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\n\
        spring rock { stiffness = sqrt(2), damping = 1/5 }\n\
        line free - rod | rock - fixed\ncontacts open\nobserve depth = compression(rock)\n";
    fs::write(anywhere().join("left.wave"), text).unwrap();
    let told = output(&["eval", "left.wave", "--quantity", "depth", "--at", "400"]);
    assert!(told.starts_with("depth(400) = 0 ± "), "{told}");
    // What precision tells has its digits.
    let told = output(&["eval", "left.wave", "--quantity", "depth", "--at", "40", "--digits", "9"]);
    assert!(!told.contains('±') && told.contains("e-"), "{told}");
}

/// An assumption is told once, with the most bits that were tried.
#[test]
fn assumptions_are_told_once() {
    let text = "scene \"A force that touches zero\"\nbar rod { impedance = 1, travel = 1 }\n\
        load push { force = (t - 5/4)*(t - 5/4)*(t + 1) }\n\
        line free - push - rod | fixed\ncontacts open\nobserve force = force(rod.right)\n";
    fs::write(anywhere().join("touches.wave"), text).unwrap();
    // Digits take more bits than the first that came to the end.
    let line = ["eval", "touches.wave", "--quantity", "force", "--at", "9/4", "--digits", "300"];
    let (code, text, errors) = run(anywhere(), &line);
    assert_eq!(code, 0, "{text}{errors}");
    assert_eq!(text, "force(9/4) = 0\n");
    assert_eq!(errors.matches("note: assuming").count(), 1, "{errors}");
}

#[test]
fn the_commands_follow_contacts_that_open() {
    let rows =
        output(&["field", "bars-of-equal-length", "--at", "3", "--mesh", "2", "--bar", "first"]);
    let row = rows.lines().nth(2).unwrap();
    assert_eq!(row, "first,0.5,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0");
    let file = anywhere().join("phases.json");
    let drawn = |arguments: &[&str]| -> Json {
        output(&[&["plot"], arguments, &["-o", "phases.json"]].concat());
        serde_json::from_slice(&fs::read(&file).unwrap()).unwrap()
    };
    let diagram =
        drawn(&["bars-of-equal-length", "--diagram", "velocity", "--from", "2", "--to", "4"]);
    // The striker, between 0 and 1, is at rest; the other bar moves with 0 or 1.
    let cells = diagram["cells"].as_array().unwrap();
    let is_left = |cell: &&Json| {
        cell["outline"].as_array().unwrap().iter().all(|corner| corner[0].as_f64() <= Some(1.0))
    };
    assert!(cells.iter().filter(is_left).all(|cell| cell["value"].as_f64() == Some(0.0)));
    assert!(cells.iter().any(|cell| cell["value"].as_f64() == Some(1.0)));
    let figure = drawn(&["saint-venant", "--set", "mu=1", "--at", "5", "--quantity", "strain"]);
    let points = figure["panels"][0]["series"][0]["points"].as_array().unwrap();
    assert_eq!(points[0][1].as_f64(), Some(0.0), "a free end");
}

/// These pictures are what the commands beside them draw; `UPDATE_DOCUMENTS=1` draws them anew.
#[test]
fn pictures_of_pages_are_fresh() {
    let root = Path::new(ROOT);
    let mut fresh = 0;
    for name in ["docs/pictures.md", "docs/enough.md"] {
        let page = fs::read_to_string(root.join(name)).unwrap();
        let drawn_here = |line: &&str| match line.starts_with("wavestep plot ") {
            true => line.contains("-with-release") || line.contains("-venant"),
            false => line.starts_with("wavestep advise "),
        };
        for line in page.lines().filter(drawn_here) {
            let (arguments, file) = line.split_once(" -o ").expect("a file");
            assert!(page.contains(&format!("({})", file.trim_start_matches("docs/"))), "{file}");
            let mut arguments: Vec<&str> = arguments.split_whitespace().skip(1).collect();
            arguments.extend(["-o", "page.svg"]);
            output(&arguments);
            let drawn = fs::read(anywhere().join("page.svg")).unwrap();
            if std::env::var_os("UPDATE_DOCUMENTS").is_some() {
                fs::write(root.join(file), &drawn).unwrap();
            }
            let told = format!("{file} is stale: run with UPDATE_DOCUMENTS=1");
            assert!(fs::read(root.join(file)).ok().as_deref() == Some(&drawn[..]), "{told}");
            fresh += 1;
        }
    }
    assert_eq!(fresh, 4);
}
