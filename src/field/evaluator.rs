//! From the two waves of a bar to the fields in it.
//!
//! With the delays `a(x)` and `b(x)` of the waves `f` (to the right) and `g` (to the left), and with
//! `F = ∫f dt`, `G = ∫g dt`,
//!
//! ```text
//! v = V + f(t − a) + g(t − b)        X = X_0 + Z (f(t − a) − g(t − b))
//! u = V t + F(t − a) + G(t − b)      ε = −X/(EA)
//! ```
//!
//! The mean of `f(t − a)` over a cell, on which `a` grows evenly from `a_0` to `a_1`, is
//! `(F(t − a_0) − F(t − a_1))/(a_1 − a_0)`: an integral over time, so averages need no quadrature. That
//! of `F(t − a)` follows in the same way from `∫F dt`.

use super::fields::{BarFields, Bounded, Fields};
use super::wave::{Entering, Heading, Instant, Order, Waves};
use super::{FIRST_BITS, FieldError, MAX_BITS, Mesh, Sampling};
use crate::ball::{Attempt, Ball, Magnitude, Precisions};
use crate::expression::{Fraction, Root};
use crate::network::{Extent, FieldBar, Network};
use crate::scene::Kind;
use crate::signal::{EvaluateError, Limit};
use wavestep_polynomial::Rational;

/// Radii so far below the largest value need no more bits: a double has 53.
const SPARE_BITS: i64 = 75;

/// Radii below this size in the scale of the scene need no more bits either.
const NEGLIGIBLE_BITS: i64 = 400;

/// The fields of a scene in numbers, up to a last time.
pub struct FieldEvaluator<'a> {
    network: &'a Network,
    pub(super) bars: &'a [FieldBar],
    pub(super) waves: Waves<'a>,
    pub(super) last: Rational,
    /// The length of endless bars in pictures.
    pub(super) reach: Option<Rational>,
}

/// The delays of a point of a mesh, in the scale of the scene, and the side it is seen from.
pub(super) struct MeshPoint {
    /// The delay of the wave to the right and of that to the left.
    pub delays: [Fraction; 2],
    /// Whether limits are taken from larger `x`.
    pub from_larger: bool,
    /// Whether a front beside it is meant; see [`Instant`].
    pub is_drawn: bool,
}

/// The enclosures of the fields at a place, in the scale of the scene, and the size of what they are
/// made of.
pub(super) type Enclosed = ([Ball; 3], Magnitude);

/// The delays of the waves to the right and to the left at a place of a bar, which is given by its own
/// delay from the end where `x` is zero.
pub(super) fn delays(bar: &FieldBar, span: &Fraction, place: Fraction) -> [Fraction; 2] {
    match bar.extent {
        Extent::Finite => [place.clone(), span - &place],
        Extent::ToTheRight => [place, Fraction::zero()],
        Extent::ToTheLeft => [Fraction::zero(), place],
    }
}

impl<'a> FieldEvaluator<'a> {
    /// For times up to `last`.
    pub fn new(network: &'a Network, last: &Rational) -> Result<FieldEvaluator<'a>, FieldError> {
        if *last < Rational::default() {
            return Err(FieldError::Negative(last.clone()));
        }
        Ok(FieldEvaluator {
            waves: Waves::new(network, last)?,
            bars: &network.field_bars()?.bars,
            network,
            last: last.clone(),
            reach: None,
        })
    }

    /// The same, with this length of endless bars in pictures: in [`waves`](Self::waves) and
    /// [`profiles`](Self::profiles).
    pub fn looking(self, reach: &Rational) -> Result<FieldEvaluator<'a>, FieldError> {
        match *reach > Rational::default() {
            true => Ok(FieldEvaluator { reach: Some(reach.clone()), ..self }),
            false => Err(FieldError::NegativeReach(reach.clone())),
        }
    }

