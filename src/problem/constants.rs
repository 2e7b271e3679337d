//! What formulas of scenes are in: units, and constants with names.

use super::{Problem, ProblemError};
use crate::enclosure::Numbers;
use crate::expression::{Constant, Definition, Root};
use crate::language;
use std::collections::BTreeSet;

/// Significant digits of constants in remarks.
const DIGITS: usize = 6;

#[doc(hidden)]
impl Problem {
    /// In which units the formulas of a scene are, and what the constants in them are, a line each; all
    /// constants where no text is given to look for them.
    ///
    /// # Errors
    /// As [`Problem::network`].
    pub fn constants(&self, text: Option<&str>) -> Result<Vec<String>, ProblemError> {
        let Ok(network) = self.network() else { return Ok(Vec::new()) };
        let (model, scene) = (network.model(), network.scene());
        let unfolded = network.unfold(&vec![0; network.lattice().periods().len()])?;
        let constants = unfolded.recurrence().constants();
        let mut lines = Vec::new();
        if scene.dimensional {
            let unit = |value: &Root, unit: &str| {
                decimal(constants, &value.clone().into())
                    .map_or(unit.to_owned(), |number| format!("{number} {unit}"))
            };
            let (time, velocity) =
                (unit(&model.scale.time, "s"), unit(&model.scale.velocity, "m/s"));
            let force = unit(&model.scale.force(), "N");
            lines.push(format!("times in {time}, velocities in {velocity}, forces in {force}"));
        }
        let part_of_name = |c: char| c.is_alphanumeric() || c == '_';
        let words = text.map(|text| text.split(|c| !part_of_name(c)).collect::<BTreeSet<&str>>());
        let occurs = |constant: &&Constant| {
            words.as_ref().is_none_or(|words| words.contains(constant.symbol.name()))
        };
        for constant in constants.iter().filter(occurs) {
            if let Some(number) = decimal(constants, &constant.value) {
                lines.push(format!("{} = {number}", constant.symbol));
            }
        }
        Ok(lines)
    }

    /// In which unit the formulas of an observable are, in scenes with units.
    pub fn unit_of_formulas(&self, observable: &str) -> Option<String> {
        let name = language::normalise_name(observable);
        let network = self.network().ok().filter(|network| network.scene().dimensional)?;
        let observed = network.observables().iter().find(|observed| observed.name == name)?;
        let number = decimal(&network.model().constants, &observed.unit.clone().into())?;
        let unit = observed.dimension.unit();
        Some(format!("{name} in {number} {unit}").trim_end().to_owned())
    }
}

/// A definition as a decimal number, where all in it is known.
pub(super) fn decimal(constants: &[Constant], value: &Definition) -> Option<String> {
    let numbers = Numbers::new(constants);
    let ball = numbers.enclose_definition(value, 64).ok()?;
    Some(ball.to_decimal(DIGITS).midpoint().to_string())
}
