//! The proof that computed polynomials are near the true wave.
//!
//! The doubles that a march computes are exact numbers: polynomials `p_n` and `u_n`, meant to be
//! `y_n` and `v_n = y_n − ρ y_{n−1}`. A certificate takes them as they are, however they were made,
//! measures by how much they miss the equations, and bounds by how much they miss the wave.
//! The proofs are in `docs/energy-bound.md`; here is what they prove, and how it is computed.
//!
//! # What is measured
//!
//! Write `Δ_n = p_n − y_n`, `g = p_{n−1}`, `e = p_n − ρ g − u_n`, `w = u_n + e = p_n − ρ p_{n−1}`,
//! `C = ρ (A + B)`. Let `G_n` be the antiderivative of `−(B w + C g)` whose constant coefficient is
//! that of `u_n`, and `R_n = w − G_n`. On coefficients, with the constant one counted twice in the
//! row `k = 1`,
//!
//! `k R_k = k w_k + (B/4)(w_{k−1} − w_{k+1}) + (C/4)(g_{k−1} − g_{k+1})`, `k ≥ 1`, `R_0 = e_0`.
//!
//! `d̃ = G_n − v_n` then satisfies `d̃' + B d̃ = −C Δ_{n−1} − B R_n`, and
//! `Δ_n = ρ Δ_{n−1} + d̃ + R_n`. Two more numbers are measured at the joint of periods `n − 1` and
//! `n`: `j_n = G_n(0) − G_{n−1}(1)` and `J_n = p_n(0) − p_{n−1}(1) − ρⁿ = Δ_n(0) − Δ_{n−1}(1)`; on
//! the first period `j_0 = G_0(0) − 1`, `J_0 = p_0(0) − 1`.
//!
//! # A passive reflection: the energy
//!
//! Let `|ρ| ≤ 1`, `|ρA| ≤ B`, `s = ρ²A + B > 0`, `κ = 1/(s + √(s² − C²))` and `Γ = √(1 + κB/2)`. A step
//! without residual does not enlarge the norm `E² = ‖Δ‖² + κ d̃(1)²` of the state `(Δ_n, d̃_n(1))`, and a
//! residual adds
//!
//! `E_n ≤ E_{n−1} + Γ ‖R_n‖ + √κ |j_n|`.
//!
//! The derivatives obey the same equations, with an energy `F` of their own:
//!
//! `F_n ≤ F_{n−1} + Γ ‖R_n'‖ + √κ (B |J_n| + (B|ρ| + |C|) |J_{n−1}|)`.
//!
//! Together, `max |Δ_n|² ≤ ‖Δ_n‖² + 2 ‖Δ_n‖ ‖Δ_n'‖ ≤ E² + 2 E F`.
//!
//! # Any reflection: the wave is its own impulse response
//!
//! The computed wave obeys the equation of the true one with a measure `μ` added, which has the density
//! `R_n'` on the periods and the weight `J_n − ρ J_{n−1}` at the joints. With `m = ∫ |dμ|` and the largest
//! sum of absolute coefficients, `M = max_n Σ|c_k|`: `|Δ| ≤ m M/(1 − m)` where `m < 1`.
//!
//! # Norms of R from its coefficients
//!
//! With `b_k = k |R_k|`:
//! - `‖R‖² ≤ (π/4)(2 R_0² + Σ R_k²)`;
//! - `∫|R'| dx ≤ (π/√2) √(Σ b_k²)`;
//! - `‖R'‖² ≤ (2π/sin 1) √(Σ b_k² · Σ k² b_k²)`.
//!
//! # Rounding in the measurement
//!
//! `ε = 2⁻⁵³`. Each coefficient of `R` is bounded by its computed value plus what the evaluation
//! can have lost, a few `ε` times the computed terms, plus what a parameter within its radius can
//! change; the formulas stand at the code. What remains are sums, products and roots of
//! non-negative numbers: fewer than 2³⁰ operations in a chain each add a relative error of at most
//! `ε`, together less than `2⁻²²`, and the result is multiplied by `1 + 2⁻²⁰`. Below the normal
//! doubles an operation loses at most `2⁻¹⁰⁷⁴`: [`UNDERFLOW`] covers a period's, weights included.

