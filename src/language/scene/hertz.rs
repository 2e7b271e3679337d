//! Local contacts from their properties: by the law, or by the two bodies that touch.

use super::Lowering;
use super::element::{Form, Given, MODULUS, STIFFNESS};
use crate::expression::Fraction;
use crate::language::syntax::Span;
use crate::scene::{Dimension, Hertz};
use wavestep_polynomial::Rational;

const FORCE: Form = ("force", "a force", Dimension::FORCE);
const COMPRESSION: Form = ("compression", "a compression", Dimension::LENGTH);
const EXPONENT: Form = ("exponent", "an exponent", Dimension::NONE);
const PLAIN_STIFFNESS: Form = (STIFFNESS.0, STIFFNESS.1, Dimension::NONE);

/// The properties that give the law.
const LAW: [&str; 4] = ["stiffness", "force", "compression", "exponent"];

/// The properties that give one of the bodies.
struct Body {
    radius: Form,
    modulus: Form,
    material: &'static str,
    poisson: Form,
}

const FIRST: Body = Body {
    radius: ("radius", "a radius", Dimension::LENGTH),
    modulus: MODULUS,
    material: "material",
    poisson: ("poisson", "Poisson's ratio", Dimension::NONE),
};

const SECOND: Body = Body {
    radius: ("radius2", "a radius", Dimension::LENGTH),
    modulus: ("modulus2", "a modulus", Dimension::PRESSURE),
    material: "material2",
    poisson: ("poisson2", "Poisson's ratio", Dimension::NONE),
};

impl Body {
    /// The properties that say what it is made of.
    fn stuff(&self) -> [&'static str; 3] {
        [self.modulus.0, self.material, self.poisson.0]
    }
}

fn constant(numerator: i64, denominator: i64) -> Fraction {
    Fraction::constant(&Rational::new(numerator.into(), denominator.into()))
}

