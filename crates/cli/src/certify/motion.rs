//! Certificates of motions. They state the line and the times of its events; a checker follows the motion itself.

use super::drawing;
use super::writer::Writer;
use crate::failure::Failure;
use crate::progress;
use num_rational::BigRational;
use num_traits::ToPrimitive as _;
use serde_json::{Map, Value as Json, json};
use std::borrow::Cow;
use std::collections::BTreeSet;
use wavestep::ball::{Bound, Decimal, Number};
use wavestep::enclosure::Numbers;
use wavestep::expression::{Expression, Fraction, PI, Root};
use wavestep::history::{Event, EventKind};
use wavestep::network::{Contacts, ElementLaw, Layout, Lumped, Network, Node, Side};
use wavestep::problem::{Problem, ProblemError, constants_of};
use wavestep::signal::EvaluateError;
use wavestep_polynomial::Symbol;

/// Bits and digits beyond those asked for: errors grow from event to event.
const SPARE_BITS: f64 = 96.0;
const SPARE_DIGITS: usize = 6;

/// Bits beyond those asked for below which a Taylor polynomial leaves out what follows.
const SPARE_BITS_OF_TERMS: f64 = 24.0;

/// By how much the radius of a wave grows at most where it is reflected: what leaves is the velocity, which may be twice what
/// arrives, less what arrives.
const MOST_GROWTH: f64 = 3.0;

/// The least digits of the time of an event: its interval is within a step.
const LEAST_DIGITS: usize = 9;

/// The most bits and terms that a checker works with.
const MOST_BITS: f64 = 4096.0;
const MOST_TERMS: u32 = 400;

/// The largest numerator and denominator of an exponent.
const MOST_POWER: u32 = 1000;
const MOST_ROOT: u32 = 100;

/// The most steps of a checker in a window.
const MOST_STEPS: f64 = 2000.0;

/// Closings, openings and releases before the end of a window.
pub fn events(
    problem: &Problem,
    [from, to]: &[BigRational; 2],
    digits: usize,
) -> Result<Map<String, Json>, Failure> {
    if *from != BigRational::default() {
        let message = "events are certified from the start on";
        return Err(Failure::usage(message, "leave --from out"));
    }
    let line = Line::of(problem, Contacts::Links, None)?;
    if line.layout.contacts.is_empty() {
        return Err(Failure::usage("the line has no contacts", "write | where bodies touch"));
    }
    if line.network.local_contact().is_some() {
        let message = "there are no certificates of the events of local contacts";
        return Err(Failure::usage(message, "certify the zeros of their compression, with --zero"));
    }
    let precision = line.precision(to, digits)?;
    let [low, high] = line.in_units(to, precision.bits)?;
    let end =
        if low == high { low } else { Decimal::bound(&low, digits, Bound::Lower).to_rational() };
    let mut writer = Writer::default();
    let mut document = line.document([&end, to], digits, precision.bits, &mut writer)?;
    document.extend(line.followed(&end, &precision, &writer));
    document.insert("kind".into(), json!("events"));
    Ok(document)
}

fn refused(reason: &str) -> Failure {
    let message = format!("there are no certificates of motions {reason}");
    Failure::usage(message, "see them with `wavestep events` and `wavestep eval`")
}

/// How a checker follows a line: steps no longer than the fastest decay, the terms of Taylor polynomials on these, and
/// the bits of their coefficients.
pub struct Precision {
    pub step: BigRational,
    terms: u32,
    pub bits: u64,
}

impl Precision {
    /// Enough for two lines.
    pub fn for_both(self, other: Precision) -> Precision {
        Precision {
            step: self.step.min(other.step),
            terms: self.terms.max(other.terms),
            bits: self.bits.max(other.bits),
        }
    }
}

/// A line with numbers, as it moves.
pub struct Line<'a> {
    problem: &'a Problem,
    pub network: Cow<'a, Network>,
    layout: Layout,
    numbers: Numbers,
}

