//! Materials and elements from their properties.

use std::collections::BTreeMap;

use super::{Lowering, Meaning, Outcome};
use crate::expression::{Fraction, PI};
use crate::language::diagnostic::Diagnostic;
use crate::language::scope::{symbol, with_likely};
use crate::language::syntax::{Declaration, Declared, Node, Property, SceneStatementKind, Span};
use crate::scene::{Bar, Body, Dimension, Drive, Ideal, Kind, Load, Mass, Spring};
use wavestep_polynomial::Rational;

/// What a value has to be at least.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Least {
    Zero,
    Positive,
}

/// What a bar can be made of.
#[derive(Clone)]
pub(super) struct Material {
    pub(super) modulus: Fraction,
    density: Fraction,
}

/// A property that may be given, what it is in errors, and what it measures.
pub(super) type Form = (&'static str, &'static str, Dimension);

pub(super) const MODULUS: Form = ("modulus", "a modulus", Dimension::PRESSURE);
const DENSITY: Form = ("density", "a density", Dimension::DENSITY);
const WAVE_SPEED: Form = ("wave_speed", "a wave speed", Dimension::VELOCITY);
const IMPEDANCE: Form = ("impedance", "an impedance", Dimension::IMPEDANCE);
const TRAVEL: Form = ("travel", "a travel time", Dimension::TIME);
const DIAMETER: Form = ("diameter", "a diameter", Dimension::LENGTH);
const INNER_DIAMETER: Form = ("inner_diameter", "an inner diameter", Dimension::LENGTH);
const AREA: Form = ("area", "an area", Dimension::AREA);
const LENGTH: Form = ("length", "a length", Dimension::LENGTH);
const VELOCITY: Form = ("velocity", "a velocity", Dimension::VELOCITY);
const STRAIN: Form = ("strain", "a strain", Dimension::NONE);
const MASS: Form = ("mass", "a mass", Dimension::MASS);
pub(super) const STIFFNESS: Form = ("stiffness", "a stiffness", Dimension::STIFFNESS);
const DAMPING: Form = ("damping", "a damping", Dimension::IMPEDANCE);
const FORCE: Form = ("force", "a force", Dimension::FORCE);
const FROM: Form = ("from", "a time", Dimension::TIME);
const UNTIL: Form = ("until", "a time", Dimension::TIME);
/// The most terms of a value that is squared.
const MAX_TERMS_SQUARED: usize = 300;

const SHARE: Form = ("share", "a share of the mass", Dimension::NONE);
const RATE: Form = ("rate", "a rate", Dimension::TIME.inverse());

/// Names, not quantities.
const MATERIAL: &str = "material";
const AS: &str = "as";

/// The properties that a declaration may give.
fn known(kind: Declared) -> Vec<&'static str> {
    let names = match kind {
        Declared::Material => "modulus density wave_speed",
        Declared::Bar => {
            "material diameter length velocity strain area inner_diameter modulus density \
             wave_speed impedance travel as share rate"
        }
        Declared::Mass => "mass velocity",
        Declared::Spring | Declared::Support => "stiffness damping",
        Declared::Hertz => {
            "force compression exponent stiffness radius material modulus poisson radius2 \
             material2 modulus2 poisson2"
        }
        Declared::Load => "force velocity from until",
    };
    names.split(' ').collect()
}

/// The properties of one declaration, each known and given once.
pub(super) struct Given<'a>(&'a Declaration, BTreeMap<&'a str, &'a Property>);

impl<'a> Given<'a> {
    pub(super) fn get(&self, name: &str) -> Option<&'a Property> {
        self.1.get(name).copied()
    }

    pub(super) fn span(&self) -> Span {
        self.0.name.span
    }
}

