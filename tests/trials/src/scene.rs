//! Scenes as data, in numbers that are exact as text and close enough as doubles.

use std::collections::BTreeMap;
use std::fmt;

/// A quotient of integers.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Quotient(pub i64, pub i64);

impl Quotient {
    pub const ZERO: Quotient = Quotient(0, 1);

    pub fn value(self) -> f64 {
        self.0 as f64 / self.1 as f64
    }
}

impl fmt::Display for Quotient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.0, self.1)
    }
}

/// A quotient times the root of an integer.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Size {
    pub quotient: Quotient,
    pub root: u32,
}

impl Size {
    pub fn value(self) -> f64 {
        self.quotient.value() * f64::from(self.root).sqrt()
    }
}

impl From<Quotient> for Size {
    fn from(quotient: Quotient) -> Size {
        Size { quotient, root: 1 }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.root {
            1 => self.quotient.fmt(f),
            root => write!(f, "{}*sqrt({root})", self.quotient),
        }
    }
}

#[derive(Clone, Copy, PartialEq, Debug)]
pub enum End {
    Free,
    Fixed,
    Endless,
}

/// The force `(constant + slope t) e^(−rate t)`, times `sin(π turns t)` where these are not 0, from a time until another.
#[derive(Clone, Debug)]
pub struct Load {
    /// Whether it is a velocity, no force.
    pub is_imposed: bool,
    pub constant: Quotient,
    pub slope: Quotient,
    pub rate: Quotient,
    /// Half turns in the unit of time.
    pub turns: Quotient,
    pub from: Quotient,
    pub until: Option<Quotient>,
}

impl Load {
    /// The force or the velocity between breaks, one of which is before `time`.
    pub fn value(&self, time: f64) -> f64 {
        let acts = time > self.from.value() && self.until.is_none_or(|until| time < until.value());
        let [constant, slope, rate] = [self.constant, self.slope, self.rate].map(Quotient::value);
        let decays = (constant + slope * time) * (-rate * time).exp();
        match self.turns.value() {
            _ if !acts => 0.0,
            0.0 => decays,
            turns => decays * (std::f64::consts::PI * turns * time).sin(),
        }
    }
}

#[derive(Clone, Debug)]
pub enum Element {
    /// Without a travel time it goes on for ever.
    Bar {
        impedance: Quotient,
        travel: Option<Size>,
        velocity: Quotient,
        strain: Quotient,
    },
    Mass {
        mass: Quotient,
        velocity: Quotient,
    },
    Spring {
        stiffness: Quotient,
        damping: Quotient,
    },
    Support {
        stiffness: Quotient,
        damping: Quotient,
    },
    Load(Load),
}

/// Units in which numbers of the same size are written, and what one of each is in SI units.
#[derive(Debug)]
pub struct Units {
    names: [&'static str; 6],
    /// Of lengths and of forces.
    length: f64,
    force: f64,
    /// Units of time in a second.
    pub per_second: i64,
    /// What a bar's length is counted in, which a wave passes in a fifth of the unit of time.
    long: &'static str,
    /// Wave speeds, 5 km/s, in units of velocity.
    speed: i64,
}

/// The places of names.
const TIME: usize = 0;
const VELOCITY: usize = 1;
const MASS: usize = 2;
const IMPEDANCE: usize = 3;
const STIFFNESS: usize = 4;
const FORCE: usize = 5;

pub static UNITS: [Units; 2] = [
    Units {
        names: ["ms", "m/s", "kg", "kN*s/m", "MN/m", "kN"],
        length: 1e-3,
        force: 1e3,
        per_second: 1_000,
        long: "m",
        speed: 5_000,
    },
    Units {
        names: ["us", "km/s", "g", "kN*s/m", "GN/m", "MN"],
        length: 1e-3,
        force: 1e6,
        per_second: 1_000_000,
        long: "mm",
        speed: 5,
    },
];

/// What is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Measure {
    Velocity,
    Displacement,
    Force,
    Strain,
    Compression,
    Energy,
    Momentum,
}

