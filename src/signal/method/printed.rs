//! Any observable by the echoes as they are printed, in doubles.

use super::MethodError;
use crate::ball::Ball;
use crate::expression::{Expression, Field as _, Transform};
use crate::signal::error::EvaluateError;
use crate::signal::signal::{Limit, Signal};

/// The most echoes that are worked out.
const MAX_ECHOES: usize = 300;

/// The precision of coefficients before they are rounded.
const BITS: u64 = 192;

type Complex = (f64, f64);

/// `e^{λx} Σ_j c_j x^j` by poles.
type Function = Vec<(Complex, Vec<Complex>)>;

/// A wave that is seen.
struct Seen {
    weight: f64,
    delay: f64,
    /// Its echoes, each with its delay.
    echoes: Vec<(f64, Function)>,
}

/// The echoes of all that is seen, in powers of time.
pub(super) struct PrintedEchoes {
    seen: Vec<Seen>,
    added: Function,
    unit: f64,
    slowness: f64,
}

impl PrintedEchoes {
    pub(super) fn new(signal: &dyn Signal) -> Result<PrintedEchoes, MethodError> {
        let ([_, to], signal) = (signal.window(), signal.closed_form()?);
        let numbers = &*signal.numbers;
        let field = numbers.field(BITS);
        let number = |value: &Expression| -> Result<Complex, EvaluateError> {
            let ball = field.embed(value)?;
            Ok((ball.real().to_double().0, ball.imaginary().to_double().0))
        };
        let function =
            |transform: &Transform<crate::ball::ComplexBall>| -> Result<Function, EvaluateError> {
                let mut parts = Vec::new();
                for (pole, row) in transform.poles() {
                    let mut factorial = 1.0;
                    let mut powers = Vec::with_capacity(row.len());
                    for (j, coefficient) in row.iter().enumerate() {
                        factorial *= j.max(1) as f64;
                        let part = |part: &Ball| part.to_double().0 / factorial;
                        powers.push((part(coefficient.real()), part(coefficient.imaginary())));
                    }
                    parts.push((number(&pole.clone().into())?, powers));
                }
                Ok(parts)
            };
        let (echoes, arrivals) = signal.echoes(to, MAX_ECHOES, BITS)?;
        let mut seen = Vec::new();
        for wave in &signal.observation.waves {
            let mut row = Vec::new();
            for (k, delay) in &arrivals {
                let echo = &echoes[wave.wave][*k];
                if !echo.is_zero() {
                    let echo = match wave.slope {
                        true => function(&echo.differentiated(&field)?)?,
                        false => function(echo)?,
                    };
                    row.push((number(&delay.clone().into())?.0, echo));
                }
            }
            let weight = number(&wave.coefficient)?.0;
            let delay = number(&wave.delay.clone().into())?.0;
            seen.push(Seen { weight, delay, echoes: row });
        }
        let forcing =
            Transform::of(&signal.observation.forcing, &signal.recurrence.statement().time);
        let added = function(&Transform::<crate::ball::ComplexBall>::embedded(&forcing, &field)?)?;
        let unit = numbers.enclose_root(&signal.unit, BITS)?;
        let slowness = number(&signal.slowness.clone().into())?.0;
        Ok(PrintedEchoes { seen, added, unit: unit.to_double().0, slowness })
    }

    /// The value at a time, delays and products rounded as they come.
    pub(super) fn value(&self, at: f64, side: Limit) -> f64 {
        let time = at * self.slowness;
        let counts = |since: f64| since > 0.0 || (since == 0.0 && side == Limit::Right);
        let mut sum = if counts(time) { evaluate(&self.added, time) } else { 0.0 };
        for Seen { weight, delay, echoes } in &self.seen {
            let arrived = echoes.iter().map(|(since, echo)| (time - delay - since, echo));
            let arrived = arrived.filter(|(since, _)| counts(*since));
            sum += weight * arrived.map(|(since, echo)| evaluate(echo, since)).sum::<f64>();
        }
        sum * self.unit
    }
}

/// The real part of a function at `x`, by Horner's scheme.
fn evaluate(function: &Function, x: f64) -> f64 {
    let mut sum = 0.0;
    for ((re, im), row) in function {
        let horner = |(a, b): Complex, (c, d): &Complex| (a * x + c, b * x + d);
        let (a, b) = row.iter().rev().fold((0.0, 0.0), horner);
        let (sin, cos) = (im * x).sin_cos();
        sum += (re * x).exp() * (a * cos - b * sin);
    }
    sum
}
