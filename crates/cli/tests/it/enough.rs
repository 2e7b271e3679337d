//! `advise`, `find --distance` and `derive --model`; and the table of `docs/enough.md`.
//!
//! With `UPDATE_DOCUMENTS=1` the table is written anew, in a minute or two; read it before you keep it. Without, the rows
//! that are quick are held against it.

use super::strains::{Strains, formula};
use super::{ROOT, anywhere, folder, run, words};
use num_traits::ToPrimitive as _;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use wavestep::Rational;
use wavestep::scenes::SCENES;
use wavestep_studies::estimates::Estimate;

const TOLERANCES: [&str; 5] = ["1e-1", "1e-2", "1e-3", "1e-6", "1e-9"];

/// What is tried on every run of the tests.
const QUICK: [&str; 6] = [
    "bars-of-unequal-length",
    "cushioned-impact",
    "mass-on-fixed-bar",
    "mass-on-free-bar",
    "stepped-striker",
    "struck-free-bar",
];

/// Those without a usual window, and the end of one.
const ENDS: [(&str, &str); 2] = [("hertz-striker", "60us"), ("local-contact", "60us")];

const MARKS: [&str; 2] =
    ["<!-- enough: made by crates/cli/tests/it/enough.rs -->\n", "<!-- end of enough -->"];

/// What is enough of a shipped scene, all of its symbols a half.
fn enough(scene: &str, symbols: &[&str], tolerance: &str) -> (String, String) {
    let mut line = vec!["advise", scene, "--tol", tolerance, "--format", "json"];
    let values: Vec<String> = symbols.iter().map(|symbol| format!("{symbol}=1/2")).collect();
    values.iter().for_each(|value| line.extend(["--set", value]));
    if let Some((_, end)) = ENDS.iter().find(|(name, _)| *name == scene) {
        line.extend(["--to", end]);
    }
    let (code, text, errors) = run(anywhere(), &line);
    assert_eq!(code, 0, "{line:?}: {errors}");
    let told: Value = serde_json::from_str(&text).unwrap();
    check(&told);
    let name = told["quantity"].as_str().unwrap().to_owned();
    (name, told["enough"].as_str().unwrap_or("exact").to_owned())
}

/// What is enough keeps to the tolerance; what misses it does so by more.
fn check(told: &Value) {
    let number = |value: &Value| value.as_str().unwrap().parse::<f64>().unwrap();
    let tolerance = number(&told["tolerance"].as_str().map_or(Value::Null, |text| {
        let (top, bottom) = text.split_once('/').unwrap_or((text, "1"));
        Value::from((top.parse::<f64>().unwrap() / bottom.parse::<f64>().unwrap()).to_string())
    }));
    for own in told["tried"].as_array().unwrap() {
        let verdict = &own["verdict"];
        if let Some(share) = verdict["enough"].as_array() {
            assert!(number(&share[0]) <= number(&share[1]), "{own}");
            assert!(number(&share[1]) <= tolerance * (1.0 + 1e-15), "{own}");
        }
        if verdict["misses"].is_string() {
            assert!(number(&verdict["misses"]) >= tolerance, "{own}");
            assert!(verdict["at"].is_string(), "{own}");
        }
    }
}

fn symbols(text: &str) -> Vec<&str> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("symbol "));
    let all = lines.flat_map(|line| line.split('#').next().unwrap_or_default().split(','));
    all.filter_map(|symbol| symbol.split_whitespace().next()).collect()
}

#[test]
fn what_is_enough_of_shipped_scenes_is_as_the_page_says() {
    let page = Path::new(ROOT).join("docs/enough.md");
    let text = fs::read_to_string(&page).unwrap();
    let update = std::env::var_os("UPDATE_DOCUMENTS").is_some();
    let mut table = format!("\n| scene | quantity | {} |\n|---|---|", TOLERANCES.join(" | "));
    table += &"---|".repeat(TOLERANCES.len());
    table.push('\n');
    let mut rows = BTreeMap::new();
    for scene in SCENES.iter().filter(|scene| scene.text.contains("\nscene ")) {
        if !update && !QUICK.contains(&scene.name) {
            continue;
        }
        let symbols = symbols(scene.text);
        let told: Vec<_> =
            TOLERANCES.map(|tolerance| enough(scene.name, &symbols, tolerance)).into();
        let answers: Vec<String> = told.iter().map(|(_, answer)| format!("`{answer}`")).collect();
        let row = format!("| `{}` | `{}` | {} |\n", scene.name, told[0].0, answers.join(" | "));
        table += &row;
        rows.insert(scene.name, row);
    }
    let (start, end) =
        (text.find(MARKS[0]).unwrap() + MARKS[0].len(), text.find(MARKS[1]).unwrap());
    if update {
        fs::write(page, format!("{}{table}\n{}", &text[..start], &text[end..])).unwrap();
        return;
    }
    assert_eq!(rows.len(), QUICK.len());
    for row in rows.values() {
        assert!(text[start..end].contains(row.as_str()), "not in docs/enough.md: {row}");
    }
}

