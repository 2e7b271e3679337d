//! How large echoes are at most, bounded before any is worked out, and which ones a tolerance does not need.
//!
//! An echo is a constant and a rest, `w = c₀ + ρ`, of which a number and a bound of its size are kept: steps of impedance
//! and dampers pass constants on as `w = Σ c v + q`, where what meets with opposite signs cancels. Behind a mass or a spring
//! `w' + a w = Σ (c v + d v') + q`. With `z = w − Σ d v` no derivative is left, `z' + a z = Σ (c − a d) v + q`, and
//! `z(0) = Σ (e − d) v(0) + w₀` by the continuous form. So on times `0 ≤ x ≤ T`
//!
//! ```text
//! |w − Σ d v| ≤ Σ (g |e − d| + l |c − a d|) sup|v| + g |w₀| + l sup|q|
//! l = ∫₀ᵀ |e^{−ax}| dx ≤ min(1/Re a, gT),    g = sup |e^{−ax}|, which is 1 where Re a ≥ 0
//! ```
//!
//! Waves that others give are put in first: what they reflect may cancel. The bracket is the norm of a return, for
//! `(p−a)/(p+b)` it is `(a+b)/b`. Norms of masses and springs are mostly above 1; unless dampers reflect little, bounds then
//! do not fall from echo to echo, and nothing is left out.

use super::echoes::Arriving;
use crate::ball::{Ball, ComplexBall, Magnitude};
use crate::enclosure::Numbers;
use crate::expression::{Field as _, Fraction, Root, Transform};
use crate::recurrence::{Observation, ObservedWave, Recurrence, Step, WaveIndex, put_in};
use crate::signal::error::Outcome;
use crate::signal::signal::Limit;
use crate::solution::{Demand, FieldStep};
use std::cell::Cell;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// The precision of coefficients: bounds hold with any.
const BITS: u64 = 64;

/// A bound; `None` where none is known.
type Size = Option<Magnitude>;

/// What each echo brings to what is seen, at most.
pub(super) struct Shares {
    arriving: usize,
    /// Ascending, each with its echo; those of which nothing is known last.
    shares: Vec<(Size, WaveIndex, usize)>,
}

/// The echoes that are worked out, where some may be left out.
pub(super) struct Kept {
    pub demand: Demand,
    /// What all others come to at most.
    pub rest: Magnitude,
    /// How many echoes can reach what is seen.
    pub arriving: usize,
    /// How many echoes other than zero were worked out; on a grid, how many the computed pieces contain.
    pub expanded: Cell<usize>,
}

/// The echoes that are seen, their factors, and the echoes they depend on.
struct Seen {
    demand: Demand,
    gains: BTreeMap<(WaveIndex, usize), Size>,
    /// The longest time since an echo began.
    longest: Magnitude,
}

impl Seen {
    fn none(recurrence: &Recurrence) -> Seen {
        let (demand, gains) = (Demand::none(recurrence), BTreeMap::new());
        Seen { demand, gains, longest: Magnitude::ZERO }
    }

    /// Adds a gain, of a value or of a slope, of which nothing is known.
    fn gain(&mut self, seen: &ObservedWave, number: usize, gain: Magnitude) {
        let nothing = Some(Magnitude::ZERO);
        let known = self.gains.entry((seen.wave, number)).or_insert(nothing);
        add(known, (!seen.slope).then_some(gain));
    }
}

impl Shares {
    /// Of all that is seen in a unit, until the last time of what arrives.
    pub fn of(
        arriving: &Arriving,
        observation: &Observation,
        unit: &Root,
        numbers: &Numbers,
    ) -> Outcome<Shares> {
        let recurrence = arriving.unfolded.recurrence();
        let mut all = Seen::none(recurrence);
        for (seen, gain) in gains(observation, unit, numbers)? {
            let until = &arriving.last - &seen.delay;
            all.longest = all.longest.max(numbers.enclose(&until, BITS)?.magnitude());
            for (number, _) in arriving.begun(numbers, &until, Limit::Right)? {
                arriving.want(&mut all.demand, seen.wave, *number);
                all.gain(seen, *number, gain);
            }
        }
        Shares::bounded(recurrence, all, numbers)
    }