impl<'a> Lowering<'a> {
    /// Materials first, then elements.
    pub(super) fn properties(&mut self) {
        for statement in self.statements() {
            let SceneStatementKind::Declaration(declaration) = statement else { continue };
            if declaration.kind == Declared::Material && !self.is_hopeless() {
                let material = self.given(declaration).and_then(|given| self.stuff(&given));
                self.materials.entry(declaration.name.value.clone()).or_insert(material);
            }
        }
        for index in 0..self.elements.len() {
            if self.is_hopeless() {
                return;
            }
            let declaration = self.elements[index].declaration;
            let Some(given) = self.given(declaration) else { continue };
            let kind = match declaration.kind {
                Declared::Bar => self.bar(&given).map(Kind::Bar),
                Declared::Mass => self.mass(&given).map(Kind::Mass),
                Declared::Spring => self.spring(&given).map(Kind::Spring),
                Declared::Hertz => self.hertz(&given).map(Kind::Hertz),
                Declared::Support => self.spring(&given).map(Kind::Support),
                Declared::Load => self.load(&given).map(Kind::Load),
                Declared::Material => None,
            };
            self.elements[index].kind = kind;
        }
    }

    /// The properties of a declaration. Those that are unknown or given twice are refused.
    fn given(&mut self, declaration: &'a Declaration) -> Option<Given<'a>> {
        let (kind, known) = (declaration.kind, known(declaration.kind));
        let mut found = BTreeMap::<&str, &Property>::new();
        let mut is_whole = true;
        for property in &declaration.properties {
            let name = property.name.value.as_str();
            let error = if !known.contains(&name) {
                let message = format!("a {} has no property `{name}`", kind.noun());
                let error = self.error(message, property.name.span, "unknown property");
                let remedy = format!("its properties are `{}`", known.join("`, `"));
                with_likely(error, name, known.iter().copied()).or_remedy(remedy)
            } else if let Some(first) = found.get(name) {
                self.error(format!("`{name}` is given twice"), property.name.span, "again here")
                    .with_secondary(first.name.span, "first given here")
                    .with_remedy("remove one of the two")
            } else {
                found.insert(name, property);
                continue;
            };
            is_whole = false;
            self.errors.push(error);
        }
        is_whole.then_some(Given(declaration, found))
    }

    /// A property that may be left out: `Err` if it is wrong.
    pub(super) fn optional(
        &mut self,
        given: &Given<'_>,
        form: Form,
    ) -> Result<Option<Fraction>, ()> {
        let Some(property) = given.get(form.0) else { return Ok(None) };
        let outcome = self.value(property, form);
        self.keep(outcome).map(Some).ok_or(())
    }

    fn value(&self, property: &Property, (_, what, needed): Form) -> Outcome<Fraction> {
        self.quantity(&property.value, property.unit.as_ref(), needed, what)
    }

    /// A property that is zero if it is left out.
    fn or_zero(&mut self, given: &Given<'_>, form: Form) -> Option<Fraction> {
        self.optional(given, form).ok().map(|value| value.unwrap_or_else(Fraction::zero))
    }

    /// A property that must be given.
    pub(super) fn demanded(
        &mut self,
        given: &Given<'_>,
        form: Form,
        example: &str,
    ) -> Option<Fraction> {
        let message = || format!("this {} has no {}", given.0.kind.noun(), form.0);
        self.optional(given, form).ok()?.or_else(|| self.lack(given, message(), example))
    }

    /// Something is not given.
    pub(super) fn lack<T>(
        &mut self,
        given: &Given<'_>,
        message: impl Into<String>,
        example: &str,
    ) -> Option<T> {
        let example = match self.unit {
            Some(_) => example.to_owned(),
            None => without_unit(example),
        };
        let error = self
            .error(message, given.span(), "incomplete")
            .with_remedy(format!("give it, as in `{example}`"));
        self.refuse(error)
    }

    /// Two properties say the same in different ways.
    pub(super) fn refuse_both(&mut self, given: &Given<'_>, one: &str, other: &str) -> Option<()> {
        let (Some(first), Some(second)) = (given.get(one), given.get(other)) else {
            return Some(());
        };
        let (first, second) = match first.name.span.start < second.name.span.start {
            true => (first, second),
            false => (second, first),
        };
        let message =
            format!("`{}` and `{}` cannot both be given", first.name.value, second.name.value);
        let error = self
            .error(message, second.name.span, "says it again")
            .with_secondary(first.name.span, "given here")
            .with_remedy("remove one of the two");
        self.refuse(error)
    }

    /// A value of this declaration that is only used to work out others.
    pub(super) fn refuse_not_positive(
        &mut self,
        property: Option<&Property>,
        value: &Fraction,
        what: &str,
    ) -> Option<()> {
        if self.scope.assumptions.is_positive(value) {
            return Some(());
        }
        let span = property.map_or(self.tree.title.span, |property| property.value.span);
        let error =
            self.not_positive(format!("{what} must be positive"), span, value, Least::Positive);
        self.refuse(error)
    }

    /// A value that must be positive, or zero if that is allowed, and may not be.
    pub(super) fn not_positive(
        &self,
        message: String,
        span: Span,
        value: &Fraction,
        least: Least,
    ) -> Diagnostic {
        let or_zero = least == Least::Zero;
        let has_symbols = value.symbols().iter().any(|symbol| symbol.name() != PI);
        let label = match value.as_constant() {
            Some(_) if value.is_zero() => "this is zero",
            Some(_) => "this is negative",
            None if or_zero => "may be negative",
            None => "may be zero or negative",
        };
        let remedy = match (has_symbols, or_zero) {
            (true, true) => "declare its symbols with conditions, as in `symbol a >= 0`",
            (true, false) => "declare its symbols with conditions, as in `symbol a > 0`",
            (false, true) => "give zero or a positive value",
            (false, false) => "give a positive value",
        };
        self.error(message, span, label).with_remedy(remedy)
    }

    /// The square of a property, unless it would be huge.
    fn square(&mut self, given: &Given<'_>, name: &str, value: &Fraction) -> Option<Fraction> {
        if value.numerator().term_count() <= MAX_TERMS_SQUARED {
            return Some(value.pow(2));
        }
        let span = given.get(name).map_or(given.span(), |property| property.value.span);
        let error = self
            .error("this value is too large when squared", span, "grows too large")
            .with_remedy("introduce a symbol for a part of it");
        self.refuse(error)
    }

    /// Modulus and density, of a material or a bar.
    fn stuff(&mut self, given: &Given<'_>) -> Option<Material> {
        self.refuse_both(given, "modulus", "wave_speed")?;
        let density = self.demanded(given, DENSITY, "density = 7850 kg/m^3");
        let modulus = match self.optional(given, WAVE_SPEED) {
            Err(()) => None,
            Ok(None) => self.demanded(given, MODULUS, "modulus = 210 GPa"),
            Ok(Some(speed)) => {
                self.refuse_not_positive(given.get("wave_speed"), &speed, "the wave speed")?;
                let square = self.square(given, "wave_speed", &speed)?;
                density.as_ref().map(|density| density * &square)
            }
        };
        Some(Material { modulus: modulus?, density: density? })
    }

    fn bar(&mut self, given: &Given<'_>) -> Option<Bar> {
        let velocity = self.or_zero(given, VELOCITY);
        let strain = self.or_zero(given, STRAIN);
        let ideal = self.ideal(given);
        let body = match given.get("impedance").is_some() || given.get("travel").is_some() {
            true => self.body_by_impedance(given),
            false => self.solid(given),
        };
        Some(Bar { body: body?, velocity: velocity?, strain: strain?, ideal: ideal? })
    }

    /// What a bar is taken to be: `as = rigid`, `as = spring`, the latter with a `share` of its mass at each end.
    fn ideal(&mut self, given: &Given<'_>) -> Option<Option<Ideal>> {
        let share = self.optional(given, SHARE).ok()?;
        let rate = self.optional(given, RATE).ok()?;
        let of_spring = given.get(SHARE.0).or(given.get(RATE.0));
        let ideal = given.get(AS).map(|property| match &property.value.value {
            Node::Name(name) if property.unit.is_none() => match name.as_str() {
                "rigid" => Ok(Ideal::Rigid),
                "spring" => Ok(Ideal::Spring { share: share.clone(), rate: rate.clone() }),
                _ => Err(property),
            },
            _ => Err(property),
        });
        match (ideal, of_spring) {
            (Some(Err(property)), _) => {
                let error =
                    self.error("a bar is a spring or rigid", property.value.span, "neither");
                let remedy = "write `as = spring` or `as = rigid`, or leave it out";
                self.refuse(error.with_remedy(remedy))
            }
            (None | Some(Ok(Ideal::Rigid)), Some(share)) => {
                let name = &share.name.value;
                let message = format!("only a bar with `as = spring` has a {name}");
                let error = self.error(message, share.name.span, "of no spring");
                let remedy = format!("write `as = spring` too, or remove `{name}`");
                self.refuse(error.with_remedy(remedy))
            }
            (Some(Ok(ideal)), _) => Some(Some(ideal)),
            (None, None) => Some(None),
        }
    }

    fn body_by_impedance(&mut self, given: &Given<'_>) -> Option<Body> {
        for by_impedance in ["impedance", "travel"] {
            for solid in
                ["material", "modulus", "wave_speed", "density", "diameter", "area", "length"]
            {
                self.refuse_both(given, by_impedance, solid)?;
            }
        }
        let impedance = self.demanded(given, IMPEDANCE, "impedance = 12 kN*s/m");
        let travel = self.optional(given, TRAVEL).ok();
        Some(Body::Impedance { impedance: impedance?, travel: travel? })
    }

    fn solid(&mut self, given: &Given<'_>) -> Option<Body> {
        if given.1.keys().all(|name| ["velocity", "strain", "length"].contains(name)) {
            let message = "this bar has neither impedance nor material";
            return self.lack(given, message, "material = steel, diameter = 20 mm");
        }
        let material = match given.get(MATERIAL) {
            Some(property) => {
                for own in ["modulus", "wave_speed", "density"] {
                    self.refuse_both(given, MATERIAL, own)?;
                }
                let outcome = self.material(property);
                self.keep(outcome).flatten()
            }
            None => self.stuff(given),
        };
        let area = self.area(given);
        let length = self.optional(given, LENGTH).ok();
        let Material { modulus, density } = material?;
        Some(Body::Solid { area: area?, modulus, density, length: length? })
    }

    /// A material by name; `None` if it is wrong itself.
    pub(super) fn material(&self, property: &Property) -> Outcome<Option<Material>> {
        let Node::Name(name) = &property.value.value else {
            let error =
                self.error("a material is given by its name", property.value.span, "not a name");
            return Err(error.with_remedy(
                "declare it, as in `material steel { modulus = 210 GPa, density = 7850 kg/m^3 }`, and \
                 write `material = steel`",
            ));
        };
        if let Some(unit) = &property.unit {
            return Err(self
                .error("a material has no unit", unit.span, "not expected here")
                .with_remedy("separate properties by commas"));
        }
        if let Some(material) = self.materials.get(name) {
            return Ok(material.clone());
        }
        let error =
            self.error(format!("unknown material `{name}`"), property.value.span, "not declared");
        let known = self.declared.iter().filter(|(_, (_, m))| matches!(m, Meaning::Material));
        let names: Vec<&str> = known.map(|(name, _)| name.as_str()).collect();
        Err(with_likely(error, name, names.into_iter()).or_remedy(format!(
            "declare it, as in `material {name} {{ modulus = 210 GPa, density = 7850 kg/m^3 }}`"
        )))
    }

    /// The area, or that of a circle or a ring.
    fn area(&mut self, given: &Given<'_>) -> Option<Fraction> {
        self.refuse_both(given, "area", "diameter")?;
        self.refuse_both(given, "area", "inner_diameter")?;
        if given.get("area").is_none() && given.get("diameter").is_none() {
            let (missing, example) = match given.get("inner_diameter") {
                None => ("no section", "diameter = 20 mm` or `area = 3 cm^2"),
                Some(_) => ("an inner diameter and no outer one", "diameter = 20 mm"),
            };
            return self.lack(given, format!("this bar has {missing}"), example);
        }
        if let Some(area) = self.optional(given, AREA).ok()? {
            return Some(area);
        }
        let diameter = self.optional(given, DIAMETER).ok()??;
        let inner = self.optional(given, INNER_DIAMETER).ok()?;
        let outer_property = given.get("diameter");
        self.refuse_not_positive(outer_property, &diameter, "the diameter")?;
        let mut squares = self.square(given, "diameter", &diameter)?;
        if let (Some(inner), Some(property)) = (inner, given.get("inner_diameter")) {
            if !inner.is_zero() {
                self.refuse_not_positive(Some(property), &inner, "the inner diameter")?;
            }
            if !self.scope.assumptions.is_positive(&(&diameter - &inner)) {
                let span = outer_property.map_or(given.span(), |outer| outer.value.span);
                let error = self
                    .error(
                        "the inner diameter must be smaller than the diameter",
                        property.value.span,
                        "the inner diameter",
                    )
                    .with_secondary(span, "the diameter")
                    .with_remedy("leave something between the two");
                return self.refuse(error);
            }
            squares = &squares - &self.square(given, "inner_diameter", &inner)?;
        }
        let quarter = Rational::new(1.into(), 4.into());
        Some((&squares * &Fraction::symbol(&symbol(PI))).scale(&quarter))
    }

    fn mass(&mut self, given: &Given<'_>) -> Option<Mass> {
        let mass = self.demanded(given, MASS, "mass = 2 kg");
        let velocity = self.or_zero(given, VELOCITY);
        Some(Mass { mass: mass?, velocity: velocity? })
    }

    fn spring(&mut self, given: &Given<'_>) -> Option<Spring> {
        if given.1.is_empty() {
            let message = format!("this {} has neither stiffness nor damping", given.0.kind);
            return self.lack(given, message, "stiffness = 40 kN/mm` or `damping = 0.3 kN*s/m");
        }
        let (stiffness, damping) = (self.or_zero(given, STIFFNESS), self.or_zero(given, DAMPING));
        Some(Spring { stiffness: stiffness?, damping: damping? })
    }

    fn load(&mut self, given: &Given<'_>) -> Option<Load> {
        self.refuse_both(given, "force", "velocity")?;
        let drive = given.get("force").map(|force| (force, Drive::Force, FORCE));
        let velocity = given.get("velocity").map(|velocity| (velocity, Drive::Velocity, VELOCITY));
        let Some((property, drive, (_, what, needed))) = drive.or(velocity) else {
            let message = "this load has neither force nor velocity";
            return self.lack(given, message, "force = 3 kN` or `velocity = 2 m/s");
        };
        let course = self.course(&property.value, property.unit.as_ref(), needed, what);
        let course = self.keep(course);
        let from = self.or_zero(given, FROM);
        let until = self.optional(given, UNTIL).ok();
        Some(Load { drive, course: course?, from: from?, until: until? })
    }
}

/// An example of properties for a scene without units: `2 kg` is written `2`.
fn without_unit(example: &str) -> String {
    let mut plain = String::new();
    for word in example.split(' ') {
        let unit = word.trim_end_matches([',', '`']);
        let first = unit.split(['*', '/', '^']).next().unwrap_or(unit);
        let kept = if super::units::is_unit(first) { &word[unit.len()..] } else { word };
        if kept.len() == word.len() && !plain.is_empty() {
            plain.push(' ');
        }
        plain.push_str(kept);
    }
    plain
}