impl<'a> Line<'a> {
    /// The line of a scene, in its own units or in those of another line; its contacts open and close, or are joints.
    pub fn of(
        problem: &'a Problem,
        contacts: Contacts,
        beside: Option<&Line<'_>>,
    ) -> Result<Line<'a>, Failure> {
        let network = problem.network()?;
        super::refuse_symbols(problem)?;
        let network = match beside {
            None => Cow::Borrowed(network),
            Some(other) => {
                Cow::Owned(other.network.beside(network.scene()).map_err(ProblemError::from)?)
            }
        };
        let layout = Layout::of(network.scene(), network.model(), contacts);
        let numbers = Numbers::new(&network.model().constants);
        let line = Line { problem, network, layout, numbers };
        line.refuse_loads()?;
        line.refuse_exponents()?;
        Ok(line)
    }

    /// What is claimed of a motion: the line, and what its contacts do until an end, which is at most `until` in the user's unit.
    pub fn document(
        &self,
        [end, until]: [&BigRational; 2],
        digits: usize,
        bits: u64,
        writer: &mut Writer,
    ) -> Result<Map<String, Json>, Failure> {
        let mut events = Vec::new();
        if !self.layout.contacts.is_empty() {
            let _waiting = progress::spinner("following contacts");
            let history = self.problem.history(Some(until), digits + SPARE_DIGITS)?;
            if let Some(assumed) = history.assumptions.first() {
                let message = format!("events of this scene rest on an assumption: {assumed}");
                return Err(Failure::usage(message, "ask for an earlier time"));
            }
            let drawn = self.drawn_contacts();
            for event in &history.events {
                if let Some(number) = drawn.iter().position(|contact| *contact == event.contact) {
                    events.extend(self.told(event, number, (end, digits, bits))?);
                }
            }
        }
        let mut document = Map::new();
        let mut insert = |key: &str, value: Json| document.insert(key.into(), value);
        insert("title", json!(self.problem.title()));
        insert("constants", json!(constants_of(&self.network, None)?));
        insert("time", json!(self.network.scene().time.name()));
        insert("line", drawing::moving(&self.network, &self.layout, writer));
        insert("events", json!(events));
        Ok(document)
    }

    /// Until when and how a checker follows all that was written, and the numbers in it, which are those of this line.
    pub fn followed(
        &self,
        end: &BigRational,
        precision: &Precision,
        writer: &Writer,
    ) -> Map<String, Json> {
        let claims = json!({
            "numbers": self.told_numbers(&writer.others, precision.bits),
            "roots": writer.told_roots(),
            "to": end.to_string(),
            "step": precision.step.to_string(),
            "terms": precision.terms,
            "bits": precision.bits,
        });
        let Json::Object(claims) = claims else { unreachable!("claims have names") };
        claims
    }

    /// How a checker follows the line until a time in the user's unit.
    pub fn precision(&self, to: &BigRational, digits: usize) -> Result<Precision, Failure> {
        let [to, _] = self.in_units(to, 64)?;
        let to = to.to_f64().unwrap_or(f64::INFINITY);
        let size = |value: &Fraction| self.size(value);
        let shortest = self.travels().map(size).fold(to, f64::min);
        let mut rate = self.layout.nodes.iter().map(|node| self.rate(node)).fold(0.0, f64::max);
        // The terms of t^n exp(rate t) begin to fall n later.
        let mut power = 0;
        let time = &self.network.scene().time;
        let courses = self.network.model().loads.values().map(|load| &load.course);
        for (exponent, factor) in courses.flat_map(Expression::terms) {
            rate = rate.max(self.size(&exponent.derivative(time)));
            power = power.max(factor.numerator().degree(time));
        }
        // A power of two, at most the time of the fastest decay.
        let exponent = shortest.min(1.0 / rate).log2().floor();
        let step = exponent.exp2();
        if !(to / step < MOST_STEPS && exponent.abs() < 64.0) {
            let message =
                format!("a checker would need {:.0} steps (limit {MOST_STEPS})", to / step);
            return Err(Failure::usage(message, "end the window earlier, with --to"));
        }
        let two = BigRational::from_integer(2.into());
        let step = two.pow(exponent as i32);
        // Radii grow as exp(√2 rate t) at most, and with each passage. What a Taylor polynomial leaves out is below 2^n/n!, and
        // nothing where nothing has a rate. Beside a local contact, where terms fall only like powers, it has to be below the last bit.
        let asked = 3.4 * digits as f64;
        let lost = 2.1 * rate * to + to * self.bits_of_passages();
        let bits = SPARE_BITS + asked + lost;
        let is_local = self.network.local_contact().is_some();
        let wanted = match is_local {
            true => bits,
            false if rate == 0.0 => SPARE_BITS_OF_TERMS + asked,
            false => SPARE_BITS_OF_TERMS + asked + lost,
        };
        let (mut terms, mut factorial) = (4_u32, 0.0);
        while factorial < wanted && terms <= MOST_TERMS {
            terms += 1;
            factorial += f64::from(terms).log2() - 1.0;
        }
        terms += power;
        if is_local {
            terms = terms.max((bits / 3.0) as u32);
        }
        if bits > MOST_BITS {
            let message = format!("a checker would need {bits:.0} bits (limit {MOST_BITS})");
            return Err(Failure::usage(message, "ask for fewer digits, or end earlier"));
        }
        if terms > MOST_TERMS {
            let message = format!("a checker would need more than {MOST_TERMS} terms");
            return Err(Failure::usage(message, "end earlier"));
        }
        Ok(Precision { step, terms, bits: bits as u64 })
    }

    /// About how large a number of the line is, which may be complex.
    fn size(&self, value: &Fraction) -> f64 {
        let ball = self.numbers.enclose_complex(&value.clone().into(), 64);
        ball.map_or(0.0, |ball| {
            let [x, y] = [ball.real(), ball.imaginary()].map(|part| part.midpoint().to_double());
            x.hypot(y)
        })
    }

    fn travels(&self) -> impl Iterator<Item = &Fraction> {
        self.network.model().bars.values().filter_map(|bar| bar.travel.as_ref())
    }

    /// About how many bits a wave loses per unit of time: on the way there and back along the bar where it loses most.
    fn bits_of_passages(&self) -> f64 {
        let bars = self.layout.bars.iter().zip(&self.layout.ends);
        let bits = bars.filter_map(|(bar, ends)| {
            let travel = self.size(self.network.model().bars[bar].travel.as_ref()?);
            let nodes = ends.iter().flatten().map(|node| &self.layout.nodes[*node]);
            Some(nodes.map(|node| self.passage(node, travel)).sum::<f64>() / (2.0 * travel))
        });
        bits.fold(0.0, f64::max)
    }

    /// How many bits a wave loses at a node; none at a wall. A mass takes fewer, the less its velocity changes in a travel time.
    fn passage(&self, node: &Node<Fraction>, travel: f64) -> f64 {
        let is_bare = node.elements.is_empty() && node.links.is_empty();
        if is_bare && [node.left, node.right].contains(&Side::Fixed) {
            return 0.0;
        }
        let mass = node.elements.iter().fold(0.0, |sum, own| match &own.law {
            ElementLaw::Mass { mass, .. } => sum + self.size(mass),
            _ => sum,
        });
        let impedance: f64 = node.impedance.iter().map(|own| self.size(own)).sum();
        let exponent = impedance * travel / mass;
        if exponent > 1.0 || mass == 0.0 || !node.links.is_empty() {
            return MOST_GROWTH.log2();
        }
        // The larger eigenvalue of what the radii of the velocity and of the wave become.
        let half = (3.0 * exponent.exp() - 1.0) / 2.0;
        (half + (half * half - exponent.exp()).sqrt()).min(MOST_GROWTH).log2()
    }

    /// About how fast anything at a node changes: impedances and dampers over the least mass, stiffness over what damps it,
    /// and the fastest oscillation.
    fn rate(&self, node: &Node<Fraction>) -> f64 {
        let size = |value: &Fraction| self.size(value);
        let (mut damping, mut stiffness, mut mass) = (0.0, 0.0, f64::INFINITY);
        let mut damps: f64 = f64::INFINITY;
        for impedance in node.impedance.iter().map(size).filter(|own| *own > 0.0) {
            (damping, damps) = (damping + impedance, damps.min(impedance));
        }
        for element in &node.elements {
            if let ElementLaw::Mass { mass: own, .. } = &element.law {
                mass = mass.min(size(own));
            }
            if let Some([own, damper]) = element.law.resistance() {
                let damper = size(damper);
                stiffness += size(own);
                damping += damper;
                damps = if damper > 0.0 { damps.min(damper) } else { damps };
            }
            if let ElementLaw::LocalContact { force, compression, exponent } = &element.law {
                let exponent = exponent.to_f64().unwrap_or(f64::INFINITY);
                stiffness += self.steepest(size(force), size(compression), exponent);
            }
        }
        damping / mass + (stiffness / mass).sqrt() + stiffness / damps
    }

    /// About how stiff a local contact gets: under the forces with which bars at speed meet a wall, and the energy of masses.
    fn steepest(&self, force: f64, compression: f64, exponent: f64) -> f64 {
        let size = |value: &Fraction| self.size(value);
        let bars = self.network.model().bars.values();
        let mut most: f64 = bars.map(|bar| size(&bar.impedance) * size(&bar.velocity)).sum();
        let elements = self.layout.nodes.iter().flat_map(|node| &node.elements);
        let energy = |own: &Lumped<Fraction>| match &own.law {
            ElementLaw::Mass { mass, velocity } => size(mass) * size(velocity).powi(2) / 2.0,
            _ => 0.0,
        };
        let held = elements.map(energy).sum::<f64>() * (exponent + 1.0) / (force * compression);
        most += force * held.powf(exponent / (exponent + 1.0));
        exponent * most / (compression * (most / force).powf(1.0 / exponent))
    }

    /// Loads are of numbers that are known, and impose no velocity on a mass, which may jump there.
    fn refuse_loads(&self) -> Result<(), Failure> {
        let is_mass = |own: &Lumped<Fraction>| matches!(own.law, ElementLaw::Mass { .. });
        let is_imposed = |node: &Node<Fraction>, own: &Lumped<Fraction>| {
            is_mass(own) && node.imposing(own.run).next().is_some()
        };
        let mut nodes = self.layout.nodes.iter();
        if nodes.any(|node| node.elements.iter().any(|own| is_imposed(node, own))) {
            return Err(refused("in which the velocity of a mass is imposed"));
        }
        let time = &self.network.scene().time;
        let is_other = |own: &Symbol| {
            own != time && own.square().is_none() && self.numbers.value(own, 64).is_none()
        };
        for load in self.network.model().loads.values() {
            if let Some(symbol) = load.course.symbols().into_iter().find(is_other) {
                return Err(refused(&format!("under loads that hold the number {symbol}")));
            }
        }
        Ok(())
    }

    /// The force of a local contact needs a bounded slope, so that a motion is the only one; checkers draw roots of its powers.
    fn refuse_exponents(&self) -> Result<(), Failure> {
        let exponents =
            self.layout.nodes.iter().flat_map(|node| &node.elements).filter_map(|own| {
                match &own.law {
                    ElementLaw::LocalContact { exponent, .. } => Some(exponent),
                    _ => None,
                }
            });
        for exponent in exponents {
            if exponent.numer() < exponent.denom() {
                return Err(refused("beside a local contact with an exponent below 1"));
            }
            if *exponent.numer() > MOST_POWER.into() || *exponent.denom() > MOST_ROOT.into() {
                return Err(refused(&format!(
                    "beside a local contact with the exponent {exponent}: its numerator may be {MOST_POWER}, its denominator {MOST_ROOT}"
                )));
            }
        }
        Ok(())
    }

    /// A time in the unit of the line, between two numbers.
    pub fn in_units(&self, time: &BigRational, bits: u64) -> Result<[BigRational; 2], Failure> {
        self.scaled(&Number::of_rational(time.clone(), bits), bits)
    }

    /// The number that a unit is.
    pub fn unit(&self, unit: &Root, bits: u64) -> Result<Number, Failure> {
        Ok(match unit.exact().and_then(|unit| unit.as_constant()) {
            Some(unit) => Number::Exact(unit),
            None => {
                let unit = self.numbers.enclose_root(unit, bits);
                Number::Enclosed(unit.map_err(EvaluateError::from)?)
            }
        })
    }

    fn scaled(&self, time: &Number, bits: u64) -> Result<[BigRational; 2], Failure> {
        let unit = self.unit(&self.network.model().scale.time, bits)?;
        let scaled = time.multiply(&unit.reciprocal(bits).map_err(EvaluateError::from)?, bits);
        Ok(wavestep::Value::of(&scaled, 1).bounds())
    }

    /// The contacts that a checker counts: local ones are elements.
    fn drawn_contacts(&self) -> Vec<usize> {
        let nodes = self.layout.nodes.iter();
        let all = nodes.flat_map(|node| node.contacts().map(move |(contact, _)| (node, contact)));
        all.filter(|(node, own)| node.local_contact(*own).is_none()).map(|(_, own)| own).collect()
    }

    /// `[contact, kind, low, high]`, with times in the units of the line, of what happens before the end.
    fn told(
        &self,
        event: &Event,
        contact: usize,
        (end, digits, bits): (&BigRational, usize, u64),
    ) -> Result<Option<Json>, Failure> {
        let time = match event.time.exact() {
            Some(time) => Number::Exact(time.clone()),
            None => Number::Enclosed(event.time.ball(bits)),
        };
        let [low, high] = self.scaled(&time, bits)?;
        if high >= *end {
            return Ok(None);
        }
        let digits = digits.max(LEAST_DIGITS);
        // Wider, so that what a checker finds fits inside.
        let room = match low == high {
            true => BigRational::default(),
            false => &high / BigRational::from_integer(10.into()).pow(digits as i32),
        };
        let [low, high] = written([low - &room, high + room], digits + 1);
        let kind = match event.kind {
            EventKind::Impact | EventKind::Closing => "closing",
            EventKind::Opening => "opening",
            EventKind::Release => "release",
        };
        Ok(Some(json!([contact, kind, low, high])))
    }

    /// `{symbol: [low, high], …}`.
    fn told_numbers(&self, symbols: &BTreeSet<Symbol>, bits: u64) -> Json {
        let others = symbols.iter().filter(|symbol| symbol.name() != PI);
        let numbers = others.filter_map(|symbol| {
            let bounds = self.numbers.value(symbol, bits)?.bounds();
            Some((symbol.to_string(), json!(written(bounds, bits as usize / 3))))
        });
        Json::Object(numbers.collect())
    }
}

/// The ends of an interval, exactly where they are one number, else as decimals around it.
pub fn written([low, high]: [BigRational; 2], digits: usize) -> [String; 2] {
    if low == high {
        return [low.to_string(), high.to_string()];
    }
    let end = |value, bound| Decimal::bound(value, digits, bound).to_string();
    [end(&low, Bound::Lower), end(&high, Bound::Upper)]
}