impl Measure {
    pub fn word(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}

/// A line from left to right.
#[derive(Clone, Debug)]
pub struct Scene {
    pub ends: [End; 2],
    pub elements: Vec<Element>,
    /// Which joints are contacts: before each element, and behind the last.
    pub joints: Vec<bool>,
    /// How far apart contacts begin, by their joints.
    pub gaps: BTreeMap<usize, Quotient>,
    /// Whether contacts open.
    pub opens: bool,
    pub units: Option<&'static Units>,
    /// Which properties of elements are written as symbols `a`, `b`, `c`, with their values.
    pub symbols: Vec<(usize, &'static str, Quotient)>,
}

impl Scene {
    fn travels(&self) -> impl Iterator<Item = f64> {
        self.elements.iter().filter_map(|element| match element {
            Element::Bar { travel, .. } => travel.map(Size::value),
            _ => None,
        })
    }

    pub fn longest(&self) -> f64 {
        self.travels().reduce(f64::max).unwrap_or(1.0)
    }

    /// The shortest of several bars.
    pub fn shortest(&self) -> f64 {
        let travels = || self.travels();
        if travels().count() > 1 { travels().fold(f64::INFINITY, f64::min) } else { f64::INFINITY }
    }

    /// The largest impedance, stiffness or damping, and 1 at least.
    pub fn largest(&self) -> f64 {
        let own = |element: &Element| match element {
            Element::Bar { impedance, .. } => impedance.value(),
            Element::Spring { stiffness, damping } | Element::Support { stiffness, damping } => {
                stiffness.value().max(damping.value())
            }
            _ => 1.0,
        };
        self.elements.iter().map(own).fold(1.0, f64::max)
    }

    /// Whether a spring stands between two contacts. Both lose their force at once, and which one opens is a convention.
    pub fn has_loose_spring(&self) -> bool {
        let joints = self.joints.windows(2);
        let mut springs = self.elements.iter().zip(joints);
        springs.any(|(own, joints)| matches!(own, Element::Spring { .. }) && joints == [true; 2])
    }

    /// Whether a velocity is imposed.
    pub fn is_driven(&self) -> bool {
        let is_imposed = |own: &Element| matches!(own, Element::Load(load) if load.is_imposed);
        self.elements.iter().any(is_imposed)
    }

    /// Whether the energy of the line is finite, and what comes in is known: a mass whose velocity is imposed takes some up.
    pub fn has_energy(&self) -> bool {
        let has_mass = self.elements.iter().any(|own| matches!(own, Element::Mass { .. }));
        !(has_mass && self.is_driven())
            && self.elements.iter().all(|element| match element {
                Element::Bar { travel: None, velocity, strain, .. } => {
                    velocity.0 == 0 && strain.0 == 0
                }
                _ => true,
            })
    }

    /// Whether bars have strains: in units by impedance the wave speed is not known.
    pub fn is_sectioned(&self, bar: usize) -> bool {
        self.units.is_none() || bar.is_multiple_of(2)
    }

    /// What a value of 1 is in the unit of the language.
    pub fn unit(&self, measure: Measure) -> f64 {
        let Some(Units { length, force, per_second, speed, .. }) = self.units else { return 1.0 };
        match measure {
            Measure::Velocity => length * *per_second as f64,
            Measure::Displacement | Measure::Compression => *length,
            Measure::Force => *force,
            Measure::Strain => 1.0 / *speed as f64,
            Measure::Energy => length * force,
            Measure::Momentum => force / *per_second as f64,
        }
    }

    /// The symbol that stands for a property.
    fn symbol(&self, number: usize, property: &str) -> Option<char> {
        let place = self.symbols.iter().position(|own| (own.0, own.1) == (number, property));
        place.map(|place| char::from(b'a' + place as u8))
    }

    fn with_unit(&self, value: &str, unit: usize) -> String {
        self.units.map_or(value.to_owned(), |units| format!("{value} {}", units.names[unit]))
    }

