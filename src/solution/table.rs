//! Echoes as rows of integers: the factored table from which pieces are streamed term by term.
//!
//! `docs/divided-powers.md` proves that they are integers, and counts them.

use std::rc::Rc;
use wavestep_polynomial::{Integer, IntegerRef, IntegerRow, Rational, Univariate};

/// One echo whose constants are all rational numbers,
///
/// ```text
/// φ(x) = Σ_i e^{λ_i x} P_i(x)
/// ```
///
/// with each `P_i` a row of integers in divided powers.
///
/// # Invariants
/// - the exponents `λ_i` are pairwise different, no `P_i` is zero.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct EchoRow {
    pub parts: Vec<(Rational, Rc<Univariate>)>,
}

impl EchoRow {
    /// `Σ_i e^{λ_i x} P_i(x)`, the `λ_i` pairwise different.
    pub(crate) fn new(parts: impl IntoIterator<Item = (Rational, Univariate)>) -> EchoRow {
        let parts = parts.into_iter().filter(|(_, polynomial)| !polynomial.is_zero());
        EchoRow { parts: parts.map(|(rate, polynomial)| (rate, Rc::new(polynomial))).collect() }
    }
}

/// One term of a piece expanded in the local variable `s` and the period `D`:
///
/// ```text
/// numerator/denominator · e^{λ (s + mD)} · s^i/i! · D^l/l!
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ExpandedTerm<'a> {
    /// The exponent `λ`.
    pub rate: &'a Rational,
    /// The number `m` of periods that the echo is old.
    pub age: u32,
    pub local_power: u32,
    pub period_power: u32,
    /// The integer in front.
    pub numerator: IntegerRef<'a>,
    /// The shared denominator of the row.
    pub denominator: &'a Integer,
}

/// The echoes `φ_0 … φ_N` of a wave whose constants are all rational numbers: the factored form of
/// all its pieces up to the N-th, about N²/2 integers from which the N³/6 terms of a piece follow
/// by a product each.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct EchoTable {
    pub rows: Vec<EchoRow>,
}

impl EchoTable {
    /// Calls `visit` for every term of the n-th piece `Σ_k φ_k(s + (n−k)D)`.
    ///
    /// By Taylor's theorem a coefficient `c_{k,j}` of `x^j/j!` gives, with `m = n−k` and `j = i+l`,
    /// the integer `c_{k,i+l} m^l`: one product a term and no sums, since no two terms
    /// agree in `λ, m, i, l`. Zero coefficients are passed over.
    pub fn for_each_term(&self, n: usize, mut visit: impl FnMut(ExpandedTerm<'_>)) {
        let mut spare = IntegerRow::default();
        for (age, rate, polynomial) in self.parts(n) {
            let denominator = polynomial.denominator();
            let mut scaled = polynomial.coefficients().clone();
            let count = if age == 0 { 1 } else { scaled.len() };
            for period_power in 0..count as u32 {
                for (local_power, numerator) in (0..).zip(scaled.iter()) {
                    if !numerator.is_zero() {
                        visit(ExpandedTerm {
                            rate,
                            age,
                            local_power,
                            period_power,
                            numerator,
                            denominator,
                        });
                    }
                }
                scaled.advance(u64::from(age), &mut spare);
            }
        }
    }

    /// Ages, rates and polynomials of the echoes that make up the n-th piece.
    fn parts(&self, n: usize) -> impl Iterator<Item = (u32, &Rational, &Univariate)> {
        self.rows[..=n].iter().enumerate().flat_map(move |(k, row)| {
            let age = u32::try_from(n - k).expect("orders fit 32 bits");
            row.parts.iter().map(move |(rate, polynomial)| (age, rate, &**polynomial))
        })
    }
}
