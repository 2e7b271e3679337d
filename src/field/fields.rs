//! Fields as numbers.

use super::Sampling;
use crate::scene::Dimension;
use crate::signal::Limit;
use wavestep_polynomial::Rational;

/// A field.
///
/// ```
/// use wavestep::{Problem, Quantity};
///
/// // A wave that compresses has come half the way back from the wall.
/// let text = "scene \"A\"\nbar rod { impedance = 2, travel = 1, velocity = 1 }\nline free - rod | fixed";
/// let rod = &Problem::read("rod.wave", text)?.field("1/2", 4)?.bars[0];
/// let force = rod.of(Quantity::Force);
/// assert_eq!((force[0].value, force[4].value), (0.0, 2.0));
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Quantity {
    /// Positive to the right.
    Velocity,
    /// Positive where it pulls, that at the start included.
    Strain,
    /// Since the start, positive to the right.
    Displacement,
    /// Positive where it compresses.
    Force,
}

impl Quantity {
    /// All of them, in the order of tables.
    pub const ALL: [Quantity; 4] =
        [Quantity::Velocity, Quantity::Strain, Quantity::Displacement, Quantity::Force];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Quantity::Velocity => "velocity",
            Quantity::Strain => "strain",
            Quantity::Displacement => "displacement",
            Quantity::Force => "force",
        }
    }

    /// Its dimension in scenes with units.
    #[doc(hidden)]
    pub const fn dimension(self) -> Dimension {
        match self {
            Quantity::Velocity => Dimension::VELOCITY,
            Quantity::Strain => Dimension::NONE,
            Quantity::Displacement => Dimension::LENGTH,
            Quantity::Force => Dimension::FORCE,
        }
    }
}

/// A double with a proven bound: `|value − exact| ≤ bound`.
///
/// ```
/// let text = "scene \"A\"\nbar rod { impedance = 2, travel = 1, velocity = 1 }\nline free - rod | fixed";
/// let rod = &wavestep::Problem::read("rod.wave", text)?.field("1/2", 4)?.bars[0];
/// let stopped = rod.of(wavestep::Quantity::Velocity)[4];
/// assert_eq!((stopped.value, stopped.bound), (0.0, 0.0));
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bounded {
    /// The double.
    pub value: f64,
    /// The bound; 0 where the double is exact.
    pub bound: f64,
}

/// The fields of one bar.
///
/// # Invariants
/// - each field has as many values as `x` has places, for averages one less.
///
/// ```
/// let text = "scene \"A\"\nbar rod { impedance = 2, travel = 1, velocity = 1 }\nline free - rod | fixed";
/// let rod = &wavestep::Problem::read("rod.wave", text)?.field("1/2", 4)?.bars[0];
/// assert_eq!((rod.name.as_str(), &rod.x[..]), ("rod", &[0.0, 0.25, 0.5, 0.75, 1.0][..]));
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct BarFields {
    /// The name of the bar.
    pub name: String,
    /// The nodes, as the nearest doubles: distances from the left end, or from the end of an endless
    /// bar, in the unit of lengths; in that of times for bars given by impedance.
    pub x: Vec<f64>,
    /// By the places of [`Quantity::ALL`].
    pub(super) values: [Vec<Bounded>; 4],
}

impl BarFields {
    /// A field: its values at the nodes, or its averages over the cells between them.
    pub fn of(&self, quantity: Quantity) -> &[Bounded] {
        &self.values[quantity as usize]
    }
}

/// The fields of a scene at a time.
///
/// ```
/// let fields = wavestep::Problem::builtin("hopkinson")?.field("100 us", 8)?;
/// assert_eq!(fields.time, wavestep::Rational::new(1.into(), 10_000.into()));
/// assert_eq!(fields.bars[0].x.len(), 9);
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Fields {
    /// The time.
    pub time: Rational,
    /// Whether values have SI units.
    pub dimensional: bool,
    /// Whether these are values or averages.
    #[doc(hidden)]
    pub sampling: Sampling,
    /// The side from which limits are taken.
    #[doc(hidden)]
    pub side: Limit,
    /// The bars asked for, from left to right.
    pub bars: Vec<BarFields>,
}
