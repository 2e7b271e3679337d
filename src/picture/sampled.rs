//! Observables sampled for a line: more densely where they bend, from both sides where they jump.

use crate::ball::Ball;
use crate::evaluate::{EvaluateError, SceneEvaluator, Side, Signal, Stretch};
use crate::expression::Fraction;
use crate::network::{Network, Observed};
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

/// A quantity on a window of time as points of a line and jumps.
///
/// ```
/// use wavestep::evaluate::Signal;
/// use wavestep::language::{Source, parse_number, read_recurrence};
/// use wavestep::picture::sampled;
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = [("mu".to_owned(), parse_number("1")?)].into();
/// let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &values)?;
/// let f = Signal::of_recurrence(&recurrence, &recurrence.observation("f").unwrap()).unwrap();
/// let line = sampled(&f, &parse_number("0")?, &parse_number("3")?).unwrap();
/// // From 1 down to e^{−2}; at 2 it rises by 1.
/// assert_eq!(line.points[0], (0.0, 1.0));
/// let [(at, before, after)] = line.jumps[..] else { panic!("one jump") };
/// assert!(at == 2.0 && (before - (-2.0_f64).exp()).abs() < 1e-15 && (after - before - 1.0).abs() < 1e-15);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Sampled {
    /// Times and values; not a number where the line is interrupted by a jump.
    pub points: Vec<(f64, f64)>,
    /// When it jumps, from which value and to which.
    pub jumps: Vec<(f64, f64, f64)>,
}

/// Samples a signal from one time to another: a line through the points is off by at most about a
/// thousandth of the range.
///
/// # Errors
/// [`EvaluateError`]; an empty window.
///
/// # Cost
/// A few hundred values, and at least three between two arrivals.
///
/// ```
/// use wavestep::evaluate::Signal;
/// use wavestep::language::{Source, parse_number, read_recurrence};
///
/// let text = wavestep::scenes::find("two-bars").unwrap().text;
/// let values = [("r".to_owned(), parse_number("1/2")?)].into();
/// let recurrence = read_recurrence(&Source::new("two-bars", text)?, &values)?;
/// let force = recurrence.observation("force").unwrap();
/// let force = Signal::of_recurrence(&recurrence, &force).unwrap();
/// let line = wavestep::picture::sampled(&force, &parse_number("0")?, &parse_number("5")?).unwrap();
/// assert_eq!(line.jumps.len(), 2);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn sampled(signal: &Signal, from: &Rational, to: &Rational) -> Result<Sampled, EvaluateError> {
    if from >= to {
        return Err(EvaluateError::EmptyWindow);
    }
    let sampler = Sampler::new(signal)?;
    let stretches = signal.stretches(from, to)?;
    let window = sampler.seconds(&(signal.slowness().scale(to)))?
        - sampler.seconds(&signal.slowness().scale(from))?;
    let mut coarse = Vec::with_capacity(stretches.len());
    for stretch in &stretches {
        coarse.push(sampler.coarse(stretch, window)?);
    }
    let values = || coarse.iter().flatten().map(|point| point.1);
    let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
    let mut found = Sampled::default();
    for (stretch, points) in stretches.iter().zip(&coarse) {
        let start = (points[0].0, points[0].1);
        if let Some(&(at, before)) = found.points.last()
            && (start.1 - before).abs() > CONTINUOUS * range
        {
            found.jumps.push((at, before, start.1));
            found.points.push((f64::NAN, f64::NAN));
        }
        found.points.push(start);
        for pair in points.windows(2) {
            sampler.refine(
                stretch,
                (pair[0], pair[1]),
                FLAT * range,
                MAX_DEPTH,
                &mut found.points,
            )?;
        }
    }
    found.points.dedup();
    Ok(found)
}

/// Samples an energy, which is no sum of waves, at equal steps; it is continuous.
///
/// # Errors
/// [`EvaluateError`].
///
/// ```
/// use wavestep::language::{Source, parse_number, read_scene};
/// use wavestep::network::Network;
/// use wavestep::picture::sampled_energy;
///
/// let text = wavestep::scenes::find("mass-on-fixed-bar").unwrap().text;
/// let values = [("mu".to_owned(), parse_number("1")?)].into();
/// let scene = read_scene(&Source::new("mass-on-fixed-bar", text)?, &values).unwrap();
/// let network = Network::new(&scene).unwrap();
/// let energy = network.observables().iter().find(|observed| observed.name == "energy").unwrap();
/// let (from, to) = (parse_number("0")?, parse_number("3")?);
/// let line = sampled_energy(&network, energy, [&from, &to], 30).unwrap();
/// assert!(line.points.len() == 31 && line.points.iter().all(|(_, energy)| *energy == 0.5));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn sampled_energy(
    network: &Network,
    observed: &Observed,
    [from, to]: [&Rational; 2],
    steps: usize,
) -> Result<Sampled, EvaluateError> {
    const DIGITS: usize = 9;
    let evaluator = SceneEvaluator::new(network, &network.scaled_time(to))?;
    let mut found = Sampled::default();
    for step in 0..=steps {
        let at = from + (to - from) * Rational::new(step.into(), steps.max(1).into());
        let scaled = network.scaled_time(&at);
        let value = evaluator.value(observed, &scaled, Side::Right, DIGITS, MAX_BITS)?;
        let value = value.decimal(DIGITS).0.to_string().parse().unwrap_or(f64::NAN);
        found.points.push((Ball::from_rational(&at, FIRST_BITS).to_double().0, value));
    }
    Ok(found)
}

/// A time in seconds, the value, and the time in the scale of the waves as a share of a stretch.
type Point = (f64, f64, f64);

struct Sampler<'a> {
    signal: &'a Signal,
    /// One over the slowness.
    inverse: Ball,
}

impl<'a> Sampler<'a> {
    fn new(signal: &'a Signal) -> Result<Sampler<'a>, EvaluateError> {
        let slowness = signal.numbers().enclose(signal.slowness(), FIRST_BITS)?;
        let inverse = slowness.reciprocal(FIRST_BITS).map_err(EvaluateError::Ball)?;
        Ok(Sampler { signal, inverse })
    }

    fn seconds(&self, time: &Fraction) -> Result<f64, EvaluateError> {
        let time = self.signal.numbers().enclose(time, FIRST_BITS)?;
        Ok(time.multiply(&self.inverse, FIRST_BITS).to_double().0)
    }

    /// The point at a share of a stretch; at its ends the limits from within.
    fn point(&self, stretch: &Stretch, share: f64) -> Result<Point, EvaluateError> {
        let length = stretch.to() - stretch.from();
        let exact = Rational::from_float(share).expect("a finite share");
        let at = stretch.from() + &length.scale(&exact);
        let mut bits = FIRST_BITS;
        loop {
            let ball = self.signal.enclose(stretch, 0, &at, bits)?;
            let (value, bound) = ball.to_double();
            if bound.to_double() <= 1e-12 * value.abs().max(1e-60) || bits >= MAX_BITS {
                return Ok((self.seconds(&at)?, value, share));
            }
            if ball.contains_zero() && bound.to_double() < 1e-30 {
                return Ok((self.seconds(&at)?, 0.0, share));
            }
            bits *= 2;
        }
    }

    fn coarse(&self, stretch: &Stretch, window: f64) -> Result<Vec<Point>, EvaluateError> {
        let length = self.seconds(stretch.to())? - self.seconds(stretch.from())?;
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
        stretch: &Stretch,
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
