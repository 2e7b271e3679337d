//! C files: compiled without warnings, run, and compared with enclosures and with each other.

use crate::methods::subject::{Subject, with};
use crate::methods::tally::{Tally, ends};
use crate::methods::{Values, exact, random, times};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use wavestep::export::{CHeading, to_c};
use wavestep::signal::Limit;

/// Options under which compilers shall find nothing.
const STRICT: [&str; 5] = ["-std=c89", "-Wall", "-Wextra", "-Werror", "-pedantic"];

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("methods-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Compiles a file and runs it; what it prints.
fn run(folder: &Path, file: &str, level: &str) -> String {
    let program = folder.join(format!("{file}{level}"));
    let mut compile = Command::new("cc");
    compile.current_dir(folder).args(STRICT).arg(level).arg(file).arg("-o").arg(&program);
    // The linker of Rust programs is the same command.
    let compiled = compile.output().expect("cc, a C compiler");
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let output = Command::new(&program).output().unwrap();
    assert!(output.status.success(), "{file} {level} fails");
    String::from_utf8(output.stdout).unwrap()
}

/// A program around the function that prints, for each time, the bits of the value, those of the value
/// from the function for many times, and the time as it was read.
fn program(c: &str, quantity: &str, at: &[f64]) -> String {
    let times: Vec<String> = at.iter().map(|time| format!("{time:.17e}")).collect();
    let mut program = c.to_owned();
    let _ = write!(
        program,
        "\n#include <stdio.h>\n#include <string.h>\n\n\
         static const double at[] = {{\n    {}\n}};\n\n\
         static void show(double value)\n{{\n    unsigned char bytes[8];\n    int i;\n    \
         memcpy(bytes, &value, 8);\n    for (i = 0; i < 8; i++)\n        printf(\"%02x\", bytes[i]);\n}}\n\n\
         int main(void)\n{{\n    static double many[sizeof at / sizeof *at];\n    \
         const size_t n = sizeof at / sizeof *at;\n    size_t i;\n    \
         wavestep_{quantity}_many(at, many, n);\n    for (i = 0; i < n; i++) {{\n        \
         show(wavestep_{quantity}(at[i]));\n        putchar(' ');\n        show(many[i]);\n        \
         putchar(' ');\n        show(at[i]);\n        putchar('\\n');\n    }}\n    \
         show(WAVESTEP_{upper}_BOUND);\n    putchar('\\n');\n    return 0;\n}}\n",
        times.join(",\n    "),
        upper = quantity.to_uppercase(),
    );
    program
}

/// A double from the hexadecimal digits of its bytes in memory.
fn double(bytes: &str) -> f64 {
    let byte = |i: usize| u8::from_str_radix(&bytes[2 * i..2 * i + 2], 16).expect("a byte");
    f64::from_ne_bytes(std::array::from_fn(byte))
}

fn check(name: &str, quantity: &str, subject: &Subject<'_>, tolerance: Option<f64>) -> Tally {
    let mut tally = Tally::new("C, of the bound in the file");
    let compiled = subject.compiled(tolerance).unwrap();
    let heading = CHeading {
        title: format!("{} */ int main(void);", subject.name),
        quantity: quantity.to_owned(),
        unit: String::new(),
        time_unit: "s".to_owned(),
        note: String::new(),
        command: "wavestep export".to_owned(),
    };
    let c = to_c(&compiled, &heading);
    let (first, last) = times::ends(subject);
    let mut at = times::anywhere(subject, &mut random(61), 400);
    at.sort_by(f64::total_cmp);
    at.extend(times::special(subject));
    at.extend(compiled.pieces().iter().rev().map(|piece| piece.start));
    at.extend(times::anywhere(subject, &mut random(62), 200));
    let inside = at.len();
    let below = if first > 0.0 { first.next_down() } else { -f64::MIN_POSITIVE };
    at.extend([below, last.next_up(), -1e300, 1e300, first - 1.0, 2.0 * last]);
    let folder = folder(name);
    fs::write(folder.join("program.c"), program(&c, quantity, &at)).unwrap();
    let optimised = run(&folder, "program.c", "-O2");
    let plain = run(&folder, "program.c", "-O0");
    let mut before: Option<Vec<f64>> = None;
    for printed in [optimised, plain] {
        let lines: Vec<&str> = printed.lines().collect();
        assert_eq!(lines.len(), at.len() + 1);
        let bound = double(lines[at.len()]);
        assert_eq!(Some(bound), wavestep::signal::Evaluator::bound(&compiled));
        let mut values = Vec::new();
        for (i, line) in lines[..at.len()].iter().enumerate() {
            let columns: Vec<f64> = line.split(' ').map(double).collect();
            let [value, many, time] = columns[..] else { panic!("{line}") };
            assert_eq!(time.to_bits(), at[i].to_bits(), "a time is read as another one");
            assert_eq!(value.to_bits(), many.to_bits(), "{time:?}: one and many");
            if i >= inside {
                assert!(value.is_nan(), "{time:?} outside the window has the value {value}");
                continue;
            }
            values.push(value);
            // What is optimised and what is not seldom differ.
            if before.as_ref().is_none_or(|before| before[i] != value) {
                let enclosed = ends(&subject.exact(&exact(time), Limit::Right));
                let place = || format!("{time:?} in {}", subject.name);
                tally.within(value, enclosed, &exact(bound), place);
            }
        }
        before = Some(values);
    }
    tally
}

/// A scene, its values, an observable, a window and a tolerance.
type Window<'a> = (&'a str, Values<'a>, &'a str, (&'a str, &'a str), Option<f64>);

#[test]
fn values_in_c_are_within_the_bound() {
    let mut tally = Tally::new("C, of the bound in the file");
    let mass: Values<'_> = &[("mu", "3/7")];
    let scenes: [Window<'_>; 6] = [
        ("rigid-mass", mass, "strain_fixed", ("0", "9"), None),
        ("rigid-mass", mass, "velocity", ("7/2", "11"), Some(1e-6)),
        ("stepped-striker", &[], "pulse", ("0", "9"), None),
        ("hopkinson", &[], "gauge_output", ("0", "1/2500"), Some(1e-9)),
        ("incommensurate", &[], "wall_force", ("0", "1/5000"), None),
        // One polynomial, and a loop over pieces that has nothing to look for.
        ("rigid-mass", mass, "f", ("1/100", "1/50"), Some(1e-3)),
    ];
    for (i, (scene, values, quantity, window, tolerance)) in scenes.into_iter().enumerate() {
        let found = with(scene, values, quantity, window, |subject| {
            check(&format!("c-{i}"), quantity, subject, tolerance)
        });
        tally.add(&found);
    }
    tally.report(3_500);
}
