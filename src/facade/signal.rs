//! Signals by name: what can be asked of a wave or an observable.

use super::{Curve, proven};
use crate::answer::{Accuracy, Doubles, Method, Tolerance};
use crate::ball::Value;
use crate::error::Error;
use crate::limits::{SEARCH_BITS, VALUE_BITS};
use crate::planner::Purpose;
use crate::problem::{Digits, Given, Problem, Undecided, Wanted};
use crate::signal::{
    Certified, Compiled, Evaluator as _, Extremum, Goal, Limit, Roots, Search, Signal as Analytic,
    reaching_a_double,
};
use std::ops::RangeInclusive;
use wavestep_polynomial::Rational;

/// Digits that tell to which double a value rounds, unless it was made to lie between two.
const DIGITS_OF_DOUBLE: usize = 40;

/// A wave or an observable as a function of time `t ≥ 0`, analytic between breaks.
///
/// Times and values are plain numbers, or in SI units where the scene has units; times as text name their unit
/// there, `120 us`. Answers are proven: digits
/// are correctly rounded, no root is missed. Only [`values_by`](Signal::values_by) computes with a method
/// that may have no proof; [`Doubles::bound`] tells.
///
/// ```
/// use wavestep::{Goal, Problem};
///
/// let mass = Problem::builtin("rigid-mass")?.with("mu", 1)?;
/// let strain = mass.signal("strain_impact")?;
/// assert_eq!(strain.at("1/2", 10)?.to_string(), "-0.6065306597"); // -exp(-1/2)
/// assert_eq!(strain.roots(2..=4, 15)?.all.len(), 2);
/// assert_eq!(strain.extremum(Goal::Smallest, 0..=4, 15)?.value.to_f64(), -2.135335283236613);
/// # Ok::<(), wavestep::Error>(())
/// ```
pub struct Signal<'p> {
    pub(super) problem: &'p Problem,
    pub(super) wanted: Wanted,
}

