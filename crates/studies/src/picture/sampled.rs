//! Observables sampled for a line: more densely where they bend, from both sides where they jump.

use std::cell::Cell;
use wavestep::ball::{Attempt, Ball, Precisions};
use wavestep::signal::{At, EvaluateError, Limit, Signal};
use wavestep_polynomial::Rational;

/// The precision tried first, and the highest.
const FIRST_BITS: u64 = 128;
const MAX_BITS: u64 = 1 << 14;

/// How many points a window has at least, and how often an interval between two is halved at most.
const POINTS: f64 = 160.0;
const MAX_DEPTH: u32 = 7;

/// How far a line may be from what it shows, and how small a jump is none: parts of the range.
const FLAT: f64 = 1e-3;
const CONTINUOUS: f64 = 1e-9;

/// How exact values are: a part of their size, or of the largest one before.
const EXACT: f64 = 1e-12;

/// A quantity on a window of time as points of a line and jumps.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Sampled {
    /// Times and values; not a number where the line is interrupted by a jump.
    pub points: Vec<(f64, f64)>,
    /// When it jumps, from which value and to which.
    pub jumps: Vec<(f64, f64, f64)>,
}

/// Samples a signal on its window: a line through the points is off by at most about a thousandth of the
/// range.
/// Takes a few hundred values, and at least three between two arrivals.
pub fn sampled(function: &dyn Signal) -> Result<Sampled, EvaluateError> {
    let [from, to] = function.window();
    if from >= to {
        return Err(EvaluateError::EmptyWindow);
    }
    if let Ok(form) = function.closed_form() {
        form.foresee(to)?;
    }
    let count = function.count()?;
    let ends = (0..count).map(|stretch| ends(function, stretch)).collect::<Result<Vec<_>, _>>()?;
    let sampler = Sampler { function, ends, largest: Cell::new(0.0) };
    let ends = sampler.ends.first().zip(sampler.ends.last());
    let ([first, _], [_, last]) = ends.expect("a window has a stretch");
    let window = double(last) - double(first);
    let mut coarse = Vec::with_capacity(count);
    for stretch in 0..count {
        coarse.push(sampler.coarse(stretch, window)?);
    }
    let values = || coarse.iter().flatten().map(|point| point.1);
    let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
    let mut found = Sampled::default();
    for (stretch, points) in coarse.iter().enumerate() {
        let start = (points[0].0, points[0].1);
        if let Some(&(at, before)) = found.points.last()
            && (start.1 - before).abs() > CONTINUOUS * range
        {
            found.jumps.push((at, before, start.1));
            found.points.push((f64::NAN, f64::NAN));
        }
        found.points.push(start);
        for pair in points.windows(2) {
            let pair = (pair[0], pair[1]);
            sampler.refine(stretch, pair, FLAT * range, MAX_DEPTH, &mut found.points)?;
        }
    }
    found.points.dedup();
    Ok(found)
}

/// A time, the value there, and the share of the stretch that the time is at.
type Point = (f64, f64, f64);

/// Where a stretch begins and ends: exactly, or as near as no picture shows.
fn ends(function: &dyn Signal, stretch: usize) -> Result<[Rational; 2], EvaluateError> {
    let near = |end| match function.exact_time(stretch, end) {
        Some(time) => Ok(time),
        None => function.time(stretch, end, FIRST_BITS).map(|ball| Rational::from(ball.midpoint())),
    };
    Ok([near(Limit::Right)?, near(Limit::Left)?])
}

fn double(time: &Rational) -> f64 {
    Ball::from_rational(time, FIRST_BITS).to_double().0
}

struct Sampler<'a> {
    function: &'a dyn Signal,
    ends: Vec<[Rational; 2]>,
    /// The largest absolute value so far.
    largest: Cell<f64>,
}

impl Sampler<'_> {
    /// The point at a share of a stretch; at its ends the limits from within.
    fn point(&self, stretch: usize, share: f64) -> Result<Point, EvaluateError> {
        let [from, to] = &self.ends[stretch];
        let time = from + (to - from) * Rational::from_float(share).expect("a finite share");
        let at = match share {
            0.0 => At::End(Limit::Right),
            1.0 => At::End(Limit::Left),
            _ => At::Time(&time),
        };
        let attempt = |bits| {
            let ball = self.function.enclose(stretch, 0, at, bits)?;
            let (value, bound) = ball.to_double();
            let bound = bound.to_double();
            let is_near = bound <= EXACT * self.largest.get();
            // A ball around zero that is narrow or has a radius below 1e-30 is drawn as zero.
            if ball.contains_zero() && (is_near || bound < 1e-30) {
                return Ok(Attempt::Done(0.0));
            }
            Ok::<_, EvaluateError>(Attempt::of(value, is_near || bound <= EXACT * value.abs()))
        };
        let value = Precisions::doubling(FIRST_BITS, MAX_BITS).raise(attempt)?.best();
        self.largest.set(self.largest.get().max(value.abs()));
        Ok((double(&time), value, share))
    }

    fn coarse(&self, stretch: usize, window: f64) -> Result<Vec<Point>, EvaluateError> {
        let [from, to] = &self.ends[stretch];
        let length = double(to) - double(from);
        if length <= 0.0 {
            // An arrival at the end of the window.
            return Ok(vec![self.point(stretch, 0.0)?]);
        }
        let parts = (POINTS * length / window).ceil().max(2.0) as usize;
        let share = |i| i as f64 / parts as f64;
        let points: Result<Vec<Point>, _> =
            (0..=parts).map(|i| self.point(stretch, share(i))).collect();
        let points = points?;
        let flat = points.iter().all(|point| point.1 == points[0].1);
        Ok(if flat { vec![points[0], points[parts]] } else { points })
    }

    /// Adds the end of an interval, and points within it where the line would be off.
    fn refine(
        &self,
        stretch: usize,
        (from, to): (Point, Point),
        off: f64,
        depth: u32,
        points: &mut Vec<(f64, f64)>,
    ) -> Result<(), EvaluateError> {
        if depth > 0 && from.1 != to.1 {
            let middle = self.point(stretch, f64::midpoint(from.2, to.2))?;
            if (middle.1 - f64::midpoint(from.1, to.1)).abs() > off {
                self.refine(stretch, (from, middle), off, depth - 1, points)?;
                return self.refine(stretch, (middle, to), off, depth - 1, points);
            }
        }
        points.push((to.0, to.1));
        Ok(())
    }
}
