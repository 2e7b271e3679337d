//! The sparse multivariate polynomial: its representation, its normal form, its queries.

use crate::binomial::factorial;
use crate::symbol::Symbol;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use smallvec::SmallVec;
use std::sync::Arc;

/// Exponents of one term, one for each symbol of the polynomial that holds it.
pub(crate) type Monomial = SmallVec<[u32; 4]>;

/// One term: `numerator · Π_i x_i^{a_i} / a_i!`, before the polynomial's denominator.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub(crate) struct Term {
    pub exponents: Monomial,
    pub numerator: BigInt,
}

/// A polynomial over the rationals in named symbols.
///
/// ```text
/// p = (1/d) Σ_α c_α Π_i x_i^{α_i} / α_i!         c_α, d integers, d > 0
/// ```
///
/// Coefficients are held in the *divided-power* basis `x^[j] = x^j/j!`, as integers over one
/// shared denominator `d`: there a derivative and an antiderivative are shifts of exponents, a
/// Taylor shift by a symbol makes no denominator, and no fraction is reduced until it is shown.
///
/// # Order of terms
/// Symbols are ordered by name. Terms are in descending lexicographic order of their exponents,
/// the first symbol weighing most. Polynomials are ordered (`Ord`) by symbols, terms, then
/// denominator: a total order without algebraic meaning, for use as keys.
///
/// # Invariants
/// - symbols strictly ascending, each with a positive exponent somewhere;
/// - terms strictly descending, numerators non-zero;
/// - `d > 0` and `gcd(d, all numerators) = 1`; the zero polynomial has `d = 1`.
///
/// Equal polynomials therefore have one representation, and `==` compares it.
///
/// ```
/// use wavestep_polynomial::Polynomial;
/// let p: Polynomial = "1/2*x^2 - y".parse().unwrap();
/// let q: Polynomial = "x + y".parse().unwrap();
/// assert_eq!((&p * &q).to_string(), "1/2*x^3 + 1/2*x^2*y - x*y - y^2");
/// ```
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Polynomial {
    pub(crate) symbols: Arc<[Symbol]>,
    pub(crate) terms: Vec<Term>,
    pub(crate) denominator: BigInt,
}

impl Polynomial {
    /// The polynomial 0.
    pub fn zero() -> Polynomial {
        Polynomial { symbols: Arc::default(), terms: Vec::new(), denominator: BigInt::one() }
    }

    /// The polynomial 1.
    pub fn one() -> Polynomial {
        Polynomial::integer(1)
    }

    /// An integer constant.
    pub fn integer(value: impl Into<BigInt>) -> Polynomial {
        Polynomial::constant(&BigRational::from_integer(value.into()))
    }

    /// A rational constant.
    pub fn constant(value: &BigRational) -> Polynomial {
        let mut constant = Polynomial::zero();
        if !value.is_zero() {
            let term = Term { exponents: Monomial::new(), numerator: value.numer().clone() };
            constant.terms.push(term);
            constant.denominator = value.denom().clone();
        }
        constant
    }

    /// The polynomial `x`.
    pub fn symbol(x: &Symbol) -> Polynomial {
        Polynomial::monomial(&BigRational::one(), &[(x, 1)])
    }

