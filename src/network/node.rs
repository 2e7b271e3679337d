//! A node: the lumped elements between two bars, or between a bar and an end.
//!
//! What moves together is a *run*. Springs, local contacts and contacts that may open are *links* from one
//! run to the next; masses, supports and loads belong to a run. The symbolic laws, the system of equations in
//! numbers and all models read this one description, in exact values, balls or doubles.

use crate::ball::Arithmetic;
use crate::scene::{Drive, ElementIndex};
use wavestep_polynomial::Rational;

/// One side of a node.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Side {
    /// A bar, by its place in the line.
    Bar(usize),
    /// No force.
    Free,
    /// No motion.
    Fixed,
}

/// A lumped element.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum ElementLaw<V> {
    /// A mass with its velocity at the start.
    Mass { mass: V, velocity: V },
    /// Presses on the runs at both sides with `k α + d α'`.
    Spring { stiffness: V, damping: V },
    /// Presses on the runs at both sides with `F_0 (α/α_0)^m` while `α > 0`.
    LocalContact { force: V, compression: V, exponent: Rational },
    /// Resists the motion of a run with `k u + d u'`.
    Support { stiffness: V, damping: V },
    /// A force on a run, or the velocity of one.
    Load(Drive),
}

/// A lumped element in its node.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lumped<V> {
    pub element: ElementIndex,
    /// The run that it belongs to; of a link the one at its left.
    pub run: usize,
    pub law: ElementLaw<V>,
}

/// The link between a run and the next.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Link {
    /// A contact, by its number in the line.
    Contact(usize),
    /// A spring or a local contact, by its place among the elements of the node.
    Element(usize),
    /// A local contact that parts what it stands between, by its number in the line and its place among the elements.
    Local { contact: usize, place: usize },
}

/// A term of the balance of forces on a run.
#[derive(Clone, Copy, Debug)]
pub enum Acting {
    /// The compressive force in the bar at the left side (0) or at the right (1), none at a free end.
    Side(usize),
    /// The compressive force in a link.
    Link(usize),
    /// Of an element of the run, by its place: the force of a load, the force `k u + d v` in a support, or
    /// the mass times the acceleration.
    Element(usize),
}

/// The elements between two bars, or between a bar and an end.
///
/// # Invariants
/// `links[i]` is between the runs `i` and `i + 1`; there is one more run than there are links. Impedances
/// are zero where there is no bar.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Node<V> {
    pub left: Side,
    pub right: Side,
    /// The impedances of the bars at the left and at the right.
    pub impedance: [V; 2],
    /// The elements from left to right.
    pub elements: Vec<Lumped<V>>,
    pub links: Vec<Link>,
}

impl<V> ElementLaw<V> {
    /// Whether it stands between two runs.
    pub fn is_link(&self) -> bool {
        matches!(self, ElementLaw::Spring { .. } | ElementLaw::LocalContact { .. })
    }

    /// Stiffness and damping of a spring or a support.
    pub fn resistance(&self) -> Option<[&V; 2]> {
        match self {
            ElementLaw::Spring { stiffness, damping }
            | ElementLaw::Support { stiffness, damping } => Some([stiffness, damping]),
            _ => None,
        }
    }

    /// Whether its force or velocity comes from outside the linear law of the node.
    pub fn is_driven(&self) -> bool {
        matches!(self, ElementLaw::Load(_) | ElementLaw::LocalContact { .. })
    }

    fn map<W, E>(&self, value: &impl Fn(&V) -> Result<W, E>) -> Result<ElementLaw<W>, E> {
        Ok(match self {
            ElementLaw::Mass { mass, velocity } => {
                ElementLaw::Mass { mass: value(mass)?, velocity: value(velocity)? }
            }
            ElementLaw::Spring { stiffness, damping } => {
                ElementLaw::Spring { stiffness: value(stiffness)?, damping: value(damping)? }
            }
            ElementLaw::LocalContact { force, compression, exponent } => ElementLaw::LocalContact {
                force: value(force)?,
                compression: value(compression)?,
                exponent: exponent.clone(),
            },
            ElementLaw::Support { stiffness, damping } => {
                ElementLaw::Support { stiffness: value(stiffness)?, damping: value(damping)? }
            }
            ElementLaw::Load(drive) => ElementLaw::Load(*drive),
        })
    }
}

impl<V> Node<V> {
    /// The same node with other numbers.
    pub fn map<W, E>(&self, value: impl Fn(&V) -> Result<W, E>) -> Result<Node<W>, E> {
        let element = |own: &Lumped<V>| {
            Ok(Lumped { element: own.element, run: own.run, law: own.law.map(&value)? })
        };
        Ok(Node {
            left: self.left,
            right: self.right,
            impedance: [value(&self.impedance[0])?, value(&self.impedance[1])?],
            elements: self.elements.iter().map(element).collect::<Result<_, E>>()?,
            links: self.links.clone(),
        })
    }

    /// How many runs there are.
    pub fn runs(&self) -> usize {
        self.links.len() + 1
    }

    /// The runs at the left and at the right side.
    pub fn side_runs(&self) -> [usize; 2] {
        [0, self.links.len()]
    }

    /// The sides that a run reaches, the left one first.
    pub fn sides(&self, run: usize) -> impl Iterator<Item = Side> {
        let sides = self.side_runs().into_iter().zip([self.left, self.right]);
        sides.filter(move |(end, _)| *end == run).map(|(_, side)| side)
    }

