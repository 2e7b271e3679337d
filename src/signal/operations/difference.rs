//! The difference of two signals of two scenes: how far one is from the other, or from what its own first arrivals tell.
//!
//! Each scene has a scale of its own. A delay of the second is told in the scale of the first where it holds but numbers,
//! `pi` and square roots, which mean the same everywhere; so what happens in both scenes at once is one break.

use super::{Mark, Outcome, Rule, Scale, flatness_of, value_at};
use crate::ball::{Arithmetic as _, Ball};
use crate::expression::{Expression, Fraction, is_number};
use crate::signal::{
    At, Effort, Enclosure, Instant, Known, Limit, Near, Signal, Taylor, later, zeros_of,
};
use std::ops::Range;
use std::rc::Rc;
use wavestep_polynomial::{Rational, Symbol};

/// # Invariants
/// - both operands have values in one unit, and the window of the difference; where arrivals are left out one that begins with
///   the start.
/// - where arrivals are left out, the function of each stretch of the second operand is known for all times after it.
pub(crate) struct Difference<'a> {
    pub scales: [Rc<Scale<'a>>; 2],
    pub operands: [Rc<dyn Signal + 'a>; 2],
    /// How many arrivals of the second operand count, from the start on: after them it goes on as if no more came.
    pub arrivals: Option<usize>,
    /// When the window begins.
    pub from: Rational,
}

impl<'a> Difference<'a> {
    /// Whether a number means the same in both scenes: it holds the time, square roots, `pi`, and constants with one name and one
    /// definition, as all those that they may rest on have.
    fn is_common(&self, number: &Fraction) -> bool {
        let [own, other] = self.scales.each_ref().map(|scale| scale.constants);
        let shared = own.iter().zip(other).take_while(|(own, other)| own == other);
        let shared: Vec<_> = shared.map(|(own, _)| &own.symbol).collect();
        let symbols = Expression::from(number.clone()).symbols();
        symbols.iter().all(|symbol| {
            let is_clock = self.scales.iter().all(|scale| scale.clock == symbol);
            let is_time = is_clock || *symbol == later();
            is_time || is_number(symbol) || shared.contains(&symbol)
        })
    }

    /// A time in the scale of one scene, in that of the other, where the units of time have an exact ratio.
    fn rescaled(&self, time: &Fraction, [from, to]: [usize; 2]) -> Option<Fraction> {
        let unit = |scene: usize| &self.scales[scene].unit;
        let ratio = unit(from).over(unit(to)).ok()?.exact()?;
        self.is_common(time).then(|| time * &ratio)
    }

    /// How many stretches of the second operand count.
    fn places(&self) -> Outcome<usize> {
        let count = self.operands[1].count()?;
        Ok(self.arrivals.map_or(count, |arrivals| count.min(arrivals + 1)))
    }

    /// A value of the second operand after the last arrival that counts; none before.
    fn after_the_last(&self, at: &Rational, side: Limit) -> Outcome<Option<Enclosure<'_>>> {
        let (own, last) = (&self.operands[1], self.places()? - 1);
        if self.arrivals.is_none() || own.stretch_at(at, side)?.is_none_or(|place| place <= last) {
            return Ok(None);
        }
        let at = at.clone();
        Ok(Some(Box::new(move |bits| own.enclose(last, 0, At::Time(&at), bits))))
    }

    fn both<T>(
        &self,
        places: &[usize],
        ask: impl Fn(&(dyn Signal + 'a), usize) -> Outcome<T>,
    ) -> Outcome<[T; 2]> {
        let [own, other] = &self.operands;
        Ok([ask(&**own, places[0])?, ask(&**other, places[1])?])
    }
}

impl Rule for Difference<'_> {
    fn ranges(&self) -> Outcome<Vec<Range<usize>>> {
        let range = |operand: usize, end: usize| -> Outcome<Range<usize>> {
            let own = &self.operands[operand];
            let begun = match own.window()[0] < &self.from {
                true => own.stretch_at(&self.from, Limit::Right)?.unwrap_or(0),
                false => 0,
            };
            Ok(begun.min(end - 1)..end)
        };
        Ok(vec![range(0, self.operands[0].count()?)?, range(1, self.places()?)?])
    }

    /// Arrivals of two scenes may be one instant that no normal form shows.
    fn takes_ties(&self) -> bool {
        true
    }

    fn mark(&self, operand: usize, place: usize) -> Mark<'_> {
        let mark = Mark::of(&*self.operands[operand], place);
        let known = match (operand, &mark.instant) {
            (0, _) => return mark,
            (_, Some(Instant { event: None, delay, .. })) => self.rescaled(delay, [1, 0]),
            _ => None,
        };
        Mark { instant: known.map(|delay| self.scales[0].instant(delay)), ..mark }
    }

    fn is_instant(&self, operand: usize, place: usize) -> bool {
        self.operands[operand].is_instant(place)
    }

    fn is_continuous(&self) -> bool {
        self.operands.iter().all(|own| own.is_continuous())
    }

    fn is_zero(&self, places: &[usize]) -> bool {
        // Until the last arrival that counts both are one function.
        self.arrivals.is_some() && places[0] == places[1]
            || self.operands.iter().zip(places).all(|(operand, place)| operand.is_zero(*place))
    }

    fn terms(
        &self,
        places: &[usize],
        order: usize,
        at: &Mark<'_>,
        bits: u64,
    ) -> Outcome<Vec<Ball>> {
        let [own, other] =
            self.both(places, |operand, place| value_at(operand, place, order, at, bits))?;
        Ok(vec![own, other.negate()])
    }

    fn taylor(&self, places: &[usize], near: Near<'_>) -> Outcome<Taylor> {
        let [own, other] = self.both(places, |operand, place| operand.taylor(place, near))?;
        Ok(own.subtract(&other, near.bits))
    }

    /// Where all that the second one holds means the same in the scene of the first one, its time as well; at all times at
    /// once also what is constant in both.
    fn exact_at(&self, places: &[usize], at: &Fraction, effort: Effort) -> Option<Expression> {
        let [clock, others] = self.scales.each_ref().map(|scale| Fraction::symbol(scale.clock));
        let time = self.rescaled(at, [0, 1]);
        let is_common = time.is_some();
        let time = time.or_else(|| (*at == clock).then_some(others))?;
        let own = self.operands[0].exact_at(places[0], at, effort)?;
        let other = self.operands[1].exact_at(places[1], &time, effort)?;
        if let (Some(own), Some(other)) = (own.as_constant(), other.as_constant()) {
            return Some(Expression::constant(&(own - other)));
        }
        let means_the_same = |symbol: &Symbol| self.is_common(&Fraction::symbol(symbol));
        (is_common && other.symbols().iter().all(means_the_same)).then(|| &own + &-&other)
    }

    fn exact_value(&self, places: &[usize], at: &Fraction) -> Outcome<Option<Rational>> {
        // Where arrivals are left out, the second operand itself is not what is subtracted.
        if self.arrivals.is_some() {
            return Ok(None);
        }
        let Some(theirs) = self.rescaled(at, [0, 1]) else { return Ok(None) };
        let own = self.operands[0].exact(places[0], At::Scaled(at))?;
        let other = self.operands[1].exact(places[1], At::Scaled(&theirs))?;
        Ok(own.zip(other).map(|(own, other)| own - other))
    }

    /// By the exact function of both, where that is known; else both are as flat.
    fn flatness(
        &self,
        places: &[usize],
        at @ (mark, _): (&Mark<'_>, Limit),
        order: usize,
    ) -> Outcome<usize> {
        let all = Fraction::symbol(self.scales[0].clock);
        let function = self.exact_at(places, &all, Effort::Much);
        if let (Some(function), Some(delay)) = (function, mark.delay()) {
            return zeros_of(function, self.scales[0].clock, delay, order);
        }
        let theirs = mark.delay().and_then(|delay| self.rescaled(delay, [0, 1]));
        let delays = [mark.delay(), theirs.as_ref()];
        let of = |i: usize| {
            let time = (&*self.scales[i], delays[i]);
            flatness_of(&*self.operands[i], places[i], at, order, time)
        };
        Ok(of(0)?.min(of(1)?))
    }

    fn point(&self, at: &Rational, side: Limit) -> Outcome<(Known, Enclosure<'_>, u64)> {
        if let Some(other) = self.after_the_last(at, side)? {
            let own = self.operands[0].point(at, side)?;
            let most_bits = own.most_bits;
            let enclose = move |bits| Ok((own.enclose)(bits)?.subtract(&other(bits)?, bits));
            return Ok((Known::Unknown, Box::new(enclose), most_bits));
        }
        let [own, other] = self.operands.each_ref().map(|operand| operand.point(at, side));
        let (own, other) = (own?, other?);
        let most_bits = own.most_bits.min(other.most_bits);
        let known = match (&own.known, &other.known) {
            (Known::Rational(own), Known::Rational(other)) => Known::Rational(own - other),
            _ => Known::Unknown,
        };
        let enclose = move |bits| Ok((own.enclose)(bits)?.subtract(&(other.enclose)(bits)?, bits));
        Ok((known, Box::new(enclose), most_bits))
    }

    fn operands(&self) -> Vec<&dyn Signal> {
        self.operands.iter().map(|operand| &**operand as &dyn Signal).collect()
    }
}
