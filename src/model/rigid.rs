//! The line as one rigid body on the springs and dampers at its ends.
//!
//! All bars and masses stick together at the start, keep their momentum, and then move as one:
//!
//! ```text
//! M v' + d v + k x = F,   x' = v,   x(0) = 0,   M v(0) = Σ m v_0,   M = Σ m + Σ Z τ
//! ```
//!
//! with constant forces between the times at which loads begin and end. Error law (measured, not
//! proven): what it leaves out are the waves, so the error is as large as the waves are; averaged over
//! many round trips the velocity of a free line is right, because momentum is kept.

use crate::model::Model;
use crate::model::error::{ModelError, NotRepresented, NotSeen};
use crate::model::line::Line;
use crate::network::{ElementLaw, Face, Field, Lump, Lumped, Node, Reading, ScaledScene, Side};
use crate::scene::Drive;

const NAME: &str = "rigid body";

/// The line as one rigid body.
///
/// Cost: a few exponentials for each time.
///
/// # Invariants
/// The mass is positive and finite; stiffness and damping are not negative.
#[derive(Clone, Debug)]
pub struct RigidBody {
    line: Line,
    mass: f64,
    stiffness: f64,
    damping: f64,
    /// The velocity after the impact.
    start: f64,
    /// Constant forces, and from when until when they act.
    forces: Vec<(f64, f64, f64)>,
    /// Which run is the body, by node: what is left of it is held, and what is right of it.
    body: Vec<usize>,
}

fn refuse<T>(reason: NotRepresented) -> Result<T, ModelError> {
    Err(ModelError::Refused { model: NAME, reason })
}

/// Displacement and velocity after a time under a constant force, in closed form.
///
/// With `β = d/2M`, `ω² = |k/M − β²|` and the distance `y` from equilibrium,
/// `y = e^{−βt} (y_0 C + (v_0 + β y_0) S)` and `v = e^{−βt} (v_0 C − (β v_0 + k/M y_0) S)`, where
/// `C, S = cos ωt, sin ωt/ω`, or `cosh, sinh`. The latter stand with their exponential, as
/// `e^{−(β−ω)t}` and `e^{−(β+ω)t}` with `β − ω = (k/M)/(β + ω)`: nothing overflows or cancels.
fn moved(body: &RigidBody, [x, v]: [f64; 2], force: f64, t: f64) -> [f64; 2] {
    let (push, decay, square) =
        (force / body.mass, body.damping / body.mass, body.stiffness / body.mass);
    if square == 0.0 {
        if decay == 0.0 {
            return [x + v * t + push * t * t / 2.0, v + push * t];
        }
        let (last, gone) = (push / decay, -f64::exp_m1(-decay * t));
        return [x + last * t + (v - last) * gone / decay, v + (last - v) * gone];
    }
    let rest = push / square;
    let y = x - rest;
    let beta = decay / 2.0;
    let omega_squared = square - beta * beta;
    let (cosine, sine) = if omega_squared > 0.0 {
        let omega = omega_squared.sqrt();
        let (sine, cosine) = (omega * t).sin_cos();
        let damped = (-beta * t).exp();
        (damped * cosine, damped * sine / omega)
    } else {
        let omega = (-omega_squared).sqrt();
        let slow = (-square / (beta + omega) * t).exp();
        let gone = -f64::exp_m1(-2.0 * omega * t);
        let sine = if omega == 0.0 { slow * t } else { slow * gone / (2.0 * omega) };
        (slow * (1.0 - gone / 2.0), sine)
    };
    [rest + y * cosine + (v + beta * y) * sine, v * cosine - (beta * v + square * y) * sine]
}

impl RigidBody {
    /// The body that a line is where nothing in it yields.
    pub fn new(scene: &impl AsRef<ScaledScene>) -> Result<RigidBody, ModelError> {
        let line = Line::linear(NAME, scene.as_ref())?;
        if let Some(bar) = line.endless() {
            return refuse(NotRepresented::EndlessBody(bar.name.clone()));
        }
        if let Some(bar) = line.bars.iter().find(|bar| bar.force != 0.0) {
            return refuse(NotRepresented::StrainedBody(bar.name.clone()));
        }
        let mut body = RigidBody {
            mass: line.bars.iter().map(|bar| bar.mass()).sum(),
            start: line.bars.iter().map(|bar| bar.mass() * bar.velocity).sum(),
            stiffness: 0.0,
            damping: 0.0,
            forces: Vec::new(),
            body: Vec::new(),
            line,
        };
        let nodes = std::mem::take(&mut body.line.nodes);
        for node in &nodes {
            body.join(node)?;
        }
        body.line.nodes = nodes;
        if !(body.mass > 0.0 && body.mass.is_finite()) {
            return refuse(NotRepresented::NoMass);
        }
        body.start /= body.mass;
        Ok(body)
    }

