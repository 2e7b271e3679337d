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
//! The angle of Prüfer `θ`, with `u = r sin θ` and `S = r cos θ` and counted without jumps, never
//! falls as `ω` grows: each step carries a larger angle into a larger one, and a larger `ω` makes each
//! step of a bar or a mass turn further. Modes are where `θ` at the right end is a multiple of `π`
//! (fixed), or an odd multiple of `π/2` (free). So the n-th mode is the one at the n-th of these
//! angles: a count, which misses none.

use std::f64::consts::{FRAC_PI_2, PI};

#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Part {
    Bar { impedance: f64, travel: f64 },
    Mass { mass: f64 },
    Spring { stiffness: f64 },
    Support { stiffness: f64 },
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
        match *part {
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

/// The frequency of a mode, counted from 0, which lies above `below`; `held` says which ends are fixed.
pub fn frequency(parts: &[Part], held: [bool; 2], number: usize, below: f64) -> f64 {
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
/// `states` holds displacement and tension left of every part; the modal mass is positive.
#[derive(Clone, Debug)]
pub struct Shape {
    frequency: f64,
    states: Vec<[f64; 2]>,
    /// `∫ u ds` over each part, in time along the bar; zero for other parts.
    integrals: Vec<f64>,
    /// `Zω` of each part that is a bar.
    scales: Vec<f64>,
    mass: f64,
}

impl Shape {
    /// The shape at a frequency, from a left end that is fixed or free.
    ///
    /// In a bar `u = A cos ωs + B sin ωs` with `A = u_0`, `B = S_0/(Zω)`, so that
    /// `∫u ds = (A sin ωτ + B (1 − cos ωτ))/ω` and
    /// `∫u² ds = (A² + B²) τ/2 + (A² − B²) sin 2ωτ/(4ω) + A B sin² ωτ/ω`.
    pub fn of(parts: &[Part], held: bool, frequency: f64) -> Shape {
        let mut shape = Shape {
            frequency,
            states: Vec::with_capacity(parts.len()),
            integrals: Vec::with_capacity(parts.len()),
            scales: Vec::with_capacity(parts.len()),
            mass: 0.0,
        };
        let [mut u, mut pulled] = if held { [0.0, 1.0] } else { [1.0, 0.0] };
        for part in parts {
            shape.states.push([u, pulled]);
            let (mut integral, mut scale) = (0.0, 0.0);
            match *part {
                Part::Mass { mass } => {
                    shape.mass += mass * u * u;
                    pulled -= frequency * frequency * mass * u;
                }
                Part::Support { stiffness } => pulled += stiffness * u,
                Part::Spring { stiffness } => u += pulled / stiffness,
                Part::Bar { impedance, travel } if frequency == 0.0 => {
                    // A motion as a whole: no tension.
                    integral = u * travel;
                    shape.mass += impedance * travel * u * u;
                }
                Part::Bar { impedance, travel } => {
                    scale = impedance * frequency;
                    let (a, b) = (u, pulled / scale);
                    let (sine, cosine) = (frequency * travel).sin_cos();
                    let half = (frequency * travel / 2.0).sin();
                    integral = (a * sine + b * 2.0 * half * half) / frequency;
                    let square = (a * a + b * b) * travel / 2.0
                        + (a * a - b * b) * sine * cosine / (2.0 * frequency)
                        + a * b * sine * sine / frequency;
                    shape.mass += impedance * square;
                    (u, pulled) = (a * cosine + b * sine, scale * (b * cosine - a * sine));
                }
            }
            shape.integrals.push(integral);
            shape.scales.push(scale);
        }
        shape
    }

    /// `ω`.
    pub fn frequency(&self) -> f64 {
        self.frequency
    }

    /// `∫ u² dm` over the line.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Displacement and tension left of a part.
    pub fn left_of(&self, part: usize) -> [f64; 2] {
        self.states[part]
    }

    /// Displacement and tension in a bar, by the time that a wave needs from its left end.
    pub fn section(&self, part: usize, at: f64) -> [f64; 2] {
        let ([u, pulled], scale) = (self.states[part], self.scales[part]);
        if scale == 0.0 {
            return [u, pulled];
        }
        let (sine, cosine) = (self.frequency * at).sin_cos();
        [u * cosine + pulled / scale * sine, pulled * cosine - scale * u * sine]
    }

    /// `∫ u ds` over a bar.
    pub fn integral(&self, part: usize) -> f64 {
        self.integrals[part]
    }
}