    /// The names of the bars, from left to right.
    pub fn bars(&self) -> impl Iterator<Item = &str> + '_ {
        self.bars.iter().map(|bar| self.name(bar))
    }

    /// The scene.
    pub fn network(&self) -> &'a Network {
        self.network
    }

    pub(super) fn name(&self, bar: &FieldBar) -> &str {
        &self.network.scene().elements[bar.element].name
    }

    /// The fields at a time.
    pub fn at(&self, time: &Rational, mesh: &Mesh) -> Result<Fields, FieldError> {
        if *time < Rational::default() {
            return Err(FieldError::Negative(time.clone()));
        }
        if *time > self.last {
            return Err(EvaluateError::AfterLast.into());
        }
        for name in &mesh.bars {
            if !self.bars().any(|bar| bar == name) {
                let bars = self.bars().map(str::to_owned).collect();
                return Err(FieldError::UnknownBar { name: name.clone(), bars });
            }
        }
        let wanted = |(_, bar): &(usize, &FieldBar)| {
            mesh.bars.is_empty() || mesh.bars.iter().any(|name| name == self.name(bar))
        };
        let fields = |(place, _)| self.fields_of(place, time, mesh);
        Ok(Fields {
            time: time.clone(),
            dimensional: self.network.scene().dimensional,
            sampling: mesh.sampling,
            side: mesh.limit,
            bars: self
                .bars
                .iter()
                .enumerate()
                .filter(wanted)
                .map(fields)
                .collect::<Result<_, _>>()?,
        })
    }

    fn fields_of(
        &self,
        bar_place: usize,
        time: &Rational,
        mesh: &Mesh,
    ) -> Result<BarFields, FieldError> {
        let bar = &self.bars[bar_place];
        let at = self.network.scaled_time(time);
        let (span, length) = self.span(bar, &at, mesh.reach.as_ref())?;
        let name = self.name(bar).to_owned();
        if span.is_zero() {
            // No wave has entered an endless bar.
            return Ok(BarFields { name, x: Vec::new(), values: Default::default() });
        }
        let share = |j: usize| Rational::new(j.into(), mesh.cells.into());
        let points: Vec<MeshPoint> = (0..=mesh.cells)
            .map(|j| {
                let delays = delays(bar, &span, span.scale(&share(j)));
                let inside = mesh.limit == Limit::Right && j < mesh.cells;
                MeshPoint { delays, from_larger: inside || j == 0, is_drawn: false }
            })
            .collect();
        let length = self.waves.numbers.enclose_root(&length, FIRST_BITS)?;
        let place = |j| length.multiply_rational(&share(j), FIRST_BITS).to_double().0;
        let x = (0..=mesh.cells).map(place).collect();
        let (found, bits) = self.fine(|bits| match mesh.sampling {
            Sampling::Nodes => self.at_points(bar_place, &at, &points, bits),
            Sampling::Averages => self.averages(bar_place, &at, &points, bits),
        })?;
        Ok(BarFields { name, x, values: self.in_units(bar, &found, bits)? })
    }

    /// Enclosures that are fine enough for doubles, or the best there are; with their precision.
    pub(super) fn fine(
        &self,
        enclose: impl Fn(u64) -> Result<Vec<Enclosed>, FieldError>,
    ) -> Result<(Vec<Enclosed>, u64), FieldError> {
        let attempt = |bits| {
            let found = enclose(bits)?;
            let fine = is_fine(&found);
            Ok::<_, FieldError>(Attempt::of((found, bits), fine))
        };
        Precisions::doubling(FIRST_BITS, MAX_BITS).raise(attempt).map(Attempt::best)
    }

    /// The length of a bar that has fields, as a delay in the scale of the scene and in the user's unit.
    pub(super) fn span(
        &self,
        bar: &FieldBar,
        at: &Fraction,
        reach: Option<&Rational>,
    ) -> Result<(Fraction, Root), FieldError> {
        let Kind::Bar(data) = &self.network.scene().elements[bar.element].kind else {
            unreachable!("a bar of the line")
        };
        if let (Some(travel), Some(extent)) = (&bar.data.travel, data.extent()) {
            return Ok((travel.clone(), Root::from(extent.clone())));
        }
        let Some(reach) = reach else {
            return Ok((at.clone(), bar.reach.times(&Root::from(at.clone()))));
        };
        let reach = Root::from(Fraction::constant(reach));
        let delay = reach.over(&bar.reach).map_err(EvaluateError::Division)?;
        // An irrational delay is rounded, and the length is that of the rounded delay.
        let delay = match delay.exact().filter(|delay| delay.as_constant().is_some()) {
            Some(delay) => delay,
            None => {
                let ball = self.waves.numbers.enclose_root(&delay, FIRST_BITS)?;
                Fraction::constant(&Rational::from(ball.midpoint()))
            }
        };
        let length = bar.reach.times(&Root::from(delay.clone()));
        Ok((delay, length))
    }

    /// A wave at a point.
    fn wave_at(
        &self,
        wave: Entering,
        order: Order,
        (at, point, side): (&Fraction, &MeshPoint, Limit),
        bits: u64,
    ) -> Result<Ball, FieldError> {
        let at = at - &point.delays[wave.heading as usize];
        let instant = Instant { at: &at, side, is_drawn: point.is_drawn };
        self.waves.value(wave, order, instant, bits)
    }

    pub(super) fn at_points(
        &self,
        bar: usize,
        at: &Fraction,
        points: &[MeshPoint],
        bits: u64,
    ) -> Result<Vec<Enclosed>, FieldError> {
        let state = State::new(self, &self.bars[bar], at, bits)?;
        let mut found = Vec::with_capacity(points.len());
        for point in points {
            let wave = |heading: Heading, order| {
                // A delay that grows with x looks back in time as x grows.
                let grows = heading == Heading::Right || self.bars[bar].extent == Extent::ToTheLeft;
                let side = if grows == point.from_larger { Limit::Left } else { Limit::Right };
                self.wave_at(Entering { bar, heading }, order, (at, point, side), bits)
            };
            let both = |order| -> Result<[Ball; 2], FieldError> {
                Ok([wave(Heading::Right, order)?, wave(Heading::Left, order)?])
            };
            found.push(state.fields(&both(Order::Value)?, &both(Order::Integral)?, bits));
        }
        Ok(found)
    }

    fn averages(
        &self,
        bar: usize,
        at: &Fraction,
        points: &[MeshPoint],
        bits: u64,
    ) -> Result<Vec<Enclosed>, FieldError> {
        let state = State::new(self, &self.bars[bar], at, bits)?;
        let mut means: [[Vec<Ball>; 2]; 2] = Default::default();
        for heading in [Heading::Right, Heading::Left] {
            let which = heading as usize;
            let width = &points[1].delays[which] - &points[0].delays[which];
            let inverse = match width.is_zero() {
                true => Ball::zero(),
                false => {
                    let width = self.waves.numbers.enclose(&width, bits)?;
                    width.reciprocal(bits).map_err(EvaluateError::Ball)?
                }
            };
            for (place, order) in [Order::Integral, Order::DoubleIntegral].into_iter().enumerate() {
                // Integrals are continuous, so the side does not matter.
                let at = |point| {
                    self.wave_at(Entering { bar, heading }, order, (at, point, Limit::Right), bits)
                };
                let integrals: Vec<Ball> = points.iter().map(at).collect::<Result<_, _>>()?;
                let mean =
                    |pair: &[Ball]| pair[0].subtract(&pair[1], bits).multiply(&inverse, bits);
                means[which][place] = integrals.windows(2).map(mean).collect();
            }
        }
        let mean = |order: usize, i: usize| means.each_ref().map(|both| both[order][i].clone());
        let cells = 0..points.len() - 1;
        Ok(cells.map(|i| state.fields(&mean(0, i), &mean(1, i), bits)).collect())
    }

    /// Values in the user's units: velocity, strain, displacement, force.
    pub(super) fn in_units(
        &self,
        bar: &FieldBar,
        found: &[Enclosed],
        bits: u64,
    ) -> Result<[Vec<Bounded>; 4], FieldError> {
        let mut values: [Vec<Bounded>; 4] = Default::default();
        for (place, unit) in bar.units.iter().enumerate() {
            let unit = self.waves.numbers.enclose_root(unit, bits)?;
            values[place] = found
                .iter()
                .map(|([velocity, force, displacement], _)| match place {
                    0 => velocity.multiply(&unit, bits),
                    1 => force.clone().negate().multiply(&unit, bits),
                    2 => displacement.multiply(&unit, bits),
                    _ => force.multiply(&unit, bits),
                })
                .map(|ball| bounded(&ball))
                .collect();
        }
        Ok(values)
    }
}

