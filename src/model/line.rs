//! A scene in doubles: bars, nodes and observables in the scene's own scales, for models that compute
//! with rounded numbers.

use crate::enclosure::Numbers;
use crate::model::course::{Course, double, double_root};
use crate::model::error::ModelError;
use crate::network::{Layout, ModelLump, Network, Side, bar_roots};
use crate::scene::{Body, Drive, ElementIndex, Kind, Measure, Place, Position};

/// A bar in doubles.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Bar {
    pub name: String,
    /// `Z`.
    pub impedance: f64,
    /// `τ`; `None` where it is endless.
    pub travel: Option<f64>,
    /// The velocity at the start.
    pub velocity: f64,
    /// The compressive force at the start.
    pub force: f64,
    /// The nodes at its left and right end; none where it is endless.
    pub nodes: [Option<usize>; 2],
}

impl Bar {
    /// `Zτ`, its mass; infinite for an endless bar.
    pub fn mass(&self) -> f64 {
        self.impedance * self.travel.unwrap_or(f64::INFINITY)
    }

    /// The waves to the right and to the left before the start: `(V ± X_0/Z)/2`.
    pub fn before(&self) -> [f64; 2] {
        let pressed = self.force / self.impedance;
        [(self.velocity + pressed) / 2.0, (self.velocity - pressed) / 2.0]
    }
}

/// What a lumped element does.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Law {
    Mass { mass: f64, velocity: f64 },
    Spring { stiffness: f64, damping: f64 },
    Support { stiffness: f64, damping: f64 },
    Load { drive: Drive, course: Course, from: f64, until: f64 },
}

/// A lumped element in doubles.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Lump {
    pub name: String,
    pub law: Law,
    /// The run of its node that it moves with; of a spring the one at its left.
    pub run: usize,
}

/// The elements between two bars, or between a bar and an end.
///
/// # Invariants
/// Springs part the node into `runs` places with one velocity each, numbered from the left.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Node {
    pub left: Side,
    pub right: Side,
    pub lumps: Vec<Lump>,
    pub runs: usize,
}

impl Node {
    /// The sides of a run: what the node has at its left and right end, where the run reaches it.
    pub fn sides(&self, run: usize) -> impl Iterator<Item = Side> {
        let left = (run == 0).then_some(self.left);
        let right = (run + 1 == self.runs).then_some(self.right);
        left.into_iter().chain(right)
    }

    /// Whether a run cannot move.
    pub fn is_held(&self, run: usize) -> bool {
        self.sides(run).any(|side| side == Side::Fixed)
    }

    /// The lumped elements of a run; springs are in none.
    pub fn lumps_of(&self, run: usize) -> impl Iterator<Item = &Lump> {
        let spring = |lump: &Lump| matches!(lump.law, Law::Spring { .. });
        self.lumps.iter().filter(move |lump| lump.run == run && !spring(lump))
    }

    /// The mass of the lumped masses of a run, and their momentum at the start.
    pub fn mass_of(&self, run: usize) -> (f64, f64) {
        let mut sum = (0.0, 0.0);
        for lump in self.lumps_of(run) {
            if let Law::Mass { mass, velocity } = lump.law {
                sum = (sum.0 + mass, sum.1 + mass * velocity);
            }
        }
        sum
    }
}

/// What is observed in a bar or of a lumped element.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Quantity {
    Velocity,
    Displacement,
    Force,
    Compression,
    Momentum,
    Energy,
}

/// Where something is observed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Spot {
    /// In a bar, by the time that a wave needs to it from the left end, or from the end of an endless
    /// bar.
    Section { bar: usize, at: f64 },
    /// A bar as a whole.
    Bar(usize),
    /// A lumped element, by its node and its place there.
    Lump { node: usize, place: usize },
}

/// One term of an observable: a coefficient, in the units of the scene, times a quantity in the scales
/// of the line.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Term {
    pub coefficient: f64,
    pub quantity: Quantity,
    pub spot: Spot,
}

/// An observable in doubles.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Observable {
    pub name: String,
    pub terms: Vec<Term>,
}

/// A scene in doubles.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Line {
    /// The bars from left to right.
    pub bars: Vec<Bar>,
    /// The nodes from left to right.
    pub nodes: Vec<Node>,
    pub observables: Vec<Observable>,
    /// What one unit of the user's time is in the scale of the line.
    slowness: f64,
}

/// Reads a network.
struct Reader<'a> {
    network: &'a Network,
    layout: Layout,
    numbers: Numbers,
}

