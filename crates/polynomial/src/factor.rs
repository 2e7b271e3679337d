//! Irreducible factors over the rationals.
//!
//! Kronecker's substitution `x_i → x^{D_1 ⋯ D_{i−1}}`, with `D_i` above the degree in `x_i`, leaves one
//! variable and can be undone: a factor's image is a product of factors of the image. These are found by
//! Zassenhaus's method modulo one prime that is more than twice as large as any coefficient of a factor
//! (Mignotte's bound), so that nothing has to be lifted.

use crate::polynomial::Polynomial;
use crate::symbol::Symbol;
use num_bigint::BigInt;
use num_integer::Integer as _;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// `2^e − 1` is prime for these `e`.
const MERSENNE: [u32; 6] = [61, 127, 521, 1279, 2203, 4253];

/// The highest degree of an image, and the most parts whose products are tried.
const MAX_DEGREE: usize = 60;
const MAX_PARTS: usize = 14;

/// Primes modulo which the degrees of factors are soon known.
const SMALL_PRIMES: [u32; 8] = [1009, 1013, 1019, 1021, 1031, 1033, 1039, 1049];

/// How many polynomials `x + c` are tried to separate two factors: each fails about every other time.
const MAX_SHIFTS: i64 = 200;

impl Polynomial {
    /// The irreducible factors over the rationals, primitive, with their powers; none for a number.
    /// `None` for 0, where square roots occur, and where the search would be long.
    pub fn factors(&self) -> Option<Vec<(Polynomial, u32)>> {
        if self.is_zero() || self.roots().next().is_some() {
            return None;
        }
        let (_, mut rest) = self.primitive_part();
        let mut found: Vec<(Polynomial, u32)> = Vec::new();
        let mut add = |factor: Polynomial| match found.iter_mut().find(|(own, _)| *own == factor) {
            Some((_, power)) => *power += 1,
            None => found.push((factor, 1)),
        };
        if rest.is_one() {
            return Some(Vec::new());
        }
        if rest.total_degree() == 1 || rest.stays_irreducible() {
            return Some(vec![(rest, 1)]);
        }
        let image = Image::of(&rest)?;
        let parts = integer_factors(&image.coefficients(&rest))?;
        if parts.len() > MAX_PARTS {
            return None;
        }
        gather(parts, &mut rest, |p| image.preimage(p), Polynomial::divide)
            .into_iter()
            .for_each(&mut add);
        if rest.as_constant().is_none() {
            add(rest.primitive_part().1);
        }
        Some(found)
    }

    /// Whether it keeps its degree in a symbol and is irreducible where the others have certain values, and
    /// no factor lacks that symbol. Then it has no factors but itself.
    fn stays_irreducible(&self) -> bool {
        self.symbols().len() > 1
            && self.symbols().iter().any(|x| {
                let others = self.symbols().iter().filter(|y| *y != x);
                let values = [3, 7, 13, 29].iter().cycle();
                let special = others.zip(values).fold(self.clone(), |p, (y, value)| {
                    let value = BigRational::from_integer(BigInt::from(*value));
                    p.substitute(y, &Polynomial::constant(&value))
                });
                special.degree(x) == self.degree(x)
                    && special.factors().is_some_and(|all| matches!(all[..], [(_, 1)]))
                    && self.is_primitive_in(x)
            })
    }

    /// Whether no factor lacks a symbol: it would divide the coefficients of all its powers. `false` where the
    /// factors of the shortest coefficient are not found.
    fn is_primitive_in(&self, x: &Symbol) -> bool {
        let coefficients = self.coefficients(x);
        let shortest = coefficients.iter().map(|(_, own)| own).min_by_key(|own| own.term_count());
        let divides_all =
            |factor: &Polynomial| coefficients.iter().all(|(_, own)| own.divide(factor).is_some());
        shortest
            .and_then(Polynomial::factors)
            .is_some_and(|found| found.iter().all(|(factor, _)| !divides_all(factor)))
    }
}

/// Takes products of parts off what they are the product of, those of few parts first, each as the factor
/// that it stands for; returns what was taken. What is left has no factors but itself.
fn gather<P>(
    mut parts: Vec<Vec<BigInt>>,
    rest: &mut P,
    factor: impl Fn(&[BigInt]) -> Option<P>,
    quotient: impl Fn(&P, &P) -> Option<P>,
) -> Vec<P> {
    let mut taken = Vec::new();
    let mut size = 1;
    while 2 * size <= parts.len() {
        let mut masks = (0..1_u32 << parts.len()).filter(|mask| mask.count_ones() as usize == size);
        let found = masks.find_map(|mask| {
            let chosen = (0..parts.len()).filter(|i| mask >> i & 1 == 1);
            let product = chosen.fold(vec![BigInt::one()], |p, i| product(&p, &parts[i]));
            let factor = factor(&product)?;
            Some((mask, quotient(rest, &factor)?, factor))
        });
        match found {
            Some((mask, quotient, factor)) => {
                *rest = quotient;
                taken.push(factor);
                let mut place = 0;
                parts.retain(|_| {
                    place += 1;
                    mask >> (place - 1) & 1 == 0
                });
            }
            None => size += 1,
        }
    }
    taken
}

