//! One word for each meaning, and a suggestion for every word that is misspelt.

use super::{ROOT, folder, run};
use std::collections::BTreeMap;
use std::fs;

/// A scene that all is well with.
const SCENE: &str = "scene \"Two bars\"
material steel { modulus = 210 GPa, density = 7850 kg/m^3 }
bar striker { material = steel, diameter = 20 mm, length = 300 mm, velocity = 10 m/s }
spring pad { stiffness = 40 kN/mm, damping = 2 N*s/m }
bar rod { material = steel, diameter = 20 mm, length = 1500 mm }
line free - striker | pad - rod - fixed
observe force = force(pad)
observe end = velocity(rod.left)
";

/// A word of the scene, how it is misspelt, and what is suggested.
const IN_SCENES: [(&str, &str, &str); 41] = [
    ("kN/mm", "kN/mmm", "mm"),
    ("GPa", "Gpa", "GPa"),
    ("210 GPa", "210 GPaa", "GPa"),
    ("N*s/m", "N*sec/m", "s"),
    ("m/s", "m/second", "s"),
    ("20 mm", "20 milimeter", "mm"),
    ("300 mm", "300 MM", "mm"),
    ("300 mm", "300 mmm", "mm"),
    ("10 m/s", "10 meter/s", "m"),
    ("40 kN", "40 KN", "kN"),
    ("2 N", "2 newtons", "N"),
    ("scene", "scen", "scene"),
    ("material steel {", "materal steel {", "material"),
    ("bar striker {", "baar striker {", "bar"),
    ("bar rod {", "rod rod {", "bar"),
    ("spring pad", "sprng pad", "spring"),
    ("line", "lin", "line"),
    ("observe force", "obsrve force", "observe"),
    ("observe end", "output end", "observe"),
    ("modulus", "modulos", "modulus"),
    ("density", "desnity", "density"),
    ("{ material = steel", "{ materal = steel", "material"),
    ("material = steel", "material = stel", "steel"),
    ("diameter", "diametre", "diameter"),
    ("length", "lenght", "length"),
    ("velocity = 10", "velocty = 10", "velocity"),
    ("stiffness", "stifness", "stiffness"),
    ("damping", "dampning", "damping"),
    ("free", "fre", "free"),
    ("fixed", "fixd", "fixed"),
    ("fixed", "endles", "endless"),
    ("- striker", "- stiker", "striker"),
    ("| pad", "| pda", "pad"),
    ("= force(", "= forc(", "force"),
    ("= force(", "= compresion(", "compression"),
    ("= velocity(", "= displacment(", "displacement"),
    ("= velocity(", "= stran(", "strain"),
    ("(pad)", "(pda)", "pad"),
    ("(rod.left)", "(rdo.left)", "rod"),
    ("rod.left", "rod.lef", "left"),
    ("rod.left", "rod.att(1/2)", "at"),
];

