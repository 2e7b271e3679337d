//! The formulas as a textbook prints them, expanded in powers and evaluated by Horner's scheme. They
//! are right on paper and fail in doubles: terms of alternating sign reach `e^{2√(jX)}` before they
//! cancel to a value of order 1. They are kept to show where.

use super::description::{Echoes, Family};
use super::error::EchoError;

/// `Σ_j row[j] s^j` by Horner's scheme; one multiplication and one addition a coefficient.
///
/// ```
/// use wavestep_kernels::echoes::horner;
/// assert_eq!(horner(&[1.0, -2.0, 3.0], 2.0), 9.0);
/// assert_eq!(horner(&[], 2.0), 0.0);
/// ```
pub fn horner(row: &[f64], s: f64) -> f64 {
    row.iter().rev().fold(0.0, |sum, coefficient| sum * s + coefficient)
}

/// A wave in the form of periods, `f(nD + s) = e^{−bs} P_n(s)`, with the coefficients of `P_n` at
/// fixed parameters as doubles: the rows are computed elsewhere, exactly, and rounded once.
///
/// ```
/// use wavestep_kernels::echoes::ExpandedPeriods;
///
/// // The rigid mass on its first two periods, D = 2: P_0 = 1, P_1 = 1 + e^{−2} − 2s.
/// let rows = vec![vec![1.0], vec![1.0 + (-2f64).exp(), -2.0]];
/// let periods = ExpandedPeriods::new(1.0, 2.0, rows)?;
/// assert_eq!(periods.value(0.0)?, 1.0);
/// let echoes = (-3f64).exp() - (-1f64).exp();
/// assert!((periods.value(3.0)? - echoes).abs() < 1e-15);
/// assert!(periods.value(4.0).is_err());
/// # Ok::<(), wavestep_kernels::echoes::EchoError>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct ExpandedPeriods {
    rate: f64,
    period: f64,
    rows: Vec<Vec<f64>>,
}

impl ExpandedPeriods {
    /// The form with rate `b`, period `D` and one row of coefficients a period, constant first.
    ///
    /// # Errors
    /// When the period is not positive or the rate not finite.
    pub fn new(rate: f64, period: f64, rows: Vec<Vec<f64>>) -> Result<ExpandedPeriods, EchoError> {
        if !rate.is_finite() || !period.is_finite() {
            return Err(EchoError::NotFinite);
        }
        if period <= 0.0 {
            return Err(EchoError::PeriodNotPositive);
        }
        Ok(ExpandedPeriods { rate, period, rows })
    }

    /// `f(T)`, with `T/D` and `T − nD` as doubles give them: at an arrival, the limit from the
    /// right. Before 0 the wave is 0. It costs one operation a coefficient.
    ///
    /// # Errors
    /// When the time is not finite, or no row is there for its period.
    pub fn value(&self, time: f64) -> Result<f64, EchoError> {
        if !time.is_finite() {
            return Err(EchoError::NotFinite);
        }
        if time < 0.0 {
            return Ok(0.0);
        }
        let period = (time / self.period).floor();
        let s = time - period * self.period;
        let period = period as usize;
        let row = self.rows.get(period).ok_or(EchoError::NoRow { period })?;
        Ok((-self.rate * s).exp() * horner(row, s))
    }
}

impl Echoes {
    /// The coefficients of echo `k` in powers of `x`, rounded: `Σ_i c_i ρ^k q_{k−i}(cx)`, by the
    /// recurrence `a_{j+1} = −a_j c (k−j)/(j+1)²` on `L_k(cx) = Σ_j C(k,j) (−c)^j x^j/j!`. The echo is
    /// that polynomial times `e^{−bx}`. It costs two operations a coefficient; those of the first
    /// echoes that do not follow the rule are not asked for here.
    ///
    /// ```
    /// use wavestep_kernels::echoes::{Echoes, Expansion, Family, Term};
    ///
    /// let [one, two] = [Expansion::ONE, Expansion::try_from(2.0)?];
    /// let terms = [Term { lag: 0, coefficient: one }];
    /// let wave = Echoes::new(Family::Laguerre, one, two, one, &terms, two)?;
    /// // L_2(2x) = 1 − 4x + 2x²
    /// assert_eq!(wave.expanded_row(2), [1.0, -4.0, 2.0]);
    /// # Ok::<(), wavestep_kernels::echoes::EchoError>(())
    /// ```
    pub fn expanded_row(&self, k: usize) -> Vec<f64> {
        let scale = self.scale.high();
        let ratio = self.ratio.high().powi(k as i32);
        let mut row = vec![0.0; self.largest_index(k).map_or(0, |index| index + 1)];
        for term in &self.terms {
            let Some(index) = k.checked_add_signed(-term.lag) else { continue };
            let mut coefficient = term.coefficient.high() * ratio;
            for (j, place) in row[..=index].iter_mut().enumerate() {
                let next = (j + 1) as f64;
                match self.family {
                    Family::Laguerre => {
                        *place += coefficient;
                        coefficient *= -scale * (index - j) as f64 / (next * next);
                    }
                    Family::Powers => {
                        *place += if j == index { coefficient } else { 0.0 };
                        coefficient *= scale / next;
                    }
                }
            }
        }
        row
    }
}

/// Echo `k` at `T − kD` as doubles give it, by Horner's scheme on its expanded row.
pub(super) fn expanded(echoes: &Echoes, k: usize, time: f64) -> f64 {
    let since = time - k as f64 * echoes.period.high();
    (-since * echoes.rate.high()).exp() * horner(&echoes.expanded_row(k), since)
}
