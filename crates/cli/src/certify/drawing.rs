//! The line as it is drawn: its elements from left to right with their numbers. A checker writes their laws itself.

use super::writer::Writer;
use serde_json::{Value as Json, json};
use wavestep::expression::Fraction;
use wavestep::network::{ElementLaw, Layout, Link, Lumped, Network, Node, Role, Side};
use wavestep::scene::{Drive, ElementIndex};

/// The elements, the ends among them, with the waves that the laws are stated in.
pub fn line(network: &Network, writer: &mut Writer) -> Json {
    let layout = &network.layout;
    let drawing = Drawing { network, layout, writer, drawn: Vec::new() };
    drawing.whole()
}

/// The same with what a motion is made of alone: no wave has a name. Contacts part what they stand between.
pub fn moving(network: &Network, layout: &Layout, writer: &mut Writer) -> Json {
    let drawing = Drawing { network, layout, writer, drawn: Vec::new() };
    let mut line = drawing.whole();
    let elements = line.as_array_mut().expect("it is a list");
    elements.retain(|element| element["is"] != "motion");
    for element in elements.iter_mut().filter_map(Json::as_object_mut) {
        ["clock", "right", "left", "wave"].into_iter().for_each(|key| drop(element.remove(key)));
    }
    line
}

struct Drawing<'a> {
    network: &'a Network,
    layout: &'a Layout,
    writer: &'a mut Writer,
    drawn: Vec<Json>,
}

impl<'a> Drawing<'a> {
    fn whole(mut self) -> Json {
        let clocks: Vec<Json> =
            self.network.leads().map(|lead| self.writer.function(lead)).collect();
        let clock = |node: Option<usize>| node.map_or(Json::Null, |node| clocks[node].clone());
        let nodes = &self.layout.nodes;
        let (first, last) = (self.layout.ends.first(), self.layout.ends.last());
        let begins = first.is_none_or(|ends| ends[0].is_some());
        let left = if begins { end(nodes[0].left) } else { "endless" };
        self.drawn.push(json!({ "is": left, "clock": clock(begins.then_some(0)) }));
        if begins {
            self.node(0, &nodes[0]);
        }
        for (bar, ends) in self.layout.ends.iter().enumerate() {
            self.bar(self.layout.bars[bar], clock(ends[1]));
            if let Some(node) = ends[1] {
                self.node(node, &nodes[node]);
            }
        }
        let ends = last.is_none_or(|ends| ends[1].is_some());
        let right = if ends { end(nodes[nodes.len() - 1].right) } else { "endless" };
        self.drawn.push(json!({ "is": right }));
        Json::Array(self.drawn)
    }

    fn name(&self, element: ElementIndex) -> &'a str {
        &self.network.scene().elements[element].name
    }

    fn wave(&self, role: Role) -> Option<&'a str> {
        let own = self.network.waves().iter().find(|wave| wave.role == role);
        own.map(|wave| wave.name.as_str())
    }

    /// A bar, with the clock of the node at its right.
    fn bar(&mut self, element: ElementIndex, clock: Json) {
        let data = &self.network.model().bars[&element];
        let travel = data.travel.as_ref().map(|travel| self.writer.function(travel));
        let drawn = json!({
            "is": "bar", "name": self.name(element), "clock": clock, "travel": travel,
            "impedance": self.writer.function(&data.impedance),
            "velocity": self.writer.function(&data.velocity),
            "force": self.writer.function(&data.force),
            "right": self.wave(Role::Right(element)), "left": self.wave(Role::Left(element)),
        });
        self.drawn.push(drawn);
    }

    /// What stands at a node, from left to right.
    fn node(&mut self, place: usize, node: &Node<Fraction>) {
        for run in 0..node.runs() {
            self.motion(place, node, run);
            node.attached(run).for_each(|own| self.element(own));
            match node.links.get(run) {
                Some(Link::Element(place) | Link::Local { place, .. }) => {
                    self.element(&node.elements[*place]);
                }
                Some(Link::Contact(contact)) => {
                    let gap = &self.layout.contacts[*contact].gap;
                    self.drawn.push(match gap.is_zero() {
                        true => json!({ "is": "contact" }),
                        false => json!({ "is": "gap", "width": self.writer.function(gap) }),
                    });
                }
                None => {}
            }
        }
    }

    /// What moves together beside no bar has a velocity of its own.
    fn motion(&mut self, place: usize, node: &Node<Fraction>, run: usize) {
        let Some(wave) = self.wave(Role::Velocity(place, node.first_place(run))) else { return };
        let at_start = node.attached(run).find_map(|own| match &own.law {
            ElementLaw::Mass { velocity, .. } if !self.network.is_disturbed(place) => {
                Some(velocity.clone())
            }
            _ => None,
        });
        let from = self.writer.function(&at_start.unwrap_or_else(Fraction::zero));
        self.drawn.push(json!({ "is": "motion", "wave": wave, "from": from }));
    }

    fn element(&mut self, own: &Lumped<Fraction>) {
        let mut drawn = match &own.law {
            ElementLaw::Mass { mass, velocity } => json!({
                "is": "mass",
                "mass": self.writer.function(mass), "velocity": self.writer.function(velocity),
            }),
            ElementLaw::Spring { stiffness, damping } => json!({
                "is": "spring", "wave": self.wave(Role::Compression(own.element)),
                "stiffness": self.writer.function(stiffness), "damping": self.writer.function(damping),
            }),
            ElementLaw::Support { stiffness, damping } => json!({
                "is": "support", "wave": self.wave(Role::Displacement(own.element)),
                "stiffness": self.writer.function(stiffness), "damping": self.writer.function(damping),
            }),
            ElementLaw::Load(drive) => {
                let load = &self.network.model().loads[&own.element];
                let until = load.until.as_ref().map(|until| self.writer.function(until));
                json!({
                    "is": if *drive == Drive::Force { "force" } else { "velocity" },
                    "course": self.writer.expression(&load.course),
                    "from": self.writer.function(&load.from), "until": until,
                })
            }
            ElementLaw::LocalContact { force, compression, exponent } => json!({
                "is": "local", "exponent": exponent.to_string(),
                "force": self.writer.function(force), "compression": self.writer.function(compression),
            }),
        };
        drawn["name"] = json!(self.name(own.element));
        self.drawn.push(drawn);
    }
}

fn end(side: Side) -> &'static str {
    match side {
        Side::Free => "free",
        Side::Fixed => "fixed",
        Side::Bar(_) => unreachable!("a line ends with its last node"),
    }
}
