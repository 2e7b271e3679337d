//! A function of time on one cell: a polynomial and a bound of what it leaves out.
//!
//! Between two arrivals every signal is a sum of polynomials times exponentials, so a Taylor polynomial at
//! the start of the cell comes as near to it as wanted. What it leaves out, and all errors that came before,
//! is a function of the same kind, of which one bound is kept: in the *norm of the cell*,
//! `‖e‖ = sup |e^(j)(x)|/γ^j` over all `j ≥ 0` and all `x` of the cell. With a rate `γ` above all rates of the
//! scene this norm bounds the error of every derivative at once, and shifts within the cell leave it as it is:
//! nothing is lost from cell to cell but what a node itself amplifies.

use crate::ball::{Magnitude, Number};

/// How series are cut off.
///
/// # Invariants
/// `rate` is at least two above the logarithm of the norm of every node and of every rate of a load.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Truncation {
    /// The precision of balls.
    pub bits: u64,
    /// The most coefficients that are kept: those of `x⁰ … x^(order−1)`.
    pub order: usize,
    /// `log₂ γ`, the rate of the norm of a cell.
    pub rate: i64,
    /// As long as the longest cell.
    pub longest: Magnitude,
    /// The size of the largest state of a node so far: what is below the last bit of it is not told from zero.
    pub largest: Magnitude,
}

/// What the norm of a node times the length of a cell is at most, as a power of two.
pub const LONGEST_CELL: i64 = 3;

/// The rate has one bit for so many of the precision, so that few coefficients do on short cells; but no more
/// than these, so that series may be asked for a little beyond their cell.
const BITS_OF_RATE: u64 = 32;
const MOST_RATE: u64 = 10;

impl Truncation {
    /// For nodes and loads whose rates are below `2^top`: such that `8^N/N!` is below `2^(−bits−16)`.
    pub fn new(bits: u64, top: i64) -> Truncation {
        let (mut order, mut size) = (1_usize, 0.0);
        while size > -((bits + 16) as f64) {
            size += LONGEST_CELL as f64 - (order as f64).log2();
            order += 1;
        }
        let rate = top + (bits / BITS_OF_RATE).clamp(3, MOST_RATE) as i64;
        Truncation { bits, order, rate, longest: Magnitude::ZERO, largest: Magnitude::ZERO }
    }

    /// The bound of an error so much beyond the ends of its cell, `e^(γ by)` times that on the cell.
    pub fn extended(&self, bound: &Magnitude, by: &Magnitude) -> Magnitude {
        match by.is_zero() || bound.is_zero() {
            true => *bound,
            false => bound.multiply(&growth(&self.per_time(by))),
        }
    }

    /// `γ · size`.
    fn per_time(&self, size: &Magnitude) -> Magnitude {
        size.scale(self.rate)
    }
}

/// A bound of `e^z`: `e ≤ 2^(3/2)`, so that `e^z ≤ 2^⌈3z/2⌉`.
fn growth(z: &Magnitude) -> Magnitude {
    let halves = z.multiply(&Magnitude::from_u64(3)).scale(-1);
    let Some(top) = halves.top() else { return Magnitude::power_of_two(0) };
    // Times of 2^60 units of the fastest rate are not followed.
    let exponent = if top <= 0 { 1 } else { 1_i64 << top.min(60) };
    Magnitude::power_of_two(exponent)
}

/// The norm of a cell: `‖f‖ = sup |f^(j)(x)|/γ^j` over all `j ≥ 0` and `0 ≤ x ≤ h`.
pub struct CellNorm {
    /// `h`, rounded upwards.
    pub length: Magnitude,
    /// `(γh)^i/i!`.
    powers: Vec<Magnitude>,
    /// The largest of these up to each `i`.
    largest: Vec<Magnitude>,
    /// `k!/γ^k`.
    factors: Vec<Magnitude>,
}

