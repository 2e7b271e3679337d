//! The memory of echoes and pieces, foreseen while the first of them are worked out.
//!
//! Counts of coefficients grow as a power of the number of echoes. That power is read off from one doubling
//! of the number to the next, which tells what all of them will take when little of the work is done.

use crate::ball::{Ball, ComplexBall};
use crate::limits;
use crate::signal::error::{EvaluateError, Outcome};

/// From so many steps on a growth is told.
const FIRST: usize = 32;

/// Coefficients as they are counted, step by step.
pub struct Memory {
    bytes_each: u64,
    steps: usize,
    coefficients: u64,
    /// The count at the last power of two.
    before: u64,
    /// About how many bytes all steps take, as far as that is told.
    foreseen: f64,
}

impl Memory {
    /// Of coefficients with so many bits.
    pub fn of_balls(bits: u64) -> Memory {
        Memory::of(size_of::<ComplexBall>() as u64 + Ball::further_bytes(bits))
    }

    /// Of coefficients of so many bytes.
    pub fn of(bytes_each: u64) -> Memory {
        Memory { bytes_each, steps: 0, coefficients: 0, before: 0, foreseen: 0.0 }
    }

    /// About how many bytes all steps take; nothing to speak of where that cannot be told yet.
    pub fn foreseen(&self) -> f64 {
        self.foreseen
    }

    /// Adds what one step of so many made; refuses where all would take more than is allowed.
    pub fn add(&mut self, coefficients: usize, last: usize) -> Outcome<()> {
        self.steps += 1;
        self.coefficients += coefficients as u64;
        if !self.steps.is_power_of_two() || self.steps > last {
            return Ok(());
        }
        let before = std::mem::replace(&mut self.before, self.coefficients);
        if self.steps < FIRST || before == 0 {
            return Ok(());
        }
        let taken = (self.coefficients * self.bytes_each) as f64;
        let power = (self.coefficients as f64 / before as f64).log2().max(f64::MIN_POSITIVE);
        let rest = last as f64 / self.steps as f64;
        let bytes = taken * rest.powf(power);
        self.foreseen = bytes;
        let limit = limits::memory() as f64;
        if bytes <= limit {
            return Ok(());
        }
        let share = (limit / bytes).powf(power.recip());
        let (megabytes, percent) = ((bytes / 1e6).ceil() as u64, (100.0 * share) as u64);
        Err(EvaluateError::TooMuchMemory { megabytes, percent })
    }
}
