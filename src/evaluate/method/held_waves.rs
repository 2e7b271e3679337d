//! The response on all periods of a window, as a march with a certificate leaves it.
//!
//! A proof marches through all periods. Where these are few their polynomials are held, so that values
//! need no second march.

/// The most coefficients that are held: eight megabytes.
const MOST: usize = 1 << 20;

/// Chebyshev coefficients of the response, period by period.
///
/// # Invariants
/// `ends` ascends, and its last one is the count of the coefficients.
#[derive(Default)]
pub(super) struct HeldWaves {
    coefficients: Vec<f64>,
    /// Where the coefficients of each period end.
    ends: Vec<usize>,
}

impl HeldWaves {
    /// With the next period; none where there is no room for it.
    pub fn with_period(mut self, coefficients: &[f64]) -> Option<HeldWaves> {
        self.coefficients.extend_from_slice(coefficients);
        self.ends.push(self.coefficients.len());
        (self.coefficients.len() <= MOST).then_some(self)
    }

    /// The coefficients of a period that is held.
    ///
    /// # Panics
    /// On a later period.
    pub fn period(&self, number: usize) -> &[f64] {
        let start = number.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.coefficients[start..self.ends[number]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wavestep_kernels::march::{March, MarchOptions, Reflection};

    #[test]
    fn what_is_held_is_what_the_march_had() {
        let reflection = Reflection::exact(2.0, 2.0, -0.5).unwrap();
        let mut march = March::new(&reflection, MarchOptions::default()).unwrap();
        let (mut held, mut expected) = (HeldWaves::default(), Vec::new());
        for _ in 0..20 {
            held = held.with_period(march.coefficients()).unwrap();
            expected.push(march.coefficients().to_vec());
            march.advance().unwrap();
        }
        for (period, expected) in expected.iter().enumerate() {
            assert_eq!(held.period(period), expected);
        }
        assert!(held.with_period(&vec![0.0; MOST]).is_none());
    }
}
