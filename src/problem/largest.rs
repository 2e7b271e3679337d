//! How large a quantity becomes, for all values of a symbol between two.

use super::Problem;
use super::between::{Unproven, told};
use crate::expression::Fraction;
use crate::history::family::envelope::{Ends, Envelope, StepWindow};
use crate::history::family::grid::Grid;
use crate::history::family::on_cell::OnCell;
use crate::history::family::{Change, Followed, NotOverSymbol, Over};
use crate::language;
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::signal::Varying;
use num_traits::One as _;
use std::cell::OnceCell;
use wavestep_polynomial::{Rational, Symbol};

/// Bounds of the largest value are what is reached, times `1 + 2^-k`, with a `k` of at least the first and at most the second.
const ABOVE: [u32; 2] = [1, 24];

/// A quantity of a scene in a window.
#[derive(Clone, Copy, Debug)]
pub struct QuantityWindow<'a> {
    pub quantity: &'a str,
    pub from: &'a Rational,
    pub to: &'a Rational,
}

/// Bounds of a largest value at both ends of a range of a symbol. Between them it lies within the bounds interpolated linearly.
#[derive(Clone, PartialEq, Debug)]
pub struct LargestBetween {
    pub at_least: [Rational; 2],
    pub at_most: [Rational; 2],
}

#[doc(hidden)]
impl Problem {
    /// Encloses the largest distance of a quantity from a level, for all values of a symbol between two at once. `None` where
    /// that does not succeed; for fewer values it may.
    ///
    /// # Errors
    /// [`Unproven::Refused`] where it is not known for any part of the values.
    pub fn largest_between(
        &self,
        QuantityWindow { quantity, from, to }: QuantityWindow<'_>,
        level: &Rational,
        symbol: &str,
        values: [&Rational; 2],
    ) -> Result<Option<LargestBetween>, Unproven> {
        let name = language::normalise_name(symbol);
        let symbol =
            Symbol::new(&name).ok_or_else(|| Unproven::because("there is no such symbol"))?;
        let scene = self.scaled().map_err(told)?;
        let window = [from, to].map(Fraction::constant);
        let quantity = language::normalise_name(quantity);
        let bounds = || {
            let over = Over::new(scene, &quantity, (&symbol, values))?;
            let exact = Exact::of(&over, &window, (Over::grid(&[&over])?, &[]))?;
            Ok(exact.about(level).bounds())
        };
        match bounds() {
            Ok(bounds) => Ok(bounds),
            Err(error) if NotOverSymbol::may_pass_if_narrower(&error) => Ok(None),
            Err(error) => Err(Unproven::because(error)),
        }
    }
}

/// The scene for some values of the symbol, on a grid.
pub(super) struct Exact {
    /// The grid before contacts cut it.
    pub asked: Grid,
    pub window: StepWindow,
    pub followed: Followed,
    pub observed: Vec<OnCell>,
    size: Envelope,
    reached: OnceCell<Option<Ends>>,
    most: OnceCell<Option<Ends>>,
}

impl Exact {
    /// The scene on a window, followed on a grid, with the contacts that are known to close.
    pub fn of(
        over: &Over<'_>,
        window: &[Fraction; 2],
        (asked, closings): (Grid, &[Change]),
    ) -> Result<Exact, NotOverSymbol> {
        let [from, to] = window.each_ref().map(|time| over.in_steps(time, &asked.step));
        let window = StepWindow { from: from?, to: to? };
        let followed = over.follow(&asked, closings, window.count())?;
        let observed = followed.observed();
        Ok(Exact::new(asked, window, followed, observed))
    }

    fn new(asked: Grid, window: StepWindow, followed: Followed, observed: Vec<OnCell>) -> Exact {
        let size = Envelope::of((0, &observed), &followed.grid, &window);
        let (reached, most) = (OnceCell::new(), OnceCell::new());
        Exact { asked, window, followed, observed, size, reached, most }
    }

    /// The same scene, with its quantity counted from a level.
    fn about(self, level: &Rational) -> Exact {
        let level = OnCell::constant(&Varying::constant(level, BITS));
        let observed = self.observed.iter().map(|own| own.less(&level)).collect();
        Exact::new(self.asked, self.window, self.followed, observed)
    }

    /// Sizes that are reached.
    pub fn reached(&self) -> Option<&Ends> {
        self.reached.get_or_init(|| self.size.reached()).as_ref()
    }

    /// Sizes that are never passed.
    pub fn most(&self) -> Option<&Ends> {
        let find = || {
            let reached = self.reached()?;
            let above = |power: u32| {
                scaled(
                    reached,
                    &(Rational::one() + Rational::new(1.into(), (1_u64 << power).into())),
                )
            };
            let [mut known, mut open] = [ABOVE[0], ABOVE[1] + 1];
            if !self.size.is_within(&above(known)) {
                return None;
            }
            while open - known > 1 {
                let power = known.midpoint(open);
                match self.size.is_within(&above(power)) {
                    true => known = power,
                    false => open = power,
                }
            }
            Some(above(known))
        };
        self.most.get_or_init(find).as_ref()
    }

    fn bounds(&self) -> Option<LargestBetween> {
        // The symbol ascends from its second end to its first.
        let ascending = |[last, first]: &Ends| [first.clone(), last.clone()];
        let (at_least, at_most) = (ascending(self.reached()?), ascending(self.most()?));
        Some(LargestBetween { at_least, at_most })
    }
}

pub(super) fn scaled(sizes: &Ends, by: &Rational) -> Ends {
    sizes.each_ref().map(|size| size * by)
}
