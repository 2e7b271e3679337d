//! Work in lanes, with the widest registers of the machine.

use super::{Simd, Task, dispatch};
use crate::Level;
use crate::lanes::Lanes;

/// Work that is written in lanes.
pub(crate) trait Work {
    /// What it gives.
    type Output;

    /// Does it. Implementations are inlined, and so is what they call.
    fn run<L: Lanes>(self) -> Self::Output;
}

/// Work in lanes as a task for vectors.
struct InLanes<W>(W);

impl<W: Work> Task for InLanes<W> {
    type Output = W::Output;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> W::Output {
        self.0.run::<S::Eight>()
    }
}

/// Does work with the widest registers that the machine has.
pub(crate) fn widest<W: Work>(work: W) -> W::Output {
    // Every such machine fuses multiply-adds.
    #[cfg(target_arch = "aarch64")]
    return work.run::<super::Eight<super::Scalar<true>, 8>>();
    #[cfg(not(target_arch = "aarch64"))]
    dispatch(Level::Avx512, InLanes(work))
}

/// Eight doubles one by one, for tests that need no machine.
#[cfg(test)]
pub(crate) type OneByOne<const FUSED: bool> = super::Eight<super::Scalar<FUSED>, 8>;

/// Does work in every way that this machine has, the plainest first.
#[cfg(test)]
pub(crate) fn each_way<W: Work + Clone>(work: &W) -> Vec<W::Output> {
    let one_by_one = [work.clone().run::<OneByOne<false>>(), work.clone().run::<OneByOne<true>>()];
    let levels = Level::available().map(|level| dispatch(level, InLanes(work.clone())));
    one_by_one.into_iter().chain(levels).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::WIDTH;

    /// All operations, on numbers of all kinds of sizes.
    #[derive(Clone)]
    struct Operations;

    impl Work for Operations {
        type Output = Vec<[f64; WIDTH]>;

        fn run<L: Lanes>(self) -> Self::Output {
            let a = L::from_array([1.5, -2.25, 0.0, 1e-40, 3.0, -0.0, 7e30, 0.1]);
            let b = L::from_array([0.3, 2.0, -1.0, 5.0, -3.0, 0.0, 1e-20, 11.0]);
            let exponents = L::from_array([-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 40.0]);
            let (sum, rest) = a.two_sum(b);
            let (product, error) = a.product(b);
            [
                a + b,
                a - b,
                a * b,
                -a,
                a.abs(),
                L::splat(0.0).abs(),
                a.lesser(b),
                a.greater(b),
                a.where_positive(b),
                a.where_not_negative(b),
                a.times_power(exponents + L::splat(6755399441055744.0)),
                sum,
                rest,
                product,
                error,
                L::splat(a.sum()),
                L::load(&b.to_array()),
            ]
            .map(L::to_array)
            .to_vec()
        }
    }

    #[test]
    fn all_ways_give_the_same_doubles() {
        let ways = each_way(&Operations);
        let bits = |way: &[[f64; WIDTH]]| -> Vec<_> {
            way.as_flattened().iter().map(|value| value.to_bits()).collect()
        };
        for way in &ways {
            assert_eq!(bits(way), bits(&ways[0]));
        }
        let [sum, rest, product, error] = [11, 12, 13, 14].map(|row| ways[0][row]);
        assert_eq!((sum[3], rest[3]), (5.0, 1e-40));
        assert_eq!((product[0], error[0]), (1.5 * 0.3, 1.5_f64.mul_add(0.3, -(1.5 * 0.3))));
        println!("{} ways", ways.len());
    }

    /// Reciprocals are rough, but as good as is said, and never large.
    #[derive(Clone)]
    struct Reciprocals([f64; WIDTH]);

    impl Work for Reciprocals {
        type Output = [f64; WIDTH];

        fn run<L: Lanes>(self) -> Self::Output {
            L::from_array(self.0).rough_reciprocal().to_array()
        }
    }

    #[test]
    fn reciprocals_have_thirteen_bits() {
        let values = [1.0, -3.0, 1e-20, 7e25, 0.3, -1e-29, 0.0, 1e-300];
        for way in each_way(&Reciprocals(values)) {
            for (value, found) in values.iter().zip(way) {
                let fine = (value * found - 1.0).abs() < 2f64.powi(-13);
                assert!(
                    fine || (value.abs() < 1e-30 && found.abs() <= 1.01e30),
                    "{value}: {found}"
                );
            }
        }
    }
}
