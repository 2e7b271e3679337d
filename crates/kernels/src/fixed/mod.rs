//! A march in fixed-point integers: the solution of a delay equation as polynomials on pieces, with
//! a proven bound of their error, and correctly rounded doubles from it.
//!
//! The equation is `(d/dT + b) Y = ρ q (d/dT − a) Y + δ(T)`, where q delays by the period D: one
//! wave that returns through one real pole. [`March`] solves it period by period, [`Reduction`]
//! finds the place of a time, [`round_to_double`] decides whether an interval has one double only,
//! and [`certified`] does all of it for weighted sums of delayed solutions.
//!
//! # The march
//! On the n-th period, with the place `x ∈ [0, 1]`, `A = aD` and `B = bD`, the equation reads
//! `y_n' + B y_n = ρ (y_{n−1}' − A y_{n−1})` with `y_{−1} = 0`. So `v_n = y_n − ρ y_{n−1}` obeys
//! `v_n' + B v_n = −G y_{n−1}`, `G = ρ(A + B)`; it is continuous across the joints of periods,
//! because the equation differentiates nothing but v, and begins with `v_0(0) = 1`, because of δ. A
//! period is cut into S equal pieces, S a power of two, with half widths `h = 1/(2S)`. On each, y
//! is a polynomial `Σ_{m<M} c_m u^m` in `u ∈ [−1, 1]`, and `dv/du + hB v = −hG y₋` gives one
//! coefficient from the one before.
//!
//! # The bound
//! The coefficients computed are integers in units of `2^−112`, hence exact numbers, and it does
//! not matter how they came about. Let P be the function that they define on the periods 0 to n,
//! zero before the start, and `V = P − ρ q P`.
//!
//! **1. The error is a response.** V is a polynomial on each piece, so in the sense of
//! distributions `(d/dT + b) P − ρ q (d/dT − a) P − δ = r + Σ_j s_j δ(T − T_j)`: the residual r is
//! the left side on the open pieces, `s_j` is the jump of V at the joint `T_j`, and at the start
//! the jump less one. Subtract the equation of Y: `E = P − Y` obeys the equation with this right
//! side instead of δ. Coefficients do not depend on time and both functions are zero before the
//! start, so E is the response `E(T) = ∫ Y(T − t) r(t) dt + Σ_j s_j Y(T − T_j)`. With
//! `F = ∫|r| + Σ|s_j|`, up to the end of period n, `sup|E| ≤ sup|Y|·F`.
//!
//! **2. The solution is bounded by the polynomials.** `sup|Y| ≤ sup|P| + sup|E| ≤ M̃ + sup|Y|·F`,
//! where M̃ is the largest `Σ|c_m|` of a piece, for `|u| ≤ 1`. Y is bounded on finitely many
//! periods, so if `F < 1`, `sup|Y| ≤ M̃/(1 − F)` and **`|P − Y| ≤ M̃F/(1 − F)`**. The equation need
//! not be passive. At a joint both limits are covered: `s_j` at the end of period n acts only after
//! it.
//!
//! **3. Residuals in coefficients.** `w_m = c_m − ρ g_m` are the coefficients of V on a piece, with
//! `g_m` those of the period before, and `∫|r| dT` over the piece is
//! `∫|dV/du + hB V + hG P₋| du ≤ Σ_m 2/(m + 1) |R_m|`, `R_m = (m + 1) w_{m+1} + hB w_m + hG g_m`,
//! because `r dT = (dV/dx + B V + G P₋) dx`, `dx = h du` and `∫|u|^m du = 2/(m + 1)`. Nothing is
//! truncated: `w_M = 0`, and `R_{M−1}` holds what the terms left out would have been.
//!
//! **4. Rounding.** The residual is computed in integers:
//! - A product by hB or hG is off by less than one unit. The multiplier has 128 fraction bits and
//!   is off from the exact parameter by at most `2^−128`; times a number of at most `2^126` units,
//!   that is a quarter of a unit. Rounding the product to an integer costs half a unit. One product
//!   serves both terms if `G = kB` with an integer k: `hB (w_m + k g_m)`.
//! - `ρ g_m` is exact for `ρ = ±1` and off by less than one unit otherwise; let ε be 0 or 1.
//! - So the computed `R_m` is off by at most `(m + 1)ε + hB ε + 2 ≤ (m + 1)ε + ε + 2` units, since
//!   `hB ≤ 1/2`. That is added to `|R_m|`.
//! - A jump `s_j` is a difference of two sums of at most M numbers `w_m`, off by at most `2Mε`
//!   units.
//! - Sums of units are integers; divisions are rounded upwards.
//!
//! **5. Range.** Before a piece is used, `Σ|c_m| ≤ 64 = 2^118` units is checked. Then
//! `|w_m| ≤ 2^119`, with `M ≤ 64` terms `(m + 1)|w_{m+1}| ≤ 2^125`, and with `|k| ≤ 4` the operand
//! of a product is below `2^121`: nothing wraps around. Sums of sizes saturate. If F exceeds
//! `2^−12` the march is refused, which leaves the bound below `2^(23 + 100)` in its units and makes
//! `1/(1 − F) ≤ 1 + 2^−11`.
//!
//! For a rigid mass the largest error seen is a thirtieth of the bound: roundings of both signs
//! cancel, and M̃ exceeds `sup|Y|` several times.
//!
//! # Sizes
//! For the rigid mass, `ρ = 1`, `a = b = 1`, `D = 2μ`, with `μ = 1` and 200 periods: 16 pieces a
//! period of 37 terms, a bound of `6e−28`.

mod certificate;
mod certified;
mod equation;
mod error;
mod interpolation;
mod march;
mod multiplier;
mod part;
mod position;
mod product;
#[cfg(test)]
mod samples;
mod scheme;
mod spans;
mod step;
mod value;
mod walk;

pub use certified::{CertifiedDoubles, Tap, certified};
pub use equation::DelayEquation;
pub use error::FixedError;
pub use march::March;
pub use position::{ExactTime, Position, Reduction};
pub use scheme::MarchOptions;
pub use spans::{Interpolant, Spans};
pub use value::{FRACTION_BITS, FixedValue, round_to_double};
