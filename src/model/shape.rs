//! Frequencies and shapes of the modes of a chain of bars, masses and springs.
//!
//! At frequency `ω` a chain carries the pair of displacement `u` and tension `S` from left to right:
//!
//! ```text
//! bar      (u, S/Zω) turns by the angle ωτ
//! mass     S grows by −ω² M u           support   S grows by k u
//! spring   u grows by S/k
//! ```
//!
//! The Prüfer angle `θ`, with `u = r sin θ` and `S = r cos θ` and counted without jumps, strictly rises with
//! `ω`: each step carries a larger angle into a larger one, a larger `ω` makes each step of a bar or a mass turn
//! further, and at the right end `∂θ/∂ω = 2ω ∫u² dm/r² > 0`. Modes are where `θ` at the right end is a multiple of `π`
//! (fixed), or an odd multiple of `π/2` (free). So the n-th mode is the one at the n-th of these
//! angles: a count, which misses none.

use crate::ball::{Arithmetic, BallError, Trigonometric};
use std::f64::consts::{FRAC_PI_2, PI};

#[derive(Clone, PartialEq, Debug)]
pub enum Part<V = f64> {
    Bar { impedance: V, travel: V },
    Mass { mass: V },
    Spring { stiffness: V },
    Support { stiffness: V },
}

impl<V> Part<V> {
    /// The same with other numbers.
    pub fn map<W>(&self, value: impl Fn(&V) -> W) -> Part<W> {
        match self {
            Part::Bar { impedance, travel } => {
                Part::Bar { impedance: value(impedance), travel: value(travel) }
            }
            Part::Mass { mass } => Part::Mass { mass: value(mass) },
            Part::Spring { stiffness } => Part::Spring { stiffness: value(stiffness) },
            Part::Support { stiffness } => Part::Support { stiffness: value(stiffness) },
        }
    }
}

/// An angle `π turns + α` with `0 ≤ α < π`, by `sin α ≥ 0` and `cos α` in any common scale.
#[derive(Clone, Copy, Debug)]
struct Angle {
    turns: f64,
    sine: f64,
    cosine: f64,
}

impl Angle {
    fn of_end(held: bool) -> Angle {
        match held {
            true => Angle { turns: 0.0, sine: 0.0, cosine: 1.0 },
            false => Angle { turns: 0.0, sine: 1.0, cosine: 0.0 },
        }
    }

    fn behind(self, part: &Part, frequency: f64) -> Angle {
        let Angle { mut turns, mut sine, mut cosine } = self;
        match part {
            // With u fixed α stays between the same multiples of π.
            Part::Mass { mass } => cosine -= frequency * frequency * mass * sine,
            Part::Support { stiffness } => cosine += stiffness * sine,
            Part::Spring { stiffness } => {
                sine += cosine / stiffness;
                // With S fixed and negative, u may become negative: α passes π.
                if sine < 0.0 || (sine == 0.0 && cosine < 0.0) {
                    (turns, sine, cosine) = (turns + 1.0, -sine, -cosine);
                }
            }
            Part::Bar { impedance, travel } => {
                let scale = impedance * frequency;
                let angle = f64::atan2(scale * sine, cosine) + frequency * travel;
                let whole = (angle / PI).floor();
                turns += whole;
                let rest = (angle - whole * PI).clamp(0.0, PI);
                (sine, cosine) = (rest.sin().max(0.0) / scale, rest.cos());
            }
        }
        let size = sine.hypot(cosine);
        Angle { turns, sine: sine / size, cosine: cosine / size }
    }

    /// How far it is above `π turns + α`.
    fn above(self, turns: f64, alpha: f64) -> f64 {
        (self.turns - turns) * PI + (f64::atan2(self.sine, self.cosine) - alpha)
    }
}

/// The frequencies of the first modes; none for a motion as a whole, which is the first where a line drifts.
pub fn frequencies(
    parts: &[Part],
    held: [bool; 2],
    drifts: bool,
    count: usize,
) -> Vec<Option<f64>> {
    let mut found: Vec<Option<f64>> = Vec::with_capacity(count);
    for number in 0..count {
        let below = found.last().copied().flatten().unwrap_or(0.0);
        let is_whole = drifts && number == 0;
        found.push((!is_whole).then(|| frequency(parts, held, number, below)));
    }
    found
}