use super::compensated::{Ends, ends};
use super::reflection::{Parameter, Reflection};
use crate::double_double::{DoubleDouble, UNIT};
use crate::lanes::{Lanes, WIDTH};
use crate::vector::{Work, widest};

/// More than all relative errors of sums of non-negative numbers.
const SLACK: f64 = 1.0 + 1.0 / (1 << 20) as f64;
/// More than all that a period's measurement loses below the normal doubles.
const UNDERFLOW: f64 = 1e-280;
/// More coefficients than this make sums longer than the proof allows.
const MOST_COEFFICIENTS: usize = 1 << 20;
/// Beyond this many periods the chains of operations are longer than the proof allows.
const LAST_PERIOD: usize = 1 << 28;

/// A proof in progress: how far recorded polynomials can be from the wave of a [`Reflection`].
///
/// It knows nothing of how the polynomials were made. A wrong coefficient is seen on the period
/// where it is recorded, and the bound covers it.
///
/// # Invariants
/// The bounds never decrease from period to period.
pub struct Certificate {
    ratio: Parameter,
    /// `B/4` and `C/4`, middles and radii.
    beta: Parameter,
    gamma: Parameter,
    /// `√κ` and `Γ`, upper bounds; `None` where the lemma does not hold.
    energy_weights: Option<(f64, f64)>,
    /// What was recorded last: the wave with zeros behind it, its length, and the measured ends.
    before: Vec<f64>,
    length: usize,
    last: Option<Joint>,
    /// `ρⁿ` of the next period, and upper bounds of `|ρ|ⁿ` and of `n |ρ|^{n−1}`.
    power: DoubleDouble,
    magnitude: f64,
    slope: f64,
    periods: usize,
    energy: f64,
    slope_energy: f64,
    mass: f64,
    supremum: f64,
    /// `1/k` at place `k − 1`.
    inverses: Vec<f64>,
    /// Scratch: the increment and the wave with zeros behind them, and `|e_k|`.
    increment: Vec<f64>,
    wave: Vec<f64>,
    mismatch: Vec<f64>,
}

/// What a period leaves for the joint with the next one.
struct Joint {
    wave: Ends,
    increment: Ends,
    /// A bound of `|u − G|` at either end.
    smooth: f64,
    /// `|J_n|`.
    jump: f64,
}

/// Sums over the coefficients of a period's residual.
#[derive(Default)]
struct Residual {
    /// `Σ R_k²`, `Σ k² R_k²`, `Σ k⁴ R_k²` over `k ≥ 1`.
    squares: [f64; 3],
    /// `Σ |u_k − G_k|` over `k ≥ 1`.
    smooth: f64,
    /// `|e_0|`.
    constant: f64,
}

/// The next period for a certificate.
struct Record<'a> {
    certificate: &'a mut Certificate,
    increment: &'a [f64],
    wave: &'a [f64],
}

impl Work for Record<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        self.certificate.take::<L>(self.increment, self.wave);
    }
}

impl Certificate {
    /// The certificate before the first period. O(1).
    pub fn new(reflection: &Reflection) -> Certificate {
        let Reflection { rate, zero, ratio } = *reflection;
        // C = ρ (A + B): two roundings, and what radii change.
        let sum = zero.value + rate.value;
        let coupling = ratio.value * sum;
        let spread = zero.radius + rate.radius;
        let moved = ratio.magnitude() * spread + ratio.radius * sum.abs();
        let radius = (moved + 2.01 * UNIT * coupling.abs()) * SLACK + UNDERFLOW;
        Certificate {
            ratio,
            beta: quarter(rate.value, rate.radius),
            gamma: quarter(coupling, radius),
            energy_weights: energy_weights(reflection),
            before: Vec::new(),
            length: 0,
            last: None,
            power: DoubleDouble::ONE,
            magnitude: 1.0,
            slope: 0.0,
            periods: 0,
            energy: 0.0,
            slope_energy: 0.0,
            mass: 0.0,
            supremum: 0.0,
            inverses: Vec::new(),
            increment: Vec::new(),
            wave: Vec::new(),
            mismatch: Vec::new(),
        }
    }