/// A motion beside a local contact is cut where its series ends, which is no arrival.
#[test]
fn beside_a_local_contact_no_arrivals_are_counted() {
    let advise = |scene: &str, to: &str| {
        let (code, text, errors) = run(anywhere(), &["advise", scene, "--to", to, "--tol", "1e-2"]);
        assert_eq!(code, 0, "{errors}");
        text
    };
    assert!(advise("pile", "2").contains("arrival"));
    let local = advise("local-contact", "20us");
    assert!(local.contains("2 bars, 1 lumped element") && !local.contains("arrival"), "{local}");
}

/// What kinds of answers there are, each with its colour.
const KINDS: [(&str, &str); 6] = [
    ("bars rigid, or springs with mass", "#0072b2"),
    ("less of the scene", "#56b4e9"),
    ("the first arrivals", "#009e73"),
    ("the first modes", "#e69f00"),
    ("contacts kept closed", "#cc79a7"),
    ("nothing less than the exact answer", "#d9d9d9"),
];

fn kind(answer: &str) -> usize {
    let word = answer.split([':', '+']).next().unwrap_or_default();
    match word {
        "rigid" | "third" | "spring" => 0,
        "without" | "endless" => 1,
        "echoes" => 2,
        "modes" => 3,
        "closed" => 4,
        "exact" => 5,
        _ => panic!("a kind of answer without a colour: {answer}"),
    }
}

/// The table of the page as a picture: a row for each scene, a column for each tolerance.
fn drawn(rows: &[Vec<&str>]) -> String {
    let [left, top, wide_cell, high_cell] = [190, 60, 138, 22];
    let right = left + TOLERANCES.len() * wide_cell;
    let bottom = top + rows.len() * high_cell;
    let height = bottom + 20 + KINDS.len().div_ceil(2) * 20;
    let mut picture = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {height}\" role=\"img\" \
         font-family=\"sans-serif\" font-size=\"12\" fill=\"#1a1a1a\">\n\
         <title>The smallest answer that is enough</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        right + 10
    );
    let text = |x: usize, y: usize, anchor: &str, text: &str| {
        format!("<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{text}</text>\n")
    };
    picture +=
        &text(left.midpoint(right), 20, "middle", "allowed difference, over the largest value");
    for (column, tolerance) in TOLERANCES.iter().enumerate() {
        picture += &text(left + column * wide_cell + wide_cell / 2, top - 8, "middle", tolerance);
    }
    for (row, cells) in rows.iter().enumerate() {
        let y = top + row * high_cell;
        picture += &text(left - 8, y + 15, "end", cells[0]);
        let mut column = 0;
        while column < TOLERANCES.len() {
            let answer = cells[2 + column];
            let same = cells[2 + column..].iter().take_while(|own| **own == answer).count();
            let (x, wide, high) = (left + column * wide_cell, same * wide_cell - 2, high_cell - 2);
            let fill = KINDS[kind(answer)].1;
            picture += &format!(
                "<rect x=\"{x}\" y=\"{y}\" width=\"{wide}\" height=\"{high}\" fill=\"{fill}\" \
                 fill-opacity=\"0.55\"/>\n"
            );
            picture += &text(x + wide / 2, y + 15, "middle", answer);
            column += same;
        }
    }
    for (place, (name, colour)) in KINDS.iter().enumerate() {
        let (x, y) = (left + place % 2 * (right - left) / 2, bottom + 16 + place / 2 * 20);
        picture += &format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"14\" height=\"14\" fill=\"{colour}\" fill-opacity=\"0.55\"/>\n"
        );
        picture += &text(x + 22, y + 12, "start", name);
    }
    picture + "</svg>\n"
}

