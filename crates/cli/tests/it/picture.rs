//! Pictures of scenes: the numbers that they show are right, the files are what they say, texts are
//! texts and lie apart, and what cannot be drawn is refused without leaving a file.

use super::{folder, run};
use std::fs;
use std::path::Path;

use serde_json::Value;

/// Draws, and gives the bytes of the file.
fn drawn(folder: &Path, arguments: &[&str], file: &str) -> Vec<u8> {
    let all = [&["plot"], arguments, &["-o", file]].concat();
    let (code, stdout, stderr) = run(folder, &all);
    assert_eq!(code, 0, "{all:?}: {stderr}");
    let bytes = fs::read(folder.join(file)).unwrap();
    assert_eq!(stdout, format!("{file}: {} bytes\n", bytes.len()));
    bytes
}

fn refused(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let (code, stdout, stderr) = run(folder, arguments);
    assert!(code != 0 && stdout.is_empty(), "{arguments:?}");
    (code, stderr)
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_slice(&drawn(folder, arguments, "data.json")).unwrap()
}

/// A pair of numbers; none where the line is interrupted.
fn pair(value: &Value) -> Option<(f64, f64)> {
    Some((value[0].as_f64()?, value[1].as_f64()?))
}

/// The pictures of the documents and some more.
const PICTURES: [&[&str]; 10] = [
    &["rigid-mass", "--set", "mu=1", "--to", "8"],
    &["mass-on-fixed-bar", "--set", "mu=1", "--to", "8"],
    &["hopkinson", "--to", "400us"],
    &["hopkinson", "--diagram", "velocity", "--to", "400us"],
    &["stepped-striker", "--diagram", "force", "--to", "6"],
    &["incommensurate", "--diagram", "strain", "--to", "300us"],
    &["mass-on-fixed-bar", "--set", "mu=1", "--diagram", "strain"],
    &["hopkinson", "--at", "50us,100us", "--quantity", "velocity,force"],
    &["incommensurate", "--at", "100us,200us", "--title", ""],
    &["incommensurate"],
];

/// Tags open and close in turn, texts stand in `text` elements with a font size, no resource is loaded.
#[test]
fn svg_is_well_formed() {
    let folder = folder("picture-svg");
    for picture in PICTURES {
        let svg = String::from_utf8(drawn(&folder, picture, "picture.svg")).unwrap();
        let mut open: Vec<&str> = Vec::new();
        for tag in svg.split('<').skip(1) {
            let (tag, _) = tag.split_once('>').expect("a tag ends");
            let name = tag.trim_start_matches('/').split([' ', '/']).next().unwrap();
            match (tag.starts_with('/'), tag.ends_with('/')) {
                (true, _) => assert_eq!(open.pop(), Some(name), "{picture:?}"),
                (false, false) => open.push(name),
                (false, true) => {}
            }
            assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        }
        assert!(open.is_empty(), "{picture:?}");
        assert!(svg.matches("<text ").count() > 10 && !svg.contains("NaN"), "{picture:?}");
        assert!(svg.matches("http").count() == 1 && !svg.contains("<image"), "{picture:?}");
        // Equal calls give equal bytes.
        assert_eq!(drawn(&folder, picture, "again.svg"), svg.as_bytes());
    }
}

