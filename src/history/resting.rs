//! Local contacts that press evenly.
//!
//! Some time after a wave has passed, a local contact hardly moves any more, as that between two long bars. Taylor
//! polynomials would go on in short steps for ever, as short as the motion was fast. So the state is taken to be
//! constant, `y ≈ y₀`, for as long as nothing else changes, and its error `e` obeys
//! `e' = A e + B (K − S) α_e + ρ` with a spring `K` in place of the contact, the secant stiffness `S` of the contact, the error `α_e`
//! of the compression, and `ρ = A y₀ + B u`, what is left of the equation. Beside the spring errors die out: what drives
//! them is felt for a time `m` at most. So with `λ = |S − K| |B|/√K`, as in `pressing`,
//! `|e| ≤ |e₀| + m (|ρ| + λ max |e|)`, however long the cell is.

use crate::ball::{Magnitude, Number};
use crate::history::motion::{Added, Course, told};
use crate::history::passivity::StateError;
use crate::history::pressing::{Compressed, Pressing};
use crate::history::series::{Roughness, Series};
use crate::signal::Signed;
use std::cmp::Ordering;

/// `m λ` is at most this power of two.
const MOST_MISMATCH: i64 = -3;

/// The error of a compression is at most this power of two times it.
const MOST_OFF: i64 = -5;

/// A block of a node whose local contacts press evenly.
pub(super) struct Rest {
    start: Vec<Number>,
    contacts: Vec<Compressed>,
    /// Of the contacts at the start.
    forces: Vec<Number>,
    /// The size of the error of the state at the start, and what of it comes from rounding now.
    at_start: Magnitude,
    rounding: Magnitude,
    /// `|ρ|`.
    residual: Magnitude,
    /// `m`
    memory: Magnitude,
}

impl Pressing<'_> {
    /// The block at rest, where nothing is told from that.
    pub(super) fn rest(&self, own: &[Number], error: &StateError) -> Option<Rest> {
        let (time, _) = self.block.decay.as_ref()?;
        let (norm, cut) = (self.given.norm, self.given.cut);
        let (start, rounding) = self.block.rounded(own, cut.bits);
        let at_start = error.size().add(&rounding);
        let contacts = self.compressed((own, &start), &at_start, &[]).ok()?;
        if contacts.iter().any(|own| own.is_light) {
            return None;
        }
        let mut input = self.given.coefficients(0);
        let mut forces = Vec::new();
        for (own, law) in self.each(&contacts) {
            let force = law.law.value(&start[own.place], cut.bits).ok()?;
            input[law.input] = force.clone();
            forces.push(force);
        }
        let rates = self.system.next(self.block, &start, (0, input), cut.bits);
        // Also within half a cell around it.
        let reach = norm.length.scale(1);
        let changes = |series: &Series| series.size_from(1, &reach).multiply(&reach);
        let changes: Vec<Magnitude> = self.given.settled.iter().map(changes).collect();
        let residual = self.block.size(rates.iter().map(Number::magnitude));
        let residual = residual.add(&self.block.push(&changes));
        let memory = Magnitude::power_of_two(time + 1);
        // Rounding the state leaves as much of the equation.
        let is_at_rest = residual <= told(error, cut).multiply(&self.block.rate);
        is_at_rest.then_some(Rest { start, contacts, forces, at_start, rounding, residual, memory })
    }

    /// The courses of the block and of the forces of its contacts where it rests on a cell that is too long for a Taylor
    /// polynomial.
    pub(super) fn resting_course(
        &self,
        own: &[Number],
        error: &StateError,
    ) -> Option<(Course, Vec<Series>)> {
        let (norm, cut) = (self.given.norm, self.given.cut);
        if !self.block.is_stiff_on(&norm.length) {
            return None;
        }
        let Rest { start, contacts, forces, at_start, rounding, residual, memory } =
            self.rest(own, error)?;
        let per_time = residual.add(&self.block.push(&self.given.rests));
        let driven = per_time.multiply(&memory);
        // |e| ≤ (|e₀| + m |ρ|)/(1 − m λ)
        let largest = at_start.add(&driven).scale(1);
        let mut rate = Magnitude::ZERO;
        for (own, law) in self.each(&contacts) {
            let moved = self.block.entry(own.place, &largest).add(&own.start.scale(-20));
            if moved > own.start.scale(MOST_OFF) {
                return None;
            }
            let off = self.mismatch(own, law, &moved).ok()?;
            rate = rate.add(&self.pushed_back(law, &off));
        }
        let mismatch = rate.multiply(&memory);
        if mismatch > Magnitude::power_of_two(MOST_MISMATCH) {
            return None;
        }
        let at_once = rounding.add(&mismatch.multiply(&largest));
        // Around the cell errors grow to e times, and those of the inputs are four times as large, as in `pressing`.
        let distance = self.distance(&contacts);
        let arrived = per_time.multiply(&distance).scale(2);
        let rest = largest.add(&arrived).multiply(&Magnitude::from_u64(3));
        let roughness = Some(Roughness::within(&distance, cut));
        let pressed = Signed { sign: Ordering::Greater, at_ends: [true; 2] };
        let force = |(own, force): (&Compressed, Number)| {
            let (force, rounding) = force.split(cut.bits);
            let error = |size: &Magnitude| {
                own.stiffest.multiply(&self.block.entry(own.place, size)).add(&rounding)
            };
            let own = Series::new(vec![force], error(&rest)).with_error_at_start(error(&at_start));
            Series { roughness, signed: Some(pressed), ..own }
        };
        let forces = contacts.iter().zip(forces).map(force).collect();
        let course = Course {
            columns: vec![start],
            rest,
            error: largest,
            fresh: largest,
            at_start,
            added: Added::Error { at_once, per_time, fresh: largest },
            roughness,
        };
        Some((course, forces))
    }
}
