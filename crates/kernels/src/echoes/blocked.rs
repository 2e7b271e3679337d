//! Echoes at many points, side by side: a block of points shares every loop, and is so large that
//! no step of the recurrence waits for the one before.

use super::delay::{Delays, counts, since};
use super::description::{Echoes, Family};
use super::error::EchoError;
use super::exponential::exponential_lanes;
use super::stable::first_rounded;
use super::sum::EchoSum;
use crate::Limit;
use crate::double_double::DoubleDouble;
use crate::lanes::{Lanes, WIDTH};
use crate::vector::{Work, widest};
use std::array::from_fn;

/// Lanes are used while the exponents of `e^{−bx}` and of a bound of the polynomials are within this:
/// then neither leaves the range of doubles, and a product does only where the echo does.
const LARGEST_EXPONENT: f64 = 600.0;

/// Echoes whose exponent is provably below this count as 0: a million of them, with powers of the ratio
/// up to `10^10`, are below `2^−1040` times their coefficients.
const NOTHING: f64 = -760.0;

/// Arguments of which nothing is left beside their leading part.
const EXACT: bool = false;
/// Arguments of which something is left: polynomials are corrected by their slope.
const CORRECTED: bool = true;

/// `V` vectors of points: what one block holds.
type Vectors<L, const V: usize> = [L; V];

impl EchoSum {
    /// `f(T)` at many times, into `values`, as [`Method::Scaled`](super::Method::Scaled) sums it; the
    /// last bits may differ, because points are summed side by side in the widest registers of the
    /// machine.
    ///
    /// Times may come in any order; neighbours of the same period are fastest, because one
    /// exponential then serves all their echoes.
    ///
    /// After an error no value is written.
    pub fn fill(&self, times: &[f64], limit: Limit, values: &mut [f64]) -> Result<(), EchoError> {
        if times.len() != values.len() {
            return Err(EchoError::LengthsDiffer { times: times.len(), values: values.len() });
        }
        let Some(latest) = widest(Latest(times)) else { return Err(EchoError::NotFinite) };
        if times.is_empty() {
            return Ok(());
        }
        self.admit(DoubleDouble::from(latest), limit)?;
        widest(Fill { sum: self, times, limit, values });
        Ok(())
    }
}

/// The latest of some times, none if one of them is not finite. Lanes run side by side, so that no
/// comparison waits for the one before.
struct Latest<'a>(&'a [f64]);

impl Work for Latest<'_> {
    type Output = Option<f64>;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Option<f64> {
        let (mut latest, mut zeros) = (L::splat(f64::MIN), L::splat(0.0));
        let (vectors, rest) = self.0.as_chunks();
        let mut padded = [f64::MIN; WIDTH];
        padded[..rest.len()].copy_from_slice(rest);
        for vector in vectors.iter().chain([&padded]) {
            let vector = L::from_array(*vector);
            latest = latest.greater(vector);
            // What is not finite times 0 is no number, and stays so in a sum.
            zeros = zeros + vector * L::splat(0.0);
        }
        (zeros.sum() == 0.0).then(|| latest.to_array().into_iter().fold(f64::MIN, f64::max))
    }
}

/// The values of the wave at some times.
struct Fill<'a> {
    sum: &'a EchoSum,
    times: &'a [f64],
    limit: Limit,
    values: &'a mut [f64],
}

impl Work for Fill<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        match L::IN_FLIGHT {
            8.. => self.blocks::<L, 8>(),
            2.. => self.blocks::<L, 2>(),
            _ => self.blocks::<L, 1>(),
        }
    }
}

