//! Echoes as rows of integers, and pieces streamed from them term by term.

use wavestep_polynomial::{Integer, IntegerRef, IntegerRow, Rational, Univariate};

/// One echo whose constants are all rational numbers,
///
/// ```text
/// φ(x) = Σ_i e^{λ_i x} P_i(x)
/// ```
///
/// with each `P_i` a row of integers in divided powers.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct EchoRow {
    /// Exponents `λ_i` (pairwise different) and polynomials `P_i` (none zero).
    pub parts: Vec<(Rational, Univariate)>,
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
    /// The power of the local variable.
    pub local_power: u32,
    /// The power of the period.
    pub period_power: u32,
    /// The integer in front.
    pub numerator: IntegerRef<'a>,
    /// The shared denominator of the row.
    pub denominator: &'a Integer,
}

/// Calls `visit` for every term of the n-th piece `Σ_k φ_k(s + (n−k)D)`, `rows[k] = φ_k`.
///
/// By Taylor's theorem a coefficient `c_{k,j}` of `x^j/j!` gives, with `m = n−k` and `j = i+l`,
/// the integer `c_{k,i+l} m^l`: one product a term, and nothing is added up, since no two terms
/// agree in `λ, m, i, l`. Zero coefficients are passed over.
///
/// # Panics
/// Where a row up to the n-th is missing.
pub fn expand_piece(rows: &[EchoRow], n: usize, mut visit: impl FnMut(ExpandedTerm<'_>)) {
    let mut spare = IntegerRow::default();
    for (k, row) in rows[..=n].iter().enumerate() {
        let age = u32::try_from(n - k).expect("orders fit 32 bits");
        for (rate, polynomial) in &row.parts {
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
}
