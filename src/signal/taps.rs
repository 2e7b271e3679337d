//! Observables as weighted, delayed copies of one impulse response.
//!
//! With one pole and one lag, waves answer an impulse by
//!
//! ```text
//! Y(T) = Σ_{k: kD ≤ T} ρ^k e^{−b x} L_k((a + b) x),   x = T − kD
//! ```
//!
//! the solution of `(d/dT + b) Y(T) = ρ (d/dT − a) Y(T − D) + δ(T)`. A term `c_i L_{k−i}` of a wave's
//! echoes is `c_i ρ^i Y(T − iD)`, so that all waves and observables are sums of *taps* `w Y(T − d)`, up
//! to finitely many exponential polynomials. Methods for doubles need to know how to compute `Y` alone;
//! where there are no taps, [`Marched`](crate::signal::Marched) takes the steps of all waves.

use crate::expression::{Expression, Fraction};
use crate::recurrence::ObservedWave;
use crate::signal::closed::ClosedForm;
use crate::solution::{EchoTemplate, Family, GeneralForm, Solution};
use wavestep_polynomial::Rational;

/// `weight · Y(T − delay)`, from a time on.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Tap {
    /// The weight.
    pub weight: Fraction,
    /// The delay; before `since` where Y is seen ahead of its time.
    pub delay: Fraction,
    /// Since when it is seen.
    pub since: Fraction,
}

/// A function that is added from a time on: `function(T − origin)`, in the local time.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Extra {
    /// The exponential polynomial.
    pub function: Expression,
    /// Since when.
    pub origin: Fraction,
}

/// An observable in the scale of its waves, by taps.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Taps {
    /// The rate `b`.
    pub rate: Fraction,
    /// The zero `a`.
    pub zero: Fraction,
    /// The ratio `ρ`.
    pub ratio: Fraction,
    /// The period `D`.
    pub period: Fraction,
    /// The taps, by ascending delay where these are numbers; none has the weight 0.
    pub taps: Vec<Tap>,
    /// What is added.
    pub extras: Vec<Extra>,
}

/// Why an observable is no sum of taps.
#[expect(missing_docs, reason = "the messages say it")]
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NoTaps {
    #[error("echoes do not arrive on a common grid")]
    NoGrid,
    #[error("the echoes of {0} have no closed form with one pole and one lag")]
    NoForm(String),
    #[error("{0} is constant in each period")]
    Sequence(String),
    #[error("the echoes of {0} are powers of time, not Laguerre polynomials")]
    Powers(String),
    #[error("the observed waves have different poles")]
    TwoPoles,
    #[error("the slope of {0} is observed")]
    Slope(String),
    #[error("the forcing has no values at single times")]
    Forcing,
}

impl Taps {
    /// The taps of a signal.
    pub fn of(signal: &ClosedForm) -> Result<Taps, NoTaps> {
        if !signal.is_on_grid() {
            return Err(NoTaps::NoGrid);
        }
        let solution = Solution::new(signal.recurrence.clone());
        let recurrence = solution.recurrence();
        let statement = recurrence.statement();
        let observation = &signal.observation;
        let mut sum: Option<Taps> = None;
        for seen in &observation.waves {
            let name = || recurrence.wave_name(seen.wave);
            let template = closed_form(&solution, seen)?;
            let Family::Laguerre(scale) = &template.family else {
                return Err(NoTaps::Powers(name()));
            };
            let zero = scale - &template.rate;
            let empty = || Taps {
                rate: template.rate.clone(),
                zero: zero.clone(),
                ratio: template.ratio.clone(),
                period: statement.period.clone(),
                taps: Vec::new(),
                extras: Vec::new(),
            };
            let taps = sum.get_or_insert_with(empty);
            if (&taps.rate, &taps.zero, &taps.ratio) != (&template.rate, &zero, &template.ratio) {
                return Err(NoTaps::TwoPoles);
            }
            let weight = seen.coefficient.as_fraction().ok_or(NoTaps::Forcing)?;
            taps.add(template, &weight, &seen.delay, &statement.local)
                .ok_or_else(|| NoTaps::NoForm(name()))?;
        }
        let mut taps = sum.ok_or(NoTaps::Forcing)?;
        if !observation.forcing.is_zero() {
            let local = Fraction::symbol(&statement.local);
            let function = observation.forcing.substitute(&statement.time, &local);
            let function = function.map_err(|_| NoTaps::Forcing)?;
            taps.extras.push(Extra { function, origin: Fraction::zero() });
        }
        taps.taps.retain(|tap| !tap.weight.is_zero());
        taps.extras.retain(|extra| !extra.function.is_zero());
        taps.taps.sort_by_key(|tap| tap.delay.as_constant());
        Ok(taps)
    }

