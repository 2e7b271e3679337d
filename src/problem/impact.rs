//! The first contact at a local contact, in closed form.

use super::{Problem, ProblemError};
use crate::enclosure::Numbers;
use crate::export::{self, Formula};
use crate::expression::{Expression, Fraction};
use crate::network::{Impact, NetworkError, NoClosedForm};
use crate::scene::ElementIndex;
use std::cmp::Ordering;

#[doc(hidden)]
impl Problem {
    /// The law of the first local contact, and force, compression and time of its first contact by one parameter, in the
    /// symbols and scales of the scene.
    /// `None` where there is no local contact.
    pub fn first_contact(&self) -> Result<Option<Vec<Formula>>, ProblemError> {
        let contact = self.scaled().ok().and_then(|scaled| Some((scaled, scaled.local_contact()?)));
        let Some((scaled, contact)) = contact else { return Ok(None) };
        let (scene, model) = (scaled.scene(), scaled.model());
        let name = |index: ElementIndex| scene.elements[index].name.clone();
        let refused = |why| ProblemError::NoClosedForm { contact: name(contact), why };
        if let Some(joint) = scene.line.gaps.keys().next() {
            return Err(NetworkError::Apart(scene.names_beside(*joint)).into());
        }
        let impact = Impact::of(scaled, contact).map_err(refused)?;
        let numbers = Numbers::new(&model.constants);
        let by_number = numbers.compare(&impact.approach, &Fraction::zero());
        if by_number != Ok(Ordering::Greater) && !model.assumptions.is_positive(&impact.approach) {
            return Err(refused(NoClosedForm::NotClosing));
        }
        let inverse = |value: &Fraction| {
            let inverse = model.assumptions.invert(&Expression::from(value.clone()));
            inverse
                .ok()
                .and_then(|inverse| inverse.as_fraction())
                .ok_or(refused(NoClosedForm::NotClosing))
        };
        let mut yielding = Fraction::zero();
        for impedance in &impact.impedances {
            yielding = &yielding + &inverse(impedance)?;
        }
        let largest_force = &impact.approach * &inverse(&yielding)?;
        // The shorter way, where it is known.
        let mut until: Vec<(&str, &Fraction)> = Vec::new();
        for (bar, time) in &impact.returns {
            let bar = &*scene.elements[*bar].name;
            match until.last().map(|(_, known)| numbers.compare(time, known)) {
                Some(Ok(Ordering::Less)) => until = vec![(bar, time)],
                Some(Ok(Ordering::Greater)) => {}
                _ => until.push((bar, time)),
            }
        }
        Ok(Some(export::first_contact(scaled, &impact, &largest_force, &until)))
    }
}