#[test]
fn png_has_the_size_and_texts() {
    let folder = folder("picture-png");
    let arguments = |width: &'static str, title: &'static str| {
        ["hopkinson", "--to", "300us", "--quantity", "force", "--width", width, "--title", title]
    };
    let picture = drawn(&folder, &arguments("450", "Force"), "picture.png");
    assert_eq!(picture[..8], *b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(picture[at..at + 4].try_into().unwrap());
    assert_eq!(number(16), 450);
    assert!((200..400).contains(&number(20)), "{}", number(20));
    // Texts are drawn: other words are other pixels.
    let other = drawn(&folder, &arguments("450", "Fence"), "other.png");
    assert!(picture != other);
}

/// Lines run through exact values; jumps are where fronts arrive.
#[test]
fn curves_show_exact_values() {
    let folder = folder("picture-curves");
    let scene = ["mass-on-fixed-bar", "--set", "mu=1", "--quantity", "strain_fixed", "--to", "7"];
    let data = json(&folder, &scene);
    let series = &data["panels"][0]["series"][0];
    let jumps: Vec<f64> =
        series["jumps"].as_array().unwrap().iter().map(|j| j[0].as_f64().unwrap()).collect();
    assert_eq!(jumps, [1.0, 3.0, 5.0, 7.0]);
    let points: Vec<(f64, f64)> =
        series["points"].as_array().unwrap().iter().filter_map(pair).collect();
    assert!(points.len() > 100);
    // On the first period behind the front, −2 e^{−(t−1)}.
    let first = points.iter().filter(|(t, y)| (1.0..3.0).contains(t) && *y != 0.0);
    let mut compared = 0;
    for (t, y) in first {
        assert!((y + 2.0 * (1.0 - t).exp()).abs() < 1e-14, "{y} at {t}");
        compared += 1;
    }
    assert!(compared > 20);
    // Between two points the line is off by a thousandth of the range or little more.
    for two in points.windows(2).filter(|two| two[0].0 > 1.0 && two[1].0 < 3.0) {
        let middle = (two[0].0 + two[1].0) / 2.0;
        let line = (two[0].1 + two[1].1) / 2.0;
        assert!((line + 2.0 * (1.0 - middle).exp()).abs() < 5e-3, "at {middle}");
    }
}

/// The cells of a diagram cover the line and the window once, and their values are those of the field.
#[test]
fn diagrams_cover_the_window() {
    let folder = folder("picture-diagram");
    for (scene, to, area) in [
        (&["mass-on-fixed-bar", "--set", "mu=1"][..], "5", 5.0),
        (&["striker-on-long-bar", "--set", "r=2"], "3", 6.0),
        (&["incommensurate"], "300us", 210.0),
    ] {
        let data = json(&folder, &[scene, &["--diagram", "velocity", "--to", to]].concat());
        let mut sum = 0.0;
        for cell in data["cells"].as_array().unwrap() {
            let corners: Vec<(f64, f64)> =
                cell["outline"].as_array().unwrap().iter().filter_map(pair).collect();
            let next = corners.iter().cycle().skip(1);
            let twice: f64 = corners.iter().zip(next).map(|(a, b)| a.0 * b.1 - a.1 * b.0).sum();
            sum += twice.abs() / 2.0;
        }
        assert!((sum - area).abs() < 1e-9 * area, "{scene:?}: {sum} is not {area}");
    }
    // Two bars, r = 2: the striker slows from 1 to 2/3, 1/3, 2/9; the long bar takes on 2/3, then 2/9.
    let data = json(
        &folder,
        &["striker-on-long-bar", "--set", "r=2", "--diagram", "velocity", "--to", "3"],
    );
    for cell in data["cells"].as_array().unwrap() {
        let value = cell["value"].as_f64().unwrap();
        let thirds = [0.0, 1.0, 2.0 / 3.0, 1.0 / 3.0, 2.0 / 9.0];
        assert!(thirds.iter().any(|third| (third - value).abs() < 1e-14), "{value}");
    }
    // Each front is a line once: to the right at 0 and 2 in the long bar, four in the striker.
    let lines = data["lines"].as_array().unwrap();
    assert!(lines.iter().all(|line| line["jumps"] == true));
    assert_eq!(lines.len(), 5);
}

/// Both sides of a front stand at its place, and the bars follow one another.
#[test]
fn fields_along_the_line_jump_at_fronts() {
    let folder = folder("picture-along");
    let arguments = ["hopkinson", "--at", "50us,100us", "--quantity", "velocity", "--title", "x"];
    let data = json(&folder, &arguments);
    let series = data["panels"][0]["series"].as_array().unwrap();
    assert_eq!(series[0]["name"], "t = 50 µs");
    let jumps = series[1]["jumps"].as_array().unwrap();
    // A pulse of half the velocity, two lengths of the striker long.
    let at: Vec<f64> = jumps.iter().map(|jump| jump[0].as_f64().unwrap()).collect();
    assert_eq!(at.len(), 2);
    assert!((at[1] - at[0] - 0.6).abs() < 1e-12, "{at:?}");
    assert!((jumps[0][2].as_f64().unwrap() - 5.0).abs() < 1e-12);
}

/// Without `--to` pulses come to all places that are observed, and pass.
#[test]
fn windows_last_until_pulses_have_passed() {
    let folder = folder("picture-window");
    let data = json(&folder, &["hopkinson", "--quantity", "gauge_output"]);
    let points: Vec<(f64, f64)> = data["panels"][0]["series"][0]["points"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(pair)
        .collect();
    let largest = points.iter().map(|point| point.1.abs()).fold(0.0, f64::max);
    assert!(largest > 0.4, "{largest}");
    // It falls to a tenth of its size within the window.
    let peak = points.iter().position(|point| point.1.abs() == largest).unwrap();
    assert!(points[peak..].iter().any(|point| point.1.abs() < largest / 10.0));
}

/// Without units velocities, strains and momenta have panels of their own.
#[test]
fn kinds_without_units_have_panels_of_their_own() {
    let folder = folder("picture-kinds");
    let data = json(&folder, &["mass-on-fixed-bar", "--set", "mu=1", "--to", "3"]);
    let panels = data["panels"].as_array().unwrap();
    let names: Vec<&str> =
        panels.iter().map(|panel| panel["y"]["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["velocity", "strain", "momentum", "energy"]);
    assert_eq!(panels[1]["series"].as_array().unwrap().len(), 2);
}

#[test]
fn numbers_are_written_as_csv() {
    let folder = folder("picture-csv");
    let csv = drawn(&folder, &["rigid-mass", "--set", "mu=1", "--quantity", "f"], "data.csv");
    let csv = String::from_utf8(csv).unwrap();
    assert!(csv.starts_with("panel,series,time,value\nf,f,0e0,1e0\n"), "{}", &csv[..60]);
}

#[test]
fn units_have_prefixes() {
    let folder = folder("picture-units");
    let svg = String::from_utf8(drawn(&folder, PICTURES[2], "picture.svg")).unwrap();
    for label in ["time (µs)", "strain (10⁻⁶)", "force (kN)", "compression (µm)", "energy (J)"]
    {
        assert!(svg.contains(&format!(">{label}</text>")), "{label}");
    }
    let svg = String::from_utf8(drawn(&folder, PICTURES[8], "picture.svg")).unwrap();
    assert!(svg.contains(">t = 200 µs</text>") && !svg.contains("class=\"title\""));
}

/// The same picture as PDF: one page of its size, with its texts as text in the fonts that come along, twice the same.
#[test]
fn pictures_are_pages_of_pdf() {
    let folder = folder("picture-pdf");
    let drawn = |name: &str| drawn(&folder, PICTURES[8], name);
    let (svg, pdf) = (String::from_utf8(drawn("picture.svg")).unwrap(), drawn("picture.pdf"));
    assert!(pdf == drawn("again.pdf") && pdf.starts_with(b"%PDF-"));
    let text = String::from_utf8_lossy(&pdf);
    let side = |name: &str| -> f64 {
        let (_, rest) = svg.split_once(&format!("{name}=\"")).unwrap();
        rest.split('"').next().unwrap().parse().unwrap()
    };
    let page = format!("/MediaBox[0 0 {} {}]", 0.75 * side("width"), 0.75 * side("height"));
    assert!(text.contains(&page), "{page}");
    assert!(text.contains("DejaVuSans") && text.contains("/ToUnicode"));
}

#[test]
fn what_cannot_be_drawn_leaves_no_file() {
    let folder = folder("picture-refused");
    fs::write(folder.join("old.svg"), "kept").unwrap();
    for (arguments, code, message) in [
        (&["rigid-mass", "-o", "a.svg"][..], 2, "mu has no value"),
        (&["rigid-mass", "--set", "mu=1", "-o", "a.eps"], 2, "use the extension .svg, .pdf"),
        (&["rigid-mass", "--set", "mu=1", "--to", "0", "-o", "a.svg"], 2, "is empty"),
        (&["rigid-mass", "--set", "mu=1", "--quantity", "g,h", "-o", "a.svg"], 2, "`h` is neither"),
        (&["rigid-mass", "--set", "mu=1", "--diagram", "force", "-o", "a.svg"], 2, "no bars"),
        (&["hopkinson", "--at", "1us", "--quantity", "speed", "-o", "a.svg"], 2, "not a field"),
        (&["hopkinson", "--at", "-1us", "-o", "a.svg"], 2, "before the start"),
        (&["pushed-bar", "--width", "0", "-o", "a.png"], 2, "choose another --width"),
        (&["pushed-bar", "-o", "none/a.svg"], 2, "cannot be written"),
        (&["rigid-mass", "--set", "mu=1", "--to", "-1", "-o", "old.svg"], 2, "before the start"),
    ] {
        let (found, text) = refused(&folder, &[&["plot"], arguments].concat());
        assert!(found == code && text.contains(message), "{arguments:?}: {found} {text}");
    }
    let files: Vec<_> = fs::read_dir(&folder).unwrap().map(|f| f.unwrap().file_name()).collect();
    assert_eq!(files, ["old.svg"]);
    assert_eq!(fs::read_to_string(folder.join("old.svg")).unwrap(), "kept");
}

#[test]
fn field_is_told_as_csv_and_json() {
    let folder = folder("picture-field");
    let scene = ["field", "mass-on-fixed-bar", "--set", "mu=1", "--at", "5/4", "--mesh", "8"];
    let (code, csv, _) = run(&folder, &scene);
    assert!(code == 0 && csv.lines().count() == 10);
    let columns = csv.lines().next().unwrap().split(',').count();
    assert!(columns == 10 && csv.lines().all(|line| line.split(',').count() == columns));
    let json_of = |more: &[&str]| -> Value {
        let all = [&scene[..], &["--format", "json"], more].concat();
        serde_json::from_str(&run(&folder, &all).1).unwrap()
    };
    let nodes = json_of(&[]);
    assert_eq!((&nodes["schema_version"], &nodes["side"]), (&1.into(), &"right".into()));
    let rod = &nodes["bars"][0];
    // Both formats hold the same doubles.
    for (i, line) in csv.lines().skip(1).enumerate() {
        let velocity: f64 = line.split(',').nth(2).unwrap().parse().unwrap();
        assert_eq!(rod["velocity"][i].as_f64(), Some(velocity));
    }
    let means = json_of(&["--averages"]);
    assert_eq!(means["sampling"], "averages");
    assert_eq!(means["bars"][0]["strain"].as_array().unwrap().len(), 8);
    // The front is at 3/4 on its way back: its two sides are at the node there.
    let left = json_of(&["--side", "left"]);
    assert_ne!(left["bars"][0]["velocity"][6], rod["velocity"][6]);
    assert_eq!(left["bars"][0]["velocity"][5], rod["velocity"][5]);
    let (_, stdout, _) = run(
        &folder,
        &[
            "field",
            "hopkinson",
            "--at",
            "100us",
            "--mesh",
            "4",
            "--format",
            "json",
            "--bar",
            "output",
            "--to",
            "2m",
        ],
    );
    let units: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!((&units["units"]["force"], &units["x_unit"]), (&"N".into(), &"m".into()));
    assert_eq!(units["bars"][0]["x"][4].as_f64(), Some(2.0));
    for (more, message) in [
        (&["--mesh", "0"][..], "0 cells"),
        (&["--mesh", "100001"], "give 1 to 100000"),
        (&["--at", "-1"], "before the start"),
        (&["--bar", "red"], "no bar `red`"),
        (&["--to", "0"], "above 0"),
    ] {
        let mut all: Vec<&str> = scene.to_vec();
        match more[0] {
            "--mesh" => all[7] = more[1],
            "--at" => all[5] = more[1],
            _ => all.extend(more),
        }
        let (code, text) = refused(&folder, &all);
        assert!(code == 2 && text.contains(message), "{more:?}: {text}");
    }
    let (code, text) = refused(&folder, &["field", "rigid-mass", "--at", "1"]);
    assert!(code == 2 && text.contains("no bars"), "{text}");
    let (code, text) = refused(&folder, &["field", "mass-on-fixed-bar", "--at", "1"]);
    assert!(code == 2 && text.contains("--set mu=1"), "{text}");
}