impl Line {
    /// The line of a network.
    ///
    /// # Errors
    /// [`ModelError::MissingValue`] for a symbol without a value.
    pub fn of(network: &Network) -> Result<Line, ModelError> {
        let numbers = Numbers::new(&network.model().constants);
        let mut symbols = network.model().assumptions.symbols().map(|(symbol, _)| symbol);
        if let Some(symbol) = symbols.find(|symbol| numbers.value(symbol, 64).is_none()) {
            return Err(ModelError::MissingValue(symbol.clone()));
        }
        let layout = Layout::of(network.scene());
        Reader { network, layout, numbers }.line()
    }

    /// Times in the scale of the line.
    ///
    /// # Errors
    /// [`ModelError::Time`] for one that is not finite.
    pub fn scaled(&self, times: &[f64]) -> Result<Vec<f64>, ModelError> {
        match times.iter().find(|time| !time.is_finite()) {
            Some(time) => Err(ModelError::Time(*time)),
            None => Ok(times.iter().map(|time| time * self.slowness).collect()),
        }
    }

    /// An observable by its number.
    ///
    /// # Errors
    /// [`ModelError::NoObservable`] where there is none; [`ModelError::Refused`] for energies, which
    /// are not linear in the motion, and for the momentum of an endless bar.
    pub fn observable(&self, model: &'static str, index: usize) -> Result<&Observable, ModelError> {
        let count = self.observables.len();
        let observable = self.observables.get(index);
        let observable = observable.ok_or(ModelError::NoObservable { asked: index, count })?;
        for term in &observable.terms {
            if term.quantity == Quantity::Energy {
                return self.refuse(model, observable, "an energy, of which it keeps no account");
            }
            if let (Quantity::Momentum, Spot::Bar(bar)) = (term.quantity, term.spot)
                && self.bars[bar].travel.is_none()
            {
                return self.refuse(model, observable, "the momentum of an endless bar");
            }
        }
        Ok(observable)
    }

    /// An observable is refused.
    pub fn refuse<T>(
        &self,
        model: &'static str,
        observable: &Observable,
        what: &str,
    ) -> Result<T, ModelError> {
        let reason = format!("{} observes {what}", observable.name);
        Err(ModelError::Refused { model, reason })
    }

    /// The first endless bar.
    pub fn endless(&self) -> Option<&Bar> {
        self.bars.iter().find(|bar| bar.travel.is_none())
    }

    /// What the unit of time is to the user, and the strain that goes with the unit of velocity in a
    /// bar, `V/c`.
    ///
    /// # Errors
    /// [`ModelError::Value`] where they are no numbers.
    pub fn units_of(&self, network: &Network, bar: usize) -> Result<(f64, f64), ModelError> {
        let numbers = Numbers::new(&network.model().constants);
        let layout = Layout::of(network.scene());
        let Kind::Bar(data) = &network.scene().elements[layout.bars[bar]].kind else {
            unreachable!("a bar of the line")
        };
        let (_, _, stiffness) = bar_roots(&data.body).expect("the network has read this bar");
        let force = double_root(&numbers, &network.model().scale.force())?;
        let strain = self.bars[bar].impedance * force / double_root(&numbers, &stiffness)?;
        Ok((1.0 / self.slowness, strain))
    }
}

