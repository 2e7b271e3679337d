//! Observables as functions of time: where they are smooth, and enclosures there.
//!
//! Between two arrivals an observable is one exponential polynomial. On a grid it is made of one piece
//! of each wave that is seen; on a lattice of all echoes that have arrived. Either way it can be
//! enclosed at a time, and expanded about a time with a proven remainder: what tables of polynomials,
//! roots and largest values are made from.

use crate::ball::{Ball, ComplexBall, Magnitude};
use crate::enclosure::{EnclosureError, Numbers, real_part};
use crate::evaluate::cells::first_double;
use crate::evaluate::evaluator::{EvaluateError, Side};
use crate::evaluate::periods::Periods;
use crate::evaluate::scene::{Echoes, MAX_ECHOES, SceneEvaluator, solve_in, whole_periods};
use crate::evaluate::taylor::Taylor;
use crate::evaluate::transforms::value_at;
use crate::expression::{Field as _, Fraction, Root, Transform};
use crate::network::{Network, Observed, ObservedValue, Unfolded};
use crate::recurrence::{Observation, ObservedWave, Recurrence};
use crate::solution::Demand;
use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// The most periods whose pieces are held: their coefficients grow with the square of that.
///
/// ```
/// use wavestep::evaluate::{EvaluateError, MAX_PIECES, Signal};
/// use wavestep::language::{Source, parse_number, read_recurrence};
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = [("mu".to_owned(), parse_number("1/2")?)].into();
/// let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &values)?;
/// let signal = Signal::of_recurrence(&recurrence, &recurrence.observation("f").unwrap()).unwrap();
/// let late = parse_number(&format!("{MAX_PIECES} + 2"))?;
/// let stretches = signal.stretches(&(&late - parse_number("1/2")?), &late).unwrap();
/// let refused = signal.enclose(&stretches[0], 0, stretches[0].from(), 64);
/// assert!(matches!(refused, Err(EvaluateError::TooManyEchoes { limit: MAX_PIECES, .. })));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub const MAX_PIECES: usize = 2_000;

/// The most stretches between arrivals of one window.
const MAX_STRETCHES: usize = 200_000;

/// The most periods that are counted.
const MAX_ORDER: usize = 1_000_000_000;

/// At how many precisions the waves are held at once.
const MAX_PRECISIONS: usize = 3;

/// An observable with numbers in place of all symbols, as a function of the user's time.
///
/// ```
/// use wavestep::evaluate::{Side, Signal};
/// use wavestep::expression::Fraction;
/// use wavestep::language::{Source, parse_number, read_recurrence};
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = [("mu".to_owned(), parse_number("1")?)].into();
/// let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &values)?;
/// let signal = Signal::of_recurrence(&recurrence, &recurrence.observation("f").unwrap()).unwrap();
/// assert_eq!(signal.recurrence().statement().period.to_string(), "2");
/// assert_eq!(signal.observation().waves.len(), 1);
/// assert!(signal.is_on_grid() && *signal.slowness() == Fraction::one());
/// assert_eq!(signal.period(), Some(2.0));
///
/// let (from, to) = (parse_number("0")?, parse_number("6")?);
/// assert_eq!(signal.arrivals(&from, &to).unwrap(), [2.0, 4.0, 6.0]);
/// assert_eq!(signal.order(&to), Ok(3));
/// // One stretch for each arrival, the one at 0 included.
/// let stretches = signal.stretches(&from, &to).unwrap();
/// assert_eq!(stretches.len(), 4);
/// let two = parse_number("2")?;
/// assert_eq!(signal.stretch_at(&stretches, &two, Side::Left), Ok(0));
/// assert_eq!(signal.stretch_at(&stretches, &two, Side::Right), Ok(1));
/// // On the first one f = e^{−t}, whose derivative is −f; at 2 it rises by 1.
/// let at = |stretch: usize, derivative, t: &str| {
///     let time = signal.slowness().scale(&parse_number(t).unwrap());
///     signal.enclose(&stretches[stretch], derivative, &time, 128).unwrap()
/// };
/// assert_eq!(at(0, 0, "1").rounded(), Some(0.36787944117144233));
/// assert_eq!(at(0, 1, "1").rounded(), Some(-0.36787944117144233));
/// assert!(at(1, 0, "2").subtract(&at(0, 0, "2"), 128).contains(&parse_number("1")?));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
///
/// The observables of a scene are signals too:
///
/// ```
/// use wavestep::evaluate::Signal;
/// use wavestep::language::{Source, parse_number, read_scene};
/// use wavestep::network::Network;
///
/// let text = wavestep::scenes::find("mass-on-fixed-bar").unwrap().text;
/// let values = [("mu".to_owned(), parse_number("1")?)].into();
/// let scene = read_scene(&Source::new("mass-on-fixed-bar", text)?, &values).unwrap();
/// let network = Network::new(&scene).unwrap();
/// let (from, to) = (parse_number("0")?, parse_number("6")?);
/// let signal = |place: usize| Signal::of_scene(&network, &network.observables()[place], &to);
/// // The front reaches the far end at 1, and again every 2.
/// assert_eq!(signal(2).unwrap().arrivals(&from, &to).unwrap(), [1.0, 3.0, 5.0]);
/// let error = signal(4).err().unwrap();
/// assert!(error.to_string().contains("energy"), "{error}");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub struct Signal {
    recurrence: Recurrence,
    observation: Observation,
    /// What 1 in the scale of the waves is.
    unit: Root,
    /// Time in the scale of the waves for one unit of the user's.
    slowness: Fraction,
    numbers: Rc<Numbers>,
    /// The echoes, where arrivals lie on no grid.
    lattice: Option<Scattered>,
    /// The waves, by bits.
    solved: RefCell<BTreeMap<u64, Rc<RefCell<Solved>>>>,
}