impl Lowering<'_> {
    /// A local contact, given in one of three ways: `X = k α^m`; the force at a compression; two
    /// bodies.
    pub(super) fn hertz(&mut self, given: &Given<'_>) -> Option<Hertz> {
        let bodies = [FIRST, SECOND];
        let of_bodies =
            bodies.iter().flat_map(|body| body.stuff().into_iter().chain([body.radius.0]));
        let of_bodies: Vec<&str> = of_bodies.collect();
        for law in LAW {
            for body in &of_bodies {
                self.refuse_both(given, law, body)?;
            }
        }
        if of_bodies.iter().any(|name| given.get(name).is_some()) {
            return self.two_bodies(given);
        }
        for point in ["force", "compression"] {
            self.refuse_both(given, "stiffness", point)?;
        }
        if LAW[..3].iter().all(|name| given.get(name).is_none()) {
            let message = "this local contact has neither a force law nor bodies";
            let example = "force = 10 kN, compression = 1/10 mm` or \
                           `radius = 6 mm, modulus = 210 GPa, poisson = 3/10";
            return self.lack(given, message, example);
        }
        let exponent = self.exponent(given);
        let (force, compression) = match given.get("stiffness") {
            // k α^m passes through the point (1, k).
            Some(_) => (self.plain_stiffness(given), Some(Fraction::one())),
            None => (
                self.demanded(given, FORCE, "force = 10 kN"),
                self.demanded(given, COMPRESSION, "compression = 1/10 mm"),
            ),
        };
        Some(Hertz { force: force?, compression: compression?, exponent: exponent? })
    }

    fn exponent(&mut self, given: &Given<'_>) -> Option<Rational> {
        let Some(property) = given.get(EXPONENT.0) else {
            return Some(Rational::new(3.into(), 2.into()));
        };
        let value = self.optional(given, EXPONENT).ok()??;
        if value.as_constant().is_none() {
            let error = self
                .error("an exponent is a rational number", property.value.span, "has a symbol")
                .with_remedy("write a number such as `3/2`, or give the symbol a value with --set");
            self.errors.push(error);
        }
        value.as_constant()
    }

    /// `k` of `X = k α^m`, in scenes without units.
    fn plain_stiffness(&mut self, given: &Given<'_>) -> Option<Fraction> {
        let property = given.get(STIFFNESS.0)?;
        if let Some(unit) = self.unit {
            let message = "the stiffness of a local contact, N/m^m with its exponent m, has no unit \
                           here";
            let error = self
                .error(message, property.name.span, "in a scene with units")
                .with_secondary(unit, "this scene has units")
                .with_remedy(
                    "give the force at a compression, as in `force = 10 kN, compression = 1/10 mm`",
                );
            return self.refuse(error);
        }
        let stiffness = self.optional(given, PLAIN_STIFFNESS).ok()??;
        self.refuse_not_positive(Some(property), &stiffness, "the stiffness")?;
        Some(stiffness)
    }

    /// Hertz: `X = (4/3) E* √R α^{3/2}`, through the point `α_0 = R`, `F_0 = (4/3) E* R²`.
    fn two_bodies(&mut self, given: &Given<'_>) -> Option<Hertz> {
        let first = self.compliance(given, &FIRST);
        let of_second = SECOND.stuff();
        let second = match of_second.iter().any(|name| given.get(name).is_some()) {
            true => self.compliance(given, &SECOND),
            false => first.clone(),
        };
        let radius = self.radius(given);
        let compliance = &first? + &second?;
        let (modulus, radius) = (self.reciprocal(given.span(), &compliance)?, radius?);
        let force = &(&modulus * &radius.pow(2)) * &constant(4, 3);
        let exponent = Rational::new(3.into(), 2.into());
        Some(Hertz { force, compression: radius, exponent })
    }

    /// `(1 − ν²)/E` of a body.
    fn compliance(&mut self, given: &Given<'_>, body: &Body) -> Option<Fraction> {
        self.refuse_both(given, body.material, body.modulus.0)?;
        let modulus = match given.get(body.material) {
            Some(property) => {
                let outcome = self.material(property);
                self.keep(outcome).flatten().map(|material| material.modulus)
            }
            None => {
                let example = format!("{} = 210 GPa", body.modulus.0);
                self.demanded(given, body.modulus, &example)
            }
        };
        let poisson = self.poisson(given, body);
        let (modulus, poisson) = (modulus?, poisson?);
        let property = given.get(body.modulus.0).or(given.get(body.material));
        self.refuse_not_positive(property, &modulus, "the modulus")?;
        let span = property.map_or(given.span(), |property| property.value.span);
        let inverse = self.reciprocal(span, &modulus)?;
        Some(&(&Fraction::one() - &poisson.pow(2)) * &inverse)
    }

    /// `ν` of a body: `−1 < ν ≤ 1/2`, for else its shear or its bulk modulus would be negative.
    fn poisson(&mut self, given: &Given<'_>, body: &Body) -> Option<Fraction> {
        let example = format!("{} = 3/10", body.poisson.0);
        if given.get(body.poisson.0).is_none() {
            let message = "a body of this local contact has no Poisson's ratio";
            return self.lack(given, message, &example);
        }
        let poisson = self.demanded(given, body.poisson, &example)?;
        let above = &constant(1, 1) + &poisson;
        let below = &constant(1, 2) - &poisson;
        let assumptions = &self.scope.assumptions;
        let is_within =
            assumptions.is_positive(&above) && (below.is_zero() || assumptions.is_positive(&below));
        if is_within {
            return Some(poisson);
        }
        let span = given.get(body.poisson.0).map_or(given.span(), |property| property.value.span);
        let label = match poisson.as_constant() {
            Some(_) => "outside this range",
            None => "may be outside this range",
        };
        let error = self
            .error("Poisson's ratio must be above -1 and at most 1/2", span, label)
            .with_remedy("metals have about 3/10, rubber has nearly 1/2");
        self.refuse(error)
    }

    /// `R` with `1/R = 1/R_1 + 1/R_2`. A body without a radius is flat, one with a negative radius
    /// hollow.
    fn radius(&mut self, given: &Given<'_>) -> Option<Fraction> {
        let (mut curvature, mut widest) = (Fraction::zero(), None);
        for body in [FIRST, SECOND] {
            let Some(property) = given.get(body.radius.0) else { continue };
            let radius = self.optional(given, body.radius).ok()??;
            if radius.is_zero() {
                let error = self
                    .error("a radius cannot be zero", property.value.span, "this is zero")
                    .with_remedy("leave it out for a flat body, or give the radius of the tip");
                return self.refuse(error);
            }
            curvature = &curvature + &self.reciprocal(property.value.span, &radius)?;
            widest = Some(property.value.span);
        }
        let Some(span) = widest else {
            let message = "both bodies of this local contact are flat";
            return self.lack(given, message, "radius = 6 mm");
        };
        if !self.scope.assumptions.is_positive(&curvature) {
            let message = "the bodies do not certainly touch at one point: 1/R1 + 1/R2 is not \
                           certainly positive";
            let error = self.error(message, span, "too concave").with_remedy(
                "a concave body, of negative radius, needs a larger radius than the ball in it",
            );
            return self.refuse(error);
        }
        self.reciprocal(span, &curvature)
    }

    /// One over a value that is not zero.
    fn reciprocal(&mut self, span: Span, value: &Fraction) -> Option<Fraction> {
        let inverse = value.inverse().map_err(|_| {
            let message = "this is a divisor, and may be zero";
            self.error(message, span, "divides")
                .with_remedy("give its symbols values with --set, or write numbers")
        });
        self.keep(inverse)
    }
}
