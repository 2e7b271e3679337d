//! `figure`: the figures of the source.

use super::arguments::Figure;
use super::failure::Failure;
use super::picture;
use wavestep_studies::figures::{FIGURES, Listed, find};

pub fn run(options: &Figure) -> Result<String, Failure> {
    let (Some(number), Some(output)) = (&options.number, &options.output) else {
        let line = |figure: &Listed| format!("{:<6}{}\n", figure.number, figure.title);
        return Ok(FIGURES.iter().map(line).collect());
    };
    let figure = find(number)?;
    picture::draw(output, options.width, || Ok(figure.draw()?))
}
