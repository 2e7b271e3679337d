//! Bars and lumped elements.

use crate::expression::{Expression, Fraction};

/// The place of an element in [`Scene::elements`](crate::scene::Scene::elements).
pub type ElementIndex = usize;

/// A named part of a scene.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Element {
    /// What it is called.
    pub name: String,
    /// What it is.
    pub kind: Kind,
}

/// What an element is. All values are in metres, kilograms and seconds, or plain numbers.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Kind {
    /// A uniform bar.
    Bar(Bar),
    /// A rigid mass.
    Mass(Mass),
    /// A spring with a parallel damper, between what is left and right of it.
    Spring(Spring),
    /// A spring with a parallel damper, to the ground.
    Support(Support),
    /// A force from outside, or a motion that is imposed.
    Load(Load),
}

/// A uniform bar, finite or endless, moving and strained uniformly at the start.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Bar {
    /// What it is made of.
    pub body: Body,
    /// The velocity at the start.
    pub velocity: Fraction,
    /// The strain at the start, positive where it pulls.
    pub strain: Fraction,
}

impl Bar {
    /// Whether it goes on for ever.
    ///
    /// ```
    /// use wavestep::expression::Fraction;
    /// use wavestep::scene::{Bar, Body};
    ///
    /// let body = Body::Impedance { impedance: Fraction::one(), travel: Some(Fraction::one()) };
    /// let bar = Bar { body, velocity: Fraction::zero(), strain: Fraction::zero() };
    /// assert!(!bar.is_endless());
    /// assert_eq!(bar.extent(), Some(&Fraction::one()));
    /// ```
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
    /// The velocity at the start.
    pub velocity: Fraction,
}

/// A spring of stiffness `k` with a parallel damper `d`: `X = k α + d α'`, `α' = v_left − v_right`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Spring {
    /// `k`; zero for a damper alone.
    pub stiffness: Fraction,
    /// `d`; zero for a spring alone.
    pub damping: Fraction,
}

/// A spring of stiffness `k` with a parallel damper `d` to the ground: `X_left − X_right = d v + k u`,
/// `u' = v`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Support {
    /// `k`.
    pub stiffness: Fraction,
    /// `d`.
    pub damping: Fraction,
}

/// A load that acts from `from` until `until`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Load {
    /// What is given.
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