    /// Whether all constants are rational numbers.
    pub(crate) fn is_rational(&self) -> bool {
        let constants = [&self.rate, &self.zero, &self.ratio, &self.period];
        let taps = self.taps.iter().flat_map(|tap| [&tap.weight, &tap.delay]);
        constants.into_iter().chain(taps).all(|value| value.as_constant().is_some())
    }

    /// Adds `weight · W(T − delay)` for a wave with these echoes.
    fn add(
        &mut self,
        template: &EchoTemplate,
        weight: &Fraction,
        delay: &Fraction,
        local: &wavestep_polynomial::Symbol,
    ) -> Option<()> {
        let periods = |count: isize| self.period.scale(&Rational::from_integer(count.into()));
        let mut taps = Vec::new();
        let mut extras = Vec::new();
        let decay = |since: &Fraction| Expression::one().times_exponential(&-&(&self.rate * since));
        for (lag, coefficient) in &template.terms {
            let coefficient = coefficient * weight;
            match usize::try_from(*lag) {
                Ok(power) => {
                    let weight = &coefficient * &self.ratio.pow(u32::try_from(power).ok()?);
                    let delay = delay + &periods(*lag);
                    taps.push(Tap { weight, since: delay.clone(), delay });
                }
                Err(_) => {
                    // Σ_k ρ^k T_{k+1}: Y one period ahead, without its first echo.
                    let inverse = self.ratio.as_constant().map(|ratio| ratio.recip())?;
                    let weight = coefficient.scale(&inverse);
                    let ahead = &Fraction::symbol(local) + &self.period;
                    let function = decay(&ahead).times(&-&weight);
                    extras.push(Extra { function, origin: delay.clone() });
                    taps.push(Tap { weight, delay: delay + &periods(-1), since: delay.clone() });
                }
            }
        }
        // What the first echoes are more than the sum would have them.
        for (k, first) in template.first.iter().enumerate() {
            let mut formula = Fraction::zero();
            for (lag, coefficient) in &template.terms {
                if let Some(order) = k.checked_add_signed(-lag) {
                    formula = &formula + &(coefficient * &template.family.function(order, local));
                }
            }
            let formula = &formula * &self.ratio.pow(u32::try_from(k).ok()?);
            let formula = Expression::from(formula)
                .times_exponential(&-&(&self.rate * &Fraction::symbol(local)));
            let function = (first - &formula).times(weight);
            let origin = delay + &periods(isize::try_from(k).ok()?);
            extras.push(Extra { function, origin });
        }
        for tap in taps {
            let same = |known: &&mut Tap| (&known.delay, &known.since) == (&tap.delay, &tap.since);
            match self.taps.iter_mut().find(same) {
                Some(known) => known.weight = &known.weight + &tap.weight,
                None => self.taps.push(tap),
            }
        }
        self.extras.extend(extras);
        Some(())
    }
}

/// The closed form of the echoes of what is seen.
pub(crate) fn closed_form<'a>(
    solution: &'a Solution,
    seen: &ObservedWave,
) -> Result<&'a EchoTemplate, NoTaps> {
    let name = || solution.recurrence().wave_name(seen.wave);
    if seen.slope {
        return Err(NoTaps::Slope(name()));
    }
    match solution.general(seen.wave) {
        Ok(GeneralForm::Echoes(template)) => Ok(template),
        Ok(GeneralForm::Geometric(_)) => Err(NoTaps::Sequence(name())),
        Err(_) => Err(NoTaps::NoForm(name())),
    }
}