    /// Whether a run cannot move.
    pub fn is_held(&self, run: usize) -> bool {
        self.sides(run).any(|side| side == Side::Fixed)
    }

    /// Whether a run is held, or moves as a load says.
    pub fn is_imposed(&self, run: usize) -> bool {
        self.is_held(run) || self.imposing(run).next().is_some()
    }

    /// The loads that impose the velocity of a run.
    pub fn imposing(&self, run: usize) -> impl Iterator<Item = &Lumped<V>> {
        self.attached(run).filter(|own| matches!(own.law, ElementLaw::Load(Drive::Velocity)))
    }

    /// A load that imposes the velocity of a run which a contact may join to a mass, a wall or another such run: what presses
    /// there depends on how the velocity changes.
    pub fn imposed_beside_inertia(&self) -> Option<&Lumped<V>> {
        let is_contact = |link: &usize| matches!(self.links.get(*link), Some(Link::Contact(_)));
        let is_heavy = |run: usize| {
            let is_mass = |own: &Lumped<V>| matches!(own.law, ElementLaw::Mass { .. });
            self.is_imposed(run) || self.attached(run).any(is_mass)
        };
        (0..self.runs()).find_map(|run| {
            let load = self.imposing(run).next()?;
            let left = (0..run).rev().take_while(is_contact);
            let right = (run..self.links.len()).take_while(is_contact).map(|link| link + 1);
            left.chain(right).any(is_heavy).then_some(load)
        })
    }

    /// Whether nothing acts on a run but the links beside it: no element, bar or wall.
    pub fn is_bare(&self, run: usize) -> bool {
        self.attached(run).next().is_none() && self.sides(run).all(|side| side == Side::Free)
    }

    /// Masses, supports and loads of a run.
    pub fn attached(&self, run: usize) -> impl Iterator<Item = &Lumped<V>> {
        self.elements.iter().filter(move |own| own.run == run && !own.law.is_link())
    }

    /// The element that is a link; none for a contact.
    pub fn spanning(&self, link: usize) -> Option<&Lumped<V>> {
        match self.links[link] {
            Link::Element(place) | Link::Local { place, .. } => Some(&self.elements[place]),
            Link::Contact(_) => None,
        }
    }

    /// The place among the elements of a contact that is a local one.
    pub fn local_contact(&self, contact: usize) -> Option<usize> {
        self.links.iter().find_map(|link| match link {
            Link::Local { contact: own, place } if *own == contact => Some(*place),
            _ => None,
        })
    }

    /// The place of an element among those of the node.
    pub fn place(&self, element: ElementIndex) -> Option<usize> {
        self.elements.iter().position(|own| own.element == element)
    }

    /// How many elements stand left of a run.
    pub fn first_place(&self, run: usize) -> usize {
        self.elements.iter().filter(|own| own.run < run).count()
    }

    /// What acts on a run with which sign. The terms add up to zero, which is the balance
    /// `Σ m v' + Σ (k u + d v) = X_left − X_right + Σ F`. On a run that is held or imposed something else
    /// acts too, which nobody asks for.
    pub fn acting(&self, run: usize) -> impl Iterator<Item = (i64, Acting)> {
        let left = match run.checked_sub(1) {
            Some(link) => Acting::Link(link),
            None => Acting::Side(0),
        };
        let right = if run < self.links.len() { Acting::Link(run) } else { Acting::Side(1) };
        let own = self.elements.iter().enumerate().filter(move |(_, own)| own.run == run);
        let attached = own.filter_map(|(place, own)| match own.law {
            ElementLaw::Load(Drive::Force) => Some((1, Acting::Element(place))),
            ElementLaw::Mass { .. } | ElementLaw::Support { .. } => {
                Some((-1, Acting::Element(place)))
            }
            _ => None,
        });
        [(1, left), (-1, right)].into_iter().chain(attached)
    }

    /// The contact at the left of a run, by its place among those of the node.
    pub fn contact_left_of(&self, run: usize) -> Option<usize> {
        self.contacts().position(|(_, left)| left + 1 == run)
    }

    pub fn contact_right_of(&self, run: usize) -> Option<usize> {
        self.contacts().position(|(_, left)| left == run)
    }

    /// The contacts with the runs at their left.
    pub fn contacts(&self) -> impl Iterator<Item = (usize, usize)> {
        self.links.iter().enumerate().filter_map(|(run, link)| match link {
            Link::Contact(contact) | Link::Local { contact, .. } => Some((*contact, run)),
            Link::Element(_) => None,
        })
    }
}

impl<V: Arithmetic> Node<V> {
    /// Whether nothing acts on a run but undamped supports, one at least, and the links beside it.
    pub fn is_propped(&self, run: usize) -> bool {
        let mut attached = self.attached(run).peekable();
        attached.peek().is_some()
            && attached.all(
                |own| matches!(&own.law, ElementLaw::Support { damping, .. } if damping.is_zero()),
            )
            && self.sides(run).all(|side| side == Side::Free)
    }

    /// The contact, by its place among those of the node, that alone presses on a run on undamped supports: its force
    /// vanishes when they are back.
    pub fn contact_of_support(&self, run: usize) -> Option<usize> {
        let is_end = run == 0 || run == self.links.len();
        (is_end && self.is_propped(run))
            .then(|| self.contact_left_of(run).or_else(|| self.contact_right_of(run)))?
    }
}
