//! `wavestep dispersion`: what it prints, its exit codes, and that its forms agree.

use super::{anywhere, run};
use serde_json::Value;

fn text(arguments: &[&str]) -> String {
    let (code, out, errors) = run(anywhere(), &[&["dispersion"], arguments].concat());
    assert_eq!((code, errors.as_str()), (0, ""), "{arguments:?}");
    out
}

fn refused(arguments: &[&str]) -> (i32, String) {
    let (code, out, errors) = run(anywhere(), &[&["dispersion"], arguments].concat());
    assert!(out.is_empty(), "{arguments:?}");
    (code, errors)
}

#[test]
fn a_name_and_its_formula_say_the_same() {
    let named = text(&["lattice", "--at", "1", "--length", "10"]);
    let written = text(&["2*sin(k/2)", "--at", "1", "--length", "10"]);
    assert_eq!(named.split_once("\n\n").unwrap().1, written);
    // 2 sin(1/2), sin(1/2)·2/1, cos(1/2)
    for value in ["omega = 0.958851077208406", "c_g   = 0.877582561890373"] {
        assert!(written.contains(value), "{written}");
    }
}

#[test]
fn closed_forms_and_digits() {
    let told = text(&["cubic", "--length", "10", "--digits", "20"]);
    // 1 − (π² − 6)/300
    assert!(told.contains("c_pp  = 51/50 - pi^2/300\n      = 0.98710131866303547127\n"), "{told}");
    let told = text(&["cubic", "--pulse", "triangle"]);
    assert!(told.ends_with("c_pp  = 1 - 2/(3*b^2) - pi^2/(9*b^2)\n"), "{told}");
    let latex = text(&["beam", "--at", "1/2", "--pulse", "square", "--format", "latex"]);
    for part in
        ["\\begin{align*}\n\\omega &= k^{2} \\\\", "\\left(\\frac{1}{2}\\right) &= \\frac{1}{4}"]
    {
        assert!(latex.contains(part), "{latex}");
    }
}

#[test]
fn json_says_what_text_says() {
    let arguments = ["love", "--set", "κ=1/2", "--at", "1", "--length", "8", "--propagate", "3"];
    let told = text(&arguments);
    let json: Value =
        serde_json::from_str(&text(&[&arguments[..], &["--format", "json"]].concat())).unwrap();
    assert_eq!(json["relation"]["omega"], "k/sqrt(1 + k^2/2)");
    let peak = json["pulse"]["peak_velocity"]["value"].as_str().unwrap();
    let seen = json["pulse"]["seen"]["velocity"].as_str().unwrap();
    assert!(told.contains(peak) && told.contains(seen), "{told}{json}");
    let value = json["at"][0]["omega"]["value"].as_str().unwrap();
    assert_eq!(value, "0.816496580927726"); // √(2/3)
    let (peak, seen): (f64, f64) = (peak.parse().unwrap(), seen.parse().unwrap());
    assert!((peak - seen).abs() < 1e-3);
}

#[test]
fn mistakes_are_told_with_a_remedy() {
    for (arguments, code, parts) in [
        (&["latice"][..], 2, ["no relation `latice`", "did you mean `lattice`?"]),
        (&["k/0"], 2, ["division by zero", "relation:1:3"]),
        (&["love", "--at", "1"], 2, ["the parameter kappa has no value", "--set kappa=1"]),
        (&["cubic", "--set", "a=1"], 2, ["no parameter `a`", "remove it"]),
        (&["cubic", "--length", "-1"], 2, ["the length of the pulse is -1", "positive"]),
        (&["cubic", "--length", "1"], 1, ["ω is negative at k = 6.28", "longer pulse"]),
        (&["lattice", "--duration", "3"], 1, ["has no root", "longer duration"]),
        (&["sqrt(1 - k)", "--length", "2"], 1, ["not real at k = 3.14", "longer pulse"]),
        (&["lattice", "--pulse", "square"], 2, ["no closed form", "--length 10"]),
        (&["lattice", "--pulse", "exp(-k)"], 2, ["needs a cut-off", "--duration"]),
        (&["cubic", "--propagate", "3"], 2, ["needs a pulse", "--length"]),
        (&["cubic", "--length", "9", "--propagate", "0"], 2, ["not positive", "give a positive"]),
    ] {
        let (status, errors) = refused(arguments);
        assert_eq!(status, code, "{arguments:?}: {errors}");
        for part in parts {
            assert!(errors.contains(part), "{arguments:?}: {errors}");
        }
    }
}

#[test]
fn a_wavenumber_with_a_negative_frequency_is_named() {
    let (code, errors) = refused(&["cubic", "--at", "1", "--at", "4"]);
    assert!(code != 0 && errors.contains("ω is negative at k = 4"), "{errors}");
}

#[test]
fn a_parameter_is_not_the_length_of_the_pulse() {
    let (code, errors) = refused(&["k - b*k^3", "--pulse", "square"]);
    assert!(code != 0 && errors.contains("`b` is both the length of the pulse"), "{errors}");
    // With a value it is a parameter as others are.
    let [b, a] = ["b", "a"].map(|name| {
        let formula = format!("k - {name}*k^3");
        text(&[&formula, "--set", &format!("{name}=1/12"), "--length", "10"])
    });
    assert_eq!(a, b);
}