impl Fill<'_> {
    /// Block by block.
    #[inline(always)]
    fn blocks<L: Lanes, const V: usize>(self) {
        let Fill { sum, times, limit, values } = self;
        let size = V * WIDTH;
        for (times, values) in times.chunks(size).zip(values.chunks_mut(size)) {
            // A block that is not full is filled up with its last point.
            let block = match times.as_chunks() {
                (vectors, []) if vectors.len() == V => from_fn(|v| L::from_array(vectors[v])),
                _ => {
                    let mut padded = [[times[times.len() - 1]; WIDTH]; V];
                    padded.as_flattened_mut()[..times.len()].copy_from_slice(times);
                    padded.map(L::from_array)
                }
            };
            let result = match sum.echoes.family {
                Family::Laguerre => Block::<L, V>::new(sum, block, limit).sum::<Laguerre>(),
                Family::Powers => Block::<L, V>::new(sum, block, limit).sum::<Powers>(),
            };
            for (values, lanes) in values.chunks_mut(WIDTH).zip(result) {
                let lanes = lanes.to_array();
                match values.as_mut_array() {
                    Some(values) => *values = lanes,
                    None => values.copy_from_slice(&lanes[..values.len()]),
                }
            }
        }
    }
}

/// A block of times, and which echoes have arrived.
struct Block<'a, L: Lanes, const V: usize> {
    sum: &'a EchoSum,
    echoes: &'a Echoes,
    delays: &'a Delays,
    limit: Limit,
    times: Vectors<L, V>,
    /// So many echoes have arrived at every point, for sure.
    full: usize,
    /// No more have arrived at any.
    some: usize,
    earliest: f64,
    latest: f64,
}

impl<'a, L: Lanes, const V: usize> Block<'a, L, V> {
    /// `T/D` in doubles is off by less than `2^−51` of itself: where it is further from an integer,
    /// its floor is right for sure.
    #[inline(always)]
    fn new(sum: &'a EchoSum, times: Vectors<L, V>, limit: Limit) -> Self {
        let lesser = times.into_iter().fold(times[0], L::lesser);
        let greater = times.into_iter().fold(times[0], L::greater);
        let earliest = lesser.to_array().into_iter().fold(f64::INFINITY, f64::min);
        let latest = greater.to_array().into_iter().fold(f64::NEG_INFINITY, f64::max);
        let frequency = 1.0 / sum.echoes.period.high();
        let margin = 2f64.powi(-50);
        let count = |periods: f64| ((periods.floor() + 1.0).max(0.0) as usize).min(sum.last() + 1);
        let early = earliest * frequency;
        Block {
            sum,
            echoes: &sum.echoes,
            delays: &sum.delays,
            limit,
            times,
            full: count(early - early.abs() * margin - f64::MIN_POSITIVE),
            some: count(latest * frequency * (1.0 + margin)),
            earliest,
            latest,
        }
    }

    /// The sum of all echoes. Those that have arrived at every point share one exponential; the
    /// few others are masked.
    #[inline(always)]
    fn sum<P: Polynomials>(&self) -> Vectors<L, V> {
        let mut total = [L::splat(0.0); V];
        let first = self.echoes.first.len().min(self.some);
        for k in 0..first {
            let echo = |since: DoubleDouble| first_rounded(&self.echoes.first[k], since);
            self.add_lane_by_lane(k, echo, &mut total);
        }
        if first < self.full {
            self.add_arrived::<P>(first, &mut total);
        }
        for k in first.max(self.full)..self.some {
            if self.is_within(k, k) {
                self.add_masked::<P>(k, &mut total);
            } else {
                self.add_scaled(k, &mut total);
            }
        }
        total
    }