    fn properties(&self, number: usize) -> (&'static str, Vec<(&'static str, String)>) {
        let own = |name: &'static str, value: &dyn fmt::Display, unit: usize| {
            let symbol = self.symbol(number, name).map(String::from);
            (name, self.with_unit(&symbol.unwrap_or_else(|| value.to_string()), unit))
        };
        match &self.elements[number] {
            Element::Bar { impedance, travel, velocity, strain } => {
                let mut all = vec![own("velocity", velocity, VELOCITY)];
                match self.units.filter(|_| self.is_sectioned(number)) {
                    Some(units) => {
                        all.push(("strain", format!("{strain}/{}", units.speed)));
                        all.push(("density", "8 g/cm^3".to_owned()));
                        // ρ c² is 200 GPa.
                        match number % 4 {
                            0 => all.push(("wave_speed", "5 km/s".to_owned())),
                            _ => all.push(("modulus", "200 GPa".to_owned())),
                        }
                        all.push(("area", format!("25*{impedance} mm^2")));
                        let length = |travel| ("length", format!("5*{travel} {}", units.long));
                        all.extend(travel.map(length));
                    }
                    None => {
                        all.push(own("impedance", impedance, IMPEDANCE));
                        all.extend(travel.map(|travel| own("travel", &travel, TIME)));
                        if self.units.is_none() {
                            all.push(own("strain", strain, TIME));
                        }
                    }
                }
                ("bar", all)
            }
            Element::Mass { mass, velocity } => {
                ("mass", vec![own("mass", mass, MASS), own("velocity", velocity, VELOCITY)])
            }
            Element::Spring { stiffness, damping } | Element::Support { stiffness, damping } => {
                let is_spring = matches!(self.elements[number], Element::Spring { .. });
                let damping = own("damping", damping, IMPEDANCE);
                let all = vec![own("stiffness", stiffness, STIFFNESS), damping];
                (if is_spring { "spring" } else { "support" }, all)
            }
            Element::Load(Load { is_imposed, constant, slope, rate, turns, from, until }) => {
                // Here the time is in seconds.
                let time = self.units.map_or("t".to_owned(), |own| format!("{}*t", own.per_second));
                let mut course = format!("({constant} + {slope}*{time})*exp(-{rate}*{time})");
                if turns.value() != 0.0 {
                    course += &format!("*sin({turns}*pi*{time})");
                }
                let (name, unit) =
                    if *is_imposed { ("velocity", VELOCITY) } else { ("force", FORCE) };
                let mut all = vec![(name, self.with_unit(&course, unit))];
                all.push(own("from", from, TIME));
                all.extend(until.map(|until| own("until", &until, TIME)));
                ("load", all)
            }
        }
    }

    /// It in words, an element `e0`, `e1`, … each, without observables.
    pub fn text(&self) -> String {
        let mut text = String::from("scene \"At random\"\n");
        for (number, property, _) in &self.symbols {
            let symbol = self.symbol(*number, property).expect("one of the symbols");
            let condition = if *property == "velocity" { "" } else { " > 0" };
            text += &format!("symbol {symbol}{condition}\n");
        }
        text += if self.opens { "contacts open\n" } else { "" };
        for number in 0..self.elements.len() {
            let (kind, properties) = self.properties(number);
            let written: Vec<_> =
                properties.iter().map(|(name, value)| format!("{name} = {value}")).collect();
            text += &format!("{kind} e{number} {{ {} }}\n", written.join(", "));
        }
        let end = |end| match end {
            End::Free => "free",
            End::Fixed => "fixed",
            End::Endless => "endless",
        };
        let long = self.unit(Measure::Displacement);
        let metre = if self.units.is_some() { " m" } else { "" };
        let joint = |number: usize, is_contact: bool| match self.gaps.get(&number) {
            Some(gap) => format!(" |{long}*{gap}{metre}| "),
            None => if is_contact { " | " } else { " - " }.to_owned(),
        };
        text += "line ";
        text += end(self.ends[0]);
        for (number, is_contact) in self.joints.iter().enumerate() {
            let name = match number < self.elements.len() {
                true => format!("e{number}"),
                false => end(self.ends[1]).to_owned(),
            };
            text += &format!("{}{name}", joint(number, *is_contact));
        }
        text + "\n"
    }
}