impl CellNorm {
    pub fn new(length: Magnitude, cut: &Truncation) -> CellNorm {
        let z = cut.per_time(&length);
        let mut power = Magnitude::power_of_two(0);
        let (mut factor, mut most) = (power, power);
        let (mut powers, mut largest, mut factors) = (vec![power], vec![most], vec![factor]);
        for i in 1..=cut.order as u64 + 2 {
            power = power.multiply(&z).divide(i);
            factor = factor.multiply(&Magnitude::from_u64(i)).scale(-cut.rate);
            most = most.max(power);
            powers.push(power);
            largest.push(most);
            factors.push(factor);
        }
        CellNorm { length, powers, largest, factors }
    }

    /// `‖c x^k‖ = |c| k!/γ^k · max_{i≤k} (γh)^i/i!`.
    pub fn of_term(&self, k: usize, size: &Magnitude) -> Magnitude {
        let last = self.factors.len() - 1;
        let known = size.multiply(&self.factors[k.min(last)]).multiply(&self.largest[k.min(last)]);
        // Beyond what is tabled, a power of h at most, or of k/γ.
        (last..k).fold(known, |norm, k| {
            let slow = Magnitude::from_u64(k as u64 + 1).multiply(&self.factors[1]);
            norm.multiply(&slow.max(self.length))
        })
    }

    /// `‖k c x^(k−1)‖/γ · 4/3` for `k ≥ 1`: what an error that is driven by `k c x^(k−1)` has at least as its
    /// bound.
    pub fn of_residual(&self, k: usize, size: &Magnitude) -> Magnitude {
        let norm = self.of_term(k - 1, &size.multiply(&Magnitude::from_u64(4 * k as u64)));
        norm.divide(3).multiply(&self.factors[1])
    }

    /// A bound of `‖Σ c_k x^k‖` for all `|c_k| ≤ s_k`: with `q_k = s_k k!/γ^k` the derivative of order `j` is
    /// at most `γ^j Σ_{k≥j} q_k (γh)^(k−j)/(k−j)!`, and so `Σ_i (γh)^i/i! · max_{k≥i} q_k` bounds all of them.
    pub fn of_sizes(&self, sizes: &[Magnitude]) -> Magnitude {
        let tabled = sizes.len().min(self.powers.len());
        let (mut sum, mut most) = (Magnitude::ZERO, Magnitude::ZERO);
        for (k, size) in sizes.iter().enumerate().skip(tabled) {
            sum = sum.add(&self.of_term(k, size));
        }
        for k in (0..tabled).rev() {
            most = most.max(sizes[k].multiply(&self.factors[k]));
            sum = sum.add(&most.multiply(&self.powers[k]));
        }
        sum
    }
}

/// Divides a polynomial by `x − a` again and again, where `step(c, d) = c + a d`: what is left are its
/// coefficients at `a`.
fn divide(coefficients: &mut [Number], step: impl Fn(&Number, &Number) -> Number) {
    for first in 0..coefficients.len() {
        for k in (first..coefficients.len().saturating_sub(1)).rev() {
            coefficients[k] = step(&coefficients[k], &coefficients[k + 1]);
        }
    }
}

/// `Σ_{i≥1} C(j+i, i) r^i s_(j+i)`: how much the coefficient of `x^j` changes at most, for coefficients of
/// these sizes, where the origin is moved by `r`.
fn moved(sizes: &[Magnitude], j: usize, r: &Magnitude) -> Magnitude {
    let mut factor = Magnitude::power_of_two(0);
    let mut sum = Magnitude::ZERO;
    for (i, size) in (1..).zip(&sizes[j + 1..]) {
        factor = factor.multiply(r).multiply(&Magnitude::from_u64((j + i) as u64)).divide(i as u64);
        sum = sum.add(&factor.multiply(size));
    }
    sum
}