/// A command with a word misspelt, and what is suggested.
const IN_COMMANDS: [(&str, &str); 32] = [
    ("derive hopkinsn", "hopkinson"),
    ("scenes hopkinsn", "hopkinson"),
    ("check rigid-mas", "rigid-mass"),
    ("derrive rigid-mass", "derive"),
    ("evl rigid-mass", "eval"),
    ("plott rigid-mass", "plot"),
    ("evnts hopkinson", "events"),
    ("eval hopkinson --quantty force --at 1ms", "--quantity"),
    ("eval hopkinson --quantity forc --at 1ms", "force"),
    ("eval hopkinson --quantity force --at 1mss", "ms"),
    ("eval hopkinson --at 1ms --dgits 9", "--digits"),
    ("eval hopkinson --at 1ms --formt json", "--format"),
    ("eval hopkinson --at 1ms --format jsn", "json"),
    ("eval hopkinson --quantity force --at 1ms --method certifed", "certified"),
    ("eval hopkinson --quantity force --at 1ms --method mods:20", "modes:20"),
    ("eval rigid-mass --set muu=1 --at 1", "mu"),
    ("derive rigid-mass --format latx", "latex"),
    ("derive mass-on-fixed-bar --model thrd", "third"),
    ("derive rigid-mass --quantity velocty", "velocity"),
    ("derive incommensurate --quantity contact_forc", "contact_force"),
    ("events hopkinson --form 1ms", "--format"),
    ("find hopkinson --max momentm --to 1ms", "momentum"),
    ("find hopkinson --zero Force --to 1ms", "force"),
    ("find hopkinson --level 'force=3 kNN' --to 1ms", "kN"),
    ("find hopkinson --max force --minus endles:incident.right --to 1ms", "endless:incident.right"),
    ("find hopkinson --max force --minus endless:incident --to 1ms", "endless:incident.right"),
    ("find hopkinson --distance force --minus rigd:striker --to 1ms", "rigid:striker"),
    ("find hopkinson --distance force --minus rigid:strker --to 1ms", "striker"),
    ("plot hopkinson --diagramm force -o x.svg", "--diagram"),
    ("plot hopkinson --diagram forc -o x.svg", "force"),
    ("plot hopkinson -o x.sgv", "x.svg"),
    ("dispersion latice --wavenumber 1", "lattice"),
];

/// The arguments of a command; single quotes keep blanks.
fn words(line: &str) -> Vec<&str> {
    let parts = line.split('\'').enumerate();
    parts
        .flat_map(|(i, part)| if i % 2 == 0 { part.split(' ').collect() } else { vec![part] })
        .filter(|word| !word.is_empty())
        .collect()
}

#[test]
fn misspelt_words_of_scenes_are_told_with_place_and_suggestion() {
    let folder = folder("misspelt");
    fs::write(folder.join("s.wave"), SCENE).unwrap();
    assert_eq!(run(&folder, &["check", "s.wave"]).0, 0);
    for (word, misspelt, meant) in IN_SCENES {
        assert!(SCENE.contains(word), "{word}");
        let text = SCENE.replacen(word, misspelt, 1);
        fs::write(folder.join("s.wave"), &text).unwrap();
        let (code, out, errors) = run(&folder, &["check", "s.wave"]);
        let suggestion = format!("did you mean `{meant}`?");
        assert!(
            code == 2 && out.is_empty() && errors.contains(&suggestion),
            "{misspelt}: {errors}"
        );
        let line = SCENE[..SCENE.find(word).unwrap()].matches('\n').count() + 1;
        assert!(errors.contains(&format!("--> s.wave:{line}:")), "{misspelt}: {errors}");
    }
}