/// Kronecker's substitution: each symbol with its degree, and the power of the one variable it becomes.
struct Image {
    symbols: Vec<(Symbol, usize, usize)>,
}

impl Image {
    fn of(p: &Polynomial) -> Option<Image> {
        let mut stride = 1_usize;
        let mut symbols = Vec::new();
        for x in p.symbols() {
            let degree = p.degree(x) as usize;
            symbols.push((x.clone(), degree, stride));
            stride = stride.checked_mul(degree + 1)?;
        }
        (stride <= MAX_DEGREE + 1).then_some(Image { symbols })
    }

    /// The integer coefficients of the image of a primitive polynomial, the lowest power first.
    fn coefficients(&self, p: &Polynomial) -> Vec<BigInt> {
        let mut coefficients = Vec::new();
        for (exponents, value) in p.terms() {
            let steps = exponents.iter().zip(&self.symbols);
            let place = steps.map(|(e, (_, _, stride))| *e as usize * stride).sum();
            if coefficients.len() <= place {
                coefficients.resize(place + 1, BigInt::zero());
            }
            coefficients[place] = value.to_integer();
        }
        coefficients
    }

    /// The primitive polynomial with this image; `None` for a number, and where there is none.
    fn preimage(&self, image: &[BigInt]) -> Option<Polynomial> {
        let size = self.symbols.iter().map(|(_, degree, _)| degree + 1).product();
        if image.len() > size {
            return None;
        }
        let terms = image.iter().enumerate().map(|(place, value)| {
            let digit = |(x, degree, stride): &(Symbol, usize, usize)| {
                (x.clone(), (place / stride % (degree + 1)) as u32)
            };
            let powers: Vec<(Symbol, u32)> = self.symbols.iter().map(digit).collect();
            let powers: Vec<(&Symbol, u32)> = powers.iter().map(|(x, e)| (x, *e)).collect();
            Polynomial::monomial(&BigRational::from_integer(value.clone()), &powers)
        });
        let sum: Polynomial = terms.sum();
        sum.as_constant().is_none().then(|| sum.primitive_part().1)
    }
}

/// The irreducible factors of a primitive polynomial with integer coefficients, each as often as it
/// divides; primitive but for their signs.
fn integer_factors(p: &[BigInt]) -> Option<Vec<Vec<BigInt>>> {
    if is_soon_irreducible(p) {
        return Some(vec![p.to_vec()]);
    }
    let mut rest = p.to_vec();
    let mut found = Vec::new();
    for factor in square_free_factors(p)? {
        while let Some(quotient) = quotient(&rest, &factor) {
            rest = quotient;
            found.push(factor.clone());
        }
    }
    Some(found)
}

/// Whether it is known to be irreducible by the degrees of its factors modulo small primes: the degree of a factor over
/// the rationals is a sum of some of these, for every prime.
fn is_soon_irreducible(p: &[BigInt]) -> bool {
    let degree = p.len() - 1;
    if degree < 2 {
        return degree == 1;
    }
    // Bit `d` tells whether there may be a factor of degree `d`, which is at most `MAX_DEGREE`.
    let mut possible = u64::MAX >> (u64::BITS as usize - 1 - degree);
    SMALL_PRIMES.iter().any(|prime| {
        let prime = Prime(BigInt::from(*prime));
        let monic = prime.monic(p);
        if monic.len() == p.len() && prime.gcd(&monic, &derivative(&monic)).len() == 1 {
            let mut sums = 1_u64;
            for (product, degree) in prime.by_degree(monic) {
                (0..(product.len() - 1) / degree).for_each(|_| sums |= sums << degree);
            }
            possible &= sums;
        }
        possible == 1 | 1 << degree
    })
}