#[test]
fn the_picture_of_the_table_is_fresh() {
    let page = fs::read_to_string(Path::new(ROOT).join("docs/enough.md")).unwrap();
    let [start, end] = MARKS.map(|mark| page.find(mark).unwrap());
    let rows: Vec<Vec<&str>> = page[start..end]
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| {
            line.trim_matches('|').split('|').map(|cell| cell.trim().trim_matches('`')).collect()
        })
        .collect();
    let scenes = SCENES.iter().filter(|scene| scene.text.contains("\nscene ")).count();
    assert_eq!(rows.len(), scenes);
    let (file, picture) = (Path::new(ROOT).join("docs/pictures/smallest.svg"), drawn(&rows));
    if std::env::var_os("UPDATE_DOCUMENTS").is_some() {
        fs::write(file, picture).unwrap();
        return;
    }
    assert_eq!(fs::read_to_string(file).unwrap(), picture, "run with UPDATE_DOCUMENTS=1");
}

const ESTIMATE_MARKS: [&str; 2] =
    ["<!-- estimates: made by crates/cli/tests/it/enough.rs -->\n", "<!-- end of estimates -->"];

/// For which masses estimates of the largest strain are within 1, 5 and 10 %. Where the table is written anew, each range is
/// proven for all masses, which takes minutes; else its ends.
#[test]
fn estimates_hold_where_the_page_says() {
    let page = Path::new(ROOT).join("docs/enough.md");
    let text = fs::read_to_string(&page).unwrap();
    let mut strains = Strains::default();
    let is_new = std::env::var_os("UPDATE_DOCUMENTS").is_some();
    let mut table =
        "\n| largest strain, in V/c | within 1 % | within 5 % | within 10 % |\n|---|---|---|---|\n"
            .to_owned();
    for estimate in Estimate::ALL {
        let cells = [1, 5, 10].map(|percent| {
            let share = Rational::new(percent.into(), 100.into());
            let number = |value: &Rational| value.to_f64().unwrap().to_string();
            let range = |[from, to]: &[Rational; 2]| format!("{} to {}", number(from), number(to));
            let ranges = strains.ranges(estimate, &share).unwrap();
            for [from, to] in ranges.iter().filter(|_| is_new) {
                let told = estimate.unproven_between(&share, [from, to]).unwrap();
                assert_eq!(told, None, "{estimate:?} within {percent} %, {from} to {to}");
            }
            match ranges.is_empty() {
                true => "nowhere".to_owned(),
                false => ranges.iter().map(range).collect::<Vec<_>>().join(", "),
            }
        });
        table += &format!("| $`{}`$ | {} |\n", formula(estimate), cells.join(" | "));
    }
    let (start, end) = (
        text.find(ESTIMATE_MARKS[0]).unwrap() + ESTIMATE_MARKS[0].len(),
        text.find(ESTIMATE_MARKS[1]).unwrap(),
    );
    if is_new {
        fs::write(page, format!("{}{table}\n{}", &text[..start], &text[end..])).unwrap();
        return;
    }
    assert_eq!(text[start..end].trim(), table.trim());
}

#[test]
fn the_smallest_scene_is_a_file_that_runs() {
    let here = folder("advise");
    let text = "scene \"Collar\"\nsymbol m > 0\nmass hammer { mass = m, velocity = 1 }\n\
        bar rod { impedance = 1, travel = 1 }\nmass collar { mass = 1e-5 } # hardly there\n\
        bar tail { impedance = 1, travel = 4 }\nline free - hammer - rod - collar - tail - free\n\
        observe v = velocity(hammer)\n";
    fs::write(here.join("collar.wave"), text).unwrap();
    let line = "advise collar.wave --set m=1 --tol 1e-3 --to 9 -o reduced.wave";
    let (code, told, errors) = run(&here, &words(line));
    assert_eq!((code, errors.as_str()), (0, ""));
    assert!(told.contains("\nEnough: `"), "{told}");
    let reduced = fs::read_to_string(here.join("reduced.wave")).unwrap();
    let comment = "# \"Collar\" simplified, for v to within 0.1 % of its largest value,\n";
    assert!(reduced.starts_with(comment), "{reduced}");
    assert!(reduced.contains("# 0 <= t <= 9, with --set m=1.\n"), "{reduced}");
    assert!(!reduced.contains("collar {"), "{reduced}");
    let line = "find collar.wave --set m=1 --distance v --minus reduced.wave --to 9 --format json";
    let (code, told, errors) = run(&here, &words(line));
    assert_eq!(code, 0, "{errors}");
    let told: Value = serde_json::from_str(&told).unwrap();
    let relative = &told["distances"][0]["relative"]["decimal"];
    assert!(relative.as_str().unwrap().parse::<f64>().unwrap() <= 1e-3, "{told}");
}

