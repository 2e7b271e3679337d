//! A function of time on one cell: a polynomial and a bound of what it leaves out.
//!
//! Between two arrivals every signal is a sum of polynomials times exponentials, so a Taylor polynomial at
//! the start of the cell comes as near to it as wanted. What it leaves out, and all errors that came before,
//! is a function of the same kind, of which one bound is kept: in the *norm of the cell*,
//! `‖e‖ = sup |e^(j)(x)|/γ^j` over all `j ≥ 0` and all `x` of the cell. With a rate `γ` above all rates of the
//! scene this norm bounds the error of every derivative at once, and shifts within the cell leave it as it is:
//! nothing is lost from cell to cell but what a node itself amplifies.
//!
//! A node that passes all energy on may still amplify this norm, by three at most where a mass reflects. So values
//! have a bound of their own, which the energy of all errors keeps small: see `passive`.
//!
//! What a local contact sends out is analytic only near the cell, so that its derivatives grow as factorials. Its
//! errors are bounded in a weaker norm, that of a [`Roughness`].

use crate::ball::{Ball, Magnitude, Number};
use crate::signal::{Signed, divide, divide_often};
use std::cmp::Ordering;

/// How near to its cell a function may cease to be analytic. Sums, integrals, shifts and the equations of a node keep
/// it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Roughness {
    /// With a roughness `r` a bound `ρ` of its error means `|e^(j)(x)| ≤ ρ j! 2^(rj)` for all `j ≥ 0`. Any error in
    /// the norm of the cell is one of each roughness `2^r ≥ γ`.
    Within(i64),
    /// Nothing but values is bounded.
    Values,
}

/// What stands for a bound of derivatives where there is none, as a power of two: no value of a scene comes near, so
/// that nothing is decided by it.
const NO_BOUND: i64 = 1 << 40;

impl Roughness {
    /// Of a function that is bounded at all distances up to this one from its cell; no smoother than the norm of
    /// cells.
    pub fn within(distance: &Magnitude, cut: &Truncation) -> Roughness {
        let rate = |top: i64| Roughness::Within((1 - top).max(cut.rate));
        distance.top().map_or(Roughness::Values, rate)
    }

    /// The distance within which values are bounded.
    pub fn distance(self) -> Magnitude {
        match self {
            Roughness::Within(rate) => Magnitude::power_of_two(-rate),
            Roughness::Values => Magnitude::ZERO,
        }
    }