/// A function `f = P + e` on `0 ≤ x ≤ h`, the length of its cell, with `P(x) = Σ c_k x^k`.
///
/// # Invariants
/// - `coefficients` hold `c_0, c_1, …`, the last one not zero;
/// - `‖e‖ ≤ rest` in the norm of the cell, and so on every part of it, and `|e(0)| ≤ rest_at_start`.
#[derive(Clone, PartialEq, Debug)]
pub struct Series {
    pub coefficients: Vec<Number>,
    pub rest: Magnitude,
    rest_at_start: Magnitude,
}

impl Series {
    /// A constant.
    pub fn constant(value: Number) -> Series {
        Series::new(vec![value], Magnitude::ZERO)
    }

    /// The polynomial with these coefficients, and a bound of the rest.
    pub fn new(mut coefficients: Vec<Number>, rest: Magnitude) -> Series {
        while coefficients.last().is_some_and(Number::is_zero) {
            coefficients.pop();
        }
        Series { coefficients, rest, rest_at_start: rest }
    }

    /// The same function, of whose error less is known to be at the start.
    pub fn with_rest_at_start(self, rest_at_start: Magnitude) -> Series {
        Series { rest_at_start, ..self }
    }

    pub fn zero() -> Series {
        Series::new(Vec::new(), Magnitude::ZERO)
    }

    /// Whether it is known to be zero.
    pub fn is_zero(&self) -> bool {
        self.coefficients.is_empty() && self.rest.is_zero()
    }

    /// Whether it is a polynomial with rational coefficients.
    pub fn is_exact(&self) -> bool {
        self.rest.is_zero() && self.coefficients.iter().all(|c| c.exact().is_some())
    }

    /// Whether it is known to be constant.
    pub fn is_constant(&self) -> bool {
        self.coefficients.len() <= 1 && self.rest.is_zero()
    }

    /// `c_k`.
    pub fn coefficient(&self, k: usize) -> Number {
        self.coefficients.get(k).cloned().unwrap_or_else(Number::zero)
    }

    /// An enclosure of `f^(k)(0)/k!`: of `c_k`, and `γ^k/k!` times the rest.
    pub fn start(&self, k: usize, cut: &Truncation) -> Number {
        let mut rest = match k {
            0 => self.rest_at_start,
            _ => self.rest.scale(cut.rate * k as i64),
        };
        (2..=k as u64).for_each(|i| rest = rest.divide(i));
        self.coefficient(k).widened(&rest, cut.bits)
    }

    /// `a f + b g`.
    pub fn combine(&self, a: &Number, other: &Series, b: &Number, bits: u64) -> Series {
        let length = self.coefficients.len().max(other.coefficients.len());
        let term = |k| {
            let own = self.coefficient(k).multiply(a, bits);
            own.add(&other.coefficient(k).multiply(b, bits), bits)
        };
        let sizes = [a, b].map(Number::magnitude);
        let sum = |own: &Magnitude, other: &Magnitude| {
            own.multiply(&sizes[0]).add(&other.multiply(&sizes[1]))
        };
        Series::new((0..length).map(term).collect(), sum(&self.rest, &other.rest))
            .with_rest_at_start(sum(&self.rest_at_start, &other.rest_at_start))
    }

    pub fn add(&self, other: &Series, bits: u64) -> Series {
        self.combine(&Number::one(), other, &Number::one(), bits)
    }

    pub fn subtract(&self, other: &Series, bits: u64) -> Series {
        self.combine(&Number::one(), other, &Number::integer(-1), bits)
    }

