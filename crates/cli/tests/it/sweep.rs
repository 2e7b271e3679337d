//! The command `sweep`: rows are those of `eval`, `find` and `events`, whatever the number of threads, and kept.

use super::{folder, run, words};
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::Field;
use std::fs;
use std::path::Path;

const LINE: &str = "sweep mass-on-fixed-bar --over mu=1/4..4:5:log --at 1,3 --quantity velocity --max strain_fixed --to 5";

fn output(folder: &Path, line: &str) -> String {
    let (code, out, told) = run(folder, &words(line));
    assert_eq!(code, 0, "{line}: {told}");
    out
}

/// The columns of a table by name.
fn rows(csv: &str) -> Vec<Vec<(&str, &str)>> {
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    lines.map(|line| names.iter().copied().zip(line.split(',')).collect()).collect()
}

fn cell<'a>(row: &[(&str, &'a str)], name: &str) -> &'a str {
    row.iter().find(|(own, _)| *own == name).expect("a column").1
}

#[test]
fn rows_are_what_other_commands_say() {
    let folder = folder("sweep-rows");
    let csv = output(&folder, LINE);
    let rows = rows(&csv);
    assert_eq!(rows.len(), 5);
    let double = |text: &str| text.parse::<f64>().expect(text);
    for row in &rows {
        let mu = cell(row, "mu");
        for at in ["1", "3"] {
            let line =
                format!("eval mass-on-fixed-bar --set mu={mu} --at {at} --quantity velocity");
            let told = output(&folder, &format!("{line} --digits 25"));
            let value = told.trim().split(" = ").nth(1).expect("a value");
            assert_eq!(double(cell(row, &format!("velocity({at})"))), double(value), "{line}");
        }
        let line = format!("find mass-on-fixed-bar --set mu={mu} --max strain_fixed --to 5");
        let told = output(&folder, &format!("{line} --digits 25 --format json"));
        let found: serde_json::Value = serde_json::from_str(&told).unwrap();
        let value = found["value"].as_object().unwrap();
        let value = value.get("exact").or(value.get("decimal")).unwrap().as_str().unwrap();
        assert_eq!(double(cell(row, "max(strain_fixed)")), double(value), "{line}");
    }
    let csv = output(&folder, "sweep saint-venant --over mu=1,2 --contacts");
    let contacts = self::rows(&csv);
    assert_eq!(cell(&contacts[0], "contact time hammer-rod"), "3.067667641618306");
}

/// A row says until when contacts were followed, unless nothing can meet again.
#[test]
fn contacts_that_may_close_again_are_noted() {
    let folder = folder("sweep-contacts");
    let text = "scene \"Ram\"\nsymbol m > 0\nmass ram { mass = m, velocity = 1 }\nbar pile { impedance = 1, travel = 1 }\n\
                support toe { damping = 1/2 }\nline free - ram | pile - toe - free\ncontacts open\n\
                observe f = force(pile.left)\n";
    fs::write(folder.join("ram.wave"), text).unwrap();
    let asked = "sweep ram.wave --over m=1/2,1 --contacts";
    for (to, known) in [("", "100"), (" --to 5/2", "5/2")] {
        let csv = output(&folder, &format!("{asked}{to}"));
        for row in rows(&csv) {
            let note = cell(&row, "note");
            assert_eq!(note, format!("followed until t = {known}; later contacts are not known"));
        }
    }
    let csv = output(&folder, "sweep saint-venant --over mu=1/2,1 --contacts");
    assert!(!csv.contains("followed"), "{csv}");
}

#[test]
fn threads_change_nothing() {
    let folder = folder("sweep-threads");
    let line = "sweep mass-on-fixed-bar --over mu=1/4..4:40 --at 2 --max velocity";
    let one = output(&folder, &format!("{line} --threads 1"));
    assert_eq!(one.lines().count(), 41);
    for threads in [2, 5] {
        assert_eq!(output(&folder, &format!("{line} --threads {threads}")), one);
    }
}

