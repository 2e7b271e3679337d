//! What is written is the same on every machine: with each set of vector instructions, byte by byte.

use super::{folder, run, words};
use std::fs;

/// Scenes with values for their symbols; those that state equations have no line to draw.
const SCENES: [&str; 8] = [
    "rigid-mass --set mu=1",
    "mass-on-fixed-bar --set mu=1/4",
    "mass-between-bars --set m=2",
    "stepped-striker",
    "hopkinson",
    "pile",
    "incommensurate",
    "saint-venant --set mu=1",
];

#[test]
fn all_instructions_write_the_same_bytes() {
    let folder = folder("everywhere");
    let mut compared = 0;
    for scene in SCENES {
        let states_equations = scene.starts_with("rigid-mass");
        let diagram = format!("plot {scene} --diagram force -o d.svg");
        let lock = format!("lock {scene} --at 1 -o d.svg");
        let lines = [
            format!("plot {scene} -o d.svg"),
            format!("plot {scene} -o d.json"),
            format!("derive {scene} --through 2 --format json"),
            if states_equations { lock } else { diagram },
        ];
        for line in &lines {
            let written = ["baseline", "avx2", "avx512"].map(|set| {
                let (code, out, told) =
                    run(&folder, &words(&format!("{line} --instructions {set}")));
                let file = line.split(" -o ").nth(1);
                assert_eq!(code, 0, "{line}: {told}");
                file.map_or(out.into_bytes(), |file| fs::read(folder.join(file)).unwrap())
            });
            assert!(written.iter().all(|own| *own == written[0]), "{line}");
            compared += usize::from(!written[0].is_empty());
        }
    }
    assert!(compared == 32, "{compared}");
    assert_ne!(run(&folder, &words("derive two-bars --instructions neon")).0, 0);
}

/// The tables of C are doubles that were rounded from exact coefficients, whatever the instructions.
#[test]
fn exported_functions_are_the_same() {
    let folder = folder("everywhere-c");
    for scene in ["mass-on-fixed-bar --set mu=1", "hopkinson", "saint-venant --set mu=1"] {
        let quantity = if scene.starts_with("hopkinson") { "force" } else { "velocity" };
        let to = if scene.starts_with("hopkinson") { "1ms" } else { "8" };
        let written = ["baseline", "avx512"].map(|set| {
            let line = format!(
                "export {scene} --quantity {quantity} --from 0 --to {to} --as c --instructions {set}"
            );
            let (code, out, told) = run(&folder, &words(&line));
            assert_eq!(code, 0, "{line}: {told}");
            out
        });
        assert!(written[0] == written[1] && written[0].len() > 1000, "{scene}");
    }
}
