//! A conservative line in its modes, in doubles or in enclosures.

use crate::ball::{BallError, Trigonometric};
use crate::model::error::NotRepresented;
use crate::model::line::Bar;
use crate::model::shape::{Part, Shape};
use crate::network::{ElementLaw, Face, Field, Lump, Node, Reading, Side, Term};
use crate::scene::ElementIndex;

/// The bars and nodes of a line, from left to right.
#[derive(Clone, Copy)]
pub(crate) struct ModalLine<'a, V> {
    pub bars: &'a [Bar<V>],
    pub nodes: &'a [Node<V>],
    pub bits: u64,
}

/// One mode with its motion: `q(t) = v/ω sin ωt + p/ω² (1 − cos ωt)`, or `v t` where it has no frequency.
#[derive(Clone, Debug)]
pub(crate) struct Mode<V> {
    pub shape: Shape<V>,
    /// `v`, the velocity at the start.
    velocity: V,
    /// `p`, the force of what is strained at the start, over the modal mass.
    push: V,
}

/// `c + s t + Σ (a cos ωt + b sin ωt)`
#[derive(Clone, PartialEq, Debug)]
pub struct Vibration<V = f64> {
    /// `c` and `s`.
    pub drift: [V; 2],
    /// `ω`, `a` and `b` of each mode.
    pub modes: Vec<[V; 3]>,
}

impl<'a, V: Trigonometric> ModalLine<'a, V> {
    /// The parts of the line from left to right.
    ///
    /// # Errors
    /// What has no modes.
    pub fn parts(
        &self,
        name: impl Fn(ElementIndex) -> String,
    ) -> Result<Vec<Part<V>>, NotRepresented> {
        if let Some(bar) = self.bars.iter().find(|bar| bar.travel.is_none()) {
            return Err(NotRepresented::EndlessVibration(bar.name.clone()));
        }
        if self.bars.is_empty() {
            return Err(NotRepresented::NoBar);
        }
        let mut parts = Vec::new();
        for (place, node) in self.nodes.iter().enumerate() {
            for own in &node.elements {
                let name = || name(own.element);
                if own.law.resistance().is_some_and(|[_, damping]| !damping.is_zero()) {
                    return Err(NotRepresented::Damping(name()));
                }
                parts.push(match own.law.clone() {
                    ElementLaw::Load(_) => return Err(NotRepresented::Load(name())),
                    ElementLaw::LocalContact { .. } => {
                        return Err(NotRepresented::LocalContact(name()));
                    }
                    ElementLaw::Mass { mass, .. } => Part::Mass { mass },
                    ElementLaw::Spring { stiffness, .. } => Part::Spring { stiffness },
                    ElementLaw::Support { stiffness, .. } => Part::Support { stiffness },
                });
            }
            if let Some(bar) = self.bars.get(place) {
                let travel = bar.travel.clone().expect("finite");
                parts.push(Part::Bar { impedance: bar.impedance.clone(), travel });
            }
        }
        Ok(parts)
    }

    /// Which ends are held.
    pub fn held(&self) -> [bool; 2] {
        [self.nodes[0].left, self.nodes[self.nodes.len() - 1].right].map(|side| side == Side::Fixed)
    }

    /// Whether the line moves as a whole: nothing holds it.
    pub fn drifts(&self) -> bool {
        let still = |law: &ElementLaw<V>| matches!(law, ElementLaw::Support { stiffness, .. } if !stiffness.is_zero());
        let mut elements = self.nodes.iter().flat_map(|node| &node.elements);
        self.held() == [false, false] && !elements.any(|own| still(&own.law))
    }

    /// The motion of a mode: what is moving at the start, and what is strained, projected onto it.
    ///
    /// # Errors
    /// Those of enclosures.
    pub fn mode(&self, shape: Shape<V>) -> Result<Mode<V>, BallError> {
        let bits = self.bits;
        let (mut momentum, mut force, mut part) = (V::zero(), V::zero(), 0);
        for (place, node) in self.nodes.iter().enumerate() {
            for own in &node.elements {
                if let ElementLaw::Mass { mass, velocity } = &own.law {
                    let own = mass.multiply(velocity, bits).multiply(&shape.left_of(part)[0], bits);
                    momentum = momentum.add(&own, bits);
                }
                part += 1;
            }
            if let Some(bar) = self.bars.get(place) {
                let own = bar.impedance.multiply(&bar.velocity, bits);
                momentum = momentum.add(&own.multiply(shape.integral(part), bits), bits);
                // The work of the force at the start, which compresses, while the bar lengthens.
                let [first, last] = [part, part + 1].map(|part| &shape.left_of(part)[0]);
                force = force.add(&bar.force.multiply(&last.subtract(first, bits), bits), bits);
                part += 1;
            }
        }
        let velocity = momentum.quotient(shape.mass(), bits)?;
        let push = force.quotient(shape.mass(), bits)?;
        Ok(Mode { shape, velocity, push })
    }