    /// Takes the next period: the Chebyshev coefficients on `[0, 1]` of `y_n − ρ y_{n−1}` and of
    /// `y_n`, as somebody computed them. More than 2²⁰ coefficients, infinities and not-a-numbers
    /// end the proof: from there on there is no bound. O(N).
    pub fn record(&mut self, increment: &[f64], wave: &[f64]) {
        widest(Record { certificate: self, increment, wave });
    }

    /// The same with the instructions of the caller.
    #[inline(always)]
    pub(super) fn take<L: Lanes>(&mut self, increment: &[f64], wave: &[f64]) {
        let residual = self.measure::<L>(increment, wave);
        let here = Joint {
            wave: ends::<L>(wave),
            increment: ends::<L>(increment),
            smooth: residual.smooth,
            jump: 0.0,
        };
        self.join(&residual, here);
        if increment.len().max(wave.len()) > MOST_COEFFICIENTS {
            (self.energy, self.mass) = (f64::INFINITY, f64::INFINITY);
        }
        std::mem::swap(&mut self.before, &mut self.wave);
        self.length = wave.len();
        self.periods += 1;
        self.power = self.power.times(self.ratio.value);
        self.slope = self.slope * self.ratio.magnitude() + self.magnitude;
        self.magnitude *= self.ratio.magnitude();
    }

    /// The coefficients of `R_n`, row by row.
    ///
    /// `e_k = p_k − ρ g_k − u_k`. With `t = fl(fl(ρ g_k) + u_k)`:
    /// `|e_k| ≤ |p_k − t| + ε|t| + ε|ρ g_k| + r_ρ|g_k|`, and the third term is absent where
    /// `ρ = ±1`.
    ///
    /// `k R_k` is evaluated as `(k u_k + β (u_{k−1} − u_{k+1})) + γ (g_{k−1} − g_{k+1})`: 3, 4 and
    /// 3 roundings touch the terms, so at most `4.01 ε` times the sum of the terms' sizes is lost.
    /// The radii of `β` and `γ` add their multiple of the differences, and `e` adds
    /// `k|e_k| + β (|e_{k−1}| + |e_{k+1}|)`. Without `k|e_k|` the same is a bound of
    /// `k |u_k − G_k|`.
    #[inline(always)]
    fn measure<L: Lanes>(&mut self, increment: &[f64], wave: &[f64]) -> Residual {
        let most = increment.len().max(wave.len()).max(self.length).max(1);
        let groups = most.div_ceil(WIDTH);
        // The rows of a group ask for its places and the two behind it.
        let length = WIDTH * (groups + 1);
        let known = self.inverses.len();
        self.inverses.extend((known..length).map(|k| 1.0 / (k + 1) as f64));
        let Certificate { increment: u, before: g, wave: p, mismatch: e, inverses, .. } = self;
        for (padded, given) in [(&mut *u, increment), (&mut *p, wave)] {
            padded.clear();
            padded.extend_from_slice(given);
            padded.resize(length, 0.0);
        }
        g.resize(length, 0.0);
        e.resize(length, 0.0);
        let ratio = self.ratio.value;
        let product = if self.ratio.is_exact_unit() { 0.0 } else { UNIT * ratio.abs() };
        let product = product + self.ratio.radius;
        let (ratio, product, unit) = (L::splat(ratio), L::splat(product), L::splat(UNIT));
        for group in 0..=groups {
            let k = WIDTH * group;
            let old = L::load(&g[k..]);
            let sum = ratio * old + L::load(&u[k..]);
            let missing = (L::load(&p[k..]) - sum).abs() + unit * sum.abs() + product * old.abs();
            e[k..k + WIDTH].copy_from_slice(&missing.to_array());
        }
        let constant = e[0];
        // The constant coefficient counts twice in the row k = 1, and in no other.
        u[0] *= 2.0;
        g[0] *= 2.0;
        e[0] *= 2.0;
        let mut sums = Sums::<L>::new(self.beta, self.gamma);
        for group in 0..groups {
            let k = WIDTH * group;
            sums.add([&u[k..], &g[k..], &e[k..]], L::load(&inverses[k..]));
        }
        Residual { squares: sums.squares(), smooth: sums.smooth.sum(), constant }
    }

