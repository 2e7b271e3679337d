//! The first modes of a scene for all values of a symbol between two.

use super::envelope::StepWindow;
use super::exponential::Exponential;
use super::grid::Grid;
use super::on_cell::OnCell;
use super::{NotOverSymbol, Outcome, Over};
use crate::ball::{Arithmetic as _, Ball, BallError, Magnitude};
use crate::limits::{MAX_STEPS_OVER_SYMBOL, MAX_SYMBOL_BITS as BITS};
use crate::model::line::Bar;
use crate::model::modal_line::{ModalLine, Vibration};
use crate::model::shape::{Part, Shape, frequencies};
use crate::model::{NotRepresented, NotSeen};
use crate::network::{MeasuredValue, Node, Term};
use crate::scene::ElementIndex;
use crate::signal::Varying;
use num_traits::{Signed as _, ToPrimitive as _};
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// Newton's method squares an error, and numbers that vary have seven powers: three steps are enough, and one more for
/// roundings.
const CORRECTIONS: usize = 4;

/// Where the middle of a frequency moves by more than one part in this many, Newton's method has gone to another mode.
const NEAR: i64 = 1 << 20;

/// How often an enclosure of a frequency is widened where it does not prove itself.
const WIDENINGS: usize = 3;

/// Of how many equal parts of a cell the ends are looked at.
const PLACES: usize = 16;

/// What is observed, as a sum of modes, in the scale of the scene and the unit of the user.
#[derive(Clone)]
pub struct SumOfModes {
    /// Whether the first one is the motion as a whole.
    drifts: bool,
    sum: Vibration<Varying>,
}

impl SumOfModes {
    /// The first ones alone; none where there are not so many.
    pub fn first(&self, count: usize) -> Option<SumOfModes> {
        let swinging = count.checked_sub(usize::from(self.drifts))?;
        let modes = self.sum.modes.get(..swinging)?.to_vec();
        let sum = Vibration { drift: self.sum.drift.clone(), modes };
        Some(SumOfModes { drifts: self.drifts, sum })
    }

    /// Cells split until no rate exceeds two, with this length of a step, and in how many parts.
    ///
    /// # Errors
    /// [`NotOverSymbol::TooManySteps`] where a cell would need more than [`MAX_STEPS_OVER_SYMBOL`] parts.
    pub fn split(&self, grid: &Grid, length: &Varying) -> Outcome<(Grid, usize)> {
        let rates = self.sum.modes.iter().map(|[frequency, ..]| frequency.magnitude());
        let longest = (0..grid.cells()).map(|cell| grid.length(cell).magnitude()).max();
        let fastest = rates.max().unwrap_or(Magnitude::ZERO).multiply(&length.magnitude());
        let parts = super::parts_of(&fastest.multiply(&longest.expect("one cell at least")))?;
        Ok((grid.split(parts), parts))
    }

    /// The sum on the first cells, with this length of a step.
    ///
    /// # Errors
    /// [`NotOverSymbol::Ball`] where a frequency varies too much; [`NotOverSymbol::TooManySteps`] for more than
    /// [`MAX_STEPS_OVER_SYMBOL`] cells.
    pub fn on_cells(&self, grid: &Grid, count: usize, length: &Varying) -> Outcome<Vec<OnCell>> {
        if count > MAX_STEPS_OVER_SYMBOL {
            return Err(NotOverSymbol::TooManySteps);
        }
        Exponential::total(&self.exponentials(length), grid, count)
    }

    /// The same on one cell.
    ///
    /// # Errors
    /// [`NotOverSymbol::Ball`] where a frequency varies too much.
    pub fn on_cell(&self, grid: &Grid, cell: usize, length: &Varying) -> Outcome<OnCell> {
        Exponential::total_on(&self.exponentials(length), grid, cell)
    }

    /// The cell in a window on which the sum is farthest from what is observed, in doubles and for the middle value of the
    /// symbol; each cell of what is observed is split in so many `parts`.
    pub fn farthest(
        &self,
        (observed, parts): (&[OnCell], usize),
        (grid, length): (&Grid, &Varying),
        window: &StepWindow,
    ) -> Option<usize> {
        let end = |end: &Rational| end.to_f64().unwrap_or(f64::NAN);
        let window = end(&window.from[1])..=end(&window.to[0]);
        let length = length.middle();
        let distance = |cell: usize| {
            let (start, own) = (grid.start(cell).middle(), grid.length(cell).middle());
            let at = |part: usize| {
                let place = part as f64 / PLACES as f64;
                let time = start + own * place;
                let whole = ((cell % parts) as f64 + place) / parts as f64;
                let off = observed[cell / parts].at_middle(whole) - self.about(time * length);
                window.contains(&time).then(|| off.abs())
            };
            (0..=PLACES).filter_map(at).max_by(f64::total_cmp)
        };
        let cells = (0..observed.len() * parts).filter_map(|cell| Some((distance(cell)?, cell)));
        cells.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, cell)| cell)
    }

    /// The sum at a time, in doubles and for the middle value of the symbol.
    fn about(&self, time: f64) -> f64 {
        let [constant, slope] = self.sum.drift.each_ref().map(Varying::middle);
        let wave = |own: &[Varying; 3]| {
            let [frequency, a, b] = own.each_ref().map(Varying::middle);
            let (sin, cos) = (frequency * time).sin_cos();
            a * cos + b * sin
        };
        constant + slope * time + self.sum.modes.iter().map(wave).sum::<f64>()
    }

    fn exponentials(&self, length: &Varying) -> Vec<Exponential> {
        let Vibration { drift: [constant, slope], modes } = &self.sum;
        let zero = Varying::zero;
        let slope = slope.multiply(length, BITS);
        let drift = vec![[constant.clone(), zero()], [slope, zero()]];
        // a cos ωt + b sin ωt is the real part of (a − ib) e^(iωt).
        let wave = |[frequency, a, b]: &[Varying; 3]| Exponential {
            rate: [zero(), frequency.multiply(length, BITS)],
            polynomial: vec![[a.clone(), b.negate()]],
        };
        let drift = Exponential { rate: [zero(), zero()], polynomial: drift };
        std::iter::once(drift).chain(modes.iter().map(wave)).collect()
    }
}