    /// What a sum of readings is in these modes; none where they do not have one of these readings.
    ///
    /// # Errors
    /// Those of enclosures.
    pub fn sum(
        &self,
        terms: &[Term<V>],
        modes: &[Mode<V>],
    ) -> Result<Option<Vibration<V>>, BallError> {
        let bits = self.bits;
        let mut sum = Vibration { drift: [V::zero(), V::zero()], modes: Vec::new() };
        for Term { coefficient, of } in terms {
            if let Reading::InBar(Field::Force, section) = of {
                let strained = coefficient.multiply(&self.bars[section.bar].force, bits);
                sum.drift[0] = sum.drift[0].add(&strained, bits);
            }
        }
        for mode in modes {
            let mut factors = [V::zero(), V::zero()];
            for Term { coefficient, of } in terms {
                let Some(seen) = self.seen(of, &mode.shape)? else { return Ok(None) };
                for (factor, seen) in factors.iter_mut().zip(seen) {
                    *factor = factor.add(&coefficient.multiply(&seen, bits), bits);
                }
            }
            mode.add_to(&mut sum, factors, bits)?;
        }
        Ok(Some(sum))
    }

    /// A reading of a mode, as factors of `q` and `q'`; none for what modes do not have.
    fn seen(&self, reading: &Reading<V>, shape: &Shape<V>) -> Result<Option<[V; 2]>, BallError> {
        let at = |lump: Lump| shape.left_of(self.part_of_node(lump.node) + lump.place);
        let law = |lump: Lump| &self.nodes[lump.node].elements[lump.place].law;
        let zero = V::zero;
        Ok(Some(match reading {
            Reading::InBar(field, section) => {
                let part = self.part_of_bar(section.bar);
                let [u, pulled] = shape.section(part, section.distance(), self.bits)?;
                match field {
                    Field::Velocity => [zero(), u],
                    Field::Displacement => [u, zero()],
                    Field::Force => [pulled.negate(), zero()],
                }
            }
            Reading::Momentum(bar) => {
                let part = self.part_of_bar(*bar);
                [zero(), self.bars[*bar].impedance.multiply(shape.integral(part), self.bits)]
            }
            Reading::Velocity(Face::Left(lump)) => [zero(), at(*lump)[0].clone()],
            Reading::Displacement(Face::Left(lump)) => [at(*lump)[0].clone(), zero()],
            // Beyond a damper, which modes refuse.
            Reading::Velocity(Face::Right(_)) | Reading::Displacement(Face::Right(_)) => {
                return Ok(None);
            }
            Reading::Compression(lump) => match law(*lump) {
                ElementLaw::Spring { stiffness, .. } => {
                    [at(*lump)[1].negate().quotient(stiffness, self.bits)?, zero()]
                }
                _ => return Ok(None),
            },
            Reading::Force(lump) => match law(*lump) {
                ElementLaw::Spring { .. } => [at(*lump)[1].negate(), zero()],
                ElementLaw::Support { stiffness, .. } => {
                    [stiffness.multiply(&at(*lump)[0], self.bits), zero()]
                }
                _ => return Ok(None),
            },
        }))
    }

    /// Where the parts of a node begin: behind all nodes and bars before it.
    fn part_of_node(&self, node: usize) -> usize {
        self.nodes[..node].iter().map(|node| node.elements.len() + 1).sum()
    }

    fn part_of_bar(&self, bar: usize) -> usize {
        self.part_of_node(bar + 1) - 1
    }
}

impl<V: Trigonometric> Mode<V> {
    /// Adds it with factors of `q` and `q'`.
    fn add_to(
        &self,
        sum: &mut Vibration<V>,
        [of_q, of_rate]: [V; 2],
        bits: u64,
    ) -> Result<(), BallError> {
        let (constant, slope);
        match self.shape.frequency() {
            None => {
                constant = of_rate.multiply(&self.velocity, bits);
                slope = of_q.multiply(&self.velocity, bits);
            }
            Some(frequency) => {
                let amplitude = self.velocity.quotient(frequency, bits)?;
                let pushed = self.push.quotient(frequency, bits)?;
                let bent = of_q.multiply(&pushed, bits).quotient(frequency, bits)?;
                let cosine = of_rate.multiply(&self.velocity, bits).subtract(&bent, bits);
                let sine =
                    of_q.multiply(&amplitude, bits).add(&of_rate.multiply(&pushed, bits), bits);
                if !cosine.is_zero() || !sine.is_zero() {
                    sum.modes.push([frequency.clone(), cosine, sine]);
                }
                (constant, slope) = (bent, V::zero());
            }
        }
        sum.drift[0] = sum.drift[0].add(&constant, bits);
        sum.drift[1] = sum.drift[1].add(&slope, bits);
        Ok(())
    }
}
