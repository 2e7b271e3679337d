//! A node as a system of differential equations with what arrives from its bars as input.
//!
//! With `w` the whole wave that arrives in a bar of impedance `Z`, the force of the bar on the node is
//! `Z (2w − v)`, and what leaves is `v − w`: no derivative of a delayed function occurs. The state
//! holds the velocities of what has a mass, the compressions of springs and local contacts, and the
//! displacements of supports; velocities of what has no mass follow from a balance of forces.

use crate::model::error::{ModelError, NotRepresented};
use crate::model::line::{Bar, Law, LocalContact, Node};
use crate::network::Side;
use crate::scene::Drive;

/// A node with its numbers.
///
/// # Invariants
/// The forces on the runs without mass determine their velocities.
#[derive(Clone, Debug)]
pub(crate) struct Junction {
    /// The mass of each run, and its velocity at the start.
    mass: Vec<f64>,
    start: Vec<f64>,
    held: Vec<bool>,
    /// What resists each velocity; the inverse for those of the runs without mass.
    resistance: Vec<Vec<f64>>,
    massless: Vec<usize>,
    inverse: Vec<Vec<f64>>,
    /// Of each state behind the velocities: its law, and the run that it presses on; what parts the
    /// node presses on the next one too.
    yields: Vec<Yield>,
    /// The impedance at the left and at the right; zero where there is no bar.
    pub impedance: [f64; 2],
}

/// What has a displacement: a spring, a local contact or a support.
#[derive(Clone, Copy, Debug)]
struct Yield {
    run: usize,
    press: Press,
    /// Whether it presses on the next run too.
    between: bool,
    /// Displacements are kept in this time, as velocities, so that one tolerance suits all states.
    time: f64,
}

/// How a force follows from a displacement.
#[derive(Clone, Copy, Debug)]
enum Press {
    Linear(f64),
    Hertz(LocalContact),
}

impl Press {
    fn force(&self, displacement: f64) -> f64 {
        match self {
            Press::Linear(stiffness) => stiffness * displacement,
            Press::Hertz(contact) => contact.force_at(displacement),
        }
    }
}

/// What acts on a node at a time.
pub(crate) struct Acting {
    /// The waves that arrive from the left and from the right.
    pub arriving: [f64; 2],
    /// Forces on runs, and imposed velocities.
    pub forces: Vec<f64>,
    pub imposed: Vec<f64>,
}

