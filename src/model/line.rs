//! A scene in doubles: bars, nodes and observables in the scene's own scales, for models that compute
//! with rounded numbers.

use crate::enclosure::Numbers;
use crate::expression::Fraction;
use crate::model::course::{Course, double, double_root};
use crate::model::error::{ModelError, NotRepresented, NotSeen};
use crate::network::{ElementLaw, Layout, Measured, MeasuredValue, Node, ScaledScene, Term};
use crate::scene::ElementIndex;
use num_traits::ToPrimitive as _;
use std::collections::BTreeMap;

#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Bar<V = f64> {
    pub element: ElementIndex,
    pub name: String,
    /// `Z`.
    pub impedance: V,
    /// `τ`; `None` where it is endless.
    pub travel: Option<V>,
    /// The velocity at the start.
    pub velocity: V,
    /// The compressive force at the start.
    pub force: V,
    /// The nodes at its left and right end; none where it is endless.
    pub nodes: [Option<usize>; 2],
}

impl<V> Bar<V> {
    /// The bars of a line, from left to right.
    pub fn all<E>(
        scaled: &ScaledScene,
        layout: &Layout,
        value: impl Fn(&Fraction) -> Result<V, E>,
    ) -> Result<Vec<Bar<V>>, E> {
        let bar = |(element, nodes): (&ElementIndex, &[Option<usize>; 2])| {
            let data = &scaled.model().bars[element];
            Ok(Bar {
                element: *element,
                name: scaled.scene().elements[*element].name.clone(),
                impedance: value(&data.impedance)?,
                travel: data.travel.as_ref().map(&value).transpose()?,
                velocity: value(&data.velocity)?,
                force: value(&data.force)?,
                nodes: *nodes,
            })
        };
        layout.bars.iter().zip(&layout.ends).map(bar).collect()
    }
}

impl Bar {
    /// The waves to the right and to the left before the start: `(V ± X_0/Z)/2`.
    pub fn before(&self) -> [f64; 2] {
        let pressed = self.force / self.impedance;
        [(self.velocity + pressed) / 2.0, (self.velocity - pressed) / 2.0]
    }
}

/// A local contact in doubles: `X = F_0 (α/α_0)^m` for `α > 0`, else 0.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LocalContact {
    /// `F_0`
    pub force: f64,
    /// `α_0`
    pub compression: f64,
    /// `m`
    pub exponent: f64,
}

impl LocalContact {
    /// A local contact of a node; none for other elements.
    pub fn of(law: &ElementLaw<f64>) -> Option<LocalContact> {
        match law {
            ElementLaw::LocalContact { force, compression, exponent } => Some(LocalContact {
                force: *force,
                compression: *compression,
                exponent: exponent.to_f64().unwrap_or(f64::NAN),
            }),
            _ => None,
        }
    }

    /// The force at a compression `α`.
    pub fn force_at(&self, compression: f64) -> f64 {
        match compression > 0.0 {
            true => self.force * (compression / self.compression).powf(self.exponent),
            false => 0.0,
        }
    }

