//! The instant at which a contact opens, in closed form.
//!
//! Until the first opening the closed solution is true, and between two arrivals the force of a contact is an
//! exponential polynomial of the time. Where it is `e^{λs} (P + Q s)`, with P and Q free of time, it has the
//! one root `−P/Q`.

use crate::ball::Ball;
use crate::enclosure::enclose_expression;
use crate::expression::{Expression, Fraction};
use crate::network::Network;
use crate::scene::{Dimension, Joint, Kind, Measure, Observable, Place, Scene, Seen};
use crate::solution::Solution;
use num_traits::ToPrimitive as _;
use wavestep_polynomial::{Rational, Symbol};

/// The latest period that is looked at: its pieces are derived.
const MAX_PERIODS: usize = 40;

/// The name of the force, which no scene can use.
const FORCE: &str = "force of the contact";

/// The first opening of all contacts in closed form, at the joint of the line whose force comes to zero at an
/// enclosed instant; `None` where none of this kind is known.
///
/// Its enclosure and that of the instant meet, and both are roots on one stretch on which there is one.
pub fn opening(network: &Network, joint: usize, instant: &Ball) -> Option<Expression> {
    let scene = network.scene();
    if scene.dimensional || network.lattice().periods().len() != 1 {
        return None;
    }
    let place = beside(scene, joint)?;
    let (coefficient, dimension) = (Fraction::one(), Dimension::NONE);
    let seen = Seen { coefficient, dimension, measure: Measure::Force, place };
    let mut scene = scene.clone();
    scene.contacts_open = false;
    scene.observables = vec![Observable { name: FORCE.to_owned(), terms: vec![seen] }];
    let recurrence = Network::new(&scene).ok()?.recurrence().ok()?;
    if !recurrence.constants().is_empty() || recurrence.symbols().next().is_some() {
        return None;
    }
    let (period, local) = (&recurrence.statement().period, recurrence.statement().local.clone());
    let period = period.as_constant()?;
    let about = Rational::from(instant.midpoint());
    let last = (about / period).to_usize().filter(|last| *last <= MAX_PERIODS)?;
    let force = recurrence.observation(FORCE)?;
    let solution = Solution::new(recurrence);
    let first = last.saturating_sub(1);
    let stretches = solution.observed_between_arrivals(&force, first, last).ok()?;
    let [lower, upper] = instant.bounds();
    let stretch = stretches.into_iter().find(|stretch| {
        let ends = [&stretch.from, &stretch.to].map(Fraction::as_constant);
        matches!(ends, [Some(from), Some(to)]
            if from < lower && upper < to)
    })?;
    let root = &linear_root(&stretch.value, &local)? + &Expression::from(stretch.from);
    let bits = 2 * instant.midpoint().bits() + 64;
    let there = enclose_expression(&root, &|_, _| None, bits).ok()?;
    there.real().subtract(instant, bits).contains_zero().then_some(root)
}

/// Where the force of a contact is seen.
fn beside(scene: &Scene, joint: usize) -> Option<Place> {
    let line = &scene.line;
    assert!(line.joints[joint] == Joint::Contact);
    let left = joint.checked_sub(1).map(|place| line.elements[place]);
    let right = line.elements.get(joint).copied();
    let place = |element: Option<usize>, end: fn(usize) -> Place| {
        let element = element?;
        match scene.elements[element].kind {
            Kind::Bar(_) => Some(end(element)),
            Kind::Spring(_) => Some(Place::Element(element)),
            _ => None,
        }
    };
    place(left, Place::Right).or_else(|| place(right, Place::Left))
}

/// The root of `e^{λs} (P + Q s)`, with Q a rational number times one exponential of what is free of `s`.
pub fn linear_root(value: &Expression, s: &Symbol) -> Option<Expression> {
    let (exponent, _) = value.terms().next()?;
    let growth = &exponent.derivative(s) * &Fraction::symbol(s);
    let line = value.clone().times_exponential(&-&growth);
    let slope = line.derivative(s);
    // Zero where, and only where, all exponents are those of the first and no power is above the first.
    if !slope.derivative(s).is_zero() {
        return None;
    }
    let mut terms = slope.terms();
    let (Some((exponent, factor)), None) = (terms.next(), terms.next()) else { return None };
    let start = line.substitute(s, &Fraction::zero()).ok()?;
    let factor = factor.as_constant()?;
    Some(start.times_exponential(&-exponent).scale(&-factor.recip()))
}
