//! Delays: sums of travel times, counted on a grid or on a lattice of several.

use crate::expression::{Expression, Fraction};
use num_integer::Integer as _;
use num_traits::{One, ToPrimitive};
use wavestep_polynomial::{Integer, Rational};

/// The times at which waves can arrive: all `Σ_c k_c D_c` with whole numbers `k_c`, where no two of
/// the `D_c` have a rational ratio, or only a very fine common measure. One `D` alone is a grid.
///
/// Whether two times are commensurate is decided exactly: their quotient is a rational number, or
/// it is not.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lattice {
    periods: Vec<Fraction>,
}

impl Lattice {
    /// The coarsest lattice that holds these times, and each of them counted on it.
    ///
    /// # Panics
    /// Where a time is zero.
    pub fn spanned_by(times: &[Fraction]) -> (Lattice, Vec<Vec<i64>>) {
        // The class of each time, and its ratio to the first of the class.
        let mut classes: Vec<Class> = Vec::new();
        let mut places = Vec::new();
        for time in times {
            let joined = classes.iter_mut().enumerate().find_map(|(c, class)| {
                let ratio = Expression::from(time.clone()).proportion(&class.of.clone().into())?;
                class.join(&ratio).then_some((c, ratio))
            });
            places.push(joined.unwrap_or_else(|| {
                let (of, one) = (time.clone(), Rational::one());
                classes.push(Class { of, step: one.clone(), largest: one.clone() });
                (classes.len() - 1, one)
            }));
        }
        let count = |(class, ratio): (usize, Rational)| {
            let mut counts = vec![0; classes.len()];
            let steps: Rational = ratio / &classes[class].step;
            counts[class] = steps.to_integer().to_i64().expect("at most the largest count");
            counts
        };
        let counts = places.into_iter().map(count).collect();
        let periods = classes.iter().map(|class| class.of.scale(&class.step)).collect();
        (Lattice { periods }, counts)
    }

    /// The lattice that is coarser by a factor in each direction.
    pub(crate) fn coarsened(&self, factors: &[i64]) -> Lattice {
        let scaled = |(period, factor): (&Fraction, &i64)| {
            period.scale(&Rational::from_integer((*factor).into()))
        };
        Lattice { periods: self.periods.iter().zip(factors).map(scaled).collect() }
    }

    /// The periods `D_c`.
    pub fn periods(&self) -> &[Fraction] {
        &self.periods
    }

    /// `Σ_c k_c D_c`.
    pub fn delay(&self, counts: &[i64]) -> Fraction {
        let part = |(period, count): (&Fraction, &i64)| {
            period.scale(&Rational::from_integer((*count).into()))
        };
        let parts = self.periods.iter().zip(counts).map(part);
        parts.fold(Fraction::zero(), |sum, part| &sum + &part)
    }
}

/// The most steps of a common measure in one time: finer measures count as none.
const MAX_COUNT: i64 = 1_000;

/// Times in rational proportions, by the first of them: their common measure, and the largest.
struct Class {
    of: Fraction,
    step: Rational,
    largest: Rational,
}

impl Class {
    /// Takes one more in, where the common measure does not become too fine.
    fn join(&mut self, ratio: &Rational) -> bool {
        let step = common_measure(&self.step, ratio);
        let largest = ratio.max(&self.largest).clone();
        let coarse = &largest / &step <= Rational::from_integer(MAX_COUNT.into());
        if coarse {
            (self.step, self.largest) = (step, largest);
        }
        coarse
    }
}

/// The greatest rational number of which both are whole multiples.
pub fn common_measure(a: &Rational, b: &Rational) -> Rational {
    let common: Integer = a.denom().lcm(b.denom());
    let whole = |value: &Rational| (value * Rational::from_integer(common.clone())).to_integer();
    Rational::new(whole(a).gcd(&whole(b)), common)
}
