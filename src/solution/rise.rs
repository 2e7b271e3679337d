//! The rise of the force in a local contact between long bars, in closed form.
//!
//! `β' = 1 − β^m`, `β(0) = 0` has separated variables (6.47, 6.50). With m = P/Q in lowest terms and `β = p^Q` the
//! time is the integral of a rational function,
//!
//! ```text
//! dt̄/dp = Q p^(Q−1)/(1 − p^P),    φ = β^m = p^P.
//! ```
//!
//! Its poles are the roots `e^(ia)` of one, `a = 2πk/P`, with residues `−(Q/P) e^(ib)`, `b = Qa`. The logarithms of
//! conjugate ones are real together, so that
//!
//! ```text
//! t̄ = (Q/P) [−ln(1 − p) + ln(1 + p) − Σ cos b ln(p² − 2 p cos a + 1) + 2 Σ sin b arctan(p sin a/(1 − p cos a))]
//!     − Σ_j Q/(Q − jP) p^(Q−jP),
//! ```
//!
//! with `ln(1 + p)` where P is even (Q is odd then), sums over `0 < a < π`, and powers above zero. For p < 1 all logarithms
//! are those of positive numbers, and the arctangents those of positive denominators. For m = 3/2 this is 6.51.

use wavestep_polynomial::Rational;

/// The closed form of the time by `p`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Rise {
    /// P and Q.
    pub exponents: [u32; 2],
    /// Coefficients and exponents of the powers of p that are taken away.
    pub powers: Vec<(Rational, u32)>,
    /// The angles a and b of the pairs of conjugate poles, in parts of a full turn, from 0 to below 1.
    pub pairs: Vec<[Rational; 2]>,
}

impl Rise {
    /// Formulas with more logarithms are no use.
    const MOST_POLES: u32 = 24;

    /// `None` where there are too many poles, or powers.
    pub fn new(exponent: &Rational) -> Option<Rise> {
        let [poles, root] = [exponent.numer(), exponent.denom()]
            .map(|part| u32::try_from(part).ok().filter(|part| *part <= Rise::MOST_POLES));
        let (poles, root) = (poles.filter(|poles| *poles > 0)?, root?);
        let part = |top: u32, bottom: u32| Rational::new(top.into(), bottom.into());
        let left = (1..).map_while(|j| root.checked_sub(j * poles)).take_while(|power| *power > 0);
        let powers = left.map(|power| (part(root, power), power)).collect();
        let pairs = (1..poles.div_ceil(2)).map(|k| [k, k * root % poles]);
        let pairs = pairs.map(|angles| angles.map(|angle| part(angle, poles))).collect();
        Some(Rise { exponents: [poles, root], powers, pairs })
    }

    /// Q/P.
    pub fn factor(&self) -> Rational {
        let [poles, root] = self.exponents;
        Rational::new(root.into(), poles.into())
    }

    /// Whether −1 is a pole.
    pub fn has_second_real_pole(&self) -> bool {
        self.exponents[0].is_multiple_of(2)
    }
}
