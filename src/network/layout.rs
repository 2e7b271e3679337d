//! A line cut into nodes and the bars between them.

use crate::expression::Fraction;
use crate::network::model::Model;
use crate::network::node::{ElementLaw, Link, Lumped, Node, Side};
use crate::scene::{ElementIndex, End, Joint, Kind, Scene};

/// How a line treats contacts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Contacts {
    /// They stay closed: what touches moves together.
    Closed,
    /// They open and close, and part what moves together; local ones too.
    Links,
    /// Local ones do; the others stay closed.
    LocalLinks,
}

impl Contacts {
    /// Those that open in a scene.
    pub fn of(scene: &Scene) -> Contacts {
        if scene.contacts_open { Contacts::Links } else { Contacts::LocalLinks }
    }
}

/// A contact of a line that may open.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Contact {
    /// The names of its neighbours at the left and at the right.
    pub names: [String; 2],
    /// Its node, and the run at its left.
    pub node: usize,
    pub run: usize,
    /// The joint of the line.
    pub joint: usize,
    /// How far apart it begins.
    pub gap: Fraction,
}

/// A line as nodes and bars in turn.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Layout {
    /// The bars from left to right.
    pub bars: Vec<ElementIndex>,
    /// The nodes from left to right.
    pub nodes: Vec<Node<Fraction>>,
    /// Of each bar, the node at its left and at its right; none where it is endless.
    pub ends: Vec<[Option<usize>; 2]>,
    /// The contacts that are links.
    pub contacts: Vec<Contact>,
}

impl Layout {
    pub fn of(scene: &Scene, model: &Model, contacts: Contacts) -> Layout {
        let side = |end: End| match end {
            End::Free => Some(Side::Free),
            End::Fixed => Some(Side::Fixed),
            End::Endless => None,
        };
        let mut layout =
            Layout { bars: Vec::new(), nodes: Vec::new(), ends: Vec::new(), contacts: Vec::new() };
        let line = &scene.line;
        let is_link = |joint| contacts == Contacts::Links && line.joints[joint] == Joint::Contact;
        let mut open = side(line.left).map(|side| Node::beginning(side, Fraction::zero()));
        for (joint, element) in line.elements.iter().enumerate() {
            if let Some(node) = open.as_mut().filter(|_| is_link(joint)) {
                layout.contact(scene, model, node, joint);
            }
            if !matches!(scene.elements[*element].kind, Kind::Bar(_)) {
                let node = open.as_mut().expect("an endless line begins with a bar");
                let law = model.lumps[element].clone();
                let is_local = matches!(law, ElementLaw::LocalContact { .. });
                node.attach(*element, law);
                if is_local && contacts != Contacts::Closed {
                    layout.local_contact(scene, node, joint);
                }
                continue;
            }
            let (bar, impedance) = (layout.bars.len(), &model.bars[element].impedance);
            let before = open.map(|node| layout.close(node, Side::Bar(bar), impedance));
            layout.bars.push(*element);
            layout.ends.push([before, None]);
            open = Some(Node::beginning(Side::Bar(bar), impedance.clone()));
        }
        if let (Some(mut node), Some(right)) = (open, side(line.right)) {
            if is_link(line.elements.len()) {
                layout.contact(scene, model, &mut node, line.elements.len());
            }
            layout.close(node, right, &Fraction::zero());
        }
        layout
    }

    /// Adds a contact to the node that begins where the last one ended.
    fn contact(&mut self, scene: &Scene, model: &Model, node: &mut Node<Fraction>, joint: usize) {
        let gap = model.gaps.get(&joint).cloned().unwrap_or_else(Fraction::zero);
        let number = self.number(scene, (node.links.len(), joint), gap);
        node.links.push(Link::Contact(number));
    }

    /// Lets the last element of the node, a local contact at a place of the line, part what it stands between. It
    /// belongs to what is at its left, or to what is at its right where that is the wall.
    fn local_contact(&mut self, scene: &Scene, node: &mut Node<Fraction>, place: usize) {
        let joint = if place == 0 { 0 } else { place + 1 };
        let contact = self.number(scene, (node.links.len() - 1, joint), Fraction::zero());
        let link = node.links.last_mut().expect("a local contact is a link");
        *link = Link::Local { contact, place: node.elements.len() - 1 };
    }

    /// The number of one more contact, at the right of a run.
    fn number(&mut self, scene: &Scene, (run, joint): (usize, usize), gap: Fraction) -> usize {
        let (names, node) = (scene.names_beside(joint), self.nodes.len());
        self.contacts.push(Contact { names, node, run, joint, gap });
        self.contacts.len() - 1
    }

    /// Adds a node; a bar at its left ends there.
    fn close(&mut self, mut node: Node<Fraction>, right: Side, impedance: &Fraction) -> usize {
        let place = self.nodes.len();
        if let Side::Bar(bar) = node.left {
            self.ends[bar][1] = Some(place);
        }
        node.right = right;
        node.impedance[1] = impedance.clone();
        self.nodes.push(node);
        place
    }

    /// The node at which a lumped element sits.
    pub fn node_of(&self, element: ElementIndex) -> Option<usize> {
        self.nodes.iter().position(|node| node.place(element).is_some())
    }

    /// The place of a bar in the line.
    pub fn bar(&self, element: ElementIndex) -> Option<usize> {
        self.bars.iter().position(|bar| *bar == element)
    }
}

impl Node<Fraction> {
    /// A node of which only the left side is known yet.
    fn beginning(left: Side, impedance: Fraction) -> Node<Fraction> {
        let impedance = [impedance, Fraction::zero()];
        Node { left, right: Side::Free, impedance, elements: Vec::new(), links: Vec::new() }
    }

    /// Adds an element at the right.
    fn attach(&mut self, element: ElementIndex, law: ElementLaw<Fraction>) {
        let run = self.links.len();
        if law.is_link() {
            self.links.push(Link::Element(self.elements.len()));
        }
        self.elements.push(Lumped { element, run, law });
    }
}
