//! Observables sampled for a line: more densely where they bend, from both sides where they jump.

use wavestep::ball::{Attempt, Ball, Precisions};
use wavestep::evaluate::{
    At, EvaluateError, Limit, ObservedSignal, Piecewise, SceneEvaluator, Search, Signal,
};
use wavestep::network::{Network, Observed};
use wavestep_polynomial::Rational;

/// Digits of energies.
const DIGITS: usize = 9;

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
/// use wavestep_studies::picture::sampled;
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = [("mu".to_owned(), parse_number("1")?)].into();
/// let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &values)?;
/// let f = Signal::of_recurrence(&recurrence, &recurrence.observation("f").unwrap()).unwrap();
/// let line = sampled(f, &parse_number("0")?, &parse_number("3")?).unwrap();
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
/// let line = wavestep_studies::picture::sampled(force, &parse_number("0")?, &parse_number("5")?).unwrap();
/// assert_eq!(line.jumps.len(), 2);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn sampled(signal: Signal, from: &Rational, to: &Rational) -> Result<Sampled, EvaluateError> {
    if from >= to {
        return Err(EvaluateError::EmptyWindow);
    }
    sample(&ObservedSignal::of_signal(signal, [from, to])?)
}

/// Samples what roots and extrema are looked for in, as [`sampled`] does; so for observables of scenes whose
/// contacts open.
///
/// # Errors
/// [`EvaluateError`].
///
/// ```
/// use wavestep::history::History;
/// use wavestep::language::{Source, parse_number, read_scene};
/// use wavestep::network::Network;
/// use wavestep_studies::picture::sampled_search;
///
/// let text = "scene \"A\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nline free - rod | fixed\n\
///             contacts open\nobserve v = velocity(rod.at(1/2))";
/// let scene = read_scene(&Source::new("text", text)?, &Default::default()).unwrap();
/// let network = Network::new(&scene).unwrap();
/// let window = [parse_number("0")?, parse_number("9")?];
/// let search = History::search(&network, "v", [&window[0], &window[1]]).unwrap();
/// // The bar is stopped, and thrown back from the wall.
/// assert_eq!(sampled_search(&search).unwrap().jumps, [(0.5, 1.0, 0.0), (1.5, 0.0, -1.0)]);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn sampled_search(search: &Search<'_>) -> Result<Sampled, EvaluateError> {
    sample(search.function.as_ref())
}

fn sample(function: &dyn Piecewise) -> Result<Sampled, EvaluateError> {
    let ends: Result<Vec<Ends>, _> =
        (0..function.count()).map(|stretch| Ends::of(function, stretch)).collect();
    let sampler = Sampler { function, ends: ends? };
    let [first, last] = [sampler.ends.first(), sampler.ends.last()].map(|ends| {
        let ends = ends.expect("a window has a stretch");
        [double(&ends.from), double(&ends.to)]
    });
    let window = last[1] - first[0];
    let mut coarse = Vec::with_capacity(function.count());
    for stretch in 0..function.count() {
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

/// Samples an energy, which is no sum of waves, at equal steps; it is continuous.
///
/// # Errors
/// [`EvaluateError`].
///
/// ```
/// use wavestep::language::{Source, parse_number, read_scene};
/// use wavestep::network::Network;
/// use wavestep_studies::picture::sampled_energy;
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
    let evaluator = SceneEvaluator::new(network, &network.scaled_time(to))?;
    let mut found = Sampled::default();
    for step in 0..=steps {
        let at = from + (to - from) * Rational::new(step.into(), steps.max(1).into());
        let scaled = network.scaled_time(&at);
        let value = evaluator.value(observed, &scaled, Limit::Right, DIGITS, MAX_BITS)?;
        found.points.push((double(&at), value.to_double()));
    }
    Ok(found)
}

/// A time, the value there, and the share of the stretch that the time is at.
type Point = (f64, f64, f64);

/// Where a stretch begins and ends: exactly, or as near as no picture shows.
struct Ends {
    from: Rational,
    to: Rational,
}

impl Ends {
    fn of(function: &dyn Piecewise, stretch: usize) -> Result<Ends, EvaluateError> {
        let near = |end| -> Result<Rational, EvaluateError> {
            Ok(match function.exact_time(stretch, end) {
                Some(time) => time,
                None => Rational::from(function.time(stretch, end, FIRST_BITS)?.midpoint()),
            })
        };
        Ok(Ends { from: near(Limit::Right)?, to: near(Limit::Left)? })
    }
}

fn double(time: &Rational) -> f64 {
    Ball::from_rational(time, FIRST_BITS).to_double().0
}

struct Sampler<'a> {
    function: &'a dyn Piecewise,
    ends: Vec<Ends>,
}

impl Sampler<'_> {
    /// The point at a share of a stretch; at its ends the limits from within.
    fn point(&self, stretch: usize, share: f64) -> Result<Point, EvaluateError> {
        let Ends { from, to } = &self.ends[stretch];
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
            if bound > 1e-12 * value.abs().max(1e-60) && bound < 1e-30 && ball.contains_zero() {
                return Ok(Attempt::Done(0.0));
            }
            Ok::<_, EvaluateError>(Attempt::of(value, bound <= 1e-12 * value.abs().max(1e-60)))
        };
        let value = Precisions::doubling(FIRST_BITS, MAX_BITS).raise(attempt)?.best();
        Ok((double(&time), value, share))
    }

    fn coarse(&self, stretch: usize, window: f64) -> Result<Vec<Point>, EvaluateError> {
        let Ends { from, to } = &self.ends[stretch];
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