    /// Of waves on a grid, whose echoes arrive one a period, until a time of the scene: of each that is seen up to its last
    /// number.
    pub fn on_grid(
        (recurrence, last): (&Recurrence, &[usize]),
        observation: &Observation,
        unit: &Root,
        (numbers, until): (&Numbers, &Fraction),
    ) -> Outcome<Shares> {
        let mut all = Seen::none(recurrence);
        for ((seen, gain), last) in gains(observation, unit, numbers)?.into_iter().zip(last) {
            let since = until - &seen.delay;
            all.longest = all.longest.max(numbers.enclose(&since, BITS)?.magnitude());
            for number in 0..=*last {
                all.demand.add(recurrence, seen.wave, number);
                all.gain(seen, number, gain);
            }
        }
        Shares::bounded(recurrence, all, numbers)
    }

    /// Whether the echoes of the second half of the numbers up to one come to less than half of those of the first half.
    pub fn fall(&self, number: usize) -> bool {
        let mut sums = [Some(Magnitude::ZERO); 2];
        for (share, _, own) in self.shares.iter().filter(|(.., own)| (1..=number).contains(own)) {
            add(&mut sums[usize::from(*own > number / 2)], *share);
        }
        let [early, late] = sums;
        early.zip(late).is_some_and(|(early, late)| late.scale(1) < early)
    }

    fn bounded(
        recurrence: &Recurrence,
        Seen { demand, gains, longest }: Seen,
        numbers: &Numbers,
    ) -> Outcome<Shares> {
        let field = numbers.field(BITS);
        // What comes by way of another wave is bounded at once: parts of it cancel.
        let at_once = put_in(recurrence.steps(), &recurrence.statement().time);
        let returns = at_once.into_iter().map(|(step, equation)| {
            let step = FieldStep::of(&Step { equation, ..step.clone() }, recurrence, &field)?;
            Returns::of(step, numbers, longest)
        });
        let bounds = bounds(&returns.collect::<Outcome<Vec<_>>>()?, &demand);
        let share = |((wave, number), gain): ((WaveIndex, usize), Size)| {
            (product(gain, bounds[wave][number].size()), wave, number)
        };
        let mut shares: Vec<_> = gains.into_iter().map(share).collect();
        shares.sort_by_key(|(share, ..)| (share.is_none(), *share));
        Ok(Shares { arriving: demand.count(), shares })
    }

    /// Leaves out the smallest ones, as many as are together no larger than `most`; the others are worked out, with all
    /// that they follow from.
    pub fn keep(&self, arriving: &Arriving, most: &Magnitude) -> Kept {
        let (mut demand, mut rest) =
            (Demand::none(arriving.unfolded.recurrence()), Magnitude::ZERO);
        let mut left_out = true;
        for (share, wave, number) in &self.shares {
            let sum = share.map(|share| rest.add(&share)).filter(|sum| left_out && sum <= most);
            match sum {
                Some(sum) => rest = sum,
                None => {
                    left_out = false;
                    arriving.want(&mut demand, *wave, *number);
                }
            }
        }
        Kept { demand, rest, arriving: self.arriving, expanded: Cell::new(0) }
    }

    /// Leaves out the last echoes of a grid: the last piece that is kept continues unchanged.
    pub fn keep_first(&self, recurrence: &Recurrence, most: &Magnitude) -> Kept {
        let (mut demand, mut rest) = (Demand::none(recurrence), Magnitude::ZERO);
        let numbers = self.by_number();
        let mut last = 0;
        for (number, share) in numbers.into_iter().rev() {
            match share.map(|share| rest.add(&share)).filter(|sum| sum <= most) {
                Some(sum) if number > 0 => rest = sum,
                _ => {
                    last = number;
                    break;
                }
            }
        }
        for (_, wave, number) in self.shares.iter().filter(|(.., number)| *number <= last) {
            demand.add(recurrence, *wave, *number);
        }
        let expanded = Cell::new(demand.count());
        Kept { demand, rest, arriving: self.arriving, expanded }
    }

