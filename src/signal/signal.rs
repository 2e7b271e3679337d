//! A real function of time, cut at its breaks: what every consumer asks.

use crate::ball::{Ball, Magnitude};
use crate::expression::{Expression, Fraction, Root};
use crate::signal::closed::ClosedForm;
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::taylor::{Near, Taylor};
use std::cmp::Ordering;
pub use wavestep_kernels::Limit;
use wavestep_polynomial::{Rational, Symbol};

/// How many derivatives that vanish are told.
pub(crate) const MAX_FLATNESS: usize = 8;

/// The precision with which a polynomial is asked for that may have no coefficient.
pub(crate) const STILL_BITS: u64 = 192;

/// How many derivatives of a function, from that of an order on, are zero at a time.
pub(crate) fn zeros_of(
    function: Expression,
    clock: &Symbol,
    at: &Fraction,
    order: usize,
) -> Outcome<usize> {
    let mut slope = (0..order).fold(function, |slope, _| slope.derivative(clock));
    let mut count = 0;
    while count < MAX_FLATNESS && slope.substitute(clock, at)?.is_zero() {
        (slope, count) = (slope.derivative(clock), count + 1);
    }
    Ok(count)
}

/// How much later than a time another one is, as a symbol: a function is asked for beside that time.
pub(crate) fn later() -> Symbol {
    Symbol::new("later_than_a_time").expect("a name")
}

/// Where in a stretch.
#[derive(Clone, Copy)]
pub enum At<'a> {
    /// A time of the user's.
    Time(&'a Rational),
    /// A time in the scale of the scene, which may be no rational number in the user's.
    Scaled(&'a Fraction),
    /// The limit at an end of the stretch: on the right side of its first time, the left of its last.
    End(Limit),
}

/// What is known of a value without enclosures.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Known {
    /// It is this number.
    Rational(Rational),
    /// It is no rational number.
    Irrational,
    /// Exact arithmetic has not told.
    Unknown,
}

impl Known {
    /// What an exact value, where there is one, tells of itself in a unit.
    pub(crate) fn of(value: Option<Expression>, unit: &Root) -> Known {
        let unit = unit.exact().and_then(|unit| unit.as_constant());
        match (value, unit) {
            (Some(value), _) if value.is_zero() => Known::Rational(Rational::default()),
            (Some(value), Some(unit)) => match value.as_constant() {
                Some(value) => Known::Rational(value * unit),
                None => Known::Irrational,
            },
            (Some(_), None) => Known::Irrational,
            (None, _) => Known::Unknown,
        }
    }
}

/// An exact value in a unit, where that is known exactly; zero is zero in any.
pub(crate) fn in_unit(value: Expression, unit: &Root) -> Option<Expression> {
    match unit.exact() {
        Some(unit) => Some(value.times(&unit)),
        None => value.is_zero().then_some(value),
    }
}

/// An exact instant by which breaks of two signals are known as one: those of one scene that are equal
/// are one instant, whatever their enclosures tell.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Instant {
    /// The scene, by its address.
    pub(crate) scene: usize,
    /// The event that it is counted from: its number, which is the same at every precision, and the precision
    /// in bits where ties were decided on the way, 0 elsewhere; `None` for the start.
    pub(crate) event: Option<(u64, usize)>,
    /// The delay since then, in the scale of the scene.
    pub(crate) delay: Fraction,
}

/// The sign that a function has between the ends of a stretch, whatever its enclosures tell: as a contact pushes with a
/// force that is below all precision.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Signed {
    pub sign: Ordering,
    /// Whether it has it at the first time and at the last one, too.
    pub at_ends: [bool; 2],
}

impl Signed {
    /// That of a sum of two functions, where both have the same.
    pub(crate) fn and(self, other: Signed) -> Option<Signed> {
        let at_ends = [0, 1].map(|end| self.at_ends[end] || other.at_ends[end]);
        (self.sign == other.sign).then_some(Signed { at_ends, ..self })
    }

    /// Whether the function has it in the limit at an end.
    pub(crate) fn holds_at(self, end: Limit) -> bool {
        self.at_ends[usize::from(end == Limit::Left)]
    }
}

/// How many echoes there are of a signal.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct EchoCount {
    /// Worked out, and not zero.
    pub expanded: usize,
    /// That can reach what is observed on the window.
    pub arriving: usize,
    /// That are needed: without all others together values are as near as they are to be.
    pub needed: usize,
}

/// How much work an exact form may cost.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Effort {
    /// None to speak of.
    Little,
    /// That of exact echoes, as far as these are worked out at all.
    Much,
}

