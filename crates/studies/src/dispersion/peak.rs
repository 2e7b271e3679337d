//! How fast the peak of a pulse travels at first: the mean of `ω/k` over the spectrum with the weight
//! `U k²`.
//!
//! Near its peak a pulse `Σ U_i cos(ω_i t − k_i x)` has the slope `Σ U_i k_i sin(ω_i t − k_i x)`, and as
//! long as the angles are small, sines are angles: the slope vanishes at `x/t = Σ U_i k_i ω_i/Σ U_i k_i²`.

use num_traits::Zero as _;
use wavestep_polynomial::{Rational, Symbol};

use super::error::{DispersionError, NoGrid, place};
use super::formula::{Formula, wave_number};
use super::pulse::{Pulse, Shape};
use super::quadrature::integrate;
use super::relation::{Quantity, Relation, certified, value};
use crate::ratio;
use wavestep::ball::{Ball, Value};
use wavestep::field::Bounded;

/// How often the range of wavenumbers is halved in looking for negative frequencies.
const NEGATIVE_DEPTH: u32 = 12;
/// The precision of that.
const BOUND_BITS: u64 = 64;
/// The digits of samples in doubles.
const SAMPLE_BITS: u64 = 60;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PeakVelocity {
    /// In closed form, where there is one: a number that may hold π.
    pub exact: Option<Formula>,
    pub value: Value,
    /// The cut-off `k_co`.
    pub cut_off: Value,
}

/// `S_m = ∫_0^π θ^m sin θ dθ`: `S_0 = 2`, `S_1 = π`, `S_m = π^m − m(m − 1) S_{m−2}`.
fn sine_moment(m: u32) -> Formula {
    match m {
        0 => Formula::integer(2),
        1 => Formula::pi(),
        _ => {
            let factor = Formula::integer(-(i64::from(m) * i64::from(m - 1)));
            power(&Formula::pi(), m.into()).add(&factor.multiply(&sine_moment(m - 2)))
        }
    }
}

fn power(base: &Formula, exponent: i64) -> Formula {
    base.power(&Rational::from_integer(exponent.into())).expect("a power of a symbol")
}

/// The velocity of all waves, where it is one: then every sum of them has it too.
fn common_velocity(relation: &Relation) -> Option<Formula> {
    let velocity = relation.formula(Quantity::PhaseVelocity);
    (!velocity.symbols().contains(&wave_number())).then(|| velocity.clone())
}

/// The peak velocity in closed form, with the symbol `b` for the length: for polynomial `ω(k)` and the
/// square pulse; for the triangular one where `ω(0) = 0`. `None` for others, where a power of `k`
/// exceeds 64, and where a parameter is called `b` itself.
///
/// With `θ = kb/2` the integral of a square pulse is `∫ sin θ Σ a_m (2θ/b)^m dθ` but for a factor, hence
///
/// ```text
/// c_pp = Σ_m a_m (2/b)^(m−1) S_m/S_1,   S_m = ∫_0^π θ^m sin θ dθ.
/// ```
///
/// For the triangle `sin²(θ/2) = (1 − cos θ)/2`, and `T_m = ½ ∫_0^π (1 − cos θ) θ^(m−1) dθ = ½(π^m/m +
/// (m − 1) S_(m−2))` stands for `S_m`; `T_1 = π/2`.
pub fn exact_peak_velocity(relation: &Relation, shape: Shape) -> Option<Formula> {
    if let Some(velocity) = common_velocity(relation) {
        return Some(velocity);
    }
    let length = Symbol::new("b").expect("a name");
    if relation.parameters().contains(&length) {
        return None;
    }
    let length = Formula::symbol(&length);
    let coefficients = relation.frequency().polynomial()?;
    let (lowest, highest) = (*coefficients.keys().next()?, *coefficients.keys().next_back()?);
    if highest > 64 {
        return None;
    }
    let half = Formula::number(&ratio(1, 2));
    let moment = |m: u32| match shape {
        Shape::Square => Some(sine_moment(m)),
        Shape::Triangle if lowest > 0 => {
            let first =
                power(&Formula::pi(), m.into()).multiply(&Formula::number(&ratio(1, m.into())));
            let second = match m {
                1 => Formula::zero(),
                _ => Formula::integer(i64::from(m) - 1).multiply(&sine_moment(m - 2)),
            };
            Some(half.multiply(&first.add(&second)))
        }
        _ => None,
    };
    let scale = Formula::integer(2).divide(&length).expect("a symbol");
    let mut sum = Formula::zero();
    for (m, coefficient) in coefficients {
        let part = coefficient.multiply(&power(&scale, i64::from(m) - 1)).multiply(&moment(m)?);
        sum = sum.add(&part);
    }
    sum.divide(&moment(1)?).ok()
}