/// The state of a bar at the start, to which its waves are added.
struct State {
    velocity: Ball,
    force: Ball,
    impedance: Ball,
    /// `V t`.
    displacement: Ball,
}

impl State {
    fn new(
        evaluator: &FieldEvaluator<'_>,
        bar: &FieldBar,
        at: &Fraction,
        bits: u64,
    ) -> Result<State, FieldError> {
        let enclose = |value: &Fraction| evaluator.waves.numbers.enclose(value, bits);
        let velocity = enclose(&bar.data.velocity)?;
        let displacement = velocity.multiply(&enclose(at)?, bits);
        let (force, impedance) = (enclose(&bar.data.force)?, enclose(&bar.data.impedance)?);
        Ok(State { velocity, force, impedance, displacement })
    }

    /// Velocity, force and displacement, with the size of their parts.
    fn fields(&self, [f, g]: &[Ball; 2], [sum_f, sum_g]: &[Ball; 2], bits: u64) -> Enclosed {
        let velocity = self.velocity.add(f, bits).add(g, bits);
        let force = f.subtract(g, bits).multiply(&self.impedance, bits).add(&self.force, bits);
        let displacement = self.displacement.add(sum_f, bits).add(sum_g, bits);
        let size = [f, g, &self.velocity].map(|part| part.midpoint().magnitude());
        let size = size.into_iter().fold(Magnitude::ZERO, |sum, part| sum.add(&part));
        ([velocity, force, displacement], size)
    }
}

/// Whether radii are far below doubles of the size of the largest value.
fn is_fine(found: &[Enclosed]) -> bool {
    let scale = found.iter().map(|(_, size)| *size).max().unwrap_or(Magnitude::ZERO);
    let enough = scale.scale(-SPARE_BITS).max(Magnitude::power_of_two(-NEGLIGIBLE_BITS));
    found.iter().all(|(balls, _)| balls.iter().all(|ball| ball.radius() <= &enough))
}

/// The nearest double, or one beside it; zero for a ball that contains it.
fn bounded(ball: &Ball) -> Bounded {
    if ball.contains_zero() {
        return Bounded { value: 0.0, bound: ball.magnitude().to_double() };
    }
    let (value, bound) = ball.to_double();
    Bounded { value, bound: bound.to_double() }
}
