//! Energies: squares of what is observed, and their integrals over the waves that are on their way.
//!
//! Between two arrivals a wave is one exponential polynomial; its square is integrated term by term,
//!
//! ```text
//! ∫_0^h e^{νy} y^n/n! dy = (h^n/n! e^{νh} − ∫_0^h e^{νy} y^{n−1}/(n−1)! dy) / ν,     ν ≠ 0
//! ```

use crate::ball::{Ball, ComplexBall};
use crate::enclosure::{Numbers, real_part};
use crate::evaluate::closed::scene::{Arrived, SceneEchoes};
use crate::evaluate::error::EvaluateError;
use crate::evaluate::signal::Limit;
use crate::evaluate::transforms::in_divided_powers;
use crate::expression::{Expression, Field as _, Fraction, Transform};
use crate::network::{EnergyTerm, Window};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use wavestep_polynomial::{Rational, binomial};

/// One part of an energy, ready to be enclosed.
pub(crate) enum Part {
    /// `c q²` now.
    Now(Fraction, Vec<Arrived>, Expression),
    /// `c q² h`, with a constant `q`.
    Before(Fraction, Fraction, Fraction),
    /// `c ∫_0^h q²` from a moment between two arrivals, with what has arrived by then, and how long
    /// before.
    Between(Fraction, Vec<Arrived>, Expression, Fraction),
}

/// The most echoes that are shifted from arrival to arrival for one energy.
const MAX_SHIFTED_ECHOES: usize = 50_000;

impl Part {
    /// How many echoes are looked at.
    fn echoes(&self) -> usize {
        match self {
            Part::Now(_, arrived, _) | Part::Between(_, arrived, ..) => arrived.len(),
            Part::Before(..) => 0,
        }
    }
}

/// Coefficients by pole: `Σ_λ e^{λy} Σ_j c_j y^j/j!`.
type Rows = BTreeMap<Fraction, Vec<ComplexBall>>;

impl SceneEchoes<'_> {
    /// The parts of a sum of energies at a time.
    pub(crate) fn energy_parts(
        &self,
        numbers: &Numbers,
        terms: &[EnergyTerm],
        at: &Fraction,
        side: Limit,
    ) -> Result<Vec<Part>, EvaluateError> {
        let mut parts = Vec::new();
        for term in terms {
            let coefficient = || term.coefficient.clone();
            self.want_until_last(numbers, &term.of)?;
            let start = match &term.window {
                Window::Now => {
                    let arrived = self.arrived(numbers, &term.of, at, side)?;
                    let forced = self.forcing(numbers, &term.of, at, side)?;
                    if !(arrived.is_empty() && forced.is_zero()) {
                        parts.push(Part::Now(coefficient(), arrived, forced));
                    }
                    continue;
                }
                Window::Last(travel) => at - travel,
                Window::Always => Fraction::zero(),
            };
            let early = numbers.compare(&start, &Fraction::zero())? == Ordering::Less;
            if early && !term.before.is_zero() {
                parts.push(Part::Before(coefficient(), term.before.clone(), -&start));
            }
            let start = if early { Fraction::zero() } else { start };
            if numbers.compare(&start, at)? == Ordering::Equal {
                // At the start itself nothing has entered.
                continue;
            }
            let arrived = self.arrived(numbers, &term.of, at, Limit::Left)?;
            let arrived = self.audible(numbers, arrived)?;
            // The moments at which something arrives after the start, in order.
            let mut moments = vec![start];
            for echo in &arrived {
                let moment = at - &echo.since;
                // What was there at the start, or comes with another, is no moment of its own.
                if let Err(place @ 1..) = numbers.search(&moments, &moment)? {
                    moments.insert(place, moment);
                }
            }
            moments.push(at.clone());
            for pair in moments.windows(2) {
                let (from, to) = (&pair[0], &pair[1]);
                let by_then = self.arrived(numbers, &term.of, from, Limit::Right)?;
                let by_then = self.audible(numbers, by_then)?;
                let forced = term.of.forcing.clone();
                if !(by_then.is_empty() && forced.is_zero()) {
                    parts.push(Part::Between(coefficient(), by_then, forced, to - from));
                }
            }
        }
        let echoes: usize = parts.iter().map(Part::echoes).sum();
        match echoes <= MAX_SHIFTED_ECHOES {
            true => Ok(parts),
            false => Err(EvaluateError::TooManyEchoes {
                echoes: echoes as u128,
                limit: MAX_SHIFTED_ECHOES,
            }),
        }
    }

    /// An enclosure of the sum of the parts.
    pub(crate) fn enclose_energy(
        &self,
        numbers: &Numbers,
        parts: &[Part],
        bits: u64,
    ) -> Result<Ball, EvaluateError> {
        let mut sum = Ball::zero();
        for part in parts {
            let (coefficient, value) = match part {
                Part::Now(coefficient, arrived, forced) => {
                    let q = self.enclose(numbers, arrived, forced, bits)?;
                    (coefficient, q.multiply(&q, bits))
                }
                Part::Before(coefficient, before, length) => {
                    let q = numbers.enclose(before, bits)?;
                    let square = q.multiply(&q, bits);
                    (coefficient, square.multiply(&numbers.enclose(length, bits)?, bits))
                }
                Part::Between(coefficient, arrived, forced, length) => {
                    let rows = self.rows(numbers, arrived, forced, bits)?;
                    let length = numbers.field(bits).embed(&length.clone().into())?;
                    (coefficient, integral_of_square(&rows, &length, numbers, bits)?)
                }
            };
            let coefficient = numbers.enclose(coefficient, bits)?;
            sum = sum.add(&value.multiply(&coefficient, bits), bits);
        }
        Ok(sum)
    }

    /// The sum of the parts as an exact expression; `None` where one cannot be given.
    pub(crate) fn exact_energy(&self, parts: &[Part]) -> Option<Expression> {
        let statement = self.recurrence().statement();
        let local = &statement.local;
        let mut sum = Expression::zero();
        for part in parts {
            let (coefficient, value) = match part {
                Part::Now(coefficient, arrived, forced) => {
                    (coefficient, self.exact(arrived, forced)?.pow(2))
                }
                Part::Before(coefficient, before, length) => {
                    (coefficient, Expression::from(&before.pow(2) * length))
                }
                Part::Between(coefficient, arrived, forced, length) => {
                    let q = self.exact_later(arrived, forced, &Fraction::symbol(local))?;
                    let integral = q.pow(2).antiderivative(local, &statement.assumptions).ok()?;
                    (coefficient, integral.substitute(local, length).ok()?)
                }
            };
            sum.add_scaled(&value, &coefficient.clone().into());
        }
        Some(sum)
    }

    /// The sum of what has arrived, as a function of the time from now on.
    fn rows(
        &self,
        numbers: &Numbers,
        arrived: &[Arrived],
        forced: &Expression,
        bits: u64,
    ) -> Result<Rows, EvaluateError> {
        let field = numbers.field(bits);
        let echoes = self.solved(numbers, bits)?;
        let mut rows = Rows::new();
        if !forced.is_zero() {
            // Constants only: what moves or is compressed uniformly at the start.
            rows.insert(Fraction::zero(), vec![field.embed(forced)?]);
        }
        for Arrived { wave, number, coefficient, since } in arrived {
            let echo = &echoes[*wave][*number];
            let coefficient = field.embed(coefficient)?;
            let shift = field.embed(&since.clone().into())?;
            for (pole, row) in shifted(echo, &shift, numbers, bits)? {
                let own = rows.entry(pole).or_default();
                if own.len() < row.len() {
                    own.resize(row.len(), ComplexBall::zero());
                }
                for (sum, value) in own.iter_mut().zip(&row) {
                    *sum = sum.add(&value.multiply(&coefficient, bits), bits);
                }
            }
        }
        Ok(rows)
    }
}

