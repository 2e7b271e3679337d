//! Square roots: reduction of their powers, conjugates, square roots of polynomials.

use crate::binomial::factorial;
use crate::integer::fraction;
use crate::polynomial::{Monomial, Polynomial, Term};
use crate::symbol::Symbol;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use std::collections::BTreeMap;

/// The same value with exponents of square roots at most 1: by `x² = n`,
///
/// ```text
/// x^[j] = x^j/j! = n^{⌊j/2⌋}/j! · x^{j mod 2}
/// ```
///
/// O(terms) where nothing is to be done, else O(terms · log).
pub(crate) fn reduce_roots(
    symbols: &[Symbol],
    mut terms: Vec<Term>,
    mut denominator: BigInt,
) -> (Vec<Term>, BigInt) {
    for (column, symbol) in symbols.iter().enumerate() {
        let Some(square) = symbol.square() else { continue };
        let highest = terms.iter().map(|term| term.exponents[column]).max().unwrap_or(0);
        if highest < 2 {
            continue;
        }
        let scale = factorial(highest);
        let factor = |j: u32| BigInt::from(square).pow(j / 2) * (&scale / factorial(j));
        let factors: Vec<BigInt> = (0..=highest).map(factor).collect();
        let mut sums = BTreeMap::<Monomial, BigInt>::new();
        for mut term in terms {
            let exponent = &mut term.exponents[column];
            let numerator = term.numerator * &factors[*exponent as usize];
            *exponent %= 2;
            *sums.entry(term.exponents).or_default() += numerator;
        }
        let descending = sums.into_iter().rev();
        terms = descending.map(|(exponents, numerator)| Term { exponents, numerator }).collect();
        denominator *= scale;
    }
    (terms, denominator)
}

impl Polynomial {
    /// The square roots that occur, ascending by name. O(symbols).
    ///
    /// ```
    /// use wavestep_polynomial::{Polynomial, Symbol};
    /// let p: Polynomial = "x + sqrt(2)*sqrt(-1)".parse().unwrap();
    /// assert!(p.roots().eq([-1, 2].map(|n| Symbol::square_root(n).unwrap()).iter()));
    /// ```
    pub fn roots(&self) -> impl DoubleEndedIterator<Item = &Symbol> + '_ {
        self.symbols.iter().filter(|symbol| symbol.is_root())
    }

    /// Whether no symbol but square roots occurs: the polynomial is an algebraic number. O(symbols).
    ///
    /// ```
    /// use wavestep_polynomial::Polynomial;
    /// let is_number = |text: &str| text.parse::<Polynomial>().unwrap().is_algebraic_number();
    /// assert!(is_number("1/2 + 1/2*sqrt(5)") && is_number("7") && !is_number("x*sqrt(5)"));
    /// ```
    pub fn is_algebraic_number(&self) -> bool {
        self.symbols.iter().all(Symbol::is_root)
    }

    /// The polynomial with `−root` in place of `root`. O(terms).
    ///
    /// A product `p · p.conjugate(root)` is free of `root`: `(a + b√n)(a − b√n) = a² − n b²`.
    ///
    /// ```
    /// use wavestep_polynomial::{Polynomial, Symbol};
    /// let p: Polynomial = "x + sqrt(2)".parse().unwrap();
    /// let conjugate = p.conjugate(&Symbol::square_root(2).unwrap());
    /// assert_eq!(conjugate.to_string(), "-sqrt(2) + x");
    /// assert_eq!((&p * &conjugate).to_string(), "x^2 - 2");
    /// ```
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
    ///
    /// ```
    /// use wavestep_polynomial::Polynomial;
    /// let p: Polynomial = "1 + sqrt(2) + sqrt(3)".parse().unwrap();
    /// let (multiplier, norm) = p.norm();
    /// assert_eq!(norm, Polynomial::integer(-8));
    /// assert_eq!(&p * &multiplier, norm);
    /// ```
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
    ///
    /// ```
    /// use wavestep_polynomial::{Polynomial, Rational};
    /// let p: Polynomial = "-2*x^2 + 4*x*y - 2*y^2".parse().unwrap();
    /// let (c, q) = p.square_root().unwrap();
    /// assert_eq!((c, q.to_string()), (Rational::from_integer((-2).into()), "x - y".to_owned()));
    /// assert!("x^2 + 1".parse::<Polynomial>().unwrap().square_root().is_none());
    /// ```
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
