//! What answers take for granted, because no precision decides it.

use std::sync::{Arc, Mutex, PoisonError};

/// What is taken for granted of a scene because no precision decides it, in words, each with the most bits that were
/// tried; shared by all copies of its network.
#[derive(Clone, Default, Debug)]
pub struct Assumed(Arc<Mutex<Vec<(String, u64)>>>);

impl Assumed {
    /// All of it, in the order in which it was met.
    pub fn all(&self) -> Vec<String> {
        let all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let told =
            |(what, bits): &(String, u64)| format!("{what}, which {bits} bits do not decide");
        all.iter().map(told).collect()
    }

    pub fn add(&self, assumption: String, bits: u64) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match all.iter_mut().find(|(known, _)| *known == assumption) {
            Some((_, most)) => *most = bits.max(*most),
            None => all.push((assumption, bits)),
        }
    }
}
