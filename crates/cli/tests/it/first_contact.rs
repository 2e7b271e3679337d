//! The closed form of a first contact: what is printed, put in numbers, is what is followed with proof.

use super::{folder, run, words};
use std::collections::BTreeMap;
use std::fs;

type Values = BTreeMap<String, f64>;

/// The value of a formula, by descent: sums, products, powers, functions.
struct Reader<'a> {
    rest: &'a str,
    values: &'a Values,
}

impl<'a> Reader<'a> {
    fn value(text: &'a str, values: &'a Values) -> f64 {
        let mut reader = Reader { rest: text, values };
        let value = reader.sum();
        assert!(reader.rest.is_empty(), "{} left of {text}", reader.rest);
        value
    }

    fn takes(&mut self, sign: char) -> bool {
        self.rest = self.rest.trim_start();
        let after = self.rest.strip_prefix(sign);
        self.rest = after.unwrap_or(self.rest);
        after.is_some()
    }

    fn sum(&mut self) -> f64 {
        let mut sum = if self.takes('-') { -self.product() } else { self.product() };
        loop {
            match (self.takes('+'), self.takes('-')) {
                (true, _) => sum += self.product(),
                (_, true) => sum -= self.product(),
                _ => return sum,
            }
        }
    }

    fn product(&mut self) -> f64 {
        let mut product = self.power();
        loop {
            match (self.takes('*'), self.takes('/')) {
                (true, _) => product *= self.power(),
                (_, true) => product /= self.power(),
                _ => return product,
            }
        }
    }

    fn power(&mut self) -> f64 {
        let base = self.atom();
        if self.takes('^') { base.powf(self.atom()) } else { base }
    }

    fn atom(&mut self) -> f64 {
        if self.takes('(') {
            let inner = self.sum();
            assert!(self.takes(')'), "a bracket is open before {}", self.rest);
            return inner;
        }
        let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
        let end = self.rest.find(|c| !is_part(c)).unwrap_or(self.rest.len());
        let (name, rest) = self.rest.split_at(end);
        self.rest = rest;
        if let Ok(number) = name.parse() {
            return number;
        }
        match name {
            "ln" => self.atom().ln(),
            "arctan" => self.atom().atan(),
            "sqrt" => self.atom().sqrt(),
            "cos" => self.atom().cos(),
            "pi" => std::f64::consts::PI,
            name => self.values[name],
        }
    }
}

#[test]
fn the_reader_reads() {
    let values = Values::from([("x".to_owned(), 2.0)]);
    assert_eq!(Reader::value("-x^(3 - 1) + 3*(x/4 - 1)*sqrt(4) - ln(1)", &values), -7.0);
}

/// All that is derived at some values of p.
fn at(derived: &str, given: &Values, p: f64) -> Values {
    let mut values = given.clone();
    values.insert("p".to_owned(), p);
    for line in derived.lines().filter(|line| !line.trim_start().starts_with('#')) {
        let (head, right) = line.split_once(" = ").unwrap();
        if !head.contains("(alpha)") {
            let value = Reader::value(right, &values);
            values.insert(head.replace("(p)", ""), value);
        }
    }
    // The law itself.
    let law = derived.lines().find_map(|line| line.strip_prefix("X(alpha) = ")).unwrap();
    let force = Reader::value(law, &values);
    assert!((force / values["X"] - 1.0).abs() < 1e-13, "{force} and {}", values["X"]);
    values
}

