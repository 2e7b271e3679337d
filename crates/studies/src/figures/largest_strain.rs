//! The period in which the strain at the fixed end is largest, when a rigid mass strikes a bar
//! (figure 6.22).
//!
//! A front leaves the struck end at the beginning of each period and doubles at the fixed end: the
//! strain is there largest in that period, `2 f_n(0) V/c`, as long as the contact pushes. The larger the
//! striking mass, the later the period in which that is largest of all.

use super::scene::problem;
use crate::ratio;
use num_traits::One as _;
use wavestep::ball::Ball;
use wavestep::enclosure::{enclose_expression, enclose_zero};
use wavestep::expression::{Expression, Fraction};
use wavestep_polynomial::{Rational, Symbol};

/// The most periods: each needs a longer expression.
const MAX_PERIODS: usize = 60;

/// The strains at the fixed end at the beginnings of periods, as exact functions of the mass ratio.
pub struct LargestStrain {
    mu: Symbol,
    /// The wave functions f_n, in s and mu.
    pieces: Vec<Expression>,
    strains: Vec<Expression>,
    /// The force at the ends of periods, over that at the start.
    forces: Vec<Expression>,
}

impl LargestStrain {
    /// The strains of the periods 0 … `last`, from the derived wave functions.
    pub fn new(last: usize) -> Option<LargestStrain> {
        if last > MAX_PERIODS {
            return None;
        }
        let problem = problem("rigid-mass", &[]);
        let solution = problem.solution().expect("a recurrence");
        let local = &solution.recurrence().statement().local;
        let pieces = solution.pieces(0, 0, last).expect("a wave with pieces");
        let two = ratio(2, 1);
        let strains = pieces.iter().map(|f| f.at_zero(local).scale(&two)).collect();
        let mu = Symbol::new("mu").expect("a name");
        let period = Fraction::symbol(&mu).scale(&two);
        let at_end = |f: &Expression| f.substitute(local, &period).expect("a polynomial in s");
        let ends: Vec<Expression> = pieces.iter().map(at_end).collect();
        let force = |n: usize| match n {
            0 => ends[0].clone(),
            _ => &ends[n] + &ends[n - 1],
        };
        let forces = (0..ends.len()).map(force).collect();
        Some(LargestStrain { mu, pieces, strains, forces })
    }

    /// `2 f_n(0)`, the strain over `V/c` at the beginning of a period, where the bar has a share μ of the
    /// striking mass.
    pub fn strain(&self, period: usize, mu: &Rational, bits: u64) -> Ball {
        self.enclose(&self.strains[period], mu, bits)
    }

    /// Whether the contact certainly pushes at the end of each period before this one. The force falls
    /// within a period, so that it then pushed all the time, and the front of this period is as in
    /// [`strain`](Self::strain).
    pub fn is_pushed(&self, period: usize, mu: &Rational) -> bool {
        self.forces[..period]
            .iter()
            .all(|force| Ball::zero().is_below(&self.enclose(force, mu, 64)))
    }

    fn enclose(&self, expression: &Expression, mu: &Rational, bits: u64) -> Ball {
        // Terms of size e^{2√(2nx)} cancel: so many bits more are enough for 60 periods.
        let working = bits + 256;
        let at =
            |symbol: &Symbol, bits| (*symbol == self.mu).then(|| Ball::from_rational(mu, bits));
        let value = enclose_expression(expression, &at, working).expect("a value for the symbol");
        value.real().clone()
    }

    /// The largest ratio `1/μ` of the striking mass to that of the bar at which the strains of a period
    /// and the next one are equal: for larger masses the next one is larger. `None` where there is no
    /// such ratio up to `4 (n + 2)²`, or no such period.
    ///
    /// A change of sign is looked for from large masses downwards; the zero is enclosed with proof, that
    /// there is no larger one is not proven.
    pub fn overtaking(&self, period: usize, bits: u64) -> Option<Ball> {
        let next = self.strains.get(period + 1)?;
        self.last_change(&(next - &self.strains[period]), period, bits)
    }

    /// The largest ratio `1/μ` of the striking mass to that of the bar at which the force is zero at the end
    /// of a period, `2(n + 1) L/c`: with larger masses the contact lasts longer. Found as in
    /// [`overtaking`](Self::overtaking).
    pub fn outlasting(&self, period: usize, bits: u64) -> Option<Ball> {
        self.last_change(self.forces.get(period)?, period, bits)
    }

    /// The inverse of the smallest zero, as far as is looked, of an expression that is positive before it.
    fn last_change(&self, expression: &Expression, period: usize, bits: u64) -> Option<Ball> {
        let is_positive =
            |ratio: &Rational| Ball::zero().is_below(&self.enclose(expression, &ratio.recip(), 64));
        let count = i64::try_from(period + 2).ok()?;
        let mut high = Rational::from_integer((4 * count * count).into());
        if !is_positive(&high) {
            return None;
        }
        loop {
            let low = &high * ratio(15, 16);
            if low < ratio(1, 8) {
                return None;
            }
            if !is_positive(&low) {
                let bounds = [high.recip(), low.recip()];
                let mu = enclose_zero(expression, &self.mu, &bounds, bits + 8).ok()?;
                return mu.reciprocal(bits + 8).ok();
            }
            high = low;
        }
    }

    /// When the mass leaves the bar, in `L/c`: the first zero of the force, halved in doubles to about ten
    /// digits; `None` where it stays beyond the periods that are known.
    ///
    /// For certified digits there is [`History`](wavestep::history::History); this is for pictures.
    pub fn release(&self, mu: &Rational) -> Option<f64> {
        let period = (0..self.forces.len()).find(|n| !self.is_pushed(n + 1, mu))?;
        let length = mu + mu;
        let force = |share: &Rational| {
            let s = &length * share;
            let at = |symbol: &Symbol, bits| match symbol {
                known if *known == self.mu => Some(Ball::from_rational(mu, bits)),
                _ => Some(Ball::from_rational(&s, bits)),
            };
            let value = |f: &Expression| enclose_expression(f, &at, 320).expect("known symbols");
            let mut sum = value(&self.pieces[period]).real().clone();
            if let Some(before) = period.checked_sub(1) {
                sum = sum.add(value(&self.pieces[before]).real(), 320);
            }
            sum
        };
        let (mut low, mut high) = (Rational::default(), Rational::one());
        for _ in 0..34 {
            let middle = (&low + &high) * ratio(1, 2);
            if Ball::zero().is_below(&force(&middle)) { low = middle } else { high = middle }
        }
        let within = num_traits::ToPrimitive::to_f64(&low)?;
        Some(2.0 * (period as f64 + within))
    }
}