impl Over<'_> {
    /// The first modes, which are those for each value of the symbol: a frequency that is the n-th for one value is the n-th
    /// for all, since no two modes of a line share a frequency, so that their order cannot change.
    ///
    /// # Errors
    /// [`NotOverSymbol::Modes`] for what has none; [`NotOverSymbol::Frequency`] where one is not enclosed.
    pub fn modes(&self, count: usize) -> Outcome<SumOfModes> {
        let value = |value: &_| self.symbol.fraction(value).map_err(NotOverSymbol::from);
        let refused = |term| {
            let observable = self.measured.name.clone();
            NotOverSymbol::Modes(NotRepresented::Observable { observable, term })
        };
        let MeasuredValue::Linear(terms) = &self.measured.value else {
            return Err(refused(NotSeen::Energy));
        };
        let layout = &self.scaled.layout;
        let bars = Bar::all(self.scaled, layout, value)?;
        let nodes = layout.nodes.iter().map(|node| node.map(value));
        let nodes = nodes.collect::<Outcome<Vec<Node<Varying>>>>()?;
        let line = ModalLine { bars: &bars, nodes: &nodes, bits: BITS };
        let name = |element: ElementIndex| self.scaled.scene().elements[element].name.clone();
        let parts = line.parts(name)?;
        let held = line.held();
        let doubles: Vec<Part> = parts.iter().map(|part| part.map(Varying::middle)).collect();
        let mut modes = Vec::with_capacity(count);
        for near in frequencies(&doubles, held, line.drifts(), count) {
            let frequency = near.map(|near| frequency(&parts, held, near)).transpose()?;
            modes.push(line.mode(Shape::of(&parts, held[0], frequency, BITS)?)?);
        }
        let unit = self.symbol.root(&self.measured.unit)?;
        let term = |own: &Term| {
            let own = own.map(value)?;
            Ok(Term { coefficient: own.coefficient.multiply(&unit, BITS), ..own })
        };
        let terms = terms.iter().map(term).collect::<Outcome<Vec<Term<Varying>>>>()?;
        let sum = line.sum(&terms, &modes)?.ok_or(refused(NotSeen::Other))?;
        Ok(SumOfModes { drifts: line.drifts(), sum })
    }
}

/// An enclosure of the frequency that is near a double at the middle of the values.
///
/// The condition at the right end, `u = 0` or `S = 0`, changes its sign across the enclosure for every value of the symbol, so a
/// frequency lies inside. Between two such frequencies the other of `u` and `S` has a zero, since the Prüfer angle rises
/// strictly; in the enclosure it has none, so the frequency is the only one.
///
/// # Errors
/// [`NotOverSymbol::Frequency`] where it varies too much to be enclosed.
pub fn frequency(parts: &[Part<Varying>], held: [bool; 2], near: f64) -> Outcome<Varying> {
    let shape = |frequency: &Varying| Shape::of(parts, held[0], Some(frequency.clone()), BITS);
    let correction = |frequency: &Varying| {
        let correction = shape(frequency)?.correction(held[1], BITS)?;
        Ok::<_, BallError>(correction.expect("it swings"))
    };
    let near = Rational::from_float(near).ok_or(BallError::ArgumentTooLarge)?;
    let mut frequency = Varying::constant(&near, BITS);
    for _ in 0..CORRECTIONS {
        frequency = frequency.add(&correction(&frequency)?, BITS).split().0;
    }
    let [first, now] = [&near, &Rational::from(frequency.coefficient(0).midpoint())];
    if (now - first).abs() * Rational::from_integer(NEAR.into()) > *first {
        return Err(NotOverSymbol::Frequency);
    }
    let (vanishing, other) = if held[1] { (0, 1) } else { (1, 0) };
    let mut width = correction(&frequency)?.magnitude().scale(1);
    for _ in 0..WIDENINGS {
        let away: Varying = Ball::new(width.to_binary(), Magnitude::ZERO).into();
        let sign = |frequency: &Varying, of: usize| -> Result<Option<Ordering>, BallError> {
            Ok(shape(frequency)?.right_end()[of].range().sign())
        };
        let signs = [
            sign(&frequency.subtract(&away, BITS), vanishing)?,
            sign(&frequency.add(&away, BITS), vanishing)?,
        ];
        let mut enclosure = frequency.clone();
        enclosure.remainder = enclosure.remainder.add(&width);
        let rises = [Ordering::Less, Ordering::Greater].map(Some);
        let falls = [Ordering::Greater, Ordering::Less].map(Some);
        if (signs == rises || signs == falls) && sign(&enclosure, other)?.is_some() {
            return Ok(enclosure);
        }
        width = width.scale(2);
    }
    Err(NotOverSymbol::Frequency)
}