/// Echoes on a lattice of several periods.
struct Scattered {
    unfolded: Unfolded,
    /// By number, with their delays.
    arrivals: Vec<(usize, Fraction)>,
    /// Until when they are known.
    last: Fraction,
}

/// The waves, in balls.
enum Solved {
    Periods(Box<Periods>),
    Echoes(Rc<Echoes>),
}

/// A part of a signal: a piece of a wave, or an echo.
#[derive(Clone, Debug)]
struct Part {
    /// Which of the waves that are seen.
    seen: usize,
    /// The period, or the number of the echo.
    number: usize,
    /// When it began, in the scale of the waves.
    origin: Fraction,
}

/// A time between arrivals, on which a signal is one exponential polynomial.
///
/// ```
/// # use wavestep::evaluate::Signal;
/// # use wavestep::language::{Source, parse_number, read_recurrence};
/// # let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// # let values = [("mu".to_owned(), parse_number("1")?)].into();
/// # let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &values)?;
/// # let signal = Signal::of_recurrence(&recurrence, &recurrence.observation("strain_fixed").unwrap()).unwrap();
/// # let (from, to) = (parse_number("0")?, parse_number("6")?);
/// let stretches = signal.stretches(&from, &to).unwrap();
/// // The far end is at rest until the front is there, at 1.
/// assert!(stretches[0].from().is_zero() && stretches[0].to().to_string() == "1");
/// let silent: Vec<bool> = stretches.iter().map(|stretch| stretch.from().is_zero()).collect();
/// assert_eq!(silent, [true, false, false, false]);
/// // Each begins where the one before it ends.
/// assert!(stretches.windows(2).all(|pair| pair[0].to() == pair[1].from()));
/// // Time has begun on all of them; before 0 there is nothing.
/// let before = signal.stretches(&parse_number("-1")?, &to).unwrap();
/// assert!(before[0].is_silent() && !stretches[0].is_silent());
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug)]
pub struct Stretch {
    /// Its first time, in the scale of the waves.
    from: Fraction,
    /// Its end: the next arrival, or the end of the window.
    to: Fraction,
    parts: Vec<Part>,
    /// Whether time has begun.
    begun: bool,
}

/// An arrival: which of the waves seen, the number of the piece or echo, and when.
type Break = (Option<usize>, usize, Fraction);