/// The inverse of a small matrix, by elimination with pivots; `None` where it has none.
fn inverse(mut matrix: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let size = matrix.len();
    let mut result: Vec<Vec<f64>> =
        (0..size).map(|i| (0..size).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    for i in 0..size {
        let largest = |a: &usize, b: &usize| matrix[*a][i].abs().total_cmp(&matrix[*b][i].abs());
        let pivot = (i..size).max_by(largest)?;
        if matrix[pivot][i].abs() <= f64::MIN_POSITIVE {
            return None;
        }
        matrix.swap(i, pivot);
        result.swap(i, pivot);
        let whole = matrix[i][i];
        for entry in matrix[i].iter_mut().chain(&mut result[i]) {
            *entry /= whole;
        }
        for row in (0..size).filter(|row| *row != i) {
            let factor = matrix[row][i];
            for rows in [&mut matrix, &mut result] {
                let own = rows[i].clone();
                rows[row].iter_mut().zip(own).for_each(|(entry, above)| *entry -= factor * above);
            }
        }
    }
    Some(result)
}

impl Junction {
    /// The system of a node, in a line whose velocities are about `speed`.
    ///
    /// # Errors
    /// [`ModelError::Refused`] where something has no mass and nothing resists its motion.
    pub fn of(
        model: &'static str,
        node: &Node,
        bars: &[Bar],
        speed: f64,
    ) -> Result<Junction, ModelError> {
        let runs = node.runs;
        let mut held: Vec<bool> = (0..runs).map(|run| node.is_held(run)).collect();
        let mut resistance = vec![vec![0.0; runs]; runs];
        let mut yields = Vec::new();
        let mut impedance = [0.0; 2];
        for (i, (side, run)) in [(node.left, 0), (node.right, runs - 1)].into_iter().enumerate() {
            if let Side::Bar(bar) = side {
                impedance[i] = bars[bar].impedance;
                resistance[run][run] += impedance[i];
            }
        }
        for lump in &node.lumps {
            let run = lump.run;
            match lump.law {
                Law::Spring { stiffness, damping } => {
                    for (row, column) in [(run, run + 1), (run + 1, run)] {
                        resistance[row][row] += damping;
                        resistance[row][column] -= damping;
                    }
                    yields.push(Yield {
                        run,
                        press: Press::Linear(stiffness),
                        between: true,
                        time: 1.0,
                    });
                }
                Law::Hertz(contact) => {
                    let press = Press::Hertz(contact);
                    let time = contact.time(impedance[0] + impedance[1], speed);
                    yields.push(Yield { run, press, between: true, time });
                }
                Law::Support { stiffness, damping } => {
                    resistance[run][run] += damping;
                    yields.push(Yield {
                        run,
                        press: Press::Linear(stiffness),
                        between: false,
                        time: 1.0,
                    });
                }
                Law::Load { drive: Drive::Velocity, .. } => held[run] = true,
                _ => {}
            }
        }
        let (mut mass, mut start) = (Vec::new(), Vec::new());
        for (run, held) in held.iter().enumerate() {
            let (own, momentum) = node.mass_of(run);
            mass.push(own);
            start.push(if own > 0.0 && !held { momentum / own } else { 0.0 });
        }
        let massless: Vec<usize> =
            (0..runs).filter(|run| !held[*run] && mass[*run] <= 0.0).collect();
        let row = |row: &usize| massless.iter().map(|column| resistance[*row][*column]).collect();
        let Some(inverse) = inverse(massless.iter().map(row).collect()) else {
            let name = node.lumps.first().map_or("an end", |lump| lump.name.as_str());
            let reason = NotRepresented::Unresisted(name.to_owned());
            return Err(ModelError::Refused { model, reason });
        };
        Ok(Junction { mass, start, held, resistance, massless, inverse, yields, impedance })
    }

    /// How many runs there are.
    pub fn runs(&self) -> usize {
        self.mass.len()
    }

    /// How many springs, local contacts and supports there are.
    pub fn yields(&self) -> usize {
        self.yields.len()
    }

    /// The runs whose velocities are states.
    fn heavy(&self) -> impl Iterator<Item = usize> {
        (0..self.runs()).filter(|run| !self.held[*run] && self.mass[*run] > 0.0)
    }

    /// The state at the start: velocities of what has a mass, then displacements.
    pub fn start(&self) -> Vec<f64> {
        let mut state: Vec<f64> = self.heavy().map(|run| self.start[run]).collect();
        state.resize(state.len() + self.yields.len(), 0.0);
        state
    }

    /// The displacement of the n-th of what yields.
    pub fn displacement(&self, state: &[f64], number: usize) -> f64 {
        state[self.heavy().count() + number] * self.yields[number].time
    }

    /// The time in which the n-th of what yields is kept.
    pub fn time(&self, number: usize) -> f64 {
        self.yields[number].time
    }

    /// The forces on all runs but those that resist their velocities.
    fn pressed(&self, state: &[f64], acting: &Acting) -> Vec<f64> {
        let mut pressed = acting.forces.clone();
        let last = self.runs() - 1;
        pressed[0] += 2.0 * self.impedance[0] * acting.arriving[0];
        pressed[last] += 2.0 * self.impedance[1] * acting.arriving[1];
        let first = self.heavy().count();
        for (own, kept) in self.yields.iter().zip(&state[first..]) {
            let force = own.press.force(kept * own.time);
            pressed[own.run] -= force;
            if own.between {
                pressed[own.run + 1] += force;
            }
        }
        pressed
    }

    /// The velocities of all runs.
    pub fn velocities(&self, state: &[f64], acting: &Acting) -> Vec<f64> {
        self.solved(state, acting, &self.pressed(state, acting))
    }

    fn solved(&self, state: &[f64], acting: &Acting, pressed: &[f64]) -> Vec<f64> {
        let mut velocities = acting.imposed.clone();
        for (run, velocity) in self.heavy().zip(state) {
            velocities[run] = *velocity;
        }
        self.massless.iter().for_each(|run| velocities[*run] = 0.0);
        let rest: Vec<f64> = (self.massless.iter())
            .map(|run| {
                let resisted = self.resistance[*run].iter().zip(&velocities);
                pressed[*run] - resisted.map(|(r, v)| r * v).sum::<f64>()
            })
            .collect();
        for (run, row) in self.massless.iter().zip(&self.inverse) {
            velocities[*run] = row.iter().zip(&rest).map(|(r, f)| r * f).sum();
        }
        velocities
    }

    /// How fast the state changes.
    pub fn slope(&self, state: &[f64], acting: &Acting, slope: &mut [f64]) {
        let pressed = self.pressed(state, acting);
        let velocities = self.solved(state, acting, &pressed);
        let mut slopes = slope.iter_mut();
        for run in self.heavy() {
            let resisted = self.resistance[run].iter().zip(&velocities).map(|(r, v)| r * v);
            let force = pressed[run] - resisted.sum::<f64>();
            *slopes.next().expect("a state") = force / self.mass[run];
        }
        for own in &self.yields {
            let next = if own.between { velocities[own.run + 1] } else { 0.0 };
            *slopes.next().expect("a state") = (velocities[own.run] - next) / own.time;
        }
    }
}
