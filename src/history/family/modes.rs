//! The first modes of a scene for all values of a symbol between two.

use super::exponential::Exponential;
use super::on_step::OnStep;
use super::{NotOverSymbol, Outcome, Over};
use crate::ball::{Arithmetic as _, Ball, BallError, Magnitude};
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::model::line::Bar;
use crate::model::mode::{Chain, Sum};
use crate::model::shape::{Part, Shape, Swinging, frequencies};
use crate::network::{MeasuredValue, Node, Term};
use crate::signal::Varying;
use num_traits::Signed as _;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// Newton's method squares an error, and numbers that vary have seven powers: three times is enough, and one for roundings.
const CORRECTIONS: usize = 4;

/// Corrections lead elsewhere where they go as far as one in so many.
const NEAR: i64 = 1 << 20;

/// How often an enclosure of a frequency is widened where it does not prove itself.
const WIDENINGS: usize = 3;

impl Swinging for Varying {
    fn cos_sin(&self, bits: u64) -> Result<[Varying; 2], BallError> {
        Varying::exp([&Varying::zero(), self], bits)
    }
}

/// What is observed, as a sum of modes, in the scale of the scene and the unit of the user.
pub struct Modes(Sum<Varying>);

impl Modes {
    /// How fast they swing in a unit of time at most.
    pub fn rate(&self) -> Magnitude {
        let rates = self.0.waves.iter().map(|[frequency, ..]| frequency.magnitude());
        rates.max().unwrap_or(Magnitude::ZERO)
    }

    /// The sum on the first steps of this length.
    ///
    /// # Errors
    /// [`NotOverSymbol::Ball`] where a frequency varies too much.
    pub fn on_steps(&self, count: usize, length: &Varying) -> Outcome<Vec<OnStep>> {
        let Sum { drift: [constant, slope], waves } = &self.0;
        let none = Varying::zero;
        let slope = slope.multiply(length, BITS);
        let drift = vec![[constant.clone(), none()], [slope, none()]];
        // a cos ωt + b sin ωt is the real part of (a − ib) e^(iωt).
        let wave = |[frequency, a, b]: &[Varying; 3]| Exponential {
            rate: [none(), frequency.multiply(length, BITS)],
            polynomial: vec![[a.clone(), b.negate()]],
        };
        let drift = Exponential { rate: [none(), none()], polynomial: drift };
        let all: Vec<Exponential> = std::iter::once(drift).chain(waves.iter().map(wave)).collect();
        Exponential::total(&all, count)
    }
}

impl Over<'_> {
    /// The first modes, which are those for each value of the symbol: a frequency that is the n-th for one value is it for
    /// all, since frequencies of a line are never equal.
    ///
    /// # Errors
    /// [`NotOverSymbol::Modes`] for what has none; [`NotOverSymbol::Ball`] where a frequency varies too much.
    pub fn modes(&self, count: usize) -> Outcome<Modes> {
        let value = |value: &_| self.symbol.fraction(value).map_err(NotOverSymbol::from);
        let MeasuredValue::Linear(terms) = &self.measured.value else {
            return Err(NotOverSymbol::Modes);
        };
        let layout = &self.scaled.layout;
        let bars = Bar::all(self.scaled, layout, value)?;
        let nodes = layout.nodes.iter().map(|node| node.map(value));
        let nodes = nodes.collect::<Outcome<Vec<Node<Varying>>>>()?;
        let chain = Chain { bars: &bars, nodes: &nodes, bits: BITS };
        let parts = chain.parts(|_| String::new()).map_err(|_| NotOverSymbol::Modes)?;
        let held = chain.held();
        let middle = |own: &Varying| own.coefficient(0).midpoint().to_double();
        let doubles: Vec<Part> = parts.iter().map(|part| part.map(middle)).collect();
        let mut modes = Vec::with_capacity(count);
        for near in frequencies(&doubles, held, chain.drifts(), count) {
            let frequency = near.map(|near| frequency(&parts, held, near)).transpose()?;
            modes.push(chain.mode(Shape::of(&parts, held[0], frequency, BITS)?)?);
        }
        let unit = self.symbol.root(&self.measured.unit)?;
        let term = |own: &Term| {
            let own = own.map(value)?;
            Ok(Term { coefficient: own.coefficient.multiply(&unit, BITS), ..own })
        };
        let terms = terms.iter().map(term).collect::<Outcome<Vec<Term<Varying>>>>()?;
        Ok(Modes(chain.sum(&terms, &modes)?.ok_or(NotOverSymbol::Modes)?))
    }
}

/// An enclosure of the frequency that is near a double at the middle of the values.
///
/// What is to vanish at the right end, `u` or `S`, has one sign at one end of the enclosure and the other at the other, so it
/// vanishes between; and since the angle of Prüfer rises, the other of the two vanishes once between two such
/// frequencies. It vanishes nowhere in the enclosure, so there is but one.
///
/// # Errors
/// [`NotOverSymbol::Ball`] where it varies too much.
pub fn frequency(parts: &[Part<Varying>], held: [bool; 2], near: f64) -> Outcome<Varying> {
    let shape = |frequency: &Varying| Shape::of(parts, held[0], Some(frequency.clone()), BITS);
    let correction = |frequency: &Varying| {
        let correction = shape(frequency)?.correction(held[1], BITS)?;
        Ok::<_, BallError>(correction.expect("it swings"))
    };
    let near = Rational::from_float(near).ok_or(BallError::ArgumentTooLarge)?;
    let mut frequency = Varying::constant(&near, BITS);
    for _ in 0..CORRECTIONS {
        frequency = frequency.add(&correction(&frequency)?, BITS).split().0;
    }
    let [first, now] = [&near, &Rational::from(frequency.coefficient(0).midpoint())];
    if (now - first).abs() * Rational::from_integer(NEAR.into()) > *first {
        return Err(BallError::DivisorMayBeZero.into());
    }
    let (vanishing, other) = if held[1] { (0, 1) } else { (1, 0) };
    let mut width = correction(&frequency)?.magnitude().scale(1);
    for _ in 0..WIDENINGS {
        let away: Varying = Ball::new(width.to_binary(), Magnitude::ZERO).into();
        let sign = |frequency: &Varying, of: usize| -> Result<Option<Ordering>, BallError> {
            Ok(shape(frequency)?.left_of(parts.len())[of].range().sign())
        };
        let signs = [
            sign(&frequency.subtract(&away, BITS), vanishing)?,
            sign(&frequency.add(&away, BITS), vanishing)?,
        ];
        let mut enclosure = frequency.clone();
        enclosure.remainder = enclosure.remainder.add(&width);
        let rises = [Ordering::Less, Ordering::Greater].map(Some);
        let falls = [Ordering::Greater, Ordering::Less].map(Some);
        if (signs == rises || signs == falls) && sign(&enclosure, other)?.is_some() {
            return Ok(enclosure);
        }
        width = width.scale(2);
    }
    Err(BallError::DivisorMayBeZero.into())
}