impl Signal {
    /// A wave or observable of a recurrence without symbols.
    ///
    /// # Errors
    /// [`EvaluateError::MissingValue`] where a symbol is left.
    pub fn of_recurrence(
        recurrence: &Recurrence,
        observation: &Observation,
    ) -> Result<Signal, EvaluateError> {
        Signal::on_grid(recurrence, observation, Root::from(Fraction::one()), Fraction::one())
    }

    /// An observable of a scene, for times up to `last`; on a grid this may be any.
    ///
    /// # Errors
    /// [`EvaluateError`] where a symbol has no value or too many echoes arrive;
    /// [`EvaluateError::NotLinear`] for energies.
    pub fn of_scene(
        network: &Network,
        observed: &Observed,
        last: &Rational,
    ) -> Result<Signal, EvaluateError> {
        let ObservedValue::Linear(observation) = &observed.value else {
            return Err(EvaluateError::NotLinear(observed.name.clone()));
        };
        let (unit, slowness) = (observed.unit.clone(), network.model().slowness.clone());
        if network.lattice().periods().len() == 1 {
            let recurrence = network.recurrence()?;
            return Signal::on_grid(&recurrence, observation, unit, slowness);
        }
        let last = slowness.scale(last);
        let evaluator = SceneEvaluator::new(network, &last)?;
        let (unfolded, arrivals) = evaluator.into_parts();
        let signal = Signal::on_grid(unfolded.recurrence(), observation, unit, slowness)?;
        Ok(Signal { lattice: Some(Scattered { unfolded, arrivals, last }), ..signal })
    }

    fn on_grid(
        recurrence: &Recurrence,
        observation: &Observation,
        unit: Root,
        slowness: Fraction,
    ) -> Result<Signal, EvaluateError> {
        if let Some(symbol) = recurrence.symbols().next() {
            return Err(EvaluateError::MissingValue(symbol.clone()));
        }
        Ok(Signal {
            numbers: Rc::new(Numbers::new(recurrence.constants())),
            recurrence: recurrence.clone(),
            observation: observation.clone(),
            unit,
            slowness,
            lattice: None,
            solved: RefCell::default(),
        })
    }

    /// The recurrence of the waves that are seen.
    pub fn recurrence(&self) -> &Recurrence {
        &self.recurrence
    }

    /// What is seen of them.
    pub fn observation(&self) -> &Observation {
        &self.observation
    }

    /// The numbers of its constants.
    pub(crate) fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    /// What 1 in the scale of the waves is.
    pub(crate) fn unit(&self) -> &Root {
        &self.unit
    }

    /// Time in the scale of the waves for one unit of the user's.
    pub fn slowness(&self) -> &Fraction {
        &self.slowness
    }

    /// The length of a period in the user's time, near it; `None` on a lattice.
    pub fn period(&self) -> Option<f64> {
        let period = self.numbers.enclose(&self.recurrence.statement().period, 128).ok()?;
        let slowness = self.numbers.enclose(&self.slowness, 128).ok()?;
        let inverse = slowness.reciprocal(128).ok()?;
        self.is_on_grid().then(|| period.multiply(&inverse, 128).to_double().0)
    }

    /// The smallest doubles that are not before the arrivals within a window, its ends apart.
    ///
    /// # Errors
    /// As [`Signal::stretches`].
    pub fn arrivals(&self, from: &Rational, to: &Rational) -> Result<Vec<f64>, EvaluateError> {
        let stretches = self.stretches(from, to)?;
        stretches.iter().skip(1).map(|stretch| first_double(self, &stretch.from)).collect()
    }

    /// Whether unit and time are those of the waves, but for rational factors.
    pub(crate) fn is_rational(&self) -> bool {
        let unit = self.unit.exact().and_then(|unit| unit.as_constant());
        unit.is_some() && self.slowness.as_constant().is_some()
    }

    /// Whether arrivals lie on one grid, so that pieces follow from earlier ones.
    pub fn is_on_grid(&self) -> bool {
        self.lattice.is_none()
    }

