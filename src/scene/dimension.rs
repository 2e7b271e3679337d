//! Dimensions of quantities.

/// The dimension `length^a · mass^b · time^c`, in metres, kilograms and seconds.
///
/// ```
/// use wavestep::scene::Dimension;
///
/// assert_eq!(Dimension::VELOCITY.times(Dimension::TIME), Dimension::LENGTH);
/// assert_eq!(Dimension::PRESSURE.times(Dimension::AREA), Dimension::FORCE);
/// assert_eq!(Dimension::DENSITY, Dimension::new(-3, 1, 0));
/// assert_eq!(Dimension::MASS.times(Dimension::VELOCITY), Dimension::MOMENTUM);
/// assert_eq!(Dimension::STIFFNESS.times(Dimension::TIME), Dimension::IMPEDANCE);
/// assert_eq!(Dimension::FORCE.times(Dimension::LENGTH), Dimension::ENERGY);
/// assert_eq!(Dimension::NONE, Dimension::default());
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub struct Dimension {
    /// The power of length.
    pub length: i8,
    /// The power of mass.
    pub mass: i8,
    /// The power of time.
    pub time: i8,
}

impl Dimension {
    /// A plain number.
    pub const NONE: Dimension = Dimension::new(0, 0, 0);
    /// `m`
    pub const LENGTH: Dimension = Dimension::new(1, 0, 0);
    /// `kg`
    pub const MASS: Dimension = Dimension::new(0, 1, 0);
    /// `s`
    pub const TIME: Dimension = Dimension::new(0, 0, 1);
    /// `m^2`
    pub const AREA: Dimension = Dimension::new(2, 0, 0);
    /// `m/s`
    pub const VELOCITY: Dimension = Dimension::new(1, 0, -1);
    /// `kg/m^3`
    pub const DENSITY: Dimension = Dimension::new(-3, 1, 0);
    /// `N`
    pub const FORCE: Dimension = Dimension::new(1, 1, -2);
    /// `Pa = N/m^2`, of moduli and stresses.
    pub const PRESSURE: Dimension = Dimension::new(-1, 1, -2);
    /// `N/m`
    pub const STIFFNESS: Dimension = Dimension::new(0, 1, -2);
    /// `N s/m = kg/s`, of impedances and dampings.
    pub const IMPEDANCE: Dimension = Dimension::new(0, 1, -1);
    /// `J = N m`
    pub const ENERGY: Dimension = Dimension::new(2, 1, -2);
    /// `N s`
    pub const MOMENTUM: Dimension = Dimension::new(1, 1, -1);

    /// The dimension with these powers.
    pub const fn new(length: i8, mass: i8, time: i8) -> Dimension {
        Dimension { length, mass, time }
    }

    /// The dimension of a product.
    pub const fn times(self, other: Dimension) -> Dimension {
        Dimension::new(self.length + other.length, self.mass + other.mass, self.time + other.time)
    }
}
