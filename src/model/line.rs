//! A scene in doubles: bars, nodes and observables in the scene's own scales, for models that compute
//! with rounded numbers.

use crate::enclosure::Numbers;
use crate::model::course::{Course, double, double_root};
use crate::model::error::{ModelError, NotRepresented, NotSeen};
use crate::network::{
    Contacts, Face, Layout, Measured, MeasuredValue, ModelLump, ScaledScene, Side, Term, unit,
};
use crate::scene::{Drive, Kind, Measure};
use num_traits::ToPrimitive as _;

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

/// A local contact in doubles: `X = F_0 (α/α_0)^m` for `α > 0`, else 0.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct LocalContact {
    /// `F_0`
    pub force: f64,
    /// `α_0`
    pub compression: f64,
    /// `m`
    pub exponent: f64,
}

impl LocalContact {
    /// The force at a compression `α`.
    pub fn force_at(&self, compression: f64) -> f64 {
        match compression > 0.0 {
            true => self.force * (compression / self.compression).powf(self.exponent),
            false => 0.0,
        }
    }

    /// About the time in which the contact is pressed together: that in which the velocity `V` makes
    /// the compression of the force `Z V`. Without an impedance it is 1.
    pub fn time(&self, impedance: f64, velocity: f64) -> f64 {
        let share = impedance * velocity / self.force;
        let time = self.compression * share.powf(1.0 / self.exponent) / velocity;
        // Powers with small exponents may be beyond all doubles.
        if time > 0.0 && time.is_finite() { time } else { 1.0 }
    }

    /// The stiffness `k_1` of the linear spring that lets the force rise in about the same time where
    /// bars with `S = 1/Z_1 + 1/Z_2` meet with the velocity `V`.
    ///
    /// With `k = F_0/α_0^m` and `h = kS` the law `α' + h α^m = V` has one time, that in which `V`
    /// makes the compression at which it ends, `(V/h)^{1/m}/V`; that of a spring is `1/h_1`,
    /// `h_1 = k_1 S`. So `h_1 = h^{1/m} V^{1 − 1/m}`, which is 6.57 for `m = 3/2`.
    pub fn equivalent_stiffness(&self, compliance: f64, velocity: f64) -> f64 {
        let power = 1.0 / self.exponent;
        (self.force * compliance).powf(power) / self.compression * velocity.powf(1.0 - power)
            / compliance
    }
}

/// What a lumped element does.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Law {
    Mass { mass: f64, velocity: f64 },
    Spring { stiffness: f64, damping: f64 },
    Hertz(LocalContact),
    Support { stiffness: f64, damping: f64 },
    Load { drive: Drive, course: Course, from: f64, until: f64 },
}

impl Law {
    /// Whether it stands between two places that move apart from each other.
    pub fn parts_places(&self) -> bool {
        matches!(self, Law::Spring { .. } | Law::Hertz(_))
    }

    /// Whether it has a displacement or a compression of its own.
    pub fn yields(&self) -> bool {
        self.parts_places() || matches!(self, Law::Support { .. })
    }
}

/// A lumped element in doubles.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Lump {
    pub name: String,
    pub law: Law,
    /// The run of its node that it moves with; of what parts the node the one at its left.
    pub run: usize,
}

/// The elements between two bars, or between a bar and an end.
///
/// # Invariants
/// Springs and local contacts part the node into `runs` places with one velocity each, numbered from the left.
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

    /// Whether a run is fixed, or moves as a load says.
    pub fn is_imposed(&self, run: usize) -> bool {
        let imposes = |lump: &Lump| matches!(lump.law, Law::Load { drive: Drive::Velocity, .. });
        self.is_held(run) || self.lumps_of(run).any(imposes)
    }

    /// The lumped elements of a run; springs and local contacts are in none.
    pub fn lumps_of(&self, run: usize) -> impl Iterator<Item = &Lump> {
        self.lumps.iter().filter(move |lump| lump.run == run && !lump.law.parts_places())
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

/// An observable in doubles: readings in the scales of the line, with coefficients in the units of the
/// scene.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Observable {
    pub name: String,
    /// None for an energy, which is not linear in the motion.
    terms: Option<Vec<Term<f64>>>,
}

impl Observable {
    /// The readings; none for an energy.
    pub fn terms(&self) -> &[Term<f64>] {
        self.terms.as_deref().unwrap_or_default()
    }
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
    scaled: &'a ScaledScene,
    layout: Layout,
    numbers: Numbers,
}

impl Line {
    /// The line of a scene.
    ///
    /// # Errors
    /// [`ModelError::MissingValue`] for a symbol without a value.
    pub fn of(scaled: &ScaledScene) -> Result<Line, ModelError> {
        let numbers = Numbers::new(&scaled.model().constants);
        let mut symbols = scaled.model().assumptions.symbols().map(|(symbol, _)| symbol);
        if let Some(symbol) = symbols.find(|symbol| numbers.value(symbol, 64).is_none()) {
            return Err(ModelError::MissingValue(symbol.clone()));
        }
        let layout = Layout::of(scaled.scene(), scaled.model(), Contacts::Closed);
        Reader { scaled, layout, numbers }.line()
    }