    /// How many periods have begun at a time, or one more; on a lattice, how many echoes can have
    /// arrived.
    ///
    /// # Errors
    /// [`EvaluateError::TooManyEchoes`] beyond a thousand million.
    pub fn order(&self, at: &Rational) -> Result<usize, EvaluateError> {
        let at = self.slowness.scale(at);
        match &self.lattice {
            None => {
                // A wave may be seen before its own clock.
                let period = &self.recurrence.statement().period;
                let mut order = whole_periods(&self.numbers, &at, period, MAX_ORDER)?;
                for seen in &self.observation.waves {
                    let since = &at - &seen.delay;
                    order = order.max(whole_periods(&self.numbers, &since, period, MAX_ORDER)?);
                }
                Ok(order)
            }
            Some(lattice) => Ok(lattice.arrivals.len()),
        }
    }

    /// The arrivals after `from`, up to `to`, ascending, and those that are there at `from`.
    fn breaks(
        &self,
        from: &Fraction,
        to: &Fraction,
    ) -> Result<(Vec<Break>, Vec<Break>), EvaluateError> {
        let mut before = Vec::new();
        let mut after = Vec::new();
        let mut place = |found: Break| -> Result<bool, EvaluateError> {
            if self.numbers.compare(&found.2, to)? == Ordering::Greater {
                return Ok(false);
            }
            match self.numbers.compare(&found.2, from)? {
                Ordering::Greater => after.push(found),
                _ => before.push(found),
            }
            Ok(true)
        };
        place((None, 0, Fraction::zero()))?;
        let period = &self.recurrence.statement().period;
        for (seen, wave) in self.observation.waves.iter().enumerate() {
            match &self.lattice {
                None => {
                    // The last piece that is there at `from` is the only one that still counts.
                    let first =
                        whole_periods(&self.numbers, &(from - &wave.delay), period, MAX_ECHOES)?
                            .max(1)
                            - 1;
                    for n in first.. {
                        let delay = period.scale(&Rational::from_integer(n.into()));
                        if n > MAX_ECHOES {
                            let (echoes, limit) = (n as u128, MAX_ECHOES);
                            return Err(EvaluateError::TooManyEchoes { echoes, limit });
                        }
                        if !place((Some(seen), n, &delay + &wave.delay))? {
                            break;
                        }
                    }
                }
                Some(lattice) => {
                    for (number, delay) in &lattice.arrivals {
                        place((Some(seen), *number, delay + &wave.delay))?;
                    }
                }
            }
        }
        if after.len() > MAX_STRETCHES {
            let (echoes, limit) = (after.len() as u128, MAX_STRETCHES);
            return Err(EvaluateError::TooManyEchoes { echoes, limit });
        }
        Ok((before, sorted(after, &self.numbers)?))
    }

    /// The stretches of a window in the user's time, in order.
    ///
    /// # Errors
    /// [`EvaluateError`] where the order of two arrivals cannot be told, or there are too many.
    pub fn stretches(&self, from: &Rational, to: &Rational) -> Result<Vec<Stretch>, EvaluateError> {
        let (from, to) = (self.slowness.scale(from), self.slowness.scale(to));
        if let Some(lattice) = &self.lattice
            && self.numbers.compare(&to, &lattice.last)? == Ordering::Greater
        {
            return Err(EvaluateError::AfterLast);
        }
        let (before, after) = self.breaks(&from, &to)?;
        let mut now = Stretch { from, to: to.clone(), parts: Vec::new(), begun: false };
        before.into_iter().for_each(|found| self.arrive(&mut now, found));
        let mut stretches = Vec::new();
        for found in after {
            if self.numbers.compare(&found.2, &now.from)? == Ordering::Greater {
                stretches.push(Stretch { to: found.2.clone(), ..now.clone() });
                now.from = found.2.clone();
            }
            self.arrive(&mut now, found);
        }
        stretches.push(now);
        Ok(stretches)
    }

    /// What has arrived is seen from now on: on a grid in place of the piece before it.
    fn arrive(&self, stretch: &mut Stretch, (seen, number, origin): Break) {
        let Some(seen) = seen else {
            stretch.begun = true;
            return;
        };
        let part = Part { seen, number, origin };
        match stretch.parts.iter_mut().find(|known| self.is_on_grid() && known.seen == seen) {
            Some(known) => *known = part,
            None => stretch.parts.push(part),
        }
    }