/// `f(bits)`: an enclosure with about so many bits.
pub(crate) type Enclosure<'a> = Box<dyn Fn(u64) -> Outcome<Ball> + 'a>;

/// One limit of a signal at one time, prepared for enclosures.
pub struct Point<'a> {
    pub(crate) known: Known,
    pub(crate) enclose: Enclosure<'a>,
    /// What exact arithmetic tells at a high cost, where a first look left it open.
    pub(crate) decide: Box<dyn Fn() -> Known + 'a>,
    /// A value below this is suspected to be zero.
    pub(crate) negligible: Magnitude,
    /// More bits than these tell no more, unless the digits themselves need them.
    pub(crate) most_bits: u64,
}

impl<'a> Point<'a> {
    /// A rational value.
    pub(crate) fn exact(value: Rational) -> Point<'a> {
        let ball = value.clone();
        let enclose = move |bits| Ok(Ball::from_rational(&ball, bits));
        Point { known: Known::Rational(value), ..Point::irrational(enclose) }
    }

    /// A value that is no rational number.
    pub(crate) fn irrational(enclose: impl Fn(u64) -> Outcome<Ball> + 'a) -> Point<'a> {
        Point {
            known: Known::Irrational,
            enclose: Box::new(enclose),
            decide: Box::new(|| Known::Unknown),
            negligible: Magnitude::ZERO,
            most_bits: u64::MAX,
        }
    }
}

/// Whether what begins has begun at a time, by how its beginning compares with that.
pub(crate) fn has_begun(begins: Ordering, side: Limit) -> bool {
    begins == Ordering::Less || (begins == Ordering::Equal && side == Limit::Right)
}

/// The last of some stretches that has begun at a time, or the first; `begins` compares the beginning of
/// one with that time.
pub(crate) fn last_begun<E>(
    count: usize,
    side: Limit,
    begins: impl Fn(usize) -> Result<Ordering, E>,
) -> Result<usize, E> {
    let (mut low, mut high) = (0, count);
    while high - low > 1 {
        let middle = low.midpoint(high);
        match has_begun(begins(middle)?, side) {
            true => low = middle,
            false => high = middle,
        }
    }
    Ok(low)
}

/// A real function of the user's time on a window, cut into stretches, on each of which it is analytic.
///
/// # Invariants
/// - Stretches follow each other without gaps and fill the window; only the last may be an instant,
///   the end of the window where the function jumps.
/// - The function of a stretch goes on analytically a little beyond its ends, and enclosures hold there.
/// - Enclosures hold for every precision in bits; with more bits they are narrower, until a limit.
pub trait Signal {
    /// The first time and the last.
    fn window(&self) -> [&Rational; 2];

    /// One limit at a time of the window, zero before time 0.
    fn point(&self, at: &Rational, side: Limit) -> Outcome<Point<'_>>;

    /// The waves that it is seen in, where these are known in closed form: what methods for doubles
    /// that sum echoes or march from period to period need.
    ///
    /// # Errors
    /// [`EvaluateError::NotLinear`] for energies, [`EvaluateError::NoClosedForm`] where contacts open.
    fn closed_form(&self) -> Outcome<&ClosedForm> {
        Err(EvaluateError::NoClosedForm)
    }

    /// More bits than these tell no more of stretches.
    fn most_bits(&self) -> u64 {
        u64::MAX
    }

    /// With more bits than these, more has to be worked out than is known already.
    fn ready_bits(&self) -> u64 {
        u64::MAX
    }

    /// How many echoes there are; nothing where they are not counted.
    fn echoes(&self) -> Option<EchoCount> {
        None
    }