/// For exponents with roots, with cosines, with a second real pole and with powers; with numbers and with symbols; between
/// bars and before a wall. The numbers of the closed form are `hertz`'s; some are followed besides.
#[test]
fn derived_contacts_are_those_that_are_followed() {
    let folder = folder("first-contact");
    let bars = "bar a { impedance = 2, travel = 3/2, velocity = 1 }\nTIP\n\
                bar b { impedance = 3, travel = 5/4 }\nline free - a - tip - b - free\n";
    let wall =
        "bar b { impedance = 3, travel = 5/4, velocity = -2 }\nTIP\nline fixed - tip - b - free\n";
    let symbols = "symbol Z > 0\nsymbol V > 0\nsymbol k > 0\n\
                   bar a { impedance = 2, travel = 3/2, velocity = V }\nTIP\n\
                   bar b { impedance = Z, travel = 5/4 }\nline free - a - tip - b - free\n";
    let cases = [
        (bars, "40, exponent = 3/2", "ln(p^2 + p + 1)", true),
        (bars, "4, exponent = 1", "-T*ln(1 - p)", false),
        (bars, "40, exponent = 2", "1/2*ln(1 + p)", false),
        (bars, "40, exponent = 5/2", "cos(1/5*pi)", true),
        (bars, "5, exponent = 1/2", "- 2*p", false),
        (bars, "40, exponent = 4/3", "arctan(p)", false),
        (bars, "40, exponent = 7/4", "cos(", false),
        (bars, "40, exponent = 8/5", "sqrt(2)", false),
        (wall, "40, exponent = 3/2", "t <= 5/2", true),
        (symbols, "k, exponent = 3/2", "X_max = 2*V*Z/(2 + Z)", false),
    ];
    let given = [("Z", 3.0), ("V", 0.5), ("k", 7.0)].map(|(name, value)| (name.to_owned(), value));
    let given = Values::from(given);
    for (text, law, part, is_followed) in cases {
        let tip = format!("hertz tip {{ stiffness = {law} }}");
        let text =
            format!("scene \"A\"\n{}observe force = force(tip)\n", text.replace("TIP", &tip));
        fs::write(folder.join("of.wave"), text).unwrap();
        let (code, derived, told) = run(&folder, &words("derive of.wave --line-length 1000"));
        assert_eq!(code, 0, "{told}");
        assert!(derived.contains(part), "{part} in {derived}");
        let values = [0.2, 0.6, 0.85].map(|p| at(&derived, &given, p));
        let set = if part.contains('V') { " --set Z=3 --set V=1/2 --set k=7" } else { "" };
        let times = |with: &str| values.each_ref().map(|own| format!("{with}{:.18}", own["t"]));
        let mut asked = vec![format!("hertz of.wave --digits 14 --at {}", times("").join(","))];
        if is_followed {
            let times = times(" --at ").concat();
            asked.push(format!("eval of.wave --quantity force --digits 14{times}"));
        }
        for line in asked {
            let (code, told, error) = run(&folder, &words(&(line.clone() + set)));
            assert_eq!(code, 0, "{line}: {error}");
            let forces = told.lines().filter(|line| line.starts_with("force"));
            let forces: Vec<f64> =
                forces.map(|line| line.split(' ').next_back().unwrap().parse().unwrap()).collect();
            assert_eq!(forces.len(), 3, "{told}");
            for (own, told) in values.iter().zip(forces) {
                assert!((told / own["X"] - 1.0).abs() < 1e-12, "{law}: {told} and {}", own["X"]);
            }
        }
    }
}

/// In scenes with units the formulas are in their scales, with numbers in units beside them; JSON holds both.
#[test]
fn units_stand_beside_the_formulas() {
    let folder = folder("first-contact-units");
    let (code, text, _) = run(&folder, &words("derive hertz-striker"));
    assert_eq!(code, 0);
    for part in [
        "# times in 0.0000580025 s, velocities in 10 m/s, forces in 127554 N\n",
        "# X_max = 63777.0 N\n",
        "# until t = 0.000116005 s\n",
        "X(alpha) = F_nose*(alpha/alpha_nose)^(3/2)\n",
        "0 <= p < 1, as long as t <= 2: then a wave may return through striker\n",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
    let (_, json, _) = run(&folder, &words("derive hertz-striker --format json"));
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["values"]["X_max"]["value"], "63777.0");
    let last = json["formulas"].as_array().unwrap().last().unwrap();
    assert!(text.contains(last["formula"].as_str().unwrap()), "{last}");
    let (_, latex, _) = run(&folder, &words("derive local-contact --format latex"));
    assert!(latex.contains("\\arctan\\left(\\frac{\\sqrt{3} p}{2 + p}\\right)"), "{latex}");
    let (_, endless, _) = run(&folder, &words("derive local-contact"));
    assert!(endless.contains("0 <= p < 1; nothing returns to the contact"), "{endless}");
}

/// What makes no such equation says why.
#[test]
fn other_first_contacts_are_refused_by_name() {
    let folder = folder("first-contact-refused");
    let cases = [
        ("mass m { mass = 1, velocity = 1 }", "free - m - tip - b - endless", "it is next to `m`"),
        (
            "bar a { impedance = 1, velocity = -1 }",
            "endless - a - tip - b - endless",
            "may not approach",
        ),
        (
            "bar a { impedance = 1, travel = 1, velocity = 1, strain = -1 }",
            "free - a - tip - b - free",
            "`a` is strained at the start",
        ),
        (
            "symbol V\nbar a { impedance = 1, velocity = V }",
            "endless - a - tip - b - endless",
            "may not approach",
        ),
    ];
    for (element, line, reason) in cases {
        let text = format!(
            "scene \"A\"\n{element}\nhertz tip {{ stiffness = 4 }}\nbar b {{ impedance = 1 }}\nline {line}\n\
             observe force = force(tip)\n"
        );
        let text = match line.ends_with("free") {
            true => text.replace("bar b { impedance = 1 }", "bar b { impedance = 1, travel = 1 }"),
            false => text,
        };
        fs::write(folder.join("of.wave"), text).unwrap();
        let (code, output, told) = run(&folder, &words("derive of.wave"));
        assert!(code == 1 && output.is_empty(), "{element}: {code} {output} {told}");
        assert!(told.contains("no closed form") && told.contains(reason), "{told}");
        assert!(told.contains("help: compute values"), "{told}");
    }
    for line in [
        "derive hertz-striker --general",
        "derive hertz-striker --quantity f",
        "derive hertz-striker --piece 1",
    ] {
        let (code, _, told) = run(&folder, &words(line));
        assert!(code == 1 && told.contains("no recurrence"), "{line}: {told}");
    }
}
