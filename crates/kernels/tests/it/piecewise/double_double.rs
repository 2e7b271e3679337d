//! Sums and products without loss, against exact arithmetic.

use crate::piecewise::support::*;
use wavestep_kernels::double_double::*;

/// Doubles of all signs and of many sizes, with few and with many bits.
fn double(random: &mut Random, range: i32) -> f64 {
    let exponent = random.bits() as i32 % range;
    let bits = [1, 5, 26, 27, 52][random.bits() as usize % 5];
    let mantissa = f64::from_bits(random.unit().to_bits() & !((1 << (52 - bits)) - 1));
    let sign = if random.bits() & 1 == 0 { 1.0 } else { -1.0 };
    sign * mantissa * 2.0_f64.powi(exponent)
}

fn equal(a: &Dyadic, b: &Dyadic) -> bool {
    a.subtract(b).is_zero()
}

#[test]
fn sums_and_products_lose_nothing() {
    let mut random = Random(21);
    for _ in 0..20_000 {
        let (a, b) = (double(&mut random, 120), double(&mut random, 120));
        let (exact_a, exact_b) = (Dyadic::new(a), Dyadic::new(b));
        let (sum, error) = two_sum(a, b);
        let exact = exact_a.add(&exact_b);
        assert!(exact.rounds_to(sum) && equal(&exact, &Dyadic::new(sum).add(&Dyadic::new(error))));
        let (large, small) = if a.abs() >= b.abs() { (a, b) } else { (b, a) };
        assert_eq!(fast_two_sum(large, small), (sum, error));
        let (product, error) = two_product(a, b);
        let exact = exact_a.multiply(&exact_b);
        assert!(exact.rounds_to(product));
        assert!(equal(&exact, &Dyadic::new(product).add(&Dyadic::new(error))));
    }
}

/// The relative errors of a sum and of a product that are proven.
const SUM_ERROR: f64 = 3.0001 * UNIT * UNIT;
const PRODUCT_ERROR: f64 = 7.0 * UNIT * UNIT;

#[test]
fn pairs_add_and_multiply_within_their_bounds() {
    let mut random = Random(23);
    let exact = |x: DoubleDouble| Dyadic::new(x.high()).add(&Dyadic::new(x.low()));
    let (mut worst_sum, mut worst_product) = (0.0_f64, 0.0_f64);
    for _ in 0..20_000 {
        let mut pair = || {
            let high = double(&mut random, 30);
            DoubleDouble::from_sum(high, high * 2.0_f64.powi(-53) * random.signed())
                .expect("finite")
        };
        let (a, b) = (pair(), pair());
        for (computed, exact_result, bound, worst) in [
            (a + b, exact(a).add(&exact(b)), SUM_ERROR, &mut worst_sum),
            (a * b, exact(a).multiply(&exact(b)), PRODUCT_ERROR, &mut worst_product),
        ] {
            assert_eq!(two_sum(computed.high(), computed.low()), (computed.high(), computed.low()));
            let error = exact(computed).subtract(&exact_result).abs();
            let allowed = exact_result.abs().multiply(&Dyadic::new(bound));
            assert!(error.at_most(&allowed), "{a:?} {b:?}");
            if !allowed.is_zero() {
                *worst = worst.max(error.approximate() / allowed.approximate());
            }
        }
    }
    println!("{worst_sum:.2} and {worst_product:.2} of the bounds");
    assert!(worst_sum > 0.2 && worst_product > 0.2);
    assert_eq!(DoubleDouble::from_sum(f64::MAX, f64::MAX), None);
    assert_eq!(DoubleDouble::from_sum(f64::NAN, 0.0), None);
}
