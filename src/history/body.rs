//! Bodies: the parts of the line between open contacts, with their energies and momenta.

use crate::ball::{Ball, Magnitude, Number};
use crate::history::energy::Integrand;
use crate::history::engine::Engine;
use crate::history::error::Outcome;
use crate::history::moment::Moment;
use crate::network::{ElementLaw, Network};
use crate::scene::{Drive, ElementIndex, End, Kind};
use crate::signal::Limit;
use std::cmp::Ordering;
use std::ops::Range;
use wavestep_polynomial::Rational;

/// Energy and momentum; none where they are infinite.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Held {
    pub energy: Option<Number>,
    pub momentum: Option<Number>,
}

/// What a body can do as a whole.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Drift {
    /// It flies with this mean velocity; its ends may stray from that motion after a time `t` by
    /// `stray + √(spread · t)` at most.
    Flies { velocity: Number, stray: Magnitude, spread: Magnitude },
    /// Nothing is known of its ends.
    Unknown,
}

/// Two numbers that may be infinite.
fn sum(one: Option<Number>, other: Option<Number>, bits: u64) -> Option<Number> {
    Some(one?.add(&other?, bits))
}

/// The elements of the line between two parting joints, by their places in the line.
pub(crate) fn parts(network: &Network, parted: &[usize]) -> Vec<Range<usize>> {
    let count = network.scene().line.elements.len();
    let mut parts = Vec::new();
    let mut first = 0;
    for joint in parted.iter().copied().chain([count]) {
        if joint > first {
            parts.push(first..joint);
        }
        first = first.max(joint);
    }
    parts
}

impl Engine {
    /// Energy and momentum of an element at an instant; the energy with few digits if asked for roughly.
    ///
    /// # Errors
    /// [`HistoryError::AfterLast`]; as [`Clock::compare`](crate::history::moment::Clock::compare).
    pub fn held(
        &self,
        network: &Network,
        element: ElementIndex,
        moment: &Moment,
        square: Integrand,
    ) -> Outcome<Held> {
        let elements = self.elements(network);
        let energy = self.energy_of(elements, element, (moment, Limit::Right), square)?;
        let Ok(terms) = elements.momentum(element) else {
            return Ok(Held { energy, momentum: None });
        };
        let mut momentum = Number::zero();
        for term in terms {
            let parts = self.reading(elements, &term.of, &self.clock.number(&term.coefficient)?)?;
            let value = self.sum_of(&parts, (moment, Limit::Right))?;
            momentum = momentum.add(&value, self.cut.bits);
        }
        Ok(Held { energy, momentum: Some(momentum) })
    }

    /// Energy and momentum of a part of the line.
    pub fn held_by(
        &self,
        network: &Network,
        part: &Range<usize>,
        moment: &Moment,
        square: Integrand,
    ) -> Outcome<Held> {
        let bits = self.cut.bits;
        let mut all = Held { energy: Some(Number::zero()), momentum: Some(Number::zero()) };
        for element in &network.scene().line.elements[part.clone()] {
            let held = self.held(network, *element, moment, square)?;
            all.energy = sum(all.energy, held.energy, bits);
            all.momentum = sum(all.momentum, held.momentum, bits);
        }
        Ok(all)
    }

    /// The mass of a part of the line; none where it is endless.
    pub fn mass_of(&self, network: &Network, part: &Range<usize>) -> Outcome<Option<Number>> {
        let bits = self.cut.bits;
        let mut mass = Number::zero();
        for element in &network.scene().line.elements[part.clone()] {
            let own = match self.layout.bar(*element) {
                Some(bar) => {
                    let (impedance, travel) = &self.bars[bar];
                    let Some(travel) = travel else { return Ok(None) };
                    impedance.multiply(&self.clock.number(travel)?, bits)
                }
                None => {
                    let mut all = self.nodes.iter().flat_map(|node| &node.elements);
                    match all.find(|own| own.element == *element).map(|own| &own.law) {
                        Some(ElementLaw::Mass { mass, .. }) => mass.clone(),
                        _ => Number::zero(),
                    }
                }
            };
            mass = mass.add(&own, bits);
        }
        Ok(Some(mass))
    }

    /// Whether the velocity of a place in a part of the line is imposed: at rest once that has ended.
    fn is_driven(&self, part: &[ElementIndex]) -> bool {
        let mut loads = self.nodes.iter().flat_map(|node| &node.elements);
        loads.any(|own| own.law == ElementLaw::Load(Drive::Velocity) && part.contains(&own.element))
    }