    fn solved(&self, bits: u64) -> Result<Rc<RefCell<Solved>>, EvaluateError> {
        if let Some(known) = self.solved.borrow().get(&bits) {
            return Ok(known.clone());
        }
        let solved = match &self.lattice {
            None => Solved::Periods(Box::new(Periods::new(
                &self.recurrence,
                self.numbers.clone(),
                bits,
            )?)),
            Some(lattice) => {
                let demand = self.demand(&lattice.arrivals);
                let (echoes, _) = solve_in(&self.recurrence, self.numbers.field(bits), demand)?;
                Solved::Echoes(Rc::new(echoes))
            }
        };
        let solved = Rc::new(RefCell::new(solved));
        let mut known = self.solved.borrow_mut();
        // With more bits wanted, those with few have done their work.
        while known.len() >= MAX_PRECISIONS {
            known.pop_first();
        }
        known.insert(bits, solved.clone());
        Ok(solved)
    }

    /// The echoes that are there until a time, by wave and number, with their numbers and delays.
    ///
    /// # Errors
    /// [`EvaluateError::TooManyEchoes`] beyond `limit`.
    pub(crate) fn echoes(
        &self,
        to: &Rational,
        limit: usize,
        bits: u64,
    ) -> Result<(Echoes, Vec<(usize, Fraction)>), EvaluateError> {
        let order = self.order(to)?;
        if order > limit {
            return Err(EvaluateError::TooManyEchoes { echoes: order as u128, limit });
        }
        let arrivals = match &self.lattice {
            Some(lattice) => lattice.arrivals.clone(),
            None => {
                let period = &self.recurrence.statement().period;
                let delay = |k: usize| period.scale(&Rational::from_integer(k.into()));
                (0..=order).map(|k| (k, delay(k))).collect()
            }
        };
        let (echoes, _) =
            solve_in(&self.recurrence, self.numbers.field(bits), self.demand(&arrivals))?;
        Ok((echoes, arrivals))
    }

    /// The echoes that are needed for those of the waves that are seen.
    fn demand(&self, arrivals: &[(usize, Fraction)]) -> Demand {
        let mut demand = Demand::none(&self.recurrence);
        let exists = |k| self.lattice.as_ref().is_none_or(|l| l.unfolded.counts(k).is_some());
        for seen in &self.observation.waves {
            for (number, _) in arrivals {
                demand.add_where(&self.recurrence, seen.wave, *number, exists);
            }
        }
        demand
    }

    /// The function of a part, in the time since its origin.
    fn function(
        &self,
        part: &Part,
        bits: u64,
    ) -> Result<Rc<Transform<ComplexBall>>, EvaluateError> {
        self.piece(part.seen, part.number, bits)
    }

    /// A piece, or on a lattice an echo, of one of the waves that are seen, in the time since it began.
    pub(crate) fn piece(
        &self,
        seen: usize,
        number: usize,
        bits: u64,
    ) -> Result<Rc<Transform<ComplexBall>>, EvaluateError> {
        let solved = self.solved(bits)?;
        let wave = self.observation.waves[seen].wave;
        match &mut *solved.borrow_mut() {
            Solved::Periods(periods) => {
                if number > MAX_PIECES {
                    let (echoes, limit) = (number as u128, MAX_PIECES);
                    return Err(EvaluateError::TooManyEchoes { echoes, limit });
                }
                periods.advance_to(number)?;
                Ok(periods.piece(wave, number).clone())
            }
            Solved::Echoes(echoes) => Ok(Rc::new(echoes[wave][number].clone())),
        }
    }

    /// On a lattice, the echoes that can arrive: their numbers and delays.
    pub(crate) fn scattered(&self) -> Option<&[(usize, Fraction)]> {
        self.lattice.as_ref().map(|lattice| &lattice.arrivals[..])
    }

