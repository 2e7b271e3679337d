//! Random recurrences, and their solution in doubles, period by period.

use crate::chance::Chance;
use crate::compare::{At, BITS, Comparison, about, is_near, reads_back};
use crate::curve::{Curve, POINTS, integrals, points};
use crate::scene::Quotient;
use crate::{SOLVER, TEXT, Tally, Verdict};
use num_traits::ToPrimitive as _;
use wavestep::problem::Problem;
use wavestep::signal::Limit;

/// The recurrence `f' + a f = c e^(−r t) cos ωt + b f[n−1] + d g[n−1]`, `g = p f + q f[n−1] + r g[n−2]`, in which the time `t`
/// runs on, of what is observed `x f + y g(t − delay)`.
pub struct Stated {
    period: Quotient,
    decay: Quotient,
    /// Strength, rate and frequency.
    forcing: [Quotient; 3],
    lags: [Quotient; 2],
    others: [Quotient; 3],
    start: Quotient,
    seen: [Quotient; 2],
    /// In periods.
    delay: Quotient,
}

impl Stated {
    pub fn draw(chance: &mut Chance) -> Stated {
        let small = [(0, 1), (1, 2), (-1, 2), (1, 3), (-2, 3), (1, 1), (-1, 1), (3, 7), (1, 1000)];
        let mut factor = || chance.one_of(&small);
        let (lags, others) = ([(); 2].map(|()| factor()), [(); 3].map(|()| factor()));
        let seen = [(); 2].map(|()| factor());
        let forcing = [
            chance.one_of(&[(0, 1), (0, 1), (1, 1), (-3, 4)]),
            chance.one_of(&[(0, 1), (1, 1), (1, 2), (2, 3)]),
            chance.one_of(&[(0, 1), (0, 1), (1, 1), (3, 2)]),
        ];
        let decay = chance.one_of(&[(0, 1), (1, 1), (1, 1), (1, 2), (2, 1), (7, 5), (1, 1000)]);
        let start = chance.one_of(&[(1, 1), (0, 1), (-1, 3)]);
        let delay = chance.one_of(&[(0, 1), (1, 1), (1, 3), (4, 7), (5, 3)]);
        Stated { period: chance.size(), decay, forcing, lags, others, start, seen, delay }
    }

    pub fn text(&self) -> String {
        let Stated { period, decay, forcing, lags, others, start, seen, delay } = self;
        let [strength, rate, frequency] = forcing;
        let forcing = format!("{strength}*exp(-{rate}*t)*cos({frequency}*t)");
        format!(
            "recurrence \"At random\"\nperiod {period}, local s, time t\nwave f, g\n\
             equation f[n]' + {decay}*f[n] = {forcing} + {}*f[n-1] + {}*g[n-1]\n\
             equation g[n] = {}*f[n] + {}*f[n-1] + {}*g[n-2]\n\
             continuous f[n] starts at {start}\nobserve seen = {}*f[n] + {}*g(t - {delay}*{period})\n",
            lags[0], lags[1], others[0], others[1], others[2], seen[0], seen[1]
        )
    }

    /// The waves on each period.
    fn solve(&self, periods: usize) -> Vec<[Curve; 2]> {
        let length = self.period.value();
        let [strength, rate, frequency] = self.forcing.map(Quotient::value);
        let mut known: Vec<[Curve; 2]> = Vec::new();
        let mut start = self.start.value();
        for n in 0..periods {
            let before = |lag: usize, wave: usize, x: f64| {
                n.checked_sub(lag).map_or(0.0, |n| known[n][wave].at(x))
            };
            let input: [f64; POINTS] = std::array::from_fn(|i| {
                let x = points()[i];
                let time = (n as f64 + (x + 1.0) / 2.0) * length;
                let forcing = strength * (-rate * time).exp() * (frequency * time).cos();
                let [own, other] = self.lags.map(Quotient::value);
                forcing + own * before(1, 0, x) + other * before(1, 1, x)
            });
            let mut values = [start; POINTS];
            let mut end = start;
            for _ in 0..80 {
                let slopes: [f64; POINTS] =
                    std::array::from_fn(|i| input[i] - self.decay.value() * values[i]);
                for (at, weights) in integrals().iter().enumerate() {
                    let sum: f64 = weights.iter().zip(&slopes).map(|(a, slope)| a * slope).sum();
                    *values.get_mut(at).unwrap_or(&mut end) = start + sum * length / 2.0;
                }
            }
            let [present, own, other] = self.others.map(Quotient::value);
            let second = std::array::from_fn(|i| {
                let x = points()[i];
                present * values[i] + own * before(1, 0, x) + other * before(2, 1, x)
            });
            known.push([Curve::through(&values), Curve::through(&second)]);
            start = end;
        }
        known
    }

    /// In all ways.
    pub fn compare(&self, chance: &mut Chance) -> Verdict {
        let mut tally = Tally::default();
        match self.compared(chance, &mut tally) {
            Ok(()) => Verdict::Agrees(tally),
            Err(wrong) => Verdict::Wrong(wrong),
        }
    }

    fn compared(&self, chance: &mut Chance, tally: &mut Tally) -> Result<(), String> {
        let text = self.text();
        reads_back(&text, false)?;
        tally.compared[TEXT] += 1;
        let problem = Problem::of_text("random.wave", &text, &Default::default());
        let problem = problem.map_err(|error| error.to_string())?;
        let periods = [2, 3, 4, 6, 12][chance.below(5)];
        let (length, solved) = (self.period.value(), self.solve(periods));
        let until = length * periods as f64;
        let own = (0..4).map(|_| about(until * (1 + chance.below(995)) as f64 / 997.0));
        let mut at: Vec<At> = own.map(|time| (time, Limit::Right)).collect();
        let arrival =
            wavestep_polynomial::Rational::new(self.period.0.into(), self.period.1.into());
        at.extend([Limit::Left, Limit::Right].map(|side| (arrival.clone(), side)));
        let mut comparison = Comparison { problem: &problem, bits: BITS, tally };
        let digits = comparison.digits("seen", &at)?;
        let largest = solved.iter().flatten().map(|own| own.at(1.0).abs()).fold(1.0, f64::max);
        let tolerance = [1e-3, 1e-9, 1e-13][chance.below(3)];
        comparison.doubles("seen", (&at, &digits), (tolerance, largest))?;
        comparison.formulas("f", &problem)?;
        let wave = |wave: usize, time: f64| {
            if time < 0.0 {
                return 0.0;
            }
            let n = ((time / length) as usize).min(periods - 1);
            solved[n][wave].at(2.0 * (time / length - n as f64) - 1.0)
        };
        let [first, second] = self.seen.map(Quotient::value);
        for ((time, _), told) in at[..4].iter().zip(&digits) {
            let Some(told) = told else { continue };
            let time = time.to_f64().expect("a number");
            let double =
                first * wave(0, time) + second * wave(1, time - self.delay.value() * length);
            let near = is_near(told, 1.0, double, 1e-10 * largest);
            near.map_err(|wrong| format!("seen at {time}: {wrong}"))?;
            comparison.tally.compared[SOLVER] += 1;
        }
        Ok(())
    }
}