/// The different irreducible factors.
fn square_free_factors(p: &[BigInt]) -> Option<Vec<Vec<BigInt>>> {
    let degree = p.len() - 1;
    if degree == 0 {
        return Some(Vec::new());
    }
    let lead = p[degree].abs();
    let norm: BigInt = p.iter().map(BigInt::abs).sum();
    // A factor f times lead(p)/lead(f) has coefficients of at most 2^n ‖p‖ (Mignotte); the prime exceeds twice that.
    let bound = norm << (degree + 1);
    let slope = derivative(p);
    for prime in MERSENNE.map(|e| (BigInt::one() << e) - 1).into_iter().filter(|p| *p > bound) {
        let prime = Prime(prime);
        let whole = |factor: &[BigInt]| primitive(&prime.balanced(factor, &lead));
        // p over what it shares with its derivative has every factor once.
        let shared = whole(&prime.gcd(p, &slope));
        // They may share more modulo the prime.
        let (Some(single), Some(_)) = (quotient(p, &shared), quotient(&slope, &shared)) else {
            continue;
        };
        let monic = prime.monic(&single);
        if prime.gcd(&monic, &derivative(&monic)).len() > 1 {
            continue;
        }
        let parts = prime.factors(monic)?;
        if parts.len() > MAX_PARTS {
            return None;
        }
        let mut rest = single;
        let mut found = gather(parts, &mut rest, |p| Some(whole(p)), |p, q| quotient(p, q));
        // `gather` takes half of the parts at most.
        found.push(rest);
        return Some(found);
    }
    None
}

fn derivative(p: &[BigInt]) -> Vec<BigInt> {
    p.iter().enumerate().skip(1).map(|(j, c)| c * j).collect()
}

fn product(p: &[BigInt], q: &[BigInt]) -> Vec<BigInt> {
    let mut product = vec![BigInt::zero(); (p.len() + q.len()).saturating_sub(1)];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in q.iter().enumerate() {
            product[i + j] += a * b;
        }
    }
    product
}

/// The quotient where it has integer coefficients, of divisors that are no number.
fn quotient(p: &[BigInt], divisor: &[BigInt]) -> Option<Vec<BigInt>> {
    let (lead, lower) = divisor.split_last()?;
    let mut rest = p.to_vec();
    let mut quotient = vec![BigInt::zero(); (p.len() + 1).checked_sub(divisor.len())?];
    for place in (0..quotient.len()).rev() {
        let (factor, remainder) = rest[place + lower.len()].div_rem(lead);
        if !remainder.is_zero() {
            return None;
        }
        lower.iter().enumerate().for_each(|(j, c)| rest[place + j] -= c * &factor);
        quotient[place] = factor;
    }
    rest[..lower.len()].iter().all(BigInt::is_zero).then_some(quotient)
}

fn primitive(p: &[BigInt]) -> Vec<BigInt> {
    let content = p.iter().fold(BigInt::zero(), |g, c| g.gcd(c));
    p.iter().map(|c| c / &content).collect()
}

/// Polynomials with coefficients modulo a prime, without zeros at the end.
struct Prime(BigInt);

impl Prime {
    fn reduced(&self, p: impl IntoIterator<Item = BigInt>) -> Vec<BigInt> {
        let mut reduced: Vec<BigInt> = p.into_iter().map(|c| c.mod_floor(&self.0)).collect();
        while reduced.last().is_some_and(BigInt::is_zero) {
            reduced.pop();
        }
        reduced
    }

    fn scaled(&self, p: &[BigInt], by: &BigInt) -> Vec<BigInt> {
        self.reduced(p.iter().map(|c| c * by))
    }

    fn monic(&self, p: &[BigInt]) -> Vec<BigInt> {
        let p = self.reduced(p.iter().cloned());
        match p.last() {
            Some(lead) => self.scaled(&p, &lead.modpow(&(&self.0 - 2), &self.0)),
            None => p,
        }
    }

    /// `factor · p` with coefficients as near to zero as can be.
    fn balanced(&self, p: &[BigInt], factor: &BigInt) -> Vec<BigInt> {
        let half: BigInt = &self.0 >> 1;
        let near = |c: BigInt| if c > half { c - &self.0 } else { c };
        self.scaled(p, factor).into_iter().map(near).collect()
    }

    /// Quotient and remainder by a monic polynomial.
    fn divide(&self, p: Vec<BigInt>, divisor: &[BigInt]) -> [Vec<BigInt>; 2] {
        let mut rest = p;
        let mut quotient = Vec::new();
        while rest.len() >= divisor.len() {
            let factor = rest.pop().expect("it is as long as the divisor").mod_floor(&self.0);
            let place = rest.len() + 1 - divisor.len();
            for (j, c) in divisor[..divisor.len() - 1].iter().enumerate() {
                rest[place + j] -= c * &factor;
            }
            quotient.push(factor);
        }
        quotient.reverse();
        [quotient, self.reduced(rest)]
    }

    fn gcd(&self, p: &[BigInt], q: &[BigInt]) -> Vec<BigInt> {
        let (mut p, mut q) = (self.monic(p), self.monic(q));
        while !q.is_empty() {
            let [_, rest] = self.divide(p, &q);
            p = std::mem::replace(&mut q, self.monic(&rest));
        }
        p
    }