    /// The single term `coefficient · Π x_i^{e_i}` (ordinary powers); a symbol may come twice.
    pub fn monomial(coefficient: &BigRational, powers: &[(&Symbol, u32)]) -> Polynomial {
        let mut powers: Vec<_> = powers.iter().filter(|(_, e)| *e > 0).copied().collect();
        powers.sort();
        powers.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1 += next.1;
            }
            same
        });
        let scale = powers.iter().fold(BigInt::one(), |product, (_, e)| product * factorial(*e));
        let mut monomial = Polynomial::constant(&(coefficient * scale));
        if let Some(term) = monomial.terms.first_mut() {
            term.exponents = powers.iter().map(|(_, e)| *e).collect();
            monomial.symbols = powers.iter().map(|(x, _)| (*x).clone()).collect();
        }
        monomial
    }

    /// The polynomial `(1/denominator) Σ_j coefficients_j x^j/j!` in the one symbol `x`.
    pub(crate) fn from_divided(
        x: &Symbol,
        coefficients: &[BigInt],
        denominator: &BigInt,
    ) -> Polynomial {
        let descending = coefficients.iter().enumerate().rev().map(|(j, numerator)| Term {
            exponents: Monomial::from_elem(u32::try_from(j).expect("32 bits"), 1),
            numerator: numerator.clone(),
        });
        Polynomial::from_parts(Arc::from([x.clone()]), descending.collect(), denominator.clone())
    }

    /// Brings a value into normal form. `terms` must be strictly descending; zero numerators,
    /// common divisors and unused symbols are allowed. O(terms), and gcds while they are not 1.
    pub(crate) fn from_parts(
        symbols: Arc<[Symbol]>,
        mut terms: Vec<Term>,
        mut denominator: BigInt,
    ) -> Polynomial {
        debug_assert!(terms.windows(2).all(|pair| pair[0].exponents > pair[1].exponents));
        terms.retain(|term| !term.numerator.is_zero());
        if terms.is_empty() {
            return Polynomial::zero();
        }
        if !denominator.is_one() {
            let mut common = denominator.clone();
            for term in &terms {
                if common.is_one() {
                    break;
                }
                common = common.gcd(&term.numerator);
            }
            if !common.is_one() {
                denominator /= &common;
                terms.iter_mut().for_each(|term| term.numerator /= &common);
            }
        }
        let used = |i: usize| terms.iter().any(|term| term.exponents[i] > 0);
        let keep: Vec<bool> = (0..symbols.len()).map(used).collect();
        let symbols = if keep.iter().all(|keep| *keep) {
            symbols
        } else {
            for term in &mut terms {
                let mut column = keep.iter();
                term.exponents.retain(|_| *column.next().expect("one exponent a symbol"));
            }
            let kept = symbols.iter().zip(&keep).filter(|(_, keep)| **keep);
            kept.map(|(symbol, _)| symbol.clone()).collect()
        };
        Polynomial { symbols, terms, denominator }
    }

    /// The place of `x` among the symbols.
    pub(crate) fn column(&self, x: &Symbol) -> Option<usize> {
        self.symbols.binary_search(x).ok()
    }

    /// Whether the invariants of the type hold. O(terms); for tests.
    pub fn is_valid(&self) -> bool {
        let width = self.symbols.len();
        let rebuilt = Polynomial::from_parts(
            self.symbols.clone(),
            self.terms.clone(),
            self.denominator.clone(),
        );
        self.symbols.windows(2).all(|pair| pair[0] < pair[1])
            && self.terms.iter().all(|term| term.exponents.len() == width)
            && self.terms.windows(2).all(|pair| pair[0].exponents > pair[1].exponents)
            && self.denominator.is_positive()
            && rebuilt == *self
    }

    /// Whether this is 0. O(1).
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Whether this is 1. O(1).
    pub fn is_one(&self) -> bool {
        self.as_integer().is_some_and(|value| value.is_one())
    }

    fn as_integer(&self) -> Option<&BigInt> {
        match &self.terms[..] {
            [only] if self.symbols.is_empty() && self.denominator.is_one() => Some(&only.numerator),
            _ => None,
        }
    }

    /// The value, where no symbol occurs. O(1).
    pub fn as_constant(&self) -> Option<BigRational> {
        match &self.terms[..] {
            [] => Some(BigRational::zero()),
            [only] if self.symbols.is_empty() => {
                Some(BigRational::new_raw(only.numerator.clone(), self.denominator.clone()))
            }
            _ => None,
        }
    }

    /// The symbols that occur, ascending by name. O(1).
    pub fn symbols(&self) -> &[Symbol] {
        &self.symbols
    }

    /// The number of terms. O(1).
    pub fn term_count(&self) -> usize {
        self.terms.len()
    }

    /// The degree in `x`: 0 where `x` does not occur, and for the zero polynomial. O(terms).
    pub fn degree(&self, x: &Symbol) -> u32 {
        let column = self.column(x);
        column.map_or(0, |i| self.terms.iter().map(|term| term.exponents[i]).max().unwrap_or(0))
    }

    /// The largest sum of exponents in one term; 0 for the zero polynomial. O(terms).
    pub fn total_degree(&self) -> u32 {
        self.terms.iter().map(|term| term.exponents.iter().sum()).max().unwrap_or(0)
    }

    /// The terms in the documented order: exponents by [`Polynomial::symbols`], and the reduced
    /// coefficient of the *ordinary* powers. O(1) gcds a term.
    pub fn terms(&self) -> impl Iterator<Item = (&[u32], BigRational)> + '_ {
        self.terms.iter().map(|term| {
            let factorials =
                term.exponents.iter().fold(self.denominator.clone(), |d, e| d * factorial(*e));
            (&term.exponents[..], BigRational::new(term.numerator.clone(), factorials))
        })
    }

    /// The shared denominator `d` and the integers `c_α` of the divided-power form, in the
    /// documented order. O(1) a term.
    pub fn divided_terms(&self) -> (&BigInt, impl Iterator<Item = (&[u32], &BigInt)> + '_) {
        let terms = self.terms.iter().map(|term| (&term.exponents[..], &term.numerator));
        (&self.denominator, terms)
    }

    /// The coefficient of the first term in the documented order, of ordinary powers; 0 for 0.
    pub fn leading_coefficient(&self) -> BigRational {
        self.terms().next().map_or_else(BigRational::zero, |(_, coefficient)| coefficient)
    }

    /// The non-zero coefficients of `x^j` (ordinary powers), `j` descending, each a polynomial in
    /// the other symbols. O(terms).
    ///
    /// ```
    /// use wavestep_polynomial::{Polynomial, Symbol};
    /// let p: Polynomial = "x^2*y + 3*x^2 - y".parse().unwrap();
    /// let by_x = p.coefficients(&Symbol::new("x").unwrap());
    /// assert_eq!(by_x[0], (2, "y + 3".parse().unwrap()));
    /// assert_eq!(by_x[1], (0, "-y".parse().unwrap()));
    /// ```
    pub fn coefficients(&self, x: &Symbol) -> Vec<(u32, Polynomial)> {
        let mut coefficients = self.divided_coefficients(x);
        for (power, coefficient) in &mut coefficients {
            *coefficient = &*coefficient / &BigRational::from_integer(factorial(*power));
        }
        coefficients
    }

    /// The non-zero coefficients of `x^j/j!`, `j` descending. O(terms).
    pub fn divided_coefficients(&self, x: &Symbol) -> Vec<(u32, Polynomial)> {
        let Some(column) = self.column(x) else {
            return if self.is_zero() { Vec::new() } else { vec![(0, self.clone())] };
        };
        let mut by_power = std::collections::BTreeMap::<u32, Vec<Term>>::new();
        for term in &self.terms {
            let mut others = term.clone();
            let power = std::mem::take(&mut others.exponents[column]);
            by_power.entry(power).or_default().push(others);
        }
        let normal =
            |terms| Polynomial::from_parts(self.symbols.clone(), terms, self.denominator.clone());
        by_power.into_iter().rev().map(|(power, terms)| (power, normal(terms))).collect()
    }

    /// The content: the positive rational `c` such that `p/c` has coprime integer coefficients in
    /// ordinary powers; 0 for 0. One gcd a term.
    pub fn content(&self) -> BigRational {
        let mut numerator = BigInt::zero();
        let mut denominator = BigInt::one();
        for (_, coefficient) in self.terms() {
            numerator = numerator.gcd(coefficient.numer());
            denominator = denominator.lcm(coefficient.denom());
        }
        BigRational::new(numerator, denominator)
    }

    /// `(c, p/c)` with `p/c` *primitive*: coprime integer coefficients in ordinary powers, the
    /// leading one positive. `(0, 0)` for 0. One gcd a term.
    pub fn primitive_part(&self) -> (BigRational, Polynomial) {
        if self.is_zero() {
            return (BigRational::zero(), Polynomial::zero());
        }
        let leading_is_negative = self.terms[0].numerator.is_negative();
        let content = if leading_is_negative { -self.content() } else { self.content() };
        let primitive = self / &content;
        (content, primitive)
    }
}