    /// Whether a part of the line cannot fly away: it has a fixed end, or a spring to the ground.
    pub fn is_grounded(&self, network: &Network, part: &Range<usize>) -> bool {
        let line = &network.scene().line;
        // A contact with the wall parts the line there.
        let touches = |joint: usize| line.joints[joint] == crate::scene::Joint::Bonded;
        let left = part.start == 0 && line.left == End::Fixed && touches(0);
        let count = line.elements.len();
        let right = part.end == count && line.right == End::Fixed && touches(count);
        let supported = line.elements[part.clone()].iter().any(|element| {
            matches!(&network.scene().elements[*element].kind, Kind::Support(support)
                if !support.stiffness.is_zero())
        });
        left || right || supported
    }

    /// The mean velocity of a part of the line: of its centre of mass, zero where it is grounded, and what
    /// it had at the start where it is endless. None where dampers hold it, and where a velocity is imposed.
    pub fn mean_velocity(
        &self,
        network: &Network,
        part: &Range<usize>,
        moment: &Moment,
    ) -> Outcome<Option<Number>> {
        let bits = self.cut.bits;
        if self.is_driven(&network.scene().line.elements[part.clone()]) {
            return Ok(None);
        }
        if self.is_grounded(network, part) {
            return Ok(Some(Number::zero()));
        }
        let bars = network.scene().line.elements[part.clone()].iter();
        for bar in bars.filter_map(|element| self.layout.bar(*element)) {
            if self.bars[bar].1.is_none() {
                let [right, left] = &self.waves[bar];
                let velocity = right.before().add(left.before(), bits);
                return Ok(Some(velocity.coefficient(0)));
            }
        }
        let Some(mass) = self.mass_of(network, part)?.filter(|mass| !mass.is_zero()) else {
            return Ok(None);
        };
        let momentum = self.held_by(network, part, moment, Integrand::ROUGH_SQUARE)?.momentum;
        let inverse = mass.reciprocal(bits)?;
        Ok(momentum.map(|momentum| momentum.multiply(&inverse, bits)))
    }

    /// How a part of the line moves on from an instant, if nothing touches it.
    ///
    /// Bound. Let `S = Σ τ/Z + Σ 1/k` be what a unit force stretches it by. By the inequality of Cauchy and
    /// Schwarz no two of its points are stretched or compressed against each other by more than
    /// `√(2 E S)`, `E` the energy of what moves against the centre of mass; of a grounded body, against the
    /// ground, with all its energy. Without loads `E` does not grow. So an end strays from the mean motion
    /// since the instant by `2 √(2 E S)` at most: once for what it is now, once for what it will be.
    pub fn drift(&self, network: &Network, part: &Range<usize>, moment: &Moment) -> Outcome<Drift> {
        let bits = self.cut.bits;
        let elements = &network.scene().line.elements[part.clone()];
        if elements.is_empty() {
            let (velocity, zero) = (Number::zero(), Magnitude::ZERO);
            return Ok(Drift::Flies { velocity, stray: zero, spread: zero });
        }
        let mut softness = Magnitude::ZERO;
        let mut endless = Vec::new();
        for element in elements {
            if let Some(bar) = self.layout.bar(*element) {
                let (impedance, travel) = &self.bars[bar];
                let Some(travel) = travel else {
                    endless.push(bar);
                    continue;
                };
                let own = self.clock.number(travel)?.multiply(&impedance.reciprocal(bits)?, bits);
                softness = softness.add(&own.magnitude());
                continue;
            }
            let node = self.layout.node_of(*element).expect("an element of a node");
            if let Some(load) = self.loads.get(element)
                && !load.has_ended(&self.clock, moment)?
            {
                return Ok(Drift::Unknown);
            }
            let mut elements = self.nodes[node].elements.iter();
            let own = elements.find(|own| own.element == *element);
            if let Some([stiffness, _]) = own.and_then(|own| own.law.resistance()) {
                if stiffness.is_zero() {
                    return Ok(Drift::Unknown);
                }
                softness = softness.add(&stiffness.reciprocal(bits)?.magnitude());
            }
        }
        match endless[..] {
            [] => {}
            [bar] => return self.drift_of_endless(network, elements, bar, &softness, moment),
            _ => return Ok(Drift::Unknown),
        }
        let grounded = self.is_grounded(network, part) || self.is_driven(elements);
        let held = self.held_by(network, part, moment, Integrand::ROUGH_SQUARE)?;
        let (Some(mut energy), Some(momentum)) = (held.energy, held.momentum) else {
            return Ok(Drift::Unknown);
        };
        let mut velocity = Number::zero();
        if !grounded {
            let Some(mass) = self.mass_of(network, part)?.filter(|mass| !mass.is_zero()) else {
                return Ok(Drift::Unknown);
            };
            velocity = momentum.multiply(&mass.reciprocal(bits)?, bits);
            let carried = momentum.multiply(&velocity, bits).over(2, bits);
            energy = energy.subtract(&carried, bits);
        }
        let stray = stray(&energy, &softness);
        Ok(Drift::Flies { velocity, stray, spread: Magnitude::ZERO })
    }

