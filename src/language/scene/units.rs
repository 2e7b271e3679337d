//! Units of measurement and the dimensions they measure.
//!
//! A small table of our own: the crates that keep units settle them while a program is compiled, or
//! convert by floating-point numbers, and a text needs neither: it needs a few units of mechanics
//! that are exact multiples of metres, kilograms and seconds.

use num_traits::{One, Pow};
use wavestep_polynomial::Rational;

use crate::language::diagnostic::{Diagnostic, closest};
use crate::language::scope::{Scope, with_likely};
use crate::language::syntax::{Operator, Unit};
use crate::scene::Dimension;

/// What a unit is worth in metres, kilograms and seconds, and what it measures.
#[derive(Clone, PartialEq, Debug)]
pub(in crate::language) struct Worth {
    pub value: Rational,
    pub dimension: Dimension,
}

/// Units that take a prefix, with numerator and denominator of their value in SI units.
const PREFIXED: [(&str, i64, i64, Dimension); 8] = [
    ("m", 1, 1, Dimension::LENGTH),
    ("g", 1, 1000, Dimension::MASS),
    ("s", 1, 1, Dimension::TIME),
    ("N", 1, 1, Dimension::FORCE),
    ("Pa", 1, 1, Dimension::PRESSURE),
    ("Hz", 1, 1, Dimension::new(0, 0, -1)),
    ("J", 1, 1, Dimension::ENERGY),
    ("W", 1, 1, Dimension::new(2, 1, -3)),
];

/// Units without prefix, which are read first: `min` is a minute.
const WHOLE: [(&str, i64, i64, Dimension); 3] = [
    ("min", 60, 1, Dimension::TIME),
    ("in", 127, 5000, Dimension::LENGTH),
    ("lbf", 8_896_443_230_521, 2_000_000_000_000, Dimension::FORCE),
];

/// Prefixes with their powers of ten, and whether they stand before `m` only.
const PREFIXES: [(&str, i32, bool); 8] = [
    ("n", -9, false),
    ("u", -6, false),
    ("m", -3, false),
    ("c", -2, true),
    ("d", -1, true),
    ("k", 3, false),
    ("M", 6, false),
    ("G", 9, false),
];

/// Units that are often meant, for a remedy.
const USUAL: [&str; 19] = [
    "m", "mm", "cm", "km", "kg", "g", "s", "ms", "us", "N", "kN", "MN", "Pa", "kPa", "MPa", "GPa",
    "Hz", "J", "W",
];

/// Units in words, and under names that are not those of the SI.
const SPELT: [(&str, &str); 22] = [
    ("metre", "m"),
    ("meter", "m"),
    ("millimetre", "mm"),
    ("millimeter", "mm"),
    ("centimeter", "cm"),
    ("inch", "in"),
    ("gram", "g"),
    ("kilogram", "kg"),
    ("second", "s"),
    ("seconds", "s"),
    ("sec", "s"),
    ("msec", "ms"),
    ("usec", "us"),
    ("millisecond", "ms"),
    ("microsecond", "us"),
    ("minute", "min"),
    ("newton", "N"),
    ("kilonewton", "kN"),
    ("pascal", "Pa"),
    ("hertz", "Hz"),
    ("joule", "J"),
    ("watt", "W"),
];

fn named(name: &str) -> Option<Worth> {
    let worth = |&(_, numerator, denominator, dimension): &(&str, i64, i64, Dimension)| Worth {
        value: Rational::new(numerator.into(), denominator.into()),
        dimension,
    };
    if let Some(unit) = WHOLE.iter().chain(&PREFIXED).find(|unit| unit.0 == name) {
        return Some(worth(unit));
    }
    PREFIXES.iter().find_map(|(prefix, power, of_metres)| {
        let rest = name.strip_prefix(prefix)?;
        let unit = PREFIXED.iter().find(|unit| unit.0 == rest && (!of_metres || rest == "m"))?;
        let Worth { value, dimension } = worth(unit);
        let ten = Rational::from_integer(10.into());
        Some(Worth { value: value * ten.pow(*power), dimension })
    })
}

/// What a unit is worth; `symbols` are names that a person may have meant to multiply by.
pub(in crate::language) fn worth(scope: &Scope, unit: &Unit) -> Result<Worth, Diagnostic> {
    let mut value = Rational::one();
    let mut powers = [0_i32; 3];
    for factor in &unit.value {
        let Some(one) = named(&factor.name.value) else {
            return Err(unknown(scope, &factor.name.value, factor.name.span));
        };
        let power = match factor.operator {
            Operator::Multiply => i32::from(factor.power),
            Operator::Divide => -i32::from(factor.power),
        };
        value *= one.value.pow(power);
        let Dimension { length, mass, time } = one.dimension;
        for (sum, own) in powers.iter_mut().zip([length, mass, time]) {
            *sum += i32::from(own) * power;
        }
        if powers.iter().any(|power| power.abs() > MAX_POWER) || unit.value.len() > MAX_FACTORS {
            return Err(scope
                .error("this unit is too long, or its powers are too large", unit.span, "too large")
                .with_remedy("write a unit such as `kg/m^3` or `kN*s/m`"));
        }
    }
    let [length, mass, time] = powers.map(|power| i8::try_from(power).expect("a small power"));
    Ok(Worth { value, dimension: Dimension::new(length, mass, time) })
}

/// The largest power of metres, kilograms and seconds.
const MAX_POWER: i32 = 40;

/// The most factors of a unit.
const MAX_FACTORS: usize = 12;

fn unknown(scope: &Scope, name: &str, span: crate::language::Span) -> Diagnostic {
    let error = scope.error(format!("unknown unit `{name}`"), span, "not a unit");
    let (letters, digits) =
        name.split_at(name.trim_end_matches(|c: char| c.is_ascii_digit()).len());
    let parted = (1..name.len())
        .filter(|at| name.is_char_boundary(*at))
        .map(|at| name.split_at(at))
        .find(|(left, right)| {
            let dimensions = [left, right].map(|name| named(name).map(|worth| worth.dimension));
            // Two lengths are one that was mistyped.
            dimensions.iter().all(Option::is_some) && dimensions[0] != dimensions[1]
        });
    let lower = name.to_ascii_lowercase();
    let spelt = closest(&lower, SPELT.iter().map(|(word, _)| *word));
    let spelt = spelt.and_then(|spelt| SPELT.iter().find(|(word, _)| *word == spelt));
    if name == "t" {
        error.with_remedy("a product with the time needs `*`, as in `2*t`; a tonne is `Mg`")
    } else if scope.symbols.contains_key(name) {
        error.with_remedy(format!("no unit has this name; a product needs `*`, as in `2*{name}`"))
    } else if !digits.is_empty() && named(letters).is_some() {
        error.with_remedy(format!("write powers with `^`: `{letters}^{digits}`"))
    } else if let Some((left, right)) = parted {
        error.with_remedy(format!("write products with `*`: `{left}*{right}`"))
    } else if name == "bar" {
        error.with_remedy("write pressures in Pa: 1 bar is `100 kPa`")
    } else if let Some((_, unit)) = spelt.filter(|_| name.chars().count() > 2) {
        error.with_remedy(format!("did you mean `{unit}`?"))
    } else {
        with_likely(error, name, USUAL.into_iter()).or_remedy(
            "units are m, g, s, N, Pa, Hz, J, W with prefixes n, u, m, k, M, G (and cm, dm), min, \
             in, lbf, and their products and powers",
        )
    }
}

/// Whether a name is that of a unit.
pub(super) fn is_unit(name: &str) -> bool {
    named(name).is_some()
}