    /// Adds a period to the energies and to the mass.
    fn join(&mut self, residual: &Residual, mut here: Joint) {
        let [plain, first, second] = residual.squares.map(|s| s + UNDERFLOW);
        // (π/4)(2R_0² + ΣR_k²), (2π/sin 1) √(…), (π/√2) √(…), constants rounded up.
        let norm = (0.785399 * (2.0 * residual.constant * residual.constant + plain)).sqrt();
        let slope = (7.46701 * (first * second).sqrt()).sqrt();
        let variation = 2.22145 * first.sqrt();
        let (expected, error) = (self.power, self.power_error());
        let (kink, jump, jump_before) = match &self.last {
            None => {
                let one = DoubleDouble::ONE;
                let kink = distance(here.increment, one, 0.0) + here.smooth;
                (kink, distance(here.wave, one, 0.0), 0.0)
            }
            Some(last) => {
                let kink = distance(here.increment, last.increment.right, last.increment.radius);
                let target = last.wave.right + expected;
                // A sum of pairs is off by at most 3.1 ε² of itself.
                let joined = 8.0 * UNIT * UNIT * (last.wave.absolute + self.magnitude);
                let radius = last.wave.radius + joined + error;
                (kink + here.smooth + last.smooth, distance(here.wave, target, radius), last.jump)
            }
        };
        let (rate, ratio) = (4.0 * self.beta.magnitude(), self.ratio.magnitude());
        let coupling = 4.0 * self.gamma.magnitude();
        if let Some((root, gain)) = self.energy_weights {
            self.energy += gain * norm + root * kink;
            let joint = rate * jump + (rate * ratio + coupling) * jump_before;
            self.slope_energy += gain * slope + root * joint;
        }
        self.mass += variation + jump + ratio * jump_before;
        self.supremum = self.supremum.max(here.wave.absolute);
        here.jump = jump;
        self.last = Some(here);
    }

    /// How far `ρⁿ` can be from the two doubles of `power`: `n` roundings of `2 ε²`, and
    /// `|ρⁿ − ρ'ⁿ| ≤ n |ρ|^{n−1} |ρ − ρ'|` with the larger ratio.
    fn power_error(&self) -> f64 {
        let rounding = if self.ratio.is_exact_unit() { 0.0 } else { 2.0 * UNIT * UNIT };
        self.periods as f64 * rounding * self.magnitude + self.slope * self.ratio.radius + UNDERFLOW
    }

    /// A bound of `|p_n(x) − y_n(x)|` for all `x` in `[0, 1]` on the period recorded last, for
    /// every wave whose parameters lie within their radii; `None` where nothing is proven. O(1).
    pub fn bound(&self) -> Option<f64> {
        if self.periods == 0 || self.periods > LAST_PERIOD {
            return None;
        }
        let finite = |bound: f64| bound.is_finite().then_some(bound);
        match (self.energy_bound().and_then(finite), self.mass_bound().and_then(finite)) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }

    /// `√(E² + 2EF)`.
    fn energy_bound(&self) -> Option<f64> {
        self.energy_weights?;
        Some((self.energy * (self.energy + 2.0 * self.slope_energy)).sqrt() * SLACK)
    }

    /// `m M/(1 − m)`. Not a number fails both comparisons.
    fn mass_bound(&self) -> Option<f64> {
        let mass = self.mass * SLACK;
        (mass < 1.0).then(|| mass * self.supremum * SLACK / (1.0 - mass).next_down())
    }
}

/// A quarter of a number with its radius: exact, but for underflow.
fn quarter(value: f64, radius: f64) -> Parameter {
    // A product of finite parameters may have outgrown the doubles: then nothing is ever proven.
    Parameter::within(value / 4.0, radius / 4.0 + UNDERFLOW)
        .or_else(|_| Parameter::within(0.0, f64::MAX))
        .expect("finite numbers")
}

