//! Bars and lumped elements.

use crate::expression::{Expression, Fraction};
use crate::scene::Ideal;
use wavestep_polynomial::Rational;

/// The place of an element in [`Scene::elements`](crate::scene::Scene::elements).
pub type ElementIndex = usize;

/// A named part of a scene.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Element {
    pub name: String,
    pub kind: Kind,
}

/// What an element is. All values are in metres, kilograms and seconds, or plain numbers.
#[derive(Clone, PartialEq, Eq, Debug)]
#[expect(clippy::large_enum_variant, reason = "a scene holds few elements, most of them bars")]
pub enum Kind {
    Bar(Bar),
    Mass(Mass),
    /// A spring with a parallel damper, between what is left and right of it.
    Spring(Spring),
    Hertz(Hertz),
    /// A spring with a parallel damper, to the ground.
    Support(Spring),
    /// A force from outside, or a motion that is imposed.
    Load(Load),
}

/// A uniform bar, finite or endless, moving and strained uniformly at the start.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Bar {
    pub body: Body,
    pub velocity: Fraction,
    /// The strain at the start, positive where it pulls.
    pub strain: Fraction,
    /// What it is where waves in it are left out; `None` where they run.
    pub ideal: Option<Ideal>,
}

impl Bar {
    /// Whether it goes on for ever.
    pub fn is_endless(&self) -> bool {
        self.extent().is_none()
    }

    /// Its length, or its travel time where it is given by impedance; `None` for an endless bar.
    pub fn extent(&self) -> Option<&Fraction> {
        match &self.body {
            Body::Impedance { travel, .. } => travel.as_ref(),
            Body::Solid { length, .. } => length.as_ref(),
        }
    }
}

/// What a bar is made of.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Body {
    /// By impedance `Z = EA/c` and travel time `τ = L/c`. Strain is then `−X/(Zc)`, with the wave
    /// speed `c` taken as the unit of velocity.
    Impedance {
        /// `Z`, force over velocity.
        impedance: Fraction,
        /// `τ`; `None` for an endless bar.
        travel: Option<Fraction>,
    },
    /// By section, modulus, density and length: `c = √(E/ρ)`, `Z = A √(Eρ)`, `τ = L/c`.
    Solid {
        /// `A`.
        area: Fraction,
        /// `E`.
        modulus: Fraction,
        /// `ρ`.
        density: Fraction,
        /// `L`; `None` for an endless bar.
        length: Option<Fraction>,
    },
}

/// A rigid mass: `X_left − X_right = M v'`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Mass {
    /// `M`.
    pub mass: Fraction,
    pub velocity: Fraction,
}

/// A spring of stiffness `k` with a parallel damper `d`: `X = k α + d α'`, `α' = v_left − v_right`; as a
/// support, to the ground: `X_left − X_right = d v + k u`, `u' = v`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Spring {
    /// `k`; zero for a damper alone.
    pub stiffness: Fraction,
    /// `d`; zero for a spring alone.
    pub damping: Fraction,
}

/// A local contact: `X = F_0 (α/α_0)^m` while it is compressed, `α > 0`, and `X = 0` else; with
/// `α' = v_left − v_right`. It never pulls, and opens and closes freely.
///
/// Given by a point of its law, `(α_0, F_0)`, and not by `k = F_0/α_0^m`, whose unit is no product of
/// whole powers. Two bodies of radii `R_1`, `R_2` have `m = 3/2` and `X = (4/3) E* √R α^{3/2}` with
/// `1/R = 1/R_1 + 1/R_2` and `1/E* = (1 − ν_1²)/E_1 + (1 − ν_2²)/E_2` (Hertz); `α_0 = R` then makes
/// `F_0 = (4/3) E* R²`, both rational.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Hertz {
    /// `F_0`, the force at the compression `α_0`; positive.
    pub force: Fraction,
    /// `α_0`; positive.
    pub compression: Fraction,
    /// `m`, from the inverse of [`LEAST_EXPONENT_INVERSE`](crate::scene::LEAST_EXPONENT_INVERSE) to
    /// [`MAX_CONTACT_EXPONENT`](crate::limits::MAX_CONTACT_EXPONENT).
    pub exponent: Rational,
}

/// The inverse of the smallest exponent of a local contact. With smaller ones the contact is as good as
/// a constant force, and its start as good as a jump.
pub const LEAST_EXPONENT_INVERSE: u8 = 10;

/// A load that acts from `from` until `until`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Load {
    pub drive: Drive,
    /// Its course: an exponential polynomial of the scene's time, positive to the right.
    pub course: Expression,
    /// When it begins; not negative.
    pub from: Fraction,
    /// When it ends, after `from`; `None` for never.
    pub until: Option<Fraction>,
}

/// What a load gives.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Drive {
    /// A force: `X_right − X_left = F(t)`.
    Force,
    /// A velocity: `v = V(t)`.
    Velocity,
}