/// The frequency of a mode, counted from 0, which lies above `below`; `held` says which ends are fixed.
fn frequency(parts: &[Part], held: [bool; 2], number: usize, below: f64) -> f64 {
    // From a fixed left end θ starts at 0 and the first fixed angle is π, from a free one at π/2.
    let (turns, alpha) = match held[1] {
        true => (number as f64 + 1.0, 0.0),
        false => (number as f64, FRAC_PI_2),
    };
    let above = |frequency: f64| {
        let mut angle = Angle::of_end(held[0]);
        for part in parts {
            angle = angle.behind(part, frequency);
        }
        angle.above(turns, alpha)
    };
    let travel = parts.iter().map(|part| match part {
        Part::Bar { travel, .. } => *travel,
        _ => 0.0,
    });
    let spacing = PI / travel.sum::<f64>();
    let mut low = if below > 0.0 { below } else { spacing };
    let mut at_low = above(low);
    while at_low >= 0.0 && low > f64::MIN_POSITIVE {
        low /= 2.0;
        at_low = above(low);
    }
    let mut high = low + spacing;
    let mut at_high = above(high);
    while at_high < 0.0 {
        (low, at_low) = (high, at_high);
        high += spacing;
        at_high = above(high);
    }
    // False position with halved ends, and every third step in the middle: it always closes in.
    for step in 0..200 {
        if high - low <= 2.0 * f64::EPSILON * high {
            break;
        }
        let secant = low - at_low * (high - low) / (at_high - at_low);
        let inside = secant > low && secant < high;
        let middle = if step % 3 == 2 || !inside { low.midpoint(high) } else { secant };
        let at_middle = above(middle);
        if at_middle == 0.0 {
            return middle;
        }
        if at_middle < 0.0 {
            (low, at_low, at_high) = (middle, at_middle, at_high / 2.0);
        } else {
            (high, at_high, at_low) = (middle, at_middle, at_low / 2.0);
        }
    }
    low.midpoint(high)
}

/// The shape of a mode, in any scale.
///
/// # Invariants
/// `states` holds displacement and tension left of every part, and at the right end. The modal mass is positive in doubles;
/// an enclosure of it may contain zero, and then dividing by it fails.
#[derive(Clone, Debug)]
pub struct Shape<V = f64> {
    /// None for a motion as a whole.
    frequency: Option<V>,
    states: Vec<[V; 2]>,
    /// `∫ u ds` over each part, in time along the bar; zero for other parts.
    integrals: Vec<V>,
    /// `Zω` of each part that is a bar; none for a motion as a whole.
    scales: Vec<Option<V>>,
    mass: V,
}

impl<V: Trigonometric> Shape<V> {
    /// The shape at a frequency, or of a motion as a whole, from a left end that is fixed or free.
    ///
    /// In a bar `u = A cos ωs + B sin ωs` with `A = u_0`, `B = S_0/(Zω)`, so that
    /// `∫u ds = (A sin ωτ + B (1 − cos ωτ))/ω` and
    /// `∫u² ds = (A² + B²) τ/2 + (A² − B²) sin 2ωτ/(4ω) + A B sin² ωτ/ω`.
    ///
    /// # Errors
    /// Those of enclosures: doubles have none.
    pub fn of(
        parts: &[Part<V>],
        held: bool,
        frequency: Option<V>,
        bits: u64,
    ) -> Result<Shape<V>, BallError> {
        let (mut states, mut integrals, mut scales) = (Vec::new(), Vec::new(), Vec::new());
        let mut modal_mass = V::zero();
        let [mut u, mut pulled] = if held { [V::zero(), V::one()] } else { [V::one(), V::zero()] };
        for part in parts {
            states.push([u.clone(), pulled.clone()]);
            let (mut integral, mut scale) = (V::zero(), None);
            match (part, &frequency) {
                (Part::Mass { mass }, _) => {
                    modal_mass = modal_mass.add(&product([mass, &u, &u], bits), bits);
                    if let Some(frequency) = &frequency {
                        let force = product([frequency, frequency, mass, &u], bits);
                        pulled = pulled.subtract(&force, bits);
                    }
                }
                (Part::Support { stiffness }, _) => {
                    pulled = pulled.add(&stiffness.multiply(&u, bits), bits);
                }
                (Part::Spring { stiffness }, _) => {
                    u = u.add(&pulled.quotient(stiffness, bits)?, bits);
                }
                (Part::Bar { impedance, travel }, None) => {
                    // No tension.
                    integral = u.multiply(travel, bits);
                    modal_mass = modal_mass.add(&product([impedance, travel, &u, &u], bits), bits);
                }
                (Part::Bar { impedance, travel }, Some(frequency)) => {
                    let own = impedance.multiply(frequency, bits);
                    let state = [u.clone(), pulled.quotient(&own, bits)?];
                    let turn = frequency.multiply(travel, bits).cos_sin(bits)?;
                    let bar = SwungBar { state: &state, travel, frequency, turn: &turn, bits };
                    integral = bar.integral()?;
                    modal_mass = modal_mass.add(&impedance.multiply(&bar.square()?, bits), bits);
                    [u, pulled] = turned(&state, &turn, &own, bits);
                    scale = Some(own);
                }
            }
            integrals.push(integral);
            scales.push(scale);
        }
        states.push([u, pulled]);
        Ok(Shape { frequency, states, integrals, scales, mass: modal_mass })
    }