/// Upper bounds of `√κ` and of `Γ = √(1 + κB/2)` for all parameters within the radii, from
/// `κ ≤ 1/s`, `s = ρ²A + B`; `None` where the reflection may not be passive or `s` may not be
/// positive.
fn energy_weights(reflection: &Reflection) -> Option<(f64, f64)> {
    if !reflection.is_passive() {
        return None;
    }
    let Reflection { rate, zero, ratio } = *reflection;
    // The least ρ²A: A at its lowest, ρ² at its largest where that is negative and least otherwise.
    let least = zero.lower();
    let ratio = if least < 0.0 {
        ratio.magnitude()
    } else {
        (ratio.value.abs() - ratio.radius).next_down().max(0.0)
    };
    let product = ratio * ratio * least;
    // Three roundings of the product, one of the sum.
    let lower = (product + rate.lower()) - 4.0 * UNIT * (product.abs() + rate.lower());
    if lower <= 0.0 {
        return None;
    }
    let kappa = SLACK / lower;
    Some((kappa.sqrt() * SLACK, (1.0 + kappa * rate.magnitude() / 2.0).sqrt() * SLACK))
}

/// An upper bound of the distance of a left end from `target`, which is known within `radius`.
fn distance(end: Ends, target: DoubleDouble, radius: f64) -> f64 {
    let rest = end.left - target;
    let joined = 8.0 * UNIT * UNIT * (end.absolute + target.high.abs());
    rest.high.abs() * (1.0 + 2.0 * UNIT) + end.radius + radius + joined
}

/// The sums over rows, eight rows side by side.
struct Sums<L> {
    beta: Parameter,
    gamma: Parameter,
    largest_beta: f64,
    /// The rows that come next.
    rows: L,
    plain: L,
    first: L,
    second: L,
    smooth: L,
}

impl<L: Lanes> Sums<L> {
    #[inline(always)]
    fn new(beta: Parameter, gamma: Parameter) -> Self {
        let (zero, largest_beta) = (L::splat(0.0), beta.magnitude());
        let rows = L::from_array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        let (plain, first, second, smooth) = (zero, zero, zero, zero);
        Sums { beta, gamma, largest_beta, rows, plain, first, second, smooth }
    }

    /// The rows `k + 1 ..= k + 8`, from the coefficients of `u`, `g` and `|e|` from `k` on and the
    /// reciprocals of the rows.
    #[inline(always)]
    fn add(&mut self, [u, g, e]: [&[f64]; 3], inverse: L) {
        let (row, own, mismatch) = (self.rows, L::load(&u[1..]), L::load(&e[1..]));
        let du = L::load(u) - L::load(&u[2..]);
        let dg = L::load(g) - L::load(&g[2..]);
        let beta = L::splat(self.beta.value);
        let (a, b, c) = (row * own, beta * du, L::splat(self.gamma.value) * dg);
        let sizes = a.abs() + b.abs() + c.abs();
        let (beta, gamma) = (L::splat(self.beta.radius), L::splat(self.gamma.radius));
        let radii = beta * du.abs() + gamma * dg.abs();
        let around = L::splat(self.largest_beta) * (L::load(e) + L::load(&e[2..]));
        let lost = L::splat(4.01 * UNIT) * sizes;
        let smooth = ((a + b) + c).abs() + lost + radii + around;
        let whole = smooth + row * mismatch;
        let (plain, second) = (whole * inverse, whole * row);
        self.plain = self.plain + plain * plain;
        self.first = self.first + whole * whole;
        self.second = self.second + second * second;
        self.smooth = self.smooth + smooth * inverse;
        self.rows = row + L::splat(WIDTH as f64);
    }

