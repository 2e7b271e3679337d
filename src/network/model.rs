//! A scene without units: everything in scales that the scene itself gives.
//!
//! With units, impedances are measured in that of the first finite bar, times in its travel time,
//! velocities in the first one that is not zero. What is then rational is put in as a number; what
//! is not gets a name, such as `kappa_specimen = k τ/Z`, and keeps its definition.

use crate::enclosure::Numbers;
use crate::expression::{
    Assumptions, Condition, Constant, Definition, Expression, Fraction, NotAUnit, PI, Relation,
    Root, free_name,
};
use crate::network::error::NetworkError;
use crate::network::node::ElementLaw;
use crate::scene::{Body, Dimension, Drive, ElementIndex, Kind, Scene, Spring};
use num_traits::{Signed, Zero};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use wavestep_polynomial::{Rational, Symbol};

/// The units of a model, in metres, kilograms and seconds.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Scale {
    /// The unit `Z` of impedance.
    pub impedance: Root,
    /// The unit `T` of time.
    pub time: Root,
    /// The unit `V` of velocity.
    pub velocity: Root,
    /// The element that gives the units of impedance and time.
    pub reference: Option<ElementIndex>,
    /// The element that gives the unit of velocity.
    pub moving: Option<ElementIndex>,
}

/// A bar without units.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ModelBar {
    pub impedance: Fraction,
    /// Its travel time; `None` where it is endless.
    pub travel: Option<Fraction>,
    /// Its velocity at the start.
    pub velocity: Fraction,
    /// The force that compresses it at the start.
    pub force: Fraction,
}

/// What a load does without units, in the unit of a force or a velocity.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ModelLoad {
    /// Its course in time.
    pub course: Expression,
    /// When it begins.
    pub from: Fraction,
    /// When it ends.
    pub until: Option<Fraction>,
}

/// A scene in scales of its own.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Model {
    /// The assumptions on symbols and named constants.
    pub assumptions: Assumptions,
    /// The constants that were named, with their definitions.
    pub constants: Vec<Constant>,
    /// The units.
    pub scale: Scale,
    /// One second in the unit of time.
    pub slowness: Fraction,
    pub bars: BTreeMap<ElementIndex, ModelBar>,
    /// The lumped elements.
    pub lumps: BTreeMap<ElementIndex, ElementLaw<Fraction>>,
    /// What those of them do that are loads.
    pub loads: BTreeMap<ElementIndex, ModelLoad>,
    /// How far apart contacts begin, by their joints.
    pub gaps: BTreeMap<usize, Fraction>,
}

type Outcome<T> = Result<T, NetworkError>;

/// The absolute value of a number that is not zero.
fn size(value: Option<Rational>) -> Option<Root> {
    let value = value.filter(|value| !value.is_zero())?;
    Some(Root::from(Fraction::constant(&value.abs())))
}

fn one() -> Root {
    Root::from(Fraction::one())
}

/// `Z`, `T` and the force that a strain of 1 goes with, of a bar.
pub(crate) fn bar_roots(body: &Body) -> Outcome<(Root, Option<Root>, Root)> {
    Ok(match body {
        Body::Impedance { impedance, travel } => {
            let impedance = Root::from(impedance.clone());
            (impedance.clone(), travel.clone().map(Root::from), impedance)
        }
        Body::Solid { area, modulus, density, length } => {
            let area = Root::from(area.clone());
            let impedance = area.times(&Root::of(modulus * density));
            let slowness = Root::of(density.clone()).over(&Root::of(modulus.clone()))?;
            let travel = length.clone().map(|length| Root::from(length).times(&slowness));
            (impedance, travel, area.times(&Root::from(modulus.clone())))
        }
    })
}

impl Model {
    /// The scene in its own scales.
    pub fn of(scene: &Scene) -> Outcome<Model> {
        Model::with(scene, Scale::of(scene)?, Vec::new(), scene.assumptions.clone())
    }

    /// Another scene without symbols in the scales of this one; its constants keep their names.
    pub(crate) fn beside(&self, scene: &Scene) -> Outcome<Model> {
        let scale = Scale { reference: None, moving: None, ..self.scale.clone() };
        Model::with(scene, scale, self.constants.clone(), self.assumptions.clone())
    }

    fn with(
        scene: &Scene,
        scale: Scale,
        constants: Vec<Constant>,
        assumptions: Assumptions,
    ) -> Outcome<Model> {
        let mut model = Model {
            assumptions,
            constants,
            scale,
            slowness: Fraction::one(),
            bars: BTreeMap::new(),
            lumps: BTreeMap::new(),
            loads: BTreeMap::new(),
            gaps: BTreeMap::new(),
        };
        let second = one().over(&model.scale.time)?;
        model.slowness = model.number("nu", second);
        for index in &scene.line.elements {
            model.add(scene, *index)?;
        }
        let length = model.scale.unit(Dimension::LENGTH)?;
        for (joint, gap) in &scene.line.gaps {
            let name = format!("gap_{}", scene.names_beside(*joint).join("_"));
            let gap = model.in_unit(&name, gap, &length)?;
            model.gaps.insert(*joint, gap);
        }
        Ok(model)
    }

