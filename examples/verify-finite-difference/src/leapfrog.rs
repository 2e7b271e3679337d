//! The code that is checked: leapfrog on a staggered mesh, for a bar with a mass at its left end or
//! pushed there, and fixed at the right end.

/// What acts at the left end of the bar.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum LeftEnd {
    /// A mass of 1 that moves with 1 at the start.
    Mass,
    /// A force that grows evenly with time, `F = t`.
    Push,
    /// A force that begins smoothly, `F = t^4`.
    Smooth,
}

/// A bar of impedance, length and wave speed 1: velocities at N + 1 nodes, strains in N cells between
/// them, half a step apart in time.
pub struct Leapfrog {
    /// The velocity at each node, half a step after the time.
    pub velocity: Vec<f64>,
    /// The strain of each cell, at the time.
    pub strain: Vec<f64>,
    time: f64,
    step: f64,
    cell: f64,
    end: LeftEnd,
}

impl Leapfrog {
    /// A bar of `cells` cells; steps are `courant` times the time that a wave takes for a cell.
    pub fn new(cells: usize, courant: f64, end: LeftEnd) -> Leapfrog {
        let cell = 1.0 / cells as f64;
        let mut velocity = vec![0.0; cells + 1];
        if end == LeftEnd::Mass {
            // The mass shares its momentum with half of the first cell.
            velocity[0] = 1.0 / (1.0 + cell / 2.0);
        }
        let strain = vec![0.0; cells];
        Leapfrog { velocity, strain, time: 0.0, step: courant * cell, cell, end }
    }

    /// The time of the strains.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// One step: strains from velocities, then velocities from strains.
    pub fn advance(&mut self) {
        let cells = self.strain.len();
        for i in 0..cells {
            self.strain[i] += self.step / self.cell * (self.velocity[i + 1] - self.velocity[i]);
        }
        self.time += self.step;
        let (mass, force) = match self.end {
            LeftEnd::Mass => (1.0, 0.0),
            LeftEnd::Push => (0.0, self.time),
            LeftEnd::Smooth => (0.0, self.time.powi(4)),
        };
        self.velocity[0] += self.step * (self.strain[0] + force) / (mass + self.cell / 2.0);
        for i in 1..cells {
            self.velocity[i] += self.step / self.cell * (self.strain[i] - self.strain[i - 1]);
        }
    }
}