/// Rows that are there are taken as they are, a line that was cut off is worked out again, and another request begins anew.
#[test]
fn an_interrupted_sweep_goes_on() {
    let folder = folder("sweep-resumed");
    let whole = output(&folder, LINE);
    // What an interrupted run leaves: it is made by one whose table cannot be put in its place.
    fs::create_dir(folder.join("t.csv")).unwrap();
    let line = format!("{LINE} -o t.csv");
    assert_ne!(run(&folder, &words(&line)).0, 0);
    fs::remove_dir(folder.join("t.csv")).unwrap();
    let kept = fs::read_to_string(folder.join("t.csv.rows")).unwrap();
    assert_eq!(kept.lines().count(), 6);
    let lines: Vec<&str> = kept.lines().collect();
    let marked = lines[2].replacen("\"velocity(1)\":", "\"velocity(1)\":42.0,\"old\":", 1);
    assert_ne!(marked, lines[2]);
    let half = &lines[3][..lines[3].len() / 2];
    fs::write(folder.join("t.csv.rows"), format!("{}\n{}\n{marked}\n{half}", lines[0], lines[1]))
        .unwrap();
    let (code, _, told) = run(&folder, &words(&line));
    assert!(code == 0 && told.contains("2 rows of 5 are there already"), "{told}");
    let resumed = fs::read_to_string(folder.join("t.csv")).unwrap();
    assert!(!folder.join("t.csv.rows").exists());
    assert_eq!(resumed.matches("42.0").count(), 1, "{resumed}");
    let others = |csv: &str| -> Vec<String> {
        let rows = rows(csv);
        [0, 2, 3, 4]
            .map(|i| format!("{} {}", cell(&rows[i], "mu"), cell(&rows[i], "velocity(3)")))
            .to_vec()
    };
    assert_eq!(others(&resumed), others(&whole));
    // Rows of other values are worked out again.
    let strange = lines[1].replacen("\"mu\":", "\"mu\":77.0,\"old\":", 1);
    fs::write(folder.join("t.csv.rows"), format!("{}\n{strange}\n{}\n", lines[0], lines[2]))
        .unwrap();
    let (code, _, told) = run(&folder, &words(&line));
    assert!(code == 0 && !told.contains("already"), "{told}");
    assert_eq!(fs::read_to_string(folder.join("t.csv")).unwrap(), whole);
    // All rows are there: what is read back are the doubles that were written.
    fs::write(folder.join("t.csv.rows"), &kept).unwrap();
    let (code, _, told) = run(&folder, &words(&line));
    assert!(code == 0 && told.contains("5 rows of 5"), "{told}");
    assert_eq!(fs::read_to_string(folder.join("t.csv")).unwrap(), whole);
    // Another request does not take these rows.
    fs::write(folder.join("t.csv.rows"), &kept).unwrap();
    let other = line.replace("--at 1,3", "--at 1,2");
    let (code, _, told) = run(&folder, &words(&other));
    assert!(code == 0 && !told.contains("already"), "{told}");
    assert_eq!(
        fs::read_to_string(folder.join("t.csv")).unwrap(),
        output(&folder, &LINE.replace("--at 1,3", "--at 1,2"))
    );
}

#[test]
fn parquet_holds_the_same_table() {
    let folder = folder("sweep-parquet");
    let line = "sweep mass-on-fixed-bar --over mu=0,1/2,1 --at 1 --quantity velocity";
    let csv = output(&folder, line);
    output(&folder, &format!("{line} -o t.parquet"));
    let reader =
        SerializedFileReader::new(fs::File::open(folder.join("t.parquet")).unwrap()).unwrap();
    let read: Vec<_> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
    let table = rows(&csv);
    assert_eq!(read.len(), 3);
    for (read, row) in read.iter().zip(&table) {
        for (name, field) in read.get_column_iter() {
            match field {
                Field::Double(value) => assert_eq!(cell(row, name).parse(), Ok(*value)),
                Field::Null => assert_eq!(cell(row, name), ""),
                Field::Str(text) => assert!(name == "error" && csv.contains(&**text)),
                other => panic!("{other:?}"),
            }
        }
    }
}

#[test]
fn mistakes_are_told_before_any_work() {
    let folder = folder("sweep-mistakes");
    for (rest, message, remedy) in [
        ("--over mu --at 1", "not of the form", "mu=1,2,5"),
        ("--over mu=1..2 --at 1", "not of the form", "1/10..10:25:log"),
        ("--over mu=2..1:3 --at 1", "is empty", "write --over"),
        ("--over mu=0..1:3:log --at 1", "positive ends", "write --over"),
        ("--over mu=1 --over mu=2 --at 1", "two values are given for `mu`", "one value"),
        ("--over mu=1 --set mu=2 --at 1", "two values are given for `mu`", "one value"),
        ("--over nu=1,2 --at 1", "`nu` has a value", "its symbols are mu"),
        ("--over mu=1 --at 1 --quantity velocty", "velocty", "velocity"),
        ("--over mu=1 --at x", "x", ""),
        ("--over mu=1 --max energy --from 3 --to 2", "is empty", ""),
        ("--over mu=1", "required", "--help"),
        ("--over mu=1..2:99999999999 --at 1", "more than 1000000 values", "write --over"),
        ("--over mu=1e400,1 --at 1", "beyond the range of doubles", "write --over"),
        ("--over error=1 --at 1", "cannot be told from the column", "rename the symbol"),
        ("--over mu=1 --at 1 -o table.txt", "which kind of table", ".parquet"),
        ("--over mu=1..2:2000 --over k=1..2:2000 --at 1", "more than 1000000", "in parts"),
    ] {
        let line = format!("sweep mass-on-fixed-bar {rest}");
        let (code, out, told) = run(&folder, &words(&line));
        assert_eq!((code, out.as_str()), (2, ""), "{line}: {told}");
        assert!(told.contains(message) && told.contains(remedy), "{line}: {told}");
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}