#[test]
fn distances_are_told_in_all_formats() {
    let line = "find mass-on-fixed-bar --set mu=1 --distance --minus third --to 4 --digits 6";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert_eq!((code, errors.as_str()), (0, ""));
    assert!(
        text.starts_with(
            "velocity: largest difference from third = 0.255753, 0.255753 of the largest"
        ),
        "{text}"
    );
    assert!(
        text.contains("energy: largest difference from third = 0.125 = 1/8, 0.25 = 1/4"),
        "{text}"
    );
    let (_, csv, _) = run(anywhere(), &words(&format!("{line} --format csv")));
    let mut rows = csv.lines();
    assert_eq!(rows.next(), Some("quantity,distance,radius,largest,relative"));
    assert!(rows.any(|row| row == "energy,1/8,0,1/2,1/4"), "{csv}");
    let (_, json, _) = run(anywhere(), &words(&format!("{line} --format json")));
    let told: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(told["distances"].as_array().unwrap().len(), 5);
}

/// Without a name all observables are told that have echoes; an energy has none.
#[test]
fn distances_from_first_echoes_leave_energies_out() {
    let line = "find mass-on-fixed-bar --set mu=1/10 --distance --minus echoes:2 --to 1";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert_eq!((code, errors.as_str()), (0, ""));
    assert!(text.starts_with("velocity: ") && text.contains("\nstrain_fixed: "), "{text}");
    assert!(!text.contains("energy"), "{text}");
}

/// A tolerance below what is usually told apart from nothing is met by what is shown.
#[test]
fn tiny_tolerances_are_met_by_what_is_shown() {
    let line = "advise mass-on-fixed-bar --set mu=1 --to 1 --tol 1e-30";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert_eq!((code, errors.as_str()), (0, ""));
    let (_, told) = text.split_once("Enough: `endless:rod.right`, proven error at most ").unwrap();
    let (share, _) = told.split_once(" %.").unwrap();
    assert!(share.parse::<f64>().unwrap() <= 1e-28, "{text}");
}

#[test]
fn formulas_of_a_model_stand_below_the_exact_ones() {
    let line = "derive mass-on-fixed-bar --quantity strain_fixed --through 0 --model third";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert_eq!((code, errors.as_str()), (0, ""));
    assert!(text.starts_with("strain_fixed[0](s) = -2*exp(-s)\n"), "{text}");
    assert!(
        text.ends_with(
            "\n# third, at all times\n# omega^2 = 3/(mu*(3 + mu))\nstrain_fixed[0](s) = -omega*sin(omega*s)\n"
        ),
        "{text}"
    );
}

#[test]
fn a_model_beside_exact_formulas_is_one_document() {
    let line =
        "derive mass-on-fixed-bar --quantity strain_fixed --through 0 --model third --format json";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert_eq!((code, errors.as_str()), (0, ""));
    let told: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(
        (&told["model"], &told["rate"]),
        (&"third".into(), &"omega^2 = 3/(mu*(3 + mu))".into())
    );
    assert!(told["exact"]["functions"].is_array() || told["exact"]["waves"].is_array(), "{told}");
}

#[test]
fn maps_are_data() {
    let line = "advise mass-on-fixed-bar --quantity velocity --for mu=1/4..1 --to 2 --tol 1e-1 \
                --points 2 --models third echoes:1";
    let told = |format: &str| {
        let (code, text, errors) = run(anywhere(), &words(&format!("{line} --format {format}")));
        assert_eq!((code, errors.as_str()), (0, ""));
        text
    };
    let map: Value = serde_json::from_str(&told("json")).unwrap();
    let ranges = map["ranges"].as_array().unwrap();
    let enough: Vec<&Value> = ranges.iter().map(|range| &range["enough"]).collect();
    assert_eq!(enough, [&"third".into(), &Value::Null, &"echoes:1".into()]);
    assert!(ranges.iter().all(|range| range["proven"] == true && range["open"] == json!([])));
    assert_eq!(map["values"][1]["tried"][1]["off"][0], "0");
    let rows = told("csv");
    let columns: Vec<&str> = rows.lines().next().unwrap().split(',').collect();
    assert_eq!((columns, rows.lines().count()), (vec!["value", "what", "off.0", "off.1"], 5));
}