/// The rows of `φ(y + h)`: `c_i ← e^{λh} Σ_j c_{i+j} h^j/j!`.
fn shifted(
    echo: &Transform<ComplexBall>,
    h: &ComplexBall,
    numbers: &Numbers,
    bits: u64,
) -> Result<Rows, EvaluateError> {
    let mut rows = Rows::new();
    for (pole, coefficients) in echo.poles() {
        let rate = numbers.field(bits).embed(&pole.clone().into())?;
        let factor = rate.multiply(h, bits).exp(bits).map_err(EvaluateError::Ball)?;
        let row = (0..coefficients.len()).map(|i| {
            let value = in_divided_powers(&coefficients[i..], h, bits);
            value.multiply(&factor, bits)
        });
        rows.insert(pole.clone(), row.collect());
    }
    Ok(rows)
}

fn integral_of_square(
    rows: &Rows,
    h: &ComplexBall,
    numbers: &Numbers,
    bits: u64,
) -> Result<Ball, EvaluateError> {
    let mut sum = ComplexBall::zero();
    for (left, c) in rows {
        for (right, d) in rows {
            let rate = left + right;
            let moments = moments(&rate, c.len() + d.len() - 1, h, numbers, bits)?;
            for (n, moment) in moments.iter().enumerate() {
                let mut coefficient = ComplexBall::zero();
                for j in n.saturating_sub(d.len() - 1)..=n.min(c.len() - 1) {
                    let ways = Rational::from_integer(binomial(n as u32, j as u32));
                    let product = c[j].multiply(&d[n - j], bits);
                    coefficient = coefficient.add(&product.multiply_rational(&ways, bits), bits);
                }
                sum = sum.add(&coefficient.multiply(moment, bits), bits);
            }
        }
    }
    Ok(real_part(sum)?)
}

/// `∫_0^h e^{νy} y^n/n! dy` for `n < count`.
fn moments(
    rate: &Fraction,
    count: usize,
    h: &ComplexBall,
    numbers: &Numbers,
    bits: u64,
) -> Result<Vec<ComplexBall>, EvaluateError> {
    let field = numbers.field(bits);
    let one = field.embed(&Expression::one())?;
    let mut power = one.clone();
    let mut moments = Vec::with_capacity(count);
    if rate.is_zero() {
        for n in 0..count {
            let share = Rational::new(1.into(), (n + 1).into());
            power = power.multiply(h, bits).multiply_rational(&share, bits);
            moments.push(power.clone());
        }
        return Ok(moments);
    }
    let inverse = field.inverse(rate)?;
    let exponential = field.embed(&rate.clone().into())?.multiply(h, bits);
    let exponential = exponential.exp(bits).map_err(EvaluateError::Ball)?;
    let minus = Rational::from_integer((-1).into());
    let mut last = one;
    for n in 0..count {
        let top = power.multiply(&exponential, bits);
        last = top.add(&last.multiply_rational(&minus, bits), bits).multiply(&inverse, bits);
        moments.push(last.clone());
        let share = Rational::new(1.into(), (n + 1).into());
        power = power.multiply(h, bits).multiply_rational(&share, bits);
    }
    Ok(moments)
}
