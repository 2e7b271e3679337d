//! Square roots of fractions, and conjugates.

use crate::expression::fraction::Fraction;
use crate::expression::sum::Expression;
use num_traits::{One, Signed, ToPrimitive, Zero};
use wavestep_polynomial::{Integer, Polynomial, Rational, Symbol};

/// Numbers are divided by all integers up to this one in search of factors.
const TRIAL_LIMIT: u64 = 1_000_000;

impl Fraction {
    /// The square roots that occur, ascending by name.
    pub fn roots(&self) -> impl Iterator<Item = &Symbol> + '_ {
        self.numerator().roots()
    }

    /// The value with `−root` in place of the square root `root`.
    pub fn conjugate(&self, root: &Symbol) -> Fraction {
        match self.roots().any(|own| own == root) {
            true => self.with_numerator(self.numerator().conjugate(root)),
            false => self.clone(),
        }
    }

    /// A fraction whose square this is: `√c · q/d` for `c q²/d²`, `c` rational, with `√c` as a
    /// rational times square roots of −1 and of primes. Of the two, the one whose numerator has a
    /// positive leading coefficient beside the roots.
    ///
    /// `None` where there is none of this kind: for values that are no rational times a square, for what
    /// holds square roots itself, and for a `c` whose factors are not found. All primes up to
    /// `10⁶` are tried; what is left may be a square, or a prime below `10¹²`.
    pub fn square_root(&self) -> Option<Fraction> {
        if self.is_zero() {
            return Some(Fraction::zero());
        }
        let (c, root) = self.numerator().square_root()?;
        let mut root = Fraction::from(&root * &root_of_rational(&c)?);
        for (factor, power) in self.factors() {
            if power % 2 == 1 {
                return None;
            }
            let inverse = Fraction::reciprocal(factor).expect("factors of fractions are units");
            root = &root * &inverse.pow(power / 2);
        }
        Some(root)
    }
}

impl Expression {
    /// `cos angle = (e^{i angle} + e^{−i angle})/2`.
    pub fn cosine(angle: &Fraction) -> Expression {
        let half = Fraction::constant(&Rational::new(1.into(), 2.into()));
        Expression::pair(angle, half.clone(), half)
    }

    /// `sin angle = (e^{i angle} − e^{−i angle})/(2i)`.
    pub fn sine(angle: &Fraction) -> Expression {
        let half = imaginary_unit().scale(&Rational::new(1.into(), 2.into()));
        Expression::pair(angle, -&half, half)
    }

    /// `up · e^{i angle} + down · e^{−i angle}`.
    fn pair(angle: &Fraction, up: Fraction, down: Fraction) -> Expression {
        let exponent = &imaginary_unit() * angle;
        let mut sum = Expression::zero();
        sum.add_term(-&exponent, down);
        sum.add_term(exponent, up);
        sum
    }

    /// The square roots that occur, ascending by name.
    pub fn roots(&self) -> Vec<Symbol> {
        let both = self.terms().flat_map(|(exponent, p)| exponent.roots().chain(p.roots()));
        let mut roots: Vec<Symbol> = both.cloned().collect();
        roots.sort();
        roots.dedup();
        roots
    }

    /// The value with `−root` in place of the square root `root`: for the root of −1 the complex
    /// conjugate, where the symbols are real.
    pub fn conjugate(&self, root: &Symbol) -> Expression {
        let mut conjugate = Expression::zero();
        for (exponent, p) in self.terms() {
            conjugate.add_term(exponent.conjugate(root), p.conjugate(root));
        }
        conjugate
    }
}

fn imaginary_unit() -> Fraction {
    Fraction::symbol(&Symbol::square_root(-1).expect("the imaginary unit"))
}

/// `√c`: with `a = s² Π p` and `b = t² Π q`, it is `√(a/b) = s/(t Π q) · Π √p Π √q`.
fn root_of_rational(c: &Rational) -> Option<Polynomial> {
    let (above, mut primes) = square_part(c.numer())?;
    let (below, others) = square_part(c.denom())?;
    let below = others.iter().fold(below, |product, prime| product * prime);
    primes.extend(others);
    let roots: Option<Vec<Symbol>> = primes.into_iter().map(Symbol::square_root).collect();
    let roots = roots?;
    let powers: Vec<(&Symbol, u32)> = roots.iter().map(|root| (root, 1)).collect();
    Some(Polynomial::monomial(&Rational::new(above, below), &powers))
}

/// `(s, [p, …])` with `value = s² Π p`, the `p` different primes, −1 among them for a negative
/// value; `None` where the factors are not found.
fn square_part(value: &Integer) -> Option<(Integer, Vec<i64>)> {
    let mut primes = if value.is_negative() { vec![-1] } else { Vec::new() };
    let (mut rest, mut side) = (value.abs(), Integer::one());
    let candidates = std::iter::once(2).chain((3..=TRIAL_LIMIT).step_by(2));
    for d in candidates {
        let word = rest.to_u64();
        if word.is_some_and(|word| d * d > word) {
            break;
        }
        let divides = |rest: &Integer| match rest.to_u64() {
            Some(word) => word % d == 0,
            None => (rest % d).is_zero(),
        };
        while divides(&rest) {
            rest /= d;
            match divides(&rest) {
                true => {
                    rest /= d;
                    side *= d;
                }
                false => primes.push(i64::try_from(d).expect("the limit of trials is small")),
            }
        }
    }
    let root = rest.sqrt();
    if &root * &root == rest {
        return Some((side * root, primes));
    }
    // No factor of the rest is below the limit of trials, or below its own square root.
    let is_prime = rest < Integer::from(TRIAL_LIMIT * TRIAL_LIMIT);
    primes.push(rest.to_i64().filter(|_| is_prime)?);
    Some((side, primes))
}