    /// The series at `0 ≤ a ≤ h`: `f(a + x)`.
    ///
    /// # Cost
    /// `N²/2` products for `N` coefficients.
    pub fn shift(&self, a: &Number, cut: &Truncation) -> Series {
        if a.is_zero() {
            return self.clone();
        }
        let bits = cut.bits;
        let exact = a.exact().is_some() && self.is_exact() && self.coefficients.len() <= 4;
        if exact {
            let mut shifted = self.coefficients.clone();
            divide(&mut shifted, |c, next| c.add(&next.multiply(a, bits), bits));
            return Series::new(shifted, self.rest);
        }
        let (middle, radius) = a.split(bits);
        let mut shifted: Vec<Number> = self.coefficients.iter().map(|c| c.enclosed(bits)).collect();
        divide(&mut shifted, |c, next| c.add(&next.multiply(&middle, bits), bits));
        if !radius.is_zero() {
            // c'_j(a) − c'_j(m) = Σ_{i≥1} C(j+i, i) (a − m)^i c'_(j+i)(m).
            let sizes: Vec<Magnitude> = shifted.iter().map(Number::magnitude).collect();
            for (j, c) in shifted.iter_mut().enumerate() {
                *c = c.widened(&moved(&sizes, j, &radius), bits);
            }
        }
        Series::new(shifted, self.rest)
    }

    /// The same function, its coefficients without radii and without the last ones that tell nothing on a
    /// cell: what is left out of both goes to the rest. Constants and polynomials with rational coefficients
    /// stay as they are.
    pub fn settled(&self, norm: &CellNorm, cut: &Truncation) -> Series {
        match self.is_exact() || self.is_constant() {
            true => self.clone(),
            false => self.bare(norm, cut),
        }
    }

    /// The same function, all of its coefficients without radii.
    pub fn bare(&self, norm: &CellNorm, cut: &Truncation) -> Series {
        let mut power = Magnitude::power_of_two(0);
        let mut largest = Magnitude::ZERO;
        let sizes: Vec<Magnitude> = self.coefficients.iter().map(Number::magnitude).collect();
        for size in &sizes {
            largest = largest.max(size.multiply(&power));
            power = power.multiply(&norm.length);
        }
        let least = largest.scale(-(cut.bits as i64));
        let (mut kept, mut rest) = (sizes.len(), self.rest);
        while kept > 0 {
            let size = norm.of_term(kept - 1, &sizes[kept - 1]);
            if size > least {
                break;
            }
            rest = rest.add(&size);
            kept -= 1;
        }
        let mut radii = Vec::with_capacity(kept);
        let mut coefficients = Vec::with_capacity(kept);
        for c in &self.coefficients[..kept] {
            let (middle, radius) = c.split(cut.bits);
            coefficients.push(middle);
            radii.push(radius);
        }
        let at_start = radii.first().map_or(rest, |radius| self.rest_at_start.add(radius));
        Series::new(coefficients, rest.add(&norm.of_sizes(&radii))).with_rest_at_start(at_start)
    }

    /// The same function so much beyond the ends of the cell.
    pub fn extended(&self, by: &Magnitude, cut: &Truncation) -> Series {
        Series { rest: cut.extended(&self.rest, by), ..self.clone() }
    }

    /// The first coefficients of a polynomial in `ξ`, and a bound of its distance from `f(a + ξ)` for all
    /// `|ξ| ≤ h`. What no smaller `h` makes less, the rest, is in the radius of the first coefficient.
    ///
    /// After `m` divisions by `x − a` the polynomial that is kept is `Σ_{j<m} c'_j ξ^j + ξ^m Q(x)`, with
    /// `|Q(x)| ≤ Σ |q_k| (|a| + h)^k`.
    pub fn about(
        &self,
        a: &Number,
        h: &Magnitude,
        terms: usize,
        cut: &Truncation,
    ) -> (Vec<Number>, Magnitude) {
        let mut shifted = self.coefficients.clone();
        let length = shifted.len();
        for first in 0..terms.min(length) {
            for k in (first..length - 1).rev() {
                shifted[k] = shifted[k].add(&shifted[k + 1].multiply(a, cut.bits), cut.bits);
            }
        }
        let reach = a.magnitude().add(h);
        let mut rest = Magnitude::ZERO;
        for q in shifted.iter().skip(terms).rev() {
            rest = rest.multiply(&reach).add(&q.magnitude());
        }
        let rest = (0..terms).fold(rest, |rest, _| rest.multiply(h));
        shifted.resize(terms.max(1), Number::zero());
        shifted[0] = shifted[0].widened(&self.rest, cut.bits);
        (shifted, rest)
    }

