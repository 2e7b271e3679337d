//! Integrals of a signal: from the start, or over a sliding interval of fixed length.
//!
//! On a stretch of the integrand its Taylor polynomials, on cells so short that the rest is smaller than
//! their rounding, are integrated term by term: `∫_a^b f = h (P(u_b) − P(u_a))`, `P` the antiderivative of
//! the polynomial in `u = (t − m)/h`, and what is left out adds at most the rest times `|b − a|`. The integral
//! from one time to another is that of the part of the first stretch, of whole stretches, and of the part
//! of the last one; whole stretches that are zero add an exact zero. Where the integrand is an exact
//! expression, so is the integral. Its derivative is the integrand now, less that at the other end.
//!
//! A cell is short enough, too, where all that its polynomial leaves out is smaller than the last bit of the integral
//! so far: what has decayed needs no cells as short as what has not.

use super::{Mark, Outcome, Rule, Scale, locate, taylor_by_rate, value_at, working};
use crate::ball::{Arithmetic as _, Ball, Binary, Magnitude};
use crate::expression::{Expression, Fraction};
use crate::signal::{
    EchoCount, Effort, Enclosure, Instant, Known, Limit, Near, Signal, Taylor, has_begun,
};
use num_traits::Zero as _;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// Over so many stretches since the start an integral is an exact sum: each of them adds its own exponentials.
const MOST_EXACT: usize = 16;

/// How often a stretch is halved at most.
const MAX_DEPTH: usize = 40;

/// Cells are widened by `1/SLACK`, so that an enclosed end lies inside; by no more, since beyond its stretch a function
/// grows at the fastest rate of its scene.
const SLACK: u64 = 1 << 48;

/// `∫ f dt` over a sliding interval, or from the start, in the time of the scene.
///
/// # Invariants
/// - the window of the integrand reaches to the end of that of the integral, and as far back as it is
///   integrated.
pub(crate) struct Integral<'a> {
    scale: Rc<Scale<'a>>,
    of: Rc<dyn Signal + 'a>,
    /// The length; none for integrals from the start.
    last: Option<Fraction>,
    /// What the integrand was before the start.
    before: Fraction,
    window: [Rational; 2],
    primitives: RefCell<BTreeMap<(u64, usize), Rc<Primitive>>>,
    /// The integrals of whole stretches, in the time of the scene.
    wholes: RefCell<BTreeMap<(u64, usize), Ball>>,
}

/// A part of a stretch with the antiderivative of its polynomial.
struct Cell {
    from: Rational,
    to: Rational,
    /// About `to`: cells reach a little further.
    until: Binary,
    middle: Ball,
    half: Ball,
    /// One over `half`.
    per_half: Ball,
    antiderivative: Taylor,
    /// The integral from the start of the first cell to that of this one, less the antiderivative there.
    offset: Ball,
}

/// The integral of one stretch; without cells it is zero.
struct Primitive {
    cells: Vec<Cell>,
}

/// So many terms that `4^N/N!` is below `2^(−bits)`: for all cells of a history, on which rates times
/// lengths are at most 4, and few cells of a closed form.
fn terms(bits: u64) -> usize {
    let (mut terms, mut size) = (1_usize, 0.0);
    while size > -(bits as f64) {
        size += 2.0 - (terms as f64).log2();
        terms += 1;
    }
    terms
}

/// The two ends of an integral, as operands.
const UPPER: usize = 0;
const LOWER: usize = 1;