    /// `M`, in the scale of the scene: the masses and the bars together.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    fn join(&mut self, node: &Node<f64>) -> Result<(), ModelError> {
        let bar = |side| matches!(side, Side::Bar(_));
        let moves = |run: usize| node.mass_of(run).0 > 0.0 || node.sides(run).any(bar);
        let moving: Vec<usize> = (0..node.runs()).filter(|run| moves(*run)).collect();
        let springs: Vec<&Lumped<f64>> =
            node.elements.iter().filter(|own| own.law.is_link()).collect();
        let name = |own: &Lumped<f64>| self.line.name(own.element);
        let [run] = moving[..] else {
            return refuse(match springs.get(moving.first().copied().unwrap_or(0)) {
                Some(spring) => NotRepresented::SeveralBodies(name(spring)),
                None => NotRepresented::NoMass,
            });
        };
        if node.is_held(run) {
            return refuse(NotRepresented::HeldBody);
        }
        for (left, spring) in springs.into_iter().enumerate() {
            let outer = if left < run { left } else { left + 1 };
            if !node.is_held(outer) || outer.abs_diff(run) != 1 {
                return refuse(NotRepresented::SpringElsewhere(name(spring)));
            }
        }
        for own in &node.elements {
            let moves = own.run == run;
            match &own.law {
                ElementLaw::Mass { mass, velocity } if moves => {
                    self.mass += mass;
                    self.start += mass * velocity;
                }
                ElementLaw::Load(Drive::Velocity) => {
                    return refuse(NotRepresented::ImposedVelocity(name(own)));
                }
                ElementLaw::Load(Drive::Force) if moves => {
                    let load = &self.line.loads[&own.element];
                    let Some(force) = load.course.constant() else {
                        return refuse(NotRepresented::VaryingForce(name(own)));
                    };
                    self.forces.push((force, load.from, load.until));
                }
                law => {
                    if let Some([stiffness, damping]) =
                        law.resistance().filter(|_| moves || law.is_link())
                    {
                        self.stiffness += stiffness;
                        self.damping += damping;
                    }
                }
            }
        }
        self.body.push(run);
        Ok(())
    }

    /// Displacement and velocity at a time.
    fn state(&self, time: f64) -> [f64; 2] {
        let moments = self.forces.iter().flat_map(|(_, from, until)| [*from, *until]);
        let mut moments: Vec<f64> = moments.filter(|at| *at > 0.0 && *at < time).collect();
        moments.push(time);
        moments.sort_by(f64::total_cmp);
        let (mut state, mut now) = ([0.0, self.start], 0.0);
        for next in moments {
            let acting = self.forces.iter().filter(|(_, from, until)| *from <= now && now < *until);
            state = moved(self, state, acting.map(|(force, ..)| force).sum(), next - now);
            now = next;
        }
        state
    }

    /// A reading when the body is at `x` and moves with `v`, as factors of the two.
    fn seen(&self, reading: &Reading<f64>) -> Result<[f64; 2], NotSeen> {
        let moves = |face: Face| {
            let node = face.lump().node;
            f64::from(u8::from(self.line.nodes[node].run_beside(face) == self.body[node]))
        };
        // A spring at the left of the body is shortened when that moves to the left.
        let shortens = |lump: Lump| moves(Face::Left(lump)) - moves(Face::Right(lump));
        let law = |lump: Lump| &self.line.nodes[lump.node].elements[lump.place].law;
        Ok(match reading {
            Reading::InBar(Field::Velocity, _) => [0.0, 1.0],
            Reading::InBar(Field::Displacement, _) => [1.0, 0.0],
            Reading::InBar(Field::Force, _) => return Err(NotSeen::ForceInRigidBar),
            Reading::Momentum(bar) => [0.0, self.line.bars[*bar].mass()],
            Reading::Velocity(face) => [0.0, moves(*face)],
            Reading::Displacement(face) => [moves(*face), 0.0],
            Reading::Compression(lump) => [shortens(*lump), 0.0],
            Reading::Force(lump) => match law(*lump) {
                ElementLaw::Spring { stiffness, damping } => {
                    [shortens(*lump) * stiffness, shortens(*lump) * damping]
                }
                ElementLaw::Support { stiffness, damping } => {
                    let moves = moves(Face::Left(*lump));
                    [moves * stiffness, moves * damping]
                }
                _ => return Err(NotSeen::Other),
            },
        })
    }
}

impl Model for RigidBody {
    fn assumptions(&self) -> &'static str {
        "Bars do not yield: the whole line moves as one body, and all waves in it are left out."
    }

    fn values(&self, observable: usize, times: &[f64]) -> Result<Vec<f64>, ModelError> {
        let observable = self.line.observable(NAME, observable)?;
        let factors = self.line.factors(NAME, observable, |of| self.seen(of))?;
        let value = |time: f64| match time < 0.0 {
            true => 0.0,
            false => {
                let [x, v] = self.state(time);
                factors[0] * x + factors[1] * v
            }
        };
        Ok(self.line.scaled(times)?.into_iter().map(value).collect())
    }
}