    /// Calls `add` with the functions that make up the signal on a stretch: each with its coefficient,
    /// in the time since an origin, differentiated so many times.
    fn for_each_function(
        &self,
        stretch: &Stretch,
        derivative: usize,
        bits: u64,
        mut add: impl FnMut(
            &Transform<ComplexBall>,
            &Fraction,
            &ComplexBall,
        ) -> Result<(), EvaluateError>,
    ) -> Result<(), EvaluateError> {
        let field = self.numbers.field(bits);
        let unit = ComplexBall::from(self.numbers.enclose_root(&self.unit, bits)?);
        for part in &stretch.parts {
            let ObservedWave { coefficient, slope, .. } = &self.observation.waves[part.seen];
            let coefficient = field.embed(coefficient)?.multiply(&unit, bits);
            let function = self.function(part, bits)?;
            if function.is_zero() {
                continue;
            }
            match derivative + usize::from(*slope) {
                0 => add(&function, &part.origin, &coefficient)?,
                times => {
                    let mut slope = function.differentiated(&field)?;
                    for _ in 1..times {
                        slope = slope.differentiated(&field)?;
                    }
                    add(&slope, &part.origin, &coefficient)?;
                }
            }
        }
        let forcing = &self.observation.forcing;
        if stretch.begun && !forcing.is_zero() {
            let exact = Transform::of(forcing, &self.recurrence.statement().time);
            let mut function = Transform::<ComplexBall>::embedded(&exact, &field)?;
            for _ in 0..derivative {
                function = function.differentiated(&field)?;
            }
            add(&function, &Fraction::zero(), &unit)?;
        }
        Ok(())
    }

    /// An enclosure of the signal, or of a derivative with respect to the user's time, at a time of a
    /// stretch or at one of its ends.
    ///
    /// # Errors
    /// [`EvaluateError`] where a constant cannot be enclosed.
    pub fn enclose(
        &self,
        stretch: &Stretch,
        derivative: usize,
        at: &Fraction,
        bits: u64,
    ) -> Result<Ball, EvaluateError> {
        let field = self.numbers.field(bits);
        let mut sum = ComplexBall::zero();
        self.for_each_function(stretch, derivative, bits, |function, origin, coefficient| {
            let x = field.embed(&(at - origin).into())?;
            let value = value_at(function, &x, &self.numbers, bits)?;
            sum = sum.add(&value.multiply(coefficient, bits), bits);
            Ok(())
        })?;
        let value = real_part(sum)?;
        self.times_slowness(value, derivative, bits)
    }

    fn times_slowness(
        &self,
        mut value: Ball,
        times: usize,
        bits: u64,
    ) -> Result<Ball, EvaluateError> {
        for _ in 0..times {
            value = value.multiply(&self.numbers.enclose(&self.slowness, bits)?, bits);
        }
        Ok(value)
    }

    /// The signal, or a derivative with respect to the user's time, about `centre`, in
    /// `u = (t − centre)/half`: what it is on the stretch, and beyond that what it would be without
    /// further arrivals.
    pub(crate) fn taylor(
        &self,
        stretch: &Stretch,
        derivative: usize,
        (centre, half): (&Rational, &Rational),
        terms: usize,
        bits: u64,
    ) -> Result<Taylor, EvaluateError> {
        let field = self.numbers.field(bits);
        let h = field.embed(&self.slowness.scale(half).into())?;
        let at = self.slowness.scale(centre);
        let mut sum = Taylor::<ComplexBall>::zero(terms);
        self.for_each_function(stretch, derivative, bits, |function, origin, coefficient| {
            let x = field.embed(&(&at - origin).into())?;
            let part = Taylor::of(function, &x, &h, terms, &self.numbers, bits)?;
            sum.add_scaled(&part, coefficient, bits);
            Ok(())
        })?;
        let sum = sum.real()?;
        match derivative {
            0 => Ok(sum),
            times => {
                let one = Ball::from_integer(&1.into());
                Ok(sum.scaled(&self.times_slowness(one, times, bits)?, bits))
            }
        }
    }