    /// `Σ R_k²`, `Σ k² R_k²`, `Σ k⁴ R_k²`.
    #[inline(always)]
    fn squares(&self) -> [f64; 3] {
        [self.plain.sum(), self.first.sum(), self.second.sum()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::march::{Bounds, March, MarchOptions};
    use crate::vector::{OneByOne, each_way};
    use num_rational::BigRational;
    use num_traits::{Signed as _, Zero as _};
    use proptest::array::{uniform8, uniform10};
    use proptest::prelude::*;

    const SIZE: f64 = 1e-3;

    fn exact(value: f64) -> BigRational {
        BigRational::from_float(value).expect("a finite number")
    }

    /// The first eight rows of a residual, by the coefficients of `u`, `g` and `|e|`.
    #[derive(Clone)]
    struct Rows {
        parameters: [Parameter; 2],
        coefficients: [[f64; 10]; 3],
    }

    impl Work for Rows {
        type Output = [[f64; WIDTH]; 2];

        fn run<L: Lanes>(self) -> Self::Output {
            let [beta, gamma] = self.parameters;
            let mut sums = Sums::<L>::new(beta, gamma);
            let inverses = std::array::from_fn(|k| 1.0 / (k + 1) as f64);
            let [u, g, e] = &self.coefficients;
            sums.add([u, g, e], L::from_array(inverses));
            [sums.smooth.to_array(), sums.first.to_array()]
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        /// Where the terms of a row cancel, roundings and radii are all that is left: none of them is passed over.
        #[test]
        fn no_row_is_larger_than_its_bound(
            mut u in uniform10(-1.0..1.0_f64), g in uniform10(-1.0..1.0_f64), e in uniform10(0.0..1e-16_f64),
            row in 1_usize..=8, beta in 0.1..4.0_f64, gamma in -4.0..4.0_f64, radii in [0.0..1e-16_f64, 0.0..1e-16_f64],
            with in [any::<bool>(), any::<bool>(), any::<bool>()],
        ) {
            let only = |is_there: bool, value: f64| if is_there { value } else { 0.0 };
            let gamma = only(with[0], gamma);
            let e = e.map(|own| only(with[1], own));
            let radii = radii.map(|own| only(with[2], own));
            let difference = |values: &[f64; 10]| values[row - 1] - values[row + 1];
            u[row] = -(beta * difference(&u) + gamma * difference(&g)) / row as f64;
            let within = |value, radius| Parameter::within(value, radius).expect("a number");
            let parameters = [within(beta, radii[0]), within(gamma, radii[1])];
            let number = exact(row as f64);
            let differs = |values: &[f64; 10]| exact(values[row - 1]) - exact(values[row + 1]);
            let mut largest = BigRational::zero();
            for [one, other] in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
                let beta = exact(beta) + exact(one * radii[0]);
                let gamma = exact(gamma) + exact(other * radii[1]);
                let sum = &number * exact(u[row]) + &beta * differs(&u) + gamma * differs(&g);
                let around = beta * (exact(e[row - 1]) + exact(e[row + 1]));
                largest = largest.max(sum.abs() + around);
            }
            let whole = &largest + &number * exact(e[row]);
            // What is left are sums of numbers that are not negative.
            let slack = exact(SLACK);
            for [smooth, first] in each_way(&Rows { parameters, coefficients: [u, g, e] }) {
                let smooth = exact(smooth[row - 1]) * &number * &slack;
                prop_assert!(smooth >= largest, "{smooth} {largest}");
                prop_assert!(exact(first[row - 1]) * &slack >= &whole * &whole);
            }
        }

        /// `p − ρ g − u`, where `p` is that sum rounded.
        #[test]
        fn no_mismatch_is_larger_than_its_bound(
            u in uniform8(-1.0..1.0_f64), g in uniform8(-1.0..1.0_f64), ratio in -1.0..1.0_f64, radius in 0.0..1e-16_f64,
            has_radius in any::<bool>(),
        ) {
            let radius = if has_radius { radius } else { 0.0 };
            let parameter = Parameter::within(ratio, radius).expect("a number");
            let two = Parameter::within(2.0, 0.0).expect("a number");
            let wave = Reflection::new(two, two, parameter).expect("a reflection");
            let mut certificate = Certificate::new(&wave);
            (certificate.before, certificate.length) = (g.to_vec(), 8);
            let p: [f64; 8] = std::array::from_fn(|k| ratio * g[k] + u[k]);
            certificate.measure::<OneByOne<false>>(&u, &p);
            for k in 0..8 {
                // The constant one counts twice.
                let bound = certificate.mismatch[k] / if k == 0 { 2.0 } else { 1.0 };
                for radius in [radius, -radius] {
                    let ratio = exact(ratio) + exact(radius);
                    let missing = exact(p[k]) - ratio * exact(g[k]) - exact(u[k]);
                    prop_assert!(exact(bound) * exact(SLACK) >= missing.abs(), "{k}");
                }
            }
        }
    }

    /// Six periods of the rigid mass, `B = 2`, and one more whose wave is off by `1e−3 T_k`.
    fn perturbed(place: usize) -> Certificate {
        perturbed_march(place).0
    }

    fn perturbed_march(place: usize) -> (Certificate, March) {
        let wave = Reflection::exact(2.0, 2.0, 1.0).expect("a reflection");
        let options = MarchOptions { bounds: Bounds::None, ..Default::default() };
        let mut march = March::new(&wave, options).expect("a march");
        let mut certificate = Certificate::new(&wave);
        for _ in 0..6 {
            certificate.record(march.increment(), march.coefficients());
            march.advance().expect("room");
        }
        let mut wrong = march.coefficients().to_vec();
        wrong.resize(wrong.len().max(place + 1), 0.0);
        wrong[place] += SIZE;
        certificate.record(march.increment(), &wrong);
        (certificate, march)
    }

    /// Each part of the bound, against the exact norms of `T_k` on `[0, 1]`. The parts are above
    /// them and, where no inequality of the proof is lost on a single coefficient, near them.
    #[test]
    fn every_part_covers_its_norm() {
        for k in [3usize, 10, 41] {
            let found = perturbed(k);
            let degree = k as f64;
            // ∫ T_k² dx = ½ (1 − 1/(4k² − 1)), ∫ T_k'² dx = 4k² Σ_{i<k} 1/(2i + 1), ∫ |T_k'| dx =
            // 2k.
            let norm = (0.5 * (1.0 - 1.0 / (4.0 * degree * degree - 1.0))).sqrt() * SIZE;
            let odd: f64 = (0..k).map(|i| 1.0 / (2.0 * i as f64 + 1.0)).sum();
            let slope = (4.0 * odd).sqrt() * degree * SIZE;
            assert!(found.energy > norm && found.energy < 3.0 * norm, "{k} {}", found.energy);
            assert!(found.slope_energy > slope, "{k} {}", found.slope_energy);
            assert!(found.slope_energy < 2.0 * degree.sqrt() * slope);
            let variation = (2.0 * degree + 1.0) * SIZE;
            assert!(found.mass > variation && found.mass < 1.6 * variation, "{k} {}", found.mass);
        }
    }

    /// A constant `δ` in the wave: `Δ = δ`; the measure has the density `Bδ` and the jump `δ`; the
    /// derivative of the next step begins with `ζ(0) = −Bδ`.
    #[test]
    fn a_constant_counts_at_the_joint() {
        let found = perturbed(0);
        assert!(found.mass > 3.0 * SIZE && found.mass < 4.0 * SIZE);
        // R_0 = δ and R_1 = δ: Γ ‖R‖ is at most Γ √(3π/4) δ, and √κ times the kink adds δ/2.
        assert!(found.energy > 2.0 * SIZE && found.energy < 2.5 * SIZE);
        // Γ ‖R'‖ is at most Γ √(2π/sin 1) δ = 3.06 δ, and the joint adds √κ Bδ = δ.
        assert!(found.slope_energy > 4.0 * SIZE && found.slope_energy < 4.2 * SIZE);
    }

    /// `√(E² + 2EF)`, where the mass tells nothing.
    #[test]
    fn energies_bound_the_error() {
        let mut found = perturbed(3);
        (found.energy, found.slope_energy, found.mass) = (1.0, 10.0, 1.0);
        let (bound, exact) = (found.bound().expect("a bound"), 21f64.sqrt());
        assert!(bound >= exact && bound < exact * 1.001, "{bound}");
    }

    /// What sums of pairs may be off by counts, however near their values are.
    #[test]
    fn a_distance_covers_the_roundings_of_sums() {
        let zero = DoubleDouble::from(0.0);
        let end = Ends { left: zero, right: zero, absolute: 1.0, radius: 0.0 };
        assert!(distance(end, zero, 0.0) >= 8.0 * UNIT * UNIT);
        let one = DoubleDouble::ONE;
        let end = Ends { left: one, right: one, absolute: 1.0, radius: 0.0 };
        assert!(distance(end, one, 0.0) >= 16.0 * UNIT * UNIT);
    }

    /// A constant `δ` that is gone on the next period: there `|R_1|` is `3 δ` at most, and `Γ ‖R'‖` thrice what it was
    /// above; the joint counts `√κ (B |J| + (B|ρ| + |C|) |J_before|) = ½ (2 δ + 6 δ)`.
    #[test]
    fn a_jump_counts_at_both_joints() {
        let (mut found, mut march) = perturbed_march(0);
        let before = found.slope_energy;
        march.advance().expect("room");
        found.record(march.increment(), march.coefficients());
        let grown = found.slope_energy - before;
        assert!(grown > 13.0 * SIZE && grown < 13.3 * SIZE, "{grown}");
    }

    #[test]
    fn weights_are_those_of_the_lemma() {
        // A rigid mass: κ = 1/(2B), Γ = √(1 + 1/4).
        let weights = |rate, zero, ratio| {
            energy_weights(&Reflection::exact(rate, zero, ratio).expect("a reflection"))
        };
        let (root, gain) = weights(2.0, 2.0, 1.0).expect("passive");
        assert!((root - 0.5).abs() < 1e-5 && (gain - 1.25f64.sqrt()).abs() < 1e-5);
        assert!(root >= 0.5 && gain >= 1.25f64.sqrt());
        assert!(weights(2.0, 2.1, 1.0).is_none());
        // The zero on the pole with a ratio of 1: the mass never comes to rest in the energy.
        assert!(weights(2.0, -2.0, 1.0).is_none());
        assert!(weights(2.0, -2.0, 0.99).is_some());
    }

    /// By how much the mass grows when the three parameters (B = A = 2, ρ = 1) get the given radii.
    fn mass_of_radii(radii: [f64; 3], periods: &[(&[f64], &[f64])]) -> f64 {
        let mass = |radii: [f64; 3]| {
            let within = |value, radius| Parameter::within(value, radius).expect("a number");
            let [rate, zero, ratio] = radii;
            let wave = Reflection::new(within(2.0, rate), within(2.0, zero), within(1.0, ratio));
            let mut certificate = Certificate::new(&wave.expect("a reflection"));
            periods.iter().for_each(|(u, p)| certificate.record(u, p));
            certificate.mass
        };
        mass(radii) - mass([0.0; 3])
    }

    /// A wave `T_41` that returns: the radius of each parameter adds what the parameter can change.
    #[test]
    fn every_radius_adds_what_it_can_change() {
        let mut wave = [0.0; 70];
        wave[41] = 1.0;
        // The next period by the equations, so that only radii are left of its residual.
        let mut increment = Vec::new();
        crate::march::relaxation::Relaxation::new(2.0, 4.0).particular(&wave, &mut increment);
        let at = |k: usize| wave.get(k).copied().unwrap_or(0.0);
        let next: Vec<f64> = increment.iter().enumerate().map(|(k, u)| at(k) + u).collect();
        let periods: [(&[f64], &[f64]); 2] = [(&wave, &wave), (&increment, &next)];
        let radius = 1e-3;
        // ∫ |T_41| is about 2/π.
        let mean = 0.63;
        let grown = mass_of_radii([0.0, radius, 0.0], &periods);
        assert!(grown > mean * radius && grown < 2.0 * radius, "zero: {grown}");
        let grown = mass_of_radii([radius, 0.0, 0.0], &periods);
        assert!(grown > mean * radius && grown < 4.0 * radius, "rate: {grown}");
        // The total variation of T_41 is 82, and the wave that returns may have changed by it.
        let grown = mass_of_radii([0.0, 0.0, radius], &periods);
        assert!(grown > 82.0 * radius && grown < 110.0 * radius, "ratio: {grown}");
        // Without a wave the jump ρⁿ alone may change: by 1 and 2 radii at both of its periods'
        // joints.
        let nothing: [(&[f64], &[f64]); 3] = [(&[0.0], &[0.0]); 3];
        let grown = mass_of_radii([0.0, 0.0, radius], &nothing);
        assert!(grown > 4.0 * radius && grown < 7.0 * radius, "jump: {grown}");
    }

    /// What is dropped behind the end of a wave counts: a wave of total variation 82 disappears.
    #[test]
    fn dropped_coefficients_count() {
        let mut wave = [0.0; 42];
        wave[41] = 1.0;
        let mut certificate = Certificate::new(&Reflection::exact(2.0, 2.0, 1.0).expect("exact"));
        certificate.record(&wave, &wave);
        let before = certificate.mass;
        certificate.record(&[0.0], &[0.0]);
        assert!(certificate.mass - before > 82.0);
    }
}
