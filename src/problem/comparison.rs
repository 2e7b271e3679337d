//! A quantity on a window, and how far simpler answers are from it: the largest difference over the largest value.

use super::{Other, Problem, ProblemError, Size, Wanted};
use crate::planner::Purpose;
use crate::signal::Signal;
use num_traits::Zero as _;
use std::cell::OnceCell;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// The digits and bits of a size that is to be told from a tolerance.
const TOLD: (usize, u64) = (9, 1 << 12);

/// For what sizes and differences are prepared.
pub(super) const PURPOSE: Purpose = Purpose::Size { digits: TOLD.0 };

/// A difference of this part of the tolerance need not be known any better, and no smaller part of the largest value.
const PART_OF_TOLERANCE: i64 = 1 << 20;
const PART_OF_LARGEST: i64 = 1_000_000_000_000;

/// What simpler answers are compared with.
pub(super) struct Comparison<'p> {
    pub problem: &'p Problem,
    pub wanted: &'p Wanted,
    pub window: [&'p Rational; 2],
    pub signal: Rc<dyn Signal + 'p>,
    /// The same as its arrivals tell it, once that is asked for.
    closed: OnceCell<Rc<dyn Signal + 'p>>,
    /// The largest value of the quantity, which is not zero.
    pub largest: Size,
}

impl<'p> Comparison<'p> {
    /// # Errors
    /// [`ProblemError::AllZero`] where the quantity is zero on the window; else as [`Problem::signal_on`].
    pub fn new(
        problem: &'p Problem,
        wanted: &'p Wanted,
        window: [&'p Rational; 2],
    ) -> Result<Comparison<'p>, ProblemError> {
        let signal: Rc<dyn Signal> = Rc::from(problem.signal_on(wanted, window, PURPOSE)?);
        let largest = Size::of(&*signal, TOLD, &Rational::zero())?;
        if largest.bounds[0].is_zero() {
            return Err(ProblemError::AllZero(wanted.name.clone()));
        }
        Ok(Comparison { problem, wanted, window, signal, closed: OnceCell::new(), largest })
    }

    /// The quantity less what an answer says of it.
    pub fn difference<'o>(
        &'o self,
        other: &'o Other,
    ) -> Result<Box<dyn Signal + 'o>, ProblemError> {
        let Comparison { problem, wanted, window, .. } = self;
        let Other::Arrivals(count) = other else {
            let own = Rc::clone(&self.signal);
            return problem.difference_from(own, other.into(), wanted, *window, PURPOSE);
        };
        problem.after_arrivals(Rc::clone(self.closed()?), *count, *window)
    }

    /// The quantity as its arrivals tell it.
    fn closed(&self) -> Result<&Rc<dyn Signal + 'p>, ProblemError> {
        if self.closed.get().is_none() {
            let found = self.problem.closed_until(self.wanted, self.window[1])?;
            return Ok(self.closed.get_or_init(|| found));
        }
        Ok(self.closed.get().expect("it is known"))
    }

    /// How many arrivals there are from the start to the end of the window, where they can be counted; else how many
    /// breaks on the window.
    pub fn arrivals(&self) -> Result<usize, ProblemError> {
        let count = |signal: &Rc<dyn Signal + 'p>| -> Result<usize, ProblemError> {
            let stretches = (0..signal.count()?).filter(|stretch| !signal.is_instant(*stretch));
            Ok(stretches.count() - 1)
        };
        // Where echoes take too much memory, the scene is followed.
        self.closed().and_then(count).or_else(|_| count(&self.signal))
    }

    /// The largest difference of an answer over the largest value, between two bounds: near ones, or where the tolerance
    /// lies between these, ones to nine digits.
    pub fn share(
        &self,
        other: &Other,
        tolerance: &Rational,
    ) -> Result<[Rational; 2], ProblemError> {
        let difference = self.difference(other)?;
        let least = &self.largest.bounds[0];
        let negligible = (tolerance / Rational::from_integer(PART_OF_TOLERANCE.into()))
            .min(Rational::new(1.into(), PART_OF_LARGEST.into()))
            * least;
        let over = |size: Size| size.over(&self.largest).expect("the largest value is not zero");
        let near = over(Size::near(&*difference, &negligible)?);
        match near[0] <= *tolerance && *tolerance < near[1] {
            true => Ok(over(Size::of(&*difference, TOLD, &negligible)?)),
            false => Ok(near),
        }
    }
}
