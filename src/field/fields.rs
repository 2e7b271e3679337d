//! Fields as numbers.

use super::Sampling;
use crate::evaluate::Limit;
use crate::scene::Dimension;
use wavestep_polynomial::Rational;

/// A field.
///
/// ```
/// use wavestep::field::Quantity;
/// use wavestep::scene::Dimension;
///
/// assert_eq!(Quantity::Strain.name(), "strain");
/// assert_eq!(Quantity::Velocity.dimension(), Dimension::VELOCITY);
/// assert_eq!(Quantity::ALL.len(), 4);
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

    /// What it is called.
    pub const fn name(self) -> &'static str {
        match self {
            Quantity::Velocity => "velocity",
            Quantity::Strain => "strain",
            Quantity::Displacement => "displacement",
            Quantity::Force => "force",
        }
    }

    /// Its dimension in scenes with units.
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
/// use wavestep::field::Bounded;
///
/// let third = Bounded { value: 1.0 / 3.0, bound: 1e-16 };
/// assert!(third.bound < f64::EPSILON);
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
/// # use wavestep::field::{FieldEvaluator, Mesh, Quantity};
/// # use wavestep::language::{Source, parse_number, read_scene};
/// # use wavestep::network::Network;
/// # let text = wavestep::scenes::find("mass-on-fixed-bar").unwrap().text;
/// # let values = [("mu".to_owned(), parse_number("1")?)].into();
/// # let scene = read_scene(&Source::new("mass-on-fixed-bar", text)?, &values).unwrap();
/// # let network = Network::new(&scene).unwrap();
/// let at = parse_number("1/2")?;
/// let fields = FieldEvaluator::new(&network, &at).unwrap().at(&at, &Mesh::new(4).unwrap()).unwrap();
/// let rod = &fields.bars[0];
/// assert_eq!((rod.name.as_str(), &rod.x[..]), ("rod", &[0.0, 0.25, 0.5, 0.75, 1.0][..]));
/// // The front is at 1/2; the limit from the right is that of the rod at rest.
/// let strain: Vec<f64> = rod.of(Quantity::Strain).iter().map(|strain| strain.value).collect();
/// assert_eq!(strain[2..], [0.0, 0.0, 0.0]);
/// assert!((strain[0] + (-0.5_f64).exp()).abs() < 1e-15);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct BarFields {
    /// What the bar is called.
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
/// # use wavestep::field::{FieldEvaluator, Mesh, Sampling};
/// # use wavestep::language::{Source, parse_number, read_scene};
/// # use wavestep::network::Network;
/// # let text = wavestep::scenes::find("hopkinson").unwrap().text;
/// # let scene = read_scene(&Source::new("hopkinson", text)?, &Default::default()).unwrap();
/// # let network = Network::new(&scene).unwrap();
/// let at = parse_number("100e-6")?;
/// let mesh = Mesh::new(10).unwrap();
/// let fields = FieldEvaluator::new(&network, &at).unwrap().at(&at, &mesh).unwrap();
/// assert_eq!((&fields.time, fields.sampling, fields.dimensional), (&at, Sampling::Nodes, true));
/// assert!(fields.bars.len() > 1 && fields.bars.iter().all(|bar| bar.x.len() == 11));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Fields {
    /// The time.
    pub time: Rational,
    /// Whether values have SI units.
    pub dimensional: bool,
    /// What is given.
    pub sampling: Sampling,
    /// From which side limits are.
    pub side: Limit,
    /// The bars asked for, from left to right.
    pub bars: Vec<BarFields>,
}
