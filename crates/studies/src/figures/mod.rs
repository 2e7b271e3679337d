//! The source's figures, computed from the derived forms and drawn.
//!
//! Where the source gives no numbers for the parameters of its curves, ours stand in the caption. What
//! is measured or shows an apparatus is not here: 6.14 and 6.19.

mod bars;
mod dispersion;
mod error;
mod largest_strain;
mod local;
mod mass;
mod pulse;
mod saint_venant;
mod scene;

pub use error::FigureError;
pub use largest_strain::LargestStrain;
pub use saint_venant::saint_venant;

use wavestep_draw::Chart;

/// A figure that can be drawn.
pub struct Listed {
    /// Its number in the source.
    pub number: &'static str,
    /// What it shows.
    pub title: &'static str,
    draw: fn(&Listed) -> Result<Box<dyn Chart>, FigureError>,
}

impl Listed {
    /// The figure, computed anew.
    ///
    /// # Errors
    /// [`FigureError`], where a part of it cannot be computed.
    pub fn draw(&self) -> Result<Box<dyn Chart>, FigureError> {
        (self.draw)(self)
    }
}

/// All figures, in the order of their numbers.
pub static FIGURES: [Listed; 18] = [
    Listed {
        number: "6.10",
        title: "Impact of two bars: x-t diagram, Z1 = Z2/2",
        draw: bars::diagram_of_impact,
    },
    Listed {
        number: "6.11",
        title: "Impact of two equal bars: progress of the wave",
        draw: bars::progress,
    },
    Listed {
        number: "6.12",
        title: "Constant force on a free bar: the wave on its way",
        draw: bars::pushed_fields,
    },
    Listed {
        number: "6.13",
        title: "Constant force on a free bar: x-t diagram",
        draw: bars::pushed_diagram,
    },
    Listed {
        number: "6.15",
        title: "Rise of the force in a Hertzian contact and in a spring",
        draw: local::rise,
    },
    Listed {
        number: "6.16",
        title: "Rise time of the force, impact velocity and nose radius",
        draw: local::rise_times,
    },
    Listed {
        number: "6.17",
        title: "Impact through a contact spring: x-t diagram",
        draw: pulse::diagram,
    },
    Listed {
        number: "6.18",
        title: "Shape of the pulse for several lengths of the impacting bar",
        draw: pulse::shapes,
    },
    Listed {
        number: "6.20",
        title: "A rigid mass strikes a bar with a fixed end: x-t diagram",
        draw: mass::diagram,
    },
    Listed {
        number: "6.21",
        title: "Velocity of the mass, strain at both ends",
        draw: mass::courses,
    },
    Listed {
        number: "6.22",
        title: "Largest strain at the fixed end in each period",
        draw: mass::largest_strains,
    },
    Listed { number: "6.23", title: "A wave against time", draw: dispersion::against_time },
    Listed { number: "6.24", title: "A wave against place", draw: dispersion::against_place },
    Listed { number: "6.25", title: "Two waves and their envelope", draw: dispersion::beats },
    Listed { number: "6.26", title: "A dispersion diagram", draw: dispersion::diagram },
    Listed {
        number: "6.27",
        title: "Crests that run back through the envelope",
        draw: dispersion::crests,
    },
    Listed {
        number: "6.28",
        title: "Velocities for a curve that is concave downwards",
        draw: dispersion::concave_downwards,
    },
    Listed {
        number: "6.29",
        title: "Velocities for a curve that is concave upwards",
        draw: dispersion::concave_upwards,
    },
];

/// A figure by its number.
///
/// # Errors
/// [`FigureError::Unknown`], which lists those there are.
pub fn find(number: &str) -> Result<&'static Listed, FigureError> {
    let found = FIGURES.iter().find(|figure| figure.number == number);
    found.ok_or_else(|| FigureError::Unknown(number.to_owned()))
}