    /// Adds the echoes `first … full − 1`: with `R = full − 1` and `s = T − RD`, echo `k` arrived
    /// `s + (R−k)D` ago, a sum of what is not negative, and its exponential is that of `s` times a
    /// tabulated one.
    #[inline(always)]
    fn add_arrived<P: Polynomials>(&self, first: usize, total: &mut Vectors<L, V>) {
        let latest = self.full - 1;
        let zero = L::splat(0.0);
        let (mut lead, mut rest, mut decay) = ([zero; V], [zero; V], [zero; V]);
        for v in 0..V {
            let (high, low) = since_lanes(self.times[v], self.delays.of(latest));
            let (product, error) = times_pair(high, low, -self.echoes.rate.pair());
            decay[v] = exponential_lanes(product, error);
            (lead[v], rest[v]) = times_pair(high, low, self.scale::<P>());
        }
        // The last echo may have arrived this very moment: its argument is not split.
        let newest = Arguments { lead, rest, is_exact: false };
        let anchor = Anchor::above(self.latest * self.scale::<P>().high);
        let split = newest.split(anchor);
        let mut sum = [zero; V];
        let mut nothing = true;
        // Beyond their range these exponentials are wrong, and no echo asks for them. Powers of the
        // ratio lie between 1 and the last, and the first echo is the oldest.
        let all = self.is_within(latest, first);
        for k in first..self.full {
            let periods = latest - k;
            if all || self.is_within(k, k) {
                let factor = self.sum.decays[periods] * self.sum.ratio_powers[k];
                let arguments = match periods {
                    0 => newest,
                    _ => split.plus(anchor.split(P::signed(self.sum.arguments[periods]))),
                };
                if arguments.is_exact {
                    self.add_echo::<P, EXACT>(k, &arguments, factor, &mut sum);
                } else {
                    self.add_echo::<P, CORRECTED>(k, &arguments, factor, &mut sum);
                }
                nothing = false;
            } else if !self.is_nothing(k) {
                self.add_scaled(k, total);
            }
        }
        if nothing {
            return;
        }
        for v in 0..V {
            total[v] = decay[v].fused(sum[v], total[v]);
        }
    }

    /// The scale of the arguments.
    #[inline(always)]
    fn scale<P: Polynomials>(&self) -> DoubleDouble {
        P::signed(self.echoes.scale.pair())
    }

    /// Adds `factor` times the polynomial of echo `k`, corrected by what is left of its arguments.
    #[inline(always)]
    fn add_echo<P: Polynomials, const ARGUMENTS: bool>(
        &self,
        k: usize,
        arguments: &Arguments<L, V>,
        factor: f64,
        sum: &mut Vectors<L, V>,
    ) {
        let Arguments { lead: argument, rest, .. } = arguments;
        let mut relative = *rest;
        if ARGUMENTS == CORRECTED {
            for v in 0..V {
                relative[v] = rest[v] * argument[v].rough_reciprocal();
            }
        }
        let (mut value, mut slope) = ([L::splat(1.0); V], [L::splat(0.0); V]);
        let mut index = 0;
        for term in &self.echoes.terms {
            let Some(target) = k.checked_add_signed(-term.lag) else { continue };
            for &reciprocal in &self.sum.reciprocals[index..target] {
                let reciprocal = L::splat(reciprocal);
                for v in 0..V {
                    P::step(argument[v], reciprocal, &mut value[v], &mut slope[v]);
                }
            }
            index = target;
            let coefficient = L::splat(term.coefficient.high() * factor);
            for v in 0..V {
                let mut corrected = value[v];
                if ARGUMENTS == CORRECTED {
                    let slope = P::slope(value[v], slope[v], index);
                    corrected = slope.fused(relative[v], corrected);
                }
                sum[v] = corrected.fused(coefficient, sum[v]);
            }
        }
    }

    /// Adds an echo that has not arrived at all points.
    #[inline(always)]
    fn add_masked<P: Polynomials>(&self, k: usize, total: &mut Vectors<L, V>) {
        let zero = L::splat(0.0);
        let (mut lead, mut rest, mut weight) = ([zero; V], [zero; V], [zero; V]);
        let ratio = L::splat(self.sum.ratio_powers[k]);
        for v in 0..V {
            let since = since_lanes(self.times[v], self.delays.of(k));
            let counted = |lanes: L| match self.limit {
                Limit::Left => lanes.where_positive(since.0),
                Limit::Right => lanes.where_not_negative(since.0),
            };
            let (high, low) = (counted(since.0), counted(since.1));
            let (product, error) = times_pair(high, low, -self.echoes.rate.pair());
            weight[v] = exponential_lanes(product, error) * counted(ratio);
            (lead[v], rest[v]) = times_pair(high, low, self.scale::<P>());
        }
        let mut sum = [zero; V];
        let arguments = Arguments { lead, rest, is_exact: false };
        self.add_echo::<P, CORRECTED>(k, &arguments, 1.0, &mut sum);
        for v in 0..V {
            total[v] = weight[v].fused(sum[v], total[v]);
        }
    }