    /// A body with one endless bar. Where that bar alone is free at its end, the end moves with twice what
    /// arrives, for ever the same. Else, if it is at rest far away, all that it takes up comes from the
    /// energy `E` of the other elements: `Z ∫ w² dt ≤ E`, and by the inequality of Cauchy and Schwarz its
    /// end moves by `∫ w dt ≤ √(t E/Z)` at most.
    fn drift_of_endless(
        &self,
        network: &Network,
        elements: &[ElementIndex],
        bar: usize,
        softness: &Magnitude,
        moment: &Moment,
    ) -> Outcome<Drift> {
        let bits = self.cut.bits;
        let arriving = match self.layout.ends[bar] {
            [Some(_), None] => 1,
            [None, Some(_)] => 0,
            _ => return Ok(Drift::Unknown),
        };
        let wave = self.waves[bar][arriving].before().coefficient(0);
        let mut energy = Number::zero();
        let mut alone = true;
        for element in elements.iter().filter(|element| self.layout.bar(**element) != Some(bar)) {
            alone &= match &network.scene().elements[*element].kind {
                Kind::Spring(spring) => spring.damping.is_zero(),
                kind => matches!(kind, Kind::Hertz(_)),
            };
            let square = Integrand::ROUGH_SQUARE;
            let Some(own) = self.held(network, *element, moment, square)?.energy else {
                return Ok(Drift::Unknown);
            };
            energy = energy.add(&own, bits);
        }
        let zero = Magnitude::ZERO;
        if alone {
            let velocity = wave.add(&wave, bits);
            return Ok(Drift::Flies { velocity, stray: zero, spread: zero });
        }
        if !wave.is_zero() {
            return Ok(Drift::Unknown);
        }
        let inverse = self.bars[bar].0.reciprocal(bits)?.magnitude();
        let spread = energy.magnitude().multiply(&inverse);
        Ok(Drift::Flies { velocity: wave, stray: stray(&energy, softness), spread })
    }

    /// Whether the bodies at a contact, open or touching without force, never press on each other again:
    /// `gap + (V_R − V_L) t` less what their ends may stray stays above zero, or at zero where all of it is
    /// known exactly.
    pub fn never_meets(
        &self,
        network: &Network,
        contact: usize,
        parts: [&Range<usize>; 2],
        moment: &Moment,
    ) -> Outcome<bool> {
        let bits = self.cut.bits;
        let mut drifts = Vec::new();
        for part in parts {
            match self.drift(network, part, moment)? {
                Drift::Flies { velocity, stray, spread } => drifts.push((velocity, stray, spread)),
                Drift::Unknown => return Ok(false),
            }
        }
        let [(left, one, few), (right, other, many)] = &drifts[..] else { return Ok(false) };
        let apart = right.subtract(left, bits);
        let (stray, spread) = (one.add(other), few.add(many).scale(1));
        let gap = self.gap(contact, moment)?;
        let outward = matches!(apart.sign(), Some(Ordering::Greater | Ordering::Equal));
        if stray.is_zero() && spread.is_zero() {
            return Ok(outward && matches!(gap.sign(), Some(Ordering::Greater | Ordering::Equal)));
        }
        let number = |size: &Magnitude| Number::Exact(Rational::from(size));
        let mut room = gap.subtract(&number(&stray), bits);
        if !spread.is_zero() {
            // √(a t) + √(b t) ≤ √(2 (a + b) t), and V t − √(s t) is at least −s/(4V).
            let Ok(inverse) = apart.reciprocal(bits) else { return Ok(false) };
            let least = number(&spread).multiply(&inverse, bits).over(4, bits);
            room = room.subtract(&least, bits);
        }
        Ok(outward && room.sign() == Some(Ordering::Greater))
    }
}

/// `2 √(2 E S) = √(8 E S)`, rounded upwards.
fn stray(energy: &Number, softness: &Magnitude) -> Magnitude {
    let square = energy.magnitude().multiply(softness).scale(3);
    let root = Ball::square_root(&Rational::from(&square), 64);
    root.map_or(Magnitude::ZERO, |root| root.magnitude())
}