/// A distance of nothing is told as that, and one that is not proven to its digits ends with exit code 3.
#[test]
fn distances_say_what_is_known_of_them() {
    let line =
        "find percussive-drill --distance rock_force --minus rigid:piston --to 500us --digits 6";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert_eq!((code, errors.as_str()), (0, ""), "{text}");
    let line = "find mass-on-fixed-bar --set mu=1 --distance velocity --minus echoes:99 --to 7";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert_eq!((code, errors.as_str()), (0, ""), "{text}");
    assert_eq!(text, "velocity: largest difference from echoes:99 < 1e-15 of the largest value\n");
}

/// The time in the text is the whole time: the difference there is above the tolerance, and is shown to be.
#[test]
fn a_reader_can_try_a_witness() {
    let scene = "mass-on-fixed-bar --set mu=1/10";
    let (code, text, errors) =
        run(anywhere(), &words(&format!("advise {scene} --quantity velocity --tol 1e-2 --to 1")));
    assert_eq!((code, errors.as_str()), (0, ""));
    let misses = text.lines().filter_map(|line| {
        let (model, rest) = line.strip_prefix("  ")?.split_once(' ')?;
        let share = rest.trim_start().strip_prefix("at least ")?;
        let (share, rest) = share.split_once(" % at t = ")?;
        Some((model, share.parse::<f64>().unwrap(), rest.split_once(';')?.0))
    });
    let mut seen = 0;
    for (model, share, time) in misses {
        assert!(share > 1.0, "{text}");
        let line = format!(
            "find {scene} --distance velocity --minus {model} --from {time} --to 1 --format json"
        );
        let (_, told, _) = run(anywhere(), &words(&line));
        let told: Value = serde_json::from_str(&told).unwrap();
        let off = told["distances"][0]["distance"]["decimal"].as_str().unwrap();
        // The largest value is 1.
        assert!(off.parse::<f64>().unwrap() * 100.0 >= share, "{told}");
        seen += 1;
    }
    assert!(seen >= 3, "{text}");
}

/// A model that was named and does not suit the scene is not passed over.
#[test]
fn a_map_tells_why_a_named_model_does_not_suit() {
    let line = "advise mass-on-fixed-bar --for mu=1..2 --to 1 --points 2 --models rigid third";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert_eq!((code, errors.as_str()), (0, ""));
    assert!(text.contains("\nrigid: not applicable: this bar cannot move\n"), "{text}");
    let (_, json, _) = run(anywhere(), &words(&format!("{line} --format json")));
    let told: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(told["unsuited"], json!([{ "what": "rigid", "why": "this bar cannot move" }]));
}

/// Eight rates that are roots of one polynomial have a formula that nobody would read, and that takes minutes.
#[test]
fn a_formula_in_too_many_rates_is_refused() {
    let line = "derive percussive-drill --quantity gauge --through 0 --model third";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert!(code == 1 && text.is_empty(), "{code} {text}");
    assert!(errors.contains("no short exact form"), "{errors}");
}

/// Where echoes take too much memory, they are one model that does not suit, and the others are weighed.
#[test]
fn models_are_weighed_without_echoes() {
    let bar = "modulus = 210 GPa, density = 7850 kg/m^3, area = 150 cm^2";
    let text = format!(
        "scene \"Pile\"\nbar pile {{ {bar}, length = 20 m }}\nsupport skin {{ damping = 80 kN*s/m }}\n\
         bar lower {{ {bar}, length = 7 m }}\n\
         support toe {{ damping = 150 kN*s/m, stiffness = 60 MN/m }}\n\
         load push {{ force = 2000*sin(1000*t) kN, until = 3 ms }}\n\
         line free - push - pile - skin - lower - toe - free\nobserve v = velocity(pile.left)\n"
    );
    let folder = folder("models-without-echoes");
    fs::write(folder.join("pile.wave"), text).expect("a file");
    let line = "advise pile.wave --quantity v --tol 5e-2 --to 50ms";
    let (code, text, errors) = run(&folder, &words(line));
    assert_eq!((code, errors.as_str()), (0, ""), "{text}");
    let starts = |line: &str, with: [&str; 2]| {
        let words: Vec<&str> = line.split_whitespace().collect();
        words.first() == Some(&with[0]) && line.contains(with[1])
    };
    for with in [["echoes:64", "MB of memory"], ["without:skin", "at least"], ["exact", "2 bars"]] {
        assert!(text.lines().any(|line| starts(line.trim_start_matches("* "), with)), "{text}");
    }
}