    fn by_number(&self) -> BTreeMap<usize, Size> {
        let mut sums = BTreeMap::new();
        for (share, _, number) in &self.shares {
            add(sums.entry(*number).or_insert(Some(Magnitude::ZERO)), *share);
        }
        sums
    }
}

/// By how much a value of each wave that is seen is multiplied.
fn gains<'o>(
    observation: &'o Observation,
    unit: &Root,
    numbers: &Numbers,
) -> Outcome<Vec<(&'o ObservedWave, Magnitude)>> {
    let (field, unit) = (numbers.field(BITS), numbers.enclose_root(unit, BITS)?.magnitude());
    let gain = |seen: &'o ObservedWave| {
        Ok((seen, field.embed(&seen.coefficient)?.magnitude().multiply(&unit)))
    };
    observation.waves.iter().map(gain).collect()
}

/// An echo until a time: a constant, and a rest of at most this size.
#[derive(Clone)]
struct Bound {
    constant: ComplexBall,
    rest: Size,
}

impl Bound {
    fn zero() -> Bound {
        Bound { constant: ComplexBall::zero(), rest: Some(Magnitude::ZERO) }
    }

    fn size(&self) -> Size {
        let mut size = Some(self.constant.magnitude());
        add(&mut size, self.rest);
        size
    }

    fn add(&mut self, other: &Bound) {
        self.constant = self.constant.add(&other.constant, BITS);
        add(&mut self.rest, other.rest);
    }
}

/// How an echo returns as another: what it is multiplied with, and the norm of all else.
struct Return {
    wave: WaveIndex,
    lag: usize,
    factor: ComplexBall,
    norm: Size,
    /// Whether its slope is asked for, of which nothing is known but for constants.
    slope: bool,
}

/// The returns of one step.
struct Returns {
    wave: WaveIndex,
    returns: Vec<Return>,
    /// What begins at a lag.
    begins: BTreeMap<usize, Bound>,
}

impl Returns {
    fn of(
        FieldStep { wave, equation, start }: FieldStep<ComplexBall>,
        numbers: &Numbers,
        longest: Magnitude,
    ) -> Outcome<Returns> {
        let field = numbers.field(BITS);
        let or_zero = |value: Option<ComplexBall>| value.unwrap_or_else(ComplexBall::zero);
        let mut begins = BTreeMap::<usize, Bound>::new();
        for (lag, forcing) in &equation.forcing {
            begins.insert(*lag, largest(forcing, numbers, longest)?);
        }
        let Some((pole, continuous, initial)) = start else {
            let passed = equation.terms.into_iter().map(|term| Return {
                wave: term.wave,
                lag: term.lag,
                factor: or_zero(term.value),
                norm: Some(Magnitude::ZERO),
                slope: term.slope.is_some(),
            });
            return Ok(Returns { wave, returns: passed.collect(), begins });
        };
        let rate = field.embed(&pole.clone().into())?;
        let [life, growth] = lasting(rate.real(), longest);
        // c, d, e of each echo that is named.
        let mut named = BTreeMap::<(WaveIndex, usize), [ComplexBall; 3]>::new();
        let nothing = || [(); 3].map(|()| ComplexBall::zero());
        for term in equation.terms {
            let own = named.entry((term.wave, term.lag)).or_insert_with(nothing);
            (own[0], own[1]) = (or_zero(term.value), or_zero(term.slope));
        }
        for term in continuous.terms {
            named.entry((term.wave, term.lag)).or_insert_with(nothing)[2] = or_zero(term.value);
        }
        let returned = |((wave, lag), [value, factor, continued]): (_, [ComplexBall; 3])| {
            // The pole is −a.
            let driven = value.add(&factor.multiply(&rate, BITS), BITS).magnitude();
            let jump = continued.add(&factor.clone().negate(), BITS).magnitude();
            let mut norm = product(growth, Some(jump));
            add(&mut norm, product(life, Some(driven)));
            Return { wave, lag, factor, norm, slope: false }
        };
        let returns = named.into_iter().map(returned).collect();
        for begun in begins.values_mut() {
            *begun = Bound { rest: product(life, begun.size()), ..Bound::zero() };
        }
        let mut begin = |lag, jump: &ComplexBall| {
            let begun = begins.entry(lag).or_insert_with(Bound::zero);
            add(&mut begun.rest, product(growth, Some(jump.magnitude())));
        };
        begin(0, &initial);
        for (lag, forcing) in &continuous.forcing {
            begin(*lag, &forcing.initial(&field));
        }
        Ok(Returns { wave, returns, begins })
    }
}