    /// A Newton step from this frequency towards one at which the right end is fixed (`u = 0`) or free (`S = 0`). With
    /// `M = ∫u² dm` it is `∂u/∂ω S − u ∂S/∂ω = 2ωM`. Near a mode the term with the factor that vanishes is left out, so that the
    /// step is `−uS/(2ωM)` where the end is held, `+uS/(2ωM)` where it is free; an error is squared all the same. None for a
    /// motion as a whole.
    pub fn correction(&self, held: bool, bits: u64) -> Result<Option<V>, BallError> {
        let Some(frequency) = &self.frequency else { return Ok(None) };
        let [u, pulled] = self.right_end();
        let divisor = product([&frequency.add(frequency, bits), &self.mass], bits);
        let ahead = u.multiply(pulled, bits).quotient(&divisor, bits)?;
        Ok(Some(if held { ahead.negate() } else { ahead }))
    }

    /// `ω`; none for a motion as a whole.
    pub fn frequency(&self) -> Option<&V> {
        self.frequency.as_ref()
    }

    /// `∫ u² dm` over the line.
    pub fn mass(&self) -> &V {
        &self.mass
    }

    /// Displacement and tension at the right end.
    pub fn right_end(&self) -> &[V; 2] {
        &self.states[self.states.len() - 1]
    }

    /// Displacement and tension left of a part, or at the right end.
    pub fn left_of(&self, part: usize) -> &[V; 2] {
        &self.states[part]
    }

    /// Displacement and tension in a bar, by the time that a wave needs from its left end.
    pub fn section(&self, part: usize, at: &V, bits: u64) -> Result<[V; 2], BallError> {
        let [u, pulled] = &self.states[part];
        let (Some(scale), Some(frequency)) = (&self.scales[part], &self.frequency) else {
            return Ok([u.clone(), pulled.clone()]);
        };
        let turn = frequency.multiply(at, bits).cos_sin(bits)?;
        let state = [u.clone(), pulled.quotient(scale, bits)?];
        Ok(turned(&state, &turn, scale, bits))
    }

    /// `∫ u ds` over a bar.
    pub fn integral(&self, part: usize) -> &V {
        &self.integrals[part]
    }
}

fn product<V: Arithmetic, const N: usize>(factors: [&V; N], bits: u64) -> V {
    let all = factors.into_iter().cloned();
    all.reduce(|product, factor| product.multiply(&factor, bits)).unwrap_or_else(V::one)
}

/// `u` and `S` after a turn by the angle with this cosine and sine, from `u` and `S/Zω`; `scale` is `Zω`.
fn turned<V: Arithmetic>([a, b]: &[V; 2], [cosine, sine]: &[V; 2], scale: &V, bits: u64) -> [V; 2] {
    let u = a.multiply(cosine, bits).add(&b.multiply(sine, bits), bits);
    let rest = b.multiply(cosine, bits).subtract(&a.multiply(sine, bits), bits);
    [u, scale.multiply(&rest, bits)]
}

/// A bar that swings, with `A` and `B`, and cosine and sine of `ωτ`.
struct SwungBar<'a, V> {
    state: &'a [V; 2],
    travel: &'a V,
    frequency: &'a V,
    turn: &'a [V; 2],
    bits: u64,
}

impl<V: Trigonometric> SwungBar<'_, V> {
    fn integral(&self) -> Result<V, BallError> {
        let (bits, [a, b], [_, sine]) = (self.bits, self.state, self.turn);
        let two = V::one().add(&V::one(), bits);
        let half_angle = self.frequency.multiply(self.travel, bits).quotient(&two, bits)?;
        let [_, half] = half_angle.cos_sin(bits)?;
        let rest = product([&b.add(b, bits), &half, &half], bits);
        a.multiply(sine, bits).add(&rest, bits).quotient(self.frequency, bits)
    }

    fn square(&self) -> Result<V, BallError> {
        let (bits, [a, b], [cosine, sine]) = (self.bits, self.state, self.turn);
        let (a_squared, b_squared) = (a.multiply(a, bits), b.multiply(b, bits));
        let both = a_squared.add(&b_squared, bits).multiply(self.travel, bits);
        let other = product([&a_squared.subtract(&b_squared, bits), sine, cosine], bits);
        let mixed = product([a, b, sine, sine], bits);
        let two = V::one().add(&V::one(), bits);
        let twice = self.frequency.add(self.frequency, bits);
        let sum = both.quotient(&two, bits)?.add(&other.quotient(&twice, bits)?, bits);
        Ok(sum.add(&mixed.quotient(self.frequency, bits)?, bits))
    }
}