    /// Adds an echo by the scaled summation, point by point.
    #[inline(never)]
    fn add_scaled(&self, k: usize, total: &mut Vectors<L, V>) {
        self.add_lane_by_lane(k, |since| self.sum.scaled_echo(k, since), total);
    }

    #[inline(always)]
    fn add_lane_by_lane(
        &self,
        k: usize,
        echo: impl Fn(DoubleDouble) -> f64,
        total: &mut Vectors<L, V>,
    ) {
        for (times, total) in self.times.iter().zip(total) {
            let mut sums = total.to_array();
            for (time, sum) in times.to_array().into_iter().zip(&mut sums) {
                let since = since(self.delays.of(k), DoubleDouble::from(time));
                if counts(since.high, self.limit) {
                    *sum += echo(since);
                }
            }
            *total = L::from_array(sums);
        }
    }

    /// A bound of `ln |q_j(cx)|` for the largest index `j` of echo `k` and all smaller ones.
    ///
    /// `|q_j(X)| ≤ Σ_i C(j,i) |X|^i/i! ≤ Σ_i (j|X|)^i/i!² ≤ e^{2√(j|X|)}` in both families;
    /// `|L_j(X)| ≤ e^{X/2}` for `X ≥ 0`, and `|X^j/j!| ≤ e^{|X|}`. The slope `X q_j'` is at most `j` times
    /// the difference of two such values.
    #[inline(always)]
    fn growth(&self, k: usize, since: f64) -> f64 {
        let argument = since * self.echoes.scale.high();
        let index = self.echoes.largest_index(k).unwrap_or(0) as f64;
        let general = 2.0 * (index * argument.abs()).sqrt();
        match self.echoes.family {
            Family::Laguerre if argument >= 0.0 => general.min(0.5 * argument),
            Family::Laguerre => general,
            Family::Powers => general.min(argument.abs()),
        }
    }

    /// Whether the echoes `k … largest` are in the range of the lanes: the bound takes the largest
    /// index and the longest time, which is that of `k`.
    #[inline(always)]
    fn is_within(&self, largest: usize, k: usize) -> bool {
        let since = self.latest - self.delays.of(k)[0];
        let exponent = self.echoes.rate.high().abs() * since;
        let ratio = self.sum.ratio_powers[largest].abs();
        let moderate = ratio == 0.0 || (1e-20..1e20).contains(&ratio);
        moderate && exponent <= LARGEST_EXPONENT && self.growth(largest, since) <= LARGEST_EXPONENT
    }

    /// Whether echo `k` is below all doubles at every point: `−bx + 2√(j|c|x)` falls from
    /// `x = j|c|/b²` on.
    #[inline(always)]
    fn is_nothing(&self, k: usize) -> bool {
        let since = self.earliest - self.delays.of(k)[0];
        let (rate, scale) = (self.echoes.rate.high(), self.echoes.scale.high().abs());
        let index = self.echoes.largest_index(k).unwrap_or(0) as f64;
        let falls = rate > 0.0 && since * rate * rate > index * scale;
        let ratio = self.sum.ratio_powers[k].abs();
        falls && ratio <= 1e10 && 2.0 * (index * scale * since).sqrt() - rate * since < NOTHING
    }
}