#[test]
fn a_map_has_so_many_modes_at_most() {
    let line = "advise mass-on-fixed-bar --for mu=1..2 --models modes:99999999999";
    let (code, text, errors) = run(anywhere(), &words(line));
    assert!(code == 1 && text.is_empty(), "{code} {text} {errors}");
    assert!(errors.contains("more than 1e3") && errors.contains("another model"), "{errors}");
}

#[test]
fn what_cannot_be_weighed_is_told() {
    let scene = "mass-on-fixed-bar --set mu=1";
    for (line, reason, remedy) in [
        (format!("advise {scene} --tol 0"), "not positive", "1e-2"),
        (format!("advise {scene} --tol -1e-2"), "not positive", "1e-2"),
        (format!("advise {scene} --tol abs:1e-2"), "cannot be absolute", "share of the largest"),
        (format!("advise {scene} --to 1 -o map.svg"), "only a map", "--for"),
        ("advise saint-venant".to_owned(), "`mu` has no value", "--for mu="),
        (
            "advise mass-on-fixed-bar --for mu=1..2 --models modes:0".to_owned(),
            "1 or larger",
            "modes:1",
        ),
        (
            format!("find {scene} --distance velocity --minus echoes:0 --to 1"),
            "1 or larger",
            "echoes:1",
        ),
        (
            "find struck-free-bar --set mu=1 --distance impact_force --minus rigid --to 1"
                .to_owned(),
            "`impact_force` observes what is left out",
            "velocity",
        ),
        (format!("advise {scene} --tol x"), "x", "number"),
        (format!("advise {scene} --quantity velocty"), "velocty", "velocity"),
        (format!("advise {scene} --from 3 --to 2"), "is empty", ""),
        (format!("advise {scene} --quantity strain_fixed --to 1/2"), "is zero", "longer window"),
        ("advise mass-on-fixed-bar --for nu=1..2".to_owned(), "`nu` is not a free symbol", "mu"),
        (format!("advise {scene} --for mu=1..2"), "`mu` is not a free symbol", "remove --for"),
        ("advise mass-on-fixed-bar --for mu=2..1".to_owned(), "not a range", "mu=1/10..10"),
        ("advise mass-on-fixed-bar --for mu=1..2 -o map.eps".to_owned(), "map.eps", ".svg"),
        ("advise mass-on-fixed-bar --for mu=1..2 --models x:y".to_owned(), "x:y", "third"),
        (
            "advise mass-on-fixed-bar --for mu=1..2 --models spring:rot".to_owned(),
            "no element `rot`",
            "rod",
        ),
        (
            "advise mass-on-fixed-bar --for mu=1..2 --quantity strain_fixed --to 1/2".to_owned(),
            "is zero",
            "longer window",
        ),
        ("advise mass-on-fixed-bar --to 1".to_owned(), "mu", "--set"),
        ("advise rigid-mass --set mu=1".to_owned(), "states equations", "describe the scene"),
        (format!("find {scene} --distance velocity --to 1"), "--minus", ""),
        (format!("find {scene} --distance velocity --minus thirds:x --to 1"), "thirds:x", "third"),
        (
            format!("find {scene} --distance velocity --minus rigid --to 1"),
            "`rigid` does not suit this scene: this bar cannot move",
            "another simplification",
        ),
        (
            "find striker-on-long-bar --set r=1 --distance --minus closed --to 1".to_owned(),
            "contacts stay closed",
            "",
        ),
        (
            format!("find {scene} --distance energy --minus echoes:2 --to 1"),
            "the echoes of `energy` cannot be counted",
            "another quantity",
        ),
        (
            format!("find {scene} --distance --minus endless:rod.right+rigid --to 1"),
            "no bar of finite length",
            "another",
        ),
        (format!("find {scene} --distance --minus rigid: --to 1"), "`rigid:`", "choose one of"),
        (format!("derive {scene} --model modes:3"), "no scene", "third"),
    ] {
        let (code, text, errors) = run(anywhere(), &words(&line));
        assert!(code == 2 && text.is_empty(), "{line}: {code} {text} {errors}");
        assert!(errors.contains(reason) && errors.contains(remedy), "{line}: {errors}");
    }
}