    fn power(&self, base: &[BigInt], exponent: &BigInt, modulo: &[BigInt]) -> Vec<BigInt> {
        let times = |p: &[BigInt], q: &[BigInt]| {
            let [_, rest] = self.divide(product(p, q), modulo);
            rest
        };
        let mut power = vec![BigInt::one()];
        for bit in (0..exponent.bits()).rev() {
            power = times(&power, &power);
            if exponent.bit(bit) {
                power = times(&power, base);
            }
        }
        power
    }

    /// The irreducible factors of a monic polynomial without multiple ones.
    fn factors(&self, p: Vec<BigInt>) -> Option<Vec<Vec<BigInt>>> {
        let products = self.by_degree(p).into_iter();
        let factors = products.map(|(product, degree)| self.separated(product, degree));
        Some(factors.collect::<Option<Vec<_>>>()?.concat())
    }

    /// The products of those of each degree, with that degree: they divide `x^{P^d} − x`, and no smaller such power.
    fn by_degree(&self, p: Vec<BigInt>) -> Vec<(Vec<BigInt>, usize)> {
        let x = [BigInt::zero(), BigInt::one()];
        let (mut rest, mut power, mut found) = (p, x.to_vec(), Vec::new());
        let mut degree = 1;
        while 2 * degree < rest.len() {
            power = self.power(&power, &self.0, &rest);
            let mut difference = power.clone();
            difference.resize(difference.len().max(2), BigInt::zero());
            difference[1] -= 1;
            let common = self.gcd(&difference, &rest);
            if common.len() > 1 {
                [rest, _] = self.divide(rest, &common);
                [_, power] = self.divide(power, &rest);
                found.push((common, degree));
            }
            degree += 1;
        }
        if rest.len() > 1 {
            let degree = rest.len() - 1;
            found.push((rest, degree));
        }
        found
    }

    /// The factors of a product of irreducible ones of one degree: for each of them `(x + c)^{(P^d−1)/2}`
    /// is 1 or −1 (Cantor and Zassenhaus).
    fn separated(&self, p: Vec<BigInt>, degree: usize) -> Option<Vec<Vec<BigInt>>> {
        let exponent: BigInt = (self.0.pow(degree as u32) - 1) >> 1;
        let mut parts = vec![p];
        for shift in 0..MAX_SHIFTS {
            if parts.iter().all(|part| part.len() == degree + 1) {
                return Some(parts);
            }
            let mut finer = Vec::new();
            for part in parts {
                let mut power = self.power(&[shift.into(), BigInt::one()], &exponent, &part);
                power.resize(power.len().max(1), BigInt::zero());
                power[0] -= 1;
                let common = self.gcd(&power, &part);
                if common.len() > 1 && common.len() < part.len() {
                    let [other, _] = self.divide(part, &common);
                    finer.push(other);
                    finer.push(common);
                } else {
                    finer.push(part);
                }
            }
            parts = finer;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::{BigInt, is_soon_irreducible};

    /// By the coefficients, the lowest power first.
    fn is_known(coefficients: &[i64]) -> bool {
        is_soon_irreducible(&coefficients.iter().map(|c| BigInt::from(*c)).collect::<Vec<_>>())
    }

    fn product(one: &[i64], other: &[i64]) -> Vec<i64> {
        let mut product = vec![0; one.len() + other.len() - 1];
        for (i, a) in one.iter().enumerate() {
            other.iter().enumerate().for_each(|(j, b)| product[i + j] += a * b);
        }
        product
    }

    #[test]
    fn degrees_modulo_primes_tell_what_is_irreducible() {
        // A number, x + 3, x² - 2, 5 x² + 5 x + 1, x³ - 2, x⁵ - x - 1, x⁷ + 2 x + 2, x¹⁷ - x - 1.
        assert!(!is_known(&[5]));
        let mut trinomial = [0; 18];
        (trinomial[0], trinomial[1], trinomial[17]) = (-1, -1, 1);
        let irreducible: [&[i64]; 7] = [
            &[3, 1],
            &[-2, 0, 1],
            &[1, 5, 5],
            &[-2, 0, 0, 1],
            &[-1, -1, 0, 0, 0, 1],
            &[2, 2, 0, 0, 0, 0, 0, 1],
            &trinomial,
        ];
        for (i, one) in irreducible.iter().enumerate() {
            assert!(is_known(one), "{one:?}");
            for other in &irreducible[i..] {
                assert!(!is_known(&product(one, other)), "{one:?} times {other:?}");
            }
        }
        // Irreducible, but a product modulo every prime: x⁴ + 1.
        assert!(!is_known(&[1, 0, 0, 0, 1]));
    }
}
