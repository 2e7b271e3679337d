//! Two waves of nearly one frequency: their sum is a carrier times an envelope. The identity is proven
//! in the exact arithmetic of expressions, where equal functions have one form.

use crate::ratio;
use wavestep_polynomial::{Polynomial, Rational, Symbol};

use wavestep::expression::{Expression, Fraction};

/// Both sides of
///
/// ```text
/// U cos(ω₁t − k₁x) + U cos(ω₂t − k₂x) = 2U cos(ω̄t − k̄x) cos(Δω t/2 − Δk x/2),
/// ```
///
/// `ω̄ = (ω₁ + ω₂)/2`, `Δω = ω₁ − ω₂`, likewise `k`, in their normal forms: cosines are sums of
/// exponentials `e^{±i…}`, which are linearly independent for different exponents. The symbols are
/// `omega_1`, `omega_2`, `k_1`, `k_2`, `t`, `x` and `U`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TwoWaves {
    /// The two waves added up.
    pub sum: Expression,
    /// The carrier times the envelope.
    pub product: Expression,
}

impl TwoWaves {
    /// Whether both sides are the same function: whether their difference has no term.
    pub fn holds(&self) -> bool {
        (&self.sum - &self.product).is_zero()
    }
}

fn symbol(name: &str) -> Fraction {
    Fraction::symbol(&Symbol::new(name).expect("a name"))
}

/// `cos a = (e^{ia} + e^{−ia})/2`.
fn cosine(angle: &Fraction) -> Expression {
    let unit = Symbol::square_root(-1).expect("the imaginary unit");
    let turned = angle * &Fraction::from(Polynomial::symbol(&unit));
    let half = ratio(1, 2);
    let minus = turned.scale(&Rational::from_integer((-1).into()));
    (&Expression::exponential(turned) + &Expression::exponential(minus)).scale(&half)
}

/// The sum of two waves and its product form.
pub fn two_waves() -> TwoWaves {
    let phase = |omega: &Fraction, k: &Fraction| &(omega * &symbol("t")) - &(k * &symbol("x"));
    let [omega, k] = ["omega", "k"].map(|name| [1, 2].map(|i| symbol(&format!("{name}_{i}"))));
    let half = ratio(1, 2);
    let mean = |pair: &[Fraction; 2]| (&pair[0] + &pair[1]).scale(&half);
    let half_difference = |pair: &[Fraction; 2]| (&pair[0] - &pair[1]).scale(&half);
    let amplitude = Expression::from(symbol("U"));
    let both = &cosine(&phase(&omega[0], &k[0])) + &cosine(&phase(&omega[1], &k[1]));
    let carrier = cosine(&phase(&mean(&omega), &mean(&k)));
    let envelope = cosine(&phase(&half_difference(&omega), &half_difference(&k)));
    let twice = amplitude.scale(&Rational::from_integer(2.into()));
    TwoWaves { sum: &amplitude * &both, product: &twice * &(&carrier * &envelope) }
}
