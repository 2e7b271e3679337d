//! Square roots: conjugates, norms, square roots of polynomials.

use crate::integer::fraction;
use crate::polynomial::Polynomial;
use crate::symbol::Symbol;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

impl Polynomial {
    /// The square roots that occur, ascending by name. O(symbols).
    pub fn roots(&self) -> impl DoubleEndedIterator<Item = &Symbol> + '_ {
        self.symbols.iter().filter(|symbol| symbol.is_root())
    }

    /// Whether no symbol but square roots occurs: the polynomial is an algebraic number. O(symbols).
    pub fn is_algebraic_number(&self) -> bool {
        self.symbols.iter().all(Symbol::is_root)
    }

    /// The polynomial with `−root` in place of `root`. O(terms).
    ///
    /// A product `p · p.conjugate(root)` is free of `root`: `(a + b√n)(a − b√n) = a² − n b²`.
    pub fn conjugate(&self, root: &Symbol) -> Polynomial {
        let mut conjugate = self.clone();
        if let Some(column) = self.column(root) {
            for term in &mut conjugate.terms {
                if term.exponents[column] % 2 == 1 {
                    term.numerator = -std::mem::take(&mut term.numerator);
                }
            }
        }
        conjugate
    }

    /// `(m, N)` with `p · m = N` and `N` free of square roots: for each root, `m` takes up one more
    /// conjugate of the product so far. Neither is zero where `p` is not. One product for each root
    /// and each of the two.
    pub fn norm(&self) -> (Polynomial, Polynomial) {
        let (mut multiplier, mut norm) = (Polynomial::one(), self.clone());
        for root in self.roots() {
            let conjugate = norm.conjugate(root);
            multiplier = &multiplier * &conjugate;
            norm = &norm * &conjugate;
        }
        (multiplier, norm)
    }

    /// `(c, q)` with `p = c q²`, `c` rational and `q` primitive; `None` where there are none, and
    /// where square roots occur. A few products of `q` with its terms.
    ///
    /// A primitive `p` with a positive leading coefficient is `c q²` only with `c = 1` (Gauss's
    /// lemma), and then the leading term of what is left is twice that of `q` times the next.
    pub fn square_root(&self) -> Option<(BigRational, Polynomial)> {
        if self.roots().next().is_some() {
            return None;
        }
        let (content, mut rest) = self.primitive_part();
        if rest.is_zero() {
            return Some((content, Polynomial::one()));
        }
        let symbols = self.symbols.clone();
        let term = |exponents: &[u32], coefficient: &BigRational| {
            let powers: Vec<_> = symbols.iter().zip(exponents.iter().copied()).collect();
            Polynomial::monomial(coefficient, &powers)
        };
        let half_degrees: Vec<u32> = symbols.iter().map(|x| self.degree(x) / 2).collect();
        let (lead, lead_value) = {
            let (exponents, value) = rest.terms().next()?;
            let root = value.numer().sqrt();
            if &(&root * &root) != value.numer() || exponents.iter().any(|e| e % 2 == 1) {
                return None;
            }
            (exponents.iter().map(|e| e / 2).collect::<Vec<u32>>(), root)
        };
        let mut root = term(&lead, &BigRational::from_integer(lead_value.clone()));
        rest -= &root.pow(2);
        let mut last = lead.clone();
        while !rest.is_zero() {
            let next = {
                let (exponents, value) = first_over(&rest, &symbols);
                let steps = exponents.iter().zip(&lead).map(|(e, l)| e.checked_sub(*l));
                let step = steps.collect::<Option<Vec<u32>>>()?;
                let too_high = step.iter().zip(&half_degrees).any(|(e, degree)| e > degree);
                if step >= last || too_high {
                    return None;
                }
                let value = fraction(value.numer().clone(), &lead_value * 2);
                last = step;
                term(&last, &value)
            };
            rest -= &(&next * &(&(&root * &BigRational::from_integer(2.into())) + &next));
            root += &next;
        }
        debug_assert!(root.leading_coefficient().is_positive() && !content.is_zero());
        Some((content, root))
    }
}

/// The first term of a polynomial that is not zero, its exponents over a longer list of symbols.
fn first_over(p: &Polynomial, symbols: &[Symbol]) -> (Vec<u32>, BigRational) {
    let (exponents, value) = p.terms().next().expect("the polynomial is not zero");
    let own = |x: &Symbol| p.column(x).map_or(0, |column| exponents[column]);
    (symbols.iter().map(own).collect(), value)
}
