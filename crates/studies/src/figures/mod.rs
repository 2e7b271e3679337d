//! The source's figures, computed from the derived forms and drawn.
//!
//! Where the source gives no numbers for the parameters of its curves, ours stand in the caption. What
//! is measured or shows an apparatus is not here: 6.14 and 6.19.

mod bars;
mod dispersion;
mod largest_strain;
mod local;
mod mass;
#[doc(hidden)]
pub mod pulse;
mod scene;

pub use largest_strain::LargestStrain;

use crate::picture::{PictureError, lagrange};
use wavestep::field::{FieldEvaluator, Quantity};
use wavestep_draw::{Axis, Caption, Chart, Diagram, Figure, Panel, PlotError};
use wavestep_polynomial::Rational;

/// A figure, computed.
type Drawn = Result<Box<dyn Chart>, PictureError>;

pub struct Listed {
    pub number: &'static str,
    pub title: &'static str,
    draw: fn(&Listed) -> Drawn,
}

impl Listed {
    /// The figure, computed anew.
    pub fn draw(&self) -> Drawn {
        (self.draw)(self)
    }

    /// Panels over an axis, with the title and the command that draws them again.
    fn figure(&self, x: Axis, panels: Vec<Panel>, remarks: &[&str]) -> Result<Figure, PlotError> {
        Figure::new(self.title, x, panels, self.caption(remarks))
    }

    /// A diagram of place and time, with the names of place, time and quantity.
    fn diagram(
        &self,
        evaluator: &FieldEvaluator<'_>,
        quantity: Quantity,
        last: &Rational,
        names: [&str; 3],
        remarks: &[&str],
    ) -> Result<Diagram, PictureError> {
        let window = [&Rational::default(), last];
        let diagram = lagrange(evaluator, quantity, window, self.caption(remarks))?;
        Ok(diagram.titled(self.title).measured(names))
    }

    fn caption(&self, remarks: &[&str]) -> Caption {
        Caption {
            versions: vec![("wavestep".to_owned(), env!("CARGO_PKG_VERSION").to_owned())],
            command: format!("wavestep figure {} -o figure.svg", self.number),
            remarks: remarks.iter().map(|remark| (*remark).to_owned()).collect(),
            ..Caption::default()
        }
    }
}

const fn listed(number: &'static str, title: &'static str, draw: fn(&Listed) -> Drawn) -> Listed {
    Listed { number, title, draw }
}

/// All figures, in the order of their numbers.
pub static FIGURES: [Listed; 18] = [
    listed("6.10", "Impact of two bars: x-t diagram, Z1 = Z2/2", bars::diagram_of_impact),
    listed("6.11", "Impact of two equal bars: progress of the wave", bars::progress),
    listed("6.12", "Constant force on a free bar: the wave on its way", bars::pushed_fields),
    listed("6.13", "Constant force on a free bar: x-t diagram", bars::pushed_diagram),
    listed("6.15", "Rise of the force in a Hertzian contact and in a spring", local::rise),
    listed("6.16", "Rise time of the force, impact velocity and nose radius", local::rise_times),
    listed("6.17", "Impact through a contact spring: x-t diagram", pulse::diagram),
    listed("6.18", "Shape of the pulse for several lengths of the impacting bar", pulse::shapes),
    listed("6.20", "A rigid mass strikes a bar with a fixed end: x-t diagram", mass::diagram),
    listed("6.21", "Velocity of the mass, strain at both ends", mass::courses),
    listed("6.22", "Largest strain at the fixed end in each period", mass::largest_strains),
    listed("6.23", "A wave against time", dispersion::against_time),
    listed("6.24", "A wave against place", dispersion::against_place),
    listed("6.25", "Two waves and their envelope", dispersion::beats),
    listed("6.26", "A dispersion diagram", dispersion::diagram),
    listed("6.27", "Crests that run back through the envelope", dispersion::crests),
    listed(
        "6.28",
        "Velocities for a curve that is concave downwards",
        dispersion::concave_downwards,
    ),
    listed("6.29", "Velocities for a curve that is concave upwards", dispersion::concave_upwards),
];

pub fn find(number: &str) -> Result<&'static Listed, PictureError> {
    let found = FIGURES.iter().find(|figure| figure.number == number);
    found.ok_or_else(|| {
        let known = FIGURES.each_ref().map(|figure| figure.number).join(", ");
        PictureError::NoFigure { asked: number.to_owned(), known }
    })
}
