//! Scenes as data, in numbers that are exact as text and close enough as doubles.

use std::fmt;

/// A quotient of integers.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Quotient(pub i64, pub i64);

impl Quotient {
    pub fn value(self) -> f64 {
        self.0 as f64 / self.1 as f64
    }
}

impl fmt::Display for Quotient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.0, self.1)
    }
}

#[derive(Clone, Copy, PartialEq, Debug)]
pub enum End {
    Free,
    Fixed,
    Endless,
}

/// The force `(constant + slope t) e^(−rate t)`, from a time until another.
#[derive(Clone, Debug)]
pub struct Load {
    pub constant: Quotient,
    pub slope: Quotient,
    pub rate: Quotient,
    pub from: Quotient,
    pub until: Option<Quotient>,
}

impl Load {
    /// The force between breaks, one of which is before `time`.
    pub fn force(&self, time: f64) -> f64 {
        let acts = time > self.from.value() && self.until.is_none_or(|until| time < until.value());
        let [constant, slope, rate] = [self.constant, self.slope, self.rate].map(Quotient::value);
        if acts { (constant + slope * time) * (-rate * time).exp() } else { 0.0 }
    }
}

#[derive(Clone, Debug)]
pub enum Element {
    /// Without a travel time it goes on for ever.
    Bar {
        impedance: Quotient,
        travel: Option<Quotient>,
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

/// A line from left to right, all of whose contacts open.
#[derive(Clone, Debug)]
pub struct Scene {
    pub ends: [End; 2],
    pub elements: Vec<Element>,
    /// Which joints are contacts: before each element, and behind the last.
    pub joints: Vec<bool>,
}

impl Scene {
    pub fn longest(&self) -> f64 {
        let travels = self.elements.iter().filter_map(|element| match element {
            Element::Bar { travel, .. } => travel.map(Quotient::value),
            _ => None,
        });
        travels.reduce(f64::max).unwrap_or(1.0)
    }

    /// Whether a spring stands between two contacts. Both lose their force at once, and which one opens is a convention.
    pub fn has_loose_spring(&self) -> bool {
        let joints = self.joints.windows(2);
        let mut springs = self.elements.iter().zip(joints);
        springs.any(|(own, joints)| matches!(own, Element::Spring { .. }) && joints == [true; 2])
    }

    /// It in words, an element `e0`, `e1`, … each, without observables.
    pub fn text(&self) -> String {
        let mut text = String::from("scene \"At random\"\ncontacts open\n");
        for (number, element) in self.elements.iter().enumerate() {
            let (kind, properties) = match element {
                Element::Bar { impedance, travel, velocity, strain } => {
                    let travel =
                        travel.map_or(String::new(), |travel| format!(", travel = {travel}"));
                    let start = format!("velocity = {velocity}, strain = {strain}");
                    ("bar", format!("impedance = {impedance}{travel}, {start}"))
                }
                Element::Mass { mass, velocity } => {
                    ("mass", format!("mass = {mass}, velocity = {velocity}"))
                }
                Element::Spring { stiffness, damping } => {
                    ("spring", format!("stiffness = {stiffness}, damping = {damping}"))
                }
                Element::Support { stiffness, damping } => {
                    ("support", format!("stiffness = {stiffness}, damping = {damping}"))
                }
                Element::Load(Load { constant, slope, rate, from, until }) => {
                    let until = until.map_or(String::new(), |until| format!(", until = {until}"));
                    let force = format!("({constant} + {slope}*t)*exp(-{rate}*t)");
                    ("load", format!("force = {force}, from = {from}{until}"))
                }
            };
            text += &format!("{kind} e{number} {{ {properties} }}\n");
        }
        let end = |end| match end {
            End::Free => "free",
            End::Fixed => "fixed",
            End::Endless => "endless",
        };
        let joint = |is_contact| if is_contact { " | " } else { " - " };
        text += "line ";
        text += end(self.ends[0]);
        for (number, is_contact) in self.joints.iter().enumerate() {
            let name = match number < self.elements.len() {
                true => format!("e{number}"),
                false => end(self.ends[1]).to_owned(),
            };
            text += &format!("{}{name}", joint(*is_contact));
        }
        text + "\n"
    }
}
