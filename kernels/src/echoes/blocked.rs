//! Echoes at many points, side by side: a block of points shares every loop, and is so large that
//! no step of the recurrence waits for the one before.

use super::delay::{Delays, counts, since};
use super::description::{Echoes, Family};
use super::double_double::first_rounded;
use super::exponential::exponential_lanes;
use super::lanes::{Lanes, WIDTH};
use super::pair::Pair;
use super::sum::EchoSum;
use std::array::from_fn;

/// Lanes are used while the exponents of `e^{−bx}` and of a bound of the polynomials are within this:
/// then neither they nor their products leave the range of doubles.
const LARGEST_EXPONENT: f64 = 600.0;

/// Echoes whose exponent is provably below this are 0: a million of them are below `2^−1076`.
const NOTHING: f64 = -760.0;

/// `V` vectors of points: what one block holds.
type Vectors<L, const V: usize> = [L; V];

/// The values of the wave, block by block.
#[inline(always)]
pub(super) fn fill_blocks<L: Lanes, const V: usize>(
    sum: &EchoSum,
    times: &[f64],
    include_arriving: bool,
    values: &mut [f64],
) {
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
            Family::Laguerre => Block::<L, V>::new(sum, block, include_arriving).sum::<false>(),
            Family::Powers => Block::<L, V>::new(sum, block, include_arriving).sum::<true>(),
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

/// A block of times, and which echoes have arrived.
struct Block<'a, L: Lanes, const V: usize> {
    sum: &'a EchoSum,
    echoes: &'a Echoes,
    delays: &'a Delays,
    include_arriving: bool,
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
    fn new(sum: &'a EchoSum, times: Vectors<L, V>, include_arriving: bool) -> Self {
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
            include_arriving,
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
    fn sum<const POWERS: bool>(&self) -> Vectors<L, V> {
        let mut total = [L::splat(0.0); V];
        let first = self.echoes.first.len().min(self.some);
        for k in 0..first {
            let echo = |since: Pair| first_rounded(&self.echoes.first[k], since);
            self.add_lane_by_lane(k, echo, &mut total);
        }
        if first < self.full {
            self.add_arrived::<POWERS>(first, &mut total);
        }
        for k in first.max(self.full)..self.some {
            if self.is_within(k, k) {
                self.add_masked::<POWERS>(k, &mut total);
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
    fn add_arrived<const POWERS: bool>(&self, first: usize, total: &mut Vectors<L, V>) {
        let latest = self.full - 1;
        let mut high = [L::splat(0.0); V];
        let mut low = high;
        let mut decay = high;
        let rate = self.echoes.rate.pair();
        for v in 0..V {
            (high[v], low[v]) = since_lanes(self.times[v], self.delays.of(latest));
            let (product, rest) = times_pair(high[v], low[v], -rate);
            decay[v] = exponential_lanes(product, rest);
        }
        // Beyond their range these exponentials are wrong, and no echo asks for them. Powers of the
        // ratio lie between 1 and the last, and the first echo is the oldest.
        let all = self.is_within(latest, first);
        for k in first..self.full {
            if all || self.is_within(k, k) {
                let periods = latest - k;
                let [lead, rest, _] = self.delays.of(periods);
                let (lead, rest) = (L::splat(lead), L::splat(rest));
                let since = |v: usize| {
                    let (sum, rounding) = high[v].two_sum(lead);
                    (sum, rounding + (low[v] + rest))
                };
                let factor = L::splat(self.sum.decays[periods] * self.sum.ratio_powers[k]);
                let weight = |v: usize| decay[v] * factor;
                self.add_echo::<POWERS>(k, since, weight, total);
            } else if !self.is_nothing(k) {
                self.add_scaled(k, total);
            }
        }
    }

    /// Adds echo `k`, from the time since it arrived, as two doubles, and the factor of its
    /// polynomial, of each vector.
    #[inline(always)]
    fn add_echo<const POWERS: bool>(
        &self,
        k: usize,
        since: impl Fn(usize) -> (L, L),
        weight: impl Fn(usize) -> L,
        total: &mut Vectors<L, V>,
    ) {
        // Laguerre polynomials ask for the argument with its sign turned.
        let scale = self.echoes.scale.pair();
        let scale = if POWERS { scale } else { -scale };
        let (mut argument, mut relative) = ([L::splat(0.0); V], [L::splat(0.0); V]);
        for v in 0..V {
            let (high, low) = since(v);
            let (high, low) = times_pair(high, low, scale);
            relative[v] = low * high.rough_reciprocal();
            argument[v] = high;
        }
        let (mut value, mut slope) = ([L::splat(1.0); V], [L::splat(0.0); V]);
        let (mut index, mut polynomial) = (0, slope);
        for term in &self.echoes.terms {
            let Some(target) = k.checked_add_signed(-term.lag) else { continue };
            for &reciprocal in &self.sum.reciprocals[index..target] {
                let reciprocal = L::splat(reciprocal);
                for v in 0..V {
                    step::<L, POWERS>(argument[v], reciprocal, &mut value[v], &mut slope[v]);
                }
            }
            index = target;
            let coefficient = L::splat(term.coefficient.high());
            for v in 0..V {
                let slope = if POWERS { value[v] * L::splat(index as f64) } else { slope[v] };
                let corrected = slope.fused(relative[v], value[v]);
                polynomial[v] = corrected.fused(coefficient, polynomial[v]);
            }
        }
        for v in 0..V {
            total[v] = weight(v).fused(polynomial[v], total[v]);
        }
    }

    /// Adds an echo of which not all points have heard.
    #[inline(always)]
    fn add_masked<const POWERS: bool>(&self, k: usize, total: &mut Vectors<L, V>) {
        let (mut high, mut low, mut weight) = (self.times, self.times, self.times);
        let rate = self.echoes.rate.pair();
        let ratio = L::splat(self.sum.ratio_powers[k]);
        for v in 0..V {
            let since = since_lanes(self.times[v], self.delays.of(k));
            let counted = |lanes: L| lanes.where_counted(since.0, self.include_arriving);
            (high[v], low[v]) = (counted(since.0), counted(since.1));
            let (product, rest) = times_pair(high[v], low[v], -rate);
            weight[v] = exponential_lanes(product, rest) * counted(ratio);
        }
        self.add_echo::<POWERS>(k, |v| (high[v], low[v]), |v| weight[v], total);
    }

    /// Adds an echo by the scaled summation, point by point.
    #[inline(never)]
    fn add_scaled(&self, k: usize, total: &mut Vectors<L, V>) {
        self.add_lane_by_lane(k, |since| self.sum.scaled_echo(k, since), total);
    }

    #[inline(always)]
    fn add_lane_by_lane(&self, k: usize, echo: impl Fn(Pair) -> f64, total: &mut Vectors<L, V>) {
        for (times, total) in self.times.iter().zip(total) {
            let mut sums = total.to_array();
            for (time, sum) in times.to_array().into_iter().zip(&mut sums) {
                let since = since(self.delays.of(k), Pair::from(time));
                if counts(since.high, self.include_arriving) {
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

/// One index further, as in the scalar recurrence; powers form their slope at the end.
#[inline(always)]
fn step<L: Lanes, const POWERS: bool>(argument: L, reciprocal: L, value: &mut L, slope: &mut L) {
    if POWERS {
        *value = *value * (argument * reciprocal);
    } else {
        *slope = argument.fused(*value, *slope);
        *value = slope.fused(reciprocal, *value);
    }
}

/// `(high + low) · factor` as two doubles, the second good to some bits.
#[inline(always)]
fn times_pair<L: Lanes>(high: L, low: L, factor: Pair) -> (L, L) {
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