/// Bounds of all echoes that are wanted, by wave and number.
fn bounds(steps: &[Returns], wanted: &Demand) -> Vec<Vec<Bound>> {
    let mut bounds: Vec<Vec<Bound>> = vec![Vec::new(); steps.len()];
    for k in 0..wanted.last().map_or(0, |last| last + 1) {
        for step in steps {
            let mut echo = Bound::zero();
            if wanted.wants(step.wave, k) {
                step.begins.get(&k).into_iter().for_each(|begun| echo.add(begun));
                for Return { wave, lag, factor, norm, slope } in &step.returns {
                    let earlier = k.checked_sub(*lag).and_then(|k| bounds[*wave].get(k));
                    let Some(earlier) = earlier else { continue };
                    let mut rest = product(earlier.rest, Some(factor.magnitude()));
                    add(&mut rest, product(*norm, earlier.size()));
                    if *slope {
                        add(&mut rest, product(None, earlier.rest));
                    }
                    let constant = earlier.constant.multiply(factor, BITS);
                    echo.add(&Bound { constant, rest });
                }
            }
            bounds[step.wave].push(echo);
        }
    }
    bounds
}

/// `∫₀ᵀ e^{λx} dx` and the largest `e^{λx}` of a function with this real part λ of its pole, until a time `T`.
fn lasting(rate: &Ball, longest: Magnitude) -> [Size; 2] {
    let one = Magnitude::power_of_two(0);
    let upper = Ball::new(rate.endpoints().1, Magnitude::ZERO);
    match upper.sign() {
        Some(Ordering::Less) => {
            let inverse = upper.reciprocal(BITS).map(|inverse| inverse.magnitude());
            [Some(inverse.map_or(longest, |inverse| inverse.min(longest))), Some(one)]
        }
        Some(Ordering::Equal) => [Some(longest), Some(one)],
        // e^y ≤ 1 + 2y for y ≤ 1.
        _ => {
            let grown = upper.magnitude().multiply(&longest);
            let growth = (grown <= one).then(|| one.add(&grown.scale(1)));
            [product(growth, Some(longest)), growth]
        }
    }
}

/// A function until a time: its constant, and `Σ_λ sup|e^{λx}| Σ_j |c_j| T^j/j!` for all else.
fn largest(
    function: &Transform<ComplexBall>,
    numbers: &Numbers,
    longest: Magnitude,
) -> Outcome<Bound> {
    let mut bound = Bound::zero();
    for (pole, coefficients) in function.poles() {
        let rate = numbers.field(BITS).embed(&pole.clone().into())?;
        let [_, growth] = lasting(rate.real(), longest);
        let mut power = Magnitude::power_of_two(0);
        for (coefficient, j) in coefficients.iter().zip(1..) {
            match pole.is_zero() && j == 1 {
                true => bound.constant = coefficient.clone(),
                false => {
                    let size = Some(coefficient.magnitude().multiply(&power));
                    add(&mut bound.rest, product(growth, size));
                }
            }
            power = power.multiply(&longest).divide(j);
        }
    }
    Ok(bound)
}

fn add(sum: &mut Size, other: Size) {
    *sum = sum.as_ref().zip(other.as_ref()).map(|(sum, other)| sum.add(other));
}

/// Nothing times anything is nothing.
fn product(left: Size, right: Size) -> Size {
    if [left, right].iter().flatten().any(Magnitude::is_zero) {
        return Some(Magnitude::ZERO);
    }
    Some(left?.multiply(&right?))
}