    /// `P(x)`. Where `x` is enclosed, by the value and the slope `s` at its midpoint `m`:
    /// `|P(x) − P(m)| ≤ |x − m| (|s| + |x − m| Σ k(k−1)/2 |c_k| |x|^(k−2))`.
    pub fn polynomial(&self, x: &Number, bits: u64) -> Number {
        if x.exact().is_some() {
            let terms = self.coefficients.iter().rev();
            return terms.fold(Number::zero(), |sum, c| sum.multiply(x, bits).add(c, bits));
        }
        let (middle, radius) = x.split(bits);
        let terms = self.coefficients.iter().rev();
        let (value, slope) = terms.fold((Number::zero(), Number::zero()), |(sum, slope), c| {
            let slope = slope.multiply(&middle, bits).add(&sum, bits);
            (sum.multiply(&middle, bits).add(c, bits), slope)
        });
        let reach = x.magnitude();
        let bends = self.coefficients.iter().enumerate().skip(2).rev();
        let bend = bends.fold(Magnitude::ZERO, |sum, (k, c)| {
            let pairs = Magnitude::from_u64((k * (k - 1) / 2) as u64);
            sum.multiply(&reach).add(&c.magnitude().multiply(&pairs))
        });
        let change = slope.magnitude().add(&bend.multiply(&radius));
        value.widened(&change.multiply(&radius), bits)
    }

    /// `f(x)` for `0 ≤ x ≤ h`.
    pub fn value(&self, x: &Number, cut: &Truncation) -> Number {
        if x.is_zero() {
            return self.start(0, cut);
        }
        self.polynomial(x, cut.bits).widened(&self.rest, cut.bits)
    }

    /// A bound of `|Σ_{k≥n} c_k ξ^(k−n)|` for `|ξ| ≤ w`.
    pub fn size_from(&self, n: usize, w: &Magnitude) -> Magnitude {
        let terms = self.coefficients.iter().skip(n).rev();
        terms.fold(Magnitude::ZERO, |sum, c| sum.multiply(w).add(&c.magnitude()))
    }

    /// `start + ∫_0^x f`, on a cell that is no longer than the longest: `‖∫e‖ ≤ max(h, 1/γ) ‖e‖`.
    pub fn integral(&self, start: Number, cut: &Truncation) -> Series {
        self.integral_over(start, &cut.longest, cut)
    }

    /// The value of `integral`, this function's, at `x`: narrower than as that of any other function.
    pub fn integrated(&self, integral: &Series, x: &Number, bits: u64) -> Number {
        integral.polynomial(x, bits).widened(&self.rest.multiply(&x.magnitude()), bits)
    }

    /// The same on a cell of at most this length.
    pub fn integral_over(&self, start: Number, length: &Magnitude, cut: &Truncation) -> Series {
        let mut coefficients = vec![start];
        for (k, c) in self.coefficients.iter().enumerate() {
            coefficients.push(c.over(k as u64 + 1, cut.bits));
        }
        let longest = (*length).max(Magnitude::power_of_two(-cut.rate));
        Series::new(coefficients, self.rest.multiply(&longest)).with_rest_at_start(Magnitude::ZERO)
    }

    /// `f'`: `‖e'‖ ≤ γ ‖e‖`.
    pub fn derivative(&self, cut: &Truncation) -> Series {
        let terms = self.coefficients.iter().enumerate().skip(1);
        let slopes = terms.map(|(k, c)| c.multiply(&Number::integer(k as i64), cut.bits));
        Series::new(slopes.collect(), cut.per_time(&self.rest))
    }
}