/// The peak velocity of a pulse, `∫_0^{k_co} U k ω dk/∫_0^{k_co} U k² dk`: in closed form where there is
/// one, else by certified quadrature; rounded correctly to so many digits.
/// Refused are a negative ω below the cut-off (a dip narrower than `2^{−12}` of the range may stay unseen),
/// places where the formula is not real or not smooth, and a second integral that may be zero.
pub fn peak_velocity(
    relation: &Relation,
    pulse: &Pulse,
    digits: usize,
    limit_bits: u64,
) -> Result<PeakVelocity, DispersionError> {
    if let Some(symbol) = relation.parameters().into_iter().next() {
        return Err(DispersionError::MissingValue(symbol));
    }
    refuse_negative(relation, &pulse.cut_off(relation, BOUND_BITS)?)?;
    let exact = match pulse.shape_and_length() {
        Some((shape, length)) => {
            let of_length = [(Symbol::new("b").expect("a name"), length.clone())].into();
            let formula = exact_peak_velocity(relation, shape);
            formula.map(|formula| formula.substitute(&of_length)).transpose()?
        }
        None => common_velocity(relation),
    };
    let proven = |enclosure: &dyn Fn(u64) -> Result<Ball, DispersionError>| {
        certified(digits, limit_bits, enclosure)
    };
    let value = match &exact {
        Some(formula) => match formula.as_number() {
            Some(number) => Value::Exact(number.clone()),
            None => proven(&|bits| value(formula, &Ball::zero(), bits))?,
        },
        None => proven(&|bits| quotient(relation, pulse, bits))?,
    };
    let cut_off = match pulse.exact_cut_off()?.as_ref().and_then(Formula::as_number) {
        Some(number) => Value::Exact(number.clone()),
        None => proven(&|bits| pulse.cut_off(relation, bits))?,
    };
    Ok(PeakVelocity { exact, value, cut_off })
}

/// The peak velocity by certified quadrature alone.
pub fn peak_velocity_by_quadrature(
    relation: &Relation,
    pulse: &Pulse,
    digits: usize,
    limit_bits: u64,
) -> Result<Value, DispersionError> {
    certified(digits, limit_bits, |bits| quotient(relation, pulse, bits))
}

fn quotient(relation: &Relation, pulse: &Pulse, bits: u64) -> Result<Ball, DispersionError> {
    let upper = pulse.cut_off(relation, bits + 16)?;
    let weight = pulse.spectrum(relation).multiply(&Formula::wave_number());
    let above = integrate(&weight.multiply(relation.frequency()), &upper, bits)?;
    let below = integrate(&weight.multiply(&Formula::wave_number()), &upper, bits)?;
    let inverse = below.reciprocal(bits).map_err(|_| DispersionError::NoPeak)?;
    Ok(above.multiply(&inverse, bits))
}

/// The peak velocity against its cut-off, as a double with a bound: the pulse has the length `2π/k_co`.
pub fn peak_velocity_at(
    relation: &Relation,
    shape: Shape,
    cut_off: f64,
) -> Result<Bounded, DispersionError> {
    let exact = num_traits::FromPrimitive::from_f64(cut_off);
    let Some(exact): Option<Rational> = exact else {
        return Err(NoGrid::WaveNumber.into());
    };
    let pulse = Pulse::with_cut_off(shape, &exact)?;
    refuse_negative(relation, &Ball::from_rational(&exact, BOUND_BITS))?;
    let (value, bound) = quotient(relation, &pulse, SAMPLE_BITS)?.to_double();
    Ok(Bounded { value, bound: bound.to_double() })
}

/// One wave of a finite sum.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Component {
    /// `U_i`.
    pub amplitude: Rational,
    /// `k_i`.
    pub wave_number: Rational,
}

/// The peak velocity of a finite sum of waves, `Σ U_i k_i ω_i/Σ U_i k_i²`, enclosed.
pub fn peak_velocity_of_sum(
    relation: &Relation,
    components: &[Component],
    bits: u64,
) -> Result<Ball, DispersionError> {
    let (mut above, mut below) = (Ball::zero(), Rational::zero());
    for Component { amplitude, wave_number: k } in components {
        let omega = value(relation.frequency(), &Ball::from_rational(k, bits), bits)?;
        above = above.add(&omega.multiply_rational(&(amplitude * k), bits), bits);
        below += amplitude * k * k;
    }
    if below.is_zero() {
        return Err(DispersionError::NoPeak);
    }
    Ok(above.multiply_rational(&below.recip(), bits))
}

/// An error where ω is negative on a part of the range, at least `2^{−12}` of it wide, or at its end.
fn refuse_negative(relation: &Relation, upper: &Ball) -> Result<(), DispersionError> {
    let frequency = relation.frequency();
    let negative = |ball: &Ball| ball.sign() == Some(std::cmp::Ordering::Less);
    if negative(&value(frequency, upper, BOUND_BITS)?) {
        return Err(DispersionError::NegativeFrequency(place(upper)));
    }
    let mut cells = vec![(ratio(0, 1), ratio(1, 1), 0)];
    while let Some((low, high, depth)) = cells.pop() {
        let k = upper.multiply(&Ball::between(&low, &high, BOUND_BITS), BOUND_BITS);
        match value(frequency, &k, BOUND_BITS) {
            Ok(ball) if negative(&ball) => {
                return Err(DispersionError::NegativeFrequency(place(&k)));
            }
            Ok(ball) if !ball.contains_zero() => {}
            Err(error @ DispersionError::NotReal(_)) => return Err(error),
            _ if depth < NEGATIVE_DEPTH => {
                let middle = (&low + &high) / ratio(2, 1);
                cells.push((middle.clone(), high, depth + 1));
                cells.push((low, middle, depth + 1));
            }
            _ => {}
        }
    }
    Ok(())
}