impl Signal<'_> {
    /// The name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.wanted.name
    }

    /// The unit of its values, empty for plain numbers.
    #[must_use]
    pub fn unit(&self) -> String {
        self.wanted.unit()
    }

    /// The value at a time: exactly where it is rational, else correctly rounded to so many significant
    /// digits; the limit from later times where it jumps.
    ///
    /// ```
    /// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
    /// assert_eq!(mass.signal("velocity")?.at("3/2", 20)?.to_string(), "0.22313016014842982893"); // exp(-3/2)
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// A time before the start; zero digits, or more than [`MAX_DIGITS`](crate::limits::MAX_DIGITS); a symbol
    /// without a value.
    ///
    /// # Cost
    /// The waves are solved until that time: after `n` periods about `n²` operations on numbers with so
    /// many digits, or `n³` where contacts open.
    pub fn at(&self, time: impl Into<Given>, digits: usize) -> Result<Value, Error> {
        self.limit(time.into(), Limit::Right, digits)
    }

    /// The limit from earlier times; zero at the start.
    ///
    /// ```
    /// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
    /// let strain = mass.signal("strain_fixed")?; // a front arrives at 1
    /// assert_eq!((strain.before(1, 9)?.to_f64(), strain.at(1, 9)?.to_f64()), (0.0, -2.0));
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`at`](Signal::at).
    pub fn before(&self, time: impl Into<Given>, digits: usize) -> Result<Value, Error> {
        self.limit(time.into(), Limit::Left, digits)
    }

    fn limit(&self, time: Given, limit: Limit, digits: usize) -> Result<Value, Error> {
        let times = [self.problem.time("time", time)?];
        let value = |count| {
            let digits = Digits {
                count,
                max_bits: VALUE_BITS,
                limit,
                count_echoes: false,
                undecided: Undecided::Refused,
            };
            let found = self.problem.proven(&self.wanted, &times, digits, &|| ());
            found.map(|mut found| found.values.remove(0))
        };
        let told = value(proven(digits)?)?;
        if let Value::Certified { decimal, ball } = &told
            && ball.rounded().is_none()
            && let Ok(Value::Certified { ball, .. }) = value(digits.max(DIGITS_OF_DOUBLE))
        {
            return Ok(Value::Certified { decimal: decimal.clone(), ball });
        }
        Ok(told)
    }

    /// Values in doubles at many times, by the cheapest method that is proven to keep a tolerance.
    ///
    /// ```
    /// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
    /// let times: Vec<f64> = (0..1000).map(|i| f64::from(i) / 100.0).collect();
    /// let found = mass.signal("velocity")?.values(&times, "1e-12".parse()?)?;
    /// assert!((found.values[150] - (-1.5_f64).exp()).abs() < 1e-12);
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`at`](Signal::at); also where no double is near enough.
    ///
    /// # Cost
    /// Each call compiles a window of its own, in about a second after a thousand periods; then a few
    /// nanoseconds a value. Pass all times together.
    pub fn values<T: Clone + Into<Given>>(
        &self,
        times: &[T],
        tolerance: Tolerance,
    ) -> Result<Doubles, Error> {
        self.doubles(times, Accuracy::Within(tolerance))
    }

    /// Values in doubles by a method or a model of one's choice.
    ///
    /// ```
    /// use wavestep::{Method, Problem};
    ///
    /// let contact = Problem::builtin("local-contact")?;
    /// let name = contact.observables()[0];
    /// let found = contact.signal(name)?.values_by(&[1, 2], Method::Steps { tolerance: 1e-10 })?;
    /// assert_eq!((found.values.len(), found.bound), (2, None)); // tested, not proven
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`at`](Signal::at); also where the method does not suit the problem.
    pub fn values_by<T: Clone + Into<Given>>(
        &self,
        times: &[T],
        method: Method,
    ) -> Result<Doubles, Error> {
        self.doubles(times, Accuracy::Method(method, None))
    }

    /// The doubles nearest to the values at many times, written into a slice: what [`values_by`](Signal::values_by)
    /// gives with [`Method::Certified`], without numbers between.
    ///
    /// ```
    /// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
    /// let mut values = [0.0; 2];
    /// mass.signal("velocity")?.rounded(&[0.0, 1.5], &mut values)?;
    /// assert_eq!(values, [1.0, 0.22313016014842982]); // exp(-3/2)
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`at`](Signal::at).
    ///
    /// # Panics
    /// Where there are not as many times as places for values.
    pub fn rounded(&self, times: &[f64], values: &mut [f64]) -> Result<(), Error> {
        let Some(window) = self.spanned(times)? else { return Ok(()) };
        let signal =
            self.problem.signal_on(&self.wanted, window.each_ref(), Purpose::Polynomials)?;
        Ok(Certified::new(&*signal)?.values(times, values)?)
    }

    /// The first and the last of some times; none where there are none.
    fn spanned(&self, times: &[f64]) -> Result<Option<[Rational; 2]>, Error> {
        let strange = times.iter().find(|time| !time.is_finite());
        let first = strange.copied().or_else(|| times.iter().copied().reduce(f64::min));
        let (Some(first), Some(last)) = (first, times.iter().copied().reduce(f64::max)) else {
            return Ok(None);
        };
        let window = [self.problem.time("time", first)?, self.problem.time("time", last)?];
        Ok(Some(reaching_a_double(window)))
    }

    /// A window made ready once for values in doubles at any of its times, with one proven bound: a quarter of a
    /// tolerance, or some units in the last place of the largest value where none is given or that is larger.
    ///
    /// ```
    /// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
    /// let curve = mass.signal("velocity")?.compiled(0..=10, None)?;
    /// let mut values = [0.0; 2];
    /// curve.values(&[0.5, 1.5], &mut values)?;
    /// assert!((values[1] - (-1.5_f64).exp()).abs() <= curve.bound() + f64::EPSILON);
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`roots`](Signal::roots).
    ///
    /// # Cost
    /// About a second for a thousand periods; a value then takes some nanoseconds.
    pub fn compiled<T: Into<Given>>(
        &self,
        window: RangeInclusive<T>,
        tolerance: Option<Tolerance>,
    ) -> Result<Curve, Error> {
        let (from, to) = window.into_inner();
        let window =
            self.problem.between(self.problem.time("from", from)?, self.problem.time("to", to)?)?;
        let question = self.problem.question_for(self.name(), window, Purpose::Polynomials)?;
        let signal = &*question.signal;
        let tolerance = match tolerance {
            Some(Tolerance::Absolute(tolerance)) => Some(tolerance),
            Some(tolerance) => Some(tolerance.absolute(question.scale()?)),
            None => None,
        };
        Ok(Curve::new(Compiled::new(signal, tolerance)?))
    }

    fn doubles<T: Clone + Into<Given>>(
        &self,
        times: &[T],
        accuracy: Accuracy,
    ) -> Result<Doubles, Error> {
        let time = |time: &T| self.problem.time("time", time.clone());
        let times = times.iter().map(time).collect::<Result<Vec<Rational>, _>>()?;
        Ok(self.problem.doubles(self.name(), &times, Limit::Right, accuracy)?)
    }

    /// All times of a window at which the signal is zero, or jumps over zero, with proof that there are no
    /// others; those with so many digits.
    ///
    /// ```
    /// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
    /// let found = mass.signal("strain_impact")?.roots(2..=4, 12)?;
    /// assert_eq!(found.all.len(), 2); // the mass leaves the bar, and a front strikes it again
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`at`](Signal::at); an empty window; more than [`MAX_ROOTS`](crate::limits::MAX_ROOTS).
    ///
    /// # Cost
    /// A few tens of polynomials with 20 to 64 terms for each stretch between breaks and for each root.
    pub fn roots<T: Into<Given>>(
        &self,
        window: RangeInclusive<T>,
        digits: usize,
    ) -> Result<Roots, Error> {
        self.crossings(Rational::default(), window, digits)
    }

    /// The same for a level instead of zero.
    ///
    /// ```
    /// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
    /// let found = mass.signal("velocity")?.crossings("1/2", 0..=2, 12)?;
    /// let wavestep::Root::Simple { time, rises: false } = &found.all[0] else { panic!() };
    /// assert_eq!(time.to_string(), "0.693147180560"); // ln 2
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`roots`](Signal::roots).
    pub fn crossings<T: Into<Given>>(
        &self,
        level: impl Into<Given>,
        window: RangeInclusive<T>,
        digits: usize,
    ) -> Result<Roots, Error> {
        let digits = proven(digits)?;
        let level = self.problem.quantity("level", level, self.wanted.dimension)?;
        self.on(window, |signal| Ok(Search::new(signal)?.roots(&level, digits, SEARCH_BITS)?))
    }

    /// The largest or smallest value on a window, both ends included, with all places where it is taken.
    ///
    /// ```
    /// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
    /// let least = mass.signal("strain_fixed")?.extremum(wavestep::Goal::Smallest, 0..=4, 9)?;
    /// assert_eq!((least.value.to_string(), least.places.len()), ("-2.27067057".into(), 1));
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`roots`](Signal::roots).
    ///
    /// # Cost
    /// As [`roots`](Signal::roots).
    pub fn extremum<T: Into<Given>>(
        &self,
        goal: Goal,
        window: RangeInclusive<T>,
        digits: usize,
    ) -> Result<Extremum, Error> {
        let digits = proven(digits)?;
        self.on(window, |signal| Ok(Search::new(signal)?.extremum(goal, digits, SEARCH_BITS)?))
    }

    /// The times within a window at which the signal may jump or bend, in order: it is analytic between.
    ///
    /// ```
    /// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
    /// let breaks = mass.signal("strain_fixed")?.breaks(0..=6, 9)?;
    /// let times: Vec<f64> = breaks.iter().map(|time| time.to_f64()).collect();
    /// assert_eq!(times, [1.0, 3.0, 5.0]);
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`roots`](Signal::roots).
    pub fn breaks<T: Into<Given>>(
        &self,
        window: RangeInclusive<T>,
        digits: usize,
    ) -> Result<Vec<Value>, Error> {
        let digits = proven(digits)?;
        self.on(window, |signal| {
            let start = |stretch| match signal.exact_time(stretch, Limit::Right) {
                Some(time) => Ok(Value::Exact(time)),
                None => Value::certify(digits, VALUE_BITS, |bits| {
                    signal.time(stretch, Limit::Right, bits)
                }),
            };
            Ok((1..signal.count()?).map(start).collect::<Result<_, _>>()?)
        })
    }

    /// Asks the signal on a window, cut into stretches.
    fn on<T: Into<Given>, R>(
        &self,
        times: RangeInclusive<T>,
        ask: impl FnOnce(&dyn Analytic) -> Result<R, Error>,
    ) -> Result<R, Error> {
        let (from, to) = times.into_inner();
        let problem = &self.problem;
        let window = problem.between(problem.time("from", from)?, problem.time("to", to)?)?;
        let signal = self.problem.signal_on(&self.wanted, window.each_ref(), Purpose::Search)?;
        ask(&*signal)
    }
}