impl Reader<'_> {
    fn line(&self) -> Result<Line, ModelError> {
        let mut bars = Vec::new();
        for (element, nodes) in self.layout.bars.iter().zip(&self.layout.ends) {
            let data = &self.network.model().bars[element];
            let double = |value| double(&self.numbers, value);
            bars.push(Bar {
                name: self.network.scene().elements[*element].name.clone(),
                impedance: double(&data.impedance)?,
                travel: data.travel.as_ref().map(double).transpose()?,
                velocity: double(&data.velocity)?,
                force: double(&data.force)?,
                nodes: *nodes,
            });
        }
        let nodes = (0..self.layout.nodes.len()).map(|node| self.node(node));
        let nodes = nodes.collect::<Result<Vec<_>, _>>()?;
        let scene = self.network.scene();
        let mut observables = Vec::new();
        for observable in &scene.observables {
            let mut terms = Vec::new();
            for seen in &observable.terms {
                let coefficient = double(&self.numbers, &seen.coefficient)?;
                match seen.place {
                    Place::Line => {
                        for element in &scene.line.elements {
                            let kind = &scene.elements[*element].kind;
                            if matches!(kind, Kind::Bar(_) | Kind::Mass(_)) {
                                let place = Place::Element(*element);
                                terms.push(self.term(coefficient, seen.measure, &place, &bars)?);
                            }
                        }
                    }
                    ref place => terms.push(self.term(coefficient, seen.measure, place, &bars)?),
                }
            }
            observables.push(Observable { name: observable.name.clone(), terms });
        }
        let slowness = double(&self.numbers, &self.network.model().slowness)?;
        Ok(Line { bars, nodes, observables, slowness })
    }

    fn node(&self, index: usize) -> Result<Node, ModelError> {
        let scene = self.network.scene();
        let node = &self.layout.nodes[index];
        let double = |value| double(&self.numbers, value);
        let (mut lumps, mut runs) = (Vec::new(), 1);
        for element in &node.elements {
            let law = match &self.network.model().lumps[element] {
                ModelLump::Mass(mass, velocity) => {
                    Law::Mass { mass: double(mass)?, velocity: double(velocity)? }
                }
                ModelLump::Spring(k, d) => {
                    Law::Spring { stiffness: double(k)?, damping: double(d)? }
                }
                ModelLump::Support(k, d) => {
                    Law::Support { stiffness: double(k)?, damping: double(d)? }
                }
                ModelLump::Load(drive, course, from, until) => Law::Load {
                    drive: *drive,
                    course: Course::of(&self.numbers, course, &scene.time)?,
                    from: double(from)?,
                    until: until.as_ref().map(double).transpose()?.unwrap_or(f64::INFINITY),
                },
            };
            let run = runs - 1;
            runs += usize::from(matches!(law, Law::Spring { .. }));
            lumps.push(Lump { name: scene.elements[*element].name.clone(), law, run });
        }
        Ok(Node { left: node.left, right: node.right, lumps, runs })
    }

    fn term(
        &self,
        coefficient: f64,
        measure: Measure,
        place: &Place,
        bars: &[Bar],
    ) -> Result<Term, ModelError> {
        let root = |root| double_root(&self.numbers, root);
        let scale = &self.network.model().scale;
        let (time, velocity) = (root(&scale.time)?, root(&scale.velocity)?);
        let force = root(&scale.force())?;
        let (quantity, unit) = match measure {
            Measure::Velocity => (Quantity::Velocity, velocity),
            Measure::Displacement => (Quantity::Displacement, velocity * time),
            Measure::Compression => (Quantity::Compression, velocity * time),
            Measure::Force => (Quantity::Force, force),
            Measure::Strain | Measure::Stress => {
                (Quantity::Force, -force / self.pulled(measure, place)?)
            }
            Measure::Momentum => (Quantity::Momentum, force * time),
            Measure::Energy => (Quantity::Energy, force * velocity * time),
        };
        let bar = |element: &ElementIndex| self.layout.bar(*element).expect("a bar of the line");
        let spot = match place {
            Place::Left(element) => Spot::Section { bar: bar(element), at: 0.0 },
            Place::Right(element) => {
                let bar = bar(element);
                // An endless bar to the left is counted from its one end.
                Spot::Section { bar, at: bars[bar].travel.unwrap_or(0.0) }
            }
            Place::At(element, position) => {
                let bar = bar(element);
                let at = match position {
                    Position::Share(share) => {
                        double(&self.numbers, share)? * bars[bar].travel.unwrap_or(0.0)
                    }
                    Position::Distance(distance) => {
                        double(&self.numbers, distance)? * self.wave_slowness(*element)? / time
                    }
                };
                Spot::Section { bar, at }
            }
            Place::Element(element) => match self.layout.node_of(*element) {
                Some(node) => {
                    let elements = &self.layout.nodes[node].elements;
                    let place = elements.iter().position(|own| own == element);
                    Spot::Lump { node, place: place.expect("an element of its node") }
                }
                None => Spot::Bar(bar(element)),
            },
            Place::Line => unreachable!("the line is observed element by element"),
        };
        Ok(Term { coefficient: coefficient * unit, quantity, spot })
    }

    fn body(&self, element: ElementIndex) -> &Body {
        match &self.network.scene().elements[element].kind {
            Kind::Bar(bar) => &bar.body,
            _ => unreachable!("sections are in bars"),
        }
    }

    /// The force that a strain of 1, or a stress of 1, goes with.
    fn pulled(&self, measure: Measure, place: &Place) -> Result<f64, ModelError> {
        let element = place.element().expect("strain and stress are seen in bars");
        match (self.body(element), measure) {
            (Body::Solid { area, .. }, Measure::Stress) => Ok(double(&self.numbers, area)?),
            (body, _) => {
                let strained = bar_roots(body).map(|(_, _, stiffness)| stiffness);
                let strained = strained.expect("the network has read this bar");
                Ok(double_root(&self.numbers, &strained)?)
            }
        }
    }

    /// The time in which a wave goes a unit of distance; distances in bars given by impedance are
    /// times.
    fn wave_slowness(&self, element: ElementIndex) -> Result<f64, ModelError> {
        match self.body(element) {
            Body::Impedance { .. } => Ok(1.0),
            Body::Solid { modulus, density, .. } => {
                let modulus = double(&self.numbers, modulus)?;
                Ok((double(&self.numbers, density)? / modulus).sqrt())
            }
        }
    }
}