/// A family of polynomials, as lanes step through it.
trait Polynomials {
    /// The scale of arguments, with the sign with which the recurrence takes it.
    fn signed(scale: DoubleDouble) -> DoubleDouble;
    /// One index further.
    fn step<L: Lanes>(argument: L, reciprocal: L, value: &mut L, slope: &mut L);
    /// `X q_j'(X)`.
    fn slope<L: Lanes>(value: L, slope: L, index: usize) -> L;
}

struct Laguerre;

impl Polynomials for Laguerre {
    #[inline(always)]
    fn signed(scale: DoubleDouble) -> DoubleDouble {
        -scale
    }

    #[inline(always)]
    fn step<L: Lanes>(argument: L, reciprocal: L, value: &mut L, slope: &mut L) {
        *slope = argument.fused(*value, *slope);
        *value = slope.fused(reciprocal, *value);
    }

    #[inline(always)]
    fn slope<L: Lanes>(_: L, slope: L, _: usize) -> L {
        slope
    }
}

struct Powers;

impl Polynomials for Powers {
    #[inline(always)]
    fn signed(scale: DoubleDouble) -> DoubleDouble {
        scale
    }

    #[inline(always)]
    fn step<L: Lanes>(argument: L, reciprocal: L, value: &mut L, _: &mut L) {
        *value = *value * (argument * reciprocal);
    }

    #[inline(always)]
    fn slope<L: Lanes>(value: L, _: L, index: usize) -> L {
        value * L::splat(index as f64)
    }
}

/// Arguments of polynomials, one a point, as sums of two doubles.
#[derive(Clone, Copy)]
struct Arguments<L, const V: usize> {
    lead: Vectors<L, V>,
    /// What is left, for a correction of first order.
    rest: Vectors<L, V>,
    /// Whether nothing is left, so that there is none to be made.
    is_exact: bool,
}

impl<L: Lanes, const V: usize> Arguments<L, V> {
    /// Split at an anchor. Nothing is left where times, period and scale have few bits.
    #[inline(always)]
    fn split(&self, Anchor(anchor): Anchor) -> Self {
        let (mut lead, mut rest, mut left) = (self.lead, self.rest, L::splat(0.0));
        for v in 0..V {
            let kept = (lead[v] + L::splat(anchor)) - L::splat(anchor);
            rest[v] = (lead[v] - kept) + rest[v];
            lead[v] = kept;
            left = left.greater(rest[v].abs());
        }
        Arguments { lead, rest, is_exact: left.to_array() == [0.0; WIDTH] }
    }

    /// With the same number added to all, split at the same anchor: without rounding in what leads.
    #[inline(always)]
    fn plus(&self, DoubleDouble { high, low }: DoubleDouble) -> Self {
        let (mut lead, mut rest) = (self.lead, self.rest);
        let is_exact = self.is_exact && low == 0.0;
        for v in 0..V {
            lead[v] = lead[v] + L::splat(high);
            if !is_exact {
                rest[v] = rest[v] + L::splat(low);
            }
        }
        Arguments { lead, rest, is_exact }
    }
}

/// Where arguments are split, so that sums of their leading parts are exact.
///
/// # Invariants
/// `H` is 0 or a power of two, with the sign of the arguments, and none of them is beyond `2H`.
///
/// `x + H`, rounded, is a multiple of `u = 2^−52 |H|`, and taking `H` away again is exact. So every
/// leading part is a multiple of `u`. The two that are added make an argument of the block, so that
/// their sum is not beyond `2H`, and a double. What is left of each is at most `u`, and has no bit below
/// the last of it.
///
/// The correction of first order takes `δ = 2u` at most, and `δ/X` from a reciprocal of 13 bits. It is off by
/// `2^−13 |δ q'(X)| + δ² |q''|/2`, and `|X q'| ≤ j` times what the polynomials are: by less than a unit in
/// the last place to `j = 200`, by some to 5000.
#[derive(Clone, Copy)]
struct Anchor(f64);

