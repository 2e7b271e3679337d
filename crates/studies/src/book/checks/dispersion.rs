//! Dispersive waves: two waves, a narrow band, and the peak of a pulse.

use super::{Checked, identity, read};
use crate::book::entry::Equation;
use crate::book::refusal::Refusal;
use crate::book::verdict::{Finding, Ground, Verdict, Witness};
use crate::dispersion::{self, Builtin, Component, Pulse, Shape};
use crate::ratio;
use wavestep::ball::Ball;
use wavestep::export::{Formula, Head};
use wavestep_polynomial::Symbol;

const BITS: u64 = 128;

/// Digits to which two values are compared.
const DIGITS: usize = 30;

/// 6.91a: which factor stands in front of the product.
///
/// `U cos(ω₁t − k₁x) + U cos(ω₂t − k₂x) = 2U cos(ω̄t − k̄x) cos(Δω t/2 − Δk x/2)`, `ω̄ = (ω₁ + ω₂)/2`,
/// `Δω = ω₁ − ω₂`, likewise `k`: cosines are sums of exponentials, which are linearly independent for
/// different exponents, so that equal functions have one normal form.
pub(super) fn two_waves() -> Result<Checked, Refusal> {
    let sum = "U*cos(omega_1*t - k_1*x) + U*cos(omega_2*t - k_2*x)";
    let mean = "(omega_1 + omega_2)/2*t - (k_1 + k_2)/2*x";
    let half = "(omega_1 - omega_2)/2*t - (k_1 - k_2)/2*x";
    identity(sum, &format!("2*U*cos({mean})*cos({half})"))?;
    let sum = read(sum)?;
    let product = "cos(omega_bar*t - k_bar*x)*cos(Delta_omega*t/2 - Delta_k*x/2)";
    let supported = Equation::read(&format!("u = 2*U*{product}"))?;
    let other = Equation::read(&format!("u = U*{product}"))?;
    // At t = x = 0 both waves have a crest: 2U, and the product without the factor is U.
    let value = |number: i64| Ball::from_rational(&ratio(number, 1), BITS);
    let at = ["U", "t", "x"].into_iter().zip([1, 0, 0]);
    let at = at.map(|(name, value)| (name.to_owned(), ratio(value, 1))).collect();
    let witness = Witness { period: None, at, left: value(2), right: value(1) };
    let time = Symbol::new("t").expect("a name");
    let head = Head::new("u", "u");
    let derived = vec![Formula::new(head, &sum, &time)];
    let steps = vec![
        format!(
            "supported: {supported} ({}: cosines as sums of exponentials, {} of them on each side)",
            Ground::SameExpression,
            sum.terms().len()
        ),
        format!("excluded: {other} ({witness})"),
    ];
    let readings = vec![
        (supported, Finding::Holds(Ground::SameExpression)),
        (other, Finding::Fails(Box::new(witness))),
    ];
    Ok(Checked { verdict: Verdict::Unsure(readings), derived, steps })
}

/// 6.95: the phase of one wave of a narrow band.
pub(super) fn narrow_band() -> Result<Checked, Refusal> {
    let phase = identity(
        "(c_g*(k_i - k_0) + omega_0)*t - k_i*x",
        "(omega_0 - c_g*k_0)*t + k_i*(c_g*t - x)",
    )?;
    Ok(Checked::proved(vec![format!("The phase omega_i t - k_i x with omega_i by 6.94: {phase}")]))
}

/// 6.96: the phase that all waves of the band have where `x = c_g t`.
pub(super) fn beat() -> Result<Checked, Refusal> {
    let common = identity("(omega_0 - c_g*k_0)*t + k_i*(c_g*t - c_g*t)", "(omega_0 - c_g*k_0)*t")?;
    let rate = identity("(omega_0/k_0 - c_g)*omega_0*k_0/omega_0", "omega_0 - c_g*k_0")?;
    Ok(Checked::proved(vec![
        format!("The phase of 6.95 at x = c_g t is the same for all waves: {common}"),
        format!("(c_p - c_g) omega_0/c_p with c_p = omega_0/k_0: {rate}"),
    ]))
}

/// 6.98: the slope of a pulse.
pub(super) fn slope_of_pulse() -> Result<Checked, Refusal> {
    let x = Symbol::new("x").expect("a name");
    if read("cos(omega*t - k*x)")?.derivative(&x) != read("k*sin(omega*t - k*x)")? {
        return Err(Refusal::Differs("the derivative".to_owned(), "a sine".to_owned()));
    }
    Ok(Checked::proved(vec![
        "The derivative of cos(omega t - k x) by x is k sin(omega t - k x): the same sum of exponentials. \
         The sum over all waves follows term by term."
            .to_owned(),
    ]))
}

/// 6.99: near the peak the sines are their arguments, and the sum of those vanishes at `x = c_pp t`.
pub(super) fn peak_of_sum() -> Result<Checked, Refusal> {
    // For three waves, the denominator multiplied out; the sum has one term more for each further one.
    let above = "(U_1*k_1*omega_1 + U_2*k_2*omega_2 + U_3*k_3*omega_3)";
    let below = "(U_1*k_1^2 + U_2*k_2^2 + U_3*k_3^2)";
    let term = |i: u32| format!("U_{i}*k_{i}*(omega_{i}*{below} - k_{i}*{above})");
    let zero = identity(&format!("{} + {} + {}", term(1), term(2), term(3)), "0")?;
    // As many equal parts of a spectrum come near the quotient of integrals.
    let relation = Builtin::Cubic.relation();
    let components: Vec<Component> = (1..=40)
        .map(|i| Component { amplitude: ratio(1, 1), wave_number: ratio(i, 100) })
        .collect();
    let sum = dispersion::peak_velocity_of_sum(&relation, &components, BITS);
    let sum = sum?;
    Ok(Checked::proved(vec![
        format!(
            "Where phases are small sin(phi) is phi; with x = c_pp t the sum of 6.98 is zero: {zero}"
        ),
        format!(
            "Forty equal waves on omega = k - k^3/12, k = 1/100 to 2/5: c_pp = {}.",
            sum.to_decimal(12).midpoint()
        ),
    ]))
}

/// 6.100: closed forms against quadrature.
pub(super) fn peak_of_spectrum() -> Result<Checked, Refusal> {
    let relation = Builtin::Cubic.relation();
    let mut steps = Vec::new();
    for shape in [Shape::Square, Shape::Triangle] {
        for length in [4, 10, 40] {
            let pulse = Pulse::in_space(shape, &ratio(length, 1))?;
            let exact = dispersion::peak_velocity(&relation, &pulse, DIGITS, 1 << 12)?;
            let integrated =
                dispersion::peak_velocity_by_quadrature(&relation, &pulse, DIGITS, 1 << 12);
            let same = exact.exact.is_some() && exact.value.to_string() == integrated?.to_string();
            if !same || exact.value.to_string().is_empty() {
                let closed =
                    format!("the closed form of a {} pulse of length {length}", shape.name());
                return Err(Refusal::Differs(closed, "quadrature".to_owned()));
            }
            steps.push(format!(
                "{} pulse of length {length} on omega = k - k^3/12: {} by closed form and by quadrature",
                shape.name(),
                exact.value
            ));
        }
    }
    let count = steps.len();
    steps.push(
        "It is 6.99 with an integral in the place of the sum; pulses are given in space, cut off at \
         k_co = 2 pi/b."
            .to_owned(),
    );
    let told =
        format!("closed form and certified quadrature agree to {DIGITS} digits for {count} pulses");
    Ok(Checked { verdict: Verdict::Checked(told), derived: Vec::new(), steps })
}
