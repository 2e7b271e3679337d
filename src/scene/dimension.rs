//! Dimensions of quantities.

/// The dimension `length^a · mass^b · time^c`, in metres, kilograms and seconds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub struct Dimension {
    pub length: i8,
    pub mass: i8,
    pub time: i8,
}

impl Dimension {
    /// A plain number.
    pub const NONE: Dimension = Dimension::new(0, 0, 0);
    pub const LENGTH: Dimension = Dimension::new(1, 0, 0);
    pub const MASS: Dimension = Dimension::new(0, 1, 0);
    pub const TIME: Dimension = Dimension::new(0, 0, 1);
    pub const AREA: Dimension = Dimension::new(2, 0, 0);
    pub const VELOCITY: Dimension = Dimension::new(1, 0, -1);
    pub const DENSITY: Dimension = Dimension::new(-3, 1, 0);
    pub const FORCE: Dimension = Dimension::new(1, 1, -2);
    /// `Pa = N/m^2`, of moduli and stresses.
    pub const PRESSURE: Dimension = Dimension::new(-1, 1, -2);
    pub const STIFFNESS: Dimension = Dimension::new(0, 1, -2);
    /// `N s/m = kg/s`, of impedances and dampings.
    pub const IMPEDANCE: Dimension = Dimension::new(0, 1, -1);
    /// `J = N m`
    pub const ENERGY: Dimension = Dimension::new(2, 1, -2);
    /// `N s`
    pub const MOMENTUM: Dimension = Dimension::new(1, 1, -1);

    pub const fn new(length: i8, mass: i8, time: i8) -> Dimension {
        Dimension { length, mass, time }
    }

    pub const fn times(self, other: Dimension) -> Dimension {
        Dimension::new(self.length + other.length, self.mass + other.mass, self.time + other.time)
    }

    pub const fn inverse(self) -> Dimension {
        Dimension::new(-self.length, -self.mass, -self.time)
    }

    /// Its unit in metres, kilograms and seconds: `N/m`; empty for plain numbers.
    pub fn unit(self) -> String {
        let units = self.units();
        units.split(" = ").next().unwrap_or(&units).to_owned()
    }

    /// The unit with what it is equal to: `Pa = N/m^2`.
    pub fn units(self) -> String {
        match DESCRIBED.iter().find(|(known, _)| *known == self) {
            Some((_, text)) => text.split_once(", ").map_or("", |(_, unit)| unit).to_owned(),
            None => self.powers(),
        }
    }

    /// What a person would call it, with its unit: `a stiffness, N/m`.
    pub fn described(self) -> String {
        match DESCRIBED.iter().find(|(known, _)| *known == self) {
            Some((_, text)) => (*text).to_owned(),
            None => format!("a quantity in {}", self.powers()),
        }
    }

    fn powers(self) -> String {
        let parts = [("kg", self.mass), ("m", self.length), ("s", self.time)].into_iter();
        let parts = parts.filter(|(_, power)| *power != 0).map(|(unit, power)| match power {
            1 => unit.to_owned(),
            _ => format!("{unit}^{power}"),
        });
        parts.collect::<Vec<_>>().join("*")
    }
}

const DESCRIBED: [(Dimension, &str); 17] = [
    (Dimension::NONE, "a plain number"),
    (Dimension::LENGTH, "a length, m"),
    (Dimension::MASS, "a mass, kg"),
    (Dimension::TIME, "a time, s"),
    (Dimension::AREA, "an area, m^2"),
    (Dimension::new(3, 0, 0), "a volume, m^3"),
    (Dimension::VELOCITY, "a velocity, m/s"),
    (Dimension::new(1, 0, -2), "an acceleration, m/s^2"),
    (Dimension::DENSITY, "a density, kg/m^3"),
    (Dimension::FORCE, "a force, N"),
    (Dimension::PRESSURE, "a pressure, Pa = N/m^2"),
    (Dimension::STIFFNESS, "a stiffness, N/m"),
    (Dimension::IMPEDANCE, "an impedance or a damping, N*s/m = kg/s"),
    (Dimension::ENERGY, "an energy, J = N*m"),
    (Dimension::MOMENTUM, "a momentum, N*s"),
    (Dimension::new(0, 0, -1), "a frequency, Hz = 1/s"),
    (Dimension::new(2, 1, -3), "a power, W = J/s"),
];
