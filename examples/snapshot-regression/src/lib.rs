//! A scene of one's own with its wave functions, for the tests to lock.

use wavestep::export::{Formula, Head, TEXT_WIDTH, text};
use wavestep::language::{Diagnostic, Source, read_recurrence};
use wavestep::recurrence::Recurrence;
use wavestep::solution::{Solution, SolveError};

/// The text of the scene.
pub const SCENE: &str = include_str!("../braked-mass.wave");

/// The recurrence that the scene states.
pub fn recurrence() -> Result<Recurrence, Diagnostic> {
    read_recurrence(&Source::new("braked-mass.wave", SCENE)?, &Default::default())
}

/// The pieces of all waves on the periods `0 … through`, one formula a line.
pub fn formulas(recurrence: Recurrence, through: usize) -> Result<String, SolveError> {
    let solution = Solution::new(recurrence);
    let statement = solution.recurrence().statement();
    let mut formulas = Vec::new();
    for (index, wave) in statement.waves.iter().enumerate() {
        for (n, piece) in solution.pieces(index, 0, through)?.iter().enumerate() {
            let local = statement.local.clone();
            let head = Head::Piece { wave: wave.clone(), n, local };
            formulas.push(Formula::new(head, piece, &statement.local));
        }
    }
    Ok(text(&formulas, TEXT_WIDTH))
}
