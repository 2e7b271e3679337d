//! Local contacts in the command: tested values, and what refuses.

use super::{anywhere, run, words};

/// Values say that they are tested; what is proven elsewhere refuses, with the exit code of its reason.
#[test]
fn the_command_tells_tested_values_from_certified_ones() {
    let run = |line: &str| run(anywhere(), &words(line));
    let (code, values, told) = run("eval hertz-striker --quantity force --at 0 --at 60us");
    assert!(code == 0 && values.starts_with("force(0 s) = 0 N\nforce(0.00006 s) = 63433."));
    assert!(!told.contains("tested"), "{told}");
    let steps = "eval hertz-striker --quantity force --at 60us --method steps:1e-10 --format json";
    let (_, json, told) = run(steps);
    assert!(told.contains("tested, not certified: computed to 1e-10"), "{told}");
    assert!(json.contains("\"bound\":null") && json.contains("\"method\":\"steps:1e-10\""));
    let (code, checked, _) = run("check local-contact --verbose");
    assert!(code == 0 && checked.contains("`tip` is a local contact"), "{checked}");
    let file = anywhere().join("hertz-striker.csv");
    let (code, _, told) =
        run(&format!("plot hertz-striker --quantity force -o {}", file.display()));
    assert!(code == 0, "{told}");
    // The picture's values are those of `eval`.
    let drawn = std::fs::read_to_string(&file).unwrap();
    let mut points = drawn.lines().filter_map(|line| {
        let numbers: Vec<f64> = line.split(',').filter_map(|field| field.parse().ok()).collect();
        <[f64; 2]>::try_from(numbers).ok()
    });
    let [time, force] = points.find(|[time, _]| *time >= 60.0).unwrap();
    let (code, told, _) = run(&format!("eval hertz-striker --quantity force --at {time}us"));
    assert!(code == 0 && time < 62.0, "{told}");
    let newtons = told.split(['=', 'N']).nth(1).unwrap();
    let exact: f64 = newtons.trim().parse().unwrap();
    assert!((1000.0 * force - exact).abs() < 1e-9 * exact, "{force} kN and {told}");
    for (line, expected, reason) in [
        ("derive hertz-striker --general", 1, "no recurrence"),
        ("derive local-contact --explain", 1, "stiffness = 335423000 N/m"),
        ("eval hertz-striker --quantity force --at 0 --method modes", 1, "linear elements"),
        ("eval hertz-striker --quantity force --at 0 --method plain", 1, "exact solution"),
        ("eval hertz-striker --quantity other --at 0", 2, "neither a wave nor"),
    ] {
        let (code, output, told) = run(line);
        assert!(code == expected && output.is_empty(), "{line}: {code} {output}");
        assert!(told.contains(reason) && told.contains("help: "), "{line}: {told}");
    }
}