impl<'a> Integral<'a> {
    pub fn new(
        scale: &Rc<Scale<'a>>,
        of: Rc<dyn Signal + 'a>,
        last: Option<Fraction>,
        before: Fraction,
        window: [&Rational; 2],
    ) -> Integral<'a> {
        let (scale, window) = (Rc::clone(scale), window.map(Clone::clone));
        let (primitives, wholes) = Default::default();
        Integral { scale, of, last, before, window, primitives, wholes }
    }

    /// The places of both ends at a time: the stretch of the upper one, and one more than that of the lower
    /// one, or zero where that lies before the start.
    fn places(&self, at: &Rational, side: Limit) -> Outcome<[usize; 2]> {
        let at = self.scale.mark(at);
        let upper = locate(&*self.of, &at, side)?;
        let lower = match &self.lower(&at) {
            Some(lower) if has_begun(self.scale.mark(&Rational::zero()).compare(lower)?, side) => {
                locate(&*self.of, lower, side)? + 1
            }
            _ => 0,
        };
        Ok([upper, lower])
    }

    /// Where the integral over the last time begins.
    fn lower<'m>(&'m self, at: &'m Mark<'_>) -> Option<Mark<'m>> {
        let last = self.last.as_ref()?;
        Some(at.again().after(-last, &self.scale))
    }

    fn slowness(&self, bits: u64) -> Outcome<Ball> {
        Ok(self.scale.numbers.enclose(&self.scale.slowness, bits)?)
    }

    fn primitive(&self, stretch: usize, bits: u64) -> Outcome<Rc<Primitive>> {
        if let Some(known) = self.primitives.borrow().get(&(bits, stretch)) {
            return Ok(Rc::clone(known));
        }
        let mut cells = Vec::new();
        if !self.of.is_zero(stretch) {
            let outer = |end| -> Outcome<[Rational; 2]> {
                if let Some(time) = self.of.exact_time(stretch, end) {
                    return Ok([time.clone(), time]);
                }
                Ok(self.of.time(stretch, end, bits)?.bounds())
            };
            let ([from, _], [_, to]) = (outer(Limit::Right)?, outer(Limit::Left)?);
            self.add_cells(&mut cells, stretch, (from, to), MAX_DEPTH, bits)?;
        }
        let primitive = Rc::new(Primitive { cells });
        self.primitives.borrow_mut().insert((bits, stretch), Rc::clone(&primitive));
        Ok(primitive)
    }

    fn add_cells(
        &self,
        cells: &mut Vec<Cell>,
        stretch: usize,
        (from, to): (Rational, Rational),
        depth: usize,
        bits: u64,
    ) -> Outcome<()> {
        if from >= to {
            return Ok(());
        }
        let two = Rational::from_integer(2.into());
        let slack = Rational::new((SLACK + 1).into(), SLACK.into());
        let (middle, half) = ((&from + &to) / &two, (&to - &from) / two * slack);
        let start = Ball::from_rational(&from, bits);
        let so_far = cells.last().map_or_else(Ball::zero, |cell| cell.until(&start, bits));
        // What is expanded, and whether it leaves out more than its rounding, and more than the integral so far.
        let expand = |terms| -> Outcome<(Taylor, bool)> {
            let near = Near { order: 0, place: (&middle, &half), terms, bits };
            let taylor = self.of.taylor(stretch, near)?;
            let sizes = taylor.coefficients.iter().map(Ball::magnitude).max();
            let small = sizes.unwrap_or(Magnitude::ZERO).scale(-(bits as i64));
            let rounding = taylor.coefficients.iter().map(|c| *c.radius()).max();
            let small = rounding.unwrap_or(Magnitude::ZERO).max(small);
            let left_out = taylor.remainder.multiply(&Magnitude::from_rational(&half)).scale(1);
            let matters = left_out > so_far.magnitude().scale(-(bits as i64));
            let is_rough = taylor.remainder > small && matters;
            Ok((taylor, is_rough))
        };
        // Half the terms cost a fourth, and are often enough.
        let (taylor, is_rough) = match expand(terms(bits) / 2)? {
            (taylor, false) => (taylor, false),
            _ => expand(terms(bits))?,
        };
        if is_rough && depth > 0 {
            self.add_cells(cells, stretch, (from, middle.clone()), depth - 1, bits)?;
            return self.add_cells(cells, stretch, (middle, to), depth - 1, bits);
        }
        let antiderivative = taylor.antiderivative(bits);
        let until = Ball::from_rational(&to, bits).midpoint().clone();
        let [middle, half, per_half] =
            [&middle, &half, &half.recip()].map(|number| Ball::from_rational(number, bits));
        let offset = Ball::zero();
        let mut cell = Cell { from, to, until, middle, half, per_half, antiderivative, offset };
        cell.offset = so_far.subtract(&cell.until(&start, bits), bits);
        cells.push(cell);
        Ok(())
    }

    /// The integral from the start of a stretch to a time, which may lie beyond its ends. Where a time is not known to be in
    /// one cell, that to its middle, and the radius times a bound of the function.
    fn until(&self, stretch: usize, time: &Ball, bits: u64) -> Outcome<Ball> {
        let primitive = self.primitive(stretch, bits)?;
        let Some(cell) = primitive.cell(time) else { return Ok(Ball::zero()) };
        if cell.holds(time, bits) {
            return Ok(cell.until(time, bits));
        }
        let middle = Rational::from(time.midpoint());
        if !time.is_exact() {
            let radius = Rational::from(time.radius());
            let near = Near { order: 0, place: (&middle, &radius), terms: 2, bits };
            let taylor = self.of.taylor(stretch, near)?;
            let sizes = taylor.coefficients.iter().map(Ball::magnitude);
            let most = sizes.fold(taylor.remainder, |sum, size| sum.add(&size));
            let value =
                self.until(stretch, &Ball::new(time.midpoint().clone(), Magnitude::ZERO), bits)?;
            return Ok(value.widened(&most.multiply(time.radius())));
        }
        let (first, last) = (&primitive.cells[0], &primitive.cells[primitive.cells.len() - 1]);
        let (edge, beyond) = match middle < first.from {
            true => (&first.from, (middle, first.from.clone())),
            false if middle > last.to => (&last.to, (last.to.clone(), middle)),
            false => return Ok(cell.until(time, bits)),
        };
        let mut cells = Vec::new();
        self.add_cells(&mut cells, stretch, beyond, MAX_DEPTH, bits)?;
        let (edge, beyond) = (Ball::from_rational(edge, bits), Primitive { cells });
        let rest = beyond.until(time, bits).subtract(&beyond.until(&edge, bits), bits);
        Ok(primitive.until(&edge, bits).add(&rest, bits))
    }

    /// The integral of a whole stretch, not the last one, in the time of the scene.
    fn whole(&self, stretch: usize, bits: u64) -> Outcome<Ball> {
        if let Some(known) = self.wholes.borrow().get(&(bits, stretch)) {
            return Ok(known.clone());
        }
        let [from, to] = [stretch, stretch + 1].map(|start| Mark::of(&*self.of, start).ball(bits));
        let whole = self.between(stretch, [&from?, &to?], bits)?;
        self.wholes.borrow_mut().insert((bits, stretch), whole.clone());
        Ok(whole)
    }

    /// The integral between two times of a stretch, in the time of the scene.
    fn between(&self, stretch: usize, ends: [&Ball; 2], bits: u64) -> Outcome<Ball> {
        let [from, to] = ends.map(|time| self.until(stretch, time, bits));
        Ok(to?.subtract(&from?, bits).multiply(&self.slowness(bits)?, bits))
    }

    /// The integral from the lower end to the upper one, in terms.
    fn integral(&self, places: &[usize], at: &Mark<'_>, bits: u64) -> Outcome<Vec<Ball>> {
        let bits = working(bits);
        let mut terms = Vec::new();
        let upper = at.ball(bits)?;
        let (first, last) = (places[LOWER].saturating_sub(1), places[UPPER]);
        for stretch in (first..=last).filter(|stretch| !self.of.is_zero(*stretch)) {
            if first < stretch && stretch < last {
                terms.push(self.whole(stretch, bits)?);
                continue;
            }
            let from = match self.lower(at).filter(|_| stretch == first && places[LOWER] > 0) {
                Some(lower) => lower.ball(bits)?,
                None => Mark::of(&*self.of, stretch).ball(bits)?,
            };
            let to = match stretch == last {
                true => upper.clone(),
                false => Mark::of(&*self.of, stretch + 1).ball(bits)?,
            };
            if !from.is_exact() || from != to {
                terms.push(self.between(stretch, [&from, &to], bits)?);
            }
        }
        if let (0, Some(last)) = (places[LOWER], &self.last)
            && !self.before.is_zero()
        {
            let rest = self.scale.numbers.enclose(last, bits)?;
            let rest = rest.subtract(&upper.multiply(&self.slowness(bits)?, bits), bits);
            terms.push(rest.multiply(&self.scale.numbers.enclose(&self.before, bits)?, bits));
        }
        Ok(terms)
    }

    /// The integrand at the lower end as a polynomial about that of a time.
    fn taylor_below(&self, place: usize, near: Near<'_>) -> Outcome<Taylor> {
        let Near { order, place: (middle, half), bits, .. } = near;
        let before = |value: Ball| Taylor::polynomial(vec![value]);
        let Some(last) = &self.last else { return Ok(before(Ball::zero())) };
        if place == 0 {
            return Ok(before(match order {
                0 => self.scale.numbers.enclose(&self.before, bits)?,
                _ => Ball::zero(),
            }));
        }
        if let Some(length) = self.scale.exact_time(last) {
            return self.of.taylor(place - 1, Near { place: (&(middle - length), half), ..near });
        }
        let about = Ball::from_rational(middle, bits).subtract(&self.scale.time(last, bits)?, bits);
        let off = Rational::from(about.radius());
        let larger = half + &off + &off;
        let about = Rational::from(about.midpoint());
        let taylor = self.of.taylor(place - 1, Near { place: (&about, &larger), ..near })?;
        let mut taylor = taylor.blurred(&Magnitude::from_rational(&(off / &larger)));
        taylor.stretch(&(half / larger), bits);
        Ok(taylor)
    }

    /// When a stretch of the integrand begins, in the scale of the scene.
    fn start(&self, stretch: usize) -> Option<Fraction> {
        let Instant { event, delay, .. } = self.of.instant(stretch)?;
        event.is_none().then_some(delay)
    }
}

