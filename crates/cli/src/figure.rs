//! `figure`: the figures of the source.

use super::arguments::Figure;
use super::failure::{COMPUTATION, Failure};
use super::{picture, progress};
use wavestep_studies::figures::{FIGURES, FigureError, find};

impl From<FigureError> for Failure {
    fn from(error: FigureError) -> Failure {
        match error {
            FigureError::Unknown(_) => {
                Failure::usage(error.to_string(), "`wavestep figure` lists them with their titles")
            }
            _ => Failure::new(COMPUTATION, error.to_string(), "draw another figure"),
        }
    }
}

/// Draws a figure, or lists all.
pub fn run(options: &Figure) -> Result<String, Failure> {
    let (Some(number), Some(output)) = (&options.number, &options.output) else {
        let line = |figure: &wavestep_studies::figures::Listed| {
            format!("{:<6}{}\n", figure.number, figure.title)
        };
        return Ok(FIGURES.iter().map(line).collect());
    };
    let figure = find(number)?;
    picture::draw(output, options.width, || {
        let _progress = progress::spinner("computing");
        Ok(figure.draw()?)
    })
}
