//! Whether a relation between waves follows from a recurrence, for every n at once.

use crate::recurrence::{LinearForm, Step};
use crate::solution::elimination::reduce;
use crate::solution::solved::Solution;

impl Solution {
    /// Whether it is proven that a form in the waves is zero on every period.
    ///
    /// Explicit waves are put in until base waves `w` are left, each with its equation
    ///
    /// ```text
    /// E = a(q) w' + b(q) w + … = 0,     a(0) = 1, or a = 0 and b(0) = 1
    /// ```
    ///
    /// with `q` the shift by one period. Where the form is `R = α(q) w' + β(q) w + …`, the form
    /// `a R − α E` holds no `w'` any more, and `b R − β E` no `w` where there are no slopes. If nothing is
    /// left after all equations have been used so, then `p(q) R = 0` on every period, `p` a product of
    /// such `a` and `b`. Since `p(0) = 1` and all is zero for `n < 0`, `R[n] = 0` follows from
    /// `R[0] = … = R[n−1] = 0`, thus for every n. A sum over earlier periods is removed first by
    /// `(1 − q) R`, whose first coefficient is 1 as well.
    ///
    /// `false` says that this found no proof, not that the form is not zero.
    #[must_use]
    pub fn is_always_zero(&self, form: &LinearForm) -> bool {
        let time = &self.recurrence().statement().time;
        let mut rest = form.without_sums();
        if rest.is_zero() {
            return true;
        }
        let Some(reduced) = reduce(self.recurrence()) else { return false };
        for (wave, by) in &reduced.derived {
            if !rest.replace(*wave, by, time) {
                return false;
            }
        }
        if rest.is_zero() {
            return true;
        }
        // Slopes first: their equations bring in values of other waves.
        let (slopes, values): (Vec<&Step>, Vec<&Step>) =
            reduced.base.iter().partition(|step| step.start.is_some());
        for step in slopes.into_iter().rev().chain(values) {
            let equation = step.equation.without_sums();
            let [own, law] = [&rest, &equation].map(|form| form.operator(step.wave));
            let (own, law) = match step.start {
                Some(_) => (own.slope, law.slope),
                None if own.slope.is_empty() => (own.value, law.value),
                None => return false,
            };
            if own.is_empty() {
                continue;
            }
            if law.get(0).is_none() {
                return false;
            }
            let mut eliminated = LinearForm::zero();
            eliminated.add_product(&rest, &law);
            eliminated.add_product(&-&equation, &own);
            rest = eliminated;
        }
        rest.is_zero()
    }
}