    /// The same signal without echoes that come to no more than `most` together: enclosures of its values hold what is
    /// left out. Of its derivatives nothing is known then. `None` where it is not made of echoes, or none can be left out.
    ///
    /// # Errors
    /// [`EvaluateError`] where arrivals cannot be told or are too many.
    fn within<'s>(&'s self, _most: &Magnitude) -> Outcome<Option<Box<dyn Signal + 's>>> {
        Ok(None)
    }

    /// What enclosures of values hold for what is left out, whatever their precision.
    fn left_out(&self) -> Magnitude {
        Magnitude::ZERO
    }

    /// How many stretches there are, with numbers from 0 on; to tell that, all breaks are found.
    fn count(&self) -> Outcome<usize>;

    /// A time of the user's in the scale of the scene.
    fn scaled_time(&self, time: &Rational) -> Fraction;

    /// How the beginning of a stretch compares with a time in the scale of the scene.
    fn begins(&self, stretch: usize, at: &Fraction) -> Outcome<Ordering>;

    /// The stretch of a time: for the limit from the left the one that ends there, which is not known
    /// where the window begins.
    ///
    /// # Errors
    /// [`EvaluateError::AfterLast`] outside the window; [`EvaluateError`] where the order of two times is not decided.
    fn stretch_at(&self, at: &Rational, side: Limit) -> Outcome<Option<usize>> {
        let [from, to] = self.window();
        if at < from || at > to {
            return Err(EvaluateError::AfterLast);
        }
        if at == from && side == Limit::Left {
            return Ok(None);
        }
        let at = self.scaled_time(at);
        last_begun(self.count()?, side, |stretch| self.begins(stretch, &at)).map(Some)
    }

    /// Whether a stretch is the last instant of the window alone.
    fn is_instant(&self, stretch: usize) -> bool;

    /// Whether the function is known to have no jumps.
    fn is_continuous(&self) -> bool {
        false
    }

    /// The sign that the slope of a continuous function has wherever it is not zero, if that is known.
    fn trend(&self) -> Option<Ordering> {
        None
    }

    /// Whether the function is known to be zero on a stretch.
    fn is_zero(&self, stretch: usize) -> bool;

    /// A signal of which this one is the square, and a positive number that it is multiplied with.
    fn square_of(&self) -> Option<(Ball, &dyn Signal)> {
        None
    }

    /// What is known of the sign of the function between the ends of a stretch, whatever enclosures tell.
    fn signed(&self, _: usize) -> Option<Signed> {
        None
    }

    /// The time of an end, where it is known to be rational.
    fn exact_time(&self, stretch: usize, end: Limit) -> Option<Rational>;

    /// What identifies the first time of a stretch, where it is known exactly since the start or an event.
    fn instant(&self, stretch: usize) -> Option<Instant>;

    /// The function of a stretch at an exact time in the scale of the scene, which may hold a symbol, where
    /// that is known and costs no more than this.
    fn exact_at(&self, stretch: usize, at: &Fraction, effort: Effort) -> Option<Expression>;

    /// The exact function of a symbol for the time, where that is known.
    fn form(&self, stretch: usize) -> Option<Expression> {
        self.exact_at(stretch, &Fraction::symbol(&later()), Effort::Much)
    }

    /// An enclosure of the time of an end.
    fn time(&self, stretch: usize, end: Limit, bits: u64) -> Outcome<Ball>;

    /// An enclosure of the derivative of an order.
    fn enclose(&self, stretch: usize, order: usize, at: At<'_>, bits: u64) -> Outcome<Ball>;

    /// A derivative near a time as a polynomial, and a bound of what is left out.
    fn taylor(&self, stretch: usize, near: Near<'_>) -> Outcome<Taylor>;

    /// As [`Signal::taylor`], of the same function times one that is positive on the cell and 1 in its middle: what
    /// decays has a sign where its values tell nothing.
    fn taylor_of_sign(&self, stretch: usize, near: Near<'_>) -> Outcome<Taylor> {
        self.taylor(stretch, near)
    }

    /// The size of the largest of those functions whose sum is the derivative of an order, at a time,
    /// and of what is unknown of it.
    fn size(
        &self,
        stretch: usize,
        order: usize,
        at: &Rational,
        bits: u64,
    ) -> Outcome<(Magnitude, Magnitude)>;

    /// The value, where it is known to be rational.
    fn exact(&self, stretch: usize, at: At<'_>) -> Outcome<Option<Rational>>;

    /// How many derivatives, from that of an order on, are known to be exactly zero in the limit at an end;
    /// at most `MAX_FLATNESS`.
    fn flatness(&self, _: usize, _: Limit, _: usize) -> Outcome<usize> {
        Ok(0)
    }

    /// Whether a derivative of an order is known to be zero on a stretch: its polynomial has no coefficient.
    fn vanishes(&self, stretch: usize, order: usize) -> Outcome<bool> {
        if self.is_zero(stretch) {
            return Ok(true);
        }
        let within = Rational::from(self.time(stretch, Limit::Right, STILL_BITS)?.midpoint());
        let place = (&within, &Rational::from_integer(1.into()));
        let near = Near { order, place, terms: 2, bits: STILL_BITS };
        Ok(self.taylor(stretch, near)?.tail(0).is_zero())
    }

    /// Whether the function is known to have one value on all of a stretch: by its slope, or by its exact form.
    fn equals(&self, stretch: usize, value: &Rational) -> Outcome<bool> {
        if self.vanishes(stretch, 1)?
            && let Some(own) = self.exact(stretch, At::End(Limit::Right))?
        {
            return Ok(own == *value);
        }
        let form = self.form(stretch);
        Ok(form.and_then(|own| own.as_constant()).as_ref() == Some(value))
    }
}
