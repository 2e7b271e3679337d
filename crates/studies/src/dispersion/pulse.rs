//! Pulses: how much of each wavenumber they hold, and up to which wavenumber they are counted.
//!
//! A pulse given in space has a length `b`, and wavenumbers to `2π/b` count. A pulse given in time, at
//! one place, has a duration `τ`; with `ω(k)` in place of the frequency its spectrum is that of the
//! same shape at `ωτ`, times `dω/dk`, and wavenumbers count to the root of `ω(k) τ = 2π`.

use num_traits::Signed as _;
use wavestep_polynomial::Rational;

use super::cut_off::cut_off_of_duration;
use super::error::DispersionError;
use super::formula::{Formula, Function, wave_number};
use super::relation::{Quantity, Relation, value};
use wavestep::ball::Ball;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// 1 on the length `b`: `U = sinc(kb/2)`.
    Square,
    /// Linear up and down on the base `b`: `U = sinc²(kb/4)`.
    Triangle,
    /// `exp(−4x²/b²)`, which is `1/e` at the ends of `b`: `U = exp(−k²b²/16)`.
    Gaussian,
}

impl Shape {
    pub const ALL: [Shape; 3] = [Self::Square, Self::Triangle, Self::Gaussian];

    pub const fn name(self) -> &'static str {
        match self {
            Self::Square => "square",
            Self::Triangle => "triangle",
            Self::Gaussian => "gaussian",
        }
    }

    pub fn find(name: &str) -> Option<Shape> {
        Self::ALL.into_iter().find(|shape| shape.name() == name)
    }

    /// `U` for the product `z` of wavenumber and length, or of frequency and duration.
    fn spectrum(self, z: &Formula) -> Formula {
        let part =
            |divisor: i64| z.multiply(&Formula::number(&Rational::new(1.into(), divisor.into())));
        match self {
            Self::Square => part(2).apply(Function::Sinc),
            Self::Triangle => {
                let sinc = part(4).apply(Function::Sinc);
                sinc.multiply(&sinc)
            }
            Self::Gaussian => part(-16).multiply(z).apply(Function::Exponential),
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Content {
    Shape(Shape),
    Spectrum(Formula),
}

/// What says how far wavenumbers count.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Extent {
    /// A length, a number that may hold π.
    Length(Formula),
    Duration(Rational),
}

/// A pulse.
///
/// # Invariants
/// - The length or duration is positive; a spectrum of one's own holds no symbols but `k` and `pi`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pulse {
    content: Content,
    extent: Extent,
}

fn positive(what: &'static str, value: &Rational) -> Result<(), DispersionError> {
    match value.is_positive() {
        true => Ok(()),
        false => Err(DispersionError::NotPositive(what, value.clone())),
    }
}

impl Pulse {
    pub fn in_space(shape: Shape, length: &Rational) -> Result<Pulse, DispersionError> {
        positive("the length of the pulse", length)?;
        let extent = Extent::Length(Formula::number(length));
        Ok(Pulse { content: Content::Shape(shape), extent })
    }

    /// The pulse whose length is `2π/k_co`, so that wavenumbers to `k_co` count.
    pub fn with_cut_off(shape: Shape, cut_off: &Rational) -> Result<Pulse, DispersionError> {
        positive("the cut-off", cut_off)?;
        let twice = Formula::number(&(Rational::from_integer(2.into()) / cut_off));
        let extent = Extent::Length(twice.multiply(&Formula::pi()));
        Ok(Pulse { content: Content::Shape(shape), extent })
    }

    /// A pulse of this duration, seen at one place.
    pub fn in_time(shape: Shape, duration: &Rational) -> Result<Pulse, DispersionError> {
        positive("the duration of the pulse", duration)?;
        Ok(Pulse { content: Content::Shape(shape), extent: Extent::Duration(duration.clone()) })
    }

    /// The same extent with a spectrum `U(k)` of one's own.
    /// Symbols other than `k` and `pi` are refused.
    pub fn with_spectrum(&self, spectrum: Formula) -> Result<Pulse, DispersionError> {
        let pi = super::formula::pi();
        let mut symbols = spectrum.symbols().into_iter();
        if let Some(symbol) = symbols.find(|symbol| *symbol != wave_number() && *symbol != pi) {
            return Err(DispersionError::MissingValue(symbol));
        }
        Ok(Pulse { content: Content::Spectrum(spectrum), extent: self.extent.clone() })
    }

    /// `U(k)`; the relation matters for pulses given in time.
    pub fn spectrum(&self, relation: &Relation) -> Formula {
        match (&self.content, &self.extent) {
            (Content::Spectrum(formula), _) => formula.clone(),
            (Content::Shape(shape), Extent::Length(b)) => {
                shape.spectrum(&Formula::wave_number().multiply(b))
            }
            (Content::Shape(shape), Extent::Duration(duration)) => {
                let z = relation.frequency().multiply(&Formula::number(duration));
                shape.spectrum(&z).multiply(relation.formula(Quantity::GroupVelocity))
            }
        }
    }

    /// The shape and the length, where it is a pulse of known shape given in space.
    pub(super) fn shape_and_length(&self) -> Option<(Shape, &Formula)> {
        match (&self.content, &self.extent) {
            (Content::Shape(shape), Extent::Length(length)) => Some((*shape, length)),
            _ => None,
        }
    }

    /// The cut-off `k_co`: `2π/b`, or the least root of `ω(k) τ = 2π`.
    pub fn cut_off(&self, relation: &Relation, bits: u64) -> Result<Ball, DispersionError> {
        match &self.extent {
            Extent::Length(b) => value(&cut_off_of_length(b)?, &Ball::zero(), bits),
            Extent::Duration(duration) => cut_off_of_duration(relation, duration, bits),
        }
    }

    /// The cut-off in closed form, where a length is given.
    pub(super) fn exact_cut_off(&self) -> Result<Option<Formula>, DispersionError> {
        match &self.extent {
            Extent::Length(b) => cut_off_of_length(b).map(Some),
            Extent::Duration(_) => Ok(None),
        }
    }
}

/// `2π/b`.
fn cut_off_of_length(b: &Formula) -> Result<Formula, DispersionError> {
    Ok(Formula::integer(2).multiply(&Formula::pi()).divide(b)?)
}