#[test]
fn misspelt_words_of_commands_are_told_with_a_suggestion() {
    let folder = folder("misspelt-commands");
    for (line, meant) in IN_COMMANDS {
        let (code, out, errors) = run(&folder, &words(line));
        assert!(code == 2 && out.is_empty(), "{line}: {errors}");
        let tells = [format!("`{meant}`?"), format!("'{meant}'")];
        let told = errors.lines().find(|line| line.contains("help: ") || line.contains("tip: "));
        let told = told.unwrap_or_else(|| panic!("{line}: {errors}"));
        assert!(tells.iter().any(|own| told.contains(own)), "{line}: {errors}");
        assert!(!errors.contains("'-- "), "{line}: {errors}");
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

/// The rows of the page of options: each option with its meaning and its commands.
fn rows(page: &str) -> Vec<[String; 3]> {
    let table = page.lines().filter(|line| line.starts_with("| `"));
    let cells = |line: &str| -> Vec<String> {
        let line = line.trim_matches('|').replace("\\|", "\u{0}");
        line.split('|').map(|cell| cell.trim().replace('\u{0}', "|")).collect()
    };
    table.map(|line| cells(line).try_into().expect("three cells")).collect()
}

#[test]
fn the_page_of_options_is_what_the_command_has() {
    let file = format!("{ROOT}/docs/options.md");
    let page = fs::read_to_string(&file).unwrap();
    let (code, table, _) = run(&folder("options"), &["generate", "options"]);
    assert_eq!(code, 0);
    let (introduction, _) = page.split_once("| Option").expect("a table");
    assert!(introduction.starts_with("# Options\n"));
    let real = introduction.to_owned() + &table;
    if std::env::var_os("UPDATE_DOCUMENTS").is_some() {
        fs::write(&file, &real).unwrap();
    }
    assert!(real == fs::read_to_string(&file).unwrap(), "run with UPDATE_DOCUMENTS=1");
}

/// No two words for one meaning: instants and windows of time are asked for by these options alone, and an option has one
/// kind of value but for those named here.
#[test]
fn each_meaning_has_one_word() {
    let page = fs::read_to_string(format!("{ROOT}/docs/options.md")).unwrap();
    let (mut values, mut meanings) = (BTreeMap::<String, Vec<String>>::new(), BTreeMap::new());
    for [option, meaning, _] in rows(&page) {
        let option = option.trim_matches('`').trim_start_matches("-o, ").to_owned();
        let (name, value) = option.split_once(' ').unwrap_or((&option, ""));
        if value == "T" {
            assert!(["--at", "--from", "--to", "--propagate"].contains(&name), "{name}");
        }
        values.entry(name.to_owned()).or_default().push(value.to_owned());
        if let Some(other) = meanings.insert(meaning.clone(), name.to_owned()) {
            assert_eq!(other, name, "{meaning}");
        }
    }
    assert!(values.len() >= 40);
    let several = values.iter().filter(|(_, values)| values.len() > 1);
    let several: Vec<&str> = several.map(|(name, _)| &name[..]).collect();
    assert_eq!(several, ["--costs", "--from", "--output"]);
}

/// Spellings of earlier versions go on working.
#[test]
fn old_spellings_mean_the_same() {
    let folder = folder("old-spellings");
    for (old, new) in [
        ("events saint-venant --set mu=1 --until 3", "events saint-venant --set mu=1 --to 3"),
        (
            "field mass-on-fixed-bar --set mu=1 --time 1 --mesh 2",
            "field mass-on-fixed-bar --set mu=1 --at 1 --mesh 2",
        ),
        ("eval hopkinson --at 1ms --at 2ms", "eval hopkinson --at 1ms,2ms"),
        ("dispersion lattice --at 1", "dispersion lattice --wavenumber 1"),
        ("derive rigid-mass --wave f", "derive rigid-mass --quantity f"),
        (
            "derive rigid-mass --observable strain_fixed",
            "derive rigid-mass --quantity strain_fixed",
        ),
    ] {
        let [old, new] = [old, new].map(|line| run(&folder, &words(line)));
        assert!(old.0 == 0 && old == new, "{old:?}\n{new:?}");
    }
}

/// Without a quantity all observables are told; a scene may come from standard input, and a report go to a file.
#[test]
fn all_observables_are_told_where_none_is_named() {
    let folder = folder("all-observables");
    let ask = |line: &str| {
        let (code, out, errors) = run(&folder, &words(line));
        assert_eq!(code, 0, "{line}: {errors}");
        out
    };
    let all = ask("eval rigid-mass --set mu=1 --at 1,5/2");
    let names = ["velocity", "strain_impact", "strain_fixed"];
    let each =
        names.map(|name| ask(&format!("eval rigid-mass --set mu=1 --quantity {name} --at 1,5/2")));
    let mut lines: Vec<&str> = each.iter().flat_map(|own| own.lines()).collect();
    let mut told: Vec<&str> = all.lines().collect();
    lines.sort_unstable();
    told.sort_unstable();
    assert_eq!(lines, told);
    let csv = ask("eval rigid-mass --set mu=1 --at 1 --format csv");
    assert!(csv.starts_with("quantity,time,") && csv.lines().count() == 4, "{csv}");
    let json: serde_json::Value =
        serde_json::from_str(&ask("eval rigid-mass --set mu=1 --at 1 --format json")).unwrap();
    assert_eq!(json.as_array().unwrap().len(), 3);
    assert!(ask("eval rigid-mass --set mu=1 --at 1,5/2 -o all.txt").starts_with("all.txt: "));
    assert_eq!(fs::read_to_string(folder.join("all.txt")).unwrap(), all);
}

#[test]
fn a_scene_may_come_from_standard_input() {
    let folder = folder("standard-input");
    fs::write(folder.join("s.wave"), SCENE).unwrap();
    let mut command = super::command(&folder, &["eval", "-", "--at", "1ms", "-o", "-"]);
    command.stdin(fs::File::open(folder.join("s.wave")).unwrap());
    let output = command.output().unwrap();
    assert!(output.status.success());
    let named = run(&folder, &["eval", "s.wave", "--at", "1ms"]);
    assert_eq!(String::from_utf8(output.stdout).unwrap(), named.1);
}

/// No report replaces what was read, by whichever path, nor a file that is protected.
#[test]
fn what_is_read_is_not_replaced() {
    let folder = folder("read-and-written");
    fs::write(folder.join("s.wave"), SCENE).unwrap();
    for name in ["t.wave", "s.html"] {
        fs::write(folder.join(name), SCENE).unwrap();
    }
    let other = format!("{}/../read-and-written/s.wave", folder.display());
    for line in [
        "derive s.wave -o s.wave".to_owned(),
        format!("derive s.wave -o {other}"),
        "report s.html -o s.html".to_owned(),
        "find s.wave --distance force --minus t.wave --to 1ms -o t.wave".to_owned(),
    ] {
        let (code, out, errors) = run(&folder, &words(&line));
        assert!(
            code == 2 && out.is_empty() && errors.contains("what was read"),
            "{line}: {errors}"
        );
    }
    for file in ["s.wave", "t.wave", "s.html"] {
        assert_eq!(fs::read_to_string(folder.join(file)).unwrap(), SCENE);
    }
}

/// A title cannot end the text of the scene in an exercise in LaTeX, and Greek letters are spelt there.
#[test]
fn the_text_of_an_exercise_stays_verbatim() {
    let folder = folder("verbatim");
    let text = SCENE.replace("Two bars", "\\end{verbatim} μ").replace("pad", "σ_1");
    fs::write(folder.join("s.wave"), text).unwrap();
    let line = "derive s.wave --exercise --through 0 --format latex";
    let (code, latex, errors) = run(&folder, &words(line));
    assert_eq!(code, 0, "{errors}");
    assert_eq!(latex.matches("\\end{verbatim}").count(), 1);
    assert!(latex.contains("\\ end{verbatim} mu") && latex.contains("spring sigma_1 {"), "{latex}");
}

/// A step gives the same times as as many points, and the last one lies within the window.
#[test]
fn evenly_spaced_times_by_step() {
    let told = |rest: &str| {
        let line = format!("eval rigid-mass --set mu=1 --quantity f --digits 5 {rest}");
        run(&folder("steps"), &words(&line))
    };
    let (code, by_points, _) = told("--from 1/2 --to 2 --points 4");
    assert_eq!((code, by_points.lines().count()), (0, 4));
    for to in ["2", "9/4"] {
        assert_eq!(told(&format!("--from 1/2 --to {to} --step 1/2")).1, by_points);
    }
    for (rest, message) in [
        ("--from 0 --to 1 --step 0", "the step is not positive"),
        ("--from 0 --to 1 --step -1", "the step is not positive"),
        ("--from 0 --to 1 --step 1e-9", "1000000"),
        ("--from 0 --to 1 --step 1e-99", "1000000"),
        ("--from 0 --to 1 --step 1/2 --points 3", "cannot be used with"),
        ("--from 0 --to 1", "--points"),
    ] {
        let (code, out, errors) = told(rest);
        assert_eq!((code, out.as_str()), (2, ""), "{rest}");
        assert!(errors.contains(message), "{rest}: {errors}");
    }
}
