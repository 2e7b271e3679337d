//! Finite differences: bars cut into cells, velocities at their ends and forces in their middles, each
//! advanced by the other half a step later.
//!
//! A cell that a wave crosses in `h` is a spring `Z/h` with half of its mass `Zh` at each end:
//!
//! ```text
//! X += Δt Z/h (v_left − v_right),     m (v⁺ − v⁻)/Δt = X_left − X_right + …
//! ```
//!
//! Two free halves of a cell swing with `ω² = (Z/h) (2/(Zh) + 2/(Zh)) = 4/h²`. The line is the sum of
//! its cells, and no frequency of a sum is above the highest of its parts, so the scheme, which needs
//! `ω Δt ≤ 2`, is stable for `Δt ≤ h`. Springs, supports and dampers at nodes are averaged over the
//! step (`k (u⁻ + 2u + u⁺)/4`), which keeps that bound whatever their stiffness.
//!
//! Where all cells are alike and `Δt = h`, the scheme carries waves along characteristics, without
//! error. Error law (measured, not proven): second order in `Δt` where the solution is smooth; first
//! order in the mean of the error over time where it jumps; with `Δt = h` and bars alone exact up to
//! rounding farther than one step from a jump.

use crate::limits::MAX_CELL_UPDATES;
use crate::model::Model;
use crate::model::chain::{Chain, NAME};
use crate::model::error::{BadSetting, ModelError, NotSeen};
use crate::model::line::Line;
use crate::network::{Reading, ScaledScene, Term};

/// Finite differences on staggered points.
///
/// Cost: some ten operations for each cell and step, anew for each call.
///
/// # Invariants
/// The step is positive and at most the shortest time in which a wave crosses a cell; every point has
/// a mass or is held.
#[derive(Clone, Debug)]
pub struct Leapfrog {
    line: Line,
    chain: Chain,
    /// The unit of time by that of the user.
    unit: f64,
}

impl Leapfrog {
    /// Cuts the bar with the shortest travel time into `cells`, the others into as many of the same
    /// travel time as they hold, a little longer where they must be; with steps of `courant` times the
    /// shortest travel time of a cell.
    pub fn new(scene: &ScaledScene, cells: usize, courant: f64) -> Result<Leapfrog, ModelError> {
        let setting = |reason| Err(ModelError::Setting { model: NAME, reason });
        if cells == 0 {
            return setting(BadSetting::NoCells);
        }
        if courant > 1.0 {
            return setting(BadSetting::Unstable(courant));
        }
        if courant.is_nan() || courant <= 0.0 {
            return setting(BadSetting::NoStep(courant));
        }
        let line = Line::linear(NAME, scene)?;
        let chain = Chain::of(&line, cells, courant)?;
        let unit = line.scaled(&[1.0])?[0];
        Ok(Leapfrog { line, chain, unit })
    }

    pub fn cells(&self) -> usize {
        self.chain.cells()
    }

    /// The step in time, in seconds or as a plain number.
    pub fn step(&self) -> f64 {
        self.chain.step / self.unit
    }
}

/// Values between two samples in time, for times in ascending order.
struct Samples<'a> {
    term: &'a Term<f64>,
    /// The displacement so far.
    moved: f64,
    before: Option<(f64, f64)>,
    served: usize,
}

impl Samples<'_> {
    /// Takes a sample, and adds the values at all times that it is the next for; times before the
    /// second sample are read on the line through the first two.
    fn take(&mut self, at: f64, sample: f64, times: &[(f64, usize)], values: &mut [f64]) {
        if let Some((earlier, first)) = self.before {
            let slope = (sample - first) / (at - earlier);
            while let Some((time, place)) = times.get(self.served).filter(|(time, _)| *time < at) {
                values[*place] += self.term.coefficient * (first + slope * (time - earlier));
                self.served += 1;
            }
        }
        self.before = Some((at, sample));
    }
}

impl Model for Leapfrog {
    fn assumptions(&self) -> &'static str {
        "Bars are cells with two half masses and a spring; what happens within a cell is left out."
    }

    fn values(&self, observable: usize, times: &[f64]) -> Result<Vec<f64>, ModelError> {
        let observable = self.line.observable(NAME, observable)?;
        let mut all = Vec::new();
        for term in observable.terms() {
            if let Reading::Momentum(bar) = term.of
                && self.line.bars[bar].travel.is_none()
            {
                return self.line.refuse(NAME, observable, NotSeen::EndlessMomentum);
            }
            if !self.chain.has(&term.of) {
                return self.line.refuse(NAME, observable, NotSeen::Other);
            }
            all.push(Samples { term, moved: 0.0, before: None, served: 0 });
        }
        let scaled = self.line.scaled(times)?;
        let mut values = vec![0.0; times.len()];
        let mut ascending: Vec<(f64, usize)> = scaled.into_iter().zip(0..).collect();
        ascending.retain(|(time, _)| *time >= 0.0);
        ascending.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some((last, _)) = ascending.last() else { return Ok(values) };
        let steps = last / self.chain.step + 2.0;
        let count = steps * self.cells() as f64;
        ModelError::limited(NAME, "cell updates", count, MAX_CELL_UPDATES)?;
        let mut motion = self.chain.start();
        while all.iter().any(|samples| samples.served < ascending.len()) {
            motion.advance(&self.line);
            for samples in &mut all {
                let (at, sample) = motion.sample(&self.line, &samples.term.of, &mut samples.moved);
                samples.take(at, sample, &ascending, &mut values);
            }
            motion.settle();
        }
        Ok(values)
    }
}