    /// Adds an element.
    fn add(&mut self, scene: &Scene, index: ElementIndex) -> Outcome<()> {
        let element = &scene.elements[index];
        let named = |symbol: &str| format!("{symbol}_{}", element.name);
        let scale = self.scale.clone();
        let law = match &element.kind {
            Kind::Bar(bar) => {
                let (impedance, travel, stiffness) = bar_roots(&bar.body)?;
                let force = stiffness.times(&Root::from(-&bar.strain));
                let impedance = self.in_unit(&named("r"), impedance, &scale.impedance)?;
                let travel = travel.map(|travel| self.in_unit(&named("tau"), travel, &scale.time));
                let bar = ModelBar {
                    impedance,
                    travel: travel.transpose()?,
                    velocity: self.in_unit(&named("V"), &bar.velocity, &scale.velocity)?,
                    force: self.in_unit(&named("X"), force, &scale.force())?,
                };
                self.bars.insert(index, bar);
                return Ok(());
            }
            Kind::Mass(mass) => {
                let unit = scale.unit(Dimension::MASS)?;
                ElementLaw::Mass {
                    mass: self.in_unit(&named("m"), &mass.mass, &unit)?,
                    velocity: self.in_unit(&named("V"), &mass.velocity, &scale.velocity)?,
                }
            }
            Kind::Spring(spring) => {
                let [stiffness, damping] = self.yielding(&element.name, spring)?;
                ElementLaw::Spring { stiffness, damping }
            }
            Kind::Hertz(hertz) => {
                let length = scale.unit(Dimension::LENGTH)?;
                ElementLaw::LocalContact {
                    force: self.in_unit(&named("F"), &hertz.force, &scale.force())?,
                    compression: self.in_unit(&named("alpha"), &hertz.compression, &length)?,
                    exponent: hertz.exponent.clone(),
                }
            }
            Kind::Support(support) => {
                let [stiffness, damping] = self.yielding(&element.name, support)?;
                ElementLaw::Support { stiffness, damping }
            }
            Kind::Load(load) => {
                let unit = match load.drive {
                    Drive::Force => scale.force(),
                    Drive::Velocity => scale.velocity.clone(),
                };
                let unit = self.in_unit(&named("A"), one(), &unit)?;
                let clock = &self.slowness.inverse()? * &Fraction::symbol(&scene.time);
                let course = load.course.substitute(&scene.time, &clock)?.times(&unit);
                let from = self.in_unit(&named("from"), &load.from, &scale.time)?;
                let until = load.until.as_ref();
                let until = until.map(|until| self.in_unit(&named("until"), until, &scale.time));
                self.loads.insert(index, ModelLoad { course, from, until: until.transpose()? });
                ElementLaw::Load(load.drive)
            }
        };
        self.lumps.insert(index, law);
        Ok(())
    }

    /// A value in a unit, as [`Model::number`].
    fn in_unit(&mut self, name: &str, value: impl Into<Root>, unit: &Root) -> Outcome<Fraction> {
        let value = value.into().over(unit)?;
        Ok(self.number(name, value))
    }

    /// Stiffness and damping without units.
    fn yielding(
        &mut self,
        name: &str,
        Spring { stiffness, damping }: &Spring,
    ) -> Outcome<[Fraction; 2]> {
        let unit = self.scale.unit(Dimension::STIFFNESS)?;
        let impedance = self.scale.impedance.clone();
        Ok([
            self.in_unit(&format!("kappa_{name}"), stiffness, &unit)?,
            self.in_unit(&format!("delta_{name}"), damping, &impedance)?,
        ])
    }

    /// The value as a number where it is one, or a fraction of symbols; else as a constant, which is
    /// named.
    pub(crate) fn number(&mut self, name: &str, value: Root) -> Fraction {
        let pi = Symbol::new(PI).expect("a name");
        if let Some(exact) = value.exact().filter(|exact| !exact.contains(&pi)) {
            return exact;
        }
        // A rational multiple of what has a name, and is of its kind, needs none.
        let of_kind = self.constants.iter().filter(|c| kind(c.symbol.name()) == kind(name));
        let multiple = of_kind.into_iter().find_map(|constant| {
            let Definition::Root(root) = &constant.value else { return None };
            let ratio = value.over(root).ok()?.exact()?.as_constant()?;
            Some(Fraction::symbol(&constant.symbol).scale(&ratio))
        });
        multiple.unwrap_or_else(|| {
            let positive = self.is_positive(value.factor());
            let negative = !positive && self.is_positive(&-value.factor());
            let value = if negative { value.times(&Root::from(-&Fraction::one())) } else { value };
            let symbol = Fraction::symbol(&self.name(name, value.into(), positive || negative));
            if negative { -&symbol } else { symbol }
        })
    }