    /// Stretches joined where all that arrives is identically zero, so that nothing changes.
    pub(crate) fn audible(
        &self,
        stretches: Vec<Stretch>,
        bits: u64,
    ) -> Result<Vec<Stretch>, EvaluateError> {
        let mut joined: Vec<Stretch> = Vec::new();
        for stretch in stretches {
            let Some(last) = joined.last_mut() else {
                joined.push(stretch);
                continue;
            };
            // On a lattice parts are added to those that are there.
            let mut goes_on = !self.is_on_grid() && last.begun == stretch.begun;
            for part in stretch.parts.iter().skip(last.parts.len()) {
                goes_on = goes_on && self.function(part, bits)?.is_zero();
            }
            match goes_on {
                true => *last = Stretch { from: last.from.clone(), ..stretch },
                false => joined.push(stretch),
            }
        }
        Ok(joined)
    }

    /// About the sum of the absolute values of all that a derivative consists of at a time, in the
    /// scale of the waves, and the sum of the radii of their enclosures.
    pub(crate) fn size(
        &self,
        stretch: &Stretch,
        derivative: usize,
        at: &Rational,
        bits: u64,
    ) -> Result<(Magnitude, Magnitude), EvaluateError> {
        let (field, at) = (self.numbers.field(bits), self.slowness.scale(at));
        let (mut size, mut error) = (Magnitude::ZERO, Magnitude::ZERO);
        self.for_each_function(stretch, derivative, bits, |function, origin, coefficient| {
            let x = field.embed(&(&at - origin).into())?;
            let value = value_at(function, &x, &self.numbers, bits)?.multiply(coefficient, bits);
            for part in [value.real(), value.imaginary()] {
                size = size.add(&part.midpoint().magnitude());
                error = error.add(part.radius());
            }
            Ok(())
        })?;
        Ok((size, error))
    }

    /// The rates λ of a stretch, in the scale of the waves, each with a bound on how many
    /// coefficients `c_j` of `Σ_λ e^{λx} Σ_j c_j x^j/j!` the signal has there.
    pub(crate) fn rates(
        &self,
        stretch: &Stretch,
        bits: u64,
    ) -> Result<BTreeMap<Fraction, usize>, EvaluateError> {
        let mut rates: BTreeMap<Fraction, usize> = BTreeMap::new();
        self.for_each_function(stretch, 0, bits, |function, _, _| {
            for (pole, coefficients) in function.poles() {
                let count = rates.entry(pole.clone()).or_default();
                *count = (*count).max(coefficients.len());
            }
            Ok(())
        })?;
        Ok(rates)
    }

    /// The last of the stretches whose first time is at or before a time; on the left side, before it.
    /// The first of them where there is none such.
    ///
    /// # Errors
    /// [`EvaluateError`] where two times cannot be told apart.
    pub fn stretch_at(
        &self,
        stretches: &[Stretch],
        at: &Rational,
        side: Side,
    ) -> Result<usize, EvaluateError> {
        let at = self.slowness.scale(at);
        let (mut low, mut high) = (0, stretches.len());
        while high - low > 1 {
            let middle = low.midpoint(high);
            let order = self.numbers.compare(&stretches[middle].from, &at)?;
            match order == Ordering::Less || (order == Ordering::Equal && side == Side::Right) {
                true => low = middle,
                false => high = middle,
            }
        }
        Ok(low)
    }
}

impl Stretch {
    /// Its first time, in the scale of the waves.
    pub fn from(&self) -> &Fraction {
        &self.from
    }

    /// Its end, in the scale of the waves: the next arrival, or the end of the window.
    pub fn to(&self) -> &Fraction {
        &self.to
    }

    /// Whether nothing is seen on it.
    pub fn is_silent(&self) -> bool {
        self.parts.is_empty() && !self.begun
    }
}

/// Arrivals in order.
fn sorted(mut breaks: Vec<Break>, numbers: &Numbers) -> Result<Vec<Break>, EvaluateError> {
    let mut failed: Option<EnclosureError> = None;
    breaks.sort_by(|left, right| {
        numbers.compare(&left.2, &right.2).unwrap_or_else(|error| {
            failed = Some(error);
            Ordering::Equal
        })
    });
    match failed {
        Some(error) => Err(error.into()),
        None => Ok(breaks),
    }
}
