//! What a wave holds between two instants: `∫ w dt` and `∫ w² dt`, to which the momentum and the energy
//! of a bar are proportional.
//!
//! What a whole cell holds is worked out once, when it is first asked for, and kept.

use crate::ball::{Magnitude, Number};
use crate::history::series::{CellNorm, Series, Truncation};
use std::cell::OnceCell;

/// `∫_0^x f²` of a series `f(x) = Σ c_k x^k`.
///
/// `f² = Σ p_k x^k` with `p_k = Σ_{i+j=k} c_i c_j`. The first `M` of these are kept and the others bounded.
///
/// # Invariants
/// - `coefficients` hold `p_k/(k+1)` for `k < M`;
/// - `sizes` hold bounds of `|c_k|` for `k < N`;
/// - `rest` bounds what the polynomial of the series leaves out.
#[derive(Clone, PartialEq, Debug)]
pub struct Energy {
    pub coefficients: Vec<Number>,
    sizes: Vec<Magnitude>,
    rest: Magnitude,
    bits: u64,
}

impl Series {
    /// `∫_0^x f²`. A polynomial with rational coefficients gives all of its square, other series the `N`
    /// coefficients that they have themselves.
    /// These are `n²/4` products for `n` coefficients, `n²` for rational ones.
    pub fn energy(&self, cut: &Truncation) -> Energy {
        let bits = cut.bits;
        let mut own = self.coefficients.clone();
        let mut length = (2 * own.len()).saturating_sub(1);
        if !self.is_exact() {
            // p_k with k < N needs no c_j with j ≥ N.
            length = length.min(cut.order.max(own.len()));
            own.iter_mut().for_each(|c| *c = c.enclosed(bits));
        }
        let product = |k: usize| {
            // c_i c_j and c_j c_i are one product.
            let first = (k + 1).saturating_sub(own.len());
            let mut sum = (first..k.div_ceil(2))
                .fold(Number::zero(), |sum, i| sum.add(&own[i].multiply(&own[k - i], bits), bits));
            sum = sum.add(&sum, bits);
            if k.is_multiple_of(2) {
                sum = sum.add(&own[k / 2].multiply(&own[k / 2], bits), bits);
            }
            sum.over(k as u64 + 1, bits)
        };
        let coefficients = (0..length).map(product).collect();
        let sizes = own.iter().map(Number::magnitude).collect();
        Energy { coefficients, sizes, rest: self.error, bits }
    }
}

impl Energy {
    /// `∫_0^x f²`, an enclosure, for `0 ≤ x`, `γ x ≤ 8`.
    pub fn value(&self, x: &Number) -> Number {
        let bits = self.bits;
        let mut sum = Number::zero();
        for c in self.coefficients.iter().rev() {
            sum = sum.add(c, bits).multiply(x, bits);
        }
        let size = x.magnitude();
        sum.widened(&self.omitted(&size).multiply(&size), bits)
    }

    /// A bound of `|f² − Σ_{k<M} p_k x^k|` at all points up to `x`.
    ///
    /// With `a_k = |c_k| x^k` and `t_m = Σ_{j≥m} a_j`, the terms of the square that are not kept are those
    /// with `i + j ≥ M`, together at most
    /// `Σ_{i<N} a_i t_{M−i} + Σ_{i≥N} a_i t_0 = Σ_{i<N} a_i t_{M−i} + t_N t_0`, where `t_m = t_0` for `m ≤ 0`.
    /// And `t_N ≤ ε`, the remainder of the series, so that `t_m ≤ Σ_{m≤j<N} a_j + ε` for all `m`. All of it
    /// grows with `x`.
    ///
    /// It is no wider than it need be: where `|c_k| x^k ≤ C z^k/k!` for all `k`, the sum is at most
    /// `C² Σ_{k≥M} (2z)^k/k!`, since `Σ_{i+j=k} 1/(i! j!) = 2^k/k!`. And `γ` is at least twice the rate of
    /// every node and load, so that `2z ≤ γ h`, for which `N` is chosen.
    pub fn omitted(&self, x: &Magnitude) -> Magnitude {
        let mut power = Magnitude::power_of_two(0);
        let terms: Vec<Magnitude> = self
            .sizes
            .iter()
            .map(|size| {
                let term = size.multiply(&power);
                power = power.multiply(x);
                term
            })
            .collect();
        let remainder = self.rest;
        // t_n, t_(n−1), …, t_0.
        let mut tails = vec![remainder];
        for term in terms.iter().rev() {
            tails.push(tails[tails.len() - 1].add(term));
        }
        let whole = tails[terms.len()];
        let tail = |m: usize| &tails[terms.len() - m.min(terms.len())];
        let products = terms
            .iter()
            .enumerate()
            .map(|(i, term)| term.multiply(tail(self.coefficients.len().saturating_sub(i))));
        products.fold(remainder.multiply(&whole), |sum, product| sum.add(&product))
    }
}

/// A wave on one cell: its series, with its integrals over the cell once they have been asked for.
///
/// # Invariants
/// The series and the length never change, all series of a history are cut off in one way, and all that is told
/// of it has one precision: what is kept stays true.
#[derive(Debug)]
pub struct Wave {
    series: Series,
    length: Number,
    /// Of the wave, of its square as it is told, and roughly.
    whole: [OnceCell<Number>; 3],
}

/// Which integral of a wave is meant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Integrand {
    /// `∫ w dt`.
    Wave,
    /// `∫ w² dt` with so many bits: what is told of a history takes fewer than following it.
    Square { bits: u64 },
}

impl Integrand {
    /// For bounds.
    pub const ROUGH_SQUARE: Integrand = Integrand::Square { bits: ROUGH_BITS };
}

/// The precision of what is worked out roughly.
const ROUGH_BITS: u64 = 64;

impl Wave {
    /// A wave on a cell of this length.
    pub fn new(series: Series, length: Number) -> Wave {
        Wave { series, length, whole: Default::default() }
    }

    /// The series.
    pub fn series(&self) -> &Series {
        &self.series
    }

    /// How long its cell is.
    pub fn length(&self) -> &Number {
        &self.length
    }

    /// The series, when the wave is no longer needed.
    pub fn take_series(&mut self) -> Series {
        std::mem::replace(&mut self.series, Series::zero())
    }

    /// Whether so few bits are asked for that they change anything.
    fn is_rough(&self, bits: u64, cut: &Truncation) -> bool {
        !self.series.is_exact() && bits < cut.bits
    }

    /// An integral from the start of the cell to a time after it; of a square with fewer bits that of the polynomial
    /// with as many terms as these tell, of an exact one all of it.
    pub fn until(&self, integrand: Integrand, time: &Number, cut: &Truncation) -> Number {
        match integrand {
            Integrand::Wave => self.series.integral(Number::zero(), cut).value(time, cut),
            Integrand::Square { bits } if self.is_rough(bits, cut) => {
                let few = Truncation { bits, ..*cut };
                let norm = CellNorm::new(self.length.magnitude(), &few);
                self.series.bare(&norm, &few).energy(&few).value(time)
            }
            Integrand::Square { .. } => self.series.energy(cut).value(time),
        }
    }

    /// An integral over the whole cell.
    pub fn whole(&self, integrand: Integrand, cut: &Truncation) -> &Number {
        let place = match integrand {
            Integrand::Wave => 0,
            Integrand::Square { bits: ROUGH_BITS } if self.is_rough(ROUGH_BITS, cut) => 2,
            Integrand::Square { .. } => 1,
        };
        self.whole[place].get_or_init(|| self.until(integrand, &self.length, cut))
    }
}