    /// The line of a scene, for a model that takes linear laws.
    ///
    /// # Errors
    /// As [`Line::of`]; [`ModelError::Refused`] for a line with a local contact.
    pub fn linear(model: &'static str, scaled: &ScaledScene) -> Result<Line, ModelError> {
        let line = Line::of(scaled)?;
        let mut lumps = line.nodes.iter().flat_map(|node| &node.lumps);
        match lumps.find(|lump| matches!(lump.law, Law::Hertz(_))) {
            None => Ok(line),
            Some(contact) => {
                let reason = NotRepresented::LocalContact(contact.name.clone());
                Err(ModelError::Refused { model, reason })
            }
        }
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
    /// are not linear in the motion.
    pub fn observable(&self, model: &'static str, index: usize) -> Result<&Observable, ModelError> {
        let count = self.observables.len();
        let observable = self.observables.get(index);
        let observable = observable.ok_or(ModelError::NoObservable { asked: index, count })?;
        if observable.terms.is_none() {
            return self.refuse(model, observable, NotSeen::Energy);
        }
        Ok(observable)
    }

    /// An observable is refused.
    pub fn refuse<T>(
        &self,
        model: &'static str,
        observable: &Observable,
        term: NotSeen,
    ) -> Result<T, ModelError> {
        let reason = NotRepresented::Observable { observable: observable.name.clone(), term };
        Err(ModelError::Refused { model, reason })
    }

    /// The largest velocity at the start, of a wave or of what has a mass and is not held, or 1.
    pub fn speed(&self) -> f64 {
        let masses = self.nodes.iter().flat_map(|node| {
            let free = (0..node.runs).filter(|run| !node.is_imposed(*run));
            free.map(|run| node.mass_of(run))
        });
        let velocities = masses.filter(|(mass, _)| *mass > 0.0).map(|(mass, own)| own / mass);
        let waves = self.bars.iter().flat_map(Bar::before);
        match velocities.chain(waves).map(f64::abs).fold(0.0, f64::max) {
            most if most > 0.0 => most,
            _ => 1.0,
        }
    }

    /// The first endless bar.
    pub fn endless(&self) -> Option<&Bar> {
        self.bars.iter().find(|bar| bar.travel.is_none())
    }

    /// The run of its node that is beside a lumped element.
    pub fn run(&self, face: Face) -> usize {
        let Lump { law, run, .. } = &self.nodes[face.lump().node].lumps[face.lump().place];
        run + usize::from(matches!(face, Face::Right(_)) && law.parts_places())
    }

    /// What the unit of time is to the user, and the strain that goes with the unit of velocity in a
    /// bar, `V/c`.
    ///
    /// # Errors
    /// [`ModelError::Value`] where they are no numbers.
    pub fn units_of(&self, scaled: &ScaledScene, bar: usize) -> Result<(f64, f64), ModelError> {
        let numbers = Numbers::new(&scaled.model().constants);
        let layout = Layout::of(scaled.scene(), scaled.model(), Contacts::Closed);
        let Kind::Bar(data) = &scaled.scene().elements[layout.bars[bar]].kind else {
            unreachable!("a bar of the line")
        };
        let strain = unit(&scaled.model().scale, Measure::Strain, Some(&data.body));
        let strain = double_root(&numbers, &strain.expect("the network has read this bar"))?;
        Ok((1.0 / self.slowness, self.bars[bar].impedance * strain))
    }
}

impl Reader<'_> {
    fn line(&self) -> Result<Line, ModelError> {
        let mut bars = Vec::new();
        for (element, nodes) in self.layout.bars.iter().zip(&self.layout.ends) {
            let data = &self.scaled.model().bars[element];
            let double = |value| double(&self.numbers, value);
            bars.push(Bar {
                name: self.scaled.scene().elements[*element].name.clone(),
                impedance: double(&data.impedance)?,
                travel: data.travel.as_ref().map(double).transpose()?,
                velocity: double(&data.velocity)?,
                force: double(&data.force)?,
                nodes: *nodes,
            });
        }
        let nodes = (0..self.layout.nodes.len()).map(|node| self.node(node));
        let nodes = nodes.collect::<Result<Vec<_>, _>>()?;
        let observables = self.scaled.measures().iter().map(|measured| self.observable(measured));
        let observables = observables.collect::<Result<Vec<_>, _>>()?;
        let slowness = double(&self.numbers, &self.scaled.model().slowness)?;
        Ok(Line { bars, nodes, observables, slowness })
    }

    fn node(&self, index: usize) -> Result<Node, ModelError> {
        let scene = self.scaled.scene();
        let node = &self.layout.nodes[index];
        let double = |value| double(&self.numbers, value);
        let (mut lumps, mut runs) = (Vec::new(), 1);
        for element in node.elements.iter().map(|own| &own.element) {
            let law = match &self.scaled.model().lumps[element] {
                ModelLump::Mass(mass, velocity) => {
                    Law::Mass { mass: double(mass)?, velocity: double(velocity)? }
                }
                ModelLump::Spring(k, d) => {
                    Law::Spring { stiffness: double(k)?, damping: double(d)? }
                }
                ModelLump::Hertz(force, compression, exponent) => Law::Hertz(LocalContact {
                    force: double(force)?,
                    compression: double(compression)?,
                    exponent: exponent.to_f64().unwrap_or(f64::NAN),
                }),
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
            runs += usize::from(law.parts_places());
            lumps.push(Lump { name: scene.elements[*element].name.clone(), law, run });
        }
        Ok(Node { left: node.left, right: node.right, lumps, runs })
    }

    fn observable(&self, measured: &Measured) -> Result<Observable, ModelError> {
        let unit = double_root(&self.numbers, &measured.unit)?;
        let double = |term: &Term| -> Result<Term<f64>, ModelError> {
            let term = term.map(|value| double(&self.numbers, value))?;
            Ok(Term { coefficient: term.coefficient * unit, ..term })
        };
        let terms = match &measured.value {
            MeasuredValue::Linear(terms) => {
                Some(terms.iter().map(double).collect::<Result<_, _>>()?)
            }
            MeasuredValue::Energy(_) => None,
        };
        Ok(Observable { name: measured.name.clone(), terms })
    }
}
