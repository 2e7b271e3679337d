//! How names are spelt: ASCII and Greek letters, digits and `_`. A Greek letter is only another way
//! to write its English name, so `μ` and `mu` are one name, and all output is ASCII.

/// Words with a meaning of their own in expressions, which cannot name anything else.
pub const RESERVED: [&str; 5] = ["cos", "exp", "sin", "sqrt", "sum"];

/// The English names of the letters from α to ω, both forms of sigma among them.
const GREEK: [&str; 25] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
    "lambda", "mu", "nu", "xi", "omicron", "pi", "rho", "sigma", "sigma", "tau", "upsilon", "phi",
    "chi", "psi", "omega",
];

/// The English name of a Greek letter and whether it is a capital, including the variants and the micro
/// and ohm signs that keyboards and word processors put in its place.
fn greek(letter: char) -> Option<(&'static str, bool)> {
    let name = match letter {
        'α'..='ω' => GREEK[letter as usize - 'α' as usize],
        // U+03A2, where a capital final sigma would be, is not assigned.
        '\u{3A2}' => return None,
        'Α'..='Ω' => return Some((GREEK[letter as usize - 'Α' as usize], true)),
        '\u{B5}' => "mu",
        '\u{2126}' => return Some(("omega", true)),
        'ϑ' => "theta",
        'ϕ' => "phi",
        'ϖ' => "pi",
        'ϰ' => "kappa",
        'ϱ' => "rho",
        'ϵ' => "epsilon",
        _ => return None,
    };
    Some((name, false))
}

/// Whether a name can start with this character.
pub(super) fn is_letter(character: char) -> bool {
    character.is_ascii_alphabetic() || greek(character).is_some()
}

/// Whether a name can go on with this character.
pub(super) fn continues(character: char) -> bool {
    is_letter(character) || character.is_ascii_digit() || character == '_'
}

/// The name with its Greek letters spelt out, `μ` as `mu`.
pub fn normalise(written: &str) -> String {
    let mut name = String::with_capacity(written.len());
    for character in written.chars() {
        match greek(character) {
            Some((english, false)) => name.push_str(english),
            Some((english, true)) => {
                name.push_str(&english[..1].to_ascii_uppercase());
                name.push_str(&english[1..]);
            }
            None => name.push(character),
        }
    }
    name
}
