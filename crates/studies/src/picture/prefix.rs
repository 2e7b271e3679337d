//! Units with prefixes, as engineers write them: µs, mm, kN.

use wavestep_draw::Axis;

/// A unit with a prefix, and by what values in the bare unit are multiplied.
#[derive(Clone, PartialEq, Debug)]
pub struct Prefixed {
    pub unit: String,
    pub factor: f64,
}

impl Prefixed {
    /// The prefix with which values up to `largest` have one to three digits before the point; none
    /// from 0.1 on, and for kilograms, which have one.
    pub fn of(unit: &str, largest: f64) -> Prefixed {
        const PREFIXES: [(i32, &str, &str); 7] = [
            (-12, "p", "10⁻¹²"),
            (-9, "n", "10⁻⁹"),
            (-6, "µ", "10⁻⁶"),
            (-3, "m", "10⁻³"),
            (3, "k", "10³"),
            (6, "M", "10⁶"),
            (9, "G", "10⁹"),
        ];
        let written = unit.replace('*', " ");
        let bare = Prefixed { unit: written.clone(), factor: 1.0 };
        if !(largest > 0.0 && largest.is_finite()) || (0.1..1e3).contains(&largest) {
            return bare;
        }
        let exponent = 3 * (largest.log10() / 3.0 + 1e-12).floor() as i32;
        let exponent = exponent.clamp(-12, 9);
        let found = PREFIXES.iter().find(|(power, ..)| *power == exponent);
        let Some((power, prefix, number)) = found.filter(|_| !unit.starts_with("kg")) else {
            return bare;
        };
        let unit =
            if unit.is_empty() { (*number).to_owned() } else { format!("{prefix}{written}") };
        // Powers of ten above 1 are exact as doubles.
        let factor = if *power < 0 { 10f64.powi(-power) } else { 10f64.powi(*power).recip() };
        Prefixed { unit, factor }
    }

    /// The same where a scene has units; plain numbers stay as they are.
    pub fn in_scene(dimensional: bool, unit: &str, largest: f64) -> Prefixed {
        match dimensional {
            true => Prefixed::of(unit, largest),
            false => Prefixed { unit: String::new(), factor: 1.0 },
        }
    }

    pub fn axis(&self, name: &str) -> Axis {
        Axis::linear(name).unit(&self.unit)
    }
}