    /// How the force grows with the compression.
    pub fn slope_at(&self, compression: f64) -> f64 {
        match compression > 0.0 {
            true => self.exponent * self.force_at(compression) / compression,
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

#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Load {
    pub course: Course,
    pub from: f64,
    pub until: f64,
}

impl Node<f64> {
    /// The mass of a run, and its momentum at the start.
    pub fn mass_and_momentum(&self, run: usize) -> (f64, f64) {
        let masses = self.attached(run).filter_map(|own| match own.law {
            ElementLaw::Mass { mass, velocity } => Some((mass, mass * velocity)),
            _ => None,
        });
        masses.fold((0.0, 0.0), |sum, own| (sum.0 + own.0, sum.1 + own.1))
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
    fn of(measured: &Measured, numbers: &Numbers) -> Result<Observable, ModelError> {
        let unit = double_root(numbers, &measured.unit)?;
        let double = |term: &Term| -> Result<Term<f64>, ModelError> {
            let term = term.map(|value| double(numbers, value))?;
            Ok(Term { coefficient: term.coefficient * unit, ..term })
        };
        let terms = match &measured.value {
            MeasuredValue::Linear(terms) => {
                Some(terms.iter().map(double).collect::<Result<_, _>>()?)
            }
            MeasuredValue::Energy { .. } => None,
        };
        Ok(Observable { name: measured.name.clone(), terms })
    }

    /// The readings; none for an energy.
    pub fn terms(&self) -> &[Term<f64>] {
        self.terms.as_deref().unwrap_or_default()
    }
}

#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Line {
    /// The bars from left to right.
    pub bars: Vec<Bar>,
    /// The nodes from left to right.
    pub nodes: Vec<Node<f64>>,
    pub loads: BTreeMap<ElementIndex, Load>,
    /// What elements are called.
    names: Vec<String>,
    pub observables: Vec<Observable>,
    /// What one unit of the user's time is in the scale of the line.
    slowness: f64,
}

impl Line {
    /// The line with all contacts closed.
    pub fn of(scaled: &ScaledScene) -> Result<Line, ModelError> {
        Line::laid_out(scaled, &scaled.layout)
    }

    /// The line cut into these nodes and bars.
    pub fn laid_out(scaled: &ScaledScene, layout: &Layout) -> Result<Line, ModelError> {
        let numbers = Numbers::new(&scaled.model().constants);
        let mut symbols = scaled.model().assumptions.symbols().map(|(symbol, _)| symbol);
        if let Some(symbol) = symbols.find(|symbol| numbers.value(symbol, 64).is_none()) {
            return Err(ModelError::MissingValue(symbol.clone()));
        }
        let (scene, model) = (scaled.scene(), scaled.model());
        let double = |value: &Fraction| double(&numbers, value);
        let bars = Bar::all(scaled, layout, double)?;
        let nodes = layout.nodes.iter().map(|node| node.map(double));
        let mut loads = BTreeMap::new();
        for (element, load) in &model.loads {
            let course = Course::of(&numbers, &load.course, &scene.time)?;
            let until = load.until.as_ref().map(double).transpose()?.unwrap_or(f64::INFINITY);
            loads.insert(*element, Load { course, from: double(&load.from)?, until });
        }
        let observables = scaled.measures.iter().map(|own| Observable::of(own, &numbers));
        Ok(Line {
            bars,
            nodes: nodes.collect::<Result<_, _>>()?,
            loads,
            names: scene.elements.iter().map(|element| element.name.clone()).collect(),
            observables: observables.collect::<Result<_, _>>()?,
            slowness: double(&model.slowness)?,
        })
    }

    pub fn linear(model: &'static str, scaled: &ScaledScene) -> Result<Line, ModelError> {
        let line = Line::of(scaled)?;
        let mut elements = line.nodes.iter().flat_map(|node| &node.elements);
        match elements.find(|own| matches!(own.law, ElementLaw::LocalContact { .. })) {
            None => Ok(line),
            Some(contact) => {
                let reason = NotRepresented::LocalContact(line.name(contact.element));
                Err(ModelError::Refused { model, reason })
            }
        }
    }

    /// What an element is called.
    pub fn name(&self, element: ElementIndex) -> String {
        self.names[element].clone()
    }

    /// Times in the scale of the line.
    pub fn scaled(&self, times: &[f64]) -> Result<Vec<f64>, ModelError> {
        match times.iter().find(|time| !time.is_finite()) {
            Some(time) => Err(ModelError::Time(*time)),
            None => Ok(times.iter().map(|time| time * self.slowness).collect()),
        }
    }

    pub fn observable(&self, model: &'static str, index: usize) -> Result<&Observable, ModelError> {
        let count = self.observables.len();
        let observable = self.observables.get(index);
        let observable = observable.ok_or(ModelError::NoObservable { asked: index, count })?;
        if observable.terms.is_none() {
            return self.refuse(model, observable, NotSeen::Energy);
        }
        Ok(observable)
    }

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
            let free = (0..node.runs()).filter(|run| !node.is_imposed(*run));
            free.map(|run| node.mass_and_momentum(run))
        });
        let velocities = masses.filter(|(mass, _)| *mass > 0.0).map(|(mass, own)| own / mass);
        let waves = self.bars.iter().flat_map(Bar::before);
        match velocities.chain(waves).map(f64::abs).fold(0.0, f64::max) {
            most if most > 0.0 => most,
            _ => 1.0,
        }
    }
}