impl Cell {
    /// `u` of a time.
    fn place(&self, time: &Ball, bits: u64) -> Ball {
        time.subtract(&self.middle, bits).multiply(&self.per_half, bits)
    }

    /// Whether the polynomial holds at a time.
    fn holds(&self, time: &Ball, bits: u64) -> bool {
        let (lower, upper) = self.place(time, bits).endpoints();
        [lower, upper].iter().all(|end| end.is_within(&Magnitude::power_of_two(0)))
    }

    /// The integral from the start of the first cell to a time within this one.
    fn until(&self, time: &Ball, bits: u64) -> Ball {
        let u = self.place(time, bits);
        let value = self.antiderivative.value(&u, bits).multiply(&self.half, bits);
        value.add(&self.offset, bits)
    }
}

impl Primitive {
    /// The cell whose polynomial is taken for a time.
    fn cell(&self, time: &Ball) -> Option<&Cell> {
        let cell = self.cells.partition_point(|cell| cell.until < *time.midpoint());
        self.cells.get(cell).or(self.cells.last())
    }

    /// The integral from the start of the first cell to a time.
    fn until(&self, time: &Ball, bits: u64) -> Ball {
        self.cell(time).map_or_else(Ball::zero, |cell| cell.until(time, bits))
    }
}

impl Rule for Integral<'_> {
    fn ranges(&self) -> Outcome<Vec<Range<usize>>> {
        let first = self.places(&self.window[0], Limit::Right)?;
        let last = self.places(&self.window[1], Limit::Left)?;
        Ok([UPPER, LOWER].map(|end| first[end]..last[end].max(first[end]) + 1).into())
    }

    fn mark(&self, end: usize, place: usize) -> Mark<'_> {
        match (&self.last, end, place) {
            (Some(last), LOWER, 1) => {
                self.scale.mark(&Rational::zero()).after(last.clone(), &self.scale)
            }
            (Some(last), LOWER, _) => {
                Mark::of(&*self.of, place - 1).after(last.clone(), &self.scale)
            }
            _ => Mark::of(&*self.of, place),
        }
    }

    fn is_continuous(&self) -> bool {
        true
    }

    fn is_zero(&self, places: &[usize]) -> bool {
        let first = places[LOWER].saturating_sub(1);
        let from_start = places[LOWER] > 0 || self.before.is_zero() || self.last.is_none();
        from_start && (first..=places[UPPER]).all(|stretch| self.of.is_zero(stretch))
    }

    fn terms(
        &self,
        places: &[usize],
        order: usize,
        at: &Mark<'_>,
        bits: u64,
    ) -> Outcome<Vec<Ball>> {
        let Some(order) = order.checked_sub(1) else {
            return self.integral(places, at, bits);
        };
        let slowness = self.slowness(bits)?;
        let now = value_at(&*self.of, places[UPPER], order, at, bits)?.multiply(&slowness, bits);
        let then = match (self.lower(at), places[LOWER], order) {
            (Some(lower), place @ 1.., _) => value_at(&*self.of, place - 1, order, &lower, bits)?,
            (Some(_), 0, 0) => self.scale.numbers.enclose(&self.before, bits)?,
            _ => Ball::zero(),
        };
        Ok(vec![now, then.multiply(&slowness, bits).negate()])
    }

    fn taylor(&self, places: &[usize], near: Near<'_>) -> Outcome<Taylor> {
        let Near { place: (middle, _), bits, .. } = near;
        let rate = |near: Near<'_>| {
            let minus = Ball::from_integer(&(-1).into());
            let mut taylor = self.of.taylor(places[UPPER], near)?;
            let below = self.taylor_below(places[LOWER], near)?;
            taylor = taylor.add(&below.scaled(&minus, bits), bits);
            Ok(taylor.scaled(&self.slowness(bits)?, bits))
        };
        let value = || {
            let parts = self.integral(places, &self.scale.mark(middle), bits)?;
            Ok(parts.iter().fold(Ball::zero(), |sum, part| sum.add(part, bits)))
        };
        taylor_by_rate(near, rate, value)
    }

    fn exact_at(&self, places: &[usize], at: &Fraction, effort: Effort) -> Option<Expression> {
        let Scale { clock, assumptions, .. } = &*self.scale;
        let time = Fraction::symbol(clock);
        let mut sum = Expression::zero();
        let from_start = self.last.is_none() || places[LOWER] == 0;
        if let (true, Some(last)) = (from_start, &self.last) {
            sum += &(&self.before * &(last - at)).into();
        }
        let first = places[LOWER].saturating_sub(1);
        if self.last.is_none() && places[UPPER] - first > MOST_EXACT {
            return None;
        }
        for stretch in first..=places[UPPER] {
            let integrand = self.of.exact_at(stretch, &time, effort)?;
            if integrand.is_zero() {
                continue;
            }
            let primitive = integrand.antiderivative(clock, assumptions).ok()?;
            let from = match (&self.last, stretch == first && !from_start) {
                (Some(last), true) => at - last,
                _ => self.start(stretch)?,
            };
            let to = match stretch == places[UPPER] {
                true => at.clone(),
                false => self.start(stretch + 1)?,
            };
            sum += &primitive.substitute(clock, &to).ok()?;
            sum -= &primitive.substitute(clock, &from).ok()?;
        }
        Some(sum)
    }

    fn point(&self, at: &Rational, _: Limit) -> Outcome<(Known, Enclosure<'_>, u64)> {
        let places = self.places(at, Limit::Left)?;
        let known = match self.is_zero(&places) {
            true => Some(Rational::zero()),
            false => {
                let scaled = self.scale.scaled_time(at);
                let exact = self.exact_at(&places, &scaled, Effort::Little);
                exact.and_then(|exact| exact.as_constant())
            }
        };
        let at = at.clone();
        let enclose = move |bits| {
            let terms = self.integral(&places, &self.scale.mark(&at), bits)?;
            Ok(terms.iter().fold(Ball::zero(), |sum, term| sum.add(term, bits)))
        };
        let known = known.map_or(Known::Unknown, Known::Rational);
        Ok((known, Box::new(enclose), self.of.most_bits()))
    }

    fn operands(&self) -> Vec<&dyn Signal> {
        vec![&*self.of]
    }

    fn echoes(&self) -> Option<EchoCount> {
        self.of.echoes()
    }
}
