//! Substitution, Taylor shift, evaluation.

use crate::alignment::{Places, common_symbols};
use crate::binomial::falling_factorial;
use crate::integer::{fraction, lcm};
use crate::polynomial::Polynomial;
use crate::product::Accumulator;
use crate::row::IntegerRow;
use crate::symbol::Symbol;
use crate::term::Term;
use crate::univariate::Univariate;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};
use smallvec::smallvec;
use std::collections::{BTreeMap, BTreeSet};

impl Polynomial {
    /// `p` with the polynomial `value` in place of `x`. The divided powers of `value` that occur
    /// are formed once; then as many products of terms as the answer adds up.
    pub fn substitute(&self, x: &Symbol, value: &Polynomial) -> Polynomial {
        let Some(column) = self.column(x) else { return self.clone() };
        if value.is_zero() {
            let left = self.terms.iter().filter(|term| term.exponents[column] == 0);
            let terms = left.cloned().collect();
            return Polynomial::from_parts(self.symbols.clone(), terms, self.denominator.clone());
        }
        let symbols = common_symbols(&self.symbols, &value.symbols);
        let powers = divided_powers(value, self.exponents_in(column));
        let denominator = powers.values().fold(BigInt::one(), |d, p| lcm(&d, &p.denominator));
        let over_one_denominator = |(e, power): (&u32, &Polynomial)| {
            let mut terms = power.terms_over(&symbols);
            let scale = &denominator / &power.denominator;
            if !scale.is_one() {
                terms.iter_mut().for_each(|term| term.numerator *= &scale);
            }
            (*e, terms)
        };
        let powers: BTreeMap<_, _> = powers.iter().map(over_one_denominator).collect();

        let places = Places::new(&self.symbols, &symbols);
        let wide_column = symbols.binary_search(x).expect("x is among the common symbols");
        let mut sums = Accumulator::default();
        for term in &self.terms {
            let mut others = places.spread(&term.exponents);
            let power = std::mem::take(&mut others[wide_column]);
            sums.add_product(&others, &term.numerator, &powers[&power]);
        }
        sums.finish(symbols, denominator * &self.denominator)
    }

    /// The Taylor shift `p(x + step)`. Cost as for [`Polynomial::substitute`]. A shift by an
    /// integer multiple of a symbol makes no denominator: `(x + ka)^[n] = Σ_j k^j a^[j] x^[n−j]`.
    pub fn shift(&self, x: &Symbol, step: &Polynomial) -> Polynomial {
        if let Some(shifted) = self.shift_by_multiple(x, step) {
            return shifted;
        }
        self.substitute(x, &(&Polynomial::symbol(x) + step))
    }

    /// The shift `Σ_{i,l} c_{i+l} k^l x^[i] a^[l]` of a polynomial in `x` alone by `ka`, where `k` is
    /// a word: one product a term.
    fn shift_by_multiple(&self, x: &Symbol, step: &Polynomial) -> Option<Polynomial> {
        let [Term { exponents, numerator }] = &step.terms[..] else { return None };
        if exponents[..] != [1] || !step.denominator.is_one() || step.symbols[0] == *x {
            return None;
        }
        let word = numerator.to_u64()?;
        let dense = Univariate::from_polynomial(self, x)?;
        let (mut rows, mut spare) = (vec![dense.coefficients().clone()], IntegerRow::default());
        while rows[rows.len() - 1].len() > 1 {
            let mut next = rows[rows.len() - 1].clone();
            next.advance(word, &mut spare);
            rows.push(next);
        }
        let x_first = *x < step.symbols[0];
        let count = dense.coefficients().len();
        let mut terms = Vec::with_capacity(count * (count + 1) / 2);
        for first in (0..count).rev() {
            for second in (0..count - first).rev() {
                let (i, l) = if x_first { (first, second) } else { (second, first) };
                let numerator = rows[l].get(i).to_integer();
                let exponents = smallvec![first as u32, second as u32];
                terms.push(Term { exponents, numerator });
            }
        }
        let mut symbols = [x.clone(), step.symbols[0].clone()];
        symbols.sort();
        Some(Polynomial::from_parts(symbols.into(), terms, self.denominator.clone()))
    }

