//! Local contact: the law of Hertz, the time of its rise, and the constant of two equal bars.

use super::{Checked, identity, read};
use crate::book::entry::Equation;
use crate::book::refusal::Refusal;
use crate::book::verdict::{Verdict, Witness};
use crate::hertz::{PowerLaw, equal_bars_constant};
use crate::ratio;
use wavestep::ball::Ball;
use wavestep::export::{Formula, Head};
use wavestep_polynomial::{Rational, Symbol};

const BITS: u64 = 128;

/// 6.49: the stiffness is 4/3 of the effective modulus times the root of the effective radius.
pub(super) fn stiffness() -> Result<Checked, Refusal> {
    // With β = (1 − ν²)/(πE), and E₁, E₂ taken out of the denominators.
    let sum = identity(
        "3*pi*((1 - nu_1^2)*E_2 + (1 - nu_2^2)*E_1)/(pi*E_1*E_2)",
        "3*((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2)",
    )?;
    let steps = vec![
        "The law X = k alpha^(3/2) itself is taken from the theory of elasticity, not derived here."
            .to_owned(),
        format!(
            "3 pi (beta_1 + beta_2) is free of pi: {sum}. So k = 4/3 E sqrt(R) with \
             1/E = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2 and 1/R = 1/R_1 + 1/R_2."
        ),
    ];
    Ok(Checked { verdict: Verdict::Definition, derived: Vec::new(), steps })
}

/// 6.50: `dt = dα/α̇` by p.
///
/// With `V = a³`, `h = b³` the powers of 6.50 are whole: `α = (a/b)² p²`, `α̇ = V − h α^{3/2} = a³ (1 − p³)`.
pub(super) fn integral() -> Result<Checked, Refusal> {
    let rate = identity("a^3 - b^3*(a/b)^3*p^3", "a^3*(1 - p^3)")?;
    let substituted = identity("2*(a/b)^2*p", "a^3*(2*p/(b^2*a))")?;
    let steps = vec![
        "With V = a^3, h = b^3, alpha = (a/b)^2 p^2 and alpha^(3/2) = (a/b)^3 p^3:".to_owned(),
        format!("alpha' = V - h alpha^(3/2): {rate}"),
        format!(
            "(1 - p^3) dt/dp = (dalpha/dp)/a^3, and 2 h^(-2/3) V^(-1/3) p = 2 p/(b^2 a): {substituted}"
        ),
    ];
    Ok(Checked::proved(steps))
}

/// 6.51: its derivative is the integrand of 6.50, and it is zero at p = 0.
///
/// Term by term, with `n = p² + p + 1` and `(1 − p) n = 1 − p³`: `½ (2p + 1)/n + 1/(1 − p) −
/// √3 · (2/√3)/(1 + (2p + 1)²/3)`, whose last term is `(3/2)/n`.
pub(super) fn time() -> Result<Checked, Refusal> {
    let denominator = identity("3 + (2*p + 1)^2", "4*(p^2 + p + 1)")?;
    let whole = identity("(1 - p)*(p^2 + p + 1)", "1 - p^3")?;
    let derivative = identity("((2*p + 1)/2 - 3/2)*(1 - p) + (p^2 + p + 1)", "3/2*(2*p)")?;
    // Values of the other derivation, by series.
    let law = PowerLaw::hertz();
    for share in [ratio(1, 10), ratio(1, 2), ratio(9, 10), ratio(999, 1000)] {
        let closed = law.time(&share, BITS)?;
        let deficit = ratio(1, 1) - &share;
        let [force, deficit] =
            [&share, &deficit].map(|value| Ball::from_rational(value, BITS + 32));
        let series = law.time_by_series(&force, &deficit, BITS)?;
        if !closed.subtract(&series, BITS).contains(&Rational::default()) {
            return Err(Refusal::Differs(
                format!("6.51 at {share}, {closed},"),
                format!("the series, {series}"),
            ));
        }
    }
    let steps = vec![
        format!("The derivative of the arctangent has the denominator {denominator}."),
        format!("Common denominator of the three derivatives: {whole}."),
        format!("Their sum times it is 3/2 of the integrand 2 p of 6.50: {derivative}."),
        "At p = 0 the logarithm is 0 and arctan(1/sqrt(3)) = pi/6.".to_owned(),
        "Enclosures agree with those of the series for any exponent at four shares of the force."
            .to_owned(),
    ];
    Ok(Checked::proved(steps))
}

/// 6.54: the formula follows, the number that is read for ν = 0.3 does not.
pub(super) fn constant() -> Result<Checked, Refusal> {
    let nu = ratio(3, 10);
    let constant = equal_bars_constant(&nu, BITS)?;
    let read_value = ratio(478, 1000);
    // k = (4/3) E/(2(1 − ν²)) √(R/2), h = 2k/Z, Z = π r² E/c: h/c = constant^{3/2} √R/r².
    let square = identity("(4/3/2*2)^2/(2*pi^2)", "(2/(3*pi))^2*2")?;
    let witness = Witness {
        period: None,
        at: vec![("nu".to_owned(), nu)],
        left: constant.clone(),
        right: Ball::from_rational(&read_value, BITS),
    };
    if !witness.is_certain() {
        return Err(Refusal::Agrees("the constant".to_owned(), "what is read".to_owned()));
    }
    let head = Head::new("constant^3", "\\mathrm{constant}^{3}");
    let pi = Symbol::new("pi").expect("a name");
    let derived = Formula::new(head, &read("80000/(74529*pi^2)")?, &pi);
    let steps = vec![
        format!(
            "From 6.47, 6.49 and 6.53 with two equal bars: (h (1 - nu^2) r^2/c)^2/R is 8/(9 pi^2): {square}; \
             the formula for the constant holds."
        ),
        format!(
            "For nu = 3/10 it is {}; the source says that it evaluates to 0.478.",
            constant.to_decimal(18).midpoint()
        ),
    ];
    let equation = Equation::read("constant = 478/1000")?;
    let verdict = Verdict::Refuted(Box::new((equation, witness)));
    Ok(Checked { verdict, derived: vec![derived], steps })
}