impl Anchor {
    /// For arguments up to the given one, with its sign.
    #[inline(always)]
    fn above(most: f64) -> Anchor {
        let roomy = most * (1.0 + 4.0 * f64::EPSILON);
        Anchor(f64::from_bits(roomy.to_bits() & (0xfff << 52)))
    }

    /// The leading part of a number, and what is left.
    #[inline(always)]
    fn split(self, DoubleDouble { high, low }: DoubleDouble) -> DoubleDouble {
        let lead = (high + self.0) - self.0;
        DoubleDouble { high: lead, low: (high - lead) + low }
    }
}

/// `(high + low) · factor` as two doubles, the second good to some bits.
#[inline(always)]
fn times_pair<L: Lanes>(high: L, low: L, factor: DoubleDouble) -> (L, L) {
    let lead = L::splat(factor.high);
    let (product, rounding) = high.product(lead);
    let rest = low.fused(lead, rounding);
    (product, high.fused(L::splat(factor.low), rest))
}

/// `T − delay` for times that are doubles: the sign is that of the difference, and so is a 0.
#[inline(always)]
fn since_lanes<L: Lanes>(time: L, [lead, middle, last]: [f64; 3]) -> (L, L) {
    let (high, error) = time.two_sum(L::splat(-lead));
    let (high, low) = high.two_sum(error - L::splat(middle));
    let (high, low) = high.two_sum(low - L::splat(last));
    (high, low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::echoes::{Expansion, Method, Term};
    use crate::vector::each_way;

    /// Values at times of a sum, by any lanes; the size of a block does not change them.
    #[derive(Clone)]
    struct Values<'a>(&'a EchoSum, &'a [f64]);

    impl Work for Values<'_> {
        type Output = Vec<f64>;

        fn run<L: Lanes>(self) -> Vec<f64> {
            let filled = |by_three: bool| {
                let mut values = vec![f64::NAN; self.1.len()];
                let Values(sum, times) = self;
                let fill = Fill { sum, times, limit: Limit::Right, values: &mut values };
                if by_three {
                    fill.blocks::<L, 3>()
                } else {
                    fill.run::<L>()
                }
                values
            };
            let (one, other) = (filled(false), filled(true));
            for (one, other) in one.iter().zip(other) {
                assert!((one - other).abs() < 1e-14, "{one} and {other}");
            }
            one
        }
    }

    /// Every version that this machine runs agrees with the scalar summation.
    #[test]
    fn all_versions_agree() {
        let number = |value: f64| Expansion::try_from(value).expect("a number");
        let term = |lag, value| Term { lag, coefficient: number(value) };
        let waves = [
            (Family::Laguerre, 2.0, 1.0, vec![term(0, 1.0)], 0.7),
            (Family::Laguerre, 0.6, -0.9, vec![term(1, -1.0), term(0, 0.5), term(-1, 0.3)], 0.5),
            (Family::Laguerre, -0.2, 0.3, vec![term(2, 1.0)], 2.0),
            (Family::Powers, 0.5, 0.8, vec![term(1, 1.0), term(0, -0.4)], 0.5),
        ];
        for (family, scale, ratio, terms, period) in waves {
            let [scale, ratio, period] = [scale, ratio, period].map(number);
            let wave = Echoes::new(family, Expansion::ONE, scale, ratio, &terms, period);
            let sum = EchoSum::new(wave.expect("a wave"), 60).expect("a sum");
            let step = period.parts()[0] / 17.0;
            let times: Vec<f64> = (0..1003).map(|i| f64::from(i) * step).collect();
            for version in each_way(&Values(&sum, &times)) {
                for (&time, value) in times.iter().zip(&version) {
                    let method = Method::Scaled;
                    let right = sum
                        .pair(method, DoubleDouble::from(time), Limit::Right)
                        .map(DoubleDouble::high)
                        .expect("in range");
                    assert!((value - right).abs() < 1e-14, "{time}: {value} and not {right}");
                }
            }
        }
    }
}