    /// The value where every symbol has a value, or the first symbol that has none. At most one
    /// product for each symbol of each term, and one gcd.
    pub fn evaluate(
        &self,
        values: impl Fn(&Symbol) -> Option<BigRational>,
    ) -> Result<BigRational, Symbol> {
        let mut denominator = self.denominator.clone();
        let mut tables = Vec::new();
        for (column, symbol) in self.symbols.iter().enumerate() {
            let value = Some(symbol).filter(|symbol| !symbol.is_root()).and_then(&values);
            let value = value.ok_or_else(|| symbol.clone())?;
            let (powers, scale) = divided_powers_of_number(&value, &self.exponents_in(column));
            denominator *= scale;
            tables.push(powers);
        }
        let numerator = sum_of_products(&self.terms, 0, &tables);
        Ok(fraction(numerator, denominator))
    }

    /// The exponents that occur in one column.
    fn exponents_in(&self, column: usize) -> BTreeSet<u32> {
        self.terms.iter().map(|term| term.exponents[column]).collect()
    }
}

/// `q^[e] = q^e/e!` for these exponents; `(cy)^[e] = c^e y^[e]` for a multiple of a symbol.
fn divided_powers(q: &Polynomial, exponents: BTreeSet<u32>) -> BTreeMap<u32, Polynomial> {
    if let [Term { exponents: one, numerator }] = &q.terms[..]
        && one[..] == [1]
    {
        let (mut last, mut top, mut bottom) = (0, BigInt::one(), BigInt::one());
        let next = exponents.into_iter().map(|e| {
            top *= numerator.pow(e - last);
            bottom *= q.denominator.pow(e - last);
            last = e;
            let term = Term { exponents: smallvec![e], numerator: top.clone() };
            (e, Polynomial::from_parts(q.symbols.clone(), vec![term], bottom.clone()))
        });
        return next.collect();
    }
    let (mut last, mut power) = (0, Polynomial::one());
    let next = exponents.into_iter().map(|e| {
        let quotient = BigRational::new(BigInt::one(), falling_factorial(e, e - last));
        power = &(&power * &q.pow(e - last)) * &quotient;
        last = e;
        (e, power.clone())
    });
    next.collect()
}

/// The numerators of `x^[e] = x^e/e!` for these exponents over one denominator, and that.
///
/// With `x = a/b` and the largest exponent `n`, they are `a^e · b^(n−e) n!/e!` over `b^n n!`.
fn divided_powers_of_number(
    x: &BigRational,
    exponents: &BTreeSet<u32>,
) -> (BTreeMap<u32, BigInt>, BigInt) {
    let (mut last, mut power) = (0, BigInt::one());
    let mut numerators: BTreeMap<u32, BigInt> = BTreeMap::new();
    for e in exponents {
        power *= x.numer().pow(e - last);
        numerators.insert(*e, power.clone());
        last = *e;
    }
    let mut scale = BigInt::one();
    for (e, numerator) in numerators.iter_mut().rev() {
        scale *= x.denom().pow(last - e) * falling_factorial(last, last - e);
        *numerator *= &scale;
        last = *e;
    }
    scale *= x.denom().pow(last) * falling_factorial(last, last);
    (numerators, scale)
}

/// `Σ c Π_i v_i` over the terms, where `v_i` is the entry of the table of column `i ≥ column` for
/// the exponent. Terms that agree in a column stand together, so its entry is multiplied once.
fn sum_of_products(terms: &[Term], column: usize, tables: &[BTreeMap<u32, BigInt>]) -> BigInt {
    let Some(table) = tables.get(column) else {
        return terms.iter().map(|term| &term.numerator).sum();
    };
    let groups = terms.chunk_by(|a, b| a.exponents[column] == b.exponents[column]);
    let product = |group: &[Term]| {
        sum_of_products(group, column + 1, tables) * &table[&group[0].exponents[column]]
    };
    groups.map(product).sum()
}