    /// Whether a value is certainly positive.
    fn is_positive(&self, value: &Fraction) -> bool {
        let order = Numbers::new(&self.constants).compare(value, &Fraction::zero());
        order == Ok(Ordering::Greater) || self.assumptions.is_positive(value)
    }

    /// Names a constant, and declares it positive where it is known to be.
    fn name(&mut self, name: &str, value: Definition, is_positive: bool) -> Symbol {
        let name = free_name(name, |name| self.assumptions.declares(name));
        let symbol = Symbol::new(&name).expect("a name with letters in front");
        let positive = Condition { relation: Relation::Greater, bound: Rational::zero() };
        self.assumptions.declare_symbol(symbol.clone(), is_positive.then_some(positive));
        self.constants.push(Constant { symbol: symbol.clone(), value });
        if let Some((lower, upper)) = Numbers::new(&self.constants).bounds(&symbol) {
            self.assumptions.declare_bounds(symbol.clone(), lower, upper);
        }
        symbol
    }
}

/// What a constant is, by the first part of its name; all times are of one kind, so that whether they
/// have a common measure shows.
fn kind(name: &str) -> &str {
    match name.split('_').next().unwrap_or(name) {
        "tau" | "nu" | "from" | "until" | "x" => "time",
        other => other,
    }
}

impl Scale {
    /// Plain numbers stay what they are; with units, the scene's own scales.
    fn of(scene: &Scene) -> Outcome<Scale> {
        let mut scale =
            Scale { impedance: one(), time: one(), velocity: one(), reference: None, moving: None };
        if !scene.dimensional {
            return Ok(scale);
        }
        let mut bars = Vec::new();
        for index in &scene.line.elements {
            if let Kind::Bar(bar) = &scene.elements[*index].kind {
                bars.push((*index, bar_roots(&bar.body)?));
            }
        }
        let finite = bars.iter().find(|(_, (_, travel, _))| travel.is_some());
        if let Some((index, (impedance, travel, _))) = finite.or(bars.first()) {
            scale.impedance = impedance.clone();
            scale.reference = Some(*index);
            if let Some(travel) = travel {
                scale.time = travel.clone();
            }
        }
        scale.set_velocity(scene)?;
        Ok(scale)
    }

    /// The first velocity in the line that is not zero, else that of a force or a strain.
    fn set_velocity(&mut self, scene: &Scene) -> Outcome<()> {
        for velocity in [Scale::given_velocity, Scale::caused_velocity] {
            for index in &scene.line.elements {
                if let Some(velocity) = velocity(self, &scene.elements[*index].kind)? {
                    (self.velocity, self.moving) = (velocity, Some(*index));
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// The velocity of a bar or a mass at the start.
    fn given_velocity(&self, kind: &Kind) -> Outcome<Option<Root>> {
        Ok(match kind {
            Kind::Bar(bar) => size(bar.velocity.as_constant()),
            Kind::Mass(mass) => size(mass.velocity.as_constant()),
            _ => None,
        })
    }

    /// The velocity that goes with a strain at the start, or with a constant load.
    fn caused_velocity(&self, kind: &Kind) -> Outcome<Option<Root>> {
        match kind {
            Kind::Bar(bar) => {
                let Some(strain) = size(bar.strain.as_constant()) else { return Ok(None) };
                let (impedance, _, stiffness) = bar_roots(&bar.body)?;
                Ok(Some(strain.times(&stiffness.over(&impedance)?)))
            }
            Kind::Load(load) => match (size(load.course.as_constant()), load.drive) {
                (Some(force), Drive::Force) => Ok(Some(force.over(&self.impedance)?)),
                (velocity, _) => Ok(velocity),
            },
            _ => Ok(None),
        }
    }

    /// The unit `Z V` of force.
    pub fn force(&self) -> Root {
        self.impedance.times(&self.velocity)
    }

    /// The unit of any dimension: `Z^m V^l T^(l + m + t)` is in metres to the power `l`, kilograms to `m`
    /// and seconds to `t`.
    pub fn unit(&self, dimension: Dimension) -> Result<Root, NotAUnit> {
        let Dimension { length, mass, time } = dimension;
        let powers =
            [(&self.impedance, mass), (&self.velocity, length), (&self.time, length + mass + time)];
        let mut unit = one();
        for (base, power) in powers {
            for _ in 0..power.unsigned_abs() {
                unit = if power > 0 { unit.times(base) } else { unit.over(base)? };
            }
        }
        Ok(unit)
    }
}
