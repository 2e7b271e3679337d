//! What answers take for granted, because no precision decides it.

use std::sync::{Arc, Mutex, PoisonError};

/// What is taken for granted of a scene because no precision decides it, in words; shared by all copies of its
/// network.
#[derive(Clone, Default, Debug)]
pub struct Assumed(Arc<Mutex<Vec<String>>>);

impl Assumed {
    /// All of it, in the order in which it was met.
    pub fn all(&self) -> Vec<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub fn add(&self, assumption: String) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if !all.contains(&assumption) {
            all.push(assumption);
        }
    }
}