    /// That of half the distance.
    pub fn halved(self) -> Roughness {
        match self {
            Roughness::Within(rate) => Roughness::Within(rate + 1),
            Roughness::Values => Roughness::Values,
        }
    }
}

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
    /// That of errors on the cell.
    pub roughness: Option<Roughness>,
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
        CellNorm { length, powers, largest, factors, roughness: None }
    }

    /// That of a cell on which these series are known, as rough as they are.
    pub fn of_series<'a>(
        known: impl Iterator<Item = &'a Series>,
        length: &Number,
        cut: &Truncation,
    ) -> CellNorm {
        let roughness = known.filter_map(|series| series.roughness).max();
        CellNorm { roughness, ..CellNorm::new(length.magnitude(), cut) }
    }

    /// `1/γ`, or the distance within which a rough function is bounded.
    fn unit(&self) -> Magnitude {
        self.roughness.map_or(self.factors[1], Roughness::distance)
    }

    /// `‖c x^k‖ = |c| k!/γ^k · max_{i≤k} (γh)^i/i!`. Of a rough function, by what it is within the distance `δ` of
    /// the cell, at most `|c| (h + δ)^k`.
    pub fn of_term(&self, k: usize, size: &Magnitude) -> Magnitude {
        if let Some(roughness) = self.roughness {
            let reach = self.length.add(&roughness.distance());
            return (0..k).fold(*size, |norm, _| norm.multiply(&reach));
        }
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
        norm.divide(3).multiply(&self.unit())
    }

    /// A bound of `‖Σ c_k x^k‖` for all `|c_k| ≤ s_k`: with `q_k = s_k k!/γ^k` the derivative of order `j` is
    /// at most `γ^j Σ_{k≥j} q_k (γh)^(k−j)/(k−j)!`, and so `Σ_i (γh)^i/i! · max_{k≥i} q_k` bounds all of them.
    pub fn of_sizes(&self, sizes: &[Magnitude]) -> Magnitude {
        if let Some(roughness) = self.roughness {
            let reach = self.length.add(&roughness.distance());
            let terms = sizes.iter().rev();
            return terms.fold(Magnitude::ZERO, |sum, size| sum.multiply(&reach).add(size));
        }
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

/// The coefficients at `a` of a polynomial in balls, for a number `a` without radius: once `c_k` is scaled by `a^k`,
/// division by `x − a` takes additions only.
fn recentered(coefficients: &[Number], a: &Number, bits: u64) -> Vec<Number> {
    if a.magnitude().is_zero() {
        return coefficients.to_vec();
    }
    let inverse = a.reciprocal(bits).expect("a number without radius, and not zero");
    let scaled = |own: &[Number], factor: &Number| -> Vec<Number> {
        let next = |power: &Number| Some(power.multiply(factor, bits));
        let powers = std::iter::successors(Some(Number::one()), next);
        own.iter().zip(powers).map(|(c, power)| c.multiply(&power, bits)).collect()
    };
    let mut shifted = scaled(coefficients, a);
    divide(&mut shifted, |c, next| c.add(next, bits));
    scaled(&shifted, &inverse)
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
/// - `‖e‖ ≤ rest` in the norm of the cell, and so on every part of it; where it is rough, in the norm of its roughness;
/// - `|e(x)| ≤ error` on the cell, and `|e(0)| ≤ error_at_start`;
/// - `|e'(x)| ≤ slope` on the cell, where known: of an integral the error of the integrand, often far below what `rest`
///   tells of a rough function;
/// - `f` and its derivatives below the order `flat` are exactly zero at `x = 0`, whatever its coefficients say, and so are
///   those of the orders `1 … steady`, at least `flat - 1` of them;
/// - `|e(x)| ≤ fresh` if what arrived at the node, and its state at the start of the cell, had been free of errors.
#[derive(Clone, PartialEq, Debug)]
pub struct Series {
    pub coefficients: Vec<Number>,
    pub rest: Magnitude,
    pub error: Magnitude,
    pub fresh: Magnitude,
    pub(super) error_at_start: Magnitude,
    pub(super) flat: usize,
    pub(super) steady: usize,
    pub(super) slope: Option<Magnitude>,
    pub roughness: Option<Roughness>,
    /// Its sign on the cell, where that is known otherwise.
    pub signed: Option<Signed>,
}

/// The sign of a sum of series with factors: of those that are not zero, where all have the same.
fn sign_of_sum(parts: [(&Series, &Number); 2]) -> Option<Signed> {
    let mut known: Option<Signed> = None;
    for (series, factor) in parts {
        if series.is_zero() || factor.is_zero() {
            continue;
        }
        let own = series.signed?;
        let own = match factor.sign()? {
            Ordering::Less => Signed { sign: own.sign.reverse(), ..own },
            _ => own,
        };
        known = Some(known.map_or(Some(own), |known| known.and(own))?);
    }
    known
}

impl Series {
    /// How many bytes it takes, about.
    pub fn bytes(&self) -> u64 {
        let further = self.coefficients.iter().map(|c| match c {
            Number::Exact(_) => 0,
            Number::Enclosed(ball) => Ball::further_bytes(ball.midpoint().bits()),
        });
        let room = self.coefficients.capacity() * size_of::<Number>() + size_of::<Series>();
        room as u64 + further.sum::<u64>()
    }

    /// A constant.
    pub fn constant(value: Number) -> Series {
        Series::new(vec![value], Magnitude::ZERO)
    }

    /// The polynomial with these coefficients, and a bound of the rest, all of which is fresh.
    pub fn new(mut coefficients: Vec<Number>, rest: Magnitude) -> Series {
        while coefficients.last().is_some_and(Number::is_zero) {
            coefficients.pop();
        }
        let (error, fresh, error_at_start) = (rest, rest, rest);
        let (flat, steady, slope, roughness, signed) = (0, 0, None, None, None);
        Series {
            coefficients,
            rest,
            error,
            fresh,
            error_at_start,
            flat,
            steady,
            slope,
            roughness,
            signed,
        }
    }

    /// The same function, of whose error less is known to be at the start.
    pub fn with_error_at_start(self, error_at_start: Magnitude) -> Series {
        Series { error_at_start, ..self }
    }

    /// The same function, whose values have an error of this size, so much of it fresh.
    pub fn with_error(self, error: Magnitude, fresh: Magnitude) -> Series {
        let error_at_start = self.error_at_start.min(error);
        Series { error, fresh, error_at_start, ..self }
    }

    /// How many derivatives are known to be exactly zero at the start; all of them where it is zero.
    pub fn flatness(&self) -> usize {
        let leading = || self.coefficients.iter().take_while(|c| c.is_zero()).count();
        match self.rest.is_zero() {
            true if self.coefficients.is_empty() => usize::MAX,
            true => self.flat.max(leading()),
            false => self.flat,
        }
    }

    /// The same of its derivative.
    pub fn steadiness(&self) -> usize {
        let leading = || self.coefficients.iter().skip(1).take_while(|c| c.is_zero()).count();
        match self.rest.is_zero() {
            true if self.coefficients.len() <= 1 => usize::MAX,
            true => self.steady.max(leading()),
            false => self.steady,
        }
    }

    /// The same polynomial with other coefficients, as far as its errors go.
    fn with_coefficients(&self, coefficients: Vec<Number>) -> Series {
        let (slope, roughness) = (self.slope, self.roughness);
        let own = Series::new(coefficients, self.rest).with_error(self.error, self.fresh);
        Series { slope, roughness, ..own }
    }

    /// Keeps its sign where that was proven, but not at the end of a cell where a contact opens.
    pub fn keep_sign(&mut self, is_proven: bool, opens: bool) {
        self.signed = self.signed.filter(|_| is_proven).map(|own| {
            let at_ends = [own.at_ends[0], own.at_ends[1] && !opens];
            Signed { at_ends, ..own }
        });
    }

    pub fn zero() -> Series {
        Series::new(Vec::new(), Magnitude::ZERO)
    }

    /// A bound of the derivative of an order of its error, of which values are bounded by `error`.
    pub fn bound_of_derivative(
        &self,
        error: &Magnitude,
        order: usize,
        cut: &Truncation,
    ) -> Magnitude {
        let rate = match self.roughness {
            None => return error.scale(cut.rate * order as i64),
            Some(Roughness::Values) if order > 0 && !error.is_zero() => {
                return Magnitude::power_of_two(NO_BOUND);
            }
            Some(Roughness::Values) => 0,
            Some(Roughness::Within(rate)) => rate,
        };
        let grown = error.scale(rate * order as i64);
        (2..=order as u64).fold(grown, |bound, j| bound.multiply(&Magnitude::from_u64(j)))
    }

    /// The bound of its error or of the slope of it so much beyond the ends of its cell: `e^(γ by)` times that on the
    /// cell. A rough error goes on with the value that it has at the end: any function that is continuous will do
    /// beyond the cell, since roots and values are told within it.
    pub fn bound_beyond(&self, bound: &Magnitude, by: &Magnitude, cut: &Truncation) -> Magnitude {
        match by.is_zero() || bound.is_zero() || self.roughness.is_some() {
            true => *bound,
            false => bound.multiply(&growth(&cut.per_time(by))),
        }
    }

    /// A bound of `|e'|`, where `slope` or a rest of zero gives one.
    fn slope_error(&self) -> Option<Magnitude> {
        self.slope.or(self.rest.is_zero().then_some(Magnitude::ZERO))
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

    /// An enclosure of `f^(k)(0)/k!`: of `c_k`, and a bound of that derivative of the rest over `k!`.
    pub fn start(&self, k: usize, cut: &Truncation) -> Number {
        if k < self.flat || k > 0 && k <= self.steady {
            return Number::zero();
        }
        let mut rest = match k {
            0 => self.error_at_start,
            _ => self.bound_of_derivative(&self.rest, k, cut),
        };
        (2..=k as u64).for_each(|i| rest = rest.divide(i));
        self.coefficient(k).widened(&rest, cut.bits)
    }

    /// `a f + b g`.
    pub fn combine(&self, a: &Number, other: &Series, b: &Number, bits: u64) -> Series {
        let length = self.coefficients.len().max(other.coefficients.len());
        let scaled = |series: &Series, k: usize, factor: &Number| {
            series.coefficients.get(k).map(|c| c.multiply(factor, bits))
        };
        let term = |k| match (scaled(self, k, a), scaled(other, k, b)) {
            (Some(own), Some(other)) => own.add(&other, bits),
            (own, other) => own.or(other).unwrap_or_else(Number::zero),
        };
        let sizes = [a, b].map(Number::magnitude);
        let sum = |own: &Magnitude, other: &Magnitude| {
            own.multiply(&sizes[0]).add(&other.multiply(&sizes[1]))
        };
        let slopes = self.slope_error().zip(other.slope_error());
        let least = |of: fn(&Series) -> usize| {
            let parts = [(self, a), (other, b)].into_iter();
            let acting = parts.filter(|(_, factor)| !factor.is_zero());
            acting.map(|(series, _)| of(series)).min().unwrap_or(usize::MAX)
        };
        Series {
            error: sum(&self.error, &other.error),
            fresh: sum(&self.fresh, &other.fresh),
            error_at_start: sum(&self.error_at_start, &other.error_at_start),
            flat: least(Series::flatness),
            steady: least(Series::steadiness),
            slope: slopes.map(|(own, other)| sum(&own, &other)),
            roughness: self.roughness.max(other.roughness),
            signed: sign_of_sum([(self, a), (other, b)]),
            ..Series::new((0..length).map(term).collect(), sum(&self.rest, &other.rest))
        }
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
    /// `N²/2` sums and `4N` products for `N` coefficients.
    pub fn shift(&self, a: &Number, cut: &Truncation) -> Series {
        if a.is_zero() {
            return self.clone();
        }
        let bits = cut.bits;
        let signed = self.signed.map(|own| Signed { at_ends: [true, own.at_ends[1]], ..own });
        let exact = a.exact().is_some() && self.is_exact() && self.coefficients.len() <= 4;
        if exact {
            let mut shifted = self.coefficients.clone();
            divide(&mut shifted, |c, next| c.add(&next.multiply(a, bits), bits));
            return self.with_coefficients(shifted);
        }
        let (middle, radius) = a.split(bits);
        let own: Vec<Number> = self.coefficients.iter().map(|c| c.enclosed(bits)).collect();
        let mut shifted = recentered(&own, &middle, bits);
        if !radius.is_zero() {
            // c'_j(a) − c'_j(m) = Σ_{i≥1} C(j+i, i) (a − m)^i c'_(j+i)(m).
            let sizes: Vec<Magnitude> = shifted.iter().map(Number::magnitude).collect();
            for (j, c) in shifted.iter_mut().enumerate() {
                *c = c.widened(&moved(&sizes, j, &radius), bits);
            }
        }
        Series { signed, ..self.with_coefficients(shifted) }
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
        let (mut kept, mut added) = (sizes.len(), Magnitude::ZERO);
        while kept > 0 {
            let size = norm.of_term(kept - 1, &sizes[kept - 1]);
            if size > least {
                break;
            }
            added = added.add(&size);
            kept -= 1;
        }
        let mut radii = Vec::with_capacity(kept);
        let mut coefficients = Vec::with_capacity(kept);
        for c in &self.coefficients[..kept] {
            let (middle, radius) = c.split(cut.bits);
            coefficients.push(middle);
            radii.push(radius);
        }
        let dropped = sizes.first().filter(|_| radii.is_empty());
        let off = radii.first().or(dropped).copied().unwrap_or(Magnitude::ZERO);
        let rounded = radii
            .iter()
            .rev()
            .fold(Magnitude::ZERO, |sum, radius| sum.multiply(&norm.length).add(radius));
        let rounded = rounded.add(&added);
        Series {
            error: self.error.add(&rounded),
            fresh: self.fresh.add(&rounded),
            error_at_start: self.error_at_start.add(&off),
            flat: self.flat,
            steady: self.steady,
            roughness: self.roughness.max(norm.roughness),
            signed: self.signed,
            ..Series::new(coefficients, self.rest.add(&added).add(&norm.of_sizes(&radii)))
        }
    }

    /// The same function so much beyond the ends of the cell.
    pub fn extended(&self, by: &Magnitude, cut: &Truncation) -> Series {
        let rest = self.bound_beyond(&self.rest, by, cut);
        let keeps_bounds = by.is_zero() || self.roughness.is_some();
        let error = if keeps_bounds { self.error } else { rest };
        let slope = self.slope.filter(|_| keeps_bounds);
        Series { rest, error, slope, ..self.clone() }
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
        let step = |c: &Number, next: &Number| c.add(&next.multiply(a, cut.bits), cut.bits);
        divide_often(&mut shifted, terms, step);
        let reach = a.magnitude().add(h);
        let mut rest = Magnitude::ZERO;
        for q in shifted.iter().skip(terms).rev() {
            rest = rest.multiply(&reach).add(&q.magnitude());
        }
        let rest = (0..terms).fold(rest, |rest, _| rest.multiply(h));
        shifted.resize(terms.max(1), Number::zero());
        shifted[0] = shifted[0].widened(&self.error, cut.bits);
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
        self.polynomial(x, cut.bits).widened(&self.error, cut.bits)
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
        integral.polynomial(x, bits).widened(&self.error.multiply(&x.magnitude()), bits)
    }

    /// The same on a cell of at most this length: `|∫e| ≤ h sup |e|`.
    pub fn integral_over(&self, start: Number, length: &Magnitude, cut: &Truncation) -> Series {
        let mut coefficients = vec![start];
        for (k, c) in self.coefficients.iter().enumerate() {
            coefficients.push(c.over(k as u64 + 1, cut.bits));
        }
        let longest = (*length).max(Magnitude::power_of_two(-cut.rate));
        let flat = if coefficients[0].is_zero() { self.flatness().saturating_add(1) } else { 0 };
        Series {
            error: self.error.multiply(length),
            fresh: self.fresh.multiply(length),
            error_at_start: Magnitude::ZERO,
            flat,
            steady: self.flatness(),
            slope: Some(self.error),
            roughness: self.roughness,
            ..Series::new(coefficients, self.rest.multiply(&longest))
        }
    }

    /// `f'`, its error below `slope` where that is known: `‖e'‖ ≤ γ ‖e‖`; of a rough function `(j+1)! 2^(r(j+1)) ≤ 2^r · j! 2^((r+1)j)`.
    pub fn derivative(&self, cut: &Truncation) -> Series {
        let terms = self.coefficients.iter().enumerate().skip(1);
        let slopes = terms.map(|(k, c)| c.multiply(&Number::integer(k as i64), cut.bits));
        let rest = self.bound_of_derivative(&self.rest, 1, cut);
        let error = self.slope.unwrap_or(rest);
        let (flat, steady) = (self.steady, self.steady.saturating_sub(1));
        let roughness = self.roughness.map(Roughness::halved);
        Series {
            flat,
            steady,
            roughness,
            ..Series::new(slopes.collect(), rest).with_error(error, error)
        }
    }
}
