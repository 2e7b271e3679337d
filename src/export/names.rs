//! Symbols that are written otherwise than by their own names, and names in LaTeX.

use crate::export::notation::Notation;
use std::collections::BTreeMap;
use wavestep_polynomial::Symbol;

/// The name of a symbol, in each notation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Name {
    pub text: String,
    pub latex: String,
    pub mathml: String,
    /// Whether it is an expression, which takes brackets as a base or before a factor.
    pub compound: bool,
    /// Whether it begins with a number or a sign, which takes brackets after a factor as well.
    pub leads: bool,
}

/// The names of symbols that are not written by their own.
pub(crate) type Names = BTreeMap<Symbol, Name>;

impl Name {
    /// A name that is no expression.
    pub fn plain(write: impl Fn(Notation) -> String) -> Name {
        let [text, latex, mathml] = Notation::ALL.map(write);
        Name { text, latex, mathml, compound: false, leads: false }
    }

    pub fn written(&self, notation: Notation) -> &str {
        match notation {
            Notation::Text => &self.text,
            Notation::Latex => &self.latex,
            Notation::MathMl => &self.mathml,
        }
    }
}

/// Names that have a command of their own.
pub(super) const GREEK: [&str; 34] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
    "lambda", "mu", "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi",
    "omega", "Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi",
    "Omega",
];

/// Endings of names that are accents in LaTeX.
const ACCENTS: [&str; 5] = ["tilde", "bar", "hat", "dot", "prime"];

/// A name as LaTeX: Greek letters as such, one letter in italics, a word upright, `a_1` with a
/// subscript, `a_tilde` with an accent, `a_prime` with a prime; with an index beside the subscript where
/// one is given, `f_{1,2}`.
#[must_use]
pub fn latex_name(name: &str, index: Option<&str>) -> String {
    let (letter, subscript) = parts(name);
    let below: Vec<&str> = subscript.as_deref().into_iter().chain(index).collect();
    if below.is_empty() { letter } else { format!("{letter}_{{{}}}", below.join(",")) }
}

/// The letter with its accent, and the subscript.
fn parts(name: &str) -> (String, Option<String>) {
    let accented = ACCENTS.iter().find_map(|accent| {
        let base = name.strip_suffix(accent)?.strip_suffix('_')?;
        (!base.is_empty()).then_some((base, accent))
    });
    if let Some((base, accent)) = accented {
        let (letter, subscript) = parts(base);
        let letter = match *accent {
            "prime" => format!("{letter}'"),
            accent => format!("\\{accent}{{{letter}}}"),
        };
        return (letter, subscript);
    }
    if GREEK.contains(&name) {
        return (format!("\\{name}"), None);
    }
    if let Some((base, subscript)) = name.split_once('_')
        && !base.is_empty()
        && !subscript.is_empty()
    {
        let subscript = match GREEK.contains(&subscript) || subscript.len() == 1 {
            true => latex_name(subscript, None),
            false => format!("\\mathrm{{{}}}", subscript.replace('_', "\\_")),
        };
        let (letter, digits) = parts(base);
        let before = digits.map_or_else(String::new, |digits| format!("{digits},"));
        return (letter, Some(before + &subscript));
    }
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    if letters.len() < name.len() && !letters.is_empty() {
        return (latex_name(letters, None), Some(name[letters.len()..].to_owned()));
    }
    match name.chars().count() {
        1 => (name.to_owned(), None),
        _ => (format!("\\mathrm{{{}}}", name.replace('_', "\\_")), None),
    }
}
