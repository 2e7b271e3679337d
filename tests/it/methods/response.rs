//! The rigid mass by a march in fixed-point numbers, with some thirty proven digits: another way to
//! values, and a fast one, whatever the order.

use crate::methods::exact;
use num_rational::BigRational;
use wavestep::signal::Limit;
use wavestep_kernels::fixed::{
    DelayEquation, FRACTION_BITS, March, MarchOptions, Position, Reduction,
};

/// `f` of the recurrence `rigid-mass`: `f' + f = f[n−1]' − f[n−1]`, of period 2μ.
pub struct Response {
    march: March,
    reduction: Reduction,
}

impl Response {
    pub fn new(mu: &BigRational, periods: u32) -> Response {
        let one = exact(1.0);
        let period = mu * exact(2.0);
        let equation = DelayEquation::new(&period, &one, &one, &one).expect("an equation");
        let march = March::new(&equation, periods, &MarchOptions::default()).expect("a march");
        assert!(march.bound() < 1e-24, "{:e}", march.bound());
        let reduction = Reduction::new(&period, &exact(0.0)).expect("a period");
        Response { march, reduction }
    }

    /// What encloses the value at a double.
    pub fn at(&self, time: f64) -> (BigRational, BigRational) {
        let position = self.reduction.of_double(time, Limit::Right);
        self.ends(position.expect("a position").expect("a time after the start"))
    }

    /// What encloses the value at an exact time.
    pub fn at_exactly(&self, time: &BigRational, side: Limit) -> (BigRational, BigRational) {
        match self.reduction.of_rational(time, side).expect("a position") {
            Some(position) => self.ends(position),
            // Before the start.
            None => (exact(0.0), exact(0.0)),
        }
    }

    fn ends(&self, position: Position) -> (BigRational, BigRational) {
        let value = self.march.value(&position).expect("a period of the march");
        let unit = exact((-f64::from(FRACTION_BITS)).exp2());
        let middle = BigRational::from_integer(value.midpoint.into());
        let radius = BigRational::from_integer(value.radius.into());
        ((&middle - &radius) * &unit, (middle + radius) * unit)
    }
}
