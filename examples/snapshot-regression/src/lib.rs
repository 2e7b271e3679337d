//! A scene of one's own with its wave functions, for the tests to lock.

use wavestep::{Error, Problem};

/// The text of the scene.
pub const SCENE: &str = include_str!("../braked-mass.wave");

/// All waves of the scene on the periods `0 … through`, one formula after the other.
pub fn formulas(through: usize) -> Result<String, Error> {
    let problem = Problem::read("braked-mass.wave", SCENE)?;
    let mut text = String::new();
    for wave in problem.waves() {
        for formula in problem.derive(wave, 0..=through)? {
            text += &format!("{formula}\n");
        }
    }
    Ok(text)
}
