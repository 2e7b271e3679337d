//! LaTeX that typesetters take: TeX with amsmath where it is installed, KaTeX where node and the
//! package are. Each is left out with a message where it is missing.

use super::{ROOT, anywhere, folder, run, words};
use std::collections::BTreeMap;
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

const SCENES: [&str; 4] = ["two-bars", "constant-force", "pulse-shape", "rigid-mass"];

/// Every kind of LaTeX that the command writes, by the arguments that ask for it.
fn displays() -> BTreeMap<String, String> {
    let mut asked = Vec::new();
    for scene in SCENES {
        asked.push(format!("{scene} --through 4 --source-form"));
        asked.push(format!("{scene} --through 8"));
        asked.push(format!("{scene} --through 3 --form echo"));
        asked.push(format!("{scene} --through 2 --form piecewise"));
        asked.push(format!("{scene} --general"));
    }
    asked.push("two-bars --general --source-form".to_owned());
    asked.push("constant-force --general --source-form".to_owned());
    for scene in ["rigid-mass", "pulse-shape"] {
        asked.push(format!("{scene} --through 6 --line-length 60"));
        asked.push(format!("{scene} --through 4 --source-form --line-length 60"));
    }
    for observable in ["velocity", "strain_impact", "strain_fixed"] {
        asked.push(format!("rigid-mass --quantity {observable}"));
    }
    for scene in ["pile --quantity cushion --through 1", "incommensurate --quantity g_striker"] {
        asked.push(scene.to_owned());
    }
    asked.push("mass-on-fixed-bar --quantity momentum".to_owned());
    asked.push("hopkinson --quantity specimen --piece 6".to_owned());
    let latex = |asked: String| {
        let (code, out, err) = run(anywhere(), &words(&format!("derive --format latex {asked}")));
        assert_eq!(code, 0, "{asked}: {err}");
        (asked, out)
    };
    asked.into_iter().map(latex).collect()
}

/// Whether a program is installed.
fn installed(program: &str) -> bool {
    let silent = Command::new(program).arg("--version").stdout(Stdio::null()).status();
    silent.is_ok_and(|status| status.success())
}

/// Says that a test is left out, past the capture of output; where everything must be there, fails.
fn skip(message: &str) {
    let _ = writeln!(std::io::stderr(), "skipped: {message}");
    assert!(std::env::var_os("WAVESTEP_NEEDS_TYPESETTERS").is_none(), "{message}");
}

/// What TeX says of a document with this display and page.
fn typeset(directory: &Path, name: &str, page: &str, display: &str) -> Result<(), String> {
    let document = format!(
        "\\documentclass{{article}}\n{page}\n\
         \\usepackage{{amsmath}}\n\\allowdisplaybreaks\n\\begin{{document}}\n{display}\
         \\end{{document}}\n"
    );
    fs::write(directory.join(format!("{name}.tex")), document).expect("a file");
    let output = Command::new("pdflatex")
        .args(["-interaction=nonstopmode", "-halt-on-error", name])
        .current_dir(directory)
        .output()
        .expect("TeX runs");
    let log = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() { Ok(()) } else { Err(log) }
}

#[test]
fn tex_typesets_every_display() {
    if !installed("pdflatex") {
        return skip("TeX is not installed (Debian package texlive-latex-base)");
    }
    let directory = folder("typeset-tex");
    let all = displays();
    // What the lengths of lines promise: 84 fits A4 with margins of 2 cm, 60 the class as it is.
    let (narrow, wide): (Vec<_>, Vec<_>) =
        all.into_iter().partition(|(asked, _)| asked.contains("--line-length"));
    let margins = "\\usepackage[a4paper,margin=2cm]{geometry}";
    for (name, page, displays) in [("wide", margins, wide), ("narrow", "", narrow)] {
        let text: String = displays.into_iter().map(|(_, display)| display).collect();
        typeset(&directory, name, page, &text).unwrap_or_else(|log| panic!("{log}"));
        let log = fs::read_to_string(directory.join(format!("{name}.log"))).expect("a log");
        assert!(!log.contains("Overfull"), "a line is wider than the page:\n{log}");
    }
    // The check itself can fail.
    let bad = "\\begin{align*} x &= \\frac{1} \\end{align*}";
    assert!(typeset(&directory, "bad", margins, bad).is_err());
}

/// Derivations are documents of sections, sentences and displays.
#[test]
fn tex_typesets_every_derivation() {
    if !installed("pdflatex") {
        return skip("TeX is not installed (Debian package texlive-latex-base)");
    }
    let directory = folder("typeset-tex-derivations");
    let margins = "\\usepackage[a4paper,margin=2cm]{geometry}";
    let built = ["mass-on-fixed-bar", "cushioned-impact", "pile", "hopkinson", "percussive-drill"];
    let pieces = SCENES.into_iter().chain(built).map(|scene| (scene, "period"));
    let echoes = ["rigid-mass", "mass-on-fixed-bar"].map(|scene| (scene, "echo"));
    for (scene, form) in pieces.chain(echoes) {
        let line = ["derive", scene, "--exercise", "--form", form, "--format", "latex"];
        let (code, text, err) = run(anywhere(), &line);
        assert_eq!(code, 0, "{scene}: {err}");
        typeset(&directory, scene, margins, &text).unwrap_or_else(|log| panic!("{log}"));
        let log = fs::read_to_string(directory.join(format!("{scene}.log"))).expect("a log");
        assert!(!log.contains("Overfull") && !log.contains("multiply defined"), "{log}");
    }
}

const KATEX: &str = "
const katex = require(process.argv[1]);
const displays = JSON.parse(require('fs').readFileSync(0, 'utf8'));
for (const [asked, latex] of Object.entries(displays)) {
    try {
        katex.renderToString(latex, { displayMode: true, throwOnError: true, strict: 'error' });
    } catch (error) {
        console.error(asked + ': ' + error.message);
        process.exitCode = 1;
    }
}
";

/// What KaTeX says of displays.
fn render(katex: &Path, displays: &BTreeMap<String, String>) -> Result<(), String> {
    let mut child = Command::new("node")
        .args(["-e", KATEX])
        .arg(katex)
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("node runs");
    let input = serde_json::to_string(displays).expect("JSON");
    child.stdin.take().expect("a pipe").write_all(input.as_bytes()).expect("node reads");
    let output = child.wait_with_output().expect("node ends");
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.success() { Ok(()) } else { Err(errors) }
}

/// KaTeX is looked for where `npm install --prefix target/katex katex` puts it.
#[test]
fn katex_renders_every_display() {
    let katex = Path::new(ROOT).join("target/katex/node_modules/katex");
    if !installed("node") || !katex.is_dir() {
        return skip("node or its package katex is not installed in target/katex");
    }
    render(&katex, &displays()).unwrap_or_else(|errors| panic!("{errors}"));
    // The check itself can fail.
    let bad = BTreeMap::from([("bad".to_owned(), "\\frac{1}".to_owned())]);
    assert!(render(&katex, &bad).is_err());
}
