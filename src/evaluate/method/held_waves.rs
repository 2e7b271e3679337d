//! The response on all periods of a window, as a march with a certificate leaves it.
//!
//! A proof marches through all periods. Where these are few their polynomials are held, so that values
//! need no second march.

use wavestep_kernels::march::chebyshev;

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
    pub fn and(mut self, coefficients: &[f64]) -> Option<HeldWaves> {
        self.coefficients.extend_from_slice(coefficients);
        self.ends.push(self.coefficients.len());
        (self.coefficients.len() <= MOST).then_some(self)
    }

    /// The values at places of a period that is held.
    ///
    /// # Panics
    /// On a later period, and where `points` and `values` differ in length.
    pub fn values(&self, period: usize, points: &[f64], values: &mut [f64]) {
        let start = period.checked_sub(1).map_or(0, |before| self.ends[before]);
        let coefficients = &self.coefficients[start..self.ends[period]];
        chebyshev::values(coefficients, points, values);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wavestep_kernels::march::{March, MarchOptions, Reflection};

    /// Bit for bit what the march gives on its way.
    #[test]
    fn values_are_those_of_the_march() {
        let reflection = Reflection::exact(2.0, 2.0, -0.5).unwrap();
        let mut march = March::new(&reflection, MarchOptions::default()).unwrap();
        let points = [0.0, 0.25, 0.7, 1.0];
        let (mut held, mut expected) = (HeldWaves::default(), Vec::new());
        for _ in 0..20 {
            held = held.and(march.coefficients()).unwrap();
            expected.push(points.map(|x| march.value(x)));
            march.advance().unwrap();
        }
        for (period, expected) in expected.iter().enumerate() {
            let mut found = [0.0; 4];
            held.values(period, &points, &mut found);
            assert_eq!(found, *expected);
        }
        assert!(held.and(&vec![0.0; MOST]).is_none());
    }
}
